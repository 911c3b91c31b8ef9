//! Figures that take hold of edges, hang, and climb, at 30 to 240 steps per second. Gravity 900 px/s².
//!
//! Figures are 30 x 60 x 20 px, and reach edges 75 px over their soles.

use conformance::fixtures::depth::{assert_near, fix, geom_of, place, platform, solid, velocity};
use twohalf::{
    BodyId, CharacterController, CharacterSettings, ContactTarget, MoveInput, PlatformId,
    TwoHalfPhysicsSimulator, Vector2, Vector3,
};
use twohalf_factories::{Capsule, Figure, Prism, spawn};

const RATES: [f32; 4] = [30.0, 60.0, 120.0, 240.0];
const REACH: f32 = 75.0;
const STILL: MoveInput = MoveInput { x: 0.0, z: 0.0, jump: false };
const RIGHT: MoveInput = MoveInput { x: 150.0, ..STILL };
const LEFT: MoveInput = MoveInput { x: -150.0, ..STILL };

struct Stage {
    simulator: TwoHalfPhysicsSimulator,
    figure: BodyId,
    walker: CharacterController,
    dt: f32,
}

impl Stage {
    fn new(rate: f32, at: [f32; 3]) -> Self {
        let mut simulator = TwoHalfPhysicsSimulator::with_gravity(600, Vector2::new(0.0, 900.0)).unwrap();
        let figure = Prism::new([30.0, 60.0, 20.0]).mass(70.0).friction(0.0).upright();
        let figure = spawn(&mut simulator, figure.at(at)).unwrap().body;
        let walker = CharacterController::new(CharacterSettings {
            ledge_reach: REACH,
            ..CharacterSettings::default()
        });
        Stage { simulator, figure, walker, dt: 1.0 / rate }
    }

    /// A wall of a height from X = 0 to 200 over Z = 0 to 100.
    fn with_wall(rate: f32, height: f32, at: [f32; 3]) -> (Self, PlatformId) {
        let mut stage = Stage::new(rate, at);
        let wall = platform(&mut stage.simulator, [200.0, height, 100.0], [100.0, 0.0, 50.0]);
        (stage, wall)
    }

    fn step(&mut self, wish: MoveInput) {
        self.simulator.walk(self.figure, &mut self.walker, wish, self.dt).unwrap();
        self.simulator.update(self.dt);
    }

    fn walk(&mut self, wish: MoveInput, seconds: f32, mut look: impl FnMut(&Self)) {
        for _ in 0..(seconds / self.dt).round() as usize {
            self.step(wish);
            look(self);
        }
    }

    fn at(&self) -> Vector3 {
        place(&self.simulator, self.figure)
    }

    /// Falls beside an edge with a wish until it hangs there.
    #[track_caller]
    fn hang(&mut self, wish: MoveInput) {
        for _ in 0..(2.0 / self.dt) as usize {
            self.step(wish);
            if self.walker.ledge().is_some() {
                return;
            }
        }
        panic!("it has not taken hold of anything: {:?}", self.at());
    }
}

#[test]
fn a_figure_that_falls_beside_an_edge_with_input_towards_it_hangs_and_climbs_up() {
    for rate in RATES {
        let (mut stage, wall) = Stage::with_wall(rate, 200.0, [-17.0, 180.0, 50.0]);
        stage.hang(RIGHT);
        assert_eq!(stage.walker.ledge(), Some(ContactTarget::Platform(wall)));
        // As high as it reaches, but for the fall within a step.
        let soles = stage.at().y;
        assert!(soles <= 200.0 && soles > 200.0 - REACH - 330.0 / rate, "{rate}: {soles}");
        let mut highest = 0.0_f32;
        stage.walk(RIGHT, 1.2, |stage| {
            highest = highest.max(stage.at().y);
            assert!(stage.at().x > 0.0 || stage.at().x <= -15.0 + 0.01 || stage.at().y >= 199.9, "{rate}");
        });
        assert!(stage.walker.is_grounded() && stage.walker.ledge().is_none(), "{rate} {:?}", stage.at());
        assert_near(stage.at().y, 200.0, 0.05);
        assert!(highest < 202.0, "{rate}: {highest}");
        assert!(stage.at().x > 30.0);
    }
}

