//! Trees of which every joint keeps a point, and does not give way: chains, ropes, bridges, figures that hang.
//!
//! They are by far the most common, and solved as [`swing`](super::swing) solves any tree that nothing touches, with the same
//! formulas. Here nothing is kept but what these joints need, anchors are followed in the one pass that reads bodies, and each
//! pass does all that can be done where it is.

use crate::precise::parameters::joints::{
    GAP_OF_A_WHIP, IMPLICIT_STIFFNESS_RATIO, JOINT_CORRECTION_SPEED, STIFFNESS_JUMP_RETRIES,
};
use wide::f32x4;

use super::super::bodies::Bodies;
use super::super::tuning::Step;
use super::balance::{InBalance, Moved, Start, rounded};
use super::hold::{Hold, shown};
use super::swing::{
    Division, aside_of_turn, bears, foreseen, greater_spins, postponed, turn, turned, with_momentum,
};
use super::tree::{
    Inertia, Link, Momentum, Node, Seated, Vector, cross, dot, for_each_down, for_each_up, plus, spun,
};

/// A body in such a tree. Parents come before their children; a root is its own parent.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Hinge {
    /// The body's number, the place of its parent in the tree and the number of the joint with it.
    body: u32,
    parent: u32,
    joint: u32,
    /// Of a root whether it is free; others hang on their parent by a point.
    link: Link,
    is_first: bool,
    /// 1 for the second body of a joint, which its force is on, and -1 for the first.
    sign: f64,
    mass: f64,
    inertia: f64,
    /// The stiffness that the inertia bears in a substep.
    borne: f64,
    /// The joint's anchors in the coordinates of the body and of its parent, and where they are from their origins.
    anchor: Vector,
    parent_anchor: Vector,
    arm: Vector,
    parent_arm: Vector,
    place: Vector,
    /// Velocity before joints act, with the spin that they reckon with, and what forces add to it in a part of a step.
    velocity: [f64; 3],
    expected_spin: f64,
    /// Change of the spin by joints in a part of the step, as predicted from the part before, in radians/s.
    spin_by_joints: f64,
    push: [f64; 3],
    /// Cosine and sine of what the body turns by: its rotation when the step begins, [what a turn does besides taking arms
    /// along](aside_of_turn) while a part is solved, and the turn of a part when bodies move.
    turn: Vector,
    /// How stiff the joints make the body against turning by what they pull, what is added to its inertia for that, and what of
    /// that [has momentum](with_momentum).
    pull: f64,
    stiffness: f64,
    with_momentum: f64,
    /// What hangs on the body, and then with the body itself. Once it is handed up, what is left of mass and momentum where the
    /// joint leaves the turning free: A - c c^T / d and its impulse; and 1 / d.
    seen: Inertia,
    momentum: Momentum,
    inverse_turning: f64,
    /// Velocity of the body against its parent at the joint that is asked for, and that of the joint that is found, with
    /// the spin.
    bias: Vector,
    found: [f64; 3],
    impulse: Vector,
    /// How far the origin has come, and the body has turned, in this step, and what the joint has done to it.
    path: [f64; 3],
    total: Vector,
    /// Distance between the anchors when the step begins, in length units.
    gap: f64,
}

impl Seated for Hinge {
    #[inline(always)]
    fn parent(&self) -> usize {
        self.parent as usize
    }
}

impl InBalance for Hinge {
    fn moved(&self) -> Option<Moved> {
        let Hinge { mass, inertia, path, place, velocity, push, .. } = *self;
        (self.body != 0).then_some(Moved { mass, inertia, path, place, velocity, push })
    }

    fn set_velocity(&mut self, velocity: [f64; 3]) {
        self.velocity = velocity;
    }

    fn work_of_rounding(&self, dt: f64) -> f64 {
        dot(self.total, self.total).sqrt() / dt * rounded(self.place, dot(self.arm, self.arm).sqrt())
    }

    fn parting_speed(&self, parent: &Self) -> f64 {
        if !self.link.holds() {
            return 0.0;
        }
        let at = |[x, y, spin]: [f64; 3], arm: Vector| plus([x, y], spun(arm), spin);
        let apart = plus(at(self.velocity, self.arm), at(parent.velocity, self.parent_arm), -1.0);
        dot(apart, apart).sqrt()
    }

    fn is_torn(&self, gap: f64) -> bool {
        let [arm, parent_arm] = [self.anchor, self.parent_anchor].map(|anchor| dot(anchor, anchor).sqrt());
        let reach = arm + parent_arm + (self.inertia / self.mass).sqrt();
        self.gap > gap * reach
    }

