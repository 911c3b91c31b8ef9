//! Pictures to draw: loaded, given as pixels, or generated.

mod generated;
mod masonry;

use std::path::Path;
use std::sync::Arc;

use crate::error::check_size;
use crate::{Color, Point, Rectangle, RenderError, Result};
use crate::{jpeg_file, png_file};

/// A picture to draw. It cannot be changed; a clone shares its pixels and costs nothing.
#[derive(Clone, PartialEq, Eq)]
#[doc(alias = "Microsoft.Xna.Framework.Graphics.Texture2D")]
pub struct Texture2D {
    image: Arc<Image>,
}

#[derive(PartialEq, Eq)]
struct Image {
    width: u32,
    height: u32,
    straight: Vec<u8>,
    /// Premultiplied pixels for blending, kept beside the straight ones because converting back and forth
    /// loses bits.
    premultiplied: Vec<u8>,
}

impl Texture2D {
    /// A texture from straight RGBA8 pixels: rows from the top, four bytes each, no padding.
    ///
    /// # Errors
    /// A size out of range (see [`SoftwareCanvas::new`](crate::SoftwareCanvas::new)), or not `width * height
    /// * 4` bytes.
    pub fn from_rgba8(width: u32, height: u32, pixels: Vec<u8>) -> Result<Self> {
        check_size(width, height)?;
        if pixels.len() as u64 != u64::from(width) * u64::from(height) * 4 {
            let given = format!("{} bytes", pixels.len());
            return Err(RenderError::invalid("pixels", given, "width * height * 4 bytes"));
        }
        let premultiplied = pixels
            .chunks_exact(4)
            .flat_map(|p| {
                let c = tiny_skia::ColorU8::from_rgba(p[0], p[1], p[2], p[3]).premultiply();
                [c.red(), c.green(), c.blue(), c.alpha()]
            })
            .collect();
        Ok(Texture2D { image: Arc::new(Image { width, height, straight: pixels, premultiplied }) })
    }

    /// One opaque white px: to be stretched and tinted.
    pub(crate) fn white_pixel() -> Self {
        Texture2D::opaque(1, 1, vec![255; 4])
    }

    /// Pixels that fit the size, all of them opaque.
    fn opaque(width: u32, height: u32, pixels: Vec<u8>) -> Self {
        let image = Image { width, height, premultiplied: pixels.clone(), straight: pixels };
        Texture2D { image: Arc::new(image) }
    }

    /// A texture from the bytes of a PNG picture (any colour type and depth, reduced to 8 bits per channel).
    ///
    /// # Errors
    /// The bytes are no PNG picture, or one that is too large.
    #[doc(alias = "FromStream")]
    pub fn decode_png(bytes: &[u8]) -> Result<Self> {
        let (width, height, pixels) = png_file::decode("in memory", bytes)?;
        Texture2D::from_rgba8(width, height, pixels)
    }

    /// A texture from a PNG file, as [`Texture2D::decode_png`].
    ///
    /// # Errors
    /// The file cannot be read, or is no PNG picture, or one that is too large.
    #[doc(alias = "FromFile")]
    pub fn load_png(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        let (width, height, pixels) = png_file::decode(&path.display().to_string(), &read(path)?)?;
        Texture2D::from_rgba8(width, height, pixels)
    }

    /// Writes the texture as a PNG file, every bit kept; folders above it are created.
    ///
    /// # Errors
    /// The file or a folder cannot be written.
    #[doc(alias = "Save")]
    pub fn save_png(&self, path: impl AsRef<Path>) -> Result<()> {
        png_file::write(path.as_ref(), self.width(), self.height(), self.rgba8())
    }

    /// A texture from the bytes of a PNG or JPEG picture; its first bytes tell the format.
    ///
    /// # Errors
    /// The bytes are no such picture, or one that is too large.
    pub fn decode(bytes: &[u8]) -> Result<Self> {
        Texture2D::decode_named("in memory", bytes)
    }

    /// A texture from a PNG or JPEG file, as [`Texture2D::decode`].
    ///
    /// # Errors
    /// The file cannot be read, or is no such picture, or one that is too large.
    pub fn load(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        Texture2D::decode_named(&path.display().to_string(), &read(path)?)
    }

    fn decode_named(name: &str, bytes: &[u8]) -> Result<Self> {
        let is_jpeg = bytes.starts_with(&jpeg_file::MAGIC);
        let decode = if is_jpeg { jpeg_file::decode } else { png_file::decode };
        let (width, height, pixels) = decode(name, bytes)?;
        Texture2D::from_rgba8(width, height, pixels)
    }

    /// A copy of the part that lies in a rectangle; `None` if the rectangle is outside of the texture.
    pub fn part(&self, source: Rectangle) -> Option<Texture2D> {
        let inside = source.intersection(&Rectangle::new(0, 0, self.width(), self.height()));
        let cut = |pixels: &[u8]| {
            let rows = pixels.chunks_exact(4 * self.width() as usize);
            let [first, length] = [inside.x, inside.width].map(|px| 4 * px as usize);
            rows.skip(inside.y as usize)
                .take(inside.height as usize)
                .flat_map(|row| &row[first..first + length])
                .copied()
                .collect()
        };
        let image = || Image {
            width: inside.width,
            height: inside.height,
            straight: cut(&self.image.straight),
            premultiplied: cut(&self.image.premultiplied),
        };
        (!inside.is_empty()).then(|| Texture2D { image: Arc::new(image()) })
    }

    /// Width in px.
    #[doc(alias = "Width")]
    pub fn width(&self) -> u32 {
        self.image.width
    }

    /// Height in px.
    #[doc(alias = "Height")]
    pub fn height(&self) -> u32 {
        self.image.height
    }

    /// The middle of the texture, px from its top left corner: the origin of a sprite that is placed by its
    /// middle.
    pub fn center(&self) -> Point {
        [self.width() as f32 / 2.0, self.height() as f32 / 2.0]
    }

    /// The colour of a pixel, `None` outside the texture.
    pub fn pixel(&self, x: u32, y: u32) -> Option<Color> {
        if x >= self.width() || y >= self.height() {
            return None;
        }
        let at = 4 * (y as usize * self.width() as usize + x as usize);
        let p = &self.image.straight[at..at + 4];
        Some(Color::rgba(p[0], p[1], p[2], p[3]))
    }

    /// All pixels as straight RGBA8: rows from the top, four bytes each.
    pub fn rgba8(&self) -> &[u8] {
        &self.image.straight
    }

    /// All pixels as RGBA8 with premultiplied alpha, laid out as in [`Texture2D::rgba8`].
    pub fn premultiplied_rgba8(&self) -> &[u8] {
        &self.image.premultiplied
    }
}

fn read(path: &Path) -> Result<Vec<u8>> {
    std::fs::read(path).map_err(|source| RenderError::ReadFile { path: path.to_owned(), source })
}

impl std::fmt::Debug for Texture2D {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Texture2D({} x {} px)", self.width(), self.height())
    }
}
