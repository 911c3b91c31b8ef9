//! A panic is a failure like any other.

use std::cell::RefCell;
use std::panic::{self, AssertUnwindSafe, catch_unwind};

thread_local! {
    static LAST: RefCell<String> = const { RefCell::new(String::new()) };
}

/// What `check` answers, or text and place of its panic.
///
/// # Errors
/// That of `check`, or that text.
pub fn caught(check: impl FnOnce() -> Result<(), String>) -> Result<(), String> {
    let usual = panic::take_hook();
    panic::set_hook(Box::new(|panic| LAST.set(panic.to_string().replace('\n', " "))));
    let result = catch_unwind(AssertUnwindSafe(check));
    panic::set_hook(usual);
    result.unwrap_or_else(|_| Err(LAST.take()))
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
