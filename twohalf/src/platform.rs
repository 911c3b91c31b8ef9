//! Platforms: boxes with depth that nothing pushes, and that objects stand on, bump into and pass under (thesis 3.6).

mod turned;

use farseer_core::math::scalar;
use farseer_core::{Fixture, FixtureMotion, Geom};
use serde::{Deserialize, Serialize};

use crate::error::{invalid, only_precise, stale};
use crate::shapes::SlantedBox;
use crate::{DepthScheme, Projection, Result, TextureId, TwoHalfPhysicsSimulator, Vector3};

/// So many platforms a simulator may have had.
const MOST: u32 = (1 << 31) - 16;

/// Names a platform of a simulator. Never reused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct PlatformId(u32);

impl PlatformId {
    /// As the 2D engine below knows it.
    pub(crate) fn number(self) -> u32 {
        self.0
    }

    pub(crate) fn from_number(number: u32) -> Self {
        PlatformId(number)
    }
}

/// A box that nothing pushes: width along X, height, and depth along Z, in px.
///
/// `rotation` tilts it about the middle of the box, in the plane of X and Y: a slope. `angle_in_z_axis` shears it, so
/// that its edges in depth run at that angle on the screen; at the simulator's own angle it is a plain box.
/// Objects land on it where their footprints overlap its, walk off every edge, bump into its sides, its front and its
/// underside, and pass under it.
///
/// With [`DepthScheme::Precise`] it stands still, [moves](PlatformMut::set_velocity) or
/// [turns](PlatformMut::set_angular_velocity) about an upright axis, and carries what stands on it; its surface may be a
/// [belt](PlatformMut::set_surface_speed), or [rise along Z](PlatformMut::set_pitch).
///
/// How it collides is in [`settings`](Self::settings), as a geom has them; friction and restitution are 0 until set.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Platform {
    width: f32,
    height: f32,
    depth: f32,
    position3d: Vector3,
    rotation: f32,
    angle_in_z_axis: i32,
    shadow_image: Option<TextureId>,
    settings: Geom,
    /// Of the surface along the level edges and along Z.
    surface_speed: [f32; 2],
    motion: Option<Motion>,
    is_one_way: bool,
    /// How much its top rises towards the back.
    pitch: f32,
    /// By what it is turned about the upright axis, if it ever is.
    yaw: Option<f32>,
    /// Derived from the others.
    #[serde(skip)]
    shape: SlantedBox,
}

/// How a platform moves that does not stand still.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
struct Motion {
    /// Its middle in the frame of the narrow phase: the truth about where it is.
    centre: Vector3,
    /// Where its position is brought.
    target: Option<Vector3>,
    /// As the 2D engine below has it.
    told: FixtureMotion,
}

impl Motion {
    /// Whether everything that enters arithmetic is finite: false only after loading garbage.
    fn is_finite(&self) -> bool {
        let FixtureMotion { velocity, target, way, turning, yaw_target } = self.told;
        let turns = [turning, yaw_target.map_or(0.0, |(target, _)| target)];
        let towards = target.map_or([0.0; 3], |(target, _)| target);
        let position = self.target.unwrap_or_default();
        let numbers = self.centre.iter().chain(position.iter()).copied();
        numbers.chain(velocity).chain(towards).chain(way).chain(turns).all(|number| number.is_finite())
    }
}

/// From the world, Y up, to the frame of the narrow phase, or back.
fn flipped(v: Vector3) -> Vector3 {
    Vector3::new(v.x, -v.y, v.z)
}

/// Making one. It takes part at once.
impl Platform {
    /// A level box.
    ///
    /// # Errors
    /// A width, height or depth that is not finite and greater than 0; a position that is not finite, or so far away
    /// that a corner would not be.
    #[doc(alias = "Platform(sim, int, int, int, Vector3, Texture2D)")]
    #[expect(clippy::new_ret_no_self, reason = "platforms live in the simulator, as in the thesis")]
    pub fn new(
        simulator: &mut TwoHalfPhysicsSimulator,
        width: f32,
        height: f32,
        depth: f32,
        position3d: Vector3,
        shadow_image: Option<TextureId>,
    ) -> Result<PlatformId> {
        Self::with_rotation(simulator, width, height, depth, position3d, 0.0, shadow_image)
    }

