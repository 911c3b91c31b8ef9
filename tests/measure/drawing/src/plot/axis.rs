//! Logarithmic axes.

/// A logarithmic axis along an edge of a panel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// Ends of the axis as powers of ten: decimal logarithms of the values.
    ends: [f64; 2],
    /// Positions of both ends of the axis, px.
    places: [i32; 2],
}

/// A line across a panel at a value of the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tick {
    /// The value at the tick, in the unit of the axis.
    pub value: f64,
    /// Position of the line along the axis, px.
    pub place: i32,
    /// Whether the value is written beside the line.
    pub is_labelled: bool,
}

impl Axis {
    /// Returns an axis that covers all positive values. `places` are the positions of its ends, px. Its range is at least one
    /// decade.
    pub fn over(values: impl IntoIterator<Item = f64>, places: [i32; 2]) -> Self {
        let logs = values.into_iter().filter(|value| *value > 0.0 && value.is_finite()).map(f64::log10);
        let (least, most) = logs
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), log| (least.min(log), most.max(log)));
        let (least, most) = if least > most { (0.0, 0.0) } else { (least, most) };
        let lacking = (1.0 - (most - least)).max(0.0);
        let margin = 0.06 * (most - least).max(1.0) + lacking / 2.0;
        Axis { ends: [least - margin, most + margin], places }
    }

    /// Returns the position of a value along the axis, px, clamped to the ends.
    pub fn place(&self, value: f64) -> i32 {
        let [first, last] = self.ends;
        let part = if value > 0.0 { ((value.log10() - first) / (last - first)).clamp(0.0, 1.0) } else { 0.0 };
        let [start, end] = self.places.map(f64::from);
        (start + part * (end - start)).round() as i32
    }

    /// Returns the ticks of the axis: one per decade, and also at 2 and 5 times it if there are fewer than three decades. In
    /// longer ranges at most about `most_labels` ticks have labels.
    pub fn ticks(&self, most_labels: usize) -> Vec<Tick> {
        let [first, last] = self.ends;
        let decades: Vec<i32> = (first.ceil() as i32..=last.floor() as i32).collect();
        let every = decades.len().div_ceil(most_labels.max(1)).max(1) as i32;
        let is_short = decades.len() < 3;
        let mut ticks = Vec::new();
        for decade in first.floor() as i32..=last.floor() as i32 {
            for digit in [1.0, 2.0, 5.0] {
                let value = digit * 10_f64.powi(decade);
                let is_inside = (first..=last).contains(&value.log10());
                if is_inside && (digit == 1.0 || is_short) {
                    let is_labelled = is_short || decade.rem_euclid(every) == 0;
                    ticks.push(Tick { value, place: self.place(value), is_labelled });
                }
            }
        }
        ticks
    }
}

/// Returns a value as short text: `0.02`, `300`, `1e-6`.
pub fn short(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if !(1e-3..1e5).contains(&size) {
        format!("{value:.0e}")
    } else {
        let digits = (-size.log10().floor()).max(0.0) as usize;
        format!("{value:.digits$}")
    }
}

/// Returns a time, given in µs, as short text: `20 µs`, `1 ms`, `3 s`.
pub fn short_time(microseconds: f64) -> String {
    let (value, unit) = match microseconds {
        time if time < 1e3 => (time, "µs"),
        time if time < 1e6 => (time / 1e3, "ms"),
        time => (time / 1e6, "s"),
    };
    // A number has two significant digits, or all digits if it is an integer.
    let digits = (1.0 - value.abs().max(1e-9).log10().floor()).clamp(0.0, 3.0) as usize;
    let text = format!("{value:.digits$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    format!("{text} {unit}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_of_the_data_lie_inside_of_the_axis() {
        let axis = Axis::over([0.02, 300.0], [100, 500]);
        assert!(axis.place(0.02) > 100 && axis.place(300.0) < 500);
    }

    #[test]
    fn values_beyond_the_axis_are_clamped_to_its_end() {
        let axis = Axis::over([1.0, 10.0], [0, 100]);
        assert_eq!([axis.place(0.0), axis.place(1e9)], [0, 100]);
    }

    #[test]
    fn times_are_written_in_the_unit_of_fewest_digits() {
        let times = [0.5, 20.0, 1000.0, 34_567.0, 2_500_000.0].map(short_time);
        assert_eq!(times, ["0.5 µs", "20 µs", "1 ms", "35 ms", "2.5 s"]);
    }

    #[test]
    fn errors_are_short() {
        assert_eq!([0.02, 300.0, 2e-6, 0.0].map(short), ["0.02", "300", "2e-6", "0"]);
    }
}
