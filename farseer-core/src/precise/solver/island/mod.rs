//! Islands: sets of dynamic bodies that contacts, joints and springs connect. The modules find them by union-find, put them to
//! sleep, wake them, and report how each was solved.

mod driven;
pub(in crate::precise) mod falling_asleep;
pub(in crate::precise) mod report;
pub(in crate::precise) mod sleep;
pub(in crate::precise) mod union_find;
pub(in crate::precise) mod wake;