    /// A box tilted by `rotation` rad, clockwise on the screen, about its middle: a slope.
    ///
    /// # Errors
    /// As [`Platform::new`]; a rotation that is not finite.
    #[doc(alias = "Platform(sim, int, int, int, Vector3, float, Texture2D)")]
    pub fn with_rotation(
        simulator: &mut TwoHalfPhysicsSimulator,
        width: f32,
        height: f32,
        depth: f32,
        position3d: Vector3,
        rotation: f32,
        shadow_image: Option<TextureId>,
    ) -> Result<PlatformId> {
        let angle = simulator.angle();
        Self::with_rotation_and_angle(
            simulator,
            width,
            height,
            depth,
            position3d,
            rotation,
            shadow_image,
            angle,
        )
    }

    /// A tilted box whose edges in depth run at `angle_in_z_axis` degrees on the screen, counterclockwise from the x
    /// axis.
    ///
    /// # Errors
    /// As [`Platform::with_rotation`]; an angle that is not between 0 and 180.
    #[doc(alias = "Platform(sim, int, int, int, Vector3, float, Texture2D, int)")]
    #[expect(clippy::too_many_arguments, reason = "the thesis' constructor has these")]
    pub fn with_rotation_and_angle(
        simulator: &mut TwoHalfPhysicsSimulator,
        width: f32,
        height: f32,
        depth: f32,
        position3d: Vector3,
        rotation: f32,
        shadow_image: Option<TextureId>,
        angle_in_z_axis: i32,
    ) -> Result<PlatformId> {
        for (argument, value) in [("width", width), ("height", height), ("depth", depth)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(invalid(argument, value, "finite and greater than 0"));
            }
        }
        if !(1..180).contains(&angle_in_z_axis) {
            return Err(invalid(
                "angle_in_z_axis",
                angle_in_z_axis,
                "greater than 0 and less than 180 degrees",
            ));
        }
        let settings = Geom::default();
        let shape = SlantedBox::default();
        let platform = Platform {
            width,
            height,
            depth,
            position3d,
            rotation,
            angle_in_z_axis,
            shadow_image,
            settings,
            surface_speed: [0.0; 2],
            motion: None,
            is_one_way: false,
            pitch: 0.0,
            yaw: None,
            shape,
        };
        let platform = platform.shaped(&simulator.world.projection)?;
        simulator.world.platforms.insert(platform)
    }

    /// The platform with the shape that its numbers say.
    fn shaped(mut self, projection: &Projection) -> Result<Self> {
        let Platform { width, height, depth, position3d, rotation, angle_in_z_axis, motion, .. } = self;
        if !rotation.is_finite() {
            return Err(invalid("rotation", rotation, "finite"));
        }
        let (sin, cos) = scalar::sin_cos(rotation);
        let half = [width * 0.5, height * 0.5, depth * 0.5];
        let (turn_sin, turn_cos) = self.yaw.map_or((0.0, 1.0), scalar::sin_cos);
        self.shape = SlantedBox {
            centre: motion.map_or(self.middle(position3d), |motion| motion.centre),
            half,
            cos,
            sin,
            shear: projection.shear_of(angle_in_z_axis),
            climb: self.climb(),
            turn: [turn_cos, turn_sin],
        };
        self.check_turn()?;
        let (low, high) = self.shape.bounds();
        // Differences within the box must be finite, too.
        if !(high - low).iter().chain(low.iter()).all(|number| number.is_finite()) {
            return Err(invalid("position3d", position3d, "finite and near enough for finite corners"));
        }
        Ok(self)
    }

    /// Where its middle is at a position, in the frame of the narrow phase.
    fn middle(&self, position3d: Vector3) -> Vector3 {
        Vector3::new(position3d.x, -(position3d.y + self.height * 0.5), position3d.z)
    }

    /// At another position.
    fn at(&self, position3d: Vector3, projection: &Projection) -> Result<Self> {
        let mut platform = Platform { position3d, ..self.clone() };
        let centre = platform.middle(position3d);
        platform.motion = platform.motion.map(|motion| Motion { centre, ..motion });
        platform.shaped(projection)
    }

    /// As the 2D engine below is told of it.
    pub(crate) fn fixture(&self, id: PlatformId) -> Fixture {
        Fixture {
            id: id.number(),
            shape: self.shape,
            rotation: self.rotation,
            settings: self.settings.clone(),
            yaw: self.yaw,
            surface_velocity: self.surface_velocity(),
            motion: self.told_motion(),
            is_one_way: self.is_one_way,
        }
    }

    pub(crate) fn told_motion(&self) -> Option<FixtureMotion> {
        self.motion.map(|motion| motion.told)
    }

    /// Whether it has what only the precise set can do.
    fn is_precise(&self) -> bool {
        self.motion.is_some() || self.surface_speed != [0.0; 2] || self.is_one_way || self.is_turned_or_pitched()
    }

    fn is_turned_or_pitched(&self) -> bool {
        self.pitch != 0.0 || self.yaw.is_some()
    }

    /// An update has brought it here.
    fn has_moved(&mut self, centre: Vector3, yaw: Option<f32>, told: FixtureMotion) {
        let Some(motion) = &mut self.motion else { return };
        let has_landed = told.target.is_some_and(|(_, is_reached)| is_reached);
        if let Some(target) = motion.target.filter(|_| has_landed) {
            self.position3d = target;
        } else if centre != motion.centre {
            self.position3d = Vector3::new(centre.x, -centre.y - self.height * 0.5, centre.z);
        }
        (motion.centre, motion.told, self.shape.centre) = (centre, told, centre);
        if let Some(yaw) = yaw.filter(|_| yaw != self.yaw) {
            let (sin, cos) = scalar::sin_cos(yaw);
            (self.yaw, self.shape.turn) = (Some(yaw), [cos, sin]);
        }
        motion.target = motion.target.filter(|_| told.target.is_some());
    }
}

