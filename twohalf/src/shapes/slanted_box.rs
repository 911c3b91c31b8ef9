//! The shape of a platform: a box, tilted about the z axis and sheared along x with depth.
//!
//! Frame: the plane's, x right, y **down**, z into the picture. A point of the box has three local coordinates:
//! `across` and `down` in the tilted rectangle and `deep` along z, each within the half sizes; at depth `deep` from
//! the centre the rectangle is shifted by `shear * deep` in x. That makes a parallelepiped whose front and back are
//! at right angles to z and whose sides have the normals `(nx, ny, -shear * nx)`, not yet of unit length.
//!
//! Source: the closest point minimises the squared distance, which is convex and piecewise quadratic in `deep`;
//! segments are clipped by the half-spaces of the faces (Cyrus and Beck 1978).

use farseer_core::math::{Vector2, Vector3};
use serde::{Deserialize, Serialize};

/// A box tilted about z and sheared along x.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct SlantedBox {
    pub(crate) centre: Vector3,
    /// Half of width, height and depth.
    pub(crate) half: [f32; 3],
    /// Cosine of the tilt, clockwise on the screen.
    pub(crate) cos: f32,
    pub(crate) sin: f32,
    /// Shift in x for every unit of depth from the centre.
    pub(crate) shear: f32,
}

impl Default for SlantedBox {
    fn default() -> Self {
        SlantedBox { centre: Vector3::zeros(), half: [0.0; 3], cos: 1.0, sin: 0.0, shear: 0.0 }
    }
}

/// A face of the box, named as it lies when level. The first four are in the order of the outline's edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Face {
    Top,
    Left,
    Bottom,
    Right,
    Front,
    Back,
}

impl Face {
    /// The sides, in the order of the outline's edges.
    pub(crate) const SIDES: [Face; 4] = [Face::Top, Face::Left, Face::Bottom, Face::Right];
    const ALL: [Face; 6] = [Face::Top, Face::Left, Face::Bottom, Face::Right, Face::Front, Face::Back];
}

/// Where a ball touches the box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BoxTouch {
    /// Unit vector from the box to the ball.
    pub(crate) normal: Vector3,
    /// Negative when they overlap.
    pub(crate) separation: f32,
    /// On the ball's surface.
    pub(crate) point: Vector3,
    /// The face through which the ball leaves, while its centre is inside.
    pub(crate) face: Option<Face>,
}

/// How far a coordinate is beyond a half size, with its sign; 0 within.
fn excess(coordinate: f32, half: f32) -> f32 {
    coordinate - coordinate.max(-half).min(half)
}

/// Closest point queries.
impl SlantedBox {
    /// Signed distance of a point to the surface, negative inside, and its unit gradient. None if not finite.
    pub(crate) fn nearest(&self, point: Vector3) -> Option<(f32, Vector3)> {
        let offset = point - self.centre;
        let [width, height, depth] = self.half;
        if self.contains(point) {
            let face = self.nearest_face(point);
            return Some((self.distance_to_face(face, point), self.face_normal(face)));
        }
        let deep = self.closest_deep(offset);
        let (across, down) = self.local(offset, deep);
        let excess_across = excess(across, width);
        let excess_down = excess(down, height);
        let is_inner = deep > -depth && deep < depth;
        // Opposite one face only, its normal is known without dividing by a distance that may be tiny.
        let face = match (excess_across, excess_down) {
            // On the surface, as far as rounding goes.
            (0.0, 0.0) if is_inner => Some(self.nearest_face(point)),
            (0.0, 0.0) => Some(if deep < 0.0 { Face::Front } else { Face::Back }),
            (a, 0.0) if is_inner => Some(if a < 0.0 { Face::Left } else { Face::Right }),
            (0.0, d) if is_inner => Some(if d < 0.0 { Face::Top } else { Face::Bottom }),
            _ => None,
        };
        if let Some(face) = face {
            return Some((self.distance_to_face(face, point), self.face_normal(face)));
        }
        let plane = self.tilted(excess_across, excess_down);
        let away = Vector3::new(plane.x, plane.y, offset.z - deep);
        let distance = away.norm();
        (distance > 0.0 && distance.is_finite()).then(|| (distance, away / distance))
    }

