//! Where geoms are along Z in an update, and how they came there.

use farseer_core::{BodyId, GeomId, PhysicsSimulator};

use crate::Vector3;
use crate::depth::{Depths, is_movable};

/// How far a geom reaches along Z in the current update, and how it came there.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Reach {
    pub(super) z: f32,
    pub(super) half: f32,
    /// How far its body moved along Z in the last update.
    pub(super) motion_z: f32,
    pub(super) is_round: bool,
}

/// The reach of every geom, as it was when contacts began to be looked for.
#[derive(Debug, Clone, Default)]
pub(super) struct Reaches {
    /// By geom slot.
    list: Vec<Reach>,
    /// Of the update, s.
    dt: f32,
}

impl Reaches {
    /// Notes where the geoms are along Z: all that live, because the 2D engine may ask about one that has left its list.
    pub(super) fn prepare(&mut self, core: &PhysicsSimulator, depths: &Depths, dt: f32) {
        self.dt = dt;
        for geom in core.geoms() {
            let Some(body) = core.geom(geom).map(|geom| geom.body()) else { continue };
            let (Some(state), Some(profile)) = (depths.bodies.get(body), depths.profiles.get(geom)) else {
                continue;
            };
            let reach = Reach {
                z: state.z,
                half: profile.half_depth(),
                motion_z: self.motion_of(core, depths, body).z,
                is_round: profile.is_round(),
            };
            if geom.slot() >= self.list.len() {
                self.list.resize(geom.slot() + 1, Reach::default());
            }
            self.list[geom.slot()] = reach;
        }
    }

    pub(super) fn of(&self, geom: GeomId) -> Reach {
        self.list.get(geom.slot()).copied().unwrap_or_default()
    }

    /// How a body moved in the last update, y down. Its velocity may have been set since, and contacts may have
    /// kept it from going that way; but it is all that is known of one that was in no update yet.
    pub(super) fn motion_of(&self, core: &PhysicsSimulator, depths: &Depths, body: BodyId) -> Vector3 {
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
