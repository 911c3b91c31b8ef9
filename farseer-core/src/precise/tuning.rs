//! The parameters of the method.
//!
//! Six of them are Box2D 3.2's (E. Catto; `constants.h` and `b2DefaultWorldDef` in `types.c`), as fractions of a length unit
//! that stands for Box2D's metre:
//!
//! | here | Box2D | value | at 32 px for 1 m |
//! |---|---|---|---|
//! | `speculative` | `B2_SPECULATIVE_DISTANCE`, four linear slops of 0.005 m | 0.02 m | 0.64 px |
//! | `margin` | `B2_MAX_AABB_MARGIN` | 0.05 m | 1.6 px |
//! | `frozen` | `B2_CONTACT_RECYCLE_DISTANCE`, ten linear slops | 0.05 m | 1.6 px |
//! | `push` | `contactSpeed` | 3 m/s | 96 px/s |
//! | `bounce` | `restitutionThreshold` | 1 m/s | 32 px/s |
//! | `DAMPING` | `contactDampingRatio` | 10 | 10 |
//!
//! So is the doubled frequency of contacts with static bodies (`staticSoftness` in `physics_world.c`). Box2D's contact
//! frequency is 30 Hz and at most an eighth of the substep rate, its limit of the margin an eighth of the extent: `FREQUENCY`,
//! `SUBSTEPS_PER_PERIOD` and `MARGIN_OF_SIZE` are not Box2D's.

use serde::{Deserialize, Serialize};

use super::proxies::FARTHEST;

/// How things that touch are kept together and apart. Lengths are parts of [`Methods::Precise`](crate::Methods)'
/// `length_unit`, the size of things that a player looks at: a metre of a game in metres, 32 px of one in px.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Tuning {
    /// Length that the lengths below are parts of.
    pub(crate) unit: f32,
    /// Outlines that are nearer than this have contacts, so that nothing has to be pushed out later.
    pub(crate) speculative: f32,
    /// Margin of the boxes of pairs.
    pub(crate) margin: f32,
    /// Bodies that moved less against each other since their contacts were looked for keep normal and anchors.
    pub(crate) frozen: f32,
    /// Motion after which separations are looked at again.
    pub(crate) checked: f32,
    /// Speed above which the springs of contacts do not learn their load.
    pub(crate) gate: f32,
    /// Greatest speed at which an overlap is undone.
    pub(crate) push: f32,
    /// Speed of approach below which nothing bounces.
    pub(crate) bounce: f32,
}

impl Tuning {
    /// For things of about this size.
    pub(crate) fn new(unit: f32) -> Self {
        Tuning {
            unit,
            speculative: 0.02 * unit,
            margin: 0.05 * unit,
            frozen: 0.05 * unit,
            checked: 0.003 * unit,
            gate: 0.05 * unit,
            push: 3.0 * unit,
            bounce: unit,
        }
    }

    /// By how much the box of something that reaches so far is widened.
    pub(super) fn widening(&self, reach: f32) -> Widening {
        let by_size = MARGIN_OF_SIZE * reach;
        Widening { margin: if by_size < self.margin { by_size } else { self.margin }, lonely: 0.0 }
    }

    /// The same for what is in no pair: a longer look ahead saves it searches, and costs no touches while nobody is there.
    pub(super) fn widening_of_lonely(&self, reach: f32) -> Widening {
        Widening { lonely: LONELY_OF_SIZE * reach, ..self.widening(reach) }
    }

    /// Motion sums count in parts of 2^-26 units, and wrap.
    pub(crate) fn motion_scale(&self) -> f32 {
        67_108_864.0 / self.unit
    }
}

/// How far the box of a proxy reaches beyond it, so that it does not need a new one after every step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Widening {
    /// To all sides.
    pub(super) margin: f32,
    /// As far ahead as this it reaches by what it moves in many steps, not in few.
    lonely: f32,
}

impl Widening {
    /// How far the box reaches ahead of what goes so far in a step.
    pub(super) fn ahead(&self, way: f32) -> f32 {
        let (near, far) = (way * STEPS_AHEAD, (way * LONELY_STEPS_AHEAD).clamp(-self.lonely, self.lonely));
        (if far.abs() > near.abs() { far } else { near }).clamp(-FARTHEST, FARTHEST)
    }
}

