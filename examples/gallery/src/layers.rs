//! Engine data drawn over a scene, layer by layer.

use farseer_core::{DebugShape, Island, IslandSolver, PhysicsSimulator, PhysicsSimulatorView};
use twohalf::TwoHalfPhysicsSimulator;
use twohalf_render::{Canvas, Color, DebugView, Point, Transform, draw_debug_view};

use crate::keys::Key;
use crate::play::World;

const INK: [u8; 4] = [255, 255, 255, 210];
const BOX: [u8; 4] = [255, 230, 90, 170];
const CONTACT: [u8; 4] = [255, 60, 60, 230];
const JOINT: [u8; 4] = [90, 230, 255, 220];
const ASLEEP: Color = Color::rgba(110, 150, 255, 200);

/// Which layers are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Layers {
    /// Outlines of geoms.
    pub outlines: bool,
    /// AABBs of geoms; with depth, the boxes in space.
    pub boxes: bool,
    /// Contacts of the last step.
    pub contacts: bool,
    /// Islands, in a colour for their solver.
    pub islands: bool,
    /// A mark on sleeping bodies.
    pub sleep: bool,
    /// Joints and springs.
    pub joints: bool,
}

impl Layers {
    /// The layer that a key switches.
    pub fn of(&mut self, key: Key) -> Option<&mut bool> {
        Some(match key {
            Key::Outlines => &mut self.outlines,
            Key::Boxes => &mut self.boxes,
            Key::Contacts => &mut self.contacts,
            Key::Islands => &mut self.islands,
            Key::Sleep => &mut self.sleep,
            Key::Joints => &mut self.joints,
            _ => return None,
        })
    }

    /// Draws them, in the px of the simulator.
    pub fn draw(&self, world: World<'_>, canvas: &mut dyn Canvas) {
        if *self == Layers::default() {
            return;
        }
        match world {
            World::Plane(simulator) => self.draw_plane(simulator, canvas),
            World::Depth(simulator) => self.draw_depth(simulator, canvas),
        }
    }

    fn draw_plane(&self, simulator: &PhysicsSimulator, canvas: &mut dyn Canvas) {
        let view = self.plane_view();
        draw_debug_view(&view, simulator, canvas);
        self.draw_islands(&view, simulator, canvas);
        if self.sleep {
            let asleep = simulator.body_list().iter().filter(|&&body| simulator.is_asleep(body));
            asleep.for_each(|&body| mark(simulator[body].position().into(), canvas));
        }
    }

    fn draw_depth(&self, simulator: &TwoHalfPhysicsSimulator, canvas: &mut dyn Canvas) {
        DebugView {
            enable_ground_view: false,
            enable_virtual_geom_view: self.boxes,
            enable_box_view: self.boxes,
            box_color: BOX.into(),
            enable_platform_view: self.outlines,
            enable_edge_view: self.outlines,
            edge_color: INK.into(),
            enable_coordinate_axis_view: false,
            enable_contact_view: self.contacts,
            contact_color: CONTACT.into(),
            contact_radius: 3.0,
            ..DebugView::default()
        }
        .draw(simulator, canvas);
        if self.islands {
            simulator.core().islands().iter().for_each(|island| frame(simulator, island, canvas));
        }
        if self.sleep {
            let asleep = simulator.body_list().iter().filter(|&&body| simulator.is_asleep(body));
            asleep
                .filter_map(|&body| simulator.body(body))
                .for_each(|body| mark(body.position().into(), canvas));
        }
    }

    fn draw_islands(
        &self,
        view: &PhysicsSimulatorView,
        simulator: &PhysicsSimulator,
        canvas: &mut dyn Canvas,
    ) {
        if !self.islands {
            return;
        }
        view.draw_islands(simulator, |shape| {
            if let DebugShape::Line { start, end, thickness, color } = shape {
                let line = [start.into(), end.into()];
                canvas.stroke_polyline(&line, false, thickness, &Transform::IDENTITY, color.into());
            }
        });
    }

    fn plane_view(&self) -> PhysicsSimulatorView {
        PhysicsSimulatorView {
            enable_edge_view: self.outlines,
            edge_color: INK,
            enable_vertice_view: false,
            enable_aabb_view: self.boxes,
            aabb_color: BOX,
            aabb_line_thickness: if self.islands { 2.0 } else { 1.0 },
            enable_coordinate_axis_view: false,
            enable_contact_view: self.contacts,
            contact_color: CONTACT,
            contact_radius: 3.0,
            enable_performance_panel_view: false,
            enable_spring_view: self.joints,
            spring_line_color: JOINT,
            enable_revolute_joint_view: self.joints,
            revolute_joint_line_color: JOINT,
            enable_pin_joint_view: self.joints,
            pin_joint_line_color: JOINT,
            enable_slider_joint_view: self.joints,
            slider_joint_line_color: JOINT,
            ..PhysicsSimulatorView::default()
        }
    }
}

/// A frame round the pictures of an island, in the colours of the 2D engine's view.
fn frame(simulator: &TwoHalfPhysicsSimulator, island: &Island, canvas: &mut dyn Canvas) {
    let color = match island.method {
        IslandSolver::Asleep => Color::rgb(60, 110, 255),
        IslandSolver::Ballistic => Color::rgb(150, 150, 150),
        IslandSolver::Articulated => Color::rgb(170, 80, 220),
        IslandSolver::Direct => Color::rgb(40, 200, 80),
        _ => Color::rgb(255, 150, 30),
    };
    let geoms = island.bodies.iter().flat_map(|&body| simulator.core().geoms_of(body));
    let outlines = geoms.filter_map(|&geom| simulator.geom(geom)).flat_map(|geom| geom.screen_outline());
    let bounds = outlines.map(Point::from).fold(None, |bounds: Option<[Point; 2]>, [x, y]| {
        let [[left, top], [right, bottom]] = bounds.unwrap_or([[x, y]; 2]);
        Some([[left.min(x), top.min(y)], [right.max(x), bottom.max(y)]])
    });
    if let Some([[left, top], [right, bottom]]) = bounds {
        let corners = [[left, top], [right, top], [right, bottom], [left, bottom]];
        canvas.stroke_polyline(&corners, true, 2.0, &Transform::IDENTITY, color);
    }
}

/// A Z, the sign of sleep.
fn mark([x, y]: Point, canvas: &mut dyn Canvas) {
    let zigzag = [[x - 4.0, y - 4.0], [x + 4.0, y - 4.0], [x - 4.0, y + 4.0], [x + 4.0, y + 4.0]];
    if zigzag.iter().flatten().all(|number| number.is_finite()) {
        canvas.stroke_polyline(&zigzag, false, 2.0, &Transform::IDENTITY, ASLEEP);
    }
}
