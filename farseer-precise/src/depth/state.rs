//! State of the depth axis: depth data of bodies, geoms, proxies and world boxes.

use std::ops::Range;
use wide::f32x4;

use super::friction_3d::BallSpin;
use super::hinged_box_state::HingedBoxState;
use super::interface::{DepthBodyState, DepthInterval, DepthShape, WorldBox};
use super::posed_solid::{ContactMargins, PosedSolid, PreviousAxis, SolidKind};
use super::prism_collision;
use super::sphere_sphere::Sphere;
use super::vertical_shapes;
use super::vertical_solid::VerticalSolid;
use crate::bodies::BodySet;
use crate::broad_phase::hash_grid::PackedAabb;
use crate::broad_phase::proxies::{BodyType, Proxies, Proxy};
use crate::index::{BodyIndex, DenseIndex, IndexedVec, ProxyIndex};
use crate::island::sleep::SleepState;
use crate::math::scalar::nearest_finite;
use crate::narrow_phase::combined_surface::{friction_of, restitution_of};
use crate::reusing_clone;
use crate::scaled_parameters::{AabbMargin, Parameters};
use crate::shape::ShapeRef;
use crate::slanted_box::SlantedBox;
use crate::surface::{FrictionType, mix_friction, mix_restitution};

/// State of the depth axis: depth data of bodies, geoms, proxies and world boxes. "Body index" means the index into `BodySet`,
/// "proxy index" the index into `Proxies::all`.
#[derive(Debug, Default)]
pub struct DepthState {
    /// Depth state of bodies as the engine above has set it, by the slots of their ids.
    pub(crate) bodies: Vec<DepthBodyState>,
    /// Depth shapes of geoms as the engine above has set them, by the slots of their ids.
    pub(super) shapes: Vec<DepthShape>,
    /// World boxes in ascending order of their ids.
    pub(crate) world_boxes: Vec<WorldBox>,
    /// Body indices of the world boxes, by index into `world_boxes`. Moving boxes have the indices from 1 on.
    pub(super) box_bodies: Vec<BodyIndex>,
    /// Proxy indices of the world boxes, by index into `world_boxes`.
    pub(super) box_proxies: Vec<ProxyIndex>,
    /// Indices into `world_boxes` of the boxes that move, ascending. Box `i` of this list has body index `i + 1`.
    pub(super) moving_boxes: Vec<u32>,
    /// States of the awake hinged boxes in the current step.
    pub(super) hinged_boxes: Vec<HingedBoxState>,
    /// Whether any world box is one-way: solid from above only.
    pub(super) has_one_way: bool,
    /// World positions of bodies along z in length units, by body index.
    pub z_positions: IndexedVec<BodyIndex, f32>,
    /// Angular velocities of spheres about x and y in rad/s, with their warm start, by body index.
    pub(crate) ball_spins: IndexedVec<BodyIndex, BallSpin>,
    /// Index into `bodies` of each dynamic or kinematic body, by body index; [`NO_STATE`] for world boxes and static bodies.
    pub(super) state_slots: IndexedVec<BodyIndex, u32>,
    /// Whether a body is a sphere about its origin and so rotates about all axes, by body index.
    pub(crate) is_ball: IndexedVec<BodyIndex, bool>,
    /// Whether `is_ball` holds for any body.
    pub(crate) has_balls: bool,
    /// Whether a body has a vertical shape and so never rotates, by body index.
    pub(crate) has_fixed_rotation: IndexedVec<BodyIndex, bool>,
    /// Whether `has_fixed_rotation` holds for any body.
    pub(crate) any_fixed_rotation: bool,
    /// Vertical shapes of geoms and world boxes. `DepthExtent::vertical` refers to them.
    pub(super) vertical_solids: Vec<VerticalSolid>,
    /// Extents of proxies along z and data of their depth shapes, by proxy index.
    pub(super) extents: IndexedVec<ProxyIndex, DepthExtent>,
    /// Fat intervals of proxies by proxy index: the extent of their fat AABBs along z.
    pub(super) intervals: IndexedVec<ProxyIndex, DepthInterval>,
    /// Proxy index of the ground.
    pub ground_proxy: ProxyIndex,
    /// Ids of the bodies that fell asleep in the last step, as numbers, for the engine above.
    pub newly_asleep: Vec<u64>,
}

