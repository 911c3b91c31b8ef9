//! The precise set: sensors report static and kinematic bodies, and every touch that begins is reported to end.

use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, CollisionCategory, Contact, Context, Event, EventHandler, GeomFactory, GeomId,
    GeomPlacement, Methods, PhysicsSimulator,
};

const DT: f32 = 1.0 / 60.0;

fn v(x: f32, y: f32) -> Vector2 {
    Vector2::new(x, y)
}

fn precise(gravity: f32) -> PhysicsSimulator {
    let mut simulator = PhysicsSimulator::new(v(0.0, gravity)).unwrap();
    simulator.set_methods(Methods::PRECISE).unwrap();
    simulator.set_iterations(4);
    simulator
}

fn add_box(simulator: &mut PhysicsSimulator, at: Vector2, size: f32) -> (BodyId, GeomId) {
    let body = BodyFactory::create_rectangle_body_in(simulator, size, size, 1.0).unwrap();
    simulator[body].set_position(at);
    let placement = GeomPlacement::default();
    (body, GeomFactory::create_rectangle_geom_in(simulator, body, size, size, placement).unwrap())
}

fn add_static(simulator: &mut PhysicsSimulator, at: Vector2, size: f32) -> (BodyId, GeomId) {
    let added = add_box(simulator, at, size);
    simulator[added.0].set_is_static(true);
    added
}

fn add_kinematic(simulator: &mut PhysicsSimulator, at: Vector2, size: f32) -> (BodyId, GeomId) {
    let added = add_box(simulator, at, size);
    simulator[added.0].set_is_kinematic(true);
    added
}

fn add_sensor(simulator: &mut PhysicsSimulator, at: Vector2, size: f32) -> (BodyId, GeomId) {
    let added = add_box(simulator, at, size);
    simulator.set_is_sensor(added.1, true).unwrap();
    added
}

/// Numbers of touches with another geom that began and ended in the last update.
fn told(simulator: &PhysicsSimulator, this: GeomId, other: GeomId) -> [usize; 2] {
    let sides = |event: &Event| match *event {
        Event::Collision { this, other, .. } => Some((0, this, other)),
        Event::Separation { this, other } => Some((1, this, other)),
        _ => None,
    };
    let mut counts = [0; 2];
    for (kind, one, partner) in simulator.events().iter().filter_map(sides) {
        counts[kind] += usize::from((one, partner) == (this, other));
    }
    counts
}

/// Makes a number of updates, and adds up the events of a geom.
fn told_in(simulator: &mut PhysicsSimulator, updates: usize, this: GeomId, other: GeomId) -> [usize; 2] {
    (0..updates).fold([0; 2], |sum, _| {
        simulator.update(DT);
        let now = told(simulator, this, other);
        [sum[0] + now[0], sum[1] + now[1]]
    })
}

fn restored(simulator: &PhysicsSimulator) -> PhysicsSimulator {
    let mut copy = PhysicsSimulator::default();
    copy.restore(&simulator.snapshot()).unwrap();
    copy
}

#[test]
fn a_sensor_reports_once_bodies_of_each_type_that_are_in_it_from_the_start() {
    let mut simulator = precise(0.0);
    let (_, sensor) = add_sensor(&mut simulator, v(0.0, 0.0), 100.0);
    let inside = [
        add_static(&mut simulator, v(-30.0, 0.0), 20.0),
        add_kinematic(&mut simulator, v(0.0, 0.0), 20.0),
        add_box(&mut simulator, v(30.0, 0.0), 20.0),
        add_sensor(&mut simulator, v(0.0, 30.0), 20.0),
    ];
    let (_, outside) = add_static(&mut simulator, v(200.0, 0.0), 20.0);
    for (_, geom) in inside {
        let mut copy = simulator.clone();
        assert_eq!(told_in(&mut copy, 120, sensor, geom), [1, 0]);
        assert_eq!(copy.overlaps(geom), [sensor]);
    }
    assert_eq!(told_in(&mut simulator, 120, sensor, outside), [0, 0]);
    assert_eq!(simulator.overlaps(sensor).len(), inside.len());
    let copy = restored(&simulator);
    assert_eq!(copy.overlaps(sensor).len(), inside.len());
}

