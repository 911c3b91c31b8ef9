//! Tests the limits of the methods of the 2.5D engine: the outcomes of the families of the stability map must equal those in
//! `golden/stability/depth.txt`.
//!
//! The golden file records the present outcomes, not the desired ones, so that the tests find any change. They run each family
//! with all of its values, but with few settings; of the family `Crowd`, they run only the values up to 1,000 objects. An
//! ignored test runs all settings and values (the head of `plane.rs` has its command).

use crate::common::depth::{Changed, Frozen, faithful, thesis};
use crate::written::{GoldenFamilies, assert_all_equal_golden, assert_golden_is_complete};
use measure::depth::{DepthFamily, depth_families};
use measure::method::Effort;
use measure::stability::{reasons, sheet::sheet};
use measure::world::BodyState;

const GOLDEN: GoldenFamilies = GoldenFamilies {
    file: "depth.txt",
    text: include_str!("../../../golden/stability/depth.txt"),
    sheets: || {
        let methods = [faithful(), thesis()];
        depth_families().into_iter().map(|family| sheet(family, &methods, Effort::Full)).collect()
    },
};

/// Length of a step, s: the usual one.
const STEP: f32 = 1.0 / 60.0;
/// Largest number of objects of the family `Crowd` that is always run.
const CROWD: f64 = 1e3;

fn values(name: &str) -> Vec<f64> {
    let family: Option<DepthFamily> = depth_families().into_iter().find(|family| family.name == name);
    let values = family.unwrap_or_else(|| panic!("there is no family {name}")).values;
    values.iter().copied().filter(|&value| name != "Crowd" || value <= CROWD).collect()
}

outcomes_equal_golden! {
    GOLDEN, values;
    outcomes_of_landings_equal_the_golden_file: "Land, fast", "Land, thin platform", "Land, over the edge";
    outcomes_of_head_bumps_equal_the_golden_file: "Head Bump, fast", "Head Bump, thin platform";
    outcomes_of_walks_off_edges_equal_the_golden_file: "Walk off each edge, fast", "Walk off each edge, low platform";
    outcomes_of_passes_under_platforms_equal_the_golden_file: "Pass under", "Pass under, fast";
    outcomes_of_steps_equal_the_golden_file: "Step up", "Step that stops a ball", "Step that stops a box";
    outcomes_of_gaps_and_seams_equal_the_golden_file: "Hole between platforms", "Narrow gap between platforms",
        "Seam of platforms, fast";
    outcomes_of_shadows_equal_the_golden_file: "Shadow on the highest support", "Shadow of somebody sunk in";
    outcomes_of_throws_over_a_figure_equal_the_golden_file: "Throw over someone";
    outcomes_of_hits_in_depth_equal_the_golden_file: "Depth miss", "Depth hit, fast", "Depth hit, thin",
        "Depth hit, glancing";
    outcomes_of_diagonal_hits_equal_the_golden_file: "Diagonal hit, fast", "Diagonal hit, close";
    outcomes_of_crowds_with_depth_equal_the_golden_file: "Crowd";
}

#[test]
fn every_family_is_in_a_test() {
    let mut tested = TESTED.to_vec();
    let mut names: Vec<&str> = depth_families().iter().map(|family| family.name).collect();
    tested.sort_unstable();
    names.sort_unstable();
    assert_eq!(tested, names);
}

#[test]
fn a_motionless_world_fails_families_that_need_motion() {
    // In the family `Crowd` motion is not required.
    for family in depth_families() {
        let value = family.values[0];
        let scene = (family.build)(value, STEP);
        let (world, mut watch) = (Frozen::new(&scene), (family.judge)(value, &scene));
        (0..=200).for_each(|step| watch.observe(f64::from(step) / 200.0 * (family.seconds)(value), &world));
        assert_eq!(watch.failed().is_none(), family.name == "Crowd", "{}", family.name);
    }
}

#[test]
fn a_state_that_is_not_finite_fails_in_every_family() {
    for family in depth_families() {
        let value = family.values[0];
        let method = faithful();
        let scene = (family.build)(value, STEP);
        let world = (method.build)(&scene, method.recommended).unwrap();
        let broken = Changed {
            world,
            change: |_, mut state: BodyState| {
                state.velocity[2] = f64::NAN;
                state
            },
        };
        let mut watch = (family.judge)(value, &scene);
        watch.observe(0.0, &broken);
        assert_eq!(watch.failed(), Some(reasons::NOT_FINITE), "{}", family.name);
    }
}

#[test]
fn quick_values_are_among_all_values() {
    for family in depth_families() {
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
