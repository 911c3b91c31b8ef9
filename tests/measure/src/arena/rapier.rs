//! Scenes of the arena in rapier2d, on one thread. All settings that a scene does not give have rapier's default.

use super::engine::{Counters, DT, Engine, Result, SUBSTEPS, State};
use super::joint::{Joint, JointKind};
use super::scene::{Body, Filter, Form, Kind, Point, Scene, Shape};
use rapier2d::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Gain of a motor in 1/s. The motor reaches its target speed within one step, as far as its greatest effort allows.
const SPEED_GAIN: f32 = 1e6;
/// Stiffness in N/m (kg/s²) of the spring that stands for a distance joint, rigid within the precision of floats.
const RIGID: f32 = 1e12;

/// A scene of the arena in a rapier world.
pub(super) struct Rapier {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
    joints: Vec<ImpulseJointHandle>,
    sleeps: bool,
    friction_rule: CoefficientCombineRule,
}

impl Rapier {
    pub(super) fn new(scene: &Scene) -> Self {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::from(scene.gravity);
        world.integration_parameters.num_solver_iterations = usize::from(SUBSTEPS);
        world.integration_parameters.dt = DT;
        let friction_rule = match scene.takes_lesser_friction {
            true => CoefficientCombineRule::Min,
            false => CoefficientCombineRule::Average,
        };
        Rapier { world, bodies: Vec::new(), joints: Vec::new(), sleeps: scene.sleeps, friction_rule }
    }

    fn collider(&self, shape: &Shape) -> Result<ColliderBuilder> {
        let vectors = |points: &[Point]| points.iter().map(|&point| Vector::from(point)).collect::<Vec<_>>();
        let builder = match &shape.form {
            Form::Circle { centre, radius } => ColliderBuilder::ball(*radius).position(placed(*centre)),
            Form::Capsule { ends: [a, b], radius } => {
                ColliderBuilder::capsule_from_endpoints(Vector::from(*a), Vector::from(*b), *radius)
            }
            Form::Box { half: [x, y], centre } => ColliderBuilder::cuboid(*x, *y).position(placed(*centre)),
            Form::Polygon { corners, radius } if *radius > 0.0 => {
                ColliderBuilder::round_convex_hull(&vectors(corners), *radius).ok_or("no convex polygon")?
            }
            Form::Polygon { corners, .. } => {
                ColliderBuilder::convex_hull(&vectors(corners)).ok_or("no convex polygon")?
            }
            Form::Chain { points, is_loop } => {
                let first = points.first().filter(|_| *is_loop);
                let points: Vec<Point> = points.iter().chain(first).copied().collect();
                ColliderBuilder::polyline(vectors(&points), None)
            }
        };
        Ok(builder
            .density(shape.density)
            .friction(shape.mean_surface[0])
            .friction_combine_rule(self.friction_rule)
            .restitution(shape.surface[1])
            .restitution_combine_rule(CoefficientCombineRule::Max)
            .collision_groups(groups(shape.filter)))
    }
}

fn placed([x, y]: Point) -> Pose {
    Pose::new(Vector::new(x, y), 0.0)
}

/// Returns the filter of a shape as groups of rapier, which has no groups whose members do not collide. Each pair of one of
/// four categories and one of eight collision groups (0 for none) is a group of rapier.
fn groups(filter: Filter) -> InteractionGroups {
    let bit = |category: u32, group: u32| 1_u32 << (8 * category + group % 8);
    let mut others = 0;
    for category in (0..4).filter(|category| filter.mask & (1 << category) != 0) {
        for group in (0..8).filter(|&group| group == 0 || group != filter.group % 8) {
            others |= bit(category, group);
        }
    }
    let own = bit(filter.category.trailing_zeros().min(3), filter.group);
    InteractionGroups::new(Group::from(own), Group::from(others), InteractionTestMode::And)
}

