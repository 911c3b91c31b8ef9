//! The views of the debug view, one by one.

use super::{DebugShape, PhysicsSimulatorView};
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::joints::{Joint, JointId, JointKind};
use crate::math::{Vector2, vector2};
use crate::springs::{Spring, SpringKind};
use crate::{Aabb, Island, IslandSolver, PhysicsSimulator, StepTimes};

const SPRING_DOT_RADIUS: f32 = 2.0;
/// Side of the squares that mark joints, in length units.
const JOINT_SQUARE_SIDE: f32 = 10.0;
const WHITE: [u8; 4] = [255; 4];

/// Colour of an island by its solver.
fn color_of(method: IslandSolver) -> [u8; 4] {
    match method {
        IslandSolver::Asleep => [0, 80, 200, 200],
        IslandSolver::Ballistic => [120, 120, 120, 200],
        IslandSolver::Articulated => [150, 0, 180, 200],
        IslandSolver::Direct => [0, 140, 40, 200],
        // The iterative solver.
        _ => [200, 80, 0, 200],
    }
}

/// Draws the views of a simulator.
pub(super) struct Pen<'a> {
    pub(super) view: &'a PhysicsSimulatorView,
    pub(super) simulator: &'a PhysicsSimulator,
    pub(super) draw: &'a mut dyn FnMut(DebugShape),
}

/// Thickness, in length units, and colour of lines and dots.
#[derive(Clone, Copy)]
struct LineStyle {
    thickness: f32,
    color: [u8; 4],
}

