//! The precise set: bodies, pairs and contacts of their own, behind the same API.
//!
//! It shares the objects with the faithful set, and nothing of its arithmetic. A step, in the order of [`step`]:
//!
//! 1. what was edited is taken over ([`sync`]);
//! 2. pairs whose bounds part go, and new ones come ([`grid`], [`pairs`]);
//! 3. pairs that moved are looked at ([`touch`], [`manifold`]), and rows come and go ([`rows`]);
//! 4. joints are read, and which of them can be solved at once ([`joints`]);
//! 5. bodies are read ([`bodies`]), islands that can be are solved as a whole ([`direct`]), velocities of the others in
//!    substeps ([`passes`]), and bodies written ([`moving`]);
//! 6. what has come to rest falls asleep ([`sleep`]), until something wakes it ([`wake`]).
//!
//! For an engine on top of this one all of it works in three axes ([`space`]).
//!
//! Lengths are the user's; the numbers of the method ([`parameters`]) are parts of one length ([`tuning`]).

mod bodies;
mod continuous;
mod direct;
pub(crate) mod dormant;
mod driven;
mod elimination;
mod fingerprint;
mod flight;
mod flush;
mod grid;
mod islands;
mod joined_flights;
mod joints;
mod manifold;
mod meeting;
mod members;
mod moving;
mod nearby;
mod one_way;
mod outline;
mod pair_finder;
mod pairs;
mod parameters;
mod passes;
mod pivoting;
mod pivots;
mod proxies;
mod rolling;
mod round;
mod rows;
mod saved;
mod seams;
mod sleep;
pub(crate) mod space;
mod step;
mod sync;
mod telling;
mod told;
mod touch;
mod tuning;
mod unpushed;
mod wake;

use serde::Deserialize;

use crate::body::BodyId;
use crate::geom::GeomId;
use crate::geom::surface::FrictionType;
use crate::storage::reusing_clone::reusing_clone;
use saved::Saved;
pub use sleep::WhyAwake;
pub use telling::{Island, IslandCost, IslandMethod, IslandResidual, WhyMethod};
pub(crate) use tuning::Step;

use bodies::Bodies;
use continuous::Flight;
use direct::Direct;
use grid::Grid;
use joints::Joints;
use joints::springs::Springs;
use nearby::Loose;
use pairs::Pairs;
use proxies::Proxies;
use rolling::Roll;
use rows::{Palette, Rows};
use sleep::Sleep;
use space::{Held, Space};
use touch::{Change, Looks, Touch};
use tuning::Tuning;

/// What the precise set keeps from step to step.
#[derive(Debug, Deserialize)]
#[serde(from = "Saved")]
pub(crate) struct Precise {
    tuning: Tuning,
    /// Seconds of the substep that impulses were found for.
    h: f32,
    /// Seconds of the last step: bounds reach ahead by what moves in a few of them.
    dt: f32,
    /// What gravity adds to velocities in a step.
    fall: crate::math::plane::Vector,
    /// What was loaded, until the bodies are listed.
    loaded: Option<Saved>,
    /// Bodies or geoms became what they were not.
    is_stale: bool,
    /// Bodies or geoms came or went, and nothing else.
    has_new_members: bool,
    /// Something bounces.
    bounces: bool,
    friction: FrictionType,
    /// Contacts of two pieces, at most.
    most_contacts: u32,
    bodies: Bodies,
    proxies: Proxies,
    grid: Grid,
    pairs: Pairs,
    rows: Rows,
    palette: Palette,
    joints: Joints,
    /// Springs that are rows in this update.
    springs: Springs,
    sleep: Sleep,
    direct: Direct,
    /// The depth axis, for an engine that has it.
    space: Option<Held<Box<Space>>>,
    /// Numbers of bodies and first proxies of geoms, by slot.
    body_numbers: Vec<u32>,
    first_proxies: Vec<u32>,
    /// The geoms that queries look at whatever the grid says, in the order of their list.
    loose: Vec<Loose>,
    /// Bodies in the list that take no part because they are disabled.
    absent: Vec<BodyId>,
    /// Lent out for editing since the last look.
    edited_bodies: Vec<BodyId>,
    edited_geoms: Vec<GeomId>,
    /// Those that the game woke.
    woken: Vec<BodyId>,
    /// Pairs of geoms that begin or cease to touch in this step.
    changes: Vec<Change>,
    /// Empty between stages: see [`Touch`].
    parted: Vec<(BodyId, f32)>,
    looks: Looks,
    /// Pairs that are to be looked at, while they are.
    due: Vec<u32>,
    /// Contacts of polygons that roll over a static face, found in this step.
    rolling: Vec<Roll>,
    /// Some pair was refused or changed by a handler, for one step.
    has_handled: bool,
    /// Bodies that move by more than their cores in this step; and the sensors that a fast body crosses within it, with the
    /// geoms that cross them. Of no use between steps.
    fast: Vec<Flight>,
    flown: Vec<[(u32, GeomId); 2]>,
    /// Proxies whose bounds are wider for a step.
    widened: Vec<u32>,
    /// Proxies of static and kinematic bodies whose pairs were searched in this step.
    unpushed: Vec<u32>,
    /// Empty between stages.
    lost: Vec<u32>,
    found: Vec<[u32; 2]>,
    /// Whether a proxy is a partner already of that whose pairs are looked for. All false between searches.
    known: Vec<bool>,
    touching: Vec<(u128, u32)>,
}

