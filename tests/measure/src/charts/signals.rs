//! Measures the period and the maxima of an oscillating value.

/// Measures the mean period of a value by the times at which it passes zero upwards.
#[derive(Debug, Clone, Default)]
pub(super) struct Period {
    last: Option<(f64, f64)>,
    first_pass: Option<f64>,
    last_pass: f64,
    periods: u32,
}

impl Period {
    /// Reads a value at a time in s; times must increase.
    pub(super) fn take(&mut self, time: f64, value: f64) {
        if let Some((before, old)) = self.last
            && old < 0.0
            && value >= 0.0
        {
            let pass = before + (time - before) * old / (old - value);
            match self.first_pass {
                None => self.first_pass = Some(pass),
                Some(_) => self.periods += 1,
            }
            self.last_pass = pass;
        }
        self.last = Some((time, value));
    }

    /// Returns the number of full periods so far.
    pub(super) fn count(&self) -> u32 {
        self.periods
    }

    /// Returns the mean period so far in s; `None` before the first full period.
    pub(super) fn mean(&self) -> Option<f64> {
        let first = self.first_pass?;
        (self.periods > 0).then(|| (self.last_pass - first) / f64::from(self.periods))
    }
}

/// Finds the local maxima (peaks) of a value.
#[derive(Debug, Clone, Default)]
pub(super) struct Peaks {
    last: Option<f64>,
    is_rising: bool,
    count: i32,
}

impl Peaks {
    /// Reads a value. If a peak was just passed, returns its number, from 1, and its value; else `None`.
    pub(super) fn take(&mut self, value: f64) -> Option<(i32, f64)> {
        let old = self.last.replace(value)?;
        // A value that is constant for a step neither rises nor falls.
        if value > old {
            self.is_rising = true;
        }
        if value >= old || !std::mem::take(&mut self.is_rising) {
            return None;
        }
        self.count += 1;
        Some((self.count, old))
    }
}
