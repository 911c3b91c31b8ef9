//! Debug view: the state of a simulator as shapes to draw (behaviour chapter 16, part A).

mod pen;
mod shape;

use crate::PhysicsSimulator;

pub use shape::DebugShape;

/// Shows the state of a simulator: outlines, boxes, bodies, contacts, springs, joints, and how long updates take.
///
/// It is independent of any renderer: [`draw`](Self::draw) passes lines, circles, rectangles and texts to a closure.
/// Coordinates and sizes are in length units of the world; the original's games had one unit per pixel. Colours are
/// red, green, blue and straight alpha, 0 to 255.
///
/// All options are read whenever something is drawn. (The original read colours, radii and thicknesses only in
/// `LoadContent`.)
///
/// ```
/// use farseer_core::{DebugShape, PhysicsSimulator, PhysicsSimulatorView};
///
/// let simulator = PhysicsSimulator::default();
/// let view = PhysicsSimulatorView { enable_edge_view: true, ..PhysicsSimulatorView::default() };
/// let mut texts = Vec::new();
/// view.draw(&simulator, |shape| match shape {
///     // Here a game calls its renderer.
///     DebugShape::Line { .. } | DebugShape::Circle { .. } | DebugShape::Rectangle { .. } => (),
///     DebugShape::Text { text, .. } => texts.push(text),
/// });
/// assert!(texts.contains(&"Bodies: 0".to_string()));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhysicsSimulatorView {
    /// Whether the outlines of the geoms are drawn. Default false.
    #[doc(alias = "EnableEdgeView")]
    pub enable_edge_view: bool,
    /// Colour of the outlines.
    #[doc(alias = "EdgeColor")]
    pub edge_color: [u8; 4],
    /// Thickness of the outlines, in length units.
    #[doc(alias = "EdgeLineThickness")]
    pub edge_line_thickness: f32,
    /// Whether dots are drawn at the vertices of the geoms.
    #[doc(alias = "EnableVerticeView")]
    pub enable_vertice_view: bool,
    /// Colour of these dots.
    #[doc(alias = "VerticeColor")]
    pub vertice_color: [u8; 4],
    /// Radius of these dots, in length units.
    #[doc(alias = "VerticeRadius")]
    pub vertice_radius: f32,
    /// Whether the boxes of the geoms are drawn.
    #[doc(alias = "EnableAABBView")]
    pub enable_aabb_view: bool,
    /// Colour of the boxes.
    #[doc(alias = "AABBColor")]
    pub aabb_color: [u8; 4],
    /// Thickness of the boxes' lines, in length units.
    #[doc(alias = "AABBLineThickness")]
    pub aabb_line_thickness: f32,
    /// Whether a cross is drawn at the origin of each body, turned as the body is.
    #[doc(alias = "EnableCoordinateAxisView")]
    pub enable_coordinate_axis_view: bool,
    /// Colour of these crosses.
    #[doc(alias = "CoordinateAxisColor")]
    pub coordinate_axis_color: [u8; 4],
    /// Thickness of the crosses' lines, in length units.
    #[doc(alias = "CoordinateAxisLineThickness")]
    pub coordinate_axis_line_thickness: f32,
    /// Length of the crosses' lines, in length units.
    #[doc(alias = "CoordinateAxisLineLength")]
    pub coordinate_axis_line_length: f32,
    /// Whether dots are drawn at the contacts.
    #[doc(alias = "EnableContactView")]
    pub enable_contact_view: bool,
    /// Colour of the contacts.
    #[doc(alias = "ContactColor")]
    pub contact_color: [u8; 4],
    /// Radius of the contacts, in length units.
    #[doc(alias = "ContactRadius")]
    pub contact_radius: f32,
    /// Whether the times of the last [timed update](PhysicsSimulator::update_timed) and the lengths of the simulator's
    /// lists are written on a panel.
    #[doc(alias = "EnablePerformancePanelView")]
    pub enable_performance_panel_view: bool,
    /// Colour of the panel.
    #[doc(alias = "PerformancePanelColor")]
    pub performance_panel_color: [u8; 4],
    /// Of no effect: the text is white, as in the original.
    #[doc(alias = "PerformancePanelTextColor")]
    pub performance_panel_text_color: [u8; 4],
    /// Whether the panel is wide enough for the lengths of the lists: 360 instead of 220 length units. They are written
    /// in either case, as in the original.
    #[doc(alias = "EnablePerformancePanelBodyCount")]
    pub enable_performance_panel_body_count: bool,
    /// Whether linear springs are drawn.
    #[doc(alias = "EnableSpringView")]
    pub enable_spring_view: bool,
    /// Colour of the springs: lines and dots.
    #[doc(alias = "SpringLineColor")]
    pub spring_line_color: [u8; 4],
    /// Thickness of the springs' lines, in length units.
    #[doc(alias = "SpringLineThickness")]
    pub spring_line_thickness: f32,
    /// Whether revolute and fixed revolute joints are drawn.
    #[doc(alias = "EnableRevoluteJointView")]
    pub enable_revolute_joint_view: bool,
    /// Colour of the revolute joints: lines and squares.
    #[doc(alias = "RevoluteJointLineColor")]
    pub revolute_joint_line_color: [u8; 4],
    /// Thickness of the revolute joints' lines, in length units.
    #[doc(alias = "RevoluteJointLineThickness")]
    pub revolute_joint_line_thickness: f32,
    /// Whether pin joints are drawn.
    #[doc(alias = "EnablePinJointView")]
    pub enable_pin_joint_view: bool,
    /// Colour of the pin joints: lines and squares.
    #[doc(alias = "PinJointLineColor")]
    pub pin_joint_line_color: [u8; 4],
    /// Thickness of the pin joints' lines, in length units.
    #[doc(alias = "PinJointLineThickness")]
    pub pin_joint_line_thickness: f32,
    /// Whether slider joints are drawn.
    #[doc(alias = "EnableSliderJointView")]
    pub enable_slider_joint_view: bool,
    /// Colour of the slider joints: lines and squares.
    #[doc(alias = "SliderJointLineColor")]
    pub slider_joint_line_color: [u8; 4],
    /// Thickness of the slider joints' lines, in length units.
    #[doc(alias = "SliderJointLineThickness")]
    pub slider_joint_line_thickness: f32,
}

