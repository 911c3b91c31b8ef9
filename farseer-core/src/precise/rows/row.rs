//! Four contacts side by side, of which each is a [`Lane`].

use wide::f32x4;

use super::lane::{Lane, PointLane, SpaceLane};

/// One contact point of four rows.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::precise) struct Point {
    /// Arms of the normal about the bodies' origins: r x n.
    pub(in crate::precise) arm_a: f32x4,
    pub(in crate::precise) arm_b: f32x4,
    /// What one unit of velocity along the normal weighs.
    pub(in crate::precise) mass: f32x4,
    /// Impulse of a substep, 0 or more.
    pub(in crate::precise) impulse: f32x4,
    /// Distance of the outlines, kept up while the bodies move.
    pub(in crate::precise) separation: f32x4,
    /// The impulse at which the contact's spring rests: what it has learnt of its load.
    pub(in crate::precise) held: f32x4,
}

impl Point {
    #[inline(always)]
    pub(in crate::precise) fn arms(&self) -> [f32x4; 2] {
        [self.arm_a, self.arm_b]
    }
}

/// Four contacts with at most `P` points each.
#[derive(Debug, Clone, Copy)]
pub(in crate::precise) struct Row<const P: usize> {
    pub(in crate::precise) a: [u32; 4],
    pub(in crate::precise) b: [u32; 4],
    pub(in crate::precise) pair: [u32; 4],
    pub(in crate::precise) normal_x: f32x4,
    pub(in crate::precise) normal_y: f32x4,
    pub(in crate::precise) inverse_mass_a: f32x4,
    pub(in crate::precise) inverse_mass_b: f32x4,
    pub(in crate::precise) inverse_inertia_a: f32x4,
    pub(in crate::precise) inverse_inertia_b: f32x4,
    /// One friction row for both points, in their middle, along (normal y, -normal x).
    pub(in crate::precise) friction: f32x4,
    pub(in crate::precise) tangent_arm_a: f32x4,
    pub(in crate::precise) tangent_arm_b: f32x4,
    pub(in crate::precise) tangent_mass: f32x4,
    pub(in crate::precise) tangent_impulse: f32x4,
    /// Speed of B against A along the tangent that friction aims at: belts.
    pub(in crate::precise) tangent_speed: f32x4,
    pub(in crate::precise) restitution: f32x4,
    /// Velocities along the normal and separations when the step began, and whether a point has pushed since: what
    /// restitution asks for.
    pub(in crate::precise) approach: [f32x4; P],
    pub(in crate::precise) gap: [f32x4; P],
    pub(in crate::precise) has_pushed: [f32x4; P],
    pub(in crate::precise) points: [Point; P],
}

impl<const P: usize> Default for Row<P> {
    fn default() -> Self {
        Row {
            a: [0; 4],
            b: [0; 4],
            pair: [0; 4],
            normal_x: f32x4::ZERO,
            normal_y: f32x4::ZERO,
            inverse_mass_a: f32x4::ZERO,
            inverse_mass_b: f32x4::ZERO,
            inverse_inertia_a: f32x4::ZERO,
            inverse_inertia_b: f32x4::ZERO,
            friction: f32x4::ZERO,
            tangent_arm_a: f32x4::ZERO,
            tangent_arm_b: f32x4::ZERO,
            tangent_mass: f32x4::ZERO,
            tangent_impulse: f32x4::ZERO,
            tangent_speed: f32x4::ZERO,
            restitution: f32x4::ZERO,
            approach: [f32x4::ZERO; P],
            gap: [f32x4::ZERO; P],
            has_pushed: [f32x4::ZERO; P],
            points: [Point::default(); P],
        }
    }
}

/// Four rows side by side, of whatever kind.
pub(in crate::precise) trait Block: Copy + Default {
    fn lane(&self, at: usize) -> Lane;
    fn set_lane(&mut self, at: usize, lane: &Lane);
    fn pairs(&mut self) -> &mut [u32; 4];
    fn points(&mut self) -> &mut [Point];
}

/// Four contacts as the passes see them: in the plane, or in three axes.
pub(in crate::precise) trait Contacts<const P: usize>: Block {
    /// Whether the bodies move along the depth axis as well.
    const IN_SPACE: bool;

