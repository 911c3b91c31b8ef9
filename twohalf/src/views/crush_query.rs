//! Crush query: penetration of a body between two opposite sides.

use farseer_core::depth::{DepthAxis, DepthContact};
use farseer_core::{BodyId, PhysicsSimulator};

use super::contact_query::{is_touching, partner_of};
use crate::Vector3;
use crate::depth::{ContactTarget, DepthScheme, World};
use crate::projection::to_world;

/// Least component along the crush axis of the normal of a contact that counts as a side, dimensionless: up to 45 degrees.
const MIN_SIDE_NORMAL: f32 = std::f32::consts::FRAC_1_SQRT_2;

/// A body between two sides that leave it too little room.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrushInfo {
    /// Axis of the crush in the world, Y up: unit normal of the first side, towards the body.
    pub axis: Vector3,
    /// Lack of room along the axis, px: the sum of the penetrations of both sides.
    pub depth: f32,
    /// Contact targets of the two sides.
    pub between: [ContactTarget; 2],
}

/// Returns the crush of a body on the axis with the greatest lack of room; `None` without two opposite sides.
pub(crate) fn crush_info(core: &PhysicsSimulator, world: &World, body: BodyId) -> Option<CrushInfo> {
    if world.scheme != DepthScheme::Precise {
        return None;
    }
    let mut sides: [Option<(f32, ContactTarget)>; 6] = [None; 6];
    for touch in DepthAxis::of(core).contacts_of(body).filter(|touch| touch.responds && is_touching(touch)) {
        let (partner, normal) = seen_from(body, &touch);
        let depth = touch.points[..touch.count].iter().fold(f32::MIN, |it, point| it.max(-point.separation));
        for axis in 0..3 {
            if normal[axis].abs() >= MIN_SIDE_NORMAL {
                let side = &mut sides[2 * axis + usize::from(normal[axis] < 0.0)];
                // The result does not depend on the order of contacts.
                let stays = |(deepest, known): &(f32, ContactTarget)| (*deepest, partner) >= (depth, *known);
                *side = side.filter(stays).or(Some((depth, partner)));
            }
        }
    }
    let along = |axis: usize| {
        let ((from, one), (to, other)) = (sides[2 * axis]?, sides[2 * axis + 1]?);
        let mut direction = Vector3::zeros();
        direction[axis] = 1.0;
        Some(CrushInfo { axis: direction, depth: from + to, between: [one, other] })
    };
    (0..3).filter_map(along).reduce(|most, next| if next.depth > most.depth { next } else { most })
}

/// Returns the contact target as seen by a body, and the unit normal towards the body in the world, Y up.
fn seen_from(body: BodyId, touch: &DepthContact) -> (ContactTarget, Vector3) {
    let normal = to_world(Vector3::from(touch.normal));
    if touch.body == body {
        (partner_of(touch.target), normal)
    } else {
        (ContactTarget::Geom(touch.this), -normal)
    }
}
