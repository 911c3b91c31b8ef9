//! Tests the limits of the methods of the 2D engine: the outcomes of the families of the stability map must equal those in
//! `golden/stability/plane.txt`.
//!
//! The golden file records the present outcomes, not the desired ones, so that the tests find any change. Failures of the
//! faithful set are failures of Farseer, and stay.
//!
//! The tests run some values of every family with few settings. An ignored test runs all of them and takes some minutes:
//! `cargo test --release -p measure --test stability -- --ignored`.

use crate::written::{GoldenFamilies, assert_all_equal_golden, assert_golden_is_complete};
use measure::method::{Effort, Family, Method, methods};
use measure::stability::{families, sheet::sheet};

const GOLDEN: GoldenFamilies = GoldenFamilies {
    file: "plane.txt",
    text: include_str!("../../../golden/stability/plane.txt"),
    sheets: || families().into_iter().map(|family| sheet(family, &our_methods(), Effort::Full)).collect(),
};

/// Returns the methods whose outcomes are in the golden file. The precise set is not one of them, since it still changes.
fn our_methods() -> Vec<Method> {
    let is_finished = |method: &Method| method.family == Family::Ours && method.name != "Precise";
    methods().into_iter().filter(is_finished).collect()
}

fn quick_values(name: &str) -> Vec<f64> {
    let family = families().into_iter().find(|family| family.name == name);
    family.unwrap_or_else(|| panic!("there is no family {name}")).quick_values.to_vec()
}

outcomes_equal_golden! {
    GOLDEN, quick_values;
    outcomes_of_stacks_of_boxes_equal_the_golden_file: "Vertical Stack";
    outcomes_of_pyramids_equal_the_golden_file: "Pyramid";
    outcomes_of_stacks_of_circles_equal_the_golden_file: "Circle Stack";
    outcomes_of_card_houses_and_dominoes_equal_the_golden_file: "Card House", "Double Domino";
    outcomes_of_arches_equal_the_golden_file: "Arch";
    outcomes_of_crowds_equal_the_golden_file: "Confined", "Rush", "Circle Pit";
    outcomes_of_high_mass_ratios_equal_the_golden_file: "High Mass Ratio 1", "High Mass Ratio 2", "High Mass Ratio 3";
    outcomes_of_overlap_recovery_equal_the_golden_file: "Overlap Recovery", "Warm Start Energy";
    outcomes_of_friction_ramps_equal_the_golden_file: "Friction Ramp", "Friction Ramp, sliding";
    outcomes_of_chains_equal_the_golden_file: "Bridge", "Ball and Chain", "Stretched Chain", "Joint Grid", "Breakable Joint";
    outcomes_of_ragdolls_equal_the_golden_file: "Ragdoll";
    outcomes_far_from_the_origin_equal_the_golden_file: "Far Pyramid", "Far Chain";
    outcomes_of_bullets_equal_the_golden_file: "Bullet Circle, wall of 4 px", "Bullet Circle, wall of 32 px",
        "Bullet Box, wall of 4 px", "Bullet Box, wall of 32 px", "Bullet, thin wall", "Spinning Plank";
    outcomes_of_coarse_distance_grids_equal_the_golden_file: "Grid Cell, resting box", "Concave Notch, cell size", "Concave Notch, depth",
        "Thin Needle, falling flat", "Needle on Posts", "Crossing Bars";
    outcomes_of_hard_scenes_for_broad_phases_equal_the_golden_file: "Teleport", "Fast Bodies", "Equal Coordinates";
    outcomes_of_stiff_springs_equal_the_golden_file: "Stiff Spring", "Stiff Damper", "Stiff Angle Spring";
    outcomes_of_odd_steps_equal_the_golden_file: "Step Spike", "Step Spike, falling", "Zero Steps", "Tiny Steps";
    outcomes_of_odd_inputs_equal_the_golden_file: "Huge Impulse", "Not a Number";
}

#[test]
fn every_family_is_in_a_test() {
    let mut tested = TESTED.to_vec();
    let mut names: Vec<&str> = families().iter().map(|family| family.name).collect();
    tested.sort_unstable();
    names.sort_unstable();
    assert_eq!(tested, names);
}

#[test]
fn quick_values_are_among_all_values() {
    for family in families() {
        let are_known = family.quick_values.iter().all(|value| family.values.contains(value));
        assert!(are_known && !family.quick_values.is_empty(), "{}", family.name);
    }
}

#[test]
fn the_golden_file_has_every_family_with_all_values_and_settings() {
    assert_golden_is_complete(&GOLDEN);
}

#[test]
#[ignore = "minutes long: every family with all its values and settings"]
fn the_outcomes_of_every_family_equal_the_golden_file() {
    assert_all_equal_golden(&GOLDEN);
}
