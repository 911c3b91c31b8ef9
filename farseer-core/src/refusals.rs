//! What setters have refused and nobody was told of yet.

use std::marker::PhantomData;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};

/// The names of all arguments that the setters of one kind of object refuse: at most 32.
pub trait ArgumentNames {
    /// In the order in which refusals are told.
    const NAMES: &'static [&'static str];
}

/// The arguments that one object has refused since it was last asked: each is told once, however often it was refused
/// meanwhile. For engines that keep settings of their own.
///
/// A save lists their names; one that is none of `A` is damage.
///
/// ```
/// use farseer_core::{ArgumentNames, Refusals};
///
/// struct Names;
/// impl ArgumentNames for Names {
///     const NAMES: &'static [&'static str] = &["width", "height"];
/// }
///
/// let mut refusals = Refusals::<Names>::default();
/// refusals.note("height");
/// refusals.note("height");
/// assert_eq!(refusals.take().collect::<Vec<_>>(), ["height"]);
/// assert!(refusals.is_empty());
/// ```
pub struct Refusals<A> {
    /// One bit per name.
    bits: u32,
    names: PhantomData<A>,
}

impl<A: ArgumentNames> Refusals<A> {
    /// Notes that an argument was refused.
    ///
    /// # Panics
    /// If the name is none of `A`.
    #[cold]
    pub fn note(&mut self, argument: &'static str) {
        let index = A::NAMES.iter().position(|&name| name == argument);
        self.bits |= 1 << index.expect("the list names every argument that is refused");
    }

    /// Whether nothing was refused.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.bits == 0
    }

    /// The names of what was refused, in the order of [`ArgumentNames::NAMES`]; from now on nothing was.
    #[inline]
    pub fn take(&mut self) -> impl Iterator<Item = &'static str> + use<A> {
        std::mem::take(self).names()
    }

    fn names(self) -> impl Iterator<Item = &'static str> + use<A> {
        (0..).zip(A::NAMES).filter(move |(index, _)| self.bits & 1 << index != 0).map(|(_, &name)| name)
    }
}

impl<A> Default for Refusals<A> {
    fn default() -> Self {
        Refusals { bits: 0, names: PhantomData }
    }
}

impl<A> Clone for Refusals<A> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<A> Copy for Refusals<A> {}

impl<A: ArgumentNames> std::fmt::Debug for Refusals<A> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_set().entries(self.names()).finish()
    }
}

impl<A: ArgumentNames> Serialize for Refusals<A> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.names().collect::<Vec<_>>().serialize(serializer)
    }
}

impl<'de, A: ArgumentNames> Deserialize<'de> for Refusals<A> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let mut refusals = Refusals::default();
        for refused in Vec::<String>::deserialize(deserializer)? {
            let known = A::NAMES.iter().find(|&&name| name == refused);
            refusals.note(known.ok_or_else(|| D::Error::custom("a refused argument that there is not"))?);
        }
        Ok(refusals)
    }
}
