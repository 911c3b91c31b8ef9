//! Where the methods of the 2.5D engine hold, and where they are known to fail, so that a change of either is seen: the
//! families of the stability map come out as is written down in `golden/stability/depth.txt`.
//!
//! What is written down is not what should be but what is. All values of every family are run always, at few settings,
//! but for the crowds. All settings, and the large crowds: see `plane.rs`.

use crate::common::depth::{Changed, Frozen, faithful, thesis};
use crate::written::{Written, assert_all_come_out, assert_all_is_written_down};
use measure::depth::{DepthFamily, depth_families};
use measure::method::Effort;
use measure::stability::{reasons, sheet::sheet};
use measure::world::BodyState;

const WRITTEN: Written = Written {
    file: "depth.txt",
    text: include_str!("../../../golden/stability/depth.txt"),
    sheets: || {
        let methods = [faithful(), thesis()];
        depth_families().into_iter().map(|family| sheet(family, &methods, Effort::Full)).collect()
    },
};

/// The usual step in s.
const STEP: f32 = 1.0 / 60.0;
/// The largest crowd that is run always.
const CROWD: f64 = 1e3;

fn values(name: &str) -> Vec<f64> {
    let family: Option<DepthFamily> = depth_families().into_iter().find(|family| family.name == name);
    let values = family.unwrap_or_else(|| panic!("there is no family {name}")).values;
    values.iter().copied().filter(|&value| name != "Crowd" || value <= CROWD).collect()
}

come_out_as_written! {
    WRITTEN, values;
    things_land_on_platforms_as_they_did: "Land, fast", "Land, thin platform", "Land, over the edge";
    heads_bump_as_they_did: "Head Bump, fast", "Head Bump, thin platform";
    things_walk_off_edges_as_they_did: "Walk off each edge, fast", "Walk off each edge, low platform";
    things_pass_under_as_they_did: "Pass under", "Pass under, fast";
    steps_are_climbed_and_stop_as_they_did: "Step up", "Step that stops a ball", "Step that stops a box";
    holes_are_fallen_into_and_seams_crossed_as_they_were: "Hole between platforms", "Narrow gap between platforms",
        "Seam of platforms, fast";
    shadows_lie_where_they_did: "Shadow on the highest support", "Shadow of somebody sunk in";
    somebody_is_thrown_over_someone_as_before: "Throw over someone";
    what_comes_in_depth_misses_and_hits_as_it_did: "Depth miss", "Depth hit, fast", "Depth hit, thin",
        "Depth hit, glancing";
    what_comes_along_all_axes_is_thrown_back_as_it_was: "Diagonal hit, fast", "Diagonal hit, close";
    crowds_stay_as_they_did: "Crowd";
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
fn a_world_in_which_nothing_moves_fails_where_something_must_happen() {
    // A crowd may rest.
    for family in depth_families() {
        let value = family.values[0];
        let scene = (family.build)(value, STEP);
        let (world, mut watch) = (Frozen::new(&scene), (family.judge)(value, &scene));
        (0..=200).for_each(|step| watch.see(f64::from(step) / 200.0 * (family.seconds)(value), &world));
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
        watch.see(0.0, &broken);
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
fn every_family_is_written_down_with_all_its_values_and_settings() {
    assert_all_is_written_down(&WRITTEN);
}

#[test]
#[ignore = "minutes long: every family with all its values and settings"]
fn every_family_comes_out_as_it_did() {
    assert_all_come_out(&WRITTEN);
}
