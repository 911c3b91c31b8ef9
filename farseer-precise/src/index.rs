//! Typed indices: a list says by its type by which kind of index its entries are found.
//!
//! An index is 4 bytes long. It names an entry of the lists of one [`Solver`](crate::Solver) until a rebuild or a removal
//! moves that entry.

use crate::reusing_clone;
use std::fmt;
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut, Index, IndexMut, Range};
use std::slice::SliceIndex;

/// An index of one kind.
pub trait DenseIndex: Copy + Eq + Ord + fmt::Debug {
    /// Returns the index with a position in its lists, 0..2^32.
    fn new(position: usize) -> Self;

    /// Returns the position in its lists, 0..2^32.
    fn position(self) -> usize;

    /// Returns the index that follows this one.
    #[inline(always)]
    fn next(self) -> Self {
        Self::new(self.position() + 1)
    }
}

/// Defines a type of indices: `index_type! { /// Doc. pub struct BodyIndex; }`.
#[macro_export]
macro_rules! index_type {
    ($(#[$doc:meta])* $visibility:vis struct $name:ident;) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, serde::Serialize, serde::Deserialize)]
        #[repr(transparent)]
        #[serde(transparent)]
        $visibility struct $name(pub u32);

        impl $crate::index::DenseIndex for $name {
            #[inline(always)]
            fn new(position: usize) -> Self {
                debug_assert!(u32::try_from(position).is_ok(), "{position} positions exceed the range of an index");
                $name(position as u32)
            }

            #[inline(always)]
            fn position(self) -> usize {
                self.0 as usize
            }
        }

        impl std::fmt::Debug for $name {
            fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "{}", self.0)
            }
        }
    };
}

#[cfg(feature = "engine")]
pub(crate) use index_type;

index_type! {
    /// Index of a body in the lists of [`BodySet`](crate::bodies::BodySet).
    pub struct BodyIndex;
}
impl BodyIndex {
    /// Index of the placeholder: every static body in a constraint, and the world in a joint.
    pub const PLACEHOLDER: BodyIndex = BodyIndex(0);
}

index_type! {
    /// Index of a proxy: a convex piece of a geom in the broad phase.
    pub struct ProxyIndex;
}
index_type! {
    /// Index of a pair of proxies whose fat AABBs overlap.
    pub struct PairIndex;
}

/// A list whose entries are found by an index of type `I`. It dereferences to a slice for everything that needs no single
/// position: its length, iteration, chunks. The serialized form is that of the entries.
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(transparent, bound(serialize = "T: serde::Serialize", deserialize = "T: serde::Deserialize<'de>"))]
pub struct IndexedVec<I, T> {
    /// The entries, by the position of their indices.
    entries: Vec<T>,
    /// The list contains no index.
    index: PhantomData<fn(I)>,
}

reusing_clone! {
    [I, T: Clone] IndexedVec<I, T> { entries, index }
}

impl<I: DenseIndex, T> IndexedVec<I, T> {
    /// Appends an entry and returns its index.
    #[inline]
    pub fn push(&mut self, entry: T) -> I {
        self.entries.push(entry);
        I::new(self.entries.len() - 1)
    }

    /// Returns the entry at an index; `None` beyond the end.
    #[inline]
    pub fn at(&self, index: I) -> Option<&T> {
        self.entries.get(index.position())
    }

    /// Returns the entry at an index, to change; `None` beyond the end.
    #[inline]
    pub fn at_mut(&mut self, index: I) -> Option<&mut T> {
        self.entries.get_mut(index.position())
    }

    /// Returns the entries at positions.
    #[inline(always)]
    pub fn slice(&self, positions: impl SliceIndex<[T], Output = [T]>) -> &[T] {
        &self.entries[positions]
    }

    /// Returns the entries at positions, to change.
    #[inline(always)]
    pub fn slice_mut(&mut self, positions: impl SliceIndex<[T], Output = [T]>) -> &mut [T] {
        &mut self.entries[positions]
    }

