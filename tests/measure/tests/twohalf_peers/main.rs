//! Compares the 2.5D engine with `rapier3d` in scenes that are not chaotic: where objects land and rest, how fast they are, and
//! which one is hit first.
//!
//! `cargo test --release -p measure --features peers --test twohalf_peers -- --nocapture` prints the tables.
//!
//! Origin of the tolerances:
//! - **A fall**: after a time t, symplectic Euler is g t dt / 2 below the parabola. Divided by the speed, this is the time by
//!   which it crosses a height too early. `rapier3d` makes four substeps per step, for a quarter of that. A crossing between
//!   two steps is interpolated.
//! - **Contacts** are found at the end of a step in our engine, so they act up to a step late and up to v dt too deep.
//!   `rapier3d` has speculative contacts from [`MARGIN`] on.
//! - **Rest**: our engine leaves an overlap of [`SLOP`] uncorrected.

mod closed_forms;
mod comparison;
mod recording;

use closed_forms::{after_fall_on_corner, after_hit, time_of_meeting, turned};
use comparison::{Both, MARGIN, Run, SLOP, alone};
use measure::engines::depth::TwoHalf;
use measure::engines::rapier3d::Rapier;
use measure::scenes::depth::*;
use measure::world::{BodyState, ContactPartner, World};
use std::time::Instant;

/// Length of a step, s.
const STEP: f64 = DT as f64;
/// Gravity, px/s².
const G: f64 = GRAVITY as f64;
/// Height above a surface, px, at which landing is measured. It is greater than the distance of the speculative contacts of
/// `rapier3d`.
const LANDING: f64 = 1.0;

/// Returns the tolerance of the time, in s, at which a fall crosses a height after `time` s, with a downward `speed` in px/s.
/// It is the error of symplectic Euler, and 5 % more for the curvature of the path within a step.
fn of_fall(time: f64, speed: f64) -> f64 {
    1.05 * G * time * STEP / 2.0 / speed
}

/// Returns the tolerance of a position, in px, after a contact that begins to act a step late, at a `speed` in px/s. Half a
/// step is added for the error of the path.
fn of_contact(speed: f64) -> f64 {
    1.5 * speed * STEP
}

#[test]
fn a_box_dropped_flat_lands_on_time_and_stays() {
    let mut both = Both::run(&drop_onto_ground());
    let time = (2.0 * (100.0 - LANDING) / G).sqrt();
    both.check("time of landing", |run| run.crossing(0, LANDING).time)
        .tolerance(of_fall(time, G * time))
        .closed_form(time);
    both.check("rest, Y", |run| run.last(0).position[1]).tolerance(1.2 * SLOP).closed_form(0.0);
    // In our engine only rounding errors of the rotation move the box aside. In `rapier3d` it rocks: measured tolerance.
    for (name, axis, value, rocking) in [("rest, X", 0, 20.0, 1.5), ("rest, Z", 2, 35.0, 0.0)] {
        both.check(name, |run| run.last(0).position[axis])
            .tolerances(rocking + 0.02, 0.02)
            .closed_form(value);
    }
    both.check("rest, rotation", |run| run.last(0).angle).tolerance(1e-3).closed_form(0.0);
    both.report();
}

#[test]
fn a_ball_bounces_to_the_square_of_its_restitution() {
    let mut both = Both::run(&bounce());
    let speed = (2.0 * G * 200.0).sqrt();
    let time = (2.0 * (200.0 - LANDING) / G).sqrt();
    both.check("time of landing", |run| run.crossing(0, LANDING).time)
        .tolerance(of_fall(time, G * time))
        .closed_form(time);
    // The speed of the impact is known up to 1.5 g dt, and the position up to v dt.
    let tolerance = 1.6 * speed * STEP + MARGIN;
    both.check("height of the bounce", |run| run.apex_after(0, run.crossing(0, LANDING).time))
        .tolerance(tolerance)
        .closed_form(0.36 * 200.0);
    both.report();
}

