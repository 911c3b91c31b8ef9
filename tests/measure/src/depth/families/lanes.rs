//! Objects that do the same side by side, each in a lane of its own.

use crate::scenes::depth::{DepthObject, DepthPlatform, DepthScene, Surface};
use crate::watch::{Seen, Watch, watch};
use crate::world::{BodyState, World};

/// From one lane to the next along X, px, and how much farther it is against Z. So nothing that leaves its lane along an
/// axis, or along X and Z alike, comes to another lane at the time at which somebody else does.
const LANE: f32 = 300.3;
const STEEP: f32 = 2.3;
/// Radius of the balls in px.
pub(super) const RADIUS: f32 = 10.0;
/// Extent of the boxes along X, Y and Z in px.
pub(super) const BOX: [f32; 3] = [40.0, 20.0, 20.0];
/// Neither rubs nor bounces.
pub(super) const ICE: Surface = Surface { friction: 0.0, restitution: 0.0 };
/// How far from its surface something that rests may be, px: twice what the solver leaves alone, and more than `rapier3d`
/// lets it sink.
pub(super) const REST: f64 = 0.15;
/// Push-off from a straight path by rounding, px and px/s.
pub(super) const STRAIGHT: f64 = 0.1;

/// A place of a lane, given from the middle of the lane.
pub(super) fn at(lane: usize, [x, y, z]: [f32; 3]) -> [f32; 3] {
    let along = LANE * (lane as f32 - 3.5);
    [along + x, y, z - STEEP * along]
}

/// A ball or a box whose lowest point is at a place of a lane.
pub(super) fn object(is_ball: bool, lane: usize, place: [f32; 3]) -> DepthObject {
    let place = at(lane, place);
    if is_ball { DepthObject::ball(RADIUS, place) } else { DepthObject::new_box(BOX, place) }
}

/// A level platform at a place of a lane: X and Z of its middle, Y of its underside.
pub(super) fn platform(size: [f32; 3], lane: usize, place: [f32; 3]) -> DepthPlatform {
    DepthPlatform::new(size, at(lane, place), ICE)
}

/// An empty scene on ice.
pub(super) fn scene(name: &str) -> DepthScene {
    // How long it is run is said by the family.
    DepthScene::empty(name, 0, ICE)
}

/// Position of an object from the middle of its lane.
pub(super) fn in_lane(state: &BodyState, lane: usize) -> [f64; 3] {
    let middle = at(lane, [0.0; 3]).map(f64::from);
    std::array::from_fn(|axis| state.position[axis] - middle[axis])
}

/// Watches objects that have a lane each, by their index: the worst of what is seen of them. They may be followed by
/// others that are not watched.
pub(super) fn each(
    count: usize,
    look: impl Fn(f64, usize, [f64; 3], BodyState) -> Seen + 'static,
) -> Box<dyn Watch> {
    watch(move |time, world: &dyn World| {
        let seen = (0..count).map(|lane| {
            let state = world.body(lane);
            look(time, lane, in_lane(&state, lane), state)
        });
        seen.reduce(Seen::and)
    })
}

/// The largest of the absolute values.
pub(super) fn largest<const N: usize>(values: [f64; N]) -> f64 {
    values.into_iter().map(f64::abs).fold(0.0, f64::max)
}
