//! Where trees of joints go in a substep.
//!
//! **Positions, not only velocities.** A substep asks for the velocity v' with which the joints hold at its *end*: with r the
//! arms, R the turning of a body in the substep and C the error of a point, C(x + h v') = 0. Linear in v' about the velocity
//! v before the joints act: J v' = J v - C(x + h v) / h, of which v falls out but for the spin: for each side of a joint
//! (x + R r) / h - w p, p the velocity of the anchor by a spin of 1. That is a step of SHAKE (J.-P. Ryckaert, G. Ciccotti,
//! H. Berendsen 1977) with one iteration, or two. Forces act by halves at the beginning and the end of a step, and the
//! velocity after it obeys the joints (RATTLE, H. C. Andersen 1983): as far as that goes the method is symplectic, and energy
//! does not drift. Where joints pull so hard that inertia is [stiffened](stiffen_for_jerk), as in a whip, it takes energy away, if
//! little: most of that [has momentum](with_momentum), too. Articulations that are not balanced get whole kicks at the beginning instead.

use super::super::bodies::Bodies;
use super::super::tuning::Step;
use super::balance::{Balance, InBalance, Moved, Start, rounded};
use super::hold::Hold;
use super::tree::{
    Link, Node, Vector, cross, dot, follow, for_each_down, hand_up, hand_up_momentum, plus, spun,
};
use super::{Group, begin_nodes};
use crate::precise::parameters::direct::STABLE_STIFFNESS;
use crate::precise::parameters::joints::{
    ARM_ROUNDING, ARTICULATION_SUBSTEP_PARTS, BALANCED_ARTICULATION_BODIES, GAP_OF_A_WHIP,
    IMPLICIT_STIFFNESS_RATIO, JOINT_CORRECTION_SPEED, LARGE_ARTICULATION_BODIES, LEAST_ARTICULATION_PARTS,
    MOMENTUM_SHARE_HALVED_AT, MOMENTUM_SHARE_OF_STIFFNESS, PREDICTED_ROTATION_ERROR, REPEATED_SUBSTEP_PARTS,
    ROTATION_PER_PART, STIFFNESS_JUMP_RETRIES,
};

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

impl Node {
    #[inline(always)]
    fn kick(&mut self, part: f64) {
        (0..3).for_each(|i| self.velocity[i] += part * self.push[i]);
    }

    #[inline(always)]
    fn aim(&mut self, parent: Option<&mut Node>, h: f64, unit: f64) {
        self.turn = aside_of_turn(self.expected_spin * h);
        let Some(parent) = parent else { return };
        let (parent, child) = (Side::of(parent, self.parent_arm), Side::of(self, self.arm));
        match self.link {
            Link::Free | Link::Fixed => {}
            Link::Point => self.bias = aim_point(&child, &parent, h, unit),
            Link::Distance => self.bias[0] = aim_distance(self, &child, &parent, h, unit),
            Link::Angle => self.bias[2] = aim_angle(self, &child, &parent, h),
            Link::Weld => {
                self.bias = aim_point(&child, &parent, h, unit);
                self.bias[2] = aim_angle(self, &child, &parent, h);
            }
            Link::Line => self.bias = aim_line(self, &child, &parent, h, unit),
        }
    }

    /// Joints ask for velocities with which they go on to hold.
    #[inline(always)]
    fn rest(&mut self) {
        self.bias = [0.0; 3];
    }

    #[inline(always)]
    fn advance(&mut self, parent: Option<&mut Node>, h: f64) {
        let [x, y, spin] = self.velocity.map(|velocity| velocity * h);
        self.place = plus(self.place, [x, y], 1.0);
        self.path = [self.path[0] + x, self.path[1] + y, self.path[2] + spin];
        self.turn = turn(spin);
        self.arm = turned(self.turn, self.arm);
        let Some(parent) = parent else { return };
        self.parent_arm = turned(parent.turn, self.parent_arm);
        match self.link {
            Link::Distance => {
                self.find_direction(parent.place);
            }
            Link::Line => {
                let first = if self.is_first { self.turn } else { parent.turn };
                self.direction = turned(first, self.direction);
            }
            _ => {}
        }
    }

