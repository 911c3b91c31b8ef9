//! What nothing pushes and is no geom: the ground, boxes that stand still, and boxes that the engine above moves.
//!
//! What moves is listed among the bodies, before all that can be pushed, as a kinematic one without an id; what stands still
//! behind everything.

use super::Space;
use super::parts::{Fixture, FixtureMotion, FixtureSwing, fixture_id, ground_id, is_geom, number_of};
use super::solid::Solid;
use super::upright::{Upright, within};
use crate::geom::GeomId;
use crate::geom::surface::SurfaceCoefficients;
use crate::math::Vector3;
use crate::math::plane::{Pose, length};
use crate::math::scalar;
use crate::precise::Precise;
use crate::precise::bodies::{Bodies, Hot};
use crate::precise::fingerprint::Fingerprint;
use crate::precise::outline::Shape;
use crate::precise::parameters::depth::WORLD_BOX_SWEEP;
use crate::precise::proxies::{Mobility, Proxy, filter_of_fixture};
use crate::precise::tuning::Tuning;
use crate::shape::SlantedBox;

/// The place of the ground among fixtures: none.
const NO_PLACE: u32 = u32::MAX;

/// What turns does so about the upright axis, in the place of turning in the plane: its contacts have the arms for that.
fn on_hot(motion: &FixtureMotion) -> [f32; 4] {
    let [x, y, z] = motion.velocity;
    [x, y, motion.turning, z]
}

/// How far one that turns reaches along x and along z, whatever its angle is.
pub(super) fn turning_reach(fixture: &Fixture) -> f32 {
    let [x, _, z] = fixture.shape.half;
    let [out_x, out_z] = fixture.swing().map_or([0.0; 2], |swing| swing.out);
    length([x + out_x.abs(), z + out_z.abs()])
}

/// The place that a fixture goes by, about which it turns: its hinge, or its middle.
pub(super) fn place_of(fixture: &Fixture) -> Vector3 {
    let centre = fixture.shape.centre;
    fixture.swing().map_or(centre, |FixtureSwing { hinge: [x, z], .. }| Vector3::new(*x, centre.y, *z))
}

/// A level one, as what stands upright.
pub(super) fn upright_of(fixture: &Fixture) -> Upright {
    let (shape, mut corners) = (&fixture.shape, fixture.shape.footprint());
    if fixture.swing().is_some() {
        let out = shape.centre - place_of(fixture);
        corners = corners.map(|[x, z]| [x + out.x, z + out.z]);
    }
    Upright::of_corners(corners, shape.half[1])
}

/// An angle of one turn, from 0 on.
fn wrapped(angle: f32) -> f32 {
    let turn = 2.0 * std::f32::consts::PI;
    let rest = angle % turn;
    if rest < 0.0 { rest + turn } else { rest }
}

fn pose_of(fixture: &Fixture) -> Pose {
    let (shape, place) = (&fixture.shape, place_of(fixture));
    [place.x, place.y, shape.cos, shape.sin]
}

impl FixtureMotion {
    /// The velocity of the step that begins.
    fn begin(&mut self, centre: Vector3, yaw: f32, dt: f32) {
        self.begin_turning(yaw, dt);
        let Some((target, is_reached)) = self.target else { return };
        self.velocity =
            if is_reached { [0.0; 3] } else { [0, 1, 2].map(|axis| (target[axis] - centre[axis]) / dt) };
        if !self.velocity.iter().all(|velocity| velocity.is_finite()) {
            self.velocity = [0.0; 3];
        }
        let stays = !is_reached && self.velocity != [0.0; 3];
        self.target = self.target.filter(|_| stays);
    }

    fn begin_turning(&mut self, yaw: f32, dt: f32) {
        let Some((target, is_reached)) = self.yaw_target else { return };
        self.turning = if is_reached { 0.0 } else { (target - yaw) / dt };
        if !self.turning.is_finite() {
            self.turning = 0.0;
        }
        let stays = !is_reached && self.turning != 0.0;
        self.yaw_target = self.yaw_target.filter(|_| stays);
    }

    /// To what angle a step has turned it.
    fn end_turning(&mut self, yaw: f32, turned: f32) -> f32 {
        match self.yaw_target.as_mut() {
            Some((target, is_reached)) => {
                *is_reached = true;
                *target
            }
            None if turned == 0.0 => yaw,
            None => self.swing().map_or_else(|| wrapped(yaw + turned), |swing| swing.within(yaw + turned)),
        }
    }

    /// Where a step has brought its middle. What would have come too far for numbers has been put back, and stands still.
    fn end(&mut self, centre: Vector3, way: [f32; 3]) -> Vector3 {
        let is_put_back = way == [0.0; 3] && self.velocity != [0.0; 3];
        self.way = way;
        if is_put_back {
            (self.velocity, self.target) = ([0.0; 3], None);
        }
        match self.target.as_mut() {
            Some((target, is_reached)) => {
                *is_reached = true;
                Vector3::from(*target)
            }
            None => centre + Vector3::from(way),
        }
    }

