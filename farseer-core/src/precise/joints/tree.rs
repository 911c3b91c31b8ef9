//! Bodies that joints hold together in the form of a tree, solved exactly and at once.
//!
//! What a joint's side of a tree does to the body on its other side is what one body would do: it has an inertia, a matrix of
//! three rows, and a momentum (R. Featherstone, "The calculation of robot dynamics using articulated-body inertias", 1983).
//! From the leaves up each joint hands its part of them to the parent: the motions that it leaves free are eliminated, the
//! others are the parent's. From the root down velocities follow. That is the solution of M v' = M v + J^T l, J v' = b by an
//! elimination that fills nothing in: its cost goes with the number of bodies, and no pass has to be repeated.
//!
//! A motion is the velocity of a point and the spin w. With r the arm from one point to another and p = (-r.y, r.x), the
//! other's velocity is v + w p, and an inertia [A c; c^T d] at the other point is [A, c + A p; ., d + 2 c.p + p.A p] at the
//! one. Each body is seen from its joint with the parent, a root from its origin.
//!
//! Trees whose joints all keep points, and that nothing touches, are solved by the same formulas in [`hinged`](super::hinged).
//!
//! Numbers are `f64`: the reciprocal of an inertia that a long chain hands up loses half of its digits.

pub(super) type Vector = [f64; 2];

#[inline(always)]
pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[inline(always)]
pub(super) fn cross(a: Vector, b: Vector) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Velocity of a point with this arm for a spin of 1.
#[inline(always)]
pub(super) fn spun(arm: Vector) -> Vector {
    [-arm[1], arm[0]]
}

/// a + b s
#[inline(always)]
pub(super) fn plus(a: Vector, b: Vector, s: f64) -> Vector {
    [a[0] + b[0] * s, a[1] + b[1] * s]
}

/// What a joint keeps of the motion of a body against its parent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Link {
    /// Nothing: the root of a tree that is not fixed to the world.
    #[default]
    Free,
    /// Everything: the root is the world, or what gives way to nothing; its velocity is given.
    Fixed,
    /// A point of both is one.
    Point,
    /// A point and the angle.
    Weld,
    /// The angle.
    Angle,
    /// The distance of two anchors.
    Distance,
    /// A line that is fixed in one of them, and the angle.
    Line,
}

/// A symmetric matrix of two rows.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Symmetric {
    xx: f64,
    xy: f64,
    yy: f64,
}

impl Symmetric {
    #[inline(always)]
    pub(super) fn times(&self, v: Vector) -> Vector {
        [self.xx * v[0] + self.xy * v[1], self.xy * v[0] + self.yy * v[1]]
    }

    /// self + s v v^T
    #[inline(always)]
    pub(super) fn with(&self, v: Vector, s: f64) -> Self {
        Symmetric {
            xx: self.xx + s * v[0] * v[0],
            xy: self.xy + s * v[0] * v[1],
            yy: self.yy + s * v[1] * v[1],
        }
    }

    #[inline(always)]
    fn solve(&self, v: Vector) -> Vector {
        let inverse = 1.0 / (self.xx * self.yy - self.xy * self.xy);
        [(self.yy * v[0] - self.xy * v[1]) * inverse, (self.xx * v[1] - self.xy * v[0]) * inverse]
    }
}

/// The inertia of a body, or of a body and all that hangs on it, at its joint.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Inertia {
    pub(super) mass: Symmetric,
    pub(super) coupling: Vector,
    pub(super) turning: f64,
}

/// Its momentum there.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Momentum {
    pub(super) along: Vector,
    pub(super) turning: f64,
}

impl Inertia {
    /// That of a body, at the point with this arm.
    #[inline(always)]
    pub(super) fn of(mass: f64, inertia: f64, arm: Vector) -> Self {
        let p = spun(arm);
        Inertia {
            mass: Symmetric { xx: mass, xy: 0.0, yy: mass },
            coupling: [-mass * p[0], -mass * p[1]],
            turning: inertia + mass * dot(p, p),
        }
    }