    /// Gets ready for so many parts of a step, each of which is so much longer than a substep. The pull is that of one part.
    #[inline(always)]
    fn divide(&mut self, bodies: &Bodies, (dt, parts): (f64, f64), longer: f64) {
        self.impulse = self.impulse.map(|impulse| impulse * longer);
        self.pull *= 1.0 / (parts * parts);
        self.spin_by_joints *= 1.0 / parts;
        self.stiffness = self.excess();
        if self.body != 0 {
            let (push, forced) = (bodies.push[self.body as usize], bodies.forced[self.body as usize]);
            let (at_once, share) = (2.0 / dt, 1.0 / parts);
            for i in 0..3 {
                let at_once = f64::from(forced[i]) * at_once;
                self.push[i] = f64::from(push[i]) * longer - at_once * share;
                self.velocity[i] += at_once;
            }
        }
    }

    /// How stiff its joint's impulse in a substep of this length makes it, and its parent, against turning.
    #[inline(always)]
    fn note_pull(&mut self, parent: Option<&mut Node>, h: f64) {
        let [x, y, _] = self.impulse;
        self.pull = h * dot(self.arm, [x, y]);
        if let Some(parent) = parent {
            parent.pull -= h * dot(self.parent_arm, [x, y]);
        }
    }

    #[inline(always)]
    fn anchor_velocity(&self, arm: Vector) -> Vector {
        let [x, y, spin] = self.velocity;
        plus([x, y], spun(arm), spin)
    }

    #[inline(always)]
    fn foreseen(&self) -> f64 {
        foreseen(self.spin_by_joints, self.pull, self.borne())
    }

    /// Torque of its joint on it, and on its parent, as an angular impulse of a substep.
    #[inline(always)]
    fn note_twist(&mut self, parent: Option<&mut Node>) {
        let [x, y, twist] = self.impulse;
        self.spin_by_joints = cross(self.arm, [x, y]) + twist;
        if let Some(parent) = parent {
            let slid = if self.link == Link::Line { self.apart(parent.place) } else { [0.0; 2] };
            parent.spin_by_joints -= cross(plus(self.parent_arm, slid, 1.0), [x, y]) + twist;
        }
    }

    /// The joint's error, as a fraction of its arms and of the body's radius of gyration, or in radians.
    fn gap_from(&self, parent: &Node) -> f64 {
        let apart = self.apart(parent.place);
        let turned = self.wanted.abs();
        let [arm, parent_arm, distance] = [self.arm, self.parent_arm, apart].map(|v| dot(v, v).sqrt());
        // The anchor of a joint with the world is a place, and no arm.
        let reach = arm + if parent.body == 0 { 0.0 } else { parent_arm } + (self.inertia / self.mass).sqrt();
        let part = |gap: f64, reach: f64| if gap > 0.0 { gap / reach } else { 0.0 };
        match self.link {
            Link::Free | Link::Fixed => 0.0,
            Link::Point => part(distance, reach),
            Link::Weld => part(distance, reach).max(turned),
            Link::Angle => turned,
            Link::Distance => part((distance - self.wanted).abs(), reach + self.wanted),
            Link::Line => part(dot(spun(self.direction), apart).abs(), reach + distance).max(turned),
        }
    }

    /// The stiffness that the inertia bears.
    #[inline(always)]
    fn borne(&self) -> f64 {
        bears(self.inertia, self.mass, self.reach)
    }

    /// What of the stiffness that is added to the inertia has [momentum](with_momentum).
    #[inline(always)]
    fn with_momentum(&self) -> f64 {
        with_momentum(self.stiffness, self.borne())
    }

