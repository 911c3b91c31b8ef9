//! Conversion of units, and the state of a body in another engine (peer).

use crate::world::BodyState;
use std::cell::Cell;
use std::f64::consts::TAU;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Length of a metre in px.
pub(super) const METRE: f64 = 32.0;

/// Converts a length, speed or acceleration from px (px/s, px/s²) to metres (m/s, m/s²).
pub(super) fn metres(px: f64) -> f32 {
    (px / METRE) as f32
}

/// Converts a point or vector from px to metres.
pub(super) fn point(px: [f64; 2]) -> [f32; 2] {
    px.map(metres)
}

/// Converts a moment of inertia, a torque or an angular stiffness, which contain px², to m².
pub(super) fn square_metres(value: f64) -> f32 {
    (value / (METRE * METRE)) as f32
}

/// Converts a point or vector from metres to px; the third component is 0.
fn px([x, y]: [f32; 2]) -> [f64; 3] {
    [x, y, 0.0].map(|part| f64::from(part) * METRE)
}

/// State of a body in a peer: metres, m/s and radians/s, the rotation as cosine and sine.
#[derive(Debug, Clone, Copy)]
pub(super) struct PeerState {
    pub(super) position: [f32; 2],
    pub(super) rotation: [f32; 2],
    pub(super) velocity: [f32; 2],
    pub(super) angular_velocity: f32,
}

/// Counts the full turns of bodies: peers know rotations up to full turns. The number of turns follows from the angular
/// velocity and the time since the last observation, if the angular velocity is about constant in between.
#[derive(Debug)]
pub(super) struct TurnCounter {
    time: f64,
    last: Vec<Cell<LastState>>,
}

#[derive(Debug, Clone, Copy)]
struct LastState {
    time: f64,
    angle: f64,
    angular_velocity: f64,
}

impl TurnCounter {
    /// Starts with bodies of a rotation in radians and an angular velocity in radians/s.
    pub(super) fn new(bodies: impl Iterator<Item = (f64, f64)>) -> Self {
        let seen = |(angle, angular_velocity)| Cell::new(LastState { time: 0.0, angle, angular_velocity });
        TurnCounter { time: 0.0, last: bodies.map(seen).collect() }
    }

    /// Advances the time by `dt` s.
    pub(super) fn advance(&mut self, dt: f32) {
        self.time += f64::from(dt);
    }

    /// Returns the number of bodies.
    pub(super) fn len(&self) -> usize {
        self.last.len()
    }

    /// Sets the angular velocity of a body in radians/s, and its rotation in radians if the body was teleported.
    pub(super) fn set(&self, index: usize, angle: Option<f64>, angular_velocity: Option<f64>) {
        let seen = self.last[index].get();
        let angle = angle.unwrap_or(seen.angle);
        let angular_velocity = angular_velocity.unwrap_or(seen.angular_velocity);
        self.last[index].set(LastState { time: self.time, angle, angular_velocity });
    }

    /// Returns the state of a body in px, with the rotation including full turns. All values are NaN if `told` is `None`: the
    /// peer gave no state.
    pub(super) fn state(&self, index: usize, told: Option<PeerState>) -> BodyState {
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
        let seen = self.last[index].get();
        let angle = f64::from(sine).atan2(f64::from(cosine));
        let turned = (seen.angular_velocity + angular_velocity) / 2.0 * (self.time - seen.time);
        let angle = angle + TAU * ((seen.angle + turned - angle) / TAU).round();
        if angle.is_finite() {
            self.last[index].set(LastState { time: self.time, angle, angular_velocity });
        }
        angle
    }
}

/// Calls a function that may fail or panic in a peer. Returns whether it succeeded.
pub(super) fn succeeds(act: impl FnOnce() -> Result<(), String>) -> bool {
    matches!(catch_unwind(AssertUnwindSafe(act)), Ok(Ok(())))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spinning(angle: f64, angular_velocity: f64) -> PeerState {
        PeerState {
            position: [1.0, -2.0],
            rotation: [angle.cos() as f32, angle.sin() as f32],
            velocity: [0.0; 2],
            angular_velocity: angular_velocity as f32,
        }
    }

    #[test]
    fn turns_are_counted_at_any_speed_in_both_directions() {
        for angular_velocity in [0.3, 7.0, 500.0, -500.0] {
            let mut turns = TurnCounter::new(std::iter::once((0.5, angular_velocity)));
            for step in 1..200 {
                turns.advance(0.016);
                let angle = 0.5 + angular_velocity * f64::from(step) * f64::from(0.016_f32);
                let seen = turns.state(0, Some(spinning(angle, angular_velocity)));
                assert!((seen.angle - angle).abs() < 1e-4, "{} {angle}", seen.angle);
            }
        }
    }

    #[test]
    fn a_teleported_body_keeps_its_number_of_turns() {
        let mut turns = TurnCounter::new(std::iter::once((0.0, 0.0)));
        turns.set(0, Some(20.0), None);
        turns.advance(0.1);
        let seen = turns.state(0, Some(spinning(20.1, 1.0)));
        assert!((seen.angle - 20.1).abs() < 1e-6);
        assert_eq!(seen.position, [32.0, -64.0, 0.0]);
    }
}