    /// Takes something else in, which is at a point with this arm.
    #[inline(always)]
    fn add(&mut self, other: &Inertia, arm: Vector) {
        let p = spun(arm);
        self.add_point(&other.mass, arm);
        self.coupling = plus(self.coupling, other.coupling, 1.0);
        self.turning += other.turning + 2.0 * dot(other.coupling, p);
    }

    /// Takes in something without inertia against turning.
    #[inline(always)]
    pub(super) fn add_point(&mut self, mass: &Symmetric, arm: Vector) {
        let p = spun(arm);
        let moved = mass.times(p);
        self.mass.xx += mass.xx;
        self.mass.xy += mass.xy;
        self.mass.yy += mass.yy;
        self.coupling = plus(self.coupling, moved, 1.0);
        self.turning += dot(moved, p);
    }

    /// The velocity of a body with this inertia and nothing that holds it.
    #[inline(always)]
    pub(super) fn free(&self, momentum: &Momentum) -> [f64; 3] {
        let (inertia, twist) = self.without_place(momentum);
        let spin = twist / inertia;
        let [x, y] = self.mass.solve(plus(momentum.along, self.coupling, -spin));
        [x, y, spin]
    }

    /// What of it is left for one that slides along it in this direction.
    #[inline(always)]
    fn without_slide(&self, direction: Vector) -> Inertia {
        let moved = self.mass.times(direction);
        let (inverse, coupled) = (1.0 / dot(direction, moved), dot(self.coupling, direction));
        Inertia {
            mass: self.mass.with(moved, -inverse),
            coupling: plus(self.coupling, moved, -coupled * inverse),
            turning: self.turning - coupled * coupled * inverse,
        }
    }

    /// Inertia and momentum that are left for one who only turns with it.
    #[inline(always)]
    fn without_place(&self, momentum: &Momentum) -> (f64, f64) {
        let weighed = self.mass.solve(self.coupling);
        (self.turning - dot(self.coupling, weighed), momentum.turning - dot(weighed, momentum.along))
    }
}

impl Momentum {
    /// That of a body with this velocity, at the point with this arm.
    #[inline(always)]
    pub(super) fn of(mass: f64, inertia: f64, arm: Vector, [x, y, spin]: [f64; 3]) -> Self {
        let along = [mass * x, mass * y];
        Momentum { along, turning: inertia * spin - cross(arm, along) }
    }

    /// Takes in something at a point with this arm.
    #[inline(always)]
    pub(super) fn add(&mut self, along: Vector, turning: f64, arm: Vector) {
        self.along = plus(self.along, along, 1.0);
        self.turning += turning + cross(arm, along);
    }
}

/// A body in a tree. Parents come before their children; a root is its own parent.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Node {
    /// The body's number, the place of its parent in the tree and the number of the joint with it.
    pub(super) body: u32,
    pub(super) parent: u32,
    pub(super) joint: u32,
    pub(super) link: Link,
    /// The joint calls this body its first, and the parent its second.
    pub(super) is_first: bool,
    pub(super) mass: f64,
    pub(super) inertia: f64,
    /// Added to the inertia while the joints pull: see [`stiffen_for_jerk`](super::swing).
    pub(super) stiffness: f64,
    /// How stiff the joints make it against turning by what they pull.
    pub(super) pull: f64,
    /// Square of the longest arm of a joint.
    pub(super) reach: f64,
    pub(super) velocity: [f64; 3],
    /// The spin in this substep that joints reckon with.
    pub(super) expected_spin: f64,
    /// Change of the spin by joints in a part of the step, as predicted from the part before, in radians/s.
    pub(super) spin_by_joints: f64,
    /// The velocity in this substep before joints act.
    pub(super) before: [f64; 3],
    /// What forces add to it in a substep.
    pub(super) push: [f64; 3],
    /// Where the origin is, how far it has come and turned in this step, and how far the body turns in this substep.
    pub(super) place: Vector,
    pub(super) path: [f64; 3],
    pub(super) turn: Vector,
    /// Arms of the joint on the body and on its parent, and the direction from the parent's anchor to the body's.
    pub(super) arm: Vector,
    pub(super) parent_arm: Vector,
    pub(super) direction: Vector,
    /// Velocity of the body against its parent at the joint that is asked for; of a distance the first counts.
    pub(super) bias: [f64; 3],
    /// Angle against the parent minus the wanted one when the step begins, or the wanted distance.
    pub(super) wanted: f64,
    /// The joint's error when the step begins, as a fraction of its arms or in radians.
    pub(super) gap: f64,
    /// Impulse of the joint on the body.
    pub(super) impulse: [f64; 3],
    /// The impulse of the step so far.
    pub(super) total: [f64; 3],
    pub(super) work: Work,
}

