//! A third axis, for an engine with depth on top of this one.
//!
//! Bodies move along it as they do along x and y, in the fourth place of their velocities and ways; outlines are extruded along
//! it, or are balls, which turn about all axes. Pairs overlap in three axes, and are looked for over the floor, x and z, so
//! that crowds on it cost what they cost in the plane. Contacts are found by [`solid`], and solved as [`rows`] in the same
//! colours and substeps as those of the plane. The ground and boxes that stand still need no geoms: they are [`parts`].
//!
//! The engine above holds the truth about all this, as it does about geoms and bodies, and tells before every update.

mod balls;
mod fixtures;
mod flight;
mod foot;
pub(crate) mod forms;
mod one_way;
mod overlap;
pub(crate) mod parts;
mod passes;
mod passing;
mod rows;
mod slant;
mod solid;
mod standing;
mod steady;
mod step;
mod swing;
mod sync;
mod told;
mod upright;
mod upright_prism;
mod upright_slant;

use std::ops::Range;

use super::bodies::Bodies;
use super::grid::Box2;
use super::outline::Outline;
use super::proxies::{Proxies, Proxy};
use super::tuning::{Tuning, Widening};
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::geom::surface::{FrictionType, mix_restitution};
use crate::math::scalar::nearest_finite;
use crate::shape::SlantedBox;
use crate::storage::reusing_clone::reusing_clone;
pub(super) use balls::touch as touch_balls;
pub(super) use one_way::lands_on;
use parts::{Depths, Fixture, SpaceBody, SpaceProfile};
pub(super) use passes::{Spin, begin_spins, gather_warm_in_space, relax_in_space};
pub(super) use rows::{SpaceRow, tangents};
use solid::Kind;
pub(super) use solid::{Before, Limits, Solid};
use upright::Upright;

/// What there is along the depth axis.
#[derive(Debug, Default)]
pub(crate) struct Space {
    /// By slots: what the engine above has told.
    pub(super) bodies: Vec<SpaceBody>,
    profiles: Vec<SpaceProfile>,
    pub(super) fixtures: Vec<Fixture>,
    /// Number and proxy of each fixture; and the places of those that move, which have the numbers from 1 on.
    numbers: Vec<u32>,
    fixture_proxies: Vec<u32>,
    moving: Vec<u32>,
    /// Those that swing, in a step.
    swings: Vec<swing::Swinging>,
    /// Whether one of them is open from below.
    has_one_way: bool,
    /// By number.
    pub(super) places: Vec<f32>,
    pub(super) spins: Vec<Spin>,
    /// Whether a body is a ball, and any is.
    pub(super) are_balls: Vec<bool>,
    pub(super) has_balls: bool,
    /// Whether a body has something upright, so that it does not turn, and any has.
    pub(super) are_upright: Vec<bool>,
    pub(super) has_upright: bool,
    /// What stands upright.
    uprights: Vec<Upright>,
    /// By proxy.
    reach: Vec<Reach>,
    depths: Vec<Depths>,
    /// The proxy of the ground.
    pub(super) ground: u32,
    /// Who has fallen asleep in the last step.
    pub(super) rested: Vec<BodyId>,
}

/// Whether there can be a depth axis.
pub(crate) const IS_THERE: bool = cfg!(feature = "space");

/// That there is one. Without the feature there is no such value, so that the compiler leaves out all that a depth axis needs.
#[cfg(feature = "space")]
type Proof = ();
#[cfg(not(feature = "space"))]
type Proof = std::convert::Infallible;

/// The depth axis of what has one: a `Space`, owned or lent.
#[derive(Debug, Clone, Copy)]
pub(super) struct Held<S> {
    space: S,
    proof: Proof,
}

impl Held<Box<Space>> {
    /// A depth axis, if there can be one.
    pub(super) fn new() -> Option<Self> {
        #[cfg(feature = "space")]
        return Some(Held { space: Box::default(), proof: () });
        #[cfg(not(feature = "space"))]
        None
    }

    pub(super) fn lend(&self) -> Held<&Space> {
        Held { space: &self.space, proof: self.proof }
    }
}

impl<S: std::ops::Deref<Target = Space>> std::ops::Deref for Held<S> {
    type Target = Space;

    #[inline(always)]
    fn deref(&self) -> &Space {
        &self.space
    }
}

impl std::ops::DerefMut for Held<Box<Space>> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut Space {
        &mut self.space
    }
}

reusing_clone! {
    Space {
        bodies, profiles, fixtures, numbers, fixture_proxies, moving, swings, has_one_way, places, spins, are_balls, has_balls,
        are_upright, has_upright, uprights, reach, depths, ground, rested
    }
}

/// How a proxy reaches along the axis.
#[derive(Debug, Clone, Copy, Default)]
struct Reach {
    half: f32,
    is_round: bool,
    ground: Option<[f32; 2]>,
    /// Its place among what stands upright, from 1 on; 0 for what does not.
    upright: u32,
}

