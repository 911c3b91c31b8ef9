//! Ground of a capsule: the height and normal at which its lower hemisphere rests on boxes and prisms.

use farseer_precise::depth::shape_distance::DepthQueryFootprint;

use crate::Vector3;
use crate::shapes::{Face, SlantedBox, WalkableTop};

/// Least upward component of the normal of a face that supports, dimensionless; also the least length of an
/// edge seen from above, px.
const MIN_FACE_UP: f32 = 1e-6;

/// The lower hemisphere of a capsule as a sphere: radius in px, centre (X, Z) in px.
#[derive(Debug, Clone, Copy)]
pub(super) struct EndSphere {
    pub(super) radius: f32,
    pub(super) at: [f32; 2],
}

/// Resting pose of the lower hemisphere of a capsule that is lowered onto a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CapsuleRest {
    /// Height of the lowest point of the sphere, px, Y up.
    pub(super) height: f32,
    /// Unit contact normal towards the sphere, Y up.
    pub(super) normal: Vector3,
    /// Height of the edge or vertex that supports the sphere, px, Y up; `None` on a face.
    pub(super) edge: Option<f32>,
}

impl EndSphere {
    pub(super) fn on_box(&self, shape: &SlantedBox) -> Option<CapsuleRest> {
        let corners = shape.corners().map(|corner| Vector3::new(corner.x, -corner.y, corner.z));
        // Corners of the front face, from the left end of the top.
        let sides = [(Face::Top, 0, 1), (Face::Right, 1, 2), (Face::Bottom, 2, 3), (Face::Left, 3, 0)];
        let rests = sides.into_iter().flat_map(|(face, one, other)| {
            let [a, b, c, d] = [one, other, other + 4, one + 4].map(|at| corners[at]);
            let normal = shape.face_normal(face);
            let out = Vector3::new(normal.x, -normal.y, normal.z);
            [self.on_face([a, b, c, d], out), self.on_edge(a, b), self.on_edge(b, c), self.on_edge(c, d)]
        });
        rests.flatten().reduce(higher)
    }

    /// Returns the resting pose on a prism, given by its walkable edges; `None` if the sphere misses all of them.
    pub(super) fn on_tops(&self, tops: &[WalkableTop]) -> Option<CapsuleRest> {
        tops.iter().filter_map(|top| self.on_top(top)).reduce(higher)
    }

    fn on_top(&self, top: &WalkableTop) -> Option<CapsuleRest> {
        let [a, b] = top.edge;
        if let Some((upright, place)) = &top.upright {
            let offset = [place[0] - self.at[0], place[1] - self.at[1]];
            let (apart, to) = crate::depth::upright::with_foot(upright, |foot| {
                DepthQueryFootprint::Disc(0.0).distance_to(foot, offset)
            });
            return self.on_level(-a.y, apart, [-to[0], -to[1]]);
        }
        let corner = |x: f32, y: f32, z: f32| Vector3::new(x, -y, z);
        let corners = [
            corner(a.x, a.y, top.front),
            corner(b.x, b.y, top.front),
            corner(b.x, b.y, top.back),
            corner(a.x, a.y, top.back),
        ];
        let offset = b - a;
        let out = Vector3::new(-offset.y, -offset.x, 0.0) / offset.norm();
        let edges = (0..4).map(|at| self.on_edge(corners[at], corners[(at + 1) % 4]));
        edges.chain([self.on_face(corners, out)]).flatten().reduce(higher)
    }

    /// Returns the resting pose on a level face at `height`, px; `None` if the sphere misses the face. `apart` is the distance
    /// of the sphere's centre outside of the face, seen from above, px. `out` is the unit direction (X, Z) from the face to the
    /// centre.
    fn on_level(&self, height: f32, apart: f32, out: [f32; 2]) -> Option<CapsuleRest> {
        if apart <= 0.0 {
            return Some(CapsuleRest { height, normal: Vector3::y(), edge: None });
        }
        self.on_point([apart * out[0], apart * out[1]], height)
    }

    /// Returns the resting pose on a vertex or a point of an edge at `height`, px; `None` if the sphere misses the point. `[x,
    /// z]` is the offset of the sphere's centre from the point, px.
    fn on_point(&self, [x, z]: [f32; 2], height: f32) -> Option<CapsuleRest> {
        let squared = self.radius * self.radius - x * x - z * z;
        (squared > 0.0).then(|| {
            let above = squared.sqrt();
            let normal = Vector3::new(x, above, z) / self.radius;
            CapsuleRest { height: height + above - self.radius, normal, edge: Some(height) }
        })
    }

