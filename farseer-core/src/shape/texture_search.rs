//! Search for holes and further parts of a texture, once some outlines are known (behaviour chapter 15, section
//! 15.6.4).

use super::texture_outline::Pixel;
use super::{Aabb, CrossingEdgeInfo, EdgeAlignment, PolygonCreationAssistance};
use crate::math::calculator::distance_between_point_and_line_segment;
use crate::math::{Vector2, scalar, vector2};

/// Crossings of an outline with a row, from left to right.
fn crossings(outline: &[Vector2], row: i32) -> Vec<CrossingEdgeInfo> {
    let mut crossings = Vec::new();
    let &[_, .., mut before] = outline else {
        return crossings;
    };
    let y = row as f32;
    for (i, &here) in outline.iter().enumerate() {
        let across = (here.y >= y && before.y <= y) || (here.y <= y && before.y >= y);
        if across && here.y != before.y {
            let edge = before - here;
            // An outline that goes through the row at a vertex crosses it once; one that turns back there crosses it
            // not at all or twice.
            let after = outline[if i + 1 == outline.len() { 0 } else { i + 1 }];
            let ahead = here.y - after.y;
            if here.y != y || (if edge.y > 0.0 { ahead <= 0.0 } else { ahead >= 0.0 }) {
                let point = Vector2::new((y - here.y) / edge.y * edge.x + here.x, y);
                crossings.push(CrossingEdgeInfo::new(here, before, point, EdgeAlignment::Vertical));
            }
        }
        before = here;
    }
    crossings.sort_by(|a, b| a.compare_to(b));
    crossings
}

/// The x of the crossings of a row in pairs, between which is the inside of the outline; none if the number of
/// crossings is odd.
fn spans(outline: &[Vector2], row: i32) -> Vec<[f32; 2]> {
    let crossings = crossings(outline, row);
    let (pairs, rest) = crossings.as_chunks::<2>();
    if !rest.is_empty() {
        return Vec::new();
    }
    pairs.iter().map(|pair| pair.map(|crossing| crossing.crossing_point.x)).collect()
}

/// Whether a point is farther than the hull tolerance from an outline of three vertices or more.
fn is_far_from(image: &PolygonCreationAssistance<'_>, outline: &[Vector2], point: Vector2) -> bool {
    let &[_, _, .., mut before] = outline else {
        return false;
    };
    outline.iter().all(|&here| {
        let to_edge = distance_between_point_and_line_segment(point, here, before);
        before = here;
        !(to_edge <= image.hull_tolerance() || vector2::length(point - here) <= image.hull_tolerance())
    })
}

/// The pixel left of a hole inside of an outline, in the row of `start` or below it.
pub(super) fn find_hole(
    image: &PolygonCreationAssistance<'_>,
    outline: &[Vector2],
    start: Option<Pixel>,
) -> Option<Pixel> {
    let bottom = scalar::to_int(outline.iter().fold(f32::MIN, |most, v| if v.y > most { v.y } else { most }));
    let top = match start {
        Some(start) => start.y,
        None => {
            scalar::to_int(outline.iter().fold(f32::MAX, |least, v| if v.y < least { v.y } else { least }))
        }
    };
    let inside = |row: i32| 0 < row && row < image.height();
    if !inside(top) || !inside(bottom) {
        return None;
    }
    let mut rows = (top..=bottom).step_by(image.hole_detection_line_step_size().unsigned_abs() as usize);
    rows.find_map(|row| {
        spans(outline, row).into_iter().find_map(|span| {
            let edge = hole_edge(image, span, row)?;
            is_far_from(image, outline, edge.point()).then_some(edge)
        })
    })
}

/// The last solid pixel before the first gap between two solid pixels of a row.
fn hole_edge(image: &PolygonCreationAssistance<'_>, [left, right]: [f32; 2], y: i32) -> Option<Pixel> {
    let mut last_solid = None;
    let mut gap = false;
    for x in scalar::to_int(left)..=scalar::to_int(right) {
        if image.is_solid(x, y) {
            if gap {
                return last_solid;
            }
            last_solid = Some(Pixel { x, y });
        } else if last_solid.is_some() {
            gap = true;
        }
    }
    None
}

/// Opens an outline left of a hole: a vertex is inserted twice, and the index between the two is returned. `None` if
/// the outline has no edge there.
pub(super) fn split(outline: &mut Vec<Vector2>, hole: Pixel) -> Option<usize> {
    let entrance = hole.point();
    let mut nearest: Option<f32> = None;
    for x in spans(outline, hole.y).into_iter().flatten().filter(|&x| x < entrance.x) {
        if nearest.is_none_or(|best| entrance.x - x < entrance.x - best) {
            nearest = Some(x);
        }
    }
    let foot = Vector2::new(nearest?, entrance.y);

    let before = |i: usize| outline[if i == 0 { outline.len() - 1 } else { i - 1 }];
    let mut place = None;
    let mut least = f32::MAX;
    for (i, &here) in outline.iter().enumerate() {
        let to_edge = distance_between_point_and_line_segment(foot, here, before(i));
        if to_edge < least {
            place = Some(i);
            least = to_edge;
        }
    }
    let place = place?;
    let (here, edge) = (outline[place], before(place) - outline[place]);
    // The original makes NaN vertices from an edge of length 0.
    let opening = if edge == vector2::ZERO {
        here
    } else {
        vector2::normalize(edge) * vector2::length(here - foot) + here
    };
    outline.splice(place..place, [opening, opening]);
    Some(place + 1)
}

