//! Recorded inputs and outputs of single functions of the original, in `golden/units`.
//!
//! A float is written as its bits in hexadecimal; a vector, list or matrix as such words separated by blanks.
//! NaN stands for every NaN, since its sign and payload are not significant.
//!
//! These functions panic on records they cannot read: they serve tests only.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::io::Read;
use std::path::Path;

use farseer_core::math::{Matrix, Vector2, Vector3};
use farseer_core::shape::Vertices;
use flate2::read::GzDecoder;
use serde_json::{Map, Value};

/// Recorded arguments and results of one call of a function.
#[derive(Debug)]
pub struct Case {
    /// The arguments.
    pub input: Fields,
    /// The results.
    pub output: Fields,
}

/// The named values of one side of a case.
#[derive(Debug)]
pub struct Fields {
    name: String,
    values: Map<String, Value>,
    read: RefCell<BTreeSet<String>>,
}

/// All cases of a function in a file of records, for example `cases("math", "AABB")`.
///
/// # Panics
/// When there is none.
pub fn cases(file: &str, fn_name: &str) -> Vec<Case> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("golden/units/{file}.json.gz"));
    let packed = std::fs::File::open(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut text = String::new();
    GzDecoder::new(packed).read_to_string(&mut text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let record: Value = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));

    let all = record["cases"].as_array().unwrap_or_else(|| panic!("{file} has no list of cases"));
    let found: Vec<Case> = all
        .iter()
        .filter(|case| case["fn"] == fn_name)
        .enumerate()
        .map(|(i, case)| Case {
            input: Fields::new(format!("{fn_name} {i}: in"), &case["in"]),
            output: Fields::new(format!("{fn_name} {i}: out"), &case["out"]),
        })
        .collect();
    assert!(!found.is_empty(), "{file} has no case of {fn_name}");
    found
}

/// Runs a test on all cases of a function and asserts that it has read all results.
pub fn check(file: &str, fn_name: &str, test: impl Fn(&Case)) {
    for case in cases(file, fn_name) {
        test(&case);
        case.output.assert_all_read();
    }
}

impl Case {
    /// The exception the original threw, if it did.
    pub fn throws(&self) -> Option<&str> {
        self.output.values.contains_key("throws").then(|| self.output.text("throws"))
    }

    /// Whether the original did not return.
    pub fn hangs(&self) -> bool {
        self.output.values.contains_key("hangs") && self.output.boolean("hangs")
    }

    /// Asserts that a result has the recorded bits.
    #[track_caller]
    pub fn expect<T: Words + ?Sized>(&self, key: &str, actual: &T) {
        let expected = self.output.floats(key);
        assert_bits(&actual.words(), &expected, || {
            format!("{} {key}, given {:?}", self.output.name, self.input.values)
        });
    }

    /// Asserts that a result is the recorded truth value.
    #[track_caller]
    pub fn expect_bool(&self, key: &str, actual: bool) {
        assert_eq!(
            actual,
            self.output.boolean(key),
            "{} {key}, given {:?}",
            self.output.name,
            self.input.values
        );
    }
}

impl Fields {
    fn new(name: String, values: &Value) -> Fields {
        let values = values.as_object().unwrap_or_else(|| panic!("{name} has no fields")).clone();
        Fields { name, values, read: RefCell::default() }
    }

    /// Asserts that no value has been overlooked.
    #[track_caller]
    pub fn assert_all_read(&self) {
        let read = self.read.borrow();
        let overlooked: Vec<&String> = self.values.keys().filter(|&key| !read.contains(key)).collect();
        assert!(overlooked.is_empty(), "{}: {overlooked:?} not looked at", self.name);
    }

    /// A value as it is recorded.
    #[track_caller]
    pub fn value(&self, key: &str) -> &Value {
        self.read.borrow_mut().insert(key.to_owned());
        self.values.get(key).unwrap_or_else(|| panic!("{} has no {key}", self.name))
    }

    /// A string.
    #[track_caller]
    pub fn text(&self, key: &str) -> &str {
        self.value(key).as_str().unwrap_or_else(|| panic!("{} {key} is no text", self.name))
    }

    /// A truth value.
    #[track_caller]
    pub fn boolean(&self, key: &str) -> bool {
        self.value(key).as_bool().unwrap_or_else(|| panic!("{} {key} is no truth value", self.name))
    }

    /// An integer.
    #[track_caller]
    pub fn integer(&self, key: &str) -> i32 {
        let number = self.value(key).as_i64().and_then(|n| i32::try_from(n).ok());
        number.unwrap_or_else(|| panic!("{} {key} is no whole number", self.name))
    }

    /// A list of floats.
    #[track_caller]
    pub fn floats(&self, key: &str) -> Vec<f32> {
        floats(self.text(key))
    }