    fn is_driven(&self) -> bool {
        self.link == Link::Fixed && self.velocity != [0.0; 3]
    }

    fn is_free_root(&self) -> bool {
        self.link == Link::Free
    }
}

/// The tree again, if all of its joints are hinges.
pub(super) fn hinges_of(nodes: &[Node], holds: &[Hold]) -> Vec<Hinge> {
    let is_hinge = |node: &Node| {
        let hold = &holds[node.joint as usize];
        node.link == Link::Point && hold.softness == 0.0 && hold.drive.is_none()
    };
    let is_root = |node: &Node| !node.link.holds();
    if !nodes.iter().all(|node| is_root(node) || is_hinge(node)) {
        return Vec::new();
    }
    let mut hinges: Vec<Hinge> = nodes.iter().map(|node| hinge_of(node, holds)).collect();
    // The farther its joints are from its origin, the more the inertia of a body bears.
    let mut reaches: Vec<f64> = hinges.iter().map(|hinge| dot(hinge.anchor, hinge.anchor)).collect();
    for hinge in hinges.iter().filter(|hinge| hinge.link.holds()) {
        let reach = &mut reaches[hinge.parent as usize];
        *reach = reach.max(dot(hinge.parent_anchor, hinge.parent_anchor));
    }
    for (hinge, reach) in hinges.iter_mut().zip(reaches) {
        hinge.borne = bears(hinge.inertia, hinge.mass, reach);
    }
    hinges
}

fn hinge_of(node: &Node, holds: &[Hold]) -> Hinge {
    let [anchor, parent_anchor] = if node.link.holds() {
        let [first, second] = holds[node.joint as usize].ends.map(|end| end.anchor);
        if node.is_first { [first, second] } else { [second, first] }
    } else {
        [[0.0; 2]; 2]
    };
    Hinge {
        body: node.body,
        parent: node.parent,
        joint: node.joint,
        link: node.link,
        is_first: node.is_first,
        sign: node.sign(),
        mass: node.mass,
        inertia: node.inertia,
        anchor,
        parent_anchor,
        ..Hinge::default()
    }
}

/// Moves a tree that nothing touches through all parts of a step, and lets its joints tell how they were when it began and what
/// has held them. Answers how many parts that were.
pub(super) fn swing(
    hinges: &mut [Hinge],
    holds: &mut [Hold],
    bodies: &mut Bodies,
    step: &Step,
    unit: f64,
) -> u32 {
    let dt = f64::from(step.dt);
    let mut division = begin(hinges, holds, bodies, step);
    loop {
        let start = swing_tree(hinges, bodies, step, &division, unit);
        let balance = division.balance(hinges, start, dt);
        let Some(finer) = balance.and_then(|balance| division.finer(&balance)) else {
            balance.inspect(|balance| balance.restore(hinges));
            break;
        };
        begin(hinges, holds, bodies, step);
        division = finer;
    }
    let Division { parts, by_whole_kicks: whole, .. } = division;
    let h = dt / f64::from(parts);
    // From the end, which was seen last.
    for hinge in hinges.iter_mut().rev() {
        let (velocity, path, total) = if whole {
            let velocity = hinge.found_velocity();
            (velocity, hinge.way(velocity, h), plus(hinge.total, hinge.impulse, 1.0))
        } else {
            (hinge.velocity, hinge.path, hinge.total)
        };
        hinge.tell(holds, bodies, (velocity, path, total.map(|impulse| impulse / dt)));
    }
    parts
}

/// A step begins. Answers how it is divided.
fn begin(hinges: &mut [Hinge], holds: &mut [Hold], bodies: &Bodies, step: &Step) -> Division {
    let (dt, mut count) = (f64::from(step.dt), 0);
    for_each_down(hinges, |hinge, parent| {
        hinge.begin(parent, holds, bodies, dt);
        count += u32::from(hinge.body != 0);
    });
    let (mut spins, mut is_torn) = ([0.0; 2], false);
    for hinge in hinges.iter_mut() {
        if hinge.body == 0 {
            hinge.spin_by_joints = 0.0;
            continue;
        }
        if Division::is_balanced(count) {
            hinge.spin_by_joints *= dt / hinge.inertia;
            is_torn |= hinge.is_torn(GAP_OF_A_WHIP);
        }
        spins = greater_spins(spins, hinge.velocity[2], hinge.spin_by_joints);
    }
    let division = Division::of(count, step, spins, |bears| {
        let bears = IMPLICIT_STIFFNESS_RATIO * bears;
        hinges.iter().any(|hinge| hinge.pull > bears * hinge.borne && hinge.link != Link::Fixed)
    });
    Division { foresees: division.foresees && !is_torn, ..division }
}

