//! Contacts of polygons that roll or topple over a static face, renewed in every substep.
//!
//! The narrow phase runs once per step and finds two corners. A polygon of 48 corners that rolls with 12 rad/s passes more than
//! one corner in 1/60 s: the next one would enter the face unseen, and undoing that penetration lifts the body in every step.
//! The lift is potential energy out of nothing. So the corners of the edge that faces the plane are chosen anew before each
//! substep, with their separations and arms as they are in its middle. The midpoint rule makes the path of a corner exact to
//! the second order, and neither gains nor loses energy while the body pivots (E. Hairer, C. Lubich, G. Wanner, "Geometric
//! Numerical Integration", 2006, II.1).
//!
//! A polygon that neither slips nor hops, and touches nothing but static faces of one plane, pivots in closed form instead:
//! [`pivoting`](super::pivoting).

use super::Precise;
use super::outline::{Family, Outline};
use super::pairs::Frozen;
use super::pivoting::OnCorner;
use super::rows::{Home, Lane, PointLane};
use super::tuning::Step;
use crate::math::plane::{
    Turn, Vector, cross, difference, dot, place, rotation, scaled, sum, turn, turn_back,
};
use crate::math::scalar;
use crate::precise::parameters::contacts::ROLLING_POINT_DISTANCE;
use crate::storage::order::sort_by_number;

/// A contact of a polygon that rolls over a static face in this step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Roll {
    /// Of the static face and of the polygon.
    pub(super) proxies: [u32; 2],
    /// Index of the pair, valid from [`Precise::begin_rolls`] to the end of the step.
    pub(super) pair: u32,
    /// Indices of the corners of the polygon that the two points of the row are.
    corners: [u32; 2],
    /// How much farther each of these is from the plane than its velocity says, if the velocity is that which a pivot has at
    /// the end of the substep: length units.
    lean: [f32; 2],
    /// Separations at the end of the substep in length units.
    after: [f32; 2],
    /// Impulses of both points before the substep.
    before: [f32; 2],
    /// The path of the body in this step: length units and rad.
    path: [f32; 4],
    /// The polygon turns so fast that its corners are chosen anew in every substep.
    is_fast: bool,
    /// The body after the step, if it pivots from corner to corner: its velocities are not those of the iterative solver.
    pub(super) pivoted: Option<OnCorner>,
}

impl Roll {
    pub(super) fn new(proxies: [u32; 2], is_fast: bool) -> Self {
        Roll {
            is_fast,
            pivoted: None,
            proxies,
            pair: 0,
            corners: [0; 2],
            lean: [0.0; 2],
            after: [0.0; 2],
            before: [0.0; 2],
            path: [0.0; 4],
        }
    }
}

/// The static plane under a polygon: unit normal towards the polygon, and distance from the origin of A's body in length units.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    pub(super) normal: Vector,
    pub(super) offset: f32,
}

impl Plane {
    pub(super) fn of(frozen: &Frozen) -> Self {
        let (normal, [ax, ay, ..]) = (frozen.normal, frozen.anchors[0]);
        Plane { normal, offset: dot([ax, ay], normal) - 0.5 * frozen.separations[0] }
    }
}

impl Precise {
    /// Finds the rows of the polygons that roll in this step, and the corners that these rows have.
    pub(super) fn begin_rolls(&mut self, step: &Step) {
        let mut rolling = std::mem::take(&mut self.rolling);
        sort_by_number(&mut rolling, |roll| self.proxies.creation_numbers(roll.proxies));
        rolling.dedup_by_key(|roll| roll.proxies);
        self.begin_pivots(&mut rolling, step);
        rolling
            .retain_mut(|roll| roll.pivoted.is_some() || (roll.is_fast && self.begin_roll(roll).is_some()));
        self.rolling = rolling;
    }

