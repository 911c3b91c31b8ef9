//! Plays the scenes of `package/test/scenes.js` with the engines themselves and prints their results: for each scene a line of
//! its name, a hash of all positions of 600 steps and one of the last snapshot.

use farseer_core::math::{Vector2, Vector3};
use farseer_core::{
    BodyFactory, BodyId, Error, GeomFactory, GeomPlacement, JointFactory, JointLimits, JointMotor, Methods,
    PhysicsSimulator, SpringFactory, Vertices,
};
use twohalf::{CharacterController, CharacterSettings, MoveInput, Platform, TwoHalfPhysicsSimulator};
use twohalf_factories::{Ball, Figure, Prism, spawn, spawn_lane};

const STEPS: u32 = 600;
const DT: f32 = 1.0 / 60.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    plane("pile", pile(Methods::PRECISE)?);
    plane("faithful pile", pile(Methods::default())?);
    plane("machines", machines()?);
    street()?;
    Ok(())
}

/// FNV-1a, word by word.
struct Hash(u32);

impl Hash {
    fn new() -> Self {
        Hash(0x811C_9DC5)
    }

    fn word(&mut self, word: u32) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0100_0193);
    }
}

fn plane(name: &str, mut simulator: PhysicsSimulator) {
    let mut motion = Hash::new();
    for _ in 0..STEPS {
        simulator.update(DT);
        for body in simulator.bodies() {
            let body = &simulator[body];
            let row = [body.position().x, body.position().y, body.rotation()];
            row.into_iter().for_each(|number| motion.word(number.to_bits()));
        }
    }
    say(name, &motion, &simulator.snapshot());
}

fn say(name: &str, motion: &Hash, snapshot: &[u8]) {
    let mut hash = Hash::new();
    snapshot.iter().for_each(|&byte| hash.word(u32::from(byte)));
    println!("{name}: {} {}", motion.0, hash.0);
}

fn floor(simulator: &mut PhysicsSimulator) -> Result<BodyId, Error> {
    let floor = BodyFactory::create_rectangle_body_in(simulator, 800.0, 40.0, 1.0)?;
    simulator[floor].set_is_static(true);
    simulator[floor].set_position(Vector2::new(0.0, 220.0));
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_rectangle_geom_in(simulator, floor, 800.0, 40.0, placement)?;
    simulator[geom].set_friction_coefficient(0.5);
    Ok(floor)
}

/// Sixty bodies of four kinds fall onto a floor.
fn pile(methods: Methods) -> Result<PhysicsSimulator, Error> {
    let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 300.0))?;
    simulator.set_methods(methods)?;
    floor(&mut simulator)?;
    let placement = GeomPlacement::default();
    for number in 0..60_u8 {
        let (body, geom) = match number % 4 {
            0 => {
                let body = BodyFactory::create_rectangle_body_in(&mut simulator, 24.0, 16.0, 2.0)?;
                let geom =
                    GeomFactory::create_rectangle_geom_in(&mut simulator, body, 24.0, 16.0, placement)?;
                (body, geom)
            }
            1 => {
                let body = BodyFactory::create_circle_body_in(&mut simulator, 9.0, 1.0)?;
                (body, GeomFactory::create_circle_geom_in(&mut simulator, body, 9.0, 16, placement)?)
            }
            2 => {
                let corners = [(-12.0, 8.0), (12.0, 8.0), (0.0, -14.0)];
                let mut corners: Vertices = corners.iter().map(|&(x, y)| Vector2::new(x, y)).collect();
                let body = BodyFactory::create_polygon_body_in(&mut simulator, &corners, 1.5)?;
                let geom =
                    GeomFactory::create_polygon_geom_in(&mut simulator, body, &mut corners, placement)?;
                (body, geom)
            }
            _ => {
                let body = BodyFactory::create_capsule_body_in(&mut simulator, 30.0, 7.0, 1.25)?;
                (body, GeomFactory::create_capsule_geom_in(&mut simulator, body, 30.0, 7.0, 8, placement)?)
            }
        };
        let (column, row) = (f32::from(number % 10), f32::from(number / 10));
        simulator[body].set_position(Vector2::new(column * 31.0 - 140.0 + row * 3.0, 150.0 - row * 40.0));
        simulator[body].set_rotation(0.1 * f32::from(number));
        simulator[geom].set_friction_coefficient(0.4);
        simulator[geom].set_restitution_coefficient(0.2);
    }
    Ok(simulator)
}

fn crate_at(simulator: &mut PhysicsSimulator, x: f32, y: f32) -> Result<BodyId, Error> {
    let body = BodyFactory::create_rectangle_body_in(simulator, 20.0, 20.0, 1.0)?;
    simulator[body].set_position(Vector2::new(x, y));
    GeomFactory::create_rectangle_geom_in(simulator, body, 20.0, 20.0, GeomPlacement::default())?;
    Ok(body)
}