#[test]
fn a_jump_reaches_an_edge_that_is_higher_than_it() {
    for rate in RATES {
        let (mut stage, _) = Stage::with_wall(rate, 120.0, [-60.0, 0.0, 50.0]);
        stage.walk(STILL, 0.1, |_| ());
        stage.step(MoveInput { jump: true, ..RIGHT });
        stage.walk(RIGHT, 1.5, |_| ());
        assert_near(stage.at().y, 120.0, 0.05);
        assert!(stage.walker.is_grounded(), "{rate} {:?} {:?}", stage.at(), stage.walker);
    }
}

#[test]
fn it_climbs_along_z_as_well() {
    for (start, wish_z) in [(-12.0, 150.0), (112.0, -150.0)] {
        for rate in RATES {
            let (mut stage, _) = Stage::with_wall(rate, 200.0, [100.0, 170.0, start]);
            let wish = MoveInput { z: wish_z, ..STILL };
            stage.hang(wish);
            stage.walk(wish, 0.8, |_| ());
            assert!(stage.walker.is_grounded());
            assert_near(stage.at().y, 200.0, 0.05);
            assert!((10.0..90.0).contains(&stage.at().z), "{:?}", stage.at());
        }
    }
}

#[test]
fn round_figures_climb_from_every_side() {
    // 25 px across.
    let figures = [Figure::new([30.0, 60.0, 20.0]), Capsule::new(12.5, 60.0).mass(70.0).friction(0.0)];
    let ways = [([-14.0, 50.0], [1.0, 0.0]), ([214.0, 50.0], [-1.0, 0.0])];
    let ways = ways.into_iter().chain([([100.0, -14.0], [0.0, 1.0]), ([100.0, 114.0], [0.0, -1.0])]);
    for ([x, z], [wish_x, wish_z]) in ways {
        for (figure, rate) in figures.into_iter().flat_map(|figure| RATES.map(|rate| (figure, rate))) {
            let (mut stage, _) = Stage::with_wall(rate, 200.0, [-500.0, 0.0, 50.0]);
            stage.figure = spawn(&mut stage.simulator, figure.at([x, 170.0, z])).unwrap().body;
            let wish = MoveInput { x: 150.0 * wish_x, z: 150.0 * wish_z, jump: false };
            stage.hang(wish);
            stage.walk(wish, 0.8, |_| ());
            assert!(stage.walker.is_grounded(), "{rate}: {:?}", stage.at());
            assert_near(stage.at().y, 200.0, 0.05);
        }
    }
}

#[test]
fn without_input_a_figure_hangs_at_rest_for_ever() {
    for rate in RATES {
        let (mut stage, _) = Stage::with_wall(rate, 200.0, [-16.0, 170.0, 50.0]);
        stage.hang(RIGHT);
        stage.step(STILL);
        let there = stage.at();
        stage.walk(STILL, 3.0, |stage| assert!((stage.at() - there).norm() < 0.05));
        stage.walk(RIGHT, 1.2, |_| ());
        assert_near(stage.at().y, 200.0, 0.05);
    }
}

#[test]
fn a_hanging_figure_drops_on_input_away_from_the_ledge_and_jumps_off_on_a_jump() {
    for rate in RATES {
        let (mut stage, _) = Stage::with_wall(rate, 200.0, [-16.0, 170.0, 50.0]);
        stage.hang(RIGHT);
        let soles = stage.at().y;
        let mut jumping = Stage { simulator: stage.simulator.clone(), ..stage };
        stage.walk(LEFT, 1.5, |_| ());
        assert_near(stage.at().y, 0.0, 0.05);
        assert!(stage.walker.ledge().is_none() && stage.at().x < -100.0);
        jumping.step(MoveInput { jump: true, ..LEFT });
        let mut highest = 0.0_f32;
        jumping.walk(LEFT, 0.5, |stage| highest = highest.max(stage.at().y));
        assert_near(highest, soles + 60.0, 3.0);
    }
}

