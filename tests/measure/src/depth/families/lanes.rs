//! Lanes: strips of the ground side by side, each with one object that makes the motion of the family. Objects of different
//! lanes never meet.

use crate::scenes::depth::{DepthObject, DepthPlatform, DepthScene, Surface};
use crate::watch::{Observation, Watch, watch};
use crate::world::{BodyState, World};

/// `LANE`: distance from one lane to the next along X, px. `STEEP`: shift of a lane towards negative Z per px of shift along X,
/// dimensionless. An object that leaves its lane along X, along Z or along both equally meets no object of another lane.
const LANE: f32 = 300.3;
const STEEP: f32 = 2.3;
/// Radius of the balls in px.
pub(super) const RADIUS: f32 = 10.0;
/// Extent of the boxes along X, Y and Z in px.
pub(super) const BOX: [f32; 3] = [40.0, 20.0, 20.0];
/// A surface without friction and restitution.
pub(super) const ICE: Surface = Surface { friction: 0.0, restitution: 0.0 };
/// Greatest distance in px of a resting object from the surface below it. It is twice the slop of the solver, and more than
/// `rapier3d` lets a body sink.
pub(super) const REST: f64 = 0.15;
/// Deviation from a straight path by rounding that is no failure: px for a position, px/s for a velocity.
pub(super) const STRAIGHT: f64 = 0.1;

/// Returns the position in px, in the world, of the point `[x, y, z]` px from the middle of a lane.
pub(super) fn at(lane: usize, [x, y, z]: [f32; 3]) -> [f32; 3] {
    let along = LANE * (lane as f32 - 3.5);
    [along + x, y, z - STEEP * along]
}

/// Returns a ball or a box in a lane. `place` is the origin's X and Z and the lowest point's Y, px from the middle of the lane.
pub(super) fn object(is_ball: bool, lane: usize, place: [f32; 3]) -> DepthObject {
    let place = at(lane, place);
    if is_ball { DepthObject::ball(RADIUS, place) } else { DepthObject::new_box(BOX, place) }
}

/// Returns a level platform without friction in a lane. `place` is the middle's X and Z and the underside's Y, px from the
/// middle of the lane; `size` is the extent along X, Y and Z in px.
pub(super) fn platform(size: [f32; 3], lane: usize, place: [f32; 3]) -> DepthPlatform {
    DepthPlatform::new(size, at(lane, place), ICE)
}

/// Returns a scene without objects, whose ground has no friction and no restitution.
pub(super) fn scene(name: &str) -> DepthScene {
    // The family sets the duration of the run.
    DepthScene::empty(name, 0, ICE)
}

/// Returns the position of an object in px along X, Y and Z, relative to the middle of its lane.
pub(super) fn in_lane(state: &BodyState, lane: usize) -> [f64; 3] {
    let middle = at(lane, [0.0; 3]).map(f64::from);
    std::array::from_fn(|axis| state.position[axis] - middle[axis])
}

/// Returns a watch of the first `count` objects: object i is in lane i. `look` judges one object by the time in s, its lane,
/// its position in the lane in px and its state; the worst observation counts. Objects after the first `count` are not watched.
pub(super) fn each(
    count: usize,
    look: impl Fn(f64, usize, [f64; 3], BodyState) -> Observation + 'static,
) -> Box<dyn Watch> {
    watch(move |time, world: &dyn World| {
        let seen = (0..count).map(|lane| {
            let state = world.body(lane);
            look(time, lane, in_lane(&state, lane), state)
        });
        seen.reduce(Observation::and)
    })
}

/// Returns the largest of the absolute values, in the unit of `values`.
pub(super) fn largest<const N: usize>(values: [f64; N]) -> f64 {
    values.into_iter().map(f64::abs).fold(0.0, f64::max)
}
