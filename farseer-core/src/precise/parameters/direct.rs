//! The direct solver of islands: its choice, its cost, its iterations and the solutions that it accepts.

/// Geometric stiffness of an explicit force that an inertia bears in a step or substep, as a fraction of that inertia. Unit:
/// dimensionless.
pub(in crate::precise) const STABLE_STIFFNESS: f64 = 0.3;

/// Arm that turns angular velocity into a velocity where errors of islands with joints are compared: centre to rim of a body a
/// little smaller than a length unit. Unit: length units.
pub(in crate::precise) const ERROR_ARM: f64 = 0.3;

/// Residual of an accepted solution with joints. Unit: length units/s.
pub(in crate::precise) const ACCEPTED_RESIDUAL: f64 = 0.05;

/// The same as a fraction of the residual before the solution; the two are added. Unit: dimensionless.
pub(in crate::precise) const ACCEPTED_RESIDUAL_FRACTION: f64 = 0.02;

/// Greatest position error of a joint in an accepted solution. Unit: length units.
pub(in crate::precise) const ACCEPTED_JOINT_ERROR: f64 = 0.02;

/// Least correction of a joint's greater error in a step, as a fraction of the correction that a step may make. Unit: dimensionless. With
/// less the joints contradict each other, or are pulled too far, and soft rows find a compromise.
pub(in crate::precise) const JOINT_ERROR_PROGRESS: f64 = 0.1;

/// Rate at which penetration in islands with joints is resolved. Unit: 1/s. Parts of a figure that overlap for good contradict its
/// joints: pressed out as fast as contacts are where nothing is joined, they throw it about. Chosen among some 30 pairs of numbers by
/// 1,200 random figures: faster ones throw more of them, slower ones leave landings deep.
pub(in crate::precise) const JOINTED_PENETRATION_RATE: f64 = 3.0;

/// Least speed at which it is resolved. Unit: length units/s. The other number of the pair.
pub(in crate::precise) const JOINTED_PENETRATION_SPEED: f64 = 0.03;

/// Greatest rotation of a body in a step of an accepted solution: the Jacobian is that of the beginning. Unit: radians.
pub(in crate::precise) const ACCEPTED_ROTATION: f64 = 0.5;

/// Kinetic energy of an accepted solution as a multiple of that without constraints. Unit: dimensionless.
pub(in crate::precise) const ACCEPTED_ENERGY_RATIO: f64 = 1.05;

/// Energy per mass that is accepted besides: the square of a speed of 0.1 length units/s. Unit: length units^2/s^2.
pub(in crate::precise) const ACCEPTED_ENERGY_SLACK: f64 = 0.01;

/// Most position corrections of a step. Unit: dimensionless, a count.
pub(in crate::precise) const POSITION_CORRECTIONS: usize = 3;

/// Position error after a correction that asks for no other one, as a multiple of the error that asks for the first. Unit: dimensionless.
pub(in crate::precise) const CORRECTION_ERROR_RATIO: f64 = 10.0;

/// Most halvings of a position correction after which the greatest position error is larger than before it. Unit: dimensionless, a count.
pub(in crate::precise) const CORRECTION_HALVINGS: i32 = 4;

/// Rotation of a body beyond which a position correction computes Jacobians again. Unit: radians.
pub(in crate::precise) const JACOBIAN_ROTATION: f64 = 0.002;

/// Most solutions of a part of a step of a free articulation. Unit: dimensionless, a count. Each one uses the second-order error of the
/// one before, and leaves a part of the error as great as the rotation of the fastest body in radians.
pub(in crate::precise) const ARTICULATION_SOLUTIONS: usize = 4;

/// Penetration from which on a point without load is pushed out, as a multiple of that of a point with load. Unit: dimensionless.
pub(in crate::precise) const UNLOADED_POINT_DEPTH: f64 = 100.0;

/// Mass ratio from which on a body is heavy. Unit: dimensionless.
pub(in crate::precise) const HEAVY_MASS_RATIO: f32 = 1.5;

