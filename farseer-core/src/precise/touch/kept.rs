//! Contact recycling (E. Catto, "Contact recycling", 2026; Box2D 3.2, `physics_world.c`).
//!
//! The narrow phase of a pair is skipped while the pair has hardly moved since its manifold was computed: the relative
//! translation plus `reach` times the sine of the relative rotation is below `Tuning::frozen`, and neither body has turned
//! further than `RECYCLING_COSINE`. The normal and the anchors stay, turned with their bodies; the separations follow exactly
//! from the poses. A manifold that follows every small motion makes tall stacks jitter. The metric is that of conservative
//! advancement. `frozen` (0.05 m) and `RECYCLING_COSINE` (0.98) are Box2D's `B2_CONTACT_RECYCLE_DISTANCE` and
//! `B2_CONTACT_RECYCLE_COS_ANGLE`.
//!
//! Not in Box2D: the tighter limits for what lies on a kinematic body, for polygons that roll, and for the error that sliding
//! adds to a normal that has turned; and the fallback to the nearest old point. The points of a new manifold inherit the
//! impulses of the old points with the same features, else those of the nearest old point.

use super::{Touch, Two};
use crate::math::plane::{Vector, cross, difference, dot, length, rotation, scaled, sum, turn, turn_back};
use crate::precise::manifold::Manifold;
use crate::precise::pairs::{Frozen, FrozenInSpace};
use crate::precise::parameters::narrow_phase::{
    ARM_LEAD_ANGLE, KINEMATIC_RECYCLING_COSINE, RECYCLED_SEPARATION_ERROR, RECYCLING_COSINE,
    ROLLING_ROTATION, WARM_START_DISTANCE,
};
use crate::precise::proxies::Mobility;
use crate::precise::rows::Kind;

