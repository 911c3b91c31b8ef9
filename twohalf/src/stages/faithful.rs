//! The order of the stages with the faithful set and the thesis' scheme: those of the 2D engine, and what depth adds between them.

use farseer_core::PhysicsSimulator;

use super::plane_handler::PlaneHandler;
use super::report::Report;
use super::{Parts, Pipeline, fields, forces, motion, supports, tell, touch};
use crate::depth::{Touch, TouchList};
use crate::events::EventHandler;

pub(super) fn update(parts: Parts<'_>, dt: f32, handler: Option<&mut dyn EventHandler>) {
    let Parts { core, world, pipeline, report } = parts;
    let Pipeline { meeting, found, solver, seams, supports, immersion, .. } = pipeline;
    report.begin();
    let mut game = PlaneHandler { world, report, meeting, handler };
    // 1: objects enter and leave.
    let goes_on = core.process_queues(dt, Some(&mut game));
    game.report.tell_refused(game.world);
    game.take_events(core);
    if !goes_on {
        supports::forget_what_left(core, game.world);
        return;
    }
    // 2 and 3: which pairs meet, and where everything touches.
    meet(core, &mut game, found, dt);
    touch::smooth_seams(found, &game.meeting.reaches, core.allowed_penetration(), seams);
    game.take_events(core);
    // 4: impulses, forces and drag become velocity.
    fields::act(core, game.world, game.report, immersion, dt);
    forces::apply(core, &mut game.world.depths, dt);
    // 5: contacts push and rub.
    let inverse_dt = 1.0 / dt;
    touch::take_over_plane_contacts(core, &game.world.depths, found, &game.world.touches);
    solver.prepare(core, &game.world.depths, found, inverse_dt);
    core.solve_with(inverse_dt, solver, None);
    solver.finish(core, &mut game.world.depths, found);
    // 6: velocity becomes position.
    motion::integrate(core, &mut game, dt);
    // What is known only now.
    game.report.fill_impulses(core, found);
    supports::find(core, game.world, found, supports, dt);
    count(core, game.report, found, solver.row_count());
    std::mem::swap(&mut game.world.touches, found);
}

fn meet(core: &mut PhysicsSimulator, game: &mut PlaneHandler<'_, '_>, found: &mut TouchList, dt: f32) {
    game.meeting.prepare(core, &game.world.depths, dt);
    core.find_pairs(Some(game));
    core.collide_pairs(Some(game));
    game.take_events(core);
    found.clear();
    touch::find(core, game.world, game.meeting, found, &mut game.report.counters);
    tell::tell_touches(core, game, found);
}

/// How much work it was.
fn count(core: &PhysicsSimulator, report: &mut Report, found: &TouchList, rows: usize) {
    let plane = core.counters();
    let touching = |touch: &&Touch| !touch.is_plane() && !touch.partner.is_ground();
    let on_ground = |touch: &&Touch| touch.partner.is_ground();
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
