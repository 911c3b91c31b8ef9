//! Debug view: outlines, footprints, grounds, platforms and contacts over a picture.

use twohalf::farseer_core::PhysicsSimulatorView;
use twohalf::{BodyId, DepthProfile, GeomId, TwoHalfGeom, TwoHalfPhysicsSimulator, Vector3, VirtualGeom};

use crate::corners::corners_of;
use crate::footprint::{footprint_of, round};
use crate::plane_debug_view;
use crate::surface::{corners_on_screen, to_screen};
use crate::{Canvas, Color, Point, Transform};

/// Draws the internal shapes of a simulator: outlines, footprints, grounds, platforms and contacts, each at
/// its depth.
///
/// Options that [the 2D engine's view](PhysicsSimulatorView) has as well have the same colours and sizes
/// here; but outlines are drawn by default, dots at their corners are not. Shapes of depth have colours of
/// their own.
///
/// ```
/// # use twohalf::TwoHalfPhysicsSimulator;
/// # use twohalf_render::{DebugView, SoftwareCanvas};
/// # let simulator = TwoHalfPhysicsSimulator::new(480)?;
/// # let mut canvas = SoftwareCanvas::new(640, 480)?;
/// let view = DebugView { enable_contact_view: false, ..DebugView::default() };
/// view.draw(&simulator, &mut canvas);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DebugView {
    /// Whether the grounds are drawn: a line at Y = 0 below each body with an object geom, as wide as that geom.
    pub enable_ground_view: bool,
    /// Colour of the grounds.
    pub ground_color: Color,
    /// Whether the virtual geoms are drawn: the footprint of each geom at the height of its lowest point, and
    /// at half opacity on the ground below.
    pub enable_virtual_geom_view: bool,
    /// Colour of the virtual geoms.
    pub virtual_geom_color: Color,
    /// Whether the boxes of geoms are drawn: their outlines at their front and back, and the edges between;
    /// for balls, the outline and the disc at the height of the centre. Default false.
    pub enable_box_view: bool,
    /// Colour of the boxes.
    pub box_color: Color,
    /// Whether the platforms are drawn: all edges of their boxes.
    pub enable_platform_view: bool,
    /// Colour of the platforms.
    pub platform_color: Color,
    /// Whether the outlines of the geoms are drawn.
    #[doc(alias = "EnableEdgeView")]
    pub enable_edge_view: bool,
    /// Colour of the outlines.
    #[doc(alias = "EdgeColor")]
    pub edge_color: Color,
    /// Whether dots are drawn at the corners of the outlines.
    #[doc(alias = "EnableVerticeView")]
    pub enable_vertice_view: bool,
    /// Colour of these dots.
    #[doc(alias = "VerticeColor")]
    pub vertice_color: Color,
    /// Radius of these dots in px.
    #[doc(alias = "VerticeRadius")]
    pub vertice_radius: f32,
    /// Whether a cross is drawn at each body's origin that rotates with the body.
    #[doc(alias = "EnableCoordinateAxisView")]
    pub enable_coordinate_axis_view: bool,
    /// Colour of these crosses.
    #[doc(alias = "CoordinateAxisColor")]
    pub coordinate_axis_color: Color,
    /// Length of the lines of these crosses in px.
    #[doc(alias = "CoordinateAxisLineLength")]
    pub coordinate_axis_line_length: f32,
    /// Whether contacts are drawn: a dot, and an arrow along the normal.
    #[doc(alias = "EnableContactView")]
    pub enable_contact_view: bool,
    /// Colour of the contacts.
    #[doc(alias = "ContactColor")]
    pub contact_color: Color,
    /// Radius of the contacts' dots in px.
    #[doc(alias = "ContactRadius")]
    pub contact_radius: f32,
    /// Length in the world of the contacts' arrows, px.
    pub contact_normal_length: f32,
    /// Width of all lines in px.
    #[doc(alias = "EdgeLineThickness")]
    #[doc(alias = "CoordinateAxisLineThickness")]
    pub line_thickness: f32,
}

