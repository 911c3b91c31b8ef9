//! Speed against accuracy, and where methods fail: what the programs `accuracy_vs_speed` and `stability_map` measure, and
//! what the tests pin of it. Draws nothing: that is for the crate `drawing`.
//!
//! A way to simulate is an entry of [`method::methods`]. A scene of a chart is an entry of [`charts::chart_scenes`]: [`trials`]
//! says with which settings it is run, [`sweep`] runs all against each other, [`csv`] writes down what came of it. What is
//! driven until it fails is an entry of [`stability::families`], with maps of its own. [`depth`] has all that for the 2.5D
//! engine, [`joints`] has scenes of joints beside the peers. Lengths are px, in the plane y points down, times are s, angles rad; where an engine needs metres, 32 px are one.

/// Makes what is generic over scenes but holds none `Copy`, and shows its name: what is derived would ask for scenes that can
/// be copied.
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
