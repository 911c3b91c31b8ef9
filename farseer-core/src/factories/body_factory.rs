//! Bodies with the mass properties of simple shapes (behaviour chapter 13, section 2).

use crate::body::{Body, BodyId};
use crate::math::finite::positive;
use crate::objects::Objects;
use crate::shape::Vertices;
use crate::{Error, Result};

/// Makes bodies with the moments of inertia of solid shapes. Mass and lengths are in the user's units.
#[doc(alias = "BodyFactory.Instance")]
#[derive(Debug, Clone, Copy)]
pub struct BodyFactory;

impl BodyFactory {
    /// A solid rectangle.
    ///
    /// # Errors
    /// A width, height or mass that is not finite and greater than 0, or so small that the moment of inertia
    /// vanishes.
    #[doc(alias = "CreateRectangleBody")]
    pub fn create_rectangle_body(width: f32, height: f32, mass: f32) -> Result<Body> {
        positive("width", width)?;
        positive("height", height)?;
        positive("mass", mass)?;
        let moment_of_inertia = mass * (width * width + height * height) / 12.0;
        body(mass, not_too_large("width, height, mass", (width, height, mass), moment_of_inertia)?)
    }

    /// [`create_rectangle_body`](Self::create_rectangle_body), added to the simulator.
    ///
    /// # Errors
    /// As the plain method.
    pub fn create_rectangle_body_in(
        simulator: &mut Objects,
        width: f32,
        height: f32,
        mass: f32,
    ) -> Result<BodyId> {
        add(simulator, Self::create_rectangle_body(width, height, mass)?)
    }

    /// A solid disc.
    ///
    /// # Errors
    /// A radius or mass that is not finite and greater than 0, or so small that the moment of inertia vanishes.
    #[doc(alias = "CreateCircleBody")]
    pub fn create_circle_body(radius: f32, mass: f32) -> Result<Body> {
        positive("radius", radius)?;
        positive("mass", mass)?;
        let moment_of_inertia = 0.5 * mass * (radius * radius);
        body(mass, not_too_large("radius, mass", (radius, mass), moment_of_inertia)?)
    }

    /// [`create_circle_body`](Self::create_circle_body), added to the simulator.
    ///
    /// # Errors
    /// As the plain method.
    pub fn create_circle_body_in(simulator: &mut Objects, radius: f32, mass: f32) -> Result<BodyId> {
        add(simulator, Self::create_circle_body(radius, mass)?)
    }

    /// A solid capsule, upright: two half discs with a rectangle between them, along y. `height` is from tip to tip.
    /// Ours, for [`create_capsule_geom`](crate::GeomFactory::create_capsule_geom): the original has none.
    ///
    /// # Errors
    /// A height, radius or mass that is not finite and greater than 0, or so small that the moment of inertia vanishes; a
    /// radius that is not less than half of the height.
    pub fn create_capsule_body(height: f32, end_radius: f32, mass: f32) -> Result<Body> {
        positive("height", height)?;
        positive("end_radius", end_radius)?;
        positive("mass", mass)?;
        if end_radius >= 0.5 * height {
            return Err(Error::invalid("end_radius", end_radius, "less than half of the height"));
        }
        let moment_of_inertia = inertia_of_capsule(f64::from(height), f64::from(end_radius), f64::from(mass));
        let arguments = ("height, end_radius, mass", (height, end_radius, mass));
        body(mass, not_too_large(arguments.0, arguments.1, moment_of_inertia as f32)?)
    }

    /// [`create_capsule_body`](Self::create_capsule_body), added to the simulator.
    ///
    /// # Errors
    /// As the plain method.
    pub fn create_capsule_body_in(
        simulator: &mut Objects,
        height: f32,
        end_radius: f32,
        mass: f32,
    ) -> Result<BodyId> {
        add(simulator, Self::create_capsule_body(height, end_radius, mass)?)
    }

    /// A solid ellipse.
    ///
    /// # Errors
    /// A radius or mass that is not finite and greater than 0, or so small that the moment of inertia vanishes.
    #[doc(alias = "CreateEllipseBody")]
    pub fn create_ellipse_body(x_radius: f32, y_radius: f32, mass: f32) -> Result<Body> {
        positive("x_radius", x_radius)?;
        positive("y_radius", y_radius)?;
        positive("mass", mass)?;
        if x_radius == y_radius {
            return Self::create_circle_body(x_radius, mass);
        }
        let moment_of_inertia = 0.25 * mass * (x_radius * x_radius + y_radius * y_radius);
        body(mass, not_too_large("x_radius, y_radius, mass", (x_radius, y_radius, mass), moment_of_inertia)?)
    }

