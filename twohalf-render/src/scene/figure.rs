//! Stand-in figures: people drawn from ellipses and limbs while a picture of them is missing.

use twohalf::{BodyId, TwoHalfPhysicsSimulator};

use super::solid::bounds;
use super::{Figure, Pose};
use crate::outline_of_line::outline_of_line;
use crate::{Canvas, Color, Point, Transform};

/// Width of the outline around a figure's limbs; ratio to the figure's height.
const OUTLINE: f32 = 0.02;
const OUTLINE_COLOR: Color = Color::rgb(34, 26, 36);
const SKIN: Color = Color::rgb(240, 194, 152);

/// The joints of a figure in units of its height (ratio): from its feet up, with x forwards. Of the arms and
/// legs the far one comes first, as elbow and hand, knee and foot.
struct Joints {
    arms: [[Point; 2]; 2],
    legs: [[Point; 2]; 2],
    hip: Point,
    shoulder: Point,
    /// Angle by which the figure leans backwards about its feet, radians.
    lean: f32,
}

impl Joints {
    fn of(figure: &Figure) -> Self {
        let phase = f64::from(figure.stride) * std::f64::consts::PI;
        let (swing, lifted) = (libm::sin(phase) as f32, libm::cos(phase) as f32);
        let leg = |swing: f32, lifted: f32, apart: f32| {
            let foot = [0.17 * swing + apart, 0.035 + 0.05 * lifted.max(0.0) * swing.abs()];
            [[0.5 * foot[0] + 0.035, 0.5 * foot[1] + 0.225], foot]
        };
        let arm = |swing: f32| {
            let elbow = [-0.13 * swing - 0.02, 0.6];
            [elbow, [elbow[0] - 0.05 * swing + 0.05, 0.47]]
        };
        let walking = Joints {
            arms: [arm(-swing), arm(swing)],
            legs: [leg(-swing, -lifted, -0.05), leg(swing, lifted, 0.05)],
            hip: [0.0, 0.44],
            shoulder: [0.01, 0.73],
            lean: 0.0,
        };
        match figure.pose {
            Pose::Walks => walking,
            Pose::Strikes => Joints {
                arms: [[[-0.08, 0.6], [0.08, 0.66]], [[0.24, 0.71], [0.46, 0.72]]],
                legs: [[[-0.08, 0.24], [-0.2, 0.035]], [[0.15, 0.26], [0.17, 0.035]]],
                hip: [0.02, 0.42],
                shoulder: [0.08, 0.71],
                ..walking
            },
            Pose::Lifts => {
                Joints { arms: [[[-0.12, 0.88], [-0.08, 1.04]], [[0.16, 0.88], [0.12, 1.04]]], ..walking }
            }
            Pose::Jumps => Joints {
                arms: [[[-0.13, 0.66], [-0.24, 0.78]], [[0.16, 0.68], [0.26, 0.8]]],
                legs: [[[0.0, 0.26], [-0.16, 0.12]], [[0.17, 0.34], [0.12, 0.12]]],
                ..walking
            },
            Pose::Reels => Joints {
                arms: [[[-0.1, 0.78], [0.06, 0.9]], [[0.18, 0.72], [0.3, 0.82]]],
                lean: 0.45,
                ..walking
            },
            Pose::Lies => Joints {
                arms: [[[-0.1, 0.86], [0.0, 1.0]], [[0.12, 0.62], [0.14, 0.48]]],
                lean: 1.45,
                ..walking
            },
        }
    }
}

pub(super) fn draw_figure(
    simulator: &TwoHalfPhysicsSimulator,
    canvas: &mut dyn Canvas,
    id: BodyId,
    figure: &Figure,
) {
    let Some([[left, top], [right, bottom]]) = bounds(simulator, id) else { return };
    let height = bottom - top;
    let forwards = if figure.looks_left { -height } else { height };
    let joints = Joints::of(figure);
    let place = Transform::rotation(joints.lean)
        .then(&Transform::scaling([forwards, -height]))
        .then(&Transform::translation([0.5 * (left + right), bottom]));
    let mut pen = FigurePen { canvas, place };
    let trousers = figure.color.darker(0.55);
    let [far_arm, near_arm] = joints.arms.map(|[elbow, hand]| [joints.shoulder, elbow, hand]);
    let [far_leg, near_leg] = joints.legs.map(|[knee, foot]| [joints.hip, knee, foot]);
    pen.arm(&far_arm, figure.color.darker(0.35));
    pen.leg(&far_leg, trousers.darker(0.25));
    pen.leg(&near_leg, trousers);
    pen.body(joints.hip, joints.shoulder, figure.color);
    pen.head([joints.shoulder[0] + 0.02, joints.shoulder[1] + 0.165], figure.color.darker(0.7));
    pen.arm(&near_arm, figure.color.lighter(0.12));
}

struct FigurePen<'a> {
    canvas: &'a mut dyn Canvas,
    place: Transform,
}

impl FigurePen<'_> {
    fn dot(&mut self, center: Point, radii: Point, color: Color) {
        self.canvas.fill_ellipse(center, radii, &self.place, color);
    }

    /// A bent line with round ends and an outline.
    fn limb(&mut self, line: &[Point; 3], width: f32, color: Color) {
        for (width, color) in [(width + 2.0 * OUTLINE, OUTLINE_COLOR), (width, color)] {
            self.canvas.fill_polygon(&outline_of_line(line, false, width), &self.place, color);
            for &joint in &line[1..] {
                self.dot(joint, [0.5 * width; 2], color);
            }
        }
    }

    fn arm(&mut self, arm: &[Point; 3], color: Color) {
        self.limb(arm, 0.085, color);
        self.dot(arm[2], [0.05; 2], SKIN);
    }

    fn leg(&mut self, leg: &[Point; 3], color: Color) {
        self.limb(leg, 0.105, color);
        let [x, y] = leg[2];
        self.dot([x + 0.03, y], [0.085 + OUTLINE, 0.04 + OUTLINE], OUTLINE_COLOR);
        self.dot([x + 0.03, y], [0.085, 0.04], color.darker(0.5));
    }

    fn body(&mut self, [hip_x, hip_y]: Point, [x, y]: Point, color: Color) {
        for (rim, color) in [(OUTLINE, OUTLINE_COLOR), (0.0, color)] {
            let trunk = [
                [hip_x - 0.095 - rim, hip_y - 0.04 - rim],
                [hip_x + 0.095 + rim, hip_y - 0.04 - rim],
                [x + 0.125 + rim, y - 0.02],
                [x + 0.08, y + 0.05 + rim],
                [x - 0.08, y + 0.05 + rim],
                [x - 0.125 - rim, y - 0.02],
            ];
            self.canvas.fill_polygon(&trunk, &self.place, color);
        }
        let belt = [[-0.1, -0.045], [0.1, -0.045], [0.1, 0.0], [-0.1, 0.0]];
        let belt = belt.map(|[dx, dy]| [hip_x + dx, hip_y + dy]);
        self.canvas.fill_polygon(&belt, &self.place, color.darker(0.65));
    }

    fn head(&mut self, [x, y]: Point, hair: Color) {
        self.dot([x, y], [0.115 + OUTLINE, 0.115 + OUTLINE], OUTLINE_COLOR);
        self.dot([x, y], [0.115, 0.115], hair);
        self.dot([x + 0.025, y - 0.025], [0.09, 0.085], SKIN);
        self.dot([x + 0.07, y], [0.016, 0.026], OUTLINE_COLOR);
    }
}
