//! A scene in an engine, and the states of its bodies for measurements.

use conformance::run::Run;
use conformance::scene::Scene;
use farseer_core::{Body, BodyId};

/// State of a body, in double precision for measurements. In scenes in the plane y points down and z is 0; in scenes with
/// depth Y points up and Z into the picture.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BodyState {
    /// Position in px. In the plane: centre of mass. With depth: X and Z of the body's origin, and Y of its lowest point.
    pub position: [f64; 3],
    /// Angle in rad, clockwise on the screen. In the plane full turns are included; with depth it is between -pi and pi.
    pub angle: f64,
    /// Velocity in px/s: of the centre of mass in the plane, of the body's origin with depth.
    pub velocity: [f64; 3],
    /// Angular velocity in rad/s, clockwise on the screen.
    pub angular_velocity: f64,
}

impl BodyState {
    /// Returns the state of a body of the 2D engine.
    pub fn of(body: &Body) -> Self {
        let (position, velocity) = (body.position(), body.linear_velocity());
        BodyState {
            position: [position.x, position.y, 0.0].map(f64::from),
            angle: f64::from(body.total_rotation()),
            velocity: [velocity.x, velocity.y, 0.0].map(f64::from),
            angular_velocity: f64::from(body.angular_velocity()),
        }
    }

    /// Returns x and y of the position, in px.
    pub fn position_in_plane(&self) -> [f64; 2] {
        [self.position[0], self.position[1]]
    }

    /// Returns the world position in px of a point given in the body's local coordinates, in px.
    pub fn to_world(&self, local: [f64; 2]) -> [f64; 2] {
        let [x, y] = turned(local, self.angle);
        [self.position[0] + x, self.position[1] + y]
    }

    /// Returns the point at a world position (px) in the body's local coordinates, in px.
    pub fn to_local(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        turned([x - self.position[0], y - self.position[1]], -self.angle)
    }

    /// Returns the magnitude of the velocity in px/s.
    pub fn speed(&self) -> f64 {
        length(self.velocity)
    }

    /// Returns whether all components are finite.
    pub fn is_finite(&self) -> bool {
        let parts = self.position.iter().chain(&self.velocity).chain([&self.angle, &self.angular_velocity]);
        parts.into_iter().all(|part| part.is_finite())
    }
}

/// Returns the distance of two points, in the unit of length of both.
pub fn distance<const AXES: usize>(a: [f64; AXES], b: [f64; AXES]) -> f64 {
    length::<AXES>(std::array::from_fn(|axis| b[axis] - a[axis]))
}

fn length<const AXES: usize>(vector: [f64; AXES]) -> f64 {
    vector.into_iter().fold(0.0, f64::hypot)
}

/// Returns a vector rotated about the origin by `angle` in rad, from x towards y.
pub fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sine, cosine) = angle.sin_cos();
    [x * cosine - y * sine, x * sine + y * cosine]
}

/// The other side of a contact in a scene with depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ContactPartner {
    /// An object, by its index in the scene.
    Object(usize),
    /// The ground plane Y = 0.
    Ground,
    /// A platform, by its index in the scene.
    Platform(usize),
}

impl ContactPartner {
    /// Returns both partners of a contact, with the lesser one first.
    pub fn pair(a: ContactPartner, b: ContactPartner) -> (ContactPartner, ContactPartner) {
        if a <= b { (a, b) } else { (b, a) }
    }
}

/// A scene in an engine that is stepped. Bodies are given by index in the scene. Some engines support only scenes in the
/// plane or only scenes with depth.
pub trait World {
    /// Advances the world by a step of `dt` s.
    fn step(&mut self, dt: f32);

    /// Returns the present state of a body.
    fn body(&self, index: usize) -> BodyState;

    /// Returns the number of bodies of the scene.
    fn body_count(&self) -> usize;

    /// Returns whether the states of all bodies are finite.
    fn is_finite(&self) -> bool {
        (0..self.body_count()).all(|index| self.body(index).is_finite())
    }

    /// Sets velocity (px/s) and angular velocity (rad/s) of a body. Only in scenes in the plane.
    fn set_velocity(&mut self, _index: usize, _velocity: [f64; 2], _angular_velocity: f64) {
        unreachable!("nobody sets velocities in scenes with depth");
    }

    /// Applies an impulse to a body at its centre of mass, in kg px/s. Only in scenes in the plane.
    fn apply_impulse(&mut self, _index: usize, _impulse: [f64; 2]) {
        unreachable!("nobody pushes in scenes with depth");
    }

    /// Sets position (px) and angle (rad) of a body. Only in scenes in the plane.
    fn teleport(&mut self, _index: usize, _position: [f64; 2], _angle: f64) {
        unreachable!("nothing is put elsewhere in scenes with depth");
    }

    /// Enables or disables sleep by the engine's default rule. If it is disabled, all bodies are awake from the next step
    /// on. At the start it is disabled. Only in scenes in the plane.
    fn set_sleep_enabled(&mut self, _is_enabled: bool) {
        unreachable!("nothing sleeps in scenes with depth");
    }

    /// Returns whether a dynamic body sleeps; always false in scenes with depth.
    fn is_asleep(&self, _index: usize) -> bool {
        false
    }

    /// Returns the height in px of the ground or platform vertically below the middle of a body. `None` if there is none,
    /// and in scenes in the plane.
    fn height_beneath(&self, _index: usize) -> Option<f64> {
        None
    }

    /// Appends the pairs of contact partners with an impulse in the last step, in each pair the lesser one first. Only in
    /// scenes with depth.
    fn touching(&self, _pairs: &mut Vec<(ContactPartner, ContactPartner)>) {}
}

/// Mass and moment of inertia of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyMass {
    /// Mass in kg as given in the scene, also for static bodies.
    pub mass: f64,
    /// Moment of inertia about the centre of mass, in kg px².
    pub inertia: f64,
}

/// Returns mass and moment of inertia of all bodies of a scene, by index; they are equal in all engines.
///
/// # Panics
///
/// A body of the scene cannot be built.
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
