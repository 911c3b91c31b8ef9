//! How long frames took.

use std::collections::VecDeque;

use twohalf_render::{Canvas, Color, Point, Text, Transform};

/// Number of frames that are kept.
const KEPT: usize = 160;
const FRAME: Color = Color::rgb(60, 84, 116);
const DRAWING: Color = Color::rgb(90, 150, 220);
const STEPS: Color = Color::rgb(250, 190, 70);
/// Px of the graph for a ms, and its greatest height in ms.
const SCALE: [f32; 2] = [2.0, 40.0];
/// A frame at 60 per second, ms.
const GOAL: f32 = 1000.0 / 60.0;

/// The last frames: ms from one to the next, of the steps in it, and of the drawing before it.
#[derive(Debug, Default)]
pub(super) struct Times {
    frames: VecDeque<[f32; 3]>,
}

impl Times {
    /// Another frame.
    pub(super) fn note(&mut self, times: [f32; 3]) {
        if self.frames.len() >= KEPT {
            self.frames.pop_front();
        }
        self.frames.push_back(times);
    }

    /// Mean ms of a frame, of its steps, and of its drawing.
    pub(super) fn mean(&self) -> [f32; 3] {
        let sum = self.frames.iter().fold([0.0; 3], |[a, b, c], [d, e, f]| [a + d, b + e, c + f]);
        sum.map(|sum| sum / self.frames.len().max(1) as f32)
    }

    /// Draws them with the lower left corner at a point.
    pub(super) fn draw(&self, [x, y]: Point, canvas: &mut dyn Canvas) {
        let [high, most] = SCALE;
        let still = Transform::IDENTITY;
        let size = [KEPT as f32 * 2.0, high * most];
        canvas.fill_rectangle([x, y - size[1]], size, &still, Color::rgba(0, 0, 0, 150));
        for (at, [frame, steps, drawing]) in self.frames.iter().enumerate() {
            let left = x + 2.0 * at as f32;
            let parts = [(frame, FRAME), (&(steps + drawing), DRAWING), (steps, STEPS)];
            for (ms, color) in parts {
                let height = high * ms.clamp(0.0, most);
                canvas.fill_rectangle([left, y - height], [2.0, height], &still, color);
            }
        }
        let goal = y - high * GOAL;
        canvas.stroke_polyline(&[[x, goal], [x + size[0], goal]], false, 1.0, &still, Color::WHITE);
        let [frame, steps, drawing] = self.mean();
        Text::new(
            format!("frame {frame:.1}, steps {steps:.2}, drawing {drawing:.2} ms"),
            [x + 4.0, y - size[1] + 4.0],
        )
        .draw(canvas);
    }
}