    /// Depth from the centre of the closest point of the box to a point outside.
    fn closest_deep(&self, offset: Vector3) -> f32 {
        let [width, height, depth] = self.half;
        if self.shear == 0.0 {
            return offset.z.max(-depth).min(depth);
        }
        // The local coordinates of the point move at these rates as `deep` grows.
        let (across_rate, down_rate) = (-self.shear * self.cos, self.shear * self.sin);
        let (across, down) = self.local(offset, 0.0);
        // Half the derivative of the squared distance: rising, and linear between the depths at which a coordinate
        // passes the edge of the rectangle.
        let slope = |deep: f32| {
            let (across, down) = (across + across_rate * deep, down + down_rate * deep);
            let excess_across = excess(across, width);
            let excess_down = excess(down, height);
            deep - offset.z + excess_across * across_rate + excess_down * down_rate
        };
        let (mut low, mut high) = (-depth, depth);
        let (mut slope_low, mut slope_high) = (slope(low), slope(high));
        if slope_low >= 0.0 {
            return low;
        }
        if slope_high <= 0.0 {
            return high;
        }
        let bends = [
            (width - across) / across_rate,
            (-width - across) / across_rate,
            (height - down) / down_rate,
            (-height - down) / down_rate,
        ];
        for bend in bends {
            // Bends outside, and those that no rate gives (infinite or not a number), are passed over.
            if bend > low && bend < high {
                let slope = slope(bend);
                if slope < 0.0 {
                    (low, slope_low) = (bend, slope);
                } else {
                    (high, slope_high) = (bend, slope);
                }
            }
        }
        let share = -slope_low / (slope_high - slope_low);
        (low + (high - low) * share).max(low).min(high)
    }

    /// Where a ball touches. `before` is where its centre was in the last step, relative to the box. While the centre
    /// is inside, the ball leaves through the face that was `kept`, or else the one it came through, or else the
    /// nearest.
    pub(crate) fn ball_touch(
        &self,
        centre: Vector3,
        before: Vector3,
        radius: f32,
        kept: Option<Face>,
    ) -> Option<BoxTouch> {
        let (distance, normal, face) = if self.contains(centre) {
            let came = || self.entry_face(before, centre).unwrap_or_else(|| self.nearest_face(centre));
            let face = kept.unwrap_or_else(came);
            (self.distance_to_face(face, centre), self.face_normal(face), Some(face))
        } else {
            let (distance, normal) = self.nearest(centre)?;
            (distance, normal, None)
        };
        let separation = distance - radius;
        (separation < 0.0).then(|| BoxTouch { normal, separation, point: centre - normal * radius, face })
    }
}

/// Faces.
impl SlantedBox {
    /// Outward normal of a face in the plane, unit length; zero for front and back.
    pub(crate) fn plane_normal(&self, face: Face) -> Vector2 {
        let SlantedBox { cos, sin, .. } = *self;
        match face {
            Face::Top => Vector2::new(sin, -cos),
            Face::Left => Vector2::new(-cos, -sin),
            Face::Bottom => Vector2::new(-sin, cos),
            Face::Right => Vector2::new(cos, sin),
            Face::Front | Face::Back => Vector2::zeros(),
        }
    }

    /// Length of a side's normal `(nx, ny, -shear * nx)`.
    pub(crate) fn stretch(&self, plane_normal: Vector2) -> f32 {
        let lean = self.shear * plane_normal.x;
        (1.0 + lean * lean).sqrt()
    }

    /// Outward unit normal of a face.
    pub(crate) fn face_normal(&self, face: Face) -> Vector3 {
        match face {
            Face::Front => Vector3::new(0.0, 0.0, -1.0),
            Face::Back => Vector3::new(0.0, 0.0, 1.0),
            _ => {
                let normal = self.plane_normal(face);
                let stretch = self.stretch(normal);
                Vector3::new(normal.x / stretch, normal.y / stretch, -self.shear * normal.x / stretch)
            }
        }
    }

    /// Signed distance of a point to the plane of a face, positive outside.
    pub(crate) fn distance_to_face(&self, face: Face, point: Vector3) -> f32 {
        let offset = point - self.centre;
        let [width, height, depth] = self.half;
        let half = match face {
            Face::Front => return -offset.z - depth,
            Face::Back => return offset.z - depth,
            Face::Left | Face::Right => width,
            Face::Top | Face::Bottom => height,
        };
        let normal = self.plane_normal(face);
        let x = offset.x - self.shear * offset.z;
        (normal.x * x + normal.y * offset.y - half) / self.stretch(normal)
    }

