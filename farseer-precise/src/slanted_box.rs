//! Shape of a platform: a box, tilted about the z axis and sheared along x and y with depth.
//!
//! Coordinates are those of the plane: x right, y **down**, z into the picture. A point of the box has three local
//! coordinates: `across` and `down` in the tilted rectangle and `deep` along z, each within the half sizes. At depth
//! `deep` from the centre the rectangle is shifted by `shear * deep` in x and by `climb * deep` up.
//!
//! The result is a parallelepiped whose front and back are perpendicular to z. Its sides have the normals
//! `(nx, ny, climb * ny - shear * nx)`, not yet of unit length.
//!
//! Finally the parallelepiped may be turned about the upright axis through the centre.
//!
//! The closest point minimises the squared distance, which is convex and piecewise quadratic in `deep`. Segments are
//! clipped by the half-spaces of the faces (Cyrus and Beck, 1978).

use crate::math::{Vector2, Vector3, scalar};
use serde::{Deserialize, Serialize};

/// A box tilted about z and sheared along x and y.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SlantedBox {
    /// Centre of the box, in length units.
    pub centre: Vector3,
    /// Half of width, height and depth, in length units.
    pub half: [f32; 3],
    /// Cosine of the tilt, which is clockwise on the screen.
    pub cos: f32,
    /// Sine of the tilt.
    pub sin: f32,
    /// Shift in x per unit of depth from the centre, dimensionless ratio.
    pub shear: f32,
    /// Rise, against y, per unit of depth from the centre, dimensionless ratio.
    pub climb: f32,
    /// Cosine and sine of the final turn about the upright axis through the centre, from x to z.
    pub turn: [f32; 2],
}

/// Cosine and sine of no turn.
const NO_TURN: [f32; 2] = [1.0, 0.0];

impl Default for SlantedBox {
    fn default() -> Self {
        SlantedBox {
            centre: Vector3::zeros(),
            half: [0.0; 3],
            cos: 1.0,
            sin: 0.0,
            shear: 0.0,
            climb: 0.0,
            turn: NO_TURN,
        }
    }
}

/// A face of the box, named by its direction when the box is level. The first four are in the order of the outline's
/// edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Face {
    /// Toward smaller y.
    Top,
    /// Toward smaller x.
    Left,
    /// Toward greater y.
    Bottom,
    /// Toward greater x.
    Right,
    /// Toward smaller z.
    Front,
    /// Toward greater z.
    Back,
}

impl Face {
    /// The sides, in the order of the outline's edges.
    pub const SIDES: [Face; 4] = [Face::Top, Face::Left, Face::Bottom, Face::Right];
    const ALL: [Face; 6] = [Face::Top, Face::Left, Face::Bottom, Face::Right, Face::Front, Face::Back];
}

/// Contact of a ball with the box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoxTouch {
    /// Unit vector from the box to the ball.
    pub normal: Vector3,
    /// Distance of ball and box, in length units; negative when they overlap.
    pub separation: f32,
    /// Contact point on the ball's surface.
    pub point: Vector3,
    /// The face through which the ball is pushed out, while its centre is inside.
    pub face: Option<Face>,
}

/// The coordinate clamped to the half size.
fn clamp_to_half(coordinate: f32, half: f32) -> f32 {
    scalar::min(scalar::max(coordinate, -half), half)
}

/// Signed distance of a coordinate beyond the half size, in length units; 0 within.
fn overshoot(coordinate: f32, half: f32) -> f32 {
    coordinate - clamp_to_half(coordinate, half)
}

/// Effects of depth.
impl SlantedBox {
    /// Whether the edges through the depth are not parallel to z.
    pub fn is_sheared(&self) -> bool {
        self.shear != 0.0 || self.climb != 0.0
    }

    /// Shift of the rectangle at a depth from the centre, relative to its position at the centre.
    pub fn shift(&self, deep: f32) -> Vector3 {
        Vector3::new(self.shear * deep, -self.climb * deep, 0.0)
    }

    /// Whether the box is turned about the upright axis.
    pub fn is_turned(&self) -> bool {
        self.turn != NO_TURN
    }

    /// A point relative to the centre, in coordinates that turn with the box.
    fn offset(&self, point: Vector3) -> Vector3 {
        self.turned_by(-1.0, point - self.centre)
    }

    /// Rotates from coordinates that turn with the box to the world with `sign` 1, or back with -1.
    fn turned_by(&self, sign: f32, v: Vector3) -> Vector3 {
        if !self.is_turned() {
            return v;
        }
        let [cos, sin] = [self.turn[0], sign * self.turn[1]];
        Vector3::new(cos * v.x - sin * v.z, v.y, sin * v.x + cos * v.z)
    }

