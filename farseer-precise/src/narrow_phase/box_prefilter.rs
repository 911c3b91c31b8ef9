//! Narrow phase: rejects pairs of separated boxes with a separating axis test of four pairs at a time, in SIMD lanes.
//!
//! Fat AABBs overlap long before the boxes do: in a moving pile most updated pairs have no contacts before and after the
//! update. The test of two boxes needs only poses and half extents. Its separations equal those of the scalar code bit for bit.

use crate::index::PairIndex;
use wide::f32x4;

use super::NarrowPhase;
use crate::broad_phase::pairs::REMOVED_PAIR;
use crate::math::lanes::{gather, greater, select};

impl NarrowPhase<'_> {
    /// Removes from `dirty` the pairs of two boxes that had no contact and are still separated by more than the speculative
    /// distance. The other pairs keep their order. `dirty` holds indices of pairs.
    pub(super) fn reject_separated_boxes(&mut self, dirty: &mut Vec<PairIndex>) {
        let (mut four, mut count) = ([0; 4], 0);
        for at in 0..dirty.len() {
            four[count] = at;
            count += usize::from(self.are_boxes_without_contact(dirty[at]));
            if count == four.len() {
                count = 0;
                self.reject_four_separated_boxes(dirty, four);
            }
        }
        dirty.retain(|&pair| pair != REMOVED_PAIR);
    }

    /// Tests the pairs at the four positions `four` of `dirty`, and replaces the indices of separated pairs by [`REMOVED_PAIR`].
    fn reject_four_separated_boxes(&mut self, dirty: &mut [PairIndex], four: [usize; 4]) {
        let gaps = self.box_pair_separations(four.map(|at| dirty[at]));
        for (at, gap) in four.into_iter().zip(gaps) {
            if gap > self.parameters.speculative_distance {
                let pair = std::mem::replace(&mut dirty[at], REMOVED_PAIR);
                self.pairs.set_motion_at_check(pair, self.total_travel(self.pairs.trigger(pair)));
                self.end_contact(pair, gap - self.parameters.speculative_distance);
            }
        }
    }

    /// Returns whether a pair consists of two boxes and has no contact.
    #[inline(always)]
    fn are_boxes_without_contact(&self, pair: PairIndex) -> bool {
        let state = self.pairs.state(pair);
        let [a, b] = self.pairs.proxies_of(pair);
        state.constraint.is_none()
            & !state.is_touching
            & self.proxies.is_centred_box(a)
            & self.proxies.is_centred_box(b)
    }

    /// Returns the separations of four pairs of boxes along the best face normal, in length units, negative for penetration.
    fn box_pair_separations(&self, pairs: [PairIndex; 4]) -> [f32; 4] {
        let side = |side: usize| {
            let proxies = pairs.map(|pair| self.pairs.proxies_of(pair)[side]);
            let bodies = self.proxies.box_bodies_of(proxies);
            (self.proxies.half_extents_of(&proxies), gather(&self.bodies.poses, &bodies))
        };
        box_separations(side(0), side(1), self.parameters.speculative_distance)
    }
}

/// Half extents (x, y in length units) and world poses (x, y in length units, cosine, sine) of four boxes, one box in each
/// lane.
type Boxes = ([f32x4; 2], [f32x4; 4]);

/// Returns the separations of four pairs of boxes in length units, negative for penetration. Each is the largest over the face
/// normals of A if that exceeds `margin` (length units), else the largest over the face normals of B. The bits are those of
/// [`collide`](crate::narrow_phase::shape_dispatch::collide).
#[inline(always)]
fn box_separations((half_a, pose_a): Boxes, (half_b, pose_b): Boxes, margin: f32) -> [f32; 4] {
    let ([ax, ay, cos_a, sin_a], [bx, by, cos_b, sin_b]) = (pose_a, pose_b);
    let (x, y) = (bx - ax, by - ay);
    let at = [cos_a * x + sin_a * y, cos_a * y - sin_a * x];
    let rotation = [cos_a * cos_b + sin_a * sin_b, cos_a * sin_b - sin_a * cos_b];
    let position_back =
        [rotation[0] * at[0] + rotation[1] * at[1], rotation[0] * at[1] - rotation[1] * at[0]];
    let along_a = face_separations(half_a, half_b, at, rotation);
    let along_b = face_separations(half_b, half_a, position_back, rotation);
    select(along_a.simd_gt(f32x4::splat(margin)), along_a, along_b).to_array()
}

/// Returns the largest separation along the face normals of each of four boxes from another box, in length units, negative for
/// penetration. `at` (length units) and `rotation` (cosine, sine) are the pose of the other box in the frame of the first.
#[inline(always)]
fn face_separations(
    half_extents: [f32x4; 2],
    other_half_extents: [f32x4; 2],
    at: [f32x4; 2],
    rotation: [f32x4; 2],
) -> f32x4 {
    let [c, s] = rotation.map(f32x4::abs);
    let x = at[0].abs() - half_extents[0] - (other_half_extents[0] * c + other_half_extents[1] * s);
    let y = at[1].abs() - half_extents[1] - (other_half_extents[0] * s + other_half_extents[1] * c);
    greater(x, y)
}

#[cfg(test)]
mod tests {
    use super::box_separations;
    use crate::math::lanes::columns;
    use crate::narrow_phase::shape_dispatch::collide;
    use crate::shape::{Shape, VertexPool};

    #[test]
    fn simd_box_separations_match_scalar_collide() {
        let margin = 0.64;
        let mut seed = 1_u32;
        let mut random = |least: f32, most: f32| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            least + (most - least) * (seed >> 8) as f32 / 16_777_216.0
        };
        let mut separated = 0;
        for _ in 0..500 {
            let mut corners = VertexPool::default();
            let mut four_boxes = || {
                let shapes = [(); 4].map(|()| corners.add_box([random(2.0, 30.0), random(2.0, 30.0)]));
                let poses = shapes.map(|_| {
                    let angle = random(-4.0, 4.0);
                    [random(-40.0, 40.0), random(-40.0, 40.0), angle.cos(), angle.sin()]
                });
                (shapes, poses)
            };
            let (a, b) = (four_boxes(), four_boxes());
            let side = |(shapes, poses): &([Shape; 4], [[f32; 4]; 4])| {
                let [x, y, ..] =
                    columns(&shapes.map(|shape| [shape.half_extents[0], shape.half_extents[1], 0.0, 0.0]));
                ([x, y], columns(poses))
            };
            for (at, gap) in box_separations(side(&a), side(&b), margin).into_iter().enumerate() {
                let shape_of = |(shapes, _): &([_; 4], _)| corners.shape_ref(shapes[at]);
                let manifold = collide(shape_of(&a), shape_of(&b), a.1[at], b.1[at], margin);
                if gap > margin {
                    assert_eq!((manifold.count, manifold.gap.to_bits()), (0, gap.to_bits()));
                    separated += 1;
                } else {
                    assert!(manifold.gap <= margin);
                }
            }
        }
        assert!((500..1900).contains(&separated), "{separated} of 2000 are apart");
    }
}
