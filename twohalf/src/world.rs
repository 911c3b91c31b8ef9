//! Everything of a simulator but the 2D engine below it.

use farseer_core::{BodyId, GeomId, PhysicsSimulator};
use serde::{Deserialize, Serialize};

use crate::depth::{Depths, is_movable};
use crate::events::{Collision, Event};
use crate::fields::Fields;
use crate::id_table::IdTable;
use crate::pairs::{KnownPairs, SpacePair};
use crate::platform::Platforms;
use crate::shapes::ConvexPieces;
use crate::solver::SpaceSolver;
use crate::step::StepCounters;
use crate::support::Support;
use crate::touch::{BallContact, TouchList};
use crate::walk::Top;
use crate::{DepthScheme, Projection, Vector2, Vector3};

/// What this engine keeps beside the 2D engine.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct World {
    pub(crate) projection: Projection,
    pub(crate) scheme: DepthScheme,
    /// Z of layer depth 0 and of layer depth 1.
    pub(crate) layer_range: (f32, f32),
    pub(crate) depths: Depths,
    pub(crate) platforms: Platforms,
    pub(crate) fields: Fields,
    /// Contacts of the last update. While an update looks for its own, those of the one before are in `last`. With the precise
    /// set only what was loaded: the engine below knows what touches from the first update on.
    #[serde(skip)]
    pub(crate) touches: TouchList,
    #[serde(skip)]
    pub(crate) last: TouchList,
    #[serde(skip)]
    pub(crate) update: Update,
    #[serde(skip)]
    pub(crate) solver: SpaceSolver,
    #[serde(skip)]
    pub(crate) events: Vec<Event>,
    /// Derived: a body has refused an argument, and the next update is to tell of it.
    #[serde(skip)]
    pub(crate) has_rejected: bool,
    #[serde(skip)]
    pub(crate) counters: StepCounters,
    /// Seconds.
    #[serde(skip)]
    pub(crate) update_time: f32,
}

/// What an update works with; empty or out of date outside of one.
#[derive(Debug, Clone, Default)]
pub(crate) struct Update {
    /// By geom slot.
    pub(crate) reaches: Vec<Reach>,
    /// Pairs that the 2D engine solved in the last update.
    pub(crate) known: KnownPairs,
    /// Pairs whose contacts this engine looks for.
    pub(crate) pairs: Vec<SpacePair>,
    /// Convex pieces of the outlines that were asked for.
    pub(crate) pieces: IdTable<GeomId, ConvexPieces>,
    pub(crate) scratch: Scratch,
    /// What is near the figure that is about to walk.
    pub(crate) tops: Vec<Top>,
    pub(crate) dt: f32,
    /// Contacts are being looked for: those that games may ask for are still the last update's.
    pub(crate) is_running: bool,
    /// Events of the 2D engine that were taken over already.
    pub(crate) core_events: usize,
    /// For the collisions among the events: where their impulse comes from.
    pub(crate) sources: Vec<(u32, Source)>,
    pub(crate) ball_contacts: Vec<BallContact>,
    /// What held bodies up in the last update.
    pub(crate) supports: Vec<(BodyId, Support)>,
    /// Collisions in X and Y that the handler refused and that are not among the events yet.
    pub(crate) vetoed: Vec<Collision>,
    /// What the older geoms were told of them, where only the younger's side was refused.
    pub(crate) halved: Vec<Collision>,
    /// By body slot: whether the body moved along Z and nobody was told yet.
    pub(crate) moved: Vec<bool>,
}

/// Where the impulse of a collision is found after the update.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Source {
    /// Position in the 2D engine's list.
    Arbiter(u32),
    /// The key of a contact of this engine.
    Touch(crate::touch::TouchKey),
}

/// Buffers of the narrow phase.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scratch {
    pub(crate) pieces_a: Vec<Vector2>,
    pub(crate) pieces_b: Vec<Vector2>,
    pub(crate) points: Vec<Vector2>,
}

/// How far a geom reaches along Z in the current update, and how it came there.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Reach {
    pub(crate) z: f32,
    pub(crate) half: f32,
    /// How far its body moved along Z in the last update.
    pub(crate) motion_z: f32,
    pub(crate) is_round: bool,
}

