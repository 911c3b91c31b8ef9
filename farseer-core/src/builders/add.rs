//! Adds what builders describe.

use super::body_builder::Kind;
use super::geom_shape::GeomShape;
use super::mass::{MassProperties, of_geoms};
use super::{BodyBuilder, GeomBuilder};
use crate::body::{Body, BodyId};
use crate::geom::GeomId;
use crate::geom::entry::GeomEntry;
use crate::geom::options::WantedEvents;
use crate::geom::outline::Outline;
use crate::geom::rounded::core_of;
use crate::math::finite::positive;
use crate::math::{Vector2, scalar};
use crate::object_id::ObjectId;
use crate::objects::{GeomPlacement, Objects};
use crate::simulator::PhysicsSimulator;
use crate::{Error, Result, SurfaceOptions};

/// Bodies and geoms of builders.
impl Objects {
    /// Adds a body with its geoms, and returns the ids of all. They take part from the next update on.
    ///
    /// The mass properties of a dynamic body are those of its geoms. Its centre of mass becomes its
    /// [position](Body::position), to which the offsets of its geoms are adapted.
    ///
    /// ```
    /// use farseer_core::{BodyBuilder, Error, GeomBuilder, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::precise([0.0, 300.0])?;
    /// let (crate_, [geom]) = simulator.add_body(BodyBuilder::dynamic(), [GeomBuilder::rectangle(32.0, 32.0)])?;
    /// assert_eq!(simulator[crate_].mass(), 1.0);
    /// assert_eq!(simulator[geom].friction_coefficient(), 0.6);
    ///
    /// let refused = simulator.add_body(BodyBuilder::dynamic(), [GeomBuilder::circle(-1.0)]);
    /// let reason = refused.unwrap_err().to_string();
    /// assert_eq!(reason, "radius is -1.0, but must be finite and greater than 0");
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// A value that is not possible: the error names the builder's method. A dynamic body whose geoms have no mass. A chain
    /// on a body that is not static. [`Error::NotSupported`] for options that the faithful methods do not have. No state has
    /// changed then.
    pub fn add_body<const N: usize>(
        &mut self,
        body: BodyBuilder,
        geoms: [GeomBuilder; N],
    ) -> Result<(BodyId, [GeomId; N])> {
        let (body, geoms) = self.add_body_with(&body, &geoms)?;
        let Ok(geoms) = geoms.try_into() else { unreachable!("there is one id for each geom") };
        Ok((body, geoms))
    }

    /// [`add_body`](Self::add_body) with any number of geoms.
    ///
    /// # Errors
    /// As [`add_body`](Self::add_body).
    pub fn add_body_with(
        &mut self,
        body: &BodyBuilder,
        geoms: &[GeomBuilder],
    ) -> Result<(BodyId, Vec<GeomId>)> {
        body.check(self.methods)?;
        geoms.iter().try_for_each(|geom| geom.check(self.methods))?;
        let (made, centre) = self.body_of_builder(body, geoms)?;
        let id = self.create_body(made);
        let mut ids = Vec::with_capacity(geoms.len());
        for geom in geoms {
            match self.create_geom_of_builder(id, geom, centre) {
                Ok(geom) => ids.push(geom),
                Err(error) => {
                    let made = [ObjectId::from(id)].into_iter().chain(ids.into_iter().map(ObjectId::from));
                    self.discard(made);
                    return Err(error);
                }
            }
        }
        self.bodies.add("body", id)?;
        ids.iter().try_for_each(|&geom| self.geoms.add("geom", geom))?;
        Ok((id, ids))
    }

    /// Adds a geom to a body that exists, whose mass and centre of mass stay.
    ///
    /// # Errors
    /// A stale body, and as [`add_body`](Self::add_body).
    pub fn add_geom(&mut self, body: BodyId, geom: &GeomBuilder) -> Result<GeomId> {
        geom.check(self.methods)?;
        self.body(body).ok_or(Error::StaleId { argument: "body" })?;
        let geom = self.create_geom_of_builder(body, geom, Vector2::zeros())?;
        self.geoms.add("geom", geom)?;
        Ok(geom)
    }

    /// Makes a geom a sensor, which exerts no impulses, or an ordinary geom again. The kind of its body does not change, other
    /// than with [`set_is_sensor`](Self::set_is_sensor).
    ///
    /// # Errors
    /// A stale id.
    pub fn set_sensor(&mut self, geom: GeomId, is_sensor: bool) -> Result<()> {
        self.geoms.get_mut(geom).ok_or(Error::StaleId { argument: "geom" })?.is_sensor = is_sensor;
        self[geom].set_collision_response_enabled(!is_sensor);
        Ok(())
    }

