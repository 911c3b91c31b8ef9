//! Groups of bodies with one velocity along the depth axis (z).
//!
//! A joint that keeps a point keeps its depth too, and bodies do not rotate about x or y. So the bodies of such joints move
//! along z as one rigid body, at fixed distances. The constraint is solved exactly by the mass-weighted mean of their z
//! velocities.

use super::super::super::bodies::BodySet;
use super::super::joint_constraint::{JointConstraint, JointList};
use super::super::locked_dofs::LockedDofs;
use crate::index::{BodyIndex, DenseIndex};
use crate::island::union_find::UnionFind;
use crate::mass::mass_of_inverse;
use crate::reusing_clone;

/// Bodies that have the same z velocity, because joints connect them.
#[derive(Debug, Default)]
pub(in super::super) struct ZGroup {
    /// Indices of the dynamic bodies into the arrays of `BodySet`, sorted.
    bodies: Vec<BodyIndex>,
    /// Index of a static or kinematic body that determines the z velocity, 0 for the world. `None` if no joint connects the
    /// group with such a body.
    carrier: Option<BodyIndex>,
}

reusing_clone! { ZGroup { bodies, carrier } }

impl ZGroup {
    /// Returns the connected components of revolute, weld and prismatic joints, sorted by their first bodies. `body_count` is
    /// the number of bodies.
    pub(in super::super) fn find_all(joints: &JointList, body_count: usize) -> Vec<ZGroup> {
        let mut unions = UnionFind::new(body_count);
        for [one, other] in point_joints(joints).map(|joint| joint.anchors.map(|end| end.body)) {
            if one != BodyIndex::PLACEHOLDER && other != BodyIndex::PLACEHOLDER {
                unions.unite(one, other);
            }
        }
        let mut bodies: Vec<BodyIndex> =
            point_joints(joints).flat_map(|joint| joint.anchors.map(|end| end.body)).collect();
        bodies.sort_unstable();
        bodies.dedup();
        // The representative of a component is its smallest index, so that it occurs first.
        let mut all: Vec<(BodyIndex, ZGroup)> = Vec::new();
        for body in bodies.into_iter().filter(|&body| body != BodyIndex::PLACEHOLDER) {
            let root = unions.find(body);
            match all.binary_search_by_key(&root, |(of, _)| *of) {
                Ok(at) => all[at].1.bodies.push(body),
                Err(at) => all.insert(at, (root, ZGroup { bodies: vec![body], carrier: None })),
            }
        }
        find_carriers(joints, &mut unions, &mut all);
        all.into_iter().map(|(_, tied)| tied).collect()
    }

    /// Returns the mean of `value` over the bodies of the group, weighted by their masses, in the unit of `value`.
    fn mass_weighted_mean(&self, bodies: &BodySet, value: impl Fn(BodyIndex) -> f32) -> f32 {
        let (mut sum, mut mass) = (0.0, 0.0);
        for &body in &self.bodies {
            let weight = mass_of_inverse(bodies.inverse_mass_inertia[body][0]);
            (sum, mass) = (sum + weight * f64::from(value(body)), mass + weight);
        }
        (sum / mass) as f32
    }

    /// Returns the z velocity of the group, length units/s: that of `carrier`, or without a carrier the one that conserves
    /// momentum.
    fn z_velocity(&self, bodies: &BodySet) -> f32 {
        match self.carrier {
            Some(carrier) => bodies.states.get(carrier.position()).map_or(0.0, |state| state.velocity[3]),
            None => self.mass_weighted_mean(bodies, |body| {
                bodies.states[BodyIndex::new(body.position())].velocity[3]
            }),
        }
    }

    /// Gives all bodies of the group the group's z velocity.
    ///
    /// The change is no impulse: the next warm start does not apply it again.
    pub(in super::super) fn equalize_z_velocity(&self, bodies: &mut BodySet) {
        let velocity = self.z_velocity(bodies);
        for &body in &self.bodies {
            let now = &mut bodies.states[body].velocity[3];
            bodies.warm_started_velocity[body][3] += velocity - *now;
            *now = velocity;
        }
    }

    /// Gives all bodies of the group the same z velocity (length units/s) and z displacement (length units), after a step of
    /// `dt` seconds without contacts.
    pub(in super::super) fn equalize_z_displacement(&self, bodies: &mut BodySet, dt: f32) {
        let velocity = self.z_velocity(bodies);
        let way = match self.carrier {
            Some(_) => velocity * dt,
            None => {
                self.mass_weighted_mean(bodies, |body| bodies.delta_pose[BodyIndex::new(body.position())][3])
            }
        };
        for &body in &self.bodies {
            bodies.states[body].velocity[3] = velocity;
            bodies.delta_pose[body][3] = way;
        }
    }
}

/// Returns the joints that keep a point, and with it its depth.
fn point_joints(joints: &JointList) -> impl Iterator<Item = &JointConstraint> {
    joints.iter().filter(|joint| {
        let keeps_point = matches!(
            joint.locked,
            LockedDofs::Point | LockedDofs::Weld | LockedDofs::Line | LockedDofs::PointOnLine
        );
        keeps_point && !joint.is_axis_lock
    })
}

/// Sets the carrier of each group in `all`, which is sorted by the root of its bodies in `unions`.
fn find_carriers(joints: &JointList, unions: &mut UnionFind<BodyIndex>, all: &mut [(BodyIndex, ZGroup)]) {
    for [one, other] in point_joints(joints).map(|joint| joint.anchors) {
        for (anchor, carrier) in [(one, other), (other, one)] {
            let root = unions.find(anchor.body);
            if carrier.body == BodyIndex::PLACEHOLDER
                && let Ok(at) = all.binary_search_by_key(&root, |(of, _)| *of)
            {
                all[at].1.carrier.get_or_insert(carrier.pose_body);
            }
        }
    }
}
