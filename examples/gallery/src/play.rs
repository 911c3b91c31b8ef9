//! The interface of a scene, in either engine.

use examples::Result;
use farseer_core::PhysicsSimulator;
use twohalf::TwoHalfPhysicsSimulator;
use twohalf_render::{Canvas, Transform};

use crate::keys::Keys;

/// The player of a scene that is a game; other scenes ignore it.
#[derive(Debug, Clone, Copy)]
pub enum Player {
    /// A script that knows the game.
    Script,
    /// A person with these keys.
    Keys(Keys),
}

/// The set of methods with which a scene is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Set {
    /// The methods of Farseer Physics 2.1.3; with depth, the scheme that agrees with it in the plane.
    Faithful,
    /// The precise one.
    Precise,
}

impl Set {
    /// The other one.
    pub fn other(self) -> Self {
        match self {
            Set::Faithful => Set::Precise,
            Set::Precise => Set::Faithful,
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Set::Faithful => "faithful",
            Set::Precise => "precise",
        }
    }
}

/// The simulator of a scene, to look at.
#[derive(Debug, Clone, Copy)]
pub enum World<'a> {
    /// The 2D engine.
    Plane(&'a PhysicsSimulator),
    /// The 2.5D engine.
    Depth(&'a TwoHalfPhysicsSimulator),
}

/// The simulator of a scene, to meddle with it.
#[derive(Debug)]
pub enum WorldMut<'a> {
    /// The 2D engine.
    Plane(&'a mut PhysicsSimulator),
    /// The 2.5D engine.
    Depth(&'a mut TwoHalfPhysicsSimulator),
}

/// A running scene: a simulator, and its look.
pub trait Play: std::fmt::Debug {
    /// Width and height of its picture in px.
    fn size(&self) -> [f32; 2];

    /// Steps per simulated second.
    fn rate(&self) -> u32;

    /// Makes a step.
    ///
    /// # Errors
    /// A refusal of the engine.
    fn step(&mut self, player: Player) -> Result<()>;

    /// Draws it on a canvas of its [size](Self::size).
    ///
    /// # Errors
    /// A refusal of the renderer.
    fn draw(&self, canvas: &mut dyn Canvas) -> Result<()>;

    /// The simulator.
    fn world(&self) -> World<'_>;

    /// The simulator, to meddle with it.
    fn world_mut(&mut self) -> WorldMut<'_>;

    /// Transform from the simulator's px to those of the picture.
    fn camera(&self) -> Transform {
        Transform::IDENTITY
    }

    /// A copy of the scene as it is now: it goes on with the same bits.
    fn copy(&self) -> Box<dyn Play>;
}

impl Clone for Box<dyn Play> {
    fn clone(&self) -> Self {
        (**self).copy()
    }
}
