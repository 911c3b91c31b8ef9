//! What the polygon of a geom stands for. Not in the original, whose circles are polygons and nothing else.

use serde::{Deserialize, Serialize};

use crate::math::Vector2;

/// What the polygon of a geom stands for. The [faithful methods](crate::Methods::Faithful) go by the polygon alone, its
/// box included.
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
    /// For itself.
    #[default]
    Polygon,
    /// For the circle about the geom's origin that its corners lie on: what
    /// [`GeomFactory::create_circle_geom`](crate::GeomFactory::create_circle_geom) makes, with as many corners as the
    /// circle was given edges.
    Circle {
        /// In the user's length unit, greater than 0.
        radius: f32,
    },
    /// For the capsule that its corners lie on, upright about the geom's origin: two half discs with straight sides
    /// between them. What [`GeomFactory::create_capsule_geom`](crate::GeomFactory::create_capsule_geom) makes.
    Capsule {
        /// From tip to tip along y, in the user's length unit; more than twice the radius.
        height: f32,
        /// Of its round ends, in the user's length unit, greater than 0.
        end_radius: f32,
    },
    /// For the edges between its points and nothing else: what
    /// [`GeomFactory::create_chain_geom`](crate::GeomFactory::create_chain_geom) makes. It has no inside, and its points are
    /// in the order in which they were given.
    Chain {
        /// Whether an edge goes from the last point to the first.
        is_closed: bool,
    },
}

/// How far corners may be from their circle, as a part of its radius: sine, cosine and two products are rounded, each by
/// half of this at most.
const ROUNDING: f64 = 2.0 * f32::EPSILON as f64;

impl Outline {
    /// Whether these can be its corners: false only after loading garbage.
    pub(crate) fn fits(self, corners: &[Vector2]) -> bool {
        match self {
            Outline::Polygon => true,
            Outline::Circle { radius } => are_around([0.0; 2], radius, corners),
            Outline::Capsule { height, end_radius } => {
                let half = half_of_capsule(height, end_radius);
                height.is_finite() && half >= 0.0 && are_around([-half, half], end_radius, corners)
            }
            Outline::Chain { is_closed } => {
                let is_edge = |edge: &[Vector2]| edge[0] != edge[1];
                let least = if is_closed { 3 } else { 2 };
                corners.len() >= least
                    && corners.windows(2).all(is_edge)
                    && !(is_closed && corners[0] == corners[corners.len() - 1])
            }
        }
    }

    pub(crate) fn is_chain(self) -> bool {
        matches!(self, Outline::Chain { .. })
    }

    /// Whether no edge goes from the last corner to the first.
    pub(crate) fn is_open(self) -> bool {
        matches!(self, Outline::Chain { is_closed: false })
    }
}

/// From the middle of a capsule to the centre of either of its ends.
pub(crate) fn half_of_capsule(height: f32, end_radius: f32) -> f32 {
    (height - end_radius - end_radius) * 0.5
}

/// Whether corners are as far as a radius from what lies on the y axis between two places.
fn are_around([low, high]: [f32; 2], radius: f32, corners: &[Vector2]) -> bool {
    // The smallest numbers are rounded by more than a part of them.
    let slack = (f64::from(radius) + f64::from(high)) * ROUNDING + f64::from(f32::MIN_POSITIVE);
    let is_on = |corner: &Vector2| {
        let beyond = f64::from(corner.y) - f64::from(corner.y.clamp(low, high));
        (f64::from(corner.x).hypot(beyond) - f64::from(radius)).abs() <= slack
    };
    radius.is_finite() && radius > 0.0 && corners.iter().all(is_on)
}
