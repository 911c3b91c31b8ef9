//! Where objects touch their ground: a ball in one point, a prism in at most two.

use farseer_core::math::Vector2;
use farseer_core::{BodyId, GeomId, GeomRef};

use super::add::Subject;
use super::{Kept, MAX_POINTS, Manifold, Search, Spot, Surfaces};
use crate::Vector3;
use crate::depth::{DepthProfile, Partner, TouchKey, is_movable};

/// Up, out of the ground.
const UP: Vector3 = Vector3::new(0.0, -1.0, 0.0);

impl Search<'_> {
    /// Finds the contact of every object geom with its ground.
    pub(super) fn touch_grounds(&mut self) {
        for &geom in self.core.geom_list() {
            self.touch_ground(geom);
        }
    }

    fn touch_ground(&mut self, geom: GeomId) -> Option<()> {
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
        let surfaces = Surfaces::combine(core, view, friction, restitution)?;
        self.add(subject(geom, body, view), &manifold, surfaces);
        Some(())
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
