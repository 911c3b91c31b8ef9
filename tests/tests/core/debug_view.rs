//! Drawings of the debug view (behaviour chapter 16, A).

use conformance::fixtures::plane::{add_box, add_floor, simulator, v};
use farseer_core::math::Vector2;
use farseer_core::{BodyId, DebugShape, JointFactory, PhysicsSimulator, PhysicsSimulatorView, SpringFactory};

/// A view with all layers off.
fn nothing() -> PhysicsSimulatorView {
    PhysicsSimulatorView {
        enable_edge_view: false,
        enable_vertice_view: false,
        enable_aabb_view: false,
        enable_coordinate_axis_view: false,
        enable_contact_view: false,
        enable_performance_panel_view: false,
        enable_spring_view: false,
        enable_revolute_joint_view: false,
        enable_pin_joint_view: false,
        enable_slider_joint_view: false,
        ..PhysicsSimulatorView::default()
    }
}

/// Only springs and joints on, in the default colours.
fn springs_and_joints() -> PhysicsSimulatorView {
    PhysicsSimulatorView {
        enable_spring_view: true,
        enable_revolute_joint_view: true,
        enable_pin_joint_view: true,
        enable_slider_joint_view: true,
        ..nothing()
    }
}

fn shapes(view: &PhysicsSimulatorView, simulator: &PhysicsSimulator) -> Vec<DebugShape> {
    let mut shapes = Vec::new();
    view.draw(simulator, |shape| shapes.push(shape));
    shapes
}

fn line(start: Vector2, end: Vector2, thickness: f32, color: [u8; 4]) -> DebugShape {
    DebugShape::Line { start, end, thickness, color }
}

fn dot(center: Vector2, radius: f32, color: [u8; 4]) -> DebugShape {
    DebugShape::Circle { center, radius, color }
}

/// A joint's square.
fn square(center: Vector2) -> DebugShape {
    DebugShape::Rectangle { min: center - v(5.0, 5.0), size: v(10.0, 10.0), color: JOINT }
}

fn text(x: f32, y: f32, text: &str) -> DebugShape {
    DebugShape::Text { position: v(x, y), text: text.to_string(), color: [255; 4] }
}

const RED: [u8; 4] = [255, 0, 0, 255];
const GREEN: [u8; 4] = [0, 255, 0, 255];
const SPRING: [u8; 4] = [0, 0, 0, 150];
const JOINT: [u8; 4] = [0, 0, 0, 200];

/// Two boxes, at (0, 0) and at (100, 40), in their lists. No gravity; they do not touch.
fn two_boxes() -> (PhysicsSimulator, BodyId, BodyId) {
    let mut simulator = simulator(0.0);
    let (one, _) = add_box(&mut simulator, (20.0, 10.0), v(0.0, 0.0));
    let (two, _) = add_box(&mut simulator, (20.0, 10.0), v(100.0, 40.0));
    simulator.update(0.0);
    (simulator, one, two)
}

#[test]
fn the_options_begin_as_in_the_original() {
    let black = [0, 0, 0, 150];
    let expected = PhysicsSimulatorView {
        enable_edge_view: false,
        edge_color: black,
        edge_line_thickness: 1.0,
        enable_vertice_view: true,
        vertice_color: [0, 50, 0, 150],
        vertice_radius: 3.0,
        enable_aabb_view: true,
        aabb_color: black,
        aabb_line_thickness: 1.0,
        enable_coordinate_axis_view: true,
        coordinate_axis_color: black,
        coordinate_axis_line_thickness: 1.0,
        coordinate_axis_line_length: 20.0,
        enable_contact_view: true,
        contact_color: [255, 0, 0, 150],
        contact_radius: 4.0,
        enable_performance_panel_view: true,
        performance_panel_color: black,
        performance_panel_text_color: [0, 0, 0, 255],
        enable_performance_panel_body_count: true,
        enable_spring_view: true,
        spring_line_color: black,
        spring_line_thickness: 1.0,
        enable_revolute_joint_view: true,
        revolute_joint_line_color: [0, 0, 0, 200],
        revolute_joint_line_thickness: 1.0,
        enable_pin_joint_view: true,
        pin_joint_line_color: [0, 0, 0, 200],
        pin_joint_line_thickness: 1.0,
        enable_slider_joint_view: true,
        slider_joint_line_color: [0, 0, 0, 200],
        slider_joint_line_thickness: 1.0,
    };
    assert_eq!(PhysicsSimulatorView::default(), expected);
}

