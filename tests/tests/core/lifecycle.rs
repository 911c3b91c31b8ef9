//! Addition, removal and disposal, also in odd orders: no call panics, and no id refers to a removed object.

use conformance::fixtures::plane::{
    add_box, add_floor, faithful, faithful_methods, is_finite, methods, pairs, simulator, simulator_with, v,
};
use farseer_core::{Body, Error, GeomFactory, GeomPlacement};

#[test]
fn a_disposed_geom_may_be_moved_to_another_body() {
    let mut simulator = simulator(0.0);
    let (_, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let (other, _) = add_box(&mut simulator, (10.0, 10.0), v(50.0, 0.0));
    simulator.update(0.01);
    simulator.dispose(geom).unwrap();
    // Refused or not, the other body must not have a disposed geom.
    let _ = simulator.set_body(geom, other);
    simulator.update(0.01);
    simulator[other].set_position(v(60.0, 0.0));
    simulator.update(0.01);
    assert_eq!(simulator.geoms_of(other).len(), 1);
}

#[test]
fn a_touching_geom_may_be_moved_to_a_disposed_body() {
    for methods in methods() {
        let mut simulator = simulator_with(100.0, methods);
        let (_, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        add_floor(&mut simulator, (100.0, 10.0), v(0.0, 9.5));
        let disposed = simulator.create_body(Body::new());
        simulator.add(disposed).unwrap();
        simulator.update(0.01);
        assert_eq!(simulator.arbiter_count(), 1);
        simulator.dispose(disposed).unwrap();
        let _ = simulator.set_body(geom, disposed);
        for _ in 0..3 {
            simulator.update(0.01);
        }
        assert!(simulator.body(disposed).is_none());
        assert!(simulator.geom(geom).is_none_or(|geom| simulator.body(geom.body()).is_some()));
    }
}

/// A simulator with a geom that was attached to a body after the body was disposed, one update later.
fn geom_of_a_lost_body() -> (farseer_core::PhysicsSimulator, Option<farseer_core::GeomId>) {
    let mut simulator = simulator(0.0);
    let body = simulator.create_body(Body::new());
    simulator.add(body).unwrap();
    simulator.update(0.01);
    simulator.dispose(body).unwrap();
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_rectangle_geom_in(&mut simulator, body, 10.0, 10.0, placement).ok();
    simulator.update(0.01);
    (simulator, geom)
}

#[test]
fn a_geom_attached_to_a_disposed_body_is_removed_with_it() {
    let (simulator, geom) = geom_of_a_lost_body();
    assert!(geom.is_none_or(|geom| simulator.geom(geom).is_none()));
    assert!(simulator.geom_list().is_empty());
}

#[test]
fn a_geom_of_a_lost_body_may_be_disposed() {
    let (mut simulator, geom) = geom_of_a_lost_body();
    if let Some(geom) = geom {
        let _ = simulator.dispose(geom);
    }
    simulator.update(0.01);
}

#[test]
fn a_geom_of_a_lost_body_may_be_made_a_sensor() {
    let (mut simulator, geom) = geom_of_a_lost_body();
    if let Some(geom) = geom {
        let _ = simulator.set_is_sensor(geom, true);
    }
    simulator.update(0.01);
}

#[test]
fn a_geom_of_a_lost_body_may_get_another_body() {
    let (mut simulator, geom) = geom_of_a_lost_body();
    let other = simulator.create_body(Body::new());
    if let Some(geom) = geom {
        let _ = simulator.set_body(geom, other);
    }
    simulator.update(0.01);
}

#[test]
fn removals_between_two_stages_are_safe() {
    for methods in faithful_methods() {
        let mut simulator = simulator_with(100.0, methods);
        let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        add_floor(&mut simulator, (100.0, 10.0), v(1.0, 9.5));
        simulator.process_queues(0.01, None);
        simulator.find_pairs(None);
        simulator.collide_pairs(None);
        simulator.apply_forces(0.01, 0.0, None);
        simulator.pre_step(100.0);
        simulator.dispose(body).unwrap();
        simulator.process_added_and_removed();
        simulator.solve_iteration(None);
        simulator.integrate(0.01, None);
        simulator.update(0.01);
        assert!(simulator.body(body).is_none() && is_finite(&simulator));
    }
}

#[test]
fn a_disposed_id_stays_stale_when_its_slot_is_used_again() {
    let mut simulator = simulator(0.0);
    let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    simulator.update(0.01);
    simulator.dispose(body).unwrap();
    simulator.update(0.01);
    let (new_body, new_geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    assert_eq!((new_body.slot(), new_geom.slot()), (body.slot(), geom.slot()));
    assert!(simulator.body(body).is_none() && simulator.geom(geom).is_none());
    assert_eq!(simulator.add(body), Err(Error::StaleId { argument: "body" }));
    assert_eq!(simulator.remove(geom), Err(Error::StaleId { argument: "geom" }));
    assert_eq!(simulator.dispose(geom), Err(Error::StaleId { argument: "geom" }));
}

#[test]
fn a_pending_object_may_be_disposed() {
    for methods in methods() {
        let mut simulator = simulator_with(0.0, methods);
        let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        simulator.dispose(body).unwrap();
        simulator.update(0.01);
        assert!(simulator.body(body).is_none() && simulator.geom(geom).is_none());
        assert!(simulator.body_list().is_empty() && simulator.geom_list().is_empty());
        simulator.update(0.01);
    }
}

#[test]
fn a_removed_geom_that_was_paired_in_the_same_round_may_be_disposed() {
    for methods in methods() {
        let mut simulator = simulator_with(0.0, methods);
        let (_, removed) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        add_box(&mut simulator, (10.0, 10.0), v(100.0, 0.0));
        simulator.update(0.01);
        simulator.remove(removed).unwrap();
        add_box(&mut simulator, (10.0, 10.0), v(8.0, 1.0));
        simulator.update(0.01);
        simulator.dispose(removed).unwrap();
        for _ in 0..3 {
            simulator.update(0.01);
        }
        assert_eq!(pairs(&simulator), []);
    }
}

#[test]
fn clearing_makes_all_ids_stale_and_keeps_the_settings() {
    let mut simulator =
        simulator_with(7.0, faithful(farseer_core::BroadPhaseCollider::BruteForce, Default::default()));
    let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    add_box(&mut simulator, (10.0, 10.0), v(9.0, 0.0));
    simulator.set_iterations(9);
    simulator.set_bias_factor(0.3).unwrap();
    simulator.update(0.01);
    simulator.clear();
    assert!(simulator.body(body).is_none() && simulator.geom(geom).is_none());
    assert!(simulator.body_list().is_empty() && simulator.geom_list().is_empty());
    assert_eq!(simulator.arbiter_count(), 0);
    assert_eq!(simulator.broad_phase_collider(), farseer_core::BroadPhaseCollider::SelectiveSweep);
    assert_eq!((simulator.iterations(), simulator.bias_factor(), simulator.gravity()), (9, 0.3, v(0.0, 7.0)));
}
