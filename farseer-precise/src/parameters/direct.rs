//! Parameters of the direct solver: accepted solutions, augmented Lagrangian, solver selection and cost model.
//!
//! Lengths and speeds are multiples of the length unit. "Value chosen" marks values without a recorded derivation or
//! measurement.

/// Greatest geometric stiffness of a body that a step integrates explicitly, as a fraction of I + m r^2. Here I is the moment
/// of inertia, m the mass and r the longest joint arm of the body. Implicit integration takes the excess. Unit: dimensionless.
///
/// The geometric stiffness is the sum of (arm . force) * dt^2 over the joints of the body. A spring under tension is compared
/// with the effective mass of its transverse row instead. Value chosen; its sensitivity is not measured.
pub(crate) const STABLE_STIFFNESS: f64 = 0.3;

/// Length that one radian counts as where errors of rows are compared in islands with joints: radius of a body a little smaller
/// than a length unit. Unit: length units.
pub(crate) const ERROR_ARM: f64 = 0.3;

/// Absolute term of the greatest velocity residual that an accepted solution of an island with joints may have.
/// [`ACCEPTED_RESIDUAL_FRACTION`] of the initial residual is added. Unit: length units/s. Value chosen; its sensitivity is not
/// measured.
pub(crate) const ACCEPTED_RESIDUAL: f64 = 0.05;

/// Relative term of the greatest velocity residual that an accepted solution of an island with joints may have: fraction of the
/// initial residual, added to [`ACCEPTED_RESIDUAL`]. Unit: dimensionless. Value chosen; its sensitivity is not measured.
pub(crate) const ACCEPTED_RESIDUAL_FRACTION: f64 = 0.02;

/// Greatest position error of a joint in an accepted solution. Unit: length units. Value chosen; its sensitivity is not
/// measured.
pub(crate) const ACCEPTED_JOINT_ERROR: f64 = 0.02;

/// Least decrease of a joint error above [`ACCEPTED_JOINT_ERROR`] in one step, as a fraction of the largest position correction
/// of a step. Unit: dimensionless.
///
/// With less progress the joints contradict each other or are pulled too far. The island then goes to the iterative solver,
/// whose soft constraints find a compromise. Value chosen; its sensitivity is not measured.
pub(crate) const JOINT_ERROR_PROGRESS: f64 = 0.1;

/// Fraction of a penetration that is resolved per second in islands with joints. Unit: 1/s. Bodies of a figure that overlap
/// permanently contradict its joints: resolved at the speed for unjointed bodies, they throw the figure about. Measured
/// together with [`JOINTED_PENETRATION_SPEED`], some 30 pairs of values on 1,200 random figures: faster pairs throw more
/// figures, slower pairs leave landings deep.
pub(crate) const JOINTED_PENETRATION_RATE: f64 = 3.0;

/// Minimum speed at which penetration is resolved in islands with joints. Unit: length units/s. Measured together with
/// [`JOINTED_PENETRATION_RATE`].
pub(crate) const JOINTED_PENETRATION_SPEED: f64 = 0.03;

/// Fraction of its correction below which the separation of a contact point shows that joints or other contacts hold the
/// penetration. Unit: dimensionless, at most 1. Joint rows are a thousand times as stiff as contact rows
/// ([`JOINT_ROW_COMPLIANCE`], [`FIRST_COMPLIANCE`]). So a point that joints hold separates by a thousandth of its correction,
/// one that a second contact holds by half, and a free one by nearly all of it. Measured on 4,200 random figures: from 0.1 to
/// 0.8 fewer of them gape or do not rest than without the test, fewest with 0.5.
pub(crate) const HELD_SEPARATION_FRACTION: f64 = 0.5;

/// Compliance of joint rows in a position correction that joints would press into a static or kinematic body, as a fraction of
/// the inverse effective mass of the row. Unit: dimensionless.
///
/// Derived: let a joint with the error e pull at the angle a against a wall. It moves the body by e sin a / (c + sin^2 a) along
/// the wall, for the compliance c. That is at most e / (2 sqrt c), so that with this value no displacement exceeds the error.
/// Nearly rigid rows would throw the body along the wall.
pub(crate) const PRESSING_JOINT_COMPLIANCE: f64 = 0.25;

/// Most further solutions of a position correction, each without the held points of the one before. Unit: dimensionless, a
/// count. Measured: tracked vehicles come to rest with 2 or more, and more than 4 make no difference.
pub(crate) const HELD_POINT_SOLUTIONS: usize = 4;

