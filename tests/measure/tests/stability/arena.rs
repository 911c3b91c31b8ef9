//! Tests the scenes of Box2D's benchmark: their numbers of bodies, the judge of final states, and sound final states in every
//! engine. With the feature `peers`, Box2D is one of the engines.

use measure::arena::*;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

/// An engine in which all bodies keep their initial states, one [`State`] per body.
#[derive(Default)]
pub(super) struct Still(Rc<RefCell<Vec<State>>>);

impl Engine for Still {
    fn add_body(&mut self, body: &Body) -> Result<()> {
        let Body { position, angle, velocity, spin, .. } = *body;
        self.0.borrow_mut().push(State { position, angle, velocity, spin });
        Ok(())
    }

    fn add_joint(&mut self, _: &Joint, _: [&Body; 2]) -> Result<()> {
        Ok(())
    }

    fn remove_body(&mut self, _: usize) -> Result<()> {
        Ok(())
    }

    fn remove_joint(&mut self, _: usize) -> Result<()> {
        Ok(())
    }

    fn move_to(&mut self, _: usize, _: Point) -> Result<()> {
        Ok(())
    }

    fn step(&mut self) -> Result<()> {
        Ok(())
    }

    fn state(&mut self, index: usize) -> State {
        self.0.borrow()[index]
    }

    fn cast_ray(&mut self, _: Point, _: Point) -> Result<Option<f32>> {
        Ok(None)
    }

    fn count_in_box(&mut self, _: Point, _: Point) -> Result<usize> {
        Ok(0)
    }

    fn counters(&mut self) -> Result<Counters> {
        Ok(Counters::default())
    }
}

fn scene(name: &str, size: f32) -> Scene {
    let entry = scenes().into_iter().find(|entry| entry.name == name).expect("it is in the list");
    (entry.build)(size)
}

fn make_steps(play: &mut Play<'_>, steps: usize) {
    for _ in 0..steps {
        play.step().expect("the engine takes all of the script");
    }
}

/// Returns the number of dynamic bodies of a scene after `steps` steps.
fn bodies_after(scene: &Scene, steps: usize) -> usize {
    let mut play = Play::within(scene, Box::new(Still::default())).expect("it refuses nothing");
    make_steps(&mut play, steps);
    play.dynamic_bodies().count()
}

#[test]
fn release_sizes_have_the_number_of_bodies_of_their_closed_forms() {
    let expected = BTreeMap::from([
        ("large_pyramid", 100 * 101 / 2),
        ("many_pyramids", 20 * 20 * 55),
        ("junkyard", 200 * 40),
        // The drum is one dynamic body more; in the next lines it is the ram and the blade.
        ("tumbler", 45 * 45 + 1),
        ("smash", 120 * 80 + 1),
        ("spinner", 2 * 3038 + 1),
        ("washer", 90 * 90),
        // Seven discs of the grid are static.
        ("joint_grid", 100 * 100 - 7),
        ("compounds", 20 * 150),
        // The scene has 40 columns of five floors with five ragdolls of eleven bones.
        ("rain", 40 * 25 * 11),
    ]);
    for entry in scenes() {
        assert_eq!(bodies_after(&(entry.build)(1.0), 330), expected[entry.name], "{}", entry.name);
    }
    assert_eq!(expected.len(), scenes().len());
}

#[test]
fn a_quarter_of_the_size_has_about_a_quarter_of_the_bodies() {
    for entry in scenes() {
        let [whole, quarter] = [1.0, 0.25].map(|size| bodies_after(&(entry.build)(size), 330) as f32);
        // Bodies along each of two sides are rounded: half of 45 becomes 23, which is 2 % more.
        assert!((quarter / whole - 0.25).abs() < 0.02, "{}: {quarter} of {whole}", entry.name);
    }
}

#[test]
fn ragdolls_are_removed_after_320_steps() {
    let scene = scene("rain", 1.0 / 20.0);
    // The scene has two columns. The first group is added at step 0, and removed when the third group is added.
    assert_eq!([1, 160, 161, 320, 321].map(|steps| bodies_after(&scene, steps)), [275, 275, 550, 550, 550]);
    let mut play = Play::within(&scene, Box::new(Still::default())).expect("it refuses nothing");
    make_steps(&mut play, 321);
    assert_eq!(play.dynamic_bodies().next(), Some(1 + 275));
}

fn limits() -> Limits {
    Limits { bounds: Some([[-10.0; 2], [10.0; 2]]), speed: 5.0, overlap: 0.01, gap: 0.01 }
}

