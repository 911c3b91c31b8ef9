//! Bodies at rest under the precise set sleep, and wake when a disturbance could move them.

use farseer_core::math::Vector2;
use farseer_core::{
    AwakeReason, Body, BodyFactory, BodyId, CollisionCategory, Event, EventHandler, FrictionType,
    GeomFactory, GeomPlacement, JointFactory, Methods, PhysicsSimulator, PhysicsSimulatorView, SpringFactory,
};

const DT: f32 = 1.0 / 60.0;

fn simulator() -> PhysicsSimulator {
    let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 320.0)).unwrap();
    simulator.set_methods(Methods::PRECISE).unwrap();
    simulator.set_iterations(4);
    simulator
}

fn add_box(simulator: &mut PhysicsSimulator, at: [f32; 2], size: [f32; 2]) -> BodyId {
    let body = BodyFactory::create_rectangle_body_in(simulator, size[0], size[1], 1.0).unwrap();
    simulator[body].set_position(Vector2::new(at[0], at[1]));
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_rectangle_geom_in(simulator, body, size[0], size[1], placement).unwrap();
    simulator.geom_mut(geom).unwrap().set_friction_coefficient(0.5);
    body
}

/// A floor with its top at y = 0.
fn add_floor(simulator: &mut PhysicsSimulator) -> BodyId {
    let floor = add_box(simulator, [0.0, 10.0], [800.0, 20.0]);
    simulator[floor].set_is_static(true);
    floor
}

/// A column of this many boxes of 20 at an x.
fn add_column(simulator: &mut PhysicsSimulator, x: f32, count: usize) -> Vec<BodyId> {
    (0..count).map(|i| add_box(simulator, [x, -10.0 - 20.0 * i as f32], [20.0, 20.0])).collect()
}

fn run(simulator: &mut PhysicsSimulator, seconds: f32) {
    (0..(seconds / DT).round() as usize).for_each(|_| simulator.update(DT));
}

fn asleep(simulator: &PhysicsSimulator, bodies: &[BodyId]) -> usize {
    bodies.iter().filter(|&&body| simulator.is_asleep(body)).count()
}

/// Three columns far from each other that sleep.
fn sleeping_columns() -> (PhysicsSimulator, BodyId, [Vec<BodyId>; 3]) {
    let mut simulator = simulator();
    let floor = add_floor(&mut simulator);
    let columns = [-200.0, 0.0, 200.0].map(|x| add_column(&mut simulator, x, 3));
    run(&mut simulator, 5.0);
    columns.iter().for_each(|column| assert_eq!(asleep(&simulator, column), 3));
    (simulator, floor, columns)
}

#[test]
fn a_sleeping_body_keeps_its_pose_to_the_last_bit() {
    let (mut simulator, _, columns) = sleeping_columns();
    let places = |simulator: &PhysicsSimulator| -> Vec<(u32, u32, u32)> {
        let bits = |body: &Body| {
            (body.position().x.to_bits(), body.position().y.to_bits(), body.rotation().to_bits())
        };
        columns.iter().flatten().map(|&body| bits(&simulator[body])).collect()
    };
    let before = places(&simulator);
    run(&mut simulator, 2.0);
    assert_eq!(places(&simulator), before);
    assert!(columns.iter().flatten().all(|&body| simulator[body].linear_velocity() == Vector2::zeros()));
}

#[test]
fn a_step_in_which_all_sleep_tests_no_pair_and_solves_no_constraint() {
    let (mut simulator, ..) = sleeping_columns();
    simulator.update(DT);
    let counters = simulator.counters();
    assert_eq!((counters.pairs_tested, counters.contacts_solved, counters.bodies_moved), (0, 0, 0));
    assert_eq!((counters.bodies_asleep, counters.pairs_touching), (9, 9));
    assert_eq!(counters.aabbs_renewed, 0);
    assert!(simulator.events().is_empty());
}

