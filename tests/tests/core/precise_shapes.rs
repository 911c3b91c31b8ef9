//! Rounded polygons, segments and chains that are solid on both sides, height fields.

use farseer_core::math::Vector2;
use farseer_core::{
    BodyBuilder, BodyId, GeomBuilder, Outline, PhysicsSimulator, PhysicsSimulatorView, QueryFilter,
};

const DT: f32 = 1.0 / 60.0;
/// Gravity, length units/s^2.
const G: f32 = 300.0;
/// Corners of a core, length units.
const CORE: [[f32; 2]; 4] = [[-12.0, -8.0], [12.0, -8.0], [12.0, 8.0], [-12.0, 8.0]];

fn world(gravity: f32) -> PhysicsSimulator {
    PhysicsSimulator::precise([0.0, gravity]).unwrap()
}

fn run(simulator: &mut PhysicsSimulator, updates: usize) {
    (0..updates).for_each(|_| simulator.update(DT));
}

fn fixed(simulator: &mut PhysicsSimulator, geom: GeomBuilder) -> BodyId {
    simulator.add_body(BodyBuilder::fixed(), [geom]).unwrap().0
}

fn dynamic(simulator: &mut PhysicsSimulator, at: [f32; 2], geom: GeomBuilder) -> BodyId {
    simulator.add_body(BodyBuilder::dynamic().position(at), [geom]).unwrap().0
}

fn stone() -> GeomBuilder {
    GeomBuilder::rounded_polygon(CORE, 4.0)
}

/// Points on a line at equal distances.
fn line(from: [f32; 2], to: [f32; 2], count: usize) -> Vec<[f32; 2]> {
    let at = |index: usize| index as f32 / (count - 1) as f32;
    (0..count).map(|i| [0, 1].map(|axis| from[axis] + at(i) * (to[axis] - from[axis]))).collect()
}

#[test]
fn a_rounded_polygon_rests_by_its_radius_above_every_kind_of_ground() {
    let grounds = [
        GeomBuilder::rectangle(400.0, 20.0).offset([0.0, 10.0]),
        GeomBuilder::chain([[-200.0, 0.0], [200.0, 0.0]]),
        GeomBuilder::segment([-200.0, 0.0], [200.0, 0.0]),
        GeomBuilder::rounded_polygon([[-200.0, 5.0], [200.0, 5.0], [200.0, 20.0], [-200.0, 20.0]], 5.0),
        GeomBuilder::polygon([[-200.0, 0.0], [200.0, 0.0], [200.0, 60.0], [0.0, 30.0], [-200.0, 60.0]]),
    ];
    for (at, ground) in grounds.into_iter().enumerate() {
        let mut simulator = world(G);
        fixed(&mut simulator, ground);
        let stone = dynamic(&mut simulator, [0.0, -14.0], stone());
        run(&mut simulator, 180);
        let y = simulator[stone].position().y;
        assert!((y + 12.0).abs() < 0.3 && simulator.is_asleep(stone), "ground {at}: {y}");
    }
}

#[test]
fn rounded_polygons_make_a_stack_that_sleeps() {
    let mut simulator = world(G);
    fixed(&mut simulator, GeomBuilder::rectangle(400.0, 20.0).offset([0.0, 10.0]));
    let stones: Vec<BodyId> =
        (0..6).map(|at| dynamic(&mut simulator, [0.0, -12.5 - 24.5 * at as f32], stone())).collect();
    run(&mut simulator, 300);
    for (at, &stone) in stones.iter().enumerate() {
        let position = simulator[stone].position();
        assert!(simulator.is_asleep(stone) && position.x.abs() < 0.5, "{at}: {position}");
        assert!((position.y + 12.0 + 24.0 * at as f32).abs() < 1.0, "{at}: {position}");
    }
}

