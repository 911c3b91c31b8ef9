//! Interface of an engine that runs scenes of the arena.

use super::joint::Joint;
use super::ours::Ours;
use super::scene::{Body, Point, Scene};
use std::error::Error;

/// Length of a step in s.
pub const DT: f32 = 1.0 / 60.0;
/// Number of substeps per step, recommended by the authors of all engines.
pub(super) const SUBSTEPS: u8 = 4;

/// Result of a call to an engine; the error is the engine's reason for refusal.
pub type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// State of a body: position, angle and velocities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Centre of mass in m, y up; for static and kinematic bodies the origin of the body.
    pub position: Point,
    /// Angle in rad, anticlockwise, from -pi to pi.
    pub angle: f32,
    /// Velocity of the centre of mass in m/s, y up.
    pub velocity: Point,
    /// Angular velocity in rad/s, anticlockwise.
    pub spin: f32,
}

/// Counters of the work in one step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counters {
    /// Number of pairs of shapes that the narrow phase tested; in rapier2d pairs of touching shapes.
    pub pairs: usize,
    /// Number of pairs whose manifold was recomputed, not recycled; 0 in rapier2d, which does not count them.
    pub manifolds: usize,
    /// Number of shapes that left their fat AABB, so that it was recomputed; `None` if the engine does not count them.
    pub aabbs: Option<usize>,
    /// Number of awake dynamic bodies; in Box2D awake kinematic bodies count, too.
    pub awake: usize,
}

/// An engine with a scene. Bodies and joints are given by index in the order of creation; removal of others does not change
/// an index.
///
/// # Errors
/// Every method returns an error if the engine refuses a number, a shape, a missing object, or a step.
pub trait Engine {
    /// Adds a body with its shapes; its index is the number of bodies added before.
    fn add_body(&mut self, body: &Body) -> Result<()>;

    /// Adds a joint; `bodies` describes the two bodies that it connects, in the order of `joint.bodies`.
    fn add_joint(&mut self, joint: &Joint, bodies: [&Body; 2]) -> Result<()>;

    /// Removes a body. All joints of the body must have been removed before.
    fn remove_body(&mut self, index: usize) -> Result<()>;

    /// Removes a joint, given by index.
    fn remove_joint(&mut self, index: usize) -> Result<()>;

    /// Sets the velocity of a kinematic body so that the next step moves it to `position` (m, y up) with angle 0.
    fn move_to(&mut self, index: usize, position: Point) -> Result<()>;

    /// Advances the scene by a step of [`DT`] s.
    fn step(&mut self) -> Result<()>;

    /// Returns the state of a body; all numbers are NaN if the engine does not return it.
    fn state(&mut self, index: usize) -> State;

    /// Returns the closest hit of a ray from one point to another, both in m: the fraction of the ray's length, 0..=1; `None`
    /// without a hit.
    fn cast_ray(&mut self, from: Point, to: Point) -> Result<Option<f32>>;

    /// Returns the number of shapes whose AABBs overlap a box, given by its lowest and highest corner in m. AABBs that an
    /// engine has enlarged count as they are.
    fn count_in_box(&mut self, low: Point, high: Point) -> Result<usize>;

    /// Returns the counters of the last step.
    fn counters(&mut self) -> Result<Counters>;
}

/// An engine with the function that creates it.
#[derive(Debug, Clone, Copy)]
pub struct EngineEntry {
    /// Name of the engine in tables.
    pub name: &'static str,
    /// Creates an empty world with the gravity, sleep and friction rules of a scene.
    pub create: fn(&Scene) -> Result<Box<dyn Engine>>,
}

/// Name of the engine of this workspace in tables.
pub const OURS: &str = "precise set";
/// Name of Box2D in tables.
pub const BOX2D: &str = "Box2D";

/// Name of rapier in tables.
pub const RAPIER: &str = "rapier2d";

/// Returns the engine of this workspace and, with the feature `peers`, Box2D and rapier.
pub fn engines() -> Vec<EngineEntry> {
    vec![
        EngineEntry { name: OURS, create: |scene| Ok(Box::new(Ours::new(scene)?)) },
        #[cfg(feature = "peers")]
        EngineEntry { name: BOX2D, create: |scene| Ok(Box::new(super::box2d::Box2d::new(scene)?)) },
        #[cfg(feature = "peers")]
        EngineEntry { name: RAPIER, create: |scene| Ok(Box::new(super::rapier::Rapier::new(scene))) },
    ]
}
