//! Islands: sets of dynamic bodies that contacts, joints and springs connect. The modules find them by union-find, put them to
//! sleep, wake them, and report how each was solved.

pub(crate) mod all_asleep;
pub(super) mod driven;
pub(crate) mod report;
pub(crate) mod sleep;
pub(super) mod union_find;
pub(super) mod wake;
