//! Blots cut into convex pieces (behaviour chapter 16, section C.2, demo 9).

use farseer_core::math::Vector2;
use farseer_core::{BodyFactory, GeomFactory, Result};

use super::{BLACK, Rgba, SampleScene, border, splat_outline};

/// Colours of neighbouring pieces.
const REDS: [Rgba; 3] = [[214, 64, 72, 255], [186, 44, 58, 255], [232, 100, 96, 255]];

/// Advanced 9: six blots of 21 convex pieces each fall on the floor, with separating axes.
pub(super) fn auto_divide_geometry_with_sat() -> Result<SampleScene> {
    let mut scene = SampleScene::with_sat(100.0)?;
    for (x, y) in
        [(200.0, 200.0), (500.0, 200.0), (800.0, 200.0), (200.0, 450.0), (500.0, 450.0), (800.0, 450.0)]
    {
        let simulator = &mut scene.simulator;
        let outline = splat_outline();
        let body = BodyFactory::create_polygon_body_in(simulator, &outline, 1.0)?;
        simulator[body].set_position(Vector2::new(x, y));
        let pieces = GeomFactory::create_sat_polygon_geom_in(simulator, body, &outline, 25)?;
        for (piece, &color) in pieces.into_iter().zip(REDS.iter().cycle()) {
            scene.show(piece, color, BLACK);
        }
    }
    border(&mut scene)?;
    Ok(scene)
}
