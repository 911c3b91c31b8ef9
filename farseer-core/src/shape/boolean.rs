//! Union, difference and intersection of two outlines (behaviour chapter 15, section 15.5).
//!
//! All three round both outlines to whole numbers, insert the points where they cross into both, and walk from one
//! outline to the other at these points. For limits of the method see [`Vertices::union`].

use std::f64::consts::PI;

use super::{Edge, EdgeIntersectInfo, Vertices};
use crate::error::Error;
use crate::math::Vector2;
use crate::math::finite::finite_vertices;
use crate::shape::ray_helper;

/// Why a boolean operation has no valid result. Variants contain the outline that the original returned in spite of it;
/// its `None` is `Ok`.
#[doc(alias("PolyUnionError.None", "FarseerGames.FarseerPhysics.Collisions.PolyUnionError"))]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PolyUnionError {
    /// The outlines do not cross. They are apart, or one is inside of the other, or they are the same. The original
    /// returned null.
    #[doc(alias = "PolyUnionError.NoIntersections")]
    #[error("the outlines do not cross")]
    NoIntersections,
    /// Every vertex of the first polygon and every crossing is inside of the second polygon or on its outline.
    #[doc(alias = "PolyUnionError.Poly1InsidePoly2")]
    #[error("polygon 1 is inside of polygon 2")]
    Poly1InsidePoly2 {
        /// The result: the second polygon, not rounded, for a union, and an empty list for a difference.
        outline: Vertices,
    },
    /// The walk did not get back to its start.
    #[doc(alias = "PolyUnionError.InfiniteLoop")]
    #[error("the way around the result does not get back to its start")]
    InfiniteLoop {
        /// The path until it was given up: useless as an outline.
        outline: Vertices,
    },
    /// A vertex is not finite.
    #[error(transparent)]
    InvalidArgument(#[from] Error),
}

#[derive(Clone, Copy, PartialEq)]
enum Operation {
    Union,
    Subtract,
    Intersect,
}

impl Vertices {
    /// The outline around this polygon and `polygon2`, in whole numbers.
    ///
    /// The following holds for [`subtract`](Self::subtract) and [`intersect`](Self::intersect) as well. Both outlines
    /// must be simple and wound the same way, and so is the result. There is only one: other parts and holes are lost.
    /// Where an edge has several crossings they are taken in the wrong order, as in the original, so that the result
    /// may be wrong without an error; [`Vertices::sub_divide_edges`] makes that rare.
    ///
    /// # Errors
    /// See [`PolyUnionError`].
    ///
    /// ```
    /// use farseer_core::shape::Vertices;
    /// use farseer_core::math::Vector2;
    /// let square = Vertices::create_simple_rectangle(10.0, 10.0)?;
    /// let mut moved = square.clone();
    /// moved.translate(Vector2::new(5.0, 5.0));
    /// assert_eq!(square.union(&moved)?.get_area(), 175.0);
    /// assert_eq!(square.subtract(&moved)?.get_area(), 75.0);
    /// assert_eq!(square.intersect(&moved)?.get_area(), 25.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[doc(alias = "Union")]
    pub fn union(&self, polygon2: &Vertices) -> Result<Vertices, PolyUnionError> {
        let overlay = Overlay::new(self, polygon2)?;
        if overlay.hits.is_empty() {
            return Err(PolyUnionError::NoIntersections);
        }
        match overlay.start {
            None => Err(PolyUnionError::Poly1InsidePoly2 { outline: polygon2.clone() }),
            Some(start) => overlay.walk(start, Operation::Union),
        }
    }

    /// The outline of this polygon without `polygon2`, in whole numbers; see [`union`](Self::union).
    ///
    /// # Errors
    /// See [`PolyUnionError`].
    #[doc(alias = "Subtract")]
    pub fn subtract(&self, polygon2: &Vertices) -> Result<Vertices, PolyUnionError> {
        let overlay = Overlay::new(self, polygon2)?;
        if overlay.hits.is_empty() {
            return Err(PolyUnionError::NoIntersections);
        }
        match overlay.start {
            None => Err(PolyUnionError::Poly1InsidePoly2 { outline: Vertices::new() }),
            Some(start) => overlay.walk(start, Operation::Subtract),
        }
    }

    /// The outline of the intersection of this polygon and `polygon2`, in whole numbers; see [`union`](Self::union).
    ///
    /// As in the original, outlines that do not cross are no error: the result is empty (null in the original), even if
    /// one is inside of the other. Where the others return [`Poly1InsidePoly2`](PolyUnionError::Poly1InsidePoly2) the
    /// result is a copy of `polygon2`, not rounded.
    ///
    /// # Errors
    /// [`PolyUnionError::InfiniteLoop`], and when a vertex is not finite.
    #[doc(alias = "Intersect")]
    pub fn intersect(&self, polygon2: &Vertices) -> Result<Vertices, PolyUnionError> {
        let overlay = Overlay::new(self, polygon2)?;
        let Some(first_hit) = overlay.hits.first() else {
            return Ok(Vertices::new());
        };
        match (overlay.start, index_of_vertex(first_hit.intersection_point, &overlay.polygon1)) {
            (Some(_), Some(start)) => overlay.walk(start, Operation::Intersect),
            _ => Ok(polygon2.clone()),
        }
    }
}

