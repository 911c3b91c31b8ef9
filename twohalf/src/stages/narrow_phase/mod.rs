//! Narrow phase in three axes, beyond the contacts of the core: balls, fronts and backs, platforms and the
//! ground.
//!
//! Frame: that of the solver, x right, y **down**, z into the picture.

mod add_contact;
mod ground;
mod objects;
mod plane;
mod platforms;
mod seams;

pub(super) use plane::adopt_core_contacts;
pub(super) use seams::{BallContact, filter_ghost_contacts};

use farseer_core::{GeomRef, PhysicsSimulator};

use super::core_events::PairContext;
use super::report::StepCounters;
use crate::Vector3;
use crate::depth::{ContactKey, ContactList, PersistedFeature, World};
use add_contact::ContactPair;

/// Finds all contacts that the core does not find.
pub(super) fn find(
    core: &PhysicsSimulator,
    world: &mut World,
    pair_context: &mut PairContext,
    found: &mut ContactList,
    counters: &mut StepCounters,
) {
    world.platforms.sort();
    let mut search = ContactFinder { core, world, pair_context, found, counters };
    search.find_object_contacts();
    search.find_platform_contacts();
    search.find_ground_contacts();
    found.sort();
}

/// Input and output of the narrow phase.
struct ContactFinder<'a> {
    core: &'a PhysicsSimulator,
    world: &'a World,
    pair_context: &'a mut PairContext,
    found: &'a mut ContactList,
    counters: &'a mut StepCounters,
}

impl ContactFinder<'_> {
    /// Returns the persistent feature of a contact of the last update; `None` for a new contact.
    fn persisted_feature(&self, key: ContactKey) -> Option<PersistedFeature> {
        self.world.touches.find(key).map(|touch| touch.kept)
    }

    fn add(&mut self, subject: ContactPair, manifold: &Manifold, surfaces: SurfacePair) {
        add_contact::add(self.found, subject, manifold, surfaces, &self.world.touches);
    }
}

/// Greatest number of points of a manifold of this crate.
const MAX_POINTS: usize = 2;

/// A contact manifold.
#[derive(Debug, Clone, Copy)]
struct Manifold {
    /// Unit normal towards the first geom of the contact.
    normal: Vector3,
    points: [ManifoldPoint; MAX_POINTS],
    /// Number of points, 0..=2.
    count: usize,
    kept: PersistedFeature,
    /// Whether the points share one face along Z and one normal impulse.
    shares_pressure: bool,
}

/// A point of a manifold without impulses.
#[derive(Debug, Clone, Copy)]
struct ManifoldPoint {
    position: Vector3,
    /// Separation in px; negative is penetration.
    separation: f32,
    /// Feature id, dimensionless.
    feature: u32,
}

impl Default for ManifoldPoint {
    fn default() -> Self {
        ManifoldPoint { position: Vector3::zeros(), separation: 0.0, feature: 0 }
    }
}

impl Manifold {
    fn of_point(normal: Vector3, position: Vector3, separation: f32, kept: PersistedFeature) -> Self {
        let spot = ManifoldPoint { position, separation, feature: 0 };
        Manifold { normal, points: [spot, ManifoldPoint::default()], count: 1, kept, shares_pressure: false }
    }

    fn manifold_points(&self) -> &[ManifoldPoint] {
        &self.points[..self.count]
    }

    fn is_finite(&self) -> bool {
        let finite = |v: Vector3| v.iter().all(|number| number.is_finite());
        finite(self.normal)
            && self.manifold_points().iter().all(|spot| finite(spot.position) && spot.separation.is_finite())
    }
}

/// Combined coefficients of two surfaces, by the rules of the core.
#[derive(Debug, Clone, Copy)]
struct SurfacePair {
    /// Friction coefficient, dimensionless.
    friction: f32,
    /// Restitution coefficient, dimensionless.
    restitution: f32,
}

impl SurfacePair {
    fn combine(core: &PhysicsSimulator, geom: GeomRef<'_>, friction: f32, restitution: f32) -> Option<Self> {
        let friction = core.mix_friction(friction, geom.friction_coefficient());
        let restitution = PhysicsSimulator::mix_restitution(restitution, geom.restitution_coefficient());
        (friction.is_finite() && restitution.is_finite()).then_some(SurfacePair { friction, restitution })
    }
}
