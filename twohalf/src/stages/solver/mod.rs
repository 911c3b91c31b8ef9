//! Sequential impulses in three axes, inside the iterations of the core.
//!
//! The method is that of the core (behaviour chapter 03, section 6): warm starting, clamped normal impulses,
//! bias velocities for penetration, and friction limited by the normal impulse. Friction has two tangents,
//! solved as one block and clamped to a disc (Coulomb's law). Without sliding along Z this is the core's
//! clamp. Velocities in X and Y are those of the core's solver; those along Z are stored here.
//!
//! Frame: x right, y down, z into the picture; right-handed, so that rotation about z is that of the core.

mod kernel;

use farseer_core::{
    BodyId, ExternalConstraints, PhysicsSimulator, SolverBodiesView, SolverBody, SolverBodyIndex,
};

use crate::Vector3;
use crate::depth::{Contact, ContactList, DepthProfile, DepthState, is_movable};
use kernel::{ContactPointConstraint, SolverBody3};

/// State of a body that the core's solver does not store.
#[derive(Debug, Clone, Copy)]
struct SolverBodyState {
    /// Index of the body in the core's solver, once the solver has begun; `None` for the static world.
    place: Option<SolverBodyIndex>,
    id: Option<BodyId>,
    /// Centre of mass, px.
    centre: [f32; 3],
    /// Velocity along Z, px/s.
    velocity_z: f32,
    /// Angular velocity about x, radians/s.
    angular_x: f32,
    /// Angular velocity about y, radians/s.
    angular_y: f32,
    /// Bias velocity along Z that only resolves penetration, px/s.
    bias_z: f32,
    /// Inverse mass, 1/mass.
    inverse_mass: f32,
    /// Inverse moment of inertia about x and y, 1/(mass · px²); 0 for bodies that rotate about the depth axis
    /// only.
    inverse_inertia: f32,
    failed: bool,
}

impl SolverBodyState {
    /// Returns the solver's body with the velocities before the first impulse.
    fn initial_body(&self, core: &PhysicsSimulator) -> SolverBody3 {
        let Some(body) = self.id.and_then(|id| core.body(id)) else { return SolverBody3::default() };
        let velocity = body.linear_velocity();
        SolverBody3 {
            linear: [velocity.x, velocity.y, self.velocity_z],
            angular: [self.angular_x, self.angular_y, body.angular_velocity()],
            inverse_mass: body.inverse_mass(),
            inverse_inertia: [self.inverse_inertia, self.inverse_inertia, body.inverse_moment_of_inertia()],
            ..SolverBody3::default()
        }
    }
}

/// Index of the static world among the states.
const WORLD: u32 = 0;

/// The contact points of one contact.
#[derive(Debug, Clone, Copy)]
struct ContactGroup {
    /// Index of the first body among the states.
    body_a: u32,
    /// Index of the second body among the states.
    body_b: u32,
    /// Index of the contact in the list.
    touch: u32,
    /// Index, in the solver's list of constraints, of the first contact point of the contact.
    first_row: u32,
    /// Number of constraints of the contact, one per point.
    row_count: u32,
    /// Friction coefficient, dimensionless.
    friction: f32,
    /// Whether all points share one normal impulse in equal parts.
    shares_pressure: bool,
    /// Whether the group is left out because a velocity became infinite or NaN.
    is_dropped: bool,
}

/// Arrays of the solver, reused between updates.
#[derive(Debug, Clone, Default)]
pub(crate) struct Solver3 {
    states: Vec<SolverBodyState>,
    /// By body slot: stamp of the update in which the body was gathered, and its index among the states.
    places: Vec<(u32, u32)>,
    /// Number of the update, by which `places` tells old entries from new ones, dimensionless.
    stamp: u32,
    groups: Vec<ContactGroup>,
    rows: Vec<ContactPointConstraint>,
}

