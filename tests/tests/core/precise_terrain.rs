//! The precise set: chains of edges, and concave outlines in pieces. Sliding and rolling bodies are not stopped where two edges
//! or pieces meet.

use approx::assert_abs_diff_eq;
use conformance::fixtures::plane::{add_box, add_circle, simulator, v};
use farseer_core::math::Vector2;
use farseer_core::shape::{Aabb, Vertices};
use farseer_core::{
    Body, BodyFactory, BodyId, BroadPhaseCollider, DebugShape, Error, GeomFactory, GeomId, GeomPlacement,
    Methods, NarrowPhaseCollider, Outline, PhysicsSimulator, PhysicsSimulatorView,
};

const DT: f32 = 1.0 / 60.0;
const GRAVITY: f32 = 320.0;

fn precise() -> PhysicsSimulator {
    let mut simulator = simulator(GRAVITY);
    simulator.set_methods(Methods::PRECISE).unwrap();
    simulator.set_iterations(4);
    simulator
}

fn add_ground(simulator: &mut PhysicsSimulator) -> BodyId {
    let body = simulator.create_body(Body::new());
    simulator[body].set_is_static(true);
    simulator.add(body).unwrap();
    body
}

fn add_chain(simulator: &mut PhysicsSimulator, points: &[Vector2]) -> GeomId {
    let ground = add_ground(simulator);
    GeomFactory::create_chain_geom_in(simulator, ground, points, GeomPlacement::default()).unwrap()
}

/// A capsule that lies.
fn add_capsule(simulator: &mut PhysicsSimulator, position: Vector2) -> (BodyId, GeomId) {
    let body = BodyFactory::create_capsule_body_in(simulator, 40.0, 10.0, 1.0).unwrap();
    simulator[body].set_position(position);
    simulator[body].set_rotation(std::f32::consts::FRAC_PI_2);
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_capsule_geom_in(simulator, body, 40.0, 10.0, 6, placement).unwrap();
    (body, geom)
}

/// A plate on two legs, in one concave outline.
fn add_table(simulator: &mut PhysicsSimulator, position: Vector2) -> (BodyId, GeomId) {
    let corners = [
        (-30.0, 0.0),
        (30.0, 0.0),
        (30.0, 20.0),
        (20.0, 20.0),
        (20.0, 10.0),
        (-20.0, 10.0),
        (-20.0, 20.0),
        (-30.0, 20.0),
    ];
    let mut outline: Vertices = corners.into_iter().map(|(x, y)| v(x, y)).collect();
    let body = BodyFactory::create_polygon_body_in(simulator, &outline, 1.0).unwrap();
    simulator[body].set_position(position);
    let placement = GeomPlacement { collision_grid_size: 2.0, ..GeomPlacement::default() };
    let geom = GeomFactory::create_polygon_geom_in(simulator, body, &mut outline, placement).unwrap();
    (body, geom)
}

fn set_surface(simulator: &mut PhysicsSimulator, geoms: &[GeomId], friction: f32) {
    for &geom in geoms {
        simulator[geom].set_friction_coefficient(friction);
        simulator[geom].set_restitution_coefficient(0.0);
    }
}

fn without_drag(simulator: &mut PhysicsSimulator, body: BodyId) {
    simulator[body].set_linear_drag_coefficient(0.0);
    simulator[body].set_rotational_drag_coefficient(0.0);
}

fn run(simulator: &mut PhysicsSimulator, steps: usize) {
    (0..steps).for_each(|_| simulator.update(DT));
}

/// Points along the x axis, unevenly far apart.
fn flat_points() -> Vec<Vector2> {
    let mut points = vec![v(-400.0, 0.0)];
    let mut number = 0_u16;
    while points.last().unwrap().x < 2400.0 {
        let step = 7.0 + f32::from(number % 5) * 6.5;
        points.push(points.last().unwrap() + v(step, 0.0));
        number += 1;
    }
    points
}

type Adder = fn(&mut PhysicsSimulator, Vector2) -> (BodyId, GeomId);

/// Functions that add each shape, and the height of its origin above its floor.
const THINGS: [(&str, Adder, f32); 4] = [
    ("box", |simulator, place| add_box(simulator, (32.0, 32.0), place), 16.0),
    ("ball", |simulator, place| add_circle(simulator, 16.0, 12, place), 16.0),
    ("capsule", add_capsule, 10.0),
    // Its centroid is that of 60 x 10 and two of 10 x 10: 7.5 below its top.
    ("table", add_table, 12.5),
];