    /// Sets mass and moment of inertia of a body from its geoms with one density, in mass units per square of a user's length
    /// unit. Sensors and chains have no mass. The body's position stays the point about which it turns.
    ///
    /// ```
    /// use farseer_core::{Body, GeomFactory, GeomPlacement, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::default();
    /// let body = simulator.create_body(Body::new());
    /// GeomFactory::create_rectangle_geom_in(&mut simulator, body, 4.0, 3.0, GeomPlacement::default())?;
    /// simulator.set_density(body, 2.0)?;
    /// assert_eq!((simulator[body].mass(), simulator[body].moment_of_inertia()), (24.0, 50.0));
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// A stale id; a density that is not finite and greater than 0; a body without a geom that has an area.
    pub fn set_density(&mut self, body: BodyId, density: f32) -> Result<()> {
        let density = f64::from(positive("density", density)?);
        let owner = self.bodies.get(body).ok_or(Error::StaleId { argument: "body" })?;
        let solid = owner.geoms.iter().map(|&geom| &self.geoms[geom]);
        let solid = solid.filter(|geom| geom.geom.collision_response_enabled());
        let parts: Vec<MassProperties> = solid.map(mass_of_geom).collect::<Result<_>>()?;
        let sum = MassProperties::sum(&parts);
        let sum = about_origin(sum.with_mass(sum.mass * density));
        if sum.mass <= 0.0 {
            return Err(Error::invalid("body", body, "one with a geom that has an area"));
        }
        let changed = &mut self[body];
        let former = changed.mass();
        changed.set_mass(sum.mass as f32)?;
        changed
            .set_moment_of_inertia(sum.inertia as f32)
            .or_else(|error| changed.set_mass(former).and(Err(error)))
    }

    /// Returns the body that a builder describes, and its centre of mass in the builder's coordinates.
    fn body_of_builder(&self, builder: &BodyBuilder, geoms: &[GeomBuilder]) -> Result<(Body, Vector2)> {
        let mut body = Body::new();
        let mass = match builder.kind {
            Kind::Dynamic => of_geoms(geoms, builder.mass, self.methods)?,
            // They stay where they are put; the mass matters once they become dynamic.
            _ => about_origin(of_geoms(geoms, builder.mass.or(Some(1.0)), self.methods)?),
        };
        body.set_mass(mass.mass as f32)?;
        body.set_moment_of_inertia(builder.moment_of_inertia.unwrap_or(mass.inertia as f32))?;
        let centre = Vector2::new(mass.centre[0] as f32, mass.centre[1] as f32);
        let (sine, cosine) = scalar::sin_cos(builder.rotation);
        let turned = Vector2::new(cosine * centre.x - sine * centre.y, sine * centre.x + cosine * centre.y);
        body.set_position(builder.position + turned);
        body.set_rotation(builder.rotation);
        body.set_gravity_scale(builder.gravity_scale);
        body.set_linear_drag_coefficient(builder.linear_damping * body.mass());
        body.set_rotational_drag_coefficient(builder.angular_damping * body.moment_of_inertia());
        body.set_rotational_drag_linear(true);
        body.set_tag(builder.user_data);
        body.set_enabled(builder.enabled);
        body.set_is_bullet(builder.is_bullet);
        body.set_sleep_allowed(builder.sleep_allowed);
        body.set_sleep_requested(builder.starts_asleep);
        body.set_sleep_events(builder.sleep_events.unwrap_or(self.methods.is_precise()));
        body.set_is_kinematic(builder.kind == Kind::Kinematic);
        body.set_is_static(builder.kind == Kind::Fixed);
        body.set_rotation_locked(builder.locks_rotation);
        body.set_locked_axes(builder.locked_axes);
        body.set_linear_velocity(builder.linear_velocity);
        body.set_angular_velocity(builder.angular_velocity);
        let rejected = body.rejected.take().next();
        match rejected {
            Some(argument) => Err(Error::invalid(argument, "too large", "finite in the units of the body")),
            None => Ok((body, centre)),
        }
    }