#[test]
fn two_round_corners_touch_at_the_sum_of_their_radii() {
    for other in [
        GeomBuilder::circle(6.0),
        stone().rotation_offset(std::f32::consts::PI),
        GeomBuilder::capsule(20.0, 6.0),
    ] {
        let is_circle = other == GeomBuilder::circle(6.0);
        let mut simulator = world(0.0);
        fixed(&mut simulator, stone());
        // It comes along the diagonal of the corner at (12, 8).
        let body =
            BodyBuilder::dynamic().position([60.0, 56.0]).linear_velocity([-50.0, -50.0]).lock_rotation(true);
        let body = simulator.add_body(body, [other]).unwrap().0;
        run(&mut simulator, 120);
        if is_circle {
            let distance = (simulator[body].position() - Vector2::new(12.0, 8.0)).norm();
            assert!((distance - 10.0).abs() < 0.2, "{distance}");
        }
        let contacts = simulator.contacts_of(body);
        assert!(!contacts.is_empty());
        // Box2D's linear slop, .005 length units of 32 px, is .16 px: contacts keep up to it.
        assert!(contacts.iter().all(|contact| contact.separation.abs() < 0.2), "{contacts:?}");
    }
}

/// Distance of a point from the rounded rectangle of [`CORE`], length units; negative inside.
fn distance_from_stone(at: Vector2) -> f32 {
    let beyond = Vector2::new((at.x.abs() - 12.0).max(0.0), (at.y.abs() - 8.0).max(0.0)).norm();
    beyond - 4.0
}

#[test]
fn the_nearest_point_of_a_rounded_polygon_is_at_the_distance_of_the_core_less_the_radius() {
    let mut simulator = world(0.0);
    fixed(&mut simulator, stone());
    simulator.update(DT);
    let filter = QueryFilter::default();
    for at in 0..64 {
        let angle = at as f32 * 0.1;
        let point = Vector2::new(30.0 * angle.cos(), 26.0 * angle.sin());
        let nearest = simulator.nearest_point(point, 100.0, &filter).unwrap().unwrap();
        assert!((nearest.distance - distance_from_stone(point)).abs() < 1e-4, "{point}");
        assert!(distance_from_stone(nearest.point).abs() < 1e-4, "{point}");
        let is_inside = !simulator.geoms_at(point * 0.5, &filter).unwrap().is_empty();
        assert_eq!(is_inside, distance_from_stone(point * 0.5) <= 0.0, "{point}");
    }
}

#[test]
fn rays_and_casts_hit_the_round_border() {
    let mut simulator = world(0.0);
    fixed(&mut simulator, stone());
    simulator.update(DT);
    let filter = QueryFilter::default();
    let disc = GeomBuilder::circle(3.0);
    for at in 0..64 {
        let angle = at as f32 * 0.1;
        let start = Vector2::new(60.0 * angle.cos(), 60.0 * angle.sin());
        let end = Vector2::new(3.0 * (angle * 3.0).sin(), 2.0);
        let hit = simulator.cast_ray(start, end, &filter).unwrap().unwrap();
        assert!(distance_from_stone(hit.point).abs() < 1e-3, "{start} {}", hit.point);
        let outside = distance_from_stone(hit.point + hit.normal * 0.5);
        assert!((outside - 0.5).abs() < 1e-3, "the normal is that of the border: {outside}");
        let cast = simulator.cast_shape(&disc, start, 0.0, end - start, &filter).unwrap().unwrap();
        let touching = start + (end - start) * cast.fraction;
        assert!((distance_from_stone(touching) - 3.0).abs() < 0.01, "{start}");
    }
    assert!(simulator.cast_ray([0.0, 0.0], [100.0, 0.0], &filter).unwrap().is_none(), "it starts inside");
}

