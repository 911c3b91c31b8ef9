//! Where the shadows of bodies lie, how large they are and where they end.

use crate::canvases::{RED, drawn, picture, pixels, plain};
use conformance::fixtures::depth::{ball, solid};
use twohalf::{BodyId, GeomId, Platform, TextureId, TwoHalfPhysicsSimulator, Vector3};
use twohalf_factories::{Cylinder, spawn};
use twohalf_render::{Color, DrawBody, Point, SpriteBatch, TextureStore, shadow_scale};

/// A simulator, a ball of radius 20 with a shadow of 40 x 40 px, and the pictures.
struct Scene {
    simulator: TwoHalfPhysicsSimulator,
    body: BodyId,
    geom: GeomId,
    textures: TextureStore,
}

impl Scene {
    /// A ball with its lowest point at a position. `angle` in degrees.
    fn new(angle: i32, place: [f32; 3]) -> Self {
        let mut simulator = TwoHalfPhysicsSimulator::with_angle(600, angle).unwrap();
        let body = ball(&mut simulator, 20.0, place);
        let mut textures = TextureStore::default();
        let image = textures.add(plain(40, 40, RED));
        let mut view = simulator.body_mut(body).unwrap();
        let geom = view.ground().object_geom().unwrap();
        view.ground_mut().set_object_geom(geom, Some(image)).unwrap();
        Scene { simulator, body, geom, textures }
    }

    /// As [`Scene::new`] at 45 degrees, above a box from (150, 30, 70) to (250, 50, 130).
    fn with_platform(place: [f32; 3]) -> Self {
        let mut scene = Scene::new(45, place);
        Platform::new(&mut scene.simulator, 100.0, 20.0, 60.0, Vector3::new(200.0, 30.0, 100.0), None)
            .unwrap();
        scene
    }

    fn batch(&self, position_offset: Point, scale: Point, is_resizable: bool) -> SpriteBatch {
        let Scene { simulator, body, geom, textures } = self;
        let mut batch = SpriteBatch::begin();
        let tint = Color::WHITE;
        simulator.draw_shadow(
            &mut batch,
            textures,
            *body,
            *geom,
            position_offset,
            scale,
            tint,
            1.0,
            is_resizable,
        );
        batch
    }

    fn shadow(&self, is_resizable: bool) -> Option<[u32; 4]> {
        drawn(self.batch([0.0; 2], [1.0; 2], is_resizable))
    }

    /// Asserts that the shadow covers just the pixels whose middles pass a test. `distance` returns how far a point is inside
    /// of the shadow, px; pixels at its very edge are partly covered and skipped.
    fn assert_covers(&self, distance: impl Fn([f32; 2]) -> f32) {
        let canvas = picture(self.batch([0.0; 2], [1.0; 2], false));
        let mut inside = 0;
        for ([x, y], middle) in pixels() {
            let distance = distance(middle);
            if distance.abs() >= 1.0 {
                let expected = if distance > 0.0 { RED } else { Color::TRANSPARENT };
                assert_eq!(canvas.pixel(x, y), Some(expected), "({x}, {y})");
                inside += u32::from(distance > 0.0);
            }
        }
        assert!(inside > 100, "a shadow is there");
    }
}

#[test]
fn the_shadow_of_a_resting_ball_lies_about_the_point_where_it_touches() {
    assert_eq!(Scene::new(45, [100.0, 0.0, 50.0]).shadow(true), Some([130, 530, 170, 570]));
}

#[test]
fn the_shadow_of_a_flying_ball_stays_on_the_ground_below_it_and_shrinks_by_the_law() {
    // At the height of its own width.
    assert_eq!(shadow_scale(40.0, 40.0), 0.65);
    let expected = Some([150 - 13, 550 - 13, 150 + 13, 550 + 13]);
    assert_eq!(Scene::new(45, [100.0, 40.0, 50.0]).shadow(true), expected);
}

#[test]
fn a_shadow_that_is_not_resizable_keeps_its_size() {
    assert_eq!(Scene::new(45, [100.0, 40.0, 50.0]).shadow(false), Some([130, 530, 170, 570]));
}

