//! Draws the time per step over the number of bodies: one panel per scene, one line per engine.

use super::axis::{Axis, short_time};
use super::ink::{Place, Words, dashed, line, marker};
use super::style::{DARK, GREY, PALE, look_of};
use super::{Fault, Picture};
use plotters::coord::Shift;
use plotters::prelude::{DrawingArea, DrawingBackend, Rectangle};
use plotters::style::Color;

/// Number of panels side by side.
const COLUMNS: usize = 3;
/// Width and height of a panel with its margins, px.
const PANEL: (i32, i32) = (266, 220);
/// Heights of the title above the panels and of the legend below them, px.
const TITLE: i32 = 50;
const LEGEND: i32 = 50;

/// Times of all engines in a scene: points of number of bodies and CPU time per step in µs, one list per engine.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneTimes {
    /// Name of the scene.
    pub scene: String,
    /// Points of each engine, in the order of [`TimesChart::engines`].
    pub lines: Vec<Vec<(f64, f64)>>,
}

/// Chart of the time per step over the number of bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct TimesChart {
    /// Title of the chart.
    pub title: String,
    /// Names of the engines.
    pub engines: Vec<&'static str>,
    /// Scenes, in the order of the panels.
    pub scenes: Vec<SceneTimes>,
}

type Done<B> = Result<(), Fault<B>>;

impl Picture for TimesChart {
    fn size(&self) -> (u32, u32) {
        let rows = self.scenes.len().div_ceil(COLUMNS) as i32;
        ((COLUMNS as i32 * PANEL.0) as u32, (TITLE + rows * PANEL.1 + LEGEND) as u32)
    }

    fn paint<B: DrawingBackend>(&self, sheet: &DrawingArea<B, Shift>) -> Done<B> {
        let (width, height) = self.size();
        let middle = width as i32 / 2;
        Words::new(18.0).centred().write(sheet, &self.title, (middle, 18))?;
        let about = "CPU time per step over the number of bodies; lower is better";
        Words::new(12.0).centred().color(GREY).write(sheet, about, (middle, 38))?;
        for (index, scene) in self.scenes.iter().enumerate() {
            let (column, row) = ((index % COLUMNS) as i32, (index / COLUMNS) as i32);
            paint_panel(sheet, scene, (column * PANEL.0, TITLE + row * PANEL.1))?;
        }
        for (index, engine) in self.engines.iter().enumerate() {
            let (x, y) = (60 + 230 * index as i32, height as i32 - 22);
            let look = look_of(index);
            dashed(sheet, &[(x, y), (x + 40, y)], look.dashes, look.color, 2)?;
            marker(sheet, (x + 20, y), &look, 4, true)?;
            Words::new(12.0).write(sheet, engine, (x + 48, y))?;
        }
        Ok(())
    }
}

/// Draws the panel of a scene; `x` and `y` are its upper left corner, px.
fn paint_panel<B: DrawingBackend>(
    sheet: &DrawingArea<B, Shift>,
    scene: &SceneTimes,
    (x, y): Place,
) -> Done<B> {
    let (left, right, top, bottom) = (x + 58, x + PANEL.0 - 8, y + 26, y + PANEL.1 - 24);
    let points = || scene.lines.iter().flatten();
    let across = Axis::over(points().map(|point| point.0), [left, right]);
    let up = Axis::over(points().map(|point| point.1), [bottom, top]);
    Words::new(13.0).centred().write(sheet, &scene.scene.replace('_', " "), ((left + right) / 2, y + 14))?;
    let words = Words::new(10.0);
    for tick in across.ticks(4).into_iter().filter(|tick| tick.is_labelled) {
        line(sheet, [(tick.place, top), (tick.place, bottom)], PALE, 1)?;
        words.centred().write(sheet, &format!("{:.0}", tick.value), (tick.place, bottom + 11))?;
    }
    for tick in up.ticks(5).into_iter().filter(|tick| tick.is_labelled) {
        line(sheet, [(left, tick.place), (right, tick.place)], PALE, 1)?;
        words.up_to().write(sheet, &short_time(tick.value), (left - 5, tick.place))?;
    }
    sheet.draw(&Rectangle::new([(left, top), (right, bottom)], DARK.stroke_width(1)))?;
    for (index, points) in scene.lines.iter().enumerate() {
        let look = look_of(index);
        let places: Vec<Place> =
            points.iter().map(|&(bodies, time)| (across.place(bodies), up.place(time))).collect();
        if places.len() > 1 {
            dashed(sheet, &places, look.dashes, look.color, 2)?;
        }
        places.iter().try_for_each(|&at| marker(sheet, at, &look, 3, true))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::svg;

    #[test]
    fn every_scene_and_engine_is_named() {
        let scene = |name: &str| SceneTimes {
            scene: name.to_owned(),
            lines: vec![vec![(100.0, 20.0), (1000.0, 200.0)], vec![(100.0, 30.0)]],
        };
        let chart = TimesChart {
            title: "Arena".to_owned(),
            engines: vec!["one engine", "another"],
            scenes: ["a_heap", "b", "c", "d"].map(scene).to_vec(),
        };
        assert_eq!(chart.size(), (3 * 266, 50 + 2 * 220 + 50));
        let text = svg(&chart).expect("it can be painted");
        for name in ["Arena", "one engine", "another", "a heap"] {
            assert!(text.contains(name), "{name}");
        }
    }
}
