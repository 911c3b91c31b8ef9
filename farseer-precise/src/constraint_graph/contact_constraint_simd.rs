//! Contact constraints in SIMD blocks: four constraints of the same kind, one per lane. [`ContactConstraint`] is the scalar
//! form of a lane, and documents the fields.

use crate::index::{BodyIndex, PairIndex};
use wide::f32x4;

use super::contact_constraint::{ContactConstraint, ContactConstraintZ, ContactPoint};

/// Normal rows of one contact point in four constraints, one per lane.
#[derive(Debug, Clone, Copy, Default)]
pub struct ContactPointSimd {
    /// Arms of the normal rows about the centres of mass of A: rA x n, for the vector rA from there to the point, length units.
    pub(crate) normal_arm_a: f32x4,
    /// Arms of the normal rows about the centres of mass of B: rB x n, for the vector rB from there to the point, length units.
    pub(crate) normal_arm_b: f32x4,
    /// Effective masses of the normal rows, mass units; 0 for points that do not exist.
    pub(crate) normal_mass: f32x4,
    /// Accumulated normal impulses of the point in one substep, mass units * length units/s, >= 0.
    pub(crate) normal_impulse: f32x4,
    /// Separations along the normal, length units, negative for penetration; updated in each substep.
    pub(crate) separation: f32x4,
    /// Rest impulses: normal impulses that the soft constraints carry without penetration, mass units * length units/s, >= 0.
    /// Load adaptation changes them.
    pub(crate) rest_impulse: f32x4,
}

impl ContactPointSimd {
    /// Returns the arms of the normal rows about the centres of mass of A and B, length units.
    #[inline(always)]
    pub(crate) fn normal_arms(&self) -> [f32x4; 2] {
        [self.normal_arm_a, self.normal_arm_b]
    }
}

/// Four contact constraints with at most `P` points each. A block has one friction row per constraint: along the tangent (n.y,
/// -n.x), at the mean of the points.
///
/// The fields that every substep reads come first and are adjacent: in large scenes the solver waits for memory.
#[derive(Debug, Clone, Copy)]
#[repr(C)]
pub(crate) struct ContactConstraintSimd<const P: usize> {
    /// Indices of bodies A; 0 for static ones and empty lanes.
    pub(crate) a: [BodyIndex; 4],
    /// Indices of bodies B; 0 for empty lanes.
    pub(crate) b: [BodyIndex; 4],
    /// Components x of the unit normals from A to B, dimensionless; `normal_y` has the components y.
    pub(crate) normal_x: f32x4,
    pub(crate) normal_y: f32x4,
    /// Reciprocals of the masses of A, 1/mass units, >= 0; `inverse_mass_b` has those of B.
    pub(crate) inverse_mass_a: f32x4,
    pub(crate) inverse_mass_b: f32x4,
    /// Reciprocals of the moments of inertia of A, 1/(mass units * length units^2), >= 0; `inverse_inertia_b` has those of B.
    pub(crate) inverse_inertia_a: f32x4,
    pub(crate) inverse_inertia_b: f32x4,
    /// Normal rows of the points.
    pub(crate) points: [ContactPointSimd; P],
    /// Friction coefficients of the pairs, dimensionless, >= 0.
    pub(crate) friction: f32x4,
    /// Arms of the friction rows about the centres of mass of A: r x t, averaged over the points, length units. Here r is the
    /// vector to a point and t the tangent; `tangent_arm_b` has the arms about B.
    pub(crate) tangent_arm_a: f32x4,
    pub(crate) tangent_arm_b: f32x4,
    /// Effective masses of the friction rows, along the tangent, mass units.
    pub(crate) tangent_mass: f32x4,
    /// Accumulated friction impulses along the tangent in one substep, mass units * length units/s.
    pub(crate) tangent_impulse: f32x4,
    /// Target velocities of B relative to A along the tangent, length units/s: surface velocity of a belt, else 0.
    pub(crate) tangent_speed: f32x4,
    /// Masks of each point, one per lane: all bits set if the point has had a normal impulse in this step, else 0.
    pub(crate) was_active: [f32x4; P],
    /// Restitution coefficients of the pairs, dimensionless.
    pub(crate) restitution: f32x4,
    /// Normal velocities of B relative to A at each point, at the beginning of the step, length units/s, for restitution;
    /// negative while the bodies approach.
    pub(crate) approach_velocity: [f32x4; P],
    /// Separations at each point at the beginning of the step, length units.
    pub(crate) initial_separation: [f32x4; P],
    /// Indices of the pairs of proxies.
    pub(crate) pair: [PairIndex; 4],
}

