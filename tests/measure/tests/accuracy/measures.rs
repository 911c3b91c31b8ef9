//! Tests that the measures of the chart are correct where there is a law of motion. Bodies that move by the law have no error,
//! and bodies that differ from it by a known amount have an error of that amount.

use crate::common::told::{assert_no_error, chart, flat, starts, watched};
use approx::assert_relative_eq;
use conformance::scene::JointKind;
use measure::closed_forms::{
    SteppedThrow, after_hit, apex, normal_of_oblique_hit, pendulum_period, stopping_distance, thrown,
};
use measure::method::{Effort, Family, Setting, methods};
use measure::world::{BodyState, masses};
use std::f64::consts::{PI, TAU};

/// Gravity of the scenes, px/s².
const GRAVITY: f64 = 320.0;

#[test]
fn a_throw_by_the_continuous_law_has_no_error_against_it() {
    let starts = starts(&(chart("throw_continuous_law").build)(0));
    assert_no_error("throw_continuous_law", 0.01, 1e-9, |time, states| {
        for (index, rate) in [0.0, 0.5].into_iter().enumerate() {
            let start = starts[index];
            states[index].position = flat(thrown(
                start.position_in_plane(),
                [start.velocity[0], start.velocity[1]],
                GRAVITY,
                rate,
                time,
            ));
        }
    });
}

#[test]
fn a_throw_by_the_discrete_law_has_no_error_against_it_and_half_a_step_of_falling_against_the_other() {
    let dt = 0.01;
    let mut laws = Vec::new();
    let mut law = |_: f64, states: &mut [BodyState]| {
        if laws.is_empty() {
            let law = |(start, rate): (&BodyState, f64)| SteppedThrow {
                position: start.position_in_plane(),
                velocity: [start.velocity[0], start.velocity[1]],
                gravity: GRAVITY,
                rate,
            };
            laws = states.iter().zip([0.0, 0.5]).map(law).collect();
        }
        for (law, state) in laws.iter_mut().zip(states) {
            law.step(dt);
            state.position = flat(law.position);
        }
    };
    assert_no_error("throw_discrete_law", dt, 1e-9, &mut law);
    laws.clear();
    let law = |time: f64, states: &mut [BodyState]| {
        // n steps fall by g dt^2 n (n + 1) / 2, which is g dt t / 2 more than the parabola.
        let excess = GRAVITY * dt * time / 2.0;
        let start = [0.0, 0.0];
        states[0].position = flat(thrown(start, [200.0, -300.0], GRAVITY, 0.0, time));
        states[0].position[1] += excess;
        states[1].position = flat(thrown([0.0, 1000.0], [200.0, -300.0], GRAVITY, 0.5, time));
    };
    let (error, _) = watched("throw_continuous_law", dt, law);
    assert_relative_eq!(error, GRAVITY * dt * 2.0 / 2.0, max_relative = 1e-9);
}

#[test]
fn little_drag_is_nearly_no_drag() {
    let [with, without] = [1e-9, 0.0].map(|rate| thrown([1.0, 2.0], [30.0, -40.0], GRAVITY, rate, 2.0));
    assert_relative_eq!(with[0], without[0], max_relative = 1e-6);
    assert_relative_eq!(with[1], without[1], max_relative = 1e-6);
}

#[test]
fn the_stepped_throw_nears_the_continuous_one() {
    let mut law =
        SteppedThrow { position: [0.0, 0.0], velocity: [200.0, -300.0], gravity: GRAVITY, rate: 0.5 };
    (0..200_000).for_each(|_| law.step(1e-5));
    let exact = thrown([0.0, 0.0], [200.0, -300.0], GRAVITY, 0.5, 2.0);
    // The stepped throw differs from the continuous one by about g t dt / 2.
    assert_relative_eq!(law.position[0], exact[0], epsilon = 1e-2);
    assert_relative_eq!(law.position[1], exact[1], epsilon = 1e-2);
}

