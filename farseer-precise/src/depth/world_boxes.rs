//! World boxes and the ground: colliders without a geom. World boxes are static, kinematic or hinged.
//!
//! Moving boxes have the first body indices, as kinematic bodies without an id. The ground and static boxes have the last body
//! indices, after all bodies. Proxies are in the same order. This file imports boxes, moves kinematic ones and gives the narrow
//! phase their velocities.

use super::interface::{WorldBox, WorldBoxMotion};
use super::owner::{ground_numbers, world_box_numbers};
use super::posed_solid::PosedSolid;
use super::state::DepthState;
use super::vertical_shapes::clamp_any;
use super::world_box_shape::{origin_of, pose_of, solver_velocity, vertical_of, yaw_extent};
use crate::bodies::{BodySet, MotionState};
use crate::broad_phase::fat_aabbs::FatAabbs;
use crate::broad_phase::pairs::Pairs;
use crate::broad_phase::proxies::{BodyType, Proxies, Proxy};
use crate::fingerprint::Fingerprint;
use crate::index::{BodyIndex, DenseIndex, IndexRange, ProxyIndex};
use crate::island::sleep::SleepState;
use crate::math::Vector3;
use crate::math::plane::{Pose, length};
use crate::math::scalar;
use crate::parameters::depth::WORLD_BOX_MAX_SWEEP;
use crate::scaled_parameters::Parameters;
use crate::shape::Shape;
use crate::slanted_box::SlantedBox;
use crate::surface::SurfaceCoefficients;

/// `Proxy::list_key` of the ground: an index beyond all world boxes, because the ground is none.
const NO_WORLD_BOX: u32 = u32::MAX;

/// Changes of world boxes between updates.
impl DepthState {
    /// Sets all world boxes.
    pub fn set_world_boxes(&mut self, world_boxes: impl Iterator<Item = WorldBox>) {
        self.world_boxes.clear();
        self.world_boxes.extend(world_boxes);
        self.has_one_way = self.world_boxes.iter().any(|world_box| world_box.is_one_way);
        let moving_boxes = (0..).zip(&self.world_boxes).filter(|(_, world_box)| world_box.motion.is_some());
        self.moving_boxes.clear();
        self.moving_boxes.extend(moving_boxes.map(|(place, _)| place));
    }

    /// Sets the motion of the moving box with this id. Returns its body index, and whether its motion or its hinge has changed;
    /// `None` for an unknown id and for a static box.
    pub fn set_world_box_motion(&mut self, id: u32, motion: WorldBoxMotion) -> Option<(BodyIndex, bool)> {
        let (place, _) = self.world_box_by_id(id)?;
        let known = self.world_boxes[place].motion.replace(motion);
        let at = self.moving_boxes.binary_search(&(place as u32)).ok()?;
        Some((BodyIndex::new(at + 1), known != Some(motion)))
    }

    /// Iterates over the moving boxes: id, centre (world coordinates, length units), yaw (radians; `None` if the box never
    /// rotates) and motion.
    pub fn moving_world_boxes(
        &self,
    ) -> impl Iterator<Item = (u32, Vector3, Option<f32>, WorldBoxMotion)> + '_ {
        let moving = self.moving_boxes.iter().map(|&place| &self.world_boxes[place as usize]);
        moving.filter_map(|world_box| {
            Some((world_box.id, world_box.shape.centre, world_box.yaw, world_box.motion?))
        })
    }
}