#[test]
fn a_box_slides_the_distance_of_its_friction() {
    for (name, direction) in
        [("slide_in_x", [1.0, 0.0]), ("slide_in_depth", [0.0, 1.0]), ("slide_obliquely", [0.6, 0.8])]
    {
        let mut both = Both::run(&box_sliding(name, direction));
        let distance = 100.0 * 100.0 / (2.0 * 0.4 * G);
        let along = |state: BodyState| {
            state.position[0] * f64::from(direction[0]) + state.position[2] * f64::from(direction[1])
        };
        let aside = |state: BodyState| {
            state.position[0] * f64::from(direction[1]) - state.position[2] * f64::from(direction[0])
        };
        both.check("rest, along", |run| along(run.last(0)))
            .tolerance(of_contact(100.0))
            .closed_form(distance);
        // The box must keep the direction of its sliding to a thousandth. `rapier3d` solves for the friction impulses along X
        // and Z with their different effective masses before it clamps them. Their ratio is 1.3 to 1 here, as the contacts are
        // off the middle of the box. So it brakes too little along X.
        let deflection = if direction[0] * direction[1] == 0.0 { 0.0 } else { 10.0 };
        both.check("rest, aside", |run| aside(run.last(0)))
            .tolerances(deflection + 0.001 * distance, 0.001 * distance)
            .closed_form(0.0);
        both.check("rest, speed", |run| run.speed(0)).tolerance(0.01).closed_form(0.0);
        both.report();
    }
}

#[test]
fn a_ball_thrown_flat_ends_up_rolling_at_two_thirds_of_its_speed() {
    for (name, direction) in
        [("roll_in_x", [1.0, 0.0]), ("roll_in_depth", [0.0, 1.0]), ("roll_obliquely", [0.6, -0.8])]
    {
        let mut both = Both::run(&ball_rolling(name, direction));
        let (sliding, total) = (90.0 / (3.0 * 0.3 * G), 3.0);
        let distance = 90.0 * sliding - 0.3 * G * sliding * sliding / 2.0 + 60.0 * (total - sliding);
        for (axis, part) in [(0, direction[0]), (2, direction[1])] {
            let part = f64::from(part);
            let name = if axis == 0 { "X" } else { "Z" };
            both.check(&format!("{name} after 3 s"), |run| run.last(0).position[axis])
                .tolerance(of_contact(90.0))
                .closed_form(distance * part);
            // The tolerance is the change of velocity by friction in one step.
            both.check(&format!("speed along {name}"), |run| run.last(0).velocity[axis])
                .tolerance(0.3 * G * STEP)
                .closed_form(60.0 * part);
        }
        both.report();
    }
}

#[test]
fn a_ball_thrown_in_all_directions_lands_where_the_parabola_ends_and_rolls_on() {
    let mut both = Both::run(&throw_in_x_and_z());
    let speed = (100.0_f64 * 100.0 - 2.0 * G * LANDING).sqrt();
    let time = (100.0 + speed) / G;
    let early = of_fall(time, speed);
    both.check("time of landing", |run| run.crossing(0, LANDING).time).tolerance(early).closed_form(time);
    // The friction limit of the impact, 0.4 of 100 px/s, exceeds the change that rolling needs, a third of 78 px/s. So the ball
    // rolls at once, with two thirds of its speed. `rapier3d` has a speculative contact, where friction acts up to half of the
    // margin beyond the radius of 10 px.
    let arm = 10.0 + MARGIN / 2.0;
    let farther = arm * arm / (arm * arm + 50.0) - 2.0 / 3.0;
    for (name, axis, start, speed) in [("X", 0, 30.0, 50.0), ("Z", 2, 40.0, 60.0)] {
        both.check(&format!("landing, {name}"), |run| run.crossing(0, LANDING).position[axis])
            .tolerance(early * speed)
            .closed_form(start + speed * time);
        both.check(&format!("speed along {name}"), |run| run.last(0).velocity[axis])
            .tolerances(farther * speed + 0.01, 0.01)
            .closed_form(speed * 2.0 / 3.0);
    }
    both.report();
}

