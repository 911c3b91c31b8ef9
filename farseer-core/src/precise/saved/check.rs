//! Validation of a loaded snapshot.

use super::{ImportedState, Saved, SavedManifold, SavedPair, SavedProxy, SavedSleepingBody};
use crate::methods::Methods;
use crate::precise::Precise;
use farseer_precise::index::DenseIndex;
use farseer_precise::scaled_parameters::Parameters;

impl Precise {
    /// Returns whether a loaded state is valid and was saved by the precise set with the length unit of `methods`.
    pub(crate) fn is_valid(&self, methods: Methods) -> bool {
        matches!(methods, Methods::Precise { length_unit } if length_unit == self.solver.parameters.length_unit)
            && self
                .loaded
                .as_ref()
                .is_none_or(|saved| saved.is_valid() && saved.is_in_space == self.solver.depth.is_some())
    }
}

impl Saved {
    /// Returns whether all numbers are finite and all indices in range. It is false only if the snapshot is corrupt.
    fn is_valid(&self) -> bool {
        let Parameters { length_unit, .. } = self.tuning;
        length_unit.is_finite()
            && length_unit > 0.0
            && self.tuning == Parameters::new(length_unit)
            && finite(&[self.substep, self.dt])
            && self.proxies.iter().all(SavedProxy::is_valid)
            && self.pairs.iter().all(|pair| pair.is_valid(self.proxies.len()))
            && finite(&self.gravity)
            && self.delta_poses.iter().all(|(_, way)| finite(way))
            && self.rest_times.iter().all(|&(_, rest)| rest.is_finite())
            && self
                .solver_history
                .iter()
                .all(|(_, history)| history.average_newton_steps.is_finite() && history.budget.is_finite())
            && self.sleeping_bodies.iter().all(|sleeper| sleeper.is_valid(self.sleeping_bodies.len()))
    }
}

impl SavedProxy {
    fn is_valid(&self) -> bool {
        let SavedProxy {
            fat_aabb,
            depth_interval,
            imported: ImportedState { pose, contact_properties, surface, one_way, .. },
            ..
        } = self;
        finite(&[depth_interval.low, depth_interval.high])
            && finite(fat_aabb)
            && finite(pose)
            && finite(contact_properties)
            && surface.is_valid()
            && finite(&one_way.unwrap_or_default())
    }
}

impl SavedPair {
    /// Returns whether all numbers of the saved pair are finite and all indices in range. `proxies`: number of saved proxies.
    fn is_valid(&self, proxies: usize) -> bool {
        let SavedManifold {
            rotations,
            relative_pose,
            normal,
            count,
            anchors,
            separations,
            arm_lead_angle,
            depth,
            ..
        } = &self.manifold;
        self.proxies.iter().all(|proxy| proxy.position() < proxies)
            && *count <= 2
            && finite(rotations)
            && finite(relative_pose)
            && finite(normal)
            && finite(&[depth.normal_z, depth.z_offset, depth.patch_radius])
            && finite(&depth.points_z)
            && finite(separations)
            && arm_lead_angle.abs() <= 1.0
            && anchors.iter().all(|anchor| finite(anchor))
            && self.constraint.as_ref().is_none_or(|row| *count > 0 && row.is_valid())
    }
}

impl SavedSleepingBody {
    /// Returns whether all numbers of the saved body are finite and its index is in range. `count`: number of saved sleeping
    /// bodies.
    fn is_valid(&self, count: usize) -> bool {
        let is_there = self.first.position() < count;
        is_there && finite(&self.pose) && finite(&self.supported_acceleration) && finite(&self.constants)
    }
}

/// Returns whether all `numbers` are finite.
fn finite(numbers: &[f32]) -> bool {
    numbers.iter().all(|number| number.is_finite())
}
