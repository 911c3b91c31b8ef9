//! Queries with a filter, against closed forms and against tests of all geoms one by one.

use farseer_core::math::Vector2;
use farseer_core::{
    BodyBuilder, BodyId, CollisionCategory, GeomBuilder, GeomId, Methods, PhysicsSimulator, QueryFilter,
};

const DT: f32 = 1.0 / 60.0;

fn all() -> QueryFilter<'static> {
    QueryFilter::default()
}

/// A simulator with one geom at the origin, on a static body, after an update.
fn with(geom: GeomBuilder) -> (PhysicsSimulator, GeomId) {
    let mut simulator = PhysicsSimulator::precise([0.0, 0.0]).unwrap();
    let (_, [geom]) = simulator.add_body(BodyBuilder::fixed(), [geom]).unwrap();
    simulator.update(DT);
    (simulator, geom)
}

fn near(a: Vector2, b: [f32; 2]) -> bool {
    (a - Vector2::from(b)).norm() < 1e-4
}

#[test]
fn rays_hit_true_shapes_at_their_closed_forms() {
    let half = 0.5_f32.sqrt();
    // Geom, start, end, point and normal of the hit.
    let cases = [
        (GeomBuilder::circle(10.0), [-30.0, 6.0], [30.0, 6.0], [-8.0, 6.0], [-0.8, 0.6]),
        (GeomBuilder::capsule(40.0, 10.0), [-30.0, 5.0], [30.0, 5.0], [-10.0, 5.0], [-1.0, 0.0]),
        (GeomBuilder::capsule(40.0, 10.0), [6.0, -50.0], [6.0, 50.0], [6.0, -18.0], [0.6, -0.8]),
        (GeomBuilder::capsule(40.0, 10.0), [30.0, 18.0], [-30.0, 18.0], [6.0, 18.0], [0.6, 0.8]),
        (GeomBuilder::rectangle(20.0, 10.0), [0.0, 50.0], [0.0, -50.0], [0.0, 5.0], [0.0, 1.0]),
        (
            GeomBuilder::polygon([[0.0, -10.0], [10.0, 0.0], [0.0, 10.0], [-10.0, 0.0]]),
            [20.0, 5.0],
            [0.0, 5.0],
            [5.0, 5.0],
            [half, half],
        ),
        (GeomBuilder::chain([[-50.0, 0.0], [50.0, 0.0]]), [3.0, -9.0], [3.0, 9.0], [3.0, 0.0], [0.0, -1.0]),
    ];
    for (shape, start, end, at, normal) in cases {
        let (simulator, geom) = with(shape.clone());
        let hit = simulator.cast_ray(start, end, &all()).unwrap().unwrap();
        assert!(hit.geom == geom && near(hit.point, at) && near(hit.normal, normal), "{shape:?}: {hit:?}");
        let way = Vector2::from(end) - Vector2::from(start);
        assert!(near(Vector2::from(start) + way * hit.fraction, at));
        assert_eq!(simulator.cast_ray_all(start, end, &all()).unwrap(), [hit]);
        assert_eq!(simulator.cast_ray_any(start, end, &all()).unwrap(), Some(hit));
        // Too short, and away from it.
        let short = Vector2::from(start) + way * (hit.fraction * 0.99);
        assert_eq!(simulator.cast_ray(start, short, &all()).unwrap(), None);
        assert_eq!(simulator.cast_ray(start, Vector2::from(start) - way, &all()).unwrap(), None);
    }
    // From the middle, and from behind a chain.
    for shape in
        [GeomBuilder::circle(10.0), GeomBuilder::capsule(40.0, 10.0), GeomBuilder::rectangle(20.0, 20.0)]
    {
        assert_eq!(with(shape).0.cast_ray([0.0, 0.0], [50.0, 3.0], &all()).unwrap(), None);
    }
    let (simulator, _) = with(GeomBuilder::chain([[-50.0, 0.0], [50.0, 0.0]]));
    assert_eq!(simulator.cast_ray([3.0, 9.0], [3.0, -9.0], &all()).unwrap(), None);
}

#[test]
fn a_ray_through_a_concave_shape_meets_no_edge_within_it() {
    let notched =
        [[-20.0, -10.0], [20.0, -10.0], [20.0, 10.0], [5.0, 10.0], [0.0, 0.0], [-5.0, 10.0], [-20.0, 10.0]];
    let (simulator, _) = with(GeomBuilder::polygon(notched));
    assert_eq!(simulator.cast_ray([-15.0, 5.0], [-6.0, 5.0], &all()).unwrap(), None, "all of it is inside");
    let hit = simulator.cast_ray([0.0, 30.0], [0.0, -30.0], &all()).unwrap().unwrap();
    assert!(near(hit.point, [0.0, 0.0]), "the bottom of the notch: {hit:?}");
}

