//! Geoms that hold only what comes against a direction, and are open from all other sides.
//!
//! What lands is decided once, when two meet, on the ways that both have gone in the step: where they touch first on these, one
//! is wholly above a side of the other that holds, or it is not. Then it is kept out, or passes, until the two are apart. All
//! pieces of a geom, and all of a body that comes to it, share one [`Passage`]: they are a *group*. So what has landed on one
//! piece is kept out by the next one as well, and what is in one piece passes the next one, too.
//!
//! That a step is decided by its ways, and not by velocities at its end, makes that independent of how long it is, of what
//! pushed in it, and of who of the two moves or turns. Of what was put where it is there is no way: what overlaps passes.

use crate::precise::parameters::narrow_phase::{IMPACT_TOLERANCE, ONE_WAY_COSINE};
use serde::{Deserialize, Serialize};

use super::Precise;
use super::bodies::Bodies;
use super::flight::{Flyer, Two, meet};
use super::manifold::Manifold;
use super::pairs::Pairs;
use super::proxies::{Proxies, Proxy};
use super::space::lands_on;
use super::touch::{self, Touch};
use crate::math::plane::{Pose, Vector, difference, dot, rotation, scaled, turn, turn_back};
use crate::math::scalar;

/// How a pair stands, one of which may be one-way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub(super) enum Passage {
    /// Neither is, or nothing is pushed here anyway.
    #[default]
    Closed,
    /// They do not overlap, and neither has landed on the other.
    Apart,
    /// They overlap as if nothing were there.
    Passes,
    /// One has landed on the other, and is kept out.
    Landed,
}

/// The ways that bodies have gone in the last step, or go in this one.
pub(super) struct Ways<'a> {
    pub(super) bodies: &'a Bodies,
    pub(super) proxies: &'a Proxies,
    pub(super) pairs: &'a Pairs,
    /// How far contacts reach.
    pub(super) reach: f32,
    /// Bodies are at the end of their ways, and not at the beginning.
    pub(super) are_gone: bool,
}

impl Ways<'_> {
    fn sides(&self, pair: usize) -> [&Proxy; 2] {
        self.pairs.watched[pair].proxies.map(|proxy| &self.proxies.all[proxy as usize])
    }

    /// A pair as it moves.
    fn on_way(&self, pair: usize) -> Two<'_> {
        let flyer = |proxy: &Proxy| {
            let path = self.bodies.path.get(proxy.body as usize).copied().unwrap_or_default();
            let pose = self.bodies.poses[proxy.body as usize];
            let pose = if self.are_gone { before(pose, path) } else { pose };
            Flyer { outline: self.proxies.corners.outline(proxy.shape), pose, path }
        };
        let [a, b] = self.sides(pair).map(flyer);
        Two { a, b }
    }

    /// A pair as it is.
    fn now(&self, pair: usize) -> Two<'_> {
        let flyer = |proxy: &Proxy| Flyer {
            outline: self.proxies.corners.outline(proxy.shape),
            pose: self.bodies.poses[proxy.body as usize],
            path: [0.0; 4],
        };
        let [a, b] = self.sides(pair).map(flyer);
        Two { a, b }
    }

    /// The pairs that share one passage with this one: those of the geom of what is one-way, and of the body of what is not,
    /// as far as its other geoms are not either.
    fn group(&self, pair: usize) -> impl Iterator<Item = usize> + '_ {
        let of = self.pairs.watched[pair].proxies;
        let body = self.proxies.all[of[1] as usize].body as usize;
        let pairs = self.pairs.of_body(self.proxies, body);
        pairs.filter(move |&other| is_of_group(self.proxies, of, self.pairs.watched[other].proxies))
    }

    /// How the other pairs of a group stand that has only now got this one.
    pub(super) fn joined(&self, pair: usize) -> Passage {
        let others = self.group(pair).filter(|&other| other != pair);
        let mut known = others.map(|other| self.pairs.all[other].passage);
        known.find(|&passage| passage != Passage::Closed).unwrap_or(Passage::Apart)
    }

    /// Whether something pushes in the group of a pair.
    pub(super) fn is_kept_out(&self, pair: usize) -> bool {
        self.group(pair).any(|other| self.pairs.all[other].home.is_some())
    }

    /// Those of a group who overlap.
    fn overlapping(&self, pair: usize) -> impl Iterator<Item = usize> + '_ {
        self.group(pair).filter(|&pair| self.now(pair).separation(0.0).0 < 0.0)
    }

    /// Whether someone does.
    pub(super) fn overlaps(&self, pair: usize) -> bool {
        self.overlapping(pair).next().is_some()
    }

    /// What becomes of a group that has not landed, now that bodies have gone their ways.
    pub(super) fn settled(&self, pair: usize) -> Passage {
        if self.pairs.all[pair].passage == Passage::Passes {
            return if self.overlaps(pair) { Passage::Passes } else { Passage::Apart };
        }
        // What overlaps has met, by the end of its way.
        let met = self.overlapping(pair).map(|pair| self.met(pair, self.first_meeting(pair).unwrap_or(1.0)));
        match met.reduce(earlier) {
            None => Passage::Apart,
            Some((_, true)) => Passage::Landed,
            Some((_, false)) => Passage::Passes,
        }
    }

    /// Whether a group that is apart lands, where the bodies are going.
    pub(super) fn lands(&self, pair: usize) -> bool {
        let met = self.group(pair).filter_map(|pair| Some(self.met(pair, self.first_meeting(pair)?)));
        met.reduce(earlier).is_some_and(|(_, lands)| lands)
    }

    /// Whether one of a pair is above the other, where they are.
    pub(super) fn is_above(&self, pair: usize) -> bool {
        self.is_above_in(pair, &self.now(pair), 0.0)
    }

    /// After which part of their ways the two of a pair touch. Those who overlap when these begin do so at once.
    fn first_meeting(&self, pair: usize) -> Option<f32> {
        let two = self.on_way(pair);
        meet(0.0, IMPACT_TOLERANCE * self.reach, |part| two.coming(part))
    }

    fn met(&self, pair: usize, part: f32) -> (f32, bool) {
        (part, self.is_above_in(pair, &self.on_way(pair), part))
    }

    /// Whether each of a pair is above the other one, if that is one-way.
    fn is_above_in(&self, pair: usize, two: &Two<'_>, part: f32) -> bool {
        let [a, b] = self.sides(pair).map(|proxy| proxy.one_way);
        a.is_none_or(|direction| is_above(&two.a, &two.b, part, direction, self.reach))
            && b.is_none_or(|direction| is_above(&two.b, &two.a, part, direction, self.reach))
    }
}

