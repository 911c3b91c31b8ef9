//! Properties of every joint and every spring, for any bodies: momentum between two free bodies, the state of rest, breaking,
//! being disabled and removal with a body.

use crate::joint_bench::Log;
use crate::link_scenes::{self, DT, Kind, Link, Scene, check};
use conformance::fixtures::plane::{self, state, v};
use farseer_core::{Event, PhysicsSimulator, WeldJoint};
use proptest::prelude::*;

/// Rounding errors of a momentum after a second, as a fraction of the greatest momentum of the bodies. Measured are 1e-6 for
/// momentum and 2e-6 times the arms for angular momentum.
const ROUNDING: f64 = 1e-5;

/// Updates for a second, and returns the greatest momentum of the bodies.
fn run(scene: &mut Scene) -> f64 {
    let mut scale = scene.scale();
    for _ in 0..60 {
        scene.simulator.update(DT);
        scale = scale.max(scene.scale());
    }
    scale
}

fn keeps_linear_momentum(kind: Kind) {
    check(|setup| {
        let mut scene = Scene::moving(kind, setup);
        let before = scene.linear_momentum();
        let scale = run(&mut scene);
        prop_assert!(scene.error() != 0.0 || kind == Kind::Slider, "the link has not acted");
        for (before, after) in before.into_iter().zip(scene.linear_momentum()) {
            let change = (after - before).abs();
            prop_assert!(change <= ROUNDING * scale, "{before} became {after}, scale {scale}");
        }
        Ok(())
    });
}

/// The bodies are up to about 10 from the origin.
fn keeps_angular_momentum(kind: Kind) {
    check(|setup| {
        let mut setup = setup.clone();
        if kind == Kind::AngleSpring {
            // Its damping brakes each body by itself.
            setup.constants.1 = 0.0;
        }
        let mut scene = Scene::moving(kind, &setup);
        let before = scene.angular_momentum();
        let scale = run(&mut scene);
        let after = scene.angular_momentum();
        prop_assert!(
            (after - before).abs() <= 10.0 * ROUNDING * scale,
            "{before} became {after}, scale {scale}"
        );
        Ok(())
    });
}

fn keeps_linear_velocities(kind: Kind) {
    check(|setup| {
        let mut scene = Scene::moving(kind, setup);
        run(&mut scene);
        for (body, [x, y, w]) in scene.bodies.into_iter().zip(setup.velocities) {
            prop_assert_eq!(scene.simulator[body].linear_velocity(), v(x, y));
            prop_assert_ne!(scene.simulator[body].angular_velocity(), w);
        }
        Ok(())
    });
}

macro_rules! properties {
    ($property:ident { $($test:ident: $kind:ident $(, $argument:expr)?;)* }) => {$(
        #[test]
        fn $test() {
            $property(Kind::$kind $(, $argument)?);
        }
    )*};
}

properties! { keeps_linear_momentum {
    a_revolute_joint_keeps_linear_momentum: Revolute;
    a_pin_joint_keeps_linear_momentum: Pin;
    a_slider_joint_keeps_linear_momentum: Slider;
    a_weld_joint_keeps_linear_momentum: Weld;
    a_linear_spring_keeps_linear_momentum: LinearSpring;
}}

properties! { keeps_linear_velocities {
    an_angle_joint_keeps_linear_velocities: Angle;
    an_angle_spring_keeps_linear_velocities: AngleSpring;
}}

// Not the revolute and the weld joint, for which see below.
properties! { keeps_angular_momentum {
    an_angle_joint_keeps_angular_momentum: Angle;
    an_angle_limit_joint_keeps_angular_momentum: AngleLimit;
    a_pin_joint_keeps_angular_momentum: Pin;
    a_slider_joint_keeps_angular_momentum: Slider;
    a_linear_spring_keeps_angular_momentum: LinearSpring;
    an_undamped_angle_spring_keeps_angular_momentum: AngleSpring;
}}

/// The impulses act at two points whose distance is the error.
#[test]
fn a_revolute_joint_changes_angular_momentum_by_its_error_times_its_impulse_at_most() {
    check(|setup| {
        let mut scene = Scene::moving(Kind::Revolute, setup);
        for _ in 0..60 {
            let before = (scene.angular_momentum(), scene.linear_velocity_of_second(), scene.scale());
            scene.simulator.update(DT);
            let impulse = (scene.linear_velocity_of_second() - before.1).norm() * setup.masses[1].0;
            let bound = f64::from(scene.error() * impulse) + ROUNDING * (before.2 + scene.scale());
            let change = (scene.angular_momentum() - before.0).abs();
            prop_assert!(change <= bound, "{change} is more than {bound}");
        }
        Ok(())
    });
}

