//! Prisms that roll along X from corner to corner over the ground and over platforms, as polygons of the plane do. Lengths in
//! px.

use std::f32::consts::TAU;

use conformance::fixtures::depth::{platform, set_platform_surface, set_surface, velocity};
use twohalf::{BodyId, DepthProfile, DepthScheme, TwoHalfPhysicsSimulator, Vector2, Vector3};
use twohalf_factories::{TwoHalfBodyFactory, TwoHalfGeomFactory};

#[derive(Debug, Clone, Copy)]
struct Prism {
    corners: usize,
    radius: f32,
    speed: f32,
    gravity: f32,
    rate: f32,
    /// Length in px of the platforms on which it rolls; 0 for the ground.
    tile: f32,
}

impl Prism {
    /// A prism on a corner, rolling to the right.
    fn world(&self) -> (TwoHalfPhysicsSimulator, BodyId) {
        let gravity = Vector2::new(0.0, self.gravity);
        let mut simulator = TwoHalfPhysicsSimulator::with_angle_and_gravity(600, 60, gravity).unwrap();
        simulator.set_depth_scheme(DepthScheme::Precise).unwrap();
        let count = if self.tile > 0.0 { 1 + (3000.0 / self.tile) as i32 } else { -1 };
        for at in -1..count {
            let part =
                platform(&mut simulator, [self.tile, 20.0, 200.0], [at as f32 * self.tile, -20.0, 0.0]);
            set_platform_surface(&mut simulator, part, 1.0, 0.0);
        }
        let outline: Vec<Vector2> = (0..self.corners)
            .map(|at| {
                let (sine, cosine) = (TAU * at as f32 / self.corners as f32).sin_cos();
                Vector2::new(self.radius * sine, self.radius * cosine)
            })
            .collect();
        let body = TwoHalfBodyFactory::create_polygon_body(&mut simulator, outline.clone(), 1.0).unwrap();
        let geom = TwoHalfGeomFactory::create_polygon_geom(&mut simulator, body, outline, 0.0).unwrap();
        simulator.set_depth_profile(geom, DepthProfile::Prism { depth: 20.0 }).unwrap();
        let mut view = simulator.body_mut(body).unwrap();
        view.core_mut().set_linear_drag_coefficient(0.0);
        view.core_mut().set_rotational_drag_coefficient(0.0);
        view.core_mut().set_angular_velocity(self.speed / self.radius);
        view.ground_mut().set_object_geom(geom, None).unwrap();
        view.set_position3d(Vector3::zeros());
        view.set_linear_velocity(Vector2::new(self.speed, 0.0));
        set_surface(&mut simulator, body, 1.0, 0.0);
        (simulator, body)
    }

    /// Kinetic and potential energy, 0 at rest on a corner.
    fn energy(&self, simulator: &TwoHalfPhysicsSimulator, body: BodyId) -> f32 {
        let view = simulator.body(body).unwrap();
        let core = view.core();
        // In the plane y points down; the platforms and the ground are at 0.
        let height = -core.position().y - self.radius;
        let moving = core.mass() * velocity(simulator, body).norm_squared();
        let turning = core.moment_of_inertia() * core.angular_velocity().powi(2);
        0.5 * (moving + turning) + core.mass() * self.gravity * height
    }
}

/// The law is derived in `core/precise_rolling.rs`.
fn assert_loses_what_its_corners_take(prism: &Prism) {
    let (mut simulator, body) = prism.world();
    let core = |simulator: &TwoHalfPhysicsSimulator| {
        let view = simulator.body(body).unwrap();
        let core = view.core();
        (core.mass(), core.moment_of_inertia(), core.total_rotation())
    };
    let (mass, inertia, _) = core(&simulator);
    let (square, corners) = (mass * prism.radius.powi(2), prism.corners as f32);
    let kept = (inertia + square * (TAU / corners).cos()) / (inertia + square);
    let lift = mass * prism.gravity * prism.radius * (1.0 - (0.5 * TAU / corners).cos());
    let on_edge = |simulator: &TwoHalfPhysicsSimulator| prism.energy(simulator, body) + lift;
    let first = on_edge(&simulator);
    for step in 1..=(10.0 * prism.rate) as usize {
        simulator.update(1.0 / prism.rate);
        let now = on_edge(&simulator);
        if now < 4.0 * lift {
            return;
        }
        let strikes = (core(&simulator).2 * corners / TAU + 0.5).floor();
        if step as f32 % prism.rate == 0.0 {
            let share = 0.5 * (first / now).ln() / (strikes * -kept.ln());
            assert!((0.95..1.05).contains(&share), "{prism:?}, step {step}: {share} of what corners take");
        }
    }
}

const PRISM: Prism = Prism { corners: 48, radius: 16.0, speed: 60.0, gravity: 900.0, rate: 60.0, tile: 0.0 };

#[test]
fn a_rolling_prism_loses_the_energy_of_its_corner_impacts() {
    for corners in [12, 24, 48, 96] {
        for (radius, speed) in [(8.0, 30.0), (16.0, 90.0), (64.0, 60.0)] {
            for tile in [0.0, 100.0, 5000.0] {
                for rate in [30.0, 60.0, 120.0] {
                    let prism = Prism { corners, radius, speed, rate, tile, ..PRISM };
                    assert_loses_what_its_corners_take(&prism);
                }
            }
        }
    }
}

#[test]
fn a_rolling_prism_never_gains_energy() {
    for corners in [6, 12, 48, 96] {
        for rate in [30.0, 60.0, 120.0] {
            for (radius, speed) in [(16.0, 200.0), (16.0, 60.0), (8.0, 30.0), (64.0, 400.0)] {
                for tile in [0.0, 100.0] {
                    let prism = Prism { corners, radius, speed, rate, tile, ..PRISM };
                    let (mut simulator, body) = prism.world();
                    let first = prism.energy(&simulator, body);
                    let lift = 0.02 * prism.gravity;
                    for step in 0..(4.0 * rate) as usize {
                        simulator.update(1.0 / rate);
                        let energy = prism.energy(&simulator, body);
                        assert!(energy < 1.003 * first + lift, "{prism:?}, step {step}: {energy} of {first}");
                    }
                }
            }
        }
    }
}
