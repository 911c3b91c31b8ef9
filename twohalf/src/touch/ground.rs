//! Where objects touch their ground: a ball in one point, a prism in at most two.

use farseer_core::math::Vector2;
use farseer_core::{BodyId, GeomId, GeomRef, PhysicsSimulator};

use super::list::Subject;
use super::{Kept, MAX_POINTS, Manifold, Spot, Surfaces, TouchKey};
use crate::depth::{DepthProfile, is_movable};
use crate::world::World;
use crate::{Partner, Vector3};

/// Up, out of the ground.
const UP: Vector3 = Vector3::new(0.0, -1.0, 0.0);

/// Finds the contact of every object geom with its ground.
pub(super) fn touch_grounds(core: &PhysicsSimulator, world: &mut World) {
    for &geom in core.geom_list() {
        let Some(view) = core.geom(geom) else { continue };
        let body = view.body();
        let Some(state) = world.depths.bodies.get(body) else { continue };
        if state.ground.object_geom() != Some(geom) || !view.collision_enabled() || !is_movable(core, body) {
            continue;
        }
        let Some(profile) = world.depths.profiles.get(geom) else { continue };
        let manifold = match *profile {
            DepthProfile::Round { radius } => of_ball(view, state.z, radius),
            _ => of_prism(view, state.z, core.allowed_penetration()),
        };
        let (friction, restitution) =
            (state.ground.friction_coefficient(), state.ground.restitution_coefficient());
        let surfaces = Surfaces::combine(core, view, friction, restitution);
        if let (Some(manifold), Some(surfaces)) = (manifold, surfaces) {
            world.touches.push(subject(geom, body, view), &manifold, surfaces, &world.last);
        }
    }
}

fn subject(geom: GeomId, body: BodyId, view: GeomRef<'_>) -> Subject {
    Subject {
        key: TouchKey::Ground(view.id()),
        this: geom,
        body,
        partner: Partner::Ground,
        partner_body: None,
        responds: view.collision_response_enabled(),
    }
}

/// The lowest point of a ball, if it is below the ground.
fn of_ball(geom: GeomRef<'_>, z: f32, radius: f32) -> Option<Manifold> {
    let centre = geom.position();
    let lowest = centre.y + radius;
    let position = Vector3::new(centre.x, lowest, z);
    (lowest > 0.0).then(|| Manifold::of_point(UP, position, -lowest, Kept::Nothing))
}

/// The deepest vertex and the vertex below the ground that is farthest from it along x. Where several are
/// equally deep, within `slop`, the first one is the one farthest from the second: the points of a face
/// that lies on the ground are its ends, whichever of its vertices rounding makes the deepest.
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
    let spot = |index: usize| Spot {
        position: Vector3::new(vertices[index].x, vertices[index].y, z),
        separation: -vertices[index].y,
        feature: index as u32,
    };
    let count = if vertices[second].x == vertices[first].x { 1 } else { MAX_POINTS };
    let points = [spot(first), spot(second)];
    Some(Manifold { normal: UP, points, count, kept: Kept::Nothing, shares_pressure: false })
}

/// Index of the first vertex for which `value` is greatest.
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
