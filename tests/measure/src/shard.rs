//! A sweep spread over machines: each makes a part of it, and writes down what came of that.

use std::fmt;
use std::str::FromStr;

/// One of several parts of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    number: usize,
    of: usize,
}

impl Shard {
    /// The whole sweep.
    pub const WHOLE: Shard = Shard { number: 1, of: 1 };

    /// Whether each piece of work is in this part, by what each costs: every piece is in one part, and parts cost about the
    /// same. The dearest piece that is left goes to the part that costs least so far.
    pub fn picks(self, costs: &[f64]) -> Vec<bool> {
        let mut dearest: Vec<usize> = (0..costs.len()).collect();
        dearest.sort_by(|&a, &b| costs[b].total_cmp(&costs[a]));
        let (mut parts, mut picks) = (vec![0.0_f64; self.of], vec![false; costs.len()]);
        for piece in dearest {
            let cheapest = (0..self.of).min_by(|&a, &b| parts[a].total_cmp(&parts[b])).unwrap_or(0);
            parts[cheapest] += costs[piece];
            picks[piece] = cheapest + 1 == self.number;
        }
        picks
    }
}

impl FromStr for Shard {
    type Err = String;

    /// From `3/16`.
    fn from_str(text: &str) -> Result<Self, String> {
        let numbers =
            text.split_once('/').and_then(|(number, of)| Some((number.parse().ok()?, of.parse().ok()?)));
        match numbers {
            Some((number, of)) if (1..=of).contains(&number) => Ok(Shard { number, of }),
            _ => Err("a part is given like 3/16, from 1/16 to 16/16".to_owned()),
        }
    }
}

impl fmt::Display for Shard {
    /// As it is in names of files: `3-of-16`.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}-of-{}", self.number, self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_piece_is_in_one_part() {
        let costs: Vec<f64> = (0..100).map(|index| f64::from(index * 7 % 13)).collect();
        for of in 1..=20 {
            let picks: Vec<_> = (1..=of).map(|number| Shard { number, of }.picks(&costs)).collect();
            for piece in 0..costs.len() {
                assert_eq!(picks.iter().filter(|picks| picks[piece]).count(), 1, "{piece} of {of} parts");
            }
        }
    }

    #[test]
    fn parts_cost_about_the_same() {
        let costs: Vec<f64> = (0..100).map(|index| f64::from(1 + index % 9)).collect();
        let cost = |number| {
            let picks = Shard { number, of: 7 }.picks(&costs);
            costs.iter().zip(picks).filter(|(_, is_picked)| *is_picked).map(|(cost, _)| cost).sum::<f64>()
        };
        let parts: Vec<f64> = (1..=7).map(cost).collect();
        let (least, most) =
            parts.iter().fold((f64::MAX, 0.0_f64), |(a, b), &cost| (a.min(cost), b.max(cost)));
        // What was given last weighs no more than the cheapest piece that was left.
        assert!(most - least <= 9.0, "{parts:?}");
    }

    #[test]
    fn a_part_is_read_as_it_is_written_on_the_command_line() {
        assert_eq!("3/16".parse(), Ok(Shard { number: 3, of: 16 }));
        for wrong in ["0/4", "5/4", "3", "3/0", "a/b", "-1/4", ""] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
