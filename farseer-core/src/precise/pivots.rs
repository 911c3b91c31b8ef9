//! Bodies that pivot from corner to corner over static faces: which do in a step, and what becomes of them and of their rows.
//!
//! The rows of such a body take part in the iterative solver as those of all others, so that a body that meets something in the
//! next step has impulses to start from; but pose and velocity of the body are those of [`Pivoting`].

use super::Precise;
use super::pivoting::{OnCorner, Pivoting};
use super::rolling::{Plane, Roll, facing_ends, is_over};
use super::tuning::Step;
use crate::math::plane::{Vector, cross, difference, dot, place, rotation, scaled, sum, turn, turn_back};
use crate::math::scalar;
use crate::precise::parameters::contacts::{PIVOT_PENETRATION, PIVOT_PLANE_DIFFERENCE};

impl Precise {
    /// Finds the bodies that pivot in this step. Of several rows of a body one stands for all.
    pub(super) fn begin_pivots(&mut self, rolling: &mut Vec<Roll>, step: &Step) {
        let mut pivots = std::mem::take(&mut self.known);
        rolling.retain_mut(|roll| {
            let pivots = &mut pivots[roll.proxies[1] as usize];
            if *pivots {
                return false;
            }
            roll.pivoted = self.pivoted(roll, step);
            *pivots = roll.pivoted.is_some();
            true
        });
        rolling.iter().for_each(|roll| pivots[roll.proxies[1] as usize] = false);
        self.known = pivots;
    }

    /// The polygon after the step, if static faces of one plane are all that touches it, and it neither slips nor hops.
    fn pivoted(&self, roll: &mut Roll, step: &Step) -> Option<OnCorner> {
        let [at_a, at_b] = roll.proxies;
        let pair = self.pairs.of(at_b).find(|&at| self.pairs.watched[at].proxies == roll.proxies)?;
        roll.pair = pair as u32;
        let b = self.proxies.all[at_b as usize].body as usize;
        let state = &self.pairs.all[pair];
        let lane = self.rows.lane(state.kind, state.home?);
        let outline = self.outline_of(at_b);
        let ([x, y, spin, z], push) = (self.bodies.hot[b].velocity, self.bodies.push[b]);
        let is_in_plane = [z, push[3], lane.space.normal_z] == [0.0; 3] && outline.shape.radius == 0.0;
        let can_turn = lane.inverse_masses[1] > 0.0 && lane.inverse_inertias[1] > 0.0;
        if !(is_in_plane && can_turn && outline.points.len() > 2) || self.joints.holds(b) {
            return None;
        }
        let pose_a = self.bodies.poses[self.proxies.all[at_a as usize].body as usize];
        let own = Plane::of(&self.pairs.frozen[pair]);
        let offset = own.offset + dot(difference(place(pose_a), place(self.bodies.poses[b])), own.normal);
        let plane = Plane { normal: own.normal, offset };
        let friction = self.friction_of_plane(b, at_b, &plane)?;
        let [ax, ay, turning, _] = push.map(|push| push / step.h);
        let pivoting = Pivoting {
            outline,
            rotation: rotation(self.bodies.poses[b]),
            normal: plane.normal,
            gyration: lane.inverse_masses[1] / lane.inverse_inertias[1],
            acceleration: [ax, ay],
            angular_acceleration: turning,
            friction,
            quiet: if lane.restitution > 0.0 { self.tuning.bounce } else { f32::MAX },
        };
        let ends = facing_ends(outline, turn_back(pivoting.rotation, plane.normal));
        let lowest = ends.map(|end| dot(turn(pivoting.rotation, outline.points[end as usize]), plane.normal));
        let depth = scalar::min(lowest[0], lowest[1]) - plane.offset;
        let is_on_plane = depth.abs() <= PIVOT_PENETRATION * self.tuning.speculative;
        if !(is_on_plane && self.is_borne(at_b, &plane, 0.0, [0.0; 2])) {
            return None;
        }
        let after = pivoting.after(ends, [x, y, spin], step.dt, step.h)?;
        self.is_borne(at_b, &plane, after.turned, after.path).then_some(after)
    }

    /// Least friction of the rows of a body, if all are those of one polygon with static shapes that do not reach above the plane:
    /// a polygon that pivots on the plane meets none of them but there. The offset of the plane is that from the origin of the
    /// body.
    fn friction_of_plane(&self, b: usize, at_b: u32, plane: &Plane) -> Option<f32> {
        let mut friction = f32::MAX;
        for pair in self.pairs.of_body(&self.proxies, b) {
            let state = &self.pairs.all[pair];
            let Some(home) = state.home else { continue };
            let (lane, [_, other]) = (self.rows.lane(state.kind, home), self.pairs.watched[pair].proxies);
            let is_still = [lane.tangent_speed, lane.space.across_speed, lane.space.normal_z] == [0.0; 3];
            let is_static = state.kind.is_fixed && other == at_b && self.rows.aside(home).is_none();
            if !(is_static
                && is_still
                && self.height_over(pair, plane) <= PIVOT_PLANE_DIFFERENCE * self.tuning.unit)
            {
                return None;
            }
            friction = scalar::min(friction, lane.friction);
        }
        Some(friction)
    }

