//! State of a hinged box within one step.

use super::interface::WorldBoxHinge;
use super::vertical_shapes::clamp_any;
use crate::index::BodyIndex;

/// State of an awake hinged box during one step.
#[derive(Debug, Clone, Copy)]
pub(super) struct HingedBoxState {
    /// Body index of the box: index into `BodySet`.
    pub(super) body: BodyIndex,
    /// Index of the box into `DepthState::world_boxes`.
    pub(super) box_index: u32,
    /// Hinge of the box: spring, damper, stops and inertia, as they are at the start of the step.
    pub(super) hinge: WorldBoxHinge,
    /// Yaw (radians) and angular velocity (rad/s) at the start of the step.
    pub(super) initial: [f32; 2],
    /// Yaw in radians at the current time of the step.
    pub(super) angle: f32,
    /// Accumulated angular impulse of damper and stops about the hinge in one substep, mass units * length units^2/s.
    pub(super) constraint_impulse: f32,
    /// Whether the yaw of the current substep has been integrated. Then a stop no longer corrects the yaw, because the
    /// correction would remain as velocity.
    pub(super) is_integrated: bool,
}

impl HingedBoxState {
    /// Applies the damper, the implicit part of the spring and the stops to `angular_velocity`, in rad/s. `h` is the substep in
    /// seconds.
    pub(super) fn solve_damping_and_stops(&mut self, angular_velocity: &mut f32, h: f32) {
        let WorldBoxHinge { inertia, stiffness, damping, stops: [least, greatest], .. } = self.hinge;
        let free = *angular_velocity - self.constraint_impulse / inertia;
        let slowed = free / (1.0 + h * (damping + h * stiffness) / inertia);
        let (mut back, mut on) = ((least - self.angle) / h, (greatest - self.angle) / h);
        if self.is_integrated {
            (back, on) = (back.min(0.0), on.max(0.0));
        }
        let next = clamp_any(slowed, back, on);
        self.constraint_impulse += (next - *angular_velocity) * inertia;
        *angular_velocity = next;
    }
}
