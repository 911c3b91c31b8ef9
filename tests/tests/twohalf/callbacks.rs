//! Callbacks of a game, and its refusals. Edits in callbacks are in `edits`.

use conformance::fixtures::depth::{
    AXES, DT, FALLS, GRAVITY, SLOP, assert_near, assert_near3, ball, falling, fix, geom_of, pair_along,
    place, platform, run, run_with, set_surface, simulator, solid, throw, velocity, weightless,
};
use twohalf::{
    Axis, BodyId, Collision, CollisionCategory, ContactTarget, Context, Event, EventHandler, GeomId,
    TwoHalfPhysicsSimulator, Vector3,
};

/// Velocities of a few hundred px/s after a few hundred operations of f32.
const ROUNDING: f32 = 1e-3;

/// Records its calls, and refuses on request.
#[derive(Default)]
struct Listener {
    collisions: Vec<Collision>,
    separations: Vec<(GeomId, ContactTarget)>,
    updated: Vec<BodyId>,
    /// The handler's answer.
    refuses: Option<fn(&Context<'_>, &Collision) -> bool>,
}

impl EventHandler for Listener {
    fn on_collision(&mut self, context: &mut Context<'_>, collision: &Collision) -> bool {
        self.collisions.push(*collision);
        !self.refuses.is_some_and(|refuses| refuses(context, collision))
    }

    fn on_separation(&mut self, _: &mut Context<'_>, this: GeomId, partner: ContactTarget) {
        self.separations.push((this, partner));
    }

