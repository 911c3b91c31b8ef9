//! Typed events of the precise set: each once for a pair, however it begins and ends, and the same after a restore.

use std::collections::BTreeSet;

use farseer_core::math::Vector2;
use farseer_core::{
    BodyBuilder, BodyId, CollisionCategory, Event, GeomBuilder, GeomId, PhysicsSimulator, WantedEvents,
};

const DT: f32 = 1.0 / 60.0;

fn precise(gravity: f32) -> PhysicsSimulator {
    PhysicsSimulator::precise([0.0, gravity]).unwrap()
}

fn add_floor(simulator: &mut PhysicsSimulator) -> GeomId {
    let floor = BodyBuilder::fixed().position([0.0, 10.0]);
    simulator.add_body(floor, [GeomBuilder::rectangle(1000.0, 20.0)]).unwrap().1[0]
}

fn add(simulator: &mut PhysicsSimulator, at: [f32; 2], geom: GeomBuilder) -> (BodyId, GeomId) {
    let (body, [geom]) = simulator.add_body(BodyBuilder::dynamic().position(at), [geom]).unwrap();
    (body, geom)
}

fn square() -> GeomBuilder {
    GeomBuilder::rectangle(32.0, 32.0)
}

fn is_typed(event: &Event) -> bool {
    use Event::{BodySlept, BodyWoke, SensorBegin, SensorEnd, TouchBegin, TouchEnd};
    matches!(
        event,
        TouchBegin { .. }
            | TouchEnd { .. }
            | SensorBegin { .. }
            | SensorEnd { .. }
            | BodySlept { .. }
            | BodyWoke { .. }
    )
}

/// The typed events of a number of updates.
fn events_of(simulator: &mut PhysicsSimulator, updates: usize) -> Vec<Event> {
    let mut events = Vec::new();
    for _ in 0..updates {
        simulator.update(DT);
        events.extend(simulator.events().iter().copied().filter(is_typed));
    }
    events
}

fn touch_begin(geom1: GeomId, geom2: GeomId) -> Event {
    Event::TouchBegin { geom1, geom2 }
}

fn touch_end(geom1: GeomId, geom2: GeomId) -> Event {
    Event::TouchEnd { geom1, geom2 }
}

#[test]
fn a_box_touches_once_sleeps_once_wakes_once_and_parts_once() {
    let mut simulator = precise(300.0);
    let floor = add_floor(&mut simulator);
    let (body, geom) = add(&mut simulator, [0.0, -60.0], square());
    let begun = events_of(&mut simulator, 150);
    assert_eq!(begun, [touch_begin(floor, geom), Event::BodySlept { body }]);
    assert_eq!(events_of(&mut simulator, 100), []);
    simulator[body].apply_impulse(Vector2::new(0.0, -200.0));
    assert_eq!(events_of(&mut simulator, 10), [Event::BodyWoke { body }, touch_end(floor, geom)]);
}

#[test]
fn a_sleeper_whose_events_are_switched_on_reports_that_it_wakes_in_a_restored_game_too() {
    let mut simulator = precise(300.0);
    add_floor(&mut simulator);
    let silent = BodyBuilder::dynamic().position([0.0, -20.0]).sleep_events(false);
    let body = simulator.add_body(silent, [square()]).unwrap().0;
    assert!(!events_of(&mut simulator, 150).contains(&Event::BodySlept { body }));
    assert!(simulator.is_asleep(body));
    simulator[body].set_sleep_events(true);
    let mut restored = precise(0.0);
    restored.restore(&simulator.snapshot()).unwrap();
    for simulator in [&mut simulator, &mut restored] {
        simulator.wake(body);
        assert_eq!(events_of(simulator, 2), [Event::BodyWoke { body }]);
    }
}

