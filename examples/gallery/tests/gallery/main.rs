//! The gallery's scenes and controls, without a window.

mod films;
mod scenes;
mod viewer;
