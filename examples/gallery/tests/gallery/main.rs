//! What the gallery shows, and what a person can do with it, without a window.

mod films;
mod scenes;
mod viewer;
