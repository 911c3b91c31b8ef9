//! The screen: a scene, or two beside each other, and the hand that grabs bodies.

use std::rc::Rc;

use examples::Result;
use twohalf_render::{Canvas, Color, Point, Rectangle, Text, Transform, View};

use crate::hand::Hand;
use crate::layers::Layers;
use crate::lens::Lens;
use crate::play::{Play, Player, Set};
use crate::sheet::Sheet;
use crate::state;

/// Builds a scene with a set of methods.
pub type Build = Rc<dyn Fn(Set) -> Result<Box<dyn Play>>>;

/// Px between two scenes.
const GAP: f32 = 4.0;
const GROUND: Color = Color::rgb(20, 24, 32);

/// A scene on its own or beside another.
#[derive(Clone)]
pub struct Half {
    /// Its label; none if it is empty.
    label: &'static str,
    set: Set,
    /// Whether it can be computed with the other set as well.
    has_both: bool,
    build: Build,
    play: Box<dyn Play>,
    hand: Hand,
}

impl std::fmt::Debug for Half {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Half({:?}, {:?}, {:?})", self.label, self.set, self.play)
    }
}

impl Half {
    /// Builds one.
    ///
    /// # Errors
    /// An error of `build`.
    pub fn new(label: &'static str, set: Set, has_both: bool, build: Build) -> Result<Self> {
        let play = build(set)?;
        Ok(Half { label, set, has_both, build, play, hand: Hand::default() })
    }

    /// The scene.
    pub fn play(&self) -> &dyn Play {
        &*self.play
    }

    /// The set of methods.
    pub fn set(&self) -> Set {
        self.set
    }

    /// From the start with each set that it has, the one that it begins with first.
    ///
    /// # Errors
    /// An error of its building.
    pub fn with_each_set(&self) -> Result<Vec<Half>> {
        let with = |set| Half::new(self.label, set, self.has_both, self.build.clone());
        let mut all = vec![with(self.set)?];
        if self.has_both {
            all.push(with(self.set.other())?);
        }
        Ok(all)
    }

    /// Makes a step.
    ///
    /// # Errors
    /// A refusal of the engine.
    pub fn step(&mut self, player: Player) -> Result<()> {
        self.hand.pull(self.play.world_mut());
        self.play.step(player)
    }

    /// Switches to the other set of methods.
    fn switch(&mut self) -> Result<()> {
        if !self.has_both {
            return Err(format!("this scene needs the {} set", self.set.name()).into());
        }
        self.hand.release(self.play.world_mut());
        let other = self.set.other();
        state::switch(self.play.world_mut(), other)?;
        self.set = other;
        Ok(())
    }
}

/// One or two scenes on the screen.
#[derive(Debug, Clone)]
pub struct Show {
    halves: Vec<Half>,
    /// Index of the half whose hand the pointer moves.
    held: Option<usize>,
    /// The visible part of each.
    lens: Lens,
}

/// Where a half is on the screen.
#[derive(Debug, Clone, Copy)]
struct Place {
    /// Transform from the picture's px to those of the screen.
    camera: Transform,
    clip: Rectangle,
}

impl Place {
    /// Whether a point of the screen is inside of it.
    fn shows(&self, at: Point) -> bool {
        let Rectangle { x, y, width, height } = self.clip;
        let holds = |at: f32, low: u32, size: u32| at >= low as f32 && at < (low + size) as f32;
        holds(at[0], x, width) && holds(at[1], y, height)
    }
}

impl Show {
    /// A show of at least one half.
    pub fn new(halves: Vec<Half>) -> Self {
        Show { halves, held: None, lens: Lens::default() }
    }

    /// Its halves.
    pub fn halves(&self) -> &[Half] {
        &self.halves
    }

    /// Steps per simulated second.
    pub fn rate(&self) -> u32 {
        self.halves.iter().map(|half| half.play.rate()).max().unwrap_or(60)
    }

    /// Width and height in px of a picture that shows all at its own size, side by side.
    pub fn size(&self) -> [f32; 2] {
        let sizes = self.halves.iter().map(|half| half.play.size());
        let [width, height] = sizes.fold([0.0; 2], |[w, h]: Point, [x, y]| [w + x + GAP, h.max(y)]);
        [width - GAP, height]
    }

    /// Makes a step.
    ///
    /// # Errors
    /// A refusal of the engine.
    pub fn step(&mut self, player: Player) -> Result<()> {
        self.halves.iter_mut().try_for_each(|half| half.step(player))
    }

    /// Switches to the other set of methods; returns its name in words.
    ///
    /// # Errors
    /// A refusal of the other set.
    pub fn switch_methods(&mut self) -> Result<String> {
        self.release();
        let mut words = Vec::new();
        for half in &mut self.halves {
            half.switch()?;
            words.push(half.set.name());
        }
        Ok(words.join(" | "))
    }

    /// Draws all halves into a rectangle of the canvas: its corner and its size.
    ///
    /// # Errors
    /// A refusal of the renderer.
    pub fn draw(&self, canvas: &mut dyn Canvas, area: [Point; 2], layers: Layers) -> Result<()> {
        let [[x, y], [width, height]] = area;
        canvas.fill_rectangle([x, y], [width, height], &Transform::IDENTITY, GROUND);
        for (half, place) in self.halves.iter().zip(self.places(area)) {
            let size = half.play.size();
            let mut sheet = Sheet::new(canvas, size, &place.camera, place.clip);
            half.play.draw(&mut sheet)?;
            let mut view = View::new(&mut sheet).camera(&half.play.camera());
            layers.draw(half.play.world(), &mut view);
            if !half.label.is_empty() {
                let [left, top] = [place.clip.x, place.clip.y].map(|at| at as f32 + 6.0);
                let text = Text::new(label_of(half), [left, top]);
                // As large as it fits, up to a limit.
                let fits = (place.clip.width as f32 - 12.0) / text.size()[0];
                let text = Text { scale: [fits.clamp(0.5, 2.0); 2], ..text };
                let corner = [left + 1.0, top + 1.0];
                Text { color: Color::BLACK, position: corner, ..text.clone() }.draw(canvas);
                text.draw(canvas);
            }
        }
        Ok(())
    }

