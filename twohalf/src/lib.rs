//! 2.5D game physics: objects with height and depth, drawn as flat sprites.
//!
//! In order of importance:
//!
//! 1. **What a player sees is plausible**: things fall on the ground, slide, roll and bounce as closed forms say,
//!    at every depth.
//! 2. **The same input gives the same bits**, on every platform, also after saving and loading.
//! 3. **It is the 2D engine wherever nothing moves in depth**: with everything at one Z and nothing on the ground,
//!    every bit of the motion in X and Y is that of [`farseer_core`].
//! 4. **Cost follows the scene**: the ground needs no geoms, and a settled scene allocates nothing.
//!
//! ```
//! use twohalf::{DepthProfile, TwoHalfPhysicsSimulator, Vector2, Vector3};
//! use twohalf::farseer_core::{BodyFactory, GeomPlacement, Vertices};
//!
//! // A screen of 480 px whose Z axis leans to the right.
//! let mut simulator = TwoHalfPhysicsSimulator::with_angle_and_gravity(480, 60, Vector2::new(0.0, 100.0))?;
//!
//! let ball = simulator.create_body(BodyFactory::create_circle_body(20.0, 1.0)?);
//! let outline = simulator.create_geom(ball, Vertices::create_circle(20.0, 24)?, GeomPlacement::default())?;
//! simulator.set_depth_profile(outline, DepthProfile::Round { radius: 20.0 })?;
//! simulator.add(ball)?;
//! simulator.add(outline)?;
//!
//! let mut view = simulator.body_mut(ball).unwrap();
//! view.ground_mut().set_object_geom(outline, None)?;
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
//! The crate `twohalf-factories` makes this shorter, `twohalf-render` draws it.
//!
//! # The model
//!
//! **Axes.** A position in the world is (X, Y, Z) in px: X to the right, Y **up**, Z into the picture, so a larger
//! Z is farther away. Y is the height of the object's lowest point over the ground: Y = 0 rests on it. The screen
//! is XNA's: x right, y **down**; the ground rises on it with Z, along the simulator's angle. See [`Projection`]
//! for the formula.
//!
//! **Signs.** What the 2D engine has keeps its screen orientation: gravity (0, +g) pulls down, an upward
//! [`linear_velocity`](TwoHalfBody::linear_velocity) has a negative y, and rotation is clockwise on the screen.
//! Along Z, positive is away from the viewer.
//!
//! **Motion.** Bodies move in X, Y and Z and turn about the depth axis. X, Y and rotation are moved by the 2D
//! engine, in the world's XY plane; screen height and angle enter only the projection. Along Z the same happens
//! beside it (thesis 3.3): force and impulse become velocity, velocity becomes position, with the drag of X and Y.
//! The 2D methods are Farseer's own, with its sequential impulses; [`TwoHalfPhysicsSimulator::from_core`] takes
//! others.
//!
//! **Objects.** A geom is an outline with a [`DepthProfile`]: extruded, or a ball. Two of them meet in X and Y while
//! they overlap in depth, and otherwise pass each other.
//!
//! **Ground.** Every body has its own [`Ground`], which holds its object geom up at Y = 0, with restitution and
//! friction combined as those of two geoms. Friction acts against the direction of sliding in X and Z. A ball
//! rolls in both directions: at its point of contact it also has an angular velocity about the x axis, which is not
//! drawn.
//!
//! # Not there yet
//!
//! - **Contacts along Z.** An object that comes to another one from the front or from behind, so that the boxes of
//!   the two overlap in X and Y before they overlap in depth, passes through until the boxes have parted. Balls
//!   meet each other and boxes like cylinders along Z.
//! - Platforms, virtual geoms, springs and joints, cloning; queries by points of the screen; callbacks for the
//!   ground. Handlers see the 2D engine, and Z not at all; what moves along Z alone is not reported as
//!   [updated](Event::BodyUpdated).
//! - Sleep, and methods that are more accurate than Farseer's.

mod body;
mod contacts;
mod depth;
mod draw_order;
mod error;
mod events;
mod geom;
mod ground;
mod methods;
mod pairs;
mod platform;
mod projection;
mod queries;
mod save;
mod shapes;
mod simulator;
mod slots;
mod solver;
mod step;
mod support;
mod tell;
mod texture_id;
mod touch;
mod view;
mod virtual_geom;
mod world;

pub use body::TwoHalfBody;
pub use contacts::TwoHalfContact;
pub use depth::DepthProfile;
pub use draw_order::Drawable;
pub use error::{Error, Result};
pub use events::{Collision, Context, Event, EventHandler};
pub use geom::TwoHalfGeom;
pub use ground::{Ground, GroundMut};
pub use methods::{Axis, Methods, Partner};
pub use platform::{Platform, PlatformId, PlatformMut};
pub use projection::Projection;
pub use queries::Surface;
pub use simulator::TwoHalfPhysicsSimulator;
pub use step::StepCounters;
pub use support::Support;
pub use texture_id::TextureId;
pub use view::{Access, AccessMut};
pub use virtual_geom::VirtualGeom;

pub use farseer_core;
pub use farseer_core::math::{Vector2, Vector3};
pub use farseer_core::{BodyId, CollisionCategory, GeomId, ObjectId};