/// What it is.
impl Platform {
    /// Width along X in px, before it is tilted.
    pub fn width(&self) -> f32 {
        self.width
    }

    /// Height in px, before it is tilted.
    pub fn height(&self) -> f32 {
        self.height
    }

    /// Depth along Z in px.
    pub fn depth(&self) -> f32 {
        self.depth
    }

    /// X and Z of the middle of the box, and as Y the height of its underside when level.
    #[doc(alias = "Position3D")]
    pub fn position3d(&self) -> Vector3 {
        self.position3d
    }

    /// Tilt in rad, clockwise on the screen.
    #[doc(alias = "Rotation")]
    pub fn rotation(&self) -> f32 {
        self.rotation
    }

    /// Direction of its edges in depth on the screen, degrees counterclockwise from the x axis.
    pub fn angle_in_z_axis(&self) -> i32 {
        self.angle_in_z_axis
    }

    /// The picture of its shadow.
    pub fn shadow_image(&self) -> Option<TextureId> {
        self.shadow_image
    }

    /// How it collides: friction, restitution, categories, group, response.
    pub fn settings(&self) -> &Geom {
        &self.settings
    }

    /// Its velocity in the world, px/s: along X, up and along Z. One that is [told a place](PlatformMut::move_to) has that of its
    /// way there for an update.
    pub fn velocity(&self) -> Vector3 {
        self.motion.map_or(Vector3::zeros(), |motion| flipped(motion.told.velocity.into()))
    }

    /// Speed of its surface, px/s: along its level edges, and along Z.
    pub fn surface_speed(&self) -> [f32; 2] {
        self.surface_speed
    }

    /// Velocity of its surface in the world, Y up, beside that of its own motion.
    pub(crate) fn belt(&self) -> Vector3 {
        flipped(self.surface_velocity().into())
    }

    fn surface_velocity(&self) -> [f32; 3] {
        let ([along, across], SlantedBox { cos, sin, turn: [turned, aside], .. }) =
            (self.surface_speed, self.shape);
        if self.yaw.is_some() {
            [along * turned - across * aside, 0.0, along * aside + across * turned]
        } else {
            [along * cos, along * sin, across]
        }
    }

    /// Whether only what is above its top lands on it, and everything else passes through it.
    pub fn is_one_way(&self) -> bool {
        self.is_one_way
    }

    /// The eight corners in the world: of the front face (smaller Z) clockwise on the screen, before it is tilted
    /// from the top left one on; then of the back face in the same order.
    pub fn corners(&self) -> [Vector3; 8] {
        self.shape.corners().map(flipped)
    }