/// Returns the height above the ground, in px, of a ball at a `time` in s. The ball falls from the height `fall` and bounces.
fn bouncing(fall: f64, time: f64, restitution: f64) -> f64 {
    let landing = (2.0 * fall / GRAVITY).sqrt();
    let (mut bounce, mut rest) = (0, time - landing);
    if rest < 0.0 {
        return fall - GRAVITY * time * time / 2.0;
    }
    loop {
        let speed = GRAVITY * landing * restitution.powi(bounce + 1);
        let flight = 2.0 * speed / GRAVITY;
        if flight < 1e-9 {
            return 0.0;
        }
        if rest < flight {
            return speed * rest - GRAVITY * rest * rest / 2.0;
        }
        (rest, bounce) = (rest - flight, bounce + 1);
    }
}

/// Returns body index and height of fall, in px, of each of eight balls. Body 0 is the ground.
fn falls() -> impl Iterator<Item = (usize, f64)> {
    (0..8).map(|ball| (ball + 1, GRAVITY / 2.0 * (1.0 + 0.0237 * (ball as f64 + 0.5)).powi(2)))
}

/// Sets the positions of all balls to those of the law of bouncing at a `time` in s.
fn bounce_all(time: f64, states: &mut [BodyState], restitution: f64) {
    for (index, fall) in falls() {
        states[index].position[1] = -16.0 - bouncing(fall, time, restitution);
    }
}

#[test]
fn the_balls_that_bounce_start_as_high_as_they_fall() {
    let states = starts(&(chart("bounce_restitution_1").build)(0));
    assert_eq!(states.len(), 9);
    for (index, fall) in falls() {
        assert_relative_eq!(-16.0 - states[index].position[1], fall, epsilon = 1e-4);
    }
}

#[test]
fn a_ball_that_bounces_by_the_law_has_no_error() {
    for (name, restitution) in
        [("bounce_restitution_0", 0.0), ("bounce_restitution_half", 0.5), ("bounce_restitution_1", 1.0)]
    {
        // No step is exactly at the apex: the measured height is at most g dt^2 / 8 too low.
        let dt = 1.0 / 960.0;
        assert_no_error(name, dt, GRAVITY * dt * dt / 8.0 + 1e-9, |time, states| {
            bounce_all(time, states, restitution);
        });
    }
}

#[test]
fn ten_thousand_steps_of_bouncing_by_the_law_keep_the_height() {
    // The tolerance is the difference between the apex and the nearest step, g dt^2 / 8, in percent of an apex of 164 px.
    assert_no_error("bounce_10000_steps", 1.0 / 60.0, 0.007, |time, states| bounce_all(time, states, 1.0));
}

#[test]
fn the_worst_ball_counts() {
    for (worst, fall) in falls() {
        let (error, failed) = watched("bounce_10000_steps", 1.0 / 60.0, |time, states| {
            bounce_all(time, states, 1.0);
            states[worst].position[1] = -16.0 - bouncing(0.8 * fall, time, 1.0);
        });
        assert_eq!(failed, None);
        // The nearest step is 0.011 px below an apex of 131 px, which is less than a hundredth of a percent.
        assert_relative_eq!(error, 20.0, epsilon = 0.01);
    }
}

#[test]
fn a_ball_that_bounces_ever_higher_has_gained_energy() {
    let gaining = |gain: f64| {
        watched("bounce_10000_steps", 1.0 / 60.0, move |time, states| {
            bounce_all(time, states, 1.0);
            let (index, fall) = falls().nth(2).expect("there is a third ball");
            states[index].position[1] = -16.0 - bouncing(fall, time, 1.0) * (1.0 + gain);
        })
    };
    assert_eq!(gaining(0.11), (f64::INFINITY, Some("gained energy")));
    let (error, failed) = gaining(0.09);
    assert_eq!(failed, None);
    assert_relative_eq!(error, 9.0, epsilon = 0.01);
}

#[test]
fn a_ball_that_bounces_less_often_than_it_should_has_stopped() {
    for (name, restitution, bounces) in [
        ("bounce_restitution_1", 1.0, 5),
        ("bounce_restitution_half", 0.5, 2),
        ("bounce_10000_steps", 1.0, 65),
    ] {
        // Time in s at which the ball that starts highest lands.
        let landing = 1.0 + 0.0237 * 7.5;
        let ends = |bounces: i32| {
            let flights = (1..=bounces).map(|bounce| 2.0 * landing * f64::powi(restitution, bounce));
            landing + flights.sum::<f64>()
        };
        // The last ball moves by the law for this number of bounces, and then lies on the ground.
        let stopping = |bounces: i32| {
            watched(name, 1.0 / 120.0, |time, states| {
                bounce_all(time, states, restitution);
                if time > ends(bounces) {
                    states[8].position[1] = -16.0;
                }
            })
        };
        assert_eq!(stopping(bounces - 1), (f64::INFINITY, Some("stopped")), "{name}");
        assert_eq!(stopping(bounces).1, None, "{name}");
    }
}

