//! Vectors, rotations and poses of the plane as small arrays, for the computations of the precise set.

/// Angle of a full turn, in radians.
pub(crate) const TWO_PI: f32 = f32::from_bits(0x40C9_0FDB);

/// A vector of the plane.
pub(crate) type Vector = [f32; 2];

/// A rotation: cosine and sine of its angle.
pub(crate) type Rot = [f32; 2];

/// Pose of a body: x, y, cosine and sine of its rotation.
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
pub(crate) fn rotate(q: Rot, a: Vector) -> Vector {
    [q[0] * a[0] - q[1] * a[1], q[1] * a[0] + q[0] * a[1]]
}

#[inline(always)]
pub(crate) fn rotate_inverse(q: Rot, a: Vector) -> Vector {
    [q[0] * a[0] + q[1] * a[1], q[0] * a[1] - q[1] * a[0]]
}

#[inline(always)]
pub(crate) fn translation(pose: Pose) -> Vector {
    [pose[0], pose[1]]
}

#[inline(always)]
pub(crate) fn rotation(pose: Pose) -> Rot {
    [pose[2], pose[3]]
}
