//! Charts, maps and reports of what the crate `measure` measures, and what the programs `accuracy_vs_speed` and
//! `stability_map` are started with.

pub mod maps;
pub mod measuring;
pub mod plane_chart;
pub mod plot;
pub mod progress;
pub mod report;
