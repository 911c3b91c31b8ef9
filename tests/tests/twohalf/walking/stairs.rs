//! Stairs whose steps are as high as [`CharacterSettings::step_up`] and [`CharacterSettings::snap`], or a little lower or
//! higher.

use super::*;
use conformance::fixtures::depth::fix;

/// Steps of a flight of stairs.
const STEPS: usize = 6;

/// Material of stairs.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Made {
    Platforms,
    Bodies,
    /// All of them with the floor, at 20 px/s.
    RisingBodies,
}

#[derive(Debug, Clone, Copy)]
struct Stairs {
    made: Made,
    along_z: bool,
    is_down: bool,
    height: f32,
    tread: f32,
}

impl Stairs {
    fn along(&self, along: f32, y: f32) -> [f32; 3] {
        if self.along_z { [0.0, y, along] } else { [along, y, 0.0] }
    }

    fn block(&self, stage: &mut Stage, [from, to]: [f32; 2], [low, high]: [f32; 2]) {
        let length = to - from;
        let size = if self.along_z { [300.0, high - low, length] } else { [length, high - low, 300.0] };
        let at = self.along(0.5 * (from + to), low);
        if self.made == Made::Platforms {
            stage.platform(size, at, 0.0);
            return;
        }
        let body = stage.crate_box(size, 100.0, at);
        if self.made == Made::Bodies {
            fix(&mut stage.simulator, body);
        } else {
            let mut view = stage.simulator.body_mut(body).unwrap();
            view.set_is_kinematic(true);
            view.set_velocity3d(Vector3::new(0.0, 20.0, 0.0));
        }
    }

    /// Stairs that begin at 100 px, on a floor 200 px up.
    fn build(&self, stage: &mut Stage) {
        let end = 100.0 + self.tread * STEPS as f32;
        self.block(stage, [-800.0, end + 800.0], [100.0, 200.0]);
        for step in 0..STEPS {
            let edge = 100.0 + self.tread * step as f32;
            let (ends, count) =
                if self.is_down { ([-700.0, edge], STEPS - step) } else { ([edge, end + 700.0], step + 1) };
            self.block(stage, ends, [200.0, 200.0 + self.height * count as f32]);
        }
    }

    /// Walks over them: its speed on the way, and whether it has been in the air.
    fn walk(
        &self,
        shape: Option<DepthProfile>,
        walk: CharacterSettings,
        speed: f32,
        rate: f32,
    ) -> (f32, bool) {
        let top = 200.0 + if self.is_down { self.height * STEPS as f32 } else { 0.0 };
        SHAPE.set(shape);
        let mut stage = Stage::new(rate, self.along(60.0 - 0.3 * speed, top));
        SHAPE.set(None);
        stage.walker.walk = walk;
        self.build(&mut stage);
        let way = Vector3::from(self.along(speed, 0.0));
        let wish = MoveInput { x: way.x, z: way.z, jump: false };
        let along = |stage: &Stage| if self.along_z { stage.at().z } else { stage.at().x };
        while along(&stage) < 70.0 {
            stage.step(wish);
        }
        let (start, time) = (along(&stage), (self.tread * STEPS as f32 + 40.0) / speed);
        let mut is_aloft = false;
        stage.walk(wish, time, |stage| is_aloft |= !stage.walker.is_grounded());
        ((along(&stage) - start) / (time * rate).round() * rate, is_aloft)
    }
}

fn all_stairs(height: f32, tread: f32) -> impl Iterator<Item = Stairs> {
    [Made::Platforms, Made::Bodies, Made::RisingBodies].into_iter().flat_map(move |made| {
        [(false, false), (false, true), (true, false), (true, true)].map(|(along_z, is_down)| Stairs {
            made,
            along_z,
            is_down,
            height,
            tread,
        })
    })
}

/// Both are so high; snap does not matter up a flight of stairs.
fn walk_of(highest: f32) -> CharacterSettings {
    CharacterSettings { step_up: highest, snap: highest, ..CharacterSettings::default() }
}

