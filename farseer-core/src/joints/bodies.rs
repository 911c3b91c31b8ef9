//! The bodies of a joint: two, or one and the world.

/// For the `impl` of a joint with the fields `body1` and `body2`.
macro_rules! two_bodies {
    () => {
        /// The first body.
        #[doc(alias = "Body1")]
        pub fn body1(&self) -> BodyId {
            self.body1
        }

        /// The second body.
        #[doc(alias = "Body2")]
        pub fn body2(&self) -> BodyId {
            self.body2
        }

        pub(crate) fn bodies(&self) -> (BodyId, Option<BodyId>) {
            (self.body1, Some(self.body2))
        }

        pub(crate) fn bodies_mut(&mut self) -> (&mut BodyId, Option<&mut BodyId>) {
            (&mut self.body1, Some(&mut self.body2))
        }
    };
}

/// For the `impl` of a joint with the fields `point` and `axis`: the axis is fixed in the first body, and the second one moves along
/// it.
macro_rules! anchor_and_axis {
    () => {
        /// The anchor last set, in world coordinates. It does not follow the bodies.
        pub fn anchor(&self) -> Vector2 {
            self.point.anchor
        }

        /// The axis as a unit vector in the coordinates of the first body.
        pub fn axis(&self) -> Vector2 {
            self.axis
        }

        pub(crate) fn set_anchor(&mut self, anchor: Vector2, body1: &Body, body2: &Body) -> Result<()> {
            self.point.set_anchor(anchor, body1, body2)
        }

        /// Sets the axis to a direction of the world, at the body's present angle.
        pub(crate) fn set_axis(&mut self, axis: Vector2, body1: &Body) -> Result<()> {
            self.axis = local_axis(axis, body1)?;
            Ok(())
        }

        /// The first body's position plus its arm in the last update.
        pub(crate) fn current_anchor(&self, body1: &Body) -> Vector2 {
            body1.position() + self.point.arm1
        }

        /// Distance along the axis by which the second body has left its place, in length units.
        pub(crate) fn travel(&self, body1: &Body, body2: &Body) -> f32 {
            axis_travel(&self.point, self.axis, body1, body2)
        }
    };
}

/// For the `impl` of a joint with the field `body`.
macro_rules! one_body {
    () => {
        /// The body.
        #[doc(alias = "Body")]
        pub fn body(&self) -> BodyId {
            self.body
        }

        pub(crate) fn bodies(&self) -> (BodyId, Option<BodyId>) {
            (self.body, None)
        }

        pub(crate) fn bodies_mut(&mut self) -> (&mut BodyId, Option<&mut BodyId>) {
            (&mut self.body, None)
        }
    };
}

/// For the `impl` of a joint that only the precise set has. The faithful set, which would call these methods, refuses it.
macro_rules! only_precise {
    () => {
        /// Never called.
        pub(crate) fn pre_step(&mut self, _: JointStep, _: &[JointPose; 2], _: &mut JointBodies) -> f32 {
            0.0
        }

        /// Never called.
        pub(crate) fn solve(&mut self, _: f32, _: &mut JointBodies) -> bool {
            false
        }

        /// The joint keeps no impulse of its own.
        pub(crate) fn forget_impulse(&mut self) {}

        pub(crate) fn impulse_is_finite(&self) -> bool {
            true
        }
    };
}

pub(super) use {anchor_and_axis, one_body, only_precise, two_bodies};
