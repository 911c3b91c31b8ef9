//! The kinds of joints, and typed access to a joint of a kind.

use serde::{Deserialize, Serialize};

use crate::joints::{
    AngleJoint, AngleLimitJoint, AngleSpringJoint, FixedAngleJoint, FixedAngleLimitJoint, FixedRevoluteJoint,
    GearJoint, Joint, MotorJoint, PinJoint, PrismaticJoint, PulleyJoint, RevoluteJoint, SliderJoint,
    WeldJoint, WheelJoint,
};

mod sealed {
    use super::Joint;

    pub trait Sealed {
        /// A joint of the kind without its bodies.
        fn without_bodies() -> Joint;
    }
}

/// A kind of joint, for typed access such as `simulator.joint_as::<PinJoint>(joint)`. No other types can implement it.
pub trait JointType: sealed::Sealed + Sized {
    /// The name of the kind.
    const NAME: &'static str;

    /// The joint, if it is of this kind.
    fn of(joint: &Joint) -> Option<&Self>;

    /// The joint for changes, if it is of this kind.
    fn of_mut(joint: &mut Joint) -> Option<&mut Self>;
}

/// Defines all items that list the kinds: a new kind is added to this one list.
macro_rules! joint_kinds {
    (($d:tt) $($(#[$doc:meta])* $kind:ident: $joint:ident,)*) => {
        /// The kinds of joints.
        #[derive(Debug, Clone, Serialize, Deserialize)]
        #[non_exhaustive]
        pub enum JointKind {$(
            $(#[$doc])*
            $kind($joint),
        )*}

        /// Evaluates an expression with the joint of whatever kind.
        macro_rules! each_kind {
            ($d kind:expr, $d joint:ident => $d do:expr) => {
                match $d kind {
                    $(JointKind::$kind($d joint) => $d do,)*
                }
            };
        }
        pub(super) use each_kind;

        $(
            impl sealed::Sealed for $joint {
                fn without_bodies() -> Joint {
                    Joint::of(JointKind::$kind($joint::without_bodies()))
                }
            }

            impl JointType for $joint {
                const NAME: &'static str = stringify!($joint);

                fn of(joint: &Joint) -> Option<&Self> {
                    if let JointKind::$kind(joint) = joint.kind() { Some(joint) } else { None }
                }

                fn of_mut(joint: &mut Joint) -> Option<&mut Self> {
                    if let JointKind::$kind(joint) = joint.kind_mut() { Some(joint) } else { None }
                }
            }
        )*
    };
}

joint_kinds! {
    ($)
    /// Two bodies at a fixed angle to each other.
    Angle: AngleJoint,
    /// Two bodies whose angle to each other stays in a range.
    AngleLimit: AngleLimitJoint,
    /// A body at a fixed angle.
    FixedAngle: FixedAngleJoint,
    /// A body whose angle stays in a range.
    FixedAngleLimit: FixedAngleLimitJoint,
    /// A body that turns about a point of the world.
    FixedRevolute: FixedRevoluteJoint,
    /// Two anchors at a fixed distance.
    Pin: PinJoint,
    /// Two bodies that slide along an axis.
    Prismatic: PrismaticJoint,
    /// Two bodies that turn about a common point.
    Revolute: RevoluteJoint,
    /// Two anchors whose distance stays in a range.
    Slider: SliderJoint,
    /// Two bodies that share a point and an angle.
    Weld: WeldJoint,
    /// Two bodies with a damped spring between their angles.
    AngleSpring: AngleSpringJoint,
    /// A body that a bounded force moves to a pose relative to another.
    Motor: MotorJoint,
    /// A wheel on a sprung axle.
    Wheel: WheelJoint,
    /// A body whose angle follows that of another.
    Gear: GearJoint,
    /// Two bodies on a rope over two pulleys.
    Pulley: PulleyJoint,
}
