//! Which of the ways to find contacts is that of two things of which one is upright.

use super::solid::{Before, Kind, Limits, Solid, nearness, prism_and_ball};
use super::upright::{Standing, Upright, product};
use super::upright_prism::Extruded;
use super::{slant, upright, upright_prism, upright_slant};
use crate::math::Vector3;
use crate::math::plane::{difference, place};
use crate::precise::manifold::Manifold;
use crate::precise::outline::{Family, Shape};
use crate::precise::parameters::depth::{FLAT_SIDE_COSINE, FLAT_SIDE_LEAN};

/// The contacts of A and B, of which A gives way less and one at least is upright.
pub(super) fn touch(a: Solid<'_>, b: Solid<'_>, before: Before, limits: Limits) -> Manifold {
    let round = |solid: &Solid<'_>| Upright::ball(solid.outline.shape.radius);
    match ((a.kind, a.upright), (b.kind, b.upright)) {
        ((Kind::Ground, _), (_, Some(upright))) => on_ground(a, b, upright, limits.reach),
        ((_, Some(one)), (_, Some(other))) => upright::touch(a, b, [one, other], before, limits),
        ((Kind::Ball, _), (_, Some(other))) => upright::touch(a, b, [&round(&a), other], before, limits),
        ((_, Some(one)), (Kind::Ball, _)) => upright::touch(a, b, [one, &round(&b)], before, limits),
        ((Kind::Prism(half), _), (_, Some(upright))) if upright.rounding > 0.0 => {
            on_prism(a, half, (b, upright), before, limits)
        }
        ((_, Some(upright)), (Kind::Prism(half), _)) if upright.rounding > 0.0 => {
            let found = on_prism(b, half, (a, upright), before.flipped(), limits);
            super::solid::flipped(found, b, a)
        }
        ((Kind::Prism(half), _), (_, Some(upright))) => match &a.slant {
            Some(shape) => upright_slant::touch(a, b, (upright, shape), before, limits),
            None => upright_prism::touch(a, b, (upright, half, false), before, limits),
        },
        ((_, Some(upright)), (Kind::Prism(half), _)) => {
            upright_prism::touch(a, b, (upright, half, true), before, limits)
        }
        _ => Manifold::apart(0.0),
    }
}

/// How far apart two are, of which one at least is upright, and along which axis, from A to B. Along that they come together no
/// faster than they move.
pub(super) fn separation(a: Solid<'_>, b: Solid<'_>) -> (f32, [f32; 3]) {
    let against = |(apart, axis): (f32, [f32; 3])| (apart, axis.map(|part| -part));
    let round = |solid: &Solid<'_>| Upright::ball(solid.outline.shape.radius);
    match ((a.kind, a.upright), (b.kind, b.upright)) {
        ((Kind::Ground, _), (_, Some(upright))) => {
            let [_, y, _] = Standing::new(&b, upright).at;
            (-(y + upright.half + upright.rounding), [0.0, -1.0, 0.0])
        }
        ((_, Some(one)), (_, Some(other))) => between([&a, &b], [one, other]),
        ((Kind::Ball, _), (_, Some(other))) => between([&a, &b], [&round(&a), other]),
        ((_, Some(one)), (Kind::Ball, _)) => between([&a, &b], [one, &round(&b)]),
        ((_, Some(upright)), (Kind::Prism(half), _)) => from_prism(&a, upright, &b, half),
        ((Kind::Prism(half), _), (_, Some(upright))) => against(from_prism(&b, upright, &a, half)),
        _ => (f32::MAX, [0.0, 1.0, 0.0]),
    }
}

