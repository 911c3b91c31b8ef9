//! A scene being simulated, in whatever engine, and what is seen of it.

use conformance::run::Run;
use conformance::scene::Scene;
use farseer_core::BodyId;

/// What is seen of a body. In double precision, since it is for measuring.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BodyState {
    /// Centre of mass in px, y down.
    pub position: [f64; 2],
    /// Total angle in rad, whole turns included, clockwise on the screen.
    pub angle: f64,
    /// Velocity of the centre of mass in px/s.
    pub velocity: [f64; 2],
    /// In rad/s.
    pub angular_velocity: f64,
}

impl BodyState {
    /// Speed in px/s.
    pub fn speed(&self) -> f64 {
        self.velocity[0].hypot(self.velocity[1])
    }

    /// Whether every part is finite.
    pub fn is_finite(&self) -> bool {
        let parts = [self.position[0], self.position[1], self.angle, self.velocity[0], self.velocity[1]];
        parts.iter().all(|part| part.is_finite()) && self.angular_velocity.is_finite()
    }
}

/// A scene in some engine, being stepped. Bodies are named by their index in the scene.
pub trait World {
    /// Moves everything by a time in s.
    fn step(&mut self, dt: f32);

    /// How a body is now.
    fn body(&self, index: usize) -> BodyState;

    /// How many bodies the scene has.
    fn body_count(&self) -> usize;

    /// Sets velocities in px/s and rad/s.
    fn set_velocity(&mut self, index: usize, velocity: [f64; 2], angular_velocity: f64);

    /// Changes the velocity of a body by an impulse at its centre of mass, in kg px/s.
    fn apply_impulse(&mut self, index: usize, impulse: [f64; 2]);

    /// Puts a body elsewhere: px and rad.
    fn teleport(&mut self, index: usize, position: [f64; 2], angle: f64);
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
