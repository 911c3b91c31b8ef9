//! Force fields in a part of the world: fluids and wells.

mod fluid;
mod region;
mod well;

use serde::{Deserialize, Serialize};

use crate::Result;
use crate::error::stale;

pub use fluid::Fluid;
pub use region::Region;
pub use well::Well;

/// Identifies a field of a simulator. Ids are never reused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct FieldId(u64);

/// A field that acts on dynamic bodies in every update without touching them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Field {
    /// The field is a fluid, such as water, mud or moving air: buoyancy and drag.
    Fluid(Fluid),
    /// The field is a point that attracts or repels bodies.
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

/// All fields of a simulator.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct Fields {
    /// Fields sorted by id, which is the order of creation.
    list: Vec<(FieldId, Field)>,
    /// Number of the next id that a field gets; dimensionless.
    next: u64,
}

impl Fields {
    pub(crate) fn clear(&mut self) {
        self.list.clear();
    }

    pub(crate) fn insert(&mut self, field: Field) -> Result<FieldId> {
        let (id, field) = (FieldId(self.next), field.check()?);
        self.next += 1;
        self.list.push((id, field));
        Ok(id)
    }

    pub(crate) fn set(&mut self, id: FieldId, field: Field) -> Result<()> {
        let field = field.check()?;
        let place = self.place(id)?;
        self.list[place].1 = field;
        Ok(())
    }

    pub(crate) fn remove(&mut self, id: FieldId) -> Result<()> {
        let place = self.place(id)?;
        self.list.remove(place);
        Ok(())
    }

    pub(crate) fn get(&self, id: FieldId) -> Result<&Field> {
        Ok(&self.list[self.place(id)?].1)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = (FieldId, &Field)> {
        self.list.iter().map(|(id, field)| (*id, field))
    }

    fn place(&self, id: FieldId) -> Result<usize> {
        self.list.binary_search_by_key(&id, |(id, _)| *id).map_err(|_| stale("field"))
    }

    /// Returns whether ids are sorted and fields are in range: false only for a damaged save.
    pub(crate) fn is_valid(&self) -> bool {
        self.list.windows(2).all(|pair| pair[0].0 < pair[1].0)
            && self.list.last().is_none_or(|(id, _)| id.0 < self.next)
            && self.list.iter().all(|(_, field)| field.check().is_ok())
    }
}
