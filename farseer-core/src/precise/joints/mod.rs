//! Joints of the precise set.
//!
//! | articulation | solver |
//! |---|---|
//! | a tree without motors, limits or ropes that nothing touches | [articulated bodies](tree) in its own division of the step: [swing], [hinged] |
//! | any other | the [direct solver](super::direct), as [rows of its system](island_rows), if it takes it; in parts of the step if nothing touches it and it has no loop |
//! | all else, and soft joints | [soft rows](soft_step) of the iterative solver, beside the contacts |
//!
//! [Springs] of what is jointed or touched are rows beside these, of the direct or of the iterative solver.
//! Joints of a distance in three axes have solvers of their own: see [depth].

mod balance;
mod block_pair;
mod block_row;
mod colours;
mod depth;
mod forest;
mod frame;
mod hinged;
pub(super) mod hold;
pub(super) mod island_rows;
pub(super) mod read;
mod soft_block;
mod soft_law;
mod soft_pair;
mod soft_spring;
mod soft_step;
pub(super) mod springs;
pub(super) mod swing;
mod tree;

use super::bodies::Bodies;
use super::direct::joint::JointRows;
use super::rows::Row;
use super::tuning::Step;
use crate::body::BodyId;
use crate::objects::Objects;
use crate::storage::reusing_clone::reusing_clone;
use depth::{SpatialGroup, Tied, spatial_groups};
use forest::{Forest, GROUND, Seat};
use hinged::{Hinge, hinges_of};
use hold::{End, Hold, Key};
use soft_step::SoftJoints;
use springs::Springs;
use tree::{Link, Node, dot};

/// The joints of a step.
#[derive(Debug, Default)]
pub(super) struct Joints {
    /// In the order of the list of joints; not those that hold nothing now.
    holds: Vec<Hold>,
    /// Whether nothing about them, or the list of joints, has changed since they were read.
    is_read: bool,
    /// They were read anew in this update: their places in the list may be others.
    are_places_new: bool,
    /// Of the joints that were read: see [`signature`](Self::signature).
    last_signature: u64,
    /// Whether one of them breaks where it is too far from what it keeps.
    may_break: bool,
    groups: Vec<Group>,
    /// By joint: its group; the number of groups if it is in none.
    group_of: Vec<u32>,
    /// By body number: the place in its group, or [`GROUND`].
    seat_of: Vec<u32>,
    /// In three axes: who moves along the depth axis as one.
    tied: Vec<Tied>,
    /// And what hangs together by joints of which one keeps a distance.
    spatial: Vec<SpatialGroup>,
    /// The joints that the iterative solver has in this update.
    soft: SoftJoints,
    unit: f64,
}

reusing_clone! {
    Joints {
        holds, is_read, are_places_new, last_signature, may_break, groups, group_of, seat_of, tied, spatial, soft, unit
    }
}

/// Bodies that joints tie together.
#[derive(Debug, Default)]
struct Group {
    /// None if some joint is in no tree: one that closes a loop, has a motor or limits, or may give way.
    nodes: Vec<Node>,
    /// Its bodies that give way, and its joints.
    bodies: Vec<u32>,
    holds: Vec<u32>,
    /// Joints that are kept whatever that takes close a loop.
    has_loop: bool,
    /// The same tree again if all joints are hinges, else empty: what swings while nothing touches it.
    hinges: Vec<Hinge>,
    /// Nothing touches it.
    is_apart: bool,
    /// The direct solver has solved it in this step.
    is_solved: bool,
    /// Into how many parts its last step was divided.
    parts: u32,
}

reusing_clone! { Group { nodes, bodies, holds, has_loop, hinges, is_apart, is_solved, parts } }