#[test]
fn fat_aabbs_are_renewed_for_new_shapes_and_where_bodies_fall() {
    let mut simulator = simulator();
    add_floor(&mut simulator);
    add_column(&mut simulator, 0.0, 3);
    simulator.update(DT);
    assert_eq!(simulator.counters().aabbs_renewed, 4);
    simulator.update(DT);
    assert_eq!(simulator.counters().aabbs_renewed, 0);
    // After 1 s of falling it moves by over 5 px a step, which is more than a fat AABB leaves free in a few steps.
    let falling = add_box(&mut simulator, [100.0, -1000.0], [20.0, 20.0]);
    run(&mut simulator, 1.0);
    let renewed: usize = (0..30)
        .map(|_| {
            simulator.update(DT);
            simulator.counters().aabbs_renewed
        })
        .sum();
    assert!((1..=30).contains(&renewed) && simulator[falling].position().y < -500.0, "{renewed}");
}

/// A handler without callbacks; but with a handler all stages run, even if all bodies sleep.
struct Listens;

impl EventHandler for Listens {}

#[test]
fn updates_of_a_sleeping_world_and_later_ones_have_the_same_bits_with_a_handler() {
    let (mut alone, floor, columns) = sleeping_columns();
    let mut heard = alone.clone();
    let mut both = |updates: usize, edit: &dyn Fn(&mut PhysicsSimulator)| {
        [&mut alone, &mut heard].into_iter().for_each(edit);
        for _ in 0..updates {
            alone.update(DT);
            heard.update_with(DT, &mut Listens);
            assert_eq!(alone.snapshot(), heard.snapshot());
            assert_eq!(alone.counters(), heard.counters());
            assert_eq!(alone.events(), heard.events());
        }
    };
    both(10, &|_| ());
    both(1, &|simulator| simulator.set_iterations(8));
    both(60, &|simulator| simulator[columns[0][1]].apply_impulse(Vector2::new(40.0, 0.0)));
    both(300, &|simulator| simulator[floor].set_position(Vector2::new(0.0, 30.0)));
    both(10, &|simulator| simulator.set_friction_type(FrictionType::Minimum));
    assert_eq!(columns.iter().map(|column| asleep(&alone, column)).sum::<usize>(), 0);
}

#[test]
fn a_landing_body_wakes_only_the_island_below_it() {
    let (mut simulator, _, columns) = sleeping_columns();
    add_box(&mut simulator, [0.0, -90.0], [20.0, 20.0]);
    run(&mut simulator, 0.1);
    assert_eq!(columns.each_ref().map(|column| asleep(&simulator, column)), [3, 3, 3], "it still falls");
    run(&mut simulator, 0.3);
    assert_eq!(columns.each_ref().map(|column| asleep(&simulator, column)), [3, 0, 3]);
    run(&mut simulator, 5.0);
    assert_eq!(columns.each_ref().map(|column| asleep(&simulator, column)), [3, 3, 3]);
}

#[test]
fn all_bodies_of_an_island_sleep_and_wake_together() {
    let (mut simulator, _, [left, ..]) = sleeping_columns();
    simulator[left[0]].apply_impulse(Vector2::new(30.0, 0.0));
    simulator.update(DT);
    assert_eq!(asleep(&simulator, &left), 0);
    while asleep(&simulator, &left) == 0 {
        simulator.update(DT);
    }
    assert_eq!(asleep(&simulator, &left), 3);
}

#[test]
fn a_body_that_loses_its_support_wakes_and_falls() {
    type Remove = fn(&mut PhysicsSimulator, BodyId);
    let removals: [(&str, Remove); 6] = [
        ("disposed", |simulator, floor| simulator.dispose(floor).unwrap()),
        ("without a geom", |simulator, floor| simulator.remove(simulator.geoms_of(floor)[0]).unwrap()),
        ("disabled", |simulator, floor| simulator[floor].set_enabled(false)),
        ("moved", |simulator, floor| simulator[floor].set_position(Vector2::new(0.0, 300.0))),
        ("made a sensor", |simulator, floor| {
            let geom = simulator.geoms_of(floor)[0];
            simulator.geom_mut(geom).unwrap().set_collision_response_enabled(false);
        }),
        ("filtered", |simulator, floor| {
            let geom = simulator.geoms_of(floor)[0];
            let geom = simulator.geom_mut(geom).unwrap();
            geom.set_collides_with(CollisionCategory::NONE);
            geom.set_collision_categories(CollisionCategory::NONE);
        }),
    ];
    for (how, remove) in removals {
        let (mut simulator, floor, columns) = sleeping_columns();
        remove(&mut simulator, floor);
        run(&mut simulator, 0.5);
        for &body in columns.iter().flatten() {
            assert!(simulator[body].linear_velocity().y > 100.0, "{how}: {:?}", simulator.why_awake(body));
        }
    }
}

