//! Tests the advice on a scene: the recommended methods, the failures, and the rejected inputs.

use conformance::fixtures::plane::{add_box, add_floor, simulator, v};
use conformance::scene::{Op, Scene, ScriptEntry, Target};
use farseer_core::{JointFactory, JointMotor, Methods, PhysicsSimulator, SolverChoice};
use measure::advise::{Advice, Asked, Verdict, advise, advise_on, asked_of};
use measure::sweep::Outcome;

const GRAVITY: f32 = 320.0;

type Built = farseer_core::Result<PhysicsSimulator>;

fn with(methods: Methods) -> PhysicsSimulator {
    let mut simulator = simulator(GRAVITY);
    simulator.set_methods(methods).unwrap();
    simulator
}

/// Returns a simulator with a column of `count` boxes of 32 px on a floor whose surface is at y = 0.
fn column(methods: Methods, count: usize) -> PhysicsSimulator {
    let mut simulator = with(methods);
    add_floor(&mut simulator, (2000.0, 20.0), v(0.0, 10.0));
    for row in 0..count {
        add_box(&mut simulator, (32.0, 32.0), v(0.0, -16.0 - 32.0 * row as f32));
    }
    simulator
}

fn asked(seconds: f64) -> Asked {
    Asked { seconds, ..Asked::default() }
}

fn is_faithful(verdict: &Verdict) -> bool {
    verdict.choice.islands.is_none()
}

/// Returns the verdict on the precise set at its default setting.
fn precise(advice: &Advice) -> &Verdict {
    let is_default = |verdict: &&Verdict| {
        verdict.choice.islands == Some(SolverChoice::Auto) && verdict.setting.passes == 4
    };
    advice.verdicts.iter().find(is_default).unwrap()
}

#[test]
fn for_a_column_of_twenty_the_precise_set_is_recommended_and_the_fall_of_the_faithful_set_named() {
    let advice = advise(&asked(8.0), |methods| Built::Ok(column(methods, 20))).unwrap();
    assert_eq!((advice.movable, advice.resting), (20, 20));
    let best = advice.recommended().unwrap();
    assert!(!is_faithful(best), "{best:?}");
    let game = advice.verdicts.iter().find(|verdict| is_faithful(verdict)).unwrap();
    assert_eq!(game.outcome, Outcome::Failed("falls"));
    assert!(game.findings.fallen >= 10, "{:?}", game.findings);
    let fall = format!("falls: {} of 20 leave their place", game.findings.fallen);
    assert!(advice.table().contains(&fall), "{}", advice.table());
    assert!(advice.sentence().starts_with("Take Precise"), "{}", advice.sentence());
    // The guide promises an overlap below a thousandth of a px for the direct solver.
    assert!(precise(&advice).findings.overlap < 1e-3);
}

#[test]
fn a_scene_that_the_faithful_set_refuses_is_judged_without_it() {
    let advice = advise(&asked(1.0), |methods| {
        let mut simulator = with(methods);
        let (wheel, _) = add_box(&mut simulator, (32.0, 32.0), v(0.0, 0.0));
        let hub = JointFactory::create_fixed_revolute_joint_in(&mut simulator, wheel, v(0.0, 0.0))?;
        simulator.set_joint_motor(hub, Some(JointMotor { speed: 1.0, greatest_effort: 1e6 }))?;
        Built::Ok(simulator)
    })
    .unwrap();
    assert!(!advice.verdicts.iter().any(is_faithful));
    let refusals = advice.absent.iter().filter(|(choice, _)| choice.islands.is_none());
    assert_eq!(refusals.clone().count(), 3);
    refusals.for_each(|(_, reason)| assert!(reason.contains("motors"), "{reason}"));
    assert!(advice.recommended().is_some());
}

#[test]
fn a_game_of_the_precise_set_is_also_run_with_distance_grids() {
    let game = column(Methods::PRECISE, 2);
    let advice = advise(&asked(1.0), |_| Built::Ok(game.clone())).unwrap();
    let faithful = advice.verdicts.iter().find(|verdict| is_faithful(verdict)).unwrap();
    assert_eq!((faithful.outcome, faithful.findings.fallen), (Outcome::Fine, 0));
}

#[test]
fn the_iterative_solver_is_no_extra_choice_without_directly_solved_islands() {
    let flight = advise(&asked(1.0), |methods| {
        let mut simulator = with(methods);
        add_box(&mut simulator, (32.0, 32.0), v(0.0, 0.0));
        Built::Ok(simulator)
    })
    .unwrap();
    assert!(flight.absent.iter().any(|(choice, _)| choice.islands == Some(SolverChoice::Iterative)));
    let column = advise(&asked(1.0), |methods| Built::Ok(column(methods, 8))).unwrap();
    assert_eq!(column.absent, []);
}

#[test]
fn in_a_heap_only_predictable_positions_are_judged() {
    let scene = conformance::scenes::circles_in_a_pit(40);
    let advice = advise_on(&scene, &asked_of(&scene)).unwrap();
    // After some hits the paths of the runs diverge. A body at another position does not count as fallen from then on.
    assert!(advice.predictable < 2.0, "{}", advice.predictable);
    assert!(advice.resting < advice.movable, "{}", advice.resting);
    assert_eq!(precise(&advice).outcome, Outcome::Fine, "{}", advice.table());
}

#[test]
fn an_unusable_setting_is_refused_by_its_name() {
    let wrong = [
        (Asked { seconds: f64::NAN, ..asked(1.0) }, "seconds"),
        (Asked { dt: 0.0, ..asked(1.0) }, "dt"),
        (Asked { length_unit: -32.0, ..asked(1.0) }, "length_unit"),
        (Asked { tolerance: f64::INFINITY, ..asked(1.0) }, "tolerance"),
        (Asked { dt: 0.5, ..asked(1.0) }, "steps"),
    ];
    for (asked, name) in wrong {
        let error = advise(&asked, |methods| Built::Ok(column(methods, 1))).unwrap_err();
        assert!(error.contains(name), "{error}");
    }
}

#[test]
fn a_scene_that_is_garbage_or_has_a_script_is_refused() {
    assert!(Scene::from_json("garbage", "{\"format\": 1, \"bodies\": [{]}").is_err());
    let mut scene = conformance::scenes::pyramid(2);
    let op = Op::Disable { target: Target::Body, index: 1 };
    scene.script.push(ScriptEntry { step: 1, until: None, every: 1, op });
    let error = advise_on(&scene, &asked_of(&scene)).unwrap_err();
    assert!(error.contains("script"), "{error}");
    let mut scene = conformance::scenes::pyramid(2);
    scene.bodies[1].position = Some(v(f32::NAN, 0.0));
    assert!(advise_on(&scene, &asked_of(&scene)).is_err());
}

#[test]
fn a_scene_that_diverges_with_every_method_is_refused() {
    let error = advise(&asked(1.0), |methods| {
        let mut simulator = with(methods);
        let (body, _) = add_box(&mut simulator, (32.0, 32.0), v(0.0, 0.0));
        simulator[body].set_linear_velocity(v(1e9, 0.0));
        Built::Ok(simulator)
    })
    .unwrap_err();
    assert!(error.contains("is lost"), "{error}");
}