#[test]
fn each_apex_has_the_square_of_the_restitution_of_the_one_before() {
    assert_relative_eq!(apex(160.0, 0.5, 1), 40.0);
    assert_relative_eq!(apex(160.0, 0.5, 2), 10.0);
    assert_relative_eq!(apex(160.0, 0.0, 1), 0.0);
}

/// Returns the position of a body, in px, that has moved from `start` down a slope by the distance `way`. `angle` in radians.
fn down_slope(start: [f64; 2], angle: f64, way: f64) -> [f64; 2] {
    [start[0] + way * angle.cos(), start[1] + way * angle.sin()]
}

#[test]
fn a_crate_that_slides_by_the_law_has_no_error() {
    let angle = PI / 12.0;
    let start = starts(&(chart("slide").build)(0))[1].position_in_plane();
    let deceleration = GRAVITY * (0.5 * angle.cos() - angle.sin());
    assert_no_error("slide", 0.01, 1e-9, |time, states| {
        let time = time.min(160.0 / deceleration);
        states[1].position = flat(down_slope(start, angle, 160.0 * time - deceleration * time * time / 2.0));
    });
}

#[test]
fn a_crate_on_a_slope_steeper_than_friction_never_stops() {
    assert_eq!(stopping_distance(100.0, GRAVITY, 0.6, 0.5), f64::INFINITY);
    // On level ground the stopping distance is v^2 / (2 mu g).
    assert_relative_eq!(stopping_distance(100.0, GRAVITY, 0.0, 0.5), 31.25);
}

#[test]
fn creep_is_the_slide_after_the_first_second() {
    let angle = PI / 12.0;
    let start = starts(&(chart("stick").build)(0))[1].position_in_plane();
    assert_no_error("stick", 0.01, 0.0, |_, _| {});
    let (error, _) = watched("stick", 0.01, |time, states| {
        states[1].position = flat(down_slope(start, angle, 2.0 * time));
    });
    assert_relative_eq!(error, 18.0, max_relative = 1e-9);
}

/// Returns a function whose calls give the angle of a pendulum, in radians, after each further millisecond. It integrates by
/// the classical Runge-Kutta method. `rate_squared` is the squared angular frequency of small oscillations, 1/s^2; `amplitude` is
/// the initial angle in radians, at which the pendulum is at rest.
fn swinging(rate_squared: f64, amplitude: f64) -> impl FnMut() -> f64 {
    let (mut angle, mut velocity) = (amplitude, 0.0);
    let dt = 1e-3;
    move || {
        let slope = |(angle, velocity): (f64, f64)| (velocity, -rate_squared * f64::sin(angle));
        let ahead = |by: (f64, f64), dt: f64| (angle + by.0 * dt, velocity + by.1 * dt);
        let a = slope((angle, velocity));
        let b = slope(ahead(a, dt / 2.0));
        let c = slope(ahead(b, dt / 2.0));
        let d = slope(ahead(c, dt));
        (angle, velocity) = (
            angle + dt * (a.0 + 2.0 * b.0 + 2.0 * c.0 + d.0) / 6.0,
            velocity + dt * (a.1 + 2.0 * b.1 + 2.0 * c.1 + d.1) / 6.0,
        );
        angle
    }
}

#[test]
fn a_pendulum_that_swings_by_the_law_has_no_error() {
    for (name, amplitude) in
        [("pendulum_narrow", 5.0_f64.to_radians()), ("pendulum_wide", 120.0_f64.to_radians())]
    {
        let mass = masses(&(chart(name).build)(0))[0];
        let rate_squared = mass.mass * GRAVITY * 160.0 / (mass.inertia + mass.mass * 160.0 * 160.0);
        let mut angle = swinging(rate_squared, amplitude);
        assert_no_error(name, 1e-3, 1e-4, |_, states| {
            let angle = angle();
            states[0].position = flat([160.0 * angle.sin(), 160.0 * angle.cos()]);
        });
    }
}

