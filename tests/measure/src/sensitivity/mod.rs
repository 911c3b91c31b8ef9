//! Sensitivity of the precise method to each of its parameters, by measurements with half and twice the value.
//!
//! - [`parameters`] reads the parameters from the sources of `farseer-core`, and writes another value in place of one.
//! - [`rows`] measures with the engine with which it is compiled.
//! - [`differences`] compares measurements with different parameters.
//! - [`report`] writes the differences for readers.
//!
//! The program `sensitivity` changes a parameter in a copy of the workspace, builds the copy and measures with it. The
//! engine itself has no switch for parameters.

pub mod differences;
pub mod parameters;
pub mod report;
pub mod rows;