/// Greatest rotation of a body within a step of an accepted solution. Unit: radians. The rows use the Jacobian from the
/// beginning of the step, so larger rotations make the solution wrong. Value chosen; its sensitivity is not measured.
pub(crate) const ACCEPTED_ROTATION: f64 = 0.5;

/// Greatest kinetic energy of an island in an accepted solution: a multiple of its kinetic energy without constraints, and an
/// addition to it. Unit: dimensionless; twice the energy divided by the mass of the island, length units^2/s^2.
///
/// The addition is the square of 0.1 length units/s: slow islands pass the energy test by it. Values chosen; their sensitivity is
/// not measured.
pub(crate) const ACCEPTED_ENERGY_GAIN: [f64; 2] = [1.05, 0.01];

/// Greatest speed of a body in an accepted solution of an island of contacts: a multiple of the greatest speed in the island
/// without contacts, and an addition to it. Unit: dimensionless; length units/s.
///
/// Derived for a central impact: a heavy body gives a light one at most twice its speed, if it is elastic. A lever may give more,
/// and then goes to the iterative solver. The addition is the speed at which
/// contacts resolve penetration, [`PENETRATION_RECOVERY_MAX_SPEED`](super::contacts::PENETRATION_RECOVERY_MAX_SPEED).
pub(crate) const ACCEPTED_SPEED_GAIN: [f64; 2] = [2.0, 3.0];

/// As [`ACCEPTED_ENERGY_GAIN`], for an interval of a free articulation, where a repetition in shorter intervals may gain less.
/// Unit: dimensionless; twice the energy divided by the mass of the island, length units^2/s^2.
///
/// Measured on 84 chains of 2 to 20 ropes with 10 to 1,000 times the mass at the end, 20 s each. With 1.05 and 0.01 six gain 1 to 3
/// % of energy, with these values one; with 1.003 none, but three gape by 2 cm because no interval is accepted.
pub(crate) const INTERVAL_ENERGY_GAIN: [f64; 2] = [1.01, 0.001];

/// Most position corrections of a step. Unit: dimensionless, a count. Value chosen; its sensitivity is not measured.
pub(crate) const POSITION_CORRECTIONS: usize = 3;

/// Greatest position error that the second and third position correction of a step leave, as a multiple of the error that the
/// first one leaves (the penetration slop). Unit: dimensionless. Value chosen; its sensitivity is not measured.
pub(crate) const CORRECTION_ERROR_RATIO: f64 = 10.0;

/// Most halvings of a position correction that has increased the greatest position error. Unit: dimensionless, a count. Value
/// chosen; its sensitivity is not measured.
pub(crate) const CORRECTION_HALVINGS: i32 = 4;

/// Rotation of a body within the step above which a position correction uses new Jacobians. Unit: radians. Value chosen; its
/// sensitivity is not measured.
pub(crate) const JACOBIAN_ROTATION: f64 = 0.002;

/// Most solutions per interval of the step of a free articulation. Unit: dimensionless, a count. Each solution corrects the
/// linearisation error of the previous one. It leaves a fraction of that error which is about the rotation of the fastest body
/// in the interval, in radians.
pub(crate) const ARTICULATION_SOLUTIONS: usize = 4;

/// Most intervals of a free articulation as a multiple of the planned number, where its step is repeated. Unit: dimensionless, a
/// count.
///
/// A chain of ropes that snaps taut between a heavy end and its support needs them. Measured on 64 chains with 1 to 1,000 times
/// the mass: without repetitions two gape by 2 and 5 cm, with them none; four times the number was enough in each step.
pub(crate) const MAX_INTERVAL_FACTOR: u32 = 16;

/// Penetration above which a contact point without an impulse is corrected, as a multiple of the penetration slop, which is the
/// threshold of points with an impulse. Unit: dimensionless. Value chosen; its sensitivity is not measured.
pub(crate) const UNLOADED_POINT_DEPTH: f64 = 100.0;

/// Mass ratio above which a body counts as heavy. Unit: dimensionless. Value chosen; its sensitivity is not measured.
pub(crate) const HEAVY_MASS_RATIO: f32 = 1.5;

/// Least square of the vertical component of a unit contact normal at which one body lies on the other. Unit: dimensionless, at
/// most 1. The value is cos^2 of 60 degrees, the steepest slope.
pub(crate) const SUPPORT_NORMAL_SQUARED: f32 = 0.25;

/// Most bodies of an island with contact cycles that the direct solver takes because of mass ratios. It holds for
/// islands in 2.5D, and for islands in 2D whose mass ratio may jam them. Unit: dimensionless, a count. Value chosen; its
/// sensitivity is not measured.
pub(crate) const CYCLIC_DEPTH_ISLAND_BODIES: u32 = 24;