#[test]
fn a_narrow_pendulum_has_the_period_of_the_textbook() {
    let period = pendulum_period(GRAVITY, 1.0, 160.0, 0.0, 1e-6);
    assert_relative_eq!(period, TAU * (160.0 / GRAVITY).sqrt(), max_relative = 1e-12);
    // At an amplitude of 90 degrees the period is 1.18034 times that of small swings, according to tables.
    let wide = pendulum_period(GRAVITY, 1.0, 160.0, 0.0, PI / 2.0);
    assert_relative_eq!(wide / period, 1.180_340_6, max_relative = 1e-7);
}

#[test]
fn a_double_pendulum_keeps_its_energy_when_its_parts_fall_and_not_when_they_stay_in_motion_aloft() {
    // Without a joint both bodies fall freely, which keeps the energy as well.
    assert_no_error("double_pendulum", 0.01, 1e-9, |time, states| {
        // The bodies stop after a second, or they would leave the scene.
        let time = time.min(1.0);
        for state in states {
            state.position[1] = GRAVITY * time * time / 2.0;
            state.velocity[1] = GRAVITY * time;
        }
    });
    // The energies of the level and the hanging pendulum differ by m g (L + 2 L). One body gets a tenth of that difference.
    let gained = 0.1 * GRAVITY * 3.0 * 160.0;
    let (error, _) = watched("double_pendulum", 0.01, |_, states| {
        states[1].velocity = flat([(2.0 * gained).sqrt(), 0.0]);
    });
    assert_relative_eq!(error, 10.0, max_relative = 1e-6);
}

#[test]
fn energy_includes_rotation() {
    let inertia = masses(&(chart("double_pendulum").build)(0))[0].inertia;
    let (error, _) = watched("double_pendulum", 0.01, |_, states| states[0].angular_velocity = 10.0);
    let scale = GRAVITY * 3.0 * 160.0;
    assert_relative_eq!(error, 100.0 * inertia * 50.0 / scale, max_relative = 1e-6);
}

#[test]
fn a_rigidly_rotated_chain_has_no_gap_and_a_displaced_link_opens_one() {
    let scene = (chart("chain").build)(5);
    let starts = starts(&scene);
    assert!(
        scene.joints.iter().all(|joint| {
            matches!(joint.kind, JointKind::Revolute { .. } | JointKind::FixedRevolute { .. })
        })
    );
    let turn = |time: f64, states: &mut [BodyState]| {
        let (sine, cosine) = time.sin_cos();
        for (state, start) in states.iter_mut().zip(&starts) {
            let [x, y] = start.position_in_plane();
            state.position = flat([x * cosine - y * sine, x * sine + y * cosine]);
            state.angle = start.angle + time;
        }
    };
    // Starts are `f32` values: at 80 px they have rounding errors of some millionths.
    assert_no_error("chain", 0.01, 1e-4, turn);
    let (error, _) = watched("chain", 0.01, |time, states| {
        turn(time, states);
        states[4].position[0] += 3.0;
    });
    assert_relative_eq!(error, 3.0, epsilon = 1e-4);
}

#[test]
fn a_spring_that_swings_by_the_law_has_no_error() {
    for (name, frequency) in [
        ("spring_frequency", 1.0),
        ("spring_amplitude", 1.0),
        ("stiff_spring_frequency", 8.0),
        ("stiff_spring_amplitude", 8.0),
    ] {
        // The measure finds zero crossings by linear interpolation, and turning points only to a step. The error of both is
        // (omega dt)^2.
        assert_no_error(name, 1e-3, 0.1, |time, states| {
            states[0].position[0] = 200.0 + 40.0 * (TAU * frequency * time).cos();
        });
    }
}

#[test]
fn a_spring_that_swings_a_tenth_too_fast_or_too_wide_has_that_error() {
    for name in ["spring_frequency", "stiff_spring_frequency"] {
        let frequency = if name.starts_with("stiff") { 8.0 } else { 1.0 };
        let (error, _) = watched(name, 1e-3, |time, states| {
            states[0].position[0] = 200.0 + 40.0 * (TAU * frequency / 0.9 * time).cos();
        });
        assert_relative_eq!(error, 10.0, max_relative = 1e-2);
    }
    let (error, _) = watched("spring_amplitude", 1e-3, |time, states| {
        states[0].position[0] = 200.0 + 44.0 * (TAU * time).cos();
    });
    assert_relative_eq!(error, 10.0, max_relative = 1e-2);
}