fn entry<T: Copy + Default>(table: &[T], slot: usize) -> T {
    table.get(slot).copied().unwrap_or_default()
}

fn entry_mut<T: Clone + Default>(table: &mut Vec<T>, slot: usize) -> &mut T {
    if table.len() <= slot {
        table.resize(slot + 1, T::default());
    }
    &mut table[slot]
}

/// What the engine above tells.
impl Space {
    /// A fixture by its name, and its place in the list.
    pub(super) fn fixture(&self, id: u32) -> Option<(usize, &Fixture)> {
        let place = self.fixtures.binary_search_by_key(&id, |fixture| fixture.id).ok()?;
        Some((place, &self.fixtures[place]))
    }

    pub(super) fn body(&self, id: BodyId) -> SpaceBody {
        entry(&self.bodies, id.slot())
    }

    /// How far the first body is behind the second one, and how fast that becomes more.
    pub(crate) fn behind(&self, first: BodyId, second: BodyId) -> [f32; 2] {
        let (first, second) = (self.body(first), self.body(second));
        [first.z - second.z, first.velocity - second.velocity]
    }

    /// Where a body is along the axis, and how it moves.
    pub(crate) fn place_and_velocity(&self, id: BodyId) -> [f32; 2] {
        let body = self.body(id);
        [body.z, body.velocity]
    }

    /// What forces give a body along the axis in the step that comes.
    pub(crate) fn acceleration(&self, id: BodyId) -> f32 {
        self.body(id).acceleration
    }

    /// They have done nothing new.
    pub(super) fn forget_acceleration(&mut self, id: BodyId) {
        self.body_mut(id).acceleration = 0.0;
    }

    /// A body that takes no part has been pushed by nothing: its force would be kept nowhere until it does.
    pub(crate) fn set_acceleration(&mut self, id: BodyId, acceleration: f32) {
        self.body_mut(id).acceleration = acceleration;
    }

    /// A force acts along the axis in the step that comes.
    pub(crate) fn push_along_depth(&mut self, id: BodyId, acceleration: f32) {
        self.body_mut(id).acceleration += acceleration;
    }

    pub(super) fn body_mut(&mut self, id: BodyId) -> &mut SpaceBody {
        entry_mut(&mut self.bodies, id.slot())
    }

    pub(super) fn profile(&self, id: GeomId) -> SpaceProfile {
        entry(&self.profiles, id.slot())
    }

    pub(super) fn profile_mut(&mut self, id: GeomId) -> &mut SpaceProfile {
        entry_mut(&mut self.profiles, id.slot())
    }
}

/// Lists.
impl Space {
    /// Bodies are listed anew, fixtures behind them.
    pub(super) fn list_bodies(&mut self, bodies: &Bodies) {
        let Space { places, spins, are_balls, has_balls, bodies: told, fixtures, numbers, .. } = self;
        self.has_upright = false;
        self.are_upright.clear();
        self.are_upright.resize(bodies.ids.len(), false);
        places.clear();
        places.extend(bodies.ids.iter().map(|id| id.map_or(0.0, |id| entry(told, id.slot()).z)));
        for (&number, fixture) in numbers.iter().zip(fixtures) {
            places[number as usize] = fixtures::place_of(fixture).z;
        }
        spins.clear();
        spins.resize(bodies.hot.len(), Spin::default());
        are_balls.clear();
        are_balls.resize(bodies.ids.len(), false);
        *has_balls = false;
    }

    /// How the proxies reach.
    pub(super) fn list_proxies(&mut self, proxies: &Proxies) {
        self.reach.clear();
        self.uprights.clear();
        self.depths.clear();
        self.depths.resize(proxies.all.len(), Depths::default());
        for proxy in &proxies.all {
            let reach = self.reach_of(proxy.geom);
            self.reach.push(reach);
        }
    }

    /// A body has come.
    pub(super) fn add_body(&mut self, number: usize, id: BodyId) {
        let told = self.body(id);
        *entry_mut(&mut self.places, number) = told.z;
        *entry_mut(&mut self.spins, number) = Spin::default();
        *entry_mut(&mut self.are_balls, number) = false;
        *entry_mut(&mut self.are_upright, number) = false;
    }

    /// Whether a body turns about all axes: all that it has is round about its origin.
    pub(super) fn measure_ball(&mut self, number: usize, proxies: &Proxies) {
        let is_centred = |at: u32| self.is_round(at) && proxies.all[at as usize].shape.centre == [0.0; 2];
        let mut of_body = proxies.of(number).peekable();
        self.are_balls[number] = of_body.peek().is_some() && of_body.all(is_centred);
        self.has_balls |= self.are_balls[number];
    }

