//! Calls that query a 2D simulator and change nothing.

use std::hint::black_box;

use farseer_core::{Aabb, PhysicsSimulator};

use super::pools::Pools;
use crate::random::Random;

type Query = fn(&PhysicsSimulator, &Pools, &mut Random);

const QUERIES: &[Query] = &[
    |simulator, _, random| evaluate(simulator.collide(random.vector(100.0))),
    |simulator, _, random| evaluate(simulator.collide_all(random.vector(100.0))),
    |simulator, pools, random| {
        evaluate(simulator.geom_collides_with_point(random.pick(&pools.geoms), random.vector(100.0)));
    },
    |simulator, pools, random| {
        evaluate(simulator.geom_collides_with_geom(random.pick(&pools.geoms), random.pick(&pools.geoms)));
    },
    |simulator, _, random| {
        let (start, end) = (random.vector(100.0), random.vector(100.0));
        evaluate(simulator.line_segment_all_geoms_intersect(start, end, random.toss()));
    },
    |simulator, pools, random| {
        let (start, end, geom) = (random.vector(100.0), random.vector(100.0), random.pick(&pools.geoms));
        evaluate(simulator.line_segment_geom_intersect(start, end, geom, random.toss()));
    },
    |simulator, _, random| {
        for hit in simulator.ray_cast_all(random.vector(200.0), random.vector(200.0)) {
            let numbers = [hit.fraction, hit.point.x, hit.point.y, hit.normal.x, hit.normal.y];
            assert!(numbers.iter().all(|number| number.is_finite()), "a ray hit {hit:?}");
        }
    },
    |simulator, _, random| evaluate(simulator.ray_cast(random.vector(200.0), random.vector(200.0))),
    |simulator, _, random| {
        let aabb = Aabb { min: random.vector(100.0), max: random.vector(100.0) };
        evaluate(simulator.query_aabb(&aabb));
    },
    |simulator, pools, random| evaluate(simulator.overlaps(random.pick(&pools.geoms))),
    query_body,
    query_geom,
];

/// Uses the result of a query, so that the compiler does not remove the query.
fn evaluate<T>(answer: T) {
    black_box(answer);
}

/// Makes a random query with ids of the pools.
pub(super) fn random_query(simulator: &PhysicsSimulator, pools: &Pools, random: &mut Random) {
    random.pick(QUERIES)(simulator, pools, random);
}

fn query_body(simulator: &PhysicsSimulator, pools: &Pools, random: &mut Random) {
    let id = random.pick(&pools.bodies);
    let point = random.vector(50.0);
    if let Some(body) = simulator.body(id) {
        evaluate((body.get_body_matrix(), body.x_vector_in_world_coordinates(), body.moves()));
        evaluate((body.get_world_position(point), body.get_local_position(point)));
        evaluate((body.get_velocity_at_local_point(point), body.get_velocity_at_world_point(point)));
    }
    for &geom in simulator.geoms_of(id) {
        evaluate(simulator.geom(geom).map(|geom| geom.get_nearest_distance(point)));
    }
}

fn query_geom(simulator: &PhysicsSimulator, pools: &Pools, random: &mut Random) {
    let point = random.vector(20.0);
    if let Some(geom) = simulator.geom(random.pick(&pools.geoms)) {
        evaluate((geom.matrix_inverse(), geom.get_world_position(point)));
        evaluate((geom.transform_to_local_coordinates(point), geom.transform_normal_to_world(point)));
        evaluate(geom.get_nearest_feature(point, 0));
    }
}
