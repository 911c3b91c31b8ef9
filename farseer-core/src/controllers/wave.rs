//! A water surface with waves (behaviour chapter 12, section 6).

use serde::{Deserialize, Serialize};

use super::FluidContainer;
use crate::checked_properties::checked_properties;
use crate::error::{Error, Result};
use crate::math::finite::{finite, finite_vector};
use crate::math::{Vector2, scalar, vector2};
use crate::shape::Aabb;
use crate::shape::vertices::MAX_VERTICES;
use crate::storage::bits::Floats;

/// A row of surface nodes, coupled with their neighbours, above a fluid. y points down: a node with a positive offset
/// is lower than the surface at rest.
///
/// The last node is moved by the wave generator, the first stays at 0. All points below the surface are in the fluid:
/// it has no bottom and no sides; beyond its ends the outermost segments continue as straight lines.
///
/// ```
/// use farseer_core::{FluidContainer, WaveController, math::Vector2};
/// let mut sea = WaveController::new(Vector2::new(0.0, 300.0), 800.0, 200.0, 21)?;
/// sea.disturb(400.0, 10.0)?;
/// assert!(!sea.contains(Vector2::new(400.0, 305.0)));
/// assert!(sea.contains(Vector2::new(100.0, 305.0)));
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct WaveController {
    width: f32,
    height: f32,
    position: Vector2,
    node_count: usize,
    damping_coefficient: f32,
    frequency: f32,
    wave_generator_max: f32,
    wave_generator_min: f32,
    wave_generator_step: f32,
    x_position: Vec<f32>,
    current: Vec<f32>,
    previous: Vec<f32>,
    result: Vec<f32>,
    elapsed: f32,
    generator: f32,
    generator_rises: bool,
    single_width: f32,
    #[serde(with = "crate::storage::bits")]
    aabb: Aabb,
    #[serde(with = "crate::storage::bits")]
    looked_at: LastPointQuery,
}

/// The last point that was tested, and the ends of the surface segment with which it was compared.
#[derive(Debug, Clone, Copy, Default)]
struct LastPointQuery {
    near: Vector2,
    far: Vector2,
    point: Vector2,
}

impl Floats for LastPointQuery {
    fn to_floats(&self) -> Vec<f32> {
        [self.near, self.far, self.point].iter().flat_map(|v| [v.x, v.y]).collect()
    }
    fn from_floats(floats: &[f32]) -> Option<Self> {
        let [a, b, c, d, e, f] = <[f32; 6]>::try_from(floats).ok()?;
        Some(LastPointQuery { near: Vector2::new(a, b), far: Vector2::new(c, d), point: Vector2::new(e, f) })
    }
}

impl WaveController {
    /// A surface at rest from `position`, its left end, `width` length units to the right. The box that decides whether
    /// a geom may be in the fluid reaches `height` length units down.
    ///
    /// # Errors
    /// Numbers that are not finite, or so large that a node's position is not; fewer than 2 nodes, for which the
    /// original throws when a point is tested, or more than 2^24.
    pub fn new(position: Vector2, width: f32, height: f32, node_count: usize) -> Result<Self> {
        let mut wave = WaveController {
            width: finite("width", width)?,
            height: finite("height", height)?,
            position: finite_vector("position", position)?,
            node_count: check_node_count(node_count)?,
            damping_coefficient: 0.95,
            frequency: 0.18,
            wave_generator_max: 0.0,
            wave_generator_min: 0.0,
            wave_generator_step: 0.0,
            x_position: Vec::new(),
            current: Vec::new(),
            previous: Vec::new(),
            result: Vec::new(),
            elapsed: 0.0,
            generator: 0.0,
            generator_rises: true,
            single_width: 0.0,
            aabb: Aabb::default(),
            looked_at: LastPointQuery::default(),
        };
        wave.initialize()?;
        Ok(wave)
    }

    /// Builds the nodes anew, at rest, from position, width, height and node count as they are now. The time to the
    /// next wave step and the generator's state stay.
    ///
    /// # Errors
    /// A position and a size so large that a node's position is not finite.
    #[doc(alias = "Initialize")]
    pub fn initialize(&mut self) -> Result<()> {
        let segments = (self.node_count - 1) as f32;
        let right = self.position.x + self.width;
        let bottom = self.position.y + self.height;
        let x = |i: usize| self.position.x + (right - self.position.x) * (i as f32 / segments);
        let x_position: Vec<f32> = (0..self.node_count).map(x).collect();
        if !bottom.is_finite() || x_position.iter().any(|x| !x.is_finite()) {
            return Err(Error::invalid("width", self.width, "small enough for finite node positions"));
        }
        self.x_position = x_position;
        self.current = vec![0.0; self.node_count];
        self.previous = self.current.clone();
        self.result = self.current.clone();
        self.aabb = Aabb::new(self.position, Vector2::new(right, bottom));
        self.single_width = self.width / segments;
        Ok(())
    }

