//! A scene of the 2.5D engine in one call: its order, its shadows, and how each thing looks.

mod facet;
mod figure;
mod look;
mod patch;
mod shadows;
mod solid;
mod solids;
mod upright;
mod water;

pub use look::{Figure, Look, Picture, Pose, Textures};
pub use patch::Patch;
pub use water::Water;

use twohalf::{
    BodyId, Drawable, InterpolatedPose3D, Interpolation3D, PlatformId, TwoHalfPhysicsSimulator, Vector3,
};

use crate::hidden::Within;
use crate::surface::{to_screen, turned};
use crate::{Canvas, Point, Sprite, Texture2D, Transform, View};
use shadows::{Cast, SHADOW_SIZE};
use solids::Solids;
use water::{Part, Place};

/// The scene of a 2.5D simulator: its bodies and platforms, drawn back to front with their shadows.
///
/// ```
/// # use twohalf::*;
/// # use twohalf_factories::*;
/// # use twohalf_render::*;
/// # let mut simulator = TwoHalfPhysicsSimulator::new(240)?;
/// # Platform::new(&mut simulator, 120.0, 20.0, 60.0, Vector3::new(130.0, 10.0, 60.0), None)?;
/// # let ball = TwoHalfBodyFactory::create_circle_body(&mut simulator, 20.0, 1.0)?;
/// # let geom = TwoHalfGeomFactory::create_circle_geom(&mut simulator, ball, 20.0, 24)?;
/// # simulator.body_mut(ball).unwrap().ground_mut().set_object_geom(geom, None)?;
/// # simulator.update(0.0);
/// # let mut canvas = SoftwareCanvas::new(320, 240)?;
/// let camera = Transform::camera([160.0, 120.0], 1.0, 0.0, [160.0, 120.0]);
/// let shadow = Scene::soft_shadow();
/// Scene::new(&simulator, &shadow).camera(&camera).draw(&mut canvas, |thing| match thing {
///     Drawable::Platform(_) => Look::Solid(PlatformLook::new(Color::rgb(150, 122, 96))),
///     Drawable::Body(_) => Look::Ball(Color::rgb(210, 60, 50)),
/// });
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Bodies are drawn once they take part: from the first update after their creation, which may be
/// `update(0.0)`. The ground hides the part of a platform that lies below it. A platform that is drawn as an
/// opaque [`Look::Solid`] or [`Look::Textured`] hides the parts of other platforms inside of it. So of a lift
/// in a street, and of a slope that leads up from it, only the part above the street is seen. A backdrop
/// scrolls with the scene if it is drawn through the same camera: [a camera that
/// follows](crate#a-camera-that-follows).
///
/// Light comes from straight above. The shadow of a body lies on the highest surface beneath its middle: the
/// ground, a platform, or the level top of another body drawn as a [`Look::Solid`] or [`Look::Textured`]. It
/// ends at the edge of that surface and shrinks with height ([`shadow_scale`](crate::shadow_scale)). The
/// shadow of a platform is as large as the platform. It lies on the ground and, if the platform hangs in the
/// air, on all platforms and such tops beneath it.
#[derive(Debug, Clone)]
pub struct Scene<'a> {
    simulator: &'a TwoHalfPhysicsSimulator,
    shadow: &'a Texture2D,
    camera: Transform,
    patches: &'a [Patch],
    waters: &'a [Water],
    between: Option<(&'a Interpolation3D, f32)>,
}

/// Displacement between the drawn and the simulated pose of a body or platform, px of the world, and its
/// rotation, radians.
#[derive(Debug, Clone, Copy, Default)]
struct Shift {
    way: Vector3,
    turn: f32,
    /// Rotation of a platform about the upright axis, radians.
    yaw: f32,
}

/// An item of the drawing order: a part of a body or platform, by its index in the order, or water.
#[derive(Clone, Copy)]
enum Layer<'a> {
    Thing(usize, Part),
    Water(&'a Water),
}

impl<'a> Scene<'a> {
    /// The scene as the simulator projects it. The given picture is used for all shadows, stretched over the
    /// footprint of each body.
    pub fn new(simulator: &'a TwoHalfPhysicsSimulator, shadow: &'a Texture2D) -> Self {
        Scene { simulator, shadow, camera: Transform::IDENTITY, patches: &[], waters: &[], between: None }
    }

    /// A soft round shadow, to be made once.
    pub fn soft_shadow() -> Texture2D {
        // Texture sizes within the limits are not refused.
        Texture2D::shadow(SHADOW_SIZE[0], SHADOW_SIZE[1]).unwrap_or_else(|_| Texture2D::stand_in())
    }

    /// The same through a camera; see [`Transform::camera`].
    pub fn camera(self, camera: &Transform) -> Self {
        Scene { camera: *camera, ..self }
    }

