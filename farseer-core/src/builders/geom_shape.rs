//! Shapes of geoms that a builder describes, and their areas.

use super::mass::MassProperties;
use crate::geom::outline::Outline;
use crate::geom::rounded::{checked_core, mass_of_border, outline_of};
use crate::math::Vector2;
use crate::math::finite::{finite, finite_vertices, positive};
use crate::methods::Methods;
use crate::shape::Vertices;
use crate::{BodyFactory, Error, Result};

/// Number of edges of the polygon that stands for a circle in the faithful set and in views, a count.
const CIRCLE_EDGES: i32 = 16;
/// Number of edges of the polygon at each end of a capsule, a count.
const CAPSULE_EDGES: i32 = 8;

/// A shape in the coordinates of its geom, in length units.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum GeomShape {
    /// About its middle.
    Rectangle {
        /// Length units, > 0.
        width: f32,
        /// Length units, > 0.
        height: f32,
    },
    /// About its middle.
    Circle {
        /// Length units, > 0.
        radius: f32,
    },
    /// Upright about its middle.
    Capsule {
        /// From tip to tip, length units, > 0.
        height: f32,
        /// Length units, > 0, less than half of the height.
        end_radius: f32,
    },
    /// Corners in either direction.
    Polygon {
        /// Length units.
        corners: Vec<Vector2>,
    },
    /// All points within a distance of a convex polygon; corners in either direction.
    RoundedPolygon {
        /// Length units.
        corners: Vec<Vector2>,
        /// Length units, > 0.
        radius: f32,
    },
    /// Edges between points, solid on one side.
    Chain {
        /// Length units.
        points: Vec<Vector2>,
    },
    /// Edges between points, solid on both sides.
    TwoSidedChain {
        /// Length units.
        points: Vec<Vector2>,
    },
    /// A chain from left to right through heights at equal distances, solid below.
    HeightField {
        /// Heights above the geom's origin, length units.
        heights: Vec<f32>,
        /// Distance of two heights along x, length units, > 0.
        spacing: f32,
    },
}

impl GeomShape {
    /// Refuses a shape that the methods do not have.
    pub(crate) fn check(&self, methods: Methods) -> Result<()> {
        match self {
            GeomShape::Chain { .. } => methods.only_precise("chains"),
            GeomShape::TwoSidedChain { .. } => methods.only_precise("two-sided chains"),
            GeomShape::HeightField { .. } => methods.only_precise("height fields"),
            GeomShape::RoundedPolygon { .. } => methods.only_precise("rounded polygons"),
            _ => Ok(()),
        }
    }

    /// Returns the polygon with the shape that it stands for.
    ///
    /// # Errors
    /// A size that is not finite and greater than 0; corners without an area; points that make no chain.
    pub(crate) fn outline(&self) -> Result<(Vertices, Outline)> {
        match self {
            &GeomShape::Rectangle { width, height } => {
                positive("width", width)?;
                positive("height", height)?;
                Ok((Vertices::create_rectangle(width, height)?, Outline::Polygon))
            }
            &GeomShape::Circle { radius } => {
                positive("radius", radius)?;
                Ok((Vertices::create_circle(radius, CIRCLE_EDGES)?, Outline::Circle { radius }))
            }
            &GeomShape::Capsule { height, end_radius } => {
                let corners = Vertices::create_capsule(height, end_radius, CAPSULE_EDGES)?;
                Ok((corners, Outline::Capsule { height, end_radius }))
            }
            GeomShape::Polygon { corners } => {
                check_polygon(corners)?;
                Ok((Vertices::from(corners.as_slice()), Outline::Polygon))
            }
            GeomShape::RoundedPolygon { corners, radius } => {
                let core = checked_core(corners, *radius)?;
                Ok((outline_of(&core, *radius), Outline::RoundedPolygon { radius: *radius }))
            }
            GeomShape::Chain { points } => {
                let (points, is_closed) = crate::factories::check_chain(points)?;
                Ok((Vertices::from(points), Outline::Chain { is_closed }))
            }
            GeomShape::TwoSidedChain { points } => {
                let (points, is_closed) = crate::factories::check_chain(points)?;
                Ok((Vertices::from(points), Outline::TwoSidedChain { is_closed }))
            }
            GeomShape::HeightField { heights, spacing } => {
                Ok((height_field(heights, *spacing)?.into(), Outline::Chain { is_closed: false }))
            }
        }
    }

    /// Returns how a given mass is spread over the shape: the area, or the edges of a chain that may be on a moving body.
    ///
    /// # Errors
    /// As [`of_density_1`](Self::of_density_1).
    pub(crate) fn spread(&self) -> Result<MassProperties> {
        match self {
            GeomShape::TwoSidedChain { points } => of_rods(points),
            _ => self.of_density_1(),
        }
    }