/// Settings of the pre-step, from the core.
#[derive(Debug, Clone, Copy)]
struct PreStep {
    /// Inverse of the length of the step, 1/s.
    inverse_dt: f32,
    /// Fraction of the penetration that is resolved per step, dimensionless.
    bias_factor: f32,
    /// Allowed penetration, px.
    slop: f32,
}

fn array(v: Vector3) -> [f32; 3] {
    [v.x, v.y, v.z]
}

impl Solver3 {
    /// Returns the number of scalar constraints that the solver handles per iteration.
    pub(crate) fn row_count(&self) -> usize {
        // A normal and two tangents per point; a shared normal counts once.
        let rows_of = |group: &ContactGroup| {
            let normals = if group.shares_pressure { 1 } else { group.row_count };
            (normals + 2 * group.row_count) as usize
        };
        self.groups.iter().map(rows_of).sum()
    }

    /// Gathers bodies and contacts, and computes effective masses, biases and bounces. This precedes the warm
    /// starts here and in the core, so that contacts bounce with their approach velocity.
    pub(crate) fn prepare(
        &mut self,
        core: &PhysicsSimulator,
        depths: &DepthState,
        list: &ContactList,
        inverse_dt: f32,
    ) {
        self.begin();
        for (touch, index) in list.touches.iter().zip(0..) {
            if touch.responds {
                self.gather(core, depths, list, touch, index);
            }
        }
        let settings =
            PreStep { inverse_dt, bias_factor: core.bias_factor(), slop: core.allowed_penetration() };
        for group in &self.groups {
            let touch = &list.touches[group.touch as usize];
            let pull = gravity_velocity(core, touch, inverse_dt);
            let bodies =
                [group.body_a, group.body_b].map(|place| self.states[place as usize].initial_body(core));
            let rows = group.first_row as usize..(group.first_row + group.row_count) as usize;
            for row in &mut self.rows[rows] {
                row.prepare(touch.restitution, pull, settings, &bodies);
            }
        }
    }

    fn begin(&mut self) {
        self.stamp = self.stamp.wrapping_add(1);
        if self.stamp == 0 {
            self.places.fill((0, 0));
            self.stamp = 1;
        }
        self.groups.clear();
        self.rows.clear();
        self.states.clear();
        self.states.push(SolverBodyState {
            place: None,
            id: None,
            centre: [0.0; 3],
            velocity_z: 0.0,
            angular_x: 0.0,
            angular_y: 0.0,
            bias_z: 0.0,
            inverse_mass: 0.0,
            inverse_inertia: 0.0,
            failed: false,
        });
    }

    fn gather(
        &mut self,
        core: &PhysicsSimulator,
        depths: &DepthState,
        list: &ContactList,
        touch: &Contact,
        index: u32,
    ) {
        let body_a = match touch.partner_body {
            Some(body) => self.gather_body(core, depths, body),
            None => Some(WORLD),
        };
        let (Some(body_a), Some(body_b)) = (body_a, self.gather_body(core, depths, touch.body)) else {
            return;
        };
        let [a, b] = [body_a, body_b].map(|body| &self.states[body as usize]);
        // A handler may have made both bodies static since the narrow phase.
        let is_solvable = a.inverse_mass + b.inverse_mass != 0.0;
        let centres = [a.centre, b.centre];
        if !is_solvable {
            return;
        }
        let first_row = self.rows.len() as u32;
        for point in list.points_of(touch) {
            self.rows.push(ContactPointConstraint::new(
                array(point.normal),
                array(point.position),
                centres,
                point,
            ));
        }
        self.groups.push(ContactGroup {
            body_a,
            body_b,
            touch: index,
            first_row,
            row_count: touch.point_count,
            friction: touch.friction,
            shares_pressure: touch.shares_pressure,
            is_dropped: false,
        });
    }

