//! A polygon that pivots over a static face from vertex to vertex, integrated in closed form.
//!
//! Between two impacts the polygon is a compound pendulum about the vertex on the face, with constant energy. An impact keeps
//! the angular momentum about the new vertex. Let r and r' be the arms from the old and the new vertex to the centre of mass, I
//! the moment of inertia and m the mass. The angular velocity w becomes `w (I + m r . r') / (I + m r'^2)`. This is the rimless
//! wheel of T. McGeer, "Passive Dynamic Walking" (1990).
//!
//! Substeps resolve neither: a wheel of 96 vertices has several impacts in one substep. An impact that comes late by a fraction
//! of a substep changes the energy by about as much as the impact itself.

use crate::math::lanes::sin_cos;
use crate::math::plane::{Rot, Vector, cross, difference, dot, length, rotate, rotate_inverse, scaled, sum};
use crate::math::scalar;
use crate::narrow_phase::manifold::next_index;
use crate::parameters::contacts::{PIVOT_MAX_IMPACTS_PER_STEP, PIVOT_MAX_SLIP, PIVOT_MIN_TIME};
use crate::shape::ShapeRef;
use wide::f32x4;

/// A polygon, the static face under it, and the accelerations of the polygon by forces in this step.
#[derive(Clone, Copy)]
pub(crate) struct PivotingPolygon<'a> {
    /// Convex polygon in the frame of its body.
    pub(crate) outline: ShapeRef<'a>,
    /// Cosine and sine of the polygon's rotation in the world frame, at the beginning of the step.
    pub(crate) rotation: Rot,
    /// Unit normal of the face, towards the polygon, in world axes.
    pub(crate) normal: Vector,
    /// Square of the polygon's radius of gyration, I / m, length units^2.
    pub(crate) gyration_squared: f32,
    /// Linear acceleration of the centre of mass by forces: x, y in length units/s^2, world axes.
    pub(crate) acceleration: Vector,
    /// Angular acceleration of the polygon by torques, rad/s^2.
    pub(crate) angular_acceleration: f32,
    /// Friction coefficient of polygon and face, dimensionless, >= 0.
    pub(crate) friction: f32,
    /// Greatest impact speed of a vertex at which it does not bounce, length units/s, >= 0.
    pub(crate) restitution_threshold: f32,
}

/// State of a polygon that pivots about a vertex on a static face.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PivotState {
    /// Index of the polygon's vertex on the face, about which the polygon pivots.
    vertex: usize,
    /// Vector from the vertex on the face to the centre of mass, in world axes, length units.
    arm: Vector,
    /// Rotation of the polygon since the beginning of the step, radians.
    pub(crate) delta_rotation: f32,
    /// Cosine and sine of the polygon's rotation in the world frame.
    rotation: Rot,
    /// Angular velocity of the polygon, rad/s.
    pub(crate) angular_velocity: f32,
    /// Displacement of the centre of mass since the beginning of the step: x, y in length units, world axes.
    pub(crate) delta_position: Vector,
    /// Angular acceleration about the vertex on the face by forces and torques, rad/s^2.
    angular_acceleration: f32,
    /// Force of the face on the polygon per unit of the polygon's mass: x, y in length units/s^2, world axes.
    pub(crate) reaction: Vector,
}

impl PivotState {
    /// Returns the velocity of the centre of mass: x, y in length units/s, world axes.
    pub(crate) fn velocity(&self) -> Vector {
        perpendicular(scaled(self.arm, self.angular_velocity))
    }
}

/// The next impact of a vertex of a pivoting polygon on the face.
struct VertexImpact {
    /// Index of the polygon's vertex that meets the face.
    vertex: usize,
    /// Angle by which the polygon rotates until the impact, radians, >= 0.
    angle: f32,
}