impl<const P: usize> ContactConstraintSimd<P> {
    /// Sets `was_active` of each point that has a normal impulse.
    #[inline(always)]
    pub(crate) fn record_active_points(&mut self) {
        for (was_active, point) in self.was_active.iter_mut().zip(&self.points) {
            *was_active |= point.normal_impulse.simd_gt(f32x4::ZERO);
        }
    }
}

impl<const P: usize> Default for ContactConstraintSimd<P> {
    fn default() -> Self {
        ContactConstraintSimd {
            a: [BodyIndex::PLACEHOLDER; 4],
            b: [BodyIndex::PLACEHOLDER; 4],
            pair: [PairIndex::default(); 4],
            normal_x: f32x4::ZERO,
            normal_y: f32x4::ZERO,
            inverse_mass_a: f32x4::ZERO,
            inverse_mass_b: f32x4::ZERO,
            inverse_inertia_a: f32x4::ZERO,
            inverse_inertia_b: f32x4::ZERO,
            friction: f32x4::ZERO,
            tangent_arm_a: f32x4::ZERO,
            tangent_arm_b: f32x4::ZERO,
            tangent_mass: f32x4::ZERO,
            tangent_impulse: f32x4::ZERO,
            tangent_speed: f32x4::ZERO,
            restitution: f32x4::ZERO,
            approach_velocity: [f32x4::ZERO; P],
            initial_separation: [f32x4::ZERO; P],
            was_active: [f32x4::ZERO; P],
            points: [ContactPointSimd::default(); P],
        }
    }
}

/// A block of four contact constraints of any kind, with access to single lanes.
pub trait SimdSlot: Copy + Default {
    /// Returns the constraint in `lane`, 0..=3, in scalar form.
    fn extract(&self, lane: usize) -> ContactConstraint;
    /// Returns the bodies A and B of the constraint in `lane`, 0..=3.
    fn bodies_of(&self, lane: usize) -> [BodyIndex; 2];
    /// Returns the points of the constraint in `lane`, 0..=3, in scalar form.
    fn points_of(&self, lane: usize) -> [ContactPoint; 2];
    /// Overwrites the constraint in `lane`, 0..=3.
    fn insert(&mut self, lane: usize, constraint: &ContactConstraint);
    /// Returns the pair indices of the four constraints, mutably.
    fn pair_indices(&mut self) -> &mut [PairIndex; 4];
    /// Returns the normal rows of the points, mutably, four lanes each.
    fn points_mut(&mut self) -> &mut [ContactPointSimd];
}

/// A block of four contact constraints as the contact solver uses it, in the plane or in three axes.
pub(crate) trait SimdContacts<const P: usize>: SimdSlot {
    /// Whether the bodies also move along Z.
    const IS_3D: bool;

    /// Returns the rows and components of the block that also exist in the plane.
    fn constraint(&self) -> &ContactConstraintSimd<P>;
    /// Returns, mutably, the rows and components of the block that also exist in the plane.
    fn constraint_mut(&mut self) -> &mut ContactConstraintSimd<P>;
    /// Returns the z components of the four unit normals, dimensionless, -1..=1.
    fn normal_z(&self) -> f32x4;
}

impl<const P: usize> SimdContacts<P> for ContactConstraintSimd<P> {
    const IS_3D: bool = false;

    #[inline(always)]
    fn constraint(&self) -> &ContactConstraintSimd<P> {
        self
    }

    #[inline(always)]
    fn constraint_mut(&mut self) -> &mut ContactConstraintSimd<P> {
        self
    }

    #[inline(always)]
    fn normal_z(&self) -> f32x4 {
        f32x4::ZERO
    }
}

/// Returns the value in `lane`, 0..=3.
#[inline(always)]
pub(crate) fn get_lane(lanes: &f32x4, lane: usize) -> f32 {
    lanes.as_array()[lane]
}

/// Overwrites the value in `lane`, 0..=3.
#[inline(always)]
pub(crate) fn set_lane(lanes: &mut f32x4, lane: usize, value: f32) {
    lanes.as_mut_array()[lane] = value;
}

