//! The precise set: events, callbacks and refusals, and the meaning of settings.

use conformance::fixtures::plane::{Refuses, add_box, add_circle, add_floor, simulator, v};
use farseer_core::{
    BodyId, BroadPhaseCollider, CollisionCategory, Contact, Context, Error, Event, EventHandler, GeomId,
    Methods, PhysicsSimulator,
};

const DT: f32 = 1.0 / 60.0;

fn precise() -> PhysicsSimulator {
    let mut simulator = simulator(320.0);
    simulator.set_methods(Methods::PRECISE).unwrap();
    simulator.set_iterations(4);
    simulator
}

/// A box that falls on a floor: simulator, floor, box.
fn falling_box() -> (PhysicsSimulator, GeomId, (BodyId, GeomId)) {
    let mut simulator = precise();
    let (_, floor) = add_floor(&mut simulator, (400.0, 20.0), v(0.0, 10.0));
    let thing = add_box(&mut simulator, (32.0, 32.0), v(0.0, -40.0));
    (simulator, floor, thing)
}

/// Distance of the fall in px in two seconds without the floor: g t^2 / 2 less the loss by drag, k g t^3 / 6.
const FALL: f32 = 0.5 * 320.0 * 4.0 - 0.001 * 320.0 * 8.0 / 6.0;

/// Counts the calls of the handler.
#[derive(Default)]
struct Counter {
    collisions: Vec<(GeomId, GeomId, usize)>,
    separations: Vec<(GeomId, GeomId)>,
    moved: usize,
    refuses: bool,
    drops: bool,
}

impl EventHandler for Counter {
    fn on_collision(
        &mut self,
        _: &mut Context<'_>,
        this: GeomId,
        other: GeomId,
        contacts: &mut Vec<Contact>,
    ) -> bool {
        self.collisions.push((this, other, contacts.len()));
        if self.drops {
            contacts.clear();
        }
        !self.refuses
    }

    fn on_separation(&mut self, _: &mut Context<'_>, this: GeomId, other: GeomId) {
        self.separations.push((this, other));
    }

    fn on_body_updated(&mut self, _: &mut Context<'_>, _: BodyId) {
        self.moved += 1;
    }
}

fn collisions(simulator: &PhysicsSimulator) -> Vec<(GeomId, GeomId)> {
    let of = |event: &Event| match *event {
        Event::Collision { this, other, .. } => Some((this, other)),
        _ => None,
    };
    simulator.events().iter().filter_map(of).collect()
}

#[test]
fn a_collision_is_an_event_for_both_sides_only_when_it_begins() {
    let (mut simulator, floor, (_, geom)) = falling_box();
    let mut told = Vec::new();
    for _ in 0..240 {
        simulator.update(DT);
        told.extend(collisions(&simulator));
    }
    assert_eq!(told, [(floor, geom), (geom, floor)]);
    assert_eq!(simulator.overlaps(geom), [floor]);
}

#[test]
fn a_separation_is_an_event_for_both_sides_when_a_touch_ends() {
    let (mut simulator, floor, (body, geom)) = falling_box();
    (0..120).for_each(|_| simulator.update(DT));
    simulator[body].set_linear_velocity(v(0.0, -300.0));
    let mut told = Vec::new();
    for _ in 0..10 {
        simulator.update(DT);
        told.extend(simulator.events().iter().filter_map(|event| match *event {
            Event::Separation { this, other } => Some((this, other)),
            _ => None,
        }));
    }
    assert_eq!(told, [(floor, geom), (geom, floor)]);
    assert!(simulator.overlaps(geom).is_empty());
}

#[test]
fn a_handler_is_called_in_every_update_of_a_contact() {
    let (mut simulator, floor, (_, geom)) = falling_box();
    (0..120).for_each(|_| simulator.update(DT));
    let mut counter = Counter::default();
    (0..10).for_each(|_| simulator.update_with(DT, &mut counter));
    let once = [(floor, geom, 2), (geom, floor, 2)];
    assert_eq!(counter.collisions, once.repeat(10));
}

