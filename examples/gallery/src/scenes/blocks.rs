//! Scenes of the 2D engine that have no picture of their own: outlines in plain colours, joints and springs.

use conformance::run::Run;
use conformance::scene::Scene;
use examples::{Result, draw_joint, draw_spring, palette};
use farseer_core::math::Vector2;
use farseer_core::{Aabb, BodyId, GeomId, Outline, PhysicsSimulator};
use twohalf_render::{Canvas, Color, Point, Transform};

use crate::play::{Play, Player, World, WorldMut};

const SKY: Color = Color::rgb(34, 42, 56);
const EARTH: Color = Color::rgb(104, 112, 126);
/// Largest side of a picture in px.
const LARGEST: f32 = 1000.0;

/// The source of a scene's steps.
#[derive(Debug, Clone)]
enum Motor {
    /// Physics alone: the simulator, and the length of a step in s.
    Physics(Box<PhysicsSimulator>, f32),
    /// The script of a file.
    File(Box<Run<'static>>),
}

/// A scene in plain colours.
#[derive(Debug, Clone)]
pub(super) struct Blocks {
    motor: Motor,
    rate: u32,
    size: [f32; 2],
    camera: Transform,
}

impl Blocks {
    /// A simulator with `rate` steps a second, and the visible part of its world.
    pub(super) fn new(mut simulator: PhysicsSimulator, rate: u32, seen: [Point; 2]) -> Self {
        // All objects are visible before the first step.
        simulator.update(0.0);
        let (size, camera) = fit(seen);
        Blocks { motor: Motor::Physics(Box::new(simulator), 1.0 / rate as f32), rate, size, camera }
    }

    /// A scene of the format of the tests, with its own methods.
    ///
    /// # Errors
    /// A value of the scene that the engine refuses.
    pub(super) fn of_file(scene: &'static Scene) -> Result<Self> {
        let run = Run::build(scene)?;
        let (size, camera) = fit(bounds(run.simulator()));
        let rate = (1.0 / scene.dt).round().clamp(10.0, 1000.0) as u32;
        Ok(Blocks { motor: Motor::File(Box::new(run)), rate, size, camera })
    }

    /// A scene of the format of the tests whose script is empty, of which this part can be seen.
    ///
    /// # Errors
    /// A value of the scene that the engine refuses.
    pub(super) fn of_scene(scene: &Scene) -> Result<PhysicsSimulator> {
        Ok(Run::build(scene)?.simulator().clone())
    }

    fn simulator(&self) -> &PhysicsSimulator {
        match &self.motor {
            Motor::Physics(simulator, _) => simulator,
            Motor::File(run) => run.simulator(),
        }
    }
}

impl Play for Blocks {
    fn size(&self) -> [f32; 2] {
        self.size
    }

    fn rate(&self) -> u32 {
        self.rate
    }

    fn step(&mut self, _: Player) -> Result<()> {
        match &mut self.motor {
            Motor::Physics(simulator, dt) => simulator.update(*dt),
            Motor::File(run) => {
                run.step()?;
                // The events are not used here.
                run.take_events();
            }
        }
        Ok(())
    }

    fn draw(&self, canvas: &mut dyn Canvas) -> Result<()> {
        // Elsewhere joints are where links touch.
        let shows_joints = matches!(self.motor, Motor::File(_));
        draw_world(self.simulator(), &self.camera, shows_joints, canvas);
        Ok(())
    }

    fn world(&self) -> World<'_> {
        World::Plane(self.simulator())
    }

    fn world_mut(&mut self) -> WorldMut<'_> {
        WorldMut::Plane(match &mut self.motor {
            Motor::Physics(simulator, _) => simulator,
            Motor::File(run) => run.simulator_mut(),
        })
    }

    fn camera(&self) -> Transform {
        self.camera
    }

    fn copy(&self) -> Box<dyn Play> {
        Box::new(self.clone())
    }
}

/// Draws all geoms and, if wanted, joints and springs.
pub(super) fn draw_world(
    simulator: &PhysicsSimulator,
    camera: &Transform,
    shows_joints: bool,
    canvas: &mut dyn Canvas,
) {
    canvas.clear(SKY);
    let mut view = twohalf_render::View::new(canvas).camera(camera);
    for (index, &body) in simulator.body_list().iter().enumerate() {
        let color = if simulator[body].is_static() { EARTH } else { palette(index) };
        let geoms = simulator.geoms_of(body);
        geoms.iter().for_each(|&geom| draw_geom(simulator, body, geom, color, &mut view));
    }
    if shows_joints {
        simulator.joint_list().iter().for_each(|&joint| draw_joint(simulator, joint, &mut view));
        simulator.spring_list().iter().for_each(|&spring| draw_spring(simulator, spring, &mut view));
    }
}

fn draw_geom(simulator: &PhysicsSimulator, body: BodyId, id: GeomId, color: Color, canvas: &mut dyn Canvas) {
    let Some(geom) = simulator.geom(id) else { return };
    let (still, edge) = (Transform::IDENTITY, color.darker(0.35));
    if let Outline::Circle { radius } = geom.outline() {
        let center: Point = geom.position().into();
        let (sin, cos) = simulator[body].rotation().sin_cos();
        let rim = [center[0] + radius * cos, center[1] + radius * sin];
        if center.iter().chain(&rim).all(|number| number.is_finite()) {
            canvas.fill_ellipse(center, [radius; 2], &still, color);
            canvas.stroke_polyline(&[center, rim], false, 1.5, &still, edge);
        }
        return;
    }
    let corners: Vec<Point> = geom.world_vertices().iter().map(|&vertex| vertex.into()).collect();
    if let Outline::Chain { is_closed } = geom.outline() {
        return canvas.stroke_polyline(&corners, is_closed, 3.0, &still, color);
    }
    if corners.iter().flatten().all(|number| number.is_finite()) {
        canvas.fill_polygon(&corners, &still, color);
        canvas.stroke_polyline(&corners, true, 1.0, &still, edge);
    }
}

/// Bounds of all geoms, with a margin.
pub(super) fn bounds(simulator: &PhysicsSimulator) -> [Point; 2] {
    let boxes = simulator.geom_list().iter().filter_map(|&geom| simulator.geom(geom)).map(|geom| geom.aabb());
    let finite = boxes.filter(|all| [all.min, all.max].iter().all(|corner| corner.norm() < 1e5));
    let all = finite.reduce(|a, b| Aabb::from_vertices(&[a.min, a.max, b.min, b.max]));
    let Aabb { min, max } =
        all.unwrap_or(Aabb { min: Vector2::new(-200.0, -200.0), max: Vector2::new(200.0, 200.0) });
    let margin = Vector2::new(1.0, 1.0) * (0.08 * (max - min).norm() + 1.0);
    [(min - margin).into(), (max + margin).into()]
}

/// The size of the picture that shows a part of the world, and its camera.
pub(super) fn fit([low, high]: [Point; 2]) -> ([f32; 2], Transform) {
    let [width, height] = [high[0] - low[0], high[1] - low[1]];
    let zoom = LARGEST / width.max(height).max(1e-3);
    // Not thinner than a third, so that its content remains visible.
    let size = [width, height].map(|side| (zoom * side).max(LARGEST / 3.0).round());
    let middle = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])];
    (size, Transform::camera(middle, zoom, 0.0, size.map(|side| 0.5 * side)))
}
