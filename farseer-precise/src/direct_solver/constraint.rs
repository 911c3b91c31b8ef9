//! Constraint rows of the direct solver, as contacts and joints both have them.
//!
//! A constraint has up to three rows with a Jacobian J, effective masses, impulses l and velocity errors u. In each round of
//! the [augmented Lagrangian method](super::island_newton) a row is a stiff spring, l = multiplier - stiffness * u, projected
//! onto its bounds. The rows strictly inside of their bounds are the active set: each adds stiffness * J^T J to the matrix of
//! the Newton step.

use std::ops::DerefMut;

use super::block_ldlt::{BlockIndex, BlockLdlt};
use super::island_body::{MemberIndex, MemberVectors};
use super::mat3::{Mat3, Vec3};
use crate::constraint_graph::ContactConstraint;

/// Index in place of a member of the island for a side of a constraint that impulses do not move: a static body, a kinematic
/// body or the world.
pub(crate) const FIXED: MemberIndex = MemberIndex(u32::MAX);

/// Set of rows of one constraint: bit i stands for row i, 0..=2.
pub(crate) type RowMask = u8;

/// The two bodies of a constraint, and the position of their off-diagonal block in the matrix of the island.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BodyIndices {
    /// Bodies A and B as indices into the members of the island, or [`FIXED`].
    pub(crate) bodies: [MemberIndex; 2],
    /// Position of the off-diagonal block of A and B in the matrix; `None` if A or B is fixed or both are the same body.
    pub(crate) block: Option<BlockIndex>,
}

/// The Jacobian of the up to three rows of a constraint, in compact form.
///
/// The relative velocity of a row is u = d . (vB - vA) + b wB - a wA, with linear velocities v and angular velocities w. The
/// direction d is the normal n for row 0, `second_row_scale` times n for row 1 and the tangent (n.y, -n.x) for row 2. The
/// angular parts a and b are [`angular_a`](Self::angular_a) and [`angular_b`](Self::angular_b).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Jacobian {
    /// Unit normal n, dimensionless, from A to B.
    pub(crate) normal: [f64; 2],
    /// Factor of the normal in the linear part of row 1, dimensionless: 1 for a second contact point, 0 for the angular row of
    /// a joint.
    pub(crate) second_row_scale: f64,
    /// Angular parts of rows 0 to 2 for A: arm x direction in length units, but 1 (dimensionless) for the angular row of a
    /// joint. The arm is the vector from the centre of mass of A to the contact point or anchor.
    pub(crate) angular_a: Vec3,
    /// Angular parts of rows 0 to 2 for B: arm x direction in length units, but 1 (dimensionless) for the angular row of a
    /// joint. The arm is the vector from the centre of mass of B to the contact point or anchor.
    pub(crate) angular_b: Vec3,
}

impl Jacobian {
    /// Returns the Jacobian of a contact: rows 0 and 1 along the normal at its two points, row 2 along the tangent.
    #[inline(always)]
    pub(super) fn of_contact(contact: &ContactConstraint) -> Self {
        let ([one, two], [a, b]) = (&contact.points, contact.tangent_arms);
        Jacobian {
            normal: contact.normal.map(f64::from),
            second_row_scale: 1.0,
            angular_a: [one.normal_arm_a, two.normal_arm_a, a].map(f64::from),
            angular_b: [one.normal_arm_b, two.normal_arm_b, b].map(f64::from),
        }
    }

    /// Returns the Jacobian of a joint: row 0 along `normal`, row 1 the angle, row 2 along the tangent. `a` and `b` are the
    /// vectors from the centres of mass of A and B to the anchors, in world axes and length units.
    pub(crate) fn of_joint(normal: [f64; 2], [a, b]: [[f64; 2]; 2]) -> Self {
        let cross = |arm: [f64; 2], [x, y]: [f64; 2]| arm[0] * y - arm[1] * x;
        let tangent = [normal[1], -normal[0]];
        let angular = |arm| [cross(arm, normal), 1.0, cross(arm, tangent)];
        Jacobian { normal, second_row_scale: 0.0, angular_a: angular(a), angular_b: angular(b) }
    }

    /// Returns the relative velocities J v of rows 0 to 2 from the velocities `a` and `b` of bodies A and B. Each body velocity
    /// is x, y (length units/s) and angular (radians/s). Unit of a linear row: length units/s; of an angular row: radians/s.
    #[inline(always)]
    pub(crate) fn relative_velocities(&self, a: Vec3, b: Vec3) -> Vec3 {
        let ([nx, ny], [x, y]) = (self.normal, [b[0] - a[0], b[1] - a[1]]);
        let along = x * nx + y * ny;
        let along = [along, self.second_row_scale * along, x * ny - y * nx];
        std::array::from_fn(|row| along[row] + b[2] * self.angular_b[row] - a[2] * self.angular_a[row])
    }

