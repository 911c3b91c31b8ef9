//! Checks of behaviour chapter 03: contacts, arbiters and the solver. Callbacks are checked with the handlers.

use conformance::fixtures::plane::{
    self, add_box, add_floor, both_sets, faithful, pairs, simulator, simulator_with, v,
};
use conformance::units::assert_words;
use farseer_core::{
    Body, BodyFactory, BodyId, BroadPhaseCollider, Contact, ContactId, Context, EventHandler, FrictionType,
    GeomFactory, GeomId, GeomPlacement, Methods, PhysicsSimulator, index_of_safe,
};

const BOX: (f32, f32) = (10.0, 10.0);

/// Replaces the contacts of one pair by given ones.
struct Puts(GeomId, Option<Vec<Contact>>);

impl EventHandler for Puts {
    fn on_collision(
        &mut self,
        _: &mut Context<'_>,
        this: GeomId,
        _: GeomId,
        contacts: &mut Vec<Contact>,
    ) -> bool {
        if this == self.0
            && let Some(given) = self.1.take()
        {
            *contacts = given;
        }
        true
    }
}

fn contact(position: (f32, f32), normal: (f32, f32), separation: f32, vertex: i32) -> Contact {
    let id = ContactId { geom1: 0, vertex, geom2: 1 };
    Contact::new(v(position.0, position.1), v(normal.0, normal.1), separation, id)
}

/// The two bodies of check 1 with geoms that overlap, and its contacts. The second contact begins without impulse, the
/// first with those that it had.
fn bodies_of_check_1() -> (PhysicsSimulator, [BodyId; 2], [GeomId; 2]) {
    let mut simulator = simulator(0.0);
    let mut make = |position, friction, restitution| {
        let body = simulator.create_body(Body::new());
        simulator.add(body).unwrap();
        simulator[body].set_position(position);
        let geom =
            GeomFactory::create_rectangle_geom_in(&mut simulator, body, 12.0, 12.0, GeomPlacement::default())
                .unwrap();
        simulator[geom].set_friction_coefficient(friction);
        simulator[geom].set_restitution_coefficient(restitution);
        (body, geom)
    };
    let (a, geom_a) = make(v(0.0, 10.0), 0.4, 0.5);
    let (b, geom_b) = make(v(0.5, 0.0), 0.6, 0.3);
    simulator[a].set_is_static(true);
    simulator[b].set_mass(2.0).unwrap();
    simulator[b].set_moment_of_inertia(3.0).unwrap();
    (simulator, [a, b], [geom_a, geom_b])
}

fn impulses(simulator: &PhysicsSimulator) -> Vec<[f32; 2]> {
    let arbiter = simulator.arbiters().next().unwrap();
    arbiter.contacts().map(|contact| [contact.normal_impulse(), contact.tangent_impulse()]).collect()
}

/// Check 1, as far as impulses and motion show it: warm start from preset impulses, then `passes` solver iterations, then
/// positions.
fn after_passes(passes: usize) -> (PhysicsSimulator, BodyId) {
    let (mut simulator, [_, b], [geom_a, _]) = bodies_of_check_1();
    let given = vec![
        contact((-1.25, 1.05), (0.05, -0.998_749_2), -0.04, 0).with_impulses(4.0, -0.5),
        contact((0.75, 1.0), (0.0, -1.0), -0.1, 1),
    ];
    assert!(simulator.process_queues(0.01, None));
    simulator.find_pairs(None);
    let mut handler = Puts(geom_a, Some(given));
    simulator.collide_pairs(Some(&mut handler));
    assert!(handler.1.is_none(), "the geoms do not touch");
    simulator[b].set_linear_velocity(v(1.0, 5.0));
    simulator[b].set_angular_velocity(0.25);
    simulator.pre_step(100.0);
    (0..passes).for_each(|_| simulator.solve_iteration(None));
    simulator.integrate(0.01, None);
    (simulator, b)
}

#[test]
fn the_pre_step_applies_the_impulses_of_the_last_update() {
    let (simulator, b) = after_passes(0);
    assert_words(&simulator[b].linear_velocity(), "3facc28e 4040f5ca");
    assert_words(&simulator[b].angular_velocity(), "40148c17");
}

#[test]
fn a_solver_iteration_has_the_recorded_bits() {
    let (simulator, b) = after_passes(1);
    let [first, second] = impulses(&simulator)[..] else { panic!("two contacts") };
    assert_words(&(first[0], first[1]), "4091ed4c c0070f7c");
    assert_words(&(second[0], second[1]), "411103e4 3f8987a8");
    assert_words(&simulator[b].linear_velocity(), "3fd0b824 bfe0cbec");
    assert_words(&simulator[b].angular_velocity(), "3fd0b824");
}