    /// Returns the whole list, borrowed.
    #[inline(always)]
    pub fn borrowed(&self) -> IndexedSlice<'_, I, T> {
        IndexedSlice { entries: &self.entries, index: PhantomData }
    }

    /// Returns the index that the next entry will have.
    #[inline]
    pub fn next_index(&self) -> I {
        I::new(self.entries.len())
    }

    /// Iterates over all indices, ascending.
    #[inline]
    pub fn indices(&self) -> impl DoubleEndedIterator<Item = I> + ExactSizeIterator + use<I, T> {
        (0..self.entries.len()).map(I::new)
    }

    /// Iterates over all entries with their indices, ascending.
    #[inline]
    pub fn enumerated(&self) -> impl DoubleEndedIterator<Item = (I, &T)> + ExactSizeIterator {
        self.entries.iter().enumerate().map(|(position, entry)| (I::new(position), entry))
    }

    /// Returns the entry at an index, to change. A shorter list grows with default values to hold the entry.
    pub fn at_or_grow(&mut self, index: I) -> &mut T
    where
        T: Clone + Default,
    {
        if self.entries.len() <= index.position() {
            self.entries.resize(index.position() + 1, T::default());
        }
        &mut self.entries[index.position()]
    }

    /// Makes room for `additional` more entries.
    pub fn reserve(&mut self, additional: usize) {
        self.entries.reserve(additional);
    }

    /// Removes all entries.
    #[inline]
    pub fn clear(&mut self) {
        self.entries.clear();
    }

    /// Removes the last entry and returns it; `None` if the list is empty.
    #[inline]
    pub fn pop(&mut self) -> Option<T> {
        self.entries.pop()
    }

    /// Exchanges two entries.
    #[inline]
    pub fn swap(&mut self, one: I, other: I) {
        self.entries.swap(one.position(), other.position());
    }

    /// Removes an entry and returns it. The last entry takes its place.
    #[inline]
    pub fn swap_remove(&mut self, index: I) -> T {
        self.entries.swap_remove(index.position())
    }

    /// Returns the list without its type of index, to grow or shorten it.
    #[inline]
    pub fn as_vec_mut(&mut self) -> &mut Vec<T> {
        &mut self.entries
    }
}

impl<I: DenseIndex, T: Clone> IndexedVec<I, T> {
    /// Returns a list of `count` copies of an entry.
    pub fn of_copies(entry: T, count: usize) -> Self {
        IndexedVec { entries: vec![entry; count], index: PhantomData }
    }

    /// Shortens the list to `count` entries, or appends copies of an entry up to that number.
    #[inline]
    pub fn resize(&mut self, count: usize, entry: T) {
        self.entries.resize(count, entry);
    }
}

impl<I, T> FromIterator<T> for IndexedVec<I, T> {
    fn from_iter<Entries: IntoIterator<Item = T>>(entries: Entries) -> Self {
        IndexedVec { entries: entries.into_iter().collect(), index: PhantomData }
    }
}

impl<I, T> Extend<T> for IndexedVec<I, T> {
    fn extend<Entries: IntoIterator<Item = T>>(&mut self, entries: Entries) {
        self.entries.extend(entries);
    }
}

impl<'a, I, T> IntoIterator for &'a IndexedVec<I, T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;

    #[inline(always)]
    fn into_iter(self) -> Self::IntoIter {
        self.entries.iter()
    }
}

impl<'a, I, T> IntoIterator for &'a mut IndexedVec<I, T> {
    type Item = &'a mut T;
    type IntoIter = std::slice::IterMut<'a, T>;

    #[inline(always)]
    fn into_iter(self) -> Self::IntoIter {
        self.entries.iter_mut()
    }
}

/// Consecutive indices, an iterator over them.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct IndexRange<I> {
    /// First index.
    pub start: I,
    /// Index behind the last one; it does not belong to the range.
    pub end: I,
}

impl<I: DenseIndex> IndexRange<I> {
    /// Returns `count` indices from `start` on.
    #[inline]
    pub fn new(start: I, count: usize) -> Self {
        IndexRange { start, end: I::new(start.position() + count) }
    }

    /// Returns whether no index is left.
    #[inline]
    pub fn has_ended(&self) -> bool {
        self.start >= self.end
    }
}

impl<I: DenseIndex> Iterator for IndexRange<I> {
    type Item = I;

    #[inline]
    fn next(&mut self) -> Option<I> {
        let first = (self.start < self.end).then_some(self.start)?;
        self.start = first.next();
        Some(first)
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        let count = self.end.position().saturating_sub(self.start.position());
        (count, Some(count))
    }
}

