//! Contacts that a handler removes, adds or changes.

use conformance::fixtures::plane::{both_sets, is_finite, not_finite, v};
use farseer_core::{Contact, Context};

use super::{AtCollision, stack};

#[test]
fn contacts_may_be_removed_inside_a_callback() {
    let mut simulator = stack(Default::default());
    let mut handler = AtCollision(Some(|_: &mut Context<'_>, _, _, contacts: &mut Vec<Contact>| {
        contacts.truncate(1);
        true
    }));
    simulator.update_with(0.01, &mut handler);
    assert_eq!(simulator.arbiters().next().unwrap().contacts().len(), 1);
}

#[test]
fn contacts_may_be_added_inside_a_callback() {
    let mut simulator = stack(Default::default());
    let mut handler = AtCollision(Some(|_: &mut Context<'_>, _, _, contacts: &mut Vec<Contact>| {
        let mut contact = contacts[0];
        for vertex in 0..50 {
            contact.id.vertex = 1000 + vertex;
            contacts.push(contact);
        }
        true
    }));
    simulator.update_with(0.01, &mut handler);
    assert!(simulator.arbiters().next().unwrap().contacts().len() > 50);
    assert!(is_finite(&simulator));
}

#[test]
fn contacts_made_infinite_inside_a_callback_are_dropped() {
    for methods in both_sets() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            for field in 0..3 {
                let mut simulator = stack(methods);
                let mut handler =
                    AtCollision(Some(|_: &mut Context<'_>, _, _, contacts: &mut Vec<Contact>| {
                        for contact in contacts {
                            match field {
                                0 => contact.position.x = bad,
                                1 => contact.normal.y = bad,
                                _ => contact.separation = bad,
                            }
                        }
                        true
                    }));
                simulator.update_with(0.01, &mut handler);
                assert!(is_finite(&simulator));
                assert_eq!(not_finite(&simulator), []);
                assert!(simulator.body_list().iter().all(|&body| simulator[body].enabled()));
            }
        }
    }
}

#[test]
fn contacts_with_huge_numbers_made_inside_a_callback_stay_harmless() {
    for methods in both_sets() {
        for size in [1e20, 1e30, 3e38] {
            let mut simulator = stack(methods);
            let mut handler = AtCollision(Some(|_: &mut Context<'_>, _, _, contacts: &mut Vec<Contact>| {
                for contact in contacts {
                    *contact = Contact::new(v(size, -size), v(size, size), -size, contact.id)
                        .with_impulses(size, size);
                }
                true
            }));
            simulator.update_with(0.01, &mut handler);
            for _ in 0..20 {
                simulator.update(0.01);
                assert!(is_finite(&simulator));
            }
        }
    }
}
