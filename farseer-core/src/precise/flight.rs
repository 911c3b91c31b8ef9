//! Nothing passes through what stands still, however fast it is; and a bullet through nothing.
//!
//! A body that goes further in a step than it is thick could be beyond a wall before anybody has noticed. Its way is cut where
//! it first is in something by a part of the reach of contacts, and its velocity is the one that it has there; the next step
//! finds them in touch. Where it only grazes nothing is cut.
//!
//! The time of the first touch is found by conservative advancement (B. Mirtich, "Impulse-based Dynamic Simulation of
//! Rigid Body Systems", 1996, section 2.3): along an axis that separates the two, they come together no faster than by their
//! velocity along it and what their turning can do at their reach, so that so far nothing can happen; and if they do not come
//! together along it, never.

use super::outline::Outline;
use crate::math::plane::{Pose, Vector, difference, dot, length, place, rotation, scaled, sum, turn};
use crate::math::scalar;
use crate::precise::parameters::narrow_phase::IMPACT_ADVANCES;

/// A convex piece on its way through a step.
#[derive(Clone, Copy)]
pub(super) struct Flyer<'a> {
    pub(super) outline: Outline<'a>,
    pub(super) pose: Pose,
    /// Way and angle of the whole step.
    pub(super) path: [f32; 4],
}

impl Flyer<'_> {
    /// Where it is after a part of the step.
    pub(super) fn at(&self, part: f32) -> Pose {
        let ([x, y, c, s], [dx, dy, turned, _]) = (self.pose, self.path);
        if turned == 0.0 {
            return [x + part * dx, y + part * dy, c, s];
        }
        let (sine, cosine) = scalar::sin_cos(part * turned);
        let [c, s] = turn([cosine, sine], [c, s]);
        [x + part * dx, y + part * dy, c, s]
    }

    /// Its corners, or the centre of a circle, as it lies there.
    fn corners(&self, pose: Pose) -> impl Iterator<Item = Vector> + '_ {
        let Outline { shape, points, .. } = &self.outline;
        let points = if points.is_empty() { std::slice::from_ref(&shape.centre) } else { points };
        points.iter().map(move |&point| sum(place(pose), turn(rotation(pose), point)))
    }

    /// How far it reaches in a direction.
    pub(super) fn support(&self, pose: Pose, direction: Vector) -> f32 {
        self.farthest(pose, direction).0 + self.outline.shape.radius
    }

    /// How far its corners reach in a direction, and which of them does.
    fn farthest(&self, pose: Pose, direction: Vector) -> (f32, Vector) {
        let along = self.corners(pose).map(|corner| (dot(corner, direction), corner));
        along.fold((f32::MIN, [0.0; 2]), |most, one| if one.0 > most.0 { one } else { most })
    }

    /// The middle of the piece.
    fn centre(&self, pose: Pose) -> Vector {
        sum(place(pose), turn(rotation(pose), self.outline.shape.centre))
    }
}

/// Two pieces.
pub(super) struct Two<'a> {
    pub(super) a: Flyer<'a>,
    pub(super) b: Flyer<'a>,
}

