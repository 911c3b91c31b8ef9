//! A small beat-'em-up: thugs who chase, objects to throw at them, and obstacles of a street.

mod game;
mod paint;
mod script;

pub use game::{Brawler, Keys, RATE};
pub use paint::{Paint, SIZE};
pub use script::script;
