//! Joints and springs of angles, hinges, welds and rails between bodies with depth, against closed forms. They act in the
//! plane; along Z those with a common point or line keep their bodies together, and those of angles leave them free.

use conformance::fixtures::depth::{
    DT, GRAVITY, assert_near, assert_near3, place, run, simulator, solid, throw, velocity, weightless,
    with_scheme,
};
use farseer_core::{Error, JointFactory, JointId, Objects, SpringFactory, SpringId};
use twohalf::{BodyId, DepthScheme, TwoHalfPhysicsSimulator, Vector2, Vector3};

/// Rounding of coordinates up to 500 px and angles up to 10 rad, over hundreds of steps.
const ROUNDING: f32 = 2e-3;

fn precise(test: impl FnOnce()) {
    with_scheme(DepthScheme::Precise, test);
}

/// A bar of 30 by 6 px without collisions, with its middle at a position.
fn bar(simulator: &mut TwoHalfPhysicsSimulator, [x, y, z]: [f32; 3], mass: f32, inertia: f32) -> BodyId {
    let body = solid(simulator, [30.0, 6.0, 4.0], [x, y - 3.0, z]);
    let geom = simulator.body(body).unwrap().ground().object_geom().unwrap();
    simulator.geom_mut(geom).unwrap().set_collision_enabled(false);
    let mut view = simulator.body_mut(body).unwrap();
    view.set_mass(mass).unwrap();
    view.core_mut().set_moment_of_inertia(inertia).unwrap();
    body
}

/// Two bars behind each other, of moments of inertia of 100 and 300.
fn two() -> (TwoHalfPhysicsSimulator, [BodyId; 2]) {
    let mut simulator = weightless();
    let one = bar(&mut simulator, [0.0, 300.0, 10.0], 1.0, 100.0);
    let other = bar(&mut simulator, [80.0, 300.0, 50.0], 2.0, 300.0);
    (simulator, [one, other])
}

fn joined(
    simulator: &mut TwoHalfPhysicsSimulator,
    make: impl FnOnce(&mut Objects) -> Result<JointId, Error>,
) -> JointId {
    simulator.edit_objects(|objects| {
        let joint = make(objects).unwrap();
        objects.add(joint).unwrap();
        joint
    })
}

fn sprung(
    simulator: &mut TwoHalfPhysicsSimulator,
    make: impl FnOnce(&mut Objects) -> Result<SpringId, Error>,
) {
    simulator.edit_objects(|objects| {
        let spring = make(objects).unwrap();
        objects.add(spring).unwrap();
    });
}

fn spin(simulator: &TwoHalfPhysicsSimulator, body: BodyId) -> f32 {
    simulator.core().body(body).unwrap().angular_velocity()
}

fn set_spin(simulator: &mut TwoHalfPhysicsSimulator, body: BodyId, spin: f32) {
    simulator.body_mut(body).unwrap().set_angular_velocity(spin);
}

fn turned(simulator: &TwoHalfPhysicsSimulator, body: BodyId) -> f32 {
    simulator.core().body(body).unwrap().total_rotation()
}

fn origin(simulator: &TwoHalfPhysicsSimulator, body: BodyId) -> Vector3 {
    simulator.body(body).unwrap().origin3d()
}

/// Throws both of two bodies, has half a second pass, and looks whether they have gone straight on in all three axes.
fn assert_fly_freely(simulator: &mut TwoHalfPhysicsSimulator, bodies: [BodyId; 2]) {
    let ways = [[30.0, 10.0, -40.0], [-20.0, 0.0, 60.0]];
    let from = bodies.map(|body| origin(simulator, body));
    bodies.iter().zip(ways).for_each(|(&body, way)| throw(simulator, body, way));
    run(simulator, 50);
    for ((&body, way), from) in bodies.iter().zip(ways).zip(from) {
        assert_near3(velocity(simulator, body), way, ROUNDING);
        assert_near3(origin(simulator, body), (from + Vector3::from(way) * 0.5).into(), ROUNDING);
    }
}

