//! Asks a game about what touches with the precise set.

use farseer_core::SpaceTouch;
use farseer_core::order::sort_by_number;

use super::collisions::{collisions, is_told};
use super::exchange::tell_depths;
use super::report::Report;
use crate::depth::World;
use crate::events::{Collision, Context, Event, EventHandler};
use crate::views::touch_of;

/// Asks a handler about everything that touches; answers what it refuses.
pub(super) fn ask_about_touches(
    handler: &mut dyn EventHandler,
    context: &mut farseer_core::Context<'_>,
    world: &mut World,
    report: &mut Report,
) -> Vec<usize> {
    let mut found: Vec<(usize, SpaceTouch)> = context.simulator().space_touches_heard().collect();
    sort_by_number(&mut found, |(_, touch)| {
        // None comes first.
        touch_of(context.simulator(), touch).map_or(0, |(touch, _)| touch.key.rank() + 1)
    });
    found.retain(|(_, touch)| !accepts_touch(handler, context, world, report, touch));
    found.into_iter().map(|(pair, _)| pair).collect()
}

fn accepts_touch(
    handler: &mut dyn EventHandler,
    context: &mut farseer_core::Context<'_>,
    world: &mut World,
    report: &mut Report,
    touch: &SpaceTouch,
) -> bool {
    for collision in collisions(context.simulator(), touch).into_iter().flatten() {
        if !is_told(context.simulator(), collision.this) {
            continue;
        }
        let accepts = handler.on_collision(&mut Context::within(context, world), &collision);
        tell_depths(context.simulator_mut(), world, report);
        if !accepts {
            report.events.push(Event::Collision(Collision { vetoed: true, ..collision }));
            return false;
        }
    }
    true
}