    fn on_body_updated(&mut self, _: &mut Context<'_>, body: BodyId) {
        self.updated.push(body);
    }
}

impl Listener {
    fn that_refuses(refuses: fn(&Context<'_>, &Collision) -> bool) -> Self {
        Listener { refuses: Some(refuses), ..Listener::default() }
    }
}

/// The collisions among the events of the last update.
fn told(simulator: &TwoHalfPhysicsSimulator) -> Vec<Collision> {
    let collision = |event: &Event| match event {
        Event::Collision(collision) => Some(*collision),
        _ => None,
    };
    simulator.events().iter().filter_map(collision).collect()
}

fn run_until_told(simulator: &mut TwoHalfPhysicsSimulator, handler: &mut Listener) -> Vec<Collision> {
    for _ in 0..1000 {
        simulator.update_with(DT, handler);
        if !told(simulator).is_empty() {
            return told(simulator);
        }
    }
    panic!("nothing touches");
}

/// In the plane the 2D engine calls the handler, along Z this one.
#[test]
pub(crate) fn a_geom_whose_callbacks_are_off_gets_none_and_its_partner_does() {
    for axis in AXES {
        let (mut simulator, bodies, _) = pair_along(axis, 1.0);
        let [silent, heard] = bodies.map(|body| geom_of(&simulator, body));
        simulator.geom_mut(silent).unwrap().set_collision_callbacks_enabled(false);
        let mut listener = Listener::default();
        let events = run_until_told(&mut simulator, &mut listener);
        assert_eq!(events.len(), 2);
        (0..60).for_each(|_| simulator.update_with(DT, &mut listener));
        assert!(listener.collisions.iter().all(|collision| collision.this == heard));
        assert!(listener.separations.iter().all(|&(this, _)| this == heard));
        assert!(!listener.collisions.is_empty() && !listener.separations.is_empty());
    }
}

#[test]
fn a_geom_without_callbacks_gets_none_for_ground_and_platform() {
    for on_platform in [false, true] {
        let (mut simulator, body, _) = falling(false, on_platform, 0.0);
        let geom = geom_of(&simulator, body);
        simulator.geom_mut(geom).unwrap().set_collision_callbacks_enabled(false);
        let mut listener = Listener::that_refuses(|_, _| true);
        (0..300).for_each(|_| simulator.update_with(DT, &mut listener));
        assert!(listener.collisions.is_empty() && !told(&simulator).is_empty());
    }
}

#[test]
fn both_handlers_of_a_hit_are_called_the_older_first_with_opposite_normals() {
    for axis in AXES {
        let (mut simulator, bodies, direction) = pair_along(axis, 0.0);
        let geoms = bodies.map(|body| geom_of(&simulator, body));
        let mut listener = Listener::default();
        let events = run_until_told(&mut simulator, &mut listener);
        assert_eq!(events.len(), 2);
        for heard in [&events, &listener.collisions] {
            let [first, second] = [heard[0], heard[1]];
            assert_eq!((first.this, first.partner), (geoms[0], ContactTarget::Geom(geoms[1])));
            assert_eq!((second.this, second.partner), (geoms[1], ContactTarget::Geom(geoms[0])));
            for collision in [first, second] {
                assert_eq!((collision.axis, collision.vetoed), (axis, false));
                assert!(!collision.partner.is_ground());
            }
            // The thrown one bounces back, the other one moves on.
            assert_near3(second.normal, (-direction).into(), 1e-5);
            assert_near3(first.normal, direction.into(), 1e-5);
            assert_eq!(first.position, second.position);
            // In the plane the 2D engine finds the corners of both.
            let expected = match axis {
                Axis::Plane => 4,
                Axis::Depth => 2,
                Axis::Oblique => 1,
            };
            assert_eq!(first.contacts, expected);
        }
    }
}

#[test]
fn the_impulse_of_a_hit_is_the_reduced_mass_times_the_speed_times_1_plus_the_restitution() {
    for axis in AXES {
        for restitution in [0.0, 0.5, 1.0] {
            let (mut simulator, ..) = pair_along(axis, restitution);
            let mut listener = Listener::default();
            for collision in run_until_told(&mut simulator, &mut listener) {
                // 2 x 1 / (2 + 1). Four points in the plane: five iterations leave 2e-4 of it (measured).
                let expected = 2.0 / 3.0 * 80.0 * (1.0 + restitution);
                assert_near(collision.normal_impulse, expected, 5e-4 * expected);
            }
            // The callback comes before the solver.
            assert!(listener.collisions.iter().all(|collision| collision.normal_impulse == 0.0));
        }
    }
}

#[test]
pub(crate) fn the_object_gets_callbacks_of_ground_and_platforms_with_an_upward_normal() {
    for (is_ball, on_platform) in FALLS {
        let (mut simulator, body, partner) = falling(is_ball, on_platform, 0.5);
        let mut listener = Listener::default();
        let events = run_until_told(&mut simulator, &mut listener);
        assert_eq!(events.len(), 1);
        let hit = events[0];
        assert_eq!((hit.this, hit.partner, hit.axis), (geom_of(&simulator, body), partner, Axis::Plane));
        assert_eq!(hit.partner.is_ground(), !on_platform);
        assert_eq!(hit.normal, Vector3::new(0.0, 1.0, 0.0));
        assert_eq!(hit.contacts, if is_ball { 1 } else { 2 });
        // sqrt(2 g h), and the velocities of half a step and of the step of the contact.
        let speed = (2.0 * GRAVITY * 100.0).sqrt();
        assert_near(hit.normal_impulse, 1.5 * speed, 1.5 * 1.5 * GRAVITY * DT);
    }
}

#[test]
pub(crate) fn a_resting_body_gets_a_callback_in_every_update_with_the_impulse_that_carries_it() {
    for (is_ball, on_platform) in FALLS {
        let (mut simulator, _, partner) = falling(is_ball, on_platform, 0.0);
        run(&mut simulator, 300);
        let mut listener = Listener::default();
        run_with(&mut simulator, &mut listener, 20);
        assert_eq!(listener.collisions.len(), 20);
        for collision in &listener.collisions {
            assert_eq!(collision.partner, partner);
            // m g dt; the callback gets the impulse of the last update.
            assert_near(collision.normal_impulse, GRAVITY * DT, 0.05 * GRAVITY * DT);
        }
        assert!(listener.separations.is_empty());
    }
}

#[test]
pub(crate) fn a_refused_contact_has_no_effect_along_any_axis() {
    for axis in AXES {
        let (mut simulator, bodies, direction) = pair_along(axis, 0.5);
        let mut listener = Listener::that_refuses(|_, _| true);
        run_with(&mut simulator, &mut listener, 250);
        assert_eq!(velocity(&simulator, bodies[1]), direction * 80.0);
        assert_eq!(velocity(&simulator, bodies[0]), Vector3::zeros());
        assert!(listener.collisions.len() > 10);
        // The second side gets no callback, and geoms that never touched do not separate.
        let older = geom_of(&simulator, bodies[0]);
        assert!(listener.collisions.iter().all(|collision| collision.this == older));
        assert!(listener.separations.is_empty());
    }
}

#[test]
pub(crate) fn a_refusal_is_an_event() {
    for axis in AXES {
        let (mut simulator, bodies, _) = pair_along(axis, 0.5);
        let mut listener = Listener::that_refuses(|_, _| true);
        let events = run_until_told(&mut simulator, &mut listener);
        assert_eq!(events.len(), 1);
        assert_eq!((events[0].this, events[0].vetoed), (geom_of(&simulator, bodies[0]), true));
        assert_eq!(events[0].axis, axis);
        assert_eq!(simulator.contacts().count(), 0);
    }
}

/// Refuses on behalf of the younger geom, the thrown one of mass 1.
fn second_side_refuses(context: &Context<'_>, collision: &Collision) -> bool {
    let body = context.geom(collision.this).map(|geom| geom.body());
    body.and_then(|body| context.body(body)).is_some_and(|body| body.mass() == 1.0)
}

#[test]
pub(crate) fn the_second_side_may_refuse_as_well() {
    for axis in AXES {
        let (mut simulator, bodies, direction) = pair_along(axis, 0.5);
        let mut listener = Listener::that_refuses(second_side_refuses);
        let events = run_until_told(&mut simulator, &mut listener);
        let younger = geom_of(&simulator, bodies[1]);
        assert!(events.iter().any(|event| (event.this, event.vetoed) == (younger, true)), "{axis:?}");
        assert!(events.iter().all(|event| event.normal_impulse == 0.0), "{axis:?}");
        run_with(&mut simulator, &mut listener, 200);
        assert_eq!(velocity(&simulator, bodies[1]), direction * 80.0, "{axis:?}");
    }
}

#[test]
fn a_refusal_of_the_second_side_hides_no_other_contact() {
    let (mut simulator, _, _) = pair_along(Axis::Plane, 0.5);
    // Another pair, younger, that overlaps at rest high above.
    let others = [0.0, 39.97].map(|x| solid(&mut simulator, [40.0, 40.0, 40.0], [x, 900.0, 0.0]));
    for body in others {
        simulator.body_mut(body).unwrap().set_mass(2.0).unwrap();
    }
    let mut listener = Listener::that_refuses(second_side_refuses);
    let geom = geom_of(&simulator, others[0]);
    let (mut both, mut refused) = (0, 0);
    for step in 0..100 {
        simulator.update_with(DT, &mut listener);
        let is_told = |heard: &[Collision]| heard.iter().any(|collision| collision.this == geom);
        assert_eq!(is_told(&told(&simulator)), is_told(&listener.collisions), "step {step}");
        let has_refused = told(&simulator).iter().any(|event| event.vetoed);
        refused += usize::from(has_refused);
        both += usize::from(has_refused && is_told(&listener.collisions));
        listener.collisions.clear();
    }
    assert!(both > 20 && both == refused, "{both} of {refused}");
}

#[test]
pub(crate) fn a_refused_ground_or_platform_is_fallen_through() {
    for (is_ball, on_platform) in FALLS {
        let (mut simulator, body, partner) = falling(is_ball, on_platform, 0.5);
        let mut listener = Listener::that_refuses(|_, _| true);
        run_with(&mut simulator, &mut listener, 300);
        // v = g t, n steps of g dt.
        assert_near(velocity(&simulator, body).y, -GRAVITY * 3.0, 0.01);
        assert!(listener.collisions.iter().any(|collision| collision.partner == partner));
    }
}

/// Lets objects through a platform from below: refuses it while their lowest point is not over its top, but for 2 px.
struct OneWay;

impl EventHandler for OneWay {
    fn on_collision(&mut self, context: &mut Context<'_>, collision: &Collision) -> bool {
        let ContactTarget::Platform(id) = collision.partner else { return true };
        let Some(platform) = context.platform(id) else { return true };
        let top = platform.position3d().y + platform.height();
        let body = context.geom(collision.this).and_then(|geom| context.body(geom.body()));
        body.is_none_or(|body| body.position3d().y >= top - 2.0)
    }
}

#[test]
pub(crate) fn a_one_way_platform_is_jumped_through_from_below_and_stood_on() {
    for is_ball in [true, false] {
        let mut simulator = simulator();
        platform(&mut simulator, [200.0, 20.0, 100.0], [0.0, 60.0, 0.0]);
        let body = match is_ball {
            true => ball(&mut simulator, 10.0, [0.0, 0.0, 0.0]),
            false => solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 0.0, 0.0]),
        };
        // 112 px high.
        throw(&mut simulator, body, [0.0, 150.0, 0.0]);
        let mut highest: f32 = 0.0;
        for _ in 0..400 {
            simulator.update_with(DT, &mut OneWay);
            highest = highest.max(place(&simulator, body).y);
        }
        assert_near(highest, 112.5 - 0.75, 1.5);
        assert_near3(place(&simulator, body), [0.0, 80.0, 0.0], SLOP + 0.02);
        assert!(simulator.body(body).unwrap().is_grounded());
    }
}

