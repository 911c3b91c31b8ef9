//! Ids with which a game calls its simulator: of living objects, of removed objects, and of another simulator.

use farseer_core::{BodyId, GeomId};
use twohalf::{Platform, PlatformId, Result, TwoHalfPhysicsSimulator, Vector3};
use twohalf_factories::{TwoHalfBodyFactory, TwoHalfGeomFactory};

/// Number of objects in the other simulator whose ids are in the pools.
const FOREIGN: usize = 40;

/// Ids by kind. No pool is empty.
#[derive(Debug, Clone)]
pub(super) struct Pools {
    pub(super) bodies: Vec<BodyId>,
    pub(super) geoms: Vec<GeomId>,
    pub(super) platforms: Vec<PlatformId>,
}

impl Pools {
    /// Returns pools with ids of another simulator, with low and high slots.
    pub(super) fn foreign() -> Result<Self> {
        let mut other = TwoHalfPhysicsSimulator::new(500)?;
        let mut pools = Pools { bodies: vec![], geoms: vec![], platforms: vec![] };
        for _ in 0..FOREIGN {
            let body = TwoHalfBodyFactory::create_circle_body(&mut other, 3.0, 1.0)?;
            pools.bodies.push(body);
            pools.geoms.push(TwoHalfGeomFactory::create_circle_geom(&mut other, body, 3.0, 6)?);
            pools.platforms.push(Platform::new(&mut other, 3.0, 3.0, 3.0, Vector3::zeros(), None)?);
        }
        keep_ends(&mut pools.bodies);
        keep_ends(&mut pools.geoms);
        keep_ends(&mut pools.platforms);
        Ok(pools)
    }

    /// Adds the ids of all objects of a simulator to the pools.
    pub(super) fn take_all(&mut self, simulator: &TwoHalfPhysicsSimulator) {
        self.bodies.extend(simulator.core().bodies());
        self.geoms.extend(simulator.core().geoms());
        self.platforms.extend(simulator.platforms());
    }
}

fn keep_ends<T>(list: &mut Vec<T>) {
    list.drain(1..list.len() - 1);
}
