//! Tests small scenes of the precise set with fixed seeds.

use fuzz::long_run::failures;
use fuzz::small::small_scene_holds;

#[test]
fn small_scenes_keep_their_bodies_inside_and_conserve_momentum_and_energy() {
    let failures = failures(0..400, small_scene_holds);
    assert!(failures.is_empty(), "{failures:#?}");
}

/// Parts of the concave bodies have edges that face away from the wall. The whole wall is behind such an edge.
#[test]
fn concave_bodies_deep_in_a_wall_are_not_thrown_about() {
    let seeds = [1432, 2595, 4493, 6116, 7908, 8677, 9125, 10898, 16307, 18531, 18783];
    let failures = failures(seeds, small_scene_holds);
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn a_wedge_without_a_direct_solution_adds_no_energy() {
    // Fault that these seeds found: normal impulses and friction on both sides of a light body raised each other. The energy
    // became 13, 123 and 230 times as great.
    let failures = failures([42_012, 37_610, 29_488], small_scene_holds);
    assert!(failures.is_empty(), "{failures:#?}");
}

/// Faults that these seeds found: stiff springs of a wrong active set, and friction that flipped from one limit to the other,
/// raised the energy up to 1e46 times. Newton steps whose impulses were invalid violated the conservation of momentum.
#[test]
fn stiff_springs_and_flipping_friction_add_no_energy_or_momentum() {
    let failures =
        failures([3222, 50_332, 12_038, 12_385, 16_601, 25_158, 15_571, 15_639], small_scene_holds);
    assert!(failures.is_empty(), "{failures:#?}");
}

/// Fault that these seeds found: the iterative solver cannot release a jammed body that is hundreds of times as heavy as its
/// obstacle. The energy grew by 16 to 140 %.
#[test]
fn a_heavy_body_leaves_a_jam_no_faster_than_it_entered() {
    let seeds = [4010, 8862, 29_842, 163_458, 211_423, 220_780, 243_593];
    let failures = failures(seeds, small_scene_holds);
    assert!(failures.is_empty(), "{failures:#?}");
}

/// Fault that these seeds found: an island that the direct solver could not solve kept all impulses of the jam when it went to
/// the iterative solver.
#[test]
fn an_island_that_leaves_the_direct_solver_does_not_keep_its_jam_impulses() {
    let seeds = [6591, 8068, 26_593, 28_878, 34_580, 40_819, 61_105, 69_678, 71_773];
    let failures = failures(seeds, small_scene_holds);
    assert!(failures.is_empty(), "{failures:#?}");
}
