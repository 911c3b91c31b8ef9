//! Checks of behaviour chapter 14 on paths; those on curves are in `chapter_14_curves`.

use conformance::fixtures::plane::{simulator, v};
use conformance::units::assert_words;
use farseer_core::math::Vector2;
use farseer_core::{
    CollisionCategory, ComplexFactory, Error, FixedRevoluteJoint, JointFactory, LinearSpring, LinkType, Path,
    PhysicsSimulator, PinJoint, RevoluteJoint, SpringFactory, Vertices,
};
use proptest::prelude::*;

/// The chain of checks 7 and 9.
fn pinned_chain(
    simulator: &mut PhysicsSimulator,
    (start, end): (Vector2, Vector2),
    pin_end: bool,
    link_type: LinkType,
) -> Path {
    let factory = ComplexFactory::default();
    factory.create_pinned_chain(simulator, start, end, 20.0, 10.0, 1.0, true, pin_end, link_type).unwrap()
}

/// Positions and rotations of some bodies.
fn expect_places(simulator: &PhysicsSimulator, path: &Path, expected: &[(usize, &str, &str)]) {
    for &(index, position, rotation) in expected {
        let body = &simulator[path.bodies()[index]];
        assert_words(&body.position(), position);
        assert_words(&body.rotation(), rotation);
    }
}

/// Check 7.
#[test]
fn a_chain_of_revolute_joints_is_placed_and_linked() {
    let mut simulator = simulator(0.0);
    let ends = (v(150.0, 100.0), v(200.0, 300.0));
    let chain = pinned_chain(&mut simulator, ends, false, LinkType::RevoluteJoint);
    assert_eq!((chain.bodies().len(), chain.joints().len()), (10, 10));
    let places = [
        (0, "43187325 42db9926", "3fa9b464"),
        (1, "431d5321 43014c82", "3fa9b467"),
        (5, "4330f9af 434fe6bc", "3fa9b461"),
        (9, "4344a052 438f40a3", "3fa9b465"),
    ];
    expect_places(&simulator, &chain, &places);
    let anchor = |index: usize| simulator.joint_as::<RevoluteJoint>(chain.joints()[index]).unwrap().anchor();
    assert_words(&anchor(0), "431ae323 42ef1915");
    assert_words(&anchor(8), "43422b7e 438a56fa");
    let pin: &FixedRevoluteJoint = simulator.joint_as(chain.joints()[9]).unwrap();
    assert_eq!((pin.body(), pin.anchor()), (chain.bodies()[0], v(150.0, 100.0)));
    for &joint in chain.joints() {
        assert_eq!((simulator[joint].bias_factor(), simulator[joint].softness()), (0.01, 0.05));
    }
    assert_words(&simulator[chain.bodies()[3]].moment_of_inertia(), "4226aaab");
}

/// Check 8.
#[test]
fn the_last_control_point_moves_to_a_stale_point() {
    let make = |end: Vector2, width: f32| {
        let mut simulator = simulator(0.0);
        let chain = ComplexFactory::default()
            .create_chain(&mut simulator, v(0.0, 0.0), end, width, 2.0, 1.0, LinkType::RevoluteJoint)
            .unwrap();
        let x: Vec<f32> = chain.bodies().iter().map(|&body| simulator[body].position().x).collect();
        (x, chain.control_points()[2])
    };
    let (x, end) = make(v(53.0, 0.0), 7.0);
    assert_eq!(x.len(), 8);
    assert_words(&v(x[5], x[6]), "421b6639 4237b3df");
    assert_eq!(x[7], 53.0);
    assert_words(&end, "4253d8d2 00000000");
    let (x, end) = make(v(10.0, 0.0), 9.0);
    assert_eq!((x.len(), x[1]), (2, 10.0));
    assert_words(&x[0], "409014ac");
    assert_words(&end, "41100b33 00000000");
}

/// Check 9.
#[test]
fn pins_are_a_body_width_long_from_the_second_on() {
    let mut simulator = simulator(0.0);
    let ends = (v(250.0, 100.0), v(300.0, 300.0));
    let chain = pinned_chain(&mut simulator, ends, true, LinkType::PinJoint);
    assert_eq!(chain.joints().len(), 11);
    let pin = |index: usize| simulator.joint_as::<PinJoint>(chain.joints()[index]).unwrap();
    assert_words(&pin(0).target_distance(), "3dcc8c69");
    for index in 0..9 {
        assert!(index == 0 || pin(index).target_distance() == 20.0);
        assert_eq!((pin(index).anchor1(), pin(index).anchor2()), (v(10.0, 0.0), v(-10.0, 0.0)));
    }
    let end: &FixedRevoluteJoint = simulator.joint_as(chain.joints()[10]).unwrap();
    assert_eq!((end.body(), end.anchor()), (*chain.bodies().last().unwrap(), v(300.0, 300.0)));
}

