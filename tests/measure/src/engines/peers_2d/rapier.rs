//! Runs 2D scenes in `rapier2d`.

use super::links::{Link, LinkKind};
use super::parts::{BodyPart, Form, Parts, ShapePart, parts};
use super::state::{PeerState, TurnCounter, metres, point, succeeds};
use crate::method::Setting;
use crate::world::{BodyState, World};
use conformance::scene::Scene;
use rapier2d::prelude::{
    CoefficientCombineRule, ColliderBuilder, FixedJointBuilder, GenericJoint, GenericJointBuilder, Group,
    InteractionGroups, InteractionTestMode, JointAxesMask, JointAxis, MassProperties, MotorModel,
    PhysicsWorld, Pose, RevoluteJointBuilder, RigidBodyActivation, RigidBodyBuilder, RigidBodyHandle,
    RopeJointBuilder, SpringJointBuilder, Vector,
};

/// Stiffness in N/m (kg/s²) of the spring that stands for a distance joint. It is rigid within the precision of floats, as the
/// joints of `rapier2d` are.
const RIGID: f32 = 1e12;

/// Gain of a motor in 1/s. The motor reaches its target speed within one step, as far as its greatest torque allows.
const SPEED_GAIN: f32 = 1e6;

struct Rapier {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
    turns: TurnCounter,
    /// Bodies with rotational drag, and the drag torque per squared angular velocity in kg m².
    dragged: Vec<(RigidBodyHandle, f32)>,
    /// Whether a step has panicked: the world then gives no states.
    is_broken: bool,
}

/// Builds a scene in `rapier2d`, with the iterations of the setting as solver iterations and default settings. Distance joints
/// are springs of very high stiffness, because `rapier2d` has no rigid ones.
///
/// # Errors
///
/// The scene has a feature that `rapier2d` lacks.
pub fn build_rapier(scene: &Scene, setting: Setting) -> Result<Box<dyn World>, String> {
    build_parts(&parts(scene)?, setting)
}

/// Builds a world of `rapier2d` from the bodies, shapes and joints of a scene.
pub(super) fn build_parts(parts: &Parts, setting: Setting) -> Result<Box<dyn World>, String> {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::from(parts.gravity);
    world.integration_parameters.num_solver_iterations = setting.passes as usize;
    let bodies: Vec<_> = parts.bodies.iter().map(|part| world.insert_body(body(part))).collect();
    for shape in &parts.shapes {
        let collider = collider(shape, parts)?.collision_groups(groups(shape)?);
        world.insert_collider(collider, Some(bodies[shape.body]));
    }
    for &body in &bodies {
        // Without this, an impulse before the first step would act on a body without mass.
        world.bodies[body].recompute_mass_properties_from_colliders(&world.colliders);
    }
    let ground = world.insert_body(RigidBodyBuilder::fixed());
    for link in &parts.links {
        let body1 = link.body1.map_or(ground, |index| bodies[index]);
        world.insert_impulse_joint(body1, bodies[link.body2], joint(link)?);
    }
    let dragged = parts.bodies.iter().zip(&bodies).filter(|(part, _)| part.rotational_drag != 0.0);
    Ok(Box::new(Rapier {
        dragged: dragged.map(|(part, &body)| (body, part.rotational_drag)).collect(),
        turns: TurnCounter::new(parts.bodies.iter().map(BodyPart::spin)),
        world,
        bodies,
        is_broken: false,
    }))
}

fn body(part: &BodyPart) -> RigidBodyBuilder {
    let builder = if part.is_static { RigidBodyBuilder::fixed() } else { RigidBodyBuilder::dynamic() };
    builder
        .pose(Pose::new(Vector::from(part.position), part.angle))
        .linvel(Vector::from(part.velocity))
        .angvel(part.angular_velocity)
        .linear_damping(part.linear_damping)
        .angular_damping(part.angular_damping)
        .gravity_scale(if part.feels_gravity { 1.0 } else { 0.0 })
        .additional_mass_properties(MassProperties::new(Vector::ZERO, part.mass, part.inertia))
        .can_sleep(false)
}

