//! Long runs in which things come and go.

use farseer_core::{BroadPhaseCollider, Methods, NarrowPhaseCollider};
use fuzz::churn::{DepthChurn, PlaneChurn};
use fuzz::soak::stays_as_it_is;

const UPDATES: usize = 50_000;
/// Each of which costs as much as three of 2D.
const DEPTH_UPDATES: usize = 20_000;

fn faithful(broad: BroadPhaseCollider) -> Methods {
    Methods::Faithful { broad, narrow: NarrowPhaseCollider::default() }
}

#[test]
fn snapshots_and_work_with_the_selective_sweep_do_not_grow_while_things_come_and_go() {
    stays_as_it_is(&mut PlaneChurn::new(faithful(BroadPhaseCollider::SelectiveSweep)).unwrap(), UPDATES)
        .unwrap();
}

#[test]
fn snapshots_and_work_with_sweep_and_prune_do_not_grow_while_things_come_and_go() {
    stays_as_it_is(&mut PlaneChurn::new(faithful(BroadPhaseCollider::SweepAndPrune)).unwrap(), UPDATES)
        .unwrap();
}

#[test]
fn snapshots_and_work_with_the_spatial_hash_do_not_grow_while_things_come_and_go() {
    stays_as_it_is(&mut PlaneChurn::new(faithful(BroadPhaseCollider::SPATIAL_HASH)).unwrap(), UPDATES)
        .unwrap();
}

#[test]
fn snapshots_and_work_with_brute_force_do_not_grow_while_things_come_and_go() {
    stays_as_it_is(&mut PlaneChurn::new(faithful(BroadPhaseCollider::BruteForce)).unwrap(), UPDATES).unwrap();
}

#[test]
fn snapshots_and_work_with_the_precise_set_do_not_grow_while_things_come_and_go() {
    stays_as_it_is(&mut PlaneChurn::new(Methods::PRECISE).unwrap(), UPDATES).unwrap();
}

#[test]
fn snapshots_and_work_in_2_5d_do_not_grow_while_ropes_platforms_and_what_stands_upright_come_and_go() {
    stays_as_it_is(&mut DepthChurn::new(0).unwrap(), DEPTH_UPDATES).unwrap();
}