    checked_properties! {
        /// Extent to the right, in length units. A new value takes effect with the next
        /// [`initialize`](Self::initialize).
        #[doc(alias = "Width")]
        width, set_width;
        /// Extent down, in length units. A new value takes effect with the next [`initialize`](Self::initialize).
        #[doc(alias = "Height")]
        height, set_height;
        /// Factor by which every wave step multiplies the offsets, dimensionless. Default 0.95.
        #[doc(alias = "DampingCoefficient")]
        damping_coefficient, set_damping_coefficient;
        /// Time between wave steps, in seconds. Default 0.18. When a step is due, time in excess is discarded.
        #[doc(alias = "Frequency")]
        frequency, set_frequency;
        /// Offset above which the generator turns to fall, in length units. Default 0.
        #[doc(alias = "WaveGeneratorMax")]
        wave_generator_max, set_wave_generator_max;
        /// Offset below which the generator turns to rise, in length units. Default 0.
        #[doc(alias = "WaveGeneratorMin")]
        wave_generator_min, set_wave_generator_min;
        /// Distance by which the generator moves in a wave step, in length units. Default 0.
        #[doc(alias = "WaveGeneratorStep")]
        wave_generator_step, set_wave_generator_step;
    }

    /// The left end of the surface at rest.
    #[doc(alias = "Position")]
    pub fn position(&self) -> Vector2 {
        self.position
    }

    /// Sets the position. Its y takes effect at once for points, its x with the next [`initialize`](Self::initialize),
    /// as in the original.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn set_position(&mut self, position: Vector2) -> Result<()> {
        self.position = finite_vector("position", position)?;
        Ok(())
    }

    /// Number of surface nodes.
    #[doc(alias = "NodeCount")]
    pub fn node_count(&self) -> usize {
        self.node_count
    }

    /// Sets the number of nodes. With a smaller number the nodes to the right do not move any more. A greater one takes
    /// effect with the next [`initialize`](Self::initialize), before which the original throws.
    ///
    /// # Errors
    /// Fewer than 2 nodes, or more than 2^24.
    pub fn set_node_count(&mut self, node_count: usize) -> Result<()> {
        self.node_count = check_node_count(node_count)?;
        Ok(())
    }

    /// Offset of every node from the surface at rest, in length units; a greater one is lower on the screen.
    #[doc(alias = "CurrentWave")]
    pub fn current_wave(&self) -> &[f32] {
        &self.current
    }

    /// The offsets before the last wave step, in length units.
    #[doc(alias = "PreviousWave")]
    pub fn previous_wave(&self) -> &[f32] {
        &self.previous
    }

    /// The x coordinate of every node, in length units.
    #[doc(alias = "XPosition")]
    pub fn x_position(&self) -> &[f32] {
        &self.x_position
    }

    /// Sets the x coordinates of the nodes. The segment of a point is still computed for nodes at equal distances.
    ///
    /// # Errors
    /// A value that is not finite, or fewer numbers than there are nodes.
    pub fn set_x_position(&mut self, x_position: Vec<f32>) -> Result<()> {
        for &x in &x_position {
            finite("x_position", x)?;
        }
        if x_position.len() < self.current.len() {
            return Err(Error::invalid("x_position", x_position, "a number for every node"));
        }
        self.x_position = x_position;
        Ok(())
    }

    /// Right end of the segment with which the last point was compared; (0, 0) before.
    #[doc(alias = "VectorFarWaveEdge")]
    pub fn vector_far_wave_edge(&self) -> Vector2 {
        self.looked_at.far
    }

    /// Left end of the segment with which the last point was compared; (0, 0) before.
    #[doc(alias = "VectorNearWaveEdge")]
    pub fn vector_near_wave_edge(&self) -> Vector2 {
        self.looked_at.near
    }

    /// The last point that was tested; (0, 0) before.
    #[doc(alias = "VectorPoint")]
    pub fn vector_point(&self) -> Vector2 {
        self.looked_at.point
    }

    /// Lowers the left node of the segment at `x` by `offset` length units. An `x` exactly on an inner node is in two
    /// segments and lowers the node before it as well; the last node is never lowered.
    ///
    /// # Errors
    /// A value that is not finite, or that would make a node's offset infinite.
    #[doc(alias = "Disturb")]
    pub fn disturb(&mut self, x: f32, offset: f32) -> Result<()> {
        finite("x", x)?;
        finite("offset", offset)?;
        let segments = self.nodes() - 1;
        let is_hit = |i: usize| x >= self.x_position[i] && x <= self.x_position[i + 1];
        if (0..segments).any(|i| is_hit(i) && !(self.current[i] + offset).is_finite()) {
            return Err(Error::invalid("offset", offset, "small enough for a finite wave"));
        }
        for i in 0..segments {
            if is_hit(i) {
                self.current[i] += offset;
            }
        }
        Ok(())
    }

    /// Advances time by `dt` seconds, or makes a wave step if one is due; then `dt` is not counted. The simulator does
    /// this in its updates.
    ///
    /// # Errors
    /// A time that is not finite. A wave that would not be finite, for example with damping above 1, stays unchanged.
    #[doc(alias = "Update")]
    pub fn update(&mut self, dt: f32) -> Result<()> {
        finite("dt", dt)?;
        if self.advance(dt) {
            Ok(())
        } else {
            Err(Error::invalid("self", &*self, "a wave that stays finite"))
        }
    }

    /// Like [`update`](Self::update); returns whether everything is finite.
    pub(crate) fn advance(&mut self, dt: f32) -> bool {
        if self.elapsed < self.frequency {
            let elapsed = self.elapsed + dt;
            if elapsed.is_finite() {
                self.elapsed = elapsed;
            }
            return elapsed.is_finite();
        }
        self.elapsed = 0.0;
        self.step()
    }

    fn step(&mut self) -> bool {
        let nodes = self.nodes();
        let mut top = f32::MAX;
        let mut is_finite = true;
        for i in 1..nodes - 1 {
            let offset =
                (self.current[i - 1] + self.current[i + 1] - self.previous[i]) * self.damping_coefficient;
            self.result[i] = offset;
            is_finite &= offset.is_finite();
            let y = offset + self.position.y;
            if y < top {
                top = y;
            }
        }
        let (generator, generator_rises) = self.next_generator();
        if !(is_finite && top.is_finite() && generator.is_finite()) {
            // Nodes to the right of a reduced count are copied from here, too.
            self.result[1..nodes - 1].copy_from_slice(&self.current[1..nodes - 1]);
            return false;
        }
        self.aabb.min.y = top;
        std::mem::swap(&mut self.previous, &mut self.current);
        self.current.copy_from_slice(&self.result);
        (self.generator, self.generator_rises) = (generator, generator_rises);
        self.current[nodes - 1] = generator;
        true
    }

    /// The generator's next offset, and whether it rises then. In the step in which it turns it does not move.
    fn next_generator(&self) -> (f32, bool) {
        let (now, step) = (self.generator, self.wave_generator_step);
        match self.generator_rises {
            true if now > self.wave_generator_max => (now, false),
            true => (now + step, true),
            false if now < self.wave_generator_min => (now, true),
            false => (now - step, false),
        }
    }

    /// Number of nodes in use.
    fn nodes(&self) -> usize {
        self.node_count.min(self.current.len())
    }

    pub(super) fn is_valid(&self) -> bool {
        let numbers = [
            self.width,
            self.height,
            self.position.x,
            self.position.y,
            self.damping_coefficient,
            self.frequency,
            self.wave_generator_max,
            self.wave_generator_min,
            self.wave_generator_step,
            self.elapsed,
            self.generator,
            self.single_width,
        ];
        let corners = [self.aabb.min.x, self.aabb.min.y, self.aabb.max.x, self.aabb.max.y];
        let rows = [&self.x_position, &self.current, &self.previous, &self.result];
        let length = self.current.len();
        check_node_count(self.node_count).is_ok()
            && length >= 2
            && self.x_position.len() >= length
            && self.previous.len() == length
            && self.result.len() == length
            && numbers.iter().chain(&corners).all(|number| number.is_finite())
            && rows.iter().all(|row| row.iter().all(|number| number.is_finite()))
    }
}

