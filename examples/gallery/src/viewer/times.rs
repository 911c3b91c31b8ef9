//! How long frames took.

use std::collections::VecDeque;

use twohalf_render::{Canvas, Color, Point, Text, Transform};

/// Frames that are kept.
const KEPT: usize = 120;
/// Px of the graph for a ms, and its greatest height in ms.
const SCALE: [f32; 2] = [2.0, 40.0];
/// A frame at 60 per second, ms.
const GOAL: f32 = 1000.0 / 60.0;

/// The last frames: ms from one to the next, and ms of the steps in it.
#[derive(Debug, Default)]
pub(super) struct Times {
    frames: VecDeque<[f32; 2]>,
}

impl Times {
    /// Another frame.
    pub(super) fn note(&mut self, frame: f32, steps: f32) {
        if self.frames.len() >= KEPT {
            self.frames.pop_front();
        }
        self.frames.push_back([frame, steps]);
    }

    /// Mean ms of a frame, and of its steps.
    pub(super) fn mean(&self) -> [f32; 2] {
        let sum = self.frames.iter().fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d]);
        sum.map(|sum| sum / self.frames.len().max(1) as f32)
    }

    /// Draws them with the lower left corner at a point.
    pub(super) fn draw(&self, [x, y]: Point, canvas: &mut dyn Canvas) {
        let [high, most] = SCALE;
        let still = Transform::IDENTITY;
        let size = [KEPT as f32 * 2.0, high * most];
        canvas.fill_rectangle([x, y - size[1]], size, &still, Color::rgba(0, 0, 0, 150));
        for (at, [frame, steps]) in self.frames.iter().enumerate() {
            let left = x + 2.0 * at as f32;
            for (ms, color) in [(frame, Color::rgb(90, 150, 220)), (steps, Color::rgb(250, 190, 70))] {
                let height = high * ms.clamp(0.0, most);
                canvas.fill_rectangle([left, y - height], [2.0, height], &still, color);
            }
        }
        let goal = y - high * GOAL;
        canvas.stroke_polyline(&[[x, goal], [x + size[0], goal]], false, 1.0, &still, Color::WHITE);
        let [frame, steps] = self.mean();
        Text::new(format!("frame {frame:.1} ms, steps {steps:.2} ms"), [x + 4.0, y - size[1] + 4.0])
            .draw(canvas);
    }
}
