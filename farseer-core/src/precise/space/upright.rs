//! Things that stand upright whatever happens: a footprint, drawn out along y. Cylinders, capsules, and prisms on end; platforms
//! that are turned about an upright axis as well.
//!
//! Two of them meet one above the other or beside each other: along the axis that they entered last, as two outlines do that
//! are drawn out along the depth axis. What is round above and below, a capsule or a ball, is a footprint drawn out less far and
//! all that is as near to it: that meets obliquely, too.

use super::foot::{Foot, Gap, Polygon};
use super::parts::SpaceUpright;
use super::solid::{Before, Limits, Solid};
use crate::math::plane::{Vector, difference, length, place, scaled, sum};
use crate::precise::manifold::Manifold;
use crate::precise::parameters::depth::{
    CURVE_SECANT_STEPS, GRAZED_CURVE_OVERLAP, VERTICAL_ENTRY_MEMORY, VERTICAL_NORMAL_COSINE,
};

/// What something upright is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::precise) struct Upright {
    pub(super) foot: Foot,
    /// How far it goes up and down from its middle, without what is round.
    pub(super) half: f32,
    /// How far it reaches around that.
    pub(super) rounding: f32,
}

impl Upright {
    pub(super) fn new(told: SpaceUpright) -> Self {
        match told {
            SpaceUpright::Cylinder { radius, half_height } => {
                Upright { foot: Foot::disc(radius), half: half_height, rounding: 0.0 }
            }
            SpaceUpright::Capsule { radius, half_height } => {
                let half = if half_height > radius { half_height - radius } else { 0.0 };
                Upright { foot: Foot::disc(0.0), half, rounding: radius }
            }
            SpaceUpright::Prism { footprint, half_height } => {
                let (low, high) = footprint.bounds();
                // Its place is in the middle of its width, as that of its outline.
                let middle = 0.5 * (low.x + high.x);
                let corners = footprint.corners().iter().map(|corner| [corner.x - middle, corner.y]);
                let foot = Foot::of(Polygon::new(corners));
                Upright { foot, half: half_height, rounding: 0.0 }
            }
        }
    }

    /// A level box with these corners of its footprint, as seen from its place, that is so high to both sides.
    pub(super) fn of_corners(corners: [Vector; 4], half: f32) -> Self {
        Upright { foot: Foot::of(Polygon::new(corners)), half, rounding: 0.0 }
    }

    pub(super) fn ball(radius: f32) -> Self {
        Upright { foot: Foot::disc(0.0), half: 0.0, rounding: radius }
    }
}

/// Something upright where it is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Standing<'a> {
    pub(super) shape: &'a Upright,
    /// Its middle: x, y (down) and z.
    pub(super) at: [f32; 3],
}

impl<'a> Standing<'a> {
    pub(super) fn new(solid: &Solid<'_>, shape: &'a Upright) -> Self {
        let [x, y] = solid.centre();
        Standing { shape, at: [x, y, solid.z] }
    }

    pub(super) fn floor(&self) -> Vector {
        [self.at[0], self.at[2]]
    }
}

impl Standing<'_> {
    /// The place of it that is farthest in a direction.
    pub(super) fn farthest(&self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        let [foot_x, foot_z] = self.shape.foot.farthest(unit([x, z]));
        let half = if y < 0.0 { -self.shape.half } else { self.shape.half };
        [self.at[0] + foot_x, self.at[1] + half, self.at[2] + foot_z]
    }

    /// How far it is from a box, at least.
    pub(super) fn clear_of(&self, low: [f32; 3], high: [f32; 3]) -> f32 {
        let least = self.farthest([0.0, -1.0, 0.0])[1];
        let most = self.farthest([0.0, 1.0, 0.0])[1];
        let foot = &self.shape.foot;
        let reach = |axis: Vector| [foot.reach(scaled(axis, -1.0)), foot.reach(axis)];
        let ([left, right], [near, far]) = (reach([1.0, 0.0]), reach([0.0, 1.0]));
        let mine =
            [[self.at[0] - left, self.at[0] + right], [least, most], [self.at[2] - near, self.at[2] + far]];
        let gaps = mine.iter().zip(low.iter().zip(high));
        gaps.fold(0.0, |most, ([from, to], (low, high))| most.max(low - to).max(from - high))
    }
}

