//! Drawings of the debug view, part by part.

use crate::canvases::{BLUE, GREEN, RED, YELLOW, canvas, pixels};
use conformance::fixtures::depth::{self, DT, ball, crate_box};
use twohalf::{DepthProfile, Platform, TwoHalfPhysicsSimulator, Vector3};
use twohalf_render::{Canvas, Color, DebugView, Point, SoftwareCanvas, Texture2D, Transform};

/// A view with all layers off, and lines of 4 px, so that a line covers complete pixels in every direction.
fn nothing() -> DebugView {
    DebugView {
        enable_ground_view: false,
        enable_virtual_geom_view: false,
        enable_platform_view: false,
        enable_edge_view: false,
        enable_vertice_view: false,
        enable_coordinate_axis_view: false,
        enable_contact_view: false,
        line_thickness: 4.0,
        ..DebugView::default()
    }
}

fn simulator() -> TwoHalfPhysicsSimulator {
    TwoHalfPhysicsSimulator::with_angle(600, 45).unwrap()
}

fn draw(simulator: &TwoHalfPhysicsSimulator, view: &DebugView) -> SoftwareCanvas {
    let mut canvas = canvas();
    view.draw(simulator, &mut canvas);
    canvas
}

/// The colour where a point of the world appears.
fn color_at(simulator: &TwoHalfPhysicsSimulator, canvas: &SoftwareCanvas, point: [f32; 3]) -> Option<Color> {
    let on_screen = simulator.projection().to_screen(Vector3::from(point));
    canvas.pixel(on_screen.x as u32, on_screen.y as u32)
}

#[test]
fn with_everything_off_nothing_is_drawn() {
    let mut simulator = simulator();
    ball(&mut simulator, 20.0, [100.0, 0.0, 50.0]);
    Platform::new(&mut simulator, 100.0, 20.0, 60.0, Vector3::new(300.0, 30.0, 100.0), None).unwrap();
    simulator.update(0.0);
    let canvas = draw(&simulator, &nothing());
    assert!(pixels().all(|([x, y], _)| canvas.pixel(x, y) == Some(Color::TRANSPARENT)));
}

#[test]
fn the_ground_is_a_line_below_a_body_as_wide_as_its_object_geom() {
    let mut simulator = simulator();
    ball(&mut simulator, 20.0, [100.0, 40.0, 50.0]);
    simulator.update(0.0);
    let view = DebugView { enable_ground_view: true, ground_color: RED, ..nothing() };
    let canvas = draw(&simulator, &view);
    // From (80, 0, 50) to (120, 0, 50).
    for ([x, y], _) in pixels() {
        let is_line = (130..170).contains(&x) && (548..552).contains(&y);
        let expected = if is_line { RED } else { Color::TRANSPARENT };
        assert_eq!(canvas.pixel(x, y), Some(expected), "({x}, {y})");
    }
}

#[test]
fn the_footprint_of_a_box_is_drawn_below_it_and_half_as_strong_on_the_ground() {
    let mut simulator = simulator();
    // As deep as high: from Z = 30 to 70.
    crate_box(&mut simulator, [100.0, 40.0], [200.0, 150.0, 50.0]);
    simulator.update(0.0);
    let view = DebugView { enable_virtual_geom_view: true, virtual_geom_color: GREEN, ..nothing() };
    let canvas = draw(&simulator, &view);
    for y in [0.0, 150.0] {
        let expected = if y > 0.0 { GREEN } else { GREEN.with_alpha(128) };
        for point in [[200.0, y, 30.0], [200.0, y, 70.0], [150.0, y, 50.0], [250.0, y, 50.0]] {
            assert_eq!(color_at(&simulator, &canvas, point), Some(expected), "{point:?}");
        }
        assert_eq!(color_at(&simulator, &canvas, [200.0, y, 50.0]), Some(Color::TRANSPARENT));
    }
}

#[test]
fn the_footprint_of_a_ball_is_round() {
    let mut simulator = simulator();
    ball(&mut simulator, 40.0, [200.0, 0.0, 100.0]);
    simulator.update(0.0);
    let view = DebugView { enable_virtual_geom_view: true, virtual_geom_color: GREEN, ..nothing() };
    let canvas = draw(&simulator, &view);
    let is_green = |point| color_at(&simulator, &canvas, point) == Some(GREEN);
    for point in [[160.0, 0.0, 100.0], [240.0, 0.0, 100.0], [200.0, 0.0, 60.0], [200.0, 0.0, 140.0]] {
        assert!(is_green(point), "{point:?}");
    }
    assert!(!is_green([160.0, 0.0, 60.0]) && !is_green([240.0, 0.0, 140.0]), "no corners");
}

#[test]
fn all_twelve_edges_of_a_platform_are_drawn() {
    let mut simulator = simulator();
    let middle = Vector3::new(200.0, 30.0, 100.0);
    Platform::new(&mut simulator, 100.0, 40.0, 60.0, middle, None).unwrap();
    let view = DebugView { enable_platform_view: true, platform_color: BLUE, ..nothing() };
    let canvas = draw(&simulator, &view);
    let [xs, ys, zs] = [[150.0, 250.0], [30.0, 70.0], [70.0, 130.0]];
    for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        // Not at the middles, where an edge of the front covers one of the back.
        for point in [[180.0, ys[a], zs[b]], [xs[a], 55.0, zs[b]], [xs[a], ys[b], 85.0]] {
            assert_eq!(color_at(&simulator, &canvas, point), Some(BLUE), "{point:?}");
        }
    }
    assert_eq!(color_at(&simulator, &canvas, [180.0, 70.0, 85.0]), Some(Color::TRANSPARENT));
}

