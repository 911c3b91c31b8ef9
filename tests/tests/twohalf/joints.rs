//! Joints with a common point keep it in depth: bodies joined by them move along Z as one. Linear springs act along all axes.

use conformance::fixtures::depth::{
    DT, assert_goes_on_after_loading, assert_near, assert_near3, momentum, place, run, set_surface,
    simulator, solid, throw, velocity, weightless, with_scheme,
};
use farseer_core::{
    BodyFactory, Error, GeomFactory, GeomPlacement, JointFactory, JointId, LinearSpring, Objects,
    SpringFactory,
};
use twohalf::{BodyId, DepthScheme, TwoHalfPhysicsSimulator, Vector2, Vector3};

/// Rounding of coordinates up to 1000 px, over hundreds of steps.
const ROUNDING: f32 = 2e-3;

fn precise(test: impl FnOnce()) {
    with_scheme(DepthScheme::Precise, test);
}

type Make = fn(&mut Objects, BodyId, BodyId, Vector2) -> Result<JointId, Error>;

/// The joints that keep a point.
const KEEPING: [Make; 2] = [
    |objects, a, b, at| JointFactory::create_revolute_joint(objects, a, b, at),
    |objects, a, b, at| JointFactory::create_weld_joint(objects, a, b, at),
];

fn tie(simulator: &mut TwoHalfPhysicsSimulator, make: Make, a: BodyId, b: BodyId, at: [f32; 2]) -> JointId {
    simulator.edit_objects(|objects| {
        let joint = make(objects, a, b, at.into()).unwrap();
        objects.add(joint).unwrap();
        joint
    })
}

/// Two boxes of 20 px beside each other, 100 px up, of masses 1 and 3, joined where they touch.
fn pair(
    mut simulator: TwoHalfPhysicsSimulator,
    make: Make,
) -> (TwoHalfPhysicsSimulator, [BodyId; 2], JointId) {
    let bodies = [-12.0, 12.0].map(|x| solid(&mut simulator, [20.0; 3], [x, 100.0, 0.0]));
    simulator.body_mut(bodies[1]).unwrap().set_mass(3.0).unwrap();
    let joint = tie(&mut simulator, make, bodies[0], bodies[1], [0.0, -110.0]);
    (simulator, bodies, joint)
}

#[test]
fn joined_bodies_share_momentum_along_z_by_their_masses() {
    precise(|| {
        for make in KEEPING {
            let (mut simulator, [light, heavy], _) = pair(weightless(), make);
            throw(&mut simulator, light, [0.0, 0.0, 80.0]);
            run(&mut simulator, 100);
            for body in [light, heavy] {
                assert_near(velocity(&simulator, body).z, 20.0, ROUNDING);
                assert_near(place(&simulator, body).z, 20.0 * 100.0 * DT, ROUNDING);
            }
        }
    });
}

#[test]
fn joined_bodies_keep_their_distance_along_z() {
    precise(|| {
        for make in KEEPING {
            let mut simulator = weightless();
            let near = solid(&mut simulator, [20.0; 3], [0.0, 100.0, 10.0]);
            let far = solid(&mut simulator, [20.0; 3], [30.0, 100.0, 45.0]);
            tie(&mut simulator, make, near, far, [15.0, -110.0]);
            throw(&mut simulator, far, [0.0, 0.0, -60.0]);
            run(&mut simulator, 300);
            assert_near(place(&simulator, far).z - place(&simulator, near).z, 35.0, ROUNDING);
            assert_near(place(&simulator, near).z, 10.0 - 30.0 * 300.0 * DT, ROUNDING);
        }
    });
}

#[test]
fn a_body_joined_to_the_world_keeps_its_z_and_swings_as_in_the_plane() {
    precise(|| {
        let swing = |along_z: f32| {
            let mut simulator = simulator();
            let body = solid(&mut simulator, [20.0; 3], [60.0, 300.0, 25.0]);
            simulator.edit_objects(|objects| {
                let anchor = Vector2::new(0.0, -310.0);
                let joint = JointFactory::create_fixed_revolute_joint(objects, body, anchor).unwrap();
                objects.add(joint).unwrap();
            });
            throw(&mut simulator, body, [0.0, 0.0, along_z]);
            run(&mut simulator, 200);
            (simulator.core().body(body).unwrap().position(), place(&simulator, body).z)
        };
        assert_eq!(swing(50.0), swing(0.0));
        let (middle, z) = swing(50.0);
        assert_eq!(z, 25.0);
        assert_near((middle - Vector2::new(0.0, -310.0)).norm(), 60.0, ROUNDING);
    });
}

