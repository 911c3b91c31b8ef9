//! Joints and springs that are made without bodies and get them later, as when a scene is read from a file (behaviour chapters
//! 10 and 11).

use crate::joint_bench::add_body;
use conformance::fixtures::plane::{self, v};
use farseer_core::{
    AngleJoint, AngleLimitJoint, AngleSpring, BodyId, Error, FixedAngleJoint, FixedAngleLimitJoint,
    FixedAngleSpring, FixedLinearSpring, FixedRevoluteJoint, JointFactory, JointId, LinearSpring,
    PhysicsSimulator, PinJoint, Result, RevoluteJoint, SliderJoint, SpringFactory, SpringId, WeldJoint,
};
use serde_json::{Value, json};

fn two_bodies() -> (PhysicsSimulator, BodyId, BodyId) {
    let mut simulator = plane::simulator(10.0);
    let a = add_body(&mut simulator, (2.0, 3.0), v(1.0, 2.0), 0.5);
    let b = add_body(&mut simulator, (5.0, 7.0), v(4.0, 6.0), 0.5);
    (simulator, a, b)
}

type Make<I> = fn(&mut PhysicsSimulator, BodyId, BodyId) -> Result<I>;

/// Joints of all kinds, from the factory and value by value.
const JOINTS: [(&str, Make<JointId>, Make<JointId>); 9] = [
    (
        "AngleJoint",
        |s, a, b| JointFactory::create_angle_joint(s, a, b),
        |s, a, b| {
            let joint = s.create_empty_joint::<AngleJoint>();
            with_two_bodies(s, joint, a, b)
        },
    ),
    (
        "AngleLimitJoint",
        |s, a, b| JointFactory::create_angle_limit_joint(s, a, b, -0.1, 0.2),
        |s, a, b| {
            let joint = s.create_empty_joint::<AngleLimitJoint>();
            let limits = s.joint_as_mut::<AngleLimitJoint>(joint)?;
            limits.set_lower_limit(-0.1)?;
            limits.set_upper_limit(0.2)?;
            with_two_bodies(s, joint, a, b)
        },
    ),
    (
        "FixedAngleJoint",
        |s, a, _| JointFactory::create_fixed_angle_joint(s, a),
        |s, a, _| {
            let joint = s.create_empty_joint::<FixedAngleJoint>();
            s.set_joint_body1(joint, a).map(|()| joint)
        },
    ),
    (
        "FixedAngleLimitJoint",
        |s, a, _| JointFactory::create_fixed_angle_limit_joint(s, a, -0.1, 0.2),
        |s, a, _| {
            let joint = s.create_empty_joint::<FixedAngleLimitJoint>();
            s.set_joint_body1(joint, a)?;
            let limits = s.joint_as_mut::<FixedAngleLimitJoint>(joint)?;
            limits.set_lower_limit(-0.1)?;
            limits.set_upper_limit(0.2).map(|()| joint)
        },
    ),
    (
        "FixedRevoluteJoint",
        |s, a, _| JointFactory::create_fixed_revolute_joint(s, a, v(3.0, 0.0)),
        |s, a, _| {
            let joint = s.create_empty_joint::<FixedRevoluteJoint>();
            s.set_joint_body1(joint, a)?;
            s.set_joint_anchor(joint, v(3.0, 0.0)).map(|()| joint)
        },
    ),
    (
        "PinJoint",
        |s, a, b| JointFactory::create_pin_joint(s, a, v(0.5, 0.0), b, v(0.0, -0.5)),
        |s, a, b| {
            let joint = s.create_empty_joint::<PinJoint>();
            s.set_joint_body1(joint, a)?;
            s.set_joint_anchor1(joint, v(0.5, 0.0))?;
            s.set_joint_body2(joint, b)?;
            s.set_joint_anchor2(joint, v(0.0, -0.5))?;
            let pin = s.joint_as::<PinJoint>(joint)?;
            let ends = [(a, pin.anchor1()), (b, pin.anchor2())];
            let [one, two] = ends.map(|(body, anchor)| s[body].get_world_position(anchor));
            let distance = farseer_core::math::vector2::length(two - one);
            s.joint_as_mut::<PinJoint>(joint)?.set_target_distance(distance).map(|()| joint)
        },
    ),
    (
        "RevoluteJoint",
        |s, a, b| JointFactory::create_revolute_joint(s, a, b, v(2.0, 3.0)),
        |s, a, b| {
            let joint = s.create_empty_joint::<RevoluteJoint>();
            with_two_bodies(s, joint, a, b)?;
            s.set_joint_anchor(joint, v(2.0, 3.0)).map(|()| joint)
        },
    ),
    (
        "SliderJoint",
        |s, a, b| JointFactory::create_slider_joint(s, a, v(0.5, 0.0), b, v(0.0, -0.5), 1.0, 4.0),
        |s, a, b| {
            let joint = s.create_empty_joint::<SliderJoint>();
            s.set_joint_body2(joint, b)?;
            s.set_joint_anchor2(joint, v(0.0, -0.5))?;
            s.set_joint_body1(joint, a)?;
            s.set_joint_anchor1(joint, v(0.5, 0.0))?;
            let slider = s.joint_as_mut::<SliderJoint>(joint)?;
            slider.set_max(4.0)?;
            slider.set_min(1.0).map(|()| joint)
        },
    ),
    (
        "WeldJoint",
        |s, a, b| JointFactory::create_weld_joint(s, a, b, v(2.0, 3.0)),
        |s, a, b| {
            let joint = s.create_empty_joint::<WeldJoint>();
            with_two_bodies(s, joint, a, b)?;
            s.set_joint_anchor(joint, v(2.0, 3.0)).map(|()| joint)
        },
    ),
];

