//! Ghost filter of round shapes in three axes: removes contacts with rims that are not higher than the face on which the
//! shape rests.
//!
//! A ball penetrates the face that supports it by some hundredths of a length unit, the sag of the contact. The rim of a
//! flush shape then obstructs the ball by as much, and lifting it over the rim would cost a slow ball part of its speed. A
//! convex shape that does not rise above the supporting face cannot touch a ball on that face.

use super::{NarrowPhase, ProxyPair};
use crate::broad_phase::proxies::BodyType;
use crate::depth::posed_solid::{ContactMargins, PosedSolid};
use crate::index::{PairIndex, ProxyIndex};
use crate::math::plane::{Vector, dot, scaled};
use crate::narrow_phase::manifold::Manifold;
use crate::parameters::narrow_phase::RIM_NORMAL_MAX_COS;

impl NarrowPhase<'_> {
    /// Returns whether a manifold is the contact of a round shape with a rim of a prism that does not rise above a face on
    /// which the round shape rests.
    pub(super) fn is_hidden_rim(
        &self,
        pair: PairIndex,
        two: ProxyPair<'_>,
        [a, b]: [PosedSolid<'_>; 2],
        manifold: &Manifold,
    ) -> bool {
        if manifold.count != 1 || a.is_rounded() == b.is_rounded() {
            return false;
        }
        let [at_a, at_b] = self.pairs.proxies_of(pair);
        let (round_proxy, other, sign) = if b.is_rounded() { (at_b, a, 1.0) } else { (at_a, b, -1.0) };
        let is_dynamic_a = two.a.body_type == BodyType::Dynamic;
        let normal = scaled(manifold.normal, sign);
        other.is_straight_prism()
            && self.pairs.pairs_of(round_proxy).any(|next| {
                next != pair
                    && self.supporting_face(next, round_proxy).is_some_and(|(face, height, is_dynamic)| {
                        let tilt = dot(face, normal);
                        let flush = ContactMargins::max_flush_overlap(
                            self.parameters.speculative_distance,
                            is_dynamic_a || is_dynamic,
                        );
                        (0.0..RIM_NORMAL_MAX_COS).contains(&tilt)
                            && other.support_coordinate(face) <= height + flush
                    })
            })
    }

    /// Returns the face on which the round shape of a pair rests: its unit normal toward the round shape, its coordinate along
    /// the normal (world, length units), and whether its body is dynamic. `None` if the round shape does not rest on a face of
    /// the other shape.
    fn supporting_face(&self, pair: PairIndex, round_proxy: ProxyIndex) -> Option<(Vector, f32, bool)> {
        let (state, cached) = (self.pairs.state(pair), self.pairs.manifold(pair));
        let pushes = state.constraint.is_some() && state.responds && !(state.is_vetoed || state.was_vetoed);
        let rests = pushes && cached.count > 0 && cached.depth.normal_z == 0.0;
        rests.then_some(())?;
        let [a, b] = self.pairs.proxies_of(pair);
        let (at, sign) = if b == round_proxy { (a, 1.0) } else { (b, -1.0) };
        let proxy = self.proxies.proxy(at);
        let shape = self.proxies.vertices.shape_ref(proxy.shape);
        let space = self.depth?;
        let solid = space.posed_solid(at, proxy, shape, (self.bodies, self.dt));
        let normal = scaled(cached.normal, sign);
        solid
            .has_face(normal)
            .then(|| (normal, solid.support_coordinate(normal), proxy.body_type == BodyType::Dynamic))
    }
}
