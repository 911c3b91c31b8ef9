//! A texture and the options for tracing its outlines (behaviour chapter 15, section 15.6.1).

use std::borrow::Cow;

use crate::error::{Error, Result};
use crate::math::finite::finite;
use crate::math::{Vector2, scalar};

/// Maximum width or height, in pixels: f32 counts every pixel below it exactly.
const MAX_SIDE: u32 = 1 << 24;

/// A texture, of which only the alpha channel is used, and the options of
/// [`Vertices::create_polygons`](super::Vertices::create_polygons). Lengths are in pixels, x to the right and y down
/// from the first pixel.
///
/// ```
/// use farseer_core::shape::{PolygonCreationAssistance, Vertices};
/// // A block of 5 by 5 in a mask of 8 by 8; an image of the `image` crate hands its bytes to `from_rgba`.
/// let alpha: Vec<u8> =
///     (0..64).map(|i| if (1..6).contains(&(i % 8)) && (1..6).contains(&(i / 8)) { 255 } else { 0 }).collect();
/// let mut assistance = PolygonCreationAssistance::from_alpha(&alpha, 8, 8)?;
/// assistance.set_multipart_detection(true);
/// let polygons = Vertices::create_polygons(&assistance)?;
/// assert_eq!(polygons.len(), 1);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[doc(alias = "FarseerGames.FarseerPhysics.Collisions.PolygonCreationAssistance")]
#[derive(Debug, Clone)]
pub struct PolygonCreationAssistance<'a> {
    data: Cow<'a, [u32]>,
    width: i32,
    height: i32,
    alpha_tolerance: u8,
    hull_tolerance: f32,
    hole_detection_line_step_size: i32,
    hole_detection: bool,
    multipart_detection: bool,
}

impl<'a> PolygonCreationAssistance<'a> {
    /// A texture of one number per pixel, row by row, alpha in its top byte, as `Texture2D.GetData` gives it.
    ///
    /// # Errors
    /// When a side is 0 or more than 2^24, or the data have another length than `width * height`.
    pub fn new(data: &'a [u32], width: u32, height: u32) -> Result<Self> {
        Self::checked(data.len(), 1, width, height, || Cow::Borrowed(data))
    }

    /// A texture of four bytes per pixel, row by row: red, green, blue, alpha. An `RgbaImage` of the `image`
    /// crate is one.
    ///
    /// # Errors
    /// When a side is 0 or more than 2^24, or the data have another length than `4 * width * height`.
    pub fn from_rgba(data: &[u8], width: u32, height: u32) -> Result<Self> {
        Self::checked(data.len(), 4, width, height, || {
            let (pixels, _) = data.as_chunks::<4>();
            pixels.iter().map(|&pixel| u32::from_le_bytes(pixel)).collect()
        })
    }

    /// A texture of one byte per pixel, row by row, which is its alpha. A `GrayImage` of the `image` crate is
    /// one, if its brightness is meant as alpha.
    ///
    /// # Errors
    /// When a side is 0 or more than 2^24, or the data have another length than `width * height`.
    pub fn from_alpha(data: &[u8], width: u32, height: u32) -> Result<Self> {
        Self::checked(data.len(), 1, width, height, || {
            data.iter().map(|&alpha| u32::from(alpha) << 24).collect()
        })
    }

    fn checked(
        length: usize,
        per_pixel: usize,
        width: u32,
        height: u32,
        data: impl FnOnce() -> Cow<'a, [u32]>,
    ) -> Result<Self> {
        for (argument, side) in [("width", width), ("height", height)] {
            if side == 0 || side > MAX_SIDE {
                return Err(Error::invalid(argument, side, "1 to 2^24 pixels"));
            }
        }
        if !length.is_multiple_of(per_pixel) || !Self::is_valid(length / per_pixel, width, height) {
            let value = format_args!("a list of {length} for {width} by {height} pixels");
            return Err(Error::invalid("data", value, "as long as the size asks for, and below 2^31 pixels"));
        }
        Ok(PolygonCreationAssistance {
            data: data(),
            width: width as i32,
            height: height as i32,
            alpha_tolerance: 20,
            hull_tolerance: 1.5,
            hole_detection_line_step_size: 1,
            hole_detection: false,
            multipart_detection: false,
        })
    }

    /// Whether this number of pixels fills a texture of that size. A texture that fails this test cannot be made.
    #[doc(alias = "IsValid")]
    pub fn is_valid(pixels: usize, width: u32, height: u32) -> bool {
        let size = u64::from(width) * u64::from(height);
        size > 0 && size < 1 << 31 && pixels as u64 == size
    }