/// Least square of the upward component of a normal by which a body lies on another. Unit: dimensionless, at most 1. 60 degrees.
pub(in crate::precise) const SUPPORT_NORMAL_SQUARED: f32 = 0.25;

/// Most bodies of an island with a depth axis and contact cycles that is solved directly. Unit: dimensionless, a count.
pub(in crate::precise) const CYCLIC_DEPTH_ISLAND_BODIES: u32 = 24;

/// Newton steps per update, on the average, beyond which an island with a depth axis is left to the iterative solver for a while. Unit:
/// dimensionless, a count.
pub(in crate::precise) const DEPTH_NEWTON_LIMIT: f32 = 40.0;

/// Most sweeps over friction along the depth axis. Unit: dimensionless, a count. It starts from the friction of the step before: more
/// than one is seldom needed, but many where a heavy body lands on a light one.
pub(in crate::precise) const LATERAL_FRICTION_SWEEPS: usize = 400;

/// Change of velocity at which they end. Unit: length units/s.
pub(in crate::precise) const LATERAL_FRICTION_CONVERGED: f64 = 3e-7;

/// Slip along the depth axis below which friction may stick. Unit: length units/s.
pub(in crate::precise) const LATERAL_STICTION_SPEED: f64 = 1.0 / 64.0;

/// Compliance of contact rows in the first round, as a fraction of a row's own inverse effective mass. Unit: dimensionless. Stiffer rows
/// yield less, and their active set is harder to find.
pub(in crate::precise) const FIRST_COMPLIANCE: f64 = 1e-3;

/// Factor of the compliance from round to round while the active set stays the same. Unit: dimensionless, at most 1.
pub(in crate::precise) const COMPLIANCE_FACTOR: f64 = 0.25;

/// Least compliance of the rounds. Unit: dimensionless.
pub(in crate::precise) const LEAST_COMPLIANCE: f64 = 6e-5;

/// Compliance of the first round where the active set hardly changes: at rest, with contact cycles. Unit: dimensionless. In cycles rows
/// can press each other however hard, and stiff rows of a wrong active set do.
pub(in crate::precise) const RESTING_COMPLIANCE: f64 = 1e-5;

/// The same without cycles, at rest or new. Unit: dimensionless. Without cycles rows bear the load and no more. A tall column yields by it:
/// its slow swaying weighs little beside a row's own effective mass.
pub(in crate::precise) const ACYCLIC_COMPLIANCE: f64 = 1e-8;

/// Newton steps of a round with such compliance beyond which its active set was wrong. Unit: dimensionless, a count.
pub(in crate::precise) const STIFF_ROUND_STEPS: usize = 4;

/// Fraction of the residual that such a round must not leave besides; then the solution starts again with softer rows. Unit:
/// dimensionless, at most 1.
pub(in crate::precise) const STIFF_ROUND_RESIDUAL: f64 = 0.5;

/// Most Newton steps of a round. Unit: dimensionless, a count.
pub(in crate::precise) const ROUND_NEWTON_STEPS: usize = 25;

/// Most rounds of a solution, one of them stiff. Unit: dimensionless, a count.
pub(in crate::precise) const SOLUTION_ROUNDS: usize = 7;

/// Most Newton steps of a solution. Unit: dimensionless, a count.
pub(in crate::precise) const SOLUTION_NEWTON_STEPS: usize = 100;

/// The same with contact cycles and without impulses to start from. Unit: dimensionless, a count. As many again find little more: the
/// updates after it find the rest, and no update is to take much longer than others.
pub(in crate::precise) const FRESH_SOLUTION_NEWTON_STEPS: usize = 10;

/// Greatest compliance of joint rows, as a fraction of a row's own inverse effective mass. Unit: dimensionless. With 1e-7 the digits of
/// `f64` begin to run out in chains of hundreds, with 1e-9 they are gone.
pub(in crate::precise) const JOINT_ROW_COMPLIANCE: f64 = 1e-6;

/// With joints: weight of friction's residual where rounds are compared. Unit: dimensionless.
pub(in crate::precise) const FRICTION_RESIDUAL_WEIGHT: f64 = 0.1;