#[test]
fn bodies_slide_over_a_straight_chain_without_friction_as_over_one_edge() {
    for (name, add, height) in THINGS {
        let mut simulator = precise();
        let chain = add_chain(&mut simulator, &flat_points());
        let (body, geom) = add(&mut simulator, v(0.0, -height));
        set_surface(&mut simulator, &[chain, geom], 0.0);
        without_drag(&mut simulator, body);
        run(&mut simulator, 120);
        let rest = simulator[body].position();
        simulator[body].set_linear_velocity(v(230.0, 0.0));
        for step in 0..480 {
            simulator.update(DT);
            let (velocity, position) = (simulator[body].linear_velocity(), simulator[body].position());
            // Normals are along y to the last bit; apart from that the speed is constant.
            assert_eq!(velocity.x.to_bits(), 230.0_f32.to_bits(), "{name} in step {step}");
            // Measured: 0.002 px.
            assert_abs_diff_eq!(position.y, rest.y, epsilon = 0.003);
            assert!(velocity.y.abs() < 2.0, "{name} jumps at {position} with {velocity}");
        }
    }
}

#[test]
fn a_box_stops_on_a_chain_where_friction_says() {
    let mut simulator = precise();
    let chain = add_chain(&mut simulator, &flat_points());
    let (body, geom) = add_box(&mut simulator, (32.0, 32.0), v(0.0, -16.0));
    set_surface(&mut simulator, &[chain, geom], 0.5);
    without_drag(&mut simulator, body);
    run(&mut simulator, 60);
    let start = simulator[body].position().x;
    simulator[body].set_linear_velocity(v(200.0, 0.0));
    run(&mut simulator, 180);
    let distance = 200.0 * 200.0 / (2.0 * 0.5 * GRAVITY);
    // As on one edge, but for the loss of a body with more than one row of contacts: half a substep's motion.
    assert_abs_diff_eq!(simulator[body].position().x - start, distance, epsilon = 0.1 + 200.0 * DT / 8.0);
    // Measured: 0.00021 px, which is the part of its load that remains on the spring.
    assert_abs_diff_eq!(simulator[body].position().y, -16.0, epsilon = 3e-4);
}

#[test]
fn a_ball_rolls_along_a_chain_as_along_one_edge() {
    let mut simulator = precise();
    simulator.set_gravity(v(GRAVITY * 0.3, GRAVITY)).unwrap();
    let chain = add_chain(&mut simulator, &flat_points());
    let (ball, geom) = add_circle(&mut simulator, 16.0, 12, v(0.0, -16.0));
    set_surface(&mut simulator, &[chain, geom], 0.9);
    without_drag(&mut simulator, ball);
    let inertia_ratio = simulator[ball].moment_of_inertia() / (simulator[ball].mass() * 16.0 * 16.0);
    run(&mut simulator, 120);
    let distance = 0.5 * (0.3 * GRAVITY / (1.0 + inertia_ratio)) * 4.0;
    assert_abs_diff_eq!(simulator[ball].position().x, distance, epsilon = 0.001 * distance);
}

/// Angle of a bend in rad. Half of the bends are concave and half are convex.
const BEND: f32 = 0.03;
const BENDS: i32 = 24;

/// Flat, low tables with slanted sides, flat. Steps differ, so that no three points lie on a line.
fn bent_points() -> Vec<Vector2> {
    let mut points = vec![v(-400.0, 0.0), v(0.0, 0.0)];
    for bend in 0..BENDS - 1 {
        let step = 36.0 + ((bend * 7) % 4 * 5) as f32;
        let slope = [-BEND.tan(), 0.0, BEND.tan(), 0.0][bend as usize % 4];
        points.push(points.last().unwrap() + v(step, step * slope));
    }
    points.push(v(2400.0, points.last().unwrap().y));
    points
}

/// Least speed after the bends. At each bend d the component v sin(d) against the new edge is lost, with the velocity of
/// gravity in a substep, no more. Where an edge falls away, a body longer than a point tips over it, and loses the speed that
/// its end gained in the fall, if it was unsupported.
fn least_speed_after_bends(speed: f32, half_length: f32, rise: f32) -> f32 {
    let (bends, sine) = (BENDS as f32, BEND.sin());
    let lost = bends * (speed * sine + GRAVITY * DT / 4.0).powi(2) + bends * GRAVITY * half_length * sine;
    (speed * speed - 2.0 * GRAVITY * rise - lost).sqrt()
}

