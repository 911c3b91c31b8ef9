//! Order of the stages with the precise set: the core solves all three axes; `twohalf` sends depth to the core and reports
//! contacts.

use farseer_core::PhysicsSimulator;
use farseer_core::depth::{DepthAxis, DepthAxisMut, DepthContactEvent};

use super::callbacks::emit_separation;
use super::collisions::collisions;
use super::core_events::CoreEventAdapter;
use super::core_sync::{pull_depth_from_core, pull_sleep_from_core, push_depth_to_core, requeue_forces};
use super::crush::emit_crush_events;
use super::report::{Report, StepCounters};
use super::time_scale::{apply_time_scale, restore_time_scale};
use super::{Parts, Pipeline, fields, supports};
use crate::events::{Event, EventHandler};
use crate::views::partner_of;

pub(super) fn update(parts: Parts<'_>, dt: f32, handler: Option<&mut dyn EventHandler>) {
    let Parts { core, world, pipeline, report } = parts;
    let Pipeline { pair_context, immersion, slowed, .. } = pipeline;
    report.begin();
    apply_time_scale(core, world, slowed);
    requeue_forces(&mut world.depths);
    push_depth_to_core(&mut DepthAxisMut::of(core), world, report);
    let mut game = CoreEventAdapter { world, report, pair_context, handler };
    let has_handler = game.handler.is_some();
    let goes_on = core.process_queues(dt, has_handler.then_some(&mut game as _));
    let mut has_happened = false;
    if !goes_on {
        // Characters that walk while time is stopped queue their supports again.
        game.world.footings.asked.clear();
    } else {
        if !has_handler {
            game.world.footings.skip();
        }
        fields::act(core, game.world, game.report, immersion, dt);
        has_happened = DepthAxisMut::of(core).step(dt, has_handler.then_some(&mut game as _));
    }
    if has_happened {
        if !has_handler {
            pull_depth_from_core(core, game.world);
        }
        pull_sleep_from_core(core, game.world);
    }
    game.report.emit_refusals(game.world);
    game.adopt_core_events(core);
    if !goes_on {
        restore_time_scale(core, game.world, slowed, false);
        supports::remove_stale_contacts(core, game.world);
        return;
    }
    restore_time_scale(core, game.world, slowed, true);
    if has_happened {
        emit_contact_changes(core, &mut game);
    }
    emit_crush_events(core, game.world, game.report);
    count(core, game.report);
    // Loaded contacts end here: the core has all contacts now.
    game.world.touches.clear();
}

/// Reports the contacts that began or ended in this update, as events and to the event handler.
fn emit_contact_changes(core: &mut PhysicsSimulator, game: &mut CoreEventAdapter<'_, '_>) {
    let changes = DepthAxisMut::of(core).drain_contact_events();
    for begun in changes.iter().filter_map(|change| change.contact) {
        let told = collisions(core, &begun).into_iter().flatten();
        game.report.events.extend(told.map(Event::Collision));
    }
    for &DepthContactEvent { this, target: partner, .. } in
        changes.iter().filter(|change| change.contact.is_none())
    {
        let partner = partner_of(partner);
        if game.world.may_touch(core, this, partner) {
            emit_separation(core, game, this, partner);
        }
    }
}

/// Fills the counters of the report for an update of the precise set.
fn count(core: &PhysicsSimulator, report: &mut Report) {
    let counters = core.counters();
    let on_ground = DepthAxis::of(core).ground_contact_count();
    report.counters = StepCounters {
        pairs_tested: counters.pairs_tested,
        pairs_touching: counters.pairs_touching - on_ground,
        ground_contacts: on_ground,
        contacts_solved: counters.contacts_solved,
        rows_solved: 3 * counters.contacts_solved,
        bodies_moved: counters.bodies_moved,
    };
}
