//! Every public member of Farseer 2.1.3 has a row in a table. The table is `docs/farseer-api.csv`: each member is mapped to its
//! equivalent in Rust, or excused by one of a few reasons. The names of the table exist, as far as a compiler can tell.

#[macro_use]
mod macros;

mod aliases;
mod appendix;
mod packages;

use std::collections::BTreeSet;
use std::ops::{Add, Mul, Neg, Sub};

use conformance::trace::hash::Fnv;
use farseer_core::math::{ConvertUnits, Vector2};
use farseer_core::{
    AabbFluidContainer, BodyId, Context, ControllerId, EventHandler, GeomId, GeomPlacement, JointId,
    PhysicsSimulator, Result, SpringId, UserController, Vertices,
};
use serde::Deserialize;

const TABLE: &str = include_str!("../../../docs/farseer-api.csv");

/// Number of public members of the original.
const MEMBERS: usize = 1077;
/// Hash of the original's list by [`hash_of_members`].
const HASH_OF_MEMBERS: u64 = 0xf143_d9f2_e1b4_9dd3;

/// The reasons for which a member may have no counterpart.
const EXCUSES: [&str; 2] = [
    // Pools, lists, counters and sort buffers that the original failed to hide, overrides that do nothing, and constructors of
    // abstract classes.
    "accidental internals",
    // Objects without an identity of their own here. Where Rust has the operator, the member is mapped.
    "equality and hash plumbing",
];
/// Greatest percentage of the members that may be excused, in percent.
const EXCUSED_PERCENT: usize = 15;

/// Members that anybody could set in the original, and that are only read here.
const READ_ONLY: [(&str, &str); 13] = [
    // Every update writes it.
    ("Geom", "AABB"),
    ("Geom", "CollisionId"),
    // The result of the last query of a point.
    ("WaveController", "VectorFarWaveEdge"),
    ("WaveController", "VectorNearWaveEdge"),
    ("WaveController", "VectorPoint"),
    // Handing in a clock switches it on.
    ("PhysicsSimulator", "EnableDiagnostics"),
    // Follows adding and removing.
    ("Geom", "InSimulation"),
    // The engine's own state.
    ("Arbiter", "GeometryA"),
    ("Arbiter", "GeometryB"),
    ("DistanceGridData", "AABB"),
    ("DistanceGridData", "GridCellSize"),
    ("DistanceGridData", "GridCellSizeInv"),
    ("DistanceGridData", "Nodes"),
];

/// A handler that leaves everything as it is.
struct Silent;
impl EventHandler for Silent {}

/// A controller that does nothing.
struct Idle;
impl UserController for Idle {
    fn update(&mut self, _: &mut Context<'_>, _: ControllerId, _: f32, _: f32) {}
}

/// A row of the table: a member and its counterpart. The first four fields are facts about the original.
#[derive(Deserialize)]
struct Row {
    #[serde(rename = "type")]
    of: String,
    member: String,
    #[serde(rename = "member_kind")]
    kind: String,
    signature: String,
    rust: String,
    #[serde(default)]
    excuse: String,
}

impl Row {
    fn paths(&self) -> impl Iterator<Item = &str> {
        self.rust.split(' ').filter(|path| !path.is_empty())
    }
}

/// The rows of a table.
fn rows_of(table: &str) -> Vec<Row> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    reader.deserialize().map(|row| row.unwrap_or_else(|error| panic!("{error}"))).collect()
}

fn rows() -> Vec<Row> {
    rows_of(TABLE)
}

/// The names of the table, made from it: it compiles, so they exist.
fn named() -> Vec<&'static str> {
    include!(concat!(env!("OUT_DIR"), "/farseer-api.rs"))
}

/// FNV-1a over type, member and signature, each with a line end.
fn hash_of_members(rows: &[Row]) -> u64 {
    let mut hash = Fnv::EMPTY;
    for cell in rows.iter().flat_map(|row| [&row.of, &row.member, &row.signature]) {
        hash.bytes(cell.as_bytes());
        hash.bytes(b"\n");
    }
    hash.finish()
}

#[test]
fn api_table_has_every_member_of_the_original() {
    let rows = rows();
    assert_eq!((rows.len(), hash_of_members(&rows)), (MEMBERS, HASH_OF_MEMBERS));
}

#[test]
fn api_table_maps_or_excuses_every_member() {
    let rows = rows();
    for Row { of, member, rust, excuse, .. } in &rows {
        assert!(rust.is_empty() != excuse.is_empty(), "{of}.{member} is either mapped or excused");
    }
    let excuses: BTreeSet<&str> =
        rows.iter().map(|row| row.excuse.as_str()).filter(|e| !e.is_empty()).collect();
    assert_eq!(excuses, BTreeSet::from(EXCUSES));
    let excused = rows.iter().filter(|row| row.rust.is_empty()).count();
    let mapped = rows.len() - excused;
    println!("api coverage: {mapped} mapped, {excused} excused, {} %", (mapped + excused) * 100 / MEMBERS);
    assert!(excused * 100 <= rows.len() * EXCUSED_PERCENT, "{excused} are excused");
}

#[test]
fn api_table_names_existing_items() {
    let rows = rows();
    let in_table: Vec<&str> = rows.iter().flat_map(Row::paths).collect();
    assert_eq!(named(), in_table, "what is compiled is what the table names");
}

#[test]
fn api_members_that_could_be_set_can_be_set() {
    for row in &rows() {
        let Row { of, member, kind, signature, rust, excuse } = row;
        let is_variable =
            kind == "field" && !signature.starts_with("const") && !signature.contains("EventHandler");
        // A protected setter is for the engine.
        let is_set = is_variable || signature.contains(" set; ") && !signature.contains(" protected set; ");
        if excuse.is_empty() && is_set && !READ_ONLY.contains(&(of, member)) {
            let sets = |path: &str| {
                path.contains('.')
                    || path.contains("::set_")
                    || path.ends_with("::set")
                    || path.ends_with("::dispose")
            };
            assert!(row.paths().any(sets), "{of}.{member}: {rust}");
        }
    }
}
