//! Contacts, arbiters and pairs of the faithful set.

pub(crate) mod arbiter;
pub(crate) mod contact;
mod listed_pairs;
pub(crate) mod pair_id;
pub(crate) mod pair_table;

pub use arbiter::ArbiterRef;
pub use contact::{Contact, ContactId, index_of_safe};
pub use pair_id::PairId;
pub use pair_table::GeomPairBitmap;
