//! The platforms of a simulator.

use super::TwoHalfPhysicsSimulator;
use crate::depth::{Platform, PlatformId, World};
use crate::views::PlatformMut;
use crate::{Result, TextureId, Vector3};

/// Making one. It takes part at once.
impl Platform {
    /// A level box.
    ///
    /// # Errors
    /// A width, height or depth that is not finite and greater than 0; a position that is not finite, or so far away
    /// that a corner would not be.
    #[doc(alias = "Platform(sim, int, int, int, Vector3, Texture2D)")]
    #[expect(clippy::new_ret_no_self, reason = "platforms live in the simulator, as in the thesis")]
    pub fn new(
        simulator: &mut TwoHalfPhysicsSimulator,
        width: f32,
        height: f32,
        depth: f32,
        position3d: Vector3,
        shadow_image: Option<TextureId>,
    ) -> Result<PlatformId> {
        Self::with_rotation(simulator, width, height, depth, position3d, 0.0, shadow_image)
    }

    /// A box tilted by `rotation` rad, clockwise on the screen, about its middle: a slope.
    ///
    /// # Errors
    /// As [`Platform::new`]; a rotation that is not finite.
    #[doc(alias = "Platform(sim, int, int, int, Vector3, float, Texture2D)")]
    pub fn with_rotation(
        simulator: &mut TwoHalfPhysicsSimulator,
        width: f32,
        height: f32,
        depth: f32,
        position3d: Vector3,
        rotation: f32,
        shadow_image: Option<TextureId>,
    ) -> Result<PlatformId> {
        let angle = simulator.angle();
        Self::with_rotation_and_angle(
            simulator,
            width,
            height,
            depth,
            position3d,
            rotation,
            shadow_image,
            angle,
        )
    }

    /// A tilted box whose edges in depth run at `angle_in_z_axis` degrees on the screen, counterclockwise from the x
    /// axis.
    ///
    /// # Errors
    /// As [`Platform::with_rotation`]; an angle that is not between 0 and 180.
    #[doc(alias = "Platform(sim, int, int, int, Vector3, float, Texture2D, int)")]
    #[expect(clippy::too_many_arguments, reason = "the thesis' constructor has these")]
    pub fn with_rotation_and_angle(
        simulator: &mut TwoHalfPhysicsSimulator,
        width: f32,
        height: f32,
        depth: f32,
        position3d: Vector3,
        rotation: f32,
        shadow_image: Option<TextureId>,
        angle_in_z_axis: i32,
    ) -> Result<PlatformId> {
        let sizes = [width, height, depth];
        let projection = &simulator.world.projection;
        let platform =
            Platform::checked(sizes, position3d, rotation, angle_in_z_axis, shadow_image, projection)?;
        simulator.world.platforms.insert(platform)
    }
}

/// Platforms.
impl TwoHalfPhysicsSimulator {
    /// A platform to look at, unless the id is stale. [`Platform::new`] makes one.
    pub fn platform(&self, platform: PlatformId) -> Option<&Platform> {
        self.world.platforms.get(platform)
    }

    /// A platform to change, unless the id is stale.
    pub fn platform_mut(&mut self, platform: PlatformId) -> Option<PlatformMut<'_>> {
        let World { platforms, projection, scheme, .. } = &mut self.world;
        let index = platforms.index_of(platform)?;
        Some(PlatformMut { platforms, projection, scheme: *scheme, index })
    }

    /// The platforms, in the order in which they were made.
    pub fn platforms(&self) -> impl DoubleEndedIterator<Item = PlatformId> + '_ {
        self.world.platforms.iter().map(|(id, _)| id)
    }

    /// Takes a platform away, at once; its id is stale.
    ///
    /// # Errors
    /// A stale id.
    pub fn remove_platform(&mut self, platform: PlatformId) -> Result<()> {
        self.world.platforms.remove(platform)
    }
}
