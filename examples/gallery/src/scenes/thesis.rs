//! The demo scenes of the thesis, in 2D and in 2.5D.

use examples::{Plane, RATE, Result, SIZE, Stage, demo_scene_1, demo_scene_2};
use twohalf_render::{Canvas, Color, SoftwareCanvas, Texture2D, Transform};

use crate::play::{Play, Player, Set, World, WorldMut};
use crate::state;

/// A demo scene in 2D.
#[derive(Debug, Clone)]
struct InPlane {
    plane: Plane,
}

/// A demo scene in 2.5D.
#[derive(Debug, Clone)]
struct InDepth {
    stage: Stage,
    backdrop: Texture2D,
}

/// Demo Scene 1 or 2 in 2D.
pub(super) fn plane(scene: u32, set: Set) -> Result<Box<dyn Play>> {
    let mut plane = if scene == 1 { demo_scene_1::plane()? } else { demo_scene_2::plane()? };
    if set == Set::Precise {
        state::switch(WorldMut::Plane(plane.simulator_mut()), set)?;
    }
    Ok(Box::new(InPlane { plane }))
}

/// Demo Scene 1 or 2 in 2.5D.
pub(super) fn depth(scene: u32, set: Set) -> Result<Box<dyn Play>> {
    let scheme = super::scheme(set);
    let stage =
        if scene == 1 { demo_scene_1::depth(scheme, false)? } else { demo_scene_2::depth(scheme, false)? };
    let mut backdrop = SoftwareCanvas::new(SIZE[0], SIZE[1])?;
    if scene == 1 {
        demo_scene_1::draw_backdrop(&mut backdrop)?
    } else {
        demo_scene_2::draw_backdrop(&mut backdrop)?
    }
    Ok(Box::new(InDepth { stage, backdrop: backdrop.to_texture()? }))
}

impl Play for InPlane {
    fn size(&self) -> [f32; 2] {
        SIZE.map(|side| side as f32)
    }

    fn rate(&self) -> u32 {
        RATE
    }

    fn step(&mut self, _: Player) -> Result<()> {
        self.plane.step();
        Ok(())
    }

    fn draw(&self, canvas: &mut dyn Canvas) -> Result<()> {
        self.plane.draw_backdrop(canvas);
        self.plane.draw(canvas);
        Ok(())
    }

    fn world(&self) -> World<'_> {
        World::Plane(self.plane.simulator())
    }

    fn world_mut(&mut self) -> WorldMut<'_> {
        WorldMut::Plane(self.plane.simulator_mut())
    }

    fn copy(&self) -> Box<dyn Play> {
        Box::new(self.clone())
    }
}

impl Play for InDepth {
    fn size(&self) -> [f32; 2] {
        SIZE.map(|side| side as f32)
    }

    fn rate(&self) -> u32 {
        RATE
    }

    fn step(&mut self, _: Player) -> Result<()> {
        self.stage.step();
        Ok(())
    }

    fn draw(&self, canvas: &mut dyn Canvas) -> Result<()> {
        canvas.draw_texture(&self.backdrop, &Transform::IDENTITY, Color::WHITE, None);
        self.stage.draw(canvas);
        Ok(())
    }

    fn world(&self) -> World<'_> {
        World::Depth(self.stage.simulator())
    }

    fn world_mut(&mut self) -> WorldMut<'_> {
        WorldMut::Depth(self.stage.simulator_mut())
    }

    fn copy(&self) -> Box<dyn Play> {
        Box::new(self.clone())
    }
}