/// With joints: relative change up to which a friction limit has converged. Unit: dimensionless.
pub(in crate::precise) const FRICTION_LIMIT_CONVERGED: f64 = 1e-3;

/// With joints: rounds for which that is waited for. Unit: dimensionless, a count.
pub(in crate::precise) const FRICTION_LIMIT_ROUNDS: usize = 4;

/// Gauss-Seidel sweeps over all rows where rounds find no solution. Unit: dimensionless, a count.
pub(in crate::precise) const ISLAND_SWEEPS: usize = 8;

/// Most halvings and secants of a line search. Unit: dimensionless, a count.
pub(in crate::precise) const LINE_SEARCH_STEPS: usize = 20;

/// Fraction of the first slope at which a line search ends. Unit: dimensionless, at most 1.
pub(in crate::precise) const LINE_SEARCH_SLOPE: f64 = 0.1;

/// Fraction by which friction limits follow the normal impulse in a Newton step and from round to round: in cycles the
/// normal impulse may follow friction as much. Unit: dimensionless, at most 1.
pub(in crate::precise) const FRICTION_LIMIT_RELAXATION: f64 = 0.5;

/// Velocity error that an island at rest keeps without a solution. Unit: length units/s.
pub(in crate::precise) const RESTING_VELOCITY_ERROR: f64 = 1e-4;

/// The same of islands of contacts in the update after a solution, whose corrections of velocities leave the impulses again; and of bodies
/// that motors, belts or kinematic bodies move, maybe slowly. Unit: length units/s. Islands with joints keep
/// [`RESTING_VELOCITY_ERROR`]: rounding of poses makes more than this.
pub(in crate::precise) const MOVING_VELOCITY_ERROR: f64 = 2e-6;

/// Velocity error at which a solution may end. Unit: length units/s. Errors add up from update to update until they exceed
/// [`RESTING_VELOCITY_ERROR`].
pub(in crate::precise) const SOLVED_VELOCITY_ERROR: f64 = 1e-5;

/// Velocity error at which it ends if that is easily had. Unit: length units/s.
pub(in crate::precise) const EXACT_VELOCITY_ERROR: f64 = 1e-9;

/// Velocity error that is enough for moving islands with contact cycles. Unit: length units/s.
pub(in crate::precise) const CYCLIC_VELOCITY_ERROR: f64 = 0.01;

/// Velocity error that a solution may leave, whatever the error was before; one that leaves more than both is none. Unit: length units/s.
/// Contact cycles with a budget go on after one that is none, at [`FAILED_SOLUTION_COST`].
pub(in crate::precise) const BEARABLE_VELOCITY_ERROR: f64 = 0.25;

/// Penetration that is not resolved. Unit: length units.
pub(in crate::precise) const PENETRATION_FLOOR: f64 = 1e-5;

/// The same as a fraction of coordinates, for rounding. Unit: dimensionless. 8 roundings of `f32`.
pub(in crate::precise) const PENETRATION_FLOOR_PER_COORDINATE: f64 = 1e-6;

/// Part of a penetration, and of the greatest correction, that an update resolves where there are contact cycles. Without a budget not
/// where bodies have come by motion. Unit: dimensionless, at most 1. A body that is pushed out in a cycle pushes others, and all at once
/// more of them than half and half. Fifty card houses take 12 % fewer Newton steps by it. Bodies that are struck rest later by it.
pub(in crate::precise) const CYCLIC_PENETRATION_PART: f64 = 0.5;

/// Penetration per second of which [`CYCLIC_PENETRATION_PART`] is resolved, at most, in islands with contact cycles that have a budget. Unit:
/// length units/s. Cards that lean on each other are pushed apart at the top, and slide at the bottom: without this limit houses of six
/// storeys topple.
pub(in crate::precise) const CYCLIC_PENETRATION_SPEED: f64 = 0.25;

/// Mass ratio at which a body jams those between it and another one. Unit: dimensionless. Where the iterative solver gained more than 15 % of
/// energy, in seven of 250,000 small scenes, the ratio was 60 and more; with 50 instead of this one of them still did.
pub(in crate::precise) const JAMMING_MASS_RATIO: f32 = 16.0;

