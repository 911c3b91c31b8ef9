//! Bodies and geoms of builders: mass properties, filters, options of bodies, refusals, saves.

use farseer_core::math::Vector2;
use farseer_core::{
    BodyBuilder, BodyId, CollisionCategory, Error, GeomBuilder, GeomFactory, GeomPlacement, Methods,
    PhysicsSimulator, WantedEvents,
};

const DT: f32 = 1.0 / 60.0;

fn precise(gravity: f32) -> PhysicsSimulator {
    PhysicsSimulator::precise([0.0, gravity]).unwrap()
}

fn add_floor(simulator: &mut PhysicsSimulator) {
    let floor = BodyBuilder::fixed().position([0.0, 10.0]);
    simulator.add_body(floor, [GeomBuilder::rectangle(1000.0, 20.0)]).unwrap();
}

fn square() -> GeomBuilder {
    GeomBuilder::rectangle(32.0, 32.0)
}

fn add(simulator: &mut PhysicsSimulator, body: BodyBuilder) -> BodyId {
    simulator.add_body(body, [square()]).unwrap().0
}

fn run(simulator: &mut PhysicsSimulator, updates: usize) {
    (0..updates).for_each(|_| simulator.update(DT));
}

#[test]
fn a_compound_body_has_its_centre_of_mass_as_position_and_its_geoms_in_place() {
    let mut simulator = precise(0.0);
    let geoms = [GeomBuilder::circle(4.0).mass(3.0), GeomBuilder::circle(4.0).mass(1.0).offset([40.0, 0.0])];
    let body = BodyBuilder::dynamic().position([100.0, 0.0]).rotation(std::f32::consts::FRAC_PI_2);
    let (body, [heavy, light]) = simulator.add_body(body, geoms).unwrap();
    assert!((simulator[body].position() - Vector2::new(100.0, 10.0)).norm() < 1e-4);
    assert_eq!(simulator[body].mass(), 4.0);
    // Two discs, 10 and 30 from the centre.
    let expected = 4.0 * 8.0 + 3.0 * 100.0 + 900.0;
    assert!((simulator[body].moment_of_inertia() - expected).abs() < 0.01);
    assert!((simulator.geom(heavy).unwrap().position() - Vector2::new(100.0, 0.0)).norm() < 1e-4);
    assert!((simulator.geom(light).unwrap().position() - Vector2::new(100.0, 40.0)).norm() < 1e-4);
    // A blow through the centre of mass does not turn it.
    simulator[body].apply_impulse(Vector2::new(40.0, 0.0));
    run(&mut simulator, 10);
    assert_eq!(simulator[body].angular_velocity(), 0.0);
}

#[test]
fn a_turned_geom_stays_at_its_offset() {
    let mut simulator = precise(0.0);
    let turned = square().offset([30.0, -7.0]).rotation_offset(0.7);
    let (_, [geom]) = simulator.add_body(BodyBuilder::fixed().position([5.0, 5.0]), [turned]).unwrap();
    assert!((simulator.geom(geom).unwrap().position() - Vector2::new(35.0, -2.0)).norm() < 1e-4);
}

#[test]
fn both_masks_must_agree_and_one_is_enough_for_geoms_of_factories() {
    const A: CollisionCategory = CollisionCategory::CAT1;
    const B: CollisionCategory = CollisionCategory::CAT2;
    // The ball wants to collide with the floor, which wants to collide with no ball.
    for (has_factory_floor, methods) in
        [(false, Methods::PRECISE), (true, Methods::PRECISE), (false, Methods::default())]
    {
        let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 300.0)).unwrap();
        simulator.set_methods(methods).unwrap();
        let floor = BodyBuilder::fixed().position([0.0, 30.0]);
        let floor = match has_factory_floor {
            true => {
                let (body, []) = simulator.add_body(floor, []).unwrap();
                let placement = GeomPlacement::default();
                GeomFactory::create_rectangle_geom_in(&mut simulator, body, 200.0, 20.0, placement).unwrap()
            }
            false => simulator.add_body(floor, [GeomBuilder::rectangle(200.0, 20.0)]).unwrap().1[0],
        };
        simulator[floor].set_collision_categories(A);
        simulator[floor].set_collides_with(A);
        let (ball, [geom]) =
            simulator.add_body(BodyBuilder::dynamic(), [GeomBuilder::circle(10.0).categories(B)]).unwrap();
        run(&mut simulator, 60);
        assert!(simulator[ball].position().y > 100.0, "it fell through the floor");
        // With the rule of the original it would lie on it.
        for geom in [geom, floor] {
            simulator[geom].set_both_must_agree(false);
        }
        simulator[ball].set_position(Vector2::zeros());
        simulator[ball].set_linear_velocity(Vector2::zeros());
        run(&mut simulator, 60);
        assert!((simulator[ball].position().y - 10.0).abs() < 1.0);
    }
}

