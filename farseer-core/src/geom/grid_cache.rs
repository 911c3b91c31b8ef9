//! Cache of distance grids: equal grids are made and stored once, within the limits of a simulator.

use std::sync::{Arc, Weak};

use super::distance_grid::{DistanceGrid, GridPlan};
use crate::limits::Limits;
use crate::shape::Vertices;
use crate::{Error, Result};

/// Bit patterns of cell size and outline.
type GridKey = Box<[u32]>;

/// The grids of a simulator by outline and cell size.
#[derive(Debug, Default)]
pub(crate) struct GridCache {
    /// Sorted by key.
    grids: Vec<(GridKey, CachedGrid)>,
    /// Total work of all charged entries, number of nodes times number of vertices: at least that of the grids in use.
    charged_work: u64,
    inserts_until_cleanup: usize,
}

/// `clone_from` makes no new keys if both caches have the same ones, as after going back to an earlier state.
impl Clone for GridCache {
    fn clone(&self) -> Self {
        GridCache { grids: self.grids.clone(), ..*self }
    }

    fn clone_from(&mut self, source: &Self) {
        let grids = std::mem::take(&mut self.grids);
        *self = GridCache { grids, ..*source };
        let has_equal_keys =
            |((one, _), (other, _)): (&(GridKey, CachedGrid), &(GridKey, CachedGrid))| one == other;
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
struct CachedGrid {
    grid: Weak<DistanceGrid>,
    work: u64,
    /// Whether the grid counts against the limit of all grids. A grid that was not in use at the last count does not.
    /// It may still exist because a clone of the simulator uses it, which must not have an effect here.
    is_charged: bool,
}

impl CachedGrid {
    fn charged_work(&self) -> u64 {
        if self.is_charged { self.work } else { 0 }
    }
}

impl GridCache {
    /// The grid of an outline. It is sampled only if there is none yet, and within the limits. `in_use` returns the
    /// grids that the simulator uses now; it is called only if the charged work leaves no room for the new grid.
    pub(crate) fn get<'a>(
        &mut self,
        outline: &Vertices,
        cell_size: f32,
        limits: &Limits,
        in_use: impl FnOnce() -> Vec<&'a DistanceGrid>,
    ) -> Result<Arc<DistanceGrid>> {
        let bits = outline.iter().flat_map(|v| [v.x.to_bits(), v.y.to_bits()]);
        let key: GridKey = std::iter::once(cell_size.to_bits()).chain(bits).collect();
        let place = self.find(&key).ok();
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
        self.remove_unused();
        let entry = CachedGrid { grid: Arc::downgrade(&grid), work: plan.work, is_charged: true };
        match self.find(&key) {
            Ok(place) => {
                let replaced = std::mem::replace(&mut self.grids[place].1, entry);
                self.charged_work -= replaced.charged_work();
            }
            Err(place) => self.grids.insert(place, (key, entry)),
        }
        Ok(grid)
    }

    /// Index of a key's grid, or the index at which to insert it.
    fn find(&self, key: &GridKey) -> std::result::Result<usize, usize> {
        self.grids.binary_search_by(|(other, _)| other.cmp(key))
    }

    /// Charges a new grid, if the limit allows it.
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

    /// Charges the grids in use, and no others.
    fn recount(&mut self, in_use: Vec<&DistanceGrid>) {
        let address = |grid: *const DistanceGrid| grid.addr();
        let mut in_use: Vec<usize> = in_use.into_iter().map(|grid| address(grid)).collect();
        in_use.sort_unstable();
        for (_, entry) in &mut self.grids {
            entry.is_charged = in_use.binary_search(&address(entry.grid.as_ptr())).is_ok();
        }
        self.charged_work = self.grids.iter().map(|(_, entry)| entry.charged_work()).sum();
    }

    /// Removes entries whose grid does not exist any more, once whenever the number of entries doubles.
    fn remove_unused(&mut self) {
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