#[test]
fn two_solver_iterations_and_the_step_have_the_recorded_bits() {
    let (simulator, b) = after_passes(2);
    let [first, second] = impulses(&simulator)[..] else { panic!("two contacts") };
    assert_words(&(first[0], first[1]), "40294c9e bf8fdf54");
    assert_words(&(second[0], second[1]), "412af156 3fb81a1c");
    assert_words(&simulator[b].linear_velocity(), "3f688538 bfd142f6");
    assert_words(&simulator[b].angular_velocity(), "3f688537");
    // The bias velocity of the recorded iterations moves the body as well.
    assert_words(&simulator[b].position(), "3f025341 bd604007");
    assert_words(&simulator[b].rotation(), "3b2fd25c");
    assert_eq!(simulator[b].get_velocity_bias_at_world_offset(v(0.0, 0.0)), v(0.0, 0.0));
}

/// Check 5.
#[test]
fn removing_a_geom_duplicates_the_pairs_behind_it() {
    for (broad, count) in plane::BROAD_PHASES.into_iter().zip([2, 1, 1, 2]) {
        let mut simulator = simulator_with(10.0, faithful(broad, Default::default()));
        let (_, far) = add_box(&mut simulator, BOX, v(1000.0, 0.0));
        add_floor(&mut simulator, (100.0, 10.0), v(0.0, 10.0));
        add_box(&mut simulator, BOX, v(0.0, 0.5));
        (0..4).for_each(|_| simulator.update(0.01));
        assert_eq!(pairs(&simulator), [(1, 2)]);
        simulator.remove(far).unwrap();
        for _ in 0..3 {
            simulator.update(0.01);
            assert_eq!(pairs(&simulator), vec![(1, 2); count], "{broad:?}");
            assert!(simulator.arbiters().all(|arbiter| arbiter.contacts().len() == 4));
        }
    }
}

/// Check 6.
#[test]
fn a_removed_geom_blocks_an_unrelated_pair_for_one_update() {
    let mut simulator = simulator(0.0);
    let boxes = [v(1000.0, 0.0), v(0.0, 0.0), v(9.0, 0.0), v(-500.0, 0.0), v(-1500.0, 0.0)]
        .map(|position| add_box(&mut simulator, BOX, position));
    simulator.update(0.01);
    simulator[boxes[3].0].set_position(v(18.0, 0.0));
    simulator.remove(boxes[0].1).unwrap();
    simulator.update(0.001);
    assert_eq!(pairs(&simulator), [(1, 2), (1, 2)]);
    simulator.update(0.001);
    assert_eq!(pairs(&simulator), [(1, 2), (1, 2), (2, 3)]);
}

/// Counts the collision callbacks that geoms get as the first of the pair.
struct Counts(Vec<u32>);

impl EventHandler for Counts {
    fn on_collision(
        &mut self,
        context: &mut Context<'_>,
        this: GeomId,
        other: GeomId,
        _: &mut Vec<Contact>,
    ) -> bool {
        let number = |geom| context.geom(geom).unwrap().id();
        if number(this) < number(other) {
            self.0.push(number(this));
        }
        true
    }
}

/// Check 7.
#[test]
fn two_pairs_may_share_one_arbiter_after_a_duplicate_was_removed() {
    let mut simulator = simulator(0.0);
    let positions = [1000.0, 0.0, 9.0, 300.0, 400.0, 600.0, 700.0];
    let boxes = positions.map(|x| add_box(&mut simulator, BOX, v(x, 0.0)));
    for (_, geom) in boxes {
        simulator[geom].set_collision_response_enabled(false);
    }
    simulator.update(0.01);
    simulator.remove(boxes[0].1).unwrap();
    simulator.update(0.01);
    assert_eq!(pairs(&simulator), [(1, 2), (1, 2)]);
    simulator.remove(boxes[2].1).unwrap();
    simulator.update(0.01);
    assert_eq!(pairs(&simulator), []);
    simulator[boxes[4].0].set_position(v(309.0, 0.0));
    simulator[boxes[6].0].set_position(v(609.0, 0.0));
    let mut told = || {
        let mut counts = Counts(Vec::new());
        simulator.update_with(0.01, &mut counts);
        counts.0.sort_unstable();
        counts.0
    };
    assert_eq!(told(), [5, 5]);
    assert_eq!(told(), [3, 5, 5]);
    assert_eq!(told(), [3, 5, 5]);
}

