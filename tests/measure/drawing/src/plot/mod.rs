//! Pictures of what was measured, as vectors (SVG) and as pixels (PNG).
//!
//! A picture is painted once, through `plotters`, for either: its own backend writes the vectors, [`pixels`] makes
//! the pixels, smooth and twice as many, with a font that is compiled in, so that nothing depends on the machine.

pub mod axis;
pub mod first_failures;
pub mod heat;
pub mod ink;
pub mod lines;
pub mod overview;
pub mod pixels;
mod png_file;
pub mod style;

use pixels::Pixels;
use plotters::coord::Shift;
use plotters::prelude::{DrawingArea, DrawingAreaErrorKind, DrawingBackend, IntoDrawingArea, SVGBackend};
use std::fs;
use std::io;
use std::path::Path;

/// What painting on a backend can fail with.
pub type Fault<B> = DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>;

/// Something to paint.
pub trait Picture {
    /// Width and height in px.
    fn size(&self) -> (u32, u32);

    /// Paints it on a white sheet of that size.
    ///
    /// # Errors
    ///
    /// What the backend says.
    fn paint<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>) -> Result<(), Fault<B>>;
}

/// Writes a picture to `stem.svg` and `stem.png`.
///
/// # Errors
///
/// When it cannot be painted, or the files cannot be written.
pub fn save(picture: &impl Picture, folder: &Path, stem: &str) -> io::Result<()> {
    fs::write(folder.join(format!("{stem}.svg")), svg(picture)?)?;
    let pixels = Pixels::new(picture.size());
    let sheet = pixels.sheet();
    painted(picture, sheet)?;
    pixels.save(&folder.join(format!("{stem}.png")))
}

/// A picture as the text of an SVG file.
///
/// # Errors
///
/// When it cannot be painted.
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
