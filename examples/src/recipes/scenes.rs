//! The scenes of the documentation, with its numbers where it gives some.

use std::f32::consts::FRAC_PI_2;

use twohalf::farseer_core::CollisionCategory;
use twohalf::{Event, Fluid, MoveInput, Vector3, Well};
use twohalf_factories::*;
use twohalf_render::{Patch, Pose};

use super::stage::{AMBER, LANE, RecipeStage};
use super::{Recipe, Step};
use crate::Result;

const STILL: MoveInput = MoveInput { x: 0.0, z: 0.0, jump: false };
const RIGHT: MoveInput = MoveInput { x: 150.0, ..STILL };

macro_rules! recipes {
    ($($name:literal at $middle:literal: $make:ident, $($seconds:literal $caption:literal),*;)*) => {
        pub(super) const ALL: &[Recipe] =
            &[$(Recipe { name: $name, moments: [$(($seconds, $caption)),*], middle: $middle, make: $make }),*];
    };
}

recipes! {
    "a-level-and-a-figure-in-it" at 200.0: level, 0.0 "it stands", 0.7 "it pushes", 1.6 "it stops";
    "slopes-curbs-and-jumps" at 220.0: slope, 0.3 "up", 1.5 "it stands", 1.75 "it jumps";
    "climbing-ledges" at 170.0: ledge, 0.5 "it jumps", 0.7 "it hangs", 1.4 "it is up";
    "a-lift" at 100.0: lift, 0.0 "down", 1.0 "it carries", 2.0 "up";
    "a-belt" at 200.0: belt, 0.0 "it lies there", 1.5 "it is carried", 3.0 "it goes on";
    "a-one-way-platform" at 100.0: one_way, 0.1 "below", 0.3 "through it", 1.2 "on it";
    "a-hole" at 190.0: hole, 0.3 "before it", 0.8 "over it", 1.35 "behind it";
    "a-door" at 200.0: door, 0.0 "closed", 0.9 "it opens", 1.8 "open";
    "a-rope" at 200.0: rope, 0.0 "it hangs", 0.55 "it swings", 1.6 "it tears";
    "water" at 190.0: water, 0.0 "they fall", 0.9 "in it", 4.0 "at rest";
    "wind-and-wells" at 190.0: wind, 0.0 "still", 0.8 "blown", 1.6 "farther";
    "a-blow-hit-box-knock-back-hit-stop" at 150.0: blow, 0.25 "hit-stop", 0.55 "it flies", 1.2 "it lies";
    "who-is-crushed" at 100.0: crush, 0.0 "room", 0.5 "less room", 0.8 "crushed";
    "lifting-and-throwing" at 180.0: throw, 0.1 "lifted", 0.6 "held", 0.95 "thrown";
    "who-meets-whom" at 190.0: categories, 0.3 "two of a kind", 1.0 "they pass", 1.6 "the crate stops";
    "friction-of-both-sides" at 190.0: friction, 0.0 "0, 0.2 and 0.6 on 0.2", 0.4 "as 0.1, 0.2 and 0.4", 1.6 "0.1 goes on longest";
    "time-that-runs-back" at 190.0: rollback, 0.2 "it is kept", 1.1 "it goes on", 1.4 "back, and on";
    "running" at 200.0: running, 0.2 "both start", 0.6 "140 px/s", 1.0 "and 260 px/s";
    "somebody-who-chases-and-a-crowd" at 190.0: crowd, 0.0 "they come", 1.5 "nearer", 5.0 "from all sides";
    "what-is-thrown-strikes" at 170.0: strikes, 0.1 "it flies", 0.36 "it strikes", 0.9 "he lies";
    "a-camera-that-follows" at 150.0: camera, 0.0 "it begins", 1.5 "it follows", 3.0 "on and on";
}

/// Moves an actor by an input.
fn act(stage: &mut RecipeStage, at: usize, wish: MoveInput, dt: f32) -> Result<bool> {
    Ok(stage.actors[at].act(&mut stage.simulator, wish, dt)?)
}

