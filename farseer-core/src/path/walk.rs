//! Poses of the bodies of a path (behaviour chapter 14, section 6).

use super::{Curve, CurveKey, CurveTangent};
use crate::math::Vector2;
use crate::math::vector2::distance;
use crate::shape::Vertices;
use crate::{Error, Result};

/// Step of the curve's parameter from one evaluated point to the next, dimensionless; 1 is the whole path. Farseer's
/// value.
const PARAMETER_STEP: f32 = f32::from_bits(0x3A03_126F);

/// Parameter, dimensionless, from which on the curve stays at the last control point, whatever the number of points.
const MAX_PARAMETER: f32 = 2.0;

/// The poses of the bodies of a path.
pub(super) struct BodyPlacement {
    /// Positions in length units, and rotations in radians.
    pub(super) poses: Vec<(Vector2, f32)>,
    /// The last point that was evaluated: it replaces the last control point.
    pub(super) end: Vector2,
}

/// Walks along the curve through control points and places a body after every link width.
///
/// A body has the direction of the curve's neighbourhood, up to a point one link farther on. If the path ends before
/// that point, it has the direction of the body before, as in the original.
pub(super) fn place_bodies(control_points: &[Vector2], link_width: f32) -> Result<BodyPlacement> {
    let Some(&first) = control_points.first() else {
        return Err(Error::invalid("control_points", 0, "a list of at least one point"));
    };
    if link_width <= 0.0 {
        return Err(Error::invalid("link_width", link_width, "greater than 0: the walk would never end"));
    }
    let mut walk = CurveWalk::along(control_points)?;
    let mut here = walk.until_away_from(first, link_width / 2.0, link_width)?;
    let mut ahead = walk.until_away_from(first, link_width, link_width)?;
    let mut row = BodyPlacement { poses: vec![(here, direction(first, here, ahead))], end: ahead };
    let mut before = here;
    while walk.parameter < 1.0 {
        here = walk.until_away_or_end(before, link_width, here)?;
        ahead = walk.until_away_or_end(here, link_width, ahead)?;
        row.poses.push((here, direction(before, here, ahead)));
        before = here;
    }
    row.end = ahead;
    Ok(row)
}

fn direction(before: Vector2, here: Vector2, ahead: Vector2) -> f32 {
    Vertices::find_normal_angle(Vertices::find_vertex_normal(before, here, ahead))
}

struct CurveWalk {
    x: Curve,
    y: Curve,
    parameter: f32,
}

impl CurveWalk {
    fn along(control_points: &[Vector2]) -> Result<Self> {
        let mut walk = CurveWalk { x: Curve::new(), y: Curve::new(), parameter: 0.0 };
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
        self.parameter += PARAMETER_STEP;
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

    /// Walks until a point is far enough away from `from`, beyond the end of the path if necessary.
    fn until_away_from(&mut self, from: Vector2, wanted: f32, link_width: f32) -> Result<Vector2> {
        let mut point = from;
        let mut reached = 0.0;
        while reached < wanted {
            if self.parameter > MAX_PARAMETER {
                let requirement = "short enough for the path: the walk would never end";
                return Err(Error::invalid("link_width", link_width, requirement));
            }
            point = self.step()?;
            reached = distance(from, point);
        }
        Ok(point)
    }

    /// Walks until a point is far enough away from `from` or the path ends. Returns `stale` if it has ended already.
    fn until_away_or_end(&mut self, from: Vector2, wanted: f32, stale: Vector2) -> Result<Vector2> {
        let mut point = stale;
        let mut reached = 0.0;
        while reached < wanted && self.parameter < 1.0 {
            point = self.step()?;
            reached = distance(point, from);
        }
        Ok(point)
    }
}
