//! Tests random joint scenes with fixed seeds.

use fuzz::figures::figures_go_on_as_restored;
use fuzz::long_run::failures;

#[test]
fn figures_of_any_joints_continue_equally_after_a_restore() {
    let failures = failures(0..8, figures_go_on_as_restored);
    assert!(failures.is_empty(), "{failures:#?}");
}
