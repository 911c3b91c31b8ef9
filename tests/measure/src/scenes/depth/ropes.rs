//! Ropes: chains of balls that hang from fixed points.

use super::{DepthObject, DepthScene, Surface};

/// Links of a rope.
pub const LINKS: usize = 20;
/// Length of a link, px.
const LINK: f32 = 10.0;
/// Radius of a ball, px: of a link the part that `rapier3d`'s example of ball joints has.
const RADIUS: f32 = 4.0;
/// Height of the fixed points, px: no rope reaches the ground.
const HEIGHT: f32 = 400.0;
/// Room for one rope along X and along Z, px: ropes do not reach each other.
const ROOM: f32 = 450.0;

/// Ropes of [`LINKS`] links that begin stretched out level, each in another direction, and swing; no rope touches another one.
/// `count` balls move: one rope for each [`LINKS`] of them. The fixed points are the last objects.
pub fn ropes(count: usize) -> DepthScene {
    let mut scene = DepthScene::empty(format!("ropes_{count}"), 240, Surface::default());
    let ropes = count / LINKS;
    let side = (ropes as f32).sqrt().ceil().max(1.0) as usize;
    let hook_of = |rope: usize| [ROOM * (rope % side) as f32, HEIGHT, ROOM * (rope / side) as f32];
    for rope in 0..ropes {
        let [x, y, z] = hook_of(rope);
        // The golden angle: no two of them in one direction.
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
