//! Drives: bodies that a drive moves do not sleep, however slowly they move. So a motor of 0.05 rad/s turns its body by 1 rad
//! in 20 s.
//!
//! | drive | bodies that stay awake |
//! |---|---|
//! | motor of a joint | both bodies, while the joint moves |
//! | belt: surface velocity of a static body, or a speed that a handler has set | the bodies on it, while they move |
//! | kinematic body that moves | the bodies on it, and those at the other end of a joint or spring |
//!
//! A motor or belt is effective while its body moves with at least [`STALLED_DRIVE_SPEED_FRACTION`] of the drive's speed.
//! Islands sleep at a motor of speed 0, at a motor that has reached a limit or is too weak for its load, and on a belt where a
//! wall blocks them. They wake when the drive, the wall or the load is edited, and when an awake body touches them.

use crate::body::BodyId;
use crate::objects::Objects;
use crate::precise::Precise;
use crate::precise::constraint_graph::ContactConstraint;
use crate::precise::parameters::sleep::STALLED_DRIVE_SPEED_FRACTION;

impl Precise {
    /// Returns the distance that a body moved in the last step, length units. It is the displacement of the origin along all
    /// axes, plus the displacement of the farthest point by rotation.
    fn distance_moved(&self, body: usize) -> f32 {
        let [x, y, rotation, z] = self.bodies.delta_pose[body];
        x.abs() + y.abs() + z.abs() + self.bodies.max_extents[body] * rotation.abs()
    }

    /// Returns whether a drive of this `speed` moved its body by `distance` in the last step, up to the fraction at which it
    /// counts as stalled. Linear drives: length units/s and length units; rotary motors: radians/s and radians.
    fn is_drive_effective(&self, speed: f32, distance: f32) -> bool {
        speed != 0.0 && distance >= STALLED_DRIVE_SPEED_FRACTION * speed.abs() * self.dt
    }

    /// Returns whether a body moves on a running belt. `contact` is the contact constraint of the body with the belt.
    pub(in crate::precise) fn is_on_running_belt(&self, body: usize, contact: &ContactConstraint) -> bool {
        let speed = contact.tangent_speed.abs() + contact.depth.across_speed.abs();
        contact.friction > 0.0 && self.is_drive_effective(speed, self.distance_moved(body))
    }

    /// Calls `visit` with the index of each dynamic body that a motor moves, and of each dynamic body that a joint or spring
    /// connects to a moving kinematic body.
    pub(in crate::precise) fn for_each_driven(&self, objects: &Objects, mut visit: impl FnMut(usize)) {
        for (ends, speed, is_along_line) in self.joints.motors() {
            let [a, b] = ends.map(|body| self.bodies.delta_pose.get(body).copied().unwrap_or_default());
            let [x, y, rotation] = [0, 1, 2].map(|axis: usize| (b[axis] - a[axis]).abs());
            if self.is_drive_effective(speed, if is_along_line { x + y } else { rotation }) {
                ends.into_iter().filter(|&body| self.bodies.is_dynamic(body)).for_each(&mut visit);
            }
        }
        for [a, b] in self.joints.body_pairs().chain(self.spring_body_pairs(objects)) {
            for (one, other) in [(a, b), (b, a)] {
                if self.bodies.is_kinematic(one)
                    && self.bodies.has_velocity(one)
                    && self.bodies.is_dynamic(other)
                {
                    visit(other);
                }
            }
        }
    }

    /// Requests that sleeping bodies wake which a spring connects to a kinematic body that will move in this step.
    pub(in crate::precise) fn wake_springs_of_moving_kinematic(&mut self, objects: &Objects) {
        for at in 0..objects.springs.list().len() {
            let Some((_, spring)) = objects.springs.at(at).filter(|(_, spring)| spring.enabled()) else {
                continue;
            };
            let ends = spring.ends().map(|end| end.and_then(|id| Some((self.body_index(id)?, id))));
            let moves = |&(body, id): &(usize, BodyId)| {
                self.bodies.is_kinematic(body) && self.will_move_in_step(body, Some(id), objects)
            };
            if ends.iter().flatten().any(moves) {
                ends.into_iter().flatten().for_each(|(number, _)| self.sleep.request_wake(number));
            }
        }
    }
}