/// Check 8.
#[test]
fn a_body_enabled_again_continues_with_its_impulses() {
    let mut simulator = simulator(100.0);
    add_floor(&mut simulator, (200.0, 20.0), v(0.0, 100.0));
    let (body, _) = add_box(&mut simulator, (20.0, 20.0), v(3.0, 80.0));
    (0..60).for_each(|_| simulator.update(0.01));
    let normal = |simulator: &PhysicsSimulator| -> Vec<f32> {
        impulses(simulator).iter().map(|impulse| impulse[0]).collect()
    };
    let expect = |actual: Vec<f32>, words: &str| {
        conformance::units::assert_bits(&actual, &conformance::units::floats(words), || {
            "impulses".to_owned()
        });
    };
    expect(normal(&simulator), "3e5d342b 34be8b4a 3eb4319f 3edd343e");
    simulator[body].set_enabled(false);
    simulator.update(0.01);
    assert_eq!(simulator.arbiter_count(), 0);
    simulator[body].set_enabled(true);
    simulator.update(0.01);
    expect(normal(&simulator), "3e5d342d 34bd16ed 3eb4319f 3edd343e");
    assert_words(&simulator[body].linear_velocity(), "00000000 313a2e80");
    assert_words(&simulator[body].position(), "40400000 42a0051f");
}

fn touching_boxes(friction_type: FrictionType, frictions: [f32; 2]) -> (PhysicsSimulator, [GeomId; 2]) {
    touching_boxes_with(Methods::default(), friction_type, frictions)
}

fn touching_boxes_with(
    methods: Methods,
    friction_type: FrictionType,
    frictions: [f32; 2],
) -> (PhysicsSimulator, [GeomId; 2]) {
    let mut simulator = simulator_with(0.0, methods);
    simulator.set_friction_type(friction_type);
    let geoms = [0.0, 9.0].map(|x| add_box(&mut simulator, BOX, v(x, 0.0)).1);
    for (geom, friction) in geoms.into_iter().zip(frictions) {
        simulator[geom].set_friction_coefficient(friction);
    }
    simulator.update(0.01);
    (simulator, geoms)
}

fn combined_friction(simulator: &PhysicsSimulator) -> f32 {
    simulator.arbiters().next().unwrap().friction()
}

/// Check 9.
#[test]
fn friction_is_fixed_when_boxes_begin_to_overlap() {
    let (mut simulator, geoms) = touching_boxes(FrictionType::Average, [0.5, 0.5]);
    for geom in geoms {
        simulator[geom].set_friction_coefficient(0.0);
    }
    simulator.update(0.01);
    assert_eq!(combined_friction(&simulator), 0.5);
    let (simulator, _) = touching_boxes(FrictionType::Minimum, [0.3, 0.2]);
    assert_words(&combined_friction(&simulator), "3e4ccccd");
}

/// Check 10.
#[test]
fn only_some_switches_separate_touching_boxes() {
    for methods in both_sets() {
        let after = |edit: &dyn Fn(&mut PhysicsSimulator, [GeomId; 2])| {
            let (mut simulator, geoms) = touching_boxes_with(methods, FrictionType::Average, [0.5, 0.5]);
            edit(&mut simulator, geoms);
            simulator.update(0.01);
            (
                simulator.arbiter_count(),
                simulator.events().iter().any(|e| matches!(e, farseer_core::Event::Separation { .. })),
            )
        };
        assert_eq!(after(&|simulator, [a, _]| simulator[a].set_collision_enabled(false)), (1, false));
        assert_eq!(after(&|simulator, [a, b]| simulator.ignore_collision_with(a, b).unwrap()), (1, false));
        let grouped =
            after(&|simulator, geoms| geoms.iter().for_each(|&geom| simulator[geom].set_collision_group(7)));
        // In the original, only the loss of contacts ends a touch.
        let is_told = matches!(methods, Methods::Precise { .. });
        assert_eq!(grouped, (0, is_told));
        let none = farseer_core::CollisionCategory::NONE;
        assert_eq!(after(&|simulator, [a, _]| simulator[a].set_collides_with(none)), (1, false));
        let both =
            after(&|simulator, geoms| geoms.iter().for_each(|&geom| simulator[geom].set_collides_with(none)));
        assert_eq!(both, (0, is_told));
    }
}

