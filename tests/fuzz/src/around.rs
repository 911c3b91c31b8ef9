//! Games that play another one, with calls of their own amid its calls.

use crate::game::{Call, Game};
use crate::random::Random;

/// A game around another one, whose simulator and random numbers are its own.
pub trait Around: Sized + 'static {
    /// The other one.
    type Inner: Game;

    /// What it begins with.
    fn begin(random: Random) -> Self::Inner {
        Self::Inner::new(random)
    }
    /// The game around one that has begun.
    fn around(inner: Self::Inner) -> Self;
    /// Everything it can do. The first makes a thing with body and geom.
    fn calls() -> &'static [Call<Self>];
    /// The game that it is around.
    fn inner(&self) -> &Self::Inner;
    /// The same, to be played.
    fn inner_mut(&mut self) -> &mut Self::Inner;
}

impl<G: Around> Game for G {
    type Simulator = <G::Inner as Game>::Simulator;
    const SCENES: usize = G::Inner::SCENES;

    fn new(random: Random) -> Self {
        G::around(G::begin(random))
    }
    fn of(simulator: Self::Simulator, random: Random) -> Self {
        G::around(G::Inner::of(simulator, random))
    }
    fn scene(kind: usize) -> Self::Simulator {
        G::Inner::scene(kind)
    }
    fn calls() -> &'static [Call<Self>] {
        <G as Around>::calls()
    }
    fn random(&mut self) -> &mut Random {
        self.inner_mut().random()
    }
    fn simulator(&self) -> &Self::Simulator {
        self.inner().simulator()
    }
    fn simulator_mut(&mut self) -> &mut Self::Simulator {
        self.inner_mut().simulator_mut()
    }
}
