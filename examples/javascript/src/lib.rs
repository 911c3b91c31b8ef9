//! The engines for JavaScript: what the WebAssembly module exports. Without the feature `depth` it has that in 2D alone.
//!
//! Every exported function takes numbers and answers a number; NaN says that the call was refused, and
//! [`boundary::text_pointer`] where the message is. No pointer ever comes in: what is more than numbers passes through
//! [buffers](boundary) that belong to the module. So nothing that JavaScript passes can be unsound, and the module needs
//! neither a generator nor a runtime. The classes that people use are in `package/`.

pub mod boundary;
#[cfg(feature = "depth")]
mod depth;
pub mod exports;
mod id_number;
mod touches;
mod world;

#[cfg(feature = "depth")]
pub use depth::WITH_WALKERS;
