//! Storage of bodies in the solver, and loading and storing of one or four of them as SIMD lanes.

use wide::f32x4;

use super::kernel::BodyLanes;
use super::lanes::LANES;

/// Two vectors per body: velocity with inverse mass, and bias velocity with inverse inertia.
pub(super) type PackedBody = [f32x4; 2];

#[inline(always)]
pub(super) fn unpack_one(state: &PackedBody) -> BodyLanes<f32> {
    let [x, y, w, inverse_mass] = state[0].to_array();
    let [bias_x, bias_y, bias_w, inverse_inertia] = state[1].to_array();
    BodyLanes { velocity: [x, y, w], bias: [bias_x, bias_y, bias_w], inverse_mass, inverse_inertia }
}

#[inline(always)]
pub(super) fn pack_one(body: &BodyLanes<f32>) -> PackedBody {
    let ([x, y, w], [bias_x, bias_y, bias_w]) = (body.velocity, body.bias);
    [f32x4::new([x, y, w, body.inverse_mass]), f32x4::new([bias_x, bias_y, bias_w, body.inverse_inertia])]
}

#[inline(always)]
pub(super) fn unpack_four(states: &[PackedBody], bodies: &[u32; LANES]) -> BodyLanes<f32x4> {
    let lanes = bodies.map(|body| states[body as usize]);
    let [x, y, w, inverse_mass] = f32x4::transpose(lanes.map(|state| state[0]));
    let [bias_x, bias_y, bias_w, inverse_inertia] = f32x4::transpose(lanes.map(|state| state[1]));
    BodyLanes { velocity: [x, y, w], bias: [bias_x, bias_y, bias_w], inverse_mass, inverse_inertia }
}

/// Stores four bodies. An immovable body may be in several lanes: all write its old state.
#[inline(always)]
pub(super) fn pack_four(states: &mut [PackedBody], bodies: &[u32; LANES], body: &BodyLanes<f32x4>) {
    let ([x, y, w], [bias_x, bias_y, bias_w]) = (body.velocity, body.bias);
    let velocities = f32x4::transpose([x, y, w, body.inverse_mass]);
    let biases = f32x4::transpose([bias_x, bias_y, bias_w, body.inverse_inertia]);
    for lane in 0..LANES {
        states[bodies[lane] as usize] = [velocities[lane], biases[lane]];
    }
}
