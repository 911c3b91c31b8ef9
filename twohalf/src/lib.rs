//! 2.5D game physics: objects with height and depth, drawn as flat sprites.
//!
//! In order of importance:
//!
//! 1. **Plausible for the player**: objects fall, slide, roll, bounce, collide and support each other as
//!   closed forms say, in all three axes.
//! 2. **The same input gives the same bits**, on every platform, also after saving and loading.
//! 3. **Equal to the 2D engine wherever nothing moves in depth**: with prisms at one Z, no ground and no
//!   platforms, every bit of the motion in X and Y is that of [`farseer_core`].
//! 4. **Cost follows the scene**: the ground needs no geoms, a platform none per object, and a settled scene
//!    allocates nothing.
//!
//! ```
//! use twohalf::{DepthProfile, TwoHalfPhysicsSimulator, Vector2, Vector3};
//! use twohalf::farseer_core::{BodyFactory, GeomPlacement, Vertices};
//!
//! // A screen of 480 px whose Z axis leans to the right.
//! let gravity = Vector2::new(0.0, 100.0);
//! let mut simulator = TwoHalfPhysicsSimulator::with_angle_and_gravity(480, 60, gravity)?;
//!
//! let ball = simulator.create_body(BodyFactory::create_circle_body(20.0, 1.0)?);
//! let outline = Vertices::create_circle(20.0, 24)?;
//! let geom = simulator.create_geom(ball, outline, GeomPlacement::default())?;
//! simulator.set_depth_profile(geom, DepthProfile::Round { radius: 20.0 })?;
//! simulator.add(ball)?;
//! simulator.add(geom)?;
//!
//! let mut view = simulator.body_mut(ball).unwrap();
//! view.ground_mut().set_object_geom(geom, None)?;
//! view.set_position3d(Vector3::new(100.0, 50.0, 30.0));
//! view.set_linear_velocity_z(20.0);
//! for _ in 0..50 {
//!     simulator.update(0.01);
//! }
//!
//! let ball = simulator.body(ball).unwrap();
//! assert!((ball.position3d().z - 40.0).abs() < 0.1);
//! assert!(ball.position3d().y < 50.0);
//! # Ok::<(), twohalf::Error>(())
//! ```
//!
//! The crate `twohalf-factories` shortens this, and `twohalf-render` draws it. [A whole game
//! loop](#a-game-loop) is below.
//!
//! # The model
//!
//! The simulator's [`DepthScheme`] chooses how contacts are found and solved. The default is the precise set
//! in three axes. Farseer's own methods with depth, and the thesis' scheme, are alternatives. The model is
//! the same with all of them.
//!
//! ## Axes and signs
//!
#![doc = include_str!("../docs/axes.svg")]
//!
//! A position in the world is (X, Y, Z) in px: X to the right, Y **up**, Z into the picture, so a larger Z is
//! farther away. The Y of [`position3d`](TwoHalfBody::position3d) is the height of the object's lowest point
//! over the ground: at Y = 0 it rests on it. [`origin3d`](TwoHalfBody::origin3d) is the body's centre of
//! mass. The two differ by the distance from it down to the lowest point, which changes while a box rotates.
//!
//! Quantities of the 2D engine keep its screen orientation: gravity (0, +g) points down, an upward
//! [`linear_velocity`](TwoHalfBody::linear_velocity) has a negative y, and rotation is clockwise on the
//! screen. [`velocity3d`](TwoHalfBody::velocity3d), [`apply_force3d`](TwoHalfBody::apply_force3d) and
//! [`apply_impulse3d`](TwoHalfBody::apply_impulse3d) are the same with Y up and with Z.
//!
//! ## Projection
//!
#![doc = include_str!("../docs/projection.svg")]
//!
//! The screen is XNA's: x right, y **down**. The Z axis points at the simulator's angle, in degrees counterclockwise
//! from the x axis, and a px of depth is always a px of height on the screen (thesis 3.1; [`Projection`] has the
//! formula). The point of the drawing:
//!
//! ```
//! use twohalf::{Projection, Vector2, Vector3};
//! let point = Vector3::new(200.0, 60.0, 150.0);
//! let at_90 = Projection::new(480, 90)?.to_screen(point);
//! assert_eq!(at_90, Vector2::new(200.0, 270.0)); // 480 - 60 - 150 = 270
//! let at_60 = Projection::new(480, 60)?.to_screen(point);
//! assert!((at_60.x - 286.6).abs() < 0.01); // 200 + 150 / tan 60°
//! assert_eq!(at_60.y, 270.0);
//! # Ok::<(), twohalf::Error>(())
//! ```
//!
//! Screen height and angle affect the drawing only: motion and contacts are the same at every angle.
//!
//! ## Objects
//!
#![doc = include_str!("../docs/shapes.svg")]
//!
//! A geom is an outline with a [`DepthProfile`]. A prism extends the outline by half its depth before and
//! behind the body's Z; a ball is a sphere. Cylinders, capsules and prisms with any convex footprint stand
//! upright, and their bodies never rotate. The area of the ground below a geom is its
//! [footprint](TwoHalfGeom::virtual_geom), the virtual geom of the thesis (3.5).
//!
//! Bodies move along X, Y and Z and rotate about the depth axis. Along Z force and impulse become velocity,
//! and velocity becomes position, with the drag of X and Y (thesis 3.3). A body whose geoms are all balls
//! about its centre has an angular velocity about [all three axes](TwoHalfBody::angular_velocity3d), so that
//! it rolls in every direction. Only the rotation about the depth axis is drawn.
//!
//! ## Contacts of two objects
//!
//! Two objects touch when their outlines overlap in X and Y **and** their extents along Z do. The contact
//! normal of a ball points from the nearest point of the other shape. The contact axis of two prisms is the
//! one that they entered **last**, on their real path in the last update:
//!
#![doc = include_str!("../docs/meeting.svg")]
//!
//! Upright shapes touch objects above, below and beside them, also along the axis entered last. Round
//! footprints slide past each other along the line of their centres.
//!
//! The axis persists while they touch. Prisms without relative motion along Z touch in X and Y, unless they
//! only stand face to face along Z. An object that rests on a face or slides along it keeps its normal on the
//! next flush face, so that seams of floors and walls are no obstacles. If no axis was entered in the last
//! update, the one of least penetration is chosen. Least penetration alone would be wrong: an object that
//! lands 5 px inside the front edge of a platform would be thrown off it.
//!
//! Restitution and friction are combined as in the 2D engine. Contacts bounce with the approach velocity,
//! without the part that gravity adds in the same step. With the faithful scheme, outlines in X and Y follow
//! the 2D engine's rule, which counts that part. Friction opposes sliding within the surface, along Z as
//! well, by Coulomb's law. [`TwoHalfPhysicsSimulator::contacts`] lists the contacts of the last update.
//! Callbacks and [events](TwoHalfPhysicsSimulator::events) have target, [`Axis`], normal and impulse, and a
//! callback can refuse a contact.
//!
//! ## Ground
//!
#![doc = include_str!("../docs/ground.svg")]
//!
//! Every body has its own [`Ground`] (thesis 3.2): the plane Y = 0 as that body meets it, with its own
//! friction and restitution. It is no geom and no other object touches it. It supports the body's **object
//! geom**, the one given to [`set_object_geom`](GroundMut::set_object_geom); a body without one falls
//! forever.
//!
//! ## Platforms
//!
#![doc = include_str!("../docs/platform.svg")]
//!
//! A [`Platform`] is a box of infinite mass (thesis 3.6): level, tilted to a slope, or sheared, so that its
//! edges in depth run at another angle on the screen than the Z axis. It may [rise along
//! Z](PlatformMut::set_pitch). A level one can be [turned](PlatformMut::set_yaw) about an upright axis, or
//! [turn](PlatformMut::set_angular_velocity) and carry objects. A platform that
//! [swings](PlatformMut::set_swing) about an upright hinge is pushed by contacts and returned by a spring.
//! Objects land on it where their footprint is above it, walk off every edge, bump into its sides, front and
//! underside, and pass under it. It is there for every object and costs nothing where no object is near.
//!
//! [`TwoHalfBody::support`] is the support of a body: ground, platform or another object.
//! [`TwoHalfBody::is_grounded`] tells whether the body can stand on it.
//! [`TwoHalfPhysicsSimulator::surface_beneath`] is the surface that a shadow falls on: ground, platform or
//! the top of another object.
//!
//! Queries with filters: objects [in a box](TwoHalfPhysicsSimulator::query_box), [ray
//! cast](TwoHalfPhysicsSimulator::ray_cast3d), [shape cast of a box](TwoHalfPhysicsSimulator::sweep_box),
//! [overlaps of a geom](TwoHalfPhysicsSimulator::overlaps_of), and objects [at a point of the
//! screen](TwoHalfPhysicsSimulator::pick_front_where).
//!
//! ## Joints, springs and ropes
//!
#![doc = include_str!("../docs/joints.svg")]
//!
//! The joints and springs of the 2D engine are created by
//! [`edit_objects`](TwoHalfPhysicsSimulator::edit_objects). With [`DepthScheme::Precise`], joints that
//! constrain a point or a line also constrain Z. Pins, sliders and linear springs act along all axes, between
//! points at the Z of their bodies, and [take](TwoHalfPhysicsSimulator::take_length) the length that they
//! have there. All of them can be edited, added and removed at any time. A joint that exceeds its greatest
//! force breaks with an [event](Event::JointBroke). `spawn_rope`, `spawn_door` and `spawn_swing_door` are in
//! the crate `twohalf-factories`. Water, wind and gravity wells with depth are [fields](Field).
//!
//! # A game loop
//!
//! A small beat-'em-up: a player who walks along X and Z and jumps, a crate to push, a ball, a platform.
//! Velocity comes from the input, everything else from the engine. Steps have one length at any frame rate,
//! so that the same input gives the same game.
//!
//! ```
//! use twohalf::farseer_core::{Body, BodyFactory, GeomPlacement, Vertices};
//! use twohalf::{
//!     BodyId, Collision, Context, DepthProfile, Drawable, EventHandler, FixedStepClock, GeomId,
//!     Interpolation3D, ContactTarget, Platform, Result, TwoHalfPhysicsSimulator, Vector2, Vector3,
//! };
//! use std::time::Duration;
//!
//! /// Length of a step: 120 per second.
//! const STEP: Duration = Duration::from_nanos(8_333_333);
//!
//! /// What the player holds down: -1 to 1 along X and Z.
//! #[derive(Clone, Copy, Default)]
//! struct Input {
//!     x: f32,
//!     z: f32,
//!     jump: bool,
//! }
//!
//! /// Handler of collisions; collects the targets that the player has touched.
//! struct Sounds {
//!     player: GeomId,
//!     met: Vec<ContactTarget>,
//! }
//!
//! impl EventHandler for Sounds {
//!     fn on_collision(&mut self, _: &mut Context<'_>, collision: &Collision) -> bool {
//!         if collision.this == self.player && !self.met.contains(&collision.partner) {
//!             self.met.push(collision.partner); // A game plays a sound.
//!         }
//!         true // `false` would let them pass through each other.
//!     }
//! }
//!
//! struct Game {
//!     simulator: TwoHalfPhysicsSimulator,
//!     player: BodyId,
//!     crate_box: BodyId,
//!     ball: BodyId,
//!     sounds: Sounds,
//!     clock: FixedStepClock,
//!     /// For pictures between two updates.
//!     interpolation: Interpolation3D,
//! }
//!
//! /// A body with one geom, which rests on its ground.
//! fn add(
//!     simulator: &mut TwoHalfPhysicsSimulator,
//!     body: Body,
//!     outline: Vertices,
//!     profile: DepthProfile,
//!     place: [f32; 3],
//! ) -> Result<(BodyId, GeomId)> {
//!     let body = simulator.create_body(body);
//!     let geom = simulator.create_geom(body, outline, GeomPlacement::default())?;
//!     simulator.set_depth_profile(geom, profile)?;
//!     simulator.geom_mut(geom).unwrap().set_friction_coefficient(0.4);
//!     simulator.add(body)?;
//!     simulator.add(geom)?;
//!     let mut view = simulator.body_mut(body).unwrap();
//!     let mut ground = view.ground_mut();
//!     ground.set_object_geom(geom, None)?; // A shadow image goes here.
//!     ground.set_friction_coefficient(0.4);
//!     view.set_position3d(Vector3::from(place));
//!     Ok((body, geom))
//! }
//!
//! impl Game {
//!     fn new() -> Result<Self> {
//!         let gravity = Vector2::new(0.0, 900.0);
//!         let mut simulator =
//!             TwoHalfPhysicsSimulator::with_angle_and_gravity(480, 60, gravity)?;
//!
//!         let mut body = BodyFactory::create_rectangle_body(30.0, 60.0, 70.0)?;
//!         body.set_moment_of_inertia(1e20)?; // The player does not topple.
//!         let outline = Vertices::create_rectangle(30.0, 60.0)?;
//!         let profile = DepthProfile::Prism { depth: 20.0 };
//!         let place = [60.0, 0.0, 80.0];
//!         let (player, player_geom) = add(&mut simulator, body, outline, profile, place)?;
//!
//!         let body = BodyFactory::create_rectangle_body(40.0, 40.0, 10.0)?;
//!         let outline = Vertices::create_rectangle(40.0, 40.0)?;
//!         let profile = DepthProfile::Prism { depth: 40.0 };
//!         let place = [140.0, 0.0, 80.0];
//!         let (crate_box, _) = add(&mut simulator, body, outline, profile, place)?;
//!
//!         let body = BodyFactory::create_circle_body(15.0, 2.0)?;
//!         let outline = Vertices::create_circle(15.0, 24)?;
//!         let profile = DepthProfile::Round { radius: 15.0 };
//!         let place = [60.0, 100.0, 160.0];
//!         let (ball, _) = add(&mut simulator, body, outline, profile, place)?;
//!
//!         // 200 px wide, 40 high and 100 deep, behind the crate.
//!         let place = Vector3::new(200.0, 0.0, 190.0);
//!         Platform::new(&mut simulator, 200.0, 40.0, 100.0, place, None)?;
//!
//!         let sounds = Sounds { player: player_geom, met: Vec::new() };
//!         let (clock, interpolation) = (FixedStepClock::new(STEP)?, Interpolation3D::new());
//!         Ok(Game { simulator, player, crate_box, ball, sounds, clock, interpolation })
//!     }
//!
//!     /// Called once per frame, with the time since the last one.
//!     fn frame(&mut self, input: Input, elapsed: Duration) {
//!         for _ in 0..self.clock.advance(elapsed) {
//!             self.step(input);
//!         }
//!     }
//!
//!     fn step(&mut self, input: Input) {
//!         let mut player = self.simulator.body_mut(self.player).unwrap();
//!         let mut velocity = player.velocity3d(); // Y is up here.
//!         (velocity.x, velocity.z) = (150.0 * input.x, 100.0 * input.z);
//!         if input.jump && player.is_grounded() {
//!             velocity.y = 350.0;
//!         }
//!         player.set_velocity3d(velocity);
//!         self.simulator.update_with(self.clock.dt(), &mut self.sounds);
//!         self.interpolation.remember(&self.simulator);
//!     }
//!
//!     /// What to draw after the backdrop, back to front.
//!     fn draw(&self) -> Vec<Drawable> {
//!         // For every body its shadow, below it at the height of `surface_beneath_body`,
//!         // smaller the higher it flies; then its sprite at `position`, turned by `rotation`.
//!         // For every platform the faces between its `corners`. The crate `twohalf-render`
//!         // has all of it, also between two updates, as `interpolation` has it.
//!         self.simulator.draw_order()
//!     }
//! }
//!
//! let mut game = Game::new()?;
//! let place = |game: &Game, body| game.simulator.body(body).unwrap().position3d();
//!
//! const FRAME: Duration = Duration::from_nanos(16_666_667);
//! // Half a second to the right, pushing the crate.
//! for _ in 0..30 {
//!     game.frame(Input { x: 1.0, ..Input::default() }, FRAME);
//! }
//! assert!(place(&game, game.crate_box).x > 150.0);
//! let crate_box = game.simulator.body(game.crate_box).unwrap();
//! let crate_geom = crate_box.ground().object_geom().unwrap();
//! assert!(game.sounds.met.contains(&ContactTarget::Geom(crate_geom)));
//!
//! // A jump into the picture, onto the platform.
//! for frame in 0..60 {
//!     game.frame(Input { z: 1.0, jump: frame == 0, ..Input::default() }, FRAME);
//! }
//! let support = game.simulator.body(game.player).unwrap().support().unwrap();
//! assert!(matches!(support.partner, ContactTarget::Platform(_)));
//! assert!((place(&game, game.player).y - 40.0).abs() < 0.1);
//!
//! // The ball has come to rest meanwhile. The crate is nearest to the viewer.
//! assert!(place(&game, game.ball).y.abs() < 0.1);
//! assert_eq!(game.draw().last(), Some(&Drawable::Body(game.crate_box)));
//! # Ok::<(), twohalf::Error>(())
//! ```
//!
//! # Characters
//!
//! The loop above sets velocities, which is enough on level ground. [`TwoHalfPhysicsSimulator::walk`] is a
//! character controller with slopes, curbs, lifts, belts, one-way platforms and walls, and jumps of a given
//! height. `twohalf-factories` makes a character in one call.
//!
//! # Limits
//!
//! - **Fast bodies may pass through each other.** With the precise scheme no body passes a static body, nor a
//!   platform or kinematic body that moves. Two dynamic bodies that both move farther per step than they are
//!   thick may miss each other, unless one is [marked](farseer_core::Body::set_is_bullet) as a bullet. At 60
//!   Hz a body 8 px thick may pass a turning platform whose side moves more than 15 px per step.
//!
//!   A bullet is stopped, but up to 1.42 % of its speed is left in the step after a hit. At 30,000 px/s and
//!   0.01 s it passes a plate of 4 px of its own mass. It may pass one of several marked bodies in a row.
//!
//!   The other schemes find contacts at the end of a step only. Along any axis, a body that moves farther per
//!   step than both bodies are thick together may miss the other. In X and Y, outlines of the 2D engine may do
//!   so at half of that. No body passes the ground, which has no underside.
//! - **Towers of equal masses move a little under a jumping character.** Four crates of 40 px with a mass of
//!   70 each carry a character of that mass that jumps once a second, 12 px beside their centres. In ten
//!   seconds they move by 0.1 px at 60 Hz and by 1.2 px at 30 Hz. Lighter ones, of 3 to 35, hardly move:
//!   bodies that carry more than one and a half times their own mass go to the [direct
//!   solver](farseer_core::IslandSolver::Direct). Islands with a ball, with a contact along Z, or with cycles
//!   and more than 24 bodies do not; their towers may fall.
//! - **Floors and walls of static bodies trip in X and Y** with the faithful scheme, as in the 2D engine.
//!   Their seams stop sliding objects, and the lower corner of a wall can hold a character that jumps against
//!   it. Build scenery of [platforms](Platform), which have no such seams.
//! - **A body that rotates freely rocks when it is pushed hard.** A new velocity in every update that presses
//!   a box against a wall, farther per step than the contact slop, tips it from corner to corner. Characters
//!   should not rotate: give them a huge moment of inertia.
//! - **A pair may have two events** with the faithful scheme after geoms were removed and added again: the 2D
//!   engine keeps Farseer's duplicate arbiters.
//! - **High stacks** fall with the faithful scheme, as in the 2D engine. Of boxes of 40 px on the ground,
//!   with default settings, six stand for 1,000 steps of 0.01 s with a gravity of 100 px/s², and seven fall.
//!   With 900 px/s² three fall. With the precise scheme twenty stand with either:
//!
//!   ```
//!   # use twohalf::farseer_core::{BodyFactory, GeomPlacement, Vertices};
//!   # use twohalf::{DepthScheme, TwoHalfPhysicsSimulator, Vector2, Vector3};
//!   # use DepthScheme::{Faithful, Precise};
//!   # fn stand(scheme: DepthScheme, boxes: usize, gravity: f32) -> bool {
//!   #     let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, gravity)).unwrap();
//!   #     simulator.set_depth_scheme(scheme).unwrap();
//!   #     let place = |i: usize| Vector3::new(100.0, 40.0 * i as f32, 30.0);
//!   #     let mut make = |i: usize| {
//!   #         let body = simulator.create_body(BodyFactory::create_rectangle_body(40.0, 40.0, 1.0)?);
//!   #         let outline = Vertices::create_rectangle(40.0, 40.0)?;
//!   #         let geom = simulator.create_geom(body, outline, GeomPlacement::default())?;
//!   #         simulator.add(body)?;
//!   #         simulator.add(geom)?;
//!   #         let mut made = simulator.body_mut(body).unwrap();
//!   #         made.ground_mut().set_object_geom(geom, None)?;
//!   #         made.set_position3d(place(i));
//!   #         Ok::<_, twohalf::Error>(body)
//!   #     };
//!   #     let column: Vec<_> = (0..boxes).map(|i| make(i).unwrap()).collect();
//!   #     (0..1000).for_each(|_| simulator.update(0.01));
//!   #     let moved = |i: usize| simulator.body(column[i]).unwrap().position3d() - place(i);
//!   #     (0..boxes).all(|i| moved(i).norm() < 10.0)
//!   # }
//!   assert!(stand(Faithful, 6, 100.0) && !stand(Faithful, 7, 100.0));
//!   assert!(!stand(Faithful, 3, 900.0));
//!   assert!(stand(Precise, 20, 100.0) && stand(Precise, 20, 900.0));
//!   ```
//! - **Only balls rotate about X and Y.** A box that hangs over the front edge of a platform does not tip
//!   over it.
//! - **Platforms move and carry only with the precise scheme**, by [`move_to`](PlatformMut::move_to) or
//!   [`set_velocity`](PlatformMut::set_velocity). A platform that
//!   [`set_position3d`](PlatformMut::set_position3d) moves pushes overlapping objects out and carries none.
//! - [`DepthScheme::Thesis`] is for comparison: objects never meet in all three axes, and contacts along Z
//!   are those of boxes, without friction.
//! - **Sprites are flat**, so three that cover each other in a circle may have no right [drawing
//!   order](TwoHalfPhysicsSimulator::draw_order).
//! - **The controllers of the 2D engine act in X and Y alone**, with every scheme. So do joints and springs
//!   with another scheme than [`DepthScheme::Precise`]. No joint is a hinge about an upright axis.