#[test]
fn a_lift_that_starts_wakes_its_load() {
    let mut simulator = simulator();
    let lift = add_floor(&mut simulator);
    simulator[lift].set_is_kinematic(true);
    let column = add_column(&mut simulator, 0.0, 3);
    run(&mut simulator, 5.0);
    assert_eq!(asleep(&simulator, &column), 3);
    simulator[lift].set_linear_velocity(Vector2::new(0.0, -30.0));
    run(&mut simulator, 2.0);
    assert_eq!(asleep(&simulator, &column), 0, "what is carried does not sleep");
    // 60 px up, within the yield of contacts.
    assert!((simulator[column[0]].position().y + 70.0).abs() < 0.2, "{}", simulator[column[0]].position());
}

#[test]
fn a_belt_that_starts_wakes_its_load() {
    let (mut simulator, floor, columns) = sleeping_columns();
    simulator[floor].set_linear_velocity(Vector2::new(10.0, 0.0));
    run(&mut simulator, 1.0);
    assert!(columns.iter().flatten().all(|&body| simulator[body].linear_velocity().x > 5.0));
}

#[test]
fn a_change_of_gravity_wakes_all_bodies() {
    let (mut simulator, _, columns) = sleeping_columns();
    simulator.set_gravity(Vector2::new(0.0, -320.0)).unwrap();
    run(&mut simulator, 0.5);
    assert!(columns.iter().flatten().all(|&body| simulator[body].linear_velocity().y < -100.0));
}

#[test]
fn with_sleep_disabled_all_bodies_are_awake() {
    let (mut simulator, _, columns) = sleeping_columns();
    simulator.set_sleep_enabled(false);
    run(&mut simulator, 3.0);
    assert!(columns.iter().all(|column| asleep(&simulator, column) == 0));
    assert_eq!(simulator.why_awake(columns[0][0]), Some(AwakeReason::SleepDisabled));
}

#[test]
fn bodies_sleep_in_a_constant_wind_and_a_gust_wakes_them() {
    let mut simulator = simulator();
    add_floor(&mut simulator);
    let body = add_box(&mut simulator, [0.0, -10.0], [20.0, 20.0]);
    let blow = |simulator: &mut PhysicsSimulator, wind: f32, seconds: f32| {
        for _ in 0..(seconds / DT) as usize {
            simulator[body].apply_force(Vector2::new(wind, 0.0));
            simulator.update(DT);
        }
    };
    // Friction holds half of the weight, 320.
    blow(&mut simulator, 100.0, 5.0);
    assert!(simulator.is_asleep(body));
    blow(&mut simulator, 250.0, 0.1);
    assert!(simulator[body].linear_velocity().x > 5.0, "the gust pushes it in the very step it comes");
    blow(&mut simulator, 100.0, 5.0);
    assert!(simulator.is_asleep(body));
    run(&mut simulator, DT);
    assert!(!simulator.is_asleep(body), "the wind has gone");
}

#[test]
fn a_body_on_a_spring_sleeps_and_falls_when_the_spring_is_removed() {
    let mut simulator = simulator();
    let body = add_box(&mut simulator, [0.0, 0.0], [20.0, 20.0]);
    let spring = SpringFactory::create_fixed_linear_spring_in(
        &mut simulator,
        body,
        Vector2::zeros(),
        Vector2::new(0.0, -50.0),
        100.0,
        10.0,
    )
    .unwrap();
    run(&mut simulator, 10.0);
    assert_eq!(simulator.why_awake(body), None);
    simulator.dispose(spring).unwrap();
    run(&mut simulator, 0.5);
    assert!(simulator[body].linear_velocity().y > 100.0);
}

