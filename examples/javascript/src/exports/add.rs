//! Bodies with their geoms, described by options, and settings of a game in one call each.

use farseer_core::{BodyId, GeomId, JointId};

use crate::boundary::{Answer, Outcome, exports, leave_numbers};
use crate::fields::Fields;
use crate::world::{Simulator, stale};

exports! {
    /// Adds the body whose options were left as numbers, followed by the count of its geoms and their options. Leaves the ids
    /// of body and geoms.
    fn add_body(simulator: Simulator) {
        let mut fields = Fields::left();
        let body = fields.body()?;
        let count = fields.get::<usize>("geoms")?;
        let geoms = (0..count).map(|_| fields.geom()).collect::<Outcome<Vec<_>>>()?;
        simulator.plane(|plane| {
            let (body, geoms) = plane.add_body_with(&body, &geoms)?;
            let ids = [body.number()].into_iter().chain(geoms.into_iter().map(Answer::number));
            Ok(leave_numbers(ids.collect::<Outcome<Vec<_>>>()?))
        })
    }

    /// Adds a geom to a body by the options that were left.
    fn add_geom(simulator: Simulator, body: BodyId) {
        let geom = Fields::left().geom()?;
        simulator.plane(|plane| Ok(plane.add_geom(body, &geom)?))
    }

    /// Sets mass and moment of inertia of a body from its geoms.
    fn body_set_density(simulator: Simulator, body: BodyId, density: f32) {
        simulator.objects(|objects| objects.set_density(body, density))
    }

    /// Puts a body to sleep.
    fn body_sleep(simulator: Simulator, body: BodyId) {
        simulator.plane(|plane| {
            plane.body(body).ok_or_else(|| stale("body"))?;
            plane.sleep(body);
            Ok(())
        })
    }

    /// Leaves the contacts of a body in rows: its geom, the other geom, point, normal, separation, impulse.
    fn body_contacts(simulator: Simulator, body: BodyId) {
        simulator.plane(|plane| {
            let mut rows = Vec::new();
            for contact in plane.contacts_of(body) {
                rows.extend([contact.geom.number()?, contact.other.number()?]);
                let (point, normal) = (contact.point, contact.normal);
                let numbers = [point.x, point.y, normal.x, normal.y, contact.separation, contact.normal_impulse];
                rows.extend(numbers.map(f64::from));
            }
            Ok(leave_numbers(rows))
        })
    }

    /// Makes a geom a sensor, or an ordinary geom, on a body of any kind.
    fn geom_set_sensor(simulator: Simulator, geom: GeomId, value: bool) {
        simulator.plane(|plane| Ok(plane.set_sensor(geom, value)?))
    }

    /// Pushes bodies away by impulses.
    fn simulator_explode(simulator: Simulator) {
        let explosion = Fields::left().explosion()?;
        simulator.plane(|plane| Ok(plane.explode(&explosion)? as f64))
    }

    /// Pushes bodies away by forces.
    fn simulator_apply_radial_force(simulator: Simulator) {
        let explosion = Fields::left().explosion()?;
        simulator.plane(|plane| Ok(plane.apply_radial_force(&explosion)? as f64))
    }

    /// Bounds the speed of bodies.
    fn simulator_set_largest_speed(simulator: Simulator, value: f32) {
        simulator.plane(|plane| Ok(plane.set_largest_speed(Some(value))?))
    }

    /// Bounds the speed of bodies no longer.
    fn simulator_remove_largest_speed(simulator: Simulator) {
        simulator.plane(|plane| Ok(plane.set_largest_speed(None)?))
    }

    /// Sets the speed from which on touches are hits.
    fn simulator_set_hit_speed(simulator: Simulator, value: f32) {
        simulator.plane(|plane| Ok(plane.set_hit_speed(value)?))
    }

    /// Leaves the hash of the state in two numbers, the upper half first.
    fn simulator_state_hash(simulator: Simulator) {
        simulator.with(|world| {
            let hash = world.engine.core().state_hash();
            Ok(leave_numbers([(hash >> 32) as u32, hash as u32].map(f64::from)))
        })
    }

    /// Leaves a snapshot without geoms as bytes.
    fn simulator_snapshot_moving(simulator: Simulator) {
        simulator.plane(|plane| Ok(crate::boundary::leave_bytes(plane.snapshot_moving())))
    }

    /// Puts back a snapshot without geoms.
    fn simulator_restore_moving(simulator: Simulator) {
        crate::boundary::with_bytes(|bytes| simulator.with(|world| world.restore_moving(bytes)))
    }

    /// Whether joined bodies collide.
    fn joint_set_bodies_collide(simulator: Simulator, joint: JointId, value: bool) {
        simulator.objects(|objects| objects.set_joint_bodies_collide(joint, value))
    }
}