impl World {
    pub(crate) fn new(projection: Projection) -> Self {
        World {
            layer_range: (0.0, projection.height() as f32),
            projection,
            scheme: DepthScheme::default(),
            depths: Depths::default(),
            platforms: Platforms::default(),
            fields: Fields::default(),
            touches: TouchList::default(),
            last: TouchList::default(),
            update: Update::default(),
            solver: SpaceSolver::default(),
            events: Vec::new(),
            has_rejected: false,
            counters: StepCounters::default(),
            update_time: 0.0,
        }
    }

    /// Notes an argument that a setter of a body has refused.
    #[cold]
    pub(crate) fn reject(&mut self, body: BodyId, argument: &'static str) {
        self.depths.bodies[body].rejected.note(argument);
        self.has_rejected = true;
    }

    /// Begins an update: contacts become those of the last one.
    pub(crate) fn begin(&mut self) {
        std::mem::swap(&mut self.last, &mut self.touches);
        self.touches.clear();
        self.update.is_running = true;
        self.events.clear();
        self.counters = StepCounters::default();
        self.update.core_events = 0;
        self.update.sources.clear();
        self.update.pairs.clear();
        self.update.vetoed.clear();
        self.update.halved.clear();
    }

    /// Ends an update in which nothing moved: contacts stay those of the last one.
    pub(crate) fn stand_still(&mut self, core: &PhysicsSimulator) {
        std::mem::swap(&mut self.last, &mut self.touches);
        self.update.is_running = false;
        self.forget_what_left(core);
    }

    /// Notes where the geoms are along Z: all that live, because the 2D engine may ask about one that has left its list.
    pub(crate) fn prepare(&mut self, core: &PhysicsSimulator, dt: f32) {
        self.update.dt = dt;
        self.update.known.prepare(core);
        for geom in core.geoms() {
            let Some(body) = core.geom(geom).map(|geom| geom.body()) else { continue };
            let (Some(state), Some(profile)) = (self.depths.bodies.get(body), self.depths.profiles.get(geom))
            else {
                continue;
            };
            let reach = Reach {
                z: state.z,
                half: profile.half_depth(),
                motion_z: self.motion_of(core, body).z,
                is_round: profile.is_round(),
            };
            if geom.slot() >= self.update.reaches.len() {
                self.update.reaches.resize(geom.slot() + 1, Reach::default());
            }
            self.update.reaches[geom.slot()] = reach;
        }
    }

    pub(crate) fn reach(&self, geom: GeomId) -> Reach {
        self.update.reaches.get(geom.slot()).copied().unwrap_or_default()
    }

    /// Whether a geom is upright, which only the precise set knows.
    pub(crate) fn has_uprights(&self, core: &PhysicsSimulator) -> bool {
        let profile = |geom: GeomId| self.depths.profiles.get(geom);
        core.geoms().any(|geom| profile(geom).is_some_and(|profile| profile.upright().is_some()))
    }

    /// Z of a body's middle.
    pub(crate) fn z_of(&self, body: BodyId) -> f32 {
        self.depths.bodies.get(body).map_or(0.0, |state| state.z)
    }

    /// How a body moved in the last update, y down. Its velocity may have been set since, and contacts may have
    /// kept it from going that way; but it is all that is known of one that was in no update yet.
    pub(crate) fn motion_of(&self, core: &PhysicsSimulator, body: BodyId) -> Vector3 {
        let (Some(plane), Some(state)) = (core.body(body), self.depths.bodies.get(body)) else {
            return Vector3::zeros();
        };
        match state.motion {
            _ if !(is_movable(core, body) || plane.is_kinematic()) => Vector3::zeros(),
            Some(motion) => motion,
            None => {
                let velocity = plane.linear_velocity();
                Vector3::new(velocity.x, velocity.y, state.velocity_z) * self.update.dt
            }
        }
    }

    /// The convex pieces of a geom's outline, in its own coordinates.
    pub(crate) fn pieces_of(&mut self, core: &PhysicsSimulator, geom: GeomId) -> Option<&ConvexPieces> {
        let view = core.geom(geom)?;
        if self.update.pieces.get(geom).is_none() {
            self.update.pieces.insert(geom, ConvexPieces::new(view.local_vertices()));
        }
        self.update.pieces.get(geom)
    }
}