/// A joint that the direct solver may take.
#[derive(Debug, Clone, Copy)]
pub(super) struct Candidate {
    /// Its place in the list of joints.
    pub(super) joint: u32,
    /// The numbers of its dynamic bodies; 0 for what is fixed.
    pub(super) bodies: [u32; 2],
    /// It is part of a free articulation, which swings by itself.
    pub(super) is_free: bool,
    /// Rows stand for it.
    pub(super) may_be_rows: bool,
    /// How far it is from what it keeps, in length units or radians.
    pub(super) error: f32,
}

impl Candidate {
    /// One of its dynamic bodies.
    pub(super) fn a_body(&self) -> Option<u32> {
        self.bodies.into_iter().find(|&body| body != 0)
    }
}

impl Joints {
    /// Whether all joints are in groups that nothing touches.
    pub(super) fn are_all_apart(&self) -> bool {
        self.spatial.iter().all(|group| group.is_apart()) && !self.groups.iter().any(Group::is_mixed)
    }

    /// Bodies that joints in the plane tie together, as lists.
    pub(super) fn articulations(&self) -> impl Iterator<Item = &[u32]> + '_ {
        self.groups.iter().map(|group| &group.bodies[..])
    }

    /// The joints in the plane as the direct solver sees them.
    pub(super) fn candidates(&self) -> impl Iterator<Item = Candidate> + '_ {
        self.groups.iter().flat_map(move |group| {
            let is_free = group.is_apart && group.is_tree();
            group.holds.iter().map(move |&at| {
                let hold = &self.holds[at as usize];
                Candidate {
                    joint: at,
                    bodies: hold.ends.map(|end| end.body),
                    is_free,
                    may_be_rows: hold.may_be_rows(),
                    error: hold.error.abs(),
                }
            })
        })
    }

    /// A joint by its place.
    pub(super) fn hold(&self, joint: u32) -> &Hold {
        &self.holds[joint as usize]
    }

    /// Whether a joint is part of a closed loop of joints, or of what hangs on one.
    pub(super) fn has_loop(&self, joint: u32) -> bool {
        self.groups[self.group_of[joint as usize] as usize].has_loop
    }

    /// The direct solver has found the force and torque of a joint in this step, and no other solver takes it.
    pub(super) fn take_force(&mut self, joint: u32, force: [f64; 3]) {
        self.holds[joint as usize].force = force;
        self.note_solved(joint);
    }

    /// The direct solver has found these rows of a joint: no other solver takes it in this step.
    pub(super) fn take_solution(&mut self, joint: u32, rows: &JointRows, dt: f64) {
        self.holds[joint as usize].bear(rows, dt);
        self.note_solved(joint);
    }

    /// The direct solver has left a joint as it was: no other solver takes it in this step.
    pub(super) fn note_solved(&mut self, joint: u32) {
        self.groups[self.group_of[joint as usize] as usize].is_solved = true;
    }

    /// Whether no joint holds anything.
    pub(super) fn are_none(&self) -> bool {
        self.holds.is_empty()
    }

    /// A number by which two lists of joints are told from each other (multiplicative hashing): which joints hold something, and
    /// which of their properties matter to the choice of a solver.
    pub(super) fn signature(&self) -> u64 {
        self.holds.iter().fold(self.holds.len() as u64, |sum, hold| {
            let [is_bounded, is_driven, is_row] =
                [hold.key().is_bounded, hold.drive.is_some(), hold.may_be_rows()].map(u64::from);
            let word = hold.joint.to_bits().rotate_left(3) ^ (is_bounded << 2 | is_driven << 1 | is_row);
            (sum.rotate_left(5) ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        })
    }

    /// Whether some joint holds a body.
    #[inline(always)]
    pub(super) fn holds(&self, body: usize) -> bool {
        self.seat_of.get(body).is_some_and(|&seat| seat != GROUND)
    }

    /// The bodies of groups that nothing touches, and into how many parts their step was divided.
    pub(super) fn swinging(&self, substeps: u32) -> impl Iterator<Item = (usize, u32)> + '_ {
        let apart = self.groups.iter().filter(|group| group.swings());
        let in_plane = apart.flat_map(|group| group.bodies.iter().map(|&body| (body, group.parts)));
        let apart = self.spatial.iter().filter(|group| group.is_apart());
        let in_space = apart.flat_map(move |group| {
            let parts = substeps * group.parts();
            group.bodies().iter().map(move |&body| (body, parts))
        });
        in_plane.chain(in_space).map(|(body, parts)| (body as usize, parts))
    }

    /// The bodies that each joint ties together, moved or not; 0 for the world.
    pub(super) fn ties(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        self.holds.iter().map(|hold| hold.ends.map(|end| end.pose as usize))
    }

    /// The motors that run: numbers of both bodies, 0 for the world; the speed that the motor seeks, rad/s or length units/s;
    /// and whether it is along a line.
    pub(super) fn motors(&self) -> impl Iterator<Item = ([usize; 2], f32, bool)> + '_ {
        self.holds.iter().filter_map(|hold| {
            let motor = hold.drive?.motor().filter(|motor| motor.greatest_effort > 0.0)?;
            Some((hold.ends.map(|end| end.pose as usize), motor.speed, hold.link == Link::Line))
        })
    }

    /// The bodies of those joints of which one is not listed.
    pub(super) fn of_unlisted(&self) -> impl Iterator<Item = (Option<BodyId>, BodyId)> + '_ {
        let is_unlisted = |hold: &&Hold| {
            let [first, second] = hold.ends.map(|end| end.pose == 0);
            second || (first && hold.bodies.0.is_some())
        };
        self.holds.iter().filter(is_unlisted).map(|hold| hold.bodies)
    }

    /// Whether nothing about joints has changed since they were read.
    pub(super) fn are_read(&self) -> bool {
        self.is_read
    }

    /// Whether some joint may be too far from what it keeps to go on.
    pub(super) fn may_break(&self) -> bool {
        !self.is_read || self.may_break
    }

    /// Plans for the joints that were read.
    fn plan(&mut self, bodies: &Bodies, is_in_space: bool) {
        (self.tied, self.spatial) = (Vec::new(), Vec::new());
        let mut in_plane: Vec<u32> = (0..self.holds.len() as u32).collect();
        if is_in_space {
            (self.spatial, in_plane) = spatial_groups(&self.holds, bodies);
            let of_plane: Vec<Hold> = in_plane.iter().map(|&at| self.holds[at as usize]).collect();
            self.tied = Tied::all(&of_plane, bodies.hot.len());
        }
        for &at in &in_plane {
            self.holds[at as usize].force_along_depth = 0.0;
        }
        let keys: Vec<Key> = in_plane.iter().map(|&at| self.holds[at as usize].key()).collect();
        let Forest { mut groups, mut seat_of } = Forest::new(&keys, bodies.first_fixed());
        groups.iter_mut().for_each(|group| group.name_holds(&in_plane));
        for &body in self.spatial.iter().flat_map(SpatialGroup::bodies) {
            // It is held, if by no tree.
            seat_of[body as usize] = 0;
        }
        let holds = &self.holds;
        let group_of = |plan: forest::Group| {
            let of_group = plan.seats.iter().map(|seat| seat.body).filter(|&body| body != 0).collect();
            let is_driven = |&at: &u32| holds[at as usize].drive.is_some();
            let is_tree = plan.loose.is_empty() && !plan.joints.iter().any(is_driven);
            let seats = if is_tree { &plan.seats[..] } else { &[] };
            let nodes: Vec<Node> = seats.iter().map(|seat| node_of(seat, holds, bodies)).collect();
            let hinges = hinges_of(&nodes, holds);
            let has_loop = plan.loose.iter().any(|&at| !holds[at as usize].key().is_bounded);
            Group { nodes, bodies: of_group, holds: plan.joints, has_loop, hinges, ..Group::default() }
        };
        self.groups = groups.into_iter().map(group_of).collect();
        self.group_of.clear();
        self.group_of.resize(self.holds.len(), self.groups.len() as u32);
        for (at, group) in self.groups.iter().enumerate() {
            group.holds.iter().for_each(|&hold| self.group_of[hold as usize] = at as u32);
        }
        self.seat_of = seat_of;
        self.soft.plan(&self.holds, &in_plane, bodies.first_fixed());
    }

    /// A step begins: joints go where their bodies are.
    fn begin(&mut self, bodies: &Bodies, objects: &Objects, is_touched: impl Fn(usize) -> bool) {
        let Joints { groups, holds, .. } = self;
        for group in groups {
            // A soft joint is not exact in any substep: it needs all of them.
            let is_soft = group.holds.iter().any(|&at| holds[at as usize].softness > 0.0);
            group.is_apart = !is_soft && !group.bodies.iter().any(|&body| is_touched(body as usize));
            group.is_solved = false;
            if !group.is_hinged() {
                group.holds.iter().for_each(|&at| holds[at as usize].follow(bodies, objects));
            }
        }
    }

    /// A step begins in three axes; `depth_of` answers where along the depth axis a body is.
    fn begin_in_space(
        &mut self,
        (bodies, objects): (&Bodies, &Objects),
        (step, unit): (&Step, f32),
        is_touched: impl Fn(usize) -> bool,
        depth_of: impl Fn(BodyId) -> f32,
    ) {
        let times = [f64::from(step.dt), f64::from(step.h)];
        for group in &mut self.spatial {
            group.holds().for_each(|at| self.holds[at].follow(bodies, objects));
            group.part_from_others(&is_touched);
            group.begin(&self.holds, bodies, times, f64::from(unit), |hold, side| {
                match (side, hold.bodies) {
                    (0, (None, _)) => 0.0,
                    (0, (Some(first), _)) => depth_of(first),
                    (_, (_, second)) => depth_of(second),
                }
            });
        }
    }

    /// The groups in three axes that something touches.
    fn mixed_in_space(&mut self) -> impl Iterator<Item = (&mut SpatialGroup, &[Hold])> {
        let Joints { spatial, holds, .. } = self;
        spatial.iter_mut().filter(|group| !group.is_apart()).map(|group| (group, &holds[..]))
    }

    /// Moves the groups that nothing touches, and that are not hinged, through all substeps.
    pub(super) fn swing(&mut self, bodies: &Bodies, step: &Step) {
        let swinging = |group: &&mut Group| group.swings() && !group.is_hinged();
        for group in self.groups.iter_mut().filter(swinging) {
            swing::swing(group, &self.holds, bodies, step, self.unit);
        }
        self.spatial.iter_mut().for_each(|group| group.swing(&self.holds, bodies, step));
    }

    /// What moves along the depth axis as one gets one velocity.
    pub(super) fn share_depth(&self, bodies: &mut Bodies) {
        self.tied.iter().for_each(|tied| tied.share(bodies));
    }

    /// And one way, after a step in which nothing has pushed it.
    pub(super) fn share_depth_of_flight(&self, bodies: &mut Bodies, dt: f32) {
        self.tied.iter().for_each(|tied| tied.share_way(bodies, dt));
    }

    /// An update begins, in which no joint or spring is one of the iterative solver's so far.
    fn begin_update(&mut self, unit: f32) {
        self.unit = f64::from(unit);
        self.soft.forget();
    }

    /// The joints and springs of the iterative solver begin an update.
    pub(super) fn begin_passes(&mut self, springs: &Springs, bodies: &Bodies, step: &Step) {
        let Joints { soft, groups, group_of, holds, unit, .. } = self;
        if groups.iter().any(Group::is_mixed) || !springs.are_all_solved() {
            let is_mixed = |at: usize| groups[group_of[at] as usize].is_mixed();
            soft.begin((holds, springs), is_mixed, (bodies, step), *unit);
        }
    }

    /// Impulses of the joints of the iterative solver act at the beginning of each substep.
    pub(super) fn warm(&self, bodies: &mut Bodies) {
        self.soft.warm(bodies);
    }

    /// By body number a mask of all bits for bodies with joints in the iterative solver; `None` if there are none in this update.
    pub(super) fn soft_bodies(&self) -> Option<&[u32]> {
        (!self.soft.is_empty()).then(|| self.soft.masks())
    }

    /// Whether a body has joints that the iterative solver had in this update.
    pub(super) fn is_soft(&self, body: usize) -> bool {
        self.soft.masks().get(body).is_some_and(|&mask| mask != 0)
    }

    /// A pass before bodies move.
    pub(super) fn correct(&mut self, bodies: &mut Bodies, h: f32) {
        self.mixed_in_space().for_each(|(group, holds)| group.correct(holds, bodies, h.into()));
        self.soft.solve_soft(bodies, h);
    }

    /// No body with joints in the iterative solver moves faster than those may.
    pub(super) fn limit_speeds(&self, bodies: &mut Bodies, h: f32) {
        self.soft.limit_speeds(bodies, self.unit as f32, h);
    }

    /// Bodies have moved.
    pub(super) fn advance(&mut self, bodies: &mut Bodies, h: f32) {
        self.mixed_in_space().for_each(|(group, _)| group.advance(bodies, h.into()));
        self.soft.advance(bodies);
    }

    /// A pass after bodies have moved: velocities as joints allow them.
    pub(super) fn relax(&mut self, bodies: &mut Bodies, h: f32) {
        self.mixed_in_space().for_each(|(group, holds)| group.relax(holds, bodies, h.into()));
        self.soft.relax(bodies, h);
    }

    /// A pass over contacts that bounce begins.
    pub(super) fn begin_bounce(&mut self) {
        self.soft.begin_bounce();
    }

    /// These lanes of a row have bounced.
    #[inline(always)]
    pub(super) fn note_bounce<const P: usize>(&mut self, row: &Row<P>, lanes: u32) {
        self.soft.note_bounce(row, lanes);
    }

    /// Joints of the iterative solver share the blows of the bodies that have bounced. Answers the greatest speed that one missed, in
    /// length units per second.
    pub(super) fn bounce(&mut self, bodies: &mut Bodies) -> f32 {
        self.soft.bounce(bodies, self.unit as f32)
    }

    /// Moves the hinged groups that nothing touches through all substeps; where all others that nothing touched have come to,
    /// and what has held all joints.
    pub(super) fn finish(&mut self, bodies: &mut Bodies, step: &Step) {
        let (dt, per_second) = (f64::from(step.dt), 1.0 / f64::from(step.dt));
        self.spatial.iter().for_each(|group| group.finish(&mut self.holds, bodies, dt));
        self.soft.finish(&mut self.holds, [step.dt, step.h]);
        for group in self.groups.iter_mut().filter(|group| group.swings()) {
            if group.is_hinged() {
                group.parts = hinged::swing(&mut group.hinges, &mut self.holds, bodies, step, self.unit);
                continue;
            }
            for node in group.nodes.iter().filter(|node| node.body != 0) {
                let ([vx, vy, spin], [x, y, turned]) = (node.velocity, node.path);
                // Along the depth axis nothing holds them.
                let (velocity, path) =
                    (&mut bodies.hot[node.body as usize].velocity, &mut bodies.path[node.body as usize]);
                *velocity = [vx as f32, vy as f32, spin as f32, velocity[3]];
                *path = [x as f32, y as f32, turned as f32, path[3]];
            }
            for node in group.nodes.iter().filter(|node| node.link.holds()) {
                let force_of_impulse = node.sign() * per_second;
                self.holds[node.joint as usize].force = node.total.map(|impulse| impulse * force_of_impulse);
            }
        }
    }
}

