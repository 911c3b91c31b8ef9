//! Collision of spheres with spheres and prisms.
//!
//! Frame: that of the plane (x right, y down, px), with z into the picture. A prism is an outline of the plane, convex or not,
//! extruded by `half_depth` to both sides of its `z`. Its front looks towards -z.

use farseer_core::math::{Vector2, Vector3, vector2};

use super::{contains, doubled_area, edges, nearest};

/// Contact of a ball with another shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ShapeContact {
    /// Unit contact normal from the other shape to the ball, y down.
    pub(crate) normal: Vector3,
    /// Separation in px; negative, since the shapes overlap.
    pub(crate) separation: f32,
    /// Deepest point of the ball inside of the other shape, px, y down.
    pub(crate) point: Vector3,
}

/// Contact of a ball with a prism.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BallPrismContact {
    pub(crate) touch: ShapeContact,
    /// Whether the ball's centre is inside the prism.
    pub(crate) is_inside: bool,
}

impl ShapeContact {
    /// Returns the contact of a ball whose centre has the signed `distance` from a shape, px; `None` without overlap. `normal`
    /// points from the shape to the ball.
    fn at(centre: Vector3, radius: f32, distance: f32, normal: Vector3) -> Option<ShapeContact> {
        let separation = distance - radius;
        let point = centre - normal * radius;
        let is_finite = separation.is_finite() && point.iter().all(|coordinate| coordinate.is_finite());
        (is_finite && separation < 0.0).then_some(ShapeContact { normal, separation, point })
    }
}

/// Returns the contact of two balls, with the normal from the first to the second; `None` without overlap. Balls with equal
/// centres are separated upwards.
pub(crate) fn ball_ball(
    centre_a: Vector3,
    radius_a: f32,
    centre_b: Vector3,
    radius_b: f32,
) -> Option<ShapeContact> {
    let between = centre_b - centre_a;
    let distance = between.dot(&between).sqrt();
    // Squares of smaller numbers are not exact any more.
    let normal = if distance < 1e-15 { Vector3::new(0.0, -1.0, 0.0) } else { between / distance };
    ShapeContact::at(centre_b, radius_b, distance - radius_a, normal)
}

/// Signed distance of a ball's centre from the nearer end of a prism along z, px, and the sign of that end.
fn beyond_end(centre_z: f32, z: f32, half_depth: f32) -> (f32, f32) {
    let from_middle = centre_z - z;
    let sign = if from_middle < 0.0 { -1.0 } else { 1.0 };
    (from_middle * sign - half_depth, sign)
}

/// Contact of a ball with a prism. The normal is that of the nearest face, or points from the nearest edge or
/// vertex.
pub(crate) fn ball_prism(
    centre: Vector3,
    radius: f32,
    outline: &[Vector2],
    z: f32,
    half_depth: f32,
) -> Option<BallPrismContact> {
    let (beyond, sign) = beyond_end(centre.z, z, half_depth);
    if beyond >= radius {
        return None;
    }
    let nearest = nearest(outline, centre.xy())?;
    let beside = nearest.distance;
    let diagonal = (beside * beside + beyond * beyond).sqrt();
    let (distance, normal) = if beside > 0.0 && beyond > 0.0 && diagonal > 1e-15 {
        let in_plane = nearest.normal * (beside / diagonal);
        (diagonal, Vector3::new(in_plane.x, in_plane.y, sign * beyond / diagonal))
    } else if beside >= beyond {
        (beside, Vector3::new(nearest.normal.x, nearest.normal.y, 0.0))
    } else {
        (beyond, Vector3::new(0.0, 0.0, sign))
    };
    let touch = ShapeContact::at(centre, radius, distance, normal)?;
    Some(BallPrismContact { touch, is_inside: beside < 0.0 && beyond < 0.0 })
}

/// Returns the outward unit normal of the face of a prism through which the path from `before` to `now` enters; `None` if the
/// path starts inside or never enters. Both positions are in the frame of the present prism, px.
pub(crate) fn entry_face_of_prism(
    before: Vector3,
    now: Vector3,
    outline: &[Vector2],
    z: f32,
    half_depth: f32,
) -> Option<Vector3> {
    let displacement = now - before;
    let (beyond, sign) = beyond_end(before.z, z, half_depth);
    if beyond < 0.0 && nearest(outline, before.xy())?.distance < 0.0 {
        return None;
    }
    let approach = -sign * displacement.z;
    if beyond >= 0.0 && approach <= 0.0 {
        return None;
    }
    // Interval of the path, as a fraction 0..=1, between the planes of the two ends.
    let start = if beyond < 0.0 { 0.0 } else { beyond / approach };
    let leave = if displacement.z == 0.0 {
        1.0
    } else {
        (((z - before.z) * displacement.z.signum() + half_depth) / displacement.z.abs()).min(1.0)
    };
    if !(start >= 0.0 && start <= leave) {
        return None;
    }
    if beyond >= 0.0 && contains(outline, before.xy() + displacement.xy() * start) {
        return Some(Vector3::new(0.0, 0.0, sign));
    }
    let (entry, normal) = first_entry(outline, before.xy(), displacement.xy(), start)?;
    (entry <= leave).then(|| Vector3::new(normal.x, normal.y, 0.0))
}

