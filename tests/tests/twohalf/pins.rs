//! Pins and sliders act along all three axes.

use conformance::fixtures::depth::{
    DT, GRAVITY, assert_goes_on_after_loading, assert_near, assert_near3, momentum, place, run, simulator,
    solid, throw, velocity, weightless, with_scheme,
};
use farseer_core::{IslandSolver, JointFactory, JointId, JointLimits, JointMotor, PinJoint, SliderJoint};
use twohalf::{BodyId, DepthScheme, Event, TwoHalfPhysicsSimulator, Vector2, Vector3};

fn precise(test: impl FnOnce()) {
    with_scheme(DepthScheme::Precise, test);
}

/// Pivot of the pendulums in px.
const HOOK: [f32; 3] = [0.0, 400.0, 30.0];

/// A small box without collisions.
fn bead(simulator: &mut TwoHalfPhysicsSimulator, at: [f32; 3]) -> BodyId {
    let body = solid(simulator, [4.0; 3], at);
    let geom = simulator.body(body).unwrap().ground().object_geom().unwrap();
    simulator.geom_mut(geom).unwrap().set_collision_enabled(false);
    body
}

fn hook(simulator: &mut TwoHalfPhysicsSimulator) -> BodyId {
    let hook = bead(simulator, HOOK);
    simulator.body_mut(hook).unwrap().set_is_static(true);
    hook
}

fn from_hook([x, y, z]: [f32; 3]) -> [f32; 3] {
    [HOOK[0] + x, HOOK[1] + y, HOOK[2] + z]
}

/// A pin of a length between the middles of two bodies.
fn pin(simulator: &mut TwoHalfPhysicsSimulator, a: BodyId, b: BodyId, length: f32) -> JointId {
    simulator.edit_objects(|objects| {
        let zero = Vector2::zeros();
        let joint = JointFactory::create_pin_joint(objects, a, zero, b, zero).unwrap();
        objects.joint_as_mut::<PinJoint>(joint).unwrap().set_target_distance(length).unwrap();
        objects.add(joint).unwrap();
        joint
    })
}

/// A slider with these limits of the distance between the middles of two bodies.
fn slider(simulator: &mut TwoHalfPhysicsSimulator, [a, b]: [BodyId; 2], [min, max]: [f32; 2]) -> JointId {
    simulator.edit_objects(|objects| {
        let zero = Vector2::zeros();
        let joint = JointFactory::create_slider_joint(objects, a, zero, b, zero, min, max).unwrap();
        objects.joint_as_mut::<SliderJoint>(joint).unwrap().set_slop(0.0).unwrap();
        objects.add(joint).unwrap();
        joint
    })
}

/// A pendulum of 100 px that is so far aside of where it hangs at rest.
fn pendulum(aside: [f32; 2]) -> (TwoHalfPhysicsSimulator, BodyId, JointId) {
    let mut simulator = simulator();
    let hook = hook(&mut simulator);
    let [x, z] = aside;
    let down = -(100.0f32 * 100.0 - x * x - z * z).sqrt();
    let bob = bead(&mut simulator, from_hook([x, down, z]));
    let joint = pin(&mut simulator, hook, bob, 100.0);
    (simulator, bob, joint)
}

/// The mean period of a pendulum in s, from its passages of the middle.
fn period(aside: [f32; 2], swings: usize) -> f32 {
    let (mut simulator, bob, _) = pendulum(aside);
    let along = |simulator: &TwoHalfPhysicsSimulator| {
        let apart = place(simulator, bob) - Vector3::from(HOOK);
        apart.x * aside[0] + apart.z * aside[1]
    };
    let (mut passages, mut before, mut time) = (Vec::new(), along(&simulator), 0.0);
    while passages.len() <= swings {
        run(&mut simulator, 1);
        let now = along(&simulator);
        if before > 0.0 && now <= 0.0 {
            passages.push(time + DT * before / (before - now));
        }
        (before, time) = (now, time + DT);
    }
    (passages[swings] - passages[0]) / swings as f32
}

