//! Refusals: null pointers, values that are not finite, stale ids, ids of another kind, unknown values of enums, short arrays.

use std::ffi::CStr;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use farseer_ffi::*;

const ORIGIN: FarseerVector2 = FarseerVector2 { x: 0.0, y: 0.0 };

fn message() -> String {
    // SAFETY: the text ends with NUL, and lives until the next refused call.
    unsafe { CStr::from_ptr(farseer_last_error()) }.to_str().unwrap().to_owned()
}

/// Checks the status and the message of a refused call.
fn refused(status: FarseerStatus, expected: FarseerStatus, text: &str) {
    assert_eq!((status, message().as_str()), (expected, text));
}

/// Calls a function with one result, which must not be refused.
fn result<T>(call: impl FnOnce(Option<&mut MaybeUninit<T>>) -> FarseerStatus) -> T {
    let mut value = MaybeUninit::uninit();
    assert_eq!(call(Some(&mut value)), FarseerStatus::Ok, "{}", message());
    // SAFETY: a call that is not refused writes its result.
    unsafe { value.assume_init() }
}

fn simulator(methods: FarseerMethods) -> Box<FarseerSimulator> {
    farseer_simulator_create(methods as i32, ORIGIN).unwrap()
}

fn disc(simulator: Option<&FarseerSimulator>) -> FarseerBody {
    result(|body| farseer_body_create_circle(simulator, 1.0, 1.0, body))
}

#[test]
fn a_simulator_needs_known_methods_and_finite_gravity() {
    assert!(farseer_simulator_create(2, ORIGIN).is_none());
    assert_eq!(message(), "methods is 2, but must be from 0 to 1");
    assert!(farseer_simulator_create(-1, ORIGIN).is_none());
    assert!(farseer_simulator_create(0, FarseerVector2 { x: f32::INFINITY, y: 1.0 }).is_none());
    assert_eq!(message(), "gravity is (inf, 1), but must be finite");
    farseer_simulator_destroy(None);
}

#[test]
fn null_pointers_are_refused_before_any_work() {
    let simulator = simulator(FarseerMethods::Precise);
    let null_pointer = FarseerStatus::NullPointer;
    refused(farseer_simulator_update(None, 0.1), null_pointer, "simulator is a null pointer");
    let status = farseer_body_create_circle(Some(&simulator), 1.0, 1.0, None);
    refused(status, null_pointer, "body is a null pointer");
    farseer_simulator_update(Some(&simulator), 0.0);
    // SAFETY: no array is given.
    let count = result(|count| unsafe { farseer_simulator_bodies(Some(&simulator), null_mut(), 0, count) });
    assert_eq!(count, 0, "no body was made");
    // SAFETY: a null pointer is no array.
    let status = unsafe {
        farseer_body_create_polygon(Some(&simulator), null(), 3, 1.0, Some(&mut MaybeUninit::uninit()))
    };
    refused(status, null_pointer, "points is a null pointer");
    // SAFETY: a null pointer is no array.
    let status = unsafe { farseer_simulator_restore(Some(&simulator), null(), 9) };
    refused(status, null_pointer, "bytes is a null pointer");
    refused(farseer_body_options_default(None), null_pointer, "options is a null pointer");
}

#[test]
fn values_that_are_not_finite_are_refused_and_change_no_state() {
    let simulator = simulator(FarseerMethods::Faithful);
    let body = disc(Some(&simulator));
    let hash = result(|hash| farseer_simulator_state_hash(Some(&simulator), hash));
    let invalid = FarseerStatus::InvalidArgument;
    let nan = FarseerVector2 { x: 1.0, y: f32::NAN };
    let status = farseer_body_set_position(Some(&simulator), body, nan);
    refused(status, invalid, "position is (1, NaN), but must be finite");
    let status = farseer_body_apply_torque(Some(&simulator), body, f32::INFINITY);
    refused(status, invalid, "torque is inf, but must be finite");
    let status = farseer_body_set_mass(Some(&simulator), body, 0.0);
    assert_eq!(status, invalid);
    assert!(message().starts_with("mass is 0"), "{}", message());
    for dt in [f32::NAN, 1e-40] {
        assert_eq!(farseer_simulator_update(Some(&simulator), dt), invalid, "{dt}");
    }
    assert_eq!(hash, result(|hash| farseer_simulator_state_hash(Some(&simulator), hash)));
}

#[test]
fn a_step_back_is_refused_under_the_precise_methods() {
    let status = farseer_simulator_update(Some(&simulator(FarseerMethods::Precise)), -0.1);
    let text = "dt is -0.1, but must be 0 or more under the precise methods";
    refused(status, FarseerStatus::InvalidArgument, text);
    assert_eq!(farseer_simulator_update(Some(&simulator(FarseerMethods::Faithful)), -0.1), FarseerStatus::Ok);
}