    fn begin_roll(&self, roll: &mut Roll) -> Option<()> {
        let pair =
            self.pairs.of(roll.proxies[1]).find(|&at| self.pairs.watched[at].proxies == roll.proxies)?;
        let (state, frozen) = (&self.pairs.all[pair], &self.pairs.frozen[pair]);
        let home = state.home.filter(|&home| self.rows.aside(home).is_none())?;
        let outline = self.outline_of(roll.proxies[1]);
        let is_flat = frozen.space.normal_z == 0.0 && frozen.space.spread == 0.0;
        let is_convex = matches!(outline.shape.family, Family::Polygon | Family::Capsule);
        let has_mass = self.rows.lane(state.kind, home).inverse_masses[1] > 0.0;
        if !(is_flat && is_convex && has_mass) || frozen.lead == 0.0 {
            return None;
        }
        let [_, _, c, s] = frozen.turns;
        let ends = facing_ends(outline, turn_back([c, s], frozen.normal));
        let tangent = [-frozen.normal[1], frozen.normal[0]];
        let is_at = |at: usize, corner: u32| {
            let [_, _, bx, by] = frozen.anchors[at];
            let off = difference([bx, by], turn([c, s], outline.points[corner as usize]));
            dot(off, tangent).abs() <= ROLLING_POINT_DISTANCE * outline.shape.reach
        };
        let is_turned = !is_at(0, ends[0]);
        let corners = if is_turned { [ends[1], ends[0]] } else { ends };
        let are_corners = (0..frozen.count as usize).all(|at| is_at(at, corners[at]));
        (roll.pair, roll.corners) = (pair as u32, corners);
        are_corners.then_some(())
    }

