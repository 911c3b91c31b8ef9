//! Builds an assembly in the 2D engine of this workspace, with the precise set.

use super::assembly::{Assembly, BodyDef, Form, JointDef, JointKind};
use crate::engines::plane::FarseerWorld;
use crate::method::{Built, Setting};
use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, GeomFactory, GeomPlacement, JointFactory, JointLimits, JointMotor, Methods,
    PhysicsSimulator, PinJoint, Result, SpringFactory,
};

/// Number of edges of the outline of a circle. The precise set solves circles exactly, so the number has no effect on
/// contacts.
const EDGES: i32 = 16;

/// Returns a simulator without sleep, and the ids of the bodies in the order of the assembly.
///
/// # Errors
///
/// The engine refuses a body or joint.
pub fn simulator(assembly: &Assembly, substeps: i32) -> Result<(PhysicsSimulator, Vec<BodyId>)> {
    let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, assembly.gravity))?;
    simulator.set_methods(Methods::PRECISE)?;
    simulator.set_iterations(substeps);
    simulator.set_sleep_enabled(false);
    let bodies = assembly.bodies.iter().map(|definition| body(&mut simulator, definition));
    let bodies = bodies.collect::<Result<Vec<_>>>()?;
    assembly.joints.iter().try_for_each(|definition| joint(&mut simulator, &bodies, definition))?;
    Ok((simulator, bodies))
}

/// Builds the world of an assembly with the substeps of `setting`; its time step must be fixed.
///
/// # Errors
///
/// The engine refuses a body or joint; the text has the reason.
pub fn build_ours(assembly: &Assembly, setting: Setting) -> Built {
    let substeps = i32::try_from(setting.passes).map_err(|error| error.to_string())?;
    let (simulator, bodies) = simulator(assembly, substeps).map_err(|error| error.to_string())?;
    Ok(Box::new(FarseerWorld::with_bodies(simulator, bodies)))
}

fn body(simulator: &mut PhysicsSimulator, definition: &BodyDef) -> Result<BodyId> {
    let id = BodyFactory::create_body_in(simulator, definition.mass, definition.inertia)?;
    let body = &mut simulator[id];
    body.set_position(Vector2::from(definition.position));
    body.set_rotation(definition.angle);
    body.set_is_static(definition.is_static);
    body.set_linear_drag_coefficient(0.0);
    body.set_rotational_drag_coefficient(0.0);
    body.set_linear_velocity(Vector2::from(definition.velocity));
    body.set_angular_velocity(definition.angular_velocity);
    let placement = GeomPlacement::default();
    let geom = match definition.form {
        Form::None => return Ok(id),
        Form::Rectangle([width, height]) => {
            GeomFactory::create_rectangle_geom_in(simulator, id, width, height, placement)?
        }
        Form::Circle(radius) => GeomFactory::create_circle_geom_in(simulator, id, radius, EDGES, placement)?,
    };
    let geom = &mut simulator[geom];
    geom.set_collision_group(definition.group);
    geom.set_friction_coefficient(definition.friction);
    geom.set_restitution_coefficient(0.0);
    Ok(id)
}

fn joint(simulator: &mut PhysicsSimulator, bodies: &[BodyId], definition: &JointDef) -> Result<()> {
    let (one, two) = (bodies[definition.body1], bodies[definition.body2]);
    let zero = Vector2::zeros();
    match definition.kind {
        JointKind::Hinge { anchor, limits, motor } => {
            let id = JointFactory::create_revolute_joint_in(simulator, one, two, Vector2::from(anchor))?;
            let limits = limits.map(|[lower, upper]| JointLimits { lower, upper });
            simulator.set_joint_limits(id, limits)?;
            let motor = motor.map(|[speed, greatest_effort]| JointMotor { speed, greatest_effort });
            simulator.set_joint_motor(id, motor)?;
        }
        JointKind::Weld { anchor } => {
            JointFactory::create_weld_joint_in(simulator, one, two, Vector2::from(anchor))?;
        }
        JointKind::Slider { anchor, axis } => {
            let (anchor, axis) = (Vector2::from(anchor), Vector2::from(axis));
            JointFactory::create_prismatic_joint_in(simulator, one, two, anchor, axis)?;
        }
        JointKind::Rod { length } => {
            let id = JointFactory::create_pin_joint_in(simulator, one, zero, two, zero)?;
            simulator.joint_as_mut::<PinJoint>(id)?.set_target_distance(length)?;
        }
        JointKind::Spring { arm, stiffness, damping, .. } => {
            let arm = Vector2::from(arm);
            SpringFactory::create_linear_spring_in(simulator, one, arm, two, zero, stiffness, damping)?;
        }
    }
    Ok(())
}
