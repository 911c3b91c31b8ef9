//! Broad phase: search for pairs of proxies whose fat AABBs overlap.
//!
//! | module | contents |
//! |---|---|
//! | [`proxies`] | convex pieces of geoms with their fat AABBs |
//! | [`fat_aabbs`] | computation of fat AABBs |
//! | [`hash_grid`] | spatial index of the fat AABBs |
//! | [`pair_finder`] | new pairs, and the removal of separated pairs |
//! | [`pairs`] | the pairs and what is cached of their contacts |

pub(in crate::precise) mod fat_aabbs;
pub(in crate::precise) mod hash_grid;
pub(in crate::precise) mod pair_finder;
pub(in crate::precise) mod pairs;
pub(in crate::precise) mod proxies;