/// Returns the points of the lane with this index, 0..=3, in scalar form.
#[inline(always)]
pub(crate) fn extract_points<const P: usize>(
    points: &[ContactPointSimd; P],
    index: usize,
) -> [ContactPoint; 2] {
    let mut contact_points = [ContactPoint::default(); 2];
    for (lane, point) in contact_points.iter_mut().zip(points) {
        *lane = ContactPoint {
            normal_arm_a: get_lane(&point.normal_arm_a, index),
            normal_arm_b: get_lane(&point.normal_arm_b, index),
            normal_mass: get_lane(&point.normal_mass, index),
            normal_impulse: get_lane(&point.normal_impulse, index),
            separation: get_lane(&point.separation, index),
            rest_impulse: get_lane(&point.rest_impulse, index),
        };
    }
    contact_points
}

/// Overwrites the points of the lane with this index, 0..=3.
#[inline(always)]
pub(crate) fn insert_points<const P: usize>(
    points: &mut [ContactPointSimd; P],
    index: usize,
    lanes: &[ContactPoint; 2],
) {
    for (point, from) in points.iter_mut().zip(lanes) {
        set_lane(&mut point.normal_arm_a, index, from.normal_arm_a);
        set_lane(&mut point.normal_arm_b, index, from.normal_arm_b);
        set_lane(&mut point.normal_mass, index, from.normal_mass);
        set_lane(&mut point.normal_impulse, index, from.normal_impulse);
        set_lane(&mut point.separation, index, from.separation);
        set_lane(&mut point.rest_impulse, index, from.rest_impulse);
    }
}

impl<const P: usize> SimdSlot for ContactConstraintSimd<P> {
    fn extract(&self, lane: usize) -> ContactConstraint {
        ContactConstraint {
            a: self.a[lane],
            b: self.b[lane],
            pair: self.pair[lane],
            normal: [get_lane(&self.normal_x, lane), get_lane(&self.normal_y, lane)],
            inverse_masses: [get_lane(&self.inverse_mass_a, lane), get_lane(&self.inverse_mass_b, lane)],
            inverse_inertias: [
                get_lane(&self.inverse_inertia_a, lane),
                get_lane(&self.inverse_inertia_b, lane),
            ],
            friction: get_lane(&self.friction, lane),
            tangent_arms: [get_lane(&self.tangent_arm_a, lane), get_lane(&self.tangent_arm_b, lane)],
            tangent_mass: get_lane(&self.tangent_mass, lane),
            tangent_impulse: get_lane(&self.tangent_impulse, lane),
            tangent_speed: get_lane(&self.tangent_speed, lane),
            restitution: get_lane(&self.restitution, lane),
            points: extract_points(&self.points, lane),
            depth: ContactConstraintZ::default(),
        }
    }

    fn bodies_of(&self, lane: usize) -> [BodyIndex; 2] {
        [self.a[lane], self.b[lane]]
    }

    #[inline]
    fn points_of(&self, lane: usize) -> [ContactPoint; 2] {
        extract_points(&self.points, lane)
    }

    fn insert(&mut self, lane: usize, constraint: &ContactConstraint) {
        (self.a[lane], self.b[lane], self.pair[lane]) = (constraint.a, constraint.b, constraint.pair);
        set_lane(&mut self.normal_x, lane, constraint.normal[0]);
        set_lane(&mut self.normal_y, lane, constraint.normal[1]);
        set_lane(&mut self.inverse_mass_a, lane, constraint.inverse_masses[0]);
        set_lane(&mut self.inverse_mass_b, lane, constraint.inverse_masses[1]);
        set_lane(&mut self.inverse_inertia_a, lane, constraint.inverse_inertias[0]);
        set_lane(&mut self.inverse_inertia_b, lane, constraint.inverse_inertias[1]);
        set_lane(&mut self.friction, lane, constraint.friction);
        set_lane(&mut self.tangent_arm_a, lane, constraint.tangent_arms[0]);
        set_lane(&mut self.tangent_arm_b, lane, constraint.tangent_arms[1]);
        set_lane(&mut self.tangent_mass, lane, constraint.tangent_mass);
        set_lane(&mut self.tangent_impulse, lane, constraint.tangent_impulse);
        set_lane(&mut self.tangent_speed, lane, constraint.tangent_speed);
        set_lane(&mut self.restitution, lane, constraint.restitution);
        insert_points(&mut self.points, lane, &constraint.points);
    }

    fn pair_indices(&mut self) -> &mut [PairIndex; 4] {
        &mut self.pair
    }

    fn points_mut(&mut self) -> &mut [ContactPointSimd] {
        &mut self.points
    }
}