/// Queries of world boxes: poses, velocities and displacements in the step.
impl DepthState {
    /// Iterates over the moving boxes: world pose in the plane, and tilt in radians.
    pub fn moving_poses(&self) -> impl Iterator<Item = (Pose, f32)> + '_ {
        let moving = self.moving_boxes.iter().map(|&place| &self.world_boxes[place as usize]);
        moving.map(|world_box| (pose_of(world_box), world_box.rotation))
    }

    /// Returns the world box of a proxy; `None` for geoms and the ground.
    pub(super) fn world_box_of(&self, proxy: &Proxy) -> Option<&WorldBox> {
        if proxy.is_world { self.world_boxes.get(proxy.list_key as usize) } else { None }
    }

    /// Returns whether a proxy is a world box that can rotate about the vertical axis.
    pub(crate) fn turns_about_y(&self, proxy: &Proxy) -> bool {
        self.world_box_of(proxy)
            .is_some_and(|world_box| world_box.yaw.is_some() && world_box.motion.is_some())
    }

    /// Returns `solid` with the predicted displacement of the point of the box nearest to `other`. The yaw rate of a world box
    /// moves each of its points by another displacement. Other solids stay unchanged. `dt` is the step in seconds.
    pub(crate) fn with_yaw_displacement<'a>(
        &self,
        mut solid: PosedSolid<'a>,
        proxy: &Proxy,
        other: &PosedSolid<'_>,
        (bodies, dt): (&BodySet, f32),
    ) -> PosedSolid<'a> {
        let Some(world_box) = self.world_box_of(proxy).filter(|_| self.turns_about_y(proxy)) else {
            return solid;
        };
        let SlantedBox { half: [half, ..], turn: [cos, sin], .. } = world_box.shape;
        let (x, z) = (other.shape_centre()[0] - solid.pose[0], other.z - solid.z);
        let middle = world_box.hinge().map_or(0.0, |hinge| hinge.box_offset[0]);
        let along = clamp_any(cos * x + sin * z, middle - half, middle + half)
            * bodies.states[proxy.body].velocity[2]
            * dt;
        solid.predicted_displacement[0] -= along * sin;
        solid.predicted_displacement[2] += along * cos;
        solid
    }

    /// Returns the velocity of a moving box at the point `at` (world coordinates x and z): x, y, 0 in place of rotation, and z,
    /// in length units/s. All components are 0 for other proxies.
    pub(crate) fn velocity_at(&self, proxy: &Proxy, at: [f32; 2], bodies: &BodySet) -> [f32; 4] {
        let body = proxy.body;
        let Some(motion) = self.world_box_of(proxy).and_then(|world_box| world_box.motion) else {
            return [0.0; 4];
        };
        let out = [at[0] - bodies.poses[body][0], at[1] - self.z_positions[body]];
        let [x, y, z] = motion.velocity;
        [x - motion.yaw_rate * out[1], y, 0.0, z + motion.yaw_rate * out[0]]
    }

    /// Returns an upper bound of the displacement of a moving box in this step, in length units. It is 0 if the bound is at
    /// most the speculative distance, and also for a teleport: a displacement above `WORLD_BOX_MAX_SWEEP`. `dt` is the step in
    /// seconds.
    pub(crate) fn sweep_distance(
        &self,
        proxy: &Proxy,
        bodies: &BodySet,
        tuning: &Parameters,
        dt: f32,
    ) -> f32 {
        let Some(world_box) = self.world_box_of(proxy).filter(|world_box| world_box.motion.is_some()) else {
            return 0.0;
        };
        let [x, y, angular_velocity, z] = bodies.states[proxy.body].velocity;
        let displacement =
            (length([length([x, y]), z]) + angular_velocity.abs() * yaw_extent(world_box)) * dt;
        let sweeps = displacement > tuning.speculative_distance
            && displacement <= WORLD_BOX_MAX_SWEEP * tuning.length_unit;
        if sweeps { displacement } else { 0.0 }
    }

    /// Returns whether the next step moves the world box with this body index.
    pub fn is_world_box_moving(&self, body_index: BodyIndex) -> bool {
        let place = body_index.position().checked_sub(1).and_then(|at| self.moving_boxes.get(at));
        let motion = place.and_then(|&place| self.world_boxes[place as usize].motion);
        motion.is_some_and(|motion| motion.is_moving())
    }
}

/// World boxes as bodies and proxies, when all lists are rebuilt.
impl DepthState {
    /// Adds the ground and the static boxes to `BodySet` after all bodies, and sets the velocities and inverse inertias of
    /// moving boxes.
    pub fn add_box_bodies(&mut self, bodies: &mut BodySet) {
        bodies.add_world_box([0.0, 0.0, 1.0, 0.0], 0.0);
        let mut moving = BodyIndex::PLACEHOLDER;
        self.box_bodies.clear();
        for world_box in &self.world_boxes {
            let body_index = if let Some(motion) = world_box.motion {
                moving = moving.next();
                bodies.states[moving].velocity = solver_velocity(&motion);
                if let Some(hinge) = motion.hinge() {
                    bodies.inverse_mass_inertia[moving] = [0.0, hinge.inverse_inertia()];
                    bodies.kinematic.retain(|&body_index| body_index != moving);
                }
                moving
            } else {
                bodies.add_world_box(pose_of(world_box), world_box.rotation)
            };
            self.box_bodies.push(body_index);
        }
    }

