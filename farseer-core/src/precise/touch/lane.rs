//! The contacts of a pair as a row, in the plane and in three axes.

use super::{Touch, Two};
use crate::geom::surface::mix_restitution;
use crate::math::plane::{Vector, cross, difference, dot, scaled, sum, turn};
use crate::precise::pairs::{Frozen, FrozenInSpace};
use crate::precise::proxies::{Mobility, Proxy};
use crate::precise::rows::{Lane, PointLane, SpaceLane};
use crate::precise::space::parts::Swings;
use crate::precise::space::{Space, tangents};

impl Touch<'_> {
    /// The row of a pair as its contacts were found, without impulses.
    pub(super) fn lane(&self, pair: usize, two: Two<'_>) -> Lane {
        let frozen = &self.pairs.frozen[pair];
        let is_fixed = self.is_fixed(two.a);
        let [[mass_a, inertia_a], [mass_b, inertia_b]] =
            [two.a, two.b].map(|proxy| self.bodies.inverses[proxy.body as usize]);
        let normal = frozen.normal;
        let weight = |arm_a: f32, arm_b: f32| {
            let inverse = mass_a + mass_b + inertia_a * arm_a * arm_a + inertia_b * arm_b * arm_b;
            if inverse > 0.0 { 1.0 / inverse } else { 0.0 }
        };
        let mut points = [PointLane { separation: self.tuning.unit, ..PointLane::default() }; 2];
        let (mut tangent_a, mut tangent_b) = (0.0, 0.0);
        let lead = [1.0 - 0.5 * frozen.lead * frozen.lead, frozen.lead];
        for (at, point) in points.iter_mut().enumerate().take(frozen.count as usize) {
            let [ax, ay, bx, by] = frozen.anchors[at];
            // What is round about a corner does not turn with it.
            let round = scaled(normal, two.b.shape.radius);
            let [bx, by] = difference(turn(lead, sum([bx, by], round)), round);
            let (arm_a, arm_b) = (cross([ax, ay], normal), cross([bx, by], normal));
            tangent_a -= dot([ax, ay], normal);
            tangent_b -= dot([bx, by], normal);
            *point = PointLane {
                arm_a,
                arm_b,
                mass: weight(arm_a, arm_b),
                separation: frozen.separations[at],
                ..PointLane::default()
            };
        }
        let parts = 1.0 / frozen.count as f32;
        let tangent_arms = [tangent_a * parts, tangent_b * parts];
        let lane = Lane {
            a: if is_fixed { 0 } else { two.a.body },
            b: two.b.body,
            pair: pair as u32,
            normal,
            inverse_masses: [mass_a, mass_b],
            inverse_inertias: [inertia_a, inertia_b],
            // Of numbers that are too great for it a mix is none.
            friction: self.friction.mix(two.a.friction, two.b.friction).min(f32::MAX),
            tangent_arms,
            tangent_mass: weight(tangent_arms[0], tangent_arms[1]),
            tangent_impulse: 0.0,
            tangent_speed: belt_speed(two.a, normal, frozen.anchors[0]).clamp(f32::MIN, f32::MAX),
            restitution: mix_restitution(two.a.restitution, two.b.restitution).clamp(f32::MIN, f32::MAX),
            points,
            space: SpaceLane::default(),
        };
        match &self.space {
            None => lane,
            Some(space) => self.lane_in_space(space, pair, two, lane),
        }
    }

    /// The same in three axes.
    fn lane_in_space(&self, space: &Space, pair: usize, two: Two<'_>, lane: Lane) -> Lane {
        let Frozen {
            normal: [x, y],
            count,
            anchors,
            space: FrozenInSpace { normal_z, spread, depths, .. },
            ..
        } = self.pairs.frozen[pair];
        let (tangent, [ux, uy, uz]) = tangents([x, y, normal_z]);
        let points = &anchors[..count as usize];
        let arms = |along: Vector| {
            let sum = points.iter().fold([0.0; 2], |[of_a, of_b], &[ax, ay, bx, by]| {
                [of_a + cross([ax, ay], along), of_b + cross([bx, by], along)]
            });
            sum.map(|arm| arm / count as f32)
        };
        let (mut points_of, mut tangent_arms, mut across_arms) = (lane.points, arms(tangent), arms([ux, uy]));
        if self.turns_upright(two.a) {
            // About the upright axis: at r a turn has the velocity (-r.z, 0, r.x).
            let arm = |at: usize, [x, _, z]: [f32; 3]| anchors[at][0] * z - depths[at] * x;
            let mean = |axis| (0..count as usize).map(|at| arm(at, axis)).sum::<f32>() / count as f32;
            for (at, point) in points_of.iter_mut().enumerate().take(count as usize) {
                point.arm_a = arm(at, [x, y, normal_z]);
                if Swings::ARE_THERE && two.a.mobility == Mobility::Hinged {
                    point.mass = lane.weight(point);
                }
            }
            tangent_arms[0] = mean([tangent[0], tangent[1], 0.0]);
            across_arms[0] = mean([ux, uy, uz]);
        }
        let [at_a, at_b] = self.pairs.watched[pair].proxies;
        let [friction, restitution] = space.surface([at_a, at_b], [two.a, two.b], self.friction);
        Lane {
            friction,
            restitution,
            tangent_arms,
            points: points_of,
            tangent_speed: belt_speed(two.a, [-tangent[1], tangent[0]], anchors[0]).clamp(f32::MIN, f32::MAX),
            space: SpaceLane {
                normal_z,
                across_arms,
                radii: [space.rolling_radius(at_a, two.a), space.rolling_radius(at_b, two.b)],
                across_speed: (belt_speed(two.a, [-uy, ux], anchors[0]) + uz * two.a.surface_velocity[3])
                    .clamp(f32::MIN, f32::MAX),
                spread,
                ..SpaceLane::default()
            },
            ..lane
        }
    }

    /// Friction, restitution and tangent speed of a pair without a handler.
    pub(in crate::precise) fn surface(&self, pair: usize) -> [f32; 3] {
        let Lane { friction, restitution, tangent_speed, .. } = self.lane(pair, self.two(pair));
        [friction, restitution, tangent_speed]
    }

    /// The surfaces of a row are again what they are without a handler.
    pub(in crate::precise) fn renew_surface(&mut self, pair: usize) {
        let state = self.pairs.all[pair];
        let Some(home) = state.home else { return };
        let [friction, restitution, tangent_speed] = self.surface(pair);
        let lane = Lane { friction, restitution, tangent_speed, ..self.rows.lane(state.kind, home) };
        self.rows.set_lane(state.kind, home, &lane);
    }
}

