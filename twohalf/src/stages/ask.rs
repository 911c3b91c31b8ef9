//! Asks a game about what touches with the precise set.

use farseer_core::GeomId;
use farseer_core::SpaceTouch;
use farseer_core::order::sort_by_number;

use super::collisions::{collisions, is_told};
use super::exchange::tell_depths;
use super::report::Report;
use crate::Vector3;
use crate::depth::{Axis, Footing, Partner, World};
use crate::events::{Collision, Context, Event, EventHandler};
use crate::views::{partner_of, touch_of};

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
    ask_about_footings(handler, context, world, report, &found);
    found.retain(|(_, touch)| !accepts_touch(handler, context, world, report, touch));
    found.into_iter().map(|(pair, _)| pair).collect()
}

/// Asks about what holds figures that walk and does not touch them.
fn ask_about_footings(
    handler: &mut dyn EventHandler,
    context: &mut farseer_core::Context<'_>,
    world: &mut World,
    report: &mut Report,
    found: &[(usize, SpaceTouch)],
) {
    world.footings.refused.clear();
    let mut asked = std::mem::take(&mut world.footings.asked);
    let touching = if asked.is_empty() { Vec::new() } else { sides_of(found) };
    for footing in asked.drain(..) {
        let touches = touching.binary_search(&(footing.this, footing.partner)).is_ok();
        if touches || !world.may_touch(context.simulator(), footing.this, footing.partner) {
            continue;
        }
        if !accepts(handler, context, world, report, footing.collisions()) {
            world.footings.refused.push((footing.this, footing.partner));
        }
    }
    world.footings.refused.sort_unstable();
    world.footings.asked = asked;
}

/// Touching geoms and their partners, as both sides see them, sorted.
fn sides_of(found: &[(usize, SpaceTouch)]) -> Vec<(GeomId, Partner)> {
    let mut sides = Vec::with_capacity(2 * found.len());
    for (_, touch) in found {
        let partner = partner_of(touch.partner);
        sides.push((touch.this, partner));
        if let Partner::Geom(other) = partner {
            sides.push((other, Partner::Geom(touch.this)));
        }
    }
    sides.sort_unstable();
    sides
}

impl Footing {
    /// As both sides are told of it.
    fn collisions(&self) -> [Option<Collision>; 2] {
        let Footing { this, partner, normal, position } = *self;
        let collision = |this, partner, normal: Vector3| Collision {
            this,
            partner,
            axis: Axis::of(normal.z),
            normal,
            position,
            contacts: 0,
            normal_impulse: 0.0,
            vetoed: false,
        };
        let other = match partner {
            Partner::Geom(other) => Some(collision(other, Partner::Geom(this), -normal)),
            _ => None,
        };
        [Some(collision(this, partner, normal)), other]
    }
}

fn accepts_touch(
    handler: &mut dyn EventHandler,
    context: &mut farseer_core::Context<'_>,
    world: &mut World,
    report: &mut Report,
    touch: &SpaceTouch,
) -> bool {
    let collisions = collisions(context.simulator(), touch);
    accepts(handler, context, world, report, collisions)
}

/// Whether both sides accept what they are told of.
fn accepts(
    handler: &mut dyn EventHandler,
    context: &mut farseer_core::Context<'_>,
    world: &mut World,
    report: &mut Report,
    collisions: [Option<Collision>; 2],
) -> bool {
    for collision in collisions.into_iter().flatten() {
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