    /// Returns the resting pose on the inside of a face; `None` if the face does not look up or the sphere touches no point
    /// inside of it. `corners` are the vertices of the face in order (world, px), `out` is the outward unit normal of the face.
    fn on_face(&self, corners: [Vector3; 4], out: Vector3) -> Option<CapsuleRest> {
        if out.y.is_nan() || out.y <= MIN_FACE_UP {
            return None;
        }
        let at = [self.at[0] - self.radius * out.x, self.at[1] - self.radius * out.z];
        let side = |start: Vector3, end: Vector3| {
            (end.x - start.x) * (at[1] - start.z) - (end.z - start.z) * (at[0] - start.x)
        };
        let sides: [f32; 4] = std::array::from_fn(|edge| side(corners[edge], corners[(edge + 1) % 4]));
        let is_inside = sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0);
        is_inside.then(|| {
            let from = corners[0];
            let touched = from.y - ((at[0] - from.x) * out.x + (at[1] - from.z) * out.z) / out.y;
            CapsuleRest { height: touched - self.radius * (1.0 - out.y), normal: out, edge: None }
        })
    }

    fn on_edge(&self, start: Vector3, end: Vector3) -> Option<CapsuleRest> {
        let offset = [end.x - start.x, end.z - start.z];
        let from = [self.at[0] - start.x, self.at[1] - start.z];
        let length = (offset[0] * offset[0] + offset[1] * offset[1]).sqrt();
        if length.is_nan() || length <= MIN_FACE_UP {
            let height = if start.y > end.y { start.y } else { end.y };
            return self.on_point(from, height);
        }
        let along = (from[0] * offset[0] + from[1] * offset[1]) / length;
        let aside = (from[0] * offset[1] - from[1] * offset[0]) / length;
        let left = self.radius * self.radius - aside * aside;
        if left.is_nan() || left <= 0.0 {
            return None;
        }
        // Contact of the sphere with the sloped line through the edge, clamped to the nearer end.
        let climb = (end.y - start.y) / length;
        let touched = along + left.sqrt() * climb / (1.0 + climb * climb).sqrt();
        let touched = touched.clamp(0.0, length);
        let past = [0, 1].map(|axis| from[axis] - touched * (offset[axis] / length));
        self.on_point(past, start.y + climb * touched)
    }
}

fn higher(one: CapsuleRest, other: CapsuleRest) -> CapsuleRest {
    if other.height > one.height { other } else { one }
}

#[cfg(test)]
mod tests {
    use super::{CapsuleRest, EndSphere};
    use crate::Vector3;
    use crate::shapes::SlantedBox;

    /// A level box whose top is 0 and whose right side is X = 0.
    fn block() -> SlantedBox {
        let centre = Vector3::new(-50.0, 20.0, 0.0);
        SlantedBox { centre, half: [50.0, 20.0, 80.0], ..SlantedBox::default() }
    }

    #[test]
    fn over_a_level_top_its_lowest_point_is_on_it() {
        let ball = EndSphere { radius: 5.0, at: [-20.0, 30.0] };
        assert_eq!(
            ball.on_box(&block()),
            Some(CapsuleRest { height: 0.0, normal: Vector3::y(), edge: None })
        );
    }

    #[test]
    fn past_an_edge_it_sinks_by_its_roundness_until_it_is_past_it() {
        let rest = EndSphere { radius: 5.0, at: [3.0, 0.0] }.on_box(&block()).unwrap();
        // A triangle of 3, 4 and 5.
        assert!(
            (rest.height + 1.0).abs() < 1e-6 && (rest.normal - Vector3::new(0.6, 0.8, 0.0)).norm() < 1e-6,
            "{rest:?}"
        );
        assert_eq!(rest.edge, Some(0.0));
        assert_eq!(EndSphere { radius: 5.0, at: [5.1, 0.0] }.on_box(&block()), None);
    }

    #[test]
    fn past_a_corner_its_distance_counts() {
        let rest = EndSphere { radius: 13.0, at: [3.0, 84.0] }.on_box(&block()).unwrap();
        assert!((rest.height - (12.0 - 13.0)).abs() < 1e-5, "{rest:?}");
    }

    #[test]
    fn on_a_slope_its_lowest_point_is_as_far_above_that_as_it_is_round() {
        let (sin, cos) = 0.5f32.sin_cos();
        let shape = SlantedBox { half: [200.0, 20.0, 80.0], cos, sin, ..SlantedBox::default() };
        let (top, _) = shape.height_at(10.0, 5.0).unwrap();
        let rest = EndSphere { radius: 15.0, at: [10.0, 5.0] }.on_box(&shape).unwrap();
        assert!((rest.height - (15.0 / cos - 15.0 - top)).abs() < 1e-4 && (rest.normal.y - cos).abs() < 1e-6);
    }

    /// At rest the centre of the sphere is one radius away from the box: the sphere touches and does not overlap.
    #[test]
    fn wherever_it_rests_it_is_as_far_from_the_box_as_its_radius() {
        let (sin, cos) = (-0.4f32).sin_cos();
        let (turned, turn) = 0.7f32.sin_cos();
        let half = [60.0, 20.0, 40.0];
        let leaning = SlantedBox { half, cos, sin, shear: 0.3, ..SlantedBox::default() };
        let climbing = SlantedBox { half, climb: 0.5, turn: [turn, turned], ..SlantedBox::default() };
        let mut seen = 0;
        // Rounding of numbers up to 100: 1.1e-5 px and 1.2e-6 were the most.
        for shape in [block(), leaning, climbing] {
            for at in (-12..=12).flat_map(|x| (-12..=12).map(move |z| [7.0 * x as f32, 7.0 * z as f32])) {
                let ball = EndSphere { radius: 15.0, at };
                let Some(rest) = ball.on_box(&shape) else { continue };
                let middle = Vector3::new(at[0], -(rest.height + 15.0), at[1]);
                let (apart, normal) = shape.nearest(middle).unwrap();
                assert!((apart - 15.0).abs() < 3e-5, "{shape:?} {at:?} {rest:?}: {apart}");
                let normal = Vector3::new(normal.x, -normal.y, normal.z);
                assert!((normal - rest.normal).norm() < 3e-6, "{shape:?} {at:?} {rest:?}: {normal}");
                seen += 1;
            }
        }
        assert!(seen > 500, "{seen}");
    }
}
