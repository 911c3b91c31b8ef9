//! Tests that joints and queries of the arena mean the same in every engine.

use measure::arena::*;

const UNBOUNDED: Limits = Limits { bounds: None, speed: 1e3, overlap: 1.0, gap: 0.01 };

fn block(position: Point, angle: f32) -> Body {
    Body { angle, ..Body::dynamic(position, vec![Shape::rectangle([0.5, 0.25], [0.0; 2])]) }
}

/// Returns a scene in which a static post at the origin and a block at (2, 1) m, turned by 0.3 rad, are joined.
fn joined(kind: JointKind, edit: impl FnOnce(&mut Joint)) -> Scene {
    let bodies = vec![Body::immovable(Kind::Static, [0.0; 2], Vec::new()), block([2.0, 1.0], 0.3)];
    let mut joint = Joint::between(kind, [0, 1], [&bodies[0], &bodies[1]], [1.0, 0.5]);
    edit(&mut joint);
    Scene { gravity: [0.0, -10.0], bodies, joints: vec![joint], limits: UNBOUNDED, ..Scene::default() }
}

/// Returns the state of the block and the verdict in an engine after some steps.
fn after(scene: &Scene, engine: EngineEntry, steps: usize) -> (State, Verdict) {
    let mut play = Play::new(scene, engine).expect("the engine takes the scene");
    for _ in 0..steps {
        play.step().expect("the engine makes the step");
    }
    (play.engine().state(1), judge(&mut play))
}

fn assert_near(value: f32, expected: f32, tolerance: f32, what: &str) {
    assert!((value - expected).abs() <= tolerance, "{what}: {value} is not {expected}");
}

#[test]
fn joints_of_every_kind_hold() {
    let axis = [0.6, 0.8];
    let kinds = [
        JointKind::Hinge,
        JointKind::Weld,
        JointKind::Slider { axis },
        JointKind::Rod,
        JointKind::Rope { length: 2.5 },
    ];
    for engine in engines() {
        for kind in kinds {
            let scene = joined(kind, |joint| {
                joint.limits = matches!(kind, JointKind::Slider { .. }).then_some([-1.0, 1.0]);
            });
            let (state, verdict) = after(&scene, engine, 60);
            assert!(verdict.gap < 0.02, "{} {kind:?}: gap {}", engine.name, verdict.gap);
            let keeps_angle = matches!(kind, JointKind::Weld | JointKind::Slider { .. });
            if keeps_angle {
                assert_near(state.angle, 0.3, 0.02, engine.name);
            }
        }
    }
}

#[test]
fn a_slider_comes_to_its_limits_by_gravity_and_by_its_motor() {
    let axis = [0.6, 0.8];
    for engine in engines() {
        for (motor, travel) in [(None, -0.5), (Some([3.0, 20.0]), 1.0)] {
            let scene = joined(JointKind::Slider { axis }, |joint| {
                (joint.limits, joint.motor) = (Some([-0.5, 1.0]), motor);
            });
            let (state, _) = after(&scene, engine, 120);
            let expected = [2.0 + travel * axis[0], 1.0 + travel * axis[1]];
            assert_near(state.position[0], expected[0], 0.03, engine.name);
            assert_near(state.position[1], expected[1], 0.03, engine.name);
        }
    }
}

#[test]
fn a_hinge_comes_to_its_limits_by_gravity_and_by_its_motor() {
    for engine in engines() {
        for (motor, turn) in [(None, -0.4), (Some([3.0, 20.0]), 0.9)] {
            let scene = joined(JointKind::Hinge, |joint| {
                (joint.limits, joint.motor) = (Some([-0.4, 0.9]), motor);
            });
            let (state, _) = after(&scene, engine, 120);
            assert_near(state.angle, 0.3 + turn, 0.05, engine.name);
        }
    }
}