#[test]
pub(crate) fn a_platform_without_refusals_is_not_jumped_through() {
    let mut simulator = simulator();
    platform(&mut simulator, [200.0, 20.0, 100.0], [0.0, 60.0, 0.0]);
    let body = ball(&mut simulator, 10.0, [0.0, 0.0, 0.0]);
    throw(&mut simulator, body, [0.0, 150.0, 0.0]);
    let mut listener = Listener::default();
    run_with(&mut simulator, &mut listener, 400);
    assert_near(place(&simulator, body).y, 0.0, SLOP + 0.02);
}

/// A sensor of 40 x 40 x 40 whose middle is at (0, 520, 0).
fn sensor(simulator: &mut TwoHalfPhysicsSimulator) -> GeomId {
    let body = solid(simulator, [40.0, 40.0, 40.0], [0.0, 500.0, 0.0]);
    let geom = geom_of(simulator, body);
    simulator.set_is_sensor(geom, true).unwrap();
    geom
}

#[test]
fn a_sensor_reports_bodies_along_every_axis_and_does_not_push() {
    for direction in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.6, 0.0, 0.8]].map(Vector3::from) {
        for is_ball in [true, false] {
            let mut simulator = weightless();
            let geom = sensor(&mut simulator);
            let start = Vector3::new(0.0, 510.0, 0.0) - direction * 80.3;
            let body = match is_ball {
                true => ball(&mut simulator, 10.0, start.into()),
                false => solid(&mut simulator, [20.0, 20.0, 20.0], start.into()),
            };
            throw(&mut simulator, body, (direction * 80.0).into());
            let mut listener = Listener::default();
            run_with(&mut simulator, &mut listener, 200);
            assert_eq!(velocity(&simulator, body), direction * 80.0);
            let felt = listener.collisions.iter().filter(|collision| collision.this == geom).count();
            // 60 px at 0.8 px per step, obliquely up to 60 / 0.8 px, or less where a ball cuts a corner.
            assert!((40..=94).contains(&felt), "{felt} steps, ball: {is_ball}, {direction:?}");
            let partner = ContactTarget::Geom(geom_of(&simulator, body));
            assert_eq!(listener.separations.iter().filter(|told| **told == (geom, partner)).count(), 1);
        }
    }
}

