//! Overlap test of two geoms in all three axes.

use farseer_core::{GeomId, GeomRef, PhysicsSimulator};

use super::upright_overlap;
use crate::Vector3;
use crate::depth::{DepthProfile, DepthState};
use crate::shapes::{ball_ball, ball_prism, outlines_overlap};

/// A geom with its centre, px, in the frame of the plane, and its depth profile.
#[derive(Clone, Copy)]
pub(crate) struct PosedGeom<'a> {
    pub(crate) geom: GeomRef<'a>,
    pub(crate) centre: Vector3,
    pub(crate) profile: DepthProfile,
}

impl<'a> PosedGeom<'a> {
    pub(crate) fn of(core: &'a PhysicsSimulator, depths: &DepthState, id: GeomId) -> Option<Self> {
        let geom = core.geom(id)?;
        let (position, z) = (geom.position(), depths.z_of(geom.body()));
        let profile = *depths.profiles.get(id)?;
        Some(PosedGeom { geom, centre: Vector3::new(position.x, position.y, z), profile })
    }
}

/// Returns whether two geoms overlap in all three axes.
pub(crate) fn overlap(core: &PhysicsSimulator, depths: &DepthState, geom1: GeomId, geom2: GeomId) -> bool {
    if let Some(overlap) = upright_overlap::overlap(core, depths, geom1, geom2) {
        return overlap;
    }
    let (Some(a), Some(b)) = (PosedGeom::of(core, depths, geom1), PosedGeom::of(core, depths, geom2)) else {
        return false;
    };
    let on_prism = |ball: PosedGeom<'_>, radius: f32, prism: PosedGeom<'_>| {
        let outline = prism.geom.world_vertices();
        ball_prism(ball.centre, radius, &outline, prism.centre.z, prism.profile.half_depth()).is_some()
    };
    match (a.profile, b.profile) {
        (DepthProfile::Round { radius: r1 }, DepthProfile::Round { radius: r2 }) => {
            ball_ball(a.centre, r1, b.centre, r2).is_some()
        }
        (DepthProfile::Prism { .. }, DepthProfile::Round { radius }) => on_prism(b, radius, a),
        (DepthProfile::Round { radius }, DepthProfile::Prism { .. }) => on_prism(a, radius, b),
        _ => {
            let reach = a.profile.half_depth() + b.profile.half_depth();
            let is_near = a.centre.z == b.centre.z || (a.centre.z - b.centre.z).abs() < reach;
            is_near && outlines_overlap(&a.geom.world_vertices(), &b.geom.world_vertices())
        }
    }
}
