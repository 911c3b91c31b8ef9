//! Where a figure with a round end stands: what a ball touches that is let down.

use farseer_core::SpaceFoot;

use crate::Vector3;
use crate::shapes::{Face, SlantedBox, Top};

/// Sides that look up by less than this are upright.
const LEVEL: f32 = 1e-6;

/// A ball above a place of X and Z.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ball {
    pub(super) radius: f32,
    pub(super) at: [f32; 2],
}

/// How something holds a ball that is let down on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rest {
    /// Of the lowest point of the ball.
    pub(super) height: f32,
    /// The direction in which it is held, Y up.
    pub(super) normal: Vector3,
    /// How high the edge is on which it lies; of a face, none.
    pub(super) edge: Option<f32>,
}

impl Ball {
    pub(super) fn on_box(&self, shape: &SlantedBox) -> Option<Rest> {
        let corners = shape.corners().map(|corner| Vector3::new(corner.x, -corner.y, corner.z));
        // Of the front face, which begins with the left end of the top.
        let sides = [(Face::Top, 0, 1), (Face::Right, 1, 2), (Face::Bottom, 2, 3), (Face::Left, 3, 0)];
        let rests = sides.into_iter().flat_map(|(face, one, other)| {
            let [a, b, c, d] = [one, other, other + 4, one + 4].map(|at| corners[at]);
            let normal = shape.face_normal(face);
            let out = Vector3::new(normal.x, -normal.y, normal.z);
            [self.on_face([a, b, c, d], out), self.on_edge(a, b), self.on_edge(b, c), self.on_edge(c, d)]
        });
        rests.flatten().reduce(higher)
    }

    /// On a prism that has these tops.
    pub(super) fn on_tops(&self, tops: &[Top]) -> Option<Rest> {
        tops.iter().filter_map(|top| self.on_top(top)).reduce(higher)
    }

    fn on_top(&self, top: &Top) -> Option<Rest> {
        let [a, b] = top.edge;
        if let Some((upright, place)) = &top.upright {
            let way = [place[0] - self.at[0], place[1] - self.at[1]];
            let (apart, to) =
                crate::depth::upright::with_foot(upright, |foot| SpaceFoot::Disc(0.0).gap(foot, way));
            return self.on_level(-a.y, apart, [-to[0], -to[1]]);
        }
        let corner = |x: f32, y: f32, z: f32| Vector3::new(x, -y, z);
        let corners = [
            corner(a.x, a.y, top.front),
            corner(b.x, b.y, top.front),
            corner(b.x, b.y, top.back),
            corner(a.x, a.y, top.back),
        ];
        let way = b - a;
        let out = Vector3::new(-way.y, -way.x, 0.0) / way.norm();
        let edges = (0..4).map(|at| self.on_edge(corners[at], corners[(at + 1) % 4]));
        edges.chain([self.on_face(corners, out)]).flatten().reduce(higher)
    }

    /// On something level of a height, outside of which its middle is by so much, in a direction.
    fn on_level(&self, height: f32, apart: f32, out: [f32; 2]) -> Option<Rest> {
        if apart <= 0.0 {
            return Some(Rest { height, normal: Vector3::y(), edge: None });
        }
        self.on_point([apart * out[0], apart * out[1]], height)
    }

    /// On a point of a height, past which its middle is by so much along X and Z.
    fn on_point(&self, [x, z]: [f32; 2], height: f32) -> Option<Rest> {
        let squared = self.radius * self.radius - x * x - z * z;
        (squared > 0.0).then(|| {
            let above = squared.sqrt();
            let normal = Vector3::new(x, above, z) / self.radius;
            Rest { height: height + above - self.radius, normal, edge: Some(height) }
        })
    }

    /// Inside of a face, whose corners go round it.
    fn on_face(&self, corners: [Vector3; 4], out: Vector3) -> Option<Rest> {
        if out.y.is_nan() || out.y <= LEVEL {
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
            Rest { height: touched - self.radius * (1.0 - out.y), normal: out, edge: None }
        })
    }

    fn on_edge(&self, start: Vector3, end: Vector3) -> Option<Rest> {
        let way = [end.x - start.x, end.z - start.z];
        let from = [self.at[0] - start.x, self.at[1] - start.z];
        let length = (way[0] * way[0] + way[1] * way[1]).sqrt();
        if length.is_nan() || length <= LEVEL {
            let height = if start.y > end.y { start.y } else { end.y };
            return self.on_point(from, height);
        }
        let along = (from[0] * way[0] + from[1] * way[1]) / length;
        let aside = (from[0] * way[1] - from[1] * way[0]) / length;
        let left = self.radius * self.radius - aside * aside;
        if left.is_nan() || left <= 0.0 {
            return None;
        }
        // Where the ball touches a line that climbs so, or at its nearer end.
        let climb = (end.y - start.y) / length;
        let touched = along + left.sqrt() * climb / (1.0 + climb * climb).sqrt();
        let touched = touched.clamp(0.0, length);
        let past = [0, 1].map(|axis| from[axis] - touched * (way[axis] / length));
        self.on_point(past, start.y + climb * touched)
    }
}

fn higher(one: Rest, other: Rest) -> Rest {
    if other.height > one.height { other } else { one }
}

#[cfg(test)]
mod tests {
    use super::{Ball, Rest};
    use crate::Vector3;
    use crate::shapes::SlantedBox;

    /// A level box whose top is 0 and whose right side is X = 0.
    fn block() -> SlantedBox {
        let centre = Vector3::new(-50.0, 20.0, 0.0);
        SlantedBox { centre, half: [50.0, 20.0, 80.0], ..SlantedBox::default() }
    }

    #[test]
    fn over_a_level_top_its_lowest_point_is_on_it() {
        let ball = Ball { radius: 5.0, at: [-20.0, 30.0] };
        assert_eq!(ball.on_box(&block()), Some(Rest { height: 0.0, normal: Vector3::y(), edge: None }));
    }

    #[test]
    fn past_an_edge_it_sinks_by_its_roundness_until_it_is_past_it() {
        let rest = Ball { radius: 5.0, at: [3.0, 0.0] }.on_box(&block()).unwrap();
        // A triangle of 3, 4 and 5.
        assert!(
            (rest.height + 1.0).abs() < 1e-6 && (rest.normal - Vector3::new(0.6, 0.8, 0.0)).norm() < 1e-6,
            "{rest:?}"
        );
        assert_eq!(rest.edge, Some(0.0));
        assert_eq!(Ball { radius: 5.0, at: [5.1, 0.0] }.on_box(&block()), None);
    }

    #[test]
    fn past_a_corner_its_distance_counts() {
        let rest = Ball { radius: 13.0, at: [3.0, 84.0] }.on_box(&block()).unwrap();
        assert!((rest.height - (12.0 - 13.0)).abs() < 1e-5, "{rest:?}");
    }

    #[test]
    fn on_a_slope_its_lowest_point_is_as_far_above_that_as_it_is_round() {
        let (sin, cos) = 0.5f32.sin_cos();
        let shape = SlantedBox { half: [200.0, 20.0, 80.0], cos, sin, ..SlantedBox::default() };
        let (top, _) = shape.height_at(10.0, 5.0).unwrap();
        let rest = Ball { radius: 15.0, at: [10.0, 5.0] }.on_box(&shape).unwrap();
        assert!((rest.height - (15.0 / cos - 15.0 - top)).abs() < 1e-4 && (rest.normal.y - cos).abs() < 1e-6);
    }

    /// It touches, and overlaps nothing: by the distance to the box of the middle of the ball.
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
                let ball = Ball { radius: 15.0, at };
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
