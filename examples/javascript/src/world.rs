//! The simulators that JavaScript holds by number.

use std::cell::RefCell;
use std::collections::BTreeMap;

use farseer_core::snapshot::SnapshotFormat;
use farseer_core::{Body, BodyId, Error, Geom, GeomId, GeomRef, Objects, PhysicsSimulator};
use twohalf::{DrawOrder, TwoHalfPhysicsSimulator, Walker};

use crate::boundary::{Argument, Failure, Outcome};
use crate::touches::Log;

/// One of the two engines.
#[derive(Debug)]
pub(crate) enum Engine {
    Plane(Box<PhysicsSimulator>),
    Depth(Box<Depth>),
}

/// The 2.5D engine, and what it leaves to the game to keep.
#[derive(Debug)]
pub(crate) struct Depth {
    pub(crate) simulator: TwoHalfPhysicsSimulator,
    pub(crate) walkers: BTreeMap<BodyId, Walker>,
    pub(crate) order: DrawOrder,
}

/// A simulator and what is told of it.
#[derive(Debug)]
pub(crate) struct World {
    pub(crate) engine: Engine,
    pub(crate) log: Log,
    positions: Vec<f32>,
}

/// The number of a simulator.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Simulator(usize);

thread_local! {
    static WORLDS: RefCell<Vec<Option<World>>> = const { RefCell::new(Vec::new()) };
}

impl Argument for Simulator {
    fn read(_: &'static str, number: f64) -> Outcome<Self> {
        usize::read("simulator", number).map(Simulator)
    }
}

impl Simulator {
    /// Keeps a new one; answers its number.
    pub(crate) fn keep(engine: Engine) -> f64 {
        let world = World { engine, log: Log::default(), positions: Vec::new() };
        WORLDS.with_borrow_mut(|worlds| {
            let free = worlds.iter().position(Option::is_none).unwrap_or(worlds.len());
            if free == worlds.len() {
                worlds.push(None);
            }
            worlds[free] = Some(world);
            free as f64
        })
    }

    /// Lets it go.
    pub(crate) fn free(self) -> Outcome {
        let world = WORLDS.with_borrow_mut(|worlds| worlds.get_mut(self.0).and_then(Option::take));
        world.map(drop).ok_or_else(no_simulator)
    }

    pub(crate) fn with<T>(self, act: impl FnOnce(&mut World) -> Outcome<T>) -> Outcome<T> {
        WORLDS.with_borrow_mut(|worlds| {
            act(worlds.get_mut(self.0).and_then(Option::as_mut).ok_or_else(no_simulator)?)
        })
    }

    /// After something that ends touches of which the engines do not tell.
    pub(crate) fn doubt(self) -> Outcome {
        self.with(|world| {
            world.log.doubt();
            Ok(())
        })
    }

    /// Does something to what both engines have.
    pub(crate) fn objects<T>(self, edit: impl FnOnce(&mut Objects) -> farseer_core::Result<T>) -> Outcome<T> {
        self.with(|world| Ok(world.engine.objects(edit)?))
    }

    pub(crate) fn body<T>(self, body: BodyId, look: impl FnOnce(&Body) -> T) -> Outcome<T> {
        let stale = Error::StaleId { argument: "body" };
        self.with(|world| Ok(look(world.engine.core().body(body).ok_or(stale)?)))
    }

    pub(crate) fn edit_body<T>(self, body: BodyId, edit: impl FnOnce(&mut Body) -> T) -> Outcome<T> {
        let stale = Error::StaleId { argument: "body" };
        self.with(|world| match &mut world.engine {
            Engine::Plane(simulator) => Ok(edit(simulator.body_mut(body).ok_or(stale)?)),
            Engine::Depth(depth) => Ok(edit(depth.simulator.body_mut(body).ok_or(stale)?.core_mut())),
        })
    }

