//! What stands upright, as the 2D engine below is told of it, and what games ask about it.

use farseer_core::{Body, GeomId, GeomRef, PhysicsSimulator, SpaceFoot, SpaceForm, SpaceUpright, Vertices, apart_in_space};

use crate::depth::DepthProfile;
use crate::shapes::ConvexPieces;
use crate::world::World;
use crate::{Vector2, Vector3};

impl DepthProfile {
    /// As the 2D engine below is told of it, if it is upright.
    pub(crate) fn upright(&self) -> Option<SpaceUpright> {
        match *self {
            DepthProfile::Cylinder { radius, height } => {
                Some(SpaceUpright::Cylinder { radius, half_height: 0.5 * height })
            }
            DepthProfile::Capsule { radius, height } => {
                Some(SpaceUpright::Capsule { radius, half_height: 0.5 * height })
            }
            DepthProfile::Upright { footprint, height } => {
                Some(SpaceUpright::Prism { footprint, half_height: 0.5 * height })
            }
            DepthProfile::Prism { .. } | DepthProfile::Round { .. } => None,
        }
    }

    /// What it looks like from the front: the outline that its geom is given.
    pub(crate) fn front(&self) -> Option<Vertices> {
        let upright = self.upright()?;
        let ([left, right], half) = (span(&upright), half_height(&upright));
        // In the order of the engine's own rectangles.
        let corners = [[left, -half], [left, half], [right, half], [right, -half]];
        Some(corners.into_iter().map(Vector2::from).collect())
    }
}

/// How far it reaches up and down.
pub(crate) fn half_height(upright: &SpaceUpright) -> f32 {
    match *upright {
        SpaceUpright::Cylinder { half_height, .. }
        | SpaceUpright::Capsule { half_height, .. }
        | SpaceUpright::Prism { half_height, .. } => half_height,
    }
}

/// Least and greatest X about its geom's origin.
pub(crate) fn span(upright: &SpaceUpright) -> [f32; 2] {
    match upright {
        SpaceUpright::Cylinder { radius, .. } | SpaceUpright::Capsule { radius, .. } => [-radius, *radius],
        SpaceUpright::Prism { footprint, .. } => {
            let (low, high) = footprint.bounds();
            [low.x, high.x]
        }
    }
}

/// Least and greatest Z about its body.
pub(crate) fn depths(upright: &SpaceUpright) -> [f32; 2] {
    match upright {
        SpaceUpright::Cylinder { radius, .. } | SpaceUpright::Capsule { radius, .. } => [-radius, *radius],
        SpaceUpright::Prism { footprint, .. } => {
            let (low, high) = footprint.bounds();
            [low.y, high.y]
        }
    }
}

/// Looks at what something upright covers of the floor.
pub(crate) fn with_foot<R>(upright: &SpaceUpright, look: impl FnOnce(SpaceFoot<'_>) -> R) -> R {
    match upright {
        SpaceUpright::Cylinder { radius, .. } | SpaceUpright::Capsule { radius, .. } => {
            look(SpaceFoot::Disc(*radius))
        }
        SpaceUpright::Prism { footprint, .. } => {
            let corners: Vec<[f32; 2]> = footprint.corners().iter().map(|corner| [corner.x, corner.y]).collect();
            look(SpaceFoot::Polygon(&corners))
        }
    }
}

/// Where the middle of an upright geom is, y down: it does not turn about its body.
pub(crate) fn middle(geom: GeomRef<'_>, body: &Body, z: f32) -> Vector3 {
    let place = body.position() + geom.offset();
    Vector3::new(place.x, place.y, z)
}

/// Whether two geoms overlap, of which one at least is upright; `None` for two others.
pub(crate) fn overlap(
    core: &PhysicsSimulator,
    world: &World,
    one: GeomId,
    other: GeomId,
) -> Option<bool> {
    let upright = |id: GeomId| world.depths.profiles.get(id).and_then(DepthProfile::upright);
    if upright(one).is_none() && upright(other).is_none() {
        return None;
    }
    let (a, b) = (forms(core, world, one)?, forms(core, world, other)?);
    Some(a.iter().any(|a| b.iter().any(|b| apart_in_space(a.borrowed(), b.borrowed()) < 0.0)))
}

/// A convex part of a geom in three axes.
enum Form {
    Whole(SpaceForm<'static>),
    Part(Vec<[f32; 2]>, f32, f32),
}

impl Form {
    fn borrowed(&self) -> SpaceForm<'_> {
        match self {
            Form::Whole(form) => *form,
            Form::Part(corners, z, half) => SpaceForm::Prism { corners, z: *z, half: *half },
        }
    }
}

fn forms(core: &PhysicsSimulator, world: &World, id: GeomId) -> Option<Vec<Form>> {
    let (geom, profile) = (core.geom(id)?, *world.depths.profiles.get(id)?);
    let z = world.z_of(geom.body());
    if let Some(upright) = profile.upright() {
        let at = middle(geom, core.body(geom.body())?, z);
        return Some(vec![Form::Whole(SpaceForm::Upright(upright, at))]);
    }
    if let DepthProfile::Round { radius } = profile {
        let at = geom.position();
        return Some(vec![Form::Whole(SpaceForm::Ball(radius, Vector3::new(at.x, at.y, z)))]);
    }
    let (pieces, matrix) = (ConvexPieces::new(geom.local_vertices()), geom.matrix());
    let mut corners = Vec::new();
    pieces.lay_out(&matrix, &mut corners);
    let part = |piece: &[Vector2]| {
        Form::Part(piece.iter().map(|corner| [corner.x, corner.y]).collect(), z, profile.half_depth())
    };
    Some(pieces.pieces(&corners).map(part).collect())
}
