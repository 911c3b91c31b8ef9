//! Check that numbers are finite.

/// Checks that all of these numbers, which belong to the item `name`, are finite.
///
/// # Errors
/// Name and value of the first number that is not finite.
pub(crate) fn finite<'a>(name: &str, numbers: impl IntoIterator<Item = &'a f32>) -> Result<(), String> {
    match numbers.into_iter().find(|number| !number.is_finite()) {
        Some(number) => Err(format!("{name} is {number}")),
        None => Ok(()),
    }
}
