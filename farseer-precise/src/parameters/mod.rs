//! Parameters of the precise engine: each number that was chosen, in one file per stage.
//!
//! The name of a constant is a quantity and its role. Its comment has `Unit: ...`, its purpose, and where the value comes from:
//! a derivation, a citation or a measurement. "Value chosen" marks a value that has none of these. Lengths are multiples of the
//! length unit ([`Parameters::length_unit`](super::scaled_parameters::Parameters::length_unit)), the size of things that a
//! player looks at: 1 m in a game in metres, 32 px in one in px.
//!
//! `docs/measured/sensitivity` reports the effect of half and twice the value, for the parameters in its table. The program
//! `sensitivity` (`tests/measure/drawing/examples`) parses these files: one constant per line, its value on the same line. It
//! treats two units apart: `a cosine` (it halves and doubles the angle) and `at most 1` (it clamps twice the value to 1).
//!
//! Not here: identities, indices, sentinel values, numbers of SIMD lanes.

pub mod broad_phase;
pub mod contacts;
pub mod depth;
pub mod direct;
pub mod joints;
pub mod narrow_phase;
pub mod sleep;
pub mod spatial_joints;
