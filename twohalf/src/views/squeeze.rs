//! Who is squeezed between two sides, and by how much.

use farseer_core::{BodyId, PhysicsSimulator, SpaceTouch};

use super::touching::{is_touching, partner_of};
use crate::Vector3;
use crate::depth::{DepthScheme, Partner, World};
use crate::projection::to_world;

/// What pushes along an axis by at least this part of its normal is on one of its sides: up to 45 degrees.
const FACES: f32 = std::f32::consts::FRAC_1_SQRT_2;

/// A body between two sides that leave it less room than it needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Squeeze {
    /// The axis of the world, Y up, along which it is squeezed: the direction in which the first partner pushes it.
    pub axis: Vector3,
    /// How much it lacks to have room between them, px: how deep it is in the one and in the other, together.
    pub depth: f32,
    /// What is on either side.
    pub between: [Partner; 2],
}

/// How a body is squeezed.
pub(crate) fn squeeze(core: &PhysicsSimulator, world: &World, body: BodyId) -> Option<Squeeze> {
    if world.scheme != DepthScheme::Precise {
        return None;
    }
    let mut sides: [Option<(f32, Partner)>; 6] = [None; 6];
    for touch in core.space_touches_of(body).filter(|touch| touch.responds && is_touching(touch)) {
        let (partner, normal) = as_seen_by(body, &touch);
        let depth = touch.points[..touch.count].iter().fold(f32::MIN, |it, point| it.max(-point.separation));
        for axis in 0..3 {
            if normal[axis].abs() >= FACES {
                let side = &mut sides[2 * axis + usize::from(normal[axis] < 0.0)];
                // In whatever order they come.
                let stays = |(deepest, known): &(f32, Partner)| (*deepest, partner) >= (depth, *known);
                *side = side.filter(stays).or(Some((depth, partner)));
            }
        }
    }
    let along = |axis: usize| {
        let ((from, one), (to, other)) = (sides[2 * axis]?, sides[2 * axis + 1]?);
        let mut direction = Vector3::zeros();
        direction[axis] = 1.0;
        Some(Squeeze { axis: direction, depth: from + to, between: [one, other] })
    };
    (0..3).filter_map(along).reduce(|most, next| if next.depth > most.depth { next } else { most })
}

/// Who pushes a body in a touch, and in which direction of the world.
fn as_seen_by(body: BodyId, touch: &SpaceTouch) -> (Partner, Vector3) {
    let normal = to_world(Vector3::from(touch.normal));
    if touch.body == body {
        (partner_of(touch.partner), normal)
    } else {
        (Partner::Geom(touch.this), -normal)
    }
}
