//! The examples in C and C# give the same bits as their scene in Rust.

mod programs;

use std::fmt::Write;

use farseer_core::math::Vector2;
use farseer_core::{
    BodyBuilder, BodyFactory, BodyId, Event, GeomBuilder, GeomFactory, GeomPlacement, JointFactory,
    PhysicsSimulator, Result, SpringFactory,
};
use programs::{root, run_c, run_csharp};

fn at(x: f32, y: f32) -> Vector2 {
    Vector2::new(x, y)
}

fn add_box(simulator: &mut PhysicsSimulator, width: f32, height: f32, position: Vector2) -> Result<BodyId> {
    let body = BodyFactory::create_rectangle_body_in(simulator, width, height, 1.0)?;
    simulator[body].set_position(position);
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_rectangle_geom_in(simulator, body, width, height, placement)?;
    simulator[geom].set_friction_coefficient(0.5);
    Ok(body)
}

fn add_ball(simulator: &mut PhysicsSimulator, radius: f32, position: Vector2) -> Result<BodyId> {
    let body = BodyFactory::create_circle_body_in(simulator, radius, 2.0)?;
    simulator[body].set_position(position);
    let geom = GeomFactory::create_circle_geom_in(simulator, body, radius, 16, GeomPlacement::default())?;
    simulator[geom].set_restitution_coefficient(0.5);
    Ok(body)
}

fn add_pendulum(simulator: &mut PhysicsSimulator) -> Result<()> {
    let upper = add_box(simulator, 10.0, 40.0, at(-150.0, 60.0))?;
    let lower = add_box(simulator, 10.0, 40.0, at(-150.0, 100.0))?;
    JointFactory::create_fixed_revolute_joint_in(simulator, upper, at(-150.0, 40.0))?;
    JointFactory::create_revolute_joint_in(simulator, upper, lower, at(-150.0, 80.0))?;
    simulator[lower].apply_impulse(at(80.0, 0.0));
    Ok(())
}

fn scene(mut simulator: PhysicsSimulator) -> Result<PhysicsSimulator> {
    let floor = add_box(&mut simulator, 400.0, 20.0, at(0.0, 200.0))?;
    simulator[floor].set_is_static(true);
    for i in 0..10 {
        let position = at(-40.0 + 25.0 * (i % 4) as f32 + i as f32, 150.0 - 30.0 * i as f32);
        add_box(&mut simulator, 20.0, 20.0, position)?;
    }
    let ball = add_ball(&mut simulator, 12.0, at(5.0, -200.0))?;
    simulator[ball].set_linear_velocity(at(10.0, 0.0));
    let wedge = GeomBuilder::polygon([[-15.0, 10.0], [15.0, 10.0], [0.0, -15.0]]);
    simulator.add_body(BodyBuilder::dynamic().position([60.0, -100.0]), [wedge])?;
    add_pendulum(&mut simulator)?;
    let ball = add_ball(&mut simulator, 8.0, at(150.0, 0.0))?;
    let (here, above) = (at(0.0, 0.0), at(150.0, -50.0));
    SpringFactory::create_fixed_linear_spring_in(&mut simulator, ball, here, above, 20.0, 0.5)?;
    Ok(simulator)
}

fn play(name: &str, simulator: PhysicsSimulator) -> Result<String> {
    let mut simulator = scene(simulator)?;
    (0..300).for_each(|_| simulator.update(1.0 / 60.0));
    let hash = simulator.state_hash();
    let mut text = format!("{name}\nhash {hash:016x}\nhash {hash:016x}\n");
    let is_reported = |event: &&Event| !matches!(event, Event::BodyUpdated { .. });
    writeln!(text, "events {}", simulator.events().iter().filter(is_reported).count()).unwrap();
    for &body in simulator.body_list() {
        let body = &simulator[body];
        let [x, y, angle] = [body.position().x, body.position().y, body.rotation()].map(f32::to_bits);
        writeln!(text, "{x:08x} {y:08x} {angle:08x}").unwrap();
    }
    Ok(text)
}

/// Output of the programs, by the engine itself.
fn expected() -> String {
    let gravity = at(0.0, 300.0);
    let faithful = play("faithful", PhysicsSimulator::new(gravity).unwrap()).unwrap();
    faithful + &play("precise", PhysicsSimulator::precise(gravity).unwrap()).unwrap()
}

#[test]
fn the_example_in_c_has_the_bits_of_rust() {
    if let Some(output) = run_c(&root().join("examples/pile.c"), "pile") {
        assert_eq!(output, expected());
        println!("C: the same bits as in Rust");
    }
}

#[test]
fn the_example_in_csharp_has_the_bits_of_rust() {
    if let Some(output) = run_csharp(&root().join("examples/Pile.cs"), "Pile.exe") {
        assert_eq!(output.replace("\r\n", "\n"), expected());
        println!("C#: the same bits as in Rust");
    }
}
