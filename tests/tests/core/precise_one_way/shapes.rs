//! One-way geoms of all shapes, and on dynamic bodies.

use farseer_core::{Body, JointFactory};

use super::*;

/// A chain of a static body, open from below.
fn add_chain(simulator: &mut PhysicsSimulator, points: &[Vector2]) -> GeomId {
    let ground = simulator.create_body(Body::new());
    simulator[ground].set_is_static(true);
    simulator.add(ground).unwrap();
    let chain =
        GeomFactory::create_chain_geom_in(simulator, ground, points, GeomPlacement::default()).unwrap();
    simulator.set_one_way(chain, Some(UP)).unwrap();
    chain
}

/// A valley in edges of 10 px, as steep as 31 degrees.
fn valley() -> Vec<Vector2> {
    (-20..=20).map(|at| at as f32 * 10.0).map(|x| v(x, -0.0015 * x * x)).collect()
}

fn valley_stage() -> PhysicsSimulator {
    let mut simulator = empty();
    add_chain(&mut simulator, &valley());
    simulator
}

#[test]
fn a_body_that_falls_on_a_chain_lands_and_stays_on_it_from_edge_to_edge() {
    for (name, add, height) in THINGS {
        for (rate, speed) in RATES.into_iter().flat_map(|rate| [0.0, 20_000.0].map(|speed| (rate, speed))) {
            let mut simulator = valley_stage();
            let (body, _) = add(&mut simulator, v(-60.0, -150.0 - height));
            simulator[body].set_linear_velocity(v(0.0, speed));
            for step in 0..(6.0 * rate) as usize {
                simulator.update(1.0 / rate);
                let place = simulator[body].position();
                // Bodies that were thrown in may fly out over the rim.
                if place.x.abs() > 200.0 - height {
                    assert!(speed > 0.0, "{name}, {step} at {rate} Hz: {place}");
                    break;
                }
                // A body that touches the valley has its middle above it.
                assert!(place.y < -0.0015 * place.x * place.x, "{name}, {step} at {rate} Hz: {place}");
            }
        }
    }
}

#[test]
fn a_body_that_rises_through_a_chain_flies_freely_and_lands_on_it() {
    for (name, add, height) in THINGS {
        for x in [-83.0, 0.0, 40.0] {
            let from = v(x, 12.0 + height);
            assert_flies_free(valley_stage, add, (from, v(0.0, -500.0)), 0.55);
            for rate in RATES {
                let mut simulator = valley_stage();
                let (body, _) = add(&mut simulator, from);
                simulator[body].set_linear_velocity(v(20.0, -500.0));
                run_for(&mut simulator, 5.0, rate);
                let place = simulator[body].position();
                assert!(place.y < -0.0015 * place.x * place.x, "{name} at {rate} Hz: {place}");
            }
        }
    }
}

#[test]
fn a_box_slides_over_the_edges_of_a_straight_chain_as_over_a_closed_one() {
    for (name, add, height) in THINGS {
        let points: Vec<Vector2> = (0..60).map(|at| v(at as f32 * 13.0 - 100.0, 0.0)).collect();
        let slide = |is_open: bool| {
            let mut simulator = empty();
            let chain = add_chain(&mut simulator, &points);
            simulator.set_one_way(chain, is_open.then_some(UP)).unwrap();
            let (body, _) = add(&mut simulator, v(0.0, -height));
            run_for(&mut simulator, 0.5, 60.0);
            simulator[body].set_linear_velocity(v(230.0, 0.0));
            run_for(&mut simulator, 2.0, 60.0);
            body_bits(&simulator[body])
        };
        assert_eq!(slide(true), slide(false), "{name}");
    }
}

#[test]
fn a_face_steeper_than_sixty_degrees_is_a_side() {
    // The normal of one slope is 59 degrees away from up, that of the other 61.
    for (angle, holds) in [(59.0f32, true), (61.0, false)] {
        for rate in RATES {
            let mut simulator = empty();
            let (sine, cosine) = angle.to_radians().sin_cos();
            let (low, high) = (v(-300.0 * cosine, 300.0 * sine), v(300.0 * cosine, -300.0 * sine));
            add_chain(&mut simulator, &[low, high]);
            let (ball, _) = add_circle(&mut simulator, 10.0, 12, v(-10.0, -60.0));
            run_for(&mut simulator, 0.4, rate);
            let place = simulator[ball].position();
            let above = -(place.x * sine + place.y * cosine);
            assert_eq!(above > 9.0, holds, "{angle} degrees, {rate} Hz: {place}");
        }
    }
}