impl Group {
    /// Whether it swings by its hinges in this step.
    fn is_hinged(&self) -> bool {
        self.swings() && !self.hinges.is_empty()
    }

    /// Whether all of its joints are in trees.
    fn is_tree(&self) -> bool {
        !self.nodes.is_empty()
    }

    /// Whether it is a free articulation, which moves by itself in this step.
    fn swings(&self) -> bool {
        self.is_apart && self.is_tree() && !self.is_solved
    }

    /// Whether the iterative solver has its joints in this step.
    fn is_mixed(&self) -> bool {
        !(self.is_solved || self.swings())
    }
}

/// What stands for a body.
fn node_of(seat: &Seat, holds: &[Hold], bodies: &Bodies) -> Node {
    let [mass, inertia] = bodies.inverses[seat.body as usize].map(weight_of);
    let mut node = Node {
        body: seat.body,
        parent: seat.parent,
        link: if seat.body == 0 { Link::Fixed } else { Link::Free },
        mass,
        inertia,
        ..Node::default()
    };
    if let Some(at) = seat.hold {
        (node.joint, node.link) = (at, holds[at as usize].link);
        // The joint is the first body's view of the second; a tree's is the parent's view of the child.
        node.is_first = holds[at as usize].ends[0].body == seat.body;
    }
    node
}

