//! Vectors in the plane as pairs of `f64`.

/// A vector in the plane: x and y.
pub type Vec2 = [f64; 2];

/// Returns the scalar product of two vectors.
#[inline(always)]
pub(super) fn dot(a: Vec2, b: Vec2) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Returns the cross product of two vectors in the plane: a.x b.y - a.y b.x.
#[inline(always)]
pub(super) fn cross(a: Vec2, b: Vec2) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Returns `arm` rotated by 90 degrees, (-y, x): the velocity of the arm's end per unit of angular velocity.
#[inline(always)]
pub(super) fn perp(arm: Vec2) -> Vec2 {
    [-arm[1], arm[0]]
}

/// Returns the vector rotated by an angle that is given as cosine and sine.
#[inline(always)]
pub(super) fn rotate([c, s]: [f64; 2], [x, y]: Vec2) -> Vec2 {
    [c * x - s * y, s * x + c * y]
}

/// Returns a + s b.
#[inline(always)]
pub(super) fn add_scaled(a: Vec2, b: Vec2, s: f64) -> Vec2 {
    [a[0] + b[0] * s, a[1] + b[1] * s]
}
