//! The character mover: its feel at 30, 60 and 240 Hz against closed forms, and properties over random levels. Y is down, and
//! the top of the ground is at 0.

mod edges;
mod levels;
mod moving;

use farseer_core::math::Vector2;
use farseer_core::{
    BodyBuilder, BodyId, CharacterMover, GeomBuilder, MoverInput, MoverOptions, MoverReport, PhysicsSimulator,
};

const RATES: [f32; 3] = [30.0, 60.0, 240.0];
const GRAVITY: f32 = 900.0;
const STILL: MoverInput = MoverInput { x: 0.0, jump: false, drop: false };
const RIGHT: MoverInput = MoverInput { x: 150.0, ..STILL };
const LEFT: MoverInput = MoverInput { x: -150.0, ..STILL };
const JUMP: MoverInput = MoverInput { jump: true, ..STILL };

fn near(a: f32, b: f32, tolerance: f32) {
    assert!((a - b).abs() <= tolerance, "{a}, not {b} within {tolerance}");
}

/// Shapes of a figure of 30 by 60: flat soles, and round ones.
fn shapes() -> [GeomBuilder; 2] {
    [GeomBuilder::rectangle(30.0, 60.0), GeomBuilder::capsule(60.0, 15.0)]
}

/// Every shape at every rate.
fn cases() -> impl Iterator<Item = (GeomBuilder, f32)> {
    shapes().into_iter().flat_map(|shape| RATES.map(|rate| (shape.clone(), rate)))
}

/// A scene with one figure.
#[derive(Clone)]
struct Stage {
    simulator: PhysicsSimulator,
    mover: CharacterMover,
    dt: f32,
}

impl Stage {
    /// A figure whose soles are at a place.
    fn new((shape, rate): (GeomBuilder, f32), [x, soles]: [f32; 2]) -> Self {
        let mover = CharacterMover::new(&shape, [x, soles - 30.0], MoverOptions::default()).unwrap();
        Stage { simulator: PhysicsSimulator::precise([0.0, GRAVITY]).unwrap(), mover, dt: 1.0 / rate }
    }

    /// A figure on level ground.
    fn on_ground(case: (GeomBuilder, f32)) -> Self {
        let mut stage = Stage::new(case, [0.0, -0.1]);
        stage.fixed([4000.0, 100.0], [0.0, 50.0]);
        stage.run(STILL, 0.2, |_| {});
        assert!(stage.mover.is_grounded());
        stage
    }

    fn fixed(&mut self, [width, height]: [f32; 2], at: [f32; 2]) -> BodyId {
        let geom = GeomBuilder::rectangle(width, height);
        self.simulator.add_body(BodyBuilder::fixed().position(at), [geom]).unwrap().0
    }

    fn kinematic(&mut self, [width, height]: [f32; 2], at: [f32; 2], velocity: [f32; 2]) -> BodyId {
        let body = BodyBuilder::kinematic().position(at).linear_velocity(velocity);
        self.simulator.add_body(body, [GeomBuilder::rectangle(width, height)]).unwrap().0
    }

    fn crate_box(&mut self, size: f32, mass: f32, at: [f32; 2]) -> BodyId {
        let geom = GeomBuilder::rectangle(size, size).friction(0.4);
        self.simulator.add_body(BodyBuilder::dynamic().position(at).mass(mass), [geom]).unwrap().0
    }

    /// Ground that falls to the right with a slope of some degrees from (0, 0), beside level ground on its left.
    fn slope(&mut self, degrees: f32) {
        let fall = 1000.0 * degrees.to_radians().tan();
        let top =
            [[-1000.0, 0.0], [0.0, 0.0], [1000.0, fall], [1000.0, fall + 100.0], [-1000.0, fall + 100.0]];
        self.simulator.add_body(BodyBuilder::fixed(), [GeomBuilder::polygon(top)]).unwrap();
    }

    fn step(&mut self, input: MoverInput) -> MoverReport {
        self.simulator.update(self.dt);
        self.mover.update(&mut self.simulator, input, self.dt).unwrap()
    }

