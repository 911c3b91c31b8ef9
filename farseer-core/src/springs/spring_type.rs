//! Typed access to a spring of a kind.

use crate::springs::{AngleSpring, FixedAngleSpring, FixedLinearSpring, LinearSpring, Spring, SpringKind};

mod sealed {
    use super::Spring;

    pub trait Sealed {
        /// A spring of the kind without its bodies.
        fn without_bodies() -> Spring;
    }
}

/// A kind of spring, for typed access such as `simulator.spring_as::<LinearSpring>(spring)`. No other types can
/// implement it.
pub trait SpringType: sealed::Sealed + Sized {
    /// The name of the kind.
    const NAME: &'static str;

    /// The spring, if it is of this kind.
    fn of(spring: &Spring) -> Option<&Self>;

    /// The spring for changes, if it is of this kind.
    fn of_mut(spring: &mut Spring) -> Option<&mut Self>;
}

macro_rules! spring_types {
    ($($kind:ident: $spring:ident),*) => {$(
        impl sealed::Sealed for $spring {
            fn without_bodies() -> Spring {
                Spring::without_constants(SpringKind::$kind($spring::without_bodies()))
            }
        }

        impl SpringType for $spring {
            const NAME: &'static str = stringify!($spring);

            fn of(spring: &Spring) -> Option<&Self> {
                if let SpringKind::$kind(spring) = spring.kind() { Some(spring) } else { None }
            }

            fn of_mut(spring: &mut Spring) -> Option<&mut Self> {
                if let SpringKind::$kind(spring) = spring.kind_mut() { Some(spring) } else { None }
            }
        }
    )*};
}

spring_types! {
    Angle: AngleSpring,
    FixedAngle: FixedAngleSpring,
    FixedLinear: FixedLinearSpring,
    Linear: LinearSpring
}
