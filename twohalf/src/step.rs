//! The update: the stages of the 2D engine with what depth adds between them.

use farseer_core::{BodyId, Event as CoreEvent, GeomId, PhysicsSimulator};

use crate::depth::is_movable;
use crate::events::{Collision, Context, Event, EventHandler};
use crate::pairs::PlaneHandler;
use crate::world::{Source, World};
use crate::{Partner, TwoHalfPhysicsSimulator, Vector3};

/// What a step did: how much work there was.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StepCounters {
    /// Pairs whose shapes were tested against each other: two geoms, or a geom and a platform. The ground is none.
    pub pairs_tested: usize,
    /// Pairs of geoms, or of a geom and a platform, that touch.
    pub pairs_touching: usize,
    /// Bodies that touch their ground.
    pub ground_contacts: usize,
    /// Contact points the solver worked on in every iteration.
    pub contacts_solved: usize,
    /// Scalar constraints it solved for them in every iteration: two for a point in the plane, three for one in
    /// space.
    pub rows_solved: usize,
    /// Bodies that changed their position or rotation.
    pub bodies_moved: usize,
}

/// The handler again, for a shorter time.
pub(crate) fn reborrow<'a>(
    handler: &'a mut Option<&mut dyn EventHandler>,
) -> Option<&'a mut dyn EventHandler> {
    match handler {
        Some(handler) => Some(&mut **handler),
        None => None,
    }
}

impl TwoHalfPhysicsSimulator {
    /// Moves everything by `dt` seconds. Games call this with a fixed step.
    ///
    /// A negative step runs backwards; 0 only lets things enter and leave. A step that is not finite, or so small
    /// that its reciprocal is not, changes nothing and is reported as [`Event::RejectedInput`].
    #[doc(alias = "Update")]
    pub fn update(&mut self, dt: f32) {
        self.run(dt, None);
    }

    /// [`update`](Self::update) with callbacks. Objects at different depths do not meet, so the handler is not
    /// asked about them.
    pub fn update_with(&mut self, dt: f32, handler: &mut dyn EventHandler) {
        self.run(dt, Some(handler));
    }

    /// [`update`](Self::update) by a game that wants to know [how long it took](Self::update_time): `now` is its
    /// clock, in seconds. The engine has no clock of its own, so that nothing depends on one.
    pub fn update_timed(&mut self, dt: f32, mut now: impl FnMut() -> f64) {
        let start = now();
        self.run(dt, None);
        self.world.update_time = (now() - start) as f32;
    }

    fn run(&mut self, dt: f32, mut handler: Option<&mut dyn EventHandler>) {
        if self.world.scheme == crate::DepthScheme::Precise {
            return self.run_precise(dt, handler);
        }
        let TwoHalfPhysicsSimulator { core, world } = self;
        world.begin();
        let mut meeting = PlaneHandler { world: &mut *world, handler: reborrow(&mut handler) };
        let goes_on = core.process_queues(dt, Some(&mut meeting));
        world.tell_pending();
        world.take_events(core);
        if !goes_on {
            world.stand_still(core);
            return;
        }
        world.prepare(core, dt);
        world.meet(core, &mut handler);
        world.act_fields(core, dt);
        world.apply_forces(core, dt);
        world.solve(core, dt);
        world.integrate(core, dt, &mut handler);
        world.finish(core);
    }
}

impl World {
    /// What was refused between updates.
    pub(crate) fn tell_pending(&mut self) {
        if std::mem::take(&mut self.has_rejected) {
            for (body, state) in self.depths.bodies.iter_mut() {
                let told = |argument| Event::RejectedInput { object: Some(body.into()), argument };
                self.events.extend(state.rejected.take().map(told));
            }
        }
        let rejected = self.platforms.take_rejected();
        self.events.extend(rejected.map(|argument| Event::RejectedInput { object: None, argument }));
    }