    /// Rate at which a side with this normal in the plane advances with depth, dimensionless ratio.
    pub fn lean(&self, [x, y]: [f32; 2]) -> f32 {
        // Without climb the result keeps the sign of zero that shear alone has.
        if self.climb == 0.0 { self.shear * x } else { self.shear * x - self.climb * y }
    }
}

/// Closest point queries.
impl SlantedBox {
    /// Signed distance of a point from the surface, in length units, negative inside, and its unit gradient. `None` if
    /// not finite.
    pub fn nearest(&self, point: Vector3) -> Option<(f32, Vector3)> {
        let offset = self.offset(point);
        let [width, height, depth] = self.half;
        if self.contains(point) {
            let face = self.nearest_face(point);
            return Some((self.distance_to_face(face, point), self.face_normal(face)));
        }
        let deep = self.closest_deep(offset);
        let (across, down) = self.local(offset, deep);
        let excess_across = overshoot(across, width);
        let excess_down = overshoot(down, height);
        let is_inner = deep > -depth && deep < depth;
        // Next to one face only, its normal is known without dividing by a distance that may be tiny.
        let face = match (excess_across, excess_down) {
            // On the surface, up to rounding.
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
        (distance > 0.0 && distance.is_finite()).then(|| (distance, self.turned_by(1.0, away / distance)))
    }

    /// Depth, relative to the centre, of the point of the box that is closest to a point outside.
    fn closest_deep(&self, offset: Vector3) -> f32 {
        let [width, height, depth] = self.half;
        if !self.is_sheared() {
            return clamp_to_half(offset.z, depth);
        }
        // Rates at which the local coordinates of the point change with `deep`.
        let (across_rate, down_rate) =
            (-self.shear * self.cos + self.climb * self.sin, self.shear * self.sin + self.climb * self.cos);
        let (across, down) = self.local(offset, 0.0);
        // Half the derivative of the squared distance: increasing, and linear between the depths at which a coordinate
        // passes the edge of the rectangle.
        let slope = |deep: f32| {
            let (across, down) = (across + across_rate * deep, down + down_rate * deep);
            let excess_across = overshoot(across, width);
            let excess_down = overshoot(down, height);
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
            // Bends outside of the range, and those that are infinite or NaN, are skipped.
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
        scalar::min(scalar::max(low + (high - low) * share, low), high)
    }

    /// The contact of a ball. `before` is its centre in the last step, relative to the box. While the centre is inside,
    /// the ball is pushed out through the face `kept`, else through the one by which it entered, else through the
    /// nearest.
    pub fn ball_touch(
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
    pub fn plane_normal(&self, face: Face) -> Vector2 {
        let SlantedBox { cos, sin, .. } = *self;
        match face {
            Face::Top => Vector2::new(sin, -cos),
            Face::Left => Vector2::new(-cos, -sin),
            Face::Bottom => Vector2::new(-sin, cos),
            Face::Right => Vector2::new(cos, sin),
            Face::Front | Face::Back => Vector2::zeros(),
        }
    }

    /// Length of a side's normal before it is normalised, dimensionless.
    pub fn stretch(&self, plane_normal: Vector2) -> f32 {
        let lean = self.lean([plane_normal.x, plane_normal.y]);
        (1.0 + lean * lean).sqrt()
    }

    /// Outward unit normal of a face.
    pub fn face_normal(&self, face: Face) -> Vector3 {
        let normal = match face {
            Face::Front => Vector3::new(0.0, 0.0, -1.0),
            Face::Back => Vector3::new(0.0, 0.0, 1.0),
            _ => {
                let normal = self.plane_normal(face);
                let stretch = self.stretch(normal);
                let lean = self.lean([normal.x, normal.y]);
                Vector3::new(normal.x / stretch, normal.y / stretch, -lean / stretch)
            }
        };
        self.turned_by(1.0, normal)
    }

    /// Signed distance of a point from the plane of a face, in length units, positive outside.
    pub fn distance_to_face(&self, face: Face, point: Vector3) -> f32 {
        let offset = self.offset(point);
        let [width, height, depth] = self.half;
        let half = match face {
            Face::Front => return -offset.z - depth,
            Face::Back => return offset.z - depth,
            Face::Left | Face::Right => width,
            Face::Top | Face::Bottom => height,
        };
        let normal = self.plane_normal(face);
        let (x, y) = (offset.x - self.shear * offset.z, offset.y + self.climb * offset.z);
        (normal.x * x + normal.y * y - half) / self.stretch(normal)
    }

    /// The face whose plane is nearest to a point inside; the first one of several.
    pub fn nearest_face(&self, point: Vector3) -> Face {
        let mut nearest = (Face::Top, self.distance_to_face(Face::Top, point));
        for face in Face::ALL {
            let distance = self.distance_to_face(face, point);
            if distance > nearest.1 {
                nearest = (face, distance);
            }
        }
        nearest.0
    }

    /// The face through which the segment from `before` to `now` enters the box; `None` if it begins inside or misses
    /// it.
    pub fn entry_face(&self, before: Vector3, now: Vector3) -> Option<Face> {
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
                exit = scalar::min(exit, share);
            }
        }
        entry.0.filter(|_| entry.1 <= exit)
    }
}

/// Outlines and extents.
impl SlantedBox {
    /// A vector of the rectangle, rotated into the plane.
    fn tilted(&self, across: f32, down: f32) -> Vector2 {
        Vector2::new(across * self.cos - down * self.sin, across * self.sin + down * self.cos)
    }