/// A step in which the first actor walks, with an input for each time.
fn walking(wish: impl Fn(f32) -> MoveInput + 'static) -> Result<Step> {
    let mut time = 0.0;
    Ok(Box::new(move |stage, dt| {
        act(stage, 0, wish(time), dt)?;
        stage.simulator.update(dt);
        time += dt;
        Ok(())
    }))
}

/// A step without input.
fn updating() -> Result<Step> {
    Ok(Box::new(|stage, dt| {
        stage.simulator.update(dt);
        Ok(())
    }))
}

fn level(stage: &mut RecipeStage) -> Result<Step> {
    stage.actor([60.0, 0.0, 60.0])?;
    stage.crate_box([150.0, 0.0, 60.0])?;
    stage.ball([60.0, 100.0, 25.0])?;
    stage.block([300.0, 420.0], [0.0, 40.0])?;
    walking(|_| RIGHT)
}

fn slope(stage: &mut RecipeStage) -> Result<Step> {
    spawn_slope(&mut stage.simulator, [100.0, 0.0], [360.0, 95.0], LANE, 20.0)?;
    stage.actor([60.0, 0.0, 50.0])?;
    walking(|time| if time < 1.0 { RIGHT } else { MoveInput { jump: time > 1.5 && time < 1.52, ..STILL } })
}

fn ledge(stage: &mut RecipeStage) -> Result<Step> {
    stage.block([200.0, 400.0], [0.0, 100.0])?;
    stage.actor([100.0, 0.0, 50.0])?;
    stage.actors[0].walker.walk.ledge_reach = 75.0;
    walking(|time| MoveInput { jump: time > 0.3 && time < 0.32, ..RIGHT })
}

fn lift(stage: &mut RecipeStage) -> Result<Step> {
    let lift = stage.block([50.0, 150.0], [0.0, 20.0])?;
    stage.paint(&[lift], AMBER);
    stage.actor([100.0, 20.0, 50.0])?;
    let mut time = 0.0;
    Ok(Box::new(move |stage, dt| {
        let height = 40.0 - 40.0 * (FRAC_PI_2 * time).cos();
        stage.simulator.platform_mut(lift).ok_or("it stays")?.move_to(Vector3::new(100.0, height, 50.0))?;
        act(stage, 0, STILL, dt)?;
        stage.simulator.update(dt);
        time += dt;
        Ok(())
    }))
}

fn belt(stage: &mut RecipeStage) -> Result<Step> {
    let belt = stage.block([20.0, 400.0], [0.0, 20.0])?;
    stage.paint(&[belt], AMBER);
    let mut platform = stage.simulator.platform_mut(belt).ok_or("it is new")?;
    platform.set_surface_speed(60.0, 0.0)?;
    platform.set_friction_coefficient(0.5);
    stage.crate_box([90.0, 20.0, 70.0])?;
    stage.actor([90.0, 20.0, 25.0])?;
    walking(|_| STILL)
}

fn one_way(stage: &mut RecipeStage) -> Result<Step> {
    let shelf = spawn_block(&mut stage.simulator, [20.0, 190.0], [60.0, 70.0], [38.0, LANE[1]])?;
    stage.paint(&[shelf], AMBER);
    stage.simulator.platform_mut(shelf).ok_or("it is new")?.set_one_way(true)?;
    stage.actor([90.0, 0.0, 50.0])?;
    stage.actors[0].walker.walk.jump_height = 90.0;
    walking(|time| MoveInput { jump: time > 0.1 && time < 0.12, ..STILL })
}

fn hole(stage: &mut RecipeStage) -> Result<Step> {
    stage.patches.push(Patch::hole([140.0, 220.0], LANE));
    stage.block([-100.0, 140.0], [0.0, 30.0])?;
    stage.block([220.0, 500.0], [0.0, 30.0])?;
    stage.actor([60.0, 30.0, 50.0])?;
    walking(|time| MoveInput { jump: time > 0.4 && time < 0.42, ..RIGHT })
}

