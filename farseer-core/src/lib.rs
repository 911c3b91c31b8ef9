//! 2D rigid body physics: Farseer Physics 2.1.3 exact to the bit, and a more accurate engine behind the same API.
//!
//! Farseer Physics (2009) was the 2D physics engine of the XNA years. The [faithful](Methods::Faithful) set of methods
//! reproduces all of it, number by number, behind an API its users recognise: bodies and geoms, joints, springs,
//! controllers, paths, polygon tools, the debug view. The [precise](Methods::Precise) set is an engine of its own for the
//! same objects: faster, more accurate, with sleep and continuous collision detection. The goals of the crate, in this order:
//!
//! 1. **exact**: given the same calls, every position, velocity and callback of the faithful set is that of the original,
//!    on every platform, in every build. The precise set gives the same bits on all of them, too.
//! 2. **safe**: bad input is an error that names the argument, a failed call changes nothing, NaN never spreads,
//!    stale ids are refused.
//! 3. **fast**: flat arrays that are reused, no allocation in a settled scene, SIMD lanes wherever they change no bit.
//!
//! | in this manual | |
//! |---|---|
//! | this page | [first program](#a-first-program), [the update](#what-an-update-does), [methods to choose from](#methods-to-choose-from), [where they fail](#where-they-fail), [joints, springs, controllers](#joints-springs-controllers), [units](#units-and-axes), [bad input](#bad-input), [determinism](#determinism), [saving](#saving) |
//! | [`guide::new_games`] | games that are no ports: bodies with their geoms in one call, typed events, queries with filters, a character |
//! | [`guide::five_tasks`] | a pile, a figure with a servo, a platform with a character, sounds of hits, one-way ledges |
//! | [`guide::porting`] | from C# to Rust, member by member, with a small game before and after |
//! | [`guide::choosing`] | which set of methods for which game, the solver selection of the precise set, and limits of each |
//! | [`guide::differences`] | differences from the original, and their reasons |
//! | [`guide::quirks`] | oddities of the original that were kept, and workarounds |
//! | [`guide::out_of_scope`] | features left out on purpose, and replacements |
//!
//! # A first program
//!
//! ```
//! use farseer_core::{
//!     BodyFactory, GeomFactory, GeomPlacement, PhysicsSimulator, math::Vector2,
//! };
//!
//! // Pixels and seconds; y points down, as on the screen.
//! let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 150.0))?;
//!
//! let floor = BodyFactory::create_rectangle_body_in(&mut simulator, 400.0, 20.0, 1.0)?;
//! simulator[floor].set_is_static(true);
//! simulator[floor].set_position(Vector2::new(0.0, 200.0));
//! GeomFactory::create_rectangle_geom_in(
//!     &mut simulator, floor, 400.0, 20.0, GeomPlacement::default(),
//! )?;
//!
//! let ball = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0)?;
//! let geom = GeomFactory::create_circle_geom_in(
//!     &mut simulator, ball, 10.0, 16, GeomPlacement::default(),
//! )?;
//! simulator[geom].set_restitution_coefficient(0.5);
//!
//! for _ in 0..500 {
//!     simulator.update(0.01);
//! }
//! assert!((simulator[ball].position().y - 180.0).abs() < 0.5);
//! # Ok::<(), farseer_core::Error>(())
//! ```
//!
//! A [`Body`] has mass, pose and velocity; a [`Geom`] is an outline on a body, with friction, restitution and a collision
//! filter. A body may have any number of geoms, or none. Both live in the [`PhysicsSimulator`] under ids, as joints, springs
//! and controllers do. [Factories](BodyFactory) make the usual ones; methods ending in `_in` also add them. An
//! [added](PhysicsSimulator::add) object takes part from the next update on.
//!
//! # What an update does
//!
//! [`PhysicsSimulator::update`] is a list of stages, each of which can be called on its own by engines built on top:
//!
//! | stage | what happens | chosen by |
//! |---|---|---|
//! | [`process_queues`](PhysicsSimulator::process_queues) | objects enter and leave | |
//! | [`find_pairs`](PhysicsSimulator::find_pairs) | broad phase: pairs of overlapping bounding boxes | [`BroadPhaseCollider`] |
//! | [`collide_pairs`](PhysicsSimulator::collide_pairs) | narrow phase: contacts of the pairs; callbacks | [`NarrowPhaseCollider`] |
//! | [`apply_forces`](PhysicsSimulator::apply_forces) | controllers, then springs; then impulses, gravity and drag change velocities | [`ControllerKind`], [`SpringKind`] |
//! | [`pre_step`](PhysicsSimulator::pre_step) | joints, then contacts are prepared; warm start: the impulses of the last update act again | [`FrictionType`] |
//! | [`solve_iteration`](PhysicsSimulator::solve_iteration) | joints, then contacts apply impulses (normal and friction); repeated | [`JointKind`], [`iterations`](PhysicsSimulator::set_iterations) |
//! | [`integrate`](PhysicsSimulator::integrate) | velocities change positions; geoms follow | |
//!
//! So contacts are those of the poses at the end of the last update, and forces that are set between two updates act in the
//! next one. Objects act in the order of their lists; pairs in the order in which the broad phase found them.
//!
//! [`update_with`](PhysicsSimulator::update_with) calls an [`EventHandler`] back from these stages;
//! [`events`](PhysicsSimulator::events) lists the events afterwards. Between the stages an engine on top may
//! [filter pairs](EventHandler::accepts_pair), take [arbiters](PhysicsSimulator::leave_to_engine) over and work on
//! the solver's [velocities](PhysicsSimulator::solver_place).
//!
//! # Methods to choose from
//!
//! The defaults are the original's. [`Methods`] are all of them in one value; each has a setter of its own, too. Figures on
//! this page were measured with this crate; the tests measure the figures in code again.
//!
//! ## Faithful or precise
//!
//! [`Methods::Faithful`], the default, is the original to the bit: for games that were balanced with it.
//! [`Methods::Precise`] takes the same bodies, geoms, joints, springs, controllers and handlers, and is faster and more
//! accurate: for all other games. [`settings`](guide::settings) lists the effect of every setting on it. The set can be changed
//! between updates, at any time; [a page](guide::choosing) compares the two.
//!
//! ```
//! use farseer_core::{BodyFactory, GeomFactory, GeomPlacement, Methods, PhysicsSimulator, math::Vector2};
//! /// How far the top of a column of ten boxes has sunk after ten seconds; its height is 320.
//! fn sunk(methods: Methods, iterations: i32) -> farseer_core::Result<f32> {
//!     let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 320.0))?;
//!     simulator.set_methods(methods)?;
//!     simulator.set_iterations(iterations);
//!     let floor = BodyFactory::create_rectangle_body_in(&mut simulator, 400.0, 20.0, 1.0)?;
//!     simulator[floor].set_is_static(true);
//!     simulator[floor].set_position(Vector2::new(0.0, 10.0));
//!     let mut geoms = vec![GeomFactory::create_rectangle_geom_in(&mut simulator, floor, 400.0, 20.0, GeomPlacement::default())?];
//!     let mut top = floor;
//!     for i in 0..10 {
//!         top = BodyFactory::create_rectangle_body_in(&mut simulator, 32.0, 32.0, 1.0)?;
//!         simulator[top].set_position(Vector2::new(0.0, -16.0 - 32.0 * i as f32));
//!         geoms.push(GeomFactory::create_rectangle_geom_in(&mut simulator, top, 32.0, 32.0, GeomPlacement::default())?);
//!     }
//!     geoms.into_iter().for_each(|geom| simulator[geom].set_friction_coefficient(0.5));
//!     (0..600).for_each(|_| simulator.update(1.0 / 60.0));
//!     Ok(simulator[top].position().y + 304.0)
//! }
//! assert!(sunk(Methods::default(), 5)? > 32.0, "fallen, or sunk by more than a box");
//! assert!(sunk(Methods::PRECISE, 4)? < 0.32, "less than a thousandth of its height");
//! # Ok::<(), farseer_core::Error>(())
//! ```
//!
//! ## Broad phase
//!
//! [`set_broad_phase_collider`](PhysicsSimulator::set_broad_phase_collider), before geoms are added. All four find the
//! pairs whose boxes overlap, but not in the same order. The order decides digits, and in the long run where things end up:
//! do not change it in a game that is balanced.
//!
//! | method | good for | not so good when |
//! |---|---|---|
//! | [`SelectiveSweep`](BroadPhaseCollider::SelectiveSweep), the default | everything; scenes that spread along one axis | crowds overlap along both axes: all pairs that overlap along the better axis are tested |
//! | [`SweepAndPrune`](BroadPhaseCollider::SweepAndPrune) | slow scenes: sorted lists are kept from update to update | geoms come and go: whenever one leaves, all pairs are dropped, and contacts persist only while the geoms touch |
//! | [`SpatialHash`](BroadPhaseCollider::SpatialHash) | many geoms of about one size | sizes differ: cells are twice the mean longer side, and a floor is entered in every cell it covers |
//! | [`BruteForce`](BroadPhaseCollider::BruteForce) | a few dozen geoms; comparing | n geoms are n (n - 1) / 2 pairs: 499,500 for 1,000. The only one that never [doubles a pair](guide::quirks#pairs-and-contacts) when a geom is removed |
//!
//! ## Narrow phase
//!
//! [`set_narrow_phase_collider`](PhysicsSimulator::set_narrow_phase_collider), before geoms are **made**.
//!
//! | method | how | good for | fails |
//! |---|---|---|---|
//! | [`DistanceGrid`](NarrowPhaseCollider::DistanceGrid), the default | a grid of distances to each outline, made once; the vertices of each geom are looked up in the grid of the other. Every contact has its own depth | any simple outline, also concave | on outlines thinner than a cell; on outlines that cross without a vertex in the other; at half the speed of the other (see [walls](#walls)) |
//! | [`Sat`](NarrowPhaseCollider::Sat) | separating axes: one per edge. All contacts of a pair have one depth | convex outlines; stacks; fast bodies; no memory per geom | on concave outlines: notches count as solid. Cut them with [`create_sat_polygon_geom_in`](GeomFactory::create_sat_polygon_geom_in) |
//!
//! A ball in a cup shows the concave case, and a thin bar the cell size. The default cell size is a tenth of the shorter side
//! of the geom's bounding box *in the world* at its creation:
//!
//! ```
//! # use farseer_core::{BodyFactory, GeomFactory, GeomPlacement, NarrowPhaseCollider, PhysicsSimulator, Vertices, math::Vector2};
//! # fn resting_height(narrow_phase: NarrowPhaseCollider) -> farseer_core::Result<f32> {
//! #     let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 100.0))?;
//! #     simulator.set_narrow_phase_collider(narrow_phase);
//! #     let corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 40.0), (90.0, 40.0), (90.0, 0.0), (100.0, 0.0), (100.0, 50.0), (0.0, 50.0)];
//! #     let mut cup: Vertices = corners.iter().map(|&(x, y)| Vector2::new(x, y)).collect();
//! #     cup.sub_divide_edges(5.0)?;
//! #     let body = BodyFactory::create_polygon_body_in(&mut simulator, &cup, 1.0)?;
//! #     simulator[body].set_is_static(true);
//! #     GeomFactory::create_polygon_geom_in(&mut simulator, body, &mut cup, GeomPlacement::default())?;
//! #     let ball = BodyFactory::create_circle_body_in(&mut simulator, 5.0, 1.0)?;
//! #     simulator[ball].set_position(Vector2::new(50.0, 20.0));
//! #     GeomFactory::create_circle_geom_in(&mut simulator, ball, 5.0, 16, GeomPlacement::default())?;
//! #     (0..300).for_each(|_| simulator.update(0.01));
//! #     Ok(simulator[ball].position().y)
//! # }
//! // The cup is open on top, from y = 0 down to its bottom at 40; the ball has a radius of 5.
//! assert!(
//!     (resting_height(NarrowPhaseCollider::DistanceGrid)? - 35.0).abs() < 0.1,
//!     "on the bottom"
//! );
//! assert!(
//!     (resting_height(NarrowPhaseCollider::Sat)? + 5.0).abs() < 0.1,
//!     "on the brim, as if there were a lid"
//! );
//!
//! # let mut simulator = PhysicsSimulator::default();
//! // A bar of 100 by 4 on a body that is turned by 45 degrees: a cell is thicker than the bar.
//! let body = BodyFactory::create_rectangle_body_in(&mut simulator, 100.0, 4.0, 1.0)?;
//! simulator[body].set_rotation(std::f32::consts::FRAC_PI_4);
//! let bar = GeomFactory::create_rectangle_geom_in(
//!     &mut simulator, body, 100.0, 4.0, GeomPlacement::default(),
//! )?;
//! assert!(simulator.geom(bar).unwrap().grid_cell_size() > 7.0);
//! // Better: a cell size.
//! let placement = GeomPlacement::with_grid_size(0.5);
//! let bar =
//!     GeomFactory::create_rectangle_geom_in(&mut simulator, body, 100.0, 4.0, placement)?;
//! assert_eq!(simulator.geom(bar).unwrap().grid_cell_size(), 0.5);
//! # Ok::<(), farseer_core::Error>(())
//! ```
//!
//! ## Friction
//!
//! [`set_friction_type`](PhysicsSimulator::set_friction_type). Friction is Coulomb's: the tangential impulse is at most the
//! coefficient times the normal impulse. A geom's own coefficient is 0 unless it is set.
//!
//! | type | coefficient of a pair | good for |
//! |---|---|---|
//! | [`Average`](FrictionType::Average), the default | the mean | one coefficient per material; ice under a rubber tyre still grips |
//! | [`Minimum`](FrictionType::Minimum) | the smaller one | materials that are slippery on every other material |
//!
//! It is read when the boxes of two geoms begin to overlap; setting it later acts on later pairs. Restitution is always the
//! mean, and read in every update.
//!
//! ## Iterations and the other settings
//!
//! | setting | default | effect of a greater value |
//! |---|---|---|
//! | [`iterations`](PhysicsSimulator::set_iterations) | 5 | firmer stacks and chains; time in proportion |
//! | [`max_contacts_to_detect`](PhysicsSimulator::set_max_contacts_to_detect) | 10 | finds the deepest contacts of outlines with many vertices; a smaller value is faster and less accurate |
//! | [`max_contacts_to_resolve`](PhysicsSimulator::set_max_contacts_to_resolve) | 4 | rarely useful: the deepest come first |
//! | [`bias_factor`](PhysicsSimulator::set_bias_factor) | 0.8 | fraction of the penetration that an update corrects: penetration vanishes faster; a smaller value is softer |
//! | [`allowed_penetration`](PhysicsSimulator::set_allowed_penetration) | 0.05 | penetration that is not corrected, so that contacts persist. In length units: set it if yours are metres |
//!
//! # Where they fail
//!
//! The methods of the faithful set fail where the original's did. Remedies are smaller steps, more iterations, another method,
//! or a change of the scene.
//!
//! ## Walls
//!
//! A body that moves too far per update crosses the middle of a wall and is pushed out on the far side (tunnelling). The table
//! has the first whole number of length units per update at which one of 100 balls or boxes, started at 100 places, got
//! through:
//!
//! | wall | body | distance grid, ball | distance grid, box | SAT, ball |
//! |---|---|---|---|---|
//! | 20 | 20 | 12 | 12 | 20 |
//! | 20 | 10 | 11 | 10 | 16 |
//! | 40 | 20 | 21 | 20 | 31 |
//! | 10 | 20 | 12 | 12 | 16 |
//! | 4 | 20 | 6 | 9 | 12 |
//!
//! So stay below a **quarter** of both thicknesses together with the distance grid, and below **half** of them with SAT.
//! With dt = 0.01 and walls and bodies of 20 that is a speed of 1,000 or 2,000.
//!
//! ```
//! # use farseer_core::{BodyFactory, GeomFactory, GeomPlacement, NarrowPhaseCollider, PhysicsSimulator, math::Vector2};
//! # fn balls_through(narrow_phase: NarrowPhaseCollider, per_update: f32) -> usize {
//! #     let passes = |phase: usize| {
//! #         let mut simulator = PhysicsSimulator::default();
//! #         simulator.set_narrow_phase_collider(narrow_phase);
//! #         let wall = BodyFactory::create_rectangle_body_in(&mut simulator, 20.0, 200.0, 1.0)?;
//! #         simulator[wall].set_is_static(true);
//! #         GeomFactory::create_rectangle_geom_in(&mut simulator, wall, 20.0, 200.0, GeomPlacement::default())?;
//! #         let ball = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0)?;
//! #         simulator[ball].set_position(Vector2::new(-100.0 - per_update * phase as f32 / 20.0, 3.0));
//! #         simulator[ball].set_linear_drag_coefficient(0.0);
//! #         simulator[ball].set_linear_velocity(Vector2::new(per_update * 100.0, 0.0));
//! #         GeomFactory::create_circle_geom_in(&mut simulator, ball, 10.0, 16, GeomPlacement::default())?;
//! #         (0..50).for_each(|_| simulator.update(0.01));
//! #         Ok::<_, farseer_core::Error>(simulator[ball].position().x > 15.0)
//! #     };
//! #     (0..20).filter(|&phase| passes(phase).unwrap()).count()
//! # }
//! // A wall of 20 and twenty balls of radius 10, each a little farther away.
//! assert_eq!(balls_through(NarrowPhaseCollider::DistanceGrid, 10.0), 0);
//! assert!(balls_through(NarrowPhaseCollider::DistanceGrid, 20.0) > 0);
//! assert_eq!(balls_through(NarrowPhaseCollider::Sat, 19.0), 0);
//! assert!(balls_through(NarrowPhaseCollider::Sat, 30.0) > 0);
//! ```
//!
//! ## Stacks
//!
//! The column of the example below, which is not that of the stability map. It has equal boxes of 20 with friction 0.5 on a
//! floor, gravity 100, 1,000 updates of 0.01. Heights of 3 to 10, 12, 15 and 20 boxes were tried:
//!
//! | iterations | distance grid: stand | fall | SAT: stand | fall |
//! |---|---|---|---|---|
//! | 5 | 8 | 9 | 15 | 20 |
//! | 10 | 12 | 15 | 15 | 20 |
//! | 20 | 12 | 15 | 20 | |
//! | 40 | 15 | 20 | 20 | |
//!
//! And a heavy box on a light one: 10 times the mass stands, 50 times slips off with 5 iterations, and stands with 20.
//!
//! ```
//! # use farseer_core::{BodyFactory, GeomFactory, GeomPlacement, NarrowPhaseCollider, PhysicsSimulator, math::Vector2};
//! # use NarrowPhaseCollider::{DistanceGrid, Sat};
//! # fn stands(narrow_phase: NarrowPhaseCollider, iterations: i32, masses: &[f32]) -> bool {
//! #     let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 100.0)).unwrap();
//! #     simulator.set_narrow_phase_collider(narrow_phase);
//! #     simulator.set_iterations(iterations);
//! #     let mut make = |width: f32, height: f32, mass: f32, y: f32| {
//! #         let body = BodyFactory::create_rectangle_body_in(&mut simulator, width, height, mass)?;
//! #         simulator[body].set_position(Vector2::new(0.0, y));
//! #         let geom = GeomFactory::create_rectangle_geom_in(&mut simulator, body, width, height, GeomPlacement::default())?;
//! #         simulator[geom].set_friction_coefficient(0.5);
//! #         Ok::<_, farseer_core::Error>(body)
//! #     };
//! #     let floor = make(2000.0, 100.0, 1.0, 50.0).unwrap();
//! #     let middle = |i: usize| -10.0 - 20.0 * i as f32;
//! #     let boxes: Vec<_> = masses.iter().enumerate().map(|(i, &mass)| make(20.0, 20.0, mass, middle(i)).unwrap()).collect();
//! #     simulator[floor].set_is_static(true);
//! #     (0..1000).for_each(|_| simulator.update(0.01));
//! #     boxes.iter().enumerate().all(|(i, &body)| (simulator[body].position().y - middle(i)).abs() < 5.0)
//! # }
//! # let boxes = |n| vec![1.0; n];
//! assert!(stands(DistanceGrid, 5, &boxes(8)) && !stands(DistanceGrid, 5, &boxes(9)));
//! assert!(stands(DistanceGrid, 40, &boxes(15)));
//! assert!(stands(Sat, 5, &boxes(15)) && !stands(Sat, 5, &boxes(20)));
//! assert!(stands(DistanceGrid, 5, &[1.0, 10.0]) && !stands(DistanceGrid, 5, &[1.0, 50.0]));
//! assert!(stands(DistanceGrid, 20, &[1.0, 50.0]));
//! ```
//!
//! ## Chains
//!
//! Joints apply impulses, too, and the [bias factor](Joint::set_bias_factor) corrects their error: 0.2, or 0.8 for joints to
//! the world. With few iterations the impulses do not propagate far enough along long chains, and the chains swing up. For
//! example, bodies of 20 hang straight down on revolute joints, with 5 iterations. Six of them stay at rest for 1,000 updates;
//! ten get faster and faster. Ten stay at rest with 10 iterations, or with a softness of 0.05 in every joint. Chains of
//! [`ComplexFactory`] have a softness of 0.05 and a bias factor of 0.01.
//!
//! ```
//! # use farseer_core::{BodyFactory, BodyId, JointFactory, PhysicsSimulator, math::Vector2};
//! # fn stretch(links: usize, iterations: i32, softness: f32) -> f32 {
//! #     let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 100.0)).unwrap();
//! #     simulator.set_iterations(iterations);
//! #     let mut above: Option<BodyId> = None;
//! #     for i in 0..links {
//! #         let top = Vector2::new(0.0, 20.0 * i as f32);
//! #         let body = BodyFactory::create_rectangle_body_in(&mut simulator, 10.0, 20.0, 1.0).unwrap();
//! #         simulator[body].set_position(top + Vector2::new(0.0, 10.0));
//! #         let joint = match above {
//! #             Some(above) => JointFactory::create_revolute_joint_in(&mut simulator, above, body, top),
//! #             None => JointFactory::create_fixed_revolute_joint_in(&mut simulator, body, top),
//! #         };
//! #         simulator[joint.unwrap()].set_softness(softness).unwrap();
//! #         above = Some(body);
//! #     }
//! #     (0..1000).for_each(|_| simulator.update(0.01));
//! #     let lowest = simulator.body_list()[links - 1];
//! #     (simulator[lowest].position().y - (20.0 * links as f32 - 10.0)).abs()
//! # }
//! // Links, iterations, softness: how far the lowest body is from where it began.
//! assert!(stretch(6, 5, 0.0) < 0.01);
//! assert!(stretch(10, 5, 0.0) > 1000.0);
//! assert!(stretch(10, 10, 0.0) < 0.01);
//! assert!(stretch(10, 5, 0.05) < 0.5);
//! ```
//!
//! ## Springs and drag
//!
//! A spring of constant k and damping d on a mass m is stable while `k dt² / m + 2 d dt / m < 4`; beyond that its amplitude
//! grows without bound. Linear drag c is stable while `c dt / m < 2`. With dt = 0.01 and mass 1: an undamped constant below
//! 40,000, a drag below 200.
//!
//! ```
//! # use farseer_core::{BodyFactory, FixedLinearSpring, PhysicsSimulator, SpringFactory, math::Vector2};
//! # fn swing(spring_constant: f32, damping_constant: f32) -> f32 {
//! #     let mut simulator = PhysicsSimulator::default();
//! #     let body = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0).unwrap();
//! #     simulator[body].set_linear_drag_coefficient(0.0);
//! #     let (here, there) = (Vector2::new(0.0, 0.0), Vector2::new(100.0, 0.0));
//! #     let spring = SpringFactory::create_fixed_linear_spring_in(
//! #         &mut simulator, body, here, there, spring_constant, damping_constant,
//! #     ).unwrap();
//! #     simulator.spring_as_mut::<FixedLinearSpring>(spring).unwrap().set_rest_length(99.0).unwrap();
//! #     let mut farthest = 0.0_f32;
//! #     for _ in 0..1000 {
//! #         simulator.update(0.01);
//! #         farthest = farthest.max(simulator[body].position().x.abs());
//! #     }
//! #     farthest
//! # }
//! // A spring that is 1 too long, dt = 0.01, mass 1: how far the body gets.
//! assert!(swing(39_000.0, 0.0) < 10.0);
//! assert!(swing(41_000.0, 0.0) > 1e6);
//! assert!(swing(100.0, 199.0) < 1.5);
//! assert!(swing(100.0, 205.0) > 1e6);
//! ```
//!
//! ## Far from the origin
//!
//! Numbers are `f32`: at 100,000 they are 1/128 apart, at 1,000,000 1/16. A body there that goes 0.01 per update does not move
//! at all. Stay within some ten thousands, or move the world.
//!
//! ```
//! # use farseer_core::{BodyFactory, PhysicsSimulator, math::Vector2};
//! # fn way(x: f32) -> f32 {
//! #     let mut simulator = PhysicsSimulator::default();
//! #     let body = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0).unwrap();
//! #     simulator[body].set_position(Vector2::new(x, 0.0));
//! #     simulator[body].set_linear_drag_coefficient(0.0);
//! #     simulator[body].set_linear_velocity(Vector2::new(1.0, 0.0));
//! #     (0..200).for_each(|_| simulator.update(0.01));
//! #     simulator[body].position().x - x
//! # }
//! // How far a body of speed 1 gets in two seconds.
//! assert!((way(0.0) - 2.0).abs() < 0.001);
//! assert_eq!(way(100_000.0), 1.5625);
//! assert_eq!(way(1_000_000.0), 0.0);
//! ```
//!
//! # Joints, springs, controllers
//!
//! Joints constrain bodies by impulses in every iteration. Springs apply a force per update. Controllers run before both in
//! every update and may change any object. Each kind has its type; [`joint_as`](PhysicsSimulator::joint_as),
//! [`spring_as`](PhysicsSimulator::spring_as) and [`controller_as`](PhysicsSimulator::controller_as) return it.
//!
//! | joint | constrains | between |
//! |---|---|---|
//! | [`RevoluteJoint`] | a common point: a hinge | two bodies |
//! | [`FixedRevoluteJoint`] | a point of the body at a point of the world | body and world |
//! | [`PinJoint`] | two points at a distance: a rod | two bodies |
//! | [`SliderJoint`] | two points in a range of distances: a rope, a telescope | two bodies |
//! | [`WeldJoint`] | a common point and the angle | two bodies |
//! | [`PrismaticJoint`] | a line and the angle: a piston, a lift; under the precise set | two bodies |
//! | [`WheelJoint`] | a point on a sprung line: a wheel with suspension; under the precise set | two bodies |
//! | [`AngleSpringJoint`] | nothing: a damped spring between the angles; under the precise set | two bodies |
//! | [`MotorJoint`] | nothing: bounded force to a relative pose; under the precise set | two bodies |
//! | [`GearJoint`] | an angle to a multiple of another; under the precise set | two bodies |
//! | [`PulleyJoint`] | two lengths of a rope over two pulleys; under the precise set | two bodies |
//! | [`AngleJoint`], [`FixedAngleJoint`] | an angle | two bodies, body and world |
//! | [`AngleLimitJoint`], [`FixedAngleLimitJoint`] | an angle in a range | two bodies, body and world |
//!
//! | spring | pulls | between |
//! |---|---|---|
//! | [`LinearSpring`], [`FixedLinearSpring`] | two points to a distance | two bodies, body and world |
//! | [`AngleSpring`], [`FixedAngleSpring`] | to an angle | two bodies, body and world |
//!
//! | controller | does |
//! |---|---|
//! | [`FluidDragController`] | buoyancy and drag in an [`AabbFluidContainer`], a wave, or a container of the game |
//! | [`WaveController`] | a water surface with waves |
//! | [`GravityController`] | points and bodies attract |
//! | [`InactivityController`] | disables bodies that are slow for long, and wakes them when others come near |
//! | [`ScalingController`] | proposes longer steps when the machine is slow |
//! | [`UserController`] | code of the game: wind, magnets, currents |
//!
//! Joints and springs with a [`breakpoint`](Joint::set_breakpoint) break. [`ComplexFactory`] and [`Path`] make rows of
//! bodies linked by joints or springs: chains, ropes, bridges, tracks. [`MousePicker`] drags bodies by a spring.
//!
//! ```
//! use farseer_core::{BodyFactory, Event, JointFactory, PhysicsSimulator, math::Vector2};
//!
//! let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 100.0))?;
//! let lamp = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0)?;
//! simulator[lamp].set_position(Vector2::new(50.0, 0.0));
//! let hook = JointFactory::create_fixed_revolute_joint_in(
//!     &mut simulator, lamp, Vector2::new(0.0, 0.0),
//! )?;
//! simulator[hook].set_breakpoint(2.0)?;
//! for _ in 0..200 {
//!     simulator.update(0.01);
//! }
//! assert!(simulator[hook].enabled(), "the lamp swings");
//!
//! simulator[lamp].apply_impulse(Vector2::new(0.0, 9000.0));
//! for _ in 0..3 {
//!     simulator.update(0.01);
//!     if simulator.events().contains(&Event::JointBroke { joint: hook }) {
//!         break;
//!     }
//! }
//! assert!(!simulator[hook].enabled(), "torn off");
//! # Ok::<(), farseer_core::Error>(())
//! ```
//!
//! # Units and axes
//!
//! Lengths are in the user's unit (pixels or metres), times in seconds, angles in radians, masses in any unit; be consistent.
//! Axes are those of the screen: x right, y down, so that positive angles turn clockwise to the eye. Some
//! defaults fit pixels: the allowed penetration of 0.05, the inactivity controller's distances and speeds, the slop of 0.01
//! of limit joints, the sizes of the debug view. [`ConvertUnits`](math::ConvertUnits) converts.
//!
//! # Bad input
//!
//! - Constructors and structural setters return a [`Result`]; the [`Error`] names argument and value, and nothing has
//!   changed.
//! - Setters that games call in every frame, such as [`Body::set_position`], change nothing when they are given NaN or
//!   infinity; the next update reports [`Event::RejectedInput`].
//! - State that would become NaN inside of an update keeps its last finite value: [`Event::NotFinite`] and its like name the
//!   body, joint, spring or controller.
//! - The id of a disposed object is stale: an error, or `None`. Only indexing, `simulator[body]`, panics.
//!
//! # Determinism
//!
//! The same calls give the same bits on every platform and in every build. Arithmetic is `f32` throughout, with one rounding
//! per operation in the original's order, no fused multiply-add, and trigonometry from `libm`. There is no iteration over hash
//! maps, no clock, no global state and no random number. Two runs differ only if their calls do, in their order too. A
//! simulator may be moved to another thread; several do not disturb each other.
//!
//! ```
//! # use farseer_core::PhysicsSimulator;
//! fn may_go_to_another_thread<T: Send + Sync>() {}
//! may_go_to_another_thread::<PhysicsSimulator>();
//! ```
//!
//! # Saving
//!
//! [`snapshot`](PhysicsSimulator::snapshot) is the complete simulator as bytes, with version and checksum.
//! [`restore`](PhysicsSimulator::restore) continues from there with the same bits, and refuses truncated or altered bytes. A
//! simulator can be serialised with any other format of `serde` as well; loaded data are checked. Disposals, moves and
//! refusals since the last update are included: the next update reports them. Handlers, a game's own controllers and
//! containers, and the events of the last update are not included. A [`Path`] and the game's own ids are saved beside it, by
//! `serde`.
//!
//! [`Recording`] keeps the states, inputs and [hashes](PhysicsSimulator::state_hash) of a whole run in one file. It returns the
//! state after any update, and says in which update a replay or another recording parts from it.
//!
//! Ids made after the snapshot may name other objects once it is restored: forget them,
//! [clear](BodyInterpolation::clear) the poses of [`BodyInterpolation`] and [forget](MousePicker::forget) the body of a
//! [`MousePicker`]. The picker's spring is in the snapshot: release it before, or save the picker beside.
//!
//! ```
//! # use farseer_core::{BodyFactory, PhysicsSimulator, math::Vector2};
//! # let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 100.0))?;
//! # let ball = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0)?;
//! # simulator.update(0.01);
//! let snapshot = simulator.snapshot();
//! simulator.update(0.01);
//! let position = simulator[ball].position();
//!
//! let mut loaded = PhysicsSimulator::default();
//! loaded.restore(&snapshot)?;
//! loaded.update(0.01);
//! assert_eq!(loaded[ball].position(), position);
//! assert!(loaded.restore(&snapshot[1..]).is_err());
//! # Ok::<(), farseer_core::Error>(())
//! ```
//!
//! # More
//!
//! [`Dispatch`] has handlers of single geoms, [`SecondaryMap`] a game's data of objects, [`EventLog`] the events of several
//! updates. [`FixedStepClock`], [`BodyInterpolation`] and [`FixedStepRunner`] are for the game loop. Queries are
//! [`ray_cast`](PhysicsSimulator::ray_cast), [`query_aabb`](PhysicsSimulator::query_aabb),
//! [`collide`](PhysicsSimulator::collide) and [`overlaps`](PhysicsSimulator::overlaps); [`PhysicsSimulatorView`] is the debug
//! view. [`Vertices`] has the polygon tools, [`math`] the original's vectors, matrices and interpolation.
//!
//! The documents in `docs/farseer-2.1.3` of the repository describe the original in every detail; this documentation
//! refers to them as *behaviour chapters*.

