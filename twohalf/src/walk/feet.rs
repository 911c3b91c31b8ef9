//! Where a figure stands: a rectangle of X and Z.

use crate::{Vector3, VirtualGeom};

/// Two that are no farther in each other than this only touch, px.
pub(super) const SKIN: f32 = 0.05;

#[derive(Debug, Clone, Copy)]
pub(super) struct Feet {
    pub(super) left: f32,
    pub(super) right: f32,
    pub(super) front: f32,
    pub(super) back: f32,
}

impl Feet {
    pub(super) fn of(geom: &VirtualGeom) -> Self {
        let [x, z] = [geom.right - geom.left, geom.back - geom.front].map(|size| SKIN.min(0.25 * size));
        Feet { left: geom.left + x, right: geom.right - x, front: geom.front + z, back: geom.back - z }
    }

    pub(super) fn moved(&self, way: Vector3) -> Self {
        Feet {
            left: self.left + way.x,
            right: self.right + way.x,
            front: self.front + way.z,
            back: self.back + way.z,
        }
    }

    /// All that is passed on the way.
    pub(super) fn swept(&self, way: Vector3) -> Self {
        let moved = self.moved(way);
        Feet {
            left: self.left.min(moved.left),
            right: self.right.max(moved.right),
            front: self.front.min(moved.front),
            back: self.back.max(moved.back),
        }
    }

    /// As they are: what only touches is within.
    pub(super) fn whole(&self) -> Self {
        self.widened(SKIN)
    }

    pub(super) fn widened(&self, margin: f32) -> Self {
        Feet {
            left: self.left - margin,
            right: self.right + margin,
            front: self.front - margin,
            back: self.back + margin,
        }
    }

    pub(super) fn meets(&self, other: &Feet) -> bool {
        self.left < other.right && other.left < self.right && self.meets_depth(other.front, other.back)
    }

    pub(super) fn meets_depth(&self, front: f32, back: f32) -> bool {
        self.front < back && front < self.back
    }
}
