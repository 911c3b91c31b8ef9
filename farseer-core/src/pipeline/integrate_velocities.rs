//! Integration of velocities: impulses, gravity and drag change them.

use crate::body::entry::Bodies;
use crate::math::Vector2;
use crate::report::{Event, Report};

/// Integrates the velocities of the bodies that take part. A body whose velocity would not be finite keeps its old one,
/// and is disabled and reported.
pub(crate) fn integrate_velocities(bodies: &mut Bodies, gravity: Vector2, dt: f32, report: &mut Report) {
    for position in 0..bodies.list().len() {
        let Some((id, entry)) = bodies.at_mut(position) else { continue };
        let body = &mut entry.body;
        if !body.is_integrated() {
            continue;
        }
        let before = (body.linear_velocity, body.angular_velocity);
        if body.is_kinematic() {
            body.begin_kinematic_step(dt);
        } else {
            body.apply_accumulated_impulse();
            body.accumulate_gravity(gravity);
            body.integrate_velocity(dt);
        }
        if !body.velocity_is_finite() {
            (body.linear_velocity, body.angular_velocity) = before;
            body.set_enabled(false);
            report.push(Event::NotFinite { body: id, disabled: true });
        }
    }
}
