//! Queries through the grid of the precise set against those of a loaded twin, which tests every geom.

use conformance::fixtures::depth::{DT, ball, platform, simulator, solid, with_scheme};
use conformance::fixtures::plane::Random;
use twohalf::{
    BodyId, ContactTarget, DepthProfile, DepthScheme, GeomId, TwoHalfPhysicsSimulator, Vector2, Vector3,
};
use twohalf_factories::{Capsule, Cylinder, spawn};

fn point(random: &mut Random, reach: f32) -> Vector3 {
    let mut along = || random.between(-reach, reach);
    let (x, z) = (along(), along());
    Vector3::new(x, random.between(0.0, 0.3 * reach), z)
}

fn add(simulator: &mut TwoHalfPhysicsSimulator, random: &mut Random) -> BodyId {
    let at = point(random, 400.0).into();
    let size = random.between(4.0, 40.0);
    match random.below(5) {
        0 => ball(simulator, size, at),
        1 => spawn(simulator, Cylinder::new(size, 2.0 * size).at(at)).unwrap().body,
        2 => spawn(simulator, Capsule::new(size, 3.0 * size).at(at)).unwrap().body,
        3 => solid(simulator, [9.0 * size, 10.0, size], at),
        _ => solid(simulator, [size, 2.0 * size, 1.5 * size], at),
    }
}

fn edit(simulator: &mut TwoHalfPhysicsSimulator, random: &mut Random) {
    let body = random.pick(simulator.body_list());
    let at = point(random, 400.0);
    let kind = random.below(6);
    let is_its = |geom: &GeomId| simulator.geom(*geom).is_some_and(|geom| geom.body() == body);
    let geom = simulator.geom_list().iter().copied().find(is_its);
    match (kind, geom) {
        (0, _) => simulator.body_mut(body).unwrap().set_position3d(at),
        (1, _) => simulator.body_mut(body).unwrap().core_mut().set_enabled(false),
        (2, _) => simulator.body_mut(body).unwrap().core_mut().set_rotation(at.x),
        (3, _) => simulator.body_mut(body).unwrap().set_is_static(true),
        (4, Some(geom)) => {
            // Uprights refuse it.
            let _ = simulator.set_depth_profile(geom, DepthProfile::Prism { depth: 100.0 });
        }
        _ => {
            let place = Vector2::new(at.x, -at.y);
            simulator.body_mut(body).unwrap().core_mut().set_position(place);
        }
    }
}

/// Compares the answers of both, and returns their number.
fn compare(one: &TwoHalfPhysicsSimulator, other: &TwoHalfPhysicsSimulator, random: &mut Random) -> usize {
    let (from, to) = (point(random, 500.0), point(random, 500.0));
    let half = Vector3::new(random.between(0.0, 30.0), random.between(0.0, 30.0), random.between(0.0, 30.0));
    let (low, high) = (from.inf(&to), from.sup(&to));
    let [one, other] = [one, other].map(|simulator| {
        let is_geom = |target: ContactTarget| matches!(target, ContactTarget::Geom(_));
        let mut asked = Vec::new();
        let _ = simulator.ray_cast3d(from, to, |target| {
            asked.push(format!("{target:?}"));
            false
        });
        asked.sort();
        (
            simulator.query_box(low, high, |_| true),
            simulator.ray_cast3d(from, to, |_| true),
            simulator.ray_cast3d(from, to, is_geom),
            simulator.ray_cast3d(from, Vector3::new(from.x, -1.0, from.z), is_geom),
            simulator.sweep_box(from - half, from + half, to - from, is_geom),
            simulator.surface_beneath(from),
            asked,
        )
    });
    assert_eq!(one, other);
    one.0.len() + usize::from(one.2.is_some()) + usize::from(one.4.is_some()) + one.6.len()
}

#[test]
fn queries_through_the_grid_equal_tests_of_every_geom_also_after_edits() {
    with_scheme(DepthScheme::Precise, || {
        let mut answers = 0;
        for seed in 0..6 {
            let random = &mut Random::new(seed);
            let mut simulator = simulator();
            platform(&mut simulator, [200.0, 30.0, 100.0], [50.0, 0.0, 20.0]);
            (0..60).for_each(|_| _ = add(&mut simulator, random));
            for step in 0..60 {
                simulator.update(DT);
                if step % 5 == 4 {
                    (0..random.below(4)).for_each(|_| edit(&mut simulator, random));
                }
                if step % 11 == 10 {
                    add(&mut simulator, random);
                }
                let mut twin = TwoHalfPhysicsSimulator::new(600).unwrap();
                twin.restore(&simulator.snapshot()).unwrap();
                (0..4).for_each(|_| answers += compare(&simulator, &twin, random));
            }
        }
        assert!(answers > 2000, "{answers}");
    });
}
