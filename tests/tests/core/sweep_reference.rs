//! The pairs that the selective sweep finds, in their order, against a plain one: behaviour chapter 08, section 2.2.

use conformance::fixtures::plane::{self, Random, simulator, v};
use farseer_core::{
    Aabb, Body, BodyId, GeomId, GeomPlacement, PhysicsSimulator, SelectiveSweepOrder, Vertices,
};

/// Walks the ends of one axis: the number of intervals open at every begin, added up.
fn crowd(order: &SelectiveSweepOrder) -> i32 {
    let (mut count, mut depth) = (0, 0);
    for end in order.ends() {
        if end.is_begin {
            count += depth;
            depth += 1;
        } else {
            depth -= 1;
        }
    }
    count
}

/// State of the sweep between updates: the order of the ends on both axes.
struct Plain {
    x: SelectiveSweepOrder,
    y: SelectiveSweepOrder,
}

impl Plain {
    fn pairs(&mut self, boxes: &[Aabb]) -> Vec<(u32, u32)> {
        self.x.update(&boxes.iter().map(|b| (b.min.x, b.max.x)).collect::<Vec<_>>());
        self.y.update(&boxes.iter().map(|b| (b.min.y, b.max.y)).collect::<Vec<_>>());
        let along_x = crowd(&self.x) < crowd(&self.y);
        let order = if along_x { &self.x } else { &self.y };
        let other = |i: usize| {
            if along_x { (boxes[i].min.y, boxes[i].max.y) } else { (boxes[i].min.x, boxes[i].max.x) }
        };
        let is_point = |i: usize| boxes[i].min == boxes[i].max;
        let (mut open, mut pairs): (Vec<usize>, Vec<(u32, u32)>) = (Vec::new(), Vec::new());
        for end in order.ends() {
            let i = end.interval;
            if !end.is_begin {
                open.retain(|&other| other != i);
                continue;
            }
            let (low, high) = other(i);
            for &j in &open {
                let (open_low, open_high) = other(j);
                let pair = (i.min(j) as u32, i.max(j) as u32);
                if low <= open_high && open_low <= high && !pairs.contains(&pair) {
                    pairs.push(pair);
                }
            }
            if !is_point(i) {
                open.push(i);
            }
        }
        pairs
    }
}

/// A coordinate; often one that others have, too, and sometimes a zero of either sign.
fn coordinate(random: &mut Random, is_coarse: bool) -> f32 {
    if is_coarse {
        random.pick(&[-0.0, 0.0, 5.0, -5.0, 10.0, -10.0, 15.0, 20.0, -20.0])
    } else {
        random.between(-40.0, 40.0)
    }
}

fn add(simulator: &mut PhysicsSimulator, random: &mut Random, is_coarse: bool) -> (BodyId, GeomId) {
    let body = simulator.create_body(Body::new());
    let outline: Vertices = match random.below(8) {
        0 => [v(0.0, 0.0)].into_iter().collect(),
        1 => Vertices::create_simple_rectangle(60.0, 2.0).unwrap(),
        _ => Vertices::create_simple_rectangle(10.0, 10.0).unwrap(),
    };
    let position = v(coordinate(random, is_coarse), coordinate(random, is_coarse));
    simulator[body].set_position(position);
    let geom = simulator.create_geom(body, outline, GeomPlacement::with_grid_size(2.0)).unwrap();
    simulator.add(geom).unwrap();
    (body, geom)
}

#[test]
fn pairs_are_found_in_the_order_of_a_plain_sweep() {
    let mut found_at_all = 0;
    for seed in 0..300 {
        let mut random = Random::new(seed);
        let is_coarse = seed % 2 == 0;
        let count = 2 + random.below(60);
        let mut simulator = simulator(0.0);
        // No contact is resolved: the list is empty at the end of every update, and every pair is new.
        simulator.set_max_contacts_to_resolve(0).unwrap();
        let geoms: Vec<(BodyId, GeomId)> =
            (0..count).map(|_| add(&mut simulator, &mut random, is_coarse)).collect();
        let mut plain = Plain { x: SelectiveSweepOrder::new(count), y: SelectiveSweepOrder::new(count) };
        for step in 0..6 {
            assert!(simulator.process_queues(0.01, None));
            simulator.find_pairs(None);
            let boxes: Vec<Aabb> =
                geoms.iter().map(|&(_, geom)| simulator.geom(geom).unwrap().aabb()).collect();
            let expected = plain.pairs(&boxes);
            assert_eq!(plane::pairs(&simulator), expected, "seed {seed} step {step}");
            found_at_all += expected.len();
            simulator.collide_pairs(None);
            for _ in 0..random.below(count) {
                let (body, _) = random.pick(&geoms);
                let position = v(coordinate(&mut random, is_coarse), coordinate(&mut random, is_coarse));
                simulator[body].set_position(position);
            }
        }
    }
    assert!(found_at_all > 10_000);
}
