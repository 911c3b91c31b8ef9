//! Callbacks: their order, what the events say about them, vetoes, and what may be done inside of them (behaviour
//! chapters 03, 04 and 08).

use conformance::fixtures::plane::{
    BROAD_PHASES, Game, add_box, add_floor, both_sets, faithful, faithful_methods, is_finite, lively_scene,
    methods, not_finite, pairs, simulator, simulator_with, state, v,
};
use farseer_core::{
    BodyId, BroadPhaseCollider, CollisionCategory, Contact, Context, Event, EventHandler, GeomId, Methods,
    NarrowPhaseCollider, ObjectId, PhysicsSimulator,
};

/// Writes down what it is told, in the words of [`Event`].
#[derive(Default)]
struct Log {
    events: Vec<Event>,
    refuses_collisions: bool,
    asks_broad_phase: bool,
    refuses_pairs: bool,
}

impl EventHandler for Log {
    fn on_collision(
        &mut self,
        _: &mut Context<'_>,
        this: GeomId,
        other: GeomId,
        contacts: &mut Vec<Contact>,
    ) -> bool {
        let (contacts, vetoed) = (contacts.len() as u32, self.refuses_collisions);
        self.events.push(Event::Collision { this, other, contacts, vetoed });
        !vetoed
    }

    fn on_separation(&mut self, _: &mut Context<'_>, this: GeomId, other: GeomId) {
        self.events.push(Event::Separation { this, other });
    }

    fn handles_broad_phase(&self) -> bool {
        self.asks_broad_phase
    }

    fn on_broad_phase_collision(&mut self, _: &mut Context<'_>, geom1: GeomId, geom2: GeomId) -> bool {
        if self.refuses_pairs {
            self.events.push(Event::BroadPhaseVeto { geom1, geom2 });
        }
        !self.refuses_pairs
    }

    fn on_body_updated(&mut self, _: &mut Context<'_>, body: BodyId) {
        self.events.push(Event::BodyUpdated { body });
    }

    fn on_body_disposed(&mut self, _: &mut Context<'_>, body: BodyId) {
        self.events.push(Event::BodyDisposed { body });
    }

    fn on_added(&mut self, object: ObjectId) {
        self.events.push(Event::Added { object });
    }

    fn on_removed(&mut self, object: ObjectId) {
        self.events.push(Event::Removed { object });
    }
}

/// What a handler is told in one update.
fn told(simulator: &mut PhysicsSimulator, log: &mut Log) -> Vec<Event> {
    log.events.clear();
    simulator.update_with(0.01, log);
    log.events.clone()
}

fn collision(this: GeomId, other: GeomId, contacts: u32, vetoed: bool) -> Event {
    Event::Collision { this, other, contacts, vetoed }
}

/// The precise set asks handlers in every update, and has events for what begins and ends.
#[test]
fn events_are_what_a_handler_is_told() {
    for methods in faithful_methods() {
        for (refuses_collisions, asks_broad_phase, refuses_pairs) in
            [(false, false, false), (true, false, false), (false, true, false), (false, true, true)]
        {
            let mut simulator = lively_scene(methods, 6);
            let mut log = Log { refuses_collisions, asks_broad_phase, refuses_pairs, ..Log::default() };
            for step in 0..80 {
                if step % 20 == 10 {
                    let (body, geom) = (simulator.body_list()[6], simulator.geom_list()[9]);
                    simulator[body].set_position(v(0.0, -100.0));
                    simulator.remove(geom).unwrap();
                    let body = simulator.body_list()[7];
                    simulator.dispose(body).unwrap();
                }
                let told = told(&mut simulator, &mut log);
                assert_eq!(simulator.events(), told, "{methods:?} step {step}");
            }
        }
    }
}

#[test]
fn a_handler_that_only_looks_changes_no_bit() {
    for methods in methods() {
        let (mut plain, mut watched) = (lively_scene(methods, 7), lively_scene(methods, 7));
        let mut log = Log::default();
        for _ in 0..80 {
            plain.update(0.01);
            watched.update_with(0.01, &mut log);
            assert_eq!(state(&plain), state(&watched), "{methods:?}");
            assert_eq!(plain.events(), watched.events(), "{methods:?}");
        }
    }
}