fn unit(v: Vector) -> Vector {
    let length = length(v);
    if length > 0.0 { scaled(v, 1.0 / length) } else { [1.0, 0.0] }
}

/// An axis along which two are apart, from the upright one to the other.
pub(super) type Axis = (f32, [f32; 3]);

/// The one along which they are farthest apart.
pub(super) fn farther(one: Axis, other: Axis) -> Axis {
    if other.0 > one.0 { other } else { one }
}

/// A way in which two meet, or are apart.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Meeting {
    /// Negative for an overlap.
    pub(super) apart: f32,
    /// From the upright one to the other.
    pub(super) normal: [f32; 3],
    /// Whether its normal changes as they slide past each other.
    pub(super) is_curved: bool,
    /// Places, and how far they are apart there.
    pub(super) points: [([f32; 3], f32); 2],
    pub(super) count: usize,
    pub(super) feature: u32,
}

impl Meeting {
    pub(super) fn of_point(apart: f32, normal: [f32; 3], point: [f32; 3], feature: u32) -> Self {
        Meeting { apart, normal, is_curved: false, points: [(point, apart); 2], count: 1, feature }
    }

    fn flipped(mut self) -> Self {
        self.normal = self.normal.map(|part| -part);
        self
    }
}

/// Both ways in which something upright meets another thing.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ways {
    pub(super) over: Meeting,
    pub(super) beside: Meeting,
}

impl Ways {
    /// As the other thing sees them.
    pub(super) fn flipped(self) -> Self {
        Ways { over: self.over.flipped(), beside: self.beside.flipped() }
    }

    /// The way in which the two are apart most.
    pub(super) fn best(&self) -> &Meeting {
        if self.over.apart > self.beside.apart { &self.over } else { &self.beside }
    }
}

/// The nearest number of an interval. Whatever the numbers are, this answers.
pub(super) fn within(number: f32, low: f32, high: f32) -> f32 {
    if number < low {
        low
    } else if number > high {
        high
    } else {
        number
    }
}

