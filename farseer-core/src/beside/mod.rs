//! What stands beside a simulator; not in the original.

mod body_interpolation;
mod fixed_step_clock;
mod mouse_picker;
pub mod snapshot;

pub use body_interpolation::{BodyInterpolation, InterpolatedPose};
pub use fixed_step_clock::FixedStepClock;
pub use mouse_picker::MousePicker;
