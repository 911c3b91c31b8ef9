//! Explosions and radial forces.

use super::convex::{self, Convex, Point, dot, minus, plus, point, scaled, vector};
use super::{QueryFilter, finite, world_shape};
use crate::Result;
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::math::Vector2;
use crate::math::finite::zero_or_more;
use crate::shape::Aabb;
use crate::simulator::PhysicsSimulator;

/// A push away from a point: see [`explode`](PhysicsSimulator::explode) and
/// [`apply_radial_force`](PhysicsSimulator::apply_radial_force). The model is that of Box2D 3 (E. Catto, `b2World_Explode`).
#[derive(Debug, Clone, Copy)]
pub struct Explosion<'a> {
    /// The middle, in the world, in length units.
    pub position: Vector2,
    /// Distance of a geom up to which the strength is full, in length units, 0 or more.
    pub radius: f32,
    /// Distance beyond the radius over which the strength falls to 0 evenly, in length units, 0 or more.
    pub falloff: f32,
    /// Impulse, or force, per length unit of the width that a geom turns to the middle: in mass units/s, or mass units/s². A
    /// negative number pulls.
    pub strength: f32,
    /// Geoms that are pushed; only those of dynamic bodies are.
    pub filter: QueryFilter<'a>,
}

impl Default for Explosion<'_> {
    /// Without extent and strength, for all geoms.
    fn default() -> Self {
        let position = Vector2::zeros();
        Explosion { position, radius: 0.0, falloff: 0.0, strength: 0.0, filter: QueryFilter::default() }
    }
}

/// A push on a body.
struct Push {
    body: BodyId,
    /// Impulse or force.
    amount: Vector2,
    /// World point at which it acts, in length units.
    at: Vector2,
}

impl PhysicsSimulator {
    /// Pushes all dynamic bodies near a point away from it, by impulses. They act at the nearest points of their geoms, so that
    /// bodies turn, and wake. Walls give no shelter: let [`accepts`](QueryFilter::accepts) test the line of sight. Returns the
    /// number of pushed geoms.
    ///
    /// ```
    /// use farseer_core::{BodyBuilder, Explosion, GeomBuilder, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::precise([0.0, 0.0])?;
    /// let (crate_, _) = simulator.add_body(BodyBuilder::dynamic().position([60.0, 0.0]), [GeomBuilder::rectangle(32.0, 32.0)])?;
    /// simulator.update(1.0 / 60.0);
    /// let bomb = Explosion { radius: 100.0, falloff: 50.0, strength: 5.0, ..Explosion::default() };
    /// assert_eq!(simulator.explode(&bomb)?, 1);
    /// simulator.update(1.0 / 60.0);
    /// // Mass 1, width 32.
    /// assert!((simulator[crate_].linear_velocity().x - 160.0).abs() < 0.01);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// A number that is not finite; a radius or falloff less than 0.
    pub fn explode(&mut self, explosion: &Explosion<'_>) -> Result<usize> {
        let pushes = self.pushes(explosion)?;
        for &Push { body, amount, at } in &pushes {
            self[body].apply_impulse_at_world_point(amount, at);
        }
        Ok(pushes.len())
    }

    /// Pushes all dynamic bodies near a point away from it, by forces that act over the next update: call it before each update
    /// for a fan or, with a negative strength, a magnet. Returns the number of pushed geoms.
    ///
    /// # Errors
    /// As [`explode`](Self::explode).
    pub fn apply_radial_force(&mut self, explosion: &Explosion<'_>) -> Result<usize> {
        let pushes = self.pushes(explosion)?;
        for &Push { body, amount, at } in &pushes {
            self[body].apply_force_at_world_point(amount, at);
        }
        Ok(pushes.len())
    }

    fn pushes(&self, explosion: &Explosion<'_>) -> Result<Vec<Push>> {
        let &Explosion { position, radius, falloff, strength, ref filter } = explosion;
        let position = finite("position", position)?;
        let reach = zero_or_more("radius", radius)? + zero_or_more("falloff", falloff)?;
        crate::math::finite::finite("strength", strength)?;
        let around = Vector2::new(reach, reach);
        let filter = QueryFilter { fixed: false, kinematic: false, ..*filter };
        let near = self.admitted(&Aabb::new(position - around, position + around), &filter, |_| true);
        Ok(near.into_iter().filter_map(|geom| self.push_on(geom, explosion)).collect())
    }

    /// The push on a geom; `None` out of reach.
    fn push_on(&self, geom: GeomId, explosion: &Explosion<'_>) -> Option<Push> {
        let &Explosion { position, radius, falloff, strength, .. } = explosion;
        let closest = world_shape::nearest(self, geom, &Convex::point(position))?;
        let beyond = closest.distance - f64::from(radius);
        let share = match beyond <= 0.0 {
            true => 1.0,
            false => 1.0 - beyond / f64::from(falloff),
        };
        if share.is_nan() || share <= 0.0 {
            return None;
        }
        let pieces: Vec<Convex> = world_shape::pieces_of(self, geom).collect();
        let (at, direction) = match closest.distance > 0.0 {
            true => (closest.point_b, closest.normal),
            // The middle of the explosion is inside of the geom.
            false => (point(position), away_from(point(position), middle_of(&pieces))),
        };
        let amount = f64::from(strength) * share * width_across(&pieces, direction);
        Some(Push { body: self.body_of(geom)?, amount: vector(scaled(direction, amount)), at: vector(at) })
    }
}

/// The middle of the corners of all pieces.
fn middle_of(pieces: &[Convex]) -> Point {
    let sum = pieces.iter().fold([0.0; 2], |sum, piece| plus(sum, piece.middle()));
    scaled(sum, 1.0 / pieces.len().max(1) as f64)
}

/// The unit vector from a point to another; upwards if they are the same.
fn away_from(from: Point, to: Point) -> Point {
    let way = minus(to, from);
    let length = dot(way, way).sqrt();
    if length > 0.0 { scaled(way, 1.0 / length) } else { [0.0, -1.0] }
}

/// The width of all pieces together across a direction, in length units.
fn width_across(pieces: &[Convex], [x, y]: Point) -> f64 {
    let side = [-y, x];
    let ends = pieces.iter().map(|piece| convex::extent(piece, side));
    let (low, high) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (least, most)| {
        (low.min(least), high.max(most))
    });
    if high > low { high - low } else { 0.0 }
}
