//! Builds 2D scenes body by body.

use super::depth::Surface;
use conformance::scene::{
    BodyShape, BodySpec, GeomShape, GeomSpec, JointKind, JointSettings, JointSpec, Outline, OutlineForm,
    Scene,
};
use conformance::scenes::triangle;
use farseer_core::math::Vector2;

/// Length of a metre in px.
pub(crate) const METRE: f32 = 32.0;
/// Acceleration of gravity in px/s², downwards: 10 m/s².
pub(crate) const GRAVITY: f32 = 320.0;
/// Friction coefficient of all geoms, dimensionless, unless a scene sets another one.
pub(crate) const FRICTION: f32 = 0.5;
/// Number of edges of the polygon that stands for a circle.
const EDGES: i32 = 24;
/// Thickness of the floor in px: more than a body falls in a step.
const FLOOR: f32 = 2.0 * METRE;

/// A 2D scene under construction. Lengths are px with y down, angles radians, masses kg. Arguments may be single or double
/// precision; double precision is rounded once.
pub(crate) struct Stage {
    scene: Scene,
    surface: Surface,
    has_drag: bool,
}

impl Stage {
    /// Returns an empty scene with gravity [`GRAVITY`].
    pub(crate) fn new() -> Self {
        let mut stage = Stage::without_gravity();
        stage.scene.simulator.gravity = Some(Vector2::new(0.0, GRAVITY));
        stage
    }

    /// Returns an empty scene without gravity.
    pub(crate) fn without_gravity() -> Self {
        let surface = Surface { friction: FRICTION, restitution: 0.0 };
        Stage { scene: Scene::empty("stage", ""), surface, has_drag: true }
    }

    /// Returns the scene with a name.
    pub(crate) fn named(mut self, name: impl Into<String>) -> Self {
        self.scene.name = name.into();
        self
    }

    /// Sets the default drag of bodies to 0.
    pub(crate) fn without_drag(mut self) -> Self {
        self.has_drag = false;
        self
    }

    /// Sets the friction coefficient of the geoms that are added afterwards.
    pub(crate) fn with_friction(mut self, friction: f32) -> Self {
        self.surface.friction = friction;
        self
    }

    /// Sets friction and restitution of the geoms that are added afterwards.
    pub(crate) fn with_surface(mut self, friction: f64, restitution: f64) -> Self {
        self.surface = Surface { friction: friction as f32, restitution: restitution as f32 };
        self
    }

    /// Adds a static floor of `width` px, centred at x = 0, whose surface is y = 0.
    pub(crate) fn with_floor(mut self, width: f32) -> Self {
        self.wall([0.0, FLOOR / 2.0], [width, FLOOR]);
        self
    }

    /// Adds a static rectangle with the centre `place` and the extents `size`, px. Returns the index of its body.
    pub(crate) fn wall<N: Into<f64>>(&mut self, place: [N; 2], size: [N; 2]) -> usize {
        let body = self.boxed(place, size, 1.0);
        self.scene.bodies[body].is_static = Some(true);
        body
    }

    /// Adds a rectangle of 1 kg per square metre, with the centre `place` and the extents `size`, px. Returns the index
    /// of its body.
    pub(crate) fn solid(&mut self, place: [f32; 2], size: [f32; 2]) -> usize {
        self.boxed(place, size, size[0] * size[1] / (METRE * METRE))
    }

    /// Adds a rectangle with the centre `place` and the extents `size`, px, and the mass `mass`, kg. Returns the index
    /// of its body.
    pub(crate) fn boxed<N: Into<f64>>(&mut self, place: [N; 2], size: [N; 2], mass: impl Into<f64>) -> usize {
        let ([width, height], mass) = (size.map(rounded), rounded(mass));
        let body = self.body(BodyShape::Rectangle { width, height, mass }, place);
        self.geom(body, GeomShape::Rectangle { width, height });
        body
    }

    /// Adds a pyramid of squares of 1 m and 1 kg. `base` is the number in the lowest row, whose middle is at x =
    /// `centre` px. `along` and `up` are the distances from centre to centre along x and y, px.
    pub(crate) fn pyramid(&mut self, base: usize, centre: f32, [along, up]: [f32; 2]) {
        for (row, from_middle) in triangle(base) {
            let place = [centre + along * from_middle, -(METRE / 2.0 + up * row as f32)];
            self.solid(place, [METRE, METRE]);
        }
    }

