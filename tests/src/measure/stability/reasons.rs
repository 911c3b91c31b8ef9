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

/// Every reason, with the letter that stands for it.
pub const LETTERS: [(&str, char); 11] = [
    (TOPPLED, 'T'),
    (SANK, 'S'),
    (BLEW_UP, 'B'),
    (TUNNELLED, 'U'),
    (NOT_FINITE, 'N'),
    (CREPT, 'C'),
    (BROKE, 'K'),
    (REFUSED, 'R'),
    (STRETCHED, 'X'),
    (STUCK, 'I'),
    (PANICKED, 'P'),
];

/// The letter of a reason: that of the list or, for one that is not there, its first letter in lower case.
pub fn letter(reason: &str) -> char {
    let known = LETTERS.iter().find(|(word, _)| *word == reason).map(|&(_, letter)| letter);
    known.or_else(|| reason.chars().next()).unwrap_or('?')
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