/// So angular momentum is not conserved.
#[test]
fn the_pull_at_the_point_of_a_weld_joint_does_not_turn_the_first_body() {
    check(|setup| {
        let mut scene = Scene::new(Kind::Weld, setup);
        scene.simulator.set_iterations(1);
        scene.simulator.update(DT);
        let [first, second] = scene.bodies.map(|body| &scene.simulator[body]);
        prop_assert_ne!(first.linear_velocity(), v(0.0, 0.0));
        prop_assert_eq!(first.angular_velocity(), 0.0);
        prop_assert_ne!(second.angular_velocity(), 0.0);
        Ok(())
    });
}

/// From rest, with drag, for some seconds; drag removes the motion of the correction in the free directions.
fn comes_to_rest(kind: Kind, tolerance: f32) {
    check(|setup| {
        let mut setup = setup.clone();
        if matches!(kind, Kind::LinearSpring | Kind::FixedLinearSpring) {
            // Along the line of the springs only: they do not damp swings about it.
            setup.anchors = [[0.0; 2]; 2];
        }
        let mut scene = Scene::new(kind, &setup);
        for body in scene.bodies {
            scene.simulator[body].set_linear_drag_coefficient(1.0);
            scene.simulator[body].set_rotational_drag_coefficient(1.0);
        }
        scene.simulator.update(DT);
        let violation = scene.error().abs();
        prop_assert!((violation - setup.violation).abs() < 1e-3, "{violation} is not {}", setup.violation);
        for _ in 0..1200 {
            scene.simulator.update(DT);
        }
        prop_assert!(scene.error().abs() <= tolerance, "error {}", scene.error());
        if let Link::Joint(joint) = scene.link
            && let Ok(weld) = scene.simulator.joint_as::<WeldJoint>(joint)
        {
            let [first, second] =
                [weld.body1(), weld.body2()].map(|body| scene.simulator[body].total_rotation());
            let angle = second - first - (setup.second.2 - setup.first.1);
            prop_assert!(angle.abs() <= tolerance, "angle {angle}");
        }
        Ok(())
    });
}

// Measured are a fifth of these at most; rotations up to 8 are multiples of 4.8e-7.
properties! { comes_to_rest {
    an_angle_joint_comes_to_its_angle: Angle, 1e-5;
    an_angle_limit_joint_comes_into_its_range: AngleLimit, 0.0;
    a_fixed_angle_joint_comes_to_its_angle: FixedAngle, 1e-5;
    a_fixed_angle_limit_joint_comes_into_its_range: FixedAngleLimit, 0.0;
    a_fixed_revolute_joint_comes_to_its_point: FixedRevolute, 2e-5;
    a_pin_joint_comes_to_its_distance: Pin, 2e-5;
    a_revolute_joint_comes_to_its_point: Revolute, 2e-5;
    a_slider_joint_comes_into_its_range: Slider, 0.0;
    a_weld_joint_comes_to_its_point_and_angle: Weld, 2e-5;
    an_angle_spring_comes_to_its_angle: AngleSpring, 2e-4;
    a_fixed_angle_spring_comes_to_its_angle: FixedAngleSpring, 2e-4;
    a_fixed_linear_spring_comes_to_its_length: FixedLinearSpring, 2e-4;
    a_linear_spring_comes_to_its_length: LinearSpring, 2e-4;
}}

/// Counts the reports of half a second.
fn breaks_with(kind: Kind, setup: &link_scenes::Setup, breakpoint: f32) -> (usize, usize, bool) {
    let mut scene = Scene::new(kind, setup);
    scene.set_breakpoint(breakpoint);
    let (mut log, mut reported) = (Log::default(), 0);
    for _ in 0..30 {
        scene.simulator.update_with(DT, &mut log);
        let link = scene.link;
        let is_ours = |event: &&Event| match (event, link) {
            (Event::JointBroke { joint }, Link::Joint(ours)) => *joint == ours,
            (Event::SpringBroke { spring }, Link::Spring(ours)) => *spring == ours,
            _ => false,
        };
        reported += scene.simulator.events().iter().filter(is_ours).count();
    }
    (log.broke, reported, scene.is_enabled())
}

