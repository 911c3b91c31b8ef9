//! Vertical shapes: a footprint in x and z, extruded along y and rounded by a radius. They never rotate about x or z.
//!
//! | shape | footprint | rounding |
//! |---|---|---|
//! | cylinder | disc | 0 |
//! | capsule, sphere | point | radius |
//! | prism along y, world box with a yaw | polygon | 0 |
//!
//! Shapes without rounding touch along the vertical axis or a lateral axis. The last-entered axis decides, as for prisms along
//! z. Rounded shapes use the distance of their cores (the shapes without rounding) and may touch obliquely.

use super::footprint::{FootprintDistance, FootprintShape};
use super::posed_solid::{ContactMargins, PosedSolid, PreviousAxis};
use super::vertical_solid::VerticalSolid;
use crate::math::plane::{Vector, difference, length, scaled, sum, translation};
use crate::narrow_phase::manifold::Manifold;
use crate::parameters::depth::{
    CURVE_SECANT_STEPS, GRAZED_CURVE_OVERLAP, VERTICAL_ENTRY_MAX_AGE, VERTICAL_NORMAL_COSINE,
};

/// Vertical shape with its world position.
#[derive(Debug, Clone, Copy)]
pub(super) struct PosedVertical<'a> {
    pub(super) shape: &'a VerticalSolid,
    /// World position of the centre: x, y (down) and z, in length units.
    pub(super) position: [f32; 3],
}

impl<'a> PosedVertical<'a> {
    pub(super) fn new(solid: &PosedSolid<'_>, shape: &'a VerticalSolid) -> Self {
        let [x, y] = solid.shape_centre();
        PosedVertical { shape, position: [x, y, solid.z] }
    }

    /// Returns the world position of the centre in x and z, in length units.
    pub(super) fn xz(&self) -> Vector {
        [self.position[0], self.position[2]]
    }
}

impl PosedVertical<'_> {
    /// Returns the support point along a direction of the shape without its rounding: x, y and z in world coordinates, length
    /// units.
    pub(super) fn support_point(&self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        let [foot_x, foot_z] = self.shape.footprint.support_point(unit_or_x([x, z]));
        let half = if y < 0.0 { -self.shape.half_height } else { self.shape.half_height };
        [self.position[0] + foot_x, self.position[1] + half, self.position[2] + foot_z]
    }

    /// Returns a lower bound, in length units and >= 0, of the distance from the shape without its rounding to an axis-aligned
    /// box with the world corners `low` and `high`.
    pub(super) fn distance_to_aabb(&self, low: [f32; 3], high: [f32; 3]) -> f32 {
        let least = self.support_point([0.0, -1.0, 0.0])[1];
        let most = self.support_point([0.0, 1.0, 0.0])[1];
        let foot = &self.shape.footprint;
        let reach = |axis: Vector| [foot.support(scaled(axis, -1.0)), foot.support(axis)];
        let ([left, right], [near, far]) = (reach([1.0, 0.0]), reach([0.0, 1.0]));
        let mine = [
            [self.position[0] - left, self.position[0] + right],
            [least, most],
            [self.position[2] - near, self.position[2] + far],
        ];
        let gaps = mine.iter().zip(low.iter().zip(high));
        gaps.fold(0.0, |most, ([from, to], (low, high))| most.max(low - to).max(from - high))
    }
}

/// Returns the unit vector in the direction of `v`; the x axis for the zero vector.
fn unit_or_x(v: Vector) -> Vector {
    let length = length(v);
    if length > 0.0 { scaled(v, 1.0 / length) } else { [1.0, 0.0] }
}

/// Separation in length units, and the unit axis x, y, z from a vertical shape to the other shape along which it is measured.
pub(super) type SeparatingAxis = (f32, [f32; 3]);

/// Returns the one of two axes that has the larger separation.
pub(super) fn larger_separation(one: SeparatingAxis, other: SeparatingAxis) -> SeparatingAxis {
    if other.0 > one.0 { other } else { one }
}

