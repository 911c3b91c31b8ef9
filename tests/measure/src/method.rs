//! Methods that are compared: an engine with its options. A method is a line of a chart and one or more columns of a map.

use super::world::World;
#[cfg(feature = "peers")]
use crate::engines::peers_2d::{box2d_methods, rapier_methods};
use crate::engines::plane::our_methods;
use conformance::scene::Scene;

/// Origin of an engine: this workspace or another project.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Family {
    /// An engine of this workspace.
    Ours,
    /// An engine of another project.
    Peer,
}

/// Extent of a measurement: how many settings and sizes are run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Effort {
    /// Runs a few settings and sizes; takes minutes.
    Quick,
    /// Runs all settings and sizes.
    Full,
}

/// Time step of a run: constant or jittering.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Dt {
    /// Constant time step in s.
    Fixed(f32),
    /// Time steps that vary pseudo-randomly between 0.5 and 1.5 times `mean`, in the same sequence in every run.
    Jitter {
        /// Mean time step in s.
        mean: f32,
    },
}

impl Dt {
    /// Returns the time steps in s as an endless sequence, which is the same at every call.
    pub fn steps(self) -> impl Iterator<Item = f32> {
        (0_u64..).map(move |index| match self {
            Dt::Fixed(dt) => dt,
            Dt::Jitter { mean } => mean * (0.5 + unit(index)),
        })
    }

    /// Returns the mean time step in s.
    pub fn mean(self) -> f32 {
        match self {
            Dt::Fixed(dt) => dt,
            Dt::Jitter { mean } => mean,
        }
    }

    /// Returns a label of the time step for readers: `1/60`, `0.016`, `jitter 1/60`.
    pub fn label(self) -> String {
        let dt = self.mean();
        let rate = (1.0 / dt).round();
        let is_common = dt == 1.0 / rate && rate != 100.0;
        let label = if is_common { format!("1/{rate}") } else { format!("{dt}") };
        if let Dt::Jitter { .. } = self { format!("jitter {label}") } else { label }
    }
}

/// Returns a pseudo-random number in 0..1 that depends on `index` alone, by the finishing steps of the generator SplitMix64.
pub(crate) fn unit(index: u64) -> f32 {
    let mut bits = (index + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^= bits >> 31;
    // 24 bits: a float holds them exactly, so that the result is never rounded up to 1.
    (bits >> 40) as f32 / (1_u64 << 24) as f32
}

/// Time step and solver effort of a run: one point on the line of a method in a chart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    /// Time step in s, fixed or jittering.
    pub dt: Dt,
    /// Number of solver iterations (our engines) or substeps (other engines) per time step.
    pub passes: u32,
}

impl Setting {
    /// Returns a setting with a fixed time step of `dt` s and `passes` iterations or substeps.
    pub const fn fixed(dt: f32, passes: u32) -> Self {
        Setting { dt: Dt::Fixed(dt), passes }
    }

    /// Returns a setting with jittering time steps of mean `mean` s, and `passes` iterations or substeps per step.
    pub const fn jitter(mean: f32, passes: u32) -> Self {
        Setting { dt: Dt::Jitter { mean }, passes }
    }

    /// Returns a label of time step and effort for readers: `1/60 s x 5`.
    pub fn label(self) -> String {
        format!("{} s x {}", self.dt.label(), self.passes)
    }
}

/// World of a scene in an engine; the error names a feature of the scene that the engine lacks.
pub type Built = Result<Box<dyn World>, String>;

/// A setting that is a column of a stability map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mapped {
    /// Time step, and iterations or substeps per step.
    pub setting: Setting,
    /// Whether the column also appears in the short table of first failures.
    pub is_in_table: bool,
}

/// A method of simulation: one line of a chart, and one or more columns of a map. `S` is the type of its scenes; by default
/// these are scenes in the plane.
pub struct Method<S = Scene> {
    /// Name of the method, such as "Farseer, distance grid".
    pub name: &'static str,
    /// Origin of the method's engine: this workspace or another project.
    pub family: Family,
    /// Whether the method differs from another one in the broad phase alone. Scenes in which the broad phase does not matter
    /// omit it.
    pub is_broad_phase_variant: bool,
    /// Whether bodies at rest fall asleep, once sleep is [enabled](World::set_sleep_enabled).
    pub sleeps: bool,
    /// Setting that the engine's authors recommend or use by default, at the usual time step.
    pub recommended: Setting,
    /// Returns the settings with which charts run the method. [`recommended`](Self::recommended) is one of them.
    pub settings: fn(Effort) -> Vec<Setting>,
    /// Returns the settings with which stability maps run the method: one column of a map for each.
    pub mapped: fn(Effort) -> Vec<Mapped>,
    /// Builds a scene in the engine with a setting. The error names a feature of the scene that the engine lacks.
    pub build: fn(&S, Setting) -> Built,
}

copied!(Method);

/// Returns a map column for each of `settings`. Settings that are also in `in_table` appear in the table of first failures.
pub(crate) fn mapped(settings: impl IntoIterator<Item = Setting>, in_table: &[Setting]) -> Vec<Mapped> {
    let mapped = |setting| Mapped { setting, is_in_table: in_table.contains(&setting) };
    settings.into_iter().map(mapped).collect()
}

/// Returns all methods in the order of charts and maps. New methods are added here.
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

/// Returns names and versions of the other engines and of the crates that bind them; empty without the feature `peers`.
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
    fn recommended_settings_are_in_the_list_and_names_are_unique() {
        let methods = methods();
        for (index, method) in methods.iter().enumerate() {
            for effort in [Effort::Quick, Effort::Full] {
                assert!((method.settings)(effort).contains(&method.recommended), "{}", method.name);
            }
            assert!(methods[..index].iter().all(|other| other.name != method.name), "{}", method.name);
        }
    }
}
