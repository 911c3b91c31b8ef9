//! Cases that once went wrong.

use conformance::fixtures::depth::{
    DT, GRAVITY, assert_near, ball, crate_box, fix, geom_of, place, platform, run, set_surface, simulator,
    solid, throw, velocity, weightless, with_scheme,
};
use twohalf::{
    BodyId, Collision, ContactTarget, Context, DepthScheme, Event, EventHandler, PlatformId,
    TwoHalfPhysicsSimulator, Vector3,
};

#[test]
pub(crate) fn a_body_that_separates_along_z_while_it_lands_stays_on_top() {
    for drift in [-20.0, 0.0, 20.0] {
        let mut simulator = simulator();
        let post = solid(&mut simulator, [100.0, 40.0, 40.0], [0.0, 0.0, 0.0]);
        fix(&mut simulator, post);
        let thrown = solid(&mut simulator, [40.0, 40.0, 40.0], [0.0, 44.0, 37.0]);
        throw(&mut simulator, thrown, [0.0, -900.0, drift]);
        run(&mut simulator, 3);
        assert!(place(&simulator, thrown).y > 35.0, "{drift}: {}", place(&simulator, thrown));
    }
}

#[test]
pub(crate) fn a_body_faster_than_half_of_both_depths_per_step_does_not_tunnel() {
    for phase in 0..20 {
        let mut simulator = weightless();
        let post = solid(&mut simulator, [20.0, 60.0, 20.0], [0.0, 0.0, 0.0]);
        fix(&mut simulator, post);
        // 33 px per step; together they are 40 px deep.
        let thrown =
            solid(&mut simulator, [20.0, 20.0, 20.0], [0.0, 20.0, -100.0 - 33.0 * phase as f32 / 20.0]);
        throw(&mut simulator, thrown, [0.0, 0.0, 3300.0]);
        run(&mut simulator, 20);
        assert!(place(&simulator, thrown).z < -19.0, "phase {phase}: {}", place(&simulator, thrown));
    }
}

#[test]
pub(crate) fn a_box_that_is_given_a_spin_about_x_and_y_stays_where_it_lies() {
    let mut simulator = simulator();
    let body = crate_box(&mut simulator, [40.0, 20.0], [0.0, 0.0, 0.0]);
    set_surface(&mut simulator, body, 0.5, 0.0);
    simulator.body_mut(body).unwrap().set_angular_velocity3d(Vector3::new(-5.0, 3.0, 0.0));
    run(&mut simulator, 300);
    assert!(place(&simulator, body).z.abs() < 1e-3, "{}", place(&simulator, body));
}

#[test]
pub(crate) fn a_figure_that_walks_off_an_edge_is_in_the_air_after_one_step() {
    let mut simulator = simulator();
    platform(&mut simulator, [100.0, 40.0, 100.0], [0.0, 200.0, 0.0]);
    let body = crate_box(&mut simulator, [20.0, 30.0], [0.0, 241.0, 0.0]);
    let mut steps_in_the_air = 0;
    for _ in 0..150 {
        let mut view = simulator.body_mut(body).unwrap();
        view.set_linear_velocity(twohalf::Vector2::new(100.0, 0.0));
        view.set_rotation(0.0);
        simulator.update(DT);
        if place(&simulator, body).x > 60.5 {
            steps_in_the_air += 1;
            assert!(steps_in_the_air < 3 || !simulator.body(body).unwrap().is_grounded());
        }
    }
    assert!(steps_in_the_air > 50);
}

/// Refuses every contact in the callback of one geom as the younger one.
struct RefusesSecondSide(twohalf::GeomId, usize);

impl EventHandler for RefusesSecondSide {
    fn on_collision(&mut self, _: &mut Context<'_>, collision: &Collision) -> bool {
        self.1 += 1;
        collision.this != self.0
    }
}

#[test]
fn a_refusal_by_the_second_side_loses_no_event_of_pairs_that_begin_to_touch_later() {
    let mut simulator = weightless();
    let mut pairs = Vec::new();
    for (row, gap) in [(0.0, 0.0), (200.0, 1.0), (400.0, 1.0)] {
        let older = crate_box(&mut simulator, [40.0, 40.0], [0.0, row, 0.0]);
        let younger = crate_box(&mut simulator, [40.0, 30.0], [39.0 + 20.0 * gap, row + 4.0, 0.0]);
        throw(&mut simulator, younger, [-20.0 * gap, 0.0, 0.0]);
        pairs.push((older, younger));
    }
    let mut handler = RefusesSecondSide(geom_of(&simulator, pairs[0].1), 0);
    for step in 0..200 {
        handler.1 = 0;
        simulator.update_with(DT, &mut handler);
        let told = simulator.events().iter().filter(|event| matches!(event, Event::Collision(_))).count();
        assert_eq!(told, handler.1, "step {step}");
    }
}

