//! Calls that make chains and tracks, and that edit paths.

use farseer_core::math::Vector2;
use farseer_core::{CollisionCategory, ComplexFactory, LinkType, Path, Result};

use super::Plane;
use super::create::Make;
use crate::game::Outcome;
use crate::random::Random;

const LINKS: [LinkType; 4] =
    [LinkType::RevoluteJoint, LinkType::PinJoint, LinkType::SliderJoint, LinkType::LinearSpring];
/// Number of links of the longest chain.
const MOST_LINKS: f32 = 20.0;
/// Number of bodies in the simulator at which the game makes no more chains.
const CROWD: usize = 40;

const CHAINS: &[Make<Path>] = &[
    |game| {
        let (factory, [start, end], link) = game.chain();
        let (width, height, mass) = game.link_size(start, end);
        factory.create_chain(&mut game.simulator, start, end, width, height, mass, link)
    },
    |game| {
        let (factory, [start, end], link) = game.chain();
        let (links, mass) = (game.random.count(2, 8).min(100), game.random.number(0.5, 2.0));
        factory.create_chain_of_links(&mut game.simulator, start, end, links, None, mass, link)
    },
    |game| {
        let (factory, [start, end], link) = game.chain();
        let (width, height, mass) = game.link_size(start, end);
        let pin_end = game.random.toss();
        let simulator = &mut game.simulator;
        factory.create_pinned_chain(simulator, start, end, width, height, mass, true, pin_end, link)
    },
    |game| {
        let (factory, [start, end], link) = game.chain();
        let (width, height, mass) = game.link_size(start, end);
        let (link_width, pins) = (game.random.number(8.0, 20.0), (game.random.toss(), game.random.toss()));
        let simulator = &mut game.simulator;
        factory.create_chain_with_link_width(
            simulator, start, end, width, height, link_width, mass, pins.0, pins.1, link,
        )
    },
    |game| {
        let (factory, [start, end], link) = game.chain();
        let (width, height, mass) = game.link_size(start, end);
        let down = Vector2::new(0.0, 40.0);
        let points = [start, end, end + down, start + down];
        let (endless, group) = (game.random.toss(), game.random.count(0, 5));
        factory.create_track(&mut game.simulator, &points, width, height, mass, endless, group, link)
    },
];

const PATH_EDITS: &[fn(&mut Plane, &mut Path)] = &[
    |game, path| drop(path.add(game.random.vector(100.0))),
    |game, path| drop(path.remove_at(game.random.below(6))),
    |game, path| {
        let (point, index) = (game.random.vector(100.0), game.random.below(6));
        drop(path.move_control_point(point, index));
    },
    |game, path| drop(path.update(&mut game.simulator)),
    |game, path| path.add_body(game.body()),
    |game, path| {
        path.add_joint(game.random.pick(&game.pools.joints));
        path.add_spring(game.random.pick(&game.pools.springs));
        path.add_geom(game.geom());
    },
    |game, path| {
        let (link, min, max) = (game.link(), game.random.number(0.0, 10.0), game.random.number(0.0, 20.0));
        let (spring, damping) = (game.random.number(0.0, 10.0), game.random.number(0.0, 10.0));
        drop(path.link_bodies(&mut game.simulator, link, min, max, spring, damping));
    },
    |game, path| drop(path.create_geoms(&mut game.simulator, 0)),
    |game, path| path.remove_from_physics_simulator(&mut game.simulator),
];

/// Makes a chain or track, with or without geoms, and adds it to the simulator.
pub(super) fn create_chain(game: &mut Plane) -> Outcome {
    if game.simulator.bodies().count() > CROWD {
        return Outcome::Queried;
    }
    // If a factory fails, the objects that it has made before stay.
    let Ok(mut path) = game.random.pick(CHAINS)(game) else { return Outcome::Changed };
    if game.random.toss() {
        drop(game.give_geoms(&mut path));
    }
    path.add_to_physics_simulator(&mut game.simulator);
    game.pools.take_from(&path);
    game.path = Some(path);
    Outcome::Changed
}

/// Edits the path that was made last. If there is none, makes one.
pub(super) fn edit_path(game: &mut Plane) -> Outcome {
    if game.simulator.bodies().count() > CROWD {
        return Outcome::Queried;
    }
    if let Some(mut path) = game.path.take() {
        game.random.pick(PATH_EDITS)(game, &mut path);
        game.path = Some(path);
    } else {
        game.path = new_path(&mut game.random).ok();
    }
    Outcome::Changed
}

fn new_path(random: &mut Random) -> Result<Path> {
    let (width, height, mass) = (random.number(5.0, 20.0), random.number(5.0, 20.0), random.number(1.0, 3.0));
    let mut path = Path::new(width, height, mass, random.toss())?;
    for _ in 0..random.below(6) {
        path.add(random.vector(60.0))?;
    }
    Ok(path)
}

impl Plane {
    fn link(&mut self) -> LinkType {
        self.random.pick(&LINKS)
    }

    fn chain(&mut self) -> (ComplexFactory, [Vector2; 2], LinkType) {
        let random = &mut self.random;
        let factory = ComplexFactory {
            min: random.number(0.0, 5.0),
            max: random.number(5.0, 20.0),
            spring_constant: random.number(0.0, 100.0),
            damping_constant: random.number(0.0, 5.0),
            spring_rest_length_factor: random.number(0.5, 1.5),
        };
        let start = random.vector(100.0);
        let end = start + Vector2::new(random.number(20.0, 80.0), random.number(-30.0, 30.0));
        (factory, [start, end], self.link())
    }

    /// Returns width, height (length units) and mass of a link. Links are so wide that not too many fit between `start` and
    /// `end`.
    fn link_size(&mut self, start: Vector2, end: Vector2) -> (f32, f32, f32) {
        let random = &mut self.random;
        let least = (end - start).norm() / MOST_LINKS;
        (random.number(8.0, 20.0).max(least), random.number(4.0, 10.0), random.number(0.5, 2.0))
    }

    fn give_geoms(&mut self, path: &mut Path) -> Result<()> {
        if self.random.toss() {
            return path.create_geoms(&mut self.simulator, self.random.count(0, 5));
        }
        let (own, others) = (CollisionCategory::CAT1, CollisionCategory::ALL);
        path.create_geoms_with_categories_in(&mut self.simulator, own, others)
    }
}