    /// Adds the moving boxes to the awake bodies. Only hinged boxes can fall asleep.
    pub fn keep_moving_boxes_awake(&self, sleep: &mut SleepState) {
        IndexRange::new(BodyIndex(1), self.moving_boxes.len())
            .for_each(|body_index| sleep.add_body(body_index));
    }

    /// Adds the proxies of moving boxes, before those of geoms. Returns whether a box has a restitution coefficient above 0.
    pub fn add_moving_box_proxies(&mut self, proxies: &mut Proxies) -> bool {
        self.add_box_proxies(proxies, true)
    }

    /// Adds the proxies of the ground and of static boxes, after those of geoms. Returns whether a static box has a restitution
    /// coefficient above 0. `body_count`: number of bodies, with boxes and the ground.
    pub fn add_ground_and_static_proxies(&mut self, proxies: &mut Proxies, body_count: usize) -> bool {
        let still = self.world_boxes.len() - self.moving_boxes.len();
        self.ground_proxy = proxies.next_index();
        let ground = Proxy {
            list_key: NO_WORLD_BOX,
            ..world_proxy(ground_numbers(), BodyIndex::new(body_count - still - 1))
        };
        proxies.push(ground);
        let any_box_bounces = self.add_box_proxies(proxies, false);
        self.rebuild_proxies(proxies);
        any_box_bounces
    }

    /// Adds the proxies of the moving world boxes if `moving`, else those of the static ones. Returns whether one of them has a
    /// restitution coefficient above 0.
    fn add_box_proxies(&mut self, proxies: &mut Proxies, moving: bool) -> bool {
        let mut any_bounces = false;
        self.box_proxies.resize(self.world_boxes.len(), ProxyIndex::default());
        for (place, (world_box, &body_index)) in self.world_boxes.iter().zip(&self.box_bodies).enumerate() {
            let WorldBox { shape, filter, surface, surface_velocity: [vx, vy, vz], motion, .. } = world_box;
            if motion.is_some() != moving {
                continue;
            }
            let mobility = match motion {
                None => BodyType::Fixed,
                Some(motion) if motion.hinge().is_some() => BodyType::Hinged,
                Some(_) => BodyType::Kinematic,
            };
            let [x, y, depth] = shape.half;
            let x = if world_box.yaw.is_some() { yaw_extent(world_box) } else { x };
            // A sheared box gets the AABB of its full depth.
            let lean = (shape.shear * depth).abs() + (shape.climb * depth).abs();
            let shape = proxies.vertices.add_box([x, y]).expanded(lean);
            let SurfaceCoefficients { friction, restitution } = *surface;
            any_bounces |= restitution > 0.0;
            self.box_proxies[place] = proxies.next_index();
            proxies.push(Proxy {
                list_key: place as u32,
                body_type: mobility,
                shape,
                fingerprint: Fingerprint::of_world_box(world_box),
                friction,
                restitution,
                responds: filter.responds,
                filter: filter.of_proxy(),
                ignores_some: false,
                surface_velocity: [*vx, *vy, 0.0, *vz],
                ..world_proxy(world_box_numbers(world_box), body_index)
            });
        }
        any_bounces
    }

    /// Returns the proxy index of the world box with this id; `None` for an unknown id.
    pub fn proxy_of_world_box(&self, id: u32) -> Option<ProxyIndex> {
        let (place, _) = self.world_box_by_id(id)?;
        self.box_proxies.get(place).copied()
    }

    /// Returns the number of proxies of the ground and of world boxes.
    pub fn world_proxy_count(&self) -> usize {
        self.world_boxes.len() + 1
    }
}

/// Stages of the step that concern world boxes.
impl DepthState {
    /// Start of a step: sets the velocities of moving boxes in `BodySet::states`, so that the broad phase uses the velocities
    /// of this step. `dt` is the step in seconds.
    pub(crate) fn begin_world_boxes(&mut self, bodies: &mut BodySet, dt: f32) {
        for (body_index, &place) in (1..).map(BodyIndex).zip(&self.moving_boxes) {
            let world_box = &mut self.world_boxes[place as usize];
            let WorldBox { shape, yaw, motion: Some(motion), .. } = world_box else { continue };
            motion.begin_step(shape.centre, yaw.unwrap_or_default(), dt);
            if let Some(hinge) = motion.hinge_mut() {
                hinge.is_edited = false;
            }
            bodies.states[body_index].velocity = solver_velocity(motion);
        }
    }

