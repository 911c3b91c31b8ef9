//! Ledges: edges that a falling character grabs, hangs on, and climbs over.

use farseer_core::math::scalar::nearest_finite;
use serde::{Deserialize, Serialize};

use super::character_step::{EDGE_CLEARANCE, EDGE_PASS_DISTANCE, STAND_DISTANCE, StepContext};
use super::ground_probe::{GroundHit, ProbeLimits, holds};
use super::wall_avoidance::wall_of;
use super::{CharacterController, MoveInput};
use crate::{ContactTarget, TwoHalfPhysicsSimulator, Vector3};

/// Greatest distance beyond the character's footprint at which it grabs a ledge, px.
pub(super) const GRAB_DISTANCE: f32 = 4.0;
/// Depth of the footprint over the ledge that must be free to stand on, px.
const STANDING_DEPTH: f32 = 8.0;
/// Height of the soles above the ledge at the end of the climb, px. At this height the narrow phase has refreshed the contact
/// with the wall.
const CLIMB_CLEARANCE: f32 = EDGE_PASS_DISTANCE + EDGE_CLEARANCE;
/// Height above the ledge up to which an obstacle leaves room to stand, px.
const ROOM_TOLERANCE: f32 = 1.0;
/// Speed relative to the ledge at which a thrown character loses its hold, px/s.
const BREAKAWAY_SPEED: f32 = 60.0;

/// A ledge that a character hangs on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Ledge {
    partner: ContactTarget,
    /// Unit vector along X or Z towards the ledge.
    towards: Vector3,
}

impl Ledge {
    /// Returns whether the direction is one of the four axes: false only for a damaged save.
    pub(super) fn is_valid(&self) -> bool {
        let axes = [Vector3::x(), Vector3::z()];
        axes.iter().any(|axis| self.towards == *axis || self.towards == -axis)
    }

    pub(super) fn partner(&self) -> ContactTarget {
        self.partner
    }
}

impl TwoHalfPhysicsSimulator {
    /// Returns the velocity of a character that hangs on a ledge or grabs one in this step, px/s, Y up; `None` if the character
    /// does neither.
    pub(super) fn ledge_hang(
        &mut self,
        step: &StepContext<'_>,
        walker: &mut CharacterController,
        wish: MoveInput,
    ) -> Option<Vector3> {
        let step = &step.flat();
        let held = walker.ledge.take().filter(|ledge| !is_released(ledge, step, walker, wish));
        let held = held.filter(|ledge| !step.refuses(ledge.partner));
        let ledge = held.or_else(|| self.find_ledge(step, walker, wish))?;
        let height = self.height_of_ledge(step, &ledge)?;
        step.record_support(ledge.partner, Vector3::y(), height);
        let place = Vector3::new(step.place.x, height, step.place.z);
        walker.carried = (self.velocity_of(ledge.partner, place) / step.pace).map(nearest_finite);
        if wish.jump {
            return Some(self.jump_velocity(step, walker, wish));
        }
        walker.ledge = Some(ledge);
        self.suspend_gravity(step.body, walker, true);
        let speed = if along(&ledge, wish) > 0.0 { walker.walk.climb_speed } else { 0.0 };
        let up = speed.min((height + CLIMB_CLEARANCE - step.soles) / step.dt);
        let climbing = walker.carried + ledge.towards * speed + Vector3::new(0.0, up, 0.0);
        // The wall blocks the character until its soles are above the edge.
        Some(self.stop_at_walls(step, climbing, |_| true))
    }

    /// Ends the climb: a character whose footprint is above the ledge stands on it.
    pub(super) fn ledge_climb_end(&self, step: &StepContext<'_>, walker: &mut CharacterController) {
        let Some(ledge) = walker.ledge else { return };
        let step = step.flat();
        let here = self.height_of(ledge.partner, &step.footprint, &step.reach(f32::MAX));
        if here.is_some_and(|here| here <= step.soles + STAND_DISTANCE) {
            (walker.floor, walker.ledge) = (Some(ledge.partner), None);
        }
    }

