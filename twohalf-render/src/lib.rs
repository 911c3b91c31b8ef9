//! Pictures of 2.5D scenes: canvases, sprites drawn back to front, shadows, platforms, a debug view, backdrops,
//! animations.
//!
//! In order of importance:
//!
//! 1. **No window, graphics card or font is needed**: [`SoftwareCanvas`] draws into memory; [`Animation`] and
//!    [`ContactSheet`] write files.
//! 2. **Depth is visible**: [`SpriteBatch`] draws back to front. Shadows lie on the ground or on the platform
//!    below, end at its edge ([`DrawBody`]) and shrink with height ([`shadow_scale`]). Platforms are boxes
//!    ([`DrawPlatform`]). [`draw_ground_backdrop`] draws a floor along the model's Z axis, [`DebugView`] the
//!    internal shapes of the engine, [`draw_debug_view`] those of the 2D engine.
//! 3. **Other targets are easy**: all drawing goes through the small [`Canvas`] trait. A [`View`] is one,
//!    too: a camera and a window for any code that draws.
//! 4. **Names an XNA game expects**: [`SpriteBatch`], [`Texture2D`], [`Color`], with XNA's meaning of
//!    rotation, origin, scale, tint and layer depth.
//!
//! Games of the 2D engine alone are drawn with it as well: sprites, cameras, text and textures have no depth.
//! [`PictureBody`] makes bodies from pictures in both engines. The example `plane_game` uses all of these.
//!
//! Screen axes everywhere: x right, y **down**, in px; angles in radians, positive clockwise on the screen.
//! Colours are RGBA8 in sRGB with straight alpha. Bad input never panics: functions that return a [`Result`]
//! refuse it with a [`RenderError`], functions that draw draw nothing.
//!
//! [`Scene`] draws a world with depth in one call. The same by hand, for a game with its own order or
//! shadows: a ball over a platform, drawn in the simulator's order:
//!
//! ```
//! use twohalf::{Drawable, ContactTarget, Platform, TwoHalfPhysicsSimulator, Vector3};
//! use twohalf_factories::{TwoHalfBodyFactory, TwoHalfGeomFactory};
//! use twohalf_render::*;
//!
//! let mut simulator = TwoHalfPhysicsSimulator::with_angle(240, 60)?;
//! let mut textures = TextureStore::default();
//! let picture = Texture2D::ball(40, Color::rgb(210, 60, 50))?;
//! let shadow = textures.add(Texture2D::shadow(44, 18)?);
//!
//! Platform::new(&mut simulator, 120.0, 20.0, 60.0, Vector3::new(130.0, 10.0, 60.0), None)?;
//! let ball = TwoHalfBodyFactory::create_circle_body(&mut simulator, 20.0, 1.0)?;
//! let geom = TwoHalfGeomFactory::create_circle_geom(&mut simulator, ball, 20.0, 24)?;
//! let mut view = simulator.body_mut(ball).unwrap();
//! view.ground_mut().set_object_geom(geom, Some(shadow))?;
//! view.set_position3d(Vector3::new(130.0, 50.0, 60.0));
//! simulator.update(0.0);
//!
//! let mut canvas = SoftwareCanvas::new(320, 240)?;
//! draw_ground_backdrop(&mut canvas, &GroundBackdrop::new(150.0, 60.0))?;
//! let mut batch = SpriteBatch::begin();
//! for drawable in simulator.draw_order() {
//!     match drawable {
//!         Drawable::Platform(id) => {
//!             simulator.draw_platform(&mut batch, id, &PlatformLook::new(Color::rgb(150, 122, 96)), 0.5);
//!         }
//!         Drawable::Body(id) => {
//!             // One on the ground lies behind everything.
//!             let surface = simulator.surface_beneath_body(id).map(|surface| surface.partner);
//!             let layer = if surface == Some(ContactTarget::Ground) { 1.0 } else { 0.5 };
//!             let ([offset, scale], tint) = ([[0.0, 0.0], [1.0, 1.0]], Color::WHITE);
//!             simulator.draw_shadow(&mut batch, &textures, id, geom, offset, scale, tint, layer, true);
//!             simulator.draw_body(&mut batch, id, &picture, 0.5);
//!         }
//!     }
//! }
//! batch.end(&mut canvas);
//! DebugView::default().draw(&simulator, &mut canvas);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A camera that follows
//!
//! The [camera](Transform::camera) looks at a point of the scene in px of the simulator's screen, where
//! bodies have their [`position`](twohalf::TwoHalfBody::position). Here it follows the player, at the height
//! of the floor below, so that it does not hop along with a jump; it stops at the ends of the level. The
//! backdrop is drawn through the same camera; scores and captions are drawn without.
//!
//! ```
//! use twohalf::{Drawable, Platform, TwoHalfPhysicsSimulator, Vector2, Vector3, CharacterSettings, CharacterController, MoveInput};
//! use twohalf_factories::spawn;
//! use twohalf_render::*;
//!
//! const SCREEN: [u32; 2] = [320, 240];
//! const LEVEL: f32 = 2000.0;
//! const STEP: f32 = 1.0 / 60.0;
//! let gravity = Vector2::new(0.0, 900.0);
//! let mut simulator = TwoHalfPhysicsSimulator::with_angle_and_gravity(SCREEN[1] as i32, 70, gravity)?;
//! Platform::new(&mut simulator, 200.0, 40.0, 100.0, Vector3::new(900.0, 0.0, 60.0), None)?;
//! let size = [30.0, 60.0, 20.0];
//! let player = spawn(&mut simulator, twohalf_factories::Figure::new(size).at([60.0, 0.0, 60.0]))?;
//! let mut walker = CharacterController::new(CharacterSettings::default());
//!
//! let mut canvas = SoftwareCanvas::new(SCREEN[0], SCREEN[1])?;
//! let shadow = Scene::soft_shadow();
//! let middle = SCREEN.map(|side| 0.5 * side as f32);
//! let mut looks_at = middle;
//! for frame in 0..240 {
//!     let wish = MoveInput { x: 200.0, jump: frame == 200, ..MoveInput::default() };
//!     simulator.walk(player.body, &mut walker, wish, STEP)?;
//!     simulator.update(STEP);
//!
//!     let floor = simulator.surface_beneath_body(player.body).map_or(0.0, |surface| surface.height);
//!     let mut point = simulator.body(player.body).unwrap().position3d();
//!     point.y = floor;
//!     let goal = simulator.projection().to_screen(point);
//!     // A tenth of the way in each frame, no farther than the ends of the level, and nothing below the ground.
//!     let goal = [goal.x.clamp(middle[0], LEVEL - middle[0]), goal.y.min(middle[1])];
//!     looks_at = [0, 1].map(|axis| looks_at[axis] + 0.1 * (goal[axis] - looks_at[axis]));
//! }
//! let camera = Transform::camera(looks_at, 1.0, 0.0, middle);
//! draw_ground_backdrop(&mut View::new(&mut canvas).camera(&camera), &GroundBackdrop::new(120.0, 70.0))?;
//! let scene = Scene::new(&simulator, &shadow).camera(&camera);
//! scene.draw(&mut canvas, |thing| match thing {
//!     Drawable::Platform(_) => Look::Solid(PlatformLook::new(Color::rgb(150, 122, 96))),
//!     Drawable::Body(_) => Look::Figure(Figure::new(Color::rgb(40, 90, 200))),
//! });
//! draw_caption(&mut canvas, "score 0");
//!
//! // 800 px further to the right, the player is still in the picture, and under the mouse there.
//! let place = simulator.body(player.body).unwrap().position();
//! let seen = camera.apply(place.into());
//! assert!(place.x > 800.0 && seen[0] > 160.0 && seen[0] < 220.0);
//! assert_eq!(scene.pick(seen), Some(Drawable::Body(player.body)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`SoftwareCanvas::save_png`] writes the canvas to a file, [`Animation`] all frames.

