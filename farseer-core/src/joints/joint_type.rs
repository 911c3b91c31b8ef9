//! From a joint to the joint of its kind.

use crate::joints::{
    AngleJoint, AngleLimitJoint, FixedAngleJoint, FixedAngleLimitJoint, FixedRevoluteJoint, Joint, JointKind,
    PinJoint, RevoluteJoint, SliderJoint, WeldJoint,
};

mod sealed {
    use super::Joint;

    pub trait Sealed {
        /// A joint of the kind without its bodies.
        fn without_bodies() -> Joint;
    }
}

/// A kind of joint, for typed access such as `simulator.joint_as::<PinJoint>(joint)`. No other types can be.
pub trait JointType: sealed::Sealed + Sized {
    /// The name of the kind.
    const NAME: &'static str;

    /// The joint, if it is of this kind.
    fn of(joint: &Joint) -> Option<&Self>;

    /// The joint for changes, if it is of this kind.
    fn of_mut(joint: &mut Joint) -> Option<&mut Self>;
}

macro_rules! joint_types {
    ($($kind:ident: $joint:ident),*) => {$(
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
    )*};
}

joint_types! {
    Angle: AngleJoint,
    AngleLimit: AngleLimitJoint,
    FixedAngle: FixedAngleJoint,
    FixedAngleLimit: FixedAngleLimitJoint,
    FixedRevolute: FixedRevoluteJoint,
    Pin: PinJoint,
    Revolute: RevoluteJoint,
    Slider: SliderJoint,
    Weld: WeldJoint
}