impl Default for DebugView {
    fn default() -> Self {
        let plane = PhysicsSimulatorView::default();
        DebugView {
            enable_ground_view: true,
            ground_color: Color::rgba(130, 60, 0, 220),
            enable_virtual_geom_view: true,
            virtual_geom_color: Color::rgba(0, 110, 60, 220),
            enable_box_view: false,
            box_color: Color::rgba(120, 0, 140, 200),
            enable_platform_view: true,
            platform_color: Color::rgba(0, 60, 200, 220),
            enable_edge_view: true,
            edge_color: plane.edge_color.into(),
            enable_vertice_view: false,
            vertice_color: plane.vertice_color.into(),
            vertice_radius: plane.vertice_radius,
            enable_coordinate_axis_view: plane.enable_coordinate_axis_view,
            coordinate_axis_color: plane.coordinate_axis_color.into(),
            coordinate_axis_line_length: plane.coordinate_axis_line_length,
            enable_contact_view: plane.enable_contact_view,
            contact_color: plane.contact_color.into(),
            contact_radius: plane.contact_radius,
            contact_normal_length: 20.0,
            line_thickness: plane.edge_line_thickness,
        }
    }
}

impl DebugView {
    /// Draws all enabled parts, contacts last: objects of the simulation, and the contacts of its last
    /// update.
    #[doc(alias = "Draw")]
    pub fn draw(&self, simulator: &TwoHalfPhysicsSimulator, canvas: &mut dyn Canvas) {
        let mut pen = Pen { view: self, simulator, canvas };
        if self.enable_ground_view {
            simulator.body_list().iter().for_each(|&body| pen.ground(body));
        }
        if self.enable_virtual_geom_view {
            simulator.geom_list().iter().for_each(|&geom| pen.virtual_geom(geom));
        }
        if self.enable_platform_view {
            pen.platforms();
        }
        if self.enable_box_view {
            simulator.geom_list().iter().for_each(|&geom| pen.room(geom));
        }
        for &geom in simulator.geom_list() {
            pen.outline(geom);
        }
        if self.enable_coordinate_axis_view {
            simulator.body_list().iter().for_each(|&body| pen.axes(body));
        }
        if self.enable_contact_view {
            pen.contacts();
        }
    }
}

/// Draws single objects.
struct Pen<'a> {
    view: &'a DebugView,
    simulator: &'a TwoHalfPhysicsSimulator,
    canvas: &'a mut dyn Canvas,
}

