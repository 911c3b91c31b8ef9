//! A scene: a simulator, its actors in every frame, and its look.

use farseer_core::math::Vector2;
use farseer_core::{
    BodyId, ControllerId, Dispatch, GeomId, JointId, NarrowPhaseCollider, PhysicsSimulator, Result,
    SecondaryMap,
};

use super::{DT, Rgba};

/// Actions of a scene besides its physics (behaviour chapter 16, section B.1).
///
/// Forces that are applied after a step take effect in the next one.
pub trait Actor: std::fmt::Debug + CopyActor {
    /// Acts before every step.
    ///
    /// # Errors
    /// A refusal of the simulator.
    fn before_step(&mut self, simulator: &mut PhysicsSimulator) -> Result<()> {
        let _ = simulator;
        Ok(())
    }

    /// Acts after every step.
    ///
    /// # Errors
    /// A refusal of the simulator.
    fn after_step(&mut self, simulator: &mut PhysicsSimulator) -> Result<()> {
        let _ = simulator;
        Ok(())
    }
}

/// A copy behind the same pointer: so that scenes can be copied in mid-run.
pub trait CopyActor {
    /// The copy.
    fn copy(&self) -> Box<dyn Actor>;
}

impl<A: Actor + Clone + 'static> CopyActor for A {
    fn copy(&self) -> Box<dyn Actor> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn Actor> {
    fn clone(&self) -> Self {
        (**self).copy()
    }
}

/// Drawing of a geom: an outline that is filled, with a border. Later ones lie on top.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// The outline.
    pub figure: Figure,
    /// Colour inside.
    pub fill: Rgba,
    /// Colour of the border.
    pub border: Rgba,
}

/// An outline that moves with a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Figure {
    /// The outline of a geom.
    Geom(GeomId),
    /// A rectangle about the origin of a body that has no geom, or one of another size.
    Rectangle {
        /// The body.
        body: BodyId,
        /// Width and height in px.
        size: [f32; 2],
    },
}

/// State of the handlers of scenes.
#[derive(Debug, Clone, Default)]
pub(super) struct Known {
    /// The geoms that a weld keeps in one collision group.
    pub(super) welded: SecondaryMap<JointId, [GeomId; 2]>,
    /// The wave of a fluid.
    pub(super) waves: SecondaryMap<ControllerId, ControllerId>,
}

/// A scene.
#[derive(Debug, Clone)]
pub struct SampleScene {
    pub(super) simulator: PhysicsSimulator,
    pub(super) dispatch: Dispatch<Known>,
    pub(super) known: Known,
    looks: Vec<Look>,
    actors: Vec<Box<dyn Actor>>,
}

impl SampleScene {
    /// An empty scene with this downward gravity in px/s².
    ///
    /// # Errors
    /// Gravity that is not finite.
    pub fn new(gravity: f32) -> Result<Self> {
        let simulator = PhysicsSimulator::new(Vector2::new(0.0, gravity))?;
        Ok(SampleScene {
            simulator,
            dispatch: Dispatch::new(),
            known: Known::default(),
            looks: Vec::new(),
            actors: Vec::new(),
        })
    }

    /// The same, with separating axes instead of the distance grid.
    pub(super) fn with_sat(gravity: f32) -> Result<Self> {
        let mut scene = SampleScene::new(gravity)?;
        scene.simulator.set_narrow_phase_collider(NarrowPhaseCollider::Sat);
        Ok(scene)
    }

    /// The simulator.
    pub fn simulator(&self) -> &PhysicsSimulator {
        &self.simulator
    }

    /// The simulator, to add to the scene.
    pub fn simulator_mut(&mut self) -> &mut PhysicsSimulator {
        &mut self.simulator
    }

    /// How it looks, back to front.
    pub fn looks(&self) -> &[Look] {
        &self.looks
    }

    /// Adds an actor that acts from the next step on.
    pub fn act(&mut self, actor: impl Actor + 'static) {
        self.actors.push(Box::new(actor));
    }

    /// Draws a geom with this fill and border, on top of the earlier ones.
    pub fn show(&mut self, geom: GeomId, fill: Rgba, border: Rgba) {
        self.looks.push(Look { figure: Figure::Geom(geom), fill, border });
    }

    pub(super) fn show_rectangle(&mut self, body: BodyId, size: [f32; 2], fill: Rgba, border: Rgba) {
        self.looks.push(Look { figure: Figure::Rectangle { body, size }, fill, border });
    }

    /// A frame: the actors before a step, a step of [`DT`], the actors after it.
    ///
    /// # Errors
    /// A refusal of the actors' calls.
    pub fn step(&mut self) -> Result<()> {
        for actor in &mut self.actors {
            actor.before_step(&mut self.simulator)?;
        }
        self.simulator.update_with(DT, &mut self.dispatch.with(&mut self.known));
        for actor in &mut self.actors {
            actor.after_step(&mut self.simulator)?;
        }
        Ok(())
    }
}
