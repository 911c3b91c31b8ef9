//! A small beat-'em-up: a street with a hole, a belt, a pond, a lift, a door, a press and a ball on a rope, thugs who chase, crates
//! and balls to throw.

mod game;
mod paint;
mod script;

pub use game::{Brawler, Keys, RATE};
pub use paint::{Paint, SIZE};
pub use script::script;
