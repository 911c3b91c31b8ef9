//! A contact constraint: the scalar form of one SIMD lane.
//!
//! The narrow phase builds it from a manifold, with effective masses and the arms of the Jacobian. The solver keeps it in the
//! blocks of [`contact_constraint_simd`](super::contact_constraint_simd). Its rows are one normal row per point and one
//! friction row for the manifold.

use crate::index::{BodyIndex, PairIndex};
use crate::scaled_parameters::LoadAdaptation;

/// Normal row of one contact point of a [`ContactConstraint`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ContactPoint {
    /// Arm of the normal row about the centre of mass of A: rA x n, for the vector rA from there to the point, length units.
    /// For a platform A that turns about the upright axis Y, the arm is about its Y axis.
    pub(crate) normal_arm_a: f32,
    /// Arm of the normal row about the centre of mass of B: rB x n, for the vector rB from there to the point, length units.
    pub(crate) normal_arm_b: f32,
    /// Effective mass along the normal, mass units: 1 / (1/mA + 1/mB + (rA x n)^2 / IA + (rB x n)^2 / IB). 0 for a point that
    /// does not exist.
    pub normal_mass: f32,
    /// Accumulated normal impulse of the point in one substep, mass units * length units/s, >= 0.
    pub normal_impulse: f32,
    /// Separation of the bodies at the point along the normal, length units; negative for penetration.
    pub separation: f32,
    /// Rest impulse: normal impulse that the soft constraint carries without penetration, mass units * length units/s, >= 0.
    /// Load adaptation changes it.
    pub rest_impulse: f32,
}

/// Contact constraint of a pair. A is the less movable body: static, kinematic, on a hinge, dynamic, in this order.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ContactConstraint {
    /// Index of body A; 0 if it is static.
    pub(crate) a: BodyIndex,
    /// Index of body B, which is never static.
    pub(crate) b: BodyIndex,
    /// Index of the pair of proxies.
    pub(crate) pair: PairIndex,
    /// Unit normal from A to B in world axes, dimensionless.
    pub(crate) normal: [f32; 2],
    /// Reciprocals of the masses of A and B, 1/mass units, >= 0.
    pub(crate) inverse_masses: [f32; 2],
    /// Reciprocals of the moments of inertia of A and B, 1/(mass units * length units^2), >= 0.
    pub(crate) inverse_inertias: [f32; 2],
    /// Friction coefficient of the pair, dimensionless, >= 0.
    pub friction: f32,
    /// Arms of the friction row about the centres of mass of A and B: r x t, averaged over the points, length units. Here r is
    /// the vector to a point and t = (n.y, -n.x) the tangent.
    pub(crate) tangent_arms: [f32; 2],
    /// Effective mass of the friction row, along the tangent, mass units.
    pub(crate) tangent_mass: f32,
    /// Accumulated friction impulse along the tangent in one substep, mass units * length units/s.
    pub tangent_impulse: f32,
    /// Target velocity of B relative to A along the tangent, length units/s: surface velocity of a belt, else 0.
    pub tangent_speed: f32,
    /// Restitution coefficient of the pair, dimensionless.
    pub restitution: f32,
    /// Normal rows of the two points; the second has effective mass 0 if there is one point.
    pub points: [ContactPoint; 2],
    /// Rows and components of three axes; all 0 in plain 2D.
    pub depth: ContactConstraintZ,
}

/// Rows and components that only contact constraints in three axes have. The second tangent is called `across`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ContactConstraintZ {
    /// Z component of the unit normal from A to B, -1..=1, dimensionless.
    pub(crate) normal_z: f32,
    /// Arms of the friction row along the second tangent, about the Z axes through the centres of mass of A and B, length
    /// units.
    pub(crate) across_arms: [f32; 2],
    /// Radii with which A and B roll by friction, length units; 0 for a body that is no ball.
    pub(crate) radii: [f32; 2],
    /// Accumulated friction impulse along the second tangent in one substep, mass units * length units/s.
    pub across_impulse: f32,
    /// Target velocity of B relative to A along the second tangent, length units/s: surface velocity of a belt, else 0.
    pub(crate) across_speed: f32,
    /// Root mean square distance of a contact face from its centre, if its normal is along Z, length units; else 0. It is the
    /// radius at which friction resists rotation about Z.
    pub(crate) spread: f32,
    /// Accumulated angular impulse of friction about Z, mass units * length units^2/s.
    pub twist_impulse: f32,
    /// Impulses summed over the substeps of a step, mass units * length units/s: normal impulses of both points, then friction
    /// along both tangents.
    pub totals: [f32; 4],
}

impl ContactConstraint {
    /// Returns the effective mass of a point along the normal, mass units, from the arms of the point and the masses and
    /// inertias of the constraint.
    pub(crate) fn effective_mass(&self, point: &ContactPoint) -> f32 {
        let ([mass_a, mass_b], [inertia_a, inertia_b]) = (self.inverse_masses, self.inverse_inertias);
        let turning = inertia_a * point.normal_arm_a * point.normal_arm_a
            + inertia_b * point.normal_arm_b * point.normal_arm_b;
        1.0 / (mass_a + mass_b + turning)
    }

    /// Reduces the normal impulses to the rest impulses, where these are smaller, and friction by the same ratio.
    ///
    /// The direct solver raises rest impulses to the normal impulses except in an update that begins far from its solution. The impulse of an
    /// impact acted once, but the warm start of the iterative solver would repeat it in every substep.
    pub(crate) fn forget_impacts(&mut self) {
        let load = |points: &[ContactPoint; 2]| points[0].normal_impulse + points[1].normal_impulse;
        let before = load(&self.points);
        for point in &mut self.points {
            if point.rest_impulse < point.normal_impulse {
                point.normal_impulse = point.rest_impulse;
            }
        }
        let after = load(&self.points);
        if after < before {
            self.tangent_impulse *= after / before;
            self.depth.across_impulse *= after / before;
        }
    }

    /// Returns whether load adaptation still raises the rest impulses of the points: see
    /// [`adapt_load`](crate::contact_solver::load_adaptation::adapt_load).
    pub(crate) fn is_adapting_load(&self, adaptation: &LoadAdaptation) -> bool {
        let [one, two] = &self.points;
        let deepest = one.separation.min(two.separation);
        adaptation.adapted_fraction * (one.normal_impulse + two.normal_impulse)
            > one.rest_impulse + two.rest_impulse
            && deepest < 0.0
            && deepest > adaptation.min_separation
    }
}
