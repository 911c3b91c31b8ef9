//! Joints and springs in the hands of a game: made, found, edited, refused. Numbered checks are those of behaviour chapter
//! 13, section 8.

use crate::joint_bench::add_body;
use conformance::fixtures::plane::{self, v};
use conformance::units::assert_words;
use farseer_core::math::Vector2;
use farseer_core::{
    AngleJoint, BodyId, Error, Event, FixedAngleSpring, FixedRevoluteJoint, JointFactory, JointId,
    LinearSpring, ObjectId, PhysicsSimulator, PinJoint, Result, RevoluteJoint, SliderJoint, SpringFactory,
    SpringId, WeldJoint,
};
use serde_json::Value;

fn two_bodies() -> (PhysicsSimulator, BodyId, BodyId) {
    let mut simulator = plane::simulator(0.0);
    let a = add_body(&mut simulator, (2.0, 3.0), v(1.0, 2.0), 0.5);
    let b = add_body(&mut simulator, (5.0, 7.0), v(4.0, 6.0), -0.25);
    (simulator, a, b)
}

/// Check 12.
#[test]
fn a_fixed_revolute_joint_on_a_static_body_is_disabled() {
    let (mut simulator, a, b) = two_bodies();
    simulator[a].set_is_static(true);
    let [on_static, on_dynamic] = [a, b]
        .map(|body| JointFactory::create_fixed_revolute_joint(&mut simulator, body, v(0.0, 0.0)).unwrap());
    assert!(!simulator[on_static].enabled());
    assert!(simulator[on_dynamic].enabled());
    assert_eq!(simulator[on_static].bias_factor(), 0.8);
    simulator[a].set_is_static(false);
    simulator.update(0.01);
    assert!(!simulator[on_static].enabled());
}

/// Check 12.
#[test]
fn an_angle_joint_can_be_made_with_softness_and_bias_factor() {
    let (mut simulator, a, b) = two_bodies();
    let joint = JointFactory::create_angle_joint_with(&mut simulator, a, b, 0.3, 0.4).unwrap();
    assert_eq!((simulator[joint].softness(), simulator[joint].bias_factor()), (0.3, 0.4));
    assert_eq!(simulator.joint_as::<AngleJoint>(joint).unwrap().target_angle(), 0.0);
}

/// Check 13.
#[test]
fn springs_are_at_rest_where_they_are_made() {
    let mut simulator = plane::simulator(0.0);
    let a = add_body(&mut simulator, (1.0, 1.0), v(1.0, 2.0), -1.0);
    let b = add_body(&mut simulator, (1.0, 1.0), v(4.0, 6.0), 0.0);
    assert_words(&simulator[a].rotation(), "40a90fdb");
    let spring = SpringFactory::create_fixed_angle_spring(&mut simulator, a, 1.0, 1.0).unwrap();
    assert_eq!(simulator.spring_as::<FixedAngleSpring>(spring).unwrap().target_angle(), -1.0);
    let origin = v(0.0, 0.0);
    let spring = SpringFactory::create_linear_spring(&mut simulator, a, origin, b, origin, 1.0, 1.0).unwrap();
    assert_eq!(simulator.spring_as::<LinearSpring>(spring).unwrap().rest_length(), 5.0);
}

#[test]
fn joints_and_springs_act_once_they_are_added() {
    let (mut simulator, a, b) = two_bodies();
    let s = &mut simulator;
    let joint = JointFactory::create_pin_joint(s, a, v(0.0, 0.0), b, v(0.0, 0.0)).unwrap();
    let added = JointFactory::create_pin_joint_in(s, a, v(0.0, 0.0), b, v(0.0, 0.0)).unwrap();
    let spring = SpringFactory::create_angle_spring(s, a, b, 1.0, 0.0).unwrap();
    let added_spring = SpringFactory::create_angle_spring_in(s, a, b, 1.0, 0.0).unwrap();
    assert!(s.joint_list().is_empty() && s.spring_list().is_empty());
    s.update(0.01);
    assert_eq!((s.joint_list(), s.spring_list()), (&[added][..], &[added_spring][..]));
    s.add(joint).unwrap();
    s.add(spring).unwrap();
    s.remove(added).unwrap();
    s.remove(added_spring).unwrap();
    s.update(0.01);
    assert_eq!((s.joint_list(), s.spring_list()), (&[joint][..], &[spring][..]));
    assert!(s.joint(added).is_some() && s.spring(added_spring).is_some());
    for object in [ObjectId::from(added), added_spring.into()] {
        s.dispose(object).unwrap();
    }
    s.update(0.01);
    assert!(s.joint(added).is_none() && s.spring(added_spring).is_none());
}

