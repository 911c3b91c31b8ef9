//! Which objects meet, and along which axis: what the 2D engine is told about depth while it looks for pairs.
//!
//! The 2D engine finds pairs whose boxes overlap in X and Y. Each of them is let pass, left to the 2D engine, or
//! taken over by this one: balls, and outlines that met along Z.

use farseer_core::math::scalar::nearest_finite;
use farseer_core::{
    ArbiterRef, BodyId, Contact, EventHandler as CoreHandler, GeomId, JointId, ObjectId, PhysicsSimulator,
    SpringId,
};

use crate::events::{Collision, Context, Event, EventHandler};
use crate::shapes::{Along, RECENT, SHALLOW, entry_of_pieces, is_depth_last};
use crate::touch::{Kept, TouchKey};
use crate::world::{Reach, World};
use crate::{Axis, DepthScheme, Partner, Vector3};

/// A pair whose contact this engine looks for: the older geom first.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SpacePair {
    pub(crate) key: TouchKey,
    pub(crate) geom_a: GeomId,
    pub(crate) geom_b: GeomId,
}

/// The pairs that touched in the 2D engine in the last update, with the impulse between them.
#[derive(Debug, Clone, Default)]
pub(crate) struct KnownPairs {
    sorted: Vec<((u32, u32), f32)>,
}

impl KnownPairs {
    pub(crate) fn prepare(&mut self, core: &PhysicsSimulator) {
        self.sorted.clear();
        for arbiter in core.arbiters() {
            let (Some(a), Some(b)) = (core.geom(arbiter.geom_a()), core.geom(arbiter.geom_b())) else {
                continue;
            };
            let impulse = impulse_of(arbiter);
            self.sorted.push(((a.id(), b.id()), impulse));
        }
        self.sorted.sort_unstable_by_key(|(numbers, _)| *numbers);
    }

    /// The impulse between a pair, if it touched.
    fn impulse(&self, key: TouchKey) -> Option<f32> {
        let TouchKey::Pair(a, b) = key else { return None };
        let index = self.sorted.binary_search_by_key(&(a, b), |(numbers, _)| *numbers).ok()?;
        Some(self.sorted[index].1)
    }
}

/// The impulse between two geoms that touch in the 2D engine.
pub(crate) fn impulse_of(arbiter: ArbiterRef<'_>) -> f32 {
    nearest_finite(arbiter.contacts().map(|contact| contact.normal_impulse()).sum())
}

/// What becomes of a pair whose boxes overlap in all three axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    /// The 2D engine's.
    Plane,
    /// This engine's.
    Space,
}

/// Whether two extents along Z overlap. Faces that only touch do not; two extents about the same Z always do,
/// however thin.
fn extents_overlap(a: Reach, b: Reach) -> bool {
    a.z == b.z || (f64::from(a.z) - f64::from(b.z)).abs() < f64::from(a.half) + f64::from(b.half)
}

/// The side of `a` along Z on which `b` was before the last step: 1 behind it, -1 in front.
pub(crate) fn side_of(a: Reach, b: Reach) -> f32 {
    let motion = b.motion_z - a.motion_z;
    let before = b.z - a.z - motion;
    let is_behind = before > 0.0 || (before == 0.0 && motion < 0.0);
    if is_behind { 1.0 } else { -1.0 }
}

/// How two extents overlap along Z, from the side on which they met.
fn along_z(a: Reach, b: Reach) -> Along {
    let side = side_of(a, b);
    Along { penetration: a.half + b.half - side * (b.z - a.z), closing: -side * (b.motion_z - a.motion_z) }
}

/// Names a pair of geoms; the older one becomes the first.
pub(crate) fn key_of(core: &PhysicsSimulator, geom1: GeomId, geom2: GeomId) -> Option<SpacePair> {
    let (number1, number2) = (core.geom(geom1)?.id(), core.geom(geom2)?.id());
    Some(if number1 < number2 {
        SpacePair { key: TouchKey::Pair(number1, number2), geom_a: geom1, geom_b: geom2 }
    } else {
        SpacePair { key: TouchKey::Pair(number2, number1), geom_a: geom2, geom_b: geom1 }
    })
}

impl World {
    fn way_of(&mut self, core: &PhysicsSimulator, pair: SpacePair) -> Way {
        let (a, b) = (self.reach(pair.geom_a), self.reach(pair.geom_b));
        if self.scheme == DepthScheme::Thesis {
            let is_near = a.z == b.z || (a.z - b.z).abs() < a.half.min(b.half);
            return if is_near { Way::Plane } else { Way::Space };
        }
        if a.is_round || b.is_round {
            return Way::Space;
        }
        if self.last.find(pair.key).is_some_and(|touch| matches!(touch.kept, Kept::Depth { .. })) {
            return Way::Space;
        }
        let depth = along_z(a, b);
        let stands_against = a.z != b.z && depth.penetration <= SHALLOW * core.allowed_penetration();
        let may_meet_along_z = a.motion_z != b.motion_z || stands_against;
        if !may_meet_along_z || self.update.known.impulse(pair.key).is_some() {
            return Way::Plane;
        }
        self.way_of_new(core, pair, depth).unwrap_or(Way::Plane)
    }

