//! Joints and springs of a scene.

use super::{AtPlace, Run};
use crate::scene::{
    At, JointGeometry, JointKind, JointSettings, JointSpec, SceneError, SpringGeometry, SpringKind,
    SpringSettings, SpringSpec,
};
use farseer_core::{
    AngleJoint, AngleLimitJoint, AngleSpring, FixedAngleJoint, FixedAngleLimitJoint, FixedAngleSpring,
    FixedLinearSpring, FixedRevoluteJoint, JointFactory, JointId, LinearSpring, PhysicsSimulator, PinJoint,
    SliderJoint, SpringFactory, SpringId, WeldJoint,
};

type Result<T> = std::result::Result<T, SceneError>;

/// Creates a joint, configures it and adds it unless the scene says otherwise.
pub(super) fn create_joint(run: &mut Run<'_>, spec: &JointSpec, at: At<'_>) -> Result<()> {
    let joint = joint(run, &spec.kind, at)?;
    run.joints.push(joint);
    run.log.know_joint(joint);
    set_joint(&mut run.simulator, joint, &spec.settings, at)?;
    if spec.in_simulation { run.simulator.add(joint).at(at) } else { Ok(()) }
}

fn joint(run: &mut Run<'_>, kind: &JointKind, at: At<'_>) -> Result<JointId> {
    let body = |key: &'static str, index: usize| run.body(index, at.key(key));
    match *kind {
        JointKind::Revolute { body1, body2, anchor } => {
            let (one, two) = (body("body1", body1)?, body("body2", body2)?);
            JointFactory::create_revolute_joint(&mut run.simulator, one, two, anchor)
        }
        JointKind::FixedRevolute { body: index, anchor } => {
            let body = body("body", index)?;
            JointFactory::create_fixed_revolute_joint(&mut run.simulator, body, anchor)
        }
        JointKind::Pin { body1, body2, anchor1, anchor2 } => {
            let (one, two) = (body("body1", body1)?, body("body2", body2)?);
            JointFactory::create_pin_joint(&mut run.simulator, one, anchor1, two, anchor2)
        }
        JointKind::Slider { body1, body2, anchor1, anchor2, min, max } => {
            let (one, two) = (body("body1", body1)?, body("body2", body2)?);
            JointFactory::create_slider_joint(&mut run.simulator, one, anchor1, two, anchor2, min, max)
        }
        JointKind::Angle { body1, body2 } => {
            let (one, two) = (body("body1", body1)?, body("body2", body2)?);
            JointFactory::create_angle_joint(&mut run.simulator, one, two)
        }
        JointKind::FixedAngle { body: index } => {
            let body = body("body", index)?;
            JointFactory::create_fixed_angle_joint(&mut run.simulator, body)
        }
        JointKind::AngleLimit { body1, body2, lower_limit, upper_limit } => {
            let (one, two) = (body("body1", body1)?, body("body2", body2)?);
            JointFactory::create_angle_limit_joint(&mut run.simulator, one, two, lower_limit, upper_limit)
        }
        JointKind::FixedAngleLimit { body: index, lower_limit, upper_limit } => {
            let body = body("body", index)?;
            JointFactory::create_fixed_angle_limit_joint(&mut run.simulator, body, lower_limit, upper_limit)
        }
        JointKind::Weld { body1, body2, anchor } => {
            let (one, two) = (body("body1", body1)?, body("body2", body2)?);
            JointFactory::create_weld_joint(&mut run.simulator, one, two, anchor)
        }
    }
    .at(at)
}

/// Sets the given settings of a joint.
pub(super) fn set_joint(
    simulator: &mut PhysicsSimulator,
    id: JointId,
    settings: &JointSettings,
    at: At<'_>,
) -> Result<()> {
    let joint = &mut simulator[id];
    if let Some(softness) = settings.softness {
        joint.set_softness(softness).at(at.key("softness"))?;
    }
    if let Some(factor) = settings.bias_factor {
        joint.set_bias_factor(factor).at(at.key("bias_factor"))?;
    }
    if let Some(breakpoint) = settings.breakpoint {
        joint.set_breakpoint(breakpoint).at(at.key("breakpoint"))?;
    }
    if let Some(enabled) = settings.enabled {
        joint.set_enabled(enabled);
    }
    if let Some(impulse) = settings.max_impulse {
        set_max_impulse(simulator, id, impulse, at.key("max_impulse"))?;
    }
    if let Some(angle) = settings.target_angle {
        let at = at.key("target_angle");
        match simulator.joint_as_mut::<AngleJoint>(id) {
            Ok(joint) => joint.set_target_angle(angle),
            Err(_) => simulator.joint_as_mut::<FixedAngleJoint>(id).at(at)?.set_target_angle(angle),
        }
        .at(at)?;
    }
    if let Some(distance) = settings.target_distance {
        let at = at.key("target_distance");
        simulator.joint_as_mut::<PinJoint>(id).at(at)?.set_target_distance(distance).at(at)?;
    }
    match settings.slop {
        Some(slop) => set_slop(simulator, id, slop, at.key("slop")),
        None => Ok(()),
    }
}

