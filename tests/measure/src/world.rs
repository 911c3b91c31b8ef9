//! A scene being simulated, in whatever engine, and what is seen of it.

use conformance::run::Run;
use conformance::scene::Scene;
use farseer_core::{Body, BodyId};

/// What is seen of a body. In double precision, since it is for measuring. Scenes in the plane have y down and 0 along Z;
/// those with depth have Y up and Z into the picture.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BodyState {
    /// In px: the centre of mass, or with depth X and Z of the origin and Y of the lowest point.
    pub position: [f64; 3],
    /// In rad, clockwise on the screen: in the plane with whole turns, with depth between -pi and pi.
    pub angle: f64,
    /// Velocity of the centre of mass, or with depth of the origin, in px/s.
    pub velocity: [f64; 3],
    /// In rad/s.
    pub angular_velocity: f64,
}

impl BodyState {
    /// Of a body of the 2D engine.
    pub fn of(body: &Body) -> Self {
        let (position, velocity) = (body.position(), body.linear_velocity());
        BodyState {
            position: [position.x, position.y, 0.0].map(f64::from),
            angle: f64::from(body.total_rotation()),
            velocity: [velocity.x, velocity.y, 0.0].map(f64::from),
            angular_velocity: f64::from(body.angular_velocity()),
        }
    }

    /// X and Y of where it is.
    pub fn place(&self) -> [f64; 2] {
        [self.position[0], self.position[1]]
    }

    /// Where a point of it is that is given in its own axes.
    pub fn to_world(&self, local: [f64; 2]) -> [f64; 2] {
        let [x, y] = turned(local, self.angle);
        [self.position[0] + x, self.position[1] + y]
    }

    /// The point of it, in its own axes, that is at a place.
    pub fn to_local(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        turned([x - self.position[0], y - self.position[1]], -self.angle)
    }

    /// Speed in px/s.
    pub fn speed(&self) -> f64 {
        length(self.velocity)
    }

    /// Whether every part is finite.
    pub fn is_finite(&self) -> bool {
        let parts = self.position.iter().chain(&self.velocity).chain([&self.angle, &self.angular_velocity]);
        parts.into_iter().all(|part| part.is_finite())
    }
}

/// Distance of two points.
pub fn distance<const AXES: usize>(a: [f64; AXES], b: [f64; AXES]) -> f64 {
    length::<AXES>(std::array::from_fn(|axis| b[axis] - a[axis]))
}

fn length<const AXES: usize>(vector: [f64; AXES]) -> f64 {
    vector.into_iter().fold(0.0, f64::hypot)
}

/// Turned about the origin by an angle in rad, from x towards y.
pub fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sine, cosine) = angle.sin_cos();
    [x * cosine - y * sine, x * sine + y * cosine]
}

/// What a body can meet in a scene with depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Met {
    /// Another object, by its index in the scene.
    Object(usize),
    /// The plane Y = 0.
    Ground,
    /// A platform, by its index in the scene.
    Platform(usize),
}

impl Met {
    /// A pair with the lesser one first.
    pub fn pair(a: Met, b: Met) -> (Met, Met) {
        if a <= b { (a, b) } else { (b, a) }
    }
}

/// A scene in some engine, being stepped. Bodies are named by their index in the scene. What only scenes in the plane or
/// only scenes with depth ask for is there for those.
pub trait World {
    /// Moves everything by a time in s.
    fn step(&mut self, dt: f32);

    /// How a body is now.
    fn body(&self, index: usize) -> BodyState;

    /// How many bodies the scene has.
    fn body_count(&self) -> usize;

    /// Whether the state of everything is finite.
    fn is_finite(&self) -> bool {
        (0..self.body_count()).all(|index| self.body(index).is_finite())
    }

    /// Sets velocities in px/s and rad/s. In the plane.
    fn set_velocity(&mut self, _index: usize, _velocity: [f64; 2], _angular_velocity: f64) {
        unreachable!("nobody sets velocities in scenes with depth");
    }

    /// Changes the velocity of a body by an impulse at its centre of mass, in kg px/s. In the plane.
    fn apply_impulse(&mut self, _index: usize, _impulse: [f64; 2]) {
        unreachable!("nobody pushes in scenes with depth");
    }

    /// Puts a body elsewhere: px and rad. In the plane.
    fn teleport(&mut self, _index: usize, _position: [f64; 2], _angle: f64) {
        unreachable!("nothing is put elsewhere in scenes with depth");
    }

    /// Sets whether what has come to rest sleeps, as the engine does it by default; if not, all are awake from the next step
    /// on. Nothing sleeps until it is asked for. In the plane.
    fn set_sleep_enabled(&mut self, _is_enabled: bool) {
        unreachable!("nothing sleeps in scenes with depth");
    }

    /// Whether a body that can move sleeps. Never with depth.
    fn is_asleep(&self, _index: usize) -> bool {
        false
    }

    /// Height in px of the ground or the platform that is straight below the middle of a body; `None` if there is none,
    /// and always in the plane.
    fn height_beneath(&self, _index: usize) -> Option<f64> {
        None
    }

    /// Appends the pairs that pushed each other in the last step, each with the lesser one first. With depth.
    fn touching(&self, _pairs: &mut Vec<(Met, Met)>) {}
}

/// How hard it is to move a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyMass {
    /// In kg. What the scene says, also of a static body.
    pub mass: f64,
    /// About the centre of mass, in kg px².
    pub inertia: f64,
}

/// The masses of a scene's bodies, by index: they are the same in all engines.
///
/// # Panics
///
/// When a body of the scene cannot be built.
pub fn masses(scene: &Scene) -> Vec<BodyMass> {
    let mut bodies = Scene::empty(&scene.name, &scene.about);
    bodies.bodies.clone_from(&scene.bodies);
    let run = Run::build(&bodies).unwrap_or_else(|error| panic!("{error}"));
    let simulator = run.simulator();
    let mass = |&id: &BodyId| {
        let body = &simulator[id];
        BodyMass { mass: f64::from(body.mass()), inertia: f64::from(body.moment_of_inertia()) }
    };
    run.bodies().iter().map(mass).collect()
}
