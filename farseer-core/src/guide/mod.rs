//! The rest of the manual: pages that hold nothing but text.
//!
//! | page | about |
//! |---|---|
//! | [`new_games`] | bodies with their geoms in one call, typed events, queries with filters, a character |
//! | [`five_tasks`] | a pile, a figure with a servo, a platform with a character, sounds of hits, one-way ledges |
//! | [`choosing`] | which methods for which game, and where each fails |
//! | [`settings`] | settings of a simulator with the precise set |
//! | [`solvers`] | islands, and which solver takes them |
//! | [`joints`] | joints, motors, limits and springs with the precise set |
//! | [`sleep_and_ccd`] | sleeping, continuous collision, tiles |
//! | [`events`] | collisions, handlers and shapes with the precise set |
//! | [`porting`] | from C# to Rust, member by member, with a small game before and after |
//! | [`differences`] | where this engine does something else than Farseer 2.1.3, and why |
//! | [`quirks`] | oddities of Farseer 2.1.3 that were kept, and what to do about them |
//! | [`out_of_scope`] | what is not there on purpose, and what to use instead |
//!
//! The [first page](crate) has the pipeline, the methods to choose from and where each fails. Every public member of
//! the original has its line in `docs/farseer-api.csv` of the repository.

#[doc = include_str!("choosing.md")]
pub mod choosing {}

#[doc = include_str!("differences.md")]
pub mod differences {}

#[cfg(feature = "precise")]
#[doc = include_str!("five_tasks.md")]
pub mod five_tasks {}

#[cfg(feature = "precise")]
#[doc = include_str!("new_games.md")]
pub mod new_games {}

#[doc = include_str!("out_of_scope.md")]
pub mod out_of_scope {}

#[doc = include_str!("porting.md")]
pub mod porting {}

#[doc = include_str!("quirks.md")]
pub mod quirks {}

#[doc = include_str!("events.md")]
pub mod events {}

#[doc = include_str!("joints.md")]
pub mod joints {}

#[doc = include_str!("settings.md")]
pub mod settings {}

#[doc = include_str!("sleep_and_ccd.md")]
pub mod sleep_and_ccd {}

#[doc = include_str!("solvers.md")]
pub mod solvers {}