/// Every joint and spring, motors and limits.
fn machines() -> Result<PhysicsSimulator, Error> {
    let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 300.0))?;
    simulator.set_methods(Methods::PRECISE)?;
    let floor = floor(&mut simulator)?;
    let mut bodies = Vec::new();
    for column in 0..10_u8 {
        for row in 0..2_u8 {
            let (x, y) = (f32::from(column) * 70.0 - 315.0, f32::from(row) * 30.0);
            bodies.push(crate_at(&mut simulator, x, y)?);
        }
    }
    let (zero, objects) = (Vector2::zeros(), &mut *simulator);
    let motor =
        JointFactory::create_fixed_revolute_joint_in(objects, bodies[0], Vector2::new(-315.0, -20.0))?;
    objects.set_joint_motor(motor, Some(JointMotor { speed: 3.0, greatest_effort: 100_000.0 }))?;
    JointFactory::create_revolute_joint_in(objects, bodies[0], bodies[1], Vector2::new(-315.0, 15.0))?;
    JointFactory::create_pin_joint_in(objects, bodies[2], zero, bodies[3], Vector2::new(5.0, 0.0))?;
    JointFactory::create_slider_joint_in(objects, bodies[4], zero, bodies[5], zero, 20.0, 45.0)?;
    JointFactory::create_weld_joint_in(objects, bodies[6], bodies[7], Vector2::new(-105.0, 15.0))?;
    let (anchor, axis) = (Vector2::new(-35.0, 0.0), Vector2::new(1.0, 0.5));
    let slide = JointFactory::create_prismatic_joint_in(objects, floor, bodies[8], anchor, axis)?;
    objects.set_joint_limits(slide, Some(JointLimits { lower: -10.0, upper: 60.0 }))?;
    JointFactory::create_angle_joint_in(objects, bodies[10], bodies[11])?;
    JointFactory::create_angle_limit_joint_in(objects, bodies[12], bodies[13], -0.5, 0.5)?;
    let (ceiling, corner) = (Vector2::new(175.0, -120.0), Vector2::new(10.0, 0.0));
    SpringFactory::create_fixed_linear_spring_in(objects, bodies[14], corner, ceiling, 20.0, 0.5)?;
    SpringFactory::create_linear_spring_in(objects, bodies[14], zero, bodies[15], zero, 15.0, 0.2)?;
    SpringFactory::create_angle_spring_in(objects, bodies[16], bodies[17], 500.0, 5.0)?;
    let hanging =
        JointFactory::create_fixed_revolute_joint_in(objects, bodies[18], Vector2::new(315.0, -40.0))?;
    objects.joint_mut(hanging).ok_or(Error::StaleId { argument: "joint" })?.set_greatest_force(1000.0)?;
    JointFactory::create_fixed_angle_joint_in(objects, bodies[19])?;
    objects[bodies[3]].apply_impulse(Vector2::new(150.0, -20.0));
    objects[bodies[16]].set_angular_velocity(4.0);
    Ok(simulator)
}

/// A figure walks along a street and jumps, among crates, balls and platforms.
fn street() -> twohalf::Result<()> {
    let mut simulator = TwoHalfPhysicsSimulator::with_angle_and_gravity(480, 60, Vector2::new(0.0, 900.0))?;
    spawn_lane(&mut simulator, [0.0, 800.0], [0.0, 160.0], 1000.0)?;
    Platform::new(&mut simulator, 120.0, 30.0, 160.0, Vector3::new(400.0, 15.0, 80.0), None)?;
    let slope = Vector3::new(600.0, 20.0, 80.0);
    Platform::with_rotation(&mut simulator, 120.0, 20.0, 90.0, slope, 0.3, None)?;
    let figure = spawn(&mut simulator, Figure::new([30.0, 60.0, 20.0]).at([40.0, 0.0, 80.0]))?;
    for number in 0..12_u8 {
        let place = [60.0 * f32::from(number) + 80.0, 40.0, 12.0 * f32::from(number) + 15.0];
        let thing = match number % 2 {
            0 => Prism::new([26.0, 26.0, 26.0]).mass(4.0),
            _ => Ball::new(12.0).mass(2.0).restitution(0.5),
        };
        spawn(&mut simulator, thing.at(place))?;
    }
    let mut walker =
        CharacterController::new(CharacterSettings { jump_height: 80.0, ..CharacterSettings::default() });
    let mut motion = Hash::new();
    for step in 0..STEPS {
        let wish = MoveInput {
            x: if step < 400 { 120.0 } else { -90.0 },
            z: if step % 200 < 100 { 30.0 } else { -30.0 },
            jump: step % 90 == 60,
        };
        simulator.walk(figure.body, &mut walker, wish, DT)?;
        simulator.update(DT);
        for body in simulator.core().bodies() {
            let body = simulator.body(body).ok_or(Error::StaleId { argument: "body" })?;
            let [x, y, z] = body.position3d().into();
            [x, y, z, body.rotation()].into_iter().for_each(|number| motion.word(number.to_bits()));
        }
    }
    // As the module saves it: with the character controllers.
    let walkers = vec![(figure.body, walker)];
    say("street", &motion, &twohalf_javascript::WITH_WALKERS.write(&(walkers, simulator.snapshot())));
    Ok(())
}
