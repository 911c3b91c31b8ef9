//! Report of an update: events and counters.

use farseer_core::{Event as CoreEvent, GeomId, PhysicsSimulator};

use super::collisions::impulse_of_points;
use super::pairs::{PairCache, impulse_of};
use crate::ContactTarget;
use crate::depth::{ContactKey, ContactList, World};
use crate::events::{Collision, Event};

/// Counters of the work of an update.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StepCounters {
    /// Number of pairs with a narrow-phase test: two geoms, or a geom and a platform. Pairs with the ground
    /// do not count.
    pub pairs_tested: usize,
    /// Number of touching pairs of geoms, or of a geom and a platform.
    pub pairs_touching: usize,
    /// Number of bodies that touch their ground.
    pub ground_contacts: usize,
    /// Number of contact points that the solver handles in every iteration.
    pub contacts_solved: usize,
    /// Number of scalar constraints of all contact points: two for a point in the plane, three for a point in space.
    pub rows_solved: usize,
    /// Number of bodies that changed their position or rotation.
    pub bodies_moved: usize,
}

/// Report of the last update.
#[derive(Debug, Clone, Default)]
pub(crate) struct Report {
    pub(crate) events: Vec<Event>,
    pub(crate) counters: StepCounters,
    /// Duration of the update, s.
    pub(crate) update_time: f32,
    /// Number of events of the core that are in this report already.
    taken: usize,
    /// One entry for each collision that the core reports, in the same order.
    decided: Vec<RecordedCollision>,
    /// Number of entries of `decided` that are events already.
    listed: usize,
    /// Collision events whose impulse is known only after the solver, each with the contact that has the impulse.
    in_plane: Vec<CoreCollision>,
    touches: Vec<(u32, ContactKey)>,
}

/// Collision of two geoms in X and Y as one of them sees it.
#[derive(Debug, Clone, Copy)]
struct RecordedCollision {
    /// Collision as the game sees it; `None` if its numbers are not finite.
    collision: Option<Collision>,
    /// Whether the two geoms exert impulses on each other: the handler refused neither side.
    pushes: bool,
}

/// A collision in X and Y that is an event.
#[derive(Debug, Clone, Copy)]
struct CoreCollision {
    /// Index of the event.
    event: u32,
    this: GeomId,
    other: GeomId,
}

impl CoreCollision {
    fn is_of(&self, a: GeomId, b: GeomId) -> bool {
        (self.this, self.other) == (a, b) || (self.this, self.other) == (b, a)
    }
}

impl Report {
    pub(super) fn begin(&mut self) {
        self.events.clear();
        self.counters = StepCounters::default();
        (self.taken, self.listed) = (0, 0);
        self.decided.clear();
        self.in_plane.clear();
        self.touches.clear();
    }

    /// Clears events and counters.
    pub(crate) fn clear(&mut self) {
        self.events.clear();
        self.counters = StepCounters::default();
    }

    /// Reports refused arguments and broken grips.
    pub(super) fn emit_refusals(&mut self, world: &mut World) {
        let broken = world.broken_grips.drain(..);
        self.events.extend(broken.map(|(holder, load)| Event::GripBroke { holder, load }));
        if std::mem::take(&mut world.has_rejected) {
            for (body, state) in world.depths.bodies.iter_mut() {
                let told = |argument| Event::RejectedInput { object: Some(body.into()), argument };
                self.events.extend(state.rejected.take().map(told));
            }
        }
        let rejected = world.platforms.take_rejected();
        self.events.extend(rejected.map(|argument| Event::RejectedInput { object: None, argument }));
    }

    /// Appends a collision of two geoms in X and Y to `decided`; the older geom's side comes first. A refusal by the younger
    /// side disables the impulses of both entries.
    pub(super) fn record_collision(&mut self, collision: Option<Collision>, is_younger: bool) {
        let is_refused = collision.is_some_and(|collision| collision.vetoed);
        if is_refused
            && is_younger
            && let Some(older) = self.decided.last_mut()
        {
            older.pushes = false;
        }
        self.decided.push(RecordedCollision { collision, pushes: !is_refused });
    }

    /// Appends an event for a collision that `twohalf` found, as one side of the contact sees it.
    pub(super) fn collide(&mut self, collision: Collision, key: ContactKey) {
        if !collision.vetoed {
            self.touches.push((self.events.len() as u32, key));
        }
        self.events.push(Event::Collision(collision));
    }

    /// Appends the events that the core has reported since the last call. Separations are adopted only for pairs that touched
    /// in the core.
    pub(super) fn adopt_core_events(&mut self, core: &PhysicsSimulator, pair_cache: &PairCache) {
        for &event in &core.events()[self.taken..] {
            match event {
                CoreEvent::Collision { .. } => {
                    let decided = self.decided.get(self.listed).copied();
                    self.listed += 1;
                    self.list(decided);
                }
                CoreEvent::Separation { this, other } if pair_cache.touched_in_core(core, this, other) => {
                    self.events.push(Event::Separation { this, partner: ContactTarget::Geom(other) });
                }
                event => self.events.extend(Event::from_core(event)),
            }
        }
        self.taken = core.events().len();
    }

    fn list(&mut self, decided: Option<RecordedCollision>) {
        let Some(RecordedCollision { collision: Some(collision), pushes }) = decided else { return };
        if let (true, ContactTarget::Geom(other)) = (pushes, collision.partner) {
            let (event, this) = (self.events.len() as u32, collision.this);
            self.in_plane.push(CoreCollision { event, this, other });
        }
        self.events.push(Event::Collision(collision));
    }

    /// Fills the solved impulses into the collision events.
    pub(super) fn fill_impulses(&mut self, core: &PhysicsSimulator, found: &ContactList) {
        let Report { events, in_plane, touches, .. } = self;
        let mut give = |event: u32, impulse: f32| {
            if let Event::Collision(collision) = &mut events[event as usize] {
                collision.normal_impulse = impulse;
            }
        };
        // Both lists are in the order of the pair search.
        let mut waiting = in_plane.iter().peekable();
        for arbiter in core.arbiters() {
            let (a, b) = (arbiter.geom_a(), arbiter.geom_b());
            while let Some(source) = waiting.next_if(|source| source.is_of(a, b)) {
                give(source.event, impulse_of(arbiter));
                if source.this == b {
                    // The next one belongs to another arbiter, which may be of the same pair.
                    break;
                }
            }
        }
        for &(event, key) in touches.iter() {
            let points = found.find(key).map_or(&[][..], |touch| found.points_of(touch));
            give(event, impulse_of_points(points));
        }
    }
}