/// Bodies from which on an island under a load that does not jam them is solved directly. Unit: dimensionless, a count. Boxes of
/// 6 to 46 px on the floor under one of 70 px that jumps on them for ten seconds move by 1.5 px at most in the iterative solver, two of
/// them fall.
pub(in crate::precise) const LOADED_TOWER_BODIES: u32 = 3;

/// Most bodies of an island that contacts tie more than joints do. Unit: dimensionless, a count. Of nets, girders and bridges the
/// products of their factors decide.
pub(in crate::precise) const DIRECT_ISLAND_BODIES: u32 = 400;

/// Speed above which bodies that come together are left to the iterative solver. Unit: length units/s.
pub(in crate::precise) const CALM_SPEED: f32 = 0.25;

/// Bodies from which on a faster island without contact cycles is solved directly nevertheless. Unit: dimensionless, a count.
pub(in crate::precise) const HIGH_STACK_BODIES: u32 = 16;

/// Bodies from which on an island with contact cycles that was built in place is solved directly at once. Unit: dimensionless, a count.
/// Smaller ones are if friction slips in the iterative solver.
pub(in crate::precise) const CYCLIC_ISLAND_BODIES: u32 = 40;

/// Speed at which a contact slides, though friction is within its limit, from which on the iterative solver has not converged. Unit: length
/// units/s. Card houses of 3 storeys topple from 0.03 on at 30 Hz; below 0.02 pyramids of six rows, which stand without, are solved
/// directly, too.
pub(in crate::precise) const SLIP_SPEED: f32 = 0.025;

/// Part of its limit up to which friction counts as within it. Unit: dimensionless, at most 1. Rounding and the lag of the limit by one
/// iteration stay below the rest.
pub(in crate::precise) const STICKING_FRICTION_PART: f32 = 0.98;

/// Binary logarithm of the longest time in updates after which friction is looked at again. Unit: dimensionless. The time doubles, from one
/// update after a contact has come: card houses that are solved directly only after eight updates have crept too far.
pub(in crate::precise) const LONGEST_FRICTION_WATCH: u8 = 7;

/// Most products of blocks per body in the factors of an island. Unit: dimensionless, a count. Card houses have fewer than 8, pyramids
/// with 15 boxes in their lowest row 12. At rest such a pyramid takes half the time of the iterative solver, while it is hit several
/// times as much.
pub(in crate::precise) const FACTOR_PRODUCTS_PER_BODY: usize = 12;

/// The same of an island with joints. Unit: dimensionless, a count. Grids of 15 x 15 joints have about 50, of 100 x 100 about 700.
pub(in crate::precise) const JOINTED_FACTOR_PRODUCTS_PER_BODY: usize = 800;

/// Newton steps per update, without and with contact cycles, beyond which an island is left to the iterative solver, on the average of
/// [`NEWTON_AVERAGE_UPDATES`]. Unit: dimensionless, a count. Those with cycles are islands that may jam; others have a budget.
/// Islands without cycles get more: the iterative solver does not find their solution, and a Newton step costs little there.
pub(in crate::precise) const NEWTON_LIMIT: [f32; 2] = [10.0, 0.0];

/// The same for each body, which is added. Unit: dimensionless, a count.
pub(in crate::precise) const NEWTON_LIMIT_PER_BODY: [f32; 2] = [0.2, 0.1];

/// Updates over which Newton steps are averaged. Unit: dimensionless, updates.
pub(in crate::precise) const NEWTON_AVERAGE_UPDATES: f32 = 30.0;

/// Updates for which such an island is left to the iterative solver. Unit: dimensionless, updates.
pub(in crate::precise) const BUSY_ISLAND_PAUSE: u8 = 128;

/// Updates after which solvers are selected again where something changed elsewhere. Unit: dimensionless, updates.
pub(in crate::precise) const RESELECTION_PERIOD: u8 = 16;

