//! Scenes put together by programs, thing by thing.

use conformance::scene::{
    BodyShape, BodySpec, GeomShape, GeomSpec, JointKind, JointSettings, JointSpec, Outline, OutlineForm,
    Scene,
};
use farseer_core::math::Vector2;

/// A metre in px.
pub(super) const METRE: f32 = 32.0;
/// Gravity in px/s²: 10 m/s².
pub(super) const GRAVITY: f32 = 320.0;
/// Friction of everything, unless a scene says otherwise.
pub(super) const FRICTION: f32 = 0.5;
/// Edges of a circle's outline.
const EDGES: i32 = 24;
/// Thickness of the floor in px: more than anything falls in a step.
const FLOOR: f32 = 2.0 * METRE;

/// A scene being put together. Lengths in px, angles in rad, masses in kg.
pub(super) struct Stage {
    scene: Scene,
    friction: f32,
}

impl Stage {
    /// An empty scene with gravity.
    pub(super) fn new() -> Self {
        let mut stage = Stage::without_gravity();
        stage.scene.simulator.gravity = Some(Vector2::new(0.0, GRAVITY));
        stage
    }

    /// An empty scene without gravity.
    pub(super) fn without_gravity() -> Self {
        Stage { scene: Scene::empty("stability", ""), friction: FRICTION }
    }

    /// Friction of everything that is added from now on.
    pub(super) fn with_friction(mut self, friction: f32) -> Self {
        self.friction = friction;
        self
    }

    /// A static floor about x = 0 whose surface is y = 0.
    pub(super) fn with_floor(mut self, width: f32) -> Self {
        self.wall([0.0, FLOOR / 2.0], [width, FLOOR]);
        self
    }

    /// A static rectangle. Gives its body.
    pub(super) fn wall(&mut self, place: [f32; 2], size: [f32; 2]) -> usize {
        let body = self.boxed(place, size, 1.0);
        self.scene.bodies[body].is_static = Some(true);
        body
    }

    /// A rectangle of 1 kg per square metre.
    pub(super) fn solid(&mut self, place: [f32; 2], size: [f32; 2]) -> usize {
        self.boxed(place, size, size[0] * size[1] / (METRE * METRE))
    }

    /// A rectangle.
    pub(super) fn boxed(&mut self, place: [f32; 2], [width, height]: [f32; 2], mass: f32) -> usize {
        let body = self.body(BodyShape::Rectangle { width, height, mass }, place);
        self.geom(body, GeomShape::Rectangle { width, height });
        body
    }

    /// A circle of 1 kg per square metre.
    pub(super) fn ball(&mut self, place: [f32; 2], radius: f32) -> usize {
        let mass = std::f32::consts::PI * (radius / METRE).powi(2);
        let body = self.body(BodyShape::Circle { radius, mass }, place);
        self.geom(body, GeomShape::Circle { radius, edges: EDGES });
        body
    }

    /// A polygon of a mass, where its points are.
    pub(super) fn polygon(&mut self, points: &[[f32; 2]], mass: f32) -> usize {
        let points = points.iter().map(|&[x, y]| Vector2::new(x, y)).collect();
        let outline = Outline { form: OutlineForm::Points { points }, subdivide: None };
        self.outlined(outline, mass)
    }

    /// A polygon of a mass, where its outline is.
    pub(super) fn outlined(&mut self, outline: Outline, mass: f32) -> usize {
        // The factory puts the body where the outline's centroid is.
        let shape = BodyShape::Polygon { outline: outline.clone(), mass };
        self.scene.bodies.push(BodySpec::new(shape));
        let body = self.scene.bodies.len() - 1;
        self.geom(body, GeomShape::Polygon { outline });
        body
    }

    /// A body of a rectangle's mass that nothing touches.
    pub(super) fn ghost(&mut self, place: [f32; 2], [width, height]: [f32; 2], mass: f32) -> usize {
        self.body(BodyShape::Rectangle { width, height, mass }, place)
    }

    /// A body without geom.
    fn body(&mut self, shape: BodyShape, [x, y]: [f32; 2]) -> usize {
        self.scene.bodies.push(BodySpec { position: Some(Vector2::new(x, y)), ..BodySpec::new(shape) });
        self.scene.bodies.len() - 1
    }

    fn geom(&mut self, body: usize, shape: GeomShape) {
        let mut geom = GeomSpec::new(body, shape);
        geom.settings.friction = Some(self.friction);
        geom.settings.restitution = Some(0.0);
        self.scene.geoms.push(geom);
    }

    /// The body that was added last, to be changed.
    pub(super) fn last(&mut self) -> &mut BodySpec {
        self.scene.bodies.last_mut().expect("a body was added")
    }

    /// The geom that was added last, to be changed.
    pub(super) fn last_geom(&mut self) -> &mut GeomSpec {
        self.scene.geoms.last_mut().expect("a geom was added")
    }

    /// Two bodies share a point.
    pub(super) fn hinge(&mut self, body1: usize, body2: usize, [x, y]: [f32; 2]) {
        self.joint(JointKind::Revolute { body1, body2, anchor: Vector2::new(x, y) });
    }

    /// A body turns about a point of the world.
    pub(super) fn pivot(&mut self, body: usize, [x, y]: [f32; 2]) {
        self.joint(JointKind::FixedRevolute { body, anchor: Vector2::new(x, y) });
    }

    /// Any joint, with the engine's settings.
    pub(super) fn joint(&mut self, kind: JointKind) {
        self.scene.joints.push(JointSpec { kind, settings: JointSettings::default(), in_simulation: true });
    }

    /// The scene, to be changed directly.
    pub(super) fn scene_mut(&mut self) -> &mut Scene {
        &mut self.scene
    }

    /// The finished scene.
    pub(super) fn done(self) -> Scene {
        self.scene
    }
}