#[test]
fn a_body_joined_to_a_kinematic_body_follows_it_along_z() {
    precise(|| {
        let mut simulator = simulator();
        let crane = solid(&mut simulator, [20.0; 3], [0.0, 300.0, 0.0]);
        simulator.body_mut(crane).unwrap().set_is_kinematic(true);
        let load = solid(&mut simulator, [20.0; 3], [0.0, 240.0, 5.0]);
        tie(&mut simulator, KEEPING[0], crane, load, [0.0, -310.0]);
        simulator.body_mut(crane).unwrap().set_velocity3d(Vector3::new(0.0, 0.0, 30.0));
        run(&mut simulator, 200);
        assert_near(place(&simulator, load).z - place(&simulator, crane).z, 5.0, ROUNDING);
        assert_near(place(&simulator, crane).z, 60.0, ROUNDING);
    });
}

/// A chain of ten links of 20 px on the ground, along X.
fn chain(simulator: &mut TwoHalfPhysicsSimulator) -> Vec<BodyId> {
    let links: Vec<BodyId> =
        (0..10).map(|at| solid(simulator, [20.0; 3], [at as f32 * 24.0, 0.0, 0.0])).collect();
    links.iter().for_each(|&link| set_surface(simulator, link, 0.5, 0.0));
    for (at, two) in links.windows(2).enumerate() {
        tie(simulator, KEEPING[0], two[0], two[1], [at as f32 * 24.0 + 12.0, -10.0]);
    }
    links
}

#[test]
fn a_chain_on_the_ground_is_thrown_along_z_as_one_and_comes_to_rest_by_friction() {
    precise(|| {
        let mut simulator = simulator();
        let links = chain(&mut simulator);
        run(&mut simulator, 20);
        throw(&mut simulator, links[9], [0.0, 0.0, 500.0]);
        // All have a tenth of that, 50 px/s, and slide for 1 s and 25 px with 0.5 g = 50 px/s²; a step more or less.
        run(&mut simulator, 200);
        for &link in &links {
            assert_near3(velocity(&simulator, link), [0.0; 3], ROUNDING);
            assert_near(place(&simulator, link).z, 25.0, 50.0 * DT);
            assert_near(place(&simulator, link).z, place(&simulator, links[0]).z, ROUNDING);
        }
    });
}

#[test]
fn an_obstacle_along_z_stops_all_joined_bodies() {
    precise(|| {
        let mut simulator = simulator();
        let links = chain(&mut simulator);
        let wall = solid(&mut simulator, [30.0, 100.0, 20.0], [0.0, 0.0, 60.0]);
        simulator.body_mut(wall).unwrap().set_is_static(true);
        run(&mut simulator, 20);
        for &link in &links {
            throw(&mut simulator, link, [0.0, 0.0, 150.0]);
        }
        run(&mut simulator, 200);
        // The first one is 20 px deep, and so is the wall: they touch where it has come to 40.
        for &link in &links {
            assert_near(place(&simulator, link).z, 40.0, 0.1);
        }
    });
}

#[test]
fn a_blow_from_the_front_on_one_of_two_keeps_the_momentum_of_all() {
    precise(|| {
        for make in KEEPING {
            let (mut simulator, bodies, _) = pair(weightless(), make);
            let hammer = solid(&mut simulator, [20.0; 3], [-12.0, 100.0, -60.0]);
            throw(&mut simulator, hammer, [0.0, 0.0, 100.0]);
            run(&mut simulator, 200);
            assert_near(momentum(&simulator, &[hammer, bodies[0], bodies[1]]).z, 100.0, ROUNDING);
            // Without restitution all move as one; the iterations of a step leave 0.0033 of the blow between them.
            for body in [hammer, bodies[0], bodies[1]] {
                assert_near(velocity(&simulator, body).z, 20.0, 0.005 * 100.0);
            }
        }
    });
}

#[test]
fn bodies_move_independently_after_their_joint_is_removed() {
    precise(|| {
        let (mut simulator, [one, other], joint) = pair(weightless(), KEEPING[0]);
        run(&mut simulator, 10);
        simulator.edit_objects(|objects| objects.dispose(joint).unwrap());
        throw(&mut simulator, one, [0.0, 0.0, 40.0]);
        run(&mut simulator, 10);
        assert_eq!((velocity(&simulator, one).z, velocity(&simulator, other).z), (40.0, 0.0));
    });
}

#[test]
fn joined_bodies_sleep_and_wake_together() {
    precise(|| {
        let mut simulator = simulator();
        let links = chain(&mut simulator);
        run(&mut simulator, 400);
        assert!(links.iter().all(|&link| simulator.is_asleep(link)));
        simulator.body_mut(links[9]).unwrap().set_linear_velocity_z(100.0);
        run(&mut simulator, 2);
        assert!(links.iter().all(|&link| !simulator.is_asleep(link) && velocity(&simulator, link).z > 5.0));
    });
}

