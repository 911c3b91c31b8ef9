//! Tools around a simulator, for the game loop, callbacks and saving. Not in the original, except the mouse picker's
//! method.

mod body_interpolation;
mod checksum;
mod dispatch;
mod event_log;
mod fixed_step_clock;
mod fixed_step_runner;
mod mouse_picker;
mod packed;
mod recording;
mod secondary_map;
pub mod snapshot;
mod state_hash;

pub use body_interpolation::{BodyInterpolation, InterpolatedPose};
pub use dispatch::{
    CollisionHandler, ControllerHandler, Dispatch, Dispatched, FluidHandler, ObjectHandler,
    SeparationHandler, Subscription,
};
pub use event_log::EventLog;
pub use fixed_step_clock::FixedStepClock;
pub use fixed_step_runner::FixedStepRunner;
pub use mouse_picker::MousePicker;
pub use recording::Recording;
pub use secondary_map::{MapId, SecondaryMap};
