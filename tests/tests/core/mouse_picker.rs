//! Taking hold of bodies with the mouse.

use conformance::fixtures::plane::{add_box, add_floor, both_sets, simulator_with, v};
use farseer_core::{
    BodyId, FixedLinearSpring, GeomId, Methods, MousePicker, PhysicsSimulator, SpringFactory,
};

/// A box of 20 units at (50, 50), in the simulation.
fn scene(methods: Methods) -> (PhysicsSimulator, BodyId, GeomId) {
    let mut simulator = simulator_with(0.0, methods);
    let (body, geom) = add_box(&mut simulator, (20.0, 20.0), v(50.0, 50.0));
    simulator.update(0.01);
    (simulator, body, geom)
}

#[test]
fn a_spring_holds_the_body_where_it_was_taken() {
    for methods in both_sets() {
        let (mut simulator, body, geom) = scene(methods);
        simulator[body].set_rotation(0.5);
        let mut mouse = MousePicker::default();
        let point = v(55.0, 48.0);
        assert_eq!(mouse.pick(&mut simulator, point), Ok(Some(geom)));
        let id = mouse.spring().unwrap();
        let spring: &FixedLinearSpring = simulator.spring_as(id).unwrap();
        assert_eq!((spring.body(), spring.world_attach_point()), (body, point));
        assert_eq!(spring.body_attach_point(), simulator[body].get_local_position(point));
        assert_eq!((simulator[id].spring_constant(), simulator[id].damping_constant()), (100.0, 50.0));
        simulator.update(0.01);
        assert_eq!(simulator.spring_list(), [id]);
    }
}

#[test]
fn the_body_follows_the_mouse_until_it_is_released() {
    for methods in both_sets() {
        let (mut simulator, body, _) = scene(methods);
        let mut mouse = MousePicker::default();
        mouse.pick(&mut simulator, v(50.0, 50.0)).unwrap();
        for _ in 0..600 {
            mouse.drag(&mut simulator, v(200.0, 120.0)).unwrap();
            simulator.update(0.01);
        }
        // A damping of 50 where 20 is critical: it approaches with a rate of 2.1 per second, for six seconds.
        assert!(
            (simulator[body].position() - v(200.0, 120.0)).norm() < 1.0,
            "{:?}",
            simulator[body].position()
        );
        mouse.release(&mut simulator);
        assert_eq!(mouse.spring(), None);
        simulator[body].set_linear_velocity(v(10.0, 0.0));
        simulator.update(0.01);
        simulator.update(0.01);
        assert!(simulator.spring_list().is_empty());
        // Only linear drag of 0.001 acts on it now.
        approx::assert_relative_eq!(simulator[body].linear_velocity().x, 10.0, max_relative = 1e-4);
    }
}

#[test]
fn empty_space_is_not_picked() {
    for methods in both_sets() {
        let (mut simulator, ..) = scene(methods);
        let mut mouse = MousePicker::default();
        assert_eq!(mouse.pick(&mut simulator, v(0.0, 0.0)), Ok(None));
        assert_eq!(mouse.spring(), None);
        mouse.drag(&mut simulator, v(9.0, 9.0)).unwrap();
        mouse.release(&mut simulator);
        simulator.update(0.01);
        assert!(simulator.spring_list().is_empty());
    }
}

#[test]
fn picking_again_releases_the_held_body() {
    for methods in both_sets() {
        let (mut simulator, ..) = scene(methods);
        let mut mouse = MousePicker::default();
        mouse.pick(&mut simulator, v(50.0, 50.0)).unwrap();
        mouse.pick(&mut simulator, v(51.0, 50.0)).unwrap();
        simulator.update(0.01);
        assert_eq!(simulator.spring_list(), [mouse.spring().unwrap()]);
    }
}

#[test]
fn a_static_body_is_held_but_stays() {
    for methods in both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let (body, geom) = add_floor(&mut simulator, (20.0, 20.0), v(0.0, 0.0));
        simulator.update(0.01);
        let mut mouse = MousePicker::default();
        assert_eq!(mouse.pick(&mut simulator, v(1.0, 1.0)), Ok(Some(geom)));
        mouse.drag(&mut simulator, v(100.0, 1.0)).unwrap();
        for _ in 0..10 {
            simulator.update(0.01);
        }
        assert_eq!(simulator[body].position(), v(0.0, 0.0));
    }
}

#[test]
fn a_removed_body_is_released() {
    for methods in both_sets() {
        let (mut simulator, body, _) = scene(methods);
        let mut mouse = MousePicker::default();
        mouse.pick(&mut simulator, v(50.0, 50.0)).unwrap();
        simulator.update(0.01);
        simulator.dispose(body).unwrap();
        simulator.update(0.01);
        simulator.update(0.01);
        mouse.drag(&mut simulator, v(60.0, 60.0)).unwrap();
        assert_eq!((mouse.spring(), mouse.line(&simulator)), (None, None));
        mouse.release(&mut simulator);
    }
}

