//! Several stills on one picture.

use std::path::Path;

use crate::text::{CHARACTER_SIZE, draw_text};
use crate::{Canvas, Color, RenderError, Result, SoftwareCanvas, Sprite, SpriteBatch, Texture2D};

/// Px between stills and around them.
const GAP: u32 = 8;
/// Px from the upper edge of a caption's strip to its text, and from the text to the still.
const CAPTION_PADDING: u32 = 4;
/// Scale factor of the captions' font.
const CAPTION_SCALE: u32 = 2;
/// Greatest factor by which stills are made smaller.
const MAX_SHRINK: u32 = 64;

const PAPER: Color = Color::rgb(38, 42, 50);
const INK: Color = Color::rgb(236, 238, 242);

/// A grid of stills, each with a caption above it: a run of a simulation on one page.
///
/// ```
/// # use twohalf_render::{Canvas, Color, ContactSheet, SoftwareCanvas};
/// let mut canvas = SoftwareCanvas::new(200, 100)?;
/// let mut sheet = ContactSheet::new(2, 1)?;
/// for step in 0..4 {
///     canvas.clear(Color::rgb(60 * step, 90, 120));
///     sheet.add(&canvas, format!("step {step}"));
/// }
/// assert_eq!(sheet.render()?.size(), [2 * 200 + 3 * 8, 2 * (100 + 24) + 3 * 8]);
/// # Ok::<(), twohalf_render::RenderError>(())
/// ```
#[derive(Debug, Clone)]
pub struct ContactSheet {
    columns: u32,
    shrink: u32,
    stills: Vec<(SoftwareCanvas, String)>,
}

impl ContactSheet {
    /// An empty sheet with `columns` stills side by side, each `shrink` times (1: not at all) smaller than
    /// the canvas it is taken from.
    ///
    /// # Errors
    /// No columns; `shrink` is not 1 to 64.
    pub fn new(columns: u32, shrink: u32) -> Result<Self> {
        if columns == 0 {
            return Err(RenderError::invalid("columns", columns, "1 or more"));
        }
        if !(1..=MAX_SHRINK).contains(&shrink) {
            return Err(RenderError::invalid("shrink", shrink, "1 to 64"));
        }
        Ok(ContactSheet { columns, shrink, stills: Vec::new() })
    }

    /// Adds a copy of the canvas. Stills may differ in size; the largest gives the size of the grid's cells.
    /// A caption that is wider than its cell is cut off.
    pub fn add(&mut self, canvas: &SoftwareCanvas, caption: impl Into<String>) {
        self.stills.push((canvas.clone(), caption.into()));
    }

    /// The sheet as a picture.
    ///
    /// # Errors
    /// There are no stills, or the sheet would be too large (see [`SoftwareCanvas::new`]).
    pub fn render(&self) -> Result<SoftwareCanvas> {
        if self.stills.is_empty() {
            return Err(RenderError::invalid("stills", self.stills.len(), "1 or more"));
        }
        let stills: Vec<Texture2D> =
            self.stills.iter().map(|(still, _)| shrunk(still, self.shrink)).collect::<Result<_>>()?;
        let cell_width = stills.iter().map(Texture2D::width).max().unwrap_or(0);
        let strip = 2 * CAPTION_PADDING + CHARACTER_SIZE * CAPTION_SCALE;
        let cell_height = stills.iter().map(Texture2D::height).max().unwrap_or(0) + strip;
        let columns = self.columns.min(stills.len() as u32);
        let rows = (stills.len() as u32).div_ceil(columns);
        // In u64, since the sum may exceed u32; the size check below refuses it.
        let side = |count: u32, cell: u32| {
            let px = u64::from(count) * u64::from(cell + GAP) + u64::from(GAP);
            u32::try_from(px).unwrap_or(u32::MAX)
        };
        let mut sheet = SoftwareCanvas::new(side(columns, cell_width), side(rows, cell_height))?;
        sheet.clear(PAPER);
        let mut batch = SpriteBatch::begin();
        for (index, (still, (_, caption))) in (0u32..).zip(stills.iter().zip(&self.stills)) {
            let x = (GAP + index % columns * (cell_width + GAP)) as f32;
            let y = (GAP + index / columns * (cell_height + GAP)) as f32;
            let fitting = (cell_width / (CHARACTER_SIZE * CAPTION_SCALE)) as usize;
            let caption: String = caption.chars().filter(|c| *c != '\n').take(fitting).collect();
            draw_text(&mut sheet, &caption, [x, y + CAPTION_PADDING as f32], CAPTION_SCALE, INK);
            batch.draw(Sprite::new(still, [x, y + strip as f32]));
        }
        batch.end(&mut sheet);
        Ok(sheet)
    }

    /// Writes the sheet as a PNG file; folders above it are created.
    ///
    /// # Errors
    /// The errors of [`ContactSheet::render`], or the file or a folder cannot be written.
    pub fn save_png(&self, path: impl AsRef<Path>) -> Result<()> {
        self.render()?.save_png(path)
    }
}

/// The picture at 1/n of its size, each pixel the mean of n x n; a remainder at the right and lower edge is
/// left out. A canvas with a side below n px stays as it is.
fn shrunk(canvas: &SoftwareCanvas, n: u32) -> Result<Texture2D> {
    let [width, height] = canvas.size();
    if n == 1 || width < n || height < n {
        return canvas.to_texture();
    }
    // Means are taken over premultiplied pixels, so that transparent ones carry no colour.
    let (pixels, row) = (canvas.premultiplied_rgba8(), width as usize * 4);
    let mut small = Vec::with_capacity(((width / n) * (height / n)) as usize * 4);
    for y in 0..height / n {
        for x in 0..width / n {
            let mut sum = [0u32; 4];
            for (dx, dy) in (0..n * n).map(|i| (i % n, i / n)) {
                let at = (y * n + dy) as usize * row + (x * n + dx) as usize * 4;
                sum.iter_mut().zip(&pixels[at..at + 4]).for_each(|(sum, &p)| *sum += u32::from(p));
            }
            let alpha = sum[3].max(1);
            let straight = |channel: u32| ((channel * 255 + alpha / 2) / alpha).min(255) as u8;
            small.extend([straight(sum[0]), straight(sum[1]), straight(sum[2])]);
            small.push(((sum[3] + n * n / 2) / (n * n)) as u8);
        }
    }
    Texture2D::from_rgba8(width / n, height / n, small)
}
