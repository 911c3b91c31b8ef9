//! Callbacks: their order, the matching events, vetoes, and the edits that they may make (behaviour chapters 03, 04 and 08).

mod contacts;
mod editing;
mod events;
mod moving;
mod refusing;

use conformance::fixtures::plane::{add_box, add_floor, simulator_with, v};
use farseer_core::{
    BodyId, Contact, Context, Event, EventHandler, GeomId, Methods, ObjectId, PhysicsSimulator,
};

/// Records its calls, as [`Event`]s.
#[derive(Default)]
struct Log {
    events: Vec<Event>,
    refuses_collisions: bool,
    asks_broad_phase: bool,
    refuses_pairs: bool,
}

impl EventHandler for Log {
    fn on_collision(
        &mut self,
        _: &mut Context<'_>,
        this: GeomId,
        other: GeomId,
        contacts: &mut Vec<Contact>,
    ) -> bool {
        let (contacts, vetoed) = (contacts.len() as u32, self.refuses_collisions);
        self.events.push(Event::Collision { this, other, contacts, vetoed });
        !vetoed
    }

    fn on_separation(&mut self, _: &mut Context<'_>, this: GeomId, other: GeomId) {
        self.events.push(Event::Separation { this, other });
    }

    fn handles_broad_phase(&self) -> bool {
        self.asks_broad_phase
    }

    fn on_broad_phase_collision(&mut self, _: &mut Context<'_>, geom1: GeomId, geom2: GeomId) -> bool {
        if self.refuses_pairs {
            self.events.push(Event::BroadPhaseVeto { geom1, geom2 });
        }
        !self.refuses_pairs
    }

    fn on_body_updated(&mut self, _: &mut Context<'_>, body: BodyId) {
        self.events.push(Event::BodyUpdated { body });
    }

    fn on_body_disposed(&mut self, _: &mut Context<'_>, body: BodyId) {
        self.events.push(Event::BodyDisposed { body });
    }

    fn on_added(&mut self, object: ObjectId) {
        self.events.push(Event::Added { object });
    }

    fn on_removed(&mut self, object: ObjectId) {
        self.events.push(Event::Removed { object });
    }
}

/// Calls of a handler in one update.
fn told(simulator: &mut PhysicsSimulator, log: &mut Log) -> Vec<Event> {
    log.events.clear();
    simulator.update_with(0.01, log);
    log.events.clone()
}

fn collision(this: GeomId, other: GeomId, contacts: u32, vetoed: bool) -> Event {
    Event::Collision { this, other, contacts, vetoed }
}

/// Calls a function at the first collision.
struct AtCollision<F>(Option<F>);

impl<F: FnOnce(&mut Context<'_>, GeomId, GeomId, &mut Vec<Contact>) -> bool> EventHandler for AtCollision<F> {
    fn on_collision(
        &mut self,
        context: &mut Context<'_>,
        this: GeomId,
        other: GeomId,
        contacts: &mut Vec<Contact>,
    ) -> bool {
        self.0.take().is_none_or(|action| action(context, this, other, contacts))
    }
}

fn body_of(context: &Context<'_>, geom: GeomId) -> BodyId {
    context.geom(geom).unwrap().body()
}

/// A box on a floor, and one on top of it.
fn stack(methods: Methods) -> PhysicsSimulator {
    let mut simulator = simulator_with(100.0, methods);
    add_floor(&mut simulator, (200.0, 20.0), v(0.0, 100.0));
    add_box(&mut simulator, (20.0, 20.0), v(3.0, 80.5));
    add_box(&mut simulator, (20.0, 20.0), v(1.0, 61.0));
    simulator
}

/// The geom that is in both pairs of a stack.
fn middle_of_stack(context: &Context<'_>, this: GeomId, other: GeomId) -> GeomId {
    let is_middle = |&geom: &GeomId| context.geom(geom).unwrap().id() == 1;
    [this, other].into_iter().find(is_middle).unwrap()
}
