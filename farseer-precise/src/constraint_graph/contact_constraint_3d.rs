//! Contact constraints in three axes, four in SIMD lanes: the planar constraint, a normal component along z, and two tangents.
//!
//! With n the normal from A to B, the first tangent is t = (n.y, -n.x, 0) / |(n.x, n.y)|, or the x axis if n is the z axis. The
//! second tangent is n x t. Bodies rotate about z only. With r the vector from the centre of mass to the contact point, the arm
//! of a tangent is (r x t).z, in length units.
//!
//! A sphere of radius R rotates about all axes. As body B it has r = -R n, and a friction impulse f t + g (n x t) has the
//! angular impulse -R (f (n x t) - g t). As body A it has r = R n and the opposite impulse, hence the same angular impulse.

use crate::index::{BodyIndex, PairIndex};
use wide::f32x4;

use super::contact_constraint::{ContactConstraint, ContactConstraintZ, ContactPoint};
use super::contact_constraint_simd::{
    ContactConstraintSimd, ContactPointSimd, SimdContacts, SimdSlot, get_lane, set_lane,
};

/// Four contact constraints in three axes with `P` points each.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct ContactConstraint3Simd<const P: usize> {
    /// Planar contact constraint: bodies, normal in x and y, contact points and the row of the first tangent.
    pub(crate) planar: ContactConstraintSimd<P>,
    /// z component of the unit normal from A to B, dimensionless, -1..=1.
    pub(crate) normal_z: f32x4,
    /// First tangent t = (n.y, -n.x, 0) / |(n.x, n.y)| for the normal n: x and y components of the unit vector, dimensionless.
    pub(crate) tangent: [f32x4; 2],
    /// Second tangent n x t, for the normal n and the first tangent t: x, y and z components of the unit vector, dimensionless.
    pub(crate) second_tangent: [f32x4; 3],
    /// Arm (r x u).z of the second tangent u about the centre of mass of body A, in length units. r points from the centre of
    /// mass to the contact point.
    pub(crate) second_tangent_arm_a: f32x4,
    /// Arm (r x u).z of the second tangent u about the centre of mass of body B, in length units.
    pub(crate) second_tangent_arm_b: f32x4,
    /// Radius of body A if it is a sphere that rotates about all axes, in length units; 0 for other shapes.
    pub(crate) radius_a: f32x4,
    /// Radius of body B if it is a sphere that rotates about all axes, in length units; 0 for other shapes.
    pub(crate) radius_b: f32x4,
    /// Inverse of the 2x2 matrix J M^-1 J^T of both tangents, elements [k11, k12, k22] in mass units: the effective mass of
    /// sticking friction.
    pub(crate) friction_mass: [f32x4; 3],
    /// Effective mass of sliding friction, in mass units: 1 / greatest eigenvalue of J M^-1 J^T. With it the change of the
    /// friction impulse overshoots in no direction.
    pub(crate) sliding_mass: f32x4,
    /// Accumulated friction impulse along the second tangent, mass units * length units/s.
    pub(crate) second_tangent_impulse: f32x4,
    /// Velocity of B relative to A along the second tangent that friction aims at, by conveyor belts, in length units/s.
    pub(crate) second_surface_speed: f32x4,
    /// Radius of gyration of the contact patch of two faces perpendicular to z, in length units. Pressure at this distance from
    /// the centroid resists rotation about z; 0 for other contacts.
    pub(crate) pressure_radius: f32x4,
    /// Effective mass of twist friction, 1 / (1/IA + 1/IB) with the moments of inertia IA and IB about z, in mass units *
    /// length units^2.
    pub(crate) twist_mass: f32x4,
    /// Accumulated angular impulse of twist friction about z, mass units * length units^2/s.
    pub(crate) twist_impulse: f32x4,
    /// Impulses summed over the substeps of the current step, in mass units * length units/s: normal impulses of both contact
    /// points, then friction impulses along the first and the second tangent.
    pub(crate) step_impulses: [f32x4; 4],
}