impl<I: DenseIndex> DoubleEndedIterator for IndexRange<I> {
    #[inline]
    fn next_back(&mut self) -> Option<I> {
        if self.has_ended() {
            return None;
        }
        self.end = I::new(self.end.position() - 1);
        Some(self.end)
    }
}

impl<I: DenseIndex> ExactSizeIterator for IndexRange<I> {}

impl<I, T: PartialEq> PartialEq for IndexedVec<I, T> {
    fn eq(&self, other: &Self) -> bool {
        self.entries == other.entries
    }
}

impl<I, T> Default for IndexedVec<I, T> {
    fn default() -> Self {
        IndexedVec { entries: Vec::new(), index: PhantomData }
    }
}

impl<I, T: fmt::Debug> fmt::Debug for IndexedVec<I, T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.entries.fmt(formatter)
    }
}

impl<I: DenseIndex, T> Index<I> for IndexedVec<I, T> {
    type Output = T;

    #[inline(always)]
    fn index(&self, index: I) -> &T {
        &self.entries[index.position()]
    }
}

impl<I: DenseIndex, T> IndexMut<I> for IndexedVec<I, T> {
    #[inline(always)]
    fn index_mut(&mut self, index: I) -> &mut T {
        &mut self.entries[index.position()]
    }
}

impl<I, T> Deref for IndexedVec<I, T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        &self.entries
    }
}

impl<I, T> DerefMut for IndexedVec<I, T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.entries
    }
}

/// A borrowed list whose entries are found by an index of type `I`. In a loop that changes other lists the compiler does not read
/// again where the list is.
pub struct IndexedSlice<'a, I, T> {
    /// The entries, by the position of their indices.
    entries: &'a [T],
    /// The list contains no index.
    index: PhantomData<fn(I)>,
}

impl<I, T> Clone for IndexedSlice<'_, I, T> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<I, T> Copy for IndexedSlice<'_, I, T> {}

impl<I: DenseIndex, T> Index<I> for IndexedSlice<'_, I, T> {
    type Output = T;

    #[inline(always)]
    fn index(&self, index: I) -> &T {
        &self.entries[index.position()]
    }
}

/// The ranges of lists that follow each other in one buffer, found by the index of each list. [`count`](Self::count) and
/// [`begin_lists`](Self::begin_lists) build them; a copy then yields with [`next_position`](Self::next_position) where each entry
/// goes.
#[derive(Debug)]
pub struct ListRanges<I> {
    /// Position of the first entry of each list; the last element is the number of all entries.
    starts: Vec<u32>,
    /// The ranges contain no index.
    index: PhantomData<fn(I)>,
}

reusing_clone! {
    [I] ListRanges<I> { starts, index }
}

impl<I> Default for ListRanges<I> {
    fn default() -> Self {
        ListRanges { starts: vec![0], index: PhantomData }
    }
}

impl<I: DenseIndex> ListRanges<I> {
    /// Makes `count` empty lists.
    pub fn reset(&mut self, count: usize) {
        self.starts.clear();
        self.starts.resize(count + 1, 0);
    }

    /// Counts an entry of a list, before [`begin_lists`](Self::begin_lists).
    #[inline]
    pub fn count(&mut self, list: I) {
        self.starts[list.position() + 1] += 1;
    }

    /// Returns the number of lists.
    pub fn list_count(&self) -> usize {
        self.starts.len() - 1
    }

    /// Lets each list begin where the one before it ends.
    pub fn begin_lists(&mut self) {
        let mut sum = 0;
        for start in &mut self.starts {
            sum += *start;
            *start = sum;
        }
    }

    /// Returns the number of entries of all lists.
    pub fn total(&self) -> usize {
        self.starts.last().map_or(0, |&total| total as usize)
    }

    /// Returns the positions of the entries of a list.
    #[inline(always)]
    pub fn range(&self, list: I) -> Range<usize> {
        self.starts[list.position()] as usize..self.starts[list.position() + 1] as usize
    }

    /// Returns the position where a list begins, and lets it begin one entry later.
    #[inline]
    pub fn next_position(&mut self, list: I) -> usize {
        let start = &mut self.starts[list.position()];
        *start += 1;
        *start as usize - 1
    }
}