#[test]
fn a_filter_that_changes_ends_and_begins_touches_and_survives_a_save() {
    let mut simulator = precise(300.0);
    add_floor(&mut simulator);
    let (body, [geom]) =
        simulator.add_body(BodyBuilder::dynamic().position([0.0, -16.0]), [square()]).unwrap();
    run(&mut simulator, 90);
    assert!(simulator.is_asleep(body));
    simulator[geom].set_collides_with(CollisionCategory::NONE);
    let snapshot = simulator.snapshot();
    run(&mut simulator, 30);
    let fallen = simulator[body].position();
    assert!(fallen.y > 10.0);
    simulator.restore(&snapshot).unwrap();
    run(&mut simulator, 30);
    assert_eq!(simulator[body].position(), fallen);
}

#[test]
fn a_locked_rotation_stays_whatever_acts_and_after_a_save() {
    let mut simulator = precise(300.0);
    add_floor(&mut simulator);
    let figure =
        BodyBuilder::dynamic().position([0.0, -40.0]).rotation(0.3).lock_rotation(true).angular_velocity(3.0);
    let figure = add(&mut simulator, figure);
    let ball =
        add(&mut simulator, BodyBuilder::dynamic().position([-60.0, -60.0]).linear_velocity([400.0, 0.0]));
    run(&mut simulator, 20);
    simulator[figure].apply_torque(1e6);
    simulator[figure].apply_angular_impulse(1e6);
    simulator[figure].set_angular_velocity(5.0);
    let snapshot = simulator.snapshot();
    run(&mut simulator, 60);
    assert_eq!((simulator[figure].rotation(), simulator[figure].angular_velocity()), (0.3, 0.0));
    assert!(simulator[figure].position().x > 5.0, "it was hit");
    let states = [figure, ball].map(|body| simulator[body].position());
    simulator.restore(&snapshot).unwrap();
    run(&mut simulator, 60);
    assert_eq!([figure, ball].map(|body| simulator[body].position()), states);
    simulator[figure].set_rotation_locked(false);
    assert!(simulator[figure].inverse_moment_of_inertia() > 0.0);
}

#[test]
fn damping_is_a_rate_with_both_sets() {
    for methods in [Methods::default(), Methods::PRECISE] {
        let mut simulator = PhysicsSimulator::default();
        simulator.set_methods(methods).unwrap();
        let body = BodyBuilder::dynamic().linear_velocity([100.0, 0.0]).angular_velocity(4.0);
        let body = body.linear_damping(0.5).angular_damping(2.0).mass(7.0);
        let (body, _) = simulator.add_body(body, [square()]).unwrap();
        (0..1000).for_each(|_| simulator.update(0.001));
        let [linear, angular] =
            [simulator[body].linear_velocity().x / 100.0, simulator[body].angular_velocity() / 4.0];
        assert!((linear - (-0.5_f32).exp()).abs() < 0.002, "{linear}");
        assert!((angular - (-2.0_f32).exp()).abs() < 0.002, "{angular}");
    }
}

#[test]
fn a_pile_that_starts_asleep_stays_as_it_was_built_and_wakes_when_hit() {
    let mut simulator = precise(300.0);
    add_floor(&mut simulator);
    let place = |row: usize| [0.0, -16.0 - 32.0 * row as f32];
    let boxes: Vec<BodyId> = (0..10)
        .map(|row| add(&mut simulator, BodyBuilder::dynamic().position(place(row)).starts_asleep(true)))
        .collect();
    let floating = add(&mut simulator, BodyBuilder::dynamic().position([200.0, -300.0]).starts_asleep(true));
    let saved = simulator.snapshot();
    for restored in [false, true] {
        if restored {
            simulator.restore(&saved).unwrap();
        }
        simulator.update(DT);
        assert!(boxes.iter().all(|&body| simulator.is_asleep(body)) && simulator.is_asleep(floating));
        run(&mut simulator, 60);
        for (row, &body) in boxes.iter().enumerate() {
            let error = (simulator[body].position() - Vector2::from(place(row))).norm();
            assert!(error < 0.02 && simulator.is_asleep(body), "{row}: {error}");
        }
        assert_eq!(simulator[floating].position(), Vector2::new(200.0, -300.0));
    }
    let ball = BodyBuilder::dynamic().position([-200.0, -60.0]).linear_velocity([2000.0, 0.0]);
    simulator.add_body(ball, [GeomBuilder::circle(10.0)]).unwrap();
    run(&mut simulator, 15);
    assert!(boxes.iter().all(|&body| !simulator.is_asleep(body)), "all of the column");
    assert!(simulator.is_asleep(floating));
    simulator.wake(floating);
    run(&mut simulator, 30);
    assert!(simulator[floating].position().y > -280.0);
}