    /// The pixels, row by row, alpha in the top byte.
    #[doc(alias = "PolygonCreationAssistance.Data")]
    pub fn data(&self) -> &[u32] {
        &self.data
    }

    /// Number of pixels in a row.
    #[doc(alias = "PolygonCreationAssistance.Width")]
    pub fn width(&self) -> i32 {
        self.width
    }

    /// Number of rows.
    #[doc(alias = "PolygonCreationAssistance.Height")]
    pub fn height(&self) -> i32 {
        self.height
    }

    /// Minimum alpha of a solid pixel, 0 to 255; 20 unless set. With 0 all pixels are solid.
    #[doc(alias = "AlphaTolerance")]
    pub fn alpha_tolerance(&self) -> u8 {
        self.alpha_tolerance
    }

    /// Sets the minimum alpha of a solid pixel.
    pub fn set_alpha_tolerance(&mut self, alpha_tolerance: u8) {
        self.alpha_tolerance = alpha_tolerance;
    }

    /// Maximum distance, in pixels, of an outline from the pixels that it follows; 1.5 unless set. Single pixels are
    /// farther away, up to 2.3 times as far in 40,000 random pictures.
    #[doc(alias = "HullTolerance")]
    pub fn hull_tolerance(&self) -> f32 {
        self.hull_tolerance
    }

    /// Sets the maximum distance of an outline from its pixels, limited to 0.9 to 4 pixels.
    ///
    /// # Errors
    /// When the value is not finite.
    pub fn set_hull_tolerance(&mut self, hull_tolerance: f32) -> Result<()> {
        self.hull_tolerance = finite("hull_tolerance", hull_tolerance)?.clamp(0.9, 4.0);
        Ok(())
    }

    /// Distance of the rows in which holes are searched, in pixels; 1 unless set.
    #[doc(alias = "HoleDetectionLineStepSize")]
    pub fn hole_detection_line_step_size(&self) -> i32 {
        self.hole_detection_line_step_size
    }

    /// Sets the distance of the rows in which holes are searched, limited to 1 to 10 pixels.
    pub fn set_hole_detection_line_step_size(&mut self, step_size: i32) {
        self.hole_detection_line_step_size = step_size.clamp(1, 10);
    }

    /// Whether holes are cut out; not unless set.
    #[doc(alias = "HoleDetection")]
    pub fn hole_detection(&self) -> bool {
        self.hole_detection
    }

    /// Sets whether holes are cut out.
    pub fn set_hole_detection(&mut self, hole_detection: bool) {
        self.hole_detection = hole_detection;
    }

    /// Whether parts after the first are searched; not unless set.
    #[doc(alias = "MultipartDetection")]
    pub fn multipart_detection(&self) -> bool {
        self.multipart_detection
    }

    /// Sets whether parts after the first are searched.
    pub fn set_multipart_detection(&mut self, multipart_detection: bool) {
        self.multipart_detection = multipart_detection;
    }

    /// Whether there is a solid pixel in column `x` of row `y`.
    #[doc(alias = "IsSolid")]
    #[inline]
    pub fn is_solid(&self, x: i32, y: i32) -> bool {
        (0..self.width).contains(&x)
            && (0..self.height).contains(&y)
            && self.is_solid_index(x + y * self.width)
    }

    /// [`is_solid`](Self::is_solid) of a point, whose coordinates are truncated toward zero.
    #[doc(alias = "IsSolid")]
    pub fn is_solid_pixel(&self, pixel: Vector2) -> bool {
        self.is_solid(scalar::to_int(pixel.x), scalar::to_int(pixel.y))
    }

    /// Whether there is a solid pixel with this index, counted row by row.
    #[doc(alias = "IsSolid")]
    #[inline]
    pub fn is_solid_index(&self, index: i32) -> bool {
        let pixel = usize::try_from(index).ok().and_then(|i| self.data.get(i));
        pixel.is_some_and(|pixel| pixel >> 24 >= u32::from(self.alpha_tolerance))
    }

    /// Whether a point lies in the texture.
    #[doc(alias = "InBounds")]
    pub fn in_bounds(&self, coord: Vector2) -> bool {
        coord.x >= 0.0 && coord.x < self.width as f32 && coord.y >= 0.0 && coord.y < self.height as f32
    }
}
