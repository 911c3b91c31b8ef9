//! Order of the stages with the faithful set and the thesis' scheme: the stages of the core, with stages of `twohalf` for depth
//! between them.

use farseer_core::PhysicsSimulator;
use farseer_core::depth::DepthAxisMut;

use super::core_events::CoreEventAdapter;
use super::report::Report;
use super::{Parts, Pipeline, callbacks, fields, forces, motion, narrow_phase, supports};
use crate::depth::{Contact, ContactList};
use crate::events::EventHandler;

pub(super) fn update(parts: Parts<'_>, dt: f32, handler: Option<&mut dyn EventHandler>) {
    let Parts { core, world, pipeline, report } = parts;
    let Pipeline { pair_context, found, solver, seams, supports, immersion, .. } = pipeline;
    report.begin();
    let mut game = CoreEventAdapter { world, report, pair_context, handler };
    // 1: add and remove.
    let goes_on = core.process_queues(dt, Some(&mut game));
    game.report.emit_refusals(game.world);
    game.adopt_core_events(core);
    if !goes_on {
        supports::remove_stale_contacts(core, game.world);
        return;
    }
    // 2 and 3: broad phase and narrow phase.
    find_contacts(core, &mut game, found, dt);
    narrow_phase::filter_ghost_contacts(
        found,
        &game.pair_context.intervals,
        core.allowed_penetration(),
        seams,
    );
    game.adopt_core_events(core);
    // 4: integrate velocities.
    fields::act(core, game.world, game.report, immersion, dt);
    forces::apply(core, &mut game.world.depths, dt);
    // 5: solve contacts.
    let inverse_dt = 1.0 / dt;
    narrow_phase::adopt_core_contacts(core, &game.world.depths, found, &game.world.touches);
    solver.prepare(core, &game.world.depths, found, inverse_dt);
    core.solve_with(inverse_dt, solver, None);
    solver.finish(core, &mut game.world.depths, found);
    // 6: integrate positions.
    motion::integrate(core, &mut game, dt);
    // Reports that need the solved impulses.
    game.report.fill_impulses(core, found);
    supports::find(core, game.world, found, supports, dt);
    count(core, game.report, found, solver.row_count());
    std::mem::swap(&mut game.world.touches, found);
}

fn find_contacts(
    core: &mut PhysicsSimulator,
    game: &mut CoreEventAdapter<'_, '_>,
    found: &mut ContactList,
    dt: f32,
) {
    game.pair_context.prepare(core, &game.world.depths, dt);
    core.find_pairs(Some(game));
    DepthAxisMut::of(core).collide_pairs(Some(game));
    game.adopt_core_events(core);
    found.clear();
    narrow_phase::find(core, game.world, game.pair_context, found, &mut game.report.counters);
    callbacks::emit_contact_events(core, game, found);
}

/// Fills the counters of the report for an update of the faithful or thesis scheme.
fn count(core: &PhysicsSimulator, report: &mut Report, found: &ContactList, rows: usize) {
    let plane = core.counters();
    let touching = |touch: &&Contact| !touch.is_plane() && !touch.partner.is_ground();
    let on_ground = |touch: &&Contact| touch.partner.is_ground();
    let solved = found.touches.iter().filter(|touch| touch.responds);
    let points: u32 = solved.map(|touch| touch.point_count).sum();
    let counters = &mut report.counters;
    counters.pairs_tested += plane.pairs_tested;
    counters.pairs_touching = plane.pairs_touching + found.touches.iter().filter(touching).count();
    counters.ground_contacts = found.touches.iter().filter(on_ground).count();
    counters.contacts_solved = plane.contacts_solved + points as usize;
    counters.rows_solved = 2 * plane.contacts_solved + rows;
    counters.bodies_moved += plane.bodies_moved;
}
