//! Hooks for engines that are built on the stages: the filter of pairs, callbacks of their own, and queries.

use conformance::fixtures::plane::{
    BROAD_PHASES, add_box, add_floor, faithful, faithful_methods, lively_scene, simulator, simulator_with,
    state, v,
};
use farseer_core::{
    BodyId, BroadPhaseCollider, CollisionCategory, Context, Event, EventHandler, FrictionType, Geom,
    GeomFactory, GeomId, GeomPlacement, NarrowPhaseCollider, PhysicsSimulator,
};

const DT: f32 = 0.01;

/// Filters pairs by one answer, and records its calls.
#[derive(Default)]
struct Filter {
    refuses: bool,
    handles_broad_phase: bool,
    refuses_broad_phase: bool,
    asked: Vec<(GeomId, GeomId)>,
    separated: Vec<(GeomId, GeomId)>,
    broad_phase_was_asked: bool,
    /// An action for the call of the filter.
    act: Option<fn(&mut Context<'_>, GeomId, GeomId)>,
}

impl EventHandler for Filter {
    fn filters_pairs(&self) -> bool {
        true
    }

    fn accepts_pair(&mut self, context: &mut Context<'_>, geom1: GeomId, geom2: GeomId) -> bool {
        self.asked.push((geom1.min(geom2), geom1.max(geom2)));
        if let Some(act) = self.act {
            act(context, geom1, geom2);
        }
        !self.refuses
    }

    fn handles_broad_phase(&self) -> bool {
        self.handles_broad_phase
    }

    fn on_broad_phase_collision(&mut self, _: &mut Context<'_>, _: GeomId, _: GeomId) -> bool {
        assert_eq!(self.asked, [], "the filter is asked afterwards");
        self.broad_phase_was_asked = true;
        !self.refuses_broad_phase
    }