/// All parts of a step. Answers how it began if energy is balanced.
fn swing_tree(
    hinges: &mut [Hinge],
    bodies: &Bodies,
    step: &Step,
    division: &Division,
    unit: f64,
) -> Option<Start> {
    let Division { parts, by_whole_kicks: whole, unexpected, foresees, .. } = *division;
    let dt = f64::from(step.dt);
    let h = dt / f64::from(parts);
    let first = if whole { 1.0 } else { 0.5 };
    let times = (step.dt, parts as f32, step.substeps as f32);
    let start = if whole {
        correct(hinges, (h, unit), unexpected / h, |hinge| {
            hinge.divide(bodies, times);
            hinge.kick(first, foresees);
        });
        None
    } else {
        hinges.iter_mut().for_each(|hinge| hinge.divide(bodies, times));
        let start = Start::of(hinges);
        correct(hinges, (h, unit), unexpected / h, |hinge| hinge.kick(first, foresees));
        Some(start)
    };
    for part in 1..parts {
        let share = if part == 1 { first } else { 1.0 };
        for_each_down(hinges, |hinge, parent| {
            hinge.note_spin(foresees, share);
            hinge.advance(parent, h);
        });
        correct(hinges, (h, unit), unexpected / h, |hinge| hinge.kick(1.0, foresees));
    }
    if !whole {
        for_each_down(hinges, |hinge, parent| hinge.advance(parent, h));
        rest(hinges);
    }
    start
}

/// The second half of the last kick, and velocities that obey the joints where bodies have come to.
fn rest(hinges: &mut [Hinge]) {
    for hinge in hinges.iter_mut() {
        hinge.kick(0.5, false);
        (hinge.bias, hinge.stiffness, hinge.with_momentum) = ([0.0; 2], 0.0, 0.0);
        hinge.take_own();
    }
    for_each_up(hinges, Hinge::hand_up);
    for_each_down(hinges, |hinge, parent| hinge.follow(parent.as_deref()));
    hinges.iter_mut().for_each(Hinge::take_found);
}

/// Finds the velocities with which joints hold at the end of a part, which `begin` has brought bodies to the start of. It is
/// looked once more where bodies turn otherwise than expected, and where there is a [jerk](Hinge::is_jerked).
fn correct(hinges: &mut [Hinge], (h, unit): (f64, f64), unexpected: f64, begin: impl Fn(&mut Hinge)) {
    for hinge in hinges.iter_mut() {
        begin(hinge);
        hinge.get_ready(h);
    }
    let way = (-1.0 / h, JOINT_CORRECTION_SPEED * h * unit);
    for look in 0..=STIFFNESS_JUMP_RETRIES {
        for_each_up(hinges, |hinge, parent| {
            hinge.aim(parent, way);
            hinge.hand_up(parent);
        });
        let (mut is_off, mut may_be_jerked) = (false, false);
        for_each_down(hinges, |hinge, mut parent| {
            hinge.follow(parent.as_deref());
            hinge.note_pull(parent.as_deref_mut(), h);
            is_off |= (hinge.found[2] - hinge.expected_spin).abs() > unexpected;
            may_be_jerked |= hinge.is_jerked() | parent.is_some_and(|parent| parent.is_jerked());
        });
        // What pulls a parent is known once its last child is.
        let is_jerked = may_be_jerked && hinges.iter().any(Hinge::is_jerked);
        if look == STIFFNESS_JUMP_RETRIES || !(is_jerked || (look == 0 && is_off)) {
            break;
        }
        for hinge in hinges.iter_mut() {
            if is_jerked {
                hinge.stiffen(hinge.stiffness.max(hinge.excess()));
            }
            hinge.expected_spin = hinge.found[2];
            hinge.get_ready(h);
        }
    }
}

