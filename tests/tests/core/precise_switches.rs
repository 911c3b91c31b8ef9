//! The precise set: a change of method while bodies move has no visible effect.

use conformance::fixtures::plane::{Random, add_box, add_circle, add_floor, simulator, v};
use farseer_core::{BodyId, IslandSolver, Methods, PhysicsSimulator};

const DT: f32 = 1.0 / 60.0;
const GRAVITY: f32 = 320.0;

/// Columns of boxes of all weights, at which a ball is thrown, and bodies that fall on them.
fn towers(random: &mut Random) -> (PhysicsSimulator, Vec<BodyId>) {
    let mut simulator = simulator(GRAVITY);
    simulator.set_methods(Methods::PRECISE).unwrap();
    simulator.set_iterations(4);
    let (_, floor) = add_floor(&mut simulator, (2000.0, 40.0), v(0.0, 20.0));
    simulator[floor].set_friction_coefficient(0.6);
    let mut bodies = Vec::new();
    for column in 0..1 + random.below(3) {
        let mut top = 0.0;
        for _ in 0..2 + random.below(8) {
            let (width, height) = (random.between(24.0, 40.0), random.between(16.0, 32.0));
            let (body, geom) =
                add_box(&mut simulator, (width, height), v(60.0 * column as f32, top - 0.5 * height));
            let mass = simulator[body].mass() * random.pick(&[1.0, 1.0, 1.0, 10.0, 100.0]);
            simulator[body].set_mass(mass).unwrap();
            simulator[geom].set_friction_coefficient(0.6);
            top -= height;
            bodies.push(body);
        }
    }
    for _ in 0..2 {
        let place = v(random.between(-10.0, 130.0), random.between(-700.0, -350.0));
        bodies.push(add_box(&mut simulator, (24.0, 24.0), place).0);
    }
    let far = random.between(300.0, 900.0);
    let (ball, _) = add_circle(&mut simulator, 10.0, 24, v(-far, random.between(-200.0, -20.0)));
    simulator[ball]
        .set_linear_velocity(v(random.between(100.0, 600.0), -0.5 * GRAVITY * random.between(0.5, 1.5)));
    bodies.push(ball);
    (simulator, bodies)
}

fn energy(simulator: &PhysicsSimulator, bodies: &[BodyId]) -> f32 {
    let of = |&body: &BodyId| {
        let body = &simulator[body];
        let (velocity, spin) = (body.linear_velocity(), body.angular_velocity());
        0.5 * body.mass() * velocity.norm_squared() + 0.5 * body.moment_of_inertia() * spin * spin
            - body.mass() * GRAVITY * body.position().y
    };
    bodies.iter().map(of).sum()
}

/// Number of bodies in islands that the direct solver solved.
fn in_wholes(simulator: &PhysicsSimulator) -> usize {
    let islands = simulator.islands();
    islands
        .iter()
        .filter(|island| island.method == IslandSolver::Direct)
        .map(|island| island.bodies.len())
        .sum()
}

/// Greatest excess of a body's motion in an update over the greater of its speeds before and after it.
fn furthest_aside(before: &PhysicsSimulator, after: &PhysicsSimulator, bodies: &[BodyId]) -> f32 {
    let aside = bodies.iter().map(|&body| {
        let (one, other) = (&before[body], &after[body]);
        let speed = one.linear_velocity().norm().max(other.linear_velocity().norm());
        (other.position() - one.position()).norm() - DT * speed
    });
    aside.fold(0.0, f32::max)
}

#[test]
fn a_change_of_solver_amid_motion_causes_no_jump_and_no_energy_gain() {
    let mut changes = 0;
    for seed in 0..100 {
        let (mut simulator, bodies) = towers(&mut Random::new(seed));
        for step in 0..400 {
            let before = simulator.clone();
            simulator.update(DT);
            if in_wholes(&simulator) == in_wholes(&before) || step == 0 {
                continue;
            }
            changes += 1;
            // A contact corrects overlaps with three units of length per second at most, and two of them act on the same body.
            let most = 2.0 * 3.0 * 32.0 * DT;
            let aside = furthest_aside(&before, &simulator, &bodies);
            assert!(aside < most + 1e-3, "seed {seed}, step {step}: {aside} px");
            // The height by which one of them may raise all of them.
            let mass: f32 = bodies.iter().map(|&body| simulator[body].mass()).sum();
            let gained = (energy(&simulator, &bodies) - energy(&before, &bodies)) / mass;
            assert!(gained < 0.5 * GRAVITY * most, "seed {seed}, step {step}: {gained} px2/s2");
        }
    }
    assert!(changes > 1000, "{changes}");
}
