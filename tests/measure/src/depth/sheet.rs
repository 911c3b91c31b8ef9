//! Which methods and settings a family is run with, and one such run.

use super::{DepthFamily, DepthMethod};
use crate::method::{Effort, Family, Setting};
use crate::stability::map::{Cell, Column, Heading, Sheet, Verdict};
use crate::stability::sheet::guarded;

/// The steps on a map in s: a long one, the usual one, and a short one.
const STEPS: [f32; 3] = [1.0 / 30.0, 1.0 / 60.0, 1.0 / 200.0];
/// Iterations of ours beside the default ones.
const CAREFUL: u32 = 20;

/// The map of a family with these methods, still to be made.
pub fn depth_sheet(family: DepthFamily, methods: &[DepthMethod], effort: Effort) -> Sheet {
    let columns: Vec<(DepthMethod, Setting)> = methods
        .iter()
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

fn settings(method: &DepthMethod, effort: Effort) -> Vec<Setting> {
    let usual = method.recommended.passes;
    let mut settings: Vec<Setting> = STEPS.iter().map(|&dt| Setting::fixed(dt, usual)).collect();
    if method.family == Family::Ours && effort == Effort::Full {
        settings.extend([STEPS[1], STEPS[2]].map(|dt| Setting::fixed(dt, CAREFUL)));
    }
    settings
}

fn column(method: &DepthMethod, setting: Setting) -> Column {
    let is_short = setting == Setting::fixed(STEPS[2], method.recommended.passes);
    Column {
        method: method.name.to_owned(),
        dt: setting.dt.label(),
        passes: setting.passes,
        is_in_table: is_short || setting == method.recommended,
    }
}

/// One run of a family.
pub fn run(family: &DepthFamily, value: f64, method: &DepthMethod, setting: Setting) -> Cell {
    guarded(method.family, || run_in(family, value, method, setting))
}

fn run_in(family: &DepthFamily, value: f64, method: &DepthMethod, setting: Setting) -> Cell {
    let mut world = match (method.build)(&(family.build)(value), setting) {
        Ok(world) => world,
        Err(reason) => return Cell::absent(reason),
    };
    let mut watch = (family.judge)(value);
    watch.see(0.0, &*world);
    let steps = ((family.seconds)(value) / f64::from(setting.dt.mean())).ceil() as usize;
    let mut time = 0.0;
    for dt in setting.dt.steps().take(steps) {
        world.step(dt);
        time += f64::from(dt);
        watch.see(time, &*world);
    }
    let verdict = watch.failed().map_or(Verdict::Holds, Verdict::Failed);
    Cell { verdict, measured: watch.error() }
}
