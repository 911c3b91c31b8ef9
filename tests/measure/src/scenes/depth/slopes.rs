//! Scenes of objects on a slope that falls 5 px per 12 px to the right (22.6 degrees).

use super::{DepthObject, DepthPlatform, DepthScene, Surface};

/// Angle of the slope in radians: atan(5 / 12), positive where the surface falls to the right.
pub const SLOPE_ROTATION: f32 = 0.394_791_12;
/// Sine and cosine of the angle of the slope, dimensionless.
pub const SLOPE_SINE_AND_COSINE: [f32; 2] = [5.0 / 13.0, 12.0 / 13.0];

/// Middle of the slope's upper face: X and Y in px.
const MIDDLE: [f32; 2] = [5.0 / 13.0 * 10.0, 110.0 + 12.0 / 13.0 * 10.0];
/// Start of the objects in px along the slope, from the middle of the upper face; negative is uphill.
const START: f32 = -90.0;

/// A scene in which a box slides down a slope with a friction coefficient of 0.1 and off the lower end.
pub fn box_sliding_down_slope() -> DepthScene {
    let surface = Surface { friction: 0.1, restitution: 0.0 };
    let [sine, cosine] = SLOPE_SINE_AND_COSINE;
    let size = [40.0, 20.0, 30.0];
    let centre = above_slope(START, size[1] / 2.0);
    let below = size[0] / 2.0 * sine + size[1] / 2.0 * cosine;
    let crate_box = DepthObject::new_box(size, [centre[0], centre[1] - below, 10.0]);
    DepthScene::empty("box_sliding_down_slope", 900, Surface { friction: 0.7, ..surface })
        .with(crate_box.with_rotation(SLOPE_ROTATION).with_surface(surface))
        .with_platform(slope(surface))
}

/// A scene in which a ball rolls down a slope and off the lower end. At the start the ball slides along Z at `drift` px/s.
pub fn ball_rolling_down_slope(name: &str, drift: f32) -> DepthScene {
    let surface = Surface { friction: 0.6, restitution: 0.0 };
    let centre = above_slope(START, 15.0);
    let ball = DepthObject::ball(15.0, [centre[0], centre[1] - 15.0, -20.0]).with_velocity([0.0, 0.0, drift]);
    DepthScene::empty(name, 520, surface).with(ball.with_surface(surface)).with_platform(slope(surface))
}

fn slope(surface: Surface) -> DepthPlatform {
    let level = DepthPlatform::new([240.0, 20.0, 120.0], [0.0, 100.0, 0.0], surface);
    DepthPlatform { rotation: SLOPE_ROTATION, ..level }
}

/// Returns X and Y in px of the point that is `along` px down the slope from the middle of its upper face and `over` px
/// from the face, along the normal.
fn above_slope(along: f32, over: f32) -> [f32; 2] {
    let [sine, cosine] = SLOPE_SINE_AND_COSINE;
    [MIDDLE[0] + along * cosine + over * sine, MIDDLE[1] - along * sine + over * cosine]
}