    /// The face whose plane is nearest to a point inside: the first one where several are.
    fn nearest_face(&self, point: Vector3) -> Face {
        let mut nearest = (Face::Top, self.distance_to_face(Face::Top, point));
        for face in Face::ALL {
            let distance = self.distance_to_face(face, point);
            if distance > nearest.1 {
                nearest = (face, distance);
            }
        }
        nearest.0
    }

    /// The face through which the way from `before` to `now` enters the box; None if it begins inside or misses it.
    pub(crate) fn entry_face(&self, before: Vector3, now: Vector3) -> Option<Face> {
        let (mut entry, mut exit) = ((None, 0.0), 1.0f32);
        for face in Face::ALL {
            let from = self.distance_to_face(face, before);
            let to = self.distance_to_face(face, now);
            if from > 0.0 && to > 0.0 {
                return None;
            }
            let share = from / (from - to);
            if from > 0.0 && (entry.0.is_none() || share > entry.1) {
                entry = (Some(face), share);
            } else if to > 0.0 {
                exit = exit.min(share);
            }
        }
        entry.0.filter(|_| entry.1 <= exit)
    }
}

/// Outlines and extents.
impl SlantedBox {
    /// A vector of the rectangle turned into the plane.
    fn tilted(&self, across: f32, down: f32) -> Vector2 {
        Vector2::new(across * self.cos - down * self.sin, across * self.sin + down * self.cos)
    }

    /// Coordinates in the rectangle at depth `deep` of a point at an offset from the centre.
    fn local(&self, offset: Vector3, deep: f32) -> (f32, f32) {
        let x = offset.x - self.shear * deep;
        (x * self.cos + offset.y * self.sin, offset.y * self.cos - x * self.sin)
    }

    /// Whether a point is inside or on the surface.
    pub(crate) fn contains(&self, point: Vector3) -> bool {
        let offset = point - self.centre;
        let [width, height, depth] = self.half;
        let (across, down) = self.local(offset, offset.z);
        offset.z.abs() <= depth && across.abs() <= width && down.abs() <= height
    }

    /// The rectangle about the origin, wound as the engine's outlines: from the top right corner to the left.
    pub(super) fn rectangle(&self) -> [Vector2; 4] {
        let [width, height, _] = self.half;
        [(width, -height), (-width, -height), (-width, height), (width, height)]
            .map(|(across, down)| self.tilted(across, down))
    }

    /// The outline at a depth, whether or not the box reaches there.
    pub(crate) fn outline_at(&self, z: f32) -> [Vector2; 4] {
        let centre = Vector2::new(self.centre.x + self.shear * (z - self.centre.z), self.centre.y);
        self.rectangle().map(|corner| centre + corner)
    }

    /// Least and greatest coordinates.
    pub(crate) fn bounds(&self) -> (Vector3, Vector3) {
        let [width, height, depth] = self.half;
        let (cos, sin) = (self.cos.abs(), self.sin.abs());
        let x = width * cos + height * sin + self.shear.abs() * depth;
        let reach = Vector3::new(x, width * sin + height * cos, depth);
        (self.centre - reach, self.centre + reach)
    }

    /// The y of the topmost point on the vertical line at `x` and `z`, and the normal of the face there. None when
    /// the line misses the box.
    pub(crate) fn height_at(&self, x: f32, z: f32) -> Option<(f32, Vector3)> {
        let [width, height, depth] = self.half;
        let deep = z - self.centre.z;
        let reaches = deep.abs() <= depth;
        if !reaches {
            return None;
        }
        let x = x - self.centre.x - self.shear * deep;
        let (mut top, mut bottom, mut face) = (f32::NEG_INFINITY, f32::INFINITY, Face::Top);
        // Both local coordinates are linear in y: `start + rate * y`.
        let slabs = [
            (-x * self.sin, self.cos, height, Face::Top, Face::Bottom),
            (x * self.cos, self.sin, width, Face::Left, Face::Right),
        ];
        for (start, rate, half, low_face, high_face) in slabs {
            if rate == 0.0 {
                if start.abs() > half {
                    return None;
                }
                continue;
            }
            let (at_low, at_high) = ((-half - start) / rate, (half - start) / rate);
            let (low, high, first) =
                if rate > 0.0 { (at_low, at_high, low_face) } else { (at_high, at_low, high_face) };
            if low > top {
                (top, face) = (low, first);
            }
            bottom = bottom.min(high);
        }
        (top <= bottom && top.is_finite()).then(|| (self.centre.y + top, self.face_normal(face)))
    }
}