    /// The shape in the frame of the narrow phase.
    pub(crate) fn shape(&self) -> &SlantedBox {
        &self.shape
    }
}

/// A platform to change: what [`TwoHalfPhysicsSimulator::platform_mut`] gives. Dereferences to [`Platform`].
#[derive(Debug)]
pub struct PlatformMut<'a> {
    pub(crate) platforms: &'a mut Platforms,
    pub(crate) projection: &'a Projection,
    pub(crate) scheme: DepthScheme,
    pub(crate) index: usize,
}

impl std::ops::Deref for PlatformMut<'_> {
    type Target = Platform;
    fn deref(&self) -> &Platform {
        &self.platforms.list[self.index].1
    }
}

impl PlatformMut<'_> {
    /// Puts the platform elsewhere. Nothing is carried along: what it comes to overlap is pushed out. To move it with what
    /// stands on it: [`set_velocity`](Self::set_velocity), [`move_to`](Self::move_to).
    ///
    /// # Errors
    /// As [`Platform::new`].
    pub fn set_position3d(&mut self, position3d: Vector3) -> Result<()> {
        self.set(self.at(position3d, self.projection)?)
    }

    /// Tilts the platform about its middle, rad, clockwise on the screen.
    ///
    /// # Errors
    /// What is not finite.
    pub fn set_rotation(&mut self, rotation: f32) -> Result<()> {
        self.set(Platform { rotation, ..Platform::clone(self) }.shaped(self.projection)?)
    }

    fn set(&mut self, platform: Platform) -> Result<()> {
        self.platforms.list[self.index].1 = platform;
        (self.platforms.is_sorted, self.platforms.is_told) = (false, false);
        Ok(())
    }

    /// Lets the platform move, along X, **up** and along Z, px/s, until it is told otherwise. As a
    /// [kinematic](crate::TwoHalfBody::set_is_kinematic) body it has infinite mass: it pushes what it touches, wakes it, and carries
    /// it by friction, so that the platform and what stands on it need some. It passes through static things and other platforms.
    ///
    /// What stands on it goes down with it as fast as it falls. In a step that is half of what gravity adds to its velocity
    /// faster than before: a lift whose speed grows by more than that per step is left until what stood on it has caught up.
    ///
    /// ```
    /// use twohalf::{Platform, TwoHalfPhysicsSimulator, Vector3};
    /// let mut simulator = TwoHalfPhysicsSimulator::new(480)?;
    /// let lift = Platform::new(&mut simulator, 80.0, 10.0, 40.0, Vector3::zeros(), None)?;
    /// simulator.platform_mut(lift).unwrap().set_velocity(Vector3::new(0.0, 60.0, 0.0))?;
    /// (0..100).for_each(|_| simulator.update(0.01));
    /// assert!((simulator.platform(lift).unwrap().position3d().y - 60.0).abs() < 0.001);
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    ///
    /// # Errors
    /// What is not finite; another scheme than [`DepthScheme::Precise`].
    pub fn set_velocity(&mut self, velocity: Vector3) -> Result<()> {
        self.check_precise("moving platforms")?;
        if !velocity.iter().all(|number| number.is_finite()) {
            return Err(invalid("velocity", velocity, "finite"));
        }
        self.set_motion(flipped(velocity), None);
        Ok(())
    }

    /// Lets the next update bring the platform to a [position](Platform::position3d), where it then is to the last bit, with the
    /// velocity that does. In the update after that it stands still, unless it is told a new place or given a velocity before.
    /// A place to which no finite velocity leads is forgotten.
    ///
    /// # Errors
    /// As [`Platform::new`]; another scheme than [`DepthScheme::Precise`].
    pub fn move_to(&mut self, position3d: Vector3) -> Result<()> {
        self.check_precise("moving platforms")?;
        self.at(position3d, self.projection)?;
        let before = self.motion.map_or(Vector3::zeros(), |motion| motion.told.velocity.into());
        self.set_motion(before, Some(position3d));
        Ok(())
    }

    fn set_motion(&mut self, velocity: Vector3, target: Option<Vector3>) {
        let platform = &mut self.platforms.list[self.index].1;
        let towards = target.map(|target| (platform.middle(target).into(), false));
        let told = platform.motion.map(|motion| motion.told).unwrap_or_default();
        let FixtureMotion { way, turning, yaw_target, .. } = told;
        // What has stood still so far is something else to the engine below.
        let stood_still = platform.motion.is_none();
        platform.motion = Some(Motion {
            centre: platform.shape.centre,
            target,
            told: FixtureMotion { velocity: velocity.into(), target: towards, way, turning, yaw_target },
        });
        self.platforms.is_told &= !stood_still;
        self.platforms.is_motion_told = false;
    }

    /// Makes the surface a belt: `along` px/s along its level edges, to the right, and `depth` px/s along Z. What lies on it is
    /// carried by friction up to that speed; the sides carry as the top does. Default none.
    ///
    /// # Errors
    /// What is not finite; a platform that turns; another scheme than [`DepthScheme::Precise`].
    pub fn set_surface_speed(&mut self, along: f32, depth: f32) -> Result<()> {
        self.check_precise("belts of platforms")?;
        for (argument, value) in [("along", along), ("depth", depth)] {
            if !value.is_finite() {
                return Err(invalid(argument, value, "finite"));
            }
        }
        let platform = Platform { surface_speed: [along, depth], ..Platform::clone(self) };
        platform.check_turn()?;
        self.platforms.list[self.index].1 = platform;
        self.platforms.is_told = false;
        Ok(())
    }

    /// Opens the platform from below and from its sides: what jumps or is thrown up passes through it, and lands on its top when
    /// it comes down. What stands on it when this is switched on stays there. To drop through it, a geom leaves out its
    /// categories ([`Geom::set_collides_with`]) until it is below the top, and the platform those of the geom. Default false.
    ///
    /// # Errors
    /// True with another scheme than [`DepthScheme::Precise`].
    pub fn set_one_way(&mut self, value: bool) -> Result<()> {
        if value {
            self.check_precise("one-way platforms")?;
        }
        self.platforms.is_told &= self.is_one_way == value;
        self.platforms.list[self.index].1.is_one_way = value;
        Ok(())
    }

    fn check_precise(&self, what: &'static str) -> Result<()> {
        if self.scheme == DepthScheme::Precise { Ok(()) } else { Err(only_precise(what)) }
    }

    /// How it collides, to be changed: friction, restitution, categories, group, response.
    pub fn settings_mut(&mut self) -> &mut Geom {
        self.platforms.is_told = false;
        &mut self.platforms.list[self.index].1.settings
    }
}

