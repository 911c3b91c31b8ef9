//! What began and ceased to touch, told once each, whatever the methods: those of the engines tell of it in several ways.

use std::collections::VecDeque;

use farseer_core::order::{joined, sort_by_number};
use farseer_core::{BodyId, GeomId, JointId, ObjectId, PhysicsSimulator, SpringId};
#[cfg(feature = "depth")]
use twohalf::{PlatformId, TwoHalfPhysicsSimulator};

use crate::world::Engine;

/// Of a game that never asks the oldest are forgotten.
const MOST_HAPPENINGS: usize = 65_536;

/// What a geom touches.
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

/// A geom and what it touches: of two geoms that with the smaller id is first.
type Touch = (GeomId, Partner);

/// What happened, for a game to hear of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Happening {
    TouchBegin(GeomId, Partner),
    TouchEnd(GeomId, Partner),
    JointBroke(JointId),
    SpringBroke(SpringId),
    /// The body left the numbers that there are, and was put back and, if it can move, disabled.
    NotFinite(BodyId),
}

/// What touches, and what happened since somebody asked.
#[derive(Debug, Default)]
pub(crate) struct Log {
    /// In order, each once.
    touching: Vec<Touch>,
    happenings: VecDeque<Happening>,
    /// Something was edited that ends touches of which the engines do not tell.
    is_in_doubt: bool,
}

fn ordered(this: GeomId, partner: impl Into<Partner>) -> Touch {
    match partner.into() {
        Partner::Geom(other) if other < this => (other, Partner::Geom(this)),
        partner => (this, partner),
    }
}

impl Log {
    /// After a disposal, or something was switched on or off.
    pub(crate) fn doubt(&mut self) {
        self.is_in_doubt = true;
    }

    /// What happened since the last call.
    pub(crate) fn drain(&mut self) -> impl Iterator<Item = Happening> + '_ {
        self.happenings.drain(..)
    }

    /// After the engine was restored: what touches now is no news.
    pub(crate) fn begin_anew(&mut self, engine: &Engine) {
        *self = Log { touching: touching_now(engine), ..Log::default() };
    }

    /// Takes over what the last update tells.
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
                Event::Collision { this, other, .. } => self.begin(ordered(this, Partner::Geom(other))),
                Event::Separation { this, other } => self.end(ordered(this, Partner::Geom(other))),
                Event::JointBroke { joint } => self.tell(Happening::JointBroke(joint)),
                Event::SpringBroke { spring } => self.tell(Happening::SpringBroke(spring)),
                Event::NotFinite { body, .. } => self.tell_not_finite(body),
                Event::Removed { object: ObjectId::Body(_) | ObjectId::Geom(_) } => self.doubt(),
                _ => {}
            }
        }
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

fn touching_now(engine: &Engine) -> Vec<Touch> {
    let mut now = Vec::new();
    let mut note = |touch| now.push(touch);
    match engine {
        Engine::Plane(simulator) => {
            let touching = simulator.arbiters().filter(|arbiter| arbiter.contacts().len() > 0);
            touching.for_each(|arbiter| note(ordered(arbiter.geom_a(), Partner::Geom(arbiter.geom_b()))));
        }
        #[cfg(feature = "depth")]
        Engine::Depth(depth) => {
            depth.simulator.contacts().for_each(|contact| note(ordered(contact.this, contact.partner)));
        }
    }
    // What touches is there: no two share a slot.
    sort_by_number(&mut now, |&(this, partner)| {
        let (kind, number) = match partner {
            Partner::Geom(geom) => (0, geom.slot() as u32),
            #[cfg(feature = "depth")]
            Partner::Platform(platform) => (1, platform.to_bits()),
            #[cfg(feature = "depth")]
            Partner::Ground => (2, 0),
        };
        joined([this.slot() as u32, kind, number])
    });
    now.dedup();
    now
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_more_than_fits_the_oldest_are_forgotten() {
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
