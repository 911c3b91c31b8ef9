//! Life and update of a simulator.

use std::mem::MaybeUninit;

use farseer_core::{Methods, PhysicsSimulator};

use crate::arguments::{FarseerVector2, Finite, choose};
use crate::failure::{Failure, FarseerStatus, Outcome};
use crate::guard::{FarseerSimulator, answer, with, write};

/// How a simulator computes.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FarseerMethods {
    /// Farseer Physics 2.1.3, bit for bit.
    Faithful = 0,
    /// The precise engine: faster and more accurate, with sleep and continuous collision.
    Precise = 1,
}

/// Makes a simulator of the engine.
fn new(methods: i32, gravity: FarseerVector2) -> Outcome<PhysicsSimulator> {
    let gravity = gravity.finite("gravity")?;
    Ok(match choose("methods", methods, &[FarseerMethods::Faithful, FarseerMethods::Precise])? {
        FarseerMethods::Faithful => PhysicsSimulator::new(gravity)?,
        FarseerMethods::Precise => PhysicsSimulator::precise(gravity)?,
    })
}

/// Makes a simulator with methods, a FarseerMethods, and gravity in length units/s², y down. Null if refused:
/// farseer_last_error says why. End it with farseer_simulator_destroy.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_create(
    methods: i32,
    gravity: FarseerVector2,
) -> Option<Box<FarseerSimulator>> {
    let mut made = None;
    answer(|| {
        made = Some(Box::new(FarseerSimulator::new(new(methods, gravity)?)));
        Ok(())
    });
    made
}

/// Frees a simulator; null is ignored. No other call may use it, now or later.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_destroy(simulator: Option<Box<FarseerSimulator>>) {
    answer(|| {
        drop(simulator);
        Ok(())
    });
}

/// The methods of a simulator.
pub(crate) fn methods_of(simulator: &PhysicsSimulator) -> FarseerMethods {
    match simulator.methods() {
        Methods::Precise { .. } => FarseerMethods::Precise,
        _ => FarseerMethods::Faithful,
    }
}

/// Refuses a step that the engine would ignore. `dt`: s.
fn check_step(simulator: &PhysicsSimulator, dt: f32) -> Outcome {
    let dt = dt.finite("dt")?;
    if dt < 0.0 && methods_of(simulator) == FarseerMethods::Precise {
        return Err(Failure::invalid("dt", dt, "0 or more under the precise methods"));
    }
    if dt != 0.0 && !(1.0 / dt).is_finite() {
        return Err(Failure::invalid("dt", dt, "0, or a number whose reciprocal is finite"));
    }
    Ok(())
}

/// Advances the simulation by `dt` s. With 0, objects only enter and leave.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_update(simulator: Option<&FarseerSimulator>, dt: f32) -> FarseerStatus {
    with(simulator, |world| {
        check_step(&world.simulator, dt)?;
        world.simulator.update(dt);
        Ok(())
    })
}

/// Removes all objects; all ids go stale.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_clear(simulator: Option<&FarseerSimulator>) -> FarseerStatus {
    with(simulator, |world| {
        world.simulator.clear();
        Ok(())
    })
}

/// Writes the methods: a FarseerMethods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_methods(
    simulator: Option<&FarseerSimulator>,
    methods: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    write(simulator, "methods", methods, |world| Ok(methods_of(&world.simulator) as i32))
}
