//! What the sweep makes of the chart's scenes with depth.

use super::{DepthChartScene, DepthMethod, DepthWatch, DepthWorld};
use crate::depth_scenes::DepthScene;
use crate::measure::method::{Effort, Setting};
use crate::measure::stability::reasons::NOT_FINITE;
use crate::measure::sweep::{Outcome, Running, Start, Trial};
use std::rc::Rc;

/// From this number of objects on fewer settings are tried.
const MANY: usize = 100;
/// From this number of objects on few settings are tried, and none when there is little time.
const VERY_MANY: usize = 1000;

/// The trials of scenes with methods, those of one scene and size one after the other. Scenes that follow each other
/// and differ in what counts as error alone share their runs.
pub fn depth_trials(
    scenes: &[DepthChartScene],
    methods: &[DepthMethod],
    effort: Effort,
) -> Vec<Trial<'static>> {
    let mut trials = Vec::new();
    for scenes in scenes.chunk_by(have_the_same_runs) {
        let scene = scenes[0];
        let watches: Rc<[Measure]> = scenes.iter().map(|scene| (scene.name, scene.watch)).collect();
        for &size in scene.sizes.iter().filter(|&&size| effort == Effort::Full || size < VERY_MANY) {
            let built = Rc::new((scene.build)(size));
            for method in methods {
                trials.extend(settings(method, size, effort).into_iter().map(|setting| Trial {
                    scene: scene.name,
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

/// The name of a scene, and what watches it.
type Measure = (&'static str, fn(&DepthScene) -> Box<dyn DepthWatch>);

fn start(
    scene: &Rc<DepthScene>,
    watches: &Rc<[Measure]>,
    method: &DepthMethod,
    setting: Setting,
) -> Start<'static> {
    let (scene, watches, build) = (Rc::clone(scene), Rc::clone(watches), method.build);
    Box::new(move || {
        let watches = watches.iter().map(|(name, watch)| (*name, watch(&scene))).collect();
        Ok(Box::new(DepthRun { world: build(&scene, setting), watches }))
    })
}

/// Whether the runs of one scene do for another.
fn have_the_same_runs(a: &DepthChartScene, b: &DepthChartScene) -> bool {
    let is_like = a.sizes == b.sizes && a.seconds == b.seconds;
    is_like && a.sizes.first().is_some_and(|&size| (a.build)(size) == (b.build)(size))
}

/// The settings that are tried: all where there are few objects.
fn settings(method: &DepthMethod, size: usize, effort: Effort) -> Vec<Setting> {
    let usual = method.recommended;
    let dt = usual.dt.mean();
    let careful = Setting::fixed(dt, 4 * usual.passes);
    match (effort, size) {
        (Effort::Full, VERY_MANY..) => vec![usual, careful, Setting::fixed(dt / 4.0, usual.passes)],
        (Effort::Quick, MANY..) => vec![usual, careful],
        (Effort::Full, MANY..) => (method.settings)(Effort::Quick),
        _ => (method.settings)(effort),
    }
}

/// A scene with depth in an engine, and who watches it.
struct DepthRun {
    world: Box<dyn DepthWorld>,
    watches: Vec<(&'static str, Box<dyn DepthWatch>)>,
}

impl Running for DepthRun {
    fn step(&mut self, dt: f32) {
        self.world.step(dt);
    }

    fn look(&mut self, time: f64) -> bool {
        for (_, watch) in &mut self.watches {
            watch.see(time, &*self.world);
        }
        self.watches.iter().all(|(_, watch)| watch.failed() != Some(NOT_FINITE))
    }

    fn verdict(&self) -> (f64, Outcome) {
        verdict(&*self.watches[0].1)
    }

    fn others(&self) -> Vec<(&'static str, f64, Outcome)> {
        let others = self.watches[1..].iter().map(|(name, watch)| {
            let (error, outcome) = verdict(&**watch);
            (*name, error, outcome)
        });
        others.collect()
    }
}

fn verdict(watch: &dyn DepthWatch) -> (f64, Outcome) {
    match watch.failed() {
        Some(reason) => (f64::INFINITY, Outcome::Failed(reason)),
        None if watch.error().is_finite() => (watch.error(), Outcome::Fine),
        None => (f64::INFINITY, Outcome::Failed("nothing to measure")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::depth::{depth_chart_scenes, depth_methods};

    #[test]
    fn the_ball_pit_is_run_once_for_both_of_its_measures() {
        let scenes: Vec<_> =
            depth_chart_scenes().into_iter().filter(|scene| scene.name.starts_with("ball_pit")).collect();
        let trials = depth_trials(&scenes, &depth_methods()[..1], Effort::Quick);
        assert!(trials.iter().all(|trial| trial.scene == scenes[0].name));
        let run = (trials[0].start)().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(run.others().len(), 1);
    }
}
