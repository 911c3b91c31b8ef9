//! Draws charts and maps and writes reports of the measurements of the crate `measure`. Has the command-line options that the
//! programs `accuracy_vs_speed`, `stability_map` and `sleep_beside_peers` share.

pub mod arena;
pub mod joints;
pub mod maps;
pub mod measuring;
pub mod plane_chart;
pub mod plot;
pub mod progress;
pub mod report;
pub mod sleeping;
