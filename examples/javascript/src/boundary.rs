//! Conversion of numbers to arguments and of results to numbers, and the buffers for all other data.

use std::cell::RefCell;
use std::fmt::Display;

use farseer_core::math::Vector2;
#[cfg(feature = "depth")]
use farseer_core::math::Vector3;
use farseer_core::{CollisionCategory, Error, Vertices};

/// A call was refused; the reason is stored as text. The type has no content, so that every function can pass it on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Failure(());

/// Result of a call.
pub type Outcome<T = ()> = Result<T, Failure>;

impl Failure {
    /// A refusal in these words.
    #[cold]
    #[inline(never)]
    pub(crate) fn because(reason: &dyn Display) -> Self {
        TEXT.set(reason.to_string());
        Failure(())
    }
}

impl From<Error> for Failure {
    #[cold]
    #[inline(never)]
    fn from(error: Error) -> Self {
        Failure::because(&error)
    }
}

/// A refusal of an argument in the words of the engines.
#[cold]
#[inline(never)]
pub(crate) fn invalid(argument: &'static str, value: f64, requirement: &'static str) -> Failure {
    Failure::because(&format_args!("{argument} is {value}, but must be {requirement}"))
}

/// Buffers between JavaScript and the module for everything but numbers.
#[derive(Debug, Default)]
struct Buffers {
    numbers: Vec<f64>,
    bytes: Vec<u8>,
}

