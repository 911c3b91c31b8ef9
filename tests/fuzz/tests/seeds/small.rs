//! Small scenes of the precise set.

use fuzz::long_run::failures;
use fuzz::small::small_scene_holds;

#[test]
fn small_scenes_keep_their_bodies_their_momentum_and_their_energy() {
    let failures = failures(0..400, small_scene_holds);
    assert!(failures.is_empty(), "{failures:#?}");
}