    pub(super) fn outline_of(&self, proxy: u32) -> Outline<'_> {
        self.proxies.corners.outline(self.proxies.all[proxy as usize].shape)
    }

    /// Before a substep: the rows of rolling polygons follow the corners.
    pub(super) fn renew_rolls(&mut self, step: &Step, is_first: bool) {
        let mut rolling = std::mem::take(&mut self.rolling);
        rolling.iter_mut().for_each(|roll| self.renew_roll(roll, step, is_first));
        self.rolling = rolling;
    }

    fn renew_roll(&mut self, roll: &mut Roll, step: &Step, is_first: bool) {
        if roll.pivoted.is_some() {
            return;
        }
        let (pair, [at_a, at_b]) = (roll.pair as usize, roll.proxies);
        (roll.lean, roll.before) = ([0.0; 2], [f32::MAX; 2]);
        let Some(home) = self.pairs.all[pair].home else { return };
        let [a, b] = roll.proxies.map(|proxy| self.proxies.all[proxy as usize].body as usize);
        let frozen = &self.pairs.frozen[pair];
        let plane = Plane::of(frozen);
        let path = if is_first { [0.0; 4] } else { self.bodies.path[b] };
        let half_turn = 0.5 * step.h * self.bodies.hot[b].velocity[2];
        let (sine, cosine) = scalar::sin_cos(path[2] + half_turn);
        let q = turn([cosine, sine], rotation(self.bodies.poses[b]));
        let apart = difference(place(self.bodies.poses[b]), place(self.bodies.poses[a]));
        let apart = sum(apart, [path[0], path[1]]);
        let outline = self.outline_of(at_b);
        let corners = facing_ends(outline, turn_back(q, plane.normal));
        let arms = corners.map(|corner| turn(q, outline.points[corner as usize]));
        let face = self.outline_of(at_a);
        let on_face =
            |arm: &Vector| is_over(face, rotation(self.bodies.poses[a]), plane.normal, sum(apart, *arm));
        if !self.pairs.all[pair].is_on_ground && !arms.iter().all(on_face) {
            return;
        }
        let radius = outline.shape.radius;
        let kind = self.pairs.all[pair].kind;
        let old = self.rows.lane(kind, home);
        let mut lane = old;
        for at in 0..2 {
            let from = match roll.corners.iter().position(|&corner| corner == corners[at]) {
                Some(from) => Some(from),
                None if roll.corners.iter().any(|corner| corners.contains(corner)) => None,
                None => Some(at),
            };
            let arm_b = cross(arms[at], plane.normal);
            let middle = dot(sum(apart, arms[at]), plane.normal) - radius - plane.offset;
            let kept = from.map_or(PointLane::default(), |from| old.points[from]);
            lane.points[at] = PointLane {
                arm_a: 0.0,
                arm_b,
                separation: middle - half_turn * arm_b,
                impulse: kept.impulse,
                // A spring that sagged anew at each corner would take its sag times the weight.
                held: kept.impulse,
                mass: 0.0,
            };
            lane.points[at].mass = lane.weight(&lane.points[at]);
            lane.space.totals[at] = from.map_or(0.0, |from| old.space.totals[from]);
        }
        let reach = self.tuning.speculative;
        lane.tangent_arms[1] = tangent_arm(&lane, arms, plane.normal, radius, reach);
        let turning = lane.inverse_inertias[1] * lane.tangent_arms[1] * lane.tangent_arms[1];
        lane.tangent_mass = 1.0 / (lane.inverse_masses[1] + turning);
        let (sine, cosine) = scalar::sin_cos(half_turn);
        let still_face = facing_ends(outline, turn_back(turn([cosine, sine], q), plane.normal));
        roll.lean = std::array::from_fn(|at| {
            let stays = still_face.contains(&corners[at]);
            if stays { -2.0 * half_turn * half_turn * dot(arms[at], plane.normal) } else { 0.0 }
        });
        roll.corners = corners;
        roll.before = lane.points.map(|point| point.impulse);
        self.change_warm(b, &old, &lane);
        self.rows.set_lane(kind, home, &lane);
    }

    /// The impulses of a row act on its body with other arms from now on, and some of them no more.
    fn change_warm(&mut self, b: usize, old: &Lane, new: &Lane) {
        let along = |lane: &Lane| lane.points[0].impulse + lane.points[1].impulse;
        let turning = |lane: &Lane| {
            let of_points: f32 = lane.points.iter().map(|point| point.impulse * point.arm_b).sum();
            of_points + lane.tangent_impulse * lane.tangent_arms[1]
        };
        let change = new.inverse_masses[1] * (along(new) - along(old));
        let warm = &mut self.bodies.warm[b];
        warm[0] += change * new.normal[0];
        warm[1] += change * new.normal[1];
        warm[2] += new.inverse_inertias[1] * (turning(new) - turning(old));
    }

    /// Between the two passes of a substep. The first one brings the velocity to that of the pivot in the middle of the substep,
    /// by which the body moves; the second one is to leave that of its end. Both act with the arms of the middle: so the
    /// impulses of a pivot do no work. With one velocity for both, each substep would take (r w^2 h)^2 / 2 per unit of mass.
    ///
    /// The second pass looks one substep ahead, and would stop the next corner that early: the corners would strike with too
    /// large an angle between them, and what a strike takes grows with its square. A corner that has not arrived is left alone.
    pub(super) fn lean_rolls(&mut self) {
        let mut rolling = std::mem::take(&mut self.rolling);
        for roll in rolling.iter_mut().filter(|roll| roll.pivoted.is_none()) {
            let state = &self.pairs.all[roll.pair as usize];
            let Some(home) = state.home else { continue };
            let lane = self.rows.lane(state.kind, home);
            let [x, y, turned, _] = self.bodies.hot[lane.b as usize].step;
            let mut separations = [0.0; 2];
            for (at, point) in lane.points.iter().enumerate() {
                let after = point.separation + dot([x, y], lane.normal) + turned * point.arm_b;
                let is_free = point.impulse == 0.0 && roll.before[at] == 0.0;
                let arrives_later = is_free && after > 0.0;
                roll.after[at] = after;
                separations[at] =
                    point.separation + if arrives_later { self.tuning.unit } else { roll.lean[at] };
            }
            self.rows.set_separations(state.kind, home, separations);
        }
        self.rolling = rolling;
    }

    /// The path of a polygon that rolls is that of its substeps, whatever is made of others.
    pub(super) fn note_paths_of_rolls(&mut self) {
        for roll in &mut self.rolling {
            let path = self.bodies.path[self.proxies.all[roll.proxies[1] as usize].body as usize];
            roll.path = roll.pivoted.map_or(path, |after| [after.path[0], after.path[1], after.turned, 0.0]);
        }
    }

    pub(super) fn restore_paths_of_rolls(&mut self) {
        for roll in &self.rolling {
            self.bodies.path[self.proxies.all[roll.proxies[1] as usize].body as usize] = roll.path;
        }
    }

    /// After the last substep: what is kept of the contacts is that of the corners which the rows have now, as they lay when the
    /// step began; so that a restored row has the arms of one that was not saved.
    pub(super) fn end_rolls(&mut self, step: &Step) {
        let mut rolling = std::mem::take(&mut self.rolling);
        for roll in rolling.drain(..) {
            let pair = roll.pair as usize;
            if let Some(after) = roll.pivoted {
                self.end_pivot(&roll, &after, step);
            } else if let Some(home) = self.pairs.all[pair].home {
                self.end_roll(pair, roll, home);
            }
        }
        self.rolling = rolling;
    }

    fn end_roll(&mut self, pair: usize, roll: Roll, home: Home) {
        let kind = self.pairs.all[pair].kind;
        let old = self.rows.lane(kind, home);
        let is_second = roll.after[1] < roll.after[0];
        let order = if is_second { [1, 0] } else { [0, 1] };
        let is_near = |at: &usize| roll.after[*at] < self.tuning.speculative || old.points[*at].impulse > 0.0;
        let count = 1 + usize::from(is_near(&order[1]));
        let order = if count == 2 { [0, 1] } else { order };
        let outline = self.outline_of(roll.proxies[1]);
        let [a, b] =
            roll.proxies.map(|proxy| self.bodies.poses[self.proxies.all[proxy as usize].body as usize]);
        let apart = difference(place(b), place(a));
        let plane = Plane::of(&self.pairs.frozen[pair]);
        let mut frozen = self.pairs.frozen[pair];
        let names_face = !self.pairs.all[pair].is_on_ground;
        for (slot, &at) in order.iter().enumerate() {
            let corner = roll.corners[at];
            let round = scaled(plane.normal, outline.shape.radius);
            let arm = difference(turn(rotation(b), outline.points[corner as usize]), round);
            let separation = dot(sum(apart, arm), plane.normal) - plane.offset;
            let arm = difference(arm, scaled(plane.normal, 0.5 * separation));
            let on_a = sum(apart, arm);
            frozen.anchors[slot] = [on_a[0], on_a[1], arm[0], arm[1]];
            frozen.separations[slot] = separation;
            let face = if names_face { frozen.features[slot] & 0xffff_0000 } else { 0 };
            frozen.features[slot] = face | corner;
        }
        (frozen.count, frozen.lead) = (count as u32, 0.0);
        self.pairs.frozen[pair] = frozen;
        self.pairs.watched[pair].tolerance = 0;
        let now = self.touch().lane_now(pair);
        let is_set = self.pairs.all[pair].is_set;
        let mut lane = Lane {
            points: now.points,
            tangent_arms: now.tangent_arms,
            tangent_mass: now.tangent_mass,
            tangent_speed: if is_set { old.tangent_speed } else { now.tangent_speed },
            ..old
        };
        for (slot, &at) in order.iter().enumerate().take(count) {
            lane.points[slot].impulse = old.points[at].impulse;
            lane.points[slot].separation = roll.after[at];
            lane.space.totals[slot] = old.space.totals[at];
        }
        (lane.space.across_arms, lane.space.across_speed) = (now.space.across_arms, now.space.across_speed);
        self.rows.set_lane(kind, home, &lane);
    }
}

