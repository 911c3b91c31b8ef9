//! Timed operations.

use super::{AtPlace, Finite, Run, build, controllers, links};
use crate::scene::{At, Creation, Op, SceneError, Target};
use crate::trace::Event;
use farseer_core::math::Vector2;
use farseer_core::{Body, BodyId, GeomId, ObjectId};

type Result<T> = std::result::Result<T, SceneError>;

/// Applies the operations of the current step.
pub(super) fn apply(run: &mut Run<'_>) -> Result<()> {
    let root = At::Root;
    let script = root.key("script");
    for (index, entry) in run.scene.script.iter().enumerate() {
        if entry.is_due(run.log.step) {
            operate(run, &entry.op, script.item(index))?;
        }
    }
    Ok(())
}

/// Applies one operation.
fn operate(run: &mut Run<'_>, op: &Op, at: At<'_>) -> Result<()> {
    if let Some(body) = op.body() {
        let id = run.body(body, at.key("body"))?;
        return operate_on_body(run, id, op, at);
    }
    match *op {
        Op::Add { target, index } => match thing(run, target, index, at)? {
            Some(id) => run.simulator.add(id).at(at),
            None => Ok(()),
        },
        Op::Remove { target, index } => match thing(run, target, index, at)? {
            Some(id) => run.simulator.remove(id).at(at),
            None => Ok(()),
        },
        Op::Dispose { target, index } => match thing(run, target, index, at)? {
            Some(id) => run.simulator.dispose(id).at(at),
            None => Ok(()),
        },
        Op::Enable { target, index } => enable(run, target, index, true, at),
        Op::Disable { target, index } => enable(run, target, index, false, at),
        Op::SetGravity { gravity } => run.simulator.set_gravity(gravity).at(at.key("gravity")),
        Op::SetSimulator { ref change } => {
            if let Some(enabled) = change.enabled {
                run.simulator.set_enabled(enabled);
            }
            build::set_solver(&mut run.simulator, &change.solver, at)?;
            build::set_detection(&mut run.simulator, change.narrow_phase, change.max_contacts_to_detect);
            Ok(())
        }
        Op::SetDt { dt } => {
            run.dt = dt.finite(at.key("dt"))?;
            Ok(())
        }
        Op::SetDtReal { dt_real } => {
            run.dt_real = dt_real.finite(at.key("dt_real"))?;
            Ok(())
        }
        Op::Create { creation: Creation::Body { ref spec } } => build::create_body(run, spec, at.key("spec")),
        Op::Create { creation: Creation::Geom { ref spec } } => {
            let geoms = build::create_geoms(run, spec, at.key("spec"))?;
            build::ignore_listed(run, &geoms, spec, at.key("spec"))
        }
        Op::Query { point } => query(run, point.finite(at.key("point"))?),
        Op::SetGeom { geom, .. }
        | Op::SetGeomBody { geom, .. }
        | Op::SetVertices { geom, .. }
        | Op::IgnoreCollision { geom, .. }
        | Op::RestoreCollision { geom, .. } => {
            let id = run.geom(geom, at.key("geom"))?;
            operate_on_geom(run, id, op, at)
        }
        _ => operate_on_link(run, op, at),
    }
}