/// Newton steps per update, averaged, above which an island pauses in the iterative solver. It holds for islands
/// in 2.5D, and for islands in 2D whose mass ratio may jam them. Unit: dimensionless, a count. Value chosen; its sensitivity is
/// not measured.
pub(crate) const DEPTH_NEWTON_LIMIT: f32 = 40.0;

/// Most Gauss-Seidel sweeps over friction along the depth axis. Unit: dimensionless, a count. After a warm start one sweep is
/// mostly enough; a heavy body that lands on a light one needs many.
pub(crate) const LATERAL_FRICTION_SWEEPS: usize = 400;

/// Greatest velocity change by a sweep of friction along the depth axis at which the sweeps end. Unit: length units/s. Value
/// chosen; its sensitivity is not measured.
pub(crate) const LATERAL_FRICTION_CONVERGED: f64 = 3e-7;

/// Slip speed along the depth axis above which the friction cone is divided between the plane and the depth axis. Unit: length
/// units/s. Below this speed the friction row in the plane may use the whole friction limit, so that friction can stick. Value
/// chosen; its sensitivity is not measured.
pub(crate) const LATERAL_SLIP_MIN_SPEED: f64 = 1.0 / 64.0;

/// Compliance of contact rows in the first round of the augmented Lagrangian method, as a fraction of the inverse effective
/// mass of the row. Unit: dimensionless. Stiffer rows yield less, but their active set is harder to find. Value chosen; its
/// sensitivity is not measured.
pub(crate) const FIRST_COMPLIANCE: f64 = 1e-3;

/// Factor by which the compliance changes from one round to the next if a round needed a single Newton step. Unit:
/// dimensionless, at most 1. Value chosen; its sensitivity is not measured.
pub(crate) const COMPLIANCE_FACTOR: f64 = 0.25;

/// Compliance of contact rows below which rounds do not reduce it any more, as a fraction of the inverse effective mass of the
/// row. Unit: dimensionless. A round with less compliance is a stiff round. Value chosen; its sensitivity is not measured.
pub(crate) const LEAST_COMPLIANCE: f64 = 6e-5;

/// Compliance of contact rows in the first round of an island at rest with contact cycles, as a fraction of the inverse
/// effective mass of the row. Unit: dimensionless. At rest the active set hardly changes, so rows can be stiff. In cycles stiff
/// rows of a wrong active set can press each other without limit. Value chosen; its sensitivity is not measured.
pub(crate) const RESTING_COMPLIANCE: f64 = 1e-5;

/// Compliance of contact rows in the first round of an island without contact cycles, at rest or on a cold start, as a fraction
/// of the inverse effective mass of the row. Unit: dimensionless.
///
/// Without cycles each row carries the load above it and no more. A tall column needs such stiffness, since its slow swaying is
/// far softer than one of its rows. Value chosen; its sensitivity is not measured.
pub(crate) const ACYCLIC_COMPLIANCE: f64 = 1e-8;

/// Most Newton steps of a stiff round. Unit: dimensionless, a count. A stiff round that needs more steps began with a wrong
/// active set. Value chosen; its sensitivity is not measured.
pub(crate) const STIFF_ROUND_STEPS: usize = 4;

/// Velocity residual at which a stiff round that has not converged counts as failed, as a fraction of the initial residual.
/// Unit: dimensionless, at most 1. The solution then starts again with [`FIRST_COMPLIANCE`]. Value chosen; its sensitivity is
/// not measured.
pub(crate) const STIFF_ROUND_RESIDUAL: f64 = 0.5;

/// Most Newton steps of one round of the augmented Lagrangian method. Unit: dimensionless, a count. Value chosen; its
/// sensitivity is not measured.
pub(crate) const ROUND_NEWTON_STEPS: usize = 25;

/// Most Newton steps of an island without contacts that are taken in full, without a line search, although the active set changes.
/// Unit: dimensionless, a count.
///
/// A full step finds the next active set at once, as in the primal-dual active set strategy (M. Hintermüller and others, 2003:
/// see `island_newton`). The line search ends where the first slack rope becomes taut, so that a chain of 40 ropes needs 40
/// steps. Measured on 64 chains of 3 to 40 ropes: without full steps seven fail and gape by 0.02 to 0.45 m; from 5 on two. The
/// time falls by a third.
pub(crate) const FULL_NEWTON_STEPS: usize = 8;

/// Most rounds of the augmented Lagrangian method in the solution of one island, including one stiff round. Unit:
/// dimensionless, a count. Value chosen; its sensitivity is not measured.
pub(crate) const SOLUTION_ROUNDS: usize = 7;

