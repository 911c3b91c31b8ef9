//! Checks of behaviour chapter 08: broad phases. Callbacks are checked with the handlers, the sort itself where it is.

use conformance::fixtures::plane::{
    BROAD_PHASES, add_box, add_floor, faithful, is_finite, pairs, simulator, simulator_with, v,
};
use farseer_core::{
    BodyId, BroadPhaseCollider, GeomId, GeomPairBitmap, PhysicsSimulator, SelectiveSweepOrder,
};

const BOX: (f32, f32) = (10.0, 10.0);

fn order_of(intervals: &[(f32, f32)]) -> Vec<usize> {
    let mut order = SelectiveSweepOrder::new(intervals.len());
    order.update(intervals);
    order.ends().map(|end| end.interval * 2 + usize::from(!end.is_begin)).collect()
}

/// Check 2.
#[test]
fn equal_intervals_are_ordered_as_by_the_original_sort() {
    assert_eq!(order_of(&[(0.0, 5.0); 4]), [6, 4, 2, 0, 1, 3, 5, 7]);
}

/// Check 4.
#[test]
fn intervals_behind_a_lower_one_are_ordered_as_by_the_original_sort() {
    let mut intervals = vec![(0.0, 10.0)];
    intervals.resize(9, (1.0, 9.0));
    assert_eq!(order_of(&intervals), [0, 8, 14, 12, 10, 16, 6, 4, 2, 3, 5, 7, 9, 11, 13, 15, 17, 1]);
}

/// Check 5: where the original fails, ends are ordered by value, then begins first, then creation.
#[test]
fn where_the_original_sort_fails_the_order_is_that_of_creation() {
    let mut two_minima = vec![(0.0, 10.0), (1.0, 9.0), (1.0, 9.0), (1.0, 9.0), (0.0, 9.0)];
    two_minima.resize(9, (1.0, 9.0));
    assert_eq!(order_of(&two_minima), [0, 8, 2, 4, 6, 10, 12, 14, 16, 3, 5, 7, 9, 11, 13, 15, 17, 1]);
    let begins_then_ends: Vec<usize> = (0..9).map(|i| i * 2).chain((0..9).map(|i| i * 2 + 1)).collect();
    assert_eq!(order_of(&[(0.0, 10.0); 9]), begins_then_ends);
}

/// Check 8. From 9 boxes on the original throws.
#[test]
fn columns_of_boxes_fall_with_equal_interval_ends() {
    for count in 2..=40 {
        for with_floor in [false, true] {
            let mut simulator = simulator(100.0);
            if with_floor {
                add_floor(&mut simulator, (1000.0, 20.0), v(0.0, 2000.0));
            }
            let boxes: Vec<BodyId> =
                (0..count).map(|i| add_box(&mut simulator, BOX, v(0.0, 50.0 * i as f32)).0).collect();
            (0..30).for_each(|_| simulator.update(0.01));
            assert!(is_finite(&simulator));
            assert!(boxes.iter().all(|&body| simulator[body].linear_velocity().y > 29.0));
        }
    }
}

/// One round of the broad phase alone. No contact is resolved, so that the list is empty afterwards.
fn found(simulator: &mut PhysicsSimulator) -> Vec<(u32, u32)> {
    simulator.set_max_contacts_to_resolve(0).unwrap();
    assert!(simulator.process_queues(0.01, None));
    simulator.find_pairs(None);
    let found = pairs(simulator);
    simulator.collide_pairs(None);
    assert_eq!(simulator.arbiter_count(), 0);
    found
}

fn six_boxes(broad: BroadPhaseCollider) -> (PhysicsSimulator, Vec<(BodyId, GeomId)>) {
    let mut simulator = simulator_with(0.0, faithful(broad, Default::default()));
    let boxes =
        (0..6).map(|i| add_box(&mut simulator, BOX, v(7.0 * i as f32, 4.0 * (i % 3) as f32))).collect();
    (simulator, boxes)
}

/// Check 9.
#[test]
fn all_broad_phases_find_the_same_pairs_until_a_removal() {
    for broad in BROAD_PHASES {
        let is_sap = broad == BroadPhaseCollider::SweepAndPrune;
        let (mut simulator, boxes) = six_boxes(broad);
        assert_eq!(found(&mut simulator), [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5)], "{broad:?}");
        for &(body, _) in &boxes {
            let old = simulator[body].position();
            simulator[body].set_position(v(2.0 * old.y, old.x / 2.0));
        }
        let expected = if is_sap {
            [(0, 1), (1, 2), (1, 3), (3, 4), (4, 5), (2, 4)]
        } else {
            [(0, 1), (1, 2), (1, 3), (2, 4), (3, 4), (4, 5)]
        };
        assert_eq!(found(&mut simulator), expected, "{broad:?}");
        simulator.remove(boxes[2].1).unwrap();
        let expected = if is_sap { vec![] } else { vec![(0, 1), (1, 3), (3, 4), (4, 5)] };
        assert_eq!(found(&mut simulator), expected, "{broad:?}");
        if let BroadPhaseCollider::SpatialHash { cell_size, .. } = simulator.broad_phase_collider() {
            assert_eq!(cell_size, 20.0);
        }
    }
}