#[test]
fn a_hanging_figure_follows_a_moving_edge() {
    for rate in RATES {
        let (mut stage, lift) = Stage::with_wall(rate, 200.0, [-16.0, 170.0, 50.0]);
        stage.hang(RIGHT);
        stage.step(STILL);
        let (from, edge) = (stage.at(), stage.simulator.platform(lift).unwrap().position3d());
        stage.simulator.platform_mut(lift).unwrap().set_velocity(Vector3::new(-20.0, 40.0, 10.0)).unwrap();
        stage.walk(STILL, 2.0, |_| ());
        let moved = stage.simulator.platform(lift).unwrap().position3d() - edge;
        assert!((stage.at() - from - moved).norm() < 1.0, "{rate}: {:?} beside {moved:?}", stage.at() - from);
        stage.walk(RIGHT, 1.5, |_| ());
        let top = stage.simulator.platform(lift).unwrap().position3d().y + 200.0;
        assert_near(stage.at().y, top, 0.1);
        assert!(stage.walker.is_grounded());
    }
}

#[test]
fn static_bodies_have_edges_and_crates_that_can_be_pushed_have_none() {
    for is_fixed in [true, false] {
        let mut stage = Stage::new(60.0, [-16.0, 130.0, 50.0]);
        let wall = solid(&mut stage.simulator, [300.0, 160.0, 60.0], [150.0, 0.0, 50.0]);
        if is_fixed {
            fix(&mut stage.simulator, wall);
        }
        let mut held = None;
        stage.walk(RIGHT, 1.5, |stage| held = held.or(stage.walker.ledge()));
        assert_eq!(held, is_fixed.then(|| ContactTarget::Geom(geom_of(&stage.simulator, wall))));
        assert_eq!((stage.at().y - 160.0).abs() < 0.1, is_fixed);
    }
}

#[test]
fn ledges_without_space_to_stand_are_not_grabbed() {
    for rate in RATES {
        let (mut stage, _) = Stage::with_wall(rate, 200.0, [-16.0, 170.0, 50.0]);
        // 50 px over the edge, for a figure of 60 px.
        platform(&mut stage.simulator, [200.0, 20.0, 100.0], [100.0, 250.0, 50.0]);
        stage.walk(RIGHT, 1.5, |stage| assert_eq!(stage.walker.ledge(), None));
        assert_near(stage.at().y, 0.0, 0.05);
    }
}

#[test]
fn it_does_not_grab_while_rising_or_without_input_or_without_reach() {
    for rate in RATES {
        let (mut stage, _) = Stage::with_wall(rate, 60.0, [-20.0, 0.0, 50.0]);
        stage.walk(STILL, 0.1, |_| ());
        stage.step(MoveInput { jump: true, ..STILL });
        stage.walk(RIGHT, 0.2, |stage| assert_eq!(stage.walker.ledge(), None));

        let (mut stage, _) = Stage::with_wall(rate, 200.0, [-16.0, 170.0, 50.0]);
        stage.walk(STILL, 1.0, |stage| assert_eq!(stage.walker.ledge(), None));

        let (mut stage, _) = Stage::with_wall(rate, 200.0, [-16.0, 170.0, 50.0]);
        stage.walker = CharacterController::new(CharacterSettings::default());
        stage.walk(RIGHT, 1.0, |stage| assert_eq!(stage.walker.ledge(), None));
    }
}

#[test]
fn a_struck_figure_drops_from_the_ledge() {
    for rate in RATES {
        let (mut stage, _) = Stage::with_wall(rate, 200.0, [-16.0, 170.0, 50.0]);
        stage.hang(RIGHT);
        stage.step(STILL);
        stage.simulator.body_mut(stage.figure).unwrap().set_velocity3d(Vector3::new(-180.0, 0.0, 0.0));
        stage.step(STILL);
        assert_eq!(stage.walker.ledge(), None);
        stage.walk(STILL, 0.2, |_| ());
        assert!(velocity(&stage.simulator, stage.figure).y < -100.0);
    }
}

#[test]
fn hanging_is_saved_with_the_controller() {
    let (mut stage, _) = Stage::with_wall(60.0, 200.0, [-16.0, 170.0, 50.0]);
    stage.hang(RIGHT);
    let text = serde_json::to_string(&stage.walker).unwrap();
    let walker: CharacterController = serde_json::from_str(&text).unwrap();
    assert_eq!(walker, stage.walker);
    let mut other = Stage { simulator: stage.simulator.clone(), walker, ..stage };
    stage.walk(RIGHT, 1.0, |_| ());
    other.walk(RIGHT, 1.0, |_| ());
    assert_eq!(stage.at(), other.at());
}
