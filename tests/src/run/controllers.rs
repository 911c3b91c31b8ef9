//! Controllers of a scene.

use super::{AtPlace, Run};
use crate::scene::{
    At, ControllerKind, ControllerSpec, FluidContainer, FluidDragSpec, GravityLaw, GravitySpec,
    ScalingChange, SceneError, WaveSpec,
};
use farseer_core::{
    Aabb, AabbFluidContainer, Controller, ControllerId, FluidContainerRef, FluidDragController,
    GravityController, GravityType, InactivityController, ScalingController, WaveController,
};

type Result<T> = std::result::Result<T, SceneError>;

/// Creates a controller, configures it and adds it unless the scene says otherwise.
pub(super) fn create_controller(run: &mut Run<'_>, spec: &ControllerSpec, at: At<'_>) -> Result<()> {
    let mut controller = controller(run, &spec.kind, at)?;
    if let Some(enabled) = spec.enabled {
        controller.set_enabled(enabled);
    }
    let controller = run.simulator.create_controller(controller).at(at)?;
    run.controllers.push(controller);
    run.log.know_controller(controller);
    if spec.in_simulation { run.simulator.add(controller).at(at) } else { Ok(()) }
}

fn controller(run: &Run<'_>, kind: &ControllerKind, at: At<'_>) -> Result<Controller> {
    Ok(match *kind {
        ControllerKind::FluidDrag { ref fluid } => fluid_drag(run, fluid, at)?.into(),
        ControllerKind::Gravity { ref gravity } => self::gravity(run, gravity, at)?.into(),
        ControllerKind::Inactivity { activation_distance, max_idle_time } => {
            let mut controller = InactivityController::new();
            controller.set_activation_distance(activation_distance).at(at.key("activation_distance"))?;
            controller.set_max_idle_time(max_idle_time).at(at.key("max_idle_time"))?;
            controller.into()
        }
        ControllerKind::Wave { ref wave } => self::wave(wave, at)?.into(),
        ControllerKind::Scaling { preferred_interval, maximum_interval } => {
            ScalingController::new(preferred_interval, maximum_interval).at(at)?.into()
        }
    })
}

fn fluid_drag(run: &Run<'_>, fluid: &FluidDragSpec, at: At<'_>) -> Result<FluidDragController> {
    let container = match fluid.container {
        FluidContainer::Box(ref corners) => {
            let corners = Aabb { min: corners.min, max: corners.max };
            FluidContainerRef::Aabb(AabbFluidContainer::new(corners).at(at.key("container"))?)
        }
        FluidContainer::Wave(wave) => FluidContainerRef::Wave(run.controller(wave, at.key("wave"))?),
    };
    let FluidDragSpec { density, linear_drag, rotational_drag, gravity, .. } = *fluid;
    let mut controller =
        FluidDragController::new(container, density, linear_drag, rotational_drag, gravity).at(at)?;
    for (index, &geom) in fluid.geoms.iter().enumerate() {
        let place = at.key("geoms");
        let place = place.item(index);
        controller.add_geom(run.geom(geom, place)?).at(place)?;
    }
    Ok(controller)
}

fn gravity(run: &Run<'_>, spec: &GravitySpec, at: At<'_>) -> Result<GravityController> {
    let list = at.key("bodies");
    let bodies = spec.bodies.iter().flatten().enumerate();
    let bodies: Result<Vec<_>> = bodies.map(|(index, &body)| run.body(body, list.item(index))).collect();
    let points = spec.points.clone().unwrap_or_default();
    let mut controller = GravityController::new(bodies?, points, spec.strength, spec.radius).at(at)?;
    if let Some(law) = spec.gravity_type {
        controller.set_gravity_type(match law {
            GravityLaw::Linear => GravityType::Linear,
            GravityLaw::DistanceSquared => GravityType::DistanceSquared,
        });
    }
    Ok(controller)
}

fn wave(spec: &WaveSpec, at: At<'_>) -> Result<WaveController> {
    let count = at.key("node_count");
    let nodes =
        usize::try_from(spec.node_count).map_err(|error| SceneError::format(count, error.to_string()))?;
    let mut wave = WaveController::new(spec.position, spec.width, spec.height, nodes).at(at)?;
    wave.set_damping_coefficient(spec.damping_coefficient).at(at.key("damping_coefficient"))?;
    wave.set_frequency(spec.frequency).at(at.key("frequency"))?;
    wave.set_wave_generator_max(spec.generator_max).at(at.key("generator_max"))?;
    wave.set_wave_generator_min(spec.generator_min).at(at.key("generator_min"))?;
    wave.set_wave_generator_step(spec.generator_step).at(at.key("generator_step"))?;
    Ok(wave)
}

/// Disturbs the surface of a wave controller.
pub(super) fn disturb_wave(run: &mut Run<'_>, index: usize, x: f32, offset: f32, at: At<'_>) -> Result<()> {
    let id = run.controller(index, at.key("controller"))?;
    run.simulator.controller_as_mut::<WaveController>(id).at(at)?.disturb(x, offset).at(at)
}

/// The fluid of a script entry.
pub(super) fn fluid<'r>(
    run: &'r mut Run<'_>,
    index: usize,
    at: At<'_>,
) -> Result<&'r mut FluidDragController> {
    let id = run.controller(index, at.key("controller"))?;
    run.simulator.controller_as_mut(id).at(at)
}

/// Changes a scaling controller.
pub(super) fn set_scaling(run: &mut Run<'_>, index: usize, change: &ScalingChange, at: At<'_>) -> Result<()> {
    let id = run.controller(index, at.key("controller"))?;
    let controller = run.simulator.controller_as_mut::<ScalingController>(id).at(at)?;
    if let Some(interval) = change.maximum_interval {
        controller.set_maximum_update_interval(interval).at(at.key("maximum_interval"))?;
    }
    if let Some(interval) = change.update_interval {
        controller.set_update_interval(interval).at(at.key("update_interval"))?;
    }
    (0..change.increase).for_each(|_| controller.increase_update_interval());
    (0..change.decrease).for_each(|_| controller.decrease_update_interval());
    Ok(())
}

/// The scaling controller that decides the time step of a scene.
pub(super) fn scaled_by(run: &Run<'_>) -> Result<Option<ControllerId>> {
    let root = At::Root;
    let at = root.key("scaled_by");
    let Some(index) = run.scene.scaled_by else { return Ok(None) };
    let id = run.controller(index, at)?;
    run.simulator.controller_as::<ScalingController>(id).at(at)?;
    Ok(Some(id))
}
