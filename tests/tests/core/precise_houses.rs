//! The precise set: houses of cards, which stand by friction alone.

use conformance::fixtures::plane::{add_box, add_circle, add_floor, precise, v};
use farseer_core::math::Vector2;
use farseer_core::{BodyId, IslandSolver, PhysicsSimulator, SolverReason};

const GRAVITY: f32 = 320.0;
/// Length and thickness of a card in px.
const CARD: [f32; 2] = [64.0, 2.0];
/// Rotation of a leaning card from upright: 25 degrees.
const LEAN: f32 = 25.0 * std::f32::consts::PI / 180.0;

fn add_card(simulator: &mut PhysicsSimulator, size: [f32; 2], at: [f32; 2], turn: f32) -> BodyId {
    let (body, geom) = add_box(simulator, (size[0], size[1]), v(at[0], at[1]));
    simulator[body].set_rotation(turn);
    simulator[geom].set_friction_coefficient(0.7);
    body
}

/// Cards of a tent press by 0.5 px into each other; tents are 1 px apart.
fn add_house(simulator: &mut PhysicsSimulator, storeys: usize, middle: f32) -> Vec<BodyId> {
    let (_, floor) = add_floor(simulator, (400.0, 100.0), v(middle, 50.0));
    simulator[floor].set_friction_coefficient(0.7);
    let [length, thickness] = CARD;
    let half_width = (length * LEAN.sin() + thickness * LEAN.cos()) / 2.0;
    let half_height = (length * LEAN.cos() + thickness * LEAN.sin()) / 2.0;
    let (storey, tent) = (2.0 * half_height + thickness, 4.0 * half_width + 1.0);
    let mut cards = Vec::new();
    for level in 0..storeys {
        let tents = storeys - level;
        let foot = -(level as f32 * storey);
        for at in 0..tents {
            let centre = middle + tent * (at as f32 - (tents - 1) as f32 / 2.0);
            for side in [-1.0, 1.0] {
                let place = [centre + side * (half_width - 0.5), foot - half_height];
                cards.push(add_card(simulator, [thickness, length], place, -side * LEAN));
            }
            if at > 0 {
                let place = [centre - tent / 2.0, foot - storey + thickness / 2.0];
                cards.push(add_card(simulator, [tent, thickness], place, 0.0));
            }
        }
    }
    cards
}

/// The farthest that a card has come from where it was built, in px.
fn shift(simulator: &PhysicsSimulator, cards: &[(BodyId, Vector2)]) -> f32 {
    cards.iter().map(|&(card, built)| (simulator[card].position() - built).norm()).fold(0.0, f32::max)
}

fn placed(simulator: &PhysicsSimulator, cards: Vec<BodyId>) -> Vec<(BodyId, Vector2)> {
    cards.into_iter().map(|card| (card, simulator[card].position())).collect()
}

/// Greatest shift in px of a card of a standing house. Overlaps of 0.5 px and gaps of 1 px let a card of the highest storey
/// move by some px on its way to rest, and by tens where the house topples.
const STANDING_SHIFT: f32 = 8.0;

#[test]
fn houses_of_two_to_six_storeys_stand() {
    let rates = [25.0, 30.0, 35.0, 40.0, 50.0, 60.0, 75.0, 90.0, 120.0, 144.0];
    for (storeys, rate) in [2, 3, 4, 5, 6].into_iter().flat_map(|storeys| rates.map(|rate| (storeys, rate))) {
        let mut simulator = precise(GRAVITY);
        let cards = add_house(&mut simulator, storeys, 0.0);
        let cards = placed(&simulator, cards);
        (0..(8.0 * rate) as usize).for_each(|_| simulator.update(1.0 / rate));
        let shift = shift(&simulator, &cards);
        assert!(shift < STANDING_SHIFT, "{storeys} storeys at {rate} Hz: a card has moved by {shift} px");
    }
}

/// The solver of an island is chosen in every sixteenth update where more than 64 bodies are awake or some are fast; slipping
/// friction is detected at once.
#[test]
fn houses_stand_beside_other_houses_and_moving_bodies() {
    let mut simulator = precise(GRAVITY);
    let houses: Vec<_> = (0..5).flat_map(|at| add_house(&mut simulator, 3, 400.0 * at as f32)).collect();
    let cards = placed(&simulator, houses);
    let (ball, _) = add_circle(&mut simulator, 10.0, 16, v(-500.0, -400.0));
    simulator[ball].set_linear_velocity(v(0.0, -400.0));
    (0..480).for_each(|_| simulator.update(1.0 / 60.0));
    let shift = shift(&simulator, &cards);
    assert!(shift < STANDING_SHIFT, "a card has moved by {shift} px");
}

/// A pyramid of 6 rows, on a floor of its own.
fn add_pyramid(simulator: &mut PhysicsSimulator, middle: f32) -> Vec<BodyId> {
    add_floor(simulator, (400.0, 100.0), v(middle, 50.0));
    let places = (0..6_u8).flat_map(|row| (0..6 - row).map(move |at| (row, at)));
    let add = |(row, at): (u8, u8)| {
        let x = middle + 34.0 * (f32::from(at) - f32::from(5 - row) / 2.0);
        add_box(simulator, (32.0, 32.0), v(x, -16.0 - 31.95 * f32::from(row))).0
    };
    places.map(add).collect()
}

/// A pyramid stands without friction, so the iterative solver has it in every update.
#[test]
fn a_small_pyramid_uses_the_iterative_solver() {
    let mut simulator = precise(GRAVITY);
    add_pyramid(&mut simulator, 0.0);
    for update in 0..120 {
        simulator.update(1.0 / 60.0);
        let island = &simulator.islands()[0];
        assert!(island.is_asleep || island.why == SolverReason::TooSmall, "update {update}: {island:?}");
    }
}

#[test]
fn a_house_and_a_pyramid_go_on_with_the_same_bits_after_a_restore() {
    let mut simulator = precise(GRAVITY);
    let bodies = [add_house(&mut simulator, 3, 0.0), add_pyramid(&mut simulator, 600.0)].concat();
    let state = |simulator: &PhysicsSimulator| {
        bodies
            .iter()
            .map(|&body| (simulator[body].position(), simulator[body].rotation()))
            .collect::<Vec<_>>()
    };
    let mut methods = Vec::new();
    for _ in 0..60 {
        simulator.update(1.0 / 60.0);
        methods.extend(simulator.islands().iter().map(|island| island.method));
        let mut other = precise(GRAVITY);
        other.restore(&simulator.snapshot()).unwrap();
        (0..5).for_each(|_| other.update(1.0 / 60.0));
        let mut same = simulator.clone();
        (0..5).for_each(|_| same.update(1.0 / 60.0));
        assert_eq!(state(&other), state(&same));
    }
    assert!(
        methods.contains(&IslandSolver::Direct) && methods.contains(&IslandSolver::Iterative),
        "{methods:?}"
    );
}
