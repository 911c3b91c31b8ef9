//! Drawing of a sample scene: its geoms, water, springs and joints.

use conformance::samples::{Figure, Look, Rgba, SCREEN, SampleScene, wave_of};
use farseer_core::math::Vector2;
use farseer_core::{
    BodyId, FixedRevoluteJoint, JointId, JointKind, PhysicsSimulator, SpringId, SpringKind, WaveController,
};
use twohalf_render::{Canvas, Color, Point, Transform};

/// Colour of the water: aquamarine, half of it.
const WATER: Color = Color::rgba(127, 255, 212, 128);
/// Y in px of the upper edge of the lower border; the water behind it is not drawn.
const FLOOR: f32 = SCREEN[1] - 38.0;
/// Colour of springs.
const SPRING: Color = Color::rgb(168, 24, 40);
/// Colour of joints.
const JOINT: Color = Color::rgb(20, 48, 150);

/// A colour of a scene.
pub(crate) fn color([red, green, blue, alpha]: Rgba) -> Color {
    Color::rgba(red, green, blue, alpha)
}

/// Draws a scene that has made at least one step.
pub fn draw_sample(scene: &SampleScene, canvas: &mut dyn Canvas) {
    let simulator = scene.simulator();
    for look in scene.looks() {
        draw_look(simulator, look, canvas);
    }
    for &joint in simulator.joint_list() {
        draw_joint(simulator, joint, canvas);
    }
    for &spring in simulator.spring_list() {
        draw_spring(simulator, spring, canvas);
    }
    if let Some(wave) = wave_of(simulator) {
        draw_water(wave, canvas);
    }
}

fn draw_look(simulator: &PhysicsSimulator, look: &Look, canvas: &mut dyn Canvas) {
    let outline: Vec<Point> = match look.figure {
        Figure::Geom(geom) => match simulator.geom(geom) {
            Some(geom) => geom.world_vertices().iter().map(|&vertex| vertex.into()).collect(),
            None => return,
        },
        Figure::Rectangle { body, size: [width, height] } => {
            let corner = |x, y| place(simulator, body, Vector2::new(x * width / 2.0, y * height / 2.0));
            vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)]
        }
    };
    canvas.fill_polygon(&outline, &Transform::IDENTITY, color(look.fill));
    canvas.stroke_polyline(&outline, true, 1.5, &Transform::IDENTITY, color(look.border));
}

/// Where a point of a body is.
fn place(simulator: &PhysicsSimulator, body: BodyId, point: Vector2) -> Point {
    simulator[body].get_world_position(point).into()
}

fn draw_water(wave: &WaveController, canvas: &mut dyn Canvas) {
    let y = wave.position().y;
    let surface: Vec<Point> =
        wave.x_position().iter().zip(wave.current_wave()).map(|(&x, &offset)| [x, y + offset]).collect();
    let mut outline = surface.clone();
    if let (Some(first), Some(last)) = (surface.first(), surface.last()) {
        outline.extend([[last[0], FLOOR], [first[0], FLOOR]]);
    }
    canvas.fill_polygon(&outline, &Transform::IDENTITY, WATER);
    canvas.stroke_polyline(&surface, false, 2.0, &Transform::IDENTITY, Color::WHITE);
}

/// Draws a linear spring, or one that turns a body about the point in which the world holds it.
pub fn draw_spring(simulator: &PhysicsSimulator, spring: SpringId, canvas: &mut dyn Canvas) {
    match simulator[spring].kind() {
        SpringKind::Linear(spring) => {
            let start = place(simulator, spring.body1(), spring.attach_point1());
            draw_coil(start, place(simulator, spring.body2(), spring.attach_point2()), canvas);
        }
        SpringKind::FixedLinear(spring) => {
            let hook: Point = spring.world_attach_point().into();
            draw_coil(hook, place(simulator, spring.body(), spring.body_attach_point()), canvas);
        }
        SpringKind::FixedAngle(spring) => draw_spiral(simulator, spring.body(), canvas),
        // No scene has one.
        _ => {}
    }
}

