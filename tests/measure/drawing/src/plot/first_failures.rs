//! Draws the first failures of all maps on one sheet: up to which value every family holds, by method and setting.

use super::heat::look;
use super::ink::{Words, area, wrapped};
use super::style::GREY;
use super::{Fault, Picture};
use crate::maps::table_columns;
use measure::stability::map::{Column, Map};
use measure::stability::reasons::{self, LETTERS};
use measure::stability::table::number;
use plotters::coord::Shift;
use plotters::prelude::{DrawingArea, DrawingBackend};
use std::collections::BTreeSet;

/// A picture of the first failures of some maps.
#[derive(Debug)]
pub struct FirstFailures<'a> {
    maps: &'a [Map],
    columns: Vec<&'a Column>,
}

/// Width in px of the names of families, left of the cells.
const LEFT: i32 = 208;
/// Width of a column in px; its left part shows the values, the rest names the first failure.
const COLUMN: i32 = 106;
/// Width in px of the part of a column that shows the values.
const STRIP: i32 = 50;
/// Height of a family's row in px.
const ROW: i32 = 19;
/// Height in px of the heading above the rows.
const HEAD: i32 = 128;

impl<'a> FirstFailures<'a> {
    /// Returns the picture of these maps.
    pub fn new(maps: &'a [Map]) -> Self {
        FirstFailures { maps, columns: table_columns(maps) }
    }
}

impl Picture for FirstFailures<'_> {
    fn size(&self) -> (u32, u32) {
        let width = LEFT + COLUMN * self.columns.len() as i32 + 8;
        (width.max(480) as u32, (HEAD + ROW * self.maps.len() as i32 + 12) as u32)
    }

    fn paint<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>) -> Result<(), Fault<B>> {
        Words::new(17.0).write(sheet, "Where methods fail first", (10, 18))?;
        // The letter of a reason and its words must not be broken into two lines.
        let reasons: Vec<String> =
            self.reasons().iter().map(|word| format!("{}\u{a0}{word}", reasons::letter(word))).collect();
        let about = format!(
            "A box for every value of the family's parameter, from easy to hard: pale where the method holds, dark \
             where it fails, none where the engine cannot run it. Beside it: the reason of the first failure and its \
             value, or the last value that could be run. {}.",
            reasons.join(", ")
        );
        let letters = (self.size().0 / 6) as usize - 4;
        for (index, text) in wrapped(&about, letters).iter().enumerate() {
            Words::new(12.0).color(GREY).write(sheet, text, (10, 36 + 15 * index as i32))?;
        }
        for (index, column) in self.columns.iter().enumerate() {
            let left = LEFT + COLUMN * index as i32;
            let mut lines = wrapped(&column.method, 16);
            lines.push(format!("{} s x {}", column.dt, column.passes));
            for (line, text) in lines.iter().rev().enumerate() {
                Words::new(12.0).write(sheet, text, (left, HEAD - 10 - 15 * line as i32))?;
            }
        }
        for (index, map) in self.maps.iter().enumerate() {
            self.paint_family(sheet, map, HEAD + ROW * index as i32)?;
        }
        Ok(())
    }
}

impl FirstFailures<'_> {
    /// Returns the reasons of all first failures on the sheet.
    fn reasons(&self) -> Vec<&'static str> {
        let firsts = self.maps.iter().flat_map(|map| {
            let places = self.columns.iter().filter_map(|column| map.place(column));
            places.filter_map(|place| map.first_failure(place)).map(|(_, reason)| reason)
        });
        let found: BTreeSet<&str> = firsts.collect();
        LETTERS.iter().map(|&(word, _)| word).filter(|word| found.contains(word)).collect()
    }

    fn paint_family<B: DrawingBackend>(
        &self,
        sheet: &DrawingArea<B, Shift>,
        map: &Map,
        top: i32,
    ) -> Result<(), Fault<B>> {
        let middle = top + ROW / 2;
        Words::new(12.0).up_to().write(sheet, map.heading.title(), (LEFT - 8, middle))?;
        for (index, column) in self.columns.iter().enumerate() {
            let Some(place) = map.place(column) else { continue };
            let left = LEFT + COLUMN * index as i32;
            if map.is_absent(place) {
                Words::new(12.0).color(GREY).write(sheet, "–", (left, middle))?;
                continue;
            }
            let count = map.rows.len() as i32;
            for (box_index, row) in map.rows.iter().enumerate() {
                let edge = |index: usize| left + STRIP * index as i32 / count;
                let corners = [(edge(box_index), top + 3), (edge(box_index + 1) - 1, top + ROW - 3)];
                area(sheet, corners, look(&row[place].verdict).0)?;
            }
            Words::new(12.0).write(sheet, &outcome(map, place), (left + STRIP + 5, middle))?;
        }
        Ok(())
    }
}

/// Returns the text beside the boxes of a column: the first failure of a map.
fn outcome(map: &Map, place: usize) -> String {
    match (map.first_failure(place), map.runs_to(place)) {
        (Some((value, reason)), _) => format!("{} {}", reasons::letter(reason), number(value)),
        (None, Some(last)) => format!("to {}", number(last)),
        (None, None) => "holds".to_owned(),
    }
}
