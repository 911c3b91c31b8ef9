//! Filter of ghost contacts of balls at seams between flush surfaces.
//!
//! Where two surfaces are flush, the edge of the next one is nearer to the ball than its face, and its normal
//! is inclined against the motion: the ball would bump into a seam. Such a contact exerts no impulse as long
//! as the surface below the ball supports it.

use farseer_core::GeomId;
use farseer_precise::storage::order::sort_by_number_in;

use crate::Vector3;
use crate::depth::{Contact, ContactList, ContactTarget, PersistedFeature};
use crate::stages::depth_intervals::DepthIntervals;

/// Greatest distance of the contact point from the tangent plane of the supporting contact, as a factor of the slop,
/// dimensionless.
const COPLANAR_SLOP_FACTOR: f32 = 2.0;
/// Least cosine of the angle between the normals of the edge contact and the supporting contact, dimensionless.
const MIN_SEAM_COS: f32 = 0.5;

/// Contact of a ball with another shape.
#[derive(Debug, Clone, Copy)]
pub(in crate::stages) struct BallContact {
    ball: GeomId,
    /// Index of the contact in the list.
    touch: u32,
    /// Unit normal towards the ball.
    normal: Vector3,
    point: Vector3,
    /// Separation in px; negative is penetration.
    separation: f32,
}

/// Disables the impulses of ball contacts with edges in a surface that supports the ball. The caller has removed contacts that
/// a handler refused from the list before. `contacts` is a buffer.
pub(in crate::stages) fn filter_ghost_contacts(
    found: &mut ContactList,
    intervals: &DepthIntervals,
    slop: f32,
    contacts: &mut Vec<BallContact>,
) {
    contacts.clear();
    for (touch, index) in found.touches.iter().zip(0..) {
        contacts.extend(ball_contact(found, intervals, touch, index));
    }
    sort_by_number_in(&mut found.places, contacts, |contact| contact.ball.slot() as u128);
    for of_ball in contacts.chunk_by(|a, b| a.ball == b.ball) {
        for edge in of_ball {
            if of_ball.iter().any(|surface| is_ghost_contact(edge, surface, slop)) {
                found.touches[edge.touch as usize].responds = false;
            }
        }
    }
}

fn ball_contact(
    found: &ContactList,
    intervals: &DepthIntervals,
    touch: &Contact,
    index: u32,
) -> Option<BallContact> {
    if touch.kept != PersistedFeature::Nothing || !touch.responds {
        return None;
    }
    let is_round = |geom: GeomId| intervals.of(geom).is_round;
    let (ball, sign) = match (is_round(touch.this), touch.partner) {
        (true, ContactTarget::Geom(other)) if is_round(other) => return None,
        (true, _) => (touch.this, 1.0),
        (false, ContactTarget::Geom(other)) if is_round(other) => (other, -1.0),
        _ => return None,
    };
    let point = found.points_of(touch).first()?;
    let (position, separation) = (point.position, point.separation);
    Some(BallContact { ball, touch: index, normal: touch.normal * sign, point: position, separation })
}

/// Returns whether a contact is with an edge in the surface of another contact, which is deeper.
fn is_ghost_contact(edge: &BallContact, surface: &BallContact, slop: f32) -> bool {
    // Of two equally deep contacts only one is disabled.
    let is_deeper = (surface.separation, surface.touch) < (edge.separation, edge.touch);
    // The contact point lies on the ball, inside the other shape; the surface is at the separation from it.
    let on_surface = |contact: &BallContact| contact.point - contact.normal * contact.separation;
    let height = (on_surface(edge) - on_surface(surface)).dot(&surface.normal);
    is_deeper
        && edge.touch != surface.touch
        && height.abs() <= COPLANAR_SLOP_FACTOR * slop
        && edge.normal.dot(&surface.normal) >= MIN_SEAM_COS
}
