//! Every geom against every other (behaviour chapter 08, section 5).

use super::PairSink;
use crate::geom::GeomId;
use crate::shape::Aabb;

pub(super) fn update(geom_list: &[GeomId], sink: &mut impl PairSink) {
    for (i, &a) in geom_list.iter().enumerate() {
        for &b in &geom_list[i + 1..] {
            let scene = sink.scene();
            let (geom_a, geom_b) = (&scene.geoms[a], &scene.geoms[b]);
            // The box test comes first where nobody can observe the order: it is the cheaper one.
            let overlap = Aabb::intersect(&geom_a.aabb, &geom_b.aabb);
            if !overlap && !sink.has_approval() {
                continue;
            }
            if !scene.may_collide(geom_a, geom_b) {
                continue;
            }
            let accepted = if sink.has_approval() { sink.approve(a, b) } else { overlap };
            if accepted {
                sink.register_unless_listed(a, b);
            }
        }
    }
}
