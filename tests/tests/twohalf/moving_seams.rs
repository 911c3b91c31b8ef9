//! A seam onto a moving or dynamic body stops sliding bodies no more than one between two platforms.

use conformance::fixtures::depth::{place, velocity};
use twohalf::{BodyId, Footprint, Platform, TwoHalfPhysicsSimulator, Vector2, Vector3};
use twohalf_factories::{Ball, Capsule, Cylinder, Prism, Thing, spawn};

/// px/s².
const GRAVITY: f32 = 900.0;
/// Height of floors, px.
const TOP: f32 = 40.0;
/// px/s.
const SPEEDS: [f32; 5] = [20.0, 60.0, 150.0, 300.0, 600.0];

/// Material of a floor.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Floor {
    Ground,
    Platform,
    MovingPlatform,
    Static,
    Kinematic,
    MovingBody,
    Crate,
}

use Floor::{Crate, Ground, Kinematic, MovingBody, MovingPlatform, Static};

/// Two that are flush, one after the other.
const FLUSH: [[Floor; 2]; 13] = [
    [Floor::Platform, Kinematic],
    [Kinematic, Kinematic],
    [Kinematic, Floor::Platform],
    [Static, Kinematic],
    [Kinematic, Static],
    [Floor::Platform, Crate],
    [Crate, Crate],
    [Crate, Kinematic],
    [MovingBody, MovingBody],
    [MovingPlatform, MovingBody],
    [MovingBody, MovingPlatform],
    [MovingPlatform, MovingPlatform],
    [Ground, Kinematic],
];

#[derive(Debug, Clone, Copy)]
struct Scene {
    floors: [Floor; 2],
    along_z: bool,
    rate: f32,
    /// How much higher the second floor is, px.
    step: f32,
    /// Velocity of the moving floors, px/s.
    drift: Vector3,
}

impl Scene {
    fn along(&self, along: f32, y: f32) -> [f32; 3] {
        if self.along_z { [0.0, y, along] } else { [along, y, 0.0] }
    }

    fn way(&self) -> Vector3 {
        Vector3::from(self.along(1.0, 0.0))
    }

    fn top(&self) -> f32 {
        if self.floors.contains(&Ground) { 0.0 } else { TOP }
    }

    fn lay(&self, simulator: &mut TwoHalfPhysicsSimulator, floor: Floor, [from, to]: [f32; 2], top: f32) {
        let (length, thick) = (to - from, if floor == Crate { top } else { TOP });
        let size = if self.along_z { [400.0, thick, length] } else { [length, thick, 400.0] };
        let at = self.along(0.5 * (from + to), top - thick);
        match floor {
            Ground => {}
            Floor::Platform | MovingPlatform => {
                let [width, height, depth] = size;
                let made = Platform::new(simulator, width, height, depth, at.into(), None).unwrap();
                let mut view = simulator.platform_mut(made).unwrap();
                view.set_friction_coefficient(0.0);
                if floor == MovingPlatform {
                    view.set_velocity(self.drift).unwrap();
                }
            }
            Static | Kinematic | MovingBody | Crate => {
                let made = spawn(simulator, Prism::new(size).mass(50.0).at(at)).unwrap();
                simulator.geom_mut(made.geom).unwrap().set_friction_coefficient(0.0);
                let mut view = simulator.body_mut(made.body).unwrap();
                view.set_is_static(floor == Static);
                view.set_is_kinematic(matches!(floor, Kinematic | MovingBody));
                if floor == MovingBody {
                    view.set_velocity3d(self.drift);
                }
            }
        }
    }