#[test]
fn saved_and_loaded_at_any_step_they_go_on_with_the_same_bits() {
    precise(|| {
        let mut simulator = simulator();
        let links = chain(&mut simulator);
        throw(&mut simulator, links[3], [20.0, 100.0, 200.0]);
        assert_goes_on_after_loading(&mut simulator, &links);
    });
}

#[test]
fn bodies_that_are_made_while_objects_are_edited_have_a_depth() {
    let mut simulator = simulator();
    let geom = simulator.edit_objects(|objects| {
        let body = BodyFactory::create_rectangle_body_in(objects, 20.0, 20.0, 1.0).unwrap();
        GeomFactory::create_rectangle_geom_in(objects, body, 20.0, 10.0, GeomPlacement::default()).unwrap()
    });
    // As deep as the shorter side.
    assert_eq!(simulator.geom(geom).unwrap().depth_profile().half_depth(), 5.0);
}

/// A box of mass 1 on a spring of a constant, attached to a static one at a distance from it; the spring's rest length is 0.
fn sprung(constant: f32, damping: f32, apart: [f32; 3]) -> (TwoHalfPhysicsSimulator, BodyId) {
    let mut simulator = weightless();
    let fixed = solid(&mut simulator, [2.0; 3], [0.0, 300.0, 0.0]);
    simulator.body_mut(fixed).unwrap().set_is_static(true);
    let [x, y, z] = apart;
    let body = solid(&mut simulator, [2.0; 3], [x, 300.0 + y, z]);
    for body in [fixed, body] {
        let geom = simulator.body(body).unwrap().ground().object_geom().unwrap();
        simulator.geom_mut(geom).unwrap().set_collision_enabled(false);
    }
    simulator.edit_objects(|objects| {
        let zero = Vector2::zeros();
        let spring =
            SpringFactory::create_linear_spring(objects, fixed, zero, body, zero, constant, damping).unwrap();
        objects.spring_as_mut::<LinearSpring>(spring).unwrap().set_rest_length(0.0).unwrap();
        objects.add(spring).unwrap();
    });
    (simulator, body)
}

#[test]
fn a_spring_swings_along_any_axis_with_the_period_of_its_constant() {
    precise(|| {
        // 1 Hz: after half a period of 50 steps it is on the other side, after a full one at its start.
        let constant = (2.0 * std::f32::consts::PI).powi(2);
        for apart in [[0.0, 0.0, 40.0], [24.0, 0.0, 32.0], [-20.0, 20.0, 10.0]] {
            let (mut simulator, body) = sprung(constant, 0.0, apart);
            let middle = Vector3::new(0.0, 300.0, 0.0);
            run(&mut simulator, 50);
            let apart = Vector3::from(apart);
            assert!((place(&simulator, body) - middle + apart).norm() < 0.02 * apart.norm());
            run(&mut simulator, 950);
            assert!((place(&simulator, body) - middle - apart).norm() < 0.02 * apart.norm());
        }
    });
}

#[test]
fn a_damped_spring_along_z_comes_to_rest_at_its_length() {
    precise(|| {
        let (mut simulator, body) = sprung(40.0, 8.0, [0.0, 0.0, 40.0]);
        run(&mut simulator, 500);
        assert_near3(place(&simulator, body), [0.0, 300.0, 0.0], 0.01);
    });
}

#[test]
fn a_spring_that_is_too_stiff_for_the_step_swings_within_bounds() {
    precise(|| {
        // Its stiffness is 0.97 of the stable limit of a step: the amplitude of symplectic Euler is 1 / sqrt(1 - 0.97) then.
        let most = 40.0 / 0.03f32.sqrt() + 0.1;
        let (mut simulator, body) = sprung(1e9, 0.0, [0.0, 0.0, 40.0]);
        for _ in 0..500 {
            run(&mut simulator, 1);
            assert!(place(&simulator, body).z.abs() <= most);
        }
    });
}

#[test]
fn a_spring_between_two_keeps_their_momentum_along_z() {
    precise(|| {
        let mut simulator = weightless();
        let bodies = [0.0, 60.0].map(|z| solid(&mut simulator, [10.0; 3], [z, 100.0, z]));
        simulator.body_mut(bodies[1]).unwrap().set_mass(3.0).unwrap();
        simulator.edit_objects(|objects| {
            let zero = Vector2::zeros();
            let spring =
                SpringFactory::create_linear_spring(objects, bodies[0], zero, bodies[1], zero, 30.0, 1.0)
                    .unwrap();
            objects.add(spring).unwrap();
        });
        throw(&mut simulator, bodies[0], [0.0, 0.0, -40.0]);
        let before = momentum(&simulator, &bodies);
        run(&mut simulator, 300);
        assert_near3(momentum(&simulator, &bodies), before.into(), 0.01);
        assert!(velocity(&simulator, bodies[1]).z < 0.0);
    });
}
