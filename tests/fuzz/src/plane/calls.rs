//! Table of the calls that a 2D game makes.

use farseer_core::math::Matrix;
use farseer_core::{FrictionType, Methods, NarrowPhaseCollider, PhysicsSimulator, Result};

use super::controllers::{CONTROLLER_EDITS, edit_kind};
use super::create::{BODIES, CONTROLLERS, GEOMS, JOINTS, Make, SPRINGS};
use super::edits::{BODY_EDITS, GEOM_EDITS, JOINT_EDITS, JOINT_KIND_EDITS, SPRING_EDITS, SPRING_KIND_EDITS};
use super::handler::EditingHandler;
use super::paths::{create_chain, edit_path};
use super::queries::random_query;
use super::{Plane, broad_phase, create_thing};
use crate::drives::{edit_drive, lock_axes};
use crate::game::{Call, Outcome};
use crate::random::Random;
use crate::shapes::{outline, step};

/// Number of geoms in the simulator at which the game makes no more.
const MOST_GEOMS: usize = 40;
const MOST_LINKS: usize = 40;
const MOST_CONTROLLERS: usize = 12;
/// Greatest number of iterations per update. More would take too long.
const MOST_ITERATIONS: i32 = 1000;

const fn call(name: &'static str, weight: usize, make: fn(&mut Plane) -> Outcome) -> Call<Plane> {
    Call { name, weight, make }
}