#[test]
fn with_everything_off_nothing_is_drawn() {
    let (mut simulator, one, two) = two_boxes();
    JointFactory::create_pin_joint_in(&mut simulator, one, v(0.0, 0.0), two, v(0.0, 0.0)).unwrap();
    simulator.update(0.01);
    assert_eq!(shapes(&nothing(), &simulator), []);
}

#[test]
fn each_edge_is_drawn_before_the_dot_at_its_start_and_the_last_one_leads_back() {
    let (simulator, ..) = two_boxes();
    let view = PhysicsSimulatorView {
        enable_edge_view: true,
        edge_color: RED,
        edge_line_thickness: 2.0,
        enable_vertice_view: true,
        vertice_color: GREEN,
        vertice_radius: 5.0,
        ..nothing()
    };
    let mut expected = Vec::new();
    for &geom in simulator.geom_list() {
        let vertices = simulator.geom(geom).unwrap().world_vertices().into_owned();
        for index in 0..vertices.len() {
            let next = vertices[(index + 1) % vertices.len()];
            expected.extend([line(vertices[index], next, 2.0, RED), dot(vertices[index], 5.0, GREEN)]);
        }
    }
    assert_eq!(shapes(&view, &simulator), expected);
    assert!(expected.contains(&dot(v(110.0, 45.0), 5.0, GREEN)), "a corner of the second box");
}

#[test]
fn edges_and_vertices_have_a_switch_each() {
    let (simulator, ..) = two_boxes();
    let edges = shapes(&PhysicsSimulatorView { enable_edge_view: true, ..nothing() }, &simulator);
    assert!(edges.iter().all(|shape| matches!(shape, DebugShape::Line { .. })));
    let dots = shapes(&PhysicsSimulatorView { enable_vertice_view: true, ..nothing() }, &simulator);
    assert!(dots.iter().all(|shape| matches!(shape, DebugShape::Circle { .. })));
    let vertices = |&geom| simulator.geom(geom).unwrap().world_vertices().len();
    let count: usize = simulator.geom_list().iter().map(vertices).sum();
    assert_eq!([edges.len(), dots.len()], [count; 2]);
}

#[test]
fn boxes_are_drawn_from_their_least_corner_along_x_first() {
    let (mut simulator, one, _) = two_boxes();
    simulator.dispose(one).unwrap();
    simulator.update(0.0);
    let view = PhysicsSimulatorView {
        enable_aabb_view: true,
        aabb_color: RED,
        aabb_line_thickness: 3.0,
        ..nothing()
    };
    let corners = [v(90.0, 35.0), v(110.0, 35.0), v(110.0, 45.0), v(90.0, 45.0)];
    let side = |index: usize| line(corners[index], corners[(index + 1) % 4], 3.0, RED);
    assert_eq!(shapes(&view, &simulator), [0, 1, 2, 3].map(side));
}

#[test]
fn axes_turn_with_the_body_and_are_as_long_as_wanted() {
    let (mut simulator, one, two) = two_boxes();
    simulator.dispose(one).unwrap();
    simulator.update(0.0);
    simulator[two].set_rotation(0.7);
    let view = PhysicsSimulatorView {
        enable_coordinate_axis_view: true,
        coordinate_axis_color: RED,
        coordinate_axis_line_thickness: 2.0,
        coordinate_axis_line_length: 30.0,
        ..nothing()
    };
    let at = |x, y| simulator[two].get_world_position(v(x, y));
    let expected =
        [line(at(-15.0, 0.0), at(15.0, 0.0), 2.0, RED), line(at(0.0, -15.0), at(0.0, 15.0), 2.0, RED)];
    assert_eq!(shapes(&view, &simulator), expected);
    // y points down: positive angles turn x towards y.
    assert!((at(15.0, 0.0) - v(100.0, 40.0) - v(0.7f32.cos(), 0.7f32.sin()) * 15.0).norm() < 1e-4);
}

