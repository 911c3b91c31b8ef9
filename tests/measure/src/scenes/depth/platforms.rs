//! Things that leave platforms, bump into them, and stand on each other.

use super::{DepthObject, DepthPlatform, DepthScene, SCREEN_ANGLE, Surface};

/// Nothing rubs, nothing bounces.
const SLIPPERY: Surface = Surface { friction: 0.0, restitution: 0.0 };
/// A level platform with its upper face 60 px above the ground.
fn table(surface: Surface) -> DepthPlatform {
    DepthPlatform::new([200.0, 20.0, 120.0], [0.0, 40.0, 0.0], surface)
}

/// A ball that slides over ice leaves a platform by its far edge, askew.
pub fn ball_off_far_edge() -> DepthScene {
    let ball = DepthObject::ball(12.0, [-40.0, 60.0, 10.0]).with_velocity([30.0, 0.0, 60.0]);
    DepthScene::empty("ball_off_far_edge", 250, SLIPPERY).with(ball).with_platform(table(SLIPPERY))
}

/// A box that slides over ice leaves a platform by its near edge. It does not tip: it stands until no part of it is
/// over the platform.
pub fn box_off_near_edge() -> DepthScene {
    let crate_box = DepthObject::new_box([40.0, 30.0, 30.0], [20.0, 60.0, -10.0]);
    DepthScene::empty("box_off_near_edge", 300, SLIPPERY)
        .with(crate_box.with_velocity([0.0, 0.0, -60.0]))
        .with_platform(table(SLIPPERY))
}

/// A box is dropped with its middle beyond the right edge of a platform; it tips over it and falls.
pub fn box_tipping_over_edge() -> DepthScene {
    let surface = Surface { friction: 0.5, restitution: 0.0 };
    let crate_box = DepthObject::new_box([44.0, 30.0, 30.0], [106.0, 70.0, 5.0]);
    DepthScene::empty("box_tipping_over_edge", 500, surface)
        .with(crate_box.with_surface(surface))
        .with_platform(table(surface))
}

/// On ice, a box slides against the left side of a block, another against its front; a ball is thrown against the
/// underside of a table beside it.
pub fn against_every_side() -> DepthScene {
    let surface = Surface { friction: 0.0, restitution: 0.5 };
    let block = DepthPlatform::new([100.0, 80.0, 60.0], [0.0, 0.0, 0.0], surface);
    let against_side = DepthObject::new_box([30.0, 30.0, 30.0], [-120.0, 0.0, 10.0]);
    let against_front = DepthObject::new_box([30.0, 30.0, 30.0], [15.0, 0.0, -100.0]);
    let against_underside = DepthObject::ball(10.0, [300.0, 20.0, 0.0]);
    DepthScene::empty("against_every_side", 80, Surface { restitution: 1.0, ..SLIPPERY })
        .weightless()
        .with(against_side.with_surface(surface).with_velocity([90.0, 0.0, 0.0]))
        .with(against_front.with_surface(surface).with_velocity([0.0, 0.0, 90.0]))
        .with(against_underside.with_surface(surface).with_velocity([5.0, 90.0, 0.0]))
        .with_platform(block)
        .with_platform(DepthPlatform::new([100.0, 20.0, 60.0], [300.0, 70.0, 0.0], surface))
}

/// A ball and a box fly without weight against the left side of a block whose edges in depth run straight up the
/// screen, so that the side faces forward as well.
pub fn against_sheared_side() -> DepthScene {
    let surface = Surface { friction: 0.0, restitution: 0.5 };
    let block = |y| DepthPlatform {
        angle_in_z_axis: 90,
        ..DepthPlatform::new([100.0, 80.0, 80.0], [0.0, y, 0.0], surface)
    };
    let ball = DepthObject::ball(12.0, [-120.0, 30.0, 6.0]);
    let crate_box = DepthObject::new_box([30.0, 30.0, 24.0], [-120.0, 230.0, 6.0]);
    DepthScene::empty("against_sheared_side", 150, SLIPPERY)
        .weightless()
        .with(ball.with_surface(surface).with_velocity([90.0, 0.0, 0.0]))
        .with(crate_box.with_surface(surface).with_velocity([90.0, 0.0, 0.0]))
        .with_platform(block(0.0))
        .with_platform(block(200.0))
}

/// Along X, how far a point of the block of [`against_sheared_side`] is shifted per px of depth: the difference of
/// the cotangents of 90 degrees and of the screen's angle.
pub fn shear_of_side() -> f64 {
    -1.0 / f64::from(SCREEN_ANGLE).to_radians().tan()
}

/// A long box of mass 2 slides over ice at 50 px/s, along X and Z, and friction takes along one of mass 1 that is
/// put on it.
pub fn box_on_sliding_box() -> DepthScene {
    // The mean of 0.6 and 0 acts between the two, and none on the ground.
    let rough = Surface { friction: 0.6, restitution: 0.0 };
    let carrier = DepthObject::new_box([120.0, 20.0, 120.0], [0.0, 0.0, 0.0]).with_mass(2.0);
    let load = DepthObject::new_box([40.0, 16.0, 40.0], [10.0, 20.0, 10.0]);
    DepthScene::empty("box_on_sliding_box", 250, SLIPPERY)
        .with(carrier.with_velocity([30.0, 0.0, 40.0]))
        .with(load.with_surface(rough))
}

/// A box falls on one of its edges and comes to rest on a side.
pub fn tilted_drop() -> DepthScene {
    let surface = Surface { friction: 0.6, restitution: 0.0 };
    let crate_box = DepthObject::new_box([60.0, 40.0, 30.0], [0.0, 60.0, 0.0]).with_rotation(0.3);
    DepthScene::empty("tilted_drop", 500, surface).with(crate_box.with_surface(surface))
}