/// Two rounded outlines, both with the points where they cross as vertices.
struct Overlay {
    polygon1: Vertices,
    polygon2: Vertices,
    hits: Vec<EdgeIntersectInfo>,
    /// The first vertex of the first outline that is not inside of the second.
    start: Option<usize>,
}

impl Overlay {
    fn new(polygon1: &Vertices, polygon2: &Vertices) -> Result<Overlay, Error> {
        finite_vertices("self", polygon1)?;
        finite_vertices("polygon2", polygon2)?;
        let (mut polygon1, mut polygon2) = (polygon1.round(), polygon2.round());
        let hits = crossings(&polygon1, &polygon2);
        for hit in &hits {
            insert_after(&mut polygon1, hit.edge_one.edge_start, hit.intersection_point);
            insert_after(&mut polygon2, hit.edge_two.edge_start, hit.intersection_point);
        }
        let start = polygon1.iter().position(|&point| !is_inside(point, &polygon2));
        Ok(Overlay { polygon1, polygon2, hits, start })
    }

    /// Walks along the first outline from `start` on, and over to the other one and back at crossings, until the start
    /// is reached again.
    fn walk(&self, start: usize, operation: Operation) -> Result<Vertices, PolyUnionError> {
        let (mut current, mut other) = (&self.polygon1, &self.polygon2);
        let max_vertices = current.len() + other.len();
        let mut i = start;
        let first = current[start];
        let mut outline = Vertices::new();
        let mut forward = true;
        loop {
            outline.push(current[i]);
            if let Some(place) = self.switch(current[i], current, other, operation, forward) {
                (current, other) = (other, current);
                i = place;
                // A difference is bounded by its second outline backwards.
                forward ^= operation == Operation::Subtract;
            }
            i = if forward { current.next_index(i) } else { current.previous_index(i) };
            if outline.len() > max_vertices {
                return Err(PolyUnionError::InfiniteLoop { outline });
            }
            if current[i] == first {
                return Ok(outline);
            }
        }
    }

    /// Index at which to continue in the other outline, if the walk changes over at this point.
    fn switch(
        &self,
        point: Vector2,
        current: &Vertices,
        other: &Vertices,
        operation: Operation,
        forward: bool,
    ) -> Option<usize> {
        let crossing = self.hits.iter().any(|hit| hit.intersection_point == point);
        // Several hits at one point all lead to the same index.
        let place = crossing.then(|| index_of_vertex(point, other)).flatten()?;
        let ahead_is_inside = |i: usize| is_inside(other[i], current);
        let switches = match operation {
            Operation::Union => !ahead_is_inside(other.next_index(place)),
            Operation::Intersect => ahead_is_inside(other.next_index(place)),
            Operation::Subtract if forward => ahead_is_inside(other.previous_index(place)),
            Operation::Subtract => !ahead_is_inside(other.next_index(place)),
        };
        switches.then_some(place)
    }
}

fn index_of_vertex(point: Vector2, outline: &Vertices) -> Option<usize> {
    outline.iter().position(|&vertex| vertex == point)
}

/// All crossings of two outlines, rounded, ordered by the edges of the first.
fn crossings(polygon1: &Vertices, polygon2: &Vertices) -> Vec<EdgeIntersectInfo> {
    let mut hits = Vec::new();
    let edge = |outline: &Vertices, i: usize| Edge::new(outline[i], outline[outline.next_index(i)]);
    for i in 0..polygon1.len() {
        let one = edge(polygon1, i);
        for j in 0..polygon2.len() {
            let two = edge(polygon2, j);
            let crossing =
                ray_helper::line_intersect(one.edge_start, one.edge_end, two.edge_start, two.edge_end);
            if let Some(point) = crossing {
                let point = Vector2::new(point.x.round_ties_even(), point.y.round_ties_even());
                hits.push(EdgeIntersectInfo::new(one, two, point));
            }
        }
    }
    hits
}

/// Inserts a point that is not in an outline after the start of its edge: before the points inserted there earlier,
/// wherever on the edge they are.
fn insert_after(outline: &mut Vertices, edge_start: Vector2, point: Vector2) {
    if index_of_vertex(point, outline).is_none()
        && let Some(place) = index_of_vertex(edge_start, outline)
    {
        outline.insert(place + 1, point);
    }
}

/// Whether an outline encloses a point, by the sum of the angles of its edges. For points on the outline the result
/// depends on rounding.
fn is_inside(point: Vector2, outline: &Vertices) -> bool {
    let angle = |v: Vector2| libm::atan2(f64::from(v.y), f64::from(v.x));
    let mut total = 0.0;
    for (i, &vertex) in outline.iter().enumerate() {
        let next = outline[outline.next_index(i)];
        let mut turn = angle(next - point) - angle(vertex - point);
        while turn > PI {
            turn -= 2.0 * PI;
        }
        while turn < -PI {
            turn += 2.0 * PI;
        }
        total += turn;
    }
    total.abs() >= PI
}
