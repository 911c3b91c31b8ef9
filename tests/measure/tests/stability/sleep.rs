//! Tests that a disturbance wakes a sleeping body and no other, with the precise set.

use measure::method::{Method, methods};
use measure::sleep::heaps::{HEAP, HeapsFigures, run_heaps};
use measure::sleep::pushes::{PushFigures, run_push};
use measure::sleep::sleepers;

fn precise() -> Method {
    let precise = sleepers(methods()).into_iter().find(|method| method.name == "Precise");
    precise.expect("it is there")
}

fn four_heaps() -> HeapsFigures {
    run_heaps(&[precise()], 4).expect("it has boxes").remove(0)
}

fn pushed() -> PushFigures {
    run_push(&precise(), 2.0).expect("it has boxes")
}

#[test]
fn collapsed_heaps_sleep() {
    let figures = four_heaps();
    assert_eq!((figures.boxes, figures.asleep), (4 * HEAP + 1, 4 * HEAP + 1));
}

#[test]
fn a_box_that_lands_on_a_heap_wakes_boxes_of_that_heap_alone() {
    let figures = four_heaps();
    assert!(figures.woken > 0);
    assert_eq!(figures.woken_elsewhere, 0);
}

#[test]
fn a_heap_that_was_woken_sleeps_again() {
    assert!(four_heaps().asleep_again_after_s.is_some());
}

#[test]
fn a_push_at_its_foot_wakes_all_of_a_pyramid_in_the_next_step() {
    let figures = pushed();
    assert_eq!(figures.woken_at_once, figures.boxes);
}

#[test]
fn a_pyramid_that_was_pushed_sleeps_again() {
    assert!(pushed().asleep_again_after_s.is_some());
}
