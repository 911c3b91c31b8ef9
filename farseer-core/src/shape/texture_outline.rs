//! The walk around the solid pixels of a texture (behaviour chapter 15, section 15.6.3).

use super::PolygonCreationAssistance;
use crate::error::{Error, Result};
use crate::math::Vector2;
use crate::math::calculator::distance_between_point_and_line_segment;

/// A pixel: column and row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Pixel {
    pub(super) x: i32,
    pub(super) y: i32,
}

impl Pixel {
    pub(super) fn point(self) -> Vector2 {
        Vector2::new(self.x as f32, self.y as f32)
    }

    fn neighbour(self, direction: usize) -> Pixel {
        let (x, y) = NEIGHBOURS[direction % 8];
        Pixel { x: self.x + x, y: self.y + y }
    }
}

const NEIGHBOURS: [(i32, i32); 8] = [(-1, -1), (0, -1), (1, -1), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0)];

/// Stands for an entrance that is not given.
pub(super) const NOWHERE: Pixel = Pixel { x: 0, y: 0 };

/// The outline of the part around an entrance, thinned to the hull tolerance. `last` is the pixel from which
/// the entrance is entered. The end may repeat the start. What is not solid has no outline; without an
/// entrance it is that of the first solid pixel.
pub(super) fn trace(
    image: &PolygonCreationAssistance<'_>,
    entrance: Pixel,
    last: Pixel,
) -> Result<Vec<Vector2>> {
    let mut outline = Vec::new();
    let Some((entrance, mut current)) = enter(image, entrance, last) else {
        return Ok(outline);
    };
    let mut next = entrance;
    let mut window = vec![entrance.point()];
    let mut closing: Option<Vec<Vector2>> = None;
    let mut laps = Laps::new();
    outline.push(entrance.point());
    loop {
        if let Some(outstanding) = outstanding(image, &window) {
            let point = window[outstanding];
            if let Some(closing) = closing {
                if closing.contains(&point) {
                    outline.push(point);
                }
                return Ok(outline);
            }
            outline.push(point);
            window.drain(..outstanding);
        }
        let previous = current;
        current = next;
        match next_solid(image, previous, current) {
            Some(pixel) => next = pixel,
            None => return Ok(outline),
        }
        window.push(next.point());
        if next == entrance && closing.is_none() {
            closing = Some(window.clone());
            laps = Laps::new();
        }
        // Without a way back to the entrance the first lap would be repeated for ever. With one, the second
        // lap has compared every point with all others, and there was none to end with.
        if laps.count(current, next) > u32::from(closing.is_some()) {
            return Err(Error::EndlessOutline { x: entrance.x, y: entrance.y });
        }
    }
}

/// The first pixel of an outline and the one from which it is entered.
fn enter(image: &PolygonCreationAssistance<'_>, entrance: Pixel, last: Pixel) -> Option<(Pixel, Pixel)> {
    if entrance == NOWHERE || !image.in_bounds(entrance.point()) {
        let index = (0..image.data().len() as i32).find(|&i| image.is_solid_index(i))?;
        let first = Pixel { x: index % image.width(), y: index / image.width() };
        return Some((first, Pixel { x: first.x - 1, y: first.y }));
    }
    if !image.is_solid(entrance.x, entrance.y) {
        return None;
    }
    let mut neighbours = (0..8).map(|direction| entrance.neighbour(direction));
    let in_reach = (0..=image.width()).contains(&last.x) && (0..=image.height()).contains(&last.y);
    if in_reach && neighbours.clone().any(|pixel| pixel == last) {
        return Some((entrance, last));
    }
    neighbours.find(|pixel| !image.is_solid(pixel.x, pixel.y)).map(|empty| (entrance, empty))
}

/// The solid neighbour of `current` with which an outline that came from `last` goes on.
fn next_solid(image: &PolygonCreationAssistance<'_>, last: Pixel, current: Pixel) -> Option<Pixel> {
    let first = match (current.x - last.x, current.y - last.y) {
        (1, 1) => 1,
        (1, -1) => 7,
        (0, 1) => 2,
        (0, -1) => 6,
        (-1, 1) => 3,
        (-1, 0) => 4,
        (-1, -1) => 5,
        _ => 0,
    };
    (first..first + 8)
        .map(|direction| current.neighbour(direction))
        .find(|pixel| image.is_solid(pixel.x, pixel.y))
}

/// The place of the first point that is too far from the line between the ends of a window.
fn outstanding(image: &PolygonCreationAssistance<'_>, window: &[Vector2]) -> Option<usize> {
    let [first, between @ .., last] = window else {
        return None;
    };
    let far = |&point: &Vector2| {
        distance_between_point_and_line_segment(point, *first, *last) >= image.hull_tolerance()
    };
    between.iter().position(far).map(|i| i + 1)
}

/// Notices when a walk whose next step depends on the last one only has come to where it was before: a mark is
/// left behind after 1, 3, 7, ... steps.
struct Laps {
    mark: Option<(Pixel, Pixel)>,
    steps: u64,
    limit: u64,
    laps: u32,
}

impl Laps {
    fn new() -> Self {
        Laps { mark: None, steps: 0, limit: 1, laps: 0 }
    }

    /// How often the walk has come back to the mark, this step included.
    fn count(&mut self, current: Pixel, next: Pixel) -> u32 {
        let step = (current, next);
        if self.mark == Some(step) {
            self.laps += 1;
        } else if self.laps == 0 {
            self.steps += 1;
            if self.steps == self.limit {
                *self = Laps { mark: Some(step), steps: 0, limit: self.limit * 2, laps: 0 };
            }
        }
        self.laps
    }
}