    /// A proxy has come.
    pub(super) fn add_proxy(&mut self, at: usize, geom: GeomId) {
        let reach = self.reach_of(geom);
        *entry_mut(&mut self.reach, at) = reach;
        *entry_mut(&mut self.depths, at) = Depths::default();
    }

    fn reach_of(&mut self, geom: GeomId) -> Reach {
        match parts::partner_of(geom) {
            parts::SpacePartner::Ground => Reach::default(),
            parts::SpacePartner::Fixture(id) => {
                let Some((_, fixture)) = self.fixture(id) else { return Reach::default() };
                let half = if fixture.yaw.is_some() {
                    fixtures::turning_reach(fixture)
                } else {
                    fixture.shape.half[2]
                };
                let upright = fixture.yaw.map(|_| fixtures::upright_of(fixture));
                let upright = upright.map_or(0, |upright| self.add_upright(upright));
                Reach { half, upright, ..Reach::default() }
            }
            parts::SpacePartner::Geom(geom) => {
                let SpaceProfile { half_depth, is_round, ground, upright } = self.profile(geom);
                let upright = upright.map_or(0, |upright| self.add_upright(Upright::new(upright)));
                Reach { half: half_depth, is_round, ground, upright }
            }
        }
    }
}

/// Bounds.
impl Space {
    pub(super) fn is_round(&self, proxy: u32) -> bool {
        self.reach[proxy as usize].is_round
    }

    /// Whether a proxy stands upright.
    pub(super) fn is_upright(&self, proxy: u32) -> bool {
        self.reach[proxy as usize].upright > 0
    }

    fn add_upright(&mut self, upright: Upright) -> u32 {
        self.uprights.push(upright);
        self.uprights.len() as u32
    }

    /// Friction and restitution where two proxies touch, whatever handlers set.
    pub(super) fn surface(&self, proxies: [u32; 2], [a, b]: [&Proxy; 2], mix: FrictionType) -> [f32; 2] {
        let [friction, restitution] = if proxies[0] == self.ground {
            self.reach[proxies[1] as usize].ground.unwrap_or_default()
        } else {
            [a.friction, a.restitution]
        };
        // Of numbers that are too great for it a mix is none.
        let restitution = mix_restitution(restitution, b.restitution).clamp(f32::MIN, f32::MAX);
        [mix.mix(friction, b.friction).min(f32::MAX), restitution]
    }

    /// The ground is below everything: no grid need know.
    pub(super) fn is_in_grid(&self, proxy: u32) -> bool {
        proxy != self.ground
    }

    /// What the grid is told of a proxy: its bounds over the floor.
    pub(super) fn cells(&self, proxy: u32, &[left, _, right, _]: &Box2) -> Box2 {
        let Depths { low, high } = self.depths[proxy as usize];
        [left, low, right, high]
    }

    pub(super) fn depths(&self, proxy: usize) -> Depths {
        self.depths[proxy]
    }

    pub(super) fn set_depths(&mut self, proxy: u32, depths: Depths) {
        self.depths[proxy as usize] = depths;
    }

    pub(super) fn overlap(&self, a: u32, b: u32) -> bool {
        self.depths[a as usize].overlap(self.depths[b as usize])
    }

    /// The ground, if it is beneath a proxy that rests on it.
    pub(super) fn ground_beneath(&self, proxy: u32, &[.., bottom]: &Box2) -> Option<u32> {
        (bottom >= 0.0 && self.reach[proxy as usize].ground.is_some()).then_some(self.ground)
    }

    pub(super) fn is_spin_finite(&self, number: usize) -> bool {
        self.spins[number].velocity.iter().all(|velocity| velocity.is_finite())
    }

    /// A spin that is not finite is none.
    pub(super) fn stop_spinning(&mut self, number: usize) {
        if !self.is_spin_finite(number) {
            self.spins[number] = Spin::default();
        }
    }

    /// Whether something bounces on its ground.
    fn bounces(&self) -> bool {
        self.reach.iter().any(|reach| reach.ground.is_some_and(|[_, restitution]| restitution > 0.0))
    }

    /// Whether something rests on the ground.
    pub(super) fn may_meet_ground(&self, proxy: u32) -> bool {
        self.reach[proxy as usize].ground.is_some()
    }

    /// The middle of what two proxies of these bodies both cover along the axis.
    pub(super) fn middle(&self, proxies: [u32; 2], bodies: [u32; 2]) -> f32 {
        let interval = |at: usize| {
            let (z, half) = (self.places[bodies[at] as usize], self.reach[proxies[at] as usize].half);
            [nearest_finite(z - half), nearest_finite(z + half)]
        };
        let ([near1, far1], [near2, far2]) = (interval(0), interval(1));
        let near = if near1 > near2 { near1 } else { near2 };
        let far = if far1 < far2 { far1 } else { far2 };
        near * 0.5 + far * 0.5
    }

