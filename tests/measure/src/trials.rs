//! Creates the trials of chart scenes: one for each scene, size, method and setting.

use super::charts::ChartScene;
use super::method::{Effort, Family, Method, Setting};
use super::sweep::{Run, Start, Trial};
use super::watch::Watch;
use std::rc::Rc;

/// Number of bodies from which on a scene is run with fewer settings.
const MANY: usize = 100;
/// Number of bodies from which on a scene is run with few settings, and not at all in a quick sweep.
const VERY_MANY: usize = 1000;

/// Returns the trials of `scenes` with `methods`, ordered by scene and size. Neighbouring scenes that differ in the measure
/// of error alone share runs. Among these, scenes that other engines do not run must come last.
pub fn trials<S: PartialEq + 'static>(
    scenes: &[ChartScene<S>],
    methods: &[Method<S>],
    effort: Effort,
) -> Vec<Trial<'static>> {
    let mut trials = Vec::new();
    for scenes in scenes.chunk_by(have_the_same_runs) {
        let scene = scenes[0];
        for &size in scene.sizes.iter().filter(|&&size| effort == Effort::Full || size < VERY_MANY) {
            let built = Rc::new((scene.build)(size));
            for method in methods {
                let scenes = scenes.iter().filter(|scene| matters(method, scene));
                let watches: Rc<[Measure<S>]> = scenes.map(|scene| (scene.name, scene.watch)).collect();
                let Some(&(name, _)) = watches.first() else { continue };
                trials.extend(settings(method, size, effort).into_iter().map(|setting| Trial {
                    scene: name,
                    size,
                    method: method.name,
                    setting,
                    seconds: scene.seconds,
                    start: start(&built, &watches, method, setting),
                }));
            }
        }
    }
    trials
}

/// Name of a scene, and the function that creates its watch.
type Measure<S> = (&'static str, fn(&S) -> Box<dyn Watch>);

fn start<S: 'static>(
    scene: &Rc<S>,
    watches: &Rc<[Measure<S>]>,
    method: &Method<S>,
    setting: Setting,
) -> Start<'static> {
    let (scene, watches, build) = (Rc::clone(scene), Rc::clone(watches), method.build);
    Box::new(move || {
        let world = build(&scene, setting)?;
        let watches = watches.iter().map(|(name, watch)| (*name, watch(&scene))).collect();
        Ok(Run { world, watches })
    })
}

/// Returns whether the two scenes have the same bodies, sizes and duration, so that one run serves both.
fn have_the_same_runs<S: PartialEq>(a: &ChartScene<S>, b: &ChartScene<S>) -> bool {
    let is_like =
        a.sizes == b.sizes && a.seconds == b.seconds && a.broad_phases_matter == b.broad_phases_matter;
    is_like && a.sizes.first().is_some_and(|&size| (a.build)(size) == (b.build)(size))
}

fn matters<S>(method: &Method<S>, scene: &ChartScene<S>) -> bool {
    (scene.broad_phases_matter || !method.is_broad_phase_variant)
        && (scene.peers_too || method.family == Family::Ours)
}

/// Returns the settings that are run with a number of bodies: all if there are few bodies. A method that has one setting is
/// run with that one.
fn settings<S>(method: &Method<S>, size: usize, effort: Effort) -> Vec<Setting> {
    if (method.settings)(effort).len() == 1 {
        return vec![method.recommended];
    }
    let usual = method.recommended;
    let (dt, passes) = (usual.dt.mean(), usual.passes);
    let careful = Setting::fixed(dt, 4 * passes);
    let steps = [0.016, 0.01].map(|dt| Setting::fixed(dt, passes));
    match (effort, size) {
        (Effort::Quick, MANY..) => vec![usual, careful],
        (Effort::Full, VERY_MANY..) => {
            let short = Setting::fixed(dt / 4.0, passes);
            [usual, careful, short, Setting::jitter(dt, passes)].into_iter().chain(steps).collect()
        }
        (Effort::Full, MANY..) => {
            let both = Setting::fixed(dt / 4.0, 4 * passes);
            (method.settings)(Effort::Quick).into_iter().chain(steps).chain([both]).collect()
        }
        _ => (method.settings)(effort),
    }
}

#[cfg(test)]
mod tests {
    use super::super::charts::chart_scenes;
    use super::super::depth::{depth_chart_scenes, depth_methods};
    use super::super::method::methods;
    use super::*;

    #[test]
    fn scenes_that_differ_only_in_their_measure_of_error_share_runs() {
        let throws: Vec<_> =
            chart_scenes().into_iter().filter(|scene| scene.name.starts_with("throw")).collect();
        assert_eq!(throws.len(), 2);
        let trials = trials(&throws, &methods()[..1], Effort::Quick);
        let run = (trials[0].start)().unwrap_or_else(|error| panic!("{error}"));
        let names: Vec<_> = run.watches.iter().map(|(name, _)| *name).collect();
        assert_eq!((trials[0].scene, names), (throws[0].name, vec![throws[0].name, throws[1].name]));
        assert!(trials.iter().all(|trial| trial.scene == throws[0].name));
    }

    #[test]
    fn the_ball_pit_is_run_once_for_both_of_its_measures() {
        let scenes: Vec<_> =
            depth_chart_scenes().into_iter().filter(|scene| scene.name.starts_with("ball_pit")).collect();
        let trials = trials(&scenes, &depth_methods()[..1], Effort::Quick);
        assert!(trials.iter().all(|trial| trial.scene == scenes[0].name));
        let run = (trials[0].start)().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(run.watches.len(), 2);
    }

    #[test]
    fn large_scenes_run_only_in_the_full_sweep() {
        let sizes = |effort| {
            let trials = trials(&chart_scenes(), &methods()[..1], effort);
            trials.iter().map(|trial| trial.size).max()
        };
        assert!(sizes(Effort::Quick) < Some(VERY_MANY) && sizes(Effort::Full) >= Some(VERY_MANY));
    }

    #[test]
    fn no_two_scenes_have_the_same_name() {
        let mut names: Vec<_> = chart_scenes().iter().map(|scene| scene.name).collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count);
    }
}