/// Most awake bodies with which they are selected again at once, if all are calm. Unit: dimensionless, a count.
pub(in crate::precise) const IMMEDIATE_RESELECTION_BODIES: usize = 64;

/// Cost of a Newton step by itself. Unit: microseconds. This and the next five are measured.
pub(in crate::precise) const NEWTON_STEP_COST: f64 = 0.3;

/// Cost of a Newton step for each constraint. Unit: microseconds.
pub(in crate::precise) const NEWTON_CONSTRAINT_COST: f64 = 0.029;

/// Cost of a Newton step for each body. Unit: microseconds.
pub(in crate::precise) const NEWTON_BODY_COST: f64 = 0.074;

/// Cost of a Newton step for each block of the factors. Unit: microseconds.
pub(in crate::precise) const FACTOR_BLOCK_COST: f64 = 0.025;

/// Cost of a Newton step for each product of two blocks. Unit: microseconds.
pub(in crate::precise) const FACTOR_PRODUCT_COST: f64 = 0.0025;

/// Cost of an update without Newton steps for each constraint. Unit: microseconds.
pub(in crate::precise) const RESTING_CONSTRAINT_COST: f64 = 0.08;

/// Cost of an update of the iterative solver for an island. Unit: microseconds. An estimate of the other stages for the smallest island: one
/// that takes no longer is worth being exact.
pub(in crate::precise) const ITERATIVE_ISLAND_COST: f64 = 0.5;

/// Cost of an update of the iterative solver for each joint. Unit: microseconds. That of joints solved one after the other; four at a time
/// they take a quarter. The budget stays as large for the accuracy of before.
pub(in crate::precise) const ITERATIVE_JOINT_COST: f64 = 0.3;

/// Cost of an update of the iterative solver for each contact. Unit: microseconds.
pub(in crate::precise) const ITERATIVE_CONTACT_COST: f64 = 0.1;

/// Updates of the iterative solver that an update of the direct solver may cost on the average. Unit: dimensionless, updates. With 3,
/// twice as many random figures gape at the end.
pub(in crate::precise) const DIRECT_BUDGET: f64 = 5.0;

/// The same with large mass ratios, for which the iterative solver needs many times as many passes. Unit: dimensionless, updates.
pub(in crate::precise) const UNLIKE_MASS_BUDGET: f64 = 10.0;

/// Cost of an update without an accepted solution, besides its Newton steps. Unit: dimensionless, updates of the iterative solver.
pub(in crate::precise) const FAILED_SOLUTION_COST: f64 = 20.0;

/// Updates of the iterative solver that an update of an island with contact cycles, and without joints, may cost on the average. Unit:
/// dimensionless, updates. At rest the direct solver costs no more where boxes lie on each other.
pub(in crate::precise) const CYCLIC_BUDGET: f64 = 1.0;

/// Cost by which its budget may be overdrawn. Unit: microseconds. A frame at 60 Hz, in all. With 4,000 card houses of six storeys topple,
/// with 7,000 to 30,000 two to four of 85 houses did.
pub(in crate::precise) const CYCLIC_BUDGET_OVERDRAFT: f64 = 16_000.0;

/// Updates by which the budget may be overdrawn: figures, houses and bridges that fall into place take fewer. Unit: dimensionless,
/// updates of the iterative solver.
pub(in crate::precise) const BUDGET_OVERDRAFT: f64 = 300.0;

/// Cost that the Newton steps of one update may have: large nets would take half a second for 20 steps. Unit: dimensionless, updates of the
/// iterative solver.
pub(in crate::precise) const UPDATE_COST_LIMIT: f64 = 30.0;

/// Least and greatest limit of Newton steps in an update: fewer find no active set, and the next update finds as well what more of them
/// find. Unit: dimensionless, a count.
pub(in crate::precise) const UPDATE_NEWTON_STEPS: [f64; 2] = [4.0, 20.0];

/// Updates for which an island over its budget is left to the iterative solver the first time; then twice as many, up to 255. Unit:
/// dimensionless, updates.
pub(in crate::precise) const FIRST_BUDGET_PAUSE: u8 = 64;