fn door(stage: &mut RecipeStage) -> Result<Step> {
    let hinge = [200.0, 0.0, 95.0];
    let mut door = spawn_door(&mut stage.simulator, hinge, [90.0, 80.0, 8.0], -FRAC_PI_2)?;
    stage.paint(&[door.platform()], AMBER);
    stage.actor([80.0, 0.0, 40.0])?;
    Ok(Box::new(move |stage, dt| {
        door.turn_towards(&mut stage.simulator, 0.0, dt)?;
        act(stage, 0, RIGHT, dt)?;
        stage.simulator.update(dt);
        Ok(())
    }))
}

fn rope(stage: &mut RecipeStage) -> Result<Step> {
    let load = stage.crate_box([200.0, 60.0, 50.0])?;
    let rope = Rope::new(RopeEnd::Fixed([200.0, 230.0, 50.0]), RopeEnd::Body(load.body));
    stage.rope = Some(spawn_rope(&mut stage.simulator, rope.mass(0.2).greatest_force(30_000.0))?);
    let mut time = 0.0;
    Ok(Box::new(move |stage, dt| {
        let mut body = stage.simulator.body_mut(load.body).ok_or("it stays")?;
        if time == 0.0 {
            body.set_velocity3d(Vector3::new(240.0, 0.0, 0.0));
        } else if time > 1.2 {
            body.set_mass(100.0)?;
        }
        stage.simulator.update(dt);
        time += dt;
        Ok(())
    }))
}

fn water(stage: &mut RecipeStage) -> Result<Step> {
    stage.thing(Prism::new([80.0, 18.0, 60.0]).mass(17.0).at([110.0, 90.0, 50.0]), AMBER)?;
    stage.ball([200.0, 110.0, 50.0])?;
    stage.thing(Ball::new(12.0).mass(40.0).at([270.0, 90.0, 50.0]), super::stage::RED)?;
    let pool = RecipeStage::region([40.0, 340.0], [0.0, 60.0])?;
    stage.simulator.add_field(Fluid::water(pool, 4e-4))?;
    updating()
}

fn wind(stage: &mut RecipeStage) -> Result<Step> {
    stage.ball([60.0, 0.0, 70.0])?;
    stage.thing(Ball::new(14.0).mass(60.0).at([60.0, 0.0, 25.0]), super::stage::RED)?;
    let gust = RecipeStage::region([-400.0, 900.0], [0.0, 400.0])?;
    stage.simulator.add_field(Fluid::wind(gust, Vector3::new(260.0, 0.0, 0.0), 2e-4))?;
    stage.simulator.add_field(Well { strength: 4e5, ..Well::new([330.0, 14.0, 25.0]) })?;
    updating()
}

fn blow(stage: &mut RecipeStage) -> Result<Step> {
    let player = stage.actor([90.0, 0.0, 50.0])?;
    stage.actor([130.0, 0.0, 52.0])?;
    stage.actors[1].looks_left = true;
    let mut step = 0;
    Ok(Box::new(move |stage, dt| {
        if step == 20 {
            let blow = Blow { stop: 20, ..Blow::default() };
            player.strike(&mut stage.simulator, &blow, |_| true)?;
            stage.actors[1].stunned = 0.7;
            stage.pose(0, Pose::Strikes);
        } else if step == 60 {
            stage.pose(0, Pose::Walks);
        } else if step == 110 {
            stage.pose(1, Pose::Lies);
        }
        (0..2).try_for_each(|at| act(stage, at, STILL, dt).map(|_| ()))?;
        stage.simulator.update(dt);
        step += 1;
        Ok(())
    }))
}

