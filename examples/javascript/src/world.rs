//! The simulators that JavaScript holds by number.

use std::cell::RefCell;

use farseer_core::{Body, BodyId, CharacterMover, Error, Geom, GeomId, GeomRef, Objects, PhysicsSimulator};

use crate::boundary::{Argument, Failure, Outcome};
#[cfg(feature = "depth")]
use crate::depth::Depth;
use crate::touches::Log;

/// One of the two engines.
#[derive(Debug)]
pub(crate) enum Engine {
    Plane(Box<PhysicsSimulator>),
    #[cfg(feature = "depth")]
    Depth(Box<Depth>),
}

/// A simulator and its event log.
#[derive(Debug)]
pub(crate) struct World {
    pub(crate) engine: Engine,
    pub(crate) log: Log,
    pub(crate) movers: Vec<Option<Box<CharacterMover>>>,
    positions: Vec<f32>,
}

/// The number of a simulator; a number without a simulator is treated like that of a freed one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Simulator(f64);

thread_local! {
    static WORLDS: RefCell<Vec<Option<Box<World>>>> = const { RefCell::new(Vec::new()) };
}

impl Argument for Simulator {
    const REQUIREMENT: &'static str = usize::REQUIREMENT;

    #[inline]
    fn read(number: f64) -> Option<Self> {
        Some(Simulator(number))
    }
}

impl Simulator {
    /// Keeps a new one; returns its number.
    #[inline(never)]
    pub(crate) fn keep(engine: Engine) -> f64 {
        let world =
            Box::new(World { engine, log: Log::default(), movers: Vec::new(), positions: Vec::new() });
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
        self.lend().map(drop).ok_or_else(no_simulator)
    }

    #[inline(never)]
    fn lend(self) -> Option<Box<World>> {
        let place = usize::read(self.0)?;
        WORLDS.with_borrow_mut(|worlds| worlds.get_mut(place)?.take())
    }

    #[inline(never)]
    fn give_back(self, world: Box<World>) {
        WORLDS.with_borrow_mut(|worlds| worlds[self.0 as usize] = Some(world));
    }

    /// Calls a function with the world. One shared lookup keeps the compiler from copying it into every function; calls are
    /// never nested.
    #[inline]
    pub(crate) fn with<T>(self, act: impl FnOnce(&mut World) -> Outcome<T>) -> Outcome<T> {
        let Some(mut world) = self.lend() else { return Err(no_simulator()) };
        let outcome = act(&mut world);
        self.give_back(world);
        outcome
    }

    /// Call this after an edit that ends touches without a report of the engines.
    pub(crate) fn doubt(self) -> Outcome {
        self.with(|world| {
            world.log.doubt();
            Ok(())
        })
    }

    /// Edits objects that both engines have.
    pub(crate) fn objects<T>(self, edit: impl FnOnce(&mut Objects) -> farseer_core::Result<T>) -> Outcome<T> {
        self.with(|world| Ok(world.engine.objects(edit)?))
    }

    pub(crate) fn body<T>(self, body: BodyId, look: impl FnOnce(&Body) -> T) -> Outcome<T> {
        self.with(|world| match world.engine.core().body(body) {
            Some(body) => Ok(look(body)),
            None => Err(stale("body")),
        })
    }

    pub(crate) fn edit_body<T>(self, body: BodyId, edit: impl FnOnce(&mut Body) -> T) -> Outcome<T> {
        self.with(|world| match &mut world.engine {
            Engine::Plane(simulator) => match simulator.body_mut(body) {
                Some(body) => Ok(edit(body)),
                None => Err(stale("body")),
            },
            #[cfg(feature = "depth")]
            Engine::Depth(depth) => match depth.simulator.body_mut(body) {
                Some(mut body) => Ok(edit(body.core_mut())),
                None => Err(stale("body")),
            },
        })
    }

