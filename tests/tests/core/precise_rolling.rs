//! The precise set: polygons that roll from corner to corner gain no energy, and lose what their corners take. Lengths in px, y
//! down.

use std::f32::consts::TAU;

use farseer_core::math::Vector2;
use farseer_core::shape::Vertices;
use farseer_core::{BodyFactory, BodyId, GeomFactory, GeomPlacement, Methods, PhysicsSimulator};

fn v(x: f32, y: f32) -> Vector2 {
    Vector2::new(x, y)
}

fn regular(corners: usize, radius: f32) -> Vertices {
    (0..corners)
        .map(|at| {
            let (sine, cosine) = (TAU * at as f32 / corners as f32).sin_cos();
            v(radius * sine, radius * cosine)
        })
        .collect()
}

struct Rolling {
    corners: usize,
    radius: f32,
    speed: f32,
    gravity: f32,
    rate: f32,
    /// Of the ground, down in the direction of rolling, rad.
    slope: f32,
    mass: f32,
}

const LEVEL: Rolling =
    Rolling { corners: 48, radius: 16.0, speed: 200.0, gravity: 900.0, rate: 60.0, slope: 0.0, mass: 1.0 };

impl Rolling {
    /// A polygon on a corner, rolling to the right over level ground under gravity that is turned.
    fn world(&self) -> (PhysicsSimulator, BodyId) {
        let (sine, cosine) = self.slope.sin_cos();
        let mut simulator = PhysicsSimulator::new(v(self.gravity * sine, self.gravity * cosine)).unwrap();
        simulator.set_methods(Methods::PRECISE).unwrap();
        simulator.set_iterations(4);
        let ground = BodyFactory::create_rectangle_body_in(&mut simulator, 100.0, 100.0, 1.0).unwrap();
        simulator[ground].set_is_static(true);
        simulator[ground].set_position(v(0.0, 500.0));
        let placement = GeomPlacement::default();
        let floor =
            GeomFactory::create_rectangle_geom_in(&mut simulator, ground, 60_000.0, 1000.0, placement)
                .unwrap();
        let mut outline = regular(self.corners, self.radius);
        let body = BodyFactory::create_polygon_body_in(&mut simulator, &outline, self.mass).unwrap();
        let wheel =
            GeomFactory::create_polygon_geom_in(&mut simulator, body, &mut outline, GeomPlacement::default())
                .unwrap();
        for geom in [floor, wheel] {
            simulator[geom].set_friction_coefficient(1.0);
        }
        simulator[body].set_linear_drag_coefficient(0.0);
        simulator[body].set_rotational_drag_coefficient(0.0);
        simulator[body].set_position(v(0.0, -self.radius));
        simulator[body].set_linear_velocity(v(self.speed, 0.0));
        simulator[body].set_angular_velocity(self.speed / self.radius);
        (simulator, body)
    }

    /// Kinetic and potential energy, 0 at rest on a corner at the origin.
    fn energy(&self, simulator: &PhysicsSimulator, body: BodyId) -> f32 {
        let (body, (sine, cosine)) = (&simulator[body], self.slope.sin_cos());
        let moving = body.mass() * body.linear_velocity().norm_squared();
        let turning = body.moment_of_inertia() * body.angular_velocity().powi(2);
        let at = body.position();
        let height = -(at.y + self.radius) * cosine - at.x * sine;
        0.5 * (moving + turning) + body.mass() * self.gravity * height
    }

    fn assert_gains_nothing(&self, seconds: f32) {
        let (mut simulator, body) = self.world();
        let first = self.energy(&simulator, body);
        // A spring of a contact holds what has sunk by up to its sag.
        let lift = 0.02 * self.mass * self.gravity;
        for step in 0..(seconds * self.rate) as usize {
            simulator.update(1.0 / self.rate);
            let energy = self.energy(&simulator, body);
            let case =
                (self.corners, self.radius, self.speed, self.gravity, self.rate, self.slope, self.mass);
            assert!(energy < 1.003 * first.abs() + lift, "{case:?}, step {step}: {energy} of {first}");
        }
    }
}