    /// Second and third stage: which pairs meet, and where everything touches.
    fn meet(&mut self, core: &mut PhysicsSimulator, handler: &mut Option<&mut dyn EventHandler>) {
        let mut meeting = PlaneHandler { world: self, handler: reborrow(handler) };
        core.find_pairs(Some(&mut meeting));
        core.collide_pairs(Some(&mut meeting));
        self.take_events(core);
        self.touch(core);
        self.tell_touches(core, handler);
        self.smooth_seams(core.allowed_penetration());
        self.take_events(core);
    }

    /// Fourth stage: impulses, forces and drag become velocity, along Z as well.
    fn apply_forces(&mut self, core: &mut PhysicsSimulator, dt: f32) {
        for index in 0..core.body_list().len() {
            let id = core.body_list()[index];
            let (Some(body), Some(state)) = (core.body(id), self.depths.bodies.get_mut(id)) else { continue };
            state.bias_z = 0.0;
            if !is_movable(core, id) {
                continue;
            }
            let before = (state.velocity_z, state.angular_velocity_x, state.angular_velocity_y);
            state.integrate_velocity(body, dt);
            if !state.motion_is_finite() {
                (state.velocity_z, state.angular_velocity_x, state.angular_velocity_y) = before;
                disable(core, id);
            }
        }
        core.apply_forces(dt, 0.0, None);
    }

    /// Fifth and sixth stage: contacts push and rub.
    fn solve(&mut self, core: &mut PhysicsSimulator, dt: f32) {
        let inverse_dt = 1.0 / dt;
        self.take_over_plane_contacts(core);
        self.solver.prepare(core, &self.depths, &self.touches, inverse_dt);
        core.solve_with(inverse_dt, &mut self.solver, None);
        self.solver.finish(core, &mut self.depths, &mut self.touches);
    }

    /// Last stage: velocity becomes position, along Z first, so that callbacks see all of it.
    fn integrate(
        &mut self,
        core: &mut PhysicsSimulator,
        dt: f32,
        handler: &mut Option<&mut dyn EventHandler>,
    ) {
        self.update.moved.clear();
        for index in 0..core.body_list().len() {
            let id = core.body_list()[index];
            let (Some(state), Some(body)) = (self.depths.bodies.get_mut(id), core.body(id)) else { continue };
            let is_moving = is_movable(core, id);
            let along_z = if is_moving { (state.velocity_z + state.bias_z) * dt } else { 0.0 };
            // X and Y are where it begins, until it is known where it ends.
            state.motion = Some(Vector3::new(body.position().x, body.position().y, along_z));
            if along_z == 0.0 {
                continue;
            }
            let z = state.z + along_z;
            if z.is_finite() {
                state.z = z;
                if id.slot() >= self.update.moved.len() {
                    self.update.moved.resize(id.slot() + 1, false);
                }
                self.update.moved[id.slot()] = true;
            } else {
                state.motion = None;
                disable(core, id);
            }
        }
        let mut meeting = PlaneHandler { world: self, handler: reborrow(handler) };
        core.integrate(dt, Some(&mut meeting));
        for &id in core.body_list() {
            if let (Some(state), Some(body)) = (self.depths.bodies.get_mut(id), core.body(id)) {
                let Some(begin) = state.motion else { continue };
                let step = body.position() - begin.xy();
                let is_finite = step.x.is_finite() && step.y.is_finite();
                state.motion = is_finite.then(|| Vector3::new(step.x, step.y, begin.z));
            }
        }
        self.take_events(core);
        self.tell_moved_along_z(core, handler);
    }

    /// The 2D engine has told of this body's movement.
    pub(crate) fn is_told_of(&mut self, body: BodyId) {
        if let Some(moved) = self.update.moved.get_mut(body.slot()) {
            *moved = false;
        }
    }

    /// Tells of bodies that moved along Z alone, and have never moved otherwise.
    fn tell_moved_along_z(
        &mut self,
        core: &mut PhysicsSimulator,
        handler: &mut Option<&mut dyn EventHandler>,
    ) {
        for index in 0..core.body_list().len() {
            let Some(&body) = core.body_list().get(index) else { break };
            if self.update.moved.get(body.slot()) != Some(&true) {
                continue;
            }
            self.counters.bodies_moved += 1;
            self.events.push(Event::BodyUpdated { body });
            if let Some(handler) = handler {
                handler.on_body_updated(&mut Context { core: core.context(), world: self }, body);
                self.settle(core, &mut Some(&mut **handler));
            }
        }
    }

