//! What a ray through the world enters, in three axes.

use farseer_core::{GeomId, SpaceUpright};

use crate::projection::to_world;
use crate::shapes::{ConvexPieces, Face, SlantedBox};
use crate::{DepthProfile, Partner, PlatformId, TwoHalfPhysicsSimulator, Vector2, Vector3};

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

/// Part of the way at which something is entered, and the direction outward there, y down.
type Entry = (f32, Vector3);

/// Parts of an outline that are no farther apart than this part of a ray are one.
const SEAM: f32 = 1e-5;

/// A ray in the frame of the plane, y down.
#[derive(Debug, Clone, Copy)]
struct Ray {
    start: Vector3,
    way: Vector3,
}

/// The part of a ray that is inside of all half spaces so far.
#[derive(Debug, Clone, Copy)]
struct Inside {
    entered: f32,
    left: f32,
    normal: Vector3,
}

impl Inside {
    fn new() -> Self {
        Inside { entered: f32::NEG_INFINITY, left: f32::INFINITY, normal: Vector3::zeros() }
    }

    /// Inside of one more half space: how far the start is outside of it, how fast that grows along the way, and its normal.
    fn cut(mut self, distance: f32, rate: f32, normal: Vector3) -> Option<Self> {
        if rate == 0.0 {
            return (distance <= 0.0).then_some(self);
        }
        let fraction = -distance / rate;
        if rate > 0.0 {
            self.left = self.left.min(fraction);
        } else if fraction > self.entered {
            (self.entered, self.normal) = (fraction, normal);
        }
        (self.entered <= self.left).then_some(self)
    }

    /// Whether the ray comes out of this part of something right into another one.
    fn joins(&self, next: &Inside) -> bool {
        self.entered < next.entered && self.left >= next.entered - SEAM
    }

    /// Where the ray enters on its way, if it does not start inside.
    fn entry(self) -> Option<Entry> {
        (0.0..=1.0).contains(&self.entered).then_some((self.entered, self.normal))
    }
}

impl Ray {
    /// `None` for one that ends where it starts, or is not finite.
    fn new(start: Vector3, end: Vector3) -> Option<Self> {
        let (start, end) = (to_world(start), to_world(end));
        let way = end - start;
        let length = way.norm_squared();
        (start.iter().all(|number| number.is_finite()) && length > 0.0 && length.is_finite())
            .then_some(Ray { start, way })
    }

    fn cut(&self, inside: Inside, normal: Vector3, on_plane: Vector3) -> Option<Inside> {
        inside.cut((self.start - on_plane).dot(&normal), self.way.dot(&normal), normal)
    }

    fn entry_of_ball(&self, centre: Vector3, radius: f32) -> Option<Entry> {
        let from = self.start - centre;
        let (a, b) = (self.way.norm_squared(), from.dot(&self.way));
        let c = from.norm_squared() - radius * radius;
        let root = b * b - a * c;
        if !(b < 0.0 && c >= 0.0 && root >= 0.0) {
            return None;
        }
        let fraction = c / (root.sqrt() - b);
        let normal = (from + self.way * fraction) / radius;
        (fraction <= 1.0).then_some((fraction, normal))
    }

    /// What of the ray is within a radius of a line along y or of a point.
    fn inside_round(&self, centre: Vector3, radius: f32, is_line: bool) -> Option<Inside> {
        let level = |v: Vector3| if is_line { Vector3::new(v.x, 0.0, v.z) } else { v };
        let (from, way) = (level(self.start - centre), level(self.way));
        let (a, b, c) = (way.norm_squared(), from.dot(&way), from.norm_squared() - radius * radius);
        if a == 0.0 {
            return (c <= 0.0).then(Inside::new);
        }
        let root = b * b - a * c;
        if root < 0.0 {
            return None;
        }
        // The one of both that adds no two numbers of different signs is exact, and their product is c / a.
        let sum = if b < 0.0 { root.sqrt() - b } else { -root.sqrt() - b };
        let (one, other) = (sum / a, if sum == 0.0 { 0.0 } else { c / sum });
        let (entered, left) = if one < other { (one, other) } else { (other, one) };
        Some(Inside { entered, left, normal: (from + way * entered) / radius })
    }

    /// Between two heights as well.
    fn between(&self, inside: Inside, middle: f32, half: f32) -> Option<Inside> {
        let [up, down] = [-1.0, 1.0].map(|side| Vector3::new(0.0, side, 0.0));
        let inside = self.cut(inside, up, Vector3::new(0.0, middle - half, 0.0))?;
        self.cut(inside, down, Vector3::new(0.0, middle + half, 0.0))
    }