pub(super) fn product(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Features by the way in which two meet.
pub(super) const OVER: u32 = 1 << 8;
pub(super) const BESIDE: u32 = 2 << 8;

/// Two that are not round above and below, one above the other or beside each other.
pub(super) fn ways(a: Standing<'_>, b: Standing<'_>) -> Ways {
    let gap = a.shape.foot.gap(&b.shape.foot, difference(b.floor(), a.floor()));
    Ways { over: one_over_other(a, b), beside: one_beside_other(a, b, gap) }
}

fn one_over_other(a: Standing<'_>, b: Standing<'_>) -> Meeting {
    let below = if b.at[1] < a.at[1] { -1.0 } else { 1.0 };
    let apart = below * (b.at[1] - a.at[1]) - a.shape.half - b.shape.half;
    let [x, z] = common(a, b);
    let y = a.at[1] + below * (a.shape.half + 0.5 * apart);
    Meeting::of_point(apart, [0.0, below, 0.0], [x, y, z], OVER)
}

/// A place of the floor that both cover: in the middle of what is smaller if it can be, where one stands on the other.
fn common(a: Standing<'_>, b: Standing<'_>) -> Vector {
    let size = |one: Standing<'_>| one.shape.foot.reach([1.0, 0.0]) + one.shape.foot.reach([0.0, 1.0]);
    let (small, large) = if size(a) <= size(b) { (a, b) } else { (b, a) };
    let middle = Foot::disc(0.0);
    let gap = large.shape.foot.gap(&middle, difference(small.floor(), large.floor()));
    let out = if gap.apart > 0.0 { gap.apart } else { 0.0 };
    sum(small.floor(), scaled(gap.normal, -out))
}

fn one_beside_other(a: Standing<'_>, b: Standing<'_>, gap: Gap) -> Meeting {
    let (low, high) = (
        (a.at[1] - a.shape.half).max(b.at[1] - b.shape.half),
        (a.at[1] + a.shape.half).min(b.at[1] + b.shape.half),
    );
    let [x, z] = beside_at(a, b, &gap);
    let point = [x, 0.5 * (low + high), z];
    let found = Meeting::of_point(gap.apart, [gap.normal[0], 0.0, gap.normal[1]], point, BESIDE);
    Meeting { is_curved: gap.is_curved, ..found }
}

/// Between the two, where they are nearest.
fn beside_at(a: Standing<'_>, b: Standing<'_>, gap: &Gap) -> Vector {
    let half = scaled(gap.normal, 0.5 * gap.apart);
    if a.shape.foot.is_disc() {
        return sum(sum(a.floor(), a.shape.foot.farthest(gap.normal)), half);
    }
    if b.shape.foot.is_disc() {
        return sum(sum(b.floor(), b.shape.foot.farthest(scaled(gap.normal, -1.0))), scaled(half, -1.0));
    }
    let facing = a.shape.foot.facing(&b.shape.foot, difference(b.floor(), a.floor()), gap.normal);
    sum(sum(a.floor(), facing), half)
}

/// Two of which one is round above and below: the distance of what they are round about.
pub(super) fn rounded(a: Standing<'_>, b: Standing<'_>) -> Meeting {
    let Ways { over, beside } = ways(a, b);
    let rounding = a.shape.rounding + b.shape.rounding;
    let (normal, distance, is_curved) = if over.apart > 0.0 && beside.apart > 0.0 {
        let distance = length([over.apart, beside.apart]);
        let (up, along) = (over.apart / distance, beside.apart / distance);
        ([beside.normal[0] * along, over.normal[1] * up, beside.normal[2] * along], distance, true)
    } else if beside.apart >= over.apart {
        (beside.normal, beside.apart, beside.is_curved)
    } else {
        (over.normal, over.apart, false)
    };
    let apart = distance - rounding;
    // On the surface of what is round, from the place of the one that is.
    let point = surface_point(a, b, normal, apart, &beside);
    Meeting { is_curved, ..Meeting::of_point(apart, normal, point, 0) }
}

fn surface_point(
    a: Standing<'_>,
    b: Standing<'_>,
    normal: [f32; 3],
    apart: f32,
    beside: &Meeting,
) -> [f32; 3] {
    let (round, sign) = if a.shape.rounding > 0.0 { (a, 1.0) } else { (b, -1.0) };
    let other = if a.shape.rounding > 0.0 { b } else { a };
    // Of its axis the height that is nearest to the other one.
    let [low, high] = [-1.0, 1.0].map(|side| round.at[1] + side * round.shape.half);
    let near = within(other.at[1], low, high);
    let y = if beside.normal[1] == 0.0 && low < high {
        overlapping(other, low, high).unwrap_or(near)
    } else {
        near
    };
    let out = sign * (round.shape.rounding + 0.5 * apart);
    let foot = round.shape.foot.farthest([sign * normal[0], sign * normal[2]]);
    [round.at[0] + foot[0] + out * normal[0], y + out * normal[1], round.at[2] + foot[1] + out * normal[2]]
}

/// The middle of what of an interval of heights something covers.
fn overlapping(other: Standing<'_>, low: f32, high: f32) -> Option<f32> {
    let (top, bottom) = (other.at[1] - other.shape.half, other.at[1] + other.shape.half);
    let (from, to) = (low.max(top), high.min(bottom));
    (from <= to).then_some(0.5 * (from + to))
}

/// Which way it is in which two meet; `None` if they only will, or pass each other.
fn choose<'w>(
    a: &Solid<'_>,
    b: &Solid<'_>,
    ways: &'w Ways,
    before: Before,
    limits: Limits,
) -> Option<&'w Meeting> {
    let Ways { over, beside } = ways;
    let way = |of: fn(&Solid<'_>) -> [f32; 3]| -> [f32; 3] {
        let (a, b) = (of(a), of(b));
        std::array::from_fn(|axis| b[axis] - a[axis])
    };
    // Both ways meet one face: the foot of a slope is no wall, and a wall is not stood on.
    if product(over.normal, beside.normal) > VERTICAL_NORMAL_COSINE {
        return Some(ways.best());
    }
    match before {
        Before::Plane | Before::Depth(_) if over.apart <= 0.0 => return Some(beside),
        Before::Over if beside.apart <= 0.0 => return Some(over),
        _ => {}
    }
    if over.apart > 0.0 || beside.apart > 0.0 {
        let (apart, within) = if beside.apart > 0.0 { (beside, over) } else { (over, beside) };
        let passes = || passes_edge(apart, within, way(|solid| solid.ahead));
        return (within.apart < -limits.flush && !passes()).then_some(apart);
    }
    let (is_flush, is_flush_beside) = (over.apart >= -limits.flush, beside.apart >= -limits.flush);
    match (is_flush, is_flush_beside) {
        (true, true) => None,
        (true, false) => Some(over),
        (false, true) => Some(beside),
        (false, false) => Some(entered_last(over, beside, way(|solid| solid.motion))),
    }
}

