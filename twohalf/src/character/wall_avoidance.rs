//! Wall avoidance: limits the velocity of a character so that it stops at walls instead of pressing on them.
//!
//! Sides of level, untilted platforms are found by a shape cast before they are touched. Sheared, climbing
//! and turned boxes are found by the contacts of the narrow phase, which exist before the touch.

use farseer_core::depth::DepthContact;
use farseer_precise::depth::shape_distance::DepthQueryFootprint;

use super::character_footprint::{CharacterFootprint, FOOTPRINT_SKIN, RoundFoot};
use super::character_step::StepContext;
use super::ground_probe::{holds, partner_of, top_of_box};
use crate::shapes::SlantedBox;
use crate::{ContactTarget, GeomId, TwoHalfPhysicsSimulator, Vector2, Vector3};

/// Gap kept between a character and a wall, px, so that rounding does not press it against the wall.
pub(super) const WALL_CLEARANCE: f32 = 0.1;

/// Margin around the footprint in which the height of an obstacle is tested against the step height, px; more
/// than the contact margin.
const CURB_MARGIN: f32 = 1.0;
/// Greatest downward component of the contact normal of a wall, dimensionless, 0..=1. A surface with a greater component is a
/// ceiling.
const MAX_WALL_DOWN: f32 = 0.5;

impl TwoHalfPhysicsSimulator {
    /// Limits a velocity so that the character stops at the surface of walls and does not press on them.
    pub(super) fn stop_at_walls(
        &self,
        step: &StepContext<'_>,
        mut velocity: Vector3,
        is_wall: impl Fn(&DepthContact) -> bool,
    ) -> Vector3 {
        for touch in step.near.touches.iter().filter(|touch| touch.responds && is_wall(touch)) {
            let Some(partner) = partner_of(touch, step.geom).filter(|&it| self.is_obstacle(step, it)) else {
                continue;
            };
            let [x, up, z] = normal_towards(touch, step.geom);
            if (-MAX_WALL_DOWN..step.min_up).contains(&up) {
                let points = &touch.points[..touch.count];
                let gap = points.iter().fold(f32::INFINITY, |least, point| least.min(point.separation));
                let fastest = (gap - WALL_CLEARANCE).max(0.0) / step.dt;
                let wall = self.velocity_of(partner, step.place) / step.pace;
                let held = velocity + project_velocity(velocity - wall, Vector2::new(x, z), fastest);
                velocity = step.constrain_velocity(partner, velocity, held);
            }
        }
        self.stop_at_platforms(step, velocity)
    }

    /// Returns whether the target `partner` is an obstacle: higher than the step height. A door on a hinge is none, because the
    /// character pushes it open. A level platform is none here, because its sides limit the velocity [before they are
    /// touched](Self::stop_at_platforms).
    fn is_obstacle(&self, step: &StepContext<'_>, partner: ContactTarget) -> bool {
        match partner {
            ContactTarget::Geom(geom) => {
                self.geom(geom).is_some_and(|geom| geom.virtual_geom().top > step.knees)
            }
            ContactTarget::Platform(id) => self.platform(id).is_some_and(|platform| {
                // A door is pushed open.
                if platform.swing().is_some() {
                    return false;
                }
                let shape = platform.shape();
                // The top of a box that turns or climbs is measured above the footprint.
                let is_low = || {
                    top_of_box(shape, &step.footprint.widened(CURB_MARGIN))
                        .is_some_and(|top| top.0 <= step.knees)
                };
                shape.shear != 0.0 || ((shape.climb != 0.0 || shape.is_turned()) && !is_low())
            }),
            ContactTarget::Ground => false,
        }
    }

    /// Limits a velocity so that the character stops at the sides of platforms.
    fn stop_at_platforms(&self, step: &StepContext<'_>, mut velocity: Vector3) -> Vector3 {
        let displacement = velocity * step.dt;
        let swept = step.footprint.swept(displacement).widened(FOOTPRINT_SKIN + WALL_CLEARANCE);
        let low = Vector3::new(swept.left, -step.head, swept.front);
        let high = Vector3::new(swept.right, -step.soles, swept.back);
        for (id, platform) in self.world.platforms.overlapping(low, high) {
            if platform.is_one_way()
                || platform.swing().is_some()
                || !holds(platform, self.core.geom(step.geom).as_deref())
            {
                continue;
            }
            let Some(wall) = wall_of(platform.shape(), step) else { continue };
            if step.is_slope(platform.shape(), displacement) {
                continue;
            }
            let step = &step.on(step.footprint_against(platform.shape()));
            let held = stop_at_platform(step, velocity, &wall, platform.velocity() / step.pace);
            velocity = step.constrain_velocity(ContactTarget::Platform(id), velocity, held);
        }
        velocity
    }
}