impl Default for PhysicsSimulatorView {
    /// The original's options: all views but edges, lines 1 thick, translucent black.
    fn default() -> Self {
        const BLACK: [u8; 4] = [0, 0, 0, 150];
        const JOINT: [u8; 4] = [0, 0, 0, 200];
        PhysicsSimulatorView {
            enable_edge_view: false,
            edge_color: BLACK,
            edge_line_thickness: 1.0,
            enable_vertice_view: true,
            vertice_color: [0, 50, 0, 150],
            vertice_radius: 3.0,
            enable_aabb_view: true,
            aabb_color: BLACK,
            aabb_line_thickness: 1.0,
            enable_coordinate_axis_view: true,
            coordinate_axis_color: BLACK,
            coordinate_axis_line_thickness: 1.0,
            coordinate_axis_line_length: 20.0,
            enable_contact_view: true,
            contact_color: [255, 0, 0, 150],
            contact_radius: 4.0,
            enable_performance_panel_view: true,
            performance_panel_color: BLACK,
            performance_panel_text_color: [0, 0, 0, 255],
            enable_performance_panel_body_count: true,
            enable_spring_view: true,
            spring_line_color: BLACK,
            spring_line_thickness: 1.0,
            enable_revolute_joint_view: true,
            revolute_joint_line_color: JOINT,
            revolute_joint_line_thickness: 1.0,
            enable_pin_joint_view: true,
            pin_joint_line_color: JOINT,
            pin_joint_line_thickness: 1.0,
            enable_slider_joint_view: true,
            slider_joint_line_color: JOINT,
            slider_joint_line_thickness: 1.0,
        }
    }
}

impl PhysicsSimulatorView {
    /// Draws the views that are enabled, later ones on top: outlines and vertices, boxes, bodies, contacts, the panel,
    /// springs, revolute, pin and slider joints. Each view draws the objects of the simulator's list, in its order.
    ///
    /// Disabled and broken objects are drawn as long as they are in their lists. Angle springs and the other joints are
    /// never drawn, nor are shapes with coordinates that are not finite. Before the first update the square of a
    /// revolute joint is on its first body, as in the original.
    #[doc(alias = "Draw")]
    pub fn draw(&self, simulator: &PhysicsSimulator, mut draw: impl FnMut(DebugShape)) {
        pen::Pen { view: self, simulator, draw: &mut draw }.draw_all();
    }

    /// Draws a box around each [island](PhysicsSimulator::islands), with the line thickness of the boxes of geoms.
    /// Ours, and only with the [precise set](crate::Methods::Precise). The colour shows how the island was solved:
    ///
    /// | colour | island |
    /// |---|---|
    /// | grey | [ballistic](crate::IslandSolver::Ballistic): free flight |
    /// | violet | [articulated](crate::IslandSolver::Articulated): joints without contacts |
    /// | green | [direct solver](crate::IslandSolver::Direct) |
    /// | orange | [iterative solver](crate::IslandSolver::Iterative) |
    /// | blue | [asleep](crate::IslandSolver::Asleep) |
    pub fn draw_islands(&self, simulator: &PhysicsSimulator, mut draw: impl FnMut(DebugShape)) {
        pen::Pen { view: self, simulator, draw: &mut draw }.islands();
    }
}
