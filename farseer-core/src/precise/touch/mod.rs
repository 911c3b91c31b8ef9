//! Where pairs touch: which of them are looked at, and what comes of that.
//!
//! A pair is looked at only when its bodies have moved so far that something can have changed. Then, while the two have
//! hardly moved *against each other* since their contacts were found, these are [kept](kept); else they are found anew.

mod ahead;
mod apart;
mod kept;
mod lane;
mod rims;
mod rows;
mod sunk;
mod touching;

use super::bodies::Bodies;
use super::direct::Direct;
use super::flush::Flush;
use super::manifold::{Manifold, circles_meet, collide};
use super::pairs::{BY_ROW, Frozen, FrozenInSpace, Pairs, Watch};
use super::proxies::{Mobility, Proxies, Proxy};
use super::rolling::Roll;
use super::rows::{Lane, Palette, Rows};
use super::sleep::Sleep;
use super::space::{Before, Held, Limits, Space, touch_balls};
use super::tuning::Tuning;
use crate::body::BodyId;
use crate::geom::surface::FrictionType;
use crate::math::plane::{Pose, Vector, difference, length, place, rotation, scaled, sum, turn_back};
use crate::math::scalar::nearest_finite;
use crate::precise::parameters::broad_phase::SEPARATED_PAIR_SLACK;
use ahead::Approach;
use lane::carry_friction;
pub(super) use touching::Change;

/// Finds contacts: the parts of the step that this takes.
pub(super) struct Touch<'a> {
    pub(super) bodies: &'a Bodies,
    pub(super) proxies: &'a Proxies,
    pub(super) pairs: &'a mut Pairs,
    pub(super) rows: &'a mut Rows,
    pub(super) palette: &'a mut Palette,
    pub(super) sleep: &'a mut Sleep,
    pub(super) direct: &'a mut Direct,
    pub(super) space: Option<Held<&'a Space>>,
    pub(super) tuning: &'a Tuning,
    pub(super) friction: FrictionType,
    /// Contacts of two pieces, at most.
    pub(super) most_contacts: usize,
    /// Seconds of the step, and what gravity adds to velocities in it.
    pub(super) dt: f32,
    pub(super) fall: Vector,
    /// Pairs of geoms that begin to touch, or may have ceased to, since this was told last.
    pub(super) changes: &'a mut Vec<Change>,
    /// Who has parted from what gives way nowhere, and how deep it was in that.
    pub(super) parted: &'a mut Vec<(BodyId, f32)>,
    pub(super) looks: &'a mut Looks,
    /// Empty between scans, but for the room it has.
    pub(super) due: &'a mut Vec<u32>,
    /// Contacts of polygons that roll over a static face in this step.
    pub(super) rolling: &'a mut Vec<Roll>,
}

/// What became of pairs that were looked at.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Looks {
    /// Contacts were found anew, or kept.
    pub(crate) made: usize,
    pub(crate) kept: usize,
}

/// What a pair is made of.
#[derive(Clone, Copy)]
pub(super) struct Two<'a> {
    pub(super) a: &'a Proxy,
    pub(super) b: &'a Proxy,
    pub(super) pose_a: Pose,
    pub(super) pose_b: Pose,
}

impl Two<'_> {
    /// B's pose as seen from A.
    pub(super) fn relative(&self) -> [f32; 4] {
        let (qa, qb) = (rotation(self.pose_a), rotation(self.pose_b));
        let [x, y] = turn_back(qa, self.apart());
        let [c, s] = turn_back(qa, qb);
        [x, y, c, s]
    }

    pub(super) fn apart(&self) -> Vector {
        difference(place(self.pose_b), place(self.pose_a))
    }
}

