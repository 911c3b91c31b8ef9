//! Tracing of the outline of solid pixels in a texture (behaviour chapter 15, section 15.6.3).

use super::PolygonCreationAssistance;
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

/// Marks an entrance that is not given.
pub(super) const NO_PIXEL: Pixel = Pixel { x: 0, y: 0 };

/// Traces the outline of the part around an entrance, thinned to the hull tolerance. `last` is the pixel from which the
/// entrance is entered. The trace ends when it is back at the entrance. If the entrance is not solid there is no
/// outline; without an entrance the trace starts at the first solid pixel.
///
/// Every trace ends. It proceeds from a pair of neighbouring pixels to the next pair. The next pixel is the first solid
/// one clockwise after the last one ([`next_solid`]), so that the last one is the first solid one counterclockwise
/// before the next: no two pairs have the same successor. So the pairs after the first, which has left the entrance,
/// form a ring, and the pair before the first in it returns to the entrance.
pub(super) fn trace(image: &PolygonCreationAssistance<'_>, entrance: Pixel, last: Pixel) -> Vec<Vector2> {
    let mut outline = Vec::new();
    let Some((entrance, mut current)) = enter(image, entrance, last) else {
        return outline;
    };
    outline.push(entrance.point());
    let mut next = entrance;
    let mut window = Vec::new();
    loop {
        window.push(next.point());
        if let Some(outstanding) = first_outlier(image, &window) {
            outline.push(window[outstanding]);
            window.drain(..outstanding);
        }
        match next_solid(image, current, next) {
            Some(pixel) if pixel != entrance => (current, next) = (next, pixel),
            _ => return outline,
        }
    }
}

/// The first pixel of an outline and the one from which it is entered.
fn enter(image: &PolygonCreationAssistance<'_>, entrance: Pixel, last: Pixel) -> Option<(Pixel, Pixel)> {
    if entrance == NO_PIXEL || !image.in_bounds(entrance.point()) {
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

/// The solid neighbour of `current` with which an outline that came from `last` continues: the first clockwise after
/// `last`, or `last` itself if there is no other.
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

/// Index of the first point that is too far from the line between the ends of a window.
fn first_outlier(image: &PolygonCreationAssistance<'_>, window: &[Vector2]) -> Option<usize> {
    let [first, between @ .., last] = window else {
        return None;
    };
    let far = |&point: &Vector2| {
        distance_between_point_and_line_segment(point, *first, *last) >= image.hull_tolerance()
    };
    between.iter().position(far).map(|i| i + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The property from which follows that every trace ends.
    #[test]
    fn no_two_pixel_pairs_have_the_same_successor() {
        let centre = Pixel { x: 1, y: 1 };
        for around in 0_u32..256 {
            let solid = |direction: &usize| around >> direction & 1 == 1;
            let mut alpha = [0; 9];
            alpha[4] = 255;
            for pixel in (0..8).filter(solid).map(|direction| centre.neighbour(direction)) {
                alpha[(pixel.x + 3 * pixel.y) as usize] = 255;
            }
            let image = PolygonCreationAssistance::from_alpha(&alpha, 3, 3).unwrap();
            let mut left: Vec<Pixel> = Vec::new();
            for last in (0..8).filter(solid).map(|direction| centre.neighbour(direction)) {
                let next = next_solid(&image, last, centre).unwrap();
                assert!(!left.contains(&next), "{around:08b}: {next:?}");
                left.push(next);
            }
        }
    }
}
