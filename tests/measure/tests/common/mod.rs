//! Worlds with prescribed states, for tests that measures and judges report these states.

// Each of the two test programs uses only some of these items.
#![allow(dead_code)]

pub(crate) mod depth;
pub(crate) mod told;
