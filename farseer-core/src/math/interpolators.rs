//! Interpolation between four values (behaviour chapter 01, sections 7 and 8).

use serde::{Deserialize, Serialize};

use super::{Vector2, calculator, math_helper, scalar};

/// 2 / pi, in 1/radians, as the original rounds it.
const TWO_OVER_PI: f32 = f32::from_bits(0x3F22_F983);

/// Three quarters of a turn in radians.
const THREE_PI_OVER_2: f32 = f32::from_bits(0x4096_CBE4);

/// Interpolates between the values at the corners of a rectangle; see [`calculator::bi_lerp`].
///
/// ```
/// use farseer_core::math::{BilinearInterpolator, Vector2};
/// let unit_square = BilinearInterpolator {
///     max: Vector2::new(1.0, 1.0),
///     values: [1.0, 2.0, 3.0, 4.0],
///     ..BilinearInterpolator::default()
/// };
/// assert_eq!(unit_square.get_value(Vector2::new(0.25, 0.75)), 2.125);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BilinearInterpolator {
    /// The corner with the smallest coordinates.
    #[doc(alias = "Min")]
    pub min: Vector2,
    /// The corner with the greatest coordinates.
    #[doc(alias = "Max")]
    pub max: Vector2,
    /// The values at `(min.x, min.y)`, `(min.x, max.y)`, `(max.x, max.y)` and `(max.x, min.y)`: finite numbers in any unit.
    pub values: [f32; 4],
    /// Minimum of the results, in the unit of the values.
    pub min_value: f32,
    /// Maximum of the results, in the unit of the values.
    pub max_value: f32,
}

impl BilinearInterpolator {
    /// An interpolator over a rectangle with all values 0, to be set.
    pub fn new(min: Vector2, max: Vector2) -> Self {
        BilinearInterpolator { min, max, ..Default::default() }
    }

    /// The value at a point; outside the rectangle that of the nearest point of its boundary. NaN for an
    /// empty rectangle.
    #[doc(alias = "GetValue")]
    pub fn get_value(&self, position: Vector2) -> f32 {
        let [v1, v2, v3, v4] = self.values;
        calculator::bi_lerp(position, self.min, self.max, v1, v2, v3, v4, self.min_value, self.max_value)
    }
}

/// The empty rectangle, values 0 and results not limited.
impl Default for BilinearInterpolator {
    fn default() -> Self {
        BilinearInterpolator {
            min: Vector2::new(0.0, 0.0),
            max: Vector2::new(0.0, 0.0),
            values: [0.0; 4],
            min_value: f32::MIN,
            max_value: f32::MAX,
        }
    }
}

/// Interpolates between four values on the axes, in the order +x, +y, -x, -y, by angle and by distance. As the distance
/// the original takes `|x - y|`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CircularInterpolator {
    /// The four values: finite numbers in any unit.
    pub values: [f32; 4],
    /// Minimum of the results, in the unit of the values.
    pub min_value: f32,
    /// Maximum of the results, in the unit of the values.
    pub max_value: f32,
}

impl CircularInterpolator {
    /// An interpolator of four values, its results limited to a range.
    pub fn new(values: [f32; 4], min_value: f32, max_value: f32) -> Self {
        CircularInterpolator { values, min_value, max_value }
    }

    /// The value at a point. At the origin and for NaN it is 0, limited to the range of results.
    #[doc(alias = "GetValue")]
    pub fn get_value(&self, position: Vector2) -> f32 {
        math_helper::clamp(self.unlimited(position.x, position.y), self.min_value, self.max_value)
    }

    fn unlimited(&self, x: f32, y: f32) -> f32 {
        use math_helper::{PI, PI_OVER_2, TWO_PI, lerp};
        let [a, b, c, d] = self.values;
        let half = (1.0 - (x - y).abs()) * 0.5;
        let angle = scalar::atan2(y, x);
        let between = |k: f32, near: [f32; 2], far: [f32; 2]| {
            lerp(lerp(near[0], near[1], k), lerp(far[0], far[1], k), half)
        };
        if x > 0.0 && y > 0.0 {
            between(angle * TWO_OVER_PI, [a, b], [c, d])
        } else if x < 0.0 && y > 0.0 {
            between((angle - PI_OVER_2) * TWO_OVER_PI, [b, c], [d, a])
        } else if x < 0.0 && y < 0.0 {
            between((angle + TWO_PI - PI) * TWO_OVER_PI, [c, d], [a, b])
        } else if x > 0.0 && y < 0.0 {
            between((angle + TWO_PI - THREE_PI_OVER_2) * TWO_OVER_PI, [d, a], [b, c])
        } else if x == 0.0 && y > 0.0 {
            lerp(b, d, (1.0 - y) / 2.0)
        } else if x == 0.0 && y < 0.0 {
            lerp(d, b, (1.0 + y) / 2.0)
        } else if x > 0.0 && y == 0.0 {
            lerp(a, c, (1.0 - x) / 2.0)
        } else if x < 0.0 && y == 0.0 {
            lerp(c, a, (1.0 + x) / 2.0)
        } else {
            0.0
        }
    }
}
