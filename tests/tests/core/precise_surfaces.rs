//! Surfaces of geoms: combination rules, surface speed, rolling resistance; closed forms, edits, saves, refusals.

use farseer_core::{
    BodyBuilder, BodyId, CombinationRule, GeomBuilder, GeomId, Methods, PhysicsSimulator, SolverChoice,
    SolverReason, SurfaceOptions,
};

const DT: f32 = 1.0 / 60.0;
/// Gravity, length units/s^2.
const G: f32 = 300.0;

fn world() -> PhysicsSimulator {
    PhysicsSimulator::precise([0.0, G]).unwrap()
}

fn run(simulator: &mut PhysicsSimulator, updates: usize) {
    (0..updates).for_each(|_| simulator.update(DT));
}

fn floor(simulator: &mut PhysicsSimulator, geom: GeomBuilder) -> GeomId {
    simulator.add_body(BodyBuilder::fixed().position([0.0, 10.0]), [geom]).unwrap().1[0]
}

fn slab() -> GeomBuilder {
    GeomBuilder::rectangle(20_000.0, 20.0)
}

fn crate_on_floor(simulator: &mut PhysicsSimulator) -> BodyId {
    simulator
        .add_body(BodyBuilder::dynamic().position([0.0, -16.0]), [GeomBuilder::rectangle(32.0, 32.0)])
        .unwrap()
        .0
}

/// Adds a ball of radius 16 that rolls on the floor at `speed` without slipping.
fn rolling_ball(simulator: &mut PhysicsSimulator, geom: GeomBuilder, speed: f32) -> BodyId {
    let ball = BodyBuilder::dynamic().position([0.0, -16.0]).linear_velocity([speed, 0.0]);
    simulator.add_body(ball.angular_velocity(speed / 16.0), [geom]).unwrap().0
}

/// Kinetic energy, and potential energy above the floor.
fn energy(simulator: &PhysicsSimulator, body: BodyId) -> f32 {
    let body = &simulator[body];
    let spin = body.angular_velocity();
    0.5 * body.mass() * body.linear_velocity().norm_squared() + 0.5 * body.moment_of_inertia() * spin * spin
        - body.mass() * G * body.position().y
}

#[test]
fn each_rule_combines_friction_and_the_later_rule_of_both_geoms_acts() {
    use CombinationRule::{GeometricMean, Maximum, Mean, Minimum, Product};
    let expected = [(Mean, 0.5), (GeometricMean, 0.4), (Minimum, 0.2), (Product, 0.16), (Maximum, 0.8)];
    for (at, &(rule, friction)) in expected.iter().enumerate() {
        let weaker = expected[..=at].iter().map(|&(rule, _)| Some(rule)).chain([None]);
        for (other, is_swapped) in weaker.flat_map(|other| [(other, false), (other, true)]) {
            let mut simulator = world();
            let rules = if is_swapped { [Some(rule), other] } else { [other, Some(rule)] };
            let [below, above] = [slab().friction(0.2), GeomBuilder::rectangle(32.0, 32.0).friction(0.8)];
            let [below, above] = [(below, rules[0]), (above, rules[1])]
                .map(|(geom, rule)| rule.map_or(geom.clone(), |rule| geom.friction_rule(rule)));
            floor(&mut simulator, below);
            simulator.add_body(BodyBuilder::dynamic().position([0.0, -16.0]), [above]).unwrap();
            run(&mut simulator, 2);
            let found = simulator.arbiter(0).unwrap().friction();
            assert!((found - friction).abs() < 1e-6, "{rules:?}: {found}");
        }
    }
}

#[test]
fn the_combined_restitution_is_the_ratio_of_the_speeds_of_a_bounce() {
    use CombinationRule::{GeometricMean, Maximum, Mean, Minimum, Product};
    for (rule, expected) in
        [(Mean, 0.5), (GeometricMean, 0.4), (Minimum, 0.2), (Product, 0.16), (Maximum, 0.8)]
    {
        let mut simulator = PhysicsSimulator::precise([0.0, 0.0]).unwrap();
        floor(&mut simulator, slab().restitution(0.2));
        let ball = GeomBuilder::circle(16.0).restitution(0.8).restitution_rule(rule);
        let body = BodyBuilder::dynamic().position([0.0, -60.0]).linear_velocity([0.0, 400.0]);
        let ball = simulator.add_body(body, [ball]).unwrap().0;
        run(&mut simulator, 30);
        let speed = -simulator[ball].linear_velocity().y;
        assert!((speed - expected * 400.0).abs() < 0.5, "{rule:?}: {speed}");
    }
}

