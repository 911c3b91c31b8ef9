//! Handlers of single geoms, bodies and joints.

use conformance::fixtures::plane::{add_box, add_circle, add_floor, both_sets, simulator, simulator_with, v};
use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, Context, Controller, Dispatch, Event, EventHandler, GeomFactory, GeomId,
    GeomPlacement, JointFactory, JointId, Methods, Objects, PhysicsSimulator, SpringFactory, SpringId,
};

type Words = Vec<&'static str>;

/// A ball that overlaps a floor.
fn ball_in_floor(methods: Methods) -> (PhysicsSimulator, BodyId, [GeomId; 2]) {
    let mut simulator = simulator_with(100.0, methods);
    let (_, floor) = add_floor(&mut simulator, (100.0, 20.0), v(0.0, 10.0));
    let (body, ball) = add_circle(&mut simulator, 10.0, 16, v(0.0, -9.0));
    (simulator, body, [floor, ball])
}

#[test]
fn handlers_of_a_geom_are_called_in_the_order_in_which_they_were_subscribed() {
    for methods in both_sets() {
        let (mut simulator, _, [_, ball]) = ball_in_floor(methods);
        let mut dispatch = Dispatch::new();
        dispatch.on_collision(ball, |words: &mut Words, _, _, _, _| {
            words.push("first");
            true
        });
        dispatch.on_collision(ball, |words, _, _, _, _| {
            words.push("second");
            true
        });
        let mut words = Words::new();
        simulator.update_with(0.01, &mut dispatch.with(&mut words));
        assert_eq!(words, ["first", "second"], "{methods:?}");
    }
}

#[test]
fn the_last_of_several_answers_counts_as_in_the_original() {
    for (answers, falls) in [([true, false], true), ([false, true], false)] {
        let (mut simulator, body, [_, ball]) = ball_in_floor(Methods::PRECISE);
        let mut dispatch = Dispatch::new();
        for answer in answers {
            dispatch.on_collision(ball, if answer { |(), _, _, _, _| true } else { |(), _, _, _, _| false });
        }
        (0..100).for_each(|_| simulator.update_with(0.01, &mut dispatch.with(&mut ())));
        assert_eq!(simulator[body].position().y > 20.0, falls, "{answers:?}");
    }
}

#[test]
fn only_the_handlers_of_the_geom_that_touches_are_called_with_it_first() {
    let (mut simulator, _, [floor, ball]) = ball_in_floor(Methods::default());
    let (_, elsewhere) = add_box(&mut simulator, (10.0, 10.0), v(500.0, 0.0));
    let mut dispatch = Dispatch::new();
    for geom in [ball, elsewhere] {
        dispatch.on_collision(geom, |told: &mut Vec<[GeomId; 2]>, _, this, other, _| {
            told.push([this, other]);
            true
        });
    }
    let mut told = Vec::new();
    simulator.update_with(0.01, &mut dispatch.with(&mut told));
    assert_eq!(told, [[ball, floor]]);
}

#[test]
fn a_subscription_that_was_ended_is_not_called_and_the_others_of_the_geom_are() {
    let (mut simulator, _, [_, ball]) = ball_in_floor(Methods::default());
    let mut dispatch = Dispatch::new();
    let ended = dispatch.on_collision(ball, |words: &mut Words, _, _, _, _| {
        words.push("ended");
        true
    });
    dispatch.on_collision(ball, |words, _, _, _, _| {
        words.push("kept");
        true
    });
    assert!(dispatch.off(ended));
    assert!(!dispatch.off(ended), "it is not there any more");
    let mut words = Words::new();
    simulator.update_with(0.01, &mut dispatch.with(&mut words));
    assert_eq!(words, ["kept"]);
}

#[test]
fn the_handler_of_a_disposed_geom_is_not_called_for_the_next_geom_in_its_slot() {
    let (mut simulator, body, [_, ball]) = ball_in_floor(Methods::default());
    let mut dispatch = Dispatch::new();
    dispatch.on_collision(ball, |count: &mut usize, _, _, _, _| {
        *count += 1;
        true
    });
    simulator.dispose(body).unwrap();
    simulator.update(0.01);
    let (_, next) = add_circle(&mut simulator, 10.0, 16, v(0.0, -9.0));
    assert_eq!(next.slot(), ball.slot());
    let mut count = 0;
    simulator.update_with(0.01, &mut dispatch.with(&mut count));
    assert!(simulator.contact_count() > 0, "it touches the floor as well");
    assert_eq!(count, 0);
}