/// Velocity residual of a round, as a fraction of the smallest one before, below which the round counts as an improvement.
/// Unit: dimensionless, at most 1. A solution may end at [`SOLVED_VELOCITY_ERROR`] after a round without improvement; else it
/// continues down to [`EXACT_VELOCITY_ERROR`]. Value chosen; its sensitivity is not measured.
pub(crate) const ROUND_PROGRESS: f64 = 0.25;

/// Greatest change of a velocity error in a Newton step that ends its round, as a fraction of the tolerance of the
/// round. Unit: dimensionless, at most 1. Value chosen; its sensitivity is not measured.
pub(crate) const NEWTON_STEP_TOLERANCE: f64 = 0.1;

/// Greatest change of a velocity error in a full Newton step that ends its round in a moving island with contact cycles and no
/// joints, as a fraction of [`CYCLIC_VELOCITY_ERROR`]. Unit: dimensionless, at most 1.
///
/// Such a round is solved for frozen friction limits, and the solution ends as soon as its residual is that error. Smaller
/// steps exchange single rows of the active set without reducing the residual. Measured on eight card houses of 20 to 260
/// cards: 1,098, 1,046, 962, 871 and 968 Newton steps until they rest with 0.1, 0.2, 0.3, 0.5 and 1, and 1,230 with
/// [`NEWTON_STEP_TOLERANCE`] alone. Of 50 houses of two to six storeys, at ten lengths of the update, none topples with 0.05 and
/// 0.1, four with 0.2, two with 0.3, and one with [`NEWTON_STEP_TOLERANCE`] alone.
pub(crate) const CYCLIC_STEP_TOLERANCE: f64 = 0.1;

/// Most Newton steps in the solution of one island without joints in one update. Unit: dimensionless, a count. Value chosen;
/// its sensitivity is not measured.
pub(crate) const SOLUTION_NEWTON_STEPS: usize = 100;

/// Most Newton steps in the solution of one island without joints, with contact cycles, on a cold start. Unit: dimensionless, a
/// count. Twice as many steps improve the solution little. The following updates continue the solution, and no update should
/// take much longer than others.
pub(crate) const FRESH_SOLUTION_NEWTON_STEPS: usize = 10;

/// Most Newton steps in the solution of one island with a budget of contact cycles whose bodies came together in motion. Unit:
/// dimensionless, a count. The next update has another active set, so that further steps do not repay their cost. Measured: a wall of
/// 131 boxes that falls takes 295 and 115 million instructions with 100 and 12.
pub(crate) const MOVING_SOLUTION_NEWTON_STEPS: usize = 12;

/// Greatest compliance of joint rows, as a fraction of the inverse effective mass of the row. Unit: dimensionless. Measured on
/// chains of hundreds of bodies: with 1e-7 the digits of `f64` begin to run out, with 1e-9 they are gone.
pub(crate) const JOINT_ROW_COMPLIANCE: f64 = 1e-6;

/// Weight of the velocity residual of friction rows where the rounds of an island with joints are compared. Unit:
/// dimensionless, at most 1. Value chosen; its sensitivity is not measured.
pub(crate) const FRICTION_RESIDUAL_WEIGHT: f64 = 0.1;

/// Relative difference of a friction limit to Coulomb's law at which the limit has converged, in islands with joints. Unit:
/// dimensionless. Value chosen; its sensitivity is not measured.
pub(crate) const FRICTION_LIMIT_CONVERGED: f64 = 1e-3;

/// Number of rounds after which the solution of an island with joints may end although its friction limits have not converged.
/// Unit: dimensionless, a count. Value chosen; its sensitivity is not measured.
pub(crate) const FRICTION_LIMIT_ROUNDS: usize = 4;

/// Number of Gauss-Seidel sweeps over all rows of an island that follow a solution which is not acceptable. Unit:
/// dimensionless, a count. Value chosen; its sensitivity is not measured.
pub(crate) const ISLAND_SWEEPS: usize = 8;

/// Most iterations of the line search, each a Newton step or a bisection. Unit: dimensionless, a count. Value chosen; its
/// sensitivity is not measured.
pub(crate) const LINE_SEARCH_STEPS: usize = 20;

/// Directional derivative at the end of a full Newton step, as a fraction of the negative initial one, above which a line search
/// follows. Unit: dimensionless, at most 1. A full step that overshoots less is taken as it is. Value chosen; its sensitivity is
/// not measured.
pub(crate) const FULL_STEP_SLOPE: f64 = 0.25;