    /// Lets geoms follow bodies that a callback has edited.
    pub(crate) fn settle(
        &mut self,
        core: &mut PhysicsSimulator,
        handler: &mut Option<&mut dyn EventHandler>,
    ) {
        let mut meeting = PlaneHandler { world: self, handler: reborrow(handler) };
        core.settle(Some(&mut meeting));
    }

    /// Takes over what the 2D engine has reported since the last time.
    pub(crate) fn take_events(&mut self, core: &PhysicsSimulator) {
        // Collisions come in the order of the list, those of a pair together: the older geom's first.
        let mut next = 0;
        let (mut vetoed_before, mut halved_before) = (0, 0);
        for index in self.update.core_events..core.events().len() {
            match core.events()[index] {
                CoreEvent::Collision { vetoed: true, .. } => {
                    let refused = self.update.vetoed.get(vetoed_before).copied();
                    vetoed_before += 1;
                    self.events.extend(
                        refused.map(|collision| Event::Collision(Collision { vetoed: true, ..collision })),
                    );
                }
                CoreEvent::Collision { this, other, .. } => {
                    let is_of = |pair: (GeomId, GeomId)| pair == (this, other) || pair == (other, this);
                    let found = (next..core.arbiter_count()).find_map(|position| {
                        let arbiter = core.arbiter(position)?;
                        is_of((arbiter.geom_a(), arbiter.geom_b())).then_some((position, arbiter))
                    });
                    let Some((position, found)) = found else {
                        // The other side has refused it afterwards.
                        self.events
                            .extend(self.update.halved.get(halved_before).copied().map(Event::Collision));
                        halved_before += 1;
                        continue;
                    };
                    let pair = [found.geom_a(), found.geom_b()];
                    let collision = self.plane_collision(core, pair, this, found.contacts());
                    let Some(collision) = collision else { continue };
                    next = if this == found.geom_b() { position + 1 } else { position };
                    let source = (self.events.len() as u32, Source::Arbiter(position as u32));
                    self.update.sources.push(source);
                    self.events.push(Event::Collision(collision));
                }
                CoreEvent::Separation { this, other } if self.has_touched(core, this, other) => {
                    self.events.push(Event::Separation { this, partner: Partner::Geom(other) });
                }
                event => self.events.extend(Event::from_core(event)),
            }
        }
        self.update.core_events = core.events().len();
    }

    /// Fills in what is known only now: impulses, supports and counters.
    pub(crate) fn finish(&mut self, core: &PhysicsSimulator) {
        self.update.is_running = false;
        self.fill_impulses(core);
        self.find_supports(core);
        let plane = core.counters();
        let touching = |touch: &&crate::touch::Touch| !touch.is_plane() && !touch.partner.is_ground();
        let on_ground = |touch: &&crate::touch::Touch| touch.partner.is_ground();
        let solved = |touch: &&crate::touch::Touch| touch.responds;
        let points: u32 = self.touches.touches.iter().filter(solved).map(|touch| touch.point_count).sum();
        self.counters.pairs_tested += plane.pairs_tested;
        self.counters.pairs_touching =
            plane.pairs_touching + self.touches.touches.iter().filter(touching).count();
        self.counters.ground_contacts = self.touches.touches.iter().filter(on_ground).count();
        self.counters.contacts_solved = plane.contacts_solved + points as usize;
        self.counters.rows_solved = 2 * plane.contacts_solved + self.solver.row_count();
        self.counters.bodies_moved += plane.bodies_moved;
    }
}

/// Takes a body out of the simulation whose state would not have been finite.
#[cold]
pub(crate) fn disable(core: &mut PhysicsSimulator, id: BodyId) {
    if let Some(body) = core.body_mut(id) {
        body.set_enabled(false);
        core.report(CoreEvent::NotFinite { body: id, disabled: true });
    }
}
