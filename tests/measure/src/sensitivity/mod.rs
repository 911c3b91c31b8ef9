//! Changes by half and twice each number of the precise method.
//!
//! [`parameters`] reads the numbers from the sources of `farseer-core` and writes another value in place of one; [`rows`] measures with the
//! engine that it is compiled with; [`differences`] compares two such measurements, [`report`] lists them for readers. The program `sensitivity` changes a copy of the
//! workspace, builds it and measures with it: the product has no switch for that.

pub mod differences;
pub mod parameters;
pub mod report;
pub mod rows;