impl PivotingPolygon<'_> {
    /// Returns the state of the polygon after `dt` seconds. `ends`: indices of the
    /// vertices of the edge that faces the plane. `velocity`: x, y of the centre of mass in length units/s, and angular
    /// velocity in rad/s.
    ///
    /// `None` if the polygon slides, bounces or leaves the face, or lacks the energy to pass over a vertex. The iterative
    /// solver moves such a polygon.
    pub(crate) fn advance(&self, ends: [u32; 2], velocity: [f32; 3], dt: f32) -> Option<PivotState> {
        let (mut state, mut remaining) = (self.initial_state(ends, velocity)?, dt);
        for _ in 0..PIVOT_MAX_IMPACTS_PER_STEP {
            let next = self.next_impact(&state)?;
            self.has_energy_to_pass(&state, next.angle).then_some(())?;
            remaining = self.integrate_pivot(&mut state, next.angle, remaining)?;
            if remaining <= PIVOT_MIN_TIME * dt {
                return Some(state);
            }
            self.apply_impact(&mut state, next.vertex)?;
        }
        None
    }

    /// Returns the state at the beginning of the step: the polygon pivots about the slower one of the vertices `ends`. `[x, y,
    /// spin]`: velocity of the centre of mass in length units/s, and angular velocity in rad/s. `None` if the slower vertex
    /// moves too fast ([`PIVOT_MAX_SLIP`]), or if the reaction is outside of the friction cone.
    fn initial_state(&self, ends: [u32; 2], [x, y, spin]: [f32; 3]) -> Option<PivotState> {
        let arm_of = |end: u32| scaled(rotate(self.rotation, self.outline.vertices[end as usize]), -1.0);
        let slip_of = |arm: Vector| length(difference([x, y], perpendicular(scaled(arm, spin))));
        let [slip, other] = ends.map(|end| slip_of(arm_of(end)));
        let corner = if slip < other { ends[0] } else { ends[1] } as usize;
        let arm = arm_of(corner as u32);
        (slip_of(arm) <= PIVOT_MAX_SLIP * spin.abs() * length(arm)).then_some(())?;
        let momentum = self.gyration_squared * spin + cross(arm, [x, y]);
        let spin = momentum / (self.gyration_squared + dot(arm, arm));
        let mut state = PivotState {
            vertex: corner,
            arm,
            delta_rotation: 0.0,
            rotation: self.rotation,
            angular_velocity: spin,
            delta_position: [0.0; 2],
            angular_acceleration: 0.0,
            reaction: [0.0; 2],
        };
        self.update_reaction(&mut state)?;
        Some(state)
    }

    /// Returns the next impact of a vertex on the face in the direction of rotation. `None` if that vertex is already below the
    /// face.
    fn next_impact(&self, state: &PivotState) -> Option<VertexImpact> {
        let count = self.outline.vertices.len();
        let (side, ahead) = if state.angular_velocity > 0.0 { (1.0, count - 1) } else { (-1.0, 1) };
        let corner = (state.vertex + ahead) % count;
        let edge = self.edge_to(corner, state);
        let along = scaled(perpendicular(self.normal), side);
        let angle = scalar::atan2(dot(edge, self.normal), dot(edge, along));
        (angle > -PIVOT_MAX_SLIP).then_some(VertexImpact { vertex: corner, angle: scalar::max(angle, 0.0) })
    }

    /// Returns whether the kinetic energy suffices to lift the centre of mass over the vertex on the face. It is also true if
    /// the next impact comes before the centre of mass is at the top. `angle`: rotation until the next impact, radians.
    fn has_energy_to_pass(&self, state: &PivotState, angle: f32) -> bool {
        let side = if state.angular_velocity > 0.0 { 1.0 } else { -1.0 };
        let rises = |arm: Vector| dot(self.acceleration, perpendicular(scaled(arm, side))) < 0.0;
        let (arm, inertia) = (state.arm, self.gyration_squared + dot(state.arm, state.arm));
        if !rises(arm) || rises(rotate(rotation_by(side * angle), arm)) {
            return true;
        }
        let lift = length(self.acceleration) * length(arm) + dot(self.acceleration, arm);
        let braking_work = scalar::min(self.gyration_squared * self.angular_acceleration * side, 0.0) * angle;
        state.angular_velocity * state.angular_velocity * inertia > 2.0 * (lift - braking_work)
    }

    /// Integrates the rotation about the vertex on the face until the impact at `angle` radians, for at most `remaining`
    /// seconds. Returns the seconds of the step that remain after it. `None` if the polygon stops and turns back, or if the
    /// reaction leaves the friction cone.
    ///
    /// The angle after a time is that of an angular acceleration linear in time, whose value at the end is taken where a constant
    /// one would end. The speed at an angle is exact: it follows from the energy.
    fn integrate_pivot(&self, state: &mut PivotState, angle: f32, remaining: f32) -> Option<f32> {
        let side = if state.angular_velocity > 0.0 { 1.0 } else { -1.0 };
        let (spin, first) = (state.angular_velocity, state.angular_acceleration);
        let uniform = (spin + 0.5 * first * remaining) * remaining;
        let last = self.angular_acceleration_about_vertex(rotate(rotation_by(uniform), state.arm));
        let free = (spin + (2.0 * first + last) / 6.0 * remaining) * remaining;
        let is_impact = free * side >= angle;
        // The energy does not tell in which direction the polygon turns.
        let turns_back = (spin + 0.5 * (first + last) * remaining) * side <= 0.0;
        (is_impact || !turns_back).then_some(())?;
        let turned = if is_impact { side * angle } else { free };
        self.turn(state, turned)?;
        if !is_impact {
            return Some(0.0);
        }
        // The trapezoidal rule with its correction for the accelerations at both ends, solved for the time by one iteration.
        let mean_speed = 0.5 * (spin + state.angular_velocity);
        let uniform_time = turned / mean_speed;
        let correction = uniform_time * uniform_time * (first - state.angular_acceleration) / 12.0;
        let elapsed = (turned - correction) / mean_speed;
        Some(remaining - scalar::max(scalar::min(elapsed, remaining), 0.0))
    }

    /// Turns the polygon about the vertex on the face by `angle` radians, with its energy conserved. `None` if the energy does not
    /// suffice, or if the reaction leaves the friction cone.
    fn turn(&self, state: &mut PivotState, angle: f32) -> Option<()> {
        let turn = rotation_by(angle);
        let arm = rotate(turn, state.arm);
        let change = difference(arm, state.arm);
        let work = dot(self.acceleration, change) + self.gyration_squared * self.angular_acceleration * angle;
        let inertia = self.gyration_squared + dot(state.arm, state.arm);
        let squared = state.angular_velocity * state.angular_velocity + 2.0 * work / inertia;
        (squared > 0.0).then_some(())?;
        state.angular_velocity = squared.sqrt().copysign(state.angular_velocity);
        state.rotation = rotate(turn, state.rotation);
        state.delta_rotation += angle;
        state.delta_position = sum(state.delta_position, change);
        state.arm = arm;
        self.update_reaction(state)
    }

    /// Applies the impact of the vertex with index `corner` on the face: from now on the polygon pivots about this vertex, with
    /// its angular momentum about the vertex conserved. `None` if the polygon bounces or slides.
    fn apply_impact(&self, state: &mut PivotState, corner: usize) -> Option<()> {
        let edge = self.edge_to(corner, state);
        (state.angular_velocity.abs() * length(edge) <= self.restitution_threshold).then_some(())?;
        let (before, arm) = (state.velocity(), difference(state.arm, edge));
        let momentum_ratio =
            (self.gyration_squared + dot(arm, state.arm)) / (self.gyration_squared + dot(arm, arm));
        (momentum_ratio > 0.0).then_some(())?;
        (state.vertex, state.arm, state.angular_velocity) =
            (corner, arm, momentum_ratio * state.angular_velocity);
        state.angular_acceleration = self.angular_acceleration_about_vertex(arm);
        self.is_in_friction_cone(difference(state.velocity(), before)).then_some(())
    }

    /// Returns the vector from the vertex on the face to the vertex with index `corner`, in world axes, length units.
    fn edge_to(&self, corner: usize, state: &PivotState) -> Vector {
        let edge = difference(self.outline.vertices[corner], self.outline.vertices[state.vertex]);
        rotate(state.rotation, edge)
    }

    /// Returns both ends of the edge that faces the plane, relative to the centre of mass, in world axes, length units. Of the
    /// two edges at the vertex on the face it is the one whose normal is more opposed to the normal of the face.
    pub(crate) fn facing_edge(&self, state: &PivotState) -> [Vector; 2] {
        let count = self.outline.vertices.len();
        let away_from_face = rotate_inverse(state.rotation, self.normal);
        let [before, after] = [(state.vertex + count - 1) % count, state.vertex];
        let [along_before, along_after] =
            [before, after].map(|edge| dot(self.outline.normals[edge], away_from_face));
        let edge = if along_before < along_after { before } else { after };
        [edge, next_index(edge, count)].map(|end| rotate(state.rotation, self.outline.vertices[end]))
    }

    /// Returns the angular acceleration of the polygon about the vertex on the face by forces and torques, rad/s^2. `arm`: vector
    /// from that vertex to the centre of mass, in world axes, length units.
    fn angular_acceleration_about_vertex(&self, arm: Vector) -> f32 {
        let torque = cross(arm, self.acceleration) + self.gyration_squared * self.angular_acceleration;
        torque / (self.gyration_squared + dot(arm, arm))
    }

    /// Computes the angular acceleration of the polygon about the vertex on the face, and the force of the face. `None` if the force
    /// is outside of the friction cone.
    fn update_reaction(&self, state: &mut PivotState) -> Option<()> {
        state.angular_acceleration = self.angular_acceleration_about_vertex(state.arm);
        let tangential = perpendicular(scaled(state.arm, state.angular_acceleration));
        let centripetal = scaled(state.arm, -state.angular_velocity * state.angular_velocity);
        state.reaction = difference(sum(tangential, centripetal), self.acceleration);
        self.is_in_friction_cone(state.reaction).then_some(())
    }

    /// Returns whether a force or impulse on the polygon is in the friction cone. It has no component against the normal, and
    /// its tangential component is at most the friction coefficient times its normal component.
    fn is_in_friction_cone(&self, force: Vector) -> bool {
        let normal_force = dot(force, self.normal);
        normal_force >= 0.0 && cross(self.normal, force).abs() <= self.friction * normal_force
    }
}