#[test]
fn a_separation_is_reported_to_the_handler_of_the_geom() {
    let (mut simulator, body, [floor, ball]) = ball_in_floor(Methods::PRECISE);
    let mut dispatch = Dispatch::new();
    dispatch.on_separation(ball, |partners: &mut Vec<GeomId>, _, _, other| partners.push(other));
    let mut partners = Vec::new();
    (0..10).for_each(|_| simulator.update_with(0.01, &mut dispatch.with(&mut partners)));
    assert_eq!(partners, []);
    simulator[body].set_position(v(0.0, -30.0));
    simulator.update_with(0.01, &mut dispatch.with(&mut partners));
    assert_eq!(partners, [floor]);
}

#[test]
fn a_break_of_a_joint_calls_its_handler_which_may_dispose_it() {
    let mut simulator = simulator(100.0);
    let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(20.0, 0.0));
    let [torn, held] = [0.0, 20.0]
        .map(|x| JointFactory::create_fixed_revolute_joint_in(&mut simulator, body, v(x, 0.0)).unwrap());
    simulator[torn].set_breakpoint(-1.0).unwrap();
    let mut dispatch = Dispatch::new();
    for joint in [torn, held] {
        dispatch.on_joint_broke(joint, |broken: &mut Vec<_>, context, joint| {
            broken.push(joint);
            context.dispose(joint).unwrap();
        });
    }
    let mut broken = Vec::new();
    (0..3).for_each(|_| simulator.update_with(0.01, &mut dispatch.with(&mut broken)));
    assert_eq!(broken, [torn]);
    assert!(simulator.joint(torn).is_none() && simulator.joint(held).is_some());
}

#[test]
fn moved_and_disposed_bodies_call_their_handlers() {
    let (mut simulator, body, _) = ball_in_floor(Methods::default());
    let (still, _) = add_box(&mut simulator, (10.0, 10.0), v(500.0, 0.0));
    let mut dispatch = Dispatch::new();
    dispatch.on_body_updated(body, |words: &mut Words, _, _| words.push("moved"));
    dispatch.on_body_disposed(body, |words, _, _| words.push("disposed"));
    dispatch.on_body_disposed(still, |words, _, _| words.push("another"));
    let mut words = Words::new();
    simulator[body].set_position(v(1.0, -50.0));
    simulator.update_with(0.01, &mut dispatch.with(&mut words));
    assert_eq!(words, ["moved", "moved"], "by the setter and by the update, as it is always told");
    words.clear();
    simulator.dispose(body).unwrap();
    simulator.update_with(0.01, &mut dispatch.with(&mut words));
    assert_eq!(words, ["disposed"]);
}

#[test]
fn handlers_of_disposed_objects_are_freed_and_the_others_stay() {
    let (mut simulator, body, [floor, ball]) = ball_in_floor(Methods::default());
    let mut dispatch = Dispatch::new();
    let [gone, kept] = [ball, floor].map(|geom| dispatch.on_separation(geom, |(), _, _, _| ()));
    simulator.dispose(body).unwrap();
    simulator.update(0.01);
    dispatch.forget_disposed(&simulator);
    assert!(!dispatch.off(gone) && dispatch.off(kept));
}

#[test]
fn a_controller_of_the_game_does_its_work_in_every_update_with_the_step_and_the_real_time() {
    let mut simulator = simulator(0.0);
    let controllers = [(); 2].map(|()| simulator.create_controller(Controller::user_defined()).unwrap());
    controllers.iter().for_each(|&controller| simulator.add(controller).unwrap());
    let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let mut dispatch = Dispatch::new();
    dispatch.on_controller_update(controllers[0], |times: &mut Vec<[f32; 2]>, context, _, dt, dt_real| {
        times.push([dt, dt_real]);
        // Mass 1: a force of 100 gives a velocity of 1 in 0.01 s.
        context.for_each_body_mut(|_, body| body.apply_force(Vector2::new(100.0, 0.0)));
    });
    let mut times = Vec::new();
    simulator.update_with_real_time(0.01, 0.5, Some(&mut dispatch.with(&mut times)));
    assert_eq!(times, [[0.01, 0.5]]);
    assert_eq!(simulator[body].linear_velocity(), v(1.0, 0.0));
    let missing = simulator.events().iter().filter_map(|event| match *event {
        Event::MissingController { controller } => Some(controller),
        _ => None,
    });
    assert_eq!(missing.collect::<Vec<_>>(), [controllers[1]], "nobody subscribed to the other one");
    simulator[controllers[0]].set_enabled(false);
    simulator.update_with(0.01, &mut dispatch.with(&mut times));
    assert_eq!(times.len(), 1, "a disabled one has no turn");
}

