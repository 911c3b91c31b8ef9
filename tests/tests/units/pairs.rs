//! Pair tables and the order of the selective sweep (behaviour chapter 08) against the record.

use conformance::units::{check, floats};
use farseer_core::{GeomPairBitmap, SelectiveSweepOrder, SweepEnd};

fn whole_numbers(value: &serde_json::Value) -> Vec<i64> {
    value.as_array().unwrap().iter().map(|n| n.as_i64().unwrap()).collect()
}

/// The record counts the bits of the original's table, and queries the pair of the first and the last geom twice in both
/// orders.
#[test]
fn pairs_have_the_recorded_indices() {
    check("pair_bitmap", "GeomPairBitmap", |case| {
        let count = case.input.integer("geom_count");
        let mut table = GeomPairBitmap::new(count as usize);
        assert_eq!(table.size() * (table.size() - 1) / 2, i64::from(case.output.integer("size")));
        let pairs: Vec<(i32, i32)> = (0..count).flat_map(|x| (x + 1..count).map(move |y| (x, y))).collect();
        let indices: Vec<i64> = pairs.iter().map(|&(x, y)| table.index(x, y).unwrap()).collect();
        assert_eq!(indices, whole_numbers(case.output.value("index_of_pairs_row_major")));
        for &(x, y) in &pairs {
            assert_eq!(table.index(x, y), table.index(y, x));
        }
        let answers = case.output.value("test_and_set_first_last_twice").as_array().unwrap();
        let recorded: Vec<bool> = answers.iter().map(|answer| answer.as_bool().unwrap()).collect();
        let (first, last) = (0, count - 1);
        if first == last {
            assert!(recorded.is_empty());
            assert!(!case.output.boolean("test_after_clear"));
            return;
        }
        let asked =
            [(first, last), (last, first)].map(|(a, b)| [table.test_and_set(a, b), table.test_and_set(a, b)]);
        assert_eq!(asked.concat(), recorded);
        table.clear(count as usize);
        case.expect_bool("test_after_clear", table.test_and_set(first, last));
    });
}

fn words(order: &SelectiveSweepOrder) -> String {
    let word = |end: SweepEnd| format!("{}{}", if end.is_begin { 'b' } else { 'e' }, end.interval);
    order.ends().map(word).collect::<Vec<_>>().join(" ")
}

/// The order by value, then begins before ends, then creation: that of the port where the original throws.
fn plain_order(intervals: &[(f32, f32)]) -> String {
    let mut ends: Vec<(f32, bool, usize)> = Vec::new();
    for (index, &(begin, end)) in intervals.iter().enumerate() {
        ends.push((begin, false, index));
        ends.push((end, true, index));
    }
    ends.sort_by(|a, b| a.0.partial_cmp(&b.0).unwrap().then((a.1, a.2).cmp(&(b.1, b.2))));
    let word =
        |&(_, is_end, index): &(f32, bool, usize)| format!("{}{index}", if is_end { 'e' } else { 'b' });
    ends.iter().map(word).collect::<Vec<_>>().join(" ")
}

#[test]
fn interval_ends_are_ordered_as_recorded() {
    let thrown = std::cell::Cell::new(0);
    check("sweep_order", "SelectiveSweepOrder", |case| {
        let geoms = case.input.integer("geoms") as usize;
        let (mut x, mut y) = (SelectiveSweepOrder::new(geoms), SelectiveSweepOrder::new(geoms));
        for update in case.output.value("updates").as_array().unwrap() {
            let extents = update["extents_minx_maxx_miny_maxy"].as_array().unwrap();
            let extents: Vec<Vec<f32>> = extents.iter().map(|e| floats(e.as_str().unwrap())).collect();
            let xs: Vec<(f32, f32)> = extents.iter().map(|e| (e[0], e[1])).collect();
            let ys: Vec<(f32, f32)> = extents.iter().map(|e| (e[2], e[3])).collect();
            x.update(&xs);
            y.update(&ys);
            if update.get("throws").is_some() {
                // Which axis it was is not recorded: the original stops at the first.
                let is_plain = words(&x) == plain_order(&xs) || words(&y) == plain_order(&ys);
                assert!(is_plain, "neither {} nor {} is the plain order", words(&x), words(&y));
                thrown.set(thrown.get() + 1);
                return;
            }
            assert_eq!(words(&x), update["x_order"].as_str().unwrap());
            assert_eq!(words(&y), update["y_order"].as_str().unwrap());
        }
    });
    assert_eq!(thrown.get(), 4);
}