/// Contact of a vertical shape and another shape along one axis.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct AxisContact {
    /// Separation in length units, negative for penetration.
    pub(super) separation: f32,
    /// Unit normal x, y, z from the vertical shape to the other shape. Dimensionless.
    pub(super) normal: [f32; 3],
    /// Whether the normal rotates as the shapes slide past each other.
    pub(super) is_curved: bool,
    /// Contact points: world position x, y, z and separation, both in length units.
    pub(super) points: [([f32; 3], f32); 2],
    /// Number of contact points, 1..=2.
    pub(super) count: usize,
    /// Feature id of the first contact point; the second one has the next number.
    pub(super) feature: u32,
}

impl AxisContact {
    /// Returns a contact with one point. `normal` is the unit normal from A to B, `point` the world position x, y, z in length
    /// units, `separation` is in length units.
    pub(super) fn single_point(separation: f32, normal: [f32; 3], point: [f32; 3], feature: u32) -> Self {
        AxisContact {
            separation,
            normal,
            is_curved: false,
            points: [(point, separation); 2],
            count: 1,
            feature,
        }
    }

    /// Returns the contact with A and B exchanged: the normal is reversed.
    fn flipped(mut self) -> Self {
        self.normal = self.normal.map(|fraction| -fraction);
        self
    }
}

/// Contacts of a vertical shape and another shape along the vertical and the lateral axis. The narrow phase uses one of them.
#[derive(Debug, Clone, Copy)]
pub(super) struct AxisCandidates {
    /// Contact along the vertical axis: one shape above the other.
    pub(super) vertical: AxisContact,
    /// Contact along the lateral axis: one shape beside the other.
    pub(super) lateral: AxisContact,
}

impl AxisCandidates {
    /// Returns both contacts with A and B exchanged: the normals are reversed.
    pub(super) fn flipped(self) -> Self {
        AxisCandidates { vertical: self.vertical.flipped(), lateral: self.lateral.flipped() }
    }

    /// Returns the contact with the larger separation.
    pub(super) fn max_separation(&self) -> &AxisContact {
        if self.vertical.separation > self.lateral.separation { &self.vertical } else { &self.lateral }
    }
}

/// Returns `number` clamped to the interval from `low` to `high`. Unlike `f32::clamp` it accepts NaN and empty intervals.
pub(super) fn clamp_any(number: f32, low: f32, high: f32) -> f32 {
    if number < low {
        low
    } else if number > high {
        high
    } else {
        number
    }
}

pub(super) fn dot3(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Flag in feature ids: contact of a vertical shape along the vertical axis.
pub(super) const VERTICAL_AXIS_FEATURE: u32 = 1 << 8;
/// Flag in feature ids: contact of a vertical shape along a lateral axis.
pub(super) const LATERAL_AXIS_FEATURE: u32 = 2 << 8;

/// Returns the contacts of two vertical shapes along the vertical and the lateral axis. Their rounding is ignored.
pub(super) fn axis_candidates(a: PosedVertical<'_>, b: PosedVertical<'_>) -> AxisCandidates {
    let gap = a.shape.footprint.distance_to(&b.shape.footprint, difference(b.xz(), a.xz()));
    AxisCandidates { vertical: vertical_axis_contact(a, b), lateral: lateral_axis_contact(a, b, gap) }
}

/// Returns the contact of vertical shapes A and B along the vertical axis: one shape is above the other.
fn vertical_axis_contact(a: PosedVertical<'_>, b: PosedVertical<'_>) -> AxisContact {
    let below = if b.position[1] < a.position[1] { -1.0 } else { 1.0 };
    let apart = below * (b.position[1] - a.position[1]) - a.shape.half_height - b.shape.half_height;
    let [x, z] = common_xz(a, b);
    let y = a.position[1] + below * (a.shape.half_height + 0.5 * apart);
    AxisContact::single_point(apart, [0.0, below, 0.0], [x, y, z], VERTICAL_AXIS_FEATURE)
}

/// Returns a point in x and z (world coordinates, length units) inside of both footprints: the centre of the smaller footprint,
/// moved onto the edge of the larger one if it lies outside.
fn common_xz(a: PosedVertical<'_>, b: PosedVertical<'_>) -> Vector {
    let size = |one: PosedVertical<'_>| {
        one.shape.footprint.support([1.0, 0.0]) + one.shape.footprint.support([0.0, 1.0])
    };
    let (small, large) = if size(a) <= size(b) { (a, b) } else { (b, a) };
    let middle = FootprintShape::disc(0.0);
    let gap = large.shape.footprint.distance_to(&middle, difference(small.xz(), large.xz()));
    let out = if gap.separation > 0.0 { gap.separation } else { 0.0 };
    sum(small.xz(), scaled(gap.normal, -out))
}

