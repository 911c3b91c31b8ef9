//! Curves: values interpolated between keys (behaviour chapter 14, section 4).

use serde::{Deserialize, Serialize};

use super::{CurveContinuity, CurveKey, CurveKeyCollection};
use crate::math::finite::finite;
use crate::math::scalar::to_int;
use crate::{Error, Result};

/// Minimum difference of the values of a key's neighbours, in the unit of the values: with a smaller one the key's
/// smooth tangents are 0. The original's constant.
const FLAT_DIFFERENCE: f32 = f32::from_bits(0x3400_0001);

/// Continuation of a curve before its first and after its last key.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash, Serialize, Deserialize)]
pub enum CurveLoopType {
    /// The value of the nearest key.
    #[default]
    Constant,
    /// The curve repeats.
    Cycle,
    /// The curve repeats, each time shifted by the difference of the last and the first value.
    CycleOffset,
    /// The curve repeats, alternately backward and forward.
    Oscillate,
    /// A straight line. After the last key it has the outgoing tangent of the **first**, as in the original.
    Linear,
}

/// Rule by which tangents are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash, Serialize, Deserialize)]
pub enum CurveTangent {
    /// Zero tangents.
    #[default]
    Flat,
    /// Tangents toward the neighbouring key.
    Linear,
    /// Tangents along the line between both neighbours.
    Smooth,
}

/// A smooth curve through keys, as in XNA.
///
/// ```
/// use farseer_core::{Curve, CurveKey, CurveTangent};
/// let mut curve = Curve::new();
/// for (position, value) in [(0.0, 0.0), (1.0, 10.0), (3.0, 4.0)] {
///     curve.keys_mut().add(CurveKey::new(position, value)?);
/// }
/// curve.compute_tangents(CurveTangent::Smooth);
/// assert_eq!(curve.evaluate(1.0)?, 10.0);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    keys: CurveKeyCollection,
    pre_loop: CurveLoopType,
    post_loop: CurveLoopType,
}

impl Curve {
    /// A curve without keys, constant outside of them.
    pub fn new() -> Self {
        Self::default()
    }

    /// The keys.
    #[doc(alias = "Keys")]
    pub fn keys(&self) -> &CurveKeyCollection {
        &self.keys
    }

    /// The keys, to edit.
    pub fn keys_mut(&mut self) -> &mut CurveKeyCollection {
        &mut self.keys
    }

    /// Continuation of the curve before the first key. Default [`CurveLoopType::Constant`].
    #[doc(alias = "PreLoop")]
    pub fn pre_loop(&self) -> CurveLoopType {
        self.pre_loop
    }

    /// Sets the continuation of the curve before the first key.
    pub fn set_pre_loop(&mut self, pre_loop: CurveLoopType) {
        self.pre_loop = pre_loop;
    }

    /// Continuation of the curve after the last key. Default [`CurveLoopType::Constant`].
    #[doc(alias = "PostLoop")]
    pub fn post_loop(&self) -> CurveLoopType {
        self.post_loop
    }

    /// Sets the continuation of the curve after the last key.
    pub fn set_post_loop(&mut self, post_loop: CurveLoopType) {
        self.post_loop = post_loop;
    }

    /// Whether there is at most one key.
    #[doc(alias = "IsConstant")]
    pub fn is_constant(&self) -> bool {
        self.keys.len() <= 1
    }

    /// Computes both tangents of a key.
    ///
    /// # Errors
    /// An index that is not less than the number of keys.
    #[doc(alias = "ComputeTangent")]
    pub fn compute_tangent(&mut self, index: usize, tangent: CurveTangent) -> Result<()> {
        self.compute_tangent_in_out(index, tangent, tangent)
    }