/// Behaviour chapter 03, check 2.
#[test]
fn boxes_that_overlap_without_contact_separate_in_every_update() {
    let mut simulator = simulator(0.0);
    let (_, a) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let (body, b) = add_box(&mut simulator, (10.0, 10.0), v(11.0, 11.0));
    simulator[body].set_rotation(std::f32::consts::FRAC_PI_4);
    let mut log = Log::default();
    simulator.process_added_and_removed();
    for _ in 0..3 {
        let expected = [Event::Separation { this: a, other: b }, Event::Separation { this: b, other: a }];
        assert_eq!(told(&mut simulator, &mut log), expected);
        assert_eq!(simulator.arbiter_count(), 0);
    }
}

/// Behaviour chapter 03, check 3.
#[test]
fn both_sides_are_told_of_a_collision_in_every_update() {
    let mut simulator = simulator(0.0);
    let (_, a) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let (_, b) = add_box(&mut simulator, (10.0, 10.0), v(9.0, 0.0));
    simulator.process_added_and_removed();
    let mut log = Log::default();
    for _ in 0..12 {
        let collisions: Vec<Event> = told(&mut simulator, &mut log)
            .into_iter()
            .filter(|event| !matches!(event, Event::BodyUpdated { .. }))
            .collect();
        assert_eq!(collisions, [collision(a, b, 4, false), collision(b, a, 4, false)]);
    }
}

/// Behaviour chapter 03, check 4.
#[test]
fn a_refused_collision_is_not_told_to_the_second_side_and_separates() {
    let mut simulator = simulator(0.0);
    let (_, a) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let (_, b) = add_box(&mut simulator, (10.0, 10.0), v(9.0, 0.0));
    simulator.process_added_and_removed();
    let mut log = Log { refuses_collisions: true, ..Log::default() };
    for _ in 0..3 {
        let separation = |this, other| Event::Separation { this, other };
        let expected = [collision(a, b, 4, true), separation(a, b), separation(b, a)];
        assert_eq!(told(&mut simulator, &mut log), expected);
    }
}

/// Behaviour chapter 04, check 1 and 4, as far as bodies and geoms go.
#[test]
fn geoms_enter_before_bodies_and_leave_before_bodies() {
    for methods in both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        let mut log = Log::default();
        let added = |object: ObjectId| Event::Added { object };
        assert_eq!(told(&mut simulator, &mut log)[1..], [added(geom.into()), added(body.into())]);
        simulator.dispose(body).unwrap();
        let removed = |object: ObjectId| Event::Removed { object };
        let expected = [Event::BodyDisposed { body }, removed(geom.into()), removed(body.into())];
        assert_eq!(told(&mut simulator, &mut log), expected);
    }
}

/// Behaviour chapter 04, check 3.
#[test]
fn what_is_removed_and_added_again_ends_up_removed() {
    for methods in both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let (_, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        simulator.process_added_and_removed();
        simulator.remove(geom).unwrap();
        simulator.add(geom).unwrap();
        simulator.update(0.0);
        assert_eq!(simulator.events(), [Event::Removed { object: geom.into() }]);
        assert!(simulator.geom_list().is_empty() && !simulator.geom(geom).unwrap().in_simulation());
        simulator.remove(geom).unwrap();
        simulator.remove(geom).unwrap();
        simulator.update(0.0);
        assert_eq!(simulator.events(), [Event::Removed { object: geom.into() }; 2]);
        simulator.add(geom).unwrap();
        simulator.add(geom).unwrap();
        simulator.update(0.0);
        assert_eq!(simulator.geom_list(), [geom]);
    }
}

#[test]
fn edited_bodies_are_told_of_in_the_order_of_their_edits() {
    for methods in both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let bodies: Vec<BodyId> =
            (0..3).map(|i| add_box(&mut simulator, (10.0, 10.0), v(i as f32 * 50.0, 0.0)).0).collect();
        simulator.update(0.01);
        for &body in &bodies {
            simulator[body].set_position(v(0.0, 100.0));
        }
        simulator.update(0.0);
        let expected: Vec<Event> = bodies.iter().map(|&body| Event::BodyUpdated { body }).collect();
        assert_eq!(simulator.events(), expected);
    }
}

#[test]
fn a_refused_pair_is_asked_for_again_except_by_sweep_and_prune() {
    for (broad, asked_again) in BROAD_PHASES.into_iter().zip([true, false, true, true]) {
        let mut simulator = simulator_with(0.0, faithful(broad, NarrowPhaseCollider::DistanceGrid));
        add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        add_box(&mut simulator, (10.0, 10.0), v(9.0, 1.0));
        let mut log = Log { asks_broad_phase: true, refuses_pairs: true, ..Log::default() };
        simulator.process_added_and_removed();
        assert!(!told(&mut simulator, &mut log).is_empty());
        assert_eq!(!told(&mut simulator, &mut log).is_empty(), asked_again, "{broad:?}");
        log.refuses_pairs = false;
        told(&mut simulator, &mut log);
        assert_eq!(simulator.arbiter_count(), usize::from(asked_again), "{broad:?}");
    }
}