fn set_max_impulse(simulator: &mut PhysicsSimulator, id: JointId, impulse: f32, at: At<'_>) -> Result<()> {
    if let Ok(joint) = simulator.joint_as_mut::<AngleJoint>(id) {
        return joint.set_max_impulse(impulse).at(at);
    }
    if let Ok(joint) = simulator.joint_as_mut::<FixedAngleJoint>(id) {
        return joint.set_max_impulse(impulse).at(at);
    }
    if let Ok(joint) = simulator.joint_as_mut::<FixedRevoluteJoint>(id) {
        return joint.set_max_impulse(impulse).at(at);
    }
    simulator.joint_as_mut::<WeldJoint>(id).at(at)?.set_max_impulse(impulse).at(at)
}

fn set_slop(simulator: &mut PhysicsSimulator, id: JointId, slop: f32, at: At<'_>) -> Result<()> {
    if let Ok(joint) = simulator.joint_as_mut::<AngleLimitJoint>(id) {
        return joint.set_slop(slop).at(at);
    }
    if let Ok(joint) = simulator.joint_as_mut::<FixedAngleLimitJoint>(id) {
        return joint.set_slop(slop).at(at);
    }
    simulator.joint_as_mut::<SliderJoint>(id).at(at)?.set_slop(slop).at(at)
}

/// Sets the given parts of a joint's geometry.
pub(super) fn set_joint_geometry(
    simulator: &mut PhysicsSimulator,
    id: JointId,
    geometry: &JointGeometry,
    at: At<'_>,
) -> Result<()> {
    if let Some(anchor) = geometry.anchor {
        simulator.set_joint_anchor(id, anchor).at(at.key("anchor"))?;
    }
    if let Some(anchor) = geometry.anchor1 {
        simulator.set_joint_anchor1(id, anchor).at(at.key("anchor1"))?;
    }
    if let Some(anchor) = geometry.anchor2 {
        simulator.set_joint_anchor2(id, anchor).at(at.key("anchor2"))?;
    }
    if let Some(min) = geometry.min {
        let at = at.key("min");
        simulator.joint_as_mut::<SliderJoint>(id).at(at)?.set_min(min).at(at)?;
    }
    if let Some(max) = geometry.max {
        let at = at.key("max");
        simulator.joint_as_mut::<SliderJoint>(id).at(at)?.set_max(max).at(at)?;
    }
    if let Some(limit) = geometry.lower_limit {
        let at = at.key("lower_limit");
        match simulator.joint_as_mut::<AngleLimitJoint>(id) {
            Ok(joint) => joint.set_lower_limit(limit),
            Err(_) => simulator.joint_as_mut::<FixedAngleLimitJoint>(id).at(at)?.set_lower_limit(limit),
        }
        .at(at)?;
    }
    if let Some(limit) = geometry.upper_limit {
        let at = at.key("upper_limit");
        match simulator.joint_as_mut::<AngleLimitJoint>(id) {
            Ok(joint) => joint.set_upper_limit(limit),
            Err(_) => simulator.joint_as_mut::<FixedAngleLimitJoint>(id).at(at)?.set_upper_limit(limit),
        }
        .at(at)?;
    }
    Ok(())
}

/// Creates a spring, configures it and adds it unless the scene says otherwise.
pub(super) fn create_spring(run: &mut Run<'_>, spec: &SpringSpec, at: At<'_>) -> Result<()> {
    let spring = spring(run, spec, at)?;
    run.springs.push(spring);
    run.log.know_spring(spring);
    set_spring(&mut run.simulator, spring, &spec.settings, at)?;
    if spec.in_simulation { run.simulator.add(spring).at(at) } else { Ok(()) }
}

