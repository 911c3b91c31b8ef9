//! Adds a manifold to the contact list, with warm starting.

use farseer_core::{BodyId, GeomId};

use super::{Manifold, SurfacePair};
use crate::depth::{Contact, ContactKey, ContactList, ContactPoint, ContactTarget};

/// Key and both sides of a contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactPair {
    pub(super) key: ContactKey,
    pub(super) this: GeomId,
    pub(super) body: BodyId,
    pub(super) partner: ContactTarget,
    pub(super) partner_body: Option<BodyId>,
    pub(super) responds: bool,
}

/// Appends a contact and warm starts its points with the impulses of the same features in the last update. A
/// manifold that is not finite is dropped.
pub(super) fn add(
    list: &mut ContactList,
    subject: ContactPair,
    manifold: &Manifold,
    surfaces: SurfacePair,
    last: &ContactList,
) {
    if !manifold.is_finite() {
        return;
    }
    let is_alike = |touch: &&Contact| {
        std::mem::discriminant(&touch.kept) == std::mem::discriminant(&manifold.kept)
            || !(touch.is_plane() || touch.shares_pressure || manifold.shares_pressure)
    };
    let pair_cache = last.find(subject.key).filter(is_alike).map_or(&[][..], |touch| last.points_of(touch));
    let first_point = list.points.len() as u32;
    for spot in manifold.manifold_points() {
        let before = pair_cache.iter().find(|point| point.feature == spot.feature);
        list.points.push(ContactPoint {
            position: spot.position,
            normal: manifold.normal,
            separation: spot.separation,
            feature: spot.feature,
            normal_impulse: before.map_or(0.0, |point| point.normal_impulse),
            friction_impulse: before.map_or([0.0; 2], |point| point.friction_impulse),
        });
    }
    let ContactPair { key, this, body, partner, partner_body, responds } = subject;
    list.touches.push(Contact {
        key,
        this,
        body,
        partner,
        partner_body,
        normal: manifold.normal,
        kept: manifold.kept,
        first_point,
        point_count: manifold.count as u32,
        friction: surfaces.friction,
        restitution: surfaces.restitution,
        responds,
        shares_pressure: manifold.shares_pressure,
        arbiter: 0,
    });
}
