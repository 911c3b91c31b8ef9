//! Snapshot of a contact constraint: its place, its impulses, and what a handler has set.

use serde::{Deserialize, Serialize};

use super::{COLOR_COUNT, Color, ConstraintGraph, ConstraintHandle, ContactConstraint};
use crate::broad_phase::pairs::{Pair, Pairs};
use crate::index::{DenseIndex, PairIndex};
use crate::math::scalar::nearest_finite;
use crate::storage::words::{Record, Words};

/// Saved impulses and surface properties of a contact constraint.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(remote = "Self")]
pub struct SavedConstraint {
    /// Index of the graph colour of the constraint.
    colour: u32,
    /// Index of the slot in the overflow colour, whose order influences the bits; 0 in all other colours.
    slot: u32,
    /// Length of the substep in which the impulses act, seconds, if the constraint is parked because its bodies sleep; else
    /// `None`.
    #[serde(rename = "asleep")]
    sleeping_h: Option<f32>,
    /// If the constraint is in the direct solver: length of the substep in which the impulses act (seconds), and the impulses
    /// in double precision (mass units * length units/s) of both points and of friction. Else `None`.
    direct: Option<(f32, [f64; 3])>,
    /// Friction impulse along the tangent. Unit: mass units * length units/s.
    tangent_impulse: f32,
    /// Impulses in three axes: friction along the second tangent, friction about Z (twist), and totals of the step for both
    /// points and both tangents. Units: mass units * length units/s; twist: mass units * length units^2/s.
    #[serde(rename = "space")]
    depth_impulses: [f32; 6],
    /// Angular impulse of rolling resistance. Unit: mass units * length units^2/s.
    rolling_impulse: f32,
    /// Normal impulses of both points. Unit: mass units * length units/s.
    impulses: [f32; 2],
    /// Rest impulses of both points, which load adaptation has set. Unit: mass units * length units/s.
    #[serde(rename = "held")]
    load_offsets: [f32; 2],
    /// Whether a handler has removed each point, or the point does not exist.
    #[serde(rename = "are_dropped")]
    are_disabled: [bool; 2],
    /// Separations at both points, negative for penetration. Unit: length units.
    separations: [f32; 2],
    /// Friction and restitution coefficient (dimensionless) and tangent speed (length units/s) of a sleeping constraint, if a
    /// handler has overridden them; else `None`.
    #[serde(rename = "kept")]
    sleeping_surface: Option<[f32; 3]>,
    /// Friction and restitution coefficient (dimensionless) and tangent speed (length units/s) of an awake constraint, if a
    /// handler has overridden them; else `None`. Not serialised: the next step begins with the values of the geoms.
    #[serde(skip)]
    awake_surface: Option<[f32; 3]>,
}

crate::saved_record!(SavedConstraint);

impl Record for SavedConstraint {
    const WORDS: usize = 31;

    #[inline(always)]
    fn visit(&mut self, words: &mut impl Words) {
        words.word(&mut self.colour);
        words.word(&mut self.slot);
        let mut sleeping_h = self.sleeping_h.map(|h| [h]);
        words.maybe(&mut sleeping_h);
        self.sleeping_h = sleeping_h.map(|[h]| h);
        let mut h = self.direct.map(|(h, _)| [h]);
        words.maybe(&mut h);
        let mut exact = self.direct.map_or([0; 3], |(_, exact)| exact.map(f64::to_bits));
        exact.iter_mut().for_each(|impulse| words.long(impulse));
        self.direct = h.map(|[h]| (h, exact.map(f64::from_bits)));
        words.float(&mut self.tangent_impulse);
        words.floats(&mut self.depth_impulses);
        words.float(&mut self.rolling_impulse);
        words.floats(&mut self.impulses);
        words.floats(&mut self.load_offsets);
        let [first, second] = &mut self.are_disabled;
        words.flags([first, second]);
        words.floats(&mut self.separations);
        words.maybe(&mut self.sleeping_surface);
    }
}

