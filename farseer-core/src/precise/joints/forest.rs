//! Which joints make trees, and in which order their bodies come.

use super::hold::Key;

/// In place of a body's place in its group: it is in none.
pub(super) const GROUND: u32 = u32::MAX;

/// A body's place in a group.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seat {
    pub(super) body: u32,
    /// The place of a seat before this one in the group; a root's own.
    pub(super) parent: u32,
    /// The joint with the parent. A root has none; it is the world if the body's number is 0.
    pub(super) hold: Option<u32>,
}

/// Bodies that joints tie to each other, not counting the world.
#[derive(Debug, Clone, Default)]
pub(super) struct Group {
    /// Tree after tree, parents before their children.
    pub(super) seats: Vec<Seat>,
    /// All joints, and those that are in no tree because they close a loop or may give way.
    pub(super) joints: Vec<u32>,
    pub(super) loose: Vec<u32>,
}

impl Group {
    /// Joints that were given by their places in a list go by what stands there.
    pub(super) fn name_holds(&mut self, names: &[u32]) {
        let of_seats = self.seats.iter_mut().filter_map(|seat| seat.hold.as_mut());
        for at in of_seats.chain(&mut self.joints).chain(&mut self.loose) {
            *at = names[*at as usize];
        }
    }
}

/// The plan.
#[derive(Debug, Clone, Default)]
pub(super) struct Forest {
    pub(super) groups: Vec<Group>,
    /// By body number: its place in its group.
    pub(super) seat_of: Vec<u32>,
}

/// Which bodies are joined so far.
struct Joined(Vec<u32>);

impl Joined {
    fn new(bodies: usize) -> Self {
        Joined((0..bodies as u32).collect())
    }

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

/// What seats bodies.
struct Planting<'a> {
    keys: &'a [Key],
    /// By body: joints of trees, and who is on their other side.
    neighbours: Vec<Vec<(u32, u32)>>,
    seat_of: Vec<u32>,
}

impl Forest {
    /// Plans for joints in their order, and bodies of numbers below `bodies`. Number 0 is the world: two joints of a tree
    /// with it close a loop as well.
    pub(super) fn new(keys: &[Key], bodies: usize) -> Self {
        let (mut in_trees, mut in_groups) = (Joined::new(bodies), Joined::new(bodies));
        let mut neighbours = vec![Vec::new(); bodies];
        let mut is_loose = vec![false; keys.len()];
        for (at, key) in keys.iter().enumerate() {
            let [a, b] = key.bodies;
            if a != 0 && b != 0 {
                in_groups.join(key.bodies);
            }
            is_loose[at] = key.is_bounded || !in_trees.join(key.bodies);
            if !is_loose[at] {
                neighbours[a as usize].push((at as u32, b));
                neighbours[b as usize].push((at as u32, a));
            }
        }
        let mut members: Vec<Vec<u32>> = Vec::new();
        let mut group_of = vec![None; bodies];
        for (at, key) in keys.iter().enumerate() {
            let root = in_groups.root(key.bodies[0].max(key.bodies[1]));
            let group = *group_of[root as usize].get_or_insert_with(|| {
                members.push(Vec::new());
                members.len() - 1
            });
            members[group].push(at as u32);
        }
        let mut planting = Planting { keys, neighbours, seat_of: vec![GROUND; bodies] };
        let groups = members.iter().map(|members| planting.group(members, &is_loose)).collect();
        Forest { groups, seat_of: planting.seat_of }
    }
}

impl Planting<'_> {
    fn group(&mut self, members: &[u32], is_loose: &[bool]) -> Group {
        let mut group = Group::default();
        for &at in members.iter().filter(|&&at| !is_loose[at as usize]) {
            let [a, b] = self.keys[at as usize].bodies;
            if a == 0 || b == 0 {
                let root = group.seats.len() as u32;
                group.seats.push(Seat { body: 0, parent: root, hold: None });
                self.seat(&mut group, a.max(b), root, Some(at));
                self.grow(&mut group);
            }
        }
        for body in members.iter().flat_map(|&at| self.keys[at as usize].bodies) {
            if body != 0 && self.seat_of[body as usize] == GROUND {
                let root = group.seats.len() as u32;
                self.seat(&mut group, body, root, None);
                self.grow(&mut group);
            }
        }
        group.joints = members.to_vec();
        group.loose = members.iter().copied().filter(|&at| is_loose[at as usize]).collect();
        group
    }

    fn seat(&mut self, group: &mut Group, body: u32, parent: u32, hold: Option<u32>) {
        self.seat_of[body as usize] = group.seats.len() as u32;
        group.seats.push(Seat { body, parent, hold });
    }

    /// Seats all that hang on the last seat.
    fn grow(&mut self, group: &mut Group) {
        let mut at = group.seats.len() - 1;
        while let Some(&seat) = group.seats.get(at) {
            for (hold, body) in std::mem::take(&mut self.neighbours[seat.body as usize]) {
                if body != 0 && self.seat_of[body as usize] == GROUND {
                    self.seat(group, body, at as u32, Some(hold));
                }
            }
            at += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Forest, Key};

    fn plan(pairs: &[[u32; 2]], bodies: usize) -> Forest {
        let keys: Vec<Key> = pairs.iter().map(|&bodies| Key { bodies, is_bounded: false }).collect();
        Forest::new(&keys, bodies)
    }

    fn seats(forest: &Forest, group: usize) -> Vec<(u32, u32)> {
        forest.groups[group].seats.iter().map(|seat| (seat.body, seat.parent)).collect()
    }

    #[test]
    fn a_chain_that_hangs_is_one_tree_in_its_order() {
        let forest = plan(&[[1, 2], [0, 1], [2, 3]], 4);
        assert_eq!(seats(&forest, 0), [(0, 0), (1, 0), (2, 1), (3, 2)]);
        assert!(forest.groups[0].loose.is_empty());
    }

    #[test]
    fn the_joint_that_closes_a_loop_is_in_no_tree() {
        assert_eq!(plan(&[[0, 1], [1, 2], [2, 0]], 3).groups[0].loose, [2]);
        assert_eq!(plan(&[[1, 2], [2, 3], [3, 1]], 4).groups[0].loose, [2]);
    }

    #[test]
    fn what_is_fixed_to_the_world_apart_makes_two_groups() {
        let forest = plan(&[[0, 1], [0, 2]], 3);
        assert_eq!(forest.groups.len(), 2);
        assert_eq!((seats(&forest, 0), seats(&forest, 1)), (vec![(0, 0), (1, 0)], vec![(0, 0), (2, 0)]));
    }

    #[test]
    fn two_trees_with_a_loop_between_them_are_one_group() {
        let forest = plan(&[[0, 1], [0, 2], [1, 2]], 3);
        assert_eq!(forest.groups.len(), 1);
        assert_eq!(seats(&forest, 0), [(0, 0), (1, 0), (0, 2), (2, 2)]);
        assert_eq!(forest.groups[0].loose, [2]);
    }
}
