//! All features of the engines, in one gallery: in a window, on a page, and as films.
//!
//! - [`scenes`] is the table of scenes. A scene is a [`play::Play`]: it steps, draws itself on a canvas, shows its simulator
//!   and can be copied.
//! - [`show::Show`] puts one or two beside each other and adds a hand that grabs bodies.
//! - [`viewer::Viewer`] is the program that a person uses. It knows neither window nor clock: a frame is a function of an
//!   [`viewer::Input`].
//! - The [`window`] feeds it from a window or a page; [`film`] and [`mod@bench`] do without.

#![deny(unsafe_code)]

pub mod bench;
pub mod film;
mod hand;
pub mod hashes;
pub mod keys;
mod layers;
mod lens;
pub mod play;
pub mod scenes;
mod sheet;
pub mod show;
pub mod state;
pub mod viewer;
pub mod window;

pub use layers::Layers;
pub use lens::Lens;
