//! Which methods and settings a family is run with, and one such run.

use super::map::{Cell, Column, Heading, Sheet, Verdict};
use super::{Moment, StabilityFamily, reasons};
use crate::method::{Dt, Effort, Family, Method, Setting};
use crate::ours::DEFAULT_METHOD;
use std::panic::{self, AssertUnwindSafe};

/// The iterations of the original's default methods on a map.
const ITERATIONS: [u32; 4] = [5, 10, 20, 40];
/// The steps on a map in s: the usual one, that of games which read whole milliseconds, and a short one.
const STEPS: [f32; 3] = [1.0 / 60.0, 0.016, 1.0 / 200.0];

/// The map of a family with these methods, still to be made. The original's default methods are shown in more settings than
/// others.
pub fn sheet(family: StabilityFamily, methods: &[Method], effort: Effort) -> Sheet {
    let columns: Vec<(Method, Setting)> = methods
        .iter()
        .filter(|method| family.broad_phases_matter || !method.is_broad_phase_variant)
        .flat_map(|method| settings(method, effort).into_iter().map(|setting| (*method, setting)))
        .collect();
    let values = if effort == Effort::Quick { family.quick_values } else { family.values };
    let heading = Heading {
        name: family.name.to_owned(),
        about: family.about.to_owned(),
        parameter: family.parameter.to_owned(),
        unit: family.unit.to_owned(),
        quantity: family.quantity.to_owned(),
        quantity_unit: family.quantity_unit.to_owned(),
        values: values.to_vec(),
        columns: columns.iter().map(|(method, setting)| column(method, *setting)).collect(),
    };
    let run = move |value: f64, index: usize| {
        let (method, setting) = &columns[index];
        run(&family, value, method, *setting)
    };
    Sheet { heading, run: Box::new(run) }
}

/// The settings of a method on a map.
fn settings(method: &Method, effort: Effort) -> Vec<Setting> {
    let usual = STEPS[0];
    let short = STEPS[STEPS.len() - 1];
    if method.family == Family::Peer {
        // As recommended, and with the other steps of ours.
        let others = if effort == Effort::Full { &STEPS[1..] } else { &STEPS[2..] };
        let others = others.iter().map(|&dt| Setting::fixed(dt, method.recommended.passes));
        return [method.recommended].into_iter().chain(others).collect();
    }
    if method.is_broad_phase_variant {
        return vec![Setting::fixed(usual, 5), Setting::fixed(usual, 20)];
    }
    if method.name != DEFAULT_METHOD || effort == Effort::Quick {
        return vec![
            Setting::fixed(usual, 5),
            Setting::fixed(usual, 40),
            Setting::fixed(short, 5),
            Setting::fixed(short, 40),
        ];
    }
    STEPS.iter().flat_map(|&dt| ITERATIONS.map(|passes| Setting::fixed(dt, passes))).collect()
}

fn column(method: &Method, setting: Setting) -> Column {
    // Of ours the usual setting and the most careful one, of peers what they recommend.
    let is_usual = setting == method.recommended;
    let is_careful = setting == Setting::fixed(STEPS[2], 40);
    Column {
        method: method.name.to_owned(),
        dt: setting.dt.label(),
        passes: setting.passes,
        is_in_table: !method.is_broad_phase_variant && (is_usual || is_careful),
    }
}

/// One run of a family.
pub fn run(family: &StabilityFamily, value: f64, method: &Method, setting: Setting) -> Cell {
    guarded(method.family, || run_in(family, value, method, setting))
}

/// What comes of a run. A peer that panics has failed, and the others go on; ours must not panic.
pub(crate) fn guarded(family: Family, run: impl FnOnce() -> Cell) -> Cell {
    match family {
        Family::Ours => run(),
        Family::Peer => {
            panic::catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|_| Cell::failed(reasons::PANICKED))
        }
    }
}

fn run_in(family: &StabilityFamily, value: f64, method: &Method, setting: Setting) -> Cell {
    let base = setting.dt.mean();
    let scene = (family.build)(value, base);
    let mut world = match (method.build)(&scene, setting) {
        Ok(world) => world,
        Err(_) if method.family == Family::Ours => return Cell::failed(reasons::REFUSED),
        Err(reason) => return Cell::absent(reason),
    };
    let mut watch = (family.judge)(value, &scene);
    watch.see(0.0, &*world);
    let mut time = 0.0;
    for (step, dt) in setting.dt.steps().take(step_count(family, setting.dt)).enumerate() {
        let moment = Moment { step: step as u32, time, dt };
        (family.act)(value, &mut *world, moment);
        let dt = (family.dt)(value, moment);
        world.step(dt);
        time += f64::from(dt);
        watch.see(time, &*world);
    }
    let verdict = watch.failed().map_or(Verdict::Holds, Verdict::Failed);
    Cell { verdict, measured: watch.error() }
}

fn step_count(family: &StabilityFamily, dt: Dt) -> usize {
    (family.seconds / f64::from(dt.mean())).round() as usize
}