/// Limits a velocity so that the character stops at a wall that moves with the velocity `moving`, px/s.
fn stop_at_platform(
    step: &StepContext<'_>,
    mut velocity: Vector3,
    wall: &CharacterFootprint,
    moving: Vector3,
) -> Vector3 {
    if let Some(round) = step.footprint.round {
        let displacement = [velocity.x - moving.x, velocity.z - moving.z].map(|part| part * step.dt);
        let [x, z] = stop_disc_at_wall(&round, wall, displacement).map(|part| part / step.dt);
        (velocity.x, velocity.z) = (moving.x + x, moving.z + z);
        return velocity;
    }
    let (along_x, along_z) = step.footprint.touching_displacements(wall);
    let x = WallApproach { displacement: (velocity.x - moving.x) * step.dt, ends: along_x };
    let z = WallApproach { displacement: (velocity.z - moving.z) * step.dt, ends: along_z };
    // The contact axis is the one that is entered last.
    if x.is_last(&z) {
        velocity.x = moving.x + x.allowed() / step.dt;
    } else if z.is_last(&x) {
        velocity.z = moving.z + z.allowed() / step.dt;
    }
    velocity
}

impl StepContext<'_> {
    /// The footprint that a box can block. On stairs, only the part of a hemisphere below the top of the box counts.
    fn footprint_against(&self, shape: &SlantedBox) -> CharacterFootprint {
        if !self.is_on_stairs {
            return self.footprint;
        }
        let top = shape.rectangle().iter().fold(f32::INFINITY, |top, corner| top.min(corner.y));
        self.footprint.up_to(-(top + shape.centre.y) - self.soles)
    }

    /// Returns whether a box is a walkable slope under the hemisphere of the character, so that the sides of the box do not
    /// block.
    fn is_slope(&self, shape: &SlantedBox, displacement: Vector3) -> bool {
        [self.footprint, self.footprint.moved(displacement)].into_iter().any(|footprint| {
            let rest = footprint.ball().and_then(|ball| ball.on_box(shape));
            rest.is_some_and(|rest| {
                rest.edge.is_none() && rest.normal.y >= self.min_up && rest.height <= self.knees
            })
        })
    }
}

/// Unit contact normal towards a geom, Y up.
pub(super) fn normal_towards(touch: &DepthContact, geom: GeomId) -> [f32; 3] {
    let sign = if touch.this == geom { 1.0 } else { -1.0 };
    let [x, y, z] = touch.normal;
    [sign * x, -sign * y, sign * z]
}

/// Returns the change of a velocity in X and Z, px/s, that limits its component against the normal to `fastest`, px/s.
fn project_velocity(velocity: Vector3, normal: Vector2, fastest: f32) -> Vector3 {
    let excess = -velocity.x * normal.x - velocity.z * normal.y - fastest;
    if excess <= 0.0 {
        return Vector3::zeros();
    }
    let push = normal * (excess / normal.norm_squared());
    Vector3::new(push.x, 0.0, push.y)
}

/// Returns the displacement of a disc in X and Z, px, without the component towards a wall after the disc has come near to the
/// wall (shape cast by bisection).
fn stop_disc_at_wall(round: &RoundFoot, wall: &CharacterFootprint, displacement: [f32; 2]) -> [f32; 2] {
    let corners =
        [[wall.left, wall.front], [wall.right, wall.front], [wall.right, wall.back], [wall.left, wall.back]];
    let disc =
        DepthQueryFootprint::Disc(round.radius + FOOTPRINT_SKIN + WALL_CLEARANCE - WALL_DISTANCE_ROUNDING);
    let gap = |part: f32| {
        let at = [0, 1].map(|axis| -round.from[axis] - part * displacement[axis]);
        disc.distance_to(DepthQueryFootprint::Polygon(&corners), at)
    };
    let (now, _) = gap(0.0);
    // A disc that overlaps the wall is left to the contact solver.
    if now < -2.0 * (FOOTPRINT_SKIN + WALL_CLEARANCE) || gap(1.0).0 >= 0.0 {
        return displacement;
    }
    let (mut before, mut after) = (0.0, 1.0);
    for _ in 0..BISECTION_STEPS {
        let middle = 0.5 * (before + after);
        if gap(middle).0 > 0.0 { before = middle } else { after = middle }
    }
    let (_, normal) = gap(before);
    let closing = (displacement[0] * normal[0] + displacement[1] * normal[1]) * (1.0 - before);
    if closing <= 0.0 { displacement } else { [0, 1].map(|axis| displacement[axis] - closing * normal[axis]) }
}