/// Returns the first edge that a path crosses inward after the fraction `start`: the fraction of the path, 0..=1, and the
/// outward unit normal of the edge. `None` without one.
fn first_entry(
    outline: &[Vector2],
    before: Vector2,
    displacement: Vector2,
    start: f32,
) -> Option<(f32, Vector2)> {
    let area = doubled_area(outline);
    let mut first: Option<(f32, Vector2)> = None;
    for (a, b) in edges(outline) {
        let edge = if area > 0.0 { a - b } else { b - a };
        let outward = Vector2::new(-edge.y, edge.x);
        let speed = vector2::dot(outward, displacement);
        // Each vertex belongs to one side, so that a path through it crosses exactly one of its edges.
        let (side_a, side_b) =
            (vector2::cross(displacement, a - before), vector2::cross(displacement, b - before));
        if speed >= 0.0 || (side_a > 0.0) == (side_b > 0.0) {
            continue;
        }
        let along = vector2::dot(outward, a - before) / speed;
        let length = vector2::length(outward);
        // By rounding, a path that starts on the edge may seem to start behind it.
        let is_ahead = along >= start - 1e-4 && length > 0.0;
        if is_ahead && first.is_none_or(|(least, _)| along < least) {
            first = Some((along, Vector2::new(outward.x / length, outward.y / length)));
        }
    }
    first
}

/// Returns the contact of a ball, whose centre is inside of a prism, with the face that has the given outward normal, even if
/// another face is nearer. The penetration is the distance along this normal until the ball is outside.
///
/// For a centre beside the outline this is the distance from the supporting line in that direction.
pub(crate) fn ball_prism_through_face(
    centre: Vector3,
    radius: f32,
    outline: &[Vector2],
    z: f32,
    half_depth: f32,
    face: Vector3,
) -> Option<ShapeContact> {
    if face.z != 0.0 {
        let distance = (centre.z - z) * face.z - half_depth;
        return ShapeContact::at(centre, radius, distance, face);
    }
    let direction = face.xy();
    let exit =
        contains(outline, centre.xy()).then(|| exit_distance(outline, centre.xy(), direction)).flatten();
    let distance = exit.map(|displacement| -displacement).or_else(|| {
        let support = outline.iter().map(|vertex| vector2::dot(direction, *vertex)).reduce(f32::max)?;
        Some(vector2::dot(direction, centre.xy()) - support)
    })?;
    ShapeContact::at(centre, radius, distance, face)
}

/// Distance from a point inside an outline to the outline in a direction, px.
fn exit_distance(outline: &[Vector2], point: Vector2, direction: Vector2) -> Option<f32> {
    let mut least: Option<f32> = None;
    for (a, b) in edges(outline) {
        let (side_a, side_b) = (vector2::cross(direction, a - point), vector2::cross(direction, b - point));
        if (side_a > 0.0) == (side_b > 0.0) {
            continue;
        }
        let (along_a, along_b) = (vector2::dot(direction, a - point), vector2::dot(direction, b - point));
        let along = along_a + (along_b - along_a) * (side_a / (side_a - side_b));
        if along >= 0.0 && least.is_none_or(|least| along < least) {
            least = Some(along);
        }
    }
    least
}

#[cfg(test)]
mod tests {
    use super::super::samples::{Random, points, rectangle, winds_around};
    use super::*;

    fn v(x: f32, y: f32, z: f32) -> Vector3 {
        Vector3::new(x, y, z)
    }

    /// Returns the contact of a ball with a box 20 wide, 10 high and 8 deep about the origin.
    fn contact_with_box(centre: Vector3, radius: f32) -> Option<BallPrismContact> {
        ball_prism(centre, radius, &rectangle((0.0, 0.0), 20.0, 10.0, 0.0), 0.0, 4.0)
    }

