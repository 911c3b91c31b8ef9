//! Where pairs touch, and what of it is kept from step to step.
//!
//! A pair is looked at only when its bodies have moved so far that something can have changed. Then, while the two have
//! hardly moved *against each other* since their contacts were found, normal and anchors stay as they are and only the
//! distances are renewed, exactly; a tall stack would fall if they followed every tremble. Else the contacts are found anew,
//! and take over the impulses of those with the same corners, or, if the corners have changed, of those that were nearest.

use super::bodies::Bodies;
use super::direct::Direct;
use super::manifold::{Manifold, circles_meet, collide};
use super::one_way::{Passage, Ways};
use super::pairs::{BY_ROW, Frozen, FrozenInSpace, Pairs};
use super::proxies::{Mobility, Proxies, Proxy};
use super::rows::{Aside, Home, Kind, Lane, Palette, PointLane, Rows, SpaceLane};
use super::sleep::Sleep;
use super::space::{Before, Held, Space, lands_on, tangents};
use super::tuning::Tuning;
use crate::geom::GeomId;
use crate::geom::surface::{FrictionType, mix_restitution};
use crate::math::plane::{
    Pose, Vector, cross, difference, dot, length, place, rotation, scaled, sum, turn, turn_back,
};

/// Bodies that have turned further than this have their contacts found anew: its cosine.
const LARGEST_TURN: f32 = 0.98;
/// And those on a kinematic one that has: what lies on a turntable turns with it, and its normal must.
const LARGEST_TURN_OF_KINEMATIC: f32 = 0.99998;
/// What is left of the error in separations, as a part of the unit: a normal that stays behind by an angle is wrong by that
/// times the way that one has slid along the other.
const LARGEST_ERROR: f32 = 3e-4;
/// A body that turns further than this in a step, on what does not give way, has its contacts found in every step: it rolls,
/// or topples, and its corners come down one after the other.
const ROLLING: f32 = 0.01;
/// Arms of a contact are turned on by at most so far.
const LARGEST_LEAD: f32 = 0.2;
/// A new point goes on from an old one whose anchor is nearer than this part of the smaller body.
const NEAR: f32 = 0.4;
/// Units after which a pair that is apart is looked at again in any case, so that motion sums cannot wrap unseen.
const LONGEST_SLACK: f32 = 8.0;

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
    pub(super) looks: &'a mut Looks,
}

/// What became of pairs that were looked at.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Looks {
    /// Contacts were found anew, or kept.
    pub(crate) made: usize,
    pub(crate) kept: usize,
}

/// Two geoms begin or cease to touch with one of their pieces, that with the smaller creation number first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Change {
    pub(super) numbers: (u32, u32),
    pub(super) begins: bool,
    pub(super) geoms: (GeomId, GeomId),
}

/// What a pair is made of.
#[derive(Clone, Copy)]
struct Two<'a> {
    a: &'a Proxy,
    b: &'a Proxy,
    pose_a: Pose,
    pose_b: Pose,
}

