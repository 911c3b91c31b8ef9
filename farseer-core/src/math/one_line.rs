//! Text of vectors for logs and messages.

use std::fmt;

use super::Vector2;

/// A vector on one line, `(1, -2.5)`; a precision applies to the components. nalgebra prints a column over several
/// lines, and the original's text is that of [`to_text`](super::vector2::to_text).
///
/// ```
/// use farseer_core::math::{OneLine, Vector2};
/// let velocity = Vector2::new(1.0, -2.5);
/// assert_eq!(OneLine(velocity).to_string(), "(1, -2.5)");
/// assert_eq!(format!("{:.2}", OneLine(velocity)), "(1.00, -2.50)");
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OneLine(pub Vector2);

impl fmt::Display for OneLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("(")?;
        self.0.x.fmt(f)?;
        f.write_str(", ")?;
        self.0.y.fmt(f)?;
        f.write_str(")")
    }
}
