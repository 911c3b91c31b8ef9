//! State of the bodies of a joint in the joint solver.

use crate::math::vector2::cross;
use crate::math::{Vector2, scalar};
use crate::storage::bits::Floats;

/// Pose of a body, for the pre-step of joints.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JointPose {
    pub(crate) position: Vector2,
    pub(crate) rotation: f32,
    pub(crate) total_rotation: f32,
}

impl JointPose {
    /// Rotates a vector of the body's coordinates into world orientation, through the body matrix.
    #[inline]
    pub(crate) fn rotate(&self, local: Vector2) -> Vector2 {
        let (s, c) = scalar::sin_cos(self.rotation);
        // The matrix product of the original adds zeros, which turn -0 into +0.
        let (m12, m21) = (s + 0.0, -s + 0.0);
        Vector2::new(local.x * c + local.y * m21, local.x * m12 + local.y * c)
    }
}

/// Velocity and inverse mass of a body in the joint solver.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JointBody {
    pub(crate) velocity: Vector2,
    pub(crate) angular_velocity: f32,
    pub(crate) inverse_mass: f32,
    pub(crate) inverse_inertia: f32,
    pub(crate) is_static: bool,
}

impl JointBody {
    /// Changes the velocity at once, unless the body is static. An impulse of 0 is added, too: it turns -0 into +0.
    #[inline]
    pub(crate) fn apply_impulse(&mut self, impulse: Vector2) {
        if !self.is_static {
            self.add_impulse(impulse);
        }
    }

    /// [`apply_impulse`](Self::apply_impulse) without the test whether the body is static.
    #[inline]
    pub(crate) fn add_impulse(&mut self, impulse: Vector2) {
        self.velocity += impulse * self.inverse_mass;
    }

    /// Changes the angular velocity at once.
    #[inline]
    pub(crate) fn apply_angular_impulse(&mut self, impulse: f32) {
        self.angular_velocity += impulse * self.inverse_inertia;
    }

    /// Applies an impulse at an offset from the body's origin: it changes both velocities.
    #[inline]
    pub(crate) fn apply_impulse_at(&mut self, impulse: Vector2, arm: Vector2) {
        self.apply_impulse(impulse);
        self.apply_angular_impulse(cross(arm, impulse));
    }

    /// Velocity at an offset from the body's origin.
    #[inline]
    pub(crate) fn velocity_at(&self, arm: Vector2) -> Vector2 {
        let w = self.angular_velocity;
        self.velocity + Vector2::new(-w * arm.y, w * arm.x)
    }

    fn is_finite(&self) -> bool {
        self.velocity.x.is_finite() && self.velocity.y.is_finite() && self.angular_velocity.is_finite()
    }
}

/// The two bodies of a joint; both may be the same body. Joints on one body use the first.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JointBodies {
    bodies: [JointBody; 2],
    /// Index of the second body: 1, or 0 if both are the same body.
    second: usize,
    /// Whether the joint's own impulse is not finite.
    has_non_finite_impulse: bool,
}

impl JointBodies {
    /// Two different bodies.
    #[inline]
    pub(crate) fn two(first: JointBody, second: JointBody) -> Self {
        JointBodies { bodies: [first, second], second: 1, has_non_finite_impulse: false }
    }

    /// The same body twice.
    #[inline]
    pub(crate) fn one(body: JointBody) -> Self {
        JointBodies { bodies: [body, body], second: 0, has_non_finite_impulse: false }
    }

    #[inline]
    pub(crate) fn first(&self) -> &JointBody {
        &self.bodies[0]
    }

    #[inline]
    pub(crate) fn first_mut(&mut self) -> &mut JointBody {
        &mut self.bodies[0]
    }

    #[inline]
    pub(crate) fn second(&self) -> &JointBody {
        &self.bodies[self.second]
    }

    #[inline]
    pub(crate) fn second_mut(&mut self) -> &mut JointBody {
        &mut self.bodies[self.second]
    }

    /// Whether velocities and the impulse of the joint are finite.
    #[inline]
    pub(crate) fn is_finite(&self) -> bool {
        !self.has_non_finite_impulse && self.first().is_finite() && self.second().is_finite()
    }

    #[inline]
    pub(crate) fn mark_non_finite(&mut self) {
        self.has_non_finite_impulse = true;
    }
}

/// Settings of a joint for the pre-step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JointStep {
    pub(crate) inverse_dt: f32,
    pub(crate) bias_factor: f32,
    pub(crate) softness: f32,
}

impl JointStep {
    /// Factor from a position error to the bias velocity that corrects it, in 1/s.
    #[inline]
    pub(crate) fn correction(&self) -> f32 {
        -self.bias_factor * self.inverse_dt
    }
}

/// Inverse of a 2x2 matrix that multiplies row vectors.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Inverse2 {
    i11: f32,
    i12: f32,
    i21: f32,
    i22: f32,
}

impl Inverse2 {
    /// Inverse of the symmetric matrix `k11 k12 / k12 k22`, softened. As in the original the softness is added to the
    /// first row, not to the diagonal. The inverse of a singular matrix is not finite.
    #[inline]
    pub(crate) fn of(k11: f32, k12: f32, k22: f32, softness: f32) -> Self {
        let k21 = k12;
        let (k11, k12) = (k11 + softness, k12 + softness);
        let reciprocal = 1.0 / (k11 * k22 - k12 * k21);
        Inverse2 {
            i11: reciprocal * k22,
            i12: -reciprocal * k12,
            i21: -reciprocal * k21,
            i22: reciprocal * k11,
        }
    }

    /// Row vector times the matrix. The 0 is the translation of the original's 4x4 matrix; it turns -0 into +0.
    #[inline]
    pub(crate) fn apply(&self, v: Vector2) -> Vector2 {
        Vector2::new(v.x * self.i11 + v.y * self.i21 + 0.0, v.x * self.i12 + v.y * self.i22 + 0.0)
    }
}

impl Floats for Inverse2 {
    fn to_floats(&self) -> Vec<f32> {
        vec![self.i11, self.i12, self.i21, self.i22]
    }
    fn from_floats(floats: &[f32]) -> Option<Self> {
        let [i11, i12, i21, i22] = <[f32; 4]>::try_from(floats).ok()?;
        Some(Inverse2 { i11, i12, i21, i22 })
    }
}

/// Whether a component is not 0; NaN is not 0.
#[inline]
pub(crate) fn is_non_zero(v: Vector2) -> bool {
    v.x != 0.0 || v.y != 0.0
}