/// Returns the contact of vertical shapes A and B along the lateral axis: one shape is beside the other. `gap` is the signed
/// distance of their footprints.
fn lateral_axis_contact(a: PosedVertical<'_>, b: PosedVertical<'_>, gap: FootprintDistance) -> AxisContact {
    let (low, high) = (
        (a.position[1] - a.shape.half_height).max(b.position[1] - b.shape.half_height),
        (a.position[1] + a.shape.half_height).min(b.position[1] + b.shape.half_height),
    );
    let [x, z] = lateral_point(a, b, &gap);
    let point = [x, 0.5 * (low + high), z];
    let found = AxisContact::single_point(
        gap.separation,
        [gap.normal[0], 0.0, gap.normal[1]],
        point,
        LATERAL_AXIS_FEATURE,
    );
    AxisContact { is_curved: gap.is_curved, ..found }
}

/// Returns the middle of the gap between two footprints, in world coordinates x and z, length units.
fn lateral_point(a: PosedVertical<'_>, b: PosedVertical<'_>, gap: &FootprintDistance) -> Vector {
    let half = scaled(gap.normal, 0.5 * gap.separation);
    if a.shape.footprint.is_disc() {
        return sum(sum(a.xz(), a.shape.footprint.support_point(gap.normal)), half);
    }
    if b.shape.footprint.is_disc() {
        return sum(
            sum(b.xz(), b.shape.footprint.support_point(scaled(gap.normal, -1.0))),
            scaled(half, -1.0),
        );
    }
    let facing = a.shape.footprint.contact_point(&b.shape.footprint, difference(b.xz(), a.xz()), gap.normal);
    sum(sum(a.xz(), facing), half)
}

/// Returns the contact of two vertical shapes, at least one of which is rounded. The separation is the distance of both shapes
/// without rounding, minus both rounding radii.
pub(super) fn rounded_contact(a: PosedVertical<'_>, b: PosedVertical<'_>) -> AxisContact {
    let AxisCandidates { vertical, lateral } = axis_candidates(a, b);
    let rounding = a.shape.rounding + b.shape.rounding;
    let (normal, distance, is_curved) = if vertical.separation > 0.0 && lateral.separation > 0.0 {
        let distance = length([vertical.separation, lateral.separation]);
        let (up, along) = (vertical.separation / distance, lateral.separation / distance);
        ([lateral.normal[0] * along, vertical.normal[1] * up, lateral.normal[2] * along], distance, true)
    } else if lateral.separation >= vertical.separation {
        (lateral.normal, lateral.separation, lateral.is_curved)
    } else {
        (vertical.normal, vertical.separation, false)
    };
    let apart = distance - rounding;
    // On the rounded surface, seen from the rounded shape.
    let point = surface_point(a, b, normal, apart, &lateral);
    AxisContact { is_curved, ..AxisContact::single_point(apart, normal, point, 0) }
}

/// Returns the contact point in the middle of the gap, found from the surface of the rounded shape: world coordinates x, y, z,
/// length units.
fn surface_point(
    a: PosedVertical<'_>,
    b: PosedVertical<'_>,
    normal: [f32; 3],
    separation: f32,
    lateral: &AxisContact,
) -> [f32; 3] {
    let (round, sign) = if a.shape.rounding > 0.0 { (a, 1.0) } else { (b, -1.0) };
    let other = if a.shape.rounding > 0.0 { b } else { a };
    // The height on the rounded shape's axis nearest to the other shape.
    let [low, high] = [-1.0, 1.0].map(|side| round.position[1] + side * round.shape.half_height);
    let near = clamp_any(other.position[1], low, high);
    let y = if lateral.normal[1] == 0.0 && low < high {
        common_height(other, low, high).unwrap_or(near)
    } else {
        near
    };
    let out = sign * (round.shape.rounding + 0.5 * separation);
    let foot = round.shape.footprint.support_point([sign * normal[0], sign * normal[2]]);
    [
        round.position[0] + foot[0] + out * normal[0],
        y + out * normal[1],
        round.position[2] + foot[1] + out * normal[2],
    ]
}

