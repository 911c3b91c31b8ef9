//! Ready-made bodies and geoms (behaviour chapter 13).
//!
//! Factories check their arguments, choose shapes and formulas and call constructors. The plain methods return an
//! object that takes no part yet. Methods ending in `_in` also add it to the simulator, as the original's methods with
//! a leading simulator argument do.

/// Methods ending in `_in`: the plain method, and adding the object to the simulator.
macro_rules! added {
    ($($name:ident = $plain:ident($($argument:ident: $type:ty),*) -> $made:ty;)*) => {$(
        #[doc = concat!("[`", stringify!($plain), "`](Self::", stringify!($plain), "), added to the simulator.")]
        ///
        /// # Errors
        /// As the plain method.
        #[allow(clippy::too_many_arguments, reason = "the original's signature")]
        pub fn $name(simulator: &mut Objects, $($argument: $type),*) -> Result<$made> {
            let made = Self::$plain(simulator, $($argument),*)?;
            simulator.add(made).inspect_err(|_| simulator.discard(std::iter::once(made.into())))?;
            Ok(made)
        }
    )*};
}

mod body_factory;
mod geom_factory;
mod joint_factory;
mod spring_factory;

pub use body_factory::BodyFactory;
pub use geom_factory::GeomFactory;
pub(crate) use geom_factory::check_chain;
pub use joint_factory::JointFactory;
pub use spring_factory::SpringFactory;
