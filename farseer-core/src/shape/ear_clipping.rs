//! Triangulation of an outline by ear clipping, for drawing (behaviour chapter 15, section 15.3.1). The decomposition
//! uses another triangulation.

use std::collections::VecDeque;

use super::{Vertices, WindingOrder};
use crate::error::{Error, Result};
use crate::math::finite::finite_vertices;
use crate::math::{Vector2, vector2};

/// Maximum number of vertices that 16-bit indices distinguish.
const MAX_INDEXED: usize = 1 << 16;

impl Vertices {
    /// Triangulates a simple outline by ear clipping. Returns the vertices, counter-clockwise as
    /// [`Vertices::determine_winding_order`] sees it and starting with the same one, and three indices into them per
    /// triangle, in the desired order. An index has the bits of the original's `short`.
    ///
    /// A simple outline of n vertices whose winding order is recognised has n - 2 triangles. An outline that crosses
    /// itself has fewer; one or two vertices have none. Vertices that coincide with a neighbour are never cut off.
    ///
    /// # Errors
    /// When the list is empty or has more than 65,536 vertices, or a vertex is not finite.
    ///
    /// ```
    /// use farseer_core::shape::{Vertices, WindingOrder};
    /// let square = Vertices::create_simple_rectangle(4.0, 4.0)?;
    /// let (vertices, indices) = square.triangulate(WindingOrder::CounterClockwise)?;
    /// assert_eq!((vertices.len(), indices), (4, vec![0, 1, 3, 1, 2, 3]));
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    #[doc(alias = "Triangulate")]
    pub fn triangulate(&self, desired_winding_order: WindingOrder) -> Result<(Vertices, Vec<u16>)> {
        indexable("self", self.len())?;
        finite_vertices("self", self)?;
        let vertices = self.ensure_winding_order(WindingOrder::CounterClockwise)?;
        let triangles = Ring::new(&vertices).clip();
        let indices = triangles.into_iter().flat_map(|[a, b, c]| match desired_winding_order {
            WindingOrder::CounterClockwise => [a, b, c],
            WindingOrder::Clockwise => [c, b, a],
        });
        let indices = indices.map(|i| i as u16).collect();
        Ok((vertices, indices))
    }
}

/// Refuses more vertices than 16-bit indices distinguish.
pub(super) fn indexable(argument: &'static str, count: usize) -> Result<()> {
    if count <= MAX_INDEXED {
        Ok(())
    } else {
        Err(Error::invalid(argument, format_args!("{count} vertices"), "at most 65536 vertices"))
    }
}

/// Whether a corner turns as a counter-clockwise outline does, or not at all. False for a corner that coincides with
/// its neighbour.
pub(super) fn is_convex(before: Vector2, here: Vector2, after: Vector2) -> bool {
    let incoming = vector2::normalize(here - before);
    let outgoing = vector2::normalize(after - here);
    vector2::dot(incoming, Vector2::new(-outgoing.y, outgoing.x)) <= 0.0
}

/// Whether a point that is not a corner lies in a triangle.
pub(super) fn is_inside([a, b, c]: [Vector2; 3], p: Vector2) -> bool {
    let hit = |s: Vector2, u: Vector2| {
        ((s.y < p.y && u.y >= p.y) || (u.y < p.y && s.y >= p.y))
            && s.x + (p.y - s.y) / (u.y - s.y) * (u.x - s.x) < p.x
    };
    hit(c, a) ^ hit(a, b) ^ hit(b, c)
}

/// The remaining outline: vertices are indices, which increase along the ring from its head on.
struct Ring<'a> {
    points: &'a [Vector2],
    before: Vec<usize>,
    after: Vec<usize>,
    head: usize,
    count: usize,
    /// The vertices that may lie in an ear.
    reflex: Vec<usize>,
    /// The ears in the order in which they are cut off.
    ears: VecDeque<usize>,
}

impl<'a> Ring<'a> {
    fn new(points: &'a [Vector2]) -> Self {
        let count = points.len();
        let mut ring = Ring {
            points,
            before: (0..count).map(|i| if i == 0 { count - 1 } else { i - 1 }).collect(),
            after: (0..count).map(|i| if i + 1 == count { 0 } else { i + 1 }).collect(),
            head: 0,
            count,
            reflex: Vec::new(),
            ears: VecDeque::new(),
        };
        let (convex, reflex): (Vec<usize>, Vec<usize>) = (0..count).partition(|&i| ring.is_convex(i));
        ring.reflex = reflex;
        ring.ears = convex.into_iter().filter(|&i| ring.is_ear(i)).collect();
        ring
    }

    fn corner(&self, i: usize) -> [Vector2; 3] {
        [self.before[i], i, self.after[i]].map(|i| self.points[i])
    }

    fn is_convex(&self, i: usize) -> bool {
        let [before, here, after] = self.corner(i);
        is_convex(before, here, after)
    }

    fn is_ear(&self, i: usize) -> bool {
        let corner = self.corner(i);
        let mut others = self.reflex.iter().filter(|&&r| r != i && r != self.before[i] && r != self.after[i]);
        !others.any(|&r| is_inside(corner, self.points[r]))
    }

    fn clip(mut self) -> Vec<[usize; 3]> {
        let mut triangles = Vec::new();
        while self.count > 3
            && let Some(ear) = self.ears.pop_front()
        {
            let (before, after) = (self.before[ear], self.after[ear]);
            triangles.push([ear, after, before]);
            (self.after[before], self.before[after]) = (after, before);
            if ear == self.head {
                self.head = after;
            }
            self.count -= 1;
            self.revalidate(before);
            self.revalidate(after);
        }
        if self.count == 3 {
            let second = self.after[self.head];
            triangles.push([self.head, second, self.after[second]]);
        }
        triangles
    }

    /// Updates the class of a vertex after one of its neighbours was removed. A convex vertex stays convex.
    fn revalidate(&mut self, i: usize) {
        if let Some(place) = self.reflex.iter().position(|&r| r == i) {
            if !self.is_convex(i) {
                return;
            }
            self.reflex.remove(place);
        }
        let place = self.ears.iter().position(|&ear| ear == i);
        match (place, self.is_ear(i)) {
            (Some(place), false) => {
                self.ears.remove(place);
            }
            (None, true) => self.ears.push_front(i),
            _ => (),
        }
    }
}