    /// Slides a body over the seam: its least speed relative to the floors, from the start on.
    fn least_speed(&self, thing: Thing, speed: f32, phase: f32) -> f32 {
        let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, GRAVITY)).unwrap();
        let top = self.top();
        self.lay(&mut simulator, self.floors[0], [-800.0, 0.0], top);
        self.lay(&mut simulator, self.floors[1], [0.0, 800.0], top + self.step);
        let start = -20.0 - (0.3 + phase / self.rate) * speed;
        let body = put(&mut simulator, thing, self.along(start, top));
        simulator.body_mut(body).unwrap().set_velocity3d(self.drift);
        (0..(0.3 * self.rate) as usize).for_each(|_| simulator.update(1.0 / self.rate));
        let up = velocity(&simulator, body).y;
        let mut going = self.drift + self.way() * speed;
        going.y = up;
        simulator.body_mut(body).unwrap().set_velocity3d(going);
        // Until its back is over the seam.
        let steps = (0.4 + 60.0 / speed) * self.rate;
        let speeds = (0..steps as usize).map(|_| {
            simulator.update(1.0 / self.rate);
            (velocity(&simulator, body) - self.drift).dot(&self.way())
        });
        speeds.fold(speed, f32::min)
    }
}

fn put(simulator: &mut TwoHalfPhysicsSimulator, thing: Thing, at: [f32; 3]) -> BodyId {
    let body = spawn(simulator, thing.friction(0.0).at(at)).unwrap().body;
    simulator.body_mut(body).unwrap().core_mut().set_linear_drag_coefficient(0.0);
    body
}

fn scenes(floors: [Floor; 2]) -> impl Iterator<Item = Scene> {
    let moves = floors.iter().any(|floor| matches!(floor, MovingBody | MovingPlatform));
    let drift = if moves { Vector3::new(20.0, 10.0, 15.0) } else { Vector3::zeros() };
    [false, true].into_iter().flat_map(move |along_z| {
        [30.0, 60.0, 120.0].map(|rate| Scene { floors, along_z, rate, step: 0.0, drift })
    })
}

fn flat_things() -> [Thing; 4] {
    let square = [[-10.0, -10.0], [10.0, -10.0], [10.0, 10.0], [-10.0, 10.0]].map(Vector2::from);
    [
        Prism::new([20.0; 3]).upright(),
        Prism::new([30.0, 20.0, 20.0]),
        Cylinder::new(10.0, 20.0),
        Prism::footprint(Footprint::new(&square).unwrap(), 20.0),
    ]
}

#[test]
fn flat_bodies_slide_over_seams_onto_moving_platforms_without_losing_speed() {
    for (scene, speed) in
        FLUSH.into_iter().flat_map(scenes).flat_map(|scene| SPEEDS.map(|speed| (scene, speed)))
    {
        for thing in flat_things() {
            let least = scene.least_speed(thing, speed, 0.3);
            assert!(least > 0.99 * speed, "{scene:?} {thing:?} {speed}: {least}");
        }
    }
}

#[test]
fn round_bodies_cross_flush_seams_without_losing_speed() {
    let still = [[Floor::Platform; 2], [Static, Static], [Floor::Platform, Static]];
    let floors = FLUSH.into_iter().chain(still);
    for (scene, speed) in floors.flat_map(scenes).flat_map(|scene| SPEEDS.map(|speed| (scene, speed))) {
        for thing in [Ball::new(10.0), Ball::new(4.0), Capsule::new(8.0, 30.0)] {
            let least = scene.least_speed(thing, speed, 0.3);
            assert!(least > 0.999 * speed, "{scene:?} {thing:?} {speed}: {least}");
        }
    }
}

/// A rise by 0.5 px takes 30 px/s of a sliding body.
#[test]
fn a_step_of_half_a_pixel_turns_back_a_ball_that_is_too_slow_for_it() {
    for floors in [[Floor::Platform; 2], [Static, Kinematic], [Kinematic, Kinematic]] {
        for scene in scenes(floors) {
            for thing in [Ball::new(10.0), Capsule::new(8.0, 30.0)] {
                let scene = Scene { step: 0.5, ..scene };
                let least = scene.least_speed(thing, 20.0, 0.3);
                assert!(least < 10.0, "{scene:?} {thing:?}: {least}");
            }
        }
    }
}