#[test]
fn a_body_on_a_joint_sleeps_and_falls_when_the_joint_is_removed() {
    let mut simulator = simulator();
    let bodies: Vec<BodyId> =
        (0..3).map(|i| add_box(&mut simulator, [0.0, 30.0 * i as f32], [10.0, 20.0])).collect();
    let first = Vector2::new(0.0, -15.0);
    let hinge = JointFactory::create_fixed_revolute_joint_in(&mut simulator, bodies[0], first).unwrap();
    for pair in bodies.windows(2) {
        let between = (simulator[pair[0]].position() + simulator[pair[1]].position()) * 0.5;
        JointFactory::create_revolute_joint_in(&mut simulator, pair[0], pair[1], between).unwrap();
    }
    run(&mut simulator, 2.0);
    assert_eq!(asleep(&simulator, &bodies), 3);
    simulator.dispose(hinge).unwrap();
    run(&mut simulator, 0.5);
    assert!(bodies.iter().all(|&body| simulator[body].linear_velocity().y > 100.0));
}

/// A box that sleeps on a static body without geoms, to which a pin holds it.
fn sleeping_on_a_post() -> (PhysicsSimulator, [BodyId; 2]) {
    let mut simulator = simulator();
    let post = BodyFactory::create_rectangle_body_in(&mut simulator, 10.0, 10.0, 1.0).unwrap();
    simulator[post].set_is_static(true);
    let hanging = add_box(&mut simulator, [0.0, 40.0], [20.0, 20.0]);
    let middle = Vector2::zeros();
    JointFactory::create_pin_joint_in(&mut simulator, post, middle, hanging, middle).unwrap();
    run(&mut simulator, 3.0);
    assert!(simulator.is_asleep(hanging));
    (simulator, [post, hanging])
}

#[test]
fn a_body_joined_to_one_without_geoms_wakes_when_that_is_moved_also_after_a_restore() {
    let (mut plain, [post, hanging]) = sleeping_on_a_post();
    plain[post].set_position(Vector2::new(0.0, 10.0));
    let mut restored = simulator();
    restored.restore(&plain.snapshot()).unwrap();
    for simulator in [&mut plain, &mut restored] {
        run(simulator, 1.0);
        assert!((simulator[hanging].position().y - 50.0).abs() < 0.01, "{}", simulator[hanging].position());
    }
    assert!(plain.snapshot() == restored.snapshot());
}

#[test]
fn bodies_woken_right_after_a_restore_wake_after_any_earlier_edit() {
    let (mut plain, _, [_, middle, right]) = sleeping_columns();
    plain[middle[2]].set_position(Vector2::new(0.0, -60.0));
    let mut restored = simulator();
    restored.restore(&plain.snapshot()).unwrap();
    for simulator in [&mut plain, &mut restored] {
        simulator.wake(right[0]);
        simulator.update(DT);
        assert_eq!(asleep(simulator, &right), 0);
    }
    assert!(plain.snapshot() == restored.snapshot());
}

#[test]
fn a_new_joint_wakes_its_bodies() {
    let (mut simulator, _, [left, middle, _]) = sleeping_columns();
    JointFactory::create_pin_joint_in(&mut simulator, left[2], Vector2::zeros(), middle[2], Vector2::zeros())
        .unwrap();
    simulator.update(DT);
    assert_eq!((asleep(&simulator, &left), asleep(&simulator, &middle)), (0, 0));
}

#[test]
fn a_body_that_drifts_in_empty_space_does_not_sleep() {
    let mut simulator = simulator();
    simulator.set_gravity(Vector2::zeros()).unwrap();
    let body = add_box(&mut simulator, [0.0, 0.0], [20.0, 20.0]);
    simulator[body].set_linear_velocity(Vector2::new(0.5, 0.0));
    simulator[body].set_linear_drag_coefficient(0.0);
    run(&mut simulator, 10.0);
    // 600 steps rounded to f32 at about 5 px: far below.
    assert!((simulator[body].position().x - 5.0).abs() < 0.001);
}

