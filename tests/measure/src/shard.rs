//! A sweep that is divided among machines: each machine runs one shard of the trials and writes its results.

use std::fmt;
use std::str::FromStr;

/// One part (shard) of a sweep that is divided into `of` parts of about equal cost, by its `number` from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    number: usize,
    of: usize,
}

impl Shard {
    /// The only shard of an undivided sweep.
    pub const WHOLE: Shard = Shard { number: 1, of: 1 };

    /// Returns for each piece of work whether it belongs to this shard; `costs` are the estimated costs of all pieces, in
    /// any unit. Every piece belongs to exactly one shard. Pieces are assigned in order of decreasing cost, each to the
    /// shard with the least total cost so far.
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

    /// Parses a shard from text: `3/16` is number 3 of 16.
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
    /// Writes the shard as a part of a file name: `3-of-16`.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}-of-{}", self.number, self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_trial_is_in_exactly_one_shard() {
        let costs: Vec<f64> = (0..100).map(|index| f64::from(index * 7 % 13)).collect();
        for of in 1..=20 {
            let picks: Vec<_> = (1..=of).map(|number| Shard { number, of }.picks(&costs)).collect();
            for piece in 0..costs.len() {
                assert_eq!(picks.iter().filter(|picks| picks[piece]).count(), 1, "{piece} of {of} parts");
            }
        }
    }

    #[test]
    fn shards_cost_about_the_same() {
        let costs: Vec<f64> = (0..100).map(|index| f64::from(1 + index % 9)).collect();
        let cost = |number| {
            let picks = Shard { number, of: 7 }.picks(&costs);
            costs.iter().zip(picks).filter(|(_, is_picked)| *is_picked).map(|(cost, _)| cost).sum::<f64>()
        };
        let parts: Vec<f64> = (1..=7).map(cost).collect();
        let (least, most) =
            parts.iter().fold((f64::MAX, 0.0_f64), |(a, b), &cost| (a.min(cost), b.max(cost)));
        // Shards differ by at most the cost of the most expensive piece, which is 9.
        assert!(most - least <= 9.0, "{parts:?}");
    }

    #[test]
    fn a_shard_is_parsed_from_the_command_line() {
        assert_eq!("3/16".parse(), Ok(Shard { number: 3, of: 16 }));
        for wrong in ["0/4", "5/4", "3", "3/0", "a/b", "-1/4", ""] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