/// Fraction of the initial directional derivative at which the line search ends. Unit: dimensionless, at most 1. The curvature
/// condition of J. Nocedal and S. Wright, "Numerical Optimization" (2006), 3.1. They give 0.1 for nonlinear conjugate gradients,
/// and 0.9 for Newton directions. Measured on 4,800 random figures: with 0.1, 0.5 and 0.9 end 60, 63 and 93 with gaps of more than
/// 0.1 length units, at 9.6, 9.2 and 9.1 us per update.
pub(crate) const LINE_SEARCH_SLOPE: f64 = 0.5;

/// Relaxation of the friction limit per Newton step and per round: fraction of its distance to Coulomb's law by which it moves.
/// Unit: dimensionless, at most 1. The value 1 means no relaxation. In contact cycles normal impulses may depend on friction as
/// much as friction on them; then under-relaxation keeps the iteration from oscillating. Value chosen; its sensitivity is not
/// measured.
pub(crate) const FRICTION_LIMIT_RELAXATION: f64 = 0.5;

/// Greatest velocity residual at which an island at rest keeps its stored impulses without a solution. Unit: length units/s.
/// Value chosen; its sensitivity is not measured.
pub(crate) const RESTING_VELOCITY_ERROR: f64 = 1e-4;

/// Greatest velocity residual at which an island that moves or is driven keeps its stored impulses without a solution. There
/// are three cases: islands of contacts in the update after one with Newton steps, free articulations, and islands with joints
/// that motors, belts or kinematic bodies drive. Unit: length units/s.
///
/// Slow drives need a small value. Other islands with joints use [`RESTING_VELOCITY_ERROR`], because rounding of poses alone
/// exceeds this value.
pub(crate) const MOVING_VELOCITY_ERROR: f64 = 2e-6;

/// Velocity residual below which a solution ends if a further round improves it little. Unit: length units/s. Residuals add up
/// over updates until they exceed [`RESTING_VELOCITY_ERROR`], which triggers the next solution. Value chosen; its sensitivity
/// is not measured.
pub(crate) const SOLVED_VELOCITY_ERROR: f64 = 1e-5;

/// Velocity residual at which a solution always ends. Unit: length units/s. While rounds converge fast they continue down to
/// this residual. Value chosen; its sensitivity is not measured.
pub(crate) const EXACT_VELOCITY_ERROR: f64 = 1e-9;

/// Velocity residual at which the solution of a moving island with contact cycles ends. Unit: length units/s. Value chosen; its
/// sensitivity is not measured.
pub(crate) const CYCLIC_VELOCITY_ERROR: f64 = 0.01;

/// Greatest velocity residual of an accepted solution of an island of contacts, unless the initial residual was larger. Unit:
/// length units/s. For islands with joints it is an upper bound of the limit by [`ACCEPTED_RESIDUAL`]. Islands with contact
/// cycles and a budget stay with the direct solver even without acceptance, at the cost of [`FAILED_SOLUTION_COST`]. Value
/// chosen; its sensitivity is not measured.
pub(crate) const ACCEPTED_VELOCITY_ERROR: f64 = 0.25;

/// Penetration slop: penetration and joint error that remain uncorrected. Unit: length units. Value chosen; its sensitivity is
/// not measured.
pub(crate) const PENETRATION_SLOP: f64 = 1e-5;

/// Penetration slop per length unit of the largest coordinate of a body: rounding makes it necessary. Unit: dimensionless.
/// About 8 times the machine epsilon of `f32`.
pub(crate) const PENETRATION_SLOP_PER_COORDINATE: f64 = 1e-6;

/// Fraction of a penetration, or of its largest correction, that an update resolves in contact cycles. Unit: dimensionless, at
/// most 1. In islands without a budget it applies only if their bodies were calm when they came together.
///
/// In a cycle a body that moves out of one contact penetrates at others. One full correction moves more bodies than two half
/// corrections. Measured: fifty card houses need 12 % fewer Newton steps with 0.5 than without the factor. Bodies that were hit
/// come to rest later.
pub(crate) const CYCLIC_PENETRATION_FRACTION: f64 = 0.5;

/// Greatest speed of penetration correction in contact cycles with a budget, before it is multiplied by
/// [`CYCLIC_PENETRATION_FRACTION`]. Unit: length units/s. Corrections separate cards that lean on each other at the top, and
/// make them slide at the bottom. Measured: without this limit card houses of six storeys topple.
pub(crate) const CYCLIC_PENETRATION_SPEED: f64 = 0.25;