fn between([a, b]: [&Solid<'_>; 2], [one, other]: [&Upright; 2]) -> (f32, [f32; 3]) {
    let (a, b) = (Standing::new(a, one), Standing::new(b, other));
    if one.rounding + other.rounding > 0.0 {
        let found = upright::rounded(a, b);
        return (found.apart, found.normal);
    }
    let ways = upright::ways(a, b);
    (ways.best().apart, ways.best().normal)
}

/// From something upright to a prism or box.
fn from_prism(a: &Solid<'_>, shape: &Upright, prism: &Solid<'_>, half: f32) -> (f32, [f32; 3]) {
    let standing = Standing::new(a, shape);
    if shape.rounding == 0.0 {
        return match &prism.slant {
            Some(slanted) => upright_slant::parted(standing, slanted),
            None => upright_prism::parted(standing, &Extruded::new(prism, half)),
        };
    }
    let [ball, _] = nearest_balls(prism, a, shape, 0.0);
    let [x, y] = ball.centre();
    let found = match &prism.slant {
        Some(slanted) => slanted
            .nearest(Vector3::new(x, y, ball.z))
            .map(|(distance, normal)| (distance - shape.rounding, [normal.x, normal.y], normal.z)),
        None => nearness(*prism, half, ball, [0.0; 3], 0.0, f32::MAX),
    };
    found.map_or((f32::MAX, [0.0, 1.0, 0.0]), |(apart, [x, y], z)| (apart, [-x, -y, -z]))
}

fn on_ground(ground: Solid<'_>, b: Solid<'_>, shape: &Upright, reach: f32) -> Manifold {
    let [x, y, z] = Standing::new(&b, shape).at;
    let separation = -(y + shape.half + shape.rounding);
    let point = difference([x, -0.5 * separation], place(ground.pose));
    let mut found = Manifold::of_point([0.0, -1.0], point, separation, 0, reach);
    found.depths[0] = z - ground.z;
    found
}

/// A capsule against a prism or a box: the ball of it that is nearest.
fn on_prism(
    prism: Solid<'_>,
    half: f32,
    (capsule, shape): (Solid<'_>, &Upright),
    before: Before,
    limits: Limits,
) -> Manifold {
    let before = if before == Before::Nothing { before } else { Before::Plane };
    let touch = |ball: Solid<'_>| {
        let mut found = match &prism.slant {
            Some(slanted) => slant::ball(slanted, prism, ball, limits.reach),
            None => prism_and_ball(prism, half, ball, before, limits.reach),
        };
        found.depths[0] = ball.z - found.normal_z * shape.rounding - prism.z;
        found
    };
    let [upper, lower] = nearest_balls(&prism, &capsule, shape, FLAT_SIDE_LEAN * limits.reach);
    let mut found = touch(upper);
    if upper.outline.shape.centre == lower.outline.shape.centre {
        return found;
    }
    let other = touch(lower);
    if found.count == 0 {
        return other;
    }
    let normal = |of: &Manifold| [of.normal[0], of.normal[1], of.normal_z];
    if other.count > 0 && product(normal(&found), normal(&other)) > FLAT_SIDE_COSINE {
        found.count = 2;
        found.points[1] = other.points[0];
        found.depths[1] = other.depths[0];
        found.separations[1] = other.separations[0];
        found.features[1] = found.features[0] + 1;
    }
    found
}

/// The balls of a capsule that are nearest to a prism or box: one, or those at both ends of where its side lies along that.
fn nearest_balls<'a>(prism: &Solid<'_>, capsule: &Solid<'a>, shape: &Upright, flush: f32) -> [Solid<'a>; 2] {
    let at = Standing::new(capsule, shape).at;
    let heights = match &prism.slant {
        Some(slanted) => {
            let distance = |y: f32| {
                let nearest = slanted.nearest(Vector3::new(at[0], y, at[2]));
                nearest.map_or(f32::MAX, |(distance, _)| distance)
            };
            upright_prism::lowest_of(at[1] - shape.half, at[1] + shape.half, flush, distance)
        }
        None => upright_prism::nearest_heights(prism, at, shape.half, flush),
    };
    heights.map(|height| ball_of(*capsule, shape.rounding, height - at[1]))
}

/// The ball of a capsule that is so much below its middle.
fn ball_of(capsule: Solid<'_>, radius: f32, below: f32) -> Solid<'_> {
    let mut ball = capsule;
    let [x, y] = capsule.outline.shape.centre;
    let mut shape = Shape::default();
    (shape.family, shape.radius, shape.centre) = (Family::Circle, radius, [x, y + below]);
    ball.outline.shape = shape;
    (ball.outline.points, ball.outline.normals) = (&[], &[]);
    (ball.kind, ball.upright) = (Kind::Ball, None);
    ball
}