#[test]
fn a_pendulum_swings_as_fast_along_z_or_obliquely_as_it_does_along_x() {
    precise(|| {
        // 2 pi sqrt(l / g) (1 + a^2 / 16 + 11 a^4 / 3072) for an amplitude of a: of 100 px and 100 px/s², 0.3 and 1 rad.
        for amplitude in [0.3f32, 1.0] {
            let squared = amplitude * amplitude;
            let longer = 1.0 + squared / 16.0 + 11.0 * squared * squared / 3072.0;
            let expected = 2.0 * std::f32::consts::PI * longer;
            let aside = 100.0 * amplitude.sin();
            for [x, z] in [[1.0, 0.0], [0.0, 1.0], [0.6, 0.8], [-0.8, 0.6]] {
                assert_near(period([aside * x, aside * z], 5), expected, 1e-3 * expected);
            }
        }
    });
}

#[test]
fn a_pendulum_that_circles_stays_at_its_height_with_the_speed_of_its_angle() {
    precise(|| {
        // 60 px aside, 80 px down: w² = g / 80 px, and the pull is m g / 0.8.
        let (mut simulator, bob, joint) = pendulum([60.0, 0.0]);
        let spin = (GRAVITY / 80.0f32).sqrt();
        throw(&mut simulator, bob, [0.0, 0.0, 60.0 * spin]);
        for step in 1..=1000 {
            run(&mut simulator, 1);
            let apart = place(&simulator, bob) - Vector3::from(HOOK);
            assert_near(apart.norm(), 100.0, 0.01);
            assert_near(apart.y, -80.0, 0.1);
            let angle = spin * DT * step as f32;
            assert_near3(apart, [60.0 * angle.cos(), -80.0, 60.0 * angle.sin()], 0.6);
            let joint = simulator.core().joint(joint).unwrap();
            let force = Vector3::new(joint.force().x, joint.force().y, joint.force_along_depth());
            assert_near(force.norm(), GRAVITY / 0.8, 0.02 * GRAVITY);
        }
    });
}

#[test]
fn a_pendulum_along_z_keeps_its_energy_for_ten_thousand_steps() {
    precise(|| {
        let (mut simulator, bob, _) = pendulum([30.0, 60.0]);
        let energy = |simulator: &TwoHalfPhysicsSimulator| {
            let velocity = velocity(simulator, bob);
            0.5 * velocity.dot(&velocity) + GRAVITY * (place(simulator, bob).y - HOOK[1] + 100.0)
        };
        let before = energy(&simulator);
        let (mut least, mut most) = (f32::MAX, f32::MIN);
        for _ in 0..10_000 {
            run(&mut simulator, 1);
            (least, most) = (least.min(energy(&simulator)), most.max(energy(&simulator)));
        }
        assert!(least > 0.99 * before && most < 1.01 * before);
    });
}

#[test]
fn two_pinned_bodies_rotate_about_their_centre_of_mass_in_any_plane() {
    precise(|| {
        let mut simulator = weightless();
        let bodies = [[-24.0, 300.0, -32.0], [8.0, 300.0, 32.0 / 3.0]].map(|at| bead(&mut simulator, at));
        simulator.body_mut(bodies[1]).unwrap().set_mass(3.0).unwrap();
        let length = (32.0f32.powi(2) + (32.0f32 * 4.0 / 3.0).powi(2)).sqrt();
        pin(&mut simulator, bodies[0], bodies[1], length);
        // Thrown up: the plane in which they turn is upright and oblique, and their centre of mass moves at 2.5, 0, 1 px/s.
        throw(&mut simulator, bodies[0], [10.0, 30.0, 4.0]);
        throw(&mut simulator, bodies[1], [0.0, -10.0, 0.0]);
        let before = momentum(&simulator, &bodies);
        let apart =
            |simulator: &TwoHalfPhysicsSimulator| place(simulator, bodies[1]) - place(simulator, bodies[0]);
        let parting = |simulator: &TwoHalfPhysicsSimulator| {
            velocity(simulator, bodies[1]) - velocity(simulator, bodies[0])
        };
        run(&mut simulator, 1);
        let turning = apart(&simulator).cross(&parting(&simulator));
        run(&mut simulator, 999);
        assert_near3(momentum(&simulator, &bodies), before.into(), 0.01);
        assert_near(apart(&simulator).norm(), length, 0.01);
        assert_near3(apart(&simulator).cross(&parting(&simulator)), turning.into(), 2e-3 * turning.norm());
    });
}