type MakesJoint = fn(&mut PhysicsSimulator, BodyId, BodyId, f32) -> Result<JointId>;
type MakesSpring = fn(&mut PhysicsSimulator, BodyId, BodyId, f32) -> Result<SpringId>;

/// A factory method, and the name of the argument that gets a number.
const JOINTS: [(MakesJoint, &str); 11] = [
    (|s, a, b, x| JointFactory::create_revolute_joint(s, a, b, v(x, 0.0)), "initial_anchor_position"),
    (|s, a, _, x| JointFactory::create_fixed_revolute_joint(s, a, v(0.0, x)), "anchor"),
    (|s, a, b, x| JointFactory::create_pin_joint(s, a, v(x, 0.0), b, v(0.0, 0.0)), "anchor1"),
    (|s, a, b, x| JointFactory::create_pin_joint(s, a, v(0.0, 0.0), b, v(0.0, x)), "anchor2"),
    (|s, a, b, x| JointFactory::create_slider_joint(s, a, v(0.0, 0.0), b, v(0.0, 0.0), x, 9.0), "min"),
    (|s, a, b, x| JointFactory::create_slider_joint(s, a, v(0.0, 0.0), b, v(0.0, 0.0), 0.0, x), "max"),
    (|s, a, b, x| JointFactory::create_angle_joint_with(s, a, b, x, 0.2), "softness"),
    (|s, a, b, x| JointFactory::create_angle_joint_with(s, a, b, 0.0, x), "bias_factor"),
    (|s, a, b, x| JointFactory::create_angle_limit_joint(s, a, b, x, 1.0), "min"),
    (|s, a, _, x| JointFactory::create_fixed_angle_limit_joint(s, a, 0.0, x), "max"),
    (|s, a, b, x| JointFactory::create_weld_joint(s, a, b, v(x, 0.0)), "anchor"),
];

const SPRINGS: [(MakesSpring, &str); 6] = [
    (
        |s, a, b, x| SpringFactory::create_linear_spring(s, a, v(x, 0.0), b, v(0.0, 0.0), 1.0, 1.0),
        "attach_point1",
    ),
    (
        |s, a, b, x| SpringFactory::create_linear_spring(s, a, v(0.0, 0.0), b, v(0.0, x), 1.0, 1.0),
        "attach_point2",
    ),
    (
        |s, a, _, x| SpringFactory::create_fixed_linear_spring(s, a, v(x, 0.0), v(0.0, 0.0), 1.0, 1.0),
        "body_attach_point",
    ),
    (
        |s, a, _, x| SpringFactory::create_fixed_linear_spring(s, a, v(0.0, 0.0), v(x, 0.0), 1.0, 1.0),
        "world_attach_point",
    ),
    (|s, a, b, x| SpringFactory::create_angle_spring(s, a, b, x, 1.0), "spring_constant"),
    (|s, a, _, x| SpringFactory::create_fixed_angle_spring(s, a, 1.0, x), "damping_constant"),
];

#[track_caller]
fn assert_refused<T: std::fmt::Debug>(result: Result<T>, expected: &str) {
    match result {
        Err(Error::InvalidArgument { argument, .. }) => assert_eq!(argument, expected),
        other => panic!("{other:?}"),
    }
}

#[test]
fn non_finite_arguments_are_refused_by_name() {
    let (mut simulator, a, b) = two_bodies();
    for number in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for (make, argument) in JOINTS {
            assert_refused(make(&mut simulator, a, b, number), argument);
        }
        for (make, argument) in SPRINGS {
            assert_refused(make(&mut simulator, a, b, number), argument);
        }
    }
}

