//! Calls that set properties of bodies, geoms, joints and springs.

use farseer_core::{
    AngleJoint, AngleLimitJoint, AngleSpring, Body, CollisionCategory, FixedAngleJoint, FixedAngleLimitJoint,
    FixedAngleSpring, FixedLinearSpring, FixedRevoluteJoint, Geom, Joint, JointId, LinearSpring,
    PhysicsSimulator, PinJoint, Result, SliderJoint, Spring, SpringId, WeldJoint,
};

use crate::random::Random;

/// A function that changes an object at random. If the call is refused, the checks of the game find out whether it changed the
/// object.
pub(crate) type Edit<T> = fn(&mut T, &mut Random);
/// A function that changes one kind of joints or springs at random. It has no effect on other kinds.
type EditKind<I> = fn(&mut PhysicsSimulator, I, &mut Random) -> Result<()>;

pub(crate) const BODY_EDITS: &[Edit<Body>] = &[
    |body, random| body.set_position(random.vector(300.0)),
    |body, random| body.set_rotation(random.number(-20.0, 20.0)),
    |body, random| body.set_linear_velocity(random.vector(500.0)),
    |body, random| body.set_angular_velocity(random.number(-20.0, 20.0)),
    |body, random| drop(body.set_mass(random.number(0.1, 20.0))),
    |body, random| drop(body.set_moment_of_inertia(random.number(0.1, 2000.0))),
    |body, random| body.set_is_static(random.chance(20)),
    |body, random| body.set_is_kinematic(random.chance(40)),
    |body, random| drop(body.move_to(random.vector(300.0), random.number(-9.0, 9.0))),
    |body, random| body.set_gravity_scale(random.number(-1.0, 3.0)),
    |body, random| body.set_enabled(random.chance(90)),
    |body, random| body.set_ignore_gravity(random.toss()),
    |body, random| body.set_is_quadratic_drag_enabled(random.toss()),
    |body, random| body.set_is_auto_idle(random.toss()),
    |body, random| body.set_tag(random.bits()),
    |body, random| body.set_linear_drag_coefficient(random.number(0.0, 2.0)),
    |body, random| body.set_quadratic_drag_coefficient(random.number(0.0, 2.0)),
    |body, random| body.set_rotational_drag_coefficient(random.number(0.0, 2.0)),
    |body, random| body.set_idle_time(random.number(0.0, 2000.0)),
    |body, random| body.set_minimum_velocity(random.number(0.0, 100.0)),
    |body, random| body.apply_force(random.vector(1000.0)),
    |body, random| body.apply_force_at_local_point(random.vector(1000.0), random.vector(20.0)),
    |body, random| body.apply_force_at_world_point(random.vector(1000.0), random.vector(200.0)),
    |body, random| body.apply_torque(random.number(-5000.0, 5000.0)),
    |body, random| body.apply_impulse(random.vector(300.0)),
    |body, random| body.apply_angular_impulse(random.number(-300.0, 300.0)),
    |body, _| body.clear_force(),
    |body, _| body.clear_torque(),
    |body, _| body.clear_impulse(),
    |body, _| body.reset_dynamics(),
];

pub(crate) const GEOM_EDITS: &[Edit<Geom>] = &[
    |geom, random| geom.set_collision_categories(CollisionCategory::from_bits(random.count(0, 15))),
    |geom, random| geom.set_collides_with(CollisionCategory::from_bits(random.count(0, 15))),
    |geom, random| geom.set_collision_group(random.count(-2, 3)),
    |geom, random| geom.set_friction_coefficient(random.number(0.0, 2.0)),
    |geom, random| geom.set_restitution_coefficient(random.number(0.0, 2.0)),
    |geom, random| geom.set_collision_enabled(random.chance(85)),
    |geom, random| geom.set_collision_response_enabled(random.chance(85)),
    |geom, random| geom.set_collision_callbacks_enabled(random.chance(60)),
    |geom, random| geom.set_tag(random.bits()),
    |geom, _| {
        geom.set_collides_with(CollisionCategory::ALL);
        geom.set_collision_categories(CollisionCategory::ALL);
    },
];

pub(crate) const JOINT_EDITS: &[Edit<Joint>] = &[
    |joint, random| drop(joint.set_bias_factor(random.number(0.0, 1.0))),
    |joint, random| drop(joint.set_breakpoint(random.number(0.0, 100.0))),
    |joint, random| drop(joint.set_softness(random.number(0.0, 1.0))),
    |joint, random| drop(joint.set_greatest_force(random.number(0.0, 1000.0))),
    |joint, random| drop(joint.set_greatest_torque(random.number(0.0, 5000.0))),
    |joint, random| joint.set_enabled(random.chance(80)),
    |joint, random| joint.set_tag(random.bits()),
];

