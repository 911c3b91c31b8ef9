//! Footprints of upright geoms as corners.

use twohalf::{DepthProfile, TwoHalfGeom, VirtualGeom};

/// Number of corners of a round footprint.
const ROUND_CORNERS: u32 = 24;

/// X and Z of the corners of an upright geom's footprint, px, clockwise on the screen; `None` for other
/// geoms.
pub(crate) fn footprint_of(geom: &TwoHalfGeom<'_>) -> Option<Vec<[f32; 2]>> {
    let shape = geom.virtual_geom();
    match geom.depth_profile() {
        DepthProfile::Cylinder { .. } | DepthProfile::Capsule { .. } => Some(round(&shape)),
        DepthProfile::Upright { footprint, .. } => {
            let (low, _) = footprint.bounds();
            let place = [shape.left - low.x, shape.front - low.y];
            let corners = footprint.corners().iter().rev();
            Some(corners.map(|corner| [place[0] + corner.x, place[1] + corner.y]).collect())
        }
        DepthProfile::Prism { .. } | DepthProfile::Round { .. } => None,
    }
}

/// X and Z of the corners of the level top of a geom, px.
pub(crate) fn of_top(geom: &TwoHalfGeom<'_>) -> Vec<[f32; 2]> {
    let VirtualGeom { left, right, front, back, .. } = geom.virtual_geom();
    let of_prism = || vec![[left, front], [right, front], [right, back], [left, back]];
    footprint_of(geom).unwrap_or_else(of_prism)
}

/// Corners of the ellipse of a rectangle.
pub(crate) fn round(shape: &VirtualGeom) -> Vec<[f32; 2]> {
    let VirtualGeom { left, right, front, back, .. } = *shape;
    let [middle_x, middle_z] = [0.5 * (left + right), 0.5 * (front + back)];
    let [across, along] = [0.5 * (right - left), 0.5 * (back - front)];
    let corner = |index| {
        let turn = -f64::from(index) / f64::from(ROUND_CORNERS);
        let (sin, cos) = libm::sincos(turn * std::f64::consts::TAU);
        [middle_x + across * cos as f32, middle_z + along * sin as f32]
    };
    (0..ROUND_CORNERS).map(corner).collect()
}
