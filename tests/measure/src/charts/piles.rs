//! Charts of bodies that fall into a pit in disorder and should come to rest.

use super::ChartScene;
use super::build::start;
use super::settled::{Rest, RuinCheck};
use crate::scenes::movable;
use conformance::scene::{BodyShape, GeomShape, Scene};
use conformance::scenes::{circles_in_a_pit, vary};

/// Runs of piles in a pit (a floor between two walls) last 6 s and fail if a body leaves the pit. Every position inside of the pit
/// is accepted. 6 s are enough: the tallest pile collapses in less than 2 s.
const PIT: Rest = Rest { seconds: 6.0, ruin: lost };
/// Index of the left wall among the bodies of a pit. The upper side of the pit's floor is at y = 0.
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
        // 2 px is a tenth of a circle's diameter: the pile looks full, and not sunk.
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
        // Single circles may still roll. Twice the velocity that gravity adds in a step of 1/60 s looks like boiling.
        tolerance: 5.0,
        ..pile
    };
    vec![balls, speed("ball_pit_speed", balls), boxes, speed("box_pile_speed", boxes)]
}

/// Returns the pit with boxes instead of circles. The corners of each box lie within the circle it replaces; boxes are turned
/// in all directions.
fn boxes_in_a_pit(count: usize) -> Scene {
    let mut scene = circles_in_a_pit(count);
    scene.name = format!("{count}_boxes_in_a_pit");
    for geom in &mut scene.geoms {
        let body = &mut scene.bodies[geom.body];
        let BodyShape::Circle { radius, mass } = body.shape else { continue };
        // Sides in the ratio 4 to 3, inscribed in the circle.
        let (width, height) = (1.6 * radius, 1.2 * radius);
        body.shape = BodyShape::Rectangle { width, height, mass };
        body.rotation = Some(std::f32::consts::FRAC_PI_2 * vary(geom.body, 3));
        geom.shape = GeomShape::Rectangle { width, height };
    }
    scene
}

/// Returns the condition of failure of a pit: the centre of a body is outside of the walls or below the floor.
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
    Box::new(move |world| {
        fallen.iter().any(|&index| is_lost(world.body(index).position_in_plane())).then_some("lost")
    })
}