/// Penetration that ends the correction in contact cycles with a budget, as a fraction of the penetration slop, which starts it.
/// Unit: dimensionless, at most 1.
///
/// These islands resolve a [fraction](CYCLIC_PENETRATION_FRACTION) per update. Without hysteresis they stop just below the slop,
/// and the next contact that is found anew starts a solution. It applies after an update with Newton steps. Measured with the
/// houses of [`CYCLIC_STEP_TOLERANCE`]: 1,043 Newton steps with 1; 1,031, 962 and 1,090 with 0.7, 0.5 and 0.3.
pub(crate) const CORRECTED_SLOP_FRACTION: f64 = 0.5;

/// Mass ratio above which a body may jam lighter ones between itself and another body. Unit: dimensionless. Measured on 250,000
/// small scenes: the iterative solver gained more than 15 % of energy in seven of them, all with mass ratios of 60 and more.
/// With 50 instead of 16 one of the seven still gained that much.
pub(crate) const JAMMING_MASS_RATIO: f32 = 16.0;

/// Least number of bodies of an island without contact cycles, the heavy one included, for which a heavy body on a light one
/// selects the direct solver. Unit: dimensionless, a count. Measured with boxes of 6 to 46 px under a box of 70 px that jumps
/// on them for ten seconds. In the iterative solver one box below it moves by 1.5 px at most; two boxes fall.
pub(crate) const LOADED_TOWER_BODIES: u32 = 3;

/// Most bodies of an island with more contacts than joints in the direct solver. Unit: dimensionless, a count. For nets,
/// girders and bridges the number of products in the factorisation decides instead. Value chosen; its sensitivity is not
/// measured.
pub(crate) const DIRECT_ISLAND_BODIES: u32 = 400;

/// Speed above which a body is not calm: islands that formed while bodies moved faster go to the iterative solver. Unit: length
/// units/s. Value chosen; its sensitivity is not measured.
pub(crate) const CALM_ISLAND_MAX_SPEED: f32 = 0.25;

/// Least number of bodies for which an island without contact cycles goes to the direct solver although its bodies moved. Unit:
/// dimensionless, a count. Value chosen; its sensitivity is not measured.
pub(crate) const ACYCLIC_MOVING_ISLAND_BODIES: u32 = 16;

/// Least number of bodies for which an island with contact cycles, built in place, goes to the direct solver at once. Unit:
/// dimensionless, a count. Smaller ones go there if they stand by friction, or when friction slips in the iterative solver. Value chosen; its sensitivity is
/// not measured.
pub(crate) const CYCLIC_ISLAND_BODIES: u32 = 40;

/// Sliding speed of a contact above which friction within its limit shows that the iterative solver has not converged. Unit:
/// length units/s. Measured at 30 Hz: from 0.03 on, card houses of 3 storeys topple. Below 0.02 the direct solver also takes
/// pyramids of six rows, which stand without it.
pub(crate) const SLIP_SPEED: f32 = 0.025;

/// Fraction of the friction limit below which friction counts as within the limit. Unit: dimensionless, at most 1. The distance
/// to 1 covers rounding and the delay of the limit by one iteration.
pub(crate) const STICKING_FRICTION_FRACTION: f32 = 0.98;

/// Speed that a body gains in one step without friction, as a fraction of the speed that it gains in free fall, above which its
/// island needs friction to stand. Unit: dimensionless, at most 1. Measured: from 0.05 to 0.4 the map of card houses and the
/// chart stay as they are; at 0.02 stacks of 20 circles between stops count too, since their first solution is approximate.
pub(crate) const FRICTIONLESS_SPEED_GAIN: f64 = 0.1;

/// Binary logarithm of the longest time between two checks for slipping friction, a time in updates. Unit: dimensionless. The
/// time doubles from check to check, starting at one update. Measured: card houses that go to the direct solver only after
/// eight updates have crept too far.
pub(crate) const FRICTION_CHECK_MAX_DOUBLINGS: u8 = 7;

/// Most block products per body in the factorisation of an island without joints; beyond it the island goes to the iterative
/// solver. Unit: dimensionless, a count. Measured: card houses need fewer than 8, pyramids with 16 boxes in the lowest row 12.
/// At rest the direct solver takes half the time of the iterative solver for such a pyramid; while the pyramid is hit it takes
/// several times as long.
pub(crate) const FACTOR_PRODUCTS_PER_BODY: usize = 12;

/// Most block products per body in the factorisation of an island with joints; beyond it the island goes to the iterative
/// solver. Unit: dimensionless, a count. Measured: grids of 15 x 15 joints need about 30, grids of 100 x 100 about 520.
pub(crate) const JOINTED_FACTOR_PRODUCTS_PER_BODY: usize = 800;