#[test]
fn a_touch_ends_however_it_ends() {
    type End = fn(&mut PhysicsSimulator, BodyId, GeomId);
    let ends: [End; 6] = [
        |simulator, body, _| simulator.dispose(body).unwrap(),
        |simulator, _, geom| simulator.dispose(geom).unwrap(),
        |simulator, _, geom| simulator.remove(geom).unwrap(),
        |simulator, body, _| simulator[body].set_enabled(false),
        |simulator, _, geom| simulator[geom].set_collides_with(CollisionCategory::NONE),
        |simulator, body, _| simulator[body].set_position(Vector2::new(0.0, -500.0)),
    ];
    for (kind, end) in ends.into_iter().enumerate() {
        for updates in [30, 150] {
            let mut simulator = precise(300.0);
            let floor = add_floor(&mut simulator);
            let (body, geom) = add(&mut simulator, [0.0, -17.0], square());
            let before = events_of(&mut simulator, updates);
            assert_eq!(before[0], touch_begin(floor, geom));
            end(&mut simulator, body, geom);
            let mut loaded = PhysicsSimulator::default();
            loaded.restore(&simulator.snapshot()).unwrap();
            let after = events_of(&mut simulator, 1);
            assert_eq!(
                after.iter().filter(|&&event| event == touch_end(floor, geom)).count(),
                1,
                "{kind}: {after:?}"
            );
            assert_eq!(events_of(&mut loaded, 1), after, "{kind}, {updates}: after a restore");
        }
    }
}

#[test]
fn an_edit_of_the_kind_ends_one_event_and_begins_another() {
    let mut simulator = precise(0.0);
    let (_, one) = add(&mut simulator, [0.0, 0.0], square());
    let (_, other) = add(&mut simulator, [31.99, 0.0], square());
    assert_eq!(events_of(&mut simulator, 1), [touch_begin(one, other)]);
    simulator.set_sensor(other, true).unwrap();
    let visit = [touch_end(one, other), Event::SensorBegin { sensor: other, visitor: one }];
    assert_eq!(events_of(&mut simulator, 3), visit);
    // Neither side wants to know.
    for geom in [one, other] {
        simulator[geom].set_wanted_events(WantedEvents::NONE);
    }
    assert_eq!(events_of(&mut simulator, 3), [Event::SensorEnd { sensor: other, visitor: one }]);
    // One side is enough.
    simulator[one].set_wanted_events(WantedEvents::SENSOR);
    assert_eq!(events_of(&mut simulator, 3), [Event::SensorBegin { sensor: other, visitor: one }]);
    simulator.dispose(other).unwrap();
    assert_eq!(events_of(&mut simulator, 3), [Event::SensorEnd { sensor: other, visitor: one }]);
}

#[test]
fn an_update_of_no_time_between_an_edit_and_a_snapshot_loses_no_typed_event() {
    let edits: [fn(&mut PhysicsSimulator, BodyId, GeomId); 5] = [
        |simulator, _, geom| simulator.set_sensor(geom, true).unwrap(),
        |simulator, _, geom| simulator[geom].set_wanted_events(WantedEvents::NONE),
        |simulator, body, _| simulator[body].set_is_static(true),
        |simulator, body, _| simulator.wake(body),
        |simulator, body, _| simulator[body].set_position(Vector2::new(0.0, -500.0)),
    ];
    for (kind, edit) in edits.into_iter().enumerate() {
        for updates in [30, 150] {
            let mut simulator = precise(300.0);
            let floor = add_floor(&mut simulator);
            simulator[floor].set_wanted_events(WantedEvents::NONE);
            let (body, geom) = add(&mut simulator, [0.0, -17.0], square());
            events_of(&mut simulator, updates);
            edit(&mut simulator, body, geom);
            simulator.update(0.0);
            let mut loaded = PhysicsSimulator::default();
            loaded.restore(&simulator.snapshot()).unwrap();
            let after = events_of(&mut simulator, 1);
            // Only a body that is awake already cannot wake.
            assert!(!after.is_empty() || (kind, updates) == (3, 30), "{kind}, {updates}: {after:?}");
            assert_eq!(events_of(&mut loaded, 1), after, "{kind}, {updates}");
        }
    }
}