    fn row(&self) -> &Row<P>;
    fn row_mut(&mut self) -> &mut Row<P>;
    /// Part of the normal along the depth axis.
    fn normal_z(&self) -> f32x4;
}

impl<const P: usize> Contacts<P> for Row<P> {
    const IN_SPACE: bool = false;

    #[inline(always)]
    fn row(&self) -> &Row<P> {
        self
    }

    #[inline(always)]
    fn row_mut(&mut self) -> &mut Row<P> {
        self
    }

    #[inline(always)]
    fn normal_z(&self) -> f32x4 {
        f32x4::ZERO
    }
}

#[inline(always)]
pub(in crate::precise) fn get(of: &f32x4, lane: usize) -> f32 {
    of.as_array()[lane]
}

#[inline(always)]
pub(in crate::precise) fn set(of: &mut f32x4, lane: usize, value: f32) {
    of.as_mut_array()[lane] = value;
}

/// The points of one of four rows.
#[inline(always)]
pub(in crate::precise) fn points_at<const P: usize>(points: &[Point; P], at: usize) -> [PointLane; 2] {
    let mut lanes = [PointLane::default(); 2];
    for (lane, point) in lanes.iter_mut().zip(points) {
        *lane = PointLane {
            arm_a: get(&point.arm_a, at),
            arm_b: get(&point.arm_b, at),
            mass: get(&point.mass, at),
            impulse: get(&point.impulse, at),
            separation: get(&point.separation, at),
            held: get(&point.held, at),
        };
    }
    lanes
}

#[inline(always)]
pub(in crate::precise) fn set_points_at<const P: usize>(
    points: &mut [Point; P],
    at: usize,
    lanes: &[PointLane; 2],
) {
    for (point, from) in points.iter_mut().zip(lanes) {
        set(&mut point.arm_a, at, from.arm_a);
        set(&mut point.arm_b, at, from.arm_b);
        set(&mut point.mass, at, from.mass);
        set(&mut point.impulse, at, from.impulse);
        set(&mut point.separation, at, from.separation);
        set(&mut point.held, at, from.held);
    }
}

impl<const P: usize> Block for Row<P> {
    fn lane(&self, at: usize) -> Lane {
        Lane {
            a: self.a[at],
            b: self.b[at],
            pair: self.pair[at],
            normal: [get(&self.normal_x, at), get(&self.normal_y, at)],
            inverse_masses: [get(&self.inverse_mass_a, at), get(&self.inverse_mass_b, at)],
            inverse_inertias: [get(&self.inverse_inertia_a, at), get(&self.inverse_inertia_b, at)],
            friction: get(&self.friction, at),
            tangent_arms: [get(&self.tangent_arm_a, at), get(&self.tangent_arm_b, at)],
            tangent_mass: get(&self.tangent_mass, at),
            tangent_impulse: get(&self.tangent_impulse, at),
            tangent_speed: get(&self.tangent_speed, at),
            restitution: get(&self.restitution, at),
            points: points_at(&self.points, at),
            space: SpaceLane::default(),
        }
    }

    fn set_lane(&mut self, at: usize, lane: &Lane) {
        (self.a[at], self.b[at], self.pair[at]) = (lane.a, lane.b, lane.pair);
        set(&mut self.normal_x, at, lane.normal[0]);
        set(&mut self.normal_y, at, lane.normal[1]);
        set(&mut self.inverse_mass_a, at, lane.inverse_masses[0]);
        set(&mut self.inverse_mass_b, at, lane.inverse_masses[1]);
        set(&mut self.inverse_inertia_a, at, lane.inverse_inertias[0]);
        set(&mut self.inverse_inertia_b, at, lane.inverse_inertias[1]);
        set(&mut self.friction, at, lane.friction);
        set(&mut self.tangent_arm_a, at, lane.tangent_arms[0]);
        set(&mut self.tangent_arm_b, at, lane.tangent_arms[1]);
        set(&mut self.tangent_mass, at, lane.tangent_mass);
        set(&mut self.tangent_impulse, at, lane.tangent_impulse);
        set(&mut self.tangent_speed, at, lane.tangent_speed);
        set(&mut self.restitution, at, lane.restitution);
        set_points_at(&mut self.points, at, &lane.points);
    }

    fn pairs(&mut self) -> &mut [u32; 4] {
        &mut self.pair
    }

    fn points(&mut self) -> &mut [Point] {
        &mut self.points
    }
}
