//! Sequential impulses in three axes, inside the iterations of the 2D engine.
//!
//! Everything works as there (behaviour chapter 03, section 6): impulses of the last update act again, normal
//! impulses only push, overlap is undone by velocities of its own, and friction is limited by the normal impulse.
//! Friction has two tangents, solved as one block and held within a disc (Coulomb's law); where nothing slides along
//! Z that is the 2D engine's clamp. Velocities in X and Y are those of the 2D engine's solver; what lies along Z
//! is kept here.
//!
//! Frame: x right, y down, z into the picture; right-handed, so that rotation about z is the 2D engine's.

mod kernel;

use farseer_core::{BodyId, Constraints, PhysicsSimulator, SolvedBodies, SolverBody, SolverPlace};

use crate::Vector3;
use crate::depth::{DepthProfile, Depths, Touch, TouchList, is_movable};
use kernel::{Row, SpaceBody};

/// A body as far as the 2D engine's solver does not keep it.
#[derive(Debug, Clone, Copy)]
struct DepthState {
    /// In the 2D engine's solver, once that has begun; `None` for what is no body.
    place: Option<SolverPlace>,
    id: Option<BodyId>,
    /// Centre of mass.
    centre: [f32; 3],
    velocity_z: f32,
    angular_x: f32,
    angular_y: f32,
    /// Velocity along Z that only undoes overlap.
    bias_z: f32,
    inverse_mass: f32,
    /// About the axes x and y; 0 for what turns about the depth axis only.
    inverse_inertia: f32,
    failed: bool,
}

impl DepthState {
    /// The body before anything is solved.
    fn begin_with(&self, core: &PhysicsSimulator) -> SpaceBody {
        let Some(body) = self.id.and_then(|id| core.body(id)) else { return SpaceBody::default() };
        let velocity = body.linear_velocity();
        SpaceBody {
            linear: [velocity.x, velocity.y, self.velocity_z],
            angular: [self.angular_x, self.angular_y, body.angular_velocity()],
            inverse_mass: body.inverse_mass(),
            inverse_inertia: [self.inverse_inertia, self.inverse_inertia, body.inverse_moment_of_inertia()],
            ..SpaceBody::default()
        }
    }
}

/// Place of the immovable rest of the world among the states.
const WORLD: u32 = 0;

/// The points of one contact.
#[derive(Debug, Clone, Copy)]
struct ContactGroup {
    body_a: u32,
    body_b: u32,
    touch: u32,
    first_row: u32,
    row_count: u32,
    friction: f32,
    /// The rows share one normal impulse: each bears an equal part.
    shares_pressure: bool,
    /// It made a velocity infinite or NaN, and is out of this update.
    is_dropped: bool,
}

/// The arrays of the solver, reused from update to update.
#[derive(Debug, Clone, Default)]
pub(crate) struct SpaceSolver {
    states: Vec<DepthState>,
    /// By body slot: stamp of the update in which it was gathered, and where to.
    places: Vec<(u32, u32)>,
    stamp: u32,
    groups: Vec<ContactGroup>,
    rows: Vec<Row>,
}

/// Settings of the pre-step, those of the 2D engine.
#[derive(Debug, Clone, Copy)]
struct PreStep {
    inverse_dt: f32,
    bias_factor: f32,
    slop: f32,
}

fn array(v: Vector3) -> [f32; 3] {
    [v.x, v.y, v.z]
}

impl SpaceSolver {
    /// Number of scalar rows that every iteration solves.
    pub(crate) fn row_count(&self) -> usize {
        // A normal and two tangents per point; a shared normal counts once.
        let rows_of = |group: &ContactGroup| {
            let normals = if group.shares_pressure { 1 } else { group.row_count };
            (normals + 2 * group.row_count) as usize
        };
        self.groups.iter().map(rows_of).sum()
    }

