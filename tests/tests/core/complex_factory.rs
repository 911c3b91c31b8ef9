//! Chains, tracks and gravity in one call: behaviour chapter 13, section 6, and its checks 14 and 15. The placing and linking
//! of bodies is tested with chapter 14.

use conformance::fixtures::plane::{add_box, simulator, v};
use conformance::units::assert_words;
use farseer_core::{
    BodyFactory, ComplexFactory, Error, GeomFactory, GeomPlacement, GravityController, GravityType, LinkType,
    Path, PhysicsSimulator, SliderJoint,
};

/// Check 14.
#[test]
fn a_chain_of_links_has_bodies_of_the_width_that_fits() {
    let mut simulator = simulator(0.0);
    let end = v(100.0, 7.0);
    let chain = ComplexFactory::default()
        .create_chain_of_links(&mut simulator, v(0.0, 0.0), end, 8, None, 2.0, LinkType::RevoluteJoint)
        .unwrap();
    assert_eq!((chain.bodies().len(), chain.joints().len()), (8, 7));
    for &body in chain.bodies() {
        assert_words(&simulator[body].moment_of_inertia(), "41e89da0");
    }
    for &joint in chain.joints() {
        assert_words(&simulator[joint].bias_factor(), "3c23d70a");
        assert_words(&simulator[joint].softness(), "3d4ccccd");
    }
    // Width 0x41487D49 and height 0x4085A8DC, read from the moment of a body made of them.
    let (width, height) = (f32::from_bits(0x4148_7D49), f32::from_bits(0x4085_A8DC));
    let body = BodyFactory::create_rectangle_body(width, height, 2.0).unwrap();
    assert_words(&body.moment_of_inertia(), "41e89da0");
}

/// Check 15.
#[test]
fn a_fresh_factory_links_without_range_or_force() {
    let ComplexFactory { min, max, spring_constant, damping_constant, spring_rest_length_factor } =
        ComplexFactory::default();
    assert_eq!(
        [min, max, spring_constant, damping_constant, spring_rest_length_factor],
        [0.0, 0.0, 0.0, 0.0, 1.0]
    );
}

/// Check 15.
#[test]
fn gravity_controllers_are_added() {
    let mut simulator = simulator(0.0);
    let body = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0).unwrap();
    let (squared, linear) = (GravityType::DistanceSquared, GravityType::Linear);
    let by_body =
        ComplexFactory::create_gravity_controller(&mut simulator, &[body], squared, 10.0, 20.0).unwrap();
    let by_point =
        ComplexFactory::create_point_gravity_controller(&mut simulator, &[v(1.0, 2.0)], linear, 10.0, 20.0)
            .unwrap();
    simulator.process_added_and_removed();
    assert_eq!(simulator.controller_list(), [by_body, by_point]);
    let controller = |id| simulator.controller_as::<GravityController>(id).unwrap();
    assert_eq!((controller(by_body).gravity_type(), controller(by_body).strength()), (squared, 10.0));
    assert_eq!(controller(by_body).body_list(), [body]);
    assert_eq!((controller(by_point).gravity_type(), controller(by_point).radius()), (linear, 20.0));
    assert!(controller(by_point).body_list().is_empty());
    assert_eq!(controller(by_point).point_list(), [v(1.0, 2.0)]);
}

#[test]
fn sliders_of_a_chain_have_the_range_of_the_factory() {
    let mut simulator = simulator(0.0);
    let factory = ComplexFactory { min: 3.0, max: 9.0, ..ComplexFactory::default() };
    let chain = factory
        .create_chain(&mut simulator, v(0.0, 0.0), v(90.0, 10.0), 20.0, 5.0, 1.0, LinkType::SliderJoint)
        .unwrap();
    assert!(!chain.joints().is_empty());
    for &joint in chain.joints() {
        let slider: &SliderJoint = simulator.joint_as(joint).unwrap();
        assert_eq!((slider.min(), slider.max()), (3.0, 9.0));
    }
}

/// Asserts that no object is added, and none remains.
fn expect_refusal(simulator: &PhysicsSimulator, result: Result<farseer_core::Path, Error>, name: &str) {
    match result {
        Err(Error::InvalidArgument { argument, .. }) => assert_eq!(argument, name),
        other => panic!("{other:?}"),
    }
    assert_eq!((simulator.bodies().count(), simulator.geoms().count()), (0, 0));
}

