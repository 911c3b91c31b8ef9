//! Where the methods of the 2.5D engine hold, and where they are known to fail: a change of either is seen here.
//!
//! A letter for each value of a family's parameter, from easy to hard: a dot for what holds, else the letter of the
//! reason (`measure::stability::reasons`, or the first one of a word of the family's own). Run with the engine's default
//! iterations and steps of 1/60 s. What is written down is not what should be but what is.
//!
//! All values with all settings: `cargo test --release -p conformance --test stability_depth -- --ignored`.

mod depth_common;

use conformance::measure::depth::{DepthFamily, DepthMethod, depth_families, depth_sheet, run};
use conformance::measure::method::Effort;
use conformance::measure::stability::map::{Cell, Verdict};
use conformance::measure::stability::reasons;
use depth_common::{Changed, Frozen, faithful, thesis};
use std::fs;
use std::path::Path;

const GOLDEN: &str = include_str!("../golden/stability/depth_outcomes.txt");

fn family(name: &str) -> DepthFamily {
    let found = depth_families().into_iter().find(|family| family.name == name);
    found.unwrap_or_else(|| panic!("there is no family {name}"))
}

fn letter(cell: &Cell) -> char {
    match &cell.verdict {
        Verdict::Holds => '.',
        Verdict::Failed(reason) => reasons::letter(reason),
        Verdict::Absent(_) => '-',
    }
}

fn outcomes(family: &DepthFamily, values: &[f64], method: &DepthMethod) -> String {
    values.iter().map(|&value| letter(&run(family, value, method, method.recommended))).collect()
}

/// Asserts what comes of all values of a family, with both methods.
#[track_caller]
fn assert_comes_out(name: &str, with_faithful: &str, with_thesis: &str) {
    let family = family(name);
    let found = [faithful(), thesis()].map(|method| outcomes(&family, family.values, &method));
    assert_eq!(found, [with_faithful, with_thesis], "{name}");
}

#[test]
fn things_land_until_a_step_takes_them_through_the_platform() {
    assert_comes_out("Land, fast", "", "");
    assert_comes_out("Land, thin platform", "", "");
}

#[test]
fn things_land_with_little_of_them_over_the_platform() {
    assert_comes_out("Land, over the edge", "", "");
}

#[test]
fn heads_bump_until_a_step_takes_them_through_the_platform() {
    assert_comes_out("Head Bump, fast", "", "");
    assert_comes_out("Head Bump, thin platform", "", "");
}

#[test]
fn things_walk_off_every_edge_at_every_speed_and_height() {
    assert_comes_out("Walk off each edge, fast", "", "");
    assert_comes_out("Walk off each edge, low platform", "", "");
}

#[test]
fn things_pass_under_at_every_gap_and_speed() {
    assert_comes_out("Pass under", "", "");
    assert_comes_out("Pass under, fast", "", "");
}

#[test]
fn balls_climb_the_steps_that_they_are_fast_enough_for() {
    assert_comes_out("Step up", "", "");
    assert_comes_out("Step that stops a ball", "", "");
}

#[test]
fn boxes_are_stopped_by_steps_that_are_higher_than_what_the_solver_leaves_alone() {
    assert_comes_out("Step that stops a box", "", "");
}

#[test]
fn holes_are_fallen_into_and_gaps_and_seams_are_crossed() {
    assert_comes_out("Hole between platforms", "", "");
    assert_comes_out("Narrow gap between platforms", "", "");
    assert_comes_out("Seam of platforms, fast", "", "");
}

#[test]
fn the_shadow_lies_on_the_highest_support() {
    assert_comes_out("Shadow on the highest support", "", "");
    assert_comes_out("Shadow of somebody sunk in", "", "");
}

#[test]
fn somebody_is_thrown_over_someone_unless_the_step_takes_more_than_the_distance() {
    assert_comes_out("Throw over someone", "", "");
}

#[test]
fn what_misses_in_depth_is_not_touched() {
    assert_comes_out("Depth miss", "", "");
}

#[test]
fn what_hits_in_depth_flies_back_until_a_step_takes_it_through() {
    assert_comes_out("Depth hit, fast", "", "");
    assert_comes_out("Depth hit, thin", "", "");
    assert_comes_out("Depth hit, glancing", "", "");
}

#[test]
fn what_comes_along_all_three_axes_is_thrown_back_along_the_last() {
    assert_comes_out("Diagonal hit, fast", "", "");
    assert_comes_out("Diagonal hit, close", "", "");
}

#[test]
fn crowds_stay_where_they_belong() {
    let family = family("Crowd");
    let found = [faithful(), thesis()].map(|method| outcomes(&family, family.quick_values, &method));
    assert_eq!(found, ["", ""]);
}

#[test]
fn a_world_in_which_nothing_moves_fails_where_something_must_happen() {
    // Shadows do not move, and a crowd may rest.
    let may_rest = ["Crowd"];
    for family in depth_families() {
        let value = family.values[0];
        let world = Frozen::new(&(family.build)(value));
        let mut watch = (family.judge)(value);
        (0..10).for_each(|step| watch.see(f64::from(step) * (family.seconds)(value) / 9.0, &world));
        assert_eq!(watch.failed().is_none(), may_rest.contains(&family.name), "{}", family.name);
    }
}

#[test]
fn a_state_that_is_not_finite_fails_in_every_family() {
    for family in depth_families() {
        let value = family.values[0];
        let method = faithful();
        let world = (method.build)(&(family.build)(value), method.recommended);
        let broken = Changed {
            world,
            change: |_, mut state: conformance::peers::State| {
                state.velocity[2] = f64::NAN;
                state
            },
        };
        let mut watch = (family.judge)(value);
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
fn every_family_is_written_down_with_all_its_values() {
    let line = |family: DepthFamily| move |value: &f64| format!("{}; {value:e}", family.name);
    let expected: Vec<String> =
        depth_families().into_iter().flat_map(|family| family.values.iter().map(line(family))).collect();
    let written = GOLDEN.lines().filter(|line| !line.starts_with('#'));
    let written: Vec<&str> =
        written.filter_map(|line| line.rsplit_once("; ").map(|(before, _)| before)).collect();
    assert_eq!(written, expected);
}

#[test]
#[ignore = "minutes long: every family with all its values and settings"]
fn every_family_comes_out_as_it_did() {
    let methods = [faithful(), thesis()];
    let lines = |family: DepthFamily| {
        let map = depth_sheet(family, &methods, Effort::Full).fill(&|| {});
        let rows = map.heading.values.iter().zip(&map.rows);
        let line = |(value, row): (&f64, &Vec<Cell>)| {
            let letters: String = row.iter().map(letter).collect();
            format!("{}; {value:e}; {letters}", family.name)
        };
        rows.map(line).collect::<Vec<_>>()
    };
    let found: Vec<String> = depth_families().into_iter().flat_map(lines).collect();
    let known: Vec<&str> = GOLDEN.lines().filter(|line| !line.starts_with('#')).collect();
    if found != known {
        let place = Path::new(env!("CARGO_TARGET_TMPDIR")).join("depth_outcomes.txt");
        let header: Vec<&str> = GOLDEN.lines().take_while(|line| line.starts_with('#')).collect();
        let text = format!("{}\n{}\n", header.join("\n"), found.join("\n"));
        fs::write(&place, text).expect("the folder for temporary files can be written to");
        let changed: Vec<&String> = found.iter().filter(|line| !known.contains(&line.as_str())).collect();
        panic!("changed, all of it is in {}:\n{changed:#?}", place.display());
    }
}
