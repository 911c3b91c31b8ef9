//! A ragdoll of ellipses and pins (behaviour chapter 16, sections B.3 and C.1, demo 9).

use farseer_core::math::Vector2;
use farseer_core::{BodyFactory, BodyId, GeomFactory, GeomPlacement, JointFactory, PinJoint, Result};

use super::{BLACK, SampleScene, WHITE, border, simple};

/// An ellipse: half axes, mass, edges and position.
struct Part {
    radii: [f32; 2],
    mass: f32,
    edges: i32,
    place: Vector2,
}

/// Adds a ragdoll about a point; returns torso and head.
///
/// # Errors
/// A position that is not finite.
pub fn ragdoll(scene: &mut SampleScene, position: Vector2) -> Result<[BodyId; 2]> {
    let from = |place: Vector2, x, y| place + Vector2::new(x, y);
    let torso = Part { radii: [18.0, 34.0], mass: 6.0, edges: 14, place: position };
    let head = Part { radii: [10.0, 14.0], mass: 2.0, edges: 10, place: from(position, 0.0, -50.0) };
    let limb = |length, mass, place| Part { radii: [6.0, length], mass, edges: 8, place };
    let upper_arms = [-26.0, 26.0].map(|x| limb(10.0, 1.0, from(position, x, -17.0)));
    let arms = [0, 1].map(|i: usize| limb(12.0, 1.0, from(upper_arms[i].place, 0.0, 24.0)));
    // The left one is on the right side.
    let thighs = [18.0, -18.0].map(|x| limb(12.0, 2.0, from(position, x, 46.0)));
    let calves = [0, 1].map(|i: usize| limb(12.0, 2.0, from(thighs[i].place, 0.0, 24.0)));

    let torso = ellipse(scene, &torso)?;
    let head = ellipse(scene, &head)?;
    let mut both = |[left, right]: [Part; 2]| Ok([ellipse(scene, &left)?, ellipse(scene, &right)?]);
    let upper_arms = both(upper_arms)?;
    let arms = both(arms)?;
    let thighs = both(thighs)?;
    let calves = both(calves)?;

    let mut pin = |body1, anchor1: (f32, f32), body2, anchor2: (f32, f32), distance: Option<f32>| {
        let simulator = &mut scene.simulator;
        let (anchor1, anchor2) = (Vector2::new(anchor1.0, anchor1.1), Vector2::new(anchor2.0, anchor2.1));
        let joint = JointFactory::create_pin_joint_in(simulator, body1, anchor1, body2, anchor2)?;
        distance
            .map_or(Ok(()), |length| simulator.joint_as_mut::<PinJoint>(joint)?.set_target_distance(length))
    };
    pin(head, (0.0, 14.0), torso, (0.0, -34.0), None)?;
    pin(upper_arms[0], (0.0, -10.0), torso, (-9.0, -25.0), Some(3.0))?;
    pin(upper_arms[1], (0.0, -10.0), torso, (9.0, -25.0), Some(3.0))?;
    for (arm, upper_arm) in arms.into_iter().zip(upper_arms) {
        pin(arm, (0.0, -12.0), upper_arm, (0.0, 10.0), None)?;
    }
    pin(thighs[0], (0.0, -12.0), torso, (9.0, 25.0), Some(3.0))?;
    pin(thighs[1], (0.0, -12.0), torso, (-9.0, 25.0), Some(3.0))?;
    for (calf, thigh) in calves.into_iter().zip(thighs) {
        pin(calf, (0.0, -12.0), thigh, (0.0, 12.0), None)?;
    }
    Ok([torso, head])
}

fn ellipse(scene: &mut SampleScene, part: &Part) -> Result<BodyId> {
    let [x_radius, y_radius] = part.radii;
    let simulator = &mut scene.simulator;
    let body = BodyFactory::create_ellipse_body_in(simulator, x_radius, y_radius, part.mass)?;
    simulator[body].set_position(part.place);
    let placement = GeomPlacement::default();
    let geom =
        GeomFactory::create_ellipse_geom_in(simulator, body, x_radius, y_radius, part.edges, placement)?;
    scene.show(geom, WHITE, BLACK);
    Ok(body)
}

/// Simple 9: a ragdoll falls through obstacles.
pub(super) fn ragdoll_scene() -> Result<SampleScene> {
    let mut scene = SampleScene::new(100.0)?;
    ragdoll(&mut scene, Vector2::new(612.0, 110.0))?;
    simple::obstacles(&mut scene)?;
    border(&mut scene)?;
    Ok(scene)
}
