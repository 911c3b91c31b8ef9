//! Changes of all accumulated impulses of the constraint graph: another substep length, and impulses that are not finite.

use wide::f32x4;

use super::{ConstraintGraph, ContactPointSimd};
use crate::depth::feature_gate::IS_DEPTH_ENABLED;

/// Returns the lanes of `numbers`, with 0 in place of each lane that is not finite.
fn zero_unless_finite(numbers: f32x4) -> f32x4 {
    numbers & (numbers * f32x4::ZERO).simd_eq(f32x4::ZERO)
}

impl ConstraintGraph {
    /// Multiplies the accumulated impulses of all colours by `factor`, dimensionless: the ratio of two substep lengths, since an
    /// impulse is force times time. `has_depth`: whether the world has a depth axis.
    pub(crate) fn scale_impulses(&mut self, factor: f32, has_depth: bool) {
        let factor = f32x4::splat(factor);
        self.for_each_impulse(has_depth, |impulse| *impulse = zero_unless_finite(*impulse * factor));
    }

    /// Sets the accumulated impulses, rest impulses and separations in all colours to 0 where they are not finite. `has_depth`:
    /// whether the world has a depth axis.
    pub fn reset_non_finite(&mut self, has_depth: bool) {
        self.for_each_impulse(has_depth, |impulse| *impulse = zero_unless_finite(*impulse));
        let mut forget = |points: &mut [ContactPointSimd]| {
            points.iter_mut().for_each(|point| point.separation = zero_unless_finite(point.separation));
        };
        self.two_points.for_each(|row| forget(&mut row.points));
        self.one_point.for_each(|row| forget(&mut row.points));
        self.two_points_static.for_each(|row| forget(&mut row.points));
        self.one_point_static.for_each(|row| forget(&mut row.points));
        self.depth.for_each_point(&mut forget);
    }

    /// Calls `change` with each accumulated impulse and rest impulse of the contact constraints in the colours, four lanes at a
    /// time.
    fn for_each_impulse(&mut self, has_depth: bool, change: impl Fn(&mut f32x4)) {
        if IS_DEPTH_ENABLED && has_depth {
            return self.depth.for_each_impulse(&change);
        }
        let change = |tangent: &mut f32x4, points: &mut [ContactPointSimd]| {
            change(tangent);
            for point in points {
                change(&mut point.normal_impulse);
                change(&mut point.rest_impulse);
            }
        };
        self.two_points.for_each(|row| change(&mut row.tangent_impulse, &mut row.points));
        self.one_point.for_each(|row| change(&mut row.tangent_impulse, &mut row.points));
        self.two_points_static.for_each(|row| change(&mut row.tangent_impulse, &mut row.points));
        self.one_point_static.for_each(|row| change(&mut row.tangent_impulse, &mut row.points));
    }
}
