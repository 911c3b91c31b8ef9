//! Contact filter of the precise set: asks the event handler about touching pairs.

use farseer_core::GeomId;
use farseer_core::depth::{DepthAxis, DepthAxisMut, DepthContact};
use farseer_precise::storage::order::sort_by_number;

use super::collisions::{collisions, has_callbacks};
use super::core_sync::push_depth_to_core;
use super::report::Report;
use crate::Vector3;
use crate::depth::{Axis, ContactTarget, Footing, World};
use crate::events::{Collision, Context, Event, EventHandler};
use crate::views::{contact_of, partner_of};

/// Asks the event handler about all touching pairs. Returns the indices of the pairs that the handler refuses.
pub(super) fn filter_contacts(
    handler: &mut dyn EventHandler,
    context: &mut farseer_core::Context<'_>,
    world: &mut World,
    report: &mut Report,
) -> Vec<usize> {
    let mut found: Vec<(usize, DepthContact)> =
        DepthAxis::of(context.simulator()).contacts_with_listener().collect();
    sort_by_number(&mut found, |(_, touch)| {
        // `None` comes first.
        contact_of(context.simulator(), touch).map_or(0, |(touch, _)| touch.key.rank() + 1)
    });
    filter_footings(handler, context, world, report, &found);
    found.retain(|(_, touch)| !accepts_touch(handler, context, world, report, touch));
    found.into_iter().map(|(pair, _)| pair).collect()
}

/// Asks the event handler about supports and walls that act on characters without a contact.
fn filter_footings(
    handler: &mut dyn EventHandler,
    context: &mut farseer_core::Context<'_>,
    world: &mut World,
    report: &mut Report,
    found: &[(usize, DepthContact)],
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

/// Returns the geoms of touching pairs with their contact targets, one entry per side, sorted.
fn sides_of(found: &[(usize, DepthContact)]) -> Vec<(GeomId, ContactTarget)> {
    let mut sides = Vec::with_capacity(2 * found.len());
    for (_, touch) in found {
        let partner = partner_of(touch.target);
        sides.push((touch.this, partner));
        if let ContactTarget::Geom(other) = partner {
            sides.push((other, ContactTarget::Geom(touch.this)));
        }
    }
    sides.sort_unstable();
    sides
}

impl Footing {
    /// Returns the collision as each of both sides sees it; `None` for the second side if the target is no geom.
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
            ContactTarget::Geom(other) => Some(collision(other, ContactTarget::Geom(this), -normal)),
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
    touch: &DepthContact,
) -> bool {
    let collisions = collisions(context.simulator(), touch);
    accepts(handler, context, world, report, collisions)
}

/// Returns whether the event handler accepts a collision for both sides.
fn accepts(
    handler: &mut dyn EventHandler,
    context: &mut farseer_core::Context<'_>,
    world: &mut World,
    report: &mut Report,
    collisions: [Option<Collision>; 2],
) -> bool {
    for collision in collisions.into_iter().flatten() {
        if !has_callbacks(context.simulator(), collision.this) {
            continue;
        }
        let accepts = handler.on_collision(&mut Context::within(context, world), &collision);
        push_depth_to_core(&mut DepthAxisMut::within(context), world, report);
        if !accepts {
            report.events.push(Event::Collision(Collision { vetoed: true, ..collision }));
            return false;
        }
    }
    true
}
