//! Broad phase: search for pairs of proxies whose fat AABBs overlap.
//!
//! | module | contents |
//! |---|---|
//! | [`proxies`] | convex pieces of geoms with their fat AABBs |
//! | [`fat_aabbs`] | computation of fat AABBs |
//! | [`hash_grid`] | spatial index of the fat AABBs |
//! | [`pair_finder`] | new pairs, and the removal of separated pairs |
//! | [`pairs`] | the pairs and what is cached of their contacts |

pub mod fat_aabbs;
pub mod hash_grid;
pub mod pair_finder;
pub mod pairs;
pub mod proxies;