fn breaks_once(kind: Kind) {
    check(|setup| {
        prop_assert_eq!(breaks_with(kind, setup, 0.5 * setup.violation), (1, 1, false));
        prop_assert_eq!(breaks_with(kind, setup, 1.5 * setup.violation), (0, 0, true));
        Ok(())
    });
}

properties! { breaks_once {
    an_angle_joint_breaks_once_beyond_its_breakpoint: Angle;
    an_angle_limit_joint_breaks_once_beyond_its_breakpoint: AngleLimit;
    a_fixed_angle_joint_breaks_once_beyond_its_breakpoint: FixedAngle;
    a_fixed_angle_limit_joint_breaks_once_beyond_its_breakpoint: FixedAngleLimit;
    a_fixed_revolute_joint_breaks_once_beyond_its_breakpoint: FixedRevolute;
    a_pin_joint_breaks_once_beyond_its_breakpoint: Pin;
    a_revolute_joint_breaks_once_beyond_its_breakpoint: Revolute;
    a_slider_joint_breaks_once_beyond_its_breakpoint: Slider;
    a_weld_joint_breaks_once_beyond_its_breakpoint: Weld;
    an_angle_spring_breaks_once_beyond_its_breakpoint: AngleSpring;
    a_fixed_angle_spring_breaks_once_beyond_its_breakpoint: FixedAngleSpring;
    a_fixed_linear_spring_breaks_once_beyond_its_breakpoint: FixedLinearSpring;
    a_linear_spring_breaks_once_beyond_its_breakpoint: LinearSpring;
}}

/// A disabled joint has no effect, a disposed one does not exist, and the bodies move straight on with both.
fn has_no_effect_when_disabled(kind: Kind) {
    check(|setup| {
        let mut disabled = Scene::moving(kind, setup);
        disabled.set_enabled(false);
        let mut disposed = Scene::moving(kind, setup);
        disposed.simulator.dispose(disposed.id()).unwrap();
        run(&mut disabled);
        run(&mut disposed);
        prop_assert_eq!(state(&disabled.simulator), state(&disposed.simulator));
        for (body, [x, y, w]) in disabled.bodies.into_iter().zip(setup.velocities) {
            let body = &disabled.simulator[body];
            prop_assert_eq!((body.linear_velocity(), body.angular_velocity()), (v(x, y), w));
        }
        prop_assert_eq!(disabled.error(), 0.0);
        prop_assert!(disabled.is_there());
        prop_assert!(!disposed.is_there());

        disabled.set_enabled(true);
        disabled.simulator.update(DT);
        prop_assert_ne!(state(&disabled.simulator), state(&disposed.simulator));
        Ok(())
    });
}

/// After a save in the middle of a run every kind goes on with the same bits.
#[test]
fn a_loaded_simulator_equals_the_saved_one() {
    check(|setup| {
        for kind in Kind::ALL {
            let mut scene = Scene::moving(kind, setup);
            (0..10).for_each(|_| scene.simulator.update(DT));
            let save = serde_json::to_string(&scene.simulator).unwrap();
            let mut loaded: PhysicsSimulator = serde_json::from_str(&save).unwrap();
            for _ in 0..10 {
                scene.simulator.update(DT);
                loaded.update(DT);
                prop_assert_eq!(state(&scene.simulator), state(&loaded), "{:?}", kind);
            }
            prop_assert_eq!(
                serde_json::to_string(&scene.simulator).unwrap(),
                serde_json::to_string(&loaded).unwrap()
            );
        }
        Ok(())
    });
}

/// A correction or force that would be infinite is not applied, and the link works again when its settings allow it.
fn does_not_act_when_it_overflows(kind: Kind) {
    check(|setup| {
        let setup = link_scenes::Setup { violation: 2.0, ..setup.clone() };
        let mut scene = Scene::moving(kind, &setup);
        scene.set_strength(f32::MAX);
        scene.simulator.update(DT);
        let expected = match scene.link {
            Link::Joint(joint) => Event::JointNotFinite { joint },
            Link::Spring(spring) => Event::SpringNotFinite { spring },
        };
        let count = scene.simulator.events().iter().filter(|&event| *event == expected).count();
        prop_assert_eq!(count, 1, "{:?}", scene.simulator.events());
        for (body, [x, y, w]) in scene.bodies.into_iter().zip(setup.velocities) {
            let body = &scene.simulator[body];
            prop_assert_eq!((body.linear_velocity(), body.angular_velocity()), (v(x, y), w));
        }
        scene.set_strength(0.2);
        let before = scene.simulator[scene.bodies[0]].angular_velocity();
        run(&mut scene);
        prop_assert!(plane::is_finite(&scene.simulator));
        prop_assert_ne!(scene.simulator[scene.bodies[0]].angular_velocity(), before);
        Ok(())
    });
}

