//! Scenes of ropes: chains of balls that hang from fixed points.

use super::{DepthObject, DepthScene, Surface};

/// Number of movable balls (links) of a rope.
pub const LINKS: usize = 20;
/// Distance between the centres of neighbouring balls of a rope, px.
const LINK: f32 = 10.0;
/// Radius of a ball, px. Its ratio to the length of a link is that of `rapier3d`'s example of ball joints.
const RADIUS: f32 = 4.0;
/// Height of the fixed points above the ground, px: no rope reaches the ground.
const HEIGHT: f32 = 400.0;
/// Width of the square along X and Z that belongs to one rope, px: ropes do not reach each other.
const ROOM: f32 = 450.0;

/// Returns a scene of ropes of [`LINKS`] links that start straight and level, each in another direction, and swing. `count`
/// is the number of movable balls: one rope per [`LINKS`] of them. The fixed points are the last objects.
pub fn ropes(count: usize) -> DepthScene {
    let mut scene = DepthScene::empty(format!("ropes_{count}"), 240, Surface::default());
    let ropes = count / LINKS;
    let side = (ropes as f32).sqrt().ceil().max(1.0) as usize;
    let hook_of = |rope: usize| [ROOM * (rope % side) as f32, HEIGHT, ROOM * (rope / side) as f32];
    for rope in 0..ropes {
        let [x, y, z] = hook_of(rope);
        // Multiples of the golden angle: no two ropes start in the same direction.
        let (sine, cosine) = (2.4 * rope as f32 + 0.5).sin_cos();
        for link in 1..=LINKS {
            let away = LINK * link as f32;
            scene.objects.push(DepthObject::ball(RADIUS, [x + away * cosine, y, z + away * sine]));
        }
    }
    for rope in 0..ropes {
        let hook = scene.objects.len();
        scene.objects.push(DepthObject::ball(RADIUS, hook_of(rope)).fixed());
        scene.ropes.push([hook].into_iter().chain(rope * LINKS..(rope + 1) * LINKS).collect());
    }
    scene
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_rope_has_its_links_and_a_fixed_point() {
        let scene = ropes(200);
        assert_eq!((scene.objects.len(), scene.ropes.len()), (210, 10));
        for rope in &scene.ropes {
            assert_eq!(rope.len(), LINKS + 1);
            assert!(scene.objects[rope[0]].is_static);
            assert!(rope[1..].iter().all(|&ball| !scene.objects[ball].is_static));
        }
    }
}
