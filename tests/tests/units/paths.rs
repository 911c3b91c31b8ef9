//! Chains and tracks (behaviour chapters 13, section 6, and 14) against the record.

use conformance::fixtures::plane::simulator;
use conformance::units::{Case, assert_words, cases};
use farseer_core::{BodyId, ComplexFactory, JointKind, LinearSpring, LinkType, Path, PhysicsSimulator};
use serde_json::Value;

fn link_type(name: &str) -> LinkType {
    match name {
        "RevoluteJoint" => LinkType::RevoluteJoint,
        "PinJoint" => LinkType::PinJoint,
        "SliderJoint" => LinkType::SliderJoint,
        "LinearSpring" => LinkType::LinearSpring,
        other => panic!("unknown link {other}"),
    }
}

/// Makes the path of a case.
fn make(case: &Case, simulator: &mut PhysicsSimulator) -> Path {
    let input = &case.input;
    let factory = ComplexFactory {
        min: input.f32("min"),
        max: input.f32("max"),
        spring_constant: input.f32("spring_constant"),
        damping_constant: input.f32("damping_constant"),
        spring_rest_length_factor: input.f32("rest_length_factor"),
    };
    let link = link_type(input.text("link"));
    match input.text("kind") {
        "chain" => factory.create_chain_with_link_width(
            simulator,
            input.vector("start"),
            input.vector("end"),
            input.f32("width"),
            input.f32("height"),
            input.f32("link_width"),
            input.f32("mass"),
            input.boolean("pin_start"),
            input.boolean("pin_end"),
            link,
        ),
        "chain_links" => {
            let (start, end) = (input.vector("start"), input.vector("end"));
            factory.create_chain_of_links(
                simulator,
                start,
                end,
                input.integer("links"),
                None,
                input.f32("mass"),
                link,
            )
        }
        "track" => factory.create_track(
            simulator,
            &input.vertices("points"),
            input.f32("width"),
            input.f32("height"),
            input.f32("mass"),
            input.boolean("endless"),
            input.integer("collision_group"),
            link,
        ),
        other => panic!("unknown kind {other}"),
    }
    .unwrap()
}

/// A record of an object, with a count of the values that were read.
struct Record<'a>(&'a Value, std::cell::Cell<usize>);

impl<'a> Record<'a> {
    fn all(case: &'a Case, key: &str) -> impl Iterator<Item = Record<'a>> {
        case.output.value(key).as_array().unwrap().iter().map(|value| Record(value, 0.into()))
    }

    fn take(&self, key: &str) -> &'a Value {
        self.1.set(self.1.get() + 1);
        &self.0[key]
    }

    #[track_caller]
    fn expect(&self, key: &str, actual: &impl conformance::units::Words) {
        assert_words(actual, self.take(key).as_str().unwrap());
    }

    #[track_caller]
    fn expect_body(&self, key: &str, path: &Path, actual: BodyId) {
        let index = self.take(key).as_u64().unwrap() as usize;
        assert_eq!(actual, path.bodies()[index], "{key}");
    }

    #[track_caller]
    fn assert_all_read(&self) {
        assert_eq!(self.1.get(), self.0.as_object().unwrap().len(), "{}", self.0);
    }
}

fn expect_bodies(case: &Case, simulator: &PhysicsSimulator, path: &Path) {
    assert_eq!(Record::all(case, "bodies").count(), path.bodies().len());
    for (record, &body) in Record::all(case, "bodies").zip(path.bodies()) {
        let body = &simulator[body];
        record.expect("position", &body.position());
        record.expect("rotation", &body.rotation());
        record.expect("total_rotation", &body.total_rotation());
        record.expect("mass", &body.mass());
        record.expect("moment_of_inertia", &body.moment_of_inertia());
        record.assert_all_read();
    }
}

fn expect_joints(case: &Case, simulator: &PhysicsSimulator, path: &Path) {
    assert_eq!(Record::all(case, "joints").count(), path.joints().len());
    for (record, &joint) in Record::all(case, "joints").zip(path.joints()) {
        let joint = &simulator[joint];
        record.expect("bias_factor", &joint.bias_factor());
        record.expect("softness", &joint.softness());
        if let Some(body2) = joint.body2() {
            record.expect_body("body1", path, joint.body1());
            record.expect_body("body2", path, body2);
        }
        let kind = match joint.kind() {
            JointKind::Revolute(joint) => {
                record.expect("anchor", &joint.anchor());
                "revolute"
            }
            JointKind::FixedRevolute(joint) => {
                record.expect("anchor", &joint.anchor());
                record.expect_body("body", path, joint.body());
                "fixed_revolute"
            }
            JointKind::Pin(joint) => {
                record.expect("anchor1", &joint.anchor1());
                record.expect("anchor2", &joint.anchor2());
                record.expect("world_anchor1", &joint.world_anchor1());
                record.expect("world_anchor2", &joint.world_anchor2());
                record.expect("target_distance", &joint.target_distance());
                "pin"
            }
            JointKind::Slider(joint) => {
                record.expect("anchor1", &joint.anchor1());
                record.expect("anchor2", &joint.anchor2());
                record.expect("min", &joint.min());
                record.expect("max", &joint.max());
                "slider"
            }
            other => panic!("{other:?} is no link"),
        };
        assert_eq!(record.take("type").as_str(), Some(kind));
        record.assert_all_read();
    }
}

fn expect_springs(case: &Case, simulator: &PhysicsSimulator, path: &Path) {
    assert_eq!(Record::all(case, "springs").count(), path.springs().len());
    for (record, &id) in Record::all(case, "springs").zip(path.springs()) {
        let spring: &LinearSpring = simulator.spring_as(id).unwrap();
        record.expect_body("body1", path, spring.body1());
        record.expect_body("body2", path, spring.body2());
        record.expect("attach_point1", &spring.attach_point1());
        record.expect("attach_point2", &spring.attach_point2());
        record.expect("rest_length", &spring.rest_length());
        record.assert_all_read();
        assert_eq!(simulator[id].spring_constant(), case.input.f32("spring_constant"));
        assert_eq!(simulator[id].damping_constant(), case.input.f32("damping_constant"));
    }
}

#[test]
fn chains_and_tracks_are_made_as_recorded() {
    for case in cases("path", "Path") {
        let mut simulator = simulator(0.0);
        let path = make(&case, &mut simulator);
        case.input.assert_all_read();
        expect_bodies(&case, &simulator, &path);
        expect_joints(&case, &simulator, &path);
        expect_springs(&case, &simulator, &path);
        assert_eq!(path.geoms().len() as i32, case.output.integer("geoms"));
        case.expect("control_points", path.control_points());
        case.output.assert_all_read();
        if let Some(&geom) = path.geoms().first() {
            assert_eq!(simulator[geom].collision_group(), case.input.integer("collision_group"));
        }
    }
}
