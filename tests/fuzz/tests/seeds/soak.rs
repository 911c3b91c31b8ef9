//! Long runs in which things come and go.

use farseer_core::BroadPhaseCollider;
use fuzz::soak::snapshots_stay_as_long;

const UPDATES: usize = 50_000;

#[test]
fn snapshots_with_the_selective_sweep_do_not_grow_while_things_come_and_go() {
    snapshots_stay_as_long(BroadPhaseCollider::SelectiveSweep, UPDATES).unwrap();
}

#[test]
fn snapshots_with_sweep_and_prune_do_not_grow_while_things_come_and_go() {
    snapshots_stay_as_long(BroadPhaseCollider::SweepAndPrune, UPDATES).unwrap();
}

#[test]
fn snapshots_with_the_spatial_hash_do_not_grow_while_things_come_and_go() {
    snapshots_stay_as_long(BroadPhaseCollider::SPATIAL_HASH, UPDATES).unwrap();
}

#[test]
fn snapshots_with_brute_force_do_not_grow_while_things_come_and_go() {
    snapshots_stay_as_long(BroadPhaseCollider::BruteForce, UPDATES).unwrap();
}