/// Returns the first tangent (x, y) and the second tangent (x, y, z) of a unit normal from A to B. Both are dimensionless unit
/// vectors in world axes.
pub(crate) fn tangents([x, y, z]: [f32; 3]) -> ([f32; 2], [f32; 3]) {
    let squared = x * x + y * y;
    let tangent = if squared > 1e-12 {
        let length = squared.sqrt();
        [y / length, -x / length]
    } else {
        [1.0, 0.0]
    };
    (tangent, [-z * tangent[1], z * tangent[0], x * tangent[1] - y * tangent[0]])
}

/// Inverts the symmetric 2x2 matrix [[a, b], [b, c]] = J M^-1 J^T of the tangents. Returns the inverse [k11, k12, k22] and 1 /
/// greatest eigenvalue, both in mass units. The inverse of a singular matrix is replaced by 1 / trace on the diagonal and 0
/// beside it.
fn invert_tangent_matrix([a, b, c]: [f32; 3]) -> ([f32; 3], f32) {
    let determinant = a * c - b * b;
    if determinant <= 1e-9 * a * c {
        let one = |of: f32| if of > 0.0 { 1.0 / of } else { 0.0 };
        let greatest = a + c;
        return ([one(greatest), 0.0, one(greatest)], one(greatest));
    }
    let inverse = 1.0 / determinant;
    // The eigenvalues of [[a, b], [b, c]] are mean +- sqrt(mean^2 - determinant), with mean = (a + c) / 2.
    let middle = 0.5 * (a + c);
    let greatest = middle + (middle * middle - determinant).max(0.0).sqrt();
    ([c * inverse, -b * inverse, a * inverse], 1.0 / greatest)
}

impl<const P: usize> ContactConstraint3Simd<P> {
    /// Computes both tangents and the effective masses of friction and twist friction for the lane `at`, from the contact
    /// constraint `lane`.
    fn update_derived(&mut self, at: usize, lane: &ContactConstraint) {
        let ContactConstraintZ { normal_z, across_arms, radii, .. } = lane.depth;
        let (tangent, across) = tangents([lane.normal[0], lane.normal[1], normal_z]);
        let [ia, ib] = lane.inverse_inertias;
        let along = |one: [f32; 2], other: [f32; 2]| ia * one[0] * other[0] + ib * one[1] * other[1];
        let round = ia * radii[0] * radii[0] + ib * radii[1] * radii[1];
        let mass = lane.inverse_masses[0] + lane.inverse_masses[1];
        let (block, slide_mass) = invert_tangent_matrix([
            mass + along(lane.tangent_arms, lane.tangent_arms)
                + round * (across[0] * across[0] + across[1] * across[1]),
            along(lane.tangent_arms, across_arms) - round * (across[0] * tangent[0] + across[1] * tangent[1]),
            mass + along(across_arms, across_arms)
                + round * (tangent[0] * tangent[0] + tangent[1] * tangent[1]),
        ]);
        let turns = ia + ib;
        self.tangent.iter_mut().zip(tangent).for_each(|(lanes, of)| set_lane(lanes, at, of));
        self.second_tangent.iter_mut().zip(across).for_each(|(lanes, of)| set_lane(lanes, at, of));
        self.friction_mass.iter_mut().zip(block).for_each(|(lanes, of)| set_lane(lanes, at, of));
        set_lane(&mut self.sliding_mass, at, slide_mass);
        set_lane(&mut self.twist_mass, at, if turns > 0.0 { 1.0 / turns } else { 0.0 });
    }
}

impl<const P: usize> ContactConstraint3Simd<P> {
    /// Adds the accumulated impulses of the current substep to `step_impulses`. `add(total, impulse)` returns the new total; a
    /// caller that subtracts passes `total - impulse`.
    #[inline(always)]
    pub(crate) fn accumulate_step_impulses(&mut self, add: impl Fn(f32x4, f32x4) -> f32x4) {
        for (total, point) in self.step_impulses.iter_mut().zip(&self.planar.points) {
            *total = add(*total, point.normal_impulse);
        }
        self.step_impulses[2] = add(self.step_impulses[2], self.planar.tangent_impulse);
        self.step_impulses[3] = add(self.step_impulses[3], self.second_tangent_impulse);
    }
}

