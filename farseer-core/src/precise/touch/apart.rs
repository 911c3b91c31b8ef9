//! Boxes that are still apart, four pairs at a time.
//!
//! The bounds of two overlap long before they meet: of a pile that moves, most pairs that are looked at have no contacts and
//! get none. Of two boxes no more is to be known then than how far they are apart, which needs no corners.

use wide::f32x4;

use super::Touch;
use crate::math::lanes::{gather, greater, select};
use crate::precise::pairs::NONE;

impl Touch<'_> {
    /// Takes those of boxes that were apart and still are out of the pairs that are due; the others it leaves in their order.
    pub(super) fn part_boxes(&mut self, due: &mut Vec<u32>) {
        let (mut four, mut count) = ([0; 4], 0);
        for at in 0..due.len() {
            four[count] = at;
            count += usize::from(self.are_boxes_apart(due[at] as usize));
            if count == four.len() {
                count = 0;
                self.part_four(due, four);
            }
        }
        due.retain(|&pair| pair != NONE);
    }

    fn part_four(&mut self, due: &mut [u32], four: [usize; 4]) {
        let gaps = self.gaps(four.map(|at| due[at] as usize));
        for (at, gap) in four.into_iter().zip(gaps) {
            if gap > self.tuning.speculative {
                let pair = std::mem::replace(&mut due[at], NONE) as usize;
                self.pairs.watched[pair].since = self.motion(&self.pairs.watched[pair]);
                self.part(pair, gap - self.tuning.speculative);
            }
        }
    }

    /// Whether a pair is one of boxes, without contacts so far.
    #[inline(always)]
    fn are_boxes_apart(&self, pair: usize) -> bool {
        let state = &self.pairs.all[pair];
        let [a, b] = self.pairs.watched[pair].proxies;
        let is_box = |proxy: u32| self.proxies.box_bodies[proxy as usize].is_some();
        state.home.is_none() & !state.is_told & is_box(a) & is_box(b)
    }

    /// How far four pairs of boxes are apart.
    fn gaps(&self, pairs: [usize; 4]) -> [f32; 4] {
        let side = |side: usize| {
            let proxies = pairs.map(|pair| self.pairs.watched[pair].proxies[side]);
            let bodies = proxies.map(|proxy| self.proxies.box_bodies[proxy as usize].unwrap_or(0));
            let [.., half_x, half_y] = gather(&self.proxies.boxes, &proxies);
            ([half_x, half_y], gather(&self.bodies.poses, &bodies))
        };
        gaps(side(0), side(1), self.tuning.speculative)
    }
}

/// Half sides and poses of four boxes.
type Boxes = ([f32x4; 2], [f32x4; 4]);

/// How far boxes are apart along the edges of A, or along those of B if that is not beyond `reach`: as
/// [`collide`](crate::precise::manifold::collide) finds it, to the bit.
#[inline(always)]
fn gaps((half_a, pose_a): Boxes, (half_b, pose_b): Boxes, reach: f32) -> [f32; 4] {
    let ([ax, ay, cos_a, sin_a], [bx, by, cos_b, sin_b]) = (pose_a, pose_b);
    let (x, y) = (bx - ax, by - ay);
    let at = [cos_a * x + sin_a * y, cos_a * y - sin_a * x];
    let turn = [cos_a * cos_b + sin_a * sin_b, cos_a * sin_b - sin_a * cos_b];
    let at_back = [turn[0] * at[0] + turn[1] * at[1], turn[0] * at[1] - turn[1] * at[0]];
    let along_a = separations(half_a, half_b, at, turn);
    let along_b = separations(half_b, half_a, at_back, turn);
    select(along_a.simd_gt(f32x4::splat(reach)), along_a, along_b).to_array()
}

/// How far boxes of the second halves are from those of the first, along the edges of these.
#[inline(always)]
fn separations(of: [f32x4; 2], other: [f32x4; 2], at: [f32x4; 2], turn: [f32x4; 2]) -> f32x4 {
    let [c, s] = turn.map(f32x4::abs);
    let x = at[0].abs() - of[0] - (other[0] * c + other[1] * s);
    let y = at[1].abs() - of[1] - (other[0] * s + other[1] * c);
    greater(x, y)
}

#[cfg(test)]
mod tests {
    use super::gaps;
    use crate::math::lanes::columns;
    use crate::precise::manifold::collide;
    use crate::precise::outline::{Corners, Shape};

    #[test]
    fn four_pairs_of_boxes_are_as_far_apart_as_one_after_the_other() {
        let reach = 0.64;
        let mut seed = 1_u32;
        let mut random = |least: f32, most: f32| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            least + (most - least) * (seed >> 8) as f32 / 16_777_216.0
        };
        let mut apart = 0;
        for _ in 0..500 {
            let mut corners = Corners::default();
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
                let [x, y, ..] = columns(&shapes.map(|shape| [shape.half[0], shape.half[1], 0.0, 0.0]));
                ([x, y], columns(poses))
            };
            for (at, gap) in gaps(side(&a), side(&b), reach).into_iter().enumerate() {
                let outline = |(shapes, _): &([_; 4], _)| corners.outline(shapes[at]);
                let found = collide(outline(&a), outline(&b), a.1[at], b.1[at], reach);
                if gap > reach {
                    assert_eq!((found.count, found.gap.to_bits()), (0, gap.to_bits()));
                    apart += 1;
                } else {
                    assert!(found.gap <= reach);
                }
            }
        }
        assert!((500..1900).contains(&apart), "{apart} of 2000 are apart");
    }
}
