//! Joints of the precise set.
//!
//! Joints that make trees are solved [exactly](tree), whatever hangs on them; [the others](loose) one after the other. A tree
//! that nothing touches [swings](swing) by itself; one that touches something is solved in the passes of contacts.

mod forest;
mod hold;
mod loose;
pub(super) mod read;
mod swing;
mod tree;

use super::bodies::{Bodies, Hot};
use super::tuning::Step;
use crate::joints::JointId;
use forest::Forest;
use hold::{End, Hold, Key};
use loose::{Loose, Pass};
use tree::{Link, Node, solve};

/// The joints of a step.
#[derive(Debug, Clone, Default)]
pub(super) struct Joints {
    /// In the order of the list of joints; not those that hold nothing now.
    holds: Vec<Hold>,
    /// The list when they were read, and whether nothing has changed since.
    listed: Vec<JointId>,
    is_read: bool,
    forest: Forest,
    nodes: Vec<Node>,
    /// Of each tree, whether nothing touches it.
    are_apart: Vec<bool>,
    loose: Vec<Loose>,
    unit: f64,
}

impl Joints {
    /// Whether all joints are in trees that nothing touches.
    pub(super) fn are_all_apart(&self) -> bool {
        self.loose.is_empty() && self.are_apart.iter().all(|&is_apart| is_apart)
    }

    /// Whether some joint holds a body.
    #[inline(always)]
    pub(super) fn holds(&self, body: usize) -> bool {
        self.forest.is_held.get(body).is_some_and(|&is_held| is_held)
    }

    /// Plans for the joints that were read.
    fn plan(&mut self, bodies: &Bodies) {
        let keys: Vec<Key> = self.holds.iter().map(Hold::key).collect();
        self.forest = Forest::new(&keys, bodies.first_fixed());
        self.nodes.clear();
        let trees: Vec<_> = self.forest.trees().collect();
        for (first, end) in trees {
            self.plan_tree(first, end, bodies);
        }
    }

    fn plan_tree(&mut self, first: usize, end: usize, bodies: &Bodies) {
        for seat in &self.forest.seats[first..end] {
            let parent = seat.parent - first as u32;
            let mut node = Node::new(seat.body, parent, bodies.inverses[seat.body as usize]);
            if let Some(at) = seat.hold {
                let hold = &self.holds[at as usize];
                (node.joint, node.link) = (at, hold.link);
                // The joint is the first body's view of the second; a tree's is the parent's view of the child.
                node.is_first = hold.ends[0].body == seat.body;
            }
            self.nodes.push(node);
        }
    }

    /// A step begins.
    fn begin(&mut self, bodies: &Bodies, step: &Step, unit: f32, is_touched: impl Fn(usize) -> bool) {
        self.unit = f64::from(unit);
        let (dt, h) = (f64::from(step.dt), f64::from(step.h));
        for (first, end) in self.forest.trees() {
            begin_tree(&mut self.nodes[first..end], &self.holds, bodies, [dt, h]);
        }
        let inverses = |body: u32| bodies.inverses[body as usize].map(f64::from);
        self.loose.clear();
        for &at in &self.forest.loose {
            self.loose.push(Loose::new(at as usize, &self.holds[at as usize], [dt, h], inverses));
        }
        self.find_apart(is_touched);
    }

    /// A tree is apart if nothing touches its bodies, and no joint outside of trees holds them.
    fn find_apart(&mut self, is_touched: impl Fn(usize) -> bool) {
        self.are_apart.clear();
        for (first, end) in self.forest.trees() {
            let is_free = |node: &Node| node.body == 0 || !is_touched(node.body as usize);
            self.are_apart.push(self.nodes[first..end].iter().all(is_free));
        }
        for loose in &self.loose {
            for end in self.holds[loose.hold as usize].ends {
                if let Some(tree) = self.forest.tree_of(end.body) {
                    self.are_apart[tree] = false;
                }
            }
        }
    }

    /// Trees that nothing touches.
    fn apart(&mut self) -> impl Iterator<Item = &mut [Node]> {
        trees(&mut self.nodes, &self.forest, &self.are_apart, true)
    }

    /// Trees that are solved with contacts.
    fn mixed(&mut self) -> impl Iterator<Item = &mut [Node]> {
        trees(&mut self.nodes, &self.forest, &self.are_apart, false)
    }

    /// Moves the trees that nothing touches through all substeps.
    pub(super) fn swing(&mut self, bodies: &Bodies, step: &Step) {
        let unit = self.unit;
        self.apart().for_each(|nodes| swing::swing(nodes, bodies, step, unit));
    }

    /// The others get ready for the passes of a step; the impulses of joints outside of trees act from now on.
    pub(super) fn begin_passes(&mut self, warm: &mut [[f32; 4]], h: f32) {
        self.mixed().for_each(|nodes| swing::stiffen(nodes, f64::from(h)));
        self.loose.iter().for_each(|loose| loose.warm(warm));
    }

    /// A pass before bodies move: joints will hold where they are then.
    pub(super) fn correct(&mut self, bodies: &mut Bodies, h: f32) {
        let (h, unit) = (f64::from(h), self.unit);
        self.solve_loose(bodies, h, Pass::Correct);
        self.mixed().for_each(|nodes| {
            load(nodes, &bodies.hot);
            swing::aim(nodes, h, unit);
            solve(nodes, 1.0);
            keep_impulses(nodes);
            store(nodes, bodies);
        });
    }

