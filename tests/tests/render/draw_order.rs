//! Which of two overlapping objects is visible in the simulator's drawing order: hand-made cases.

use crate::canvases::{BLUE, FACES, GREEN, RED, YELLOW, canvas, plain};
use conformance::fixtures::depth::{ball, crate_box};
use twohalf::{BodyId, Drawable, Platform, TwoHalfPhysicsSimulator, Vector3};
use twohalf_render::{Color, DrawBody, DrawPlatform, SoftwareCanvas, SpriteBatch};

/// Balls and boxes of 40 x 40 px as squares of one colour; platforms green above, blue in front.
struct Scene {
    simulator: TwoHalfPhysicsSimulator,
    colors: Vec<(BodyId, Color)>,
}

impl Scene {
    /// Depth goes straight up.
    fn new() -> Self {
        Scene::with_angle(90)
    }

    fn with_angle(angle: i32) -> Self {
        let simulator = TwoHalfPhysicsSimulator::with_angle(600, angle).unwrap();
        Scene { simulator, colors: Vec::new() }
    }

    fn ball(mut self, color: Color, place: [f32; 3]) -> Self {
        let body = ball(&mut self.simulator, 20.0, place);
        self.colors.push((body, color));
        self
    }

    fn crate_box(mut self, color: Color, place: [f32; 3]) -> Self {
        let body = crate_box(&mut self.simulator, [40.0, 40.0], place);
        self.colors.push((body, color));
        self
    }

    /// A platform of 100 px width.
    fn platform(mut self, height: f32, depth: f32, place: [f32; 3], rotation: f32) -> Self {
        let place = Vector3::from(place);
        Platform::with_rotation(&mut self.simulator, 100.0, height, depth, place, rotation, None).unwrap();
        self
    }

    fn draw(mut self) -> SoftwareCanvas {
        self.simulator.update(0.0);
        let mut batch = SpriteBatch::begin();
        for drawable in self.simulator.draw_order() {
            match drawable {
                Drawable::Platform(id) => self.simulator.draw_platform(&mut batch, id, &FACES, 0.5),
                Drawable::Body(id) => {
                    let color = self.colors.iter().find(|(body, _)| *body == id).unwrap().1;
                    self.simulator.draw_body(&mut batch, id, &plain(40, 40, color), 0.5);
                }
            }
        }
        let mut canvas = canvas();
        batch.end(&mut canvas);
        canvas
    }

    /// The colour at the position of a point of the world.
    fn seen_at(self, point: [f32; 3]) -> Option<Color> {
        let on_screen = self.simulator.projection().to_screen(Vector3::from(point));
        self.draw().pixel(on_screen.x as u32, on_screen.y as u32)
    }
}

#[test]
fn the_nearer_of_two_balls_is_in_front_whichever_was_added_first() {
    let (near, far) = ([200.0, 0.0, 100.0], [200.0, 0.0, 120.0]);
    // A point of the nearer one's upper half covers the farther one's lower half.
    let covered = [200.0, 30.0, 100.0];
    assert_eq!(Scene::new().ball(RED, near).ball(YELLOW, far).seen_at(covered), Some(RED));
    assert_eq!(Scene::new().ball(YELLOW, far).ball(RED, near).seen_at(covered), Some(RED));
}

#[test]
fn a_high_ball_far_behind_is_covered_by_a_low_one_in_front() {
    let scene = Scene::new().ball(RED, [200.0, 50.0, 100.0]).ball(YELLOW, [200.0, 0.0, 160.0]);
    assert_eq!(scene.seen_at([200.0, 72.0, 100.0]), Some(RED));
}

#[test]
fn of_two_boxes_at_one_depth_the_upper_one_is_in_front() {
    // A pile that has sunk in by a px.
    let scene = Scene::new().crate_box(RED, [200.0, 39.0, 100.0]).crate_box(YELLOW, [205.0, 0.0, 100.0]);
    assert_eq!(scene.seen_at([200.0, 39.5, 100.0]), Some(RED));
}