    /// Gathers bodies and contacts, and computes masses, biases and bounces: before the impulses of the last update
    /// act again, here and in the 2D engine, so that things bounce with the speed with which they arrived.
    pub(crate) fn prepare(
        &mut self,
        core: &PhysicsSimulator,
        depths: &Depths,
        list: &TouchList,
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
            let pull = pull_of(core, touch, inverse_dt);
            let bodies =
                [group.body_a, group.body_b].map(|place| self.states[place as usize].begin_with(core));
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
        self.states.push(DepthState {
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
        depths: &Depths,
        list: &TouchList,
        touch: &Touch,
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
        // A handler may have made both immovable since they were found to touch.
        let is_solvable = a.inverse_mass + b.inverse_mass != 0.0;
        let centres = [a.centre, b.centre];
        if !is_solvable {
            return;
        }
        let first_row = self.rows.len() as u32;
        for point in list.points_of(touch) {
            self.rows.push(Row::new(array(point.normal), array(point.position), centres, point));
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

    fn gather_body(&mut self, core: &PhysicsSimulator, depths: &Depths, id: BodyId) -> Option<u32> {
        let state = depths.bodies.get(id)?;
        if id.slot() >= self.places.len() {
            self.places.resize(id.slot() + 1, (0, 0));
        }
        if self.places[id.slot()].0 == self.stamp {
            return Some(self.places[id.slot()].1);
        }
        let body = core.body(id)?;
        // What is no ball turns about the depth axis only, whatever it was before.
        let (inverse_inertia, angular_x, angular_y) = if is_ball(core, depths, id) {
            (body.inverse_moment_of_inertia(), state.angular_velocity_x, state.angular_velocity_y)
        } else {
            (0.0, 0.0, 0.0)
        };
        let index = self.states.len() as u32;
        self.states.push(DepthState {
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

    /// Runs an operation on the bodies of a group. Should it make one infinite or NaN, both keep what they had
    /// before, the group is out of this update and the body is noted as failed: nothing spreads.
    #[inline]
    fn apply(
        &mut self,
        solved: &mut SolvedBodies<'_>,
        index: usize,
        operation: impl FnOnce(&mut [Row], &ContactGroup, &mut [SpaceBody; 2]),
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
    fn load(&self, solved: &SolvedBodies<'_>, place: u32) -> SpaceBody {
        let state = &self.states[place as usize];
        let Some(plane) = state.place else { return SpaceBody::default() };
        let body = solved.get(plane);
        let [x, y, spin] = body.velocity;
        let [bias_x, bias_y, bias_spin] = body.bias;
        SpaceBody {
            linear: [x, y, state.velocity_z],
            angular: [state.angular_x, state.angular_y, spin],
            bias: [bias_x, bias_y, state.bias_z],
            bias_spin,
            inverse_mass: body.inverse_mass,
            inverse_inertia: [state.inverse_inertia, state.inverse_inertia, body.inverse_inertia],
        }
    }

    #[inline]
    fn store(&mut self, solved: &mut SolvedBodies<'_>, place: u32, body: &SpaceBody) {
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
    fn drop_group(&mut self, solved: &mut SolvedBodies<'_>, index: usize, are_finite: [bool; 2]) {
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

    /// Writes velocities back, and impulses into the list. Bodies that failed keep the velocities with which the
    /// solver began.
    pub(crate) fn finish(&mut self, core: &mut PhysicsSimulator, depths: &mut Depths, list: &mut TouchList) {
        for state in &self.states {
            let Some(kept) = state.id.and_then(|id| depths.bodies.get_mut(id)) else { continue };
            if !state.failed && state.inverse_mass != 0.0 {
                kept.velocity_z = state.velocity_z;
                kept.bias_z = state.bias_z;
                kept.angular_velocity_x = state.angular_x;
                kept.angular_velocity_y = state.angular_y;
            }
        }
        // What was not solved has carried nothing, whatever it carried before.
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

impl Constraints for SpaceSolver {
    fn is_empty(&self) -> bool {
        self.groups.is_empty()
    }

    fn warm_start(&mut self, solved: &mut SolvedBodies<'_>) {
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

    fn solve(&mut self, solved: &mut SolvedBodies<'_>) {
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

/// Velocity relative to each other that gravity has given two things in this step. They bounce with the speed with
/// which they arrived: with that of the step as well, what falls on something immovable would gain height, hop for
/// ever and creep down slopes. Contacts that were taken over from the 2D engine bounce as there, where it counts.
fn pull_of(core: &PhysicsSimulator, touch: &Touch, inverse_dt: f32) -> [f32; 3] {
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

/// Whether a body rolls in every direction: all of its geoms are round about its own centre.
pub(crate) fn is_ball(core: &PhysicsSimulator, depths: &Depths, body: BodyId) -> bool {
    let geoms = core.geoms_of(body);
    let is_round = |profile: Option<&DepthProfile>| profile.is_some_and(|profile| profile.is_round());
    let is_centred = |offset: crate::Vector2| offset.x == 0.0 && offset.y == 0.0;
    !geoms.is_empty()
        && geoms.iter().all(|&geom| {
            is_round(depths.profiles.get(geom))
                && core.geom(geom).is_some_and(|geom| is_centred(geom.offset()))
        })
}