/// Boxes reach ahead of a body by what it moves in so many steps; of one that is in no pair by so many, but by so much of its
/// size at most: what it comes upon is not to be in a pair with it for long before it is touched.
const STEPS_AHEAD: f32 = 4.0;
const LONELY_STEPS_AHEAD: f32 = 32.0;
const LONELY_OF_SIZE: f32 = 2.0;
/// And around it by so much of its size at most.
const MARGIN_OF_SIZE: f32 = 0.25;

/// Frequency of a contact's spring in Hz, as far as the length of a substep allows; its damping ratio; and how many
/// substeps a period of it must have. With stiffer ones what stands face to face does not come to rest, with softer ones piles
/// of thousands breathe for seconds.
const FREQUENCY: f32 = 45.0;
const DAMPING: f32 = 10.0;
const SUBSTEPS_PER_PERIOD: f32 = 5.0;

/// Parts per step of 1/60 s by which the load that a spring rests at follows the load it carries, up and down; and the part
/// of the load that is left on the spring. What is learnt lifts a pile, and lags behind its load, which keeps it in motion: so
/// less is learnt than could be.
const LEARNING: f32 = 0.02;
const FORGETTING: f32 = 0.05;
const RESERVE: f32 = 0.6;
/// An overlap of more than this part of the unit is no sag.
const DEEPEST: f32 = 0.1;

/// The numbers of one step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step {
    /// Seconds of the whole step.
    pub(super) dt: f32,
    /// Number of substeps, and seconds of each.
    pub(super) substeps: u32,
    pub(super) h: f32,
    /// Against another dynamic body, and against what does not give way.
    pub(super) soft: Softness,
    pub(super) soft_fixed: Softness,
    pub(super) learning: Learning,
}

/// A spring with damper over a substep: what one pass does with a separation, a velocity and the impulse so far (E. Catto,
/// "Soft Constraints", GDC 2011). With frequency f, damping ratio z and omega = 2 pi f, the exact implicit step is
/// l' = l - mass (u + bias s) k - impulse l.
#[derive(Debug, Clone, Copy)]
pub(super) struct Softness {
    pub(super) bias: f32,
    pub(super) mass: f32,
    pub(super) impulse: f32,
}

impl Softness {
    fn new(frequency: f32, damping: f32, h: f32) -> Self {
        let omega = 2.0 * std::f32::consts::PI * frequency;
        let a1 = 2.0 * damping + h * omega;
        let a2 = h * omega * a1;
        let a3 = 1.0 / (1.0 + a2);
        Softness { bias: omega / a1, mass: a2 * a3, impulse: a3 }
    }
}

/// How springs learn their load in a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Learning {
    pub(super) up: f32,
    pub(super) down: f32,
    /// Part of the load that the spring does not learn.
    pub(super) learnt: f32,
    pub(super) inverse_gate: f32,
    /// What is deeper than this in something, as a negative distance, does not learn.
    pub(super) deepest: f32,
}

impl Step {
    pub(super) fn new(dt: f32, substeps: u32, tuning: &Tuning) -> Self {
        let h = dt / substeps as f32;
        let frequency = FREQUENCY.min(1.0 / (SUBSTEPS_PER_PERIOD * h));
        let steps = dt * 60.0;
        Step {
            dt,
            substeps,
            h,
            soft: Softness::new(frequency, DAMPING, h),
            soft_fixed: Softness::new(2.0 * frequency, DAMPING, h),
            learning: Learning {
                up: (LEARNING * steps).min(1.0),
                down: (FORGETTING * steps).min(1.0),
                learnt: 1.0 - RESERVE,
                inverse_gate: 1.0 / tuning.gate,
                deepest: -DEEPEST * tuning.unit,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_in_no_pair_looks_far_ahead_but_not_farther_than_it_is_wide() {
        let tuning = Tuning::new(32.0);
        let (lonely, other) = (tuning.widening_of_lonely(10.0), tuning.widening(10.0));
        assert_eq!([0.5, 1.0, -1.0, 10.0].map(|way| other.ahead(way)), [2.0, 4.0, -4.0, 40.0]);
        assert_eq!([0.5, 1.0, -1.0, 10.0].map(|way| lonely.ahead(way)), [16.0, 20.0, -20.0, 40.0]);
        assert_eq!(lonely.margin, other.margin);
    }
}
