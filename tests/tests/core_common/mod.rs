//! What the tests of the core share: small scenes, a number generator, and the bits of a simulator.

// Every test program uses a part of it.
#![allow(dead_code)]

use farseer_core::math::Vector2;
use farseer_core::{
    Body, BodyFactory, BodyId, BroadPhaseCollider, Contact, Event, GeomFactory, GeomId, GeomPlacement,
    NarrowPhaseCollider, PhysicsSimulator,
};

pub(crate) fn v(x: f32, y: f32) -> Vector2 {
    Vector2::new(x, y)
}

pub(crate) const BROAD_PHASES: [BroadPhaseCollider; 4] = [
    BroadPhaseCollider::SelectiveSweep,
    BroadPhaseCollider::SweepAndPrune,
    BroadPhaseCollider::BruteForce,
    BroadPhaseCollider::SPATIAL_HASH,
];

pub(crate) const NARROW_PHASES: [NarrowPhaseCollider; 2] =
    [NarrowPhaseCollider::DistanceGrid, NarrowPhaseCollider::Sat];

/// Every broad phase with every narrow phase.
pub(crate) fn methods() -> impl Iterator<Item = (BroadPhaseCollider, NarrowPhaseCollider)> {
    BROAD_PHASES.into_iter().flat_map(|broad| NARROW_PHASES.into_iter().map(move |narrow| (broad, narrow)))
}

pub(crate) fn simulator(gravity: f32) -> PhysicsSimulator {
    PhysicsSimulator::new(v(0.0, gravity)).unwrap()
}

pub(crate) fn simulator_with(
    gravity: f32,
    (broad, narrow): (BroadPhaseCollider, NarrowPhaseCollider),
) -> PhysicsSimulator {
    let mut simulator = simulator(gravity);
    simulator.set_broad_phase_collider(broad).unwrap();
    simulator.set_narrow_phase_collider(narrow);
    simulator
}

/// A dynamic box of mass 1, both body and geom added.
pub(crate) fn add_box(
    simulator: &mut PhysicsSimulator,
    (width, height): (f32, f32),
    position: Vector2,
) -> (BodyId, GeomId) {
    let body = BodyFactory::create_rectangle_body_in(simulator, width, height, 1.0).unwrap();
    simulator[body].set_position(position);
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_rectangle_geom_in(simulator, body, width, height, placement).unwrap();
    (body, geom)
}

/// A static box.
pub(crate) fn add_floor(
    simulator: &mut PhysicsSimulator,
    (width, height): (f32, f32),
    position: Vector2,
) -> (BodyId, GeomId) {
    let (body, geom) = add_box(simulator, (width, height), position);
    simulator[body].set_is_static(true);
    (body, geom)
}

/// A dynamic circle of mass 1.
pub(crate) fn add_circle(
    simulator: &mut PhysicsSimulator,
    radius: f32,
    edges: i32,
    position: Vector2,
) -> (BodyId, GeomId) {
    let body = BodyFactory::create_circle_body_in(simulator, radius, 1.0).unwrap();
    simulator[body].set_position(position);
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_circle_geom_in(simulator, body, radius, edges, placement).unwrap();
    (body, geom)
}

/// Bits of a body that a game can see.
pub(crate) fn body_bits(body: &Body) -> Vec<u32> {
    let floats = [
        body.position().x,
        body.position().y,
        body.rotation(),
        body.total_rotation(),
        body.linear_velocity().x,
        body.linear_velocity().y,
        body.angular_velocity(),
        body.get_velocity_bias_at_world_offset(v(0.0, 0.0)).x,
        body.get_velocity_bias_at_world_offset(v(0.0, 0.0)).y,
        body.force().x,
        body.force().y,
        body.torque(),
        body.mass(),
        body.inverse_mass(),
        body.moment_of_inertia(),
        body.inverse_moment_of_inertia(),
    ];
    let mut bits: Vec<u32> = floats.iter().map(|x| x.to_bits()).collect();
    bits.extend([body.revolutions() as u32, body.enabled().into(), body.is_static().into()]);
    bits
}

fn contact_bits(contact: &Contact) -> [u32; 10] {
    let Contact { id, position, normal, separation, .. } = *contact;
    let floats = [position.x, position.y, normal.x, normal.y, separation];
    let [a, b, c, d, e] = floats.map(f32::to_bits);
    let impulses = [contact.normal_impulse(), contact.tangent_impulse()].map(f32::to_bits);
    [id.geom1, id.vertex as u32, id.geom2, a, b, c, d, e, impulses[0], impulses[1]]
}

/// Everything that can be seen of a simulator's state: bodies in list order, then pairs with their contacts.
pub(crate) fn state(simulator: &PhysicsSimulator) -> Vec<u32> {
    let mut bits: Vec<u32> =
        simulator.body_list().iter().flat_map(|&body| body_bits(&simulator[body])).collect();
    for arbiter in simulator.arbiters() {
        let number = |geom| simulator.geom(geom).unwrap().id();
        bits.extend([number(arbiter.geom_a()), number(arbiter.geom_b()), arbiter.friction().to_bits()]);
        bits.extend(arbiter.contacts().iter().flat_map(contact_bits));
    }
    bits
}

