//! Lateral friction of the direct solver: friction along the depth axis, for islands in 2.5D whose contact normals lie in the
//! plane.
//!
//! Such an island goes to the direct solver if a heavy body lies on a light one. The soft contacts of the iterative solver
//! yield where they carry far more than the weight of their own two bodies.
//!
//! If all normals lie in the plane and no body rolls along the depth axis, friction is the only force along that axis, and it
//! turns no body. So the plane is solved first. Friction along the depth axis gets the part of the friction cone that friction
//! in the plane leaves. At a sliding contact the direction of the slip divides the friction between the plane and the depth
//! axis. A contact with another normal is left out while it has no load; else its island goes to the iterative solver.

use super::constraint::FIXED;
use super::island_body::{MemberIndex, Members, finite_or_zero};
use crate::constraint_graph::{ContactConstraint, ContactConstraintZ};
use crate::math::plane::dot;

/// Returns whether a contact lies in the plane: its normal has no depth component, and no ball rolls along the depth axis by
/// it.
pub(super) fn is_planar(contact: &ContactConstraint) -> bool {
    contact.depth.normal_z == 0.0 && contact.depth.radii == [0.0; 2]
}

/// Sets all impulses of a contact constraint to 0.
pub(super) fn clear_impulses(contact: &mut ContactConstraint) {
    contact.points.iter_mut().for_each(|point| (point.normal_impulse, point.rest_impulse) = (0.0, 0.0));
    contact.tangent_impulse = 0.0;
    (contact.depth.across_impulse, contact.depth.twist_impulse) = (0.0, 0.0);
    contact.depth.totals = [0.0; 4];
}

/// Friction row of a contact along the depth axis. A contact of an island in 2.5D has one beside its
/// [`ContactRows`](super::contact::ContactRows).
#[derive(Debug, Clone, Copy)]
pub(super) struct LateralFriction {
    /// Effective mass of the row, mass units.
    pub(super) effective_mass: f64,
    /// Friction coefficient, dimensionless, >= 0.
    pub(super) friction: f64,
    /// Velocity of B relative to A along the depth axis by kinematic bodies and belts, length units/s.
    prescribed_velocity: f64,
    /// Impulse on B along the depth axis over the whole step, mass units * length units/s.
    pub(super) impulse: f64,
}

impl LateralFriction {
    /// Returns the row of a stored contact constraint, whose impulses are those of one of `substeps` substeps. The second
    /// tangent of the constraint points against the depth axis, so signs change.
    pub(super) fn new(contact: &ContactConstraint, substeps: f64) -> Self {
        let [a, b] = contact.inverse_masses;
        LateralFriction {
            effective_mass: 1.0 / f64::from(a + b),
            friction: f64::from(contact.friction),
            prescribed_velocity: f64::from(contact.depth.across_speed),
            impulse: f64::from(-contact.depth.across_impulse) * substeps,
        }
    }

    /// Adds the velocity of a kinematic body A (x, y in length units/s, angular in radians/s, depth axis in length units/s) to
    /// the prescribed velocity of the row. `arm` is the angular part of the Jacobian at A for the second tangent, length units.
    pub(super) fn add_prescribed_velocity(&mut self, [_, _, spin, z]: [f64; 4], arm: f64) {
        self.prescribed_velocity += spin * arm - z;
    }

    /// Stores the impulse of the row in the contact constraint: per substep for the iterative solver, and as the total over the
    /// step.
    pub(super) fn store(&self, contact: &mut ContactConstraintZ, substeps: f64) {
        contact.totals[3] = finite_or_zero(-self.impulse) as f32;
        contact.across_impulse = finite_or_zero(-self.impulse / substeps) as f32;
    }

    /// Returns the velocity of B relative to A along the depth axis, length units/s, with the prescribed velocity. `bodies` are
    /// indices into `members`, or [`FIXED`].
    #[inline(never)]
    pub(super) fn slip_velocity(&self, bodies: [MemberIndex; 2], members: &Members) -> f64 {
        let [a, b] = bodies.map(|at| if at == FIXED { 0.0 } else { members[at].depth_velocity });
        b - a + self.prescribed_velocity
    }
}

/// Applies `impulse` along the depth axis to body B of a contact, and the opposite impulse to A. Unit: mass units * length
/// units/s.
#[inline(never)]
pub(super) fn apply_lateral_impulse(bodies: [MemberIndex; 2], members: &mut Members, impulse: f64) {
    for (member, impulse) in bodies.into_iter().zip([-impulse, impulse]) {
        if member != FIXED {
            let member = &mut members[member];
            member.depth_velocity += impulse / member.mass;
        }
    }
}

/// Returns whether a contact excludes a solution of its island in the plane: it is not planar, and its bodies approach too fast.
/// Then its penetration would exceed `max_penetration` (length units) after a further step of `dt` seconds. `velocities` are
/// those of A and B: x, y (length units/s), angular (radians/s), depth axis (length units/s).
#[inline(never)]
pub(super) fn blocks_planar_solution(
    contact: &ContactConstraint,
    velocities: [[f32; 4]; 2],
    dt: f32,
    max_penetration: f32,
) -> bool {
    if is_planar(contact) {
        return false;
    }
    // Angular velocities are left out: rotation hardly moves bodies towards such contacts.
    let [[ax, ay, _, az], [bx, by, _, bz]] = velocities;
    let along = dot(contact.normal, [bx - ax, by - ay]) + contact.depth.normal_z * (bz - az);
    contact.points.iter().any(|point| point.separation + dt * along < -max_penetration)
}
