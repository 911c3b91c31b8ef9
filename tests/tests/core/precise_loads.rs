//! The precise set: light boxes under a heavy body that jumps on them. Gravity 900 px/s², boxes of 40 px, a load of 70 kg.

use conformance::fixtures::plane::{add_box, add_floor, simulator, v};
use farseer_core::{BodyId, IslandSolver, Methods, PhysicsSimulator, SolverReason};

const RATES: [f32; 3] = [30.0, 60.0, 120.0];
const JUMP: f32 = 300.0;

#[derive(Clone)]
struct Tower {
    simulator: PhysicsSimulator,
    boxes: Vec<BodyId>,
    load: BodyId,
    rate: f32,
    step: usize,
}

impl Tower {
    /// Boxes that fall onto each other from this height, and a load that falls onto them beside their middle.
    fn new(rate: f32, mass: f32, [beside, drop]: [f32; 2]) -> Self {
        let mut simulator = simulator(900.0);
        simulator.set_methods(Methods::PRECISE).unwrap();
        add_floor(&mut simulator, (2000.0, 20.0), v(0.0, 10.0));
        let add = |row: usize| {
            let height = 40.0 * row as f32 + drop * (row + 1) as f32;
            heavy(&mut simulator, mass, (40.0, 40.0), v(0.0, -20.0 - height))
        };
        let boxes = (0..4).map(add).collect();
        let load = heavy(&mut simulator, 70.0, (30.0, 60.0), v(beside, -190.0 - 6.0 * drop));
        let mut tower = Tower { simulator, boxes, load, rate, step: 0 };
        (0..rate as usize).for_each(|_| tower.simulator.update(1.0 / rate));
        tower
    }

    /// Makes a number of updates, with a jump in each second.
    fn play(&mut self, updates: usize) {
        for _ in 0..updates {
            if self.step % self.rate as usize == self.rate as usize / 4 {
                let x = self.simulator[self.load].linear_velocity().x;
                self.simulator[self.load].set_linear_velocity(v(x, -JUMP));
            }
            self.simulator.update(1.0 / self.rate);
            self.step += 1;
        }
    }

    fn places(&self) -> Vec<[f32; 3]> {
        let place = |&one: &BodyId| {
            let body = &self.simulator[one];
            [body.position().x, body.position().y, body.total_rotation()]
        };
        self.boxes.iter().map(place).collect()
    }
}

fn heavy(
    simulator: &mut PhysicsSimulator,
    mass: f32,
    size: (f32, f32),
    place: farseer_core::math::Vector2,
) -> BodyId {
    let (body, _) = add_box(simulator, size, place);
    simulator[body].set_mass(mass).unwrap();
    simulator[body].set_moment_of_inertia(mass * (size.0 * size.0 + size.1 * size.1) / 12.0).unwrap();
    body
}

#[test]
fn light_boxes_stand_under_a_heavy_body_that_jumps_on_them() {
    for rate in RATES {
        for mass in [3.0, 6.0, 12.0, 20.0, 35.0, 46.0] {
            for beside in [0.0, 8.0, 12.0] {
                let mut tower = Tower::new(rate, mass, [beside, 0.0]);
                let built = tower.places();
                tower.play(10 * rate as usize);
                for (now, then) in tower.places().iter().zip(&built) {
                    let off = (0..2).map(|axis| (now[axis] - then[axis]).abs()).fold(0.0, f32::max);
                    let turned = (now[2] - then[2]).abs();
                    let what = format!("boxes of {mass} at {rate} Hz, {beside} px beside");
                    // Measured: 0.2 px and 2e-4 at most, for boxes of 3; with the iterative solver they fall, or are shifted by
                    // 3 px and more.
                    assert!(off < 0.25 && turned < 1e-3, "{what}: {off} px, {turned}");
                }
            }
        }
    }
}

#[test]
fn moving_islands_with_a_heavy_load_use_the_direct_solver() {
    let lands = |mass: f32| {
        let mut tower = Tower::new(60.0, mass, [8.0, 10.0]);
        // The jump begins in the 16th update, and lasts 40.
        tower.play(16 + 40 + 2);
        let islands = tower.simulator.islands();
        let island = islands.iter().max_by_key(|island| island.bodies.len()).unwrap();
        assert_eq!(island.bodies.len(), 5);
        (island.method, island.why)
    };
    assert_eq!(lands(6.0), (IslandSolver::Direct, SolverReason::Pays));
    assert_eq!(lands(70.0), (IslandSolver::Iterative, SolverReason::Moves));
}

#[test]
fn a_tower_goes_on_with_the_same_bits_after_a_restore_in_the_middle_of_a_landing() {
    let mut tower = Tower::new(60.0, 6.0, [8.0, 10.0]);
    for _ in 0..20 {
        tower.play(4);
        let (mut on, mut other) = (tower.clone(), tower.clone());
        other.simulator = PhysicsSimulator::default();
        other.simulator.restore(&tower.simulator.snapshot()).unwrap();
        on.play(60);
        other.play(60);
        assert!(on.simulator.snapshot() == other.simulator.snapshot());
    }
}
