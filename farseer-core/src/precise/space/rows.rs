//! Contacts in three axes, four side by side: those of the plane, with a part of the normal along the depth axis, and friction
//! along two tangents.
//!
//! With n the normal from A to B, the first tangent t lies in the plane, (n.y, -n.x) made a unit vector, and the second is
//! n x t; where n is the depth axis itself, t is the x axis. What is no ball turns about the depth axis alone, so that its arms
//! are (r x t).z. A ball of radius R, of which n is the way to or from its middle, turns about all axes: as B, with r = -R n,
//! an impulse f t + g (n x t) turns it by -R (f (n x t) - g t); as A, with r = R n and the opposite impulse, by the same.

use wide::f32x4;

use crate::precise::rows::{Block, Contacts, Lane, Point, Row, SpaceLane, get, set};

/// Four contacts in three axes.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::precise) struct SpaceRow<const P: usize> {
    /// The part in the plane; its tangent is the first one.
    pub(super) row: Row<P>,
    pub(super) normal_z: f32x4,
    /// The first tangent, whose part along the depth axis is 0, and the second.
    pub(super) tangent: [f32x4; 2],
    pub(super) across: [f32x4; 3],
    /// Arms of the second tangent.
    pub(super) across_arm_a: f32x4,
    pub(super) across_arm_b: f32x4,
    /// Radii of balls; 0 for what is none.
    pub(super) radius_a: f32x4,
    pub(super) radius_b: f32x4,
    /// What turns a velocity along the tangents into the impulse that ends it: a symmetric block. And what does so, at least
    /// in part, in any direction.
    pub(super) block: [f32x4; 3],
    pub(super) slide_mass: f32x4,
    pub(super) across_impulse: f32x4,
    pub(super) across_speed: f32x4,
    /// How far from the middle of a face along the depth axis its pressure is; friction there also ends turning.
    pub(super) spread: f32x4,
    pub(super) twist_mass: f32x4,
    pub(super) twist_impulse: f32x4,
    /// Impulses of the whole step so far: of two points, and of both tangents.
    pub(super) totals: [f32x4; 4],
}

/// The first tangent of a normal, and the second.
pub(in crate::precise) fn tangents([x, y, z]: [f32; 3]) -> ([f32; 2], [f32; 3]) {
    let squared = x * x + y * y;
    let tangent = if squared > 1e-12 {
        let length = squared.sqrt();
        [y / length, -x / length]
    } else {
        [1.0, 0.0]
    };
    (tangent, [-z * tangent[1], z * tangent[0], x * tangent[1] - y * tangent[0]])
}

/// The reciprocal of a symmetric block [[a, b], [b, c]], and the reciprocal of the greatest velocity that a unit of impulse
/// gives.
fn solved([a, b, c]: [f32; 3]) -> ([f32; 3], f32) {
    let determinant = a * c - b * b;
    if determinant <= 1e-9 * a * c {
        let one = |of: f32| if of > 0.0 { 1.0 / of } else { 0.0 };
        let greatest = a + c;
        return ([one(greatest), 0.0, one(greatest)], one(greatest));
    }
    let inverse = 1.0 / determinant;
    // Between the greater of the diagonal and their sum.
    let middle = 0.5 * (a + c);
    let greatest = middle + (middle * middle - determinant).max(0.0).sqrt();
    ([c * inverse, -b * inverse, a * inverse], 1.0 / greatest)
}

impl<const P: usize> SpaceRow<P> {
    /// What follows from the numbers of a row.
    fn derive(&mut self, at: usize, lane: &Lane) {
        let SpaceLane { normal_z, across_arms, radii, .. } = lane.space;
        let (tangent, across) = tangents([lane.normal[0], lane.normal[1], normal_z]);
        let [ia, ib] = lane.inverse_inertias;
        let along = |one: [f32; 2], other: [f32; 2]| ia * one[0] * other[0] + ib * one[1] * other[1];
        let round = ia * radii[0] * radii[0] + ib * radii[1] * radii[1];
        let mass = lane.inverse_masses[0] + lane.inverse_masses[1];
        let (block, slide_mass) = solved([
            mass + along(lane.tangent_arms, lane.tangent_arms)
                + round * (across[0] * across[0] + across[1] * across[1]),
            along(lane.tangent_arms, across_arms) - round * (across[0] * tangent[0] + across[1] * tangent[1]),
            mass + along(across_arms, across_arms)
                + round * (tangent[0] * tangent[0] + tangent[1] * tangent[1]),
        ]);
        let turns = ia + ib;
        self.tangent.iter_mut().zip(tangent).for_each(|(lanes, of)| set(lanes, at, of));
        self.across.iter_mut().zip(across).for_each(|(lanes, of)| set(lanes, at, of));
        self.block.iter_mut().zip(block).for_each(|(lanes, of)| set(lanes, at, of));
        set(&mut self.slide_mass, at, slide_mass);
        set(&mut self.twist_mass, at, if turns > 0.0 { 1.0 / turns } else { 0.0 });
    }
}

