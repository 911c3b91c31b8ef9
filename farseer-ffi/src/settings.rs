//! Settings of a simulator.

use std::mem::MaybeUninit;

use farseer_core::{BroadPhaseCollider, Error, FrictionType, Methods, NarrowPhaseCollider, PhysicsSimulator};

use crate::arguments::{FarseerVector2, Finite, choose, flag};
use crate::failure::{FarseerStatus, Outcome};
use crate::guard::{FarseerSimulator, with, write};
use crate::simulator::{FarseerMethods, methods_of};

/// Which pairs may touch: the broad phase of the faithful methods. All four find the same pairs, in other orders.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FarseerBroadPhase {
    /// Sweeps along the better axis. The default.
    SelectiveSweep = 0,
    /// Sorted lists that are kept from update to update.
    SweepAndPrune = 1,
    /// Tests all pairs.
    BruteForce = 2,
    /// A hashed grid, whose cells follow the sizes of the geoms.
    SpatialHash = 3,
}

/// Where pairs touch: the narrow phase of the faithful methods.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FarseerNarrowPhase {
    /// A grid of distances for each outline. The default.
    DistanceGrid = 0,
    /// Separating axes, for convex outlines.
    Sat = 1,
}

/// The friction coefficient of a pair.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FarseerFriction {
    /// The mean of both coefficients. The default.
    Average = 0,
    /// The smaller coefficient.
    Minimum = 1,
}

/// Changes a setting.
fn set(
    simulator: Option<&FarseerSimulator>,
    change: impl FnOnce(&mut PhysicsSimulator) -> Outcome,
) -> FarseerStatus {
    with(simulator, |world| change(&mut world.simulator))
}

/// Writes the gravity in length units/s².
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_gravity(
    simulator: Option<&FarseerSimulator>,
    gravity: Option<&mut MaybeUninit<FarseerVector2>>,
) -> FarseerStatus {
    write(simulator, "gravity", gravity, |world| Ok(world.simulator.gravity().into()))
}

/// Sets the gravity in length units/s², y down.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_set_gravity(
    simulator: Option<&FarseerSimulator>,
    gravity: FarseerVector2,
) -> FarseerStatus {
    set(simulator, |simulator| {
        simulator.set_gravity(gravity.finite("gravity")?)?;
        Ok(())
    })
}

/// Writes whether updates move bodies: 0 or 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_enabled(
    simulator: Option<&FarseerSimulator>,
    enabled: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    write(simulator, "enabled", enabled, |world| Ok(world.simulator.enabled().into()))
}

/// Sets whether updates move bodies: 0 or 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_set_enabled(
    simulator: Option<&FarseerSimulator>,
    enabled: i32,
) -> FarseerStatus {
    set(simulator, |simulator| {
        simulator.set_enabled(flag("enabled", enabled)?);
        Ok(())
    })
}

/// Writes the number of iterations, or of substeps of the precise methods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_iterations(
    simulator: Option<&FarseerSimulator>,
    iterations: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    write(simulator, "iterations", iterations, |world| Ok(world.simulator.iterations()))
}

/// Sets the number of iterations, or of substeps of the precise methods. 5 for faithful, 4 for precise simulators.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_set_iterations(
    simulator: Option<&FarseerSimulator>,
    iterations: i32,
) -> FarseerStatus {
    set(simulator, |simulator| {
        simulator.set_iterations(iterations);
        Ok(())
    })
}

/// Writes the fraction of the penetration that an update corrects.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_bias_factor(
    simulator: Option<&FarseerSimulator>,
    bias_factor: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    write(simulator, "bias_factor", bias_factor, |world| Ok(world.simulator.bias_factor()))
}

/// Sets the fraction of the penetration that an update corrects. Default 0.8.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_set_bias_factor(
    simulator: Option<&FarseerSimulator>,
    bias_factor: f32,
) -> FarseerStatus {
    set(simulator, |simulator| {
        simulator.set_bias_factor(bias_factor.finite("bias_factor")?)?;
        Ok(())
    })
}

/// Writes the penetration in length units that is not corrected.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_allowed_penetration(
    simulator: Option<&FarseerSimulator>,
    allowed_penetration: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    write(simulator, "allowed_penetration", allowed_penetration, |world| {
        Ok(world.simulator.allowed_penetration())
    })
}

/// Sets the penetration in length units that is not corrected. Default 0.05.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_set_allowed_penetration(
    simulator: Option<&FarseerSimulator>,
    allowed_penetration: f32,
) -> FarseerStatus {
    set(simulator, |simulator| {
        simulator.set_allowed_penetration(allowed_penetration.finite("allowed_penetration")?)?;
        Ok(())
    })
}

/// Writes the maximum number of contacts of a pair that are found.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_max_contacts_to_detect(
    simulator: Option<&FarseerSimulator>,
    max_contacts_to_detect: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    write(simulator, "max_contacts_to_detect", max_contacts_to_detect, |world| {
        Ok(world.simulator.max_contacts_to_detect())
    })
}

