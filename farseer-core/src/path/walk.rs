//! Where the bodies of a path lie (behaviour chapter 14, section 6).

use super::{Curve, CurveKey, CurveTangent};
use crate::math::Vector2;
use crate::math::vector2::distance;
use crate::shape::Vertices;
use crate::{Error, Result};

/// Part of the path from one look to the next.
const STEP: f32 = f32::from_bits(0x3A03_126F);

/// From here on the curve stays at the last control point, whatever the number of points.
const BEYOND_THE_END: f32 = 2.0;

/// The bodies of a path.
pub(super) struct Row {
    /// Positions, and rotations in radians.
    pub(super) places: Vec<(Vector2, f32)>,
    /// The last point that was looked at: the last control point becomes this one.
    pub(super) end: Vector2,
}

/// Goes along the curve through control points and puts a body down after every link width.
///
/// The body's direction is that of its neighbourhood, which reaches to a point one link farther on. Where the path ends
/// before that point is reached it is the one of the body before, as in the original.
pub(super) fn walk(control_points: &[Vector2], link_width: f32) -> Result<Row> {
    let Some(&first) = control_points.first() else {
        return Err(Error::invalid("control_points", 0, "a list of at least one point"));
    };
    if link_width <= 0.0 {
        return Err(Error::invalid("link_width", link_width, "greater than 0: the walk would never end"));
    }
    let mut walk = Walk::along(control_points)?;
    let mut here = walk.until_away_from(first, link_width / 2.0, link_width)?;
    let mut ahead = walk.until_away_from(first, link_width, link_width)?;
    let mut row = Row { places: vec![(here, direction(first, here, ahead))], end: ahead };
    let mut before = here;
    while walk.parameter < 1.0 {
        here = walk.on_from(before, link_width, here)?;
        ahead = walk.on_from(here, link_width, ahead)?;
        row.places.push((here, direction(before, here, ahead)));
        before = here;
    }
    row.end = ahead;
    Ok(row)
}

fn direction(before: Vector2, here: Vector2, ahead: Vector2) -> f32 {
    Vertices::find_normal_angle(Vertices::find_vertex_normal(before, here, ahead))
}

struct Walk {
    x: Curve,
    y: Curve,
    parameter: f32,
}

impl Walk {
    fn along(control_points: &[Vector2]) -> Result<Self> {
        let mut walk = Walk { x: Curve::new(), y: Curve::new(), parameter: 0.0 };
        let increment = 1.0 / control_points.len() as f32;
        for (index, point) in control_points.iter().enumerate() {
            let parameter = increment * (index + 1) as f32;
            walk.x.keys_mut().add(CurveKey::new(parameter, point.x)?);
            walk.y.keys_mut().add(CurveKey::new(parameter, point.y)?);
        }
        walk.x.compute_tangents(CurveTangent::Smooth);
        walk.y.compute_tangents(CurveTangent::Smooth);
        Ok(walk)
    }

    fn step(&mut self) -> Result<Vector2> {
        self.parameter += STEP;
        let point = Vector2::new(self.x.evaluate(self.parameter)?, self.y.evaluate(self.parameter)?);
        if !(point.x.is_finite() && point.y.is_finite()) {
            let value = (point.x, point.y);
            return Err(Error::invalid(
                "control_points",
                value,
                "near enough to each other for a finite curve",
            ));
        }
        Ok(point)
    }

    /// Goes on until a point is far enough away, beyond the end of the path if need be.
    fn until_away_from(&mut self, from: Vector2, wanted: f32, link_width: f32) -> Result<Vector2> {
        let mut point = from;
        let mut reached = 0.0;
        while reached < wanted {
            if self.parameter > BEYOND_THE_END {
                let requirement = "short enough for the path: the walk would never end";
                return Err(Error::invalid("link_width", link_width, requirement));
            }
            point = self.step()?;
            reached = distance(from, point);
        }
        Ok(point)
    }

    /// Goes on until a point is far enough away or the path ends. `stale` is the point if it has ended already.
    fn on_from(&mut self, from: Vector2, wanted: f32, stale: Vector2) -> Result<Vector2> {
        let mut point = stale;
        let mut reached = 0.0;
        while reached < wanted && self.parameter < 1.0 {
            point = self.step()?;
            reached = distance(point, from);
        }
        Ok(point)
    }
}
