//! Where two objects touch: balls with anything, and outlines that met along Z.

use farseer_core::GeomRef;
use farseer_core::order::sort_within;

use super::add::Subject;
use super::{Kept, MAX_POINTS, Manifold, Search, Spot, Surfaces};
use crate::depth::{DepthProfile, DepthScheme, Partner};
use crate::shapes::{
    ball_ball, ball_prism, ball_prism_through_face, entry_face_of_prism, overlap_points, span_of,
};
use crate::stages::pairs::{SpacePair, side_of};
use crate::stages::reach::Reach;
use crate::views::Placed;
use crate::{Vector2, Vector3};

impl Search<'_> {
    /// Finds the contacts of the pairs that the 2D engine has left to this one.
    pub(super) fn touch_objects(&mut self) {
        let mut pairs = std::mem::take(&mut self.meeting.pairs);
        sort_within(&mut self.found.places, &mut pairs, |pair| pair.key.rank());
        pairs.dedup_by_key(|pair| pair.key);
        self.counters.pairs_tested += pairs.len();
        for &pair in &pairs {
            self.touch_pair(pair);
        }
        self.meeting.pairs = pairs;
    }

    fn touch_pair(&mut self, pair: SpacePair) -> Option<()> {
        let SpacePair { key, geom_a, geom_b } = pair;
        let (core, scheme) = (self.core, self.world.scheme);
        let (a, b) = (core.geom(geom_a)?, core.geom(geom_b)?);
        let kept = self.kept(key);
        let manifold = match scheme {
            DepthScheme::Thesis => self.thesis(pair, a, b, kept),
            DepthScheme::Faithful | DepthScheme::Precise => self.faithful(pair, kept),
        }?;
        let mut surfaces = Surfaces::combine(core, b, a.friction_coefficient(), a.restitution_coefficient())?;
        if scheme == DepthScheme::Thesis {
            surfaces.friction = 0.0;
        }
        let subject = Subject {
            key,
            this: geom_b,
            body: b.body(),
            partner: Partner::Geom(geom_a),
            partner_body: Some(a.body()),
            responds: a.collision_response_enabled() && b.collision_response_enabled(),
        };
        self.add(subject, &manifold, surfaces);
        Some(())
    }

    fn faithful(&mut self, pair: SpacePair, kept: Option<Kept>) -> Option<Manifold> {
        let (core, depths) = (self.core, &self.world.depths);
        let (a, b) = (Placed::of(core, depths, pair.geom_a)?, Placed::of(core, depths, pair.geom_b)?);
        match (a.profile, b.profile) {
            (DepthProfile::Round { radius: radius_a }, DepthProfile::Round { radius: radius_b }) => {
                let touch = ball_ball(a.centre, radius_a, b.centre, radius_b)?;
                Some(Manifold::of_point(touch.normal, touch.point, touch.separation, Kept::Nothing))
            }
            (DepthProfile::Prism { .. }, DepthProfile::Round { radius }) => {
                self.ball_on_prism(b, radius, a, kept)
            }
            (DepthProfile::Round { radius }, DepthProfile::Prism { .. }) => {
                let manifold = self.ball_on_prism(a, radius, b, kept)?;
                Some(Manifold { normal: -manifold.normal, ..manifold })
            }
            // What is upright is there with the precise set alone.
            _ => {
                let points = &mut self.meeting.outlines.points;
                points.clear();
                overlap_points(&a.geom.world_vertices(), &b.geom.world_vertices(), points);
                let ends = span_of(points)?;
                let [a, b] = [pair.geom_a, pair.geom_b].map(|geom| self.meeting.reaches.of(geom));
                Some(along_z(a, b, ends, kept))
            }
        }
    }

    /// A ball and a prism. While its centre is inside, the ball is pushed back through the side that it came in by.
    fn ball_on_prism(
        &self,
        ball: Placed<'_>,
        radius: f32,
        prism: Placed<'_>,
        kept: Option<Kept>,
    ) -> Option<Manifold> {
        let outline = prism.geom.world_vertices();
        let (z, half) = (prism.centre.z, prism.profile.half_depth());
        let found = ball_prism(ball.centre, radius, &outline, z, half)?;
        if !found.is_inside {
            let touch = found.touch;
            return Some(Manifold::of_point(touch.normal, touch.point, touch.separation, Kept::Nothing));
        }
        let side = match kept {
            Some(Kept::Side(side)) => Some(side),
            _ => {
                let step = self.motion_of(&ball.geom) - self.motion_of(&prism.geom);
                entry_face_of_prism(ball.centre - step, ball.centre, &outline, z, half)
            }
        };
        let side = side.unwrap_or(found.touch.normal);
        let touch = ball_prism_through_face(ball.centre, radius, &outline, z, half, side)?;
        Some(Manifold::of_point(touch.normal, touch.point, touch.separation, Kept::Side(side)))
    }

    /// How the body of a geom moved in the last update.
    pub(super) fn motion_of(&self, geom: &GeomRef<'_>) -> Vector3 {
        self.meeting.reaches.motion_of(self.core, &self.world.depths, geom.body())
    }

    /// The thesis' virtual geoms: footprints and height intervals.
    fn thesis(
        &self,
        pair: SpacePair,
        a: GeomRef<'_>,
        b: GeomRef<'_>,
        kept: Option<Kept>,
    ) -> Option<Manifold> {
        let (box_a, box_b) = (a.aabb(), b.aabb());
        let (low, high) = (box_a.min.sup(&box_b.min), box_a.max.inf(&box_b.max));
        if low.x >= high.x || low.y >= high.y {
            return None;
        }
        let [a, b] = [pair.geom_a, pair.geom_b].map(|geom| self.meeting.reaches.of(geom));
        Some(along_z(a, b, [low, high], kept))
    }
}

/// Two shapes that meet with their front and back; `ends` are points that both cover in X and Y.
fn along_z(a: Reach, b: Reach, ends: [Vector2; 2], kept: Option<Kept>) -> Manifold {
    let is_behind = match kept {
        Some(Kept::Depth { is_behind }) => is_behind,
        // Where they came from: a fast one may be past the middle already.
        _ => side_of(a, b) > 0.0,
    };
    let sign = if is_behind { 1.0 } else { -1.0 };
    let separation = sign * (b.z - a.z) - (a.half + b.half);
    let face = a.z + sign * (a.half + separation * 0.5);
    let mut ends = ends;
    // The same order in every update, so that the points are known again.
    let [p, q] = ends;
    if p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)).is_gt() {
        ends = [q, p];
    }
    let spot =
        |end: Vector2, feature: u32| Spot { position: Vector3::new(end.x, end.y, face), separation, feature };
    Manifold {
        normal: Vector3::new(0.0, 0.0, sign),
        points: [spot(ends[0], 0), spot(ends[1], 1)],
        count: MAX_POINTS,
        kept: Kept::Depth { is_behind },
        shares_pressure: true,
    }
}
