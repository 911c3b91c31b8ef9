//! The 2D Farseer Physics Engine 2.1.3.
pub mod error;
pub mod math;
pub mod shape;

pub use error::{Error, Result};
