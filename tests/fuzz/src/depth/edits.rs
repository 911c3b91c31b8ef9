//! Calls that set properties of bodies and platforms. Bodies are edited through a simulator or the context of a callback.

use farseer_core::{Body, CollisionCategory};
use twohalf::{AccessMut, PlatformMut, TextureId, TwoHalfBody};

use super::place;
use super::pools::Pools;
use crate::plane::BODY_EDITS;
use crate::random::Random;

/// A function that changes a property of a body at random.
type Edit<A> = fn(&mut TwoHalfBody<A>, &Pools, &mut Random);

/// Makes a random edit of a body.
pub(super) fn edit_body<A: AccessMut>(mut body: TwoHalfBody<A>, pools: &Pools, random: &mut Random) {
    let edit = random.pick(&edits::<A>());
    edit(&mut body, pools, random);
}

fn edits<A: AccessMut>() -> [Edit<A>; 34] {
    [
        |body, _, random| body.set_position3d(place(random)),
        |body, _, random| body.set_position3d(place(random)),
        |body, _, random| body.set_position(random.vector(150.0)),
        |body, _, random| body.set_rotation(random.number(-9.0, 9.0)),
        |body, _, random| body.set_linear_velocity(random.vector(300.0)),
        |body, _, random| body.set_linear_velocity_z(random.number(-200.0, 200.0)),
        |body, _, random| body.set_angular_velocity(random.number(-20.0, 20.0)),
        |body, _, random| body.set_is_static(random.chance(20)),
        |body, _, random| body.set_is_kinematic(random.chance(20)),
        |body, _, random| drop(body.move_to3d(place(random))),
        |body, _, random| body.set_enabled(random.chance(90)),
        |body, _, random| body.apply_force(random.vector(1000.0)),
        |body, _, random| body.apply_impulse(random.vector(200.0)),
        |body, _, random| body.set_velocity3d(random.vector3(300.0)),
        |body, _, random| body.apply_force3d(random.vector3(1000.0)),
        |body, _, random| body.apply_impulse3d(random.vector3(200.0)),
        |body, _, random| body.set_angular_velocity3d(random.vector3(20.0)),
        |body, _, random| drop(body.set_mass(random.number(0.1, 20.0))),
        |body, _, random| body.set_ignore_gravity(random.toss()),
        |body, _, random| body.set_linear_drag_coefficient(random.number(0.0, 2.0)),
        |body, _, random| body.set_rotational_drag_coefficient(random.number(0.0, 2.0)),
        |body, _, random| body.set_tag(random.bits()),
        |body, _, random| body.apply_torque(random.number(-500.0, 500.0)),
        |body, _, random| body.apply_angular_impulse(random.number(-100.0, 100.0)),
        |body, _, _| body.clear_force(),
        |body, _, _| body.clear_impulse(),
        |body, _, _| body.clear_torque(),
        |body, _, _| body.reset_dynamics(),
        |body, _, _| body.clear_force_z(),
        |body, _, random| {
            let mut ground = body.ground_mut();
            ground.set_friction_coefficient(random.number(0.0, 2.0));
            ground.set_restitution_coefficient(random.number(0.0, 2.0));
        },
        |body, pools, random| {
            let shadow = TextureId { id: 1, width: 3, height: 4 };
            let geom = random.pick(&pools.geoms);
            drop(body.ground_mut().set_object_geom(geom, random.toss().then_some(shadow)));
        },
        |body, _, _| body.ground_mut().clear_object_geom(),
        |body, _, random| random.pick(BODY_EDITS)(body.core_mut(), random),
        |body, _, _| *body.core_mut() = Body::new(),
    ]
}

/// A function that changes at random how a platform collides.
type EditPlatform = fn(&mut PlatformMut<'_>, &mut Random);

pub(super) const PLATFORM_EDITS: &[EditPlatform] = &[
    |platform, random| platform.set_collision_categories(CollisionCategory::from_bits(random.count(0, 15))),
    |platform, random| platform.set_collides_with(CollisionCategory::from_bits(random.count(0, 15))),
    |platform, random| platform.set_collision_group(random.count(-2, 3)),
    |platform, random| platform.set_friction_coefficient(random.number(0.0, 2.0)),
    |platform, random| platform.set_restitution_coefficient(random.number(0.0, 2.0)),
    |platform, random| platform.set_collision_enabled(random.chance(85)),
    |platform, random| platform.set_collision_response_enabled(random.chance(85)),
    |platform, _| {
        platform.set_collides_with(CollisionCategory::ALL);
        platform.set_collision_categories(CollisionCategory::ALL);
    },
];
