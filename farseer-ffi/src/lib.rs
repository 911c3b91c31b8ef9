//! C ABI of `farseer-core`: the exact port of Farseer Physics 2.1.3 and the precise engine, for C, C# and other languages.
//!
//! The functions are those of `include/farseer.h`; `csharp/Farseer.cs` has the same for C#. This page is for readers of the source; the
//! README has the rules for callers.
//!
//! - Every call runs inside of `guard.rs`, which turns a refusal or a panic into a [`FarseerStatus`].
//! - Pointers to one object are references that may be null (`Option<&T>`), so that null is noticed without `unsafe`.
//! - Results are `MaybeUninit`: the caller's variable need not be initialised.
//! - `arrays.rs` alone reads and writes memory by address and length.
//! - Enums and flags come in as `i32`, since an unknown value of a Rust enum would be undefined behaviour.

mod arguments;
mod arrays;
mod body;
mod body_factory;
mod body_forces;
mod body_options;
mod bulk;
mod events;
mod failure;
mod geom;
mod geom_factory;
mod geom_options;
mod guard;
mod ids;
mod joint;
mod joint_factory;
mod joint_motion;
mod objects;
mod queries;
mod settings;
mod simulator;
mod snapshot;
mod spring;

pub use arguments::*;
pub use body::*;
pub use body_factory::*;
pub use body_forces::*;
pub use body_options::*;
pub use bulk::*;
pub use events::*;
pub use failure::*;
pub use geom::*;
pub use geom_factory::*;
pub use geom_options::*;
pub use guard::*;
pub use ids::*;
pub use joint::*;
pub use joint_factory::*;
pub use joint_motion::*;
pub use objects::*;
pub use queries::*;
pub use settings::*;
pub use simulator::*;
pub use snapshot::*;
pub use spring::*;

#[cfg(test)]
mod tests {
    use std::ffi::CStr;

    use super::*;

    /// A precise simulator with gravity.
    pub(crate) fn simulator() -> Box<FarseerSimulator> {
        let gravity = FarseerVector2 { x: 0.0, y: 100.0 };
        farseer_simulator_create(FarseerMethods::Precise as i32, gravity).unwrap()
    }

    /// The message of the last refused call.
    pub(crate) fn last_error() -> String {
        // SAFETY: the function returns a text that ends with NUL and lives until the next refused call.
        unsafe { CStr::from_ptr(farseer_last_error()) }.to_str().unwrap().to_owned()
    }
}
