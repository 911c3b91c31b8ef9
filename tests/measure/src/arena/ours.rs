//! Scenes of the arena in the 2D engine of this workspace, with the precise set: 32 px are one metre, and y points down.

use super::engine::{Counters, DT, Engine, Result, SUBSTEPS, State};
use super::joint::{Joint, JointKind};
use super::scene::{Body, Filter, Form, Kind, Point, Scene, Shape};
use crate::scenes::stage::METRE;
use farseer_core::math::Vector2;
use farseer_core::{
    Aabb, AngleSpring, BodyFactory, BodyId, CollisionCategory, FrictionType, GeomFactory, GeomId,
    GeomPlacement, JointFactory, JointId, JointLimits, JointMotor, Methods, PhysicsSimulator, SpringFactory,
    SpringId, Vertices,
};
use std::f32::consts::TAU;

/// Number of edges of the outlines of circles and of the ends of capsules. The precise set treats both as round, so the
/// number has no effect on contacts.
const EDGES: i32 = 16;

/// A scene of the arena in a [`PhysicsSimulator`].
pub(super) struct Ours {
    simulator: PhysicsSimulator,
    bodies: Vec<BodyId>,
    joints: Vec<(Option<JointId>, Option<SpringId>)>,
    /// Number of dynamic bodies that exist at present.
    dynamic_bodies: usize,
    /// Result of the last box query; its memory is used again.
    found: Vec<GeomId>,
}

impl Ours {
    pub(super) fn new(scene: &Scene) -> Result<Self> {
        let mut simulator = PhysicsSimulator::new(px(scene.gravity))?;
        simulator.set_methods(Methods::PRECISE)?;
        simulator.set_iterations(i32::from(SUBSTEPS));
        simulator.set_sleep_enabled(scene.sleeps);
        if scene.takes_lesser_friction {
            simulator.set_friction_type(FrictionType::Minimum);
        }
        Ok(Ours { simulator, bodies: Vec::new(), joints: Vec::new(), dynamic_bodies: 0, found: Vec::new() })
    }

    fn add_shape(&mut self, body: BodyId, shape: &Shape) -> Result<()> {
        let geom = self.create_geom(body, &shape.form)?;
        let Filter { category, mask, group } = shape.filter;
        // In our engine two shapes collide if one of the masks matches. So the mask of a shape that collides with all
        // categories is reduced to the shape's own category.
        let mask = if mask == u32::MAX { category } else { mask };
        let surface = &mut self.simulator[geom];
        let [friction, restitution] = shape.mean_surface;
        surface.set_friction_coefficient(friction);
        surface.set_restitution_coefficient(restitution);
        surface.set_collision_categories(CollisionCategory::from_bits(category as i32));
        surface.set_collides_with(CollisionCategory::from_bits((mask & i32::MAX as u32) as i32));
        surface.set_collision_group(group as i32);
        Ok(self.simulator.add(geom)?)
    }

    fn create_geom(&mut self, body: BodyId, form: &Form) -> Result<GeomId> {
        let simulator = &mut self.simulator;
        Ok(match form {
            Form::Circle { centre, radius } => {
                let placement = GeomPlacement::at(px(*centre));
                GeomFactory::create_circle_geom(simulator, body, radius * METRE, EDGES, placement)?
            }
            Form::Capsule { ends: [a, b], radius } => {
                let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
                let height = (dx.hypot(dy) + 2.0 * radius) * METRE;
                let centre = px([0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]);
                // A capsule without rotation has its axis along y. The rotation of a placement turns its offset, too.
                let turn = dx.atan2(dy);
                let placement = GeomPlacement::at(turned_back(centre, turn)).turned(turn);
                GeomFactory::create_capsule_geom(simulator, body, height, radius * METRE, EDGES, placement)?
            }
            Form::Box { half: [x, y], centre } => {
                let placement = GeomPlacement::at(px(*centre));
                let [width, height] = [x, y].map(|half| 2.0 * half * METRE);
                GeomFactory::create_rectangle_geom(simulator, body, width, height, placement)?
            }
            Form::Polygon { .. } => {
                let corners: Vec<Vector2> = form.sharp_corners().into_iter().map(px).collect();
                simulator.create_geom(body, Vertices::from(corners), GeomPlacement::default())?
            }
            Form::Chain { points, is_loop } => {
                let first = points.first().filter(|_| *is_loop);
                let points: Vec<Vector2> = points.iter().chain(first).copied().map(px).collect();
                GeomFactory::create_chain_geom(simulator, body, &points, GeomPlacement::default())?
            }
        })
    }