#[test]
fn outlines_and_their_corners_are_drawn_at_their_depth() {
    let mut simulator = simulator();
    crate_box(&mut simulator, [100.0, 40.0], [200.0, 10.0, 50.0]);
    simulator.update(0.0);
    let view = DebugView {
        enable_edge_view: true,
        edge_color: RED,
        enable_vertice_view: true,
        vertice_color: YELLOW,
        ..nothing()
    };
    let canvas = draw(&simulator, &view);
    let at = |point| color_at(&simulator, &canvas, point);
    for point in [[190.0, 10.0, 50.0], [190.0, 50.0, 50.0], [150.0, 25.0, 50.0], [250.0, 25.0, 50.0]] {
        assert_eq!(at(point), Some(RED), "{point:?}");
    }
    for point in [[150.0, 10.0, 50.0], [250.0, 50.0, 50.0]] {
        assert_eq!(at(point), Some(YELLOW), "{point:?}");
    }
    assert_eq!(at([200.0, 30.0, 50.0]), Some(Color::TRANSPARENT));
}

#[test]
fn the_axes_of_a_body_turn_with_it() {
    let mut simulator = simulator();
    let body = crate_box(&mut simulator, [100.0, 40.0], [200.0, 0.0, 50.0]);
    let mut view = simulator.body_mut(body).unwrap();
    view.set_rotation(std::f32::consts::FRAC_PI_4);
    let middle = view.position();
    simulator.update(0.0);
    let view = DebugView {
        enable_coordinate_axis_view: true,
        coordinate_axis_color: RED,
        coordinate_axis_line_length: 40.0,
        ..nothing()
    };
    let canvas = draw(&simulator, &view);
    let at = |dx: f32, dy: f32| canvas.pixel((middle.x + dx) as u32, (middle.y + dy) as u32);
    for (dx, dy) in [(10.0, 10.0), (10.0, -10.0), (-10.0, 10.0), (-10.0, -10.0)] {
        assert_eq!(at(dx, dy), Some(RED), "({dx}, {dy})");
        assert_eq!(at(2.0 * dx, 2.0 * dy), Some(Color::TRANSPARENT), "beyond 20 px: ({dx}, {dy})");
    }
    assert_eq!(at(10.0, 0.0), Some(Color::TRANSPARENT));
}

#[test]
fn a_contact_is_a_dot_with_an_arrow_towards_the_geom_that_is_pushed() {
    let mut simulator = depth::simulator();
    ball(&mut simulator, 20.0, [100.0, 0.0, 50.0]);
    for _ in 0..5 {
        simulator.update(DT);
    }
    let view = DebugView { enable_contact_view: true, contact_color: RED, ..nothing() };
    let canvas = draw(&simulator, &view);
    // Where the ball touches the ground, to the width of the dot; the arrow goes up by 20 px.
    let touch = [100.0, 0.0, 50.0];
    assert_eq!(color_at(&simulator, &canvas, touch), Some(RED));
    assert_eq!(color_at(&simulator, &canvas, [100.0, 10.0, 50.0]), Some(RED));
    assert_eq!(color_at(&simulator, &canvas, [100.0, 30.0, 50.0]), Some(Color::TRANSPARENT));
    assert_eq!(color_at(&simulator, &canvas, [100.0, -10.0, 50.0]), Some(Color::TRANSPARENT));
}

/// Notes whether all that is drawn is finite.
#[derive(Default)]
struct Witness {
    lines: usize,
    wrong: Vec<Point>,
}

impl Witness {
    fn look_at(&mut self, points: &[Point]) {
        let is_wrong = |point: &&Point| !point.iter().all(|number| number.is_finite());
        self.wrong.extend(points.iter().filter(is_wrong));
    }
}

impl Canvas for Witness {
    fn size(&self) -> [u32; 2] {
        [64, 64]
    }
    fn clear(&mut self, _: Color) {}
    fn fill_polygon(&mut self, points: &[Point], _: &Transform, _: Color) {
        self.look_at(points);
    }
    fn fill_ellipse(&mut self, center: Point, _: Point, _: &Transform, _: Color) {
        self.look_at(&[center]);
    }
    fn stroke_polyline(&mut self, points: &[Point], _: bool, _: f32, _: &Transform, _: Color) {
        self.lines += 1;
        self.look_at(points);
    }
    fn draw_texture(&mut self, _: &Texture2D, _: &Transform, _: Color, _: Option<&[Point]>) {}
}

#[test]
fn overflowing_shapes_are_not_drawn() {
    let mut simulator = TwoHalfPhysicsSimulator::with_angle(600, 10).unwrap();
    let bodies = [0.0, 50.0].map(|x| crate_box(&mut simulator, [40.0, 40.0], [x, 0.0, 0.0]));
    simulator.update(0.0);
    for (body, speed) in bodies.into_iter().zip([3e38, -3e38]) {
        simulator.body_mut(body).unwrap().set_velocity3d(Vector3::new(0.0, 0.0, speed));
        let geom = simulator.core().geoms_of(body)[0];
        simulator.set_depth_profile(geom, DepthProfile::Round { radius: 3e38 }).unwrap();
    }
    simulator.update(1.0);
    let mut canvas = Witness::default();
    DebugView { enable_vertice_view: true, ..DebugView::default() }.draw(&simulator, &mut canvas);
    assert!(canvas.lines > 0);
    assert_eq!(canvas.wrong, [] as [Point; 0]);
}