fn slide_over_bends(
    (name, add, height): (&str, Adder, f32),
    ground: impl Fn(&mut PhysicsSimulator) -> GeomId,
) {
    let mut simulator = precise();
    let ground = ground(&mut simulator);
    let (body, geom) = add(&mut simulator, v(-300.0, -height));
    set_surface(&mut simulator, &[ground, geom], 0.0);
    without_drag(&mut simulator, body);
    run(&mut simulator, 120);
    simulator[body].set_linear_velocity(v(150.0, 0.0));
    let mut steps = 0;
    while simulator[body].position().x < 1200.0 {
        simulator.update(DT);
        steps += 1;
        assert!(steps < 1200, "{name} is stuck at {}", simulator[body].position());
    }
    let speed = simulator[body].linear_velocity().x;
    let half_length = match name {
        "ball" => 0.0,
        "table" => 30.0,
        "capsule" => 10.0,
        _ => 16.0,
    };
    let end = bent_points().last().unwrap().y;
    let least = least_speed_after_bends(150.0, half_length, -end);
    let most = 1.003 * (150.0 * 150.0 + 2.0 * GRAVITY * end).sqrt();
    assert!(speed > least && speed < most, "{name}: {speed}, {least}");
    // Measured: 0.0028 px.
    assert_abs_diff_eq!(simulator[body].position().y, end - height, epsilon = 0.004);
}

#[test]
fn bodies_keep_their_speed_over_the_bends_of_a_chain() {
    for thing in THINGS {
        slide_over_bends(thing, |simulator| add_chain(simulator, &bent_points()));
    }
}

#[test]
fn bodies_keep_their_speed_over_the_cuts_of_a_concave_outline() {
    for thing in THINGS {
        slide_over_bends(thing, |simulator| {
            let mut outline: Vec<Vector2> = bent_points();
            outline.extend([v(2400.0, 50.0), v(-400.0, 50.0)]);
            let ground = add_ground(simulator);
            simulator
                .create_geom(ground, outline, GeomPlacement::default())
                .and_then(|geom| {
                    simulator.add(geom)?;
                    Ok(geom)
                })
                .unwrap()
        });
    }
}

/// Down a slope of twenty degrees.
#[test]
fn a_box_slides_down_a_chain_as_down_a_slope() {
    let angle = 20.0_f32.to_radians();
    let along = v(angle.cos(), angle.sin());
    let points: Vec<Vector2> = flat_points().iter().map(|point| along * point.x).collect();
    let mut simulator = precise();
    let chain = add_chain(&mut simulator, &points);
    let (body, geom) = add_box(&mut simulator, (32.0, 32.0), v(angle.sin(), -angle.cos()) * 16.0);
    simulator[body].set_rotation(angle);
    set_surface(&mut simulator, &[chain, geom], 0.0);
    without_drag(&mut simulator, body);
    run(&mut simulator, 120);
    let distance = 0.5 * GRAVITY * angle.sin() * 4.0;
    // As on one edge, but for the loss of a body with more than one row of contacts: half a substep's motion.
    let slack = 0.1 + simulator[body].linear_velocity().norm() * DT / 8.0;
    assert_abs_diff_eq!(simulator[body].position().dot(&along), distance, epsilon = slack);
    // Measured: 2.4e-6 rad.
    assert_abs_diff_eq!(simulator[body].rotation(), angle, epsilon = 1e-5);
}

#[test]
fn the_winding_of_a_closed_chain_makes_it_a_room_or_a_rock() {
    let corners = [v(-100.0, -100.0), v(-100.0, 100.0), v(100.0, 100.0), v(100.0, -100.0), v(-100.0, -100.0)];
    let mut simulator = precise();
    let room = add_chain(&mut simulator, &corners);
    assert_eq!(simulator.geom(room).unwrap().outline(), Outline::Chain { is_closed: true });
    assert_eq!(simulator.geom(room).unwrap().local_vertices()[..], corners[..4]);
    let (ball, _) = add_circle(&mut simulator, 10.0, 12, v(20.0, 0.0));
    simulator[ball].set_linear_velocity(v(300.0, -300.0));
    for _ in 0..600 {
        simulator.update(DT);
        let place = simulator[ball].position();
        assert!(place.x.abs() < 92.0 && place.y.abs() < 92.0, "{place}");
    }
    let mut simulator = precise();
    let clockwise: Vec<Vector2> = corners.into_iter().rev().collect();
    add_chain(&mut simulator, &clockwise);
    let (body, _) = add_box(&mut simulator, (20.0, 20.0), v(20.0, -150.0));
    run(&mut simulator, 300);
    // Measured: 0.00056 px.
    assert_abs_diff_eq!(simulator[body].position().y, -110.0, epsilon = 0.001);
}

