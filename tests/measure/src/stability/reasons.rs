//! Reasons of failures as words, and the letters that stand for them on a stability map.

/// Failure: a body fell over, or left its position sideways.
pub const TOPPLED: &str = "toppled";
/// Failure: a body is lower than it can be without overlaps.
pub const SANK: &str = "sank";
/// Failure: a body is faster or higher than anything in the scene could make it.
pub const BLEW_UP: &str = "blew up";
/// Failure: a body is behind the obstacle that should have stopped it.
pub const TUNNELLED: &str = "tunnelled";
/// Failure: the state of a body is not finite, or the body was disabled because it would have become so.
pub const NOT_FINITE: &str = "not finite";
/// Failure: a body moves slowly although it should be at rest.
pub const CREPT: &str = "crept";
/// Failure: a joint that should have held is broken.
pub const BROKE: &str = "broke";
/// Failure: the engine rejected the scene.
pub const REFUSED: &str = "refused";
/// Failure: the ends of a joint are apart.
pub const STRETCHED: &str = "stretched";
/// Failure: a body does not move, or not far enough, although it should.
pub const STUCK: &str = "stuck";
/// Failure: the engine panicked.
pub const PANICKED: &str = "panicked";

/// Failure: a body moved sideways although no contact should have moved it.
pub const ASIDE: &str = "aside";
/// Failure: a body flies up from the surface on which it should rest.
pub const BOUNCED: &str = "bounced";
/// Failure: a body is on top of the obstacle that should have stopped it, or above the gap into which it should have fallen.
pub const CLIMBED: &str = "climbed";
/// Failure: a body or shadow is at a wrong position.
pub const MISPLACED: &str = "misplaced";
/// Failure: a body left the field through a wall.
pub const LEFT: &str = "left";
/// Failure: a body missed another body that it should have hit.
pub const MISSED: &str = "missed";
/// Failure: a body flies back slower than it should.
pub const SLOWED: &str = "slowed";
/// Failure: a body touched another body that it should have missed.
pub const TOUCHED: &str = "touched";
/// Failure: a body changed its direction at a seam between two surfaces.
pub const STUMBLED: &str = "stumbled";
/// Failure: a hit changed the velocity along another axis than the one in which the bodies began to overlap last.
pub const WRONG_AXIS: &str = "wrong axis";

/// All reasons of failure with their letters on a stability map. Small letters are for the 2.5D engine alone.
pub const LETTERS: [(&str, char); 21] = [
    (TOPPLED, 'T'),
    (SANK, 'S'),
    (BLEW_UP, 'B'),
    (TUNNELLED, 'U'),
    (NOT_FINITE, 'N'),
    (CREPT, 'C'),
    (BROKE, 'K'),
    (REFUSED, 'R'),
    (STRETCHED, 'X'),
    (STUCK, 'J'),
    (PANICKED, 'P'),
    (ASIDE, 'a'),
    (BOUNCED, 'b'),
    (CLIMBED, 'c'),
    (MISPLACED, 'd'),
    (LEFT, 'l'),
    (MISSED, 'm'),
    (SLOWED, 'z'),
    (TOUCHED, 't'),
    (STUMBLED, 'v'),
    (WRONG_AXIS, 'w'),
];

/// Returns the letter of a reason; a question mark for a reason that is not in [`LETTERS`].
pub fn letter(reason: &str) -> char {
    LETTERS.iter().find(|(word, _)| *word == reason).map_or('?', |&(_, letter)| letter)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_reason_has_a_letter_of_its_own() {
        let letters: BTreeSet<char> = LETTERS.iter().map(|&(_, letter)| letter).collect();
        assert_eq!(letters.len(), LETTERS.len());
    }
}