/// Mass or inertia of what cannot be moved or turned: so great that nothing that is pushed can tell.
pub(super) const IMMOVABLE: f64 = 1e60;

/// A mass from its reciprocal.
pub(super) fn weight_of(inverse: f32) -> f64 {
    if inverse > 0.0 { 1.0 / f64::from(inverse) } else { IMMOVABLE }
}

/// Nodes go where their bodies and joints are; what does not give way is where its joint says.
fn begin_nodes(nodes: &mut [Node], holds: &[Hold], bodies: &Bodies, h: f64) {
    for at in 0..nodes.len() {
        let node = &mut nodes[at];
        node.begin(bodies);
        if !node.link.holds() {
            // Turned about, a zero might have got another sign.
            node.arm = [0.0; 2];
        } else {
            let side = node.hang(&holds[node.joint as usize], h);
            let (parent, reach) = (node.parent as usize, dot(side.arm, side.arm));
            nodes[parent].reach = nodes[parent].reach.max(reach);
            if nodes[parent].link == Link::Fixed {
                (nodes[parent].place, nodes[parent].velocity) = (side.place, side.velocity);
            }
        }
    }
}

impl Node {
    /// 1 for the second body of a joint, which its force is on, and -1 for the first.
    #[inline(always)]
    fn sign(&self) -> f64 {
        if self.is_first { -1.0 } else { 1.0 }
    }

