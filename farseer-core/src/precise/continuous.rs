//! Continuous collision: fast bodies are stopped at what they must not pass.
//!
//! The solver moves bodies along their ways through the step. A dynamic body whose way is longer than its core could end
//! beyond a wall without a contact. Its way ends at the time of impact with the first geom that stops it: of a static,
//! kinematic or sleeping body, or of any body if one of the two is a bullet. The body keeps the velocity of that time, and
//! the next step finds the contact.
//!
//! The time of impact is that of the relative motion. For the rest of the step the body moves with what it has met, as if
//! fixed to it. Otherwise a lift that sinks would move away after every impact, and the body would never land.
//!
//! The broad phase is asked along the way for what can stop the body alone, and a pair is made with what the body really
//! meets: the cost does not depend on how many other bodies lie along the way (E. Catto, Box2D 3, `solver.c`: continuous
//! collision queries the static tree and keeps no pairs).

use super::Precise;
use super::bodies::Bodies;
use super::flight::{Flyer, Two, meet};
use super::flush::Flush;
use super::grid::Box2;
use super::one_way::{Passage, Ways};
use super::proxies::{Mobility, Proxy};
use super::space::parts::is_geom;
use super::tuning::{Step, Tuning};
use crate::geom::GeomId;
use crate::math::plane::{difference, length, place, sum, turn};
use crate::math::scalar::{self, nearest_finite};
use crate::objects::Objects;
use crate::precise::parameters::narrow_phase::{
    CONTINUOUS_COLLISION_RANGE, IMPACT_PENETRATION, IMPACT_TOLERANCE,
};
use crate::storage::order::{joined, sort_by_number};

/// A fast body.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flight {
    /// Index into `bodies`.
    pub(super) body: u32,
    /// Time of impact as a fraction of the step, 0..=1; 1 without an impact.
    pub(super) time: f32,
    /// The pair of the impact, and the body of it that was stopped: this one, or one that is [joined](super::joined_flights) to it.
    pub(super) pair: Option<u32>,
    pub(super) stopped: u32,
    /// It is joined to others, all of which stop at this time.
    pub(super) is_joined: bool,
    /// Motion with the other body after the impact: x and y in length units, angle in rad, z in length units.
    pub(super) carried: [f32; 4],
}

impl Flight {
    pub(super) fn of(body: u32) -> Self {
        Flight { body, time: 1.0, pair: None, stopped: body, is_joined: false, carried: [0.0; 4] }
    }
}

/// Whether a body moves by more than its core within the step, and by a length that is of use.
fn is_fast([x, y, turned, z]: [f32; 4], reach: f32, core: f32) -> bool {
    let way = x.abs() + y.abs() + z.abs() + reach * turned.abs();
    way > core && way < CONTINUOUS_COLLISION_RANGE
}