/// Returns the vector rotated by 90 degrees, (-y, x).
fn perpendicular([x, y]: Vector) -> Vector {
    [-y, x]
}

/// Returns cosine and sine of `angle`, in radians, with errors up to 1.3e-7 between -pi/4 and a full turn. A polygon turns from one
/// vertex to the next by less than pi.
fn rotation_by(angle: f32) -> Rot {
    let (sine, cosine) = sin_cos(f32x4::splat(angle.abs()));
    let sine = sine.as_array()[0];
    [cosine.as_array()[0], if angle < 0.0 { -sine } else { sine }]
}

#[cfg(test)]
mod tests {
    use super::{PivotingPolygon, rotate_inverse};
    use crate::contact_solver::rolling::incident_edge;
    use crate::shape::{Shape, ShapeRef, VertexPool};
    use std::f64::consts::PI;

    /// Radius of the wheels, length units, and their square of the radius of gyration divided by the square of this radius.
    const RADIUS: f64 = 1.0;
    const GYRATION: f64 = 0.5;
    /// Gravity in length units/s^2, slope in radians, and initial angular velocity in rad/s.
    const GRAVITY: f64 = 10.0;
    const SLOPE: f64 = 0.3;
    const SPIN: f64 = 1.5;
    const SECONDS: f64 = 0.6;

