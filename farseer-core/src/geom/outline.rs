//! The shape for which the polygon of a geom stands. Not in the original, whose circles are polygons and no more.

use serde::{Deserialize, Serialize};

use super::rounded;
use crate::math::Vector2;

/// The shape for which the polygon of a geom stands. The [faithful methods](crate::Methods::Faithful) use the polygon
/// alone, also for the box.
///
/// ```
/// use farseer_core::{Body, GeomFactory, GeomPlacement, Outline, PhysicsSimulator};
/// let mut simulator = PhysicsSimulator::default();
/// let body = simulator.create_body(Body::new());
/// let ball = GeomFactory::create_circle_geom_in(&mut simulator, body, 10.0, 16, GeomPlacement::default())?;
/// let geom = simulator.geom(ball).unwrap();
/// assert_eq!((geom.outline(), geom.local_vertices().len()), (Outline::Circle { radius: 10.0 }, 16));
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Outline {
    /// The polygon itself.
    #[default]
    Polygon,
    /// The circle about the geom's origin on which the corners lie.
    /// [`GeomFactory::create_circle_geom`](crate::GeomFactory::create_circle_geom) makes it, with as many corners as
    /// the circle was given edges.
    Circle {
        /// Radius in length units, greater than 0.
        radius: f32,
    },
    /// The capsule on which the corners lie, upright about the geom's origin: two half discs with straight sides
    /// between them. [`GeomFactory::create_capsule_geom`](crate::GeomFactory::create_capsule_geom) makes it.
    Capsule {
        /// From tip to tip along y, in length units; more than twice the radius.
        height: f32,
        /// Radius of its round ends, in length units, greater than 0.
        end_radius: f32,
    },
    /// The rounded polygon about which the corners lie: all points within `radius` of a convex polygon.
    /// [`GeomBuilder::rounded_polygon`](crate::GeomBuilder::rounded_polygon) makes it.
    RoundedPolygon {
        /// Distance of the border from the convex polygon, in length units, greater than 0.
        radius: f32,
    },
    /// A chain like [`Chain`](Outline::Chain), whose edges are solid on both sides.
    /// [`GeomBuilder::two_sided_chain`](crate::GeomBuilder::two_sided_chain) makes it.
    TwoSidedChain {
        /// Whether an edge goes from the last point to the first.
        is_closed: bool,
    },
    /// A chain: the edges between the points, without an inside.
    /// [`GeomFactory::create_chain_geom`](crate::GeomFactory::create_chain_geom) makes it. Its points are in the order
    /// in which they were given.
    Chain {
        /// Whether an edge goes from the last point to the first.
        is_closed: bool,
    },
}

/// Maximum distance of corners from their circle, as a fraction of its radius. Sine, cosine and two products are
/// rounded, each by half of this at most.
const CORNER_TOLERANCE: f64 = 2.0 * f32::EPSILON as f64;

impl Outline {
    /// Whether the polygon's corners lie on this shape. False only after loading corrupt data.
    pub(crate) fn fits(self, corners: &[Vector2]) -> bool {
        match self {
            Outline::Polygon => true,
            Outline::Circle { radius } => lie_at_radius([0.0; 2], radius, corners),
            Outline::Capsule { height, end_radius } => {
                let half = capsule_half_axis(height, end_radius);
                height.is_finite() && half >= 0.0 && lie_at_radius([-half, half], end_radius, corners)
            }
            Outline::RoundedPolygon { radius } => rounded::fits(corners, radius),
            Outline::Chain { is_closed } | Outline::TwoSidedChain { is_closed } => {
                let is_edge = |edge: &[Vector2]| edge[0] != edge[1];
                let least = if is_closed { 3 } else { 2 };
                corners.len() >= least
                    && corners.windows(2).all(is_edge)
                    && !(is_closed && corners[0] == corners[corners.len() - 1])
            }
        }
    }

    pub(crate) fn is_chain(self) -> bool {
        matches!(self, Outline::Chain { .. } | Outline::TwoSidedChain { .. })
    }

    /// Whether the shape is a chain whose edges are solid on one side.
    pub(crate) fn is_one_sided(self) -> bool {
        matches!(self, Outline::Chain { .. })
    }

    /// Whether no edge goes from the last corner to the first.
    pub(crate) fn is_open(self) -> bool {
        matches!(self, Outline::Chain { is_closed: false } | Outline::TwoSidedChain { is_closed: false })
    }
}

/// Half of the distance between the centres of a capsule's ends, in length units.
pub(crate) fn capsule_half_axis(height: f32, end_radius: f32) -> f32 {
    (height - end_radius - end_radius) * 0.5
}

/// Whether all corners have the distance `radius` from the segment of the y axis between `low` and `high`.
fn lie_at_radius([low, high]: [f32; 2], radius: f32, corners: &[Vector2]) -> bool {
    // Subnormal numbers are rounded by more than a fraction of their value.
    let slack = (f64::from(radius) + f64::from(high)) * CORNER_TOLERANCE + f64::from(f32::MIN_POSITIVE);
    let is_on = |corner: &Vector2| {
        let beyond = f64::from(corner.y) - f64::from(corner.y.clamp(low, high));
        (f64::from(corner.x).hypot(beyond) - f64::from(radius)).abs() <= slack
    };
    is_size(radius) && corners.iter().all(is_on)
}

/// Whether a number is a possible radius, in length units.
pub(super) fn is_size(radius: f32) -> bool {
    radius.is_finite() && radius > 0.0
}