    /// Makes the geom that a builder describes. `centre`: the body's origin in the builder's coordinates, length units.
    fn create_geom_of_builder(
        &mut self,
        body: BodyId,
        geom: &GeomBuilder,
        centre: Vector2,
    ) -> Result<GeomId> {
        let at = geom.offset - centre;
        // The original turns an offset along with the outline.
        let (sine, cosine) = scalar::sin_cos(geom.rotation_offset);
        let offset = match geom.rotation_offset == 0.0 {
            true => at,
            false => Vector2::new(cosine * at.x + sine * at.y, cosine * at.y - sine * at.x),
        };
        let placement =
            GeomPlacement { offset, rotation_offset: geom.rotation_offset, ..GeomPlacement::default() };
        let direction = geom.one_way.map(crate::objects::unit).transpose()?;
        let id = self.create_geom_of(body, geom.shape.outline()?, placement)?;
        let entry = &mut self.geoms[id];
        entry.one_way = direction;
        entry.is_sensor = geom.is_sensor;
        let settings = &mut entry.geom;
        settings.set_collision_response_enabled(!geom.is_sensor);
        settings.set_friction_coefficient(geom.friction);
        settings.set_restitution_coefficient(geom.restitution);
        settings.surface = (geom.surface != SurfaceOptions::default()).then_some(geom.surface);
        settings.set_collision_categories(geom.categories);
        settings.set_collides_with(geom.collides_with);
        settings.set_collision_group(geom.group);
        settings.set_both_must_agree(true);
        let default = match self.methods.is_precise() {
            true => WantedEvents::TOUCH | WantedEvents::SENSOR,
            false => WantedEvents::NONE,
        };
        settings.set_wanted_events(geom.events.unwrap_or(default));
        settings.set_tag(geom.user_data);
        Ok(id)
    }
}

/// Returns the mass properties of a geom with density 1, in the coordinates of its body.
fn mass_of_geom(geom: &GeomEntry) -> Result<MassProperties> {
    let corners = geom.local_vertices.to_vec();
    let shape = match geom.outline {
        Outline::Circle { radius } => GeomShape::Circle { radius },
        Outline::Capsule { height, end_radius } => GeomShape::Capsule { height, end_radius },
        Outline::RoundedPolygon { radius } => {
            let core = core_of(&corners, radius).into_iter().map(Vector2::from).collect();
            GeomShape::RoundedPolygon { corners: core, radius }
        }
        Outline::Chain { .. } | Outline::TwoSidedChain { .. } => GeomShape::Chain { points: corners },
        Outline::Polygon => GeomShape::Polygon { corners },
    };
    // The original turns an offset along with the outline.
    let (sine, cosine) = scalar::sin_cos(geom.rotation_offset);
    let [x, y] = [geom.offset.x, geom.offset.y];
    let at = [cosine * x - sine * y, sine * x + cosine * y].map(f64::from);
    Ok(shape.of_density_1()?.placed(at, f64::from(geom.rotation_offset)))
}

/// Returns the mass properties about the origin.
fn about_origin(mass: MassProperties) -> MassProperties {
    MassProperties { mass: mass.mass, centre: [0.0; 2], inertia: mass.inertia_about([0.0; 2]) }
}

/// The same as the simulator's own: the arguments of a call may contain another one.
impl PhysicsSimulator {
    /// A simulator with the [precise set](crate::Methods::PRECISE) for games in px, with this gravity (length units/s², y down)
    /// and 4 substeps: for all games that are no ports.
    ///
    /// For games in metres set `Methods::Precise { length_unit: 1.0 }` before bodies are added.
    ///
    /// ```
    /// use farseer_core::{Methods, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::precise([0.0, 9.8])?;
    /// simulator.set_methods(Methods::Precise { length_unit: 1.0 })?;
    /// assert_eq!(simulator.iterations(), 4);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// Gravity that is not finite.
    #[cfg(feature = "precise")]
    pub fn precise(gravity: impl Into<Vector2>) -> Result<Self> {
        let mut simulator = PhysicsSimulator::new(gravity.into())?;
        simulator.set_methods(crate::Methods::PRECISE)?;
        simulator.set_iterations(PRECISE_SUBSTEPS);
        Ok(simulator)
    }

    /// [`Objects::add_body`]
    ///
    /// # Errors
    /// As there.
    pub fn add_body<const N: usize>(
        &mut self,
        body: BodyBuilder,
        geoms: [GeomBuilder; N],
    ) -> Result<(BodyId, [GeomId; N])> {
        Objects::add_body(self, body, geoms)
    }
}

/// Number of substeps of an update of [`PhysicsSimulator::precise`]: that of Box2D 3 and of the measurements.
#[cfg(feature = "precise")]
const PRECISE_SUBSTEPS: i32 = 4;
