//! Triangulation of an outline for its decomposition (behaviour chapter 15, section 15.4).

use crate::error::{Error, Result};
use crate::math::{Vector2, scalar, vector2};

/// Maximum number of triangles in the original's tables.
const MAX_TRIANGLES: usize = 175;

/// Distance in both coordinates, in length units, below which two vertices pinch an outline. Farseer's value.
const PINCH_TOLERANCE: f32 = f32::from_bits(0x3A83_126F);

/// Three corners, stored so that the shoelace area is not negative.
pub(super) type Triangle = [Vector2; 3];

fn triangle(a: Vector2, b: Vector2, c: Vector2) -> Triangle {
    let turn = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if turn > 0.0 { [a, b, c] } else { [a, c, b] }
}

/// A task on the stack of [`triangulate`], which does not recurse: an outline may be pinched any number of times.
enum Task {
    Outline(Vec<Vector2>),
    /// Joins the two last results.
    Join,
}

/// The triangles of an outline, which is first cut where two vertices coincide. `None` if a part of it has no ear or if
/// there are no triangles.
pub(super) fn triangulate(outline: Vec<Vector2>) -> Result<Option<Vec<Triangle>>> {
    let mut tasks = vec![Task::Outline(outline)];
    let mut results: Vec<Option<Vec<Triangle>>> = Vec::new();
    while let Some(task) = tasks.pop() {
        match task {
            Task::Outline(outline) if outline.len() < 3 => results.push(Some(Vec::new())),
            Task::Outline(outline) => match find_pinch(&outline) {
                Some((i, j)) => {
                    let rest = outline[j..].iter().chain(&outline[..i]).copied().collect();
                    tasks.push(Task::Join);
                    tasks.push(Task::Outline(rest));
                    tasks.push(Task::Outline(outline[i..j].to_vec()));
                }
                None => results.push(clip_ears(outline)?),
            },
            Task::Join => {
                let (second, first) = (results.pop().flatten(), results.pop().flatten());
                results.push(match (first, second) {
                    (Some(first), Some(second)) => Some(join(first, second)?),
                    _ => None,
                });
            }
        }
    }
    Ok(results.pop().flatten().filter(|triangles| !triangles.is_empty()))
}

/// The first pair of vertices that coincide and are not consecutive in the list; the last and the first are such a
/// pair.
fn find_pinch(outline: &[Vector2]) -> Option<(usize, usize)> {
    let close = |a: f32, b: f32| (a - b).abs() < PINCH_TOLERANCE;
    (0..outline.len()).find_map(|i| {
        let a = outline[i];
        let j = (i + 2..outline.len()).find(|&j| close(a.x, outline[j].x) && close(a.y, outline[j].y))?;
        Some((i, j))
    })
}

fn join(mut first: Vec<Triangle>, second: Vec<Triangle>) -> Result<Vec<Triangle>> {
    for t in second {
        push(&mut first, t)?;
    }
    Ok(first)
}

fn push(triangles: &mut Vec<Triangle>, triangle: Triangle) -> Result<()> {
    if triangles.len() == MAX_TRIANGLES {
        let value = format_args!("an outline of more than {MAX_TRIANGLES} triangles");
        return Err(Error::invalid("self", value, "an outline of at most 175 triangles"));
    }
    triangles.push(triangle);
    Ok(())
}

/// Cuts ears off until a triangle remains, the one with the largest smallest angle first. `None` if there is no ear to
/// begin with; if there is none later on, the triangles so far.
fn clip_ears(mut outline: Vec<Vector2>) -> Result<Option<Vec<Triangle>>> {
    let mut triangles = Vec::new();
    let mut tips: Vec<VertexClass> = (0..outline.len()).map(|i| VertexClass::of(i, &outline)).collect();
    while outline.len() > 3 {
        let Some(best) = best_ear(&tips) else {
            return Ok(if triangles.is_empty() { None } else { Some(triangles) });
        };
        let (lower, upper) = neighbours(best, outline.len());
        push(&mut triangles, triangle(outline[best], outline[upper], outline[lower]))?;
        remove(best, &mut outline, &mut tips);
    }
    push(&mut triangles, triangle(outline[1], outline[2], outline[0]))?;
    Ok(Some(triangles))
}