#[test]
fn mass_centre_and_inertia_of_a_rounded_polygon_are_those_of_a_fine_polygon() {
    let core = [[-3.0, -2.0], [4.0, -1.0], [2.0, 3.0]];
    let radius = 1.5_f32;
    let mut simulator = world(0.0);
    let rounded = GeomBuilder::rounded_polygon(core, radius).density(2.0);
    let rounded = simulator.add_body(BodyBuilder::dynamic(), [rounded]).unwrap().0;
    // The support points of the shape along many directions.
    let fine = (0..4000).map(|at| {
        let (sine, cosine) = (at as f32 * std::f32::consts::TAU / 4000.0).sin_cos();
        let corner = core
            .into_iter()
            .max_by(|a, b| (a[0] * cosine + a[1] * sine).total_cmp(&(b[0] * cosine + b[1] * sine)));
        let [x, y] = corner.unwrap();
        [x + radius * cosine, y + radius * sine]
    });
    let fine = GeomBuilder::polygon(fine).density(2.0);
    let fine = simulator.add_body(BodyBuilder::dynamic(), [fine]).unwrap().0;
    let [a, b] = [&simulator[rounded], &simulator[fine]];
    assert!((a.mass() / b.mass() - 1.0).abs() < 1e-4);
    assert!((a.moment_of_inertia() / b.moment_of_inertia() - 1.0).abs() < 1e-4);
    assert!((a.position() - b.position()).norm() < 1e-3);
}

#[test]
fn density_of_the_body_counts_the_round_border() {
    let mut simulator = world(0.0);
    let body = dynamic(&mut simulator, [0.0; 2], stone().density(3.0));
    let (mass, inertia) = (simulator[body].mass(), simulator[body].moment_of_inertia());
    simulator.set_density(body, 6.0).unwrap();
    assert!((simulator[body].mass() / mass - 2.0).abs() < 1e-5);
    assert!((simulator[body].moment_of_inertia() / inertia - 2.0).abs() < 1e-5);
}

#[test]
fn a_fast_rounded_polygon_stops_at_a_thin_wall() {
    for wall in [GeomBuilder::rectangle(2.0, 200.0), GeomBuilder::segment([0.0, -100.0], [0.0, 100.0])] {
        for direction in [1.0, -1.0] {
            let mut simulator = world(0.0);
            fixed(&mut simulator, wall.clone());
            let body = BodyBuilder::dynamic().position([-300.0 * direction, 5.0]);
            let body = body.linear_velocity([20_000.0 * direction, 0.0]).angular_velocity(3.0);
            let body = simulator.add_body(body, [stone()]).unwrap().0;
            run(&mut simulator, 30);
            assert!(simulator[body].position().x * direction < 0.0);
        }
    }
}

#[test]
fn a_rounded_polygon_is_drawn_and_boxed_with_its_border() {
    let mut simulator = world(0.0);
    let (_, [geom]) = simulator.add_body(BodyBuilder::fixed(), [stone()]).unwrap();
    simulator.update(DT);
    let view = simulator.geom(geom).unwrap();
    assert_eq!(view.outline(), Outline::RoundedPolygon { radius: 4.0 });
    assert!((view.aabb().max.x - 16.0).abs() < 1e-4 && (view.aabb().max.y - 12.0).abs() < 1e-4);
    assert!(view.world_vertices().iter().all(|&corner| distance_from_stone(corner).abs() < 1e-4));
    let mut lines = 0;
    PhysicsSimulatorView::default().draw(&simulator, |_| lines += 1);
    assert!(lines >= 20, "five points about each corner: {lines}");
}

#[test]
fn both_sides_of_a_segment_stop_what_comes() {
    for gravity in [G, -G] {
        for geom in [
            GeomBuilder::circle(8.0),
            GeomBuilder::rectangle(16.0, 16.0),
            GeomBuilder::capsule(30.0, 8.0),
            stone(),
        ] {
            let mut simulator = world(gravity);
            fixed(&mut simulator, GeomBuilder::segment([-100.0, 0.0], [100.0, 0.0]));
            let height = -40.0 * gravity.signum();
            let body = dynamic(&mut simulator, [0.0, height], geom.clone());
            run(&mut simulator, 240);
            let y = simulator[body].position().y * height.signum();
            assert!((5.0..20.0).contains(&y), "{geom:?}: {y}");
        }
    }
}

