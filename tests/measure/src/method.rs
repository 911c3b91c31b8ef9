//! The ways to simulate: the lines of a chart, the columns of a map.

use super::world::World;
#[cfg(feature = "peers")]
use crate::engines::peers_2d::{box2d_methods, rapier_methods};
use crate::engines::plane::our_methods;
use conformance::scene::Scene;

/// Whose engine it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Family {
    /// Of this workspace.
    Ours,
    /// Another project's.
    Peer,
}

/// How much is tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Effort {
    /// A few settings and sizes: minutes.
    Quick,
    /// All of them.
    Full,
}

/// The time step of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Dt {
    /// Always the same, in s.
    Fixed(f32),
    /// A fixed pseudo-random sequence between half and one and a half of a mean in s.
    Jitter {
        /// The mean.
        mean: f32,
    },
}

impl Dt {
    /// The steps in s, without end. The same whenever it is asked.
    pub fn steps(self) -> impl Iterator<Item = f32> {
        (0_u64..).map(move |index| match self {
            Dt::Fixed(dt) => dt,
            Dt::Jitter { mean } => mean * (0.5 + unit(index)),
        })
    }

    /// The mean step in s.
    pub fn mean(self) -> f32 {
        match self {
            Dt::Fixed(dt) => dt,
            Dt::Jitter { mean } => mean,
        }
    }

    /// What a reader calls it: `1/60`, `0.016`, `jitter 1/60`.
    pub fn label(self) -> String {
        let dt = self.mean();
        let rate = (1.0 / dt).round();
        let is_common = dt == 1.0 / rate && rate != 100.0;
        let label = if is_common { format!("1/{rate}") } else { format!("{dt}") };
        if let Dt::Jitter { .. } = self { format!("jitter {label}") } else { label }
    }
}

/// A number from 0 up to 1 that looks random: the finishing steps of the generator SplitMix64.
pub(crate) fn unit(index: u64) -> f32 {
    let mut bits = (index + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^= bits >> 31;
    // As many bits as a float holds without rounding up to 1.
    (bits >> 40) as f32 / (1_u64 << 24) as f32
}

/// One point of a line: the step and how hard the solver works in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    /// The time step.
    pub dt: Dt,
    /// Per step: iterations of our solvers, short steps within the step of the peers.
    pub passes: u32,
}

impl Setting {
    /// A setting with a fixed step in s.
    pub const fn fixed(dt: f32, passes: u32) -> Self {
        Setting { dt: Dt::Fixed(dt), passes }
    }

    /// A setting with a jittering step, its mean in s.
    pub const fn jitter(mean: f32, passes: u32) -> Self {
        Setting { dt: Dt::Jitter { mean }, passes }
    }

    /// What a reader calls it: `1/60 s x 5`.
    pub fn label(self) -> String {
        format!("{} s x {}", self.dt.label(), self.passes)
    }
}

/// A scene in an engine, or what of it the engine does not have.
pub type Built = Result<Box<dyn World>, String>;

/// A setting that a map has a column for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mapped {
    /// The setting.
    pub setting: Setting,
    /// Whether it is among the few that the table of first failures shows.
    pub is_in_table: bool,
}

/// A way to simulate: one line of a chart, some columns of a map. Scenes are those in the plane unless it says otherwise.
pub struct Method<S = Scene> {
    /// Such as "Farseer, distance grid".
    pub name: &'static str,
    /// Whose engine it is.
    pub family: Family,
    /// Whether it differs from another method in the broad phase alone: left out where that does not matter.
    pub is_broad_phase_variant: bool,
    /// Whether what has come to rest sleeps in it, once that is [asked for](World::set_sleep_enabled).
    pub sleeps: bool,
    /// What the engine's authors recommend or take by default, at the usual step.
    pub recommended: Setting,
    /// The points of its line. [`recommended`](Self::recommended) is one of them.
    pub settings: fn(Effort) -> Vec<Setting>,
    /// Its columns on a map.
    pub mapped: fn(Effort) -> Vec<Mapped>,
    /// Puts a scene into the engine. An error says what of the scene the engine does not have.
    pub build: fn(&S, Setting) -> Built,
}

copied!(Method);

/// Columns of some settings, of which some are in the table of first failures.
pub(crate) fn mapped(settings: impl IntoIterator<Item = Setting>, in_table: &[Setting]) -> Vec<Mapped> {
    let mapped = |setting| Mapped { setting, is_in_table: in_table.contains(&setting) };
    settings.into_iter().map(mapped).collect()
}

/// All methods: the one place to add one.
pub fn methods() -> Vec<Method> {
    #[allow(unused_mut)]
    let mut methods = our_methods();
    #[cfg(feature = "peers")]
    {
        methods.extend(rapier_methods());
        methods.extend(box2d_methods());
    }
    methods
}

/// Names and versions of the other engines among them, and of what they are reached through.
pub fn peer_versions() -> Vec<(&'static str, String)> {
    #[cfg(feature = "peers")]
    return crate::engines::peers_2d::peer_versions();
    #[cfg(not(feature = "peers"))]
    Vec::new()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jittering_step_stays_between_half_and_one_and_a_half_of_its_mean() {
        let mean = 0.016;
        let steps: Vec<f32> = Dt::Jitter { mean }.steps().take(10_000).collect();
        assert!(steps.iter().all(|dt| (0.5 * mean..=1.5 * mean).contains(dt)));
        // The standard deviation of the mean of 10,000 is 0.3 % of the mean; this is more than three of them.
        let total: f32 = steps.iter().sum();
        assert!((total / 10_000.0 / mean - 1.0).abs() < 0.01);
    }

    #[test]
    fn steps_are_called_by_their_rate_where_games_do() {
        let labels =
            [Dt::Fixed(1.0 / 60.0), Dt::Fixed(0.016), Dt::Fixed(0.01), Dt::Jitter { mean: 1.0 / 60.0 }];
        assert_eq!(labels.map(Dt::label), ["1/60", "0.016", "0.01", "jitter 1/60"]);
    }

    #[test]
    fn what_is_recommended_is_among_the_settings_and_names_differ() {
        let methods = methods();
        for (index, method) in methods.iter().enumerate() {
            for effort in [Effort::Quick, Effort::Full] {
                assert!((method.settings)(effort).contains(&method.recommended), "{}", method.name);
            }
            assert!(methods[..index].iter().all(|other| other.name != method.name), "{}", method.name);
        }
    }
}
