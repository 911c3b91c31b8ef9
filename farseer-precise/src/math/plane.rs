//! Vectors, rotations and poses of the plane as small arrays, for the computations of the precise set.

/// Angle of a full turn, in radians.
pub const TWO_PI: f32 = f32::from_bits(0x40C9_0FDB);

/// A vector of the plane.
pub type Vector = [f32; 2];

/// A rotation: cosine and sine of its angle.
pub type Rot = [f32; 2];

/// Pose of a body: x, y, cosine and sine of its rotation.
pub type Pose = [f32; 4];

/// The sum of two vectors.
#[inline(always)]
pub fn sum(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1]]
}

/// The vector `a - b`.
#[inline(always)]
pub fn difference(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

/// The vector multiplied by a factor.
#[inline(always)]
pub fn scaled(a: Vector, factor: f32) -> Vector {
    [a[0] * factor, a[1] * factor]
}

/// The dot product.
#[inline(always)]
pub fn dot(a: Vector, b: Vector) -> f32 {
    a[0] * b[0] + a[1] * b[1]
}

/// The depth component of the cross product, `a[0] * b[1] - a[1] * b[0]`.
#[inline(always)]
pub fn cross(a: Vector, b: Vector) -> f32 {
    a[0] * b[1] - a[1] * b[0]
}

/// The length of a vector.
#[inline(always)]
pub fn length(a: Vector) -> f32 {
    dot(a, a).sqrt()
}

/// The vector `a`, rotated by `q`.
#[inline(always)]
pub fn rotate(q: Rot, a: Vector) -> Vector {
    [q[0] * a[0] - q[1] * a[1], q[1] * a[0] + q[0] * a[1]]
}

/// The vector `a`, rotated back by `q`.
#[inline(always)]
pub fn rotate_inverse(q: Rot, a: Vector) -> Vector {
    [q[0] * a[0] + q[1] * a[1], q[0] * a[1] - q[1] * a[0]]
}

/// The position of a pose.
#[inline(always)]
pub fn translation(pose: Pose) -> Vector {
    [pose[0], pose[1]]
}

/// The rotation of a pose.
#[inline(always)]
pub fn rotation(pose: Pose) -> Rot {
    [pose[2], pose[3]]
}