fn with_two_bodies(s: &mut PhysicsSimulator, joint: JointId, a: BodyId, b: BodyId) -> Result<JointId> {
    s.set_joint_body1(joint, a)?;
    s.set_joint_body2(joint, b).map(|()| joint)
}

/// Springs of all kinds, from the factory and value by value.
const SPRINGS: [(&str, Make<SpringId>, Make<SpringId>); 4] = [
    (
        "AngleSpring",
        |s, a, b| SpringFactory::create_angle_spring(s, a, b, 9.0, 0.3),
        |s, a, b| {
            let spring = s.create_empty_spring::<AngleSpring>();
            s.set_spring_body1(spring, a)?;
            s.set_spring_body2(spring, b)?;
            with_constants(s, spring)
        },
    ),
    (
        "FixedAngleSpring",
        |s, a, _| SpringFactory::create_fixed_angle_spring(s, a, 9.0, 0.3),
        |s, a, _| {
            let spring = s.create_empty_spring::<FixedAngleSpring>();
            s.spring_as_mut::<FixedAngleSpring>(spring)?.set_target_angle(0.5)?;
            s.set_spring_body1(spring, a)?;
            with_constants(s, spring)
        },
    ),
    (
        "FixedLinearSpring",
        |s, a, _| {
            let points = (v(0.0, 0.0), v(1.0, -10.0));
            SpringFactory::create_fixed_linear_spring(s, a, points.0, points.1, 9.0, 0.3)
        },
        |s, a, _| {
            let spring = s.create_empty_spring::<FixedLinearSpring>();
            let ends = s.spring_as_mut::<FixedLinearSpring>(spring)?;
            ends.set_rest_length(12.0)?;
            ends.set_world_attach_point(v(1.0, -10.0))?;
            s.set_spring_body1(spring, a)?;
            with_constants(s, spring)
        },
    ),
    (
        "LinearSpring",
        |s, a, b| SpringFactory::create_linear_spring(s, a, v(0.0, 0.0), b, v(0.0, 0.0), 9.0, 0.3),
        |s, a, b| {
            let spring = s.create_empty_spring::<LinearSpring>();
            s.spring_as_mut::<LinearSpring>(spring)?.set_rest_length(5.0)?;
            s.set_spring_body1(spring, a)?;
            s.set_spring_body2(spring, b)?;
            with_constants(s, spring)
        },
    ),
];

fn with_constants(s: &mut PhysicsSimulator, spring: SpringId) -> Result<SpringId> {
    s[spring].set_spring_constant(9.0)?;
    s[spring].set_damping_constant(0.3).map(|()| spring)
}

/// Bits of two thrown bodies after a second with a joint or spring.
fn thrown<I: Into<farseer_core::ObjectId>>(make: Make<I>) -> Vec<u8> {
    let (mut simulator, a, b) = two_bodies();
    let made = make(&mut simulator, a, b).unwrap();
    simulator.add(made).unwrap();
    simulator[a].set_linear_velocity(v(3.0, -2.0));
    simulator[b].set_angular_velocity(4.0);
    for _ in 0..100 {
        simulator.update(0.01);
    }
    simulator.snapshot()
}