impl Hinge {
    /// A step begins: it is where its body is, and its joint was pulling with the force of the step before. What it pulls is
    /// that of an undivided step.
    #[inline(always)]
    fn begin(&mut self, parent: Option<&mut Hinge>, holds: &mut [Hold], bodies: &Bodies, dt: f64) {
        let body = self.body as usize;
        if body != 0 {
            let [x, y, c, s] = bodies.poses[body].map(f64::from);
            let [vx, vy, spin, _] = bodies.before[body];
            (self.place, self.turn) = ([x, y], [c, s]);
            self.velocity = [vx, vy, spin].map(f64::from);
        }
        (self.path, self.total, self.pull, self.gap) = ([0.0; 3], [0.0; 2], 0.0, 0.0);
        self.spin_by_joints = 0.0;
        let Some(parent) = parent else {
            // Turned about, a zero might have got another sign.
            self.arm = [0.0; 2];
            return;
        };
        let hold = &mut holds[self.joint as usize];
        self.arm = turned(self.turn, self.anchor);
        if parent.link == Link::Fixed {
            let end = &mut hold.ends[usize::from(self.is_first)];
            end.follow(bodies);
            (parent.place, parent.velocity, self.parent_arm) = (end.place, end.velocity, end.arm);
        } else {
            self.parent_arm = turned(parent.turn, self.parent_anchor);
        }
        let apart = self.apart(parent);
        self.gap = dot(apart, apart).sqrt();
        hold.error = self.gap as f32;
        hold.arm = shown(if self.is_first { self.arm } else { self.parent_arm });
        let force = [hold.force[0] * self.sign, hold.force[1] * self.sign];
        self.pull = dt * dt * dot(self.arm, force);
        parent.pull -= dt * dt * dot(self.parent_arm, force);
        self.spin_by_joints = cross(self.arm, force);
        parent.spin_by_joints -= cross(self.parent_arm, force);
    }

    /// Gets ready for so many parts of a step.
    #[inline(always)]
    fn divide(&mut self, bodies: &Bodies, (dt, parts, substeps): (f32, f32, f32)) {
        self.pull *= 1.0 / f64::from(parts * parts);
        self.spin_by_joints *= 1.0 / f64::from(parts);
        self.stiffen(self.excess());
        if self.body != 0 {
            let [push, forced] = [&bodies.push, &bodies.forced].map(|of| f32x4::new(of[self.body as usize]));
            let at_once = forced * f32x4::splat(2.0 / dt);
            let push = (push * f32x4::splat(substeps) - at_once) * f32x4::splat(1.0 / parts);
            let ([x, y, spin, _], at_once) = (push.to_array().map(f64::from), at_once.to_array());
            self.push = [x, y, spin];
            (0..3).for_each(|i| self.velocity[i] += f64::from(at_once[i]));
        }
    }

    #[inline(always)]
    fn kick(&mut self, share: f64, foresees: bool) {
        (0..3).for_each(|i| self.velocity[i] += share * self.push[i]);
        let by_joints = if foresees { foreseen(self.spin_by_joints, self.pull, self.borne) } else { 0.0 };
        self.expected_spin = self.velocity[2] + share * by_joints;
    }

    /// What of a part can be known of the body by itself.
    #[inline(always)]
    fn get_ready(&mut self, h: f64) {
        self.turn = aside_of_turn(self.expected_spin * h);
        self.take_own();
    }

    /// Asks for the velocity with which the joint holds at the end of a part: the error, that velocity times the reciprocal of
    /// a part's length.
    #[inline(always)]
    fn aim(&mut self, parent: &Hinge, (rate, at_once): (f64, f64)) {
        let error = self.apart(parent);
        let ahead = plus(self.place, turned(self.turn, self.arm), 1.0);
        let mut way = plus(ahead, plus(parent.place, turned(parent.turn, self.parent_arm), 1.0), -1.0);
        let size = dot(error, error);
        if size > at_once * at_once {
            way = plus(way, error, -postponed(size.sqrt(), at_once));
        }
        self.bias = [way[0] * rate, way[1] * rate];
    }

    /// The body's own inertia and momentum, at its joint.
    #[inline(always)]
    fn take_own(&mut self) {
        self.seen = Inertia::of(self.mass, self.inertia + self.stiffness, self.arm);
        self.momentum = Momentum::of(self.mass, self.inertia + self.with_momentum, self.arm, self.velocity);
    }

    /// The parent has to move the body as far as the joint says.
    #[inline(always)]
    fn hand_up(&mut self, parent: &mut Hinge) {
        let lever = plus(self.parent_arm, parent.arm, -1.0);
        let Inertia { mass, coupling, turning } = self.seen;
        self.inverse_turning = 1.0 / turning;
        let rest = mass.with(coupling, -self.inverse_turning);
        let load = plus(self.momentum.along, coupling, -self.momentum.turning * self.inverse_turning);
        (self.seen.mass, self.momentum.along) = (rest, load);
        parent.seen.add_point(&rest, lever);
        parent.momentum.add(plus(load, rest.times(self.bias), -1.0), 0.0, lever);
    }

