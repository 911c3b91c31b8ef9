//! Small scenes of the precise set: a few bodies of any outline, size and mass, in a closed room or without walls.

use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, GeomFactory, GeomId, GeomPlacement, Methods, PhysicsSimulator, Result, Vertices,
};

use crate::random::Random;

/// Greatest number of bodies of a scene.
const MOST_BODIES: usize = 12;
/// Least and greatest size of a body, px.
const SIZES: (f32, f32) = (1.0, 1000.0);
/// Least and greatest mass of a body, mass units.
const MASSES: (f32, f32) = (0.01, 100.0);
/// Least and greatest value of two limits: the speed of bodies at the start in px/s, and gravity in px/s^2.
const SPEEDS: (f32, f32) = (1.0, 1000.0);
const GRAVITIES: (f32, f32) = (10.0, 2000.0);
/// Lengths of a step, s. `SUBSTEPS` holds numbers of substeps.
const STEPS: [f32; 4] = [1.0 / 30.0, 1.0 / 60.0, 1.0 / 60.0, 1.0 / 120.0];
const SUBSTEPS: [i32; 4] = [2, 4, 4, 8];
/// Percent of the scenes that have a room around the bodies. `GRAVITY_PERCENT` of the scenes with a room have gravity.
const ROOM_PERCENT: u64 = 75;
const GRAVITY_PERCENT: u64 = 60;
/// Greatest displacement of a body in a step, px, and as a fraction of the room. It is that of the lightest body if it has all
/// the energy of the scene.
///
/// CCD is off here. A body that reaches a wall at this speed may be as deep in the wall after the step. The solver pushes it
/// back through the nearer side: walls are [`WALL_THICKNESS`] thick. The body must not reach the opposite wall meanwhile,
/// because the motion of a body that is in two walls at once, step after step, is undefined.
const MAX_DISPLACEMENT: f32 = 500.0;
const MAX_DISPLACEMENT_FRACTION: f32 = 0.25;
/// Thickness of walls, px. Half of it is twice the greatest displacement, so that fourfold energy still lets no body through.
const WALL_THICKNESS: f32 = 4.0 * MAX_DISPLACEMENT;

/// A scene, and the data by which its invariants are judged.
pub(super) struct Scene {
    pub(super) simulator: PhysicsSimulator,
    pub(super) bodies: Vec<BodyId>,
    /// Distance from the centre of the room to the face of each wall, px; `None` in a scene without walls.
    pub(super) room: Option<f32>,
    pub(super) dt: f32,
    /// Whether geoms of the scene have restitution.
    pub(super) bounces: bool,
    /// Lowest possible height of a body, px, measured against gravity from the centre of the room.
    pub(super) lowest: f32,
}

impl Scene {
    /// Returns the scene of a seed.
    pub(super) fn new(seed: u64) -> Result<Self> {
        let mut random = Random::new(seed.wrapping_mul(0x5851_f42d_4c95_7f2d));
        let mut simulator = PhysicsSimulator::new(Vector2::zeros())?;
        simulator.set_methods(Methods::PRECISE)?;
        simulator.set_iterations(random.pick(&SUBSTEPS));
        let has_room = random.chance(ROOM_PERCENT);
        // Sleep is off without walls: a body that falls asleep loses its momentum, and momentum must be conserved there.
        simulator.set_sleep_enabled(has_room);
        let bounces = random.toss();
        let things = (0..1 + random.below(MOST_BODIES))
            .map(|_| create_body(&mut simulator, bounces, &mut random))
            .collect::<Result<Vec<_>>>()?;
        let side = place(&mut simulator, &things, &mut random);
        if has_room {
            create_walls(&mut simulator, side, surface(bounces, &mut random))?;
            if random.chance(GRAVITY_PERCENT) {
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

    /// Slows all bodies down until even the lightest one cannot move further in a step than [`MAX_DISPLACEMENT`].
    fn limit_energy(&mut self) -> Result<()> {
        let lightest = self.bodies.iter().map(|&body| self.simulator[body].mass()).fold(f32::MAX, f32::min);
        let way = MAX_DISPLACEMENT.min(self.room.map_or(f32::MAX, |room| MAX_DISPLACEMENT_FRACTION * room));
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

    /// Returns the kinetic energy, and in a room the potential energy above the lowest position, mass units * px^2/s^2.
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

    /// Returns the distance, in px, of a body's centre behind the face of the nearest wall. Negative in front of it and without
    /// walls.
    pub(super) fn depth(&self, body: BodyId) -> f32 {
        let position = self.simulator[body].position();
        self.room.map_or(f32::NEG_INFINITY, |room| position.x.abs().max(position.y.abs()) - room)
    }
}

/// A body with a geom, and the greatest distance `reach` from the body's centre to the geom's surface, px.
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

/// Returns random coefficients of friction and restitution, dimensionless. 0 and 1 are frequent. Restitution is 0 if `bounces`
/// is false.
fn surface(bounces: bool, random: &mut Random) -> (f32, f32) {
    let between = random.between(0.0, 1.0);
    let friction = random.pick(&[0.0, between, between, 1.0]);
    let between = random.between(0.0, 1.0);
    let restitution = random.pick(&[0.0, between, between, 1.0]);
    (friction, if bounces { restitution } else { 0.0 })
}

/// Functions that return a random outline, whose corners are at most about 1 unit from the centre in x and y.
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

/// Returns the angle of a corner, radians. The corners are spread over the circle about evenly.
fn turned(corner: usize, count: usize, random: &mut Random) -> f32 {
    std::f32::consts::TAU * (corner as f32 + random.between(-0.3, 0.3)) / count as f32
}

fn direction(angle: f32) -> Vector2 {
    Vector2::new(angle.cos(), angle.sin())
}

/// Draws a number between `low` and `high`. Every order of magnitude between them is equally likely.
fn log_between(random: &mut Random, (low, high): (f32, f32)) -> f32 {
    low * (high / low).powf(random.between(0.0, 1.0))
}

/// Places bodies so that their circumscribed circles do not overlap. Returns half the side of the square around them, px.
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

/// Makes four walls, which overlap in the corners. `side` is the distance from the centre to each wall, px. `surface`: friction
/// and restitution.
fn create_walls(simulator: &mut PhysicsSimulator, side: f32, surface: (f32, f32)) -> Result<()> {
    let (length, place) = (2.0 * side + 2.0 * WALL_THICKNESS, side + 0.5 * WALL_THICKNESS);
    for (size, position) in [
        ((length, WALL_THICKNESS), (0.0, place)),
        ((length, WALL_THICKNESS), (0.0, -place)),
        ((WALL_THICKNESS, length), (place, 0.0)),
        ((WALL_THICKNESS, length), (-place, 0.0)),
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

/// Sets the velocities of bodies at random. Without walls the bodies move towards the centre, so that they collide.
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