#[test]
fn a_box_thrown_onto_a_platform_slides_to_rest_on_it() {
    let mut both = Both::run(&throw_onto_platform());
    let root = (150.0 * 150.0 - 2.0 * G * (60.0 + LANDING)).sqrt();
    let time = (150.0 + root) / G;
    let early = of_fall(time, root);
    both.check("time of landing", |run| run.crossing(0, 60.0 + LANDING).time)
        .tolerance(early)
        .closed_form(time);
    // The friction of the impact takes half of the impact's change of speed from the 75 px/s along (0.8, 0.6).
    let impact = (150.0_f64 * 150.0 - 2.0 * G * 60.0).sqrt();
    let sliding = 75.0 - 0.5 * impact;
    let distance = sliding * sliding / (2.0 * 0.5 * G);
    // The speed of the impact is known up to 1.5 g dt, and its time up to `early` and a step.
    let of_sliding = 1.5 * G * STEP * 0.5 * sliding / (0.5 * G);
    let landing = (150.0 + impact) / G;
    for (name, axis, start, speed, part) in [("X", 0, -100.0, 60.0, 0.8), ("Z", 2, -60.0, 45.0, 0.6)] {
        both.check(&format!("landing, {name}"), |run| run.crossing(0, 60.0 + LANDING).position[axis])
            .tolerance(early * speed)
            .closed_form(start + speed * time);
        both.check(&format!("rest, {name}"), |run| run.last(0).position[axis])
            .tolerance((early + STEP) * speed + of_sliding * part)
            .closed_form(start + speed * landing + distance * part);
    }
    both.check("rest, Y", |run| run.last(0).position[1]).tolerance(1.2 * SLOP).closed_form(60.0);
    both.check("rest, rotation", |run| run.last(0).angle).tolerance(1e-3).closed_form(0.0);
    both.report();
}

#[test]
fn a_box_slides_down_a_slope_and_off_its_end() {
    let mut both = Both::run(&box_sliding_down_slope());
    let [sine, cosine] = SLOPE_SINE_AND_COSINE.map(f64::from);
    let acceleration = G * (sine - 0.1 * cosine);
    let start = f64::from(box_sliding_down_slope().objects[0].position[0]);
    let speed = acceleration * 3.0;
    both.check("X after 3 s", |run| run.state_at(0, 3.0).position[0])
        .tolerance(of_contact(speed) * cosine)
        .closed_form(start + acceleration * 4.5 * cosine);
    both.check("speed along X after 3 s", |run| run.state_at(0, 3.0).velocity[0])
        // The tolerance is the change of velocity in one step.
        .tolerance(acceleration * STEP * cosine)
        .closed_form(speed * cosine);
    both.check("Z at the end", |run| run.last(0).position[2]).tolerance(0.01).closed_form(10.0);
    // The box tips over the edge, which the engine notices up to a step late. The tolerances are measured.
    both.check("time of landing", |run| run.crossing(0, LANDING).time).tolerance(STEP);
    both.check("landing, X", |run| run.crossing(0, LANDING).position[0]).tolerance(1.0);
    both.check("rest, speed", |run| run.speed(0)).tolerance(0.1).closed_form(0.0);
    both.hits(
        &[
            (ContactPartner::Object(0), ContactPartner::Platform(0)),
            (ContactPartner::Object(0), ContactPartner::Ground),
        ],
        |_| true,
    );
    both.report();
}

#[test]
fn a_ball_rolls_down_a_slope_with_two_thirds_of_the_acceleration() {
    let mut both = Both::run(&ball_rolling_down_slope("roll_down_slope", 0.0));
    let [sine, cosine] = SLOPE_SINE_AND_COSINE.map(f64::from);
    let acceleration = G * sine * 2.0 / 3.0;
    let start = f64::from(ball_rolling_down_slope("", 0.0).objects[0].position[0]);
    let speed = acceleration * 3.0;
    both.check("X after 3 s", |run| run.state_at(0, 3.0).position[0])
        .tolerance(of_contact(speed) * cosine)
        .closed_form(start + acceleration * 4.5 * cosine);
    // The ball leaves the slope after 210 px, with its centre 15 px above the edge, too fast to tip over it.
    let end = (2.0 * acceleration * 210.0).sqrt();
    let [x, y] = [start + 210.0 * cosine, end_of_slope_height() + 15.0 * cosine];
    let fall = ((end * sine).powi(2) + 2.0 * G * (y - 15.0 - LANDING)).sqrt() - end * sine;
    both.check("time of landing", |run| run.crossing(0, LANDING).time)
        .tolerance(1.5 * STEP)
        .closed_form(end / acceleration + fall / G);
    both.check("landing, X", |run| run.crossing(0, LANDING).position[0])
        .tolerance(of_contact(end * cosine))
        .closed_form(x + end * cosine * fall / G);
    both.report();
}

