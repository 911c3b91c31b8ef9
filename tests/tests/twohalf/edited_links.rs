//! Joints and springs are added, removed and edited amid a run: sleeping bodies wake when they must.

use conformance::fixtures::depth::{assert_near, place, run, simulator, solid, with_scheme};
use farseer_core::{JointFactory, JointId, LinearSpring, Objects, PinJoint, SpringFactory, SpringId};
use twohalf::{BodyId, DepthScheme, TwoHalfPhysicsSimulator, Vector2};

fn precise(test: impl FnOnce()) {
    with_scheme(DepthScheme::Precise, test);
}

/// A static box 200 px up, and two boxes on the ground, at Z 0 and 60, that sleep.
fn sleeping() -> (TwoHalfPhysicsSimulator, [BodyId; 3]) {
    let mut simulator = simulator();
    let hook = solid(&mut simulator, [10.0; 3], [0.0, 200.0, 0.0]);
    simulator.body_mut(hook).unwrap().set_is_static(true);
    let boxes = [0.0, 60.0].map(|z| solid(&mut simulator, [20.0; 3], [0.0, 0.0, z]));
    run(&mut simulator, 200);
    assert!(boxes.iter().all(|&body| simulator.is_asleep(body)));
    (simulator, [hook, boxes[0], boxes[1]])
}

fn pin(objects: &mut Objects, [a, b]: [BodyId; 2], length: f32) -> JointId {
    let zero = Vector2::zeros();
    let joint = JointFactory::create_pin_joint(objects, a, zero, b, zero).unwrap();
    objects.joint_as_mut::<PinJoint>(joint).unwrap().set_target_distance(length).unwrap();
    objects.add(joint).unwrap();
    joint
}

fn spring(objects: &mut Objects, [a, b]: [BodyId; 2], length: f32) -> SpringId {
    let zero = Vector2::zeros();
    let spring = SpringFactory::create_linear_spring(objects, a, zero, b, zero, 20.0, 2.0).unwrap();
    objects.spring_as_mut::<LinearSpring>(spring).unwrap().set_rest_length(length).unwrap();
    objects.add(spring).unwrap();
    spring
}

fn apart(simulator: &TwoHalfPhysicsSimulator, [_, one, other]: [BodyId; 3]) -> f32 {
    place(simulator, other).z - place(simulator, one).z
}

#[test]
fn an_added_pin_pulls_sleeping_bodies_along_z() {
    precise(|| {
        let (mut simulator, bodies) = sleeping();
        simulator.edit_objects(|objects| pin(objects, [bodies[1], bodies[2]], 40.0));
        run(&mut simulator, 200);
        assert_near(apart(&simulator, bodies), 40.0, 0.01);
    });
}

#[test]
fn an_added_spring_pulls_sleeping_bodies_along_z() {
    precise(|| {
        let (mut simulator, bodies) = sleeping();
        simulator.edit_objects(|objects| spring(objects, [bodies[1], bodies[2]], 40.0));
        run(&mut simulator, 1000);
        assert_near(apart(&simulator, bodies), 40.0, 0.1);
    });
}

#[test]
fn a_pin_that_becomes_longer_moves_bodies_asleep_on_it() {
    precise(|| {
        let (mut simulator, bodies) = sleeping();
        let joint = simulator.edit_objects(|objects| pin(objects, [bodies[1], bodies[2]], 60.0));
        run(&mut simulator, 300);
        assert!(simulator.is_asleep(bodies[2]));
        simulator.edit_objects(|objects| {
            objects.joint_as_mut::<PinJoint>(joint).unwrap().set_target_distance(75.0).unwrap();
        });
        run(&mut simulator, 200);
        assert_near(apart(&simulator, bodies), 75.0, 0.01);
    });
}

#[test]
fn a_body_asleep_on_a_pin_or_a_spring_falls_when_that_is_removed_disposed_or_disabled() {
    precise(|| {
        for way in 0..6 {
            let (mut simulator, [hook, body, _]) = sleeping();
            simulator.body_mut(body).unwrap().set_position3d([30.0, 100.0, 40.0].into());
            let (joint, spring) = simulator.edit_objects(|objects| {
                let joint = pin(objects, [hook, body], 100.0);
                (joint, spring(objects, [hook, body], 100.0))
            });
            // One of them is disposed, so that the other is tested alone.
            match way % 2 {
                0 => simulator.dispose(spring).unwrap(),
                _ => simulator.dispose(joint).unwrap(),
            }
            simulator.body_mut(body).unwrap().core_mut().set_linear_drag_coefficient(2.0);
            run(&mut simulator, 3000);
            assert!(simulator.is_asleep(body) && place(&simulator, body).y > 80.0, "{way}");
            match way {
                0 => simulator.dispose(joint).unwrap(),
                1 => simulator.dispose(spring).unwrap(),
                2 => simulator.remove(joint).unwrap(),
                3 => simulator.remove(spring).unwrap(),
                4 => simulator.edit_objects(|objects| objects[joint].set_enabled(false)),
                _ => simulator.edit_objects(|objects| objects[spring].set_enabled(false)),
            }
            run(&mut simulator, 400);
            assert_near(place(&simulator, body).y, 0.0, 0.1);
        }
    });
}

#[test]
fn a_disposed_body_disposes_its_pins() {
    precise(|| {
        let (mut simulator, bodies) = sleeping();
        let joint = simulator.edit_objects(|objects| pin(objects, [bodies[1], bodies[2]], 60.0));
        run(&mut simulator, 10);
        simulator.dispose(bodies[2]).unwrap();
        run(&mut simulator, 2);
        assert!(simulator.core().joint(joint).is_none());
        simulator.body_mut(bodies[1]).unwrap().set_linear_velocity_z(-20.0);
        run(&mut simulator, 100);
        assert!(place(&simulator, bodies[1]).z < -15.0);
    });
}
