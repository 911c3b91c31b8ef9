//! Rounded polygons: all points within a radius of a convex polygon, the core. Not in the original.
//!
//! As for circles and capsules, a polygon stands for the shape in views and in queries of the original: an arc of
//! [`CORNER_POINTS`] points about each corner of the core. The core follows from that polygon and the radius.

use super::outline::is_size;
use crate::builders::MassProperties;
use crate::math::Vector2;
use crate::math::finite::{finite_vertices, positive};
use crate::shape::Vertices;
use crate::{Error, Result};
use farseer_precise::math::plane::Vector;
use farseer_precise::pieces::{is_convex, simplified};

/// Number of points of the arc about each corner of the core, a count. The arc of a right angle is within 2 % of the radius.
const CORNER_POINTS: usize = 5;
/// Least number of corners of a core, a count.
const MIN_CORE_CORNERS: usize = 3;

/// A point or vector in length units, or a unit vector.
type Point = [f64; 2];

/// Returns the corners of the core in the order of positive shoelace area, without straight ones.
///
/// # Errors
/// A radius that is not finite and greater than 0; corners that are not finite, or not those of a convex polygon.
pub(crate) fn checked_core(corners: &[Vector2], radius: f32) -> Result<Vec<Vector>> {
    positive("radius", radius)?;
    finite_vertices("corners", corners)?;
    let core = simplified(corners.iter().map(|corner| [corner.x, corner.y]).collect());
    let is_core = core.len() >= MIN_CORE_CORNERS
        && is_convex(&core)
        && area_of(core.iter().map(|&corner| double(corner))) > 0.0;
    match is_core {
        true => Ok(core),
        false => Err(Error::invalid("corners", corners, "those of a convex polygon with an area")),
    }
}

/// Returns the polygon that stands for a rounded polygon with this core.
pub(crate) fn outline_of(core: &[Vector], radius: f32) -> Vertices {
    let radius = f64::from(radius);
    let arc = |corner: usize| {
        let [from, to] = normals_at(core, corner);
        let turn = turn_of([from, to]);
        (0..CORNER_POINTS).map(move |at| {
            let direction = match at {
                0 => from,
                at if at + 1 == CORNER_POINTS => to,
                at => turned(from, turn * at as f64 / (CORNER_POINTS - 1) as f64),
            };
            let [x, y] = plus(double(core[corner]), direction, radius);
            Vector2::new(x as f32, y as f32)
        })
    };
    (0..core.len()).flat_map(arc).collect::<Vec<_>>().into()
}

/// Returns the corners of the core of the rounded polygon for which `outline` stands, in length units.
pub(crate) fn core_of(outline: &[Vector2], radius: f32) -> Vec<Vector> {
    let at = |index: usize| {
        let point = outline[index % outline.len()];
        [f64::from(point.x), f64::from(point.y)]
    };
    // The winding of geoms is opposite to that of cores.
    let inwards =
        if area_of((0..outline.len()).map(at)) < 0.0 { f64::from(radius) } else { -f64::from(radius) };
    let corner = |first: usize| {
        let last = first + CORNER_POINTS - 1;
        // The flat sides before and after the arc. The longer one has the more exact normal.
        let before = [at(first + outline.len() - 1), at(first)];
        let after = [at(last), at(last + 1)];
        let (side, end) = if length_of(before) >= length_of(after) { (before, first) } else { (after, last) };
        plus(at(end), normal_of(side), inwards).map(|part| part as f32)
    };
    (0..outline.len()).step_by(CORNER_POINTS).map(corner).collect()
}

/// Returns whether a polygon can stand for a rounded polygon. False only after loading corrupt data.
pub(super) fn fits(outline: &[Vector2], radius: f32) -> bool {
    is_size(radius)
        && outline.len() >= MIN_CORE_CORNERS * CORNER_POINTS
        && outline.len().is_multiple_of(CORNER_POINTS)
        && core_of(outline, radius).iter().flatten().all(|part| part.is_finite())
}