    /// The velocity at the joint, once that of the parent is known; of a root at its origin.
    #[inline(always)]
    fn follow(&mut self, parent: Option<&Hinge>) {
        let Some(parent) = parent else {
            self.found = if self.link == Link::Free { self.seen.free(&self.momentum) } else { self.velocity };
            return;
        };
        let [x, y, spin] = parent.found;
        let lever = plus(self.parent_arm, parent.arm, -1.0);
        let at_joint = plus(plus([x, y], spun(lever), spin), self.bias, 1.0);
        self.impulse = plus(self.seen.mass.times(at_joint), self.momentum.along, -1.0);
        let spin = (self.momentum.turning - dot(self.seen.coupling, at_joint)) * self.inverse_turning;
        self.found = [at_joint[0], at_joint[1], spin];
    }

    /// The velocity at the origin, where that of the joint is found.
    #[inline(always)]
    fn found_velocity(&self) -> [f64; 3] {
        let [x, y, spin] = self.found;
        let [x, y] = plus([x, y], spun(self.arm), -spin);
        [x, y, spin]
    }

    /// Where it is after so long with this velocity, from where it was when the step began.
    #[inline(always)]
    fn way(&self, velocity: [f64; 3], h: f64) -> [f64; 3] {
        std::array::from_fn(|i| self.path[i] + velocity[i] * h)
    }

    /// The body moves as was found, and the joint has held.
    #[inline(always)]
    fn take_found(&mut self) {
        self.velocity = self.found_velocity();
        self.total = plus(self.total, self.impulse, 1.0);
    }

    /// The change of the spin by joints in a part with this share of a kick.
    #[inline(always)]
    fn note_spin(&mut self, foresees: bool, share: f64) {
        if foresees {
            self.spin_by_joints = (self.found[2] - self.velocity[2]) / share;
        }
    }

    /// The body moves on, and the arms of its joints turn.
    #[inline(always)]
    fn advance(&mut self, parent: Option<&mut Hinge>, h: f64) {
        self.take_found();
        self.path = self.way(self.velocity, h);
        let [x, y, spin] = self.velocity.map(|velocity| velocity * h);
        self.place = plus(self.place, [x, y], 1.0);
        self.turn = turn(spin);
        self.arm = turned(self.turn, self.arm);
        if let Some(parent) = parent {
            self.parent_arm = turned(parent.turn, self.parent_arm);
        }
    }

    /// How stiff the joint's impulse in a part of this length makes it, and its parent, against turning.
    #[inline(always)]
    fn note_pull(&mut self, parent: Option<&mut Hinge>, h: f64) {
        self.pull = h * dot(self.arm, self.impulse);
        if let Some(parent) = parent {
            parent.pull -= h * dot(self.parent_arm, self.impulse);
        }
    }

    /// Tells the body how it moves after the step and how far it has come, and the joint with what force it has held.
    #[inline(always)]
    fn tell(
        &self,
        holds: &mut [Hold],
        bodies: &mut Bodies,
        (velocity, path, force): ([f64; 3], [f64; 3], Vector),
    ) {
        if self.body != 0 {
            let body = self.body as usize;
            // Along the depth axis nothing holds it.
            let (velocity_told, path_told) = (&mut bodies.hot[body].velocity, &mut bodies.path[body]);
            for i in 0..3 {
                (velocity_told[i], path_told[i]) = (velocity[i] as f32, path[i] as f32);
            }
        }
        if self.link.holds() {
            let [x, y] = force.map(|force| force * self.sign);
            holds[self.joint as usize].force = [x, y, 0.0];
        }
    }

    /// So much is added to the inertia.
    #[inline(always)]
    fn stiffen(&mut self, stiffness: f64) {
        (self.stiffness, self.with_momentum) = (stiffness, with_momentum(stiffness, self.borne));
    }

    /// What of its stiffness is more than the inertia bears.
    #[inline(always)]
    fn excess(&self) -> f64 {
        let excess = self.pull - self.borne;
        if excess > 0.0 && self.link != Link::Fixed { excess } else { 0.0 }
    }

    /// Whether joints have had to pull far more than before: something has come to the end of its chain.
    #[inline(always)]
    fn is_jerked(&self) -> bool {
        (self.pull > self.stiffness + 2.0 * self.borne) & (self.link != Link::Fixed)
    }

    /// From the anchor of the parent to the body's.
    #[inline(always)]
    fn apart(&self, parent: &Hinge) -> Vector {
        plus(plus(self.place, self.arm, 1.0), plus(parent.place, self.parent_arm, 1.0), -1.0)
    }
}