#[test]
fn a_rolling_polygon_never_gains_energy() {
    for corners in [6, 12, 24, 48, 96] {
        for rate in [30.0, 60.0, 120.0] {
            for (radius, speed, gravity) in [
                (16.0, 200.0, 900.0),
                (16.0, 60.0, 900.0),
                (4.0, 45.0, 900.0),
                (64.0, 400.0, 2000.0),
                (4.0, 400.0, 300.0),
                (64.0, 20.0, 300.0),
            ] {
                Rolling { corners, radius, speed, gravity, rate, ..LEVEL }.assert_gains_nothing(4.0);
            }
        }
    }
}

#[test]
fn on_slopes_and_with_other_masses_it_gains_none_either() {
    for corners in [6, 24, 96] {
        for slope in [0.05, 0.2, -0.1] {
            for mass in [0.01, 1000.0] {
                Rolling { corners, slope, mass, speed: 90.0, ..LEVEL }.assert_gains_nothing(4.0);
            }
        }
    }
}

/// From corner to corner a wheel keeps its angular momentum about the new corner: I + m r^2 cos(2 pi / n) of I + m r^2.
#[test]
fn what_rolls_too_slowly_to_hop_loses_what_its_corners_take() {
    for (corners, radius, speed, gravity, rate) in [
        (48, 16.0, 90.0, 900.0, 60.0),
        (48, 16.0, 60.0, 900.0, 60.0),
        (24, 16.0, 90.0, 900.0, 60.0),
        (96, 16.0, 90.0, 900.0, 120.0),
        (48, 16.0, 90.0, 900.0, 120.0),
        (48, 64.0, 180.0, 900.0, 60.0),
        (24, 64.0, 200.0, 2000.0, 30.0),
    ] {
        let case = (corners, radius, speed, gravity, rate);
        let rolling = Rolling { corners, radius, speed, gravity, rate, ..LEVEL };
        let (mut simulator, body) = rolling.world();
        let kinetic = |simulator: &PhysicsSimulator| {
            let body = &simulator[body];
            body.mass() * body.linear_velocity().norm_squared()
                + body.moment_of_inertia() * body.angular_velocity().powi(2)
        };
        let (first, mut turned) = (kinetic(&simulator), 0.0);
        // Until it has 0.7 of its speed: at less it slows down and speeds up over each corner.
        while kinetic(&simulator) > 0.5 * first && turned < 100.0 {
            simulator.update(1.0 / rate);
            turned += simulator[body].angular_velocity() / rate;
        }
        let (mass, inertia) = (simulator[body].mass(), simulator[body].moment_of_inertia());
        let square = mass * radius * radius;
        let kept = (inertia + square * (TAU / corners as f32).cos()) / (inertia + square);
        let passed = turned * corners as f32 / TAU;
        let loss = 0.5 * (first / kinetic(&simulator)).ln() / passed;
        let share = loss / -kept.ln();
        assert!((0.8..1.2).contains(&share), "{case:?}: {share} of what the corners take");
    }
}

#[test]
fn a_wheel_that_is_restored_in_every_step_rolls_on_with_the_same_bits() {
    for corners in [6, 48] {
        let (mut plain, _) = Rolling { corners, speed: 120.0, ..LEVEL }.world();
        let (mut restored, _) = Rolling { corners, speed: 120.0, ..LEVEL }.world();
        for step in 0..240 {
            plain.update(1.0 / 60.0);
            restored.update(1.0 / 60.0);
            assert!(plain.snapshot() == restored.snapshot(), "{corners} corners, step {step}");
            let mut next = PhysicsSimulator::new(v(0.0, 1.0)).unwrap();
            next.restore(&restored.snapshot()).unwrap();
            restored = next;
        }
    }
}
