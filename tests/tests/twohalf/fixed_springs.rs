//! Springs to a point of the world pull along all three axes if that point has a depth.

use conformance::fixtures::depth::{
    DT, assert_near, assert_near3, place, run, simulator, solid, throw, velocity, weightless, with_scheme,
};
use farseer_core::{FixedLinearSpring, SpringFactory, SpringId};
use twohalf::{BodyId, DepthScheme, TwoHalfPhysicsSimulator, Vector2, Vector3};

/// The point of the world that the springs of these tests hang on: 300 px up at Z 20.
const POINT: [f32; 3] = [0.0, 300.0, 20.0];

/// A box of mass 1, so far from the point, on a spring of no length of its own.
fn sprung(
    constant: f32,
    damping: f32,
    apart: [f32; 3],
    depth: Option<f32>,
) -> (TwoHalfPhysicsSimulator, BodyId, SpringId) {
    let mut simulator = weightless();
    let [x, y, z] = apart;
    let body = solid(&mut simulator, [2.0; 3], [POINT[0] + x, POINT[1] + y, POINT[2] + z]);
    // Bodies are where their lowest points are: the middle is 1 px above.
    let point = Vector2::new(POINT[0], -POINT[1] - 1.0);
    let spring = simulator.edit_objects(|objects| {
        let zero = Vector2::zeros();
        let spring =
            SpringFactory::create_fixed_linear_spring(objects, body, zero, point, constant, damping).unwrap();
        let kind = objects.spring_as_mut::<FixedLinearSpring>(spring).unwrap();
        kind.set_rest_length(0.0).unwrap();
        kind.set_world_attach_depth(depth).unwrap();
        objects.add(spring).unwrap();
        spring
    });
    (simulator, body, spring)
}

fn precise(test: impl FnOnce()) {
    with_scheme(DepthScheme::Precise, test);
}

#[test]
fn a_spring_to_a_point_swings_along_any_axis_with_the_period_of_its_constant() {
    precise(|| {
        // 1 Hz: after half a period of 50 steps it is on the other side, after ten full ones at its start.
        let constant = (2.0 * std::f32::consts::PI).powi(2);
        for apart in [[0.0, 0.0, 40.0], [24.0, 0.0, 32.0], [-20.0, 20.0, 10.0]] {
            let (mut simulator, body, _) = sprung(constant, 0.0, apart, Some(POINT[2]));
            let apart = Vector3::from(apart);
            run(&mut simulator, 50);
            assert!((place(&simulator, body) - Vector3::from(POINT) + apart).norm() < 0.02 * apart.norm());
            run(&mut simulator, 950);
            assert!((place(&simulator, body) - Vector3::from(POINT) - apart).norm() < 0.02 * apart.norm());
        }
    });
}

#[test]
fn a_damped_spring_to_a_point_comes_to_rest_there() {
    precise(|| {
        let (mut simulator, body, _) = sprung(40.0, 8.0, [10.0, -20.0, 40.0], Some(POINT[2]));
        run(&mut simulator, 500);
        assert_near3(place(&simulator, body), POINT, 0.05);
    });
}

#[test]
fn a_point_without_a_depth_exerts_no_force_along_z() {
    precise(|| {
        let (mut simulator, body, _) = sprung(40.0, 8.0, [30.0, 0.0, 40.0], None);
        throw(&mut simulator, body, [0.0, 0.0, 10.0]);
        run(&mut simulator, 100);
        assert_eq!(velocity(&simulator, body).z, 10.0);
        assert_near(place(&simulator, body).z, POINT[2] + 40.0 + 10.0 * 100.0 * DT, 1e-3);
    });
}

#[test]
fn a_point_that_moves_along_z_pulls_a_body_at_rest_along() {
    precise(|| {
        let (mut simulator, body, spring) = sprung(40.0, 8.0, [0.0, 0.0, 10.0], Some(POINT[2]));
        run(&mut simulator, 1000);
        simulator.edit_objects(|objects| {
            let kind = objects.spring_as_mut::<FixedLinearSpring>(spring).unwrap();
            kind.set_world_attach_depth(Some(-50.0)).unwrap();
        });
        run(&mut simulator, 500);
        assert_near(place(&simulator, body).z, -50.0, 0.05);
    });
}

#[test]
fn a_depth_that_is_not_finite_is_refused() {
    let (mut simulator, _, spring) = sprung(40.0, 8.0, [0.0; 3], Some(3.0));
    simulator.edit_objects(|objects| {
        let kind = objects.spring_as_mut::<FixedLinearSpring>(spring).unwrap();
        assert!(kind.set_world_attach_depth(Some(f32::NAN)).is_err());
        assert_eq!(kind.world_attach_depth(), Some(3.0));
    });
}

#[test]
fn saved_in_its_swing_it_goes_on_with_the_same_bits() {
    precise(|| {
        let (mut simulator, body, _) = sprung(40.0, 0.5, [10.0, -20.0, 40.0], Some(POINT[2]));
        run(&mut simulator, 33);
        let mut loaded = weightless();
        loaded.restore(&simulator.snapshot()).unwrap();
        run(&mut loaded, 100);
        run(&mut simulator, 100);
        assert_eq!(place(&loaded, body), place(&simulator, body));
    });
}

#[test]
fn a_body_on_a_spring_along_z_sleeps_and_wakes_without_gaining_energy() {
    precise(|| {
        // Pulled forward by the spring, it lies against a wall in the world's front.
        let mut simulator = simulator();
        let wall = solid(&mut simulator, [100.0, 100.0, 20.0], [0.0, 0.0, 0.0]);
        simulator.body_mut(wall).unwrap().set_is_static(true);
        let body = solid(&mut simulator, [20.0; 3], [0.0, 0.0, 20.0]);
        let spring = simulator.edit_objects(|objects| {
            let (zero, point) = (Vector2::zeros(), Vector2::new(0.0, -10.0));
            let spring =
                SpringFactory::create_fixed_linear_spring(objects, body, zero, point, 20.0, 0.0).unwrap();
            let kind = objects.spring_as_mut::<FixedLinearSpring>(spring).unwrap();
            kind.set_world_attach_depth(Some(0.0)).unwrap();
            objects.add(spring).unwrap();
            spring
        });
        run(&mut simulator, 300);
        assert!(simulator.is_asleep(body));
        run(&mut simulator, 1000);
        assert!(simulator.is_asleep(body));
        simulator.edit_objects(|objects| objects.dispose(spring).unwrap());
        simulator.body_mut(body).unwrap().set_linear_velocity_z(1.0);
        run(&mut simulator, 1);
        assert!(velocity(&simulator, body).z.abs() <= 1.0);
    });
}