fn judged(
    bodies: Vec<Body>,
    joints: Vec<Joint>,
    limits: Limits,
    mut edit: impl FnMut(&mut [State]),
) -> Verdict {
    let scene = Scene { bodies, joints, limits, ..Scene::default() };
    let states = Rc::default();
    let mut play = Play::within(&scene, Box::new(Still(Rc::clone(&states)))).expect("it refuses nothing");
    edit(&mut states.borrow_mut());
    judge(&mut play)
}

fn unit_box(x: f32) -> Body {
    Body::dynamic([x, 0.0], vec![Shape::rectangle([0.5; 2], [0.0; 2])])
}

#[test]
fn the_judge_measures_overlaps_of_all_forms() {
    let capsule = Form::Capsule { ends: [[0.0, -0.5], [0.0, 0.5]], radius: 0.25 };
    let rounded = Form::hull(&[[-0.25, -0.5], [0.25, -0.5], [0.25, 0.5], [-0.25, 0.5]], 0.25);
    let circle = Form::Circle { centre: [0.0; 2], radius: 0.5 };
    let forms = [(capsule, 0.25), (rounded, 0.5), (circle, 0.5)];
    for (form, half) in forms {
        // Each form overlaps the box to its left by 0.1 m.
        let other = Body::dynamic([0.5 + half - 0.1, 0.0], vec![Shape::new(form.clone())]);
        let verdict = judged(vec![unit_box(0.0), other], Vec::new(), limits(), |_| {});
        assert!((verdict.deepest - 0.1).abs() < 1e-6, "{form:?}: {}", verdict.deepest);
        assert!(!verdict.is_sound(&limits()));
    }
}

#[test]
fn the_judge_counts_boxes_that_touch_and_not_those_apart() {
    let bodies = [0.0, 1.0, 2.1].map(unit_box).to_vec();
    let verdict = judged(bodies, Vec::new(), limits(), |_| {});
    assert_eq!((verdict.contacts, verdict.deepest, verdict.is_sound(&limits())), (1, 0.0, true));
}

#[test]
fn the_judge_detects_gaps_escapes_speeds_and_non_finite_states() {
    let joint = || vec![Joint::new([0, 1], [1.0, 0.5])];
    let bodies = || [0.0, 2.0].map(unit_box).to_vec();
    let verdict = |edit: &dyn Fn(&mut [State])| judged(bodies(), joint(), limits(), edit);
    assert!(verdict(&|_| {}).is_sound(&limits()));
    // The rotation by a right angle moves the anchor of the second body by the square root of 2 times the distance from the
    // centre.
    let turned = verdict(&|states| states[1].angle = std::f32::consts::FRAC_PI_2);
    assert!((turned.gap - (1.0_f64 + 0.25).sqrt() * 2.0_f64.sqrt()).abs() < 1e-6, "{}", turned.gap);
    let escaped = verdict(&|states| states[1].position = [11.0, 0.0]);
    assert_eq!((escaped.escaped, escaped.is_sound(&limits())), (1, false));
    let fast = verdict(&|states| states[1].velocity = [3.0, 4.5]);
    assert!(!fast.is_sound(&limits()) && (fast.energy - 0.5 * 29.25).abs() < 1e-6, "{}", fast.energy);
    let nothing = verdict(&|states| states[1].spin = f32::NAN);
    assert_eq!((nothing.not_finite, nothing.bodies, nothing.is_sound(&limits())), (1, 2, false));
}

#[test]
fn a_body_has_the_mass_centre_and_inertia_of_its_shapes() {
    let near = |a: f32, b: f32| assert!((a - b).abs() < 1e-6, "{a} is not {b}");
    let two = [[0.5, 1.0], [3.5, 1.0]].map(|at| Shape::rectangle([0.5; 2], at).with_density(2.0));
    let pair = Body::dynamic([10.0, 0.0], two.to_vec());
    // Two squares of 2 kg are 1.5 m from their common centre: the moment of inertia is 2 (2 / 6 + 2 * 1.5 * 1.5).
    near(pair.mass, 4.0);
    near(pair.inertia, 4.0 / 6.0 + 9.0);
    assert_eq!(pair.position, [12.0, 1.0]);
    // A capsule whose ends coincide is a disc.
    let of = |form| Body::dynamic([0.0; 2], vec![Shape::new(form)]);
    let capsule = of(Form::Capsule { ends: [[1.0, 1.0], [1.0, 1.0]], radius: 0.5 });
    let disc = of(Form::Circle { centre: [1.0, 1.0], radius: 0.5 });
    near(capsule.mass, disc.mass);
    near(capsule.inertia, disc.inertia);
}