/// A chain of beads 20 px from each other, hung up at one end and held out along a direction.
fn chain(simulator: &mut TwoHalfPhysicsSimulator, beads: usize, [x, z]: [f32; 2]) -> Vec<BodyId> {
    let mut chain = vec![hook(simulator)];
    for at in 1..=beads {
        let out = 20.0 * at as f32;
        let next = bead(simulator, from_hook([x * out, 0.0, z * out]));
        pin(simulator, chain[at - 1], next, 20.0);
        chain.push(next);
    }
    chain
}

#[test]
fn a_chain_swings_in_depth_as_it_does_in_the_plane() {
    precise(|| {
        let swing = |[x, z]: [f32; 2]| {
            let mut simulator = simulator();
            let chain = chain(&mut simulator, 8, [x, z]);
            run(&mut simulator, 150);
            let seen = chain.iter().map(|&bead| place(&simulator, bead) - Vector3::from(HOOK));
            seen.map(|apart| [apart.x * x + apart.z * z, apart.y, apart.x * z - apart.z * x])
                .collect::<Vec<_>>()
        };
        let in_plane = swing([1.0, 0.0]);
        for direction in [[0.0, 1.0], [0.6, 0.8], [0.0, -1.0]] {
            for (one, other) in swing(direction).iter().zip(&in_plane) {
                assert_near3(Vector3::from(*one), *other, 0.05);
            }
        }
    });
}

#[test]
fn a_chain_that_swings_in_depth_keeps_its_links_and_gains_no_energy() {
    precise(|| {
        let mut simulator = simulator();
        let chain = chain(&mut simulator, 12, [0.6, 0.8]);
        let energy = |simulator: &TwoHalfPhysicsSimulator| {
            let of = |&bead: &BodyId| {
                let velocity = velocity(simulator, bead);
                0.5 * velocity.dot(&velocity) + GRAVITY * place(simulator, bead).y
            };
            chain[1..].iter().map(of).sum::<f32>()
        };
        let (before, fall) = (energy(&simulator), GRAVITY * 20.0 * 78.0);
        for _ in 0..3000 {
            run(&mut simulator, 1);
            for two in chain.windows(2) {
                let apart = place(&simulator, two[1]) - place(&simulator, two[0]);
                assert_near(apart.norm(), 20.0, 0.05);
            }
            assert!(energy(&simulator) < before + 0.02 * fall);
        }
    });
}

#[test]
fn a_load_of_a_hundred_thousand_times_the_mass_of_its_links_swings_on_its_rope() {
    precise(|| {
        let mut simulator = simulator();
        let chain = chain(&mut simulator, 10, [0.6, 0.8]);
        simulator.body_mut(chain[10]).unwrap().set_mass(1e5).unwrap();
        for _ in 0..2000 {
            run(&mut simulator, 1);
            let apart = place(&simulator, chain[10]) - Vector3::from(HOOK);
            assert!(apart.norm() < 200.1, "{apart:?}");
        }
    });
}

