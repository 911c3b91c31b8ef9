//! Charts of a house of cards and an arch: structures that stand by friction and shape alone. Both are built with a slight
//! overlap; height errors are relative to the state without overlaps.

use super::ChartScene;
use super::build::{PRESS, ground, stage};
use super::settled::{Rest, built_height, charts_of_rest, toppled};
use crate::scenes::movable;
use conformance::scene::Scene;

const FRICTION: f64 = 0.7;
const CARD: f64 = 64.0;
const THICKNESS: f64 = 4.0;
/// Angle of a leaning card from the vertical in radians. Its tangent, 0.36, is below the friction coefficient.
const LEAN: f64 = std::f64::consts::PI / 9.0;
const SPAN: f64 = 160.0;
/// Thickness of the arch in px, a fifth of the inner radius. A half circle stands from about a tenth on.
const DEPTH: f64 = 32.0;

/// Duration and condition of failure of the house of cards: a card is a quarter of its length away from its start.
const CARDS: Rest = Rest { seconds: 5.0, ruin: |scene| toppled(scene, CARD / 4.0) };
/// Duration and condition of failure of the arch: a stone is half the arch's thickness away from its start.
const ARCH: Rest = Rest { seconds: 5.0, ruin: |scene| toppled(scene, DEPTH / 2.0) };

pub(super) fn scenes() -> Vec<ChartScene> {
    let cards = ChartScene {
        name: "card_house_penetration",
        about: "A house of cards stands: pairs that lean on each other, and level cards between the storeys.",
        sizes: &[5, 20, 200],
        build: |count| card_house(count, PRESS),
        seconds: CARDS.seconds,
        watch: |scene| CARDS.penetration(scene),
        error: "largest overlap at the end",
        unit: "px",
        // 1 px: a gap of a pixel looks like a contact.
        tolerance: 1.0,
        broad_phases_matter: false,
        peers_too: true,
    };
    let stones = ChartScene {
        name: "arch_penetration",
        about: "A half circle of wedge-shaped stones stands on the ground.",
        // 200 stones of this arch would be slivers of 2.5 px each.
        sizes: &[5, 20],
        build: |count| arch(count, PRESS),
        seconds: ARCH.seconds,
        watch: |scene| ARCH.penetration(scene),
        ..cards
    };
    let mut scenes = Vec::new();
    scenes.extend(charts_of_rest(
        cards,
        ("card_house_height", |scene| {
            CARDS.height(scene, built_height(&card_house(movable(scene).len(), 0.0)))
        }),
        ("card_house_speed", |scene| CARDS.speed(scene)),
    ));
    scenes.extend(charts_of_rest(
        stones,
        ("arch_height", |scene| ARCH.height(scene, built_height(&arch(movable(scene).len(), 0.0)))),
        ("arch_speed", |scene| ARCH.speed(scene)),
    ));
    scenes
}

/// Returns the smallest house of at least `count` cards. Each storey has one pair less than the one below and rests on level
/// cards from apex to apex. Cards overlap by `press` px.
fn card_house(count: usize, press: f64) -> Scene {
    let cards = |pairs: usize| (1..=pairs).map(|pairs| 3 * pairs - 1).sum::<usize>();
    let pairs = (1..).find(|&pairs| cards(pairs) >= count).unwrap_or(1);
    let mut stage = stage(format!("card_house_of_{}", cards(pairs))).with_surface(FRICTION, 0.0);
    let (sine, cosine) = LEAN.sin_cos();
    // Width of a pair at its feet; the next pair begins 2 px beside it.
    let spacing = 2.0 * (CARD * sine + THICKNESS * cosine) + 2.0;
    let rise = CARD * cosine + THICKNESS * sine - press;
    ground(&mut stage, spacing * (pairs as f64 + 6.0), 0.0);
    for storey in 0..pairs {
        let base = -(storey as f64) * (rise + THICKNESS - press);
        let count = pairs - storey;
        let centre = |index: usize| spacing * (index as f64 - (count - 1) as f64 / 2.0);
        for index in 0..count {
            for side in [-1.0, 1.0] {
                // The inner upper corners of a pair meet at the apex.
                let x = centre(index) + side * ((THICKNESS * cosine + CARD * sine) / 2.0 - press);
                stage.boxed([x, base - rise / 2.0 + press / 2.0], [THICKNESS, CARD], 1.0);
                stage.last().rotation = Some((-side * LEAN) as f32);
            }
        }
        for index in 1..count {
            // The level card is a pixel shorter than the spacing, so that it ends beside the next one.
            let place = [centre(index) - spacing / 2.0, base - rise - THICKNESS / 2.0 + press];
            stage.boxed(place, [spacing - 1.0, THICKNESS], 1.0);
        }
    }
    stage.done()
}

/// Returns a half-circle arch of `count` stones. Each stone overlaps its neighbours by `press` px.
///
/// The stones have exactly their share of the half circle, and start too near to its centre. An arch of wider stones would
/// be higher than the half circle once the overlaps are gone.
fn arch(count: usize, press: f64) -> Scene {
    let mut stage = stage(format!("arch_of_{count}")).with_surface(FRICTION, 0.0);
    ground(&mut stage, 4.0 * SPAN + 320.0, 0.0);
    let share = std::f64::consts::PI / count as f64;
    // Two neighbours at a distance `inwards` from their places overlap by 2 inwards sin(share / 2).
    let inwards = press / (2.0 * (share / 2.0).sin());
    for index in 0..count {
        let (from, to) = (share * index as f64, share * (index + 1) as f64);
        let towards = |length: f64, angle: f64| [-length * angle.cos(), -length * angle.sin()];
        let offset = towards(-inwards, (from + to) / 2.0);
        let corner = |radius: f64, angle: f64| {
            let [x, y] = towards(radius, angle);
            [x + offset[0], y + offset[1]]
        };
        let corners =
            [corner(SPAN, from), corner(SPAN + DEPTH, from), corner(SPAN + DEPTH, to), corner(SPAN, to)];
        stage.stone(&corners);
    }
    stage.done()
}
