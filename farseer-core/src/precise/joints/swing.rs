//! Where trees of joints go in a substep.
//!
//! **Positions, not only velocities.** A substep asks for the velocity v' with which the joints hold at its *end*: with r the
//! arms, R the turning of a body in the substep and C the error of a point, C(x + h v') = 0. Linear in v' about the velocity
//! v before the joints act: J v' = J v - C(x + h v) / h, of which v falls out but for the spin: for each side of a joint
//! (x + R r) / h - w p, p the velocity of the anchor by a spin of 1. That is a step of SHAKE (J.-P. Ryckaert, G. Ciccotti,
//! H. Berendsen 1977) with one iteration, or two. Forces act by halves at the beginning and the end of a step, and the
//! velocity after it obeys the joints (RATTLE, H. C. Andersen 1983): as far as that goes the method is symplectic, and energy
//! does not drift. Where joints pull so hard that [`stiffen`] adds to inertia, as in a whip, it takes energy away. Large
//! groups get whole kicks at the beginning instead, which makes the same way.

use super::super::bodies::Bodies;
use super::super::tuning::Step;
use super::Group;
use super::hold::Hold;
use super::loose::{Loose, Pass, Room, refine_group, solve_group};
use super::tree::{Link, Node, Vector, dot, plus, spun};

/// An error is undone in one substep up to this part of the length unit; a greater one in more of them.
const CLOSED_AT_ONCE: f64 = 0.5;

/// Groups up to this size are divided into all substeps, and those beyond the other one only where something turns fast.
const FEW: u32 = 8;
const MANY: u32 = 50;

/// How often a part of a step is looked at anew because of a jerk.
const JERKS: usize = 3;

/// Radians that a body of a larger group may turn in a part of a step.
const TURNED_AT_ONCE: f64 = 0.15;

/// The stiffness that the inertia of a body bears in a substep, as a part of it.
const BORNE: f64 = 0.3;

/// Cosine and sine of how far a body turns in a substep: a Taylor series, right to 1e-10 for less than 0.3.
#[inline(always)]
pub(super) fn turn(angle: f64) -> [f64; 2] {
    if angle * angle > 1.0 {
        let (sine, cosine) = libm::sincos(angle);
        return [cosine, sine];
    }
    let x = angle * angle;
    let sine = angle * (1.0 - x * (1.0 / 6.0) * (1.0 - x * (1.0 / 20.0) * (1.0 - x * (1.0 / 42.0))));
    let cosine =
        1.0 - x * 0.5 * (1.0 - x * (1.0 / 12.0) * (1.0 - x * (1.0 / 30.0) * (1.0 - x * (1.0 / 56.0))));
    [cosine, sine]
}

/// Cosine, and sine less the angle: what a turn does to an arm besides taking it along. What the series leaves out is an
/// error of 1e-6 of the arm for 0.3, which the next substep finds.
#[inline(always)]
pub(super) fn aside_of_turn(angle: f64) -> [f64; 2] {
    if angle * angle > 1.0 {
        let [cosine, sine] = turn(angle);
        return [cosine, sine - angle];
    }
    let x = angle * angle;
    [1.0 - x * (0.5 - x * (1.0 / 24.0)), -angle * x * (1.0 / 6.0 - x * (1.0 / 120.0))]
}

#[inline(always)]
pub(super) fn turned([c, s]: [f64; 2], [x, y]: Vector) -> Vector {
    [c * x - s * y, s * x + c * y]
}

/// Lets joints ask for the velocities with which they hold at the end of a substep.
#[inline]
pub(super) fn aim(nodes: &mut [Node], h: f64, unit: f64) {
    for node in nodes.iter_mut() {
        node.turn = aside_of_turn(node.velocity[2] * h);
    }
    for at in 0..nodes.len() {
        let parent = Side::of(&nodes[nodes[at].parent as usize], nodes[at].parent_arm);
        let node = &mut nodes[at];
        let child = Side::of(node, node.arm);
        match node.link {
            Link::Free | Link::Fixed => {}
            Link::Point => node.bias = aim_point(node, &child, &parent, h, unit),
            Link::Distance => node.bias[0] = aim_distance(node, &child, &parent, h, unit),
            Link::Angle => node.bias[2] = aim_angle(node, &child, &parent, h),
            Link::Weld => {
                node.bias = aim_point(node, &child, &parent, h, unit);
                node.bias[2] = aim_angle(node, &child, &parent, h);
            }
            Link::Line => node.bias = aim_line(node, &child, &parent, h, unit),
        }
    }
}

