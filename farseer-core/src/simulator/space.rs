//! What an engine with depth on top of this one tells and asks: see [`precise::space`](crate::precise::space). Not for games.

use super::tell::Handler;
use super::{EventHandler, PhysicsSimulator};
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::geom::filter::Filter;
use crate::math::{Vector2, Vector3};
use crate::methods::Methods;
use crate::precise::space::IS_THERE;
use crate::precise::space::parts::{
    Fixture, FixtureMotion, SpaceBody, SpaceChange, SpacePartner, SpaceProfile, SpaceTouch,
};
use crate::report::Stopwatch;
use crate::{Error, Result};

#[doc(hidden)]
impl PhysicsSimulator {
    /// The precise set in three axes, whatever was chosen before.
    ///
    /// # Errors
    /// As [`set_methods`](Self::set_methods) with [`Methods::Precise`]; [`Error::NotSupported`] without the feature `space`.
    pub fn enter_space(&mut self, length_unit: f32) -> Result<()> {
        if !IS_THERE {
            return Err(Error::NotSupported {
                what: "depth axis: the feature `space` is off",
                methods: "precise",
            });
        }
        self.set_methods(Methods::Precise { length_unit })?;
        if let Some(precise) = self.pipeline.precise.as_mut().filter(|precise| !precise.is_in_space()) {
            precise.enter_space();
        }
        Ok(())
    }

    /// The faithful set, without the contacts so far, whatever was chosen before; geoms get the distance grids that the precise
    /// set does without.
    ///
    /// # Errors
    /// As [`create_distance_grid`](crate::Objects::create_distance_grid), and [`set_methods`](Self::set_methods) with
    /// [`Methods::Faithful`].
    pub fn leave_space(&mut self) -> Result<()> {
        if !self.is_in_space() {
            // From the faithful set: by way of the other one, which has no contacts of this one and refuses nothing of it.
            self.set_methods(Methods::PRECISE)?;
            return self.set_methods(Methods::default());
        }
        // Geoms get grids one by one, and the last of them may be refused.
        let before = self.objects.clone();
        let geoms: Vec<GeomId> = self.geoms().collect();
        let left = geoms
            .into_iter()
            .try_for_each(|geom| self.objects.create_distance_grid(geom))
            .and_then(|()| self.set_methods(Methods::default()));
        if left.is_err() {
            self.objects = before;
        }
        left
    }

    /// Whether there is a depth axis.
    pub fn is_in_space(&self) -> bool {
        self.pipeline.precise.as_ref().is_some_and(|precise| precise.is_in_space())
    }

    /// How a body moves along the depth axis.
    pub fn set_space_body(&mut self, body: BodyId, told: SpaceBody) {
        if let Some(precise) = &mut self.pipeline.precise {
            precise.set_space_body(body, told);
        }
    }

    /// A force, along the depth axis as well, and a torque act on a body in the update that comes. That is no edit: what sleeps
    /// wakes if other forces push it than those it fell asleep under. Without a depth axis what is along it is left out. What
    /// would not be finite, with what pushes the body already, is refused: answers whether it was not.
    pub fn push_in_space(&mut self, id: BodyId, [x, y, z]: [f32; 3], torque: f32) -> bool {
        let PhysicsSimulator { objects, pipeline, .. } = self;
        let Some(body) = objects.bodies.get_mut(id).map(|entry| &mut entry.body) else { return true };
        let along_depth = z * body.inverse_mass();
        let pushed = pipeline.precise.as_ref().map_or(0.0, |precise| precise.pushed_along_depth(id));
        let sums = [body.force().x + x, body.force().y + y, body.torque() + torque, pushed + along_depth];
        if !sums.iter().all(|sum| sum.is_finite()) {
            return false;
        }
        body.apply_force(Vector2::new(x, y));
        body.apply_torque(torque);
        if let Some(precise) = &mut pipeline.precise {
            precise.note_push(id, along_depth);
        }
        true
    }

    /// How a geom reaches along the depth axis.
    pub fn set_space_profile(&mut self, geom: GeomId, told: SpaceProfile) {
        if let Some(precise) = &mut self.pipeline.precise {
            precise.set_space_profile(geom, told);
        }
    }

    /// What nothing pushes and is no geom.
    pub fn set_fixtures(&mut self, fixtures: impl Iterator<Item = Fixture>) {
        if let Some(precise) = &mut self.pipeline.precise {
            precise.set_fixtures(fixtures);
        }
    }

    /// How a fixture goes on that moves already.
    pub fn set_fixture_motion(&mut self, id: u32, told: FixtureMotion) {
        if let Some(precise) = &mut self.pipeline.precise {
            precise.set_fixture_motion(id, told);
        }
    }