    fn entry_of_box(before: Vector3, now: Vector3) -> Option<Vector3> {
        entry_face_of_prism(before, now, &rectangle((0.0, 0.0), 20.0, 10.0, 0.0), 0.0, 4.0)
    }

    #[test]
    fn balls_touch_along_the_line_of_their_centres() {
        let found = ball_ball(v(1.0, 2.0, 3.0), 4.0, v(3.0, 5.0, 9.0), 5.0);
        let normal = v(2.0, 3.0, 6.0) / 7.0;
        let point = v(3.0, 5.0, 9.0) - normal * 5.0;
        assert_eq!(found, Some(ShapeContact { normal, separation: -2.0, point }));
    }

    #[test]
    fn balls_that_only_touch_have_no_contact() {
        assert_eq!(ball_ball(v(0.0, 0.0, 0.0), 4.0, v(0.0, 0.0, 9.0), 5.0), None);
        assert_eq!(ball_ball(v(0.0, 0.0, 0.0), 4.0, v(0.0, f32::NAN, 9.0), 5.0), None);
        assert_eq!(ball_ball(v(0.0, 0.0, 0.0), f32::INFINITY, v(0.0, 0.0, 9.0), 5.0), None);
    }

    #[test]
    fn the_second_of_two_coincident_balls_is_pushed_up() {
        let found = ball_ball(v(1.0, 2.0, 3.0), 4.0, v(1.0, 2.0, 3.0), 5.0).expect("a contact");
        assert_eq!((found.normal, found.separation), (v(0.0, -1.0, 0.0), -9.0));
    }

    #[test]
    fn a_ball_on_a_face_is_pushed_along_its_normal() {
        let top = contact_with_box(v(3.0, -6.0, 1.0), 2.0).expect("a contact");
        let expected = ShapeContact { normal: v(0.0, -1.0, 0.0), separation: -1.0, point: v(3.0, -4.0, 1.0) };
        assert_eq!(top, BallPrismContact { touch: expected, is_inside: false });
        let front = contact_with_box(v(3.0, 1.0, -5.0), 2.0).expect("a contact");
        assert_eq!((front.touch.normal, front.touch.separation), (v(0.0, 0.0, -1.0), -1.0));
    }

    #[test]
    fn a_ball_at_the_edge_of_front_and_top_is_pushed_away_from_the_edge() {
        let found = contact_with_box(v(0.0, -8.0, -8.0), 6.0).expect("a contact").touch;
        assert_eq!((found.normal, found.separation), (v(0.0, -0.6, -0.8), -1.0));
    }

    #[test]
    fn a_ball_at_a_corner_is_pushed_away_from_the_corner() {
        let found = contact_with_box(v(12.0, 8.0, 10.0), 8.0).expect("a contact").touch;
        // The corner is at (10, 5, 4).
        let normal = v(2.0, 3.0, 6.0) / 7.0;
        assert!((found.normal - normal).amax() < 1e-6);
        assert_eq!(found.separation, -1.0);
    }

    #[test]
    fn a_centre_inside_is_pushed_through_the_nearest_face() {
        let side = contact_with_box(v(9.0, 0.0, 0.0), 2.0).expect("a contact");
        assert!(side.is_inside);
        assert_eq!((side.touch.normal, side.touch.separation), (v(1.0, 0.0, 0.0), -3.0));
        let back = contact_with_box(v(0.0, 0.0, 3.5), 2.0).expect("a contact");
        assert_eq!((back.touch.normal, back.touch.separation), (v(0.0, 0.0, 1.0), -2.5));
    }

    #[test]
    fn a_centre_in_the_middle_of_a_thin_prism_is_pushed_back() {
        let found = ball_prism(v(0.0, 0.0, 5.0), 2.0, &rectangle((0.0, 0.0), 20.0, 10.0, 0.0), 5.0, 0.0);
        assert_eq!(found.map(|found| (found.touch.normal, found.is_inside)), Some((v(0.0, 0.0, 1.0), false)));
    }

    #[test]
    fn balls_out_of_reach_have_no_contact() {
        assert_eq!(contact_with_box(v(0.0, -7.0, 0.0), 2.0), None);
        assert_eq!(contact_with_box(v(0.0, 0.0, 6.0), 2.0), None);
        assert_eq!(contact_with_box(v(11.5, 0.0, 5.5), 2.0), None);
        assert_eq!(contact_with_box(v(0.0, f32::NAN, 0.0), 2.0), None);
        assert_eq!(contact_with_box(v(0.0, 0.0, f32::NAN), 2.0), None);
        assert_eq!(ball_prism(v(0.0, 0.0, 0.0), 2.0, &[], 0.0, 4.0), None);
    }