/// Average Newton steps per update above which an island without joints goes to the iterative solver for a pause: first
/// without, second with contact cycles. Unit: dimensionless, a count. [`NEWTON_LIMIT_PER_BODY`] is added for each body.
///
/// The second value applies to islands that may jam; other islands with contact cycles have a budget. Islands without cycles
/// may take more steps: the iterative solver does not find their solution, and a Newton step is cheap there. Value chosen; its
/// sensitivity is not measured.
pub(crate) const NEWTON_LIMIT: [f32; 2] = [10.0, 0.0];

/// Addition to [`NEWTON_LIMIT`] for each body of the island: first without, second with contact cycles. Unit: dimensionless, a
/// count per body. Value chosen; its sensitivity is not measured.
pub(crate) const NEWTON_LIMIT_PER_BODY: [f32; 2] = [0.2, 0.1];

/// Time constant of the running average of the Newton steps of an island. Unit: updates. Value chosen; its sensitivity is not
/// measured.
pub(crate) const NEWTON_AVERAGE_UPDATES: f32 = 30.0;

/// Length of the pause in the iterative solver of an island that exceeds [`NEWTON_LIMIT`] or the limit of block products. Unit:
/// updates. Value chosen; its sensitivity is not measured.
pub(crate) const BUSY_ISLAND_PAUSE: u8 = 128;

/// Time between changes in islands of the iterative solver and the next solver selection; also the length of short pauses, such
/// as those after restitution. Unit: updates. Value chosen; its sensitivity is not measured.
pub(crate) const RESELECTION_PERIOD: u8 = 16;

/// Most awake bodies at which changes in islands of the iterative solver select solvers at once instead of after
/// [`RESELECTION_PERIOD`]. Selection at once also needs joints, springs, a heavy body on a light one, or calm bodies only.
/// Unit: dimensionless, a count. Value chosen; its sensitivity is not measured.
///
/// Up to this number, contact cycles with mass ratios above [`JAMMING_MASS_RATIO`] go to the direct solver, too. In larger worlds
/// they took more than half of an update.
pub(crate) const IMMEDIATE_RESELECTION_BODIES: usize = 64;

/// Modelled cost of a Newton step without the terms by size. Unit: microseconds. Measured, as are the next five values; see the
/// module `cost_model`.
pub(crate) const NEWTON_STEP_COST: f64 = 0.3;

/// Modelled cost of a Newton step per constraint. Unit: microseconds. Measured.
pub(crate) const NEWTON_CONSTRAINT_COST: f64 = 0.029;

/// Modelled cost of a Newton step per body. Unit: microseconds. Measured.
pub(crate) const NEWTON_BODY_COST: f64 = 0.074;

/// Modelled cost of a Newton step per block below the diagonal of the factors. Unit: microseconds. Measured.
pub(crate) const FACTOR_BLOCK_COST: f64 = 0.025;

/// Modelled cost of a Newton step per product of two blocks in the factorisation. Unit: microseconds. Measured.
pub(crate) const FACTOR_PRODUCT_COST: f64 = 0.0025;

/// Modelled cost of an update of the direct solver without its Newton steps, per constraint. Unit: microseconds. Measured.
pub(crate) const RESTING_CONSTRAINT_COST: f64 = 0.08;

/// Modelled cost of an update of the iterative solver, per island. Unit: microseconds. It is the estimated share of the other
/// stages of an update for the smallest island: a solution that takes no longer than this is worth its accuracy.
pub(crate) const ITERATIVE_ISLAND_COST: f64 = 0.5;

/// Modelled cost of an update of the iterative solver, per joint. Unit: microseconds.
///
/// Measured in instructions on 31 random scenes with joints, 360 updates each: 3,300 per joint and update in the iterative solver,
/// 34,000 per Newton step of an island with 12 joints on average.
pub(crate) const ITERATIVE_JOINT_COST: f64 = 0.3;

/// Modelled cost of an update of the iterative solver, per contact. Unit: microseconds.
pub(crate) const ITERATIVE_CONTACT_COST: f64 = 0.1;

/// Modelled cost per update that the budget of an island with joints grants. Unit: dimensionless, multiples of the modelled
/// cost of one update of the iterative solver. Measured together with [`BUDGET_OVERDRAFT`], with 5 and 300, 2.5 and 150,
/// 1.25 and 75. Of 4,800 random figures 71, 179 and 337 end with gaps of more than 0.1 length units, of Box2D's 1,364. Falling
/// ragdolls take 1.73, 1.01 and 0.73 ms per update.
pub(crate) const JOINTED_BUDGET: f64 = 2.5;

