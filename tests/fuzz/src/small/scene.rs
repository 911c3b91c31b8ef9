//! Small scenes of the precise set: a few bodies of any outline, size and mass, in a closed room or in the open.

use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, GeomFactory, GeomId, GeomPlacement, Methods, PhysicsSimulator, Result, Vertices,
};

use crate::random::Random;

/// Most bodies of a scene.
const MOST_BODIES: usize = 12;
/// Smallest and greatest size of a body in px.
const SIZES: (f32, f32) = (1.0, 1000.0);
/// Smallest and greatest mass.
const MASSES: (f32, f32) = (0.01, 100.0);
/// How fast bodies are at most when a scene begins, in px/s, and how strong gravity is, in px/s^2.
const SPEEDS: (f32, f32) = (1.0, 1000.0);
const GRAVITIES: (f32, f32) = (10.0, 2000.0);
/// Lengths of a step in seconds, and its substeps.
const STEPS: [f32; 4] = [1.0 / 30.0, 1.0 / 60.0, 1.0 / 60.0, 1.0 / 120.0];
const SUBSTEPS: [i32; 4] = [2, 4, 4, 8];
/// Of so many scenes in a hundred there is a room around the bodies, and gravity in it.
const ROOMS: u64 = 75;
const GRAVITY: u64 = 60;
/// Furthest way of a step in px, and in parts of the room: so fast is the lightest body if it takes all the energy there is.
///
/// Nothing looks ahead for walls here. What comes to a wall with this speed lies in it after the step, this deep at most, and
/// is pushed back through the nearer side: walls are [`THICKNESS`] thick. It must not come to the wall on the other side
/// meanwhile either: what is in two walls at once, step after step, goes anywhere.
const FURTHEST_WAY: f32 = 500.0;
const PART_OF_ROOM: f32 = 0.25;
/// Of walls, in px: half of it is twice the furthest way, so that energy may grow fourfold unseen.
const THICKNESS: f32 = 4.0 * FURTHEST_WAY;

/// A scene, and what must be known to judge it.
pub(super) struct Scene {
    pub(super) simulator: PhysicsSimulator,
    pub(super) bodies: Vec<BodyId>,
    /// From the centre to the walls; none in the open.
    pub(super) room: Option<f32>,
    pub(super) dt: f32,
    /// Whether anything has restitution.
    pub(super) bounces: bool,
    /// The lowest that a body can be, against gravity, from the centre.
    pub(super) lowest: f32,
}

impl Scene {
    /// That of a seed.
    pub(super) fn new(seed: u64) -> Result<Self> {
        let mut random = Random::new(seed.wrapping_mul(0x5851_f42d_4c95_7f2d));
        let mut simulator = PhysicsSimulator::new(Vector2::zeros())?;
        simulator.set_methods(Methods::PRECISE)?;
        simulator.set_iterations(random.pick(&SUBSTEPS));
        let has_room = random.chance(ROOMS);
        // What falls asleep loses its last momentum, which is kept in the open.
        simulator.set_sleep_enabled(has_room);
        let bounces = random.toss();
        let things = (0..1 + random.below(MOST_BODIES))
            .map(|_| create_body(&mut simulator, bounces, &mut random))
            .collect::<Result<Vec<_>>>()?;
        let side = place(&mut simulator, &things, &mut random);
        if has_room {
            create_walls(&mut simulator, side, surface(bounces, &mut random))?;
            if random.chance(GRAVITY) {
                let (strength, angle) = (log_between(&mut random, GRAVITIES), random.between(-4.0, 4.0));
                simulator.set_gravity(strength * direction(angle))?;
            }
        }
        let bodies: Vec<BodyId> = things.iter().map(|thing| thing.body).collect();
        throw(&mut simulator, &things, has_room, &mut random);
        let dt = random.pick(&STEPS);
        let mut scene =
            Scene { simulator, bodies, room: has_room.then_some(side), dt, bounces, lowest: 1.5 * side };
        scene.limit_energy()?;
        Ok(scene)
    }