#[test]
fn the_line_runs_from_the_body_to_the_mouse() {
    for methods in both_sets() {
        let (mut simulator, ..) = scene(methods);
        let mut mouse = MousePicker::default();
        assert_eq!(mouse.line(&simulator), None);
        mouse.pick(&mut simulator, v(52.0, 50.0)).unwrap();
        mouse.drag(&mut simulator, v(80.0, 90.0)).unwrap();
        assert_eq!(mouse.line(&simulator), Some((v(52.0, 50.0), v(80.0, 90.0))));
    }
}

#[test]
fn a_picker_saved_with_the_simulator_releases_after_loading() {
    for methods in both_sets() {
        let (mut simulator, ..) = scene(methods);
        let mut mouse = MousePicker::default();
        mouse.pick(&mut simulator, v(50.0, 50.0)).unwrap();
        simulator.update(0.01);
        let saved = (simulator.snapshot(), serde_json::to_string(&mouse).unwrap());
        drop((simulator, mouse));

        let mut simulator = PhysicsSimulator::default();
        simulator.restore(&saved.0).unwrap();
        let mut mouse: MousePicker = serde_json::from_str(&saved.1).unwrap();
        mouse.drag(&mut simulator, v(80.0, 50.0)).unwrap();
        assert_eq!(mouse.line(&simulator).unwrap().1, v(80.0, 50.0));
        assert_eq!(simulator.spring_list().len(), 1);
        mouse.release(&mut simulator);
        simulator.update(0.01);
        assert!(simulator.spring_list().is_empty());
    }
}

/// Restores a snapshot from before the pick; then the game's own spring on another body gets the picker's id.
fn scene_with_a_spring_in_place_of_the_pickers() -> (PhysicsSimulator, MousePicker) {
    let (mut simulator, ..) = scene(Methods::default());
    let (other, _) = add_box(&mut simulator, (20.0, 20.0), v(-50.0, -50.0));
    simulator.update(0.01);
    let snapshot = simulator.snapshot();
    let mut mouse = MousePicker::default();
    mouse.pick(&mut simulator, v(50.0, 50.0)).unwrap();
    simulator.update(0.01);
    simulator.restore(&snapshot).unwrap();
    let (at, far) = (v(0.0, 0.0), v(-70.0, -70.0));
    let own = SpringFactory::create_fixed_linear_spring_in(&mut simulator, other, at, far, 1.0, 1.0).unwrap();
    simulator.update(0.01);
    assert_eq!(mouse.spring(), Some(own));
    (simulator, mouse)
}

#[test]
fn a_spring_of_the_game_is_not_dragged() {
    let (mut simulator, mut mouse) = scene_with_a_spring_in_place_of_the_pickers();
    let before = simulator.snapshot();
    assert_eq!(mouse.line(&simulator), None);
    mouse.drag(&mut simulator, v(9.0, 9.0)).unwrap();
    assert!(mouse.spring().is_none() && simulator.snapshot() == before);
}

#[test]
fn a_spring_of_the_game_is_not_released() {
    let (mut simulator, mut mouse) = scene_with_a_spring_in_place_of_the_pickers();
    let before = simulator.snapshot();
    mouse.release(&mut simulator);
    assert!(mouse.spring().is_none() && simulator.snapshot() == before);
}

#[test]
fn forgetting_the_body_leaves_the_simulator_unchanged() {
    for methods in both_sets() {
        let (mut simulator, ..) = scene(methods);
        let mut mouse = MousePicker::default();
        mouse.pick(&mut simulator, v(50.0, 50.0)).unwrap();
        let before = simulator.snapshot();
        mouse.forget();
        mouse.drag(&mut simulator, v(9.0, 9.0)).unwrap();
        mouse.release(&mut simulator);
        assert!(mouse.spring().is_none() && simulator.snapshot() == before);
    }
}

#[test]
fn a_saved_picker_without_finite_constants_is_refused() {
    let saved = serde_json::to_string(&MousePicker::default()).unwrap();
    assert!(serde_json::from_str::<MousePicker>(&saved).is_ok());
    for constant in ["50.0", "100.0"] {
        let damaged = saved.replace(constant, "1e300");
        assert_ne!(damaged, saved);
        assert!(serde_json::from_str::<MousePicker>(&damaged).is_err(), "{damaged}");
    }
}

#[test]
fn a_non_finite_mouse_position_is_refused() {
    for methods in both_sets() {
        let (mut simulator, ..) = scene(methods);
        let mut mouse = MousePicker::default();
        mouse.pick(&mut simulator, v(50.0, 50.0)).unwrap();
        let before = (mouse.clone(), mouse.line(&simulator));
        assert!(mouse.pick(&mut simulator, v(f32::NAN, 0.0)).is_err());
        assert!(mouse.drag(&mut simulator, v(0.0, f32::INFINITY)).is_err());
        assert_eq!((mouse.clone(), mouse.line(&simulator)), before);
        assert!(MousePicker::new(f32::NAN, 1.0).is_err() && MousePicker::new(1.0, f32::INFINITY).is_err());
    }
}
