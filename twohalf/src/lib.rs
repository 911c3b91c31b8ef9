//! 2.5D game physics: objects with height and depth, drawn as flat sprites.
//!
//! In order of importance:
//!
//! 1. **What a player sees is plausible**: things fall, slide, roll, bounce, meet and are stood upon as closed forms
//!    say, in all three axes.
//! 2. **The same input gives the same bits**, on every platform, also after saving and loading.
//! 3. **It is the 2D engine wherever nothing moves in depth**: with prisms at one Z, nothing on the ground and no
//!    platforms, every bit of the motion in X and Y is that of [`farseer_core`].
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
//! The crate `twohalf-factories` makes this shorter, `twohalf-render` draws it. [A whole game loop](#a-game-loop) is
//! below.
//!
//! # The model
//!
//! How contacts are found and solved is the simulator's [`DepthScheme`]. A new one has the precise set in three axes; Farseer's
//! own methods with depth beside them, and the thesis' scheme, are there to choose. The model is the same with all of them.
//!
//! ## Axes and signs
//!
#![doc = include_str!("../docs/axes.svg")]
//!
//! A position in the world is (X, Y, Z) in px: X to the right, Y **up**, Z into the picture, so a larger Z is farther
//! away. The Y of [`position3d`](TwoHalfBody::position3d) is the height of the object's lowest point over the ground:
//! at Y = 0 it rests on it. [`origin3d`](TwoHalfBody::origin3d) is the body's centre of mass; the two differ by the
//! distance from it down to the lowest point, which changes while a box turns.
//!
//! What the 2D engine has keeps its screen orientation: gravity (0, +g) pulls down, an upward
//! [`linear_velocity`](TwoHalfBody::linear_velocity) has a negative y, and rotation is clockwise on the screen.
//! [`velocity3d`](TwoHalfBody::velocity3d), [`apply_force3d`](TwoHalfBody::apply_force3d) and
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
//! Screen height and angle enter nothing else: things move and meet in the world, the same at every angle.
//!
//! ## Objects
//!
#![doc = include_str!("../docs/shapes.svg")]
//!
//! A geom is an outline with a [`DepthProfile`]: a prism, the outline extended to half its depth before and behind
//! the body's Z, or a ball; or it stands upright: a cylinder, a capsule, or a prism on end with any convex footprint, whose
//! body never turns. What it covers of the ground from above is its [footprint](TwoHalfGeom::virtual_geom),
//! which the thesis calls its virtual geom (3.5).
//!
//! Bodies move along X, Y and Z and turn about the depth axis. Along Z the same happens as in X and Y (thesis 3.3): force and
//! impulse become velocity, velocity becomes position, with the drag of X and Y. A body whose geoms are all balls about its centre has an angular velocity about
//! [all three axes](TwoHalfBody::angular_velocity3d), so that it rolls in every direction; only the one about the
//! depth axis is drawn.
//!
//! ## Where two objects meet
//!
//! Two objects touch when their outlines overlap in X and Y **and** their extents along Z do. A ball is pushed along
//! the line from the nearest point of what it touches. Two prisms are pushed apart along the axis that they entered
//! **last**, on the way that they really moved in the last update:
//!
#![doc = include_str!("../docs/meeting.svg")]
//!
//! What is upright meets everything above it, below it or beside it, along the way that it came in last as well; round footprints
//! slide past each other along the line of their middles.
//!
//! They keep it while they touch. Prisms that do not move against each other along Z meet in X and Y, unless they only
//! stand face to face along Z. What rests on a face or slides along it goes on doing so when the next one comes, so
//! that the seams of floors and walls are no obstacles. When nothing was entered just now, the smaller overlap decides.
//! The least overlap alone would be wrong: who lands 5 px inside the front edge of a platform would be thrown off it.
//!
//! Restitution and friction are combined as in the 2D engine. Things bounce with the speed with which they arrived, without what
//! gravity adds in the same step; with the faithful scheme movable outlines do so in X and Y by the 2D engine's rule, which
//! counts it. Friction acts against the direction of sliding within
//! the surface, along Z as well, by Coulomb's law. [`TwoHalfPhysicsSimulator::contacts`] lists the contacts of the
//! last update; callbacks and [events](TwoHalfPhysicsSimulator::events) tell partner, [`Axis`], normal and impulse,
//! and a callback can refuse a contact.
//!
//! ## Ground
//!
#![doc = include_str!("../docs/ground.svg")]
//!
//! Every body has its own [`Ground`] (thesis 3.2): the plane Y = 0 as that body meets it, with a friction and a
//! restitution of its own. It is no geom and no other object touches it. It holds up the body's **object geom**, the
//! one given to [`set_object_geom`](GroundMut::set_object_geom); a body without one falls for ever.
//!
//! ## Platforms
//!
#![doc = include_str!("../docs/platform.svg")]
//!
//! A [`Platform`] is a box that nothing pushes (thesis 3.6): level, tilted to a slope, or sheared, so that its edges in
//! depth run at an angle on the screen that is not the Z axis'. It may [rise along Z](PlatformMut::set_pitch), and a level one be
//! [turned](PlatformMut::set_yaw) about an upright axis, or [turn](PlatformMut::set_angular_velocity) and carry what stands on
//! it. One that [swings](PlatformMut::set_swing) about an upright hinge is pushed by what presses on it, and comes back by a spring.
//! Objects land on it where their footprint is above
//! it, walk off every edge, bump into its sides, its front and its underside, and pass under it. It is there for
//! every object and costs nothing where nobody is near.
//!
//! [`TwoHalfBody::support`] says what holds a body up, ground, platform or another object, and
//! [`TwoHalfBody::is_grounded`] whether one can stand on that. [`TwoHalfPhysicsSimulator::surface_beneath`] is
//! where a shadow falls, or somebody who walks on: ground, platform or the top of another object.
//!
//! What else a game may ask, each with a filter: what is [in a box](TwoHalfPhysicsSimulator::query_box), [on a
//! ray](TwoHalfPhysicsSimulator::ray_cast3d), [in the way of a box](TwoHalfPhysicsSimulator::sweep_box) that is moved, what
//! [overlaps a geom](TwoHalfPhysicsSimulator::overlaps_of), and what is [at a point of the
//! screen](TwoHalfPhysicsSimulator::pick_front_where).
//!
//! ## Joints, springs and ropes
//!
#![doc = include_str!("../docs/joints.svg")]
//!
//! The joints and springs of the 2D engine, made by [`edit_objects`](TwoHalfPhysicsSimulator::edit_objects). With
//! [`DepthScheme::Precise`] those that keep a point or a line keep their bodies together along Z, too; pins, sliders and linear
//! springs act along all axes, between points that are at the Z of their bodies, and
//! [take](TwoHalfPhysicsSimulator::take_length) the length that they have there. All of them can be edited, added and removed at
//! any time; what breaks because it holds too much is an [event](Event::JointBroke). `spawn_rope`, `spawn_door` and
//! `spawn_swing_door` are in the
//! crate `twohalf-factories`. Water, wind and wells of gravity with depth are [fields](Field).
//!
//! # A game loop
//!
//! A beat-'em-up in small: a player who walks along X and Z and jumps, a crate to push, a ball, a platform. Velocity
//! comes from the input, everything else from the engine. Steps have one length, whatever the frame rate is, so that
//! the same input gives the same game.
//!
//! ```
//! use twohalf::farseer_core::{Body, BodyFactory, GeomPlacement, Vertices};
//! use twohalf::{
//!     BodyId, Collision, Context, DepthProfile, Drawable, EventHandler, FixedStepClock, GeomId,
//!     Interpolation3D, Partner, Platform, Result, TwoHalfPhysicsSimulator, Vector2, Vector3,
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
//! /// Told of everything that touches; keeps what the player has met.
//! struct Sounds {
//!     player: GeomId,
//!     met: Vec<Partner>,
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
//! assert!(game.sounds.met.contains(&Partner::Geom(crate_geom)));
//!
//! // A jump into the picture, onto the platform.
//! for frame in 0..60 {
//!     game.frame(Input { z: 1.0, jump: frame == 0, ..Input::default() }, FRAME);
//! }
//! let support = game.simulator.body(game.player).unwrap().support().unwrap();
//! assert!(matches!(support.partner, Partner::Platform(_)));
//! assert!((place(&game, game.player).y - 40.0).abs() < 0.1);
//!
//! // The ball has come to rest meanwhile. The crate is nearest to the viewer.
//! assert!(place(&game, game.ball).y.abs() < 0.1);
//! assert_eq!(game.draw().last(), Some(&Drawable::Body(game.crate_box)));
//! # Ok::<(), twohalf::Error>(())
//! ```
//!
//! # Figures that walk
//!
//! The loop above sets velocities, which is enough on level ground. [`TwoHalfPhysicsSimulator::walk`] does what players expect
//! beyond that: slopes, curbs, lifts, belts, one-way platforms and walls, and jumps of a given height. `twohalf-factories` makes a figure in one
//! call.
//!
//! # Where it fails
//!
//! - **What is too fast passes through.** With the precise scheme nothing passes what stands still, nor a platform or a kinematic
//!   body that moves, but two dynamic bodies, each of which moves farther per step than it is thick, may miss each other, unless
//!   one is [marked](farseer_core::Body::set_is_bullet) as a bullet; and at 60 Hz what is 8 px thick may pass a platform that
//!   turns so fast that it goes more than 15 px per step where it hits.
//!   A bullet is stopped, but in the step after a hit up to 1.42 % of the speed is left: at 30,000 px/s and 0.01 s it passes a
//!   plate of 4 px that is as light as itself. Of several that are marked and stand in a row it may pass one. With the others
//!   contacts are looked for where things are at a step, not on the way between two: along any axis, what moves farther per step
//!   than it and the other are thick together may miss the other; in X and Y, where two outlines are the 2D engine's, already at
//!   half of that. Nothing passes the ground, which has no underside.
//! - **Towers of equal weights give way a little under who jumps on them.** Four crates of 40 px with a mass of 70 each, under a figure
//!   of that mass that jumps once a second for ten seconds, 12 px beside their middle, move by 0.1 px at 60 Hz and by 1.2 px at
//!   30 Hz. Lighter ones, of 3 to 35, hardly move at all: what bears something more than one and a half times as heavy as itself is
//!   [solved as a whole](farseer_core::IslandMethod::Whole), with all that touches both. But while a ball is among that, while
//!   something presses on it along Z, or if it is more than 24 bodies in rings, it gives way, and towers of it fall.
//! - **Floors and walls of immovable bodies trip in X and Y** with the faithful scheme, as in the 2D engine: their seams stop
//!   what slides over them, and the lower corner of a wall can hold back who jumps while leaning against it. Build scenery of
//!   [platforms](Platform): those are smooth.
//! - **What turns freely and is pushed hard rocks**: a box that is pressed against a wall by a new velocity in every
//!   update, farther per step than the contacts leave, stands on one corner after the other. Figures should not turn:
//!   give them a huge moment of inertia.
//! - **A pair may be told twice** with the faithful scheme after geoms were removed and added again: the 2D engine keeps
//!   Farseer's duplicate arbiters.
//! - **High stacks** do not stand with the faithful scheme, as in the 2D engine. Of boxes of 40 px on the ground, with the
//!   default settings, six stand for 1,000 steps of 0.01 s with a gravity of 100 px/s², seven fall; and with 900 px/s² three
//!   fall. With the precise scheme twenty stand with either:
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
//! - **Only balls turn about X and Y.** A box that hangs over the front edge of a platform does not tip over it.
//! - **Platforms move and carry only with the precise scheme**, by [`move_to`](PlatformMut::move_to) or
//!   [`set_velocity`](PlatformMut::set_velocity). One that is put elsewhere by [`set_position3d`](PlatformMut::set_position3d)
//!   pushes out what it comes to overlap, and nothing rides on it.
//! - [`DepthScheme::Thesis`] is there to compare with: nothing ever meets in all three axes, and what meets along Z is a
//!   box and has no friction.
//! - **Sprites are flat**, so there may be no right [drawing order](TwoHalfPhysicsSimulator::draw_order) for three
//!   that cover each other in a circle.
//! - **The controllers of the 2D engine act in X and Y alone**, with every scheme, and so do joints and springs with another one
//!   than [`DepthScheme::Precise`]. No joint is a hinge about an upright axis.

