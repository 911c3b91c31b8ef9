//! The interface of an engine that plays scenes.

use super::ours::Ours;
use super::scene::{Body, Joint, Point, Scene};
use std::error::Error;

/// Length of a step in s.
pub const DT: f32 = 1.0 / 60.0;
/// Substeps of a step, as the authors of all engines recommend.
pub(super) const SUBSTEPS: u8 = 4;

/// A refusal of an engine.
pub type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// The state of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Centre of mass in m; of a static or kinematic body its origin.
    pub position: Point,
    /// In rad, anticlockwise, from -pi to pi.
    pub angle: f32,
    /// In m/s.
    pub velocity: Point,
    /// In rad/s.
    pub spin: f32,
}

/// The work of one step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counters {
    /// Pairs of shapes that the narrow phase looked at.
    pub pairs: usize,
    /// Pairs whose manifold was computed anew, not recycled.
    pub manifolds: usize,
    /// Fat AABBs that shapes had left; nothing if the engine does not tell.
    pub aabbs: Option<usize>,
    /// Dynamic bodies that are awake; in Box2D kinematic ones too.
    pub awake: usize,
}

/// An engine with a scene in it. Bodies and joints are named by their order of creation, also after others have gone.
///
/// # Errors
/// Every method fails with what the engine refuses: a number, a shape, an object that is not there, a step.
pub trait Engine {
    /// Adds a body.
    fn add_body(&mut self, body: &Body) -> Result<()>;

    /// Adds a joint; `bodies` are the two that it names.
    fn add_joint(&mut self, joint: &Joint, bodies: [&Body; 2]) -> Result<()>;

    /// Removes a body, which no joint holds any more.
    fn remove_body(&mut self, index: usize) -> Result<()>;

    /// Removes a joint.
    fn remove_joint(&mut self, index: usize) -> Result<()>;

    /// Lets the next step bring a kinematic body to a position at angle 0.
    fn move_to(&mut self, index: usize, position: Point) -> Result<()>;

    /// Makes a step of [`DT`].
    fn step(&mut self) -> Result<()>;

    /// The state of a body; NaN if the engine does not tell.
    fn state(&mut self, index: usize) -> State;

    /// The work of the last step.
    fn counters(&mut self) -> Result<Counters>;
}

/// An engine that scenes can be played in.
#[derive(Debug, Clone, Copy)]
pub struct EngineEntry {
    /// Its name.
    pub name: &'static str,
    /// An empty world with the scene's gravity and rules.
    pub create: fn(&Scene) -> Result<Box<dyn Engine>>,
}

/// Name of the engine of this workspace.
pub const OURS: &str = "precise set";
/// Name of Box2D.
pub const BOX2D: &str = "Box2D";

/// The engine of this workspace, and with the feature `peers` Box2D.
pub fn engines() -> Vec<EngineEntry> {
    vec![
        EngineEntry { name: OURS, create: |scene| Ok(Box::new(Ours::new(scene)?)) },
        #[cfg(feature = "peers")]
        EngineEntry { name: BOX2D, create: |scene| Ok(Box::new(super::box2d::Box2d::new(scene)?)) },
    ]
}