    fn is_on_its_way(&self) -> bool {
        let turns = self.yaw_target.map_or(self.turning != 0.0, |(_, is_reached)| !is_reached);
        turns || self.target.map_or(self.velocity != [0.0; 3], |(_, is_reached)| !is_reached)
    }
}

/// Told between updates.
impl Precise {
    /// What nothing pushes and is no geom.
    pub(crate) fn set_fixtures(&mut self, fixtures: impl Iterator<Item = Fixture>) {
        let Some(space) = self.space.as_deref_mut() else { return };
        space.fixtures.clear();
        space.fixtures.extend(fixtures);
        space.has_one_way = space.fixtures.iter().any(|fixture| fixture.is_one_way);
        let moving = (0..).zip(&space.fixtures).filter(|(_, fixture)| fixture.motion.is_some());
        space.moving.clear();
        space.moving.extend(moving.map(|(place, _)| place));
        self.is_stale = true;
    }

    /// How a fixture that is no new one, and moves already, goes on.
    pub(crate) fn set_fixture_motion(&mut self, id: u32, told: FixtureMotion) {
        let Some(space) = self.space.as_deref_mut() else { return };
        let Some((place, _)) = space.fixture(id) else { return };
        let known = space.fixtures[place].motion.replace(told);
        let number = space.moving.binary_search(&(place as u32)).map_or(0, |at| at + 1);
        if let Some(hot) = self.bodies.hot.get_mut(number).filter(|_| number > 0 && !self.is_stale) {
            hot.velocity = on_hot(&told);
            if told.swing().is_some() && known != Some(told) {
                self.sleep.note_waking(number);
            }
        }
    }

    /// The fixtures that move: their names, where their middles are and how they are turned, and how they move.
    pub(crate) fn fixtures_moved(
        &self,
    ) -> impl Iterator<Item = (u32, Vector3, Option<f32>, FixtureMotion)> + '_ {
        self.space.iter().flat_map(|space| {
            let moving = space.moving.iter().map(|&place| &space.fixtures[place as usize]);
            moving
                .filter_map(|fixture| Some((fixture.id, fixture.shape.centre, fixture.yaw, fixture.motion?)))
        })
    }
}

/// Lists.
impl Space {
    /// Where those are that move.
    pub(in crate::precise) fn moving_poses(&self) -> impl Iterator<Item = (Pose, f32)> + '_ {
        let moving = self.moving.iter().map(|&place| &self.fixtures[place as usize]);
        moving.map(|fixture| (pose_of(fixture), fixture.rotation))
    }

    /// What a proxy is of that is no geom's.
    pub(super) fn fixture_of(&self, proxy: &Proxy) -> Option<&Fixture> {
        if is_geom(proxy.geom) { None } else { self.fixtures.get(proxy.place as usize) }
    }

    /// Whether a proxy is that of a fixture that turns about the upright axis.
    pub(in crate::precise) fn turns(&self, proxy: &Proxy) -> bool {
        self.fixture_of(proxy).is_some_and(|fixture| fixture.yaw.is_some() && fixture.motion.is_some())
    }

    /// One that turns, as it moves where it is nearest to something else.
    pub(in crate::precise) fn turning_on<'a>(
        &self,
        mut solid: Solid<'a>,
        proxy: &Proxy,
        other: &Solid<'_>,
        (bodies, dt): (&Bodies, f32),
    ) -> Solid<'a> {
        let Some(fixture) = self.fixture_of(proxy).filter(|_| self.turns(proxy)) else { return solid };
        let SlantedBox { half: [half, ..], turn: [cos, sin], .. } = fixture.shape;
        let (x, z) = (other.centre()[0] - solid.pose[0], other.z - solid.z);
        let middle = fixture.swing().map_or(0.0, |swing| swing.out[0]);
        let along = within(cos * x + sin * z, middle - half, middle + half)
            * bodies.hot[proxy.body as usize].velocity[2]
            * dt;
        solid.ahead[0] -= along * sin;
        solid.ahead[2] += along * cos;
        solid
    }

    /// Velocity of one at a place of x and z, without what turns in the plane; 0 of what is none.
    pub(in crate::precise) fn velocity_at(&self, proxy: &Proxy, at: [f32; 2], bodies: &Bodies) -> [f32; 4] {
        let body = proxy.body as usize;
        let Some(motion) = self.fixture_of(proxy).and_then(|fixture| fixture.motion) else { return [0.0; 4] };
        let out = [at[0] - bodies.poses[body][0], at[1] - self.places[body]];
        let [x, y, z] = motion.velocity;
        [x - motion.turning * out[1], y, 0.0, z + motion.turning * out[0]]
    }

    /// How far one goes in a step at most, if that is farther than contacts reach; else 0.
    pub(in crate::precise) fn sweep(&self, proxy: &Proxy, bodies: &Bodies, tuning: &Tuning, dt: f32) -> f32 {
        let Some(fixture) = self.fixture_of(proxy).filter(|fixture| fixture.motion.is_some()) else {
            return 0.0;
        };
        let [x, y, turning, z] = bodies.hot[proxy.body as usize].velocity;
        let way = (length([length([x, y]), z]) + turning.abs() * turning_reach(fixture)) * dt;
        let sweeps = way > tuning.speculative && way <= WORLD_BOX_SWEEP * tuning.unit;
        if sweeps { way } else { 0.0 }
    }

    /// Whether the next step moves a fixture, by its number among bodies.
    pub(in crate::precise) fn is_fixture_on_its_way(&self, number: usize) -> bool {
        let place = number.checked_sub(1).and_then(|at| self.moving.get(at));
        let motion = place.and_then(|&place| self.fixtures[place as usize].motion);
        motion.is_some_and(|motion| motion.is_on_its_way())
    }
}