impl Two<'_> {
    /// B's pose as seen from A.
    fn relative(&self) -> [f32; 4] {
        let (qa, qb) = (rotation(self.pose_a), rotation(self.pose_b));
        let [x, y] = turn_back(qa, self.apart());
        let [c, s] = turn_back(qa, qb);
        [x, y, c, s]
    }

    fn apart(&self) -> Vector {
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
    fn motion(&self, pair: usize) -> u32 {
        let [a, b] = self.pairs.watched[pair].proxies.map(|proxy| self.proxies.motion[proxy as usize]);
        a.wrapping_add(b)
    }

    /// Looks at all pairs that have moved far enough. Answers how many.
    pub(super) fn scan(&mut self) -> usize {
        let mut looked_at = 0;
        for pair in 0..self.pairs.awake {
            let watch = self.pairs.watched[pair];
            let moved = self.motion(pair).wrapping_sub(watch.since);
            if moved >= watch.tolerance && watch.tolerance != BY_ROW {
                looked_at += 1;
                self.look(pair);
            }
        }
        looked_at
    }

    /// Looks at a pair.
    pub(super) fn look(&mut self, pair: usize) {
        let two = self.two(pair);
        let is_known = self.pairs.frozen[pair].count > 0 && self.pairs.watched[pair].tolerance != BY_ROW;
        self.pairs.watched[pair].since = self.motion(pair);
        if is_known && self.may_renew(pair, two) && self.renew(pair, two) {
            self.looks.kept += 1;
            self.note_touch(pair, two);
            return;
        }
        let mut found = self.collide(pair, two, self.tuning.speculative);
        found.keep_deepest(self.most_contacts);
        let is_open = self.proxies.one_way > 0 && self.is_open(pair, two, &found);
        if !found.is_within_reach() {
            self.part(pair, found.gap);
        } else if is_open || self.passes_through(pair, two) {
            self.part(pair, 0.0);
        } else {
            self.looks.made += 1;
            self.meet(pair, two, &found);
            self.note_touch(pair, two);
        }
    }

    /// The ways of the last step.
    fn ways(&self) -> Ways<'_> {
        let Touch { bodies, proxies, pairs, tuning, .. } = self;
        Ways { bodies, proxies, pairs, reach: tuning.speculative, are_gone: true }
    }

    /// Whether one of two, of which one at least is one-way, is not kept out by the other one.
    #[inline(never)]
    fn is_open(&mut self, pair: usize, two: Two<'a>, found: &Manifold) -> bool {
        let known = self.pairs.all[pair].passage;
        if matches!(known, Passage::Closed | Passage::Landed) {
            return false;
        }
        let mut passage = self.ways().settled(pair);
        if passage == Passage::Apart && self.ways().is_above(pair) && self.come_together(two, found) {
            passage = Passage::Landed;
        }
        if passage != known {
            self.pairs.set_passage(self.proxies, pair, passage);
        }
        passage != Passage::Landed
    }

    /// Whether two come together where contacts reach from one to the other.
    fn come_together(&self, two: Two<'_>, found: &Manifold) -> bool {
        found.points[..found.count].iter().any(|&point| {
            let [bx, by] = difference(point, two.apart());
            self.approach(two, found.normal, &[point[0], point[1], bx, by]) < 0.0
        })
    }

    /// What a handler has refused has not landed, unless something else of it is kept out.
    pub(super) fn forget_landing(&mut self, pair: usize) {
        if self.pairs.all[pair].passage == Passage::Landed && !self.ways().is_kept_out(pair) {
            self.pairs.set_passage(self.proxies, pair, Passage::Apart);
        }
    }

    /// Whether one of the two is open for the other one in three axes, which has not landed on it.
    fn passes_through(&self, pair: usize, two: Two<'a>) -> bool {
        let state = &self.pairs.all[pair];
        let Some(space) = self.space.filter(|space| state.responds && space.is_one_way(two.a)) else {
            return false;
        };
        let solid = |at: u32, proxy: &'a Proxy| {
            space.solid(at, proxy, self.proxies.corners.outline(proxy.shape), (self.bodies, self.dt))
        };
        let [at_a, at_b] = self.pairs.watched[pair].proxies;
        state.home.is_none() && !lands_on(solid(at_a, two.a), solid(at_b, two.b), self.tuning.speculative)
    }

    fn collide(&self, pair: usize, two: Two<'_>, reach: f32) -> Manifold {
        let outline = |proxy: &Proxy| self.proxies.corners.outline(proxy.shape);
        let Some(space) = self.space else {
            let found = collide(outline(two.a), outline(two.b), two.pose_a, two.pose_b, reach);
            let is_new = found.count > 0 && !self.pairs.all[pair].is_told;
            return if is_new && self.are_circles(two) { self.where_circles_meet(two, found) } else { found };
        };
        let [at_a, at_b] = self.pairs.watched[pair].proxies;
        let solid =
            |at: u32, proxy: &'a Proxy| space.solid(at, proxy, outline(proxy), (self.bodies, self.dt));
        let Frozen { count, normal, space: FrozenInSpace { normal_z, .. }, .. } = self.pairs.frozen[pair];
        let before = match normal_z {
            _ if count == 0 => Before::Nothing,
            _ if space.was_over([at_a, at_b], normal) => Before::Over,
            1.0 | -1.0 => Before::Depth(normal_z),
            _ => Before::Plane,
        };
        let all = &self.proxies.all;
        space.touch(solid(at_a, &all[at_a as usize]), solid(at_b, &all[at_b as usize]), before, reach)
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

    /// Whether contacts may stay what they were if the two have not moved much: not those of circles and balls, on which they
    /// wander, and not those of outlines that have passed each other along the depth axis.
    fn may_renew(&self, pair: usize, two: Two<'_>) -> bool {
        let Some(space) = self.space else { return !self.are_circles(two) };
        let (kind, proxies) = (self.pairs.all[pair].kind, self.pairs.watched[pair].proxies);
        // What is upright may have come out from above or beside the other one.
        if proxies.iter().any(|&proxy| space.is_upright(proxy)) {
            return false;
        }
        let is_in_plane = self.pairs.frozen[pair].space.normal_z.abs() < 1.0;
        kind.has_two_points && (!is_in_plane || space.are_beside(proxies, space.apart(two.a, two.b)))
    }

    /// The two touch once their outlines do or push each other, or will in this step: contacts that only reach ahead are not
    /// told. Until then the pair is looked at in every step. They cease to when nothing is near any more; where nothing
    /// pushes, when the outlines part.
    fn note_touch(&mut self, pair: usize, two: Two<'_>) {
        let state = self.pairs.all[pair];
        let stays = (state.is_told && state.responds) || self.touches_now(pair, two);
        if stays != state.is_told {
            self.tell(pair, stays);
        }
        self.pairs.watched[pair].tolerance = if !(stays && state.responds) {
            0
        } else if state.home.is_some() && self.are_circles(two) {
            BY_ROW
        } else {
            (self.tuning.checked * self.tuning.motion_scale()) as u32
        };
    }

    fn touches_now(&self, pair: usize, two: Two<'_>) -> bool {
        let state = self.pairs.all[pair];
        let frozen = &self.pairs.frozen[pair];
        let count = frozen.count as usize;
        let along_depth = self.approach_along_depth(two, frozen.space.normal_z);
        match state.home {
            Some(home) => self.rows.lane(state.kind, home).points[..count].iter().zip(&frozen.anchors).any(
                |(point, anchors)| {
                    let in_plane = self.approach(two, frozen.normal, anchors);
                    let gap = point.separation + self.dt * (in_plane + along_depth);
                    point.separation <= 0.0 || point.impulse > 0.0 || gap <= 0.0
                },
            ),
            None => frozen.separations[..count].iter().any(|&separation| separation <= 0.0),
        }
    }

    /// Velocity along the normal with which the two will come together in this step, if nothing but gravity changes it.
    #[inline(always)]
    fn approach(&self, two: Two<'_>, normal: Vector, &[ax, ay, bx, by]: &[f32; 4]) -> f32 {
        let velocity = |proxy: &Proxy, arm: Vector| {
            let Some(hot) = self.bodies.hot.get(proxy.body as usize) else { return [0.0; 2] };
            let [x, y, spin, _] = hot.velocity;
            let spin = if self.turns_upright(proxy) { 0.0 } else { spin };
            let part = self.bodies.gravity_parts[proxy.body as usize];
            sum(self.fall.map(|fall| fall * part), [x - spin * arm[1], y + spin * arm[0]])
        };
        dot(difference(velocity(two.b, [bx, by]), velocity(two.a, [ax, ay])), normal)
    }

    /// Whether what something turns about is upright.
    fn turns_upright(&self, proxy: &Proxy) -> bool {
        proxy.mobility == Mobility::Kinematic && self.space.is_some_and(|space| space.turns(proxy))
    }

    fn approach_along_depth(&self, two: Two<'_>, normal_z: f32) -> f32 {
        if normal_z == 0.0 {
            return 0.0;
        }
        let velocity =
            |proxy: &Proxy| self.bodies.hot.get(proxy.body as usize).map_or(0.0, |hot| hot.velocity[3]);
        normal_z * (velocity(two.b) - velocity(two.a))
    }

    pub(super) fn tell(&mut self, pair: usize, begins: bool) {
        self.pairs.set_told(pair, begins);
        let [a, b] = self.pairs.watched[pair].proxies.map(|proxy| &self.proxies.all[proxy as usize]);
        let (first, second) = if a.number < b.number { (a, b) } else { (b, a) };
        let (numbers, geoms) = ((first.number, second.number), (first.geom, second.geom));
        self.changes.push(Change { numbers, begins, geoms });
    }

    /// The two are further apart than contacts reach.
    fn part(&mut self, pair: usize, gap: f32) {
        self.remove_row(pair);
        if self.pairs.all[pair].is_told {
            self.tell(pair, false);
        }
        self.pairs.frozen[pair] = Frozen::default();
        let slack = (gap - self.tuning.speculative).clamp(0.0, LONGEST_SLACK * self.tuning.unit);
        self.pairs.watched[pair].tolerance = (slack * self.tuning.motion_scale()) as u32;
    }

    /// If the two have hardly moved against each other, normal and anchors stay, and separations are renewed.
    fn renew(&mut self, pair: usize, two: Two<'_>) -> bool {
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
        let is_same = turned_a[0] > if is_kinematic { LARGEST_TURN_OF_KINEMATIC } else { LARGEST_TURN }
            && turned_b[0] > LARGEST_TURN
            && self.turn_on_fixed(pair, two).abs() <= ROLLING
            && moved < self.tuning.frozen - self.tuning.checked
            && moved * turned_a[1].abs().max(turned_b[1].abs()) < LARGEST_ERROR * self.tuning.unit;
        if !is_same {
            return false;
        }
        let mut separations = frozen.separations;
        let FrozenInSpace { normal_z, apart: apart_then, .. } = frozen.space;
        let along_depth = self.space.map_or(0.0, |space| normal_z * (space.apart(two.a, two.b) - apart_then));
        for (separation, &[ax, ay, bx, by]) in separations.iter_mut().zip(&frozen.anchors) {
            let apart = sum(two.apart(), difference(turn(turned_b, [bx, by]), turn(turned_a, [ax, ay])));
            *separation += dot(apart, frozen.normal) + along_depth;
        }
        match self.pairs.all[pair].home {
            Some(home) => self.rows.set_separations(self.pairs.all[pair].kind, home, separations),
            None => return false,
        }
        true
    }

    /// How far a polygon that lies on something that does not give way turns in this step, if nothing changes its spin.
    fn turn_on_fixed(&self, pair: usize, two: Two<'_>) -> f32 {
        let Kind { has_two_points, is_fixed, .. } = self.pairs.all[pair].kind;
        if has_two_points && is_fixed {
            self.bodies.hot[two.b.body as usize].velocity[2] * self.dt
        } else {
            0.0
        }
    }

    fn is_fixed(&self, proxy: &Proxy) -> bool {
        proxy.body as usize >= self.bodies.first_fixed()
    }

    /// The two touch, or nearly do.
    fn meet(&mut self, pair: usize, two: Two<'_>, found: &Manifold) {
        let state = self.pairs.all[pair];
        let old = state.home.map(|home| self.rows.lane(state.kind, home));
        let kept = self.kept(pair, two, found);
        self.freeze(pair, two, found);
        if !state.responds || state.is_vetoed {
            return;
        }
        let old = old.unwrap_or_default();
        let mut lane = self.lane(pair, two);
        carry_friction(&mut lane, &old);
        for (at, point) in lane.points.iter_mut().enumerate().take(found.count) {
            if let Some(from) = kept[at] {
                (point.impulse, point.held) = (old.points[from].impulse, old.points[from].held);
            }
        }
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

    fn freeze(&mut self, pair: usize, two: Two<'_>, found: &Manifold) {
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
            lead: lead.clamp(-LARGEST_LEAD, LARGEST_LEAD),
            space: FrozenInSpace {
                normal_z: found.normal_z,
                apart: self.space.map_or(0.0, |space| space.apart(two.a, two.b)),
                spread: found.spread,
                depths: found.depths,
            },
        };
    }

    /// Which old point each new one goes on from: the one with its corners, else the nearest that is left over.
    fn kept(&self, pair: usize, two: Two<'_>, found: &Manifold) -> [Option<usize>; 2] {
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
            let mut nearest = (NEAR * size) * (NEAR * size);
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

    /// How far an old anchor is from a new one, on the body on which it is nearer.
    fn squared_distance(&self, old: &Frozen, point: usize, two: Two<'_>, new: Vector) -> f32 {
        let [ax, ay, bx, by] = old.anchors[point];
        let [ca, sa, cb, sb] = old.turns;
        let new_b = difference(new, two.apart());
        let on_a = difference(turn_back([ca, sa], [ax, ay]), turn_back(rotation(two.pose_a), new));
        let on_b = difference(turn_back([cb, sb], [bx, by]), turn_back(rotation(two.pose_b), new_b));
        let (a, b) = (dot(on_a, on_a), dot(on_b, on_b));
        if a < b { a } else { b }
    }

    /// The row of a pair as its contacts were found, without impulses.
    fn lane(&self, pair: usize, two: Two<'_>) -> Lane {
        let frozen = &self.pairs.frozen[pair];
        let is_fixed = self.is_fixed(two.a);
        let [[mass_a, inertia_a], [mass_b, inertia_b]] =
            [two.a, two.b].map(|proxy| self.bodies.inverses[proxy.body as usize]);
        let normal = frozen.normal;
        let weight = |arm_a: f32, arm_b: f32| {
            let inverse = mass_a + mass_b + inertia_a * arm_a * arm_a + inertia_b * arm_b * arm_b;
            if inverse > 0.0 { 1.0 / inverse } else { 0.0 }
        };
        let mut points = [PointLane { separation: self.tuning.unit, ..PointLane::default() }; 2];
        let (mut tangent_a, mut tangent_b) = (0.0, 0.0);
        let lead = [1.0 - 0.5 * frozen.lead * frozen.lead, frozen.lead];
        for (at, point) in points.iter_mut().enumerate().take(frozen.count as usize) {
            let [ax, ay, bx, by] = frozen.anchors[at];
            // What is round about a corner does not turn with it.
            let round = scaled(normal, two.b.shape.radius);
            let [bx, by] = difference(turn(lead, sum([bx, by], round)), round);
            let (arm_a, arm_b) = (cross([ax, ay], normal), cross([bx, by], normal));
            tangent_a -= dot([ax, ay], normal);
            tangent_b -= dot([bx, by], normal);
            *point = PointLane {
                arm_a,
                arm_b,
                mass: weight(arm_a, arm_b),
                separation: frozen.separations[at],
                ..PointLane::default()
            };
        }
        let parts = 1.0 / frozen.count as f32;
        let tangent_arms = [tangent_a * parts, tangent_b * parts];
        let lane = Lane {
            a: if is_fixed { 0 } else { two.a.body },
            b: two.b.body,
            pair: pair as u32,
            normal,
            inverse_masses: [mass_a, mass_b],
            inverse_inertias: [inertia_a, inertia_b],
            // Of numbers that are too great for it the mix is none.
            friction: self.friction.mix(two.a.friction, two.b.friction).min(f32::MAX),
            tangent_arms,
            tangent_mass: weight(tangent_arms[0], tangent_arms[1]),
            tangent_impulse: 0.0,
            tangent_speed: belt_speed(two.a, normal, frozen.anchors[0]).clamp(f32::MIN, f32::MAX),
            restitution: mix_restitution(two.a.restitution, two.b.restitution),
            points,
            space: SpaceLane::default(),
        };
        match &self.space {
            None => lane,
            Some(space) => self.lane_in_space(space, pair, two, lane),
        }
    }

    /// The same in three axes.
    fn lane_in_space(&self, space: &Space, pair: usize, two: Two<'_>, lane: Lane) -> Lane {
        let Frozen {
            normal: [x, y],
            count,
            anchors,
            space: FrozenInSpace { normal_z, spread, depths, .. },
            ..
        } = self.pairs.frozen[pair];
        let (tangent, [ux, uy, uz]) = tangents([x, y, normal_z]);
        let points = &anchors[..count as usize];
        let arms = |along: Vector| {
            let sum = points.iter().fold([0.0; 2], |[of_a, of_b], &[ax, ay, bx, by]| {
                [of_a + cross([ax, ay], along), of_b + cross([bx, by], along)]
            });
            sum.map(|arm| arm / count as f32)
        };
        let (mut points_of, mut tangent_arms, mut across_arms) = (lane.points, arms(tangent), arms([ux, uy]));
        if self.turns_upright(two.a) {
            // About the upright axis: at r a turn has the velocity (-r.z, 0, r.x).
            let arm = |at: usize, [x, _, z]: [f32; 3]| anchors[at][0] * z - depths[at] * x;
            let mean = |axis| (0..count as usize).map(|at| arm(at, axis)).sum::<f32>() / count as f32;
            for (at, point) in points_of.iter_mut().enumerate().take(count as usize) {
                point.arm_a = arm(at, [x, y, normal_z]);
            }
            tangent_arms[0] = mean([tangent[0], tangent[1], 0.0]);
            across_arms[0] = mean([ux, uy, uz]);
        }
        let [at_a, at_b] = self.pairs.watched[pair].proxies;
        let [friction, restitution] = space.surface([at_a, at_b], [two.a, two.b], self.friction);
        Lane {
            friction,
            restitution,
            tangent_arms,
            points: points_of,
            tangent_speed: belt_speed(two.a, [-tangent[1], tangent[0]], anchors[0]).clamp(f32::MIN, f32::MAX),
            space: SpaceLane {
                normal_z,
                across_arms,
                radii: [space.rolling_radius(at_a, two.a), space.rolling_radius(at_b, two.b)],
                across_speed: (belt_speed(two.a, [-uy, ux], anchors[0]) + uz * two.a.surface_velocity[3])
                    .clamp(f32::MIN, f32::MAX),
                spread,
                ..SpaceLane::default()
            },
            ..lane
        }
    }

    /// Friction, restitution and tangent speed of a pair without a handler.
    pub(super) fn surface(&self, pair: usize) -> [f32; 3] {
        let Lane { friction, restitution, tangent_speed, .. } = self.lane(pair, self.two(pair));
        [friction, restitution, tangent_speed]
    }

    /// The surfaces of a row are again what they are without a handler.
    pub(super) fn renew_surface(&mut self, pair: usize) {
        let state = self.pairs.all[pair];
        let Some(home) = state.home else { return };
        let [friction, restitution, tangent_speed] = self.surface(pair);
        let lane = Lane { friction, restitution, tangent_speed, ..self.rows.lane(state.kind, home) };
        self.rows.set_lane(state.kind, home, &lane);
    }

    fn add_row(&mut self, pair: usize, lane: &Lane) {
        let kind = self.pairs.all[pair].kind;
        let free = self.palette.free(kind, [lane.a, lane.b]);
        let colour = self.rows.choose(kind, free);
        self.palette.mark(kind, [lane.a, lane.b], colour, true);
        self.direct.note([lane.a, lane.b]);
        self.pairs.all[pair].home = Some(self.rows.push(kind, colour, lane));
        if [lane.a, lane.b].into_iter().any(|body| self.sleep.is_asleep(body as usize)) {
            self.sleep.note_touch(pair);
        }
    }

    /// Takes the row of a pair out, if it has one.
    pub(super) fn remove_row(&mut self, pair: usize) {
        let kind = self.pairs.all[pair].kind;
        let Some(home) = self.pairs.all[pair].home.take() else { return };
        let Lane { a, b, .. } = self.rows.lane(kind, home);
        let colour = self.rows.aside(home).map_or(home.colour, |row| row.colour);
        self.palette.mark(kind, [a, b], colour, false);
        self.direct.note([a, b]);
        self.rows.remove(kind, home);
        self.follow_rows();
    }

    /// Pairs learn where their rows are that have moved.
    fn follow_rows(&mut self) {
        for (pair, home) in self.rows.take_moved() {
            self.pairs.all[pair as usize].home = Some(home);
        }
    }

    /// Takes a pair out.
    pub(super) fn remove_pair(&mut self, pair: usize) {
        if pair >= self.pairs.awake && self.pairs.all[pair].home.is_some() {
            let bodies = self.pairs.watched[pair].proxies.map(|proxy| self.proxies.all[proxy as usize].body);
            bodies.into_iter().for_each(|body| self.sleep.note_waking(body as usize));
        }
        if self.pairs.all[pair].is_told {
            self.tell(pair, false);
        }
        self.forget_pair(pair);
    }

    /// Takes a pair out, one side of which may have gone: nobody is told.
    pub(super) fn forget_pair(&mut self, pair: usize) {
        self.remove_row(pair);
        self.pairs.set_told(pair, false);
        let at = if pair < self.pairs.awake { self.lay_down(pair) } else { pair };
        self.swap_pairs(at, self.pairs.len() - 1);
        self.pairs.pop();
    }

    /// Two pairs change numbers, and their rows know.
    fn swap_pairs(&mut self, one: usize, other: usize) {
        if one == other {
            return;
        }
        self.pairs.swap(one, other);
        for pair in [one, other] {
            if let Some(home) = self.pairs.all[pair].home {
                self.rows.set_pair(self.pairs.all[pair].kind, home, pair as u32);
            }
        }
    }

    /// A pair is among those that may change from now on. Answers its number then.
    pub(super) fn take_up(&mut self, pair: usize) -> usize {
        let at = self.pairs.awake;
        self.swap_pairs(pair, at);
        self.pairs.awake += 1;
        at
    }

    /// A pair is among those of bodies that sleep from now on. Answers its number then.
    pub(super) fn lay_down(&mut self, pair: usize) -> usize {
        self.pairs.awake -= 1;
        self.swap_pairs(pair, self.pairs.awake);
        self.pairs.awake
    }

    /// Two circles, whose row has followed them until now, are known as they lie.
    fn freeze_circles(&mut self, pair: usize, home: Home) {
        let two = self.two(pair);
        let found = self.collide(pair, two, f32::MAX);
        self.freeze(pair, two, &found);
        let kind = self.pairs.all[pair].kind;
        let now = self.lane(pair, two);
        let mut lane = self.rows.lane(kind, home);
        (lane.normal, lane.tangent_arms, lane.tangent_mass) =
            (now.normal, now.tangent_arms, now.tangent_mass);
        for (point, now) in lane.points.iter_mut().zip(&now.points) {
            (point.arm_a, point.arm_b, point.separation) = (now.arm_a, now.arm_b, now.separation);
        }
        self.rows.set_lane(kind, home, &lane);
    }

    /// The row of a pair falls asleep, with impulses of substeps of this length; or wakes.
    pub(super) fn move_row(&mut self, pair: usize, falls_asleep: bool, h: f32) {
        let kind = self.pairs.all[pair].kind;
        let Some(home) = self.pairs.all[pair].home else { return };
        if falls_asleep && self.pairs.watched[pair].tolerance == BY_ROW && self.rows.asleep(home).is_none() {
            self.freeze_circles(pair, home);
        }
        let moved = if falls_asleep {
            self.rows.put_aside(kind, home, false, h)
        } else {
            self.rows.take_up(kind, home, h)
        };
        // What wakes may be solved as a whole again, and of what falls asleep nothing is.
        self.direct.timing.is_due |= moved != home;
        self.settle(pair, moved);
    }

    /// The row of a pair is solved with its island from now on, or by the passes.
    pub(super) fn hand_over(&mut self, pair: usize, is_direct: bool, h: f32) {
        let kind = self.pairs.all[pair].kind;
        let Some(home) = self.pairs.all[pair].home else { return };
        let moved = if is_direct {
            self.rows.put_aside(kind, home, true, h)
        } else {
            self.rows.take_up(kind, home, h)
        };
        self.settle(pair, moved);
    }

    /// A row has moved home, and others with it.
    fn settle(&mut self, pair: usize, home: Home) {
        self.pairs.all[pair].home = Some(home);
        self.follow_rows();
    }

    /// A row as it was saved.
    pub(super) fn restore_row(
        &mut self,
        pair: usize,
        colour: u32,
        aside: Option<(f32, Option<[f64; 3]>)>,
        set: impl FnOnce(&mut Lane),
    ) {
        let mut lane = self.lane(pair, self.two(pair));
        set(&mut lane);
        let kind = self.pairs.all[pair].kind;
        let colour = self.palette.again(kind, [lane.a, lane.b], colour);
        self.palette.mark(kind, [lane.a, lane.b], colour, true);
        // A damaged save may say that what is awake sleeps.
        let is_still = |&body: &u32| {
            body == 0 || self.sleep.is_asleep(body as usize) || self.bodies.is_kinematic(body as usize)
        };
        let may_be =
            |&(_, exact): &(f32, Option<[f64; 3]>)| exact.is_some() || [lane.a, lane.b].iter().all(is_still);
        let home: Home = match aside.filter(may_be) {
            Some((h, exact)) => {
                let row = Aside { lane, colour, h, exact: exact.unwrap_or_default() };
                self.rows.push_aside(row, exact.is_some())
            }
            None => {
                self.sleep.note_waking(lane.a as usize);
                self.sleep.note_waking(lane.b as usize);
                self.rows.push(kind, colour, &lane)
            }
        };
        self.pairs.all[pair].home = Some(home);
    }
}

/// Friction that was found before goes on, along tangents that may have turned.
fn carry_friction(lane: &mut Lane, old: &Lane) {
    lane.tangent_impulse = old.tangent_impulse;
    (lane.space.twist_impulse, lane.space.totals) = (old.space.twist_impulse, old.space.totals);
    let (along, across) = (old.tangent_impulse, old.space.across_impulse);
    let is_same = lane.space.normal_z == old.space.normal_z && lane.normal == old.normal;
    if across == 0.0 && (is_same || lane.space.normal_z == 0.0) {
        return;
    }
    let of = |lane: &Lane| tangents([lane.normal[0], lane.normal[1], lane.space.normal_z]);
    let (([tx, ty], [ux, uy, uz]), (tangent, second)) = (of(old), of(lane));
    let [x, y, z] = [along * tx + across * ux, along * ty + across * uy, across * uz];
    lane.tangent_impulse = dot([x, y], tangent);
    lane.space.across_impulse = dot([x, y], [second[0], second[1]]) + z * second[2];
}

/// Speed of B against A along the tangent (normal y, -normal x) that a surface moving under it aims at.
fn belt_speed(a: &Proxy, normal: Vector, [ax, ay, ..]: [f32; 4]) -> f32 {
    let [x, y, spin, _] = a.surface_velocity;
    let at = [x - spin * ay, y + spin * ax];
    dot(at, [normal[1], -normal[0]])
}
