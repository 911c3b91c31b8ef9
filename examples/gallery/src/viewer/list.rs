//! The list of scenes, to choose from.

use twohalf_render::{Canvas, Color, Point, Text, Transform};

use crate::scenes::GalleryScene;

/// Height of an entry in px.
const ENTRY: f32 = 44.0;
/// Widest and narrowest column in px.
const COLUMN: f32 = 420.0;
const MARGIN: f32 = 12.0;
const TOP: f32 = 52.0;

/// The visible part of the list, and its selected entry.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct List {
    /// Px that are scrolled out at the top.
    pub(super) scrolled: f32,
    /// The entry that the arrow keys have reached.
    pub(super) at: usize,
}

impl List {
    fn columns(size: Point) -> usize {
        ((size[0] - MARGIN) / COLUMN).floor().max(1.0) as usize
    }

    /// Corner and size of an entry.
    fn place(&self, size: Point, index: usize) -> [Point; 2] {
        let columns = List::columns(size);
        let width = (size[0] - MARGIN) / columns as f32;
        let [column, row] = [index % columns, index / columns].map(|at| at as f32);
        [[MARGIN + column * width, TOP + row * ENTRY - self.scrolled], [width - MARGIN, ENTRY - 6.0]]
    }

    /// Scrolls by a distance in px, within the entries.
    pub(super) fn scroll(&mut self, by: f32, size: Point, count: usize) {
        let rows = count.div_ceil(List::columns(size)) as f32;
        let most = (rows * ENTRY + TOP - size[1] + MARGIN).max(0.0);
        self.scrolled = (self.scrolled + by).clamp(0.0, most);
    }

    /// Moves the selection by rows and columns, and scrolls to it.
    pub(super) fn step(&mut self, [rows, columns]: [i32; 2], size: Point, count: usize) {
        let by = rows * List::columns(size) as i32 + columns;
        self.at = (self.at as i32 + by).clamp(0, count as i32 - 1) as usize;
        let [[_, y], [_, height]] = self.place(size, self.at);
        let [above, below] = [TOP - y, y + height + MARGIN - size[1]].map(|px| px.max(0.0));
        self.scroll(below - above, size, count);
    }

    /// The entry at a point.
    pub(super) fn entry(&self, size: Point, count: usize, point: Point) -> Option<usize> {
        let holds = |index: &usize| {
            let [corner, size] = self.place(size, *index);
            (0..2).all(|axis| (corner[axis]..corner[axis] + size[axis]).contains(&point[axis]))
        };
        (0..count).find(|index| point[1] > TOP - MARGIN && holds(index))
    }

    pub(super) fn draw(&self, scenes: &[GalleryScene], size: Point, canvas: &mut dyn Canvas) {
        let still = Transform::IDENTITY;
        canvas.fill_rectangle([0.0; 2], size, &still, Color::rgba(14, 18, 26, 235));
        for (index, scene) in scenes.iter().enumerate() {
            let [corner, entry] = self.place(size, index);
            if corner[1] + entry[1] < TOP - MARGIN || corner[1] > size[1] {
                continue;
            }
            let color = if index == self.at { Color::rgb(206, 130, 40) } else { Color::rgb(46, 56, 74) };
            canvas.fill_rectangle(corner, entry, &still, color);
            let text = |text: &str, down: f32, scale: f32, color| {
                let letters = ((entry[0] - 16.0) / (8.0 * scale)).max(1.0) as usize;
                let text: String = text.chars().take(letters).collect();
                Text { scale: [scale; 2], color, ..Text::new(text, [corner[0] + 8.0, corner[1] + down]) }
            };
            text(&scene.title, 6.0, 1.5, Color::WHITE).draw(canvas);
            text(&scene.about, 24.0, 1.0, Color::rgb(190, 200, 214)).draw(canvas);
        }
        canvas.fill_rectangle([0.0; 2], [size[0], TOP - MARGIN], &still, Color::rgb(14, 18, 26));
        Text { scale: [2.0; 2], ..Text::new("Choose a scene", [MARGIN, 14.0]) }.draw(canvas);
    }
}
