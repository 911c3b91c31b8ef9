//! Driven bodies do not sleep, however slowly they move: a motor of 0.05 rad/s is to turn by 1 rad in 20 s.
//!
//! | drive | keeps awake |
//! |---|---|
//! | motor of a joint | both bodies, while the joint moves |
//! | belt: surface velocity of a static body, or a speed that a handler has set | the bodies on it, while they move |
//! | kinematic body that moves | the bodies on it, and those at the other end of a joint or spring |
//!
//! A motor or a belt counts while its body moves by at least [`STALLED_DRIVE_SPEED`] of the drive's speed. So a motor of speed 0, one that
//! has come to its limit, one that is too weak for its load, and a body that a wall holds back on a belt let their islands
//! sleep. The sleepers wake when the drive, the wall or the load is edited, and when something awake touches them.

use super::Precise;
use super::rows::Lane;
use crate::body::BodyId;
use crate::objects::Objects;
use crate::precise::parameters::sleep::STALLED_DRIVE_SPEED;

impl Precise {
    /// Way of a body in the last step, length units: of its origin along all axes, and of its farthest point by turning.
    fn way_of(&self, body: usize) -> f32 {
        let [x, y, turned, z] = self.bodies.path[body];
        x.abs() + y.abs() + z.abs() + self.bodies.reaches[body] * turned.abs()
    }

    /// Whether a drive moves its body, by the body's way in the last step in the unit of the speed.
    fn drives(&self, speed: f32, way: f32) -> bool {
        speed != 0.0 && way >= STALLED_DRIVE_SPEED * speed.abs() * self.dt
    }

    /// Whether a body moves on a belt, by the row of its contact with the belt.
    pub(super) fn is_on_running_belt(&self, body: usize, lane: &Lane) -> bool {
        let speed = lane.tangent_speed.abs() + lane.space.across_speed.abs();
        lane.friction > 0.0 && self.drives(speed, self.way_of(body))
    }

    /// Calls for each body that is driven by a motor, or by a kinematic body at the other end of a joint or spring.
    pub(super) fn for_each_driven(&self, objects: &Objects, mut driven: impl FnMut(usize)) {
        for (ends, speed, is_along_line) in self.joints.motors() {
            let [a, b] = ends.map(|body| self.bodies.path.get(body).copied().unwrap_or_default());
            let [x, y, turned] = [0, 1, 2].map(|axis: usize| (b[axis] - a[axis]).abs());
            if self.drives(speed, if is_along_line { x + y } else { turned }) {
                ends.into_iter().filter(|&body| self.is_dynamic(body)).for_each(&mut driven);
            }
        }
        for [a, b] in self.joints.ties().chain(self.spring_ties(objects)) {
            for (one, other) in [(a, b), (b, a)] {
                if self.bodies.is_kinematic(one) && self.bodies.moves(one) && self.is_dynamic(other) {
                    driven(other);
                }
            }
        }
    }

    /// Bodies that springs tie to a kinematic body that begins to move are to wake.
    pub(super) fn note_moving_spring_ends(&mut self, objects: &Objects) {
        for at in 0..objects.springs.list().len() {
            let Some((_, spring)) = objects.springs.at(at).filter(|(_, spring)| spring.enabled()) else {
                continue;
            };
            let ends = spring.ends().map(|end| end.and_then(|id| Some((self.number_of(id)?, id))));
            let moves = |&(number, id): &(usize, BodyId)| {
                self.bodies.is_kinematic(number) && self.is_on_its_way(number, Some(id), objects)
            };
            if ends.iter().flatten().any(moves) {
                ends.into_iter().flatten().for_each(|(number, _)| self.sleep.note_waking(number));
            }
        }
    }
}