fn link(joint: &Joint, of: [&Body; 2]) -> GenericJoint {
    let [one, two] = joint.local_anchors(of).map(Vector::from);
    let framed = |locked, [axis1, axis2]: [f32; 2]| {
        let frames = [Pose::new(one, axis1), Pose::new(two, axis2)];
        GenericJointBuilder::new(locked).local_frame1(frames[0]).local_frame2(frames[1])
    };
    let (mut builder, axis) = match joint.kind {
        JointKind::Hinge => {
            (framed(JointAxesMask::LOCKED_REVOLUTE_AXES, [joint.reference, 0.0]), JointAxis::AngX)
        }
        JointKind::Weld => {
            (framed(JointAxesMask::LOCKED_FIXED_AXES, [joint.reference, 0.0]), JointAxis::AngX)
        }
        JointKind::Slider { .. } => {
            (framed(JointAxesMask::LOCKED_PRISMATIC_AXES, joint.local_axes(of)), JointAxis::LinX)
        }
        JointKind::Rope { length } => {
            return RopeJointBuilder::new(length).contacts_enabled(false).into();
        }
        JointKind::Rod | JointKind::Spring => {
            let spring = joint.spring.map(|spring| Joint::stiffness(of, spring, Body::mobility));
            let [stiffness, damping] = spring.unwrap_or([RIGID, 0.0]);
            let builder = SpringJointBuilder::new(Joint::length(of), stiffness, damping);
            return builder.contacts_enabled(false).into();
        }
    };
    if let Some(limits) = joint.limits {
        builder = builder.limits(axis, limits);
    }
    // An axis has one motor: a spring takes precedence over it.
    if let Some(spring) = joint.spring {
        let [stiffness, damping] = Joint::stiffness(of, spring, Body::turning_mobility);
        builder = builder.motor_model(axis, MotorModel::ForceBased);
        builder = builder.motor_position(axis, 0.0, stiffness, damping);
    } else if let Some([speed, effort]) = joint.motor {
        builder = builder.motor_velocity(axis, speed, SPEED_GAIN).motor_max_force(axis, effort);
    }
    builder.contacts_enabled(false).build()
}

impl Engine for Rapier {
    fn add_body(&mut self, given: &Body) -> Result<()> {
        let builder = match given.kind {
            Kind::Static => RigidBodyBuilder::fixed(),
            Kind::Kinematic => RigidBodyBuilder::kinematic_velocity_based(),
            Kind::Dynamic => RigidBodyBuilder::dynamic(),
        };
        let builder = builder
            .pose(Pose::new(Vector::from(given.position), given.angle))
            .linvel(Vector::from(given.velocity))
            .angvel(given.spin)
            .linear_damping(given.damping)
            .can_sleep(self.sleeps)
            .sleeping(given.is_asleep);
        let body = self.world.insert_body(builder);
        for shape in &given.shapes {
            let collider = self.collider(shape)?;
            self.world.insert_collider(collider, Some(body));
        }
        self.bodies.push(body);
        Ok(())
    }

    fn add_joint(&mut self, joint: &Joint, of: [&Body; 2]) -> Result<()> {
        let [a, b] = joint.bodies.map(|index| self.bodies[index]);
        self.joints.push(self.world.insert_impulse_joint(a, b, link(joint, of)));
        Ok(())
    }

    fn remove_body(&mut self, index: usize) -> Result<()> {
        self.world.remove_body(self.bodies[index]).map(|_| ()).ok_or_else(|| "no such body".into())
    }

    fn remove_joint(&mut self, index: usize) -> Result<()> {
        let removed = self.world.remove_impulse_joint(self.joints[index]);
        removed.map(|_| ()).ok_or_else(|| "no such joint".into())
    }

    fn move_to(&mut self, index: usize, position: Point) -> Result<()> {
        let body = &mut self.world.bodies[self.bodies[index]];
        let way = Vector::from(position) - body.translation();
        body.set_linvel(way / DT, true);
        Ok(())
    }

    fn step(&mut self) -> Result<()> {
        catch_unwind(AssertUnwindSafe(|| self.world.step())).map_err(|_| "rapier panicked".into())
    }

    fn state(&mut self, index: usize) -> State {
        let body = &self.world.bodies[self.bodies[index]];
        State {
            position: body.translation().to_array(),
            angle: body.rotation().sin().atan2(body.rotation().cos()),
            velocity: body.linvel().to_array(),
            spin: body.angvel(),
        }
    }

    fn cast_ray(&mut self, from: Point, to: Point) -> Result<Option<f32>> {
        let ray = Ray::new(Vector::from(from), Vector::from(to) - Vector::from(from));
        let hit = self.world.cast_ray(&ray, 1.0, true, QueryFilter::default());
        Ok(hit.map(|(_, fraction)| fraction))
    }

    fn count_in_box(&mut self, low: Point, high: Point) -> Result<usize> {
        let area = Aabb::new(Vector::from(low), Vector::from(high));
        Ok(self.world.intersect_aabb_conservative(area, QueryFilter::default()).count())
    }

    fn counters(&mut self) -> Result<Counters> {
        let pairs = self.world.contact_pairs().filter(|pair| pair.has_any_active_contact()).count();
        let awake = self.world.active_bodies().filter(|(_, body)| body.is_dynamic()).count();
        Ok(Counters { pairs, manifolds: 0, aabbs: None, awake })
    }
}
