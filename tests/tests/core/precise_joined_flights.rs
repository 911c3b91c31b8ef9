//! The precise set: continuous collision of jointed bodies. They stop as one.

use conformance::fixtures::plane::{add_box, energy, precise, v};
use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, GeomFactory, GeomPlacement, JointFactory, JointId, PhysicsSimulator,
};

const DT: f32 = 1.0 / 60.0;
/// Length units per second squared; 32 length units are a metre.
const GRAVITY: f32 = 320.0;

/// A static box.
fn add_wall(simulator: &mut PhysicsSimulator, at: Vector2, [width, height]: [f32; 2]) {
    let wall = BodyFactory::create_rectangle_body_in(simulator, width, height, 1.0).unwrap();
    GeomFactory::create_rectangle_geom_in(simulator, wall, width, height, GeomPlacement::default()).unwrap();
    simulator[wall].set_position(at);
    simulator[wall].set_is_static(true);
}

fn add_part(simulator: &mut PhysicsSimulator, at: Vector2, size: (f32, f32)) -> BodyId {
    let (body, geom) = add_box(simulator, size, at);
    simulator[body].set_linear_drag_coefficient(0.0);
    simulator[body].set_rotational_drag_coefficient(0.0);
    simulator[geom].set_collision_group(1);
    simulator[geom].set_friction_coefficient(0.5);
    body
}

/// A torso with a head, two arms and two legs with limits.
fn add_ragdoll(simulator: &mut PhysicsSimulator, at: Vector2) -> (Vec<BodyId>, Vec<JointId>) {
    let torso = add_part(simulator, at, (16.0, 30.0));
    let limbs = [
        ((12.0, 12.0), v(0.0, -22.0), v(0.0, -15.0)),
        ((24.0, 6.0), v(-20.0, -10.0), v(-8.0, -10.0)),
        ((24.0, 6.0), v(20.0, -10.0), v(8.0, -10.0)),
        ((6.0, 24.0), v(-5.0, 27.0), v(-5.0, 15.0)),
        ((6.0, 24.0), v(5.0, 27.0), v(5.0, 15.0)),
    ];
    let (mut bodies, mut joints) = (vec![torso], Vec::new());
    for (size, offset, anchor) in limbs {
        let limb = add_part(simulator, at + offset, size);
        joints.push(JointFactory::create_revolute_joint_in(simulator, torso, limb, at + anchor).unwrap());
        JointFactory::create_angle_limit_joint_in(simulator, torso, limb, -0.8, 0.8).unwrap();
        bodies.push(limb);
    }
    (bodies, joints)
}

/// The greatest distance between the anchors of a joint when the last update began.
fn gap(simulator: &PhysicsSimulator, joints: &[JointId]) -> f32 {
    joints.iter().map(|&joint| simulator[joint].joint_error()).fold(0.0, f32::max)
}

#[test]
fn a_welded_bar_that_meets_a_wall_fast_keeps_its_joint_closed() {
    for dt in [1.0 / 30.0, DT, 1.0 / 120.0] {
        for speed in [300.0, 1000.0, 3000.0, 12_000.0] {
            let mut simulator = precise(0.0);
            add_wall(&mut simulator, v(0.0, 50.0), [2000.0, 100.0]);
            // One half meets the floor with its corner, the other one is level with it.
            let parts =
                [v(-20.0, -500.0), v(20.0, -507.0)].map(|at| add_part(&mut simulator, at, (40.0, 6.0)));
            let [a, b] = parts;
            let joint = JointFactory::create_weld_joint_in(&mut simulator, a, b, v(0.0, -503.0)).unwrap();
            parts.iter().for_each(|&part| simulator[part].set_linear_velocity(v(0.0, speed)));
            let mut worst = 0.0_f32;
            for _ in 0..(3.0 / dt * 500.0 / speed) as usize + 30 {
                simulator.update(dt);
                worst = worst.max(gap(&simulator, &[joint]));
            }
            assert!(worst < 1e-3, "dt {dt}, speed {speed}: {worst}");
            assert!(parts.iter().all(|&part| simulator[part].position().y < 0.0));
        }
    }
}

#[test]
fn a_ragdoll_that_falls_far_stays_in_one_piece_and_on_the_floor() {
    for turned in 0..8 {
        // Measured: 0.66, 2.8 and 6.3, and a rise by 95.
        for (height, widest) in [(160.0, 1.0), (640.0, 4.0), (1280.0, 8.0)] {
            let mut simulator = precise(GRAVITY);
            add_wall(&mut simulator, v(0.0, 50.0), [4000.0, 100.0]);
            let (bodies, joints) = add_ragdoll(&mut simulator, v(0.0, -40.0 - height));
            let spin = 0.1 * turned as f32;
            for &body in &bodies {
                let arm = simulator[body].position() - v(0.0, -40.0 - height);
                simulator[body].set_angular_velocity(spin);
                simulator[body].set_linear_velocity(v(-spin * arm.y, spin * arm.x));
            }
            let (mut worst, mut highest, mut has_landed) = (0.0_f32, 0.0_f32, false);
            for _ in 0..600 {
                simulator.update(DT);
                worst = worst.max(gap(&simulator, &joints));
                let y = simulator[bodies[0]].position().y;
                has_landed |= simulator[bodies[0]].linear_velocity().y < 0.0;
                if has_landed {
                    highest = highest.max(-y);
                }
            }
            let case = format!("spin {spin}, height {height}");
            assert!(worst < widest, "{case}: a gap of {worst}");
            // It is 94 length units tall.
            assert!(highest < 100.0, "{case}: it rises to {highest}");
            let is_above = |&body: &BodyId| simulator[body].position().y < 0.0;
            assert!(bodies.iter().all(is_above), "{case}");
        }
    }
}

#[test]
fn a_chain_that_whips_against_a_post_stays_in_one_piece() {
    // Measured: gaps of 0.67 and 6.4, a gain of energy by 12 %.
    for (speed, widest) in [(5.0, 1.0), (20.0, 8.0)] {
        let mut simulator = precise(GRAVITY);
        add_wall(&mut simulator, v(60.0, 150.0), [8.0, 40.0]);
        let mut links: Vec<BodyId> = Vec::new();
        let mut joints = Vec::new();
        for at in 0..8 {
            let y = 20.0 * at as f32;
            let link = add_part(&mut simulator, v(0.0, y + 10.0), (4.0, 20.0));
            joints.push(match links.last() {
                None => {
                    JointFactory::create_fixed_revolute_joint_in(&mut simulator, link, v(0.0, 0.0)).unwrap()
                }
                Some(&last) => {
                    JointFactory::create_revolute_joint_in(&mut simulator, last, link, v(0.0, y)).unwrap()
                }
            });
            simulator[link].set_angular_velocity(-speed);
            simulator[link].set_linear_velocity(v(speed * (y + 10.0), 0.0));
            links.push(link);
        }
        let begun = energy(&simulator, &links, GRAVITY);
        let (mut worst, mut most) = (0.0_f32, begun);
        for _ in 0..300 {
            simulator.update(DT);
            worst = worst.max(gap(&simulator, &joints));
            most = most.max(energy(&simulator, &links, GRAVITY));
        }
        assert!(worst < widest, "speed {speed}: a gap of {worst}");
        assert!(
            most < 1.2 * begun && energy(&simulator, &links, GRAVITY) < 0.5 * begun,
            "speed {speed}: {most} of {begun}"
        );
    }
}