#[test]
pub(crate) fn a_sensor_does_not_report_bodies_in_front_of_it_or_behind() {
    for z in [-31.0, 31.0] {
        let mut simulator = weightless();
        sensor(&mut simulator);
        let body = solid(&mut simulator, [20.0, 20.0, 20.0], [-80.0, 510.0, z]);
        throw(&mut simulator, body, [80.0, 0.0, 0.0]);
        let mut listener = Listener::default();
        run_with(&mut simulator, &mut listener, 200);
        assert!(listener.collisions.is_empty());
    }
}

/// Sets up two geoms that do not collide.
type Parting = fn(&mut TwoHalfPhysicsSimulator, [GeomId; 2]);

/// Settings that keep two geoms from colliding.
const PARTINGS: [Parting; 4] = [
    |simulator, geoms| {
        for geom in geoms {
            simulator.geom_mut(geom).unwrap().set_collision_group(7);
        }
    },
    |simulator, geoms| {
        for (geom, category) in
            geoms.into_iter().zip([CollisionCategory::from_bits(1), CollisionCategory::from_bits(2)])
        {
            let settings = simulator.geom_mut(geom).unwrap();
            settings.set_collision_categories(category);
            settings.set_collides_with(category);
        }
    },
    |simulator, geoms| simulator.geom_mut(geoms[0]).unwrap().set_collision_enabled(false),
    |simulator, geoms| simulator.ignore_collision_with(geoms[0], geoms[1]).unwrap(),
];

