//! The gallery's controls around a scene.

use examples::Result;
use twohalf_render::{Canvas, Color, Text, Transform};

use super::Viewer;
use super::buttons::{self, Does};
use crate::keys::Key;
use crate::scenes::Game;
use crate::state;

/// Height of the title in px.
pub(super) const TITLE: f32 = 36.0;
/// Px at the upper right corner that a page has a button of its own on.
const CORNER: f32 = 46.0;
const INK: Color = Color::rgb(232, 236, 242);
const PALE: Color = Color::rgb(160, 172, 190);
const PAPER: Color = Color::rgb(14, 18, 26);

const HELP: &str = "\
Mouse, finger   hold, drag and throw
Wheel, pinch    look closer
Esc             list of scenes
PgUp PgDn       scene before, after
P               pause
.               one step
O               slow motion
R               restart
B               back in time, held
M               other set of methods
1 2 3           outlines, boxes, contacts
4 5 6           islands, sleep, joints
G               frame times
F               full screen
H               this help";
const KEYS_OF_PINBALL: &str = "Left, Right: flippers   Space: launch";
const KEYS_OF_BRAWLER: &str = "Arrows: walk   Space: jump   X: strike   C: lift, throw";
const KEYS_OF_REPLAY: &str = "Left, right: step   Down, up: keyframe   Space: where the runs part";

pub(super) fn draw(viewer: &Viewer, canvas: &mut dyn Canvas) -> Result<()> {
    let size = viewer.size;
    canvas.clear(PAPER);
    let area = viewer.area(size);
    viewer.show.draw(canvas, area, viewer.layers)?;
    draw_title(viewer, canvas);
    if viewer.has_graph {
        viewer.times.draw([8.0, area[0][1] + area[1][1] - 8.0], canvas);
    }
    draw_hints(viewer, canvas);
    if viewer.has_help {
        draw_help(canvas, area[0][1]);
    }
    if let Some(list) = &viewer.list {
        let below = [size[0], area[0][1] + area[1][1]];
        list.draw(&viewer.scenes, below, canvas);
    }
    draw_buttons(viewer, canvas);
    Ok(())
}

fn draw_title(viewer: &Viewer, canvas: &mut dyn Canvas) {
    let scene = &viewer.scenes[viewer.at];
    let width = viewer.size[0];
    canvas.fill_rectangle([0.0; 2], [width, TITLE], &Transform::IDENTITY, PAPER);
    let scale = if width < 600.0 { 1.5 } else { 2.0 };
    let title = Text { scale: [scale; 2], color: INK, ..Text::new(&scene.title, [8.0, 5.0]) };
    let end = 8.0 + scale * title.size()[0];
    title.draw(canvas);
    let letters = ((width - CORNER - 8.0) / 8.0).max(1.0) as usize;
    let about: String = scene.about.chars().take(letters).collect();
    Text { color: PALE, ..Text::new(about, [8.0, 24.0]) }.draw(canvas);
    let facts = facts(viewer);
    let facts = Text::new(&facts, [width - CORNER - 8.0 * facts.len() as f32, 8.0]);
    if facts.position[0] > end + 16.0 {
        Text { color: PALE, ..facts }.draw(canvas);
    }
}

fn facts(viewer: &Viewer) -> String {
    let halves = viewer.show.halves();
    let counts: Vec<_> = halves.iter().map(|half| state::counts(half.play().world())).collect();
    let sum = |of: fn(&state::Counts) -> usize| counts.iter().map(of).sum::<usize>();
    let sets: Vec<&str> = halves.iter().map(|half| half.set().name()).collect();
    let asleep = match sum(|counts| counts.asleep) {
        0 => String::new(),
        asleep => format!(", {asleep} asleep"),
    };
    format!(
        "{} bodies, {} contacts{asleep}, {}",
        sum(|of| of.bodies),
        sum(|of| of.contacts),
        sets.join(" | ")
    )
}

