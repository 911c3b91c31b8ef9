//! Parameters: every number of the method that was chosen, one file for each part of the method.
//!
//! A name is a quantity and its role. The text above it says `Unit: ...`, what it is for, and where its value comes from: a derivation, a
//! citation or a measurement. A number without one of them is a choice. Lengths are in length units, the size of things that a player
//! looks at ([`Tuning::unit`](super::tuning::Tuning::unit)): 1 m in a game in metres, 32 px in one in px.
//!
//! `docs/measured/sensitivity` has the changes by half and twice a number; its rows are the measured ones. The program `sensitivity` reads these files: one constant per
//! line, its value on the same line. Units that it treats apart: `a cosine` (half and twice the angle is meant) and `at most 1`.
//!
//! Not here: identities, indices, marks in place of an index, numbers of lanes.

pub(super) mod broad_phase;
pub(super) mod contacts;
pub(super) mod depth;
pub(super) mod direct;
pub(super) mod joints;
pub(super) mod narrow_phase;
pub(super) mod sleep;
pub(super) mod spatial_joints;