#[test]
fn growth_is_the_exponent_of_time_over_bodies() {
    let cube = run::Effort { turns: 1, budget: 60.0 };
    let entry = SceneEntry { name: "boxes", about: "", build: |_| scene("large_pyramid", 1e-4) };
    let one = run::run(&entry, 1.0, &engines()[..1], cube).expect("it refuses nothing").remove(0);
    let runs = [1.0, 2.0, 4.0].map(|size: f32| run::RunFigures {
        size,
        bodies: size as usize,
        mean_us: f64::from(size).powf(1.5),
        ..one.clone()
    });
    let exponents: Vec<f64> = run::growth(&runs).iter().map(|growth| growth.exponent).collect();
    assert_eq!(exponents, [1.5, 1.5]);
}

/// Plays `steps` steps of a scene in an engine. Returns the final state of each dynamic body, and the verdict.
fn played(scene: &Scene, engine: EngineEntry, steps: usize) -> (Vec<State>, Verdict) {
    let mut play = Play::new(scene, engine).expect("the engine takes the scene");
    make_steps(&mut play, steps);
    let indices: Vec<usize> = play.dynamic_bodies().collect();
    let states = indices.into_iter().map(|index| play.engine().state(index)).collect();
    (states, judge(&mut play))
}

/// Returns the angle of a body after half a second, in radians.
fn angle_after_half_a_second(scene: &Scene, engine: EngineEntry, body: usize) -> f32 {
    let mut play = Play::new(scene, engine).expect("the engine takes the scene");
    make_steps(&mut play, 30);
    play.engine().state(body).angle
}

#[test]
fn drums_and_blades_turn_anticlockwise_at_their_speeds() {
    for engine in engines() {
        // Each entry has the name of the scene, the index of the body that rotates, and its speed in radians/s: 25 degrees/s or
        // 5.
        for (name, body, speed) in [("tumbler", 1, 0.436_332), ("washer", 0, 0.436_332), ("spinner", 1, 5.0)]
        {
            let angle = angle_after_half_a_second(&scene(name, 1.0 / 16.0), engine, body);
            // A motor takes a step or two to reach its speed.
            assert!((angle - speed / 2.0).abs() < speed / 20.0, "{name} in {}: {angle} rad", engine.name);
        }
    }
}

#[test]
fn joints_of_falling_ragdolls_move_into_their_limits_and_towards_their_reference_angles() {
    let scene = scene("rain", 1.0 / 40.0);
    for engine in engines() {
        // The first ragdoll begins with body 1. Bodies 4 and 5 are an upper and a lower leg, 8 and 9 an upper and a lower arm.
        let angle = |body: usize| angle_after_half_a_second(&scene, engine, body);
        let (knee, elbow) = (angle(5) - angle(4), angle(9) - angle(8));
        let limits = [-0.5, -0.02].map(|limit| limit * std::f32::consts::PI);
        assert!((limits[0] - 0.02..limits[1] + 0.02).contains(&knee), "{}: knee at {knee}", engine.name);
        let reference = std::f32::consts::FRAC_PI_4;
        assert!((elbow - reference).abs() < 0.1, "{}: elbow at {elbow}", engine.name);
    }
}

/// Makes a test for each scene, at a fraction of its release size. Asserts that its state after some steps is sound in every
/// engine, and that a second run has the same bits.
macro_rules! sound_and_deterministic {
    ($($name:ident: 1 / $part:literal, $steps:literal;)*) => {$(
        #[test]
        fn $name() {
            let scene = scene(stringify!($name), 1.0 / $part as f32);
            for engine in engines() {
                let (states, verdict) = played(&scene, engine, $steps);
                let is_sound = verdict.bodies >= 20 && verdict.is_sound(&scene.limits);
                assert!(is_sound, "{}: {verdict:?}, {:?}", engine.name, scene.limits);
                let bits = |state: &State| {
                    let State { position: [x, y], angle, velocity: [u, v], spin } = *state;
                    [x, y, angle, u, v, spin].map(f32::to_bits)
                };
                let (again, _) = played(&scene, engine, $steps);
                assert!(states.iter().map(bits).eq(again.iter().map(bits)), "{}: runs differ", engine.name);
            }
        }
    )*};
}

mod comes_to_a_sound_state_twice_the_same {
    use super::*;

    // After these steps all bodies have landed; in `compounds` the first ones have. In `rain` the first ragdolls are removed.
    sound_and_deterministic! {
        large_pyramid: 1 / 100, 120;
        many_pyramids: 1 / 100, 120;
        junkyard: 1 / 25, 240;
        tumbler: 1 / 64, 300;
        rain: 1 / 40, 340;
        washer: 1 / 64, 300;
        joint_grid: 1 / 400, 300;
        smash: 1 / 64, 120;
        compounds: 1 / 100, 110;
        spinner: 1 / 64, 300;
    }
}