#[test]
fn stale_bodies_are_refused() {
    let (mut simulator, a, b) = two_bodies();
    let gone = add_body(&mut simulator, (1.0, 1.0), v(0.0, 0.0), 0.0);
    simulator.dispose(gone).unwrap();
    simulator.update(0.01);
    for (make, _) in JOINTS {
        assert!(matches!(
            make(&mut simulator, gone, b, 0.5),
            Err(Error::StaleId { argument: "body" | "body1" })
        ));
    }
    for (make, _) in SPRINGS {
        assert!(matches!(
            make(&mut simulator, gone, b, 0.5),
            Err(Error::StaleId { argument: "body" | "body1" })
        ));
    }
    let refused = JointFactory::create_angle_joint(&mut simulator, a, gone);
    assert_eq!(refused, Err(Error::StaleId { argument: "body2" }));
}

#[test]
fn a_joint_is_found_by_its_own_type_only() {
    let (mut simulator, a, b) = two_bodies();
    let joint = JointFactory::create_angle_joint(&mut simulator, a, b).unwrap();
    assert_eq!(simulator.joint_as::<AngleJoint>(joint).unwrap().body2(), b);
    let wrong = Error::WrongKind { argument: "joint", expected: "PinJoint" };
    assert_eq!(simulator.joint_as::<PinJoint>(joint).unwrap_err(), wrong);
    assert_eq!(simulator.joint_as_mut::<PinJoint>(joint).unwrap_err(), wrong);
    simulator.dispose(joint).unwrap();
    simulator.update(0.01);
    let stale = Error::StaleId { argument: "joint" };
    assert_eq!(simulator.joint_as::<AngleJoint>(joint).unwrap_err(), stale);
}

#[test]
fn setters_refuse_non_finite_numbers_and_keep_the_old_value() {
    let (mut simulator, a, b) = two_bodies();
    let joint =
        JointFactory::create_slider_joint(&mut simulator, a, v(0.0, 0.0), b, v(0.0, 0.0), 1.0, 2.0).unwrap();
    let common = &mut simulator[joint];
    assert_refused(common.set_softness(f32::NAN), "softness");
    assert_refused(common.set_bias_factor(f32::NAN), "bias_factor");
    assert_refused(common.set_breakpoint(f32::INFINITY), "breakpoint");
    assert_eq!((common.softness(), common.bias_factor(), common.breakpoint()), (0.0, 0.2, f32::MAX));
    let slider = simulator.joint_as_mut::<SliderJoint>(joint).unwrap();
    assert_refused(slider.set_min(f32::NAN), "min");
    assert_refused(slider.set_max(f32::NAN), "max");
    assert_refused(slider.set_slop(f32::NAN), "slop");
    assert_eq!((slider.min(), slider.max(), slider.slop()), (1.0, 2.0, 0.01));
}

/// The local anchor is where the point of the world is on the body at that moment.
#[test]
fn a_moved_anchor_constrains_the_bodies_at_their_present_poses() {
    let (mut simulator, a, b) = two_bodies();
    let makes: [MakesJoint; 3] = [
        |s, a, b, x| JointFactory::create_revolute_joint_in(s, a, b, v(x, 3.0)),
        |s, a, b, x| JointFactory::create_weld_joint_in(s, a, b, v(x, 3.0)),
        |s, a, _, x| JointFactory::create_fixed_revolute_joint_in(s, a, v(x, 3.0)),
    ];
    let joints = makes.map(|make| make(&mut simulator, a, b, 2.0).unwrap());
    simulator[a].set_position(v(-3.0, 8.0));
    simulator[a].set_rotation(2.0);
    for joint in joints {
        simulator.set_joint_anchor(joint, v(1.5, -0.5)).unwrap();
        assert_refused(simulator.set_joint_anchor(joint, v(f32::NAN, 0.0)), "anchor");
    }
    assert_eq!(simulator.joint_as::<RevoluteJoint>(joints[0]).unwrap().anchor(), v(1.5, -0.5));
    assert_eq!(simulator.joint_as::<WeldJoint>(joints[1]).unwrap().anchor(), v(1.5, -0.5));
    assert_eq!(simulator.joint_as::<FixedRevoluteJoint>(joints[2]).unwrap().anchor(), v(1.5, -0.5));
    simulator.update(0.01);
    for joint in joints {
        // Arms are below 12: their rounding errors, and with them the error, below 4 * 2^-21.
        assert!(simulator[joint].joint_error() < 2e-6, "{:?}", simulator[joint]);
    }
}

