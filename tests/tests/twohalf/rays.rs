//! Rays in three axes, and platforms in boxes. Tolerances: rounding of coordinates up to 500.

use conformance::fixtures::depth::{assert_near, assert_near3, ball, geom_of, platform, solid, weightless};
use twohalf::farseer_core::{GeomPlacement, Vertices};
use twohalf::{ContactTarget, Platform, RayHit3D, TwoHalfPhysicsSimulator, Vector2, Vector3};

const ROUNDING: f32 = 1e-3;

fn cast(simulator: &TwoHalfPhysicsSimulator, from: [f32; 3], to: [f32; 3]) -> Option<RayHit3D> {
    simulator.ray_cast3d(from.into(), to.into(), |_| true)
}

/// Has everything that waits to be added added.
fn settle(simulator: &mut TwoHalfPhysicsSimulator) {
    simulator.update(0.0);
}

#[test]
fn a_ray_enters_a_box_and_a_platform_through_the_face_that_it_meets() {
    let mut simulator = weightless();
    let body = solid(&mut simulator, [40.0, 20.0, 30.0], [0.0, 90.0, 0.0]);
    settle(&mut simulator);
    let block = platform(&mut simulator, [40.0, 20.0, 30.0], [300.0, 90.0, 0.0]);
    let both =
        [(ContactTarget::Geom(geom_of(&simulator, body)), 0.0), (ContactTarget::Platform(block), 300.0)];
    for (partner, middle) in both {
        for (axis, half) in [20.0, 10.0, 15.0].into_iter().enumerate() {
            for side in [-1.0, 1.0] {
                let centre = Vector3::new(middle, 100.0, 0.0);
                let normal = Vector3::ith(axis, side);
                let start = centre + normal * 80.0 + Vector3::new(3.0, 2.0, 1.0);
                let hit = cast(&simulator, start.into(), (start - normal * 160.0).into()).unwrap();
                assert_eq!(hit.partner, partner);
                assert_near3(hit.normal, normal.into(), ROUNDING);
                let way = 80.0 + side * [3.0, 2.0, 1.0][axis] - half;
                assert_near3(hit.point, (start - normal * way).into(), ROUNDING);
                assert_near(hit.fraction, way / 160.0, 1e-5);
            }
        }
    }
}

#[test]
fn no_normal_has_a_negative_zero() {
    let mut simulator = weightless();
    platform(&mut simulator, [40.0, 20.0, 30.0], [300.0, 90.0, 0.0]);
    for aim in [[0.0, 0.0, 0.0], [300.0, 100.0, 0.0]] {
        for axis in 0..3 {
            let start = Vector3::from(aim) + Vector3::ith(axis, 80.0) + Vector3::new(0.0, 2.0, 0.0);
            let Some(hit) = cast(&simulator, start.into(), [aim[0], aim[1] - 2.0, aim[2]]) else {
                panic!("{start}")
            };
            assert!(hit.normal.iter().all(|part| part.to_bits() != (-0.0_f32).to_bits()), "{}", hit.normal);
        }
    }
}

#[test]
fn a_ray_enters_a_ball_at_its_radius_and_passes_beside_it() {
    let mut simulator = weightless();
    let body = ball(&mut simulator, 20.0, [50.0, 80.0, 30.0]);
    settle(&mut simulator);
    let (centre, geom) = (Vector3::new(50.0, 100.0, 30.0), geom_of(&simulator, body));
    for aim in [[0.0, 0.0, 0.0], [9.0, -5.0, 12.0], [-7.0, 14.0, 3.0]] {
        for start in [[-100.0, 150.0, 200.0], [300.0, 40.0, -90.0], [60.0, 400.0, 20.0]] {
            let end = (centre + Vector3::from(aim)) * 2.0 - Vector3::from(start);
            let hit = cast(&simulator, start, end.into()).unwrap();
            assert_eq!(hit.partner, ContactTarget::Geom(geom));
            assert_near((hit.point - centre).norm(), 20.0, 0.01);
            assert_near3(hit.normal, ((hit.point - centre) / 20.0).into(), ROUNDING);
            assert!(hit.normal.dot(&(end - Vector3::from(start))) < 0.0);
        }
    }
    assert_eq!(cast(&simulator, [50.0, 100.0, 50.5], [90.0, 100.0, 50.5]), None);
}

#[test]
fn a_ray_straight_down_finds_the_surface_beneath_at_its_height() {
    let mut simulator = weightless();
    Platform::with_rotation(&mut simulator, 200.0, 20.0, 60.0, Vector3::new(0.0, 50.0, 0.0), 0.4, None)
        .unwrap();
    for (x, z) in [(0.0, 0.0), (-60.0, 25.0), (70.0, -20.0), (150.0, 0.0)] {
        let above = Vector3::new(x, 300.0, z);
        let hit = simulator.ray_cast3d(above, Vector3::new(x, -10.0, z), |_| true).unwrap();
        let surface = simulator.surface_beneath(above).unwrap();
        assert_eq!(hit.partner, surface.partner);
        assert_near(hit.point.y, surface.height, ROUNDING);
        assert_near3(hit.normal, surface.normal.into(), ROUNDING);
    }
}