    /// [`create_ellipse_body`](Self::create_ellipse_body), added to the simulator.
    ///
    /// # Errors
    /// As the plain method.
    pub fn create_ellipse_body_in(
        simulator: &mut Objects,
        x_radius: f32,
        y_radius: f32,
        mass: f32,
    ) -> Result<BodyId> {
        add(simulator, Self::create_ellipse_body(x_radius, y_radius, mass)?)
    }

    /// A solid polygon, positioned at the centroid of its outline.
    ///
    /// # Errors
    /// A mass that is not finite and greater than 0; an outline that is empty, not finite, or without area. (In the
    /// last case the original makes a body that is not finite.)
    #[doc(alias = "CreatePolygonBody")]
    pub fn create_polygon_body(vertices: &Vertices, mass: f32) -> Result<Body> {
        positive("mass", mass)?;
        let without_area = || Error::invalid("vertices", vertices, "an outline with an area");
        let moment_of_inertia = vertices.get_moment_of_inertia().map_err(|_| without_area())?;
        let mut body = body(mass, mass * moment_of_inertia).map_err(|_| without_area())?;
        let centroid = vertices.get_centroid();
        crate::math::finite::finite_vector("vertices", centroid).map_err(|_| without_area())?;
        body.set_position(centroid);
        Ok(body)
    }

    /// [`create_polygon_body`](Self::create_polygon_body), added to the simulator.
    ///
    /// # Errors
    /// As the plain method.
    pub fn create_polygon_body_in(simulator: &mut Objects, vertices: &Vertices, mass: f32) -> Result<BodyId> {
        add(simulator, Self::create_polygon_body(vertices, mass)?)
    }

    /// A body with this mass and moment of inertia.
    ///
    /// # Errors
    /// A mass or moment of inertia that is not finite and greater than 0.
    #[doc(alias = "CreateBody")]
    pub fn create_body(mass: f32, moment_of_inertia: f32) -> Result<Body> {
        positive("mass", mass)?;
        positive("moment_of_inertia", moment_of_inertia)?;
        body(mass, moment_of_inertia)
    }

    /// [`create_body`](Self::create_body), added to the simulator.
    ///
    /// # Errors
    /// As the plain method.
    pub fn create_body_in(simulator: &mut Objects, mass: f32, moment_of_inertia: f32) -> Result<BodyId> {
        add(simulator, Self::create_body(mass, moment_of_inertia)?)
    }

    /// A copy of a body's mass properties and settings, see [`Body::copy_of`].
    #[doc(alias = "CreateBody(Body)")]
    pub fn create_body_from(body: &Body) -> Body {
        Body::copy_of(body)
    }

    /// [`create_body_from`](Self::create_body_from) of a body of the simulator, added to it.
    ///
    /// # Errors
    /// A stale id.
    pub fn create_body_from_in(simulator: &mut Objects, body: BodyId) -> Result<BodyId> {
        let copy = Body::copy_of(simulator.body(body).ok_or(Error::StaleId { argument: "body" })?);
        add(simulator, copy)
    }
}

/// Moment of inertia of a capsule: a rectangle of width 2 r and length s = height - 2 r, and a disc of radius r whose
/// halves sit at its ends.
///
/// The centroid of a half disc lies c = 4 r / (3 pi) from its straight side. Its moment of inertia about the middle of
/// that side is m r² / 2, so about the centroid m r² / 2 - m c². About the middle of the capsule it is greater by m (s
/// / 2 + c)².
fn inertia_of_capsule(height: f64, radius: f64, mass: f64) -> f64 {
    use std::f64::consts::PI;
    let side = height - 2.0 * radius;
    let (rectangle, disc) = (2.0 * radius * side, PI * radius * radius);
    let centroid = 4.0 * radius / (3.0 * PI);
    let of_rectangle = (side * side + 4.0 * radius * radius) / 12.0;
    let of_disc = radius * radius / 2.0 + side * side / 4.0 + side * centroid;
    mass * (rectangle * of_rectangle + disc * of_disc) / (rectangle + disc)
}

/// Refuses a size with an infinite moment of inertia.
fn not_too_large(
    arguments: &'static str,
    values: impl std::fmt::Debug,
    moment_of_inertia: f32,
) -> Result<f32> {
    if moment_of_inertia.is_finite() {
        Ok(moment_of_inertia)
    } else {
        Err(Error::invalid(arguments, values, "small enough for a finite moment of inertia"))
    }
}

fn body(mass: f32, moment_of_inertia: f32) -> Result<Body> {
    let mut body = Body::new();
    body.set_mass(mass)?;
    body.set_moment_of_inertia(moment_of_inertia)?;
    Ok(body)
}

fn add(simulator: &mut Objects, body: Body) -> Result<BodyId> {
    let body = simulator.create_body(body);
    simulator.add(body)?;
    Ok(body)
}
