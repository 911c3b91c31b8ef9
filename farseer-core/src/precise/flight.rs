//! Nothing passes through what stands still, however fast it is; and a bullet through nothing.
//!
//! A body that goes further in a step than it is thick could be beyond a wall before anybody has noticed. Its way is cut where
//! it first is in something by a part of the reach of contacts, and its velocity is the one that it has there; the next step
//! finds them in touch. Where it only grazes nothing is cut.
//!
//! The time of the first touch is found by conservative advancement (B. Mirtich, "Impulse-based Dynamic Simulation of
//! Rigid Body Systems", 1996, section 2.3): along an axis that separates the two, they come together no faster than by their
//! velocity along it and what their turning can do at their reach, so that so far nothing can happen; and if they do not come
//! together along it, never.

use super::Precise;
use super::grid::Box2;
use super::one_way::{Passage, Ways};
use super::outline::Outline;
use super::proxies::{Mobility, Proxy};
use super::tuning::Step;
use crate::geom::GeomId;
use crate::math::plane::{Pose, Vector, difference, dot, length, place, rotation, scaled, sum, turn};
use crate::math::scalar;
use crate::storage::order::{joined, sort_by_number};

/// How far a body may be in something, and how exactly that is found, as parts of the reach of contacts.
const DEEP: f32 = 0.5;
pub(super) const EXACT: f32 = 0.1;
/// After so many advances a body stops short of what it has not reached.
const ADVANCES: usize = 32;

/// A convex piece on its way through a step.
#[derive(Clone, Copy)]
pub(super) struct Flyer<'a> {
    pub(super) outline: Outline<'a>,
    pub(super) pose: Pose,
    /// Way and angle of the whole step.
    pub(super) path: [f32; 4],
}

impl Flyer<'_> {
    /// Where it is after a part of the step.
    pub(super) fn at(&self, part: f32) -> Pose {
        let ([x, y, c, s], [dx, dy, turned, _]) = (self.pose, self.path);
        if turned == 0.0 {
            return [x + part * dx, y + part * dy, c, s];
        }
        let (sine, cosine) = scalar::sin_cos(part * turned);
        let [c, s] = turn([cosine, sine], [c, s]);
        [x + part * dx, y + part * dy, c, s]
    }

    /// Its corners, or the centre of a circle, as it lies there.
    fn corners(&self, pose: Pose) -> impl Iterator<Item = Vector> + '_ {
        let Outline { shape, points, .. } = &self.outline;
        let points = if points.is_empty() { std::slice::from_ref(&shape.centre) } else { points };
        points.iter().map(move |&point| sum(place(pose), turn(rotation(pose), point)))
    }

    /// How far it reaches in a direction.
    pub(super) fn support(&self, pose: Pose, direction: Vector) -> f32 {
        self.farthest(pose, direction).0 + self.outline.shape.radius
    }

    /// How far its corners reach in a direction, and which of them does.
    fn farthest(&self, pose: Pose, direction: Vector) -> (f32, Vector) {
        let along = self.corners(pose).map(|corner| (dot(corner, direction), corner));
        along.fold((f32::MIN, [0.0; 2]), |most, one| if one.0 > most.0 { one } else { most })
    }

    /// The middle of the piece.
    fn centre(&self, pose: Pose) -> Vector {
        sum(place(pose), turn(rotation(pose), self.outline.shape.centre))
    }
}

/// Two pieces.
pub(super) struct Two<'a> {
    pub(super) a: Flyer<'a>,
    pub(super) b: Flyer<'a>,
}