impl SavedConstraint {
    /// Returns the saved form of the contact constraint of a pair. `count`: number of points of its manifold, 0..=2.
    pub fn of(constraints: &ConstraintGraph, pair: &Pair, handle: ConstraintHandle, count: u32) -> Self {
        let ContactConstraint {
            tangent_impulse, points, friction, restitution, tangent_speed, depth, ..
        } = constraints.get(pair.kind, handle);
        let is_absent = [count < 1, count < 2];
        let (sleeping, parked) = (constraints.sleeping_constraint(handle), constraints.parked(handle));
        let surface = pair.has_surface_override.then_some([friction, restitution, tangent_speed]);
        let [one, other, along, across] = depth.totals;
        SavedConstraint {
            colour: parked.map_or(handle.color, |row| row.color).0,
            slot: if handle.is_overflow() { handle.slot.0 } else { 0 },
            sleeping_h: sleeping.map(|row| row.h),
            direct: parked.filter(|_| sleeping.is_none()).map(|row| (row.h, row.exact_impulses)),
            tangent_impulse,
            depth_impulses: [depth.across_impulse, depth.twist_impulse, one, other, along, across],
            rolling_impulse: pair.rolling_impulse,
            impulses: points.map(|point| point.normal_impulse),
            load_offsets: points.map(|point| point.rest_impulse),
            // Not by effective masses: those of the constraint are out of date after an edit of a mass.
            are_disabled: [0, 1].map(|at| is_absent[at] || pair.are_points_removed[at]),
            // The separation at a body with an extreme spin may overflow.
            separations: points.map(|point| nearest_finite(point.separation)),
            sleeping_surface: surface.filter(|_| sleeping.is_some()),
            awake_surface: surface.filter(|_| sleeping.is_none()),
        }
    }

    /// Returns whether all numbers are finite and the colour exists. It is false only if the snapshot is corrupt.
    pub fn is_valid(&self) -> bool {
        let SavedConstraint {
            tangent_impulse,
            depth_impulses,
            impulses,
            load_offsets,
            separations,
            sleeping_h,
            direct,
            sleeping_surface,
            ..
        } = self;
        Color(self.colour).position() < COLOR_COUNT
            && finite(&[*tangent_impulse, self.rolling_impulse, sleeping_h.unwrap_or(0.0)])
            && direct.is_none_or(|(h, exact)| h.is_finite() && exact.iter().all(|x| x.is_finite()))
            && finite(&sleeping_surface.unwrap_or_default())
            && finite(depth_impulses)
            && [impulses, load_offsets, separations].into_iter().all(|numbers| finite(numbers))
    }

    /// Returns a number by whose order constraints are restored: only in the overflow colour their order influences the bits.
    pub fn order(&self) -> u32 {
        self.slot
    }

    /// Returns whether the direct solver had the constraint.
    pub fn was_direct(&self) -> bool {
        self.direct.is_some()
    }

    /// Returns friction and restitution coefficient (dimensionless) and tangent speed (length units/s), if a handler has
    /// overridden them; else `None`.
    pub fn surface(&self) -> Option<[f32; 3]> {
        self.sleeping_surface.or(self.awake_surface)
    }

    /// Restores the angular impulse of rolling resistance of the pair.
    pub fn restore_rolling(&self, pairs: &mut Pairs, pair: PairIndex) {
        pairs.restore_rolling_impulse(pair, self.rolling_impulse);
    }

    /// Returns for both points whether a handler has removed the point, or it does not exist.
    pub fn are_points_disabled(&self) -> [bool; 2] {
        self.are_disabled
    }

    /// Returns the index of the graph colour of the constraint.
    pub(crate) fn color(&self) -> u32 {
        self.colour
    }

    /// Returns for a parked constraint the length of the substep in which its impulses act, seconds. In the direct solver also
    /// the impulses of both points and of friction, mass units * length units/s. `None` for a constraint in a colour.
    pub(crate) fn parked(&self) -> Option<(f32, Option<[f64; 3]>)> {
        self.sleeping_h.map(|h| (h, None)).or(self.direct.map(|(h, exact)| (h, Some(exact))))
    }

    /// Writes the saved impulses, separations and surface properties to a constraint that is built anew.
    pub(crate) fn apply_to(&self, lane: &mut ContactConstraint) {
        if let Some(surface) = self.surface() {
            [lane.friction, lane.restitution, lane.tangent_speed] = surface;
        }
        lane.tangent_impulse = self.tangent_impulse;
        let [across, twist, totals @ ..] = self.depth_impulses;
        (lane.depth.across_impulse, lane.depth.twist_impulse) = (across, twist);
        lane.depth.totals = totals;
        for (at, point) in lane.points.iter_mut().enumerate() {
            point.normal_impulse = self.impulses[at];
            point.rest_impulse = self.load_offsets[at];
            point.separation = self.separations[at];
            if self.are_disabled[at] {
                point.normal_mass = 0.0;
            }
        }
    }
}

fn finite(numbers: &[f32]) -> bool {
    numbers.iter().all(|number| number.is_finite())
}