#[test]
fn an_angle_joint_has_two_turn_as_one_with_their_spin_by_their_inertias_and_leaves_them_free_otherwise() {
    precise(|| {
        let (mut simulator, bodies) = two();
        joined(&mut simulator, |objects| JointFactory::create_angle_joint(objects, bodies[0], bodies[1]));
        set_spin(&mut simulator, bodies[0], 8.0);
        set_spin(&mut simulator, bodies[1], -4.0);
        // (100 * 8 - 300 * 4) / 400 = -1.
        assert_fly_freely(&mut simulator, bodies);
        for body in bodies {
            assert_near(spin(&simulator, body), -1.0, ROUNDING);
        }
        assert_near(turned(&simulator, bodies[0]), turned(&simulator, bodies[1]), ROUNDING);
        assert_near(turned(&simulator, bodies[0]), -0.5, ROUNDING);
    });
}

#[test]
fn on_a_fixed_angle_a_body_falls_and_flies_along_z_without_turning() {
    precise(|| {
        let mut simulator = simulator();
        let body = bar(&mut simulator, [0.0, 300.0, 10.0], 1.0, 100.0);
        joined(&mut simulator, |objects| JointFactory::create_fixed_angle_joint(objects, body));
        throw(&mut simulator, body, [20.0, 0.0, 35.0]);
        set_spin(&mut simulator, body, 5.0);
        for step in 1..=100 {
            simulator.body_mut(body).unwrap().apply_torque(1e5);
            run(&mut simulator, 1);
            let time = DT * step as f32;
            // The parabola in steps of this integrator: within half of the motion of gravity in one.
            let fallen = 0.5 * GRAVITY * time * time;
            let expected = Vector3::new(20.0 * time, 300.0 - fallen, 10.0 + 35.0 * time);
            let apart = origin(&simulator, body) - expected;
            assert_near3(apart, [0.0; 3], 0.5 * GRAVITY * DT * time + ROUNDING);
            assert_near(turned(&simulator, body), 0.0, 1e-5);
        }
    });
}

#[test]
fn two_turn_against_each_other_as_far_as_their_limit_and_from_there_on_as_one() {
    precise(|| {
        let (mut simulator, bodies) = two();
        joined(&mut simulator, |objects| {
            JointFactory::create_angle_limit_joint(objects, bodies[0], bodies[1], -0.4, 1.0)
        });
        // The limit removes the difference of 2 rad/s; 100 * 0 + 300 * 2 is conserved.
        set_spin(&mut simulator, bodies[1], 2.0);
        run(&mut simulator, 49);
        assert_near(turned(&simulator, bodies[1]), 2.0 * 49.0 * DT, ROUNDING);
        assert_eq!(spin(&simulator, bodies[0]), 0.0);
        run(&mut simulator, 50);
        for body in bodies {
            assert_near(spin(&simulator, body), 1.5, ROUNDING);
        }
        // The slop of a limit is 0.01 rad.
        assert_near(turned(&simulator, bodies[1]) - turned(&simulator, bodies[0]), 1.0, 0.011);
        assert_fly_freely(&mut simulator, bodies);
        // Back: to the other end.
        set_spin(&mut simulator, bodies[0], 3.0);
        set_spin(&mut simulator, bodies[1], -1.0);
        run(&mut simulator, 100);
        for body in bodies {
            assert_near(spin(&simulator, body), 0.0, ROUNDING);
        }
        assert_near(turned(&simulator, bodies[1]) - turned(&simulator, bodies[0]), -0.4, 0.011);
    });
}

#[test]
fn a_body_turns_to_its_limits_and_stays_there_while_it_flies_along_z() {
    precise(|| {
        let mut simulator = weightless();
        let body = bar(&mut simulator, [0.0, 300.0, 10.0], 1.0, 100.0);
        joined(&mut simulator, |objects| {
            JointFactory::create_fixed_angle_limit_joint(objects, body, -0.5, 1.0)
        });
        throw(&mut simulator, body, [0.0, 0.0, 35.0]);
        for (speed, end, steps) in [(2.0, 1.0, 49), (-2.0, -0.5, 74)] {
            set_spin(&mut simulator, body, speed);
            let from = turned(&simulator, body);
            run(&mut simulator, steps);
            assert_near(turned(&simulator, body), from + speed * DT * steps as f32, ROUNDING);
            run(&mut simulator, 60);
            assert_near(turned(&simulator, body), end, 0.011);
            assert_near(spin(&simulator, body), 0.0, ROUNDING);
        }
        let steps = (49 + 60 + 74 + 60) as f32;
        assert_near(origin(&simulator, body).z, 10.0 + 35.0 * DT * steps, 0.01);
    });
}

