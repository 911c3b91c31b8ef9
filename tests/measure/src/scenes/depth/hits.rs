//! Scenes of objects that hit each other.

use super::{DepthObject, DepthScene, Surface};

/// A surface without friction and restitution.
const SLIPPERY: Surface = Surface { friction: 0.0, restitution: 0.0 };

/// Two balls of masses 1 and 2 kg collide without friction and gravity. At the collision the line between the centres has a
/// component along X, Y and Z.
pub fn balls_meeting_obliquely() -> DepthScene {
    let surface = Surface { friction: 0.0, restitution: 0.5 };
    let a = DepthObject::ball(20.0, [-80.0, 100.0, -60.0]).with_velocity([100.0, 0.0, 60.0]);
    let b = DepthObject::ball(15.0, [30.0, 110.0, 20.0]).with_velocity([-20.0, 5.0, -10.0]).with_mass(2.0);
    DepthScene::empty("balls_meeting_obliquely", 200, SLIPPERY)
        .weightless()
        .with(a.with_surface(surface))
        .with(b.with_surface(surface))
}

/// A box of mass 2 kg slides along Z without friction into the front of a box of mass 1 kg.
pub fn box_pushed_into_box_along_z() -> DepthScene {
    let surface = Surface { friction: 0.0, restitution: 0.4 };
    let pusher = DepthObject::new_box([40.0, 30.0, 30.0], [0.0, 0.0, 0.0]).with_mass(2.0);
    let pushed = DepthObject::new_box([40.0, 40.0, 40.0], [6.0, 0.0, 80.0]);
    DepthScene::empty("box_pushed_into_box_along_z", 200, SLIPPERY)
        .with(pusher.with_surface(surface).with_velocity([0.0, 0.0, 90.0]))
        .with(pushed.with_surface(surface))
}

/// A ball slides along Z without friction into the front of a box of mass 3 kg.
pub fn ball_against_box_front() -> DepthScene {
    let surface = Surface { friction: 0.0, restitution: 0.6 };
    let ball = DepthObject::ball(15.0, [5.0, 0.0, 0.0]).with_velocity([0.0, 0.0, 90.0]);
    let crate_box = DepthObject::new_box([60.0, 40.0, 40.0], [0.0, 0.0, 80.0]).with_mass(3.0);
    DepthScene::empty("ball_against_box_front", 200, SLIPPERY)
        .with(ball.with_surface(surface))
        .with(crate_box.with_surface(surface))
}

/// A ball flies past the front of a static post and glances off the post's vertical edge, at an angle in X and Z.
pub fn ball_against_box_edge() -> DepthScene {
    let surface = Surface { friction: 0.0, restitution: 0.5 };
    let ball = DepthObject::ball(15.0, [-31.0, 40.0, -60.0]).with_velocity([0.0, 0.0, 80.0]);
    let post = DepthObject::new_box([40.0, 100.0, 40.0], [0.0, 0.0, 40.0]).fixed();
    DepthScene::empty("ball_against_box_edge", 200, SLIPPERY)
        .weightless()
        .with(ball.with_surface(surface))
        .with(post.with_surface(surface))
}

/// Four balls in a row oblique to X and Z, without friction: the first hits the second, the second the third, the third the
/// fourth.
pub fn row_of_three_hits() -> DepthScene {
    let surface = Surface { friction: 0.0, restitution: 1.0 };
    let place = |along: f32| [0.6 * along, 0.0, 0.8 * along];
    let scene = DepthScene::empty("row_of_three_hits", 250, SLIPPERY);
    [0.0, 60.0, 120.0, 180.0].into_iter().enumerate().fold(scene, |scene, (index, along)| {
        let speed = if index == 0 { 100.0 } else { 0.0 };
        let ball = DepthObject::ball(15.0, place(along)).with_velocity([0.6 * speed, 0.0, 0.8 * speed]);
        scene.with(ball.with_surface(surface))
    })
}