    /// Two outlines that did not touch before meet along the axis that they entered last, as their last step says.
    /// `None` if they do not touch.
    fn way_of_new(&mut self, core: &PhysicsSimulator, pair: SpacePair, depth: Along) -> Option<Way> {
        let (body_a, body_b) = (core.geom(pair.geom_a)?.body(), core.geom(pair.geom_b)?.body());
        let motion = self.motion_of(core, body_b) - self.motion_of(core, body_a);
        self.lay_out(core, pair)?;
        let (pieces_a, pieces_b) =
            (self.update.pieces.get(pair.geom_a)?, self.update.pieces.get(pair.geom_b)?);
        let scratch = &self.update.scratch;
        let plane = entry_of_pieces(
            pieces_a.pieces(&scratch.pieces_a),
            || pieces_b.pieces(&scratch.pieces_b),
            motion.xy(),
        )?;
        let in_plane = Along { penetration: plane.penetration, closing: -motion.xy().dot(&plane.normal) };
        let plane_time = if plane.time <= RECENT { plane.time } else { f32::INFINITY };
        let is_depth =
            is_depth_last(in_plane, plane_time, depth, motion.z != 0.0, core.allowed_penetration());
        Some(if is_depth { Way::Space } else { Way::Plane })
    }

    /// Puts the convex pieces of both geoms into the world.
    pub(crate) fn lay_out(&mut self, core: &PhysicsSimulator, pair: SpacePair) -> Option<()> {
        for geom in [pair.geom_a, pair.geom_b] {
            self.pieces_of(core, geom)?;
        }
        let crate::world::Update { pieces, scratch, .. } = &mut self.update;
        for (geom, laid_out) in [(pair.geom_a, &mut scratch.pieces_a), (pair.geom_b, &mut scratch.pieces_b)] {
            let view = core.geom(geom)?;
            pieces.get(geom)?.lay_out(&view.matrix(), laid_out);
        }
        Some(())
    }
}

/// Stands between the 2D engine and the game's handler.
pub(crate) struct PlaneHandler<'w, 'h> {
    pub(crate) world: &'w mut World,
    pub(crate) handler: Option<&'h mut dyn EventHandler>,
}

impl CoreHandler for PlaneHandler<'_, '_> {
    fn filters_pairs(&self) -> bool {
        true
    }

    fn handles_broad_phase(&self) -> bool {
        // Otherwise it is asked where depths overlap: see `accepts_pair`.
        self.world.scheme == DepthScheme::Precise
            && self.handler.as_ref().is_some_and(|handler| handler.handles_broad_phase())
    }

    fn on_broad_phase_collision(
        &mut self,
        context: &mut farseer_core::Context<'_>,
        geom1: GeomId,
        geom2: GeomId,
    ) -> bool {
        let Some(handler) = &mut self.handler else { return true };
        let accepted =
            handler.on_broad_phase_collision(&mut Context::within(context, self.world), geom1, geom2);
        self.world.tell_depths(context.simulator_mut());
        if !accepted {
            self.world.events.push(Event::BroadPhaseVeto { geom1, geom2 });
        }
        accepted
    }

    fn on_space_moved(&mut self, context: &mut farseer_core::Context<'_>) {
        self.world.read_depths(context.simulator());
    }

    fn on_space_touches(&mut self, context: &mut farseer_core::Context<'_>) -> Vec<usize> {
        match &mut self.handler {
            Some(handler) => self.world.ask_about_touches(context, &mut **handler),
            None => Vec::new(),
        }
    }

    fn accepts_pair(
        &mut self,
        context: &mut farseer_core::Context<'_>,
        geom1: GeomId,
        geom2: GeomId,
    ) -> bool {
        if !extents_overlap(self.world.reach(geom1), self.world.reach(geom2)) {
            // They pass each other at different depths.
            return false;
        }
        let Some(pair) = key_of(context.simulator(), geom1, geom2) else { return false };
        let way = self.world.way_of(context.simulator(), pair);
        if !self.is_approved(context, pair, geom1, geom2) {
            return false;
        }
        if way == Way::Space {
            self.world.update.pairs.push(pair);
        }
        way == Way::Plane
    }

    fn on_collision(
        &mut self,
        context: &mut farseer_core::Context<'_>,
        this: GeomId,
        other: GeomId,
        contacts: &mut Vec<Contact>,
    ) -> bool {
        let Some(handler) = &mut self.handler else { return true };
        let Some(SpacePair { key, geom_a, geom_b }) = key_of(context.simulator(), this, other) else {
            return true;
        };
        let Some(collision) =
            self.world.plane_collision(context.simulator(), [geom_a, geom_b], this, contacts.iter().copied())
        else {
            return true;
        };
        let normal_impulse = self.world.update.known.impulse(key).unwrap_or(0.0);
        let collision = Collision { normal_impulse, ..collision };
        let accepted = handler.on_collision(&mut Context::within(context, self.world), &collision);
        if !accepted {
            self.world.update.vetoed.push(collision);
            let told = self
                .world
                .plane_collision(context.simulator(), [geom_a, geom_b], other, contacts.iter().copied())
                .filter(|_| this == geom_b);
            self.world.update.halved.extend(told.map(|told| Collision { normal_impulse, ..told }));
        }
        accepted
    }