/// Returns the height, in px, of the lower end of the slope's upper face. This end is 120 px down the slope from the middle of
/// the face.
fn end_of_slope_height() -> f64 {
    let [sine, cosine] = SLOPE_SINE_AND_COSINE.map(f64::from);
    110.0 + 10.0 * cosine - 120.0 * sine
}

#[test]
fn a_ball_that_drifts_along_z_on_a_slope_rolls_along_both_axes() {
    let mut both = Both::run(&ball_rolling_down_slope("drift_on_slope", 12.0));
    let [_, cosine] = SLOPE_SINE_AND_COSINE.map(f64::from);
    // Friction stops the sliding within 0.1 s. Its direction turns meanwhile.
    let sliding = 0.1 * 12.0;
    both.check("X after 3 s", |run| run.state_at(0, 3.0).position[0])
        .tolerance(of_contact(77.0) * cosine + sliding);
    both.check("Z after 3 s", |run| run.state_at(0, 3.0).position[2])
        .tolerance(of_contact(12.0) + 0.1)
        .closed_form(-20.0 + 8.0 * 3.0 + sliding / 6.0);
    both.check("speed along Z after 3 s", |run| run.state_at(0, 3.0).velocity[2])
        .tolerance(0.3)
        .closed_form(8.0);
    both.check("landing, Z", |run| run.crossing(0, LANDING).position[2]).tolerance(0.5);
    both.report();
}

#[test]
fn an_oblique_hit_of_balls_acts_along_the_line_of_centres() {
    let scene = balls_meeting_obliquely();
    let [a, b] = [0, 1].map(|index: usize| scene.objects[index].clone());
    let [velocity_a, velocity_b] = [&a, &b].map(|object| object.velocity.map(f64::from));
    let centre = |position: [f32; 3], radius: f64, velocity: [f64; 3], time: f64| -> [f64; 3] {
        let [x, y, z] = position.map(f64::from);
        let start = [x, y + radius, z];
        std::array::from_fn(|axis| start[axis] + velocity[axis] * time)
    };
    let between = |time: f64| -> [f64; 3] {
        let [a, b] = [centre(a.position, 20.0, velocity_a, time), centre(b.position, 15.0, velocity_b, time)];
        std::array::from_fn(|axis| b[axis] - a[axis])
    };
    let distance = |time: f64| between(time).iter().map(|part| part * part).sum::<f64>().sqrt();
    let time = time_of_meeting(distance, 35.0, 0.8);
    let foreseen = time_of_meeting(distance, 35.0 + MARGIN, 0.8);
    let outcome = |time: f64| after_hit((velocity_a, 1.0), (velocity_b, 0.5), 0.5, between(time));
    let (exact, late, early) = (outcome(time), outcome(time + STEP), outcome(foreseen));

    let mut both = Both::run(&scene);
    for object in 0..2 {
        for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
            // Our engine takes the normal of an instant up to a step after the hit; `rapier3d` takes that of an instant before
            // the hit.
            let ours = (late[object][axis] - exact[object][axis]).abs() + 1e-3;
            let foreseen = (early[object][axis] - exact[object][axis]).abs();
            both.check(&format!("speed of {object}, {name}"), |run| run.last(object).velocity[axis])
                .tolerances(ours + foreseen, ours)
                .closed_form(exact[object][axis]);
        }
    }
    both.hits(&[(ContactPartner::Object(0), ContactPartner::Object(1))], |_| true);
    both.report();
}