    /// Returns the mass properties with mass 1 per square length unit. A chain has none.
    ///
    /// # Errors
    /// A size for which the area or the moment of inertia is not finite.
    pub(crate) fn of_density_1(&self) -> Result<MassProperties> {
        match self {
            &GeomShape::Rectangle { width, height } => {
                let body = BodyFactory::create_rectangle_body(width, height, 1.0)?;
                Ok(about_middle(f64::from(width) * f64::from(height), body.moment_of_inertia()))
            }
            &GeomShape::Circle { radius } => {
                let body = BodyFactory::create_circle_body(radius, 1.0)?;
                let area = std::f64::consts::PI * f64::from(radius) * f64::from(radius);
                Ok(about_middle(area, body.moment_of_inertia()))
            }
            &GeomShape::Capsule { height, end_radius } => {
                let body = BodyFactory::create_capsule_body(height, end_radius, 1.0)?;
                let (height, radius) = (f64::from(height), f64::from(end_radius));
                let area = (std::f64::consts::PI * radius + 2.0 * (height - 2.0 * radius)) * radius;
                Ok(about_middle(area, body.moment_of_inertia()))
            }
            GeomShape::Polygon { corners } => {
                check_polygon(corners)?;
                let [area, x, y, inertia] = area_and_moments(corners);
                Ok(MassProperties {
                    mass: area,
                    centre: [x / area, y / area],
                    inertia: inertia - (x * x + y * y) / area,
                })
            }
            GeomShape::RoundedPolygon { corners, radius } => {
                let core = checked_core(corners, *radius)?;
                let mut parts = mass_of_border(&core, *radius);
                let corners = core.iter().map(|&[x, y]| Vector2::new(x, y)).collect();
                parts.push(GeomShape::Polygon { corners }.of_density_1()?);
                Ok(MassProperties::sum(&parts))
            }
            GeomShape::Chain { .. } | GeomShape::TwoSidedChain { .. } | GeomShape::HeightField { .. } => {
                Ok(MassProperties::default())
            }
        }
    }
}

/// Returns the mass properties of a chain of thin rods with mass 1 per length unit. `points` in length units.
fn of_rods(points: &[Vector2]) -> Result<MassProperties> {
    let (points, is_closed) = crate::factories::check_chain(points)?;
    let following = points.iter().cycle().skip(1);
    let count = points.len() - usize::from(!is_closed);
    let rods = points.iter().zip(following).take(count).map(|(&from, &to)| {
        let (x, y) = (f64::from(to.x) - f64::from(from.x), f64::from(to.y) - f64::from(from.y));
        let mass = libm::hypot(x, y);
        let centre = [f64::from(from.x) + 0.5 * x, f64::from(from.y) + 0.5 * y];
        MassProperties { mass, centre, inertia: mass * mass * mass / 12.0 }
    });
    Ok(MassProperties::sum(&rods.collect::<Vec<_>>()))
}

/// Returns the points of a height field about its middle.
fn height_field(heights: &[f32], spacing: f32) -> Result<Vec<Vector2>> {
    positive("spacing", spacing)?;
    heights.iter().try_for_each(|&height| finite("heights", height).map(drop))?;
    if heights.len() < 2 {
        return Err(Error::invalid(
            "heights",
            format_args!("a list of {}", heights.len()),
            "two numbers or more",
        ));
    }
    let middle = 0.5 * (heights.len() - 1) as f64;
    let x = |at: usize| ((at as f64 - middle) * f64::from(spacing)) as f32;
    let points: Vec<Vector2> =
        heights.iter().enumerate().map(|(at, &height)| Vector2::new(x(at), -height)).collect();
    finite_vertices("spacing", &points)?;
    Ok(points)
}

/// Refuses corners that are not finite or enclose no area.
fn check_polygon(corners: &[Vector2]) -> Result<()> {
    finite_vertices("corners", corners)?;
    let area = area_and_moments(corners)[0];
    if corners.len() < 3 || area == 0.0 || !area.is_finite() {
        return Err(Error::invalid("corners", corners, "three or more, around an area"));
    }
    Ok(())
}

/// Returns the mass properties of an area about the origin. `inertia`: moment of inertia of mass 1, length units².
fn about_middle(area: f64, inertia: f32) -> MassProperties {
    MassProperties { mass: area, centre: [0.0; 2], inertia: area * f64::from(inertia) }
}

/// Returns the area of a polygon, its first moments in x and y, and its second moment about the origin, in powers of length
/// units. Each edge makes a triangle with the first corner, as in Box2D 3 (E. Catto, `b2ComputePolygonMass`).
fn area_and_moments(corners: &[Vector2]) -> [f64; 4] {
    let Some(&first) = corners.first() else { return [0.0; 4] };
    let origin = [f64::from(first.x), f64::from(first.y)];
    let from_origin = |corner: &Vector2| [f64::from(corner.x) - origin[0], f64::from(corner.y) - origin[1]];
    let mut sums = [0.0; 4];
    for edge in corners.windows(2) {
        let ([ax, ay], [bx, by]) = (from_origin(&edge[0]), from_origin(&edge[1]));
        let doubled = ax * by - ay * bx;
        let second = ax * ax + ax * bx + bx * bx + ay * ay + ay * by + by * by;
        let parts =
            [doubled / 2.0, doubled * (ax + bx) / 6.0, doubled * (ay + by) / 6.0, doubled * second / 12.0];
        (0..4).for_each(|at| sums[at] += parts[at]);
    }
    let sign = if sums[0] < 0.0 { -1.0 } else { 1.0 };
    let [area, x, y, second] = sums.map(|sum| sum * sign);
    let [left, top] = origin;
    let moved = second + 2.0 * (left * x + top * y) + area * (left * left + top * top);
    [area, x + area * left, y + area * top, moved]
}