/// Check 10.
#[test]
fn springs_of_a_chain_take_the_rest_length_factor() {
    let mut simulator = simulator(0.0);
    let factory = ComplexFactory {
        spring_constant: 300.0,
        damping_constant: 10.0,
        spring_rest_length_factor: 0.1,
        ..ComplexFactory::default()
    };
    let (start, end) = (v(650.0, 100.0), v(600.0, 600.0));
    let link = LinkType::LinearSpring;
    let chain = factory
        .create_chain_with_link_width(&mut simulator, start, end, 20.0, 10.0, 40.0, 1.0, true, false, link)
        .unwrap();
    assert_eq!((chain.bodies().len(), chain.springs().len(), chain.joints().len()), (12, 11, 1));
    for (index, &id) in chain.springs().iter().enumerate() {
        let spring: &LinearSpring = simulator.spring_as(id).unwrap();
        assert_eq!((spring.attach_point1(), spring.attach_point2()), (v(-10.0, 0.0), v(10.0, 0.0)));
        assert_words(&spring.rest_length(), if index == 0 { "41a298c6" } else { "40000000" });
        assert_eq!((simulator[id].spring_constant(), simulator[id].damping_constant()), (300.0, 10.0));
    }
    expect_places(&simulator, &chain, &[(0, "44220003 42effee7", "4099fc63")]);
    assert_words(&simulator[chain.bodies()[0]].total_rotation(), "bfbc4de0");
}

/// Check 11.
#[test]
fn bodies_of_a_vertical_chain_are_not_turned() {
    let mut simulator = simulator(0.0);
    let chain = ComplexFactory::default()
        .create_chain_of_links(&mut simulator, v(10.0, 0.0), v(10.0, 100.0), 4, None, 1.0, LinkType::PinJoint)
        .unwrap();
    let places = ["4148ca99", "42166649", "427ae77d", "42afb458"];
    assert_eq!(chain.bodies().len(), places.len());
    for (&body, y) in chain.bodies().iter().zip(places) {
        assert_words(&simulator[body].position().y, y);
        assert_eq!(simulator[body].rotation(), 0.0);
    }
    for (&joint, distance) in chain.joints().iter().zip(["420d9066", "41c80000", "41c80000"]) {
        let pin: &PinJoint = simulator.joint_as(joint).unwrap();
        assert_words(&pin.target_distance(), distance);
        assert_eq!((pin.anchor1(), pin.anchor2()), (v(-12.5, 0.0), v(12.5, 0.0)));
    }
}

/// Check 12.
#[test]
fn a_track_closes_on_itself() {
    let mut simulator = simulator(0.0);
    let around = [
        (-15, -50),
        (-50, -50),
        (-100, -25),
        (-100, 25),
        (-50, 50),
        (50, 50),
        (100, 25),
        (100, -25),
        (50, -50),
        (-10, -50),
    ];
    let points: Vec<Vector2> = around.iter().map(|&(x, y)| v(400.0 + x as f32, 500.0 + y as f32)).collect();
    let track = ComplexFactory::default()
        .create_track(&mut simulator, &points, 20.0, 10.0, 3.0, true, 2, LinkType::RevoluteJoint)
        .unwrap();
    assert_eq!((track.bodies().len(), track.geoms().len(), track.joints().len()), (26, 26, 26));
    let places = [
        (0, "43bb7c7b 43e09b33", "3db8b26e"),
        (12, "43c9f76a 440a4705", "40c8cd9d"),
        (25, "43c60456 43e0f1a6", "40c7d0c4"),
    ];
    expect_places(&simulator, &track, &places);
    let closing: &RevoluteJoint = simulator.joint_as(track.joints()[25]).unwrap();
    assert_words(&closing.anchor(), "43c0c068 43e0c66c");
    assert_eq!((closing.body1(), closing.body2()), (track.bodies()[0], track.bodies()[25]));
    for (&joint, &geom) in track.joints().iter().zip(track.geoms()) {
        assert_eq!((simulator[joint].bias_factor(), simulator[joint].softness()), (0.2, 0.01));
        assert_eq!(simulator[geom].collision_group(), 2);
    }
}