/// Lets joints ask for velocities with which they go on to hold. A soft one yields to what it has held with already.
#[inline]
pub(super) fn rest(nodes: &mut [Node]) {
    for at in 0..nodes.len() {
        nodes[at].bias = [0.0; 3];
        if nodes[at].softness > 0.0 {
            let parent = nodes[nodes[at].parent as usize].place;
            let node = &mut nodes[at];
            let error = node.apart(parent);
            let held = [node.kept_impulse[0], node.kept_impulse[1]];
            let [x, y] = match node.link {
                Link::Distance => {
                    let beyond = dot(error, node.direction) - node.wanted;
                    [beyond * node.rate + dot(held, node.direction) * node.softness, 0.0]
                }
                _ => plus([error[0] * node.rate, error[1] * node.rate], held, node.softness),
            };
            node.bias = [-x, -y, 0.0];
        }
    }
}

/// Bodies move, and the arms of their joints turn.
#[inline]
pub(super) fn advance(nodes: &mut [Node], h: f64) {
    for node in nodes.iter_mut() {
        let [x, y, spin] = node.velocity.map(|velocity| velocity * h);
        node.place = plus(node.place, [x, y], 1.0);
        node.path = [node.path[0] + x, node.path[1] + y, node.path[2] + spin];
        node.turn = turn(spin);
        node.arm = turned(node.turn, node.arm);
    }
    for at in 0..nodes.len() {
        let turn = nodes[nodes[at].parent as usize].turn;
        nodes[at].parent_arm = turned(turn, nodes[at].parent_arm);
        match nodes[at].link {
            Link::Distance => {
                let parent = nodes[nodes[at].parent as usize].place;
                nodes[at].find_direction(parent);
            }
            Link::Line => {
                let first = if nodes[at].is_first { nodes[at].turn } else { turn };
                nodes[at].direction = turned(first, nodes[at].direction);
            }
            _ => {}
        }
    }
}

impl Node {
    /// What of its stiffness is more than the inertia bears.
    fn excess(&self) -> f64 {
        let excess = self.pull - BORNE * (self.inertia + self.mass * self.reach);
        if excess > 0.0 && self.link != Link::Fixed { excess } else { 0.0 }
    }

    /// Finds the direction from the anchor of the parent, whose origin is here, and answers the distance. Anchors on one spot
    /// have none: that which they had last in this step, or any, will do.
    fn find_direction(&mut self, parent: Vector) -> f64 {
        let apart = self.apart(parent);
        let distance = dot(apart, apart).sqrt();
        if distance > 0.0 {
            self.direction = [apart[0] / distance, apart[1] / distance];
        }
        distance
    }

    /// From the anchor of the parent, whose origin is here, to the body's.
    #[inline(always)]
    pub(super) fn apart(&self, parent: Vector) -> Vector {
        plus(plus(self.place, self.arm, 1.0), plus(parent, self.parent_arm, 1.0), -1.0)
    }
}

/// One side of a joint as a substep begins.
struct Side {
    place: Vector,
    velocity: [f64; 3],
    arm: Vector,
    /// The arm at the end of the substep, less the way that the turning at the beginning would take the anchor.
    aside: Vector,
    angle: f64,
}

impl Side {
    #[inline(always)]
    fn of(node: &Node, arm: Vector) -> Self {
        Side {
            place: node.place,
            velocity: node.velocity,
            arm,
            aside: turned(node.turn, arm),
            angle: node.path[2],
        }
    }

    /// Where the anchor is at the end of the substep, less the way that its velocity at the beginning would take it.
    #[inline(always)]
    fn aside(&self) -> Vector {
        plus(self.place, self.aside, 1.0)
    }

    #[inline(always)]
    fn anchor(&self) -> Vector {
        plus(self.place, self.arm, 1.0)
    }

    #[inline(always)]
    fn anchor_velocity(&self) -> Vector {
        plus([self.velocity[0], self.velocity[1]], spun(self.arm), self.velocity[2])
    }
}

/// The part of an error of this size that is left for later substeps.
#[inline(always)]
fn postponed(size: f64, at_once: f64) -> f64 {
    if size > at_once { 1.0 - at_once / size } else { 0.0 }
}

#[inline(always)]
fn aim_point(node: &Node, child: &Side, parent: &Side, h: f64, unit: f64) -> [f64; 3] {
    let error = plus(child.anchor(), parent.anchor(), -1.0);
    if node.softness > 0.0 {
        return [-error[0] * node.rate, -error[1] * node.rate, 0.0];
    }
    let later = postponed(dot(error, error).sqrt(), CLOSED_AT_ONCE * unit);
    let [x, y] = plus(plus(child.aside(), parent.aside(), -1.0), error, -later);
    let rate = -1.0 / h;
    [x * rate, y * rate, 0.0]
}