    /// How far the shape of A reaches above a plane, whose offset is that from the origin of B, in length units.
    fn height_over(&self, pair: usize, plane: &Plane) -> f32 {
        let [at_a, at_b] = self.pairs.watched[pair].proxies;
        let [a, b] =
            [at_a, at_b].map(|proxy| self.bodies.poses[self.proxies.all[proxy as usize].body as usize]);
        let above = dot(difference(place(a), place(b)), plane.normal) - plane.offset;
        if self.pairs.all[pair].is_on_ground {
            let own = Plane::of(&self.pairs.frozen[pair]);
            let is_level = cross(own.normal, plane.normal).abs() <= PIVOT_PLANE_DIFFERENCE;
            return if is_level { above + own.offset } else { f32::MAX };
        }
        let (outline, direction) = (self.outline_of(at_a), turn_back(rotation(a), plane.normal));
        above + outline.shape.radius + outline.farthest_along(direction)
    }

    /// Whether static faces of a plane are under both ends of the edge of a polygon that faces it, once the body has turned and
    /// moved by this much.
    fn is_borne(&self, at_b: u32, plane: &Plane, turned: f32, path: Vector) -> bool {
        let pose = self.bodies.poses[self.proxies.all[at_b as usize].body as usize];
        let (sine, cosine) = scalar::sin_cos(turned);
        let q = turn([cosine, sine], rotation(pose));
        let outline = self.outline_of(at_b);
        facing_ends(outline, turn_back(q, plane.normal)).iter().all(|&end| {
            let point = sum(path, turn(q, outline.points[end as usize]));
            self.pairs.of(at_b).any(|pair| self.bears(pair, at_b, plane, point))
        })
    }

    /// Whether the static face of a pair lies in a plane, under a point as seen from the origin of B.
    fn bears(&self, pair: usize, at_b: u32, plane: &Plane, point: Vector) -> bool {
        let (state, [at_a, other]) = (&self.pairs.all[pair], self.pairs.watched[pair].proxies);
        // In three axes outlines that overlap in the plane may be apart.
        let is_met = state.home.is_some() || self.space.is_none();
        let pushes = state.kind.is_fixed && state.responds && !state.is_vetoed;
        let is_level = || self.height_over(pair, plane).abs() <= PIVOT_PLANE_DIFFERENCE * self.tuning.unit;
        if !(other == at_b && is_met && pushes && is_level()) {
            return false;
        }
        if state.is_on_ground {
            return true;
        }
        let (face, b) = (self.outline_of(at_a), self.proxies.all[at_b as usize].body as usize);
        let pose_a = self.bodies.poses[self.proxies.all[at_a as usize].body as usize];
        let apart = difference(place(self.bodies.poses[b]), place(pose_a));
        let q = rotation(pose_a);
        let direction = turn_back(q, plane.normal);
        let has_face = face.normals.iter().any(|&normal| {
            cross(normal, direction).abs() <= PIVOT_PLANE_DIFFERENCE && dot(normal, direction) > 0.0
        });
        has_face && is_over(face, q, plane.normal, sum(apart, point))
    }

    /// After the last substep: pose and velocity of the body are those of its pivot, and its rows have the impulses that bear it
    /// there.
    pub(super) fn end_pivot(&mut self, roll: &Roll, after: &OnCorner, step: &Step) {
        let at_b = roll.proxies[1];
        let b = self.proxies.all[at_b as usize].body as usize;
        let [x, y] = after.velocity();
        self.bodies.hot[b].velocity = [x, y, after.spin, 0.0];
        let impulse = scaled(after.reaction, step.h / self.bodies.inverses[b][0]);
        let mut pairs = std::mem::take(&mut self.lost);
        pairs.extend(self.pairs.of(at_b).map(|pair| pair as u32));
        for pair in pairs.drain(..).map(|pair| pair as usize) {
            let state = self.pairs.all[pair];
            let Some(home) = state.home else { continue };
            let mut lane = self.rows.lane(state.kind, home);
            let bears = pair as u32 == roll.pair;
            let part = if bears { impulse } else { [0.0; 2] };
            let [pressed, along] = [dot(part, lane.normal), -cross(lane.normal, part)];
            for (at, point) in lane.points.iter_mut().enumerate() {
                point.impulse = if at == 0 { pressed } else { 0.0 };
                point.held = point.impulse;
                lane.space.totals[at] = point.impulse * step.substeps as f32;
            }
            (lane.tangent_impulse, lane.space.across_impulse) = (along, 0.0);
            (lane.space.totals[2], lane.space.totals[3]) = (along * step.substeps as f32, 0.0);
            self.rows.set_lane(state.kind, home, &lane);
            self.pairs.watched[pair].tolerance = 0;
        }
        self.lost = pairs;
    }
}