    fn gather_body(&mut self, core: &PhysicsSimulator, depths: &DepthState, id: BodyId) -> Option<u32> {
        let state = depths.bodies.get(id)?;
        if id.slot() >= self.places.len() {
            self.places.resize(id.slot() + 1, (0, 0));
        }
        if self.places[id.slot()].0 == self.stamp {
            return Some(self.places[id.slot()].1);
        }
        let body = core.body(id)?;
        // A body that is no ball rotates about the depth axis only.
        let (inverse_inertia, angular_x, angular_y) = if is_ball(core, depths, id) {
            (body.inverse_moment_of_inertia(), state.angular_velocity_x, state.angular_velocity_y)
        } else {
            (0.0, 0.0, 0.0)
        };
        let index = self.states.len() as u32;
        self.states.push(SolverBodyState {
            place: None,
            id: Some(id),
            centre: [body.position().x, body.position().y, state.z],
            velocity_z: state.velocity_z,
            angular_x,
            angular_y,
            bias_z: 0.0,
            inverse_mass: body.inverse_mass(),
            inverse_inertia,
            failed: false,
        });
        self.places[id.slot()] = (self.stamp, index);
        Some(index)
    }

    /// Runs an operation on the bodies of a group. If a velocity becomes infinite or NaN, both bodies keep
    /// their old state, the group is left out of this update and the body is marked as failed. Such values do
    /// not spread.
    #[inline]
    fn apply(
        &mut self,
        solved: &mut SolverBodiesView<'_>,
        index: usize,
        operation: impl FnOnce(&mut [ContactPointConstraint], &ContactGroup, &mut [SolverBody3; 2]),
    ) {
        let group = self.groups[index];
        if group.is_dropped {
            return;
        }
        let places = [group.body_a, group.body_b];
        let mut bodies = places.map(|place| self.load(solved, place));
        let rows = group.first_row as usize..(group.first_row + group.row_count) as usize;
        operation(&mut self.rows[rows], &group, &mut bodies);
        let are_finite = [bodies[0].is_finite(), bodies[1].is_finite()];
        if are_finite == [true; 2] {
            self.store(solved, group.body_a, &bodies[0]);
            self.store(solved, group.body_b, &bodies[1]);
        } else {
            self.drop_group(solved, index, are_finite);
        }
    }

    #[inline]
    fn load(&self, solved: &SolverBodiesView<'_>, place: u32) -> SolverBody3 {
        let state = &self.states[place as usize];
        let Some(plane) = state.place else { return SolverBody3::default() };
        let body = solved.get(plane);
        let [x, y, spin] = body.velocity;
        let [bias_x, bias_y, bias_spin] = body.bias;
        SolverBody3 {
            linear: [x, y, state.velocity_z],
            angular: [state.angular_x, state.angular_y, spin],
            bias: [bias_x, bias_y, state.bias_z],
            bias_spin,
            inverse_mass: body.inverse_mass,
            inverse_inertia: [state.inverse_inertia, state.inverse_inertia, body.inverse_inertia],
        }
    }

    #[inline]
    fn store(&mut self, solved: &mut SolverBodiesView<'_>, place: u32, body: &SolverBody3) {
        let state = &mut self.states[place as usize];
        let Some(plane) = state.place else { return };
        let [x, y, z] = body.linear;
        let [bias_x, bias_y, bias_z] = body.bias;
        let [angular_x, angular_y, spin] = body.angular;
        (state.velocity_z, state.bias_z) = (z, bias_z);
        (state.angular_x, state.angular_y) = (angular_x, angular_y);
        solved.set(
            plane,
            SolverBody {
                velocity: [x, y, spin],
                bias: [bias_x, bias_y, body.bias_spin],
                ..SolverBody::default()
            },
        );
    }

    #[cold]
    fn drop_group(&mut self, solved: &mut SolverBodiesView<'_>, index: usize, are_finite: [bool; 2]) {
        let group = &mut self.groups[index];
        group.is_dropped = true;
        for (place, is_finite) in [group.body_a, group.body_b].into_iter().zip(are_finite) {
            let state = &mut self.states[place as usize];
            if let (false, Some(plane)) = (is_finite, state.place) {
                state.failed = true;
                solved.fail(plane);
            }
        }
    }

