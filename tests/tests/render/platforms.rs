//! Platforms in plain colours, and their shadows.

use crate::canvases::{
    BLUE, FACES, GRAY, GREEN, RED, YELLOW, drawn, picture, pixels, plain, platform_picture,
};
use twohalf::{Platform, PlatformId, TextureId, TwoHalfPhysicsSimulator, Vector3};
use twohalf_render::{Color, DrawPlatform, PlatformLook, Point, SpriteBatch, TextureStore};

/// A box from (150, 30, 70) to (250, 50, 130), tilted by `rotation` about its middle.
fn scene(angle: i32, rotation: f32) -> (TwoHalfPhysicsSimulator, PlatformId) {
    let mut simulator = TwoHalfPhysicsSimulator::with_angle(600, angle).unwrap();
    let middle = Vector3::new(200.0, 30.0, 100.0);
    let id = Platform::with_rotation(&mut simulator, 100.0, 20.0, 60.0, middle, rotation, None).unwrap();
    (simulator, id)
}

/// The colour where a point of the world appears.
fn color_at(simulator: &TwoHalfPhysicsSimulator, id: PlatformId, point: [f32; 3]) -> Option<Color> {
    let on_screen = simulator.projection().to_screen(Vector3::from(point));
    platform_picture(simulator, id).pixel(on_screen.x as u32, on_screen.y as u32)
}

#[test]
fn the_front_and_top_of_a_level_platform_are_visible() {
    for angle in [45, 90, 120] {
        let (simulator, id) = scene(angle, 0.0);
        assert_eq!(color_at(&simulator, id, [200.0, 40.0, 70.0]), Some(BLUE), "front at {angle} degrees");
        assert_eq!(color_at(&simulator, id, [200.0, 50.0, 100.0]), Some(GREEN), "top at {angle} degrees");
    }
}

#[test]
fn the_side_towards_which_the_z_axis_leans_is_visible() {
    let (simulator, id) = scene(45, 0.0);
    assert_eq!(color_at(&simulator, id, [250.0, 40.0, 100.0]), Some(YELLOW));
    let (simulator, id) = scene(135, 0.0);
    assert_eq!(color_at(&simulator, id, [150.0, 40.0, 100.0]), Some(YELLOW));
}

#[test]
fn straight_from_the_front_a_level_platform_is_two_rectangles() {
    let (simulator, id) = scene(90, 0.0);
    let canvas = platform_picture(&simulator, id);
    for ([x, y], _) in pixels() {
        let expected = match (x, y) {
            (150..250, 420..480) => GREEN,
            (150..250, 480..500) => BLUE,
            _ => Color::TRANSPARENT,
        };
        assert_eq!(canvas.pixel(x, y), Some(expected), "({x}, {y})");
    }
}

#[test]
fn the_part_of_a_platform_below_the_ground_is_not_drawn() {
    let (mut simulator, id) = scene(90, 0.0);
    let mut sink = |height: f32| {
        let place = Vector3::new(200.0, height, 100.0);
        simulator.platform_mut(id).unwrap().set_position3d(place).unwrap();
        platform_picture(&simulator, id)
    };
    // Its front stands on the ground at Z = 70, and is 8 px high.
    let canvas = sink(-12.0);
    assert_eq!(
        [521, 523, 529, 531].map(|y| canvas.pixel(200, y).unwrap()),
        [GREEN, BLUE, BLUE, Color::TRANSPARENT]
    );
    let canvas = sink(-21.0);
    assert!(pixels().all(|([x, y], _)| canvas.pixel(x, y) == Some(Color::TRANSPARENT)));
}

#[test]
fn a_slope_that_ends_below_the_ground_is_drawn_up_to_its_foot() {
    let (mut simulator, id) = scene(90, 0.5);
    simulator.platform_mut(id).unwrap().set_position3d(Vector3::new(200.0, 0.0, 100.0)).unwrap();
    // Its top goes through (200 + 10 sin 0.5, 10 + 10 cos 0.5), and falls by tan 0.5 per px: to the ground at 239.1.
    assert_eq!(color_at(&simulator, id, [236.0, 0.0, 100.0]), Some(GREEN));
    assert_eq!(color_at(&simulator, id, [242.0, 0.0, 100.0]), Some(Color::TRANSPARENT));
    // The front is cut off level with the ground.
    assert_eq!(color_at(&simulator, id, [200.0, 2.0, 70.0]), Some(BLUE));
    assert_eq!(color_at(&simulator, id, [200.0, -2.0, 70.0]), Some(Color::TRANSPARENT));
}

#[test]
fn a_platform_that_is_upside_down_shows_its_underside() {
    let (simulator, id) = scene(90, std::f32::consts::PI);
    assert_eq!(color_at(&simulator, id, [200.0, 50.0, 100.0]), Some(GRAY));
}