#[test]
pub(crate) fn groups_categories_and_exceptions_count_in_every_axis() {
    for axis in AXES {
        for parting in PARTINGS {
            let (mut simulator, bodies, direction) = pair_along(axis, 0.5);
            let geoms = bodies.map(|body| geom_of(&simulator, body));
            parting(&mut simulator, geoms);
            let mut listener = Listener::default();
            run_with(&mut simulator, &mut listener, 250);
            assert_eq!(velocity(&simulator, bodies[1]), direction * 80.0, "{axis:?}");
            assert!(listener.collisions.is_empty());
        }
    }
}

#[test]
pub(crate) fn geoms_of_different_groups_collide_in_every_axis() {
    for axis in AXES {
        let (mut simulator, bodies, direction) = pair_along(axis, 0.5);
        for (body, group) in bodies.into_iter().zip([3, 4]) {
            let geom = geom_of(&simulator, body);
            simulator.geom_mut(geom).unwrap().set_collision_group(group);
        }
        run(&mut simulator, 150);
        assert!(velocity(&simulator, bodies[1]).dot(&direction) < 1.0, "{axis:?}");
    }
}

#[test]
pub(crate) fn groups_categories_and_switches_count_for_platforms() {
    for way in 0..4 {
        for is_ball in [true, false] {
            let (mut simulator, body, partner) = falling(is_ball, true, 0.0);
            let geom = geom_of(&simulator, body);
            let ContactTarget::Platform(id) = partner else { unreachable!() };
            let mut floor = simulator.platform_mut(id).unwrap();
            match way {
                0 => floor.set_collision_group(7),
                1 => {
                    floor.set_collision_categories(CollisionCategory::from_bits(1));
                    floor.set_collides_with(CollisionCategory::from_bits(1));
                }
                2 => floor.set_collision_enabled(false),
                _ => floor.set_collision_response_enabled(false),
            }
            let settings = simulator.geom_mut(geom).unwrap();
            settings.set_collision_group(7);
            settings.set_collision_categories(CollisionCategory::from_bits(2));
            settings.set_collides_with(CollisionCategory::from_bits(2));
            if way == 3 {
                settings.set_collision_group(0);
                settings.set_collides_with(CollisionCategory::ALL);
            }
            let mut listener = Listener::default();
            run_with(&mut simulator, &mut listener, 400);
            // It falls through the platform; its ground has no category.
            assert!(place(&simulator, body).y < 1.0, "way {way}");
            // Without collision response the callback comes all the same.
            let is_told = listener.collisions.iter().any(|collision| collision.partner == partner);
            assert_eq!(is_told, way == 3, "way {way}");
        }
    }
}

#[test]
pub(crate) fn a_separation_is_reported_once_to_each_side_along_every_axis() {
    for axis in AXES {
        let (mut simulator, bodies, _) = pair_along(axis, 1.0);
        let geoms = bodies.map(|body| geom_of(&simulator, body));
        let mut listener = Listener::default();
        let mut events = Vec::new();
        for _ in 0..250 {
            simulator.update_with(DT, &mut listener);
            events.extend(simulator.events().iter().filter_map(|event| match event {
                Event::Separation { this, partner } => Some((*this, *partner)),
                _ => None,
            }));
        }
        let expected = [(geoms[0], ContactTarget::Geom(geoms[1])), (geoms[1], ContactTarget::Geom(geoms[0]))];
        assert_eq!(events.len(), 2, "{axis:?}");
        for side in expected {
            assert!(listener.separations.contains(&side) && events.contains(&side), "{axis:?}");
        }
        assert_eq!(listener.separations.len(), 2);
    }
}

#[test]
pub(crate) fn a_bounce_off_the_ground_is_one_separation() {
    for (is_ball, on_platform) in FALLS {
        let (mut simulator, body, partner) = falling(is_ball, on_platform, 0.5);
        let mut listener = Listener::default();
        // After 1.41 s it lands, for half as long it is in the air again.
        run_with(&mut simulator, &mut listener, 200);
        assert_eq!(listener.separations, [(geom_of(&simulator, body), partner)]);
    }
}