/// Creates or changes a joint, spring or controller; changing a disposed one has no effect.
fn operate_on_link(run: &mut Run<'_>, op: &Op, at: At<'_>) -> Result<()> {
    match *op {
        Op::Create { creation: Creation::Joint { ref spec } } => {
            links::create_joint(run, spec, at.key("spec"))
        }
        Op::Create { creation: Creation::Spring { ref spec } } => {
            links::create_spring(run, spec, at.key("spec"))
        }
        Op::Create { creation: Creation::Controller { ref spec } } => {
            controllers::create_controller(run, spec, at.key("spec"))
        }
        Op::SetJoint { joint, ref settings, ref geometry } => {
            let id = run.joint(joint, at.key("joint"))?;
            if run.simulator.joint(id).is_none() {
                return Ok(());
            }
            links::set_joint(&mut run.simulator, id, settings, at)?;
            links::set_joint_geometry(&mut run.simulator, id, geometry, at)
        }
        Op::SetSpring { spring, ref geometry, ref settings } => {
            let id = run.spring(spring, at.key("spring"))?;
            if run.simulator.spring(id).is_none() {
                return Ok(());
            }
            links::set_spring_geometry(&mut run.simulator, id, geometry, at)?;
            links::set_spring(&mut run.simulator, id, settings, at)
        }
        Op::DisturbWave { controller, x, offset } => {
            controllers::disturb_wave(run, controller, x, offset, at)
        }
        Op::FluidAddGeom { controller, geom } => {
            let geom = run.geom(geom, at.key("geom"))?;
            controllers::fluid(run, controller, at)?.add_geom(geom).at(at.key("geom"))
        }
        Op::FluidRemoveGeom { controller, geom } => {
            let geom = run.geom(geom, at.key("geom"))?;
            controllers::fluid(run, controller, at)?.remove_geom(geom);
            Ok(())
        }
        Op::SetScaling { controller, ref change } => controllers::set_scaling(run, controller, change, at),
        _ => unreachable!("operations on bodies and geoms are not asked for here"),
    }
}

/// Applies an operation on a body. Changes of a disposed body have no effect.
fn operate_on_body(run: &mut Run<'_>, id: BodyId, op: &Op, at: At<'_>) -> Result<()> {
    let Some(body) = run.simulator.body_mut(id) else {
        return Ok(());
    };
    match *op {
        Op::ApplyForce { force, .. } => body.apply_force(force.finite(at.key("force"))?),
        Op::ApplyForceAtLocalPoint { force, point, .. } => {
            let (force, point) = (force.finite(at.key("force"))?, point.finite(at.key("point"))?);
            body.apply_force_at_local_point(force, point);
        }
        Op::ApplyForceAtWorldPoint { force, point, .. } => {
            let (force, point) = (force.finite(at.key("force"))?, point.finite(at.key("point"))?);
            body.apply_force_at_world_point(force, point);
        }
        Op::ApplyTorque { torque, .. } => body.apply_torque(torque.finite(at.key("torque"))?),
        Op::ApplyImpulse { impulse, .. } => body.apply_impulse(impulse.finite(at.key("impulse"))?),
        Op::ApplyAngularImpulse { impulse, .. } => {
            body.apply_angular_impulse(impulse.finite(at.key("impulse"))?);
        }
        Op::ClearForce { .. } => body.clear_force(),
        Op::ClearTorque { .. } => body.clear_torque(),
        Op::ClearImpulse { .. } => body.clear_impulse(),
        Op::ResetDynamics { .. } => body.reset_dynamics(),
        _ => return set_on_body(body, op, at),
    }
    Ok(())
}

/// Applies an operation that sets a property of a body.
fn set_on_body(body: &mut Body, op: &Op, at: At<'_>) -> Result<()> {
    match *op {
        Op::SetPosition { position, .. } => body.set_position(position.finite(at.key("position"))?),
        Op::SetRotation { rotation, .. } => body.set_rotation(rotation.finite(at.key("rotation"))?),
        Op::SetLinearVelocity { linear_velocity, .. } => {
            body.set_linear_velocity(linear_velocity.finite(at.key("linear_velocity"))?);
        }
        Op::SetAngularVelocity { angular_velocity, .. } => {
            body.set_angular_velocity(angular_velocity.finite(at.key("angular_velocity"))?);
        }
        Op::SetStatic { value, .. } => body.set_is_static(value),
        Op::SetMass { mass, .. } => return body.set_mass(mass).at(at.key("mass")),
        Op::SetMomentOfInertia { moment_of_inertia, .. } => {
            return body.set_moment_of_inertia(moment_of_inertia).at(at.key("moment_of_inertia"));
        }
        Op::SetBody { ref settings, .. } => return build::set_body(body, settings, at),
        _ => unreachable!("the operation is on one body"),
    }
    Ok(())
}

