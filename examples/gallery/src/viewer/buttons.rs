//! Buttons on the screen: each is a key.

use twohalf_render::{Canvas, Color, Point, Text, Transform};

use crate::keys::{Key, KeySet};
use crate::scenes::Game;

/// Height of a row of the bar, px.
pub(super) const ROW: f32 = 34.0;
const GAP: f32 = 4.0;
/// Px of a letter.
const LETTER: f32 = 8.0;

const BAR: [(Key, &str); 11] = [
    (Key::List, "Scenes"),
    (Key::Pause, "Pause"),
    (Key::Step, "Step"),
    (Key::Slow, "Slow"),
    (Key::Restart, "Restart"),
    (Key::Rewind, "Rewind"),
    (Key::Methods, "Set"),
    (Key::Outlines, "Layers"),
    (Key::Graph, "Graph"),
    (Key::Help, "Help"),
    (Key::Full, "Full"),
];
const LAYERS: [(Key, &str); 6] = [
    (Key::Outlines, "Outlines"),
    (Key::Boxes, "Boxes"),
    (Key::Contacts, "Contacts"),
    (Key::Islands, "Islands"),
    (Key::Sleep, "Sleep"),
    (Key::Joints, "Joints"),
];

/// Action of a button.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Does {
    /// The action of the key.
    Presses(Key),
    /// Shows or hides the row of layers.
    Layers,
}

/// A button with its rectangle.
#[derive(Debug, Clone)]
pub(super) struct Button {
    pub(super) does: Does,
    label: &'static str,
    pub(super) corner: Point,
    pub(super) size: Point,
}

impl Button {
    /// Whether a point is inside of it.
    pub(super) fn holds(&self, point: Point) -> bool {
        (0..2).all(|axis| (self.corner[axis]..self.corner[axis] + self.size[axis]).contains(&point[axis]))
    }

    pub(super) fn draw(&self, is_lit: bool, opacity: f32, canvas: &mut dyn Canvas) {
        let color = if is_lit { Color::rgb(206, 130, 40) } else { Color::rgb(56, 66, 84) };
        canvas.fill_rectangle(self.corner, self.size, &Transform::IDENTITY, color.with_opacity(opacity));
        let middle = [self.corner[0] + 0.5 * self.size[0], self.corner[1] + 0.5 * self.size[1]];
        Text::centered(self.label, middle).draw(canvas);
    }
}

/// The bar along the lower edge, in the necessary number of rows, and its height.
pub(super) fn bar(size: Point, has_layers: bool) -> (Vec<Button>, f32) {
    let mut entries: Vec<(Does, &str)> = BAR
        .iter()
        .map(|&(key, label)| (if key == Key::Outlines { Does::Layers } else { Does::Presses(key) }, label))
        .collect();
    if has_layers {
        entries.extend(LAYERS.iter().map(|&(key, label)| (Does::Presses(key), label)));
    }
    let (mut buttons, mut x, mut row) = (Vec::new(), GAP, 0);
    for (index, (does, label)) in entries.into_iter().enumerate() {
        let width = LETTER * label.len() as f32 + 16.0;
        // Layers have rows of their own.
        if x + width + GAP > size[0] || index == BAR.len() {
            (x, row) = (GAP, row + 1);
        }
        buttons.push(Button { does, label, corner: [x, row as f32 * ROW], size: [width, ROW - GAP] });
        x += width + GAP;
    }
    let height = (row + 1) as f32 * ROW;
    buttons.iter_mut().for_each(|button| button.corner[1] += size[1] - height);
    (buttons, height)
}

/// Large buttons for thumbs, over the lower corners of a scene that ends at `bottom`.
pub(super) fn pad(game: Game, width: f32, bottom: f32) -> Vec<Button> {
    const SIDE: f32 = 58.0;
    let step = SIDE + GAP;
    let button = |key, label, column: f32, row: f32| {
        // Columns below zero are counted from the right edge.
        let left = if column < 0.0 { width + column * step } else { GAP + column * step };
        Button { does: Does::Presses(key), label, corner: [left, bottom - row * step], size: [SIDE, SIDE] }
    };
    match game {
        Game::None => Vec::new(),
        Game::Pinball => vec![
            button(Key::Left, "Left", 0.0, 1.0),
            button(Key::Right, "Right", -1.0, 1.0),
            button(Key::Jump, "Launch", -1.0, 2.0),
        ],
        Game::Replay => vec![
            button(Key::Left, "<", 0.0, 1.0),
            button(Key::Right, ">", 1.0, 1.0),
            button(Key::Down, "<<", -2.0, 1.0),
            button(Key::Up, ">>", -1.0, 1.0),
            button(Key::Jump, "Part", -1.0, 2.0),
        ],
        Game::Brawler => vec![
            button(Key::Left, "<", 0.0, 1.0),
            button(Key::Down, "v", 1.0, 1.0),
            button(Key::Up, "^", 1.0, 2.0),
            button(Key::Right, ">", 2.0, 1.0),
            button(Key::Jump, "Jump", -1.0, 1.0),
            button(Key::Punch, "Punch", -2.0, 1.0),
            button(Key::Grab, "Grab", -1.0, 2.0),
        ],
    }
}

/// The keys under some points.
pub(super) fn pressed(buttons: &[Button], points: &[Point]) -> KeySet {
    let under = |button: &&Button| points.iter().any(|&point| button.holds(point));
    let keys = buttons.iter().filter(under).filter_map(|button| match button.does {
        Does::Presses(key) => Some(key),
        Does::Layers => None,
    });
    keys.collect()
}