/// Returns the middle of the heights that the interval from `low` to `high` and a vertical shape have in common (world y,
/// length units); `None` without overlap.
fn common_height(other: PosedVertical<'_>, low: f32, high: f32) -> Option<f32> {
    let (top, bottom) =
        (other.position[1] - other.shape.half_height, other.position[1] + other.shape.half_height);
    let (from, to) = (low.max(top), high.min(bottom));
    (from <= to).then_some(0.5 * (from + to))
}

/// Returns the contact along the axis that counts; `None` if the shapes do not touch yet or miss each other. The rules in
/// order: equal normals, the axis of the last step, an axis with a gap, flush faces, the last-entered axis.
fn choose_axis<'w>(
    a: &PosedSolid<'_>,
    b: &PosedSolid<'_>,
    candidates: &'w AxisCandidates,
    previous: PreviousAxis,
    margins: ContactMargins,
) -> Option<&'w AxisContact> {
    let AxisCandidates { vertical, lateral } = candidates;
    let relative = |of: fn(&PosedSolid<'_>) -> [f32; 3]| -> [f32; 3] {
        let (a, b) = (of(a), of(b));
        std::array::from_fn(|axis| b[axis] - a[axis])
    };
    // Both axes give the same face: the foot of a slope is no wall, and a wall is no floor.
    if dot3(vertical.normal, lateral.normal) > VERTICAL_NORMAL_COSINE {
        return Some(candidates.max_separation());
    }
    match previous {
        PreviousAxis::Plane | PreviousAxis::Depth(_) if vertical.separation <= 0.0 => return Some(lateral),
        PreviousAxis::Vertical if lateral.separation <= 0.0 => return Some(vertical),
        _ => {}
    }
    if vertical.separation > 0.0 || lateral.separation > 0.0 {
        let (apart, within) =
            if lateral.separation > 0.0 { (lateral, vertical) } else { (vertical, lateral) };
        let passes = || will_miss_edge(apart, within, relative(|solid| solid.predicted_displacement));
        return (within.separation < -margins.flush_overlap && !passes()).then_some(apart);
    }
    let (is_flush, is_flush_beside) =
        (vertical.separation >= -margins.flush_overlap, lateral.separation >= -margins.flush_overlap);
    match (is_flush, is_flush_beside) {
        (true, true) => None,
        (true, false) => Some(vertical),
        (false, true) => Some(lateral),
        (false, false) => Some(last_entered(vertical, lateral, relative(|solid| solid.last_displacement))),
    }
}

/// Returns the contact along the axis on which the shapes began to overlap last. `displacement` is that of B relative to A in
/// the last step, in length units. Overlaps that began more than `VERTICAL_ENTRY_MAX_AGE` steps ago have an unknown age; if
/// both do, the smaller penetration wins.
fn last_entered<'w>(
    vertical: &'w AxisContact,
    lateral: &'w AxisContact,
    displacement: [f32; 3],
) -> &'w AxisContact {
    let since = |meeting: &AxisContact| {
        let closing = -dot3(displacement, meeting.normal);
        let steps = if closing > 0.0 { -meeting.separation / closing } else { f32::INFINITY };
        if steps <= VERTICAL_ENTRY_MAX_AGE { steps } else { f32::INFINITY }
    };
    let (of_over, of_beside) = (since(vertical), since(lateral));
    let is_over =
        if of_over == of_beside { vertical.separation > lateral.separation } else { of_over < of_beside };
    if is_over { vertical } else { lateral }
}

/// Returns whether two shapes will be separated along the axis `within` when their gap along the axis `apart` closes.
/// `displacement` is the predicted displacement of B relative to A in the step, in length units.
fn will_miss_edge(apart: &AxisContact, within: &AxisContact, displacement: [f32; 3]) -> bool {
    let (closing, leaving) = (-dot3(displacement, apart.normal), dot3(displacement, within.normal));
    leaving > 0.0 && closing > 0.0 && within.separation + leaving * (apart.separation / closing) >= 0.0
}