#[test]
fn an_angle_spring_has_two_swing_against_each_other_with_the_period_of_its_constant() {
    precise(|| {
        let (mut simulator, bodies) = two();
        // 1 Hz of the reduced inertia of both: 100 * 300 / 400 = 75.
        let constant = 75.0 * (2.0 * std::f32::consts::PI).powi(2);
        sprung(&mut simulator, |objects| {
            SpringFactory::create_angle_spring(objects, bodies[0], bodies[1], constant, 0.0)
        });
        simulator.body_mut(bodies[1]).unwrap().set_rotation(0.8);
        let apart =
            |simulator: &TwoHalfPhysicsSimulator| turned(simulator, bodies[1]) - turned(simulator, bodies[0]);
        for (steps, expected) in [(50, -0.8), (50, 0.8), (900, 0.8)] {
            run(&mut simulator, steps);
            assert_near(apart(&simulator), expected, 0.02 * 0.8);
            let kept = 100.0 * turned(&simulator, bodies[0]) + 300.0 * turned(&simulator, bodies[1]);
            assert_near(kept, 300.0 * 0.8, 0.05);
        }
        assert_fly_freely(&mut simulator, bodies);
    });
}

#[test]
fn on_a_fixed_angle_spring_a_body_swings_with_the_period_of_its_constant_while_it_flies_along_z() {
    precise(|| {
        let mut simulator = weightless();
        let body = bar(&mut simulator, [0.0, 300.0, 10.0], 1.0, 100.0);
        let constant = 100.0 * (2.0 * std::f32::consts::PI).powi(2);
        sprung(&mut simulator, |objects| {
            SpringFactory::create_fixed_angle_spring(objects, body, constant, 0.0)
        });
        simulator.body_mut(body).unwrap().set_rotation(0.8);
        throw(&mut simulator, body, [0.0, 0.0, 35.0]);
        for (steps, expected) in [(50, -0.8), (50, 0.8), (900, 0.8)] {
            run(&mut simulator, steps);
            assert_near(turned(&simulator, body), expected, 0.02 * 0.8);
        }
        assert_near3(origin(&simulator, body), [0.0, 300.0, 10.0 + 350.0], 0.01);
    });
}

/// Period of a bar, released at an angle to a hinge 40 px beside its middle.
fn period(amplitude: f32, hinge: impl FnOnce(&mut TwoHalfPhysicsSimulator, BodyId, Vector2)) -> f32 {
    let mut simulator = simulator();
    let (sin, cos) = amplitude.sin_cos();
    let body = bar(&mut simulator, [40.0 * sin, 300.0 - 40.0 * cos, 25.0], 2.0, 900.0);
    hinge(&mut simulator, body, Vector2::new(0.0, -300.0));
    let (mut passages, mut before, mut time) = (Vec::new(), 40.0 * sin, 0.0);
    while passages.len() <= 5 {
        run(&mut simulator, 1);
        let now = origin(&simulator, body);
        if before > 0.0 && now.x <= 0.0 {
            passages.push(time + DT * before / (before - now.x));
        }
        (before, time) = (now.x, time + DT);
        assert_near((now - Vector3::new(0.0, 300.0, 25.0)).norm(), 40.0, 0.01);
        assert_eq!(now.z, 25.0);
    }
    (passages[5] - passages[0]) / 5.0
}

