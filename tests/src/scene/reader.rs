//! Reading of scene values out of JSON.
//!
//! Scenes mix tagged objects (`"type": "circle"`) with keys common to all tags, refuse unknown keys, and every error names its
//! position. serde's tagged and flattened types buffer their input and lose the position. So the reading is done here: a type
//! lists its keys with [`keys!`] or [`tagged!`].

use super::{At, SceneError};
use farseer_core::math::Vector2;
use serde_json::{Map, Value};

type Result<T> = std::result::Result<T, SceneError>;

/// A value that can be read from JSON.
pub(super) trait Read: Sized {
    /// Reads the value at a position.
    fn read(value: &Value, at: At<'_>) -> Result<Self>;

    /// The value of an absent key; an error unless the type says otherwise.
    fn absent(at: At<'_>) -> Result<Self> {
        Err(SceneError::format(at, "is missing"))
    }
}

/// A value made of keys of an object; several may share one object.
pub(super) trait Keys: Sized {
    /// Takes the keys that belong to it.
    fn take(object: &mut Object<'_>) -> Result<Self>;
}

/// An object that is being read. It remembers which keys were read.
pub(super) struct Object<'a> {
    map: &'a Map<String, Value>,
    at: At<'a>,
    known: Vec<&'static str>,
}

impl Object<'_> {
    /// The value of a key.
    pub(super) fn key<T: Read>(&mut self, key: &'static str) -> Result<T> {
        self.known.push(key);
        match self.map.get(key) {
            Some(value) => T::read(value, self.at.key(key)),
            None => T::absent(self.at.key(key)),
        }
    }

    /// The value of a key, or another one when it is absent.
    pub(super) fn key_or<T: Read>(&mut self, key: &'static str, default: T) -> Result<T> {
        Ok(self.key::<Option<T>>(key)?.unwrap_or(default))
    }

    /// Whether a key is there.
    pub(super) fn has(&self, key: &str) -> bool {
        self.map.contains_key(key)
    }

    /// An error at this object.
    pub(super) fn error(&self, reason: impl Into<String>) -> SceneError {
        SceneError::format(self.at, reason)
    }

    /// An error at one of its keys.
    pub(super) fn error_at(&self, key: &str, reason: impl Into<String>) -> SceneError {
        SceneError::format(self.at.key(key), reason)
    }

    /// Refuses keys that were not read.
    fn finish(self) -> Result<()> {
        match self.map.keys().find(|key| !self.known.contains(&key.as_str())) {
            Some(key) => Err(self.error_at(key, "is not a key known here")),
            None => Ok(()),
        }
    }
}

impl<K: Keys> Read for K {
    fn read(value: &Value, at: At<'_>) -> Result<Self> {
        let map = value.as_object().ok_or_else(|| unexpected(value, at, "an object"))?;
        let mut object = Object { map, at, known: Vec::new() };
        let keys = K::take(&mut object)?;
        object.finish()?;
        Ok(keys)
    }
}

/// The error for a value of the wrong kind.
fn unexpected(value: &Value, at: At<'_>, expected: &str) -> SceneError {
    let found = match value {
        Value::Null => "null",
        Value::Bool(_) => "a truth value",
        Value::Number(number) => return SceneError::format(at, format!("{number} is not {expected}")),
        Value::String(text) => return SceneError::format(at, format!("\"{text}\" is not {expected}")),
        Value::Array(_) => "a list",
        Value::Object(_) => "an object",
    };
    SceneError::format(at, format!("{found} is not {expected}"))
}

/// Decimals become the nearest double and then the nearest float, as the reference runs read them. A decimal beyond the range
/// becomes an infinity, which is refused where it is used.
impl Read for f32 {
    fn read(value: &Value, at: At<'_>) -> Result<Self> {
        value.as_f64().map(|number| number as f32).ok_or_else(|| unexpected(value, at, "a number"))
    }
}

macro_rules! integers {
    ($($integer:ty: $expected:literal),* $(,)?) => {$(
        impl Read for $integer {
            fn read(value: &Value, at: At<'_>) -> Result<Self> {
                let integer = value.as_i64().and_then(|integer| integer.try_into().ok());
                integer.ok_or_else(|| unexpected(value, at, $expected))
            }
        }
    )*};
}

integers! {
    i32: "a 32-bit integer",
    u32: "a 32-bit integer of at least 0",
    usize: "an integer of at least 0",
}

