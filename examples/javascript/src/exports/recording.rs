//! Recordings of runs. JavaScript holds them by number.

use std::cell::RefCell;

use farseer_core::Recording;

use crate::boundary::{Argument, Failure, Outcome, exports, leave_bytes, leave_numbers, with_bytes};
use crate::world::Simulator;

thread_local! {
    static RECORDINGS: RefCell<Vec<Option<Box<Recording>>>> = const { RefCell::new(Vec::new()) };
}

/// The number of a recording; a number without a recording is treated like that of a freed one.
#[derive(Debug, Clone, Copy)]
struct Handle(usize);

impl Argument for Handle {
    const REQUIREMENT: &'static str = usize::REQUIREMENT;

    fn read(number: f64) -> Option<Self> {
        usize::read(number).map(Handle)
    }
}

fn keep(recording: Recording) -> f64 {
    RECORDINGS.with_borrow_mut(|recordings| {
        let free = recordings.iter().position(Option::is_none).unwrap_or(recordings.len());
        recordings.resize_with(recordings.len().max(free + 1), || None);
        recordings[free] = Some(Box::new(recording));
        free as f64
    })
}

fn freed() -> Failure {
    Failure::because(&"the recording was freed")
}

impl Handle {
    fn with<T>(self, act: impl FnOnce(&mut Recording) -> Outcome<T>) -> Outcome<T> {
        RECORDINGS.with_borrow_mut(|recordings| {
            act(recordings.get_mut(self.0).and_then(Option::as_deref_mut).ok_or_else(freed)?)
        })
    }

    /// Reads a number of an update that was recorded.
    fn at<T>(self, read: impl FnOnce(&Recording) -> Option<T>) -> Outcome<T> {
        self.with(|recording| {
            read(recording).ok_or_else(|| Failure::because(&"so many updates were not recorded"))
        })
    }
}

exports! {
    /// A recording that begins with the present state; returns its number.
    fn recording_new(simulator: Simulator, keyframe_interval: usize) {
        simulator.plane(|plane| Ok(keep(Recording::new(plane, keyframe_interval as u32)?)))
    }

    /// Reads the recording that was left as bytes; returns its number.
    fn recording_from_bytes() { Ok(keep(with_bytes(Recording::from_bytes)?)) }

    /// Lets it go.
    fn recording_free(recording: Handle) {
        recording.with(|_| Ok(()))?;
        RECORDINGS.with_borrow_mut(|recordings| recordings[recording.0] = None);
        Ok(())
    }

    /// Records an update, with the input that was left as bytes.
    fn recording_record(recording: Handle, simulator: Simulator, dt: f32) {
        recording.with(|recording| {
            simulator.plane(|plane| { with_bytes(|input| recording.record(plane, dt, input)); Ok(()) })
        })
    }

    /// Leaves the file as bytes.
    fn recording_to_bytes(recording: Handle) { recording.with(|recording| Ok(leave_bytes(recording.to_bytes()))) }

    /// Number of recorded updates.
    fn recording_length(recording: Handle) { recording.with(|recording| Ok(recording.len() as f64)) }

    /// Updates from one keyframe to the next.
    fn recording_keyframe_interval(recording: Handle) {
        recording.with(|recording| Ok(f64::from(recording.keyframe_interval())))
    }

    /// Length of an update.
    fn recording_dt(recording: Handle, update: usize) { recording.at(|recording| recording.dt(update)) }

    /// Leaves the hash of the state after an update in two numbers, the upper half first.
    fn recording_hash(recording: Handle, update: usize) {
        let hash = recording.at(|recording| recording.hash(update))?;
        Ok(leave_numbers([(hash >> 32) as u32, hash as u32].map(f64::from)))
    }

    /// Leaves the input of an update as bytes.
    fn recording_input(recording: Handle, update: usize) {
        Ok(leave_bytes(recording.at(|recording| recording.input(update).map(<[u8]>::to_vec))?))
    }

    /// Leaves the snapshot of a keyframe as bytes.
    fn recording_keyframe(recording: Handle, keyframe: usize) {
        Ok(leave_bytes(recording.at(|recording| recording.keyframe(keyframe).map(<[u8]>::to_vec))?))
    }

    /// Number of the first update in which two recordings differ; -1 if there is none.
    fn recording_first_difference(recording: Handle, other: Handle) {
        let other = other.with(|other| Ok(other.clone()))?;
        recording.with(|recording| Ok(recording.first_difference(&other).map_or(-1.0, |update| update as f64)))
    }
}