    /// Beside each other or above each other, as large as they fit.
    fn places(&self, area: [Point; 2]) -> Vec<Place> {
        let beside = self.placed(area, 0);
        let above = self.placed(area, 1);
        // All have one lens, so that any half will do.
        let zoom =
            |places: &[Place]| places.iter().map(|place| place.camera.x_axis[0]).fold(f32::MAX, f32::min);
        if zoom(&above) > zoom(&beside) { above } else { beside }
    }

    fn placed(&self, [corner, size]: [Point; 2], axis: usize) -> Vec<Place> {
        let count = self.halves.len() as f32;
        let mut cell = size;
        cell[axis] = (size[axis] - GAP * (count - 1.0)) / count;
        let place = |(index, half): (usize, &Half)| {
            let [width, height] = half.play.size();
            let zoom = (cell[0] / width).min(cell[1] / height).max(1e-3);
            let mut middle = [corner[0] + 0.5 * cell[0], corner[1] + 0.5 * cell[1]];
            middle[axis] += index as f32 * (cell[axis] + GAP);
            let whole = Lens::default().camera([width, height], zoom, middle);
            let [left, top] = whole.apply([0.0; 2]).map(|at| at.max(0.0).round() as u32);
            let [right, bottom] = whole.apply([width, height]).map(|at| at.max(0.0).round() as u32);
            let clip = Rectangle::new(left, top, right.saturating_sub(left), bottom.saturating_sub(top));
            Place { camera: self.lens.camera([width, height], zoom, middle), clip }
        };
        self.halves.iter().enumerate().map(place).collect()
    }

    /// The visible part of each picture.
    pub fn lens(&self) -> Lens {
        self.lens
    }

    /// Sets the visible part of each picture.
    pub fn set_lens(&mut self, lens: Lens) {
        self.lens = lens;
    }

    /// Multiplies the magnification by a factor, about a point of the canvas.
    pub fn closer(&mut self, area: [Point; 2], factor: f32, at: Point) {
        if let Some(part) = (0..self.halves.len()).find_map(|index| self.part(area, index, at)) {
            self.lens = self.lens.closer(factor, part);
        }
    }

    /// Moves the visible part along with a pointer.
    pub fn pan(&mut self, area: [Point; 2], from: Point, to: Point) {
        let parts = |at| (0..self.halves.len()).find_map(|index| self.part(area, index, at));
        if let (Some(from), Some(to)) = (parts(from), parts(to)) {
            self.lens = self.lens.moved([from[0] - to[0], from[1] - to[1]]);
        }
    }

    /// The point of a canvas as fractions of a picture's width and height, if the picture is visible there.
    fn part(&self, area: [Point; 2], index: usize, at: Point) -> Option<Point> {
        let place = self.places(area)[index];
        if !place.shows(at) {
            return None;
        }
        let [width, height] = self.halves[index].play().size();
        let [x, y] = place.camera.inverse()?.apply(at);
        Some([x / width, y / height])
    }

    /// The pointer went down at a point of the canvas; returns whether a body is grabbed now.
    pub fn grab(&mut self, area: [Point; 2], at: Point) -> bool {
        self.release();
        for index in 0..self.halves.len() {
            let Some(point) = self.in_world(area, index, at, true) else { continue };
            let half = &mut self.halves[index];
            if half.hand.grab(half.play.world_mut(), point) {
                self.held = Some(index);
                return true;
            }
        }
        false
    }

    /// The pointer moved.
    pub fn drag(&mut self, area: [Point; 2], to: Point) {
        let Some(index) = self.held else { return };
        if let Some(point) = self.in_world(area, index, to, false) {
            let half = &mut self.halves[index];
            half.hand.drag(half.play.world_mut(), point);
        }
    }

    /// The pointer went up.
    pub fn release(&mut self) {
        for half in &mut self.halves {
            half.hand.release(half.play.world_mut());
        }
        self.held = None;
    }

    /// Whether a body is grabbed.
    pub fn is_holding(&self) -> bool {
        self.halves.iter().any(|half| half.hand.is_holding())
    }

    /// A point of the canvas in the px of a simulator.
    fn in_world(&self, area: [Point; 2], index: usize, at: Point, must_be_inside: bool) -> Option<Point> {
        let place = self.places(area)[index];
        if must_be_inside && !place.shows(at) {
            return None;
        }
        let play = self.halves[index].play();
        let on_sheet = place.camera.inverse()?.apply(at);
        Some(play.camera().inverse()?.apply(on_sheet))
    }

    /// Where a point of a simulator is on the canvas.
    pub fn on_canvas(&self, area: [Point; 2], index: usize, at: Point) -> Point {
        let place = self.places(area)[index];
        place.camera.apply(self.halves[index].play().camera().apply(at))
    }
}

fn label_of(half: &Half) -> String {
    let counts = state::counts(half.play.world());
    if counts.asleep > 0 {
        format!("{} - {}, {} asleep", half.label, half.set.name(), counts.asleep)
    } else {
        format!("{} - {}", half.label, half.set.name())
    }
}