#[test]
fn a_moved_local_anchor_is_in_the_world_at_once() {
    let (mut simulator, a, b) = two_bodies();
    let joint = JointFactory::create_pin_joint(&mut simulator, a, v(0.0, 0.0), b, v(0.0, 0.0)).unwrap();
    simulator.set_joint_anchor1(joint, v(0.5, 0.25)).unwrap();
    simulator.set_joint_anchor2(joint, v(-1.0, 0.75)).unwrap();
    let pin = simulator.joint_as::<PinJoint>(joint).unwrap();
    assert_eq!((pin.anchor1(), pin.anchor2()), (v(0.5, 0.25), v(-1.0, 0.75)));
    // Here the rotated anchor plus the position, there all of the matrix at once: a rounding each.
    let distance =
        |body: BodyId, local, world: Vector2| (simulator[body].get_world_position(local) - world).norm();
    assert!(distance(a, v(0.5, 0.25), pin.world_anchor1()) < 1e-6);
    assert!(distance(b, v(-1.0, 0.75), pin.world_anchor2()) < 1e-6);
    assert_eq!(pin.target_distance(), 5.0);
}

#[test]
fn joints_without_an_anchor_name_the_kinds_with_one() {
    let (mut simulator, a, b) = two_bodies();
    let joint = JointFactory::create_fixed_angle_joint(&mut simulator, a).unwrap();
    let refusals = [
        simulator.set_joint_anchor(joint, v(0.0, 0.0)).unwrap_err(),
        simulator.set_joint_anchor1(joint, v(0.0, 0.0)).unwrap_err(),
        simulator.set_joint_anchor2(joint, v(0.0, 0.0)).unwrap_err(),
        simulator.joint_current_anchor(joint).unwrap_err(),
        simulator.set_joint_body2(joint, b).unwrap_err(),
    ];
    assert!(
        refusals.iter().all(|error| matches!(error, Error::WrongKind { argument: "joint", .. })),
        "{refusals:?}"
    );
}

#[test]
fn a_joint_and_a_spring_can_be_given_to_other_bodies() {
    let (mut simulator, a, b) = two_bodies();
    let other = add_body(&mut simulator, (1.0, 1.0), v(9.0, 9.0), 0.0);
    let joint = JointFactory::create_angle_joint_in(&mut simulator, a, b).unwrap();
    simulator.set_joint_body1(joint, other).unwrap();
    simulator.set_joint_body2(joint, a).unwrap();
    assert_eq!((simulator[joint].body1(), simulator[joint].body2()), (other, Some(a)));
    let spring = SpringFactory::create_fixed_angle_spring_in(&mut simulator, a, 1.0, 0.0).unwrap();
    simulator.set_spring_body1(spring, other).unwrap();
    assert_eq!((simulator[spring].body1(), simulator[spring].body2()), (other, None));
    simulator.dispose(b).unwrap();
    simulator.update(0.01);
    assert!(simulator.joint(joint).is_some(), "it holds the disposed body no longer");
    assert_eq!(simulator.set_joint_body1(joint, b), Err(Error::StaleId { argument: "body" }));
}

/// Both ends of a joint or spring may be the same body: it has no effect then.
#[test]
fn a_body_can_be_joined_to_itself() {
    let (mut simulator, a, _) = two_bodies();
    simulator[a].set_linear_velocity(v(1.0, -2.0));
    simulator[a].set_linear_drag_coefficient(0.0);
    let s = &mut simulator;
    JointFactory::create_revolute_joint_in(s, a, a, v(2.0, 3.0)).unwrap();
    JointFactory::create_pin_joint_in(s, a, v(0.0, 0.0), a, v(1.0, 0.0)).unwrap();
    JointFactory::create_weld_joint_in(s, a, a, v(2.0, 3.0)).unwrap();
    SpringFactory::create_linear_spring_in(s, a, v(0.0, 0.0), a, v(1.0, 0.0), 5.0, 1.0).unwrap();
    for _ in 0..10 {
        simulator.update(0.01);
    }
    // Opposite impulses on one velocity: the difference is rounding.
    let change = simulator[a].linear_velocity() - v(1.0, -2.0);
    assert!(change.norm() < 1e-5, "{change}");
    assert!(plane::is_finite(&simulator));
}

