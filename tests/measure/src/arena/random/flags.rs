//! Comparison of our engine with the peers in random scenes, and the summary of many of them.

use super::RandomScene;
use super::play::RandomFigures;
use crate::arena::engine::OURS;
use crate::arena::run::rounded;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Names of all flags.
///
/// - slow: a step takes more than the faster peer's mean time; dear: more than 1.5 times.
/// - stall: the longest step is longer than twice the longest one of both peers, and than `STALL`.
/// - failed: the state is not finite, the engine panics or takes too long.
/// - explodes: a body exceeds the speed limit of the scene.
/// - energy: the scene gains energy.
/// - leaks: bodies are outside of the room at the end.
/// - gap: a joint is open in the last second.
/// - overlap: two shapes overlap in the last second.
/// - restless: the scene moves at the end.
///
/// From `failed` on, a flag is raised only if at least one peer does well. `restless` needs both peers at rest.
pub const FLAGS: [&str; 10] =
    ["slow", "dear", "stall", "failed", "explodes", "energy", "leaks", "gap", "overlap", "restless"];

/// Least CPU time in µs of a step that counts as a stall: an eighth of a frame of 1/60 s. Value chosen.
const STALL: f64 = 2000.0;
/// Greatest gain of energy, as a fraction of the greatest kinetic energy, that is never a flag. Value chosen.
const ENERGY: f64 = 0.02;
/// Greatest joint gap in m, and deepest overlap in m, that are never flags. Values chosen: 4 to 10 times Box2D's slop.
const GAP: f64 = 0.02;
const OVERLAP: f64 = 0.05;
/// Greatest speed in m/s in the last half second of a scene at rest. Value chosen: twice the speed at which Box2D lets bodies
/// sleep.
const REST: f64 = 0.1;
/// An error is a flag only if it is this many times that of the better peer. Value chosen: piles are chaotic.
const MARGIN: f64 = 2.0;

/// Comparison of a random scene in our engine with the peers: one line of the table. Ratios are to the faster peer's mean time,
/// and to the longer one of the peers' longest steps; `None` without peers.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "see above")]
pub struct Flagged {
    pub seed: u64,
    pub bodies: usize,
    pub joints: usize,
    pub kinds: String,
    pub ratio: Option<f64>,
    pub longest_ratio: Option<f64>,
    pub flags: String,
}

/// Compares the figures of a scene in all engines.
pub fn flags(random: &RandomScene, figures: &[RandomFigures]) -> Flagged {
    let (ours, peers): (Vec<_>, Vec<_>) = figures.iter().partition(|figures| figures.engine == OURS);
    let ours = ours[0];
    let well: Vec<&RandomFigures> = peers.into_iter().filter(|peer| peer.failure.is_empty()).collect();
    let faster = well.iter().map(|peer| peer.mean_us).reduce(f64::min);
    let longest = well.iter().map(|peer| peer.longest_us).reduce(f64::max);
    let raised = raised(random, ours, &well, [faster, longest]);
    Flagged {
        seed: random.seed,
        bodies: ours.bodies,
        joints: ours.joints,
        kinds: random.kinds.clone(),
        ratio: faster.map(|faster| rounded(ours.mean_us / faster)),
        longest_ratio: longest.map(|longest| rounded(ours.longest_us / longest)),
        flags: FLAGS
            .into_iter()
            .zip(raised)
            .filter_map(|(name, is)| is.then_some(name))
            .collect::<Vec<_>>()
            .join("+"),
    }
}

/// Returns for each of [`FLAGS`] whether it is raised; `well` are the peers that have not failed, and the times are in µs.
fn raised(
    random: &RandomScene,
    ours: &RandomFigures,
    well: &[&RandomFigures],
    [faster, longest]: [Option<f64>; 2],
) -> [bool; 10] {
    let has_failed = !ours.failure.is_empty();
    let is_worse = |error: fn(&RandomFigures) -> f64, visible: f64| {
        let better = well.iter().map(|peer| error(peer)).reduce(f64::min);
        let bound = better.map_or(visible, |better| visible.max(MARGIN * better));
        !has_failed && error(ours) > bound
    };
    let speed = f64::from(random.scene.limits.speed);
    let rests = |peer: &&RandomFigures| peer.end_speed <= REST;
    [
        faster.is_some_and(|faster| ours.mean_us > faster),
        faster.is_some_and(|faster| ours.mean_us > 1.5 * faster),
        longest.is_some_and(|longest| ours.longest_us > STALL.max(2.0 * longest)),
        has_failed && !well.is_empty(),
        !has_failed && ours.top_speed > speed && well.iter().any(|peer| peer.top_speed <= speed),
        is_worse(|figures| figures.energy_gain.unwrap_or(0.0), ENERGY),
        !has_failed && ours.escaped > 0 && well.iter().any(|peer| peer.escaped < ours.escaped),
        is_worse(|figures| figures.gap, GAP),
        is_worse(|figures| figures.deepest, OVERLAP),
        !has_failed && ours.end_speed > REST && well.len() > 1 && well.iter().all(rests),
    ]
}

/// Returns the summary as text: ratios, the number of scenes with each flag and the worst of them, and flags by kind of item.
pub fn summary(all: &[Flagged]) -> String {
    let mut text = String::new();
    let mut ratios: Vec<f64> = all.iter().filter_map(|scene| scene.ratio).collect();
    ratios.sort_by(f64::total_cmp);
    if let (Some(most), Some(median)) = (ratios.last(), ratios.get(ratios.len() / 2)) {
        let slower = ratios.iter().filter(|&&ratio| ratio > 1.0).count();
        add(
            &mut text,
            format_args!(
                "{} scenes: time by the faster peer's {median:.2} in the median, {most:.2} at most, above 1 in {slower}\n",
                all.len()
            ),
        );
    }
    for flag in FLAGS {
        let with: Vec<&Flagged> = all.iter().filter(|scene| scene.has(flag)).collect();
        let seeds: Vec<String> = with.iter().take(12).map(|scene| scene.seed.to_string()).collect();
        add(&mut text, format_args!("{flag:9} {:5}  {}\n", with.len(), seeds.join(" ")));
    }
    add(&mut text, format_args!("{:14} {:>6} {:>6} {:>7}", "kind", "scenes", "median", "flagged"));
    FLAGS.iter().for_each(|flag| add(&mut text, format_args!(" {flag:>8}")));
    text.push('\n');
    let mut kinds: BTreeMap<&str, Vec<&Flagged>> = BTreeMap::new();
    for scene in all {
        scene.kinds.split('+').for_each(|kind| kinds.entry(kind).or_default().push(scene));
    }
    for (kind, scenes) in kinds {
        let mut ratios: Vec<f64> = scenes.iter().filter_map(|scene| scene.ratio).collect();
        ratios.sort_by(f64::total_cmp);
        let median = ratios.get(ratios.len() / 2).copied().unwrap_or(f64::NAN);
        let flagged = scenes.iter().filter(|scene| !scene.flags.is_empty()).count();
        add(&mut text, format_args!("{kind:14} {:6} {median:6.2} {flagged:7}", scenes.len()));
        for flag in FLAGS {
            let count = scenes.iter().filter(|scene| scene.has(flag)).count();
            add(&mut text, format_args!(" {count:8}"));
        }
        text.push('\n');
    }
    text
}

impl Flagged {
    /// Returns whether a flag is raised.
    pub fn has(&self, flag: &str) -> bool {
        self.flags.split('+').any(|raised| raised == flag)
    }
}

fn add(text: &mut String, what: std::fmt::Arguments<'_>) {
    text.write_fmt(what).expect("a string takes everything");
}
