//! Facets: flat pieces of surfaces that cast and receive the shadows of platforms.

use twohalf::{BodyId, Drawable, TwoHalfGeom, TwoHalfPhysicsSimulator, Vector3};

use crate::Point;
use crate::clip::clip_to_convex;
use crate::footprint::of_top;
use crate::surface::{Face, to_screen};

/// Greatest penetration of a resting object, px.
const MAX_RESTING_PENETRATION: f32 = 2.0;
/// Least Y of the unit normal of a facet that receives shadows, dimensionless.
const MIN_NORMAL_Y: f32 = 0.1;

/// A convex piece of a plane.
pub(super) struct Facet {
    /// The object that it is a piece of.
    pub(super) of: Drawable,
    pub(super) corners: Vec<Vector3>,
    normal: Vector3,
}

impl Facet {
    fn of_platform(of: Drawable, corners: &[Vector3; 8], face: Face) -> Self {
        Facet { of, corners: face.corners(corners).to_vec(), normal: face.normal(corners).normalize() }
    }

    /// The face of a platform with the most downward normal.
    pub(super) fn underside(of: Drawable, corners: &[Vector3; 8]) -> Self {
        let faces = Face::ALL.map(|face| Facet::of_platform(of, corners, face));
        let lowest = faces.into_iter().min_by(|a, b| a.normal.y.total_cmp(&b.normal.y));
        lowest.unwrap_or_else(|| Facet::of_platform(of, corners, Face::Underside))
    }

    /// Faces of a platform whose normals point up.
    pub(super) fn looking_up(of: Drawable, corners: &[Vector3; 8]) -> impl Iterator<Item = Self> {
        let faces = Face::ALL.map(|face| Facet::of_platform(of, corners, face));
        faces.into_iter().filter(|facet| facet.normal.y > MIN_NORMAL_Y)
    }

    /// The level top of a geom of a body.
    pub(super) fn top(body: BodyId, geom: &TwoHalfGeom<'_>) -> Self {
        let height = geom.virtual_geom().top;
        let corners = of_top(geom).into_iter().map(|[x, z]| Vector3::new(x, height, z));
        Facet { of: Drawable::Body(body), corners: corners.collect(), normal: Vector3::y() }
    }

    fn height_at(&self, [x, z]: Point) -> f32 {
        let corner = self.corners[0];
        corner.y - (self.normal.x * (x - corner.x) + self.normal.z * (z - corner.z)) / self.normal.y
    }

    fn footprint(&self) -> Vec<Point> {
        self.corners.iter().map(|corner| [corner.x, corner.z]).collect()
    }

    /// The part of it in the shadow of a facet above it, on the screen, and the height of its middle, px;
    /// `None` without shadow.
    pub(super) fn shaded_by(
        &self,
        above: &Facet,
        simulator: &TwoHalfPhysicsSimulator,
    ) -> Option<(Vec<Point>, f32)> {
        let shaded = clip_to_convex(&above.footprint(), &self.footprint());
        let share = 1.0 / shaded.len() as f32;
        let middle = [0, 1].map(|axis| shaded.iter().map(|point| point[axis] * share).sum());
        let height = self.height_at(middle);
        let is_beneath = height <= above.height_at(middle) + MAX_RESTING_PENETRATION;
        let on_it = |[x, z]: Point| to_screen(simulator, Vector3::new(x, self.height_at([x, z]), z));
        (!shaded.is_empty() && is_beneath).then(|| (shaded.into_iter().map(on_it).collect(), height))
    }
}
