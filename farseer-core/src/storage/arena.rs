//! Storage with ids that notice when they have gone stale.

use std::marker::PhantomData;

use crate::storage::order::joined;
use crate::storage::reusing_clone::reusing_clone;
use serde::{Deserialize, Serialize};

/// A place in an [`Arena`] and the generation of what lies there.
pub(crate) trait Id: Copy + std::fmt::Debug {
    fn new(index: u32, generation: u32) -> Self;
    fn index(self) -> usize;
    fn generation(self) -> u32;

    /// A number that has the order of ids.
    fn rank(self) -> u128 {
        joined([self.index() as u32, self.generation()])
    }
}

/// What indexing by the id of something that is gone comes to.
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
            /// The slot the id names: small, and reused after disposal. For arrays kept beside the simulator.
            pub fn slot(self) -> usize {
                self.index as usize
            }

            /// The whole id as a number, for what can keep nothing but numbers: the slot in the lower 32 bits, how often
            /// that was used before in the upper ones.
            pub fn to_bits(self) -> u64 {
                u64::from(self.generation) << 32 | u64::from(self.index)
            }

            /// The id whose [number](Self::to_bits) this is. Any other number makes an id that names nothing, or
            /// something else.
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

/// Slots that are reused; every reuse raises the slot's generation, so that an old id finds nothing. Takes ids of one
/// kind only.
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
        // A slot whose generations are used up stays empty for good: an old id must never find something else.
        if let Some(next) = slot.generation.checked_add(1) {
            slot.generation = next;
            self.free.push(id.index() as u32);
        }
        Some(value)
    }

    /// Undoes the last [`insert`](Self::insert) that was not undone yet, as if it had never been: its id will be given
    /// out again. For what nobody knows yet.
    pub(crate) fn take_back(&mut self, id: I) -> Option<T> {
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

    /// Removes everything; all ids go stale.
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

    /// Number of slots, used or not: the bound of every index.
    pub(crate) fn slot_count(&self) -> usize {
        self.slots.len()
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = (I, &T)> {
        self.slots.iter().enumerate().filter_map(|(index, slot)| {
            slot.value.as_ref().map(|value| (I::new(index as u32, slot.generation), value))
        })
    }

    /// Whether the free list names exactly the empty slots, once each, but for those that are used up: false only after
    /// loading garbage.
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
