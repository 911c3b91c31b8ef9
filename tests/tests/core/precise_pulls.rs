//! The precise set: joints pull bodies against static walls. The wall holds, the joint keeps its error, and closes it little by
//! little when the wall goes. All lengths are in length units of 1.

use conformance::fixtures::plane::v;
use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, GeomFactory, GeomPlacement, JointFactory, JointId, JointLimits, Methods,
    PhysicsSimulator, PinJoint, SliderJoint, SolverChoice,
};

/// Step in seconds.
const STEP: f32 = 1.0 / 60.0;
/// Greatest speed at which joints correct their errors: length units/s, radians/s.
const CORRECTION_SPEED: f32 = 3.0;
/// Penetration to which joints may press a body into a wall for good, with a quarter for the equilibrium of soft constraints. Unit: length units.
const HELD_DEPTH: f32 = 1.25 * 0.02;
/// Half of the side of the boxes that are pulled. Unit: length units.
const HALF_BOX: f32 = 0.2;
/// Coordinate x of the face of the wall, length units. Bodies are pulled from smaller coordinates to greater ones.
const FACE: f32 = 2.0;
const CHOICES: [SolverChoice; 2] = [SolverChoice::Auto, SolverChoice::Direct];
/// Thicknesses of walls, length units.
const WALLS: [f32; 3] = [0.02, 0.2, 1.0];
const MASSES: [f32; 3] = [0.01, 1.0, 100.0];

/// A box that something pulls along x against a wall.
struct Pull {
    simulator: PhysicsSimulator,
    body: BodyId,
    wall: BodyId,
}

impl Pull {
    /// Returns a box of `mass` at x, and a static wall of this thickness behind `FACE`.
    fn new(choice: SolverChoice, x: f32, mass: f32, thickness: f32) -> Self {
        let mut simulator = PhysicsSimulator::new(v(0.0, 0.0)).unwrap();
        simulator.set_methods(Methods::Precise { length_unit: 1.0 }).unwrap();
        simulator.set_solver_choice(choice);
        let body = add_box(&mut simulator, v(x, 0.0), [2.0 * HALF_BOX; 2], mass);
        let wall = add_box(&mut simulator, v(FACE + thickness / 2.0, 0.0), [thickness, 8.0], 1.0);
        simulator[wall].set_is_static(true);
        Pull { simulator, body, wall }
    }

    /// Returns how far the body reaches beyond the face of the wall.
    fn depth(&self) -> f32 {
        let corners = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
        let reach =
            |(x, y)| self.simulator[self.body].get_world_position(v(x * HALF_BOX, y * HALF_BOX)).x - FACE;
        corners.map(reach).into_iter().fold(f32::MIN, f32::max)
    }

    /// Returns the speed of the body; rotation counts at its corners.
    fn speed(&self) -> f32 {
        let body = &self.simulator[self.body];
        body.linear_velocity().norm() + 1.5 * HALF_BOX * body.angular_velocity().abs()
    }

    /// Pulls for `updates`, with `act` before each of them. Asserts that the wall holds: the body enters it by no more than
    /// `entry` and the held depth, ends at the held depth, and is at rest.
    fn assert_held(
        &mut self,
        updates: usize,
        entry: f32,
        case: &str,
        mut act: impl FnMut(&mut PhysicsSimulator),
    ) {
        for update in 0..updates {
            act(&mut self.simulator);
            self.simulator.update(STEP);
            let depth = self.depth();
            assert!(depth < HELD_DEPTH + entry, "{case}: {depth} in update {update}");
        }
        let (depth, speed) = (self.depth(), self.speed());
        assert!(depth < HELD_DEPTH + 0.03, "{case}: {depth} at the end");
        assert!(speed < 0.01, "{case}: {speed} at the end");
    }

    /// Removes the wall, and updates until the joint has had the time to close.
    fn open(&mut self) {
        for geom in self.simulator.geoms_of(self.wall).to_vec() {
            self.simulator.remove(geom).unwrap();
        }
        (0..300).for_each(|_| self.simulator.update(STEP));
    }
}

fn add_box(
    simulator: &mut PhysicsSimulator,
    position: Vector2,
    [width, height]: [f32; 2],
    mass: f32,
) -> BodyId {
    let body = BodyFactory::create_rectangle_body_in(simulator, width, height, mass).unwrap();
    let placement = GeomPlacement::default();
    GeomFactory::create_rectangle_geom_in(simulator, body, width, height, placement).unwrap();
    simulator[body].set_position(position);
    body
}

/// Adds a body without a shape at `position`.
fn add_anchor(simulator: &mut PhysicsSimulator, position: Vector2) -> BodyId {
    let anchor = BodyFactory::create_circle_body_in(simulator, 0.1, 1.0).unwrap();
    simulator[anchor].set_position(position);
    anchor
}

