//! Random joint scenes: figures of a few parts with joints of every kind and loops, of any mass ratio.

use super::assembly::{Assembly, JointKind};
use crate::method::unit;
use std::f32::consts::TAU;

/// Length of a run in updates of 1/60 s.
pub const UPDATES: u32 = 360;
/// Most random numbers of a scene: seeds share none.
const NUMBERS: u64 = 1 << 20;
/// Limits of a hinge in rad.
const LIMITS: [f32; 2] = [-0.5, 0.5];

/// Collisions in a random scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Crowd {
    /// One figure whose parts do not collide, in a room.
    One,
    /// One figure whose parts collide, in a room.
    Colliding,
    /// Four figures that collide, and whose parts do not, in a room.
    Four,
    /// One figure whose parts overlap and collide, without gravity and room.
    Weightless,
}

/// How a random scene is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Variant {
    /// The collisions of the scene.
    pub crowd: Crowd,
    /// The greatest mass by the least: 1 or more.
    pub mass_ratio: f32,
}

/// All variants.
pub fn variants() -> impl Iterator<Item = Variant> {
    let crowds = [Crowd::One, Crowd::Colliding, Crowd::Four, Crowd::Weightless];
    crowds.into_iter().flat_map(|crowd| [1.0, 20.0, 400.0].map(|mass_ratio| Variant { crowd, mass_ratio }))
}

impl Variant {
    /// Its name in tables.
    pub fn name(self) -> String {
        format!("{:?}, mass ratio {}", self.crowd, self.mass_ratio).to_lowercase()
    }

    /// Energy in kg px²/s² of 1 kg that a scene may win: that of a fall of a room's 60 px, or of a figure without gravity
    /// that moves at 140 px/s.
    pub fn energy_bound(self) -> f64 {
        if self.crowd == Crowd::Weightless { 100.0 * 100.0 } else { 600.0 * 60.0 }
    }
}

/// Numbers that follow from a seed.
struct Random {
    next: u64,
}

impl Random {
    fn between(&mut self, low: f32, high: f32) -> f32 {
        self.next += 1;
        low + (high - low) * unit(self.next)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.between(0.0, count as f32) as usize).min(count - 1)
    }

    fn chance(&mut self, share: f32) -> bool {
        self.between(0.0, 1.0) < share
    }
}

/// The scene of a seed: equal seeds give equal scenes.
pub fn scene(seed: u64, variant: Variant) -> Assembly {
    let mut random = Random { next: seed.wrapping_mul(NUMBERS) };
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

/// A figure of 3 to 9 parts, with up to two loops, and in three of ten scenes held by a post.
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

/// A circle in three of ten cases, else a rectangle.
fn part(assembly: &mut Assembly, place: [f32; 2], mass: f32, group: i32, random: &mut Random) -> usize {
    if random.chance(0.3) {
        return assembly.circle(place, random.between(6.0, 20.0), mass, group);
    }
    let size = [random.between(8.0, 60.0), random.between(6.0, 30.0)];
    let body = assembly.rectangle(place, size, mass, group);
    assembly.bodies[body].angle = random.between(-1.5, 1.5);
    body
}

/// A joint midway between two bodies: three of eight are hinges, one a hinge with limits, two welds, one a rod, one a
/// slider.
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

/// A second joint between two bodies of a figure, which may close a loop.
fn close(assembly: &mut Assembly, one: usize, two: usize, is_rod: bool) {
    match (one == two, is_rod) {
        (true, _) => {}
        (false, true) => assembly.rod(one, two),
        (false, false) => assembly.hinge(one, two, assembly.bodies[two].position),
    }
}