pub(super) const CALLS: &[Call<Plane>] = &[
    call("create a thing", 1, |game| {
        if game.is_crowded() {
            return Outcome::Queried;
        }
        let Ok((body, geom)) = create_thing(&mut game.simulator, &mut game.random) else {
            return Outcome::Changed;
        };
        game.pools.bodies.push(body);
        game.pools.geoms.push(geom);
        Outcome::Changed
    }),
    call("create a body", 1, |game| {
        let crowded = game.is_crowded();
        made(game, crowded, BODIES, |game| &mut game.pools.bodies)
    }),
    call("create a geom", 1, |game| {
        let crowded = game.is_crowded();
        made(game, crowded, GEOMS, |game| &mut game.pools.geoms)
    }),
    call("create pieces", 1, |game| {
        if game.is_crowded() { Outcome::Queried } else { Outcome::of(game.create_pieces()) }
    }),
    call("create a joint", 1, |game| {
        let crowded = game.simulator.joint_list().len() > MOST_LINKS;
        made(game, crowded, JOINTS, |game| &mut game.pools.joints)
    }),
    call("create a spring", 1, |game| {
        let crowded = game.simulator.spring_list().len() > MOST_LINKS;
        made(game, crowded, SPRINGS, |game| &mut game.pools.springs)
    }),
    call("create a controller", 1, create_controller),
    call("create a chain", 1, create_chain),
    call("edit a path", 1, edit_path),
    call("edit a body", 4, |game| {
        let id = game.body();
        let Some(body) = game.simulator.body_mut(id) else { return Outcome::Queried };
        for _ in 0..1 + game.random.below(3) {
            game.random.pick(BODY_EDITS)(body, &mut game.random);
        }
        Outcome::Changed
    }),
    call("edit a geom", 1, |game| {
        let id = game.geom();
        let Some(geom) = game.simulator.geom_mut(id) else { return Outcome::Queried };
        game.random.pick(GEOM_EDITS)(geom, &mut game.random);
        Outcome::Changed
    }),
    call("edit a joint", 1, |game| {
        let id = game.random.pick(&game.pools.joints);
        let Some(joint) = game.simulator.joint_mut(id) else { return Outcome::Queried };
        game.random.pick(JOINT_EDITS)(joint, &mut game.random);
        JOINT_KIND_EDITS.iter().for_each(|edit| drop(edit(&mut game.simulator, id, &mut game.random)));
        Outcome::Changed
    }),
    call("edit a drive", 2, |game| {
        let id = game.random.pick(&game.pools.joints);
        Outcome::of(edit_drive(&mut game.simulator, id, &mut game.random))
    }),
    call("lock axes", 1, |game| {
        let body = game.body();
        Outcome::of(lock_axes(&mut game.simulator, body, &mut game.random))
    }),
    call("edit a spring", 1, |game| {
        let id = game.random.pick(&game.pools.springs);
        let Some(spring) = game.simulator.spring_mut(id) else { return Outcome::Queried };
        game.random.pick(SPRING_EDITS)(spring, &mut game.random);
        SPRING_KIND_EDITS.iter().for_each(|edit| drop(edit(&mut game.simulator, id, &mut game.random)));
        Outcome::Changed
    }),
    call("edit a controller", 1, |game| {
        let id = game.random.pick(&game.pools.controllers);
        let Some(controller) = game.simulator.controller_mut(id) else { return Outcome::Queried };
        game.random.pick(CONTROLLER_EDITS)(controller, &mut game.random);
        edit_kind(&mut game.simulator, id, &game.pools, &mut game.random);
        Outcome::Changed
    }),
    call("move a joint", 1, move_joint),
    call("move a spring", 1, |game| {
        let (spring, body) = (game.random.pick(&game.pools.springs), game.body());
        Outcome::of(if game.random.toss() {
            game.simulator.set_spring_body1(spring, body)
        } else {
            game.simulator.set_spring_body2(spring, body)
        })
    }),
    call("set_body", 1, |game| {
        let (geom, body) = (game.geom(), game.body());
        Outcome::of(game.simulator.set_body(geom, body))
    }),
    call("set_vertices", 1, |game| {
        let (geom, outline) = (game.geom(), outline(&mut game.random));
        Outcome::of(game.simulator.set_vertices(geom, outline))
    }),
    call("set_matrix", 1, |game| {
        let (geom, matrix) = (game.geom(), matrix(&mut game.random));
        Outcome::of(game.simulator.set_matrix(geom, &matrix))
    }),
    call("set_is_sensor", 1, |game| {
        let geom = game.geom();
        Outcome::of(game.simulator.set_is_sensor(geom, game.random.chance(40)))
    }),
    call("set_box_radius", 1, |game| {
        let (geom, radius) = (game.geom(), game.random.number(1.0, 30.0));
        Outcome::of(game.simulator.set_box_radius(geom, game.random.toss().then_some(radius)))
    }),
    call("ignore_collision_with", 1, |game| {
        let (geom, other) = (game.geom(), game.geom());
        Outcome::of(if game.random.toss() {
            game.simulator.ignore_collision_with(geom, other)
        } else {
            game.simulator.restore_collision_with(geom, other)
        })
    }),
    call("add", 1, |game| {
        let object = game.pools.object(&mut game.random);
        Outcome::of(game.simulator.add(object))
    }),
    call("remove", 1, |game| {
        let object = game.pools.object(&mut game.random);
        Outcome::of(game.simulator.remove(object))
    }),
    call("dispose", 1, |game| {
        let object = game.pools.object(&mut game.random);
        if game.random.toss() { Outcome::of(game.simulator.dispose(object)) } else { Outcome::Queried }
    }),
    call("change a setting", 1, |game| {
        Outcome::of(game.random.pick(SETTINGS)(&mut game.simulator, &mut game.random))
    }),
    call("set_broad_phase_collider", 1, |game| {
        let method = broad_phase(&mut game.random);
        Outcome::of(game.simulator.set_broad_phase_collider(method))
    }),
    call("set_methods", 2, |game| {
        let length_unit = game.random.number(0.5, 64.0);
        let precise = Methods::Precise { length_unit };
        let faithful =
            Methods::Faithful { broad: broad_phase(&mut game.random), narrow: NarrowPhaseCollider::Sat };
        Outcome::of(game.simulator.set_methods(game.random.pick(&[precise, faithful])))
    }),
    call("clear", 1, |game| {
        if !game.random.chance(8) {
            return Outcome::Queried;
        }
        game.simulator.clear();
        Outcome::Changed
    }),
    call("ask", 3, |game| {
        random_query(&game.simulator, &game.pools, &mut game.random);
        Outcome::Queried
    }),
    call("pick with the mouse", 1, use_picker),
    call("interpolate", 1, |game| {
        game.interpolation.remember(&game.simulator);
        let (body, fraction) = (game.body(), game.random.number(0.0, 1.0));
        if let Some(pose) = game.interpolation.pose(body, fraction) {
            assert!(pose.position.x.is_finite() && pose.rotation.is_finite(), "{pose:?}");
        }
        Outcome::Queried
    }),
    call("update", 24, |game| {
        let dt = step(&mut game.random);
        if game.random.chance(45) {
            update_meddled(game, dt);
        } else {
            game.simulator.update(dt);
        }
        Outcome::Updated
    }),
];