fn round_stage(edges: i32, radius: f32) -> PhysicsSimulator {
    let mut simulator = empty();
    let (body, geom) = add_circle(&mut simulator, radius, edges, v(0.0, 0.0));
    simulator[body].set_is_static(true);
    simulator.set_one_way(geom, Some(UP)).unwrap();
    simulator
}

#[test]
fn a_round_one_is_closed_where_its_normal_points_up() {
    // A true circle, and a hexagon with a corner on each side.
    for (edges, top) in [(24, 50.0), (6, 50.0 * 0.75f32.sqrt())] {
        for rate in RATES {
            let mut simulator = round_stage(edges, 50.0);
            let (ball, _) = add_circle(&mut simulator, 10.0, 12, v(0.0, -200.0));
            run_for(&mut simulator, 3.0, rate);
            assert_near(simulator[ball].position().y, -top - 10.0, REST, "the ball on top");
        }
        let from_below = (v(5.0, 100.0), v(0.0, -700.0));
        assert_flies_free(|| round_stage(edges, 50.0), |s, at| add_circle(s, 10.0, 12, at), from_below, 0.7);
        // Past the equator, where its normal points to the side.
        let from_side = (v(-120.0, -20.0), v(400.0, 0.0));
        assert_flies_free(|| round_stage(edges, 50.0), |s, at| add_circle(s, 10.0, 12, at), from_side, 0.6);
        let beside = (v(-55.0, -150.0), v(0.0, 0.0));
        assert_flies_free(|| round_stage(edges, 50.0), |s, at| add_circle(s, 10.0, 12, at), beside, 0.6);
    }
}

#[test]
fn a_lying_capsule_is_closed_along_its_upper_side() {
    for rate in RATES {
        let mut simulator = empty();
        let (body, geom) = add_capsule(&mut simulator, v(0.0, 0.0));
        simulator[body].set_is_static(true);
        simulator[body].set_rotation(std::f32::consts::FRAC_PI_2);
        // Up is to its left.
        simulator.set_one_way(geom, Some(v(-1.0, 0.0))).unwrap();
        let (lands, _) = add_box(&mut simulator, (10.0, 10.0), v(-6.0, -60.0));
        let (rises, _) = add_box(&mut simulator, (10.0, 10.0), v(6.0, 40.0));
        simulator[rises].set_linear_velocity(v(0.0, -400.0));
        run_for(&mut simulator, 3.0, rate);
        for body in [lands, rises] {
            assert_near(simulator[body].position().y, -13.0, REST, "what stands on it");
        }
    }
}

/// A tub in one concave outline: a floor 100 px wide between walls that are 60 px high; and where the middle of its floor is.
fn tub_stage() -> (PhysicsSimulator, Vector2) {
    let mut simulator = empty();
    let corners = [(0, 0), (20, 0), (20, 60), (120, 60), (120, 0), (140, 0), (140, 80), (0, 80)];
    let mut outline: Vertices = corners.into_iter().map(|(x, y)| v(x as f32, y as f32)).collect();
    let body = BodyFactory::create_polygon_body_in(&mut simulator, &outline, 1.0).unwrap();
    let placement = GeomPlacement { collision_grid_size: 4.0, ..GeomPlacement::default() };
    let geom = GeomFactory::create_polygon_geom_in(&mut simulator, body, &mut outline, placement).unwrap();
    simulator[body].set_is_static(true);
    simulator.set_one_way(geom, Some(UP)).unwrap();
    (simulator, v(70.0, 60.0))
}