fn path_through(points: &[(f32, f32)], width: f32) -> Path {
    let mut path = Path::new(width, 5.0, 1.0, false).unwrap();
    for &(x, y) in points {
        path.add(v(x, y)).unwrap();
    }
    path
}

const CORNER: [(f32, f32); 3] = [(0.0, 0.0), (100.0, 0.0), (100.0, 2.0)];

/// Check 13.
#[test]
fn control_points_are_found_in_a_box_of_six_units() {
    let path = path_through(&CORNER, 10.0);
    let found = [(2.9, 0.0), (3.0, 0.0), (101.0, 1.0), (50.0, 1.0)]
        .map(|(x, y)| path.point_in_control_point(v(x, y)));
    assert_eq!(found, [Some(0), None, Some(1), None]);
}

/// Check 14.
#[test]
fn an_update_appends_a_row_only_after_a_change() {
    let mut simulator = simulator(0.0);
    let mut path = path_through(&CORNER, 10.0);
    let mut count = |path: &mut Path| {
        path.update(&mut simulator).unwrap();
        path.bodies().len()
    };
    assert_eq!((count(&mut path), count(&mut path)), (11, 11));
    path.move_control_point(v(90.0, 30.0), 1).unwrap();
    assert_eq!(count(&mut path), 24);
}

/// Check 15.
#[test]
fn normals_and_their_angles_are_those_of_the_original() {
    for (x, y, angle) in [
        (1.0, 2.0, "beed6338"),
        (1.0, -2.0, "3eed6338"),
        (-1.0, 2.0, "3eed6338"),
        (-1.0, -2.0, "beed6338"),
        (0.0, 1.0, "00000000"),
        (1.0, 0.0, "00000000"),
    ] {
        assert_words(&Vertices::find_normal_angle(v(x, y)), angle);
    }
    let (a, b) = (v(0.0, 0.0), v(3.0, 4.0));
    assert_words(&Vertices::find_edge_normal(a, b), "3f4ccccd bf19999a");
    assert_words(&Vertices::find_vertex_normal(a, b, v(3.0, 9.0)), "3fe66666 bf19999a");
    assert_eq!(Vertices::find_midpoint(v(1.0, 5.0), v(4.0, -2.0)), v(2.5, 1.5));
}

fn invalid_argument(error: &Error) -> &'static str {
    match error {
        Error::InvalidArgument { argument, .. } => argument,
        other => panic!("{other}"),
    }
}

/// The original never ends there.
#[test]
fn endless_placements_are_errors() {
    let line = [(0.0, 0.0), (50.0, 0.0), (100.0, 0.0)];
    let one_spot = [(5.0, 5.0), (5.0, 5.0), (5.0, 5.0)];
    for (points, width) in [(line, 0.0), (line, -1.0), (line, 101.0), (one_spot, 1.0)] {
        let mut simulator = simulator(0.0);
        let mut path = path_through(&points, width);
        let before = path.clone();
        assert_eq!(invalid_argument(&path.update(&mut simulator).unwrap_err()), "link_width");
        assert_eq!((path, simulator.bodies().count()), (before, 0));
    }
    let mut simulator = simulator(0.0);
    assert_eq!(
        invalid_argument(&path_through(&line[..1], 1.0).update(&mut simulator).unwrap_err()),
        "link_width"
    );
    assert_eq!(
        invalid_argument(&path_through(&[], 1.0).update(&mut simulator).unwrap_err()),
        "control_points"
    );
}

/// Nearly as far away as the path reaches: the walk ends beyond the last key.
#[test]
fn a_link_as_long_as_the_path_is_placed() {
    let mut simulator = simulator(0.0);
    let mut path = path_through(&[(0.0, 0.0), (50.0, 0.0), (100.0, 0.0)], 100.0);
    path.update(&mut simulator).unwrap();
    assert_eq!(path.bodies().len(), 1);
}

#[test]
fn a_path_of_bodies_without_extent_or_mass_is_refused() {
    let mut simulator = simulator(0.0);
    for (height, mass, argument) in [(0.0, 1.0, "height"), (1.0, 0.0, "mass"), (1.0, -1.0, "mass")] {
        let mut path = Path::new(10.0, height, mass, false).unwrap();
        path.add(v(0.0, 0.0)).unwrap();
        path.add(v(50.0, 10.0)).unwrap();
        assert_eq!(invalid_argument(&path.update(&mut simulator).unwrap_err()), argument);
        assert!(path.bodies().is_empty() && simulator.bodies().count() == 0);
    }
    assert!(Path::new(f32::NAN, 1.0, 1.0, false).is_err());
    assert!(path_through(&CORNER, 1.0).add(v(f32::INFINITY, 0.0)).is_err());
}

