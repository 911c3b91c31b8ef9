//! Origin of figures: versions, machine and date.

use super::csv::{kept, table};
use csv::ReaderBuilder;
use std::fs;
use std::thread::available_parallelism;
use std::time::{SystemTime, UNIX_EPOCH};

/// Returns the origin of figures as names and values: date, machine, build, and versions of this workspace and of the
/// engines in `peers`.
pub fn origin(peers: impl IntoIterator<Item = (&'static str, String)>) -> Vec<(&'static str, String)> {
    let mut lines = vec![
        ("Date", date(SystemTime::now())),
        ("Machine", machine()),
        ("Build", build().to_owned()),
        ("farseer-core, twohalf", env!("CARGO_PKG_VERSION").to_owned()),
    ];
    lines.extend(peers);
    lines
}

/// Returns an origin as a table of two columns (name, value), to be stored beside the figures.
pub fn origin_csv(origin: &[(&'static str, String)]) -> String {
    table(origin)
}

/// Reads an origin from a table that [`origin_csv`] has written.
///
/// # Errors
///
/// The text is not a table of two columns.
pub fn read_origin(text: &str) -> Result<Vec<(&'static str, String)>, String> {
    let mut reader = ReaderBuilder::new().has_headers(false).from_reader(text.as_bytes());
    let lines: csv::Result<Vec<(String, String)>> = reader.deserialize().collect();
    let lines = lines.map_err(|error| error.to_string())?;
    Ok(lines.into_iter().map(|(name, value)| (kept(name), value)).collect())
}

fn build() -> &'static str {
    if cfg!(debug_assertions) { "with assertions, not for timing" } else { "release" }
}

/// Returns processor model, number of threads, operating system and architecture of this machine.
fn machine() -> String {
    let known = fs::read_to_string("/proc/cpuinfo").ok();
    let model =
        known.as_deref().and_then(|text| text.lines().find_map(|line| line.strip_prefix("model name")));
    let model = model.map_or("processor unknown", |line| line.trim_start_matches([' ', '\t', ':']));
    let threads = available_parallelism().map_or(1, usize::from);
    format!("{model}, {threads} threads, {} {}", std::env::consts::OS, std::env::consts::ARCH)
}

/// Returns the date of `time` as year-month-day, in UTC.
fn date(time: SystemTime) -> String {
    let seconds = time.duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    let (year, month, day) = civil(seconds as i64 / 86_400);
    format!("{year:04}-{month:02}-{day:02}")
}

/// Returns year, month and day of a day counted from 1970-01-01. The calculation lets years begin in March, so that February
/// 29 is the last day of a year; 400 years have 146,097 days.
fn civil(day: i64) -> (i64, i64, i64) {
    let day = day + 719_468;
    let era = day.div_euclid(146_097);
    let in_era = day.rem_euclid(146_097);
    let year = (in_era - in_era / 1460 + in_era / 36_524 - in_era / 146_096) / 365;
    let in_year = in_era - (365 * year + year / 4 - year / 100);
    let month = (5 * in_year + 2) / 153;
    let day = in_year - (153 * month + 2) / 5 + 1;
    let month = if month < 10 { month + 3 } else { month - 9 };
    (year + 400 * era + i64::from(month <= 2), month, day)
}

#[cfg(test)]
mod tests {
    use super::{civil, origin, origin_csv, read_origin};

    #[test]
    fn days_become_dates() {
        let dates = [0, 59, 11_016, 19_782].map(civil);
        assert_eq!(dates, [(1970, 1, 1), (1970, 3, 1), (2000, 2, 29), (2024, 2, 29)]);
    }

    #[test]
    fn the_origin_of_figures_is_read_back() {
        let origin = origin([("peer", "1.0, with flags".to_owned())]);
        assert_eq!(read_origin(&origin_csv(&origin)), Ok(origin));
    }
}