#[test]
fn a_body_that_starts_asleep_is_awake_if_a_moving_one_touches_it() {
    let mut simulator = precise(300.0);
    add_floor(&mut simulator);
    let sleeper = add(&mut simulator, BodyBuilder::dynamic().position([0.0, -16.0]).starts_asleep(true));
    add(&mut simulator, BodyBuilder::dynamic().position([-32.0, -16.0]).linear_velocity([200.0, 0.0]));
    simulator.update(DT);
    assert!(!simulator.is_asleep(sleeper));
    run(&mut simulator, 5);
    assert!(simulator[sleeper].position().x > 1.0);
}

#[test]
fn a_body_that_may_not_sleep_keeps_its_neighbours_awake_and_wakes() {
    let mut simulator = precise(300.0);
    add_floor(&mut simulator);
    let restless = add(&mut simulator, BodyBuilder::dynamic().position([0.0, -16.0]).sleep_allowed(false));
    let neighbour = add(&mut simulator, BodyBuilder::dynamic().position([0.0, -48.0]));
    let far = add(&mut simulator, BodyBuilder::dynamic().position([200.0, -16.0]));
    run(&mut simulator, 120);
    let snapshot = simulator.snapshot();
    simulator.restore(&snapshot).unwrap();
    run(&mut simulator, 120);
    assert_eq!([restless, neighbour, far].map(|body| simulator.is_asleep(body)), [false, false, true]);
    simulator[restless].set_sleep_allowed(true);
    run(&mut simulator, 120);
    assert!(simulator.is_asleep(restless) && simulator.is_asleep(neighbour));
    simulator[neighbour].set_sleep_allowed(false);
    simulator.update(DT);
    assert!(!simulator.is_asleep(restless) && !simulator.is_asleep(neighbour));
}

#[test]
fn a_sleeping_ragdoll_of_the_game_stops_as_a_whole() {
    let mut simulator = precise(300.0);
    let (links, mut joints) = (3, Vec::new());
    let bodies: Vec<BodyId> = (0..links)
        .map(|i| {
            add(&mut simulator, BodyBuilder::dynamic().position([40.0 * i as f32, 0.0]).angular_velocity(1.0))
        })
        .collect();
    for pair in bodies.windows(2) {
        let anchor = (simulator[pair[0]].position() + simulator[pair[1]].position()) * 0.5;
        let joint =
            farseer_core::JointFactory::create_revolute_joint_in(&mut simulator, pair[0], pair[1], anchor);
        joints.push(joint.unwrap());
    }
    run(&mut simulator, 20);
    assert!(bodies.iter().all(|&body| !simulator.is_asleep(body)));
    simulator.sleep(bodies[1]);
    simulator.update(DT);
    assert!(bodies.iter().all(|&body| simulator.is_asleep(body)));
    let places = bodies.iter().map(|&body| simulator[body].position()).collect::<Vec<_>>();
    run(&mut simulator, 60);
    assert!(bodies.iter().zip(&places).all(|(&body, &place)| simulator[body].position() == place));
    simulator[bodies[0]].apply_impulse(Vector2::new(10.0, 0.0));
    simulator.update(DT);
    assert!(bodies.iter().all(|&body| !simulator.is_asleep(body)));
}

/// Asserts that a call is refused with this reason, and changes no bit.
fn is_refused(simulator: &mut PhysicsSimulator, body: BodyBuilder, geoms: &[GeomBuilder], reason: &str) {
    let before = simulator.snapshot();
    let error = simulator.add_body_with(&body, geoms).unwrap_err();
    assert!(error.to_string().contains(reason), "{error}");
    assert!(simulator.snapshot() == before, "{error}: the call has changed something");
}

