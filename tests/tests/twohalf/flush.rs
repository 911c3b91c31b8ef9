//! Bodies flush with a platform, over its edge or lower than it by less than a player sees, with the precise set.
//!
//! A body that is pressed into one face is as deep in the next one; contacts of other bodies are exact to a fiftieth of a px.

use conformance::fixtures::depth::{
    DT, assert_goes_on_after_loading, assert_near, place, platform, set_platform_surface, simulator, solid,
    throw, velocity, with_scheme,
};
use twohalf::{BodyId, DepthScheme, TwoHalfPhysicsSimulator, Vector2};

/// Steps per second.
const RATES: [f32; 4] = [30.0, 60.0, 120.0, 200.0];
/// A fraction of a px, which is the accuracy of contacts.
const LITTLE: f32 = 0.02;
/// How deep a box of its own weight may lie, px: g / omega^2, with the 48 Hz that a contact has at 30 steps per second.
const REST: f32 = 2e-3;

fn smooth(gravity: f32) -> TwoHalfPhysicsSimulator {
    TwoHalfPhysicsSimulator::with_gravity(600, Vector2::new(0.0, gravity)).unwrap()
}

fn slippery(simulator: &mut TwoHalfPhysicsSimulator, size: [f32; 3], at: [f32; 3]) {
    let made = platform(simulator, size, at);
    set_platform_surface(simulator, made, 0.0, 0.0);
}

/// A box of 40 x 20 x 20 px that does not turn, as figures do not.
fn figure(simulator: &mut TwoHalfPhysicsSimulator, at: [f32; 3]) -> BodyId {
    let body = solid(simulator, [40.0, 20.0, 20.0], at);
    simulator.body_mut(body).unwrap().core_mut().set_moment_of_inertia(1e12).unwrap();
    body
}

fn run(simulator: &mut TwoHalfPhysicsSimulator, rate: f32, seconds: f32) {
    (0..(seconds * rate) as usize).for_each(|_| simulator.update(1.0 / rate));
}

#[test]
fn a_body_that_overlaps_an_edge_by_a_fiftieth_of_a_px_lands_on_it() {
    for rate in RATES {
        for side in [-1.0, 1.0] {
            let mut simulator = smooth(100.0);
            slippery(&mut simulator, [200.0, 60.0, 100.0], [0.0; 3]);
            let body = figure(&mut simulator, [0.0, 120.0, side * (60.0 - LITTLE)]);
            throw(&mut simulator, body, [0.0, -300.0, 0.0]);
            run(&mut simulator, rate, 2.0);
            assert_near(place(&simulator, body).y, 60.0, REST);
        }
    }
}

#[test]
fn a_step_of_a_fiftieth_of_a_px_stops_a_box_that_slides() {
    for rate in RATES {
        for side in [-1.0, 1.0] {
            let mut simulator = smooth(100.0);
            slippery(&mut simulator, [200.0, LITTLE, 100.0], [0.0; 3]);
            let body = figure(&mut simulator, [0.0, 0.0, side * 90.3]);
            let mut view = simulator.body_mut(body).unwrap();
            view.ground_mut().set_friction_coefficient(0.0);
            throw(&mut simulator, body, [0.0, 0.0, -60.0 * side]);
            run(&mut simulator, rate, 1.5);
            // As deep in the step as the contact spring yields at 60 px/s.
            assert_near(place(&simulator, body).z * side, 60.0, LITTLE);
        }
    }
}

#[test]
fn a_box_falls_into_a_hole_that_is_a_px_wider_than_it() {
    // It is over the hole for 1 / 50 s, in which it falls by g t^2 / 2 = 0.02 px: unless that is less than a step.
    for rate in RATES.into_iter().filter(|&rate| rate > 50.0) {
        for phase in 0..5 {
            let mut simulator = smooth(100.0);
            for side in [-110.5, 110.5] {
                slippery(&mut simulator, [200.0, 60.0, 200.0], [0.0, 0.0, side]);
            }
            let body = figure(&mut simulator, [0.0, 60.0, -80.0 - 0.2 * phase as f32]);
            throw(&mut simulator, body, [0.0, 0.0, 50.0]);
            run(&mut simulator, rate, 4.0);
            assert!(place(&simulator, body).y < 1.0, "{rate} per second, phase {phase}");
        }
    }
}