    /// Returns the impulses J^T l on A and on B that the impulses l of the rows make. Each is x, y (mass units * length
    /// units/s) and angular (mass units * length units^2/s).
    #[inline(always)]
    pub(crate) fn body_impulses(&self, impulses: Vec3) -> [Vec3; 2] {
        let ([nx, ny], along) = (self.normal, impulses[0] + self.second_row_scale * impulses[1]);
        let (x, y) = (along * nx + impulses[2] * ny, along * ny - impulses[2] * nx);
        let turn = |arms: &Vec3| impulses[0] * arms[0] + impulses[1] * arms[1] + impulses[2] * arms[2];
        [[-x, -y, -turn(&self.angular_a)], [x, y, turn(&self.angular_b)]]
    }
}

/// Rows of one contact or joint of an island: Jacobian, effective masses, impulses, velocity errors and active set. Vectors
/// have one component per row, 0 to 2.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ConstraintRows {
    /// Bodies A and B as indices into the members of the island, or [`FIXED`].
    pub(super) bodies: [MemberIndex; 2],
    /// Position of the off-diagonal block of A and B in the matrix; `None` if A or B is fixed or both are the same body.
    pub(super) block: Option<BlockIndex>,
    /// The Jacobian J of the rows.
    pub(super) jacobian: Jacobian,
    /// Set of the rows that this constraint has; the other rows have no effect.
    pub(super) present_rows: RowMask,
    /// Effective mass of each row, 1 / (J M^-1 J^T): impulse of the row per change of its relative velocity while all other
    /// rows are idle. Unit: mass units (angular rows: mass units * length units^2). It is 0 for a row that does not exist.
    pub(super) effective_masses: Vec3,
    /// Spring stiffness of each row in the present round: impulse per velocity error. Unit: mass units (angular rows: mass
    /// units * length units^2).
    pub(super) stiffness: Vec3,
    /// Velocity error of each row: relative velocity minus target velocity. Unit of a linear row: length units/s; of an angular
    /// row: radians/s.
    pub(super) velocity_error: Vec3,
    /// Velocity error of each row by motors, conveyor belts, kinematic bodies and springs, without the motion of the island's
    /// members. Unit of a linear row: length units/s; of an angular row: radians/s.
    pub(super) driven_velocity_error: Vec3,
    /// Change of the velocity error of each row by a full step along the last Newton direction. Unit of a linear row: length
    /// units/s; of an angular row: radians/s.
    pub(super) error_change: Vec3,
    /// Present impulse of each row over the whole step: mass units * length units/s (angular rows: mass units * length
    /// units^2/s).
    pub(super) impulses: Vec3,
    /// Impulse of each row at the beginning of the solution, over the whole step: mass units * length units/s (angular rows:
    /// mass units * length units^2/s).
    pub(super) initial_impulses: Vec3,
    /// Impulse of each row at the beginning of the round, over the whole step: mass units * length units/s (angular rows: mass
    /// units * length units^2/s).
    pub(super) multipliers: Vec3,
    /// Impulse of each row in the round with the smallest residual so far, over the whole step: mass units * length units/s
    /// (angular rows: mass units * length units^2/s).
    pub(super) best_impulses: Vec3,
    /// Active set: rows strictly inside of their bounds, which act as springs.
    pub(super) active_rows: RowMask,
    /// Active set of the present factors of the matrix, as set by [`assemble`](Self::assemble).
    pub(super) factored_rows: RowMask,
}

impl ConstraintRows {
    /// Returns rows with the initial `impulses`: mass units * length units/s (angular rows: mass units * length units^2/s).
    /// Effective masses, stiffness and velocity errors are 0 until they are set.
    #[inline(always)]
    pub(super) fn new(
        bodies: BodyIndices,
        jacobian: Jacobian,
        present_rows: RowMask,
        impulses: Vec3,
    ) -> Self {
        ConstraintRows {
            bodies: bodies.bodies,
            block: bodies.block,
            jacobian,
            present_rows,
            effective_masses: [0.0; 3],
            stiffness: [0.0; 3],
            velocity_error: [0.0; 3],
            driven_velocity_error: [0.0; 3],
            error_change: [0.0; 3],
            impulses,
            initial_impulses: impulses,
            multipliers: impulses,
            best_impulses: impulses,
            active_rows: 0,
            factored_rows: 0,
        }
    }

    /// Sets the initial impulses of a solution: mass units * length units/s (angular rows: mass units * length units^2/s). The
    /// present impulses, the multipliers and the best impulses get the values of `impulses` as well.
    pub(super) fn set_initial_impulses(&mut self, impulses: Vec3) {
        self.impulses = impulses;
        (self.initial_impulses, self.multipliers, self.best_impulses) = (impulses, impulses, impulses);
    }

    /// Returns whether row `row` (0..=2) exists.
    #[inline(always)]
    pub(super) fn has_row(&self, row: usize) -> bool {
        self.present_rows >> row & 1 == 1
    }

    /// Returns whether row `row` (0..=2) is in the active set.
    #[inline(always)]
    pub(super) fn is_active(&self, row: usize) -> bool {
        self.active_rows >> row & 1 == 1
    }

