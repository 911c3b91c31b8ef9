//! Reads values in the packed format.

use serde::de::{self, DeserializeSeed, Visitor};

use super::{GROUP, PackedError};

type Result<T> = std::result::Result<T, PackedError>;

/// Reads items one after the other.
pub(super) struct Reader<'a> {
    /// Bytes that are still to be read.
    rest: &'a [u8],
    /// Mask of the present group; the next item has the lowest bit.
    mask: u8,
    /// Number of items that are still to be read from the present group, `0..=GROUP`.
    items: u8,
}

impl<'a> Reader<'a> {
    /// Returns a reader of `bytes`.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Reader { rest: bytes, mask: 0, items: 0 }
    }

    /// Returns the bytes that are still to be read.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// Reads the bit of an item: whether it is not 0.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    #[cfg_attr(target_family = "wasm", inline(never))]
    fn bit(&mut self) -> Result<bool> {
        if self.items == 0 {
            (self.mask, self.rest) =
                self.rest.split_first().map(|(&mask, rest)| (mask, rest)).ok_or(PackedError)?;
            self.items = GROUP;
        }
        let is_set = self.mask & 1 != 0;
        self.mask >>= 1;
        self.items -= 1;
        Ok(is_set)
    }

    /// Reads an item of this many bytes.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    #[cfg_attr(target_family = "wasm", inline(never))]
    fn item<const N: usize>(&mut self) -> Result<[u8; N]> {
        if !self.bit()? {
            return Ok([0; N]);
        }
        let (&bytes, rest) = self.rest.split_first_chunk().ok_or(PackedError)?;
        self.rest = rest;
        Ok(bytes)
    }

    /// Reads an integer.
    #[cfg_attr(not(target_family = "wasm"), inline)]
    #[cfg_attr(target_family = "wasm", inline(never))]
    fn integer(&mut self) -> Result<u64> {
        let mut number = 0;
        if !self.bit()? {
            return Ok(number);
        }
        for shift in (0..u64::BITS).step_by(7) {
            let (&byte, rest) = self.rest.split_first().ok_or(PackedError)?;
            self.rest = rest;
            number |= u64::from(byte & 0x7F) << shift;
            if byte < 0x80 {
                return Ok(number);
            }
        }
        Err(PackedError)
    }

    /// Reads the length of a sequence, a string or bytes.
    fn length(&mut self) -> Result<usize> {
        usize::try_from(self.integer()?).map_err(|_| PackedError)
    }

    /// Reads this many bytes as they are.
    fn raw(&mut self) -> Result<&'a [u8]> {
        let length = self.length()?;
        let (bytes, rest) = self.rest.split_at_checked(length).ok_or(PackedError)?;
        self.rest = rest;
        Ok(bytes)
    }
}

/// Returns the signed number of an unsigned one: the inverse of the writer's zigzag.
fn signed(number: u64) -> i64 {
    (number >> 1) as i64 ^ -((number & 1) as i64)
}

macro_rules! integers {
    ($($name:ident $visit:ident($type:ty) $number:expr;)*) => {$(
        #[inline]
        fn $name<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
            let number: fn(u64) -> Option<$type> = $number;
            visitor.$visit(number(self.integer()?).ok_or(PackedError)?)
        }
    )*};
}

/// Elements of a sequence or a map, and the number of those still to be read.
struct Elements<'r, 'a> {
    reader: &'r mut Reader<'a>,
    left: usize,
}

impl<'de> de::SeqAccess<'de> for Elements<'_, 'de> {
    type Error = PackedError;

    #[inline]
    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>> {
        if self.left == 0 {
            return Ok(None);
        }
        self.left -= 1;
        seed.deserialize(&mut *self.reader).map(Some)
    }

    fn size_hint(&self) -> Option<usize> {
        // An element takes a bit at least.
        Some(self.left.min((self.reader.rest.len() + 1) * usize::from(GROUP)))
    }
}

impl<'de> de::MapAccess<'de> for Elements<'_, 'de> {
    type Error = PackedError;

    fn next_key_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>> {
        de::SeqAccess::next_element_seed(self, seed)
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<T::Value> {
        seed.deserialize(&mut *self.reader)
    }
}

impl<'de> de::EnumAccess<'de> for &mut Reader<'de> {
    type Error = PackedError;
    type Variant = Self;

    fn variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<(T::Value, Self)> {
        let index = u32::try_from(self.integer()?).map_err(|_| PackedError)?;
        let index = de::IntoDeserializer::<PackedError>::into_deserializer(index);
        Ok((seed.deserialize(index)?, self))
    }
}

impl<'de> de::VariantAccess<'de> for &mut Reader<'de> {
    type Error = PackedError;

    fn unit_variant(self) -> Result<()> {
        Ok(())
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value> {
        seed.deserialize(self)
    }

    fn tuple_variant<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value> {
        visitor.visit_seq(Elements { reader: self, left: length })
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        visitor.visit_seq(Elements { reader: self, left: fields.len() })
    }
}

impl<'de> de::Deserializer<'de> for &mut Reader<'de> {
    type Error = PackedError;

    fn is_human_readable(&self) -> bool {
        false
    }

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value> {
        Err(PackedError)
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value> {
        Err(PackedError)
    }

    #[inline]
    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        visitor.visit_bool(self.bit()?)
    }

    integers! {
        deserialize_u16 visit_u16(u16) |number| u16::try_from(number).ok();
        deserialize_u32 visit_u32(u32) |number| u32::try_from(number).ok();
        deserialize_u64 visit_u64(u64) Some;
        deserialize_i16 visit_i16(i16) |number| i16::try_from(signed(number)).ok();
        deserialize_i32 visit_i32(i32) |number| i32::try_from(signed(number)).ok();
        deserialize_i64 visit_i64(i64) |number| Some(signed(number));
        deserialize_char visit_char(char) |number| char::from_u32(u32::try_from(number).ok()?);
    }

    #[inline]
    fn deserialize_u8<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        visitor.visit_u8(u8::from_le_bytes(self.item()?))
    }

    fn deserialize_i8<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        visitor.visit_i8(i8::from_le_bytes(self.item()?))
    }

    #[inline]
    fn deserialize_f32<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        visitor.visit_f32(f32::from_le_bytes(self.item()?))
    }

    #[inline]
    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        visitor.visit_f64(f64::from_le_bytes(self.item()?))
    }

    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        visitor.visit_borrowed_str(std::str::from_utf8(self.raw()?).map_err(|_| PackedError)?)
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        self.deserialize_str(visitor)
    }

    fn deserialize_bytes<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        visitor.visit_borrowed_bytes(self.raw()?)
    }

    fn deserialize_byte_buf<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        self.deserialize_bytes(visitor)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        if self.bit()? { visitor.visit_some(self) } else { visitor.visit_none() }
    }

    fn deserialize_unit<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        visitor.visit_unit()
    }

    fn deserialize_unit_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value> {
        visitor.visit_unit()
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        let left = self.length()?;
        visitor.visit_seq(Elements { reader: self, left })
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value> {
        visitor.visit_seq(Elements { reader: self, left: length })
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        length: usize,
        visitor: V,
    ) -> Result<V::Value> {
        self.deserialize_tuple(length, visitor)
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        let left = self.length()?;
        visitor.visit_map(Elements { reader: self, left })
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        self.deserialize_tuple(fields.len(), visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        visitor.visit_enum(self)
    }

    fn deserialize_identifier<V: Visitor<'de>>(self, _: V) -> Result<V::Value> {
        Err(PackedError)
    }
}
