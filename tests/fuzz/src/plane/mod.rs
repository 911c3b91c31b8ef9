//! Random games of the 2D engine.

mod calls;
mod controllers;
mod create;
mod edits;
mod handler;
mod numbers;
mod one_way;
mod paths;
mod pools;
mod queries;
mod stages;
mod surfaces;
mod things;

use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, BodyInterpolation, BroadPhaseCollider, GeomFactory, GeomId, GeomPlacement, Limits,
    Methods, MousePicker, NarrowPhaseCollider, Path, PhysicsSimulator, Result,
};

pub(crate) use edits::{BODY_EDITS, GEOM_EDITS, JOINT_EDITS, SPRING_EDITS};
pub(crate) use numbers::check_numbers;
pub use one_way::OneWayPlane;
pub use stages::StagedPlane;
pub use surfaces::SurfacePlane;
pub(crate) use things::create_thing;

use crate::game::{Call, Game};
use crate::random::Random;
use crate::scenes;
use pools::Pools;

/// Limits of the cost of a 2D simulator. They are small, because twins are loaded again and again and compute their distance
/// grids each time.
pub(crate) const LIMITS: Limits =
    Limits { grid_work: 1 << 22, total_grid_work: 1 << 23, iterations: 1 << 16 };

/// A game of the 2D engine: its simulator, ids with which to call it, and objects outside of the simulator.
#[derive(Debug)]
pub struct Plane {
    pub(crate) random: Random,
    pub(crate) simulator: PhysicsSimulator,
    pub(crate) pools: Pools,
    path: Option<Path>,
    picker: MousePicker,
    interpolation: BodyInterpolation,
}

impl Game for Plane {
    type Simulator = PhysicsSimulator;
    const SCENES: usize = scenes::KINDS + scenes::PRECISE_KINDS;

    fn new(random: Random) -> Self {
        Plane::try_new(random).expect("ordinary arguments are accepted")
    }
    fn of(simulator: PhysicsSimulator, random: Random) -> Self {
        Plane::with(simulator, random).expect("ordinary arguments are accepted")
    }
    fn scene(kind: usize) -> PhysicsSimulator {
        let scene = match kind.checked_sub(scenes::KINDS) {
            None => scenes::plane(kind),
            Some(kind) => scenes::precise(kind),
        };
        scene.expect("ordinary arguments are accepted")
    }
    fn calls() -> &'static [Call<Self>] {
        calls::CALLS
    }
    fn random(&mut self) -> &mut Random {
        &mut self.random
    }
    fn simulator(&self) -> &PhysicsSimulator {
        &self.simulator
    }
    fn simulator_mut(&mut self) -> &mut PhysicsSimulator {
        &mut self.simulator
    }
}

impl Plane {
    fn try_new(mut random: Random) -> Result<Self> {
        let gravity = if random.toss() { 100.0 } else { 0.0 };
        let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, gravity))?;
        simulator.set_broad_phase_collider(broad_phase(&mut random)).ok();
        if random.toss() {
            simulator.set_narrow_phase_collider(NarrowPhaseCollider::Sat);
        }
        if random.toss() {
            simulator.set_methods(Methods::PRECISE)?;
        }
        let mut plane = Plane::with(simulator, random)?;
        if plane.random.chance(70) {
            plane.create_floor()?;
        }
        Ok(plane)
    }

    fn with(mut simulator: PhysicsSimulator, random: Random) -> Result<Self> {
        simulator.set_limits(LIMITS);
        let mut pools = Pools::foreign()?;
        pools.take_all(&simulator);
        Ok(Plane {
            random,
            simulator,
            pools,
            path: None,
            picker: MousePicker::new(50.0, 5.0)?,
            interpolation: BodyInterpolation::new(),
        })
    }

    fn create_floor(&mut self) -> Result<()> {
        let (body, geom) = create_floor(&mut self.simulator)?;
        self.pools.bodies.push(body);
        self.pools.geoms.push(geom);
        Ok(())
    }
}

/// Makes a static floor, 400 length units wide, whose surface is at y = 110. Returns its body and geom.
///
/// # Errors
/// Never: the simulator accepts all arguments that are used here.
pub(crate) fn create_floor(simulator: &mut PhysicsSimulator) -> Result<(BodyId, GeomId)> {
    let body = BodyFactory::create_rectangle_body_in(simulator, 400.0, 20.0, 1.0)?;
    simulator[body].set_is_static(true);
    simulator[body].set_position(Vector2::new(0.0, 120.0));
    let geom = GeomFactory::create_rectangle_geom_in(simulator, body, 400.0, 20.0, GeomPlacement::default())?;
    Ok((body, geom))
}

/// Returns one of the broad phases at random.
pub(crate) fn broad_phase(random: &mut Random) -> BroadPhaseCollider {
    match random.below(5) {
        0 => BroadPhaseCollider::SelectiveSweep,
        1 => BroadPhaseCollider::SweepAndPrune,
        2 => BroadPhaseCollider::BruteForce,
        3 => BroadPhaseCollider::SPATIAL_HASH,
        _ => BroadPhaseCollider::SpatialHash {
            cell_size: random.number(5.0, 100.0),
            auto_adjust_cell_size: random.toss(),
        },
    }
}