    fn inside_upright(&self, shape: &SpaceUpright, at: Vector3) -> Option<Inside> {
        match *shape {
            SpaceUpright::Cylinder { radius, half_height } => {
                self.between(self.inside_round(at, radius, true)?, at.y, half_height)
            }
            SpaceUpright::Capsule { radius, half_height } => {
                let half = half_height - radius;
                let side = self.inside_round(at, radius, true);
                let side = side.and_then(|side| self.between(side, at.y, half));
                let [one, other] = [-half, half]
                    .map(|end| self.inside_round(at + Vector3::new(0.0, end, 0.0), radius, false));
                // All three are one: it is entered where the first of them is, and left where the last is.
                let parts = [side, one, other].into_iter().flatten();
                parts.reduce(|a, b| {
                    let first = if b.entered < a.entered { b } else { a };
                    Inside { left: a.left.max(b.left), ..first }
                })
            }
            SpaceUpright::Prism { footprint, half_height } => {
                let corners = footprint.corners();
                let mut inside = self.between(Inside::new(), at.y, half_height)?;
                for (number, &corner) in corners.iter().enumerate() {
                    let edge = corners[(number + 1) % corners.len()] - corner;
                    let out = Vector3::new(edge.y, 0.0, -edge.x) / edge.norm();
                    inside = self.cut(inside, out, at + Vector3::new(corner.x, 0.0, corner.y))?;
                }
                Some(inside)
            }
        }
    }

    fn inside_prism(&self, piece: &[Vector2], z: f32, half: f32) -> Option<Inside> {
        if piece.len() < 3 {
            return None;
        }
        let [front, back] = [-1.0, 1.0].map(|side| Vector3::new(0.0, 0.0, side));
        let mut inside = self.cut(Inside::new(), front, Vector3::new(0.0, 0.0, z - half))?;
        inside = self.cut(inside, back, Vector3::new(0.0, 0.0, z + half))?;
        for (at, &a) in piece.iter().enumerate() {
            let edge = piece[(at + 1) % piece.len()] - a;
            // Outward of pieces whose shoelace area is negative.
            let normal = Vector3::new(-edge.y, edge.x, 0.0) / edge.norm();
            inside = self.cut(inside, normal, Vector3::new(a.x, a.y, 0.0))?;
        }
        Some(inside)
    }

    fn entry_of_box(&self, shape: &SlantedBox) -> Option<Entry> {
        let faces = Face::SIDES.into_iter().chain([Face::Front, Face::Back]);
        let all = faces.into_iter().try_fold(Inside::new(), |inside, face| {
            let normal = shape.face_normal(face);
            inside.cut(shape.distance_to_face(face, self.start), self.way.dot(&normal), normal)
        });
        all?.entry()
    }
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
        mut is_wanted: impl FnMut(Partner) -> bool,
    ) -> Option<RayHit3D> {
        let ray = Ray::new(start, end)?;
        let (low, high) = (start.inf(&end), start.sup(&end));
        let platforms =
            self.world.platforms.iter().filter_map(|(id, platform)| {
                Some((Partner::Platform(id), ray.entry_of_box(platform.shape())?))
            });
        let near = self.query_box(low, high, |_| true);
        let geoms = near.into_iter().filter_map(|id| Some((Partner::Geom(id), self.entry_of(&ray, id)?)));
        let up = Vector3::new(0.0, -1.0, 0.0);
        let ground = ray.cut(Inside::new(), up, Vector3::zeros()).and_then(Inside::entry);
        let ground = ground.map(|entry| (Partner::Ground, entry));
        let hits = platforms.chain(geoms).chain(ground).filter(|(partner, _)| is_wanted(*partner));
        let nearest = hits.reduce(|nearest, hit| if hit.1.0 < nearest.1.0 { hit } else { nearest });
        nearest.map(|(partner, (fraction, normal))| RayHit3D {
            partner,
            point: to_world(ray.start + ray.way * fraction),
            normal: to_world(normal),
            fraction,
        })
    }

    fn entry_of(&self, ray: &Ray, id: GeomId) -> Option<Entry> {
        let (geom, profile) = (self.core.geom(id)?, *self.world.depths.profiles.get(id)?);
        let z = self.world.depths.z_of(geom.body());
        if let Some(upright) = profile.upright() {
            let at = crate::depth::upright::middle(geom, self.core.body(geom.body())?, z);
            return ray.inside_upright(&upright, at)?.entry();
        }
        if let DepthProfile::Round { radius } = profile {
            let centre = geom.position();
            return ray.entry_of_ball(Vector3::new(centre.x, centre.y, z), radius);
        }
        let pieces = ConvexPieces::new(geom.local_vertices());
        let mut corners = Vec::new();
        pieces.lay_out(&geom.matrix(), &mut corners);
        let half = profile.half_depth();
        let within = pieces.pieces(&corners).filter_map(|piece| ray.inside_prism(piece, z, half));
        let within: Vec<Inside> = within.collect();
        let entries = within.iter().filter(|part| !within.iter().any(|other| other.joins(part)));
        let entries = entries.filter_map(|part| part.entry());
        entries.reduce(|first, entry| if entry.0 < first.0 { entry } else { first })
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