#[test]
fn a_box_on_a_belt_gains_mu_g_until_it_has_the_speed_of_the_belt() {
    for choice in [SolverChoice::Auto, SolverChoice::Iterative, SolverChoice::Direct] {
        for speed in [120.0_f32, -120.0] {
            let mut simulator = world();
            simulator.set_solver_choice(choice);
            floor(&mut simulator, slab().surface_speed(speed));
            let lower = crate_on_floor(&mut simulator);
            let upper = BodyBuilder::dynamic().position([0.0, -40.0]);
            simulator.add_body(upper, [GeomBuilder::rectangle(16.0, 16.0)]).unwrap();
            run(&mut simulator, 20);
            let now = simulator[lower].linear_velocity().x;
            let expected = 0.6 * G * 20.0 * DT * speed.signum();
            assert!((now - expected).abs() < 1.0, "{choice:?}, {speed}: {now} not {expected}");
            run(&mut simulator, 100);
            assert!((simulator[lower].linear_velocity().x - speed).abs() < 0.05, "{choice:?}, {speed}");
            assert!(!simulator.is_asleep(lower));
        }
    }
}

#[test]
fn a_track_drives_its_body_like_a_belt_drives_others() {
    let mut simulator = world();
    floor(&mut simulator, slab());
    let tank = GeomBuilder::rectangle(32.0, 32.0).surface_speed(90.0);
    let tank = simulator.add_body(BodyBuilder::dynamic().position([0.0, -16.0]), [tank]).unwrap().0;
    run(&mut simulator, 120);
    assert!((simulator[tank].linear_velocity().x - 90.0).abs() < 0.05);
}

#[test]
fn a_wall_stops_what_a_belt_carries_and_it_sleeps() {
    let mut simulator = world();
    floor(&mut simulator, slab().surface_speed(1.0));
    let wall = BodyBuilder::fixed().position([30.0, -50.0]);
    simulator.add_body(wall, [GeomBuilder::rectangle(20.0, 100.0)]).unwrap();
    let parcel = crate_on_floor(&mut simulator);
    run(&mut simulator, 600);
    assert!((simulator[parcel].position().x - 4.0).abs() < 0.1);
    assert!(simulator.is_asleep(parcel), "{:?}", simulator.why_awake(parcel));
}

#[test]
fn a_ball_with_rolling_resistance_loses_two_thirds_of_c_g_and_sleeps_where_it_should() {
    for (of_ball, of_floor) in [(0.1_f32, 0.0), (0.0, 0.1), (0.05, 0.1)] {
        let mut simulator = world();
        floor(&mut simulator, slab().rolling_resistance(of_floor));
        let geom = GeomBuilder::circle(16.0).rolling_resistance(of_ball);
        let ball = rolling_ball(&mut simulator, geom, 60.0);
        let loss = 2.0 / 3.0 * 0.1 * G;
        run(&mut simulator, 60);
        let speed = simulator[ball].linear_velocity().x;
        assert!((speed - (60.0 - loss)).abs() < 0.5, "{speed}");
        run(&mut simulator, 200);
        assert!(simulator.is_asleep(ball));
        let way = simulator[ball].position().x;
        assert!((way - 60.0 * 60.0 / (2.0 * loss)).abs() < 1.5, "{way}");
    }
}

#[test]
fn without_rolling_resistance_a_ball_keeps_its_speed() {
    let mut simulator = world();
    floor(&mut simulator, slab());
    let ball = rolling_ball(&mut simulator, GeomBuilder::circle(16.0), 60.0);
    run(&mut simulator, 120);
    assert!((simulator[ball].linear_velocity().x - 60.0).abs() < 0.05);
}

