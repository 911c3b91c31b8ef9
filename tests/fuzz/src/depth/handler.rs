//! Event handler that changes the simulator in its callbacks.

use std::hint::black_box;

use farseer_core::{BodyId, GeomId};
use twohalf::{Collision, ContactTarget, Context, EventHandler};

use super::edits::edit_body;
use super::pools::Pools;
use crate::plane::GEOM_EDITS;
use crate::random::Random;

/// Greatest number of calls that a handler makes into the simulator, so that an update ends.
const MAX_CALLS: u32 = 60;

/// Event handler that edits, adds, removes and disposes objects and refuses contacts, in every callback.
pub(super) struct EditingHandler<'a> {
    random: Random,
    pools: &'a Pools,
    patience: u32,
    hears_broad_phase: bool,
}

type Meddling = fn(&mut Context<'_>, &Pools, &mut Random);

const MEDDLINGS: &[Meddling] = &[
    edit,
    edit,
    edit,
    edit,
    |context, pools, random| {
        if let Some(geom) = context.geom_mut(random.pick(&pools.geoms)) {
            random.pick(GEOM_EDITS)(geom, random);
        }
    },
    |context, pools, random| drop(context.add(random.pick(&pools.bodies))),
    |context, pools, random| drop(context.add(random.pick(&pools.geoms))),
    |context, pools, random| drop(context.remove(random.pick(&pools.bodies))),
    |context, pools, random| drop(context.remove(random.pick(&pools.geoms))),
    |context, pools, random| {
        if random.chance(15) {
            drop(context.dispose(random.pick(&pools.bodies)));
        }
    },
    |context, pools, random| {
        if random.chance(15) {
            drop(context.dispose(random.pick(&pools.geoms)));
        }
    },
    look,
];

fn edit(context: &mut Context<'_>, pools: &Pools, random: &mut Random) {
    if let Some(body) = context.body_mut(random.pick(&pools.bodies)) {
        edit_body(body, pools, random);
    }
}

fn look(context: &mut Context<'_>, pools: &Pools, random: &mut Random) {
    if let Some(body) = context.body(random.pick(&pools.bodies)) {
        black_box((body.supports(), body.layer_depth(), body.is_grounded(), body.position3d()));
    }
    if let Some(geom) = context.geom(random.pick(&pools.geoms)) {
        black_box((geom.screen_outline(), geom.virtual_geom()));
        black_box(geom.collides_with_point(random.vector(100.0)));
        black_box(geom.collides_with_geom(random.pick(&pools.geoms)));
    }
    black_box(context.platform(random.pick(&pools.platforms)).map(|platform| platform.corners()));
}

impl<'a> EditingHandler<'a> {
    pub(super) fn new(mut random: Random, pools: &'a Pools) -> Self {
        EditingHandler { hears_broad_phase: random.chance(10), random, pools, patience: MAX_CALLS }
    }

    fn meddle(&mut self, context: &mut Context<'_>) {
        if self.patience > 0 && self.random.chance(30) {
            self.patience -= 1;
            self.random.pick(MEDDLINGS)(context, self.pools, &mut self.random);
        }
    }
}

impl EventHandler for EditingHandler<'_> {
    fn on_collision(&mut self, context: &mut Context<'_>, collision: &Collision) -> bool {
        let mut numbers = collision.normal.iter().chain(collision.position.iter());
        let impulse = collision.normal_impulse;
        assert!(numbers.all(|number| number.is_finite()) && impulse.is_finite(), "told {collision:?}");
        self.meddle(context);
        self.random.chance(92)
    }
    fn on_separation(&mut self, context: &mut Context<'_>, _: GeomId, _: ContactTarget) {
        self.meddle(context);
    }
    fn handles_broad_phase(&self) -> bool {
        self.hears_broad_phase
    }
    fn on_broad_phase_collision(&mut self, context: &mut Context<'_>, _: GeomId, _: GeomId) -> bool {
        self.meddle(context);
        self.random.chance(90)
    }
    fn on_body_updated(&mut self, context: &mut Context<'_>, _: BodyId) {
        self.meddle(context);
    }
    fn on_body_disposed(&mut self, context: &mut Context<'_>, _: BodyId) {
        self.meddle(context);
    }
}