    /// Returns the relative velocities of rows 0 to 2. `of` returns the velocity of a member of the island by its index: length
    /// units/s, length units/s, radians/s. Unit of a linear row: length units/s; of an angular row: radians/s.
    #[inline(always)]
    pub(super) fn relative_velocities_of(&self, of: impl Fn(MemberIndex) -> Vec3) -> Vec3 {
        let of_side = |member| if member == FIXED { [0.0; 3] } else { of(member) };
        let [a, b] = self.bodies;
        self.jacobian.relative_velocities(of_side(a), of_side(b))
    }

    /// Returns the relative velocities of rows 0 to 2 from `members`, the velocities of all members of the island: length
    /// units/s, length units/s, radians/s. Unit of a linear row: length units/s; of an angular row: radians/s.
    #[inline(always)]
    pub(super) fn relative_velocities_in(&self, members: &MemberVectors) -> Vec3 {
        self.relative_velocities_of(|member| members[member])
    }

    /// Counts the active set as the factored one. Returns the change of the stiffness of each row in the matrix: mass units, in
    /// angular rows mass units * length units^2.
    #[inline(always)]
    fn begin_assembly(&mut self) -> Vec3 {
        let is_in = |set: RowMask, row: usize| f64::from(set >> row & 1);
        let (active, factored) =
            (self.active_rows, std::mem::replace(&mut self.factored_rows, self.active_rows));
        std::array::from_fn(|row| (is_in(active, row) - is_in(factored, row)) * self.stiffness[row])
    }

    /// Changes the matrix `factor` from the factored set to the active set of this constraint: adds stiffness * J^T J for each
    /// row that entered, and subtracts it for each row that left.
    pub(super) fn assemble(&mut self, factor: &mut BlockLdlt) {
        let stiffness = self.begin_assembly();
        let Jacobian { normal: [nx, ny], second_row_scale: second, angular_a: arms_a, angular_b: arms_b } =
            &self.jacobian;
        let (along, across) = (stiffness[0] + second * stiffness[1], stiffness[2]);
        let xx = along * nx * nx + across * ny * ny;
        let xy = (along - across) * nx * ny;
        let yy = along * ny * ny + across * nx * nx;
        // Coupling of rotation with translation along x and y.
        let turned = |arms: &Vec3| {
            let along = stiffness[0] * arms[0] + second * stiffness[1] * arms[1];
            let across = stiffness[2] * arms[2];
            [along * nx + across * ny, along * ny - across * nx]
        };
        let both =
            |one: &Vec3, other: &Vec3| (0..3).map(|row| stiffness[row] * one[row] * other[row]).sum::<f64>();
        let ([ax, ay], [bx, by]) = (turned(arms_a), turned(arms_b));
        let [a, b] = self.bodies;
        if a != FIXED {
            factor.add_diagonal_block(
                a,
                &Mat3::from_rows([[xx, xy, ax], [xy, yy, ay], [ax, ay, both(arms_a, arms_a)]]),
            );
        }
        if b != FIXED {
            factor.add_diagonal_block(
                b,
                &Mat3::from_rows([[xx, xy, bx], [xy, yy, by], [bx, by, both(arms_b, arms_b)]]),
            );
        }
        if let Some(entry) = self.block {
            let rows = [[-xx, -xy, -ax], [-xy, -yy, -ay], [-bx, -by, -both(arms_a, arms_b)]];
            factor.add_off_diagonal_block(entry, &Mat3::from_rows(rows));
        }
    }
}

/// Constraint rows with bounds on their impulses: contacts with friction, or joints with motors and limits.
pub(super) trait Constraint: DerefMut<Target = ConstraintRows> {
    /// Returns the impulse of each row at this `velocity_error`: multiplier - stiffness * error, projected onto its bounds.
    /// Also returns the set of rows that are inside of their bounds. Unit of the impulses: mass units * length units/s (angular
    /// rows: mass units * length units^2/s).
    fn project_impulses(&self, velocity_error: Vec3) -> (Vec3, RowMask);

    /// Returns whether every row at a bound keeps that bound with the new `impulses` and the new set `active` of rows inside of
    /// their bounds.
    fn keeps_bounds(&self, impulses: Vec3, active: RowMask) -> bool;

    /// Gauss-Seidel step for one row: sets its impulse, within its bounds, to the value that removes `velocity_error` if no
    /// other row changes. Returns the changes of the impulses of rows 0 to 2: mass units * length units/s (angular rows: mass
    /// units * length units^2/s).
    fn solve_row(&mut self, row: usize, velocity_error: f64) -> Vec3;

    /// Returns twice the energy that compliant rows store: the sum of compliance * impulse^2, in mass units * length
    /// units^2/s^2. It is 0 for rigid rows.
    fn compliance_energy(&self) -> f64 {
        0.0
    }

    /// Sets the impulses and the active set to the result of [`project_impulses`](Self::project_impulses) for the present
    /// velocity errors.
    #[inline(always)]
    fn apply_projection(&mut self) {
        (self.impulses, self.active_rows) = self.project_impulses(self.velocity_error);
    }
}