/// The first solid pixel after the gap that follows a pixel, row by row.
pub(super) fn next_entrance(image: &PolygonCreationAssistance<'_>, from: Pixel) -> Option<Pixel> {
    let width = image.width();
    let gap =
        (from.x + from.y * width..image.width() * image.height()).find(|&i| !image.is_solid_index(i))?;
    let entrance = (gap..image.width() * image.height()).find(|&i| image.is_solid_index(i))?;
    Some(Pixel { x: entrance % width, y: entrance / width })
}

/// Whether a point is so far from the box of an outline that neither the outline nor a crossing of the point's row can
/// be within the hull tolerance, even with rounding. Pixels are whole numbers up to 2^24, whose distances are rounded
/// by less than 2.
fn is_far_from_box(image: &PolygonCreationAssistance<'_>, aabb: &Aabb, point: Vector2) -> bool {
    let reach = image.hull_tolerance() + 2.0;
    aabb.min.x - point.x > reach
        || point.x - aabb.max.x > reach
        || aabb.min.y - point.y > reach
        || point.y - aabb.max.y > reach
}

/// Whether a pixel lies inside of an outline, whose box is `aabb`, or within the hull tolerance of it.
pub(super) fn is_in_polygon(
    image: &PolygonCreationAssistance<'_>,
    outline: &[Vector2],
    aabb: &Aabb,
    pixel: Pixel,
) -> bool {
    let point = pixel.point();
    if is_far_from_box(image, aabb, point) {
        return false;
    }
    !is_far_from(image, outline, point)
        || spans(outline, pixel.y).into_iter().any(|[left, right]| left <= point.x && point.x <= right)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square whose last vertex repeats the first.
    fn closed_square() -> Vec<Vector2> {
        [(2.0, 2.0), (8.0, 2.0), (8.0, 8.0), (2.0, 8.0), (2.0, 2.0)].map(|(x, y)| Vector2::new(x, y)).to_vec()
    }

    #[test]
    fn a_row_through_a_square_has_one_span() {
        assert_eq!(spans(&closed_square(), 5), [[2.0, 8.0]]);
        assert!(spans(&closed_square(), 9).is_empty());
    }

    #[test]
    fn points_far_from_the_box_are_outside_of_the_polygon() {
        let corners = [(10.0, 12.0), (22.0, 10.0), (25.0, 21.0), (13.0, 24.0)];
        let outline = corners.map(|(x, y)| Vector2::new(x, y));
        let aabb = Aabb::from_vertices(&outline);
        let everywhere = Aabb::new(Vector2::new(-1e6, -1e6), Vector2::new(1e6, 1e6));
        let mut image = PolygonCreationAssistance::new(&[0], 1, 1).unwrap();
        for hull_tolerance in [0.9, 1.5, 4.0] {
            image.set_hull_tolerance(hull_tolerance).unwrap();
            let mut passed_over = 0;
            for pixel in (0..40 * 40).map(|i| Pixel { x: i % 40, y: i / 40 }) {
                let is_in = is_in_polygon(&image, &outline, &everywhere, pixel);
                assert_eq!(is_in_polygon(&image, &outline, &aabb, pixel), is_in, "{pixel:?}");
                passed_over += u32::from(is_far_from_box(&image, &aabb, pixel.point()));
            }
            assert!(passed_over > 800, "{passed_over}");
        }
    }

    #[test]
    fn an_outline_is_opened_left_of_the_hole() {
        let mut outline = closed_square();
        assert_eq!(split(&mut outline, Pixel { x: 5, y: 5 }), Some(5));
        assert_eq!(outline[4..6], [Vector2::new(2.0, 5.0); 2]);
    }

    #[test]
    fn an_outline_opened_where_it_ends_stays_finite() {
        let (end, tower) =
            ((2.0, 2.0), [(4.0, 8.0), (6.0, 8.0), (6.0, 0.0), (9.0, 0.0), (9.0, 9.0), (1.0, 9.0)]);
        let corners = [end].into_iter().chain(tower).chain([end]);
        let mut outline: Vec<Vector2> = corners.map(|(x, y)| Vector2::new(x, y)).collect();
        assert_eq!(split(&mut outline, Pixel { x: 5, y: 2 }), Some(1));
        assert_eq!(outline[..3], [Vector2::new(2.0, 2.0); 3]);
    }

    #[test]
    fn an_outline_without_an_edge_left_of_the_hole_cannot_be_opened() {
        let mut outline = closed_square();
        assert_eq!(split(&mut outline, Pixel { x: 1, y: 5 }), None);
        assert_eq!(outline, closed_square());
    }
}
