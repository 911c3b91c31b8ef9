//! What judges are made of: each part looks at one thing that can go wrong.

use super::reasons;
use crate::scenes::movable;
use crate::scenes::stage::METRE;
use crate::watch::{Largest, Watch, made_of};
use crate::world::{BodyState, World, distance};
use conformance::scene::{JointKind, Scene};
use farseer_core::math::Vector2;
use std::ops::RangeBounds;

/// Faster than anything in these scenes can fall or be thrown, in px/s: 100 m/s.
pub(super) const SPEED_LIMIT: f64 = 3200.0;

/// All parts; the first that failed gives the reason, the last one the measure.
pub(super) fn all(parts: Vec<Box<dyn Watch>>) -> Box<dyn Watch> {
    Box::new(All(parts))
}

struct All(Vec<Box<dyn Watch>>);

impl Watch for All {
    fn see(&mut self, time: f64, world: &dyn World) {
        for part in &mut self.0 {
            part.see(time, world);
        }
    }

    fn error(&self) -> f64 {
        self.0.last().map_or(f64::NAN, |part| part.error())
    }

    fn failed(&self) -> Option<&'static str> {
        self.0.iter().find_map(|part| part.failed())
    }
}

/// Every body is finite, at every step, and none is faster than a limit in px/s. Measures the greatest speed.
pub(super) fn calm(scene: &Scene, limit: f64) -> Box<dyn Watch> {
    let bodies = movable(scene);
    made_of(
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

/// How far from where they began bodies may be at the end and still stand.
#[derive(Debug, Clone, Copy)]
pub(super) struct Allowed {
    /// Sideways, in px.
    pub shift: f64,
    /// Turned, in rad.
    pub turn: f64,
    /// Moved in the last fifth of the run, in px.
    pub creep: f64,
}

impl Allowed {
    /// For boxes of a metre: half a box sideways, 20 degrees, a twentieth of a box.
    pub(super) const BOXES: Allowed = Allowed { shift: 16.0, turn: 0.35, creep: 1.6 };
}

/// How much lower or higher than it began a thing may stand, in px, when it began at a height above the floor: a tenth
/// of it, and half a metre at most, or a high column could lose whole boxes.
fn allowed_rise(height: f64) -> f64 {
    (0.1 * height).min(0.5 * f64::from(METRE))
}

/// Everything is where it began, on a floor whose surface is y = 0. Measures the greatest distance from there in px.
pub(super) fn standing(scene: &Scene, seconds: f64, allowed: Allowed) -> Box<dyn Watch> {
    let bodies = movable(scene);
    made_of(
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

/// How bodies were at the start and before the last fifth of the run, and how they are.
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

/// The ends of all joints that share a point are together in the last fifth of the run, up to a limit in px, or there is
/// a reason why not: what still swings is not judged by the moment at which the run happens to end. Measures the widest
/// gap of that time in px.
pub(super) fn joined(scene: &Scene, seconds: f64, limit: f64, reason: &'static str) -> Box<dyn Watch> {
    let points: Vec<_> = scene.joints.iter().filter_map(|joint| shared_point(&joint.kind)).collect();
    // The points on the bodies, once they are known.
    let mut ends: Vec<([f64; 2], [f64; 2])> = Vec::new();
    made_of(
        Largest::default(),
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

/// The point that a joint holds together: of a body, and of another body or the world.
fn shared_point(kind: &JointKind) -> Option<(usize, Option<usize>, [f64; 2])> {
    match *kind {
        JointKind::Revolute { body1, body2, anchor } | JointKind::Weld { body1, body2, anchor } => {
            Some((body1, Some(body2), point(anchor)))
        }
        JointKind::FixedRevolute { body, anchor } => Some((body, None, point(anchor))),
        _ => None,
    }
}

/// A measure of the bodies stays within a limit at every step. Measures the greatest value.
pub(super) fn never_above(
    limit: f64,
    reason: &'static str,
    measure: impl Fn(&dyn World) -> f64 + 'static,
) -> Box<dyn Watch> {
    made_of(
        f64::NEG_INFINITY,
        move |greatest, _, world| *greatest = greatest.max(measure(world)),
        |&greatest| greatest,
        move |&greatest| (greatest > limit).then_some(reason),
    )
}

/// A measure of each body is at least so much at some step, not necessarily the same for all, or there is a reason why
/// not. Measures how far the one got that got least far.
pub(super) fn each_reaches(
    scene: &Scene,
    least: f64,
    reason: &'static str,
    measure: impl Fn(BodyState) -> f64 + 'static,
) -> Box<dyn Watch> {
    let bodies = movable(scene);
    let least_far = |farthest: &Vec<f64>| farthest.iter().copied().fold(f64::INFINITY, f64::min);
    made_of(
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

/// A measure of the bodies is in a range at the end, or there is a reason why not.
pub(super) fn ends_in(
    range: impl RangeBounds<f64> + 'static,
    reason: &'static str,
    measure: impl Fn(&dyn World) -> f64 + 'static,
) -> Box<dyn Watch> {
    made_of(
        f64::NAN,
        move |last, _, world| *last = measure(world),
        |&last| last,
        move |last| (!range.contains(last)).then_some(reason),
    )
}

fn point(vector: Vector2) -> [f64; 2] {
    [vector.x, vector.y].map(f64::from)
}