#[test]
fn control_points_without_a_finite_curve_are_refused() {
    let mut simulator = simulator(0.0);
    let mut path = path_through(&[(-3e38, 0.0), (3e38, 0.0), (-3e38, 1.0)], 10.0);
    assert_eq!(invalid_argument(&path.update(&mut simulator).unwrap_err()), "control_points");
    assert_eq!(simulator.bodies().count(), 0);
}

#[test]
fn control_points_are_removed_by_value_and_by_index() {
    let mut path = path_through(&[(1.0, 1.0), (2.0, 2.0), (1.0, 1.0)], 1.0);
    path.remove(v(1.0, 1.0));
    assert_eq!(path.control_points().to_vec(), [v(2.0, 2.0), v(1.0, 1.0)]);
    path.remove(v(7.0, 7.0));
    path.remove_at(0).unwrap();
    assert_eq!(path.control_points().to_vec(), [v(1.0, 1.0)]);
    assert!(path.remove_at(1).is_err() && path.move_control_point(v(0.0, 0.0), 1).is_err());
}

/// The previous link is looked up by its index in the complete list.
#[test]
fn linking_uses_joints_of_earlier_calls() {
    let mut simulator = simulator(0.0);
    let mut path = path_through(&[(0.0, 0.0), (50.0, 1.0), (100.0, 0.0)], 20.0);
    path.update(&mut simulator).unwrap();
    let foreign =
        JointFactory::create_fixed_revolute_joint(&mut simulator, path.bodies()[0], v(0.0, 0.0)).unwrap();
    path.add_joint(foreign);
    let error = path.link_bodies(&mut simulator, LinkType::PinJoint, 0.0, 0.0, 0.0, 0.0).unwrap_err();
    assert_eq!(error, Error::WrongKind { argument: "joint", expected: "PinJoint" });
    assert_eq!(path.joints(), [foreign]);

    path.joints_mut().clear();
    let (a, b) = (path.bodies()[0], path.bodies()[1]);
    let pin = JointFactory::create_pin_joint(&mut simulator, a, v(0.0, 0.0), b, v(3.0, 4.0)).unwrap();
    path.add_joint(pin);
    path.link_bodies(&mut simulator, LinkType::PinJoint, 0.0, 0.0, 0.0, 0.0).unwrap();
    // Link 1 comes after pin 0 of the list, whose second anchor is at (3, 4); its own first anchor is at (10, 0).
    let second: &PinJoint = simulator.joint_as(path.joints()[2]).unwrap();
    assert_eq!(second.target_distance(), 65.0_f32.sqrt());
}

#[test]
fn an_endless_path_needs_a_body() {
    let mut simulator = simulator(0.0);
    let mut path = Path::new(10.0, 5.0, 1.0, true).unwrap();
    for link_type in [LinkType::RevoluteJoint, LinkType::LinearSpring] {
        let error = path.link_bodies(&mut simulator, link_type, 0.0, 0.0, 0.0, 0.0).unwrap_err();
        assert_eq!(invalid_argument(&error), "bodies");
    }
}

/// The length of the closing link of pins and springs is the width of a body, for any factor.
#[test]
fn the_closing_link_is_a_body_width_long() {
    let make = |link_type| {
        let mut simulator = simulator(0.0);
        let mut path = Path::new(10.0, 5.0, 1.0, true).unwrap();
        for (x, y) in [(0.0, 0.0), (60.0, 10.0), (60.0, 70.0), (0.0, 60.0)] {
            path.add(v(x, y)).unwrap();
        }
        path.update(&mut simulator).unwrap();
        path.link_bodies_with(&mut simulator, link_type, 1.0, 2.0, 3.0, 4.0, 0.5).unwrap();
        (simulator, path)
    };
    let (simulator, path) = make(LinkType::PinJoint);
    assert_eq!(path.joints().len(), path.bodies().len());
    let closing: &PinJoint = simulator.joint_as(*path.joints().last().unwrap()).unwrap();
    assert_eq!(closing.target_distance(), 10.0);
    let (simulator, path) = make(LinkType::LinearSpring);
    let closing: &LinearSpring = simulator.spring_as(*path.springs().last().unwrap()).unwrap();
    assert_eq!((closing.rest_length(), closing.attach_point1()), (10.0, v(-5.0, 0.0)));
}

