//! Calls that every game needs: explosions, contacts of a body, largest speed, density, fixed steps; refusals of joints.

use std::time::Duration;

use farseer_core::math::Vector2;
use farseer_core::{
    Body, BodyBuilder, BodyId, Explosion, FixedStepRunner, GeomBuilder, GeomFactory, GeomId, GeomPlacement,
    JointFactory, Methods, PhysicsSimulator, QueryFilter,
};

const DT: f32 = 1.0 / 60.0;

fn precise(gravity: f32) -> PhysicsSimulator {
    PhysicsSimulator::precise([0.0, gravity]).unwrap()
}

fn add(simulator: &mut PhysicsSimulator, at: [f32; 2]) -> (BodyId, GeomId) {
    let (body, [geom]) = simulator
        .add_body(BodyBuilder::dynamic().position(at), [GeomBuilder::rectangle(32.0, 32.0)])
        .unwrap();
    (body, geom)
}

#[test]
fn an_explosion_falls_off_pushes_by_width_turns_and_spares_who_is_filtered() {
    let mut simulator = precise(0.0);
    let (close, _) = add(&mut simulator, [50.0, 0.0]);
    // Half of the falloff away, and beyond it.
    let (middle, _) = add(&mut simulator, [0.0, -141.0]);
    let (far, _) = add(&mut simulator, [-300.0, 0.0]);
    let (corner, _) = add(&mut simulator, [60.0, 90.0]);
    let (spared, _) = add(&mut simulator, [-50.0, 0.0]);
    let (wall, _) =
        simulator.add_body(BodyBuilder::fixed().position([0.0, 60.0]), [GeomBuilder::circle(9.0)]).unwrap();
    simulator.update(DT);
    let filter = QueryFilter { exclude_body: Some(spared), ..QueryFilter::default() };
    let bomb = Explosion { radius: 100.0, falloff: 50.0, strength: 5.0, filter, ..Explosion::default() };
    assert_eq!(simulator.explode(&bomb).unwrap(), 3);
    simulator.update(DT);
    let velocity = |body: BodyId| simulator[body].linear_velocity();
    assert!((velocity(close) - Vector2::new(160.0, 0.0)).norm() < 0.01);
    assert!((velocity(middle) - Vector2::new(0.0, -80.0)).norm() < 1.0, "{:?}", velocity(middle));
    assert_eq!([far, spared, wall].map(velocity), [Vector2::zeros(); 3]);
    assert!(
        velocity(corner).x > 0.0 && velocity(corner).y > 0.0 && simulator[corner].angular_velocity() != 0.0
    );
    let wrong = [
        Explosion { radius: -1.0, ..bomb },
        Explosion { falloff: f32::NAN, ..bomb },
        Explosion { strength: f32::INFINITY, ..bomb },
        Explosion { position: Vector2::new(f32::NAN, 0.0), ..bomb },
    ];
    for (explosion, name) in wrong.into_iter().zip(["radius", "falloff", "strength", "position"]) {
        assert!(simulator.explode(&explosion).unwrap_err().to_string().starts_with(name));
    }
}

#[test]
fn an_explosion_wakes_and_a_radial_force_acts_for_one_update() {
    let mut simulator = precise(300.0);
    simulator
        .add_body(BodyBuilder::fixed().position([0.0, 10.0]), [GeomBuilder::rectangle(999.0, 20.0)])
        .unwrap();
    let (body, _) = add(&mut simulator, [60.0, -16.0]);
    (0..90).for_each(|_| simulator.update(DT));
    assert!(simulator.is_asleep(body));
    let position = Vector2::new(60.0, 60.0);
    let bomb = Explosion { position, radius: 100.0, strength: 10.0, ..Explosion::default() };
    simulator.explode(&bomb).unwrap();
    simulator.update(DT);
    assert!(!simulator.is_asleep(body) && simulator[body].linear_velocity().y < -300.0);

    let mut simulator = precise(0.0);
    let (body, _) = add(&mut simulator, [60.0, 0.0]);
    simulator.update(DT);
    let magnet = Explosion { radius: 100.0, strength: -2.0, ..Explosion::default() };
    assert_eq!(simulator.apply_radial_force(&magnet).unwrap(), 1);
    simulator.update(0.5);
    assert!((simulator[body].linear_velocity().x + 32.0).abs() < 0.01);
    simulator.update(0.01);
    assert!((simulator[body].linear_velocity().x + 32.0).abs() < 0.01);
}

