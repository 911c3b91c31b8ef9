//! Scenes in the plane put together by programs, thing by thing.

use super::depth::Surface;
use conformance::scene::{
    BodyShape, BodySpec, GeomShape, GeomSpec, JointKind, JointSettings, JointSpec, Outline, OutlineForm,
    Scene,
};
use conformance::scenes::triangle;
use farseer_core::math::Vector2;

/// A metre in px.
pub(crate) const METRE: f32 = 32.0;
/// Gravity in px/s²: 10 m/s².
pub(crate) const GRAVITY: f32 = 320.0;
/// Friction of everything, unless a scene says otherwise.
pub(crate) const FRICTION: f32 = 0.5;
/// Edges of a circle's outline.
const EDGES: i32 = 24;
/// Thickness of the floor in px: more than anything falls in a step.
const FLOOR: f32 = 2.0 * METRE;

/// A scene being put together. Lengths in px, angles in rad, masses in kg, in either precision: what is computed in double
/// precision is rounded once.
pub(crate) struct Stage {
    scene: Scene,
    surface: Surface,
    has_drag: bool,
}

impl Stage {
    /// An empty scene with gravity.
    pub(crate) fn new() -> Self {
        let mut stage = Stage::without_gravity();
        stage.scene.simulator.gravity = Some(Vector2::new(0.0, GRAVITY));
        stage
    }

    /// An empty scene without gravity.
    pub(crate) fn without_gravity() -> Self {
        let surface = Surface { friction: FRICTION, restitution: 0.0 };
        Stage { scene: Scene::empty("stage", ""), surface, has_drag: true }
    }

    /// With a name.
    pub(crate) fn named(mut self, name: impl Into<String>) -> Self {
        self.scene.name = name.into();
        self
    }

    /// Without the drag that bodies have by default.
    pub(crate) fn without_drag(mut self) -> Self {
        self.has_drag = false;
        self
    }

    /// Friction of everything that is added from now on.
    pub(crate) fn with_friction(mut self, friction: f32) -> Self {
        self.surface.friction = friction;
        self
    }

    /// Friction and restitution of everything that is added from now on.
    pub(crate) fn with_surface(mut self, friction: f64, restitution: f64) -> Self {
        self.surface = Surface { friction: friction as f32, restitution: restitution as f32 };
        self
    }

    /// A static floor about x = 0 whose surface is y = 0.
    pub(crate) fn with_floor(mut self, width: f32) -> Self {
        self.wall([0.0, FLOOR / 2.0], [width, FLOOR]);
        self
    }

    /// A static rectangle. Gives its body.
    pub(crate) fn wall<N: Into<f64>>(&mut self, place: [N; 2], size: [N; 2]) -> usize {
        let body = self.boxed(place, size, 1.0);
        self.scene.bodies[body].is_static = Some(true);
        body
    }

    /// A rectangle of 1 kg per square metre.
    pub(crate) fn solid(&mut self, place: [f32; 2], size: [f32; 2]) -> usize {
        self.boxed(place, size, size[0] * size[1] / (METRE * METRE))
    }

    /// A rectangle.
    pub(crate) fn boxed<N: Into<f64>>(&mut self, place: [N; 2], size: [N; 2], mass: impl Into<f64>) -> usize {
        let ([width, height], mass) = (size.map(rounded), rounded(mass));
        let body = self.body(BodyShape::Rectangle { width, height, mass }, place);
        self.geom(body, GeomShape::Rectangle { width, height });
        body
    }

    /// Rectangles of a metre and of 1 kg, each row with one less than that below: the middle of the lowest row, and from
    /// middle to middle along x and y.
    pub(crate) fn pyramid(&mut self, base: usize, centre: f32, [along, up]: [f32; 2]) {
        for (row, from_middle) in triangle(base) {
            let place = [centre + along * from_middle, -(METRE / 2.0 + up * row as f32)];
            self.solid(place, [METRE, METRE]);
        }
    }

    /// A circle of 1 kg per square metre.
    pub(crate) fn ball(&mut self, place: [f32; 2], radius: f32) -> usize {
        let mass = std::f32::consts::PI * (radius / METRE).powi(2);
        self.disc(place, radius, mass, EDGES)
    }

    /// A circle, in the engine of this workspace a polygon of so many edges.
    pub(crate) fn disc<N: Into<f64>>(
        &mut self,
        place: [N; 2],
        radius: impl Into<f64>,
        mass: impl Into<f64>,
        edges: i32,
    ) -> usize {
        let (radius, mass) = (rounded(radius), rounded(mass));
        let body = self.body(BodyShape::Circle { radius, mass }, place);
        self.geom(body, GeomShape::Circle { radius, edges });
        body
    }

