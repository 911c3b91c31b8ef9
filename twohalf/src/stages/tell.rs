//! Telling a game what touches, and what does not any more.

use farseer_core::{GeomId, PhysicsSimulator};

use super::collisions::{collision, is_told};
use super::plane_handler::PlaneHandler;
use crate::depth::{Partner, Touch, TouchList, TouchPoint};
use crate::events::Event;

/// Tells of every contact that this engine has found, and drops those that the handler refuses. Then of those
/// that are gone.
pub(super) fn tell_touches(
    core: &mut PhysicsSimulator,
    game: &mut PlaneHandler<'_, '_>,
    found: &mut TouchList,
) {
    let TouchList { touches, points, .. } = found;
    touches.retain(|touch| is_accepted(core, game, touch, touch.points_in(points)));
    tell_separated(core, game, found);
}

/// Asks both sides, the older geom first.
fn is_accepted(
    core: &mut PhysicsSimulator,
    game: &mut PlaneHandler<'_, '_>,
    touch: &Touch,
    points: &[TouchPoint],
) -> bool {
    for is_partner in [true, false] {
        let Some(mut collision) = collision(touch, points, is_partner) else { continue };
        if is_told(core, collision.this) {
            let answer = game.tell(core, |handler, context| handler.on_collision(context, &collision));
            collision.vetoed = answer == Some(false);
        }
        game.report.collide(collision, touch.key);
        if collision.vetoed {
            return false;
        }
    }
    true
}

/// Contacts of the last update that are gone, unless they ended by something else than parting.
fn tell_separated(core: &mut PhysicsSimulator, game: &mut PlaneHandler<'_, '_>, found: &TouchList) {
    for index in 0..game.world.touches.touches.len() {
        let touch = game.world.touches.touches[index];
        if touch.is_plane()
            || found.find(touch.key).is_some()
            || !game.world.may_touch(core, touch.this, touch.partner)
        {
            continue;
        }
        tell_parted(core, game, touch.this, touch.partner);
    }
}

/// Tells both sides of a contact that it has ended, the older geom first.
pub(super) fn tell_parted(
    core: &mut PhysicsSimulator,
    game: &mut PlaneHandler<'_, '_>,
    this: GeomId,
    partner: Partner,
) {
    let other_side = match partner {
        Partner::Geom(other) => Some((other, Partner::Geom(this))),
        _ => None,
    };
    for (this, partner) in other_side.into_iter().chain([(this, partner)]) {
        game.report.events.push(Event::Separation { this, partner });
        if is_told(core, this) {
            game.tell(core, |handler, context| handler.on_separation(context, this, partner));
        }
    }
}
