//! What is saved of the precise set, and taken over when everything is listed anew: everything that a later bit depends on.
//! What follows from that and from the objects is not.

mod check;
mod restore;
mod save;

use serde::{Deserialize, Serialize, Serializer};

use super::Precise;
use super::direct::{Timing, Wear};
use super::one_way::Passage;
use super::pairs::FrozenInSpace;
use super::proxies::{Mobility, Proxy};
use super::sleep::KnownJoint;
use super::space::Held;
use super::space::parts::Depths;
use super::touch::Change;
use super::tuning::Tuning;
use crate::body::{Body, BodyId};
use crate::geom::GeomId;
use crate::geom::surface::FrictionType;
use crate::math::plane::Vector;
use crate::objects::Objects;

/// The state of the precise set.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Saved {
    tuning: Tuning,
    h: f32,
    dt: f32,
    has_handled: bool,
    friction: FrictionType,
    most_contacts: u32,
    proxies: Vec<SavedProxy>,
    /// First those that may change: so many.
    pairs: Vec<SavedPair>,
    awake: u32,
    /// The gravity that things sleep under, how long others have been at rest, and what sleeps.
    gravity: [f32; 2],
    rest: Vec<(BodyId, f32)>,
    sleepers: Vec<Sleeper>,
    joints: Vec<KnownJoint>,
    /// Whether there is a depth axis.
    is_in_space: bool,
    /// How islands have fared that were solved as a whole, and when islands are asked for next.
    wear: Vec<(BodyId, Wear)>,
    timing: Timing,
    /// The ways of the last step, if something is one-way.
    ways: Vec<(BodyId, [f32; 4])>,
    /// Bodies that the game woke since the last update.
    woken: Vec<BodyId>,
    /// Pairs that began or ceased to touch since the game was told last, by creation numbers.
    changes: Vec<Change>,
}

/// A body that sleeps.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Sleeper {
    body: BodyId,
    /// The place in this list of the first one of those that fell asleep together.
    first: u32,
    place: [f32; 4],
    borne: [f32; 4],
    /// Reciprocals of mass and inertia, and what part of gravity acts.
    nature: [f32; 3],
    /// It has just fallen asleep, and does not know yet what it bears.
    is_fresh: bool,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct SavedProxy {
    geom: GeomId,
    /// Creation number of the geom, which may be gone by the time this is restored.
    number: u32,
    piece: u32,
    mobility: Mobility,
    bounds: [f32; 4],
    /// Along the depth axis.
    depths: Depths,
    motion: u32,
    has_escaped: bool,
    known: Known,
}

/// What was known of a proxy and its body when contacts were looked for: what is otherwise was edited since.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Known {
    place: [f32; 4],
    /// Reciprocals of mass and inertia, velocity of the surface, friction and restitution.
    contacts: [f32; 8],
    /// Whom it may meet, and whether it pushes.
    filter: [i32; 6],
    /// The direction against which it holds.
    one_way: Option<Vector>,
    /// [Fingerprint](crate::precise::fingerprint) of its shape.
    fingerprint: u64,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct SavedPair {
    /// Places in the list of saved proxies.
    proxies: [u32; 2],
    since: u32,
    tolerance: u32,
    is_told: bool,
    is_vetoed: bool,
    was_vetoed: bool,
    passage: Passage,
    frozen: SavedContacts,
    row: Option<SavedRow>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct SavedContacts {
    turns: [f32; 4],
    relative: [f32; 4],
    normal: [f32; 2],
    count: u32,
    anchors: [[f32; 4]; 2],
    separations: [f32; 2],
    features: [u32; 2],
    lead: f32,
    space: FrozenInSpace,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct SavedRow {
    colour: u32,
    /// Its place among the rows of the last colour, whose order matters; else 0.
    slot: u32,
    /// Seconds of the substeps that its impulses are of, if it sleeps.
    asleep: Option<f32>,
    /// The same if it is solved with its island, and its impulses with all their digits.
    direct: Option<(f32, [f64; 3])>,
    tangent_impulse: f32,
    /// Of the second tangent, of twisting, and of the whole step: in three axes.
    space: [f32; 6],
    impulses: [f32; 2],
    held: [f32; 2],
    /// A handler has taken the point off the list.
    are_dropped: [bool; 2],
    separations: [f32; 2],
    /// Friction, restitution and tangent speed, if a handler has set them: of a row that sleeps.
    kept: Option<[f32; 3]>,
    /// The same of one that is awake. For the rest of the step alone: the next one begins with those of the geoms.
    #[serde(skip)]
    surface: Option<[f32; 3]>,
}

/// What becomes of edits since what is known, when everything is listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Edits {
    /// They count.
    Taken,
    /// Those that decide what touches wait for the next update.
    Awaited,
}

impl Serialize for Precise {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.save().serialize(serializer)
    }
}