reusing_clone! {
    DepthState {
        bodies, shapes, world_boxes, box_bodies, box_proxies, moving_boxes, hinged_boxes, has_one_way, z_positions, ball_spins, state_slots, is_ball, has_balls,
        has_fixed_rotation, any_fixed_rotation, vertical_solids, extents, intervals, ground_proxy, newly_asleep
    }
}

/// Extent of a proxy along z, and data of its depth shape.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct DepthExtent {
    /// Half of the extent along z in length units, >= 0.
    pub(super) half_depth: f32,
    /// Whether the shape is a sphere.
    pub(super) is_sphere: bool,
    /// Friction and restitution coefficients of the ground under this proxy, dimensionless; `None` if the ground does not
    /// support the proxy.
    pub(super) ground_surface: Option<[f32; 2]>,
    /// Index into `vertical_solids` plus 1; 0 for shapes that are not vertical.
    pub(super) vertical: u32,
}

/// Value in [`DepthState::state_slots`] of an index without a depth state.
pub(super) const NO_STATE: u32 = u32::MAX;

/// Returns the entry of `table` at `slot`; beyond the end of the table the default value.
pub(super) fn entry<T: Copy + Default>(table: &[T], slot: usize) -> T {
    table.get(slot).copied().unwrap_or_default()
}

/// Returns a mutable reference to the entry of `table` at `slot`. A shorter table grows with default values to hold the entry.
pub(super) fn entry_mut<T: Clone + Default>(table: &mut Vec<T>, slot: usize) -> &mut T {
    if table.len() <= slot {
        table.resize(slot + 1, T::default());
    }
    &mut table[slot]
}

/// Depth states of bodies, and world boxes.
impl DepthState {
    /// Returns the world box with this id, and its index into `world_boxes`; `None` for an unknown id.
    pub fn world_box_by_id(&self, id: u32) -> Option<(usize, &WorldBox)> {
        let place = self.world_boxes.binary_search_by_key(&id, |world_box| world_box.id).ok()?;
        Some((place, &self.world_boxes[place]))
    }

    /// Returns the depth state of a dynamic or kinematic body by its body index; `None` for world boxes and static bodies.
    pub(super) fn state_of(&self, body_index: BodyIndex) -> Option<DepthBodyState> {
        let slot = *self.state_slots.at(body_index).filter(|&&slot| slot != NO_STATE)?;
        Some(entry(&self.bodies, slot as usize))
    }

    /// Returns the depth state of a dynamic or kinematic body by its body index, to be changed; `None` for world boxes and
    /// static bodies.
    pub(super) fn state_mut_of(&mut self, body_index: BodyIndex) -> Option<&mut DepthBodyState> {
        let slot = *self.state_slots.at(body_index).filter(|&&slot| slot != NO_STATE)?;
        Some(entry_mut(&mut self.bodies, slot as usize))
    }
}

/// Depth data by body index.
impl DepthState {
    /// Sets `is_ball` of a body: true if all of its geoms are spheres centred at the origin of the body.
    pub fn update_is_ball(&mut self, body_index: BodyIndex, proxies: &Proxies) {
        let is_centred = |at: ProxyIndex| self.is_sphere(at) && proxies.proxy(at).shape.centre == [0.0; 2];
        let mut of_body = proxies.proxies_of(body_index).peekable();
        self.is_ball[body_index] = of_body.peek().is_some() && of_body.all(is_centred);
        self.has_balls |= self.is_ball[body_index];
    }
}

/// Bounds of proxies for the broad phase, and friction and restitution coefficients of pairs.
impl DepthState {
    pub(crate) fn is_sphere(&self, proxy: ProxyIndex) -> bool {
        self.extents[proxy].is_sphere
    }

    /// Returns whether the shape of a proxy is vertical.
    pub(crate) fn is_vertical(&self, proxy: ProxyIndex) -> bool {
        self.extents[proxy].vertical > 0
    }

    /// Appends a vertical shape to `vertical_solids` and returns its index plus 1.
    pub(super) fn add_vertical(&mut self, vertical: VerticalSolid) -> u32 {
        self.vertical_solids.push(vertical);
        self.vertical_solids.len() as u32
    }

