//! Manifolds of objects with their ground: one point for a ball, at most two for a prism.

use farseer_core::math::Vector2;
use farseer_core::{BodyId, GeomId, GeomRef};

use super::add_contact::ContactPair;
use super::{ContactFinder, MAX_POINTS, Manifold, ManifoldPoint, PersistedFeature, SurfacePair};
use crate::Vector3;
use crate::depth::{ContactKey, ContactTarget, DepthProfile, is_movable};

/// Unit normal of the ground, y down.
const GROUND_NORMAL: Vector3 = Vector3::new(0.0, -1.0, 0.0);

impl ContactFinder<'_> {
    /// Finds the contact of every object geom with its ground.
    pub(super) fn find_ground_contacts(&mut self) {
        for &geom in self.core.geom_list() {
            self.find_ground_contact(geom);
        }
    }

    fn find_ground_contact(&mut self, geom: GeomId) -> Option<()> {
        let (core, depths) = (self.core, &self.world.depths);
        let view = core.geom(geom)?;
        let body = view.body();
        let state = depths.bodies.get(body)?;
        if state.ground.object_geom() != Some(geom) || !view.collision_enabled() || !is_movable(core, body) {
            return None;
        }
        let manifold = match *depths.profiles.get(geom)? {
            DepthProfile::Round { radius } => of_ball(view, state.z, radius),
            _ => of_prism(view, state.z, core.allowed_penetration()),
        }?;
        let (friction, restitution) =
            (state.ground.friction_coefficient(), state.ground.restitution_coefficient());
        let surfaces = SurfacePair::combine(core, view, friction, restitution)?;
        self.add(contact_pair(geom, body, view), &manifold, surfaces);
        Some(())
    }
}

fn contact_pair(geom: GeomId, body: BodyId, view: GeomRef<'_>) -> ContactPair {
    ContactPair {
        key: ContactKey::Ground(view.id()),
        this: geom,
        body,
        partner: ContactTarget::Ground,
        partner_body: None,
        responds: view.collision_response_enabled(),
    }
}

/// Returns the manifold of a ball on the ground, with its lowest point; `None` if this is not below the ground.
fn of_ball(geom: GeomRef<'_>, z: f32, radius: f32) -> Option<Manifold> {
    let centre = geom.position();
    let lowest = centre.y + radius;
    let position = Vector3::new(centre.x, lowest, z);
    (lowest > 0.0).then(|| Manifold::of_point(GROUND_NORMAL, position, -lowest, PersistedFeature::Nothing))
}

/// Returns the manifold of a prism on the ground: the deepest vertex, and the vertex below the ground that is farthest from it
/// along x. Among vertices that are equally deep within `slop` px, the first point is the vertex farthest from the second
/// point. The points of a face on the ground are therefore its ends, whichever vertex rounding makes the deepest.
fn of_prism(geom: GeomRef<'_>, z: f32, slop: f32) -> Option<Manifold> {
    let vertices = geom.world_vertices();
    let below = || vertices.iter().enumerate().filter(|(_, vertex)| vertex.y > 0.0);
    let deepest = best(below(), |vertex| vertex.y)?;
    let floor = vertices[deepest].y - slop;
    let from = |index: usize| {
        let x = vertices[index].x;
        move |vertex: Vector2| (vertex.x - x).abs()
    };
    let second = best(below(), from(deepest)).unwrap_or(deepest);
    let first = best(below().filter(|(_, vertex)| vertex.y >= floor), from(second)).unwrap_or(deepest);
    let spot = |index: usize| ManifoldPoint {
        position: Vector3::new(vertices[index].x, vertices[index].y, z),
        separation: -vertices[index].y,
        feature: index as u32,
    };
    let count = if vertices[second].x == vertices[first].x { 1 } else { MAX_POINTS };
    let points = [spot(first), spot(second)];
    Some(Manifold {
        normal: GROUND_NORMAL,
        points,
        count,
        kept: PersistedFeature::Nothing,
        shares_pressure: false,
    })
}

/// Index of the first vertex with the greatest `value`.
fn best<'a>(
    vertices: impl Iterator<Item = (usize, &'a Vector2)>,
    value: impl Fn(Vector2) -> f32,
) -> Option<usize> {
    let mut best: Option<(usize, f32)> = None;
    for (index, &vertex) in vertices {
        let value = value(vertex);
        if best.is_none_or(|(_, greatest)| value > greatest) {
            best = Some((index, value));
        }
    }
    best.map(|(index, _)| index)
}
