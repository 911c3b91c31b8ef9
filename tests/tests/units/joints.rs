//! Joints and springs between two bodies against the recordings of the original step by step (behaviour chapters 10, 11).

use conformance::units::{Case, Words, assert_bits, assert_words, cases, floats};
use farseer_core::math::Vector2;
use farseer_core::{
    AngleSpring, BodyFactory, BodyId, Context, EventHandler, FixedAngleSpring, FixedLinearSpring,
    JointFactory, JointId, LinearSpring, PhysicsSimulator, PinJoint, SliderJoint, SpringFactory, SpringId,
};
use serde_json::Value;

#[derive(Clone, Copy)]
enum Link {
    Joint(JointId),
    Spring(SpringId),
}

/// Counter of `updated_events`; the original's recorder listened to these kinds only.
struct UpdateCounter {
    listens: bool,
    count: i64,
}

impl EventHandler for UpdateCounter {
    fn handles_joint_updates(&self) -> bool {
        self.listens
    }

    fn on_joint_updated(&mut self, _: &mut Context<'_>, _: JointId) {
        self.count += 1;
    }

    fn handles_spring_updates(&self) -> bool {
        self.listens
    }

    fn on_spring_updated(&mut self, _: &mut Context<'_>, _: SpringId) {
        self.count += 1;
    }
}

fn words(record: &Value, key: &str) -> Vec<f32> {
    floats(record[key].as_str().unwrap_or_else(|| panic!("{key} in {record}")))
}

/// The recorder gave the body an angle below 0, which counts as a turn.
fn create_body(simulator: &mut PhysicsSimulator, record: &Value, total_rotation: f32) -> BodyId {
    let number = |key| words(record, key)[0];
    let (width, height, mass) = (number("width"), number("height"), number("mass"));
    let body = BodyFactory::create_rectangle_body_in(simulator, width, height, mass).unwrap();
    let position = words(record, "position");
    let it = &mut simulator[body];
    it.set_position(Vector2::new(position[0], position[1]));
    it.set_rotation(total_rotation);
    assert_words(&it.rotation(), record["rotation_assigned_value"].as_str().unwrap());
    assert_eq!(it.total_rotation().to_bits(), total_rotation.to_bits());
    it.set_angular_velocity(number("angular_velocity"));
    if !record["linear_velocity"].is_null() {
        let velocity = words(record, "linear_velocity");
        it.set_linear_velocity(Vector2::new(velocity[0], velocity[1]));
    }
    it.set_is_static(record["static"].as_bool().unwrap_or(false));
    body
}

/// Limits of the angles, range of the slider and constants of the springs are those of the recorder.
fn create_link(simulator: &mut PhysicsSimulator, case: &Case, body1: BodyId, body2: BodyId) -> Link {
    let anchor = case.input.vector("anchor");
    let (anchor1, anchor2) = (case.input.vector("anchor1"), case.input.vector("anchor2"));
    let s = simulator;
    let joint = match case.input.text("kind") {
        "revolute" => JointFactory::create_revolute_joint_in(s, body1, body2, anchor),
        "fixed_revolute" => JointFactory::create_fixed_revolute_joint_in(s, body2, anchor),
        "pin" => JointFactory::create_pin_joint_in(s, body1, anchor1, body2, anchor2),
        "slider" => JointFactory::create_slider_joint_in(s, body1, anchor1, body2, anchor2, 5.0, 20.0),
        "angle" => JointFactory::create_angle_joint_with_in(s, body1, body2, 0.05, 0.3),
        "fixed_angle" => JointFactory::create_fixed_angle_joint_in(s, body2),
        "angle_limit" => JointFactory::create_angle_limit_joint_in(s, body1, body2, -0.3, 0.3),
        "fixed_angle_limit" => JointFactory::create_fixed_angle_limit_joint_in(s, body2, -0.3, 0.3),
        "weld" => JointFactory::create_weld_joint_in(s, body1, body2, anchor),
        kind => return Link::Spring(create_spring(s, kind, [body1, body2], [anchor, anchor1, anchor2])),
    };
    Link::Joint(joint.unwrap())
}

fn create_spring(
    simulator: &mut PhysicsSimulator,
    kind: &str,
    [body1, body2]: [BodyId; 2],
    [anchor, anchor1, anchor2]: [Vector2; 3],
) -> SpringId {
    let s = simulator;
    let spring = match kind {
        "linear" => SpringFactory::create_linear_spring_in(s, body1, anchor1, body2, anchor2, 30.0, 1.0),
        "fixed_linear" => SpringFactory::create_fixed_linear_spring_in(s, body2, anchor2, anchor, 30.0, 1.0),
        "s_angle" => SpringFactory::create_angle_spring_in(s, body1, body2, 900.0, 30.0),
        "s_fixed_angle" => SpringFactory::create_fixed_angle_spring_in(s, body2, 900.0, 30.0),
        kind => panic!("{kind} is no joint and no spring"),
    };
    spring.unwrap()
}