/// All platforms of a simulator.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct Platforms {
    /// By id, in the order in which they were made.
    list: Vec<(PlatformId, Platform)>,
    next: u32,
    /// Derived: for the search by X.
    #[serde(skip)]
    is_sorted: bool,
    /// The precise set knows them as they are.
    #[serde(skip)]
    is_told: bool,
    /// And how those move that do.
    #[serde(skip)]
    is_motion_told: bool,
    /// Bounds along X with the index into the list, by the left one, and the greatest right one up to here.
    #[serde(skip)]
    by_left: Vec<(f32, f32, u32)>,
}

impl Platforms {
    pub(crate) fn insert(&mut self, platform: Platform) -> Result<PlatformId> {
        let id = PlatformId(self.next);
        self.next = self.next.checked_add(1).filter(|&next| next < MOST).ok_or(invalid(
            "platform",
            self.next,
            "one of fewer than 2^31 - 16",
        ))?;
        self.list.push((id, platform));
        (self.is_sorted, self.is_told) = (false, false);
        Ok(id)
    }

    pub(crate) fn remove(&mut self, id: PlatformId) -> Result<()> {
        let index = self.index_of(id).ok_or(stale("platform"))?;
        self.list.remove(index);
        (self.is_sorted, self.is_told) = (false, false);
        Ok(())
    }

    pub(crate) fn clear(&mut self) {
        self.list.clear();
        (self.is_sorted, self.is_told) = (false, false);
    }

    pub(crate) fn index_of(&self, id: PlatformId) -> Option<usize> {
        self.list.binary_search_by_key(&id, |(id, _)| *id).ok()
    }

    pub(crate) fn get(&self, id: PlatformId) -> Option<&Platform> {
        self.index_of(id).map(|index| &self.list[index].1)
    }

