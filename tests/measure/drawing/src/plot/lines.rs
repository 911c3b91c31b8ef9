//! Draws the chart of a scene: error over time, one line per method, one panel per size.
//!
//! A line joins the settings of a method for which no faster setting is as accurate. Markers beside the line show the other
//! settings. Crosses in a band above the panel show failed runs, with a row per method.

use super::axis::{Axis, short, short_time};
use super::ink::{Place, Words, cross, dashed, line, marker, wrapped};
use super::style::{DARK, GREY, PALE, look_of};
use super::{Fault, Picture};
use measure::method::{Dt, Setting};
use measure::sweep::{Outcome, Point, Subject};
use plotters::coord::Shift;
use plotters::prelude::{DrawingArea, DrawingBackend, PathElement, Rectangle};
use plotters::style::Color;
use plotters::style::text_anchor::{HPos, VPos};

/// Width of a chart, px: that of a page of text.
const WIDTH: i32 = 800;
/// Height of a row of the legend, px.
const ROW: i32 = 18;
/// Height of a row of the band above a panel, px.
const BAND_ROW: i32 = 13;
/// Radius of a marker, px.
const RADIUS: i32 = 4;
/// Smallest error that the axis shows, as a fraction of the tolerance. Smaller errors lie on a line at the bottom of the panel.
const FLOOR: f64 = 1e-5;

/// Chart of a scene: error over time.
#[derive(Debug, Clone, Copy)]
pub struct Chart<'a> {
    /// The charted scene, with its sizes and tolerance.
    pub subject: &'a Subject,
    /// All methods, each with its recommended setting. The index of a method decides its marker, dashes and colour.
    pub methods: &'a [(&'static str, Setting)],
    /// Measured points of this scene, and perhaps of others, which are not drawn.
    pub points: &'a [Point],
}

type Done<B> = Result<(), Fault<B>>;

impl Picture for Chart<'_> {
    fn size(&self) -> (u32, u32) {
        let legend = self.legend_top() + self.legend_rows() * ROW + 3 * ROW;
        (WIDTH as u32, legend as u32)
    }

    fn paint<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>) -> Done<B> {
        let title = Words::new(18.0).centred();
        title.write(sheet, &self.subject.title(), (WIDTH / 2, 20))?;
        for (row, text) in self.about().iter().enumerate() {
            let about = Words::new(12.0).centred().color(GREY);
            about.write(sheet, text, (WIDTH / 2, 42 + 15 * row as i32))?;
        }
        for (index, &size) in self.subject.sizes.iter().enumerate() {
            self.panel(index, size).paint(sheet)?;
        }
        self.paint_legend(sheet)
    }
}

impl<'a> Chart<'a> {
    fn about(&self) -> Vec<String> {
        wrapped(self.subject.about, 120)
    }

    /// Returns the number of panels side by side, and the number of rows of panels.
    fn grid(&self) -> (i32, i32) {
        match self.subject.sizes.len() as i32 {
            0 | 1 => (1, 1),
            count => (2, (count + 1) / 2),
        }
    }

    fn panel_height(&self) -> i32 {
        if self.grid() == (1, 1) { 400 } else { 330 }
    }

    fn panels_top(&self) -> i32 {
        40 + 15 * self.about().len() as i32
    }

    fn legend_top(&self) -> i32 {
        self.panels_top() + self.grid().1 * self.panel_height() + 14
    }

    /// Returns the indices into `methods` of the methods that have a point in this scene.
    fn present(&self) -> Vec<usize> {
        let is_present = |name| self.points.iter().any(|point| self.is_here(point) && point.method == name);
        (0..self.methods.len()).filter(|&place| is_present(self.methods[place].0)).collect()
    }

    fn is_here(&self, point: &Point) -> bool {
        point.scene == self.subject.name
    }

    fn legend_rows(&self) -> i32 {
        self.present().len().div_ceil(3) as i32
    }