    /// Returns the combined friction and restitution coefficients of two proxies, dimensionless, without changes by contact
    /// callbacks. The ground has the coefficients in `ground_surface` of the other proxy.
    pub(crate) fn combined_surface(
        &self,
        proxies: [ProxyIndex; 2],
        [a, b]: [&Proxy; 2],
        mix: FrictionType,
    ) -> [f32; 2] {
        if proxies[0] != self.ground_proxy {
            return [friction_of(mix, a, b), restitution_of(a, b)];
        }
        let [friction, restitution] = self.extents[proxies[1]].ground_surface.unwrap_or_default();
        // The mean of huge coefficients overflows.
        let restitution = mix_restitution(restitution, b.restitution).clamp(f32::MIN, f32::MAX);
        [mix_friction(mix, friction, b.friction).min(f32::MAX), restitution]
    }

    /// Returns whether a proxy is in the hash grid. The ground is below all objects and gets its pairs without a search.
    pub(crate) fn is_in_grid(&self, proxy: ProxyIndex) -> bool {
        proxy != self.ground_proxy
    }

    /// Returns the rectangle that the hash grid stores for a proxy, in length units: x from its fat AABB, z from its fat
    /// interval. Objects on a floor are spread over x and z, so a grid over these axes separates them best.
    pub(crate) fn grid_bounds(&self, proxy: ProxyIndex, &[left, _, right, _]: &PackedAabb) -> PackedAabb {
        let DepthInterval { low, high } = self.intervals[proxy];
        [left, low, right, high]
    }

    /// Returns the fat interval of a proxy along z, in world coordinates, length units.
    pub fn interval(&self, proxy: ProxyIndex) -> DepthInterval {
        self.intervals[proxy]
    }

    pub(crate) fn set_interval(&mut self, proxy: ProxyIndex, depths: DepthInterval) {
        self.intervals[proxy] = depths;
    }

    /// Returns whether the fat intervals of two proxies along z overlap.
    pub(crate) fn intervals_overlap(&self, a: ProxyIndex, b: ProxyIndex) -> bool {
        self.intervals[a].overlaps(self.intervals[b])
    }

    /// Returns the proxy index of the ground if the bottom of the AABB reaches the ground (y >= 0) and the ground supports the
    /// proxy; else `None`.
    pub(crate) fn ground_beneath(&self, proxy: ProxyIndex, &[.., bottom]: &PackedAabb) -> Option<ProxyIndex> {
        (bottom >= 0.0 && self.extents[proxy].ground_surface.is_some()).then_some(self.ground_proxy)
    }

    /// Returns the penetration of a body when its last contact with a static body ended, length units, >= 0.
    pub(crate) fn residual_penetration(&self, body_index: BodyIndex) -> f32 {
        self.state_of(body_index).map_or(0.0, |state| state.residual_penetration)
    }

    /// Stores the penetrations of ended static contacts as residual penetrations of their bodies, since a body may return to
    /// the face, and clears `ended`. Sleeping bodies keep their stored value, because they have not moved.
    ///
    /// `ended`: body index, and penetration in length units.
    pub(crate) fn store_residual_penetrations(
        &mut self,
        ended: &mut Vec<(BodyIndex, f32)>,
        sleep: &SleepState,
    ) {
        ended.retain(|&(body, _)| !sleep.is_asleep(body));
        for &(body, _) in &*ended {
            if let Some(state) = self.state_mut_of(body) {
                state.residual_penetration = 0.0;
            }
        }
        for (body, depth) in ended.drain(..) {
            if let Some(state) = self.state_mut_of(body) {
                state.residual_penetration = state.residual_penetration.max(depth);
            }
        }
    }

    /// Returns the angular velocity of a body about the world axes x and y, rad/s; components 2 and 3 are 0.
    pub(crate) fn spin_velocity(&self, body_index: BodyIndex) -> f32x4 {
        f32x4::new(self.ball_spins[body_index].velocity)
    }

    pub(crate) fn is_spin_finite(&self, body_index: BodyIndex) -> bool {
        self.ball_spins[body_index].velocity.iter().all(|velocity| velocity.is_finite())
    }

    /// Sets the ball spin of a body to 0 if its angular velocity is not finite.
    pub(crate) fn reset_non_finite_spin(&mut self, body_index: BodyIndex) {
        if !self.is_spin_finite(body_index) {
            self.ball_spins[body_index] = BallSpin::default();
        }
    }

