//! Ready-made bodies and geoms (behaviour chapter 13).
//!
//! Factories check their arguments, pick shapes and formulas and call constructors. The plain methods answer with
//! an object that takes no part yet; those ending in `_in` also add it to the simulator, which is what the
//! original's methods with a leading simulator argument do.

mod body_factory;
mod complex_factory;
mod geom_factory;
mod joint_factory;
mod spring_factory;

pub use body_factory::BodyFactory;
pub use complex_factory::ComplexFactory;
pub use geom_factory::GeomFactory;
pub use joint_factory::JointFactory;
pub use spring_factory::SpringFactory;