    fn on_separation(&mut self, _: &mut Context<'_>, this: GeomId, other: GeomId) {
        self.separated.push((this, other));
    }
}

/// A box that lies on a floor and overlaps it by 1.
fn box_on_floor(broad: BroadPhaseCollider) -> (PhysicsSimulator, BodyId, [GeomId; 2]) {
    let mut simulator = simulator_with(100.0, faithful(broad, NarrowPhaseCollider::DistanceGrid));
    let (_, floor) = add_floor(&mut simulator, (100.0, 20.0), v(0.0, 19.0));
    let (body, geom) = add_box(&mut simulator, (20.0, 20.0), v(0.0, 0.0));
    (simulator, body, [floor, geom])
}

fn tells_of_pairs(event: &Event) -> bool {
    matches!(event, Event::Collision { .. } | Event::Separation { .. } | Event::BroadPhaseVeto { .. })
}

#[test]
fn a_new_pair_that_the_filter_refuses_gets_no_arbiter_and_no_event() {
    for broad in BROAD_PHASES {
        let (mut simulator, body, [floor, geom]) = box_on_floor(broad);
        let mut filter = Filter { refuses: true, ..Filter::default() };
        for step in 1..=3 {
            simulator.update_with(DT, &mut filter);
            assert_eq!(simulator.arbiter_count(), 0, "{broad:?}");
            assert!(!simulator.events().iter().any(tells_of_pairs), "{broad:?}");
            assert_eq!(filter.asked, vec![(floor, geom); step], "{broad:?}: once in every update");
        }
        // Three steps of free fall from rest: g * dt^2 * (1 + 2 + 3).
        let fallen = simulator[body].position().y;
        assert!((fallen - 0.06).abs() < 1e-5, "{broad:?}: {fallen}");
    }
}

#[test]
fn a_pair_that_was_refused_gets_its_arbiter_once_it_is_accepted() {
    for broad in BROAD_PHASES {
        let (mut simulator, ..) = box_on_floor(broad);
        let mut filter = Filter { refuses: true, ..Filter::default() };
        simulator.update_with(DT, &mut filter);
        filter.refuses = false;
        simulator.update_with(DT, &mut filter);
        assert_eq!(simulator.arbiter_count(), 1, "{broad:?}");
    }
}

#[test]
fn refusing_a_pair_with_an_arbiter_reports_a_separation_to_both_sides() {
    for broad in BROAD_PHASES {
        let (mut simulator, _, [floor, geom]) = box_on_floor(broad);
        simulator.update(DT);
        assert_eq!(simulator.arbiter_count(), 1, "{broad:?}");
        let mut filter = Filter { refuses: true, ..Filter::default() };
        simulator.update_with(DT, &mut filter);
        assert_eq!(simulator.arbiter_count(), 0, "{broad:?}");
        assert_eq!(filter.separated, [(floor, geom), (geom, floor)], "{broad:?}");
        let told: Vec<Event> = simulator.events().iter().copied().filter(tells_of_pairs).collect();
        let separation = |this, other| Event::Separation { this, other };
        assert_eq!(told, [separation(floor, geom), separation(geom, floor)], "{broad:?}");
        filter.separated.clear();
        simulator.update_with(DT, &mut filter);
        assert_eq!(filter.separated, [], "{broad:?}: told once");
    }
}

#[test]
fn a_pair_accepted_again_has_no_old_impulses() {
    let (mut simulator, ..) = box_on_floor(BroadPhaseCollider::SelectiveSweep);
    simulator.update(DT);
    assert!(simulator.arbiter(0).unwrap().contacts().next().unwrap().normal_impulse() > 0.0);
    simulator.update_with(DT, &mut Filter { refuses: true, ..Filter::default() });
    assert!(simulator.process_queues(DT, None));
    simulator.find_pairs(None);
    simulator.collide_pairs(None);
    let mut contacts = simulator.arbiter(0).unwrap().contacts();
    assert!(contacts.len() > 0 && contacts.all(|contact| contact.normal_impulse() == 0.0));
}

#[test]
fn the_filter_is_not_called_for_separate_boxes() {
    for broad in BROAD_PHASES {
        let mut simulator = simulator_with(0.0, faithful(broad, NarrowPhaseCollider::DistanceGrid));
        add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        add_box(&mut simulator, (10.0, 10.0), v(10.5, 0.0));
        let mut filter = Filter::default();
        simulator.update_with(DT, &mut filter);
        assert_eq!(filter.asked, [], "{broad:?}");
    }
}

#[test]
fn the_filter_is_not_called_for_pairs_that_may_not_collide() {
    for broad in BROAD_PHASES {
        let (mut simulator, _, [floor, geom]) = box_on_floor(broad);
        simulator.ignore_collision_with(floor, geom).unwrap();
        let mut filter = Filter::default();
        simulator.update_with(DT, &mut filter);
        assert_eq!(filter.asked, [], "{broad:?}");
    }
}

#[test]
fn the_filter_is_called_for_a_new_pair_after_the_broad_phase_callback() {
    for broad in BROAD_PHASES {
        let (mut simulator, _, geoms) = box_on_floor(broad);
        let mut filter = Filter { handles_broad_phase: true, ..Filter::default() };
        simulator.update_with(DT, &mut filter);
        assert_eq!(
            (filter.broad_phase_was_asked, filter.asked),
            (true, vec![(geoms[0], geoms[1])]),
            "{broad:?}"
        );
    }
}

#[test]
fn the_filter_is_not_called_for_a_new_pair_that_the_broad_phase_callback_refuses() {
    for broad in BROAD_PHASES {
        let (mut simulator, ..) = box_on_floor(broad);
        let mut filter = Filter { handles_broad_phase: true, refuses_broad_phase: true, ..Filter::default() };
        simulator.update_with(DT, &mut filter);
        assert_eq!((filter.broad_phase_was_asked, filter.asked), (true, vec![]), "{broad:?}");
    }
}

#[test]
fn a_filter_that_accepts_everything_changes_no_bit() {
    for methods in faithful_methods() {
        let (mut plain, mut filtered) = (lively_scene(methods, 3), lively_scene(methods, 3));
        let mut filter = Filter::default();
        for _ in 0..80 {
            plain.update(DT);
            filtered.update_with(DT, &mut filter);
            assert_eq!(state(&plain), state(&filtered), "{methods:?}");
            assert_eq!(plain.events(), filtered.events(), "{methods:?}");
        }
        assert!(filter.asked.len() > 80, "{methods:?}");
    }
}

#[test]
fn geoms_follow_a_body_that_the_filter_moves() {
    let (mut simulator, body, [_, geom]) = box_on_floor(BroadPhaseCollider::SelectiveSweep);
    let act = |context: &mut Context<'_>, geom1, geom2| {
        for geom in [geom1, geom2] {
            let body = context.geom(geom).unwrap().body();
            if !context.body(body).unwrap().is_static() {
                context.body_mut(body).unwrap().set_position(v(0.0, -50.0));
            }
        }
    };
    let mut filter = Filter { act: Some(act), ..Filter::default() };
    assert!(simulator.process_queues(DT, None));
    simulator.find_pairs(Some(&mut filter));
    assert!(simulator.events().contains(&Event::BodyUpdated { body }));
    assert_eq!(simulator.geom(geom).unwrap().aabb().min.y, -60.0);
}

#[test]
fn a_filter_sees_the_simulator_with_its_lists_and_its_broad_phase() {
    for broad in [BroadPhaseCollider::SelectiveSweep, BroadPhaseCollider::SweepAndPrune] {
        let (mut simulator, ..) = box_on_floor(broad);
        let mut filter = Filter {
            act: Some(|context, _, _| {
                let simulator = context.simulator();
                assert_eq!(simulator.geom_list().len(), 2);
                assert_eq!(simulator.collide_all(v(0.0, 9.5)).len(), 2);
                assert_ne!(simulator.broad_phase_collider(), BroadPhaseCollider::BruteForce);
                let mut copy = simulator.clone();
                copy.update(DT);
                assert_eq!(copy.arbiter_count(), 1);
                assert_eq!(copy.broad_phase_collider(), simulator.broad_phase_collider());
            }),
            ..Filter::default()
        };
        simulator.update_with(DT, &mut filter);
        assert_eq!(filter.asked.len(), 1);
    }
}