impl Two<'_> {
    /// Distance of the two along the axis that separates them best, negative if they overlap; and that axis, from A to B. Along
    /// none are they farther apart than any two of their corners: most axes are passed over for those that were nearest last.
    pub(super) fn separation(&self, part: f32) -> (f32, Vector) {
        let poses = [self.a.at(part), self.b.at(part)];
        let radii = [self.a.outline.shape.radius, self.b.outline.shape.radius];
        let apart = |axis: Vector| {
            let (of_a, near_a) = self.a.farthest(poses[0], axis);
            let (of_b, near_b) = self.b.farthest(poses[1], scaled(axis, -1.0));
            (-(of_b + radii[1]) - (of_a + radii[0]), [near_a, near_b])
        };
        let at_most = |[near_a, near_b]: [Vector; 2], axis: Vector| {
            -(dot(near_b, scaled(axis, -1.0)) + radii[1]) - (dot(near_a, axis) + radii[0])
        };

        // As far as they are apart along the axis that promises most, they are.
        let mut nearest = apart(difference(self.b.centre(poses[1]), self.a.centre(poses[0]))).1;
        let mut likely = (f32::MIN, [0.0, 1.0]);
        self.for_each_axis(poses, &mut |axis| {
            let most = at_most(nearest, axis);
            if most > likely.0 {
                likely = (most, axis);
            }
        });
        let (least, of_likely) = apart(likely.1);
        nearest = of_likely;
        let mut best = (f32::MIN, [0.0, 1.0]);
        self.for_each_axis(poses, &mut |axis| {
            let most = at_most(nearest, axis);
            if most < least || most <= best.0 {
                return;
            }
            let (apart, of_axis) = apart(axis);
            nearest = of_axis;
            if apart > best.0 {
                best = (apart, axis);
            }
        });
        best
    }

    /// The axes along which the two may be farthest apart: of their sides, and if one is round, between corners.
    fn for_each_axis(&self, [pose_a, pose_b]: [Pose; 2], consider: &mut dyn FnMut(Vector)) {
        for &normal in self.a.outline.normals {
            consider(turn(rotation(pose_a), normal));
        }
        for &normal in self.b.outline.normals {
            consider(scaled(turn(rotation(pose_b), normal), -1.0));
        }
        if self.a.outline.shape.radius > 0.0 || self.b.outline.shape.radius > 0.0 {
            for from in self.a.corners(pose_a) {
                for to in self.b.corners(pose_b) {
                    let way = difference(to, from);
                    let distance = length(way);
                    if distance > 0.0 {
                        consider(scaled(way, 1.0 / distance));
                    }
                }
            }
        }
    }

    /// Distance after a part of the step, and how fast it can become less, in lengths per step.
    pub(super) fn coming(&self, part: f32) -> (f32, f32) {
        let (apart, axis) = self.separation(part);
        (apart, self.closing(axis))
    }

    /// How fast the two can come together along an axis from A to B, in lengths per step.
    pub(super) fn closing(&self, axis: Vector) -> f32 {
        let way = difference(place(self.b.path), place(self.a.path));
        let turning = |flyer: &Flyer<'_>| flyer.path[2].abs() * flyer.outline.shape.reach;
        turning(&self.a) + turning(&self.b) - dot(way, axis)
    }

    /// Whether A is an edge of a chain that B comes from behind.
    pub(super) fn is_free(&self) -> bool {
        let [normal, _] = self.a.outline.normals else { return false };
        if self.a.outline.seams().is_empty() {
            return false;
        }
        let normal = turn(rotation(self.a.pose), *normal);
        let on_edge = sum(place(self.a.pose), turn(rotation(self.a.pose), self.a.outline.points[0]));
        let centre = self.b.centre(self.b.pose);
        let way = difference(place(self.b.path), place(self.a.path));
        dot(difference(centre, on_edge), normal) < 0.0 || (dot(way, normal) >= 0.0 && self.b.path[2] == 0.0)
    }
}

/// After which part of the step two are in each other by `deep`, or by that much deeper than when it began; `None` if they
/// never are. Asked for a part, the two tell how far they are apart, and how fast that can become less.
pub(super) fn meet(deep: f32, exact: f32, coming: impl Fn(f32) -> (f32, f32)) -> Option<f32> {
    let (mut part, mut allowed) = (0.0, None);
    for _ in 0..IMPACT_ADVANCES {
        let (apart, closing) = coming(part);
        let room = apart + *allowed.get_or_insert(if apart < 0.0 { deep - apart } else { deep });
        if room <= exact {
            return Some(part);
        }
        if closing <= 0.0 {
            return None;
        }
        part += room / closing;
        if part >= 1.0 || part.is_nan() {
            return None;
        }
    }
    Some(part)
}
