//! What stands beside a simulator; not in the original.

mod body_interpolation;
mod checksum;
mod dispatch;
mod event_log;
mod fixed_step_clock;
mod mouse_picker;
mod side_table;
pub mod snapshot;

pub use body_interpolation::{BodyInterpolation, InterpolatedPose};
pub use dispatch::{
    CollisionHandler, ControllerHandler, Dispatch, Dispatched, FluidHandler, ObjectHandler,
    SeparationHandler, Subscription,
};
pub use event_log::EventLog;
pub use fixed_step_clock::FixedStepClock;
pub use mouse_picker::MousePicker;
pub use side_table::{SideTable, TableId};