/// Finds the touch of two separated curved shapes within this step by the secant method. `displacement` is that of B relative
/// to A in the step, in length units; `at` returns the contact after a given displacement. Returns the contact with the normal
/// at the touch, and with the present separations along this normal. `None` if the shapes miss each other.
fn refine_contact_time(
    now: &AxisContact,
    displacement: [f32; 3],
    speculative_distance: f32,
    at: impl Fn([f32; 3]) -> AxisContact,
) -> Option<AxisContact> {
    let along = |part: f32| at(displacement.map(|axis| axis * part));
    let (mut before, mut after) = ((0.0, now.separation), (1.0, along(1.0).separation));
    if after.1 > -GRAZED_CURVE_OVERLAP * speculative_distance {
        // Shapes that are separated at the end may have touched in between: tests the closest approach.
        let nearest =
            -dot3(displacement, now.normal) / dot3(displacement, displacement).max(f32::MIN_POSITIVE);
        after = (nearest.clamp(0.0, 1.0), along(nearest.clamp(0.0, 1.0)).separation);
        if after.1 > -GRAZED_CURVE_OVERLAP * speculative_distance {
            return None;
        }
    }
    let mut found = None;
    for _ in 0..CURVE_SECANT_STEPS {
        let fraction = before.0 + (after.0 - before.0) * before.1 / (before.1 - after.1);
        let then = along(fraction);
        let closing = fraction * dot3(displacement, then.normal);
        let points = then.points.map(|(point, apart)| (point, apart - closing));
        found = Some(AxisContact { separation: then.separation - closing, points, ..then });
        if then.separation > 0.0 {
            before = (fraction, then.separation);
        } else {
            after = (fraction, then.separation);
        }
    }
    found
}

/// Returns a contact as a manifold whose points are relative to the position of body A. It has the points with a separation
/// below `contact_margin`, in length units.
fn to_manifold(a: &PosedSolid<'_>, found: &AxisContact, contact_margin: f32) -> Manifold {
    let [x, y, z] = found.normal;
    let mut manifold = Manifold { normal: [x, y], normal_z: z, gap: found.separation, ..Manifold::default() };
    for (at, &(point, separation)) in found.points.iter().enumerate().take(found.count) {
        if separation < contact_margin {
            manifold.points[manifold.count] = difference([point[0], point[1]], translation(a.pose));
            manifold.points_z[manifold.count] = point[2] - a.z;
            manifold.separations[manifold.count] = separation;
            manifold.features[manifold.count] = found.feature + at as u32;
            manifold.count += 1;
        }
    }
    manifold
}

/// Returns the predicted displacement of B relative to A in the coming step: x, y and z in length units.
pub(super) fn relative_displacement(a: &PosedSolid<'_>, b: &PosedSolid<'_>) -> [f32; 3] {
    std::array::from_fn(|axis| b.predicted_displacement[axis] - a.predicted_displacement[axis])
}

/// Returns the contact manifold of two vertical shapes, or of a vertical shape and a sphere.
pub(super) fn collide_verticals(
    a: PosedSolid<'_>,
    b: PosedSolid<'_>,
    shapes: [&VerticalSolid; 2],
    previous: PreviousAxis,
    margins: ContactMargins,
) -> Manifold {
    let (one, other) = (PosedVertical::new(&a, shapes[0]), PosedVertical::new(&b, shapes[1]));
    let moved = |way: [f32; 3]| PosedVertical {
        position: std::array::from_fn(|axis| other.position[axis] + way[axis]),
        ..other
    };
    if shapes[0].rounding + shapes[1].rounding > 0.0 {
        let (now, is_new) = (rounded_contact(one, other), previous == PreviousAxis::NoContact);
        return collide_curved(&a, now, is_new, relative_displacement(&a, &b), margins, |displacement| {
            rounded_contact(one, moved(displacement))
        });
    }
    let now = axis_candidates(one, other);
    if now.max_separation().separation > margins.contact_margin {
        return Manifold::separated(now.max_separation().separation);
    }
    collide_along_chosen_axis([&a, &b], &now, previous, margins, |displacement| {
        axis_candidates(one, moved(displacement))
    })
}