#[test]
fn a_slider_stops_a_thrown_body_at_its_end_along_any_axis() {
    precise(|| {
        for direction in [[0.0, 0.0, 1.0], [0.0, 0.6, -0.8], [0.48, 0.6, 0.64]] {
            let mut simulator = weightless();
            let hook = hook(&mut simulator);
            let direction = Vector3::from(direction);
            let body = bead(&mut simulator, from_hook((direction * 30.0).into()));
            slider(&mut simulator, [hook, body], [20.0, 50.0]);
            throw(&mut simulator, body, (direction * 40.0).into());
            run(&mut simulator, 45);
            // Until then it is free.
            assert_near3(place(&simulator, body) - Vector3::from(HOOK), (direction * 48.0).into(), 0.01);
            run(&mut simulator, 50);
            assert_near3(place(&simulator, body) - Vector3::from(HOOK), (direction * 50.0).into(), 0.01);
            assert_near3(velocity(&simulator, body), [0.0; 3], 0.01);
            throw(&mut simulator, body, (direction * -40.0).into());
            run(&mut simulator, 100);
            assert_near3(place(&simulator, body) - Vector3::from(HOOK), (direction * 20.0).into(), 0.01);
        }
    });
}

#[test]
fn a_slider_that_is_taut_shares_the_momentum_along_z() {
    precise(|| {
        let mut simulator = weightless();
        let bodies = [0.0, 40.0].map(|z| bead(&mut simulator, [0.0, 100.0, z]));
        simulator.body_mut(bodies[1]).unwrap().set_mass(4.0).unwrap();
        slider(&mut simulator, bodies, [0.0, 50.0]);
        throw(&mut simulator, bodies[0], [0.0, 0.0, -100.0]);
        run(&mut simulator, 100);
        for body in bodies {
            assert_near(velocity(&simulator, body).z, -20.0, 0.01);
        }
    });
}

#[test]
fn a_pin_breaks_under_too_great_a_load_along_z() {
    precise(|| {
        // It swings up to the hook's height: at the lowest point it pulls with 3 m g, 300.
        for (greatest, breaks) in [(280.0, true), (320.0, false)] {
            let (mut simulator, bob, joint) = pendulum([0.0, 100.0]);
            simulator.edit_objects(|objects| objects[joint].set_greatest_force(greatest).unwrap());
            let mut told = 0;
            for _ in 0..300 {
                run(&mut simulator, 1);
                let broken =
                    |event: &&Event| matches!(event, Event::JointBroke { joint: of } if *of == joint);
                told += simulator.events().iter().filter(broken).count();
            }
            assert_eq!((told == 1, simulator.core().joint(joint).unwrap().enabled()), (breaks, !breaks));
            let apart = (place(&simulator, bob) - Vector3::from(HOOK)).norm();
            assert_eq!(apart > 101.0, breaks);
        }
    });
}

#[test]
fn a_pin_that_is_too_long_along_z_breaks_where_its_breakpoint_is() {
    precise(|| {
        let mut simulator = weightless();
        let hook = hook(&mut simulator);
        let body = bead(&mut simulator, from_hook([0.0, -30.0, 40.0]));
        let joint = pin(&mut simulator, hook, body, 50.0);
        simulator.edit_objects(|objects| objects[joint].set_breakpoint(5.0).unwrap());
        run(&mut simulator, 10);
        assert!(simulator.core().joint(joint).unwrap().enabled());
        simulator.body_mut(body).unwrap().set_position3d(Vector3::from(from_hook([0.0, -30.0, 50.0])));
        run(&mut simulator, 1);
        assert!(!simulator.core().joint(joint).unwrap().enabled());
        assert_near(simulator.core().joint(joint).unwrap().joint_error(), 34.0f32.sqrt() * 10.0 - 50.0, 0.01);
    });
}