impl Precise {
    /// What had landed has left once nothing of it is kept out, nor overlaps any more: that is asked before any pair is looked
    /// at, because where pieces meet one lets go before the next one has it.
    pub(super) fn let_go(&mut self) {
        if self.proxies.one_way == 0 {
            return;
        }
        for pair in 0..self.pairs.len() {
            let state = &self.pairs.all[pair];
            if state.passage == Passage::Landed && state.home.is_none() {
                let ways = self.ways_ahead();
                if !ways.is_kept_out(pair) && !ways.overlaps(pair) {
                    self.pairs.set_passage(&self.proxies, pair, Passage::Apart);
                }
            }
        }
    }
}

impl<'a> Touch<'a> {
    /// The ways of the last step.
    fn ways(&self) -> Ways<'_> {
        let Touch { bodies, proxies, pairs, tuning, .. } = self;
        Ways { bodies, proxies, pairs, reach: tuning.speculative, are_gone: true }
    }

    /// Whether one of two, of which one at least is one-way, is not kept out by the other one.
    #[inline(never)]
    pub(super) fn is_open(&mut self, pair: usize, two: touch::Two<'a>, found: &Manifold) -> bool {
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
    fn come_together(&self, two: touch::Two<'_>, found: &Manifold) -> bool {
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
    pub(super) fn passes_through(&self, pair: usize, two: touch::Two<'a>) -> bool {
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
}

impl Pairs {
    /// All pairs of a group stand so from now on.
    pub(super) fn set_passage(&mut self, proxies: &Proxies, pair: usize, passage: Passage) {
        let of = self.watched[pair].proxies;
        let body = proxies.all[of[1] as usize].body as usize;
        for proxy in proxies.of(body) {
            self.for_each_of(proxy, |other, state| {
                if is_of_group(proxies, of, other) && state.passage != Passage::Closed {
                    state.passage = passage;
                }
            });
        }
    }
}

/// Whether these are of the geom of what is one-way, and of the body of what is not, whichever comes first.
fn is_of_group(proxies: &Proxies, [a, b]: [u32; 2], [one, other]: [u32; 2]) -> bool {
    let belongs = |proxy: u32, to: u32| {
        let (proxy, to) = (&proxies.all[proxy as usize], &proxies.all[to as usize]);
        if to.one_way.is_some() {
            proxy.geom == to.geom
        } else {
            proxy.body == to.body && proxy.one_way.is_none()
        }
    };
    (belongs(one, a) && belongs(other, b)) || (belongs(one, b) && belongs(other, a))
}

/// Of two meetings the one that comes first; of two at once the one that lands.
fn earlier(one: (f32, bool), other: (f32, bool)) -> (f32, bool) {
    let is_other = other.0 < one.0 || (other.0 == one.0 && other.1);
    if is_other { other } else { one }
}

/// Where something was before its way.
fn before([x, y, c, s]: Pose, [dx, dy, turned, _]: [f32; 4]) -> Pose {
    if turned == 0.0 {
        return [x - dx, y - dy, c, s];
    }
    let (sine, cosine) = scalar::sin_cos(turned);
    let [c, s] = turn_back([cosine, sine], [c, s]);
    [x - dx, y - dy, c, s]
}

/// Whether all of something is above a side of a one-way piece that holds, but for the reach of contacts, after a part of their
/// ways.
fn is_above(piece: &Flyer<'_>, other: &Flyer<'_>, part: f32, direction: Vector, reach: f32) -> bool {
    let (pose, pose_of_other) = (piece.at(part), other.at(part));
    let direction = turn(rotation(pose), direction);
    let height_over =
        |normal: Vector| -other.support(pose_of_other, scaled(normal, -1.0)) - piece.support(pose, normal);
    if piece.outline.shape.radius > 0.0 {
        let (apart, normal) = Two { a: *piece, b: *other }.separation(part);
        return dot(normal, direction) > ONE_WAY_COSINE && apart >= -reach;
    }
    let seams = piece.outline.seams();
    piece.outline.normals.iter().enumerate().any(|(edge, &normal)| {
        let is_inner = seams.get(edge).is_some_and(|seam| seam.is_inner);
        let normal = turn(rotation(pose), normal);
        !is_inner && dot(normal, direction) > ONE_WAY_COSINE && height_over(normal) >= -reach
    })
}
