//! Tests known facts about the stability of Farseer, which were measured there: boxes of 32 px, friction 0.5, runs of 10 s.

use measure::method::{Setting, methods};
use measure::stability::map::{Cell, Verdict};
use measure::stability::{families, reasons, sheet};

fn stack(boxes: u32, setting: Setting) -> Cell {
    // Farseer's defaults include the distance grid as narrow phase.
    let family = families().into_iter().find(|family| family.name == "Vertical Stack");
    sheet::run(&family.expect("it is there"), f64::from(boxes), &methods()[0], setting)
}

fn has_toppled(cell: &Cell) -> bool {
    cell.verdict == Verdict::Failed(reasons::TOPPLED)
}

#[test]
fn with_5_iterations_at_a_sixtieth_a_stack_of_5_has_not_fallen_after_10_seconds() {
    assert!(!has_toppled(&stack(5, Setting::fixed(1.0 / 60.0, 5))));
}

#[test]
fn with_5_iterations_at_a_sixtieth_a_stack_of_10_falls() {
    assert!(has_toppled(&stack(10, Setting::fixed(1.0 / 60.0, 5))));
}

#[test]
fn with_20_iterations_at_a_sixtieth_a_stack_of_10_falls_as_well() {
    assert!(has_toppled(&stack(10, Setting::fixed(1.0 / 60.0, 20))));
}

#[test]
fn with_40_iterations_at_a_200th_a_stack_of_20_stands() {
    assert_eq!(stack(20, Setting::fixed(1.0 / 200.0, 40)).verdict, Verdict::Holds);
}
