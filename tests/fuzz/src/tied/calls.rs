//! Table of the calls of a game with joints, springs, ropes and fields.

use farseer_core::{BodyId, FixedLinearSpring, Objects, PinJoint};
use twohalf::{Field, Fluid, Region, Well};
use twohalf_factories::{Rope, RopeEnd, spawn_rope};

use super::Tied;
use super::links::{JOINTS, Make, SPRINGS};
use crate::depth::Depth;
use crate::drives::{create_driven_joint, edit_drive, lock_axes};
use crate::game::{Call, Game, Outcome, draw};
use crate::plane::{JOINT_EDITS, SPRING_EDITS};
use crate::random::Random;

/// Number of joints and springs in the simulator at which the game makes no more.
const MOST_LINKS: usize = 40;
const MOST_FIELDS: usize = 6;

const fn call(name: &'static str, weight: usize, make: fn(&mut Tied) -> Outcome) -> Call<Tied> {
    Call { name, weight, make }
}

pub(super) const CALLS: &[Call<Tied>] = &[
    call("create a thing", 1, |game| (Depth::calls()[0].make)(&mut game.depth)),
    call("play as without", 30, |game| {
        let call = draw::<Depth>(game.depth.random());
        (call.make)(&mut game.depth)
    }),
    call("create a joint", 4, |game| {
        made(game, JOINTS, |objects, joint| objects.add(joint), |game| &mut game.joints)
    }),
    call("create a joint with a drive", 3, |game| {
        made(game, &[create_driven_joint], |objects, joint| objects.add(joint), |game| &mut game.joints)
    }),
    call("create a spring", 2, |game| {
        made(game, SPRINGS, |objects, spring| objects.add(spring), |game| &mut game.springs)
    }),
    call("create a rope", 1, create_rope),
    call("edit a joint", 2, |game| {
        let Some(joint) = pick(&game.joints, game.depth.random()) else { return Outcome::Queried };
        let (simulator, random) = game.depth.parts();
        simulator.edit_objects(|objects| {
            let Some(edited) = objects.joint_mut(joint) else { return Outcome::Queried };
            random.pick(JOINT_EDITS)(edited, random);
            if let Ok(pin) = objects.joint_as_mut::<PinJoint>(joint) {
                pin.set_target_distance(random.number(0.0, 60.0)).ok();
            }
            Outcome::Changed
        })
    }),
    call("edit a drive", 3, |game| {
        let Some(joint) = pick(&game.joints, game.depth.random()) else { return Outcome::Queried };
        let (simulator, random) = game.depth.parts();
        simulator.edit_objects(|objects| drop(edit_drive(objects, joint, random)));
        Outcome::Changed
    }),
    call("lock axes", 1, |game| {
        let body = game.depth.body();
        let (simulator, random) = game.depth.parts();
        Outcome::of(simulator.edit_objects(|objects| lock_axes(objects, body, random)))
    }),
    call("edit a spring", 1, |game| {
        let Some(spring) = pick(&game.springs, game.depth.random()) else { return Outcome::Queried };
        let (simulator, random) = game.depth.parts();
        simulator.edit_objects(|objects| {
            let Some(edited) = objects.spring_mut(spring) else { return Outcome::Queried };
            random.pick(SPRING_EDITS)(edited, random);
            if let Ok(fixed) = objects.spring_as_mut::<FixedLinearSpring>(spring) {
                let depth = random.toss().then(|| random.number(-50.0, 150.0));
                fixed.set_world_attach_depth(depth).ok();
            }
            Outcome::Changed
        })
    }),
    call("take_length", 1, |game| {
        let random = game.depth.random();
        let (joint, spring) = (pick(&game.joints, random), pick(&game.springs, random));
        match (joint, spring, random.toss()) {
            (Some(joint), _, true) => Outcome::of(game.depth.simulator_mut().take_length(joint)),
            (_, Some(spring), _) => Outcome::of(game.depth.simulator_mut().take_length(spring)),
            _ => Outcome::Queried,
        }
    }),
    call("remove a link, or dispose it", 2, |game| {
        let random = game.depth.random();
        let (joint, spring) = (pick(&game.joints, random), pick(&game.springs, random));
        let (may_dispose, takes_joint) = (random.toss(), random.toss());
        let simulator = game.depth.simulator_mut();
        match (joint, spring) {
            (Some(joint), _) if takes_joint && may_dispose => Outcome::of(simulator.dispose(joint)),
            (Some(joint), _) if takes_joint => Outcome::of(simulator.remove(joint)),
            (_, Some(spring)) if may_dispose => Outcome::of(simulator.dispose(spring)),
            (_, Some(spring)) => Outcome::of(simulator.remove(spring)),
            _ => Outcome::Queried,
        }
    }),
    call("add a field", 1, |game| {
        if game.fields.len() > MOST_FIELDS {
            return Outcome::Queried;
        }
        let Some(field) = field(game.depth.random()) else { return Outcome::Queried };
        let made = game.depth.simulator_mut().add_field(field);
        Outcome::of(made.map(|id| game.fields.push(id)))
    }),
    call("set_field", 1, |game| {
        let random = game.depth.random();
        let (Some(id), Some(field)) = (pick(&game.fields, random), field(random)) else {
            return Outcome::Queried;
        };
        Outcome::of(game.depth.simulator_mut().set_field(id, field))
    }),
    call("remove_field", 1, |game| {
        let Some(id) = pick(&game.fields, game.depth.random()) else { return Outcome::Queried };
        Outcome::of(game.depth.simulator_mut().remove_field(id))
    }),
    call("ask how deep", 1, |game| {
        let (Some(id), body) = (pick(&game.fields, game.depth.random()), game.depth.body()) else {
            return Outcome::Queried;
        };
        if let Ok(part) = game.depth.simulator().immersion(id, body) {
            // If an outline crosses itself, parts of it may count twice.
            assert!(part.is_finite() && part >= 0.0, "{part} of it are in");
        }
        Outcome::Queried
    }),
    call("update", 16, |game| {
        let dt = game.depth.random().pick(&[0.01, 1.0 / 60.0]);
        game.depth.simulator_mut().update(dt);
        Outcome::Updated
    }),
];