impl<const P: usize> SpaceRow<P> {
    /// Adds the impulses of a substep, or takes them away again, to those of the step.
    #[inline(always)]
    pub(super) fn count(&mut self, add: impl Fn(f32x4, f32x4) -> f32x4) {
        for (total, point) in self.totals.iter_mut().zip(&self.row.points) {
            *total = add(*total, point.impulse);
        }
        self.totals[2] = add(self.totals[2], self.row.tangent_impulse);
        self.totals[3] = add(self.totals[3], self.across_impulse);
    }
}

impl<const P: usize> Block for SpaceRow<P> {
    fn lane(&self, at: usize) -> Lane {
        let space = SpaceLane {
            normal_z: get(&self.normal_z, at),
            across_arms: [get(&self.across_arm_a, at), get(&self.across_arm_b, at)],
            radii: [get(&self.radius_a, at), get(&self.radius_b, at)],
            across_impulse: get(&self.across_impulse, at),
            across_speed: get(&self.across_speed, at),
            spread: get(&self.spread, at),
            twist_impulse: get(&self.twist_impulse, at),
            totals: self.totals.map(|total| get(&total, at)),
        };
        Lane { space, ..self.row.lane(at) }
    }

    fn set_lane(&mut self, at: usize, lane: &Lane) {
        self.row.set_lane(at, lane);
        let space = &lane.space;
        set(&mut self.normal_z, at, space.normal_z);
        set(&mut self.across_arm_a, at, space.across_arms[0]);
        set(&mut self.across_arm_b, at, space.across_arms[1]);
        set(&mut self.radius_a, at, space.radii[0]);
        set(&mut self.radius_b, at, space.radii[1]);
        set(&mut self.across_impulse, at, space.across_impulse);
        set(&mut self.across_speed, at, space.across_speed);
        set(&mut self.spread, at, space.spread);
        set(&mut self.twist_impulse, at, space.twist_impulse);
        self.totals.iter_mut().zip(space.totals).for_each(|(lanes, of)| set(lanes, at, of));
        self.derive(at, lane);
    }

    fn pairs(&mut self) -> &mut [u32; 4] {
        self.row.pairs()
    }

    fn points(&mut self) -> &mut [Point] {
        self.row.points()
    }
}

impl<const P: usize> Contacts<P> for SpaceRow<P> {
    const IN_SPACE: bool = true;

    #[inline(always)]
    fn row(&self) -> &Row<P> {
        &self.row
    }

    #[inline(always)]
    fn row_mut(&mut self) -> &mut Row<P> {
        &mut self.row
    }

    #[inline(always)]
    fn normal_z(&self) -> f32x4 {
        self.normal_z
    }
}

#[cfg(test)]
mod tests {
    use super::{solved, tangents};

    #[test]
    fn normal_and_tangents_stand_upright_on_each_other() {
        for normal in [[0.0, -1.0, 0.0], [0.6, 0.0, 0.8], [0.0, 0.0, -1.0], [0.48, -0.6, 0.64]] {
            let ([tx, ty], across) = tangents(normal);
            let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            let all = [normal, [tx, ty, 0.0], across];
            for (i, &one) in all.iter().enumerate() {
                for (j, &other) in all.iter().enumerate() {
                    let expected = if i == j { 1.0 } else { 0.0 };
                    assert!((dot(one, other) - expected).abs() < 1e-6, "{normal:?}");
                }
            }
        }
    }

    #[test]
    fn a_block_times_its_reciprocal_is_one() {
        let ([a, b, c], greatest) = solved([3.0, 1.0, 2.0]);
        let close = |one: f32, other: f32| (one - other).abs() < 1e-6;
        assert!(close(3.0 * a + b, 1.0) && close(3.0 * b + c, 0.0) && close(a + 2.0 * b, 0.0));
        // The eigenvalues are (5 +- sqrt 5) / 2.
        assert!(close(greatest, 2.0 / (5.0 + 5.0_f32.sqrt())));
    }
}