#[test]
fn a_body_from_behind_passes_and_lands_on_the_free_side() {
    for (name, add, height) in THINGS {
        let mut simulator = precise();
        add_chain(&mut simulator, &flat_points());
        let (body, _) = add(&mut simulator, v(5.0, 80.0));
        without_drag(&mut simulator, body);
        simulator[body].set_linear_velocity(v(0.0, -400.0));
        let mut highest = 0.0_f32;
        for _ in 0..400 {
            simulator.update(DT);
            highest = highest.min(simulator[body].position().y);
        }
        // v^2 / 2 g = 250 above where it began; it is pushed out on its way, so never lower.
        assert!(highest < -169.0 && highest > -175.0, "{name}: {highest}");
        // Measured: 0.00045 px.
        assert_abs_diff_eq!(simulator[body].position().y, -height, epsilon = 0.001);
    }
}

#[test]
fn a_box_balances_on_a_peak_and_stands_on_an_open_end() {
    let mut simulator = precise();
    let chain = add_chain(&mut simulator, &[v(-100.0, 100.0), v(0.0, 0.0), v(100.0, 100.0)]);
    let (body, geom) = add_box(&mut simulator, (64.0, 16.0), v(0.0, -8.0));
    set_surface(&mut simulator, &[chain, geom], 0.8);
    run(&mut simulator, 60);
    // Measured: 0.00036 px.
    assert_abs_diff_eq!(simulator[body].position(), v(0.0, -8.0), epsilon = 0.001);
    let mut simulator = precise();
    let chain = add_chain(&mut simulator, &[v(0.0, 0.0), v(100.0, 0.0)]);
    let (body, geom) = add_box(&mut simulator, (64.0, 16.0), v(10.0, -8.0));
    set_surface(&mut simulator, &[chain, geom], 0.8);
    run(&mut simulator, 300);
    // Measured: 0.00043 px.
    assert_abs_diff_eq!(simulator[body].position(), v(10.0, -8.0), epsilon = 0.001);
}

/// A ball that rolls over the open end goes round its corner, a quarter of a turn at most.
#[test]
fn a_ball_rolls_off_an_open_end() {
    let mut simulator = precise();
    let chain = add_chain(&mut simulator, &[v(-200.0, 0.0), v(0.0, 0.0)]);
    let (ball, geom) = add_circle(&mut simulator, 16.0, 12, v(-20.0, -16.0));
    set_surface(&mut simulator, &[chain, geom], 0.5);
    without_drag(&mut simulator, ball);
    simulator[ball].set_linear_velocity(v(20.0, 0.0));
    let mut lowest = f32::MAX;
    for _ in 0..240 {
        simulator.update(DT);
        let place = simulator[ball].position();
        if place.y < 0.0 && place.x > 0.0 {
            lowest = lowest.min(place.norm());
        }
    }
    // Never nearer to the corner than its radius, but for the yield of contact springs.
    assert!(lowest > 15.9 && lowest < 16.5, "{lowest}");
    assert!(simulator[ball].position().y > 100.0);
}

#[test]
fn the_cost_of_chains_of_thousands_of_points_is_that_of_near_edges() {
    let hill = |i: u16| v(f32::from(i) * 16.0, (f32::from(i) * 0.1).sin() * 40.0);
    let points: Vec<Vector2> = (0..5000).map(hill).collect();
    let mut simulator = precise();
    add_chain(&mut simulator, &points);
    for i in 0..10_u16 {
        add_circle(&mut simulator, 10.0, 12, v(2000.0 + 300.0 * f32::from(i), -60.0));
    }
    let mut most = 0;
    for _ in 0..300 {
        simulator.update(DT);
        most = most.max(simulator.counters().pairs_tested);
    }
    // Ten balls, each near four edges at most.
    assert!(most > 0 && most <= 40, "{most}");
}