#[test]
fn refused_and_removed_contacts_exert_no_impulse() {
    for (refuses, drops) in [(true, false), (false, true)] {
        let (mut simulator, _, (body, _)) = falling_box();
        let mut counter = Counter { refuses, drops, ..Counter::default() };
        (0..120).for_each(|_| simulator.update_with(DT, &mut counter));
        let fallen = simulator[body].position().y + 40.0;
        assert!((fallen - FALL).abs() < 0.01, "{fallen}, refuses {refuses}");
        assert!(!counter.collisions.is_empty());
    }
}

#[test]
fn pairs_that_a_handler_filters_exert_no_impulse() {
    let (mut simulator, _, (body, _)) = falling_box();
    (0..120).for_each(|_| simulator.update_with(DT, &mut Refuses::Pairs));
    let fallen = simulator[body].position().y + 40.0;
    assert!((fallen - FALL).abs() < 0.01, "{fallen}");
}

#[test]
fn a_sensor_reports_passing_bodies_without_an_impulse() {
    let mut simulator = precise();
    let (_, sensor) = add_floor(&mut simulator, (400.0, 20.0), v(0.0, 50.0));
    simulator.set_is_sensor(sensor, true).unwrap();
    let (body, ball) = add_circle(&mut simulator, 10.0, 16, v(0.0, 0.0));
    let (mut begun, mut ended) = (0, 0);
    for _ in 0..120 {
        simulator.update(DT);
        let is = |event: &&Event, begins: bool| match **event {
            Event::Collision { this, other, .. } => begins && this == ball && other == sensor,
            Event::Separation { this, other } => !begins && this == ball && other == sensor,
            _ => false,
        };
        begun += simulator.events().iter().filter(|event| is(event, true)).count();
        ended += simulator.events().iter().filter(|event| is(event, false)).count();
    }
    assert_eq!((begun, ended), (1, 1));
    assert!(simulator[body].position().y > 300.0);
}

#[test]
fn categories_groups_and_ignored_pairs_decide_which_geoms_collide() {
    let apart: [fn(&mut PhysicsSimulator, GeomId, GeomId); 3] = [
        |simulator, a, b| {
            for (geom, own) in [(a, CollisionCategory::CAT1), (b, CollisionCategory::CAT2)] {
                simulator[geom].set_collision_categories(own);
                simulator[geom].set_collides_with(own);
            }
        },
        |simulator, a, b| [a, b].into_iter().for_each(|geom| simulator[geom].set_collision_group(7)),
        |simulator, a, b| simulator.ignore_collision_with(a, b).unwrap(),
    ];
    for (number, keep_apart) in apart.into_iter().enumerate() {
        let (mut simulator, floor, (body, geom)) = falling_box();
        keep_apart(&mut simulator, floor, geom);
        (0..120).for_each(|_| simulator.update(DT));
        assert!(simulator[body].position().y > 300.0, "{number}");
    }
}

#[test]
fn categories_that_change_count_from_the_next_update_on() {
    let (mut simulator, floor, (body, geom)) = falling_box();
    (0..120).for_each(|_| simulator.update(DT));
    [floor, geom].into_iter().for_each(|geom| simulator[geom].set_collision_group(3));
    (0..60).for_each(|_| simulator.update(DT));
    assert!(simulator[body].position().y > 100.0);
    simulator[body].set_position(v(0.0, -60.0));
    simulator[body].set_linear_velocity(v(0.0, 0.0));
    simulator[geom].set_collision_group(0);
    (0..120).for_each(|_| simulator.update(DT));
    // Measured: at most 0.0014 px.
    assert!((simulator[body].position().y + 16.0).abs() < 0.002);
}

#[test]
fn moving_disabling_and_making_static_count_in_the_next_update() {
    let (mut simulator, _, (body, geom)) = falling_box();
    (0..120).for_each(|_| simulator.update(DT));
    simulator[body].set_position(v(50.0, -200.0));
    simulator.update(DT);
    assert!(simulator.overlaps(geom).is_empty());
    simulator[body].set_enabled(false);
    let stopped = simulator[body].position();
    (0..10).for_each(|_| simulator.update(DT));
    assert_eq!(simulator[body].position(), stopped);
    simulator[body].set_enabled(true);
    simulator[body].set_is_static(true);
    (0..10).for_each(|_| simulator.update(DT));
    assert_eq!(simulator[body].position(), stopped);
    simulator[body].set_is_static(false);
    (0..240).for_each(|_| simulator.update(DT));
    // Measured: at most 0.0014 px.
    assert!((simulator[body].position().y + 16.0).abs() < 0.002);
}