/// The ends of the edge that faces against a direction most, in the order in which clipping names them.
pub(super) fn facing_ends(outline: Outline<'_>, direction: Vector) -> [u32; 2] {
    let (mut least, mut edge) = (f32::MAX, 0);
    for (at, &normal) in outline.normals.iter().enumerate() {
        let along = dot(normal, direction);
        if along < least {
            (least, edge) = (along, at);
        }
    }
    [((edge + 1) % outline.points.len()) as u32, edge as u32]
}

/// Whether a point is over the face of an outline that has this normal.
pub(super) fn is_over(face: Outline<'_>, q: Turn, normal: Vector, point: Vector) -> bool {
    let (normal, point) = (turn_back(q, normal), turn_back(q, point));
    let ends = facing_ends(face, scaled(normal, -1.0)).map(|end| face.points[end as usize]);
    let along = difference(ends[1], ends[0]);
    let at = dot(difference(point, ends[0]), along);
    at >= 0.0 && at <= dot(along, along)
}

/// The arm of friction: how far the points that are within reach lie from the middle of the body, on average.
fn tangent_arm(lane: &Lane, arms: [Vector; 2], normal: Vector, radius: f32, reach: f32) -> f32 {
    let arm = |at: usize| radius + 0.5 * lane.points[at].separation - dot(arms[at], normal);
    let [first, second] = [0, 1].map(|at| lane.points[at].separation);
    match (first < reach, second < reach) {
        (true, false) => arm(0),
        (false, true) => arm(1),
        (true, true) => 0.5 * (arm(0) + arm(1)),
        (false, false) if second < first => arm(1),
        (false, false) => arm(0),
    }
}