fn crush(stage: &mut RecipeStage) -> Result<Step> {
    let press = spawn_block(&mut stage.simulator, [50.0, 150.0], [85.0, 125.0], [38.0, LANE[1]])?;
    stage.paint(&[press], AMBER);
    stage.simulator.platform_mut(press).ok_or("it is new")?.set_velocity(Vector3::new(0.0, -45.0, 0.0))?;
    let thug = stage.actor([100.0, 0.0, 50.0])?;
    stage.simulator.set_crush_tolerance(thug.thing.body, Some(8.0))?;
    Ok(Box::new(move |stage, dt| {
        act(stage, 0, STILL, dt)?;
        stage.simulator.update(dt);
        if stage.simulator.events().iter().any(|event| matches!(event, Event::Crushed { .. })) {
            stage.pose(0, Pose::Lies);
            stage.simulator.platform_mut(press).ok_or("it stays")?.set_velocity(Vector3::zeros())?;
        }
        Ok(())
    }))
}

fn throw(stage: &mut RecipeStage) -> Result<Step> {
    let player = stage.actor([90.0, 0.0, 50.0])?;
    let load = stage.crate_box([130.0, 0.0, 50.0])?;
    let mut hands = Hands::default();
    hands.take(&mut stage.simulator, player.thing, load)?;
    stage.pose(0, Pose::Lifts);
    let mut step = 0;
    Ok(Box::new(move |stage, dt| {
        hands.carry(&mut stage.simulator, Vector3::new(0.0, 64.0, 0.0), 480.0, dt)?;
        if step == 90 {
            hands.throw(&mut stage.simulator, Vector3::new(400.0, 100.0, 0.0))?;
            stage.pose(0, Pose::Strikes);
        }
        act(stage, 0, STILL, dt)?;
        stage.simulator.update(dt);
        step += 1;
        Ok(())
    }))
}

fn categories(stage: &mut RecipeStage) -> Result<Step> {
    stage.actor([40.0, 0.0, 60.0])?;
    stage.actor([200.0, 0.0, 60.0])?;
    stage.crate_box([280.0, 0.0, 60.0])?;
    for actor in &stage.actors {
        let geom = stage.simulator.geom_mut(actor.thing.geom).ok_or("it is new")?;
        geom.set_collision_categories(CollisionCategory::CAT2);
        geom.set_collides_with(CollisionCategory::ALL & !CollisionCategory::CAT2);
    }
    let mut time = 0.0;
    Ok(Box::new(move |stage, dt| {
        act(stage, 0, RIGHT, dt)?;
        act(stage, 1, if time < 1.2 { MoveInput { x: -60.0, ..STILL } } else { STILL }, dt)?;
        stage.simulator.update(dt);
        time += dt;
        Ok(())
    }))
}

fn friction(stage: &mut RecipeStage) -> Result<Step> {
    let floor = stage.block([-100.0, 600.0], [0.0, 10.0])?;
    let mut platform = stage.simulator.platform_mut(floor).ok_or("it is new")?;
    platform.set_friction_coefficient(0.2);
    for (friction, z) in [(0.0, 80.0), (0.2, 50.0), (0.6, 20.0)] {
        let thing = Prism::new([30.0, 24.0, 24.0]).friction(friction).at([60.0, 10.0, z]);
        let made = stage.thing(thing, AMBER.darker(0.8 * friction))?;
        let mut body = stage.simulator.body_mut(made.body).ok_or("it is new")?;
        body.set_velocity3d(Vector3::new(200.0, 0.0, 0.0));
    }
    updating()
}

fn rollback(stage: &mut RecipeStage) -> Result<Step> {
    stage.actor([60.0, 0.0, 50.0])?;
    let ball = stage.ball([60.0, 20.0, 20.0])?;
    stage.simulator.body_mut(ball.body).ok_or("it is new")?.set_velocity3d(Vector3::new(170.0, 200.0, 0.0));
    let (mut step, mut kept) = (0, None);
    Ok(Box::new(move |stage, dt| {
        if step == 24 {
            kept = Some((stage.simulator.clone(), stage.actors.clone()));
        } else if step == 133
            && let Some((simulator, actors)) = &kept
        {
            stage.simulator.clone_from(simulator);
            stage.actors.clone_from(actors);
        }
        act(stage, 0, RIGHT, dt)?;
        stage.simulator.update(dt);
        step += 1;
        Ok(())
    }))
}

