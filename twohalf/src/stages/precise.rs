//! The order of the stages with the precise set: the 2D engine below works in three axes, is told what it does not know, and tells
//! what touches.

use farseer_core::{PhysicsSimulator, SpaceChange};

use super::collisions::collisions;
use super::crush::tell_crushed;
use super::exchange::{note_forced, read_depths, rest, tell_depths};
use super::pace::{catch_up, slow_down};
use super::plane_handler::PlaneHandler;
use super::report::{Report, StepCounters};
use super::tell::tell_parted;
use super::{Parts, Pipeline, fields, supports};
use crate::events::{Event, EventHandler};
use crate::views::partner_of;

pub(super) fn update(parts: Parts<'_>, dt: f32, handler: Option<&mut dyn EventHandler>) {
    let Parts { core, world, pipeline, report } = parts;
    let Pipeline { meeting, immersion, slowed, .. } = pipeline;
    report.begin();
    slow_down(core, world, slowed);
    note_forced(&mut world.depths);
    tell_depths(core, world, report);
    let mut game = PlaneHandler { world, report, meeting, handler };
    let is_told = game.handler.is_some();
    let goes_on = core.begin_in_space(dt, is_told.then_some(&mut game as _));
    let mut has_happened = false;
    if !goes_on {
        // Figures that walk while time stands still name their footings again.
        game.world.footings.asked.clear();
    } else {
        if !is_told {
            game.world.footings.pass();
        }
        fields::act(core, game.world, game.report, immersion, dt);
        has_happened = core.go_on_in_space(dt, is_told.then_some(&mut game as _));
    }
    if has_happened {
        if !is_told {
            read_depths(core, game.world);
        }
        rest(core, game.world);
    }
    game.report.tell_refused(game.world);
    game.take_events(core);
    if !goes_on {
        catch_up(core, game.world, slowed, false);
        supports::forget_what_left(core, game.world);
        return;
    }
    catch_up(core, game.world, slowed, true);
    if has_happened {
        tell_changes(core, &mut game);
    }
    tell_crushed(core, game.world, game.report);
    count(core, game.report);
    // What was loaded is over: the engine below knows what touches.
    game.world.touches.clear();
}

/// What begins and ceases to touch.
fn tell_changes(core: &mut PhysicsSimulator, game: &mut PlaneHandler<'_, '_>) {
    let changes = core.take_space_changes();
    for begun in changes.iter().filter_map(|change| change.touch) {
        let told = collisions(core, &begun).into_iter().flatten();
        game.report.events.extend(told.map(Event::Collision));
    }
    for &SpaceChange { this, partner, .. } in changes.iter().filter(|change| change.touch.is_none()) {
        let partner = partner_of(partner);
        if game.world.may_touch(core, this, partner) {
            tell_parted(core, game, this, partner);
        }
    }
}

/// How much work it was.
fn count(core: &PhysicsSimulator, report: &mut Report) {
    let counters = core.counters();
    let on_ground = core.on_ground_count();
    report.counters = StepCounters {
        pairs_tested: counters.pairs_tested,
        pairs_touching: counters.pairs_touching - on_ground,
        ground_contacts: on_ground,
        contacts_solved: counters.contacts_solved,
        rows_solved: 3 * counters.contacts_solved,
        bodies_moved: counters.bodies_moved,
    };
}
