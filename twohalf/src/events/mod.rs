//! What happens during an update, and who is told.

mod collision;
mod context;
mod event;
mod handler;

pub use collision::Collision;
pub use context::Context;
pub use event::Event;
pub use handler::EventHandler;