    /// Steps for some seconds, and calls a function after each. Returns the last report.
    fn run(&mut self, input: MoverInput, seconds: f32, mut look: impl FnMut(&mut Self)) -> MoverReport {
        let mut report = MoverReport::default();
        for _ in 0..(seconds / self.dt).round() as usize {
            report = self.step(input);
            look(self);
        }
        report
    }

    fn at(&self) -> Vector2 {
        self.mover.position()
    }

    /// Height of the soles above 0, up.
    fn height(&self) -> f32 {
        -(self.at().y + 30.0)
    }
}

#[test]
fn it_reaches_the_speed_of_the_input_by_its_acceleration_and_keeps_it() {
    for case in cases() {
        let mut stage = Stage::on_ground(case);
        stage.run(RIGHT, 0.1, |_| {});
        near(stage.mover.velocity().x, 150.0, 0.01);
        // The mean of the speeds before and after: v² / 2 a.
        near(stage.at().x, 7.5, 0.01);
        stage.run(RIGHT, 1.0, |stage| assert!(stage.mover.is_grounded()));
        near(stage.at().x, 157.5, 0.01);
    }
}

#[test]
fn up_and_down_slopes_it_is_as_fast_as_on_level_ground_and_stays_on_them() {
    for (degrees, case) in
        [10.0, 25.0, 40.0f32].into_iter().flat_map(|it| cases().map(move |case| (it, case)))
    {
        let mut stage = Stage::new(case, [-60.0, -0.1]);
        stage.slope(degrees);
        stage.run(STILL, 0.2, |_| {});
        stage.run(RIGHT, 1.0, |stage| assert!(stage.mover.is_grounded(), "{degrees} {:?}", stage.at()));
        let start = stage.at();
        stage.run(RIGHT, 1.0, |stage| {
            assert!(stage.mover.is_grounded());
            near(stage.at().y - start.y, (stage.at().x - start.x) * degrees.to_radians().tan(), 0.02);
        });
        near(stage.at().x - start.x, 150.0, 0.05);
        stage.run(LEFT, 0.2, |_| {});
        let start = stage.at();
        stage.run(LEFT, 1.0, |stage| assert!(stage.mover.is_grounded()));
        near(stage.at().x - start.x, -150.0, 0.05);
        near(stage.at().y - start.y, -150.0 * degrees.to_radians().tan(), 0.05);
    }
}

#[test]
fn it_stands_on_slopes_up_to_the_limit_without_sliding() {
    for (degrees, case) in
        [10.0, 30.0, 49.0f32].into_iter().flat_map(|it| cases().map(move |case| (it, case)))
    {
        let mut stage = Stage::new(case, [300.0, 300.0 * degrees.to_radians().tan() - 40.0]);
        stage.slope(degrees);
        stage.run(STILL, 0.6, |_| {});
        let start = stage.at();
        stage.run(STILL, 3.0, |stage| assert!(stage.mover.is_grounded()));
        assert!((stage.at() - start).norm() < 0.001, "{degrees} {:?}", stage.at() - start);
    }
}

#[test]
fn it_slides_down_steeper_slopes_and_does_not_walk_up_them() {
    for case in cases() {
        let mut stage = Stage::new(case.clone(), [100.0, 100.0 * 55f32.to_radians().tan() - 50.0]);
        stage.slope(55.0);
        let report = stage.run(LEFT, 1.0, |_| {});
        assert!(!stage.mover.is_grounded() && report.left.is_some(), "{report:?}");
        assert!(stage.at().x > 130.0 && stage.at().y > 150.0, "{:?}", stage.at());
        // From level ground, a slope of 55 degrees is a wall.
        let mut stage = Stage::on_ground(case);
        let ramp = GeomBuilder::polygon([[100.0, 0.0], [300.0, -286.0], [300.0, 0.0]]);
        stage.simulator.add_body(BodyBuilder::fixed(), [ramp]).unwrap();
        let report = stage.run(RIGHT, 2.0, |stage| assert!(stage.height() < 0.1, "{}", stage.height()));
        assert!(report.right.is_some() && stage.mover.is_grounded());
        near(stage.mover.velocity().x, 0.0, 0.001);
    }
}

