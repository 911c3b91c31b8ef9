//! Edges that a figure in the air takes hold of, hangs on, and climbs over.

use farseer_core::math::scalar::nearest_finite;
use serde::{Deserialize, Serialize};

use super::floor::{Floor, Reach, holds};
use super::stride::{OVER, PASSED, STANDS, Stride};
use super::walls::wall_of;
use super::{Walker, Wish};
use crate::{Partner, TwoHalfPhysicsSimulator, Vector3};

/// How far it reaches for an edge beyond its own outline, px.
pub(super) const GRASP: f32 = 4.0;
/// How far its feet are over the edge when it stands there, px: there must be room for it.
const OVER_EDGE: f32 = 8.0;
/// How far over the edge the soles are lifted, px: the wall that it hung on is looked at anew by then, and no wall any more.
const LIFTED: f32 = PASSED + OVER;
/// What is no higher over the edge than this leaves room, px.
const LEAST_ROOM: f32 = 1.0;
/// Who is thrown away from the edge faster than this lets go, px/s.
const TORN_OFF: f32 = 60.0;

/// What a figure holds on to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Ledge {
    partner: Partner,
    /// Unit vector along X or Z towards the edge.
    towards: Vector3,
}

impl Ledge {
    /// What was loaded may hold anything.
    pub(super) fn is_valid(&self) -> bool {
        let axes = [Vector3::x(), Vector3::z()];
        axes.iter().any(|axis| self.towards == *axis || self.towards == -axis)
    }

    pub(super) fn partner(&self) -> Partner {
        self.partner
    }
}

impl TwoHalfPhysicsSimulator {
    /// The velocity of a figure that hangs on an edge, or takes hold of one; nothing if it does neither.
    pub(super) fn hanging(
        &mut self,
        stride: &Stride<'_>,
        walker: &mut Walker,
        wish: Wish,
    ) -> Option<Vector3> {
        let stride = &stride.flat();
        let held = walker.ledge.take().filter(|ledge| !lets_go(ledge, stride, walker, wish));
        let held = held.filter(|ledge| !stride.refuses(ledge.partner));
        let ledge = held.or_else(|| self.ledge_to_take(stride, walker, wish))?;
        let height = self.height_of_ledge(stride, &ledge)?;
        stride.note_held_by(ledge.partner, Vector3::y(), height);
        let place = Vector3::new(stride.place.x, height, stride.place.z);
        walker.carried = (self.velocity_of(ledge.partner, place) / stride.pace).map(nearest_finite);
        if wish.jump {
            return Some(self.jumping(stride, walker, wish));
        }
        walker.ledge = Some(ledge);
        self.hold(stride.body, walker, true);
        let speed = if along(&ledge, wish) > 0.0 { walker.walk.climb_speed } else { 0.0 };
        let up = speed.min((height + LIFTED - stride.soles) / stride.dt);
        let climbing = walker.carried + ledge.towards * speed + Vector3::new(0.0, up, 0.0);
        // The wall is in the way until the soles are over the edge.
        Some(self.held_off(stride, climbing, |_| true))
    }

    /// Whose feet have come over the edge stands there.
    pub(super) fn arrive(&self, stride: &Stride<'_>, walker: &mut Walker) {
        let Some(ledge) = walker.ledge else { return };
        let stride = stride.flat();
        let here = self.height_of(ledge.partner, &stride.feet, &stride.reach(f32::MAX));
        if here.is_some_and(|here| here <= stride.soles + STANDS) {
            (walker.floor, walker.ledge) = (Some(ledge.partner), None);
        }
    }

    /// The edge in reach towards which it wishes, if it falls and there is room to stand on it.
    fn ledge_to_take(&self, stride: &Stride<'_>, walker: &Walker, wish: Wish) -> Option<Ledge> {
        if walker.walk.ledge_reach <= 0.0 || stride.velocity.y > walker.carried.y.max(0.0) {
            return None;
        }
        let (x, z) = (Vector3::x() * wish.x, Vector3::z() * wish.z);
        let ways = if wish.x.abs() >= wish.z.abs() { [x, z] } else { [z, x] };
        ways.into_iter().filter(|way| *way != Vector3::zeros()).find_map(|way| {
            let towards = way.map(|part| if part == 0.0 { 0.0 } else { part.signum() });
            // Also one that a handler has refused: it is asked again, and none lower is taken.
            let reach = Reach { refused: &[], ..stride.reach(walker.walk.ledge_reach) };
            let floor = self.floor_below(&stride.feet.moved(towards * GRASP), &reach)?;
            let ledge = Ledge { partner: floor.partner, towards };
            let is_edge = floor.height > stride.knees && self.is_beside(stride, &floor);
            let is_fixed = self.is_fixed(Some(floor.partner)) && floor.partner != Partner::Ground;
            let is_to_hold = is_edge && is_fixed && self.has_room(stride, towards, floor.height);
            if is_to_hold {
                stride.note_held_by(floor.partner, Vector3::y(), floor.height);
            }
            (is_to_hold && !stride.refuses(floor.partner)).then_some(ledge)
        })
    }

    /// Whether a floor is not over the figure already.
    fn is_beside(&self, stride: &Stride<'_>, floor: &Floor) -> bool {
        let here = self.height_of(floor.partner, &stride.feet, &stride.reach(f32::MAX));
        here.is_none_or(|here| here <= stride.knees)
    }

    fn height_of_ledge(&self, stride: &Stride<'_>, ledge: &Ledge) -> Option<f32> {
        let feet = stride.feet.moved(ledge.towards * GRASP);
        let height = self.height_of(ledge.partner, &feet, &stride.reach(f32::MAX))?;
        (height > stride.soles - LIFTED - STANDS).then_some(height)
    }

    /// Whether nothing fixed is where the figure climbs to.
    fn has_room(&self, stride: &Stride<'_>, towards: Vector3, height: f32) -> bool {
        let feet = stride.feet.swept(towards * (GRASP + OVER_EDGE));
        let (knees, head) = (height + LEAST_ROOM, height + stride.head - stride.soles);
        let there = stride.between(knees, head);
        let low = Vector3::new(feet.left, -head, feet.front);
        let high = Vector3::new(feet.right, -knees, feet.back);
        let is_free = self.world.platforms.overlapping(low, high).all(|(id, platform)| {
            platform.is_one_way()
                || stride.refuses(Partner::Platform(id))
                || !holds(platform, self.core.geom(stride.geom).as_deref())
                || !wall_of(platform.shape(), &there).is_some_and(|wall| feet.meets_box(&wall))
        });
        is_free && {
            let (low, high) =
                (Vector3::new(feet.left, knees, feet.front), Vector3::new(feet.right, head, feet.back));
            let is_solid = |geom| {
                let partner = Partner::Geom(geom);
                geom != stride.geom && self.is_fixed(Some(partner)) && !stride.refuses(partner)
            };
            self.query_box(low, high, is_solid).is_empty()
        }
    }
}

/// How fast it wishes to come over the edge.
fn along(ledge: &Ledge, wish: Wish) -> f32 {
    ledge.towards.x * wish.x + ledge.towards.z * wish.z
}

/// Whether it wishes to get away, or was thrown off.
fn lets_go(ledge: &Ledge, stride: &Stride<'_>, walker: &Walker, wish: Wish) -> bool {
    let away = (walker.carried - stride.velocity).dot(&ledge.towards);
    (along(ledge, wish) < 0.0 && !wish.jump) || away > TORN_OFF || stride.velocity.y > walker.told + TORN_OFF
}