#![forbid(unsafe_code)]

mod depth;
mod error;
mod events;
mod interpolation;
mod projection;
mod shapes;
mod simulator;
mod stages;
mod texture_id;
mod views;
mod walk;

#[allow(deprecated, reason = "the former name goes on")]
pub use depth::Methods;
pub use depth::{
    Axis, DepthProfile, DepthScheme, Field, FieldId, Fluid, Ground, Partner, Platform, PlatformId, Region,
    Support, Swing, Well,
};
pub use error::{Error, Result};
pub use events::{Collision, Context, Event, EventHandler};
pub use interpolation::{InterpolatedPose3D, Interpolation3D};
pub use projection::Projection;
pub use simulator::{
    DrawOrder, Drawable, RayHit3D, SavedTwoHalfSimulator, Surface, SweepHit3D, TwoHalfPhysicsSimulator,
};
pub use stages::StepCounters;
pub use texture_id::TextureId;
pub use views::{
    Access, AccessMut, GroundMut, PlatformMut, Squeeze, TwoHalfBody, TwoHalfContact, TwoHalfGeom, VirtualGeom,
};
pub use walk::{Walk, Walker, Wish};

pub use farseer_core;
pub use farseer_core::math::{Vector2, Vector3};
pub use farseer_core::{BodyId, CollisionCategory, FixedStepClock, Footprint, GeomId, ObjectId};

/// The example of the README is run with those of the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
