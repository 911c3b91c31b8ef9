//! Types of the report of islands: solver, reason and cost of each island in the last update, and the residual of its
//! constraints.

/// Solver of an island in the last update.
///
/// A spring whose ends have neither contacts nor joints connects bodies without being solved with them. So bodies of one island
/// may have different solvers. The report then names the solver that comes last in this list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum IslandSolver {
    /// No solver: the island sleeps.
    Asleep,
    /// Ballistic motion in closed form: no body has contacts or joints.
    Ballistic,
    /// Articulated-body algorithm for joints without contacts, with as many substeps as the motion needs.
    Articulated,
    /// Direct solver: all contacts and joints at once, as rigid constraints.
    Direct,
    /// Iterative solver: contacts and joints as soft constraints, in substeps.
    Iterative,
}

/// Reason for the [solver](IslandSolver) of an island in the last update.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum SolverReason {
    /// Asleep: the island has been at rest for long enough.
    AtRest,
    /// Ballistic or articulated: the island has no contacts.
    NothingTouches,
    /// Direct: the direct solver takes the island, because its solution is worth the cost.
    Pays,
    /// Direct or iterative: the game has chosen this solver for all islands.
    Chosen,
    /// Iterative: the island is a single dynamic body, on static or kinematic bodies.
    OneBody,
    /// Iterative: a joint of the island is soft, or is a revolute joint with a largest impulse, or a world with a depth axis
    /// has joints in the island.
    Joints,
    /// Iterative: two bodies approached so fast that restitution applied.
    Bounces,
    /// Iterative: a contact has rolling resistance, for which the direct solver has no row.
    RollingResistance,
    /// Iterative: a body moved faster than 0.25 length units/s at this solver selection or an earlier one.
    ///
    /// With joints: the direct solver gave the island up lately, and one of its joints has a position error.
    Moves,
    /// Iterative: the island has contact cycles and fewer than 40 bodies, which the iterative solver holds at rest.
    ///
    /// The direct solver takes such an island if its bodies were calm (at most 0.25 length units/s) when it formed, and it needs
    /// friction. That is so if it would move without, or if a contact slips although its friction is within the friction limit.
    TooSmall,
    /// Iterative: the island has more than 400 bodies and more contacts than joints. With a depth axis: the island has contact
    /// cycles and more than 24 bodies.
    TooLarge,
    /// Iterative: the direct solver gave up the island lately, and pauses.
    ///
    /// It gives up if restitution applied, the solutions took too many Newton steps or matrix products, a solution with joints
    /// was rejected, or the island spent its budget.
    Rests {
        /// Number of updates after which the direct solver may take the island again.
        updates: u8,
    },
    /// Iterative, with a depth axis: no body lies on another one of less than two thirds of its mass, or a body rolls, or a
    /// contact acts along the depth axis.
    HasDepth,
    /// Iterative: the direct solver may take the island, but was not selected yet, or could not solve the island this time.
    ///
    /// Large scenes select solvers only in every 16th update.
    NotAskedYet,
}

/// Cost of solving an island in the last update.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct IslandCost {
    /// Number of pairs of convex pieces with contact constraints in the island, speculative contacts included.
    pub rows: usize,
    /// Number of enabled joints in the island.
    pub joints: usize,
    /// Number of parts into which the solver divided the step: with the iterative solver, the number of substeps.
    pub parts: u32,
    /// Number of Newton steps of the direct solver for the island: 0 while its previous solution still holds.
    pub newton_steps: usize,
}

/// Constraint errors of an island: see `PhysicsSimulator::island_residual`.
///
/// Lengths are in the user's unit.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct IslandResidual {
    /// Largest penetration of two outlines, length units, >= 0.
    pub overlap: f32,
    /// Largest excess of the approach speed of two bodies over the speed that closes their gap in the next update, length
    /// units/s, >= 0.
    pub approach: f32,
    /// Largest position error of a joint that keeps a point, a distance or a line, length units, >= 0.
    pub gap: f32,
    /// Largest angle error of a joint that keeps only an angle, radians, >= 0.
    pub angle: f32,
}
