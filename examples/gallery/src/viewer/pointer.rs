//! Mouse and fingers.

use twohalf_render::Point;

use super::buttons::{self, Button, Does};
use super::{Input, Viewer};
use crate::keys::KeySet;

/// How many times as close a px of the wheel brings.
const CLOSER: f32 = 1.004;
/// How far a pointer may move in the list and still choose, px.
const TAP: f32 = 10.0;

/// The use of the first pointer until it goes up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Use {
    /// No pointer is down.
    Nothing,
    /// It presses buttons.
    Buttons,
    /// It holds a body of the scene, or else moves the visible part: the pointer's last position. With a second finger it
    /// changes the magnification: the last distance of the fingers.
    Scene { last: Point, apart: Option<f32> },
    /// It scrolls the list: where it went down, where it was last, and whether it has moved.
    List { from: Point, last: Point, has_moved: bool },
}

impl Use {
    /// The keys of the buttons that are pressed.
    pub(super) fn presses(self, buttons: &[Button], pointers: &[Point]) -> KeySet {
        match self {
            Use::Buttons | Use::Nothing => buttons::pressed(buttons, pointers),
            // A second finger may press a button while the first one does not.
            Use::Scene { .. } => buttons::pressed(buttons, pointers.get(1..).unwrap_or(&[])),
            Use::List { .. } => KeySet::default(),
        }
    }
}

impl Viewer {
    /// Handles the pointers.
    pub(super) fn point(&mut self, input: &Input, buttons: &[Button]) {
        let (area, count) = (self.area(input.size), self.scenes.len());
        if let Some(list) = &mut self.list {
            list.scroll(input.wheel, input.size, count);
        } else if input.wheel != 0.0 {
            self.show.closer(area, CLOSER.powf(-input.wheel), input.hover);
        }
        let Some(&first) = input.pointers.first() else { return self.point_up() };
        match &mut self.pointer {
            Use::Nothing => self.point_down(first, input.size, buttons),
            Use::Scene { .. } if self.show.is_holding() => self.show.drag(area, first),
            Use::Scene { last, apart } => {
                match input.pointers.get(1).filter(|at| !buttons.iter().any(|button| button.holds(**at))) {
                    Some(second) => {
                        let now = (second[0] - first[0]).hypot(second[1] - first[1]).max(1.0);
                        let between = [0, 1].map(|axis| 0.5 * (first[axis] + second[axis]));
                        self.show.closer(area, now / apart.unwrap_or(now), between);
                        *apart = Some(now);
                    }
                    None => {
                        self.show.pan(area, *last, first);
                        *apart = None;
                    }
                }
                *last = first;
            }
            Use::Buttons => (),
            Use::List { from, last, has_moved } => {
                *has_moved |= (0..2).any(|axis| (first[axis] - from[axis]).abs() > TAP);
                if let (Some(list), true) = (&mut self.list, *has_moved) {
                    list.scroll(last[1] - first[1], input.size, count);
                }
                *last = first;
            }
        }
    }

    fn point_down(&mut self, at: Point, size: Point, buttons: &[Button]) {
        let button = buttons.iter().find(|button| button.holds(at));
        self.pointer = match (button, &self.list) {
            (Some(button), _) => {
                self.has_layers ^= button.does == Does::Layers;
                Use::Buttons
            }
            (None, Some(_)) => Use::List { from: at, last: at, has_moved: false },
            (None, None) => {
                self.show.grab(self.area(size), at);
                Use::Scene { last: at, apart: None }
            }
        };
    }

    fn point_up(&mut self) {
        if let (Use::List { from, has_moved: false, .. }, Some(list)) = (self.pointer, self.list)
            && let Some(entry) = list.entry(self.size, self.scenes.len(), from)
        {
            self.choose(entry);
        }
        self.show.release();
        self.pointer = Use::Nothing;
    }
}
