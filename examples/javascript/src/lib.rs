//! The engines for JavaScript: the exports of the WebAssembly module. Without the feature `depth` it has those in 2D alone.
//!
//! Every exported function takes numbers and returns a number; NaN means that the call was refused, and
//! [`boundary::text_pointer`] is the address of the message. No pointer ever comes in: all other data pass through
//! [buffers](boundary) that belong to the module. So no argument from JavaScript can be unsound, and the module needs
//! neither a generator nor a runtime. The classes that people use are in `package/`.

pub mod boundary;
#[cfg(feature = "depth")]
mod depth;
pub mod exports;
mod fields;
mod id_number;
mod touches;
mod world;

#[cfg(feature = "depth")]
pub use depth::WITH_WALKERS;
