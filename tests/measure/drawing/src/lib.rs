//! Charts, maps and reports of what the crate `measure` measures, and what the programs `accuracy_vs_speed`,
//! `stability_map` and `sleep_beside_peers` are started with.

pub mod joints;
pub mod maps;
pub mod measuring;
pub mod plane_chart;
pub mod plot;
pub mod progress;
pub mod report;
pub mod sleeping;