    /// Slows everything down until not even the lightest body can move further in a step than [`FURTHEST_WAY`].
    fn limit_energy(&mut self) -> Result<()> {
        let lightest = self.bodies.iter().map(|&body| self.simulator[body].mass()).fold(f32::MAX, f32::min);
        let way = FURTHEST_WAY.min(self.room.map_or(f32::MAX, |room| PART_OF_ROOM * room));
        let fastest = f64::from(way / self.dt);
        let most = 0.5 * f64::from(lightest) * fastest * fastest;
        let share = (most / self.energy()).min(1.0) as f32;
        self.simulator.set_gravity(share * self.simulator.gravity())?;
        for &body in &self.bodies {
            let body = &mut self.simulator[body];
            body.set_linear_velocity(share.sqrt() * body.linear_velocity());
            body.set_angular_velocity(share.sqrt() * body.angular_velocity());
        }
        Ok(())
    }

    /// Of motion, and of height above the lowest place of a room.
    pub(super) fn energy(&self) -> f64 {
        let gravity = self.simulator.gravity();
        let strength = f64::from(gravity.norm());
        let of = |&body: &BodyId| {
            let body = &self.simulator[body];
            let [x, y] = [body.linear_velocity().x, body.linear_velocity().y].map(f64::from);
            let spin = f64::from(body.angular_velocity());
            let depth = f64::from(body.position().dot(&gravity));
            let height = strength * f64::from(self.lowest) - depth;
            f64::from(body.mass()) * (0.5 * (x * x + y * y) + height)
                + 0.5 * f64::from(body.moment_of_inertia()) * spin * spin
        };
        self.bodies.iter().map(of).sum()
    }

    /// How far the centre of a body is behind the face of a wall; less than nothing in the open.
    pub(super) fn depth(&self, body: BodyId) -> f32 {
        let position = self.simulator[body].position();
        self.room.map_or(f32::NEG_INFINITY, |room| position.x.abs().max(position.y.abs()) - room)
    }
}

/// A body with a geom, and how far that reaches.
struct Thing {
    body: BodyId,
    reach: f32,
}

fn create_body(simulator: &mut PhysicsSimulator, bounces: bool, random: &mut Random) -> Result<Thing> {
    let (size, mass) = (log_between(random, SIZES), log_between(random, MASSES));
    let place = GeomPlacement::default();
    let (body, geom, reach) = if random.chance(30) {
        let edges = 8 + random.below(20) as i32;
        let body = BodyFactory::create_circle_body_in(simulator, 0.5 * size, mass)?;
        (body, GeomFactory::create_circle_geom_in(simulator, body, 0.5 * size, edges, place)?, 0.5 * size)
    } else {
        let mut outline = random.pick(OUTLINES)(random);
        outline.scale(Vector2::new(0.5 * size, 0.5 * size));
        let body = BodyFactory::create_polygon_body_in(simulator, &outline, mass)?;
        let geom = GeomFactory::create_polygon_geom_in(simulator, body, &mut outline, place)?;
        (body, geom, outline.iter().map(|corner| corner.norm()).fold(0.0, f32::max))
    };
    set_surface(simulator, geom, surface(bounces, random));
    simulator[body].set_linear_drag_coefficient(0.0);
    simulator[body].set_rotational_drag_coefficient(0.0);
    Ok(Thing { body, reach })
}

fn set_surface(simulator: &mut PhysicsSimulator, geom: GeomId, (friction, restitution): (f32, f32)) {
    simulator[geom].set_friction_coefficient(friction);
    simulator[geom].set_restitution_coefficient(restitution);
}

/// Friction and restitution: 0 and 1 are frequent.
fn surface(bounces: bool, random: &mut Random) -> (f32, f32) {
    let between = random.between(0.0, 1.0);
    let friction = random.pick(&[0.0, between, between, 1.0]);
    let between = random.between(0.0, 1.0);
    let restitution = random.pick(&[0.0, between, between, 1.0]);
    (friction, if bounces { restitution } else { 0.0 })
}