#[test]
fn a_chain_goes_on_with_the_same_bits_after_a_restore_in_every_step() {
    let mut plain = precise();
    let chain = add_chain(&mut plain, &bent_points());
    for (number, (_, add, _)) in THINGS.into_iter().enumerate() {
        let (body, geom) = add(&mut plain, v(10.0 + 30.0 * number as f32, -60.0 - 40.0 * number as f32));
        plain[body].set_linear_velocity(v(100.0, 0.0));
        set_surface(&mut plain, &[chain, geom], 0.2);
    }
    let mut restored = plain.clone();
    for step in 0..300 {
        plain.update(DT);
        restored.update(DT);
        assert!(plain.snapshot() == restored.snapshot(), "step {step}");
        let mut next = simulator(1.0);
        next.restore(&restored.snapshot()).unwrap();
        restored = next;
    }
    assert!(plain.arbiter_count() > 3);
}

#[test]
fn invalid_chains_are_refused_and_no_geom_is_made() {
    let mut simulator = precise();
    let ground = add_ground(&mut simulator);
    let nan = f32::NAN;
    let bad: [&[Vector2]; 7] = [
        &[],
        &[v(1.0, 2.0)],
        &[v(1.0, 2.0), v(1.0, 2.0)],
        &[v(0.0, 0.0), v(1.0, 2.0), v(1.0, 2.0), v(3.0, 0.0)],
        &[v(0.0, 0.0), v(1.0, nan)],
        &[v(0.0, 0.0), v(f32::INFINITY, 0.0)],
        &[v(0.0, 0.0), v(1.0, 0.0), v(0.0, 0.0)],
    ];
    for points in bad {
        let refused =
            GeomFactory::create_chain_geom(&mut simulator, ground, points, GeomPlacement::default());
        let Err(Error::InvalidArgument { argument, .. }) = refused else { panic!("{points:?}: {refused:?}") };
        assert_eq!(argument.split('.').next(), Some("points"), "{points:?}");
    }
    assert!(simulator.geoms_of(ground).is_empty());
}

const EDGE: [Vector2; 2] = [Vector2::new(0.0, 0.0), Vector2::new(100.0, 0.0)];

#[test]
fn only_static_bodies_have_chains() {
    let mut simulator = precise();
    let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let placement = GeomPlacement::default();
    assert!(GeomFactory::create_chain_geom(&mut simulator, body, &EDGE, placement).is_err());
    let chain = add_chain(&mut simulator, &EDGE);
    assert!(simulator.clone_geom(body, chain).is_err());
    assert!(simulator.set_body(chain, body).is_err());
    assert_eq!(simulator.geoms_of(body).len(), 1);
    let other = add_ground(&mut simulator);
    let copy = simulator.clone_geom(other, chain).unwrap();
    assert_eq!(simulator.geom(copy).unwrap().outline(), Outline::Chain { is_closed: false });
}

#[test]
fn the_faithful_methods_have_no_chains() {
    let refused = Err(Error::NotSupported { what: "chains", methods: "faithful" });
    let mut simulator = simulator(GRAVITY);
    let ground = add_ground(&mut simulator);
    let placement = GeomPlacement::default();
    assert_eq!(GeomFactory::create_chain_geom(&mut simulator, ground, &EDGE, placement).map(|_| ()), refused);
    let faithful =
        Methods::Faithful { broad: BroadPhaseCollider::default(), narrow: NarrowPhaseCollider::Sat };
    let mut simulator = precise();
    let chain = add_chain(&mut simulator, &EDGE);
    assert_eq!(simulator.set_methods(faithful), refused);
    run(&mut simulator, 2);
    assert_eq!(simulator.set_methods(faithful), refused);
    simulator.remove(chain).unwrap();
    run(&mut simulator, 1);
    simulator.set_methods(faithful).unwrap();
    assert_eq!(simulator.add(chain), refused);
}

