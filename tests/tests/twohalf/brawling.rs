//! Elements of a beat-'em-up: actors, blows, hands, blocks.

use conformance::fixtures::depth::{assert_near, assert_near3, fix, velocity};
use twohalf::{DepthScheme, MoveInput, TwoHalfPhysicsSimulator, Vector2, Vector3};
use twohalf_factories::{Actor, Blow, Figure, Hands, Prism, Spawned, in_reach, spawn, spawn_block, strike};

const STEP: f32 = 1.0 / 120.0;
const RIGHT: MoveInput = MoveInput { x: 150.0, z: 0.0, jump: false };

fn simulator() -> TwoHalfPhysicsSimulator {
    TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0)).unwrap()
}

fn actor(simulator: &mut TwoHalfPhysicsSimulator, at: [f32; 3]) -> Actor {
    Actor::spawn(simulator, Figure::new([30.0, 60.0, 20.0]).at(at)).unwrap()
}

fn crate_box(simulator: &mut TwoHalfPhysicsSimulator, at: [f32; 3]) -> Spawned {
    spawn(simulator, Prism::new([30.0; 3]).mass(5.0).upright().at(at)).unwrap()
}

#[test]
fn an_actor_faces_its_input_and_counts_its_steps() {
    let mut simulator = simulator();
    let mut actor = actor(&mut simulator, [0.0, 0.0, 50.0]);
    for _ in 0..120 {
        assert!(actor.act(&mut simulator, MoveInput { x: -80.0, z: 60.0, jump: false }, STEP).unwrap());
        simulator.update(STEP);
    }
    assert!(actor.looks_left && actor.walker.is_grounded());
    // 100 px/s for a second, at 40 px a step.
    assert_near(actor.stride, 2.5, 1e-3);
    actor.act(&mut simulator, MoveInput { x: 0.0, z: 60.0, jump: false }, STEP).unwrap();
    assert!(actor.looks_left);
}

#[test]
fn a_stunned_figure_keeps_its_flight_and_is_braked_on_landing() {
    let mut simulator = simulator();
    let mut actor = actor(&mut simulator, [0.0, 0.0, 50.0]);
    (0..10).for_each(|_| simulator.update(STEP));
    simulator.body_mut(actor.thing.body).unwrap().set_velocity3d(Vector3::new(200.0, 300.0, 0.0));
    actor.stunned = 1.0;
    let mut acted = 0;
    for step in 0..180 {
        acted += u32::from(actor.act(&mut simulator, MoveInput { x: -150.0, ..RIGHT }, STEP).unwrap());
        simulator.update(STEP);
        if step == 60 {
            assert_near(velocity(&simulator, actor.thing.body).x, 200.0, 1.0);
        } else if step == 115 {
            assert_near(velocity(&simulator, actor.thing.body).x, 0.0, 1.0);
        }
    }
    // After a second.
    assert!((59..=61).contains(&acted), "{acted}");
}

#[test]
fn an_actor_does_not_advance_while_its_time_is_stopped() {
    let mut simulator = simulator();
    let mut actor = actor(&mut simulator, [0.0, 0.0, 50.0]);
    simulator.update(STEP);
    simulator.stop_time(actor.thing.body, 20).unwrap();
    (actor.stunned, actor.rests) = (0.5, 0.3);
    let before = actor;
    for _ in 0..20 {
        assert!(!actor.act(&mut simulator, RIGHT, STEP).unwrap());
        simulator.update(STEP);
    }
    assert_eq!(actor, before);
}

#[test]
fn a_blow_reaches_bodies_in_front_of_the_striker_and_no_farther() {
    let mut simulator = simulator();
    let player = actor(&mut simulator, [100.0, 0.0, 50.0]).thing;
    // Its reach is from X = 115 to 145, Y = 18 to 52, Z = 34 to 66.
    let [near, far, behind, deep, low] =
        [[155.0, 0.0, 50.0], [161.0, 0.0, 90.0], [50.0, 0.0, 50.0], [130.0, 0.0, 82.0], [135.0, -13.0, 50.0]]
            .map(|at| crate_box(&mut simulator, at));
    simulator.update(0.0);
    let blow = Blow::default();
    assert_eq!(in_reach(&simulator, player, false, &blow).unwrap(), [near.geom]);
    assert_eq!(in_reach(&simulator, player, true, &blow).unwrap(), [behind.geom]);
    let longer = Blow { reach: 50.0, half_depth: 26.0, heights: [0.0, 52.0], ..blow };
    let reached = in_reach(&simulator, player, false, &longer).unwrap();
    assert_eq!(reached, [near.geom, far.geom, deep.geom, low.geom]);
}