#[test]
fn joints_that_get_their_bodies_later_act_as_those_of_the_factory() {
    for (name, made, given) in JOINTS {
        assert_eq!(thrown(given), thrown(made), "{name}");
    }
}

#[test]
fn springs_that_get_their_bodies_later_act_as_those_of_the_factory() {
    for (name, made, given) in SPRINGS {
        assert_eq!(thrown(given), thrown(made), "{name}");
    }
}

#[test]
fn joints_without_bodies_have_the_defaults_of_their_kinds() {
    let (mut s, ..) = two_bodies();
    let [angle, fixed, pin, slider] = [
        s.create_empty_joint::<AngleLimitJoint>(),
        s.create_empty_joint::<FixedRevoluteJoint>(),
        s.create_empty_joint::<PinJoint>(),
        s.create_empty_joint::<SliderJoint>(),
    ];
    assert_eq!([angle, fixed, pin, slider].map(|joint| s[joint].bias_factor()), [0.2, 0.8, 0.2, 0.2]);
    for joint in [angle, fixed, pin, slider] {
        let joint = &s[joint];
        assert_eq!((joint.softness(), joint.breakpoint(), joint.enabled()), (0.0, f32::MAX, true));
        assert!(s.body(joint.body1()).is_none());
    }
    assert_eq!(s[fixed].body2(), None);
    assert!(s[pin].body2().is_some_and(|body| s.body(body).is_none()));
    let angle = s.joint_as::<AngleLimitJoint>(angle).unwrap();
    assert_eq!((angle.lower_limit(), angle.upper_limit(), angle.slop()), (0.0, 0.0, 0.01));
    assert_eq!(s.joint_as::<FixedRevoluteJoint>(fixed).unwrap().max_impulse(), f32::MAX);
    let pin = s.joint_as::<PinJoint>(pin).unwrap();
    assert_eq!((pin.target_distance(), pin.anchor1(), pin.world_anchor2()), (0.0, v(0.0, 0.0), v(0.0, 0.0)));
    let slider = s.joint_as::<SliderJoint>(slider).unwrap();
    assert_eq!((slider.min(), slider.max(), slider.slop()), (0.0, 0.0, 0.01));
}

#[test]
fn springs_without_bodies_have_the_defaults_of_their_kinds() {
    let (mut s, ..) = two_bodies();
    let (turning, pulling) =
        (s.create_empty_spring::<AngleSpring>(), s.create_empty_spring::<LinearSpring>());
    for spring in [turning, pulling] {
        let spring = &s[spring];
        assert_eq!((spring.spring_constant(), spring.damping_constant()), (0.0, 0.0));
        assert_eq!((spring.breakpoint(), spring.enabled()), (f32::MAX, true));
        assert!(s.body(spring.body1()).is_none());
    }
    let turning = s.spring_as::<AngleSpring>(turning).unwrap();
    assert_eq!(
        (turning.target_angle(), turning.max_torque(), turning.torque_multiplier()),
        (0.0, f32::MAX, 1.0)
    );
    assert_eq!(s.spring_as::<LinearSpring>(pulling).unwrap().rest_length(), 0.0);
}

#[test]
fn adding_names_the_body_that_is_missing() {
    let (mut s, a, b) = two_bodies();
    let missing = |argument, missing| Err(Error::MissingBody { argument, missing });
    let (hinge, pivot) =
        (s.create_empty_joint::<RevoluteJoint>(), s.create_empty_joint::<FixedRevoluteJoint>());
    let spring = s.create_empty_spring::<LinearSpring>();
    assert_eq!(s.add(hinge), missing("joint", "body1"));
    assert_eq!(s.add(pivot), missing("joint", "body"));
    assert_eq!(s.add(spring), missing("spring", "body1"));
    s.set_joint_body1(hinge, a).unwrap();
    s.set_spring_body1(spring, a).unwrap();
    assert_eq!(s.add(hinge), missing("joint", "body2"));
    assert_eq!(s.add(spring), missing("spring", "body2"));
    s.update(0.01);
    assert!(s.joint_list().is_empty() && s.spring_list().is_empty());

    s.set_joint_body2(hinge, b).unwrap();
    s.set_spring_body2(spring, b).unwrap();
    s.set_joint_body1(pivot, b).unwrap();
    for joint in [hinge, pivot] {
        s.add(joint).unwrap();
    }
    s.add(spring).unwrap();
    s.update(0.01);
    assert_eq!((s.joint_list(), s.spring_list()), (&[hinge, pivot][..], &[spring][..]));
}

