//! Stand-ins for the update with the precise set, without the cargo feature `precise`.

use super::PhysicsSimulator;
use super::callbacks::Handler;
use crate::report::Stopwatch;

impl PhysicsSimulator {
    /// Never called: the faithful set is always chosen.
    pub(super) fn step_precise(
        &mut self,
        _: f32,
        _: f32,
        _: &mut Handler<'_>,
        _: &mut Stopwatch<'_>,
    ) -> bool {
        false
    }

    /// There is no precise set to import edits.
    pub(super) fn import_edits(&mut self) {}
}