#![forbid(unsafe_code)]

mod animation;
mod backdrop;
mod canvas;
mod clip;
mod color;
mod contact_sheet;
mod corners;
mod debug_view;
mod draw_body;
mod draw_platform;
mod error;
mod footprint;
mod hidden;
mod jpeg_file;
mod outline_of_line;
mod picture_body;
mod plane_debug_view;
mod png_file;
mod rectangle;
mod scene;
mod shadow;
mod software;
mod sprite_batch;
mod surface;
mod text;
mod texture;
mod texture_store;
mod transform;
mod view;
mod whole_move;

pub use animation::Animation;
pub use backdrop::{GroundBackdrop, draw_ground_backdrop, draw_parallax_layer};
pub use canvas::{Canvas, MAX_COORDINATE};
pub use clip::clip_to_convex;
pub use color::Color;
pub use contact_sheet::ContactSheet;
pub use debug_view::DebugView;
pub use draw_body::DrawBody;
pub use draw_platform::{DrawPlatform, PlatformLook};
pub use error::{MAX_PIXELS, MAX_SIDE, RenderError, Result};
pub use picture_body::{PictureBody, Tracing};
pub use plane_debug_view::draw_debug_view;
pub use rectangle::Rectangle;
pub use scene::{Figure, Look, Patch, Picture, Pose, Scene, Textures, Water};
pub use shadow::{SHADOW_SCALE_LIMIT, shadow_scale};
pub use software::SoftwareCanvas;
pub use sprite_batch::{Sprite, SpriteBatch};
pub use text::{CHARACTER_SIZE, Text, draw_caption, draw_text, text_size};
pub use texture::Texture2D;
pub use texture_store::TextureStore;
pub use transform::{Point, Transform};
pub use view::View;

/// The example of the README is run with those of the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
