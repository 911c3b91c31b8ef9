//! What setters have refused and nobody was told of yet.

use std::marker::PhantomData;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};

/// The names of all arguments that the setters of one kind of object refuse: at most 256.
pub trait ArgumentNames {
    /// Each once.
    const NAMES: &'static [&'static str];
}

/// As many refusals of an object are told one by one.
const TOLD_EACH: usize = 16;

/// The arguments that one object has refused since it was last asked, in the order in which it did. Each refusal is told;
/// but when there are sixteen, only further arguments, each once: so they do not pile up where nobody asks. For engines
/// that keep settings of their own.
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
/// refusals.note("width");
/// assert_eq!(refusals.take().collect::<Vec<_>>(), ["height", "width"]);
/// assert!(refusals.is_empty());
/// ```
pub struct Refusals<A> {
    /// Places in the list of names.
    refused: Vec<u8>,
    names: PhantomData<A>,
}

impl<A: ArgumentNames> Refusals<A> {
    /// Notes that an argument was refused.
    ///
    /// # Panics
    /// If the name is none of `A`.
    #[cold]
    pub fn note(&mut self, argument: &'static str) {
        let place = A::NAMES.iter().position(|&name| name == argument);
        let place = place.expect("the list names every argument that is refused") as u8;
        if self.refused.len() < TOLD_EACH || !self.refused.contains(&place) {
            self.refused.push(place);
        }
    }

    /// Whether nothing was refused.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.refused.is_empty()
    }

    /// The names of what was refused; from now on nothing was.
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

impl<A> Default for Refusals<A> {
    fn default() -> Self {
        Refusals { refused: Vec::new(), names: PhantomData }
    }
}

impl<A> Clone for Refusals<A> {
    fn clone(&self) -> Self {
        Refusals { refused: self.refused.clone(), names: PhantomData }
    }
}

impl<A: ArgumentNames> std::fmt::Debug for Refusals<A> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.names()).finish()
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
