//! What falls into a pit in disorder and should come to rest.

use super::ChartScene;
use super::build::start;
use super::settled::{Rest, RuinCheck};
use crate::scenes::movable;
use conformance::scene::{BodyShape, GeomShape, Scene};
use conformance::scenes::{circles_in_a_pit, vary};

/// Whatever lies anywhere in a pit lies well. The tallest pit falls together in less than two seconds.
const PIT: Rest = Rest { seconds: 6.0, ruin: lost };
/// Bodies of a pit; the upper side of its floor is at 0.
const LEFT_WALL: usize = 1;
const RIGHT_WALL: usize = 2;

pub(super) fn scenes() -> Vec<ChartScene> {
    let balls = ChartScene {
        name: "ball_pit_penetration",
        about: "Circles fall into a pit; polygons of 12 edges lack up to 0.34 px of the circle on each side.",
        sizes: &[5, 20, 200, 2000],
        build: circles_in_a_pit,
        seconds: PIT.seconds,
        watch: |scene| PIT.penetration(scene),
        error: "largest overlap at the end",
        unit: "px",
        // A tenth of a circle: the pile looks full, and not sunk.
        tolerance: 2.0,
        broad_phases_matter: true,
        peers_too: true,
    };
    let boxes = ChartScene {
        name: "box_pile_penetration",
        about: "Turned boxes fall into a pit.",
        sizes: &[5, 20, 200, 2000],
        build: boxes_in_a_pit,
        ..balls
    };
    let speed = |name, pile: ChartScene| ChartScene {
        name,
        watch: |scene| PIT.mean_speed(scene),
        error: "root of the mean squared speed at the end",
        unit: "px/s",
        // Single circles may still roll; twice what gravity gives in a step of 1/60 s is seen as boiling.
        tolerance: 5.0,
        ..pile
    };
    vec![balls, speed("ball_pit_speed", balls), boxes, speed("box_pile_speed", boxes)]
}

/// The pit with boxes in the place of circles, each with its corners within the circle, turned in all directions.
fn boxes_in_a_pit(count: usize) -> Scene {
    let mut scene = circles_in_a_pit(count);
    scene.name = format!("{count}_boxes_in_a_pit");
    for geom in &mut scene.geoms {
        let body = &mut scene.bodies[geom.body];
        let BodyShape::Circle { radius, mass } = body.shape else { continue };
        // Sides of 4 to 3, as far as the circle goes.
        let (width, height) = (1.6 * radius, 1.2 * radius);
        body.shape = BodyShape::Rectangle { width, height, mass };
        body.rotation = Some(std::f32::consts::FRAC_PI_2 * vary(geom.body, 3));
        geom.shape = GeomShape::Rectangle { width, height };
    }
    scene
}

/// A body whose centre is beside the room between the walls, or below the floor, is lost.
fn lost(scene: &Scene) -> RuinCheck {
    let [left, right] = [(LEFT_WALL, 1.0), (RIGHT_WALL, -1.0)].map(|(wall, side)| {
        let half = match scene.bodies[wall].shape {
            BodyShape::Rectangle { width, .. } => f64::from(width) / 2.0,
            _ => 0.0,
        };
        start(scene, wall)[0] + side * half
    });
    let fallen = movable(scene);
    let is_lost = move |[x, y]: [f64; 2]| x < left || x > right || y > 0.0;
    Box::new(move |world| fallen.iter().any(|&index| is_lost(world.body(index).place())).then_some("lost"))
}