/// What a solution finds on its way.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Work {
    /// What hangs on the body, and then with the body itself.
    seen: Inertia,
    momentum: Momentum,
    /// From its own joint, or from the origin of a root, to that with the parent: of the parent.
    lever: Vector,
    /// Velocity at the joint, and spin.
    velocity: [f64; 3],
    /// Of the turning at the joint, which most joints leave free: 1 / d and A - c c^T / d, and the impulse against it.
    inverse_turning: f64,
    rest: Symmetric,
    load: Vector,
    /// Of a distance: inertia and impulse along it, and what moves across with a motion along.
    along: [f64; 3],
}

/// Parents have to move what hangs on them. This and the two beneath it are not inlined: so often they are used.
#[inline(never)]
pub(super) fn hand_up(nodes: &mut [Node]) {
    for_each_up(nodes, Node::hand_up);
}

/// What of that depends on velocities and biases.
#[inline(never)]
pub(super) fn hand_up_momentum(nodes: &mut [Node]) {
    for_each_up(nodes, Node::hand_up_momentum);
}

/// From the roots down velocities and impulses are found.
#[inline(never)]
pub(super) fn follow(nodes: &mut [Node]) {
    for_each_down(nodes, Node::follow);
}

/// Has a place in a tree, in which parents come before their children.
pub(super) trait Seated {
    /// The parent's place; a root's own.
    fn parent(&self) -> usize;
}

impl Seated for Node {
    #[inline(always)]
    fn parent(&self) -> usize {
        self.parent as usize
    }
}

/// Visits nodes with their parents, children first.
#[inline(always)]
pub(super) fn for_each_up<N: Seated>(nodes: &mut [N], mut visit: impl FnMut(&mut N, &mut N)) {
    for at in (1..nodes.len()).rev() {
        let (before, rest) = nodes.split_at_mut(at);
        if let Some(parent) = before.get_mut(rest[0].parent()) {
            visit(&mut rest[0], parent);
        }
    }
}

/// Visits nodes with their parents, parents first; a root has none.
#[inline(always)]
pub(super) fn for_each_down<N: Seated>(nodes: &mut [N], mut visit: impl FnMut(&mut N, Option<&mut N>)) {
    for at in 0..nodes.len() {
        let (before, rest) = nodes.split_at_mut(at);
        let parent = rest[0].parent();
        visit(&mut rest[0], before.get_mut(parent));
    }
}

impl Link {
    /// Whether it is that of a joint.
    pub(super) fn holds(self) -> bool {
        !matches!(self, Link::Free | Link::Fixed)
    }
}

impl Node {
    /// The impulse that was found has acted.
    #[inline(always)]
    pub(super) fn count_impulse(&mut self) {
        (0..3).for_each(|i| self.total[i] += self.impulse[i]);
    }

    /// The body's own inertia and momentum, at its joint.
    #[inline(always)]
    pub(super) fn take_own(&mut self, stiff: f64) {
        self.take_own_inertia(stiff);
        self.take_own_momentum(self.velocity, 0.0);
    }

    #[inline(always)]
    pub(super) fn take_own_inertia(&mut self, stiff: f64) {
        self.work.seen = Inertia::of(self.mass, self.inertia + stiff * self.stiffness, self.arm);
    }