/// Whether position, rotation and velocities of all listed bodies are finite.
pub(crate) fn is_finite(simulator: &PhysicsSimulator) -> bool {
    simulator.body_list().iter().all(|&body| body_is_finite(&simulator[body]))
}

pub(crate) fn body_is_finite(body: &Body) -> bool {
    [
        body.position().x,
        body.position().y,
        body.rotation(),
        body.total_rotation(),
        body.linear_velocity().x,
        body.linear_velocity().y,
        body.angular_velocity(),
    ]
    .iter()
    .all(|x| x.is_finite())
}

/// The creation numbers of all pairs that touch, in the order in which they are solved.
pub(crate) fn pairs(simulator: &PhysicsSimulator) -> Vec<(u32, u32)> {
    let number = |geom| simulator.geom(geom).unwrap().id();
    simulator.arbiters().map(|arbiter| (number(arbiter.geom_a()), number(arbiter.geom_b()))).collect()
}

/// The arguments reported as refused by the last update.
pub(crate) fn rejected(simulator: &PhysicsSimulator) -> Vec<&'static str> {
    let argument = |event: &Event| match event {
        Event::RejectedInput { argument, .. } => Some(*argument),
        _ => None,
    };
    simulator.events().iter().filter_map(argument).collect()
}

/// The bodies reported as not finite by the last update.
pub(crate) fn not_finite(simulator: &PhysicsSimulator) -> Vec<(BodyId, bool)> {
    let body = |event: &Event| match event {
        Event::NotFinite { body, disabled } => Some((*body, *disabled)),
        _ => None,
    };
    simulator.events().iter().filter_map(body).collect()
}

/// A small generator of numbers, the same on every machine.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    pub(crate) fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as u32
    }

    /// From 0 up to, not including, `limit`.
    pub(crate) fn below(&mut self, limit: usize) -> usize {
        self.next() as usize % limit
    }

    pub(crate) fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * (self.next() % 65536) as f32 / 65536.0
    }

    pub(crate) fn pick<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }
}

/// A walled box with two layers of things that fall, roll and pile up; the second body of every third is fast. All
/// coordinates are multiples of 1/4, so that boxes have many interval ends in common.
pub(crate) fn lively_scene(
    methods: (BroadPhaseCollider, NarrowPhaseCollider),
    seed: u64,
) -> PhysicsSimulator {
    let mut simulator = simulator_with(200.0, methods);
    let mut random = Random::new(seed);
    for (size, position) in
        [((600.0, 40.0), v(0.0, 320.0)), ((40.0, 700.0), v(-320.0, 0.0)), ((40.0, 700.0), v(320.0, 0.0))]
    {
        let (_, geom) = add_floor(&mut simulator, size, position);
        simulator[geom].set_friction_coefficient(0.5);
    }
    for i in 0..28 {
        let position = v((i % 7) as f32 * 60.0 - 180.0, 280.0 - (i / 7) as f32 * 50.0);
        let quarters =
            |random: &mut Random, low: usize, high: usize| (low + random.below(high - low)) as f32 / 4.0;
        let (body, geom) = if i % 3 == 2 {
            let edges = 8 + random.below(8) as i32;
            add_circle(&mut simulator, quarters(&mut random, 40, 80), edges, position)
        } else {
            let size = (quarters(&mut random, 80, 160), quarters(&mut random, 80, 160));
            add_box(&mut simulator, size, position)
        };
        simulator[geom].set_friction_coefficient(random.between(0.0, 0.8));
        simulator[geom].set_restitution_coefficient(random.between(0.0, 0.5));
        if i % 3 == 1 {
            simulator[body]
                .set_linear_velocity(v(random.between(-300.0, 300.0), random.between(-300.0, 0.0)));
            simulator[body].set_angular_velocity(random.between(-5.0, 5.0));
        }
    }
    simulator
}

/// What a game does to a lively scene while it runs: things are removed, added again, disposed, made and moved.
#[derive(Clone, Default)]
pub(crate) struct Game {
    step: u32,
    removed: Vec<GeomId>,
}

impl Game {
    /// One update, with whatever is due before it.
    pub(crate) fn step(&mut self, simulator: &mut PhysicsSimulator) {
        self.act(simulator);
        simulator.update(0.01);
        self.step += 1;
    }

    fn act(&mut self, simulator: &mut PhysicsSimulator) {
        let body = |index: usize| simulator.body_list()[index % simulator.body_list().len()];
        match self.step {
            25 | 60 => simulator.dispose(body(9)).unwrap(),
            30 | 65 => {
                let geom = simulator.geom_list()[8];
                simulator.remove(geom).unwrap();
                self.removed.push(geom);
            }
            40 => simulator.add(self.removed[0]).unwrap(),
            45 => {
                let (body, _) = add_box(simulator, (20.0, 20.0), v(0.0, -200.0));
                simulator[body].set_rotation(0.3);
            }
            50 => {
                let body = body(12);
                simulator[body].set_enabled(false);
            }
            55 => {
                for &body in &simulator.body_list().to_vec() {
                    simulator[body].set_enabled(true);
                }
            }
            70 => {
                let body = body(6);
                simulator.remove(body).unwrap();
            }
            75 => {
                let body = body(15);
                let position = simulator[body].position();
                simulator[body].set_position(position - v(0.0, 30.0));
                simulator[body].apply_impulse(v(100.0, 0.0));
            }
            _ => {}
        }
    }
}