/// Adds a joint whose values become infinite or NaN in the next update.
type MakesOverflow = fn(&mut PhysicsSimulator, BodyId, BodyId) -> Result<JointId>;

/// Joints that overflow, and whether an event reports it. The first body turns by an eighth before the update.
const OVERFLOWS: [(&str, bool, MakesOverflow); 13] = [
    ("the length of a pin joint", true, |s, a, b| {
        s[b].set_position(v(0.0, 0.0));
        let joint = JointFactory::create_pin_joint_in(s, a, v(0.0, 0.0), b, v(0.0, 0.0))?;
        s[b].set_position(v(1e20, 0.0));
        Ok(joint)
    }),
    ("the error of a revolute joint", true, |s, a, b| {
        let joint = JointFactory::create_revolute_joint_in(s, a, b, v(0.0, 0.0))?;
        s[b].set_position(v(1e20, 0.0));
        Ok(joint)
    }),
    ("the mass of a soft pin joint", true, |s, a, b| {
        with_softness(s, -(s[a].inverse_mass() + s[b].inverse_mass()), |s| {
            JointFactory::create_pin_joint_in(s, a, v(0.0, 0.0), b, v(0.0, 0.0))
        })
    }),
    ("the matrix of a soft fixed revolute joint", true, |s, a, _| {
        with_softness(s, -s[a].inverse_mass(), |s| {
            let position = s[a].position();
            JointFactory::create_fixed_revolute_joint_in(s, a, position)
        })
    }),
    ("the arm of a slider joint", true, |s, a, b| {
        JointFactory::create_slider_joint_in(s, a, v(3e38, 3e38), b, v(0.0, 0.0), 0.0, 1.0)
    }),
    ("the arm of a revolute joint", true, |s, a, b| {
        JointFactory::create_revolute_joint_in(s, a, b, v(3e38, 3e38))
    }),
    ("the arm of a fixed revolute joint", true, |s, a, _| {
        JointFactory::create_fixed_revolute_joint_in(s, a, v(3e38, 3e38))
    }),
    ("the arm of a weld joint", true, |s, a, b| JointFactory::create_weld_joint_in(s, a, b, v(3e38, 3e38))),
    ("the mass of an angle limit joint", false, |s, a, b| {
        s[a].set_moment_of_inertia(2.0)?;
        s[b].set_moment_of_inertia(2.0)?;
        with_softness(s, -1.0, |s| JointFactory::create_angle_limit_joint_in(s, a, b, -9.0, 9.0))
    }),
    ("the mass of an angle joint", false, |s, a, b| {
        s[a].set_moment_of_inertia(f32::MAX)?;
        s[b].set_moment_of_inertia(f32::MAX)?;
        with_softness(s, -3.0, |s| JointFactory::create_angle_joint_in(s, a, b))
    }),
    ("the mass of a fixed angle joint", false, |s, a, _| {
        s[a].set_moment_of_inertia(f32::MAX)?;
        with_softness(s, -3.0, |s| JointFactory::create_fixed_angle_joint_in(s, a))
    }),
    ("the mass of a fixed angle limit joint", false, |s, a, _| {
        s[a].set_moment_of_inertia(f32::MAX)?;
        with_softness(s, -3.0, |s| JointFactory::create_fixed_angle_limit_joint_in(s, a, -9.0, 9.0))
    }),
    ("the bias of an angle joint", false, |s, a, b| {
        s[b].set_rotation(-1.0);
        let joint = JointFactory::create_angle_joint_in(s, a, b)?;
        s[joint].set_bias_factor(3e38)?;
        s.joint_as_mut::<AngleJoint>(joint).unwrap().set_max_impulse(0.5)?;
        Ok(joint)
    }),
];