#[test]
fn a_pendulum_does_not_fall_asleep_where_it_turns() {
    let mut simulator = simulator();
    let body = add_box(&mut simulator, [20.0, 100.0], [10.0, 10.0]);
    JointFactory::create_fixed_revolute_joint_in(&mut simulator, body, Vector2::zeros()).unwrap();
    for _ in 0..1200 {
        simulator.update(DT);
        assert!(!simulator.is_asleep(body));
    }
}

#[test]
fn the_reason_for_being_awake_is_reported() {
    let mut simulator = simulator();
    let floor = add_floor(&mut simulator);
    let column = add_column(&mut simulator, 0.0, 2);
    let falling = add_box(&mut simulator, [200.0, -300.0], [20.0, 20.0]);
    run(&mut simulator, 0.3);
    assert!(matches!(simulator.why_awake(falling), Some(AwakeReason::Moves { .. })));
    assert_eq!(simulator.why_awake(floor), Some(AwakeReason::NeverSleeps));
    assert!(matches!(simulator.why_awake(column[0]), Some(AwakeReason::RestsSince { .. })));
    run(&mut simulator, 3.0);
    assert_eq!(simulator.why_awake(column[0]), None);
    simulator[column[1]].set_linear_velocity(Vector2::new(20.0, 0.0));
    (0..2).for_each(|_| simulator.update(DT));
    assert_eq!(simulator.why_awake(column[0]), Some(AwakeReason::HangsTogether { with: column[1] }));
}

#[test]
fn a_refused_contact_wakes_no_body() {
    struct Refuser(farseer_core::GeomId);
    impl farseer_core::EventHandler for Refuser {
        fn on_collision(
            &mut self,
            _: &mut farseer_core::Context,
            this: farseer_core::GeomId,
            other: farseer_core::GeomId,
            _: &mut Vec<farseer_core::Contact>,
        ) -> bool {
            ![this, other].contains(&self.0)
        }
    }
    let (mut simulator, _, [left, ..]) = sleeping_columns();
    let ghost = add_box(&mut simulator, [-200.0, -100.0], [20.0, 20.0]);
    let mut refuser = Refuser(simulator.geoms_of(ghost)[0]);
    (0..60).for_each(|_| simulator.update_with(DT, &mut refuser));
    assert!(simulator[ghost].position().y > 0.0, "it has flown through");
    assert_eq!(asleep(&simulator, &left), 3);
}

#[test]
fn a_handler_is_called_for_sleeping_contacts_and_wakes_them_by_another_answer() {
    struct Asked {
        count: usize,
        refuses: bool,
    }
    impl farseer_core::EventHandler for Asked {
        fn on_collision(
            &mut self,
            _: &mut farseer_core::Context,
            _: farseer_core::GeomId,
            _: farseer_core::GeomId,
            _: &mut Vec<farseer_core::Contact>,
        ) -> bool {
            self.count += 1;
            !self.refuses
        }
    }
    let (mut simulator, _, columns) = sleeping_columns();
    let mut handler = Asked { count: 0, refuses: false };
    simulator.update_with(DT, &mut handler);
    assert_eq!((handler.count, simulator.counters().bodies_asleep), (18, 9), "both sides of nine touches");
    handler.refuses = true;
    (0..30).for_each(|_| simulator.update_with(DT, &mut handler));
    assert!(columns.iter().flatten().all(|&body| simulator[body].linear_velocity().y > 100.0));
}

#[test]
fn sleeping_bodies_have_no_events_but_separations() {
    let (mut simulator, _, [left, ..]) = sleeping_columns();
    simulator.dispose(left[2]).unwrap();
    simulator.update(DT);
    let told = |event: &Event| matches!(event, Event::BodyUpdated { .. } | Event::Collision { .. });
    assert_eq!(asleep(&simulator, &left[..2]), 0);
    simulator.events().iter().filter(|event| told(event)).for_each(|event| {
        assert!(matches!(event, Event::BodyUpdated { body } if left.contains(body)), "{event:?}");
    });
}

