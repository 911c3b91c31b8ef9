//! Textures made by computation, for scenes that have no pictures.

use super::Texture2D;
use crate::error::{check_range, check_size};
use crate::{Color, Result};

/// Number of samples per pixel and axis; they smooth the edges inside a texture.
const SAMPLES: u32 = 4;

/// Opacity of a shadow under its middle, 0 to 1 (a factor).
const SHADOW_OPACITY: f32 = 0.62;

/// Width over which the shadow of a box fades inside and outside of its edge, px.
const SOFT_EDGE: f32 = 8.0;

/// Number of sectors of a ball; every other one is pale.
const BALL_SECTORS: u8 = 6;

impl Texture2D {
    /// A beach ball seen along its axis: sectors of `base` and a pale tone, one of them darker as a mark, so
    /// that rotation and its sense can be seen. It darkens evenly towards the rim, so the shading does not
    /// turn with the ball; [`Texture2D::ball_light`] adds light from above.
    ///
    /// `diameter` in px; the ball fills the square texture. The alpha of `base` is ignored.
    ///
    /// # Errors
    /// `diameter` is 0 or too large (see [`SoftwareCanvas::new`](crate::SoftwareCanvas::new)).
    pub fn ball(diameter: u32, base: Color) -> Result<Self> {
        let [base, pale] = [base.with_alpha(255), base.with_alpha(255).lerp(Color::rgb(255, 250, 240), 0.82)];
        generate(diameter, diameter, |[x, y]| {
            let [u, v] = [2.0 * x - 1.0, 2.0 * y - 1.0];
            let radius = (u * u + v * v).sqrt();
            if radius > 1.0 {
                return Color::TRANSPARENT;
            }
            let turn = libm::atan2(v.into(), u.into()) / std::f64::consts::TAU + 0.5;
            let sector = (turn * f64::from(BALL_SECTORS)) as u8 % BALL_SECTORS;
            let paint = match sector {
                _ if radius < 0.2 => base.darker(0.15),
                0 => base.darker(0.45),
                2 | 4 => base,
                _ => pale,
            };
            // Cosine of the angle between the surface and the viewer: 1 in the middle, 0 at the rim.
            let facing = (1.0 - radius * radius).sqrt();
            paint.darker(0.55 * (1.0 - facing) * (1.0 - facing) + 0.1 * (1.0 - facing))
        })
    }

    /// A stand-in for a missing picture: 32 x 32 px, magenta and black in squares of 8 px.
    pub fn stand_in() -> Self {
        let square = |x: usize, y: usize| {
            if (x / 8 + y / 8).is_multiple_of(2) { [255, 0, 255, 255] } else { [0, 0, 0, 255] }
        };
        let pixels: Vec<[u8; 4]> = (0..32).flat_map(|y| (0..32).map(move |x| square(x, y))).collect();
        Texture2D::opaque(32, 32, pixels.concat())
    }

    /// Light from the upper left on a ball, to be drawn over it, not rotated: a soft highlight, and shade on
    /// the far side. `diameter` in px as that of the ball.
    ///
    /// # Errors
    /// As [`Texture2D::ball`].
    pub fn ball_light(diameter: u32) -> Result<Self> {
        generate(diameter, diameter, |[x, y]| {
            let [u, v] = [2.0 * x - 1.0, 2.0 * y - 1.0];
            let squared = u * u + v * v;
            if squared > 1.0 {
                return Color::TRANSPARENT;
            }
            // Lambert's law with the light at (-0.45, -0.65, 0.61), a unit vector.
            let lit = -0.45 * u - 0.65 * v + 0.61 * (1.0 - squared).sqrt();
            let highlight = ((lit - 0.72) / 0.28).clamp(0.0, 1.0);
            let shade = ((0.55 - lit) / 1.35).clamp(0.0, 1.0);
            if highlight > 0.0 {
                Color::WHITE.with_opacity(0.65 * highlight * highlight)
            } else {
                Color::rgb(20, 16, 40).with_opacity(0.62 * shade)
            }
        })
    }

    /// A wooden crate seen from the front: a frame, planks and a brace from the lower left to the upper right
    /// corner.
    ///
    /// `width` and `height` in px; the alpha of `base` is ignored.
    ///
    /// # Errors
    /// A side is 0 or too large (see [`SoftwareCanvas::new`](crate::SoftwareCanvas::new)).
    pub fn crate_box(width: u32, height: u32, base: Color) -> Result<Self> {
        let base = base.with_alpha(255);
        let [w, h] = [width as f32, height as f32];
        generate(width, height, |[x, y]| crate_front([x * w, y * h], [w, h], base))
    }

    /// A soft elliptical shadow that fills the texture: black, densest in the middle, fading to nothing at
    /// the rim.
    ///
    /// `width` and `height` in px. About 1.1 times as wide as the object and a third to a half as high as
    /// wide looks right on a floor seen at a flat angle.
    ///
    /// # Errors
    /// A side is 0 or too large (see [`SoftwareCanvas::new`](crate::SoftwareCanvas::new)).
    pub fn shadow(width: u32, height: u32) -> Result<Self> {
        generate(width, height, |[x, y]| {
            let [u, v] = [2.0 * x - 1.0, 2.0 * y - 1.0];
            let inside = (1.0 - u * u - v * v).max(0.0);
            Color::BLACK.with_opacity(SHADOW_OPACITY * inside * inside.sqrt())
        })
    }

