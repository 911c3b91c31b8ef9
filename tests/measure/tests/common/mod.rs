//! Worlds that are as they are told to be, to show measures and judges what they should see.

// Either test program uses a part of it.
#![allow(dead_code)]

pub(crate) mod depth;
pub(crate) mod told;
