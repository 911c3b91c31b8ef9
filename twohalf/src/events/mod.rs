//! Events and callbacks of an update.

mod collision;
mod context;
mod event;
mod handler;

pub use collision::Collision;
pub use context::Context;
pub use event::Event;
pub use handler::EventHandler;