#[test]
fn casts_of_shapes_stop_at_their_closed_forms() {
    let disc = GeomBuilder::circle(5.0);
    // Geom, shape, start, motion, fraction, normal.
    let cases = [
        (GeomBuilder::circle(10.0), disc.clone(), [-40.0, 9.0], [80.0, 0.0], 0.35, [-0.8, 0.6]),
        (GeomBuilder::rectangle(20.0, 20.0), disc.clone(), [-40.0, 0.0], [50.0, 0.0], 0.5, [-1.0, 0.0]),
        // The corner.
        (GeomBuilder::rectangle(20.0, 20.0), disc.clone(), [-40.0, 14.0], [54.0, 0.0], 0.5, [-0.6, 0.8]),
        (
            GeomBuilder::rectangle(20.0, 20.0),
            GeomBuilder::rectangle(10.0, 4.0),
            [0.0, -62.0],
            [0.0, 100.0],
            0.5,
            [0.0, -1.0],
        ),
        (
            GeomBuilder::capsule(40.0, 10.0),
            GeomBuilder::capsule(40.0, 10.0),
            [60.0, 0.0],
            [-80.0, 0.0],
            0.5,
            [1.0, 0.0],
        ),
        (
            GeomBuilder::chain([[-50.0, 0.0], [50.0, 0.0]]),
            disc.clone(),
            [0.0, -25.0],
            [0.0, 40.0],
            0.5,
            [0.0, -1.0],
        ),
        // An offset of the shape counts.
        (
            GeomBuilder::rectangle(20.0, 20.0),
            disc.clone().offset([0.0, 10.0]),
            [0.0, -65.0],
            [0.0, 80.0],
            0.5,
            [0.0, -1.0],
        ),
    ];
    for (geom, shape, start, motion, fraction, normal) in cases {
        let (simulator, id) = with(geom.clone());
        let cast = |motion: Vector2| simulator.cast_shape(&shape, start, 0.0, motion, &all()).unwrap();
        let motion = Vector2::from(motion);
        let hit = cast(motion).unwrap();
        let is_right = hit.geom == id && (hit.fraction - fraction).abs() < 1e-5 && near(hit.normal, normal);
        assert!(is_right, "{geom:?} {shape:?}: {hit:?}");
        assert_eq!(cast(motion * (fraction * 0.99)), None);
        assert_eq!(cast(-motion), None);
        assert_eq!(simulator.cast_shape_all(&shape, start, 0.0, motion, &all()).unwrap(), [hit]);
        // Overlaps begin where the cast ends.
        let at = |part: f32| Vector2::from(start) + motion * part;
        let overlaps = |at: Vector2| simulator.overlap_shape(&shape, at, 0.0, &all()).unwrap();
        assert_eq!(overlaps(at(fraction * 0.999)), []);
        assert_eq!(overlaps(at(fraction + 0.01)), [id]);
        assert_eq!(simulator.overlap_any(&shape, at(fraction + 0.01), 0.0, &all()).unwrap(), Some(id));
        // From an overlap the shape may leave, and goes no further in.
        let inside = at(fraction + 0.02);
        let into = simulator.cast_shape(&shape, inside, 0.0, motion, &all()).unwrap();
        let out = simulator.cast_shape(&shape, inside, 0.0, -motion, &all()).unwrap();
        assert_eq!((into.map(|hit| hit.fraction), out), (Some(0.0), None), "{geom:?} {shape:?}");
    }
}

#[test]
fn nearest_points_and_points_within() {
    let (simulator, geom) =
        with(GeomBuilder::rectangle(20.0, 20.0).rotation_offset(std::f32::consts::FRAC_PI_4));
    let corner = 200.0_f32.sqrt();
    let nearest = simulator.nearest_point([30.0, 0.0], 50.0, &all()).unwrap().unwrap();
    assert_eq!(nearest.geom, geom);
    assert!(near(nearest.point, [corner, 0.0]) && near(nearest.normal, [1.0, 0.0]));
    assert!((nearest.distance - (30.0 - corner)).abs() < 1e-4);
    assert_eq!(simulator.nearest_point([30.0, 0.0], 10.0, &all()).unwrap(), None);
    let inside = simulator.nearest_point([3.0, 4.0], 10.0, &all()).unwrap().unwrap();
    assert_eq!(
        (inside.distance, inside.point, inside.normal),
        (0.0, Vector2::new(3.0, 4.0), Vector2::zeros())
    );
    assert_eq!(simulator.geoms_at([3.0, 4.0], &all()).unwrap(), [geom]);
    assert_eq!(simulator.geoms_at([9.9, 9.9], &all()).unwrap(), []);
    // A circle is round, and no polygon of sixteen corners.
    let (simulator, geom) = with(GeomBuilder::circle(100.0));
    let angle = std::f32::consts::PI / 16.0;
    let on_the_rim = [99.5 * angle.cos(), 99.5 * angle.sin()];
    assert_eq!(simulator.geoms_at(on_the_rim, &all()).unwrap(), [geom]);
}