    pub(crate) fn geom<T>(self, geom: GeomId, look: impl FnOnce(GeomRef<'_>) -> T) -> Outcome<T> {
        let stale = Error::StaleId { argument: "geom" };
        self.with(|world| Ok(look(world.engine.core().geom(geom).ok_or(stale)?)))
    }

    pub(crate) fn edit_geom<T>(self, geom: GeomId, edit: impl FnOnce(&mut Geom) -> T) -> Outcome<T> {
        let stale = Error::StaleId { argument: "geom" };
        self.with(|world| match &mut world.engine {
            Engine::Plane(simulator) => Ok(edit(simulator.geom_mut(geom).ok_or(stale)?)),
            Engine::Depth(depth) => Ok(edit(depth.simulator.geom_mut(geom).ok_or(stale)?)),
        })
    }

    pub(crate) fn plane<T>(self, act: impl FnOnce(&mut PhysicsSimulator) -> Outcome<T>) -> Outcome<T> {
        self.with(|world| match &mut world.engine {
            Engine::Plane(simulator) => act(simulator),
            Engine::Depth(_) => Err(Failure("only a Simulator can do that, not a DepthSimulator".to_owned())),
        })
    }

    pub(crate) fn depth<T>(self, act: impl FnOnce(&mut Depth) -> Outcome<T>) -> Outcome<T> {
        self.with(|world| match &mut world.engine {
            Engine::Depth(depth) => act(depth),
            Engine::Plane(_) => Err(Failure("only a DepthSimulator can do that".to_owned())),
        })
    }
}

/// Does what both engines do by the same name.
macro_rules! either {
    ($simulator:expr, |$engine:ident| $act:expr) => {
        $simulator.with(|world| {
            match &mut world.engine {
                $crate::world::Engine::Plane($engine) => $act,
                $crate::world::Engine::Depth(depth) => {
                    let $engine = &mut depth.simulator;
                    $act
                }
            }
            Ok(())
        })
    };
}
pub(crate) use either;

fn no_simulator() -> Failure {
    Failure("the simulator was freed".to_owned())
}

impl Engine {
    pub(crate) fn core(&self) -> &PhysicsSimulator {
        match self {
            Engine::Plane(simulator) => simulator,
            Engine::Depth(depth) => depth.simulator.core(),
        }
    }

    pub(crate) fn objects<T>(&mut self, edit: impl FnOnce(&mut Objects) -> T) -> T {
        match self {
            Engine::Plane(simulator) => edit(simulator),
            Engine::Depth(depth) => depth.simulator.edit_objects(edit),
        }
    }

    fn update(&mut self, dt: f32) {
        match self {
            Engine::Plane(simulator) => simulator.update(dt),
            Engine::Depth(depth) => depth.simulator.update(dt),
        }
    }

    /// That of the engine itself in 2D; in 2.5D with the figures that walk.
    pub(crate) fn snapshot(&self) -> Vec<u8> {
        match self {
            Engine::Plane(simulator) => simulator.snapshot(),
            Engine::Depth(depth) => {
                let walkers: Vec<(BodyId, Walker)> =
                    depth.walkers.iter().map(|(body, walker)| (*body, *walker)).collect();
                WITH_WALKERS.write(&(walkers, depth.simulator.snapshot()))
            }
        }
    }

    fn restore(&mut self, snapshot: &[u8]) -> Outcome {
        match self {
            Engine::Plane(simulator) => simulator.restore(snapshot)?,
            Engine::Depth(depth) => {
                let (walkers, snapshot): (Vec<(BodyId, Walker)>, Vec<u8>) = WITH_WALKERS.read(snapshot)?;
                depth.simulator.restore(&snapshot)?;
                depth.walkers = walkers.into_iter().collect();
            }
        }
        Ok(())
    }
}

/// A snapshot in 2.5D, with what walks.
pub const WITH_WALKERS: SnapshotFormat = SnapshotFormat { magic: *b"Walkers2", version: 1 };

impl World {
    pub(crate) fn step(&mut self, dt: f32) {
        self.engine.update(dt);
        self.log.follow(&self.engine);
        if let Engine::Depth(depth) = &mut self.engine {
            let Depth { simulator, walkers, .. } = &mut **depth;
            walkers.retain(|body, _| simulator.body(*body).is_some());
        }
    }

    pub(crate) fn restore(&mut self, snapshot: &[u8]) -> Outcome {
        self.engine.restore(snapshot)?;
        self.log.begin_anew(&self.engine);
        Ok(())
    }

    /// The positions as they were when they were last brought up to date.
    pub(crate) fn positions(&self) -> &[f32] {
        &self.positions
    }

    /// Brings up to date where everything is: x, y and rotation of each body, or x, y, z and rotation, in rows by slots; rows of
    /// slots that are empty are NaN.
    pub(crate) fn refresh_positions(&mut self) {
        let World { engine, positions, .. } = self;
        positions.clear();
        match engine {
            Engine::Plane(simulator) => {
                for body in simulator.bodies() {
                    let of = &simulator[body];
                    put(positions, body, [of.position().x, of.position().y, of.rotation()]);
                }
            }
            Engine::Depth(depth) => {
                for body in depth.simulator.core().bodies() {
                    if let Some(of) = depth.simulator.body(body) {
                        let [x, y, z] = of.position3d().into();
                        put(positions, body, [x, y, z, of.rotation()]);
                    }
                }
            }
        }
    }
}

fn put<const N: usize>(positions: &mut Vec<f32>, body: BodyId, row: [f32; N]) {
    positions.resize(N * body.slot(), f32::NAN);
    positions.extend(row);
}
