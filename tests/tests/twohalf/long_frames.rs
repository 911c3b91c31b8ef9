//! Updates of a game that was suspended for a moment: of a quarter of a second, and of a whole one.

use conformance::fixtures::depth::{ball, crate_box, fix, place, platform, run, solid};
use twohalf::{BodyId, TwoHalfPhysicsSimulator, Vector2};

const GRAVITY: f32 = 900.0;

/// Greatest depth in px. Contacts yield more in long steps: a body of 30 px that falls from 3,000 px is 9.5 px deep after a
/// step of 1 s, at most.
const DEEPEST: f32 = 10.0;

fn things(simulator: &mut TwoHalfPhysicsSimulator, height: f32) -> [BodyId; 2] {
    [crate_box(simulator, [30.0, 30.0], [-200.0, height, 0.0]), ball(simulator, 15.0, [200.0, height, 0.0])]
}

/// Depth in px of a body that CCD has stopped: it overlaps the obstacle by half of the reach of contacts, 0.32 px, and may have
/// slept there since.
const STOPPED: f32 = 0.33;

/// Drops bodies on a floor whose top is at a height, from all heights, in updates of all lengths.
fn assert_nothing_falls_through(top: f32, make_floor: impl Fn(&mut TwoHalfPhysicsSimulator)) {
    for frame in [0.25, 0.5, 1.0] {
        for fall in [0.0, 1.0, 100.0, 300.0, 750.0, 1750.0, 3000.0] {
            let mut simulator =
                TwoHalfPhysicsSimulator::with_gravity(600, Vector2::new(0.0, GRAVITY)).unwrap();
            make_floor(&mut simulator);
            let bodies = things(&mut simulator, top + fall);
            for _ in 0..20 {
                simulator.update(frame);
                let lowest = bodies.map(|body| place(&simulator, body).y - top);
                assert!(lowest.into_iter().all(|y| y > -DEEPEST), "{lowest:?}: {fall} px, {frame} s");
            }
        }
    }
}

#[test]
fn a_long_frame_leaves_no_body_below_the_ground() {
    assert_nothing_falls_through(0.0, |_| {});
}

#[test]
fn a_long_frame_leaves_no_body_below_a_platform_thicker_than_the_yield_of_contacts() {
    for height in [20.0, 100.0] {
        assert_nothing_falls_through(2000.0, |simulator| {
            platform(simulator, [1000.0, height, 100.0], [0.0, 2000.0 - height, 0.0]);
        });
    }
}

#[test]
fn a_long_frame_leaves_no_body_below_a_static_body() {
    assert_nothing_falls_through(2000.0, |simulator| {
        let floor = solid(simulator, [1000.0, 20.0, 100.0], [0.0, 1980.0, 0.0]);
        fix(simulator, floor);
    });
}

#[test]
fn after_two_long_frames_amid_short_ones_a_body_lies_where_it_would_have_lain() {
    for fall in 0..40 {
        let mut simulator = TwoHalfPhysicsSimulator::with_gravity(600, Vector2::new(0.0, GRAVITY)).unwrap();
        platform(&mut simulator, [1000.0, 5.0, 100.0], [0.0, 195.0, 0.0]);
        let bodies = things(&mut simulator, 200.0 + 25.0 * fall as f32);
        run(&mut simulator, 20);
        (0..2).for_each(|_| simulator.update(1.0));
        run(&mut simulator, 300);
        for body in bodies {
            assert!(
                (place(&simulator, body).y - 200.0).abs() < STOPPED,
                "{fall}: {:?}",
                place(&simulator, body)
            );
        }
    }
}