const SETTINGS: &[fn(&mut PhysicsSimulator, &mut Random) -> Result<()>] = &[
    |simulator, random| simulator.set_gravity(random.vector(200.0)),
    |simulator, random| {
        simulator.set_enabled(random.chance(90));
        Ok(())
    },
    |simulator, random| {
        simulator.set_iterations(random.count(0, 20).min(MOST_ITERATIONS));
        Ok(())
    },
    |simulator, random| simulator.set_bias_factor(random.number(0.0, 1.0)),
    |simulator, random| simulator.set_allowed_penetration(random.number(0.0, 1.0)),
    |simulator, random| {
        simulator.set_max_contacts_to_detect(random.count(0, 20));
        Ok(())
    },
    |simulator, random| simulator.set_max_contacts_to_resolve(random.count(0, 10)),
    |simulator, random| {
        simulator.set_friction_type(random.pick(&[FrictionType::Average, FrictionType::Minimum]));
        Ok(())
    },
    |simulator, random| {
        let either = [NarrowPhaseCollider::Sat, NarrowPhaseCollider::DistanceGrid];
        simulator.set_narrow_phase_collider(random.pick(&either));
        Ok(())
    },
    |simulator, _| {
        simulator.set_enabled(true);
        Ok(())
    },
];

impl Plane {
    pub(super) fn is_crowded(&self) -> bool {
        self.simulator.geoms().count() > MOST_GEOMS
    }
}

/// Makes an object and adds its id to the pool.
fn made<I>(
    game: &mut Plane,
    crowded: bool,
    makers: &[Make<I>],
    pool: fn(&mut Plane) -> &mut Vec<I>,
) -> Outcome {
    if crowded {
        return Outcome::Queried;
    }
    let made = game.random.pick(makers)(game);
    Outcome::of(made.map(|id| pool(game).push(id)))
}

fn create_controller(game: &mut Plane) -> Outcome {
    if game.simulator.controller_list().len() > MOST_CONTROLLERS {
        return Outcome::Queried;
    }
    let Ok(controller) = game.random.pick(CONTROLLERS)(game) else { return Outcome::Failed };
    Outcome::of(game.simulator.create_controller(controller).map(|id| {
        drop(game.simulator.add(id));
        game.pools.controllers.push(id);
    }))
}

fn move_joint(game: &mut Plane) -> Outcome {
    let (joint, body) = (game.random.pick(&game.pools.joints), game.body());
    let (random, simulator) = (&mut game.random, &mut game.simulator);
    Outcome::of(match random.below(6) {
        0 => simulator.set_joint_body1(joint, body),
        1 => simulator.set_joint_body2(joint, body),
        2 => simulator.set_joint_anchor(joint, random.vector(100.0)),
        3 => simulator.set_joint_anchor1(joint, random.vector(20.0)),
        4 => simulator.set_joint_anchor2(joint, random.vector(20.0)),
        _ => simulator.joint_current_anchor(joint).map(drop),
    })
}

fn matrix(random: &mut Random) -> Matrix {
    let mut matrix = Matrix::identity();
    matrix.m11 = random.number(-2.0, 2.0);
    matrix.m22 = random.number(-2.0, 2.0);
    matrix.m12 = random.number(-1.0, 1.0);
    matrix.m41 = random.number(-50.0, 50.0);
    matrix.m42 = random.number(-50.0, 50.0);
    matrix
}

fn use_picker(game: &mut Plane) -> Outcome {
    let point = game.random.vector(100.0);
    match game.random.below(4) {
        0 => drop(game.picker.pick(&mut game.simulator, point)),
        1 => drop(game.picker.drag(&mut game.simulator, point)),
        2 => game.picker.release(&mut game.simulator),
        _ => drop(game.picker.line(&game.simulator)),
    }
    Outcome::Changed
}

fn update_meddled(game: &mut Plane, dt: f32) {
    let random = game.random.split();
    let mut meddler = EditingHandler::new(random, &game.pools, game.simulator.geom_list().len());
    if game.random.toss() {
        game.simulator.update_with(dt, &mut meddler);
    } else {
        let real = step(&mut game.random);
        game.simulator.update_with_real_time(dt, real, Some(&mut meddler));
    }
}
