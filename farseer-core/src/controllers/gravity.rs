//! Attraction by points and bodies (behaviour chapter 12, section 7).

use serde::{Deserialize, Serialize};

use crate::body::entry::Bodies;
use crate::body::{Body, BodyId};
use crate::error::Result;
use crate::math::finite::{finite, finite_vector};
use crate::math::{Vector2, vector2};

/// How attraction falls off with the distance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum GravityType {
    /// Attraction is proportional to 1 / distance².
    DistanceSquared,
    /// Attraction is proportional to 1 / distance.
    #[default]
    Linear,
}

/// Lets points and bodies attract every body of the simulation that does not ignore gravity.
///
/// A source at distance d, at most the radius, accelerates a body by strength / d or strength / d². The mass of the
/// source does not matter, and no reaction acts on the source. A body exactly at a source is not attracted, which is
/// reported as [`Event::ControllerNotFinite`](crate::Event::ControllerNotFinite); in the original its force is NaN.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct GravityController {
    bodies: Vec<BodyId>,
    points: Vec<Vector2>,
    strength: f32,
    radius: f32,
    gravity_type: GravityType,
}

impl GravityController {
    /// Bodies and points that attract [linearly](GravityType::Linear), within `radius` length units, with the
    /// acceleration `strength`, in length units/s², at distance 1. The bodies need not be in the simulation; disposed
    /// ones are removed.
    ///
    /// # Errors
    /// Numbers that are not finite.
    #[doc(alias = "GravityController(PhysicsSimulator, List<Body>, List<Vector2>, float, float)")]
    pub fn new(bodies: Vec<BodyId>, points: Vec<Vector2>, strength: f32, radius: f32) -> Result<Self> {
        let mut controller = GravityController {
            bodies,
            points: Vec::new(),
            strength: finite("strength", strength)?,
            radius: finite("radius", radius)?,
            gravity_type: GravityType::Linear,
        };
        controller.set_point_list(points)?;
        Ok(controller)
    }

    /// [`new`](Self::new) without points.
    ///
    /// # Errors
    /// Numbers that are not finite.
    #[doc(alias = "GravityController(PhysicsSimulator, List<Body>, float, float)")]
    pub fn with_bodies(bodies: Vec<BodyId>, strength: f32, radius: f32) -> Result<Self> {
        GravityController::new(bodies, Vec::new(), strength, radius)
    }

    /// [`new`](Self::new) without bodies.
    ///
    /// # Errors
    /// Numbers that are not finite.
    #[doc(alias = "GravityController(PhysicsSimulator, List<Vector2>, float, float)")]
    pub fn with_points(points: Vec<Vector2>, strength: f32, radius: f32) -> Result<Self> {
        GravityController::new(Vec::new(), points, strength, radius)
    }

    /// Dependence of the attraction on the distance. Default [`GravityType::Linear`].
    #[doc(alias = "GravityType")]
    pub fn gravity_type(&self) -> GravityType {
        self.gravity_type
    }

    /// Sets the dependence on the distance; the strength keeps its value.
    pub fn set_gravity_type(&mut self, gravity_type: GravityType) {
        self.gravity_type = gravity_type;
    }

    /// The bodies that attract, in the order in which they act.
    #[doc(alias = "BodyList")]
    pub fn body_list(&self) -> &[BodyId] {
        &self.bodies
    }

    /// Replaces the bodies that attract. A body that is listed twice attracts twice.
    pub fn set_body_list(&mut self, bodies: Vec<BodyId>) {
        self.bodies = bodies;
    }

    /// The points that attract, in the order in which they act, after the bodies.
    #[doc(alias = "PointList")]
    pub fn point_list(&self) -> &[Vector2] {
        &self.points
    }

    /// Replaces the points that attract.
    ///
    /// # Errors
    /// A point that is not finite.
    pub fn set_point_list(&mut self, points: Vec<Vector2>) -> Result<()> {
        for &point in &points {
            finite_vector("points", point)?;
        }
        self.points = points;
        Ok(())
    }

    /// Acceleration at distance 1, in length units/s².
    pub fn strength(&self) -> f32 {
        self.strength
    }

    /// Maximum distance at which a source attracts, in length units.
    pub fn radius(&self) -> f32 {
        self.radius
    }

    /// Adds the force of every source to every listed body, and removes bodies that do not exist any more. Returns
    /// whether all forces were finite.
    pub(crate) fn update(&mut self, bodies: &mut Bodies) -> bool {
        self.bodies.retain(|&source| bodies.contains(source));
        let mut all_finite = true;
        for position in 0..bodies.list().len() {
            let id = bodies.list()[position];
            let body = &bodies[id].body;
            if bodies.is_disposed(id) || !body.enabled() || body.ignore_gravity() {
                continue;
            }
            let is_immovable = body.is_immovable();
            for &source in &self.bodies {
                let body = &bodies[source].body;
                let is_idle =
                    bodies.is_disposed(source) || !body.enabled() || (is_immovable && body.is_immovable());
                if source != id && !is_idle {
                    let position = body.position();
                    all_finite &= self.pull(&mut bodies[id].body, position);
                }
            }
            for &point in &self.points {
                all_finite &= self.pull(&mut bodies[id].body, point);
            }
        }
        all_finite
    }

    /// Adds the force of a source to a body. If the body's force would not be finite it adds none and returns false.
    fn pull(&self, body: &mut Body, source: Vector2) -> bool {
        let difference = source - body.position();
        let distance = vector2::length(difference);
        let direction = difference * (1.0 / distance);
        if distance > self.radius {
            return true;
        }
        let fall_off = match self.gravity_type {
            GravityType::DistanceSquared => 1.0 / (distance * distance),
            GravityType::Linear => 1.0 / distance,
        };
        let force = direction * self.strength * fall_off * body.mass();
        let sum = body.force() + force;
        let is_finite = sum.x.is_finite() && sum.y.is_finite();
        if is_finite {
            body.apply_force(force);
        }
        is_finite
    }

    pub(super) fn is_valid(&self) -> bool {
        self.strength.is_finite()
            && self.radius.is_finite()
            && self.points.iter().all(|point| point.x.is_finite() && point.y.is_finite())
    }
}