    /// A list of floats of known length.
    #[track_caller]
    fn exactly<const N: usize>(&self, key: &str) -> [f32; N] {
        let words = self.floats(key);
        words.try_into().unwrap_or_else(|w: Vec<f32>| panic!("{} {key} has {} words", self.name, w.len()))
    }

    /// One float.
    #[track_caller]
    pub fn f32(&self, key: &str) -> f32 {
        let [x] = self.exactly(key);
        x
    }

    /// A vector.
    #[track_caller]
    pub fn vector(&self, key: &str) -> Vector2 {
        Vector2::from(self.exactly::<2>(key))
    }

    /// A list of vectors.
    #[track_caller]
    pub fn vertices(&self, key: &str) -> Vertices {
        vertices(self.text(key))
    }

    /// A list of lists of vectors.
    #[track_caller]
    pub fn vertex_lists(&self, key: &str) -> Vec<Vertices> {
        let lists = self.value(key).as_array().unwrap_or_else(|| panic!("{} {key} is no list", self.name));
        lists
            .iter()
            .map(|v| vertices(v.as_str().unwrap_or_else(|| panic!("{} {key}: {v}", self.name))))
            .collect()
    }

    /// A matrix.
    #[track_caller]
    pub fn matrix(&self, key: &str) -> Matrix {
        Matrix::from_row_slice(&self.exactly::<16>(key))
    }
}

/// The floats in a string of words.
#[track_caller]
pub fn floats(words: &str) -> Vec<f32> {
    let float = |word| u32::from_str_radix(word, 16).unwrap_or_else(|e| panic!("{word:?}: {e}"));
    words.split_whitespace().map(|word| f32::from_bits(float(word))).collect()
}

/// The vectors in a string of words.
#[track_caller]
pub fn vertices(words: &str) -> Vertices {
    let floats = floats(words);
    assert!(floats.len().is_multiple_of(2), "{words:?} has an odd number of words");
    floats.chunks_exact(2).map(|xy| Vector2::new(xy[0], xy[1])).collect()
}

/// A value that can be compared with a record.
pub trait Words {
    /// Its floats in the order of the record.
    fn words(&self) -> Vec<f32>;
}

impl Words for f32 {
    fn words(&self) -> Vec<f32> {
        vec![*self]
    }
}

impl Words for Vector2 {
    fn words(&self) -> Vec<f32> {
        vec![self.x, self.y]
    }
}

impl Words for Vector3 {
    fn words(&self) -> Vec<f32> {
        vec![self.x, self.y, self.z]
    }
}

impl Words for (f32, f32) {
    fn words(&self) -> Vec<f32> {
        vec![self.0, self.1]
    }
}

impl Words for [Vector2] {
    fn words(&self) -> Vec<f32> {
        self.iter().flat_map(|v| [v.x, v.y]).collect()
    }
}

impl Words for Vec<Vector2> {
    fn words(&self) -> Vec<f32> {
        self.as_slice().words()
    }
}

impl Words for Vertices {
    fn words(&self) -> Vec<f32> {
        self.as_slice().words()
    }
}

impl Words for Matrix {
    fn words(&self) -> Vec<f32> {
        self.transpose().as_slice().to_vec()
    }
}

/// Asserts that two lists of floats have the same bits, every NaN being equal to every NaN.
#[track_caller]
pub fn assert_bits(actual: &[f32], expected: &[f32], what: impl Fn() -> String) {
    let bits = |x: &f32| if x.is_nan() { f32::NAN.to_bits() } else { x.to_bits() };
    let equal =
        actual.len() == expected.len() && actual.iter().zip(expected).all(|(a, e)| bits(a) == bits(e));
    if !equal {
        let show = |list: &[f32]| {
            let words: Vec<String> = list.iter().map(|x| format!("{:08x} ({x})", bits(x))).collect();
            words.join(" ")
        };
        panic!("{}:\n  is        {}\n  should be {}", what(), show(actual), show(expected));
    }
}

/// [`assert_bits`] of anything with floats against a string of words.
#[track_caller]
pub fn assert_words<T: Words + ?Sized>(actual: &T, expected: &str) {
    assert_bits(&actual.words(), &floats(expected), || "value".to_owned());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_nan_equals_every_nan() {
        assert_bits(&[f32::from_bits(0xffc0_0001)], &[f32::NAN], String::new);
    }

    #[test]
    #[should_panic(expected = "should be")]
    fn zeros_of_different_sign_differ() {
        assert_bits(&[0.0], &[-0.0], String::new);
    }

    #[test]
    #[should_panic(expected = "has no case")]
    fn a_name_without_cases_is_a_failure() {
        cases("math", "Vector4");
    }

    #[test]
    #[should_panic(expected = "not looked at")]
    fn a_result_that_is_not_compared_is_a_failure() {
        check("math", "PairID", |case| {
            case.output.text("id");
        });
    }
}