#[test]
fn linking_refuses_non_finite_numbers_and_stale_bodies() {
    let mut simulator = simulator(0.0);
    let mut path = path_through(&CORNER, 10.0);
    path.update(&mut simulator).unwrap();
    let error =
        path.link_bodies(&mut simulator, LinkType::RevoluteJoint, f32::NAN, 0.0, 0.0, 0.0).unwrap_err();
    assert_eq!(invalid_argument(&error), "min");
    simulator.dispose(path.bodies()[3]).unwrap();
    simulator.process_added_and_removed();
    let stale = Error::StaleId { argument: "bodies" };
    assert_eq!(
        path.link_bodies(&mut simulator, LinkType::RevoluteJoint, 0.0, 0.0, 0.0, 0.0),
        Err(stale.clone())
    );
    assert_eq!(path.create_geoms(&mut simulator, 1), Err(stale));
    assert!(path.joints().is_empty() && path.geoms().is_empty() && simulator.geoms().count() == 0);
}

#[test]
fn geoms_of_a_path_share_a_group_or_categories() {
    let mut simulator = simulator(0.0);
    let mut path = path_through(&CORNER, 20.0);
    path.update(&mut simulator).unwrap();
    path.create_geoms(&mut simulator, 3).unwrap();
    let count = path.bodies().len();
    assert!(path.geoms().iter().all(|&geom| simulator[geom].collision_group() == 3));
    simulator.process_added_and_removed();
    assert!(simulator.geom_list().is_empty());
    let (one, two) = (CollisionCategory::from_bits(1), CollisionCategory::from_bits(2));
    path.create_geoms_with_categories_in(&mut simulator, one, two).unwrap();
    simulator.process_added_and_removed();
    // The objects of the first call are added, too.
    assert_eq!((path.geoms().len(), simulator.geom_list()), (2 * count, path.geoms()));
    for &geom in &path.geoms()[count..] {
        let geom = &simulator[geom];
        assert_eq!(
            (geom.collision_categories(), geom.collides_with(), geom.collision_group()),
            (one, two, 0)
        );
    }
    for (&body, &geom) in path.bodies().iter().zip(&path.geoms()[count..]) {
        assert_eq!(simulator.geom(geom).unwrap().body(), body);
    }
}

#[test]
fn a_path_enters_and_leaves_in_order() {
    let mut simulator = simulator(0.0);
    let factory = ComplexFactory::default();
    let (start, end) = (v(0.0, 0.0), v(100.0, 30.0));
    let mut path = factory
        .create_pinned_chain_in(
            &mut simulator,
            start,
            end,
            20.0,
            5.0,
            1.0,
            true,
            true,
            LinkType::RevoluteJoint,
        )
        .unwrap();
    path.create_geoms_in(&mut simulator, 1).unwrap();
    let body = path.bodies()[1];
    let spring =
        SpringFactory::create_fixed_linear_spring(&mut simulator, body, v(0.0, 0.0), end, 1.0, 1.0).unwrap();
    path.add_spring(spring);
    path.add_to_physics_simulator(&mut simulator);
    simulator.process_added_and_removed();
    assert_eq!((simulator.body_list(), simulator.geom_list()), (path.bodies(), path.geoms()));
    assert_eq!((simulator.joint_list(), simulator.spring_list()), (path.joints(), path.springs()));
    path.remove_from_physics_simulator(&mut simulator);
    simulator.process_added_and_removed();
    assert!(simulator.body_list().is_empty() && simulator.geom_list().is_empty());
    assert!(simulator.joint_list().is_empty() && simulator.spring_list().is_empty());
}

proptest! {
    /// The walk stops at the first step of 1/2000 that is far enough away. A link further on the curve is at least so
    /// far from where the search began.
    #[test]
    fn neighbours_are_at_least_a_link_apart(
        points in prop::collection::vec((-100.0_f32..100.0, -100.0_f32..100.0), 3..8),
        link in 3.0_f32..8.0,
    ) {
        let mut simulator = simulator(0.0);
        let mut path = path_through(&points, link);
        if path.update(&mut simulator).is_ok() {
            let places: Vec<Vector2> = path.bodies().iter().map(|&body| simulator[body].position()).collect();
            // The last body is put down where the path ends.
            for pair in places[..places.len() - 1].windows(2) {
                prop_assert!((pair[1] - pair[0]).norm() >= link * (1.0 - 2.0 * f32::EPSILON));
            }
            path.link_bodies(&mut simulator, LinkType::RevoluteJoint, 0.0, 0.0, 0.0, 0.0).unwrap();
            prop_assert_eq!(path.joints().len(), places.len() - 1);
        }
    }
}
