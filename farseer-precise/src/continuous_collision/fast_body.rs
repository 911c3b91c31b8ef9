//! A fast body with its first impact.
use crate::index::{BodyIndex, PairIndex};

/// A dynamic body that is fast in this step (it moves by more than the least distance from its middle to its surface), with its
/// first impact.
#[derive(Debug, Clone, Copy)]
pub struct FastBody {
    /// Index of the body in [`BodySet`](crate::bodies::BodySet); the body is movable.
    pub(crate) body: BodyIndex,
    /// Time of impact of the body as a fraction of the step, dimensionless, 0..=1; 1 without an impact.
    pub(crate) toi: f32,
    /// Index of the pair of proxies that collide at the time of impact; `None` without an impact.
    pub(crate) pair: Option<PairIndex>,
    /// Index of the body that collides at the time of impact: this body, or one that is [joined](super::joined_impacts) to it.
    pub(crate) hit_body: BodyIndex,
    /// Whether the body stops because a body of its articulation has an impact.
    pub(crate) is_joined: bool,
    /// Displacement of the body from its impact to the end of the step, while it moves with the body that it hit: x, y (length
    /// units), rotation (radians), z (length units).
    pub(crate) carried_motion: [f32; 4],
}

impl FastBody {
    /// Returns a fast body without an impact: time of impact 1. `body` is the index of the body.
    pub(crate) fn of(body: BodyIndex) -> Self {
        FastBody { body, toi: 1.0, pair: None, hit_body: body, is_joined: false, carried_motion: [0.0; 4] }
    }
}