#[test]
fn a_body_on_a_hinge_swings_as_a_physical_pendulum() {
    precise(|| {
        for amplitude in [0.3f32, 1.0] {
            // 2 pi sqrt((I + m r²) / (m g r)) (1 + a² / 16 + 11 a^4 / 3072).
            let squared = amplitude * amplitude;
            let longer = 1.0 + squared / 16.0 + 11.0 * squared * squared / 3072.0;
            let short = ((900.0 + 2.0 * 1600.0) / (2.0 * GRAVITY * 40.0f32)).sqrt();
            let expected = 2.0 * std::f32::consts::PI * short * longer;
            let fixed = period(amplitude, |simulator, body, at| {
                joined(simulator, |objects| JointFactory::create_fixed_revolute_joint(objects, body, at));
            });
            let on_post = period(amplitude, |simulator, body, at| {
                let post = bar(simulator, [0.0, 300.0, -30.0], 1.0, 1.0);
                simulator.body_mut(post).unwrap().set_is_static(true);
                joined(simulator, |objects| JointFactory::create_revolute_joint(objects, post, body, at));
            });
            assert_near(fixed, expected, 1e-3 * expected);
            assert_near(on_post, expected, 1e-3 * expected);
        }
    });
}

/// Two bars of mass 2 and a moment of inertia of 300 whose ends meet in the middle between them, 20 px from each; the right one
/// is 40 px behind.
fn end_to_end() -> (TwoHalfPhysicsSimulator, [BodyId; 2], Vector2) {
    let mut simulator = weightless();
    let bodies = [[-20.0, 300.0, 10.0], [20.0, 300.0, 50.0]];
    let bodies = bodies.map(|at| bar(&mut simulator, at, 2.0, 300.0));
    (simulator, bodies, Vector2::new(0.0, -300.0))
}

/// Energy of motion, momentum along Y and Z, and angular momentum about the origin of the plane, clockwise on the screen.
fn kept(simulator: &TwoHalfPhysicsSimulator, bodies: [BodyId; 2]) -> [f32; 4] {
    let mut sum = [0.0; 4];
    for body in bodies {
        let (at, velocity, spin) =
            (origin(simulator, body), velocity(simulator, body), spin(simulator, body));
        sum[0] += velocity.norm_squared() + 0.5 * 300.0 * spin * spin;
        sum[1] += 2.0 * velocity.y;
        sum[2] += 2.0 * velocity.z;
        sum[3] += 300.0 * spin + 2.0 * (at.y * velocity.x - at.x * velocity.y);
    }
    sum
}

#[test]
fn an_impulse_on_one_of_two_hinged_bodies_is_shared_by_their_lever_arms() {
    precise(|| {
        let (mut simulator, bodies, at) = end_to_end();
        let hinge = joined(&mut simulator, |objects| {
            JointFactory::create_revolute_joint(objects, bodies[0], bodies[1], at)
        });
        // 30 px/s up for the left one: the hinge takes 30 / (2 (1 / m + r² / I)) of momentum from it, and gives it to the
        // other; both are turned by that times r / I.
        throw(&mut simulator, bodies[0], [0.0, 30.0, 12.0]);
        let given = 30.0 / (2.0 * (1.0 / 2.0 + 400.0 / 300.0));
        run(&mut simulator, 1);
        // They have turned by 0.005 rad meanwhile.
        let tolerance = 0.005 * 30.0;
        assert_near(velocity(&simulator, bodies[0]).y, 30.0 - given / 2.0, tolerance);
        assert_near(velocity(&simulator, bodies[1]).y, given / 2.0, tolerance);
        // The hinge pushes the right end of the left one down, which turns it clockwise, and lifts the left end of the right
        // one.
        let turning = given * 20.0 / 300.0;
        bodies.iter().for_each(|&body| assert_near(spin(&simulator, body), turning, 0.005 * turning));
        bodies.iter().for_each(|&body| assert_near(velocity(&simulator, body).z, 6.0, ROUNDING));
        let before = kept(&simulator, bodies);
        for _ in 0..500 {
            run(&mut simulator, 1);
            assert_near(simulator.core().joint(hinge).unwrap().joint_error(), 0.0, ROUNDING);
            let now = kept(&simulator, bodies);
            assert_near(now[0], before[0], 1e-3 * before[0]);
            assert_near(now[1], before[1], ROUNDING);
            assert_near(now[2], 24.0, ROUNDING);
            assert_near(now[3], before[3], 1e-3 * before[3].abs());
        }
    });
}

