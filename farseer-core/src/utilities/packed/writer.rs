//! Writes values in the packed format.

use serde::ser::{self, Serialize};

use super::{GROUP, PackedError};

/// Room for the mask and the items of a group, bytes: an item has at most ten.
const GROUP_ROOM: usize = 1 + 10 * GROUP as usize;

type Result = std::result::Result<(), PackedError>;

/// Writes items one after the other.
pub(super) struct Writer {
    /// Written bytes, then room.
    bytes: Vec<u8>,
    /// Number of written bytes.
    length: usize,
    /// Position of the mask of the present group.
    mask_at: usize,
    /// Number of items in the present group, `0..=GROUP`.
    items: u8,
}

impl Writer {
    /// Returns a writer that appends to `bytes`.
    pub(super) fn new(bytes: Vec<u8>) -> Self {
        Writer { length: bytes.len(), bytes, mask_at: 0, items: GROUP }
    }

    /// Returns the bytes.
    pub(super) fn finish(mut self) -> Vec<u8> {
        self.bytes.truncate(self.length);
        self.bytes
    }

    /// Begins a group of items: makes room for all of them, so that an item needs no test.
    #[inline(never)]
    fn begin_group(&mut self) {
        self.make_room(GROUP_ROOM);
        self.mask_at = self.length;
        self.bytes[self.mask_at] = 0;
        self.length += 1;
        self.items = 0;
    }

    fn make_room(&mut self, room: usize) {
        let end = self.length + room;
        if self.bytes.len() < end {
            self.bytes.resize(end.max(2 * self.bytes.len()), 0);
        }
    }

    /// Writes the bit of an item, and its bytes if the bit is set.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    #[cfg_attr(target_family = "wasm", inline(never))]
    fn item<const N: usize>(&mut self, is_set: bool, bytes: [u8; N]) -> Result {
        if self.items == GROUP {
            self.begin_group();
        }
        self.bytes[self.mask_at] |= u8::from(is_set) << self.items;
        self.items += 1;
        if let Some(room) = self.bytes.get_mut(self.length..self.length + N) {
            room.copy_from_slice(&bytes);
        }
        self.length += if is_set { N } else { 0 };
        Ok(())
    }

    /// Writes an integer.
    #[cfg_attr(not(target_family = "wasm"), inline)]
    #[cfg_attr(target_family = "wasm", inline(never))]
    fn integer(&mut self, mut number: u64) -> Result {
        if number < 0x80 {
            return self.item(number != 0, [number as u8]);
        }
        self.item(true, [])?;
        while number >= 0x80 {
            self.byte(number as u8 | 0x80);
            number >>= 7;
        }
        self.byte(number as u8);
        Ok(())
    }

    fn byte(&mut self, byte: u8) {
        self.bytes[self.length] = byte;
        self.length += 1;
    }

    /// Writes bytes as they are, with room for the rest of the group behind them.
    fn raw(&mut self, bytes: &[u8]) {
        self.make_room(bytes.len() + GROUP_ROOM);
        self.bytes[self.length..self.length + bytes.len()].copy_from_slice(bytes);
        self.length += bytes.len();
    }
}

/// Returns a signed number as an unsigned one that is small for numbers near 0.
fn zigzag(number: i64) -> u64 {
    ((number << 1) ^ (number >> 63)) as u64
}

macro_rules! integers {
    ($($name:ident($type:ty) $number:expr;)*) => {$(
        #[inline]
        fn $name(self, value: $type) -> Result {
            let number: fn($type) -> u64 = $number;
            self.integer(number(value))
        }
    )*};
}

macro_rules! compound {
    ($($trait:ident $method:ident $(, $key:ident)?;)*) => {$(
        impl ser::$trait for &mut Writer {
            type Ok = ();
            type Error = PackedError;
            $(fn $key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result {
                key.serialize(&mut **self)
            })?
            #[inline]
            fn $method<T: Serialize + ?Sized>(&mut self, value: &T) -> Result {
                value.serialize(&mut **self)
            }
            #[inline]
            fn end(self) -> Result {
                Ok(())
            }
        }
    )*};
}

