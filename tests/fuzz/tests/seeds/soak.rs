//! Long runs in which things come and go.

use farseer_core::{BroadPhaseCollider, Methods, NarrowPhaseCollider};
use fuzz::soak::snapshots_stay_as_long;

const UPDATES: usize = 50_000;

fn faithful(broad: BroadPhaseCollider) -> Methods {
    Methods::Faithful { broad, narrow: NarrowPhaseCollider::default() }
}

#[test]
fn snapshots_with_the_selective_sweep_do_not_grow_while_things_come_and_go() {
    snapshots_stay_as_long(faithful(BroadPhaseCollider::SelectiveSweep), UPDATES).unwrap();
}

#[test]
fn snapshots_with_sweep_and_prune_do_not_grow_while_things_come_and_go() {
    snapshots_stay_as_long(faithful(BroadPhaseCollider::SweepAndPrune), UPDATES).unwrap();
}

#[test]
fn snapshots_with_the_spatial_hash_do_not_grow_while_things_come_and_go() {
    snapshots_stay_as_long(faithful(BroadPhaseCollider::SPATIAL_HASH), UPDATES).unwrap();
}

#[test]
fn snapshots_with_brute_force_do_not_grow_while_things_come_and_go() {
    snapshots_stay_as_long(faithful(BroadPhaseCollider::BruteForce), UPDATES).unwrap();
}

#[test]
fn snapshots_with_the_precise_set_do_not_grow_while_things_come_and_go() {
    snapshots_stay_as_long(Methods::PRECISE, UPDATES).unwrap();
}