    /// Start of solving: sets the velocities of moving boxes in the solver; forces do not change these velocities.
    pub fn begin_world_box_velocities(&self, bodies: &mut BodySet) {
        for (body_index, &place) in (1..).map(BodyIndex).zip(&self.moving_boxes) {
            let Some(motion) = &self.world_boxes[place as usize].motion else { continue };
            let velocity = solver_velocity(motion);
            bodies.states[body_index] = MotionState { velocity, ..MotionState::default() };
            bodies.initial_velocity[body_index] = velocity;
            (bodies.force_delta[body_index], bodies.force_position_delta[body_index]) = ([0.0; 4], [0.0; 4]);
        }
    }

    /// End of a step: stores centre, yaw and velocity of each moving box in `world_boxes`, and its pose in `BodySet` and
    /// `z_positions`.
    pub fn store_world_boxes(&mut self, bodies: &mut BodySet, proxies: &mut Proxies) {
        for (body_index, &place) in (1..).map(BodyIndex).zip(&self.moving_boxes) {
            let world_box = &mut self.world_boxes[place as usize];
            let Some(motion) = &mut world_box.motion else { continue };
            let [x, y, turned, z] = bodies.delta_pose[body_index];
            world_box.shape.centre = motion.end_step(world_box.shape.centre, [x, y, z]);
            let turned_to = world_box.yaw.map(|yaw| motion.end_yaw(yaw, turned));
            if motion.hinge().is_none() {
                bodies.states[body_index].velocity = solver_velocity(motion);
            }
            if let Some(yaw) = turned_to {
                world_box.yaw = Some(yaw);
                let (sine, cosine) = scalar::sin_cos_of_any(yaw);
                world_box.shape.turn = [cosine, sine];
                if let Some(hinge) = motion.hinge() {
                    world_box.shape.centre = hinge.box_centre(world_box.shape.turn, world_box.shape.centre.y);
                    motion.yaw_rate = bodies.states[body_index].velocity[2];
                }
                let proxy = self.box_proxies[place as usize];
                let vertical = vertical_of(world_box);
                proxies.proxy_mut(proxy).fingerprint = Fingerprint::of_world_box(world_box);
                if let Some(known) = self.extents[proxy].vertical.checked_sub(1) {
                    self.vertical_solids[known as usize] = vertical;
                }
            }
            let world_box = &self.world_boxes[place as usize];
            bodies.poses[body_index] = pose_of(world_box);
            self.z_positions[body_index] = origin_of(world_box).z;
        }
    }
}

impl FatAabbs<'_> {
    /// Pairs each box that moves farther than the speculative distance in this step with all proxies in its swept AABB. The
    /// narrow phase tests existing pairs without contacts again.
    pub(crate) fn pair_sweeping_boxes(&mut self, pairs: &mut Pairs) {
        let count = self.depth.as_ref().map_or(0, |space| space.moving_boxes.len());
        (0..count).for_each(|at| self.pair_sweeping_box(at, pairs));
    }

    /// Pairs a box with all proxies in its swept AABB: see [`pair_sweeping_boxes`](Self::pair_sweeping_boxes). `at` is an index
    /// into `moving_boxes`.
    fn pair_sweeping_box(&mut self, at: usize, pairs: &mut Pairs) {
        let Some(space) = &self.depth else { return };
        let proxy = space.box_proxies[space.moving_boxes[at] as usize];
        let one = self.proxies.proxy(proxy);
        if space.sweep_distance(one, self.bodies, self.parameters, self.dt) == 0.0 {
            return;
        }
        let [x, y, _, z] = self.bodies.states[one.body].velocity.map(|velocity| velocity * self.dt);
        if !self.contains_sweep(proxy, [x, y, 0.0, z]) {
            self.insert(proxy);
        }
        pairs.for_each_index_of(proxy, |pairs, pair| {
            if pairs.manifold(pair).count == 0 {
                pairs.recheck(pair);
            }
        });
    }
}

/// Returns a static proxy without a shape, for the ground or a world box with these numbers and this body index.
fn world_proxy((owner, creation_number): (u64, u32), body: BodyIndex) -> Proxy {
    Proxy {
        owner,
        creation_number,
        body,
        body_type: BodyType::Fixed,
        shape: Shape::default(),
        responds: true,
        ..Proxy::empty()
    }
}
