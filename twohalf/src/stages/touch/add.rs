//! A contact becomes one of the list.

use farseer_core::{BodyId, GeomId};

use super::{Manifold, Surfaces};
use crate::depth::{Partner, Touch, TouchKey, TouchList, TouchPoint};

/// Who touches: what a contact is about.
#[derive(Debug, Clone, Copy)]
pub(super) struct Subject {
    pub(super) key: TouchKey,
    pub(super) this: GeomId,
    pub(super) body: BodyId,
    pub(super) partner: Partner,
    pub(super) partner_body: Option<BodyId>,
    pub(super) responds: bool,
}

/// Appends a contact with the impulses that its points had in the last update. One that is not finite is none.
pub(super) fn add(
    list: &mut TouchList,
    subject: Subject,
    manifold: &Manifold,
    surfaces: Surfaces,
    last: &TouchList,
) {
    if !manifold.is_finite() {
        return;
    }
    let is_alike = |touch: &&Touch| {
        std::mem::discriminant(&touch.kept) == std::mem::discriminant(&manifold.kept)
            || !(touch.is_plane() || touch.shares_pressure || manifold.shares_pressure)
    };
    let known = last.find(subject.key).filter(is_alike).map_or(&[][..], |touch| last.points_of(touch));
    let first_point = list.points.len() as u32;
    for spot in manifold.spots() {
        let before = known.iter().find(|point| point.feature == spot.feature);
        list.points.push(TouchPoint {
            position: spot.position,
            normal: manifold.normal,
            separation: spot.separation,
            feature: spot.feature,
            normal_impulse: before.map_or(0.0, |point| point.normal_impulse),
            friction_impulse: before.map_or([0.0; 2], |point| point.friction_impulse),
        });
    }
    let Subject { key, this, body, partner, partner_body, responds } = subject;
    list.touches.push(Touch {
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
