//! Films and tables, which need no window.

use gallery::film::{Film, picture};
use gallery::{Layers, bench, hashes};
use twohalf_render::Texture2D;

use crate::scenes::scene;

fn film(name: &str) -> Film {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    Film { seconds: 0.5, out: folder.join(format!("{name}.png")), largest: 200, layers: Layers::default() }
}

#[test]
fn a_film_is_an_animation_and_a_page_of_stills() {
    let mut told = Vec::new();
    let filmed = film("a_film").film(&scene("column_20"), |done, all| told.push((done, all))).unwrap();
    assert_eq!(filmed.frames, 10, "half a second at 20 frames per second");
    assert_eq!(told.last(), Some(&(10, 10)));
    let first = Texture2D::load_png(&filmed.animation).unwrap();
    assert_eq!(first.width().max(first.height()), 200);
    // Nine stills in three columns, and margins round them.
    let stills = Texture2D::load_png(&filmed.stills).unwrap();
    assert!(stills.width() > 3 * first.width() && stills.height() > 3 * first.height());
}

#[test]
fn films_of_no_length_or_of_no_size_are_refused() {
    for seconds in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert!(
            Film { seconds, ..film("refused") }.film(&scene("column_20"), |_, _| ()).is_err(),
            "{seconds}"
        );
    }
    assert!(Film { largest: 0, ..film("refused") }.film(&scene("column_20"), |_, _| ()).is_err());
}

#[test]
fn a_picture_of_every_kind_of_scene_is_not_blank() {
    for name in ["demo_scene_2", "brawler", "pinball", "pyramid", "crowd_1000", "farseer_water"] {
        let canvas = picture(&scene(name), 0.0, 160).unwrap();
        let mut colors: Vec<[u8; 4]> = canvas.rgba8().as_chunks::<4>().0.to_vec();
        colors.sort_unstable();
        colors.dedup();
        assert!(colors.len() > 20, "{name}: {} colours", colors.len());
    }
}

#[test]
fn hashes_are_the_same_whenever_they_are_made_and_differ_by_set() {
    let [first, second] = [0, 1].map(|_| hashes::of(&scene("column_20")).unwrap());
    assert_eq!(first, second);
    assert_eq!(
        first.iter().map(|hashed| (hashed.engine, hashed.set)).collect::<Vec<_>>(),
        [("2D", "faithful"), ("2D", "precise")]
    );
    assert_ne!(first[0].hash, first[1].hash);
}

#[test]
fn timings_are_reported_with_the_number_of_bodies() {
    let figures = bench::bench(&scene("column_20"), 0.1).unwrap();
    // Twenty boxes and a floor, twice.
    assert_eq!((figures.name.as_str(), figures.bodies), ("column_20", 42));
    assert!(figures.step > 0.0 && figures.picture > 0.0);
}