// Not the joints and springs whose impulse or torque is limited to the greatest number there is.
properties! { does_not_act_when_it_overflows {
    an_angle_limit_joint_does_not_act_when_it_overflows: AngleLimit;
    a_fixed_angle_limit_joint_does_not_act_when_it_overflows: FixedAngleLimit;
    a_fixed_revolute_joint_does_not_act_when_it_overflows: FixedRevolute;
    a_pin_joint_does_not_act_when_it_overflows: Pin;
    a_revolute_joint_does_not_act_when_it_overflows: Revolute;
    a_slider_joint_does_not_act_when_it_overflows: Slider;
    a_weld_joint_does_not_act_when_it_overflows: Weld;
    a_fixed_linear_spring_does_not_act_when_it_overflows: FixedLinearSpring;
    a_linear_spring_does_not_act_when_it_overflows: LinearSpring;
}}

/// Whichever of its bodies is disposed.
fn is_removed_with_its_body(kind: Kind) {
    check(|setup| {
        for which in 0..2 {
            let mut scene = Scene::moving(kind, setup);
            scene.simulator.update(DT);
            let (gone, left) = (scene.bodies[which], scene.bodies[1 - which]);
            let velocity = scene.simulator[left].linear_velocity();
            scene.simulator.dispose(gone).unwrap();
            scene.simulator.update(DT);
            let is_held = which == 0 || !kind.is_fixed();
            prop_assert_eq!(scene.is_there(), !is_held);
            prop_assert!(scene.simulator.joint_list().is_empty() == (is_held || kind.is_spring()));
            prop_assert!(scene.simulator.spring_list().is_empty() == (is_held || !kind.is_spring()));
            if is_held {
                prop_assert_eq!(scene.simulator[left].linear_velocity(), velocity);
            }
        }
        Ok(())
    });
}

properties! { has_no_effect_when_disabled {
    a_disabled_angle_joint_has_no_effect: Angle;
    a_disabled_angle_limit_joint_has_no_effect: AngleLimit;
    a_disabled_fixed_angle_joint_has_no_effect: FixedAngle;
    a_disabled_fixed_angle_limit_joint_has_no_effect: FixedAngleLimit;
    a_disabled_fixed_revolute_joint_has_no_effect: FixedRevolute;
    a_disabled_pin_joint_has_no_effect: Pin;
    a_disabled_revolute_joint_has_no_effect: Revolute;
    a_disabled_slider_joint_has_no_effect: Slider;
    a_disabled_weld_joint_has_no_effect: Weld;
    a_disabled_angle_spring_has_no_effect: AngleSpring;
    a_disabled_fixed_angle_spring_has_no_effect: FixedAngleSpring;
    a_disabled_fixed_linear_spring_has_no_effect: FixedLinearSpring;
    a_disabled_linear_spring_has_no_effect: LinearSpring;
}}

properties! { is_removed_with_its_body {
    an_angle_joint_is_removed_with_its_body: Angle;
    an_angle_limit_joint_is_removed_with_its_body: AngleLimit;
    a_fixed_angle_joint_is_removed_with_its_body: FixedAngle;
    a_fixed_angle_limit_joint_is_removed_with_its_body: FixedAngleLimit;
    a_fixed_revolute_joint_is_removed_with_its_body: FixedRevolute;
    a_pin_joint_is_removed_with_its_body: Pin;
    a_revolute_joint_is_removed_with_its_body: Revolute;
    a_slider_joint_is_removed_with_its_body: Slider;
    a_weld_joint_is_removed_with_its_body: Weld;
    an_angle_spring_is_removed_with_its_body: AngleSpring;
    a_fixed_angle_spring_is_removed_with_its_body: FixedAngleSpring;
    a_fixed_linear_spring_is_removed_with_its_body: FixedLinearSpring;
    a_linear_spring_is_removed_with_its_body: LinearSpring;
}}
