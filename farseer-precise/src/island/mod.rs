//! Islands: sets of dynamic bodies that contacts, joints and springs connect. The modules find them by union-find, put them to
//! sleep, wake them, and report how each was solved.

pub mod driven;
pub mod falling_asleep;
pub mod sleep;
pub mod union_find;
pub mod wake;
