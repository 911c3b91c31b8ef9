//! Fields: what pushes bodies in a part of the world without touching them. Water, wind and wells.

mod act;
mod fluid;
mod immersion;
mod region;
mod well;

use serde::{Deserialize, Serialize};

use crate::error::stale;
use crate::{Result, TwoHalfPhysicsSimulator};

pub use fluid::Fluid;
pub use region::Region;
pub use well::Well;

/// Names a field of a simulator. Never reused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct FieldId(u64);

/// What pushes bodies that can be moved, in every update, without touching them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Field {
    /// Water, mud, air that moves: it carries, slows, and takes along.
    Fluid(Fluid),
    /// What attracts, or repels.
    Well(Well),
}

impl Field {
    fn check(self) -> Result<Self> {
        match self {
            Field::Fluid(fluid) => fluid.check()?,
            Field::Well(well) => well.check()?,
        }
        Ok(self)
    }
}

impl From<Fluid> for Field {
    fn from(fluid: Fluid) -> Self {
        Field::Fluid(fluid)
    }
}

impl From<Well> for Field {
    fn from(well: Well) -> Self {
        Field::Well(well)
    }
}

/// The fields of a simulator.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct Fields {
    /// In the order in which they were made, which is that of their ids.
    list: Vec<(FieldId, Field)>,
    next: u64,
    /// Outlines below water, while they are looked at.
    #[serde(skip)]
    scratch: immersion::Scratch,
}

impl Fields {
    pub(crate) fn clear(&mut self) {
        self.list.clear();
    }

    fn place(&self, id: FieldId) -> Result<usize> {
        self.list.binary_search_by_key(&id, |(id, _)| *id).map_err(|_| stale("field"))
    }

    /// Whether everything is what the setters could have made: false only after loading garbage.
    pub(crate) fn is_valid(&self) -> bool {
        self.list.windows(2).all(|pair| pair[0].0 < pair[1].0)
            && self.list.last().is_none_or(|(id, _)| id.0 < self.next)
            && self.list.iter().all(|(_, field)| field.check().is_ok())
    }
}

/// Fields.
impl TwoHalfPhysicsSimulator {
    /// Lets a field act from the next update on, in all [schemes](crate::DepthScheme).
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
    /// Numbers that are not as [`Fluid`] and [`Well`] say.
    pub fn add_field(&mut self, field: impl Into<Field>) -> Result<FieldId> {
        let field = field.into().check()?;
        let fields = &mut self.world.fields;
        let id = FieldId(fields.next);
        fields.next += 1;
        fields.list.push((id, field));
        Ok(id)
    }

    /// A field, unless the id is stale.
    pub fn field(&self, field: FieldId) -> Option<&Field> {
        let fields = &self.world.fields;
        fields.place(field).ok().map(|place| &fields.list[place].1)
    }

    /// Makes something else of a field, which acts from the next update on: a tide, a gust.
    ///
    /// # Errors
    /// A stale id; as [`add_field`](Self::add_field). Then the field stays what it was.
    pub fn set_field(&mut self, id: FieldId, field: impl Into<Field>) -> Result<()> {
        let field = field.into().check()?;
        let fields = &mut self.world.fields;
        let place = fields.place(id)?;
        fields.list[place].1 = field;
        Ok(())
    }

    /// Takes a field away; its id is stale.
    ///
    /// # Errors
    /// A stale id.
    pub fn remove_field(&mut self, field: FieldId) -> Result<()> {
        let fields = &mut self.world.fields;
        let place = fields.place(field)?;
        fields.list.remove(place);
        Ok(())
    }

    /// The fields and what they are, in the order in which they were made.
    pub fn fields(&self) -> impl Iterator<Item = (FieldId, &Field)> {
        self.world.fields.list.iter().map(|(id, field)| (*id, field))
    }
}
