//! Advice on a scene in the format of the conformance tests.

use super::{Advice, Asked, advise};
use conformance::run::Run;
use conformance::scene::{NarrowPhase, Scene};
use farseer_core::math::Vector2;
use farseer_core::{Methods, PhysicsSimulator};

/// Returns the settings of [`advise`] that a scene implies: length unit, time step and iterations.
pub fn asked_of(scene: &Scene) -> Asked {
    let iterations = scene.simulator.solver.iterations.and_then(|count| u32::try_from(count).ok());
    let asked = Asked::default();
    Asked {
        seconds: f64::from(scene.dt) * f64::from(scene.steps),
        dt: scene.dt,
        iterations: iterations.unwrap_or(asked.iterations),
        ..asked
    }
}

/// Runs [`advise`] on a scene in the format of the conformance tests.
///
/// # Errors
///
/// [`advise`] fails, the scene cannot be built, or its script acts between updates.
pub fn advise_on(scene: &Scene, asked: &Asked) -> Result<Advice, String> {
    if !scene.script.is_empty() || scene.scaled_by.is_some() || scene.dt_real != 0.0 {
        return Err(format!(
            "{}: it has a script or scales its time: actions between updates cannot be repeated with other steps",
            scene.name
        ));
    }
    advise(asked, |methods| build(scene, methods))
}

fn build(scene: &Scene, methods: Methods) -> Result<PhysicsSimulator, String> {
    let mut scene = scene.clone();
    let is_faithful = matches!(methods, Methods::Faithful { .. });
    let narrow = if is_faithful { NarrowPhase::DistanceGrid } else { NarrowPhase::Sat };
    scene.simulator.narrow_phase = Some(narrow);
    let mut run = Run::build(&scene).map_err(|error| error.to_string())?;
    let empty = PhysicsSimulator::new(Vector2::zeros()).map_err(|error| error.to_string())?;
    Ok(std::mem::replace(run.simulator_mut(), empty))
}
