//! Towers of light crates under a heavy figure that jumps and walks on them. Gravity 900 px/s², crates of 40 px, a figure of
//! mass 70.

use std::f32::consts::TAU;

use conformance::fixtures::depth::assert_near;
use twohalf::farseer_core::{IslandSolver, SolverReason};
use twohalf::{MoveInput, TwoHalfPhysicsSimulator, Vector2, Vector3};
use twohalf_factories::{Actor, Figure, Prism, Spawned, spawn};

const RATES: [f32; 3] = [30.0, 60.0, 120.0];
const STILL: MoveInput = MoveInput { x: 0.0, z: 0.0, jump: false };

#[derive(Clone)]
struct Stage {
    simulator: TwoHalfPhysicsSimulator,
    crates: Vec<Spawned>,
    built: Vec<Vector3>,
    figure: Actor,
    rate: f32,
    step: usize,
}

impl Stage {
    /// Crates with their middles at these positions, and a figure that stands at another one.
    fn new(rate: f32, mass: f32, places: &[[f32; 3]], figure: [f32; 3]) -> Self {
        let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0)).unwrap();
        let add = |&place| spawn(&mut simulator, Prism::new([40.0; 3]).mass(mass).at(place)).unwrap();
        let crates: Vec<_> = places.iter().map(add).collect();
        let figure = Actor::spawn(&mut simulator, Figure::new([30.0, 60.0, 20.0]).at(figure)).unwrap();
        let built = crates.iter().map(|one| one.place(&simulator)).collect();
        Stage { simulator, crates, built, figure, rate, step: 0 }
    }

    fn tower(rate: f32, mass: f32, beside: f32) -> Self {
        let places = [0.0, 40.0, 80.0, 120.0].map(|y| [0.0, y, 50.0]);
        Stage::new(rate, mass, &places, [beside, 160.0, 50.0])
    }

    /// Runs a number of seconds, with a jump in each.
    fn play(&mut self, seconds: f32, wish: impl Fn(f32) -> MoveInput) {
        for _ in 0..(seconds * self.rate).round() as usize {
            let time = self.step as f32 / self.rate;
            let jump = self.step % self.rate as usize == self.rate as usize / 4;
            let wish = MoveInput { jump, ..wish(time) };
            self.figure.act(&mut self.simulator, wish, 1.0 / self.rate).unwrap();
            self.simulator.update(1.0 / self.rate);
            self.step += 1;
        }
    }

    /// How far the crate that has moved most is from where it was built, px, and how far the one is turned that is turned most.
    fn moved(&self) -> [f32; 2] {
        let far = |(one, &built): (&Spawned, &Vector3)| (one.place(&self.simulator) - built).norm();
        let turned = |one: &Spawned| self.simulator.body(one.body).unwrap().rotation();
        [
            self.crates.iter().zip(&self.built).map(far).fold(0.0, f32::max),
            self.crates.iter().map(|one| turned(one).min(TAU - turned(one))).fold(0.0, f32::max),
        ]
    }

    /// Measured: 0.03 px at most in all the scenes below, and 1e-4 rad.
    fn assert_stands(&self, what: &str) {
        let [far, turned] = self.moved();
        assert!(far < 0.1 && turned < 1e-3, "{what} at {} Hz: {far} px, {turned} rad", self.rate);
    }
}

#[test]
fn light_crates_stand_under_a_heavy_figure_that_jumps_beside_their_middle() {
    for rate in RATES {
        for mass in [3.0, 6.0, 12.0, 20.0, 35.0] {
            for beside in [0.0, 8.0, 12.0] {
                let mut stage = Stage::tower(rate, mass, beside);
                stage.play(10.0, |_| STILL);
                stage.assert_stands(&format!("crates of {mass}, {beside} px beside"));
                assert_near(stage.figure.place(&stage.simulator).x, beside, 0.1);
            }
        }
    }
}

#[test]
fn crates_as_heavy_as_the_figure_on_them_stand_with_the_iterative_solver() {
    for rate in RATES {
        let mut stage = Stage::tower(rate, 70.0, 12.0);
        stage.play(10.0, |_| STILL);
        // Measured: 1.2 px at 30 Hz, where each step of a landing is twice as deep as at 60 Hz, and 0.1 px at the others.
        let [far, _] = stage.moved();
        assert!(far < if rate == 30.0 { 2.0 } else { 0.2 }, "at {rate} Hz: {far} px");
    }
}

