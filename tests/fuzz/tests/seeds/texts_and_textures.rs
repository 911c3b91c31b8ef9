//! Tests random scene texts and random pictures.

use conformance::scene::Scene;
use fuzz::long_run::failures;
use fuzz::scene_texts::{altered_scene, garbage};
use fuzz::textures::outlines_of_a_picture;

#[test]
fn an_altered_scene_is_refused_or_makes_steps() {
    let failures = failures(0..300, altered_scene);
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn a_text_that_is_no_scene_is_an_error() {
    let accepted: Vec<String> =
        (0..1000).map(garbage).filter(|text| Scene::from_json("garbage", text).is_ok()).collect();
    assert!(accepted.is_empty(), "{accepted:#?}");
}

#[test]
fn every_picture_has_finite_outlines_or_an_error() {
    let failures = failures(0..3000, outlines_of_a_picture);
    assert!(failures.is_empty(), "{failures:#?}");
}
