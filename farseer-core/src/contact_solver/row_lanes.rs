//! Packing of single rows into rows of four lanes.

use wide::f32x4;

use super::kernel::ContactRow;
use super::lanes::LANES;

/// Packs four rows into one of four lanes, before the pre-step.
pub(super) fn pack_rows(rows: &[ContactRow<f32>; LANES]) -> ContactRow<f32x4> {
    let lanes = |field: fn(&ContactRow<f32>) -> f32| f32x4::new([0, 1, 2, 3].map(|lane| field(&rows[lane])));
    ContactRow {
        normal: [lanes(|row| row.normal[0]), lanes(|row| row.normal[1])],
        r1: [lanes(|row| row.r1[0]), lanes(|row| row.r1[1])],
        r2: [lanes(|row| row.r2[0]), lanes(|row| row.r2[1])],
        separation: lanes(|row| row.separation),
        normal_impulse: lanes(|row| row.normal_impulse),
        tangent_impulse: lanes(|row| row.tangent_impulse),
        ..ContactRow::default()
    }
}

/// Sets a lane to zero, so that it applies no impulse.
pub(super) fn clear_lane(row: &mut ContactRow<f32x4>, lane: usize) {
    let ContactRow {
        normal: [normal_x, normal_y],
        r1: [r1_x, r1_y],
        r2: [r2_x, r2_y],
        normal_mass,
        tangent_mass,
        separation,
        target_bias,
        bounce_velocity,
        normal_impulse,
        tangent_impulse,
        bias_impulse,
    } = row;
    let offsets = [normal_x, normal_y, r1_x, r1_y, r2_x, r2_y];
    let numbers = [normal_mass, tangent_mass, separation, target_bias, bounce_velocity];
    let impulses = [normal_impulse, tangent_impulse, bias_impulse];
    for field in offsets.into_iter().chain(numbers).chain(impulses) {
        let mut lanes = field.to_array();
        lanes[lane] = 0.0;
        *field = f32x4::new(lanes);
    }
}
