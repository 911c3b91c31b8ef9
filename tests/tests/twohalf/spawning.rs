//! Things that are made in one call.

use twohalf::farseer_core::FrictionType;
use twohalf::{DepthProfile, TwoHalfPhysicsSimulator, Vector2, Vector3};
use twohalf_factories::{Ball, Figure, Prism, Thing, spawn, spawn_block, spawn_lane, spawn_slope};

fn simulator() -> TwoHalfPhysicsSimulator {
    TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0)).unwrap()
}

#[test]
fn a_spawned_prism_has_the_given_properties() {
    let mut simulator = simulator();
    let thing = Prism::new([40.0, 30.0, 20.0]).mass(5.0).friction(0.7).restitution(0.2).at([9.0, 8.0, 7.0]);
    let made = spawn(&mut simulator, thing).unwrap();
    let (body, geom) = (simulator.body(made.body).unwrap(), &simulator.core()[made.geom]);
    assert_eq!(body.position3d(), Vector3::new(9.0, 8.0, 7.0));
    assert_eq!((body.mass(), body.ground().object_geom()), (5.0, Some(made.geom)));
    assert_eq!((geom.friction_coefficient(), geom.restitution_coefficient()), (0.7, 0.2));
    let ground = body.ground();
    assert_eq!((ground.friction_coefficient(), ground.restitution_coefficient()), (0.7, 0.2));
    assert_eq!(simulator.depth_profile(made.geom), Some(DepthProfile::Prism { depth: 20.0 }));
}

#[test]
fn a_spawned_ball_is_round_and_solid() {
    let mut simulator = simulator();
    let made = spawn(&mut simulator, Ball::new(10.0).mass(2.0)).unwrap();
    assert_eq!(simulator.depth_profile(made.geom), Some(DepthProfile::Round { radius: 10.0 }));
    assert_eq!(simulator.core()[made.body].moment_of_inertia(), 80.0);
}

#[test]
fn a_spawned_figure_does_not_topple_when_it_is_hit_above_its_middle() {
    let mut simulator = simulator();
    let figure = spawn(&mut simulator, Figure::new([30.0, 60.0, 20.0])).unwrap();
    let ball = spawn(&mut simulator, Ball::new(8.0).mass(20.0).at([-60.0, 40.0, 0.0])).unwrap();
    simulator.body_mut(ball.body).unwrap().set_linear_velocity(Vector2::new(600.0, 0.0));
    (0..60).for_each(|_| simulator.update(1.0 / 60.0));
    let figure = simulator.body(figure.body).unwrap();
    assert!(figure.position3d().x > 1.0);
    // An impulse of 2 x 20 x 600 at an arm of 30 px turns a moment of 1e20 by 1e-14 rad in a second.
    assert!(figure.rotation().abs() < 1e-13);
}

#[test]
fn an_invalid_spawn_is_refused_by_name_and_adds_nothing() {
    let mut simulator = simulator();
    let refused: [(Thing, &str); 5] = [
        (Prism::new([0.0, 1.0, 1.0]), "width"),
        (Ball::new(f32::NAN), "radius"),
        (Prism::new([1.0; 3]).mass(-1.0), "mass"),
        (Prism::new([1.0; 3]).friction(f32::INFINITY), "friction"),
        (Figure::new([1.0; 3]).at([0.0, f32::NAN, 0.0]), "position3d"),
    ];
    for (thing, argument) in refused {
        let error = spawn(&mut simulator, thing).unwrap_err().to_string();
        assert!(error.contains(argument), "{error}");
    }
    assert_eq!(simulator.core().bodies().count(), 0);
}

#[test]
fn an_invalid_lane_adds_nothing() {
    let mut simulator = simulator();
    let (fine, far) = ([0.0, 100.0], [3e38, f32::MAX]);
    for (x, z, height) in [
        ([100.0, 0.0], fine, 50.0),
        (fine, [0.0, f32::NAN], 50.0),
        ([f32::MIN, f32::MAX], fine, 50.0),
        (fine, fine, 0.0),
        (far, far, f32::INFINITY),
    ] {
        assert!(spawn_lane(&mut simulator, x, z, height).is_err());
        assert_eq!(simulator.platforms().count(), 0);
    }
}