#[test]
fn a_ball_on_a_platform_is_in_front_of_it() {
    for z in [75.0, 100.0, 125.0] {
        let scene = Scene::new().ball(RED, [200.0, 80.0, z]).platform(30.0, 60.0, [200.0, 50.0, 100.0], 0.0);
        assert_eq!(scene.seen_at([200.0, 81.0, z]), Some(RED), "at depth {z}");
    }
}

#[test]
fn a_ball_behind_a_platform_is_covered_by_it() {
    let scene = Scene::new().ball(RED, [200.0, 0.0, 155.0]).platform(80.0, 60.0, [200.0, 0.0, 100.0], 0.0);
    assert_eq!(scene.seen_at([200.0, 2.0, 155.0]), Some(GREEN));
}

#[test]
fn a_ball_in_front_of_a_platform_covers_it() {
    let scene = Scene::new().ball(RED, [200.0, 0.0, 45.0]).platform(80.0, 60.0, [200.0, 0.0, 100.0], 0.0);
    assert_eq!(scene.seen_at([200.0, 39.0, 45.0]), Some(RED));
}

#[test]
fn a_ball_under_a_raised_platform_is_covered_by_it() {
    let scene = Scene::new().ball(RED, [200.0, 0.0, 120.0]).platform(30.0, 60.0, [200.0, 45.0, 100.0], 0.0);
    // The front face reaches from 115 to 145 px above the lower edge of the screen.
    assert_eq!(scene.seen_at([200.0, 10.0, 120.0]), Some(BLUE));
}

#[test]
fn a_ball_on_a_slope_is_in_front_of_it_and_one_under_it_is_not() {
    // The slope goes down to the right, from about 118 to 42 px over the ground, and is 30 px thick.
    let slope = |scene: Scene| scene.platform(30.0, 60.0, [200.0, 65.0, 100.0], 0.4);
    let on = slope(Scene::new().ball(RED, [230.0, 86.0, 100.0]));
    assert_eq!(on.seen_at([230.0, 88.0, 100.0]), Some(RED));
    let under = slope(Scene::new().ball(RED, [180.0, 5.0, 120.0]));
    assert_ne!(under.seen_at([180.0, 42.0, 120.0]), Some(RED));
}

#[test]
fn a_slope_sunk_in_the_ground_covers_objects_under_its_raised_end() {
    let scene = Scene::new().ball(RED, [165.0, 0.0, 115.0]).platform(16.0, 60.0, [200.0, 22.0, 100.0], 0.6);
    // There the front face appears from 114 to 134 px above the lower edge of the screen.
    assert_eq!(scene.seen_at([165.0, 2.0, 115.0]), Some(BLUE));
}

#[test]
fn beside_a_platform_the_z_axis_decides_which_object_is_in_front() {
    // At 45 degrees right sides are visible: an object to the right covers the box, an object to the left is covered by it, for
    // all depths of their middles.
    let scene = |x: f32, z: f32| {
        Scene::with_angle(45).ball(RED, [x, 0.0, z]).platform(60.0, 100.0, [200.0, 0.0, 100.0], 0.0)
    };
    for z in [80.0, 120.0] {
        // The ball's picture reaches 20 px to either side of its middle, the box from X = 150 to 250.
        let right = scene(272.0, z);
        assert_eq!(right.seen_at([255.0, 30.0, z]), Some(RED), "right, at depth {z}");
        let left = scene(128.0, z);
        assert_ne!(left.seen_at([146.0, 20.0, z]), Some(RED), "left, at depth {z}");
    }
}

#[test]
fn a_platform_on_a_platform_is_in_front_of_it() {
    let scene =
        |[a, b]: [[f32; 3]; 2]| Scene::new().platform(30.0, 60.0, a, 0.0).platform(30.0, 60.0, b, 0.0);
    let (low, high) = ([200.0, 0.0, 100.0], [200.0, 30.0, 110.0]);
    // The lower front of the upper one covers the top of the lower one.
    assert_eq!(scene([low, high]).seen_at([200.0, 32.0, 80.0]), Some(BLUE));
    assert_eq!(scene([high, low]).seen_at([200.0, 32.0, 80.0]), Some(BLUE));
}
