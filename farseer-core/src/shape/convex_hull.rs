//! Convex hull of a simple outline (behaviour chapter 05, section 1.8, and chapter 15, section 15.2).

use super::Vertices;
use crate::error::{Error, Result};
use crate::math::Vector2;
use crate::math::finite::finite_vertices;

impl Vertices {
    /// The convex hull of a simple (not self-crossing) outline, by Melkman's algorithm; a copy of the list if it has
    /// fewer than three vertices.
    ///
    /// The hull has positive shoelace area, opposite to engine winding, and may start at any vertex. If the outline
    /// starts with collinear vertices, only the last of these is kept, even if it is not the extreme one. Outlines that
    /// cross themselves may give a wrong hull.
    ///
    /// # Errors
    /// Vertices that are not finite; a vertex that cannot be placed, because the outline crosses itself or is
    /// degenerate. The original loops forever.
    #[doc(alias = "GetConvexHull")]
    pub fn get_convex_hull(&self) -> Result<Vertices> {
        finite_vertices("self", self)?;
        if self.len() < 3 {
            return Ok(self.clone());
        }
        let (mut hull, first) = Deque::start(self);
        for (i, &point) in self.iter().enumerate().skip(first) {
            hull.add(point).ok_or_else(|| {
                let value = format_args!("an outline whose vertex {i} has no place in the hull");
                Error::invalid("self", value, "a simple outline of finite vertices")
            })?;
        }
        Ok(hull.into_vertices())
    }
}

/// Positive if `c` lies on the positive side of the line from `a` to `b`.
fn orientation(a: Vector2, b: Vector2, c: Vector2) -> f32 {
    (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y)
}

/// The hull so far: a ring buffer, used from `back` to `front`. Both ends are the same vertex.
struct Deque {
    ring: Vec<Vector2>,
    front: usize,
    back: usize,
}

impl Deque {
    /// The hull of the first vertices of an outline of three or more, and the number of these vertices.
    fn start(outline: &[Vector2]) -> (Deque, usize) {
        let mut ring = vec![Vector2::new(0.0, 0.0); outline.len() + 1];
        let (p0, p1, p2) = (outline[0], outline[1], outline[2]);
        let turn = orientation(p0, p1, p2);
        if turn == 0.0 {
            (ring[0], ring[1], ring[2]) = (p0, p2, p0);
            let mut first = 3;
            while first < outline.len() && orientation(ring[0], ring[1], outline[first]) == 0.0 {
                ring[1] = outline[first];
                first += 1;
            }
            return (Deque { ring, front: 2, back: 0 }, first);
        }
        (ring[0], ring[3]) = (p2, p2);
        (ring[1], ring[2]) = if turn > 0.0 { (p0, p1) } else { (p1, p0) };
        (Deque { ring, front: 3, back: 0 }, 3)
    }

    fn after(&self, i: usize) -> usize {
        if i + 1 == self.ring.len() { 0 } else { i + 1 }
    }

    fn before(&self, i: usize) -> usize {
        if i == 0 { self.ring.len() - 1 } else { i - 1 }
    }

    fn inside_front(&self, p: Vector2) -> bool {
        orientation(self.ring[self.before(self.front)], self.ring[self.front], p) > 0.0
    }

    fn inside_back(&self, p: Vector2) -> bool {
        orientation(self.ring[self.back], self.ring[self.after(self.back)], p) > 0.0
    }

    /// Adds a vertex. `None` if a full turn of the ring finds no position for it.
    fn add(&mut self, p: Vector2) -> Option<()> {
        if self.inside_front(p) && self.inside_back(p) {
            return Some(());
        }
        let turn = self.ring.len();
        (0..turn).find(|_| {
            let found = self.inside_front(p);
            self.front = if found { self.after(self.front) } else { self.before(self.front) };
            found
        })?;
        self.ring[self.front] = p;
        (0..turn).find(|_| {
            let found = self.inside_back(p);
            self.back = if found { self.before(self.back) } else { self.after(self.back) };
            found
        })?;
        self.ring[self.back] = p;
        Some(())
    }

    /// The vertices from back to front, each once. If that range crosses the end of the ring buffer, the list starts in
    /// the middle of the hull.
    fn into_vertices(self) -> Vertices {
        let Deque { ring, front, back } = self;
        if back < front {
            Vertices::from(&ring[back..front])
        } else {
            ring[..front].iter().chain(&ring[back..]).copied().collect()
        }
    }
}
