//! Events of bodies that are crushed from this update on.

use farseer_core::PhysicsSimulator;

use super::report::Report;
use crate::depth::{CrushMonitor, World};
use crate::events::Event;
use crate::views::crush_info;

/// Appends an event to the report for each monitored body that is crushed from this update on.
pub(super) fn emit_crush_events(core: &PhysicsSimulator, world: &mut World, report: &mut Report) {
    if world.crush_watches.is_empty() {
        return;
    }
    let mut watches = std::mem::take(&mut world.crush_watches);
    watches.retain(|watch| core.body(watch.body).is_some());
    for CrushMonitor { body, tolerance, is_crushed } in &mut watches {
        let found = crush_info(core, world, *body).filter(|squeeze| squeeze.depth > *tolerance);
        let was_crushed = std::mem::replace(is_crushed, found.is_some());
        if let Some(squeeze) = found.filter(|_| !was_crushed) {
            report.events.push(Event::Crushed { body: *body, squeeze });
        }
    }
    world.crush_watches = watches;
}