/// A platform whose contacts are refused.
struct Refuses(PlatformId);

impl EventHandler for Refuses {
    fn on_collision(&mut self, _: &mut Context<'_>, collision: &Collision) -> bool {
        collision.partner != ContactTarget::Platform(self.0)
    }
}

#[test]
pub(crate) fn a_refused_platform_does_not_take_the_edge_of_a_solid_one_beside_it_away() {
    let height_with = |ghost: bool| {
        let mut simulator = simulator();
        platform(&mut simulator, [200.0, 20.0, 200.0], [100.0, 80.0, 0.0]);
        let refused =
            platform(&mut simulator, [200.0, 20.0, 200.0], [if ghost { -100.0 } else { -900.0 }, 80.0, 0.0]);
        let body = ball(&mut simulator, 20.0, [-3.0, 100.0, 0.0]);
        for _ in 0..40 {
            simulator.update_with(DT, &mut Refuses(refused));
        }
        place(&simulator, body)
    };
    assert_eq!(height_with(true), height_with(false));
}

/// Makes every touching body static.
struct Sticks(BodyId);

impl EventHandler for Sticks {
    fn on_collision(&mut self, context: &mut Context<'_>, _: &Collision) -> bool {
        if let Some(mut body) = context.body_mut(self.0) {
            body.set_is_static(true);
        }
        true
    }
}

#[test]
pub(crate) fn a_body_that_is_made_immovable_where_it_lands_is_healthy() {
    let land = |build: fn(&mut TwoHalfPhysicsSimulator)| {
        let mut simulator = simulator();
        build(&mut simulator);
        let body = crate_box(&mut simulator, [20.0, 20.0], [0.0, 60.0, 0.0]);
        for _ in 0..200 {
            simulator.update_with(DT, &mut Sticks(body));
            assert!(!simulator.events().iter().any(|event| matches!(event, Event::NotFinite { .. })));
        }
        // It keeps the velocity it had, as a conveyor does, and does not move.
        let stuck = place(&simulator, body);
        run(&mut simulator, 10);
        assert_eq!(place(&simulator, body), stuck);
        assert!(simulator.body(body).unwrap().enabled());
    };
    land(|_| ());
    land(|simulator| {
        platform(simulator, [100.0, 20.0, 100.0], [0.0, 0.0, 0.0]);
    });
}

#[test]
fn a_long_box_that_is_thrown_flat_against_a_ceiling_comes_back_flat_at_any_speed() {
    with_scheme(DepthScheme::Precise, || {
        for speed in [600.0, 5000.0, 20_000.0] {
            let mut simulator = simulator();
            platform(&mut simulator, [200.0, 30.0, 100.0], [10.0, 415.0, 0.0]);
            // It touches after a step.
            let body = solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 380.0 - speed * DT, 0.0]);
            throw(&mut simulator, body, [0.0, speed, 0.0]);
            run(&mut simulator, 20);
            let view = simulator.body(body).unwrap();
            // It would turn by several rad/s if its two corners were solved one after the other.
            assert!(view.angular_velocity().abs() < 1e-3, "{speed}: {}", view.angular_velocity());
            assert!(view.velocity3d().y.abs() < 20.0 * GRAVITY * DT, "{speed}: {}", view.velocity3d().y);
        }
    });
}

#[test]
fn without_gravity_slow_collisions_bounce() {
    with_scheme(DepthScheme::Precise, || {
        let mut simulator = weightless();
        let balls = [-20.0, 20.0].map(|z| ball(&mut simulator, 10.0, [0.0, 50.0, z]));
        for (ball, speed) in balls.into_iter().zip([3.0, -3.0]) {
            set_surface(&mut simulator, ball, 0.0, 1.0);
            throw(&mut simulator, ball, [0.0, 0.0, speed]);
        }
        run(&mut simulator, 500);
        // They have met after 10 / 3 s.
        let [near, far] = balls.map(|ball| velocity(&simulator, ball).z);
        assert_near(near, -3.0, 1e-3);
        assert_near(far, 3.0, 1e-3);
    });
}
