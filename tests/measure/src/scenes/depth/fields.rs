//! Scenes with many objects whose paths are known: they fly, stand, or glide past each other.

use super::{DepthObject, DepthScene, Surface};
use conformance::scenes::vary;

/// Width, height and depth of a figure (a box), px.
const FIGURE: [f32; 3] = [20.0, 40.0, 16.0];
/// Edge in px of the cube in which one object flies. No object leaves its cube.
const ROOM_TO_FLY: f32 = 80.0;
/// `STRIDE`: distance in px from one figure to the next in a lane (a row along X). `LANE`: distance in px from one
/// lane to the next. Figures in neighbouring lanes pass each other 4 px apart.
const STRIDE: f32 = 60.0;
const LANE: f32 = 20.0;
/// Speed along X of the figures (upright bodies) that glide through the field, px/s.
const PACE: f32 = 60.0;
/// Number of figures in one lane (a row along X) of a deep field.
const FEW: usize = 10;

/// Returns a scene of balls and boxes that fly up and fall. Each stays within a cube of space of its own.
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

/// Returns a scene of figures that stand on the ground, with as many along X as along Z.
pub fn standing(count: usize) -> DepthScene {
    let rough = Surface { friction: 0.5, restitution: 0.0 };
    let mut scene = lanes(format!("standing_{count}"), count, side_of(count), |_| 0.0);
    scene.ground = rough;
    scene.objects.iter_mut().for_each(|figure| figure.surface = rough);
    scene
}

/// Returns a square field of figures in lanes (rows along X). In every third lane they stand; in the others they glide to
/// the left or to the right, past those in front and behind.
pub fn street(count: usize) -> DepthScene {
    lanes(format!("street_{count}"), count, side_of(count), pace)
}

/// Returns the lanes of [`street`] in a field that is ten figures wide.
pub fn deep_field(count: usize) -> DepthScene {
    lanes(format!("deep_field_{count}"), count, FEW, pace)
}

/// Returns the square root of `count`, rounded up: the number of objects in one lane of a square field.
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
        // A shift per lane, so that the edges of figures in neighbouring lanes do not coincide.
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
    fn fields_have_the_requested_number_of_objects() {
        for build in [flying, standing, street, deep_field] {
            assert_eq!(build(40).objects.len(), 40);
        }
    }
}
