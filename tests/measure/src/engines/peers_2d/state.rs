//! Units, and what is seen of a body in a peer.

use crate::world::BodyState;
use std::cell::Cell;
use std::f64::consts::TAU;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Px of a metre.
pub(super) const METRE: f64 = 32.0;

/// A length, speed or acceleration from px to metres.
pub(super) fn metres(px: f64) -> f32 {
    (px / METRE) as f32
}

/// The same of a point or vector.
pub(super) fn point(px: [f64; 2]) -> [f32; 2] {
    px.map(metres)
}

/// A moment of inertia, a torque or what is per angle of it, from px² to square metres.
pub(super) fn square_metres(value: f64) -> f32 {
    (value / (METRE * METRE)) as f32
}

/// A point or vector from metres to px.
fn px([x, y]: [f32; 2]) -> [f64; 3] {
    [x, y, 0.0].map(|part| f64::from(part) * METRE)
}

/// What a peer tells of a body, in metres, the rotation as cosine and sine.
#[derive(Debug, Clone, Copy)]
pub(super) struct Told {
    pub(super) position: [f32; 2],
    pub(super) rotation: [f32; 2],
    pub(super) velocity: [f32; 2],
    pub(super) angular_velocity: f32,
}

/// Total angles: peers know angles up to whole turns. A turn is told by how far the body must have turned since it was
/// last looked at, which holds if it is looked at often enough for its angular velocity to be about even between.
#[derive(Debug)]
pub(super) struct Turns {
    time: f64,
    seen: Vec<Cell<Seen>>,
}

#[derive(Debug, Clone, Copy)]
struct Seen {
    time: f64,
    angle: f64,
    angular_velocity: f64,
}

impl Turns {
    /// Bodies by angle in rad and angular velocity in rad/s.
    pub(super) fn new(bodies: impl Iterator<Item = (f64, f64)>) -> Self {
        let seen = |(angle, angular_velocity)| Cell::new(Seen { time: 0.0, angle, angular_velocity });
        Turns { time: 0.0, seen: bodies.map(seen).collect() }
    }

    /// Time goes by.
    pub(super) fn advance(&mut self, dt: f32) {
        self.time += f64::from(dt);
    }

    /// Number of bodies.
    pub(super) fn len(&self) -> usize {
        self.seen.len()
    }

    /// A body got an angular velocity, and an angle if it was put elsewhere.
    pub(super) fn set(&self, index: usize, angle: Option<f64>, angular_velocity: Option<f64>) {
        let seen = self.seen[index].get();
        let angle = angle.unwrap_or(seen.angle);
        let angular_velocity = angular_velocity.unwrap_or(seen.angular_velocity);
        self.seen[index].set(Seen { time: self.time, angle, angular_velocity });
    }

    /// What is seen of a body. Nothing is a number if the peer tells nothing.
    pub(super) fn see(&self, index: usize, told: Option<Told>) -> BodyState {
        let Some(told) = told else {
            let nothing = [f64::NAN; 3];
            return BodyState {
                position: nothing,
                angle: f64::NAN,
                velocity: nothing,
                angular_velocity: f64::NAN,
            };
        };
        let angular_velocity = f64::from(told.angular_velocity);
        BodyState {
            position: px(told.position),
            angle: self.total_angle(index, told.rotation, angular_velocity),
            velocity: px(told.velocity),
            angular_velocity,
        }
    }

    fn total_angle(&self, index: usize, [cosine, sine]: [f32; 2], angular_velocity: f64) -> f64 {
        let seen = self.seen[index].get();
        let angle = f64::from(sine).atan2(f64::from(cosine));
        let turned = (seen.angular_velocity + angular_velocity) / 2.0 * (self.time - seen.time);
        let angle = angle + TAU * ((seen.angle + turned - angle) / TAU).round();
        if angle.is_finite() {
            self.seen[index].set(Seen { time: self.time, angle, angular_velocity });
        }
        angle
    }
}

/// Does something with a peer that may refuse or panic: whether it did neither.
pub(super) fn goes_well(act: impl FnOnce() -> Result<(), String>) -> bool {
    matches!(catch_unwind(AssertUnwindSafe(act)), Ok(Ok(())))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spinning(angle: f64, angular_velocity: f64) -> Told {
        Told {
            position: [1.0, -2.0],
            rotation: [angle.cos() as f32, angle.sin() as f32],
            velocity: [0.0; 2],
            angular_velocity: angular_velocity as f32,
        }
    }

    #[test]
    fn turns_are_counted_at_any_speed_and_either_way() {
        for angular_velocity in [0.3, 7.0, 500.0, -500.0] {
            let mut turns = Turns::new(std::iter::once((0.5, angular_velocity)));
            for step in 1..200 {
                turns.advance(0.016);
                let angle = 0.5 + angular_velocity * f64::from(step) * f64::from(0.016_f32);
                let seen = turns.see(0, Some(spinning(angle, angular_velocity)));
                assert!((seen.angle - angle).abs() < 1e-4, "{} {angle}", seen.angle);
            }
        }
    }

    #[test]
    fn a_body_that_is_put_elsewhere_keeps_the_turns_it_was_given() {
        let mut turns = Turns::new(std::iter::once((0.0, 0.0)));
        turns.set(0, Some(20.0), None);
        turns.advance(0.1);
        let seen = turns.see(0, Some(spinning(20.1, 1.0)));
        assert!((seen.angle - 20.1).abs() < 1e-6);
        assert_eq!(seen.position, [32.0, -64.0, 0.0]);
    }
}