#[test]
fn a_callback_can_make_sensors_and_ignored_pairs() {
    let (mut simulator, body, [floor, geom]) = box_on_floor(BroadPhaseCollider::SelectiveSweep);
    simulator.context().set_is_sensor(geom, true).unwrap();
    assert!(simulator.geom(geom).unwrap().is_sensor() && simulator[body].is_static());
    simulator.context().set_is_sensor(geom, false).unwrap();
    simulator.context().ignore_collision_with(floor, geom).unwrap();
    simulator.update(DT);
    assert_eq!(simulator.arbiter_count(), 0);
    simulator.context().restore_collision_with(floor, geom).unwrap();
    simulator.update(DT);
    assert_eq!(simulator.arbiter_count(), 1);
}

#[test]
fn settling_updates_geom_transforms_and_calls_the_handler() {
    #[derive(Default)]
    struct Updates(Vec<BodyId>);
    impl EventHandler for Updates {
        fn on_body_updated(&mut self, _: &mut Context<'_>, body: BodyId) {
            self.0.push(body);
        }
    }
    let mut simulator = simulator(0.0);
    let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    simulator.update(DT);
    simulator.context().body_mut(body).unwrap().set_position(v(30.0, 0.0));
    let mut updates = Updates::default();
    simulator.settle(Some(&mut updates));
    assert_eq!(updates.0, [body]);
    updates.0.clear();
    simulator.settle(Some(&mut updates));
    assert_eq!(updates.0, [], "delivered once");
}

#[test]
fn the_offsets_of_a_geom_are_readable() {
    let mut simulator = simulator(0.0);
    let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(3.0, 4.0));
    let placement = GeomPlacement { offset: v(5.0, -6.0), rotation_offset: 0.5, ..Default::default() };
    let geom = GeomFactory::create_rectangle_geom_in(&mut simulator, body, 4.0, 4.0, placement).unwrap();
    let geom = simulator.geom(geom).unwrap();
    assert_eq!((geom.offset(), geom.rotation_offset()), (v(5.0, -6.0), 0.5));
}

#[test]
fn objects_are_listed_from_the_update_after_they_are_added_until_that_after_they_are_removed() {
    let mut simulator = simulator(0.0);
    let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let listed = |simulator: &PhysicsSimulator| {
        assert_eq!(simulator.geom(geom).unwrap().is_listed(), simulator.is_listed(geom));
        [simulator.is_listed(body), simulator.is_listed(geom)]
    };
    assert_eq!(listed(&simulator), [false; 2]);
    simulator.update(DT);
    assert_eq!(listed(&simulator), [true; 2]);
    simulator.remove(geom).unwrap();
    assert_eq!(listed(&simulator), [true; 2]);
    simulator.update(DT);
    assert_eq!(listed(&simulator), [true, false]);
}

#[test]
fn live_objects_are_enumerated_in_slot_order() {
    let mut simulator = simulator(0.0);
    let made: Vec<_> =
        (0..4).map(|i| add_box(&mut simulator, (10.0, 10.0), v(50.0 * i as f32, 0.0))).collect();
    simulator.dispose(made[1].0).unwrap();
    simulator.remove(made[2].1).unwrap();
    simulator.update(DT);
    let expected = [made[0], made[2], made[3]];
    assert_eq!(simulator.bodies().collect::<Vec<_>>(), expected.map(|(body, _)| body));
    assert_eq!(simulator.geoms().collect::<Vec<_>>(), expected.map(|(_, geom)| geom));
    let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 99.0));
    assert_eq!(simulator.bodies().nth(1), Some(body), "the free slot is used again");
}

#[test]
fn an_object_is_disposed_at_once_and_for_ever() {
    let mut simulator = simulator(0.0);
    let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    assert!(!simulator.is_disposed(body) && !simulator.is_disposed(geom));
    simulator.dispose(body).unwrap();
    assert!(simulator.is_disposed(body) && simulator.is_disposed(geom));
    simulator.update(DT);
    assert!(simulator.is_disposed(body) && simulator.is_disposed(geom));
    assert!(!simulator.is_listed(body) && !simulator.is_listed(geom));
}

#[test]
fn friction_combines_by_the_chosen_type() {
    let mut simulator = simulator(0.0);
    assert_eq!(simulator.mix_friction(0.25, 0.75), 0.5);
    simulator.set_friction_type(FrictionType::Minimum);
    assert_eq!(simulator.mix_friction(0.25, 0.75), 0.25);
}

#[test]
fn settings_let_geoms_collide_by_switch_group_and_either_category() {
    let geom = Geom::default;
    assert!(geom().may_collide_with(&geom()));
    let mut off = geom();
    off.set_collision_enabled(false);
    assert!(!off.may_collide_with(&geom()) && !geom().may_collide_with(&off));
    let mut grouped = geom();
    grouped.set_collision_group(3);
    assert!(!grouped.may_collide_with(&grouped.clone()) && grouped.may_collide_with(&geom()));
    let mut deaf = geom();
    deaf.set_collides_with(CollisionCategory::NONE);
    assert!(deaf.may_collide_with(&geom()), "one direction is enough");
    assert!(!deaf.may_collide_with(&deaf.clone()));
}
