//! Manifolds of objects with platforms.

use farseer_core::{GeomId, GeomRef};

use super::add_contact::ContactPair;
use super::{ContactFinder, Manifold, ManifoldPoint, PersistedFeature, SurfacePair};
use crate::Vector3;
use crate::depth::{ContactKey, ContactTarget, DepthProfile, Platform, PlatformId, is_movable};
use crate::shapes::{BoxManifold, SlantedBox, prism_box};

impl ContactFinder<'_> {
    /// Finds the contacts of all objects with all platforms.
    pub(super) fn find_platform_contacts(&mut self) {
        let (core, platforms) = (self.core, &self.world.platforms);
        if platforms.is_empty() {
            return;
        }
        for &geom in core.geom_list() {
            let Some(view) = core.geom(geom) else { continue };
            if !is_movable(core, view.body()) {
                continue;
            }
            let (aabb, reach) = (view.aabb(), self.pair_context.intervals.of(geom));
            let low = Vector3::new(aabb.min.x, aabb.min.y, reach.z - reach.half);
            let high = Vector3::new(aabb.max.x, aabb.max.y, reach.z + reach.half);
            for (id, platform) in platforms.overlapping(low, high) {
                if view.filter().may_meet(platform.filter()) {
                    self.counters.pairs_tested += 1;
                    self.find_platform_contact(geom, view, id, platform);
                }
            }
        }
    }

    fn find_platform_contact(
        &mut self,
        geom: GeomId,
        view: GeomRef<'_>,
        id: PlatformId,
        platform: &Platform,
    ) -> Option<()> {
        let key = ContactKey::Platform(view.id(), id);
        let kept = self.persisted_feature(key);
        let manifold = match *self.world.depths.profiles.get(geom)? {
            DepthProfile::Round { radius } => self.ball_on_box(view, radius, platform.shape(), kept),
            _ => self.prism_on_box(geom, view, platform.shape(), kept),
        }?;
        let (friction, restitution) = (platform.friction_coefficient(), platform.restitution_coefficient());
        let surfaces = SurfacePair::combine(self.core, view, friction, restitution)?;
        let subject = ContactPair {
            key,
            this: geom,
            body: view.body(),
            partner: ContactTarget::Platform(id),
            partner_body: None,
            responds: view.collision_response_enabled() && platform.collision_response_enabled(),
        };
        self.add(subject, &manifold, surfaces);
        Some(())
    }

    fn ball_on_box(
        &self,
        view: GeomRef<'_>,
        radius: f32,
        shape: &SlantedBox,
        kept: Option<PersistedFeature>,
    ) -> Option<Manifold> {
        let position = view.position();
        let centre = Vector3::new(position.x, position.y, self.world.depths.z_of(view.body()));
        let before = centre - self.motion_of(&view);
        let face = match kept {
            Some(PersistedFeature::Face(face)) => Some(face),
            _ => None,
        };
        let touch = shape.ball_touch(centre, before, radius, face)?;
        let kept = touch.face.map_or(PersistedFeature::Nothing, PersistedFeature::Face);
        Some(Manifold::of_point(touch.normal, touch.point, touch.separation, kept))
    }

    fn prism_on_box(
        &mut self,
        geom: GeomId,
        view: GeomRef<'_>,
        shape: &SlantedBox,
        kept: Option<PersistedFeature>,
    ) -> Option<Manifold> {
        let (core, motion, reach) = (self.core, self.motion_of(&view), self.pair_context.intervals.of(geom));
        let ((pieces, corners), points) = self.pair_context.convex_cache.transform(core, geom)?;
        let pair_cache = match kept {
            Some(PersistedFeature::Axis(axis)) => Some(axis),
            _ => None,
        };
        let BoxManifold { normal, points, count, kept, is_depth } = prism_box(
            shape,
            pieces.pieces(corners),
            reach.z,
            reach.half,
            motion,
            core.allowed_penetration(),
            pair_cache,
            points,
        )?;
        let points = points.map(|point| ManifoldPoint {
            position: point.position,
            separation: point.separation,
            feature: point.feature,
        });
        Some(Manifold {
            normal,
            points,
            count,
            kept: PersistedFeature::Axis(kept),
            shares_pressure: is_depth,
        })
    }
}
