//! The constraint rows of an island system: what contacts and joints have in common.

use std::ops::DerefMut;

use super::block::{Block, Triple};
use super::factor::{Entry, Factor};
use crate::precise::rows::Lane;

/// In place of a body's index in its island: a static or kinematic body, or the world.
pub(in crate::precise) const FIXED: u32 = u32::MAX;

/// Rows by bits.
pub(in crate::precise) type Set = u8;

/// The two bodies of a constraint.
#[derive(Debug, Clone, Copy)]
pub(in crate::precise) struct Ends {
    /// Indices into the members of the island, or [`FIXED`].
    pub(in crate::precise) bodies: [u32; 2],
    /// The block of the two in the matrix; `None` if one of them is fixed, or both are one body.
    pub(in crate::precise) entry: Option<Entry>,
}

/// The Jacobian of up to three rows: relative velocities u = d (vB - vA) + wB b - wA a. The direction d is the normal n for the first
/// row, n times `second` for the second row, and the tangent (n.y, -n.x) for the third.
#[derive(Debug, Clone, Copy)]
pub(in crate::precise) struct Jacobian {
    pub(in crate::precise) normal: [f64; 2],
    /// The linear part of the second row: 1 for a second contact point, 0 for the angular row of a joint.
    pub(in crate::precise) second: f64,
    /// The angular parts of the rows, on A and on B.
    pub(in crate::precise) a: Triple,
    pub(in crate::precise) b: Triple,
}

impl Jacobian {
    #[inline(always)]
    pub(super) fn of(lane: &Lane) -> Self {
        let ([one, two], [a, b]) = (&lane.points, lane.tangent_arms);
        Jacobian {
            normal: lane.normal.map(f64::from),
            second: 1.0,
            a: [one.arm_a, two.arm_a, a].map(f64::from),
            b: [one.arm_b, two.arm_b, b].map(f64::from),
        }
    }

    /// Along n, of the angle, and across n, at points with these arms of A and B.
    pub(in crate::precise) fn at(normal: [f64; 2], [a, b]: [[f64; 2]; 2]) -> Self {
        let cross = |arm: [f64; 2], [x, y]: [f64; 2]| arm[0] * y - arm[1] * x;
        let tangent = [normal[1], -normal[0]];
        let angular = |arm| [cross(arm, normal), 1.0, cross(arm, tangent)];
        Jacobian { normal, second: 0.0, a: angular(a), b: angular(b) }
    }

    /// Relative velocities of all rows.
    #[inline(always)]
    pub(in crate::precise) fn relative(&self, a: Triple, b: Triple) -> Triple {
        let ([nx, ny], [x, y]) = (self.normal, [b[0] - a[0], b[1] - a[1]]);
        let along = x * nx + y * ny;
        let along = [along, self.second * along, x * ny - y * nx];
        std::array::from_fn(|row| along[row] + b[2] * self.b[row] - a[2] * self.a[row])
    }

    /// Linear and angular impulses on A and on B by impulses of the rows.
    #[inline(always)]
    pub(in crate::precise) fn push(&self, impulses: Triple) -> [Triple; 2] {
        let ([nx, ny], along) = (self.normal, impulses[0] + self.second * impulses[1]);
        let (x, y) = (along * nx + impulses[2] * ny, along * ny - impulses[2] * nx);
        let turn = |arms: &Triple| impulses[0] * arms[0] + impulses[1] * arms[1] + impulses[2] * arms[2];
        [[-x, -y, -turn(&self.a)], [x, y, turn(&self.b)]]
    }
}

/// The rows of a contact or of a joint between two bodies of an island.
#[derive(Debug, Clone, Copy)]
pub(in crate::precise) struct ConstraintRows {
    pub(super) bodies: [u32; 2],
    pub(super) entry: Option<Entry>,
    pub(super) jacobian: Jacobian,
    /// The rows there are.
    pub(super) present: Set,
    /// Effective masses: impulse per relative velocity of each row alone; 0 for a row that is not there.
    pub(super) masses: Triple,
    /// Stiffness of each row in the present round: impulse per velocity error.
    pub(super) stiffness: Triple,
    /// Velocity error of each row: its relative velocity less the one that it may have, in length units (radians) per second.
    pub(super) excess: Triple,
    /// The part of the velocity errors that motors, belts and kinematic bodies make, before members move.
    pub(super) supplied: Triple,
    /// Change of the velocity error by the last Newton direction.
    pub(super) change: Triple,
    /// Impulses of the whole step: now, when the step began, and when the round began (the multipliers).
    pub(super) impulses: Triple,
    pub(super) begun: Triple,
    pub(super) centre: Triple,
    /// The impulses that leave the least residual so far.
    pub(super) best: Triple,
    /// The active set: rows that yield as springs, inside of their bounds; and the set that the factors were made for.
    pub(super) active: Set,
    pub(super) factored: Set,
}

