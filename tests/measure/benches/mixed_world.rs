//! Measures a world of parts with very different sizes, with the precise set. The world must take no more time than all of its
//! parts together, each measured alone.
//!
//! `cargo bench -p measure --bench mixed_world` prints the time per step of each part and of the world, and their ratio. No
//! bodies touch, so the world has no more contacts than its parts. Any additional time is spent in the broad phase or in loops
//! over all objects.

use std::time::Instant;

use conformance::fixtures::plane::{add_box, add_floor, simulator_with, v};
use farseer_core::{BodyId, Methods, PhysicsSimulator};

const DT: f32 = 1.0 / 60.0;
const UPDATES: usize = 300;
const ROUNDS: usize = 9;
/// Number of bodies or tiles in a row. `APART` is the distance between two of them, px.
const ROW: usize = 50;
const APART: f32 = 100.0;
/// Speed in px/s of a bullet. It flies past all other bodies in a lane between two rows.
const BULLET: f32 = 20_000.0;

#[derive(Clone, Copy, Default)]
struct Parts {
    bodies: bool,
    tiles: bool,
    giant: bool,
    bullet: bool,
}

struct World {
    simulator: PhysicsSimulator,
    bullet: Option<BodyId>,
}

impl World {
    fn new(parts: Parts) -> Self {
        let mut simulator = simulator_with(0.0, Methods::PRECISE);
        let place = |number: usize| v((number % ROW) as f32 * APART, (number / ROW) as f32 * APART);
        // Tiles are built before the bodies that move among them. If bodies and tiles were created alternately, tiles would lie
        // between the bodies in memory: 2,000 flying bodies would take 7 % longer for that alone.
        for number in (0..2000).filter(|_| parts.tiles) {
            add_floor(&mut simulator, (90.0, 20.0), place(number) + v(0.0, 0.4 * APART));
        }
        for number in (0..2000).filter(|_| parts.bodies) {
            let (body, _) = add_box(&mut simulator, (20.0, 20.0), place(number));
            simulator[body].set_linear_drag_coefficient(0.0);
            simulator[body].set_linear_velocity(v(60.0, 0.0));
            simulator[body].set_angular_velocity(1.0);
        }
        if parts.giant {
            let (giant, _) = add_box(&mut simulator, (1000.0, 1000.0), v(2500.0, -1000.0));
            simulator[giant].set_linear_velocity(v(60.0, 0.0));
        }
        let bullet = parts.bullet.then(|| add_box(&mut simulator, (4.0, 4.0), v(0.0, 1970.0)).0);
        let mut world = World { simulator, bullet };
        world.shoot();
        world
    }

    /// Moves the bullet back to its start.
    fn shoot(&mut self) {
        if let Some(bullet) = self.bullet {
            let bullet = &mut self.simulator[bullet];
            bullet.set_linear_drag_coefficient(0.0);
            bullet.set_position(v(0.0, 1970.0));
            bullet.set_linear_velocity(v(BULLET, 0.0));
        }
    }

    /// Returns the time per step, µs. Whenever the bullet has left the world it starts again.
    fn time(mut self) -> f64 {
        (0..30).for_each(|_| self.simulator.update(DT));
        let start = Instant::now();
        for update in 0..UPDATES {
            if update % 15 == 0 {
                self.shoot();
            }
            self.simulator.update(DT);
        }
        let time = start.elapsed().as_secs_f64() * 1e6 / UPDATES as f64;
        assert_eq!(self.simulator.contact_count(), 0, "something touches");
        time
    }
}

fn main() {
    let none = Parts::default();
    let worlds = [
        ("2,000 bodies", Parts { bodies: true, ..none }),
        ("2,000 static tiles", Parts { tiles: true, ..none }),
        ("a body of 1,000 px", Parts { giant: true, ..none }),
        ("a bullet", Parts { bullet: true, ..none }),
        ("bodies and tiles", Parts { bodies: true, tiles: true, ..none }),
        ("bodies, a bullet", Parts { bodies: true, bullet: true, ..none }),
        ("bodies, 1,000 px", Parts { bodies: true, giant: true, ..none }),
        ("tiles, a bullet", Parts { tiles: true, bullet: true, ..none }),
        ("all", Parts { bodies: true, tiles: true, giant: true, bullet: true }),
    ];
    let mut times = vec![Vec::new(); worlds.len()];
    for _ in 0..ROUNDS {
        worlds.iter().zip(&mut times).for_each(|((_, parts), times)| times.push(World::new(*parts).time()));
    }
    // The minimum over the rounds counts, because other load on the machine only adds time.
    let least = |times: &Vec<f64>| times.iter().copied().fold(f64::MAX, f64::min);
    for ((name, _), times) in worlds.iter().zip(&times) {
        println!("{name:<20} {:9.2} us per step", least(times));
    }
    let parts: f64 = times[..4].iter().map(least).sum();
    println!("all, against the sum of the parts: {:.2}", least(&times[times.len() - 1]) / parts);
}