    pub(crate) fn geom<T>(self, geom: GeomId, look: impl FnOnce(GeomRef<'_>) -> T) -> Outcome<T> {
        self.with(|world| match world.engine.core().geom(geom) {
            Some(geom) => Ok(look(geom)),
            None => Err(stale("geom")),
        })
    }

    pub(crate) fn edit_geom<T>(self, geom: GeomId, edit: impl FnOnce(&mut Geom) -> T) -> Outcome<T> {
        self.with(|world| match world.engine.geom_mut(geom) {
            Some(geom) => Ok(edit(geom)),
            None => Err(stale("geom")),
        })
    }

    pub(crate) fn plane<T>(self, act: impl FnOnce(&mut PhysicsSimulator) -> Outcome<T>) -> Outcome<T> {
        self.with(|world| match &mut world.engine {
            Engine::Plane(simulator) => act(simulator),
            #[cfg(feature = "depth")]
            Engine::Depth(_) => Err(not_in_depth()),
        })
    }
}

/// Calls a method that both engines have by the same name.
macro_rules! either {
    ($simulator:expr, |$engine:ident| $act:expr) => {
        $simulator.with(|world| {
            match &mut world.engine {
                $crate::world::Engine::Plane($engine) => $act,
                #[cfg(feature = "depth")]
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

/// The error of an id of a disposed object.
#[cold]
#[inline(never)]
pub(crate) fn stale(argument: &'static str) -> Failure {
    Error::StaleId { argument }.into()
}

#[cfg(feature = "depth")]
#[cold]
#[inline(never)]
pub(crate) fn not_in_depth() -> Failure {
    Failure::because(&"only a Simulator can do that, not a DepthSimulator")
}

#[cold]
#[inline(never)]
fn no_simulator() -> Failure {
    Failure::because(&"the simulator was freed")
}

impl Engine {
    #[inline(never)]
    pub(crate) fn core(&self) -> &PhysicsSimulator {
        match self {
            Engine::Plane(simulator) => simulator,
            #[cfg(feature = "depth")]
            Engine::Depth(depth) => depth.simulator.core(),
        }
    }

    pub(crate) fn objects<T>(&mut self, edit: impl FnOnce(&mut Objects) -> T) -> T {
        match self {
            Engine::Plane(simulator) => edit(simulator),
            #[cfg(feature = "depth")]
            Engine::Depth(depth) => depth.simulator.edit_objects(edit),
        }
    }

    #[inline(never)]
    fn geom_mut(&mut self, geom: GeomId) -> Option<&mut Geom> {
        match self {
            Engine::Plane(simulator) => simulator.geom_mut(geom),
            #[cfg(feature = "depth")]
            Engine::Depth(depth) => depth.simulator.geom_mut(geom),
        }
    }

    /// The snapshot of the engine itself in 2D; in 2.5D with the character controllers.
    pub(crate) fn snapshot(&self) -> Vec<u8> {
        match self {
            Engine::Plane(simulator) => simulator.snapshot(),
            #[cfg(feature = "depth")]
            Engine::Depth(depth) => depth.snapshot(),
        }
    }

    fn restore(&mut self, snapshot: &[u8]) -> Outcome {
        match self {
            Engine::Plane(simulator) => Ok(simulator.restore(snapshot)?),
            #[cfg(feature = "depth")]
            Engine::Depth(depth) => depth.restore(snapshot),
        }
    }
}

impl World {
    pub(crate) fn step(&mut self, dt: f32) {
        match &mut self.engine {
            Engine::Plane(simulator) => simulator.update(dt),
            #[cfg(feature = "depth")]
            Engine::Depth(depth) => depth.update(dt),
        }
        self.log.follow(&self.engine);
    }

    pub(crate) fn restore(&mut self, snapshot: &[u8]) -> Outcome {
        self.engine.restore(snapshot)?;
        self.log.begin_anew(&self.engine);
        Ok(())
    }

    /// Puts back a snapshot without geoms.
    pub(crate) fn restore_moving(&mut self, moving: &[u8]) -> Outcome {
        match &mut self.engine {
            Engine::Plane(simulator) => simulator.restore_moving(moving)?,
            #[cfg(feature = "depth")]
            Engine::Depth(_) => return Err(not_in_depth()),
        }
        self.log.begin_anew(&self.engine);
        Ok(())
    }

    /// The positions as they were when they were last brought up to date.
    pub(crate) fn positions(&self) -> &[f32] {
        &self.positions
    }

    /// Brings up to date where everything is: x, y and rotation of each body, or x, y, z and rotation, in rows by slots; rows
    /// of slots that are empty are NaN.
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
            #[cfg(feature = "depth")]
            Engine::Depth(depth) => depth.put_positions(positions),
        }
    }
}

pub(crate) fn put<const N: usize>(positions: &mut Vec<f32>, body: BodyId, row: [f32; N]) {
    positions.resize(N * body.slot(), f32::NAN);
    positions.extend(row);
}