    /// Returns the rotation, in radians, of a wheel of `count` vertices that begins on an edge. A compound pendulum is integrated in
    /// steps of 2 us; an impact keeps the angular momentum about the new vertex.
    fn reference_rotation(count: usize) -> f64 {
        let (half, h) = (PI / count as f64, 2e-6);
        let (mut lean, mut spin, mut rotation) = (-half, SPIN, 0.0);
        for _ in 0..(SECONDS / h) as usize {
            let acceleration = GRAVITY * RADIUS * (lean + SLOPE).sin() / (RADIUS * RADIUS * (1.0 + GYRATION));
            spin += acceleration * h;
            lean += spin * h;
            rotation += spin * h;
            if lean >= half {
                lean -= 2.0 * half;
                spin *= (GYRATION + (2.0 * half).cos()) / (GYRATION + 1.0);
            }
        }
        rotation
    }

    /// Adds the wheel of `count` vertices, lying on an edge, to a pool.
    fn wheel_in(pool: &mut VertexPool, count: usize) -> Shape {
        let corner = |at: usize| {
            let angle = (2.0 * at as f64 + 1.0) * PI / count as f64 - PI / 2.0;
            [angle.cos(), angle.sin()].map(|part| (RADIUS * part) as f32)
        };
        pool.add_hull(&(0..count).map(corner).collect::<Vec<_>>())
    }

