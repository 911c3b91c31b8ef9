//! Callbacks and events for the begin and end of contacts.

use farseer_core::{GeomId, PhysicsSimulator};

use super::collisions::{collision, has_callbacks};
use super::core_events::CoreEventAdapter;
use crate::depth::{Contact, ContactList, ContactPoint, ContactTarget};
use crate::events::Event;

/// Calls the event handler for every contact that `twohalf` found and drops the contacts that the handler refuses. Then reports
/// the contacts that have ended.
pub(super) fn emit_contact_events(
    core: &mut PhysicsSimulator,
    game: &mut CoreEventAdapter<'_, '_>,
    found: &mut ContactList,
) {
    let ContactList { touches, points, .. } = found;
    touches.retain(|touch| is_accepted(core, game, touch, touch.points_in(points)));
    emit_separation_events(core, game, found);
}

/// Returns whether the event handler accepts a contact. It is called for both sides, the older geom first.
fn is_accepted(
    core: &mut PhysicsSimulator,
    game: &mut CoreEventAdapter<'_, '_>,
    touch: &Contact,
    points: &[ContactPoint],
) -> bool {
    for is_partner in [true, false] {
        let Some(mut collision) = collision(touch, points, is_partner) else { continue };
        if has_callbacks(core, collision.this) {
            let answer =
                game.call_handler(core, |handler, context| handler.on_collision(context, &collision));
            collision.vetoed = answer == Some(false);
        }
        game.report.collide(collision, touch.key);
        if collision.vetoed {
            return false;
        }
    }
    true
}

/// Reports the contacts of the last update that have ended by separation, as events and to the event handler.
fn emit_separation_events(
    core: &mut PhysicsSimulator,
    game: &mut CoreEventAdapter<'_, '_>,
    found: &ContactList,
) {
    for index in 0..game.world.touches.touches.len() {
        let touch = game.world.touches.touches[index];
        if touch.is_plane()
            || found.find(touch.key).is_some()
            || !game.world.may_touch(core, touch.this, touch.partner)
        {
            continue;
        }
        emit_separation(core, game, touch.this, touch.partner);
    }
}

/// Reports the end of a contact to both sides, the older geom first.
pub(super) fn emit_separation(
    core: &mut PhysicsSimulator,
    game: &mut CoreEventAdapter<'_, '_>,
    this: GeomId,
    partner: ContactTarget,
) {
    let other_side = match partner {
        ContactTarget::Geom(other) => Some((other, ContactTarget::Geom(this))),
        _ => None,
    };
    for (this, partner) in other_side.into_iter().chain([(this, partner)]) {
        game.report.events.push(Event::Separation { this, partner });
        if has_callbacks(core, this) {
            game.call_handler(core, |handler, context| handler.on_separation(context, this, partner));
        }
    }
}
