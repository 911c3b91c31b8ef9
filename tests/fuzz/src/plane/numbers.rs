//! Checks that all readable numbers of a 2D simulator are finite.

use farseer_core::math::Vector2;
use farseer_core::{
    ArbiterRef, Body, DebugShape, GeomRef, Joint, PhysicsSimulator, PhysicsSimulatorView, Spring,
};

use crate::finite::finite;

/// Checks that every readable number is finite. The error names the first that is not.
pub(crate) fn check_numbers(simulator: &PhysicsSimulator) -> Result<(), String> {
    simulator.bodies().filter_map(|id| simulator.body(id)).try_for_each(check_body)?;
    simulator.geoms().filter_map(|id| simulator.geom(id)).try_for_each(check_geom)?;
    simulator.arbiters().try_for_each(check_arbiter)?;
    simulator.joint_list().iter().filter_map(|&id| simulator.joint(id)).try_for_each(check_joint)?;
    simulator.spring_list().iter().filter_map(|&id| simulator.spring(id)).try_for_each(check_spring)?;
    check_debug_view(simulator)
}

fn vector(name: &str, vector: Vector2) -> Result<(), String> {
    finite(name, &[vector.x, vector.y])
}

fn check_body(body: &Body) -> Result<(), String> {
    vector("position", body.position())?;
    finite("rotation", &[body.rotation(), body.total_rotation()])?;
    vector("linear_velocity", body.linear_velocity())?;
    finite("angular_velocity", &[body.angular_velocity()])?;
    finite("mass", &[body.mass(), body.inverse_mass()])?;
    finite("moment_of_inertia", &[body.moment_of_inertia(), body.inverse_moment_of_inertia()])?;
    vector("force", body.force())?;
    finite("torque", &[body.torque()])?;
    vector("impulse", body.impulse())?;
    finite("idle_time", &[body.idle_time(), body.gravity_scale()])?;
    vector("velocity bias", body.get_velocity_bias_at_world_offset(Vector2::zeros()))?;
    finite("body matrix", body.get_body_matrix().iter())
}

fn check_geom(geom: GeomRef<'_>) -> Result<(), String> {
    let aabb = geom.aabb();
    vector("aabb.min", aabb.min)?;
    vector("aabb.max", aabb.max)?;
    vector("geom position", geom.position())?;
    finite("geom rotation", &[geom.rotation(), geom.grid_cell_size()])?;
    finite("geom matrix", geom.matrix().iter())?;
    geom.local_vertices().iter().try_for_each(|&vertex| vector("local_vertices", vertex))?;
    geom.world_vertices().iter().try_for_each(|&vertex| vector("world_vertices", vertex))
}

fn check_arbiter(arbiter: ArbiterRef<'_>) -> Result<(), String> {
    finite("friction", &[arbiter.friction()])?;
    arbiter.contacts().try_for_each(|contact| {
        vector("contact position", contact.position)?;
        vector("contact normal", contact.normal)?;
        finite("separation", &[contact.separation])?;
        finite("contact impulse", &[contact.normal_impulse(), contact.tangent_impulse()])
    })
}

fn check_joint(joint: &Joint) -> Result<(), String> {
    finite("joint_error", &[joint.joint_error()])?;
    vector("joint force", joint.force())?;
    finite("joint torque", &[joint.torque()])
}

fn check_spring(spring: &Spring) -> Result<(), String> {
    finite("spring_error", &[spring.spring_error()])
}

fn check_debug_view(simulator: &PhysicsSimulator) -> Result<(), String> {
    let mut result = Ok(());
    everything_shown().draw(simulator, |shape| {
        if result.is_ok() {
            result = check_shape(&shape);
        }
    });
    result
}

fn check_shape(shape: &DebugShape) -> Result<(), String> {
    match shape {
        DebugShape::Line { start, end, .. } => {
            vector("start of a debug line", *start)?;
            vector("end of a debug line", *end)
        }
        DebugShape::Circle { center, .. } => vector("centre of a debug circle", *center),
        DebugShape::Rectangle { min, size, .. } => {
            vector("corner of a debug rectangle", *min)?;
            vector("size of a debug rectangle", *size)
        }
        DebugShape::Text { position, .. } => vector("place of a debug text", *position),
    }
}

fn everything_shown() -> PhysicsSimulatorView {
    PhysicsSimulatorView {
        enable_edge_view: true,
        enable_vertice_view: true,
        enable_aabb_view: true,
        enable_coordinate_axis_view: true,
        enable_contact_view: true,
        enable_performance_panel_view: true,
        enable_spring_view: true,
        enable_revolute_joint_view: true,
        enable_pin_joint_view: true,
        enable_slider_joint_view: true,
        ..PhysicsSimulatorView::default()
    }
}