#[test]
fn a_step_of_half_a_pixel_or_more_of_a_moving_platform_stops_flat_bodies() {
    let floors = FLUSH.into_iter().filter(|floors| floors[1] != Crate);
    for (scene, step) in floors.flat_map(scenes).flat_map(|scene| [0.5, 2.0, 30.0].map(|step| (scene, step)))
    {
        for (thing, speed) in
            flat_things().into_iter().flat_map(|thing| [20.0, 150.0].map(|speed| (thing, speed)))
        {
            // A box that may topple does so over a low step.
            if thing == Prism::new([30.0, 20.0, 20.0]) {
                continue;
            }
            let scene = Scene { step, ..scene };
            let least = scene.least_speed(thing, speed, 0.3);
            assert!(least < 1.0 + 0.05 * speed, "{scene:?} {thing:?} {speed}: {least}");
        }
    }
}

/// A row of crates of 40 px on the ground, and a body that slides over them.
fn slides_over_crates(along_z: bool, rate: f32, mass: f32, thing: Thing, speed: f32) -> f32 {
    let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, GRAVITY)).unwrap();
    let along = |along: f32, y: f32| if along_z { [0.0, y, along] } else { [along, y, 0.0] };
    for at in 0..8 {
        let thing = Prism::new([40.0; 3]).mass(mass).friction(0.5).at(along(40.0 * at as f32, 0.0));
        let made = spawn(&mut simulator, thing).unwrap();
        simulator.geom_mut(made.geom).unwrap().set_friction_coefficient(0.0);
    }
    let body = put(&mut simulator, thing, along(0.0, TOP));
    (0..(0.5 * rate) as usize).for_each(|_| simulator.update(1.0 / rate));
    simulator.body_mut(body).unwrap().set_velocity3d(Vector3::from(along(speed, 0.0)));
    (0..(240.0 / speed * rate) as usize).for_each(|_| simulator.update(1.0 / rate));
    let (at, now) = (place(&simulator, body), velocity(&simulator, body));
    assert!(at.y > TOP - 1.0, "{at:?}");
    if along_z { now.z } else { now.x }
}

#[test]
fn flat_bodies_slide_over_rows_of_crates_of_any_mass() {
    for (along_z, rate) in [false, true].into_iter().flat_map(|z| [30.0, 60.0, 120.0].map(|rate| (z, rate))) {
        for (mass, speed) in
            [1.0, 50.0].into_iter().flat_map(|mass| [60.0, 150.0, 300.0].map(|it| (mass, it)))
        {
            for thing in [Prism::new([20.0; 3]).upright(), Cylinder::new(10.0, 20.0)] {
                let now = slides_over_crates(along_z, rate, mass, thing, speed);
                assert!(now > 0.97 * speed, "{along_z} {rate} {mass} {thing:?}: {now} of {speed}");
            }
        }
    }
}

#[test]
fn bodies_of_any_mass_cross_rows_of_crates_at_their_speed() {
    for (along_z, rate) in [false, true].into_iter().flat_map(|z| [30.0, 60.0, 120.0].map(|rate| (z, rate))) {
        for (ratio, speed) in
            [0.1, 1.0, 3.0].into_iter().flat_map(|ratio| [20.0, 60.0, 150.0].map(|it| (ratio, it)))
        {
            for thing in [
                Prism::new([20.0; 3]).upright(),
                Prism::new([20.0, 40.0, 20.0]),
                Cylinder::new(10.0, 20.0),
                Ball::new(10.0),
            ] {
                let now = slides_over_crates(along_z, rate, 10.0, thing.mass(10.0 * ratio), speed);
                assert!(now > 0.97 * speed, "{along_z} {rate} {ratio} {thing:?}: {now} of {speed}");
            }
        }
    }
}
