//! One contact of a block of four.

use crate::precise::tuning::Learning;

#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(in crate::precise) struct PointLane {
    pub(in crate::precise) arm_a: f32,
    pub(in crate::precise) arm_b: f32,
    pub(in crate::precise) mass: f32,
    pub(in crate::precise) impulse: f32,
    pub(in crate::precise) separation: f32,
    pub(in crate::precise) held: f32,
}

/// One row.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(in crate::precise) struct Lane {
    pub(in crate::precise) a: u32,
    pub(in crate::precise) b: u32,
    pub(in crate::precise) pair: u32,
    pub(in crate::precise) normal: [f32; 2],
    pub(in crate::precise) inverse_masses: [f32; 2],
    pub(in crate::precise) inverse_inertias: [f32; 2],
    pub(in crate::precise) friction: f32,
    pub(in crate::precise) tangent_arms: [f32; 2],
    pub(in crate::precise) tangent_mass: f32,
    pub(in crate::precise) tangent_impulse: f32,
    pub(in crate::precise) tangent_speed: f32,
    pub(in crate::precise) restitution: f32,
    pub(in crate::precise) points: [PointLane; 2],
    pub(in crate::precise) space: SpaceLane,
}

/// What a row in three axes has beside that.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(in crate::precise) struct SpaceLane {
    pub(in crate::precise) normal_z: f32,
    /// Arms about the depth axis of the second tangent.
    pub(in crate::precise) across_arms: [f32; 2],
    /// Radii of balls; 0 for what is none.
    pub(in crate::precise) radii: [f32; 2],
    pub(in crate::precise) across_impulse: f32,
    pub(in crate::precise) across_speed: f32,
    /// How far from the middle of the contact its pressure is, where that is a face along the depth axis; else 0.
    pub(in crate::precise) spread: f32,
    pub(in crate::precise) twist_impulse: f32,
    /// Impulses of the whole step: of the points, and of both tangents.
    pub(in crate::precise) totals: [f32; 4],
}

impl Lane {
    /// The mass that is met at a point, as arms and reciprocals of mass and inertia are now.
    pub(in crate::precise) fn weight(&self, point: &PointLane) -> f32 {
        let ([mass_a, mass_b], [inertia_a, inertia_b]) = (self.inverse_masses, self.inverse_inertias);
        let turning = inertia_a * point.arm_a * point.arm_a + inertia_b * point.arm_b * point.arm_b;
        1.0 / (mass_a + mass_b + turning)
    }

    /// Whether the springs of its points are on their way to rest at more of their load.
    pub(in crate::precise) fn is_learning(&self, learning: &Learning) -> bool {
        let [one, two] = &self.points;
        let deepest = one.separation.min(two.separation);
        learning.learnt * (one.impulse + two.impulse) > one.held + two.held
            && deepest < 0.0
            && deepest > learning.deepest
    }
}
