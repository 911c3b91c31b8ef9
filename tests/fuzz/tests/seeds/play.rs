//! Random calls of both simulators, with callbacks that meddle.

use fuzz::checks::{failed_calls_change_nothing, numbers_are_finite};
use fuzz::long_run::failures;
use fuzz::twins::twins_stay_equal;
use fuzz::{CalmDepth, CalmPlane, Depth, OneWayPlane, Plane, StagedPlane, Tied, Upright};

/// Fails with a line per seed.
macro_rules! holds_for {
    ($seeds:expr, $check:expr) => {
        let failures = failures($seeds, $check);
        assert!(failures.is_empty(), "{failures:#?}");
    };
}

#[test]
fn a_2d_simulator_goes_on_as_its_restored_cloned_and_json_twins_do() {
    holds_for!(0..PLANE, twins_stay_equal::<Plane>);
}

#[test]
fn a_2d_simulator_with_one_way_geoms_goes_on_as_its_twins_do() {
    holds_for!(0..PLANE, twins_stay_equal::<OneWayPlane>);
}

#[test]
fn calls_amid_one_way_geoms_that_fail_change_nothing_and_leave_every_number_finite() {
    holds_for!(0..PLANE, failed_calls_change_nothing::<OneWayPlane>);
    holds_for!(0..PLANE, numbers_are_finite::<OneWayPlane>);
}

#[test]
fn a_2_5d_simulator_goes_on_as_its_restored_cloned_and_json_twins_do() {
    holds_for!(0..DEPTH, twins_stay_equal::<Depth>);
}

#[test]
fn a_2_5d_simulator_with_joints_ropes_and_water_goes_on_as_its_twins_do() {
    holds_for!(0..DEPTH, twins_stay_equal::<Tied>);
}

#[test]
fn a_2_5d_simulator_with_what_stands_upright_and_what_turns_goes_on_as_its_twins_do() {
    holds_for!(0..DEPTH, twins_stay_equal::<Upright>);
}

#[test]
fn calls_that_stand_things_up_and_turn_platforms_and_fail_change_nothing() {
    holds_for!(0..DEPTH, failed_calls_change_nothing::<Upright>);
}

#[test]
fn every_number_of_what_stands_upright_is_finite() {
    holds_for!(0..DEPTH, numbers_are_finite::<Upright>);
}

#[test]
fn calls_that_tie_and_push_and_fail_change_nothing() {
    holds_for!(0..DEPTH, failed_calls_change_nothing::<Tied>);
}

#[test]
fn every_number_of_what_is_tied_and_pushed_is_finite() {
    holds_for!(0..DEPTH, numbers_are_finite::<Tied>);
}

#[test]
fn a_game_whose_bodies_reach_the_end_of_all_numbers_along_z_can_be_restored() {
    // Its snapshot held an infinite bound, and was refused.
    holds_for!(814..815, twins_stay_equal::<Depth>);
    // The same of the middle of what two outlines of billions of px have in common.
    holds_for!([4079], twins_stay_equal::<Upright>);
}

#[test]
fn contacts_are_those_of_the_last_step_whatever_was_edited_or_has_gone_since() {
    // The listed ones were where their bodies had been put, of the bodies that their geoms had got, or had left points behind.
    for seed in [177, 540, 871, 1237, 1325] {
        holds_for!(seed..seed + 1, twins_stay_equal::<Depth>);
    }
}

#[test]
fn what_rests_sleeps_and_is_woken_goes_on_as_its_twins_do() {
    holds_for!(0..CALM, twins_stay_equal::<CalmPlane>);
    holds_for!(0..CALM, twins_stay_equal::<CalmDepth<Upright>>);
    holds_for!(0..CALM, twins_stay_equal::<CalmDepth<Tied>>);
}

#[test]
fn every_number_of_what_rests_and_rides_is_finite() {
    holds_for!(0..CALM, numbers_are_finite::<CalmPlane>);
    holds_for!(0..CALM, numbers_are_finite::<CalmDepth<Upright>>);
}

