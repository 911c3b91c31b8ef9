//! Calls that set properties of controllers.

use farseer_core::{
    Aabb, AabbFluidContainer, Controller, ControllerId, FluidContainerRef, FluidDragController,
    GravityController, GravityType, InactivityController, PhysicsSimulator, ScalingController,
    WaveController,
};

use super::edits::Edit;
use super::pools::Pools;
use crate::random::Random;
use crate::shapes::step;

/// A function that changes an object at random, and that needs ids of other objects.
type EditWith<T> = fn(&mut T, &Pools, &mut Random);

pub(crate) const CONTROLLER_EDITS: &[Edit<Controller>] = &[
    |controller, random| controller.set_enabled(random.chance(80)),
    |controller, random| controller.set_tag(random.bits()),
];

const WAVE_EDITS: &[Edit<WaveController>] = &[
    |wave, random| drop(wave.set_position(random.vector(300.0))),
    |wave, random| drop(wave.set_node_count(random.count(2, 30).clamp(0, 10_000) as usize)),
    |wave, _| drop(wave.initialize()),
    |wave, random| {
        let nodes = random.below(40);
        drop(wave.set_x_position((0..nodes).map(|_| random.number(-300.0, 300.0)).collect()));
    },
    |wave, random| drop(wave.disturb(random.number(-300.0, 300.0), random.number(-20.0, 20.0))),
    |wave, random| drop(wave.update(step(random))),
    |wave, random| drop(wave.set_width(random.number(10.0, 600.0))),
    |wave, random| drop(wave.set_height(random.number(10.0, 600.0))),
    |wave, random| drop(wave.set_damping_coefficient(random.number(0.9, 1.0))),
    |wave, random| drop(wave.set_frequency(random.number(0.01, 1.0))),
    |wave, random| drop(wave.set_wave_generator_max(random.number(0.0, 10.0))),
    |wave, random| drop(wave.set_wave_generator_min(random.number(-10.0, 0.0))),
    |wave, random| drop(wave.set_wave_generator_step(random.number(0.0, 2.0))),
];

const FLUID_EDITS: &[EditWith<FluidDragController>] = &[
    |fluid, _, random| drop(fluid.set_density(random.number(0.0, 0.01))),
    |fluid, _, random| drop(fluid.set_linear_drag_coefficient(random.number(0.0, 5.0))),
    |fluid, _, random| drop(fluid.set_rotational_drag_coefficient(random.number(0.0, 5.0))),
    |fluid, _, random| drop(fluid.set_gravity(random.vector(200.0))),
    |fluid, pools, random| drop(fluid.add_geom(random.pick(&pools.geoms))),
    |fluid, pools, random| fluid.remove_geom(random.pick(&pools.geoms)),
    |fluid, _, _| fluid.reset(),
    |fluid, pools, random| fluid.set_container(container(pools, random)),
    |fluid, pools, random| {
        let (container, density) = (container(pools, random), random.number(0.0, 0.01));
        let (drag, turning) = (random.number(0.0, 5.0), random.number(0.0, 5.0));
        drop(fluid.initialize(container, density, drag, turning, random.vector(100.0)));
    },
];

const GRAVITY_EDITS: &[EditWith<GravityController>] = &[
    |gravity, _, random| {
        gravity.set_gravity_type(random.pick(&[GravityType::Linear, GravityType::DistanceSquared]));
    },
    |gravity, pools, random| {
        gravity.set_body_list((0..random.below(4)).map(|_| random.pick(&pools.bodies)).collect());
    },
    |gravity, _, random| {
        drop(gravity.set_point_list((0..random.below(4)).map(|_| random.vector(100.0)).collect()));
    },
];

const INACTIVITY_EDITS: &[Edit<InactivityController>] = &[
    |inactivity, random| drop(inactivity.set_activation_distance(random.number(0.0, 200.0))),
    |inactivity, random| drop(inactivity.set_max_idle_time(random.number(0.0, 2000.0))),
];

const SCALING_EDITS: &[Edit<ScalingController>] = &[
    |scaling, random| drop(scaling.set_update_interval(random.number(0.001, 0.1))),
    |scaling, random| drop(scaling.set_maximum_update_interval(random.number(0.001, 0.1))),
    |scaling, _| scaling.increase_update_interval(),
    |scaling, _| scaling.decrease_update_interval(),
    |scaling, random| {
        scaling.get_update_interval(step(random));
    },
    |scaling, random| scaling.update(step(random), step(random)),
];

/// Changes a property that only this kind of controllers has.
pub(super) fn edit_kind(
    simulator: &mut PhysicsSimulator,
    id: ControllerId,
    pools: &Pools,
    random: &mut Random,
) {
    if let Ok(wave) = simulator.controller_as_mut(id) {
        random.pick(WAVE_EDITS)(wave, random);
    } else if let Ok(fluid) = simulator.controller_as_mut(id) {
        random.pick(FLUID_EDITS)(fluid, pools, random);
    } else if let Ok(gravity) = simulator.controller_as_mut(id) {
        random.pick(GRAVITY_EDITS)(gravity, pools, random);
    } else if let Ok(inactivity) = simulator.controller_as_mut(id) {
        random.pick(INACTIVITY_EDITS)(inactivity, random);
    } else if let Ok(scaling) = simulator.controller_as_mut(id) {
        random.pick(SCALING_EDITS)(scaling, random);
    }
}

/// Returns a random fluid container of any kind.
pub(super) fn container(pools: &Pools, random: &mut Random) -> FluidContainerRef {
    match random.below(3) {
        0 => AabbFluidContainer::new(Aabb { min: random.vector(200.0), max: random.vector(400.0) })
            .map_or(FluidContainerRef::UserDefined, FluidContainerRef::Aabb),
        1 => FluidContainerRef::Wave(random.pick(&pools.controllers)),
        _ => FluidContainerRef::UserDefined,
    }
}
