//! How high boxes of different heights stand on each other when nothing gives way.

use super::build::start;
use conformance::scene::{BodyShape, Scene};

/// A box as it was built; heights are above 0, lengths in px.
#[derive(Debug, Clone, Copy)]
struct Placed {
    left: f64,
    right: f64,
    lower: f64,
    upper: f64,
    /// Height of the upper side where nothing gives way.
    top: f64,
}

impl Placed {
    fn carries(&self, other: &Placed) -> bool {
        // More than what boxes are pressed into each other, and less than any box is high.
        const NEAR: f64 = 1.0;
        let is_beside = self.right <= other.left || other.right <= self.left;
        !is_beside && (self.upper - other.lower).abs() < NEAR
    }
}

/// Height in px above 0 of the centre of the box that was built highest, if none overlapped. The lowest is the ground.
/// A box on several that differ stands on their mean height: the weight on it presses it level, and differences of a
/// hundredth of its height make as little of a difference. NaN when it was built on nothing.
pub(super) fn height_of_boxes(scene: &Scene) -> f64 {
    let mut boxes: Vec<Placed> = (0..scene.bodies.len()).filter_map(|index| as_built(scene, index)).collect();
    boxes.sort_by(|one, other| one.lower.total_cmp(&other.lower));
    for index in 1..boxes.len() {
        let (below, above) = boxes.split_at_mut(index);
        let tops: Vec<f64> = below.iter().filter(|one| one.carries(&above[0])).map(|one| one.top).collect();
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

    /// A scene of rectangles, given by width, height and centre.
    fn standing(rectangles: &[(f64, f64, [f64; 2])]) -> Scene {
        let mut stage = stage("standing");
        for &(width, height, place) in rectangles {
            stage.boxed(place, [width, height], 1.0);
        }
        stage.done()
    }

    /// Its upper side is at 0.
    const GROUND: (f64, f64, [f64; 2]) = (200.0, 40.0, [0.0, 20.0]);

    #[test]
    fn boxes_on_each_other_stand_as_high_as_they_are_tall_together() {
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
    fn a_box_on_nothing_has_no_height() {
        assert!(height_of_boxes(&standing(&[GROUND, (20.0, 20.0, [0.0, -50.0])])).is_nan());
    }
}
