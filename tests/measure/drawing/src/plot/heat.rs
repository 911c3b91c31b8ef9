//! A map of where methods fail: a cell for every value of a parameter and every method and setting.
//!
//! A cell that failed is dark and has the letter of its reason, one that holds is pale and has a dot: neither needs
//! colour to be told apart.

use super::ink::{Words, area, line, wrapped};
use super::style::{DARK, GREY};
use super::{Fault, Picture};
use measure::stability::map::{Cell, Column, Map, Verdict};
use measure::stability::reasons;
use measure::stability::table::number;
use plotters::coord::Shift;
use plotters::prelude::{DrawingArea, DrawingBackend, RGBColor};

/// A map as a picture.
#[derive(Debug)]
pub struct HeatMap<'a>(pub &'a Map);

/// Width of a picture in px, or more where there are many columns.
const WIDTH: i32 = 820;
/// Least width of a column in px: room for its step.
const COLUMN: i32 = 30;
/// Left of the cells: the values and what they are of.
const LEFT: i32 = 96;
/// Width of a line of words in letters.
const LETTERS_PER_LINE: usize = 132;
/// Height of a cell.
const ROW: i32 = 22;
/// Height of a line of words.
const LINE: i32 = 16;
/// Between methods, and between steps of one method.
const GAPS: [i32; 2] = [12, 4];

/// Where a column is, px.
struct Lane {
    left: i32,
    right: i32,
}

impl HeatMap<'_> {
    fn about(&self) -> Vec<String> {
        wrapped(&self.0.heading.about, LETTERS_PER_LINE)
    }

    /// The columns as groups of the same `key`, by the indices of their first and last.
    fn groups(&self, key: impl Fn(&Column) -> String) -> Vec<(usize, usize, String)> {
        let mut groups: Vec<(usize, usize, String)> = Vec::new();
        for (index, column) in self.0.heading.columns.iter().enumerate() {
            let text = key(column);
            match groups.last_mut() {
                Some(group) if group.2 == text => group.1 = index,
                _ => groups.push((index, index, text)),
            }
        }
        groups
    }

    fn methods(&self) -> Vec<(usize, usize, String)> {
        self.groups(|column| column.method.clone())
    }

    fn lanes(&self) -> Vec<Lane> {
        let columns = &self.0.heading.columns;
        let gap = |pair: &[Column]| match (pair[0].method == pair[1].method, pair[0].dt == pair[1].dt) {
            (false, _) => GAPS[0],
            (_, false) => GAPS[1],
            _ => 0,
        };
        let gaps: Vec<i32> = std::iter::once(0).chain(columns.windows(2).map(gap)).collect();
        let room = WIDTH - LEFT - 10 - gaps.iter().sum::<i32>();
        // One column for each step has to have room for its name, several have more than they need.
        let least = if self.has_steps_of_one_column() { COLUMN } else { 16 };
        let width = (room / columns.len().max(1) as i32).clamp(least, 44);
        let mut right = LEFT;
        gaps.into_iter()
            .map(|gap| {
                let left = right + gap;
                right = left + width;
                Lane { left, right }
            })
            .collect()
    }

    fn has_steps_of_one_column(&self) -> bool {
        let steps = self.groups(|column| format!("{}\n{}", column.method, column.dt));
        steps.iter().any(|(first, last, _)| first == last)
    }

    /// Names of methods, each broken into lines that are as wide as its columns.
    fn names(&self, lanes: &[Lane]) -> Vec<(i32, Vec<String>)> {
        let name = |(first, last, text): (usize, usize, String)| {
            let (left, right) = (lanes[first].left, lanes[last].right);
            let letters = ((right - left + GAPS[0]) / 6).max(6) as usize;
            ((left + right) / 2, wrapped(&text, letters))
        };
        self.methods().into_iter().map(name).collect()
    }

    /// Height of what is above the cells.
    fn head(&self) -> i32 {
        let lines = self.names(&self.lanes()).iter().map(|(_, lines)| lines.len()).max().unwrap_or(0);
        34 + LINE * (self.about().len() + lines) as i32 + 8 + 2 * LINE + 6
    }

    /// The outcomes on the map, with their words.
    fn legend(&self) -> Vec<(Verdict, &'static str)> {
        let failures = self.0.reasons().into_iter().map(|reason| (Verdict::Failed(reason), reason));
        let is_absent = |cell: &Cell| matches!(cell.verdict, Verdict::Absent(_));
        let absent = self.0.rows.iter().flatten().any(is_absent);
        let absent = absent.then(|| (Verdict::Absent(String::new()), "cannot be run in this engine"));
        [(Verdict::Holds, "holds")].into_iter().chain(failures).chain(absent).collect()
    }
}

impl Picture for HeatMap<'_> {
    fn size(&self) -> (u32, u32) {
        let height = self.head() + ROW * self.0.rows.len() as i32 + 44;
        let right = self.lanes().last().map_or(0, |lane| lane.right);
        (WIDTH.max(right + 10) as u32, height as u32)
    }

    fn paint<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>) -> Result<(), Fault<B>> {
        Words::new(17.0).write(sheet, &self.0.heading.name, (10, 18))?;
        for (index, text) in self.about().iter().enumerate() {
            Words::new(12.0).color(GREY).write(sheet, text, (10, 38 + LINE * index as i32))?;
        }
        let lanes = self.lanes();
        self.paint_head(sheet, &lanes)?;
        self.paint_cells(sheet, &lanes)?;
        self.paint_legend(sheet)
    }
}

