//! Ids to call a simulator with: living, stale and foreign ones.

use farseer_core::{BodyId, GeomId};
use twohalf::{Platform, PlatformId, Result, TwoHalfPhysicsSimulator, Vector3};
use twohalf_factories::{TwoHalfBodyFactory, TwoHalfGeomFactory};

/// How many things the simulator has whose ids are foreign.
const FOREIGN: usize = 40;

/// Never empty.
#[derive(Debug, Clone)]
pub(super) struct Pools {
    pub(super) bodies: Vec<BodyId>,
    pub(super) geoms: Vec<GeomId>,
    pub(super) platforms: Vec<PlatformId>,
}

impl Pools {
    /// Ids of another simulator, low and high.
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

    /// All that is in a simulator.
    pub(super) fn take_all(&mut self, simulator: &TwoHalfPhysicsSimulator) {
        self.bodies.extend(simulator.core().bodies());
        self.geoms.extend(simulator.core().geoms());
        self.platforms.extend(simulator.platforms());
    }
}

fn keep_ends<T>(list: &mut Vec<T>) {
    list.drain(1..list.len() - 1);
}