#[test]
fn a_heavy_figure_may_walk_to_and_fro_on_a_tower_of_light_crates() {
    for rate in RATES {
        for mass in [3.0, 20.0] {
            let back = |time: f32| if (time as usize).is_multiple_of(2) { 12.0 } else { -12.0 };
            let mut along = Stage::tower(rate, mass, -6.0);
            along.play(8.0, |time| MoveInput { x: back(time), ..STILL });
            along.assert_stands(&format!("crates of {mass}, along X"));
            let mut across = Stage::tower(rate, mass, 8.0);
            across.play(8.0, |time| MoveInput { z: back(time), ..STILL });
            across.assert_stands(&format!("crates of {mass}, along Z"));
        }
    }
}

#[test]
fn blocks_and_pyramids_of_light_crates_stand_under_a_heavy_figure() {
    let columns = [[0.0, 50.0], [40.0, 50.0], [0.0, 90.0], [40.0, 90.0]];
    let block: Vec<_> = columns.iter().flat_map(|&[x, z]| [0.0, 40.0, 80.0].map(|y| [x, y, z])).collect();
    let row = |y: usize| (0..4 - y).map(move |x| [41.0 * (x as f32 + 0.5 * y as f32), 40.0 * y as f32, 50.0]);
    let pyramid: Vec<_> = (0..4).flat_map(row).collect();
    for rate in RATES {
        for mass in [3.0, 20.0] {
            let mut stage = Stage::new(rate, mass, &block, [10.0, 120.0, 60.0]);
            stage.play(5.0, |_| STILL);
            stage.assert_stands(&format!("a block of crates of {mass}"));
            let mut stage = Stage::new(rate, mass, &pyramid, [69.5, 160.0, 50.0]);
            stage.play(5.0, |_| STILL);
            stage.assert_stands(&format!("a pyramid of crates of {mass}"));
        }
    }
}

#[test]
fn only_islands_with_a_heavy_load_use_the_direct_solver_and_report_it() {
    let told = |mass: f32| {
        let mut stage = Stage::tower(60.0, mass, 8.0);
        stage.play(0.2, |_| STILL);
        let islands = stage.simulator.core().islands();
        islands.iter().map(|island| (island.method, island.why)).collect::<Vec<_>>()
    };
    assert_eq!(told(6.0), [(IslandSolver::Direct, SolverReason::Pays)]);
    assert_eq!(told(70.0), [(IslandSolver::Iterative, SolverReason::HasDepth)]);
}

#[test]
fn a_figure_that_lands_on_a_crate_at_full_speed_does_not_throw_it_away() {
    for rate in RATES {
        for mass in [3.0, 6.0, 20.0] {
            let mut stage = Stage::new(rate, mass, &[[0.0, 0.0, 50.0]], [-90.0, 0.0, 50.0]);
            stage.play(1.5, |time| MoveInput { x: if time < 1.0 { 110.0 } else { 0.0 }, ..STILL });
            stage.assert_stands(&format!("a crate of {mass}"));
        }
    }
}

#[test]
fn a_heavy_box_and_the_light_one_below_it_slide_the_distance_of_friction_in_any_direction() {
    // Both together with mu = 0.4: v² / (2 mu g) = 200² / 720 = 55.6 px, along their path.
    let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0)).unwrap();
    let mut add = |mass: f32, height: f32, y: f32| {
        let made = spawn(&mut simulator, Prism::new([80.0, height, 80.0]).mass(mass).at([0.0, y, 0.0]));
        made.unwrap()
    };
    let both = [add(6.0, 20.0, 0.0), add(70.0, 10.0, 20.0)];
    (0..30).for_each(|_| simulator.update(1.0 / 120.0));
    for one in both {
        simulator.body_mut(one.body).unwrap().set_velocity3d(Vector3::new(120.0, 0.0, 160.0));
    }
    let mut wholes = 0;
    for _ in 0..120 {
        simulator.update(1.0 / 120.0);
        wholes += simulator.core().islands().iter().filter(|island| island.is_solved_whole).count();
    }
    assert!(wholes > 30);
    for one in both {
        // Steps of 1/120 s end up to half a step of the first velocity beside that, 0.8 px.
        let place = one.place(&simulator);
        assert_near(place.x, 0.6 * 55.6, 1.0);
        assert_near(place.z, 0.8 * 55.6, 1.0);
    }
}

#[test]
fn a_tower_goes_on_with_the_same_bits_after_a_restore_in_the_middle_of_a_landing() {
    let mut stage = Stage::tower(60.0, 6.0, 8.0);
    // From a jump to the next one.
    for _ in 0..30 {
        stage.play(1.0 / 30.0, |_| STILL);
        let mut other = stage.clone();
        other.simulator = TwoHalfPhysicsSimulator::new(480).unwrap();
        other.simulator.restore(&stage.simulator.snapshot()).unwrap();
        let mut on = stage.clone();
        on.play(1.0, |_| STILL);
        other.play(1.0, |_| STILL);
        assert!(on.simulator.snapshot() == other.simulator.snapshot());
    }
}
