//! Scenes in which things come and go.

mod depth;
mod plane;

pub use depth::DepthChurn;
pub use plane::PlaneChurn;

use crate::engine::Engine;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// A thing is replaced after every so many updates.
const LIFE: usize = 5;
/// Every so many of them are tied to another.
const TIES: usize = 3;
/// Seconds of an update.
const DT: f32 = 0.01;

/// A scene in which things come and go, with joints and springs between them.
pub trait Churn {
    /// What simulates it.
    type Simulator: Engine;

    /// The oldest thing is disposed, another one comes; some are tied to an older one.
    ///
    /// # Errors
    /// If the simulator refuses what it should take.
    fn replace_one(&mut self, is_tied: bool) -> Result<()>;
    /// The simulator.
    fn simulator(&self) -> &Self::Simulator;
    /// The simulator, to let time pass.
    fn simulator_mut(&mut self) -> &mut Self::Simulator;

    /// The update of a number: some replace a thing.
    ///
    /// # Errors
    /// If the simulator refuses what it should take.
    fn go_on(&mut self, update: usize) -> Result<()> {
        if update.is_multiple_of(LIFE) {
            self.replace_one(update.is_multiple_of(LIFE * TIES))?;
        }
        self.simulator_mut().update(DT);
        Ok(())
    }
}

/// Whether the next update replaces a thing, so that all that lives has had some time.
pub(crate) fn is_before_a_replacement(update: usize) -> bool {
    update % LIFE == LIFE - 1
}
