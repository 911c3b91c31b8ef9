//! A game's own data of objects, by their ids.

use std::marker::PhantomData;
use std::ops::{Index, IndexMut};

use serde::{Deserialize, Serialize};

use crate::body::BodyId;
use crate::controllers::ControllerId;
use crate::geom::GeomId;
use crate::joints::JointId;
use crate::object_id::ObjectId;
use crate::objects::Objects;
use crate::springs::SpringId;

mod sealed {
    pub trait Sealed {
        /// Slot and generation.
        fn parts(self) -> (usize, u32);
        fn from_parts(slot: usize, generation: u32) -> Self;
    }
}

/// An id that can be a key of a [`SecondaryMap`]. No other types can implement it.
pub trait MapId: sealed::Sealed + Copy + Into<ObjectId> {}

macro_rules! table_ids {
    ($($id:ty,)*) => {$(
        impl MapId for $id {}

        impl sealed::Sealed for $id {
            #[inline]
            fn parts(self) -> (usize, u32) {
                use crate::storage::arena::Id;
                (self.index(), self.generation())
            }

            fn from_parts(slot: usize, generation: u32) -> Self {
                <$id as crate::storage::arena::Id>::new(slot as u32, generation)
            }
        }
    )*};
}

table_ids! { BodyId, GeomId, JointId, SpringId, ControllerId, }

/// A game's own data of bodies, geoms, joints, springs or controllers, by id, in place of `Tag` and `Name`, which are
/// one number for all purposes and need a cast at every use. Not in the original.
///
/// A lookup costs as much as an index. The id of a disposed object never finds the value of a later one. A value for a
/// new object in the same slot replaces the old one, and [`forget_disposed`](Self::forget_disposed) removes the values
/// of all objects that do not exist any more. The map is plain data, and is saved with the game. As all ids, those of
/// another simulator name other objects.
///
/// ```
/// use farseer_core::{BodyFactory, BodyId, PhysicsSimulator, SecondaryMap};
///
/// #[derive(Debug, PartialEq)]
/// enum Thing { Ball { points: u32 }, Wall }
///
/// let mut simulator = PhysicsSimulator::default();
/// let ball = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0)?;
/// let wall = BodyFactory::create_rectangle_body_in(&mut simulator, 10.0, 10.0, 1.0)?;
/// let mut things = SecondaryMap::new();
/// things.insert(ball, Thing::Ball { points: 10 });
/// assert_eq!(things.get(wall), None, "nothing is known of it, which is not the same as 0");
/// things.insert(wall, Thing::Wall);
/// assert_eq!(things[ball], Thing::Ball { points: 10 });
///
/// simulator.dispose(ball)?;
/// things.forget_disposed(&simulator);
/// assert_eq!(things.ids().collect::<Vec<BodyId>>(), [wall]);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[doc(alias("Tag", "Name"))]
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct SecondaryMap<I, T> {
    /// By slot: the generation of the id, and the value.
    entries: Vec<Option<(u32, T)>>,
    #[serde(skip)]
    ids: PhantomData<I>,
}

impl<I, T> Default for SecondaryMap<I, T> {
    fn default() -> Self {
        SecondaryMap { entries: Vec::new(), ids: PhantomData }
    }
}

impl<I: MapId, T> SecondaryMap<I, T> {
    /// An empty map.
    pub fn new() -> Self {
        Self::default()
    }

    /// Stores a value for an object. Returns the one that it had before.
    pub fn insert(&mut self, id: I, value: T) -> Option<T> {
        let (slot, generation) = id.parts();
        if slot >= self.entries.len() {
            self.entries.resize_with(slot + 1, || None);
        }
        let old = self.entries[slot].replace((generation, value));
        old.filter(|&(of, _)| of == generation).map(|(_, value)| value)
    }

    /// The value of an object.
    #[inline]
    pub fn get(&self, id: I) -> Option<&T> {
        let (slot, generation) = id.parts();
        self.entries.get(slot)?.as_ref().filter(|&&(of, _)| of == generation).map(|(_, value)| value)
    }

    /// The value of an object, to edit.
    #[inline]
    pub fn get_mut(&mut self, id: I) -> Option<&mut T> {
        let (slot, generation) = id.parts();
        self.entries.get_mut(slot)?.as_mut().filter(|&&mut (of, _)| of == generation).map(|(_, value)| value)
    }

    /// The value of an object; the default is stored if it has none.
    pub fn get_or_default(&mut self, id: I) -> &mut T
    where
        T: Default,
    {
        if self.get(id).is_none() {
            self.insert(id, T::default());
        }
        self.get_mut(id).expect("it was inserted")
    }

    /// Whether an object has a value.
    #[inline]
    pub fn contains(&self, id: I) -> bool {
        self.get(id).is_some()
    }

    /// Removes the value of an object, and returns it.
    pub fn remove(&mut self, id: I) -> Option<T> {
        let (slot, generation) = id.parts();
        self.entries.get_mut(slot)?.take_if(|(of, _)| *of == generation).map(|(_, value)| value)
    }

    /// Removes the values of objects that were disposed, or will be removed with the next update. It tests every slot.
    pub fn forget_disposed(&mut self, objects: &Objects) {
        for (slot, entry) in self.entries.iter_mut().enumerate() {
            let is_gone =
                |&mut (generation, _): &mut (u32, T)| objects.is_disposed(I::from_parts(slot, generation));
            entry.take_if(is_gone);
        }
    }

    /// Removes all values.
    pub fn clear(&mut self) {
        self.entries.clear();
    }

    /// Number of objects with a value.
    pub fn len(&self) -> usize {
        self.entries.iter().flatten().count()
    }

    /// Whether no object has a value.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The objects with a value, in the order of their slots.
    pub fn ids(&self) -> impl Iterator<Item = I> + '_ {
        self.iter().map(|(id, _)| id)
    }

    /// All values, in the order of the objects' slots.
    pub fn iter(&self) -> impl Iterator<Item = (I, &T)> + '_ {
        let entries = self.entries.iter().enumerate();
        entries.filter_map(|(slot, entry)| {
            entry.as_ref().map(|(generation, value)| (I::from_parts(slot, *generation), value))
        })
    }

    /// All values, to edit, in the order of the objects' slots.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = (I, &mut T)> + '_ {
        let entries = self.entries.iter_mut().enumerate();
        entries.filter_map(|(slot, entry)| {
            entry.as_mut().map(|(generation, value)| (I::from_parts(slot, *generation), value))
        })
    }
}

impl<I: MapId, T> Index<I> for SecondaryMap<I, T> {
    type Output = T;
    /// # Panics
    /// If the object has no value; see [`SecondaryMap::get`].
    #[inline]
    fn index(&self, id: I) -> &T {
        let name: ObjectId = id.into();
        self.get(id).unwrap_or_else(|| panic!("nothing is known of {name:?}"))
    }
}

impl<I: MapId, T> IndexMut<I> for SecondaryMap<I, T> {
    /// # Panics
    /// If the object has no value; see [`SecondaryMap::get_mut`].
    #[inline]
    fn index_mut(&mut self, id: I) -> &mut T {
        let name: ObjectId = id.into();
        self.get_mut(id).unwrap_or_else(|| panic!("nothing is known of {name:?}"))
    }
}
