//! Scenes of objects that leave platforms, bump into platforms, or stand on each other.

use super::{DepthObject, DepthPlatform, DepthScene, SCREEN_ANGLE, Surface};

/// A surface without friction and restitution.
const SLIPPERY: Surface = Surface { friction: 0.0, restitution: 0.0 };
/// Returns a level platform whose upper face is 60 px above the ground.
fn table(surface: Surface) -> DepthPlatform {
    DepthPlatform::new([200.0, 20.0, 120.0], [0.0, 40.0, 0.0], surface)
}

/// A ball slides without friction and leaves a platform over its far edge, oblique to the edge.
pub fn ball_off_far_edge() -> DepthScene {
    let ball = DepthObject::ball(12.0, [-40.0, 60.0, 10.0]).with_velocity([30.0, 0.0, 60.0]);
    DepthScene::empty("ball_off_far_edge", 250, SLIPPERY).with(ball).with_platform(table(SLIPPERY))
}

/// A box slides without friction and leaves a platform over its near edge. The box does not tip: it stands as long as any
/// of its underside is over the platform.
pub fn box_off_near_edge() -> DepthScene {
    let crate_box = DepthObject::new_box([40.0, 30.0, 30.0], [20.0, 60.0, -10.0]);
    DepthScene::empty("box_off_near_edge", 300, SLIPPERY)
        .with(crate_box.with_velocity([0.0, 0.0, -60.0]))
        .with_platform(table(SLIPPERY))
}

/// A box is dropped with its centre beyond the right edge of a platform; the box tips over the edge and falls.
pub fn box_tipping_over_edge() -> DepthScene {
    let surface = Surface { friction: 0.5, restitution: 0.0 };
    let crate_box = DepthObject::new_box([44.0, 30.0, 30.0], [106.0, 70.0, 5.0]);
    DepthScene::empty("box_tipping_over_edge", 500, surface)
        .with(crate_box.with_surface(surface))
        .with_platform(table(surface))
}

/// Without friction, one box slides against the left side of a block and another against the front. A ball is thrown
/// against the underside of a platform beside the block.
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

/// Without gravity, a ball and a box fly against the left side of a block. The block's edges along Z run straight up on the
/// screen, so that the left side also faces forward.
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

/// Returns the shift along X, in px per px of depth, of the edges of the block in [`against_sheared_side`]. It is the
/// difference of the cotangents of 90 degrees and of the screen angle.
pub fn shear_of_side() -> f64 {
    -1.0 / f64::from(SCREEN_ANGLE).to_radians().tan()
}

/// A long box of mass 2 kg slides on ice at 50 px/s, along X and Z. Friction carries a box of mass 1 kg that lies on the
/// long one.
pub fn box_on_sliding_box() -> DepthScene {
    // The mean of 0.6 and 0 acts between the two boxes; no friction acts on the ground.
    let rough = Surface { friction: 0.6, restitution: 0.0 };
    let carrier = DepthObject::new_box([120.0, 20.0, 120.0], [0.0, 0.0, 0.0]).with_mass(2.0);
    let load = DepthObject::new_box([40.0, 16.0, 40.0], [10.0, 20.0, 10.0]);
    DepthScene::empty("box_on_sliding_box", 250, SLIPPERY)
        .with(carrier.with_velocity([30.0, 0.0, 40.0]))
        .with(load.with_surface(rough))
}

/// A tilted box falls to the ground, lands on one of its own edges and comes to rest on a side.
pub fn tilted_drop() -> DepthScene {
    let surface = Surface { friction: 0.6, restitution: 0.0 };
    let crate_box = DepthObject::new_box([60.0, 40.0, 30.0], [0.0, 60.0, 0.0]).with_rotation(0.3);
    DepthScene::empty("tilted_drop", 500, surface).with(crate_box.with_surface(surface))
}