impl<const P: usize> SimdSlot for ContactConstraint3Simd<P> {
    fn extract(&self, at: usize) -> ContactConstraint {
        let space = ContactConstraintZ {
            normal_z: get_lane(&self.normal_z, at),
            across_arms: [get_lane(&self.second_tangent_arm_a, at), get_lane(&self.second_tangent_arm_b, at)],
            radii: [get_lane(&self.radius_a, at), get_lane(&self.radius_b, at)],
            across_impulse: get_lane(&self.second_tangent_impulse, at),
            across_speed: get_lane(&self.second_surface_speed, at),
            spread: get_lane(&self.pressure_radius, at),
            twist_impulse: get_lane(&self.twist_impulse, at),
            totals: self.step_impulses.map(|total| get_lane(&total, at)),
        };
        ContactConstraint { depth: space, ..self.planar.extract(at) }
    }

    fn bodies_of(&self, at: usize) -> [BodyIndex; 2] {
        self.planar.bodies_of(at)
    }

    fn points_of(&self, at: usize) -> [ContactPoint; 2] {
        self.planar.points_of(at)
    }

    fn insert(&mut self, at: usize, lane: &ContactConstraint) {
        self.planar.insert(at, lane);
        let space = &lane.depth;
        set_lane(&mut self.normal_z, at, space.normal_z);
        set_lane(&mut self.second_tangent_arm_a, at, space.across_arms[0]);
        set_lane(&mut self.second_tangent_arm_b, at, space.across_arms[1]);
        set_lane(&mut self.radius_a, at, space.radii[0]);
        set_lane(&mut self.radius_b, at, space.radii[1]);
        set_lane(&mut self.second_tangent_impulse, at, space.across_impulse);
        set_lane(&mut self.second_surface_speed, at, space.across_speed);
        set_lane(&mut self.pressure_radius, at, space.spread);
        set_lane(&mut self.twist_impulse, at, space.twist_impulse);
        self.step_impulses.iter_mut().zip(space.totals).for_each(|(lanes, of)| set_lane(lanes, at, of));
        self.update_derived(at, lane);
    }

    fn pair_indices(&mut self) -> &mut [PairIndex; 4] {
        self.planar.pair_indices()
    }

    fn points_mut(&mut self) -> &mut [ContactPointSimd] {
        self.planar.points_mut()
    }
}

impl<const P: usize> SimdContacts<P> for ContactConstraint3Simd<P> {
    const IS_3D: bool = true;

    #[inline(always)]
    fn constraint(&self) -> &ContactConstraintSimd<P> {
        &self.planar
    }

    #[inline(always)]
    fn constraint_mut(&mut self) -> &mut ContactConstraintSimd<P> {
        &mut self.planar
    }

    #[inline(always)]
    fn normal_z(&self) -> f32x4 {
        self.normal_z
    }
}

#[cfg(test)]
mod tests {
    use super::{invert_tangent_matrix, tangents};

    #[test]
    fn normal_and_tangents_are_orthonormal() {
        for normal in [[0.0, -1.0, 0.0], [0.6, 0.0, 0.8], [0.0, 0.0, -1.0], [0.48, -0.6, 0.64]] {
            let ([tx, ty], across) = tangents(normal);
            let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            let all = [normal, [tx, ty, 0.0], across];
            for (i, &one) in all.iter().enumerate() {
                for (j, &other) in all.iter().enumerate() {
                    let expected = if i == j { 1.0 } else { 0.0 };
                    assert!((dot(one, other) - expected).abs() < 1e-6, "{normal:?}");
                }
            }
        }
    }

    #[test]
    fn tangent_matrix_times_its_inverse_is_the_identity() {
        let ([a, b, c], greatest) = invert_tangent_matrix([3.0, 1.0, 2.0]);
        let close = |one: f32, other: f32| (one - other).abs() < 1e-6;
        assert!(close(3.0 * a + b, 1.0) && close(3.0 * b + c, 0.0) && close(a + 2.0 * b, 0.0));
        // The eigenvalues are (5 +- sqrt 5) / 2.
        assert!(close(greatest, 2.0 / (5.0 + 5.0_f32.sqrt())));
    }
}
