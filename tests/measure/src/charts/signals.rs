//! What is read from a value that swings: its period, and where it turns.

/// Finds the times at which a value passes zero upwards.
#[derive(Debug, Clone, Default)]
pub(super) struct Period {
    last: Option<(f64, f64)>,
    first_pass: Option<f64>,
    last_pass: f64,
    periods: u32,
}

impl Period {
    /// Takes a value at a time in s.
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

    /// How many whole periods were seen.
    pub(super) fn count(&self) -> u32 {
        self.periods
    }

    /// The mean period so far in s.
    pub(super) fn mean(&self) -> Option<f64> {
        let first = self.first_pass?;
        (self.periods > 0).then(|| (self.last_pass - first) / f64::from(self.periods))
    }
}

/// Finds the values at which something that rises turns and falls.
#[derive(Debug, Clone, Default)]
pub(super) struct Peaks {
    last: Option<f64>,
    is_rising: bool,
    count: i32,
}

impl Peaks {
    /// Takes a value; gives the number of a peak, from 1, and its value, when it was passed just now.
    pub(super) fn take(&mut self, value: f64) -> Option<(i32, f64)> {
        let old = self.last.replace(value)?;
        // What stays as it is for a step neither rises nor falls.
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
