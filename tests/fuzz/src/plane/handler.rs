//! Event handler that changes the simulator in its callbacks.

use farseer_core::math::Vector2;
use farseer_core::{
    Aabb, BodyId, Contact, ContactId, Context, ControllerId, EventHandler, FluidContainer, GeomId, JointId,
    Result, SpringId, UserController, Vertices,
};

use super::controllers::CONTROLLER_EDITS;
use super::edits::{BODY_EDITS, GEOM_EDITS, JOINT_EDITS, SPRING_EDITS};
use super::pools::Pools;
use super::queries::random_query;
use crate::drives::edit_drive;
use crate::random::Random;

/// Greatest number of calls that a handler makes into the simulator, so that an update ends.
const MAX_CALLS: u32 = 60;
/// Greatest number of edits that the game's own controllers make.
const MAX_CONTROLLER_CALLS: u32 = 20;
/// Number of geoms at which the broad-phase callbacks are switched off.
const CROWD: usize = 100;

/// Event handler that edits, adds, removes and disposes objects and refuses contacts, in every callback.
pub(super) struct EditingHandler<'a> {
    random: Random,
    pools: &'a Pools,
    patience: u32,
    hears_broad_phase: bool,
    filters_pairs: bool,
    hears_joints: bool,
    hears_springs: bool,
    own: Own<'a>,
}