impl Precise {
    /// The ground, and fixtures that stand still, are listed behind all bodies.
    pub(in crate::precise) fn list_fixtures(&mut self) {
        let Some(space) = self.space.as_deref_mut() else { return };
        self.bodies.add_fixture([0.0, 0.0, 1.0, 0.0], 0.0);
        let mut moving = 0;
        space.numbers.clear();
        for fixture in &space.fixtures {
            let number = if let Some(motion) = fixture.motion {
                moving += 1;
                self.bodies.hot[moving].velocity = on_hot(&motion);
                if let Some(swing) = motion.swing() {
                    self.bodies.inverses[moving] = [0.0, swing.inverse_inertia()];
                    self.bodies.kinematic.retain(|&number| number as usize != moving);
                }
                moving
            } else {
                self.bodies.add_fixture(pose_of(fixture), fixture.rotation);
                self.bodies.ids.len() - 1
            };
            space.numbers.push(number as u32);
        }
        space.list_bodies(&self.bodies);
        for number in 1..=self.bodies.count {
            if let Some(id) = self.bodies.ids[number] {
                self.take_body_in_space(number, id);
            }
        }
    }

    /// Those that move are awake, and never sleep if they do not swing.
    pub(in crate::precise) fn enter_moving_fixtures(&mut self) {
        let count = self.space.as_ref().map_or(0, |space| space.moving.len());
        (1..=count).for_each(|number| self.sleep.add(number));
    }

    /// The proxies of those that move are listed first, so that those of who comes later are behind them.
    pub(in crate::precise) fn add_moving_fixtures(&mut self) {
        self.add_fixtures_of(true);
    }

    /// The others behind all, after that of the ground.
    pub(in crate::precise) fn add_fixtures(&mut self) {
        let Some(space) = self.space.as_deref_mut() else { return };
        let still = space.fixtures.len() - space.moving.len();
        space.ground = self.proxies.all.len() as u32;
        let ground = Proxy { place: NO_PLACE, ..proxy_for(ground_id(), self.bodies.ids.len() - still - 1) };
        self.proxies.push(ground);
        self.add_fixtures_of(false);
        let Some(space) = self.space.as_deref_mut() else { return };
        space.list_proxies(&self.proxies);
        self.bounces |= space.bounces();
    }

    fn add_fixtures_of(&mut self, moving: bool) {
        let Precise { space: Some(space), proxies, bounces, .. } = self else { return };
        let space = &mut **space;
        space.fixture_proxies.resize(space.fixtures.len(), 0);
        for (place, (fixture, &number)) in space.fixtures.iter().zip(&space.numbers).enumerate() {
            let Fixture { shape, filter, surface, surface_velocity: [vx, vy, vz], motion, .. } = fixture;
            if motion.is_some() != moving {
                continue;
            }
            let mobility = match motion {
                None => Mobility::Fixed,
                Some(motion) if motion.swing().is_some() => Mobility::Hinged,
                Some(_) => Mobility::Kinematic,
            };
            let [x, y, depth] = shape.half;
            let x = if fixture.yaw.is_some() { turning_reach(fixture) } else { x };
            // Sheared, it reaches further: its bounds and what is near are those of the widest box.
            let lean = (shape.shear * depth).abs() + (shape.climb * depth).abs();
            let shape = proxies.corners.add_box([x, y]).leaning(lean);
            let SurfaceCoefficients { friction, restitution } = *surface;
            *bounces |= restitution > 0.0;
            space.fixture_proxies[place] = proxies.all.len() as u32;
            proxies.push(Proxy {
                place: place as u32,
                mobility,
                shape,
                fingerprint: Fingerprint::of_fixture(fixture),
                friction,
                restitution,
                responds: filter.responds,
                filter: filter_of_fixture(filter),
                surface_velocity: [*vx, *vy, 0.0, *vz],
                ..proxy_for(fixture_id(fixture), number as usize)
            });
        }
    }

