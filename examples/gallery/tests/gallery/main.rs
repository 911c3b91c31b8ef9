//! The gallery's scenes and controls, without a window.

mod films;
mod recordings;
mod scenes;
mod viewer;
