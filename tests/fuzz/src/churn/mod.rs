//! Scenes in which objects are added and removed.

mod depth;
mod plane;

pub use depth::DepthChurn;
pub use plane::PlaneChurn;

use crate::engine::Engine;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Number of updates after which an object is replaced.
const LIFE: usize = 5;
/// Number of replaced objects after which one is joined to an older object.
const LINK_INTERVAL: usize = 3;
/// Length of an update, s.
const DT: f32 = 0.01;

/// A scene in which objects are added and removed, with joints and springs between them.
pub trait Churn {
    /// Type of the simulator.
    type Simulator: Engine;

    /// Disposes the oldest object and creates a new one. If `is_tied`, joins the new object to an older one.
    ///
    /// # Errors
    /// If the simulator refuses a valid call.
    fn replace_one(&mut self, is_tied: bool) -> Result<()>;
    /// Returns the simulator of the scene.
    fn simulator(&self) -> &Self::Simulator;
    /// Returns the simulator of the scene, for updates.
    fn simulator_mut(&mut self) -> &mut Self::Simulator;

    /// Makes the update with index `update`. After some updates it replaces an object.
    ///
    /// # Errors
    /// If the simulator refuses a valid call.
    fn go_on(&mut self, update: usize) -> Result<()> {
        if update.is_multiple_of(LIFE) {
            self.replace_one(update.is_multiple_of(LIFE * LINK_INTERVAL))?;
        }
        self.simulator_mut().update(DT);
        Ok(())
    }
}

/// Returns whether the next update replaces an object. All objects have lived for some updates then.
pub(crate) fn is_before_a_replacement(update: usize) -> bool {
    update % LIFE == LIFE - 1
}
