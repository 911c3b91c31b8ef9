//! Outlines of common shapes about the origin (behaviour chapter 05, section 1.7).
//!
//! Rectangles, circles, ellipses and gears are in engine winding. Capsules are not; a geom made from one reverses the
//! list. Sizes may be negative or zero where the original accepts that, but not NaN or infinite.

use super::Vertices;
use super::vertices::MAX_VERTICES;
use crate::error::{Error, Result};
use crate::math::finite::{finite, positive};
use crate::math::{Vector2, math_helper, scalar};

impl Vertices {
    /// A rectangle of 16 vertices, every edge divided in four.
    ///
    /// # Errors
    /// When a size is not finite.
    #[doc(alias = "CreateRectangle")]
    pub fn create_rectangle(width: f32, height: f32) -> Result<Vertices> {
        let (w2, w4) = (finite("width", width)? * 0.5, width * 0.25);
        let (h2, h4) = (finite("height", height)? * 0.5, height * 0.25);
        #[rustfmt::skip]
        let outline = [
            (-w2, -h2), (-w2, -h4), (-w2, 0.0), (-w2, h4),
            (-w2, h2), (-w4, h2), (0.0, h2), (w4, h2),
            (w2, h2), (w2, h4), (w2, 0.0), (w2, -h4),
            (w2, -h2), (w4, -h2), (0.0, -h2), (-w4, -h2),
        ];
        Ok(outline.into_iter().map(|(x, y)| Vector2::new(x, y)).collect())
    }

    /// A rectangle of 4 vertices.
    ///
    /// # Errors
    /// When a size is not finite.
    #[doc(alias = "CreateSimpleRectangle")]
    pub fn create_simple_rectangle(width: f32, height: f32) -> Result<Vertices> {
        let w2 = finite("width", width)? * 0.5;
        let h2 = finite("height", height)? * 0.5;
        let outline = [(-w2, -h2), (-w2, h2), (w2, h2), (w2, -h2)];
        Ok(outline.into_iter().map(|(x, y)| Vector2::new(x, y)).collect())
    }

    /// A regular polygon with its corners on a circle; see [`Vertices::create_ellipse`].
    ///
    /// # Errors
    /// When the radius is not finite, or for more edges than [`MAX_VERTICES`].
    ///
    /// ```
    /// use farseer_core::math::Vector2;
    /// use farseer_core::shape::Vertices;
    /// let circle = Vertices::create_circle(10.0, 8)?;
    /// assert_eq!(circle.len(), 8);
    /// assert_eq!(circle[0], Vector2::new(10.0, 0.0));
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    #[doc(alias = "CreateCircle")]
    pub fn create_circle(radius: f32, number_of_edges: i32) -> Result<Vertices> {
        finite("radius", radius)?;
        Vertices::create_ellipse(radius, radius, number_of_edges)
    }

    /// A polygon with its corners on an ellipse, the first one at `(x_radius, 0)`. With one edge, none or a
    /// negative number of them the first corner is the only one.
    ///
    /// # Errors
    /// When a radius is not finite, or for more edges than [`MAX_VERTICES`].
    #[doc(alias = "CreateEllipse")]
    pub fn create_ellipse(x_radius: f32, y_radius: f32, number_of_edges: i32) -> Result<Vertices> {
        finite("x_radius", x_radius)?;
        finite("y_radius", y_radius)?;
        let count = vertex_count("number_of_edges", number_of_edges, 1)?;
        let step = math_helper::TWO_PI / number_of_edges as f32;
        let mut outline = Vertices::with_capacity(count.max(1));
        outline.push(Vector2::new(x_radius, 0.0));
        for i in 1..count {
            let (sin, cos) = scalar::sin_cos(step * i as f32);
            outline.push(Vector2::new(x_radius * cos, -y_radius * sin));
        }
        Ok(outline)
    }

