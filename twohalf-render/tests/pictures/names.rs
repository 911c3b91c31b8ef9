//! JPEG, and pictures by name.

use std::path::Path;

use twohalf_render::*;

const HALVES: &[u8] = include_bytes!("two_halves.jpg");

#[test]
fn a_jpeg_picture_shows_what_was_put_into_it() {
    let texture = Texture2D::decode(HALVES).unwrap();
    assert_eq!((texture.width(), texture.height()), (16, 8));
    for (x, [r, g, b]) in [(2, [220, 30, 40]), (13, [30, 60, 210])] {
        let c = texture.pixel(x, 4).unwrap();
        // The format rounds colours; measured is at most 2.
        assert!(c.r.abs_diff(r) <= 4 && c.g.abs_diff(g) <= 4 && c.b.abs_diff(b) <= 4 && c.a == 255, "{c:?}");
    }
}

#[test]
fn a_jpeg_picture_that_is_damaged_is_refused_or_shown_but_does_not_panic() {
    for length in 0..HALVES.len() {
        let _ = Texture2D::decode(&HALVES[..length]);
        for bit in 0..8 {
            let mut altered = HALVES.to_vec();
            altered[length] ^= 1 << bit;
            let _ = Texture2D::decode(&altered);
        }
    }
    assert!(matches!(Texture2D::decode(&HALVES[..40]), Err(RenderError::DecodeJpeg { .. })));
}

fn pictures() -> TextureStore {
    TextureStore::in_folder(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/pictures"))
}

#[test]
fn a_name_needs_no_ending_and_is_read_once() {
    let mut textures = pictures();
    let id = textures.load("two_halves").unwrap();
    assert_eq!((id.width, id.height), (16, 8));
    assert_eq!(textures.load("two_halves").unwrap(), id);
    assert!(textures.missing().is_empty());
}

#[test]
fn a_missing_picture_is_refused_by_name_or_stood_in_for_visibly() {
    let mut textures = pictures();
    let error = textures.load("hero").unwrap_err();
    assert!(error.to_string().contains("hero"), "{error}");
    let id = textures.load_or_stand_in("hero");
    let seen = textures.get(id).unwrap();
    assert_eq!(seen.pixel(0, 0), Some(Color::rgb(255, 0, 255)));
    assert_eq!(seen.pixel(8, 0), Some(Color::BLACK));
    assert_eq!(textures.load_or_stand_in("hero"), id);
    assert_eq!(textures.missing().len(), 1);
    assert!(textures.missing()[0].starts_with("hero: "));
}