#[test]
fn islands_are_the_bodies_connected_by_contacts_and_joints() {
    let (mut simulator, _, [left, middle, right]) = sleeping_columns();
    simulator.wake(middle[0]);
    simulator.update(DT);
    let islands = simulator.islands();
    let found: Vec<(&[BodyId], bool)> =
        islands.iter().map(|island| (&island.bodies[..], island.is_asleep)).collect();
    assert_eq!(found, [(&middle[..], false), (&left[..], true), (&right[..], true)]);
    let mut lines = 0;
    PhysicsSimulatorView::default().draw_islands(&simulator, |_| lines += 1);
    assert_eq!(lines, 12, "a box round each");
}

#[test]
fn a_body_at_rest_keeps_its_contacts_from_step_to_step() {
    let mut simulator = simulator();
    simulator.set_sleep_enabled(false);
    add_floor(&mut simulator);
    let column = add_column(&mut simulator, 0.0, 5);
    run(&mut simulator, 2.0);
    assert_eq!(simulator.counters().manifolds_made, 0);
    // Two points between each two boxes, and on the floor.
    assert_eq!(simulator.counters().contacts_solved, 10);
    simulator[column[4]].set_position(Vector2::new(5.0, -90.0));
    simulator.update(DT);
    assert_eq!(simulator.counters().manifolds_made, 1);
}

/// A scene that joins, sleeps, wakes, breaks and splits.
fn busy() -> (PhysicsSimulator, Vec<BodyId>) {
    let mut simulator = simulator();
    add_floor(&mut simulator);
    let mut bodies = add_column(&mut simulator, -100.0, 3);
    bodies.extend(add_column(&mut simulator, 100.0, 2));
    let rope: Vec<BodyId> =
        (0..3).map(|i| add_box(&mut simulator, [0.0, -160.0 + 30.0 * i as f32], [10.0, 20.0])).collect();
    for pair in rope.windows(2) {
        let between = (simulator[pair[0]].position() + simulator[pair[1]].position()) * 0.5;
        JointFactory::create_revolute_joint_in(&mut simulator, pair[0], pair[1], between).unwrap();
    }
    let above = Vector2::new(0.0, -175.0);
    let hook = JointFactory::create_fixed_revolute_joint_in(&mut simulator, rope[0], above).unwrap();
    simulator[hook].set_greatest_force(2e3).unwrap();
    bodies.extend(rope);
    (simulator, bodies)
}

#[test]
fn a_scene_that_sleeps_and_wakes_goes_on_with_the_same_bits_after_a_restore_in_every_step() {
    let (mut simulator, bodies) = busy();
    let mut restored = simulator.clone();
    let (mut most, mut least, mut breaks) = (0, usize::MAX, 0);
    for step in 0..600 {
        for simulator in [&mut simulator, &mut restored] {
            match step {
                // An impulse on the rope, then one on a column; a support is removed, and the hook breaks.
                150 => simulator[bodies[6]].apply_impulse(Vector2::new(200.0, 0.0)),
                300 => simulator[bodies[0]].set_linear_velocity(Vector2::new(60.0, 0.0)),
                400 => simulator.dispose(bodies[3]).unwrap(),
                450 => simulator[bodies[7]].apply_impulse(Vector2::new(0.0, 5e3)),
                _ => {}
            }
            simulator.update(DT);
        }
        breaks += simulator.events().iter().filter(|event| matches!(event, Event::JointBroke { .. })).count();
        if step > 100 {
            let asleep = simulator.counters().bodies_asleep;
            (most, least) = (most.max(asleep), least.min(asleep));
        }
        let snapshot = restored.snapshot();
        assert!(snapshot == simulator.snapshot(), "step {step}");
        restored = PhysicsSimulator::default();
        restored.restore(&snapshot).unwrap();
    }
    assert_eq!((most, breaks), (8, 1));
    assert!(least < 5, "{least}");
}