    /// Returns false if one of two proxies is the ground and the ground does not support the other proxy; else true.
    pub(crate) fn supports_on_ground(&self, [a, b]: [ProxyIndex; 2]) -> bool {
        (a != self.ground_proxy || self.has_ground(b)) && (b != self.ground_proxy || self.has_ground(a))
    }

    /// Returns whether the ground supports this proxy.
    pub(crate) fn has_ground(&self, proxy: ProxyIndex) -> bool {
        self.extents[proxy].ground_surface.is_some()
    }

    /// Returns the middle of the overlap of two proxies along z, in world coordinates, length units.
    pub fn overlap_middle_z(&self, proxies: [ProxyIndex; 2], bodies: [BodyIndex; 2]) -> f32 {
        let interval = |at: usize| {
            let (z, half_depth) = (self.z_positions[bodies[at]], self.extents[proxies[at]].half_depth);
            [nearest_finite(z - half_depth), nearest_finite(z + half_depth)]
        };
        let ([near1, far1], [near2, far2]) = (interval(0), interval(1));
        let near = if near1 > near2 { near1 } else { near2 };
        let far = if far1 < far2 { far1 } else { far2 };
        near * 0.5 + far * 0.5
    }

    /// Sets the fat interval of a proxy along z: its extent plus the AABB margin. In the direction of `displacement`, which is
    /// expected of the body along z in the coming step, the interval is widened by at least that displacement. `extra_margin`,
    /// in length units, widens the interval further at both ends. See [`Proxies::fat_aabb`] for x and y.
    pub(crate) fn set_fat_interval(
        &mut self,
        proxy: ProxyIndex,
        body: BodyIndex,
        displacement: f32,
        widening: AabbMargin,
        extra_margin: f32,
    ) {
        if proxy == self.ground_proxy {
            self.intervals[proxy] = DepthInterval { low: f32::MIN, high: f32::MAX };
            return;
        }
        let (z, half) = (self.z_positions[body], self.extents[proxy].half_depth);
        let margin = widening.margin + extra_margin;
        let ahead = widening.prediction(displacement);
        let (below, above) = if ahead < 0.0 { (ahead, 0.0) } else { (0.0, ahead) };
        self.intervals[proxy] = DepthInterval::new(z - half - margin + below, z + half + margin + above);
    }

    /// Returns the interval along z that a proxy covers during a step with this displacement along z, widened by `extra_margin`
    /// at both ends. World coordinates; all values are in length units.
    pub(crate) fn swept_interval(
        &self,
        proxy: ProxyIndex,
        body: BodyIndex,
        displacement: f32,
        extra_margin: f32,
    ) -> DepthInterval {
        let (z, half) = (self.z_positions[body], self.extents[proxy].half_depth + extra_margin);
        let (below, above) = if displacement < 0.0 { (displacement, 0.0) } else { (0.0, displacement) };
        DepthInterval::new(z - half + below, z + half + above)
    }

    /// Appends to `Proxies::refitted` the proxies that moved along z in this step and have left their fat interval. `runs` are
    /// ranges of proxy indices of awake bodies.
    pub(crate) fn collect_escaped(
        &self,
        proxies: &mut Proxies,
        bodies: &BodySet,
        runs: &[Range<usize>],
        tuning: &Parameters,
    ) {
        let before = proxies.refitted().len();
        let movable_end = proxies.movable_end;
        for at in runs.iter().cloned().flatten().map(ProxyIndex::new).filter(|&at| at < movable_end) {
            let body = proxies.body_of(at);
            let z = self.z_positions[body];
            let half = self.extents[at].half_depth + tuning.speculative_distance;
            let DepthInterval { low, high } = self.intervals[at];
            if bodies.delta_pose.at(body).is_some_and(|path| path[3] != 0.0)
                && (z - half < low || z + half > high)
            {
                proxies.search_pairs_of(at);
            }
        }
        if proxies.refitted().len() > before {
            proxies.sort_refitted();
        }
    }
}

