//! Where two objects touch: balls with anything, and outlines that met along Z.

use farseer_core::{GeomId, GeomRef, PhysicsSimulator};

use super::list::Subject;
use super::{Kept, MAX_POINTS, Manifold, Spot, Surfaces};
use crate::depth::DepthProfile;
use crate::pairs::{SpacePair, side_of};
use crate::shapes::{
    ball_ball, ball_prism, ball_prism_through_face, entry_face_of_prism, outlines_overlap, overlap_points,
    span_of,
};
use crate::world::{Reach, World};
use crate::{DepthScheme, Partner, Vector2, Vector3};

/// Finds the contacts of the pairs that the 2D engine has left to this one.
pub(super) fn touch_objects(core: &PhysicsSimulator, world: &mut World) {
    let mut pairs = std::mem::take(&mut world.update.pairs);
    pairs.sort_unstable_by_key(|pair| pair.key);
    pairs.dedup_by_key(|pair| pair.key);
    world.counters.pairs_tested += pairs.len();
    for &pair in &pairs {
        touch_pair(core, world, pair);
    }
    world.update.pairs = pairs;
}

fn touch_pair(core: &PhysicsSimulator, world: &mut World, pair: SpacePair) -> Option<()> {
    let SpacePair { key, geom_a, geom_b } = pair;
    let (a, b) = (core.geom(geom_a)?, core.geom(geom_b)?);
    let kept = world.last.find(key).map(|touch| touch.kept);
    let manifold = match world.scheme {
        DepthScheme::Thesis => thesis(world, pair, a, b, kept),
        DepthScheme::Faithful | DepthScheme::Precise => faithful(core, world, pair, a, b, kept),
    }?;
    let mut surfaces = Surfaces::combine(core, b, a.friction_coefficient(), a.restitution_coefficient())?;
    if world.scheme == DepthScheme::Thesis {
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
    world.touches.push(subject, &manifold, surfaces, &world.last);
    Some(())
}

/// A geom in the frame of the solver.
#[derive(Clone, Copy)]
struct Shape<'a> {
    geom: GeomRef<'a>,
    centre: Vector3,
    profile: DepthProfile,
}

fn shape<'a>(world: &World, id: GeomId, geom: GeomRef<'a>) -> Option<Shape<'a>> {
    let (position, z) = (geom.position(), world.z_of(geom.body()));
    let profile = *world.depths.profiles.get(id)?;
    Some(Shape { geom, centre: Vector3::new(position.x, position.y, z), profile })
}

fn faithful(
    core: &PhysicsSimulator,
    world: &mut World,
    pair: SpacePair,
    a: GeomRef<'_>,
    b: GeomRef<'_>,
    kept: Option<Kept>,
) -> Option<Manifold> {
    let (a, b) = (shape(world, pair.geom_a, a)?, shape(world, pair.geom_b, b)?);
    match (a.profile, b.profile) {
        (DepthProfile::Round { radius: radius_a }, DepthProfile::Round { radius: radius_b }) => {
            let touch = ball_ball(a.centre, radius_a, b.centre, radius_b)?;
            Some(Manifold::of_point(touch.normal, touch.point, touch.separation, Kept::Nothing))
        }
        (DepthProfile::Prism { .. }, DepthProfile::Round { radius }) => {
            ball_on_prism(core, world, b, radius, a, kept)
        }
        (DepthProfile::Round { radius }, DepthProfile::Prism { .. }) => {
            let manifold = ball_on_prism(core, world, a, radius, b, kept)?;
            Some(Manifold { normal: -manifold.normal, ..manifold })
        }
        // What is upright is there with the precise set alone.
        _ => {
            let points = &mut world.update.scratch.points;
            points.clear();
            overlap_points(&a.geom.world_vertices(), &b.geom.world_vertices(), points);
            let ends = span_of(points)?;
            Some(along_z(world.reach(pair.geom_a), world.reach(pair.geom_b), ends, kept))
        }
    }
}

/// A ball and a prism. While its centre is inside, the ball is pushed back through the side that it came in by.
fn ball_on_prism(
    core: &PhysicsSimulator,
    world: &World,
    ball: Shape<'_>,
    radius: f32,
    prism: Shape<'_>,
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
            let motion = |shape: Shape<'_>| world.motion_of(core, shape.geom.body());
            let step = motion(ball) - motion(prism);
            entry_face_of_prism(ball.centre - step, ball.centre, &outline, z, half)
        }
    };
    let side = side.unwrap_or(found.touch.normal);
    let touch = ball_prism_through_face(ball.centre, radius, &outline, z, half, side)?;
    Some(Manifold::of_point(touch.normal, touch.point, touch.separation, Kept::Side(side)))
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
    ends.sort_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
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

/// The thesis' virtual geoms: footprints and height intervals.
fn thesis(
    world: &World,
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
    Some(along_z(world.reach(pair.geom_a), world.reach(pair.geom_b), [low, high], kept))
}

/// Whether two geoms overlap in all three axes.
pub(crate) fn overlap(core: &PhysicsSimulator, world: &World, geom1: GeomId, geom2: GeomId) -> bool {
    if let Some(overlap) = crate::upright::overlap(core, world, geom1, geom2) {
        return overlap;
    }
    let shape_of = |id: GeomId| shape(world, id, core.geom(id)?);
    let (Some(a), Some(b)) = (shape_of(geom1), shape_of(geom2)) else { return false };
    let on_prism = |ball: Shape<'_>, radius: f32, prism: Shape<'_>| {
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
