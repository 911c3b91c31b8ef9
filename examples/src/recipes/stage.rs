//! Where a recipe is played, and how it looks.

use twohalf::{BodyId, Drawable, PlatformId, Region, TwoHalfPhysicsSimulator, Vector2};
use twohalf_factories::{Actor, Ball, Figure, Prism, Spawned, SpawnedRope, Thing, spawn, spawn_block};
use twohalf_render::*;

use crate::Result;

const HEIGHT: i32 = 240;
const ANGLE: i32 = 70;
const ZOOM: f32 = 0.62;
/// Front and back of the lane in px of Z.
pub(super) const LANE: [f32; 2] = [0.0, 100.0];

pub(super) const BLUE: Color = Color::rgb(46, 110, 206);
pub(super) const RED: Color = Color::rgb(196, 60, 48);
pub(super) const AMBER: Color = Color::rgb(232, 168, 40);
const WOOD: Color = Color::rgb(182, 128, 70);
const STONE: Color = Color::rgb(140, 134, 134);

pub(super) struct RecipeStage {
    pub(super) simulator: TwoHalfPhysicsSimulator,
    pub(super) actors: Vec<Actor>,
    /// X of the middle of the picture in px.
    pub(super) middle: f32,
    pub(super) patches: Vec<Patch>,
    pub(super) rope: Option<SpawnedRope>,
    colors: Vec<(Drawable, Color)>,
    poses: Vec<Pose>,
}

impl RecipeStage {
    pub(super) fn new(middle: f32) -> Result<Self> {
        let gravity = Vector2::new(0.0, 900.0);
        Ok(RecipeStage {
            simulator: TwoHalfPhysicsSimulator::with_angle_and_gravity(HEIGHT, ANGLE, gravity)?,
            actors: Vec::new(),
            middle,
            patches: Vec::new(),
            rope: None,
            colors: Vec::new(),
            poses: Vec::new(),
        })
    }

    /// An actor of 30 by 60 by 20 px. The first one is the player's.
    pub(super) fn actor(&mut self, place: [f32; 3]) -> Result<Actor> {
        let actor = Actor::spawn(&mut self.simulator, Figure::new([30.0, 60.0, 20.0]).at(place))?;
        let color = if self.actors.is_empty() { BLUE } else { RED };
        self.colors.push((Drawable::Body(actor.thing.body), color));
        self.actors.push(actor);
        self.poses.push(Pose::Walks);
        Ok(actor)
    }

    /// Sets the pose in which an actor is drawn.
    pub(super) fn pose(&mut self, at: usize, pose: Pose) {
        self.poses[at] = pose;
    }

    /// A crate of 30 px and mass 5.
    pub(super) fn crate_box(&mut self, place: [f32; 3]) -> Result<Spawned> {
        self.thing(Prism::new([30.0; 3]).mass(5.0).at(place), WOOD)
    }

    /// A ball of radius 14 px and mass 2.
    pub(super) fn ball(&mut self, place: [f32; 3]) -> Result<Spawned> {
        self.thing(Ball::new(14.0).mass(2.0).restitution(0.6).at(place), AMBER)
    }

    pub(super) fn thing(&mut self, thing: Thing, color: Color) -> Result<Spawned> {
        let made = spawn(&mut self.simulator, thing)?;
        self.colors.push((Drawable::Body(made.body), color));
        Ok(made)
    }

    /// A platform over the whole lane.
    pub(super) fn block(&mut self, x: [f32; 2], y: [f32; 2]) -> Result<PlatformId> {
        Ok(spawn_block(&mut self.simulator, x, y, LANE)?)
    }

    pub(super) fn paint(&mut self, platforms: &[PlatformId], color: Color) {
        self.colors.extend(platforms.iter().map(|&id| (Drawable::Platform(id), color)));
    }

    pub(super) fn region(x: [f32; 2], y: [f32; 2]) -> Result<Region> {
        Ok(Region::new([x[0], y[0], LANE[0]], [x[1], y[1], LANE[1]])?)
    }

    fn is_ball(&self, body: BodyId) -> bool {
        let geom = self.simulator.core().geoms_of(body).first();
        let profile = geom.and_then(|&geom| self.simulator.depth_profile(geom));
        matches!(profile, Some(twohalf::DepthProfile::Round { .. }))
    }

    fn look(&self, thing: Drawable) -> Look {
        let color = self.colors.iter().find(|(known, _)| *known == thing).map(|(_, color)| *color);
        let body = match thing {
            Drawable::Platform(_) => return Look::Solid(PlatformLook::new(color.unwrap_or(STONE))),
            Drawable::Body(body) => body,
        };
        let beads = self.rope.iter().flat_map(|rope| rope.bodies.windows(2));
        if let Some(pair) = beads.into_iter().find(|pair| pair[0] == body) {
            return Look::Line { to: pair[1], color: Color::rgb(120, 90, 50), width: 2.5 };
        }
        let color = color.unwrap_or(WOOD);
        match self.actors.iter().position(|actor| actor.thing.body == body) {
            Some(at) => {
                let Actor { looks_left, stride, walker, stunned, .. } = self.actors[at];
                let pose = match self.poses[at] {
                    _ if stunned > 0.0 => Pose::Reels,
                    Pose::Walks if walker.ledge().is_some() => Pose::Lifts,
                    Pose::Walks if !walker.is_grounded() => Pose::Jumps,
                    pose => pose,
                };
                Look::Figure(twohalf_render::Figure {
                    looks_left,
                    stride,
                    pose,
                    ..twohalf_render::Figure::new(color)
                })
            }
            None if self.is_ball(body) => Look::Ball(color),
            None => Look::Solid(PlatformLook::new(color)),
        }
    }

    pub(super) fn draw(&self, canvas: &mut dyn Canvas) -> Result<()> {
        let [width, height] = canvas.size().map(|side| side as f32);
        let looks_at = [self.middle, HEIGHT as f32 + 4.0 - 0.5 * height / ZOOM];
        let camera = Transform::camera(looks_at, ZOOM, 0.0, [0.5 * width, 0.5 * height]);
        let floor = Color::rgb(206, 196, 178);
        let backdrop = GroundBackdrop {
            sky_top: Color::rgb(188, 214, 236),
            sky_horizon: Color::rgb(188, 214, 236),
            floor_near: floor,
            floor_far: floor,
            spacing: 100.0,
            ..GroundBackdrop::new(LANE[1] + 10.0, ANGLE as f32)
        };
        canvas.clear(backdrop.sky_top);
        draw_ground_backdrop(&mut View::new(canvas).camera(&camera), &backdrop)?;
        let (shadow, waters) = (Scene::soft_shadow(), Water::all_of(&self.simulator));
        let scene = Scene::new(&self.simulator, &shadow).camera(&camera);
        scene.patches(&self.patches).waters(&waters).draw(canvas, |thing| self.look(thing));
        Ok(())
    }
}