#[test]
fn a_sensor_reports_bodies_created_in_it_or_moved_into_and_out_of_it() {
    let mut simulator = precise(0.0);
    let (_, sensor) = add_sensor(&mut simulator, v(0.0, 0.0), 100.0);
    simulator.update(DT);
    let (tile, of_tile) = add_static(&mut simulator, v(-30.0, 0.0), 20.0);
    assert_eq!(told_in(&mut simulator, 10, sensor, of_tile), [1, 0]);
    simulator[tile].set_position(v(-300.0, 0.0));
    assert_eq!(told_in(&mut simulator, 10, sensor, of_tile), [0, 1]);
    simulator[tile].set_position(v(-30.0, 0.0));
    assert_eq!(told_in(&mut simulator, 10, sensor, of_tile), [1, 0]);
    let (lift, of_lift) = add_kinematic(&mut simulator, v(-100.0, 0.0), 20.0);
    simulator.update(DT);
    assert_eq!(simulator.overlaps(sensor), [of_tile]);
    // From -100 to 100 at 60 px/s: it is inside from -60 to 60.
    simulator[lift].set_linear_velocity(v(60.0, 0.0));
    assert_eq!(told_in(&mut simulator, 30, sensor, of_lift), [0, 0]);
    assert_eq!(told_in(&mut simulator, 20, sensor, of_lift), [1, 0]);
    assert_eq!(told_in(&mut simulator, 100, sensor, of_lift), [0, 0]);
    assert_eq!(told_in(&mut simulator, 50, sensor, of_lift), [0, 1]);
}

#[test]
fn a_geom_that_becomes_a_sensor_reports_present_touches_and_all_that_end() {
    let mut simulator = precise(0.0);
    let (body, geom) = add_static(&mut simulator, v(0.0, 0.0), 100.0);
    let (_, tile) = add_static(&mut simulator, v(30.0, 0.0), 20.0);
    assert_eq!(told_in(&mut simulator, 10, geom, tile), [0, 0]);
    simulator.set_is_sensor(geom, true).unwrap();
    assert_eq!(told_in(&mut simulator, 10, geom, tile), [1, 0]);
    simulator[geom].set_collision_response_enabled(true);
    assert_eq!(told_in(&mut simulator, 10, geom, tile), [0, 1]);
    simulator[geom].set_collision_response_enabled(false);
    assert_eq!(told_in(&mut simulator, 10, geom, tile), [1, 0]);
    // A sensor that moves.
    simulator[body].set_is_static(false);
    simulator[body].set_is_kinematic(true);
    assert_eq!(told_in(&mut simulator, 10, geom, tile), [0, 0]);
    simulator[body].set_linear_velocity(v(-60.0, 0.0));
    assert_eq!(told_in(&mut simulator, 120, geom, tile), [0, 1]);
}

#[test]
fn every_touch_ends_by_categories_groups_ignored_pairs_disabling_removal_and_disposal() {
    type End = fn(&mut PhysicsSimulator, BodyId, GeomId);
    let ends: [(&str, End); 7] = [
        ("group", |simulator, body, geom| {
            let other = simulator.geoms().find(|&other| other != geom).unwrap();
            assert!(simulator.body_of(geom) == Some(body));
            [geom, other].into_iter().for_each(|geom| simulator[geom].set_collision_group(5));
        }),
        ("categories", |simulator, _, geom| {
            simulator[geom].set_collision_categories(CollisionCategory::NONE);
            simulator[geom].set_collides_with(CollisionCategory::NONE);
        }),
        ("disabled", |simulator, body, _| simulator[body].set_enabled(false)),
        ("removed geom", |simulator, _, geom| simulator.remove(geom).unwrap()),
        ("disposed body", |simulator, body, _| simulator.dispose(body).unwrap()),
        ("disposed geom", |simulator, _, geom| simulator.dispose(geom).unwrap()),
        ("teleported", |simulator, body, _| simulator[body].set_position(v(500.0, 0.0))),
    ];
    type Add = fn(&mut PhysicsSimulator, Vector2, f32) -> (BodyId, GeomId);
    let kinds: [(&str, Add); 3] =
        [("static", add_static), ("kinematic", add_kinematic), ("dynamic", add_box)];
    for (how, end) in ends {
        for (kind, add) in kinds {
            for is_restored in [false, true] {
                let mut simulator = precise(0.0);
                let (_, sensor) = add_sensor(&mut simulator, v(0.0, 0.0), 100.0);
                let (body, geom) = add(&mut simulator, v(0.0, 0.0), 20.0);
                assert_eq!(told_in(&mut simulator, 60, sensor, geom), [1, 0], "{how}, {kind}");
                if is_restored {
                    simulator = restored(&simulator);
                }
                end(&mut simulator, body, geom);
                if is_restored {
                    simulator = restored(&simulator);
                }
                assert_eq!(told_in(&mut simulator, 10, sensor, geom), [0, 1], "{how}, {kind}, {is_restored}");
                assert!(simulator.overlaps(sensor).is_empty(), "{how}, {kind}");
            }
        }
    }
}