#[inline(always)]
fn aim_distance(node: &mut Node, child: &Side, parent: &Side, h: f64, unit: f64) -> f64 {
    let error = node.find_direction(parent.place) - node.wanted;
    if node.softness > 0.0 {
        return -error * node.rate;
    }
    let way = plus(child.anchor_velocity(), parent.anchor_velocity(), -1.0);
    let speed = dot(node.direction, way);
    let aside = plus(child.aside(), parent.aside(), -1.0);
    let ahead = plus(aside, way, h);
    let later = error * postponed(error.abs(), CLOSED_AT_ONCE * unit);
    speed - (dot(ahead, ahead).sqrt() - node.wanted - later) / h
}

#[inline(always)]
fn aim_angle(node: &Node, child: &Side, parent: &Side, h: f64) -> f64 {
    let error = node.wanted + child.angle - parent.angle;
    -error * (1.0 - postponed(error.abs(), CLOSED_AT_ONCE)) / h
}

/// What is off a line changes as the joint's bodies move against each other where the child's anchor is, and as the line turns.
#[inline(always)]
fn aim_line(node: &Node, child: &Side, parent: &Side, h: f64, unit: f64) -> [f64; 3] {
    let turning = aim_angle(node, child, parent, h);
    let across = spun(node.direction);
    let first = if node.is_first { child } else { parent };
    let apart = plus(child.anchor(), parent.anchor(), -1.0);
    let way = plus(child.anchor_velocity(), parent.anchor_velocity(), -1.0);
    let ahead = plus(plus(child.aside(), parent.aside(), -1.0), way, h);
    let off = dot(across, apart);
    let left = dot(turned(turn(first.velocity[2] * h), across), ahead)
        - off * postponed(off.abs(), CLOSED_AT_ONCE * unit);
    let along = dot(node.direction, apart);
    // The line is the child's: it turns with a spin that is about to change.
    let own = if node.is_first { along * (turning - (child.velocity[2] - parent.velocity[2])) } else { 0.0 };
    let speed = dot(across, way) - parent.velocity[2] * along;
    let [x, y] = across.map(|part| part * (speed + own - left / h));
    [x, y, turning]
}

/// Tension makes a joint stiff against turning, and a stiff thing overshoots where a substep is too long for it: a chain
/// whose links carry more than they weigh for long enough would be torn to pieces. What is more than the inertia bears is
/// added to it, as an implicit step would (M. Tournier et al., "Stable constrained dynamics", 2015; S. Andrews et al.,
/// "Geometric stiffness for real-time constrained multibody dynamics", 2017).
pub(super) fn stiffen(nodes: &mut [Node], h: f64) {
    find_stiffness(nodes, h);
    for node in nodes.iter_mut() {
        node.stiffness = node.excess();
    }
}

/// [`stiffen`] anew where joints have had to pull far more than before: something has come to the end of its chain.
fn stiffen_for_jerk(nodes: &mut [Node], h: f64) -> bool {
    find_stiffness(nodes, h);
    let is_jerked =
        |node: &Node| node.excess() > node.stiffness + BORNE * (node.inertia + node.mass * node.reach);
    let has_jerk = nodes.iter().any(is_jerked);
    if has_jerk {
        for node in nodes.iter_mut() {
            let excess = node.excess();
            node.stiffness = if excess > node.stiffness { excess } else { node.stiffness };
        }
    }
    has_jerk
}

/// How stiff the impulses of a substep of this length make bodies against turning.
fn find_stiffness(nodes: &mut [Node], h: f64) {
    for node in nodes.iter_mut() {
        (node.pull, node.reach) = (0.0, dot(node.arm, node.arm));
    }
    for at in 0..nodes.len() {
        let Node { parent, arm, parent_arm, impulse: [x, y, _], .. } = nodes[at];
        nodes[at].pull += h * dot(arm, [x, y]);
        let parent = &mut nodes[parent as usize];
        parent.pull -= h * dot(parent_arm, [x, y]);
        let reach = dot(parent_arm, parent_arm);
        parent.reach = if reach > parent.reach { reach } else { parent.reach };
    }
}

