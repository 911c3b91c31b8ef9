//! Narrow phase: rejects pairs of separated shapes with a separating axis test of their oriented bounding boxes, four pairs at a
//! time in SIMD lanes.
//!
//! Fat AABBs overlap long before the shapes do: in a moving pile most updated pairs have no contacts before and after the
//! update. The test needs only poses and the bounding boxes of the shapes in the frames of their bodies. The separation of the
//! boxes is a lower bound for the distance of the shapes. For two boxes it equals the separation of the scalar code bit for bit.

use crate::index::PairIndex;
use wide::f32x4;

use super::NarrowPhase;
use crate::broad_phase::pairs::REMOVED_PAIR;
use crate::math::lanes::{gather, greater, select};

impl NarrowPhase<'_> {
    /// Removes from `dirty` the pairs that had no contact and whose bounding boxes are still separated by more than the
    /// speculative distance. The other pairs keep their order. `dirty` holds indices of pairs.
    pub(super) fn reject_separated_boxes(&mut self, dirty: &mut Vec<PairIndex>) {
        let (mut four, mut count) = ([0; 4], 0);
        for at in 0..dirty.len() {
            four[count] = at;
            count += usize::from(self.has_no_contact(dirty[at]));
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
                self.clear_manifold(pair, gap - self.parameters.speculative_distance);
            }
        }
    }

    /// Returns whether a pair has no contact constraint and does not touch.
    #[inline(always)]
    fn has_no_contact(&self, pair: PairIndex) -> bool {
        let state = self.pairs.state(pair);
        state.constraint.is_none() & !state.is_touching
    }

    /// Returns the separations of the bounding boxes of four pairs, less the radii of their shapes, along the best face normal.
    /// Length units, negative for penetration.
    fn box_pair_separations(&self, pairs: [PairIndex; 4]) -> [f32; 4] {
        let side = |side: usize| {
            let proxies = pairs.map(|pair| self.pairs.proxies_of(pair)[side]);
            let poses = gather(&self.bodies.poses, &proxies.map(|proxy| self.proxies.body_of(proxy)));
            let (bounds, radii) = self.proxies.local_bounds_of(&proxies);
            PosedBoxes::new(bounds, radii, poses)
        };
        box_separations(&side(0), &side(1), self.parameters.speculative_distance)
    }
}

/// Oriented bounding boxes of four shapes, one shape in each lane.
struct PosedBoxes {
    /// Half extents x and y in the frame of the body, without the radius of the shape, length units.
    half_extents: [f32x4; 2],
    /// Radius of the shape, length units, >= 0.
    radii: f32x4,
    /// World coordinates of the origin of the body, length units.
    origin: [f32x4; 2],
    /// Vector from there to the centre of the box, in world axes, length units.
    arm: [f32x4; 2],
    /// Cosine and sine of the body's angle.
    rotation: [f32x4; 2],
}

impl PosedBoxes {
    /// Returns the bounding boxes of four shapes. `bounds`: centre x, y and half extents x, y in the frame of the body, length
    /// units; `poses`: x, y in length units, cosine, sine.
    #[inline(always)]
    fn new([cx, cy, hx, hy]: [f32x4; 4], radii: f32x4, [x, y, c, s]: [f32x4; 4]) -> Self {
        let arm = [c * cx - s * cy, s * cx + c * cy];
        PosedBoxes { half_extents: [hx, hy], radii, origin: [x, y], arm, rotation: [c, s] }
    }
}

