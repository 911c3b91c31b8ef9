//! Points and affine transforms of the plane, screen axes: x right, y down, in px.

/// A point or a pair of lengths `[x, y]`, in px. nalgebra's `Vector2<f32>` turns into one with `into()`.
pub type Point = [f32; 2];

/// An affine transform: `p -> x_axis * p.x + y_axis * p.y + translation`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transform {
    /// Image of the direction (1, 0).
    pub x_axis: Point,
    /// Image of the direction (0, 1).
    pub y_axis: Point,
    /// Image of the origin, px.
    pub translation: Point,
}

impl Transform {
    /// Leaves every point where it is.
    pub const IDENTITY: Transform =
        Transform { x_axis: [1.0, 0.0], y_axis: [0.0, 1.0], translation: [0.0, 0.0] };

    /// Moves every point by `offset` px.
    pub const fn translation(offset: Point) -> Self {
        Transform { translation: offset, ..Transform::IDENTITY }
    }

    /// Scales about the origin; negative factors mirror.
    pub const fn scaling(factors: Point) -> Self {
        Transform { x_axis: [factors[0], 0.0], y_axis: [0.0, factors[1]], translation: [0.0, 0.0] }
    }

    /// Rotates about the origin by `angle` radians; positive is from x (right) to y (down), clockwise on the
    /// screen.
    pub fn rotation(angle: f32) -> Self {
        // f64 and libm: the same transform on every platform.
        let (sin, cos) = libm::sincos(f64::from(angle));
        let (sin, cos) = (sin as f32, cos as f32);
        Transform { x_axis: [cos, sin], y_axis: [-sin, cos], translation: [0.0, 0.0] }
    }

    /// Moves a point down by `slopes[0]` px for each px that it lies to the right of the origin, and by
    /// `slopes[1]` px for each px below it.
    pub const fn slant(slopes: Point) -> Self {
        Transform { x_axis: [1.0, slopes[0]], y_axis: [0.0, 1.0 + slopes[1]], translation: [0.0, 0.0] }
    }

    /// A camera that looks at the point `looks_at` of a scene and shows it at `on_canvas`. The scene is
    /// magnified by `zoom` (1: unchanged; greater than 0) and rotated by `rotation` radians, positive
    /// clockwise.
    ///
    /// ```
    /// # use twohalf_render::Transform;
    /// let camera = Transform::camera([500.0, 40.0], 2.0, 0.0, [360.0, 240.0]);
    /// assert_eq!(camera.apply([510.0, 40.0]), [380.0, 240.0]);
    /// // Where in the scene something on the screen is: under a mouse, for example.
    /// assert_eq!(camera.inverse().unwrap().apply([380.0, 240.0]), [510.0, 40.0]);
    /// ```
    pub fn camera(looks_at: Point, zoom: f32, rotation: f32, on_canvas: Point) -> Self {
        Transform::translation(looks_at.map(|at| -at))
            .then(&Transform::scaling([zoom; 2]))
            .then(&Transform::rotation(rotation))
            .then(&Transform::translation(on_canvas))
    }

    /// The inverse; `None` if there is none, since an area becomes a line or a number is not finite.
    #[doc(alias = "Invert")]
    pub fn inverse(&self) -> Option<Self> {
        let [[a, b], [c, d], [x, y]] =
            [self.x_axis, self.y_axis, self.translation].map(|axis| axis.map(f64::from));
        let area = a * d - b * c;
        let columns = [[d, -b], [-c, a], [c * y - d * x, b * x - a * y]];
        let [x_axis, y_axis, translation] = columns.map(|column| column.map(|n| (n / area) as f32));
        let back = Transform { x_axis, y_axis, translation };
        [x_axis, y_axis, translation].iter().flatten().all(|number| number.is_finite()).then_some(back)
    }

    /// First `self`, then `next`.
    pub fn then(&self, next: &Transform) -> Self {
        Transform {
            x_axis: next.direction(self.x_axis),
            y_axis: next.direction(self.y_axis),
            translation: next.apply(self.translation),
        }
    }

    /// The image of a point.
    pub fn apply(&self, point: Point) -> Point {
        let [x, y] = self.direction(point);
        [x + self.translation[0], y + self.translation[1]]
    }

    /// The image of a direction: [`Transform::apply`] without the translation.
    pub fn direction(&self, [x, y]: Point) -> Point {
        [self.x_axis[0] * x + self.y_axis[0] * y, self.x_axis[1] * x + self.y_axis[1] * y]
    }
}

impl Default for Transform {
    fn default() -> Self {
        Transform::IDENTITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_turn_takes_right_to_down() {
        let [x, y] = Transform::rotation(std::f32::consts::FRAC_PI_2).apply([10.0, 0.0]);
        assert!(x.abs() < 1e-5 && (y - 10.0).abs() < 1e-5, "({x}, {y})");
    }

    #[test]
    fn then_applies_the_receiver_first() {
        let both = Transform::scaling([2.0, 3.0]).then(&Transform::translation([10.0, 20.0]));
        assert_eq!(both.apply([1.0, 1.0]), [12.0, 23.0]);
    }

    #[test]
    fn a_flat_transform_has_no_inverse() {
        assert_eq!(Transform::scaling([1.0, 0.0]).inverse(), None);
        assert_eq!(Transform::translation([f32::NAN, 0.0]).inverse(), None);
    }

    #[test]
    fn there_and_back_changes_nothing() {
        // Powers of two and a quarter of a turn without rounding.
        let turned = Transform { x_axis: [0.0, 2.0], y_axis: [-4.0, 0.0], translation: [3.0, -5.0] };
        assert_eq!(turned.then(&turned.inverse().unwrap()).apply([7.0, 11.0]), [7.0, 11.0]);
    }
}