    /// The body's own momentum with this velocity, at its joint, and that of so much stiffness.
    #[inline(always)]
    pub(super) fn take_own_momentum(&mut self, velocity: [f64; 3], stiffness: f64) {
        self.work.momentum = Momentum::of(self.mass, self.inertia + stiffness, self.arm, velocity);
    }

    /// The parent has to move the body as far as the joint says.
    #[inline(always)]
    pub(super) fn hand_up(&mut self, parent: &mut Node) {
        self.hand_up_inertia(parent);
        self.hand_up_momentum(parent);
    }

    #[inline(always)]
    fn hand_up_inertia(&mut self, parent: &mut Node) {
        let mut lever = plus(self.parent_arm, parent.arm, -1.0);
        if self.link == Link::Line {
            // What slides is held where it is.
            lever = plus(lever, self.apart(parent.place), 1.0);
        }
        self.work.lever = lever;
        let seen = &mut parent.work.seen;
        match self.link {
            Link::Free | Link::Fixed => {}
            Link::Point => {
                self.release_turning();
                seen.add_point(&self.work.rest, lever);
            }
            Link::Distance => {
                self.release_turning();
                let stiff = self.find_along();
                seen.add_point(&Symmetric::default().with(self.direction, stiff), lever);
            }
            Link::Weld => seen.add(&self.work.seen, lever),
            Link::Line => seen.add(&self.work.seen.without_slide(self.direction), lever),
            Link::Angle => {
                let (inertia, _) = self.work.seen.without_place(&Momentum::default());
                seen.turning += inertia;
            }
        }
    }

    /// What of that depends on velocities and biases.
    #[inline(always)]
    pub(super) fn hand_up_momentum(&mut self, parent: &mut Node) {
        let handed = &mut parent.work.momentum;
        let Inertia { mass, coupling, turning } = self.work.seen;
        let (Momentum { along, turning: twist }, lever) = (self.work.momentum, self.work.lever);
        let [x, y, spin] = self.bias;
        match self.link {
            Link::Free | Link::Fixed => {}
            Link::Point => {
                let load = plus(along, coupling, -twist * self.work.inverse_turning);
                self.work.load = load;
                handed.add(plus(self.work.load, self.work.rest.times([x, y]), -1.0), 0.0, lever);
            }
            Link::Distance => {
                self.work.load = plus(along, coupling, -twist * self.work.inverse_turning);
                let (n, t) = (self.direction, spun(self.direction));
                let [stiff, push, share] = &mut self.work.along;
                let load = dot(n, self.work.load) - *share * dot(t, self.work.load);
                *push = load - *stiff * x;
                handed.add([n[0] * *push, n[1] * *push], 0.0, lever);
            }
            Link::Weld => {
                let push = plus(plus(along, mass.times([x, y]), -1.0), coupling, -spin);
                handed.add(push, twist - dot(coupling, [x, y]) - turning * spin, lever);
            }
            Link::Line => {
                let held = self.work.seen.without_slide(self.direction);
                let slide = dot(self.direction, along) / dot(self.direction, mass.times(self.direction));
                let push = plus(along, mass.times(self.direction), -slide);
                let push = plus(plus(push, held.mass.times([x, y]), -1.0), held.coupling, -spin);
                let twist = twist - dot(coupling, self.direction) * slide;
                handed.add(push, twist - dot(held.coupling, [x, y]) - held.turning * spin, lever);
            }
            Link::Angle => {
                let (inertia, twist) = self.work.seen.without_place(&self.work.momentum);
                handed.turning += twist - inertia * spin;
            }
        }
    }

    /// The joint leaves the body's turning free.
    #[inline(always)]
    fn release_turning(&mut self) {
        let Inertia { mass, coupling, turning } = self.work.seen;
        self.work.inverse_turning = 1.0 / turning;
        self.work.rest = mass.with(coupling, -self.work.inverse_turning);
    }