    /// Computes the tangents of a key by a rule for each. Smooth tangents of a key between two keys at the same
    /// position are NaN or infinite, as in the original.
    ///
    /// # Errors
    /// An index that is not less than the number of keys.
    #[doc(alias = "ComputeTangent")]
    pub fn compute_tangent_in_out(
        &mut self,
        index: usize,
        tangent_in: CurveTangent,
        tangent_out: CurveTangent,
    ) -> Result<()> {
        self.keys.check(index)?;
        let of = |key: &CurveKey| (key.position(), key.value());
        let (p, v) = of(&self.keys[index]);
        let (pp, pv) = of(&self.keys[index.saturating_sub(1)]);
        let (np, nv) = self.keys.get(index + 1).map_or((p, v), of);
        let smooth = |distance: f32| {
            let difference = nv - pv;
            if difference.abs() < FLAT_DIFFERENCE { 0.0 } else { (difference * distance.abs()) / (np - pp) }
        };
        let computed = |tangent, distance, towards_neighbour| match tangent {
            CurveTangent::Smooth => smooth(distance),
            CurveTangent::Linear => towards_neighbour,
            CurveTangent::Flat => 0.0,
        };
        let (computed_in, computed_out) =
            (computed(tangent_in, pp - p, v - pv), computed(tangent_out, np - p, nv - v));
        if let Some(key) = self.keys.get_mut(index) {
            key.set_computed_tangents(computed_in, computed_out);
        }
        Ok(())
    }

    /// Computes both tangents of every key.
    #[doc(alias = "ComputeTangents")]
    pub fn compute_tangents(&mut self, tangent: CurveTangent) {
        self.compute_tangents_in_out(tangent, tangent);
    }

    /// Computes the tangents of every key by a rule for each.
    #[doc(alias = "ComputeTangents")]
    pub fn compute_tangents_in_out(&mut self, tangent_in: CurveTangent, tangent_out: CurveTangent) {
        for index in 0..self.keys.len() {
            // The index is that of an existing key.
            let _ = self.compute_tangent_in_out(index, tangent_in, tangent_out);
        }
    }

    /// The curve's value at a position.
    ///
    /// As in the original a curve of one key is 0 exactly at its key. The value of a step key lasts until position 1,
    /// wherever the next key is. Where two keys have the same position the value can be NaN or infinite.
    ///
    /// # Errors
    /// A curve without keys; a position that is not finite.
    #[doc(alias = "Evaluate")]
    pub fn evaluate(&self, position: f32) -> Result<f32> {
        let x = finite("position", position)?;
        let keys = self.keys.as_slice();
        let (Some(first), Some(last)) = (keys.first(), keys.last()) else {
            return Err(Error::invalid("keys", 0, "a list of at least one key"));
        };
        let value = if x < first.position() {
            match self.pre_loop {
                CurveLoopType::Constant => first.value(),
                CurveLoopType::Linear => first.value() - first.tangent_in() * (first.position() - x),
                repeating => value_outside_keys(keys, first, last, repeating, x),
            }
        } else if x > last.position() {
            match self.post_loop {
                CurveLoopType::Constant => last.value(),
                CurveLoopType::Linear => last.value() + first.tangent_out() * (x - last.position()),
                repeating => value_outside_keys(keys, first, last, repeating, x),
            }
        } else {
            value_between_keys(keys, x)
        };
        Ok(value)
    }
}

/// The value outside of the keys of a curve that repeats.
fn value_outside_keys(
    keys: &[CurveKey],
    first: &CurveKey,
    last: &CurveKey,
    loop_type: CurveLoopType,
    x: f32,
) -> f32 {
    let span = last.position() - first.position();
    let mut cycle = (x - first.position()) / span;
    if cycle < 0.0 {
        cycle -= 1.0;
    }
    let cycle = to_int(cycle) as f32;
    match loop_type {
        CurveLoopType::CycleOffset => {
            value_between_keys(keys, x - cycle * span) + cycle * (last.value() - first.value())
        }
        CurveLoopType::Oscillate if cycle % 2.0 != 0.0 => {
            value_between_keys(keys, ((last.position() - x) + first.position()) + cycle * span)
        }
        _ => value_between_keys(keys, x - cycle * span),
    }
}

/// The value between the keys; 0 after the last one.
fn value_between_keys(keys: &[CurveKey], x: f32) -> f32 {
    let Some((a, b)) = keys.iter().zip(&keys[1..]).find(|(_, b)| b.position() >= x) else { return 0.0 };
    if a.continuity() == CurveContinuity::Step {
        return if x >= 1.0 { b.value() } else { a.value() };
    }
    let t = (x - a.position()) / (b.position() - a.position());
    let t2 = t * t;
    let t3 = t2 * t;
    let h00 = ((2.0 * t3) - (3.0 * t2)) + 1.0;
    let h10 = (t3 - (2.0 * t2)) + t;
    let h01 = (3.0 * t2) - (2.0 * t3);
    let h11 = t3 - t2;
    (((h00 * a.value()) + (h10 * a.tangent_out())) + (h01 * b.value())) + (h11 * b.tangent_in())
}
