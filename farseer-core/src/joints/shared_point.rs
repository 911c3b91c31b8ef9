//! Point constraint of revolute and weld joints (behaviour chapter 10, section 10).

use serde::{Deserialize, Serialize};

use crate::body::Body;
use crate::error::Result;
use crate::joints::joint_body::{Inverse2, JointBodies, JointPose, JointStep, is_non_zero};
use crate::math::Vector2;
use crate::math::finite::finite_vector;
use crate::math::vector2::{cross, length};

/// A point constraint between two bodies, with its accumulated impulse.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct SharedPoint {
    pub(crate) anchor: Vector2,
    local_anchor1: Vector2,
    local_anchor2: Vector2,
    accumulated: Vector2,
    #[serde(with = "crate::storage::bits")]
    pub(crate) arm1: Vector2,
    #[serde(with = "crate::storage::bits")]
    arm2: Vector2,
    #[serde(with = "crate::storage::bits")]
    velocity_bias: Vector2,
    #[serde(with = "crate::storage::bits")]
    inverse: Inverse2,
}

impl SharedPoint {
    pub(crate) fn new(anchor: Vector2, body1: &Body, body2: &Body) -> Result<Self> {
        let mut point = SharedPoint::default();
        point.set_anchor(anchor, body1, body2)?;
        Ok(point)
    }

    /// Makes a point of the world the shared one, at the bodies' present poses. The impulse stays.
    pub(crate) fn set_anchor(&mut self, anchor: Vector2, body1: &Body, body2: &Body) -> Result<()> {
        finite_vector("anchor", anchor)?;
        let local_anchor1 = finite_vector("anchor", body1.get_local_position(anchor))?;
        let local_anchor2 = finite_vector("anchor", body2.get_local_position(anchor))?;
        self.anchor = anchor;
        (self.local_anchor1, self.local_anchor2) = (local_anchor1, local_anchor2);
        Ok(())
    }

    /// Computes bias and effective mass, applies the warm start and returns the distance of the two points, in length
    /// units.
    pub(crate) fn pre_step(
        &mut self,
        step: JointStep,
        poses: &[JointPose; 2],
        bodies: &mut JointBodies,
    ) -> f32 {
        let (r1, r2) = (poses[0].rotate(self.local_anchor1), poses[1].rotate(self.local_anchor2));
        (self.arm1, self.arm2) = (r1, r2);
        let (b1, b2) = (bodies.first(), bodies.second());
        let m = b1.inverse_mass + b2.inverse_mass;
        let (i1, i2) = (b1.inverse_inertia, b2.inverse_inertia);
        let k11 = m + i1 * r1.y * r1.y + i2 * r2.y * r2.y;
        let k12 = 0.0 + -i1 * r1.x * r1.y + -i2 * r2.x * r2.y;
        let k22 = m + i1 * r1.x * r1.x + i2 * r2.x * r2.x;
        self.inverse = Inverse2::of(k11, k12, k22, step.softness);

        let error = (poses[1].position + r2) - (poses[0].position + r1);
        self.velocity_bias = error * step.correction();

        let impulse = self.accumulated;
        bodies.second_mut().apply_impulse_at(impulse, r2);
        bodies.first_mut().apply_impulse(-impulse);
        bodies.first_mut().apply_angular_impulse(-cross(r1, impulse));
        length(error)
    }

    /// One iteration; returns whether there was an impulse. For the weld joint it does not change the first body's
    /// angular velocity.
    #[inline]
    pub(crate) fn solve(&mut self, softness: f32, turns_first: bool, bodies: &mut JointBodies) -> bool {
        let relative = bodies.second().velocity_at(self.arm2) - bodies.first().velocity_at(self.arm1);
        let impulse = self.inverse.apply(self.velocity_bias - relative - self.accumulated * softness);
        self.accumulated += impulse;
        if !is_non_zero(impulse) {
            return false;
        }
        let second = bodies.second_mut();
        second.add_impulse(impulse);
        second.apply_angular_impulse(cross(self.arm2, impulse));
        let first = bodies.first_mut();
        first.add_impulse(-impulse);
        if turns_first {
            first.apply_angular_impulse(-cross(self.arm1, impulse));
        }
        true
    }

    /// The point in the coordinates of each body.
    pub(super) fn local_anchors(&self) -> [Vector2; 2] {
        [self.local_anchor1, self.local_anchor2]
    }

    #[cfg(feature = "precise")]
    #[inline]
    pub(super) fn set_arm(&mut self, arm: [f32; 2]) {
        // As single numbers, which the compiler keeps in registers.
        [self.arm1.x, self.arm1.y] = arm;
    }

    pub(crate) fn forget_impulse(&mut self) {
        self.accumulated = Vector2::zeros();
    }

    pub(crate) fn impulse_is_finite(&self) -> bool {
        self.accumulated.iter().all(|number| number.is_finite())
    }

    pub(crate) fn is_valid(&self) -> bool {
        let vectors = [self.anchor, self.local_anchor1, self.local_anchor2];
        vectors.iter().all(|v| v.x.is_finite() && v.y.is_finite())
    }
}