macro_rules! compound_fields {
    ($($trait:ident)*) => {$(
        impl ser::$trait for &mut Writer {
            type Ok = ();
            type Error = PackedError;
            #[inline]
            fn serialize_field<T: Serialize + ?Sized>(&mut self, _: &'static str, value: &T) -> Result {
                value.serialize(&mut **self)
            }
            #[inline]
            fn end(self) -> Result {
                Ok(())
            }
        }
    )*};
}

compound! {
    SerializeSeq serialize_element;
    SerializeTuple serialize_element;
    SerializeTupleStruct serialize_field;
    SerializeTupleVariant serialize_field;
    SerializeMap serialize_value, serialize_key;
}
compound_fields! { SerializeStruct SerializeStructVariant }

impl ser::Serializer for &mut Writer {
    type Ok = ();
    type Error = PackedError;
    type SerializeSeq = Self;
    type SerializeTuple = Self;
    type SerializeTupleStruct = Self;
    type SerializeTupleVariant = Self;
    type SerializeMap = Self;
    type SerializeStruct = Self;
    type SerializeStructVariant = Self;

    fn is_human_readable(&self) -> bool {
        false
    }

    #[inline]
    fn serialize_bool(self, value: bool) -> Result {
        self.item(value, [])
    }

    integers! {
        serialize_u16(u16) u64::from;
        serialize_u32(u32) u64::from;
        serialize_u64(u64) |value| value;
        serialize_i16(i16) |value| zigzag(value.into());
        serialize_i32(i32) |value| zigzag(value.into());
        serialize_i64(i64) zigzag;
        serialize_char(char) |value| u32::from(value).into();
    }

    #[inline]
    fn serialize_u8(self, value: u8) -> Result {
        self.item(value != 0, [value])
    }

    fn serialize_i8(self, value: i8) -> Result {
        self.serialize_u8(value as u8)
    }

    #[inline]
    fn serialize_f32(self, value: f32) -> Result {
        self.item(value.to_bits() != 0, value.to_le_bytes())
    }

    #[inline]
    fn serialize_f64(self, value: f64) -> Result {
        self.item(value.to_bits() != 0, value.to_le_bytes())
    }

    fn serialize_str(self, value: &str) -> Result {
        self.serialize_bytes(value.as_bytes())
    }

    fn serialize_bytes(self, value: &[u8]) -> Result {
        self.integer(value.len() as u64)?;
        self.raw(value);
        Ok(())
    }

    fn serialize_none(self) -> Result {
        self.serialize_bool(false)
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result {
        self.serialize_bool(true)?;
        value.serialize(self)
    }

    fn serialize_unit(self) -> Result {
        Ok(())
    }

    fn serialize_unit_struct(self, _: &'static str) -> Result {
        Ok(())
    }

    fn serialize_unit_variant(self, _: &'static str, index: u32, _: &'static str) -> Result {
        self.integer(index.into())
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, _: &'static str, value: &T) -> Result {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        index: u32,
        _: &'static str,
        value: &T,
    ) -> Result {
        self.integer(index.into())?;
        value.serialize(self)
    }

    fn serialize_seq(self, length: Option<usize>) -> std::result::Result<Self, PackedError> {
        self.integer(length.ok_or(PackedError)? as u64)?;
        Ok(self)
    }

    fn serialize_tuple(self, _: usize) -> std::result::Result<Self, PackedError> {
        Ok(self)
    }

    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> std::result::Result<Self, PackedError> {
        Ok(self)
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        index: u32,
        _: &'static str,
        _: usize,
    ) -> std::result::Result<Self, PackedError> {
        self.integer(index.into())?;
        Ok(self)
    }

    fn serialize_map(self, length: Option<usize>) -> std::result::Result<Self, PackedError> {
        self.serialize_seq(length)
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> std::result::Result<Self, PackedError> {
        Ok(self)
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        index: u32,
        _: &'static str,
        _: usize,
    ) -> std::result::Result<Self, PackedError> {
        self.integer(index.into())?;
        Ok(self)
    }
}