impl Read for bool {
    fn read(value: &Value, at: At<'_>) -> Result<Self> {
        value.as_bool().ok_or_else(|| unexpected(value, at, "true or false"))
    }
}

impl Read for String {
    fn read(value: &Value, at: At<'_>) -> Result<Self> {
        value.as_str().map(str::to_owned).ok_or_else(|| unexpected(value, at, "a text"))
    }
}

impl Read for Vector2 {
    fn read(value: &Value, at: At<'_>) -> Result<Self> {
        match value.as_array().map(Vec::as_slice) {
            Some([x, y]) => Ok(Vector2::new(f32::read(x, at.item(0))?, f32::read(y, at.item(1))?)),
            _ => Err(unexpected(value, at, "a vector of two numbers")),
        }
    }
}

impl<T: Read> Read for Vec<T> {
    fn read(value: &Value, at: At<'_>) -> Result<Self> {
        let list = value.as_array().ok_or_else(|| unexpected(value, at, "a list"))?;
        list.iter().enumerate().map(|(index, value)| T::read(value, at.item(index))).collect()
    }
}

impl<T: Read> Read for Option<T> {
    fn read(value: &Value, at: At<'_>) -> Result<Self> {
        T::read(value, at).map(Some)
    }

    fn absent(_: At<'_>) -> Result<Self> {
        Ok(None)
    }
}

impl<K: Keys> Keys for Box<K> {
    fn take(object: &mut Object<'_>) -> Result<Self> {
        K::take(object).map(Box::new)
    }
}

/// Takes one field from an object: a key of the same name, `[= "key"]`, `[or value]` when it is absent, or `[flat]` for a type
/// whose keys are in the same object.
macro_rules! take {
    ($object:ident, $field:ident) => {
        $object.key(stringify!($field))?
    };
    ($object:ident, $field:ident = $key:literal) => {
        $object.key($key)?
    };
    ($object:ident, $field:ident or $default:expr) => {
        $object.key_or(stringify!($field), $default)?
    };
    ($object:ident, $field:ident flat) => {
        $crate::scene::reader::Keys::take($object)?
    };
}

/// Lists the fields of a struct that are read from keys.
macro_rules! keys {
    ($type:ty { $($field:ident $([$($how:tt)*])?),* $(,)? }) => {
        impl $crate::scene::reader::Keys for $type {
            fn take(
                object: &mut $crate::scene::reader::Object<'_>,
            ) -> Result<Self, $crate::scene::SceneError> {
                Ok(Self { $($field: $crate::scene::reader::take!(object, $field $($($how)*)?)),* })
            }
        }
    };
}

/// Lists the variants of an enum by the value of its tag, and the keys of each.
macro_rules! tagged {
    ($type:ty, $tag:literal {
        $($name:literal => $variant:ident { $($field:ident $([$($how:tt)*])?),* $(,)? }),* $(,)?
    }) => {
        impl $crate::scene::reader::Keys for $type {
            fn take(
                object: &mut $crate::scene::reader::Object<'_>,
            ) -> Result<Self, $crate::scene::SceneError> {
                let tag: String = object.key($tag)?;
                match tag.as_str() {
                    $($name => Ok(Self::$variant {
                        $($field: $crate::scene::reader::take!(object, $field $($($how)*)?)),*
                    }),)*
                    _ => Err(object.error_at($tag, $crate::scene::reader::none_of(&tag, &[$($name),*]))),
                }
            }
        }
    };
}

/// Lists the words that stand for the variants of a plain enum.
macro_rules! words {
    ($type:ty { $($name:literal => $variant:ident),* $(,)? }) => {
        impl $crate::scene::reader::Read for $type {
            fn read(
                value: &serde_json::Value,
                at: $crate::scene::At<'_>,
            ) -> Result<Self, $crate::scene::SceneError> {
                let word = <String as $crate::scene::reader::Read>::read(value, at)?;
                match word.as_str() {
                    $($name => Ok(Self::$variant),)*
                    _ => Err($crate::scene::SceneError::format(
                        at,
                        $crate::scene::reader::none_of(&word, &[$($name),*]),
                    )),
                }
            }
        }
    };
}

pub(super) use {keys, tagged, take, words};

/// The reason for an unknown word.
pub(super) fn none_of(word: &str, known: &[&str]) -> String {
    format!("\"{word}\" is none of {}", known.join(", "))
}
