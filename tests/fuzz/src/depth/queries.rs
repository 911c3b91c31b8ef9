//! Calls that query a 2.5D simulator and change nothing.

use std::hint::black_box;

use twohalf::TwoHalfPhysicsSimulator;

use super::place;
use super::pools::Pools;
use crate::random::Random;

type Query = fn(&TwoHalfPhysicsSimulator, &Pools, &mut Random);

const QUERIES: &[Query] = &[
    |simulator, _, random| evaluate(simulator.collide(random.vector(100.0))),
    |simulator, _, random| evaluate(simulator.collide_all(random.vector(100.0))),
    |simulator, _, random| evaluate(simulator.pick_front(random.vector(100.0))),
    |simulator, _, random| evaluate(simulator.screen_to_ground(random.vector(100.0))),
    |simulator, _, random| {
        let point = place(random);
        if let Some(surface) = simulator.surface_beneath(point) {
            assert!(surface.height.is_finite(), "{surface:?} beneath {point:?}");
        }
    },
    |simulator, _, _| evaluate(simulator.draw_order()),
    |simulator, pools, random| {
        let point = random.vector(100.0);
        if let Some(geom) = simulator.geom(random.pick(&pools.geoms)) {
            let other = random.pick(&pools.geoms);
            evaluate((geom.collides_with_point(point), geom.collides_with_geom(other), geom.is_ground()));
        }
    },
    |simulator, _, random| {
        let projection = simulator.projection();
        evaluate((
            projection.to_screen(random.vector3(100.0)),
            projection.screen_to_ground(random.vector(100.0)),
        ));
    },
    |simulator, pools, random| {
        let (a, b) = (simulator.geom(random.pick(&pools.geoms)), simulator.geom(random.pick(&pools.geoms)));
        evaluate(a.zip(b).map(|(a, b)| a.virtual_geom().overlaps(&b.virtual_geom())));
    },
];

/// Uses the result of a query, so that the compiler does not remove the query.
fn evaluate<T>(answer: T) {
    black_box(answer);
}

/// Makes a random query with ids of the pools.
pub(super) fn random_query(simulator: &TwoHalfPhysicsSimulator, pools: &Pools, random: &mut Random) {
    random.pick(QUERIES)(simulator, pools, random);
}
