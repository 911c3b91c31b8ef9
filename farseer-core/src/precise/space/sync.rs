//! What the engine above has told is taken over.

use super::parts::{self, SpaceBody, SpacePartner, SpaceProfile, is_geom};
use super::{Held, Space, Spin};
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::objects::Objects;
use crate::precise::Precise;

/// Told between updates.
impl Precise {
    pub(crate) fn is_in_space(&self) -> bool {
        self.space.is_some()
    }

    /// There is a depth axis from now on.
    pub(crate) fn enter_space(&mut self) {
        self.space = Held::new();
    }

    /// How a body moves along the depth axis.
    pub(crate) fn set_space_body(&mut self, id: BodyId, told: SpaceBody) {
        let Some(space) = self.space.as_deref_mut() else { return };
        *space.body_mut(id) = told;
        self.edited_bodies.push(id);
    }

    /// A force gives a body so much along the depth axis in a second, in the step that comes, and has pushed it otherwise.
    pub(crate) fn note_push(&mut self, id: BodyId, along_depth: f32) {
        let Some(number) = self.movable_number_of(id) else { return };
        if let Some(space) = self.space.as_deref_mut() {
            space.push_along_depth(id, along_depth);
        }
        self.note_pushed_body(number);
    }

    /// What forces give a body along the depth axis in the step that comes, so far.
    pub(crate) fn pushed_along_depth(&self, id: BodyId) -> f32 {
        self.space.as_ref().map_or(0.0, |space| space.acceleration(id))
    }

    /// The number of a body that is moved in updates.
    fn movable_number_of(&self, id: BodyId) -> Option<usize> {
        self.number_of(id).filter(|&number| number < self.bodies.first_fixed())
    }

    /// Which of these bodies are not moved, and what pushes them along the depth axis.
    pub(crate) fn absent_in_space(&self, ids: [Option<BodyId>; 2]) -> [Option<(BodyId, f32)>; 2] {
        ids.map(|id| {
            let (id, space) = (id?, self.space.as_ref()?);
            self.movable_number_of(id).is_none().then(|| (id, space.acceleration(id)))
        })
    }

    /// How a geom reaches along the depth axis.
    pub(crate) fn set_space_profile(&mut self, id: GeomId, told: SpaceProfile) {
        let Some(space) = self.space.as_deref_mut() else { return };
        let known = space.profile_mut(id);
        if *known != told {
            *known = told;
            self.is_stale |= self.proxy_of(id, 0).is_some();
        }
    }

    /// What the engine above is told of bodies after an update: of those that were awake.
    pub(crate) fn space_moved(&self) -> impl Iterator<Item = (BodyId, SpaceBody)> + '_ {
        let space = self.space.as_ref();
        self.sleep.awake(self.bodies.count).filter_map(move |number| {
            let id = self.bodies.ids[number]?;
            Some((id, space?.body(id)))
        })
    }

    /// Who has fallen asleep at the end of the last update in which anything may have happened.
    pub(crate) fn space_rested(&self) -> impl Iterator<Item = (BodyId, SpaceBody)> + '_ {
        self.space.iter().flat_map(|space| space.rested.iter().map(|&id| (id, space.body(id))))
    }
}

impl Space {
    /// Whether a body does not move along the depth axis, nor is pushed along it, nor rolls.
    fn rests(&self, number: Option<usize>, id: BodyId) -> bool {
        let SpaceBody { velocity, acceleration, angular_velocity, .. } = self.body(id);
        let is_ball = number.is_some_and(|number| self.are_balls[number]);
        velocity == 0.0 && acceleration == 0.0 && (angular_velocity == [0.0; 2] || !is_ball)
    }
}

/// Taken over.
impl Precise {
    pub(in crate::precise) fn was_moved_in_space(&self, number: usize, id: BodyId) -> bool {
        self.space.as_ref().is_some_and(|space| space.places[number] != space.body(id).z)
    }

    pub(in crate::precise) fn rests_in_space(&self, id: BodyId) -> bool {
        self.space.as_ref().is_none_or(|space| space.rests(self.number_of(id), id))
    }

    pub(in crate::precise) fn take_body_in_space(&mut self, number: usize, id: BodyId) {
        let Some(space) = self.space.as_deref_mut() else { return };
        let told = space.body(id);
        space.places[number] = told.z;
        if let Some(hot) = self.bodies.hot.get_mut(number) {
            hot.velocity[3] = told.velocity;
            let [x, y] = told.angular_velocity;
            space.spins[number] = Spin { velocity: [x, y, 0.0, 0.0], ..Spin::default() };
        }
    }

    pub(in crate::precise) fn add_body_in_space(&mut self, number: usize, id: BodyId) {
        if let Some(space) = self.space.as_deref_mut() {
            space.add_body(number, id);
        }
        self.take_body_in_space(number, id);
    }

    /// Where the proxy of the ground or of a fixture is.
    pub(in crate::precise) fn proxy_of_fixture(&self, id: GeomId) -> Option<usize> {
        let space = self.space.as_ref()?;
        match parts::partner_of(id) {
            SpacePartner::Ground => Some(space.ground as usize),
            SpacePartner::Fixture(id) => {
                let (place, _) = space.fixture(id)?;
                space.fixture_proxies.get(place).map(|&proxy| proxy as usize)
            }
            SpacePartner::Geom(_) => None,
        }
    }

    /// Nobody meets the ground who does not rest on it.
    pub(in crate::precise) fn may_meet_ground(&self, proxies: [u32; 2]) -> bool {
        self.space.as_ref().is_none_or(|space| {
            let [a, b] = proxies;
            (a != space.ground || space.may_meet_ground(b)) && (b != space.ground || space.may_meet_ground(a))
        })
    }

    /// Whether a geom may meet what is no geom; `None` for two geoms.
    pub(crate) fn meets_fixture(&self, (a, b): (GeomId, GeomId), objects: &Objects) -> Option<bool> {
        let (geom, other) = match (is_geom(a), is_geom(b)) {
            (true, true) => return None,
            (true, false) => (a, b),
            (false, _) => (b, a),
        };
        let (Some(space), Some(entry)) = (&self.space, objects.geoms.get(geom)) else { return Some(false) };
        let is_enabled = objects.bodies.get(entry.body).is_some_and(|body| body.body.enabled());
        let meets = match parts::partner_of(other) {
            SpacePartner::Ground => entry.geom.collision_enabled(),
            SpacePartner::Fixture(id) => {
                space.fixture(id).is_some_and(|(_, fixture)| entry.geom.filter().may_meet(&fixture.filter))
            }
            SpacePartner::Geom(_) => false,
        };
        Some(is_enabled && meets && !objects.geoms.is_disposed(geom))
    }
}
