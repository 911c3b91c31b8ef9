//! Features that a scene needs beyond bodies and geoms.

use std::fmt;
use std::str::FromStr;

/// A part of the engine that a scene may need.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Feature {
    /// Joints.
    Joints,
    /// Springs.
    Springs,
    /// Controllers, among them fluids, waves and the scaling of the time step.
    Controllers,
    /// Chains and tracks of the complex factory.
    Paths,
}

impl Feature {
    /// Every feature, in the order they are listed in.
    pub const ALL: [Feature; 4] = [Feature::Joints, Feature::Springs, Feature::Controllers, Feature::Paths];

    /// The word for it on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Feature::Joints => "joints",
            Feature::Springs => "springs",
            Feature::Controllers => "controllers",
            Feature::Paths => "paths",
        }
    }
}

impl FromStr for Feature {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        Feature::ALL
            .into_iter()
            .find(|feature| feature.name() == word)
            .ok_or_else(|| format!("`{word}` is none of {}", Features::of(&Feature::ALL)))
    }
}

/// A set of features.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Features([bool; Feature::ALL.len()]);

impl Features {
    /// The set of the features in a list.
    pub fn of(features: &[Feature]) -> Self {
        let mut set = Features::default();
        features.iter().for_each(|&feature| set.insert(feature));
        set
    }

    /// Puts a feature into the set.
    pub fn insert(&mut self, feature: Feature) {
        self.0[feature as usize] = true;
    }

    /// Whether a feature is in the set.
    pub fn contains(self, feature: Feature) -> bool {
        self.0[feature as usize]
    }

    /// The features in the set, in their order.
    pub fn iter(self) -> impl Iterator<Item = Feature> {
        Feature::ALL.into_iter().filter(move |&feature| self.contains(feature))
    }

    /// Whether the set is empty.
    pub fn is_empty(self) -> bool {
        self == Features::default()
    }

    /// The features that are in this set and not in the other.
    pub fn without(self, other: Features) -> Features {
        let mut set = self;
        other.iter().for_each(|feature| set.0[feature as usize] = false);
        set
    }

    /// The features that are in both sets.
    pub fn and(self, other: Features) -> Features {
        self.without(Features::of(&Feature::ALL).without(other))
    }
}

impl fmt::Display for Features {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.iter().map(Feature::name).collect::<Vec<_>>().join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn features_are_named_in_their_own_order() {
        assert_eq!(Features::of(&[Feature::Paths, Feature::Joints]).to_string(), "joints, paths");
    }

    #[test]
    fn sets_can_be_cut_and_subtracted() {
        let all = Features::of(&Feature::ALL);
        let springs = Features::of(&[Feature::Springs]);
        assert_eq!(all.and(springs), springs);
        assert!(!all.without(springs).contains(Feature::Springs));
        assert!(springs.without(all).is_empty());
    }

    #[test]
    fn an_unknown_feature_is_refused_with_the_known_ones() {
        let message = "ropes".parse::<Feature>().unwrap_err();
        assert_eq!(message, "`ropes` is none of joints, springs, controllers, paths");
    }
}
