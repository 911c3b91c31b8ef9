//! The fields of a simulator.

use farseer_core::BodyId;

use super::TwoHalfPhysicsSimulator;
use crate::Result;
use crate::depth::{Field, FieldId};
use crate::error::stale;
use crate::stages::immersion_of;

/// Fields.
impl TwoHalfPhysicsSimulator {
    /// Adds a field that acts from the next update on, with all [schemes](crate::DepthScheme).
    ///
    /// ```
    /// use twohalf::{Fluid, Region, TwoHalfPhysicsSimulator, Vector2, Vector3, Well};
    ///
    /// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
    /// let pool = Region::new([0.0, 0.0, 0.0], [400.0, 80.0, 150.0])?;
    /// // A cube of 30 px and of mass 10 floats with half of it below the surface; a current runs to the back.
    /// let density = 2.0 * 10.0 / (30.0 * 30.0 * 30.0);
    /// let flow = Vector3::new(0.0, 0.0, 40.0);
    /// let water = simulator.add_field(Fluid { flow, ..Fluid::water(pool, density) })?;
    /// simulator.add_field(Fluid::wind(Region::EVERYWHERE, Vector3::new(60.0, 0.0, 0.0), 1e-4))?;
    /// simulator.add_field(Well { strength: 1e5, ..Well::new([200.0, 300.0, 75.0]) })?;
    /// assert_eq!(simulator.fields().count(), 3);
    /// simulator.remove_field(water)?;
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    ///
    /// # Errors
    /// Numbers out of the ranges of [`Fluid`](crate::Fluid) and [`Well`](crate::Well).
    pub fn add_field(&mut self, field: impl Into<Field>) -> Result<FieldId> {
        self.world.fields.insert(field.into())
    }

    /// A field; `None` for a stale id.
    pub fn field(&self, field: FieldId) -> Option<&Field> {
        self.world.fields.get(field).ok()
    }

    /// Replaces a field from the next update on: a tide, a gust.
    ///
    /// # Errors
    /// A stale id; those of [`add_field`](Self::add_field). The field stays unchanged then.
    pub fn set_field(&mut self, id: FieldId, field: impl Into<Field>) -> Result<()> {
        self.world.fields.set(id, field.into())
    }

    /// Removes a field; its id is stale afterwards.
    ///
    /// # Errors
    /// A stale id.
    pub fn remove_field(&mut self, field: FieldId) -> Result<()> {
        self.world.fields.remove(field)
    }

    /// All fields with their ids, in the order of creation.
    pub fn fields(&self) -> impl Iterator<Item = (FieldId, &Field)> {
        self.world.fields.iter()
    }

    /// Immersed fraction of a body's volume in a fluid, 0..=1: whether a character swims, or a splash is due.
    /// 0 for a field that is no fluid.
    ///
    /// # Errors
    /// Stale ids.
    pub fn immersion(&self, field: FieldId, body: BodyId) -> Result<f32> {
        let field = self.world.fields.get(field)?;
        self.core.body(body).ok_or(stale("body"))?;
        Ok(match field {
            Field::Fluid(fluid) => immersion_of(&self.core, &self.world.depths, fluid, body),
            Field::Well(_) => 0.0,
        })
    }
}
