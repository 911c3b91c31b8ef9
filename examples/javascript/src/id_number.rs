//! Ids as numbers: JavaScript keeps them, and the engines notice when they are stale.

use farseer_core::{BodyId, ControllerId, GeomId, JointId, SpringId};

use crate::boundary::{Answer, Argument, Failure, Outcome};

/// Number of slots below which, and of generations of the rest, ids are exact: 2^24 slots, and 2^29 objects one after the other
/// in each.
const SLOTS: f64 = 16_777_216.0;
const GENERATIONS: u32 = 1 << 29;

/// The number of the bits of an id.
fn to_number(bits: u64) -> Outcome<f64> {
    let (slot, generation) = (f64::from(bits as u32), (bits >> 32) as u32);
    if slot < SLOTS && generation < GENERATIONS {
        Ok(slot + SLOTS * f64::from(generation))
    } else {
        Err(Failure::because(&"there are too many things to number"))
    }
}

/// No id has these bits.
const NONE: u64 = u64::MAX;

/// The bits of the id that a number represents, or none.
#[inline(never)]
fn from_number(number: f64) -> u64 {
    if !(0.0..SLOTS * f64::from(GENERATIONS)).contains(&number) {
        return NONE;
    }
    let generation = (number / SLOTS).floor();
    let slot = (number - generation * SLOTS) as u32;
    u64::from(generation as u32) << 32 | u64::from(slot)
}

macro_rules! numbered {
    ($($id:ty),*) => {$(
        impl Argument for $id {
            const REQUIREMENT: &'static str = "an id";

            #[inline]
            fn read(number: f64) -> Option<Self> {
                let bits = from_number(number);
                (bits != NONE).then(|| Self::from_bits(bits))
            }
        }

        impl Answer for $id {
            fn number(self) -> Outcome<f64> {
                to_number(self.to_bits())
            }
        }
    )*};
}

numbered!(BodyId, GeomId, JointId, SpringId, ControllerId);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_are_recovered_from_their_numbers_over_the_full_range() {
        for (slot, generation) in [(0_u32, 0), (5, 0), (0, 7), (16_777_215, GENERATIONS - 1)] {
            let id = BodyId::from_bits(u64::from(generation) << 32 | u64::from(slot));
            assert_eq!(id.slot(), slot as usize);
            assert_eq!(BodyId::read(id.number().unwrap()), Some(id));
        }
    }

    #[test]
    fn ids_that_no_number_can_represent_are_refused() {
        for bits in [16_777_216, u64::from(GENERATIONS) << 32] {
            assert!(BodyId::from_bits(bits).number().is_err());
        }
    }

    #[test]
    fn a_number_that_is_no_id_is_refused() {
        for number in [-1.0, f64::NAN, f64::INFINITY, SLOTS * f64::from(GENERATIONS)] {
            assert_eq!(BodyId::read(number), None, "{number}");
        }
    }
}