#[test]
fn a_ball_meets_the_end_of_a_segment_at_its_radius() {
    let mut simulator = world(0.0);
    fixed(&mut simulator, GeomBuilder::segment([-100.0, 0.0], [0.0, 0.0]));
    // Its middle is on the line of the segment.
    let ball = BodyBuilder::dynamic().position([40.0, 0.0]).linear_velocity([-60.0, 0.0]);
    let ball = simulator.add_body(ball, [GeomBuilder::circle(8.0)]).unwrap().0;
    run(&mut simulator, 20);
    let way = simulator[ball].position() - Vector2::new(40.0 - 20.0, 0.0);
    assert!(way.norm() < 1e-3, "nothing touches on the way: {way}");
    run(&mut simulator, 60);
    assert!((simulator[ball].position() - Vector2::new(8.0, 0.0)).norm() < 0.2);
}

#[test]
fn shapes_slide_over_the_points_of_a_two_sided_chain_without_a_jolt() {
    for gravity in [G, -G] {
        let side = gravity.signum();
        for (geom, half) in
            [(GeomBuilder::rectangle(16.0, 16.0), 8.0), (GeomBuilder::circle(8.0), 8.0), (stone(), 12.0)]
        {
            let mut simulator = world(gravity);
            let chain = GeomBuilder::two_sided_chain(line([-400.0, 0.0], [400.0, 0.0], 161));
            fixed(&mut simulator, chain.friction(0.0));
            let body = BodyBuilder::dynamic().position([-300.0, -half * side]).linear_velocity([200.0, 0.0]);
            let body = simulator.add_body(body, [geom.friction(0.0)]).unwrap().0;
            for _ in 0..150 {
                simulator.update(DT);
                let velocity = simulator[body].linear_velocity();
                assert!(velocity.y.abs() < 6.0, "{velocity}");
            }
            assert!((simulator[body].linear_velocity().x - 200.0).abs() < 0.5);
        }
    }
}

#[test]
fn a_moving_bowl_of_edges_holds_what_lies_in_it() {
    let mut simulator = world(G);
    let bowl = [[-60.0, -40.0], [-40.0, 0.0], [40.0, 0.0], [60.0, -40.0]];
    // Feet carry it: chains do not collide with each other, and it lies on a rectangle.
    fixed(&mut simulator, GeomBuilder::rectangle(2000.0, 20.0).offset([0.0, 10.0]));
    let bowl = GeomBuilder::two_sided_chain(bowl).mass(4.0);
    let bowl = dynamic(&mut simulator, [0.0, -20.0], bowl);
    let balls: Vec<BodyId> = (0..3)
        .map(|at| dynamic(&mut simulator, [-20.0 + 20.0 * at as f32, -60.0], GeomBuilder::circle(8.0)))
        .collect();
    run(&mut simulator, 300);
    let floor = simulator[bowl].position().y;
    for &ball in &balls {
        let position = simulator[ball].position();
        assert!(position.x.abs() < 60.0 && (position.y + 8.0).abs() < 1.0, "{position} in {floor}");
    }
    simulator[bowl].set_linear_velocity(Vector2::new(0.0, -150.0));
    run(&mut simulator, 60);
    assert!(balls.iter().all(|&ball| simulator[ball].position().x.abs() < 70.0));
}