#[test]
pub(crate) fn starting_and_stopping_to_slide_in_depth_is_no_separation() {
    let mut simulator = simulator();
    let table = solid(&mut simulator, [200.0, 40.0, 200.0], [0.0, 0.0, 0.0]);
    fix(&mut simulator, table);
    let body = solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 40.0, 0.0]);
    for body in [table, body] {
        set_surface(&mut simulator, body, 0.4, 0.0);
    }
    run(&mut simulator, 50);
    let mut listener = Listener::default();
    for _ in 0..4 {
        throw(&mut simulator, body, [0.0, 0.0, 30.0]);
        run_with(&mut simulator, &mut listener, 100);
        assert_near(velocity(&simulator, body).z, 0.0, ROUNDING);
    }
    assert!(listener.separations.is_empty());
    // Once to each side in every update.
    let to_body = listener.collisions.iter().filter(|told| told.this == geom_of(&simulator, body)).count();
    assert_eq!(to_body, 400);
}

#[test]
pub(crate) fn a_contact_that_ends_by_removing_disposing_or_disabling_is_no_separation() {
    for way in 0..3 {
        for axis in AXES {
            let (mut simulator, bodies, _) = pair_along(axis, 0.0);
            let mut listener = Listener::default();
            run_until_told(&mut simulator, &mut listener);
            let geom = geom_of(&simulator, bodies[1]);
            match way {
                0 => simulator.remove(geom).unwrap(),
                1 => simulator.dispose(bodies[1]).unwrap(),
                _ => simulator.body_mut(bodies[1]).unwrap().set_enabled(false),
            }
            run_with(&mut simulator, &mut listener, 5);
            assert!(listener.separations.is_empty(), "way {way}, {axis:?}");
        }
    }
}

#[test]
pub(crate) fn a_body_that_moves_only_along_z_is_reported_as_updated_once_per_update() {
    for is_ball in [true, false] {
        let mut simulator = weightless();
        let body = match is_ball {
            true => ball(&mut simulator, 10.0, [0.0, 500.0, 0.0]),
            false => solid(&mut simulator, [20.0, 20.0, 20.0], [0.0, 500.0, 0.0]),
        };
        let still = ball(&mut simulator, 10.0, [100.0, 500.0, 0.0]);
        run(&mut simulator, 3);
        throw(&mut simulator, body, [0.0, 0.0, 30.0]);
        let mut listener = Listener::default();
        let mut events = 0;
        for _ in 0..10 {
            simulator.update_with(DT, &mut listener);
            let is_it = |event: &&Event| **event == Event::BodyUpdated { body };
            events += simulator.events().iter().filter(is_it).count();
        }
        let heard = |id: BodyId| listener.updated.iter().filter(|&&told| told == id).count();
        // A setter put it there, which is reported from then on as in the 2D engine, and never twice.
        assert_eq!((heard(body), events), (10, 10));
        assert!(heard(still) <= 10);
    }
}

#[test]
pub(crate) fn an_unplaced_body_that_moves_only_along_z_is_reported_only_while_it_moves() {
    use twohalf_factories::{TwoHalfBodyFactory, TwoHalfGeomFactory};
    let mut simulator = weightless();
    let body = TwoHalfBodyFactory::create_circle_body(&mut simulator, 10.0, 1.0).unwrap();
    TwoHalfGeomFactory::create_circle_geom(&mut simulator, body, 10.0, 16).unwrap();
    simulator.body_mut(body).unwrap().set_linear_drag_coefficient(0.0);
    let mut listener = Listener::default();
    run_with(&mut simulator, &mut listener, 5);
    assert_eq!(listener.updated, []);
    simulator.body_mut(body).unwrap().set_linear_velocity_z(10.0);
    run_with(&mut simulator, &mut listener, 5);
    assert_eq!(listener.updated, [body; 5]);
    simulator.body_mut(body).unwrap().set_linear_velocity_z(0.0);
    run_with(&mut simulator, &mut listener, 5);
    assert_eq!(listener.updated, [body; 5]);
}