#[test]
fn a_spring_oscillates_with_its_frequency() {
    let mut scene = joined(JointKind::Spring, |joint| joint.spring = Some([1.0, 0.0]));
    scene.gravity = [0.0; 2];
    // Away from the post, along the spring.
    scene.bodies[1].velocity = [2.0 * 0.894_427, 0.894_427];
    for engine in engines() {
        let distance = |steps| {
            let [x, y] = after(&scene, engine, steps).0.position;
            x.hypot(y) - 5.0_f32.sqrt()
        };
        // After a quarter of the period the spring is longest: 2 m/s divided by 2 pi Hz.
        assert_near(distance(15), 2.0 / std::f32::consts::TAU, 0.05, engine.name);
        assert_near(distance(30), 0.0, 0.06, engine.name);
        assert_near(distance(45), -2.0 / std::f32::consts::TAU, 0.05, engine.name);
    }
}

#[test]
fn queries_find_the_same_in_every_engine() {
    let scene = Scene { bodies: vec![block([10.0, 0.0], 0.0), block([20.0, 0.0], 0.0)], ..Scene::default() };
    for engine in engines() {
        let mut play = Play::new(&scene, engine).expect("the engine takes the scene");
        play.step().expect("the engine makes the step");
        let mut ray = |from, to| play.engine().cast_ray(from, to).expect("a ray");
        assert_near(ray([0.0, 0.1], [19.0, 0.1]).expect("a hit"), 0.5, 1e-5, engine.name);
        assert_eq!(ray([0.0, 3.0], [19.0, 3.0]), None, "{}", engine.name);
        let mut count = |low, high| play.engine().count_in_box(low, high).expect("a box");
        assert_eq!(count([9.0, -1.0], [11.0, 1.0]), 1, "{}", engine.name);
        assert_eq!(count([9.0, -1.0], [21.0, 1.0]), 2, "{}", engine.name);
        assert_eq!(count([12.0, -1.0], [18.0, 1.0]), 0, "{}", engine.name);
    }
}

#[test]
fn forms_away_from_the_centre_of_mass_lie_where_the_judge_sees_them() {
    let capsule = Form::Capsule { ends: [[1.0, 0.5], [2.0, 1.5]], radius: 0.25 };
    let triangle = Form::hull(&[[-1.0, 0.0], [0.0, -0.5], [0.5, 0.5]], 0.0);
    let square = Form::Box { half: [0.5, 0.25], centre: [-0.5, 1.5] };
    let disc = Form::Circle { centre: [1.5, -0.5], radius: 0.4 };
    let body = |forms: [&Form; 2], x: f32| {
        Body::dynamic([x, 4.0], forms.map(|form| Shape::new(form.clone())).to_vec())
    };
    let floor = Body::immovable(Kind::Static, [0.0; 2], vec![Shape::rectangle([20.0, 1.0], [0.0, -1.0])]);
    let pairs = [[&capsule, &square], [&capsule, &disc], [&triangle, &disc], [&triangle, &capsule]];
    let bodies = pairs.into_iter().zip([-9.0, -3.0, 3.0, 9.0]).map(|(forms, x)| body(forms, x));
    let bodies = std::iter::once(floor).chain(bodies).collect();
    let scene = Scene { gravity: [0.0, -10.0], bodies, limits: UNBOUNDED, ..Scene::default() };
    for engine in engines() {
        let (_, verdict) = after(&scene, engine, 300);
        assert!(verdict.contacts >= 4 && verdict.deepest < 0.015, "{}: {verdict:?}", engine.name);
    }
}

#[test]
fn bodies_come_and_go_in_every_engine() {
    for engine in engines() {
        let scene = joined(JointKind::Hinge, |_| {});
        let mut play = Play::new(&scene, engine).expect("the engine takes the scene");
        play.change(&Action::AddBody(block([9.0, 9.0], 0.0))).expect("a body comes");
        assert_eq!(play.dynamic_bodies().collect::<Vec<_>>(), [1, 2]);
        play.clear().expect("all go");
        assert_eq!(play.dynamic_bodies().count(), 0);
    }
}
