//! Building blocks of judges. Each is a watch that tests for one kind of failure.

use super::reasons;
use crate::scenes::movable;
use crate::scenes::stage::METRE;
use crate::watch::{Maximum, Watch, custom_watch};
use crate::world::{BodyState, World, distance};
use conformance::scene::{JointKind, Scene};
use farseer_core::math::Vector2;
use std::ops::RangeBounds;

/// Speed limit in px/s: 100 m/s, faster than any body in these scenes can fall or be thrown.
pub(super) const SPEED_LIMIT: f64 = 3200.0;

/// Combines watches: the first of `parts` that failed gives the reason, and the last of `parts` gives the measured value.
pub(super) fn all(parts: Vec<Box<dyn Watch>>) -> Box<dyn Watch> {
    Box::new(All(parts))
}

struct All(Vec<Box<dyn Watch>>);

impl Watch for All {
    fn observe(&mut self, time: f64, world: &dyn World) {
        for part in &mut self.0 {
            part.observe(time, world);
        }
    }

    fn error(&self) -> f64 {
        self.0.last().map_or(f64::NAN, |part| part.error())
    }

    fn failed(&self) -> Option<&'static str> {
        self.0.iter().find_map(|part| part.failed())
    }
}

/// Returns a watch that fails if the state of a body is not finite or a body is faster than `limit` px/s, at any step. It
/// measures the greatest speed in px/s.
pub(super) fn calm(scene: &Scene, limit: f64) -> Box<dyn Watch> {
    let bodies = movable(scene);
    custom_watch(
        (0.0_f64, true),
        move |(fastest, is_finite), _, world| {
            for &index in &bodies {
                let body = world.body(index);
                *is_finite &= body.is_finite();
                *fastest = fastest.max(body.speed());
            }
        },
        |&(fastest, _)| fastest,
        move |&(fastest, is_finite)| match (is_finite, fastest > limit) {
            (false, _) => Some(reasons::NOT_FINITE),
            (true, true) => Some(reasons::BLEW_UP),
            _ => None,
        },
    )
}

/// Greatest displacements from the start with which a body still counts as standing at the end of a run.
#[derive(Debug, Clone, Copy)]
pub(super) struct Allowed {
    /// Greatest displacement sideways, in px.
    pub shift: f64,
    /// Greatest rotation, in radians.
    pub turn: f64,
    /// Greatest displacement in the last fifth of the run, in px.
    pub creep: f64,
}

impl Allowed {
    /// Limits for boxes of a metre: half a box sideways, 20 degrees (0.35 rad), and a twentieth of a box of creep.
    pub(super) const BOXES: Allowed = Allowed { shift: 16.0, turn: 0.35, creep: 1.6 };
}

/// Returns the greatest rise or fall in px of a body that began `height` px above the floor: a tenth of `height`, at most half
/// a metre. Without the maximum, a high column could lose complete boxes.
fn allowed_rise(height: f64) -> f64 {
    (0.1 * height).min(0.5 * f64::from(METRE))
}

/// Returns a watch that fails if a body is not where it began at the end, on a floor whose surface is y = 0. `seconds` is the
/// duration of the run. The watch measures the greatest distance from the start in px.
pub(super) fn standing(scene: &Scene, seconds: f64, allowed: Allowed) -> Box<dyn Watch> {
    let bodies = movable(scene);
    custom_watch(
        Stand::default(),
        move |stand, time, world| {
            stand.now = bodies.iter().map(|&index| world.body(index)).collect();
            if stand.start.is_empty() {
                stand.start.clone_from(&stand.now);
            }
            if time <= 0.8 * seconds {
                stand.late.clone_from(&stand.now);
            }
        },
        |stand| {
            let pairs = stand.start.iter().zip(&stand.now);
            pairs.map(|(start, now)| distance(start.position, now.position)).fold(0.0, f64::max)
        },
        move |stand| stand.failed(allowed),
    )
}

/// States of all bodies at the start, before the last fifth of the run, and now.
#[derive(Default)]
struct Stand {
    start: Vec<BodyState>,
    late: Vec<BodyState>,
    now: Vec<BodyState>,
}