    /// The same with holes, water and other things in the ground, which are drawn in this order before everything.
    pub fn patches(self, patches: &'a [Patch]) -> Self {
        Scene { patches, ..self }
    }

    /// The same with boxes that are seen through, which are drawn in this order.
    pub fn waters(self, waters: &'a [Water]) -> Self {
        Scene { waters, ..self }
    }

    /// The same with bodies and platforms interpolated between the last two updates, for games that draw more
    /// often than they update. A [clock](twohalf::FixedStepClock) tells the fraction of the next step that
    /// has passed.
    ///
    /// Positions and rotations are interpolated. A body or platform that the interpolation does not remember
    /// is drawn at its present pose. The drawing order and [`pick`](Self::pick) use the poses after the last
    /// update.
    ///
    /// ```
    /// # use twohalf::*;
    /// # use twohalf_factories::*;
    /// # use twohalf_render::*;
    /// # use std::time::Duration;
    /// # let mut simulator = TwoHalfPhysicsSimulator::with_gravity(240, Vector2::new(0.0, 900.0))?;
    /// # spawn(&mut simulator, Prism::new([40.0; 3]).mass(5.0).at([100.0, 90.0, 60.0]))?;
    /// # let mut canvas = SoftwareCanvas::new(320, 240)?;
    /// # let shadow = Scene::soft_shadow();
    /// let mut clock = FixedStepClock::default();
    /// let mut interpolation = Interpolation3D::new();
    /// // In each frame, with the time since the one before:
    /// # for _ in 0..5 {
    /// # let elapsed = Duration::from_millis(7);
    /// for _ in 0..clock.advance(elapsed) {
    ///     simulator.update(clock.dt());
    ///     interpolation.remember(&simulator);
    /// }
    /// let scene = Scene::new(&simulator, &shadow).between(&interpolation, clock.interpolation());
    /// scene.draw(&mut canvas, |_| Look::Solid(PlatformLook::new(Color::rgb(176, 118, 64))));
    /// # }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn between(self, interpolation: &'a Interpolation3D, fraction: f32) -> Self {
        Scene { between: Some((interpolation, fraction)), ..self }
    }

    fn shift(&self, thing: Drawable) -> Shift {
        let pose = self.between.and_then(|(interpolation, fraction)| {
            let now = interpolation.pose(thing, 1.0)?;
            Some((now, interpolation.pose(thing, fraction)?))
        });
        let shift = |(now, shown): (InterpolatedPose3D, InterpolatedPose3D)| Shift {
            way: shown.place - now.place,
            turn: shown.rotation - now.rotation,
            yaw: shown.yaw - now.yaw,
        };
        pose.map(shift).unwrap_or_default()
    }

    /// The corners of a platform as it is drawn, but at its simulated position: its rotation is interpolated,
    /// its position is not.
    fn corners(&self, id: PlatformId) -> Option<[Vector3; 8]> {
        let corners = self.simulator.platform(id)?.corners();
        let Shift { turn, yaw, .. } = self.shift(Drawable::Platform(id));
        Some(turned(&corners, turn, yaw))
    }

    /// The projection of a displacement of the world to the screen.
    fn on_screen(&self, way: Vector3) -> Point {
        let [x, y] = to_screen(self.simulator, Vector3::zeros());
        let [to_x, to_y] = to_screen(self.simulator, way);
        [to_x - x, to_y - y]
    }

    /// The foremost body or platform at a point of the canvas (px), for example under the mouse. `None` with
    /// a camera that has no inverse.
    pub fn pick(&self, point: impl Into<Point>) -> Option<Drawable> {
        let [x, y] = self.camera.inverse()?.apply(point.into());
        self.simulator.pick_front(twohalf::Vector2::new(x, y))
    }

    /// Draws everything. The function `look` returns the look of each body and platform and is called once
    /// for each.
    pub fn draw(&self, canvas: &mut dyn Canvas, mut look: impl FnMut(Drawable) -> Look) {
        let mut view = View::new(canvas).camera(&self.camera);
        let order = self.simulator.draw_order();
        let things: Vec<(Drawable, Look)> = order.into_iter().map(|thing| (thing, look(thing))).collect();
        let casts = Cast::all(self, &things);
        let solids = Solids::all(self, &things);
        let on = |surface: Option<Drawable>| casts.iter().filter(move |cast| cast.surface == surface);
        self.patches.iter().for_each(|patch| patch.draw(self.simulator, &mut view));
        on(None).for_each(|cast| self.shadow(cast, Vector3::zeros()).draw(&mut view));
        for item in self.in_layers(&things) {
            let ((thing, look), part) = match item {
                Layer::Water(water) => {
                    water.draw(self.simulator, &mut view);
                    continue;
                }
                Layer::Thing(at, part) => (&things[at], part),
            };
            let shift = self.shift(*thing);
            let moved = Transform::translation(self.on_screen(shift.way));
            let mut view = View::new(&mut view).camera(&moved);
            if part.rows != Part::ALL.rows {
                view = view.clip_rows(part.rows);
            }
            match thing {
                Drawable::Platform(id) => {
                    let around = solids.around(*id, self.corners(*id), shift.way);
                    let heights = part.heights.map(|height| height - shift.way.y);
                    self.draw_platform(&mut view, *id, Within { solids: &around, heights }, look)
                }
                Drawable::Body(id) => self.draw_body(&mut view, *id, look, shift),
            }
            let casts = on(Some(*thing)).filter(|cast| part.holds(cast.height + shift.way.y));
            casts.for_each(|cast| self.shadow(cast, shift.way).draw(&mut view));
        }
    }

    /// The shadow of a body on a surface. The shadow moves with the interpolated body, its clip polygon with
    /// the interpolated surface (`surface` is the latter's displacement).
    fn shadow(&self, cast: &Cast, surface: Vector3) -> Sprite {
        let way = self.shift(cast.of).way - surface;
        let [x, y] = self.on_screen(Vector3::new(way.x, 0.0, way.z));
        let moved = |point: Point| [point[0] + x, point[1] + y];
        let mut sprite = cast.sprite.clone();
        sprite.position = moved(sprite.position);
        if let (Drawable::Platform(_), Some(outline)) = (cast.of, &mut sprite.clip) {
            outline.iter_mut().for_each(|corner| *corner = moved(*corner));
        }
        sprite
    }

    /// The bodies and platforms in their order, together with the waters. Before each water come the parts
    /// under its surface that are under no earlier one; at the end come the parts above all surfaces.
    fn in_layers(&self, things: &[(Drawable, Look)]) -> Vec<Layer<'a>> {
        let mut under: Vec<Vec<Layer<'a>>> = vec![Vec::new(); self.waters.len()];
        let mut over = Vec::with_capacity(things.len());
        for (at, (thing, look)) in things.iter().enumerate() {
            let mut rest = Some(Part::ALL);
            for (water, under) in self.waters.iter().zip(&mut under) {
                let Some(part) = rest else { break };
                match water.place_of(self, *thing, look) {
                    Place::Over => {}
                    Place::Under => {
                        under.push(Layer::Thing(at, part));
                        rest = None;
                    }
                    Place::Through { row } => {
                        let [below, out] = water.split(part, row);
                        under.push(Layer::Thing(at, below));
                        rest = Some(out);
                    }
                }
            }
            over.extend(rest.map(|part| Layer::Thing(at, part)));
        }
        let waters = under.into_iter().zip(self.waters);
        let layers = waters.flat_map(|(under, water)| under.into_iter().chain([Layer::Water(water)]));
        layers.chain(over).collect()
    }

    fn draw_platform(&self, canvas: &mut dyn Canvas, id: PlatformId, within: Within<'_>, look: &Look) {
        if let Some((platform, corners)) = self.simulator.platform(id).zip(self.corners(id)) {
            solid::draw_platform(self.simulator, canvas, (platform, &corners), within, look);
        }
    }

    fn draw_body(&self, canvas: &mut dyn Canvas, id: BodyId, look: &Look, shift: Shift) {
        let turn = shift.turn;
        match look {
            Look::Nothing => (),
            Look::Picture(picture) => {
                if let Some(mut sprite) = self.sprite(id, picture) {
                    sprite.rotation += if picture.stands { 0.0 } else { turn };
                    sprite.draw(canvas);
                }
            }
            Look::Solid(look) => solid::draw_body(self.simulator, canvas, id, turn, look, None),
            Look::Textured(look, textures) => {
                solid::draw_body(self.simulator, canvas, id, turn, look, Some(textures))
            }
            Look::Ball(color) => solid::draw_ball(self.simulator, canvas, id, turn, *color),
            Look::Figure(figure) => figure::draw_figure(self.simulator, canvas, id, figure),
            Look::Line { to, color, width } => {
                let aside = self.on_screen(self.shift(Drawable::Body(*to)).way - shift.way);
                solid::draw_line(self.simulator, canvas, [id, *to], aside, *width, *color)
            }
        }
    }

    fn sprite(&self, id: BodyId, picture: &Picture) -> Option<Sprite> {
        let body = self.simulator.body(id)?;
        let [width, height] = picture.size();
        let (position, origin, rotation) = if picture.stands {
            let feet = self.simulator.projection().to_screen(body.position3d());
            (feet, [0.5 * width, height], 0.0)
        } else {
            (body.position(), [0.5 * width, 0.5 * height], body.rotation())
        };
        let mirror = if picture.flip { -1.0 } else { 1.0 };
        Some(Sprite {
            source: picture.source,
            origin,
            rotation,
            scale: [mirror * picture.scale, picture.scale],
            tint: picture.tint,
            ..Sprite::new(&picture.texture, position)
        })
    }
}