#[test]
fn flags_and_enums_have_no_other_values() {
    let simulator = simulator(FarseerMethods::Faithful);
    let body = disc(Some(&simulator));
    let invalid = FarseerStatus::InvalidArgument;
    let status = farseer_body_set_is_static(Some(&simulator), body, 2);
    refused(status, invalid, "is_static is 2, but must be 0 or 1");
    let status = farseer_simulator_set_broad_phase(Some(&simulator), 4);
    refused(status, invalid, "broad_phase is 4, but must be from 0 to 3");
    let mut options: FarseerGeomOptions = result(|options| farseer_geom_options_default(options));
    options.shape = 77;
    // SAFETY: the options have no points.
    let status = unsafe {
        farseer_geom_create(Some(&simulator), body, Some(&options), Some(&mut MaybeUninit::uninit()))
    };
    refused(status, invalid, "options.shape is 77, but must be from 0 to 6");
}

#[test]
fn stale_ids_and_ids_of_another_kind_are_refused() {
    let simulator = simulator(FarseerMethods::Precise);
    let simulator = Some(&*simulator);
    let body = disc(simulator);
    farseer_object_dispose(simulator, body);
    farseer_simulator_update(simulator, 0.01);
    let status = farseer_body_set_rotation(simulator, body, 1.0);
    refused(status, FarseerStatus::StaleId, "body is stale: what it named was disposed");
    assert_eq!(result(|disposed| farseer_object_is_disposed(simulator, body, disposed)), 1);

    let other = disc(simulator);
    assert_ne!(other, body, "the slot is used again under another id");
    assert_eq!(farseer_geom_set_friction_coefficient(simulator, other, 0.1), FarseerStatus::WrongKind);
    assert!(message().ends_with("which is the id of no geom"), "{}", message());
    assert_eq!(farseer_object_dispose(simulator, 0), FarseerStatus::WrongKind);
    let status =
        farseer_joint_create_revolute(simulator, other, body, ORIGIN, Some(&mut MaybeUninit::uninit()));
    refused(status, FarseerStatus::StaleId, "body2 is stale: what it named was disposed");
}

#[test]
fn the_faithful_methods_refuse_what_they_do_not_have() {
    let simulator = simulator(FarseerMethods::Faithful);
    let simulator = Some(&*simulator);
    let (first, second) = (disc(simulator), disc(simulator));
    let status = farseer_joint_create_gear(simulator, first, second, 2.0, Some(&mut MaybeUninit::uninit()));
    refused(status, FarseerStatus::NotSupported, "the faithful methods have no gear joints");
    let status = farseer_simulator_set_length_unit(simulator, 1.0);
    refused(status, FarseerStatus::NotSupported, "the faithful methods have no length unit");
}

#[test]
fn a_short_array_is_filled_and_reported() {
    let simulator = simulator(FarseerMethods::Precise);
    let bodies: Vec<_> = (0..3).map(|_| disc(Some(&simulator))).collect();
    farseer_simulator_update(Some(&simulator), 0.01);
    let (mut room, mut count) = ([0; 2], MaybeUninit::uninit());
    // SAFETY: the array has room for two ids.
    let status =
        unsafe { farseer_simulator_bodies(Some(&simulator), room.as_mut_ptr(), 2, Some(&mut count)) };
    refused(status, FarseerStatus::BufferTooSmall, "capacity is 2, but there are 3 items");
    assert_eq!(room[..], bodies[..2]);
    // SAFETY: the call has written the number.
    assert_eq!(unsafe { count.assume_init() }, 3);
}

#[test]
fn no_array_of_poses_is_written_if_one_body_is_stale() {
    let simulator = simulator(FarseerMethods::Precise);
    let simulator = Some(&*simulator);
    let bodies = [disc(simulator), disc(simulator)];
    farseer_object_dispose(simulator, bodies[1]);
    farseer_simulator_update(simulator, 0.01);
    let mut angles = [7.0; 2];
    let read = |angles: *mut f32| {
        // SAFETY: both arrays have two items, and the others are null.
        unsafe {
            farseer_bodies_read(simulator, bodies.as_ptr(), 2, null_mut(), angles, null_mut(), null_mut())
        }
    };
    assert_eq!(read(angles.as_mut_ptr()), FarseerStatus::StaleId);
    assert_eq!(angles, [7.0; 2]);
}

#[test]
fn a_damaged_snapshot_is_refused_and_a_good_one_restored() {
    let simulator = simulator(FarseerMethods::Precise);
    let simulator = Some(&*simulator);
    disc(simulator);
    let hash = result(|hash| farseer_simulator_state_hash(simulator, hash));
    let length = result(|length| farseer_simulator_take_snapshot(simulator, length));
    let mut bytes = vec![0; length];
    // SAFETY: the array has room for the snapshot.
    result(|count| unsafe { farseer_simulator_copy_snapshot(simulator, bytes.as_mut_ptr(), length, count) });
    farseer_simulator_update(simulator, 0.01);
    // SAFETY: the array has this length.
    let restore = |bytes: &[u8]| unsafe { farseer_simulator_restore(simulator, bytes.as_ptr(), bytes.len()) };
    assert_eq!(restore(&bytes[..length - 1]), FarseerStatus::DamagedSnapshot);
    assert_eq!(restore(&bytes), FarseerStatus::Ok);
    assert_eq!(hash, result(|hash| farseer_simulator_state_hash(simulator, hash)));
}