    /// A gear wheel of four vertices per tooth. `tip_percentage`, 0 to 1, is the fraction of half a tooth's angle that
    /// its tip takes; `tooth_height` is added to `radius`. No teeth or a negative number of them give an empty list.
    ///
    /// # Errors
    /// When a size is not finite, or for more vertices than [`MAX_VERTICES`].
    #[doc(alias = "CreateGear")]
    pub fn create_gear(
        radius: f32,
        number_of_teeth: i32,
        tip_percentage: f32,
        tooth_height: f32,
    ) -> Result<Vertices> {
        finite("radius", radius)?;
        finite("tip_percentage", tip_percentage)?;
        finite("tooth_height", tooth_height)?;
        let teeth = vertex_count("number_of_teeth", number_of_teeth, 4)?;
        let step = math_helper::TWO_PI / number_of_teeth as f32;
        let tip = step / 2.0 * tip_percentage;
        let flank = (step - tip * 2.0) / 2.0;
        let outer = radius + tooth_height;

        let corner = |radius: f32, angle: f32| {
            let (sin, cos) = scalar::sin_cos(angle);
            Vector2::new(radius * cos, -radius * sin)
        };
        let mut outline = Vertices::with_capacity(4 * teeth);
        for i in 0..teeth {
            let base = step * i as f32;
            outline.push(corner(radius, base));
            outline.push(corner(outer, base + flank));
            outline.push(corner(outer, base + flank + tip));
            outline.push(corner(radius, base + flank * 2.0 + tip));
        }
        Ok(outline)
    }

    /// An upright capsule with equal ends of `edges` edges each; see [`Vertices::create_capsule_ends`].
    ///
    /// # Errors
    /// When `end_radius` is not less than half of `height`, a size is not finite and greater than 0, or there
    /// are no edges or too many.
    #[doc(alias = "CreateCapsule")]
    pub fn create_capsule(height: f32, end_radius: f32, edges: i32) -> Result<Vertices> {
        finite("height", height)?;
        less_than_half("end_radius", finite("end_radius", end_radius)?, height)?;
        positive("height", height)?;
        positive("end_radius", end_radius)?;
        at_least_one("edges", edges)?;
        Vertices::create_capsule_ends(height, end_radius, edges, end_radius, edges)
    }

    /// An upright capsule with different ends: half circles of `top_edges` and `bottom_edges` edges, joined by straight
    /// sides. The result has `top_edges + bottom_edges + 2` vertices and positive shoelace area; "top" is the end with
    /// the greater y, which is the lower one on a screen.
    ///
    /// # Errors
    /// When a size is not finite and greater than 0, a radius is not less than half of `height`, or an end
    /// has no edges or more than [`MAX_VERTICES`].
    #[doc(alias = "CreateCapsule")]
    pub fn create_capsule_ends(
        height: f32,
        top_radius: f32,
        top_edges: i32,
        bottom_radius: f32,
        bottom_edges: i32,
    ) -> Result<Vertices> {
        positive("height", height)?;
        positive("top_radius", top_radius)?;
        let top_count = at_least_one("top_edges", top_edges)?;
        positive("bottom_radius", bottom_radius)?;
        let bottom_count = at_least_one("bottom_edges", bottom_edges)?;
        less_than_half("top_radius", top_radius, height)?;
        less_than_half("bottom_radius", bottom_radius, height)?;

        let half = (height - top_radius - bottom_radius) * 0.5;
        let mut outline = Vertices::with_capacity(top_count + bottom_count + 2);
        outline.push(Vector2::new(top_radius, half));
        let step = math_helper::PI / top_edges as f32;
        for i in 1..top_count {
            let (sin, cos) = scalar::sin_cos(step * i as f32);
            outline.push(Vector2::new(top_radius * cos, top_radius * sin + half));
        }
        outline.push(Vector2::new(-top_radius, half));
        outline.push(Vector2::new(-bottom_radius, -half));
        let step = math_helper::PI / bottom_edges as f32;
        for i in 1..bottom_count {
            let (sin, cos) = scalar::sin_cos(step * i as f32);
            outline.push(Vector2::new(-bottom_radius * cos, -bottom_radius * sin - half));
        }
        outline.push(Vector2::new(bottom_radius, -half));
        Ok(outline)
    }
}

/// The number of elements to make, 0 for a negative one, if as many with `each` vertices are within [`MAX_VERTICES`].
fn vertex_count(argument: &'static str, count: i32, each: usize) -> Result<usize> {
    let wanted = usize::try_from(count).unwrap_or(0);
    if wanted <= MAX_VERTICES / each {
        Ok(wanted)
    } else {
        Err(Error::invalid(argument, count, "small enough for 2^24 vertices"))
    }
}

/// Refuses numbers of edges with which a capsule's end cannot be made.
fn at_least_one(argument: &'static str, edges: i32) -> Result<usize> {
    if edges > 0 {
        vertex_count(argument, edges, 1)
    } else {
        Err(Error::invalid(argument, edges, "1 or more"))
    }
}

/// Refuses an end of a capsule that is too large for its height.
fn less_than_half(argument: &'static str, radius: f32, height: f32) -> Result<()> {
    if radius >= height / 2.0 {
        Err(Error::invalid(argument, radius, "less than half of the height"))
    } else {
        Ok(())
    }
}
