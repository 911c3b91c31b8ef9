//! Speed against accuracy, and limits of methods: the measurements of the programs `accuracy_vs_speed` and `stability_map`, and
//! of the tests that pin them. Drawing is in the crate `drawing`.
//!
//! - A method is an entry of [`method::methods`].
//! - A scene of a chart is an entry of [`charts::chart_scenes`]. [`trials`] lists the settings of its runs, [`sweep`] runs
//!   all trials against each other, [`csv`] writes the results.
//! - A scene that gets harder until methods fail is an entry of [`stability::families`]. Its results are drawn as a map.
//! - [`depth`] contains charts and maps for the 2.5D engine, [`joints`] compares scenes of joints with other engines.
//!
//! Lengths are px, times s, angles rad; y points down in scenes in the plane. In engines that need metres, 32 px are one
//! metre.

/// Implements `Copy` and `Debug` for types that are generic over scenes but hold none. `derive` would require that the
/// scene type is `Copy`.
macro_rules! copied {
    ($name:ident) => {
        impl<S> Clone for $name<S> {
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<S> Copy for $name<S> {}

        impl<S> std::fmt::Debug for $name<S> {
            fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.debug_struct(stringify!($name)).field("name", &self.name).finish_non_exhaustive()
            }
        }
    };
}

pub mod advise;
pub mod arena;
pub mod charts;
pub mod closed_forms;
pub mod csv;
pub mod depth;
pub mod engines;
pub mod joints;
pub mod method;
pub mod origin;
pub mod penetration;
pub mod scenes;
pub mod sensitivity;
pub mod shard;
pub mod sleep;
pub mod stability;
pub mod stopwatch;
pub mod sweep;
pub mod trials;
pub mod watch;
pub mod world;