    /// Finds, and answers, the inertia along the direction: across it the joint leaves the body free.
    #[inline(always)]
    fn find_along(&mut self) -> f64 {
        let (rest, n, t) = (self.work.rest, self.direction, spun(self.direction));
        let along_t = rest.times(t);
        let share = dot(n, along_t) / dot(t, along_t);
        let stiff = dot(n, rest.times(n)) - share * dot(n, along_t);
        // What the joint does to the body, once the parent's velocity is known, is stiff times that minus a push.
        self.work.along = [stiff, 0.0, share];
        stiff
    }

    /// The velocity of a root.
    #[inline(always)]
    fn lead(&mut self) {
        if self.link == Link::Free {
            self.velocity = self.work.seen.free(&self.work.momentum);
        }
        self.work.velocity = self.velocity;
    }

    /// The velocity, once that of the parent at its joint is known.
    #[inline(always)]
    pub(super) fn follow(&mut self, parent: Option<&mut Node>) {
        let Some(parent) = parent else { return self.lead() };
        let [x, y, spin] = parent.work.velocity;
        let at_parent = plus([x, y], spun(self.work.lever), spin);
        let at_joint = plus(at_parent, [self.bias[0], self.bias[1]], 1.0);
        let Inertia { mass, coupling, turning } = self.work.seen;
        let Momentum { along, turning: twist } = self.work.momentum;
        match self.link {
            Link::Free | Link::Fixed => {}
            Link::Point => {
                let [x, y] = plus(self.work.rest.times(at_joint), self.work.load, -1.0);
                self.impulse = [x, y, 0.0];
                self.turn_freely(at_joint);
            }
            Link::Distance => self.follow_distance(at_parent),
            Link::Weld | Link::Line => {
                let spin = spin + self.bias[2];
                let mut at_joint = at_joint;
                if self.link == Link::Line {
                    // Along the line nothing holds it.
                    let free = plus(plus(along, mass.times(at_joint), -1.0), coupling, -spin);
                    let slide = dot(self.direction, free) / dot(self.direction, mass.times(self.direction));
                    at_joint = plus(at_joint, self.direction, slide);
                }
                let [fx, fy] = plus(plus(mass.times(at_joint), coupling, spin), along, -1.0);
                self.impulse = [fx, fy, dot(coupling, at_joint) + turning * spin - twist];
                self.move_with(at_joint, spin);
            }
            Link::Angle => {
                let spin = spin + self.bias[2];
                let (inertia, twist) = self.work.seen.without_place(&self.work.momentum);
                self.impulse = [0.0, 0.0, inertia * spin - twist];
                self.move_with(mass.solve(plus(along, coupling, -spin)), spin);
            }
        }
    }

    #[inline(always)]
    fn follow_distance(&mut self, at_parent: Vector) {
        let Work { along: [stiff, push, share], rest, load, .. } = self.work;
        let (n, t) = (self.direction, spun(self.direction));
        let along = dot(n, at_parent);
        let impulse = stiff * along - push;
        let along = along + self.bias[0];
        // The direction across is free: its impulse is 0.
        let across = dot(t, load) / dot(t, rest.times(t)) - share * along;
        self.impulse = [n[0] * impulse, n[1] * impulse, 0.0];
        self.turn_freely([n[0] * along + t[0] * across, n[1] * along + t[1] * across]);
    }

    /// The velocity of a body with this velocity at a joint that leaves its turning free.
    #[inline(always)]
    fn turn_freely(&mut self, at_joint: Vector) {
        let twist = self.work.momentum.turning - dot(self.work.seen.coupling, at_joint);
        let spin = twist * self.work.inverse_turning;
        self.move_with(at_joint, spin);
    }

    #[inline(always)]
    fn move_with(&mut self, at_joint: Vector, spin: f64) {
        self.work.velocity = [at_joint[0], at_joint[1], spin];
        let [x, y] = plus(at_joint, spun(self.arm), -spin);
        self.velocity = [x, y, spin];
    }
}
