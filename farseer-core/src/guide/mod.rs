//! The rest of the manual: pages that hold nothing but text.
//!
//! | page | about |
//! |---|---|
//! | [`choosing`] | which methods for which game, what they choose by themselves, and where each fails |
//! | [`porting`] | from C# to Rust, member by member, with a small game before and after |
//! | [`differences`] | where this does something else than Farseer 2.1.3, and why |
//! | [`quirks`] | oddities of Farseer 2.1.3 that were kept, and what to do about them |
//! | [`out_of_scope`] | what is not there on purpose, and what to use instead |
//!
//! The [first page](crate) has the pipeline, the methods to choose from and where each fails. Every public member of
//! the original has its line in `docs/farseer-api.csv` of the repository.

#[doc = include_str!("choosing.md")]
pub mod choosing {}

#[doc = include_str!("differences.md")]
pub mod differences {}

#[doc = include_str!("out_of_scope.md")]
pub mod out_of_scope {}

#[doc = include_str!("porting.md")]
pub mod porting {}

#[doc = include_str!("quirks.md")]
pub mod quirks {}
