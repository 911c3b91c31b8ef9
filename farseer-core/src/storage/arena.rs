//! Generational arena: storage with ids that become stale.

use std::marker::PhantomData;

use crate::storage::order::packed_key;
use farseer_precise::reusing_clone;
use serde::{Deserialize, Serialize};

/// Id of a value in an [`Arena`]: slot index and generation.
pub(crate) trait Id: Copy + std::fmt::Debug {
    fn new(index: u32, generation: u32) -> Self;
    fn index(self) -> usize;
    fn generation(self) -> u32;

    /// A number by which ids are ordered.
    fn rank(self) -> u128 {
        packed_key([self.index() as u32, self.generation()])
    }
}

/// Panics: the result of indexing with the id of an object that does not exist any more.
#[cold]
#[inline(never)]
pub(crate) fn stale(id: impl Id) -> ! {
    panic!("{id:?} is stale: what it named was disposed, or is of another simulator")
}

macro_rules! define_id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize)]
        pub struct $name {
            index: u32,
            generation: u32,
        }

        impl $name {
            /// The slot that the id names: small, and reused after disposal. For arrays kept beside the simulator.
            pub fn slot(self) -> usize {
                self.index as usize
            }

            /// The whole id as a number, for formats that store only numbers: the slot in the lower 32 bits, the number
            /// of earlier uses of the slot in the upper ones.
            pub fn to_bits(self) -> u64 {
                u64::from(self.generation) << 32 | u64::from(self.index)
            }

            /// The id with this [number](Self::to_bits). Any other number makes an id that names no object, or another
            /// one.
            pub fn from_bits(bits: u64) -> Self {
                $name { index: bits as u32, generation: (bits >> 32) as u32 }
            }
        }

        impl $crate::storage::arena::Id for $name {
            #[inline(always)]
            fn new(index: u32, generation: u32) -> Self {
                $name { index, generation }
            }
            #[inline(always)]
            fn index(self) -> usize {
                self.index as usize
            }
            #[inline(always)]
            fn generation(self) -> u32 {
                self.generation
            }
        }
    };
}
pub(crate) use define_id;

/// Slots that are reused; every reuse raises the slot's generation, so that an old id finds no value. An arena accepts
/// ids of one type only.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Arena<T, I> {
    slots: Vec<Slot<T>>,
    free: Vec<u32>,
    #[serde(skip)]
    ids: PhantomData<I>,
}

reusing_clone! { [T: Clone, I] Arena<T, I> { slots, free, ids } }

#[derive(Debug, Serialize, Deserialize)]
struct Slot<T> {
    generation: u32,
    value: Option<T>,
}

reusing_clone! { [T: Clone] Slot<T> { generation, value } }

impl<T, I> Default for Arena<T, I> {
    fn default() -> Self {
        Arena { slots: Vec::new(), free: Vec::new(), ids: PhantomData }
    }
}

impl<T, I: Id> Arena<T, I> {
    pub(crate) fn insert(&mut self, value: T) -> I {
        if let Some(index) = self.free.pop() {
            let slot = &mut self.slots[index as usize];
            slot.value = Some(value);
            return I::new(index, slot.generation);
        }
        let index = self.slots.len() as u32;
        self.slots.push(Slot { generation: 0, value: Some(value) });
        I::new(index, 0)
    }

    pub(crate) fn remove(&mut self, id: I) -> Option<T> {
        let slot = self.slots.get_mut(id.index()).filter(|slot| slot.generation == id.generation())?;
        let value = slot.value.take()?;
        // A slot whose generations are used up stays empty: an old id must never find another value.
        if let Some(next) = slot.generation.checked_add(1) {
            slot.generation = next;
            self.free.push(id.index() as u32);
        }
        Some(value)
    }

    /// Undoes the last [`insert`](Self::insert) that was not undone yet, as if it had never happened: its id will be
    /// used again. For ids that nobody else has.
    pub(crate) fn undo_insert(&mut self, id: I) -> Option<T> {
        let slot = self.slots.get_mut(id.index()).filter(|slot| slot.generation == id.generation())?;
        let value = slot.value.take()?;
        let was_appended = id.generation() == 0 && id.index() + 1 == self.slots.len();
        if was_appended {
            self.slots.pop();
        } else {
            self.free.push(id.index() as u32);
        }
        Some(value)
    }

    /// Removes all values; all ids go stale.
    pub(crate) fn clear(&mut self) {
        for index in 0..self.slots.len() {
            let id = I::new(index as u32, self.slots[index].generation);
            self.remove(id);
        }
    }

    #[inline(always)]
    pub(crate) fn get(&self, id: I) -> Option<&T> {
        let slot = self.slots.get(id.index())?;
        if slot.generation == id.generation() { slot.value.as_ref() } else { None }
    }

    #[inline(always)]
    pub(crate) fn get_mut(&mut self, id: I) -> Option<&mut T> {
        let slot = self.slots.get_mut(id.index())?;
        if slot.generation == id.generation() { slot.value.as_mut() } else { None }
    }

    #[inline(always)]
    pub(crate) fn contains(&self, id: I) -> bool {
        self.get(id).is_some()
    }

    /// Number of slots, used or not: greater than every index.
    pub(crate) fn slot_count(&self) -> usize {
        self.slots.len()
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = (I, &T)> {
        self.slots.iter().enumerate().filter_map(|(index, slot)| {
            slot.value.as_ref().map(|value| (I::new(index as u32, slot.generation), value))
        })
    }

    /// All values, in the order of their slots.
    pub(crate) fn values_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.slots.iter_mut().filter_map(|slot| slot.value.as_mut())
    }

    /// Whether the free list contains exactly the empty slots, once each, without those that are used up. False only
    /// after loading corrupt data.
    pub(crate) fn is_consistent(&self) -> bool {
        let mut empty: Vec<bool> = self.slots.iter().map(|slot| slot.value.is_none()).collect();
        let listed_once = self.free.iter().all(|&index| {
            empty.get_mut(index as usize).is_some_and(|is_empty| std::mem::replace(is_empty, false))
        });
        let are_used_up =
            self.slots.iter().zip(empty).all(|(slot, is_lost)| !is_lost || slot.generation == u32::MAX);
        listed_once && are_used_up
    }
}

impl<T, I: Id> std::ops::Index<I> for Arena<T, I> {
    type Output = T;
    #[inline(always)]
    fn index(&self, id: I) -> &T {
        self.get(id).unwrap_or_else(|| stale(id))
    }
}

impl<T, I: Id> std::ops::IndexMut<I> for Arena<T, I> {
    #[inline(always)]
    fn index_mut(&mut self, id: I) -> &mut T {
        self.get_mut(id).unwrap_or_else(|| stale(id))
    }
}