#[test]
fn damaged_chains_are_refused() {
    let mut simulator = precise();
    add_chain(&mut simulator, &[v(0.0, 0.0), v(100.0, 0.0), v(100.0, 7.0)]);
    run(&mut simulator, 2);
    let saved = serde_json::to_string(&simulator).unwrap();
    let read = |saved: &str| serde_json::from_str::<PhysicsSimulator>(saved);
    assert!(read(&saved).is_ok());
    // Doubled points.
    let doubled = saved.replacen("[100.0,7.0]", "[100.0,0.0]", 1);
    assert!(doubled != saved && read(&doubled).is_err());
    // A circle of two points.
    let other = saved.replace(r#"{"Chain":{"is_closed":false}}"#, r#"{"Circle":{"radius":1.0}}"#);
    assert!(other != saved && read(&other).is_err());
}

#[test]
fn a_chain_has_no_inside_and_no_edge_from_its_last_point_to_its_first() {
    let mut simulator = precise();
    let chain = add_chain(&mut simulator, &[v(0.0, 0.0), v(100.0, 0.0), v(100.0, -100.0)]);
    run(&mut simulator, 1);
    assert_eq!(simulator.collide(v(80.0, -20.0)), None);
    // Across the diagonal, then across an edge.
    assert!(simulator.line_segment_geom_intersect(v(40.0, -60.0), v(60.0, -40.0), chain, false).is_empty());
    assert_eq!(simulator.line_segment_geom_intersect(v(50.0, -9.0), v(50.0, 9.0), chain, false).len(), 1);
    assert!(simulator.ray_cast(v(40.0, -60.0), v(60.0, -40.0)).is_none());
    let hit = simulator.ray_cast(v(50.0, -10.0), v(50.0, 10.0)).unwrap();
    assert_abs_diff_eq!(hit.point, v(50.0, 0.0), epsilon = 1e-5);
    assert_abs_diff_eq!(hit.normal, v(0.0, -1.0), epsilon = 1e-6);
    assert!(simulator.ray_cast(v(50.0, 10.0), v(50.0, -10.0)).is_none());
    assert_eq!(simulator.query_aabb(&Aabb::new(v(90.0, -50.0), v(110.0, -40.0))), [chain]);
    let mut lines = 0;
    let view = PhysicsSimulatorView {
        enable_edge_view: true,
        enable_aabb_view: false,
        enable_coordinate_axis_view: false,
        ..PhysicsSimulatorView::default()
    };
    view.draw(&simulator, |shape| lines += usize::from(matches!(shape, DebugShape::Line { .. })));
    assert_eq!(lines, 2);
}

/// A body that touches a chain has one collision, for all edges that it passes.
#[test]
fn a_slide_along_a_chain_is_one_collision() {
    let mut simulator = precise();
    let chain = add_chain(&mut simulator, &flat_points());
    let (body, geom) = add_box(&mut simulator, (32.0, 32.0), v(0.0, -16.0));
    set_surface(&mut simulator, &[chain, geom], 0.0);
    without_drag(&mut simulator, body);
    run(&mut simulator, 60);
    simulator[body].set_linear_velocity(v(200.0, 0.0));
    for _ in 0..120 {
        simulator.update(DT);
        let told = simulator
            .events()
            .iter()
            .filter(|event| !matches!(event, farseer_core::Event::BodyUpdated { .. }));
        assert_eq!(told.count(), 0);
    }
}

#[test]
fn a_body_that_turns_back_amid_its_passage_from_behind_falls_back() {
    for (name, add, height) in THINGS {
        let mut simulator = precise();
        add_chain(&mut simulator, &flat_points());
        let (body, _) = add(&mut simulator, v(5.0, 80.0));
        without_drag(&mut simulator, body);
        // Up to where it penetrates by a third of the depth that would bring it through.
        let rise = 80.0 - 0.67 * height;
        simulator[body].set_linear_velocity(v(0.0, -(2.0 * GRAVITY * rise).sqrt()));
        run(&mut simulator, 120);
        assert!(simulator[body].position().y > 80.0, "{name}: {}", simulator[body].position());
    }
}

/// A plank that sticks through the second of two edges, from behind the first: that is none of the first one's business.
#[test]
fn a_body_behind_an_edge_without_contact_gets_no_impulse() {
    let mut simulator = precise();
    simulator.set_gravity(v(0.0, 0.0)).unwrap();
    add_chain(&mut simulator, &[v(-100.0, 0.0), v(0.0, 0.0), v(100.0, 0.0)]);
    let angle = 30.0_f32.to_radians();
    // Its axis crosses the second edge 3 px from the first, and its middle is on the free side.
    let middle = v(3.0, 0.0) + v(angle.cos(), -angle.sin()) * 20.0;
    let (plank, _) = add_box(&mut simulator, (130.0, 2.0), middle);
    simulator[plank].set_rotation(2.0 * std::f32::consts::PI - angle);
    simulator.update(1e-6);
    let contacts: Vec<f32> = simulator
        .arbiters()
        .flat_map(|arbiter| arbiter.contacts().map(|contact| contact.separation).collect::<Vec<_>>())
        .collect();
    // Where it crosses the line of both, half its thickness and the gap between them make 3 px at most.
    assert!(contacts.iter().all(|&separation| separation > -4.0), "{contacts:?}");
}