#[test]
fn a_jump_has_the_height_of_its_speed_at_any_step() {
    for (height, case) in [20.0, 60.0, 150.0].into_iter().flat_map(|it| cases().map(move |case| (it, case))) {
        let mut stage = Stage::on_ground(case);
        stage.mover.options.jump_height = height;
        let start = stage.height();
        assert!(stage.step(JUMP).jumped && !stage.mover.is_grounded());
        let mut highest = stage.height();
        let mut landing = 0.0;
        for _ in 0..(1.5 / stage.dt) as usize {
            let report = stage.step(JUMP);
            highest = highest.max(stage.height());
            landing += if report.landed { report.landing_speed } else { 0.0 };
            assert!(!report.jumped, "a held key jumps once");
        }
        // The highest step is up to half a step from the top.
        let missed = GRAVITY * stage.dt * stage.dt / 8.0;
        assert!((height - missed - 0.02..=height + 0.02).contains(&(highest - start)), "{height}: {highest}");
        assert!(stage.mover.is_grounded());
        near(landing, (2.0 * GRAVITY * height).sqrt(), GRAVITY * stage.dt);
    }
}

#[test]
fn a_key_that_is_released_cuts_the_jump() {
    for case in cases() {
        let mut stage = Stage::on_ground(case);
        let start = stage.height();
        stage.step(JUMP);
        let mut highest = 0.0f32;
        stage.run(STILL, 1.0, |stage| highest = highest.max(stage.height() - start));
        // Half of the speed after the first step: (v - g dt)² / 4 of 2 g, above the way of that step.
        let (dt, speed) = (stage.dt, (2.0 * GRAVITY * 60.0).sqrt());
        let first = speed * dt - 0.5 * GRAVITY * dt * dt;
        let rest = (speed - GRAVITY * dt).powi(2) / 4.0 / (2.0 * GRAVITY);
        near(highest, first + rest, 0.02 + GRAVITY * dt * dt / 8.0);
    }
}

#[test]
fn the_path_of_a_run_and_a_jump_is_the_same_at_all_rates() {
    for shape in shapes() {
        let paths = RATES.map(|rate| {
            let mut stage = Stage::on_ground((shape.clone(), rate));
            stage.run(RIGHT, 0.5, |_| {});
            let mut path = vec![stage.at()];
            for tenth in 0..12 {
                stage.run(MoverInput { jump: tenth < 10, ..RIGHT }, 0.1, |_| {});
                path.push(stage.at());
            }
            path
        });
        for (one, other) in paths[..2].iter().flat_map(|path| path.iter().zip(&paths[2])) {
            assert!((one - other).norm() < 0.1, "{one} {other}");
        }
    }
}

#[test]
fn it_may_jump_within_the_coyote_time_and_only_once() {
    for case in cases() {
        let mut stage = Stage::new(case, [0.0, -100.1]);
        stage.fixed([200.0, 100.0], [0.0, -50.0]);
        stage.fixed([4000.0, 100.0], [0.0, 450.0]);
        stage.run(STILL, 0.2, |_| {});
        while stage.mover.is_grounded() {
            stage.step(RIGHT);
        }
        let edge = stage.clone();
        for (late, may) in [(0.0, true), (0.05, true), (0.1 - 1.5 * stage.dt, true), (0.1 + stage.dt, false)]
        {
            let mut stage = edge.clone();
            stage.run(RIGHT, late, |_| {});
            assert_eq!(stage.step(MoverInput { jump: true, ..RIGHT }).jumped, may, "{late} {}", stage.dt);
            stage.step(RIGHT);
            assert!(!stage.step(MoverInput { jump: true, ..RIGHT }).jumped);
        }
    }
}