impl Pen<'_> {
    /// Projection of a point of the world, px.
    fn at(&self, x: f32, y: f32, z: f32) -> Point {
        to_screen(self.simulator, Vector3::new(x, y, z))
    }

    fn line(&mut self, points: &[Point], is_closed: bool, color: Color) {
        let width = self.view.line_thickness;
        plane_debug_view::line(self.canvas, points, is_closed, width, color);
    }

    fn dot(&mut self, center: Point, radius: f32, color: Color) {
        plane_debug_view::dot(self.canvas, center, radius, color);
    }

    fn ground(&mut self, body: BodyId) {
        let Some(body) = self.simulator.body(body) else { return };
        let object = body.ground().object_geom().and_then(|geom| self.simulator.geom(geom));
        let Some(object) = object.map(|geom| geom.virtual_geom()) else { return };
        let z = body.position3d().z;
        let line = [object.left, object.right].map(|x| self.at(x, 0.0, z));
        self.line(&line, false, self.view.ground_color);
    }

    fn virtual_geom(&mut self, geom: GeomId) {
        let Some(geom) = self.simulator.geom(geom) else { return };
        let (shape, color) = (geom.virtual_geom(), self.view.virtual_geom_color);
        let on_ground = self.footprint(&geom, 0.0);
        self.line(&on_ground, true, color.with_opacity(0.5));
        let at_bottom = self.footprint(&geom, shape.bottom);
        self.line(&at_bottom, true, color);
    }

    fn room(&mut self, geom: GeomId) {
        let Some(geom) = self.simulator.geom(geom) else { return };
        let (shape, color) = (geom.virtual_geom(), self.view.box_color);
        let outline = corners_of(geom.screen_outline().into_iter().map(Point::from));
        if geom.depth_profile().is_upright() {
            return self.room_of_upright(&geom, &outline);
        }
        if shape.is_round {
            let disc = self.footprint(&geom, 0.5 * (shape.bottom + shape.top));
            self.line(&disc, true, color);
            return self.line(&outline, true, color);
        }
        let middle = self.at(0.0, 0.0, 0.5 * (shape.front + shape.back));
        let [near, far] = [shape.front, shape.back].map(|z| {
            let to = self.at(0.0, 0.0, z);
            let moved = |point: &Point| [point[0] + to[0] - middle[0], point[1] + to[1] - middle[1]];
            outline.iter().map(moved).collect::<Vec<Point>>()
        });
        self.line(&near, true, color);
        self.line(&far, true, color);
        for (&from, &to) in near.iter().zip(&far) {
            self.line(&[from, to], false, color);
        }
    }

    /// Footprint below and above; between them the edges of a prism, or the sides of a round shape. A capsule
    /// has its full width where its hemispheres begin.
    fn room_of_upright(&mut self, geom: &TwoHalfGeom<'_>, outline: &[Point]) {
        let (shape, color) = (geom.virtual_geom(), self.view.box_color);
        let end = match geom.depth_profile() {
            DepthProfile::Capsule { radius, .. } => radius,
            _ => 0.0,
        };
        let low = self.footprint(geom, shape.bottom + end);
        let high = self.footprint(geom, shape.top - end);
        self.line(&low, true, color);
        self.line(&high, true, color);
        let every = if shape.is_round { low.len() / 4 } else { 1 };
        for (&from, &to) in low.iter().zip(&high).step_by(every.max(1)) {
            self.line(&[from, to], false, color);
        }
        if end > 0.0 {
            self.line(outline, true, color);
        }
    }

    fn footprint(&self, geom: &TwoHalfGeom<'_>, y: f32) -> Vec<Point> {
        let shape = geom.virtual_geom();
        let VirtualGeom { left, right, front, back, .. } = shape;
        let rectangle = || vec![[left, front], [right, front], [right, back], [left, back]];
        let corners =
            footprint_of(geom).unwrap_or_else(|| if shape.is_round { round(&shape) } else { rectangle() });
        corners.into_iter().map(|[x, z]| self.at(x, y, z)).collect()
    }

    fn platforms(&mut self) {
        for platform in self.simulator.platforms() {
            let Some(corners) = corners_on_screen(self.simulator, platform) else { continue };
            let color = self.view.platform_color;
            self.line(&corners[..4], true, color);
            self.line(&corners[4..], true, color);
            for index in 0..4 {
                self.line(&[corners[index], corners[index + 4]], false, color);
            }
        }
    }

    fn outline(&mut self, geom: GeomId) {
        let DebugView { enable_edge_view, enable_vertice_view, vertice_radius, .. } = *self.view;
        let Some(geom) = self.simulator.geom(geom) else { return };
        let outline: Vec<Point> = geom.screen_outline().into_iter().map(Point::from).collect();
        if enable_edge_view {
            self.line(&outline, true, self.view.edge_color);
        }
        if enable_vertice_view {
            outline.iter().for_each(|&vertex| self.dot(vertex, vertice_radius, self.view.vertice_color));
        }
    }

    fn axes(&mut self, body: BodyId) {
        let Some(body) = self.simulator.body(body) else { return };
        let half = 0.5 * self.view.coordinate_axis_line_length;
        let to_screen =
            Transform::rotation(body.rotation()).then(&Transform::translation(body.position().into()));
        for end in [[half, 0.0], [0.0, half]] {
            let line = [end.map(|side| -side), end].map(|point| to_screen.apply(point));
            self.line(&line, false, self.view.coordinate_axis_color);
        }
    }

    fn contacts(&mut self) {
        let DebugView { contact_color, contact_radius, contact_normal_length, .. } = *self.view;
        for contact in self.simulator.contacts() {
            let from = to_screen(self.simulator, contact.position);
            let to = to_screen(self.simulator, contact.position + contact.normal * contact_normal_length);
            self.dot(from, contact_radius, contact_color);
            self.arrow(from, to, contact_color);
        }
    }

    fn arrow(&mut self, from: Point, to: Point, color: Color) {
        let [dx, dy] = [0.3 * (to[0] - from[0]), 0.3 * (to[1] - from[1])];
        self.line(&[from, to], false, color);
        let barbs = [
            [to[0] - dx - 0.6 * dy, to[1] - dy + 0.6 * dx],
            to,
            [to[0] - dx + 0.6 * dy, to[1] - dy - 0.6 * dx],
        ];
        self.line(&barbs, false, color);
    }
}
