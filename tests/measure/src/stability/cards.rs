//! Families of thin bodies that lean on each other or knock each other over.

use super::parts::{Allowed, SPEED_LIMIT, all, calm, ends_in, standing};
use super::reasons;
use super::stacks::BOXES;
use super::{SECONDS, StabilityFamily};
use crate::scenes::movable;
use crate::scenes::stage::{METRE, Stage};
use crate::watch::{Watch, greatest, least};
use crate::world::World;
use conformance::scene::Scene;
use farseer_core::math::Vector2;
use std::f64::consts::FRAC_PI_4;

pub(super) const FAMILIES: [StabilityFamily; 2] = [
    StabilityFamily {
        name: "Card House",
        about: "Cards of 2 m by 2 px, leaning 25 degrees, stand in storeys for 10 s: no card ends lower or higher than it \
                began by over a tenth of its height above the floor, nor by over half a metre, nor leaves its place, turns or creeps. Friction 0.7.",
        parameter: "storeys",
        values: &[1.0, 2.0, 3.0, 4.0, 5.0],
        quick_values: &[1.0, 2.0, 3.0],
        build: |storeys, _| card_house(storeys as usize),
        judge: house_stands,
        ..BOXES
    },
    StabilityFamily {
        name: "Double Domino",
        about: "Dominoes of 0.25 m by 1 m, 0.75 m apart; the first is pushed. All fall, the last as well, and lie on \
                the floor or on the next after 20 s. However many there are, nothing is expected to fail.",
        parameter: "dominoes",
        values: &[2.0, 3.0, 5.0, 10.0, 15.0, 20.0, 30.0, 50.0],
        quick_values: &[2.0, 5.0, 15.0],
        build: |count, _| dominoes(count as usize),
        judge: all_fall,
        seconds: |_| 20.0,
        quantity: "smallest turn of a domino",
        quantity_unit: "rad",
        ..StabilityFamily::PLAIN
    },
];

/// Length and thickness of a card in px.
const CARD: [f32; 2] = [2.0 * METRE, 2.0];
/// Angle of a leaning card from the vertical, in radians.
const LEAN: f32 = 25.0 * std::f32::consts::PI / 180.0;

/// Returns a house of cards: each storey is a row of pairs of leaning cards, and level cards lie between storeys.
fn card_house(storeys: usize) -> Scene {
    let mut stage = Stage::new().with_friction(0.7).with_floor(40.0 * METRE);
    let [length, thickness] = CARD;
    // Half extents of the bounding box of a leaning card.
    let half_width = (length * LEAN.sin() + thickness * LEAN.cos()) / 2.0;
    let half_height = (length * LEAN.cos() + thickness * LEAN.sin()) / 2.0;
    let storey = 2.0 * half_height + thickness;
    // Overlap of the upper corners of a pair, px. Neighbouring pairs stand side by side with a small gap.
    let press = 0.5;
    let tent = 4.0 * half_width + 1.0;
    for level in 0..storeys {
        let tents = storeys - level;
        let middle = -(level as f32 * storey) - half_height;
        for index in 0..tents {
            let centre = tent * (index as f32 - (tents - 1) as f32 / 2.0);
            for side in [-1.0, 1.0] {
                stage.solid([centre + side * (half_width - press), middle], [thickness, length]);
                // The top of the left card leans to the right: clockwise on the screen.
                stage.last().rotation = Some(-side * LEAN);
            }
            if index > 0 {
                let height = -(level as f32 * storey) - 2.0 * half_height - thickness / 2.0;
                stage.solid([centre - tent / 2.0, height], [tent, thickness]);
            }
        }
    }
    stage.done()
}

fn house_stands(_: f64, scene: &Scene) -> Box<dyn Watch> {
    // A card may shift by half its length and turn by 10 degrees.
    let allowed = Allowed { shift: 32.0, turn: 0.175, creep: 1.6 };
    all(vec![calm(scene, SPEED_LIMIT), standing(scene, SECONDS, allowed)])
}

fn dominoes(count: usize) -> Scene {
    let [width, height] = [0.25 * METRE, METRE];
    let mut stage = Stage::new().with_floor((count as f32 + 20.0) * METRE);
    for index in 0..count {
        let from_centre = index as f32 - (count - 1) as f32 / 2.0;
        stage.solid([0.75 * METRE * from_centre, -height / 2.0], [width, height]);
        if index == 0 {
            // An angular velocity of 2 rad/s about the lower right edge, twice that which topples the domino.
            stage.last().settings.angular_velocity = Some(2.0);
            stage.last().settings.linear_velocity = Some(Vector2::new(height, -width));
        }
    }
    stage.done()
}

fn all_fall(_: f64, scene: &Scene) -> Box<dyn Watch> {
    let (bodies, others) = (movable(scene), movable(scene));
    // The centre of a lying domino is half its thickness, 4 px, above the floor.
    let lowest = move |world: &dyn World| greatest(world, &others, |body| body.position[1]);
    // A domino that leans on the next one, which lies on the floor, has turned by more than 45 degrees.
    let turn = move |world: &dyn World| least(world, &bodies, |body| body.angle.abs());
    all(vec![
        calm(scene, SPEED_LIMIT),
        ends_in(..-2.0, reasons::SANK, lowest),
        ends_in(FRAC_PI_4.., reasons::STUCK, turn),
    ])
}