#[test]
fn edges_are_drawn_over_the_faces() {
    let (simulator, id) = scene(90, 0.0);
    let mut batch = SpriteBatch::begin();
    simulator.draw_platform(&mut batch, id, &PlatformLook { edges: RED, edge_width: 4.0, ..FACES }, 0.5);
    let canvas = picture(batch);
    // The edge between top and front, and the left one.
    for (x, y) in [(200, 478), (200, 481), (149, 450), (150, 490)] {
        assert_eq!(canvas.pixel(x, y), Some(RED), "({x}, {y})");
    }
    assert_eq!(canvas.pixel(200, 475), Some(GREEN));
    assert_eq!(canvas.pixel(200, 484), Some(BLUE));
}

#[test]
fn a_disposed_platform_draws_nothing() {
    let (mut simulator, id) = scene(90, 0.0);
    simulator.remove_platform(id).unwrap();
    let mut batch = SpriteBatch::begin();
    simulator.draw_platform(&mut batch, id, &FACES, 0.5);
    assert_eq!(drawn(batch), None);
}

/// Adds a platform with a shadow of 100 x 60 px: width and depth of the platform.
fn with_shadow(
    simulator: &mut TwoHalfPhysicsSimulator,
    textures: &mut TextureStore,
    place: [f32; 3],
) -> PlatformId {
    let image = textures.add(plain(100, 60, RED));
    Platform::new(simulator, 100.0, 20.0, 60.0, Vector3::from(place), Some(image)).unwrap()
}

fn shadow(
    simulator: &TwoHalfPhysicsSimulator,
    textures: &TextureStore,
    id: PlatformId,
    is_resizable: bool,
) -> Option<[u32; 4]> {
    let mut batch = SpriteBatch::begin();
    let [offset, scale]: [Point; 2] = [[0.0; 2], [1.0; 2]];
    simulator.draw_platform_shadow(&mut batch, textures, id, offset, scale, Color::WHITE, 1.0, is_resizable);
    drawn(batch)
}

#[test]
fn the_shadow_of_a_raised_platform_lies_on_the_ground_below_its_middle() {
    let mut simulator = TwoHalfPhysicsSimulator::new(600).unwrap();
    let mut textures = TextureStore::default();
    let id = with_shadow(&mut simulator, &mut textures, [200.0, 100.0, 130.0]);
    assert_eq!(shadow(&simulator, &textures, id, false), Some([150, 440, 250, 500]));
}

#[test]
fn the_resizable_shadow_of_a_platform_shrinks_with_the_height_of_its_lowest_corner() {
    let mut simulator = TwoHalfPhysicsSimulator::new(600).unwrap();
    let mut textures = TextureStore::default();
    // At the height of its own width 0.65 of it remain: 65 x 39 px, about (200.5, 470.5).
    let id = with_shadow(&mut simulator, &mut textures, [200.5, 100.0, 129.5]);
    assert_eq!(shadow(&simulator, &textures, id, true), Some([168, 451, 233, 490]));
}

#[test]
fn the_shadow_of_a_platform_above_another_one_lies_on_that_and_ends_with_it() {
    let mut simulator = TwoHalfPhysicsSimulator::new(600).unwrap();
    let mut textures = TextureStore::default();
    Platform::new(&mut simulator, 100.0, 50.0, 60.0, Vector3::new(160.0, 0.0, 100.0), None).unwrap();
    let id = with_shadow(&mut simulator, &mut textures, [200.0, 80.0, 120.0]);
    // The lower one ends at X = 210 and at Z = 130, the shadow begins at X = 150 and at Z = 90.
    assert_eq!(shadow(&simulator, &textures, id, false), Some([150, 600 - 50 - 130, 210, 600 - 50 - 90]));
}

#[test]
fn a_platform_on_the_ground_has_its_shadow_there() {
    let mut simulator = TwoHalfPhysicsSimulator::new(600).unwrap();
    let mut textures = TextureStore::default();
    let id = with_shadow(&mut simulator, &mut textures, [200.0, 0.0, 130.0]);
    assert_eq!(shadow(&simulator, &textures, id, true), Some([150, 440, 250, 500]));
}

#[test]
fn a_platform_without_an_image_has_no_shadow() {
    let (simulator, id) = scene(90, 0.0);
    assert_eq!(shadow(&simulator, &TextureStore::default(), id, false), None);
    let unknown = Some(TextureId { id: 0, width: 10, height: 10 });
    let mut simulator = TwoHalfPhysicsSimulator::new(600).unwrap();
    let id = Platform::new(&mut simulator, 10.0, 10.0, 10.0, Vector3::zeros(), unknown).unwrap();
    assert_eq!(shadow(&simulator, &TextureStore::default(), id, false), None);
}