    /// Returns the ledge in reach along the input; `None` if there is none, the character does not fall, or the ledge has no
    /// room to stand.
    fn find_ledge(
        &self,
        step: &StepContext<'_>,
        walker: &CharacterController,
        wish: MoveInput,
    ) -> Option<Ledge> {
        if walker.walk.ledge_reach <= 0.0 || step.velocity.y > walker.carried.y.max(0.0) {
            return None;
        }
        let (x, z) = (Vector3::x() * wish.x, Vector3::z() * wish.z);
        let ways = if wish.x.abs() >= wish.z.abs() { [x, z] } else { [z, x] };
        ways.into_iter().filter(|way| *way != Vector3::zeros()).find_map(|way| {
            let towards = way.map(|part| if part == 0.0 { 0.0 } else { part.signum() });
            // A ledge that the handler has refused is included: the handler is asked again, and no lower
            // ledge is grabbed.
            let reach = ProbeLimits { refused: &[], ..step.reach(walker.walk.ledge_reach) };
            let floor = self.probe_ground(&step.footprint.moved(towards * GRAB_DISTANCE), &reach)?;
            let ledge = Ledge { partner: floor.partner, towards };
            let is_edge = floor.height > step.knees && self.is_beside(step, &floor);
            let is_fixed = self.is_fixed(Some(floor.partner)) && floor.partner != ContactTarget::Ground;
            let is_to_hold = is_edge && is_fixed && self.has_room(step, towards, floor.height);
            if is_to_hold {
                step.record_support(floor.partner, Vector3::y(), floor.height);
            }
            (is_to_hold && !step.refuses(floor.partner)).then_some(ledge)
        })
    }

    /// Returns whether a floor is at most step height above the soles at the present place of the footprint, so that its ledge
    /// lies beside the character.
    fn is_beside(&self, step: &StepContext<'_>, floor: &GroundHit) -> bool {
        let here = self.height_of(floor.partner, &step.footprint, &step.reach(f32::MAX));
        here.is_none_or(|here| here <= step.knees)
    }

    fn height_of_ledge(&self, step: &StepContext<'_>, ledge: &Ledge) -> Option<f32> {
        let footprint = step.footprint.moved(ledge.towards * GRAB_DISTANCE);
        let height = self.height_of(ledge.partner, &footprint, &step.reach(f32::MAX))?;
        (height > step.soles - CLIMB_CLEARANCE - STAND_DISTANCE).then_some(height)
    }

    /// Returns whether no fixed obstacle is at the place where the climb ends.
    fn has_room(&self, step: &StepContext<'_>, towards: Vector3, height: f32) -> bool {
        let footprint = step.footprint.swept(towards * (GRAB_DISTANCE + STANDING_DEPTH));
        let (knees, head) = (height + ROOM_TOLERANCE, height + step.head - step.soles);
        let there = step.between(knees, head);
        let low = Vector3::new(footprint.left, -head, footprint.front);
        let high = Vector3::new(footprint.right, -knees, footprint.back);
        let is_free = self.world.platforms.overlapping(low, high).all(|(id, platform)| {
            platform.is_one_way()
                || step.refuses(ContactTarget::Platform(id))
                || !holds(platform, self.core.geom(step.geom).as_deref())
                || !wall_of(platform.shape(), &there).is_some_and(|wall| footprint.overlaps_box(&wall))
        });
        is_free && {
            let (low, high) = (
                Vector3::new(footprint.left, knees, footprint.front),
                Vector3::new(footprint.right, head, footprint.back),
            );
            let is_solid = |geom| {
                let partner = ContactTarget::Geom(geom);
                geom != step.geom && self.is_fixed(Some(partner)) && !step.refuses(partner)
            };
            self.query_box(low, high, is_solid).is_empty()
        }
    }
}

/// Returns the component towards the ledge of the speed that the input asks for, px/s.
fn along(ledge: &Ledge, wish: MoveInput) -> f32 {
    ledge.towards.x * wish.x + ledge.towards.z * wish.z
}

/// Returns whether the input points away from the ledge or the character was thrown off.
fn is_released(ledge: &Ledge, step: &StepContext<'_>, walker: &CharacterController, wish: MoveInput) -> bool {
    let away = (walker.carried - step.velocity).dot(&ledge.towards);
    (along(ledge, wish) < 0.0 && !wish.jump)
        || away > BREAKAWAY_SPEED
        || step.velocity.y > walker.told + BREAKAWAY_SPEED
}
