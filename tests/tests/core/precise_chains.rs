//! The precise set: energy, momentum and gaps of chains.

use super::precise_joints::{DT, GRAVITY, chain, ghost, joined, momentum};
use conformance::fixtures::plane::{precise, v};
use farseer_core::{BodyFactory, BodyId, JointFactory, JointLimits, Methods, PhysicsSimulator};

fn energy(simulator: &PhysicsSimulator, bodies: &[BodyId], gravity: f32) -> f64 {
    let of = |&body: &BodyId| {
        let body = &simulator[body];
        let [mass, inertia, spin] =
            [body.mass(), body.moment_of_inertia(), body.angular_velocity()].map(f64::from);
        let velocity = f64::from(body.linear_velocity().norm());
        0.5 * mass * velocity * velocity + 0.5 * inertia * spin * spin
            - mass * f64::from(gravity) * f64::from(body.position().y)
    };
    bodies.iter().map(of).sum()
}

#[test]
fn a_pendulum_that_falls_from_level_keeps_its_energy_for_a_minute() {
    let mut simulator = precise(GRAVITY);
    let (bodies, _) = chain(&mut simulator, 1);
    let before = energy(&simulator, &bodies, GRAVITY);
    let scale = f64::from(simulator[bodies[0]].mass() * GRAVITY * 8.0);
    for _ in 0..3600 {
        simulator.update(DT);
        // It swings about the true energy by the square of the length of a substep, and does not drift. Measured: 0.005.
        let change = (energy(&simulator, &bodies, GRAVITY) - before) / scale;
        assert!(change.abs() < 0.01, "{change}");
    }
}

#[test]
fn joint_gaps_of_a_swinging_chain_of_200_are_below_a_fifth_of_a_px() {
    let mut simulator = precise(GRAVITY);
    // As if it began 30 degrees below level.
    simulator.set_gravity(v(0.5 * GRAVITY, 0.866 * GRAVITY)).unwrap();
    let (_, joints) = chain(&mut simulator, 200);
    for _ in 0..300 {
        simulator.update(DT);
        let worst = joints.iter().map(|&joint| simulator[joint].joint_error()).fold(0.0, f32::max);
        // Measured: below 0.1.
        assert!(worst < 0.2, "{worst} px");
    }
}

#[test]
fn a_ball_ten_thousand_times_as_heavy_hangs_on_a_chain_of_20() {
    let mut simulator = precise(GRAVITY);
    let (bodies, joints) = chain(&mut simulator, 20);
    let ball = ghost(&mut simulator, (16.0, 16.0), v(328.0, 0.0));
    let mass = simulator[bodies[0]].mass();
    simulator[ball].set_mass(1e4 * mass).unwrap();
    simulator[ball].set_moment_of_inertia(1e4 * mass * 40.0).unwrap();
    let joint = JointFactory::create_revolute_joint(&mut simulator, bodies[19], ball, v(320.0, 0.0));
    joined(&mut simulator, joint);
    for _ in 0..600 {
        simulator.update(DT);
        let worst = joints.iter().map(|&joint| simulator[joint].joint_error()).fold(0.0, f32::max);
        // Measured: 2.1e-4, of which 3e-5 is the rounding of positions; 5.2e-5 in twice as many parts of a step.
        assert!(worst < 4e-4, "{worst} px");
    }
}

#[test]
fn a_heavy_ball_that_falls_into_its_chain_opens_no_joint() {
    let mut simulator = precise(0.0);
    // As if the chain began 30 degrees above level: the ball falls freely until the chain is taut.
    simulator.set_gravity(v(-0.5 * GRAVITY, 0.866 * GRAVITY)).unwrap();
    let (bodies, joints) = chain(&mut simulator, 12);
    let ball = ghost(&mut simulator, (16.0, 16.0), v(200.0, 0.0));
    let mass = simulator[bodies[0]].mass();
    simulator[ball].set_mass(100.0 * mass).unwrap();
    simulator[ball].set_moment_of_inertia(100.0 * mass * 40.0).unwrap();
    let joint = JointFactory::create_revolute_joint(&mut simulator, bodies[11], ball, v(192.0, 0.0));
    joined(&mut simulator, joint);
    for _ in 0..600 {
        simulator.update(DT);
        let worst = joints.iter().map(|&joint| simulator[joint].joint_error()).fold(0.0, f32::max);
        assert!(worst < 2.0, "{worst} px");
    }
}

