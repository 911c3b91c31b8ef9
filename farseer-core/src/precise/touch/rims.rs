//! The ghost filter of round shapes in three axes: rims that lie no higher than the face a ball rests on stop it not.
//!
//! A ball in contact with a face of one shape is some hundredths of a length unit deep in it, by the sag of the contact. The rim of
//! a shape that is flush with that face is in its way by as much, and lifting the ball over the rim costs a slow ball some of its
//! speed. A convex shape that does not reach above the face meets nothing that rests on the face.

use super::{Touch, Two};
use crate::math::plane::{Vector, dot, scaled};
use crate::precise::manifold::Manifold;
use crate::precise::parameters::narrow_phase::RIM_NORMAL_COSINE;
use crate::precise::proxies::Mobility;
use crate::precise::space::{Limits, Solid};

impl Touch<'_> {
    /// Whether a contact is that of a round shape with a rim that a face hides on which the shape rests.
    pub(super) fn is_hidden_rim(
        &self,
        pair: usize,
        two: Two<'_>,
        [a, b]: [Solid<'_>; 2],
        found: &Manifold,
    ) -> bool {
        if found.count != 1 || a.is_round() == b.is_round() {
            return false;
        }
        let [at_a, at_b] = self.pairs.watched[pair].proxies;
        let (at_ball, other, sign) = if b.is_round() { (at_b, a, 1.0) } else { (at_a, b, -1.0) };
        let gives_way = two.a.mobility == Mobility::Dynamic;
        let normal = scaled(found.normal, sign);
        other.is_upright_prism()
            && self.pairs.of(at_ball).any(|next| {
                next != pair
                    && self.face_under(next, at_ball).is_some_and(|(face, height, is_dynamic)| {
                        let tilt = dot(face, normal);
                        let flush = Limits::flush(self.tuning.speculative, gives_way || is_dynamic);
                        (0.0..RIM_NORMAL_COSINE).contains(&tilt) && other.height_along(face) <= height + flush
                    })
            })
    }

    /// The face on which a ball rests by a pair: its normal towards the ball, how far it lies along that, and whether it can be
    /// pushed.
    fn face_under(&self, pair: usize, at_ball: u32) -> Option<(Vector, f32, bool)> {
        let (state, frozen) = (&self.pairs.all[pair], &self.pairs.frozen[pair]);
        let pushes = state.home.is_some() && state.responds && !(state.is_vetoed || state.was_vetoed);
        let rests = pushes && frozen.count > 0 && frozen.space.normal_z == 0.0;
        rests.then_some(())?;
        let [a, b] = self.pairs.watched[pair].proxies;
        let (at, sign) = if b == at_ball { (a, 1.0) } else { (b, -1.0) };
        let proxy = &self.proxies.all[at as usize];
        let outline = self.proxies.corners.outline(proxy.shape);
        let space = self.space?;
        let solid = space.solid(at, proxy, outline, (self.bodies, self.dt));
        let normal = scaled(frozen.normal, sign);
        solid
            .has_face(normal)
            .then(|| (normal, solid.height_along(normal), proxy.mobility == Mobility::Dynamic))
    }
}