#[cfg(test)]
mod tests {
    use farseer_core::math::scalar;

    use super::*;

    /// A small linear congruential generator: numbers from -1 to 1.
    struct Numbers(u32);

    impl Numbers {
        fn next(&mut self) -> f32 {
            self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (self.0 >> 8) as f32 / 8_388_608.0 - 1.0
        }

        fn vector(&mut self, scale: f32) -> Vector3 {
            Vector3::new(self.next() * scale, self.next() * scale, self.next() * scale)
        }

        /// Level, tilted and sheared boxes at some distance from the origin.
        fn shape(&mut self, round: u32) -> SlantedBox {
            let (sin, cos) = if round % 3 == 0 { (0.0, 1.0) } else { scalar::sin_cos(self.next() * 4.0) };
            let shear = if round % 2 == 0 { 0.0 } else { self.next() * 2.0 };
            let half = [0; 3].map(|_| 30.0 + 20.0 * self.next());
            SlantedBox { centre: self.vector(200.0), half, cos, sin, shear }
        }
    }

    /// Squared distance to the rectangle at a depth from the centre, in f64.
    fn squared_distance_at(shape: &SlantedBox, point: Vector3, deep: f64) -> f64 {
        let offset = (point - shape.centre).map(f64::from);
        let [width, height, _] = shape.half.map(f64::from);
        let (cos, sin) = (f64::from(shape.cos), f64::from(shape.sin));
        let x = offset.x - f64::from(shape.shear) * deep;
        let across = x * cos + offset.y * sin;
        let down = offset.y * cos - x * sin;
        let (across, down) = (across.abs() - width, down.abs() - height);
        across.max(0.0).powi(2) + down.max(0.0).powi(2) + (offset.z - deep).powi(2)
    }

    /// By ternary search over the depth, where the function is convex.
    fn distance_by_search(shape: &SlantedBox, point: Vector3) -> f64 {
        let (mut low, mut high) = (-f64::from(shape.half[2]), f64::from(shape.half[2]));
        for _ in 0..100 {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if squared_distance_at(shape, point, a) < squared_distance_at(shape, point, b) {
                high = b;
            } else {
                low = a;
            }
        }
        squared_distance_at(shape, point, low).sqrt()
    }

    const LEVEL: SlantedBox = SlantedBox {
        centre: Vector3::new(10.0, -20.0, 30.0),
        half: [50.0, 20.0, 15.0],
        cos: 1.0,
        sin: 0.0,
        shear: 0.0,
    };

    #[test]
    fn distances_outside_are_those_of_a_search_over_the_depth() {
        let mut numbers = Numbers(1);
        let mut outside = 0;
        for round in 0..3000 {
            let shape = numbers.shape(round);
            let point = shape.centre + numbers.vector(150.0);
            let (distance, normal) = shape.nearest(point).unwrap();
            let expected = distance_by_search(&shape, point);
            if expected < 1e-3 {
                continue;
            }
            outside += 1;
            // Coordinates up to 350 have an error of 2e-5; a shear of 2 and a few operations make it ten times that.
            assert!((f64::from(distance) - expected).abs() < 5e-4, "{distance} {expected}");
            assert!((normal.norm() - 1.0).abs() < 1e-5);
            // The point on the surface is one: the way back ends there.
            assert!(distance_by_search(&shape, point - normal * distance) < 2e-3);
        }
        assert!(outside > 2000);
    }

    #[test]
    fn inside_no_way_out_is_shorter_than_the_distance() {
        let mut numbers = Numbers(2);
        for round in 0..300 {
            let shape = numbers.shape(round);
            let point = shape.centre + numbers.vector(15.0);
            if !shape.contains(point) {
                continue;
            }
            let (distance, normal) = shape.nearest(point).unwrap();
            assert!(distance <= 0.0);
            assert!(!shape.contains(point + normal * (1e-3 - distance)));
            for _ in 0..50 {
                let way = numbers.vector(1.0);
                assert!(shape.contains(point + way.normalize() * (-distance - 1e-3).max(0.0)));
            }
        }
    }