/// Check 10.
#[test]
fn stale_collision_ids_duplicate_one_pair_and_hide_another() {
    let mut simulator = simulator(0.0);
    let boxes: Vec<(BodyId, GeomId)> =
        (0..4).map(|i| add_box(&mut simulator, BOX, v(6.0 * i as f32, 0.0))).collect();
    for &(_, geom) in &boxes {
        simulator[geom].set_collision_response_enabled(false);
    }
    simulator.update(0.01);
    assert_eq!(pairs(&simulator), [(0, 1), (1, 2), (2, 3)]);
    simulator.remove(boxes[0].1).unwrap();
    for _ in 0..3 {
        simulator.update(0.01);
        assert_eq!(pairs(&simulator), [(1, 2), (2, 3), (1, 2)]);
    }
}

/// Check 12.
#[test]
fn the_pair_table_never_shrinks() {
    let mut table = GeomPairBitmap::new(5);
    let asked = [(1, 3), (3, 1), (3, 4)].map(|(a, b)| table.test_and_set(a, b));
    assert_eq!(asked, [false, true, false]);
    assert_eq!((table.index(1, 3), table.index(3, 4)), (Some(5), Some(9)));
    table.clear(3);
    assert_eq!((table.size(), table.index(0, 2)), (5, Some(1)));
    assert!(!table.test_and_set(0, 2) && !table.test_and_set(1, 3));
}

/// Check 12: the original fails for equal ids.
#[test]
fn pairs_outside_of_the_table_count_as_present() {
    let mut table = GeomPairBitmap::new(5);
    assert_eq!((table.index(0, 0), table.index(9, 9), table.index(-1, 0)), (None, None, None));
    assert!(table.test_and_set(0, 0) && table.test_and_set(9, 9));
    assert!(GeomPairBitmap::default().test_and_set(0, 1));
}

/// Check 15. Swept along y the pairs come in the order of y, along x in that of x.
#[test]
fn the_less_crowded_axis_is_swept_and_y_if_both_are_equal() {
    let order = |positions: [(f32, f32); 3]| {
        let mut simulator = simulator(0.0);
        for (x, y) in positions {
            add_box(&mut simulator, BOX, v(x, y));
        }
        found(&mut simulator)
    };
    assert_eq!(order([(0.0, 18.0), (0.1, 0.0), (0.2, 9.0)]), [(1, 2), (0, 2)], "y is less crowded");
    assert_eq!(order([(18.0, 0.0), (0.0, 0.1), (9.0, 0.2)]), [(1, 2), (0, 2)], "x is less crowded");
    // On a diagonal both are equally crowded: x ascends, y descends.
    assert_eq!(order([(0.0, 18.0), (9.0, 9.0), (18.0, 0.0)]), [(1, 2), (0, 1)], "y wins");
}

/// Section 2.2: a box that is a single point meets open intervals but never becomes open itself.
#[test]
fn point_boxes_pair_with_boxes_but_not_with_each_other() {
    use farseer_core::{Body, GeomPlacement, Vertices};
    let mut simulator = simulator(0.0);
    for _ in 0..2 {
        let body = simulator.create_body(Body::new());
        let point: Vertices = [v(0.0, 0.0)].into_iter().collect();
        let geom = simulator.create_geom(body, point, GeomPlacement::with_grid_size(1.0)).unwrap();
        simulator.add(geom).unwrap();
    }
    assert_eq!(found(&mut simulator), []);
    add_box(&mut simulator, BOX, v(1.0, 1.0));
    let mut met = found(&mut simulator);
    met.sort_unstable();
    assert_eq!(met, [(0, 2), (1, 2)]);
}

/// Section 3.3: with sweep and prune a pair that was accepted stays registered while the boxes overlap, even if it would be
/// refused now; it leaves the list by its contacts, and comes back.
#[test]
fn sweep_and_prune_keeps_a_pair_that_was_accepted_once() {
    let mut simulator = simulator_with(0.0, faithful(BroadPhaseCollider::SweepAndPrune, Default::default()));
    let (_, a) = add_box(&mut simulator, BOX, v(0.0, 0.0));
    let (_, b) = add_box(&mut simulator, BOX, v(9.0, 1.0));
    assert_eq!(found(&mut simulator), [(0, 1)]);
    simulator.ignore_collision_with(a, b).unwrap();
    assert_eq!(found(&mut simulator), [(0, 1)]);
}

/// Section 3.4.
#[test]
fn sweep_and_prune_drops_resting_pairs_when_a_geom_is_removed() {
    let mut simulator = simulator_with(0.0, faithful(BroadPhaseCollider::SweepAndPrune, Default::default()));
    let (_, far) = add_box(&mut simulator, BOX, v(500.0, 0.0));
    add_box(&mut simulator, BOX, v(0.0, 0.0));
    add_box(&mut simulator, BOX, v(9.0, 1.0));
    assert_eq!(found(&mut simulator), [(1, 2)]);
    simulator.remove(far).unwrap();
    assert_eq!(found(&mut simulator), []);
}