    #[test]
    fn the_distance_outside_is_that_of_the_nearest_point_of_the_prism() {
        let mut random = Random(8);
        for _ in 0..300 {
            let outline = random.star(Vector2::zeros(), 8, 20.0, 1.0);
            let centre =
                v(random.number(-30.0, 30.0), random.number(-30.0, 30.0), random.number(-15.0, 15.0));
            let Some(found) = ball_prism(centre, 50.0, &outline, 2.0, 5.0) else { continue };
            let distance = found.touch.separation + 50.0;
            if distance <= 0.0 {
                assert!(winds_around(&outline, centre.xy()) && (centre.z - 2.0).abs() <= 5.0);
                continue;
            }
            let reached = centre - found.touch.normal * distance;
            let on_prism = nearest(&outline, reached.xy()).expect("a nearest point").distance;
            assert!(on_prism < 1e-4 && (reached.z - 2.0).abs() < 5.0 + 1e-4);
            for _ in 0..200 {
                let point =
                    v(random.number(-20.0, 20.0), random.number(-20.0, 20.0), random.number(-3.0, 7.0));
                let is_nearer = (point - centre).norm() < distance - 1e-4;
                assert!(!(is_nearer && winds_around(&outline, point.xy())));
            }
        }
    }

    #[test]
    fn the_separation_grows_along_the_normal_as_fast_as_the_ball_goes() {
        let mut random = Random(9);
        let mut seen = [0, 0];
        for _ in 0..500 {
            let outline = random.star(Vector2::zeros(), 8, 20.0, 0.5);
            let centre = v(random.number(-25.0, 25.0), random.number(-25.0, 25.0), random.number(-8.0, 8.0));
            let Some(found) = ball_prism(centre, 9.0, &outline, 0.0, 6.0) else { continue };
            assert!((found.touch.normal.norm() - 1.0).abs() < 1e-6);
            // Towards the nearest point, which stays the nearest on the way.
            let step = if found.is_inside { 0.01 } else { -0.01 };
            let next = ball_prism(centre + found.touch.normal * step, 9.0, &outline, 0.0, 6.0);
            let Some(next) = next.filter(|next| next.is_inside == found.is_inside) else { continue };
            assert!((next.touch.separation - found.touch.separation - step).abs() < 1e-4);
            seen[usize::from(found.is_inside)] += 1;
        }
        assert!(seen[0] > 50 && seen[1] > 50);
    }

    #[test]
    fn the_face_of_entry_is_the_one_that_the_path_crosses() {
        assert_eq!(entry_of_box(v(0.0, -9.0, 0.0), v(1.0, 4.0, 0.0)), Some(v(0.0, -1.0, 0.0)));
        assert_eq!(entry_of_box(v(-19.0, 0.0, 3.0), v(9.0, 0.0, 0.0)), Some(v(-1.0, 0.0, 0.0)));
        assert_eq!(entry_of_box(v(0.0, 0.0, 9.0), v(0.0, 0.0, -3.0)), Some(v(0.0, 0.0, 1.0)));
    }

    #[test]
    fn an_oblique_path_enters_through_the_face_crossed_last() {
        // At z = -4 after half of the way, at y = -5 after a quarter or after three quarters.
        assert_eq!(entry_of_box(v(0.0, -7.0, -8.0), v(0.0, 1.0, 0.0)), Some(v(0.0, 0.0, -1.0)));
        assert_eq!(entry_of_box(v(0.0, -11.0, -8.0), v(0.0, -3.0, 0.0)), Some(v(0.0, -1.0, 0.0)));
    }

    #[test]
    fn a_path_that_starts_inside_or_misses_has_no_face_of_entry() {
        assert_eq!(entry_of_box(v(0.0, 0.0, 0.0), v(0.0, -3.0, 0.0)), None);
        assert_eq!(entry_of_box(v(0.0, -9.0, 0.0), v(0.0, -9.0, 0.0)), None);
        assert_eq!(entry_of_box(v(0.0, -9.0, 0.0), v(0.0, -12.0, 0.0)), None);
        assert_eq!(entry_of_box(v(0.0, 0.0, 4.0), v(0.0, 0.0, 9.0)), None);
        assert_eq!(entry_of_box(v(0.0, -9.0, -20.0), v(0.0, 0.0, -5.0)), None);
        assert_eq!(entry_of_box(v(0.0, f32::NAN, 0.0), v(0.0, 0.0, 0.0)), None);
    }