impl Touch<'_> {
    /// Whether the manifold of a pair may be recycled: not for circles and balls, on which the contact point wanders, and not
    /// for outlines that have passed each other along the depth axis.
    pub(super) fn may_renew(&self, pair: usize, two: Two<'_>) -> bool {
        let Some(space) = self.space else { return !self.are_circles(two) };
        let (kind, proxies) = (self.pairs.all[pair].kind, self.pairs.watched[pair].proxies);
        // What is upright may have come out from above or beside the other one.
        if proxies.iter().any(|&proxy| space.is_upright(proxy)) {
            return false;
        }
        let is_in_plane = self.pairs.frozen[pair].space.normal_z.abs() < 1.0;
        kind.has_two_points && (!is_in_plane || space.are_beside(proxies, space.apart(two.a, two.b)))
    }

    /// Recycles the manifold: the separations follow the poses. Returns false, and changes nothing, if the pair has moved too far.
    pub(super) fn renew(&mut self, pair: usize, two: Two<'_>) -> bool {
        let frozen = &self.pairs.frozen[pair];
        let (qa, qb) = (rotation(two.pose_a), rotation(two.pose_b));
        let [ca, sa, cb, sb] = frozen.turns;
        let [turned_a, turned_b] = [turn_back([ca, sa], qa), turn_back([cb, sb], qb)];
        let [x, y, c, s] = two.relative();
        let [x0, y0, c0, s0] = frozen.relative;
        let sine = cross([c0, s0], [c, s]).abs();
        let reach =
            if self.is_fixed(two.a) { two.b.shape.reach } else { two.a.shape.reach.max(two.b.shape.reach) };
        let moved = length([x - x0, y - y0]) + reach * sine;
        let is_kinematic = two.a.mobility == Mobility::Kinematic;
        let is_same = turned_a[0] > if is_kinematic { KINEMATIC_RECYCLING_COSINE } else { RECYCLING_COSINE }
            && turned_b[0] > RECYCLING_COSINE
            && !self.turns_over(pair, two)
            && moved < self.tuning.frozen - self.tuning.checked
            && moved * turned_a[1].abs().max(turned_b[1].abs())
                < RECYCLED_SEPARATION_ERROR * self.tuning.unit;
        if !is_same {
            return false;
        }
        let separations = self.separations_now(frozen, two);
        match self.pairs.all[pair].home {
            Some(home) => self.rows.set_separations(self.pairs.all[pair].kind, home, separations),
            None => return false,
        }
        true
    }

    /// Separations of the cached points in the poses of now, length units; entries from `count` on have no meaning.
    pub(super) fn separations_now(&self, frozen: &Frozen, two: Two<'_>) -> [f32; 2] {
        let [ca, sa, cb, sb] = frozen.turns;
        let (turned_a, turned_b) =
            (turn_back([ca, sa], rotation(two.pose_a)), turn_back([cb, sb], rotation(two.pose_b)));
        let FrozenInSpace { normal_z, apart: apart_then, .. } = frozen.space;
        let along_depth = self.space.map_or(0.0, |space| normal_z * (space.apart(two.a, two.b) - apart_then));
        let mut separations = frozen.separations;
        for (separation, &[ax, ay, bx, by]) in separations.iter_mut().zip(&frozen.anchors) {
            let apart = sum(two.apart(), difference(turn(turned_b, [bx, by]), turn(turned_a, [ax, ay])));
            *separation += dot(apart, frozen.normal) + along_depth;
        }
        separations
    }

    /// Rotation of a polygon on a static body in this step at its present angular velocity, radians; else 0.
    fn turn_on_fixed(&self, pair: usize, two: Two<'_>) -> f32 {
        let Kind { has_two_points, is_fixed, .. } = self.pairs.all[pair].kind;
        if has_two_points && is_fixed {
            // In a pair with a sensor both sides may be static.
            self.bodies.hot.get(two.b.body as usize).map_or(0.0, |hot| hot.velocity[2] * self.dt)
        } else {
            0.0
        }
    }

    /// Whether a polygon rolls over a static face; and if it does, whether it turns so far in this step that its contacts are
    /// renewed in every substep.
    pub(super) fn rolls(&self, pair: usize, two: Two<'_>) -> Option<bool> {
        let is_rolling = self.pairs.frozen[pair].lead != 0.0 && self.turns_over(pair, two);
        is_rolling.then(|| self.turn_on_fixed(pair, two).abs() > ROLLING_ROTATION)
    }

    /// Whether a polygon on a static face turns far in this step, or has the energy to pass the corner that it stands on.
    fn turns_over(&self, pair: usize, two: Two<'_>) -> bool {
        let turned = self.turn_on_fixed(pair, two).abs();
        turned > ROLLING_ROTATION || (turned > 0.0 && self.passes_corner(pair, two))
    }

    /// Whether the spin about a contact point carries the centre of mass of B over that point, under gravity along the normal.
    /// With the radius of gyration k and the arm r of the point, at the height y: w^2 (k^2 + r^2) > 2 g (r - y).
    fn passes_corner(&self, pair: usize, two: Two<'_>) -> bool {
        let (body, frozen) = (two.b.body as usize, &self.pairs.frozen[pair]);
        let [mass, inertia] = self.bodies.inverses[body];
        if !(self.palette.touches_fixed_alone(body)
            && mass > 0.0
            && inertia > 0.0
            && two.b.shape.radius == 0.0)
        {
            return false;
        }
        let spin = self.bodies.hot[body].velocity[2];
        let gravity = length(self.fall) / self.dt * self.bodies.gravity_parts[body].abs();
        let q = turn_back([frozen.turns[2], frozen.turns[3]], rotation(two.pose_b));
        frozen.anchors[..frozen.count as usize].iter().any(|&[_, _, x, y]| {
            let (reach, height) = (length([x, y]), -dot(turn(q, [x, y]), frozen.normal));
            spin * spin * (mass / inertia + reach * reach) > 2.0 * gravity * (reach - height)
        })
    }

    /// Caches a manifold with the poses that it was computed in.
    pub(super) fn freeze(&mut self, pair: usize, two: Two<'_>, found: &Manifold) {
        let count = if self.pairs.all[pair].kind.has_two_points { found.count } else { found.count.min(1) };
        let apart = if self.are_circles(two) {
            // Where they meet: what pushes circles does not turn them.
            let [ra, rb] = [two.a, two.b].map(|proxy| proxy.shape.radius);
            scaled(found.normal, ra + rb + found.separations[0])
        } else {
            two.apart()
        };
        let anchors = found.points.map(|point| {
            let [bx, by] = difference(point, apart);
            [point[0], point[1], bx, by]
        });
        let [qa, qb] = [rotation(two.pose_a), rotation(two.pose_b)];
        let lead = if found.is_of_b { 0.0 } else { 0.5 * self.turn_on_fixed(pair, two) };
        self.pairs.frozen[pair] = Frozen {
            turns: [qa[0], qa[1], qb[0], qb[1]],
            relative: two.relative(),
            normal: found.normal,
            count: count as u32,
            anchors,
            separations: found.separations,
            features: found.features,
            lead: lead.clamp(-ARM_LEAD_ANGLE, ARM_LEAD_ANGLE),
            space: FrozenInSpace {
                normal_z: found.normal_z,
                apart: self.space.map_or(0.0, |space| space.apart(two.a, two.b)),
                spread: found.spread,
                depths: found.depths,
            },
        };
    }

    /// The old point whose impulses each new point inherits: the one with the same feature, else the nearest that is left over.
    pub(super) fn kept(&self, pair: usize, two: Two<'_>, found: &Manifold) -> [Option<usize>; 2] {
        if !self.pairs.all[pair].kind.has_two_points {
            return [Some(0), None];
        }
        let old = &self.pairs.frozen[pair];
        let old_count = old.count as usize;
        let mut kept = [None; 2];
        let mut is_taken = [false; 2];
        for (kept, feature) in kept.iter_mut().zip(found.features).take(found.count) {
            *kept = (0..old_count).find(|&o| !is_taken[o] && old.features[o] == feature);
            kept.iter().for_each(|&o| is_taken[o] = true);
        }
        let size =
            if self.is_fixed(two.a) { two.b.shape.reach } else { two.a.shape.reach.min(two.b.shape.reach) };
        let lost = kept.iter_mut().zip(found.points).take(found.count).filter(|(kept, _)| kept.is_none());
        for (kept, point) in lost {
            let mut nearest = (WARM_START_DISTANCE * size) * (WARM_START_DISTANCE * size);
            for o in (0..old_count).filter(|&o| !is_taken[o]) {
                let distance = self.squared_distance(old, o, two, point);
                if distance < nearest {
                    (nearest, *kept) = (distance, Some(o));
                }
            }
            kept.iter().for_each(|&o| is_taken[o] = true);
        }
        kept
    }

    /// Squared distance of an old anchor from a new point, on the body on which they are nearer.
    fn squared_distance(&self, old: &Frozen, point: usize, two: Two<'_>, new: Vector) -> f32 {
        let [ax, ay, bx, by] = old.anchors[point];
        let [ca, sa, cb, sb] = old.turns;
        let new_b = difference(new, two.apart());
        let on_a = difference(turn_back([ca, sa], [ax, ay]), turn_back(rotation(two.pose_a), new));
        let on_b = difference(turn_back([cb, sb], [bx, by]), turn_back(rotation(two.pose_b), new_b));
        let (a, b) = (dot(on_a, on_a), dot(on_b, on_b));
        if a < b { a } else { b }
    }
}
