//! Draws a map of the limits of methods: a cell for every value of a parameter, and every method and setting.
//!
//! A failed cell is dark and has the letter of its reason. A cell that holds is pale and has a dot. So the two differ also
//! without colour.

use super::ink::{Words, area, line, wrapped};
use super::style::{DARK, GREY};
use super::{Fault, Picture};
use measure::stability::map::{Cell, Column, Map, Verdict};
use measure::stability::reasons;
use measure::stability::table::number;
use plotters::coord::Shift;
use plotters::prelude::{DrawingArea, DrawingBackend, RGBColor};

/// A stability map as a picture.
#[derive(Debug)]
pub struct HeatMap<'a>(pub &'a Map);

/// Width of a picture, px. Pictures with many columns are wider.
const WIDTH: i32 = 820;
/// Least width, px, of a column that is alone under the label of its step.
const COLUMN: i32 = 32;
/// Width in px left of the cells, for the values, their unit and the names of the lines above.
const LEFT: i32 = 134;
/// Left end of the legend, px.
const LEGEND: i32 = 60;
/// Width of a line of words: number of letters.
const LETTERS_PER_LINE: usize = 132;
/// Height of a cell in px.
const ROW: i32 = 22;
/// Height of a line of words in px.
const LINE: i32 = 16;
/// Gaps between columns, px: between two methods, and between two steps of one method.
const GAPS: [i32; 2] = [12, 4];

/// Left and right end of a column, px.
struct Lane {
    left: i32,
    right: i32,
}

impl HeatMap<'_> {
    fn about(&self) -> Vec<String> {
        wrapped(&self.0.heading.about, LETTERS_PER_LINE)
    }

    /// Groups neighbouring columns with the same `key`. Returns for each group the indices of its first and last column, and
    /// the key.
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
        // The label of a step must fit over its columns. Several columns are always wide enough, a single one must be wider.
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

    /// Returns for each method the middle of its columns, in px, and its name, broken into lines that are as wide as these
    /// columns.
    fn names(&self, lanes: &[Lane]) -> Vec<(i32, Vec<String>)> {
        let name = |(first, last, text): (usize, usize, String)| {
            let (left, right) = (lanes[first].left, lanes[last].right);
            let letters = ((right - left + GAPS[0]) / 6).max(6) as usize;
            ((left + right) / 2, wrapped(&text, letters))
        };
        self.methods().into_iter().map(name).collect()
    }

    /// Returns for each step the left and right end of its columns, in px, and its label, broken into lines that fit.
    fn steps(&self, lanes: &[Lane]) -> Vec<(i32, i32, Vec<String>)> {
        let step = |(first, last, text): (usize, usize, String)| {
            let (left, right) = (lanes[first].left, lanes[last].right);
            let dt = text.split('\n').nth(1).unwrap_or_default();
            (left, right, wrapped(dt, ((right - left) / 6).max(1) as usize))
        };
        self.groups(|column| format!("{}\n{}", column.method, column.dt)).into_iter().map(step).collect()
    }

    /// Returns the number of lines of the longest label of a step, at least 1.
    fn step_lines(&self, lanes: &[Lane]) -> i32 {
        self.steps(lanes).iter().map(|(.., lines)| lines.len()).max().unwrap_or(1) as i32
    }

    /// Returns the height of the heading above the cells, px.
    fn head(&self) -> i32 {
        let lanes = self.lanes();
        let lines = self.names(&lanes).iter().map(|(_, lines)| lines.len()).max().unwrap_or(0);
        34 + LINE * (self.about().len() + lines) as i32 + 8 + LINE * (1 + self.step_lines(&lanes)) + 6
    }

    /// Returns the outcomes that occur on the map, each with its words.
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
        Words::new(17.0).write(sheet, self.0.heading.title(), (10, 18))?;
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
            let first = steps - LINE * (self.step_lines(lanes) - 1 + lines.len() as i32) - 4;
            for (index, text) in lines.iter().enumerate() {
                Words::new(12.0).centred().write(sheet, text, (middle, first + LINE * index as i32))?;
            }
        }
        for (left, right, lines) in self.steps(lanes) {
            for (index, text) in lines.iter().rev().enumerate() {
                let at = ((left + right) / 2, steps - LINE * index as i32);
                Words::new(12.0).centred().write(sheet, text, at)?;
            }
            line(sheet, [(left + 2, steps + LINE / 2), (right - 2, steps + LINE / 2)], GREY, 1)?;
        }
        for (column, lane) in self.0.heading.columns.iter().zip(lanes) {
            let text = column.passes.to_string();
            Words::new(12.0).centred().write(sheet, &text, ((lane.left + lane.right) / 2, passes))?;
        }
        let small = Words::new(11.0).color(GREY).up_to();
        small.write(sheet, "step, s", (LEFT - 6, steps))?;
        small.write(sheet, "iterations or substeps", (LEFT - 6, passes))
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
        let mut left = LEGEND;
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

/// Returns the colour of the cell, the colour of its letter, and the letter for an outcome.
pub(super) fn look(verdict: &Verdict) -> (RGBColor, RGBColor, String) {
    const WHITE: RGBColor = RGBColor(255, 255, 255);
    match verdict {
        Verdict::Holds => (RGBColor(226, 239, 229), DARK, "·".to_owned()),
        Verdict::Absent(_) => (RGBColor(247, 247, 247), GREY, "–".to_owned()),
        Verdict::Failed(reason) => (paper_of(reason), WHITE, reasons::letter(reason).to_string()),
    }
}

/// Returns the colour of a failed cell for a reason: dark, so that failures stand out also without colour.
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