    /// The shadow of a level box on level ground: black with a soft edge. Its shape is the box's footprint,
    /// seen with a Z axis at `angle` degrees on the screen, counterclockwise from the x axis. It serves as a
    /// platform's shadow image.
    ///
    /// `width` and `depth` in px. The texture is larger by the soft edge, 8 px on every side, and by what the
    /// footprint leans.
    ///
    /// # Errors
    /// An angle that is not between 0 and 180; a width or depth of 0, or a texture that would be too large (see
    /// [`SoftwareCanvas::new`](crate::SoftwareCanvas::new)).
    pub fn box_shadow(width: u32, depth: u32, angle: f32) -> Result<Self> {
        check_range("angle", angle, f32::MIN_POSITIVE..=180.0_f32.next_down(), "between 0 and 180 degrees")?;
        check_size(width, depth)?;
        let (sin, cos) = libm::sincos(f64::from(angle).to_radians());
        let slope = (cos / sin) as f32;
        let [w, d] = [width as f32, depth as f32];
        let size = [w + (d * slope).abs(), d].map(|side| side + 2.0 * SOFT_EDGE);
        // The conversion saturates, and sizes that are too large are refused.
        generate(size[0].ceil() as u32, size[1] as u32, |[x, y]| {
            let [right, down] = [(x - 0.5) * size[0].ceil(), (y - 0.5) * size[1]];
            // A px down on the screen is one px towards the viewer, and to the side along the Z axis.
            let across = (right + down * slope).abs();
            let inside = (0.5 * w - across).min(0.5 * d - down.abs());
            Color::BLACK.with_opacity(SHADOW_OPACITY * (0.5 + 0.5 * inside / SOFT_EDGE).min(1.0))
        })
    }
}

/// The colour of a crate of `size` px at a point `[x, y]` px from its upper left corner.
fn crate_front([x, y]: [f32; 2], [w, h]: [f32; 2], base: Color) -> Color {
    let short = w.min(h);
    let [frame, groove, rim] = [0.14 * short, (0.018 * short).max(0.6), (0.03 * short).max(1.0)];
    let to_side = x.min(w - x);
    let to_end = y.min(h - y);
    let to_edge = to_side.min(to_end);
    if to_edge < rim {
        return base.darker(0.55);
    }
    let nail = [to_side - frame * 0.6, to_end - frame * 0.6];
    if nail[0] * nail[0] + nail[1] * nail[1] < (0.14 * frame) * (0.14 * frame) {
        return base.darker(0.6);
    }
    if to_edge < frame {
        return base.lighter(0.16);
    }
    if to_edge < frame + groove {
        return base.darker(0.5);
    }
    // Distance to the diagonal from the lower left to the upper right corner.
    let diagonal = (h * x + w * y - w * h).abs() / (w * w + h * h).sqrt();
    if diagonal < 0.4 * frame {
        return base.lighter(0.1);
    }
    if diagonal < 0.4 * frame + groove {
        return base.darker(0.5);
    }
    // Planks run along the longer side; their number keeps them about a sixth of the shorter side wide.
    let across = if w >= h { y } else { x };
    let plank = (across - frame) / (short - 2.0 * frame) * 4.0;
    let to_seam = plank.fract().min(1.0 - plank.fract()) * (short - 2.0 * frame) / 4.0;
    if to_seam < 0.5 * groove {
        return base.darker(0.42);
    }
    base.darker(if plank as i32 % 2 == 0 { 0.16 } else { 0.22 })
}

/// A texture whose colour at the point (x, y), both 0 to 1 across the texture, is `color([x, y])`.
pub(super) fn generate(width: u32, height: u32, color: impl Fn([f32; 2]) -> Color) -> Result<Texture2D> {
    check_size(width, height)?;
    let mut pixels = Vec::with_capacity(width as usize * height as usize * 4);
    let at = |pixel: u32, sample: u32, length: u32| {
        (pixel as f32 + (sample as f32 + 0.5) / SAMPLES as f32) / length as f32
    };
    for y in 0..height {
        for x in 0..width {
            let samples = (0..SAMPLES * SAMPLES)
                .map(|i| color([at(x, i % SAMPLES, width), at(y, i / SAMPLES, height)]));
            pixels.extend(average(samples));
        }
    }
    Texture2D::from_rgba8(width, height, pixels)
}

/// Mean of a pixel's samples, weighted by their alpha, as straight RGBA8.
fn average(samples: impl Iterator<Item = Color>) -> [u8; 4] {
    let mut sum = [0u32; 3];
    let (mut alpha, mut count) = (0, 0);
    for c in samples {
        for (sum, channel) in sum.iter_mut().zip([c.r, c.g, c.b]) {
            *sum += u32::from(channel) * u32::from(c.a);
        }
        alpha += u32::from(c.a);
        count += 1;
    }
    if alpha == 0 {
        return [0; 4];
    }
    let [r, g, b] = sum.map(|channel| ((channel + alpha / 2) / alpha) as u8);
    [r, g, b, ((alpha + count / 2) / count) as u8]
}
