//! What an update has to tell: events, and how much work it was.

use farseer_core::{Event as CoreEvent, GeomId, PhysicsSimulator};

use super::collisions::impulse_of_points;
use super::pairs::{KnownPairs, impulse_of};
use crate::Partner;
use crate::depth::{TouchKey, TouchList, World};
use crate::events::{Collision, Event};

/// What a step did: how much work there was.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StepCounters {
    /// Pairs whose shapes were tested against each other: two geoms, or a geom and a platform. The ground is none.
    pub pairs_tested: usize,
    /// Pairs of geoms, or of a geom and a platform, that touch.
    pub pairs_touching: usize,
    /// Bodies that touch their ground.
    pub ground_contacts: usize,
    /// Contact points the solver worked on in every iteration.
    pub contacts_solved: usize,
    /// Scalar constraints it solved for them in every iteration: two for a point in the plane, three for one in
    /// space.
    pub rows_solved: usize,
    /// Bodies that changed their position or rotation.
    pub bodies_moved: usize,
}

/// What a game can ask about the last update.
#[derive(Debug, Clone, Default)]
pub(crate) struct Report {
    pub(crate) events: Vec<Event>,
    pub(crate) counters: StepCounters,
    /// Seconds.
    pub(crate) update_time: f32,
    /// Events of the 2D engine that were taken over already.
    taken: usize,
    /// One for each collision that the 2D engine reports, in the same order; and how many of them are events already.
    decided: Vec<Decided>,
    listed: usize,
    /// Where the impulses of collisions come from.
    in_plane: Vec<InPlane>,
    touches: Vec<(u32, TouchKey)>,
}

/// What was decided about two geoms that touch in X and Y, as one of them was told.
#[derive(Debug, Clone, Copy)]
struct Decided {
    /// None if nothing can be told of it: its numbers are not finite.
    collision: Option<Collision>,
    /// Whether the two push each other: neither of them was refused.
    pushes: bool,
}

/// A collision in X and Y that is an event.
#[derive(Debug, Clone, Copy)]
struct InPlane {
    event: u32,
    this: GeomId,
    other: GeomId,
}

impl InPlane {
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

    /// All is gone.
    pub(crate) fn clear(&mut self) {
        self.events.clear();
        self.counters = StepCounters::default();
    }

    /// Refusals, and grips that have broken, between updates.
    pub(super) fn tell_refused(&mut self, world: &mut World) {
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

    /// What was decided about two geoms that touch in X and Y, the older one's side first. What the younger one's side refuses
    /// pushes neither, though the older one was told of it.
    pub(super) fn decide(&mut self, collision: Option<Collision>, is_younger: bool) {
        let is_refused = collision.is_some_and(|collision| collision.vetoed);
        if is_refused
            && is_younger
            && let Some(older) = self.decided.last_mut()
        {
            older.pushes = false;
        }
        self.decided.push(Decided { collision, pushes: !is_refused });
    }

    /// A contact of this engine, as one of its sides was told.
    pub(super) fn collide(&mut self, collision: Collision, key: TouchKey) {
        if !collision.vetoed {
            self.touches.push((self.events.len() as u32, key));
        }
        self.events.push(Event::Collision(collision));
    }

    /// Takes over what the 2D engine has reported since the last time. Of separations only those of pairs that have touched in it.
    pub(super) fn take_events(&mut self, core: &PhysicsSimulator, known: &KnownPairs) {
        for &event in &core.events()[self.taken..] {
            match event {
                CoreEvent::Collision { .. } => {
                    let decided = self.decided.get(self.listed).copied();
                    self.listed += 1;
                    self.list(decided);
                }
                CoreEvent::Separation { this, other } if known.have_touched(core, this, other) => {
                    self.events.push(Event::Separation { this, partner: Partner::Geom(other) });
                }
                event => self.events.extend(Event::from_core(event)),
            }
        }
        self.taken = core.events().len();
    }

    fn list(&mut self, decided: Option<Decided>) {
        let Some(Decided { collision: Some(collision), pushes }) = decided else { return };
        if let (true, Partner::Geom(other)) = (pushes, collision.partner) {
            let (event, this) = (self.events.len() as u32, collision.this);
            self.in_plane.push(InPlane { event, this, other });
        }
        self.events.push(Event::Collision(collision));
    }

    /// Gives the collisions among the events the impulses that the solver found.
    pub(super) fn fill_impulses(&mut self, core: &PhysicsSimulator, found: &TouchList) {
        let Report { events, in_plane, touches, .. } = self;
        let mut give = |event: u32, impulse: f32| {
            if let Event::Collision(collision) = &mut events[event as usize] {
                collision.normal_impulse = impulse;
            }
        };
        // Both are in the order in which pairs were looked at.
        let mut waiting = in_plane.iter().peekable();
        for arbiter in core.arbiters() {
            let (a, b) = (arbiter.geom_a(), arbiter.geom_b());
            while let Some(source) = waiting.next_if(|source| source.is_of(a, b)) {
                give(source.event, impulse_of(arbiter));
                if source.this == b {
                    // The next one is of another arbiter, which may be of the same pair.
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