#[test]
fn objects_made_by_a_handler_move_as_if_made_after_the_update() {
    fn spark(objects: &mut Objects) {
        let body = BodyFactory::create_circle_body_in(objects, 3.0, 1.0).unwrap();
        objects[body].set_position(v(4.0, -40.0));
        GeomFactory::create_circle_geom_in(objects, body, 3.0, 8, GeomPlacement::default()).unwrap();
        objects[body].set_linear_velocity(v(5.0, 0.0));
        JointFactory::create_fixed_revolute_joint_in(objects, body, v(-20.0, -40.0)).unwrap();
    }
    for methods in both_sets() {
        let mut played = [true, false].map(|in_handler| {
            let (mut simulator, _, [_, ball]) = ball_in_floor(methods);
            let mut dispatch = Dispatch::new();
            dispatch.on_collision(ball, |(is_new, makes): &mut (bool, bool), context, _, _, _| {
                if std::mem::take(is_new) && *makes {
                    spark(context);
                }
                true
            });
            let mut game = (true, in_handler);
            simulator.update_with(0.01, &mut dispatch.with(&mut game));
            assert!(!game.0, "it touches in the first update");
            if !in_handler {
                spark(&mut simulator);
            }
            assert_eq!(simulator.body_list().len(), 2, "it enters with the next update");
            (0..100).for_each(|_| simulator.update_with(0.01, &mut dispatch.with(&mut game)));
            assert_eq!(simulator.body_list().len(), 3);
            simulator
        });
        let [made_inside, made_after] = played.each_mut().map(|simulator| {
            let places = simulator.body_list().iter().map(|&body| simulator[body].position());
            places.collect::<Vec<_>>()
        });
        assert_eq!(made_inside, made_after, "{methods:?}");
        assert_ne!(made_inside[2], v(4.0, -40.0), "{methods:?}: the pendulum swings");
    }
}

/// Counts the callbacks of a joint and of a spring.
struct Counting {
    of: (JointId, SpringId),
    counts: [u32; 2],
}

impl EventHandler for Counting {
    fn handles_joint_updates(&self) -> bool {
        true
    }
    fn on_joint_updated(&mut self, _: &mut Context<'_>, joint: JointId) {
        self.counts[0] += u32::from(joint == self.of.0);
    }
    fn handles_spring_updates(&self) -> bool {
        true
    }
    fn on_spring_updated(&mut self, _: &mut Context<'_>, spring: SpringId) {
        self.counts[1] += u32::from(spring == self.of.1);
    }
}

#[test]
fn active_joints_and_springs_call_their_handlers_as_often_as_a_global_handler() {
    for methods in both_sets() {
        let mut simulator = simulator_with(100.0, methods);
        // Two pendulums: the joint of the second has no handler.
        let [(body, told), _] = [0.0, 100.0].map(|y| {
            let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(20.0, y));
            (body, JointFactory::create_fixed_revolute_joint_in(&mut simulator, body, v(0.0, y)).unwrap())
        });
        let (end, fixed) = (v(0.0, 0.0), v(0.0, 9.0));
        let spring =
            SpringFactory::create_fixed_linear_spring_in(&mut simulator, body, end, fixed, 5.0, 0.1).unwrap();
        let mut dispatch = Dispatch::new();
        dispatch.on_joint_updated(told, |counts: &mut [u32; 2], _, _| counts[0] += 1);
        let of_springs = dispatch.on_spring_updated(spring, |counts, _, _| counts[1] += 1);
        let (mut twin, mut counts) = (simulator.clone(), [0, 0]);
        let mut all = Counting { of: (told, spring), counts };
        for _ in 0..20 {
            simulator.update_with(0.01, &mut dispatch.with(&mut counts));
            twin.update_with(0.01, &mut all);
        }
        assert_eq!(counts, all.counts, "{methods:?}");
        assert!(counts[0] >= 20 && counts[1] >= 19, "{methods:?}: {counts:?}");
        dispatch.off(of_springs);
        simulator.update_with(0.01, &mut dispatch.with(&mut counts));
        assert_eq!(counts[1], all.counts[1], "{methods:?}");
    }
}
