//! The words for what went wrong, and the letters that stand for them on a map.

/// Fell over, or left its place sideways.
pub const TOPPLED: &str = "toppled";
/// Lies lower than its parts can, one in the other.
pub const SANK: &str = "sank";
/// Faster or higher than anything in the scene could make it.
pub const BLEW_UP: &str = "blew up";
/// Is behind what should have stopped it.
pub const TUNNELLED: &str = "tunnelled";
/// Is not a number, or stopped taking part because it would not have been one.
pub const NOT_FINITE: &str = "not finite";
/// Moves slowly where it should stand.
pub const CREPT: &str = "crept";
/// A joint that should have held is broken.
pub const BROKE: &str = "broke";
/// The engine would not take the scene.
pub const REFUSED: &str = "refused";
/// The ends of a joint are apart.
pub const STRETCHED: &str = "stretched";
/// Does not move, or not far enough, where it should.
pub const STUCK: &str = "stuck";
/// The engine panicked.
pub const PANICKED: &str = "panicked";

/// Moved aside by somebody who should not have.
pub const ASIDE: &str = "aside";
/// Flies up from where it should lie.
pub const BOUNCED: &str = "bounced";
/// Is on what should have stopped it, or over what it should have fallen into.
pub const CLIMBED: &str = "climbed";
/// Not where it belongs.
pub const MISPLACED: &str = "misplaced";
/// Left the field through a wall.
pub const LEFT: &str = "left";
/// Missed what should have been hit.
pub const MISSED: &str = "missed";
/// Flies back slower than it should.
pub const SLOWED: &str = "slowed";
/// Touched what should have been missed.
pub const TOUCHED: &str = "touched";
/// Changed its way over a seam.
pub const STUMBLED: &str = "stumbled";
/// Thrown back along another axis than that on which it came last.
pub const WRONG_AXIS: &str = "wrong axis";

/// Every reason, with the letter that stands for it: small ones for those of the 2.5D engine alone.
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

/// The letter of a reason; a question mark for one that is not in the list.
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
