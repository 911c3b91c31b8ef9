//! Winding order of an outline as triangulation and hole cutting define it (behaviour chapter 15, section 15.3). It is
//! independent of engine winding, which depends on the area.

use super::Vertices;
use crate::error::{Error, Result};
use crate::math::vector2;

/// A direction around an outline, seen with y **up**; on a screen with y down the two look swapped.
#[doc(alias = "Vertices.WindingOrder")]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum WindingOrder {
    /// Of negative shoelace area if the outline is convex: engine winding.
    #[doc(alias = "WindingOrder.Clockwise")]
    Clockwise = 0,
    /// Of positive shoelace area if the outline is convex.
    #[doc(alias = "WindingOrder.CounterClockwise")]
    CounterClockwise = 1,
}

impl Vertices {
    /// The direction to which more corners turn; the first corner is left out.
    ///
    /// A vote, not an area: the result can be wrong for an outline with many small dents. Corners without a turn vote
    /// for clockwise, a tie is counter-clockwise.
    ///
    /// # Errors
    /// When the list is empty.
    #[doc(alias = "DetermineWindingOrder")]
    pub fn determine_winding_order(&self) -> Result<WindingOrder> {
        if self.is_empty() {
            return Err(Error::invalid("self", self, "a list of one vertex or more"));
        }
        let (mut clockwise, mut counter_clockwise) = (0_usize, 0_usize);
        for i in 1..self.len() {
            let here = self[i];
            if vector2::cross(self[i - 1] - here, self[self.next_index(i)] - here) >= 0.0 {
                clockwise += 1;
            } else {
                counter_clockwise += 1;
            }
        }
        Ok(if clockwise > counter_clockwise {
            WindingOrder::Clockwise
        } else {
            WindingOrder::CounterClockwise
        })
    }

    /// The outline in the other direction, from the same first vertex.
    #[doc(alias = "ReverseWindingOrder")]
    pub fn reverse_winding_order(&self) -> Vertices {
        let mut reversed = self.clone();
        if let Some(rest) = reversed.get_mut(1..) {
            rest.reverse();
        }
        reversed
    }

    /// The outline in the given direction, as [`Vertices::determine_winding_order`] sees it: a copy, reversed if
    /// necessary.
    ///
    /// # Errors
    /// When the list is empty.
    #[doc(alias = "EnsureWindingOrder")]
    pub fn ensure_winding_order(&self, winding_order: WindingOrder) -> Result<Vertices> {
        Ok(if self.determine_winding_order()? == winding_order {
            self.clone()
        } else {
            self.reverse_winding_order()
        })
    }
}
