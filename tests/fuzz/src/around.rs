//! Games that play another game and make calls of their own between its calls.

use crate::game::{Call, Game};
use crate::random::Random;

/// A game around an inner game. It has no simulator and no random numbers of its own; it uses those of the inner game.
pub trait GameWrapper: Sized + 'static {
    /// Type of the inner game.
    type Inner: Game;

    /// Returns the inner game at its start.
    fn begin(random: Random) -> Self::Inner {
        Self::Inner::new(random)
    }
    /// Returns a game around an inner game that has begun.
    fn wrap(inner: Self::Inner) -> Self;
    /// Returns all calls of the game. The first call must make an object with a body and a geom.
    fn calls() -> &'static [Call<Self>];
    /// Returns the inner game.
    fn inner(&self) -> &Self::Inner;
    /// Returns the inner game, for calls that change it.
    fn inner_mut(&mut self) -> &mut Self::Inner;
}

impl<G: GameWrapper> Game for G {
    type Simulator = <G::Inner as Game>::Simulator;
    const SCENES: usize = G::Inner::SCENES;

    fn new(random: Random) -> Self {
        G::wrap(G::begin(random))
    }
    fn of(simulator: Self::Simulator, random: Random) -> Self {
        G::wrap(G::Inner::of(simulator, random))
    }
    fn scene(kind: usize) -> Self::Simulator {
        G::Inner::scene(kind)
    }
    fn calls() -> &'static [Call<Self>] {
        <G as GameWrapper>::calls()
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