#[test]
fn a_press_before_landing_is_remembered_for_the_buffer_time() {
    for case in cases() {
        let mut stage = Stage::new(case, [0.0, -100.0]);
        stage.fixed([4000.0, 100.0], [0.0, 50.0]);
        // It falls for (2 h / g)^½ = 0.471 s.
        for (early, may) in [(0.05, true), (0.09 - 2.0 * stage.dt, true), (0.11 + stage.dt, false)] {
            let mut stage = stage.clone();
            stage.run(STILL, 0.471 - early, |_| {});
            let mut jumped = stage.step(JUMP).jumped;
            stage.run(STILL, 0.0, |_| {});
            for _ in 0..(0.3 / stage.dt) as usize {
                jumped |= stage.step(STILL).jumped;
            }
            assert_eq!(jumped, may, "{early} {}", stage.dt);
        }
    }
}

#[test]
fn a_low_ceiling_ends_a_jump() {
    for case in cases() {
        let mut stage = Stage::on_ground(case);
        stage.fixed([200.0, 20.0], [0.0, -90.0]);
        let (mut highest, mut hits) = (0.0f32, 0);
        for _ in 0..(0.6 / stage.dt) as usize {
            let report = stage.step(JUMP);
            hits += usize::from(report.ceiling.is_some());
            highest = highest.max(stage.height());
        }
        near(highest, 20.0, 0.1);
        assert!(hits == 1 && stage.mover.is_grounded(), "{hits}");
    }
}

#[test]
fn pressed_against_a_wall_it_falls_as_without_it() {
    for case in cases() {
        let mut stage = Stage::new(case.clone(), [-0.1, -400.0]);
        stage.fixed([100.0, 2000.0], [65.0, 0.0]);
        let mut free = Stage::new(case, [0.0, -400.0]);
        for _ in 0..(0.8 / stage.dt) as usize {
            let report = stage.step(RIGHT);
            free.step(STILL);
            near(stage.height(), free.height(), 0.01);
            assert!(report.right.is_some() || stage.at().x < -0.05);
        }
        near(stage.at().x, 0.0, 0.05);
        near(stage.mover.velocity().x, 0.0, 0.001);
    }
}

#[test]
fn along_a_steep_wall_it_slides_by_gravity_along_the_wall() {
    for case in cases() {
        // A wall of 70 degrees from level, down to the right: the acceleration along it is g sin 70.
        let mut stage = Stage::new(case, [300.0, 300.0 * 70f32.to_radians().tan() - 60.0]);
        stage.slope(70.0);
        stage.mover.options.air_acceleration = 0.0;
        while stage.step(STILL).left.is_none() {}
        let start = stage.mover.velocity();
        stage.run(STILL, 0.5, |_| {});
        let (sine, cosine) = 70f32.to_radians().sin_cos();
        let gained = stage.mover.velocity() - start;
        near(gained.x * cosine + gained.y * sine, GRAVITY * sine * 0.5, 1.0);
        near(gained.x * sine - gained.y * cosine, 0.0, 1.0);
    }
}

#[test]
fn a_launch_takes_it_off_the_ground() {
    for case in cases() {
        let mut stage = Stage::on_ground(case);
        stage.mover.launch([-100.0, -300.0]).unwrap();
        let mut highest = 0.0f32;
        stage.run(MoverInput { x: -100.0, ..STILL }, 0.5, |stage| highest = highest.max(stage.height()));
        near(highest, 50.0, 1.1);
        near(stage.at().x, -50.0, 0.1);
    }
}

#[test]
fn a_state_brings_it_back_to_the_same_bits() {
    let mut stage = Stage::on_ground((shapes()[1].clone(), 60.0));
    stage.kinematic([100.0, 20.0], [150.0, -20.0], [0.0, -20.0]);
    stage.run(RIGHT, 0.7, |_| {});
    let text = serde_json::to_string(&stage.mover.state()).unwrap();
    let mut other = stage.clone();
    other.mover = CharacterMover::new(&shapes()[1], [0.0, 0.0], stage.mover.options).unwrap();
    other.mover.set_state(serde_json::from_str(&text).unwrap()).unwrap();
    for _ in 0..100 {
        assert_eq!(stage.step(RIGHT), other.step(RIGHT));
        assert_eq!(stage.mover.state(), other.mover.state());
    }
}

