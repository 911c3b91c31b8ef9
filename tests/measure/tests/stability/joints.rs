//! Tests joint scenes: the bodies and joints of all scenes, and facts about a few.

use measure::joints::assembly::Assembly;
use measure::joints::build::simulator;
use measure::joints::counts::outcome;
use measure::joints::engines::OURS;
use measure::joints::family::family;
use measure::joints::random::{scene, variants};
use measure::joints::run::run;
use measure::joints::table::Figures;

/// Expected scenes, one a line: name, number of bodies, number of joints, number of springs.
const SCENES: &str = include_str!("joint_scenes.txt");

fn figures(name: &str) -> Figures {
    let scene = family().into_iter().find(|scene| scene.name == name);
    let scene = scene.unwrap_or_else(|| panic!("no scene {name}"));
    run(&scene, &[OURS], 1).unwrap_or_else(|reason| panic!("{reason}")).remove(0)
}

fn built(assembly: &Assembly) -> [usize; 3] {
    let (mut simulator, _) = simulator(assembly, 4).unwrap_or_else(|error| panic!("{error}"));
    // An update moves new objects into the simulator's lists.
    simulator.update(1.0 / 60.0);
    [simulator.body_list().len(), simulator.joint_list().len(), simulator.spring_list().len()]
}

#[test]
fn every_scene_is_built_with_all_its_bodies_joints_and_springs() {
    let scenes = family();
    let line = |scene: &measure::joints::family::JointScene| {
        let [bodies, joints, springs] = built(&scene.assembly);
        format!("{}; {bodies} {joints} {springs}", scene.name)
    };
    let found: Vec<String> = scenes.iter().map(line).collect();
    assert_eq!(found, SCENES.lines().collect::<Vec<_>>());
    assert_eq!(scenes.len(), 69);
}

#[test]
fn a_pendulum_keeps_its_length() {
    // The limit is a thousandth of a px; the pendulum is 64 px long.
    let figures = figures("pendulum 1");
    assert!(figures.gap_px < 1e-3, "{figures:?}");
    // The pendulum swings by 1 rad. At the bottom a point of the bob has the speed sqrt(2 g l (1 - cos 1)), and more because
    // the bob rotates.
    let lowest = (2.0 * 320.0 * 64.0 * (1.0 - 1.0_f64.cos())).sqrt();
    assert!((lowest..1.2 * lowest).contains(&figures.speed_px_per_s), "{figures:?}");
    assert!(figures.energy_gained.is_some_and(|gain| gain < 0.01), "{figures:?}");
}

#[test]
fn a_hung_chain_with_a_ball_of_a_thousand_times_a_link_comes_to_rest_and_sleeps() {
    let figures = figures("ball 1000 on chain 20 hung");
    assert!(figures.gap_px < 1e-3 && figures.speed_px_per_s < 1e-3 && figures.is_asleep, "{figures:?}");
}

#[test]
fn a_cantilever_of_welds_does_not_sag() {
    let figures = figures("cantilever 10 welds, tip 10");
    assert!(figures.displacement_px.is_some_and(|sag| sag < 1e-3), "{figures:?}");
}

#[test]
fn energy_gains_are_not_judged_in_scenes_with_a_motor() {
    assert_eq!(figures("cart 20 driven by motors 10 rad/s").energy_gained, None);
}

#[test]
fn random_scenes_follow_from_their_seeds_bit_for_bit() {
    for variant in variants() {
        let bits = |seed| {
            let outcome = outcome(seed, variant, &OURS).unwrap_or_else(|error| panic!("{error}"));
            [outcome.speed, outcome.gain, outcome.gap].map(f64::to_bits)
        };
        assert_eq!(bits(3), bits(3), "{variant:?}");
        assert_ne!(scene(3, variant), scene(4, variant));
    }
}

#[test]
fn random_figures_are_joined_and_keep_the_mass_ratio() {
    for variant in variants() {
        for seed in 0..50 {
            let assembly = scene(seed, variant);
            let dynamic: Vec<_> = assembly.bodies.iter().filter(|body| !body.is_static).collect();
            assert!(assembly.joints.len() >= 2 && dynamic.len() >= 3);
            let bound = variant.mass_ratio.sqrt() * 1.001;
            assert!(
                dynamic.iter().all(|body| (bound.recip()..=bound).contains(&body.mass)),
                "{seed} {variant:?}"
            );
        }
    }
}