/// As recorded from the original, which throws.
#[test]
fn an_anchor_without_its_body_is_refused() {
    let (mut s, a, _) = two_bodies();
    let missing = |missing| Err(Error::MissingBody { argument: "joint", missing });
    let pivot = s.create_empty_joint::<FixedRevoluteJoint>();
    assert_eq!(s.set_joint_anchor(pivot, v(1.0, 1.0)), missing("body"));
    let hinge = s.create_empty_joint::<RevoluteJoint>();
    let weld = s.create_empty_joint::<WeldJoint>();
    for joint in [hinge, weld] {
        assert_eq!(s.set_joint_anchor(joint, v(1.0, 1.0)), missing("body1"));
        assert_eq!(s.joint_current_anchor(joint).map(|_| ()), missing("body1"));
        s.set_joint_body1(joint, a).unwrap();
        assert_eq!(s.set_joint_anchor(joint, v(1.0, 1.0)), missing("body2"));
    }
    assert_eq!(s.joint_as::<RevoluteJoint>(hinge).unwrap().anchor(), v(0.0, 0.0));
    let pin = s.create_empty_joint::<PinJoint>();
    assert_eq!(s.set_joint_anchor1(pin, v(1.0, 1.0)), missing("body1"));
    assert_eq!(s.set_joint_anchor2(pin, v(1.0, 1.0)), missing("body2"));
}

#[test]
fn joints_and_springs_without_bodies_are_saved() {
    let (mut s, a, b) = two_bodies();
    let hinge = s.create_empty_joint::<RevoluteJoint>();
    let spring = s.create_empty_spring::<LinearSpring>();
    s.set_joint_body1(hinge, a).unwrap();
    let mut restored = s.clone();
    restored.restore(&s.snapshot()).unwrap();
    let text = serde_json::to_string(&s).unwrap();
    let parsed: PhysicsSimulator = serde_json::from_str(&text).unwrap();
    let ends = [s, restored, parsed].map(|mut twin| {
        assert_eq!(twin.add(hinge), Err(Error::MissingBody { argument: "joint", missing: "body2" }));
        twin.set_joint_body2(hinge, b).unwrap();
        twin.set_spring_body1(spring, b).unwrap();
        twin.set_spring_body2(spring, a).unwrap();
        twin[spring].set_spring_constant(20.0).unwrap();
        twin.add(hinge).unwrap();
        twin.add(spring).unwrap();
        for _ in 0..50 {
            twin.update(0.01);
        }
        twin.snapshot()
    });
    assert_eq!(ends[1], ends[0]);
    assert_eq!(ends[2], ends[0]);
}

/// Replaces every value under a key.
fn replace(value: &mut Value, key: &str, new: &Value) {
    match value {
        Value::Object(map) => {
            for (name, value) in map {
                if name == key { value.clone_from(new) } else { replace(value, key, new) }
            }
        }
        Value::Array(list) => list.iter_mut().for_each(|value| replace(value, key, new)),
        _ => {}
    }
}

#[test]
fn a_save_with_an_active_joint_without_bodies_is_refused() {
    let nobody = json!({ "index": u32::MAX, "generation": u32::MAX });
    let add_joint = |s: &mut PhysicsSimulator, a, b| {
        JointFactory::create_revolute_joint_in(s, a, b, v(2.0, 3.0)).unwrap();
    };
    let add_spring = |s: &mut PhysicsSimulator, a, b| {
        SpringFactory::create_angle_spring_in(s, a, b, 1.0, 0.0).unwrap();
    };
    for add in [add_joint as fn(&mut PhysicsSimulator, BodyId, BodyId), add_spring] {
        for is_listed in [false, true] {
            let (mut simulator, a, b) = two_bodies();
            add(&mut simulator, a, b);
            if is_listed {
                simulator.update(0.01);
            }
            let save = serde_json::to_value(&simulator).unwrap();
            assert!(serde_json::from_value::<PhysicsSimulator>(save.clone()).is_ok());
            for key in ["body1", "body2"] {
                let mut damaged = save.clone();
                replace(&mut damaged, key, &nobody);
                let error = serde_json::from_value::<PhysicsSimulator>(damaged).unwrap_err().to_string();
                assert!(error.contains("without its bodies"), "{error}");
            }
        }
    }
}
