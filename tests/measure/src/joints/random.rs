//! Random joint scenes: articulated figures of 3 to 9 bodies, with joints of every kind, loops, and any mass ratio.

use super::assembly::{Assembly, JointKind};
use crate::method::unit;
use std::f32::consts::TAU;

/// Length of a run in updates of 1/60 s each.
pub const UPDATES: u32 = 360;
/// Greatest number of random numbers that a scene uses, so that two seeds use none in common.
const NUMBERS: u64 = 1 << 20;
/// Least and greatest angle of a hinge with limits, in rad.
const LIMITS: [f32; 2] = [-0.5, 0.5];

/// Number of figures in a random scene, and which of the bodies collide.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Crowd {
    /// One figure in a room; bodies of the figure do not collide with each other.
    One,
    /// One figure in a room; bodies of the figure collide with each other.
    Colliding,
    /// Four figures in a room; figures collide, bodies of the same figure do not.
    Four,
    /// One figure without gravity and room; bodies of the figure overlap at the start and collide with each other.
    Weightless,
}

/// Parameters of a random scene apart from its seed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Variant {
    /// Figures and collisions of the scene.
    pub crowd: Crowd,
    /// Ratio of the greatest possible mass to the least, dimensionless, >= 1.
    pub mass_ratio: f32,
}

/// Returns all twelve combinations of [`Crowd`] and mass ratio 1, 20 or 400.
pub fn variants() -> impl Iterator<Item = Variant> {
    let crowds = [Crowd::One, Crowd::Colliding, Crowd::Four, Crowd::Weightless];
    crowds.into_iter().flat_map(|crowd| [1.0, 20.0, 400.0].map(|mass_ratio| Variant { crowd, mass_ratio }))
}

impl Variant {
    /// Returns the name of the variant in tables.
    pub fn name(self) -> String {
        format!("{:?}, mass ratio {}", self.crowd, self.mass_ratio).to_lowercase()
    }

    /// Returns the greatest permitted energy gain per mass, in px²/s²: 600 px/s² times a fall of 60 px. Without gravity it
    /// is the square of 100 px/s, the kinetic energy of motion at 141 px/s.
    pub fn energy_bound(self) -> f64 {
        if self.crowd == Crowd::Weightless { 100.0 * 100.0 } else { 600.0 * 60.0 }
    }
}

/// Generator of pseudo-random numbers that depend on the seed alone.
pub(crate) struct Random {
    next: u64,
}

impl Random {
    /// Creates the generator of a seed.
    pub(crate) fn new(seed: u64) -> Self {
        Random { next: seed.wrapping_mul(NUMBERS) }
    }

    /// Returns a number from `low` to `high` whose logarithm is uniformly distributed; both > 0.
    pub(crate) fn log_between(&mut self, low: f32, high: f32) -> f32 {
        low * (high / low).powf(self.between(0.0, 1.0))
    }

    /// Returns a uniformly distributed number from `low` to `high`.
    pub(crate) fn between(&mut self, low: f32, high: f32) -> f32 {
        self.next += 1;
        low + (high - low) * unit(self.next)
    }

    /// Returns a whole number from 0 to `count - 1`.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.between(0.0, count as f32) as usize).min(count - 1)
    }

    /// Returns true with a probability of `share`.
    pub(crate) fn chance(&mut self, share: f32) -> bool {
        self.between(0.0, 1.0) < share
    }
}

/// Returns the scene of a seed: equal seeds give equal scenes.
pub fn scene(seed: u64, variant: Variant) -> Assembly {
    let mut random = Random::new(seed);
    let friction = random.between(0.2, 0.9);
    let is_weightless = variant.crowd == Crowd::Weightless;
    let mut assembly = Assembly::new(if is_weightless { 0.0 } else { 600.0 }, friction);
    if !is_weightless {
        assembly.wall([0.0, 32.0], [4000.0, 64.0]);
        for x in [-300.0, 300.0] {
            assembly.wall([x, -200.0], [40.0, 400.0]);
        }
    }
    let figures = if variant.crowd == Crowd::Four { 4 } else { 1 };
    (0..figures).for_each(|index| figure(&mut assembly, variant, index, &mut random));
    assembly
}

/// Adds a figure of 3 to 9 bodies with up to two loops; with a probability of 0.3 it is joined to a static post.
fn figure(assembly: &mut Assembly, variant: Variant, index: i32, random: &mut Random) {
    let does_collide = matches!(variant.crowd, Crowd::Colliding | Crowd::Weightless);
    let group = if does_collide { 0 } else { index + 1 };
    let first = assembly.bodies.len();
    let count = 3 + random.below(7);
    for made in 0..count {
        let [x, y] = match made {
            0 => [random.between(-150.0, 150.0), -120.0 - 120.0 * index as f32],
            made => assembly.bodies[first + random.below(made)].position,
        };
        let reach = if made == 0 { 0.0 } else { 40.0 };
        let place = [x + random.between(-reach, reach), y + random.between(-reach, reach)];
        let mass = variant.mass_ratio.powf(random.between(-0.5, 0.5));
        let body = part(assembly, place, mass, group, random);
        if made > 0 {
            let other = first + random.below(made);
            join(assembly, other, body, random);
        }
    }
    for _ in 0..random.below(3) {
        let (one, two) = (first + random.below(count), first + random.below(count));
        let is_rod = random.chance(0.5);
        close(assembly, one, two, is_rod);
    }
    if random.chance(0.3) {
        let [x, y] = assembly.bodies[first].position;
        let post = assembly.post([x, y - 30.0]);
        match random.chance(0.5) {
            true => assembly.hinge(post, first, [x, y - 30.0]),
            false => assembly.rod(post, first),
        }
    }
}

/// Adds a body with a mass in kg and returns its index: a circle with a probability of 0.3, else a rectangle. `place` in px.
fn part(assembly: &mut Assembly, place: [f32; 2], mass: f32, group: i32, random: &mut Random) -> usize {
    if random.chance(0.3) {
        return assembly.circle(place, random.between(6.0, 20.0), mass, group);
    }
    let size = [random.between(8.0, 60.0), random.between(6.0, 30.0)];
    let body = assembly.rectangle(place, size, mass, group);
    assembly.bodies[body].angle = random.between(-1.5, 1.5);
    body
}

/// Adds a joint between two bodies, midway between the centres. Of eight joints, on average three are hinges, one is a hinge
/// with limits, two are welds, one is a rod and one a slider.
fn join(assembly: &mut Assembly, one: usize, two: usize, random: &mut Random) {
    let [[x1, y1], [x2, y2]] = [one, two].map(|body| assembly.bodies[body].position);
    let anchor = [0.5 * (x1 + x2), 0.5 * (y1 + y2)];
    match random.below(8) {
        0..3 => assembly.hinge(one, two, anchor),
        3 => assembly.joint(one, two, JointKind::Hinge { anchor, limits: Some(LIMITS), motor: None }),
        4..6 => assembly.weld(one, two, anchor),
        6 => assembly.rod(one, two),
        _ => {
            let angle = random.between(0.0, TAU);
            assembly.slider(one, two, anchor, [angle.cos(), angle.sin()]);
        }
    }
}

/// Adds another joint between two bodies of a figure, which may close a loop; none if both are the same body.
fn close(assembly: &mut Assembly, one: usize, two: usize, is_rod: bool) {
    match (one == two, is_rod) {
        (true, _) => {}
        (false, true) => assembly.rod(one, two),
        (false, false) => assembly.hinge(one, two, assembly.bodies[two].position),
    }
}
