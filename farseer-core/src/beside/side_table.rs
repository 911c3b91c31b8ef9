//! What a game knows of objects, kept beside the simulator.

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

/// An id that a [`SideTable`] can be keyed by. No other types can be.
pub trait TableId: sealed::Sealed + Copy + Into<ObjectId> {}

macro_rules! table_ids {
    ($($id:ty,)*) => {$(
        impl TableId for $id {}

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

/// What a game knows of bodies, geoms, joints, springs or controllers: its own data by id, in place of `Tag` and `Name`,
/// which are one number for everything and need a cast at every use. Not in the original.
///
/// A lookup costs what an index costs. Ids of what was disposed find nothing of what came after it: a value for a new object
/// in the same slot replaces the old one, and [`forget_disposed`](Self::forget_disposed) drops those of all that has gone.
/// It is plain data, and is saved with the game. As with all ids, those of another simulator name other things.
///
/// ```
/// use farseer_core::{BodyFactory, BodyId, PhysicsSimulator, SideTable};
///
/// #[derive(Debug, PartialEq)]
/// enum Thing { Ball { points: u32 }, Wall }
///
/// let mut simulator = PhysicsSimulator::default();
/// let ball = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0)?;
/// let wall = BodyFactory::create_rectangle_body_in(&mut simulator, 10.0, 10.0, 1.0)?;
/// let mut things = SideTable::new();
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
pub struct SideTable<I, T> {
    /// By slot: the generation of the id, and the value.
    entries: Vec<Option<(u32, T)>>,
    #[serde(skip)]
    ids: PhantomData<I>,
}

impl<I, T> Default for SideTable<I, T> {
    fn default() -> Self {
        SideTable { entries: Vec::new(), ids: PhantomData }
    }
}

impl<I: TableId, T> SideTable<I, T> {
    /// An empty one.
    pub fn new() -> Self {
        Self::default()
    }

    /// Keeps a value for an object. Answers what was known of it before.
    pub fn insert(&mut self, id: I, value: T) -> Option<T> {
        let (slot, generation) = id.parts();
        if slot >= self.entries.len() {
            self.entries.resize_with(slot + 1, || None);
        }
        let old = self.entries[slot].replace((generation, value));
        old.filter(|&(of, _)| of == generation).map(|(_, value)| value)
    }

    /// What is known of an object.
    #[inline]
    pub fn get(&self, id: I) -> Option<&T> {
        let (slot, generation) = id.parts();
        self.entries.get(slot)?.as_ref().filter(|&&(of, _)| of == generation).map(|(_, value)| value)
    }

    /// What is known of an object, to change.
    #[inline]
    pub fn get_mut(&mut self, id: I) -> Option<&mut T> {
        let (slot, generation) = id.parts();
        self.entries.get_mut(slot)?.as_mut().filter(|&&mut (of, _)| of == generation).map(|(_, value)| value)
    }

    /// What is known of an object; the default if that was nothing.
    pub fn get_or_default(&mut self, id: I) -> &mut T
    where
        T: Default,
    {
        if self.get(id).is_none() {
            self.insert(id, T::default());
        }
        self.get_mut(id).expect("it was inserted")
    }

    /// Whether something is known of an object.
    #[inline]
    pub fn contains(&self, id: I) -> bool {
        self.get(id).is_some()
    }

    /// Forgets an object. Answers what was known of it.
    pub fn remove(&mut self, id: I) -> Option<T> {
        let (slot, generation) = id.parts();
        self.entries.get_mut(slot)?.take_if(|(of, _)| *of == generation).map(|(_, value)| value)
    }

    /// Forgets what was disposed, or is about to be with the next update. Costs a look at every slot.
    pub fn forget_disposed(&mut self, objects: &Objects) {
        for (slot, entry) in self.entries.iter_mut().enumerate() {
            let is_gone =
                |&mut (generation, _): &mut (u32, T)| objects.is_disposed(I::from_parts(slot, generation));
            entry.take_if(is_gone);
        }
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.entries.clear();
    }

    /// How many objects something is known of.
    pub fn len(&self) -> usize {
        self.entries.iter().flatten().count()
    }

    /// Whether nothing is known of anything.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The objects that something is known of, in the order of their slots.
    pub fn ids(&self) -> impl Iterator<Item = I> + '_ {
        self.iter().map(|(id, _)| id)
    }

    /// All that is known, in the order of the objects' slots.
    pub fn iter(&self) -> impl Iterator<Item = (I, &T)> + '_ {
        let entries = self.entries.iter().enumerate();
        entries.filter_map(|(slot, entry)| {
            entry.as_ref().map(|(generation, value)| (I::from_parts(slot, *generation), value))
        })
    }

    /// All that is known, to change, in the order of the objects' slots.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = (I, &mut T)> + '_ {
        let entries = self.entries.iter_mut().enumerate();
        entries.filter_map(|(slot, entry)| {
            entry.as_mut().map(|(generation, value)| (I::from_parts(slot, *generation), value))
        })
    }
}

impl<I: TableId, T> Index<I> for SideTable<I, T> {
    type Output = T;
    /// # Panics
    /// If nothing is known of the object; see [`SideTable::get`].
    #[inline]
    fn index(&self, id: I) -> &T {
        let name: ObjectId = id.into();
        self.get(id).unwrap_or_else(|| panic!("nothing is known of {name:?}"))
    }
}

impl<I: TableId, T> IndexMut<I> for SideTable<I, T> {
    /// # Panics
    /// If nothing is known of the object; see [`SideTable::get_mut`].
    #[inline]
    fn index_mut(&mut self, id: I) -> &mut T {
        let name: ObjectId = id.into();
        self.get_mut(id).unwrap_or_else(|| panic!("nothing is known of {name:?}"))
    }
}