/// Greatest rounding error of the distance between a footprint and a wall, px.
const WALL_DISTANCE_ROUNDING: f32 = 0.002;
/// Number of bisections of the path of a disc towards a wall.
const BISECTION_STEPS: usize = 12;

/// Path along one axis, px, and the signed distances to the wall from below and from above, px.
struct WallApproach {
    displacement: f32,
    ends: [f32; 2],
}

impl WallApproach {
    /// Returns the distance from the footprint to the near side of the wall along this axis, px; negative for overlap.
    fn gap(&self) -> f32 {
        let [low, high] = self.ends;
        if self.displacement > 0.0 { low } else { -high }
    }

    /// Returns the interval of the path during which footprint and wall overlap along this axis, as fractions of the path.
    fn overlap(&self) -> (f32, f32) {
        let [low, high] = self.ends;
        if self.displacement == 0.0 {
            return if low < 0.0 && high > 0.0 { (0.0, f32::INFINITY) } else { (f32::INFINITY, 0.0) };
        }
        let (a, b) = (low / self.displacement, high / self.displacement);
        (a.min(b), a.max(b))
    }

    /// Returns whether footprint and wall begin to overlap last along this axis: at that time they overlap along the axis
    /// `other`.
    fn is_last(&self, other: &Self) -> bool {
        let (gap, displacement) = (self.gap(), self.displacement.abs());
        let (begins, ends) = other.overlap();
        let (near, near_at) = (gap - FOOTPRINT_SKIN - WALL_CLEARANCE, gap / displacement);
        displacement > 0.0
            && gap >= 0.0
            && near < displacement
            && begins < ends
            && begins <= near_at
            && ends > near_at.min(1.0)
    }

    fn allowed(&self) -> f32 {
        self.displacement.signum() * (self.gap() - FOOTPRINT_SKIN - WALL_CLEARANCE).max(0.0)
    }
}

impl CharacterFootprint {
    /// Returns the displacements along X and those along Z at which this footprint touches the footprint `other` from either
    /// side, px.
    fn touching_displacements(&self, other: &CharacterFootprint) -> ([f32; 2], [f32; 2]) {
        (
            [other.left - self.right, other.right - self.left],
            [other.front - self.back, other.back - self.front],
        )
    }
}

/// Returns the footprint of the part of a box between step height and head of the character; `None` if the box has no such
/// part.
pub(super) fn wall_of(shape: &SlantedBox, step: &StepContext<'_>) -> Option<CharacterFootprint> {
    if shape.is_sheared() || shape.is_turned() {
        return None;
    }
    let (top, bottom) = (-step.head, -step.knees);
    let corners = shape.rectangle();
    let (mut left, mut right) = (f32::INFINITY, f32::NEG_INFINITY);
    for at in 0..4 {
        let (a, b) = (corners[at], corners[(at + 1) % 4]);
        let (a, b) = (a + shape.centre.xy(), b + shape.centre.xy());
        let (high, low) = if a.y <= b.y { (a, b) } else { (b, a) };
        let (from, to) = (high.y.max(top), low.y.min(bottom));
        if from > to {
            continue;
        }
        let x_at = |y: f32| {
            if low.y > high.y { high.x + (low.x - high.x) * ((y - high.y) / (low.y - high.y)) } else { a.x }
        };
        for x in [x_at(from), x_at(to)].into_iter().chain((low.y == high.y).then_some(b.x)) {
            (left, right) = (left.min(x), right.max(x));
        }
    }
    let depth = shape.half[2];
    (left < right)
        .then(|| CharacterFootprint::rectangle(left, right, shape.centre.z - depth, shape.centre.z + depth))
}