#[test]
fn a_contact_with_impulses_lasts_through_changes_of_pieces_and_body_type_and_ends() {
    let mut simulator = precise(900.0);
    let (_, floor) = add_static(&mut simulator, v(0.0, 50.0), 100.0);
    let (body, geom) = add_box(&mut simulator, v(0.0, -10.0), 20.0);
    assert_eq!(told_in(&mut simulator, 120, floor, geom), [1, 0]);
    // A floor of several convex pieces with the same top.
    let notched = [[-50.0, -50.0], [50.0, -50.0], [50.0, 50.0], [0.0, 20.0], [-50.0, 50.0]];
    let notched = notched.into_iter().map(|[x, y]| v(x, y)).collect::<farseer_core::shape::Vertices>();
    simulator.set_vertices(floor, notched).unwrap();
    assert_eq!(told_in(&mut simulator, 30, floor, geom), [0, 0]);
    // A change of the body type causes no new event, either.
    simulator[body].set_is_kinematic(true);
    simulator[body].set_is_kinematic(false);
    assert_eq!(told_in(&mut simulator, 30, floor, geom), [0, 0]);
    simulator[geom].set_collision_categories(CollisionCategory::NONE);
    simulator[geom].set_collides_with(CollisionCategory::NONE);
    assert_eq!(told_in(&mut simulator, 30, floor, geom), [0, 1]);
}

/// Counts the calls of the handler.
#[derive(Default)]
struct Counter {
    begun: usize,
    ended: usize,
}

impl EventHandler for Counter {
    fn on_collision(
        &mut self,
        _: &mut Context<'_>,
        _: GeomId,
        _: GeomId,
        contacts: &mut Vec<Contact>,
    ) -> bool {
        assert!(!contacts.is_empty());
        self.begun += 1;
        true
    }

    fn on_separation(&mut self, context: &mut Context<'_>, this: GeomId, _: GeomId) {
        // Each geom of a callback exists.
        assert!(context.geom(this).is_some());
        self.ended += 1;
    }
}

#[test]
fn a_sensor_reports_a_static_body_once_and_its_disposal() {
    let mut simulator = precise(0.0);
    add_sensor(&mut simulator, v(0.0, 0.0), 100.0);
    let (tile, _) = add_static(&mut simulator, v(0.0, 0.0), 20.0);
    let mut counter = Counter::default();
    (0..60).for_each(|_| simulator.update_with(DT, &mut counter));
    assert_eq!((counter.begun, counter.ended), (2, 0));
    simulator.dispose(tile).unwrap();
    (0..10).for_each(|_| simulator.update_with(DT, &mut counter));
    assert_eq!((counter.begun, counter.ended), (2, 1));
}

#[test]
fn a_sensor_over_a_thousand_static_tiles_tests_each_once() {
    let mut simulator = precise(900.0);
    let (_, sensor) = add_sensor(&mut simulator, v(500.0, 0.0), 2000.0);
    for tile in 0..1000 {
        add_static(&mut simulator, v(10.0 * (tile % 100) as f32, 10.0 * (tile / 100) as f32), 10.0);
    }
    simulator.update(DT);
    assert_eq!(simulator.counters().pairs_tested, 1000);
    assert_eq!(simulator.overlaps(sensor).len(), 1000);
    simulator.update(DT);
    assert_eq!(simulator.counters().pairs_tested, 0);
    let mut copy = restored(&simulator);
    copy.update(DT);
    assert_eq!((copy.counters().pairs_tested, copy.overlaps(sensor).len()), (0, 1000));
}

#[test]
fn bodies_amid_sensors_have_the_same_bits_after_each_restore() {
    let play = |is_restored: bool| {
        let mut simulator = precise(900.0);
        let bodies: Vec<BodyId> = (0..20)
            .map(|i| add_box(&mut simulator, v(13.0 * (i % 5) as f32, -25.0 * (i / 5) as f32), 20.0).0)
            .collect();
        add_static(&mut simulator, v(0.0, 220.0), 400.0);
        let lift = add_kinematic(&mut simulator, v(-60.0, 0.0), 30.0).0;
        simulator[lift].set_linear_velocity(v(20.0, 0.0));
        for sensor in 0..3 {
            add_sensor(&mut simulator, v(20.0 * sensor as f32, 0.0), 60.0);
        }
        let mut places = Vec::new();
        for update in 0..240 {
            if update == 100 {
                simulator[bodies[3]].set_position(v(0.0, -200.0));
            }
            simulator.update(DT);
            if is_restored && update % 7 == 0 {
                simulator = restored(&simulator);
            }
            places.extend(bodies.iter().map(|&body| simulator[body].position()));
        }
        places
    };
    assert!(play(false) == play(true));
}
