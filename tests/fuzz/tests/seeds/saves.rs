//! Tests altered saves with corrected checksums. If a save is not rejected, its simulator is used for a hundred updates with
//! edits, callbacks and queries, and is saved and loaded again.

use fuzz::game::Game;
use fuzz::long_run::failures;
use fuzz::saves::{SaveOutcome, altered_json, altered_snapshot};
use fuzz::{Depth, Plane};

const SEEDS: u64 = 150;

#[test]
fn an_altered_snapshot_of_the_2d_engine_is_refused_or_can_be_used() {
    refused_or_used(altered_snapshot::<Plane>);
}

#[test]
fn an_altered_snapshot_of_the_2_5d_engine_is_refused_or_can_be_used() {
    refused_or_used(altered_snapshot::<Depth>);
}

#[test]
fn altered_json_of_the_2d_engine_is_refused_or_can_be_used() {
    refused_or_used(altered_json::<Plane>);
}

#[test]
fn altered_json_of_the_2_5d_engine_is_refused_or_can_be_used() {
    refused_or_used(altered_json::<Depth>);
}

fn refused_or_used(check: impl Fn(u64) -> Result<SaveOutcome, String>) {
    let failures = failures(0..SEEDS, |seed| check(seed).map(drop));
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn some_altered_saves_are_refused_and_some_are_used() {
    assert!(both_fates::<Plane>() && both_fates::<Depth>());
}

fn both_fates<G: Game>() -> bool {
    let fates: Vec<SaveOutcome> = (0..SEEDS).filter_map(|seed| altered_snapshot::<G>(seed).ok()).collect();
    fates.contains(&SaveOutcome::Refused) && fates.contains(&SaveOutcome::Used)
}
