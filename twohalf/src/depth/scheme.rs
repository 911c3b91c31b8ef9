//! How objects meet: the choice that a simulator offers.

use serde::{Deserialize, Serialize};

/// How objects with depth meet each other. Ground and platforms are the same with all of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[non_exhaustive]
pub enum DepthScheme {
    /// Contacts in three axes on the 2D engine's own methods: Farseer's pairs, contacts and sequential impulses
    /// in X and Y, and the same impulses along Z inside the same iterations. Balls are balls. What lies in one plane has every
    /// bit of the 2D engine.
    Faithful,
    /// The [precise set](farseer_core::Methods::Precise) of the 2D engine in three axes: all of its contacts, sleep, islands and
    /// bounded work, with the lengths of a screen (32 px). Balls are balls, and turn about all axes. More exact and several times
    /// faster than `Faithful`.
    ///
    /// What is different from `Faithful`, besides what the precise set itself does otherwise: things come to rest and
    /// [sleep](farseer_core::PhysicsSimulator::is_asleep); a collision becomes an [event](crate::Event::Collision) when it begins,
    /// as with the precise set in the plane, and lasting ones are in
    /// [`contacts`](crate::TwoHalfPhysicsSimulator::contacts); what comes no faster than 32 px/s, or than gravity makes it in four
    /// steps, does not bounce; fronts and backs touch in one point, in the middle of what they have in common; handlers that
    /// [are asked about pairs](crate::EventHandler::handles_broad_phase) are asked once two boxes with their margins overlap; and
    /// nothing that is faster than its own size in a step passes what stands still.
    ///
    /// A new simulator has it.
    #[default]
    Precise,
    /// The thesis' own scheme (thesis 3.5), to compare with: objects whose depths differ by less than half the
    /// smaller depth meet in X and Y, as outlines; all others meet along Z only, when their footprints and their
    /// height intervals overlap, without friction. Nothing ever meets in all three axes, and a ball that is met
    /// from the front is a box.
    Thesis,
}

/// The former name of [`DepthScheme`].
#[deprecated(note = "use DepthScheme")]
pub type Methods = DepthScheme;
