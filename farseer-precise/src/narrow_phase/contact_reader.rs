//! Narrow phase: contacts as a game reads them, from the cached manifolds and the impulses of the constraints.

use crate::bodies::BodySet;
use crate::broad_phase::pairs::{CachedManifold, Pairs};
use crate::broad_phase::proxies::Proxies;
use crate::constraint_graph::{ConstraintGraph, ContactConstraint};
use crate::depth::contact_point::DepthContactPoint;
use crate::depth::feature_gate::FeatureGate;
use crate::depth::state::DepthState;
use crate::index::PairIndex;
use crate::math::Vector2;
use crate::math::plane::{
    Vector, difference, dot, rotate, rotate_inverse, rotation, scaled, sum, translation,
};
use crate::math::scalar::nearest_finite;
use crate::narrow_phase::combined_surface::friction_of;
use crate::surface::FrictionType;

/// Contact of a pair in the plane, in the present poses.
pub struct PlanarContact {
    /// Unit normal from A to B, dimensionless, in world axes.
    pub normal: Vector,
    /// Combined friction coefficient of both geoms, dimensionless, >= 0.
    pub friction: f32,
    /// Number of contact points, 0..=2. The first `count` entries of `points` are valid.
    pub count: usize,
    /// Contact points in the plane.
    pub points: [PlanarContactPoint; 2],
}

/// Point of a [`PlanarContact`].
#[derive(Clone, Copy, Default)]
pub struct PlanarContactPoint {
    /// World position in length units, finite: the middle between both shapes.
    pub position: Vector,
    /// Separation at the point in length units, negative for penetration.
    pub separation: f32,
    /// Feature id: constant as long as the same vertices or edges touch.
    pub feature: u32,
    /// Accumulated normal impulse, and the share of the friction impulse, mass units * length units/s.
    pub impulses: [f32; 2],
}

/// Contact of a pair in three axes.
pub struct SpatialContact {
    /// Unit normal from A to B, dimensionless: x, y (down) and z.
    pub normal: [f32; 3],
    /// Combined friction and restitution coefficients of both shapes, dimensionless; 0 without a constraint.
    pub surface: [f32; 2],
    /// Number of contact points, 1..=2. The first `count` entries of `points` are valid.
    pub count: usize,
    /// Contact points in three axes.
    pub points: [DepthContactPoint; 2],
}

/// The parts of the engine from which contacts are read.
#[derive(Clone, Copy)]
pub struct ContactReader<'a> {
    pub(crate) bodies: &'a BodySet,
    pub(crate) proxies: &'a Proxies,
    pub(crate) pairs: &'a Pairs,
    pub(crate) constraints: &'a ConstraintGraph,
    pub(crate) depth: Option<FeatureGate<&'a DepthState>>,
    pub(crate) friction: FrictionType,
}

impl ContactReader<'_> {
    /// Returns the contact constraint of a pair; `None` if the pair has none.
    fn constraint(&self, pair: PairIndex) -> Option<ContactConstraint> {
        let state = self.pairs.state(pair);
        state.constraint.map(|handle| self.constraints.get(state.kind, handle))
    }

    /// Returns the contact of a pair in the plane.
    pub fn planar_contact(&self, pair: PairIndex) -> PlanarContact {
        let [a, b] = self.pairs.proxies_of(pair).map(|proxy| self.proxies.proxy(proxy));
        let manifold = self.pairs.manifold(pair);
        let constraint = self.constraint(pair);
        let [pose_a, pose_b] = [a, b].map(|proxy| self.bodies.poses[proxy.body]);
        let [ca, sa, cb, sb] = manifold.rotations;
        let (turned_a, turned_b) =
            (rotate_inverse([ca, sa], rotation(pose_a)), rotate_inverse([cb, sb], rotation(pose_b)));
        let normal = constraint.map_or(manifold.normal, |lane| lane.normal);
        let mut points = [PlanarContactPoint::default(); 2];
        for (at, point) in points.iter_mut().enumerate().take(manifold.point_count()) {
            let [ax, ay, bx, by] = manifold.anchors[at];
            let on_a = sum(translation(pose_a), rotate(turned_a, [ax, ay]));
            let on_b = sum(translation(pose_b), rotate(turned_b, [bx, by]));
            let separation = manifold.separations[at] + dot(difference(on_b, on_a), normal);
            *point = PlanarContactPoint {
                // A body may have been moved as far as `f32` reaches.
                position: scaled(sum(on_a, on_b), 0.5).map(nearest_finite),
                separation: constraint.map_or(separation, |lane| lane.points[at].separation),
                feature: manifold.features[at],
                impulses: constraint.map_or([0.0; 2], |lane| {
                    [lane.points[at].normal_impulse, lane.tangent_impulse / manifold.count as f32]
                }),
            };
        }
        let friction = friction_of(self.friction, a, b);
        PlanarContact { normal, friction, count: manifold.point_count(), points }
    }

    /// Returns the contact of a pair in three axes. `None` if the shapes are beyond the contact margin.
    pub fn spatial_contact(&self, pair: PairIndex) -> Option<SpatialContact> {
        let space = self.depth.as_ref()?;
        let proxies = self.pairs.proxies_of(pair);
        let [a, b] = proxies.map(|proxy| self.proxies.proxy(proxy));
        let CachedManifold { normal: [x, y], count, anchors, separations, features, depth: frozen, .. } =
            self.pairs.manifold(pair);
        if *count == 0 {
            return None;
        }
        let lane = self.constraint(pair);
        // The surfaces as they are now: a constraint takes an edit over only in the next step.
        let surface = lane.map(|_| space.combined_surface(proxies, [a, b], self.friction));
        let origin = translation(self.bodies.poses[a.body]);
        let mut points = [DepthContactPoint::default(); 2];
        for (at, point) in points.iter_mut().enumerate().take(*count as usize) {
            let [ax, ay, ..] = anchors[at];
            let [px, py] = sum(origin, [ax, ay]);
            let (impulse, friction_impulse, separation) =
                lane.map_or((0.0, [0.0; 2], separations[at]), |lane| {
                    let [.., along, across] = lane.depth.totals;
                    let shared = [along, across].map(|total| total / *count as f32);
                    (lane.depth.totals[at], shared, lane.points[at].separation)
                });
            *point = DepthContactPoint {
                position: Vector2::new(nearest_finite(px), nearest_finite(py)),
                separation: nearest_finite(separation),
                feature: features[at],
                impulse: nearest_finite(impulse),
                friction_impulse: friction_impulse.map(nearest_finite),
            };
        }
        let normal = [*x, *y, frozen.normal_z];
        Some(SpatialContact { normal, surface: surface.unwrap_or_default(), count: *count as usize, points })
    }
}
