//! Adapter: bodies that may not sleep, and bodies that the game puts to sleep.

use super::ids::IdTable;
use crate::body::{Body, BodyId};
use crate::objects::Objects;
use crate::storage::arena::Id as _;
use farseer_precise::Solver;
use farseer_precise::bodies::MotionState;
use farseer_precise::index::BodyIndex;
use farseer_precise::reusing_clone;

/// The bodies for which sleep has other rules.
#[derive(Debug, Default)]
pub(super) struct SleepOptions {
    /// Bodies that may not sleep, or that are to sleep after the next step, sorted by their ranks.
    bodies: Vec<BodyId>,
}

reusing_clone! { SleepOptions { bodies } }

impl SleepOptions {
    /// Returns whether there is no such body.
    pub(super) fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }

    /// Notes a body that may not sleep, or that is to sleep. It is called whenever a body is listed or edited.
    pub(super) fn note(&mut self, id: BodyId, body: &Body) {
        if is_special(body)
            && let Err(place) = self.bodies.binary_search_by_key(&id.rank(), |other| other.rank())
        {
            self.bodies.insert(place, id);
        }
    }

    /// Stops the bodies that are to sleep after this step: they have velocity 0 and no forces in it.
    pub(super) fn stop_requested(&self, solver: &mut Solver, ids: &IdTable, objects: &Objects) {
        for &id in self.bodies.iter().filter(|_| solver.sleep.is_enabled()) {
            let is_requested = objects.bodies.get(id).is_some_and(|entry| entry.body.is_sleep_requested());
            let index = ids.body_index(id).filter(|&index| is_requested && solver.bodies.is_dynamic(index));
            if let Some(index) = index {
                let bodies = &mut solver.bodies;
                bodies.states[index] = MotionState::default();
                bodies.initial_velocity[index] = [0.0; 4];
                bodies.force_delta[index] = [0.0; 4];
                bodies.force_position_delta[index] = [0.0; 4];
            }
        }
    }

    /// Sets the rest times of the bodies that may not sleep to 0, and returns the indices of the awake bodies that are to sleep.
    /// Their requests are cleared.
    pub(super) fn apply(
        &mut self,
        solver: &mut Solver,
        ids: &IdTable,
        objects: &mut Objects,
    ) -> Vec<BodyIndex> {
        let mut requested = Vec::new();
        self.bodies.retain(|&id| {
            let Some(entry) = objects.bodies.get_mut(id) else { return false };
            let index = ids.body_index(id).filter(|&index| solver.bodies.is_dynamic(index));
            if entry.body.is_sleep_requested() {
                entry.body.set_sleep_requested(false);
                let awake = index.filter(|&index| !solver.sleep.is_asleep(index));
                requested.extend(awake.filter(|_| entry.body.is_sleep_allowed()));
            }
            if let Some(rest) = index.and_then(|index| solver.sleep.rest_time.at_mut(index))
                && !entry.body.is_sleep_allowed()
            {
                *rest = rest.min(0.0);
            }
            is_special(&entry.body)
        });
        requested
    }
}

/// Whether a body may not sleep, or is to sleep.
fn is_special(body: &Body) -> bool {
    !body.is_sleep_allowed() || body.is_sleep_requested()
}