#[test]
fn sensors_on_moving_bodies_find_bodies_of_every_kind() {
    let mut simulator = precise(0.0);
    let carrier =
        BodyBuilder::dynamic().position([-100.0, 0.0]).linear_velocity([120.0, 0.0]).linear_damping(0.0);
    let nose = GeomBuilder::rectangle(10.0, 20.0).sensor(true).offset([30.0, 0.0]);
    let (_, [_, nose]) = simulator.add_body(carrier, [GeomBuilder::circle(4.0), nose]).unwrap();
    let (_, [wall]) = simulator.add_body(BodyBuilder::fixed().position([0.0, 30.0]), [square()]).unwrap();
    let (_, [lift]) =
        simulator.add_body(BodyBuilder::kinematic().position([60.0, 30.0]), [square()]).unwrap();
    let (_, ball) = add(&mut simulator, [120.0, 30.0], square());
    for geom in [wall, lift, ball] {
        let body = simulator.body_of(geom).unwrap();
        let x = simulator[body].position().x;
        simulator[body].set_position(Vector2::new(x, 24.0));
    }
    let events = events_of(&mut simulator, 180);
    let expected: Vec<Event> = [wall, lift, ball]
        .into_iter()
        .flat_map(|visitor| {
            [Event::SensorBegin { sensor: nose, visitor }, Event::SensorEnd { sensor: nose, visitor }]
        })
        .collect();
    let sensed: Vec<Event> = events
        .into_iter()
        .filter(|event| !matches!(event, Event::BodySlept { .. } | Event::BodyWoke { .. }))
        .collect();
    assert_eq!(sensed, expected);
}

#[test]
fn a_sensor_that_a_fast_body_crosses_within_an_update_has_both_events() {
    let mut simulator = precise(0.0);
    let beam = GeomBuilder::rectangle(2.0, 200.0).sensor(true);
    let (_, [beam]) = simulator.add_body(BodyBuilder::fixed(), [beam]).unwrap();
    let bullet = BodyBuilder::dynamic().position([-200.0, 0.0]).linear_velocity([20_000.0, 0.0]);
    let (_, [bullet]) = simulator.add_body(bullet, [GeomBuilder::circle(2.0)]).unwrap();
    let (sensor, visitor) = (beam, bullet);
    let crossed = [Event::SensorBegin { sensor, visitor }, Event::SensorEnd { sensor, visitor }];
    assert_eq!(events_of(&mut simulator, 3), crossed);
}

/// Bodies of all kinds in a box, with edits; every update's typed events.
struct Game {
    simulator: PhysicsSimulator,
    bodies: Vec<(BodyId, GeomId)>,
    number: u32,
}

impl Game {
    fn new() -> Self {
        let mut simulator = precise(300.0);
        for (at, size) in
            [([0.0, 210.0], [440.0, 20.0]), ([-210.0, 0.0], [20.0, 440.0]), ([210.0, 0.0], [20.0, 440.0])]
        {
            simulator
                .add_body(BodyBuilder::fixed().position(at), [GeomBuilder::rectangle(size[0], size[1])])
                .unwrap();
        }
        let zone = GeomBuilder::rectangle(200.0, 60.0).sensor(true);
        simulator.add_body(BodyBuilder::fixed().position([0.0, 150.0]), [zone]).unwrap();
        let mut game = Game { simulator, bodies: Vec::new(), number: 1 };
        (0..30).for_each(|_| game.add());
        game
    }

