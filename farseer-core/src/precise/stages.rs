//! Adapter: the first and the third stage of a step, in which all bodies may wake. The other stages of the solver are in
//! [`step`](farseer_precise::step).

use super::Precise;
use crate::FrictionType;
use crate::math::Vector2;
use farseer_precise::scaled_parameters::StepContext;

impl Precise {
    /// Begins a step: stores its length `dt` (seconds, > 0), `gravity` (length units/s^2) and whether bodies `may_sleep`.
    /// Returns the parameters of the step for the solvers.
    pub(crate) fn begin_step(
        &mut self,
        dt: f32,
        substeps: u32,
        gravity: Vector2,
        may_sleep: bool,
    ) -> StepContext {
        self.set_sleep(may_sleep, gravity);
        self.solver.begin_step(dt, substeps, [gravity.x, gravity.y])
    }

    /// Third stage of a step, the narrow phase: updates manifolds and contact constraints of the pairs that have moved beyond
    /// their tolerance. `max_contacts`: most contact points per pair, 0..=2. Returns the number of updated pairs.
    pub(crate) fn find_contacts(&mut self, friction: FrictionType, max_contacts: u32) -> usize {
        if self.solver.begin_contacts(friction, max_contacts) {
            self.wake_all();
            self.solver.pairs.indices().for_each(|pair| self.solver.pairs.invalidate(pair));
        }
        self.solver.find_contacts()
    }
}
