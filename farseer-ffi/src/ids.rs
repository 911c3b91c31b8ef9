//! Ids as 64-bit numbers.
//!
//! An id has the engine's slot in its lower 29 bits, its kind in the next 3, and the generation of the slot in its upper 32. So 0 is no
//! id, an id of a body is no id of a geom, and a disposed object's id stays stale.

use farseer_core::{BodyId, GeomId, JointId, ObjectId, SpringId};

use crate::failure::{Failure, FarseerStatus, Outcome};

/// Id of an object of any kind; 0 is no object. Valid in the simulator that made it, and in those restored from its snapshots.
pub type FarseerId = u64;
/// Id of a body.
pub type FarseerBody = u64;
/// Id of a geom.
pub type FarseerGeom = u64;
/// Id of a joint.
pub type FarseerJoint = u64;
/// Id of a spring.
pub type FarseerSpring = u64;

/// Number of bits of the slot.
const SLOT_BITS: u32 = 29;
/// Number of bits of the slot and the kind together.
const KIND_END: u32 = 32;
/// Bit mask of the slot.
const SLOT_MASK: u64 = (1 << SLOT_BITS) - 1;

/// An id of the engine that the caller holds as a number.
pub(crate) trait Id: Copy {
    /// Number of the kind, 1 to 7.
    const KIND: u64;
    /// Name of the kind in messages.
    const NAME: &'static str;

    fn to_engine_bits(self) -> u64;
    fn from_engine_bits(bits: u64) -> Self;

    /// The caller's number.
    fn to_number(self) -> Outcome<u64> {
        let bits = self.to_engine_bits();
        let slot = bits & u64::from(u32::MAX);
        if slot > SLOT_MASK {
            return Err(Failure::new(FarseerStatus::LimitExceeded, "there are too many objects to number"));
        }
        Ok(bits >> KIND_END << KIND_END | Self::KIND << SLOT_BITS | slot)
    }

    /// The id that the caller's number stands for, stale or not.
    fn from_number(argument: &str, number: u64) -> Outcome<Self> {
        if kind_of(number) != Self::KIND {
            let message = format!("{argument} is {number:#x}, which is the id of no {}", Self::NAME);
            return Err(Failure::new(FarseerStatus::WrongKind, message));
        }
        Ok(Self::from_engine_bits(number >> KIND_END << KIND_END | number & SLOT_MASK))
    }
}

/// The number of the kind of an id.
fn kind_of(number: u64) -> u64 {
    number >> SLOT_BITS & 7
}

macro_rules! ids {
    ($($id:ty, $kind:literal, $name:literal;)*) => {$(
        impl Id for $id {
            const KIND: u64 = $kind;
            const NAME: &'static str = $name;

            fn to_engine_bits(self) -> u64 {
                self.to_bits()
            }

            fn from_engine_bits(bits: u64) -> Self {
                Self::from_bits(bits)
            }
        }
    )*};
}

ids! {
    BodyId, 1, "body";
    GeomId, 2, "geom";
    JointId, 3, "joint";
    SpringId, 4, "spring";
}

/// The id of an object of any kind.
pub(crate) fn object(argument: &str, number: u64) -> Outcome<ObjectId> {
    Ok(match kind_of(number) {
        BodyId::KIND => BodyId::from_number(argument, number)?.into(),
        GeomId::KIND => GeomId::from_number(argument, number)?.into(),
        JointId::KIND => JointId::from_number(argument, number)?.into(),
        SpringId::KIND => SpringId::from_number(argument, number)?.into(),
        _ => {
            let message = format!("{argument} is {number:#x}, which is the id of no object");
            return Err(Failure::new(FarseerStatus::WrongKind, message));
        }
    })
}

/// The caller's number of an object; 0 for the kinds that this interface does not have.
pub(crate) fn number_of(object: ObjectId) -> Outcome<u64> {
    match object {
        ObjectId::Body(id) => id.to_number(),
        ObjectId::Geom(id) => id.to_number(),
        ObjectId::Joint(id) => id.to_number(),
        ObjectId::Spring(id) => id.to_number(),
        _ => Ok(0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_is_recovered_from_its_number_and_never_0() {
        for bits in [0, 7, SLOT_MASK, u64::from(u32::MAX) << 32, 5 << 32 | 3] {
            let number = BodyId::from_bits(bits).to_number().unwrap();
            assert_ne!(number, 0);
            assert_eq!(BodyId::from_number("body", number).unwrap().to_bits(), bits);
        }
        assert!(BodyId::from_bits(SLOT_MASK + 1).to_number().is_err());
    }

    #[test]
    fn an_id_of_another_kind_is_no_id() {
        let number = BodyId::from_bits(0).to_number().unwrap();
        assert!(GeomId::from_number("geom", number).is_err());
        assert!(object("object", number).is_ok());
        assert!(object("object", 0).is_err());
        assert!(object("object", 7 << SLOT_BITS).is_err());
    }
}
