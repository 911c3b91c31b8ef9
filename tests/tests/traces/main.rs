//! Scenes, and the recorded runs of the original.

mod recorded;
mod samples;
mod scenes;
mod scenes_build;
mod scenes_read;
mod texts;
mod trace_check;