#[test]
fn invalid_arguments_are_refused_and_change_no_state() {
    let mut simulator = simulator(0.0);
    let (start, end) = (v(0.0, 0.0), v(100.0, 10.0));
    let link = LinkType::RevoluteJoint;
    let factory = ComplexFactory::default();
    for links in [0, -3] {
        let result = factory.create_chain_of_links(&mut simulator, start, end, links, None, 1.0, link);
        expect_refusal(&simulator, result, "links");
    }
    let result = factory.create_chain(&mut simulator, v(f32::NAN, 0.0), end, 10.0, 5.0, 1.0, link);
    expect_refusal(&simulator, result, "start");
    // The original never ends: no body fits between the ends.
    for width in [0.0, -5.0, 200.0] {
        let result = factory.create_chain(&mut simulator, start, end, width, 5.0, 1.0, link);
        expect_refusal(&simulator, result, "link_width");
    }
    let result = factory.create_track(&mut simulator, &[start, end], 10.0, 0.0, 1.0, false, 1, link);
    expect_refusal(&simulator, result, "height");
    let factory = ComplexFactory { max: f32::INFINITY, ..factory };
    let result = factory.create_chain(&mut simulator, start, end, 10.0, 5.0, 1.0, link);
    expect_refusal(&simulator, result, "max");
}

/// A simulator with a body and geom in use, and a slot of each that was used before.
fn simulator_in_use() -> PhysicsSimulator {
    let mut simulator = simulator(0.0);
    let (gone, _) = add_box(&mut simulator, (10.0, 10.0), v(500.0, 0.0));
    add_box(&mut simulator, (10.0, 10.0), v(600.0, 0.0));
    simulator.update(0.01);
    simulator.dispose(gone).unwrap();
    simulator.update(0.01);
    simulator
}

/// The bodies are made before the rest length of the second spring turns out to be infinite.
#[test]
fn a_chain_that_fails_half_way_leaves_no_trace() {
    let mut simulator = simulator_in_use();
    let before = simulator.snapshot();
    let factory = ComplexFactory { spring_rest_length_factor: 3e38, ..ComplexFactory::default() };
    let (start, end) = (v(0.0, 0.0), v(200.0, 0.0));
    let result = factory.create_chain(&mut simulator, start, end, 20.0, 5.0, 1.0, LinkType::LinearSpring);
    assert!(result.is_err());
    assert!(simulator.snapshot() == before);
    simulator.update(0.01);
    assert!(simulator.events().is_empty(), "{:?}", simulator.events());
}

/// Flat bodies have a distance grid of too many nodes only where they lie along an axis: in the second half.
#[test]
fn a_track_that_fails_half_way_leaves_no_trace() {
    let mut simulator = simulator_in_use();
    let before = simulator.snapshot();
    let points = [v(0.0, 0.0), v(50.0, 50.0), v(100.0, 100.0), v(300.0, 100.0), v(600.0, 100.0)];
    let link = LinkType::RevoluteJoint;
    let mut path = Path::new(20.0, 1e-5, 1.0, false).unwrap();
    for point in points {
        path.add(point).unwrap();
    }
    path.update(&mut simulator).unwrap();
    let (with_bodies, bodies) = (simulator.snapshot(), path.bodies().to_vec());
    assert!(path.create_geoms(&mut simulator, 1).is_err());
    assert!(path.geoms().is_empty() && simulator.snapshot() == with_bodies);
    let placement = GeomPlacement::default();
    GeomFactory::create_rectangle_geom(&mut simulator, bodies[0], 20.0, 1e-5, placement)
        .expect("the first geom is not the one that fails");

    simulator.restore(&before).unwrap();
    let result =
        ComplexFactory::default().create_track(&mut simulator, &points, 20.0, 1e-5, 1.0, false, 1, link);
    assert!(result.is_err());
    assert!(simulator.snapshot() == before);
}

/// A bridge held at both ends sags but stays.
#[test]
fn a_pinned_chain_hangs_from_its_ends() {
    let mut simulator = simulator(100.0);
    let (start, end) = (v(0.0, 0.0), v(200.0, 0.0));
    let chain = ComplexFactory::default()
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
    for _ in 0..500 {
        simulator.update(0.01);
    }
    let position = |index: usize| simulator[chain.bodies()[index]].position();
    let count = chain.bodies().len();
    assert!(position(count / 2).y > position(0).y + 5.0, "it sags");
    assert!((position(0) - start).norm() < 40.0 && (position(count - 1) - end).norm() < 40.0, "it is held");
}
