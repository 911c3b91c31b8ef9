//! Measures the cost of rollback: saving, restoring and cloning 1,000 bodies, in 2D with both sets of methods and in 2.5D.
//!
//! `cargo bench -p measure --bench rollback` prints a table: the median time of many calls in µs, and the size of a snapshot in
//! bytes.

use std::hint::black_box;
use std::time::Instant;

use conformance::fixtures::plane::{add_box, add_circle, add_floor, simulator_with, v};
use farseer_core::{Methods, PhysicsSimulator};
use measure::scenes::depth::{DepthScene, build, pile, street};
use twohalf::TwoHalfPhysicsSimulator;

const BODIES: usize = 1000;
const DT: f32 = 1.0 / 60.0;
/// Number of updates after which a pile is at rest.
const UPDATES: usize = 900;
/// Number of updates before the measurement of a scene that never comes to rest.
const MOVING_UPDATES: usize = 60;
const CALLS: usize = 101;
const ROWS: [&str; 11] = [
    "contacts",
    "bytes of `snapshot`",
    "bytes of `snapshot_moving`",
    "`snapshot`",
    "`snapshot_moving`",
    "`restore`",
    "`restore_moving`",
    "`clone`",
    "`clone_from`",
    "`state_hash`",
    "`update`",
];

/// Operations that rollback needs, for either engine.
trait Engine: Clone {
    fn contacts(&self) -> usize;
    fn snapshot(&self) -> Vec<u8>;
    fn restore(&mut self, snapshot: &[u8]);
    /// The snapshot without geoms; `None` if the engine has none.
    fn snapshot_moving(&self) -> Option<Vec<u8>> {
        None
    }
    fn restore_moving(&mut self, _moving: &[u8]) {}
    /// Hash of the motion of all bodies.
    fn state_hash(&self) -> u64;
    fn update(&mut self);
}

impl Engine for PhysicsSimulator {
    fn contacts(&self) -> usize {
        self.contact_count()
    }
    fn snapshot(&self) -> Vec<u8> {
        self.snapshot()
    }
    fn restore(&mut self, snapshot: &[u8]) {
        self.restore(snapshot).expect("it was just saved");
    }
    fn snapshot_moving(&self) -> Option<Vec<u8>> {
        Some(self.snapshot_moving())
    }
    fn restore_moving(&mut self, moving: &[u8]) {
        self.restore_moving(moving).expect("it was just saved");
    }
    fn state_hash(&self) -> u64 {
        self.state_hash()
    }
    fn update(&mut self) {
        self.update(DT);
    }
}

impl Engine for TwoHalfPhysicsSimulator {
    fn contacts(&self) -> usize {
        self.contacts().count()
    }
    fn snapshot(&self) -> Vec<u8> {
        self.snapshot()
    }
    fn restore(&mut self, snapshot: &[u8]) {
        self.restore(snapshot).expect("it was just saved");
    }
    fn state_hash(&self) -> u64 {
        self.core().state_hash()
    }
    fn update(&mut self) {
        self.update(DT);
    }
}

/// Returns a simulator with boxes and circles of about 16 px that fall into a pit.
fn plane_pile(methods: Methods) -> PhysicsSimulator {
    let mut simulator = simulator_with(320.0, methods);
    add_floor(&mut simulator, (700.0, 100.0), v(0.0, 50.0));
    for x in [-350.0, 350.0] {
        add_floor(&mut simulator, (100.0, 2000.0), v(x, -900.0));
    }
    for number in 0..BODIES {
        let place = v((number % 25) as f32 * 22.0 - 264.0, -20.0 - (number / 25) as f32 * 22.0);
        let geom = if number % 2 == 0 {
            add_box(&mut simulator, (16.0, 14.0), place).1
        } else {
            add_circle(&mut simulator, 8.0, 16, place).1
        };
        simulator[geom].set_friction_coefficient(0.4);
    }
    simulator
}

fn depth(scene: &DepthScene) -> TwoHalfPhysicsSimulator {
    build(scene).0
}

/// Returns the median time of a call, in µs, as text.
fn median(mut call: impl FnMut()) -> String {
    let mut times: Vec<f64> = (0..CALLS)
        .map(|_| {
            let start = Instant::now();
            call();
            start.elapsed().as_secs_f64() * 1e6
        })
        .collect();
    times.sort_unstable_by(f64::total_cmp);
    format!("{:.1} µs", times[CALLS / 2])
}

/// Returns the column of a simulator in the table: one cell per row, measured after `updates` updates.
fn column(mut simulator: impl Engine, updates: usize) -> [String; ROWS.len()] {
    (0..updates).for_each(|_| simulator.update());
    let snapshot = simulator.snapshot();
    let moving = simulator.snapshot_moving();
    let mut copy = simulator.clone();
    let if_moving = |cell: &mut dyn FnMut(&[u8]) -> String| moving.as_deref().map(cell).unwrap_or_default();
    [
        simulator.contacts().to_string(),
        snapshot.len().to_string(),
        if_moving(&mut |moving| moving.len().to_string()),
        median(|| drop(black_box(simulator.snapshot()))),
        if_moving(&mut |_| median(|| drop(black_box(simulator.snapshot_moving())))),
        median(|| copy.restore(&snapshot)),
        if_moving(&mut |moving| median(|| copy.restore_moving(moving))),
        median(|| drop(black_box(simulator.clone()))),
        median(|| copy.clone_from(&simulator)),
        median(|| {
            black_box(simulator.state_hash());
        }),
        median(|| copy.update()),
    ]
}

fn main() {
    let columns = [
        ("2D pile, faithful", column(plane_pile(Methods::default()), UPDATES)),
        ("2D pile, precise", column(plane_pile(Methods::PRECISE), UPDATES)),
        ("2.5D pile", column(depth(&pile(BODIES)), UPDATES)),
        ("2.5D street, in motion", column(depth(&street(BODIES)), MOVING_UPDATES)),
    ];
    let row = |name: &str, cells: Vec<&str>| println!("| {name} | {} |", cells.join(" | "));
    row("1,000 bodies", columns.iter().map(|(name, _)| *name).collect());
    row("---", vec!["---"; columns.len()]);
    for (at, name) in ROWS.iter().enumerate() {
        row(name, columns.iter().map(|(_, cells)| cells[at].as_str()).collect());
    }
}