#[test]
fn a_stack_slides_over_a_seam_however_deep_its_load_presses_it() {
    for rate in RATES {
        for along_z in [false, true] {
            let mut simulator = smooth(2000.0);
            let turned = |along: f32, y: f32| if along_z { [0.0, y, along] } else { [along, y, 0.0] };
            for at in [-200.0, 200.0] {
                slippery(&mut simulator, [400.0, 40.0, 400.0], turned(at, 0.0));
            }
            let boxes: [BodyId; 8] = std::array::from_fn(|at| {
                let body = solid(&mut simulator, [20.0; 3], turned(-60.0, 40.0 + 20.0 * at as f32));
                simulator.body_mut(body).unwrap().core_mut().set_moment_of_inertia(1e12).unwrap();
                body
            });
            run(&mut simulator, rate, 1.0);
            boxes.iter().for_each(|&body| throw(&mut simulator, body, turned(100.0, 0.0)));
            run(&mut simulator, rate, 1.0);
            let speed = velocity(&simulator, boxes[0]);
            assert_near(if along_z { speed.z } else { speed.x }, 100.0, 0.01);
        }
    }
}

/// Sets the velocity before every update, as games do.
fn push(simulator: &mut TwoHalfPhysicsSimulator, body: BodyId, rate: f32, aside: f32, into: f32) {
    let up = velocity(simulator, body).y;
    throw(simulator, body, [aside, up, into]);
    simulator.update(1.0 / rate);
}

#[test]
fn a_figure_pressed_hard_against_a_wall_of_two_platforms_slides_over_the_seam() {
    for rate in RATES {
        for press in [40.0, 100.0, 200.0] {
            let mut simulator = smooth(900.0);
            for at in [-100.0, 100.0] {
                platform(&mut simulator, [200.0, 80.0, 100.0], [at, 0.0, 100.0]);
            }
            let body = figure(&mut simulator, [-60.0, 0.0, 35.0]);
            (0..rate as usize).for_each(|_| push(&mut simulator, body, rate, 150.0, press));
            // Friction may act a little in the step in which it comes to the wall.
            assert_near(place(&simulator, body).x, 90.0, 3.0);
        }
    }
}

/// Jumps beside a wall of 40 px, pressing against it until it is past its top, and comes down again.
fn height_after_jump(rate: f32, press: f32) -> f32 {
    let mut simulator = smooth(900.0);
    platform(&mut simulator, [80.0, 40.0, 80.0], [0.0; 3]);
    let body = figure(&mut simulator, [0.0, 0.0, -50.1]);
    (0..(0.2 * rate) as usize).for_each(|_| push(&mut simulator, body, rate, 0.0, press));
    throw(&mut simulator, body, [0.0, 400.0, 0.0]);
    while place(&simulator, body).y < 40.0 {
        push(&mut simulator, body, rate, 0.0, press);
    }
    (0..rate as usize).for_each(|_| push(&mut simulator, body, rate, 0.0, 0.0));
    place(&simulator, body).y
}

#[test]
fn a_figure_that_stops_pressing_at_the_top_of_a_wall_falls_in_front_of_it() {
    for rate in RATES {
        for press in [10.0, 100.0, 200.0] {
            let height = height_after_jump(rate, press);
            assert!(height < 1.0, "{rate} per second, {press} px/s: {height}");
        }
    }
}

#[test]
fn the_depth_of_a_pressed_contact_is_saved() {
    with_scheme(DepthScheme::Precise, || {
        let mut simulator = simulator();
        platform(&mut simulator, [80.0, 40.0, 80.0], [0.0; 3]);
        let body = figure(&mut simulator, [0.0, 34.0, -50.1]);
        // 4 px above the top, and down there again after 57 steps.
        let mut up = 45.0;
        while place(&simulator, body).y < 40.0 {
            throw(&mut simulator, body, [0.0, up, 150.0]);
            simulator.update(DT);
            up = velocity(&simulator, body).y;
        }
        throw(&mut simulator, body, [0.0, up, 0.0]);
        // Deeper than a flush body that was never pressed.
        let depth = place(&simulator, body).z + 50.0;
        assert!(depth > LITTLE, "{depth}");
        assert_goes_on_after_loading(&mut simulator, &[body]);
        run(&mut simulator, 1.0 / DT, 0.3);
        assert!(place(&simulator, body).y < 39.0);
    });
}