/// A read-out by the name it has in the records.
fn read_out(simulator: &PhysicsSimulator, link: Link, key: &str) -> Vec<f32> {
    match (link, key) {
        (Link::Joint(joint), "error") => simulator[joint].joint_error().words(),
        (Link::Joint(joint), "current_anchor" | "current_anchor_position") => {
            simulator.joint_current_anchor(joint).unwrap().words()
        }
        (Link::Joint(joint), "target_distance") => pin(simulator, joint).target_distance().words(),
        (Link::Joint(joint), "world_anchor1") => match simulator.joint_as::<SliderJoint>(joint) {
            Ok(slider) => slider.world_anchor1().words(),
            Err(_) => pin(simulator, joint).world_anchor1().words(),
        },
        (Link::Joint(joint), "world_anchor2") => match simulator.joint_as::<SliderJoint>(joint) {
            Ok(slider) => slider.world_anchor2().words(),
            Err(_) => pin(simulator, joint).world_anchor2().words(),
        },
        (Link::Spring(spring), "error") => simulator[spring].spring_error().words(),
        (Link::Spring(spring), "rest_length") => match simulator.spring_as::<LinearSpring>(spring) {
            Ok(linear) => linear.rest_length().words(),
            Err(_) => simulator.spring_as::<FixedLinearSpring>(spring).unwrap().rest_length().words(),
        },
        (Link::Spring(spring), "target_angle") => match simulator.spring_as::<AngleSpring>(spring) {
            Ok(angle) => angle.target_angle().words(),
            Err(_) => simulator.spring_as::<FixedAngleSpring>(spring).unwrap().target_angle().words(),
        },
        (_, key) => panic!("{key} is not read out"),
    }
}

fn pin(simulator: &PhysicsSimulator, joint: JointId) -> &PinJoint {
    simulator.joint_as(joint).unwrap()
}

fn place(simulator: &PhysicsSimulator, body: BodyId) -> Vec<f32> {
    let body = &simulator[body];
    vec![body.position().x, body.position().y, body.total_rotation()]
}

fn expect(name: &str, actual: &[f32], expected: &Value) {
    assert_bits(actual, &floats(expected.as_str().unwrap()), || name.to_owned());
}

fn check_kind(kind: &str) {
    let cases: Vec<Case> = cases("controllers_joints", "JointReadout")
        .into_iter()
        .filter(|case| case.input.text("kind") == kind)
        .collect();
    assert_eq!(cases.len(), 3, "{kind}");
    for (number, case) in cases.iter().enumerate() {
        let mut simulator = PhysicsSimulator::new(case.input.vector("gravity")).unwrap();
        let rotations = case.input.floats("total_rotations");
        let body1 = create_body(&mut simulator, case.input.value("body1"), rotations[0]);
        let body2 = create_body(&mut simulator, case.input.value("body2"), rotations[1]);
        let link = create_link(&mut simulator, case, body1, body2);
        for (key, expected) in case.output.value("initial").as_object().unwrap() {
            expect(&format!("{kind} {number}: {key}"), &read_out(&simulator, link, key), expected);
        }

        let listens = matches!(kind, "revolute" | "pin" | "linear");
        let mut counter = UpdateCounter { listens, count: 0 };
        let mut step = 0;
        for record in case.output.value("steps").as_array().unwrap() {
            while step < record["step"].as_i64().unwrap() {
                simulator.update_with(case.input.f32("dt"), &mut counter);
                step += 1;
            }
            for (key, expected) in record.as_object().unwrap() {
                let name = format!("{kind} {number}: {key} after step {step}");
                match key.as_str() {
                    "step" => {}
                    "updated_events" => assert_eq!(Some(counter.count), expected.as_i64(), "{name}"),
                    "b1" => expect(&name, &place(&simulator, body1), expected),
                    "b2" => expect(&name, &place(&simulator, body2), expected),
                    _ => expect(&name, &read_out(&simulator, link, key), expected),
                }
            }
        }
        assert_eq!(step, 40, "{kind}");
        case.output.assert_all_read();
    }
}

macro_rules! kinds {
    ($($test:ident: $kind:literal;)*) => {$(
        #[test]
        fn $test() {
            check_kind($kind);
        }
    )*};
}

kinds! {
    revolute_joints_read_as_recorded: "revolute";
    fixed_revolute_joints_read_as_recorded: "fixed_revolute";
    pin_joints_read_as_recorded: "pin";
    slider_joints_read_as_recorded: "slider";
    angle_joints_read_as_recorded: "angle";
    fixed_angle_joints_read_as_recorded: "fixed_angle";
    angle_limit_joints_read_as_recorded: "angle_limit";
    fixed_angle_limit_joints_read_as_recorded: "fixed_angle_limit";
    weld_joints_read_as_recorded: "weld";
    linear_springs_read_as_recorded: "linear";
    fixed_linear_springs_read_as_recorded: "fixed_linear";
    angle_springs_read_as_recorded: "s_angle";
    fixed_angle_springs_read_as_recorded: "s_fixed_angle";
}
