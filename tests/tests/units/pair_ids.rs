//! Packing of pairs against the recorded vectors (behaviour chapter 08, section 4).

use conformance::units::check;
use farseer_core::PairId;

#[test]
fn pairs_are_packed_as_recorded() {
    check("math", "PairID", |case| {
        let (a, b) = (case.input.integer("a"), case.input.integer("b"));
        assert_eq!(PairId::get_id(a, b).to_string(), case.output.text("id"), "id of {a}, {b}");
        assert_eq!(PairId::get_hash(a, b).to_string(), case.output.text("hash"), "hash of {a}, {b}");
    });
}

#[test]
fn a_packed_pair_is_unpacked_in_the_order_of_its_words() {
    for (a, b) in [(7, 3), (-1, 2), (2, -1), (i32::MIN, i32::MAX), (0, 0)] {
        assert_eq!(PairId::get_ids(PairId::get_hash(a, b)), (a, b));
    }
}