fn pick<T: Copy>(pool: &[T], random: &mut Random) -> Option<T> {
    (!pool.is_empty()).then(|| random.pick(pool))
}

/// Makes a joint or spring between two bodies, adds it to the simulator, and adds its id to the pool.
fn made<I: Copy>(
    game: &mut Tied,
    makers: &[Make<I>],
    add: fn(&mut Objects, I) -> Result<(), farseer_core::Error>,
    pool: fn(&mut Tied) -> &mut Vec<I>,
) -> Outcome {
    let core = game.depth.simulator().core();
    if core.joint_list().len() + core.spring_list().len() > MOST_LINKS {
        return Outcome::Queried;
    }
    let bodies: [BodyId; 2] = [game.depth.body(), game.depth.body()];
    let (simulator, random) = game.depth.parts();
    let made = simulator.edit_objects(|objects| {
        let made = random.pick(makers)(objects, bodies, random)?;
        // The joint or spring exists even if the simulator refuses to add it, because one of its bodies will be removed.
        drop(add(objects, made));
        Ok::<_, farseer_core::Error>(made)
    });
    Outcome::of(made.map(|id| pool(game).push(id)))
}

fn create_rope(game: &mut Tied) -> Outcome {
    if game.depth.simulator().core().joint_list().len() > MOST_LINKS {
        return Outcome::Queried;
    }
    let body = game.depth.body();
    let random = game.depth.random();
    let point = |random: &mut Random| [0; 3].map(|_| random.number(0.0, 150.0));
    let ends = [0; 2].map(|_| match random.below(3) {
        0 => RopeEnd::Body(body),
        1 => RopeEnd::Fixed(point(random)),
        _ => RopeEnd::Free(point(random)),
    });
    let rope = Rope::new(ends[0], ends[1]).parts(1 + random.below(8)).mass(random.number(0.1, 5.0));
    let rope = rope.length(random.number(10.0, 200.0)).greatest_force(random.number(100.0, 1e6));
    // If the call is refused, the objects that it has made before are disposed with the next update.
    if let Ok(rope) = spawn_rope(game.depth.simulator_mut(), rope) {
        game.joints.extend(rope.joints);
    }
    Outcome::Changed
}

fn field(random: &mut Random) -> Option<Field> {
    let numbers = [0; 3].map(|_| random.number(-150.0, 100.0));
    let region = match random.below(4) {
        0 => Region::EVERYWHERE,
        _ => Region::new(numbers, [150.0, random.number(10.0, 150.0), 150.0]).ok()?,
    };
    let flow = random.vector3(50.0);
    Some(match random.below(3) {
        0 => Fluid { flow, ..Fluid::water(region, random.number(0.0, 0.01)) }.into(),
        1 => Fluid::wind(region, flow, random.number(0.0, 0.01)).into(),
        _ => {
            let (strength, softness) = (random.number(-1e6, 1e6), random.number(1.0, 20.0));
            Well { strength, softness, ..Well::new(numbers) }.into()
        }
    })
}