/// Behaviour chapter 08, check 11.
#[test]
fn an_approval_replaces_the_box_test_of_brute_force_and_spatial_hash() {
    let hash = BroadPhaseCollider::SpatialHash { cell_size: 10.0, auto_adjust_cell_size: true };
    for (broad, is_registered) in
        BROAD_PHASES[..3].iter().copied().chain([hash]).zip([false, false, true, true])
    {
        let mut simulator = simulator_with(0.0, faithful(broad, NarrowPhaseCollider::DistanceGrid));
        add_box(&mut simulator, (2.0, 2.0), v(-3.0, -3.0));
        add_box(&mut simulator, (2.0, 2.0), v(3.0, 3.0));
        let mut log = Log { asks_broad_phase: true, ..Log::default() };
        simulator.process_queues(0.01, Some(&mut log));
        simulator.find_pairs(Some(&mut log));
        assert_eq!(simulator.arbiter_count(), usize::from(is_registered), "{broad:?}");
        if let BroadPhaseCollider::SpatialHash { cell_size, .. } = simulator.broad_phase_collider() {
            assert_eq!(cell_size, 4.0);
        }
    }
}

/// Does something at the first collision it is told of.
struct AtCollision<F>(Option<F>);

impl<F: FnOnce(&mut Context<'_>, GeomId, GeomId, &mut Vec<Contact>) -> bool> EventHandler for AtCollision<F> {
    fn on_collision(
        &mut self,
        context: &mut Context<'_>,
        this: GeomId,
        other: GeomId,
        contacts: &mut Vec<Contact>,
    ) -> bool {
        self.0.take().is_none_or(|action| action(context, this, other, contacts))
    }
}

fn body_of(context: &Context<'_>, geom: GeomId) -> BodyId {
    context.geom(geom).unwrap().body()
}

/// A box on a floor, and one on top of it.
fn stack(methods: Methods) -> PhysicsSimulator {
    let mut simulator = simulator_with(100.0, methods);
    add_floor(&mut simulator, (200.0, 20.0), v(0.0, 100.0));
    add_box(&mut simulator, (20.0, 20.0), v(3.0, 80.5));
    add_box(&mut simulator, (20.0, 20.0), v(1.0, 61.0));
    simulator
}

/// The geom that takes part in both pairs of a stack.
fn middle_of_stack(context: &Context<'_>, this: GeomId, other: GeomId) -> GeomId {
    let is_middle = |&geom: &GeomId| context.geom(geom).unwrap().id() == 1;
    [this, other].into_iter().find(is_middle).unwrap()
}

#[test]
fn contacts_may_be_removed_inside_a_callback() {
    let mut simulator = stack(Default::default());
    let mut handler = AtCollision(Some(|_: &mut Context<'_>, _, _, contacts: &mut Vec<Contact>| {
        contacts.truncate(1);
        true
    }));
    simulator.update_with(0.01, &mut handler);
    assert_eq!(simulator.arbiters().next().unwrap().contacts().len(), 1);
}

#[test]
fn contacts_may_be_added_inside_a_callback() {
    let mut simulator = stack(Default::default());
    let mut handler = AtCollision(Some(|_: &mut Context<'_>, _, _, contacts: &mut Vec<Contact>| {
        let mut contact = contacts[0];
        for vertex in 0..50 {
            contact.id.vertex = 1000 + vertex;
            contacts.push(contact);
        }
        true
    }));
    simulator.update_with(0.01, &mut handler);
    assert!(simulator.arbiters().next().unwrap().contacts().len() > 50);
    assert!(is_finite(&simulator));
}

#[test]
fn contacts_made_infinite_inside_a_callback_are_dropped() {
    for methods in both_sets() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            for field in 0..3 {
                let mut simulator = stack(methods);
                let mut handler =
                    AtCollision(Some(|_: &mut Context<'_>, _, _, contacts: &mut Vec<Contact>| {
                        for contact in contacts {
                            match field {
                                0 => contact.position.x = bad,
                                1 => contact.normal.y = bad,
                                _ => contact.separation = bad,
                            }
                        }
                        true
                    }));
                simulator.update_with(0.01, &mut handler);
                assert!(is_finite(&simulator));
                assert_eq!(not_finite(&simulator), []);
                assert!(simulator.body_list().iter().all(|&body| simulator[body].enabled()));
            }
        }
    }
}

