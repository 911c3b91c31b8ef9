//! Ordering and symbolic factorisation of a sparse symmetric matrix: planned once per graph.
//!
//! The order is that of least degree, ties by number: ropes and trees have no fill-in, and the work is linear in their
//! size. Minimum degree ordering: W. Tinney and J. Walker, "Direct solutions of sparse network equations by optimally ordered
//! triangular factorization" (1967); symbolic before numeric factorisation: T. Davis, "Direct Methods for Sparse Linear
//! Systems" (2006).

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::Range;

use crate::storage::reusing_clone::reusing_clone;

/// The plan. Rows and columns go by their place in the order of elimination.
#[derive(Debug, Default)]
pub(super) struct Elimination {
    /// By row its place in the order, and the other way round.
    pub(super) places: Vec<u32>,
    pub(super) order: Vec<u32>,
    /// By place where its column begins; of each entry below the diagonal the place of its row.
    starts: Vec<u32>,
    pub(super) rows: Vec<u32>,
    /// Where each product of two entries of one column goes.
    pub(super) targets: Vec<u32>,
}

reusing_clone! { Elimination { places, order, starts, rows, targets } }

impl Elimination {
    /// Plans for so many rows, of which these are tied to each other: each pair once and the lesser number first, in order.
    /// Answers whether all columns together cost no more than `most`, given what one of so many entries does.
    pub(super) fn plan(
        &mut self,
        count: usize,
        edges: &[[u32; 2]],
        cost: fn(usize) -> usize,
        most: usize,
    ) -> bool {
        self.order.clear();
        self.places.clear();
        self.places.resize(count, u32::MAX);
        let Some(columns) = self.eliminate(edges, cost, most) else {
            self.places.clear();
            return false;
        };
        self.lay_out(&columns);
        true
    }

    /// The rows that each one is tied to when it is eliminated, in the order of elimination.
    fn eliminate(
        &mut self,
        edges: &[[u32; 2]],
        cost: fn(usize) -> usize,
        most: usize,
    ) -> Option<Vec<Vec<u32>>> {
        let mut partners = vec![Vec::new(); self.places.len()];
        for &[a, b] in edges {
            partners[a as usize].push(b);
            partners[b as usize].push(a);
        }
        let mut heap: BinaryHeap<_> =
            partners.iter().enumerate().map(|(row, of)| Reverse((of.len(), row))).collect();
        let (mut columns, mut costs, mut merged) = (Vec::with_capacity(partners.len()), 0, Vec::new());
        while let Some(Reverse((degree, row))) = heap.pop() {
            if self.places[row] != u32::MAX || degree != partners[row].len() {
                continue;
            }
            costs += cost(degree);
            if costs > most {
                return None;
            }
            self.places[row] = self.order.len() as u32;
            self.order.push(row as u32);
            let column = std::mem::take(&mut partners[row]);
            if self.order.len() + degree == partners.len() {
                // All that are left are tied to each other, and follow by their numbers.
                for &last in &column {
                    self.places[last as usize] = self.order.len() as u32;
                    self.order.push(last);
                }
                costs += (0..degree).map(cost).sum::<usize>();
                columns.extend((0..=degree).map(|after| column[after..].to_vec()));
                break;
            }
            for &partner in &column {
                let of_partner = &mut partners[partner as usize];
                merge(of_partner, &column, [row as u32, partner], &mut merged);
                std::mem::swap(of_partner, &mut merged);
                heap.push(Reverse((of_partner.len(), partner as usize)));
            }
            columns.push(column);
        }
        (costs <= most).then_some(columns)
    }

    fn lay_out(&mut self, columns: &[Vec<u32>]) {
        self.starts.clear();
        self.rows.clear();
        self.starts.push(0);
        for column in columns {
            let start = self.rows.len();
            self.rows.extend(column.iter().map(|&row| self.places[row as usize]));
            self.rows[start..].sort_unstable();
            self.starts.push(self.rows.len() as u32);
        }
        self.targets.clear();
        for place in 0..columns.len() {
            self.aim(self.column(place));
        }
    }

    /// Where the products of a column's entries go: a pair of them goes to the column of the first, at the row of the second. A column
    /// has the rows of all that are eliminated from it, so one walk down it finds them in order.
    fn aim(&mut self, column: Range<usize>) {
        let first = self.targets.len();
        let Elimination { starts, rows, targets, .. } = self;
        let of_column = &rows[column];
        targets.resize(first + of_column.len() * of_column.len().saturating_sub(1) / 2, 0);
        for (above, &place) in of_column.iter().enumerate() {
            let mut entry = starts[place as usize];
            for (at, &row) in of_column.iter().enumerate().skip(above + 1) {
                while rows[entry as usize] != row {
                    entry += 1;
                }
                targets[first + at * (at - 1) / 2 + above] = entry;
            }
        }
    }

    /// The greatest number of entries of a column.
    pub(super) fn longest(&self) -> usize {
        (0..self.order.len()).map(|place| self.column(place).len()).max().unwrap_or(0)
    }

    #[inline(always)]
    pub(super) fn column(&self, place: usize) -> Range<usize> {
        self.starts[place] as usize..self.starts[place + 1] as usize
    }

    /// The entry of a column at this row, which the plan has.
    fn find(&self, column: u32, row: u32) -> u32 {
        let range = self.column(column as usize);
        (range.start + self.rows[range].partition_point(|&other| other < row)) as u32
    }

    /// Where the entry of two rows is that are tied, and whether the first one is eliminated after the second.
    pub(super) fn entry(&self, a: u32, b: u32) -> (u32, bool) {
        let (a, b) = (self.places[a as usize], self.places[b as usize]);
        (self.find(a.min(b), a.max(b)), b < a)
    }
}

/// Both sorted lists as one, without duplicates and without these two.
fn merge(one: &[u32], other: &[u32], without: [u32; 2], merged: &mut Vec<u32>) {
    merged.clear();
    merged.reserve(one.len() + other.len());
    let (mut at_one, mut at_other) = (0, 0);
    while let (Some(&a), Some(&b)) = (one.get(at_one), other.get(at_other)) {
        let least = a.min(b);
        at_one += usize::from(a == least);
        at_other += usize::from(b == least);
        if !without.contains(&least) {
            merged.push(least);
        }
    }
    let rest = one[at_one..].iter().chain(&other[at_other..]);
    merged.extend(rest.copied().filter(|last| !without.contains(last)));
}
