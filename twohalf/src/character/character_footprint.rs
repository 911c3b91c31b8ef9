//! Footprint of a character: a rectangle or a disc in X and Z, and the area that it sweeps.

use farseer_precise::depth::shape_distance::DepthQueryFootprint;

use super::capsule_ground::EndSphere;
use crate::shapes::SlantedBox;
use crate::{DepthProfile, Vector3, VirtualGeom};

/// Penetration up to which two shapes count as touching only, px.
pub(super) const FOOTPRINT_SKIN: f32 = 0.05;

#[derive(Debug, Clone, Copy)]
pub(super) struct CharacterFootprint {
    pub(super) left: f32,
    pub(super) right: f32,
    pub(super) front: f32,
    pub(super) back: f32,
    /// Disc inside of the footprint's rectangle; `None` for a rectangular footprint.
    pub(super) round: Option<RoundFoot>,
    /// Radius of the lower hemisphere of a capsule, px; 0 for a flat sole.
    end: f32,
}

/// Disc that is swept from one position (X, Z) to another one. Radius and positions are in px.
#[derive(Debug, Clone, Copy)]
pub(super) struct RoundFoot {
    pub(super) radius: f32,
    pub(super) from: [f32; 2],
    pub(super) to: [f32; 2],
}

impl RoundFoot {
    /// Returns the corners (X, Z in px) of the rectangle that the disc sweeps between the two ends of its path; `None` without
    /// motion.
    fn between(&self) -> Option<[[f32; 2]; 4]> {
        let way = [0, 1].map(|axis| self.to[axis] - self.from[axis]);
        let length = (way[0] * way[0] + way[1] * way[1]).sqrt();
        if length.is_nan() || length <= 0.0 {
            return None;
        }
        let aside = [-way[1], way[0]].map(|part| part * (self.radius / length));
        let corner = |at: [f32; 2], side: f32| [0, 1].map(|axis| at[axis] + side * aside[axis]);
        Some([corner(self.from, -1.0), corner(self.to, -1.0), corner(self.to, 1.0), corner(self.from, 1.0)])
    }
}

impl CharacterFootprint {
    pub(super) fn of(geom: &VirtualGeom, profile: DepthProfile) -> Self {
        let [x, z] =
            [geom.right - geom.left, geom.back - geom.front].map(|size| FOOTPRINT_SKIN.min(0.25 * size));
        let footprint = CharacterFootprint {
            left: geom.left + x,
            right: geom.right - x,
            front: geom.front + z,
            back: geom.back - z,
            round: None,
            end: if let DepthProfile::Capsule { radius, .. } = profile { radius } else { 0.0 },
        };
        let is_round = matches!(profile, DepthProfile::Cylinder { .. } | DepthProfile::Capsule { .. });
        let middle = [0.5 * (footprint.left + footprint.right), 0.5 * (footprint.front + footprint.back)];
        let round = RoundFoot { radius: 0.5 * (footprint.right - footprint.left), from: middle, to: middle };
        CharacterFootprint { round: is_round.then_some(round), ..footprint }
    }

    pub(super) fn rectangle(left: f32, right: f32, front: f32, back: f32) -> Self {
        CharacterFootprint { left, right, front, back, round: None, end: 0.0 }
    }

    /// Returns the lower hemisphere of the character as a sphere; `None` for a flat sole.
    pub(super) fn ball(&self) -> Option<EndSphere> {
        let round = self.round.filter(|_| self.end > 0.0)?;
        Some(EndSphere { radius: self.end, at: round.from })
    }

    /// Returns this footprint with a flat sole instead of a hemisphere.
    pub(super) fn flat(&self) -> Self {
        CharacterFootprint { end: 0.0, ..*self }
    }

    /// Returns the footprint of the part of the character below `height`, which is in px above the lowest point of the
    /// character. The part of a hemisphere is narrower than the character.
    pub(super) fn up_to(&self, height: f32) -> Self {
        let Some(round) = self.round.filter(|_| height < self.end) else { return *self };
        let height = height.max(0.0);
        let radius = (height * (2.0 * self.end - height)).sqrt().min(round.radius);
        self.widened(radius - round.radius)
    }

    pub(super) fn moved(&self, way: Vector3) -> Self {
        let moved = |at: [f32; 2]| [at[0] + way.x, at[1] + way.z];
        CharacterFootprint {
            left: self.left + way.x,
            right: self.right + way.x,
            front: self.front + way.z,
            back: self.back + way.z,
            round: self.round.map(|round| RoundFoot {
                from: moved(round.from),
                to: moved(round.to),
                ..round
            }),
            end: self.end,
        }
    }