pub(crate) const SPRING_EDITS: &[Edit<Spring>] = &[
    |spring, random| drop(spring.set_breakpoint(random.number(0.0, 100.0))),
    |spring, random| drop(spring.set_damping_constant(random.number(0.0, 10.0))),
    |spring, random| drop(spring.set_spring_constant(random.number(0.0, 1000.0))),
    |spring, random| spring.set_enabled(random.chance(80)),
    |spring, random| spring.set_tag(random.bits()),
];

/// Edits of joints, one for every kind. All of them are tried on each joint.
pub(super) const JOINT_KIND_EDITS: &[EditKind<JointId>] = &[
    |simulator, id, random| {
        let joint = simulator.joint_as_mut::<AngleJoint>(id)?;
        joint.set_target_angle(random.number(-3.0, 3.0))?;
        joint.set_max_impulse(random.number(0.0, 100.0))
    },
    |simulator, id, random| {
        let joint = simulator.joint_as_mut::<FixedAngleJoint>(id)?;
        joint.set_target_angle(random.number(-3.0, 3.0))?;
        joint.set_max_impulse(random.number(0.0, 100.0))
    },
    |simulator, id, random| {
        let joint = simulator.joint_as_mut::<AngleLimitJoint>(id)?;
        let [one, other] = [random.number(-3.0, 3.0), random.number(-3.0, 3.0)];
        let slop = random.number(0.0, 1.0);
        // The precise set refuses a range that ends before it begins.
        let refused = [joint.set_lower_limit(one), joint.set_upper_limit(other)];
        joint.set_slop(slop)?;
        refused.into_iter().collect()
    },
    |simulator, id, random| {
        let joint = simulator.joint_as_mut::<FixedAngleLimitJoint>(id)?;
        let [one, other] = [random.number(-3.0, 3.0), random.number(-3.0, 3.0)];
        let slop = random.number(0.0, 1.0);
        // The precise set refuses a range that ends before it begins.
        let refused = [joint.set_lower_limit(one), joint.set_upper_limit(other)];
        joint.set_slop(slop)?;
        refused.into_iter().collect()
    },
    |simulator, id, random| {
        simulator.joint_as_mut::<FixedRevoluteJoint>(id)?.set_max_impulse(random.number(0.0, 1000.0))
    },
    |simulator, id, random| {
        simulator.joint_as_mut::<WeldJoint>(id)?.set_max_impulse(random.number(0.0, 1000.0))
    },
    |simulator, id, random| {
        simulator.joint_as_mut::<PinJoint>(id)?.set_target_distance(random.number(0.0, 50.0))
    },
    |simulator, id, random| {
        let joint = simulator.joint_as_mut::<SliderJoint>(id)?;
        let [one, other] = [random.number(0.0, 50.0), random.number(0.0, 50.0)];
        let slop = random.number(0.0, 1.0);
        // The precise set refuses a range that ends before it begins.
        let refused = [joint.set_min(one), joint.set_max(other)];
        joint.set_slop(slop)?;
        refused.into_iter().collect()
    },
];

/// Edits of springs, one for every kind. All of them are tried on each spring.
pub(super) const SPRING_KIND_EDITS: &[EditKind<SpringId>] = &[
    |simulator, id, random| {
        let spring = simulator.spring_as_mut::<AngleSpring>(id)?;
        spring.set_target_angle(random.number(-8.0, 8.0))?;
        spring.set_max_torque(random.number(0.0, 1e5))?;
        spring.set_torque_multiplier(random.number(0.0, 3.0))
    },
    |simulator, id, random| {
        let spring = simulator.spring_as_mut::<FixedAngleSpring>(id)?;
        spring.set_target_angle(random.number(-8.0, 8.0))?;
        spring.set_max_torque(random.number(0.0, 1e5))?;
        spring.set_torque_multiplier(random.number(0.0, 3.0))
    },
    |simulator, id, random| {
        let spring = simulator.spring_as_mut::<FixedLinearSpring>(id)?;
        spring.set_body_attach_point(random.vector(20.0))?;
        spring.set_world_attach_point(random.vector(200.0))?;
        spring.set_rest_length(random.number(0.0, 50.0))
    },
    |simulator, id, random| {
        let spring = simulator.spring_as_mut::<LinearSpring>(id)?;
        spring.set_attach_point1(random.vector(20.0))?;
        spring.set_attach_point2(random.vector(20.0))?;
        spring.set_rest_length(random.number(0.0, 50.0))
    },
];
