//! Stand-ins for the precise set, without the cargo feature `precise`: a type that has no value, so that the compiler
//! removes all code for it.

use crate::body::BodyId;
use crate::contacts::arbiter::ArbiterRef;
use crate::geom::GeomId;
use crate::objects::Objects;
use crate::report::{AwakeReason, Island};
use crate::simulator::candidates::{Candidate, Segment};
use crate::springs::{SpringForce, SpringId};
use crate::{Aabb, IslandResidual, Methods};
use serde::{Deserialize, Serialize};

/// State of the precise set, which does not exist.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) enum Precise {}

/// Grid of the precise set, which does not exist.
pub(crate) enum GridQuery {}

impl GridQuery {
    pub(crate) fn for_each_near(&self, _: &Aabb, _: impl FnMut(Candidate)) -> bool {
        match *self {}
    }

    pub(crate) fn for_each_along(
        &self,
        Segment { start: _start, end: _end, half_extents: _halves }: &Segment,
        _: impl FnMut(Candidate) -> f64,
    ) -> bool {
        match *self {}
    }
}

/// State of the depth axis, which does not exist.
pub(crate) enum DepthState {}

impl Precise {
    pub(crate) fn of_methods(_: Methods) -> Option<Box<Self>> {
        None
    }

    pub(crate) fn is_valid(&self, _: Methods) -> bool {
        match *self {}
    }

    pub(crate) fn has_depth(&self) -> bool {
        match *self {}
    }

    pub(crate) fn depth_mut(&mut self) -> Option<&mut DepthState> {
        match *self {}
    }

    pub(crate) fn rebuild_from_loaded(&mut self, _: &mut Objects) {
        match *self {}
    }

    pub(crate) fn mark_body_edited(&mut self, _: BodyId) {
        match *self {}
    }

    pub(crate) fn mark_geom_edited(&mut self, _: GeomId) {
        match *self {}
    }
}

/// Sleep and islands.
impl Precise {
    pub(crate) fn is_asleep(&self, _: BodyId) -> bool {
        match *self {}
    }

    pub(crate) fn why_awake(&self, _: BodyId, _: &Objects) -> Option<AwakeReason> {
        match *self {}
    }

    pub(crate) fn islands(&self, _: &Objects) -> Vec<Island> {
        match *self {}
    }

    pub(crate) fn residual(&self, _: &[BodyId], _: &Objects) -> IslandResidual {
        match *self {}
    }

    pub(crate) fn wake(&mut self, _: BodyId) {
        match *self {}
    }
}

/// Contacts and queries.
impl Precise {
    pub(crate) fn pair_count(&self) -> usize {
        match *self {}
    }

    pub(crate) fn touching_count(&self) -> usize {
        match *self {}
    }

    pub(crate) fn arbiter_of_pair(&self, _: usize) -> Option<ArbiterRef<'static>> {
        match *self {}
    }

    pub(crate) fn arbiters_of(&self, _: BodyId) -> Vec<ArbiterRef<'static>> {
        match *self {}
    }

    pub(crate) fn constraints_per_color(&self) -> Vec<usize> {
        match *self {}
    }

    pub(crate) fn grid_query(&self, _: &Objects) -> Option<GridQuery> {
        match *self {}
    }
}

/// Springs.
impl Precise {
    pub(crate) fn begin_springs(&mut self, _: &Objects) {
        match *self {}
    }

    pub(crate) fn inactive_depth_accelerations(&self, _: [Option<BodyId>; 2]) -> [Option<(BodyId, f32)>; 2] {
        match *self {}
    }

    pub(crate) fn constrain_spring(&mut self, _: SpringId, _: [Option<SpringForce>; 2], _: &Objects) -> bool {
        match *self {}
    }
}

impl DepthState {
    pub(crate) fn z_and_velocity(&self, _: usize) -> [f32; 2] {
        match *self {}
    }

    pub(crate) fn relative_z_and_velocity(&self, _: usize, _: usize) -> [f32; 2] {
        match *self {}
    }

    pub(crate) fn add_acceleration(&mut self, _: usize, _: f32) {
        match *self {}
    }

    pub(crate) fn set_acceleration(&mut self, _: usize, _: f32) {
        match *self {}
    }
}
