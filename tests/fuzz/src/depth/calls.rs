//! Table of the calls that a 2.5D game makes.

use twohalf::{DepthProfile, DepthScheme, Result, TwoHalfPhysicsSimulator};

use super::create::{BODIES, GEOMS, Make, PLATFORMS};
use super::edits::{PLATFORM_EDITS, edit_body};
use super::handler::EditingHandler;
use super::queries::random_query;
use super::{Depth, create_thing, place};
use crate::game::{Call, Outcome};
use crate::plane::GEOM_EDITS;
use crate::random::Random;
use crate::shapes::{outline, step};

/// Number of geoms in the simulator at which the game makes no more.
const MOST_GEOMS: usize = 40;
const MOST_PLATFORMS: usize = 12;
/// Greatest number of iterations per update. More would take too long.
const MOST_ITERATIONS: i32 = 1000;

const fn call(name: &'static str, weight: usize, make: fn(&mut Depth) -> Outcome) -> Call<Depth> {
    Call { name, weight, make }
}

pub(super) const CALLS: &[Call<Depth>] = &[
    call("create a thing", 2, |game| {
        if game.is_crowded() {
            return Outcome::Queried;
        }
        let Ok((body, geom)) = create_thing(&mut game.simulator, &mut game.random) else {
            return Outcome::Changed;
        };
        game.pools.bodies.push(body);
        game.pools.geoms.push(geom);
        Outcome::Changed
    }),
    call("create a body", 1, |game| {
        let crowded = game.is_crowded();
        made(game, crowded, BODIES, |game| &mut game.pools.bodies)
    }),
    call("create a geom", 1, |game| {
        let crowded = game.is_crowded();
        made(game, crowded, GEOMS, |game| &mut game.pools.geoms)
    }),
    call("create a platform", 1, |game| {
        let crowded = game.simulator.platforms().count() > MOST_PLATFORMS;
        made(game, crowded, PLATFORMS, |game| &mut game.pools.platforms)
    }),
    call("edit a body", 5, |game| {
        let id = game.body();
        for _ in 0..1 + game.random.below(3) {
            let Some(body) = game.simulator.body_mut(id) else { return Outcome::Queried };
            edit_body(body, &game.pools, &mut game.random);
        }
        Outcome::Changed
    }),
    call("edit a geom", 1, |game| {
        let id = game.geom();
        let Some(geom) = game.simulator.geom_mut(id) else { return Outcome::Queried };
        game.random.pick(GEOM_EDITS)(geom, &mut game.random);
        Outcome::Changed
    }),
    call("edit a platform", 1, edit_platform),
    call("remove_platform", 1, |game| {
        if !game.random.chance(30) {
            return Outcome::Queried;
        }
        let platform = game.random.pick(&game.pools.platforms);
        Outcome::of(game.simulator.remove_platform(platform))
    }),
    call("set_depth_profile", 1, |game| {
        let (geom, profile) = (game.geom(), profile(&mut game.random));
        Outcome::of(game.simulator.set_depth_profile(geom, profile))
    }),
    call("add", 1, |game| {
        let (body, geom) = (game.body(), game.geom());
        Outcome::of(if game.random.toss() { game.simulator.add(body) } else { game.simulator.add(geom) })
    }),
    call("remove", 1, |game| {
        let (body, geom) = (game.body(), game.geom());
        Outcome::of(if game.random.toss() {
            game.simulator.remove(body)
        } else {
            game.simulator.remove(geom)
        })
    }),
    call("dispose", 1, |game| {
        let (body, geom) = (game.body(), game.geom());
        match game.random.below(4) {
            0 => Outcome::of(game.simulator.dispose(body)),
            1 => Outcome::of(game.simulator.dispose(geom)),
            _ => Outcome::Queried,
        }
    }),
    call("set_body", 1, |game| {
        let (geom, body) = (game.geom(), game.body());
        Outcome::of(game.simulator.set_body(geom, body))
    }),
    call("set_vertices", 1, |game| {
        let (geom, outline) = (game.geom(), outline(&mut game.random));
        Outcome::of(game.simulator.set_vertices(geom, outline))
    }),
    call("set_is_sensor", 1, |game| {
        let geom = game.geom();
        Outcome::of(game.simulator.set_is_sensor(geom, game.random.chance(40)))
    }),
    call("ignore_collision_with", 1, |game| {
        let (geom, other) = (game.geom(), game.geom());
        Outcome::of(if game.random.toss() {
            game.simulator.ignore_collision_with(geom, other)
        } else {
            game.simulator.restore_collision_with(geom, other)
        })
    }),
    call("change a setting", 1, |game| {
        Outcome::of(game.random.pick(SETTINGS)(&mut game.simulator, &mut game.random))
    }),
    call("ask", 3, |game| {
        random_query(&game.simulator, &game.pools, &mut game.random);
        Outcome::Queried
    }),
    call("update", 18, |game| {
        let dt = step(&mut game.random);
        if game.random.chance(45) {
            let mut meddler = EditingHandler::new(game.random.split(), &game.pools);
            game.simulator.update_with(dt, &mut meddler);
        } else {
            game.simulator.update(dt);
        }
        Outcome::Updated
    }),
];

