//! The sample scenes of Farseer.

use conformance::samples::{BACKGROUND, SCREEN, Sample, SampleScene};
use examples::{Result, draw_sample};
use twohalf_render::{Canvas, Color};

use crate::play::{Play, Player, Set, World, WorldMut};
use crate::state;

/// Steps per second: those of the original.
const RATE: u32 = 100;

/// A sample scene.
#[derive(Debug, Clone)]
struct Shown {
    scene: SampleScene,
}

pub(super) fn sample(sample: &Sample, set: Set) -> Result<Box<dyn Play>> {
    let mut scene = (sample.build)()?;
    // The original makes one step before it shows a scene for the first time.
    scene.step()?;
    if set == Set::Precise {
        state::switch(WorldMut::Plane(scene.simulator_mut()), set)?;
    }
    Ok(Box::new(Shown { scene }))
}

impl Play for Shown {
    fn size(&self) -> [f32; 2] {
        SCREEN
    }

    fn rate(&self) -> u32 {
        RATE
    }

    fn step(&mut self, _: Player) -> Result<()> {
        Ok(self.scene.step()?)
    }

    fn draw(&self, canvas: &mut dyn Canvas) -> Result<()> {
        let [red, green, blue, alpha] = BACKGROUND;
        canvas.clear(Color::rgba(red, green, blue, alpha));
        draw_sample(&self.scene, canvas);
        Ok(())
    }

    fn world(&self) -> World<'_> {
        World::Plane(self.scene.simulator())
    }

    fn world_mut(&mut self) -> WorldMut<'_> {
        WorldMut::Plane(self.scene.simulator_mut())
    }

    fn copy(&self) -> Box<dyn Play> {
        Box::new(self.clone())
    }
}
