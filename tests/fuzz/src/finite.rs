//! Whether numbers are finite, and which is not.

/// Notes the first number that is not finite, with its name.
///
/// # Errors
/// That name and number.
pub(crate) fn finite<'a>(name: &str, numbers: impl IntoIterator<Item = &'a f32>) -> Result<(), String> {
    match numbers.into_iter().find(|number| !number.is_finite()) {
        Some(number) => Err(format!("{name} is {number}")),
        None => Ok(()),
    }
}