#[test]
fn a_ball_rests_on_a_slope_whose_tangent_is_less_than_its_rolling_resistance() {
    for (resistance, rests) in [(0.25, true), (0.15, false)] {
        // The tangent of the slope is 0.2.
        let slope = 0.2_f32.atan();
        let (sine, cosine) = slope.sin_cos();
        let mut simulator = world();
        let ramp = BodyBuilder::fixed().rotation(slope).position([-10.0 * sine, 10.0 * cosine]);
        simulator.add_body(ramp, [slab()]).unwrap();
        let ball = BodyBuilder::dynamic().position([16.0 * sine, -16.0 * cosine]);
        let ball =
            simulator.add_body(ball, [GeomBuilder::circle(16.0).rolling_resistance(resistance)]).unwrap().0;
        let from = simulator[ball].position();
        run(&mut simulator, 120);
        let way = (simulator[ball].position() - from).norm();
        let acceleration = G * (sine - resistance * cosine) * 2.0 / 3.0;
        if rests {
            assert!(way < 0.1 && simulator.is_asleep(ball), "{way}");
        } else {
            assert!((way - 2.0 * acceleration).abs() < 0.05 * way, "{way} {acceleration}");
        }
    }
}

#[test]
fn rolling_resistance_never_adds_energy() {
    let mut simulator = world();
    floor(&mut simulator, slab().rolling_resistance(0.3));
    let rounded = GeomBuilder::rounded_polygon([[-8.0, -8.0], [8.0, -8.0], [8.0, 8.0], [-8.0, 8.0]], 8.0);
    for geom in [GeomBuilder::circle(16.0), rounded] {
        let ball = rolling_ball(&mut simulator, geom, 200.0);
        let mut least = energy(&simulator, ball);
        // A contact carries a body that is deeper by up to the linear slop, .16 px.
        let lift = 0.16 * G * simulator[ball].mass();
        for _ in 0..240 {
            simulator.update(DT);
            let now = energy(&simulator, ball);
            assert!(now <= least + lift, "{least} {now}");
            least = least.min(now);
        }
        simulator.remove(ball).unwrap();
    }
}

#[test]
fn a_wheel_on_a_rounded_floor_has_the_torque_of_the_floors_radius() {
    let [free, braked] = [0.0, 0.1].map(|resistance| {
        let mut simulator = world();
        let half = 5_000.0;
        let core = [[-half, -2.0], [half, -2.0], [half, 2.0], [-half, 2.0]];
        floor(&mut simulator, GeomBuilder::rounded_polygon(core, 8.0).rolling_resistance(resistance));
        let corners = (0..48).map(|at| {
            let (sine, cosine) = (at as f32 * std::f32::consts::TAU / 48.0).sin_cos();
            [16.0 * cosine, 16.0 * sine]
        });
        // At 50 px/s it does not hop: w^2 r < G.
        let wheel = rolling_ball(&mut simulator, GeomBuilder::polygon(corners.collect::<Vec<_>>()), 50.0);
        run(&mut simulator, 60);
        simulator[wheel].linear_velocity().x
    });
    // The torque c R m g of the floor's radius R = 8 brakes a disc of radius r = 16 by c R g r / (1.5 r^2).
    let expected = 0.1 * 8.0 * G / (1.5 * 16.0);
    assert!((free - braked - expected).abs() < 0.1 * expected, "{free} {braked} {expected}");
}

#[test]
fn balls_with_rolling_resistance_make_a_heap_that_sleeps() {
    let mut simulator = world();
    floor(&mut simulator, slab().rolling_resistance(0.3));
    let balls: Vec<BodyId> = (0..30)
        .map(|at| {
            let body = BodyBuilder::dynamic()
                .position([(at % 5) as f32 * 33.0 + at as f32, -16.0 - 40.0 * (at / 5) as f32]);
            simulator.add_body(body, [GeomBuilder::circle(16.0).rolling_resistance(0.3)]).unwrap().0
        })
        .collect();
    run(&mut simulator, 900);
    assert!(balls.iter().all(|&ball| simulator.is_asleep(ball)));
    let highest = balls.iter().map(|&ball| simulator[ball].position().y).fold(0.0, f32::min);
    assert!(highest < -30.0, "the heap is more than one ball high: {highest}");
}

