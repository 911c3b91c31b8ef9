//! Ray casts and shape casts of boxes in three axes.

use farseer_core::GeomId;
use farseer_core::depth::DepthPath;

use super::queries::is_box;
use crate::projection::to_world;
use crate::shapes::{ConvexPieces, Hit, Sweep, entry_of_parts};
use crate::{ContactTarget, DepthProfile, PlatformId, TwoHalfPhysicsSimulator, Vector3};

/// Hit of a ray cast.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RayHit3D {
    /// The target: a geom, a platform or the ground.
    pub partner: ContactTarget,
    /// Point on the surface, px, in the world, Y up.
    pub point: Vector3,
    /// Outward unit normal, Y up, against the ray.
    pub normal: Vector3,
    /// Fraction of the path from start to end, 0..=1, dimensionless.
    pub fraction: f32,
}

/// Hit of a shape cast.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SweepHit3D {
    /// The target: a geom, a platform or the ground.
    pub partner: ContactTarget,
    /// Unit normal towards the box, Y up, against the path.
    pub normal: Vector3,
    /// Fraction of the path until the touch, 0..=1, dimensionless.
    pub fraction: f32,
}

/// Least number by which geoms are ordered after all platforms.
const GEOM_KEYS: u64 = 1 << 32;

/// Fraction of a path by which a hit may be found too early through rounding, dimensionless: many times the rounding of an `f32`.
const FRACTION_TOLERANCE: f64 = 1e-4;

/// Returns a normal of the frame of the plane (y down) in the world (Y up), without negative zeros.
fn outward(normal: Vector3) -> Vector3 {
    to_world(normal).map(|part| part + 0.0)
}

impl TwoHalfPhysicsSimulator {
    /// Ray cast: the first target that the ray from `start` to `end`, in the world, enters. Targets are
    /// listed geoms, platforms and the ground, unless the filter rejects them. Of several at one place
    /// platforms come first, then geoms in the order of their list, then the ground.
    ///
    /// Balls are spheres, all other geoms are their extruded outlines. A shape that contains the start is hit
    /// only where the ray enters it again. A side parallel to the ray may be hit or not if the ray touches
    /// it. The ground is the plane Y = 0, from above. Disposed geoms are not hit. A ray without length, or
    /// that is not finite, hits nothing.
    ///
    /// Tests the AABB of every platform; the geoms come from the hash grid of the precise set, along the ray up to
    /// its first hit. The filter is called only for targets that the ray enters.
    ///
    /// ```
    /// use twohalf::{ContactTarget, TwoHalfPhysicsSimulator, Vector3};
    /// let simulator = TwoHalfPhysicsSimulator::new(480)?;
    /// let (eye, floor) = (Vector3::new(0.0, 100.0, 0.0), Vector3::new(0.0, -100.0, 60.0));
    /// let hit = simulator.ray_cast3d(eye, floor, |_| true).unwrap();
    /// assert_eq!((hit.partner, hit.point), (ContactTarget::Ground, Vector3::new(0.0, 0.0, 30.0)));
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    pub fn ray_cast3d(
        &self,
        start: Vector3,
        end: Vector3,
        is_wanted: impl FnMut(ContactTarget) -> bool,
    ) -> Option<RayHit3D> {
        let ray = Sweep::of_point(to_world(start), to_world(end - start))?;
        let (partner, (fraction, normal)) =
            self.first_entered(&ray, [start, end].map(|at| [at, at]), is_wanted)?;
        let point = to_world(ray.at(fraction));
        Some(RayHit3D { partner, point, normal: outward(normal), fraction })
    }

    /// Shape cast: the first target that a box of the world touches when it moves by `displacement`, px. Targets are
    /// listed geoms, platforms and the ground, unless the filter rejects them. `low` is the corner of the
    /// least X, Y and Z of the box at the start in px, `high` that of the greatest. Of several at one place
    /// platforms come first, then geoms in the order of their list, then the ground.
    ///
    /// The test is exact for tilted and sheared platforms, outlines, balls and upright shapes, with corners,
    /// edges and round sides. A target that overlaps the box at the start, such as the floor below a resting
    /// body, is hit only where the box enters it again. A surface parallel to the path is not hit; rounding
    /// decides for those not along the axes. Collision flags do not count, and disposed geoms are not hit.
    /// The result is `None` without a path, for numbers that are not finite, or if one of `low` exceeds that
    /// of `high`.
    ///
    /// Tests the AABB of every platform; the geoms come from the hash grid of the precise set, along the path up to
    /// its first hit. The filter is called only for targets that the box touches.
    ///
    /// ```
    /// use twohalf::{ContactTarget, Platform, TwoHalfPhysicsSimulator, Vector3};
    /// let mut simulator = TwoHalfPhysicsSimulator::new(480)?;
    /// let wall = Platform::new(&mut simulator, 10.0, 100.0, 60.0, Vector3::new(105.0, 0.0, 0.0), None)?;
    /// // 20 px wide, 50 high and 16 deep: how far does it come to the right?
    /// let (low, high) = (Vector3::new(-10.0, 1.0, -8.0), Vector3::new(10.0, 51.0, 8.0));
    /// let hit = simulator.sweep_box(low, high, Vector3::new(180.0, 0.0, 0.0), |_| true).unwrap();
    /// assert_eq!((hit.partner, hit.fraction), (ContactTarget::Platform(wall), 0.5));
    /// assert_eq!(hit.normal, Vector3::new(-1.0, 0.0, 0.0));
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    pub fn sweep_box(
        &self,
        low: Vector3,
        high: Vector3,
        displacement: Vector3,
        is_wanted: impl FnMut(ContactTarget) -> bool,
    ) -> Option<SweepHit3D> {
        if !(0..3).all(|axis| low[axis] <= high[axis]) {
            return None;
        }
        let sweep = Sweep::of_box(to_world((low + high) * 0.5), to_world(displacement), (high - low) * 0.5)?;
        let boxes = [[low, high], [low + displacement, high + displacement]];
        let (partner, (fraction, normal)) = self.first_entered(&sweep, boxes, is_wanted)?;
        Some(SweepHit3D { partner, normal: outward(normal), fraction })
    }