#[test]
fn a_ray_goes_on_through_shapes_that_the_filter_rejects() {
    let mut simulator = weightless();
    let near = solid(&mut simulator, [20.0, 20.0, 20.0], [0.0, 200.0, 0.0]);
    settle(&mut simulator);
    let far = platform(&mut simulator, [20.0, 20.0, 20.0], [0.0, 100.0, 0.0]);
    let mut order = Vec::new();
    while let Some(hit) =
        simulator.ray_cast3d(Vector3::new(0.0, 300.0, 0.0), Vector3::new(0.0, -1.0, 0.0), |partner| {
            !order.contains(&partner)
        })
    {
        order.push(hit.partner);
    }
    assert_eq!(
        order,
        [ContactTarget::Geom(geom_of(&simulator, near)), ContactTarget::Platform(far), ContactTarget::Ground]
    );
}

#[test]
fn a_shape_around_the_start_is_hit_only_where_the_ray_enters_it_again() {
    let mut simulator = weightless();
    let body = solid(&mut simulator, [40.0, 40.0, 40.0], [0.0, 100.0, 0.0]);
    // Open upward, with walls from -30 to -20 and from 20 to 30.
    let cup = [
        [-30.0, -20.0],
        [-20.0, -20.0],
        [-20.0, 10.0],
        [20.0, 10.0],
        [20.0, -20.0],
        [30.0, -20.0],
        [30.0, 20.0],
        [-30.0, 20.0],
    ];
    let cup = simulator
        .create_geom(body, Vertices::from(cup.map(Vector2::from).to_vec()), GeomPlacement::default())
        .unwrap();
    simulator.add(cup).unwrap();
    settle(&mut simulator);
    let only_cup = |partner| partner == ContactTarget::Geom(cup);
    let y = simulator.body(body).unwrap().origin3d().y;
    let at = |x: f32, down: f32| Vector3::new(x, y - down, 0.0);
    let hit = simulator.ray_cast3d(at(-25.0, -5.0), at(50.0, -5.0), only_cup).unwrap();
    assert_near3(hit.point, at(20.0, -5.0).into(), ROUNDING);
    // Along the floor of the cup it never leaves it, for any decomposition.
    assert_eq!(simulator.ray_cast3d(at(-25.0, 15.0), at(50.0, 15.0), only_cup), None);
    let hit = simulator.ray_cast3d(at(-50.0, 15.0), at(50.0, 15.0), only_cup).unwrap();
    assert_near3(hit.point, at(-30.0, 15.0).into(), ROUNDING);
}

#[test]
fn a_ray_in_the_plane_of_flat_geoms_equals_that_of_the_2d_engine() {
    let mut simulator = weightless();
    for (index, at) in [[0.0, 100.0, 0.0], [60.0, 130.0, 0.0], [-70.0, 60.0, 0.0]].into_iter().enumerate() {
        let body = solid(&mut simulator, [40.0, 20.0, 30.0], at);
        simulator.body_mut(body).unwrap().set_rotation(0.4 * index as f32);
    }
    settle(&mut simulator);
    let mut hits = 0;
    for step in 0..64 {
        let (sin, cos) = (step as f32 * 0.1).sin_cos();
        let (start, end) = (Vector2::new(150.0 * cos, -110.0 + 150.0 * sin), Vector2::new(3.0, -107.0));
        let world = |point: Vector2| Vector3::new(point.x, -point.y, 4.0);
        let is_geom = |partner| matches!(partner, ContactTarget::Geom(_));
        let flat = simulator.core().ray_cast(start, end);
        let deep = simulator.ray_cast3d(world(start), world(end), is_geom);
        assert_eq!(flat.map(|hit| ContactTarget::Geom(hit.geom)), deep.map(|hit| hit.partner));
        let (Some(flat), Some(deep)) = (flat, deep) else { continue };
        hits += 1;
        assert_near3(deep.point, world(flat.point).into(), 0.01);
        assert_near3(deep.normal, [flat.normal.x, -flat.normal.y, 0.0], ROUNDING);
    }
    assert!(hits > 30, "{hits}");
}

#[test]
fn a_ray_of_length_zero_or_with_non_finite_numbers_has_no_hit() {
    let mut simulator = weightless();
    platform(&mut simulator, [40.0, 20.0, 30.0], [0.0, 0.0, 0.0]);
    let far = [0.0, 100.0, 0.0];
    assert_eq!(cast(&simulator, far, far), None);
    for axis in 0..3 {
        for bad in [f32::NAN, f32::INFINITY, f32::MAX] {
            let mut end = [0.0, 10.0, 0.0];
            end[axis] = bad;
            assert_eq!(cast(&simulator, far, end), None);
            assert_eq!(cast(&simulator, end, far), None);
        }
    }
}

#[test]
fn the_platforms_in_a_box_are_those_that_overlap_it_in_all_three_axes() {
    let mut simulator = weightless();
    let block = platform(&mut simulator, [40.0, 20.0, 30.0], [0.0, 50.0, 0.0]);
    let found = |low: [f32; 3], high: [f32; 3]| simulator.platforms_in_box(low.into(), high.into(), |_| true);
    assert_eq!(found([-500.0; 3], [500.0; 3]), [block]);
    assert_eq!(found([20.0, 70.0, 15.0], [30.0, 80.0, 20.0]), [block]);
    for axis in 0..3 {
        let (mut low, high) = ([-500.0; 3], [500.0; 3]);
        low[axis] = [20.5, 70.5, 15.5][axis];
        assert_eq!(found(low, high), []);
    }
    assert_eq!(found([500.0; 3], [-500.0; 3]), []);
    assert_eq!(simulator.platforms_in_box(Vector3::repeat(-500.0), Vector3::repeat(500.0), |_| false), []);
}