#[test]
fn the_mass_of_a_chain_is_spread_along_its_edges() {
    let mut simulator = world(0.0);
    let rod = GeomBuilder::segment([-30.0, 0.0], [30.0, 0.0]).mass(6.0);
    let rod = dynamic(&mut simulator, [0.0; 2], rod);
    let body = &simulator[rod];
    assert!(
        (body.mass() - 6.0).abs() < 1e-5 && (body.moment_of_inertia() - 6.0 * 3600.0 / 12.0).abs() < 0.01
    );
    let angle = GeomBuilder::two_sided_chain([[0.0, 0.0], [40.0, 0.0], [40.0, 40.0]]).mass(2.0);
    let angle = dynamic(&mut simulator, [0.0; 2], angle);
    assert!((simulator[angle].position() - Vector2::new(30.0, 10.0)).norm() < 1e-4);
    let refused = simulator.add_body(BodyBuilder::dynamic(), [GeomBuilder::segment([0.0; 2], [9.0, 0.0])]);
    assert!(refused.unwrap_err().to_string().contains("density"));
}

#[test]
fn rays_and_casts_meet_a_segment_from_both_sides_and_points_are_never_inside() {
    let mut simulator = world(0.0);
    fixed(&mut simulator, GeomBuilder::segment([-50.0, 0.0], [50.0, 0.0]));
    simulator.update(DT);
    let filter = QueryFilter::default();
    for side in [1.0, -1.0] {
        let hit = simulator.cast_ray([10.0, 40.0 * side], [10.0, -40.0 * side], &filter).unwrap().unwrap();
        assert!((hit.point - Vector2::new(10.0, 0.0)).norm() < 1e-5);
        assert!((hit.normal - Vector2::new(0.0, side)).norm() < 1e-5);
        let disc = GeomBuilder::circle(4.0);
        let way = Vector2::new(0.0, -80.0 * side);
        let cast = simulator.cast_shape(&disc, [10.0, 40.0 * side], 0.0, way, &filter).unwrap().unwrap();
        assert!((cast.fraction - 36.0 / 80.0).abs() < 1e-3);
    }
    assert!(simulator.geoms_at([10.0, 0.0], &filter).unwrap().is_empty());
}

#[test]
fn a_height_field_is_the_chain_through_its_heights() {
    let heights: Vec<f32> = (0..60).map(|at| 12.0 * (at as f32 * 0.4).sin()).collect();
    let points = heights.iter().enumerate().map(|(at, &height)| [(at as f32 - 29.5) * 16.0, -height]);
    let grounds = [GeomBuilder::height_field(heights.clone(), 16.0), GeomBuilder::chain(points)];
    let [field, chain] = grounds.map(|ground| {
        let mut simulator = world(G);
        fixed(&mut simulator, ground);
        let places = [-200.0, -50.0, 120.0];
        let bodies = places.map(|x| dynamic(&mut simulator, [x, -60.0], GeomBuilder::rectangle(20.0, 12.0)));
        run(&mut simulator, 120);
        bodies.map(|body| (simulator[body].position(), simulator[body].rotation()))
    });
    assert_eq!(field, chain);
    assert!(field.iter().all(|(position, _)| position.y < 20.0));
}

#[test]
fn a_box_slides_over_a_level_height_field_without_a_jolt() {
    let mut simulator = world(G);
    fixed(&mut simulator, GeomBuilder::height_field([0.0; 101], 8.0).friction(0.0));
    let body = BodyBuilder::dynamic().position([-300.0, -8.0]).linear_velocity([200.0, 0.0]);
    let body = simulator.add_body(body, [GeomBuilder::rectangle(16.0, 16.0)]).unwrap().0;
    simulator.update(DT);
    for _ in 0..150 {
        simulator.update(DT);
        assert!(simulator[body].linear_velocity().y.abs() < 6.0);
    }
}

