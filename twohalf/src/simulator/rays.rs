//! What a ray through the world enters, and what a box meets that is moved through it, in three axes.

use farseer_core::GeomId;

use crate::projection::to_world;
use crate::shapes::{ConvexPieces, Course, Entry, entry_of_parts};
use crate::{DepthProfile, Partner, PlatformId, TwoHalfPhysicsSimulator, Vector3};

/// Where a ray enters something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RayHit3D {
    /// What it is: a geom, a platform or the ground.
    pub partner: Partner,
    /// The point of its surface, in the world, Y up.
    pub point: Vector3,
    /// The surface's direction outward there, of length 1, Y up: against the ray.
    pub normal: Vector3,
    /// Part of the way from the start to the end of the ray, from 0 to 1.
    pub fraction: f32,
}

/// Where a box that is moved meets something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SweepHit3D {
    /// What it is: a geom, a platform or the ground.
    pub partner: Partner,
    /// The direction in which it pushes the box back, of length 1, Y up: against the way.
    pub normal: Vector3,
    /// Part of the way that the box goes until they touch, from 0 to 1.
    pub fraction: f32,
}

/// A normal of the world, whose zeros are not negative.
fn outward(normal: Vector3) -> Vector3 {
    to_world(normal).map(|part| part + 0.0)
}

impl TwoHalfPhysicsSimulator {
    /// The first thing that a ray from `start` to `end`, in the world, enters: a listed geom, a platform, or the ground, of
    /// those that the filter lets through. Of several at one place platforms come first, then geoms in the order of their
    /// list, then the ground.
    ///
    /// Balls are balls, everything else its outline, extruded. What holds the start is hit only where the ray enters it
    /// again; one along whose side the ray only grazes may be hit or not. The ground is the plane Y = 0, from
    /// above. Disposed geoms are not hit. A ray that ends where it starts, or is not finite, hits nothing.
    ///
    /// Looks at the box of every listed geom and at every platform: the time grows with their number. The filter is asked only
    /// about what the ray enters.
    ///
    /// ```
    /// use twohalf::{Partner, TwoHalfPhysicsSimulator, Vector3};
    /// let simulator = TwoHalfPhysicsSimulator::new(480)?;
    /// let (eye, floor) = (Vector3::new(0.0, 100.0, 0.0), Vector3::new(0.0, -100.0, 60.0));
    /// let hit = simulator.ray_cast3d(eye, floor, |_| true).unwrap();
    /// assert_eq!((hit.partner, hit.point), (Partner::Ground, Vector3::new(0.0, 0.0, 30.0)));
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    pub fn ray_cast3d(
        &self,
        start: Vector3,
        end: Vector3,
        is_wanted: impl FnMut(Partner) -> bool,
    ) -> Option<RayHit3D> {
        let ray = Course::of_point(to_world(start), to_world(end - start))?;
        let (partner, (fraction, normal)) =
            self.first_entered(&ray, start.inf(&end), start.sup(&end), is_wanted)?;
        let point = to_world(ray.at(fraction));
        Some(RayHit3D { partner, point, normal: outward(normal), fraction })
    }