    /// Returns the first hit of a path among the targets whose AABBs overlap the box around the path; `None` without a hit.
    /// `boxes`: lowest and highest corners of the moved box at the start and at the end, in the world, px.
    fn first_entered(
        &self,
        sweep: &Sweep,
        boxes: [[Vector3; 2]; 2],
        mut is_wanted: impl FnMut(ContactTarget) -> bool,
    ) -> Option<(ContactTarget, Hit)> {
        let [[from_low, from_high], [to_low, to_high]] = boxes;
        let (low, high) = (from_low.inf(&to_low), from_high.sup(&to_high));
        let mut nearest: Option<(ContactTarget, Hit)> = None;
        // Of geoms at one place the one with the least number counts, and platforms come before geoms.
        let mut nearest_key = 0;
        // A geom may come twice; the filter is asked once.
        let mut rejected = Vec::new();
        let mut meet = |key: u64, partner: ContactTarget, entry: Option<Hit>| {
            let is_first = |entry: Hit| {
                nearest.is_none_or(|(_, other): (ContactTarget, Hit)| {
                    entry.0 < other.0 || entry.0 == other.0 && key < nearest_key
                })
            };
            if let Some(entry) = entry.filter(|&entry| is_first(entry) && !rejected.contains(&key)) {
                match is_wanted(partner) {
                    true => (nearest, nearest_key) = (Some((partner, entry)), key),
                    false => rejected.push(key),
                }
            }
            nearest.map_or(1.0, |(_, entry)| entry.0)
        };
        for (key, id) in (0..).zip(self.platforms_in_box(low, high, |_| true)) {
            let entry = self.platform(id).and_then(|view| sweep.entry_of_box(view.shape()));
            meet(key, ContactTarget::Platform(id), entry);
        }
        if is_box(low, high) {
            let path = DepthPath {
                start: [0, 2].map(|axis| 0.5 * from_low[axis] + 0.5 * from_high[axis]),
                end: [0, 2].map(|axis| 0.5 * to_low[axis] + 0.5 * to_high[axis]),
                half_extents: [0, 2].map(|axis| 0.5 * from_high[axis] - 0.5 * from_low[axis]),
            };
            let mut last = 1.0;
            self.for_each_geom_along(&path, |list_key, id| {
                if self.overlaps_box(id, low, high) {
                    last = meet(
                        GEOM_KEYS + u64::from(list_key),
                        ContactTarget::Geom(id),
                        self.entry_of(sweep, id),
                    );
                }
                // Fractions of hits are rounded.
                f64::from(last) + FRACTION_TOLERANCE
            });
        }
        meet(u64::MAX, ContactTarget::Ground, sweep.entry_of_ground());
        nearest
    }

    fn entry_of(&self, sweep: &Sweep, id: GeomId) -> Option<Hit> {
        let (geom, profile) = (self.core.geom(id)?, *self.world.depths.profiles.get(id)?);
        let z = self.world.depths.z_of(geom.body());
        if let Some(upright) = profile.upright() {
            let at = crate::depth::upright::middle(geom, self.core.body(geom.body())?, z);
            return sweep.clip_upright(&upright, at)?.entry();
        }
        if let DepthProfile::Round { radius } = profile {
            let centre = geom.position();
            return sweep.clip_ball(Vector3::new(centre.x, centre.y, z), radius)?.entry();
        }
        let pieces = ConvexPieces::new(geom.local_vertices());
        let mut corners = Vec::new();
        pieces.transform_into(&geom.matrix(), &mut corners);
        let half = profile.half_depth();
        let within = pieces.pieces(&corners).filter_map(|piece| sweep.clip_prism(piece, z, half));
        entry_of_parts(&within.collect::<Vec<_>>())
    }

    /// The platforms whose AABBs overlap or touch a box of the world, in the order of creation, with the
    /// filter and the conditions of [`query_box`](Self::query_box).
    pub fn platforms_in_box(
        &self,
        low: Vector3,
        high: Vector3,
        mut is_wanted: impl FnMut(PlatformId) -> bool,
    ) -> Vec<PlatformId> {
        if !is_box(low, high) {
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
