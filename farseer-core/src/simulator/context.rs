//! What a callback sees of the simulator that calls it.

use std::ops::{Deref, DerefMut};

use super::PhysicsSimulator;
use crate::objects::Objects;

/// What a callback may do to the simulator that calls it: everything that [`Objects`] offers, at once. What it adds,
/// removes or disposes enters or leaves with the next update.
#[derive(Debug)]
pub struct Context<'a> {
    pub(super) simulator: &'a mut PhysicsSimulator,
}

impl Context<'_> {
    /// The same for a shorter time: for engines that hand it on inside a context of their own.
    pub fn reborrow(&mut self) -> Context<'_> {
        Context { simulator: self.simulator }
    }

    /// The simulator, to look at everything and to ask its queries. In the middle of an update it shows what the
    /// stages have done so far.
    pub fn simulator(&self) -> &PhysicsSimulator {
        self.simulator
    }
}

impl Deref for Context<'_> {
    type Target = Objects;
    #[inline]
    fn deref(&self) -> &Objects {
        self.simulator
    }
}

impl DerefMut for Context<'_> {
    #[inline]
    fn deref_mut(&mut self) -> &mut Objects {
        self.simulator
    }
}
