//! Reading JPEG files.

use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use crate::error::{MAX_SIDE, check_size};
use crate::{RenderError, Result};

/// First bytes of every JPEG picture.
pub(crate) const MAGIC: [u8; 3] = [0xff, 0xd8, 0xff];

/// Width, height and straight RGBA8 pixels, all opaque, of a JPEG picture. `name` is the source of the bytes
/// in errors.
pub(crate) fn decode(name: &str, bytes: &[u8]) -> Result<(u32, u32, Vec<u8>)> {
    let failed = |source: Box<dyn std::error::Error + Send + Sync>| RenderError::DecodeJpeg {
        name: name.to_owned(),
        source,
    };
    let options = DecoderOptions::default()
        .set_strict_mode(true)
        .set_max_width(MAX_SIDE as usize)
        .set_max_height(MAX_SIDE as usize)
        .jpeg_set_out_colorspace(ColorSpace::RGBA);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(|error| failed(error.to_string().into()))?;
    let info = decoder.info().ok_or_else(|| failed("it has no header".into()))?;
    let (width, height) = (u32::from(info.width), u32::from(info.height));
    check_size(width, height).map_err(|error| failed(error.into()))?;
    let pixels = decoder.decode().map_err(|error| failed(error.to_string().into()))?;
    Ok((width, height, pixels))
}
