//! Writes the report of the measurements of sleep, as text.

use crate::measuring::Origin;
use measure::sleep::heaps::{HEAP, HeapsFigures};
use measure::sleep::pushes::{PushFigures, REST};
use std::fmt::Write;

const NEVER: &str = "never";

/// Returns the report in Markdown: the origin of the figures, heaps that sleep, and a pyramid that is pushed.
pub fn report(origin: &Origin, heaps: &[HeapsFigures], pushes: &[PushFigures]) -> String {
    let mut text = String::from("# Sleep, beside the peers\n\n");
    for (name, value) in origin {
        writeln!(text, "- {name}: {value}").expect("a text takes all");
    }
    text.push_str(&heaps_section(heaps));
    text.push_str(&pushes_section(pushes));
    text
}

fn heaps_section(heaps: &[HeapsFigures]) -> String {
    let boxes = heaps.first().map_or(0, |first| first.boxes);
    let mut text = format!(
        "\n## Heaps\n\n{} heaps of {HEAP} boxes, and one box more that is dropped on one of them when all sleep: {boxes} bodies \
         that can move. Steps of 1/60 s as recommended; times are CPU time of a step in one thread, medians of turns.\n\n\
         | | asleep | after s | us per step, asleep | awake | awake / asleep | woken by the box, in its heap | elsewhere | all asleep \
         again after s |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        boxes / HEAP
    );
    for figures in heaps {
        let HeapsFigures { method, asleep, us_asleep, us_awake, woken, woken_elsewhere, .. } = figures;
        let [after, again] = [figures.asleep_after_s, figures.asleep_again_after_s].map(seconds);
        let ratio = us_awake / us_asleep;
        writeln!(
            text,
            "| {method} | {asleep} | {after} | {us_asleep:.2} | {us_awake:.0} | {ratio:.0} | {woken} | {woken_elsewhere} | {again} |"
        )
        .expect("a text takes all");
    }
    text
}

fn pushes_section(pushes: &[PushFigures]) -> String {
    let boxes = pushes.first().map_or(0, |first| first.boxes);
    let mut text = format!(
        "\n## A push\n\nA pyramid of {boxes} boxes that sleeps; the outermost of its lowest row is pushed inwards. At rest: \
         no point moves faster than {REST} px/s. Asleep: as the engine reports.\n\n\
         | push, m/s | | awake after a step | at most | fallen | at rest again after s | asleep again after s |\n\
         |---:|---|---:|---:|---:|---:|---:|\n"
    );
    for figures in pushes {
        let PushFigures { method, push, woken_at_once, woken, fallen, .. } = figures;
        let [rest, asleep] = [figures.at_rest_again_after_s, figures.asleep_again_after_s].map(seconds);
        let line = match figures.asleep_after_s {
            Some(_) => format!("{woken_at_once} | {woken} | {fallen} | {rest} | {asleep}"),
            None => "did not sleep | | | |".to_owned(),
        };
        writeln!(text, "| {push} | {method} | {line} |").expect("a text takes all");
    }
    text
}

fn seconds(time: Option<f64>) -> String {
    time.map_or(NEVER.to_owned(), |time| format!("{time:.2}"))
}