/// A zigzag from point to point, with a dot at either end.
fn draw_coil(start: Point, end: Point, canvas: &mut dyn Canvas) {
    const TURN: f32 = 10.0;
    const MOST_TURNS: f32 = 16.0;
    let [dx, dy] = [end[0] - start[0], end[1] - start[1]];
    let length = dx.hypot(dy);
    let turns = (length / TURN).floor().clamp(1.0, MOST_TURNS);
    // The height at rest is that of a turn: flatter when it is stretched.
    let height = (0.4 * TURN).min(0.5 * length / turns);
    let across = if length > 0.0 { [-dy / length * height, dx / length * height] } else { [0.0; 2] };
    let corners = 4 * turns as u32;
    let points: Vec<Point> = (0..=corners)
        .map(|corner| {
            let along = corner as f32 / corners as f32;
            let side = [0.0, 1.0, 0.0, -1.0][corner as usize % 4];
            [start[0] + along * dx + side * across[0], start[1] + along * dy + side * across[1]]
        })
        .collect();
    canvas.stroke_polyline(&points, false, 2.0, &Transform::IDENTITY, SPRING);
    for end in [start, end] {
        dot(end, 3.0, SPRING, canvas);
    }
}

/// A spiral about the point in which the world holds a body, tighter the further the body is turned.
fn draw_spiral(simulator: &PhysicsSimulator, body: BodyId, canvas: &mut dyn Canvas) {
    const RADII: [f32; 2] = [3.0, 15.0];
    const POINTS: u32 = 60;
    let Some(joint) = holder(simulator, body) else { return };
    let middle: Point = joint.anchor().into();
    let turn = 2.5 * std::f32::consts::TAU + simulator[body].total_rotation();
    let points: Vec<Point> = (0..=POINTS)
        .map(|point| {
            let part = point as f32 / POINTS as f32;
            let radius = RADII[0] + part * (RADII[1] - RADII[0]);
            let (sin, cos) = (part * turn).sin_cos();
            [middle[0] + radius * cos, middle[1] + radius * sin]
        })
        .collect();
    canvas.stroke_polyline(&points, false, 2.0, &Transform::IDENTITY, SPRING);
}

/// The joint that holds a body to the world.
fn holder(simulator: &PhysicsSimulator, body: BodyId) -> Option<&FixedRevoluteJoint> {
    simulator
        .joint_list()
        .iter()
        .filter_map(|&joint| simulator.joint_as::<FixedRevoluteJoint>(joint).ok())
        .find(|joint| joint.body() == body)
}

/// Draws a joint that has a point or a rod to show, while it is enabled.
pub fn draw_joint(simulator: &PhysicsSimulator, id: JointId, canvas: &mut dyn Canvas) {
    let joint = &simulator[id];
    if !joint.enabled() {
        return;
    }
    match joint.kind() {
        JointKind::Revolute(_) | JointKind::FixedRevolute(_) | JointKind::Weld(_) => {
            // The kinds that have an anchor.
            if let Ok(anchor) = simulator.joint_current_anchor(id) {
                dot(anchor.into(), 6.0, JOINT, canvas);
                dot(anchor.into(), 2.5, Color::WHITE, canvas);
            }
        }
        JointKind::Pin(pin) => {
            let ends = [(pin.body1(), pin.anchor1()), (pin.body2(), pin.anchor2())];
            draw_rod(ends.map(|(body, anchor)| place(simulator, body, anchor)), canvas);
        }
        JointKind::Slider(slider) => {
            let ends = [(slider.body1(), slider.anchor1()), (slider.body2(), slider.anchor2())];
            draw_rod(ends.map(|(body, anchor)| place(simulator, body, anchor)), canvas);
        }
        _ => {}
    }
}

fn draw_rod(ends: [Point; 2], canvas: &mut dyn Canvas) {
    canvas.stroke_polyline(&ends, false, 2.0, &Transform::IDENTITY, JOINT);
    for end in ends {
        dot(end, 4.0, JOINT, canvas);
    }
}

fn dot(center: Point, radius: f32, color: Color, canvas: &mut dyn Canvas) {
    canvas.fill_ellipse(center, [radius; 2], &Transform::IDENTITY, color);
}