fn spring(run: &mut Run<'_>, spec: &SpringSpec, at: At<'_>) -> Result<SpringId> {
    let body = |key: &'static str, index: usize| run.body(index, at.key(key));
    let (stiffness, damping) = (spec.spring_constant, spec.damping_constant);
    match spec.kind {
        SpringKind::Linear { body1, body2, attach_point1, attach_point2 } => {
            let (one, two) = (body("body1", body1)?, body("body2", body2)?);
            let simulator = &mut run.simulator;
            SpringFactory::create_linear_spring(
                simulator,
                one,
                attach_point1,
                two,
                attach_point2,
                stiffness,
                damping,
            )
        }
        SpringKind::FixedLinear { body: index, body_attach_point, world_attach_point } => {
            let body = body("body", index)?;
            let (simulator, local, world) = (&mut run.simulator, body_attach_point, world_attach_point);
            SpringFactory::create_fixed_linear_spring(simulator, body, local, world, stiffness, damping)
        }
        SpringKind::Angle { body1, body2 } => {
            let (one, two) = (body("body1", body1)?, body("body2", body2)?);
            SpringFactory::create_angle_spring(&mut run.simulator, one, two, stiffness, damping)
        }
        SpringKind::FixedAngle { body: index } => {
            let body = body("body", index)?;
            SpringFactory::create_fixed_angle_spring(&mut run.simulator, body, stiffness, damping)
        }
    }
    .at(at)
}

/// Sets the given settings of a spring.
pub(super) fn set_spring(
    simulator: &mut PhysicsSimulator,
    id: SpringId,
    settings: &SpringSettings,
    at: At<'_>,
) -> Result<()> {
    let spring = &mut simulator[id];
    if let Some(breakpoint) = settings.breakpoint {
        spring.set_breakpoint(breakpoint).at(at.key("breakpoint"))?;
    }
    if let Some(enabled) = settings.enabled {
        spring.set_enabled(enabled);
    }
    if let Some(length) = settings.rest_length {
        let at = at.key("rest_length");
        match simulator.spring_as_mut::<LinearSpring>(id) {
            Ok(spring) => spring.set_rest_length(length),
            Err(_) => simulator.spring_as_mut::<FixedLinearSpring>(id).at(at)?.set_rest_length(length),
        }
        .at(at)?;
    }
    for (value, key, on_two, on_one) in [
        (
            settings.target_angle,
            "target_angle",
            AngleSpring::set_target_angle as fn(&mut AngleSpring, f32) -> _,
            FixedAngleSpring::set_target_angle as fn(&mut FixedAngleSpring, f32) -> _,
        ),
        (settings.max_torque, "max_torque", AngleSpring::set_max_torque, FixedAngleSpring::set_max_torque),
        (
            settings.torque_multiplier,
            "torque_multiplier",
            AngleSpring::set_torque_multiplier,
            FixedAngleSpring::set_torque_multiplier,
        ),
    ] {
        let Some(value) = value else { continue };
        let at = at.key(key);
        match simulator.spring_as_mut::<AngleSpring>(id) {
            Ok(spring) => on_two(spring, value),
            Err(_) => on_one(simulator.spring_as_mut::<FixedAngleSpring>(id).at(at)?, value),
        }
        .at(at)?;
    }
    Ok(())
}

/// Sets the given constants and ends of a spring.
pub(super) fn set_spring_geometry(
    simulator: &mut PhysicsSimulator,
    id: SpringId,
    geometry: &SpringGeometry,
    at: At<'_>,
) -> Result<()> {
    let spring = &mut simulator[id];
    if let Some(stiffness) = geometry.spring_constant {
        spring.set_spring_constant(stiffness).at(at.key("spring_constant"))?;
    }
    if let Some(damping) = geometry.damping_constant {
        spring.set_damping_constant(damping).at(at.key("damping_constant"))?;
    }
    if let Some(point) = geometry.world_attach_point {
        let at = at.key("world_attach_point");
        simulator.spring_as_mut::<FixedLinearSpring>(id).at(at)?.set_world_attach_point(point).at(at)?;
    }
    if let Some(point) = geometry.body_attach_point {
        let at = at.key("body_attach_point");
        simulator.spring_as_mut::<FixedLinearSpring>(id).at(at)?.set_body_attach_point(point).at(at)?;
    }
    if let Some(point) = geometry.attach_point1 {
        let at = at.key("attach_point1");
        simulator.spring_as_mut::<LinearSpring>(id).at(at)?.set_attach_point1(point).at(at)?;
    }
    if let Some(point) = geometry.attach_point2 {
        let at = at.key("attach_point2");
        simulator.spring_as_mut::<LinearSpring>(id).at(at)?.set_attach_point2(point).at(at)?;
    }
    Ok(())
}