#[test]
fn a_struck_body_gets_the_velocity_after_the_hit_stop_and_a_static_one_gets_none() {
    let mut simulator = simulator();
    let player = actor(&mut simulator, [100.0, 0.0, 50.0]).thing;
    let load = crate_box(&mut simulator, [60.0, 20.0, 60.0]);
    let post = crate_box(&mut simulator, [60.0, 20.0, 25.0]);
    fix(&mut simulator, post.body);
    simulator.update(0.0);
    let blow = Blow { velocity: [90.0, 200.0], stop: 6, half_depth: 20.0, ..Blow::default() };
    let struck = strike(&mut simulator, player, true, &blow, |_| true).unwrap();
    assert_eq!(struck, [load.geom, post.geom]);
    assert_near3(velocity(&simulator, post.body), [0.0; 3], 0.0);
    assert_eq!((simulator.time_scale(player.body), simulator.time_scale(post.body)), (0.0, 1.0));
    let before = load.place(&simulator);
    (0..6).for_each(|_| simulator.update(STEP));
    assert_eq!(load.place(&simulator), before);
    simulator.update(STEP);
    // Gravity has acted for a step.
    assert_near3(velocity(&simulator, load.body), [-90.0, 200.0 - 900.0 * STEP, 0.0], 0.5);
}

#[test]
fn a_blow_without_a_hit_stops_no_body() {
    let mut simulator = simulator();
    let player = actor(&mut simulator, [100.0, 0.0, 50.0]).thing;
    crate_box(&mut simulator, [140.0, 20.0, 50.0]);
    simulator.update(0.0);
    assert!(strike(&mut simulator, player, false, &Blow::default(), |_| false).unwrap().is_empty());
    assert_eq!(simulator.time_scale(player.body), 1.0);
}

#[test]
fn a_held_body_collides_with_walls_and_not_with_its_holder() {
    let mut simulator = simulator();
    let mut player = actor(&mut simulator, [0.0, 0.0, 50.0]);
    let load = crate_box(&mut simulator, [40.0, 0.0, 50.0]);
    // From 64 px on over the ground, so that only the held object meets it.
    spawn_block(&mut simulator, [100.0, 140.0], [64.0, 200.0], [0.0, 100.0]).unwrap();
    let mut hands = Hands::default();
    hands.take(&mut simulator, player.thing, load).unwrap();
    assert_eq!(hands.held(), Some(load));
    for _ in 0..120 {
        player.act(&mut simulator, RIGHT, STEP).unwrap();
        hands.carry(&mut simulator, Vector3::new(0.0, 66.0, 0.0), 480.0, STEP).unwrap();
        simulator.update(STEP);
    }
    assert!(player.place(&simulator).x > 120.0);
    assert_near(load.place(&simulator).x, 85.0, 0.5);
}

#[test]
fn a_thrown_body_collides_with_its_thrower_again_once_they_are_separated() {
    let mut simulator = simulator();
    let player = actor(&mut simulator, [0.0, 0.0, 50.0]);
    let load = crate_box(&mut simulator, [40.0, 0.0, 50.0]);
    let group_of = |simulator: &TwoHalfPhysicsSimulator| simulator.core()[load.geom].collision_group();
    let mut hands = Hands::default();
    hands.take(&mut simulator, player.thing, load).unwrap();
    let carry = |hands: &mut Hands, simulator: &mut TwoHalfPhysicsSimulator| {
        hands.carry(simulator, Vector3::new(0.0, 20.0, 0.0), 960.0, STEP).unwrap();
        simulator.update(STEP);
    };
    (0..30).for_each(|_| carry(&mut hands, &mut simulator));
    // Within its holder.
    assert_near3(load.place(&simulator), [0.0, 20.0, 50.0], 0.1);
    assert_eq!(hands.throw(&mut simulator, Vector3::new(200.0, 0.0, 0.0)).unwrap(), Some(load));
    carry(&mut hands, &mut simulator);
    assert!(hands.held().is_none() && group_of(&simulator) != 0);
    (0..60).for_each(|_| carry(&mut hands, &mut simulator));
    assert_eq!(group_of(&simulator), 0);
    assert!(load.place(&simulator).x > 31.0 && !simulator.body(load.body).unwrap().ignore_gravity());
    simulator.body_mut(load.body).unwrap().set_velocity3d(Vector3::new(-300.0, 0.0, 0.0));
    (0..60).for_each(|_| carry(&mut hands, &mut simulator));
    // Half a crate and the radius of a figure.
    let (load, player) = (load.place(&simulator), player.place(&simulator));
    assert!(load.x > player.x + 15.0 + 12.5 - 0.5, "{load:?} {player:?}");
}

#[test]
fn a_removed_body_is_not_held() {
    let mut simulator = simulator();
    let player = actor(&mut simulator, [0.0, 0.0, 50.0]).thing;
    let load = crate_box(&mut simulator, [40.0, 0.0, 50.0]);
    let mut hands = Hands::default();
    hands.take(&mut simulator, player, load).unwrap();
    simulator.dispose(load.body).unwrap();
    simulator.update(STEP);
    hands.carry(&mut simulator, Vector3::zeros(), 480.0, STEP).unwrap();
    assert_eq!(hands.held(), None);
    assert_eq!(hands.throw(&mut simulator, Vector3::zeros()).unwrap(), None);
    assert!(hands.take(&mut simulator, player, load).is_err());
}