    /// A regular polygon in every engine, given by the distance of its corners and their number, with the mass and inertia
    /// of a circle of 1 kg.
    pub(crate) fn wheel(&mut self, place: [f64; 2], radius: f64, edges: i32) -> usize {
        let radius = rounded(radius);
        let body = self.body(BodyShape::Circle { radius, mass: 1.0 }, place);
        let outline = Outline { form: OutlineForm::Circle { radius, edges }, subdivide: None };
        self.geom(body, GeomShape::Polygon { outline });
        body
    }

    /// A convex polygon of 1 kg, its corners given in the world. Its edges are cut into pieces of 10 px, as those of
    /// ready-made rectangles are into four: distance grids know a face by its vertices alone.
    pub(crate) fn stone(&mut self, corners: &[[f64; 2]]) -> usize {
        let centre = centroid(corners);
        let points = corners.iter().map(|p| vector([p[0] - centre[0], p[1] - centre[1]])).collect();
        let outline = Outline { form: OutlineForm::Points { points }, subdivide: Some(10.0) };
        let body = self.body(BodyShape::Polygon { outline: outline.clone(), mass: 1.0 }, centre);
        self.geom(body, GeomShape::Polygon { outline });
        body
    }

    /// A polygon of a mass, where its points are.
    pub(crate) fn polygon(&mut self, points: &[[f32; 2]], mass: f32) -> usize {
        let points = points.iter().map(|&[x, y]| Vector2::new(x, y)).collect();
        let outline = Outline { form: OutlineForm::Points { points }, subdivide: None };
        self.outlined(outline, mass)
    }

    /// A polygon of a mass, where its outline is.
    pub(crate) fn outlined(&mut self, outline: Outline, mass: f32) -> usize {
        // The factory puts the body where the outline's centroid is.
        let shape = BodyShape::Polygon { outline: outline.clone(), mass };
        self.scene.bodies.push(BodySpec::new(shape));
        let body = self.scene.bodies.len() - 1;
        self.geom(body, GeomShape::Polygon { outline });
        body
    }

    /// A body of a rectangle's mass that nothing touches.
    pub(crate) fn ghost(&mut self, place: [f32; 2], [width, height]: [f32; 2], mass: f32) -> usize {
        self.body(BodyShape::Rectangle { width, height, mass }, place)
    }

    /// A body without geom.
    pub(crate) fn body<N: Into<f64>>(&mut self, shape: BodyShape, place: [N; 2]) -> usize {
        let mut body = BodySpec { position: Some(vector(place)), ..BodySpec::new(shape) };
        if !self.has_drag {
            body.settings.linear_drag = Some(0.0);
            body.settings.rotational_drag = Some(0.0);
        }
        self.scene.bodies.push(body);
        self.scene.bodies.len() - 1
    }

    fn geom(&mut self, body: usize, shape: GeomShape) {
        let mut geom = GeomSpec::new(body, shape);
        geom.settings.friction = Some(self.surface.friction);
        geom.settings.restitution = Some(self.surface.restitution);
        self.scene.geoms.push(geom);
    }

    /// The body that was added last, to be changed.
    pub(crate) fn last(&mut self) -> &mut BodySpec {
        self.scene.bodies.last_mut().expect("a body was added")
    }

    /// The geom that was added last, to be changed.
    pub(crate) fn last_geom(&mut self) -> &mut GeomSpec {
        self.scene.geoms.last_mut().expect("a geom was added")
    }

    /// Two bodies share a point.
    pub(crate) fn hinge(&mut self, body1: usize, body2: usize, [x, y]: [f32; 2]) {
        self.joint(JointKind::Revolute { body1, body2, anchor: Vector2::new(x, y) });
    }

    /// A body turns about a point of the world.
    pub(crate) fn pivot(&mut self, body: usize, [x, y]: [f32; 2]) {
        self.joint(JointKind::FixedRevolute { body, anchor: Vector2::new(x, y) });
    }

    /// Any joint, with the engine's settings.
    pub(crate) fn joint(&mut self, kind: JointKind) {
        self.scene.joints.push(JointSpec { kind, settings: JointSettings::default(), in_simulation: true });
    }

    /// The scene, to be changed directly.
    pub(crate) fn scene_mut(&mut self) -> &mut Scene {
        &mut self.scene
    }

    /// The finished scene.
    pub(crate) fn done(self) -> Scene {
        self.scene
    }
}

fn rounded(value: impl Into<f64>) -> f32 {
    value.into() as f32
}

pub(crate) fn vector<N: Into<f64>>(value: [N; 2]) -> Vector2 {
    Vector2::from(value.map(rounded))
}

fn centroid(corners: &[[f64; 2]]) -> [f64; 2] {
    let (mut sum, mut area) = ([0.0, 0.0], 0.0);
    for (index, a) in corners.iter().enumerate() {
        let b = corners[(index + 1) % corners.len()];
        let cross = a[0] * b[1] - a[1] * b[0];
        area += cross;
        sum = [sum[0] + (a[0] + b[0]) * cross, sum[1] + (a[1] + b[1]) * cross];
    }
    sum.map(|sum| sum / (3.0 * area))
}