/// Modelled cost per update that the budget of an island with joints and large mass ratios grants. Unit: dimensionless,
/// multiples of the modelled cost of one update of the iterative solver. For such mass ratios the iterative solver needs many
/// times as many iterations. Value chosen; its sensitivity is not measured.
pub(crate) const MASS_RATIO_BUDGET: f64 = 10.0;

/// Cost that an update without an accepted solution is charged in addition to the modelled cost of its Newton steps. Unit:
/// dimensionless, multiples of the modelled cost of one update of the iterative solver. Value chosen; its sensitivity is not
/// measured.
pub(crate) const FAILED_SOLUTION_COST: f64 = 20.0;

/// Modelled cost per update that the budget of an island with contact cycles and no joints grants. Unit: dimensionless,
/// multiples of the modelled cost of one update of the iterative solver. Boxes at rest on each other cost no more than that in
/// the direct solver.
pub(crate) const CYCLIC_BUDGET: f64 = 1.0;

/// Greatest overdraft of the budget of an island with contact cycles and no joints, as modelled cost: about one frame at 60 Hz.
/// Unit: microseconds. The budget divides it by the modelled cost of one update of the iterative solver. Measured on 85 card
/// houses of six storeys: with 4,000 they topple, with 7,000 to 30,000 two to four of the 85 did.
pub(crate) const CYCLIC_BUDGET_OVERDRAFT: f64 = 16_000.0;

/// As [`CYCLIC_BUDGET_OVERDRAFT`], for islands whose bodies came together in motion: about an eighth of a frame at 60 Hz. Unit:
/// microseconds. A wall that has fallen does not need the solution that held it up.
pub(crate) const MOVING_BUDGET_OVERDRAFT: f64 = 2_000.0;

/// Greatest overdraft of the budget of an island with joints, as modelled cost. Unit: dimensionless, multiples of the modelled
/// cost of one update of the iterative solver. Measured together with [`JOINTED_BUDGET`].
pub(crate) const BUDGET_OVERDRAFT: f64 = 150.0;

/// Greatest modelled cost of the Newton steps of one update of an island with joints. Unit: dimensionless, multiples of the
/// modelled cost of one update of the iterative solver. Without it large nets would take half a second for 20 steps.
pub(crate) const UPDATE_COST_LIMIT: f64 = 30.0;

/// Greatest modelled cost of the Newton steps of all islands with joints together in one update: a constant, and a multiple of the
/// modelled cost of their update in the iterative solver, which is added. Unit: microseconds; dimensionless. The constant is a
/// fiftieth of a frame at 60 Hz.
///
/// Measured on 14 random scenes with many figures or large piles. Without the limit, single updates of four to six of them take 2 to
/// 12 ms; with 200 to 300 and 1.5 to 4 that happens in none or one.
pub(crate) const WORLD_COST_LIMIT: [f64; 2] = [300.0, 2.0];

/// Least and greatest limit of the Newton steps per update of an island with joints; the limit follows from
/// [`UPDATE_COST_LIMIT`]. Unit: dimensionless, a count. Fewer steps than the least find no active set; more than the greatest
/// can as well be done in the next update. Measured: with at most 20, 10 and 8 steps 44, 48 and 69 of 1,200 random figures end with
/// gaps. Random scenes take 1.62, 1.39 and 1.40 times as long as in the faster peer.
pub(crate) const UPDATE_NEWTON_STEPS: [f64; 2] = [4.0, 12.0];

/// Greatest limit of the Newton steps per update of an island with joints and no contacts, as [`UPDATE_NEWTON_STEPS`]. Unit:
/// dimensionless, a count. Measured: with 12, a chain of 20 ropes with a ball of 1,000 times their mass opens by 4 cm at 30 Hz.
pub(crate) const FREE_UPDATE_NEWTON_STEPS: f64 = 20.0;

/// Budget that an island gets after it has overdrawn its budget. Unit: dimensionless, fraction of the greatest overdraft,
/// -1..=0. When the island returns from its pause, half of the overdraft is left to it: less than to an island that never
/// overdrew. Value chosen; its sensitivity is not measured.
pub(crate) const BUDGET_AFTER_OVERDRAFT: f64 = -0.5;

/// Length of the first pause in the iterative solver of an island that overdraws its budget. Unit: updates. Each following
/// pause is twice as long, up to 255. Value chosen; its sensitivity is not measured.
pub(crate) const FIRST_BUDGET_PAUSE: u8 = 64;
