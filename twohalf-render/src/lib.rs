//! Pictures of 2.5D scenes: canvases, sprites drawn back to front, shadows, backdrops, animations.
//!
//! In order of importance:
//!
//! 1. **A scene can be looked at without a window, a graphics card or a font**: [`SoftwareCanvas`] draws into
//!    memory; [`Animation`] and [`ContactSheet`] write what it shows.
//! 2. **Depth reads**: [`SpriteBatch`] draws back to front, shadows shrink with height ([`shadow_scale`]),
//!    [`draw_ground_backdrop`] draws a floor along the model's Z axis.
//! 3. **Other targets are easy**: everything is drawn through the small [`Canvas`] trait.
//! 4. **Names an XNA game expects**: [`SpriteBatch`], [`Texture2D`], [`Color`], with XNA's meaning of
//!    rotation, origin, scale, tint and layer depth.
//!
//! Screen axes everywhere: x right, y **down**, in px; angles in rad, positive clockwise on the screen.
//! Colours are RGBA8 in sRGB with straight alpha. Bad input never panics: functions that return a [`Result`]
//! refuse it with a [`RenderError`], functions that draw draw nothing.
//!
//! ```
//! use twohalf_render::*;
//!
//! let mut canvas = SoftwareCanvas::new(320, 240)?;
//! draw_ground_backdrop(&mut canvas, &GroundBackdrop::new(150.0, 60.0))?;
//!
//! // A ball of 40 px, 30 px above the floor's point at (160, 180).
//! let ball = Texture2D::ball(40, Color::rgb(210, 60, 50))?;
//! let shadow = Texture2D::shadow(44, 18)?;
//! let size = shadow_scale(30.0, 60.0);
//!
//! let mut batch = SpriteBatch::begin();
//! batch.draw(Sprite { rotation: 0.7, layer_depth: 0.4, ..Sprite::centered(&ball, [160.0, 130.0]) });
//! batch.draw(Sprite { scale: [size, size], layer_depth: 1.0, ..Sprite::centered(&shadow, [160.0, 180.0]) });
//! batch.end(&mut canvas);
//! draw_caption(&mut canvas, "step 1");
//!
//! assert_eq!(canvas.pixel(160, 130).map(|color| color.a), Some(255));
//! # Ok::<(), RenderError>(())
//! ```

#![forbid(unsafe_code)]

mod animation;
mod backdrop;
mod canvas;
mod color;
mod contact_sheet;
mod draw_body;
mod error;
mod png_file;
mod shadow;
mod software;
mod sprite_batch;
mod text;
mod texture;
mod transform;

pub use animation::Animation;
pub use backdrop::{GroundBackdrop, draw_ground_backdrop};
pub use canvas::{Canvas, MAX_COORDINATE};
pub use color::Color;
pub use contact_sheet::ContactSheet;
pub use draw_body::DrawBody;
pub use error::{MAX_PIXELS, MAX_SIDE, RenderError, Result};
pub use shadow::{SHADOW_SCALE_LIMIT, shadow_scale};
pub use software::SoftwareCanvas;
pub use sprite_batch::{Sprite, SpriteBatch};
pub use text::{CHARACTER_SIZE, draw_caption, draw_text, text_size};
pub use texture::Texture2D;
pub use transform::{Point, Transform};