fn entered_last<'w>(over: &'w Meeting, beside: &'w Meeting, way: [f32; 3]) -> &'w Meeting {
    let since = |meeting: &Meeting| {
        let closing = -product(way, meeting.normal);
        let steps = if closing > 0.0 { -meeting.apart / closing } else { f32::INFINITY };
        if steps <= VERTICAL_ENTRY_MEMORY { steps } else { f32::INFINITY }
    };
    let (of_over, of_beside) = (since(over), since(beside));
    let is_over = if of_over == of_beside { over.apart > beside.apart } else { of_over < of_beside };
    if is_over { over } else { beside }
}

/// Whether two that are apart in one way will be apart in the other one by the time they are not in the first.
fn passes_edge(apart: &Meeting, within: &Meeting, way: [f32; 3]) -> bool {
    let (closing, leaving) = (-product(way, apart.normal), product(way, within.normal));
    leaving > 0.0 && closing > 0.0 && within.apart + leaving * (apart.apart / closing) >= 0.0
}

/// What two that do not touch yet will touch in this step, B moving so far against A, where their surfaces are curved: the
/// distance along the normal that they will have there, and that normal. `None` if they pass each other.
fn touched(now: &Meeting, way: [f32; 3], usual: f32, at: impl Fn([f32; 3]) -> Meeting) -> Option<Meeting> {
    let along = |part: f32| at(way.map(|axis| axis * part));
    let (mut before, mut after) = ((0.0, now.apart), (1.0, along(1.0).apart));
    if after.1 > -GRAZED_CURVE_OVERLAP * usual {
        // One that is as far at the end may have been nearer on the way.
        let nearest = -product(way, now.normal) / product(way, way).max(f32::MIN_POSITIVE);
        after = (nearest.clamp(0.0, 1.0), along(nearest.clamp(0.0, 1.0)).apart);
        if after.1 > -GRAZED_CURVE_OVERLAP * usual {
            return None;
        }
    }
    let mut found = None;
    for _ in 0..CURVE_SECANT_STEPS {
        let part = before.0 + (after.0 - before.0) * before.1 / (before.1 - after.1);
        let then = along(part);
        let closing = part * product(way, then.normal);
        let points = then.points.map(|(point, apart)| (point, apart - closing));
        found = Some(Meeting { apart: then.apart - closing, points, ..then });
        if then.apart > 0.0 {
            before = (part, then.apart);
        } else {
            after = (part, then.apart);
        }
    }
    found
}

/// A meeting as contacts of A and B.
fn manifold(a: &Solid<'_>, found: &Meeting, reach: f32) -> Manifold {
    let [x, y, z] = found.normal;
    let mut manifold = Manifold { normal: [x, y], normal_z: z, gap: found.apart, ..Manifold::default() };
    for (at, &(point, separation)) in found.points.iter().enumerate().take(found.count) {
        if separation < reach {
            manifold.points[manifold.count] = difference([point[0], point[1]], place(a.pose));
            manifold.depths[manifold.count] = point[2] - a.z;
            manifold.separations[manifold.count] = separation;
            manifold.features[manifold.count] = found.feature + at as u32;
            manifold.count += 1;
        }
    }
    manifold
}

/// The way of B against A in the step that comes.
pub(super) fn ahead(a: &Solid<'_>, b: &Solid<'_>) -> [f32; 3] {
    std::array::from_fn(|axis| b.ahead[axis] - a.ahead[axis])
}

/// Two that are upright both.
pub(super) fn touch(
    a: Solid<'_>,
    b: Solid<'_>,
    shapes: [&Upright; 2],
    before: Before,
    limits: Limits,
) -> Manifold {
    let (one, other) = (Standing::new(&a, shapes[0]), Standing::new(&b, shapes[1]));
    let moved =
        |way: [f32; 3]| Standing { at: std::array::from_fn(|axis| other.at[axis] + way[axis]), ..other };
    if shapes[0].rounding + shapes[1].rounding > 0.0 {
        let (now, is_new) = (rounded(one, other), before == Before::Nothing);
        return curved(&a, now, is_new, ahead(&a, &b), limits, |way| rounded(one, moved(way)));
    }
    let now = ways(one, other);
    if now.best().apart > limits.reach {
        return Manifold::apart(now.best().apart);
    }
    chosen([&a, &b], &now, before, limits, |way| ways(one, moved(way)))
}

