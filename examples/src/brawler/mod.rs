//! A small beat-'em-up: thugs who chase, what is thrown at them, and what a street has in store.

mod game;
mod paint;
mod script;

pub use game::{Brawler, Keys, RATE};
pub use paint::{Paint, SIZE};
pub use script::script;
