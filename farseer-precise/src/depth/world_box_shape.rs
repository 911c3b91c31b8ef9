//! Poses, extents and motion of a single world box.

use super::interface::{WorldBox, WorldBoxHinge, WorldBoxMotion};
use super::vertical_solid::VerticalSolid;
use crate::math::Vector3;
use crate::math::plane::{Pose, length};

/// Returns the velocity of a box as the solver stores it: x, y (length units/s), yaw rate (rad/s), z (length units/s). In
/// contact constraints with a moving box the arms are those about the vertical axis, as the yaw rate needs.
pub fn solver_velocity(motion: &WorldBoxMotion) -> [f32; 4] {
    let [x, y, z] = motion.velocity;
    [x, y, motion.yaw_rate, z]
}

/// Returns an upper bound, in length units, of the distance in x and z between points of a box and the point about which its
/// yaw rotates it (centre or hinge). The bound holds at any yaw.
pub(super) fn yaw_extent(world_box: &WorldBox) -> f32 {
    let [x, _, z] = world_box.shape.half;
    let [out_x, out_z] = world_box.hinge().map_or([0.0; 2], |hinge| hinge.box_offset);
    length([x + out_x.abs(), z + out_z.abs()])
}

/// Returns the point about which the yaw rotates a box, in world coordinates x, y (down), z, length units: a point on the
/// hinge, or the centre of a box without a hinge.
pub(super) fn origin_of(world_box: &WorldBox) -> Vector3 {
    let centre = world_box.shape.centre;
    world_box.hinge().map_or(centre, |WorldBoxHinge { pivot: [x, z], .. }| Vector3::new(*x, centre.y, *z))
}

/// Returns a level box as a vertical shape, relative to the point about which its yaw rotates the box (hinge or centre).
pub(super) fn vertical_of(world_box: &WorldBox) -> VerticalSolid {
    let (shape, mut corners) = (&world_box.shape, world_box.shape.footprint());
    if world_box.hinge().is_some() {
        let out = shape.centre - origin_of(world_box);
        corners = corners.map(|[x, z]| [x + out.x, z + out.z]);
    }
    VerticalSolid::level_box(corners, shape.half[1])
}

/// Returns the equivalent of an angle in 0..2 pi, in radians.
fn wrap_angle(angle: f32) -> f32 {
    let turn = 2.0 * std::f32::consts::PI;
    let rest = angle % turn;
    if rest < 0.0 { rest + turn } else { rest }
}

/// Returns the world pose of a box in the plane: x and y (length units) of its centre or hinge, cosine and sine of its tilt.
pub(super) fn pose_of(world_box: &WorldBox) -> Pose {
    let (shape, place) = (&world_box.shape, origin_of(world_box));
    [place.x, place.y, shape.cos, shape.sin]
}

impl WorldBoxMotion {
    /// Start of a step: sets velocity and yaw rate to those that reach the targets of position and yaw. `centre` is the world
    /// position of the box in length units, `yaw` is in radians, `dt` is the step in seconds.
    pub(super) fn begin_step(&mut self, centre: Vector3, yaw: f32, dt: f32) {
        self.begin_yaw(yaw, dt);
        let Some((target, is_reached)) = self.target else { return };
        self.velocity =
            if is_reached { [0.0; 3] } else { [0, 1, 2].map(|axis| (target[axis] - centre[axis]) / dt) };
        if !self.velocity.iter().all(|velocity| velocity.is_finite()) {
            self.velocity = [0.0; 3];
        }
        let stays = !is_reached && self.velocity != [0.0; 3];
        self.target = self.target.filter(|_| stays);
    }

    /// Start of a step: sets the yaw rate to that which reaches the target yaw. `yaw` is the present yaw in radians, `dt` the
    /// step in seconds.
    pub(super) fn begin_yaw(&mut self, yaw: f32, dt: f32) {
        let Some((target, is_reached)) = self.yaw_target else { return };
        self.yaw_rate = if is_reached { 0.0 } else { (target - yaw) / dt };
        if !self.yaw_rate.is_finite() {
            self.yaw_rate = 0.0;
        }
        let stays = !is_reached && self.yaw_rate != 0.0;
        self.yaw_target = self.yaw_target.filter(|_| stays);
    }

    /// End of a step: returns the new yaw of the box in radians. `yaw` is the yaw before the step, `turned` the rotation in the
    /// step, both in radians.
    pub(super) fn end_yaw(&mut self, yaw: f32, turned: f32) -> f32 {
        match self.yaw_target.as_mut() {
            Some((target, is_reached)) => {
                *is_reached = true;
                *target
            }
            None if turned == 0.0 => yaw,
            None => self
                .hinge()
                .map_or_else(|| wrap_angle(yaw + turned), |hinge| hinge.clamp_to_stops(yaw + turned)),
        }
    }

    /// End of a step: returns the new centre of the box in world coordinates, length units. A box whose position would have
    /// overflowed was put back in the step (`displacement` 0); it stops.
    pub(super) fn end_step(&mut self, centre: Vector3, displacement: [f32; 3]) -> Vector3 {
        let is_put_back = displacement == [0.0; 3] && self.velocity != [0.0; 3];
        self.displacement = displacement;
        if is_put_back {
            (self.velocity, self.target) = ([0.0; 3], None);
        }
        match self.target.as_mut() {
            Some((target, is_reached)) => {
                *is_reached = true;
                Vector3::from(*target)
            }
            None => centre + Vector3::from(displacement),
        }
    }

    /// Returns whether the next step moves the box.
    pub(super) fn is_moving(&self) -> bool {
        let turns = self.yaw_target.map_or(self.yaw_rate != 0.0, |(_, is_reached)| !is_reached);
        turns || self.target.map_or(self.velocity != [0.0; 3], |(_, is_reached)| !is_reached)
    }
}