/// Applies an operation on a geom; one on a disposed geom has no effect.
fn operate_on_geom(run: &mut Run<'_>, id: GeomId, op: &Op, at: At<'_>) -> Result<()> {
    if run.simulator.geom(id).is_none() {
        return Ok(());
    }
    match *op {
        Op::SetGeom { ref settings, .. } => build::set_geom(&mut run.simulator, id, settings, at),
        Op::SetGeomBody { body, .. } => {
            let body = run.body(body, at.key("body"))?;
            run.simulator.set_body(id, body).at(at.key("body"))
        }
        Op::SetVertices { ref outline, .. } => {
            let vertices = build::vertices(outline, at.key("outline"))?;
            run.simulator.set_vertices(id, vertices).at(at.key("outline"))
        }
        Op::IgnoreCollision { other, .. } => build::ignore(run, id, other, at.key("other")),
        Op::RestoreCollision { other, .. } => {
            let other = run.geom(other, at.key("other"))?;
            match run.simulator.geom(other) {
                Some(_) => run.simulator.restore_collision_with(id, other).at(at.key("other")),
                None => Ok(()),
            }
        }
        _ => unreachable!("the operation is on one geom"),
    }
}

/// The object with an index; `None` when it is disposed. The original lets a disposed object enter its lists, only to drop it
/// before the update does anything with it.
fn thing(run: &Run<'_>, target: Target, index: usize, at: At<'_>) -> Result<Option<ObjectId>> {
    let at = at.key("index");
    let id: ObjectId = match target {
        Target::Body => run.body(index, at)?.into(),
        Target::Geom => run.geom(index, at)?.into(),
        Target::Joint => run.joint(index, at)?.into(),
        Target::Spring => run.spring(index, at)?.into(),
        Target::Controller => run.controller(index, at)?.into(),
    };
    Ok(is_there(run, id).then_some(id))
}

fn is_there(run: &Run<'_>, id: ObjectId) -> bool {
    match id {
        ObjectId::Body(id) => run.simulator.body(id).is_some(),
        ObjectId::Geom(id) => run.simulator.geom(id).is_some(),
        ObjectId::Joint(id) => run.simulator.joint(id).is_some(),
        ObjectId::Spring(id) => run.simulator.spring(id).is_some(),
        ObjectId::Controller(id) => run.simulator.controller(id).is_some(),
        _ => false,
    }
}

/// Sets the enabled flag of an object that has one.
fn enable(run: &mut Run<'_>, target: Target, index: usize, enabled: bool, at: At<'_>) -> Result<()> {
    let Some(thing) = thing(run, target, index, at)? else { return Ok(()) };
    let simulator = &mut run.simulator;
    match thing {
        ObjectId::Body(id) => simulator[id].set_enabled(enabled),
        ObjectId::Joint(id) => simulator[id].set_enabled(enabled),
        ObjectId::Spring(id) => simulator[id].set_enabled(enabled),
        ObjectId::Controller(id) => simulator[id].set_enabled(enabled),
        _ => return Err(SceneError::format(at.key("target"), "a geom has no enabled flag")),
    }
    Ok(())
}

/// Logs which geoms are at a point.
fn query(run: &mut Run<'_>, point: Vector2) -> Result<()> {
    let first = run.simulator.collide(point).map(|geom| run.log.number(geom));
    let all = run.simulator.collide_all(point).into_iter().map(|geom| run.log.number(geom)).collect();
    run.log.event(Event::Query { first, all });
    Ok(())
}

impl Op {
    /// The body an operation on one body works on.
    fn body(&self) -> Option<usize> {
        match *self {
            Op::ApplyForce { body, .. }
            | Op::ApplyForceAtLocalPoint { body, .. }
            | Op::ApplyForceAtWorldPoint { body, .. }
            | Op::ApplyTorque { body, .. }
            | Op::ApplyImpulse { body, .. }
            | Op::ApplyAngularImpulse { body, .. }
            | Op::ClearForce { body }
            | Op::ClearTorque { body }
            | Op::ClearImpulse { body }
            | Op::SetPosition { body, .. }
            | Op::SetRotation { body, .. }
            | Op::SetLinearVelocity { body, .. }
            | Op::SetAngularVelocity { body, .. }
            | Op::SetStatic { body, .. }
            | Op::SetMass { body, .. }
            | Op::SetMomentOfInertia { body, .. }
            | Op::SetBody { body, .. }
            | Op::ResetDynamics { body } => Some(body),
            _ => None,
        }
    }
}
