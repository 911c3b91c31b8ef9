//! Subdivision and simplification of outlines (behaviour chapter 05, sections 1.6 and 1.9, and chapter 15, section
//! 15.1).

use super::Vertices;
use super::vertices::MAX_VERTICES;
use crate::error::{Error, Result};
use crate::math::finite::finite;
use crate::math::{Vector2, vector2};

impl Vertices {
    /// Divides edges longer than `max_edge_length` into equal parts that are not longer. With a negative length it does
    /// nothing.
    ///
    /// # Errors
    /// When the length is not finite, or so small (0 above all) that there would be more vertices than
    /// [`MAX_VERTICES`].
    ///
    /// ```
    /// use farseer_core::shape::Vertices;
    /// let mut outline = Vertices::create_simple_rectangle(10.0, 4.0)?;
    /// outline.sub_divide_edges(3.0)?;
    /// assert_eq!(outline.len(), 12);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    #[doc(alias = "SubDivideEdges")]
    pub fn sub_divide_edges(&mut self, max_edge_length: f32) -> Result<()> {
        finite("max_edge_length", max_edge_length)?;
        let mut divided = Vertices::with_capacity(self.len());
        for (i, &start) in self.iter().enumerate() {
            let end = self[self.next_index(i)];
            divided.push(start);
            let length = vector2::length(start - end);
            if length > max_edge_length {
                let parts = (f64::from(length) / f64::from(max_edge_length)).ceil();
                if divided.len() as f64 + parts > MAX_VERTICES as f64 {
                    let requirement = "large enough for 2^24 vertices";
                    return Err(Error::invalid("max_edge_length", max_edge_length, requirement));
                }
                let between = (1..).take_while(|&j| f64::from(j) < parts);
                divided.extend(between.map(|j| vector2::lerp(start, end, j as f32 / parts as f32)));
            }
        }
        *self = divided;
        Ok(())
    }

    /// The outline with all coordinates rounded to whole numbers, halves to the even one.
    #[doc(alias = "Round")]
    pub fn round(&self) -> Vertices {
        self.iter().map(|v| Vector2::new(v.x.round_ties_even(), v.y.round_ties_even())).collect()
    }

    /// [`Vertices::simplify_with_bias`] with bias 0: rounded, without repeated vertices and without collinear ones.
    #[doc(alias = "Simplify")]
    pub fn simplify(&self) -> Vertices {
        self.simplify_with_bias(0)
    }

    /// The rounded outline without the vertices at most `bias` length units away from the one before, or collinear with
    /// their neighbours; a copy, not rounded, for fewer than three vertices.
    ///
    /// Neighbours are those of the full outline: of a run of vertices close to each other only the first remains,
    /// however long the run. The result may have fewer than three vertices.
    #[doc(alias = "Simplify")]
    pub fn simplify_with_bias(&self, bias: i32) -> Vertices {
        if self.len() < 3 {
            return self.clone();
        }
        let rounded = self.round();
        let kept = |i: &usize| {
            let c = rounded[*i];
            let (p, n) = (rounded[rounded.previous_index(*i)], rounded[rounded.next_index(*i)]);
            let close = vector2::length(p - c) <= bias as f32;
            let in_line = (n.x - p.x) * (c.y - p.y) + (n.y - p.y) * (p.x - c.x) == 0.0;
            !close && !in_line
        };
        (0..rounded.len()).filter(kept).map(|i| rounded[i]).collect()
    }
}
