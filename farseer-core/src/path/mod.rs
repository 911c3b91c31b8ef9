//! Curves through keys, and paths: rows of linked bodies along them (behaviour chapter 14).

mod complex_factory;
mod curve;
mod curve_key;
mod curve_key_collection;
mod link;
#[expect(clippy::module_inception)] // The original's name, beside those of its curves.
mod path;
mod walk;

pub use complex_factory::ComplexFactory;
pub use curve::{Curve, CurveLoopType, CurveTangent};
pub use curve_key::{CurveContinuity, CurveKey};
pub use curve_key_collection::CurveKeyCollection;
pub(crate) use link::LinkSettings;
pub use link::LinkType;
pub use path::Path;
