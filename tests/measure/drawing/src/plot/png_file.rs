//! Writes PNG files with few colours, which take a fifth of the space of files with all colours.

use png::{BitDepth, ColorType, Encoder, EncodingError};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;

/// Numbers of levels for red, green and blue each. The first number is used that leaves at most [`MOST_COLORS`] colours. The
/// last one always does.
const STEPS: [u16; 3] = [15, 7, 5];
/// Greatest number of colours of a file with a palette.
const MOST_COLORS: usize = 256;

/// Writes opaque pixels, four bytes each (red, green, blue, alpha), to a file.
///
/// # Errors
///
/// When the file cannot be written.
pub(super) fn write(path: &Path, (width, height): (u32, u32), rgba: &[u8]) -> io::Result<()> {
    let (palette, pixels) = STEPS
        .iter()
        .find_map(|&steps| indexed(rgba, steps))
        .ok_or_else(|| io::Error::other("a picture has too many colours"))?;
    let mut encoder = Encoder::new(BufWriter::new(File::create(path)?), width, height);
    encoder.set_color(ColorType::Indexed);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_palette(palette);
    // Filters would only enlarge the file, because neighbouring indices stand for unrelated colours.
    encoder.set_filter(png::Filter::NoFilter);
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(&pixels)?;
        writer.finish()
    });
    written.map_err(|error| match error {
        EncodingError::IoError(error) => error,
        other => io::Error::other(other),
    })
}

/// Rounds colours to `steps` levels. Returns the colours, and for each pixel the index of its colour; `None` if there are too
/// many colours.
fn indexed(rgba: &[u8], steps: u16) -> Option<(Vec<u8>, Vec<u8>)> {
    let rounded = |part: u8| ((u16::from(part) * steps + 127) / 255 * 255 / steps) as u8;
    let mut numbers: BTreeMap<[u8; 3], u8> = BTreeMap::new();
    let mut palette = Vec::new();
    let mut pixels = Vec::with_capacity(rgba.len() / 4);
    for pixel in rgba.chunks_exact(4) {
        let color = [pixel[0], pixel[1], pixel[2]].map(rounded);
        let number = match numbers.get(&color) {
            Some(&number) => number,
            None if numbers.len() == MOST_COLORS => return None,
            None => {
                let number = numbers.len() as u8;
                numbers.insert(color, number);
                palette.extend(color);
                number
            }
        };
        pixels.push(number);
    }
    Some((palette, pixels))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_written_as_palette_indices() {
        let (palette, pixels) = indexed(&[255, 255, 255, 255, 0, 0, 0, 255, 255, 255, 255, 255], 15).unwrap();
        assert_eq!((palette, pixels), (vec![255, 255, 255, 0, 0, 0], vec![0, 1, 0]));
    }

    #[test]
    fn all_colours_fit_into_the_coarsest_steps() {
        let all: Vec<u8> = (0..=u32::from(u16::MAX))
            .flat_map(|bits| [(bits >> 8) as u8, bits as u8, (bits >> 4) as u8, 255])
            .collect();
        assert!(indexed(&all, 15).is_none() && indexed(&all, 5).is_some());
    }
}
