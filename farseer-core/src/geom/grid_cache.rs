//! Equal distance grids are made and kept once, within the limits of a simulator.

use std::sync::{Arc, Weak};

use super::distance_grid::{DistanceGrid, GridPlan};
use crate::limits::Limits;
use crate::shape::Vertices;
use crate::{Error, Result};

/// Bits of cell size and outline.
type Key = Box<[u32]>;

/// The grids of a simulator by outline and cell size, so that equal ones are built and kept once.
#[derive(Debug, Default)]
pub(crate) struct GridCache {
    /// In the order of their keys.
    grids: Vec<(Key, Entry)>,
    /// Work of all charged entries: no less than that of the grids in use.
    charged_work: u64,
    inserts_until_cleanup: usize,
}

/// Who goes back to an earlier state has the same grids most of the time: then `clone_from` makes no new keys.
impl Clone for GridCache {
    fn clone(&self) -> Self {
        GridCache { grids: self.grids.clone(), ..*self }
    }

    fn clone_from(&mut self, source: &Self) {
        let grids = std::mem::take(&mut self.grids);
        *self = GridCache { grids, ..*source };
        let has_equal_keys = |((one, _), (other, _)): (&(Key, Entry), &(Key, Entry))| one == other;
        let is_as_long = self.grids.len() == source.grids.len();
        if is_as_long && self.grids.iter().zip(&source.grids).all(has_equal_keys) {
            let entries = self.grids.iter_mut().zip(&source.grids);
            entries.for_each(|((_, entry), (_, source))| entry.clone_from(source));
        } else {
            self.grids.clone_from(&source.grids);
        }
    }
}

#[derive(Debug, Clone)]
struct Entry {
    grid: Weak<DistanceGrid>,
    work: u64,
    /// It counts against the limit of all grids. One that was not in use when the work was counted last does not: a
    /// clone of the simulator may keep it alive, which must not be noticed here.
    is_charged: bool,
}

impl Entry {
    fn charged_work(&self) -> u64 {
        if self.is_charged { self.work } else { 0 }
    }
}

impl GridCache {
    /// The grid over an outline; built only if there is none yet, and within the limits. `in_use` answers the grids that
    /// the simulator has now, and is asked only if what has been charged so far would not fit.
    pub(crate) fn get<'a>(
        &mut self,
        outline: &Vertices,
        cell_size: f32,
        limits: &Limits,
        in_use: impl FnOnce() -> Vec<&'a DistanceGrid>,
    ) -> Result<Arc<DistanceGrid>> {
        let bits = outline.iter().flat_map(|v| [v.x.to_bits(), v.y.to_bits()]);
        let key: Key = std::iter::once(cell_size.to_bits()).chain(bits).collect();
        let place = self.place(&key).ok();
        let known = place.and_then(|place| {
            let entry = &self.grids[place].1;
            Some((entry.grid.upgrade()?, entry.is_charged))
        });
        if let Some((grid, true)) = known {
            return Ok(grid);
        }
        let plan = GridPlan::new(outline, cell_size)?;
        plan.check(limits)?;
        self.charge(plan.work, limits, in_use)?;
        let grid = known.map_or_else(|| Arc::new(plan.sample(outline.clone())), |(grid, _)| grid);
        self.forget_unused();
        let entry = Entry { grid: Arc::downgrade(&grid), work: plan.work, is_charged: true };
        match self.place(&key) {
            Ok(place) => {
                let replaced = std::mem::replace(&mut self.grids[place].1, entry);
                self.charged_work -= replaced.charged_work();
            }
            Err(place) => self.grids.insert(place, (key, entry)),
        }
        Ok(grid)
    }

    /// Where the grid of a key is, or would be.
    fn place(&self, key: &Key) -> std::result::Result<usize, usize> {
        self.grids.binary_search_by(|(other, _)| other.cmp(key))
    }

    /// Counts a new grid, if it fits beside the others.
    fn charge<'a>(
        &mut self,
        work: u64,
        limits: &Limits,
        in_use: impl FnOnce() -> Vec<&'a DistanceGrid>,
    ) -> Result<()> {
        if self.charged_work.saturating_add(work) > limits.total_grid_work {
            self.recount(in_use());
        }
        let total = self.charged_work.saturating_add(work);
        Error::check_limit("total_grid_work", total, limits.total_grid_work)?;
        self.charged_work = total;
        Ok(())
    }

    /// Charges the grids in use, and nothing else.
    fn recount(&mut self, in_use: Vec<&DistanceGrid>) {
        let address = |grid: *const DistanceGrid| grid.addr();
        let mut in_use: Vec<usize> = in_use.into_iter().map(|grid| address(grid)).collect();
        in_use.sort_unstable();
        for (_, entry) in &mut self.grids {
            entry.is_charged = in_use.binary_search(&address(entry.grid.as_ptr())).is_ok();
        }
        self.charged_work = self.grids.iter().map(|(_, entry)| entry.charged_work()).sum();
    }

    /// Drops entries whose grid is gone, once for every doubling.
    fn forget_unused(&mut self) {
        if self.inserts_until_cleanup == 0 {
            let charged_work = &mut self.charged_work;
            self.grids.retain(|(_, entry)| {
                let is_alive = entry.grid.strong_count() > 0;
                if !is_alive {
                    *charged_work -= entry.charged_work();
                }
                is_alive
            });
            self.inserts_until_cleanup = self.grids.len().max(64);
        }
        self.inserts_until_cleanup -= 1;
    }
}