/// The contacts of A and B in the way in which they meet, of those that they do as B moves against A.
pub(super) fn chosen(
    [a, b]: [&Solid<'_>; 2],
    now: &Ways,
    before: Before,
    limits: Limits,
    at: impl Fn([f32; 3]) -> Ways,
) -> Manifold {
    match choose(a, b, now, before, limits) {
        None => Manifold::apart(0.0),
        Some(found) if found.is_curved => {
            let is_new = before == Before::Nothing;
            curved(a, *found, is_new, ahead(a, b), limits, |way| at(way).beside)
        }
        Some(found) => manifold(a, found, limits.reach),
    }
}

/// The contact of what is curved: until it is touched its normal is that of the moment in which it will be.
fn curved(
    a: &Solid<'_>,
    now: Meeting,
    is_new: bool,
    way: [f32; 3],
    limits: Limits,
    at: impl Fn([f32; 3]) -> Meeting,
) -> Manifold {
    if now.apart > limits.reach {
        return Manifold::apart(now.apart);
    }
    if !(is_new && now.is_curved && now.apart > 0.0) {
        return manifold(a, &now, limits.reach);
    }
    match touched(&now, way, limits.usual, at) {
        Some(found) => manifold(a, &found, f32::MAX),
        None => Manifold::apart(0.0),
    }
}

/// Whether a feature is that of a contact of two that are one above the other.
pub(super) fn is_over(feature: u32) -> bool {
    feature & (OVER | BESIDE) == OVER
}

#[cfg(test)]
mod tests {
    use super::{Standing, Upright, rounded, ways};
    use crate::precise::space::parts::SpaceUpright;

    fn cylinder(radius: f32, half_height: f32) -> Upright {
        Upright::new(SpaceUpright::Cylinder { radius, half_height })
    }

    fn capsule(radius: f32, half_height: f32) -> Upright {
        Upright::new(SpaceUpright::Capsule { radius, half_height })
    }

    #[test]
    fn cylinders_are_apart_beside_and_above_each_other() {
        let (a, b) = (cylinder(10.0, 20.0), cylinder(5.0, 8.0));
        let found = ways(
            Standing { shape: &a, at: [0.0, 0.0, 0.0] },
            Standing { shape: &b, at: [12.0, -30.0, 16.0] },
        );
        assert_eq!((found.beside.apart, found.beside.normal), (5.0, [0.6, 0.0, 0.8]));
        assert_eq!((found.over.apart, found.over.normal), (2.0, [0.0, -1.0, 0.0]));
    }

    #[test]
    fn capsules_are_apart_by_the_distance_of_their_axes() {
        let (a, b) = (capsule(5.0, 20.0), capsule(3.0, 13.0));
        let apart =
            |at: [f32; 3]| rounded(Standing { shape: &a, at: [0.0; 3] }, Standing { shape: &b, at }).apart;
        assert_eq!(apart([6.0, 4.0, 8.0]), 2.0);
        // Axes end at 15 and at 29 - 10.
        assert!((apart([0.0, 29.0, 3.0]) - (-3.0)).abs() < 1e-5);
        assert_eq!(apart([0.0, 29.0 + 10.0, 0.0]), 6.0);
    }

    #[test]
    fn a_ball_meets_the_rim_of_a_cylinder_obliquely() {
        let (a, b) = (cylinder(10.0, 20.0), Upright::ball(4.0));
        let found =
            rounded(Standing { shape: &a, at: [0.0; 3] }, Standing { shape: &b, at: [13.0, -24.0, 0.0] });
        assert!((found.apart - 1.0).abs() < 1e-6);
        assert!((found.normal[0] - 0.6).abs() < 1e-6 && (found.normal[1] + 0.8).abs() < 1e-6);
        // Half a px from its surface, on the way to the rim.
        assert!((found.points[0].0[0] - 10.3).abs() < 1e-5 && (found.points[0].0[1] + 20.4).abs() < 1e-5);
    }
}
