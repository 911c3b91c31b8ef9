//! Draws pictures of measurements, as vectors (SVG) and as pixels (PNG).
//!
//! The same code paints a picture for both formats, through `plotters`. The SVG backend of `plotters` writes vectors.
//! [`pixels`] paints smooth pixels at twice the resolution, with a font that is compiled in, so that no pixel depends on the
//! machine.

pub mod axis;
pub mod first_failures;
pub mod heat;
pub mod ink;
pub mod lines;
pub mod overview;
pub mod pixels;
mod png_file;
pub mod style;
pub mod times;

use pixels::Pixels;
use plotters::coord::Shift;
use plotters::prelude::{DrawingArea, DrawingAreaErrorKind, DrawingBackend, IntoDrawingArea, SVGBackend};
use std::fs;
use std::io;
use std::path::Path;

/// Error that painting on a backend returns.
pub type Fault<B> = DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>;

/// A picture that any backend can paint.
pub trait Picture {
    /// Returns width and height of the picture, px.
    fn size(&self) -> (u32, u32);

    /// Paints the picture on a white sheet of its size.
    ///
    /// # Errors
    ///
    /// An error of the backend.
    fn paint<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>) -> Result<(), Fault<B>>;
}

/// Writes a picture to the files `stem.svg` and `stem.png` in a folder.
///
/// # Errors
///
/// When the picture cannot be painted, or the files cannot be written.
pub fn save(picture: &impl Picture, folder: &Path, stem: &str) -> io::Result<()> {
    fs::write(folder.join(format!("{stem}.svg")), svg(picture)?)?;
    let pixels = Pixels::new(picture.size());
    let sheet = pixels.sheet();
    painted(picture, sheet)?;
    pixels.save(&folder.join(format!("{stem}.png")))
}

/// Returns a picture as the text of an SVG file.
///
/// # Errors
///
/// When the picture cannot be painted.
pub fn svg(picture: &impl Picture) -> io::Result<String> {
    let mut text = String::new();
    painted(picture, SVGBackend::with_string(&mut text, picture.size()))?;
    Ok(text)
}

fn painted<B: DrawingBackend>(picture: &impl Picture, backend: B) -> io::Result<()> {
    let sheet = backend.into_drawing_area();
    let failed = |error: Fault<B>| io::Error::other(error.to_string());
    sheet.fill(&plotters::style::WHITE).map_err(failed)?;
    picture.paint(&sheet).map_err(failed)?;
    sheet.present().map_err(failed)
}