/// Returns the mass properties of the border with mass 1 per square length unit: a strip along each side, and a sector of a disc at
/// each corner.
///
/// A sector of half angle a and radius r has the area a r^2. Its centroid is 2/3 r sin(a) / a from the corner, and its moment of
/// inertia about the corner a r^4 / 2.
pub(crate) fn mass_of_border(core: &[Vector], radius: f32) -> Vec<MassProperties> {
    let radius = f64::from(radius);
    let strip = |corner: usize| {
        let side = [double(core[corner]), double(core[(corner + 1) % core.len()])];
        let [[ax, ay], [bx, by]] = side;
        let (length, middle) = (length_of(side), [0.5 * (ax + bx), 0.5 * (ay + by)]);
        let mass = length * radius;
        let centre = plus(middle, normal_of(side), 0.5 * radius);
        MassProperties { mass, centre, inertia: mass * (length * length + radius * radius) / 12.0 }
    };
    let sector = |corner: usize| {
        let normals = normals_at(core, corner);
        let half = 0.5 * turn_of(normals);
        let mass = half * radius * radius;
        let distance = 2.0 / 3.0 * radius * libm::sin(half) / half;
        let centre = plus(double(core[corner]), turned(normals[0], half), distance);
        let inertia = 0.5 * mass * radius * radius - mass * distance * distance;
        MassProperties { mass, centre, inertia }
    };
    (0..core.len()).flat_map(|corner| [strip(corner), sector(corner)]).collect()
}

/// Returns the shoelace area of a polygon, length units^2; negative in the order of the corners of geoms.
fn area_of(corners: impl Iterator<Item = Point> + Clone) -> f64 {
    let edges = corners.clone().zip(corners.cycle().skip(1));
    0.5 * edges.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>()
}

/// Returns the outward unit normals of the sides before and after a corner of the core.
fn normals_at(core: &[Vector], corner: usize) -> [Point; 2] {
    let count = core.len();
    let [before, at, after] =
        [corner + count - 1, corner, corner + 1].map(|index| double(core[index % count]));
    [normal_of([before, at]), normal_of([at, after])]
}

/// Returns the angle between the normals of two sides, radians, -pi..=pi.
fn turn_of([from, to]: [Point; 2]) -> f64 {
    libm::atan2(from[0] * to[1] - from[1] * to[0], from[0] * to[0] + from[1] * to[1])
}

/// Returns the outward unit normal of a side; 0 if it has no length.
fn normal_of([from, to]: [Point; 2]) -> Point {
    let length = length_of([from, to]);
    let inverse = if length > 0.0 { 1.0 / length } else { 0.0 };
    [(to[1] - from[1]) * inverse, (from[0] - to[0]) * inverse]
}

/// Returns the distance of two points, length units.
fn length_of([from, to]: [Point; 2]) -> f64 {
    libm::hypot(to[0] - from[0], to[1] - from[1])
}

/// Returns `point + factor * direction`.
fn plus(point: Point, direction: Point, factor: f64) -> Point {
    [point[0] + factor * direction[0], point[1] + factor * direction[1]]
}

/// Returns a vector turned by `angle` radians.
fn turned([x, y]: Point, angle: f64) -> Point {
    let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
    [cosine * x - sine * y, sine * x + cosine * y]
}

fn double(v: Vector) -> Point {
    v.map(f64::from)
}

#[cfg(test)]
mod tests {
    use super::{checked_core, core_of, outline_of};
    use crate::math::Vector2;

    #[test]
    fn the_core_of_an_outline_is_the_polygon_that_was_rounded() {
        for scale in [1e-3_f32, 1.0, 1e4] {
            let corners = [[-3.0, -2.0], [4.0, -1.0], [2.0, 3.0], [-1.0, 3.5]]
                .map(|[x, y]: [f32; 2]| Vector2::new(x * scale, y * scale));
            let core = checked_core(&corners, 0.7 * scale).unwrap();
            let mut outline = outline_of(&core, 0.7 * scale);
            let again = core_of(&outline, 0.7 * scale);
            outline.force_counter_clockwise_order();
            assert_eq!(core_of(&outline, 0.7 * scale).into_iter().rev().collect::<Vec<_>>(), again);
            for (a, b) in core.iter().flatten().zip(again.iter().flatten()) {
                assert!((a - b).abs() <= 1e-6 * scale, "{core:?} {again:?}");
            }
        }
    }
}
