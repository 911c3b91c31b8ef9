//! Long runs in which things come and go.

use farseer_core::BroadPhaseCollider;
use fuzz::soak::snapshot_lengths;

/// A fifth more than in the first thousand updates: ids and creation numbers take more bytes the higher they are.
fn snapshots_stay_as_long(method: BroadPhaseCollider) {
    let lengths = snapshot_lengths(method, 5, 4000).unwrap();
    assert!(lengths[4] * 5 <= lengths[0] * 6, "{lengths:?}");
}

#[test]
fn snapshots_with_the_selective_sweep_do_not_grow_while_things_come_and_go() {
    snapshots_stay_as_long(BroadPhaseCollider::SelectiveSweep);
}

#[test]
fn snapshots_with_sweep_and_prune_do_not_grow_while_things_come_and_go() {
    snapshots_stay_as_long(BroadPhaseCollider::SweepAndPrune);
}

#[test]
fn snapshots_with_the_spatial_hash_do_not_grow_while_things_come_and_go() {
    snapshots_stay_as_long(BroadPhaseCollider::SPATIAL_HASH);
}

#[test]
fn snapshots_with_brute_force_do_not_grow_while_things_come_and_go() {
    snapshots_stay_as_long(BroadPhaseCollider::BruteForce);
}