    /// A number from 0 to `below` - 1.
    fn random(&mut self, below: u32) -> u32 {
        self.number = self.number.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.number >> 16) % below
    }

    fn add(&mut self) {
        let at = [self.random(360) as f32 - 180.0, self.random(300) as f32 - 200.0];
        let geom = match self.random(3) {
            0 => GeomBuilder::circle(8.0 + self.random(8) as f32),
            1 => GeomBuilder::rectangle(16.0, 24.0),
            // A concave outline has several convex pieces.
            _ => GeomBuilder::polygon([
                [-14.0, -10.0],
                [14.0, -10.0],
                [14.0, 12.0],
                [6.0, 0.0],
                [-6.0, 0.0],
                [-14.0, 12.0],
            ]),
        };
        let geom = geom.events(WantedEvents::ALL).restitution(0.2);
        self.bodies.push(add(&mut self.simulator, at, geom));
    }

    fn edit(&mut self) {
        let at = self.random(self.bodies.len() as u32) as usize;
        let (body, geom) = self.bodies[at];
        let is_on = self.random(2) == 0;
        let kind = self.random(9);
        match kind {
            0 => {
                self.simulator.dispose(body).unwrap();
                self.bodies.swap_remove(at);
                self.add();
            }
            1 => self.simulator[body].set_enabled(is_on),
            2 => self.simulator.set_sensor(geom, is_on).unwrap(),
            3 => self.simulator[geom].set_wanted_events(if is_on {
                WantedEvents::ALL
            } else {
                WantedEvents::NONE
            }),
            4 => self.simulator[geom].set_collides_with(if is_on {
                CollisionCategory::ALL
            } else {
                CollisionCategory::CAT1
            }),
            5 => self.simulator[body].set_is_static(is_on),
            6 => self.simulator.sleep(body),
            7 => self.simulator.wake(body),
            _ => self.simulator[body].apply_impulse(Vector2::new(0.0, -300.0)),
        }
    }
}

/// Touches, visits and sleepers that have begun, by their events. Panics at a second begin, or an end without one.
#[derive(Default)]
struct Ledger {
    open: BTreeSet<(u8, u64, u64)>,
}

impl Ledger {
    fn follow(&mut self, event: &Event) {
        let key = |kind: u8, a: GeomId, b: GeomId| (kind, a.to_bits(), b.to_bits());
        let (key, begins) = match *event {
            Event::TouchBegin { geom1, geom2 } => (key(0, geom1, geom2), true),
            Event::TouchEnd { geom1, geom2 } => (key(0, geom1, geom2), false),
            Event::SensorBegin { sensor, visitor } => (key(1, sensor, visitor), true),
            Event::SensorEnd { sensor, visitor } => (key(1, sensor, visitor), false),
            Event::BodySlept { body } => ((2, body.to_bits(), 0), true),
            Event::BodyWoke { body } => ((2, body.to_bits(), 0), false),
            _ => return,
        };
        let is_right = if begins { self.open.insert(key) } else { self.open.remove(&key) };
        assert!(is_right, "{event:?}");
    }
}

#[test]
fn begins_and_ends_alternate_under_edits_and_agree_with_the_state() {
    let mut game = Game::new();
    let mut ledger = Ledger::default();
    for update in 0..1500 {
        if update % 3 == 0 && update % 600 < 300 {
            game.edit();
        }
        game.simulator.update(DT);
        let simulator = &game.simulator;
        simulator.events().iter().for_each(|event| ledger.follow(event));
        let asleep = game.bodies.iter().filter(|&&(body, _)| simulator.is_asleep(body));
        let reported = |body: BodyId| ledger.open.contains(&(2, body.to_bits(), 0));
        assert!(asleep.clone().all(|&(body, _)| reported(body)), "update {update}");
    }
    let (touches, visits) = (
        ledger.open.iter().filter(|&&(kind, ..)| kind == 0).count(),
        ledger.open.iter().filter(|&&(kind, ..)| kind == 1).count(),
    );
    // The game has some of both; how many depends on its bits.
    assert!(touches > 5 && visits > 3, "{touches} {visits}");
}