fn neighbours(i: usize, n: usize) -> (usize, usize) {
    (if i == 0 { n - 1 } else { i - 1 }, if i + 1 == n { 0 } else { i + 1 })
}

/// Class of a vertex, kept from one ear to the next: cutting an ear off changes few vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
enum VertexClass {
    /// The outline turns to the other side there, or not at all.
    Reflex,
    /// The vertex at this index lies in the triangle with the neighbours.
    Blocked(usize),
    /// The triangle with the neighbours lies inside the outline with no other vertex in it. The sine of its smallest
    /// angle; NaN if an edge has length 0.
    Ear(f32),
}

impl VertexClass {
    fn of(i: usize, outline: &[Vector2]) -> VertexClass {
        let (lower, upper) = neighbours(i, outline.len());
        let (here, before, after) = (outline[i], outline[lower], outline[upper]);
        if (here.x - before.x) * (after.y - here.y) - (after.x - here.x) * (here.y - before.y) > 0.0 {
            return VertexClass::Reflex;
        }
        let t = triangle(here, after, before);
        let is_in_the_way = |&j: &usize| j != i && j != lower && j != upper && is_inside(&t, outline[j]);
        match (0..outline.len()).find(is_in_the_way) {
            Some(j) => VertexClass::Blocked(j),
            None => VertexClass::Ear(smallest_sine(here, before, after)),
        }
    }
}

/// The sine of the smallest angle of a triangle; NaN if an edge has length 0.
fn smallest_sine(here: Vector2, before: Vector2, after: Vector2) -> f32 {
    let d1 = vector2::normalize(after - here);
    let d2 = vector2::normalize(here - before);
    let d3 = vector2::normalize(before - after);
    let sine = |a, b| vector2::cross(a, b).abs();
    scalar::min(sine(d1, d2), scalar::min(sine(d2, d3), sine(d3, d1)))
}

/// The ear whose smallest angle has the greatest sine, the first one of equal ears. Ears with an edge of length 0 have
/// no angle and are skipped.
fn best_ear(tips: &[VertexClass]) -> Option<usize> {
    let mut best = None;
    let mut best_score = -10.0;
    for (i, tip) in tips.iter().enumerate() {
        if let &VertexClass::Ear(score) = tip
            && score > best_score
        {
            best = Some(i);
            best_score = score;
        }
    }
    best
}

/// Removes a vertex. Its neighbours are classified again, and the vertices that it alone may have blocked.
fn remove(gone: usize, outline: &mut Vec<Vector2>, tips: &mut Vec<VertexClass>) {
    outline.remove(gone);
    tips.remove(gone);
    let n = outline.len();
    let (before, after) = (if gone == 0 { n - 1 } else { gone - 1 }, if gone == n { 0 } else { gone });
    for (i, tip) in tips.iter_mut().enumerate() {
        match *tip {
            _ if i == before || i == after => *tip = VertexClass::of(i, outline),
            VertexClass::Blocked(by) if by == gone => *tip = VertexClass::of(i, outline),
            VertexClass::Blocked(by) if by > gone => *tip = VertexClass::Blocked(by - 1),
            _ => {}
        }
    }
}

