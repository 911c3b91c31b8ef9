//! What touches what in three axes, beyond the contacts of the 2D engine: balls, fronts and backs, platforms and
//! the ground.
//!
//! Frame: that of the solver, x right, y **down**, z into the picture.

mod add;
mod ground;
mod objects;
mod plane;
mod platforms;
mod seams;

pub(super) use plane::take_over_plane_contacts;
pub(super) use seams::{BallContact, smooth_seams};

use farseer_core::{GeomRef, PhysicsSimulator};

use super::plane_handler::Meeting;
use super::report::StepCounters;
use crate::Vector3;
use crate::depth::{Kept, TouchKey, TouchList, World};
use add::Subject;

/// Finds all contacts that the 2D engine does not find.
pub(super) fn find(
    core: &PhysicsSimulator,
    world: &mut World,
    meeting: &mut Meeting,
    found: &mut TouchList,
    counters: &mut StepCounters,
) {
    world.platforms.sort();
    let mut search = Search { core, world, meeting, found, counters };
    search.touch_objects();
    search.touch_platforms();
    search.touch_grounds();
    found.sort();
}

/// What contacts are looked for in, and where they go.
struct Search<'a> {
    core: &'a PhysicsSimulator,
    world: &'a World,
    meeting: &'a mut Meeting,
    found: &'a mut TouchList,
    counters: &'a mut StepCounters,
}

impl Search<'_> {
    /// What a contact of the last update remembers of how it began.
    fn kept(&self, key: TouchKey) -> Option<Kept> {
        self.world.touches.find(key).map(|touch| touch.kept)
    }

    fn add(&mut self, subject: Subject, manifold: &Manifold, surfaces: Surfaces) {
        add::add(self.found, subject, manifold, surfaces, &self.world.touches);
    }
}

/// Most points of a contact that this engine finds itself.
const MAX_POINTS: usize = 2;

/// Where two things touch.
#[derive(Debug, Clone, Copy)]
struct Manifold {
    /// Unit vector towards the geom that is told.
    normal: Vector3,
    points: [Spot; MAX_POINTS],
    count: usize,
    kept: Kept,
    /// The points are on one face along Z and share its pressure.
    shares_pressure: bool,
}

/// A point of a contact before anything is known of its impulses.
#[derive(Debug, Clone, Copy)]
struct Spot {
    position: Vector3,
    separation: f32,
    feature: u32,
}

impl Default for Spot {
    fn default() -> Self {
        Spot { position: Vector3::zeros(), separation: 0.0, feature: 0 }
    }
}

impl Manifold {
    fn of_point(normal: Vector3, position: Vector3, separation: f32, kept: Kept) -> Self {
        let spot = Spot { position, separation, feature: 0 };
        Manifold { normal, points: [spot, Spot::default()], count: 1, kept, shares_pressure: false }
    }

    fn spots(&self) -> &[Spot] {
        &self.points[..self.count]
    }

    fn is_finite(&self) -> bool {
        let finite = |v: Vector3| v.iter().all(|number| number.is_finite());
        finite(self.normal)
            && self.spots().iter().all(|spot| finite(spot.position) && spot.separation.is_finite())
    }
}

/// The combined coefficients of two things, by the rules of the 2D engine.
#[derive(Debug, Clone, Copy)]
struct Surfaces {
    friction: f32,
    restitution: f32,
}

impl Surfaces {
    fn combine(core: &PhysicsSimulator, geom: GeomRef<'_>, friction: f32, restitution: f32) -> Option<Self> {
        let friction = core.mix_friction(friction, geom.friction_coefficient());
        let restitution = PhysicsSimulator::mix_restitution(restitution, geom.restitution_coefficient());
        (friction.is_finite() && restitution.is_finite()).then_some(Surfaces { friction, restitution })
    }
}