#[test]
fn a_restored_game_has_the_same_typed_events() {
    let mut game = Game::new();
    for round in 0..40 {
        for _ in 0..20 {
            game.simulator.update(DT);
        }
        game.edit();
        game.edit();
        let mut loaded = PhysicsSimulator::default();
        loaded.restore(&game.simulator.snapshot()).unwrap();
        let mut going_on = game.simulator.clone();
        for update in 0..60 {
            let [one, other] = [&mut going_on, &mut loaded].map(|simulator| {
                simulator.update(DT);
                (simulator.events().to_vec(), simulator.hits().to_vec())
            });
            assert_eq!(one, other, "round {round}, update {update}");
        }
    }
}

#[test]
fn a_hit_has_speed_point_and_normal_and_comes_once_for_each_slap() {
    let mut simulator = precise(300.0);
    let floor = add_floor(&mut simulator);
    // A plank falls on one end, and then tips over: two hits.
    let plank = GeomBuilder::rectangle(120.0, 8.0).events(WantedEvents::HIT);
    let body = BodyBuilder::dynamic().position([0.0, -140.0]).rotation(0.4);
    let (_, [geom]) = simulator.add_body(body, [plank]).unwrap();
    let mut hits = Vec::new();
    for _ in 0..180 {
        simulator.update(DT);
        hits.extend_from_slice(simulator.hits());
    }
    assert!((2..=4).contains(&hits.len()), "{hits:?}");
    let first = hits[0];
    assert_eq!((first.geom1, first.geom2), (floor, geom));
    assert!((first.normal - Vector2::new(0.0, -1.0)).norm() < 0.01);
    assert!(first.point.y.abs() < 3.0 && first.point.x > 50.0, "the lower end: {first:?}");
    // It fell by about 112 px.
    assert!((first.speed - 260.0).abs() < 15.0, "{first:?}");
    assert!(hits[1].point.x < -50.0, "then the other end: {hits:?}");
}

#[test]
fn hits_of_fast_bodies_have_their_speed_and_slow_ones_are_none() {
    for speed in [20.0, 100.0, 1000.0, 10_000.0_f32] {
        let mut simulator = precise(0.0);
        simulator.add_body(BodyBuilder::fixed(), [square()]).unwrap();
        let ball = BodyBuilder::dynamic().position([-200.0, 0.0]).linear_velocity([speed, 0.0]);
        let ball = simulator
            .add_body(ball, [GeomBuilder::circle(5.0).events(WantedEvents::HIT).restitution(0.5)])
            .unwrap();
        let mut speeds = Vec::new();
        for _ in 0..1200 {
            simulator.update(DT);
            speeds.extend(simulator.hits().iter().map(|hit| hit.speed));
        }
        let expected = if speed > simulator.hit_speed() { vec![speed] } else { Vec::new() };
        let is_right =
            speeds.iter().zip(&expected).all(|(found, expected)| (found - expected).abs() < 0.02 * expected);
        assert!(is_right && speeds.len() == expected.len(), "{speed}: {speeds:?}");
        assert!(simulator[ball.0].linear_velocity().x < 0.0 || speed < 30.0, "it bounced");
    }
}

#[test]
fn a_hit_needs_one_side_that_wants_it_and_a_speed_above_the_threshold() {
    let mut simulator = precise(300.0);
    let floor = add_floor(&mut simulator);
    simulator[floor].set_wanted_events(WantedEvents::HIT);
    add(&mut simulator, [0.0, -60.0], square());
    let mut counts = [0, 0];
    for (count, threshold) in counts.iter_mut().zip([50.0, 1000.0]) {
        let mut simulator = simulator.clone();
        simulator.set_hit_speed(threshold).unwrap();
        for _ in 0..120 {
            simulator.update(DT);
            *count += simulator.hits().len();
        }
    }
    assert_eq!(counts, [1, 0]);
    assert!(simulator.set_hit_speed(-1.0).is_err() && simulator.set_hit_speed(f32::NAN).is_err());
}
