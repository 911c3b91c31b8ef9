//! Draws all scenes on one page: a table of scenes and methods, with the time of the cheapest setting that meets the tolerance.

use super::axis::short_time;
use super::ink::{Words, area, line, marker, wrapped};
use super::style::{DARK, GREY, PALE, look_of};
use super::{Fault, Picture};
use crate::report::Best;
use measure::method::Setting;
use measure::sweep::{Point, Subject};
use plotters::coord::Shift;
use plotters::prelude::{DrawingArea, DrawingBackend, RGBColor};

/// Height of a row of the table, px.
const ROW: i32 = 17;
/// Height of the heading above the rows, px.
const HEAD: i32 = 96;
/// Width of the column of names, px.
const NAMES: i32 = 250;
/// Width of the page, px.
const WIDTH: i32 = 800;
/// Colours of cells: each with the greatest ratio of the time to the least one of the row. Cheaper cells are darker green.
const SHADES: [(f64, RGBColor); 4] = [
    (1.15, RGBColor(140, 205, 160)),
    (2.0, RGBColor(185, 225, 195)),
    (10.0, RGBColor(222, 241, 226)),
    (f64::INFINITY, RGBColor(246, 250, 246)),
];

/// Table of scenes and methods, as a picture.
#[derive(Debug, Clone, Copy)]
pub struct Overview<'a> {
    /// Heading of the page.
    pub title: &'a str,
    /// Scenes, one row each.
    pub subjects: &'a [Subject],
    /// Methods, one column each, with their recommended settings.
    pub methods: &'a [(&'static str, Setting)],
    /// Measured points of all scenes and methods.
    pub points: &'a [Point],
}

type Done<B> = Result<(), Fault<B>>;

impl Picture for Overview<'_> {
    fn size(&self) -> (u32, u32) {
        (WIDTH as u32, (HEAD + ROW * self.rows().len() as i32 + 49) as u32)
    }

    fn paint<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>) -> Done<B> {
        Words::new(18.0).centred().write(sheet, self.title, (WIDTH / 2, 18))?;
        let note = "CPU time per simulated second of the cheapest setting that meets the tolerance";
        Words::new(12.0).centred().color(GREY).write(sheet, note, (WIDTH / 2, 38))?;
        for (column, (name, _)) in self.methods.iter().enumerate() {
            let x = self.column(column) + self.width() / 2;
            marker(sheet, (x, 58), &look_of(column), 4, true)?;
            for (row, text) in wrapped(name, 16).iter().enumerate() {
                Words::new(11.0).centred().write(sheet, text, (x, 72 + 12 * row as i32))?;
            }
        }
        let rows = self.rows();
        for (index, (subject, size)) in rows.iter().enumerate() {
            self.paint_row(sheet, subject, *size, HEAD + ROW * index as i32)?;
        }
        let bottom = HEAD + ROW * rows.len() as i32 + 14;
        let legend = [
            "After the comma: bodies.  x: no setting meets the tolerance.  failed: every run failed.  Blank: not measured.",
            "The darker, the nearer to the cheapest of the row.",
        ];
        for (line, text) in legend.into_iter().enumerate() {
            Words::new(11.0).color(GREY).write(sheet, text, (14, bottom + 15 * line as i32))?;
        }
        Ok(())
    }
}

impl Overview<'_> {
    fn rows(&self) -> Vec<(&Subject, usize)> {
        let sizes = |subject| move |&size| (subject, size);
        self.subjects.iter().flat_map(|subject| subject.sizes.iter().map(sizes(subject))).collect()
    }

    fn width(&self) -> i32 {
        (WIDTH - NAMES - 10) / self.methods.len().max(1) as i32
    }

    fn column(&self, column: usize) -> i32 {
        NAMES + self.width() * column as i32
    }

    fn paint_row<B: DrawingBackend>(
        &self,
        sheet: &DrawingArea<B, Shift>,
        subject: &Subject,
        size: usize,
        top: i32,
    ) -> Done<B> {
        let name = subject.title();
        let name = if size == 0 { name } else { format!("{name}, {size}") };
        let middle = top + ROW / 2;
        line(sheet, [(10, top), (WIDTH - 10, top)], PALE, 1)?;
        Words::new(12.0).write(sheet, &name, (14, middle))?;
        let bests: Vec<Best<'_>> =
            self.methods.iter().map(|(method, _)| Best::of(self.points, subject, size, method)).collect();
        let least = bests.iter().filter_map(|best| best.time()).min_by(f64::total_cmp);
        for (column, best) in bests.into_iter().enumerate() {
            let (left, right) = (self.column(column), self.column(column) + self.width());
            let at = ((left + right) / 2, middle);
            let words = Words::new(12.0).centred();
            match (best, best.time().zip(least)) {
                (_, Some((time, least))) => {
                    area(sheet, [(left + 2, top + 1), (right - 2, top + ROW)], shade(time / least))?;
                    words.write(sheet, &short_time(time), at)?;
                }
                (Best::Failed(_), _) => words.color(GREY).write(sheet, "failed", at)?,
                (Best::Absent, _) => {}
                _ => words.color(DARK).write(sheet, "x", at)?,
            }
        }
        Ok(())
    }
}

fn shade(ratio: f64) -> RGBColor {
    SHADES.iter().find(|(most, _)| ratio <= *most).map_or(PALE, |(_, color)| *color)
}
