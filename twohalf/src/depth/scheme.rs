//! Depth schemes: the choice of methods for contacts in three axes.

use serde::{Deserialize, Serialize};

/// Method for contacts between objects with depth. Ground and platforms work the same with all of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[non_exhaustive]
pub enum DepthScheme {
    /// Contacts in three axes on the core's faithful methods: Farseer's pairs, contacts and sequential
    /// impulses in X and Y, and the same impulses along Z in the same iterations. Balls are spheres. Objects
    /// in one plane have every bit of the core.
    Faithful,
    /// The [precise set](farseer_core::Methods::Precise) of the core in three axes, with its contacts, sleep,
    /// islands and bounded work, and a length unit of a screen (32 px). Balls are spheres and rotate about
    /// all axes. It is more exact and several times faster than `Faithful`. This is the default.
    ///
    /// Differences from `Faithful`, besides those of the precise set itself:
    ///
    /// - Bodies come to rest and [sleep](farseer_core::PhysicsSimulator::is_asleep).
    /// - A collision is an [event](crate::Event::Collision) when it begins.
    ///   [`contacts`](crate::TwoHalfPhysicsSimulator::contacts) lists all touches.
    /// - Contacts bounce if they approach faster than 32 px/s and faster than gravity accelerates in four
    ///   steps.
    /// - Fronts and backs touch in one point, in the middle of the common area.
    /// - A handler that [filters pairs](crate::EventHandler::handles_broad_phase) is asked once the AABBs
    ///   with their margins overlap.
    /// - A body that moves farther than its own size in a step does not pass static bodies.
    #[default]
    Precise,
    /// The scheme of the thesis (3.5), for comparison. Objects whose depths differ by less than half the
    /// smaller depth meet in X and Y as outlines. All others meet along Z only, when footprints and height
    /// intervals overlap, without friction. Objects never meet in all three axes, and a ball that is met from
    /// the front is a box.
    Thesis,
}

/// The former name of [`DepthScheme`].
#[deprecated(note = "use DepthScheme")]
pub type Methods = DepthScheme;
