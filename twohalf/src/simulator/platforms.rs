//! The platforms of a simulator.

use super::TwoHalfPhysicsSimulator;
use crate::depth::{Platform, PlatformId, World};
use crate::views::PlatformMut;
use crate::{Result, TextureId, Vector3};

/// Construction. A platform takes part at once.
impl Platform {
    /// A level platform with sizes and position in px.
    ///
    /// # Errors
    /// A width, height or depth that is not finite and greater than 0; a position that is not finite, or so
    /// far away that a corner is not.
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

    /// A platform tilted by `rotation` radians, clockwise on the screen, about its centre: a slope.
    ///
    /// # Errors
    /// The errors of [`Platform::new`]; a rotation that is not finite.
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

    /// A tilted platform whose edges in depth run at `angle_in_z_axis` degrees on the screen,
    /// counterclockwise from the x axis.
    ///
    /// # Errors
    /// The errors of [`Platform::with_rotation`]; an angle that is not between 0 and 180.
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
    /// A platform for reading; `None` for a stale id. [`Platform::new`] creates one.
    pub fn platform(&self, platform: PlatformId) -> Option<&Platform> {
        self.world.platforms.get(platform)
    }

    /// A platform for editing; `None` for a stale id.
    pub fn platform_mut(&mut self, platform: PlatformId) -> Option<PlatformMut<'_>> {
        let World { platforms, projection, scheme, .. } = &mut self.world;
        let index = platforms.index_of(platform)?;
        Some(PlatformMut { platforms, projection, scheme: *scheme, index })
    }

    /// Platforms in the order of creation.
    pub fn platforms(&self) -> impl DoubleEndedIterator<Item = PlatformId> + '_ {
        self.world.platforms.iter().map(|(id, _)| id)
    }

    /// Removes a platform at once; its id is stale afterwards.
    ///
    /// # Errors
    /// A stale id.
    pub fn remove_platform(&mut self, platform: PlatformId) -> Result<()> {
        self.world.platforms.remove(platform)
    }
}