    pub(crate) fn iter(&self) -> impl DoubleEndedIterator<Item = (PlatformId, &Platform)> {
        self.list.iter().map(|(id, platform)| (*id, platform))
    }

    /// The precise set does not know them any more.
    pub(crate) fn tell_again(&mut self) {
        self.is_told = false;
    }

    /// Whether one has come, gone or been edited since this was asked last.
    pub(crate) fn take_changed(&mut self) -> bool {
        !std::mem::replace(&mut self.is_told, true)
    }

    /// The motions of those that move, if one was edited since this was asked last.
    pub(crate) fn edited_motions(&mut self) -> impl Iterator<Item = (PlatformId, FixtureMotion)> + '_ {
        let is_told = std::mem::replace(&mut self.is_motion_told, true);
        let edited = if is_told { &[][..] } else { &self.list };
        edited.iter().filter_map(|(id, platform)| Some((*id, platform.told_motion()?)))
    }

    /// An update has brought a platform somewhere.
    pub(crate) fn has_moved(
        &mut self,
        id: PlatformId,
        centre: Vector3,
        yaw: Option<f32>,
        told: FixtureMotion,
    ) {
        if let Some(index) = self.index_of(id) {
            self.list[index].1.has_moved(centre, yaw, told);
            self.is_sorted = false;
        }
    }

    /// Whether one has what only the precise set can do.
    pub(crate) fn are_precise(&self) -> bool {
        self.list.iter().any(|(_, platform)| platform.is_precise())
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Makes ready for [`overlapping`](Self::overlapping).
    pub(crate) fn sort(&mut self) {
        if self.is_sorted {
            return;
        }
        self.by_left.clear();
        for ((_, platform), index) in self.list.iter().zip(0..) {
            let (low, high) = platform.shape.bounds();
            self.by_left.push((low.x, high.x, index));
        }
        self.by_left.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
        let mut reach = f32::NEG_INFINITY;
        for entry in &mut self.by_left {
            reach = reach.max(entry.1);
            entry.1 = reach;
        }
        self.is_sorted = true;
    }

    /// The platforms whose box overlaps a box of the plane frame, in no particular order: those that begin before
    /// its right end, back to where none reaches it any more.
    pub(crate) fn overlapping(
        &self,
        low: Vector3,
        high: Vector3,
    ) -> impl Iterator<Item = (PlatformId, &Platform)> {
        let end = self.by_left.partition_point(|entry| entry.0 < high.x);
        let candidates = self.by_left[..end].iter().rev().take_while(move |entry| entry.1 > low.x);
        candidates.filter_map(move |&(.., index)| {
            let (id, platform) = &self.list[index as usize];
            let (box_low, box_high) = platform.shape.bounds();
            let overlap = (0..3).all(|axis| box_low[axis] < high[axis] && low[axis] < box_high[axis]);
            overlap.then_some((*id, platform))
        })
    }

    /// Arguments refused by the settings since the last update.
    pub(crate) fn take_rejected(&mut self) -> impl Iterator<Item = &'static str> + '_ {
        self.list.iter_mut().flat_map(|(_, platform)| platform.settings.take_rejected())
    }

    /// Whether everything is what the constructors could have made: false only after loading garbage. Computes the
    /// shapes anew.
    pub(crate) fn restore(&mut self, projection: &Projection) -> bool {
        (self.is_sorted, self.is_told) = (false, false);
        let in_order = self.list.windows(2).all(|pair| pair[0].0 < pair[1].0)
            && self.list.last().is_none_or(|(id, _)| id.0 < self.next);
        let are_valid = self.list.iter_mut().all(|(_, platform)| {
            let sizes = [platform.width, platform.height, platform.depth];
            let is_valid = sizes.iter().all(|size| size.is_finite() && *size > 0.0)
                && (1..180).contains(&platform.angle_in_z_axis)
                && platform.settings.is_finite()
                && platform.surface_speed.iter().all(|speed| speed.is_finite())
                && platform.motion.is_none_or(|motion| motion.is_finite());
            match platform.clone().shaped(projection) {
                Ok(shaped) if is_valid => {
                    *platform = shaped;
                    true
                }
                _ => false,
            }
        });
        in_order && are_valid
    }
}