#[test]
fn bad_input_is_refused_by_name_and_changes_nothing() {
    let mut simulator = precise(300.0);
    add_floor(&mut simulator);
    let good = [square(), square().offset([32.0, 0.0])];
    let body = BodyBuilder::dynamic;
    let bodies = [
        (body().position([f32::NAN, 0.0]), "position is (NaN, 0.0)"),
        (body().rotation(f32::INFINITY), "rotation is inf"),
        (body().linear_velocity([0.0, f32::NAN]), "linear_velocity"),
        (body().angular_velocity(f32::NAN), "angular_velocity"),
        (body().linear_damping(-1.0), "linear_damping is -1.0"),
        (body().angular_damping(f32::NAN), "angular_damping"),
        (body().gravity_scale(f32::NAN), "gravity_scale"),
        (body().mass(0.0), "mass is 0.0"),
        (body().moment_of_inertia(-2.0), "moment_of_inertia is -2.0"),
    ];
    for (body, reason) in bodies {
        is_refused(&mut simulator, body, &good, reason);
    }
    let points: [[f32; 2]; 0] = [];
    let geoms = [
        (GeomBuilder::rectangle(0.0, 1.0), "width is 0.0"),
        (GeomBuilder::rectangle(1.0, f32::NAN), "height is NaN"),
        (GeomBuilder::circle(-3.0), "radius is -3.0"),
        (GeomBuilder::capsule(10.0, 5.0), "end_radius is 5.0"),
        (GeomBuilder::polygon([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]), "corners"),
        (GeomBuilder::polygon(points), "corners"),
        (GeomBuilder::polygon([[0.0, 0.0], [1.0, f32::NAN], [2.0, 0.0]]), "finite vertices"),
        (GeomBuilder::chain([[0.0, 0.0]]), "points"),
        (square().offset([f32::NAN, 0.0]), "offset"),
        (square().rotation_offset(f32::NAN), "rotation_offset"),
        (square().density(-1.0), "density is -1.0"),
        (square().mass(f32::INFINITY), "mass is inf"),
        (square().friction(-0.5), "friction is -0.5"),
        (square().restitution(f32::NAN), "restitution is NaN"),
        (square().one_way([0.0, 0.0]), "direction"),
    ];
    for (geom, reason) in geoms {
        is_refused(&mut simulator, body(), &[square(), geom], reason);
    }
    is_refused(&mut simulator, body(), &[square(), GeomBuilder::chain([[0.0, 0.0], [1.0, 0.0]])], "static");
    is_refused(&mut simulator, body(), &[square().sensor(true)], "density is 0.0");
    is_refused(&mut simulator, body().position([3e38, 0.0]), &[square().offset([3e38, 0.0])], "finite");
    // The next call succeeds as if there had been no others.
    let (_, [geom]) = simulator.add_body(body(), [square()]).unwrap();
    assert_eq!(simulator.geom(geom).unwrap().id(), 1);
}

#[test]
fn the_faithful_set_refuses_what_it_cannot_do() {
    let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 300.0)).unwrap();
    let body = BodyBuilder::dynamic;
    for (body, geom, reason) in [
        (body().bullet(true), square(), "bullets"),
        (body().starts_asleep(true), square(), "sleep"),
        (body().sleep_allowed(false), square(), "sleep"),
        (body().sleep_events(true), square(), "sleep"),
        (body(), square().events(WantedEvents::HIT), "typed events"),
        (body(), square().one_way([0.0, -1.0]), "one-way geoms"),
        (BodyBuilder::fixed(), GeomBuilder::chain([[0.0, 0.0], [1.0, 0.0]]), "chains"),
    ] {
        is_refused(&mut simulator, body, &[geom], &format!("the faithful methods have no {reason}"));
    }
    // All else works: a box falls on a floor, and a locked figure does not turn.
    add_floor(&mut simulator);
    let figure = add(&mut simulator, body().position([0.0, -60.0]).rotation(0.2).lock_rotation(true));
    run(&mut simulator, 300);
    assert_eq!(simulator[figure].rotation(), 0.2);
    assert!(simulator[figure].position().y.abs() < 30.0);
}

#[test]
fn geoms_are_added_to_bodies_that_exist_and_stale_ids_are_refused() {
    let mut simulator = precise(0.0);
    let body = add(&mut simulator, BodyBuilder::dynamic());
    simulator.update(DT);
    let geom = simulator.add_geom(body, &GeomBuilder::circle(4.0).offset([0.0, 20.0]).user_data(7)).unwrap();
    assert_eq!((simulator[geom].tag(), simulator[body].mass()), (7, 1.0));
    simulator.dispose(body).unwrap();
    simulator.update(DT);
    assert_eq!(simulator.add_geom(body, &square()), Err(Error::StaleId { argument: "body" }));
}