#[test]
fn a_body_pinned_to_a_kinematic_body_is_pulled_along_z() {
    precise(|| {
        let mut simulator = simulator();
        let crane = bead(&mut simulator, HOOK);
        simulator.body_mut(crane).unwrap().set_is_kinematic(true);
        let load = bead(&mut simulator, from_hook([0.0, -50.0, 0.0]));
        pin(&mut simulator, crane, load, 50.0);
        run(&mut simulator, 200);
        assert!(simulator.is_asleep(load));
        simulator.body_mut(crane).unwrap().set_velocity3d(Vector3::new(0.0, 0.0, 30.0));
        run(&mut simulator, 300);
        // In the frame of the crane it is a pendulum with an initial speed of 30 px/s: it rises by v² / 2 g = 4.5 px at most.
        let apart = place(&simulator, load) - place(&simulator, crane);
        assert_near(apart.norm(), 50.0, 0.01);
        assert!((-50.1..-45.3).contains(&apart.y));
        assert_near(place(&simulator, crane).z, HOOK[2] + 90.0, 0.01);
    });
}

/// A rope of fourteen pins of 11 px to a post 140 px away from the hook, which sags by `sag` px per pin at first.
fn rope_between_posts(simulator: &mut TwoHalfPhysicsSimulator, sag: f32) -> Vec<BodyId> {
    let mut beads = vec![hook(simulator)];
    for at in 1..=14i16 {
        let below = f32::from(at.min(14 - at)) * sag;
        let along = f32::from(at);
        beads.push(bead(simulator, from_hook([6.0 * along, -below, 8.0 * along])));
    }
    simulator.body_mut(beads[14]).unwrap().set_is_static(true);
    beads.windows(2).for_each(|two| _ = pin(simulator, two[0], two[1], 11.0));
    beads
}

#[test]
fn a_rope_between_two_posts_holds_its_load() {
    precise(|| {
        let mut simulator = simulator();
        let beads = rope_between_posts(&mut simulator, 21.0f32.sqrt());
        // In the middle: the rope is two straight lines, whose ends pull with m g / 2 up.
        simulator.body_mut(beads[7]).unwrap().set_mass(200.0).unwrap();
        for _ in 0..1500 {
            run(&mut simulator, 1);
            for two in beads.windows(2) {
                let apart = place(&simulator, two[1]) - place(&simulator, two[0]);
                assert_near(apart.norm(), 11.0, 0.1);
            }
        }
        assert_near(HOOK[1] - place(&simulator, beads[7]).y, 7.0 * 21.0f32.sqrt(), 0.5);
        let first = simulator.core().joint(simulator.core().joint_list()[0]).unwrap();
        assert_near(first.force().y.abs(), (200.0 + 12.0) * 0.5 * GRAVITY, 0.01 * 200.0 * GRAVITY);
    });
}

#[test]
fn rods_longer_than_their_distance_buckle_and_keep_their_length() {
    precise(|| {
        let mut simulator = simulator();
        let beads = rope_between_posts(&mut simulator, 0.0);
        for step in 0..1500 {
            run(&mut simulator, 1);
            for two in beads.windows(2) {
                let apart = place(&simulator, two[1]) - place(&simulator, two[0]);
                // A loop closure corrects a fifth of an error in each of the five substeps of a step.
                assert_near(apart.norm(), 11.0, if step < 20 { 11.0 } else { 0.01 });
                assert!((place(&simulator, two[1]) - Vector3::from(HOOK)).norm() < 150.0);
            }
        }
    });
}

#[test]
fn a_rope_that_is_too_short_for_its_posts_stays_between_them() {
    precise(|| {
        let mut simulator = simulator();
        let mut beads = vec![hook(&mut simulator)];
        beads.extend((1..=10u8).map(|at| bead(&mut simulator, from_hook([0.0, 0.0, 20.0 * f32::from(at)]))));
        simulator.body_mut(beads[10]).unwrap().set_is_static(true);
        beads.windows(2).for_each(|two| _ = pin(&mut simulator, two[0], two[1], 19.0));
        for _ in 0..1000 {
            run(&mut simulator, 1);
            for (at, &bead) in beads.iter().enumerate() {
                let aside = place(&simulator, bead) - Vector3::from(from_hook([0.0, 0.0, 20.0 * at as f32]));
                // It is 10 px too short.
                assert!(aside.norm() < 10.0, "{aside:?}");
            }
        }
        assert!(beads[1..10].iter().all(|&bead| velocity(&simulator, bead).norm() < 0.1));
    });
}