/// Into how many parts a step is divided. Nothing swings faster than the last of so many bodies. Larger groups are slow but
/// where they whip, and one part leaves hardly any error: they are divided as far as something turns fast, and those that are
/// not very large as far as something is stiffer than it bears.
fn parts_of(nodes: &mut [Node], bodies: u32, step: &Step) -> u32 {
    if bodies <= FEW {
        return step.substeps.min(bodies);
    }
    let dt = f64::from(step.dt);
    let turn = nodes.iter().fold(0.0, |turn: f64, node| turn.max((node.velocity[2] * dt).abs()));
    let stiffness =
        if bodies <= MANY { stiffness_by_borne(nodes, dt, f64::from(step.substeps)) } else { 0.0 };
    let mut parts: u32 = 1;
    while parts < step.substeps
        && (f64::from(parts) * TURNED_AT_ONCE < turn || f64::from(parts * parts) < stiffness)
    {
        parts *= 2;
    }
    parts.min(step.substeps)
}

/// How stiff the stiffest body would be in one part, as a multiple of what it bears; an impulse is as long as its substep.
fn stiffness_by_borne(nodes: &mut [Node], dt: f64, substeps: f64) -> f64 {
    find_stiffness(nodes, dt * substeps);
    let bodies = nodes.iter().filter(|node| node.link != Link::Fixed);
    let stiffness = bodies.map(|node| node.pull / (BORNE * (node.inertia + node.mass * node.reach)));
    stiffness.fold(0.0, f64::max)
}

/// Moves a tree that nothing touches through all substeps of a step.
///
/// What springs and games push with may depend on the place: it acts at the beginning, as with bodies that nothing holds.
pub(super) fn swing(
    group: &mut Group,
    holds: &[Hold],
    room: &mut Room,
    bodies: &Bodies,
    step: &Step,
    unit: f64,
) {
    let Group { nodes, loose, .. } = group;
    let bodies_held = nodes.iter().filter(|node| node.body != 0).count() as u32;
    let parts = parts_of(nodes, bodies_held, step);
    // Whole kicks before bodies move put them in the same places as halves before and after: velocities are those of half a
    // substep ago, and need not be made to obey the joints once more.
    let by_whole_kicks = bodies_held > MANY && loose.is_empty();
    let (dt, h) = (f64::from(step.dt), f64::from(step.dt) / f64::from(parts));
    let longer = f64::from(step.substeps) / f64::from(parts);
    for node in nodes.iter_mut() {
        node.softness /= longer;
        node.impulse = node.impulse.map(|impulse| impulse * longer);
        if node.body != 0 {
            let (push, forced) = (bodies.push[node.body as usize], bodies.forced[node.body as usize]);
            for i in 0..3 {
                let at_once = f64::from(forced[i]) * 2.0 / dt;
                node.push[i] = f64::from(push[i]) * longer - at_once / f64::from(parts);
                node.velocity[i] += at_once;
            }
        }
    }
    loose.iter_mut().for_each(|loose| loose.stretch(longer, h));
    stiffen(nodes, h);
    for part in 0..parts {
        let share = if part == 0 && !by_whole_kicks { 0.5 } else { 1.0 };
        kick(nodes, share);
        loose.iter_mut().for_each(|loose| loose.share(share));
        nodes.iter_mut().for_each(|node| node.before = node.velocity);
        aim(nodes, h, unit);
        solve_group(nodes, loose, holds, room, (h, Pass::Correct, 1.0));
        let mut looks = 0;
        while looks < JERKS && stiffen_for_jerk(nodes, h) {
            looks += 1;
            nodes.iter_mut().for_each(|node| node.velocity = node.before);
            aim(nodes, h, unit);
            solve_group(nodes, loose, holds, room, (h, Pass::Correct, 1.0));
        }
        aim(nodes, h, unit);
        refine_group(nodes, loose, room, h);
        count_impulses(nodes, loose);
        advance(nodes, h);
        loose.iter_mut().for_each(|loose| loose.advance(nodes, h));
    }
    if by_whole_kicks {
        return;
    }
    kick(nodes, 0.5);
    loose.iter_mut().for_each(|loose| loose.share(0.5));
    rest(nodes);
    solve_group(nodes, loose, holds, room, (h, Pass::Rest, 0.0));
    count_impulses(nodes, loose);
}

fn count_impulses(nodes: &mut [Node], loose: &mut [Loose]) {
    nodes.iter_mut().for_each(Node::count_impulse);
    loose.iter_mut().for_each(Loose::count_impulse);
}

fn kick(nodes: &mut [Node], part: f64) {
    for node in nodes.iter_mut() {
        (0..3).for_each(|i| node.velocity[i] += part * node.push[i]);
    }
}
