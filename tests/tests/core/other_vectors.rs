//! Vectors of other crates.

use farseer_core::math::Vector2;

#[test]
fn vectors_of_glam_come_and_go_with_the_same_bits() {
    let (x, y) = (0.1_f32, -1e-42_f32);
    let vector: Vector2 = glam::Vec2::new(x, y).into();
    assert_eq!([vector.x.to_bits(), vector.y.to_bits()], [x.to_bits(), y.to_bits()]);
    let back: glam::Vec2 = vector.into();
    assert_eq!([back.x.to_bits(), back.y.to_bits()], [x.to_bits(), y.to_bits()]);
}

#[test]
fn vectors_of_mint_come_and_go_with_the_same_bits() {
    let (x, y) = (0.1_f32, -1e-42_f32);
    let vector: Vector2 = mint::Vector2 { x, y }.into();
    assert_eq!([vector.x.to_bits(), vector.y.to_bits()], [x.to_bits(), y.to_bits()]);
    let back: mint::Vector2<f32> = vector.into();
    assert_eq!([back.x.to_bits(), back.y.to_bits()], [x.to_bits(), y.to_bits()]);
}