impl HeatMap<'_> {
    fn paint_head<B: DrawingBackend>(
        &self,
        sheet: &DrawingArea<B, Shift>,
        lanes: &[Lane],
    ) -> Result<(), Fault<B>> {
        let bottom = self.head();
        let (passes, steps) = (bottom - LINE / 2 - 2, bottom - 3 * LINE / 2 - 2);
        for (middle, lines) in self.names(lanes) {
            let first = steps - LINE * lines.len() as i32 - 4;
            for (index, text) in lines.iter().enumerate() {
                Words::new(12.0).centred().write(sheet, text, (middle, first + LINE * index as i32))?;
            }
        }
        for (first, last, text) in self.groups(|column| format!("{}\n{}", column.method, column.dt)) {
            let (left, right) = (lanes[first].left, lanes[last].right);
            let dt = text.split('\n').nth(1).unwrap_or_default();
            Words::new(12.0).centred().write(sheet, dt, ((left + right) / 2, steps))?;
            line(sheet, [(left + 2, steps + LINE / 2), (right - 2, steps + LINE / 2)], GREY, 1)?;
        }
        for (column, lane) in self.0.heading.columns.iter().zip(lanes) {
            let text = column.passes.to_string();
            Words::new(12.0).centred().write(sheet, &text, ((lane.left + lane.right) / 2, passes))?;
        }
        let small = Words::new(11.0).color(GREY).up_to();
        small.write(sheet, "step, s", (LEFT - 6, steps))?;
        small.write(sheet, "passes", (LEFT - 6, passes))
    }

    fn paint_cells<B: DrawingBackend>(
        &self,
        sheet: &DrawingArea<B, Shift>,
        lanes: &[Lane],
    ) -> Result<(), Fault<B>> {
        let heading = &self.0.heading;
        for (index, (value, row)) in heading.values.iter().zip(&self.0.rows).enumerate() {
            let top = self.head() + ROW * index as i32;
            let middle = top + ROW / 2;
            Words::new(12.0).up_to().write(sheet, &number(*value), (LEFT - 6, middle))?;
            for (lane, cell) in lanes.iter().zip(row) {
                let (paper, ink, letter) = look(&cell.verdict);
                area(sheet, [(lane.left + 1, top + 1), (lane.right - 1, top + ROW - 1)], paper)?;
                let at = ((lane.left + lane.right) / 2, middle);
                Words::new(13.0).centred().color(ink).write(sheet, &letter, at)?;
            }
        }
        let unit = if heading.unit.is_empty() { String::new() } else { format!(", {}", heading.unit) };
        let (middle, text) = (ROW * self.0.rows.len() as i32 / 2, format!("{}{unit}", heading.parameter));
        let letters = (ROW * self.0.rows.len() as i32 / 6).max(12) as usize;
        let words = Words { upwards: true, ..Words::new(12.0).centred() };
        for (index, text) in wrapped(&text, letters).iter().enumerate() {
            words.write(sheet, text, (14 + LINE * index as i32, self.head() + middle))?;
        }
        Ok(())
    }

    fn paint_legend<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>) -> Result<(), Fault<B>> {
        let top = self.head() + ROW * self.0.rows.len() as i32 + 14;
        let mut left = LEFT;
        for (verdict, word) in self.legend() {
            let (paper, ink, letter) = look(&verdict);
            area(sheet, [(left, top), (left + 20, top + 18)], paper)?;
            Words::new(13.0).centred().color(ink).write(sheet, &letter, (left + 10, top + 9))?;
            Words::new(12.0).write(sheet, word, (left + 25, top + 9))?;
            left += 25 + 7 * word.chars().count() as i32 + 14;
        }
        Ok(())
    }
}

/// Paper, ink and letter of an outcome.
pub(super) fn look(verdict: &Verdict) -> (RGBColor, RGBColor, String) {
    const WHITE: RGBColor = RGBColor(255, 255, 255);
    match verdict {
        Verdict::Holds => (RGBColor(226, 239, 229), DARK, "·".to_owned()),
        Verdict::Absent(_) => (RGBColor(247, 247, 247), GREY, "–".to_owned()),
        Verdict::Failed(reason) => (paper_of(reason), WHITE, reasons::letter(reason).to_string()),
    }
}

/// Dark papers, so that a failure is one also without colours.
fn paper_of(reason: &str) -> RGBColor {
    match reason {
        reasons::TOPPLED => RGBColor(0, 90, 150),
        reasons::SANK => RGBColor(0, 115, 85),
        reasons::BLEW_UP => RGBColor(176, 60, 0),
        reasons::TUNNELLED => RGBColor(120, 60, 130),
        reasons::CREPT => RGBColor(70, 110, 150),
        reasons::STRETCHED => RGBColor(130, 95, 0),
        reasons::STUCK => RGBColor(150, 40, 90),
        _ => RGBColor(40, 40, 40),
    }
}
