//! Ids as numbers: JavaScript keeps them, and the engines notice when they are stale.

use farseer_core::{BodyId, ControllerId, GeomId, JointId, SpringId};
use serde::Serialize;
use serde::de::DeserializeOwned;
use twohalf::PlatformId;

use crate::boundary::{Answer, Argument, Failure, Outcome, invalid};

/// Slots below this, and generations of the rest, are told exactly: 2^24 slots, and 2^29 things one after the other in each.
const SLOTS: f64 = 16_777_216.0;
const GENERATIONS: u32 = 1 << 29;

/// The id of slot and generation; both are what `serde` writes of it, and nothing else is.
fn from_parts<I: DeserializeOwned>(parts: impl Serialize) -> Option<I> {
    let mut room = [0; 16];
    let bytes = postcard::to_slice(&parts, &mut room).ok()?;
    postcard::from_bytes(bytes).ok()
}

pub(crate) fn to_number<I: Serialize>(id: I) -> Outcome<f64> {
    let used_up = Failure("there are too many things to number".to_owned());
    let (slot, generation): (u32, u32) = from_parts(id).ok_or(used_up.clone())?;
    if f64::from(slot) < SLOTS && generation < GENERATIONS {
        Ok(f64::from(slot) + SLOTS * f64::from(generation))
    } else {
        Err(used_up)
    }
}

fn from_number<I: DeserializeOwned>(name: &'static str, number: f64) -> Outcome<I> {
    if number >= 0.0 && number < SLOTS * f64::from(GENERATIONS) {
        let generation = (number / SLOTS).floor();
        let parts = ((number - generation * SLOTS) as u32, generation as u32);
        if let Some(id) = from_parts(parts) {
            return Ok(id);
        }
    }
    invalid(name, number, "an id")
}

macro_rules! numbered {
    ($($id:ty),*) => {$(
        impl Argument for $id {
            fn read(name: &'static str, number: f64) -> Outcome<Self> {
                from_number(name, number)
            }
        }

        impl Answer for $id {
            fn number(self) -> Outcome<f64> {
                to_number(self)
            }
        }
    )*};
}

numbered!(BodyId, GeomId, JointId, SpringId, ControllerId);

/// Numbers of platforms are never given out twice.
impl Argument for PlatformId {
    fn read(name: &'static str, number: f64) -> Outcome<Self> {
        let known = u32::try_from(usize::read(name, number)?).ok().and_then(from_parts);
        known.map_or_else(|| invalid(name, number, "an id"), Ok)
    }
}

impl Answer for PlatformId {
    fn number(self) -> Outcome<f64> {
        let number: Option<u32> = from_parts(self);
        number.map(f64::from).ok_or(Failure("the platform cannot be numbered".to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_come_back_from_their_numbers_over_the_whole_range() {
        for parts in [(0_u32, 0), (5, 0), (0, 7), (16_777_215, GENERATIONS - 1)] {
            let id: BodyId = from_parts(parts).unwrap();
            assert_eq!(id.slot(), parts.0 as usize);
            assert_eq!(BodyId::read("body", to_number(id).unwrap()), Ok(id));
        }
    }

    #[test]
    fn ids_that_no_number_can_tell_are_refused_instead_of_naming_something_else() {
        for parts in [(16_777_216_u32, 0_u32), (0, GENERATIONS)] {
            assert!(to_number(from_parts::<BodyId>(parts).unwrap()).is_err());
        }
    }

    #[test]
    fn what_is_no_id_is_refused_by_the_name_of_the_argument() {
        for number in [-1.0, f64::NAN, f64::INFINITY] {
            let Err(Failure(text)) = BodyId::read("body", number) else { panic!("{number} is no id") };
            assert!(text.starts_with("body is "), "{text}");
        }
    }
}