fn collider(shape: &ShapePart, parts: &Parts) -> Result<ColliderBuilder, String> {
    let builder = match &shape.form {
        Form::Circle { centre, radius } => {
            ColliderBuilder::ball(*radius).position(Pose::new(Vector::from(*centre), 0.0))
        }
        Form::Rectangle { centre, angle, half_extents: [x, y] } => {
            ColliderBuilder::cuboid(*x, *y).position(Pose::new(Vector::from(*centre), *angle))
        }
        Form::Convex(corners) => {
            let points: Vec<_> = corners.iter().map(|&corner| Vector::from(corner)).collect();
            let hull = ColliderBuilder::convex_hull(&points);
            hull.ok_or_else(|| format!("no outline of {} corners without area", corners.len()))?
        }
    };
    let friction_rule = match parts.takes_lesser_friction {
        true => CoefficientCombineRule::Min,
        false => CoefficientCombineRule::Average,
    };
    Ok(builder
        .density(0.0)
        .friction(shape.friction)
        .friction_combine_rule(friction_rule)
        .restitution(shape.restitution)
        .restitution_combine_rule(CoefficientCombineRule::Average))
}

/// Returns the collision filter of a shape. Each collision group is one bit, and shapes of one group do not collide. The first
/// bit is for shapes without a group.
fn groups(shape: &ShapePart) -> Result<InteractionGroups, String> {
    let (member, filter) = match shape.group {
        None => (Group::GROUP_1, Group::ALL),
        Some(number @ 0..31) => {
            let group = Group::from(2 << number);
            (group, Group::ALL.difference(group))
        }
        Some(_) => return Err("no more than 31 collision groups".to_owned()),
    };
    Ok(InteractionGroups::new(member, filter, InteractionTestMode::And))
}

fn joint(link: &Link) -> Result<GenericJoint, String> {
    let vectors = |anchors: [[f32; 2]; 2]| anchors.map(Vector::from);
    Ok(match link.kind {
        LinkKind::Point { anchors } => {
            let [one, two] = vectors(anchors);
            RevoluteJointBuilder::new().local_anchor1(one).local_anchor2(two).into()
        }
        LinkKind::Hinge { anchors, angle, limits, motor } => {
            let [one, two] = vectors(anchors);
            let mut joint = GenericJointBuilder::new(JointAxesMask::LOCKED_REVOLUTE_AXES)
                .local_frame1(Pose::new(one, angle))
                .local_frame2(Pose::new(two, 0.0));
            if let Some(limits) = limits {
                joint = joint.limits(JointAxis::AngX, limits);
            }
            if let Some([speed, torque]) = motor {
                joint = joint.motor_velocity(JointAxis::AngX, speed, SPEED_GAIN);
                joint = joint.motor_max_force(JointAxis::AngX, torque);
            }
            joint.build()
        }
        LinkKind::Slider { anchors, angles } => {
            let [one, two] = vectors(anchors);
            GenericJointBuilder::new(JointAxesMask::LOCKED_PRISMATIC_AXES)
                .local_frame1(Pose::new(one, angles[0]))
                .local_frame2(Pose::new(two, angles[1]))
                .build()
        }
        LinkKind::Weld { anchors, angle } => {
            let [one, two] = vectors(anchors);
            FixedJointBuilder::new()
                .local_frame1(Pose::new(one, angle))
                .local_frame2(Pose::new(two, 0.0))
                .into()
        }
        LinkKind::Distance { anchors, length } => spring(anchors, length, RIGID, 0.0),
        LinkKind::Spring { anchors, length, stiffness, damping } => {
            spring(anchors, length, stiffness, damping)
        }
        LinkKind::DistanceRange { anchors, min: 0.0, max } => {
            let [one, two] = vectors(anchors);
            RopeJointBuilder::new(max).local_anchor1(one).local_anchor2(two).into()
        }
        LinkKind::DistanceRange { .. } => return Err("no joints with a least distance".to_owned()),
        LinkKind::Angle { angle } => GenericJointBuilder::new(JointAxesMask::ANG_X)
            .local_frame1(Pose::new(Vector::ZERO, angle))
            .build(),
        LinkKind::AngleRange { min, max } => {
            GenericJointBuilder::new(JointAxesMask::empty()).limits(JointAxis::AngX, [min, max]).build()
        }
        LinkKind::AngleSpring { angle, stiffness } => GenericJointBuilder::new(JointAxesMask::empty())
            .motor_model(JointAxis::AngX, MotorModel::ForceBased)
            .motor_position(JointAxis::AngX, angle, stiffness, 0.0)
            .build(),
    })
}