#[test]
fn a_box_pushed_into_another_along_z_shares_its_momentum() {
    let mut both = Both::run(&box_pushed_into_box_along_z());
    let [a, b] = after_hit(([0.0, 0.0, 90.0], 0.5), ([0.0; 3], 1.0), 0.4, [0.0, 0.0, 1.0]);
    for (object, velocity) in [a, b].into_iter().enumerate() {
        both.check(&format!("speed of {object}, Z"), |run| run.last(object).velocity[2])
            .tolerance(0.05)
            .closed_form(velocity[2]);
        both.check(&format!("Y of {object}"), |run| run.last(object).position[1])
            .tolerance(1.2 * SLOP)
            .closed_form(0.0);
        both.check(&format!("X of {object}"), |run| run.last(object).position[0])
            .tolerance(0.02)
            .closed_form([0.0, 6.0][object]);
    }
    both.hits(&[(ContactPartner::Object(0), ContactPartner::Object(1))], Both::of_objects);
    both.report();
}

#[test]
fn a_ball_bounces_back_from_the_front_of_a_box() {
    let mut both = Both::run(&ball_against_box_front());
    let [a, b] = after_hit(([0.0, 0.0, 90.0], 1.0), ([0.0; 3], 1.0 / 3.0), 0.6, [0.0, 0.0, 1.0]);
    for (object, velocity) in [a, b].into_iter().enumerate() {
        for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
            // The ground reflects the velocity that gravity adds in a step.
            let tolerance = if axis == 1 { G * STEP } else { 0.05 };
            both.check(&format!("speed of {object}, {name}"), |run| run.last(object).velocity[axis])
                .tolerance(tolerance)
                .closed_form(velocity[axis]);
        }
    }
    both.hits(&[(ContactPartner::Object(0), ContactPartner::Object(1))], Both::of_objects);
    both.report();
}

#[test]
fn a_ball_glances_off_the_upright_edge_of_a_post() {
    let velocity = [0.0, 0.0, 80.0];
    // The edge is 11 px to the right of the ball's path and 80 px ahead.
    let towards_edge = |time: f64| [11.0, 0.0, 80.0 - 80.0 * time];
    let distance = |time: f64| towards_edge(time)[2].hypot(11.0);
    let time = time_of_meeting(distance, 15.0, 1.0);
    let foreseen = time_of_meeting(distance, 15.0 + MARGIN, 1.0);
    let outcome = |time: f64| after_hit((velocity, 1.0), ([0.0; 3], 0.0), 0.5, towards_edge(time))[0];
    let (exact, late, early) = (outcome(time), outcome(time + STEP), outcome(foreseen));
    let mut both = Both::run(&ball_against_box_edge());
    for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
        let ours = (late[axis] - exact[axis]).abs() + 1e-3;
        let foreseen = (early[axis] - exact[axis]).abs();
        both.check(&format!("speed, {name}"), |run| run.last(0).velocity[axis])
            .tolerances(ours + foreseen, ours)
            .closed_form(exact[axis]);
    }
    both.report();
}

#[test]
fn a_row_of_balls_is_hit_one_after_the_other() {
    let mut both = Both::run(&row_of_three_hits());
    let pairs = [0, 1, 2].map(|index| (ContactPartner::Object(index), ContactPartner::Object(index + 1)));
    both.hits(&pairs, Both::of_objects);
    for (index, (a, b)) in pairs.into_iter().enumerate() {
        // Our engine finds every hit at the end of a step, and the hit acts in the next step. The overlap of up to v dt
        // shortens the next flight. `rapier3d` finds hits ahead.
        let number = (index + 1) as f64;
        both.check(&format!("time of hit {}", index + 1), |run| run.time_of_hit(a, b).unwrap_or(f64::NAN))
            .tolerances(2.0 * STEP * number + MARGIN / 100.0, 2.0 * STEP * number)
            .closed_form(0.3 * number);
    }
    for object in 0..4 {
        let passed_on = if object == 3 { 100.0 } else { 0.0 };
        for (name, axis, part) in [("X", 0, 0.6), ("Z", 2, 0.8)] {
            both.check(&format!("speed of {object}, {name}"), |run| run.last(object).velocity[axis])
                .tolerance(0.01)
                .closed_form(passed_on * part);
        }
    }
    both.report();
}

