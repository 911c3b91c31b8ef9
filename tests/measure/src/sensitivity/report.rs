//! Report of the effects of changed parameters, for readers.

use super::differences::Figures;
use std::fmt::Write;

/// Greatest factor on a parameter that is a small change, dimensionless: factors from 1/1.2 to 1.2 are small changes.
const NEAR: f64 = 1.2;

/// Title and explanation of the classes of parameters in the report. A parameter belongs to the first class that applies;
/// the most sensitive parameters come first.
const CLASSES: [(&str, &str); 5] = [
    ("A verdict flips within 20 %", "Such a number is tuned to a scene: a fault of the method."),
    (
        "A verdict flips at half or twice",
        "A row passes a tolerance, a family fails at another size, a scene falls asleep or not.",
    ),
    ("Values change by a fifth or more", "No verdict flips."),
    (
        "No change from half to twice",
        "Values differ by less than a fifth, or are below their floors: any value in that range suffices.",
    ),
    (
        "No row depends on it",
        "No row differs in any digit: no scene here needs the number, or any value in that range is the same.",
    ),
];

/// Returns the report: a table of parameters for each class.
pub fn report(all: &[Figures]) -> String {
    let mut text = "# Changes by numbers\n".to_owned();
    let numbers: Vec<&[Figures]> = all.chunk_by(|one, other| one.parameter == other.parameter).collect();
    for (class, (title, about)) in CLASSES.iter().enumerate() {
        let members: Vec<_> = numbers.iter().filter(|number| class_of(number) == class).collect();
        let _ = write!(text, "\n## {title}: {} of {}\n\n{about}\n\n", members.len(), numbers.len());
        if members.is_empty() {
            continue;
        }
        text += "| number | value | unit | times | rows | flips | most | from | to |\n|---|---|---|---|---:|---:|---|---|---|\n";
        for figures in members.into_iter().flat_map(|number| number.iter()) {
            let Figures { parameter, value, unit, factor, flips, worst_row, before, after, .. } = figures;
            let _ = writeln!(
                text,
                "| `{parameter}` | {value} | {unit} | {factor:.2} | {} | {flips} | {worst_row} | {before} | {after} |",
                figures.rows()
            );
        }
    }
    text
}

fn class_of(number: &[Figures]) -> usize {
    let is_near = |one: &Figures| (NEAR.recip() - 1e-3..=NEAR + 1e-3).contains(&one.factor);
    let flips = |near: bool| number.iter().any(|one| one.flips > 0 && (!near || is_near(one)));
    match () {
        () if flips(true) => 0,
        () if flips(false) => 1,
        () if number.iter().any(|one| one.rows() > 0) => 2,
        () if number.iter().any(|one| one.touched > 0) => 3,
        () => 4,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_are_listed_by_their_effect() {
        let figures = |parameter: &str, factor, chart, flips| Figures {
            parameter: parameter.into(),
            factor,
            chart,
            flips,
            ..Figures::default()
        };
        let class = |all: &[Figures]| class_of(all);
        assert_eq!(class(&[figures("a", 0.5, 1, 1), figures("a", 1.2, 1, 1)]), 0);
        assert_eq!(class(&[figures("a", 0.5, 1, 1), figures("a", 1.2, 1, 0)]), 1);
        assert_eq!(class(&[figures("a", 0.5, 1, 0), figures("a", 2.0, 0, 0)]), 2);
        assert_eq!(class(&[Figures { touched: 1, ..figures("a", 0.5, 0, 0) }]), 3);
        assert_eq!(class(&[figures("a", 0.5, 0, 0)]), 4);
        let text = report(&[figures("a", 0.5, 1, 1), figures("b", 0.5, 0, 0)]);
        assert!(text.contains("twice: 1 of 2") && text.contains("| `b` |"), "{text}");
    }
}