    /// New bounds with a margin, longer the faster the body moves: see [`Proxies::widened`].
    pub(super) fn widen(&mut self, proxy: u32, body: u32, way: f32, widening: Widening, around: f32) {
        if proxy == self.ground {
            self.depths[proxy as usize] = Depths { low: f32::MIN, high: f32::MAX };
            return;
        }
        let (z, half) = (self.places[body as usize], self.reach[proxy as usize].half);
        let margin = widening.margin + around;
        let ahead = widening.ahead(way);
        let (below, above) = if ahead < 0.0 { (ahead, 0.0) } else { (0.0, ahead) };
        self.depths[proxy as usize] = Depths::new(z - half - margin + below, z + half + margin + above);
    }

    /// What a proxy covers along the axis on its way through a step.
    pub(super) fn swept(&self, proxy: u32, body: u32, way: f32, around: f32) -> Depths {
        let (z, half) = (self.places[body as usize], self.reach[proxy as usize].half + around);
        let (below, above) = if way < 0.0 { (way, 0.0) } else { (0.0, way) };
        Depths::new(z - half + below, z + half + above)
    }

    /// Who has left its bounds along the axis.
    pub(super) fn follow(
        &self,
        proxies: &mut Proxies,
        bodies: &Bodies,
        runs: &[Range<usize>],
        tuning: &Tuning,
    ) {
        let before = proxies.escaped.len();
        for at in runs.iter().cloned().flatten().filter(|&at| at < proxies.movable) {
            let body = proxies.all[at].body as usize;
            let z = self.places[body];
            let half = self.reach[at].half + tuning.speculative;
            let Depths { low, high } = self.depths[at];
            if bodies.path.get(body).is_some_and(|path| path[3] != 0.0) && (z - half < low || z + half > high)
            {
                proxies.escaped.push(at as u32);
            }
        }
        if proxies.escaped.len() > before {
            proxies.escaped.sort_unstable();
            proxies.escaped.dedup();
        }
    }
}

/// Contacts.
impl Space {
    /// A proxy as something with depth.
    pub(super) fn solid<'a>(
        &'a self,
        at: u32,
        proxy: &Proxy,
        outline: Outline<'a>,
        (bodies, dt): (&Bodies, f32),
    ) -> Solid<'a> {
        let body = proxy.body as usize;
        let Reach { half, is_round, upright, .. } = self.reach[at as usize];
        let upright = upright.checked_sub(1).map(|at| &self.uprights[at as usize]);
        let kind = match (at == self.ground, is_round) {
            (true, _) => Kind::Ground,
            (false, true) => Kind::Ball,
            (false, false) if upright.is_some() => Kind::Upright,
            (false, false) => Kind::Prism(half),
        };
        let fixture = self.fixture_of(proxy);
        let motion = match fixture {
            Some(fixture) => fixture.motion.map(|motion| motion.way),
            None => bodies.ids[body].filter(|_| bodies.hot.len() > body).map(|id| self.body(id).motion),
        };
        Solid {
            outline,
            pose: bodies.poses[body],
            kind,
            z: self.places[body],
            motion: motion.unwrap_or_default(),
            ahead: bodies.hot.get(body).map_or([0.0; 3], |hot| {
                let [x, y, _, z] = hot.velocity;
                [x * dt, y * dt, z * dt]
            }),
            slant: fixture.map(|fixture| fixture.shape).filter(SlantedBox::is_sheared),
            upright,
        }
    }

    pub(super) fn touch(
        &self,
        a: Solid<'_>,
        b: Solid<'_>,
        before: Before,
        limits: Limits,
    ) -> super::manifold::Manifold {
        solid::touch(a, b, before, limits)
    }

    /// Whether two proxies, of which one is upright, touched one above the other: `feature` is that of their first contact point.
    pub(super) fn was_over(&self, proxies: [u32; 2], feature: u32) -> bool {
        upright::is_over(feature) && proxies.iter().any(|&proxy| self.is_upright(proxy))
    }

    /// How far B is behind A.
    pub(super) fn apart(&self, a: &Proxy, b: &Proxy) -> f32 {
        self.places[b.body as usize] - self.places[a.body as usize]
    }

    /// The radius of a ball that turns about all axes; else 0.
    pub(super) fn rolling_radius(&self, at: u32, proxy: &Proxy) -> f32 {
        let rolls = self.reach[at as usize].is_round && self.are_balls[proxy.body as usize];
        if rolls { proxy.shape.radius } else { 0.0 }
    }

    /// Whether two extruded outlines still are beside each other along the axis.
    pub(super) fn are_beside(&self, [a, b]: [u32; 2], apart: f32) -> bool {
        a == self.ground || apart.abs() <= self.reach[a as usize].half + self.reach[b as usize].half
    }
}