/// Friction that was found before goes on, along tangents that may have turned.
pub(super) fn carry_friction(lane: &mut Lane, old: &Lane) {
    lane.tangent_impulse = old.tangent_impulse;
    (lane.space.twist_impulse, lane.space.totals) = (old.space.twist_impulse, old.space.totals);
    let (along, across) = (old.tangent_impulse, old.space.across_impulse);
    let is_same = lane.space.normal_z == old.space.normal_z && lane.normal == old.normal;
    if across == 0.0 && (is_same || lane.space.normal_z == 0.0) {
        return;
    }
    let of = |lane: &Lane| tangents([lane.normal[0], lane.normal[1], lane.space.normal_z]);
    let (([tx, ty], [ux, uy, uz]), (tangent, second)) = (of(old), of(lane));
    let [x, y, z] = [along * tx + across * ux, along * ty + across * uy, across * uz];
    lane.tangent_impulse = dot([x, y], tangent);
    lane.space.across_impulse = dot([x, y], [second[0], second[1]]) + z * second[2];
}

/// Speed of B against A along the tangent (normal y, -normal x) that a surface moving under it aims at.
fn belt_speed(a: &Proxy, normal: Vector, [ax, ay, ..]: [f32; 4]) -> f32 {
    let [x, y, spin, _] = a.surface_velocity;
    let at = [x - spin * ay, y + spin * ax];
    dot(at, [normal[1], -normal[0]])
}