fn running(stage: &mut RecipeStage) -> Result<Step> {
    stage.actor([60.0, 0.0, 20.0])?;
    stage.actor([60.0, 0.0, 80.0])?;
    Ok(Box::new(|stage, dt| {
        act(stage, 0, MoveInput { x: 140.0, ..STILL }, dt)?;
        act(stage, 1, MoveInput { x: 260.0, ..STILL }, dt)?;
        stage.simulator.update(dt);
        Ok(())
    }))
}

fn crowd(stage: &mut RecipeStage) -> Result<Step> {
    let player = stage.actor([150.0, 0.0, 50.0])?.thing;
    for i in 0..4u8 {
        let thug = stage.actor([260.0 + 22.0 * f32::from(i), 0.0, 15.0 + 17.0 * f32::from(i)])?;
        let geom = stage.simulator.geom_mut(thug.thing.geom).ok_or("it is new")?;
        geom.set_collision_categories(CollisionCategory::CAT2);
        geom.set_collides_with(CollisionCategory::ALL & !CollisionCategory::CAT2);
    }
    Ok(Box::new(move |stage, dt| {
        act(stage, 0, STILL, dt)?;
        for at in 1..stage.actors.len() {
            let own = stage.actors[at].place(&stage.simulator);
            let way = player.place(&stage.simulator) - own;
            let (distance, mut wish) = (way.norm(), Vector3::zeros());
            if distance > 40.0 {
                wish = way * (90.0 / distance);
            }
            for other in stage.actors.iter().filter(|other| other.thing != stage.actors[at].thing) {
                let away = own - other.place(&stage.simulator);
                let distance = away.norm().max(1.0);
                wish += away * (90.0 * (1.0 - distance / 40.0).max(0.0) / distance);
            }
            wish *= (90.0 / wish.norm().max(1.0)).min(1.0);
            act(stage, at, MoveInput { x: wish.x, z: wish.z, jump: false }, dt)?;
            stage.actors[at].looks_left = way.x < 0.0;
        }
        stage.simulator.update(dt);
        Ok(())
    }))
}

fn strikes(stage: &mut RecipeStage) -> Result<Step> {
    stage.actor([60.0, 0.0, 50.0])?;
    let thug = stage.actor([210.0, 0.0, 50.0])?.thing;
    stage.actors[1].looks_left = true;
    let load = stage.crate_box([90.0, 40.0, 50.0])?;
    stage.simulator.body_mut(load.body).ok_or("it is new")?.set_velocity3d(Vector3::new(400.0, 60.0, 0.0));
    stage.pose(0, Pose::Strikes);
    Ok(Box::new(move |stage, dt| {
        (0..2).try_for_each(|at| act(stage, at, STILL, dt).map(|_| ()))?;
        stage.simulator.update(dt);
        let is_struck = |event: &Event| match event {
            Event::Collision(told) => {
                told.this == thug.geom && told.normal.x > 0.5 && told.normal_impulse > 500.0
            }
            _ => false,
        };
        if stage.simulator.events().iter().any(is_struck) {
            stage.actors[1].stunned = 0.3;
            stage.pose(1, Pose::Lies);
        }
        Ok(())
    }))
}

fn camera(stage: &mut RecipeStage) -> Result<Step> {
    stage.actor([60.0, 0.0, 40.0])?;
    for x in [200.0, 420.0, 560.0] {
        stage.block([x, x + 60.0], [0.0, 6.0])?;
        stage.crate_box([x + 120.0, 0.0, 85.0])?;
    }
    Ok(Box::new(|stage, dt| {
        act(stage, 0, RIGHT, dt)?;
        stage.simulator.update(dt);
        let goal = stage.actors[0].place(&stage.simulator).x.max(150.0);
        stage.middle += 0.1 * (goal - stage.middle);
        Ok(())
    }))
}
