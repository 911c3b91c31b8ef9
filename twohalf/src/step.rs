//! The update: the stages of the 2D engine with what depth adds between them.

use farseer_core::{BodyId, BroadPhaseCollider, Event, EventHandler};

use crate::TwoHalfPhysicsSimulator;
use crate::ground_contacts::touch_ground;
use crate::pairs::DepthFilter;

/// What a step did: how much work there was.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StepCounters {
    /// Pairs of geoms whose outlines were tested against each other.
    pub pairs_tested: usize,
    /// Pairs of geoms that touch.
    pub pairs_touching: usize,
    /// Bodies that touch their ground.
    pub ground_contacts: usize,
    /// Contact points the solver worked on in every iteration, with the ground's.
    pub contacts_solved: usize,
    /// Bodies that changed their X, Y or rotation.
    pub bodies_moved: usize,
}

/// The handler again, for a shorter time.
fn reborrow<'a>(handler: &'a mut Option<&mut dyn EventHandler>) -> Option<&'a mut dyn EventHandler> {
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
    /// asked about them. Its context shows the 2D engine: positions there are in the plane, not on the screen.
    pub fn update_with(&mut self, dt: f32, handler: &mut dyn EventHandler) {
        self.run(dt, Some(handler));
    }

    fn run(&mut self, dt: f32, mut handler: Option<&mut dyn EventHandler>) {
        self.counters = StepCounters::default();
        self.passing.begin();
        self.rows.clear();
        let goes_on = self.core.process_queues(dt, reborrow(&mut handler));
        for event in self.pending_events.drain(..) {
            self.core.report(event);
        }
        if goes_on {
            self.meet(reborrow(&mut handler));
            self.apply_forces(dt);
            self.solve(1.0 / dt);
            self.core.integrate(dt, handler);
            self.integrate_depth(dt);
        }
        self.finish();
    }

    /// Second and third stage: pairs at the same depth.
    fn meet(&mut self, handler: Option<&mut dyn EventHandler>) {
        let TwoHalfPhysicsSimulator { core, depths, passing, .. } = self;
        let replaces_box_test = matches!(
            core.broad_phase_collider(),
            BroadPhaseCollider::BruteForce | BroadPhaseCollider::SpatialHash { .. }
        );
        let mut filter = DepthFilter { depths, pairs: passing, replaces_box_test, handler };
        core.find_pairs(Some(&mut filter));
        core.collide_pairs(Some(&mut filter));
        passing.finish();
    }

    /// Fourth stage: impulses, forces and drag become velocity, along Z as well.
    fn apply_forces(&mut self, dt: f32) {
        self.is_moving.clear();
        for index in 0..self.core.body_list().len() {
            let id = self.core.body_list()[index];
            let (Some(body), Some(state)) = (self.core.body(id), self.depths.bodies.get_mut(id)) else {
                continue;
            };
            if !body.enabled() || body.is_static() {
                continue;
            }
            let before = (state.velocity_z, state.angular_velocity_x);
            state.integrate_velocity(body, dt);
            if !state.motion_is_finite() {
                (state.velocity_z, state.angular_velocity_x) = before;
                self.disable(id);
                continue;
            }
            if id.slot() >= self.is_moving.len() {
                self.is_moving.resize(id.slot() + 1, false);
            }
            self.is_moving[id.slot()] = true;
        }
        self.core.apply_forces(dt);
    }

    /// Fifth and sixth stage: contacts of pairs and with the ground, and friction along Z.
    fn solve(&mut self, inverse_dt: f32) {
        let TwoHalfPhysicsSimulator { core, depths, rows, is_moving, .. } = self;
        for index in 0..core.geom_list().len() {
            let geom = core.geom_list()[index];
            let (Some(body), Some(&profile)) = (core.geom(geom).map(|g| g.body()), depths.profiles.get(geom))
            else {
                continue;
            };
            let Some(state) = depths.bodies.get_mut(body) else { continue };
            if state.ground.object_geom() == Some(geom) && is_moving.get(body.slot()) == Some(&true) {
                rows.extend(touch_ground(core, state, profile, geom));
            }
        }
        core.pre_step(inverse_dt);
        for _ in 0..core.iterations() {
            core.solve_iteration();
            for row in rows.iter_mut() {
                row.solve(core);
            }
        }
        for index in 0..self.rows.len() {
            if let Some(failed) = self.rows[index].finish(&self.core, &mut self.depths) {
                self.disable(failed);
            }
        }
    }

    /// Last stage along Z: velocity becomes position.
    fn integrate_depth(&mut self, dt: f32) {
        for index in 0..self.core.body_list().len() {
            let id = self.core.body_list()[index];
            let Some(state) = self.depths.bodies.get_mut(id) else { continue };
            // One that failed on the way was disabled.
            let is_enabled = self.core.body(id).is_some_and(|body| body.enabled());
            if !is_enabled || self.is_moving.get(id.slot()) != Some(&true) {
                continue;
            }
            let z = state.z + state.velocity_z * dt;
            if z.is_finite() {
                state.z = z;
            } else {
                self.disable(id);
            }
        }
    }

    /// Takes a body out of the simulation whose state would not have been finite.
    #[cold]
    fn disable(&mut self, id: BodyId) {
        if let Some(body) = self.core.body_mut(id) {
            body.set_enabled(false);
            self.core.report(Event::NotFinite { body: id, disabled: true });
        }
    }

    /// Takes over the 2D engine's events and counters.
    fn finish(&mut self) {
        let core = self.core.counters();
        self.counters = StepCounters {
            pairs_tested: core.pairs_tested,
            pairs_touching: core.pairs_touching,
            ground_contacts: self.rows.len(),
            contacts_solved: core.contacts_solved,
            bodies_moved: core.bodies_moved,
        };
        let mut refusals = self.passing.refusals();
        let mut is_ours = |event: &Event| match event {
            Event::BroadPhaseVeto { .. } | Event::Collision { vetoed: true, .. } => {
                refusals.next() == Some(true)
            }
            _ => false,
        };
        self.events.clear();
        self.events.extend(self.core.events().iter().filter(|event| !is_ours(event)));
    }
}
