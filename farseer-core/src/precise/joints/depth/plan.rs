//! Which joints make groups in three axes, and what their numbers have to do with each other.

use super::super::super::bodies::Bodies;
use super::super::super::islands::Islands;
use super::super::forest::GROUND;
use super::super::hold::Hold;
use super::super::tree::Link;
use super::group::{Shared, SpatialGroup};
use super::row::{Row, Side, Tie, What};
use super::sparse::Sparse;
use crate::precise::parameters::spatial_joints::GROUP_FACTOR_PRODUCTS;
use crate::storage::order::{joined, sort_by_number};

/// What hangs together by joints of which one keeps a distance, in the order of the first joints; and the joints that are in
/// none of them.
pub(in super::super) fn spatial_groups(holds: &[Hold], bodies: &Bodies) -> (Vec<SpatialGroup>, Vec<u32>) {
    let mut unions = Islands::default();
    unions.part(bodies.hot.len());
    for [a, b] in holds.iter().map(|hold| hold.ends.map(|end| end.body)) {
        if a != 0 && b != 0 {
            unions.join(a, b);
        }
    }
    let mut root_of = |hold: &Hold| unions.find(hold.ends[0].body.max(hold.ends[1].body));
    let roots: Vec<u32> = holds.iter().map(&mut root_of).collect();
    let mut groups: Vec<Vec<u32>> = Vec::new();
    let distances = holds.iter().zip(&roots).filter(|(hold, _)| hold.link == Link::Distance);
    let mut has_distance: Vec<u32> = distances.map(|(_, &root)| root).collect();
    has_distance.sort_unstable();
    has_distance.dedup();
    let (mut group_of, mut others) = (vec![None; has_distance.len()], Vec::new());
    for (at, root) in (0..).zip(&roots) {
        match has_distance.binary_search(root) {
            Ok(of) => {
                let group = *group_of[of].get_or_insert_with(|| {
                    groups.push(Vec::new());
                    groups.len() - 1
                });
                groups[group].push(at);
            }
            Err(_) => others.push(at),
        }
    }
    (groups.iter().map(|members| SpatialGroup::new(members, holds, bodies)).collect(), others)
}

impl SpatialGroup {
    fn new(members: &[u32], holds: &[Hold], bodies: &Bodies) -> Self {
        let mut numbers: Vec<u32> = members
            .iter()
            .flat_map(|&at| holds[at as usize].ends.map(|end| end.body))
            .filter(|&body| body != 0)
            .collect();
        numbers.sort_unstable();
        numbers.dedup();
        let closing = closing(members, holds, &numbers);
        let mut group = SpatialGroup { is_looped: closing.contains(&true), ..SpatialGroup::default() };
        for (&at, closes_loop) in members.iter().zip(closing) {
            let hold = &holds[at as usize];
            let place = group.ties.len() as u32;
            let sides = hold.ends.map(|end| Side {
                node: numbers.binary_search(&end.body).map_or(GROUND, |node| node as u32),
                ground: [0.0; 4],
                place: [0.0; 3],
                arm: [0.0; 2],
                turned: 0.0,
            });
            let tie = Tie {
                hold: at,
                link: hold.link,
                sides,
                direction: [1.0, 0.0, 0.0],
                line: [1.0, 0.0],
                total: [0.0; 4],
                is_central: false,
            };
            group.ties.push(tie);
            group.rows.extend(numbers_of(hold).into_iter().map(|what| Row::new(place, what, closes_loop)));
        }
        let inverses = numbers.iter().map(|&body| {
            let [mass, inertia] = bodies.inverses[body as usize].map(f64::from);
            [mass, mass, inertia, mass]
        });
        group.inverses = inverses.collect();
        group.velocities = vec![[0.0; 4]; numbers.len()];
        group.missing = vec![0.0; group.rows.len()];
        group.bodies = numbers;
        group.find_shared();
        group
    }

    /// Which numbers hold the same bodies.
    fn find_shared(&mut self) {
        let mut holders = vec![Vec::new(); self.bodies.len()];
        for (at, row) in self.rows.iter().enumerate() {
            for (side, of) in
                self.ties[row.tie as usize].sides.iter().enumerate().filter(|(_, of)| of.node != GROUND)
            {
                holders[of.node as usize].push((at as u32, side as u8));
            }
        }
        let of_two = |of: &Vec<(u32, u8)>| of.len() * of.len().saturating_sub(1) / 2;
        // Each of them makes a product of the factors at least.
        if holders.iter().map(of_two).sum::<usize>() > GROUP_FACTOR_PRODUCTS {
            return;
        }
        let mut ties = Vec::new();
        for (node, holders) in holders.iter().enumerate() {
            for (at, &(row, side)) in holders.iter().enumerate() {
                for &(other, other_side) in &holders[at + 1..] {
                    ties.push([row, other]);
                    let (rows, sides) = ([row, other], [side, other_side]);
                    self.shared.push(Shared { node: node as u32, rows, sides, entry: 0 });
                }
            }
        }
        sort_by_number(&mut ties, |&tie| joined(tie));
        ties.dedup();
        self.sparse = Sparse::plan(self.rows.len(), &ties, GROUP_FACTOR_PRODUCTS);
        match &self.sparse {
            Some(sparse) => {
                self.shared.iter_mut().for_each(|of| of.entry = sparse.entry(of.rows[0], of.rows[1]));
            }
            None => self.shared.clear(),
        }
    }
}

/// Which joints close a loop, the world included, or may do so.
fn closing(members: &[u32], holds: &[Hold], numbers: &[u32]) -> Vec<bool> {
    let mut unions = Islands::default();
    unions.part(numbers.len() + 1);
    // The world has the first place.
    let place_of = |body: u32| numbers.binary_search(&body).map_or(0, |place| place as u32 + 1);
    let ends = members.iter().map(|&at| holds[at as usize].ends.map(|end| place_of(end.body)));
    let closes_loop = ends.map(|[a, b]| {
        let is_joined = unions.find(a) == unions.find(b);
        unions.join(a, b);
        is_joined
    });
    closes_loop.collect()
}

/// The numbers that a joint keeps.
fn numbers_of(hold: &Hold) -> Vec<What> {
    let mut numbers = match hold.link {
        Link::Free | Link::Fixed => vec![],
        Link::Point => vec![What::Axis(0), What::Axis(1), What::Depth],
        Link::Weld => vec![What::Axis(0), What::Axis(1), What::Angle, What::Depth],
        Link::Angle => vec![What::Angle],
        Link::Distance => vec![What::Distance],
        Link::Line => vec![What::Across, What::Angle, What::Depth],
    };
    if let Some(drive) = hold.drive {
        numbers.extend(drive.motor().map(What::Motor));
        numbers.extend(drive.limits().map(What::Limits));
    }
    numbers
}