impl Two<'_> {
    /// Distance of the two along the axis that separates them best, negative if they overlap; and that axis, from A to B. Along
    /// none are they farther apart than any two of their corners: most axes are passed over for those that were nearest last.
    pub(super) fn separation(&self, part: f32) -> (f32, Vector) {
        let poses = [self.a.at(part), self.b.at(part)];
        let radii = [self.a.outline.shape.radius, self.b.outline.shape.radius];
        let apart = |axis: Vector| {
            let (of_a, near_a) = self.a.farthest(poses[0], axis);
            let (of_b, near_b) = self.b.farthest(poses[1], scaled(axis, -1.0));
            (-(of_b + radii[1]) - (of_a + radii[0]), [near_a, near_b])
        };
        let at_most = |[near_a, near_b]: [Vector; 2], axis: Vector| {
            -(dot(near_b, scaled(axis, -1.0)) + radii[1]) - (dot(near_a, axis) + radii[0])
        };

        // As far as they are apart along the axis that promises most, they are.
        let mut nearest = apart(difference(self.b.centre(poses[1]), self.a.centre(poses[0]))).1;
        let mut likely = (f32::MIN, [0.0, 1.0]);
        self.for_each_axis(poses, &mut |axis| {
            let most = at_most(nearest, axis);
            if most > likely.0 {
                likely = (most, axis);
            }
        });
        let (least, of_likely) = apart(likely.1);
        nearest = of_likely;
        let mut best = (f32::MIN, [0.0, 1.0]);
        self.for_each_axis(poses, &mut |axis| {
            let most = at_most(nearest, axis);
            if most < least || most <= best.0 {
                return;
            }
            let (apart, of_axis) = apart(axis);
            nearest = of_axis;
            if apart > best.0 {
                best = (apart, axis);
            }
        });
        best
    }

    /// The axes along which the two may be farthest apart: of their sides, and if one is round, between corners.
    fn for_each_axis(&self, [pose_a, pose_b]: [Pose; 2], consider: &mut dyn FnMut(Vector)) {
        for &normal in self.a.outline.normals {
            consider(turn(rotation(pose_a), normal));
        }
        for &normal in self.b.outline.normals {
            consider(scaled(turn(rotation(pose_b), normal), -1.0));
        }
        if self.a.outline.shape.radius > 0.0 || self.b.outline.shape.radius > 0.0 {
            for from in self.a.corners(pose_a) {
                for to in self.b.corners(pose_b) {
                    let way = difference(to, from);
                    let distance = length(way);
                    if distance > 0.0 {
                        consider(scaled(way, 1.0 / distance));
                    }
                }
            }
        }
    }

    /// Distance after a part of the step, and how fast it can become less, in lengths per step.
    pub(super) fn coming(&self, part: f32) -> (f32, f32) {
        let way = difference(place(self.b.path), place(self.a.path));
        let turning = |flyer: &Flyer<'_>| flyer.path[2].abs() * flyer.outline.shape.reach;
        let (apart, axis) = self.separation(part);
        (apart, turning(&self.a) + turning(&self.b) - dot(way, axis))
    }

    /// Whether A is an edge of a chain that B comes from behind.
    fn is_free(&self) -> bool {
        let [normal, _] = self.a.outline.normals else { return false };
        if self.a.outline.seams().is_empty() {
            return false;
        }
        let normal = turn(rotation(self.a.pose), *normal);
        let on_edge = sum(place(self.a.pose), turn(rotation(self.a.pose), self.a.outline.points[0]));
        let centre = self.b.centre(self.b.pose);
        let way = difference(place(self.b.path), place(self.a.path));
        dot(difference(centre, on_edge), normal) < 0.0 || (dot(way, normal) >= 0.0 && self.b.path[2] == 0.0)
    }
}

/// After which part of the step two are in each other by `deep`, or by that much deeper than when it began; `None` if they
/// never are. Asked for a part, the two tell how far they are apart, and how fast that can become less.
pub(super) fn meet(deep: f32, exact: f32, coming: impl Fn(f32) -> (f32, f32)) -> Option<f32> {
    let (mut part, mut allowed) = (0.0, None);
    for _ in 0..ADVANCES {
        let (apart, closing) = coming(part);
        let room = apart + *allowed.get_or_insert(if apart < 0.0 { deep - apart } else { deep });
        if room <= exact {
            return Some(part);
        }
        if closing <= 0.0 {
            return None;
        }
        part += room / closing;
        if part >= 1.0 || part.is_nan() {
            return None;
        }
    }
    Some(part)
}

