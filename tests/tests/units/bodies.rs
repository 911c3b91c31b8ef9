//! Bodies of behaviour chapters 02 and 13.2 against the record.

use conformance::units::{Fields, assert_words, check};
use farseer_core::math::scalar;
use farseer_core::{Body, BodyFactory};
use serde_json::Value;

fn text<'a>(record: &'a Value, key: &str) -> &'a str {
    record[key].as_str().unwrap_or_else(|| panic!("no {key} in {record}"))
}

fn recorded_body(input: &Fields) -> Body {
    let mut body = Body::new();
    body.set_position(input.vector("position"));
    body.set_rotation(input.f32("rotation_assigned"));
    body.set_linear_velocity(input.vector("linear_velocity"));
    body.set_angular_velocity(input.f32("angular_velocity"));
    body
}

#[test]
fn conversions_and_velocities_have_the_recorded_bits() {
    check("body", "body", |case| {
        let mut body = recorded_body(&case.input);
        let (local, world) = (case.input.vector("local_point"), case.input.vector("world_point"));
        case.expect("rotation", &body.rotation());
        case.expect("total_rotation", &body.total_rotation());
        assert_eq!(body.revolutions(), case.output.integer("revolutions"));
        case.expect("world_position", &body.get_world_position(local));
        case.expect("local_position", &body.get_local_position(world));
        case.expect("velocity_at_local_point", &body.get_velocity_at_local_point(local));
        case.expect("velocity_at_world_point", &body.get_velocity_at_world_point(world));
        case.expect("velocity_at_world_offset_local_point", &body.get_velocity_at_world_offset(local));
        case.expect("body_matrix", &body.get_body_matrix());
        case.expect("rotation_matrix", &body.get_body_rotation_matrix());
        case.expect("x_vector", &body.x_vector_in_world_coordinates());
        case.expect("y_vector", &body.y_vector_in_world_coordinates());

        let force = case.input.vector("force");
        body.apply_force_at_local_point(force, local);
        case.expect("force_after_local", &body.force());
        case.expect("torque_after_local", &body.torque());
        body.apply_force_at_world_point(force, world);
        case.expect("force_after_world", &body.force());
        case.expect("torque_after_world", &body.torque());
    });
}

/// The original accepts infinities and NaN and goes on with them; here they are refused without an effect. A recorded sequence
/// is compared up to the first of them.
#[test]
fn rotations_set_one_after_the_other_have_the_recorded_bits() {
    let refusals = std::cell::Cell::new(0);
    check("body", "rotation_setter", |case| {
        let mut body = Body::new();
        let after_each = case.output.value("after_each").as_array().unwrap();
        let assigned = case.input.floats("assign_in_order");
        assert_eq!(assigned.len(), after_each.len());
        for (&value, expected) in assigned.iter().zip(after_each) {
            let before = (body.rotation().to_bits(), body.revolutions(), body.total_rotation().to_bits());
            body.set_rotation(value);
            if !value.is_finite() {
                let after = (body.rotation().to_bits(), body.revolutions(), body.total_rotation().to_bits());
                assert_eq!(before, after);
                refusals.set(refusals.get() + 1);
                return;
            }
            assert_words(&body.rotation(), text(expected, "rotation"));
            assert_words(&body.total_rotation(), text(expected, "total_rotation"));
            assert_eq!(i64::from(body.revolutions()), expected["revolutions"].as_i64().unwrap());
        }
    });
    assert_eq!(refusals.get(), 3);
}

fn expect_mass_properties(body: &Body, record: &Value) {
    assert_words(&body.mass(), text(record, "mass"));
    assert_words(&body.inverse_mass(), text(record, "inverse_mass"));
    assert_words(&body.moment_of_inertia(), text(record, "moment_of_inertia"));
    assert_words(&body.inverse_moment_of_inertia(), text(record, "inverse_moment_of_inertia"));
    assert_words(&body.position(), text(record, "position"));
}

#[test]
fn factory_bodies_have_the_recorded_mass_properties() {
    check("body", "factory", |case| {
        let (a, b, mass) = (case.input.f32("a"), case.input.f32("b"), case.input.f32("mass"));
        let out = |key| case.output.value(key);
        let made = |body: farseer_core::Result<Body>| body.unwrap();
        expect_mass_properties(&made(BodyFactory::create_rectangle_body(a, b, mass)), out("rectangle_a_b"));
        expect_mass_properties(&made(BodyFactory::create_circle_body(a, mass)), out("circle_a"));
        expect_mass_properties(&made(BodyFactory::create_ellipse_body(a, b, mass)), out("ellipse_a_b"));
        expect_mass_properties(&made(BodyFactory::create_ellipse_body(a, a, mass)), out("ellipse_a_a"));
        let polygon = case.input.vertices("polygon");
        expect_mass_properties(&made(BodyFactory::create_polygon_body(&polygon, mass)), out("polygon"));
        assert_eq!(polygon, case.input.vertices("polygon"), "the list was changed");
    });
}

#[test]
fn floats_become_the_recorded_integers() {
    check("body", "float_to_int", |case| {
        assert_eq!(scalar::to_int(case.input.f32("value")), case.output.integer("int"));
    });
}