    /// The first thing that a box of the world meets if it is moved by `way`, px: a listed geom, a platform, or the ground, of
    /// those that the filter lets through. `low` has the least X, Y and Z of the box in px where it starts, `high` the
    /// greatest. Of several at one place platforms come first, then geoms in the order of their list, then the ground.
    ///
    /// Nothing is rounded off: tilted and leaning platforms, outlines, balls and what stands upright are met where they are,
    /// by corners, edges and round sides. What the box overlaps at the start, such as the floor in which something rests by a
    /// fraction of a px, is met only where the box comes into it again. What it only slides along is not met; of sides that are
    /// not along the axes rounding decides. Whether a geom collides at all does not count. Disposed geoms are not met. Nothing is
    /// met on no way, or if a number is not finite, or one of `low` is greater than that of `high`.
    ///
    /// Looks at the box of every listed geom and at every platform: the time grows with their number. The filter is asked only
    /// about what the box meets.
    ///
    /// ```
    /// use twohalf::{Partner, Platform, TwoHalfPhysicsSimulator, Vector3};
    /// let mut simulator = TwoHalfPhysicsSimulator::new(480)?;
    /// let wall = Platform::new(&mut simulator, 10.0, 100.0, 60.0, Vector3::new(105.0, 0.0, 0.0), None)?;
    /// // 20 px wide, 50 high and 16 deep: how far does it come to the right?
    /// let (low, high) = (Vector3::new(-10.0, 1.0, -8.0), Vector3::new(10.0, 51.0, 8.0));
    /// let hit = simulator.sweep_box(low, high, Vector3::new(180.0, 0.0, 0.0), |_| true).unwrap();
    /// assert_eq!((hit.partner, hit.fraction), (Partner::Platform(wall), 0.5));
    /// assert_eq!(hit.normal, Vector3::new(-1.0, 0.0, 0.0));
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    pub fn sweep_box(
        &self,
        low: Vector3,
        high: Vector3,
        way: Vector3,
        is_wanted: impl FnMut(Partner) -> bool,
    ) -> Option<SweepHit3D> {
        if !(0..3).all(|axis| low[axis] <= high[axis]) {
            return None;
        }
        let course = Course::of_box(to_world((low + high) * 0.5), to_world(way), (high - low) * 0.5)?;
        let (from, to) = (low.inf(&(low + way)), high.sup(&(high + way)));
        let (partner, (fraction, normal)) = self.first_entered(&course, from, to, is_wanted)?;
        Some(SweepHit3D { partner, normal: outward(normal), fraction })
    }

    /// What is entered first on a course, of what reaches into a box of the world around it.
    fn first_entered(
        &self,
        course: &Course,
        low: Vector3,
        high: Vector3,
        mut is_wanted: impl FnMut(Partner) -> bool,
    ) -> Option<(Partner, Entry)> {
        let mut nearest: Option<(Partner, Entry)> = None;
        let mut meet = |partner: Partner, entry: Option<Entry>| {
            if let Some(entry) = entry
                && is_wanted(partner)
                && nearest.is_none_or(|(_, other)| entry.0 < other.0)
            {
                nearest = Some((partner, entry));
            }
        };
        for id in self.platforms_in_box(low, high, |_| true) {
            meet(Partner::Platform(id), self.platform(id).and_then(|view| course.entry_of_box(view.shape())));
        }
        for id in self.query_box(low, high, |_| true) {
            meet(Partner::Geom(id), self.entry_of(course, id));
        }
        meet(Partner::Ground, course.entry_of_ground());
        nearest
    }

    fn entry_of(&self, course: &Course, id: GeomId) -> Option<Entry> {
        let (geom, profile) = (self.core.geom(id)?, *self.world.depths.profiles.get(id)?);
        let z = self.world.depths.z_of(geom.body());
        if let Some(upright) = profile.upright() {
            let at = crate::depth::upright::middle(geom, self.core.body(geom.body())?, z);
            return course.inside_upright(&upright, at)?.entry();
        }
        if let DepthProfile::Round { radius } = profile {
            let centre = geom.position();
            return course.inside_ball(Vector3::new(centre.x, centre.y, z), radius)?.entry();
        }
        let pieces = ConvexPieces::new(geom.local_vertices());
        let mut corners = Vec::new();
        pieces.lay_out(&geom.matrix(), &mut corners);
        let half = profile.half_depth();
        let within = pieces.pieces(&corners).filter_map(|piece| course.inside_prism(piece, z, half));
        entry_of_parts(&within.collect::<Vec<_>>())
    }

    /// The platforms whose boxes overlap a box of the world or touch it, in the order in which they were made, but for what
    /// the filter does not let through: as [`query_box`](Self::query_box). The box of a platform that is tilted, or leans, is
    /// the one around it.
    pub fn platforms_in_box(
        &self,
        low: Vector3,
        high: Vector3,
        mut is_wanted: impl FnMut(PlatformId) -> bool,
    ) -> Vec<PlatformId> {
        let is_axis =
            |axis: usize| low[axis].is_finite() && high[axis].is_finite() && low[axis] <= high[axis];
        if !(0..3).all(is_axis) {
            return Vec::new();
        }
        let (low, high) = (Vector3::new(low.x, -high.y, low.z), Vector3::new(high.x, -low.y, high.z));
        let near = self.world.platforms.iter().filter(|(_, platform)| {
            let (least, greatest) = platform.shape().bounds();
            (0..3).all(|axis| least[axis] <= high[axis] && low[axis] <= greatest[axis])
        });
        near.map(|(id, _)| id).filter(|&id| is_wanted(id)).collect()
    }
}
