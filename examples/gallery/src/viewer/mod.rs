//! The program that a person uses, without a window and without a clock: a frame is a function of an [`Input`].

mod buttons;
mod history;
mod list;
mod picture;
mod pointer;
mod times;

use examples::Result;
use twohalf_render::{Canvas, Point};

use crate::Layers;
use crate::keys::{Key, KeySet, Keys};
use crate::play::Player;
use crate::scenes::{GalleryScene, Game};
use crate::show::Show;
use history::History;
use list::List;
use pointer::Use;
use times::Times;

/// Factor by which slow motion is slower.
const SLOWNESS: f64 = 5.0;
/// Most seconds that a frame makes up for.
const MOST_SECONDS: f64 = 0.05;
/// Seconds of CPU time for the steps of one frame. Steps beyond that are skipped, and time goes slower.
const MOST_WORK: f64 = 0.03;
/// Speed of rewinding, a factor.
const REWIND: f64 = 2.0;
/// Seconds for which a message is shown.
const MESSAGE: f32 = 4.0;

/// Input of a person in a frame, of any source.
#[derive(Debug, Clone, Default)]
pub struct Input {
    /// Width and height of the canvas, px.
    pub size: Point,
    /// Since the last frame, s.
    pub seconds: f32,
    /// Keys that are down.
    pub keys: KeySet,
    /// Where fingers are, or the mouse with its button down; in the order in which they went down.
    pub pointers: Vec<Point>,
    /// How far the wheel was turned, px, positive down, and where the mouse is.
    pub wheel: f32,
    /// Where the mouse is.
    pub hover: Point,
    /// Whether there is a touch screen: games get buttons then.
    pub has_touch: bool,
}

/// The gallery.
#[derive(Debug)]
pub struct Viewer {
    scenes: Vec<GalleryScene>,
    at: usize,
    show: Show,
    history: History,
    times: Times,
    layers: Layers,
    list: Option<List>,
    is_paused: bool,
    is_slow: bool,
    has_graph: bool,
    has_help: bool,
    has_layers: bool,
    is_full: bool,
    has_touch: bool,
    /// Whether a person has pressed a key of the game; until then it plays itself.
    is_played: bool,
    message: (String, f32),
    /// Seconds that are due to be simulated.
    due: f64,
    /// Ms that the last picture took.
    drawing: f32,
    before: KeySet,
    /// Keys of the game that went down and have not reached a step yet.
    pressed: KeySet,
    pointer: Use,
    size: Point,
}

impl Viewer {
    /// Shows one of some scenes.
    ///
    /// # Errors
    /// No such scene, or an error of it.
    pub fn new(scenes: Vec<GalleryScene>, first: usize) -> Result<Self> {
        let show = scenes.get(first).ok_or("there is no such scene")?.build()?;
        Ok(Viewer {
            history: History::of(&show),
            scenes,
            at: first,
            show,
            times: Times::default(),
            layers: Layers::default(),
            list: None,
            is_paused: false,
            is_slow: false,
            has_graph: false,
            has_help: false,
            has_layers: false,
            is_full: false,
            has_touch: false,
            is_played: false,
            message: (String::new(), 0.0),
            due: 0.0,
            drawing: 0.0,
            before: KeySet::default(),
            pressed: KeySet::default(),
            pointer: Use::Nothing,
            size: [0.0; 2],
        })
    }

    /// The scenes.
    pub fn scenes(&self) -> &[GalleryScene] {
        &self.scenes
    }

    /// Which of them is shown.
    pub fn at(&self) -> usize {
        self.at
    }

    /// The scenes on the screen.
    pub fn show(&self) -> &Show {
        &self.show
    }

    /// Which layers are shown.
    pub fn layers(&self) -> Layers {
        self.layers
    }

    /// Whether all of the screen is wanted.
    pub fn is_full(&self) -> bool {
        self.is_full
    }

    /// All of the screen is not wanted any more.
    pub fn leave_full(&mut self) {
        self.is_full = false;
    }

    /// Whether the list of scenes is open.
    pub fn is_choosing(&self) -> bool {
        self.list.is_some()
    }

    /// Mean ms of the last frames, of the steps in them, and of the drawing by [`drawn_in`](Self::drawn_in).
    pub fn times(&self) -> [f32; 3] {
        self.times.mean()
    }

    /// Shows another scene, from its start. If it fails, a message is shown, and the one before stays.
    pub fn choose(&mut self, at: usize) {
        let Some(scene) = self.scenes.get(at) else { return };
        match scene.build() {
            Ok(show) => {
                (self.history, self.show, self.at) = (History::of(&show), show, at);
                (self.list, self.is_played, self.due) = (None, false, 0.0);
                self.pointer = Use::Nothing;
            }
            Err(error) => self.say(error.to_string()),
        }
    }

    /// Adds a scene and shows it.
    pub fn add(&mut self, scene: GalleryScene) {
        self.scenes.push(scene);
        self.choose(self.scenes.len() - 1);
    }

    /// Shows a message for a while.
    pub fn say(&mut self, message: String) {
        self.message = (message, MESSAGE);
    }

    /// Takes the duration in s of the drawing of the last picture, for the graph.
    pub fn drawn_in(&mut self, seconds: f64) {
        self.drawing = 1e3 * seconds as f32;
    }

