//! Islands: sets of dynamic bodies that contacts, joints and springs connect. The modules find them by union-find, put them to
//! sleep, wake them, and report how each was solved.

mod driven;
pub(super) mod falling_asleep;
pub(super) mod report;
pub(super) mod sleep;
pub(super) mod union_find;
pub(super) mod wake;
