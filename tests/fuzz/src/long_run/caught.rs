//! Turns a panic into a failure of a check.

use std::cell::RefCell;
use std::panic::{self, AssertUnwindSafe, catch_unwind};
use std::sync::Once;

thread_local! {
    /// Text and source location of the last panic. `None` while this thread does not catch panics.
    static CAUGHT: RefCell<Option<String>> = const { RefCell::new(None) };
}

static HOOK: Once = Once::new();

/// Returns the result of `check`. If `check` panics, returns the text and source location of the panic as an error.
///
/// # Errors
/// The error of `check`, or the text of its panic.
pub fn caught(check: impl FnOnce() -> Result<(), String>) -> Result<(), String> {
    HOOK.call_once(keep_texts);
    CAUGHT.set(Some(String::new()));
    let result = catch_unwind(AssertUnwindSafe(check));
    let text = CAUGHT.take().unwrap_or_default();
    result.unwrap_or(Err(text))
}

/// Installs a panic hook that stores the text for threads that catch panics, instead of printing it.
fn keep_texts() {
    let usual = panic::take_hook();
    panic::set_hook(Box::new(move |panic| {
        let is_caught = CAUGHT.with_borrow(Option::is_some);
        if is_caught {
            CAUGHT.set(Some(panic.to_string().replace('\n', " ")));
        } else {
            usual(panic);
        }
    }));
}

#[cfg(test)]
mod tests {
    use super::caught;

    #[test]
    fn a_panic_is_an_error_with_its_text() {
        let error = caught(|| panic!("a number is not finite")).unwrap_err();
        assert!(error.contains("a number is not finite"), "{error}");
    }
}