/// Returns the separations of four pairs of boxes in length units, less both radii, negative for penetration. Each is the largest
/// over the face normals of A if that exceeds `margin` (length units), else the largest over the face normals of B.
///
/// For boxes without radii about the origins of their bodies the bits are those of
/// [`collide`](crate::narrow_phase::shape_dispatch::collide).
#[inline(always)]
fn box_separations(a: &PosedBoxes, b: &PosedBoxes, margin: f32) -> [f32; 4] {
    let ([cos_a, sin_a], [cos_b, sin_b]) = (a.rotation, b.rotation);
    // Origins first: far from the origin of the world, rounding would lose the arms.
    let [x, y] = [0, 1].map(|axis| (b.origin[axis] - a.origin[axis]) + (b.arm[axis] - a.arm[axis]));
    let at = [cos_a * x + sin_a * y, cos_a * y - sin_a * x];
    let rotation = [cos_a * cos_b + sin_a * sin_b, cos_a * sin_b - sin_a * cos_b];
    let position_back =
        [rotation[0] * at[0] + rotation[1] * at[1], rotation[0] * at[1] - rotation[1] * at[0]];
    let radii = a.radii + b.radii;
    let along_a = face_separations(a.half_extents, b.half_extents, at, rotation) - radii;
    let along_b = face_separations(b.half_extents, a.half_extents, position_back, rotation) - radii;
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
    use super::{PosedBoxes, box_separations};
    use crate::math::lanes::columns;
    use crate::math::plane::Vector;
    use crate::narrow_phase::shape_dispatch::collide;
    use crate::pieces::{Piece, rounded_piece};
    use crate::shape::{Shape, VertexPool};
    use wide::f32x4;

    /// Returns the bounding boxes of four shapes in these poses.
    fn posed_boxes((shapes, poses): &([Shape; 4], [[f32; 4]; 4])) -> PosedBoxes {
        let bounds = shapes.map(|Shape { centre: [x, y], half_extents: [hx, hy], .. }| [x, y, hx, hy]);
        PosedBoxes::new(columns(&bounds), f32x4::new(shapes.map(|shape| shape.radius)), columns(poses))
    }

    #[test]
    fn separated_bounding_boxes_prove_that_shapes_of_any_kind_have_no_contact() {
        let margin = 0.04;
        let mut seed = 1_u32;
        let mut random = |least: f32, most: f32| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            least + (most - least) * (seed >> 8) as f32 / 16_777_216.0
        };
        let mut counts = [0; 2];
        for trial in 0..2000 {
            let mut corners = VertexPool::default();
            let mut four_shapes = || {
                let shapes = std::array::from_fn(|lane| {
                    let offset: Vector = [random(-1.0, 1.0), random(-1.0, 1.0)];
                    let radius = random(0.1, 1.0);
                    let piece = match (trial + lane) % 4 {
                        0 => Piece::Circle { centre: [0.0; 2], radius },
                        1 => rounded_piece(vec![[-0.3, 0.0], [0.3, -0.2], [0.0, 0.4]], radius),
                        2 => Piece::Capsule { ends: [[-radius, 0.0], [random(0.0, 1.0), 0.3]], radius },
                        _ => Piece::Polygon(vec![[-radius, 0.0], [radius, -0.2], [random(0.0, 0.5), radius]]),
                    };
                    corners.add(&piece, (offset, random(-3.0, 3.0)))
                });
                let poses = [(); 4].map(|()| {
                    let angle = random(-4.0, 4.0);
                    [random(-2.0, 2.0), random(-2.0, 2.0), angle.cos(), angle.sin()]
                });
                (shapes, poses)
            };
            let (a, b) = (four_shapes(), four_shapes());
            let gaps = box_separations(&posed_boxes(&a), &posed_boxes(&b), margin);
            for (at, gap) in gaps.into_iter().enumerate() {
                let shape_of = |(shapes, _): &([_; 4], _)| corners.shape_ref(shapes[at]);
                let manifold = collide(shape_of(&a), shape_of(&b), a.1[at], b.1[at], margin);
                assert!(gap <= margin || manifold.count == 0, "{gap}: {manifold:?}");
                counts[0] += usize::from(gap > margin);
                counts[1] += usize::from(manifold.count == 0);
            }
        }
        assert!(counts[0] > counts[1] / 2, "{counts:?} are rejected, are separated");
    }

    #[test]
    fn boxes_beside_the_origins_of_their_bodies_have_their_gap_far_from_the_origin_of_the_world() {
        // Coordinates there are multiples of 1/4.
        let far = 2_097_152.0;
        let posed = |x: f32, centre: f32| {
            let bounds = [centre, 0.0, 0.5, 0.5].map(f32x4::splat);
            PosedBoxes::new(bounds, f32x4::ZERO, [x, far, 1.0, 0.0].map(f32x4::splat))
        };
        let [gap, ..] = box_separations(&posed(far, 0.125), &posed(far + 1.25, -0.0625), 0.0);
        assert_eq!(gap, 1.25 - 0.1875 - 1.0);
    }

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
            for (at, gap) in
                box_separations(&posed_boxes(&a), &posed_boxes(&b), margin).into_iter().enumerate()
            {
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