    /// Returns a wheel on the slope, whose axes are those of the world.
    fn polygon_on_slope(outline: ShapeRef<'_>) -> PivotingPolygon<'_> {
        PivotingPolygon {
            outline,
            rotation: [1.0, 0.0],
            normal: [0.0, 1.0],
            gyration_squared: (GYRATION * RADIUS * RADIUS) as f32,
            acceleration: [GRAVITY * SLOPE.sin(), -GRAVITY * SLOPE.cos()].map(|part| part as f32),
            angular_acceleration: 0.0,
            friction: 10.0,
            restitution_threshold: f32::MAX,
        }
    }

    /// Returns x, y and angular velocity of a wheel of `count` vertices on an edge that rolls down the slope at `spin` rad/s.
    fn velocity_of_roll(count: usize, spin: f64) -> [f32; 3] {
        let [cosine, sine] = [(PI / count as f64).cos(), (PI / count as f64).sin()];
        // About the vertex ahead.
        [spin * RADIUS * cosine, spin.abs() * RADIUS * sine, -spin].map(|part| part as f32)
    }

    /// Returns the rotation, in radians, of the same wheel by [`PivotingPolygon::advance`] in 36 steps.
    fn rotation_of_wheel(count: usize) -> f64 {
        let mut pool = VertexPool::default();
        let wheel = wheel_in(&mut pool, count);
        let mut polygon = polygon_on_slope(pool.shape_ref(wheel));
        let (mut velocity, mut rotation) = (velocity_of_roll(count, SPIN), 0.0);
        for _ in 0..36 {
            let ends = incident_edge(polygon.outline, rotate_inverse(polygon.rotation, polygon.normal));
            let after = polygon.advance(ends, velocity, (SECONDS / 36.0) as f32).expect("the wheel rolls on");
            rotation -= f64::from(after.delta_rotation);
            let [x, y] = after.velocity();
            (velocity, polygon.rotation) = ([x, y, after.angular_velocity], after.rotation);
        }
        rotation
    }

    #[test]
    fn a_wheel_that_would_turn_back_within_the_step_is_left_to_the_iterative_solver() {
        let mut pool = VertexPool::default();
        let wheel = wheel_in(&mut pool, 96);
        let polygon = polygon_on_slope(pool.shape_ref(wheel));
        let ends = incident_edge(polygon.outline, rotate_inverse(polygon.rotation, polygon.normal));
        // Gravity stops a slow roll up the slope within a hundredth of a second.
        for spin in [0.01, 0.003] {
            assert!(polygon.advance(ends, velocity_of_roll(96, -spin), 1.0 / 60.0).is_none(), "{spin} rad/s");
        }
        assert!(polygon.advance(ends, velocity_of_roll(96, SPIN), 1.0 / 60.0).is_some());
    }

    #[test]
    fn wheels_roll_as_far_as_compound_pendulums_that_keep_their_momentum_at_impacts() {
        for count in [6, 8, 12, 16, 48, 96] {
            let (law, rotation) = (reference_rotation(count), rotation_of_wheel(count));
            // Twice the largest deviation measured; f32 rounds by 6e-8, and the reference is off by half a step, 1 us, per impact.
            assert!(
                (rotation - law).abs() < 4e-6 * law,
                "{count} vertices: {rotation} rad, by law {law} rad"
            );
        }
    }
}
