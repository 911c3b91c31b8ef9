//! Scenes of one object that falls, slides, rolls or is thrown, with a path in closed form.

use super::{DepthObject, DepthPlatform, DepthScene, Surface};

/// A box falls flat from a height of 100 px and rests where it lands.
pub fn drop_onto_ground() -> DepthScene {
    let surface = Surface { friction: 0.5, restitution: 0.0 };
    let crate_box = DepthObject::new_box([40.0, 30.0, 30.0], [20.0, 100.0, 35.0]).with_surface(surface);
    DepthScene::empty("drop_onto_ground", 300, surface).with(crate_box)
}

/// A ball falls from a height of 200 px and bounces with 0.6 of its speed.
pub fn bounce() -> DepthScene {
    let surface = Surface { friction: 0.3, restitution: 0.6 };
    let ball = DepthObject::ball(10.0, [0.0, 200.0, 20.0]).with_surface(surface);
    DepthScene::empty("bounce", 400, surface).with(ball)
}

/// A flat box slides at 100 px/s along the unit vector `direction` (X, Z) until friction (0.4) stops it.
pub fn box_sliding(name: &str, direction: [f32; 2]) -> DepthScene {
    let surface = Surface { friction: 0.4, restitution: 0.0 };
    let velocity = [100.0 * direction[0], 0.0, 100.0 * direction[1]];
    let crate_box = DepthObject::new_box([60.0, 20.0, 40.0], [0.0, 0.0, 0.0]);
    DepthScene::empty(name, 400, surface).with(crate_box.with_surface(surface).with_velocity(velocity))
}

/// A ball is thrown horizontally at 90 px/s along the unit vector `direction` (X, Z), and slides until it rolls.
pub fn ball_rolling(name: &str, direction: [f32; 2]) -> DepthScene {
    let surface = Surface { friction: 0.3, restitution: 0.0 };
    let velocity = [90.0 * direction[0], 0.0, 90.0 * direction[1]];
    let ball = DepthObject::ball(20.0, [0.0, 0.0, 0.0]).with_surface(surface).with_velocity(velocity);
    DepthScene::empty(name, 300, surface).with(ball)
}

/// A ball thrown up from the ground, to the right and into the picture; it lands after 2 s and rolls on.
pub fn throw_in_x_and_z() -> DepthScene {
    let surface = Surface { friction: 0.4, restitution: 0.0 };
    let ball = DepthObject::ball(10.0, [30.0, 0.0, 40.0]).with_surface(surface);
    DepthScene::empty("throw_in_x_and_z", 400, surface).with(ball.with_velocity([50.0, 100.0, 60.0]))
}

/// A flat box thrown onto a level platform 60 px high, on which it slides to rest.
pub fn throw_onto_platform() -> DepthScene {
    let surface = Surface { friction: 0.5, restitution: 0.0 };
    let crate_box = DepthObject::new_box([60.0, 20.0, 40.0], [-100.0, 0.0, -60.0]).with_surface(surface);
    DepthScene::empty("throw_onto_platform", 500, surface)
        .with(crate_box.with_velocity([60.0, 150.0, 45.0]))
        .with_platform(DepthPlatform::new([200.0, 20.0, 160.0], [100.0, 40.0, 60.0], surface))
}