/// Calls `run` with each solver, thickness of the wall and mass, and with their names.
fn for_each_case(mut run: impl FnMut(SolverChoice, f32, f32, &str)) {
    for choice in CHOICES {
        for thickness in WALLS {
            for mass in MASSES {
                run(choice, thickness, mass, &format!("{choice:?}, wall {thickness}, mass {mass}"));
            }
        }
    }
}

/// Kinds of joints between an anchor and the box.
#[derive(Debug, Clone, Copy)]
enum Kind {
    Revolute,
    Weld,
    Pin,
    Slider,
    Prismatic,
}

const KINDS: [Kind; 5] = [Kind::Revolute, Kind::Weld, Kind::Pin, Kind::Slider, Kind::Prismatic];

impl Kind {
    /// Returns a joint that is not yet in the simulator, for the present poses of both bodies.
    fn create(self, simulator: &mut PhysicsSimulator, anchor: BodyId, body: BodyId) -> JointId {
        let (middle, zero) = (simulator[body].position(), v(0.0, 0.0));
        let distance = (middle - simulator[anchor].position()).norm();
        match self {
            Kind::Revolute => JointFactory::create_revolute_joint(simulator, anchor, body, middle),
            Kind::Weld => JointFactory::create_weld_joint(simulator, anchor, body, middle),
            Kind::Pin => JointFactory::create_pin_joint(simulator, anchor, zero, body, zero),
            Kind::Slider => {
                JointFactory::create_slider_joint(simulator, anchor, zero, body, zero, 0.0, distance)
            }
            Kind::Prismatic => {
                JointFactory::create_prismatic_joint(simulator, anchor, body, middle, v(0.0, 1.0))
            }
        }
        .unwrap()
    }
}

#[test]
fn a_joint_added_again_does_not_pull_its_body_through_a_wall() {
    for_each_case(|choice, thickness, mass, case| {
        for kind in KINDS {
            let mut pull = Pull::new(choice, 3.0, mass, thickness);
            let Pull { simulator, body, .. } = &mut pull;
            let anchor = add_anchor(simulator, v(4.0, 0.0));
            simulator[anchor].set_is_static(true);
            let joint = kind.create(simulator, anchor, *body);
            simulator[*body].set_position(v(1.5, 0.0));
            simulator.update(STEP);
            simulator.add(joint).unwrap();
            let case = format!("{kind:?}, {case}");
            pull.assert_held(300, CORRECTION_SPEED * STEP, &case, |_| {});
            pull.open();
            // A slider leaves a hundredth.
            let x = pull.simulator[pull.body].position().x;
            assert!((x - 3.0).abs() < 0.02, "{case}: {x} without the wall");
        }
    });
}

#[test]
fn a_winch_stops_at_a_beam() {
    for_each_case(|choice, thickness, mass, case| {
        for (is_rope, step) in [(false, 0.01), (false, 0.05), (true, 0.01), (true, 0.2)] {
            let mut pull = Pull::new(choice, 1.4, mass, thickness);
            let Pull { simulator, body, .. } = &mut pull;
            let anchor = add_anchor(simulator, v(4.0, 0.0));
            simulator[anchor].set_is_static(true);
            let kind = if is_rope { Kind::Slider } else { Kind::Pin };
            let joint = kind.create(simulator, anchor, *body);
            simulator.add(joint).unwrap();
            let mut length = 2.6;
            let case = format!("rope {is_rope}, {step} per update, {case}");
            pull.assert_held(400, CORRECTION_SPEED * STEP, &case, |simulator| {
                length = f32::max(length - step, 1.0);
                if is_rope {
                    simulator.joint_as_mut::<SliderJoint>(joint).unwrap().set_max(length).unwrap();
                } else {
                    simulator.joint_as_mut::<PinJoint>(joint).unwrap().set_target_distance(length).unwrap();
                }
            });
            pull.open();
            let x = pull.simulator[pull.body].position().x;
            assert!((x - 3.0).abs() < 0.02, "{case}: {x} without the beam");
        }
    });
}

#[test]
fn limits_beyond_a_wall_do_not_pull_a_slide_through_it() {
    for_each_case(|choice, thickness, mass, case| {
        let mut pull = Pull::new(choice, 0.0, mass, thickness);
        let Pull { simulator, body, .. } = &mut pull;
        let anchor = add_anchor(simulator, v(-1.0, 0.0));
        simulator[anchor].set_is_static(true);
        let joint =
            JointFactory::create_prismatic_joint_in(simulator, anchor, *body, v(0.0, 0.0), v(1.0, 0.0))
                .unwrap();
        simulator.set_joint_limits(joint, Some(JointLimits { lower: 3.0, upper: 4.0 })).unwrap();
        pull.assert_held(300, CORRECTION_SPEED * STEP, case, |_| {});
        pull.open();
        let x = pull.simulator[pull.body].position().x;
        assert!((x - 3.0).abs() < 0.01, "{case}: {x} without the wall");
    });
}