    /// Adds a circle of 1 kg per square metre, with the centre `place` and the radius `radius`, px. Returns the index
    /// of its body.
    pub(crate) fn ball(&mut self, place: [f32; 2], radius: f32) -> usize {
        let mass = std::f32::consts::PI * (radius / METRE).powi(2);
        self.disc(place, radius, mass, EDGES)
    }

    /// Adds a circle with a mass. In the engine of this workspace it is a polygon. Returns the index of its body.
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

    /// Adds a regular polygon that is a polygon in every engine, with `radius` px from centre to corner. It has the
    /// mass and moment of inertia of a circle of 1 kg. Returns the index of its body.
    pub(crate) fn wheel(&mut self, place: [f64; 2], radius: f64, edges: i32) -> usize {
        let radius = rounded(radius);
        let body = self.body(BodyShape::Circle { radius, mass: 1.0 }, place);
        let outline = Outline { form: OutlineForm::Circle { radius, edges }, subdivide: None };
        self.geom(body, GeomShape::Polygon { outline });
        body
    }

    /// Adds a convex polygon of 1 kg with `corners` in px in the world. Its edges are subdivided every 10 px, because
    /// distance grids test the vertices alone. Returns the index of its body.
    pub(crate) fn stone(&mut self, corners: &[[f64; 2]]) -> usize {
        let centre = centroid(corners);
        let points = corners.iter().map(|p| vector([p[0] - centre[0], p[1] - centre[1]])).collect();
        let outline = Outline { form: OutlineForm::Points { points }, subdivide: Some(10.0) };
        let body = self.body(BodyShape::Polygon { outline: outline.clone(), mass: 1.0 }, centre);
        self.geom(body, GeomShape::Polygon { outline });
        body
    }

    /// Adds a polygon of `mass` kg with `points` in px in the world. Returns the index of its body.
    pub(crate) fn polygon(&mut self, points: &[[f32; 2]], mass: f32) -> usize {
        let points = points.iter().map(|&[x, y]| Vector2::new(x, y)).collect();
        let outline = Outline { form: OutlineForm::Points { points }, subdivide: None };
        self.outlined(outline, mass)
    }

    /// Adds a polygon of `mass` kg at the centroid of `outline`, whose points are px in the world. Returns the index of
    /// its body.
    pub(crate) fn outlined(&mut self, outline: Outline, mass: f32) -> usize {
        // The factory puts the body where the outline's centroid is.
        let shape = BodyShape::Polygon { outline: outline.clone(), mass };
        self.scene.bodies.push(BodySpec::new(shape));
        let body = self.scene.bodies.len() - 1;
        self.geom(body, GeomShape::Polygon { outline });
        body
    }

    /// Adds a body with the mass and inertia of a rectangle, without a geom: it does not collide. Returns the index of
    /// the body.
    pub(crate) fn ghost(&mut self, place: [f32; 2], [width, height]: [f32; 2], mass: f32) -> usize {
        self.body(BodyShape::Rectangle { width, height, mass }, place)
    }

    /// Adds a body without a geom at `place` px. Returns the index of the body.
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

    /// Returns the body that was added last, so that the caller can change it.
    pub(crate) fn last(&mut self) -> &mut BodySpec {
        self.scene.bodies.last_mut().expect("a body was added")
    }

    /// Returns the geom that was added last, so that the caller can change it.
    pub(crate) fn last_geom(&mut self) -> &mut GeomSpec {
        self.scene.geoms.last_mut().expect("a geom was added")
    }

    /// Connects two bodies by a revolute joint at `[x, y]` px in the world.
    pub(crate) fn hinge(&mut self, body1: usize, body2: usize, [x, y]: [f32; 2]) {
        self.joint(JointKind::Revolute { body1, body2, anchor: Vector2::new(x, y) });
    }

    /// Connects a body to the world by a revolute joint at `[x, y]` px in the world.
    pub(crate) fn pivot(&mut self, body: usize, [x, y]: [f32; 2]) {
        self.joint(JointKind::FixedRevolute { body, anchor: Vector2::new(x, y) });
    }

    /// Adds a joint with the default settings of the engine.
    pub(crate) fn joint(&mut self, kind: JointKind) {
        self.scene.joints.push(JointSpec { kind, settings: JointSettings::default(), in_simulation: true });
    }

    /// Returns the scene, so that the caller can change it directly.
    pub(crate) fn scene_mut(&mut self) -> &mut Scene {
        &mut self.scene
    }

    /// Returns the finished scene.
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