    /// Returns the footprint of the area that this footprint sweeps along the displacement `way`, px.
    pub(super) fn swept(&self, way: Vector3) -> Self {
        let moved = self.moved(way);
        CharacterFootprint {
            left: self.left.min(moved.left),
            right: self.right.max(moved.right),
            front: self.front.min(moved.front),
            back: self.back.max(moved.back),
            round: self.round.zip(moved.round).map(|(from, to)| RoundFoot { to: to.to, ..from }),
            end: self.end,
        }
    }

    /// Returns the footprint enlarged by `FOOTPRINT_SKIN`, so that it overlaps each shape that touches the original footprint.
    pub(super) fn whole(&self) -> Self {
        self.widened(FOOTPRINT_SKIN)
    }

    pub(super) fn widened(&self, margin: f32) -> Self {
        CharacterFootprint {
            left: self.left - margin,
            right: self.right + margin,
            front: self.front - margin,
            back: self.back + margin,
            round: self.round.map(|round| RoundFoot { radius: round.radius + margin, ..round }),
            end: self.end,
        }
    }

    /// Returns whether this footprint overlaps the footprint `covered` of a box.
    pub(super) fn overlaps_box(&self, covered: &CharacterFootprint) -> bool {
        let span = self.span(covered.front, covered.back);
        span.is_some_and(|[left, right]| left < covered.right && covered.left < right)
    }

    pub(super) fn overlaps_depth(&self, front: f32, back: f32) -> bool {
        self.front < back && front < self.back
    }

    /// Least and greatest X of the footprint between two Z, px; `None` if no part of the footprint lies between them.
    pub(super) fn span(&self, front: f32, back: f32) -> Option<[f32; 2]> {
        if !self.overlaps_depth(front, back) {
            return None;
        }
        let Some(round) = self.round else { return Some([self.left, self.right]) };
        let disc = |[x, z]: [f32; 2]| {
            let span = DepthQueryFootprint::Disc(round.radius).x_range(front - z, back - z);
            span.map(|span| span.map(|end| end + x))
        };
        let between = round.between();
        let between = between.and_then(|corners| DepthQueryFootprint::Polygon(&corners).x_range(front, back));
        let spans = [disc(round.from), disc(round.to), between];
        spans.into_iter().flatten().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
    }

    /// Returns the highest point of a box within the footprint: height in px, Y up, and upward component of the unit normal
    /// there. `None` if footprint and box do not overlap in X and Z.
    pub(super) fn roof(&self, shape: &SlantedBox) -> Option<(f32, f32)> {
        let Some(round) = self.round else {
            let corners = [
                [self.left, self.front],
                [self.right, self.front],
                [self.right, self.back],
                [self.left, self.back],
            ];
            return height_of(DepthQueryFootprint::Polygon(&corners).top_surface([0.0; 2], shape));
        };
        let disc = |at: [f32; 2]| height_of(DepthQueryFootprint::Disc(round.radius).top_surface(at, shape));
        let between = round.between();
        let between = between.and_then(|corners| {
            height_of(DepthQueryFootprint::Polygon(&corners).top_surface([0.0; 2], shape))
        });
        let all = [disc(round.from), disc(round.to), between];
        all.into_iter().flatten().reduce(|a, b| if b.0 > a.0 { b } else { a })
    }

    /// Returns whether this footprint overlaps the footprint `other`, whose origin is at `[x, z]` in the world, px.
    pub(super) fn meets(&self, other: DepthQueryFootprint<'_>, [x, z]: [f32; 2]) -> bool {
        let overlaps = |foot: DepthQueryFootprint<'_>, [from_x, from_z]: [f32; 2]| {
            foot.distance_to(other, [x - from_x, z - from_z]).0 < 0.0
        };
        let Some(round) = self.round else {
            let (half_x, half_z) = (0.5 * (self.right - self.left), 0.5 * (self.back - self.front));
            let corners = [[-half_x, -half_z], [half_x, -half_z], [half_x, half_z], [-half_x, half_z]];
            return overlaps(
                DepthQueryFootprint::Polygon(&corners),
                [self.left + half_x, self.front + half_z],
            );
        };
        let disc = DepthQueryFootprint::Disc(round.radius);
        let between = || {
            round.between().is_some_and(|between| overlaps(DepthQueryFootprint::Polygon(&between), [0.0; 2]))
        };
        overlaps(disc, round.from) || overlaps(disc, round.to) || between()
    }
}

fn height_of(found: Option<(f32, Vector3)>) -> Option<(f32, f32)> {
    found.map(|(y, out)| (-y, -out.y))
}