/// Whether a proxy is that of a kinematic body that moves by more than the reach of contacts within the step.
pub(super) fn sweeps(proxy: &Proxy, bodies: &Bodies, tuning: &Tuning, dt: f32) -> bool {
    if proxy.mobility != Mobility::Kinematic || !is_geom(proxy.geom) {
        return false;
    }
    let [x, y, spin, z] = bodies.hot[proxy.body as usize].velocity;
    let way = (length([length([x, y]), z]) + spin.abs() * proxy.shape.reach) * dt;
    way > tuning.speculative && way < CONTINUOUS_COLLISION_RANGE
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

/// Before the solver.
impl Precise {
    /// A step begins for kinematic bodies. Their velocities are those that they will have in it, and the bounds of fast ones
    /// contain their ways, so that what they meet is in pairs with them.
    pub(crate) fn begin_kinematic(&mut self, objects: &Objects) {
        for at in 0..self.bodies.kinematic.len() {
            let number = self.bodies.kinematic[at] as usize;
            let Some((id, entry)) =
                self.bodies.ids[number].and_then(|id| Some((id, objects.bodies.get(id)?)))
            else {
                continue;
            };
            let (velocity, spin) = entry.body.kinematic_velocity(self.dt);
            let along_depth = self.space.as_ref().map_or(0.0, |space| space.kinematic_velocity(id, self.dt));
            let velocity = [velocity.x, velocity.y, spin, along_depth];
            if velocity.iter().all(|velocity| velocity.is_finite()) {
                self.bodies.hot[number].velocity = velocity;
                self.cover_ways_of(number, velocity.map(|velocity| velocity * self.dt));
            }
        }
    }

    fn cover_ways_of(&mut self, number: usize, path: [f32; 4]) {
        let mut proxies = std::mem::take(&mut self.lost);
        proxies.extend(self.proxies.of(number));
        for proxy in proxies.drain(..) {
            let Precise { bodies, tuning, dt, .. } = self;
            if sweeps(&self.proxies.all[proxy as usize], bodies, tuning, *dt) && self.cover_way(proxy, path) {
                self.proxies.escaped.push(proxy);
            }
        }
        self.lost = proxies;
    }

    /// Finds the contacts of fast kinematic bodies with what they will meet within the step.
    pub(super) fn look_ahead_of_kinematic(&mut self) {
        let mut pairs = std::mem::take(&mut self.lost);
        let Precise { bodies, proxies, tuning, dt, .. } = self;
        for proxy in bodies.kinematic.iter().flat_map(|&number| proxies.of(number as usize)) {
            if sweeps(&proxies.all[proxy as usize], bodies, tuning, *dt) {
                pairs.extend(self.pairs.of(proxy).map(|pair| pair as u32));
            }
        }
        // By number, so that rows come in an order that is saved.
        pairs.sort_unstable();
        pairs.drain(..).for_each(|pair| self.touch().look_ahead(pair as usize));
        self.lost = pairs;
    }
}

/// After the solver.
impl Precise {
    /// Lists the fast bodies. Returns whether there are any.
    pub(crate) fn find_fast(&mut self) -> bool {
        self.fast.clear();
        self.flown.clear();
        // In three axes the contact normal follows from the way of the last step: no body may get far into another.
        let most = if self.space.is_some() { self.tuning.speculative } else { f32::MAX };
        let Precise { bodies, sleep, fast, .. } = self;
        for run in &sleep.bodies {
            let (paths, reaches) = (&bodies.path[run.clone()], &bodies.reaches[run.clone()]);
            let of = run.clone().zip(paths).zip(reaches).zip(&bodies.cores[run.clone()]);
            for (((number, &path), &reach), &core) in of {
                let core = if core < most { core } else { most };
                let is_body = || bodies.ids[number].is_some() && !bodies.is_kinematic(number);
                if is_fast(path, reach, core) && !sleep.is_asleep(number) && is_body() {
                    fast.push(Flight::of(number as u32));
                }
            }
        }
        !self.fast.is_empty()
    }

    /// Finds the new pairs of fast bodies and returns how many there may be. No pair ends: that is told at the beginning of a
    /// step.
    pub(crate) fn find_pairs_of_fast(&mut self) -> usize {
        if self.space.is_some() {
            return self.widen_and_search();
        }
        let mut found = std::mem::take(&mut self.found);
        let mut known = std::mem::take(&mut self.known);
        found.clear();
        for flight in &self.fast {
            let path = self.bodies.path[flight.body as usize];
            for proxy in self.proxies.of(flight.body as usize) {
                self.search_along(proxy, path, &mut known, &mut found);
            }
        }
        self.known = known;
        sort_by_number(&mut found, |&pair| self.proxies.creation_numbers(pair));
        found.dedup();
        self.found = found;
        self.found.len()
    }

    /// Collects the pairs of a proxy with what it meets along its way. Whatever overlaps its bounds is in a pair already.
    fn search_along(&self, proxy: u32, path: [f32; 4], known: &mut [bool], found: &mut Vec<[u32; 2]>) {
        let swept = self.swept(proxy, path);
        if contains(&self.proxies.bounds[proxy as usize], &swept) {
            return;
        }
        self.pairs.partners(proxy).for_each(|partner| known[partner as usize] = true);
        self.grid.for_each_overlap(&swept, |other| {
            if known[other as usize] || !self.may_stop(proxy, other) {
                return;
            }
            let pair = self.ordered([proxy, other]);
            found.extend(pair.filter(|&pair| self.impact(pair, 0.0).is_some()));
        });
        self.pairs.partners(proxy).for_each(|partner| known[partner as usize] = false);
    }

    /// Whether a proxy on its way may be stopped by another one, or told of it: what awake bodies have is passed.
    fn may_stop(&self, proxy: u32, other: u32) -> bool {
        let [one, other] = [proxy, other].map(|proxy| &self.proxies.all[proxy as usize]);
        let is_bullet = |proxy: &Proxy| self.bodies.are_bullets.get(proxy.body as usize) == Some(&true);
        one.may_meet(other)
            && (other.mobility != Mobility::Dynamic
                || self.sleep.is_asleep(other.body as usize)
                || is_bullet(one)
                || is_bullet(other)
                || !(one.responds && other.responds))
    }

    /// In three axes many bodies are fast, by little: bounds that have become too small are new ones, good for some steps.
    fn widen_and_search(&mut self) -> usize {
        for at in 0..self.fast.len() {
            let body = self.fast[at].body as usize;
            let mut proxies = std::mem::take(&mut self.lost);
            proxies.extend(self.proxies.of(body));
            for proxy in proxies.drain(..) {
                if self.cover_way(proxy, self.bodies.path[body]) {
                    self.widened.push(proxy);
                }
            }
            self.lost = proxies;
        }
        let mut widened = std::mem::take(&mut self.widened);
        let found = self.search(&widened);
        widened.clear();
        self.widened = widened;
        found
    }

    /// Renews the bounds of a proxy if they do not contain its way through the step. Returns whether they did not.
    fn cover_way(&mut self, proxy: u32, path: [f32; 4]) -> bool {
        let (swept, way) = (self.swept(proxy, path), path[3]);
        if self.holds_way(proxy, &swept, way) {
            return false;
        }
        self.widen(proxy);
        let body = self.proxies.all[proxy as usize].body;
        let bounds = both(&self.proxies.bounds[proxy as usize], &swept);
        self.proxies.bounds[proxy as usize] = bounds;
        if let Some(space) = self.space.as_deref_mut() {
            let depths = space.swept(proxy, body, way, self.tuning.speculative);
            space.set_depths(proxy, space.depths(proxy as usize).with(depths));
            self.grid.set(proxy, &space.cells(proxy, &bounds));
        } else {
            self.grid.set(proxy, &bounds);
        }
        true
    }

    /// Whether the bounds of a proxy contain its way through the step, in all axes that there are.
    pub(super) fn holds_way(&self, proxy: u32, swept: &Box2, way: f32) -> bool {
        let body = self.proxies.all[proxy as usize].body;
        contains(&self.proxies.bounds[proxy as usize], swept)
            && self.space.as_ref().is_none_or(|space| {
                let depths = space.swept(proxy, body, way, self.tuning.speculative);
                space.depths(proxy as usize).contains(depths)
            })
    }

    /// The box around a proxy on its way through the step. A turn moves a point by its chord, at most twice its reach.
    pub(super) fn swept(&self, proxy: u32, [dx, dy, turned, _]: [f32; 4]) -> Box2 {
        let turning = self.proxies.all[proxy as usize].shape.reach * turned.abs().min(2.0);
        let [x, y, to_x, to_y] = self.proxies.tight(proxy as usize, &self.bodies, &self.tuning);
        let low = |from: f32, way: f32| from - turning + if way < 0.0 { way } else { 0.0 };
        let high = |from: f32, way: f32| from + turning + if way < 0.0 { 0.0 } else { way };
        [low(x, dx), low(y, dy), high(to_x, dx), high(to_y, dy)].map(nearest_finite)
    }

    /// Ends the ways of fast bodies at their times of impact. Returns whether a body moves on with what it has met: what it
    /// meets on that way is to be found, and [stops](Self::stop_carried) it.
    pub(crate) fn stop_fast(&mut self, step: &Step) -> bool {
        let mut fast = std::mem::take(&mut self.fast);
        for flight in &mut fast {
            let first = self.first_impact(flight.body as usize, |_| true);
            (flight.time, flight.pair) = first.map_or((1.0, None), |(time, pair)| (time, Some(pair as u32)));
        }
        self.stop_joined(&mut fast);
        self.note_flown(&fast);
        for at in 0..fast.len() {
            fast[at].carried = self.carried(&fast, &fast[at]);
        }
        fast.retain(|flight| flight.time < 1.0);
        for &Flight { body, time, carried, is_joined, .. } in &fast {
            let body = body as usize;
            for (way, carried) in self.bodies.path[body].iter_mut().zip(carried) {
                *way = *way * time + carried;
            }
            if is_joined {
                self.slow_joined(body, time);
                continue;
            }
            // Forces have acted until the time of impact.
            let undone = (1.0 - time) * step.substeps as f32;
            for (velocity, push) in self.bodies.hot[body].velocity.iter_mut().zip(self.bodies.push[body]) {
                *velocity -= undone * push;
            }
        }
        fast.retain(|flight| flight.carried != [0.0; 4]);
        self.fast = fast;
        !self.fast.is_empty()
    }

    /// Ends the ways of bodies that move with what they have met where they meet something static.
    pub(crate) fn stop_carried(&mut self) {
        let mut fast = std::mem::take(&mut self.fast);
        for &Flight { body, pair, .. } in &fast {
            let is_static = |at: usize| {
                let [(_, mobility), _] = self.sides(at);
                mobility == Mobility::Fixed && pair != Some(at as u32)
            };
            if let Some((time, _)) = self.first_impact(body as usize, is_static) {
                self.bodies.path[body as usize] = self.bodies.path[body as usize].map(|way| way * time);
            }
        }
        fast.clear();
        self.fast = fast;
    }

    /// The motion of a body after its impact, until the end of the step: as if it were fixed to what it has met.
    fn carried(&self, fast: &[Flight], flight: &Flight) -> [f32; 4] {
        let &Flight { body, time, pair: Some(pair), stopped, .. } = flight else { return [0.0; 4] };
        let proxies =
            self.pairs.watched[pair as usize].proxies.map(|proxy| &self.proxies.all[proxy as usize]);
        let other = if proxies[0].body == stopped { proxies[1] } else { proxies[0] };
        let pose = self.bodies.poses[body as usize];
        let path = self.bodies.path[body as usize];
        if let Some(space) = self.space.as_ref().filter(|_| !is_geom(other.geom)) {
            let at = [pose[0] + time * path[0], space.places[body as usize] + time * path[3]];
            return space.velocity_at(other, at, &self.bodies).map(|way| way * (1.0 - time) * self.dt);
        }
        let path_of_other = self.path(other.body);
        // A fast body that is stopped itself moves until then.
        let end =
            fast.binary_search_by_key(&other.body, |flight| flight.body).map_or(1.0, |at| fast[at].time);
        let rest = if end > time { end - time } else { 0.0 };
        let [dx, dy, turned, dz] = path_of_other.map(|way| way * rest);
        let at = |pose: [f32; 4], path: [f32; 4]| sum(place(pose), place(path.map(|way| way * time)));
        let arm = difference(at(pose, path), at(self.bodies.poses[other.body as usize], path_of_other));
        let (sine, cosine) = if turned == 0.0 { (0.0, 1.0) } else { scalar::sin_cos(turned) };
        let [x, y] = difference(turn([cosine, sine], arm), arm);
        [dx + x, dy + y, turned, dz]
    }

    /// The first impact of a body with what stops it, as a fraction of the step, and its pair: among the pairs that `may`
    /// accepts.
    fn first_impact(&self, body: usize, may: impl Fn(usize) -> bool) -> Option<(f32, usize)> {
        let mut first: Option<(f32, usize)> = None;
        let number = |pair: usize| self.proxies.creation_numbers(self.pairs.watched[pair].proxies);
        let pairs = self.pairs.of_body(&self.proxies, body);
        for pair in pairs.filter(|&pair| may(pair) && self.stops(pair, body)) {
            let Some(time) = self.impact_of(pair) else { continue };
            // Of impacts at one time the pair that was created first counts, in whatever order pairs are listed.
            let is_first = first.is_none_or(|(earliest, other)| {
                time < earliest || (time == earliest && number(pair) < number(other))
            });
            if is_first {
                first = Some((time, pair));
            }
        }
        first
    }

    /// Whether a body may not pass the other one of a pair.
    fn stops(&self, pair: usize, body: usize) -> bool {
        let state = &self.pairs.all[pair];
        let [(a, mobility), (b, _)] = self.sides(pair);
        let other = if a == body { b } else { a };
        // A body that comes towards a bullet would pass it where the bullet stops.
        let is_bullet = [body, other].iter().any(|&side| self.bodies.are_bullets.get(side) == Some(&true));
        let stands_still = mobility != Mobility::Dynamic || self.sleep.is_asleep(other);
        // In three axes, contacts keep bodies that already touch apart.
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

    /// The time of impact of a pair as a fraction of the step; flush neighbours of a tile [hide](Flush) its side faces.
    fn impact_of(&self, pair: usize) -> Option<f32> {
        let proxies = self.pairs.watched[pair].proxies;
        if self.space.is_some() {
            return self.impact(proxies, IMPACT_PENETRATION);
        }
        self.impact_in_plane(proxies, IMPACT_PENETRATION, |part, two| self.flush(part).coming(pair, two))
    }

    /// The time of impact of two proxies as a fraction of the step: when they penetrate each other by `deep` parts of the reach
    /// of contacts, or by that much more than when the step began.
    fn impact(&self, proxies: [u32; 2], deep: f32) -> Option<f32> {
        let Some(space) = &self.space else {
            return self.impact_in_plane(proxies, deep, |part, two| two.coming(part));
        };
        let reach = self.tuning.speculative;
        let paths = proxies.map(|proxy| self.path(self.proxies.all[proxy as usize].body));
        meet(deep * reach, IMPACT_TOLERANCE * reach, |part| {
            space.coming(proxies, &self.proxies, &self.bodies, paths, part)
        })
    }

    fn impact_in_plane(
        &self,
        proxies: [u32; 2],
        deep: f32,
        coming: impl Fn(f32, &Two<'_>) -> (f32, f32),
    ) -> Option<f32> {
        let reach = self.tuning.speculative;
        let [a, b] = proxies.map(|proxy| self.flyer(proxy, 1.0));
        let two = Two { a, b };
        if two.is_free() {
            None
        } else {
            meet(deep * reach, IMPACT_TOLERANCE * reach, |part| coming(part, &two))
        }
    }

    /// The filter of flush neighbours after this part of the step.
    fn flush(&self, part: f32) -> Flush<'_> {
        let Precise { bodies, proxies, pairs, tuning, dt, .. } = self;
        Flush { bodies, proxies, pairs, tuning, dt: *dt, part }
    }

    /// A proxy on this part of its way.
    fn flyer(&self, proxy: u32, part: f32) -> Flyer<'_> {
        let Proxy { body, shape, .. } = self.proxies.all[proxy as usize];
        let outline = self.proxies.corners.outline(shape);
        Flyer { outline, pose: self.bodies.poses[body as usize], path: self.path(body).map(|way| way * part) }
    }

    /// The way of a body in the step; 0 of a static one.
    fn path(&self, body: u32) -> [f32; 4] {
        self.bodies.path.get(body as usize).copied().unwrap_or_default()
    }

    /// Notes the sensors that those who are fast pass in this step: outside of them before, and after.
    fn note_flown(&mut self, fast: &[Flight]) {
        if self.space.is_some() {
            return;
        }
        for &Flight { body, time, .. } in fast {
            for proxy in self.proxies.of(body as usize) {
                for pair in self.pairs.of(proxy) {
                    let state = &self.pairs.all[pair];
                    if state.responds || state.is_told || state.is_vetoed {
                        continue;
                    }
                    let met = self.impact(self.pairs.watched[pair].proxies, IMPACT_PENETRATION);
                    if met.is_some_and(|met| met < time) && self.is_left(pair, body as usize, time) {
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
        let [a, b] = self.pairs.watched[pair].proxies.map(|proxy| {
            let is_stopped = self.proxies.all[proxy as usize].body as usize == body;
            self.flyer(proxy, if is_stopped { part } else { 1.0 })
        });
        Two { a, b }.separation(1.0).0 > 0.0
    }

    /// The geoms that something has flown through in this step, one of which is a sensor; in the order of creation numbers.
    pub(crate) fn flown(&self, at: usize) -> Option<(GeomId, GeomId)> {
        self.flown.get(at).map(|&[(_, a), (_, b)]| (a, b))
    }
}

#[cfg(test)]
impl Precise {
    /// The number of proxies whose bounds were renewed at the end of the step.
    pub(crate) fn bounds_renewed(&self) -> usize {
        self.proxies.escaped.len()
    }
}
