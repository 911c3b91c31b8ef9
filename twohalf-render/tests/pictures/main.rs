//! Pictures: what they show, what is written of them, and what is refused.

mod bad_input;
mod files;
mod names;
mod picture_bodies;
mod pixels;
mod scenes;
mod views;
