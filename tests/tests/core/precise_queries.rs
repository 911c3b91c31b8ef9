//! The precise set: queries of a simulator use its grid, and return the same as those of `Objects`, which test every geom.

use conformance::fixtures::plane::{Random, add_box, add_circle, add_floor, simulator, v};
use farseer_core::math::Vector2;
use farseer_core::{
    Aabb, BodyFactory, Context, EventHandler, GeomBuilder, GeomFactory, GeomId, GeomPlacement, Methods,
    Objects, PhysicsSimulator, QueryFilter, Vertices,
};

const DT: f32 = 1.0 / 60.0;

/// Boxes, balls, concave and distant geoms, at rest and fast, near the origin and far from it.
fn random_scene(random: &mut Random, centre: Vector2) -> PhysicsSimulator {
    let mut simulator = simulator(320.0);
    simulator.set_methods(Methods::PRECISE).unwrap();
    simulator.set_iterations(2);
    let place =
        |random: &mut Random| centre + v(random.between(-500.0, 500.0), random.between(-500.0, 500.0));
    for _ in 0..20 {
        let size = (random.between(5.0, 300.0), random.between(5.0, 60.0));
        let at = place(random);
        let (body, _) = add_floor(&mut simulator, size, at);
        simulator[body].set_rotation(random.between(0.0, 6.0));
    }
    for i in 0..40 {
        let at = place(random);
        let (body, _) = if i % 2 == 0 {
            add_box(&mut simulator, (random.between(4.0, 40.0), random.between(4.0, 40.0)), at)
        } else {
            add_circle(&mut simulator, random.between(3.0, 30.0), 6 + i, at)
        };
        let speed = if i % 10 == 0 { 20_000.0 } else { 300.0 };
        simulator[body].set_linear_velocity(v(random.between(-speed, speed), random.between(-speed, speed)));
        simulator[body].set_angular_velocity(random.between(-5.0, 5.0));
        simulator[body].set_is_kinematic(i % 7 == 0);
    }
    let corners = [v(0.0, 0.0), v(40.0, 0.0), v(40.0, 10.0), v(10.0, 10.0), v(10.0, 40.0), v(0.0, 40.0)];
    let body = BodyFactory::create_rectangle_body_in(&mut simulator, 40.0, 40.0, 1.0).unwrap();
    simulator[body].set_position(place(random));
    let placement =
        GeomPlacement { offset: v(200.0, -30.0), rotation_offset: 0.7, ..GeomPlacement::default() };
    let mut outline = Vertices::from(corners.to_vec());
    GeomFactory::create_polygon_geom_in(&mut simulator, body, &mut outline, placement).unwrap();
    GeomFactory::create_rectangle_geom_in(&mut simulator, body, 30.0, 9.0, placement).unwrap();
    simulator
}

/// Compares all queries of both at a random position.
fn compare(simulator: &PhysicsSimulator, random: &mut Random, centre: Vector2) -> usize {
    let objects: &Objects = simulator;
    let mut place = || centre + v(random.between(-600.0, 600.0), random.between(-600.0, 600.0));
    let (a, b, c) = (place(), place(), place());
    assert_eq!(simulator.collide(a), objects.collide(a));
    let inside = simulator.collide_all(a);
    assert_eq!(inside, objects.collide_all(a));
    assert_eq!(simulator.ray_cast(a, b), objects.ray_cast(a, b));
    let hits = simulator.ray_cast_all(a, b);
    assert_eq!(hits, objects.ray_cast_all(a, b));
    let area = Aabb::new(Vector2::new(a.x.min(c.x), a.y.min(c.y)), Vector2::new(a.x.max(c.x), a.y.max(c.y)));
    let within = simulator.query_aabb(&area);
    assert_eq!(within, objects.query_aabb(&area));
    inside.len() + hits.len() + within.len()
}

/// Compares filtered queries at a random position with those of a loaded twin, which has no grid yet.
fn compare_filtered(simulator: &PhysicsSimulator, random: &mut Random) -> usize {
    let mut twin = PhysicsSimulator::precise([0.0, 0.0]).unwrap();
    twin.restore(&simulator.snapshot()).unwrap();
    let mut place = || v(random.between(-600.0, 600.0), random.between(-600.0, 600.0));
    let (a, b) = (place(), place());
    let (turn, size) = (random.between(0.0, 6.0), random.between(2.0, 90.0));
    let filters =
        [QueryFilter::default(), QueryFilter { fixed: false, sensors: true, ..QueryFilter::default() }];
    let filter = &filters[random.below(2)];
    let shapes =
        [GeomBuilder::circle(size), GeomBuilder::rectangle(size, 20.0), GeomBuilder::capsule(90.0, 9.0)];
    let shape = &shapes[random.below(3)];
    let [one, other] = [simulator, &twin].map(|simulator| {
        (
            simulator.cast_ray(a, b, filter).unwrap(),
            simulator.cast_ray_all(a, b, filter).unwrap(),
            simulator.cast_ray_any(a, b, filter).unwrap().is_some(),
            simulator.cast_shape(shape, a, turn, b - a, filter).unwrap(),
            simulator.cast_shape_all(shape, a, turn, b - a, filter).unwrap(),
            simulator.overlap_shape(shape, a, turn, filter).unwrap(),
            simulator.nearest_point(a, size, filter).unwrap(),
            simulator.geoms_at(a, filter).unwrap(),
        )
    });
    assert_eq!(one, other);
    assert_eq!(one.0, one.1.first().copied());
    one.1.len() + one.4.len() + one.5.len()
}