/// Outlines that reach about 1 far.
const OUTLINES: &[fn(&mut Random) -> Vertices] = &[
    |random| {
        let y = random.between(0.1, 1.0);
        corners(&[(-1.0, -y), (1.0, -y), (1.0, y), (-1.0, y)])
    },
    |random| {
        let count = 3 + random.below(7);
        (0..count).map(|corner| direction(turned(corner, count, random))).collect()
    },
    |random| {
        let (count, inner) = (6 + 2 * random.below(4), random.between(0.3, 0.7));
        let reach = |corner: usize| if corner.is_multiple_of(2) { 1.0 } else { inner };
        (0..count).map(|corner| reach(corner) * direction(turned(corner, count, random))).collect()
    },
    |random| {
        let (x, y) = (random.between(-0.7, 0.7), random.between(-0.7, 0.7));
        corners(&[(-1.0, -1.0), (1.0, -1.0), (1.0, y), (x, y), (x, 1.0), (-1.0, 1.0)])
    },
    |random| {
        let (x, y) = (random.between(0.2, 0.8), random.between(-0.8, 0.8));
        let left = [(-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (1.0, 1.0)];
        corners(&[left.as_slice(), &[(x, 1.0), (x, y), (-x, y), (-x, 1.0)]].concat())
    },
];

fn corners(corners: &[(f32, f32)]) -> Vertices {
    corners.iter().map(|&(x, y)| Vector2::new(x, y)).collect()
}

/// The angle of a corner; they are about evenly spread.
fn turned(corner: usize, count: usize, random: &mut Random) -> f32 {
    std::f32::consts::TAU * (corner as f32 + random.between(-0.3, 0.3)) / count as f32
}

fn direction(angle: f32) -> Vector2 {
    Vector2::new(angle.cos(), angle.sin())
}

/// A number of any order of magnitude.
fn log_between(random: &mut Random, (low, high): (f32, f32)) -> f32 {
    low * (high / low).powf(random.between(0.0, 1.0))
}

/// Puts bodies where their circles do not meet. Answers how far from the centre, along both axes, they end.
fn place(simulator: &mut PhysicsSimulator, things: &[Thing], random: &mut Random) -> f32 {
    let mut side = 1.1 * things.iter().map(|thing| thing.reach).fold(0.0, f32::max);
    let mut placed: Vec<(Vector2, f32)> = Vec::new();
    for &Thing { body, reach } in things {
        let position = loop {
            let most = side - reach;
            let position = Vector2::new(random.between(-most, most), random.between(-most, most));
            if placed.iter().all(|&(other, radius)| (position - other).norm() > 1.01 * (radius + reach)) {
                break position;
            }
            side *= 1.02;
        };
        placed.push((position, reach));
        simulator[body].set_position(position);
        simulator[body].set_rotation(random.between(-7.0, 7.0));
    }
    side
}

/// Four walls that overlap in the corners.
fn create_walls(simulator: &mut PhysicsSimulator, side: f32, surface: (f32, f32)) -> Result<()> {
    let (length, place) = (2.0 * side + 2.0 * THICKNESS, side + 0.5 * THICKNESS);
    for (size, position) in [
        ((length, THICKNESS), (0.0, place)),
        ((length, THICKNESS), (0.0, -place)),
        ((THICKNESS, length), (place, 0.0)),
        ((THICKNESS, length), (-place, 0.0)),
    ] {
        let body = BodyFactory::create_rectangle_body_in(simulator, size.0, size.1, 1.0)?;
        simulator[body].set_is_static(true);
        simulator[body].set_position(Vector2::new(position.0, position.1));
        let place = GeomPlacement::default();
        let geom = GeomFactory::create_rectangle_geom_in(simulator, body, size.0, size.1, place)?;
        set_surface(simulator, geom, surface);
    }
    Ok(())
}

/// Gives bodies their velocities: towards the others in the open, so that they meet.
fn throw(simulator: &mut PhysicsSimulator, things: &[Thing], has_room: bool, random: &mut Random) {
    let fastest = log_between(random, SPEEDS);
    for &Thing { body, reach } in things {
        let speed = random.between(0.0, fastest);
        let direction = match simulator[body].position() {
            position if !has_room && position.norm() > 0.0 => -position.normalize(),
            _ => direction(random.between(-4.0, 4.0)),
        };
        simulator[body].set_linear_velocity(speed * direction);
        simulator[body].set_angular_velocity(random.between(-speed, speed) / reach);
    }
}