#[test]
fn what_sleeps_is_woken_at_the_same_moment_after_a_restore() {
    // Who was woken between loading and an update slept on, and an update that was refused did not let it wake either.
    holds_for!([50, 206], twins_stay_equal::<CalmDepth<Upright>>);
    holds_for!([189, 341], twins_stay_equal::<CalmDepth<Tied>>);
    // What stands upright had a spin if it was moved in its sleep.
    holds_for!([498], twins_stay_equal::<CalmDepth<Upright>>);
    // What woke before the first step after loading did not ask what lies on it; what cannot turn had a negative zero for a spin.
    holds_for!([4063, 4143, 4017], twins_stay_equal::<CalmDepth<Upright>>);
    // A platform that swings, and was given another hinge in its sleep, lost its place along the depth axis.
    holds_for!([6074], twins_stay_equal::<Upright>);
}

#[test]
fn figures_walk_on_as_after_a_restore() {
    // What is near was edited between loading and walking; stands still in updates, and not between them; is near in another order.
    holds_for!([10_315, 10_591, 10_120], twins_stay_equal::<CalmDepth<Upright>>);
    holds_for!([10_122], twins_stay_equal::<CalmDepth<Tied>>);
    // What is near was disabled since, or goes with the next update.
    holds_for!([3198, 3787], twins_stay_equal::<CalmDepth<Upright>>);
    holds_for!([3046], twins_stay_equal::<CalmDepth<Tied>>);
}

#[test]
fn islands_that_are_solved_directly_have_the_same_contacts_after_a_restore() {
    // The normal of a contact had turned towards the depth axis while its row stayed.
    holds_for!([710_037], twins_stay_equal::<CalmDepth<Upright>>);
}

#[test]
fn the_velocity_of_a_platform_that_swings_at_the_end_of_all_numbers_is_finite() {
    holds_for!([710_015], numbers_are_finite::<CalmDepth<Upright>>);
}

#[test]
fn joints_follow_what_is_not_listed_as_those_of_their_twins_do() {
    holds_for!([708, 1797], twins_stay_equal::<OneWayPlane>);
    holds_for!([369, 381], twins_stay_equal::<Tied>);
}

#[test]
fn what_is_told_of_contacts_is_as_it_is_told_after_a_restore() {
    // Surfaces that were edited before an update that makes no step; contacts of which some have gone.
    holds_for!([284, 814, 505], twins_stay_equal::<Tied>);
    holds_for!([602, 1619], twins_stay_equal::<Upright>);
}

#[test]
fn a_force_along_z_of_what_does_not_move_yet_acts_as_after_a_restore() {
    // Of another mass when it acted, beyond all numbers, and on a negative one.
    holds_for!([411], twins_stay_equal::<Depth>);
    holds_for!([1383, 1146], twins_stay_equal::<Upright>);
}

#[test]
fn a_game_whose_contacts_reach_the_end_of_all_numbers_can_be_restored_and_shows_none_beyond() {
    holds_for!([353], twins_stay_equal::<Tied>);
    holds_for!([5008], twins_stay_equal::<Upright>);
    holds_for!([407, 5614], numbers_are_finite::<Plane>);
    holds_for!([509], numbers_are_finite::<Tied>);
}

#[test]
fn contacts_that_a_stage_out_of_turn_has_found_are_no_panic() {
    holds_for!([889, 1393], numbers_are_finite::<StagedPlane>);
}

#[test]
fn calls_of_the_2d_engine_that_fail_or_look_change_nothing() {
    holds_for!(0..PLANE, failed_calls_change_nothing::<Plane>);
}

#[test]
fn calls_of_the_2_5d_engine_that_fail_or_look_change_nothing() {
    holds_for!(0..DEPTH, failed_calls_change_nothing::<Depth>);
}

#[test]
fn every_number_that_the_2d_engine_shows_is_finite() {
    holds_for!(0..PLANE, numbers_are_finite::<Plane>);
}

#[test]
fn every_number_that_the_2_5d_engine_shows_is_finite() {
    holds_for!(0..DEPTH, numbers_are_finite::<Depth>);
}

#[test]
fn stages_in_any_order_leave_every_number_finite() {
    holds_for!(0..PLANE, numbers_are_finite::<StagedPlane>);
}

/// Games of each property.
const CALM: u64 = 6;
const PLANE: u64 = 30;
const DEPTH: u64 = 25;
