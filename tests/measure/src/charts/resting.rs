//! Computes the height that a stack of boxes of different heights has without overlaps.

use super::build::start;
use conformance::scene::{BodyShape, Scene};

/// A box as it was built. Heights are above y = 0; all lengths are px.
#[derive(Debug, Clone, Copy)]
struct Placed {
    left: f64,
    right: f64,
    lower: f64,
    upper: f64,
    /// Height in px of the box's upper side, if no boxes overlapped.
    top: f64,
}

impl Placed {
    fn supports(&self, other: &Placed) -> bool {
        // Distance in px: more than the overlap that boxes are built with, and less than the height of any box.
        const NEAR: f64 = 1.0;
        let is_beside = self.right <= other.left || other.right <= self.left;
        !is_beside && (self.upper - other.lower).abs() < NEAR
    }
}

/// Returns the height in px, above 0, of the centre of the box that was built highest, if no boxes overlapped. The lowest box
/// is the ground. A box on several boxes stands on the mean height of their upper sides: these differ by at most a hundredth of
/// a box. NaN if a box was built on no other box.
pub(super) fn height_of_boxes(scene: &Scene) -> f64 {
    let mut boxes: Vec<Placed> = (0..scene.bodies.len()).filter_map(|index| as_built(scene, index)).collect();
    boxes.sort_by(|one, other| one.lower.total_cmp(&other.lower));
    for index in 1..boxes.len() {
        let (below, above) = boxes.split_at_mut(index);
        let tops: Vec<f64> = below.iter().filter(|one| one.supports(&above[0])).map(|one| one.top).collect();
        above[0].top = tops.iter().sum::<f64>() / tops.len() as f64 + above[0].upper - above[0].lower;
    }
    boxes.last().map_or(f64::NAN, |last| last.top - (last.upper - last.lower) / 2.0)
}

fn as_built(scene: &Scene, index: usize) -> Option<Placed> {
    let BodyShape::Rectangle { width, height, .. } = scene.bodies[index].shape else { return None };
    let ([x, y], [width, height]) = (start(scene, index), [width, height].map(f64::from));
    let (lower, upper) = (-y - height / 2.0, -y + height / 2.0);
    Some(Placed { left: x - width / 2.0, right: x + width / 2.0, lower, upper, top: upper })
}

#[cfg(test)]
mod tests {
    use super::super::build::stage;
    use super::*;

    /// Returns a scene of rectangles, each given by width, height and centre in px.
    fn standing(rectangles: &[(f64, f64, [f64; 2])]) -> Scene {
        let mut stage = stage("standing");
        for &(width, height, place) in rectangles {
            stage.boxed(place, [width, height], 1.0);
        }
        stage.done()
    }

    /// The ground: width, height and centre in px. Its upper side is at y = 0.
    const GROUND: (f64, f64, [f64; 2]) = (200.0, 40.0, [0.0, 20.0]);

    #[test]
    fn the_height_of_stacked_boxes_is_the_sum_of_their_heights() {
        let boxes = [(32.0, 32.0, [0.0, -15.9]), (30.0, 20.0, [1.0, -41.8]), (31.0, 10.0, [-1.0, -56.7])];
        let height = height_of_boxes(&standing(&[GROUND, boxes[0], boxes[1], boxes[2]]));
        assert!((height - 57.0).abs() < 1e-5, "{height}");
    }

    #[test]
    fn a_box_on_two_that_differ_stands_on_their_mean() {
        let pair = [(20.0, 20.0, [-11.0, -10.0]), (20.0, 20.5, [11.0, -10.25])];
        let height = height_of_boxes(&standing(&[GROUND, pair[0], pair[1], (20.0, 20.0, [0.0, -30.2])]));
        assert!((height - 30.25).abs() < 1e-5, "{height}");
    }

    #[test]
    fn a_box_without_support_has_no_height() {
        assert!(height_of_boxes(&standing(&[GROUND, (20.0, 20.0, [0.0, -50.0])])).is_nan());
    }
}