#[test]
fn a_kinematic_hook_leaves_its_load_at_the_wall() {
    for_each_case(|choice, thickness, mass, case| {
        for (kind, speed) in KINDS.into_iter().flat_map(|kind| [0.5, 2.0, 10.0].map(|speed| (kind, speed))) {
            let mut pull = Pull::new(choice, 1.5, mass, thickness);
            let Pull { simulator, body, .. } = &mut pull;
            let hook = add_anchor(simulator, v(2.0, 0.0));
            simulator[hook].set_is_kinematic(true);
            let joint = kind.create(simulator, hook, *body);
            simulator.add(joint).unwrap();
            simulator[hook].set_linear_velocity(v(speed, 0.0));
            let case = format!("{kind:?} at {speed}, {case}");
            let updates = (1.5 / speed / STEP) as usize;
            for update in 0..updates + 120 {
                if update == updates {
                    pull.simulator[hook].set_linear_velocity(v(0.0, 0.0));
                }
                pull.simulator.update(STEP);
                // The iterative solver has such islands: its soft joints press a body deeper, but never its middle past the face.
                let (x, speed) = (pull.simulator[pull.body].position().x, pull.speed());
                assert!(x < FACE - 0.1 * HALF_BOX, "{case}: {x} in update {update}");
                assert!(speed < 60.0, "{case}: {speed} in update {update}");
            }
            pull.open();
            let gap = pull.simulator[hook].position().x - pull.simulator[pull.body].position().x;
            assert!((gap - 0.5).abs() < 0.02, "{case}: {gap} without the wall");
        }
    });
}

#[test]
fn a_chain_does_not_pull_its_load_through_a_wall() {
    for choice in [SolverChoice::Auto, SolverChoice::Direct] {
        for (thickness, mass) in WALLS.into_iter().flat_map(|wall| MASSES.map(|mass| (wall, mass))) {
            for links in [2, 4, 10] {
                let mut pull = Pull::new(choice, 3.0, mass, thickness);
                let mut last = add_anchor(&mut pull.simulator, v(4.0, 0.0));
                pull.simulator[last].set_is_static(true);
                for link in 1..links {
                    let x = 4.0 - link as f32 / links as f32;
                    let next = add_anchor(&mut pull.simulator, v(x, 0.0));
                    pull.simulator[next].set_mass(0.1).unwrap();
                    let at = pull.simulator[last].position();
                    JointFactory::create_revolute_joint_in(&mut pull.simulator, last, next, at).unwrap();
                    last = next;
                }
                let joint = Kind::Revolute.create(&mut pull.simulator, last, pull.body);
                pull.simulator[pull.body].set_position(v(1.5, 0.0));
                pull.simulator.update(STEP);
                pull.simulator.add(joint).unwrap();
                let case = format!("{choice:?}, {links} links, wall {thickness}, mass {mass}");
                pull.assert_held(400, CORRECTION_SPEED * STEP, &case, |_| {});
            }
        }
    }
}

#[test]
fn edited_limits_turn_a_body_little_by_little() {
    for choice in CHOICES {
        for mass in MASSES {
            let mut pull = Pull::new(choice, -2.0, mass, 0.2);
            let Pull { simulator, body, .. } = &mut pull;
            let joint = JointFactory::create_fixed_revolute_joint_in(simulator, *body, v(-2.0, 0.0)).unwrap();
            simulator.set_joint_limits(joint, Some(JointLimits { lower: 0.5, upper: 1.0 })).unwrap();
            let mut before = 0.0;
            for update in 0..60 {
                simulator.update(STEP);
                let rotation = simulator[*body].rotation();
                let turned = rotation - before;
                // A thousandth for the effect of one position correction on another.
                assert!(
                    turned < 1.001 * CORRECTION_SPEED * STEP,
                    "{choice:?}, {mass}: {turned} in update {update}"
                );
                before = rotation;
            }
            assert!((before - 0.5).abs() < 0.005, "{choice:?}, {mass}: {before}");
        }
    }
}

#[test]
fn a_joint_added_again_closes_little_by_little() {
    for choice in CHOICES {
        for (kind, mass) in KINDS.into_iter().flat_map(|kind| MASSES.map(|mass| (kind, mass))) {
            let mut pull = Pull::new(choice, -1.0, mass, 0.2);
            let Pull { simulator, body, .. } = &mut pull;
            let anchor = add_anchor(simulator, v(0.0, 0.0));
            simulator[anchor].set_is_static(true);
            let joint = kind.create(simulator, anchor, *body);
            simulator[*body].set_position(v(-3.0, 0.0));
            simulator.update(STEP);
            simulator.add(joint).unwrap();
            let mut before = simulator[*body].position();
            for update in 0..120 {
                simulator.update(STEP);
                let position = simulator[*body].position();
                let moved = (position - before).norm();
                assert!(
                    moved < 1.01 * CORRECTION_SPEED * STEP,
                    "{choice:?}, {kind:?}, {mass}: {moved} in {update}"
                );
                before = position;
            }
            assert!((before.x + 1.0).abs() < 0.02, "{choice:?}, {kind:?}, {mass}: {before}");
        }
    }
}