/// Whether the path of a body is longer than it is thick, and still a number that is of use.
fn is_fast([x, y, turned, z]: [f32; 4], reach: f32, core: f32) -> bool {
    let way = x.abs() + y.abs() + z.abs() + reach * turned.abs();
    way > core && way < 1e18
}

fn contains(outer: &Box2, inner: &Box2) -> bool {
    outer[0] <= inner[0] && outer[1] <= inner[1] && outer[2] >= inner[2] && outer[3] >= inner[3]
}

/// The box around two boxes.
fn both(one: &Box2, other: &Box2) -> Box2 {
    let least = |axis: usize| if one[axis] < other[axis] { one[axis] } else { other[axis] };
    let most = |axis: usize| if one[axis] > other[axis] { one[axis] } else { other[axis] };
    [least(0), least(1), most(2), most(3)]
}

impl Precise {
    /// Notes who goes further in this step than it is thick, and widens the bounds of these by their way: pairs are to be
    /// looked for. Answers whether somebody does.
    pub(crate) fn find_fast(&mut self) -> bool {
        self.fast.clear();
        self.flown.clear();
        // In three axes what overlaps does not tell on which way it came in: nothing is to get far into what stands still.
        let most = if self.space.is_some() { self.tuning.speculative } else { f32::MAX };
        let Precise { bodies, sleep, fast, .. } = self;
        for run in &sleep.bodies {
            let (paths, reaches) = (&bodies.path[run.clone()], &bodies.reaches[run.clone()]);
            let of = run.clone().zip(paths).zip(reaches).zip(&bodies.cores[run.clone()]);
            for (((number, &path), &reach), &core) in of {
                let core = if core < most { core } else { most };
                let is_body = || bodies.ids[number].is_some() && !bodies.is_kinematic(number);
                if is_fast(path, reach, core) && !sleep.is_asleep(number) && is_body() {
                    fast.push((number as u32, 1.0, None));
                }
            }
        }
        for at in 0..self.fast.len() {
            let number = self.fast[at].0 as usize;
            let mut proxies = std::mem::take(&mut self.lost);
            proxies.extend(self.proxies.of(number));
            proxies.drain(..).for_each(|proxy| self.cover_way(proxy, self.bodies.path[number]));
            self.lost = proxies;
        }
        !self.fast.is_empty()
    }

    /// Bounds are to hold what a proxy covers on its way.
    fn cover_way(&mut self, proxy: u32, path: [f32; 4]) {
        let swept = self.swept(proxy, path);
        if self.space.is_some() {
            return self.cover_way_in_space(proxy, &swept, path[3]);
        }
        let bounds = self.proxies.bounds[proxy as usize];
        if !contains(&bounds, &swept) {
            self.proxies.bounds[proxy as usize] = both(&bounds, &swept);
            self.grid.set(proxy, &self.proxies.bounds[proxy as usize]);
            self.widened.push(proxy);
        }
    }

    /// In three axes many are fast, by little: bounds that have become too small are new ones, good for some steps.
    fn cover_way_in_space(&mut self, proxy: u32, swept: &Box2, way: f32) {
        if self.holds_way(proxy, swept, way) {
            return;
        }
        self.widen(proxy);
        let body = self.proxies.all[proxy as usize].body;
        let bounds = both(&self.proxies.bounds[proxy as usize], swept);
        self.proxies.bounds[proxy as usize] = bounds;
        if let Some(space) = self.space.as_deref_mut() {
            let depths = space.swept(proxy, body, way, self.tuning.speculative);
            space.set_depths(proxy, space.depths(proxy as usize).with(depths));
            self.grid.set(proxy, &space.cells(proxy, &bounds));
        }
        self.widened.push(proxy);
    }

    /// Whether bounds hold what a proxy covers on its way, in three axes.
    pub(super) fn holds_way(&self, proxy: u32, swept: &Box2, way: f32) -> bool {
        let body = self.proxies.all[proxy as usize].body;
        self.space.as_ref().is_none_or(|space| {
            let depths = space.swept(proxy, body, way, self.tuning.speculative);
            contains(&self.proxies.bounds[proxy as usize], swept)
                && space.depths(proxy as usize).contains(depths)
        })
    }

