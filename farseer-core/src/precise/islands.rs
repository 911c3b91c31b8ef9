//! Islands: which bodies are connected by contacts, joints and springs. Disjoint sets with path halving (R. Tarjan and
//! J. van Leeuwen, "Worst-case analysis of set union algorithms", 1984).

use crate::storage::reusing_clone::reusing_clone;

/// Sets of numbers that are joined; each goes by the least number in it, so that nothing depends on the order of joining.
#[derive(Debug, Default)]
pub(super) struct Islands {
    /// A lesser number of the same set, or the number itself.
    above: Vec<u32>,
}

reusing_clone! { Islands { above } }

impl Islands {
    /// Each number below this one for itself.
    pub(super) fn part(&mut self, count: usize) {
        self.above.clear();
        self.above.extend(0..count as u32);
    }

    /// The least number of the set.
    pub(super) fn find(&mut self, number: u32) -> u32 {
        let mut at = number;
        while self.above[at as usize] != at {
            // Paths are halved on the way.
            let next = self.above[self.above[at as usize] as usize];
            self.above[at as usize] = next;
            at = next;
        }
        at
    }

    pub(super) fn join(&mut self, one: u32, other: u32) {
        let (one, other) = (self.find(one), self.find(other));
        let (less, more) = if one < other { (one, other) } else { (other, one) };
        self.above[more as usize] = less;
    }
}

#[cfg(test)]
mod tests {
    use super::Islands;

    #[test]
    fn an_island_goes_by_its_least_number_in_whatever_order_it_was_joined() {
        let links = [[1, 2], [2, 7], [5, 6], [7, 5], [3, 4]];
        for first in 0..links.len() {
            let mut islands = Islands::default();
            islands.part(8);
            links.iter().cycle().skip(first).take(links.len()).for_each(|&[a, b]| islands.join(a, b));
            assert_eq!([0, 1, 2, 3, 4, 5, 6, 7].map(|at| islands.find(at)), [0, 1, 1, 3, 3, 1, 1, 1]);
        }
    }
}
