//! What one simulator may cost.

/// What one simulator may cost: so that no small input, a file least of all, takes minutes or gigabytes.
///
/// They belong to a simulator and not to its saved state: a save cannot raise them. See
/// [`PhysicsSimulator::set_limits`](crate::PhysicsSimulator::set_limits), and [`SavedSimulator`](crate::SavedSimulator)
/// to load with others than the default ones.
///
/// ```
/// use farseer_core::{Limits, PhysicsSimulator};
/// let mut simulator = PhysicsSimulator::default();
/// simulator.set_limits(Limits { iterations: 100, ..Limits::default() });
/// assert_eq!(simulator.limits().iterations, 100);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Work of making one distance grid: its nodes times the vertices of its outline. Default 2^26, which takes less
    /// than a second; the grid of a circle of 64 edges with 100 cells across takes a hundredth of that.
    pub grid_work: u64,
    /// The same, summed over the distance grids of all geoms that live in the simulator. Equal grids are one; grids that
    /// are gone do not count. Default 2^28: at most 2^27 nodes, 512 MB.
    pub total_grid_work: u64,
    /// Passes of the solver per update, whatever
    /// [`set_iterations`](crate::PhysicsSimulator::set_iterations) asks for. Default 2^16.
    pub iterations: u32,
}

impl Default for Limits {
    fn default() -> Self {
        Limits { grid_work: 1 << 26, total_grid_work: 1 << 28, iterations: 1 << 16 }
    }
}
