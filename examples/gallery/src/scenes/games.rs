//! The two games: a pinball table and a beat-'em-up.

use examples::Result;
use examples::brawler::{self, Brawler, Paint};
use examples::pinball::{self, Pinball, Side};
use twohalf_render::{Canvas, Transform};

use crate::keys::Key;
use crate::play::{Play, Player, World, WorldMut};

/// The pinball table.
#[derive(Debug, Clone)]
struct Table {
    pinball: Pinball,
}

/// The beat-'em-up.
#[derive(Debug, Clone)]
struct Street {
    brawler: Brawler,
    paint: Paint,
}

pub(super) fn pinball() -> Result<Box<dyn Play>> {
    let mut pinball = Pinball::new()?;
    // All objects are visible before the first step.
    pinball.simulator_mut().update(0.0);
    Ok(Box::new(Table { pinball }))
}

pub(super) fn brawler() -> Result<Box<dyn Play>> {
    let mut brawler = Brawler::new()?;
    brawler.simulator.update(0.0);
    Ok(Box::new(Street { brawler, paint: Paint::new()? }))
}

impl Play for Table {
    fn size(&self) -> [f32; 2] {
        pinball::TABLE
    }

    fn rate(&self) -> u32 {
        pinball::RATE
    }

    fn step(&mut self, player: Player) -> Result<()> {
        let Player::Keys(keys) = player else { return pinball::play(&mut self.pinball) };
        if keys.held.contains(Key::Jump) && self.pinball.is_waiting() {
            self.pinball.launch();
        }
        self.pinball.flip(Side::Left, keys.held.contains(Key::Left))?;
        self.pinball.flip(Side::Right, keys.held.contains(Key::Right))?;
        self.pinball.step();
        Ok(())
    }

    fn draw(&self, canvas: &mut dyn Canvas) -> Result<()> {
        canvas.clear(pinball::FELT);
        pinball::draw(&self.pinball, canvas);
        Ok(())
    }

    fn world(&self) -> World<'_> {
        World::Plane(self.pinball.simulator())
    }

    fn world_mut(&mut self) -> WorldMut<'_> {
        WorldMut::Plane(self.pinball.simulator_mut())
    }

    fn copy(&self) -> Box<dyn Play> {
        Box::new(self.clone())
    }
}

impl Play for Street {
    fn size(&self) -> [f32; 2] {
        brawler::SIZE.map(|side| side as f32)
    }

    fn rate(&self) -> u32 {
        brawler::RATE
    }

    fn step(&mut self, player: Player) -> Result<()> {
        let keys = match player {
            Player::Script => brawler::script(&self.brawler),
            Player::Keys(keys) => brawler::Keys {
                x: keys.axis(Key::Left, Key::Right),
                z: keys.axis(Key::Down, Key::Up),
                jump: keys.held.contains(Key::Jump),
                punch: keys.held.contains(Key::Punch),
                grab: keys.pressed.contains(Key::Grab),
            },
        };
        self.brawler.step(keys)
    }

    fn draw(&self, canvas: &mut dyn Canvas) -> Result<()> {
        self.paint.draw(&self.brawler, canvas)
    }

    fn world(&self) -> World<'_> {
        World::Depth(&self.brawler.simulator)
    }

    fn world_mut(&mut self) -> WorldMut<'_> {
        WorldMut::Depth(&mut self.brawler.simulator)
    }

    fn camera(&self) -> Transform {
        Paint::camera(&self.brawler)
    }

    fn copy(&self) -> Box<dyn Play> {
        Box::new(self.clone())
    }
}