/// Returns the contact manifold of A and B along the axis that counts. `at` returns the contacts along both axes after a
/// displacement of B relative to A (x, y, z in length units).
pub(super) fn collide_along_chosen_axis(
    [a, b]: [&PosedSolid<'_>; 2],
    now: &AxisCandidates,
    previous: PreviousAxis,
    margins: ContactMargins,
    at: impl Fn([f32; 3]) -> AxisCandidates,
) -> Manifold {
    match choose_axis(a, b, now, previous, margins) {
        None => Manifold::separated(0.0),
        Some(found) if found.is_curved => {
            let is_new = previous == PreviousAxis::NoContact;
            collide_curved(a, *found, is_new, relative_displacement(a, b), margins, |displacement| {
                at(displacement).lateral
            })
        }
        Some(found) => to_manifold(a, found, margins.contact_margin),
    }
}

/// Returns the manifold of a contact with a curved surface. A new contact gets the normal of the predicted touch.
/// `displacement` is that of B relative to A in the step, in length units; `at` returns the contact after a given displacement.
fn collide_curved(
    a: &PosedSolid<'_>,
    now: AxisContact,
    is_new: bool,
    displacement: [f32; 3],
    margins: ContactMargins,
    at: impl Fn([f32; 3]) -> AxisContact,
) -> Manifold {
    if now.separation > margins.contact_margin {
        return Manifold::separated(now.separation);
    }
    if !(is_new && now.is_curved && now.separation > 0.0) {
        return to_manifold(a, &now, margins.contact_margin);
    }
    match refine_contact_time(&now, displacement, margins.speculative_distance, at) {
        Some(found) => to_manifold(a, &found, f32::MAX),
        None => Manifold::separated(0.0),
    }
}

/// Returns whether a feature id belongs to a contact along the vertical axis.
pub(super) fn is_vertical_axis(feature: u32) -> bool {
    feature & (VERTICAL_AXIS_FEATURE | LATERAL_AXIS_FEATURE) == VERTICAL_AXIS_FEATURE
}

#[cfg(test)]
mod tests {
    use super::{PosedVertical, VerticalSolid, axis_candidates, rounded_contact};
    use crate::depth::interface::VerticalShape;

    fn cylinder(radius: f32, half_height: f32) -> VerticalSolid {
        VerticalSolid::new(VerticalShape::Cylinder { radius, half_height })
    }

    fn capsule(radius: f32, half_height: f32) -> VerticalSolid {
        VerticalSolid::new(VerticalShape::Capsule { radius, half_height })
    }

    #[test]
    fn cylinders_have_a_lateral_and_a_vertical_separation() {
        let (a, b) = (cylinder(10.0, 20.0), cylinder(5.0, 8.0));
        let found = axis_candidates(
            PosedVertical { shape: &a, position: [0.0, 0.0, 0.0] },
            PosedVertical { shape: &b, position: [12.0, -30.0, 16.0] },
        );
        assert_eq!((found.lateral.separation, found.lateral.normal), (5.0, [0.6, 0.0, 0.8]));
        assert_eq!((found.vertical.separation, found.vertical.normal), (2.0, [0.0, -1.0, 0.0]));
    }

    #[test]
    fn capsule_separation_is_axis_distance_minus_radii() {
        let (a, b) = (capsule(5.0, 20.0), capsule(3.0, 13.0));
        let apart = |at: [f32; 3]| {
            rounded_contact(
                PosedVertical { shape: &a, position: [0.0; 3] },
                PosedVertical { shape: &b, position: at },
            )
            .separation
        };
        assert_eq!(apart([6.0, 4.0, 8.0]), 2.0);
        // The axes end at 15 and at 29 - 10.
        assert!((apart([0.0, 29.0, 3.0]) - (-3.0)).abs() < 1e-5);
        assert_eq!(apart([0.0, 29.0 + 10.0, 0.0]), 6.0);
    }

    #[test]
    fn sphere_has_an_oblique_normal_at_the_rim_of_a_cylinder() {
        let (a, b) = (cylinder(10.0, 20.0), VerticalSolid::sphere(4.0));
        let found = rounded_contact(
            PosedVertical { shape: &a, position: [0.0; 3] },
            PosedVertical { shape: &b, position: [13.0, -24.0, 0.0] },
        );
        assert!((found.separation - 1.0).abs() < 1e-6);
        assert!((found.normal[0] - 0.6).abs() < 1e-6 && (found.normal[1] + 0.8).abs() < 1e-6);
        // Half a px from the cylinder, in the direction of the rim.
        assert!((found.points[0].0[0] - 10.3).abs() < 1e-5 && (found.points[0].0[1] + 20.4).abs() < 1e-5);
    }
}
