//! Animated PNG files.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use png::BlendOp;

use crate::error::check_size;
use crate::png_file;
use crate::{RenderError, Result, SoftwareCanvas};

/// Writes an animation as an APNG file that loops forever; programs without APNG show its first frame.
///
/// Frames go to the file one by one, so the length of an animation costs no memory; the format needs their
/// number in advance. After the first frame only changes are stored.
///
/// ```no_run
/// # use twohalf_render::{Animation, Canvas, Color, SoftwareCanvas};
/// let mut canvas = SoftwareCanvas::new(320, 240)?;
/// let mut animation = Animation::create("pictures/fade.png", 320, 240, 60, 33)?;
/// for frame in 0..60 {
///     canvas.clear(Color::rgb(4 * frame, 0, 0));
///     animation.add_frame(&canvas)?;
/// }
/// animation.finish()?;
/// # Ok::<(), twohalf_render::RenderError>(())
/// ```
pub struct Animation {
    path: PathBuf,
    writer: png::Writer<BufWriter<File>>,
    /// Width, px.
    width: u32,
    /// Height, px.
    height: u32,
    /// Number of announced frames.
    frames: u32,
    /// Number of written frames.
    written: u32,
    /// Straight RGBA8 pixels that a viewer shows now.
    shown: Vec<u8>,
}

impl Animation {
    /// Begins an animation of `frames` frames (1 or more) of `width` x `height` px, each shown for `delay_ms`
    /// milliseconds (0: as fast as the viewer can). An existing file is replaced; folders above it are
    /// created.
    ///
    /// # Errors
    /// A size out of range (see [`SoftwareCanvas::new`]), no frames, or the file or a folder cannot be
    /// written.
    pub fn create(
        path: impl AsRef<Path>,
        width: u32,
        height: u32,
        frames: u32,
        delay_ms: u16,
    ) -> Result<Self> {
        check_size(width, height)?;
        if frames == 0 {
            return Err(RenderError::invalid("frames", frames, "1 or more"));
        }
        let path = path.as_ref().to_owned();
        let mut encoder = png_file::encoder(png_file::create(&path)?, width, height);
        encoder.validate_sequence(true);
        let header = encoder.set_animated(frames, 0).and_then(|()| encoder.set_frame_delay(delay_ms, 1000));
        let writer = header.and_then(|()| encoder.write_header());
        let writer = writer.map_err(|error| png_file::encoding_error(&path, error))?;
        Ok(Animation { path, writer, width, height, frames, written: 0, shown: Vec::new() })
    }

    /// Adds the next frame.
    ///
    /// # Errors
    /// The canvas has another size than the animation, all frames have been added already, or the file cannot
    /// be written.
    pub fn add_frame(&mut self, canvas: &SoftwareCanvas) -> Result<()> {
        if (canvas.width(), canvas.height()) != (self.width, self.height) {
            let given = (canvas.width(), canvas.height());
            return Err(RenderError::invalid("canvas", given, "as large as the animation"));
        }
        if self.written == self.frames {
            return Err(RenderError::invalid("canvas", self.written + 1, "one of the frames announced"));
        }
        let pixels = canvas.rgba8();
        let region = if self.written == 0 {
            Region { x: 0, y: 0, width: self.width, height: self.height }
        } else {
            Region::of_changes(&self.shown, &pixels, self.width)
        };
        self.write_frame(&region, &pixels).map_err(|error| png_file::encoding_error(&self.path, error))?;
        self.shown = pixels;
        self.written += 1;
        Ok(())
    }

    /// Completes the file.
    ///
    /// # Errors
    /// Fewer frames were added than announced (the file is then not valid), or the file cannot be written.
    pub fn finish(self) -> Result<()> {
        if self.written != self.frames {
            let given = format!("{} of {}", self.written, self.frames);
            return Err(RenderError::invalid("frames", given, "complete before the animation is finished"));
        }
        self.writer.finish().map_err(|error| png_file::encoding_error(&self.path, error))
    }

    fn write_frame(&mut self, region: &Region, pixels: &[u8]) -> Result<(), png::EncodingError> {
        let (data, blend) = if self.written == 0 {
            (pixels.to_vec(), BlendOp::Source)
        } else {
            region.cut(&self.shown, pixels, self.width)
        };
        // The position goes to the corner first: the encoder checks every setting against the previous one.
        self.writer.set_frame_position(0, 0)?;
        self.writer.set_frame_dimension(region.width, region.height)?;
        self.writer.set_frame_position(region.x, region.y)?;
        self.writer.set_blend_op(blend)?;
        self.writer.write_image_data(&data)
    }
}

impl std::fmt::Debug for Animation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Animation { path, width, height, frames, written, .. } = self;
        write!(f, "Animation({path:?}, {width} x {height} px, {written} of {frames} frames)")
    }
}

/// The part of a picture that a frame replaces, px.
struct Region {
    x: u32,
    y: u32,
    width: u32,
    height: u32,
}

impl Region {
    /// The smallest rectangle with all differences; one pixel without any.
    fn of_changes(before: &[u8], after: &[u8], width: u32) -> Region {
        let row = width as usize * 4;
        let (mut left, mut right, mut top, mut bottom) = (usize::MAX, 0, usize::MAX, 0);
        for (y, (a, b)) in before.chunks_exact(row).zip(after.chunks_exact(row)).enumerate() {
            let Some(first) = a.iter().zip(b).position(|(a, b)| a != b) else { continue };
            let last = a.iter().zip(b).rposition(|(a, b)| a != b).unwrap_or(first);
            (left, right) = (left.min(first / 4), right.max(last / 4));
            (top, bottom) = (top.min(y), y);
        }
        if top == usize::MAX {
            return Region { x: 0, y: 0, width: 1, height: 1 };
        }
        let [x, y, right, bottom] = [left, top, right, bottom].map(|n| n as u32);
        Region { x, y, width: right - x + 1, height: bottom - y + 1 }
    }

    /// The pixels of the region and how to combine them with what is shown. If every changed pixel is opaque,
    /// unchanged ones are made transparent and blended, since even areas compress to almost nothing.
    fn cut(&self, before: &[u8], after: &[u8], width: u32) -> (Vec<u8>, BlendOp) {
        let mut source = Vec::with_capacity(self.width as usize * self.height as usize * 4);
        let mut over = Vec::with_capacity(source.capacity());
        let mut opaque = true;
        for y in self.y..self.y + self.height {
            let start = (y as usize * width as usize + self.x as usize) * 4;
            let row = start..start + self.width as usize * 4;
            source.extend_from_slice(&after[row.clone()]);
            for (a, b) in before[row.clone()].chunks_exact(4).zip(after[row].chunks_exact(4)) {
                over.extend_from_slice(if a == b { &[0; 4] } else { b });
                opaque &= a == b || b[3] == 255;
            }
        }
        if opaque { (over, BlendOp::Over) } else { (source, BlendOp::Source) }
    }
}