#[test]
fn every_contact_of_every_arbiter_is_a_dot() {
    let mut simulator = simulator(0.0);
    add_floor(&mut simulator, (200.0, 20.0), v(0.0, 0.0));
    add_box(&mut simulator, (20.0, 20.0), v(-50.0, -19.5));
    add_box(&mut simulator, (20.0, 20.0), v(50.0, -19.5));
    simulator.update(0.01);
    let view = PhysicsSimulatorView {
        enable_contact_view: true,
        contact_color: GREEN,
        contact_radius: 2.0,
        ..nothing()
    };
    let contacts = simulator.arbiters().flat_map(|arbiter| arbiter.contacts());
    let expected: Vec<DebugShape> = contacts.map(|contact| dot(contact.position, 2.0, GREEN)).collect();
    assert_eq!(shapes(&view, &simulator), expected);
    assert!(simulator.arbiter_count() == 2 && expected.len() >= 4, "both boxes lie on two corners");
}

#[test]
fn the_panel_shows_times_on_the_left_and_counts_on_the_right() {
    let (mut simulator, one, two) = two_boxes();
    JointFactory::create_angle_joint_in(&mut simulator, one, two).unwrap();
    SpringFactory::create_angle_spring_in(&mut simulator, one, two, 1.0, 1.0).unwrap();
    SpringFactory::create_fixed_angle_spring_in(&mut simulator, two, 1.0, 1.0).unwrap();
    // The readings of this clock lie 0.25, 0.5, 0.75 ms and so on apart.
    let (mut time, mut step) = (0.0, 0.0);
    let mut clock = || {
        time += step;
        step += 0.25;
        time
    };
    simulator.update_timed(0.01, 0.0, None, &mut clock);
    let view = PhysicsSimulatorView {
        enable_performance_panel_view: true,
        performance_panel_color: RED,
        performance_panel_text_color: GREEN,
        ..nothing()
    };
    let expected = [
        DebugShape::Rectangle { min: v(100.0, 110.0), size: v(360.0, 130.0), color: RED },
        text(110.0, 110.0, "Update Total: 5.25"),
        text(120.0, 125.0, "Clean Up: 0.25"),
        text(340.0, 125.0, "Bodies: 2"),
        text(120.0, 140.0, "Broad Phase Collision: 0.50"),
        text(340.0, 140.0, "Geoms: 2"),
        text(120.0, 155.0, "Narrow Phase Collision: 0.75"),
        text(340.0, 155.0, "Joints: 1"),
        text(120.0, 170.0, "Apply Forces: 1.00"),
        text(340.0, 170.0, "Springs: 2"),
        text(120.0, 185.0, "Apply Impulses: 1.25"),
        text(340.0, 185.0, "Controllers: 0"),
        text(120.0, 200.0, "Update Positions: 1.50"),
        text(340.0, 200.0, "Arbiters: 0"),
    ];
    assert_eq!(shapes(&view, &simulator), expected);
}

#[test]
fn without_the_body_count_the_panel_is_narrower_and_the_counts_are_written_all_the_same() {
    let (simulator, ..) = two_boxes();
    let wide = PhysicsSimulatorView { enable_performance_panel_view: true, ..nothing() };
    let narrow = PhysicsSimulatorView { enable_performance_panel_body_count: false, ..wide };
    let (wide, narrow) = (shapes(&wide, &simulator), shapes(&narrow, &simulator));
    let color = PhysicsSimulatorView::default().performance_panel_color;
    let panel = DebugShape::Rectangle { min: v(100.0, 110.0), size: v(220.0, 130.0), color };
    assert_eq!(narrow[0], panel);
    assert_eq!(narrow[1..], wide[1..]);
}

