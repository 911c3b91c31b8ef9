//! Levers, ropes and a ball on springs (behaviour chapter 16, section C.1, demo 6).

use farseer_core::math::Vector2;
use farseer_core::{BodyFactory, GeomFactory, GeomPlacement, Result, SpringFactory};

use super::{Agent, BLACK, GOLD, Lever, Rope, SampleScene, Side, border, rectangle_platform};

/// Number of the collision group of platforms and levers, the border's.
const GROUP: i32 = 100;

/// Simple 6: three platforms with levers, two ropes and a ball on a spring.
pub(super) fn linear_and_angular_springs() -> Result<SampleScene> {
    let mut scene = SampleScene::new(200.0)?;
    scene.simulator.set_max_contacts_to_detect(2);
    let agent = Agent::of_fifth_category()?.add(&mut scene, Vector2::new(512.0, 100.0))?;

    // Fixed at the upper corner of a platform, a step inward and some distance down.
    let platform = |scene: &mut SampleScene, height: f32, x, y| -> Result<Vector2> {
        let position = Vector2::new(x, y);
        rectangle_platform(scene, 102.0, height, position, GROUP)?;
        Ok(position)
    };
    let on_right = |platform: Vector2, height: f32, down: f32| {
        platform + Vector2::new(51.0, -height / 2.0) + Vector2::new(-25.0, down * height)
    };
    let on_left = |platform: Vector2, height: f32, down: f32| {
        platform + Vector2::new(-51.0, -height / 2.0) + Vector2::new(25.0, down * height)
    };
    let lever = |side, width, spring_constant, damping_constant, position| Lever {
        side,
        size: [width, 20.0],
        spring_constant,
        damping_constant,
        collision_group: GROUP,
        position,
    };

    let first = platform(&mut scene, 461.0, 46.0, 542.5)?;
    lever(Side::Left, 200.0, 1_000_000.0, 5000.0, on_right(first, 461.0, 0.4)).add(&mut scene)?;

    let second = platform(&mut scene, 538.0, 512.0, 504.0)?;
    lever(Side::Right, 200.0, 1_000_000.0, 5000.0, on_left(second, 538.0, 0.2)).add(&mut scene)?;
    let held = on_right(second, 538.0, 0.1);
    let third_lever = lever(Side::Left, 150.0, 10_000_000.0, 1000.0, held).add(&mut scene)?;
    let rope = Rope {
        position: held + Vector2::new(145.0, 25.0),
        count: 20,
        edge: 15.0,
        mass: 0.5,
        spring_constant: 400.0,
        damping_constant: 3.0,
        collision_group: 0,
    };
    let top = rope.add(&mut scene)?;
    let (end, middle) = (Vector2::new(75.0, 0.0), Vector2::zeros());
    let simulator = &mut scene.simulator;
    SpringFactory::create_linear_spring_in(simulator, third_lever, end, top, middle, 400.0, 3.0)?;

    let third = platform(&mut scene, 461.0, 978.0, 542.5)?;
    hanging_ball(&mut scene)?;
    lever(Side::Right, 200.0, 1_000_000.0, 1000.0, on_left(third, 461.0, 0.7)).add(&mut scene)?;

    let tail = Rope {
        position: Vector2::new(512.0, 100.0),
        count: 20,
        edge: 10.0,
        mass: 0.2,
        spring_constant: 200.0,
        damping_constant: 4.0,
        collision_group: 1,
    };
    let top = tail.add(&mut scene)?;
    SpringFactory::create_linear_spring_in(&mut scene.simulator, agent, middle, top, middle, 200.0, 4.0)?;
    border(&mut scene)?;
    Ok(scene)
}

fn hanging_ball(scene: &mut SampleScene) -> Result<()> {
    let simulator = &mut scene.simulator;
    let ball = BodyFactory::create_circle_body_in(simulator, 40.0, 1.0)?;
    simulator[ball].set_position(Vector2::new(778.0, 200.0));
    let geom = GeomFactory::create_circle_geom_in(simulator, ball, 40.0, 20, GeomPlacement::default())?;
    let (top, hook) = (Vector2::new(0.0, -35.0), Vector2::new(778.0, 100.0));
    SpringFactory::create_fixed_linear_spring_in(simulator, ball, top, hook, 2.0, 0.1)?;
    scene.show(geom, GOLD, BLACK);
    Ok(())
}