/// The greatest and the last change of the energy of a chain of 20 that swings for ten seconds from 30 degrees below level, as
/// fractions of its greatest kinetic energy.
fn changes_of_energy(has_weld: bool) -> [f64; 2] {
    let mut simulator = precise(0.0);
    let (mut bodies, _) = chain(&mut simulator, 20);
    if has_weld {
        // Then not all of its joints are hinges.
        let end = ghost(&mut simulator, (4.0, 4.0), v(322.0, 0.0));
        let weld = JointFactory::create_weld_joint(&mut simulator, bodies[19], end, v(320.0, 0.0));
        joined(&mut simulator, weld);
        bodies.push(end);
    }
    // It is laid level, and down is turned.
    let gravity = v(0.5, 0.75_f32.sqrt()) * GRAVITY;
    simulator.set_gravity(gravity).unwrap();
    let (mut energies, mut greatest) = (Vec::new(), 0.0_f64);
    for _ in 0..600 {
        simulator.update(DT);
        let kinetic = energy(&simulator, &bodies, 0.0);
        let fallen = bodies.iter().map(|&body| &simulator[body]);
        let fallen = fallen.map(|body| f64::from(body.mass() * gravity.dot(&body.position()))).sum::<f64>();
        energies.push(kinetic - fallen);
        greatest = greatest.max(kinetic);
    }
    let changes: Vec<f64> = energies.iter().map(|energy| (energy - energies[0]) / greatest).collect();
    [changes.iter().copied().fold(0.0, f64::max), changes[599]]
}

#[test]
fn a_chain_of_20_that_swings_from_30_degrees_below_level_keeps_its_energy() {
    for has_weld in [false, true] {
        let [gained, at_last] = changes_of_energy(has_weld);
        // It pulls so hard that steps must be stiffened against it, which may cost energy. Measured: 0.007 to and fro, and
        // 0.004 lost at last.
        assert!(gained < 0.01 && at_last > -0.01, "welded {has_weld}: {gained}, {at_last}");
    }
}

#[test]
fn a_chain_swings_alike_with_hinges_alone_and_with_other_joints() {
    let swing = |has_limit: bool| {
        let mut simulator = precise(GRAVITY);
        let (bodies, _) = chain(&mut simulator, 5);
        if has_limit {
            // It never acts, but the chain is solved with it.
            let limit =
                JointFactory::create_angle_limit_joint(&mut simulator, bodies[3], bodies[4], -9.0, 9.0);
            joined(&mut simulator, limit);
        }
        simulator[bodies[4]].set_linear_velocity(v(200.0, 0.0));
        let mut places = Vec::new();
        for _ in 0..60 {
            simulator.update(DT);
            places.extend(bodies.iter().map(|&body| simulator[body].position()));
        }
        places
    };
    let (hinged, limited) = (swing(false), swing(true));
    let apart = hinged.iter().zip(&limited).map(|(one, other)| (one - other).norm());
    let swung = hinged.iter().fold(0.0, |most: f32, place| most.max(place.x.abs()));
    let apart = apart.fold(0.0, f32::max);
    assert!(swung > 20.0, "{swung}");
    // Measured: 0.025 px. Both methods are of second order in the length of a part, and differ by their errors of that order.
    assert!(apart < 0.03, "{apart}");
}

/// Greatest gain and loss of energy of a chain that begins at an angle in radians from level, as a fraction of its greatest
/// kinetic energy.
fn energy_error(links: usize, angle: f32, rate: f32) -> [f64; 2] {
    let mut simulator = precise(0.0);
    simulator.set_gravity(v(GRAVITY * angle.sin(), GRAVITY * angle.cos())).unwrap();
    let (bodies, _) = chain(&mut simulator, links);
    let [along, down] = [angle.sin(), angle.cos()].map(f64::from);
    let sum = |simulator: &PhysicsSimulator| {
        let kinetic = energy(simulator, &bodies, 0.0);
        let height = |&body: &BodyId| {
            let place = simulator[body].position().map(f64::from);
            f64::from(simulator[body].mass() * GRAVITY) * (place.x * along + place.y * down)
        };
        [kinetic, kinetic - bodies.iter().map(height).sum::<f64>()]
    };
    let [_, begun] = sum(&simulator);
    let (mut gain, mut loss, mut most) = (0.0_f64, 0.0_f64, 0.0_f64);
    for _ in 0..(8.0 * rate) as usize {
        simulator.update(rate.recip());
        let [kinetic, now] = sum(&simulator);
        (gain, loss, most) = (gain.max(now - begun), loss.max(begun - now), most.max(kinetic));
    }
    [gain, loss].map(|change| change / most)
}