/// Check 11.
#[test]
fn contacts_are_sorted_deepest_first() {
    let mut simulator = simulator(0.0);
    simulator.set_max_contacts_to_resolve(100).unwrap();
    add_floor(&mut simulator, (40.0, 10.0), v(0.0, 0.0));
    let (body, _) = add_box(&mut simulator, (30.0, 10.0), v(2.0, 9.0));
    simulator[body].set_rotation(0.05);
    simulator.update(0.01);
    let arbiter = simulator.arbiters().next().unwrap();
    let separations: Vec<f32> = arbiter.contacts().map(|contact| contact.separation).collect();
    let expected = "bfdf2904 bfcd686c bfaf2e20 bf8d6f40 bf7e6680 bf1e70c0 bf1aec28 be79ebe0";
    conformance::units::assert_bits(&separations, &conformance::units::floats(expected), || {
        "depths".to_owned()
    });
}

/// Check 12.
#[test]
fn no_contact_resolved_means_no_arbiter() {
    let (mut simulator, _) = touching_boxes(FrictionType::Average, [0.5, 0.5]);
    simulator.set_max_contacts_to_resolve(0).unwrap();
    simulator.update(0.01);
    assert_eq!(simulator.arbiter_count(), 0);
    assert!(simulator.set_max_contacts_to_resolve(-1).is_err());
}

/// Check 13.
#[test]
fn contacts_of_one_id_are_equal_at_any_position() {
    let (a, b) = (contact((0.0, 0.0), (1.0, 0.0), -1.0, 5), contact((9.0, 9.0), (0.0, 1.0), -2.0, 5));
    assert_eq!(a, b);
    let unknown = contact((0.0, 0.0), (1.0, 0.0), -1.0, 6);
    assert_eq!(index_of_safe(&[a, b], &b), Some(0));
    assert_eq!(index_of_safe(&[a, b], &unknown), None);
}

/// Check 14, and chapter 04, check 15.
#[test]
fn a_box_dropped_on_a_floor_has_the_recorded_bits() {
    let mut simulator = simulator(100.0);
    let (_, floor) = add_floor(&mut simulator, (200.0, 20.0), v(0.0, 100.0));
    let body = BodyFactory::create_rectangle_body_in(&mut simulator, 20.0, 20.0, 1.0).unwrap();
    simulator[body].set_position(v(3.0, 60.0));
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_rectangle_geom_in(&mut simulator, body, 20.0, 20.0, placement).unwrap();
    simulator[body].set_rotation(0.3);
    simulator[floor].set_friction_coefficient(0.4);
    simulator[geom].set_friction_coefficient(0.4);
    simulator[geom].set_restitution_coefficient(0.2);
    let mut done = 0;
    for (updates, position, rotation, velocity, angular_velocity) in [
        (1, "40400000 42700a3d", "3e99999a", "00000000 3f800000", "00000000"),
        (51, "40400000 429283ff", "3e99999a", "00000000 424bf2f3", "00000000"),
        (151, "c0130e3e 42a00079", "391b09e4", "be32ac57 be04cf96", "bc8ef046"),
        (251, "c0136bdd 42a002a6", "40c90eef", "3d666dd5 bd6a92ed", "3bb87944"),
        (501, "c0136ed7 42a001cd", "38930000", "3da77e91 bdb42cda", "3c05feda"),
        (1001, "c013ce06 42a002d3", "38816654", "bd9e1ab0 bd923e32", "bbfcf780"),
    ] {
        (done..updates).for_each(|_| simulator.update(0.01));
        done = updates;
        assert_words(&simulator[body].position(), position);
        assert_words(&simulator[body].rotation(), rotation);
        assert_words(&simulator[body].linear_velocity(), velocity);
        assert_words(&simulator[body].angular_velocity(), angular_velocity);
    }
}

#[test]
fn geoms_without_response_carry_their_impulses_along() {
    let mut simulator = simulator(100.0);
    let (_, floor) = add_floor(&mut simulator, (200.0, 20.0), v(0.0, 100.0));
    let (body, _) = add_box(&mut simulator, (20.0, 20.0), v(3.0, 80.0));
    (0..60).for_each(|_| simulator.update(0.01));
    let before = impulses(&simulator);
    simulator[floor].set_collision_response_enabled(false);
    simulator[body].set_ignore_gravity(true);
    simulator[body].set_linear_velocity(v(0.0, 0.0));
    simulator.update(0.01);
    assert_eq!(impulses(&simulator), before);
    assert_eq!(simulator.broad_phase_collider(), BroadPhaseCollider::SelectiveSweep);
}
