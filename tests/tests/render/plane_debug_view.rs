//! Drawings of the debug view of the 2D engine on a canvas.

use crate::canvases::{BLUE, GREEN, RED, YELLOW, canvas, pixels};
use conformance::fixtures::plane::{add_box, simulator, v};
use farseer_core::{JointFactory, PhysicsSimulator, PhysicsSimulatorView, SpringFactory};
use twohalf_render::{Canvas, Color, SoftwareCanvas, draw_debug_view};

/// A view with all layers off. Lines of 4 px, so that a line along an axis covers complete pixels.
fn nothing() -> PhysicsSimulatorView {
    PhysicsSimulatorView {
        enable_vertice_view: false,
        enable_aabb_view: false,
        enable_coordinate_axis_view: false,
        enable_contact_view: false,
        enable_performance_panel_view: false,
        enable_spring_view: false,
        enable_revolute_joint_view: false,
        enable_pin_joint_view: false,
        enable_slider_joint_view: false,
        edge_line_thickness: 4.0,
        aabb_line_thickness: 4.0,
        spring_line_thickness: 4.0,
        pin_joint_line_thickness: 4.0,
        ..PhysicsSimulatorView::default()
    }
}

fn draw(view: &PhysicsSimulatorView, simulator: &PhysicsSimulator) -> SoftwareCanvas {
    let mut canvas = canvas();
    draw_debug_view(view, simulator, &mut canvas);
    canvas
}

fn rgba(color: Color) -> [u8; 4] {
    [color.r, color.g, color.b, color.a]
}

/// Two boxes of 60 px, around (100, 200) and (300, 200).
fn two_boxes() -> (PhysicsSimulator, [farseer_core::BodyId; 2]) {
    let mut simulator = simulator(0.0);
    let bodies = [100.0, 300.0].map(|x| add_box(&mut simulator, (60.0, 60.0), v(x, 200.0)).0);
    simulator.update(0.0);
    (simulator, bodies)
}

#[test]
fn an_outline_is_a_line_of_its_thickness_along_the_edges() {
    let (simulator, _) = two_boxes();
    let view = PhysicsSimulatorView { enable_edge_view: true, edge_color: rgba(RED), ..nothing() };
    let canvas = draw(&view, &simulator);
    // Across the left side of the first box, at x = 70, and across its top, at y = 170.
    for (across, expected) in [(67, Color::TRANSPARENT), (68, RED), (71, RED), (72, Color::TRANSPARENT)] {
        assert_eq!(canvas.pixel(across, 200), Some(expected), "x {across}");
        assert_eq!(canvas.pixel(100, 100 + across), Some(expected), "y {across}");
    }
}

#[test]
fn a_translucent_box_lets_the_picture_through() {
    let (simulator, _) = two_boxes();
    let view = PhysicsSimulatorView { enable_aabb_view: true, aabb_color: [0, 0, 0, 51], ..nothing() };
    let mut canvas = canvas();
    canvas.clear(Color::WHITE);
    draw_debug_view(&view, &simulator, &mut canvas);
    // A fifth of the white is taken.
    assert_eq!(canvas.pixel(100, 170), Some(Color::rgb(204, 204, 204)));
    assert_eq!(canvas.pixel(100, 200), Some(Color::WHITE));
}

#[test]
fn a_spring_is_a_line_and_a_pin_joint_has_squares_at_its_ends() {
    let (mut simulator, [one, two]) = two_boxes();
    let (low, high) = (v(0.0, 20.0), v(0.0, -20.0));
    SpringFactory::create_linear_spring_in(&mut simulator, one, low, two, low, 1.0, 1.0).unwrap();
    JointFactory::create_pin_joint_in(&mut simulator, one, high, two, high).unwrap();
    simulator.update(0.0);
    let view = PhysicsSimulatorView {
        enable_spring_view: true,
        spring_line_color: rgba(BLUE),
        enable_pin_joint_view: true,
        pin_joint_line_color: rgba(GREEN),
        ..nothing()
    };
    let canvas = draw(&view, &simulator);
    let expected = |[x, y]: [u32; 2]| match (x, y) {
        (95..105 | 295..305, 175..185) | (105..295, 178..182) => GREEN,
        (100..300, 218..222) => BLUE,
        _ => Color::TRANSPARENT,
    };
    // The dots at both ends of the spring reach 2 px further than its line.
    let is_end = |[x, y]: [u32; 2]| matches!((x, y), (98..102 | 298..302, 218..222));
    for (pixel @ [x, y], _) in pixels().filter(|&(pixel, _)| !is_end(pixel)) {
        assert_eq!(canvas.pixel(x, y), Some(expected(pixel)), "({x}, {y})");
    }
    assert!(canvas.pixel(99, 219).is_some_and(|color| color.b == 255), "a dot");
}

#[test]
fn vertices_and_contacts_are_round() {
    let (simulator, _) = two_boxes();
    let view = PhysicsSimulatorView {
        enable_vertice_view: true,
        vertice_color: rgba(YELLOW),
        vertice_radius: 10.0,
        ..nothing()
    };
    let canvas = draw(&view, &simulator);
    assert_eq!(canvas.pixel(130, 170), Some(YELLOW));
    assert_eq!(canvas.pixel(138, 170), Some(YELLOW));
    assert_eq!(canvas.pixel(138, 178), Some(Color::TRANSPARENT), "no corner");
}

#[test]
fn the_panel_is_a_rectangle_with_white_text_in_two_columns() {
    let (simulator, _) = two_boxes();
    let view = PhysicsSimulatorView {
        enable_performance_panel_view: true,
        performance_panel_color: rgba(BLUE),
        ..nothing()
    };
    let canvas = draw(&view, &simulator);
    let is_white = |[x, y]: [u32; 2]| canvas.pixel(x, y) == Some(Color::WHITE);
    let is_panel = |[x, y]: [u32; 2]| (100..460).contains(&x) && (110..240).contains(&y);
    for (pixel @ [x, y], _) in pixels().filter(|&(pixel, _)| !is_white(pixel)) {
        let expected = if is_panel(pixel) { BLUE } else { Color::TRANSPARENT };
        assert_eq!(canvas.pixel(x, y), Some(expected), "({x}, {y})");
    }
    let white_in = |xs: std::ops::Range<u32>, ys: std::ops::Range<u32>| {
        xs.flat_map(move |x| ys.clone().map(move |y| [x, y])).filter(|&pixel| is_white(pixel)).count()
    };
    assert!(white_in(110..330, 110..125) > 50 && white_in(340..460, 110..125) == 0, "the total alone");
    for row in 0..6 {
        let line = 125 + 15 * row..140 + 15 * row;
        assert!(white_in(120..330, line.clone()) > 50, "a stage, row {row}");
        assert!(white_in(340..460, line.clone()) > 30, "a count, row {row}");
        assert_eq!(white_in(330..340, line), 0, "between the columns, row {row}");
    }
}
