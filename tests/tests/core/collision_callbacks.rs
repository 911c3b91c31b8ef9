//! Geoms whose callbacks are switched off: their handlers are not called, and all else is unchanged.

use conformance::fixtures::plane::{Random, add_box, add_floor, lively_scene, methods, simulator, state, v};
use farseer_core::{
    BodyId, Contact, Context, Event, EventHandler, GeomFactory, GeomId, Methods, PhysicsSimulator,
};

const DT: f32 = 1.0 / 60.0;

/// Both sets of methods.
const SETS: [fn(&mut PhysicsSimulator); 2] = [
    |_| {},
    |simulator| {
        simulator.set_methods(Methods::PRECISE).unwrap();
        simulator.set_iterations(4);
    },
];

/// A box on a floor: simulator, floor, box.
fn box_on_floor(choose: fn(&mut PhysicsSimulator)) -> (PhysicsSimulator, GeomId, (BodyId, GeomId)) {
    let mut simulator = simulator(320.0);
    choose(&mut simulator);
    let (_, floor) = add_floor(&mut simulator, (400.0, 20.0), v(0.0, 10.0));
    let thing = add_box(&mut simulator, (32.0, 32.0), v(0.0, -16.5));
    (0..120).for_each(|_| simulator.update(DT));
    (simulator, floor, thing)
}

fn switch_off(simulator: &mut PhysicsSimulator, geoms: &[GeomId]) {
    geoms.iter().for_each(|&geom| simulator[geom].set_collision_callbacks_enabled(false));
}

/// Records the sides of each callback, and refuses the collisions of one geom.
#[derive(Default)]
struct Listener {
    asked: Vec<(GeomId, GeomId)>,
    separated: Vec<(GeomId, GeomId)>,
    refused: Option<GeomId>,
}

impl EventHandler for Listener {
    fn on_collision(
        &mut self,
        _: &mut Context<'_>,
        this: GeomId,
        other: GeomId,
        _: &mut Vec<Contact>,
    ) -> bool {
        self.asked.push((this, other));
        self.refused != Some(this)
    }

    fn on_separation(&mut self, _: &mut Context<'_>, this: GeomId, other: GeomId) {
        self.separated.push((this, other));
    }
}

#[test]
fn a_geom_with_callbacks_off_gets_none_and_its_partner_does() {
    for choose in SETS {
        let (mut simulator, floor, (_, thing)) = box_on_floor(choose);
        switch_off(&mut simulator, &[floor]);
        let mut listener = Listener::default();
        (0..10).for_each(|_| simulator.update_with(DT, &mut listener));
        assert_eq!(listener.asked, [(thing, floor)].repeat(10));
    }
}

#[test]
fn a_geom_with_callbacks_off_refuses_no_collision() {
    for choose in SETS {
        let (mut simulator, floor, (body, _)) = box_on_floor(choose);
        let before = simulator[body].position().y;
        switch_off(&mut simulator, &[floor]);
        let mut listener = Listener { refused: Some(floor), ..Listener::default() };
        (0..60).for_each(|_| simulator.update_with(DT, &mut listener));
        assert!((simulator[body].position().y - before).abs() < 0.1);
    }
}

#[test]
fn a_partner_with_callbacks_on_refuses_for_both() {
    for choose in SETS {
        let (mut simulator, floor, (body, thing)) = box_on_floor(choose);
        switch_off(&mut simulator, &[floor]);
        let mut listener = Listener { refused: Some(thing), ..Listener::default() };
        (0..60).for_each(|_| simulator.update_with(DT, &mut listener));
        // Half of g t^2 in a second, or the distance until the boxes separate.
        assert!(simulator[body].position().y > 20.0);
    }
}

#[test]
fn two_geoms_with_callbacks_off_call_no_handler() {
    for choose in SETS {
        let (mut simulator, floor, (body, thing)) = box_on_floor(choose);
        switch_off(&mut simulator, &[floor, thing]);
        let mut listener = Listener { refused: Some(thing), ..Listener::default() };
        (0..10).for_each(|_| simulator.update_with(DT, &mut listener));
        simulator[body].set_linear_velocity(v(0.0, -300.0));
        (0..30).for_each(|_| simulator.update_with(DT, &mut listener));
        assert_eq!((listener.asked, listener.separated), (vec![], vec![]));
    }
}

#[test]
fn a_separation_is_reported_to_the_side_with_callbacks_on() {
    for choose in SETS {
        let (mut simulator, floor, (body, thing)) = box_on_floor(choose);
        switch_off(&mut simulator, &[thing]);
        simulator[body].set_linear_velocity(v(0.0, -300.0));
        let mut listener = Listener::default();
        while listener.separated.is_empty() {
            simulator.update_with(DT, &mut listener);
        }
        assert_eq!(listener.separated[0], (floor, thing));
        assert!(listener.separated.iter().all(|&(this, _)| this == floor));
    }
}