    /// Coordinates, in the rectangle at depth `deep`, of a point given relative to the centre.
    fn local(&self, offset: Vector3, deep: f32) -> (f32, f32) {
        let (x, y) = (offset.x - self.shear * deep, offset.y + self.climb * deep);
        (x * self.cos + y * self.sin, y * self.cos - x * self.sin)
    }

    /// Whether a point is inside or on the surface.
    pub fn contains(&self, point: Vector3) -> bool {
        let offset = self.offset(point);
        let [width, height, depth] = self.half;
        let (across, down) = self.local(offset, offset.z);
        offset.z.abs() <= depth && across.abs() <= width && down.abs() <= height
    }

    /// The corners of the box's level section as seen from above, relative to the centre: x and z.
    pub fn footprint(&self) -> [[f32; 2]; 4] {
        let [width, _, depth] = self.half;
        [(-width, -depth), (width, -depth), (width, depth), (-width, depth)].map(|(x, z)| {
            let corner = self.turned_by(1.0, Vector3::new(x, 0.0, z));
            [corner.x, corner.z]
        })
    }

    /// The eight corners, from the top left one clockwise as seen with y down. The four corners of the front face, with
    /// smaller z before the turn, come first, then those of the back face.
    pub fn corners(&self) -> [Vector3; 8] {
        let [right, left, low_left, low_right] = self.rectangle();
        let outline = [left, right, low_right, low_left];
        std::array::from_fn(|at| {
            let deep = if at < 4 { -self.half[2] } else { self.half[2] };
            let corner = Vector3::new(outline[at % 4].x, outline[at % 4].y, deep) + self.shift(deep);
            self.centre + self.turned_by(1.0, corner)
        })
    }

    /// The rectangle about the origin, wound as the engine's outlines: from the top right corner to the left.
    pub fn rectangle(&self) -> [Vector2; 4] {
        let [width, height, _] = self.half;
        [(width, -height), (-width, -height), (-width, height), (width, height)]
            .map(|(across, down)| self.tilted(across, down))
    }

    /// The corners with the smallest and the greatest coordinates.
    pub fn bounds(&self) -> (Vector3, Vector3) {
        let [width, height, depth] = self.half;
        let (cos, sin) = (self.cos.abs(), self.sin.abs());
        let x = width * cos + height * sin + self.shear.abs() * depth;
        let y = width * sin + height * cos + self.climb.abs() * depth;
        let [c, s] = self.turn.map(f32::abs);
        let reach = if self.is_turned() {
            Vector3::new(c * x + s * depth, y, s * x + c * depth)
        } else {
            Vector3::new(x, y, depth)
        };
        (self.centre - reach, self.centre + reach)
    }

    /// The y of the topmost point on the vertical line at `x` and `z`, and the normal of the face there. `None` if the
    /// line misses the box.
    pub fn height_at(&self, x: f32, z: f32) -> Option<(f32, Vector3)> {
        let [width, height, depth] = self.half;
        let at = self.offset(Vector3::new(x, self.centre.y, z));
        let (x, deep) = (at.x, at.z);
        let reaches = deep.abs() <= depth;
        if !reaches {
            return None;
        }
        let x = x - self.shear * deep;
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
            bottom = scalar::min(bottom, high);
        }
        (top <= bottom && top.is_finite())
            .then(|| (self.centre.y + top - self.climb * deep, self.face_normal(face)))
    }
}
