//! Poses of bodies interpolated between two updates, for smooth pictures.

use std::f64::consts::TAU;

use crate::body::{Body, BodyId};
use crate::math::Vector2;
use crate::objects::Objects;

/// The interpolated pose at which a body is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InterpolatedPose {
    /// Position of the body's origin, in length units.
    pub position: Vector2,
    /// [Total rotation](Body::total_rotation) in radians: not limited to one turn. Between two updates it takes the
    /// shorter direction, whatever full turns are in between: a game that [sets](Body::set_rotation) an angle in every
    /// update changes them.
    pub rotation: f32,
}

impl InterpolatedPose {
    fn of(body: &Body) -> Self {
        InterpolatedPose { position: body.position(), rotation: body.total_rotation() }
    }
}

/// Stores the poses of bodies after the last two updates and interpolates between them.
///
/// A game that draws more often than it updates shows bodies a fraction of an update late, but with smooth motion. The
/// simulation itself is not affected.
///
/// ```
/// use farseer_core::{BodyFactory, BodyInterpolation, PhysicsSimulator, math::Vector2};
///
/// let mut simulator = PhysicsSimulator::default();
/// let body = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0)?;
/// simulator[body].set_linear_velocity(Vector2::new(100.0, 0.0));
///
/// let mut interpolation = BodyInterpolation::new();
/// for _ in 0..2 {
///     simulator.update(0.01);
///     interpolation.remember(&simulator);
/// }
/// // The body went from x = 1 to x = 2; a quarter of the next update's time has passed.
/// let pose = interpolation.pose(body, 0.25).unwrap();
/// assert!((pose.position.x - 1.25).abs() < 0.001);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct BodyInterpolation {
    /// Stored poses, by slot of the body.
    tracks: Vec<Option<Track>>,
    /// Number of the last update that was stored.
    update: u64,
}

#[derive(Debug, Clone, Copy)]
struct Track {
    body: BodyId,
    before: InterpolatedPose,
    after: InterpolatedPose,
    /// Number of the last update with the body in its list.
    update: u64,
    /// Whether the next pose is not interpolated from the present one.
    is_teleported: bool,
}

impl BodyInterpolation {
    /// An interpolation without poses.
    pub fn new() -> Self {
        Self::default()
    }

    /// Stores the poses of the [listed](Objects::body_list) bodies; to be called after **every** update. Bodies that
    /// were not listed after the update before are drawn at their present poses. It allocates only when there are more
    /// bodies than ever before.
    pub fn remember(&mut self, simulator: &Objects) {
        let last = self.update;
        self.update += 1;
        for &id in simulator.body_list() {
            let Some(body) = simulator.body(id) else { continue };
            if id.slot() >= self.tracks.len() {
                self.tracks.resize(id.slot() + 1, None);
            }
            let after = InterpolatedPose::of(body);
            let track = &mut self.tracks[id.slot()];
            let before = match track {
                Some(track) if track.body == id && track.update == last && !track.is_teleported => {
                    track.after
                }
                _ => after,
            };
            *track = Some(Track { body: id, before, after, update: self.update, is_teleported: false });
        }
    }

    /// Marks a teleport of a body: there is no interpolation between its present pose and that after the next update.
    /// For bodies that a game places elsewhere; other bodies that it moves are interpolated.
    pub fn mark_teleport(&mut self, body: BodyId) {
        if let Some(track) = self.track_mut(body) {
            track.is_teleported = true;
        }
    }

    /// The interpolated pose of a body at a fraction of the next update's time, such as
    /// [`FixedStepClock::interpolation`](crate::FixedStepClock::interpolation). At 0 it is the pose after the last
    /// update but one, at 1 the present one. Other numbers are clamped, NaN counts as 1. `None` for bodies that were
    /// not listed after the last update.
    pub fn pose(&self, body: BodyId, fraction: f32) -> Option<InterpolatedPose> {
        let track = self.tracks.get(body.slot())?.as_ref()?;
        if track.body != body || track.update != self.update {
            return None;
        }
        let Track { before, after, .. } = *track;
        if fraction <= 0.0 {
            return Some(before);
        }
        if fraction >= 1.0 || fraction.is_nan() {
            return Some(after);
        }
        // In double precision no difference of two floats is infinite.
        let difference = |from: f32, to: f32| f64::from(to) - f64::from(from);
        let along = |from: f32, difference: f64| (f64::from(from) + difference * f64::from(fraction)) as f32;
        let between = |from: f32, to: f32| along(from, difference(from, to));
        let turn = difference(before.rotation, after.rotation);
        let short_turn = turn - (turn / TAU).round() * TAU;
        Some(InterpolatedPose {
            position: Vector2::new(
                between(before.position.x, after.position.x),
                between(before.position.y, after.position.y),
            ),
            rotation: along(before.rotation, short_turn),
        })
    }

    /// Removes all poses; for games that load a save.
    pub fn clear(&mut self) {
        self.tracks.clear();
    }

    fn track_mut(&mut self, body: BodyId) -> Option<&mut Track> {
        self.tracks.get_mut(body.slot())?.as_mut().filter(|track| track.body == body)
    }
}