/// A spring's five dots and its line.
fn spring(start: Vector2, end: Vector2) -> Vec<DebugShape> {
    let dots = [0.0, 1.0, 0.25, 0.5, 0.75].map(|part| dot(start + (end - start) * part, 2.0, SPRING));
    dots.into_iter().chain([line(start, end, 1.0, SPRING)]).collect()
}

#[test]
fn fixed_springs_are_drawn_from_the_world_first_and_angle_springs_never() {
    let (mut simulator, one, two) = two_boxes();
    SpringFactory::create_linear_spring_in(&mut simulator, one, v(10.0, 5.0), two, v(-10.0, -5.0), 1.0, 1.0)
        .unwrap();
    SpringFactory::create_angle_spring_in(&mut simulator, one, two, 1.0, 1.0).unwrap();
    SpringFactory::create_fixed_angle_spring_in(&mut simulator, two, 1.0, 1.0).unwrap();
    SpringFactory::create_fixed_linear_spring_in(
        &mut simulator,
        two,
        v(10.0, 0.0),
        v(190.0, 120.0),
        1.0,
        1.0,
    )
    .unwrap();
    simulator.update(0.0);
    let expected = [spring(v(190.0, 120.0), v(110.0, 40.0)), spring(v(10.0, 5.0), v(90.0, 35.0))].concat();
    assert_eq!(shapes(&springs_and_joints(), &simulator), expected);
}

#[test]
fn a_revolute_joint_is_drawn_on_its_first_body_until_it_has_been_in_an_update() {
    let (mut simulator, one, two) = two_boxes();
    JointFactory::create_revolute_joint_in(&mut simulator, one, two, v(50.0, 20.0)).unwrap();
    simulator.update(0.0);
    let drawn = |simulator: &PhysicsSimulator, anchor| {
        let lines = [v(0.0, 0.0), v(100.0, 40.0)].map(|body| line(anchor, body, 1.0, JOINT));
        let expected = [vec![square(anchor)], lines.to_vec()].concat();
        assert_eq!(shapes(&springs_and_joints(), simulator), expected);
    };
    drawn(&simulator, v(0.0, 0.0));
    simulator.update(0.01);
    drawn(&simulator, v(50.0, 20.0));
}

#[test]
fn a_fixed_revolute_joint_is_a_square_at_its_anchor() {
    let (mut simulator, one, _) = two_boxes();
    JointFactory::create_fixed_revolute_joint_in(&mut simulator, one, v(7.0, 9.0)).unwrap();
    simulator.update(0.0);
    assert_eq!(shapes(&springs_and_joints(), &simulator), [square(v(7.0, 9.0))]);
}

#[test]
fn revolute_joints_are_drawn_before_pin_joints_and_those_before_slider_joints() {
    let (mut simulator, one, two) = two_boxes();
    let (anchor1, anchor2) = (v(10.0, 0.0), v(-10.0, 0.0));
    JointFactory::create_slider_joint_in(&mut simulator, one, anchor1, two, anchor2, 10.0, 200.0).unwrap();
    JointFactory::create_pin_joint_in(&mut simulator, one, v(0.0, 5.0), two, v(0.0, -5.0)).unwrap();
    JointFactory::create_fixed_revolute_joint_in(&mut simulator, two, v(100.0, 40.0)).unwrap();
    simulator.update(0.0);
    let link = |end1, end2| vec![square(end1), square(end2), line(end1, end2, 1.0, JOINT)];
    let expected =
        [vec![square(v(100.0, 40.0))], link(v(0.0, 5.0), v(100.0, 35.0)), link(v(10.0, 0.0), v(90.0, 40.0))];
    assert_eq!(shapes(&springs_and_joints(), &simulator), expected.concat());
}

#[test]
fn joints_that_act_on_angles_and_welds_are_never_drawn() {
    let (mut simulator, one, two) = two_boxes();
    JointFactory::create_angle_joint_in(&mut simulator, one, two).unwrap();
    JointFactory::create_angle_limit_joint_in(&mut simulator, one, two, -1.0, 1.0).unwrap();
    JointFactory::create_fixed_angle_joint_in(&mut simulator, one).unwrap();
    JointFactory::create_fixed_angle_limit_joint_in(&mut simulator, one, -1.0, 1.0).unwrap();
    JointFactory::create_weld_joint_in(&mut simulator, one, two, v(50.0, 20.0)).unwrap();
    simulator.update(0.01);
    assert_eq!(simulator.joint_list().len(), 5);
    assert_eq!(shapes(&springs_and_joints(), &simulator), []);
}

