//! Interpolation of poses between two updates, for smooth pictures.

use std::f64::consts::TAU;

use crate::{Drawable, TwoHalfPhysicsSimulator, Vector3};

/// Interpolated pose of a body or platform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InterpolatedPose3D {
    /// The [origin](crate::TwoHalfBody::origin3d) of a body, or the [place](crate::Platform::position3d) of a platform, px.
    pub place: Vector3,
    /// Rotation about the depth axis in radians; that of a body is not limited to one turn. Between two
    /// updates it takes the shorter arc, without whole turns.
    pub rotation: f32,
    /// Angle of a [turned](crate::Platform::yaw) platform about the upright axis in radians, also by the
    /// shorter arc; 0 for a body.
    pub yaw: f32,
}

impl InterpolatedPose3D {
    fn towards(self, after: Self, fraction: f64) -> Self {
        // In double precision the difference of two f32 numbers is always finite.
        let difference = |from: f32, to: f32| f64::from(to) - f64::from(from);
        let along = |from: f32, difference: f64| (f64::from(from) + difference * fraction) as f32;
        let turned = |from: f32, to: f32| {
            let turn = difference(from, to);
            along(from, turn - (turn / TAU).round() * TAU)
        };
        InterpolatedPose3D {
            place: self.place.zip_map(&after.place, |from, to| along(from, difference(from, to))),
            rotation: turned(self.rotation, after.rotation),
            yaw: turned(self.yaw, after.yaw),
        }
    }
}

/// Keeps the poses after the last two updates and interpolates between them, as
/// [`BodyInterpolation`](farseer_core::BodyInterpolation) does for the core.
///
/// A game that draws more often than it updates shows poses a fraction of an update late, but in smooth
/// motion. The simulation itself is not affected. The loop of such a game:
///
/// ```
/// use std::time::Duration;
/// use twohalf::{Drawable, FixedStepClock, Interpolation3D, Platform, TwoHalfPhysicsSimulator, Vector3};
///
/// let mut simulator = TwoHalfPhysicsSimulator::new(480)?;
/// let lift = Platform::new(&mut simulator, 80.0, 10.0, 60.0, Vector3::new(100.0, 0.0, 50.0), None)?;
/// simulator.platform_mut(lift).unwrap().set_velocity(Vector3::new(0.0, 50.0, 0.0))?;
///
/// let mut clock = FixedStepClock::new(Duration::from_millis(20))?;
/// let mut interpolation = Interpolation3D::new();
/// // Pictures every 7 ms, updates every 20 ms.
/// let heights = (0..9).map(|_| {
///     for _ in 0..clock.advance(Duration::from_millis(7)) {
///         simulator.update(clock.dt());
///         interpolation.remember(&simulator);
///     }
///     // `Scene::between` of `twohalf-render` draws all of a world like this.
///     interpolation.pose(Drawable::Platform(lift), clock.interpolation()).map(|pose| pose.place.y)
/// });
/// let heights: Vec<f32> = heights.flatten().collect();
/// // Nothing before the first update; from the second on 7 ms at 50 px/s are 0.35 px.
/// assert_eq!(heights.len(), 7);
/// assert!(heights[3..].windows(2).all(|pair| (pair[1] - pair[0] - 0.35).abs() < 1e-5));
/// # Ok::<(), twohalf::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Interpolation3D {
    /// Poses after the last update and after the update before, sorted by object.
    tracks: Vec<Track>,
    last: Vec<Track>,
}

#[derive(Debug, Clone, Copy)]
struct Track {
    thing: Drawable,
    before: InterpolatedPose3D,
    after: InterpolatedPose3D,
    /// Whether the next pose is a teleport, which is not interpolated.
    is_teleport: bool,
}

impl Interpolation3D {
    /// An interpolation without poses.
    pub fn new() -> Self {
        Self::default()
    }

    /// Stores the poses of the listed bodies and of the platforms; call it after **every** update. An object
    /// that is new in this update is drawn at its present pose. Allocates only when there are more objects
    /// than ever before.
    pub fn remember(&mut self, simulator: &TwoHalfPhysicsSimulator) {
        std::mem::swap(&mut self.tracks, &mut self.last);
        let bodies = simulator.body_list().iter().filter_map(|&id| {
            let body = simulator.body(id)?;
            let rotation = body.core().total_rotation();
            Some((Drawable::Body(id), InterpolatedPose3D { place: body.origin3d(), rotation, yaw: 0.0 }))
        });
        let platforms = simulator.platforms().filter_map(|id| {
            let platform = simulator.platform(id)?;
            let (place, rotation, yaw) = (platform.position3d(), platform.rotation(), platform.yaw());
            Some((Drawable::Platform(id), InterpolatedPose3D { place, rotation, yaw }))
        });
        let fresh = |(thing, after)| Track { thing, before: after, after, is_teleport: false };
        self.tracks.clear();
        self.tracks.extend(bodies.chain(platforms).map(fresh));
        self.tracks.sort_unstable_by_key(|track| track.thing);
        let mut rest = &self.last[..];
        for track in &mut self.tracks {
            let at = rest.iter().take_while(|last| last.thing < track.thing).count();
            rest = &rest[at..];
            if let Some(last) = rest.first().filter(|last| last.thing == track.thing && !last.is_teleport) {
                track.before = last.after;
            }
        }
    }

    /// Marks a teleport: the motion to the pose after the next update is not interpolated.
    pub fn mark_teleport(&mut self, thing: Drawable) {
        if let Ok(at) = self.find(thing) {
            self.tracks[at].is_teleport = true;
        }
    }

    /// The pose of an object at a fraction of the next update's time:
    /// [`FixedStepClock::interpolation`](farseer_core::FixedStepClock::interpolation). 0 is the pose after
    /// the last update but one, 1 the present one; other numbers are clamped, NaN is 1. `None` for an object
    /// that was absent after the last update.
    pub fn pose(&self, thing: Drawable, fraction: f32) -> Option<InterpolatedPose3D> {
        let Track { before, after, .. } = self.tracks[self.find(thing).ok()?];
        if fraction <= 0.0 {
            Some(before)
        } else if fraction >= 1.0 || fraction.is_nan() {
            Some(after)
        } else {
            Some(before.towards(after, f64::from(fraction)))
        }
    }

    /// Removes all poses; for games that load a save.
    pub fn clear(&mut self) {
        self.tracks.clear();
    }

    fn find(&self, thing: Drawable) -> Result<usize, usize> {
        self.tracks.binary_search_by_key(&thing, |track| track.thing)
    }
}