#[test]
fn chains_of_any_length_keep_their_energy_from_any_angle_at_any_step() {
    // Measured: 0.0023. Without balance of energy: 0.15 to 0.5 at 30 steps/s, 0.01 to 0.2 at 60.
    for links in 1..=10 {
        for angle in [-60.0_f32, -10.0, 0.0, 30.0, 80.0] {
            for rate in [30.0, 60.0, 120.0] {
                let [gain, loss] = energy_error(links, angle.to_radians(), rate);
                assert!(
                    gain.max(loss) < 0.01,
                    "{links} links, {angle} degrees, 1/{rate} s: +{gain}, -{loss}"
                );
            }
        }
    }
}

#[test]
fn a_free_chain_keeps_energy_momentum_and_angular_momentum() {
    for rate in [30.0_f32, 60.0, 120.0] {
        let mut simulator = precise(0.0);
        let bodies = [0.0_f32, 16.0, 32.0, 48.0].map(|x| ghost(&mut simulator, (16.0, 4.0), v(x, 0.0)));
        for (at, pair) in bodies.windows(2).enumerate() {
            let joint = JointFactory::create_revolute_joint(
                &mut simulator,
                pair[0],
                pair[1],
                v(8.0 + 16.0 * at as f32, 0.0),
            );
            joined(&mut simulator, joint);
        }
        // It folds: the ends have other speeds than a rigid body's.
        for (body, y) in bodies.into_iter().zip([-160.0, 80.0, 80.0, -120.0]) {
            simulator[body].set_linear_velocity(v(30.0, y));
        }
        simulator.update(rate.recip());
        let sums = |simulator: &PhysicsSimulator| {
            let [a, b] = [[bodies[0], bodies[1]], [bodies[2], bodies[3]]].map(|two| momentum(simulator, two));
            [a[0] + b[0], a[1] + b[1], a[2] + b[2], energy(simulator, &bodies, 0.0)]
        };
        let begun = sums(&simulator);
        for _ in 0..(5.0 * rate) as usize {
            simulator.update(rate.recip());
            let now = sums(&simulator);
            // Roundings of velocities and of positions up to 200 px away. Measured of energy: 0.001.
            for (i, slack) in [0.02, 0.02, 4.0, 3e-3 * begun[3]].into_iter().enumerate() {
                assert!((now[i] - begun[i]).abs() < slack, "1/{rate} s, {i}: {} after {}", now[i], begun[i]);
            }
        }
    }
}

/// The step must be refined when the end of the chain whips: see `has_failed` of the energy balance.
#[test]
fn light_links_hold_a_heavy_ball_that_whips() {
    for links in 3..=10 {
        let mut simulator = precise(10.0);
        simulator.set_methods(Methods::Precise { length_unit: 1.0 }).unwrap();
        let top = BodyFactory::create_circle_body_in(&mut simulator, 0.1, 1.0).unwrap();
        simulator[top].set_is_static(true);
        let mut pairs = Vec::new();
        for link in 1..=links {
            let mass = if link == links { 10.0 } else { 0.1 };
            let body = BodyFactory::create_circle_body_in(&mut simulator, 0.08, mass).unwrap();
            let last = pairs.last().map_or(top, |&(_, body)| body);
            let at = simulator[last].position();
            simulator[body].set_position(v(0.5 * link as f32, 0.0));
            JointFactory::create_revolute_joint_in(&mut simulator, last, body, at).unwrap();
            pairs.push((last, body));
        }
        let mut gap = 0.0_f32;
        for _ in 0..1800 {
            simulator.update(DT);
            for &(a, b) in &pairs {
                let anchor = simulator[b].get_world_position(v(-0.5, 0.0));
                gap = gap.max((simulator[a].position() - anchor).norm());
            }
        }
        // Measured: 0.003; without refinement up to 5.2.
        assert!(gap < 0.01, "{links} links gape by {gap} m");
    }
}

#[test]
fn a_pendulum_of_two_links_within_its_limits_conserves_energy() {
    let mut simulator = precise(GRAVITY);
    let (bodies, joints) = chain(&mut simulator, 2);
    simulator.set_joint_limits(joints[1], Some(JointLimits { lower: -99.0, upper: 99.0 })).unwrap();
    simulator[bodies[1]].set_linear_velocity(v(100.0, 0.0));
    simulator.update(DT);
    let begun = energy(&simulator, &bodies, GRAVITY);
    let scale = bodies.iter().map(|&body| f64::from(simulator[body].mass() * GRAVITY * 32.0)).sum::<f64>();
    let mut off = 0.0_f64;
    for _ in 0..600 {
        simulator.update(DT);
        off = off.max((energy(&simulator, &bodies, GRAVITY) - begun).abs());
    }
    // Measured: 0.005.
    assert!(off < 0.01 * scale, "{off} of {scale}");
}
