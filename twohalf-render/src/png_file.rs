//! Reading and writing PNG files.

use std::fs::{self, File};
use std::io::{BufWriter, Cursor};
use std::path::Path;

use png::{BitDepth, ColorType, Decoder, Encoder, EncodingError, Limits, Transformations};

use crate::error::{MAX_PIXELS, check_size};
use crate::{RenderError, Result};

/// Creates a file and the folders above it.
pub(crate) fn create(path: &Path) -> Result<BufWriter<File>> {
    if let Some(parent) = path.parent() {
        fs::create_dir_all(parent).map_err(|source| RenderError::write(path, source))?;
    }
    let file = File::create(path).map_err(|source| RenderError::write(path, source))?;
    Ok(BufWriter::new(file))
}

/// An error of the encoder with the name of the file.
pub(crate) fn encoding_error(path: &Path, error: EncodingError) -> RenderError {
    let source = match error {
        EncodingError::IoError(source) => source,
        other => std::io::Error::other(other),
    };
    RenderError::write(path, source)
}

/// An encoder for straight RGBA8 pixels.
pub(crate) fn encoder<W: std::io::Write>(target: W, width: u32, height: u32) -> Encoder<'static, W> {
    let mut encoder = Encoder::new(target, width, height);
    encoder.set_color(ColorType::Rgba);
    encoder.set_depth(BitDepth::Eight);
    encoder
}

/// Writes straight RGBA8 pixels as a PNG file.
pub(crate) fn write(path: &Path, width: u32, height: u32, rgba8: &[u8]) -> Result<()> {
    let file = create(path)?;
    let written = encoder(file, width, height).write_header().and_then(|mut writer| {
        writer.write_image_data(rgba8)?;
        writer.finish()
    });
    written.map_err(|error| encoding_error(path, error))
}

/// Width, height and straight RGBA8 pixels of a PNG picture of any colour type; of an animation, its first
/// frame. `name` is the source of the bytes in errors.
pub(crate) fn decode(name: &str, bytes: &[u8]) -> Result<(u32, u32, Vec<u8>)> {
    let failed = |source: Box<dyn std::error::Error + Send + Sync>| RenderError::DecodePng {
        name: name.to_owned(),
        source,
    };
    let limits = Limits { bytes: MAX_PIXELS as usize * 4 };
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_transformations(Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(|e| failed(e.into()))?;
    let (width, height) = (reader.info().width, reader.info().height);
    check_size(width, height).map_err(|e| failed(e.into()))?;
    let size = reader.output_buffer_size().ok_or_else(|| failed("the picture is too large".into()))?;
    let mut pixels = vec![0; size];
    let frame = reader.next_frame(&mut pixels).map_err(|e| failed(e.into()))?;
    pixels.truncate(frame.buffer_size());
    Ok((width, height, expand_to_rgba8(frame.color_type, pixels)))
}

/// Adds the channels that a colour type lacks.
fn expand_to_rgba8(color_type: ColorType, pixels: Vec<u8>) -> Vec<u8> {
    match color_type {
        ColorType::Grayscale | ColorType::Indexed => pixels.iter().flat_map(|&g| [g, g, g, 255]).collect(),
        ColorType::GrayscaleAlpha => pixels.chunks_exact(2).flat_map(|p| [p[0], p[0], p[0], p[1]]).collect(),
        ColorType::Rgb => pixels.chunks_exact(3).flat_map(|p| [p[0], p[1], p[2], 255]).collect(),
        ColorType::Rgba => pixels,
    }
}
