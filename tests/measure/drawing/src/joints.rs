//! Writes the figures of joint scenes as text: a line for each scene and engine, and a summary.

use measure::joints::engines::OURS;
use measure::joints::judge::FAULTS;
use measure::joints::table::Figures;

/// Returns a line of text with errors, times and faults of a scene in an engine.
pub fn line(figures: &Figures) -> String {
    let Figures { scene, engine, gap_px, speed_px_per_s, is_asleep, .. } = figures;
    let Figures { us_first_step, us_first_second, us_later, faults, .. } = figures;
    let optional = |name: &str, value: Option<f64>| {
        value.map_or(String::new(), |value| format!(" {name} {}", short(value)))
    };
    format!(
        "{scene:44} {engine:9} gap {:7}{} speed {:7}{}{} us {us_first_step:.0}, {us_first_second:.1}, {us_later:.1}{} {faults}",
        short(*gap_px),
        optional("displacement", figures.displacement_px),
        short(*speed_px_per_s),
        optional("gain", figures.energy_gained),
        if *is_asleep { " asleep" } else { "" },
        optional("time", figures.part_of_faster_peer),
    )
}

/// Returns as text: the number of scenes with each fault, and the geometric mean of the ratio of our time to the faster peer's.
pub fn summary(figures: &[Figures]) -> String {
    let ours: Vec<&Figures> = figures.iter().filter(|figures| figures.engine == OURS.name).collect();
    let with = |fault| ours.iter().filter(|figures| figures.faults.contains(fault)).count();
    let counts: Vec<String> = FAULTS.iter().map(|&fault| format!("{fault} {}", with(fault))).collect();
    let faulty = ours.iter().filter(|figures| !figures.faults.is_empty()).count();
    let parts: Vec<f64> = ours.iter().filter_map(|figures| figures.part_of_faster_peer).collect();
    let time = if parts.is_empty() { String::new() } else { times(&parts) };
    format!("{} scenes, {faulty} with faults: {}{time}\n", ours.len(), counts.join(", "))
}

fn times(parts: &[f64]) -> String {
    let mean = (parts.iter().map(|part| part.ln()).sum::<f64>() / parts.len() as f64).exp();
    let slower = parts.iter().filter(|&&part| part > 1.0).count();
    format!("; time as a part of the faster peer's: {mean:.2}, more than 1 in {slower}")
}

/// Returns a number with three digits, in scientific notation if the number is small or great.
fn short(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        0.001..1e5 => format!("{value:.3}"),
        _ => format!("{value:.0e}"),
    }
}