#[test]
fn a_ball_leaves_a_platform_by_its_far_edge() {
    let mut both = Both::run(&ball_off_far_edge());
    // The middle of the ball passes the edge too fast to tip over it, and falls from 60 px.
    let (leaves, falls) = (50.0 / 60.0, (2.0 * (60.0 - LANDING) / G).sqrt());
    let time = leaves + falls;
    let tolerance = STEP + of_fall(falls, G * falls);
    both.check("time of landing", |run| run.crossing(0, LANDING).time).tolerance(tolerance).closed_form(time);
    for (name, axis, start, speed) in [("X", 0, -40.0, 30.0), ("Z", 2, 10.0, 60.0)] {
        both.check(&format!("landing, {name}"), |run| run.crossing(0, LANDING).position[axis])
            .tolerance(tolerance * speed)
            .closed_form(start + speed * time);
    }
    both.report();
}

#[test]
fn a_box_leaves_a_platform_by_its_near_edge_when_no_part_of_it_is_over_it() {
    let mut both = Both::run(&box_off_near_edge());
    let (leaves, falls) = (65.0 / 60.0, (2.0 * (60.0 - LANDING) / G).sqrt());
    let time = leaves + falls;
    let tolerance = STEP + of_fall(falls, G * falls);
    both.check("time of landing", |run| run.crossing(0, LANDING).time).tolerance(tolerance).closed_form(time);
    both.check("landing, Z", |run| run.crossing(0, LANDING).position[2])
        .tolerance(tolerance * 60.0)
        .closed_form(-10.0 - 60.0 * time);
    both.check("landing, X", |run| run.crossing(0, LANDING).position[0]).tolerance(0.01).closed_form(20.0);
    both.check("rotation", |run| run.crossing_rotation(0, LANDING)).tolerance(1e-3).closed_form(0.0);
    both.report();
}

/// Time after an impact at which velocities are read, s.
const AFTER_IMPACT: f64 = 0.02;

/// Compares the velocity just after a fall on a corner with the closed form `velocity`, px/s along X and up. The box falls by
/// `height` px. `rapier3d` bounces off corners although the restitution is 0: `bounce` is the measured excess in px/s.
fn check_fall_on_corner(both: &mut Both, height: f64, velocity: [f64; 2], bounce: f64) {
    let time = (2.0 * height / G).sqrt() + AFTER_IMPACT;
    // Gravity continues after the impact, which is up to 1.5 steps late.
    let tolerance = G * (AFTER_IMPACT + 1.5 * STEP);
    for (name, axis, value) in [("X", 0, velocity[0]), ("Y", 1, velocity[1])] {
        both.check(&format!("speed after impact, {name}"), |run| run.state_at(0, time).velocity[axis])
            .tolerances(tolerance + bounce, tolerance)
            .closed_form(value);
    }
}

#[test]
fn a_box_dropped_beyond_the_edge_of_a_platform_tips_over_it() {
    let mut both = Both::run(&box_tipping_over_edge());
    let inertia = (44.0 * 44.0 + 30.0 * 30.0) / 12.0;
    check_fall_on_corner(&mut both, 10.0, after_fall_on_corner(10.0, inertia, [-6.0, -15.0], 0.5), 7.0);
    // The tolerances are measured. `rapier3d` is ahead because the box bounced.
    both.check("time of landing", |run| run.crossing(0, LANDING).time).tolerance(0.2);
    both.check("landing, X", |run| run.crossing(0, LANDING).position[0]).tolerance(2.0);
    both.check("landing, rotation", |run| run.crossing_rotation(0, LANDING)).tolerance(0.05);
    both.check("rest, Z", |run| run.last(0).position[2]).tolerance(0.01).closed_form(5.0);
    both.hits(
        &[
            (ContactPartner::Object(0), ContactPartner::Platform(0)),
            (ContactPartner::Object(0), ContactPartner::Ground),
        ],
        |_| true,
    );
    both.report();
}