    /// Where the scene is drawn: corner and size.
    pub fn area(&self, size: Point) -> [Point; 2] {
        let (_, bar) = buttons::bar(size, self.has_layers);
        [[0.0, picture::TITLE], [size[0], (size[1] - bar - picture::TITLE).max(1.0)]]
    }

    /// A frame. `clock` returns seconds since any moment, for measuring the duration of steps.
    pub fn frame(&mut self, input: &Input, clock: &dyn Fn() -> f64) {
        self.size = input.size;
        self.has_touch |= input.has_touch;
        self.message.1 = (self.message.1 - input.seconds).max(0.0);
        let buttons = self.buttons(input.size);
        self.point(input, &buttons);
        let on_screen = self.pointer.presses(&buttons, &input.pointers);
        let held = input.keys.or(on_screen);
        let pressed = held.without(self.before);
        self.before = held;
        self.press(pressed);
        let start = clock();
        self.advance(f64::from(input.seconds), held, pressed, clock);
        self.times.note([1e3 * input.seconds, 1e3 * (clock() - start) as f32, self.drawing]);
    }

    /// All buttons on the screen.
    fn buttons(&self, size: Point) -> Vec<buttons::Button> {
        let (mut all, height) = buttons::bar(size, self.has_layers);
        if self.has_touch && self.list.is_none() {
            all.extend(buttons::pad(self.scenes[self.at].game, size[0], size[1] - height));
        }
        all
    }

    /// Handles the keys that were not down before.
    fn press(&mut self, pressed: KeySet) {
        let hit = |key| pressed.contains(key);
        if hit(Key::List) {
            self.list = match self.list {
                Some(_) => None,
                None => Some(List { at: self.at, ..List::default() }),
            };
        }
        if let Some(list) = &mut self.list {
            let (size, count) = (self.size, self.scenes.len());
            let step = |more, less| i32::from(hit(more)) - i32::from(hit(less));
            let way = [step(Key::Down, Key::Up), step(Key::Right, Key::Left)];
            if way != [0, 0] {
                list.step(way, size, count);
            }
            let at = list.at;
            if hit(Key::Jump) {
                self.choose(at);
                self.before.insert(Key::Jump);
            }
            return;
        }
        self.is_paused ^= hit(Key::Pause);
        self.is_slow ^= hit(Key::Slow);
        self.has_graph ^= hit(Key::Graph);
        self.has_help ^= hit(Key::Help);
        self.is_full ^= hit(Key::Full);
        for key in [Key::Outlines, Key::Boxes, Key::Contacts, Key::Islands, Key::Sleep, Key::Joints] {
            if let (true, Some(layer)) = (hit(key), self.layers.of(key)) {
                *layer = !*layer;
            }
        }
        if hit(Key::Restart) {
            self.choose(self.at);
        }
        let count = self.scenes.len();
        if hit(Key::After) {
            self.choose((self.at + 1) % count);
        }
        if hit(Key::Before) {
            self.choose((self.at + count - 1) % count);
        }
        if hit(Key::Methods) {
            match self.show.switch_methods() {
                Ok(words) => self.say(words),
                Err(error) => self.say(error.to_string()),
            }
        }
    }

    /// Lets time go on, or back.
    fn advance(&mut self, seconds: f64, held: KeySet, pressed: KeySet, clock: &dyn Fn() -> f64) {
        if self.list.is_some() {
            return;
        }
        if held.contains(Key::Rewind) {
            self.show.release();
            if let Some(then) = self.history.back(REWIND * seconds.min(MOST_SECONDS)) {
                let lens = self.show.lens();
                self.show = then;
                self.show.set_lens(lens);
            }
            return;
        }
        let of_game = [Key::Left, Key::Right, Key::Up, Key::Down, Key::Jump, Key::Punch, Key::Grab];
        self.is_played |=
            self.scenes[self.at].game != Game::None && of_game.iter().any(|&key| held.contains(key));
        self.pressed = self.pressed.or(pressed);
        let step = 1.0 / f64::from(self.show.rate());
        let pace = if self.is_slow { 1.0 / SLOWNESS } else { 1.0 };
        self.due += if self.is_paused { 0.0 } else { pace * seconds.clamp(0.0, MOST_SECONDS) };
        if pressed.contains(Key::Step) {
            (self.is_paused, self.due) = (true, step);
        }
        let start = clock();
        // Sums of times are slightly less than a multiple of the step now and then.
        while self.due >= 0.999 * step {
            self.due = (self.due - step).max(0.0);
            self.step(held, step);
            if clock() - start > MOST_WORK {
                self.due = 0.0;
            }
        }
    }

    fn step(&mut self, held: KeySet, seconds: f64) {
        self.history.note(&self.show, seconds);
        let keys = Keys { held, pressed: std::mem::take(&mut self.pressed) };
        let player = if self.is_played { Player::Keys(keys) } else { Player::Script };
        if let Err(error) = self.show.step(player) {
            self.is_paused = true;
            self.say(error.to_string());
        }
    }

    /// Draws all of it on a canvas of the size of the last input.
    ///
    /// # Errors
    /// A refusal of the renderer.
    pub fn draw(&self, canvas: &mut dyn Canvas) -> Result<()> {
        picture::draw(self, canvas)
    }
}
