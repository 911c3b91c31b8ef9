//! Writes advice as a table and as sentences.

use super::{Advice, Choice, Verdict};
use crate::method::Setting;
use crate::sweep::Outcome;

impl Advice {
    /// Returns the outcome of each choice as a Markdown table.
    pub fn table(&self) -> String {
        let head = "| methods | µs per simulated second | overlap | joint gap | rest speed | displacement | path error | energy | |\n\
                    |---|---|---|---|---|---|---|---|---|\n";
        let rows = self.verdicts.iter().map(|verdict| self.row(verdict));
        let absent = self.absent.iter().map(|(choice, reason)| {
            format!("| {} | | | | | | | | {reason} |\n", label_of(choice, choice.setting(&self.asked)))
        });
        head.to_owned() + &rows.chain(absent).collect::<String>()
    }

    fn row(&self, verdict: &Verdict) -> String {
        let found = &verdict.findings;
        let told = |value: Option<f64>| value.map_or("-".to_owned(), short);
        let energy = found.energy.map_or("-".to_owned(), |part| format!("{:.1} %", 100.0 * part));
        let is_best = self.recommended() == Some(verdict);
        format!(
            "| {} | {:.0} | {} | {} | {} | {} | {} | {energy} | {} |\n",
            label_of(&verdict.choice, verdict.setting),
            verdict.microseconds_per_simulated_second,
            short(found.overlap),
            short(found.gap),
            told(found.unrest),
            told(found.displacement),
            told(found.stray),
            if is_best { "**take this**".to_owned() } else { self.judgement(verdict) }
        )
    }

    /// Returns the judgement of a choice in a few words: exact enough, or the worst error.
    fn judgement(&self, verdict: &Verdict) -> String {
        let (what, worst) = verdict.findings.worst(&self.asked);
        match verdict.outcome {
            Outcome::Failed(reason) if verdict.findings.fallen > 0 => {
                format!("{reason}: {} of {} leave their place", verdict.findings.fallen, self.resting)
            }
            Outcome::Failed(reason) => reason.to_owned(),
            Outcome::Fine if worst <= 1.0 => "exact enough".to_owned(),
            Outcome::Fine => format!("{what}: {} times the tolerance", short(worst)),
        }
    }

    /// Returns a sentence that names the recommended choice and the reason.
    pub fn sentence(&self) -> String {
        let Some(best) = self.recommended() else { return self.regret() };
        let time = |verdict: &Verdict| verdict.microseconds_per_simulated_second;
        let name = |verdict: &Verdict| label_of(&verdict.choice, verdict.setting);
        let is_refused = |other: &&Verdict| time(other) < time(best) && !other.is_exact_enough(&self.asked);
        let cheaper = self.verdicts.iter().filter(is_refused);
        let refused: Vec<String> =
            cheaper.map(|other| format!("{} ({})", name(other), self.judgement(other))).collect();
        let why = if refused.is_empty() {
            "nothing that is exact enough takes clearly less".to_owned()
        } else {
            format!("cheaper choices are not exact enough: {}", refused.join("; "))
        };
        let (what, worst) = best.findings.worst(&self.asked);
        format!(
            "Take {}: {:.0} µs for each simulated second, and its greatest error, {what}, is {} of the tolerance; {why}.",
            name(best),
            time(best),
            short(worst)
        )
    }

    fn regret(&self) -> String {
        let fine = self.verdicts.iter().filter(|verdict| verdict.outcome == Outcome::Fine);
        let worst = |verdict: &Verdict| verdict.findings.worst(&self.asked);
        match fine.min_by(|a, b| worst(a).1.total_cmp(&worst(b).1)) {
            Some(least) => format!(
                "Nothing is exact enough; the smallest error is that of {}: {}.",
                label_of(&least.choice, least.setting),
                self.judgement(least)
            ),
            None => "Nothing is exact enough: everything fails.".to_owned(),
        }
    }

    /// Returns notes on how the figures of the advice were measured.
    pub fn notes(&self) -> String {
        let Advice { asked, movable, resting, predictable, .. } = self;
        format!(
            "{:.2} s in steps of {} s; {resting} of {movable} bodies come to rest in predictable positions, and paths are \
             predictable for {predictable:.2} s. Exact enough: overlap and joint gap {tolerance}, rest speed {} per s, displacement and path \
             error {}, energy 10 %.",
            asked.seconds,
            Setting::fixed(asked.dt, 1).dt.label(),
            short(5.0 * asked.tolerance),
            short(8.0 * asked.tolerance),
            tolerance = short(asked.tolerance),
        )
    }
}

/// Returns the name of a choice, with its setting, for readers.
fn label_of(choice: &Choice, setting: Setting) -> String {
    format!("{}, {}", choice.name, setting.label())
}

/// Returns a number as text with up to three significant digits.
fn short(value: f64) -> String {
    match value.abs() {
        size if size >= 100.0 => format!("{value:.0}"),
        size if size >= 10.0 => format!("{value:.1}"),
        size if size >= 1.0 => format!("{value:.2}"),
        size if size >= 0.001 => format!("{value:.3}"),
        0.0 => "0".to_owned(),
        _ => "< 0.001".to_owned(),
    }
}
