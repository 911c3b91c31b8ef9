//! Tests long runs in which objects are added and removed.

use farseer_core::{BroadPhaseCollider, Methods, NarrowPhaseCollider};
use fuzz::churn::{DepthChurn, PlaneChurn};
use fuzz::soak::does_not_grow;

const UPDATES: usize = 50_000;
/// Number of updates of a run in 2.5D. Each costs as much as three updates in 2D.
const DEPTH_UPDATES: usize = 20_000;

fn faithful(broad: BroadPhaseCollider) -> Methods {
    Methods::Faithful { broad, narrow: NarrowPhaseCollider::default() }
}

#[test]
fn snapshots_and_work_with_the_selective_sweep_do_not_grow_over_time() {
    does_not_grow(&mut PlaneChurn::new(faithful(BroadPhaseCollider::SelectiveSweep)).unwrap(), UPDATES)
        .unwrap();
}

#[test]
fn snapshots_and_work_with_sweep_and_prune_do_not_grow_over_time() {
    does_not_grow(&mut PlaneChurn::new(faithful(BroadPhaseCollider::SweepAndPrune)).unwrap(), UPDATES)
        .unwrap();
}

#[test]
fn snapshots_and_work_with_the_spatial_hash_do_not_grow_over_time() {
    does_not_grow(&mut PlaneChurn::new(faithful(BroadPhaseCollider::SPATIAL_HASH)).unwrap(), UPDATES)
        .unwrap();
}

#[test]
fn snapshots_and_work_with_brute_force_do_not_grow_over_time() {
    does_not_grow(&mut PlaneChurn::new(faithful(BroadPhaseCollider::BruteForce)).unwrap(), UPDATES).unwrap();
}

#[test]
fn snapshots_and_work_with_the_precise_set_do_not_grow_over_time() {
    does_not_grow(&mut PlaneChurn::new(Methods::PRECISE).unwrap(), UPDATES).unwrap();
}

#[test]
fn snapshots_and_work_in_2_5d_do_not_grow_with_ropes_platforms_and_upright_shapes() {
    does_not_grow(&mut DepthChurn::new(0).unwrap(), DEPTH_UPDATES).unwrap();
}