#[test]
fn contacts_with_huge_numbers_made_inside_a_callback_stay_harmless() {
    for methods in both_sets() {
        for size in [1e20, 1e30, 3e38] {
            let mut simulator = stack(methods);
            let mut handler = AtCollision(Some(|_: &mut Context<'_>, _, _, contacts: &mut Vec<Contact>| {
                for contact in contacts {
                    *contact = Contact::new(v(size, -size), v(size, size), -size, contact.id)
                        .with_impulses(size, size);
                }
                true
            }));
            simulator.update_with(0.01, &mut handler);
            for _ in 0..20 {
                simulator.update(0.01);
                assert!(is_finite(&simulator));
            }
        }
    }
}

#[test]
fn bodies_made_static_inside_a_callback_stay_finite() {
    for methods in methods() {
        let mut simulator = stack(methods);
        let mut handler =
            AtCollision(Some(|context: &mut Context<'_>, this, other, _: &mut Vec<Contact>| {
                for body in [body_of(context, this), body_of(context, other)] {
                    context.body_mut(body).unwrap().set_is_static(true);
                }
                true
            }));
        simulator.update_with(0.01, &mut handler);
        let reported = not_finite(&simulator);
        assert!(reported.iter().all(|(_, disabled)| !disabled), "{methods:?}: {reported:?}");
        for _ in 0..10 {
            assert!(is_finite(&simulator), "{methods:?}");
            assert!(simulator.body_list().iter().all(|&body| simulator[body].enabled()), "{methods:?}");
            simulator.update(0.01);
        }
    }
}

#[test]
fn a_body_moved_inside_a_callback_takes_its_geom_along_at_once() {
    for methods in methods() {
        let mut simulator = stack(methods);
        let mut seen = None;
        let mut handler =
            AtCollision(Some(|context: &mut Context<'_>, this, other, _: &mut Vec<Contact>| {
                let middle = middle_of_stack(context, this, other);
                let body = body_of(context, middle);
                context.body_mut(body).unwrap().set_position(v(500.0, 500.0));
                seen = Some((middle, context.geom(middle).unwrap().position()));
                true
            }));
        simulator.update_with(0.01, &mut handler);
        let (geom, position) = seen.unwrap();
        assert_eq!(position, v(500.0, 500.0));
        assert!(simulator.geom(geom).unwrap().position().x > 490.0);
        // The pairs behind see it where it is now; the precise set has found all contacts before it asks about the first.
        let found = if let Methods::Faithful { .. } = methods { 1 } else { 2 };
        assert_eq!(pairs(&simulator).len(), found, "{methods:?}");
        assert!(is_finite(&simulator));
    }
}

#[test]
fn a_geom_disposed_inside_a_callback_has_no_later_contacts() {
    for methods in [Methods::default(), Methods::PRECISE] {
        let mut simulator = stack(methods);
        let mut disposed = None;
        let mut handler =
            AtCollision(Some(|context: &mut Context<'_>, this, other, _: &mut Vec<Contact>| {
                let middle = middle_of_stack(context, this, other);
                context.dispose(middle).unwrap();
                disposed = Some(middle);
                true
            }));
        simulator.update_with(0.01, &mut handler);
        let disposed = disposed.unwrap();
        assert!(simulator.geom(disposed).unwrap().is_disposed());
        let later: Vec<&Event> = simulator
            .events()
            .iter()
            .skip_while(|event| !matches!(event, Event::Collision { .. }))
            .skip(2)
            .filter(|event| matches!(event, Event::Collision { .. }))
            .collect();
        assert_eq!(later, [] as [&Event; 0], "{methods:?}");
        simulator.update(0.01);
        assert!(simulator.geom(disposed).is_none());
        assert_eq!(simulator.arbiter_count(), 0);
    }
}

