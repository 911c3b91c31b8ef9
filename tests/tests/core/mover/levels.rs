//! Properties over random levels, and the faithful methods.

use super::*;
use farseer_core::QueryFilter;
use proptest::prelude::{ProptestConfig, any, prop_assert, proptest};

/// Boxes with a place, a size, a rotation, and a velocity of those that move.
type Boxes = Vec<([f32; 2], [f32; 2], f32)>;

/// Numbers 0..1 from a seed (xorshift, G. Marsaglia, 2003).
fn random(seed: u64) -> impl FnMut() -> f32 {
    let mut state = seed | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 40) as f32 / (1u64 << 24) as f32
    }
}

fn level(mut next: impl FnMut() -> f32, count: usize) -> Boxes {
    (0..count)
        .map(|_| {
            let at = [600.0 * next() - 300.0, 400.0 * next() - 400.0];
            let turn = if next() < 0.5 { 0.0 } else { 6.0 * next() };
            (at, [10.0 + 90.0 * next(), 5.0 + 60.0 * next()], turn)
        })
        .filter(|([x, y], ..)| x.abs() > 90.0 || *y > -130.0 || *y < -300.0)
        .collect()
}

/// A closed room with the boxes of a level in it.
fn room(case: (GeomBuilder, f32), boxes: &Boxes) -> Stage {
    let mut stage = Stage::new(case, [0.0, -190.0]);
    let walls = [([900.0, 100.0], [0.0, 50.0]), ([900.0, 100.0], [0.0, -550.0])];
    let sides = [([100.0, 900.0], [-400.0, 0.0]), ([100.0, 900.0], [400.0, 0.0])];
    walls.into_iter().chain(sides).for_each(|(size, at)| _ = stage.fixed(size, at));
    for &(at, [width, height], turn) in boxes {
        let body = BodyBuilder::fixed().position(at).rotation(turn);
        stage.simulator.add_body(body, [GeomBuilder::rectangle(width, height)]).unwrap();
    }
    stage.simulator.update(stage.dt);
    stage
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn in_random_levels_it_is_never_inside_a_wall(seed in any::<u64>(), rate in 0usize..3, shape in 0usize..2) {
        let mut next = random(seed);
        let boxes = level(&mut next, 14);
        let shape = shapes()[shape].clone();
        let mut stage = room((shape.clone(), RATES[rate]), &boxes);
        let all = QueryFilter::default();
        if stage.simulator.overlap_any(&shape, stage.at(), 0.0, &all).unwrap().is_some() {
            return Ok(());
        }
        for _ in 0..20 {
            let input = MoverInput { x: 600.0 * next() - 300.0, jump: next() < 0.5, drop: false };
            for _ in 0..(0.25 * RATES[rate]) as usize {
                let before = stage.at();
                let report = stage.step(input);
                let inside = stage.simulator.overlap_any(&shape, stage.at(), 0.0, &all).unwrap();
                prop_assert!(inside.is_none() && report.crushed_by.is_none(), "{before} {} {report:?}", stage.at());
                let way = (stage.at() - before).norm();
                prop_assert!(way < 9.0 + 1500.0 * stage.dt, "{before} {}", stage.at());
            }
        }
    }

    #[test]
    fn among_platforms_that_move_it_is_in_a_static_wall_never(seed in any::<u64>(), shape in 0usize..2) {
        let mut next = random(seed);
        let shape = shapes()[shape].clone();
        let boxes = level(&mut next, 8);
        let mut stage = room((shape.clone(), 60.0), &boxes);
        let walls = QueryFilter { kinematic: false, ..QueryFilter::default() };
        let lifts: Vec<BodyId> = (0..4).map(|_| {
            let at = [500.0 * next() - 250.0, -400.0 * next() - 60.0];
            stage.kinematic([40.0 + 60.0 * next(), 20.0], at, [0.0, 0.0])
        }).collect();
        if stage.simulator.overlap_any(&shape, stage.at(), 0.0, &walls).unwrap().is_some() {
            return Ok(());
        }
        for _ in 0..20 {
            for &lift in &lifts {
                let velocity = Vector2::new(200.0 * next() - 100.0, 200.0 * next() - 100.0);
                stage.simulator[lift].set_linear_velocity(velocity);
            }
            let input = MoverInput { x: 600.0 * next() - 300.0, jump: next() < 0.5, drop: false };
            for _ in 0..15 {
                stage.step(input);
                let inside = stage.simulator.overlap_any(&shape, stage.at(), 0.0, &walls).unwrap();
                prop_assert!(inside.is_none(), "{}", stage.at());
            }
        }
    }
}

#[test]
fn with_the_faithful_methods_it_takes_the_same_path() {
    for case in cases() {
        let walk = |mut stage: Stage| {
            stage.fixed([400.0, 100.0], [300.0, 44.0]);
            stage.fixed([4000.0, 100.0], [0.0, 50.0]);
            stage.run(RIGHT, 0.7, |_| {});
            stage.run(MoverInput { jump: true, ..LEFT }, 0.7, |_| {});
            stage.mover.state()
        };
        let precise = Stage::new(case, [0.0, -20.0]);
        let mut faithful = precise.clone();
        faithful.simulator = PhysicsSimulator::new(Vector2::new(0.0, GRAVITY)).unwrap();
        let (one, other) = (serde_json::to_value(walk(precise)), serde_json::to_value(walk(faithful)));
        let place = |state: &serde_json::Value| (state["position"].clone(), state["velocity"].clone());
        assert_eq!(place(&one.unwrap()), place(&other.unwrap()));
    }
}