impl Pen<'_> {
    /// Draws every enabled view, in the original's order.
    pub(super) fn draw_all(&mut self) {
        let (view, simulator) = (self.view, self.simulator);
        simulator.geom_list().iter().for_each(|&geom| self.outline(geom));
        if view.enable_aabb_view {
            simulator.geom_list().iter().for_each(|&geom| self.aabb(geom));
        }
        if view.enable_coordinate_axis_view {
            simulator.body_list().iter().for_each(|&body| self.axes(body));
        }
        if view.enable_contact_view {
            self.contacts();
        }
        if view.enable_performance_panel_view {
            self.performance_panel();
        }
        if view.enable_spring_view {
            self.springs();
        }
        self.joints();
    }

    /// Passes a shape to the closure, unless a coordinate is not finite: no renderer could draw it.
    fn emit(&mut self, points: &[Vector2], shape: DebugShape) {
        if points.iter().all(|point| point.x.is_finite() && point.y.is_finite()) {
            (self.draw)(shape);
        }
    }

    fn line(&mut self, start: Vector2, end: Vector2, LineStyle { thickness, color }: LineStyle) {
        self.emit(&[start, end], DebugShape::Line { start, end, thickness, color });
    }

    fn dot(&mut self, center: Vector2, radius: f32, color: [u8; 4]) {
        self.emit(&[center], DebugShape::Circle { center, radius, color });
    }

    fn square(&mut self, center: Vector2, color: [u8; 4]) {
        let min = center - Vector2::repeat(0.5 * JOINT_SQUARE_SIDE);
        self.emit(&[min], DebugShape::Rectangle { min, size: Vector2::repeat(JOINT_SQUARE_SIDE), color });
    }

    fn text(&mut self, x: f32, y: f32, text: String) {
        (self.draw)(DebugShape::Text { position: Vector2::new(x, y), text, color: WHITE });
    }

    /// The outline of a geom: each edge before the dot at its start. An open chain is drawn open.
    fn outline(&mut self, geom: GeomId) {
        let PhysicsSimulatorView { enable_edge_view, enable_vertice_view, .. } = *self.view;
        if !(enable_edge_view || enable_vertice_view) {
            return;
        }
        let Some(geom) = self.simulator.geom(geom) else { return };
        let vertices = geom.world_vertices();
        let edge = LineStyle { thickness: self.view.edge_line_thickness, color: self.view.edge_color };
        let next = vertices.iter().cycle().skip(1);
        let edges = vertices.len() - usize::from(geom.outline().is_open());
        for (index, (&vertex, &next)) in vertices.iter().zip(next).enumerate() {
            if enable_edge_view && index < edges {
                self.line(vertex, next, edge);
            }
            if enable_vertice_view {
                self.dot(vertex, self.view.vertice_radius, self.view.vertice_color);
            }
        }
    }

    fn aabb(&mut self, geom: GeomId) {
        let Some(aabb) = self.simulator.geom(geom).map(|geom| geom.aabb()) else { return };
        let ink = LineStyle { thickness: self.view.aabb_line_thickness, color: self.view.aabb_color };
        self.box_lines(aabb, ink);
    }

    /// Boxes around the boxes of all geoms of an island.
    pub(super) fn islands(&mut self) {
        for Island { bodies, method, .. } in self.simulator.islands() {
            let geoms = bodies.iter().flat_map(|&body| self.simulator.geoms_of(body));
            let boxes = geoms.filter_map(|&geom| self.simulator.geom(geom)).map(|geom| geom.aabb());
            let (thickness, color) = (self.view.aabb_line_thickness, color_of(method));
            if let Some(around) = boxes.reduce(|a, b| Aabb::from_vertices(&[a.min, a.max, b.min, b.max])) {
                self.box_lines(around, LineStyle { thickness, color });
            }
        }
    }

    fn box_lines(&mut self, Aabb { min, max }: Aabb, ink: LineStyle) {
        let corners = [min, Vector2::new(max.x, min.y), max, Vector2::new(min.x, max.y)];
        for index in 0..4 {
            self.line(corners[index], corners[(index + 1) % 4], ink);
        }
    }

    fn axes(&mut self, body: BodyId) {
        let Some(body) = self.simulator.body(body) else { return };
        let thickness = self.view.coordinate_axis_line_thickness;
        let ink = LineStyle { thickness, color: self.view.coordinate_axis_color };
        let half = self.view.coordinate_axis_line_length / 2.0;
        for end in [Vector2::new(half, 0.0), Vector2::new(0.0, half)] {
            self.line(body.get_world_position(-end), body.get_world_position(end), ink);
        }
    }

    fn contacts(&mut self) {
        for arbiter in self.simulator.arbiters() {
            for contact in arbiter.contacts() {
                self.dot(contact.position, self.view.contact_radius, self.view.contact_color);
            }
        }
    }

    fn performance_panel(&mut self) {
        let width = if self.view.enable_performance_panel_body_count { 360.0 } else { 220.0 };
        (self.draw)(DebugShape::Rectangle {
            min: Vector2::new(100.0, 110.0),
            size: Vector2::new(width, 130.0),
            color: self.view.performance_panel_color,
        });
        let StepTimes {
            clean_up_time,
            broad_phase_collision_time,
            narrow_phase_collision_time,
            apply_forces_time,
            apply_impulses_time,
            update_positions_time,
            update_time,
        } = self.simulator.step_times();
        let simulator = self.simulator;
        let rows = [
            ("Clean Up", clean_up_time, "Bodies", simulator.body_list().len()),
            ("Broad Phase Collision", broad_phase_collision_time, "Geoms", simulator.geom_list().len()),
            ("Narrow Phase Collision", narrow_phase_collision_time, "Joints", simulator.joint_list().len()),
            ("Apply Forces", apply_forces_time, "Springs", simulator.spring_list().len()),
            ("Apply Impulses", apply_impulses_time, "Controllers", simulator.controller_list().len()),
            ("Update Positions", update_positions_time, "Arbiters", simulator.arbiter_count()),
        ];
        self.text(110.0, 110.0, format!("Update Total: {update_time:.2}"));
        for (row, (stage, time, list, count)) in (0u8..).zip(rows) {
            let y = 125.0 + 15.0 * f32::from(row);
            self.text(120.0, y, format!("{stage}: {time:.2}"));
            self.text(340.0, y, format!("{list}: {count}"));
        }
    }

    /// All springs: fixed ones first.
    fn springs(&mut self) {
        let simulator = self.simulator;
        let springs =
            || simulator.spring_list().iter().filter_map(|&id| simulator.spring(id)).map(Spring::kind);
        let world_position = |body, point| Some(simulator.body(body)?.get_world_position(point));
        for spring in springs() {
            if let SpringKind::FixedLinear(spring) = spring
                && let Some(end) = world_position(spring.body(), spring.body_attach_point())
            {
                self.spring(spring.world_attach_point(), end);
            }
        }
        for spring in springs() {
            if let SpringKind::Linear(spring) = spring
                && let Some(start) = world_position(spring.body1(), spring.attach_point1())
                && let Some(end) = world_position(spring.body2(), spring.attach_point2())
            {
                self.spring(start, end);
            }
        }
    }

    fn spring(&mut self, start: Vector2, end: Vector2) {
        let ink =
            LineStyle { thickness: self.view.spring_line_thickness, color: self.view.spring_line_color };
        let between = [0.25, 0.5, 0.75].map(|fraction| vector2::lerp(start, end, fraction));
        for center in [start, end].into_iter().chain(between) {
            self.dot(center, SPRING_DOT_RADIUS, ink.color);
        }
        self.line(start, end, ink);
    }

    /// All revolute joints, fixed or not, then all pin joints, then all slider joints.
    fn joints(&mut self) {
        let (view, simulator) = (self.view, self.simulator);
        let joints = || {
            let kind_of = |&id| Some((id, simulator.joint(id).map(Joint::kind)?));
            simulator.joint_list().iter().filter_map(kind_of)
        };
        if view.enable_revolute_joint_view {
            joints().for_each(|(id, joint)| self.revolute_joint(id, joint));
        }
        if view.enable_pin_joint_view {
            let ink =
                LineStyle { thickness: view.pin_joint_line_thickness, color: view.pin_joint_line_color };
            for (_, joint) in joints() {
                if let JointKind::Pin(joint) = joint {
                    self.anchors(joint.world_anchor1(), joint.world_anchor2(), ink);
                }
            }
        }
        if view.enable_slider_joint_view {
            let ink = LineStyle {
                thickness: view.slider_joint_line_thickness,
                color: view.slider_joint_line_color,
            };
            for (_, joint) in joints() {
                if let JointKind::Slider(joint) = joint {
                    self.anchors(joint.world_anchor1(), joint.world_anchor2(), ink);
                }
            }
        }
    }

    fn revolute_joint(&mut self, id: JointId, joint: &JointKind) {
        let thickness = self.view.revolute_joint_line_thickness;
        let ink = LineStyle { thickness, color: self.view.revolute_joint_line_color };
        match joint {
            JointKind::FixedRevolute(joint) => self.square(joint.anchor(), ink.color),
            JointKind::Revolute(joint) => {
                let Ok(anchor) = self.simulator.joint_current_anchor(id) else { return };
                self.square(anchor, ink.color);
                for body in [joint.body1(), joint.body2()] {
                    if let Some(body) = self.simulator.body(body) {
                        self.line(anchor, body.position(), ink);
                    }
                }
            }
            _ => (),
        }
    }

    fn anchors(&mut self, anchor1: Vector2, anchor2: Vector2, ink: LineStyle) {
        self.square(anchor1, ink.color);
        self.square(anchor2, ink.color);
        self.line(anchor1, anchor2, ink);
    }
}
