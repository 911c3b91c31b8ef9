//! Chart and table of the time per step over the number of objects, for one scene in 2D and in 2.5D.

use crate::plot::axis::{Axis, short_time};
use crate::plot::ink::{Place, Words, dashed, line, marker};
use crate::plot::style::{DARK, GREY, PALE, look_of};
use crate::plot::{Fault, Picture};
use measure::depth::{plane_methods, plane_point, plane_sizes, time_per_step};
use measure::sweep::Point;
use plotters::coord::Shift;
use plotters::prelude::{DrawingArea, DrawingBackend, Rectangle};
use plotters::style::Color;
use std::fmt::Write;

/// Width and height of the chart, px.
const SIZE: (i32, i32) = (800, 440);
/// Left edge of the panel, px from the left. The next constants are its other edges, px from the left or the top.
const LEFT: i32 = 80;
const RIGHT: i32 = 780;
const TOP: i32 = 60;
const BOTTOM: i32 = 350;

/// Returns the names of the compared engines. The first one has no depth.
fn plane_names() -> [&'static str; 3] {
    plane_methods().map(|method| method.name)
}

/// Chart of the time per step over the number of objects, in 2D and in 2.5D.
#[derive(Debug, Clone, Copy)]
pub struct PlaneChart<'a> {
    /// Measured points of the comparison, and perhaps of other scenes, which are not drawn.
    pub points: &'a [Point],
}

type Done<B> = Result<(), Fault<B>>;

impl Picture for PlaneChart<'_> {
    fn size(&self) -> (u32, u32) {
        (SIZE.0 as u32, SIZE.1 as u32)
    }

    fn paint<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>) -> Done<B> {
        let middle = (LEFT + RIGHT) / 2;
        Words::new(18.0).centred().write(sheet, "The same scene in 2D and in 2.5D", (SIZE.0 / 2, 20))?;
        let about = "Circles that fall into a pit, all at one depth; steps of 1/60 s with 5 iterations";
        Words::new(12.0).centred().color(GREY).write(sheet, about, (SIZE.0 / 2, 42))?;
        self.paint_axes(sheet)?;
        Words::new(11.0).centred().write(sheet, "objects", (middle, BOTTOM + 30))?;
        let upwards = Words { upwards: true, ..Words::new(11.0).centred() };
        upwards.write(sheet, "CPU time per step", (LEFT - 60, (TOP + BOTTOM) / 2))?;
        for (index, method) in plane_names().into_iter().enumerate() {
            self.paint_method(sheet, index, method)?;
        }
        let note = "Medians of runs that took turns in one process. Lower is better.";
        Words::new(11.0).color(GREY).write(sheet, note, (40, SIZE.1 - 16))
    }
}

impl PlaneChart<'_> {
    /// Returns the axis of numbers of objects, and that of times.
    fn axes(&self) -> [Axis; 2] {
        let of =
            |method| plane_sizes(self.points).filter_map(move |size| plane_point(self.points, size, method));
        let times = plane_names().into_iter().flat_map(of).map(time_per_step);
        let objects = plane_sizes(self.points).map(|size| size as f64);
        [Axis::over(objects, [LEFT, RIGHT]), Axis::over(times, [BOTTOM, TOP])]
    }

    fn paint_axes<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>) -> Done<B> {
        let [across, up] = self.axes();
        let words = Words::new(11.0);
        for size in plane_sizes(self.points) {
            let x = across.place(size as f64);
            line(sheet, [(x, TOP), (x, BOTTOM)], PALE, 1)?;
            words.centred().write(sheet, &size.to_string(), (x, BOTTOM + 12))?;
        }
        for tick in up.ticks(7) {
            line(sheet, [(LEFT, tick.place), (RIGHT, tick.place)], PALE, 1)?;
            if tick.is_labelled {
                words.up_to().write(sheet, &short_time(tick.value), (LEFT - 5, tick.place))?;
            }
        }
        sheet.draw(&Rectangle::new([(LEFT, TOP), (RIGHT, BOTTOM)], DARK.stroke_width(1)))
    }

    /// Draws the line of a method, and its entry in the legend.
    fn paint_method<B: DrawingBackend>(
        &self,
        sheet: &DrawingArea<B, Shift>,
        index: usize,
        method: &str,
    ) -> Done<B> {
        let [across, up] = self.axes();
        let place = |size| {
            let point = plane_point(self.points, size, method)?;
            Some((across.place(size as f64), up.place(time_per_step(point))))
        };
        let places: Vec<Place> = plane_sizes(self.points).filter_map(place).collect();
        let look = look_of(index);
        if places.len() > 1 {
            dashed(sheet, &places, look.dashes, look.color, 2)?;
        }
        for &at in &places {
            marker(sheet, at, &look, 4, true)?;
        }
        let (x, y) = (LEFT + 230 * index as i32, BOTTOM + 54);
        dashed(sheet, &[(x, y), (x + 40, y)], look.dashes, look.color, 2)?;
        marker(sheet, (x + 20, y), &look, 4, true)?;
        Words::new(12.0).write(sheet, method, (x + 48, y))
    }
}

/// Returns a Markdown table of the times per step, with the engines side by side. `None` if `points` has no point of the
/// comparison.
pub fn plane_table(points: &[Point]) -> Option<String> {
    plane_sizes(points).next()?;
    let mut text = "| objects |".to_owned();
    for method in plane_names() {
        add(&mut text, format_args!(" {method} | times 2D |"));
    }
    text += "\n|---:|---:|---:|---:|---:|---:|---:|\n";
    for size in plane_sizes(points) {
        let flat = plane_point(points, size, plane_names()[0]).map(time_per_step);
        add(&mut text, format_args!("| {size} |"));
        for method in plane_names() {
            match plane_point(points, size, method).map(time_per_step) {
                Some(time) => {
                    let ratio = flat.map_or("-".to_owned(), |flat| format!("{:.2}", time / flat));
                    add(&mut text, format_args!(" {} | {ratio} |", short_time(time)));
                }
                None => text += " - | - |",
            }
        }
        text += "\n";
    }
    Some(text)
}

fn add(text: &mut String, what: std::fmt::Arguments<'_>) {
    text.write_fmt(what).expect("a string takes everything");
}

#[cfg(test)]
mod tests {
    use super::*;
    use measure::depth::PLANES;
    use measure::method::Setting;
    use measure::sweep::Outcome;

    #[test]
    fn the_table_has_times_per_step_beside_those_of_2d() {
        let point = |method, time: f64| Point {
            scene: PLANES,
            size: 20,
            method,
            setting: Setting::fixed(1.0 / 60.0, 5),
            error: 0.0,
            outcome: Outcome::Fine,
            microseconds_per_simulated_second: 60.0 * time,
            steps: 1,
            turns: 1,
        };
        let points = [point("2D", 20.0), point("2.5D, faithful", 50.0)];
        let table = plane_table(&points).unwrap_or_default();
        assert_eq!(table.lines().nth(2), Some("| 20 | 20 µs | 1.00 | 50 µs | 2.50 | - | - |"));
    }

    #[test]
    fn without_points_there_is_no_table() {
        assert_eq!(plane_table(&[]), None);
    }
}
