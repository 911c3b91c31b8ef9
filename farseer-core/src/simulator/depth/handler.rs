//! Callbacks of an engine with a depth axis.

use crate::contacts::contact::Contact;
use crate::geom::GeomId;
use crate::simulator::{Context, EventHandler, PhysicsSimulator};

/// Callbacks of an engine with a depth axis, beside those of an [`EventHandler`].
pub trait DepthHandler: EventHandler {
    /// All contacts of the step are known, and no impulse has been applied yet. Returns the indices of pairs that exert no
    /// impulse in this update; [`DepthAxis::contacts_with_listener`](super::DepthAxis::contacts_with_listener) lists them.
    fn on_contacts(&mut self, context: &mut Context<'_>) -> Vec<usize>;

    /// Bodies have moved, and no other callback has been called since.
    fn on_moved(&mut self, context: &mut Context<'_>);

    /// With the faithful set: a geom touches another one, and [`on_collision`](EventHandler::on_collision) is not called,
    /// because the [callbacks](crate::Geom::collision_callbacks_enabled) of the geom are switched off. An engine that reports
    /// its own events of collisions knows this one by it. Only [`collide_pairs`](super::DepthAxisMut::collide_pairs) calls it.
    fn on_silent_collision(
        &mut self,
        simulator: &PhysicsSimulator,
        this: GeomId,
        other: GeomId,
        contacts: &[Contact],
    );
}
