//! Interface of the gallery for a page.
//!
//! A page has no arguments and no memory of ours: it calls these functions, which the linker knows by name. They share only a
//! few numbers with the gallery.

use std::sync::atomic::{AtomicBool, AtomicI32, AtomicU32, Ordering};

use crate::scenes::scenes;
use crate::{hashes, viewer::Viewer};

/// The scene that the page wants; less than 0 if none.
static WANTED: AtomicI32 = AtomicI32::new(-1);
/// The scene that is shown.
static SHOWN: AtomicI32 = AtomicI32::new(-1);
/// Whether the page hides the gallery.
static RESTS: AtomicBool = AtomicBool::new(false);
/// Whether the page knows of a touch screen.
static HAS_TOUCH: AtomicBool = AtomicBool::new(false);
/// Whether the full screen was left by an event that only the page receives.
static HAS_LEFT_FULL: AtomicBool = AtomicBool::new(false);
/// Mean ms of a frame, of its steps and of its drawing, as bits.
static TIMES: [AtomicU32; 3] = [AtomicU32::new(0), AtomicU32::new(0), AtomicU32::new(0)];
/// State of the screen, a sum of flags: 1 the list, 2 a body is grabbed, 4 the first set is the precise one.
static STATE: AtomicU32 = AtomicU32::new(0);

/// Shows a scene by its number in the list.
// The attribute is `unsafe` since two functions could have one name; no other crate here has these.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub(super) extern "C" fn gallery_choose(scene: i32) {
    WANTED.store(scene, Ordering::Relaxed);
}

/// Stops the time, and drawing, while the page hides the gallery (not 0), or lets it go on (0).
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub(super) extern "C" fn gallery_rest(rests: u32) {
    RESTS.store(rests != 0, Ordering::Relaxed);
}

/// Says that there is a touch screen: games get buttons before anybody has touched it.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub(super) extern "C" fn gallery_has_touch() {
    HAS_TOUCH.store(true, Ordering::Relaxed);
}

/// Says that the full screen was left: by Escape, for example, which browsers keep for themselves.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub(super) extern "C" fn gallery_has_left_full_screen() {
    HAS_LEFT_FULL.store(true, Ordering::Relaxed);
}

/// The number of the scene that is shown, or -1.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub(super) extern "C" fn gallery_scene() -> i32 {
    SHOWN.load(Ordering::Relaxed)
}

/// Mean ms of a frame (0), of its steps (1) or of its drawing (2).
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub(super) extern "C" fn gallery_times(which: u32) -> f32 {
    TIMES.get(which as usize).map_or(0.0, |time| f32::from_bits(time.load(Ordering::Relaxed)))
}

/// State of the screen, a sum: 1 the list of scenes, 2 a body is grabbed, 4 the first half has the precise set.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub(super) extern "C" fn gallery_state() -> u32 {
    STATE.load(Ordering::Relaxed)
}

/// A hash of a scene after its steps, by its number, as `gallery --hashes` prints it; 0 if there are no more.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub(super) extern "C" fn gallery_hash(scene: u32, number: u32) -> u64 {
    let all = scenes();
    let hashes = all.get(scene as usize).and_then(|scene| hashes::of(scene).ok()).unwrap_or_default();
    hashes.get(number as usize).map_or(0, |hashed| hashed.hash)
}

/// Whether the page hides the gallery.
pub(crate) fn rests() -> bool {
    RESTS.load(Ordering::Relaxed)
}

/// Whether the page knows of a touch screen.
pub(crate) fn has_touch() -> bool {
    HAS_TOUCH.load(Ordering::Relaxed)
}

/// Whether the full screen was left since the last call.
pub(crate) fn has_left_full() -> bool {
    HAS_LEFT_FULL.swap(false, Ordering::Relaxed)
}

/// Handles the requests of the page, and reports the state of the screen.
pub(crate) fn meet(viewer: &mut Viewer) {
    let wanted = WANTED.swap(-1, Ordering::Relaxed);
    if wanted >= 0 && wanted as usize != viewer.at() {
        viewer.choose(wanted as usize);
    }
    SHOWN.store(viewer.at() as i32, Ordering::Relaxed);
    for (at, ms) in viewer.times().into_iter().enumerate() {
        TIMES[at].store(ms.to_bits(), Ordering::Relaxed);
    }
    let is_precise =
        viewer.show().halves().first().is_some_and(|half| half.set() == crate::play::Set::Precise);
    let state = u32::from(viewer.is_choosing())
        + 2 * u32::from(viewer.show().is_holding())
        + 4 * u32::from(is_precise);
    STATE.store(state, Ordering::Relaxed);
}
