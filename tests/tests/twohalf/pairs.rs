//! Objects meet in X and Y only while they overlap in depth.

use conformance::fixtures::depth::{ball, crate_box, place, run, throw, weightless};
use twohalf::farseer_core::{BroadPhaseCollider, PhysicsSimulator};
use twohalf::{
    BodyId, Collision, Context, DepthProfile, Event, EventHandler, GeomId, TwoHalfPhysicsSimulator, Vector3,
};

/// Two balls that fly towards each other along X, the second one at depth `z`.
fn two_balls(mut simulator: TwoHalfPhysicsSimulator, z: f32) -> (TwoHalfPhysicsSimulator, [BodyId; 2]) {
    let a = ball(&mut simulator, 10.0, [0.0, 0.0, 0.0]);
    let b = ball(&mut simulator, 10.0, [100.0, 0.5, z]);
    throw(&mut simulator, a, [50.0, 0.0, 0.0]);
    throw(&mut simulator, b, [-50.0, 0.0, 0.0]);
    (simulator, [a, b])
}

fn velocity_x(simulator: &TwoHalfPhysicsSimulator, body: BodyId) -> f32 {
    simulator.body(body).unwrap().linear_velocity().x
}

fn with_broad_phase(method: BroadPhaseCollider) -> TwoHalfPhysicsSimulator {
    let mut core = PhysicsSimulator::default();
    core.set_broad_phase_collider(method).unwrap();
    TwoHalfPhysicsSimulator::from_core(600, 60, core).unwrap()
}

const BROAD_PHASES: [BroadPhaseCollider; 4] = [
    BroadPhaseCollider::SelectiveSweep,
    BroadPhaseCollider::SweepAndPrune,
    BroadPhaseCollider::BruteForce,
    BroadPhaseCollider::SPATIAL_HASH,
];

#[test]
pub(crate) fn at_the_same_depth_two_balls_collide_with_every_broad_phase() {
    for method in BROAD_PHASES {
        let (mut simulator, [a, b]) = two_balls(with_broad_phase(method), 5.0);
        run(&mut simulator, 300);
        assert!(velocity_x(&simulator, a) < 10.0 && velocity_x(&simulator, b) > -10.0, "{method:?}");
    }
}

#[test]
pub(crate) fn at_different_depths_two_balls_pass_each_other_with_every_broad_phase() {
    for method in BROAD_PHASES {
        let (mut simulator, [a, b]) = two_balls(with_broad_phase(method), 20.0);
        run(&mut simulator, 300);
        assert_eq!((velocity_x(&simulator, a), velocity_x(&simulator, b)), (50.0, -50.0), "{method:?}");
        assert!(place(&simulator, a).x > place(&simulator, b).x);
    }
}

#[test]
pub(crate) fn objects_with_a_deeper_profile_collide_that_would_have_passed() {
    let (mut simulator, [a, _]) = two_balls(weightless(), 20.0);
    let geom = simulator.body(a).unwrap().ground().object_geom().unwrap();
    simulator.set_depth_profile(geom, DepthProfile::Prism { depth: 60.0 }).unwrap();
    run(&mut simulator, 300);
    assert!(velocity_x(&simulator, a) < 10.0);
}

#[test]
pub(crate) fn an_object_from_the_front_pushes_with_every_broad_phase() {
    for method in BROAD_PHASES {
        let mut simulator = with_broad_phase(method);
        let still = crate_box(&mut simulator, [40.0, 40.0], [0.0, 0.0, 100.0]);
        let thrown = crate_box(&mut simulator, [30.0, 30.0], [3.0, 4.0, 0.0]);
        throw(&mut simulator, thrown, [0.0, 0.0, 80.0]);
        run(&mut simulator, 300);
        let velocity = |body| simulator.body(body).unwrap().velocity3d();
        // Equal masses and no restitution: both go on at half the speed.
        for body in [still, thrown] {
            assert!((velocity(body) - Vector3::new(0.0, 0.0, 40.0)).norm() < 0.01, "{method:?}");
        }
        assert_eq!((place(&simulator, thrown).x, place(&simulator, thrown).y), (3.0, 4.0), "{method:?}");
    }
}

#[test]
pub(crate) fn a_touching_pair_that_moves_apart_in_depth_separates() {
    let mut simulator = weightless();
    let a = crate_box(&mut simulator, [40.0, 40.0], [0.0, 0.0, 0.0]);
    let b = crate_box(&mut simulator, [40.0, 40.0], [39.0, 1.0, 0.0]);
    simulator.update(0.01);
    assert_eq!(simulator.counters().pairs_touching, 1);
    let mut view = simulator.body_mut(b).unwrap();
    view.set_position3d(Vector3::new(39.0, 1.0, 50.0));
    simulator.body_mut(a).unwrap().set_position3d(Vector3::new(0.0, 0.0, 0.0));
    simulator.update(0.01);
    assert_eq!(simulator.counters().pairs_touching, 0);
    let told = |event: &Event| matches!(event, Event::Separation { .. });
    assert_eq!(simulator.events().iter().filter(|event| told(event)).count(), 2);
}

/// Counts its calls, and refuses pairs on request.
#[derive(Default)]
struct Listener {
    asked: usize,
    collisions: usize,
    refuses: bool,
}

impl EventHandler for Listener {
    fn handles_broad_phase(&self) -> bool {
        true
    }

    fn on_broad_phase_collision(&mut self, _: &mut Context<'_>, _: GeomId, _: GeomId) -> bool {
        self.asked += 1;
        !self.refuses
    }

    fn on_collision(&mut self, _: &mut Context<'_>, _: &Collision) -> bool {
        self.collisions += 1;
        true
    }
}

#[test]
fn a_handler_is_not_called_for_pairs_at_different_depths() {
    let (mut simulator, _) = two_balls(weightless(), 20.0);
    let mut listener = Listener::default();
    let mut events = 0;
    for _ in 0..200 {
        simulator.update_with(0.01, &mut listener);
        let is_of_pair = |event: &&Event| !matches!(event, Event::BodyUpdated { .. } | Event::Added { .. });
        events += simulator.events().iter().filter(is_of_pair).count();
    }
    assert_eq!((listener.asked, listener.collisions, events), (0, 0, 0));
}

#[test]
pub(crate) fn a_handler_is_called_for_pairs_at_the_same_depth() {
    let (mut simulator, _) = two_balls(weightless(), 5.0);
    let mut listener = Listener::default();
    for _ in 0..200 {
        simulator.update_with(0.01, &mut listener);
    }
    assert!(listener.asked > 0 && listener.collisions > 0);
}

#[test]
pub(crate) fn the_refusals_of_a_handler_count_and_are_reported() {
    let (mut simulator, [a, _]) = two_balls(weightless(), 5.0);
    // A third ball at another depth, so that refusals of both kinds mix.
    ball(&mut simulator, 10.0, [50.0, 1.0, 60.0]);
    let mut listener = Listener { refuses: true, ..Listener::default() };
    let mut vetoes = 0;
    for _ in 0..200 {
        simulator.update_with(0.01, &mut listener);
        let events = simulator.events().iter();
        vetoes += events.filter(|event| matches!(event, Event::BroadPhaseVeto { .. })).count();
    }
    assert_eq!(velocity_x(&simulator, a), 50.0);
    assert!(vetoes > 0);
    assert_eq!(vetoes, listener.asked);
}
