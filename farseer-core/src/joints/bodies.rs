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

pub(super) use {one_body, only_precise, two_bodies};
