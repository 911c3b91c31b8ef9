//! Points and velocities, in the body's coordinates and in those of the world.

use super::Body;
use crate::math::matrix::create_rotation_z;
use crate::math::vector2::transform;
use crate::math::{Matrix, Vector2};

impl Body {
    /// Rotation about the body's origin and its translation, for row vectors.
    #[doc(alias = "GetBodyMatrix")]
    pub fn get_body_matrix(&self) -> Matrix {
        let mut matrix = create_rotation_z(self.rotation);
        // The matrix product of the original adds zeros, which turn -0 into +0.
        matrix.m12 += 0.0;
        matrix.m21 += 0.0;
        matrix.m41 = 0.0 + self.position.x;
        matrix.m42 = 0.0 + self.position.y;
        matrix
    }

    /// Rotation about the body's origin alone.
    #[doc(alias = "GetBodyRotationMatrix")]
    pub fn get_body_rotation_matrix(&self) -> Matrix {
        create_rotation_z(self.rotation)
    }

    /// World position of a point given in the body's coordinates.
    #[doc(alias = "GetWorldPosition")]
    pub fn get_world_position(&self, local_position: Vector2) -> Vector2 {
        transform(local_position, &self.get_body_matrix())
    }

    /// Position in the body's coordinates of a point of the world.
    #[doc(alias = "GetLocalPosition")]
    pub fn get_local_position(&self, world_position: Vector2) -> Vector2 {
        let d = world_position - self.position;
        transform(d, &self.get_body_rotation_matrix().transpose())
    }

    /// The body's x axis in the world.
    #[doc(alias = "XVectorInWorldCoordinates")]
    pub fn x_vector_in_world_coordinates(&self) -> Vector2 {
        let matrix = self.get_body_matrix();
        Vector2::new(matrix.m11, matrix.m12)
    }

    /// The body's y axis in the world.
    #[doc(alias = "YVectorInWorldCoordinates")]
    pub fn y_vector_in_world_coordinates(&self) -> Vector2 {
        let matrix = self.get_body_matrix();
        Vector2::new(matrix.m21, matrix.m22)
    }

    /// Velocity of the point at this offset from the body's origin, in world orientation.
    #[doc(alias = "GetVelocityAtWorldOffset")]
    pub fn get_velocity_at_world_offset(&self, offset: Vector2) -> Vector2 {
        velocity_at(self.linear_velocity, self.angular_velocity, offset)
    }

    /// Like [`get_velocity_at_world_offset`](Self::get_velocity_at_world_offset), but of the bias velocity, with which
    /// the solver separates overlapping bodies.
    #[doc(alias = "GetVelocityBiasAtWorldOffset")]
    pub fn get_velocity_bias_at_world_offset(&self, offset: Vector2) -> Vector2 {
        velocity_at(self.linear_velocity_bias, self.angular_velocity_bias, offset)
    }

    /// Velocity of the body at a point of the world.
    #[doc(alias = "GetVelocityAtWorldPoint")]
    pub fn get_velocity_at_world_point(&self, world_point: Vector2) -> Vector2 {
        self.get_velocity_at_world_offset(world_point - self.position)
    }

    /// Velocity of a point given in the body's coordinates. The original adds the position and subtracts it again, so
    /// the result loses digits far from the origin.
    #[doc(alias = "GetVelocityAtLocalPoint")]
    pub fn get_velocity_at_local_point(&self, local_point: Vector2) -> Vector2 {
        self.get_velocity_at_world_offset(self.get_world_position(local_point) - self.position)
    }
}

/// Velocity at an offset from the centre of mass.
#[inline(always)]
fn velocity_at(linear: Vector2, angular: f32, offset: Vector2) -> Vector2 {
    Vector2::new(-angular * offset.y + linear.x, angular * offset.x + linear.y)
}