    fn panel(&self, index: usize, size: usize) -> Panel<'a> {
        let (columns, _) = self.grid();
        let (column, row) = (index as i32 % columns, index as i32 / columns);
        let width = WIDTH / columns;
        let points: Vec<&Point> =
            self.points.iter().filter(|point| self.is_here(point) && point.size == size).collect();
        let top = self.panels_top() + row * self.panel_height();
        Panel::new(self, size, points, [column * width, top], [width, self.panel_height()])
    }

    fn paint_legend<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>) -> Done<B> {
        let top = self.legend_top();
        for (index, place) in self.present().into_iter().enumerate() {
            let (x, y) = (40 + 250 * (index as i32 % 3), top + ROW * (index as i32 / 3));
            let look = look_of(place);
            dashed(sheet, &[(x, y), (x + 40, y)], look.dashes, look.color, 2)?;
            marker(sheet, (x + 20, y), &look, RADIUS, true)?;
            Words::new(12.0).write(sheet, self.methods[place].0, (x + 48, y))?;
        }
        let y = top + ROW * self.legend_rows() + 4;
        let notes = [
            "Line: settings that no cheaper setting of the method equals; small markers: other settings; white inside: jittering step;",
            "ring: setting recommended by the method's authors; crosses: failed runs. Further down and to the left is better.",
        ];
        for (row, note) in notes.iter().enumerate() {
            Words::new(11.0).color(GREY).write(sheet, note, (40, y + 15 * row as i32))?;
        }
        Ok(())
    }
}

/// Panel of the chart for one size of the scene.
struct Panel<'a> {
    chart: Chart<'a>,
    size: usize,
    points: Vec<&'a Point>,
    across: Axis,
    up: Axis,
    left: i32,
    right: i32,
    top: i32,
    bottom: i32,
    /// Indices into `methods` of the methods with a failed run.
    failed: Vec<usize>,
}

impl<'a> Panel<'a> {
    fn new(
        chart: &Chart<'a>,
        size: usize,
        points: Vec<&'a Point>,
        [x, y]: [i32; 2],
        [width, height]: [i32; 2],
    ) -> Self {
        let has_failed = |name: &str| points.iter().any(|point| is_failed(point) && point.method == name);
        let failed: Vec<usize> =
            (0..chart.methods.len()).filter(|&place| has_failed(chart.methods[place].0)).collect();
        let (left, right) = (x + 62, x + width - 16);
        let (top, bottom) = (y + 26 + BAND_ROW * failed.len() as i32, y + height - 46);
        let times = points.iter().map(|point| point.microseconds_per_simulated_second);
        let across = Axis::over(times, [left, right]);
        let tolerance = chart.subject.tolerance;
        let errors = points.iter().filter(|point| !is_failed(point)).map(|point| shown(point, tolerance));
        let up = Axis::over(errors.chain([tolerance]), [bottom, top]);
        Panel { chart: *chart, size, points, across, up, left, right, top, bottom, failed }
    }