type Meddling = fn(&mut Context<'_>, &Pools, &mut Random);

const MEDDLINGS: &[Meddling] = &[
    edit_body,
    edit_body,
    edit_body,
    edit_body,
    |context, pools, random| {
        if let Some(geom) = context.geom_mut(random.pick(&pools.geoms)) {
            random.pick(GEOM_EDITS)(geom, random);
        }
    },
    |context, pools, random| {
        if let Some(joint) = context.joint_mut(random.pick(&pools.joints)) {
            random.pick(JOINT_EDITS)(joint, random);
        }
    },
    |context, pools, random| drop(edit_drive(context, random.pick(&pools.joints), random)),
    |context, pools, random| {
        if let Some(spring) = context.spring_mut(random.pick(&pools.springs)) {
            random.pick(SPRING_EDITS)(spring, random);
        }
    },
    |context, pools, random| {
        if let Some(controller) = context.controller_mut(random.pick(&pools.controllers)) {
            random.pick(CONTROLLER_EDITS)(controller, random);
        }
    },
    |context, pools, random| drop(context.add(pools.object(random))),
    |context, pools, random| drop(context.remove(pools.object(random))),
    |context, pools, random| {
        if random.chance(30) {
            drop(context.dispose(pools.object(random)));
        }
    },
    |context, pools, random| drop(context.set_is_sensor(random.pick(&pools.geoms), random.chance(30))),
    |context, pools, random| {
        drop(context.ignore_collision_with(random.pick(&pools.geoms), random.pick(&pools.geoms)));
    },
    |context, pools, random| {
        drop(context.restore_collision_with(random.pick(&pools.geoms), random.pick(&pools.geoms)));
    },
    |context, pools, random| random_query(context.simulator(), pools, random),
];

fn edit_body(context: &mut Context<'_>, pools: &Pools, random: &mut Random) {
    if let Some(body) = context.body_mut(random.pick(&pools.bodies)) {
        random.pick(BODY_EDITS)(body, random);
    }
}

const CONTACT_EDITS: &[fn(&mut Vec<Contact>, &mut Random)] = &[
    |contacts, _| contacts.clear(),
    |contacts, random| {
        let (geom1, geom2) = (random.below(20) as u32, random.below(20) as u32);
        let id = ContactId { geom1, vertex: random.count(0, 9), geom2 };
        let (position, normal) = (random.vector(100.0), random.vector(1.0));
        let contact = Contact::new(position, normal, random.number(-3.0, 1.0), id);
        contacts.push(contact.with_impulses(random.number(0.0, 10.0), random.number(-3.0, 3.0)));
    },
    |contacts, random| {
        if let Some(contact) = contacts.first_mut() {
            contact.normal = random.vector(1.0);
            contact.separation = random.number(-3.0, 1.0);
        }
    },
    |contacts, _| contacts.extend(contacts.first().copied()),
];

/// Edits of the contact of a pair. They apply only to the update in which the callback runs.
const SURFACE_EDITS: &[fn(&mut Context<'_>, &mut Random) -> Result<()>] = &[
    |context, random| context.set_contact_friction(random.number(0.0, 2.0)),
    |context, random| context.set_contact_restitution(random.number(0.0, 1.0)),
    |context, random| context.set_contact_tangent_speed(random.number(-100.0, 100.0)),
];

impl<'a> EditingHandler<'a> {
    pub(super) fn new(mut random: Random, pools: &'a Pools, geoms: usize) -> Self {
        EditingHandler {
            pools,
            patience: MAX_CALLS,
            hears_broad_phase: random.chance(15) && geoms < CROWD,
            filters_pairs: random.chance(15),
            hears_joints: random.chance(30),
            hears_springs: random.chance(30),
            own: Own {
                patience: MAX_CONTROLLER_CALLS,
                pools,
                contains: random.toss(),
                random: random.split(),
            },
            random,
        }
    }

    fn meddle(&mut self, context: &mut Context<'_>) {
        if self.patience > 0 && self.random.chance(30) {
            self.patience -= 1;
            self.random.pick(MEDDLINGS)(context, self.pools, &mut self.random);
        }
    }
}

impl EventHandler for EditingHandler<'_> {
    fn on_collision(
        &mut self,
        context: &mut Context<'_>,
        _: GeomId,
        _: GeomId,
        contacts: &mut Vec<Contact>,
    ) -> bool {
        self.meddle(context);
        if self.random.chance(5) {
            self.random.pick(CONTACT_EDITS)(contacts, &mut self.random);
        }
        if self.random.chance(10) {
            drop(self.random.pick(SURFACE_EDITS)(context, &mut self.random));
        }
        self.random.chance(92)
    }
    fn on_separation(&mut self, context: &mut Context<'_>, _: GeomId, _: GeomId) {
        self.meddle(context);
    }
    fn handles_broad_phase(&self) -> bool {
        self.hears_broad_phase
    }
    fn on_broad_phase_collision(&mut self, context: &mut Context<'_>, _: GeomId, _: GeomId) -> bool {
        self.meddle(context);
        self.random.chance(90)
    }
    fn filters_pairs(&self) -> bool {
        self.filters_pairs
    }
    fn accepts_pair(&mut self, context: &mut Context<'_>, _: GeomId, _: GeomId) -> bool {
        self.meddle(context);
        self.random.chance(90)
    }
    fn on_body_updated(&mut self, context: &mut Context<'_>, _: BodyId) {
        self.meddle(context);
    }
    fn on_body_disposed(&mut self, context: &mut Context<'_>, _: BodyId) {
        self.meddle(context);
    }
    fn on_joint_broke(&mut self, context: &mut Context<'_>, _: JointId) {
        self.meddle(context);
    }
    fn handles_joint_updates(&self) -> bool {
        self.hears_joints
    }
    fn on_joint_updated(&mut self, context: &mut Context<'_>, _: JointId) {
        self.meddle(context);
    }
    fn on_spring_broke(&mut self, context: &mut Context<'_>, _: SpringId) {
        self.meddle(context);
    }
    fn handles_spring_updates(&self) -> bool {
        self.hears_springs
    }
    fn on_spring_updated(&mut self, context: &mut Context<'_>, _: SpringId) {
        self.meddle(context);
    }
    fn on_fluid_entry(&mut self, context: &mut Context<'_>, _: ControllerId, _: GeomId, _: &Vertices) {
        self.meddle(context);
    }
    fn user_controller(&mut self, _: ControllerId) -> Option<&mut dyn UserController> {
        if self.random.chance(90) { Some(&mut self.own) } else { None }
    }
    fn fluid_container(&mut self, _: ControllerId) -> Option<&mut dyn FluidContainer> {
        if self.random.chance(90) { Some(&mut self.own) } else { None }
    }
}

/// A controller and a fluid that the game itself implements.
struct Own<'a> {
    random: Random,
    pools: &'a Pools,
    patience: u32,
    contains: bool,
}

impl UserController for Own<'_> {
    fn update(&mut self, context: &mut Context<'_>, controller: ControllerId, _: f32, _: f32) {
        if self.patience == 0 {
            return;
        }
        self.patience -= 1;
        edit_body(context, self.pools, &mut self.random);
        if self.random.chance(3) {
            drop(context.dispose(controller));
        }
    }
    fn validate(&mut self, context: &mut Context<'_>, _: ControllerId) {
        if self.random.chance(3) {
            drop(context.dispose(self.random.pick(&self.pools.bodies)));
        }
    }
}

impl FluidContainer for Own<'_> {
    fn intersect(&self, _: &Aabb) -> bool {
        self.contains
    }
    fn contains(&mut self, _: Vector2) -> bool {
        self.random.toss()
    }
}
