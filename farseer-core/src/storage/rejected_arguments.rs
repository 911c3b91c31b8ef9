//! Arguments that setters have rejected, until they are reported.

use std::marker::PhantomData;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};

/// The names of all arguments that the setters of one kind of object reject: at most 256.
pub trait ArgumentNames {
    /// The names, each once.
    const NAMES: &'static [&'static str];
}

/// Number of rejections of an object up to which each is recorded, also repeated ones.
const MAX_REPORTED_REPEATS: usize = 16;

/// The arguments that the setters of one object have rejected since the last report, in order. Each rejection is
/// recorded; after sixteen only arguments that were not rejected before, each once. So the list stays short if no one
/// reads it. For engines that keep settings of their own.
///
/// A save contains their names; loading one that is not a name of `A` is an error.
///
/// ```
/// use farseer_core::{ArgumentNames, RejectedArguments};
///
/// struct Names;
/// impl ArgumentNames for Names {
///     const NAMES: &'static [&'static str] = &["width", "height"];
/// }
///
/// let mut refusals = RejectedArguments::<Names>::default();
/// refusals.note("height");
/// refusals.note("width");
/// assert_eq!(refusals.take().collect::<Vec<_>>(), ["height", "width"]);
/// assert!(refusals.is_empty());
/// ```
pub struct RejectedArguments<A> {
    /// Indices into the list of names.
    refused: Vec<u8>,
    names: PhantomData<A>,
}

impl<A: ArgumentNames> RejectedArguments<A> {
    /// Records that an argument was rejected.
    ///
    /// # Panics
    /// If the name is not a name of `A`.
    #[cold]
    pub fn note(&mut self, argument: &'static str) {
        let place = A::NAMES.iter().position(|&name| name == argument);
        let place = place.expect("the list names every argument that is refused") as u8;
        if self.refused.len() < MAX_REPORTED_REPEATS || !self.refused.contains(&place) {
            self.refused.push(place);
        }
    }

    /// Whether no argument was rejected.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.refused.is_empty()
    }

    /// Returns the names of the rejected arguments and clears the list.
    #[inline]
    pub fn take(&mut self) -> impl Iterator<Item = &'static str> {
        self.refused.drain(..).map(name::<A>)
    }

    fn names(&self) -> impl Iterator<Item = &'static str> {
        self.refused.iter().copied().map(name::<A>)
    }
}

fn name<A: ArgumentNames>(place: u8) -> &'static str {
    A::NAMES[usize::from(place)]
}

impl<A> Default for RejectedArguments<A> {
    fn default() -> Self {
        RejectedArguments { refused: Vec::new(), names: PhantomData }
    }
}

impl<A> Clone for RejectedArguments<A> {
    fn clone(&self) -> Self {
        RejectedArguments { refused: self.refused.clone(), names: PhantomData }
    }
}

impl<A: ArgumentNames> std::fmt::Debug for RejectedArguments<A> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.names()).finish()
    }
}

impl<A: ArgumentNames> Serialize for RejectedArguments<A> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.names().collect::<Vec<_>>().serialize(serializer)
    }
}

impl<'de, A: ArgumentNames> Deserialize<'de> for RejectedArguments<A> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let mut refusals = RejectedArguments::default();
        for refused in Vec::<String>::deserialize(deserializer)? {
            let known = A::NAMES.iter().find(|&&name| name == refused);
            refusals.note(known.ok_or_else(|| D::Error::custom("a refused argument that there is not"))?);
        }
        Ok(refusals)
    }
}