    /// What a proxy covers on its way through the step, at least: in the plane with all that it can turn to.
    pub(super) fn swept(&self, proxy: u32, [dx, dy, turned, _]: [f32; 4]) -> Box2 {
        let Proxy { body, shape, .. } = self.proxies.all[proxy as usize];
        let [x, y, to_x, to_y] = if self.space.is_some() {
            let turning = shape.reach * turned.abs().min(2.0);
            let [x, y, to_x, to_y] = self.proxies.tight(proxy as usize, &self.bodies, &self.tuning);
            [x - turning, y - turning, to_x + turning, to_y + turning]
        } else {
            let around = self.bodies.reaches[body as usize] + self.tuning.speculative;
            let [x, y, ..] = self.bodies.poses[body as usize];
            [x - around, y - around, x + around, y + around]
        };
        let low = |from: f32, way: f32| if way < 0.0 { from + way } else { from };
        let high = |from: f32, way: f32| if way < 0.0 { from } else { from + way };
        [low(x, dx), low(y, dy), high(to_x, dx), high(to_y, dy)]
    }

    /// The new pairs there may be of those who are fast. None goes: that is told at the beginning of a step.
    pub(crate) fn find_pairs_of_fast(&mut self) -> usize {
        let mut widened = std::mem::take(&mut self.widened);
        let found = self.search(&widened);
        widened.clear();
        self.widened = widened;
        found
    }

    /// Cuts the ways of those who are fast where they meet something.
    pub(crate) fn stop_fast(&mut self, step: &Step) {
        let mut fast = std::mem::take(&mut self.fast);
        for (number, part, met) in &mut fast {
            (*part, *met) = self.first_meeting(*number as usize);
        }
        self.note_flown(&fast);
        for &(number, part, met) in fast.iter().filter(|&&(_, part, _)| part < 1.0) {
            let number = number as usize;
            let carried = met.map_or([0.0; 4], |pair| self.carried(number, part, pair));
            self.bodies.path[number] = self.bodies.path[number].map(|way| way * part);
            self.bodies.path[number].iter_mut().zip(carried).for_each(|(way, carried)| *way += carried);
            // Forces have acted for so long only.
            let undone = (1.0 - part) * step.substeps as f32;
            for (velocity, push) in self.bodies.hot[number].velocity.iter_mut().zip(self.bodies.push[number])
            {
                *velocity -= undone * push;
            }
        }
        self.fast = fast;
    }

    /// The way on which what a body meets after a part of the step takes it along for the rest: a box that moves.
    fn carried(&self, body: usize, part: f32, pair: usize) -> [f32; 4] {
        let Some(space) = &self.space else { return [0.0; 4] };
        let ([x, ..], [way, _, _, way_along_depth]) = (self.bodies.poses[body], self.bodies.path[body]);
        let at = [x + part * way, space.places[body] + part * way_along_depth];
        let first = &self.proxies.all[self.pairs.watched[pair].proxies[0] as usize];
        space.velocity_at(first, at, &self.bodies).map(|velocity| velocity * (1.0 - part) * self.dt)
    }

    /// After which part of the step a body meets something that stops it, and in which pair; after the whole step if in none.
    fn first_meeting(&self, body: usize) -> (f32, Option<usize>) {
        let mut first = (1.0, None);
        for pair in self.pairs.of_body(&self.proxies, body).filter(|&pair| self.stops(pair, body)) {
            match self.meeting(pair) {
                Some(part) if part < first.0 => first = (part, Some(pair)),
                _ => {}
            }
        }
        first
    }