    /// Disables collisions between two bodies that a joint connects. The bodies of one ragdoll need no such call, since they
    /// are in one collision group.
    fn ignore_collisions(&mut self, [a, b]: [BodyId; 2]) -> Result<()> {
        let [ours, theirs] = [a, b].map(|body| self.simulator.geoms_of(body).to_vec());
        for &one in &ours {
            for &other in &theirs {
                self.simulator.ignore_collision_with(one, other)?;
            }
        }
        Ok(())
    }

    /// Creates the joint itself, without limits, motor and spring; `None` for a spring.
    fn create_joint(&mut self, joint: &Joint) -> Result<Option<JointId>> {
        let ([a, b], anchor, zero) = (self.pair(joint), px(joint.anchor), Vector2::zeros());
        let simulator = &mut self.simulator;
        Ok(Some(match joint.kind {
            JointKind::Hinge => JointFactory::create_revolute_joint(simulator, a, b, anchor)?,
            JointKind::Weld => JointFactory::create_weld_joint(simulator, a, b, anchor)?,
            JointKind::Slider { axis } => {
                JointFactory::create_prismatic_joint(simulator, a, b, anchor, px(axis))?
            }
            JointKind::Rod => JointFactory::create_pin_joint(simulator, a, zero, b, zero)?,
            JointKind::Rope { length } => {
                JointFactory::create_slider_joint(simulator, a, zero, b, zero, 0.0, length * METRE)?
            }
            JointKind::Spring => return Ok(None),
        }))
    }

    /// Sets limits and motor of a hinge or slider. The angles of our engine run clockwise, and are 0 when the joint is made.
    fn drive(&mut self, id: JointId, joint: &Joint, of: [&Body; 2]) -> Result<()> {
        let is_slider = matches!(joint.kind, JointKind::Slider { .. });
        if let Some([lower, upper]) = joint.limits {
            let initial = of[1].angle - of[0].angle;
            let [lower, upper] = match is_slider {
                true => [lower, upper].map(|limit| limit * METRE),
                false => [upper, lower].map(|angle| -(angle + joint.reference - initial)),
            };
            self.simulator.set_joint_limits(id, Some(JointLimits { lower, upper }))?;
        }
        if let Some([speed, effort]) = joint.motor {
            let (speed, unit) = if is_slider { (speed * METRE, METRE) } else { (-speed, METRE * METRE) };
            let greatest_effort = (effort * unit).min(f32::MAX);
            self.simulator.set_joint_motor(id, Some(JointMotor { speed, greatest_effort }))?;
        }
        Ok(())
    }

    fn pair(&self, joint: &Joint) -> [BodyId; 2] {
        joint.bodies.map(|index| self.bodies[index])
    }

    /// Creates the spring of a joint: a linear one between the centres of mass, or an angle spring.
    fn add_spring(&mut self, joint: &Joint, of: [&Body; 2], spring: [f32; 2]) -> Result<SpringId> {
        let ([a, b], zero) = (self.pair(joint), Vector2::zeros());
        let simulator = &mut self.simulator;
        if joint.kind == JointKind::Spring {
            let [stiffness, damping] = Joint::stiffness(of, spring, Body::mobility);
            return Ok(SpringFactory::create_linear_spring_in(
                simulator, a, zero, b, zero, stiffness, damping,
            )?);
        }
        let turning = Joint::stiffness(of, spring, Body::turning_mobility);
        let [stiffness, damping] = turning.map(|value| value * METRE * METRE);
        let id = SpringFactory::create_angle_spring_in(simulator, a, b, stiffness, damping)?;
        let spring = simulator.spring_as_mut::<AngleSpring>(id)?;
        spring.set_target_angle(-joint.reference)?;
        Ok(id)
    }
}

