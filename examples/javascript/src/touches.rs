//! Begin and end of touches, each reported once with all methods, although the engines report them in several ways.

use std::collections::VecDeque;

use farseer_core::{
    BodyId, GeomId, Hit, JointId, Methods, ObjectId, PhysicsSimulator, SpringId, WantedEvents,
};
use farseer_precise::storage::order::{packed_key, sort_by_number};
#[cfg(feature = "depth")]
use twohalf::{PlatformId, TwoHalfPhysicsSimulator};

use crate::world::Engine;

/// Number of events that are kept; the oldest are dropped if a game never drains them.
const MOST_HAPPENINGS: usize = 65_536;

/// The other side of a touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Partner {
    Geom(GeomId),
    #[cfg(feature = "depth")]
    Platform(PlatformId),
    #[cfg(feature = "depth")]
    Ground,
}

#[cfg(feature = "depth")]
impl From<twohalf::ContactTarget> for Partner {
    fn from(partner: twohalf::ContactTarget) -> Self {
        match partner {
            twohalf::ContactTarget::Geom(geom) => Partner::Geom(geom),
            twohalf::ContactTarget::Platform(platform) => Partner::Platform(platform),
            twohalf::ContactTarget::Ground => Partner::Ground,
        }
    }
}

/// A touch of a geom with a partner: of two geoms that with the smaller id is first.
type Touch = (GeomId, Partner);

/// An event for the game.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Happening {
    TouchBegin(GeomId, Partner),
    TouchEnd(GeomId, Partner),
    /// Sensor and visitor.
    SensorBegin(GeomId, GeomId),
    SensorEnd(GeomId, GeomId),
    Hit(Hit),
    BodySlept(BodyId),
    BodyWoke(BodyId),
    JointBroke(JointId),
    SpringBroke(SpringId),
    /// The body left the numbers that there are, and was put back and, if it can move, disabled.
    NotFinite(BodyId),
}

/// Present touches, and the events since the last call.
#[derive(Debug, Default)]
pub(crate) struct Log {
    /// In order, each once.
    touching: Vec<Touch>,
    happenings: VecDeque<Happening>,
    /// Whether an edit has ended touches without a report of the engines.
    is_in_doubt: bool,
}

fn ordered(this: GeomId, partner: impl Into<Partner>) -> Touch {
    match partner.into() {
        Partner::Geom(other) if other < this => (other, Partner::Geom(this)),
        partner => (this, partner),
    }
}

impl Log {
    /// Call this after a disposal, or when an object was enabled or disabled.
    pub(crate) fn doubt(&mut self) {
        self.is_in_doubt = true;
    }