    /// Stores velocities in the bodies, and impulses in the list. Failed bodies keep their velocities from
    /// before the solver.
    pub(crate) fn finish(
        &mut self,
        core: &mut PhysicsSimulator,
        depths: &mut DepthState,
        list: &mut ContactList,
    ) {
        for state in &self.states {
            let Some(kept) = state.id.and_then(|id| depths.bodies.get_mut(id)) else { continue };
            if !state.failed && state.inverse_mass != 0.0 {
                kept.velocity_z = state.velocity_z;
                kept.bias_z = state.bias_z;
                kept.angular_velocity_x = state.angular_x;
                kept.angular_velocity_y = state.angular_y;
            }
        }
        // Contacts that were not solved have no impulse.
        for point in &mut list.points {
            (point.normal_impulse, point.friction_impulse) = (0.0, [0.0; 2]);
        }
        for group in &self.groups {
            let touch = list.touches[group.touch as usize];
            let rows = &self.rows[group.first_row as usize..(group.first_row + group.row_count) as usize];
            for ((point, row), contact) in list.points_of_mut(&touch).iter_mut().zip(rows).zip(0..) {
                (point.normal_impulse, point.friction_impulse) = match group.is_dropped {
                    true => (0.0, [0.0; 2]),
                    false => (row.normal_impulse, row.friction_impulse),
                };
                if touch.is_plane() {
                    let position = touch.arbiter as usize;
                    core.set_arbiter_impulses(
                        position,
                        contact,
                        point.normal_impulse,
                        point.friction_impulse[0],
                    );
                }
            }
        }
    }
}

impl ExternalConstraints for Solver3 {
    fn is_empty(&self) -> bool {
        self.groups.is_empty()
    }

    fn warm_start(&mut self, solved: &mut SolverBodiesView<'_>) {
        for state in &mut self.states {
            state.place = state.id.and_then(|id| solved.place(id));
        }
        for index in 0..self.groups.len() {
            self.apply(solved, index, |rows, _, bodies| {
                for row in rows {
                    row.warm_start(bodies);
                }
            });
        }
    }

    fn solve(&mut self, solved: &mut SolverBodiesView<'_>) {
        for index in 0..self.groups.len() {
            self.apply(solved, index, |rows, group, bodies| {
                if group.shares_pressure {
                    kernel::solve_shared(rows, group.friction, bodies);
                } else {
                    for row in rows {
                        row.solve_normal(bodies);
                        row.solve_friction(group.friction * row.normal_impulse, bodies);
                    }
                }
            });
        }
    }
}

/// Returns the relative velocity of two bodies that gravity has added in this step, px/s. It does not count for the bounce:
/// otherwise a body that falls on a static one would gain height, hop forever and creep down slopes. Contacts adopted from the
/// core bounce by the core's rule, which counts this velocity.
fn gravity_velocity(core: &PhysicsSimulator, touch: &Contact, inverse_dt: f32) -> [f32; 3] {
    let part_of = |id: BodyId| {
        let body = core.body(id).filter(|body| is_movable(core, id) && !body.ignore_gravity());
        body.map_or(0.0, |body| body.gravity_scale())
    };
    let part = part_of(touch.body) - touch.partner_body.map_or(0.0, part_of);
    if touch.is_plane() || part == 0.0 {
        return [0.0; 3];
    }
    let gravity = core.gravity() * part;
    [gravity.x / inverse_dt, gravity.y / inverse_dt, 0.0]
}

/// Returns whether a body rolls in every direction: all of its geoms are balls about its centre of mass.
pub(crate) fn is_ball(core: &PhysicsSimulator, depths: &DepthState, body: BodyId) -> bool {
    let geoms = core.geoms_of(body);
    let is_round = |profile: Option<&DepthProfile>| profile.is_some_and(|profile| profile.is_round());
    let is_centred = |offset: crate::Vector2| offset.x == 0.0 && offset.y == 0.0;
    !geoms.is_empty()
        && geoms.iter().all(|&geom| {
            is_round(depths.profiles.get(geom))
                && core.geom(geom).is_some_and(|geom| is_centred(geom.offset()))
        })
}