    fn paint<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>) -> Done<B> {
        self.paint_axes(sheet)?;
        self.paint_failed(sheet)?;
        let places = 0..self.chart.methods.len();
        for place in places.clone() {
            self.paint_line(sheet, place)?;
        }
        // The last method is drawn first: discs of the first ones are smaller than squares and stars, and would be hidden.
        for place in places.rev() {
            self.paint_points(sheet, place)?;
        }
        if self.points.iter().all(|point| is_failed(point)) {
            // The text lies above the line of the tolerance, which is in the middle if all runs failed.
            let middle = ((self.left + self.right) / 2, self.top + (self.bottom - self.top) / 4);
            Words::new(12.0).centred().color(GREY).write(sheet, "every run failed", middle)?;
        }
        self.paint_tolerance(sheet)?;
        self.paint_floor(sheet)
    }

    fn paint_axes<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>) -> Done<B> {
        let Panel { left, right, top, bottom, .. } = *self;
        let words = Words::new(11.0);
        for tick in self.across.ticks(if right - left > 500 { 9 } else { 5 }) {
            line(sheet, [(tick.place, top), (tick.place, bottom)], PALE, 1)?;
            if tick.is_labelled {
                words.centred().write(sheet, &short_time(tick.value), (tick.place, bottom + 12))?;
            }
        }
        for tick in self.up.ticks(7) {
            line(sheet, [(left, tick.place), (right, tick.place)], PALE, 1)?;
            if tick.is_labelled {
                words.up_to().write(sheet, &short(tick.value), (left - 5, tick.place))?;
            }
        }
        sheet.draw(&Rectangle::new([(left, top), (right, bottom)], DARK.stroke_width(1)))?;
        let middle = (left + right) / 2;
        words.centred().write(sheet, "CPU time per simulated second", (middle, bottom + 29))?;
        let Subject { error, unit, .. } = *self.chart.subject;
        let error = if unit.is_empty() { error.to_owned() } else { format!("{error} ({unit})") };
        let upwards = Words { upwards: true, ..words.centred() };
        upwards.write(sheet, &error, (left - 46, (top + bottom) / 2))?;
        if self.size == 0 {
            return Ok(());
        }
        let head = Words { anchor: (HPos::Center, VPos::Center), ..Words::new(12.0) };
        let above = self.top - 12 - BAND_ROW * self.failed.len() as i32;
        head.write(sheet, &format!("{} bodies", self.size), (middle, above))
    }

    fn paint_tolerance<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>) -> Done<B> {
        let y = self.up.place(self.chart.subject.tolerance);
        dashed(sheet, &[(self.left, y), (self.right, y)], &[3.0, 3.0], GREY, 1)?;
        self.label(sheet, "tolerance", y)
    }

    /// Writes the label of a horizontal line at `y`, px. It lies above the line at an end without points, or below it if there
    /// is no space above.
    fn label<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>, text: &str, y: i32) -> Done<B> {
        const HEIGHT: i32 = 14;
        let is_above = y - HEIGHT > self.top;
        let band = if is_above { y - HEIGHT - RADIUS..y + 1 } else { y..y + HEIGHT + RADIUS };
        let width = 6 * text.chars().count() as i32;
        let is_taken = |ends: std::ops::Range<i32>| {
            let fine = self.points.iter().filter(|point| !is_failed(point));
            fine.map(|point| self.place(point)).any(|(x, y)| ends.contains(&x) && band.contains(&y))
        };
        let is_left = is_taken(self.right - width..self.right) && !is_taken(self.left..self.left + width);
        let (side, x) = if is_left { (HPos::Left, self.left + 4) } else { (HPos::Right, self.right - 4) };
        let (edge, y) = if is_above { (VPos::Bottom, y - 2) } else { (VPos::Top, y + 2) };
        Words { anchor: (side, edge), ..Words::new(10.0) }.color(GREY).write(sheet, text, (x, y))
    }

    /// Draws the line at the bottom of the panel. Points whose error is too small for the axis lie on this line.
    fn paint_floor<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>) -> Done<B> {
        let floor = FLOOR * self.chart.subject.tolerance;
        if !self.points.iter().any(|point| !is_failed(point) && point.error < floor) {
            return Ok(());
        }
        let y = self.up.place(floor);
        dashed(sheet, &[(self.left, y), (self.right, y)], &[1.0, 3.0], GREY, 1)?;
        self.label(sheet, &format!("0, or less than {}", short(floor)), y)
    }

    /// Draws a row of crosses for each method with failed runs. The row begins with the marker of the method.
    fn paint_failed<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>) -> Done<B> {
        for (row, &place) in self.failed.iter().rev().enumerate() {
            let y = self.top - BAND_ROW / 2 - 3 - BAND_ROW * row as i32;
            let look = look_of(place);
            line(sheet, [(self.left, y), (self.right, y)], PALE, 1)?;
            marker(sheet, (self.left - 9, y), &look, RADIUS, true)?;
            for point in self.of(place).filter(|point| is_failed(point)) {
                cross(sheet, (self.x(point), y), RADIUS, look.color)?;
                self.paint_ring(sheet, place, point, (self.x(point), y))?;
            }
        }
        if let Some(rows) = i32::try_from(self.failed.len()).ok().filter(|&rows| rows > 0) {
            let y = self.top - BAND_ROW * rows / 2;
            Words::new(10.0).up_to().color(GREY).write(sheet, "failed", (self.left - 18, y))?;
        }
        Ok(())
    }

    fn worth(&self, place: usize) -> Vec<&'a Point> {
        let fine = self.of(place).filter(|point| !is_failed(point));
        worth_their_time(fine, self.chart.subject.tolerance)
    }

    fn paint_line<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>, place: usize) -> Done<B> {
        let corners: Vec<Place> = self.worth(place).iter().map(|point| self.place(point)).collect();
        if corners.len() < 2 {
            return Ok(());
        }
        let look = look_of(place);
        dashed(sheet, &corners, look.dashes, look.color, 2)
    }

    fn paint_points<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>, place: usize) -> Done<B> {
        let (look, worth) = (look_of(place), self.worth(place));
        for point in self.of(place).filter(|point| !is_failed(point)) {
            let at = self.place(point);
            let is_on_line = worth.iter().any(|other| std::ptr::eq(*other, point));
            let jitters = matches!(point.setting.dt, Dt::Jitter { .. });
            self.paint_ring(sheet, place, point, at)?;
            marker(sheet, at, &look, if is_on_line { RADIUS } else { RADIUS - 2 }, !jitters)?;
        }
        Ok(())
    }

    /// Draws a ring about the point of the setting that a method's authors recommend.
    fn paint_ring<B: DrawingBackend>(
        &self,
        sheet: &DrawingArea<B, Shift>,
        place: usize,
        point: &Point,
        at: Place,
    ) -> Done<B> {
        if point.setting != self.chart.methods[place].1 {
            return Ok(());
        }
        sheet.draw(&PathElement::new(ring(at, 2 * RADIUS), look_of(place).color.stroke_width(1)))
    }

    fn of(&self, place: usize) -> impl Iterator<Item = &'a Point> {
        let name = self.chart.methods[place].0;
        self.points.iter().copied().filter(move |point| point.method == name)
    }

    fn x(&self, point: &Point) -> i32 {
        self.across.place(point.microseconds_per_simulated_second)
    }

    fn place(&self, point: &Point) -> Place {
        (self.x(point), self.up.place(shown(point, self.chart.subject.tolerance)))
    }
}