    /// Whether a body may not pass the other one of a pair.
    fn stops(&self, pair: usize, body: usize) -> bool {
        let state = &self.pairs.all[pair];
        let [(a, mobility), (b, _)] = self.sides(pair);
        let other = if a == body { b } else { a };
        // What comes towards a bullet would pass it where that is stopped.
        let is_bullet = [body, other].iter().any(|&side| self.bodies.are_bullets.get(side) == Some(&true));
        let stands_still = mobility != Mobility::Dynamic || self.sleep.is_asleep(other);
        // In three axes who touches something is kept out of it by its contacts.
        let is_kept_out = self.space.is_some() && self.pairs.frozen[pair].count > 0;
        let flies_through = || {
            self.space.as_ref().is_some_and(|space| {
                let proxies = self.pairs.watched[pair].proxies;
                space.flies_through(proxies, &self.proxies, &self.bodies, self.tuning.speculative)
            })
        };
        let is_open = || match state.passage {
            Passage::Closed | Passage::Landed => false,
            Passage::Passes => true,
            Passage::Apart => !self.ways_ahead().lands(pair),
        };
        state.responds
            && !state.is_vetoed
            && (stands_still || is_bullet)
            && !is_kept_out
            && !flies_through()
            && !is_open()
    }

    /// The ways of the step, before they are gone.
    pub(super) fn ways_ahead(&self) -> Ways<'_> {
        let Precise { bodies, proxies, pairs, tuning, .. } = self;
        Ways { bodies, proxies, pairs, reach: tuning.speculative, are_gone: false }
    }

    fn meeting(&self, pair: usize) -> Option<f32> {
        let reach = self.tuning.speculative;
        if let Some(space) = &self.space {
            let proxies = self.pairs.watched[pair].proxies;
            return meet(DEEP * reach, EXACT * reach, |part| {
                space.coming(proxies, &self.proxies, &self.bodies, part)
            });
        }
        let flyer = |proxy: u32| {
            let proxy = &self.proxies.all[proxy as usize];
            let path = self.bodies.path.get(proxy.body as usize).copied().unwrap_or_default();
            let outline = self.proxies.corners.outline(proxy.shape);
            Flyer { outline, pose: self.bodies.poses[proxy.body as usize], path }
        };
        let [a, b] = self.pairs.watched[pair].proxies.map(flyer);
        let two = Two { a, b };
        if two.is_free() { None } else { meet(DEEP * reach, EXACT * reach, |part| two.coming(part)) }
    }

    /// Notes the sensors that those who are fast pass in this step: outside of them before, and after.
    fn note_flown(&mut self, fast: &[(u32, f32, Option<usize>)]) {
        if self.space.is_some() {
            return;
        }
        for &(number, part, _) in fast {
            for proxy in self.proxies.of(number as usize) {
                for pair in self.pairs.of(proxy) {
                    let state = &self.pairs.all[pair];
                    if state.responds || state.is_told || state.is_vetoed {
                        continue;
                    }
                    let is_met = self.meeting(pair).is_some_and(|met| met < part);
                    if is_met && self.is_left(pair, number as usize, part) {
                        let [a, b] = self.pairs.watched[pair].proxies.map(|proxy| {
                            let proxy = &self.proxies.all[proxy as usize];
                            (proxy.number, proxy.geom)
                        });
                        self.flown.push(if a.0 < b.0 { [a, b] } else { [b, a] });
                    }
                }
            }
        }
        sort_by_number(&mut self.flown, |geoms| joined(geoms.map(|(number, _)| number)));
        self.flown.dedup();
    }

    /// Whether the two of a pair are apart again after this part of the way of one of them.
    fn is_left(&self, pair: usize, body: usize, part: f32) -> bool {
        let flyer = |proxy: u32| {
            let proxy = &self.proxies.all[proxy as usize];
            let path = self.bodies.path.get(proxy.body as usize).copied().unwrap_or_default();
            let part = if proxy.body as usize == body { part } else { 1.0 };
            let outline = self.proxies.corners.outline(proxy.shape);
            Flyer { outline, pose: self.bodies.poses[proxy.body as usize], path: path.map(|way| way * part) }
        };
        let [a, b] = self.pairs.watched[pair].proxies.map(flyer);
        Two { a, b }.separation(1.0).0 > 0.0
    }

    /// The geoms that something has flown through in this step, one of which is a sensor; in the order of creation numbers.
    pub(crate) fn flown(&self, at: usize) -> Option<(GeomId, GeomId)> {
        self.flown.get(at).map(|&[(_, a), (_, b)]| (a, b))
    }
}