#![forbid(unsafe_code)]

mod character;
mod depth;
mod error;
mod events;
mod former_names;
mod interpolation;
mod projection;
mod shapes;
mod simulator;
mod stages;
mod texture_id;
mod views;

pub use character::{CharacterController, CharacterSettings, MoveInput};
#[allow(deprecated, reason = "the former name goes on")]
pub use depth::Methods;
pub use depth::{
    Axis, ContactTarget, DepthProfile, DepthScheme, Field, FieldId, Fluid, Ground, Platform, PlatformId,
    Region, Support, Swing, Well,
};
pub use error::{Error, Result};
pub use events::{Collision, Context, Event, EventHandler};
#[allow(deprecated, reason = "the former names go on")]
pub use former_names::{Partner, Squeeze, Walk, Walker, Wish};
pub use interpolation::{InterpolatedPose3D, Interpolation3D};
pub use projection::Projection;
pub use simulator::{
    DrawOrder, Drawable, RayHit3D, SavedTwoHalfSimulator, Surface, SweepHit3D, TwoHalfPhysicsSimulator,
};
pub use stages::StepCounters;
pub use texture_id::TextureId;
pub use views::{
    Access, AccessMut, CrushInfo, GroundMut, PlatformMut, TwoHalfBody, TwoHalfContact, TwoHalfGeom,
    VirtualGeom,
};

pub use farseer_core;
pub use farseer_core::math::{Vector2, Vector3};
pub use farseer_core::{BodyId, CollisionCategory, FixedStepClock, Footprint, GeomId, ObjectId};

/// The example of the README is run with those of the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