#[test]
fn the_iterative_solver_has_islands_with_rolling_resistance_and_says_why() {
    let mut simulator = world();
    simulator.set_solver_choice(SolverChoice::Direct);
    floor(&mut simulator, slab());
    let lower = crate_on_floor(&mut simulator);
    let ball = BodyBuilder::dynamic().position([0.0, -48.0]);
    let (ball, [geom]) = simulator.add_body(ball, [GeomBuilder::circle(16.0)]).unwrap();
    let why = |simulator: &PhysicsSimulator| {
        let islands = simulator.islands();
        islands.iter().find(|island| island.bodies.contains(&lower)).map(|island| island.why)
    };
    run(&mut simulator, 5);
    assert_ne!(why(&simulator), Some(SolverReason::RollingResistance));
    let surface = SurfaceOptions { rolling_resistance: 0.1, ..SurfaceOptions::default() };
    simulator.set_surface(geom, surface).unwrap();
    run(&mut simulator, 5);
    assert_eq!(why(&simulator), Some(SolverReason::RollingResistance));
    assert!(simulator[ball].position().y < -47.0);
}

#[test]
fn an_edit_of_the_surface_wakes_what_lies_on_it() {
    let mut simulator = world();
    let belt = floor(&mut simulator, slab());
    let parcel = crate_on_floor(&mut simulator);
    run(&mut simulator, 120);
    assert!(simulator.is_asleep(parcel));
    simulator.set_surface(belt, SurfaceOptions { speed: 40.0, ..SurfaceOptions::default() }).unwrap();
    run(&mut simulator, 60);
    assert!((simulator[parcel].linear_velocity().x - 40.0).abs() < 0.05);
    assert_eq!(simulator[belt].surface().speed, 40.0);
}

#[test]
fn a_restored_simulator_goes_on_with_the_same_bits() {
    let mut simulator = world();
    let rules = slab().rolling_resistance(0.2).surface_speed(-30.0).friction_rule(CombinationRule::Maximum);
    let belt = floor(&mut simulator, rules);
    let ball = rolling_ball(&mut simulator, GeomBuilder::circle(16.0), 100.0);
    run(&mut simulator, 37);
    // An edit that waits for the next update is in the save, too.
    let former = simulator[belt].surface();
    simulator.set_surface(belt, SurfaceOptions { rolling_resistance: 0.1, ..former }).unwrap();
    let mut restored = world();
    restored.restore(&simulator.snapshot()).unwrap();
    for _ in 0..100 {
        simulator.update(DT);
        restored.update(DT);
        assert_eq!(restored.state_hash(), simulator.state_hash());
    }
    assert_eq!(restored.snapshot(), simulator.snapshot());
    assert_eq!(restored[ball].position(), simulator[ball].position());
}

#[test]
fn impossible_numbers_are_refused_by_name() {
    let mut simulator = world();
    let belt = floor(&mut simulator, slab());
    let mut reason =
        |geom: GeomBuilder| simulator.add_body(BodyBuilder::dynamic(), [geom]).unwrap_err().to_string();
    let circle = || GeomBuilder::circle(1.0);
    assert_eq!(reason(circle().surface_speed(f32::NAN)), "surface_speed is NaN, but must be finite");
    let negative = reason(circle().rolling_resistance(-1.0));
    assert_eq!(negative, "rolling_resistance is -1.0, but must be finite and 0 or more");
    let surface = SurfaceOptions { rolling_resistance: -1.0, ..SurfaceOptions::default() };
    assert!(simulator.set_surface(belt, surface).is_err());
}

#[test]
fn the_faithful_set_refuses_each_option_by_name() {
    let mut simulator = PhysicsSimulator::new([0.0, G].into()).unwrap();
    let options = [
        (GeomBuilder::circle(1.0).friction_rule(CombinationRule::Mean), "combination rules"),
        (GeomBuilder::circle(1.0).restitution_rule(CombinationRule::Mean), "combination rules"),
        (GeomBuilder::circle(1.0).surface_speed(1.0), "surface speeds"),
        (GeomBuilder::circle(1.0).rolling_resistance(1.0), "rolling resistance"),
    ];
    for (geom, name) in options {
        let error = simulator.add_body(BodyBuilder::dynamic(), [geom]).unwrap_err().to_string();
        assert!(error.contains(name), "{error}");
    }
    let mut precise = world();
    floor(&mut precise, slab().surface_speed(1.0));
    precise.update(DT);
    assert!(precise.set_methods(Methods::default()).is_err());
}
