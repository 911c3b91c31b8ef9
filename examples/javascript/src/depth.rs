//! The 2.5D engine, and the state that it leaves to the game.

use farseer_core::snapshot::SnapshotFormat;
use farseer_core::{BodyId, SecondaryMap};
use twohalf::{CharacterController, CharacterSettings, DrawOrder, PlatformId, TwoHalfPhysicsSimulator};

use crate::boundary::{Answer, Argument, Failure, Outcome};
use crate::world::{Engine, Simulator, put};

#[derive(Debug)]
pub(crate) struct Depth {
    pub(crate) simulator: TwoHalfPhysicsSimulator,
    pub(crate) walkers: SecondaryMap<BodyId, CharacterController>,
    pub(crate) order: DrawOrder,
}

/// A snapshot in 2.5D, with the character controllers.
pub const WITH_WALKERS: SnapshotFormat = SnapshotFormat { magic: *b"Walkers2", version: 2 };

impl Depth {
    pub(crate) fn update(&mut self, dt: f32) {
        let Depth { simulator, walkers, .. } = self;
        simulator.update(dt);
        walkers.forget_disposed(simulator.core());
    }

    /// The character controller of a body, or a default one.
    pub(crate) fn walker(&self, body: BodyId) -> CharacterController {
        self.walkers
            .get(body)
            .copied()
            .unwrap_or_else(|| CharacterController::new(CharacterSettings::default()))
    }

    pub(crate) fn snapshot(&self) -> Vec<u8> {
        let walkers: Vec<(BodyId, CharacterController)> =
            self.walkers.iter().map(|(body, walker)| (body, *walker)).collect();
        WITH_WALKERS.write(&(walkers, self.simulator.snapshot()))
    }

    pub(crate) fn restore(&mut self, snapshot: &[u8]) -> Outcome {
        let (walkers, snapshot): (Vec<(BodyId, CharacterController)>, Vec<u8>) =
            WITH_WALKERS.read(snapshot)?;
        self.simulator.restore(&snapshot)?;
        self.walkers.clear();
        // A damaged snapshot may name any slot.
        let is_there = |body: BodyId| self.simulator.body(body).is_some();
        for (body, walker) in walkers.into_iter().filter(|&(body, _)| is_there(body)) {
            self.walkers.insert(body, walker);
        }
        Ok(())
    }

    /// Where everything is: x, y, z and rotation of each body, in rows by slots.
    pub(crate) fn put_positions(&self, positions: &mut Vec<f32>) {
        for body in self.simulator.core().bodies() {
            if let Some(of) = self.simulator.body(body) {
                let [x, y, z] = of.position3d().into();
                put(positions, body, [x, y, z, of.rotation()]);
            }
        }
    }
}

impl Simulator {
    pub(crate) fn depth<T>(self, act: impl FnOnce(&mut Depth) -> Outcome<T>) -> Outcome<T> {
        self.with(|world| match &mut world.engine {
            Engine::Depth(depth) => act(depth),
            Engine::Plane(_) => Err(Failure::because(&"only a DepthSimulator can do that")),
        })
    }
}

impl From<twohalf::Error> for Failure {
    #[cold]
    #[inline(never)]
    fn from(error: twohalf::Error) -> Self {
        Failure::because(&error)
    }
}

/// Numbers of platforms are never given out twice.
impl Argument for PlatformId {
    const REQUIREMENT: &'static str = "an id";

    fn read(number: f64) -> Option<Self> {
        usize::read(number).map(|number| PlatformId::from_bits(number as u32))
    }
}

impl Answer for PlatformId {
    fn number(self) -> Outcome<f64> {
        Ok(f64::from(self.to_bits()))
    }
}