/// Whether a point lies inside a triangle, not on its boundary.
fn is_inside(t: &Triangle, p: Vector2) -> bool {
    let beyond = |f: fn(&Vector2, &Vector2) -> bool| t.iter().all(|corner| f(&p, corner));
    if beyond(|p, c| p.x < c.x)
        || beyond(|p, c| p.x > c.x)
        || beyond(|p, c| p.y < c.y)
        || beyond(|p, c| p.y > c.y)
    {
        return false;
    }
    let (a, b, c) = (t[2] - t[0], t[1] - t[0], p - t[0]);
    let dot = vector2::dot;
    let (aa, ab, ac, bb, bc) = (dot(a, a), dot(a, b), dot(a, c), dot(b, b), dot(b, c));
    let reciprocal = 1.0 / (aa * bb - ab * ab);
    let u = (bb * ac - ab * bc) * reciprocal;
    let w = (aa * bc - ab * ac) * reciprocal;
    u > 0.0 && w > 0.0 && u + w < 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outline(points: &[(f32, f32)]) -> Vec<Vector2> {
        points.iter().map(|&(x, y)| Vector2::new(x, y)).collect()
    }

    #[test]
    fn the_first_and_the_last_vertex_pinch_an_outline() {
        assert_eq!(find_pinch(&outline(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 0.0)])), Some((0, 3)));
    }

    #[test]
    fn a_doubled_vertex_does_not_pinch_an_outline() {
        assert_eq!(find_pinch(&outline(&[(0.0, 0.0), (0.0, 0.0), (4.0, 0.0), (4.0, 4.0)])), None);
    }

    #[test]
    fn a_pinch_is_found_within_a_thousandth() {
        let with_gap = |gap: f32| find_pinch(&outline(&[(0.0, 0.0), (4.0, 0.0), (gap, -gap), (0.0, 4.0)]));
        assert_eq!(with_gap(0.000_9), Some((0, 2)));
        assert_eq!(with_gap(0.001_1), None);
    }

    #[test]
    fn corners_are_stored_with_positive_area() {
        let [a, b, c] = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| Vector2::new(x, y));
        assert_eq!(triangle(a, b, c), [a, b, c]);
        assert_eq!(triangle(a, c, b), [a, b, c]);
    }

    #[test]
    fn a_point_on_the_boundary_is_not_inside() {
        let t = [(0.0, 0.0), (4.0, 0.0), (0.0, 4.0)].map(|(x, y)| Vector2::new(x, y));
        let inside = [(1.0, 1.0), (2.0, 0.0), (2.0, 2.0), (0.0, 0.0), (5.0, 1.0)];
        assert_eq!(
            inside.map(|(x, y)| is_inside(&t, Vector2::new(x, y))),
            [true, false, false, false, false]
        );
    }

    #[test]
    fn triangles_cut_before_ears_run_out_are_returned() {
        let crossing_itself = [(3.0, 3.0), (4.0, 6.0), (6.0, 0.0), (5.0, 3.0), (2.0, 5.0)];
        assert_eq!(clip_ears(outline(&crossing_itself)).unwrap().map(|triangles| triangles.len()), Some(1));
    }

    /// Pairs of pseudo-random numbers.
    fn points(seed: u32, count: usize) -> Vec<Vector2> {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as f32
        };
        (0..count).map(|_| Vector2::new(next(), next())).collect()
    }

    /// Outlines that may cross themselves: the algorithm does not require simple ones.
    #[test]
    fn incremental_vertex_classes_equal_recomputed_ones() {
        let mut cut = 0;
        for seed in 0..200 {
            let mut outline = points(seed, 40);
            let mut tips: Vec<VertexClass> =
                (0..outline.len()).map(|i| VertexClass::of(i, &outline)).collect();
            while let Some(best) = best_ear(&tips).filter(|_| outline.len() > 3) {
                remove(best, &mut outline, &mut tips);
                cut += 1;
                for (i, tip) in tips.iter().enumerate() {
                    let agrees = match (VertexClass::of(i, &outline), *tip) {
                        (VertexClass::Ear(anew), VertexClass::Ear(kept)) => anew.to_bits() == kept.to_bits(),
                        // Any vertex that blocks the ear is accepted.
                        (VertexClass::Blocked(_), VertexClass::Blocked(by)) => {
                            let (lower, upper) = neighbours(i, outline.len());
                            let t = triangle(outline[i], outline[upper], outline[lower]);
                            ![i, lower, upper].contains(&by) && is_inside(&t, outline[by])
                        }
                        (anew, kept) => anew == kept,
                    };
                    assert!(agrees, "vertex {i} of {outline:?}: {tip:?}");
                }
            }
        }
        assert!(cut > 1000, "{cut}");
    }

    #[test]
    fn an_outline_without_any_ear_fails() {
        let against_engine_winding = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];
        assert_eq!(clip_ears(outline(&against_engine_winding)), Ok(None));
    }
}
