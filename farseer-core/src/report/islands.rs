//! The types with which the API describes islands, and tells why a body is awake.

use crate::body::BodyId;
use farseer_precise::island_report::{IslandCost, IslandSolver, SolverReason};

/// Reason why a body is awake: see [`PhysicsSimulator::why_awake`](crate::PhysicsSimulator::why_awake).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum AwakeReason {
    /// Sleeping is [switched off](crate::PhysicsSimulator::set_sleep_enabled), or the simulator uses the faithful set.
    SleepDisabled,
    /// The body is static or kinematic, or is not simulated (disabled or removed): it never sleeps.
    NeverSleeps,
    /// The body, or a hinged platform that leans on it, moves too fast.
    Moves {
        /// Speed below which the body counts as at rest, length units/s.
        limit: f32,
    },
    /// The body is at rest, but contacts, joints or springs connect it with a body that is not at rest.
    HangsTogether {
        /// The body of the island that is not at rest.
        with: BodyId,
    },
    /// All bodies of the island are at rest, but not for long enough, or the load adaptation of its contacts has not ended.
    ///
    /// Bodies that a motor, belt or kinematic body moves slowly have their rest time reset in each update.
    RestsSince {
        /// Time for which the body has been at rest, seconds.
        seconds: f32,
        /// Rest time after which the island sleeps, seconds.
        needed: f32,
    },
}

/// Set of dynamic bodies that contacts, joints or springs connect: see
/// [`PhysicsSimulator::islands`](crate::PhysicsSimulator::islands).
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Island {
    /// The bodies of the island, in the order of the simulator's list.
    pub bodies: Vec<BodyId>,
    /// Whether the island sleeps.
    pub is_asleep: bool,
    /// Whether the direct solver solved the island in the last update; false if it was the iterative one: see
    /// [`Methods::Precise`](crate::Methods::Precise).
    pub is_solved_whole: bool,
    /// The solver of the island in the last update.
    pub method: IslandSolver,
    /// The reason why the island had its solver in the last update.
    pub why: SolverReason,
    /// The cost of solving the island in the last update.
    pub cost: IslandCost,
}