#[test]
fn bodies_at_rest_are_not_reported_as_moved() {
    let mut simulator = precise();
    simulator.set_gravity(v(0.0, 0.0)).unwrap();
    let (body, _) = add_box(&mut simulator, (20.0, 20.0), v(0.0, 0.0));
    // The first update reports that it was put there.
    (0..2).for_each(|_| simulator.update(DT));
    assert!(!simulator.events().contains(&Event::BodyUpdated { body }));
    simulator[body].set_linear_velocity(v(1.0, 0.0));
    let mut counter = Counter::default();
    simulator.update_with(DT, &mut counter);
    assert!(simulator.events().contains(&Event::BodyUpdated { body }));
    assert_eq!(counter.moved, 1);
}

#[test]
fn geoms_are_at_the_pose_of_their_body_at_every_query() {
    let (mut simulator, _, (body, geom)) = falling_box();
    for _ in 0..30 {
        simulator.update(DT);
        let (position, view) = (simulator[body].position(), simulator.geom(geom).unwrap());
        assert_eq!(view.position(), position);
        assert!((view.aabb().get_center() - position).norm() < 1e-3);
        assert!(simulator.geom_collides_with_point(geom, position));
    }
}

#[test]
fn features_that_the_precise_set_lacks_are_refused() {
    let (mut simulator, _, (body, _)) = falling_box();
    (0..3).for_each(|_| simulator.update(DT));
    let error = simulator.set_broad_phase_collider(BroadPhaseCollider::BruteForce).unwrap_err();
    assert!(matches!(error, Error::NotSupported { methods: "precise", .. }), "{error}");
    let before = simulator[body].position();
    simulator.update(-DT);
    assert_eq!(simulator.events(), [Event::RejectedInput { object: None, argument: "dt" }]);
    simulator.integrate(DT, None);
    assert_eq!(simulator.events().last(), Some(&Event::RejectedInput { object: None, argument: "stage" }));
    assert_eq!(simulator[body].position(), before);
}

#[test]
fn infinite_velocities_disable_their_body_alone() {
    let (mut simulator, _, (other, _)) = falling_box();
    let (body, _) = add_box(&mut simulator, (32.0, 32.0), v(200.0, -40.0));
    simulator.update(DT);
    simulator[body].apply_force(v(f32::MAX, 0.0));
    simulator[body].set_mass(1e-10).unwrap();
    simulator.update(DT);
    assert!(simulator.events().contains(&Event::NotFinite { body, disabled: true }));
    assert!(!simulator[body].enabled() && simulator[other].enabled());
    (0..240).for_each(|_| simulator.update(DT));
    // Measured: 0.0005 px.
    assert!((simulator[other].position().y + 16.0).abs() < 0.002);
}

#[test]
fn damaged_saves_are_refused_or_go_on() {
    let (mut simulator, _, _) = falling_box();
    for number in 0..12 {
        add_circle(&mut simulator, 8.0, 16, v(number as f32 * 3.0 - 18.0, -100.0 - 20.0 * number as f32));
    }
    (0..200).for_each(|_| simulator.update(DT));
    let text = serde_json::to_string(&simulator).unwrap();
    let start = text.find("\"precise\"").unwrap();
    let digits: Vec<usize> = (start..text.len()).filter(|&at| text.as_bytes()[at].is_ascii_digit()).collect();
    let (mut refused, mut went_on) = (0, 0);
    for (round, &at) in digits.iter().step_by(digits.len() / 400).enumerate() {
        let mut damaged = text.clone().into_bytes();
        damaged[at] = b'0' + (round % 10) as u8;
        match serde_json::from_slice::<PhysicsSimulator>(&damaged) {
            Err(_) => refused += 1,
            Ok(mut read) => {
                (0..5).for_each(|_| read.update(DT));
                went_on += 1;
            }
        }
    }
    assert!(refused > 0 && went_on > 100, "{refused} refused, {went_on} went on");
}
