//! The measures of the chart are right where there is a law: what moves by the law of a scene has no error, what
//! differs by a known amount has that error.

mod accuracy_common;

use accuracy_common::{assert_right, chart, starts, watched};
use approx::assert_relative_eq;
use conformance::measure::closed_forms::{
    SteppedThrow, after_hit, apex, normal_of_oblique_hit, pendulum_period, rolling_acceleration,
    stopping_distance, thrown,
};
use conformance::measure::world::{BodyState, masses};
use conformance::scene::JointKind;
use std::f64::consts::{PI, TAU};

/// Gravity of the scenes in px/s², as the scenes have it.
const GRAVITY: f64 = 320.0;

#[test]
fn a_throw_by_the_continuous_law_has_no_error_against_it() {
    let starts = starts(&(chart("throw_continuous_law").build)(0));
    assert_right("throw_continuous_law", 0.01, 1e-9, |time, states| {
        for (index, rate) in [0.0, 0.5].into_iter().enumerate() {
            let start = starts[index];
            states[index].position = thrown(start.position, start.velocity, GRAVITY, rate, time);
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
                position: start.position,
                velocity: start.velocity,
                gravity: GRAVITY,
                rate,
            };
            laws = states.iter().zip([0.0, 0.5]).map(law).collect();
        }
        for (law, state) in laws.iter_mut().zip(states) {
            law.step(dt);
            state.position = law.position;
        }
    };
    assert_right("throw_discrete_law", dt, 1e-9, &mut law);
    laws.clear();
    let law = |time: f64, states: &mut [BodyState]| {
        // The sum of n steps is g dt^2 n (n + 1) / 2, and so g dt t / 2 too much.
        let excess = GRAVITY * dt * time / 2.0;
        let start = [0.0, 0.0];
        states[0].position = thrown(start, [200.0, -300.0], GRAVITY, 0.0, time);
        states[0].position[1] += excess;
        states[1].position = thrown([0.0, 1000.0], [200.0, -300.0], GRAVITY, 0.5, time);
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
    // Half a step of what the acceleration moves.
    assert_relative_eq!(law.position[0], exact[0], epsilon = 1e-2);
    assert_relative_eq!(law.position[1], exact[1], epsilon = 1e-2);
}

/// Height of a ball above the ground that falls 160 px in the first second and bounces.
fn bouncing(time: f64, restitution: f64) -> f64 {
    let (mut bounce, mut rest) = (0, time - 1.0);
    if rest < 0.0 {
        return 160.0 - GRAVITY * time * time / 2.0;
    }
    loop {
        let speed = GRAVITY * restitution.powi(bounce + 1);
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

#[test]
fn a_ball_that_bounces_by_the_law_has_no_error() {
    for (name, restitution) in
        [("bounce_restitution_0", 0.0), ("bounce_restitution_half", 0.5), ("bounce_restitution_1", 1.0)]
    {
        // No step sees the very apex: what is missed is at most g dt^2 / 8.
        let dt = 1.0 / 960.0;
        assert_right(name, dt, GRAVITY * dt * dt / 8.0 + 1e-9, |time, states| {
            states[1].position[1] = -16.0 - bouncing(time, restitution);
        });
    }
}

#[test]
fn ten_thousand_steps_of_bouncing_by_the_law_keep_the_height() {
    assert_right("bounce_10000_steps", 1.0 / 60.0, 0.01, |time, states| {
        states[1].position[1] = -16.0 - bouncing(time, 1.0);
    });
}

#[test]
fn a_ball_that_bounces_ever_higher_has_gained_energy() {
    let (error, failed) = watched("bounce_10000_steps", 1.0 / 60.0, |time, states| {
        states[1].position[1] = -16.0 - bouncing(time, 1.0) * (1.0 + time / 100.0);
    });
    assert_eq!((error, failed), (f64::INFINITY, Some("gained energy")));
}

#[test]
fn a_ball_that_never_bounces_gives_nothing_to_measure() {
    let (error, failed) = watched("bounce_restitution_1", 1.0 / 60.0, |time, states| {
        states[1].position[1] = -16.0 - bouncing(time, 0.0);
    });
    assert!(error.is_nan());
    assert_eq!(failed, Some("nothing to measure"));
}

#[test]
fn each_apex_has_the_square_of_the_restitution_of_the_one_before() {
    assert_relative_eq!(apex(160.0, 0.5, 1), 40.0);
    assert_relative_eq!(apex(160.0, 0.5, 2), 10.0);
    assert_relative_eq!(apex(160.0, 0.0, 1), 0.0);
}

/// Where a body on a slope is after it came a way down.
fn down_slope(start: [f64; 2], angle: f64, way: f64) -> [f64; 2] {
    [start[0] + way * angle.cos(), start[1] + way * angle.sin()]
}

#[test]
fn a_crate_that_slides_by_the_law_has_no_error() {
    let angle = PI / 12.0;
    let start = starts(&(chart("slide").build)(0))[1].position;
    let deceleration = GRAVITY * (0.5 * angle.cos() - angle.sin());
    assert_right("slide", 0.01, 1e-9, |time, states| {
        let time = time.min(160.0 / deceleration);
        states[1].position = down_slope(start, angle, 160.0 * time - deceleration * time * time / 2.0);
    });
}

#[test]
fn what_is_steeper_than_friction_never_stops() {
    assert_eq!(stopping_distance(100.0, GRAVITY, 0.6, 0.5), f64::INFINITY);
    // On the level v^2 / (2 mu g).
    assert_relative_eq!(stopping_distance(100.0, GRAVITY, 0.0, 0.5), 31.25);
}

#[test]
fn creep_is_what_is_slid_after_the_first_second() {
    let angle = PI / 12.0;
    let start = starts(&(chart("stick").build)(0))[1].position;
    assert_right("stick", 0.01, 0.0, |_, _| {});
    let (error, _) = watched("stick", 0.01, |time, states| {
        states[1].position = down_slope(start, angle, 2.0 * time);
    });
    assert_relative_eq!(error, 18.0, max_relative = 1e-9);
}

#[test]
fn what_rolls_by_the_law_has_no_error_and_what_slides_instead_half_as_much_again() {
    let angle = PI / 9.0;
    for name in ["roll_circle", "roll_polygon"] {
        let start = starts(&(chart(name).build)(0))[1].position;
        // A disc rolls with two thirds of the acceleration with which it slides.
        let rolling = 2.0 / 3.0 * GRAVITY * angle.sin();
        assert_right(name, 0.01, 1e-6, |time, states| {
            states[1].position = down_slope(start, angle, rolling * time * time / 2.0);
        });
        let (error, _) = watched(name, 0.01, |time, states| {
            states[1].position = down_slope(start, angle, 1.5 * rolling * time * time / 2.0);
        });
        assert_relative_eq!(error, 50.0, max_relative = 1e-6);
    }
    assert_relative_eq!(
        rolling_acceleration(GRAVITY, angle, 2.0, 3.0, 9.0),
        2.0 / 3.0 * GRAVITY * angle.sin()
    );
}

/// The angles of a pendulum every millisecond, by the classical method of Runge and Kutta.
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
        assert_right(name, 1e-3, 1e-4, |_, states| {
            let angle = angle();
            states[0].position = [160.0 * angle.sin(), 160.0 * angle.cos()];
        });
    }
}

#[test]
fn a_narrow_pendulum_has_the_period_of_the_textbook() {
    let period = pendulum_period(GRAVITY, 1.0, 160.0, 0.0, 1e-6);
    assert_relative_eq!(period, TAU * (160.0 / GRAVITY).sqrt(), max_relative = 1e-12);
    // At 90 degrees 1.18034 times as long, a value found in tables.
    let wide = pendulum_period(GRAVITY, 1.0, 160.0, 0.0, PI / 2.0);
    assert_relative_eq!(wide / period, 1.180_340_6, max_relative = 1e-7);
}

#[test]
fn a_double_pendulum_keeps_its_energy_when_its_parts_fall_and_not_when_they_stay_in_motion_aloft() {
    // Without a joint both fall freely, which keeps the energy as well.
    assert_right("double_pendulum", 0.01, 1e-9, |time, states| {
        // A second is enough, or they would leave the scene.
        let time = time.min(1.0);
        for state in states {
            state.position[1] = GRAVITY * time * time / 2.0;
            state.velocity[1] = GRAVITY * time;
        }
    });
    // Between level and hanging lie m g (L + 2 L): a tenth of that is given to one of them.
    let gained = 0.1 * GRAVITY * 3.0 * 160.0;
    let (error, _) = watched("double_pendulum", 0.01, |_, states| {
        states[1].velocity = [(2.0 * gained).sqrt(), 0.0];
    });
    assert_relative_eq!(error, 10.0, max_relative = 1e-6);
}

#[test]
fn energy_counts_what_turns() {
    let inertia = masses(&(chart("double_pendulum").build)(0))[0].inertia;
    let (error, _) = watched("double_pendulum", 0.01, |_, states| states[0].angular_velocity = 10.0);
    let scale = GRAVITY * 3.0 * 160.0;
    assert_relative_eq!(error, 100.0 * inertia * 50.0 / scale, max_relative = 1e-6);
}

#[test]
fn a_chain_that_turns_as_a_whole_has_no_gap_and_a_link_that_is_moved_opens_one_so_wide() {
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
            let [x, y] = start.position;
            state.position = [x * cosine - y * sine, x * sine + y * cosine];
            state.angle = start.angle + time;
        }
    };
    // Starts are floats: at 80 px they are off by some millionths.
    assert_right("chain", 0.01, 1e-4, turn);
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
        // Zeros are found by straight lines, and turning points only near a step: both off by (omega dt)^2.
        assert_right(name, 1e-3, 0.1, |time, states| {
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
fn in_a_cradle_the_last_disc_alone_moves_on() {
    let exchange = |_: f64, states: &mut [BodyState]| {
        states[0].velocity = [0.0, 0.0];
        states[4].velocity = [200.0, 0.0];
    };
    for name in ["newtons_cradle", "newtons_cradle_momentum", "newtons_cradle_energy"] {
        assert_right(name, 0.01, 1e-9, exchange);
    }
    // If two of them went on with half the speed, momentum would be right, but not the rest.
    let share = |_: f64, states: &mut [BodyState]| {
        states[0].velocity = [0.0, 0.0];
        states[3].velocity = [100.0, 0.0];
        states[4].velocity = [100.0, 0.0];
    };
    let error = |name| watched(name, 0.01, share).0;
    assert_relative_eq!(error("newtons_cradle"), 50.0);
    assert_relative_eq!(error("newtons_cradle_momentum"), 0.0);
    assert_relative_eq!(error("newtons_cradle_energy"), 50.0);
}

#[test]
fn an_oblique_hit_by_the_law_has_no_error() {
    // 30 degrees off the middle.
    let normal = normal_of_oblique_hit(16.0, 32.0);
    assert_relative_eq!(normal[0], (PI / 6.0).cos(), max_relative = 1e-12);
    assert_relative_eq!(normal[1], 0.5);
    let after = after_hit(([200.0, 0.0], 1.0), ([0.0, 0.0], 2.0), 0.8, normal);
    for name in ["oblique_hit", "oblique_hit_momentum", "oblique_hit_energy"] {
        assert_right(name, 0.01, 1e-9, |_, states| {
            states[0].velocity = after[0];
            states[1].velocity = after[1];
        });
    }
    let (error, _) = watched("oblique_hit", 0.01, |_, states| {
        states[0].velocity = after[0];
        states[1].velocity = [after[1][0], after[1][1] + 20.0];
    });
    assert_relative_eq!(error, 10.0, max_relative = 1e-9);
}

#[test]
fn a_hit_keeps_momentum_and_parts_with_the_restitution() {
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