#[test]
fn the_upper_edge_of_a_slope_is_at_the_given_position() {
    let mut simulator = simulator();
    for (from, to) in
        [([100.0, 20.0], [400.0, 140.0]), ([400.0, 120.0], [730.0, 0.0]), ([0.0, 30.0], [90.0, 30.0])]
    {
        let slope = spawn_slope(&mut simulator, from, to, [10.0, 90.0], 25.0).unwrap();
        let corners = simulator.platform(slope).unwrap().corners();
        for (corner, expected) in
            [(0, [from[0], from[1], 10.0]), (1, [to[0], to[1], 10.0]), (4, [from[0], from[1], 90.0])]
        {
            assert!(
                (corners[corner] - Vector3::from(expected)).norm() < 0.001,
                "{corner}: {}",
                corners[corner]
            );
        }
        assert!(((corners[3] - corners[0]).norm() - 25.0).abs() < 0.001);
    }
}

#[test]
fn an_invalid_slope_is_refused() {
    let mut simulator = simulator();
    for (from, to, z, thickness) in [
        ([0.0, 0.0], [0.0, 50.0], [0.0, 10.0], 5.0),
        ([9.0, 0.0], [0.0, 50.0], [0.0, 10.0], 5.0),
        ([0.0, f32::NAN], [9.0, 50.0], [0.0, 10.0], 5.0),
        ([0.0, -f32::MAX], [9.0, f32::MAX], [0.0, 10.0], 5.0),
        ([0.0, 0.0], [f32::INFINITY, 50.0], [0.0, 10.0], 5.0),
        ([0.0, 0.0], [9.0, 50.0], [10.0, 10.0], 5.0),
        ([0.0, 0.0], [9.0, 50.0], [0.0, 10.0], 0.0),
    ] {
        assert!(spawn_slope(&mut simulator, from, to, z, thickness).is_err());
        assert_eq!(simulator.platforms().count(), 0);
    }
}

#[test]
fn a_later_choice_of_the_friction_type_acts_from_the_next_update_on() {
    let mut simulator = simulator();
    let crate_box = |friction| Prism::new([30.0, 20.0, 30.0]).friction(friction);
    let floor = spawn_block(&mut simulator, [-500.0, 900.0], [0.0, 10.0], [-400.0, 400.0]).unwrap();
    simulator.platform_mut(floor).unwrap().set_friction_coefficient(0.2);
    let on_platform = spawn(&mut simulator, crate_box(0.6).at([0.0, 10.0, 0.0])).unwrap();
    // Its ground has its own friction, unless a setting changes it.
    let on_ground = spawn(&mut simulator, crate_box(0.6).at([0.0, 0.0, 900.0])).unwrap();
    simulator.body_mut(on_ground.body).unwrap().ground_mut().set_friction_coefficient(0.2);
    (0..60).for_each(|_| simulator.update(1.0 / 120.0));
    let bodies = [on_platform, on_ground].map(|made| made.body);
    // Along X and Z at once: 300 px/s.
    let start = Vector3::new(240.0, 0.0, 180.0);
    for (kind, both) in [
        (FrictionType::Average, 0.4),
        (FrictionType::Minimum, 0.2),
        (FrictionType::Average, 0.4),
        (FrictionType::Minimum, 0.2),
    ] {
        simulator.set_friction_type(kind);
        assert_eq!(simulator.friction_type(), kind);
        for body in bodies {
            let mut view = simulator.body_mut(body).unwrap();
            view.set_velocity3d(start);
            let place = view.position3d();
            view.set_position3d(Vector3::new(0.0, place.y, if body == bodies[0] { 0.0 } else { 900.0 }));
        }
        (0..60).for_each(|_| simulator.update(1.0 / 120.0));
        for body in bodies {
            // Half a second of both times 900 px/s², a step of 60 more or less.
            let lost = 300.0 - simulator.body(body).unwrap().velocity3d().norm();
            assert!((lost - both * 450.0).abs() < 0.02 * both * 450.0, "{kind:?}: {lost}");
        }
    }
}