#[test]
fn objects_bounce_off_the_sides_of_platforms() {
    let mut both = Both::run(&against_every_side());
    let after = [[-45.0, 0.0, 0.0], [0.0, 0.0, -45.0], [5.0, -45.0, 0.0]];
    for (object, velocity) in after.into_iter().enumerate() {
        for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
            // Where an object hits a side at several points, `rapier3d` ends its iterations before they converge: measured
            // tolerance.
            both.check(&format!("speed of {object}, {name}"), |run| run.last(object).velocity[axis])
                .tolerances(if object == 0 && axis < 2 { 0.3 } else { 0.01 }, 0.01)
                .closed_form(velocity[axis]);
        }
    }
    both.check("rotation of 0", |run| run.last(0).angle).tolerances(3e-3, 1e-3).closed_form(0.0);
    both.report();
}

#[test]
fn objects_bounce_off_a_sheared_side_along_its_normal() {
    let mut both = Both::run(&against_sheared_side());
    let away = [1.0, 0.0, -shear_of_side()];
    let [after, _] = after_hit(([90.0, 0.0, 0.0], 1.0), ([0.0; 3], 0.0), 0.5, away);
    for object in 0..2 {
        for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
            // Where the box's edge hits the side at two points, `rapier3d` has a restitution of 0.62 instead of 0.5: measured
            // tolerance.
            both.check(&format!("speed of {object}, {name}"), |run| run.last(object).velocity[axis])
                .tolerances(if object == 1 && axis != 1 { 9.0 } else { 0.01 }, 0.01)
                .closed_form(after[axis]);
        }
    }
    both.report();
}

#[test]
fn friction_carries_the_load_of_a_sliding_box() {
    let mut both = Both::run(&box_on_sliding_box());
    // The load slides until both boxes have two thirds of the initial speed.
    let (acceleration, end) = (0.3 * G, 2.5);
    let sliding = 50.0 / (acceleration * 1.5);
    let path = acceleration * sliding * sliding / 2.0 + 50.0 * 2.0 / 3.0 * (end - sliding);
    for (name, axis, part) in [("X", 0, 0.6), ("Z", 2, 0.8)] {
        // In `rapier3d` friction deflects the load, as it does a box that slides obliquely: measured tolerance.
        both.check(&format!("{name} of the load"), |run| run.last(1).position[axis])
            .tolerances(of_contact(50.0) + 1.0, of_contact(50.0))
            .closed_form(10.0 + path * part);
        for object in 0..2 {
            both.check(&format!("speed of {object}, {name}"), |run| run.last(object).velocity[axis])
                .tolerance(0.1)
                .closed_form(50.0 * 2.0 / 3.0 * part);
        }
    }
    both.check("rest, Y of the load", |run| run.last(1).position[1]).tolerance(2.4 * SLOP).closed_form(20.0);
    both.report();
}

#[test]
fn a_box_that_falls_on_an_edge_comes_to_rest_on_a_side() {
    let mut both = Both::run(&tilted_drop());
    let time = (2.0 * (60.0 - LANDING) / G).sqrt();
    both.check("time of landing", |run| run.crossing(0, LANDING).time)
        .tolerance(of_fall(time, G * time))
        .closed_form(time);
    let (inertia, corner) = ((60.0 * 60.0 + 40.0 * 40.0) / 12.0, turned([30.0, -20.0], 0.3));
    check_fall_on_corner(&mut both, 60.0, after_fall_on_corner(60.0, inertia, corner, 0.6), 13.0);
    // The tolerance is measured. In `rapier3d` the box slides on while it bounces.
    both.check("rest, X", |run| run.last(0).position[0]).tolerance(10.0);
    both.check("rest, Y", |run| run.last(0).position[1]).tolerance(1.2 * SLOP).closed_form(0.0);
    both.check("rest, rotation", |run| run.last(0).angle).tolerance(5e-3).closed_form(0.0);
    both.report();
}

