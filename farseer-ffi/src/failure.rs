//! Statuses of calls, and the message of the last refused call of each thread.

use std::any::Any;
use std::cell::RefCell;
use std::ffi::{CString, c_char};
use std::fmt::Display;

use farseer_core::Error;

/// Result of a call. All but `FARSEER_STATUS_OK`, `_PANICKED` and `_BUFFER_TOO_SMALL` are refusals, which have changed nothing.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FarseerStatus {
    /// The call was carried out.
    Ok = 0,
    /// A pointer is null.
    NullPointer = 1,
    /// An argument has a value that cannot be accepted: not finite, out of range, no value of its enum.
    InvalidArgument = 2,
    /// An id names an object that was disposed.
    StaleId = 3,
    /// An id names an object of another kind, or no object.
    WrongKind = 4,
    /// The chosen methods do not support it.
    NotSupported = 5,
    /// The call would cost more than the engine allows.
    LimitExceeded = 6,
    /// The bytes are no snapshot, were altered, or have another version.
    DamagedSnapshot = 7,
    /// The caller's array is too short: as many items as it has room for were written, and their full number.
    BufferTooSmall = 8,
    /// The call is not possible in the present state.
    NotNow = 9,
    /// The engine panicked, in this call or an earlier one. The simulator refuses all further calls; destroy it.
    Panicked = 10,
}

/// Why a call was refused.
#[derive(Debug)]
pub(crate) struct Failure {
    status: FarseerStatus,
    message: String,
}

/// Result of the work of a call.
pub(crate) type Outcome<T = ()> = Result<T, Failure>;

thread_local! {
    static LAST: RefCell<CString> = RefCell::default();
}

impl Failure {
    pub(crate) fn new(status: FarseerStatus, message: impl Into<String>) -> Self {
        Failure { status, message: message.into() }
    }

    /// A null pointer.
    pub(crate) fn null(argument: &str) -> Self {
        Failure::new(FarseerStatus::NullPointer, format!("{argument} is a null pointer"))
    }

    /// A value that cannot be accepted, in the words of the engine.
    pub(crate) fn invalid(argument: &str, value: impl Display, requirement: &str) -> Self {
        let message = format!("{argument} is {value}, but must be {requirement}");
        Failure::new(FarseerStatus::InvalidArgument, message)
    }

    /// A stale id, in the words of the engine.
    pub(crate) fn stale(argument: &'static str) -> Self {
        Error::StaleId { argument }.into()
    }

    /// The present call panicked.
    pub(crate) fn panicked(payload: &(dyn Any + Send)) -> Self {
        let text = payload.downcast_ref::<&str>().copied();
        let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
        let message = format!("the engine panicked: {}", text.unwrap_or("without a message"));
        Failure::new(FarseerStatus::Panicked, message)
    }

    /// An earlier call with the same simulator panicked.
    pub(crate) fn panicked_before() -> Self {
        Failure::new(FarseerStatus::Panicked, "the simulator panicked in an earlier call: destroy it")
    }

    /// Stores the message for the thread, and returns the status.
    pub(crate) fn report(self) -> FarseerStatus {
        let text = CString::new(self.message.replace('\0', "\u{fffd}")).unwrap_or_default();
        LAST.set(text);
        self.status
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let status = match error {
            Error::InvalidArgument { .. } => FarseerStatus::InvalidArgument,
            Error::StaleId { .. } => FarseerStatus::StaleId,
            Error::WrongKind { .. } => FarseerStatus::WrongKind,
            Error::NotSupported { .. } => FarseerStatus::NotSupported,
            Error::LimitExceeded { .. } => FarseerStatus::LimitExceeded,
            Error::UnknownSaveVersion { .. } | Error::DamagedSave { .. } => FarseerStatus::DamagedSnapshot,
            _ => FarseerStatus::NotNow,
        };
        Failure::new(status, error.to_string())
    }
}

/// The message of the last refused call of this thread, in UTF-8; empty before the first. Valid until the next refused call of
/// this thread. It names the argument and its value.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_last_error() -> *const c_char {
    LAST.with_borrow(|text| text.as_ptr())
}

/// The version of the library, such as "0.2.0".
#[unsafe(no_mangle)]
pub extern "C" fn farseer_version() -> *const c_char {
    const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    VERSION.as_ptr().cast()
}
