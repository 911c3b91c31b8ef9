//! Two anchors and the constraint along the line between them (behaviour chapter 10, section 12).

use serde::{Deserialize, Serialize};

use crate::body::Body;
use crate::error::Result;
use crate::joints::joint_body::{JointBodies, JointPose, is_non_zero};
use crate::math::Vector2;
use crate::math::finite::finite_vector;
use crate::math::vector2::{cross, dot, length};

/// Two anchors, each in the coordinates of its body, with direction and effective mass along the line between them.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct AnchorDistance {
    pub(crate) anchor1: Vector2,
    pub(crate) anchor2: Vector2,
    #[serde(with = "crate::storage::bits")]
    pub(crate) arm1: Vector2,
    #[serde(with = "crate::storage::bits")]
    arm2: Vector2,
    #[serde(with = "crate::storage::bits")]
    pub(crate) world_anchor1: Vector2,
    #[serde(with = "crate::storage::bits")]
    pub(crate) world_anchor2: Vector2,
    #[serde(with = "crate::storage::bits")]
    direction: Vector2,
    #[serde(with = "crate::storage::bits")]
    pub(crate) effective_mass: f32,
}

/// For the `impl` of a joint with the field `anchors`.
macro_rules! two_anchors {
    () => {
        /// The anchor in the first body's coordinates.
        #[doc(alias = "Anchor1")]
        pub fn anchor1(&self) -> Vector2 {
            self.anchors.anchor1
        }

        /// The anchor in the second body's coordinates.
        #[doc(alias = "Anchor2")]
        pub fn anchor2(&self) -> Vector2 {
            self.anchors.anchor2
        }

        /// World position of the first anchor when it was set or when the joint last prepared a step. Infinite
        /// coordinates are replaced by the nearest finite ones.
        #[doc(alias = "WorldAnchor1")]
        pub fn world_anchor1(&self) -> Vector2 {
            self.anchors.world_anchor1.map($crate::math::scalar::nearest_finite)
        }

        /// World position of the second anchor when it was set or when the joint last prepared a step. Infinite
        /// coordinates are replaced by the nearest finite ones.
        #[doc(alias = "WorldAnchor2")]
        pub fn world_anchor2(&self) -> Vector2 {
            self.anchors.world_anchor2.map($crate::math::scalar::nearest_finite)
        }

        pub(crate) fn set_anchor1(&mut self, anchor: Vector2, body1: &Body) -> Result<()> {
            self.anchors.set_anchor1(anchor, body1)
        }

        pub(crate) fn set_anchor2(&mut self, anchor: Vector2, body2: &Body) -> Result<()> {
            self.anchors.set_anchor2(anchor, body2)
        }
    };
}
pub(super) use two_anchors;

impl AnchorDistance {
    pub(crate) fn new(anchor1: Vector2, body1: &Body, anchor2: Vector2, body2: &Body) -> Result<Self> {
        let mut anchors = AnchorDistance::default();
        anchors.set_anchor1(anchor1, body1)?;
        anchors.set_anchor2(anchor2, body2)?;
        Ok(anchors)
    }

    pub(crate) fn set_anchor1(&mut self, anchor: Vector2, body1: &Body) -> Result<()> {
        let (arm, world) = arm_and_world_anchor("anchor1", anchor, body1)?;
        (self.anchor1, self.arm1, self.world_anchor1) = (anchor, arm, world);
        Ok(())
    }

    pub(crate) fn set_anchor2(&mut self, anchor: Vector2, body2: &Body) -> Result<()> {
        let (arm, world) = arm_and_world_anchor("anchor2", anchor, body2)?;
        (self.anchor2, self.arm2, self.world_anchor2) = (anchor, arm, world);
        Ok(())
    }

    /// Updates the anchors from the poses and returns their distance in length units.
    #[inline]
    pub(crate) fn update_anchors(&mut self, poses: &[JointPose; 2]) -> f32 {
        (self.arm1, self.arm2) = (poses[0].rotate(self.anchor1), poses[1].rotate(self.anchor2));
        self.world_anchor1 = poses[0].position + self.arm1;
        self.world_anchor2 = poses[1].position + self.arm2;
        length(self.world_anchor2 - self.world_anchor1)
    }

    #[cfg(feature = "precise")]
    pub(super) fn set_world_anchors(&mut self, both: [[Vector2; 2]; 2]) {
        [[self.arm1, self.world_anchor1], [self.arm2, self.world_anchor2]] = both;
    }

    /// Computes direction and effective mass, then applies the warm start. Anchors at the same point have the direction
    /// (0, 0).
    #[inline]
    pub(crate) fn prepare(
        &mut self,
        distance: f32,
        softness: f32,
        accumulated: f32,
        bodies: &mut JointBodies,
    ) {
        let reciprocal = 1.0 / if distance == 0.0 { f32::INFINITY } else { distance };
        self.direction = (self.world_anchor2 - self.world_anchor1) * reciprocal;
        let (c1, c2) = (cross(self.arm1, self.direction), cross(self.arm2, self.direction));
        let (b1, b2) = (bodies.first(), bodies.second());
        let k =
            b1.inverse_mass + b2.inverse_mass + b1.inverse_inertia * c1 * c1 + b2.inverse_inertia * c2 * c2;
        self.effective_mass = 1.0 / (k + softness);
        self.apply(self.direction * accumulated, bodies);
    }

    /// Speed at which the anchors separate, in length units/s.
    #[inline]
    pub(crate) fn speed(&self, bodies: &JointBodies) -> f32 {
        let relative = bodies.second().velocity_at(self.arm2) - bodies.first().velocity_at(self.arm1);
        dot(relative, self.direction)
    }

    /// Applies an impulse along the line and returns whether it was not zero.
    #[inline]
    pub(crate) fn apply_along_line(&self, magnitude: f32, bodies: &mut JointBodies) -> bool {
        let impulse = self.direction * magnitude;
        let acts = is_non_zero(impulse);
        if acts {
            self.apply(impulse, bodies);
        }
        acts
    }

    #[inline]
    fn apply(&self, impulse: Vector2, bodies: &mut JointBodies) {
        bodies.second_mut().apply_impulse_at(impulse, self.arm2);
        bodies.first_mut().apply_impulse_at(-impulse, self.arm1);
    }

    pub(crate) fn is_valid(&self) -> bool {
        [self.anchor1, self.anchor2].iter().all(|v| v.x.is_finite() && v.y.is_finite())
    }
}

/// The anchor in world orientation, and its world position.
fn arm_and_world_anchor(argument: &'static str, anchor: Vector2, body: &Body) -> Result<(Vector2, Vector2)> {
    finite_vector(argument, anchor)?;
    let pose = JointPose {
        position: body.position(),
        rotation: body.rotation(),
        total_rotation: body.total_rotation(),
    };
    let arm = finite_vector(argument, pose.rotate(anchor))?;
    let world = finite_vector(argument, pose.position + arm)?;
    Ok((arm, world))
}
