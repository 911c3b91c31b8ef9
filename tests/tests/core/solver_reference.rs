//! The solver against a plain one: behaviour chapter 03, section 6, contact by contact in list order.
//!
//! The engine solves contacts in another order and several at a time; the bits must be those of this order.

use conformance::fixtures::plane::{
    self, Random, add_box, add_circle, add_floor, faithful_methods, simulator_with, v,
};
use farseer_core::math::scalar::{max, min};
use farseer_core::{Body, BodyId, Methods, PhysicsSimulator};

const DT: f32 = 0.01;

/// Linear and angular velocity.
type Velocity = ([f32; 2], f32);

#[derive(Clone, Copy)]
struct Mover {
    velocity: Velocity,
    bias: Velocity,
    position: [f32; 2],
    inverse_mass: f32,
    inverse_inertia: f32,
}

#[derive(Clone, Copy)]
struct Row {
    p: [f32; 2],
    n: [f32; 2],
    separation: f32,
    normal_mass: f32,
    tangent_mass: f32,
    target_bias: f32,
    bounce: f32,
    jn: f32,
    jt: f32,
    jb: f32,
}

struct Pair {
    a: usize,
    b: usize,
    rows: std::ops::Range<usize>,
    friction: f32,
    restitution: f32,
    has_response: bool,
}

struct Plain {
    ids: Vec<BodyId>,
    movers: Vec<Mover>,
    pairs: Vec<Pair>,
    rows: Vec<Row>,
}

fn dot(a: [f32; 2], b: [f32; 2]) -> f32 {
    (a[0] * b[0]) + (a[1] * b[1])
}

