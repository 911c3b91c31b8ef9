//! The precise set: polygons that roll from corner to corner gain no energy, and lose as much as the impacts of their corners
//! take. Lengths in px, y down.

use std::f32::consts::TAU;

use conformance::fixtures::plane::SOLVERS;
use farseer_core::math::Vector2;
use farseer_core::shape::Vertices;
use farseer_core::{
    BodyFactory, BodyId, GeomFactory, GeomPlacement, Methods, PhysicsSimulator, SpringFactory,
};

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
    /// Inclination of the ground in rad, positive downhill in the direction of rolling.
    slope: f32,
    mass: f32,
    friction: f32,
    /// Width of the tiles of the floor in px.
    tile: f32,
}

const LEVEL: Rolling = Rolling {
    corners: 48,
    radius: 16.0,
    speed: 200.0,
    gravity: 900.0,
    rate: 60.0,
    slope: 0.0,
    mass: 1.0,
    friction: 1.0,
    tile: 60_000.0,
};

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
        let mut geoms = Vec::new();
        for at in -2..(2000.0 / self.tile).clamp(1.0, 200.0) as i32 {
            let placement =
                GeomPlacement { offset: v(at as f32 * self.tile, 0.0), ..GeomPlacement::default() };
            let floor =
                GeomFactory::create_rectangle_geom_in(&mut simulator, ground, self.tile, 1000.0, placement);
            geoms.push(floor.unwrap());
        }
        let mut outline = regular(self.corners, self.radius);
        let body = BodyFactory::create_polygon_body_in(&mut simulator, &outline, self.mass).unwrap();
        let wheel =
            GeomFactory::create_polygon_geom_in(&mut simulator, body, &mut outline, GeomPlacement::default())
                .unwrap();
        geoms.push(wheel);
        for geom in geoms {
            simulator[geom].set_friction_coefficient(self.friction);
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
        // A contact spring carries a body that is deeper by up to its sag.
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
fn a_rolling_polygon_gains_no_energy_on_slopes_and_with_other_masses() {
    for corners in [6, 24, 96] {
        for slope in [0.05, 0.2, -0.1] {
            for mass in [0.01, 1000.0] {
                Rolling { corners, slope, mass, speed: 90.0, ..LEVEL }.assert_gains_nothing(4.0);
            }
        }
    }
}

/// Tracks a rolling polygon for 10 s, or until it has so little energy that it soon rocks.
///
/// From corner to corner a wheel keeps its angular momentum about the new corner. So each strike multiplies its spin by `(I + m
/// r^2 cos(2 pi / n)) / (I + m r^2)`. Between two strikes its energy is constant. So its kinetic energy when it lies on an edge
/// falls by the square of that factor at each strike.
fn assert_loses_what_its_corners_take(rolling: &Rolling) {
    let (mut simulator, body) = rolling.world();
    let (mass, inertia) = (simulator[body].mass(), simulator[body].moment_of_inertia());
    let (square, corners) = (mass * rolling.radius.powi(2), rolling.corners as f32);
    let kept = (inertia + square * (TAU / corners).cos()) / (inertia + square);
    let lift = mass * rolling.gravity * rolling.radius * (1.0 - (0.5 * TAU / corners).cos());
    let on_edge = |simulator: &PhysicsSimulator| rolling.energy(simulator, body) + lift;
    let first = on_edge(&simulator);
    for step in 1..=(10.0 * rolling.rate) as usize {
        simulator.update(1.0 / rolling.rate);
        let now = on_edge(&simulator);
        if now < 4.0 * lift {
            return;
        }
        let strikes = (simulator[body].total_rotation() * corners / TAU + 0.5).floor();
        if step as f32 % rolling.rate == 0.0 {
            let share = 0.5 * (first / now).ln() / (strikes * -kept.ln());
            let Rolling { corners, radius, speed, gravity, rate, tile, .. } = rolling;
            let case = (corners, radius, speed, gravity, rate, tile, step);
            // Measured: 0.98 to 1.02.
            assert!((0.95..1.05).contains(&share), "{case:?}: {share} of what the corners take");
        }
    }
}

#[test]
fn a_rolling_polygon_that_does_not_hop_loses_the_energy_of_its_corner_impacts() {
    for corners in [12, 16, 24, 48, 96] {
        for radius in [8.0_f32, 16.0, 64.0] {
            for (gravity, rate) in [(900.0_f32, 30.0), (900.0, 60.0), (200.0, 120.0), (2000.0, 60.0)] {
                for part in [0.25_f32, 0.75] {
                    let speed = part * (gravity * radius).sqrt();
                    let rolling = Rolling { corners, radius, speed, gravity, rate, ..LEVEL };
                    assert_loses_what_its_corners_take(&rolling);
                }
            }
        }
    }
}

#[test]
fn a_rolling_polygon_loses_no_more_on_flush_tiles_than_on_one_floor() {
    for (corners, tile) in [(24, 32.0), (48, 32.0), (96, 32.0), (48, 100.0), (96, 7.0)] {
        for (radius, speed) in [(16.0, 90.0), (64.0, 60.0), (8.0, 40.0)] {
            for rate in [30.0, 60.0] {
                assert_loses_what_its_corners_take(&Rolling { corners, radius, speed, rate, tile, ..LEVEL });
            }
        }
    }
}

#[test]
fn mass_and_friction_have_no_effect_on_rolling_without_slip() {
    for (mass, friction) in [(0.01, 1.0), (1000.0, 1.0), (1.0, 0.3), (50.0, 0.5)] {
        for corners in [16, 48] {
            assert_loses_what_its_corners_take(&Rolling { corners, mass, friction, speed: 80.0, ..LEVEL });
        }
    }
}

#[test]
fn a_wheel_that_is_restored_in_every_step_rolls_on_with_the_same_bits() {
    for (corners, speed, tile) in
        [(6, 120.0, 60_000.0), (48, 120.0, 60_000.0), (48, 60.0, 32.0), (16, 80.0, 32.0)]
    {
        let rolling = Rolling { corners, speed, tile, ..LEVEL };
        let (mut plain, _) = rolling.world();
        let (mut restored, _) = rolling.world();
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

#[test]
fn separations_of_a_rolling_polygon_do_not_depend_on_other_bodies() {
    for corners in [6, 16] {
        let rolling = Rolling { corners, speed: 120.0, ..LEVEL };
        let [(mut alone, wheel), (mut beside, _)] = [rolling.world(), rolling.world()];
        // One geom that may bounce, far away, makes contacts go through all substeps.
        let ball = BodyFactory::create_circle_body_in(&mut beside, 5.0, 1.0).unwrap();
        let geom =
            GeomFactory::create_circle_geom_in(&mut beside, ball, 5.0, 12, GeomPlacement::default()).unwrap();
        beside[geom].set_restitution_coefficient(0.5);
        beside[ball].set_position(v(-900.0, -90_000.0));
        for step in 0..120 {
            let speed_before = alone[wheel].angular_velocity();
            alone.update(1.0 / 60.0);
            beside.update(1.0 / 60.0);
            assert_eq!(alone[wheel].position(), beside[wheel].position(), "{corners} corners, step {step}");
            let [one, other] = [&alone, &beside].map(|simulator| simulator.contacts_of(wheel));
            assert_eq!(one.len(), other.len(), "{corners} corners, step {step}");
            // The closed form turns the arm of a point at once, to the first order; substeps turn it in four parts. Where the speed
            // changes by more than a tenth, a corner has struck within the step.
            let speed = speed_before.max(alone[wheel].angular_velocity());
            if (alone[wheel].angular_velocity() - speed_before).abs() > 0.1 * speed {
                continue;
            }
            let angle = 1.1 * speed / 60.0;
            let bound = 0.5 * angle * angle * rolling.radius;
            for (one, other) in one.iter().zip(&other) {
                let difference = (one.separation - other.separation).abs();
                assert!(difference <= bound, "{corners} corners, step {step}: {difference}, {bound}");
            }
        }
    }
}

#[test]
fn a_spring_at_a_rolling_polygon_turns_it_round() {
    for choice in SOLVERS {
        let rolling = Rolling { speed: 100.0, ..LEVEL };
        let (mut simulator, wheel) = rolling.world();
        simulator.set_solver_choice(choice);
        let stiffness = 30.0;
        let at = simulator[wheel].position();
        SpringFactory::create_fixed_linear_spring_in(&mut simulator, wheel, v(0.0, 0.0), at, stiffness, 0.0)
            .unwrap();
        let mut farthest = 0.0_f32;
        for _ in 0..120 {
            simulator.update(1.0 / 60.0);
            farthest = farthest.max(simulator[wheel].position().x);
        }
        // A disc that rolls without slip has 1.5 times its mass: the amplitude is v / w with w^2 = k / (1.5 m). Impacts of corners
        // take energy, so it may be smaller.
        let amplitude = rolling.speed * (1.5 * rolling.mass / stiffness).sqrt();
        assert!(
            farthest < 1.02 * amplitude && farthest > 0.8 * amplitude,
            "{choice:?}: {farthest} {amplitude}"
        );
    }
}
