//! A small beat-'em-up: walk, jump, punch, lift and throw, over a hole, a belt, a pond and a lift, against thugs who chase.

mod game;
mod paint;
mod script;

pub use game::{Brawler, Keys, RATE};
pub use paint::{Paint, SIZE};
pub use script::script;