fn minus(a: [f32; 2], b: [f32; 2]) -> [f32; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn velocity_at((linear, angular): Velocity, r: [f32; 2]) -> [f32; 2] {
    [((-angular) * r[1]) + linear[0], (angular * r[0]) + linear[1]]
}

fn push(velocity: &mut Velocity, impulse: [f32; 2], r: [f32; 2], inverse_mass: f32, inverse_inertia: f32) {
    velocity.0[0] += impulse[0] * inverse_mass;
    velocity.0[1] += impulse[1] * inverse_mass;
    let turn = (r[0] * impulse[1]) - (r[1] * impulse[0]);
    velocity.1 += turn * inverse_inertia;
}

fn mover(body: &Body) -> Mover {
    Mover {
        velocity: ([body.linear_velocity().x, body.linear_velocity().y], body.angular_velocity()),
        bias: ([0.0; 2], 0.0),
        position: [body.position().x, body.position().y],
        inverse_mass: body.inverse_mass(),
        inverse_inertia: body.inverse_moment_of_inertia(),
    }
}

impl Plain {
    /// Input of the solver: after the forces, before the pre-step.
    fn new(simulator: &PhysicsSimulator) -> Plain {
        let ids = simulator.body_list().to_vec();
        let movers = ids.iter().map(|&id| mover(&simulator[id])).collect();
        let mut plain = Plain { ids, movers, pairs: Vec::new(), rows: Vec::new() };
        // The list may hold one arbiter twice, which has its contacts once.
        let mut known: Vec<(farseer_core::ArbiterRef<'_>, usize)> = Vec::new();
        for arbiter in simulator.arbiters() {
            let known_at = known.iter().find(|(known, _)| known.is_same(&arbiter)).map(|(_, row)| *row);
            let first = known_at.unwrap_or_else(|| {
                known.push((arbiter, plain.rows.len()));
                let first = plain.rows.len();
                plain.rows.extend(arbiter.contacts().map(|contact| Row {
                    p: [contact.position.x, contact.position.y],
                    n: [contact.normal.x, contact.normal.y],
                    separation: contact.separation,
                    normal_mass: 0.0,
                    tangent_mass: 0.0,
                    target_bias: 0.0,
                    bounce: 0.0,
                    jn: contact.normal_impulse(),
                    jt: contact.tangent_impulse(),
                    jb: 0.0,
                }));
                first
            });
            let [a, b] = [arbiter.geom_a(), arbiter.geom_b()].map(|geom| simulator.geom(geom).unwrap());
            let index = |id: BodyId| plain.ids.iter().position(|&other| other == id).unwrap();
            plain.pairs.push(Pair {
                a: index(a.body()),
                b: index(b.body()),
                rows: first..first + arbiter.contacts().len(),
                friction: arbiter.friction(),
                restitution: (a.restitution_coefficient() + b.restitution_coefficient()) * 0.5,
                has_response: a.collision_response_enabled() && b.collision_response_enabled(),
            });
        }
        plain
    }

    /// Adds an impulse to B and subtracts it from A.
    fn push_pair(&mut self, pair: &Pair, impulse: [f32; 2], r1: [f32; 2], r2: [f32; 2]) {
        let b = &mut self.movers[pair.b];
        push(&mut b.velocity, impulse, r2, b.inverse_mass, b.inverse_inertia);
        let a = &mut self.movers[pair.a];
        push(&mut a.velocity, [-impulse[0], -impulse[1]], r1, a.inverse_mass, a.inverse_inertia);
    }

    fn relative(&self, pair: &Pair, r1: [f32; 2], r2: [f32; 2]) -> [f32; 2] {
        minus(velocity_at(self.movers[pair.b].velocity, r2), velocity_at(self.movers[pair.a].velocity, r1))
    }

    fn pre_step(&mut self, simulator: &PhysicsSimulator) {
        let inverse_dt = 1.0 / DT;
        for pair in std::mem::take(&mut self.pairs) {
            for index in pair.rows.clone().filter(|_| pair.has_response) {
                let (a, b, mut row) = (self.movers[pair.a], self.movers[pair.b], self.rows[index]);
                let n = row.n;
                let t = [n[1], -n[0]];
                let (r1, r2) = (minus(row.p, a.position), minus(row.p, b.position));
                let (rn1, rn2, rt1, rt2) = (dot(r1, n), dot(r2, n), dot(r1, t), dot(r2, t));
                let (d1, d2) = (dot(r1, r1), dot(r2, r2));
                let m = a.inverse_mass + b.inverse_mass;
                let (ia, ib) = (a.inverse_inertia, b.inverse_inertia);
                row.normal_mass = 1.0 / ((m + (ia * (d1 - (rn1 * rn1)))) + (ib * (d2 - (rn2 * rn2))));
                row.tangent_mass = 1.0 / (m + ((ia * (d1 - (rt1 * rt1))) + (ib * (d2 - (rt2 * rt2)))));
                let excess = min(0.0, simulator.allowed_penetration() + row.separation);
                row.target_bias = ((-simulator.bias_factor()) * inverse_dt) * excess;
                row.bounce = dot(self.relative(&pair, r1, r2), n) * pair.restitution;
                let impulse = [(n[0] * row.jn) + (t[0] * row.jt), (n[1] * row.jn) + (t[1] * row.jt)];
                self.push_pair(&pair, impulse, r1, r2);
                row.jb = 0.0;
                self.rows[index] = row;
            }
            self.pairs.push(pair);
        }
    }

    fn pass(&mut self) {
        for pair in std::mem::take(&mut self.pairs) {
            for index in pair.rows.clone().filter(|_| pair.has_response) {
                let mut row = self.rows[index];
                let n = row.n;
                let t = [n[1], -n[0]];
                let r1 = minus(row.p, self.movers[pair.a].position);
                let r2 = minus(row.p, self.movers[pair.b].position);

                let vn = dot(self.relative(&pair, r1, r2), n);
                let old = row.jn;
                row.jn = max(old + (row.normal_mass * (-(vn + row.bounce))), 0.0);
                let x = row.jn - old;
                self.push_pair(&pair, [n[0] * x, n[1] * x], r1, r2);

                let (bias_a, bias_b) = (self.movers[pair.a].bias, self.movers[pair.b].bias);
                let vb = dot(minus(velocity_at(bias_b, r2), velocity_at(bias_a, r1)), n);
                let old = row.jb;
                row.jb = max(old + (row.normal_mass * ((-vb) + row.target_bias)), 0.0);
                let x = row.jb - old;
                let impulse = [n[0] * x, n[1] * x];
                let b = &mut self.movers[pair.b];
                push(&mut b.bias, impulse, r2, b.inverse_mass, b.inverse_inertia);
                let a = &mut self.movers[pair.a];
                push(&mut a.bias, [-impulse[0], -impulse[1]], r1, a.inverse_mass, a.inverse_inertia);

                let limit = pair.friction * row.jn;
                let vt = dot(self.relative(&pair, r1, r2), t);
                let old = row.jt;
                row.jt = max(-limit, min(old + (row.tangent_mass * (-vt)), limit));
                let x = row.jt - old;
                self.push_pair(&pair, [t[0] * x, t[1] * x], r1, r2);
                self.rows[index] = row;
            }
            self.pairs.push(pair);
        }
    }

    /// Velocities, then positions and rotations one step later, then impulses.
    fn bits(&self, before: &PhysicsSimulator) -> Vec<u32> {
        let mut bits = Vec::new();
        for (&id, mover) in self.ids.iter().zip(&self.movers) {
            let body = &before[id];
            let (mut position, mut rotation) = (mover.position, body.rotation());
            if !body.is_static() && body.enabled() {
                position[0] += (mover.velocity.0[0] + mover.bias.0[0]) * DT;
                position[1] += (mover.velocity.0[1] + mover.bias.0[1]) * DT;
                let turn = (mover.velocity.1 + mover.bias.1) * DT;
                if turn != 0.0 {
                    let mut turned = Body::new();
                    turned.set_rotation(rotation + turn);
                    rotation = turned.rotation();
                }
            }
            let [x, y] = mover.velocity.0;
            bits.extend([x, y, mover.velocity.1, position[0], position[1], rotation].map(f32::to_bits));
        }
        for pair in &self.pairs {
            bits.extend(
                self.rows[pair.rows.clone()].iter().flat_map(|row| [row.jn.to_bits(), row.jt.to_bits()]),
            );
        }
        bits
    }
}

/// The same of the engine.
fn engine_bits(simulator: &PhysicsSimulator) -> Vec<u32> {
    let mut bits = Vec::new();
    for &id in simulator.body_list() {
        let body = &simulator[id];
        let (velocity, position) = (body.linear_velocity(), body.position());
        let floats =
            [velocity.x, velocity.y, body.angular_velocity(), position.x, position.y, body.rotation()];
        bits.extend(floats.map(f32::to_bits));
    }
    for arbiter in simulator.arbiters() {
        let impulses =
            |c: farseer_core::Contact| [c.normal_impulse().to_bits(), c.tangent_impulse().to_bits()];
        bits.extend(arbiter.contacts().flat_map(impulses));
    }
    bits
}

/// Runs one update by its stages and compares. Returns the number of contacts; `None` if a body stopped being finite, where the
/// engine does not follow the original.
fn step_and_compare(simulator: &mut PhysicsSimulator, what: &str) -> Option<usize> {
    assert!(simulator.process_queues(DT, None));
    simulator.find_pairs(None);
    simulator.collide_pairs(None);
    simulator.apply_forces(DT, 0.0, None);
    let mut plain = Plain::new(simulator);
    let before = simulator.clone();
    plain.pre_step(&before);
    simulator.pre_step(1.0 / DT);
    for _ in 0..simulator.iterations() {
        plain.pass();
        simulator.solve_iteration(None);
    }
    simulator.integrate(DT, None);
    if !plane::not_finite(simulator).is_empty() {
        return None;
    }
    assert_eq!(engine_bits(simulator), plain.bits(&before), "{what}");
    Some(plain.rows.len())
}

/// A heap between walls, with belts that move and turn, response switched off here and there, bodies of two geoms, and
/// masses between a feather and a ship. Zeros of both signs are among the velocities.
fn heap(methods: Methods, seed: u64) -> PhysicsSimulator {
    let mut random = Random::new(seed);
    let mut simulator = simulator_with(random.pick(&[0.0, 200.0, 400.0]), methods);
    simulator.set_iterations(random.pick(&[1, 5, 8]));
    simulator.set_max_contacts_to_resolve(random.pick(&[2, 4, 9])).unwrap();
    for (size, position) in
        [((500.0, 40.0), v(0.0, 220.0)), ((40.0, 500.0), v(-220.0, 0.0)), ((40.0, 500.0), v(220.0, 0.0))]
    {
        let (belt, geom) = add_floor(&mut simulator, size, position);
        simulator[geom].set_friction_coefficient(random.between(0.0, 1.0));
        let speed = random.pick(&[0.0, -0.0, 30.0, -30.0]);
        simulator[belt].set_linear_velocity(v(speed, random.pick(&[0.0, -0.0, 5.0])));
        simulator[belt].set_angular_velocity(random.pick(&[0.0, -0.0, 0.1]));
    }
    for i in 0..26 {
        let position = v((i % 8) as f32 * 48.0 - 170.0, 190.0 - (i / 8) as f32 * 36.0);
        let (body, geom) = if random.below(3) == 0 {
            add_circle(&mut simulator, random.between(10.0, 26.0), 12, position)
        } else {
            let size = (random.between(20.0, 50.0), random.between(20.0, 40.0));
            add_box(&mut simulator, size, position)
        };
        simulator[geom].set_friction_coefficient(random.pick(&[0.0, 0.3, 1.5]));
        simulator[geom].set_restitution_coefficient(random.pick(&[0.0, 0.3, 1.0]));
        simulator[geom].set_collision_response_enabled(random.below(12) != 0);
        simulator[body].set_mass(random.pick(&[0.01, 1.0, 1.0, 1.0, 500.0])).unwrap();
        simulator[body].set_moment_of_inertia(random.pick(&[1.0, 100.0, 1e6])).unwrap();
        simulator[body].set_linear_velocity(v(random.between(-99.0, 99.0), random.pick(&[-0.0, 0.0, 60.0])));
        simulator[body].set_angular_velocity(random.pick(&[-0.0, 0.0, 2.0, -3.0]));
        simulator[body].set_is_static(random.below(10) == 0);
        if random.below(5) == 0 {
            let second = simulator.clone_geom_with_offset(body, geom, v(15.0, 5.0), 0.4).unwrap();
            simulator.add(second).unwrap();
        }
    }
    simulator
}

#[test]
fn heaps_are_solved_to_the_bits_of_list_order() {
    for methods in faithful_methods() {
        let mut contacts = 0;
        for seed in 0..12 {
            let mut simulator = heap(methods, seed);
            for step in 0..60 {
                if step % 20 == 15 {
                    // Duplicates and shared arbiters follow.
                    let geom = simulator.geom_list()[4 + step / 20];
                    simulator.remove(geom).unwrap();
                }
                let what = format!("{methods:?} seed {seed} step {step}");
                let Some(compared) = step_and_compare(&mut simulator, &what) else { break };
                contacts += compared;
            }
        }
        // The original sends the lightest bodies to infinity now and then, which is not compared.
        assert!(contacts > 12 * 60 * 20, "{methods:?}: only {contacts} contacts");
    }
}

#[test]
fn a_resting_pile_is_solved_to_the_bits_of_list_order() {
    for methods in faithful_methods() {
        let mut simulator = simulator_with(100.0, methods);
        add_floor(&mut simulator, (400.0, 20.0), v(0.0, 100.0));
        for i in 0..24 {
            let (_, geom) =
                add_box(&mut simulator, (20.0, 20.0), v((i % 6) as f32 * 22.0, 80.0 - (i / 6) as f32 * 20.0));
            simulator[geom].set_friction_coefficient(0.5);
        }
        for step in 0..200 {
            let contacts = step_and_compare(&mut simulator, &format!("{methods:?} step {step}"));
            assert!(contacts.is_some_and(|contacts| step < 2 || contacts > 40), "{methods:?} {contacts:?}");
        }
    }
}

#[test]
fn zeros_of_either_sign_equal_those_of_list_order() {
    for seed in 0..40 {
        let mut random = Random::new(seed);
        let mut simulator = simulator_with(0.0, Default::default());
        let (floor, _) = add_floor(&mut simulator, (400.0, 20.0), v(0.0, 0.0));
        let zeros = [0.0, -0.0];
        let mut zero = || random.pick(&zeros);
        simulator[floor].set_linear_velocity(v(zero(), zero()));
        simulator[floor].set_angular_velocity(zero());
        for i in 0..9 {
            // Overlapping by less than the allowed penetration, at rest: all values are zero.
            let (body, _) = add_box(&mut simulator, (20.0, 20.0), v(i as f32 * 30.0 - 130.0, -19.98));
            simulator[body].set_linear_velocity(v(zero(), zero()));
            simulator[body].set_angular_velocity(zero());
        }
        for step in 0..4 {
            let contacts = step_and_compare(&mut simulator, &format!("seed {seed} step {step}"));
            assert!(contacts.is_some_and(|contacts| contacts > 8), "{contacts:?}");
        }
    }
}
