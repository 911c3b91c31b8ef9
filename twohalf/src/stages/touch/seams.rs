//! Balls that roll from one surface to the next.
//!
//! Where two surfaces are flush, the edge of the one ahead is nearer to the ball than its face, and leans against
//! it: the ball would stumble over a seam that is not there. Such a contact exerts no impulse as long as the
//! surface that the ball is on holds it.

use farseer_core::GeomId;
use farseer_core::order::sort_within;

use crate::Vector3;
use crate::depth::{Kept, Partner, Touch, TouchList};
use crate::stages::reach::Reaches;

/// In units of slop: how far from the tangent plane of another contact a point still lies in it.
const IN_PLANE: f32 = 2.0;
/// Least cosine of the angle between the normals.
const ALIKE: f32 = 0.5;

/// A ball on something that is no ball.
#[derive(Debug, Clone, Copy)]
pub(in crate::stages) struct BallContact {
    ball: GeomId,
    touch: u32,
    /// Towards the ball.
    normal: Vector3,
    point: Vector3,
    separation: f32,
}

/// Lets the contacts of balls with edges that lie in a surface the ball is on exert no impulses. Those that a
/// handler has refused are gone by now: they hold nothing. `contacts` is room.
pub(in crate::stages) fn smooth_seams(
    found: &mut TouchList,
    reaches: &Reaches,
    slop: f32,
    contacts: &mut Vec<BallContact>,
) {
    contacts.clear();
    for (touch, index) in found.touches.iter().zip(0..) {
        contacts.extend(ball_contact(found, reaches, touch, index));
    }
    sort_within(&mut found.places, contacts, |contact| contact.ball.slot() as u128);
    for of_ball in contacts.chunk_by(|a, b| a.ball == b.ball) {
        for edge in of_ball {
            if of_ball.iter().any(|surface| is_seam(edge, surface, slop)) {
                found.touches[edge.touch as usize].responds = false;
            }
        }
    }
}

fn ball_contact(found: &TouchList, reaches: &Reaches, touch: &Touch, index: u32) -> Option<BallContact> {
    if touch.kept != Kept::Nothing || !touch.responds {
        return None;
    }
    let is_round = |geom: GeomId| reaches.of(geom).is_round;
    let (ball, sign) = match (is_round(touch.this), touch.partner) {
        (true, Partner::Geom(other)) if is_round(other) => return None,
        (true, _) => (touch.this, 1.0),
        (false, Partner::Geom(other)) if is_round(other) => (other, -1.0),
        _ => return None,
    };
    let point = found.points_of(touch).first()?;
    let (position, separation) = (point.position, point.separation);
    Some(BallContact { ball, touch: index, normal: touch.normal * sign, point: position, separation })
}

/// Whether one contact is with an edge that lies in the surface of another one, which is deeper.
fn is_seam(edge: &BallContact, surface: &BallContact, slop: f32) -> bool {
    // Of two that are equally deep only one goes.
    let is_deeper = (surface.separation, surface.touch) < (edge.separation, edge.touch);
    // The point of a contact lies on the ball, inside of what it touches: the surface is behind it.
    let on_surface = |contact: &BallContact| contact.point - contact.normal * contact.separation;
    let height = (on_surface(edge) - on_surface(surface)).dot(&surface.normal);
    is_deeper
        && edge.touch != surface.touch
        && height.abs() <= IN_PLANE * slop
        && edge.normal.dot(&surface.normal) >= ALIKE
}