#[test]
fn invalid_options_inputs_and_shapes_are_refused_without_effect() {
    let refused = |shape: GeomBuilder, options| {
        CharacterMover::new(&shape, [0.0, 0.0], options).unwrap_err().to_string()
    };
    let options = MoverOptions::default();
    let notched = [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [4.0, 3.0], [0.0, 9.0]];
    let error = refused(GeomBuilder::polygon(notched), options);
    assert!(error.contains("3 convex pieces, but must be one convex shape"), "{error}");
    assert!(refused(GeomBuilder::chain([[0.0, 0.0], [9.0, 0.0]]), options).contains("one convex shape"));
    assert!(refused(GeomBuilder::circle(-1.0), options).contains("radius"));
    let circle = GeomBuilder::circle(9.0);
    assert!(refused(circle.clone(), MoverOptions { step_up: -1.0, ..options }).contains("step_up"));
    assert!(refused(circle.clone(), MoverOptions { jump_cut: 1.5, ..options }).contains("jump_cut"));
    assert!(refused(circle.clone(), MoverOptions { max_slope: 1.6, ..options }).contains("max_slope"));
    assert!(CharacterMover::new(&circle, [f32::NAN, 0.0], options).is_err());

    let mut stage = Stage::on_ground((shapes()[1].clone(), 60.0));
    let before = stage.mover.state();
    let Stage { simulator, mover, .. } = &mut stage;
    let mut refused =
        |mover: &mut CharacterMover, input, dt| mover.update(simulator, input, dt).unwrap_err().to_string();
    assert!(refused(mover, MoverInput { x: f32::NAN, ..STILL }, 0.01).contains("input.x"));
    assert!(refused(mover, STILL, 0.0).contains("dt"));
    mover.options.snap = f32::INFINITY;
    assert!(refused(mover, STILL, 0.01).contains("snap"));
    mover.options.snap = 8.0;
    assert!(mover.launch([0.0, f32::NAN]).is_err() && mover.set_position([f32::NAN, 0.0]).is_err());
    let (body, _) = stage.simulator.add_body(BodyBuilder::dynamic(), [GeomBuilder::circle(2.0)]).unwrap();
    stage.mover.set_body(Some(body));
    let error = stage.mover.update(&mut stage.simulator, STILL, 0.01).unwrap_err().to_string();
    assert!(error.contains("kinematic"), "{error}");
    stage.simulator.remove(body).unwrap();
    stage.simulator.update(0.01);
    assert!(stage.mover.update(&mut stage.simulator, STILL, 0.01).is_err());
    assert_eq!(stage.mover.state(), before);
}

#[test]
fn numbers_at_their_limits_are_safe() {
    for case in cases() {
        let mut stage = Stage::on_ground(case);
        stage.fixed([100.0, 100.0], [200.0, -50.0]);
        let options = MoverOptions::default();
        for (number, options) in [
            (f32::MAX, MoverOptions { acceleration: f32::MAX, air_acceleration: f32::MAX, ..options }),
            (-1e30, MoverOptions { step_up: f32::MAX, snap: f32::MAX, jump_height: f32::MAX, ..options }),
            (f32::MIN_POSITIVE, MoverOptions { push_force: f32::MAX, mass: f32::MAX, ..options }),
            (0.0, MoverOptions { gravity_scale: f32::MAX, ..options }),
        ] {
            let mut stage = stage.clone();
            stage.mover.options = options;
            for step in 0..40 {
                let input = MoverInput { x: number, jump: step % 10 < 5, drop: step % 7 == 0 };
                stage.step(input);
                assert!(stage.at().iter().all(|part| part.is_finite()), "{number} {:?}", stage.at());
            }
        }
    }
}