#[test]
fn a_restored_simulator_goes_on_with_the_same_bits() {
    let mut simulator = world(G);
    fixed(&mut simulator, GeomBuilder::height_field((0..40).map(|at| (at * 7 % 11) as f32), 16.0));
    fixed(&mut simulator, GeomBuilder::two_sided_chain(line([-300.0, 60.0], [300.0, 90.0], 9)));
    for at in 0..12 {
        let place = [-150.0 + 25.0 * at as f32, -60.0 - 5.0 * at as f32];
        let geom = match at % 3 {
            0 => stone(),
            1 => GeomBuilder::two_sided_chain([[-9.0, 0.0], [0.0, 4.0], [9.0, 0.0]]).mass(1.0),
            _ => GeomBuilder::circle(7.0),
        };
        dynamic(&mut simulator, place, geom);
    }
    run(&mut simulator, 50);
    let mut restored = world(G);
    restored.restore(&simulator.snapshot()).unwrap();
    for _ in 0..120 {
        simulator.update(DT);
        restored.update(DT);
        assert_eq!(restored.state_hash(), simulator.state_hash());
    }
    assert_eq!(restored.snapshot(), simulator.snapshot());
}

#[test]
fn an_outline_that_is_replaced_or_cloned_keeps_or_loses_its_border() {
    let mut simulator = world(G);
    fixed(&mut simulator, GeomBuilder::rectangle(400.0, 20.0).offset([0.0, 10.0]));
    let (body, [geom]) =
        simulator.add_body(BodyBuilder::dynamic().position([0.0, -12.0]), [stone()]).unwrap();
    let other = dynamic(&mut simulator, [100.0, -12.0], GeomBuilder::rectangle(24.0, 16.0));
    let copy = simulator.clone_geom(other, geom).unwrap();
    simulator.add(copy).unwrap();
    run(&mut simulator, 120);
    let y = simulator[other].position().y;
    assert!((y + 12.0).abs() < 0.3, "{y}");
    let core: Vec<Vector2> = CORE.map(Vector2::from).to_vec();
    simulator.set_vertices(geom, core).unwrap();
    run(&mut simulator, 120);
    assert!((simulator[body].position().y + 8.0).abs() < 0.3, "the core alone");
}

#[test]
fn impossible_shapes_are_refused_by_name() {
    let mut simulator = world(0.0);
    let mut reason =
        |geom: GeomBuilder| simulator.add_body(BodyBuilder::fixed(), [geom]).unwrap_err().to_string();
    let message = reason(GeomBuilder::rounded_polygon(CORE, 0.0));
    assert_eq!(message, "radius is 0.0, but must be finite and greater than 0");
    let arrow = [[0.0, 0.0], [10.0, 10.0], [0.0, -10.0], [-10.0, 10.0]];
    assert!(reason(GeomBuilder::rounded_polygon(arrow, 1.0)).starts_with("corners is"));
    assert!(reason(GeomBuilder::rounded_polygon([[0.0, 0.0], [1.0, 0.0]], 1.0)).starts_with("corners is"));
    assert!(reason(GeomBuilder::segment([1.0, 1.0], [1.0, 1.0])).starts_with("points is"));
    assert!(reason(GeomBuilder::height_field([0.0], 1.0)).starts_with("heights is a list of 1,"));
    assert!(reason(GeomBuilder::height_field([0.0, f32::NAN], 1.0)).starts_with("heights is NaN"));
    assert_eq!(
        reason(GeomBuilder::height_field([0.0, 1.0], -1.0)),
        "spacing is -1.0, but must be finite and greater than 0"
    );
}

#[test]
fn the_faithful_set_refuses_each_shape_by_name() {
    let mut simulator = PhysicsSimulator::new([0.0, G].into()).unwrap();
    let shapes = [
        (stone(), "rounded polygons"),
        (GeomBuilder::segment([0.0; 2], [1.0, 0.0]), "two-sided chains"),
        (GeomBuilder::height_field([0.0, 1.0], 1.0), "height fields"),
    ];
    for (shape, name) in shapes {
        let error = simulator.add_body(BodyBuilder::fixed(), [shape]).unwrap_err().to_string();
        assert!(error.contains(name), "{error}");
    }
}
