//! Collisions and pairs that a handler refuses, or approves of.

use conformance::fixtures::plane::{BROAD_PHASES, add_box, faithful, simulator, simulator_with, v};
use farseer_core::{BroadPhaseCollider, Event, NarrowPhaseCollider};

use super::{Log, collision, told};

/// Behaviour chapter 03, check 4.
#[test]
fn a_refused_collision_is_not_reported_to_the_second_side_and_separates() {
    let mut simulator = simulator(0.0);
    let (_, a) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let (_, b) = add_box(&mut simulator, (10.0, 10.0), v(9.0, 0.0));
    simulator.process_added_and_removed();
    let mut log = Log { refuses_collisions: true, ..Log::default() };
    for _ in 0..3 {
        let separation = |this, other| Event::Separation { this, other };
        let expected = [collision(a, b, 4, true), separation(a, b), separation(b, a)];
        assert_eq!(told(&mut simulator, &mut log), expected);
    }
}

#[test]
fn a_refused_pair_gets_the_callback_again_except_with_sweep_and_prune() {
    for (broad, asked_again) in BROAD_PHASES.into_iter().zip([true, false, true, true]) {
        let mut simulator = simulator_with(0.0, faithful(broad, NarrowPhaseCollider::DistanceGrid));
        add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        add_box(&mut simulator, (10.0, 10.0), v(9.0, 1.0));
        let mut log = Log { asks_broad_phase: true, refuses_pairs: true, ..Log::default() };
        simulator.process_added_and_removed();
        assert!(!told(&mut simulator, &mut log).is_empty());
        assert_eq!(!told(&mut simulator, &mut log).is_empty(), asked_again, "{broad:?}");
        log.refuses_pairs = false;
        told(&mut simulator, &mut log);
        assert_eq!(simulator.arbiter_count(), usize::from(asked_again), "{broad:?}");
    }
}

/// Behaviour chapter 08, check 11.
#[test]
fn an_approval_replaces_the_box_test_of_brute_force_and_spatial_hash() {
    let hash = BroadPhaseCollider::SpatialHash { cell_size: 10.0, auto_adjust_cell_size: true };
    for (broad, is_registered) in
        BROAD_PHASES[..3].iter().copied().chain([hash]).zip([false, false, true, true])
    {
        let mut simulator = simulator_with(0.0, faithful(broad, NarrowPhaseCollider::DistanceGrid));
        add_box(&mut simulator, (2.0, 2.0), v(-3.0, -3.0));
        add_box(&mut simulator, (2.0, 2.0), v(3.0, 3.0));
        let mut log = Log { asks_broad_phase: true, ..Log::default() };
        simulator.process_queues(0.01, Some(&mut log));
        simulator.find_pairs(Some(&mut log));
        assert_eq!(simulator.arbiter_count(), usize::from(is_registered), "{broad:?}");
        if let BroadPhaseCollider::SpatialHash { cell_size, .. } = simulator.broad_phase_collider() {
            assert_eq!(cell_size, 4.0);
        }
    }
}