fn with_softness(
    s: &mut PhysicsSimulator,
    softness: f32,
    make: impl FnOnce(&mut PhysicsSimulator) -> Result<JointId>,
) -> Result<JointId> {
    let joint = make(s)?;
    s[joint].set_softness(softness)?;
    Ok(joint)
}

/// Values that a joint computes in every update may overflow; its parameters are finite all the same.
#[test]
fn joints_that_overflow_are_saved_and_loaded_to_the_bit() {
    for (what, is_told, make) in OVERFLOWS {
        let (mut original, a, b) = two_bodies();
        original[a].set_rotation(0.0);
        original[b].set_rotation(0.0);
        let joint = make(&mut original, a, b).unwrap();
        let rotation = original[a].rotation() + std::f32::consts::FRAC_PI_4;
        original[a].set_rotation(rotation);
        original.update(0.01);
        let debug = format!("{:?}", original[joint]);
        assert!(debug.contains("inf") || debug.contains("NaN"), "{what}: {debug}");
        let tells = |event: &Event| matches!(event, Event::JointBroke { .. } | Event::JointNotFinite { .. });
        assert_eq!(original.events().iter().any(tells), is_told, "{what}: {:?}", original.events());
        let snapshot = original.snapshot();
        let mut restored = PhysicsSimulator::default();
        restored.restore(&snapshot).unwrap_or_else(|error| panic!("{what}: {error}"));
        let json = serde_json::to_string(&original).unwrap();
        let mut loaded: PhysicsSimulator =
            serde_json::from_str(&json).unwrap_or_else(|error| panic!("{what}: {error}"));
        assert!(restored.snapshot() == snapshot && loaded.snapshot() == snapshot, "{what}");
        for update in 0..20 {
            for simulator in [&mut original, &mut restored, &mut loaded] {
                simulator.update(0.01);
            }
            let snapshot = original.snapshot();
            assert!(restored.snapshot() == snapshot, "{what}, update {update}");
            assert!(loaded.snapshot() == snapshot, "{what}, update {update}");
            assert!(plane::is_finite(&original), "{what}, update {update}");
        }
    }
}

/// Replaces the first number of that name in a save.
fn replace(value: &mut Value, name: &str, number: f64) -> bool {
    match value {
        Value::Object(fields) => {
            if let Some(found) = fields.get_mut(name).filter(|found| found.is_number()) {
                *found = number.into();
                return true;
            }
            fields.values_mut().any(|field| replace(field, name, number))
        }
        Value::Array(items) => items.iter_mut().any(|item| replace(item, name, number)),
        _ => false,
    }
}

#[test]
fn saves_with_settings_that_are_not_finite_are_refused() {
    let (mut simulator, a, b) = two_bodies();
    let s = &mut simulator;
    JointFactory::create_slider_joint_in(s, a, v(0.0, 0.0), b, v(0.0, 0.0), 0.0, 1.0).unwrap();
    JointFactory::create_weld_joint_in(s, a, b, v(0.0, 0.0)).unwrap();
    SpringFactory::create_angle_spring_in(s, a, b, 1.0, 1.0).unwrap();
    SpringFactory::create_linear_spring_in(s, a, v(0.0, 0.0), b, v(0.0, 0.0), 1.0, 1.0).unwrap();
    simulator.update(0.01);
    let save = serde_json::to_value(&simulator).unwrap();
    let numbers = [
        "bias_factor",
        "breakpoint",
        "softness",
        "min",
        "slop",
        "accumulated",
        "max_impulse",
        "spring_constant",
        "damping_constant",
        "spring_error",
        "max_torque",
        "torque_multiplier",
        "rest_length",
    ];
    for name in numbers {
        // 1e39 is beyond f32, 0.5 is as good as any.
        for (number, is_accepted) in [(1e39, false), (0.5, true)] {
            let mut save = save.clone();
            assert!(replace(&mut save, name, number), "{name} is not there");
            let loaded = serde_json::from_value::<PhysicsSimulator>(save);
            assert_eq!(loaded.is_ok(), is_accepted, "{name} {number}: {:?}", loaded.err());
        }
    }
}