#![forbid(unsafe_code)]

pub mod error;
pub mod guide;
pub mod math;
pub mod shape;

mod body;
mod broad_phase;
mod builders;
mod checked_properties;
mod contact_solver;
mod contacts;
mod controllers;
mod debug_view;
mod factories;
mod former_names;
mod geom;
mod joints;
mod limits;
mod methods;
mod narrow_phase;
mod object_id;
mod objects;
mod path;
mod pipeline;
#[cfg_attr(not(feature = "precise"), path = "no_precise.rs")]
mod precise;
#[cfg(feature = "precise")]
mod queries;
mod report;
mod simulator;
mod springs;
mod storage;
mod utilities;

pub use body::{Body, BodyId};
pub use broad_phase::{SelectiveSweepOrder, SweepEnd};
pub use builders::{BodyBuilder, GeomBuilder};
pub use contact_solver::{SolverBody, SolverBodyIndex};
pub use contacts::{ArbiterRef, Contact, ContactId, GeomPairBitmap, PairId, index_of_safe};
pub use controllers::{
    AabbFluidContainer, Controller, ControllerId, ControllerKind, ControllerType, FluidContainer,
    FluidContainerRef, FluidDragController, GravityController, GravityType, InactivityController,
    ScalingController, WaveController,
};
pub use debug_view::{DebugShape, PhysicsSimulatorView};
pub use error::{Error, Result};
pub use factories::{BodyFactory, GeomFactory, JointFactory, SpringFactory};
pub use farseer_precise::island_report::{IslandCost, IslandResidual, IslandSolver, SolverReason};
pub use farseer_precise::surface::{CombinationRule, FrictionType, SurfaceCoefficients, SurfaceOptions};
#[allow(deprecated)]
pub use former_names::*;
pub use geom::distance_grid::DistanceGrid;
pub use geom::filter::CollisionFilter;
pub use geom::options::WantedEvents;
pub use geom::outline::Outline;
pub use geom::view::GeomRef;
pub use geom::{Geom, GeomId};
pub use joints::{
    AngleJoint, AngleLimitJoint, AngleSpringJoint, FixedAngleJoint, FixedAngleLimitJoint, FixedRevoluteJoint,
    GearJoint, Joint, JointId, JointKind, JointLimits, JointMotor, JointServo, JointType, MotorJoint,
    PinJoint, PoseServo, PrismaticJoint, PulleyJoint, RevoluteJoint, SliderJoint, WeldJoint, WheelJoint,
};
pub use limits::Limits;
pub use methods::{BroadPhaseCollider, CollisionCategory, Methods, NarrowPhaseCollider, SolverChoice};
pub use object_id::ObjectId;
pub use objects::{GeomPlacement, GeomPointPair, Objects, RayCastHit, TypedJointId, TypedSpringId};
pub use path::{
    ComplexFactory, Curve, CurveContinuity, CurveKey, CurveKeyCollection, CurveLoopType, CurveTangent,
    LinkType, Path,
};
#[cfg(feature = "precise")]
pub use queries::{
    CharacterMover, Explosion, MoverInput, MoverOptions, MoverReport, MoverState, MoverTouch, NearestPoint,
    QueryFilter,
};
pub use report::{AwakeReason, Event, Hit, Island, StepCounters, StepTimes};
pub use shape::{Aabb, Feature, Footprint, Vertices, ray_helper};
#[cfg(feature = "space")]
pub use simulator::depth;
pub use simulator::{
    BodyContact, Context, EventHandler, ExternalConstraints, PhysicsSimulator, SavedSimulator,
    SolverBodiesView, UserController,
};
pub use springs::{
    AngleSpring, FixedAngleSpring, FixedLinearSpring, LinearSpring, Spring, SpringId, SpringKind, SpringType,
};
pub use storage::rejected_arguments::{ArgumentNames, RejectedArguments};
pub use utilities::{
    BodyInterpolation, CollisionHandler, ControllerHandler, Dispatch, Dispatched, EventLog, FixedStepClock,
    FixedStepRunner, FluidHandler, InterpolatedPose, MapId, MousePicker, ObjectHandler, Recording,
    SecondaryMap, SeparationHandler, Subscription, snapshot,
};

/// The example of the README is run with those of the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