#[test]
fn stairs_as_high_as_a_step_are_walked_like_lower_ones() {
    for (highest, tread, speed, rate) in [
        (8.0, 30.0, 140.0, 60.0),
        (8.0, 16.0, 140.0, 120.0),
        (2.0, 30.0, 40.0, 30.0),
        (20.0, 60.0, 300.0, 60.0),
    ] {
        for shape in [None, Some(CYLINDER), Some(CAPSULE)] {
            for height in [0.875 * highest, highest - 0.1, highest] {
                // A round end that is 2 px wide where a step begins rises by that many px, and no more.
                if shape == Some(CAPSULE) && highest > 8.0 {
                    continue;
                }
                for stairs in all_stairs(height, tread) {
                    let (way, is_aloft) = stairs.walk(shape, walk_of(highest), speed, rate);
                    let what = format!("{stairs:?} {shape:?} {speed} {rate}");
                    assert!(!is_aloft, "{what}: in the air");
                    assert!(way > 0.95 * speed, "{what}: {way}");
                }
            }
        }
    }
}

/// 10 px in a step: two edges within the two steps that a figure looks ahead, each a step high.
#[test]
fn short_treads_are_walked_at_full_speed_in_long_steps() {
    let capsule = |radius| Some(DepthProfile::Capsule { radius, height: 60.0 });
    for shape in [None, Some(CYLINDER), capsule(6.0), capsule(10.0), capsule(25.0)] {
        for (tread, speed, rate) in [(12.0, 300.0, 30.0), (16.0, 300.0, 30.0), (12.0, 200.0, 30.0)] {
            for height in [6.0, 7.9, 8.0] {
                for stairs in all_stairs(height, tread).filter(|stairs| stairs.made != Made::RisingBodies) {
                    let (way, is_aloft) = stairs.walk(shape, walk_of(8.0), speed, rate);
                    let what = format!("{stairs:?} {shape:?} {speed} {rate}");
                    assert!(!is_aloft && way > 0.95 * speed, "{what}: {way}, in the air: {is_aloft}");
                }
            }
        }
    }
}

/// The second stair is under the round end too, and is higher than a step, but far from the surface of that.
#[test]
fn a_round_end_wider_than_two_treads_is_not_stopped_by_the_second_stair() {
    let shape = Some(DepthProfile::Capsule { radius: 25.0, height: 60.0 });
    for (speed, rate) in [(60.0, 120.0), (140.0, 60.0), (300.0, 120.0)] {
        for height in [3.0, 3.95, 4.0] {
            for stairs in all_stairs(height, 12.0).filter(|stairs| stairs.made != Made::RisingBodies) {
                let (way, is_aloft) = stairs.walk(shape, walk_of(4.0), speed, rate);
                let what = format!("{stairs:?} {speed} {rate}");
                assert!(!is_aloft && way > 0.95 * speed, "{what}: {way}, in the air: {is_aloft}");
            }
        }
    }
}

#[test]
fn it_walks_up_stairs_with_any_snap_distance() {
    for shape in [None, Some(CYLINDER)] {
        for stairs in all_stairs(8.0, 30.0).filter(|stairs| !stairs.is_down) {
            let walk = CharacterSettings { snap: 2.0, ..CharacterSettings::default() };
            let (way, is_aloft) = stairs.walk(shape, walk, 140.0, 60.0);
            assert!(!is_aloft && way > 0.95 * 140.0, "{stairs:?} {shape:?}: {way}, in the air: {is_aloft}");
        }
    }
}

#[test]
fn a_tenth_of_a_pixel_more_than_a_step_stops_it() {
    for (highest, shape) in
        [2.0, 8.0, 20.0].into_iter().flat_map(|it| [None, Some(CYLINDER)].map(|shape| (it, shape)))
    {
        for stairs in all_stairs(highest + 0.1, 30.0).filter(|stairs| !stairs.is_down) {
            let (way, _) = stairs.walk(shape, walk_of(highest), 140.0, 60.0);
            assert!(way < 20.0, "{stairs:?} {shape:?}: {way}");
        }
    }
}
