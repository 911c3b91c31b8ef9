//! Random shapes and bodies.

use crate::arena::scene::{Body, Form, Point, Shape};
use crate::joints::random::Random;
use std::f32::consts::{PI, TAU};

/// Sizes, masses, surfaces and speeds that all parts of a random scene share.
#[derive(Debug, Clone, Copy)]
pub(super) struct Style {
    /// Least and greatest extent of a body in metres.
    pub(super) sizes: [f32; 2],
    /// Ratio of the greatest density to the least, dimensionless, >= 1. The geometric mean is 1 kg/m².
    pub(super) density_ratio: f32,
    /// Coefficient of friction of all shapes.
    pub(super) friction: f32,
    /// Coefficient of restitution of all shapes.
    pub(super) restitution: f32,
    /// Greatest initial speed of a body in m/s.
    pub(super) speed: f32,
    /// Gravity downwards in m/s².
    pub(super) gravity: f32,
}

impl Style {
    /// Draws the style of a scene: sizes over at most two decades, densities over at most three, speeds up to 100 m/s.
    pub(super) fn draw(random: &mut Random) -> Self {
        let decades = random.between(0.0, 2.0) * random.between(0.0, 1.0);
        let least = random.log_between(0.1, 1.0);
        let density_ratio = match random.below(5) {
            0..2 => 1.0,
            2 => 10.0,
            _ => random.log_between(10.0, 1000.0),
        };
        let speed = match random.below(5) {
            0..2 => 0.0,
            2..4 => random.log_between(1.0, 20.0),
            _ => random.log_between(20.0, 100.0),
        };
        Style {
            sizes: [least, (least * 10_f32.powf(decades)).min(10.0)],
            density_ratio,
            friction: random.between(0.0, 1.0),
            restitution: if random.chance(0.3) { random.between(0.0, 0.9) } else { 0.0 },
            speed,
            gravity: if random.chance(0.1) { 0.0 } else { 10.0 },
        }
    }

    /// Draws the extent of a body in m. Small bodies are more frequent, so that all sizes have about the same area.
    pub(super) fn extent(&self, random: &mut Random) -> f32 {
        let [low, high] = self.sizes;
        let share = random.between(0.0, 1.0) * random.between(0.0, 1.0);
        low * (high / low).powf(share)
    }

    /// Draws a velocity in m/s of any direction.
    pub(super) fn velocity(&self, random: &mut Random) -> Point {
        let (speed, angle) = (random.between(0.0, self.speed), random.between(0.0, TAU));
        [speed * angle.cos(), speed * angle.sin()]
    }

    /// Draws a density in kg/m².
    fn density(&self, random: &mut Random) -> f32 {
        self.density_ratio.powf(random.between(-0.5, 0.5))
    }

    /// Returns a shape with the surface of the scene.
    pub(super) fn shape(&self, form: Form) -> Shape {
        let surface = [self.friction, self.restitution];
        Shape { surface, mean_surface: surface, ..Shape::new(form) }
    }

    /// Creates a dynamic body of some shapes with one density; `place` in m.
    pub(super) fn body(&self, random: &mut Random, place: Point, forms: Vec<Form>) -> Body {
        let density = self.density(random);
        let shapes = forms.into_iter().map(|form| self.shape(form).with_density(density)).collect();
        Body::dynamic(place, shapes)
    }

    /// Creates a dynamic rectangle; `place` of its centre and `half` extents in m.
    pub(super) fn rectangle(&self, random: &mut Random, place: Point, half: Point) -> Body {
        self.body(random, place, vec![Form::Box { half, centre: [0.0; 2] }])
    }
}

/// Draws the forms of a body within a circle of a diameter of `extent` m: a disc, capsule, box, polygon, rounded polygon, or
/// two or three of them.
pub(super) fn forms(random: &mut Random, extent: f32) -> Vec<Form> {
    let reach = 0.5 * extent;
    if !random.chance(0.15) {
        return vec![form(random, reach, [0.0; 2])];
    }
    let count = 2 + random.below(2);
    let turn = random.between(0.0, TAU);
    let place = |index: usize| {
        let angle = turn + TAU * index as f32 / count as f32;
        [0.5 * reach * angle.cos(), 0.5 * reach * angle.sin()]
    };
    (0..count).map(|index| form(random, 0.5 * reach, place(index))).collect()
}

/// Draws a convex form within a circle of radius `reach` m around a centre.
fn form(random: &mut Random, reach: f32, [x, y]: Point) -> Form {
    let slimness = random.between(0.2, 0.7);
    match random.below(5) {
        0 => Form::Circle { centre: [x, y], radius: reach },
        1 => {
            let radius = slimness * reach;
            let (angle, arm) = (random.between(0.0, PI), reach - radius);
            let (dx, dy) = (arm * angle.cos(), arm * angle.sin());
            Form::Capsule { ends: [[x - dx, y - dy], [x + dx, y + dy]], radius }
        }
        2 => {
            let angle = random.between(0.25, 0.25 * PI);
            Form::Box { half: [reach * angle.cos(), reach * angle.sin()], centre: [x, y] }
        }
        kind => {
            let radius = if kind == 3 { 0.0 } else { 0.2 * reach };
            // Corners are at least 0.02 m apart, since Box2D merges corners that are nearer.
            let most = (0.5 * TAU * (reach - radius) / 0.02) as usize;
            let (corners, turn) = ((3 + random.below(6)).min(most.max(3)), random.between(0.0, TAU));
            let mut corner = |index: usize| {
                // Neighbouring corners are at least half of the regular angle apart.
                let angle = turn + TAU * (index as f32 + random.between(0.0, 0.5)) / corners as f32;
                [x + (reach - radius) * angle.cos(), y + (reach - radius) * angle.sin()]
            };
            let points: Vec<Point> = (0..corners).map(&mut corner).collect();
            Form::hull(&points, radius)
        }
    }
}
