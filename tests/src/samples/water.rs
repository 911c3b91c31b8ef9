//! A heap of blocks on a raft (behaviour chapter 16, section C.3).

use farseer_core::math::Vector2;
use farseer_core::shape::Vertices;
use farseer_core::{
    Context, ControllerId, ControllerKind, ControllerType, FluidContainerRef, FluidDragController, GeomId,
    PhysicsSimulator, Result, WaveController,
};

use super::scene::Known;
use super::{Actor, Pyramid, SCREEN, SampleScene, border, crate_box, pyramid};

/// Moves a wave that is not in the simulation.
#[derive(Debug, Clone)]
struct Surf(ControllerId);

impl Actor for Surf {
    fn before_step(&mut self, simulator: &mut PhysicsSimulator) -> Result<()> {
        simulator.controller_as_mut::<WaveController>(self.0)?.update(0.01)
    }
}

/// Disturbs the wave where a body dips in.
fn splash(
    known: &mut Known,
    context: &mut Context<'_>,
    drag: ControllerId,
    geom: GeomId,
    vertices: &Vertices,
) {
    let Some(body) = context.body_of(geom).and_then(|body| context.body(body)) else { return };
    let mass = body.mass();
    let splashes: Vec<_> = vertices
        .iter()
        .map(|&vertex| (vertex.x, body.get_velocity_at_world_point(vertex).y * mass / (100.0 * mass)))
        .collect();
    let Some(&wave) = known.waves.get(drag) else { return };
    let Some(wave) = context.controller_mut(wave).and_then(WaveController::of_mut) else { return };
    for (x, offset) in splashes {
        // Only values that are not finite are refused; this scene has none.
        wave.disturb(x, offset).ok();
    }
}

/// Water: ten blocks on a raft.
pub(super) fn water() -> Result<SampleScene> {
    let mut scene = SampleScene::new(250.0)?;
    let [width, height] = SCREEN;
    let margin = height * 0.05;
    let mut wave =
        WaveController::new(Vector2::new(margin, 500.0), width - 2.0 * margin, height - 500.0, 100)?;
    wave.set_damping_coefficient(0.98)?;
    wave.set_frequency(0.001)?;
    wave.set_wave_generator_max(20.0)?;
    let wave = scene.simulator.create_controller(wave)?;
    let weight = Vector2::new(0.0, 250.0);
    let mut drag = FluidDragController::new(FluidContainerRef::Wave(wave), 0.0040, 0.98, 0.002, weight)?;

    let (_, raft) = crate_box(&mut scene, 300.0, 20.0, Vector2::new(512.0, 500.0))?;
    drag.add_geom(raft)?;
    let heap = Pyramid {
        edge: 32.0,
        spacing: 32.0 / 3.0,
        mass: 3.0,
        friction: 0.2,
        rows: 4,
        origin: Vector2::new(448.0, 468.0),
    };
    for (_, block) in pyramid(&mut scene, heap)? {
        drag.add_geom(block)?;
    }
    let drag = scene.simulator.create_controller(drag)?;
    scene.simulator.add(drag)?;
    scene.known.waves.insert(drag, wave);
    scene.dispatch.on_fluid_entry(drag, splash);
    scene.act(Surf(wave));
    border(&mut scene)?;
    Ok(scene)
}

/// The wave that holds the first fluid of a scene, if there is one.
pub fn wave_of(simulator: &PhysicsSimulator) -> Option<&WaveController> {
    let containers = simulator.controller_list().iter().filter_map(|&id| match simulator[id].kind() {
        ControllerKind::FluidDrag(drag) => Some(drag.container()),
        _ => None,
    });
    let mut waves = containers.filter_map(|container| match container {
        FluidContainerRef::Wave(wave) => simulator.controller_as(wave).ok(),
        _ => None,
    });
    waves.next()
}
