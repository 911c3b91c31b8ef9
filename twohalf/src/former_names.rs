//! Names of version 0.1 that still compile; `docs/names-0.2.md` lists them all.

use crate::{CharacterController, CharacterSettings, ContactTarget, CrushInfo, MoveInput};

/// The former name of [`ContactTarget`].
#[deprecated(since = "0.2.0", note = "renamed to ContactTarget")]
pub type Partner = ContactTarget;

/// The former name of [`CrushInfo`].
#[deprecated(since = "0.2.0", note = "renamed to CrushInfo")]
pub type Squeeze = CrushInfo;

/// The former name of [`CharacterSettings`].
#[deprecated(since = "0.2.0", note = "renamed to CharacterSettings")]
pub type Walk = CharacterSettings;

/// The former name of [`CharacterController`].
#[deprecated(since = "0.2.0", note = "renamed to CharacterController")]
pub type Walker = CharacterController;

/// The former name of [`MoveInput`].
#[deprecated(since = "0.2.0", note = "renamed to MoveInput")]
pub type Wish = MoveInput;
