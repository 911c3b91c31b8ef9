//! Conformance: scenes, recordings of the original's behaviour in them, and the programs and tests that compare.

pub mod check;
pub mod compare;
pub mod file;
pub mod fixtures;
pub mod golden;
pub mod run;
pub mod samples;
pub mod scene;
pub mod scenes;
pub mod trace;
pub mod units;

#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