fn check_node_count(node_count: usize) -> Result<usize> {
    if (2..=MAX_VERTICES).contains(&node_count) {
        Ok(node_count)
    } else {
        Err(Error::invalid("node_count", node_count, "from 2 to 2^24"))
    }
}

impl FluidContainer for WaveController {
    /// Boxes that only touch intersect. The box's top follows the highest inner node from the first wave step on.
    /// Without inner nodes no box intersects from then on.
    fn intersect(&self, aabb: &Aabb) -> bool {
        Aabb::intersect(aabb, &self.aabb)
    }

    /// Whether a point lies on or below the segment of the surface that is nearest to its x.
    fn contains(&mut self, point: Vector2) -> bool {
        let (x, offset) = (&self.x_position, &self.current);
        let quotient = (point.x - x[0]) / self.single_width;
        // Indices that do not fit 32 bits are all replaced by the first one, as in the original.
        let place = scalar::to_int_f64(f64::from(quotient).floor());
        let i = usize::try_from(place).unwrap_or(0).min(self.nodes() - 2);
        let y = self.position.y;
        self.looked_at = LastPointQuery {
            near: Vector2::new(x[i], y + offset[i]),
            far: Vector2::new(x[i + 1], y + offset[i + 1]),
            point,
        };
        let edge = Vector2::new(x[i + 1] - x[i], offset[i + 1] - offset[i]);
        let from_edge = Vector2::new(point.x - x[i], point.y - (y + offset[i]));
        // NaN counts as contained.
        let is_above = vector2::cross(edge, from_edge) < 0.0;
        !is_above
    }
}