#[test]
fn hands_go_on_after_loading() {
    let mut simulator = simulator();
    let player = actor(&mut simulator, [0.0, 0.0, 50.0]).thing;
    let load = crate_box(&mut simulator, [40.0, 0.0, 50.0]);
    let mut hands = Hands::default();
    hands.take(&mut simulator, player, load).unwrap();
    let mut other = simulator.clone();
    other.restore(&simulator.snapshot()).unwrap();
    let mut loaded: Hands = serde_json::from_str(&serde_json::to_string(&hands).unwrap()).unwrap();
    let play = |simulator: &mut TwoHalfPhysicsSimulator, hands: &mut Hands| {
        for step in 0..60 {
            hands.carry(simulator, Vector3::new(0.0, 66.0, 0.0), 480.0, STEP).unwrap();
            if step == 30 {
                hands.throw(simulator, Vector3::new(300.0, 90.0, 20.0)).unwrap();
            }
            simulator.update(STEP);
        }
        load.place(simulator)
    };
    assert_eq!(play(&mut simulator, &mut hands), play(&mut other, &mut loaded));
}

#[test]
fn invalid_blows_and_grips_are_refused() {
    let mut simulator = simulator();
    let player = actor(&mut simulator, [0.0, 0.0, 50.0]).thing;
    let load = crate_box(&mut simulator, [30.0, 20.0, 50.0]);
    simulator.update(0.0);
    let blow = Blow::default();
    for wrong in [
        Blow { reach: -1.0, ..blow },
        Blow { reach: f32::NAN, ..blow },
        Blow { half_depth: f32::INFINITY, ..blow },
        Blow { heights: [20.0, 10.0], ..blow },
        Blow { velocity: [f32::NAN, 0.0], ..blow },
    ] {
        assert!(strike(&mut simulator, player, false, &wrong, |_| true).is_err(), "{wrong:?}");
    }
    assert_eq!(simulator.time_scale(load.body), 1.0);
    let mut hands = Hands::default();
    hands.take(&mut simulator, player, load).unwrap();
    let held_at = Vector3::new(0.0, 60.0, 0.0);
    for (speed, dt) in [(-1.0, STEP), (f32::NAN, STEP), (480.0, 0.0), (480.0, f32::INFINITY)] {
        assert!(hands.carry(&mut simulator, held_at, speed, dt).is_err());
    }
    assert!(hands.carry(&mut simulator, held_at * f32::NAN, 480.0, STEP).is_err());
    assert!(hands.throw(&mut simulator, held_at * f32::INFINITY).is_err());
    assert_eq!(hands.held(), Some(load));
    for ends in [[0.0, 0.0], [1.0, -1.0], [0.0, f32::NAN], [f32::MIN, f32::MAX]] {
        assert!(spawn_block(&mut simulator, ends, [0.0, 1.0], [0.0, 1.0]).is_err());
        assert!(spawn_block(&mut simulator, [0.0, 1.0], ends, [0.0, 1.0]).is_err());
        assert!(spawn_block(&mut simulator, [0.0, 1.0], [0.0, 1.0], ends).is_err());
    }
    assert_eq!(simulator.platforms().count(), 0);
    simulator.dispose(player.body).unwrap();
    simulator.update(STEP);
    assert!(strike(&mut simulator, player, false, &blow, |_| true).is_err());
    assert_eq!(player.place(&simulator), Vector3::zeros());
}

#[test]
fn without_a_stop_blows_and_hands_do_with_every_scheme() {
    for scheme in [DepthScheme::Faithful, DepthScheme::Precise] {
        let mut simulator = simulator();
        simulator.set_depth_scheme(scheme).unwrap();
        let figure = Prism::new([30.0, 60.0, 20.0]).upright();
        let player = spawn(&mut simulator, figure.at([0.0, 0.0, 50.0])).unwrap();
        let load = crate_box(&mut simulator, [40.0, 0.0, 50.0]);
        simulator.update(STEP);
        let mut hands = Hands::default();
        hands.take(&mut simulator, player, load).unwrap();
        for _ in 0..60 {
            hands.carry(&mut simulator, Vector3::new(10.0, 64.0, 0.0), 480.0, STEP).unwrap();
            simulator.update(STEP);
        }
        assert_near(load.place(&simulator).y, 64.0, 0.5);
        hands.throw(&mut simulator, Vector3::new(0.0, 0.0, 0.0)).unwrap();
        let blow = Blow { heights: [60.0, 90.0], stop: 0, ..Blow::default() };
        let struck = strike(&mut simulator, player, false, &blow, |_| true).unwrap();
        assert_eq!(struck, [load.geom]);
        assert_near(velocity(&simulator, load.body).x, 180.0, 0.0);
    }
}
