//! Lists the methods and settings that a family is run with, and makes one such run.

use super::map::{Cell, Column, Heading, Sheet, Verdict};
use super::{Moment, StabilityFamily, reasons};
use crate::method::{Effort, Family, Mapped, Method, Setting};
use std::panic::{self, AssertUnwindSafe};

/// Returns the sheet of a family: its columns (methods with settings) and values, and the function that makes a run. No run has
/// been made yet.
pub fn sheet<S: 'static>(family: StabilityFamily<S>, methods: &[Method<S>], effort: Effort) -> Sheet {
    let methods =
        methods.iter().filter(|method| family.broad_phases_matter || !method.is_broad_phase_variant);
    let columns: Vec<(Method<S>, Mapped)> = methods
        .flat_map(|method| (method.mapped)(effort).into_iter().map(|mapped| (*method, mapped)))
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
        columns: columns.iter().map(column).collect(),
    };
    let run = move |value: f64, index: usize| {
        let (method, mapped) = &columns[index];
        run(&family, value, method, mapped.setting)
    };
    Sheet { heading, run: Box::new(run) }
}

fn column<S>((method, mapped): &(Method<S>, Mapped)) -> Column {
    let Mapped { setting, is_in_table } = *mapped;
    Column { method: method.name.to_owned(), dt: setting.dt.label(), passes: setting.passes, is_in_table }
}

/// Runs the scene of a family for one value of its parameter, with a method and a setting, and returns the outcome.
pub fn run<S>(family: &StabilityFamily<S>, value: f64, method: &Method<S>, setting: Setting) -> Cell {
    guarded(method.family, || run_in(family, value, method, setting))
}

/// Makes a run and returns its outcome. A panic of another project's engine is a failed run; a panic of our engine is passed
/// on.
fn guarded(family: Family, run: impl FnOnce() -> Cell) -> Cell {
    match family {
        Family::Ours => run(),
        Family::Peer => {
            panic::catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|_| Cell::failed(reasons::PANICKED))
        }
    }
}

fn run_in<S>(family: &StabilityFamily<S>, value: f64, method: &Method<S>, setting: Setting) -> Cell {
    let base = setting.dt.mean();
    let scene = (family.build)(value, base);
    let mut world = match (method.build)(&scene, setting) {
        Ok(world) => world,
        Err(_) if method.family == Family::Ours => return Cell::failed(reasons::REFUSED),
        Err(reason) => return Cell::absent(reason),
    };
    let mut watch = (family.judge)(value, &scene);
    watch.observe(0.0, &*world);
    let mut time = 0.0;
    let steps = (family.whole)((family.seconds)(value) / f64::from(base)) as usize;
    for (step, dt) in setting.dt.steps().take(steps).enumerate() {
        let moment = Moment { step: step as u32, time, dt };
        (family.act)(value, &mut *world, moment);
        let dt = (family.dt)(value, moment);
        world.step(dt);
        time += f64::from(dt);
        watch.observe(time, &*world);
    }
    let verdict = watch.failed().map_or(Verdict::Holds, Verdict::Failed);
    Cell { verdict, measured: watch.error() }
}