    fn on_separation(&mut self, context: &mut farseer_core::Context<'_>, this: GeomId, other: GeomId) {
        if let Some(handler) = &mut self.handler
            && self.world.has_touched(context.simulator(), this, other)
        {
            handler.on_separation(&mut Context::within(context, self.world), this, Partner::Geom(other));
        }
    }

    fn on_body_updated(&mut self, context: &mut farseer_core::Context<'_>, body: BodyId) {
        self.world.is_told_of(body);
        if let Some(handler) = &mut self.handler {
            handler.on_body_updated(&mut Context::within(context, self.world), body);
        }
    }

    fn on_body_disposed(&mut self, context: &mut farseer_core::Context<'_>, body: BodyId) {
        if let Some(handler) = &mut self.handler {
            handler.on_body_disposed(&mut Context::within(context, self.world), body);
        }
    }

    fn on_joint_broke(&mut self, context: &mut farseer_core::Context<'_>, joint: JointId) {
        if let Some(handler) = &mut self.handler {
            handler.on_joint_broke(&mut Context::within(context, self.world), joint);
            self.world.tell_depths(context.simulator_mut());
        }
    }

    fn on_spring_broke(&mut self, context: &mut farseer_core::Context<'_>, spring: SpringId) {
        if let Some(handler) = &mut self.handler {
            handler.on_spring_broke(&mut Context::within(context, self.world), spring);
            self.world.tell_depths(context.simulator_mut());
        }
    }

    fn on_added(&mut self, object: ObjectId) {
        if let Some(handler) = &mut self.handler {
            handler.on_added(object);
        }
    }

    fn on_removed(&mut self, object: ObjectId) {
        if let Some(handler) = &mut self.handler {
            handler.on_removed(object);
        }
    }
}

impl PlaneHandler<'_, '_> {
    /// Asks the game's handler about a pair that did not touch in the last update.
    fn is_approved(
        &mut self,
        context: &mut farseer_core::Context<'_>,
        pair: SpacePair,
        geom1: GeomId,
        geom2: GeomId,
    ) -> bool {
        let Some(handler) = self.handler.as_mut().filter(|handler| handler.handles_broad_phase()) else {
            return true;
        };
        let key = pair.key;
        if self.world.update.known.impulse(key).is_some() || self.world.last.find(key).is_some() {
            return true;
        }
        let accepted =
            handler.on_broad_phase_collision(&mut Context::within(context, self.world), geom1, geom2);
        if !accepted {
            self.world.events.push(Event::BroadPhaseVeto { geom1, geom2 });
        }
        accepted
    }
}

impl World {
    /// Whether two geoms touched in the 2D engine in the last update.
    pub(crate) fn has_touched(&self, core: &PhysicsSimulator, this: GeomId, other: GeomId) -> bool {
        key_of(core, this, other).is_some_and(|pair| self.update.known.impulse(pair.key).is_some())
    }

    /// What a game is told of contacts that the 2D engine has found: those of `older` and `younger`, seen by one of
    /// them.
    pub(crate) fn plane_collision(
        &self,
        core: &PhysicsSimulator,
        [older, younger]: [GeomId; 2],
        this: GeomId,
        mut contacts: impl ExactSizeIterator<Item = Contact>,
    ) -> Option<Collision> {
        let count = contacts.len();
        let deepest = contacts.next()?;
        // The 2D engine's normals point to the younger geom.
        let (sign, other) = if younger == this { (1.0, older) } else { (-1.0, younger) };
        Some(Collision {
            this,
            partner: Partner::Geom(other),
            axis: Axis::Plane,
            normal: Vector3::new(sign * deepest.normal.x, -sign * deepest.normal.y, 0.0),
            position: Vector3::new(deepest.position.x, -deepest.position.y, self.middle(core, this, other)),
            contacts: count as u32,
            normal_impulse: 0.0,
            vetoed: false,
        })
    }

    /// Z of the middle of what two geoms have in common.
    pub(crate) fn middle(&self, core: &PhysicsSimulator, geom1: GeomId, geom2: GeomId) -> f32 {
        let interval = |geom: GeomId| {
            let z = core.geom(geom).map_or(0.0, |geom| self.z_of(geom.body()));
            let half = self.depths.profiles.get(geom).map_or(0.0, |profile| profile.half_depth());
            (nearest_finite(z - half), nearest_finite(z + half))
        };
        let ((near1, far1), (near2, far2)) = (interval(geom1), interval(geom2));
        let (near, far) = (near1.max(near2), far1.min(far2));
        let middle = (near + far) * 0.5;
        if middle.is_finite() { middle } else { near * 0.5 + far * 0.5 }
    }
}