/// Returns the points of a circle as a closed path. It stays empty inside, while the backend may fill its own circles.
fn ring((x, y): Place, radius: i32) -> Vec<Place> {
    let corner = |index| {
        let angle = std::f64::consts::TAU * f64::from(index) / 24.0;
        let [dx, dy] = [angle.cos(), angle.sin()].map(|part| (part * f64::from(radius)).round() as i32);
        (x + dx, y + dy)
    };
    (0..=24).map(corner).collect()
}

/// Returns the error at which a point is drawn: its own, but at least [`FLOOR`] times the tolerance. Unit: that of the scene.
fn shown(point: &Point, tolerance: f64) -> f64 {
    point.error.max(FLOOR * tolerance)
}

fn is_failed(point: &Point) -> bool {
    point.outcome != Outcome::Fine || !point.error.is_finite()
}

/// Returns the points with a smaller drawn error than every point that takes less time, sorted by time.
fn worth_their_time<'a>(points: impl Iterator<Item = &'a Point>, tolerance: f64) -> Vec<&'a Point> {
    let mut points: Vec<&Point> = points.collect();
    let time = |point: &Point| point.microseconds_per_simulated_second;
    points.sort_by(|a, b| time(a).total_cmp(&time(b)).then(a.error.total_cmp(&b.error)));
    let mut best = f64::INFINITY;
    points.retain(|point| {
        let error = shown(point, tolerance);
        let is_better = error < best;
        best = best.min(error);
        is_better
    });
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::svg;

    fn point(method: &'static str, time: f64, error: f64) -> Point {
        Point {
            scene: "drop",
            size: 5,
            method,
            setting: Setting::fixed(0.01, 5),
            error,
            outcome: if error.is_finite() { Outcome::Fine } else { Outcome::Failed("flew off") },
            microseconds_per_simulated_second: time,
            steps: 1,
            turns: 1,
        }
    }

    fn drawn(points: &[Point]) -> String {
        let subject = Subject {
            name: "drop",
            about: "It drops.",
            sizes: vec![5],
            error: "height",
            unit: "px",
            tolerance: 1.0,
        };
        let methods = [("ours", Setting::fixed(0.02, 5)), ("theirs", Setting::fixed(0.02, 5))];
        svg(&Chart { subject: &subject, methods: &methods, points }).unwrap_or_else(|error| panic!("{error}"))
    }

    #[test]
    fn a_line_omits_points_that_are_slower_and_no_more_accurate() {
        let points = [(10.0, 1.0), (20.0, 2.0), (30.0, 0.5), (5.0, 4.0)]
            .map(|(time, error)| point("ours", time, error));
        let times: Vec<f64> = worth_their_time(points.iter(), 1.0)
            .iter()
            .map(|point| point.microseconds_per_simulated_second)
            .collect();
        assert_eq!(times, [5.0, 10.0, 30.0]);
    }

    #[test]
    fn every_failed_run_is_a_cross_of_two_strokes() {
        let fine = point("ours", 10.0, 0.5);
        let strokes = |points: &[Point]| drawn(points).matches("stroke-width=\"2\"").count();
        let without = strokes(&[fine.clone(), point("theirs", 20.0, 0.5)]);
        assert_eq!(strokes(&[fine, point("theirs", 20.0, f64::INFINITY)]), without + 2);
    }

    #[test]
    fn axes_name_their_quantity_and_unit() {
        let text = drawn(&[point("ours", 10.0, 0.5)]);
        assert!(text.contains("height (px)") && text.contains("CPU time per simulated second"));
        assert!(text.contains("10 µs"));
    }

    #[test]
    fn a_chart_of_failures_alone_can_be_drawn() {
        assert!(drawn(&[point("ours", 10.0, f64::INFINITY)]).contains("failed"));
    }
}