    /// The proxies of the ground and of the fixtures.
    pub(in crate::precise) fn fixture_count(&self) -> usize {
        self.space.as_ref().map_or(0, |space| space.fixtures.len() + 1)
    }
}

/// Stages.
impl Precise {
    /// A step begins for those that move: what they meet is looked for with the velocities that they will have in it.
    pub(in crate::precise) fn begin_fixtures(&mut self, dt: f32) {
        let Precise { space: Some(space), bodies, .. } = self else { return };
        let space = &mut **space;
        for (number, &place) in (1..).zip(&space.moving) {
            let fixture = &mut space.fixtures[place as usize];
            let Fixture { shape, yaw, motion: Some(motion), .. } = fixture else { continue };
            motion.begin(shape.centre, yaw.unwrap_or_default(), dt);
            if let Some(swing) = motion.swing_mut() {
                swing.is_edited = false;
            }
            bodies.hot[number].velocity = on_hot(motion);
        }
        (0..space.moving.len()).for_each(|at| self.look_ahead(at, dt));
    }

    /// Of one that goes farther in a step than contacts reach all that is in its way is in a pair with it, and looked at.
    fn look_ahead(&mut self, at: usize, dt: f32) {
        let Some(space) = &self.space else { return };
        let proxy = space.fixture_proxies[space.moving[at] as usize];
        let one = &self.proxies.all[proxy as usize];
        if space.sweep(one, &self.bodies, &self.tuning, dt) == 0.0 {
            return;
        }
        let [x, y, _, z] = self.bodies.hot[one.body as usize].velocity.map(|velocity| velocity * dt);
        if !self.holds_way(proxy, &self.swept(proxy, [x, y, 0.0, z]), z) {
            self.enter(proxy);
        }
        let Precise { pairs, lost, .. } = self;
        lost.extend(pairs.of(proxy).filter(|&pair| pairs.frozen[pair].count == 0).map(|pair| pair as u32));
        lost.drain(..).for_each(|pair| pairs.watched[pair as usize].tolerance = 0);
    }

    /// They move in the step as it was begun.
    pub(in crate::precise) fn read_fixtures(&mut self) {
        let Precise { space: Some(space), bodies, .. } = self else { return };
        let space = &mut **space;
        for (number, &place) in (1..).zip(&space.moving) {
            let Some(motion) = &space.fixtures[place as usize].motion else { continue };
            let velocity = on_hot(motion);
            bodies.hot[number] = Hot { velocity, ..Hot::default() };
            bodies.before[number] = velocity;
            (bodies.push[number], bodies.forced[number]) = ([0.0; 4], [0.0; 4]);
        }
    }

    /// They are where the step has brought them.
    pub(in crate::precise) fn write_fixtures(&mut self) {
        let Precise { space: Some(space), bodies, proxies, .. } = self else { return };
        let space = &mut **space;
        for (number, &place) in (1..).zip(&space.moving) {
            let fixture = &mut space.fixtures[place as usize];
            let Some(motion) = &mut fixture.motion else { continue };
            let [x, y, turned, z] = bodies.path[number];
            fixture.shape.centre = motion.end(fixture.shape.centre, [x, y, z]);
            let turned_to = fixture.yaw.map(|yaw| motion.end_turning(yaw, turned));
            if motion.swing().is_none() {
                bodies.hot[number].velocity = on_hot(motion);
            }
            if let Some(yaw) = turned_to {
                fixture.yaw = Some(yaw);
                let (sine, cosine) = scalar::sin_cos_of_any(yaw);
                fixture.shape.turn = [cosine, sine];
                if let Some(swing) = motion.swing() {
                    fixture.shape.centre = swing.middle(fixture.shape.turn, fixture.shape.centre.y);
                    motion.turning = bodies.hot[number].velocity[2];
                }
                let proxy = space.fixture_proxies[place as usize] as usize;
                let upright = upright_of(fixture);
                proxies.all[proxy].fingerprint = Fingerprint::of_fixture(fixture);
                if let Some(known) = space.reach[proxy].upright.checked_sub(1) {
                    space.uprights[known as usize] = upright;
                }
            }
            let fixture = &space.fixtures[place as usize];
            bodies.poses[number] = pose_of(fixture);
            space.places[number] = place_of(fixture).z;
        }
    }
}

fn proxy_for(id: GeomId, body: usize) -> Proxy {
    Proxy {
        geom: id,
        number: number_of(id),
        body: body as u32,
        mobility: Mobility::Fixed,
        shape: Shape::default(),
        responds: true,
        ..Proxy::nothing()
    }
}