#[test]
fn a_disabled_joint_is_drawn_as_long_as_it_is_in_its_list() {
    let (mut simulator, one, two) = two_boxes();
    let joint =
        JointFactory::create_pin_joint_in(&mut simulator, one, v(0.0, 0.0), two, v(0.0, 0.0)).unwrap();
    assert_eq!(shapes(&springs_and_joints(), &simulator), [], "not yet in its list");
    simulator.update(0.01);
    simulator[joint].set_enabled(false);
    assert_eq!(shapes(&springs_and_joints(), &simulator).len(), 3);
    simulator.remove(joint).unwrap();
    assert_eq!(shapes(&springs_and_joints(), &simulator).len(), 3, "it leaves with the next update");
    simulator.update(0.01);
    assert_eq!(shapes(&springs_and_joints(), &simulator), []);
}

#[test]
fn moved_objects_are_drawn_at_their_present_pose() {
    let (mut simulator, one, _) = two_boxes();
    simulator[one].set_position(v(-300.0, 70.0));
    let view = PhysicsSimulatorView {
        enable_vertice_view: true,
        enable_aabb_view: true,
        enable_coordinate_axis_view: true,
        ..nothing()
    };
    let shapes = shapes(&view, &simulator);
    let black = PhysicsSimulatorView::default().aabb_color;
    assert!(shapes.contains(&dot(v(-290.0, 75.0), 3.0, view.vertice_color)));
    assert!(shapes.contains(&line(v(-310.0, 65.0), v(-290.0, 65.0), 1.0, black)));
    assert!(shapes.contains(&line(v(-310.0, 70.0), v(-290.0, 70.0), 1.0, black)));
}

#[test]
fn the_parts_are_drawn_in_the_order_of_the_original() {
    let mut simulator = simulator(0.0);
    let (floor, _) = add_floor(&mut simulator, (200.0, 20.0), v(0.0, 0.0));
    let (block, _) = add_box(&mut simulator, (20.0, 20.0), v(-50.0, -19.5));
    JointFactory::create_slider_joint_in(&mut simulator, floor, v(0.0, 0.0), block, v(0.0, 0.0), 0.0, 99.0)
        .unwrap();
    JointFactory::create_pin_joint_in(&mut simulator, floor, v(0.0, 0.0), block, v(0.0, 0.0)).unwrap();
    JointFactory::create_revolute_joint_in(&mut simulator, floor, block, v(0.0, 0.0)).unwrap();
    SpringFactory::create_linear_spring_in(&mut simulator, floor, v(0.0, 0.0), block, v(0.0, 0.0), 1.0, 1.0)
        .unwrap();
    simulator.update(0.01);
    // A red of its own for every part; the panel's text is white.
    let color = |part| [part, 0, 0, 255];
    let view = PhysicsSimulatorView {
        enable_edge_view: true,
        edge_color: color(1),
        vertice_color: color(1),
        aabb_color: color(2),
        coordinate_axis_color: color(3),
        contact_color: color(4),
        performance_panel_color: color(5),
        spring_line_color: color(6),
        revolute_joint_line_color: color(7),
        pin_joint_line_color: color(8),
        slider_joint_line_color: color(9),
        ..PhysicsSimulatorView::default()
    };
    let part = |shape: &DebugShape| match shape {
        DebugShape::Line { color, .. }
        | DebugShape::Circle { color, .. }
        | DebugShape::Rectangle { color, .. }
        | DebugShape::Text { color, .. } => color[0],
    };
    let mut parts: Vec<u8> = shapes(&view, &simulator).iter().map(part).collect();
    parts.dedup();
    assert_eq!(parts, [1, 2, 3, 4, 5, 255, 6, 7, 8, 9]);
}
