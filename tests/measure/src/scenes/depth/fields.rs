//! Fields full of objects whose ways are known: they fly, stand, or walk past each other.

use super::{DepthObject, DepthScene, Surface};
use conformance::scenes::vary;

/// A figure: width, height and depth, px.
const FIGURE: [f32; 3] = [20.0, 40.0, 16.0];
/// Room for one that flies: none leaves it.
const ROOM_TO_FLY: f32 = 80.0;
/// From one figure to the next along a lane, and from one lane to the next, px: who passes is 4 px in front or behind.
const STRIDE: f32 = 60.0;
const LANE: f32 = 20.0;
/// Of those that walk, px/s.
const PACE: f32 = 60.0;
/// Figures of a lane in a deep field.
const FEW: usize = 10;

/// Balls and boxes fly up and fall, each in a room of its own.
pub fn flying(count: usize) -> DepthScene {
    let mut scene = DepthScene::empty(format!("flying_{count}"), 240, Surface::default());
    let side = side_of(count);
    for index in 0..count {
        let place = [ROOM_TO_FLY * (index % side) as f32, 60.0, ROOM_TO_FLY * (index / side) as f32];
        let object = match index % 2 {
            0 => DepthObject::ball(10.0, place),
            _ => DepthObject::new_box([20.0; 3], place),
        };
        let velocity = [8.0 * vary(index, 1), 150.0 + 40.0 * vary(index, 2), 8.0 * vary(index, 3)];
        scene.objects.push(object.with_velocity(velocity));
    }
    scene
}

/// Figures stand on the ground, as many along X as along Z.
pub fn standing(count: usize) -> DepthScene {
    let rough = Surface { friction: 0.5, restitution: 0.0 };
    let mut scene = lanes(format!("standing_{count}"), count, side_of(count), |_| 0.0);
    scene.ground = rough;
    scene.objects.iter_mut().for_each(|figure| figure.surface = rough);
    scene
}

/// Lanes of figures in a field as wide as it is deep: in every third they stand, in the others they glide to the left or to
/// the right, past those in front and behind.
pub fn street(count: usize) -> DepthScene {
    lanes(format!("street_{count}"), count, side_of(count), pace)
}

/// The same in a field that is ten figures wide.
pub fn deep_field(count: usize) -> DepthScene {
    lanes(format!("deep_field_{count}"), count, FEW, pace)
}

/// So many that there are about as many lanes.
fn side_of(count: usize) -> usize {
    (count as f32).sqrt().ceil().max(1.0) as usize
}

fn pace(lane: usize) -> f32 {
    [PACE, 0.0, -PACE][lane % 3]
}

fn lanes(name: String, count: usize, along: usize, speed: impl Fn(usize) -> f32) -> DepthScene {
    let mut scene = DepthScene::empty(name, 240, Surface::default());
    for index in 0..count {
        let (lane, place) = (index / along, index % along);
        // Not all edges of a column at one place.
        let x = STRIDE * place as f32 + 7.3 * (lane % 8) as f32;
        let figure = DepthObject::new_box(FIGURE, [x, 0.0, LANE * lane as f32]);
        scene.objects.push(figure.with_velocity([speed(lane), 0.0, 0.0]));
    }
    scene
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_deep_field_is_ten_wide() {
        let scene = deep_field(200);
        let ends = scene.objects.iter().map(|figure| figure.position);
        let [mut wide, mut deep] = [0.0_f32; 2];
        ends.for_each(|[x, _, z]| (wide, deep) = (wide.max(x), deep.max(z)));
        assert!(wide < 600.0 && deep == 380.0, "{wide} x {deep}");
    }

    #[test]
    fn fields_have_as_many_objects_as_they_are_asked_for() {
        for build in [flying, standing, street, deep_field] {
            assert_eq!(build(40).objects.len(), 40);
        }
    }
}
