//! A world without physics, for tests that measures report its prescribed states.

use conformance::scene::{BodySpec, Scene};
use farseer_core::math::Vector2;
use measure::charts::{ChartScene, chart_scenes};
use measure::world::{BodyState, World};

/// A world with prescribed states, one per body. A step changes none of them.
pub(crate) struct PrescribedWorld(pub(crate) Vec<BodyState>);

impl World for PrescribedWorld {
    fn step(&mut self, _: f32) {}

    fn body(&self, index: usize) -> BodyState {
        self.0[index]
    }

    fn body_count(&self) -> usize {
        self.0.len()
    }

    fn set_velocity(&mut self, index: usize, velocity: [f64; 2], angular_velocity: f64) {
        self.0[index] = BodyState { velocity: flat(velocity), angular_velocity, ..self.0[index] };
    }

    fn apply_impulse(&mut self, _: usize, _: [f64; 2]) {}

    fn teleport(&mut self, index: usize, position: [f64; 2], angle: f64) {
        self.0[index] = BodyState { position: flat(position), angle, ..self.0[index] };
    }
}

/// Returns a position (px) or a velocity (px/s) in the plane, with 0 for Z.
pub(crate) fn flat([x, y]: [f64; 2]) -> [f64; 3] {
    [x, y, 0.0]
}

/// Returns the initial state of each body of a scene.
pub(crate) fn starts(scene: &Scene) -> Vec<BodyState> {
    let state = |body: &BodySpec| {
        let position = body.position.unwrap_or_else(Vector2::zeros);
        let velocity = body.settings.linear_velocity.unwrap_or_else(Vector2::zeros);
        BodyState {
            position: flat([position.x, position.y].map(f64::from)),
            angle: f64::from(body.rotation.unwrap_or(0.0)),
            velocity: flat([velocity.x, velocity.y].map(f64::from)),
            angular_velocity: 0.0,
        }
    };
    scene.bodies.iter().map(state).collect()
}

pub(crate) fn chart(name: &str) -> ChartScene {
    let scene = chart_scenes().into_iter().find(|scene| scene.name == name);
    scene.unwrap_or_else(|| panic!("there is no scene {name}"))
}

/// Runs the watch of the chart scene `name` on bodies that `law` moves, with a step of `dt` s, until the scene ends. Returns
/// the error in the scene's unit and the failure.
pub(crate) fn watched(
    name: &str,
    dt: f64,
    mut law: impl FnMut(f64, &mut [BodyState]),
) -> (f64, Option<&'static str>) {
    let chart = chart(name);
    let scene = (chart.build)(chart.sizes[0]);
    let mut watch = (chart.watch)(&scene);
    let mut world = PrescribedWorld(starts(&scene));
    watch.observe(0.0, &world);
    for step in 1..=(chart.seconds / dt).round() as u32 {
        let time = f64::from(step) * dt;
        law(time, &mut world.0);
        watch.observe(time, &world);
    }
    (watch.error(), watch.failed())
}

/// Asserts that bodies which move by `law` have an error of at most `tolerance`, in the unit of the scene `name`. `dt` in s.
pub(crate) fn assert_no_error(name: &str, dt: f64, tolerance: f64, law: impl FnMut(f64, &mut [BodyState])) {
    let (error, failed) = watched(name, dt, law);
    assert_eq!(failed, None, "{name}");
    assert!(error <= tolerance, "{name}: {error}");
}
