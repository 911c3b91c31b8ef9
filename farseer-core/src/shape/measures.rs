//! Area, centroid, moment of inertia and winding of an outline (behaviour chapter 05, sections 1.2 and 1.3).

use super::Vertices;
use crate::error::{Error, Result};
use crate::math::{Vector2, vector2};

impl Vertices {
    /// The shoelace area: negative in engine winding.
    pub(crate) fn signed_area(&self) -> f32 {
        let mut sum = 0.0;
        for i in 0..self.len() {
            let (here, next) = (self[i], self[self.next_index(i)]);
            sum += here.x * next.y;
            sum -= here.y * next.x;
        }
        sum / 2.0
    }

    /// The enclosed area, in length units², never negative; 0 for fewer than three vertices.
    #[doc(alias = "GetArea")]
    pub fn get_area(&self) -> f32 {
        let area = self.signed_area();
        if area < 0.0 { -area } else { area }
    }

    /// Reverses the list if its shoelace area is positive, which leaves it in engine winding:
    /// counter-clockwise on a screen with y down.
    #[doc(alias = "ForceCounterClockWiseOrder")]
    pub fn force_counter_clockwise_order(&mut self) {
        if self.signed_area() > 0.0 {
            self.reverse();
        }
    }

    /// The centre of the enclosed area. NaN or infinite if there is no area.
    #[doc(alias = "GetCentroid")]
    pub fn get_centroid(&self) -> Vector2 {
        self.get_centroid_with_area(self.get_area())
    }

    /// The centre of the enclosed area for an area that is already known, which is not checked. NaN or infinite if
    /// `area` is 0.
    #[doc(alias = "GetCentroid")]
    pub fn get_centroid_with_area(&self, area: f32) -> Vector2 {
        let mut sum = Vector2::new(0.0, 0.0);
        let mut visit = |from: Vector2, to: Vector2| {
            let factor = -(from.x * to.y - to.x * from.y);
            sum += (from + to) * factor;
        };
        // The sum follows the outline in engine winding, whatever the order of the list.
        if self.signed_area() > 0.0 {
            (0..self.len()).rev().for_each(|i| visit(self[i], self[self.previous_index(i)]));
        } else {
            (0..self.len()).for_each(|i| visit(self[i], self[self.next_index(i)]));
        }
        sum * (1.0 / (area * 6.0))
    }

    /// Moment of inertia about the centroid of a body of mass 1 with this outline. 0 for one vertex, NaN for
    /// outlines without area.
    ///
    /// # Errors
    /// When the list is empty.
    #[doc(alias = "GetMomentOfInertia")]
    pub fn get_moment_of_inertia(&self) -> Result<f32> {
        let mut centred = self.clone();
        centred.force_counter_clockwise_order();
        let centroid = centred.get_centroid();
        centred.translate(centroid * -1.0);

        let Some(&last) = centred.last() else {
            return Err(Error::invalid("self", self, "a list of one vertex or more"));
        };
        if centred.len() == 1 {
            return Ok(0.0);
        }
        let mut v1 = last;
        let (mut numerator, mut denominator) = (0.0, 0.0);
        for &v2 in &centred {
            let (a, b, c) = (vector2::dot(v2, v2), vector2::dot(v2, v1), vector2::dot(v1, v1));
            let d = vector2::cross(v1, v2).abs();
            numerator += d;
            denominator += (a + b + c) * d;
            v1 = v2;
        }
        Ok(denominator / (numerator * 6.0))
    }
}