#[test]
fn a_spring_that_swings_to_twice_its_amplitude_has_blown_up() {
    for name in ["spring_frequency", "spring_amplitude", "stiff_spring_frequency", "stiff_spring_amplitude"] {
        let stretched = |amplitude: f64| {
            watched(name, 1e-3, move |time, states| {
                states[0].position[0] = 200.0 + amplitude * (TAU * time).cos();
            })
        };
        assert_eq!(stretched(81.0), (f64::INFINITY, Some("blew up")), "{name}");
        assert_eq!(stretched(79.0).1, None, "{name}");
    }
}

#[test]
fn a_spring_that_dies_within_a_period_or_two_has_failed_and_noise_after_a_longer_swing_is_not_measured() {
    for (name, frequency) in [("spring_frequency", 1.0), ("stiff_spring_frequency", 8.0)] {
        // The body swings by the law for this number of periods, then faster and with hardly any amplitude.
        let dying = |periods: f64| {
            watched(name, 1e-3, move |time, states| {
                let turns = time * frequency;
                let stretch =
                    if turns < periods { 40.0 * (TAU * turns).cos() } else { (1.7 * TAU * turns).cos() };
                states[0].position[0] = 200.0 + stretch;
            })
        };
        assert_eq!(dying(1.9).1, Some("died"), "{name}");
        // A body that creeps back to the middle and stays there counts as one that does not swing.
        let (_, failed) = watched(name, 1e-3, |time, states| {
            states[0].position[0] = 200.0 + 40.0 * (-20.0 * time).exp();
        });
        assert_eq!(failed, Some("died"), "{name}");
        let (error, failed) = dying(4.2);
        assert_eq!(failed, None, "{name}");
        assert!(error < 2.0, "{name}: {error}");
    }
}

#[test]
fn in_a_cradle_the_last_disc_alone_moves_on() {
    let exchange = |_: f64, states: &mut [BodyState]| {
        states[0].velocity = flat([0.0, 0.0]);
        states[4].velocity = flat([200.0, 0.0]);
    };
    for name in ["newtons_cradle", "newtons_cradle_momentum", "newtons_cradle_energy"] {
        assert_no_error(name, 0.01, 1e-9, exchange);
    }
    // If two discs went on with half the speed, the momentum would be right, but neither the velocities nor the energy.
    let share = |_: f64, states: &mut [BodyState]| {
        states[0].velocity = flat([0.0, 0.0]);
        states[3].velocity = flat([100.0, 0.0]);
        states[4].velocity = flat([100.0, 0.0]);
    };
    let error = |name| watched(name, 0.01, share).0;
    assert_relative_eq!(error("newtons_cradle"), 50.0);
    assert_relative_eq!(error("newtons_cradle_momentum"), 0.0);
    assert_relative_eq!(error("newtons_cradle_energy"), 50.0);
}

#[test]
fn a_cradle_of_touching_discs_is_judged_by_momentum_and_energy_alone() {
    let both = ["newtons_cradle_touching_momentum", "newtons_cradle_touching_energy"];
    // Newton's law for all hits at once: momentum -120 + 4 * 80 = 200, energy 120^2 + 4 * 80^2 = 200^2.
    let at_once = |_: f64, states: &mut [BodyState]| {
        for (index, state) in states.iter_mut().enumerate() {
            state.velocity = flat([if index == 0 { -120.0 } else { 80.0 }, 0.0]);
        }
    };
    both.into_iter().for_each(|name| assert_no_error(name, 0.01, 1e-9, at_once));
    let all_together = |_: f64, states: &mut [BodyState]| {
        states.iter_mut().for_each(|state| state.velocity = flat([40.0, 0.0]));
    };
    let [momentum, energy] = both.map(|name| watched(name, 0.01, all_together).0);
    assert_relative_eq!(momentum, 0.0);
    assert_relative_eq!(energy, 80.0, max_relative = 1e-9);
}