/// The flag of a geom counts from the next update on, touching or not.
#[test]
fn callbacks_can_be_switched_while_geoms_touch() {
    for choose in SETS {
        let (mut simulator, floor, (_, thing)) = box_on_floor(choose);
        for is_on in [false, true, false, true] {
            for geom in [floor, thing] {
                simulator[geom].set_collision_callbacks_enabled(is_on);
            }
            let mut listener = Listener::default();
            simulator.update_with(DT, &mut listener);
            assert_eq!(listener.asked.len(), if is_on { 2 } else { 0 });
        }
    }
}

#[test]
fn with_all_callbacks_off_an_update_equals_one_without_a_handler() {
    for methods in methods() {
        let (mut plain, mut silent) = (lively_scene(methods, 11), lively_scene(methods, 11));
        [&mut plain, &mut silent].into_iter().for_each(|simulator| simulator.update(0.01));
        let geoms: Vec<GeomId> = silent.geom_list().to_vec();
        switch_off(&mut silent, &geoms);
        let mut listener = Listener { refused: geoms.first().copied(), ..Listener::default() };
        for _ in 0..80 {
            plain.update(0.01);
            silent.update_with(0.01, &mut listener);
            assert_eq!(state(&plain), state(&silent), "{methods:?}");
            assert_eq!(plain.events(), silent.events(), "{methods:?}");
        }
        assert!(listener.asked.is_empty() && listener.separated.is_empty());
    }
}

/// With the precise set collisions are events when they begin, with any setting of the callbacks.
#[test]
fn precise_events_do_not_depend_on_the_callback_switches() {
    let scene = || {
        let mut scene = lively_scene(Default::default(), 12);
        SETS[1](&mut scene);
        scene.update(0.01);
        scene
    };
    let (mut heard, mut half, mut silent) = (scene(), scene(), scene());
    let geoms: Vec<GeomId> = heard.geom_list().to_vec();
    let some: Vec<GeomId> = geoms.iter().copied().step_by(2).collect();
    switch_off(&mut half, &some);
    switch_off(&mut silent, &geoms);
    let mut begun = 0;
    for _ in 0..200 {
        let all = [&mut heard, &mut half, &mut silent];
        all.into_iter().for_each(|simulator| simulator.update_with(0.01, &mut Listener::default()));
        assert_eq!(heard.events(), half.events());
        assert_eq!(heard.events(), silent.events());
        assert_eq!(state(&heard), state(&half));
        assert_eq!(state(&heard), state(&silent));
        begun += heard.events().iter().filter(|event| matches!(event, Event::Collision { .. })).count();
    }
    assert!(begun > 40, "{begun}");
}

#[test]
fn broad_phase_callbacks_ignore_the_collision_switches() {
    struct NewPairs(usize);
    impl EventHandler for NewPairs {
        fn handles_broad_phase(&self) -> bool {
            true
        }
        fn on_broad_phase_collision(&mut self, _: &mut Context<'_>, _: GeomId, _: GeomId) -> bool {
            self.0 += 1;
            false
        }
    }
    for choose in SETS {
        let mut simulator = simulator(320.0);
        choose(&mut simulator);
        let (_, floor) = add_floor(&mut simulator, (400.0, 20.0), v(0.0, 10.0));
        let (body, thing) = add_box(&mut simulator, (32.0, 32.0), v(0.0, -16.5));
        switch_off(&mut simulator, &[floor, thing]);
        let mut handler = NewPairs(0);
        (0..60).for_each(|_| simulator.update_with(DT, &mut handler));
        assert!(handler.0 > 0 && simulator[body].position().y > 50.0);
    }
}

#[test]
fn clones_and_saves_keep_whether_callbacks_are_on() {
    let (mut simulator, floor, (body, thing)) = box_on_floor(SETS[1]);
    switch_off(&mut simulator, &[floor, thing]);
    let copy = simulator.clone_geom(body, thing).unwrap();
    let other =
        GeomFactory::create_circle_geom_in(&mut simulator, body, 5.0, 12, Default::default()).unwrap();
    let mut restored = PhysicsSimulator::default();
    restored.restore(&simulator.snapshot()).unwrap();
    for simulator in [&simulator, &restored] {
        assert!(!simulator[copy].collision_callbacks_enabled());
        assert!(simulator[other].collision_callbacks_enabled());
    }
    let mut listener = Listener::default();
    restored[copy].set_collision_enabled(false);
    restored[other].set_collision_enabled(false);
    restored.update_with(DT, &mut listener);
    assert!(listener.asked.is_empty());
}

/// A rollback after every step, with callbacks switched in between.
#[test]
fn saves_between_switches_change_no_bit() {
    let mut played = lively_scene(Default::default(), 13);
    SETS[1](&mut played);
    played.update(0.01);
    let mut random = Random::new(5);
    for step in 0..120 {
        let geoms = played.geom_list().to_vec();
        let geom = random.pick(&geoms);
        played[geom].set_collision_callbacks_enabled(step % 3 == 0);
        let mut restored = PhysicsSimulator::default();
        restored.restore(&played.snapshot()).unwrap();
        let (mut asked, mut again) = (Listener::default(), Listener::default());
        played.update_with(0.01, &mut asked);
        restored.update_with(0.01, &mut again);
        assert_eq!((asked.asked, asked.separated), (again.asked, again.separated), "step {step}");
        assert_eq!(state(&played), state(&restored), "step {step}");
    }
}
