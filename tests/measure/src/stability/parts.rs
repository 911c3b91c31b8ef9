//! What judges are made of: each part looks at one thing that can go wrong.

use super::reasons;
use crate::scenes::stage::METRE;
use crate::watch::{Largest, Watch};
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

/// The indices of the bodies that move.
pub(super) fn movable(scene: &Scene) -> Vec<usize> {
    let is_movable = |&index: &usize| scene.bodies[index].is_static != Some(true);
    (0..scene.bodies.len()).filter(is_movable).collect()
}

/// Every body is finite, at every step, and none is faster than a limit in px/s. Measures the greatest speed.
pub(super) fn calm(scene: &Scene, limit: f64) -> Box<dyn Watch> {
    Box::new(Calm { bodies: movable(scene), limit, fastest: 0.0, is_finite: true })
}

struct Calm {
    bodies: Vec<usize>,
    limit: f64,
    fastest: f64,
    is_finite: bool,
}

impl Watch for Calm {
    fn see(&mut self, _: f64, world: &dyn World) {
        for &index in &self.bodies {
            let body = world.body(index);
            self.is_finite &= body.is_finite();
            self.fastest = self.fastest.max(body.speed());
        }
    }

    fn error(&self) -> f64 {
        self.fastest
    }

    fn failed(&self) -> Option<&'static str> {
        match (self.is_finite, self.fastest > self.limit) {
            (false, _) => Some(reasons::NOT_FINITE),
            (true, true) => Some(reasons::BLEW_UP),
            _ => None,
        }
    }
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
    Box::new(Standing { bodies, seconds, allowed, start: vec![], late: vec![], now: vec![] })
}

struct Standing {
    bodies: Vec<usize>,
    seconds: f64,
    allowed: Allowed,
    start: Vec<BodyState>,
    late: Vec<BodyState>,
    now: Vec<BodyState>,
}

impl Watch for Standing {
    fn see(&mut self, time: f64, world: &dyn World) {
        self.now.clear();
        self.now.extend(self.bodies.iter().map(|&index| world.body(index)));
        if self.start.is_empty() {
            self.start.clone_from(&self.now);
        }
        if time <= 0.8 * self.seconds {
            self.late.clone_from(&self.now);
        }
    }

    fn error(&self) -> f64 {
        let pairs = self.start.iter().zip(&self.now);
        pairs.map(|(start, now)| distance(start.position, now.position)).fold(0.0, f64::max)
    }

    fn failed(&self) -> Option<&'static str> {
        let Allowed { shift, turn, creep } = self.allowed;
        let any = |is_off: &dyn Fn(&BodyState, &BodyState) -> bool, before: &[BodyState]| {
            before.iter().zip(&self.now).any(|(before, now)| is_off(before, now))
        };
        let has_left = |start: &BodyState, now: &BodyState| {
            (now.position[0] - start.position[0]).abs() > shift || (now.angle - start.angle).abs() > turn
        };
        let rise = |start: &BodyState, now: &BodyState| start.position[1] - now.position[1];
        let has_sunk =
            |start: &BodyState, now: &BodyState| rise(start, now) < -allowed_rise(-start.position[1]);
        let has_risen =
            |start: &BodyState, now: &BodyState| rise(start, now) > allowed_rise(-start.position[1]);
        let creeps = |late: &BodyState, now: &BodyState| distance(late.position, now.position) > creep;
        if any(&has_left, &self.start) {
            Some(reasons::TOPPLED)
        } else if any(&has_sunk, &self.start) {
            Some(reasons::SANK)
        } else if any(&has_risen, &self.start) {
            Some(reasons::BLEW_UP)
        } else if any(&creeps, &self.late) {
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
    let points = scene.joints.iter().filter_map(|joint| shared_point(&joint.kind)).collect();
    Box::new(Joined { points, seconds, limit, reason, ends: vec![], widest: Largest::default() })
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

struct Joined {
    points: Vec<(usize, Option<usize>, [f64; 2])>,
    seconds: f64,
    limit: f64,
    reason: &'static str,
    /// The points on the bodies, once they are known.
    ends: Vec<([f64; 2], [f64; 2])>,
    widest: Largest,
}

impl Watch for Joined {
    fn see(&mut self, time: f64, world: &dyn World) {
        if self.ends.is_empty() {
            let local = |&(one, two, anchor): &(usize, Option<usize>, [f64; 2])| {
                let on = |index| world.body(index).to_local(anchor);
                (on(one), two.map_or(anchor, on))
            };
            self.ends = self.points.iter().map(local).collect();
        }
        if time <= 0.8 * self.seconds {
            return;
        }
        for (&(one, two, _), &(end1, end2)) in self.points.iter().zip(&self.ends) {
            let place1 = world.body(one).to_world(end1);
            let place2 = two.map_or(end2, |two| world.body(two).to_world(end2));
            self.widest.take(distance(place1, place2));
        }
    }

    fn error(&self) -> f64 {
        self.widest.get()
    }

    fn failed(&self) -> Option<&'static str> {
        (self.widest.get() > self.limit).then_some(self.reason)
    }
}

/// A measure of the bodies stays within a limit at every step. Measures the greatest value.
pub(super) fn never_above(
    limit: f64,
    reason: &'static str,
    measure: impl Fn(&dyn World) -> f64 + 'static,
) -> Box<dyn Watch> {
    Box::new(NeverAbove { limit, reason, measure, greatest: f64::NEG_INFINITY })
}

struct NeverAbove<F> {
    limit: f64,
    reason: &'static str,
    measure: F,
    greatest: f64,
}

impl<F: Fn(&dyn World) -> f64> Watch for NeverAbove<F> {
    fn see(&mut self, _: f64, world: &dyn World) {
        let measured = (self.measure)(world);
        if measured > self.greatest {
            self.greatest = measured;
        }
    }

