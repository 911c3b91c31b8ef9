//! Ids with the kind of their object in their type.

use conformance::fixtures::plane::{add_box, simulator, v};
use farseer_core::{Error, JointFactory, LinearSpring, PinJoint, RevoluteJoint, SpringFactory, TypedJointId};

#[test]
fn a_typed_id_finds_the_joint_by_its_own_type() {
    let mut simulator = simulator(0.0);
    let [a, b] = [0.0, 50.0].map(|x| add_box(&mut simulator, (10.0, 10.0), v(x, 0.0)).0);
    let joint = JointFactory::create_pin_joint_in(&mut simulator, a, v(0.0, 0.0), b, v(0.0, 0.0)).unwrap();
    let pin: TypedJointId<PinJoint> = simulator.typed_joint(joint).unwrap();
    simulator[pin].set_target_distance(40.0).unwrap();
    assert_eq!(simulator.joint_as::<PinJoint>(joint).unwrap().target_distance(), 40.0);
    assert_eq!(pin.id(), joint);
}

#[test]
fn an_id_of_another_kind_is_an_error_that_names_the_kind() {
    let mut simulator = simulator(0.0);
    let [a, b] = [0.0, 50.0].map(|x| add_box(&mut simulator, (10.0, 10.0), v(x, 0.0)).0);
    let joint = JointFactory::create_pin_joint_in(&mut simulator, a, v(0.0, 0.0), b, v(0.0, 0.0)).unwrap();
    let error = simulator.typed_joint::<RevoluteJoint>(joint).unwrap_err();
    assert!(matches!(error, Error::WrongKind { argument: "joint", expected: "RevoluteJoint" }), "{error}");
}

#[test]
#[should_panic(expected = "SpringId { index: 0, generation: 0 }")]
fn indexing_by_a_typed_id_that_has_gone_stale_panics_and_names_it() {
    let mut simulator = simulator(0.0);
    let [a, b] = [0.0, 50.0].map(|x| add_box(&mut simulator, (10.0, 10.0), v(x, 0.0)).0);
    let spring =
        SpringFactory::create_linear_spring_in(&mut simulator, a, v(0.0, 0.0), b, v(0.0, 0.0), 1.0, 1.0)
            .unwrap();
    let typed = simulator.typed_spring::<LinearSpring>(spring).unwrap();
    simulator.dispose(spring).unwrap();
    simulator.update(0.01);
    let _ = &simulator[typed];
}