#[test]
fn filtered_grid_queries_equal_a_test_of_every_geom() {
    let mut answers = 0;
    for seed in 0..6 {
        let random = &mut Random::new(seed);
        let mut simulator = random_scene(random, v(0.0, 0.0));
        for step in 0..60 {
            answers += compare_filtered(&simulator, random);
            if step % 4 == 3 {
                edit(&mut simulator, random, v(0.0, 0.0));
                answers += compare_filtered(&simulator, random);
            }
            simulator.update(DT);
        }
    }
    assert!(answers > 1000, "{answers}");
}

fn edit(simulator: &mut PhysicsSimulator, random: &mut Random, centre: Vector2) {
    let body = random.pick(simulator.body_list());
    let geom: Option<GeomId> = simulator.geoms_of(body).first().copied();
    match (random.below(7), geom) {
        (0, _) => simulator[body].set_position(centre + v(random.between(-500.0, 500.0), 0.0)),
        (1, _) => simulator[body].set_rotation(random.between(0.0, 6.0)),
        (2, _) => simulator[body].set_enabled(false),
        (3, Some(geom)) => {
            let mut matrix = simulator.geom(geom).unwrap().matrix();
            matrix.m41 += random.between(-300.0, 300.0);
            simulator.set_matrix(geom, &matrix).unwrap();
        }
        (4, Some(geom)) => simulator.set_box_radius(geom, Some(random.between(1.0, 200.0))).unwrap(),
        (5, _) => simulator.dispose(body).unwrap(),
        _ => simulator[body].set_is_static(true),
    }
}

#[test]
fn grid_queries_equal_a_test_of_every_geom() {
    let mut answers = 0;
    for (seed, centre) in [v(0.0, 0.0), v(3000.0, -900.0), v(1e6, 1e6), v(-4e7, 0.0)].into_iter().enumerate()
    {
        let random = &mut Random::new(seed as u64);
        let mut simulator = random_scene(random, centre);
        for step in 0..120 {
            answers += compare(&simulator, random, centre);
            if step % 4 == 3 {
                edit(&mut simulator, random, centre);
                answers += compare(&simulator, random, centre);
            }
            simulator.update(DT);
        }
    }
    assert!(answers > 5000, "{answers}");
}

/// Adds a box of an enabled or disabled body, or two of one body.
fn put_in(simulator: &mut PhysicsSimulator, random: &mut Random) {
    let place = v(random.between(-500.0, 500.0), random.between(-500.0, 500.0));
    let (body, _) = match random.below(3) {
        0 => add_floor(simulator, (random.between(5.0, 90.0), 20.0), place),
        _ => add_box(simulator, (random.between(4.0, 60.0), 30.0), place),
    };
    if random.below(4) == 0 {
        let placement = GeomPlacement { offset: v(100.0, 20.0), ..GeomPlacement::default() };
        GeomFactory::create_circle_geom_in(simulator, body, 9.0, 5, placement).unwrap();
    }
    simulator[body].set_enabled(random.below(5) > 0);
}

#[test]
fn grid_queries_equal_a_test_of_every_geom_while_geoms_are_added_and_removed() {
    let mut answers = 0;
    for seed in 0..4 {
        let random = &mut Random::new(seed);
        let mut simulator = random_scene(random, v(0.0, 0.0));
        simulator.update(DT);
        for _ in 0..120 {
            (0..random.below(3)).for_each(|_| put_in(&mut simulator, random));
            if random.below(2) == 0 {
                let body = random.pick(simulator.body_list());
                simulator.dispose(body).unwrap();
            }
            simulator.update(DT);
            answers += compare(&simulator, random, v(0.0, 0.0));
        }
    }
    assert!(answers > 2000, "{answers}");
}

#[test]
fn grid_queries_in_callbacks_equal_a_test_of_every_geom() {
    struct Asks(Random, usize);
    impl EventHandler for Asks {
        fn on_body_updated(&mut self, context: &mut Context<'_>, _: farseer_core::BodyId) {
            self.1 += compare(context.simulator(), &mut self.0, v(0.0, 0.0));
        }
        fn on_collision(
            &mut self,
            context: &mut Context<'_>,
            this: GeomId,
            _: GeomId,
            _: &mut Vec<farseer_core::Contact>,
        ) -> bool {
            let body = context.body_of(this).unwrap();
            let place = context[body].position() + v(self.0.between(-90.0, 90.0), 0.0);
            context[body].set_position(place);
            self.1 += compare(context.simulator(), &mut self.0, v(0.0, 0.0));
            true
        }
    }
    let mut simulator = random_scene(&mut Random::new(7), v(0.0, 0.0));
    let mut handler = Asks(Random::new(8), 0);
    (0..20).for_each(|_| simulator.update_with(DT, &mut handler));
    assert!(handler.1 > 5000, "{}", handler.1);
}

/// Row by row, or column by column, there would be four thousand million cells to look at.
#[test]
fn inverted_query_boxes_are_handled_like_others() {
    let mut random = Random::new(3);
    let mut simulator = random_scene(&mut random, v(0.0, 0.0));
    (0..10).for_each(|_| simulator.update(DT));
    let objects: &Objects = &simulator;
    for (min, max) in [
        (v(50.0, -1e9), v(-50.0, 1e9)),
        (v(-1e9, 50.0), v(1e9, -50.0)),
        (v(2.0, 2.0), v(-2.0, -2.0)),
        (v(1e9, 1e9), v(-1e9, -1e9)),
    ] {
        let area = Aabb { min, max };
        assert_eq!(simulator.query_aabb(&area), objects.query_aabb(&area), "{area:?}");
    }
}
