//! Where the methods of the 2D engine hold and where they are known to fail, so that a change of either is seen: the
//! families of the stability map come out as is written down in `golden/stability/plane.txt`.
//!
//! What is written down is not what should be but what is. Failures of the faithful set are those of the original, and are
//! not mended there.
//!
//! Some values of every family at few settings are run always. All of them take some minutes:
//! `cargo test --release -p measure --test stability -- --ignored`.

use crate::written::{Written, assert_all_come_out, assert_all_is_written_down};
use measure::method::{Effort, Family, Method, methods};
use measure::stability::{families, sheet::sheet};

const WRITTEN: Written = Written {
    file: "plane.txt",
    text: include_str!("../../../golden/stability/plane.txt"),
    sheets: || families().into_iter().map(|family| sheet(family, &our_methods(), Effort::Full)).collect(),
};

/// Those whose outcomes are not meant to change: the precise set still grows.
fn our_methods() -> Vec<Method> {
    let is_finished = |method: &Method| method.family == Family::Ours && method.name != "Precise";
    methods().into_iter().filter(is_finished).collect()
}

fn quick_values(name: &str) -> Vec<f64> {
    let family = families().into_iter().find(|family| family.name == name);
    family.unwrap_or_else(|| panic!("there is no family {name}")).quick_values.to_vec()
}

come_out_as_written! {
    WRITTEN, quick_values;
    stacks_of_boxes_stand_and_fall_as_they_did: "Vertical Stack";
    pyramids_stand_and_fall_as_they_did: "Pyramid";
    stacks_of_circles_stand_and_fall_as_they_did: "Circle Stack";
    houses_of_cards_and_dominoes_stand_and_fall_as_they_did: "Card House", "Double Domino";
    arches_stand_and_fall_as_they_did: "Arch";
    crowds_come_to_rest_as_they_did: "Confined", "Rush", "Circle Pit";
    heavy_things_are_borne_by_light_ones_as_they_were: "High Mass Ratio 1", "High Mass Ratio 2", "High Mass Ratio 3";
    overlaps_are_pushed_apart_as_they_were: "Overlap Recovery", "Warm Start Energy";
    ramps_hold_and_let_slide_as_they_did: "Friction Ramp", "Friction Ramp, sliding";
    chains_hold_as_they_did: "Bridge", "Ball and Chain", "Stretched Chain", "Joint Grid", "Breakable Joint";
    ragdolls_hold_together_as_they_did: "Ragdoll";
    what_is_far_from_the_origin_holds_as_it_did: "Far Pyramid", "Far Chain";
    bullets_are_stopped_as_they_were: "Bullet Circle, wall of 4 px", "Bullet Circle, wall of 32 px",
        "Bullet Box, wall of 4 px", "Bullet Box, wall of 32 px", "Bullet, thin wall", "Spinning Plank";
    coarse_grids_see_what_they_did: "Grid Cell, resting box", "Concave Notch, cell size", "Concave Notch, depth",
        "Thin Needle, falling flat", "Needle on Posts", "Crossing Bars";
    broad_phases_find_what_they_did: "Teleport", "Fast Bodies", "Equal Coordinates";
    stiff_springs_hold_as_they_did: "Stiff Spring", "Stiff Damper", "Stiff Angle Spring";
    odd_steps_are_survived_as_they_were: "Step Spike", "Step Spike, falling", "Zero Steps", "Tiny Steps";
    odd_inputs_are_survived_as_they_were: "Huge Impulse", "Not a Number";
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
fn every_family_is_written_down_with_all_its_values_and_settings() {
    assert_all_is_written_down(&WRITTEN);
}

#[test]
#[ignore = "minutes long: every family with all its values and settings"]
fn every_family_comes_out_as_it_did() {
    assert_all_come_out(&WRITTEN);
}
