//! Contacts in X and Y whose sides slide past each other along Z: the core finds these contacts and `twohalf` solves them,
//! because friction acts along Z as well.

use farseer_core::{Contact, PhysicsSimulator};

use super::add_contact::ContactPair;
use crate::Vector3;
use crate::depth::{
    self, ContactKey, ContactList, ContactPoint, ContactTarget, DepthState, PersistedFeature,
};

/// Feature id of a contact of the core.
fn feature_of(contact: &Contact, older: u32) -> u32 {
    (contact.id.vertex as u32).wrapping_mul(2) + u32::from(contact.id.geom1 == older)
}

/// Moves contacts of the core that slide along Z, or had friction along Z in the last update, to the contact list of `twohalf`.
pub(in crate::stages) fn adopt_core_contacts(
    core: &mut PhysicsSimulator,
    depths: &DepthState,
    found: &mut ContactList,
    last: &ContactList,
) {
    for position in 0..core.arbiter_count() {
        if let Some(subject) = sliding_pair(core, depths, last, position) {
            adopt_core_contact(core, depths, found, last, (position, subject));
        }
    }
    found.sort();
}

fn sliding_pair(
    core: &PhysicsSimulator,
    depths: &DepthState,
    last: &ContactList,
    position: usize,
) -> Option<ContactPair> {
    let arbiter = core.arbiter(position)?;
    let (a, b) = (core.geom(arbiter.geom_a())?, core.geom(arbiter.geom_b())?);
    let velocity = |body| depths.bodies.get(body).map_or(0.0, |state| state.velocity_z);
    let key = ContactKey::Pair(a.id(), b.id());
    let slides = velocity(a.body()) != velocity(b.body());
    let rubbed = || {
        let pair_cache = last.find(key).filter(|touch| touch.is_plane());
        pair_cache
            .is_some_and(|touch| last.points_of(touch).iter().any(|point| point.friction_impulse[1] != 0.0))
    };
    if !(a.collision_response_enabled() && b.collision_response_enabled()) || !(slides || rubbed()) {
        return None;
    }
    Some(ContactPair {
        key,
        this: arbiter.geom_b(),
        body: b.body(),
        partner: ContactTarget::Geom(arbiter.geom_a()),
        partner_body: Some(a.body()),
        responds: true,
    })
}

fn adopt_core_contact(
    core: &mut PhysicsSimulator,
    depths: &DepthState,
    found: &mut ContactList,
    last: &ContactList,
    (position, subject): (usize, ContactPair),
) {
    let ContactPair { key, this, body, partner, partner_body, responds } = subject;
    let (ContactKey::Pair(older, _), ContactTarget::Geom(other)) = (key, partner) else { return };
    let Some(arbiter) = core.arbiter(position) else { return };
    let Some(restitution) = core.geom(this).zip(core.geom(other)).map(|(b, a)| {
        PhysicsSimulator::mix_restitution(a.restitution_coefficient(), b.restitution_coefficient())
    }) else {
        return;
    };
    let friction = arbiter.friction();
    if !friction.is_finite() || !restitution.is_finite() {
        return;
    }
    let z = depths.middle(core, this, other);
    let pair_cache = last.find(key).filter(|touch| touch.is_plane());
    let pair_cache = pair_cache.map_or(&[][..], |touch| last.points_of(touch));
    let first_point = found.points.len() as u32;
    for contact in arbiter.contacts() {
        let feature = feature_of(&contact, older);
        let before = pair_cache.iter().find(|point| point.feature == feature);
        found.points.push(ContactPoint {
            position: Vector3::new(contact.position.x, contact.position.y, z),
            normal: Vector3::new(contact.normal.x, contact.normal.y, 0.0),
            separation: contact.separation,
            feature,
            normal_impulse: contact.normal_impulse(),
            friction_impulse: [
                contact.tangent_impulse(),
                before.map_or(0.0, |point| point.friction_impulse[1]),
            ],
        });
    }
    let Some(first) = arbiter.contacts().next() else { return };
    found.touches.push(depth::Contact {
        key,
        this,
        body,
        partner,
        partner_body,
        normal: Vector3::new(first.normal.x, first.normal.y, 0.0),
        kept: PersistedFeature::Plane,
        first_point,
        point_count: arbiter.contacts().len() as u32,
        friction,
        restitution,
        responds,
        shares_pressure: false,
        arbiter: position as u32,
    });
    core.leave_to_engine(position);
}