/// Input of the narrow phase, its call, and tests of pairs along z.
impl DepthState {
    /// Returns the solid of a proxy with pose, shape, displacement of the last step and predicted displacement, for the narrow
    /// phase. `dt` is the step in seconds.
    pub(crate) fn posed_solid<'a>(
        &'a self,
        proxy_index: ProxyIndex,
        proxy: &Proxy,
        outline: ShapeRef<'a>,
        (bodies, dt): (&BodySet, f32),
    ) -> PosedSolid<'a> {
        let body = proxy.body;
        let DepthExtent { half_depth, is_sphere, vertical, .. } = self.extents[proxy_index];
        let vertical = vertical.checked_sub(1).map(|at| &self.vertical_solids[at as usize]);
        let kind = match (proxy_index == self.ground_proxy, is_sphere) {
            (true, _) => SolidKind::Ground,
            (false, true) => SolidKind::Sphere,
            (false, false) if vertical.is_some() => SolidKind::Vertical,
            (false, false) => SolidKind::Prism(half_depth),
        };
        let world_box = self.world_box_of(proxy);
        let motion = match world_box {
            Some(world_box) => world_box.motion.map(|motion| motion.displacement),
            None => self.state_of(body).map(|state| state.displacement),
        };
        PosedSolid {
            outline,
            pose: bodies.poses[body],
            kind,
            z: self.z_positions[body],
            last_displacement: motion.unwrap_or_default(),
            predicted_displacement: bodies.states.at(body).map_or([0.0; 3], |state| {
                let [x, y, _, z] = state.velocity;
                [x * dt, y * dt, z * dt]
            }),
            sheared_box: world_box.map(|world_box| world_box.shape).filter(SlantedBox::is_sheared),
            vertical,
        }
    }

    /// Returns the contact manifold of two solids, with points relative to the position of body A.
    pub(crate) fn collide(
        &self,
        a: PosedSolid<'_>,
        b: PosedSolid<'_>,
        previous: PreviousAxis,
        margins: ContactMargins,
    ) -> crate::narrow_phase::manifold::Manifold {
        prism_collision::collide_solids(a, b, previous, margins)
    }

    /// Returns whether the last manifold of two proxies was that of a vertical shape above or below the other shape. `feature`
    /// is the feature id of the first contact point of that manifold.
    pub(crate) fn had_vertical_axis(&self, proxies: [ProxyIndex; 2], feature: u32) -> bool {
        vertical_shapes::is_vertical_axis(feature) && proxies.iter().any(|&proxy| self.is_vertical(proxy))
    }

    /// Returns z of the body of proxy B relative to the body of proxy A, in length units.
    pub(crate) fn relative_z(&self, a: &Proxy, b: &Proxy) -> f32 {
        self.z_positions[b.body] - self.z_positions[a.body]
    }

    /// Returns the radius of a proxy if it is a sphere that rotates about all axes, in length units; 0 for all other shapes.
    pub(crate) fn rolling_radius(&self, proxy_index: ProxyIndex, proxy: &Proxy) -> f32 {
        let rolls = self.extents[proxy_index].is_sphere && self.is_ball[proxy.body];
        if rolls { proxy.shape.radius } else { 0.0 }
    }

    /// Returns whether two proxies overlap along z when body B is at `offset` (length units) from body A along z. The ground as
    /// A always overlaps.
    pub(crate) fn overlap_along_z(&self, [a, b]: [ProxyIndex; 2], offset: f32) -> bool {
        a == self.ground_proxy || offset.abs() <= self.extents[a].half_depth + self.extents[b].half_depth
    }
}

impl DepthState {
    /// Returns two proxies as spheres if both are spheres of dynamic bodies, else `None`. `dt` is the step in seconds. This
    /// fast path reads little memory: in a heap of spheres most pairs take it.
    pub(crate) fn dynamic_spheres(
        &self,
        proxies: [ProxyIndex; 2],
        two: [&Proxy; 2],
        (bodies, dt): (&BodySet, f32),
    ) -> Option<[Sphere; 2]> {
        let is_ball = |at: usize| self.is_sphere(proxies[at]) && two[at].body_type == BodyType::Dynamic;
        let ball = |proxy: &Proxy| {
            let body = proxy.body;
            let [x, y, _, z] = bodies.states[body].velocity;
            Sphere::new(proxy.shape, bodies.poses[body], self.z_positions[body], [x * dt, y * dt, z * dt])
        };
        (is_ball(0) && is_ball(1)).then(|| two.map(ball))
    }
}