#[test]
fn the_contacts_of_a_body_are_its_own_and_point_to_it_with_both_sets() {
    for methods in [Methods::default(), Methods::PRECISE] {
        let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 300.0)).unwrap();
        simulator.set_methods(methods).unwrap();
        let floor = BodyBuilder::fixed().position([0.0, 10.0]);
        let (floor, [ground]) = simulator.add_body(floor, [GeomBuilder::rectangle(400.0, 20.0)]).unwrap();
        let zone = GeomBuilder::circle(50.0).sensor(true);
        simulator.add_body(BodyBuilder::fixed(), [zone]).unwrap();
        let (low, low_geom) = add(&mut simulator, [0.0, -16.0]);
        let (top, top_geom) = add(&mut simulator, [0.0, -48.0]);
        (0..30).for_each(|_| simulator.update(0.01));
        let of_low = simulator.contacts_of(low);
        let partners: Vec<GeomId> = of_low.iter().map(|contact| contact.other).collect();
        assert!(partners.contains(&ground) && partners.contains(&top_geom) && !of_low.is_empty());
        for contact in &of_low {
            assert_eq!(contact.geom, low_geom);
            let up = if contact.other == ground { -1.0 } else { 1.0 };
            assert!((contact.normal.y - up).abs() < 0.01, "{contact:?}");
        }
        let of_top = simulator.contacts_of(top);
        assert!(of_top.iter().all(|contact| contact.normal.y < -0.99));
        assert!(of_top.iter().map(|contact| contact.normal_impulse).sum::<f32>() > 0.0);
        assert!(simulator.contacts_of(floor).iter().all(|contact| contact.normal.y > 0.99));
        simulator.dispose(top).unwrap();
        (0..2).for_each(|_| simulator.update(0.01));
        assert_eq!(simulator.contacts_of(top), []);
    }
}

#[test]
fn no_body_is_faster_than_the_largest_speed_whatever_pushes_it() {
    let mut simulator = precise(0.0);
    simulator.set_largest_speed(Some(200.0)).unwrap();
    let (body, _) = add(&mut simulator, [0.0, 0.0]);
    simulator[body].apply_impulse(Vector2::new(3000.0, 4000.0));
    simulator.update(DT);
    assert!((simulator[body].linear_velocity() - Vector2::new(120.0, 160.0)).norm() < 0.01);
    assert!((simulator[body].position().norm() - 200.0 * DT).abs() < 0.01);
    simulator[body].apply_force(Vector2::new(1e7, 0.0));
    simulator.update(DT);
    assert!(simulator[body].linear_velocity().norm() < 200.01);
    // It belongs to the simulator, and not to the save.
    let snapshot = simulator.snapshot();
    simulator.set_largest_speed(None).unwrap();
    simulator.restore(&snapshot).unwrap();
    assert_eq!(simulator.largest_speed(), None);
    assert!(simulator.set_largest_speed(Some(0.0)).is_err());
    let refused = PhysicsSimulator::default().set_largest_speed(Some(1.0)).unwrap_err();
    assert_eq!(refused.to_string(), "the faithful methods have no largest speed");
}

#[test]
fn density_gives_mass_and_inertia_of_all_solid_geoms() {
    let mut simulator = precise(0.0);
    let body = simulator.create_body(Body::new());
    let turned =
        GeomPlacement { offset: Vector2::new(3.0, 0.0), rotation_offset: 0.5, ..GeomPlacement::default() };
    GeomFactory::create_circle_geom_in(&mut simulator, body, 2.0, 16, turned).unwrap();
    simulator.set_density(body, 0.5).unwrap();
    let mass = 0.5 * std::f32::consts::PI * 4.0;
    assert!((simulator[body].mass() - mass).abs() < 1e-4);
    assert!((simulator[body].moment_of_inertia() - mass * (2.0 + 9.0)).abs() < 1e-3);
    assert!(simulator.set_density(body, 0.0).unwrap_err().to_string().starts_with("density"));
    let empty = simulator.create_body(Body::new());
    assert!(simulator.set_density(empty, 1.0).unwrap_err().to_string().starts_with("body"));
}

