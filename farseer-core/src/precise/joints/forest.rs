//! Which joints make trees, and in which order their bodies come.

use super::hold::Key;

/// A body's place in the trees.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seat {
    pub(super) body: u32,
    /// The number of a seat before this one; a root's own.
    pub(super) parent: u32,
    /// The joint with the parent. A root has none; it is the world if the body's number is 0.
    pub(super) hold: Option<u32>,
}

/// The plan: trees of joints, and joints that are in none because they close a loop or may give way.
#[derive(Debug, Clone, Default)]
pub(super) struct Forest {
    /// Tree after tree, parents before their children.
    pub(super) seats: Vec<Seat>,
    /// Where trees begin, and the end of the last one.
    pub(super) starts: Vec<u32>,
    pub(super) loose: Vec<u32>,
    /// By body number: some joint holds it.
    pub(super) is_held: Vec<bool>,
    /// By body number: the tree that it is in.
    tree_of: Vec<Option<u32>>,
}

/// Which bodies are joined so far.
struct Joined(Vec<u32>);

impl Joined {
    fn root(&mut self, mut body: u32) -> u32 {
        while self.0[body as usize] != body {
            let above = self.0[body as usize];
            self.0[body as usize] = self.0[above as usize];
            body = above;
        }
        body
    }

    /// Answers whether they were not joined before.
    fn join(&mut self, [a, b]: [u32; 2]) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
        a != b
    }
}

impl Forest {
    /// Plans for joints in their order, and bodies of numbers below `bodies`. Number 0 is the world: two joints of a tree
    /// with it close a loop as well.
    pub(super) fn new(keys: &[Key], bodies: usize) -> Self {
        let mut forest = Forest { is_held: vec![false; bodies], ..Forest::default() };
        let mut joined = Joined((0..bodies as u32).collect());
        // Lists by body of joints and who is on their other side.
        let mut neighbours = vec![Vec::new(); bodies];
        for (at, key) in keys.iter().enumerate() {
            key.bodies.iter().for_each(|&body| forest.is_held[body as usize] |= body != 0);
            if key.is_bounded || !joined.join(key.bodies) {
                forest.loose.push(at as u32);
                continue;
            }
            let [a, b] = key.bodies;
            neighbours[a as usize].push((at as u32, b));
            neighbours[b as usize].push((at as u32, a));
        }
        let mut is_seated = vec![false; bodies];
        is_seated[0] = true;
        for &(hold, body) in &neighbours[0] {
            let root = forest.plant(0);
            is_seated[body as usize] = true;
            forest.seats.push(Seat { body, parent: root, hold: Some(hold) });
            forest.grow(&neighbours, &mut is_seated);
        }
        for body in keys.iter().flat_map(|key| key.bodies) {
            let is_root = !neighbours[body as usize].is_empty();
            if is_root && !std::mem::replace(&mut is_seated[body as usize], true) {
                forest.plant(body);
                forest.grow(&neighbours, &mut is_seated);
            }
        }
        forest.starts.push(forest.seats.len() as u32);
        forest.note_trees(bodies);
        forest
    }

    /// A new tree with this root.
    fn plant(&mut self, body: u32) -> u32 {
        let root = self.seats.len() as u32;
        self.starts.push(root);
        self.seats.push(Seat { body, parent: root, hold: None });
        root
    }

    /// Seats all that hang on the last seat.
    fn grow(&mut self, neighbours: &[Vec<(u32, u32)>], is_seated: &mut [bool]) {
        let mut at = self.seats.len() - 1;
        while let Some(&seat) = self.seats.get(at) {
            for &(hold, body) in &neighbours[seat.body as usize] {
                if !std::mem::replace(&mut is_seated[body as usize], true) {
                    self.seats.push(Seat { body, parent: at as u32, hold: Some(hold) });
                }
            }
            at += 1;
        }
    }

    fn note_trees(&mut self, bodies: usize) {
        let mut tree_of = vec![None; bodies];
        for (tree, (first, end)) in self.trees().enumerate() {
            for seat in self.seats[first..end].iter().filter(|seat| seat.body != 0) {
                tree_of[seat.body as usize] = Some(tree as u32);
            }
        }
        self.tree_of = tree_of;
    }

    /// The number of the tree that a body is in.
    pub(super) fn tree_of(&self, body: u32) -> Option<usize> {
        self.tree_of[body as usize].map(|tree| tree as usize)
    }

    /// Trees, by the numbers of their first seats and of those behind their last ones.
    pub(super) fn trees(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.starts.windows(2).map(|ends| (ends[0] as usize, ends[1] as usize))
    }
}

#[cfg(test)]
mod tests {
    use super::super::tree::Link;
    use super::{Forest, Key};

    fn keys(pairs: &[[u32; 2]]) -> Vec<Key> {
        pairs.iter().map(|&bodies| Key { bodies, link: Link::Point, is_bounded: false }).collect()
    }

    #[test]
    fn a_chain_that_hangs_is_one_tree_in_its_order() {
        let forest = Forest::new(&keys(&[[1, 2], [0, 1], [2, 3]]), 4);
        let seats: Vec<_> = forest.seats.iter().map(|seat| (seat.body, seat.parent)).collect();
        assert_eq!(seats, [(0, 0), (1, 0), (2, 1), (3, 2)]);
        assert!(forest.loose.is_empty());
    }

    #[test]
    fn the_joint_that_closes_a_loop_is_in_no_tree() {
        let bridge = Forest::new(&keys(&[[0, 1], [1, 2], [2, 0]]), 3);
        assert_eq!(bridge.loose, [2]);
        let ring = Forest::new(&keys(&[[1, 2], [2, 3], [3, 1]]), 4);
        assert_eq!(ring.loose, [2]);
    }

    #[test]
    fn what_is_fixed_twice_to_the_world_apart_makes_two_trees() {
        let forest = Forest::new(&keys(&[[0, 1], [0, 2]]), 3);
        assert_eq!(forest.trees().collect::<Vec<_>>(), [(0, 2), (2, 4)]);
    }
}
