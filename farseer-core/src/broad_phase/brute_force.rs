//! Brute force broad phase: every geom against every other (behaviour chapter 08, section 5).

use super::PairCallback;
use crate::shape::Aabb;

pub(super) fn update(sink: &mut impl PairCallback) {
    sink.index_listed();
    for i in 0..sink.geom_list().len() {
        for j in i + 1..sink.geom_list().len() {
            let (a, b) = (sink.geom_list()[i], sink.geom_list()[j]);
            let filter = sink.filter();
            let (geom_a, geom_b) = (&filter.geoms[a], &filter.geoms[b]);
            // The box test comes first where no handler can observe the order: it is the cheaper one.
            let overlap = Aabb::intersect(&geom_a.aabb, &geom_b.aabb);
            if !overlap && !sink.has_approval() {
                continue;
            }
            if !filter.may_collide(geom_a, geom_b) {
                continue;
            }
            let accepted = if sink.has_approval() { sink.approve(a, b) } else { overlap };
            if accepted {
                sink.register_unless_listed(a, b);
            }
        }
    }
}