#[test]
fn heaps_settle_to_the_same_height_and_spread() {
    for count in [200, 1000] {
        let mut both = Both::run(&pile(count));
        let height = |state: BodyState| state.position[1];
        let from_middle = |state: BodyState| state.position[0].hypot(state.position[2]);
        // The directions in which objects fall are random. The tolerance is three standard errors of the difference of two
        // means.
        let errors = 3.0 * (2.0 / count as f64).sqrt();
        let deviation = |measure: fn(BodyState) -> f64| {
            move |run: &Run| {
                let mean = run.mean(count, measure);
                run.mean(count, |state| (measure(state) - mean).powi(2)).sqrt()
            }
        };
        let of_height = both.measure(deviation(height)) * errors;
        let of_spread = both.measure(deviation(from_middle)) * errors;
        both.check("mean height", |run| run.mean(count, height)).tolerance(of_height);
        both.check("mean distance from the middle", |run| run.mean(count, from_middle)).tolerance(of_spread);
        // In both engines objects still roll: measured tolerance.
        both.check("mean speed", |run| run.mean(count, |state| state.speed())).tolerance(1.0);
        both.report();
    }
}

#[test]
fn traffic_neither_sinks_nor_leaves_nor_gains_speed_in_either() {
    for count in [200, 2000] {
        let scene = traffic(count);
        let [wall, ..] = scene.objects[count + 1].position.map(f64::from);
        let (mut ours, mut peer) = (TwoHalf::new(&scene), Rapier::new(&scene));
        // The fastest object falls by 140 px and moves at 90 px/s along X and Z. A heavier object may pass on up to 1.5 times
        // as much.
        let fastest = 1.5 * (2.0 * G * 140.0 + 2.0 * 90.0_f64.powi(2)).sqrt();
        // Two objects that move towards each other may meet up to a step before the contact is found.
        let deepest = 2.0 * fastest * STEP;
        for step in 1..=400 {
            for (name, engine) in [("twohalf", &mut ours as &mut dyn World), ("rapier3d", &mut peer)] {
                engine.step(scene.dt);
                for object in 0..count {
                    let state = engine.body(object);
                    let [x, y, z] = state.position;
                    let is_fine = state.speed() < fastest
                        && y > -deepest
                        && x.abs().max(z.abs()) < wall - 30.0 + deepest;
                    assert!(is_fine, "{name}, {}, step {step}, object {object}: {state:?}", scene.name);
                }
            }
            for contact in ours.simulator().contacts() {
                assert!(contact.separation > -deepest as f32, "{}, step {step}: {contact:?}", scene.name);
            }
        }
    }
}

/// Prints the time per step of both engines and asserts none. Both have their default settings, run on one core and take turns.
#[test]
fn the_time_per_step_of_both_is_printed() {
    const ROUNDS: usize = 5;
    const STEPS: u32 = 300;
    let _alone = alone();
    let mut table =
        format!("\n{:<20}{:>16}{:>16}{:>10}\n", "time per step", "twohalf, ms", "rapier3d, ms", "ratio");
    let scenes = [20, 40, 200, 1000].map(traffic).into_iter().chain([200, 1000].map(pile));
    for scene in scenes {
        let mut times = [Vec::new(), Vec::new()];
        for _ in 0..ROUNDS {
            times[0].push(time_of(&mut TwoHalf::new(&scene), scene.dt, STEPS));
            times[1].push(time_of(&mut Rapier::new(&scene), scene.dt, STEPS));
        }
        let [ours, peer] = times.map(|mut list| {
            list.sort_by(f64::total_cmp);
            list[list.len() / 2]
        });
        table += &format!("{:<20}{ours:>16.4}{peer:>16.4}{:>10.2}\n", scene.name, peer / ours);
    }
    print!("{table}");
}

/// Returns the mean time per step, ms. Steps have a length of `dt` s.
fn time_of(engine: &mut dyn World, dt: f32, steps: u32) -> f64 {
    let start = Instant::now();
    for _ in 0..steps {
        engine.step(dt);
    }
    start.elapsed().as_secs_f64() * 1000.0 / f64::from(steps)
}