#[test]
fn a_shadow_is_moved_by_its_offset_and_scaled_by_its_scale() {
    let batch = Scene::new(45, [100.0, 0.0, 50.0]).batch([10.0, -6.0], [2.0, 0.5], true);
    assert_eq!(drawn(batch), Some([120, 534, 200, 554]));
}

#[test]
fn above_a_platform_the_shadow_lies_on_its_top() {
    // The point (200, 50, 100).
    let expected = Some([300 - 20, 450 - 20, 300 + 20, 450 + 20]);
    assert_eq!(Scene::with_platform([200.0, 50.0, 100.0]).shadow(true), expected);
}

#[test]
fn the_height_over_a_platform_counts_from_its_top() {
    let expected = Some([300 - 13, 450 - 13, 300 + 13, 450 + 13]);
    assert_eq!(Scene::with_platform([200.0, 50.0 + 40.0, 100.0]).shadow(true), expected);
}

#[test]
fn beneath_a_platform_the_shadow_lies_on_the_ground() {
    // The middle is below the platform's top.
    let expected = Some([300 - 20, 500 - 20, 300 + 20, 500 + 20]);
    assert_eq!(Scene::with_platform([200.0, 0.0, 100.0]).shadow(false), expected);
}

#[test]
fn a_middle_beyond_the_edge_of_a_platform_puts_the_shadow_on_the_ground() {
    // The left half of the ball is still above the platform.
    let expected = Some([351 - 20, 500 - 20, 351 + 20, 500 + 20]);
    assert_eq!(Scene::with_platform([251.0, 80.0, 100.0]).shadow(false), expected);
}

#[test]
fn a_shadow_ends_at_the_front_edge_of_a_platform() {
    // Z = 70 appears 600 - 50 - 70 px down.
    let expected = Some([275 - 20, 475 - 20, 275 + 20, 480]);
    assert_eq!(Scene::with_platform([200.0, 50.0, 75.0]).shadow(false), expected);
}

#[test]
fn a_shadow_ends_at_the_slanting_right_edge_of_a_platform() {
    // The edge goes from (320, 480) to (380, 420).
    let to_edge = |[x, y]: Point| (800.0 - x - y) / std::f32::consts::SQRT_2;
    let to_side = |[x, y]: Point| 20.0 - (x - 345.0).abs().max((y - 450.0).abs());
    Scene::with_platform([245.0, 50.0, 100.0]).assert_covers(|point| to_side(point).min(to_edge(point)));
}

#[test]
fn a_shadow_ends_at_the_edge_of_the_top_of_a_crate() {
    // A crate as large as the box that is a platform elsewhere, and a cylinder.
    let mut scene = Scene::new(45, [245.0, 50.0, 100.0]);
    solid(&mut scene.simulator, [100.0, 50.0, 60.0], [200.0, 0.0, 100.0]);
    scene.simulator.update(0.0);
    let to_edge = |[x, y]: Point| (800.0 - x - y) / std::f32::consts::SQRT_2;
    let to_side = |[x, y]: Point| 20.0 - (x - 345.0).abs().max((y - 450.0).abs());
    scene.assert_covers(|point| to_side(point).min(to_edge(point)));
    let mut scene = Scene::new(90, [110.0, 50.0, 100.0]);
    let thing = Cylinder::new(25.0, 50.0).at([100.0, 0.0, 100.0]);
    spawn(&mut scene.simulator, thing).unwrap();
    scene.simulator.update(0.0);
    // A rim of 24 corners is nowhere more than 0.3 px inside of its circle.
    let to_rim = |[x, y]: Point| 24.85 - (x - 100.0).hypot(y - 450.0);
    let to_side = |[x, y]: Point| 20.0 - (x - 110.0).abs().max((y - 450.0).abs());
    scene.assert_covers(|point| to_side(point).min(to_rim(point)));
}