impl<'a> Touch<'a> {
    #[inline(always)]
    fn two(&self, pair: usize) -> Two<'a> {
        let [a, b] = self.pairs.watched[pair].proxies.map(|proxy| &self.proxies.all[proxy as usize]);
        let pose = |proxy: &Proxy| self.bodies.poses[proxy.body as usize];
        Two { a, b, pose_a: pose(a), pose_b: pose(b) }
    }

    #[inline(always)]
    fn motion(&self, watch: &Watch) -> u32 {
        let [a, b] = watch.proxies.map(|proxy| self.proxies.motion[proxy as usize]);
        a.wrapping_add(b)
    }

    /// Looks at all pairs that have moved far enough. Answers how many.
    pub(super) fn scan(&mut self) -> usize {
        let mut due = std::mem::take(self.due);
        let looked_at = self.list_due(&mut due);
        if self.space.is_none() && self.proxies.one_way == 0 {
            self.part_boxes(&mut due);
        }
        due.drain(..).for_each(|pair| self.look(pair as usize));
        *self.due = due;
        looked_at
    }

    /// Lists these pairs, and answers how many they are. While things move nobody foresees which: none is worth a branch.
    fn list_due(&self, due: &mut Vec<u32>) -> usize {
        let (awake, mut count) = (self.pairs.awake, 0);
        due.resize(awake, 0);
        for (pair, watch) in self.pairs.watched[..awake].iter().enumerate() {
            let moved = self.motion(watch).wrapping_sub(watch.since);
            due[count] = pair as u32;
            count += usize::from((moved >= watch.tolerance) & (watch.tolerance != BY_ROW));
        }
        due.truncate(count);
        count
    }

    /// Looks at a pair.
    pub(super) fn look(&mut self, pair: usize) {
        let two = self.two(pair);
        let is_known = self.pairs.frozen[pair].count > 0 && self.pairs.watched[pair].tolerance != BY_ROW;
        self.pairs.watched[pair].since = self.motion(&self.pairs.watched[pair]);
        if is_known && self.may_renew(pair, two) && self.renew(pair, two) {
            self.looks.kept += 1;
            self.note_touch(pair, two);
            return;
        }
        let reach = self.reach(two);
        let mut found = self.collide(pair, two, reach);
        found.keep_deepest(self.most_contacts);
        let is_open = self.proxies.one_way > 0 && self.is_open(pair, two, &found);
        if !found.is_within_reach() {
            self.part(pair, found.gap - reach);
        } else if is_open || self.passes_through(pair, two) {
            self.part(pair, 0.0);
        } else {
            self.looks.made += 1;
            self.meet(pair, two, &found, Approach::default());
            self.note_touch(pair, two);
        }
    }

    /// Tells what flush neighbours hide, where bodies are.
    fn flush(&self) -> Flush<'_> {
        let Touch { bodies, proxies, pairs, tuning, dt, .. } = self;
        Flush { bodies, proxies, pairs, tuning, dt: *dt, part: 0.0 }
    }

    /// The row of a pair as it would be made from what is kept of its contacts, without impulses.
    pub(super) fn lane_now(&self, pair: usize) -> Lane {
        self.lane(pair, self.two(pair))
    }

    /// How far contacts reach: as far as two can come in this step where one is a box that sweeps through what is in its way.
    fn reach(&self, two: Two<'_>) -> f32 {
        let (Some(space), Mobility::Kinematic | Mobility::Hinged) = (self.space, two.a.mobility) else {
            return self.tuning.speculative;
        };
        let sweep = space.sweep(two.a, self.bodies, self.tuning, self.dt);
        let comes = || {
            let [x, y, _, z] = self.bodies.hot[two.b.body as usize].velocity;
            length([length([x, y]), z]) * self.dt
        };
        self.tuning.speculative + if sweep > 0.0 { nearest_finite(sweep + comes()) } else { 0.0 }
    }

    fn collide(&self, pair: usize, two: Two<'_>, reach: f32) -> Manifold {
        let outline = |proxy: &Proxy| self.proxies.corners.outline(proxy.shape);
        let Some(space) = self.space else {
            let found = collide(outline(two.a), outline(two.b), two.pose_a, two.pose_b, reach);
            if two.a.mobility != Mobility::Dynamic && found.count > 0 && two.a.shape.count > 0 {
                return self.flush().filtered(pair, found, reach);
            }
            let is_new = found.count > 0 && !self.pairs.all[pair].is_told;
            return if is_new && self.are_circles(two) { self.where_circles_meet(two, found) } else { found };
        };
        let [at_a, at_b] = self.pairs.watched[pair].proxies;
        if let Some([a, b]) = space.balls([at_a, at_b], [two.a, two.b], (self.bodies, self.dt)) {
            return touch_balls(a, b, self.pairs.frozen[pair].count == 0, reach);
        }
        let solid =
            |at: u32, proxy: &'a Proxy| space.solid(at, proxy, outline(proxy), (self.bodies, self.dt));
        let Frozen { count, features, space: FrozenInSpace { normal_z, .. }, .. } = self.pairs.frozen[pair];
        let before = match normal_z {
            _ if count == 0 => Before::Nothing,
            _ if space.was_over([at_a, at_b], features[0]) => Before::Over,
            1.0 | -1.0 => Before::Depth(normal_z),
            _ => Before::Plane,
        };
        let all = &self.proxies.all;
        let (a, b) = (solid(at_a, &all[at_a as usize]), solid(at_b, &all[at_b as usize]));
        let a = space.turning_on(a, two.a, &b, (self.bodies, self.dt));
        let sunk = self.sunk_before(pair, two);
        let limits = Limits::new([reach, self.tuning.speculative], self.is_fixed(two.a), sunk);
        let found = space.touch(a, b, before, limits);
        if self.is_hidden_rim(pair, two, [a, b], &found) { Manifold::apart(0.0) } else { found }
    }

    /// Circles that come together push each other along the line on which their middles lie when they do, which is neither
    /// that of the beginning of the step nor that of its end.
    fn where_circles_meet(&self, two: Two<'_>, found: Manifold) -> Manifold {
        let way = |proxy: &Proxy| {
            let (body, part) = (proxy.body as usize, self.bodies.gravity_parts[proxy.body as usize]);
            let fall = scaled(self.fall, 0.5 * part * self.dt);
            self.bodies
                .hot
                .get(body)
                .map_or([0.0; 2], |hot| sum(fall, scaled([hot.velocity[0], hot.velocity[1]], self.dt)))
        };
        let way = difference(way(two.b), way(two.a));
        let radii = [two.a.shape.radius, two.b.shape.radius];
        circles_meet(two.apart(), way, radii).unwrap_or(found)
    }

    /// The two are further apart than contacts reach.
    fn part(&mut self, pair: usize, room: f32) {
        self.note_parting(pair);
        self.remove_row(pair);
        if self.pairs.all[pair].is_told {
            self.tell(pair, false);
        }
        // Most that part had no contacts: these are not written again.
        if self.pairs.frozen[pair].count > 0 {
            self.pairs.frozen[pair] = Frozen::default();
        }
        let slack = room.clamp(0.0, SEPARATED_PAIR_SLACK * self.tuning.unit);
        self.pairs.watched[pair].tolerance = (slack * self.tuning.motion_scale()) as u32;
    }

    /// The two touch, or nearly do, once they have come together by this approach.
    fn meet(&mut self, pair: usize, two: Two<'_>, found: &Manifold, approach: Approach) {
        let state = self.pairs.all[pair];
        let old = state.home.map(|home| self.rows.lane(state.kind, home));
        let kept = self.kept(pair, two, found);
        let was = self.pairs.frozen[pair].normal;
        self.freeze(pair, two, found);
        self.pairs.frozen[pair].space.apart += approach.depth;
        if !state.responds || state.is_vetoed {
            return;
        }
        let old = old.unwrap_or_default();
        if let Some(is_fast) = self.rolls(pair, two) {
            self.rolling.push(Roll::new(self.pairs.watched[pair].proxies, is_fast));
        }
        let mut lane = self.lane(pair, two);
        carry_friction(&mut lane, &old);
        for (point, approach) in lane.points.iter_mut().zip(approach.points) {
            point.separation += approach;
        }
        for (at, point) in lane.points.iter_mut().enumerate().take(found.count) {
            if let Some(from) = kept[at] {
                (point.impulse, point.held) = (old.points[from].impulse, old.points[from].held);
            }
        }
        self.direct.timing.is_due |= self.is_burden(pair, found.normal) && !self.is_burden(pair, was);
        match state.home {
            Some(home) => self.rows.set_lane(state.kind, home, &lane),
            None => self.add_row(pair, &lane),
        }
    }

    #[inline(always)]
    fn are_circles(&self, two: Two<'_>) -> bool {
        if self.space.is_some() {
            return false;
        }
        let is_circle =
            |proxy: &Proxy| self.bodies.circles.get(proxy.body as usize).is_some_and(|row| row[3] > 0.0);
        is_circle(two.a) && is_circle(two.b)
    }

    pub(super) fn are_two_circles(&self, pair: usize) -> bool {
        self.are_circles(self.two(pair))
    }

    fn is_fixed(&self, proxy: &Proxy) -> bool {
        proxy.body as usize >= self.bodies.first_fixed()
    }
}
