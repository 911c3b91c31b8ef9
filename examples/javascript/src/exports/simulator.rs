//! Making simulators, stepping and saving them.

use farseer_core::math::Vector2;
use farseer_core::{BroadPhaseCollider, FrictionType, Hit, Methods, NarrowPhaseCollider, PhysicsSimulator};

use crate::boundary::{Answer, Outcome, exports, invalid, leave_bytes, leave_numbers, with_bytes};
use crate::touches::{Happening, Partner};
use crate::world::{Engine, Simulator, either};

exports! {
    /// A 2D simulator with the faithful set of methods; returns its number.
    fn simulator_new(gravity_x: f32, gravity_y: f32) {
        let simulator = PhysicsSimulator::new(Vector2::new(gravity_x, gravity_y))?;
        Ok(Simulator::keep(Engine::Plane(Box::new(simulator))))
    }

    /// Lets a simulator go.
    fn simulator_free(simulator: Simulator) { simulator.free() }

    /// Chooses the precise set of methods.
    fn simulator_set_precise(simulator: Simulator, length_unit: f32) {
        simulator.plane(|plane| Ok(plane.set_methods(Methods::Precise { length_unit })?))
    }

    /// Chooses the faithful set, with its default broad phase and the distance grid, or SAT.
    fn simulator_set_faithful(simulator: Simulator, is_sat: bool) {
        let narrow = if is_sat { NarrowPhaseCollider::Sat } else { NarrowPhaseCollider::DistanceGrid };
        let broad = BroadPhaseCollider::default();
        simulator.plane(|plane| Ok(plane.set_methods(Methods::Faithful { broad, narrow })?))
    }

    /// Sets the gravity.
    fn simulator_set_gravity(simulator: Simulator, x: f32, y: f32) {
        let gravity = Vector2::new(x, y);
        either!(simulator, |engine| engine.set_gravity(gravity)?)
    }

    /// The gravity.
    fn simulator_gravity(simulator: Simulator) { simulator.with(|world| Ok(world.engine.core().gravity())) }

    /// Sets the iterations of the solver.
    fn simulator_set_iterations(simulator: Simulator, iterations: i32) {
        either!(simulator, |engine| engine.set_iterations(iterations))
    }

    /// The iterations of the solver.
    fn simulator_iterations(simulator: Simulator) { simulator.with(|world| Ok(world.engine.core().iterations())) }

    /// Sets whether friction is the smaller one of two, instead of their mean.
    fn simulator_set_minimum_friction(simulator: Simulator, is_minimum: bool) {
        let friction_type = if is_minimum { FrictionType::Minimum } else { FrictionType::Average };
        either!(simulator, |engine| engine.set_friction_type(friction_type))
    }

    /// Sets whether bodies that have come to rest sleep.
    fn simulator_set_sleep_enabled(simulator: Simulator, value: bool) {
        either!(simulator, |engine| engine.set_sleep_enabled(value))
    }

    /// Makes an update of `dt` seconds.
    fn simulator_step(simulator: Simulator, dt: f32) {
        if dt <= 0.0 {
            return Err(invalid("dt", dt.into(), "greater than 0"));
        }
        simulator.with(|world| { world.step(dt); Ok(()) })
    }

    /// Updates the positions; returns the count of their numbers.
    fn simulator_positions_length(simulator: Simulator) {
        simulator.with(|world| {
            world.refresh_positions();
            Ok(world.positions().len() as f64)
        })
    }

    /// Where the positions are in memory, as 32-bit floats.
    fn simulator_positions_pointer(simulator: Simulator) {
        simulator.with(|world| Ok(world.positions().as_ptr() as usize as f64))
    }

    /// Leaves the events since the last call as numbers, nine each: the kind, the object, the kind of its partner, the partner,
    /// and of a hit point, normal and speed. Kinds of events: touch begins 0 or ends 1, joint 2 or spring 3 broke, body not
    /// finite 4, sensor begins 5 or ends 6, hit 7, body slept 8 or woke 9. Kinds of partners: geom 0, platform 1, ground 2.
    fn simulator_drain_events(simulator: Simulator) {
        simulator.with(|world| {
            let rows: Vec<[f64; 9]> = world.log.drain().map(row).collect::<Result<_, _>>()?;
            Ok(leave_numbers(rows.into_iter().flatten()))
        })
    }

    /// Leaves a snapshot as bytes; returns their count.
    fn simulator_snapshot(simulator: Simulator) {
        simulator.with(|world| Ok(leave_bytes(world.engine.snapshot())))
    }

    /// Restores the snapshot that was left as bytes.
    fn simulator_restore(simulator: Simulator) {
        with_bytes(|bytes| simulator.with(|world| world.restore(bytes)))
    }
}

fn row(happening: Happening) -> Outcome<[f64; 9]> {
    let mut row = [0.0; 9];
    let first = match happening {
        Happening::TouchBegin(geom, partner) => touch(0.0, geom.number()?, partner)?,
        Happening::TouchEnd(geom, partner) => touch(1.0, geom.number()?, partner)?,
        Happening::JointBroke(joint) => [2.0, joint.number()?, 0.0, 0.0],
        Happening::SpringBroke(spring) => [3.0, spring.number()?, 0.0, 0.0],
        Happening::NotFinite(body) => [4.0, body.number()?, 0.0, 0.0],
        Happening::SensorBegin(sensor, visitor) => [5.0, sensor.number()?, 0.0, visitor.number()?],
        Happening::SensorEnd(sensor, visitor) => [6.0, sensor.number()?, 0.0, visitor.number()?],
        Happening::Hit(Hit { geom1, geom2, point, normal, speed }) => {
            row[4..].copy_from_slice(&[point.x, point.y, normal.x, normal.y, speed].map(f64::from));
            [7.0, geom1.number()?, 0.0, geom2.number()?]
        }
        Happening::BodySlept(body) => [8.0, body.number()?, 0.0, 0.0],
        Happening::BodyWoke(body) => [9.0, body.number()?, 0.0, 0.0],
    };
    row[..4].copy_from_slice(&first);
    Ok(row)
}

fn touch(kind: f64, geom: f64, partner: Partner) -> Outcome<[f64; 4]> {
    Ok(match partner {
        Partner::Geom(other) => [kind, geom, 0.0, other.number()?],
        #[cfg(feature = "depth")]
        Partner::Platform(platform) => [kind, geom, 1.0, platform.number()?],
        #[cfg(feature = "depth")]
        Partner::Ground => [kind, geom, 2.0, 0.0],
    })
}
