//! Another scheme is chosen while bodies move and rest.

use farseer_core::{GeomPlacement, Methods};
use twohalf::{BodyId, DepthScheme, TwoHalfPhysicsSimulator, Vector2, Vector3};

use conformance::fixtures::depth::{DT, ball, fix, place, platform, run, solid, throw, velocity};

const ALL: [DepthScheme; 3] = [DepthScheme::Faithful, DepthScheme::Precise, DepthScheme::Thesis];

/// All changes from one scheme to another.
fn switches() -> impl Iterator<Item = [DepthScheme; 2]> {
    ALL.into_iter().flat_map(|from| ALL.into_iter().map(move |to| [from, to])).filter(|[from, to]| from != to)
}

fn with(scheme: DepthScheme) -> TwoHalfPhysicsSimulator {
    let mut simulator =
        TwoHalfPhysicsSimulator::with_angle_and_gravity(600, 60, Vector2::new(0.0, 100.0)).unwrap();
    simulator.set_depth_scheme(scheme).unwrap();
    simulator
}

/// Crates on the ground, on each other and on a platform, and a ball on the ground.
fn resting(scheme: DepthScheme) -> (TwoHalfPhysicsSimulator, Vec<BodyId>) {
    let mut simulator = with(scheme);
    platform(&mut simulator, [100.0, 20.0, 60.0], [300.0, 0.0, 0.0]);
    let mut bodies = Vec::new();
    for (x, y) in [(0.0, 0.0), (0.0, 30.0), (0.0, 60.0), (300.0, 20.0), (300.0, 50.0)] {
        bodies.push(solid(&mut simulator, [30.0; 3], [x, y, 0.0]));
    }
    bodies.push(ball(&mut simulator, 10.0, [150.0, 0.0, 0.0]));
    run(&mut simulator, 200);
    (simulator, bodies)
}

fn places(simulator: &TwoHalfPhysicsSimulator, bodies: &[BodyId]) -> Vec<Vector3> {
    bodies.iter().map(|&body| place(simulator, body)).collect()
}

#[test]
fn bodies_at_rest_stay_at_rest_under_every_scheme() {
    for [from, to] in switches() {
        let (mut simulator, bodies) = resting(from);
        let before = places(&simulator, &bodies);
        simulator.set_depth_scheme(to).unwrap();
        assert_eq!(places(&simulator, &bodies), before, "{from:?} to {to:?}");
        run(&mut simulator, 300);
        for (at, (now, then)) in places(&simulator, &bodies).iter().zip(&before).enumerate() {
            // Overlap of one allowed penetration per layer may become none, or the other way round.
            assert!((now - then).norm() < 0.5, "{from:?} to {to:?}, body {at}: {then:?} became {now:?}");
        }
    }
}

#[test]
fn flying_bodies_keep_their_positions_and_velocities() {
    for [from, to] in switches() {
        let fly = |switches: bool| {
            let mut simulator = with(from);
            let body = ball(&mut simulator, 10.0, [0.0, 500.0, 50.0]);
            throw(&mut simulator, body, [30.0, 40.0, -20.0]);
            run(&mut simulator, 50);
            let known = [place(&simulator, body), velocity(&simulator, body)];
            if switches {
                simulator.set_depth_scheme(to).unwrap();
            }
            assert_eq!([place(&simulator, body), velocity(&simulator, body)], known);
            run(&mut simulator, 50);
            place(&simulator, body)
        };
        // Speed is added before or in the middle of a step: up to half a step's fall in each of 50.
        let most = 50.0 * 0.5 * 100.0 * DT * DT;
        let difference = fly(true) - fly(false);
        assert!(difference.norm() < most + 50.0 * 600.0 * f32::EPSILON, "{from:?} to {to:?}: {difference:?}");
    }
}

#[test]
fn a_scheme_chosen_in_mid_run_is_saved_and_goes_on_with_the_same_bits() {
    for [from, to] in switches() {
        let (mut simulator, bodies) = resting(from);
        throw(&mut simulator, bodies[2], [60.0, 20.0, 10.0]);
        run(&mut simulator, 5);
        simulator.set_depth_scheme(to).unwrap();
        let mut other = with(from);
        other.restore(&simulator.snapshot()).unwrap();
        assert_eq!(other.depth_scheme(), to);
        run(&mut simulator, 100);
        run(&mut other, 100);
        assert_eq!(simulator.snapshot(), other.snapshot(), "{from:?} to {to:?}");
    }
}

#[test]
fn setting_the_present_scheme_has_no_effect() {
    for scheme in ALL {
        let (mut simulator, _) = resting(scheme);
        let before = simulator.snapshot();
        simulator.set_depth_scheme(scheme).unwrap();
        assert_eq!(simulator.snapshot(), before, "{scheme:?}");
    }
}

#[test]
fn contacts_are_empty_until_the_next_update_and_then_found_again() {
    for [from, to] in switches() {
        let (mut simulator, bodies) = resting(from);
        let grounded = |simulator: &TwoHalfPhysicsSimulator| {
            bodies.iter().filter(|&&body| simulator.body(body).unwrap().is_grounded()).count()
        };
        simulator.set_depth_scheme(to).unwrap();
        assert_eq!((simulator.contacts().count(), grounded(&simulator)), (0, 0), "{from:?} to {to:?}");
        run(&mut simulator, 2);
        assert_eq!(grounded(&simulator), bodies.len(), "{from:?} to {to:?}");
    }
}

/// Asserts that both other schemes are refused with these words, without an effect on the run.
fn assert_refused(simulator: &mut TwoHalfPhysicsSimulator, words: &str) {
    for scheme in [DepthScheme::Faithful, DepthScheme::Thesis] {
        let before = simulator.snapshot();
        let error = simulator.set_depth_scheme(scheme).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
        assert_eq!(simulator.depth_scheme(), DepthScheme::Precise);
        assert_eq!(simulator.snapshot(), before);
    }
}

#[test]
fn other_schemes_refuse_features_of_the_precise_scheme_without_effect() {
    let (mut simulator, _) = resting(DepthScheme::Precise);
    let lift = platform(&mut simulator, [50.0, 10.0, 50.0], [600.0, 0.0, 0.0]);
    simulator.platform_mut(lift).unwrap().set_velocity(Vector3::new(0.0, 5.0, 0.0)).unwrap();
    assert_refused(&mut simulator, "platforms that move");

    let (mut simulator, bodies) = resting(DepthScheme::Precise);
    let mut body = simulator.body_mut(bodies[0]).unwrap();
    body.set_is_kinematic(true);
    body.move_to3d(Vector3::new(0.0, 0.0, 5.0)).unwrap();
    assert_refused(&mut simulator, "along Z of a kinematic body");

    let (mut simulator, _) = resting(DepthScheme::Precise);
    let post = solid(&mut simulator, [30.0; 3], [900.0, 0.0, 0.0]);
    fix(&mut simulator, post);
    let points = [[-40.0, 0.0], [0.0, 5.0], [40.0, 0.0]].map(Vector2::from);
    let chain: farseer_core::Vertices = points.into_iter().collect();
    let placement = GeomPlacement::default();
    simulator
        .edit_objects(|objects| {
            farseer_core::GeomFactory::create_chain_geom_in(objects, post, &chain, placement)
        })
        .unwrap();
    assert_refused(&mut simulator, "chain");
    assert_eq!(simulator.core().methods(), Methods::PRECISE);
}