#[test]
fn on_a_slope_the_shadow_goes_down_with_it() {
    let mut scene = Scene::new(90, [200.0, 120.0, 100.0]);
    let [rotation, height] = [0.5_f32, 20.0];
    let middle = Vector3::new(200.0, 30.0, 100.0);
    Platform::with_rotation(&mut scene.simulator, 200.0, height, 90.0, middle, rotation, None).unwrap();
    // The top above the middle of the box.
    let top = 40.0 + 0.5 * height / rotation.cos();
    scene.assert_covers(|[x, y]| {
        let across = 20.0 - (x - 200.0).abs();
        let down = 20.0 - (y - (500.0 - top) - rotation.tan() * (x - 200.0)).abs();
        across.min(down * rotation.cos())
    });
}

#[test]
fn on_a_slope_with_an_angle_of_its_own_every_point_of_the_shadow_lies_on_the_surface() {
    let mut scene = Scene::new(60, [200.0, 160.0, 100.0]);
    let middle = Vector3::new(210.0, 60.0, 110.0);
    Platform::with_rotation_and_angle(&mut scene.simulator, 240.0, 20.0, 120.0, middle, -0.3, None, 120)
        .unwrap();
    let canvas = picture(scene.batch([0.0; 2], [1.0; 2], false));
    let simulator = &scene.simulator;
    let below = simulator.projection().to_screen(Vector3::new(200.0, 0.0, 100.0));
    for index in 0..15 * 15 {
        // Offsets on the screen, on level ground: the shadow reaches 20 px to each side.
        let [dx, dy] = [index % 15, index / 15].map(|n| 3.5 * (n as f32 - 7.0));
        let mut point = simulator.screen_to_ground(twohalf::Vector2::new(below.x + dx, below.y + dy));
        point.y = simulator.surface_beneath(Vector3::new(point.x, 160.0, point.z)).unwrap().height;
        let on_screen = simulator.projection().to_screen(point);
        let is_inside = dx.abs().max(dy.abs()) < 20.0;
        let expected = if is_inside { RED } else { Color::TRANSPARENT };
        let pixel = canvas.pixel(on_screen.x as u32, on_screen.y as u32);
        assert_eq!(pixel, Some(expected), "({dx}, {dy})");
    }
}

#[test]
fn below_the_ground_there_is_no_shadow() {
    assert_eq!(Scene::new(45, [100.0, -60.0, 50.0]).shadow(false), None);
}

#[test]
fn without_an_image_there_is_no_shadow() {
    let mut scene = Scene::new(45, [100.0, 0.0, 50.0]);
    let mut view = scene.simulator.body_mut(scene.body).unwrap();
    view.ground_mut().set_object_geom(scene.geom, None).unwrap();
    assert_eq!(scene.shadow(false), None);
}

#[test]
fn an_image_that_the_store_does_not_have_gives_no_shadow() {
    let mut scene = Scene::new(45, [100.0, 0.0, 50.0]);
    let mut view = scene.simulator.body_mut(scene.body).unwrap();
    let other = TextureId { id: 7, width: 40, height: 40 };
    view.ground_mut().set_object_geom(scene.geom, Some(other)).unwrap();
    assert_eq!(scene.shadow(false), None);
}

#[test]
fn the_geom_of_another_body_gives_no_shadow() {
    let mut scene = Scene::new(45, [100.0, 0.0, 50.0]);
    let other = ball(&mut scene.simulator, 10.0, [200.0, 0.0, 50.0]);
    scene.geom = scene.simulator.body(other).unwrap().ground().object_geom().unwrap();
    assert_eq!(scene.shadow(false), None);
}

#[test]
fn a_disposed_body_has_no_shadow() {
    let mut scene = Scene::new(45, [100.0, 0.0, 50.0]);
    scene.simulator.dispose(scene.body).unwrap();
    scene.simulator.update(0.0);
    assert_eq!(scene.shadow(false), None);
}

#[test]
fn an_id_of_another_store_finds_nothing() {
    let mut textures = TextureStore::default();
    let id = textures.add(plain(40, 40, RED));
    assert!(textures.get(id).is_some());
    assert!(textures.get(TextureId { id: 1, ..id }).is_none());
    assert!(textures.get(TextureId { width: 41, ..id }).is_none());
}