impl From<Saved> for Precise {
    fn from(saved: Saved) -> Self {
        Precise {
            h: saved.h,
            dt: saved.dt,
            friction: saved.friction,
            most_contacts: saved.most_contacts,
            space: saved.is_in_space.then(Held::new).flatten(),
            loaded: Some(saved.clone()),
            ..Precise::new(saved.tuning.unit)
        }
    }
}

impl Saved {
    /// The bodies that are of another kind by now, or have been disabled: as they were.
    fn as_they_were(&self, objects: &Objects) -> Vec<(BodyId, Body)> {
        let mut others: Vec<(BodyId, Body)> = Vec::new();
        for proxy in &self.proxies {
            let Some(id) = objects.geoms.get(proxy.geom).map(|geom| geom.body) else { continue };
            let Some(body) = objects.bodies.get(id).map(|entry| &entry.body) else { continue };
            let is_known = || others.iter().any(|&(other, _)| other == id);
            if kind_of(body) != Some(proxy.mobility) && !is_known() {
                others.push((id, of_kind(body.clone(), proxy.mobility)));
            }
        }
        others
    }
}

/// What a body is listed as, if it is.
fn kind_of(body: &Body) -> Option<Mobility> {
    let kind = match (body.is_integrated(), body.is_kinematic()) {
        (false, _) => Mobility::Fixed,
        (true, true) => Mobility::Kinematic,
        (true, false) => Mobility::Dynamic,
    };
    body.enabled().then_some(kind)
}

/// The same body, to be listed so.
fn of_kind(mut body: Body, kind: Mobility) -> Body {
    body.set_enabled(true);
    body.set_is_kinematic(kind == Mobility::Kinematic);
    body.set_is_static(kind == Mobility::Fixed);
    body
}

/// These bodies change places with those that there are, and what was disposed is there again, or is not any more.
fn go_back(others: &mut [(BodyId, Body)], objects: &mut Objects, is_back: bool) {
    for (id, other) in others {
        if let Some(entry) = objects.bodies.get_mut(*id) {
            std::mem::swap(&mut entry.body, other);
        }
    }
    objects.bodies.show_disposed(is_back);
    objects.geoms.show_disposed(is_back);
}

impl Precise {
    /// Lists what was loaded, for those who ask what touches before the next update. What was edited before the save counts
    /// from that update on, which then lists everything once more: who has been disabled or disposed since the last one, or is of
    /// another kind, is listed as it was in it.
    pub(crate) fn list_loaded(&mut self, objects: &mut Objects) {
        let Some(saved) = self.loaded.take() else { return };
        let mut others = saved.as_they_were(objects);
        go_back(&mut others, objects, true);
        self.list(objects, &saved, Edits::Awaited);
        go_back(&mut others, objects, false);
        self.edited_bodies.extend(others.into_iter().map(|(id, _)| id));
        // Of the depth axis all is told again.
        if self.is_in_space() || self.save() != saved {
            self.is_stale = true;
            self.loaded = Some(saved);
        }
    }

    /// Reciprocals of mass and inertia of a body, and what part of gravity acts on it.
    fn nature_of(&self, number: usize) -> [f32; 3] {
        let [mass, inertia] = self.bodies.inverses[number];
        [mass, inertia, self.bodies.gravity_parts[number]]
    }

    /// Position and rotation, and where it is along the depth axis.
    fn place_of(&self, number: usize) -> [f32; 4] {
        let ([x, y, ..], rotation) = (self.bodies.poses[number], self.bodies.rotations[number]);
        [x, y, rotation, self.space.as_ref().map_or(0.0, |space| space.places[number])]
    }

    fn known_of(&self, proxy: usize) -> Known {
        let Proxy {
            body,
            friction,
            restitution,
            surface_velocity,
            filter,
            responds,
            one_way,
            fingerprint,
            ..
        } = self.proxies.all[proxy];
        let ([mass, inertia], [vx, vy, spin, vz]) = (self.bodies.inverses[body as usize], surface_velocity);
        let [is, with, group, enabled, ignores] = filter;
        Known {
            place: self.place_of(body as usize),
            contacts: [mass, inertia, vx, vy, spin, vz, friction, restitution],
            filter: [is, with, group, enabled, ignores, i32::from(responds)],
            one_way,
            fingerprint,
        }
    }
}