fn spring([one, two]: [[f32; 2]; 2], length: f32, stiffness: f32, damping: f32) -> GenericJoint {
    SpringJointBuilder::new(length, stiffness, damping)
        .local_anchor1(Vector::from(one))
        .local_anchor2(Vector::from(two))
        .into()
}

impl Rapier {
    fn peer_state(&self, index: usize) -> PeerState {
        let body = &self.world.bodies[self.bodies[index]];
        PeerState {
            position: body.translation().to_array(),
            rotation: [body.rotation().cos(), body.rotation().sin()],
            velocity: body.linvel().to_array(),
            angular_velocity: body.angvel(),
        }
    }
}

impl World for Rapier {
    fn step(&mut self, dt: f32) {
        if self.is_broken {
            return;
        }
        for &(handle, drag) in &self.dragged {
            let body = &mut self.world.bodies[handle];
            let angular_velocity = body.angvel();
            body.reset_torques(false);
            body.add_torque(-drag * angular_velocity * angular_velocity.abs(), false);
        }
        self.world.integration_parameters.dt = dt;
        self.is_broken = !succeeds(|| {
            self.world.step();
            Ok(())
        });
        self.turns.advance(dt);
    }

    fn body(&self, index: usize) -> BodyState {
        self.turns.state(index, (!self.is_broken).then(|| self.peer_state(index)))
    }

    fn body_count(&self) -> usize {
        self.turns.len()
    }

    fn set_velocity(&mut self, index: usize, velocity: [f64; 2], angular_velocity: f64) {
        let body = &mut self.world.bodies[self.bodies[index]];
        body.set_linvel(Vector::from(point(velocity)), true);
        body.set_angvel(angular_velocity as f32, true);
        self.turns.set(index, None, Some(angular_velocity));
    }

    fn apply_impulse(&mut self, index: usize, impulse: [f64; 2]) {
        self.world.bodies[self.bodies[index]].apply_impulse(Vector::from(point(impulse)), true);
    }

    fn teleport(&mut self, index: usize, position: [f64; 2], angle: f64) {
        let place = Pose::new(Vector::from(position.map(metres)), angle as f32);
        self.world.bodies[self.bodies[index]].set_position(place, true);
        self.turns.set(index, Some(angle), None);
    }

    fn set_sleep_enabled(&mut self, is_enabled: bool) {
        let limits =
            if is_enabled { RigidBodyActivation::active() } else { RigidBodyActivation::cannot_sleep() };
        for &handle in &self.bodies {
            let body = &mut self.world.bodies[handle];
            if !body.is_dynamic() {
                continue;
            }
            if !is_enabled {
                body.wake_up(true);
            }
            let activation = body.activation_mut();
            activation.normalized_linear_threshold = limits.normalized_linear_threshold;
            activation.angular_threshold = limits.angular_threshold;
        }
    }

    fn is_asleep(&self, index: usize) -> bool {
        self.world.bodies[self.bodies[index]].is_sleeping()
    }
}