    /// What of its stiffness is more than the inertia bears.
    #[inline(always)]
    fn excess(&self) -> f64 {
        let excess = self.pull - self.borne();
        if excess > 0.0 && self.link != Link::Fixed { excess } else { 0.0 }
    }

    /// Whether joints have had to pull far more than before: something has come to the end of its chain.
    #[inline(always)]
    fn is_jerked(&self) -> bool {
        self.excess() > self.stiffness + self.borne()
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

impl InBalance for Node {
    fn moved(&self) -> Option<Moved> {
        let Node { mass, inertia, path, place, velocity, push, .. } = *self;
        (self.body != 0).then_some(Moved { mass, inertia, path, place, velocity, push })
    }

    fn set_velocity(&mut self, velocity: [f64; 3]) {
        self.velocity = velocity;
    }

    fn work_of_rounding(&self, dt: f64) -> f64 {
        let [x, y, twist] = self.total;
        let reach = self.reach.sqrt();
        (dot([x, y], [x, y]).sqrt() * rounded(self.place, reach) + twist.abs() * ARM_ROUNDING) / dt
    }

    fn parting_speed(&self, parent: &Self) -> f64 {
        let apart = plus(self.anchor_velocity(self.arm), parent.anchor_velocity(self.parent_arm), -1.0);
        let turning = (self.velocity[2] - parent.velocity[2]).abs() * self.reach.sqrt();
        match self.link {
            Link::Free | Link::Fixed => 0.0,
            Link::Point => dot(apart, apart).sqrt(),
            Link::Weld => dot(apart, apart).sqrt().max(turning),
            Link::Angle => (self.velocity[2] - parent.velocity[2]).abs() * (self.inertia / self.mass).sqrt(),
            Link::Distance => {
                let way = self.apart(parent.place);
                let distance = dot(way, way).sqrt();
                if distance > 0.0 { dot(way, apart).abs() / distance } else { 0.0 }
            }
            Link::Line => {
                let along = dot(self.direction, self.apart(parent.place));
                let turn = if self.is_first { self.velocity[2] } else { parent.velocity[2] };
                (dot(spun(self.direction), apart) - turn * along).abs().max(turning)
            }
        }
    }

    fn is_torn(&self, gap: f64) -> bool {
        self.gap > gap
    }

    fn is_driven(&self) -> bool {
        self.link == Link::Fixed && self.velocity != [0.0; 3]
    }

    fn is_free_root(&self) -> bool {
        self.link == Link::Free
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

/// The stiffness that the inertia of a body bears in a substep whose joints reach so far from its origin, squared.
#[inline(always)]
pub(super) fn bears(inertia: f64, mass: f64, reach: f64) -> f64 {
    STABLE_STIFFNESS * (inertia + mass * reach)
}

/// The part of an error of this size that is left for later substeps.
#[inline(always)]
pub(super) fn postponed(size: f64, at_once: f64) -> f64 {
    if size > at_once { 1.0 - at_once / size } else { 0.0 }
}

#[inline(always)]
fn aim_point(child: &Side, parent: &Side, h: f64, unit: f64) -> [f64; 3] {
    let error = plus(child.anchor(), parent.anchor(), -1.0);
    let later = postponed(dot(error, error).sqrt(), JOINT_CORRECTION_SPEED * h * unit);
    let [x, y] = plus(plus(child.aside(), parent.aside(), -1.0), error, -later);
    let rate = -1.0 / h;
    [x * rate, y * rate, 0.0]
}

#[inline(always)]
fn aim_distance(node: &mut Node, child: &Side, parent: &Side, h: f64, unit: f64) -> f64 {
    let error = node.find_direction(parent.place) - node.wanted;
    let way = plus(child.anchor_velocity(), parent.anchor_velocity(), -1.0);
    let speed = dot(node.direction, way);
    let aside = plus(child.aside(), parent.aside(), -1.0);
    let ahead = plus(aside, way, h);
    let later = error * postponed(error.abs(), JOINT_CORRECTION_SPEED * h * unit);
    speed - (dot(ahead, ahead).sqrt() - node.wanted - later) / h
}

#[inline(always)]
fn aim_angle(node: &Node, child: &Side, parent: &Side, h: f64) -> f64 {
    let error = node.wanted + child.angle - parent.angle;
    -error * (1.0 - postponed(error.abs(), JOINT_CORRECTION_SPEED * h)) / h
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
        - off * postponed(off.abs(), JOINT_CORRECTION_SPEED * h * unit);
    let along = dot(node.direction, apart);
    // The line is the child's: it turns with a spin that is about to change.
    let own = if node.is_first { along * (turning - (child.velocity[2] - parent.velocity[2])) } else { 0.0 };
    let speed = dot(across, way) - parent.velocity[2] * along;
    let [x, y] = across.map(|part| part * (speed + own - left / h));
    [x, y, turning]
}

/// What of a stiffness that is added to an inertia that bears this much has momentum, too.
///
/// If nothing had, each step would take energy from what turns, as an implicit one does. If all had, none would be lost while
/// the stiffness is the same, as in a leapfrog with other inertias: but where it is many times what the inertia bears, and
/// changes from step to step, such a leapfrog gains energy. Of balls of 1 to 100,000 on a chain and chains of 9 to 50 a third
/// gains energy if all has. If nothing has they lose 19, 7.8 and 2.8 % of their greatest kinetic energy in ten seconds at
/// 30, 60 and 120 Hz, and like this 6.2, 2.3 and 1.1 %, and none gains any.
#[inline(always)]
pub(in crate::precise) fn with_momentum(stiffness: f64, borne: f64) -> f64 {
    let times = stiffness / (MOMENTUM_SHARE_HALVED_AT * borne);
    MOMENTUM_SHARE_OF_STIFFNESS * stiffness / (1.0 + times * times)
}

/// Tension makes a joint stiff against turning, and a stiff thing overshoots where a substep is too long for it: a chain
/// whose links carry more than they weigh for long enough would be torn to pieces. What is more than the inertia bears is
/// added to it, as an implicit step would (M. Tournier et al., "Stable constrained dynamics", 2015; S. Andrews et al.,
/// "Geometric stiffness for real-time constrained multibody dynamics", 2017). This is that anew after a
/// [jerk](Node::is_jerked).
fn stiffen_for_jerk(nodes: &mut [Node]) {
    for node in nodes.iter_mut() {
        let excess = node.excess();
        node.stiffness = if excess > node.stiffness { excess } else { node.stiffness };
    }
}

/// How stiff the impulses of a substep of this length make bodies against turning.
fn find_stiffness(nodes: &mut [Node], h: f64) {
    for_each_down(nodes, |node, parent| node.note_pull(parent, h));
}

/// How a step of a tree that nothing touches is divided.
pub(in crate::precise) struct Division {
    pub(in crate::precise) parts: u32,
    /// The most parts with which the step may be repeated.
    pub(super) most: u32,
    /// Whole kicks before bodies move put them in the same places as halves before and after: velocities are those of half a
    /// substep ago, and need not be made to obey the joints once more.
    pub(super) by_whole_kicks: bool,
    /// Changes of spins by joints are [foreseen](foreseen): not where gaps are closed.
    pub(super) foresees: bool,
    /// Bodies may turn by so many radians otherwise than was expected in a part.
    pub(super) unexpected: f64,
}

impl Division {
    /// Division for an articulation of so many bodies whose greatest spins at the beginning and at the predicted end are these, in
    /// radians/s, and which may be stiffer than so many times the stiffness that an undivided step bears. As far as the most parts go no body turns by more
    /// than [`ROTATION_PER_PART`], and, unless the articulation is large, no geometric stiffness is too great for a part.
    pub(in crate::precise) fn of(
        bodies: u32,
        step: &Step,
        [first, last]: [f64; 2],
        is_stiffer: impl Fn(f64) -> bool,
    ) -> Self {
        let is_large = bodies > LARGE_ARTICULATION_BODIES;
        let is_balanced = Self::is_balanced(bodies);
        let spin = if is_balanced { first.max(last) } else { first };
        let turn = spin * f64::from(step.dt);
        let is_stiff = |parts: u32| is_stiffer(f64::from(parts * parts));
        let most = if is_large { step.substeps } else { ARTICULATION_SUBSTEP_PARTS * step.substeps };
        let mut parts = if is_balanced { LEAST_ARTICULATION_PARTS } else { 1 };
        while parts < most && (f64::from(parts) * ROTATION_PER_PART < turn || (!is_large && is_stiff(parts)))
        {
            parts += (parts / 2).max(1);
        }
        Division {
            parts: parts.min(most),
            most: REPEATED_SUBSTEP_PARTS * step.substeps,
            by_whole_kicks: !is_balanced,
            foresees: is_balanced,
            unexpected: if is_balanced { 0.5 } else { 1.0 } * PREDICTED_ROTATION_ERROR,
        }
    }

    /// Whether the energy of an articulation of so many bodies is balanced.
    #[inline(always)]
    pub(in crate::precise) fn is_balanced(bodies: u32) -> bool {
        bodies <= BALANCED_ARTICULATION_BODIES
    }

    /// The balance of energy of a step that was divided so; whole kicks have none.
    pub(super) fn balance<N: InBalance>(
        &self,
        nodes: &[N],
        start: Option<Start>,
        dt: f64,
    ) -> Option<Balance> {
        Balance::of(nodes, start?, [dt, dt / f64::from(self.parts)])
    }

    /// The division with which a step of this balance is repeated, if any.
    pub(super) fn finer(&self, balance: &Balance) -> Option<Self> {
        let parts = (2 * self.parts).min(self.most);
        (balance.is_off() && parts > self.parts).then_some(Division { parts, ..*self })
    }
}

/// The change of a body's spin by joints in a part that is expected after one in which it was `change`. The stiffer joints make the body,
/// as a fraction of what its inertia bears, the less of it goes on: what swings to and fro within a part is not foreseen.
#[inline(always)]
pub(super) fn foreseen(change: f64, pull: f64, borne: f64) -> f64 {
    let rest = 1.0 - pull.abs() / borne;
    if rest > 0.0 { rest * change } else { 0.0 }
}

/// The greatest spins so far at the beginning and at the predicted end of a step, or those of another body, in radians/s.
#[inline(always)]
pub(super) fn greater_spins([first, last]: [f64; 2], start: f64, change: f64) -> [f64; 2] {
    [first.max(start.abs()), last.max((start + change).abs())]
}

/// Moves a tree that nothing touches through all substeps of a step.
///
/// What springs and games push with may depend on the place: it acts at the beginning, as with bodies that nothing holds.
pub(super) fn swing(
    Group { nodes, parts, .. }: &mut Group,
    holds: &[Hold],
    bodies: &Bodies,
    step: &Step,
    unit: f64,
) {
    let dt = f64::from(step.dt);
    let mut division = begin(nodes, holds, bodies, step);
    loop {
        let start = swing_tree(nodes, bodies, step, &division, unit);
        let balance = division.balance(nodes, start, dt);
        let Some(finer) = balance.and_then(|balance| division.finer(&balance)) else {
            balance.inspect(|balance| balance.restore(nodes));
            break;
        };
        begin(nodes, holds, bodies, step);
        division = finer;
    }
    *parts = division.parts;
}

/// A step begins. Answers how it is divided.
fn begin(nodes: &mut [Node], holds: &[Hold], bodies: &Bodies, step: &Step) -> Division {
    let (dt, substeps) = (f64::from(step.dt), f64::from(step.substeps));
    begin_nodes(nodes, holds, bodies, f64::from(step.h));
    // In one part impulses would be so many times as long.
    find_stiffness(nodes, dt * substeps);
    for_each_down(nodes, |node, parent| {
        node.gap = parent.as_deref().map_or(0.0, |parent| node.gap_from(parent));
        node.note_twist(parent);
    });
    let (mut count, mut spins, mut is_torn) = (0, [0.0; 2], false);
    for node in nodes.iter_mut() {
        if node.body == 0 {
            node.spin_by_joints = 0.0;
            continue;
        }
        count += 1;
        is_torn |= node.is_torn(GAP_OF_A_WHIP);
        node.spin_by_joints *= substeps / node.inertia;
        spins = greater_spins(spins, node.velocity[2], node.spin_by_joints);
    }
    let division = Division::of(count, step, spins, |bears| {
        let bears = IMPLICIT_STIFFNESS_RATIO * bears;
        nodes.iter().any(|node| node.pull > bears * node.borne() && node.link != Link::Fixed)
    });
    Division { foresees: division.foresees && !is_torn, ..division }
}

/// All parts of a step of a tree: as few passes over its nodes as there can be. Answers how it began if energy is balanced.
fn swing_tree(
    nodes: &mut [Node],
    bodies: &Bodies,
    step: &Step,
    division: &Division,
    unit: f64,
) -> Option<Start> {
    let Division { parts, by_whole_kicks, unexpected, foresees, .. } = *division;
    let (dt, substeps) = (f64::from(step.dt), f64::from(step.substeps));
    let h = dt / f64::from(parts);
    for node in nodes.iter_mut() {
        node.divide(bodies, (dt, f64::from(parts)), substeps / f64::from(parts));
    }
    let start = (!by_whole_kicks).then(|| Start::of(nodes));
    for part in 0..parts {
        let share = if part == 0 && !by_whole_kicks { 0.5 } else { 1.0 };
        for node in nodes.iter_mut() {
            node.kick(share);
            let by_joints = if foresees { node.foreseen() } else { 0.0 };
            (node.before, node.expected_spin) = (node.velocity, node.velocity[2] + share * by_joints);
        }
        correct_tree(nodes, (h, unit), unexpected / h);
        for_each_down(nodes, |node, parent| {
            if foresees {
                node.spin_by_joints = (node.velocity[2] - node.before[2]) / share;
            }
            node.count_impulse();
            node.advance(parent, h);
        });
    }
    if !by_whole_kicks {
        for node in nodes.iter_mut() {
            node.kick(0.5);
            node.rest();
            node.take_own(0.0);
        }
        hand_up(nodes);
        follow(nodes);
        nodes.iter_mut().for_each(Node::count_impulse);
    }
    start
}

/// Finds the velocities with which joints hold at the end of a substep. It is looked once more where bodies turn otherwise
/// than expected, and where there is a [jerk](Node::is_jerked).
fn correct_tree(nodes: &mut [Node], (h, unit): (f64, f64), unexpected: f64) {
    let mut is_jerked = true;
    for look in 0..=STIFFNESS_JUMP_RETRIES {
        for_each_down(nodes, |node, parent| {
            node.aim(parent, h, unit);
            node.take_own_momentum(node.before, node.with_momentum());
        });
        if is_jerked {
            nodes.iter_mut().for_each(|node| node.take_own_inertia(1.0));
            hand_up(nodes);
        } else {
            hand_up_momentum(nodes);
        }
        follow(nodes);
        find_stiffness(nodes, h);
        is_jerked = nodes.iter().any(Node::is_jerked);
        let is_off = |node: &Node| (node.velocity[2] - node.expected_spin).abs() > unexpected;
        if look == STIFFNESS_JUMP_RETRIES || !(is_jerked || (look == 0 && nodes.iter().any(is_off))) {
            break;
        }
        if is_jerked {
            stiffen_for_jerk(nodes);
        }
        for node in nodes.iter_mut() {
            (node.expected_spin, node.velocity) = (node.velocity[2], node.before);
        }
    }
}