impl ConstraintRows {
    /// Rows with these impulses, of which effective masses and velocity errors are still to be set.
    #[inline(always)]
    pub(super) fn new(ends: Ends, jacobian: Jacobian, present: Set, impulses: Triple) -> Self {
        ConstraintRows {
            bodies: ends.bodies,
            entry: ends.entry,
            jacobian,
            present,
            masses: [0.0; 3],
            stiffness: [0.0; 3],
            excess: [0.0; 3],
            supplied: [0.0; 3],
            change: [0.0; 3],
            impulses,
            begun: impulses,
            centre: impulses,
            best: impulses,
            active: 0,
            factored: 0,
        }
    }

    /// A step begins with these impulses.
    pub(super) fn start_from(&mut self, impulses: Triple) {
        self.impulses = impulses;
        (self.begun, self.centre, self.best) = (impulses, impulses, impulses);
    }

    /// Whether there is such a row.
    #[inline(always)]
    pub(super) fn has(&self, row: usize) -> bool {
        self.present >> row & 1 == 1
    }

    /// Whether a row is in the active set.
    #[inline(always)]
    pub(super) fn is_active(&self, row: usize) -> bool {
        self.active >> row & 1 == 1
    }

    /// Relative velocities of all rows, with these velocities of members by index.
    #[inline(always)]
    pub(super) fn relative_of(&self, of: impl Fn(usize) -> Triple) -> Triple {
        let [a, b] = self.bodies.map(|member| if member == FIXED { [0.0; 3] } else { of(member as usize) });
        self.jacobian.relative(a, b)
    }

    /// Relative velocities of all rows, with these velocities of members.
    pub(super) fn relative_in(&self, members: &[Triple]) -> Triple {
        self.relative_of(|member| members[member])
    }

    /// Adds k j j^T of the rows that have become active to the matrix, and takes away that of those that no longer are. The
    /// factors of the matrix are those of the active set then.
    pub(super) fn assemble(&mut self, factor: &mut Factor) {
        let is_in = |set: Set, row: usize| f64::from(set >> row & 1);
        let stiffness: Triple = std::array::from_fn(|row| {
            (is_in(self.active, row) - is_in(self.factored, row)) * self.stiffness[row]
        });
        self.factored = self.active;
        let Jacobian { normal: [nx, ny], second, a: arms_a, b: arms_b } = &self.jacobian;
        let (along, across) = (stiffness[0] + second * stiffness[1], stiffness[2]);
        let xx = along * nx * nx + across * ny * ny;
        let xy = (along - across) * nx * ny;
        let yy = along * ny * ny + across * nx * nx;
        // The coupling of rotation with translation along x and y.
        let turned = |arms: &Triple| {
            let along = stiffness[0] * arms[0] + second * stiffness[1] * arms[1];
            let across = stiffness[2] * arms[2];
            [along * nx + across * ny, along * ny - across * nx]
        };
        let both = |one: &Triple, other: &Triple| {
            (0..3).map(|row| stiffness[row] * one[row] * other[row]).sum::<f64>()
        };
        let ([ax, ay], [bx, by]) = (turned(arms_a), turned(arms_b));
        let [a, b] = self.bodies;
        if a != FIXED {
            factor.add(a, &Block::of_rows([[xx, xy, ax], [xy, yy, ay], [ax, ay, both(arms_a, arms_a)]]));
        }
        if b != FIXED {
            factor.add(b, &Block::of_rows([[xx, xy, bx], [xy, yy, by], [bx, by, both(arms_b, arms_b)]]));
        }
        if let Some(entry) = self.entry {
            let rows = [[-xx, -xy, -ax], [-xy, -yy, -ay], [-bx, -by, -both(arms_a, arms_b)]];
            factor.add_between(entry, &Block::of_rows(rows));
        }
    }
}

/// Rows with a law: which impulse each exerts at a velocity error.
pub(super) trait Constraint: DerefMut<Target = ConstraintRows> {
    /// Impulses of the rows as springs from the multipliers on, within their bounds, and the rows that are inside of these.
    fn law(&self, excess: Triple) -> (Triple, Set);

    /// Whether rows at a bound are at the same bound with these impulses.
    fn keeps_bounds(&self, impulses: Triple, active: Set) -> bool;

    /// The impulse of one row that stops it alone, within its bounds, at this velocity error. Answers the change.
    fn stop(&mut self, row: usize, excess: f64) -> Triple;

    /// Work that the rows yield to their own impulses: the sum of impulse squared times compliance, in the unit of energy.
    fn yielding(&self) -> f64 {
        0.0
    }

    /// Impulses and active set become those of the law.
    #[inline(always)]
    fn obey(&mut self) {
        (self.impulses, self.active) = self.law(self.excess);
    }
}