    fn error(&self) -> f64 {
        self.greatest
    }

    fn failed(&self) -> Option<&'static str> {
        (self.greatest > self.limit).then_some(self.reason)
    }
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
    let farthest = vec![f64::NEG_INFINITY; bodies.len()];
    Box::new(EachReaches { bodies, least, reason, measure, farthest })
}

struct EachReaches<F> {
    bodies: Vec<usize>,
    least: f64,
    reason: &'static str,
    measure: F,
    farthest: Vec<f64>,
}

impl<F: Fn(BodyState) -> f64> Watch for EachReaches<F> {
    fn see(&mut self, _: f64, world: &dyn World) {
        for (&index, farthest) in self.bodies.iter().zip(&mut self.farthest) {
            *farthest = farthest.max((self.measure)(world.body(index)));
        }
    }

    fn error(&self) -> f64 {
        self.farthest.iter().copied().fold(f64::INFINITY, f64::min)
    }

    fn failed(&self) -> Option<&'static str> {
        (self.error() < self.least).then_some(self.reason)
    }
}

/// A measure of the bodies is in a range at the end, or there is a reason why not.
pub(super) fn ends_in(
    range: impl RangeBounds<f64> + 'static,
    reason: &'static str,
    measure: impl Fn(&dyn World) -> f64 + 'static,
) -> Box<dyn Watch> {
    Box::new(EndsIn { range, reason, measure, last: f64::NAN })
}

struct EndsIn<R, F> {
    range: R,
    reason: &'static str,
    measure: F,
    last: f64,
}

impl<R: RangeBounds<f64>, F: Fn(&dyn World) -> f64> Watch for EndsIn<R, F> {
    fn see(&mut self, _: f64, world: &dyn World) {
        self.last = (self.measure)(world);
    }

    fn error(&self) -> f64 {
        self.last
    }

    fn failed(&self) -> Option<&'static str> {
        (!self.range.contains(&self.last)).then_some(self.reason)
    }
}

/// The root of the mean of the squared speeds of some bodies, in px/s.
pub(super) fn mean_speed(world: &dyn World, bodies: &[usize]) -> f64 {
    let squares: f64 = bodies.iter().map(|&index| world.body(index).speed().powi(2)).sum();
    (squares / bodies.len().max(1) as f64).sqrt()
}

/// The greatest value of a measure of some bodies.
pub(super) fn greatest(world: &dyn World, bodies: &[usize], measure: impl Fn(BodyState) -> f64) -> f64 {
    bodies.iter().map(|&index| measure(world.body(index))).fold(f64::NEG_INFINITY, f64::max)
}

/// The least value of a measure of some bodies.
pub(super) fn least(world: &dyn World, bodies: &[usize], measure: impl Fn(BodyState) -> f64) -> f64 {
    bodies.iter().map(|&index| measure(world.body(index))).fold(f64::INFINITY, f64::min)
}

fn point(vector: Vector2) -> [f64; 2] {
    [vector.x, vector.y].map(f64::from)
}