    /// Bodies have moved.
    pub(super) fn advance(&mut self, bodies: &Bodies, h: f32) {
        let h = f64::from(h);
        self.mixed().for_each(|nodes| {
            load(nodes, &bodies.hot);
            swing::advance(nodes, h);
        });
        self.loose.iter_mut().for_each(|loose| loose.advance(&bodies.hot, h));
    }

    /// A pass after bodies have moved: velocities as joints allow them.
    pub(super) fn relax(&mut self, bodies: &mut Bodies, h: f32) {
        self.solve_loose(bodies, f64::from(h), Pass::Rest);
        self.mixed().for_each(|nodes| {
            load(nodes, &bodies.hot);
            swing::rest(nodes);
            solve(nodes, 0.0);
            store(nodes, bodies);
        });
    }

    fn solve_loose(&mut self, bodies: &mut Bodies, h: f64, pass: Pass) {
        for loose in &mut self.loose {
            loose.solve(&self.holds[loose.hold as usize], &mut bodies.hot, h, pass);
        }
    }

    /// Where the trees that nothing touched have come to, and what has held all joints.
    pub(super) fn finish(&mut self, bodies: &mut Bodies, h: f32) {
        self.apart().for_each(|nodes| {
            for node in nodes.iter().filter(|node| node.body != 0) {
                let ([vx, vy, spin], [x, y, turned]) = (node.velocity, node.path);
                bodies.hot[node.body as usize].velocity = [vx as f32, vy as f32, spin as f32, 0.0];
                bodies.path[node.body as usize] = [x as f32, y as f32, turned as f32, 0.0];
            }
        });
        for node in self.nodes.iter().filter(|node| node.link.holds()) {
            let hold = &mut self.holds[node.joint as usize];
            hold.force = node.kept_impulse.map(|impulse| (node.sign() * impulse / node.substep) as f32);
        }
        for loose in &self.loose {
            self.holds[loose.hold as usize].force = loose.force(f64::from(h));
        }
    }
}

/// The trees that are apart, or those that are not.
fn trees<'a>(
    nodes: &'a mut [Node],
    forest: &'a Forest,
    are_apart: &'a [bool],
    apart: bool,
) -> impl Iterator<Item = &'a mut [Node]> {
    let sizes = forest.trees().map(|(first, end)| end - first);
    let mut rest = nodes;
    let mut all = sizes.zip(are_apart);
    std::iter::from_fn(move || {
        loop {
            let (size, &is_apart) = all.next()?;
            let (tree, others) = std::mem::take(&mut rest).split_at_mut(size);
            rest = others;
            if is_apart == apart {
                return Some(tree);
            }
        }
    })
}

/// The nodes of a tree go where their bodies and joints are; what does not give way is where its joint says.
fn begin_tree(nodes: &mut [Node], holds: &[Hold], bodies: &Bodies, [dt, h]: [f64; 2]) {
    for at in 0..nodes.len() {
        let node = &mut nodes[at];
        node.begin(bodies);
        if node.link.holds() {
            let side = node.hang(&holds[node.joint as usize], dt, h);
            let parent = node.parent as usize;
            if nodes[parent].link == Link::Fixed {
                (nodes[parent].place, nodes[parent].velocity) = (side.place, side.velocity);
            }
        }
    }
}

/// Nodes move as their bodies do.
fn load(nodes: &mut [Node], hot: &[Hot]) {
    for node in nodes.iter_mut().filter(|node| node.body != 0) {
        let [x, y, spin, _] = hot[node.body as usize].velocity.map(f64::from);
        node.velocity = [x, y, spin];
    }
}

/// Bodies move as their nodes do. What trees do to velocities acts once, and is not repeated in the next substep as the
/// impulses of contacts are: they are found anew, with the arms as they are then.
fn store(nodes: &[Node], bodies: &mut Bodies) {
    for node in nodes.iter().filter(|node| node.body != 0) {
        let (velocity, begun) =
            (&mut bodies.hot[node.body as usize].velocity, &mut bodies.begun[node.body as usize]);
        for i in 0..3 {
            let now = node.velocity[i] as f32;
            begun[i] += now - velocity[i];
            velocity[i] = now;
        }
    }
}

fn keep_impulses(nodes: &mut [Node]) {
    nodes.iter_mut().for_each(|node| node.kept_impulse = node.impulse);
}

impl Node {
    fn new(body: u32, parent: u32, inverses: [f32; 2]) -> Self {
        let [mass, inertia] = inverses.map(weight_of);
        let link = if body == 0 { Link::Fixed } else { Link::Free };
        Node { body, parent, link, mass, inertia, direction: [1.0, 0.0], ..Node::default() }
    }

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
        self.path = [0.0; 3];
    }

    /// Hangs on a joint as it is now. Answers the side of the parent.
    #[inline(always)]
    fn hang<'a>(&mut self, hold: &'a Hold, dt: f64, h: f64) -> &'a End {
        let [first, second] = &hold.ends;
        let (parent, child) = if self.is_first { (second, first) } else { (first, second) };
        (self.arm, self.parent_arm) = (child.arm, parent.arm);
        // An impulse of a substep is that part of one of an update.
        (self.softness, self.rate) = (hold.softness * dt / h, hold.bias_factor / dt);
        self.wanted = match hold.link {
            Link::Distance => hold.range[0],
            _ => self.sign() * (hold.angle - hold.range[0]),
        };
        self.impulse = hold.force.map(|force| self.sign() * f64::from(force) * h);
        self.substep = h;
        parent
    }
}

/// A mass from its reciprocal. What cannot be moved is so heavy that nothing that is pushed can tell.
fn weight_of(inverse: f32) -> f64 {
    if inverse > 0.0 { 1.0 / f64::from(inverse) } else { 1e60 }
}
