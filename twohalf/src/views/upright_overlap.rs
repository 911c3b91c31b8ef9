//! Overlap test of upright geoms.

use farseer_core::{GeomId, PhysicsSimulator};
use farseer_precise::depth::shape_distance::{DepthQueryShape, signed_distance_3d};

use crate::depth::{DepthProfile, DepthState, upright};
use crate::shapes::ConvexPieces;
use crate::{Vector2, Vector3};

/// Returns whether two geoms overlap in three axes, if at least one is upright; `None` if neither is.
pub(crate) fn overlap(
    core: &PhysicsSimulator,
    depths: &DepthState,
    one: GeomId,
    other: GeomId,
) -> Option<bool> {
    let upright_of = |id: GeomId| depths.profiles.get(id).and_then(DepthProfile::upright);
    if upright_of(one).is_none() && upright_of(other).is_none() {
        return None;
    }
    let (a, b) = (query_shapes(core, depths, one)?, query_shapes(core, depths, other)?);
    Some(a.iter().any(|a| b.iter().any(|b| signed_distance_3d(a.as_core_shape(), b.as_core_shape()) < 0.0)))
}

/// A convex part of a geom in three axes.
enum QueryShape {
    Whole(DepthQueryShape<'static>),
    Part(Vec<[f32; 2]>, f32, f32),
}

impl QueryShape {
    fn as_core_shape(&self) -> DepthQueryShape<'_> {
        match self {
            QueryShape::Whole(form) => *form,
            QueryShape::Part(corners, z, half) => DepthQueryShape::Prism { corners, z: *z, half: *half },
        }
    }
}

fn query_shapes(core: &PhysicsSimulator, depths: &DepthState, id: GeomId) -> Option<Vec<QueryShape>> {
    let (geom, profile) = (core.geom(id)?, *depths.profiles.get(id)?);
    let z = depths.z_of(geom.body());
    if let Some(upright) = profile.upright() {
        let at = upright::middle(geom, core.body(geom.body())?, z);
        return Some(vec![QueryShape::Whole(DepthQueryShape::Vertical(upright, at))]);
    }
    if let DepthProfile::Round { radius } = profile {
        let at = geom.position();
        return Some(vec![QueryShape::Whole(DepthQueryShape::Sphere(radius, Vector3::new(at.x, at.y, z)))]);
    }
    let (pieces, matrix) = (ConvexPieces::new(geom.local_vertices()), geom.matrix());
    let mut corners = Vec::new();
    pieces.transform_into(&matrix, &mut corners);
    let part = |piece: &[Vector2]| {
        QueryShape::Part(piece.iter().map(|corner| [corner.x, corner.y]).collect(), z, profile.half_depth())
    };
    Some(pieces.pieces(&corners).map(part).collect())
}
