//! Depth intervals of geoms in an update, and their motion along Z.

use farseer_core::{BodyId, GeomId, PhysicsSimulator};

use crate::Vector3;
use crate::depth::{DepthState, is_movable};

/// Interval of a geom along Z in the current update, with its motion.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct DepthInterval {
    /// Middle of the interval, px.
    pub(super) z: f32,
    /// Half of the length of the interval, px.
    pub(super) half: f32,
    /// Displacement of the geom's body along Z in the last update, px.
    pub(super) motion_z: f32,
    pub(super) is_round: bool,
}

/// Intervals of all geoms at the start of the pair search.
#[derive(Debug, Clone, Default)]
pub(super) struct DepthIntervals {
    /// Intervals by slot of the geom id.
    list: Vec<DepthInterval>,
    /// Length of the update, s.
    dt: f32,
}

impl DepthIntervals {
    /// Stores the intervals of all existing geoms, because the core may ask about one that has left its list.
    pub(super) fn prepare(&mut self, core: &PhysicsSimulator, depths: &DepthState, dt: f32) {
        self.dt = dt;
        for geom in core.geoms() {
            let Some(body) = core.geom(geom).map(|geom| geom.body()) else { continue };
            let (Some(state), Some(profile)) = (depths.bodies.get(body), depths.profiles.get(geom)) else {
                continue;
            };
            let reach = DepthInterval {
                z: state.z,
                half: profile.half_depth(),
                motion_z: self.motion_of(core, depths, body).z,
                is_round: profile.is_round(),
            };
            if geom.slot() >= self.list.len() {
                self.list.resize(geom.slot() + 1, DepthInterval::default());
            }
            self.list[geom.slot()] = reach;
        }
    }

    pub(super) fn of(&self, geom: GeomId) -> DepthInterval {
        self.list.get(geom.slot()).copied().unwrap_or_default()
    }

    /// Displacement of a body in the last update, px, y down. A body before its first update has the
    /// displacement of its present velocity.
    pub(super) fn motion_of(&self, core: &PhysicsSimulator, depths: &DepthState, body: BodyId) -> Vector3 {
        let (Some(plane), Some(state)) = (core.body(body), depths.bodies.get(body)) else {
            return Vector3::zeros();
        };
        match state.motion {
            _ if !(is_movable(core, body) || plane.is_kinematic()) => Vector3::zeros(),
            Some(motion) => motion,
            None => {
                let velocity = plane.linear_velocity();
                Vector3::new(velocity.x, velocity.y, state.velocity_z) * self.dt
            }
        }
    }
}
