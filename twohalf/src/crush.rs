//! Who is squeezed between two sides, and by how much.

use farseer_core::{BodyId, PhysicsSimulator, SpaceTouch};
use serde::{Deserialize, Serialize};

use crate::error::{invalid, only_precise, stale};
use crate::events::Event;
use crate::precise::{is_touching, partner_of};
use crate::tell::to_world;
use crate::world::World;
use crate::{DepthScheme, Partner, Result, TwoHalfPhysicsSimulator, Vector3};

/// What pushes along an axis by at least this part of its normal is on one of its sides: up to 45 degrees.
const FACES: f32 = std::f32::consts::FRAC_1_SQRT_2;

/// A body between two sides that leave it less room than it needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Squeeze {
    /// The axis of the world, Y up, along which it is squeezed: the direction in which the first partner pushes it.
    pub axis: Vector3,
    /// How much it lacks to have room between them, px: how deep it is in the one and in the other, together.
    pub depth: f32,
    /// What is on either side.
    pub between: [Partner; 2],
}

/// A body whose game wants to be told.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct CrushWatch {
    body: BodyId,
    tolerance: f32,
    is_crushed: bool,
}

impl CrushWatch {
    /// What was loaded may hold anything.
    pub(crate) fn is_valid(&self) -> bool {
        self.tolerance.is_finite() && self.tolerance >= 0.0
    }
}

/// What is squeezed.
impl TwoHalfPhysicsSimulator {
    /// How a body was squeezed at the end of the last update: along the axis of the three along which it lacks most room between two
    /// sides that both push it. `None` unless there are two such sides, and for stale ids.
    ///
    /// A side is whatever pushes the body along an axis by more than sideways: ground, platforms, bodies, at rest or
    /// moving. Things that only lie on each other lack some hundredths of a px; what goes on closing, as a lift below
    /// a ceiling does, leaves less room with every update, at any length of step.
    pub fn squeeze(&self, body: BodyId) -> Option<Squeeze> {
        self.world.squeeze(&self.core, body)
    }

    /// Lets [`Event::Crushed`] tell of a body once it lacks more than `tolerance` px of room, in the update in which that
    /// begins; again when it had room meanwhile. `None` ends it, as it is for all bodies at first.
    ///
    /// Crushing is told and nothing else: what becomes of who is crushed is for the game to say.
    ///
    /// ```
    /// # use twohalf::{Event, Platform, TwoHalfPhysicsSimulator, Vector2, Vector3};
    /// # use twohalf::farseer_core::{BodyFactory, GeomPlacement, Vertices};
    /// # let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
    /// # let body = simulator.create_body(BodyFactory::create_rectangle_body(20.0, 50.0, 1.0)?);
    /// # let geom = simulator.create_geom(body, Vertices::create_rectangle(20.0, 50.0)?, GeomPlacement::default())?;
    /// # simulator.add(body)?;
    /// # simulator.add(geom)?;
    /// # simulator.body_mut(body).unwrap().ground_mut().set_object_geom(geom, None)?;
    /// // A press comes down on who stands below it.
    /// let press = Platform::new(&mut simulator, 80.0, 20.0, 100.0, Vector3::new(0.0, 60.0, 0.0), None)?;
    /// simulator.platform_mut(press).unwrap().set_velocity(Vector3::new(0.0, -30.0, 0.0))?;
    /// simulator.set_crush_tolerance(body, Some(5.0))?;
    /// let mut told = Vec::new();
    /// for update in 0..120 {
    ///     simulator.update(1.0 / 60.0);
    ///     if simulator.events().iter().any(|event| matches!(event, Event::Crushed { .. })) {
    ///         told.push(update);
    ///     }
    /// }
    /// // Once: 15 px of way, at 30 px/s.
    /// assert!(told.len() == 1 && told[0].abs_diff(30) <= 1, "{told:?}");
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    ///
    /// # Errors
    /// A stale body; a tolerance that is not finite and 0 or more; another scheme than [`DepthScheme::Precise`].
    pub fn set_crush_tolerance(&mut self, body: BodyId, tolerance: Option<f32>) -> Result<()> {
        if self.world.scheme != DepthScheme::Precise {
            return Err(only_precise("crushing that is told"));
        }
        self.core.body(body).ok_or(stale("body"))?;
        if let Some(tolerance) = tolerance.filter(|it| !(it.is_finite() && *it >= 0.0)) {
            return Err(invalid("tolerance", tolerance, "finite and 0 or more"));
        }
        let watches = &mut self.world.crush_watches;
        let known = watches.iter_mut().find(|watch| watch.body == body);
        match (known, tolerance) {
            (Some(watch), Some(tolerance)) => watch.tolerance = tolerance,
            (None, Some(tolerance)) => watches.push(CrushWatch { body, tolerance, is_crushed: false }),
            (_, None) => watches.retain(|watch| watch.body != body),
        }
        Ok(())
    }

    /// From how much lack of room on a body counts as crushed, px; `None` if nobody is told.
    pub fn crush_tolerance(&self, body: BodyId) -> Option<f32> {
        let watch = self.world.crush_watches.iter().find(|watch| watch.body == body);
        watch.map(|watch| watch.tolerance)
    }
}

impl World {
    /// Tells of those that are crushed from this update on.
    pub(crate) fn tell_crushed(&mut self, core: &PhysicsSimulator) {
        if self.crush_watches.is_empty() {
            return;
        }
        let mut watches = std::mem::take(&mut self.crush_watches);
        watches.retain(|watch| core.body(watch.body).is_some());
        for CrushWatch { body, tolerance, is_crushed } in &mut watches {
            let squeeze = self.squeeze(core, *body).filter(|squeeze| squeeze.depth > *tolerance);
            let was_crushed = std::mem::replace(is_crushed, squeeze.is_some());
            if let Some(squeeze) = squeeze.filter(|_| !was_crushed) {
                self.events.push(Event::Crushed { body: *body, squeeze });
            }
        }
        self.crush_watches = watches;
    }

    fn squeeze(&self, core: &PhysicsSimulator, body: BodyId) -> Option<Squeeze> {
        if self.scheme != DepthScheme::Precise || !core.knows_touches() {
            return None;
        }
        let mut sides: [Option<(f32, Partner)>; 6] = [None; 6];
        for touch in core.space_touches_of(body).filter(|touch| touch.responds && is_touching(touch)) {
            let (partner, normal) = as_seen_by(body, &touch);
            let depth =
                touch.points[..touch.count].iter().fold(f32::MIN, |it, point| it.max(-point.separation));
            for axis in 0..3 {
                if normal[axis].abs() >= FACES {
                    let side = &mut sides[2 * axis + usize::from(normal[axis] < 0.0)];
                    *side = side.filter(|(deepest, _)| *deepest >= depth).or(Some((depth, partner)));
                }
            }
        }
        let along = |axis: usize| {
            let ((from, one), (to, other)) = (sides[2 * axis]?, sides[2 * axis + 1]?);
            let mut direction = Vector3::zeros();
            direction[axis] = 1.0;
            Some(Squeeze { axis: direction, depth: from + to, between: [one, other] })
        };
        (0..3).filter_map(along).reduce(|most, next| if next.depth > most.depth { next } else { most })
    }
}

/// Who pushes a body in a touch, and in which direction of the world.
fn as_seen_by(body: BodyId, touch: &SpaceTouch) -> (Partner, Vector3) {
    let normal = to_world(Vector3::from(touch.normal));
    if touch.body == body {
        (partner_of(touch.partner), normal)
    } else {
        (Partner::Geom(touch.this), -normal)
    }
}