    #[test]
    fn a_point_above_a_level_box_has_its_height_as_distance() {
        let (distance, normal) = LEVEL.nearest(Vector3::new(0.0, -45.0, 35.0)).unwrap();
        assert_eq!((distance, normal), (5.0, Vector3::new(0.0, -1.0, 0.0)));
    }

    #[test]
    fn a_sheared_sides_normal_leans_towards_its_depth() {
        // At depth dz the right side is at x = 60 + dz; its normal (1, 0, -1) / sqrt(2).
        let shape = SlantedBox { shear: 1.0, ..LEVEL };
        let (distance, normal) = shape.nearest(Vector3::new(62.0, -20.0, 30.0)).unwrap();
        let half_root = 0.5f32.sqrt();
        assert!((distance - 2.0 * half_root).abs() < 1e-6);
        assert!((normal - Vector3::new(half_root, 0.0, -half_root)).norm() < 1e-6);
    }

    #[test]
    fn the_bounds_are_those_of_the_corners() {
        let mut numbers = Numbers(3);
        for round in 0..100 {
            let shape = numbers.shape(round);
            let (low, high) = shape.bounds();
            let ends = [-1.0, 1.0].map(|end| shape.outline_at(shape.centre.z + end * shape.half[2]));
            let corners = || ends.iter().flatten();
            let least =
                |coordinate: usize| corners().fold(f32::INFINITY, |least, c| least.min(c[coordinate]));
            let greatest =
                |coordinate: usize| corners().fold(-f32::INFINITY, |most, c| most.max(c[coordinate]));
            for coordinate in 0..2 {
                assert!((least(coordinate) - low[coordinate]).abs() < 1e-3);
                assert!((greatest(coordinate) - high[coordinate]).abs() < 1e-3);
            }
            assert_eq!((low.z, high.z), (shape.centre.z - shape.half[2], shape.centre.z + shape.half[2]));
        }
    }

    #[test]
    fn the_outline_is_wound_as_the_engine_winds_outlines() {
        let outline = SlantedBox { cos: 0.6, sin: 0.8, ..LEVEL }.outline_at(30.0);
        let products = (0..4).map(|i| (outline[i], outline[(i + 1) % 4])).map(|(a, b)| a.x * b.y - a.y * b.x);
        assert!(products.sum::<f32>() < 0.0);
    }

    #[test]
    fn the_entry_face_is_where_a_march_along_the_way_first_gets_inside() {
        let mut numbers = Numbers(4);
        let mut entered = 0;
        for round in 0..2000 {
            let shape = numbers.shape(round);
            let (before, now) = (shape.centre + numbers.vector(120.0), shape.centre + numbers.vector(60.0));
            const STEPS: i32 = 2000;
            let at = |step: i32| before + (now - before) * (step as f32 / STEPS as f32);
            let first = (0..=STEPS).find(|&step| shape.contains(at(step)));
            match (first, shape.entry_face(before, now)) {
                (Some(0), face) => assert_eq!(face, None),
                (Some(step), Some(face)) => {
                    entered += 1;
                    // The way crosses the face's plane during this step.
                    assert!(shape.distance_to_face(face, at(step)) <= 1e-3);
                    assert!(shape.distance_to_face(face, at(step - 1)) >= -1e-3);
                }
                (None, None) => {}
                // A way through a corner may be shorter than a step of the march.
                (None, Some(_)) => assert!(distance_to_way(&shape, before, now) < 0.1),
                (Some(_), None) => panic!("{shape:?} {before:?} {now:?}"),
            }
        }
        assert!(entered > 300);
    }

    fn distance_to_way(shape: &SlantedBox, before: Vector3, now: Vector3) -> f32 {
        let distance = |step: i32| shape.nearest(before + (now - before) * (step as f32 / 2000.0)).unwrap().0;
        (0..=2000).map(distance).fold(f32::INFINITY, f32::min)
    }