#[test]
fn a_body_that_has_landed_in_a_concave_one_collides_with_all_of_it() {
    for (rate, way) in RATES.into_iter().flat_map(|rate| [-150.0, 150.0].map(|way| (rate, way))) {
        let (mut simulator, floor) = tub_stage();
        let (body, _) = add_box(&mut simulator, (20.0, 20.0), floor + v(0.0, -40.0));
        run_for(&mut simulator, 1.0, rate);
        simulator[body].set_linear_velocity(v(way, 0.0));
        let mut furthest = 0.0f32;
        for _ in 0..(2.0 * rate) as usize {
            simulator.update(1.0 / rate);
            let place = simulator[body].position() - floor;
            furthest = furthest.max(place.x * way.signum());
            assert!(place.y < -9.9, "{rate} Hz: {place}");
        }
        // Its corners may be a bit lower or higher than its sides when it strikes.
        assert_near(furthest, 40.0, 1.0, "the wall");
    }
}

#[test]
fn a_body_through_the_wall_of_a_concave_one_lands_in_it_or_falls_through_its_floor() {
    let (_, floor) = tub_stage();
    // Two px below the top of the floor.
    let from = (floor + v(-100.0, -8.0), v(300.0, -30.0));
    assert_flies_free(|| tub_stage().0, |s, at| add_box(s, (20.0, 20.0), at), from, 0.6);
    for rate in RATES {
        let (mut simulator, floor) = tub_stage();
        let (body, _) = add_box(&mut simulator, (20.0, 20.0), floor + v(-100.0, -40.0));
        simulator[body].set_linear_velocity(v(200.0, -100.0));
        run_for(&mut simulator, 3.0, rate);
        assert_near(simulator[body].position().y, floor.y - 10.0, REST, "height in the tub");
    }
}

#[test]
fn all_geoms_of_a_partly_emerged_body_pass() {
    // The foot is still in the platform when the figure turns back, and the chest above it.
    let from = v(0.0, HALF + 50.0);
    for way in [70.0f32, 80.0, 95.0] {
        assert_flies_free(|| stage().0, add_figure, (from, v(0.0, -(2.0 * GRAVITY * way).sqrt())), 1.0);
    }
}

#[test]
fn a_hanging_bridge_is_jumped_through_and_stood_on() {
    for rate in RATES {
        let mut simulator = empty();
        let anchor = |x: f32| v(x, 0.0);
        let planks: Vec<BodyId> = (0..6)
            .map(|at| {
                let (plank, geom) = add_box(&mut simulator, (40.0, 8.0), v(at as f32 * 40.0 - 100.0, 0.0));
                simulator[plank].set_mass(5.0).unwrap();
                simulator.set_one_way(geom, Some(UP)).unwrap();
                plank
            })
            .collect();
        for pair in planks.windows(2) {
            let between = 0.5 * (simulator[pair[0]].position() + simulator[pair[1]].position());
            JointFactory::create_revolute_joint_in(&mut simulator, pair[0], pair[1], between).unwrap();
        }
        JointFactory::create_fixed_revolute_joint_in(&mut simulator, planks[0], anchor(-120.0)).unwrap();
        JointFactory::create_fixed_revolute_joint_in(&mut simulator, planks[5], anchor(120.0)).unwrap();
        let (figure, _) = add_capsule(&mut simulator, v(10.0, 60.0));
        simulator[figure].set_linear_velocity(v(0.0, -500.0));
        let mut highest = f32::MAX;
        for _ in 0..(3.0 * rate) as usize {
            simulator.update(1.0 / rate);
            highest = highest.min(simulator[figure].position().y);
        }
        // By 500^2 / 1800 px.
        assert_near(highest, 60.0 - 138.9, 5.0, "how high it jumps");
        let place = simulator[figure].position();
        let bridge = planks.iter().map(|&plank| simulator[plank].position().y);
        assert!(place.y < bridge.fold(f32::MAX, f32::min), "{rate} Hz: {place}");
    }
}

#[test]
fn a_body_lands_where_both_of_two_geoms_are_one_way() {
    let meet = |of_other: Option<Vector2>| {
        let (mut simulator, _, _) = stage();
        let (body, geom) = add_box(&mut simulator, (20.0, 20.0), v(0.0, -60.0));
        simulator.set_one_way(geom, of_other).unwrap();
        run_for(&mut simulator, 1.0, 60.0);
        simulator[body].position().y
    };
    assert_near(meet(None), -20.0, REST, "closed on one-way");
    assert_near(meet(Some(-UP)), -20.0, REST, "face to face");
    assert!(meet(Some(UP)) > 300.0, "back on face");
    assert!(meet(Some(v(1.0, 0.0))) > 300.0, "side on face");
}
