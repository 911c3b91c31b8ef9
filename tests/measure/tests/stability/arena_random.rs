//! Tests random scenes of the arena: how they start, and which flags are raised.

use super::arena::Still;
use measure::arena::random::flags::{FLAGS, Flagged, flags, summary};
use measure::arena::random::play::{Effort, RandomFigures, play};
use measure::arena::random::{RandomScene, random_scene};
use measure::arena::*;
use std::collections::BTreeSet;

#[test]
fn random_scenes_start_without_overlaps_gaps_and_escapes() {
    for seed in 0..60 {
        let random = random_scene(seed);
        let mut play = Play::within(&random.scene, Box::new(Still::default())).expect("it refuses nothing");
        let verdict = judge(&mut play);
        let is_sound = verdict.deepest < 1e-3 && verdict.gap < 1e-3 && verdict.escaped == 0;
        assert!(is_sound, "{seed} {}: {verdict:?}", random.kinds);
        assert!(verdict.bodies >= 20 && verdict.speed <= 100.0, "{seed}: {verdict:?}");
    }
}

#[test]
fn a_seed_alone_determines_a_scene() {
    let [one, again, other] = [5, 5, 6].map(random_scene);
    let parts = |random: &RandomScene| (random.scene.bodies.clone(), random.scene.joints.clone());
    assert_eq!(parts(&one), parts(&again));
    assert_ne!(parts(&one), parts(&other));
}

#[test]
fn random_scenes_have_all_kinds_over_wide_ranges() {
    let mut kinds = BTreeSet::new();
    let (mut masses, mut bodies) = ([f32::MAX, 0.0_f32], [usize::MAX, 0]);
    for seed in 0..200 {
        let random = random_scene(seed);
        kinds.extend(random.kinds.split('+').map(str::to_owned));
        let dynamic = random.scene.bodies.iter().filter(|body| body.kind == Kind::Dynamic);
        for body in dynamic.clone() {
            masses = [masses[0].min(body.mass), masses[1].max(body.mass)];
        }
        let count = dynamic.count();
        bodies = [bodies[0].min(count), bodies[1].max(count)];
    }
    // 15 kinds of items and six other features.
    assert_eq!(kinds.len(), 21, "{kinds:?}");
    assert!(masses[1] / masses[0] > 1e3, "{masses:?}");
    assert!((20..40).contains(&bodies[0]) && (2000..3500).contains(&bodies[1]), "{bodies:?}");
}

/// Returns figures of a run without errors, in which a step takes 100 µs.
fn figures(engine: &'static str) -> RandomFigures {
    RandomFigures {
        seed: 0,
        engine,
        bodies: 20,
        joints: 0,
        first_us: 100.0,
        mean_us: 100.0,
        longest_us: 100.0,
        top_speed: 1.0,
        end_speed: 0.0,
        energy_gain: Some(0.0),
        escaped: 0,
        gap: 0.0,
        deepest: 0.0,
        failure: String::new(),
    }
}

/// Returns the flags of figures that differ from sound ones in our engine, and in both peers.
fn raised(ours: impl Fn(&mut RandomFigures), peers: impl Fn(&mut RandomFigures)) -> String {
    let mut all = [OURS, BOX2D, RAPIER].map(figures);
    ours(&mut all[0]);
    all[1..].iter_mut().for_each(peers);
    flags(&random_scene(1), &all).flags
}

#[test]
fn every_flag_is_raised_by_its_error_and_not_where_peers_have_it_too() {
    type Edit = fn(&mut RandomFigures);
    let errors: [(&str, Edit); 9] = [
        ("slow", |figures| figures.mean_us = 140.0),
        ("stall", |figures| figures.longest_us = 2500.0),
        ("failed", |figures| figures.failure = "panicked".to_owned()),
        ("explodes", |figures| figures.top_speed = 1e4),
        ("energy", |figures| figures.energy_gain = Some(0.1)),
        ("leaks", |figures| figures.escaped = 1),
        ("gap", |figures| figures.gap = 0.1),
        ("overlap", |figures| figures.deepest = 0.1),
        ("restless", |figures| figures.end_speed = 0.2),
    ];
    for (name, error) in errors {
        assert_eq!(raised(error, |_| {}), name);
        assert_eq!(raised(error, error), "", "{name}");
    }
    assert_eq!(raised(|ours| ours.mean_us = 160.0, |_| {}), "slow+dear");
    assert_eq!(raised(|_| {}, |_| {}), "");
}

#[test]
fn the_summary_counts_flags_and_lists_seeds() {
    let scene = |seed, ratio, flags: &str| Flagged {
        seed,
        bodies: 20,
        joints: 0,
        kinds: "loose+chain".to_owned(),
        ratio: Some(ratio),
        longest_ratio: Some(1.0),
        flags: flags.to_owned(),
    };
    let text = summary(&[scene(1, 0.5, ""), scene(2, 3.0, "slow+dear"), scene(3, 0.6, "gap")]);
    assert!(
        text.starts_with(
            "3 scenes: time by the faster peer's 0.60 in the median, 3.00 at most, above 1 in 1"
        )
    );
    assert!(text.contains("slow          1  2\n") && text.contains("gap           1  3\n"), "{text}");
    assert_eq!(text.matches("\nchain").count(), 1);
    assert_eq!(FLAGS.len(), 10);
}

#[test]
fn a_random_scene_is_played_in_every_engine() {
    let random = random_scene(3);
    let played = play(&random, &engines(), Effort { turns: 1, budget: 60.0 });
    for figures in &played {
        assert!(figures.failure.is_empty() && figures.escaped == 0, "{figures:?}");
        assert!(figures.mean_us > 0.0 && figures.top_speed > 0.0, "{figures:?}");
    }
    let result = flags(&random, &played);
    assert_eq!(result.ratio.is_some(), engines().len() > 1);
}
