//! Rolling resistance: a torque against the rotation of two touching bodies relative to each other. It is at most the lever arm of
//! the pair (coefficient * radius) times the normal force.
//!
//! Each contact with rolling resistance has an angular row. The relaxation of each substep solves it after the contacts, whose
//! normal impulses bound it: the method of Box2D 3 (E. Catto, `rollingResistance` in `contact_solver.c`). The rows are listed
//! apart from the contacts, so that contacts without rolling resistance cost nothing.
//!
//! A ball that rolls on a plane decelerates by c r^2 m g / (I + m r^2). The coefficient is c, gravity g, and mass, radius and moment
//! of inertia of the ball are m, r and I. A solid disc decelerates by 2/3 c g.

use crate::bodies::{BodySet, MotionState};
use crate::broad_phase::pairs::Pairs;
use crate::broad_phase::proxies::Proxies;
use crate::constraint_graph::{ConstraintGraph, ConstraintHandle, ConstraintKind};
use crate::index::{BodyIndex, DenseIndex, PairIndex};
use crate::narrow_phase::combined_surface::rolling_arm_of;
use crate::storage::order::sort_by_number;

/// Angular row of a contact with rolling resistance.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RollingRow {
    pair: PairIndex,
    kind: ConstraintKind,
    handle: ConstraintHandle,
    /// Bodies A and B; [`BodyIndex::PLACEHOLDER`] for a static A.
    bodies: [BodyIndex; 2],
    /// Reciprocals of the moments of inertia of A and B, 1/(mass units * length units^2), >= 0.
    inverse_inertias: [f32; 2],
    /// Effective mass of the row, mass units * length units^2, >= 0.
    mass: f32,
    /// Greatest torque by normal force, length units, > 0.
    arm: f32,
    /// Accumulated angular impulse in one substep, mass units * length units^2/s.
    impulse: f32,
}

/// Lists the rows of all awake contacts with rolling resistance in the iterative solver, sorted by creation numbers.
pub(crate) fn list_rolling_rows(
    rows: &mut Vec<RollingRow>,
    pairs: &mut Pairs,
    proxies: &Proxies,
    constraints: &ConstraintGraph,
) {
    for pair in pairs.awake() {
        let [a, b] = pairs.proxies_of(pair).map(|proxy| proxies.proxy(proxy));
        let arm = rolling_arm_of(a, b);
        let listed = pairs.constraint(pair).filter(|&(_, handle)| constraints.parked(handle).is_none());
        let Some((kind, handle)) = listed.filter(|_| arm > 0.0) else {
            pairs.state_mut(pair).rolling_impulse = 0.0;
            continue;
        };
        let contact = constraints.get(kind, handle);
        let [inertia_a, inertia_b] = contact.inverse_inertias;
        let inverse = inertia_a + inertia_b;
        let mut row = RollingRow {
            pair,
            kind,
            handle,
            bodies: [contact.a, contact.b],
            inverse_inertias: contact.inverse_inertias,
            mass: if inverse > 0.0 { 1.0 / inverse } else { 0.0 },
            arm,
            impulse: 0.0,
        };
        row.impulse = row.limited(pairs.state(pair).rolling_impulse, constraints);
        rows.push(row);
    }
    sort_by_number(rows, |row| pairs.creation_numbers(proxies, row.pair));
}

/// Adds the velocity changes by the accumulated impulses to the warm start of the bodies, radians/s.
pub(crate) fn warm_start_rolling(rows: &[RollingRow], bodies: &mut BodySet) {
    for row in rows {
        for (body, change) in row.spin_changes(row.impulse) {
            bodies.warm_start[body][2] += change;
        }
    }
}

/// Solves all rows once: no bodies rotate relative to each other, as far as the normal impulses of their contacts allow.
pub(crate) fn relax_rolling(
    rows: &mut [RollingRow],
    constraints: &ConstraintGraph,
    states: &mut [MotionState],
) {
    for row in rows {
        let [a, b] = row.bodies.map(|body| states[body.position()].velocity[2]);
        let impulse = row.limited(row.impulse - row.mass * (b - a), constraints);
        for (body, change) in row.spin_changes(impulse - row.impulse) {
            states[body.position()].velocity[2] += change;
        }
        row.impulse = impulse;
    }
}

/// Stores the accumulated impulses in the pairs, for the warm start of the next step.
pub(crate) fn store_rolling(rows: &[RollingRow], pairs: &mut Pairs) {
    rows.iter().for_each(|row| pairs.state_mut(row.pair).rolling_impulse = row.impulse);
}

/// Multiplies the accumulated impulses of all awake pairs by `factor`, dimensionless: the ratio of two substep lengths.
pub(crate) fn scale_rolling_impulses(pairs: &mut Pairs, factor: f32) {
    for pair in pairs.awake() {
        pairs.state_mut(pair).scale_rolling_impulse(factor);
    }
}

impl RollingRow {
    /// Returns `impulse` clamped to the limit by the present normal impulses, mass units * length units^2/s; 0 for NaN.
    fn limited(&self, impulse: f32, constraints: &ConstraintGraph) -> f32 {
        let [one, other] = constraints.points_of(self.kind, self.handle);
        let most = self.arm * (one.normal_impulse + other.normal_impulse);
        if impulse > most {
            most
        } else if impulse < -most {
            -most
        } else if impulse.is_nan() {
            0.0
        } else {
            impulse
        }
    }

    /// Returns the bodies that an angular impulse (mass units * length units^2/s) rotates, with the changes of their angular
    /// velocities, radians/s.
    fn spin_changes(&self, impulse: f32) -> impl Iterator<Item = (BodyIndex, f32)> + use<> {
        let [a, b] = self.inverse_inertias;
        let changes = [-a * impulse, b * impulse];
        self.bodies.into_iter().zip(changes).filter(|&(body, _)| body != BodyIndex::PLACEHOLDER)
    }
}