impl Stand {
    fn failed(&self, Allowed { shift, turn, creep }: Allowed) -> Option<&'static str> {
        let any = |before: &[BodyState], is_off: &dyn Fn(&BodyState, &BodyState) -> bool| {
            before.iter().zip(&self.now).any(|(before, now)| is_off(before, now))
        };
        let rise = |start: &BodyState, now: &BodyState| start.position[1] - now.position[1];
        let allowed = |start: &BodyState| allowed_rise(-start.position[1]);
        let has_left = |start: &BodyState, now: &BodyState| {
            (now.position[0] - start.position[0]).abs() > shift || (now.angle - start.angle).abs() > turn
        };
        if any(&self.start, &has_left) {
            Some(reasons::TOPPLED)
        } else if any(&self.start, &|start, now| rise(start, now) < -allowed(start)) {
            Some(reasons::SANK)
        } else if any(&self.start, &|start, now| rise(start, now) > allowed(start)) {
            Some(reasons::BLEW_UP)
        } else if any(&self.late, &|late, now| distance(late.position, now.position) > creep) {
            Some(reasons::CREPT)
        } else {
            None
        }
    }
}

/// Returns a watch that fails with `reason` if the ends of a joint are more than `limit` px apart in the last fifth of the run.
/// An interval longer than a step keeps the phase of a swing out of the verdict. The watch measures the widest gap of that
/// interval in px.
pub(super) fn joined(scene: &Scene, seconds: f64, limit: f64, reason: &'static str) -> Box<dyn Watch> {
    let points: Vec<_> = scene.joints.iter().filter_map(|joint| shared_point(&joint.kind)).collect();
    // The anchors of each joint in the coordinates of the two bodies, computed at the first observation.
    let mut ends: Vec<([f64; 2], [f64; 2])> = Vec::new();
    custom_watch(
        Maximum::default(),
        move |widest, time, world| {
            if ends.is_empty() {
                let local = |&(one, two, anchor): &(usize, Option<usize>, [f64; 2])| {
                    let on = |index| world.body(index).to_local(anchor);
                    (on(one), two.map_or(anchor, on))
                };
                ends = points.iter().map(local).collect();
            }
            if time <= 0.8 * seconds {
                return;
            }
            for (&(one, two, _), &(end1, end2)) in points.iter().zip(&ends) {
                let place1 = world.body(one).to_world(end1);
                let place2 = two.map_or(end2, |two| world.body(two).to_world(end2));
                widest.take(distance(place1, place2));
            }
        },
        |widest| widest.get(),
        move |widest| (widest.get() > limit).then_some(reason),
    )
}

/// Returns the point at which a joint connects its bodies: index of the first body, index of the second (`None` for the world),
/// and the point in the world in px. `None` for a joint without such a point.
fn shared_point(kind: &JointKind) -> Option<(usize, Option<usize>, [f64; 2])> {
    match *kind {
        JointKind::Revolute { body1, body2, anchor } | JointKind::Weld { body1, body2, anchor } => {
            Some((body1, Some(body2), point(anchor)))
        }
        JointKind::FixedRevolute { body, anchor } => Some((body, None, point(anchor))),
        _ => None,
    }
}

/// Returns a watch that fails with `reason` if a measure of the bodies exceeds `limit` at any step. It measures the greatest
/// value.
pub(super) fn never_above(
    limit: f64,
    reason: &'static str,
    measure: impl Fn(&dyn World) -> f64 + 'static,
) -> Box<dyn Watch> {
    custom_watch(
        f64::NEG_INFINITY,
        move |greatest, _, world| *greatest = greatest.max(measure(world)),
        |&greatest| greatest,
        move |&greatest| (greatest > limit).then_some(reason),
    )
}

/// Returns a watch that fails with `reason` unless the measure of each body reaches `limit` at some step, not necessarily the
/// same step for all. It measures the least of the bodies' maxima.
pub(super) fn each_reaches(
    scene: &Scene,
    least: f64,
    reason: &'static str,
    measure: impl Fn(BodyState) -> f64 + 'static,
) -> Box<dyn Watch> {
    let bodies = movable(scene);
    let least_far = |farthest: &Vec<f64>| farthest.iter().copied().fold(f64::INFINITY, f64::min);
    custom_watch(
        vec![f64::NEG_INFINITY; bodies.len()],
        move |farthest, _, world| {
            for (&index, farthest) in bodies.iter().zip(farthest) {
                *farthest = farthest.max(measure(world.body(index)));
            }
        },
        least_far,
        move |farthest| (least_far(farthest) < least).then_some(reason),
    )
}

/// Returns a watch that fails if a measure of the bodies is outside of a range at the end of the run.
pub(super) fn ends_in(
    range: impl RangeBounds<f64> + 'static,
    reason: &'static str,
    measure: impl Fn(&dyn World) -> f64 + 'static,
) -> Box<dyn Watch> {
    custom_watch(
        f64::NAN,
        move |last, _, world| *last = measure(world),
        |&last| last,
        move |last| (!range.contains(last)).then_some(reason),
    )
}

fn point(vector: Vector2) -> [f64; 2] {
    [vector.x, vector.y].map(f64::from)
}