/// Ways to part a geom from what it touches.
const PARTINGS: [fn(&mut Context<'_>, GeomId); 4] = [
    |context, geom| context.dispose(geom).unwrap(),
    |context, geom| {
        let body = body_of(context, geom);
        context.body_mut(body).unwrap().set_enabled(false);
    },
    |context, _| {
        for geom in context.geom_list().to_vec() {
            context.geom_mut(geom).unwrap().set_collision_group(3);
        }
    },
    |context, _| {
        for geom in context.geom_list().to_vec() {
            context.geom_mut(geom).unwrap().set_collides_with(CollisionCategory::NONE);
        }
    },
];

/// Parts a geom from what it touches when it is told of the first collision, and notes who is asked.
struct Parts {
    part: fn(&mut Context<'_>, GeomId),
    geom: GeomId,
    asked: Vec<(GeomId, GeomId)>,
}

impl EventHandler for Parts {
    fn on_collision(
        &mut self,
        context: &mut Context<'_>,
        this: GeomId,
        other: GeomId,
        _: &mut Vec<Contact>,
    ) -> bool {
        if self.asked.is_empty() {
            (self.part)(context, self.geom);
        }
        self.asked.push((this, other));
        true
    }
}

/// The precise set knows all contacts before it asks about the first.
#[test]
fn what_is_parted_inside_a_callback_is_not_asked_about_and_pushes_nothing() {
    for (number, part) in PARTINGS.into_iter().enumerate() {
        let mut simulator = stack(Methods::PRECISE);
        simulator.update(0.01);
        let [floor, middle, top] = simulator.geom_list()[..] else { panic!("three geoms") };
        simulator[top].set_friction_coefficient(0.0);
        let [body, thrown] = [middle, top].map(|geom| simulator.body_of(geom).unwrap());
        simulator[thrown].set_linear_velocity(v(0.0, 500.0));
        let mut handler = Parts { part, geom: top, asked: Vec::new() };
        simulator.update_with(0.01, &mut handler);
        assert_eq!(handler.asked, [(floor, middle), (middle, floor)], "parting {number}");
        // The floor would not stop a push from above within a step, but it lies as it lay.
        assert!(simulator[body].linear_velocity().norm() < 5.0, "parting {number}");
    }
}

#[test]
fn bodies_may_be_disposed_inside_every_callback() {
    for methods in methods() {
        for callback in 0..5 {
            let mut simulator = lively_scene(methods, 8);
            let mut handler = DisposesIn { callback, left: 5 };
            for step in 0..60 {
                if step % 10 == 5 {
                    let body = simulator.body_list()[3];
                    simulator[body].set_position(v(0.0, 0.0));
                    simulator.dispose(body).unwrap();
                }
                simulator.update_with(0.01, &mut handler);
                assert!(is_finite(&simulator), "{methods:?} {callback}");
            }
            assert!(handler.left < 5, "{methods:?}: callback {callback} never came");
        }
    }
}

/// Disposes, removes and adds what it is told about, in one kind of callback.
struct DisposesIn {
    callback: usize,
    left: usize,
}

impl DisposesIn {
    fn act(
        &mut self,
        callback: usize,
        context: &mut Context<'_>,
        geom: Option<GeomId>,
        body: Option<BodyId>,
    ) {
        if callback != self.callback || self.left == 0 {
            return;
        }
        let body = body.or_else(|| Some(context.geom(geom?)?.body()));
        let Some(body) = body.filter(|&body| context.body(body).is_some_and(|body| !body.is_static())) else {
            return;
        };
        self.left -= 1;
        if let Some(geom) = geom {
            context.remove(geom).unwrap();
            context.add(geom).unwrap();
        }
        context.body_mut(body).unwrap().set_position(v(1.0, 1.0));
        context.dispose(body).unwrap();
        context.dispose(body).unwrap();
        context.add(body).unwrap();
    }
}

impl EventHandler for DisposesIn {
    fn on_collision(
        &mut self,
        context: &mut Context<'_>,
        this: GeomId,
        _: GeomId,
        _: &mut Vec<Contact>,
    ) -> bool {
        self.act(0, context, Some(this), None);
        true
    }
    fn on_separation(&mut self, context: &mut Context<'_>, this: GeomId, _: GeomId) {
        self.act(1, context, Some(this), None);
    }
    fn handles_broad_phase(&self) -> bool {
        self.callback == 2
    }
    fn on_broad_phase_collision(&mut self, context: &mut Context<'_>, geom1: GeomId, _: GeomId) -> bool {
        self.act(2, context, Some(geom1), None);
        true
    }
    fn on_body_updated(&mut self, context: &mut Context<'_>, body: BodyId) {
        self.act(3, context, None, Some(body));
    }
    fn on_body_disposed(&mut self, context: &mut Context<'_>, body: BodyId) {
        self.act(4, context, None, Some(body));
    }
}

#[test]
fn an_object_removed_inside_a_callback_leaves_with_the_next_update() {
    let mut simulator = stack(Default::default());
    let mut removed = None;
    let mut handler =
        AtCollision(Some(|context: &mut Context<'_>, _, other: GeomId, _: &mut Vec<Contact>| {
            context.remove(other).unwrap();
            removed = Some(other);
            true
        }));
    simulator.update_with(0.01, &mut handler);
    let removed = removed.unwrap();
    assert!(simulator.geom_list().contains(&removed));
    simulator.update(0.01);
    assert!(!simulator.geom_list().contains(&removed));
    assert!(simulator.geom(removed).is_some());
}

/// Keeps every body where it is told of it, whatever happens; stops after a while so that the test ends.
struct Holds {
    position: farseer_core::math::Vector2,
    calls: u32,
}

impl EventHandler for Holds {
    fn on_body_updated(&mut self, context: &mut Context<'_>, body: BodyId) {
        self.calls += 1;
        if self.calls < 100_000 {
            context.body_mut(body).unwrap().set_position(self.position);
        }
    }
}

/// In the original a setter inside the callback calls the callback again, until the stack is exhausted.
#[test]
fn a_body_moved_in_the_callback_about_its_movement_does_not_hang_the_update() {
    for methods in both_sets() {
        let mut simulator = simulator_with(100.0, methods);
        let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        let mut handler = Holds { position: v(5.0, 5.0), calls: 0 };
        simulator.update_with(0.01, &mut handler);
        assert!(handler.calls < 1000, "told {} times in one update", handler.calls);
        assert_eq!(simulator[body].position(), v(5.0, 5.0));
    }
}

#[test]
fn a_body_may_be_brought_back_in_the_callback_about_its_movement() {
    for methods in both_sets() {
        struct Wraps;
        impl EventHandler for Wraps {
            fn on_body_updated(&mut self, context: &mut Context<'_>, body: BodyId) {
                let body = context.body_mut(body).unwrap();
                if body.position().x > 10.0 {
                    body.set_position(v(-10.0, 0.0));
                }
            }
        }
        let mut simulator = simulator_with(0.0, methods);
        let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(9.9, 0.0));
        simulator[body].set_linear_velocity(v(100.0, 0.0));
        simulator.update_with(0.01, &mut Wraps);
        assert_eq!(simulator[body].position(), v(-10.0, 0.0));
        assert_eq!(simulator.geom(geom).unwrap().position(), v(-10.0, 0.0));
        assert_eq!(
            simulator.events().iter().filter(|event| matches!(event, Event::BodyUpdated { .. })).count(),
            3
        );
    }
}