#[test]
fn saved_and_loaded_at_any_step_ropes_go_on_with_the_same_bits() {
    precise(|| {
        let mut simulator = simulator();
        let beads = chain(&mut simulator, 6, [0.6, 0.8]);
        slider(&mut simulator, [beads[2], beads[6]], [0.0, 60.0]);
        assert_goes_on_after_loading(&mut simulator, &beads);
    });
}

/// A carriage on a level rail with a load that hangs on it by a pin, and the joint of the rail.
fn crane(simulator: &mut TwoHalfPhysicsSimulator) -> (BodyId, JointId) {
    let post = hook(simulator);
    let carriage = bead(simulator, from_hook([0.0, -20.0, 0.0]));
    let load = bead(simulator, from_hook([0.0, -70.0, 0.0]));
    pin(simulator, carriage, load, 50.0);
    let rail = simulator.edit_objects(|objects| {
        let middle = objects[carriage].position();
        let along = Vector2::new(1.0, 0.0);
        let rail = JointFactory::create_prismatic_joint(objects, post, carriage, middle, along).unwrap();
        objects.add(rail).unwrap();
        rail
    });
    (carriage, rail)
}

#[test]
fn a_carriage_with_a_load_on_a_rope_stops_where_its_rail_ends_and_leaves_it_again() {
    precise(|| {
        let mut simulator = simulator();
        let (carriage, rail) = crane(&mut simulator);
        let limits = JointLimits { lower: -15.0, upper: 15.0 };
        simulator.edit_objects(|objects| objects.set_joint_limits(rail, Some(limits))).unwrap();
        for (speed, end) in [(20.0, 15.0), (-20.0, -15.0), (20.0, 15.0)] {
            let motor = JointMotor { speed, greatest_effort: 1e6 };
            simulator.edit_objects(|objects| objects.set_joint_motor(rail, Some(motor))).unwrap();
            run(&mut simulator, 400);
            assert!(simulator.core().body(carriage).unwrap().enabled());
            // The yield between a motor and a limit is a tenth of a joint's response.
            assert_near(place(&simulator, carriage).x - HOOK[0], end, 0.1);
        }
    });
}

#[test]
fn a_removed_joint_exerts_no_force_along_z() {
    precise(|| {
        let mut simulator = simulator();
        let hook = hook(&mut simulator);
        let bob = bead(&mut simulator, from_hook([0.0, -60.0, 80.0]));
        let below = bead(&mut simulator, from_hook([0.0, -80.0, 80.0]));
        let rope = pin(&mut simulator, hook, bob, 100.0);
        let hinge = simulator.edit_objects(|objects| {
            let at = objects[bob].position();
            let hinge = JointFactory::create_revolute_joint(objects, bob, below, at).unwrap();
            objects.add(hinge).unwrap();
            hinge
        });
        run(&mut simulator, 5);
        assert!(simulator.core().joint(hinge).unwrap().force_along_depth().abs() > 1.0);
        simulator.dispose(rope).unwrap();
        run(&mut simulator, 2);
        assert_eq!(simulator.core().joint(hinge).unwrap().force_along_depth(), 0.0);
    });
}

#[test]
fn a_body_that_swings_on_a_pin_is_reported_as_articulated() {
    precise(|| {
        let (mut simulator, bob, _) = pendulum([60.0, 0.0]);
        run(&mut simulator, 3);
        let island = simulator.core().islands().into_iter().find(|island| island.bodies.contains(&bob));
        assert_eq!(island.map(|island| island.method), Some(IslandSolver::Articulated));
    });
}
