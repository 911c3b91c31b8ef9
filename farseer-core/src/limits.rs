//! Limits of what one simulator may cost.

/// Limits of what one simulator may cost. They keep a small input, in particular a file, from taking minutes or
/// gigabytes.
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
    /// Maximum work of making one distance grid: the number of its nodes times the number of vertices of its outline.
    /// Default 2^26, which takes less than a second; the grid of a circle of 64 edges with 100 cells across takes a
    /// hundredth of that.
    pub grid_work: u64,
    /// Maximum of the same number, summed over the distance grids of all geoms that live in the simulator. Equal grids
    /// count once; grids that no geom uses do not count. Default 2^28: at most 2^27 nodes, 512 MB.
    pub total_grid_work: u64,
    /// Maximum number of solver iterations per update, whatever
    /// [`set_iterations`](crate::PhysicsSimulator::set_iterations) asks for. Default 2^16.
    pub iterations: u32,
}

impl Default for Limits {
    fn default() -> Self {
        Limits { grid_work: 1 << 26, total_grid_work: 1 << 28, iterations: 1 << 16 }
    }
}