/// The present hint: a message, or the keys of a game.
fn draw_hints(viewer: &Viewer, canvas: &mut dyn Canvas) {
    let keys = match viewer.scenes[viewer.at].game {
        Game::Pinball => KEYS_OF_PINBALL,
        Game::Brawler => KEYS_OF_BRAWLER,
        Game::Replay => KEYS_OF_REPLAY,
        Game::None => "",
    };
    let hint = if viewer.message.1 > 0.0 {
        &viewer.message.0
    } else if viewer.is_paused {
        "Paused"
    } else if viewer.has_touch || viewer.is_played {
        ""
    } else {
        keys
    };
    if hint.is_empty() {
        return;
    }
    let text = Text::new(wrapped(hint, (viewer.size[0] / 8.0 - 3.0).max(8.0) as usize), [0.0; 2]);
    let [width, height] = text.size();
    let corner = [(0.5 * (viewer.size[0] - width)).max(4.0), TITLE + 8.0];
    let panel = [corner[0] - 8.0, corner[1] - 6.0];
    let still = Transform::IDENTITY;
    canvas.fill_rectangle(panel, [width + 16.0, height + 12.0], &still, Color::rgba(0, 0, 0, 170));
    Text { position: corner, ..text }.draw(canvas);
}

/// The same with lines of at most `letters` letters, unless a word is longer.
fn wrapped(text: &str, letters: usize) -> String {
    let mut lines = String::new();
    let mut length = 0;
    for word in text.split(' ') {
        let needed = word.chars().count();
        if length > 0 && length + 1 + needed > letters {
            lines.push('\n');
            length = 0;
        } else if length > 0 {
            lines.push(' ');
            length += 1;
        }
        lines.push_str(word);
        length += needed;
    }
    lines
}

fn draw_help(canvas: &mut dyn Canvas, top: f32) {
    // Letters stand closer than lines.
    let lines: Vec<&str> = HELP.lines().collect();
    let still = Transform::IDENTITY;
    let size = [340.0, 16.0 * lines.len() as f32 + 16.0];
    canvas.fill_rectangle([8.0, top + 8.0], size, &still, Color::rgba(0, 0, 0, 200));
    for (row, line) in lines.iter().enumerate() {
        Text { color: INK, ..Text::new(*line, [16.0, top + 18.0 + 16.0 * row as f32]) }.draw(canvas);
    }
}

fn draw_buttons(viewer: &Viewer, canvas: &mut dyn Canvas) {
    let (bar, height) = buttons::bar(viewer.size, viewer.has_layers);
    let [width, bottom] = viewer.size;
    canvas.fill_rectangle([0.0, bottom - height], [width, height], &Transform::IDENTITY, PAPER);
    bar.iter().for_each(|button| button.draw(is_lit(viewer, button.does), 1.0, canvas));
    for button in viewer.buttons(viewer.size).iter().skip(bar.len()) {
        button.draw(is_lit(viewer, button.does), 0.55, canvas);
    }
}

fn is_lit(viewer: &Viewer, does: Does) -> bool {
    let Does::Presses(key) = does else { return viewer.has_layers };
    let mut layers = viewer.layers;
    match key {
        Key::Pause => viewer.is_paused,
        Key::Slow => viewer.is_slow,
        Key::Graph => viewer.has_graph,
        Key::Help => viewer.has_help,
        Key::Full => viewer.is_full,
        Key::List => viewer.list.is_some(),
        _ => layers.of(key).map_or(viewer.before.contains(key), |layer| *layer),
    }
}

#[cfg(test)]
mod tests {
    use super::wrapped;

    #[test]
    fn lines_are_broken_between_words() {
        assert_eq!(wrapped("one two three", 8), "one two\nthree");
        assert_eq!(wrapped("one two three", 80), "one two three");
        assert_eq!(wrapped("toolong two", 3), "toolong\ntwo");
    }
}