/// Behaviour chapter 02, check 10. The precise set tells of what has moved, and of nothing else.
#[test]
fn bodies_are_told_of_from_their_first_movement_on() {
    let mut simulator = simulator(0.0);
    let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    simulator.update(0.01);
    let count = |simulator: &PhysicsSimulator| {
        simulator.events().iter().filter(|&&event| event == Event::BodyUpdated { body }).count()
    };
    let mut told = 0;
    let mut step = |simulator: &mut PhysicsSimulator| {
        simulator.update(0.01);
        told += count(simulator);
        told
    };
    assert_eq!([step(&mut simulator), step(&mut simulator)], [0, 0]);
    simulator[body].set_linear_velocity(v(1.0, 0.0));
    assert_eq!(step(&mut simulator), 1);
    simulator[body].set_linear_velocity(v(0.0, 0.0));
    assert_eq!([step(&mut simulator), step(&mut simulator)], [2, 3]);
    simulator[body].reset_dynamics();
    // Once for the reset, which the original tells of at once, and once for the update.
    assert_eq!(step(&mut simulator), 5);
}

/// Behaviour chapter 02, check 13.
#[test]
fn a_body_disposed_twice_is_told_of_twice() {
    for methods in both_sets() {
        let mut simulator = simulator_with(0.0, methods);
        let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        simulator.update(0.01);
        simulator.dispose(body).unwrap();
        simulator.dispose(body).unwrap();
        simulator.update(0.01);
        let told = simulator.events().iter().filter(|&&event| event == Event::BodyDisposed { body }).count();
        assert_eq!(told, 2);
    }
}

#[test]
fn events_of_the_last_update_are_gone_after_the_next() {
    for methods in both_sets() {
        let mut simulator = lively_scene(methods, 9);
        let mut game = Game::default();
        for _ in 0..50 {
            game.step(&mut simulator);
        }
        assert!(!simulator.events().is_empty());
        simulator.set_enabled(false);
        simulator.update(0.01);
        assert_eq!(simulator.events(), []);
    }
}