#[test]
fn filters_admit_by_category_kind_sensor_body_and_test() {
    const WALL: CollisionCategory = CollisionCategory::CAT1;
    const COIN: CollisionCategory = CollisionCategory::CAT2;
    let mut simulator = PhysicsSimulator::precise([0.0, 0.0]).unwrap();
    let disc = || GeomBuilder::circle(5.0);
    let mut add = |body: BodyBuilder, x: f32, geom: GeomBuilder| -> (BodyId, GeomId) {
        let (body, [geom]) = simulator.add_body(body.position([x, 0.0]), [geom]).unwrap();
        (body, geom)
    };
    let (_, wall) = add(BodyBuilder::fixed(), 0.0, disc().categories(WALL));
    let (_, lift) = add(BodyBuilder::kinematic(), 20.0, disc().categories(WALL).collides_with(COIN));
    let (ball_body, ball) = add(BodyBuilder::dynamic(), 40.0, disc());
    let (_, coin) = add(BodyBuilder::dynamic().mass(1.0), 60.0, disc().categories(COIN).sensor(true));
    let (_, off) = add(BodyBuilder::fixed().enabled(false), 80.0, disc());
    simulator.update(DT);
    let is_odd = |geom: GeomId| geom == ball;
    let cases: [(QueryFilter<'_>, &[GeomId]); 10] = [
        (all(), &[wall, lift, ball]),
        (QueryFilter { sensors: true, ..all() }, &[wall, lift, ball, coin]),
        (QueryFilter { categories: WALL, ..all() }, &[wall, lift, ball]),
        (QueryFilter { categories: COIN, sensors: true, ..all() }, &[ball, coin]),
        (QueryFilter { as_categories: WALL, ..all() }, &[wall, ball]),
        (QueryFilter { fixed: false, ..all() }, &[lift, ball]),
        (QueryFilter { kinematic: false, dynamic: false, ..all() }, &[wall]),
        (QueryFilter { exclude_body: Some(ball_body), ..all() }, &[wall, lift]),
        (QueryFilter { exclude_geom: Some(wall), ..all() }, &[lift, ball]),
        (QueryFilter { accepts: Some(&is_odd), ..all() }, &[ball]),
    ];
    let line = GeomBuilder::rectangle(300.0, 1.0);
    for (filter, expected) in cases {
        let hits = simulator.cast_ray_all([-50.0, 0.0], [150.0, 0.0], &filter).unwrap();
        assert_eq!(hits.iter().map(|hit| hit.geom).collect::<Vec<_>>(), expected, "{filter:?}");
        let first = simulator.cast_ray([-50.0, 0.0], [150.0, 0.0], &filter).unwrap();
        assert_eq!(first.map(|hit| hit.geom), expected.first().copied());
        let cast = simulator
            .cast_shape_all(&GeomBuilder::circle(1.0), [-50.0, 0.0], 0.0, [200.0, 0.0], &filter)
            .unwrap();
        assert_eq!(cast.iter().map(|hit| hit.geom).collect::<Vec<_>>(), expected, "{filter:?}");
        assert_eq!(simulator.overlap_shape(&line, [0.0, 0.0], 0.0, &filter).unwrap(), expected, "{filter:?}");
        let found = simulator.geoms_at([80.0, 0.0], &filter).unwrap();
        assert!(!found.contains(&off));
    }
}

/// A number from 0 to `below`, exclusively.
fn random(number: &mut u32, below: f32) -> f32 {
    *number = number.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    (*number >> 8) as f32 / (1 << 24) as f32 * below
}

/// A world of many geoms, which move and are edited.
fn world(methods: Methods) -> (PhysicsSimulator, Vec<BodyId>) {
    let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 50.0)).unwrap();
    simulator.set_methods(methods).unwrap();
    let mut number = 7;
    let bodies = (0..120)
        .map(|i| {
            let at = [random(&mut number, 1000.0), random(&mut number, 1000.0)];
            let turn = random(&mut number, 6.0);
            let geom = match i % 4 {
                0 => GeomBuilder::circle(5.0 + random(&mut number, 20.0)),
                1 => GeomBuilder::rectangle(10.0 + random(&mut number, 60.0), 8.0),
                2 => GeomBuilder::capsule(50.0, 4.0 + random(&mut number, 10.0)),
                _ => GeomBuilder::polygon([
                    [-20.0, -15.0],
                    [20.0, -15.0],
                    [20.0, 15.0],
                    [0.0, 0.0],
                    [-20.0, 15.0],
                ]),
            };
            let body = if i % 3 == 0 { BodyBuilder::fixed() } else { BodyBuilder::dynamic() };
            simulator.add_body(body.position(at).rotation(turn), [geom]).unwrap().0
        })
        .collect();
    (simulator, bodies)
}

