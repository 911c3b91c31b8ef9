//! Every member of the thesis' API has a row in a table: appendix A, and the additions of section 3.3. The table is
//! `docs/twohalf-appendix.csv`; its names exist, as far as a compiler can tell.

use std::collections::BTreeSet;

use farseer_core::{Body, BodyId, CollisionCategory, Geom, GeomId, GeomPlacement, Vertices};
use twohalf::{
    ContactTarget, EventHandler, Ground, PlatformId, Result, TextureId, TwoHalfPhysicsSimulator, Vector2,
    Vector3,
};

use super::{Row, rows_of};

const TABLE: &str = include_str!("../../../docs/twohalf-appendix.csv");
/// Number of members of the thesis' API.
const MEMBERS: usize = 95;

// With these the table means views of a simulator that may be changed.
type TwoHalfBody = twohalf::TwoHalfBody<&'static mut TwoHalfPhysicsSimulator>;
type GroundMut<'a> = twohalf::GroundMut<'a, &'static mut TwoHalfPhysicsSimulator>;
type TwoHalfGeom = twohalf::TwoHalfGeom<'static>;
type GeomRef = farseer_core::GeomRef<'static>;

/// A handler that leaves everything as it is.
struct Silent;
impl EventHandler for Silent {}

fn rows() -> Vec<Row> {
    rows_of(TABLE)
}

/// The names of the table, made from it: it compiles, so they exist.
#[expect(clippy::type_complexity, reason = "these are the types of the thesis' members")]
fn named() -> Vec<&'static str> {
    include!(concat!(env!("OUT_DIR"), "/twohalf-appendix.rs"))
}

#[test]
fn appendix_table_maps_every_member_once() {
    let rows = rows();
    let members: BTreeSet<_> = rows.iter().map(|row| (&row.of, &row.member)).collect();
    let is_mapped = |row: &&Row| row.paths().next().is_some() && row.paths().all(|path| path.contains("::"));
    let mapped = rows.iter().filter(is_mapped).count();
    println!("appendix coverage: {mapped} of {MEMBERS}");
    assert_eq!((rows.len(), members.len(), mapped), (MEMBERS, MEMBERS, MEMBERS));
}

#[test]
fn appendix_table_names_existing_items() {
    let rows = rows();
    let in_table: Vec<&str> = rows.iter().flat_map(Row::paths).collect();
    assert_eq!(named(), in_table, "what is compiled is what the table names");
}

#[test]
fn appendix_properties_that_can_be_set_have_a_setter() {
    for row in &rows() {
        let Row { of, member, kind, signature, rust, .. } = row;
        let is_event = signature.ends_with("EventHandler");
        if (kind == "field" && !is_event) || signature.ends_with("get/set") {
            let paths: Vec<&str> = row.paths().collect();
            let sets = |path: &str| path.contains("::set_") || path.ends_with("::dispose");
            assert!(paths.len() == 2 && !sets(paths[0]) && sets(paths[1]), "{of}.{member}: {rust}");
        }
    }
}
