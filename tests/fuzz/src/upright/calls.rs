//! Table of the calls of a game with vertical shapes and hinged platforms.

use std::hint::black_box;

use farseer_core::math::{Vector2, scalar};
use twohalf::{DepthProfile, Footprint, PlatformId, Swing, Vector3};

use super::Upright;
use crate::depth::Depth;
use crate::game::{Call, Game, Outcome, draw};
use crate::random::Random;

const fn call(name: &'static str, weight: usize, make: fn(&mut Upright) -> Outcome) -> Call<Upright> {
    Call { name, weight, make }
}

pub(super) const CALLS: &[Call<Upright>] = &[
    call("create a thing", 2, |game| {
        let made = (Depth::calls()[0].make)(&mut game.depth);
        if made == Outcome::Changed && game.depth.random().chance(70) {
            stand_up_last(game);
        }
        made
    }),
    call("play as without", 30, |game| {
        let call = draw::<Depth>(game.depth.random());
        (call.make)(&mut game.depth)
    }),
    call("set_depth_profile", 4, |game| {
        let geom = game.depth.geom();
        let Some(profile) = profile(game.depth.random()) else { return Outcome::Queried };
        Outcome::of(game.depth.simulator_mut().set_depth_profile(geom, profile))
    }),
    call("slope or turn a platform", 4, |game| {
        let Some(id) = platform(game) else { return Outcome::Queried };
        let (simulator, random) = game.depth.parts();
        let Some(mut platform) = simulator.platform_mut(id) else { return Outcome::Queried };
        Outcome::of(match random.below(8) {
            0 => platform.set_pitch(random.number(-1.5, 1.5)),
            1 => platform.set_yaw(random.number(-4.0, 4.0)),
            2 => platform.set_angular_velocity(random.number(-3.0, 3.0)),
            3 => platform.turn_to(random.number(-4.0, 4.0)),
            4 | 5 => platform.set_swing(swing(platform.position3d(), random)),
            6 => platform.clear_swing(),
            _ => platform.set_rotation(0.0),
        })
    }),
    call("ask what is there", 2, |game| {
        let (geom, random) = (game.depth.geom(), game.depth.random());
        let ends = [random.vector3(200.0), random.vector3(200.0)];
        let simulator = game.depth.simulator();
        black_box(simulator.overlaps_of(geom, |_| true));
        if let Some(hit) = simulator.ray_cast3d(ends[0], ends[1], |_| true) {
            assert!(hit.point.iter().chain(hit.normal.iter()).all(|number| number.is_finite()), "{hit:?}");
        }
        let high = ends[0] + Vector3::new(10.0, 30.0, 8.0);
        if let Some(hit) = simulator.sweep_box(ends[0], high, ends[1], |_| true) {
            assert!(hit.normal.iter().all(|number| number.is_finite()), "{hit:?}");
            assert!((0.0..=1.0).contains(&hit.fraction), "{hit:?}");
        }
        Outcome::Queried
    }),
    call("update", 16, |game| {
        let dt = game.depth.random().pick(&[0.01, 1.0 / 60.0]);
        game.depth.simulator_mut().update(dt);
        Outcome::Updated
    }),
];

fn platform(game: &mut Upright) -> Option<PlatformId> {
    let all: Vec<PlatformId> = game.depth.simulator().platforms().collect();
    (!all.is_empty()).then(|| game.depth.random().pick(&all))
}

/// Returns a random rotation of a platform about a hinge, which lies beside the middle of the platform.
pub(crate) fn swing(middle: Vector3, random: &mut Random) -> Swing {
    let inertia = random.pick(&[1.0, 300.0, 1e4, 1e7]);
    let frequency = random.pick(&[0.0, 0.3, 6.0, 400.0]);
    Swing {
        hinge: [middle.x + random.number(-40.0, 40.0), middle.z + random.number(-10.0, 10.0)],
        moment_of_inertia: inertia,
        stiffness: inertia * frequency * frequency,
        damping: inertia * random.pick(&[0.0, 0.5, 20.0]),
        rest_angle: random.number(-2.0, 2.0),
        least_angle: random.pick(&[-7.0, -3.0, -0.5, 0.0]),
        greatest_angle: random.pick(&[0.0, 0.5, 3.0, 7.0]),
    }
}

/// Makes the body that was created last upright: gives it a vertical shape.
fn stand_up_last(game: &mut Upright) {
    let last = game.depth.simulator().core().geoms().last();
    let Some((geom, profile)) = last.zip(profile(game.depth.random())) else { return };
    game.depth.simulator_mut().set_depth_profile(geom, profile).ok();
}

fn profile(random: &mut Random) -> Option<DepthProfile> {
    let (radius, height) = (random.number(3.0, 20.0), random.number(5.0, 60.0));
    match random.below(3) {
        0 => Some(DepthProfile::Cylinder { radius, height }),
        1 => Some(DepthProfile::Capsule { radius, height }),
        _ => {
            let corners = 3 + random.below(6);
            let turn = random.number(0.0, 6.0);
            let corner = |at: usize| {
                let (sin, cos) = scalar::sin_cos(turn + std::f32::consts::TAU * at as f32 / corners as f32);
                Vector2::new(radius * cos, radius * sin)
            };
            let corners: Vec<Vector2> = (0..corners).map(corner).collect();
            Footprint::new(&corners).ok().map(|footprint| DepthProfile::Upright { footprint, height })
        }
    }
}