impl Engine for Ours {
    fn add_body(&mut self, given: &Body) -> Result<()> {
        let is_dynamic = given.kind == Kind::Dynamic;
        // Static and kinematic bodies need a mass, too, which has no effect.
        let (mass, inertia) = if is_dynamic { (given.mass, given.inertia) } else { (1.0, 1.0) };
        let mut body = BodyFactory::create_body(mass, inertia * METRE * METRE)?;
        body.set_is_static(given.kind == Kind::Static);
        body.set_is_kinematic(given.kind == Kind::Kinematic);
        body.set_linear_drag_coefficient(given.damping * mass);
        body.set_rotational_drag_coefficient(0.0);
        body.set_position(px(given.position));
        body.set_rotation(-given.angle);
        body.set_linear_velocity(px(given.velocity));
        body.set_angular_velocity(-given.spin);
        let body = self.simulator.create_body(body);
        self.simulator.add(body)?;
        given.shapes.iter().try_for_each(|shape| self.add_shape(body, shape))?;
        self.bodies.push(body);
        self.dynamic_bodies += usize::from(is_dynamic);
        if given.is_asleep {
            self.simulator.sleep(body);
        }
        Ok(())
    }

    fn add_joint(&mut self, joint: &Joint, of: [&Body; 2]) -> Result<()> {
        let bodies = self.pair(joint);
        let shapes = |index: usize| of[index].shapes.iter().map(|shape| shape.filter);
        if shapes(0).any(|one| shapes(1).any(|other| one.meets(other))) {
            self.ignore_collisions(bodies)?;
        }
        let id = self.create_joint(joint)?;
        if let Some(id) = id {
            self.drive(id, joint, of)?;
            self.simulator.add(id)?;
        }
        let spring = joint.spring.map(|spring| self.add_spring(joint, of, spring)).transpose()?;
        self.joints.push((id, spring));
        Ok(())
    }

    fn remove_body(&mut self, index: usize) -> Result<()> {
        let body = &self.simulator[self.bodies[index]];
        self.dynamic_bodies -= usize::from(!body.is_static() && !body.is_kinematic());
        Ok(self.simulator.dispose(self.bodies[index])?)
    }

    fn remove_joint(&mut self, index: usize) -> Result<()> {
        let (joint, spring) = self.joints[index];
        spring.map_or(Ok(()), |spring| self.simulator.dispose(spring))?;
        Ok(joint.map_or(Ok(()), |joint| self.simulator.dispose(joint))?)
    }

    fn move_to(&mut self, index: usize, position: Point) -> Result<()> {
        Ok(self.simulator[self.bodies[index]].move_to(px(position), 0.0)?)
    }

    fn step(&mut self) -> Result<()> {
        self.simulator.update(DT);
        Ok(())
    }

    fn state(&mut self, index: usize) -> State {
        let body = &self.simulator[self.bodies[index]];
        State {
            position: metres(body.position()),
            angle: -(body.rotation() - TAU * (body.rotation() / TAU).round()),
            velocity: metres(body.linear_velocity()),
            spin: -body.angular_velocity(),
        }
    }

    fn cast_ray(&mut self, from: Point, to: Point) -> Result<Option<f32>> {
        Ok(self.simulator.ray_cast(px(from), px(to)).map(|hit| hit.fraction))
    }

    fn count_in_box(&mut self, low: Point, high: Point) -> Result<usize> {
        let area = Aabb::from_vertices(&[px(low), px(high)]);
        self.simulator.query_aabb_into(&area, &mut self.found);
        Ok(self.found.len())
    }

    fn counters(&mut self) -> Result<Counters> {
        let counters = self.simulator.counters();
        Ok(Counters {
            pairs: counters.pairs_tested,
            manifolds: counters.manifolds_made,
            aabbs: Some(counters.aabbs_renewed),
            awake: self.dynamic_bodies - counters.bodies_asleep,
        })
    }
}

fn px([x, y]: Point) -> Vector2 {
    Vector2::new(x * METRE, -y * METRE)
}

/// Returns a vector that a rotation by `angle` (rad) maps to `v`.
fn turned_back(v: Vector2, angle: f32) -> Vector2 {
    let (sin, cos) = angle.sin_cos();
    Vector2::new(v.x * cos + v.y * sin, v.y * cos - v.x * sin)
}

fn metres(v: Vector2) -> Point {
    [v.x / METRE, -v.y / METRE]
}