    #[test]
    fn a_path_that_starts_on_a_face_enters_through_it() {
        assert_eq!(entry_of_box(v(0.0, -5.0, 0.0), v(0.0, 0.0, 0.0)), Some(v(0.0, -1.0, 0.0)));
        assert_eq!(entry_of_box(v(0.0, 0.0, -4.0), v(0.0, 0.0, 0.0)), Some(v(0.0, 0.0, -1.0)));
    }

    #[test]
    fn the_face_of_entry_into_a_concave_prism_is_the_first() {
        let u_shape = points(&[
            (-6.0, 0.0),
            (-6.0, 9.0),
            (6.0, 9.0),
            (6.0, 0.0),
            (2.0, 0.0),
            (2.0, 5.0),
            (-2.0, 5.0),
            (-2.0, 0.0),
        ]);
        let face =
            |from: f32, to: f32| entry_face_of_prism(v(from, 2.0, 0.0), v(to, 2.0, 0.0), &u_shape, 0.0, 4.0);
        assert_eq!(face(-9.0, 4.0), Some(v(-1.0, 0.0, 0.0)));
        assert_eq!(face(0.0, 4.0), Some(v(-1.0, 0.0, 0.0)));
        assert_eq!(face(0.0, -4.0), Some(v(1.0, 0.0, 0.0)));
    }

    #[test]
    fn random_paths_enter_through_the_face_where_sampling_finds_them_inside_first() {
        let mut random = Random(10);
        let mut seen = 0;
        for _ in 0..500 {
            let outline = random.star(Vector2::zeros(), 7, 20.0, 1.0);
            let mut end =
                || v(random.number(-30.0, 30.0), random.number(-30.0, 30.0), random.number(-9.0, 9.0));
            let (before, now) = (end(), end());
            let is_inside = |point: Vector3| {
                point.z.abs() < 5.0 && nearest(&outline, point.xy()).is_some_and(|found| found.distance < 0.0)
            };
            let first =
                (0..=5000).map(|i| before + (now - before) * (i as f32 / 5000.0)).find(|p| is_inside(*p));
            let found = entry_face_of_prism(before, now, &outline, 0.0, 5.0);
            assert!(!(is_inside(before) && found.is_some()));
            let Some(first) = first.filter(|_| !is_inside(before)) else { continue };
            let face = found.expect("a face of entry");
            seen += 1;
            // Samples are up to 0.02 apart.
            let depth = ball_prism_through_face(first, 0.0, &outline, 0.0, 5.0, face).expect("a contact");
            assert!(depth.separation > -0.02);
            assert!(face.dot(&(now - before)) < 0.0);
        }
        assert!(seen > 100);
    }

    #[test]
    fn through_a_face_the_ball_goes_all_the_way_back() {
        let outline = rectangle((0.0, 0.0), 20.0, 10.0, 0.0);
        let through = |face: Vector3| {
            ball_prism_through_face(v(1.0, 4.0, 3.0), 2.0, &outline, 0.0, 4.0, face)
                .map(|touch| touch.separation)
        };
        assert_eq!(through(v(0.0, -1.0, 0.0)), Some(-11.0));
        assert_eq!(through(v(1.0, 0.0, 0.0)), Some(-11.0));
        assert_eq!(through(v(0.0, 0.0, -1.0)), Some(-9.0));
        assert_eq!(through(v(0.0, 0.0, 1.0)), Some(-3.0));
    }

    #[test]
    fn through_a_face_of_a_concave_prism_the_ball_goes_to_the_next_side() {
        let u_shape = points(&[
            (-6.0, 0.0),
            (-6.0, 9.0),
            (6.0, 9.0),
            (6.0, 0.0),
            (2.0, 0.0),
            (2.0, 5.0),
            (-2.0, 5.0),
            (-2.0, 0.0),
        ]);
        let found = ball_prism_through_face(v(3.0, 2.0, 0.0), 0.5, &u_shape, 0.0, 4.0, v(-1.0, 0.0, 0.0));
        assert_eq!(found.map(|touch| touch.separation), Some(-1.5));
    }

    #[test]
    fn beside_the_outline_the_supporting_line_counts() {
        let outline = rectangle((0.0, 0.0), 20.0, 10.0, 0.0);
        let found = ball_prism_through_face(v(15.0, -4.0, 0.0), 2.0, &outline, 0.0, 4.0, v(0.0, -1.0, 0.0));
        assert_eq!(found.map(|touch| touch.separation), Some(-3.0));
        assert_eq!(ball_prism_through_face(v(0.0, 0.0, 0.0), 2.0, &[], 0.0, 4.0, v(1.0, 0.0, 0.0)), None);
    }
}