const SETTINGS: &[fn(&mut TwoHalfPhysicsSimulator, &mut Random) -> Result<()>] = &[
    |simulator, random| simulator.set_gravity(random.vector(200.0)),
    |simulator, random| {
        simulator.set_iterations(random.count(0, 20).min(MOST_ITERATIONS));
        Ok(())
    },
    |simulator, random| {
        simulator.set_enabled(random.chance(85));
        Ok(())
    },
    |simulator, random| {
        simulator.set_max_contacts_to_detect(random.count(0, 20));
        Ok(())
    },
    |simulator, random| simulator.set_max_contacts_to_resolve(random.count(0, 8)),
    |simulator, random| {
        let all = [DepthScheme::Faithful, DepthScheme::Precise, DepthScheme::Thesis];
        simulator.set_depth_scheme(random.pick(&all))
    },
    |simulator, random| {
        simulator.set_layer_depth_range(random.number(-10.0, 10.0), random.number(100.0, 1000.0))
    },
    |simulator, random| simulator.set_height(random.count(1, 1000)),
    |simulator, random| {
        if random.chance(10) {
            simulator.clear();
        }
        Ok(())
    },
];

impl Depth {
    fn is_crowded(&self) -> bool {
        self.simulator.core().geoms().count() > MOST_GEOMS
    }
}

/// Makes an object and adds its id to the pool.
fn made<I>(
    game: &mut Depth,
    crowded: bool,
    makers: &[Make<I>],
    pool: fn(&mut Depth) -> &mut Vec<I>,
) -> Outcome {
    if crowded {
        return Outcome::Queried;
    }
    let made = game.random.pick(makers)(game);
    Outcome::of(made.map(|id| pool(game).push(id)))
}

fn edit_platform(game: &mut Depth) -> Outcome {
    let id = game.random.pick(&game.pools.platforms);
    let Some(mut platform) = game.simulator.platform_mut(id) else { return Outcome::Queried };
    match game.random.below(6) {
        0 => Outcome::of(platform.set_position3d(place(&mut game.random))),
        1 => Outcome::of(platform.set_rotation(game.random.number(-1.5, 1.5))),
        2 => Outcome::of(platform.set_velocity(game.random.vector3(100.0))),
        3 => Outcome::of(platform.move_to(place(&mut game.random))),
        4 => {
            let speeds = [0; 2].map(|_| game.random.number(-100.0, 100.0));
            Outcome::of(platform.set_surface_speed(speeds[0], speeds[1]))
        }
        _ => {
            game.random.pick(PLATFORM_EDITS)(&mut platform, &mut game.random);
            Outcome::Changed
        }
    }
}

fn profile(random: &mut Random) -> DepthProfile {
    if random.toss() {
        DepthProfile::Prism { depth: random.number(0.0, 40.0) }
    } else {
        DepthProfile::Round { radius: random.number(2.0, 20.0) }
    }
}