#[test]
fn with_enough_iterations_a_cradle_is_right() {
    let (scene, setting) = ((chart("newtons_cradle").build)(5), Setting::fixed(1.0 / 60.0, 40));
    for method in methods().into_iter().filter(|method| method.family == Family::Ours) {
        let mut watch = (chart("newtons_cradle").watch)(&scene);
        let mut world = (method.build)(&scene, setting).unwrap_or_else(|error| panic!("{error}"));
        (0..60).for_each(|_| world.step(1.0 / 60.0));
        watch.observe(1.0, &*world);
        // Measured errors: 0.23 % with the distance grid, less than 0.001 % without.
        assert!(watch.error() < 0.3, "{}: {}", method.name, watch.error());
    }
}

#[test]
fn the_discs_of_a_cradle_are_a_pixel_apart_and_those_of_the_other_touch() {
    for (name, distance) in [("newtons_cradle", 33.0), ("newtons_cradle_touching_energy", 31.98)] {
        let states = starts(&(chart(name).build)(5));
        for pair in states[1..].windows(2) {
            assert_relative_eq!(pair[1].position[0] - pair[0].position[0], distance, epsilon = 1e-4);
        }
    }
}

#[test]
fn hits_in_a_cradle_come_one_after_another_at_every_setting() {
    let scene = (chart("newtons_cradle").build)(5);
    for method in methods().into_iter().filter(|method| !method.is_broad_phase_variant) {
        for setting in (method.settings)(Effort::Full) {
            let mut world = (method.build)(&scene, setting).unwrap_or_else(|error| panic!("{error}"));
            let mut hit = [None; 5];
            for (step, dt) in setting.dt.steps().enumerate().take((1.0 / setting.dt.mean()) as usize) {
                world.step(dt);
                for (index, hit) in hit.iter_mut().enumerate().skip(1) {
                    // The threshold is a tenth of the speed of the hitting disc, 200 px/s.
                    let is_hit = world.body(index).velocity[0] > 20.0;
                    *hit = hit.or(is_hit.then_some(step));
                }
            }
            let steps: Vec<usize> = hit.into_iter().flatten().collect();
            let is_in_turn = steps.windows(2).all(|pair| pair[0] < pair[1]);
            assert!(steps.len() == 4 && is_in_turn, "{} at {setting:?}: {steps:?}", method.name);
        }
    }
}

#[test]
fn an_oblique_hit_by_the_law_has_no_error() {
    // The normal of the hit is at 30 degrees to the velocity.
    let normal = normal_of_oblique_hit(16.0, 32.0);
    assert_relative_eq!(normal[0], (PI / 6.0).cos(), max_relative = 1e-12);
    assert_relative_eq!(normal[1], 0.5);
    let after = after_hit(([200.0, 0.0], 1.0), ([0.0, 0.0], 2.0), 0.8, normal);
    for name in ["oblique_hit", "oblique_hit_momentum", "oblique_hit_energy"] {
        assert_no_error(name, 0.01, 1e-9, |_, states| {
            states[0].velocity = flat(after[0]);
            states[1].velocity = flat(after[1]);
        });
    }
    let (error, _) = watched("oblique_hit", 0.01, |_, states| {
        states[0].velocity = flat(after[0]);
        states[1].velocity = flat([after[1][0], after[1][1] + 20.0]);
    });
    assert_relative_eq!(error, 10.0, max_relative = 1e-9);
}

#[test]
fn a_hit_conserves_momentum_and_separates_by_the_restitution() {
    let normal = [0.6, 0.8];
    let [a, b] = after_hit(([3.0, -2.0], 1.5), ([-1.0, 4.0], 0.5), 0.3, normal);
    for axis in 0..2 {
        let before = 1.5 * [3.0, -2.0][axis] + 0.5 * [-1.0, 4.0][axis];
        assert_relative_eq!(1.5 * a[axis] + 0.5 * b[axis], before, max_relative = 1e-12);
    }
    let along = |v: [f64; 2]| v[0] * normal[0] + v[1] * normal[1];
    let approach = along([3.0, -2.0]) - along([-1.0, 4.0]);
    assert_relative_eq!(along(b) - along(a), 0.3 * approach, max_relative = 1e-12);
}