#[test]
fn two_that_are_welded_turn_about_their_common_middle_as_one_body_would() {
    precise(|| {
        let (mut simulator, bodies, at) = end_to_end();
        joined(&mut simulator, |objects| JointFactory::create_weld_joint(objects, bodies[0], bodies[1], at));
        throw(&mut simulator, bodies[0], [0.0, 30.0, 12.0]);
        // Angular momentum 2 * 20 * 30 over 2 (I + m r²), clockwise; the middle rises at 15 px/s and moves at 6 px/s along Z.
        let turning = 1200.0 / (2.0 * (300.0 + 2.0 * 400.0));
        run(&mut simulator, 1);
        let first = turned(&simulator, bodies[0]);
        for step in 1..=300 {
            run(&mut simulator, 1);
            let time = DT * (step + 1) as f32;
            let places = bodies.map(|body| origin(&simulator, body));
            assert_near3((places[0] + places[1]) * 0.5, [0.0, 300.0 + 15.0 * time, 30.0 + 6.0 * time], 0.01);
            let angle = turned(&simulator, bodies[0]);
            assert_near(angle, first + turning * DT * step as f32, 1e-3 * angle.abs() + ROUNDING);
            assert_near(turned(&simulator, bodies[1]), angle, ROUNDING);
            let apart = places[1] - places[0];
            assert_near3(apart, [40.0 * angle.cos(), -40.0 * angle.sin(), 40.0], 0.01);
        }
    });
}

#[test]
fn on_a_rail_a_body_slides_with_the_component_of_gravity_and_keeps_its_z() {
    precise(|| {
        let mut simulator = simulator();
        let post = bar(&mut simulator, [0.0, 300.0, 0.0], 1.0, 1.0);
        simulator.body_mut(post).unwrap().set_is_static(true);
        let body = bar(&mut simulator, [10.0, 290.0, 25.0], 2.0, 100.0);
        // 30 degrees down to the right: y is down in the plane.
        let along = Vector2::new(0.75f32.sqrt(), 0.5);
        joined(&mut simulator, |objects| {
            let at = objects[body].position();
            JointFactory::create_prismatic_joint(objects, post, body, at, along)
        });
        throw(&mut simulator, body, [0.0, 0.0, 40.0]);
        set_spin(&mut simulator, body, 3.0);
        for step in 1..=200 {
            run(&mut simulator, 1);
            let time = DT * step as f32;
            let gone = 0.5 * (0.5 * GRAVITY) * time * time;
            let apart = origin(&simulator, body) - Vector3::new(10.0, 290.0, 25.0);
            let slid = apart.x * along.x - apart.y * along.y;
            // Half of the motion in a step.
            assert_near(slid, gone, 0.5 * (0.5 * GRAVITY) * DT * time + ROUNDING);
            assert_near(apart.x * along.y + apart.y * along.x, 0.0, ROUNDING);
            assert_near(apart.z, 0.0, ROUNDING);
            assert_near(turned(&simulator, body), 0.0, 1e-4);
        }
    });
}

#[test]
fn two_bodies_on_one_rail_share_momentum_along_z_and_across_it_and_not_along_it() {
    precise(|| {
        let mut simulator = weightless();
        let light = bar(&mut simulator, [-20.0, 300.0, 10.0], 1.0, 1e6);
        let heavy = bar(&mut simulator, [20.0, 300.0, 50.0], 3.0, 1e6);
        joined(&mut simulator, |objects| {
            let at = Vector2::new(0.0, -300.0);
            JointFactory::create_prismatic_joint(objects, light, heavy, at, Vector2::new(1.0, 0.0))
        });
        throw(&mut simulator, light, [-8.0, 0.0, 40.0]);
        run(&mut simulator, 100);
        assert_near(velocity(&simulator, light).x, -8.0, ROUNDING);
        assert_near(velocity(&simulator, heavy).x, 0.0, ROUNDING);
        for (body, z) in [(light, 10.0), (heavy, 50.0)] {
            assert_near(velocity(&simulator, body).z, 10.0, ROUNDING);
            assert_near(place(&simulator, body).z, z + 10.0, ROUNDING);
        }
    });
}