    /// A step begins.
    #[inline(always)]
    fn begin(&mut self, bodies: &Bodies) {
        let body = self.body as usize;
        let ([x, y, ..], [vx, vy, spin, _]) = (bodies.poses[body], bodies.hot[body].velocity);
        self.place = [f64::from(x), f64::from(y)];
        self.velocity = [vx, vy, spin].map(f64::from);
        (self.path, self.reach) = ([0.0; 3], 0.0);
    }

    /// Hangs on a joint as it is now. Answers the side of the parent.
    #[inline(always)]
    fn hang<'a>(&mut self, hold: &'a Hold, h: f64) -> &'a End {
        let [first, second] = &hold.ends;
        let (parent, child) = if self.is_first { (second, first) } else { (first, second) };
        (self.arm, self.parent_arm) = (child.arm, parent.arm);
        self.reach = dot(self.arm, self.arm);
        self.wanted = match hold.link {
            Link::Distance => hold.range[1],
            _ => self.sign() * (hold.angle - hold.range[1]),
        };
        let impulse_of_force = self.sign() * h;
        self.impulse = hold.force.map(|force| force * impulse_of_force);
        self.total = [0.0; 3];
        // Nothing that is not saved may matter.
        self.direction = if hold.link == Link::Line { hold.axis } else { [1.0, 0.0] };
        parent
    }
}