#[test]
fn a_runner_updates_as_often_as_time_has_passed_and_shows_poses_between() {
    let mut simulator = precise(0.0);
    let ball = BodyBuilder::dynamic().linear_velocity([100.0, 0.0]);
    let (ball, _) = simulator.add_body(ball, [GeomBuilder::circle(5.0)]).unwrap();
    let mut runner = FixedStepRunner::new(50).unwrap();
    assert!(runner.pose(ball).is_none());
    let mut updates = 0;
    for frame in 1..=40 {
        runner.advance(&mut simulator, Duration::from_millis(7), |simulator, dt| {
            assert_eq!(dt, 0.02);
            simulator.update(dt);
            updates += 1;
        });
        // Poses are an update late, and even.
        if let Some(pose) = runner.pose(ball).filter(|_| frame > 6) {
            let expected = 100.0 * (0.007 * frame as f32 - 0.02);
            assert!((pose.position.x - expected).abs() < 0.01, "{frame}");
        }
    }
    assert_eq!(updates, 14);
    runner.reset();
    assert!(runner.pose(ball).is_none() && FixedStepRunner::new(0).is_err());
}

#[test]
fn joints_that_make_no_sense_are_refused_with_the_precise_set_alone() {
    for (methods, is_refused) in [(Methods::default(), false), (Methods::PRECISE, true)] {
        let mut simulator = PhysicsSimulator::default();
        simulator.set_methods(methods).unwrap();
        let (one, _) = add(&mut simulator, [0.0, 0.0]);
        let (other, _) = add(&mut simulator, [50.0, 0.0]);
        let zero = Vector2::zeros();
        let with_itself = JointFactory::create_pin_joint_in(&mut simulator, one, zero, one, zero);
        assert_eq!(with_itself.is_err(), is_refused);
        let reversed =
            JointFactory::create_slider_joint_in(&mut simulator, one, zero, other, zero, 60.0, 40.0);
        assert_eq!(reversed.is_err(), is_refused);
        let angles = JointFactory::create_angle_limit_joint_in(&mut simulator, one, other, 0.5, -0.5);
        assert_eq!(angles.is_err(), is_refused);
        if is_refused {
            assert!(with_itself.unwrap_err().to_string().contains("another body than body1"));
            assert_eq!(reversed.unwrap_err().to_string(), "min is 60.0, but must be at most max");
        }
        let joint = JointFactory::create_revolute_joint_in(&mut simulator, one, other, zero).unwrap();
        for value in [f32::INFINITY, f32::NAN, -1.0] {
            let refusals =
                [simulator[joint].set_greatest_force(value), simulator[joint].set_greatest_torque(value)];
            for refusal in refusals {
                assert!(refusal.unwrap_err().to_string().contains("f32::MAX stands for no maximum"));
            }
        }
        simulator[joint].set_greatest_force(f32::MAX).unwrap();
        simulator[joint].set_greatest_torque(0.0).unwrap();
    }
}

#[test]
fn a_joint_that_broke_shows_the_force_that_broke_it() {
    let mut simulator = precise(300.0);
    let (body, _) = add(&mut simulator, [0.0, 50.0]);
    let joint = JointFactory::create_fixed_revolute_joint_in(&mut simulator, body, Vector2::zeros()).unwrap();
    simulator[joint].set_greatest_force(200.0).unwrap();
    (0..20).for_each(|_| simulator.update(DT));
    assert!(!simulator[joint].enabled());
    assert!((simulator[joint].force().norm() - 300.0).abs() < 10.0, "{:?}", simulator[joint].force());
}