    /// Events since the last call.
    pub(crate) fn drain(&mut self) -> impl Iterator<Item = Happening> + '_ {
        self.happenings.drain(..)
    }

    /// Call this after the engine was restored: present touches are no events.
    pub(crate) fn begin_anew(&mut self, engine: &Engine) {
        *self = Log { touching: touching_now(engine), ..Log::default() };
    }

    /// Takes over the reports of the last update.
    pub(crate) fn follow(&mut self, engine: &Engine) {
        match engine {
            Engine::Plane(simulator) => self.follow_plane(simulator),
            #[cfg(feature = "depth")]
            Engine::Depth(depth) => self.follow_depth(&depth.simulator),
        }
        if std::mem::take(&mut self.is_in_doubt) {
            let now = touching_now(engine);
            let mut ended = self.touching.clone();
            ended.retain(|touch| now.binary_search(touch).is_err());
            ended.into_iter().for_each(|touch| self.end(touch));
        }
    }

    fn tell(&mut self, happening: Happening) {
        if self.happenings.len() == MOST_HAPPENINGS {
            self.happenings.pop_front();
        }
        self.happenings.push_back(happening);
    }

    fn begin(&mut self, touch: Touch) {
        if let Err(place) = self.touching.binary_search(&touch) {
            self.touching.insert(place, touch);
            self.tell(Happening::TouchBegin(touch.0, touch.1));
        }
    }

    fn end(&mut self, touch: Touch) {
        if let Ok(place) = self.touching.binary_search(&touch) {
            self.touching.remove(place);
            self.tell(Happening::TouchEnd(touch.0, touch.1));
        }
    }

    fn tell_not_finite(&mut self, body: BodyId) {
        self.doubt();
        self.tell(Happening::NotFinite(body));
    }

    fn follow_plane(&mut self, simulator: &PhysicsSimulator) {
        use farseer_core::Event;
        for &event in simulator.events() {
            match event {
                Event::Collision { this, other, .. } if !are_typed(simulator, this, other) => {
                    self.begin(ordered(this, Partner::Geom(other)));
                }
                Event::Separation { this, other } => self.end(ordered(this, Partner::Geom(other))),
                Event::TouchBegin { geom1, geom2 } => {
                    self.tell(Happening::TouchBegin(geom1, Partner::Geom(geom2)));
                }
                Event::TouchEnd { geom1, geom2 } => {
                    self.tell(Happening::TouchEnd(geom1, Partner::Geom(geom2)))
                }
                Event::SensorBegin { sensor, visitor } => self.tell(Happening::SensorBegin(sensor, visitor)),
                Event::SensorEnd { sensor, visitor } => self.tell(Happening::SensorEnd(sensor, visitor)),
                Event::BodySlept { body } => self.tell(Happening::BodySlept(body)),
                Event::BodyWoke { body } => self.tell(Happening::BodyWoke(body)),
                Event::JointBroke { joint } => self.tell(Happening::JointBroke(joint)),
                Event::SpringBroke { spring } => self.tell(Happening::SpringBroke(spring)),
                Event::NotFinite { body, .. } => self.tell_not_finite(body),
                Event::Removed { object: ObjectId::Body(_) | ObjectId::Geom(_) } => self.doubt(),
                _ => {}
            }
        }
        simulator.hits().iter().for_each(|&hit| self.tell(Happening::Hit(hit)));
    }

    /// The events of the 2.5D engine have in them those of the 2D engine below that mean the same to a game.
    #[cfg(feature = "depth")]
    fn follow_depth(&mut self, simulator: &TwoHalfPhysicsSimulator) {
        use twohalf::Event;
        for &event in simulator.events() {
            match event {
                Event::Collision(collision) => self.begin(ordered(collision.this, collision.partner)),
                Event::Separation { this, partner } => self.end(ordered(this, partner)),
                Event::JointBroke { joint } => self.tell(Happening::JointBroke(joint)),
                Event::SpringBroke { spring } => self.tell(Happening::SpringBroke(spring)),
                Event::NotFinite { body, .. } => self.tell_not_finite(body),
                Event::Removed { object: ObjectId::Body(_) | ObjectId::Geom(_) } => self.doubt(),
                _ => {}
            }
        }
    }
}

/// Whether the engine has typed events for the touches of two geoms: geoms that options describe want them.
fn are_typed(simulator: &PhysicsSimulator, one: GeomId, other: GeomId) -> bool {
    let wanted = WantedEvents::TOUCH | WantedEvents::SENSOR;
    matches!(simulator.methods(), Methods::Precise { .. })
        && [one, other].into_iter().any(|geom| {
            simulator.geom(geom).is_some_and(|geom| geom.wanted_events() & wanted != WantedEvents::NONE)
        })
}

fn touching_now(engine: &Engine) -> Vec<Touch> {
    let mut now = Vec::new();
    let mut note = |touch| now.push(touch);
    match engine {
        Engine::Plane(simulator) => {
            let touching = simulator.arbiters().filter(|arbiter| arbiter.contacts().len() > 0);
            for arbiter in touching {
                let (one, other) = (arbiter.geom_a(), arbiter.geom_b());
                if !are_typed(simulator, one, other) {
                    note(ordered(one, Partner::Geom(other)));
                }
            }
        }
        #[cfg(feature = "depth")]
        Engine::Depth(depth) => {
            depth.simulator.contacts().for_each(|contact| note(ordered(contact.this, contact.partner)));
        }
    }
    // Touching geoms exist: no two share a slot.
    sort_by_number(&mut now, |&(this, partner)| {
        let (kind, number) = match partner {
            Partner::Geom(geom) => (0, geom.slot() as u32),
            #[cfg(feature = "depth")]
            Partner::Platform(platform) => (1, platform.to_bits()),
            #[cfg(feature = "depth")]
            Partner::Ground => (2, 0),
        };
        packed_key([this.slot() as u32, kind, number])
    });
    now.dedup();
    now
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oldest_events_are_dropped_beyond_the_capacity() {
        let mut simulator = PhysicsSimulator::default();
        let bodies = [0; 2].map(|_| simulator.create_body(farseer_core::Body::new()));
        let mut log = Log::default();
        log.tell(Happening::NotFinite(bodies[0]));
        (0..MOST_HAPPENINGS).for_each(|_| log.tell(Happening::NotFinite(bodies[1])));
        let told: Vec<Happening> = log.drain().collect();
        assert_eq!(told.len(), MOST_HAPPENINGS);
        assert!(!told.contains(&Happening::NotFinite(bodies[0])));
        assert_eq!(log.drain().count(), 0);
    }
}
