//! Checks of behaviour chapter 12: controllers.

mod fluid_drag;
mod gravity;
mod inactivity;
mod scaling;
mod wave;

use conformance::fixtures::plane::{simulator, v};
use conformance::units::{assert_bits, floats};
use farseer_core::{
    Aabb, AabbFluidContainer, Body, BodyId, Controller, ControllerId, FluidContainerRef, FluidDragController,
    GeomPlacement, PhysicsSimulator, Vertices,
};

const DT: f32 = 1.0 / 60.0;

const OCTAGON: [(f32, f32); 8] = [
    (1.25, 0.0),
    (0.75, 0.75),
    (0.0, 1.25),
    (-0.75, 0.75),
    (-1.25, 0.0),
    (-0.75, -0.75),
    (0.0, -1.25),
    (0.75, -0.75),
];

fn bits(hex: u32) -> f32 {
    f32::from_bits(hex)
}

fn octagon() -> Vertices {
    OCTAGON.iter().map(|&(x, y)| v(x, y)).collect()
}

fn pool() -> FluidContainerRef {
    FluidContainerRef::Aabb(AabbFluidContainer::new(Aabb::new(v(-10.0, 0.0), v(10.0, 20.0))).unwrap())
}

fn add_controller(simulator: &mut PhysicsSimulator, controller: impl Into<Controller>) -> ControllerId {
    let controller = simulator.create_controller(controller).unwrap();
    simulator.add(controller).unwrap();
    controller
}

#[track_caller]
fn assert_motion(body: &Body, step: u32, expected: &str) {
    let (position, velocity) = (body.position(), body.linear_velocity());
    let actual = [position.x, position.y, body.rotation(), velocity.x, velocity.y, body.angular_velocity()];
    assert_bits(&actual, &floats(expected), || format!("step {step}"));
}

/// Steps a simulator, and compares a body with a table of steps and words.
fn follow(simulator: &mut PhysicsSimulator, body: BodyId, table: &[(u32, &str)]) {
    let last = table.last().unwrap().0;
    for step in 1..=last {
        simulator.update(DT);
        if let Some((_, words)) = table.iter().find(|row| row.0 == step) {
            assert_motion(&simulator[body], step, words);
        }
    }
}

/// The octagon of check 6, in the simulation without its geom, and a fluid that carries it.
fn floating(
    container: impl FnOnce(&mut PhysicsSimulator) -> FluidContainerRef,
) -> (PhysicsSimulator, BodyId) {
    let mut simulator = simulator(10.0);
    let container = container(&mut simulator);
    let body = simulator.create_body(Body::new());
    simulator.add(body).unwrap();
    simulator[body].set_mass(2.0).unwrap();
    simulator[body].set_moment_of_inertia(3.0).unwrap();
    simulator[body].set_position(v(1.0, -3.0));
    simulator[body].set_rotation(0.1);
    let geom = simulator.create_geom(body, octagon(), GeomPlacement::with_grid_size(0.5)).unwrap();
    let mut drag = FluidDragController::new(container, 0.8, 1.1, 0.5, v(0.0, 10.0)).unwrap();
    drag.add_geom(geom).unwrap();
    add_controller(&mut simulator, drag);
    (simulator, body)
}
