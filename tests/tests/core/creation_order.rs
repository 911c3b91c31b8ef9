//! Slots are used again, creation numbers never: pairs, contact ids and callbacks follow the numbers.

use conformance::fixtures::plane::{self, add_box, methods, pairs, simulator_with, v};
use farseer_core::{BodyId, Contact, Context, EventHandler, GeomId, Methods, PhysicsSimulator};

/// Three boxes far from each other, of which the first is disposed, and a new one that takes its slot next to the last. Returns
/// the third and the new one.
fn reused_slot(methods: Methods) -> (PhysicsSimulator, (BodyId, GeomId), (BodyId, GeomId)) {
    let mut simulator = simulator_with(0.0, methods);
    let (first, first_geom) = add_box(&mut simulator, (10.0, 10.0), v(-500.0, 0.0));
    add_box(&mut simulator, (10.0, 10.0), v(500.0, 0.0));
    let third = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    simulator.update(0.01);
    simulator.dispose(first).unwrap();
    simulator.update(0.01);
    let new = add_box(&mut simulator, (10.0, 10.0), v(8.0, 1.0));
    assert_eq!(new.1.slot(), first_geom.slot(), "the slot is not used again");
    assert!(new.1.slot() < third.1.slot());
    (simulator, third, new)
}

#[derive(Default)]
struct Told {
    collisions: Vec<(GeomId, GeomId)>,
    separations: Vec<(GeomId, GeomId)>,
}

impl EventHandler for Told {
    fn on_collision(
        &mut self,
        _: &mut Context<'_>,
        this: GeomId,
        other: GeomId,
        _: &mut Vec<Contact>,
    ) -> bool {
        self.collisions.push((this, other));
        true
    }
    fn on_separation(&mut self, _: &mut Context<'_>, this: GeomId, other: GeomId) {
        self.separations.push((this, other));
    }
}

#[test]
fn the_older_geom_is_a_even_if_the_younger_one_has_the_lower_slot() {
    for methods in methods() {
        let (mut simulator, (_, older), (_, younger)) = reused_slot(methods);
        simulator.update(0.01);
        let arbiter = simulator.arbiters().next().unwrap();
        assert_eq!((arbiter.geom_a(), arbiter.geom_b()), (older, younger), "{methods:?}");
        assert_eq!(pairs(&simulator), [(2, 3)]);
    }
}

#[test]
fn contact_ids_hold_creation_numbers() {
    for methods in methods() {
        let (mut simulator, ..) = reused_slot(methods);
        simulator.update(0.01);
        let arbiter = simulator.arbiters().next().unwrap();
        assert!(arbiter.contacts().len() > 0);
        for contact in arbiter.contacts() {
            let numbers = (contact.id.geom1, contact.id.geom2);
            assert!(numbers == (2, 3) || numbers == (3, 2), "{methods:?}: {numbers:?}");
        }
    }
}

#[test]
fn the_older_geom_gets_the_first_callback() {
    for methods in methods() {
        let (mut simulator, (_, older), (body, younger)) = reused_slot(methods);
        let mut told = Told::default();
        simulator.update_with(0.01, &mut told);
        assert_eq!(told.collisions, [(older, younger), (younger, older)], "{methods:?}");
        simulator[body].set_position(v(9.0, 9.0));
        simulator[body].set_rotation(0.7);
        simulator[body].set_position(v(200.0, 0.0));
        simulator.update_with(0.01, &mut told);
        assert_eq!(told.separations, [(older, younger), (younger, older)], "{methods:?}");
    }
}

#[test]
fn the_order_of_addition_does_not_decide_which_geom_is_a() {
    for methods in methods() {
        let mut simulator = simulator_with(0.0, methods);
        let (_, older) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        simulator.update(0.01);
        simulator.remove(older).unwrap();
        let (_, younger) = add_box(&mut simulator, (10.0, 10.0), v(8.0, 1.0));
        simulator.update(0.01);
        simulator.add(older).unwrap();
        simulator.update(0.01);
        assert_eq!(simulator.geom_list(), [younger, older]);
        assert_eq!(pairs(&simulator), [(0, 1)], "{methods:?}");
    }
}

#[test]
fn a_scene_in_used_slots_gives_the_bits_of_a_fresh_one() {
    for methods in methods() {
        let mut fresh = simulator_with(100.0, methods);
        let mut used = simulator_with(100.0, methods);
        let litter: Vec<BodyId> =
            (0..6).map(|i| add_box(&mut used, (10.0, 10.0), v(i as f32 * 1000.0, -9000.0)).0).collect();
        used.update(0.01);
        // Freed in another order than made, so that the slots come back mixed up.
        for index in [3, 0, 5, 1, 4, 2] {
            used.dispose(litter[index]).unwrap();
            used.update(0.01);
        }
        let fill = |simulator: &mut PhysicsSimulator| -> Vec<BodyId> {
            plane::add_floor(simulator, (200.0, 20.0), v(0.0, 100.0));
            (0..5)
                .map(|i| add_box(simulator, (20.0, 20.0), v(4.0 * i as f32, 80.0 - 21.0 * i as f32)).0)
                .collect()
        };
        let (fresh_bodies, used_bodies) = (fill(&mut fresh), fill(&mut used));
        assert_ne!(fresh_bodies, used_bodies);
        for step in 0..100 {
            fresh.update(0.01);
            used.update(0.01);
            for (&a, &b) in fresh_bodies.iter().zip(&used_bodies) {
                let bits = (plane::body_bits(&fresh[a]), plane::body_bits(&used[b]));
                assert_eq!(bits.0, bits.1, "{methods:?} step {step}");
            }
        }
    }
}

#[test]
fn ignoring_a_geom_does_not_ignore_the_next_one_in_its_slot() {
    for methods in methods() {
        let mut simulator = simulator_with(0.0, methods);
        let (_, stays) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        let (goes, ignored) = add_box(&mut simulator, (10.0, 10.0), v(8.0, 1.0));
        simulator.ignore_collision_with(stays, ignored).unwrap();
        simulator.update(0.01);
        assert_eq!(simulator.arbiter_count(), 0);
        simulator.dispose(goes).unwrap();
        simulator.update(0.01);
        let (_, next) = add_box(&mut simulator, (10.0, 10.0), v(8.0, 1.0));
        assert_eq!(next.slot(), ignored.slot());
        simulator.update(0.01);
        assert_eq!(pairs(&simulator), [(0, 2)], "{methods:?}");
    }
}
