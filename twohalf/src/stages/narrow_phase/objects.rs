//! Manifolds of two objects: balls with any shape, and outlines that touch along Z.

use farseer_core::GeomRef;
use farseer_precise::storage::order::sort_by_number_in;

use super::add_contact::ContactPair;
use super::{ContactFinder, MAX_POINTS, Manifold, ManifoldPoint, PersistedFeature, SurfacePair};
use crate::depth::{ContactTarget, DepthProfile, DepthScheme};
use crate::shapes::{
    ball_ball, ball_prism, ball_prism_through_face, entry_face_of_prism, overlap_points, span_of,
};
use crate::stages::depth_intervals::DepthInterval;
use crate::stages::pairs::{DepthPair, side_of};
use crate::views::PosedGeom;
use crate::{Vector2, Vector3};

impl ContactFinder<'_> {
    /// Finds the contacts of the pairs that the core has left to `twohalf`.
    pub(super) fn find_object_contacts(&mut self) {
        let mut pairs = std::mem::take(&mut self.pair_context.pairs);
        sort_by_number_in(&mut self.found.places, &mut pairs, |pair| pair.key.rank());
        pairs.dedup_by_key(|pair| pair.key);
        self.counters.pairs_tested += pairs.len();
        for &pair in &pairs {
            self.find_object_contact(pair);
        }
        self.pair_context.pairs = pairs;
    }

    fn find_object_contact(&mut self, pair: DepthPair) -> Option<()> {
        let DepthPair { key, geom_a, geom_b } = pair;
        let (core, scheme) = (self.core, self.world.scheme);
        let (a, b) = (core.geom(geom_a)?, core.geom(geom_b)?);
        let kept = self.persisted_feature(key);
        let manifold = match scheme {
            DepthScheme::Thesis => self.thesis(pair, a, b, kept),
            DepthScheme::Faithful | DepthScheme::Precise => self.faithful(pair, kept),
        }?;
        let mut surfaces =
            SurfacePair::combine(core, b, a.friction_coefficient(), a.restitution_coefficient())?;
        if scheme == DepthScheme::Thesis {
            surfaces.friction = 0.0;
        }
        let subject = ContactPair {
            key,
            this: geom_b,
            body: b.body(),
            partner: ContactTarget::Geom(geom_a),
            partner_body: Some(a.body()),
            responds: a.collision_response_enabled() && b.collision_response_enabled(),
        };
        self.add(subject, &manifold, surfaces);
        Some(())
    }

    fn faithful(&mut self, pair: DepthPair, kept: Option<PersistedFeature>) -> Option<Manifold> {
        let (core, depths) = (self.core, &self.world.depths);
        let (a, b) = (PosedGeom::of(core, depths, pair.geom_a)?, PosedGeom::of(core, depths, pair.geom_b)?);
        match (a.profile, b.profile) {
            (DepthProfile::Round { radius: radius_a }, DepthProfile::Round { radius: radius_b }) => {
                let touch = ball_ball(a.centre, radius_a, b.centre, radius_b)?;
                Some(Manifold::of_point(
                    touch.normal,
                    touch.point,
                    touch.separation,
                    PersistedFeature::Nothing,
                ))
            }
            (DepthProfile::Prism { .. }, DepthProfile::Round { radius }) => {
                self.ball_on_prism(b, radius, a, kept)
            }
            (DepthProfile::Round { radius }, DepthProfile::Prism { .. }) => {
                let manifold = self.ball_on_prism(a, radius, b, kept)?;
                Some(Manifold { normal: -manifold.normal, ..manifold })
            }
            // Upright shapes exist with the precise set only.
            _ => {
                let points = &mut self.pair_context.convex_cache.points;
                points.clear();
                overlap_points(&a.geom.world_vertices(), &b.geom.world_vertices(), points);
                let ends = span_of(points)?;
                let [a, b] = [pair.geom_a, pair.geom_b].map(|geom| self.pair_context.intervals.of(geom));
                Some(along_z(a, b, ends, kept))
            }
        }
    }

    /// Returns the manifold of a ball and a prism. While the centre of the ball is inside of the prism, contact pushes the ball
    /// back through the face that it entered.
    fn ball_on_prism(
        &self,
        ball: PosedGeom<'_>,
        radius: f32,
        prism: PosedGeom<'_>,
        kept: Option<PersistedFeature>,
    ) -> Option<Manifold> {
        let outline = prism.geom.world_vertices();
        let (z, half) = (prism.centre.z, prism.profile.half_depth());
        let found = ball_prism(ball.centre, radius, &outline, z, half)?;
        if !found.is_inside {
            let touch = found.touch;
            return Some(Manifold::of_point(
                touch.normal,
                touch.point,
                touch.separation,
                PersistedFeature::Nothing,
            ));
        }
        let side = match kept {
            Some(PersistedFeature::Side(side)) => Some(side),
            _ => {
                let step = self.motion_of(&ball.geom) - self.motion_of(&prism.geom);
                entry_face_of_prism(ball.centre - step, ball.centre, &outline, z, half)
            }
        };
        let side = side.unwrap_or(found.touch.normal);
        let touch = ball_prism_through_face(ball.centre, radius, &outline, z, half, side)?;
        Some(Manifold::of_point(touch.normal, touch.point, touch.separation, PersistedFeature::Side(side)))
    }

    /// Displacement of the body of a geom in the last update, px.
    pub(super) fn motion_of(&self, geom: &GeomRef<'_>) -> Vector3 {
        self.pair_context.intervals.motion_of(self.core, &self.world.depths, geom.body())
    }

    /// Returns the manifold of two geoms in the thesis scheme, by their virtual geoms: footprints and height intervals.
    fn thesis(
        &self,
        pair: DepthPair,
        a: GeomRef<'_>,
        b: GeomRef<'_>,
        kept: Option<PersistedFeature>,
    ) -> Option<Manifold> {
        let (box_a, box_b) = (a.aabb(), b.aabb());
        let (low, high) = (box_a.min.sup(&box_b.min), box_a.max.inf(&box_b.max));
        if low.x >= high.x || low.y >= high.y {
            return None;
        }
        let [a, b] = [pair.geom_a, pair.geom_b].map(|geom| self.pair_context.intervals.of(geom));
        Some(along_z(a, b, [low, high], kept))
    }
}

/// Returns the manifold of two shapes that touch along Z, with front and back. `ends` are two points of the common area in X
/// and Y, px.
fn along_z(
    a: DepthInterval,
    b: DepthInterval,
    ends: [Vector2; 2],
    kept: Option<PersistedFeature>,
) -> Manifold {
    let is_behind = match kept {
        Some(PersistedFeature::Depth { is_behind }) => is_behind,
        // The side from which they came: a fast body may be past the middle already.
        _ => side_of(a, b) > 0.0,
    };
    let sign = if is_behind { 1.0 } else { -1.0 };
    let separation = sign * (b.z - a.z) - (a.half + b.half);
    let face = a.z + sign * (a.half + separation * 0.5);
    let mut ends = ends;
    // The order is the same in every update, so that features match.
    let [p, q] = ends;
    if p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)).is_gt() {
        ends = [q, p];
    }
    let spot = |end: Vector2, feature: u32| ManifoldPoint {
        position: Vector3::new(end.x, end.y, face),
        separation,
        feature,
    };
    Manifold {
        normal: Vector3::new(0.0, 0.0, sign),
        points: [spot(ends[0], 0), spot(ends[1], 1)],
        count: MAX_POINTS,
        kept: PersistedFeature::Depth { is_behind },
        shares_pressure: true,
    }
}