#[test]
fn the_grid_finds_what_a_test_of_all_geoms_finds_also_after_edits() {
    let (mut simulator, bodies) = world(Methods::PRECISE);
    let mut number = 99;
    let mut found = 0;
    for round in 0..60 {
        simulator.update(DT);
        let moved = bodies[round * 2 % bodies.len()];
        simulator[moved].set_position(Vector2::new(random(&mut number, 1000.0), random(&mut number, 1000.0)));
        // The same objects without a grid: a faithful simulator has none.
        let mut plain = PhysicsSimulator::default();
        for &body in &bodies {
            let geom = simulator.geom(simulator.geoms_of(body)[0]).unwrap();
            let corners: Vec<Vector2> = geom.local_vertices().iter().copied().collect();
            let shape = match geom.outline() {
                farseer_core::Outline::Circle { radius } => GeomBuilder::circle(radius),
                farseer_core::Outline::Capsule { height, end_radius } => {
                    GeomBuilder::capsule(height, end_radius)
                }
                _ => GeomBuilder::polygon(corners).offset(geom.offset()),
            };
            let place = BodyBuilder::fixed()
                .position(simulator[body].position())
                .rotation(simulator[body].rotation());
            plain.add_body(place, [shape]).unwrap();
        }
        plain.update(0.0);
        let points: [f32; 6] = std::array::from_fn(|_| random(&mut number, 1000.0));
        let ([ax, ay, bx, by, x, y], turn) = (points, random(&mut number, 6.0));
        let shape = GeomBuilder::rectangle(60.0, 20.0);
        let [one, other] = [&simulator, &plain].map(|simulator| {
            let slot = |geom: GeomId| geom.slot();
            let ray: Vec<_> = simulator.cast_ray_all([ax, ay], [bx, by], &all()).unwrap();
            let cast = simulator.cast_shape_all(&shape, [ax, ay], turn, [bx - ax, by - ay], &all()).unwrap();
            let hits = |hits: Vec<farseer_core::RayCastHit>| {
                hits.into_iter().map(|hit| (slot(hit.geom), (hit.fraction * 1e4).round())).collect::<Vec<_>>()
            };
            let over = simulator.overlap_shape(&shape, [x, y], turn, &all()).unwrap();
            let mut near: Vec<_> = over.into_iter().map(slot).collect();
            near.extend(simulator.nearest_point([x, y], 200.0, &all()).unwrap().map(|near| slot(near.geom)));
            near.extend(simulator.geoms_at([x, y], &all()).unwrap().into_iter().map(slot));
            (hits(ray), hits(cast), near)
        });
        found += one.0.len() + one.1.len() + one.2.len();
        assert_eq!(one, other, "round {round}");
    }
    assert!(found > 500, "{found}");
}

#[test]
fn bad_arguments_of_queries_are_refused_by_name() {
    let (simulator, _) = with(GeomBuilder::circle(10.0));
    let nan = [f32::NAN, 0.0];
    let reason = |error: farseer_core::Error| error.to_string().split(' ').next().unwrap().to_owned();
    let shape = GeomBuilder::circle(1.0);
    assert_eq!(reason(simulator.cast_ray(nan, [0.0; 2], &all()).unwrap_err()), "start");
    assert_eq!(reason(simulator.cast_ray_all([0.0; 2], nan, &all()).unwrap_err()), "end");
    assert_eq!(reason(simulator.cast_shape(&shape, nan, 0.0, [1.0, 0.0], &all()).unwrap_err()), "position");
    assert_eq!(
        reason(simulator.cast_shape(&shape, [0.0; 2], f32::NAN, [1.0, 0.0], &all()).unwrap_err()),
        "rotation"
    );
    assert_eq!(reason(simulator.cast_shape(&shape, [0.0; 2], 0.0, nan, &all()).unwrap_err()), "motion");
    assert_eq!(
        reason(simulator.overlap_shape(&GeomBuilder::circle(0.0), [0.0; 2], 0.0, &all()).unwrap_err()),
        "radius"
    );
    assert_eq!(reason(simulator.geoms_at(nan, &all()).unwrap_err()), "point");
    assert_eq!(reason(simulator.nearest_point([0.0; 2], -1.0, &all()).unwrap_err()), "max_distance");
}