reusing_clone! {
    Precise {
        tuning, h, dt, fall, loaded, is_stale, has_new_members, bounces, friction, most_contacts, bodies, proxies,
        grid, pairs, rows, palette, joints, springs, sleep, direct, space, body_numbers, first_proxies, loose, absent,
        edited_bodies, edited_geoms, woken, changes, parted, looks, due, rolling, has_handled, fast, flown, widened, unpushed,
        lost, found,
        known, touching
    }
}

impl Precise {
    /// The depth axis, for an engine that has it.
    pub(crate) fn space_mut(&mut self) -> Option<&mut Space> {
        self.space.as_deref_mut()
    }

    /// For things of about this size.
    pub(crate) fn new(length_unit: f32) -> Self {
        Precise {
            tuning: Tuning::new(length_unit),
            h: 0.0,
            dt: 0.0,
            fall: [0.0; 2],
            loaded: None,
            is_stale: true,
            has_new_members: false,
            bounces: false,
            friction: FrictionType::default(),
            most_contacts: 2,
            bodies: Bodies::default(),
            proxies: Proxies::default(),
            grid: Grid::default(),
            pairs: Pairs::default(),
            rows: Rows::default(),
            palette: Palette::default(),
            joints: Joints::default(),
            springs: Springs::default(),
            sleep: Sleep::default(),
            direct: Direct::default(),
            space: None,
            body_numbers: Vec::new(),
            first_proxies: Vec::new(),
            loose: Vec::new(),
            absent: Vec::new(),
            edited_bodies: Vec::new(),
            edited_geoms: Vec::new(),
            woken: Vec::new(),
            changes: Vec::new(),
            parted: Vec::new(),
            looks: Looks::default(),
            due: Vec::new(),
            rolling: Vec::new(),
            has_handled: false,
            fast: Vec::new(),
            flown: Vec::new(),
            widened: Vec::new(),
            unpushed: Vec::new(),
            lost: Vec::new(),
            found: Vec::new(),
            known: Vec::new(),
            touching: Vec::new(),
        }
    }

    /// What the search for contacts takes of this.
    fn touch(&mut self) -> Touch<'_> {
        Touch {
            bodies: &self.bodies,
            proxies: &self.proxies,
            pairs: &mut self.pairs,
            rows: &mut self.rows,
            palette: &mut self.palette,
            sleep: &mut self.sleep,
            direct: &mut self.direct,
            space: self.space.as_ref().map(Held::lend),
            tuning: &self.tuning,
            friction: self.friction,
            most_contacts: self.most_contacts as usize,
            dt: self.dt,
            fall: self.fall,
            changes: &mut self.changes,
            parted: &mut self.parted,
            looks: &mut self.looks,
            due: &mut self.due,
            rolling: &mut self.rolling,
        }
    }
}
