//! Footprint of a character: a rectangle or a disc in X and Z, and the area that it sweeps.

use farseer_core::SpaceFoot;

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
    /// The disc inside the rectangle; `None` for rectangular footprints.
    pub(super) round: Option<RoundFoot>,
    /// Radius of the lower hemisphere of a capsule, px; 0 for a flat sole.
    end: f32,
}

/// A disc swept from one place (X, Z) to another. Radius and places in px.
#[derive(Debug, Clone, Copy)]
pub(super) struct RoundFoot {
    pub(super) radius: f32,
    pub(super) from: [f32; 2],
    pub(super) to: [f32; 2],
}

impl RoundFoot {
    /// Corners of the rectangle that the disc sweeps between its ends; `None` without motion.
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

    /// The lower hemisphere as a sphere; `None` for a flat sole.
    pub(super) fn ball(&self) -> Option<EndSphere> {
        let round = self.round.filter(|_| self.end > 0.0)?;
        Some(EndSphere { radius: self.end, at: round.from })
    }

    /// The same footprint with a flat sole.
    pub(super) fn flat(&self) -> Self {
        CharacterFootprint { end: 0.0, ..*self }
    }

    /// The footprint of the part of the character below `height`, px above its lowest point. A hemisphere is
    /// narrower there.
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

    /// The area that the footprint sweeps along `way`.
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

    /// The footprint with its skin: a shape that only touches it overlaps this one.
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

    /// Whether the footprint overlaps the footprint of a box.
    pub(super) fn overlaps_box(&self, covered: &CharacterFootprint) -> bool {
        let span = self.span(covered.front, covered.back);
        span.is_some_and(|[left, right]| left < covered.right && covered.left < right)
    }

    pub(super) fn overlaps_depth(&self, front: f32, back: f32) -> bool {
        self.front < back && front < self.back
    }

    /// Least and greatest X of the footprint between two Z, px; `None` if it is outside of them.
    pub(super) fn span(&self, front: f32, back: f32) -> Option<[f32; 2]> {
        if !self.overlaps_depth(front, back) {
            return None;
        }
        let Some(round) = self.round else { return Some([self.left, self.right]) };
        let disc = |[x, z]: [f32; 2]| {
            let span = SpaceFoot::Disc(round.radius).span(front - z, back - z);
            span.map(|span| span.map(|end| end + x))
        };
        let between = round.between();
        let between = between.and_then(|corners| SpaceFoot::Polygon(&corners).span(front, back));
        let spans = [disc(round.from), disc(round.to), between];
        spans.into_iter().flatten().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
    }

    /// Highest point of a box above the footprint: height in px, Y up, and the upward component of the normal
    /// there.
    pub(super) fn roof(&self, shape: &SlantedBox) -> Option<(f32, f32)> {
        let Some(round) = self.round else {
            let corners = [
                [self.left, self.front],
                [self.right, self.front],
                [self.right, self.back],
                [self.left, self.back],
            ];
            return height_of(SpaceFoot::Polygon(&corners).roof([0.0; 2], shape));
        };
        let disc = |at: [f32; 2]| height_of(SpaceFoot::Disc(round.radius).roof(at, shape));
        let between = round.between();
        let between =
            between.and_then(|corners| height_of(SpaceFoot::Polygon(&corners).roof([0.0; 2], shape)));
        let all = [disc(round.from), disc(round.to), between];
        all.into_iter().flatten().reduce(|a, b| if b.0 > a.0 { b } else { a })
    }

    /// Whether the footprint overlaps another one whose origin is at `[x, z]`.
    pub(super) fn meets(&self, other: SpaceFoot<'_>, [x, z]: [f32; 2]) -> bool {
        let overlaps = |foot: SpaceFoot<'_>, [from_x, from_z]: [f32; 2]| {
            foot.gap(other, [x - from_x, z - from_z]).0 < 0.0
        };
        let Some(round) = self.round else {
            let (half_x, half_z) = (0.5 * (self.right - self.left), 0.5 * (self.back - self.front));
            let corners = [[-half_x, -half_z], [half_x, -half_z], [half_x, half_z], [-half_x, half_z]];
            return overlaps(SpaceFoot::Polygon(&corners), [self.left + half_x, self.front + half_z]);
        };
        let disc = SpaceFoot::Disc(round.radius);
        let between =
            || round.between().is_some_and(|between| overlaps(SpaceFoot::Polygon(&between), [0.0; 2]));
        overlaps(disc, round.from) || overlaps(disc, round.to) || between()
    }
}

fn height_of(found: Option<(f32, Vector3)>) -> Option<(f32, f32)> {
    found.map(|(y, out)| (-y, -out.y))
}