thread_local! {
    static BUFFERS: RefCell<Buffers> = RefCell::default();
    /// Why the last call was refused.
    static TEXT: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Number that a call returns: NaN if it was refused, with the reason stored as text.
#[inline(never)]
pub(crate) fn answer<T: Answer>(outcome: Outcome<T>) -> f64 {
    outcome.and_then(Answer::number).unwrap_or(f64::NAN)
}

/// Refuses an argument.
#[cold]
#[inline(never)]
pub(crate) fn refuse_argument(argument: &'static str, number: f64, requirement: &'static str) -> f64 {
    answer::<f64>(Err(invalid(argument, number, requirement)))
}

/// Leaves numbers behind; returns their count.
pub(crate) fn leave_numbers(numbers: impl IntoIterator<Item = f64>) -> f64 {
    BUFFERS.with_borrow_mut(|buffers| {
        buffers.numbers.clear();
        buffers.numbers.extend(numbers);
        buffers.numbers.len() as f64
    })
}

/// Leaves bytes behind; returns their count.
pub(crate) fn leave_bytes(bytes: Vec<u8>) -> f64 {
    BUFFERS.with_borrow_mut(|buffers| {
        buffers.bytes = bytes;
        buffers.bytes.len() as f64
    })
}

/// Resizes the buffer to this size, if there is enough memory.
fn make_room<T: Clone + Default>(buffer: &mut Vec<T>, count: usize) -> Outcome {
    buffer.clear();
    if buffer.try_reserve_exact(count).is_err() {
        return Err(invalid("count", count as f64, "so little that there is memory for it"));
    }
    buffer.resize(count, T::default());
    Ok(())
}

/// Reads the bytes that JavaScript has left.
pub(crate) fn with_bytes<T>(look: impl FnOnce(&[u8]) -> T) -> T {
    BUFFERS.with_borrow(|buffers| look(&buffers.bytes))
}

/// Reads the numbers that JavaScript has left.
pub(crate) fn with_numbers<T>(look: impl FnOnce(&[f64]) -> T) -> T {
    BUFFERS.with_borrow(|buffers| look(&buffers.numbers))
}

/// The points that JavaScript has left as numbers, x and y in turns.
pub(crate) fn points() -> Outcome<Vertices> {
    BUFFERS.with_borrow(|buffers| {
        if let Some(number) = buffers.numbers.iter().find(|number| !(**number as f32).is_finite()) {
            return Err(invalid("points", *number, "finite"));
        }
        let pairs = buffers.numbers.chunks_exact(2);
        Ok(pairs.map(|pair| Vector2::new(pair[0] as f32, pair[1] as f32)).collect())
    })
}

/// An argument that is made of one number.
pub(crate) trait Argument: Sized {
    /// The requirement on the number, for the message of a refusal.
    const REQUIREMENT: &'static str;

    /// Reads it, if it is that.
    fn read(number: f64) -> Option<Self>;
}

impl Argument for f32 {
    const REQUIREMENT: &'static str = "finite";

    #[inline]
    fn read(number: f64) -> Option<Self> {
        let value = number as f32;
        value.is_finite().then_some(value)
    }
}

impl Argument for i32 {
    const REQUIREMENT: &'static str = "a whole number of 32 bits";

    #[inline]
    fn read(number: f64) -> Option<Self> {
        let value = number as i32;
        (f64::from(value) == number).then_some(value)
    }
}

impl Argument for usize {
    const REQUIREMENT: &'static str = "a whole number, 0 or more";

    #[inline]
    fn read(number: f64) -> Option<Self> {
        let value = number as u32;
        (f64::from(value) == number).then_some(value as usize)
    }
}

impl Argument for bool {
    const REQUIREMENT: &'static str = "true or false";

    #[inline]
    fn read(number: f64) -> Option<Self> {
        (number == 0.0 || number == 1.0).then_some(number == 1.0)
    }
}

impl Argument for CollisionCategory {
    const REQUIREMENT: &'static str = i32::REQUIREMENT;

    #[inline]
    fn read(number: f64) -> Option<Self> {
        i32::read(number).map(CollisionCategory::from_bits)
    }
}

/// A type that a call may return.
pub(crate) trait Answer {
    /// The number that represents it. Longer results are left in the buffer of numbers, and this is their count.
    fn number(self) -> Outcome<f64>;
}

impl Answer for () {
    fn number(self) -> Outcome<f64> {
        Ok(0.0)
    }
}

impl Answer for f64 {
    fn number(self) -> Outcome<f64> {
        Ok(self)
    }
}

impl Answer for f32 {
    fn number(self) -> Outcome<f64> {
        Ok(f64::from(self))
    }
}

impl Answer for i32 {
    fn number(self) -> Outcome<f64> {
        Ok(f64::from(self))
    }
}

impl Answer for bool {
    fn number(self) -> Outcome<f64> {
        Ok(f64::from(u8::from(self)))
    }
}

impl Answer for Vector2 {
    fn number(self) -> Outcome<f64> {
        Ok(leave_numbers([self.x, self.y].map(f64::from)))
    }
}

#[cfg(feature = "depth")]
impl Answer for Vector3 {
    fn number(self) -> Outcome<f64> {
        Ok(leave_numbers([self.x, self.y, self.z].map(f64::from)))
    }
}

/// Defines functions of the module: `fn name(argument: Type, ...) -> { body }`, whose body returns an [`Outcome`].
macro_rules! exports {
    ($($(#[$doc:meta])* fn $name:ident($($argument:ident: $type:ty),* $(,)?) $body:block)*) => {$(
        $(#[$doc])*
        // Only the name is unsafe, for a linker that might find it twice; the compiler rejects duplicates within one module.
        #[cfg_attr(target_family = "wasm", allow(unsafe_code), unsafe(no_mangle))]
        pub extern "C" fn $name($($argument: f64),*) -> f64 {
            $(
                let number = $argument;
                let Some($argument) = <$type as $crate::boundary::Argument>::read(number) else {
                    let requirement = <$type as $crate::boundary::Argument>::REQUIREMENT;
                    return $crate::boundary::refuse_argument(stringify!($argument), number, requirement);
                };
            )*
            let act = move || $body;
            $crate::boundary::answer(act())
        }
    )*};
}
pub(crate) use exports;

exports! {
    /// Where the message of the last refused call is in memory, in UTF-8.
    fn text_pointer() { Ok(TEXT.with_borrow(|text| text.as_ptr() as usize as f64)) }

    /// Its length in bytes.
    fn text_length() { Ok(TEXT.with_borrow(|text| text.len() as f64)) }

    /// Where the numbers that were left are in memory, as 64-bit floats.
    fn numbers_pointer() { Ok(BUFFERS.with_borrow(|buffers| buffers.numbers.as_ptr() as usize as f64)) }

    /// Reserves space for numbers; returns its address.
    fn reserve_numbers(count: usize) {
        BUFFERS.with_borrow_mut(|buffers| {
            make_room(&mut buffers.numbers, count)?;
            Ok(buffers.numbers.as_ptr() as usize as f64)
        })
    }

    /// Where the bytes that were left are in memory.
    fn bytes_pointer() { Ok(BUFFERS.with_borrow(|buffers| buffers.bytes.as_ptr() as usize as f64)) }

    /// Reserves space for bytes; returns its address.
    fn reserve_bytes(count: usize) {
        BUFFERS.with_borrow_mut(|buffers| {
            make_room(&mut buffers.bytes, count)?;
            Ok(buffers.bytes.as_ptr() as usize as f64)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exports::body::{body_circle, body_position, body_set_position};
    use crate::exports::simulator::{
        simulator_free, simulator_iterations, simulator_new, simulator_set_iterations, simulator_step,
    };

    fn text() -> String {
        TEXT.with_borrow(String::clone)
    }

    fn numbers() -> Vec<f64> {
        BUFFERS.with_borrow(|buffers| buffers.numbers.clone())
    }

    #[test]
    fn set_values_are_returned_bit_by_bit() {
        let simulator = simulator_new(0.0, 100.0);
        let body = body_circle(simulator, 10.0, 1.0);
        let (x, y) = (f64::from(0.1_f32), f64::from(-123.456_f32));
        assert_eq!(body_set_position(simulator, body, x, y), 0.0);
        assert_eq!(body_position(simulator, body), 2.0);
        assert_eq!(numbers(), [x, y]);
    }

    #[test]
    fn a_refused_call_returns_nan_and_leaves_the_message_of_the_engine() {
        let simulator = simulator_new(0.0, 100.0);
        assert!(body_circle(simulator, -1.0, 1.0).is_nan());
        assert_eq!(text(), "radius is -1.0, but must be finite and greater than 0");
        assert!(body_position(simulator, 3.0).is_nan());
        assert_eq!(text(), "body is stale: what it named was disposed");
    }

    #[test]
    fn numbers_that_are_no_valid_argument_are_refused() {
        let simulator = simulator_new(0.0, 100.0);
        for iterations in [0.5, f64::NAN, f64::INFINITY, -3e9] {
            assert!(simulator_set_iterations(simulator, iterations).is_nan(), "{iterations}");
        }
        assert_eq!(simulator_iterations(simulator), 5.0);
        for dt in [0.0, -0.1, f64::NAN, 1e300] {
            assert!(simulator_step(simulator, dt).is_nan(), "{dt}");
        }
        assert!(bool::read(0.5).is_none() && bool::read(1.0) == Some(true));
    }

    #[test]
    fn numbers_of_simulators_are_used_again_and_unknown_ones_refused() {
        let first = simulator_new(0.0, 0.0);
        assert_eq!(simulator_free(first), 0.0);
        assert!(simulator_step(first, 0.1).is_nan());
        assert_eq!(text(), "the simulator was freed");
        assert_eq!(simulator_new(0.0, 0.0), first);
        for number in [-1.0, 0.5, 1e9, f64::NAN] {
            assert!(simulator_free(number).is_nan(), "{number}");
        }
    }
}
