//! Vectors, rotations and poses of the plane as tight arrays of numbers, as the precise set computes with them.

/// A vector of the plane.
pub(crate) type Vector = [f32; 2];

/// Cosine and sine of an angle.
pub(crate) type Turn = [f32; 2];

/// Where a body is: x, y, cosine and sine of its rotation.
pub(crate) type Pose = [f32; 4];

#[inline(always)]
pub(crate) fn sum(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1]]
}

#[inline(always)]
pub(crate) fn difference(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

#[inline(always)]
pub(crate) fn scaled(a: Vector, factor: f32) -> Vector {
    [a[0] * factor, a[1] * factor]
}

#[inline(always)]
pub(crate) fn dot(a: Vector, b: Vector) -> f32 {
    a[0] * b[0] + a[1] * b[1]
}

#[inline(always)]
pub(crate) fn cross(a: Vector, b: Vector) -> f32 {
    a[0] * b[1] - a[1] * b[0]
}

#[inline(always)]
pub(crate) fn length(a: Vector) -> f32 {
    dot(a, a).sqrt()
}

#[inline(always)]
pub(crate) fn turn(q: Turn, a: Vector) -> Vector {
    [q[0] * a[0] - q[1] * a[1], q[1] * a[0] + q[0] * a[1]]
}

#[inline(always)]
pub(crate) fn turn_back(q: Turn, a: Vector) -> Vector {
    [q[0] * a[0] + q[1] * a[1], q[0] * a[1] - q[1] * a[0]]
}

#[inline(always)]
pub(crate) fn place(pose: Pose) -> Vector {
    [pose[0], pose[1]]
}

#[inline(always)]
pub(crate) fn rotation(pose: Pose) -> Turn {
    [pose[2], pose[3]]
}