    #[test]
    fn a_ball_whose_centre_came_in_through_the_top_leaves_there() {
        // 2 from the left side, 18 below the top: by distance alone it would leave on the left.
        let (before, now) = (Vector3::new(-38.0, -60.0, 30.0), Vector3::new(-38.0, -22.0, 30.0));
        let touch = LEVEL.ball_touch(now, before, 5.0, None).unwrap();
        assert_eq!(touch.normal, Vector3::new(0.0, -1.0, 0.0));
        assert_eq!(touch.separation, -23.0);
        assert_eq!(touch.face, Some(Face::Top));
        assert_eq!(touch.point, Vector3::new(-38.0, -17.0, 30.0));
        let next = LEVEL.ball_touch(now, now, 5.0, touch.face).unwrap();
        assert_eq!(next, touch);
    }

    #[test]
    fn a_ball_at_rest_inside_leaves_through_the_nearest_face() {
        let centre = Vector3::new(-38.0, -22.0, 30.0);
        assert_eq!(LEVEL.ball_touch(centre, centre, 5.0, None).unwrap().face, Some(Face::Left));
    }

    #[test]
    fn a_ball_outside_keeps_no_face() {
        let touch = LEVEL
            .ball_touch(Vector3::new(0.0, -43.0, 30.0), Vector3::zeros(), 5.0, Some(Face::Left))
            .unwrap();
        assert_eq!((touch.separation, touch.face), (-2.0, None));
    }

    #[test]
    fn a_ball_that_only_touches_does_not_overlap() {
        assert_eq!(LEVEL.ball_touch(Vector3::new(0.0, -45.0, 30.0), Vector3::zeros(), 5.0, None), None);
    }

    #[test]
    fn the_top_on_a_vertical_line_is_where_a_march_down_first_gets_inside() {
        let mut numbers = Numbers(5);
        let mut hits = 0;
        for round in 0..1000 {
            let shape = numbers.shape(round);
            let over = shape.centre + numbers.vector(40.0);
            let (low, high) = shape.bounds();
            let at =
                |step: i32| Vector3::new(over.x, low.y + (high.y - low.y) * (step as f32 / 2000.0), over.z);
            let first = (0..=2000).find(|&step| shape.contains(at(step)));
            match (first, shape.height_at(over.x, over.z)) {
                (Some(step), Some((y, normal))) => {
                    hits += 1;
                    assert!((y - at(step).y).abs() <= (high.y - low.y) / 2000.0 + 1e-3);
                    let (distance, nearest) = shape.nearest(Vector3::new(over.x, y - 1e-2, over.z)).unwrap();
                    // Its normal, except within a hundredth of an edge.
                    assert!(normal.dot(&nearest) > 0.99 || distance < 1e-2);
                    assert!(normal.y < 0.0);
                }
                (None, None) => {}
                (None, Some((y, _))) => {
                    // Only a corner that is thinner than a step.
                    assert!(!shape.contains(Vector3::new(over.x, y + (high.y - low.y) / 1000.0, over.z)));
                }
                (Some(_), None) => panic!("{shape:?} {over:?}"),
            }
        }
        assert!(hits > 300);
    }

    #[test]
    fn a_line_beside_the_box_has_no_top() {
        assert_eq!(LEVEL.height_at(61.0, 30.0), None);
        assert_eq!(LEVEL.height_at(0.0, 46.0), None);
    }

    #[test]
    fn what_is_not_finite_touches_nothing() {
        for point in [Vector3::new(f32::NAN, 0.0, 0.0), Vector3::new(f32::INFINITY, 0.0, 0.0)] {
            for shape in [LEVEL, SlantedBox { shear: 0.5, ..LEVEL }, SlantedBox::default()] {
                assert_eq!(shape.nearest(point), None);
                assert_eq!(shape.ball_touch(point, point, 5.0, None), None);
                assert_eq!(shape.height_at(point.x, point.z), None);
            }
        }
    }

    #[test]
    fn a_box_without_size_is_a_point() {
        let (distance, normal) = SlantedBox::default().nearest(Vector3::new(3.0, 0.0, 4.0)).unwrap();
        assert!((distance - 5.0).abs() < 1e-6);
        assert!((normal - Vector3::new(0.6, 0.0, 0.8)).norm() < 1e-6);
        assert!(SlantedBox::default().nearest(Vector3::zeros()).is_some());
    }
}