    /// The fixtures that move: their names, where their middles are after an update and how they are turned, and how they move.
    pub fn fixtures_moved(&self) -> impl Iterator<Item = (u32, Vector3, Option<f32>, FixtureMotion)> + '_ {
        self.pipeline.precise.iter().flat_map(|precise| precise.fixtures_moved())
    }

    /// An update begins: objects enter and leave. Answers whether anything can move; then it [goes on](Self::go_on_in_space).
    pub fn begin_in_space(&mut self, dt: f32, handler: Option<&mut dyn EventHandler>) -> bool {
        self.begin(dt, &mut Handler::new(handler))
    }

    /// An update that has [begun](Self::begin_in_space) goes on, as one without a depth axis does. Answers whether anything may
    /// have happened in it.
    pub fn go_on_in_space(&mut self, dt: f32, handler: Option<&mut dyn EventHandler>) -> bool {
        self.pipeline.precise.is_some()
            && self.run_precise(dt, 0.0, &mut Handler::new(handler), &mut Stopwatch::start(None))
    }

    /// Who was awake in an update, and moves like that along the depth axis after it.
    pub fn space_moved(&self) -> impl Iterator<Item = (BodyId, SpaceBody)> + '_ {
        self.pipeline.precise.iter().flat_map(|precise| precise.space_moved())
    }

    /// Who has fallen asleep at the end of the last update in which anything may have happened.
    pub fn space_rested(&self) -> impl Iterator<Item = (BodyId, SpaceBody)> + '_ {
        self.pipeline.precise.iter().flat_map(|precise| precise.space_rested())
    }

    /// Whether what touches is known, with all that is told of it: not between loading and the next update.
    pub fn knows_touches(&self) -> bool {
        self.pipeline.precise.as_ref().is_some_and(|precise| precise.knows_touches())
    }

    /// Lists what was loaded, once this was told where all is along the depth axis, so that those who ask before the next update
    /// are told what is near.
    pub fn list_loaded_in_space(&mut self) {
        if let Some(precise) = &mut self.pipeline.precise {
            precise.list_loaded(&mut self.objects);
        }
    }

    /// Number of pairs with the ground that touch.
    pub fn on_ground_count(&self) -> usize {
        self.pipeline.precise.as_ref().map_or(0, |precise| precise.on_ground_count())
    }

    /// What began and ceased to touch in the last update.
    pub fn take_space_changes(&mut self) -> Vec<SpaceChange> {
        self.pipeline.precise.as_mut().map_or(Vec::new(), |precise| precise.take_space_changes())
    }

    /// What is near enough to touch, in no particular order.
    pub fn space_touches(&self) -> impl Iterator<Item = SpaceTouch> + '_ {
        let precise = self.pipeline.precise.as_ref();
        let count = precise.map_or(0, |precise| precise.pair_count());
        (0..count).filter_map(move |pair| precise?.space_touch(pair))
    }

    /// The same of one body.
    pub fn space_touches_of(&self, body: BodyId) -> impl Iterator<Item = SpaceTouch> + '_ {
        let precise = self.pipeline.precise.as_ref();
        let number = precise.and_then(|precise| Some((precise, precise.number_of(body)?)));
        number.into_iter().flat_map(|(precise, number)| precise.space_touches_of(number))
    }

    /// The geoms that are near a body, if not near enough to touch, and would push it.
    pub fn space_neighbours_of(&self, body: BodyId) -> impl Iterator<Item = GeomId> + '_ {
        let precise = self.pipeline.precise.as_ref();
        let number = precise.and_then(|precise| Some((precise, precise.number_of(body)?)));
        number.into_iter().flat_map(|(precise, number)| precise.space_neighbours_of(number))
    }

    /// The geoms of a body, and what a handler has refused to let them touch in the last update, in no particular order.
    pub fn space_refused_of(&self, body: BodyId) -> impl Iterator<Item = (GeomId, SpacePartner)> + '_ {
        let precise = self.pipeline.precise.as_ref();
        let number = precise.and_then(|precise| Some((precise, precise.number_of(body)?)));
        number.into_iter().flat_map(|(precise, number)| precise.space_refused_of(number))
    }

    /// Calls for the geoms that may reach into a box, and that a geom of a body may meet: in no order, and for some of them twice.
    /// The box goes from the least to the greatest x, y (down) and z, in length units. Bounds are those of the last update.
    pub fn for_each_space_geom_in(
        &self,
        [low, high]: [[f32; 3]; 2],
        body: BodyId,
        mut find: impl FnMut(GeomId),
    ) {
        let (geoms, bodies) = (&self.objects.geoms, &self.objects.bodies);
        let (Some(precise), Some(entry)) = (&self.pipeline.precise, bodies.get(body)) else { return };
        let filter = Filter { geoms, bodies };
        precise.for_each_geom_in(low, high, |id| {
            let mut own = entry.geoms.iter().filter_map(|&geom| geoms.get(geom));
            let other = geoms.get(id).filter(|_| !geoms.is_disposed(id));
            if other.is_some_and(|other| own.any(|geom| filter.may_collide(geom, other))) {
                find(id);
            }
        });
    }

    /// What touches and has a side that listens, in no particular order, with the number of each pair.
    pub fn space_touches_heard(&self) -> impl Iterator<Item = (usize, SpaceTouch)> + '_ {
        self.pipeline.precise.iter().flat_map(|precise| precise.space_touches_heard())
    }

    /// The handler is asked about what touches, and pairs that it refuses push nothing in this update.
    pub(super) fn ask_about_space(&mut self, handler: &mut Handler<'_>) {
        let refused = self.tell(handler, |handler, context| handler.on_space_touches(context));
        for pair in refused.into_iter().flatten() {
            if let Some(precise) = &mut self.pipeline.precise {
                precise.refuse(pair);
            }
        }
    }
}