/// Sets the maximum number of contacts of a pair that are found. Default 10.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_set_max_contacts_to_detect(
    simulator: Option<&FarseerSimulator>,
    max_contacts_to_detect: i32,
) -> FarseerStatus {
    set(simulator, |simulator| {
        simulator.set_max_contacts_to_detect(max_contacts_to_detect);
        Ok(())
    })
}

/// Writes the maximum number of contacts of a pair that are solved.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_max_contacts_to_resolve(
    simulator: Option<&FarseerSimulator>,
    max_contacts_to_resolve: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    write(simulator, "max_contacts_to_resolve", max_contacts_to_resolve, |world| {
        Ok(world.simulator.max_contacts_to_resolve())
    })
}

/// Sets the maximum number of contacts of a pair that are solved. Default 4.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_set_max_contacts_to_resolve(
    simulator: Option<&FarseerSimulator>,
    max_contacts_to_resolve: i32,
) -> FarseerStatus {
    set(simulator, |simulator| {
        simulator.set_max_contacts_to_resolve(max_contacts_to_resolve)?;
        Ok(())
    })
}

/// Writes whether bodies at rest fall asleep: 0 or 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_sleep_enabled(
    simulator: Option<&FarseerSimulator>,
    sleep_enabled: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    write(simulator, "sleep_enabled", sleep_enabled, |world| Ok(world.simulator.is_sleep_enabled().into()))
}

/// Sets whether bodies at rest fall asleep under the precise methods: 0 or 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_set_sleep_enabled(
    simulator: Option<&FarseerSimulator>,
    sleep_enabled: i32,
) -> FarseerStatus {
    set(simulator, |simulator| {
        simulator.set_sleep_enabled(flag("sleep_enabled", sleep_enabled)?);
        Ok(())
    })
}

/// Sets how the coefficients of two geoms become one: a FarseerFriction.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_set_friction_type(
    simulator: Option<&FarseerSimulator>,
    friction_type: i32,
) -> FarseerStatus {
    set(simulator, |simulator| {
        let choices = [FrictionType::Average, FrictionType::Minimum];
        simulator.set_friction_type(choose("friction_type", friction_type, &choices)?);
        Ok(())
    })
}

/// Sets the broad phase of the faithful methods: a FarseerBroadPhase. Refused once there are geoms.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_set_broad_phase(
    simulator: Option<&FarseerSimulator>,
    broad_phase: i32,
) -> FarseerStatus {
    set(simulator, |simulator| {
        let choices = [
            BroadPhaseCollider::SelectiveSweep,
            BroadPhaseCollider::SweepAndPrune,
            BroadPhaseCollider::BruteForce,
            BroadPhaseCollider::SPATIAL_HASH,
        ];
        Ok(simulator.set_broad_phase_collider(choose("broad_phase", broad_phase, &choices)?)?)
    })
}

/// Sets the narrow phase of the faithful methods: a FarseerNarrowPhase. Set it before geoms are made.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_set_narrow_phase(
    simulator: Option<&FarseerSimulator>,
    narrow_phase: i32,
) -> FarseerStatus {
    set(simulator, |simulator| {
        if methods_of(simulator) == FarseerMethods::Precise {
            return Err(Error::NotSupported { what: "narrow phase", methods: "precise" }.into());
        }
        let choices = [NarrowPhaseCollider::DistanceGrid, NarrowPhaseCollider::Sat];
        simulator.set_narrow_phase_collider(choose("narrow_phase", narrow_phase, &choices)?);
        Ok(())
    })
}

/// Sets the size of the objects that a player looks at, in length units, under the precise methods: 32 for games in px, 1 for
/// games in metres. Default 32.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_set_length_unit(
    simulator: Option<&FarseerSimulator>,
    length_unit: f32,
) -> FarseerStatus {
    set(simulator, |simulator| {
        if methods_of(simulator) == FarseerMethods::Faithful {
            return Err(Error::NotSupported { what: "length unit", methods: "faithful" }.into());
        }
        Ok(simulator.set_methods(Methods::Precise { length_unit: length_unit.finite("length_unit")? })?)
    })
}

/// Bounds the speed of bodies under the precise methods, in length units/s, > 0.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_set_largest_speed(
    simulator: Option<&FarseerSimulator>,
    largest_speed: f32,
) -> FarseerStatus {
    set(simulator, |simulator| Ok(simulator.set_largest_speed(Some(largest_speed))?))
}

/// Sets the speed in length units/s from which on a touch is a hit under the precise methods.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_set_hit_speed(
    simulator: Option<&FarseerSimulator>,
    hit_speed: f32,
) -> FarseerStatus {
    set(simulator, |simulator| Ok(simulator.set_hit_speed(hit_speed)?))
}
