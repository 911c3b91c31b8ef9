//! Figures between two sides that crush them, and the time of the report.

use conformance::fixtures::depth::{
    assert_goes_on_after_loading, assert_near, ball, fix, geom_of, platform, run, simulator, solid,
    with_scheme,
};
use twohalf::{
    BodyId, ContactTarget, CrushInfo, DepthScheme, Event, PlatformId, TwoHalfPhysicsSimulator, Vector2,
    Vector3,
};
use twohalf_factories::{Figure, spawn};

fn precise(test: impl FnOnce()) {
    with_scheme(DepthScheme::Precise, test);
}

fn crushed(simulator: &TwoHalfPhysicsSimulator) -> Vec<(BodyId, CrushInfo)> {
    let told = |event: &Event| match *event {
        Event::Crushed { body, squeeze } => Some((body, squeeze)),
        _ => None,
    };
    simulator.events().iter().filter_map(told).collect()
}

/// A figure of 60 px on a lift that goes up, below a ceiling at 100 px.
fn lift_below_ceiling(rate: f32, speed: f32) -> (TwoHalfPhysicsSimulator, BodyId, [PlatformId; 2]) {
    let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0)).unwrap();
    let ceiling = platform(&mut simulator, [200.0, 30.0, 100.0], [0.0, 100.0, 50.0]);
    let lift = platform(&mut simulator, [80.0, 20.0, 100.0], [0.0, 0.0, 50.0]);
    let figure = spawn(&mut simulator, Figure::new([30.0, 60.0, 20.0]).at([0.0, 20.0, 50.0])).unwrap().body;
    (0..rate as usize).for_each(|_| simulator.update(1.0 / rate));
    simulator.platform_mut(lift).unwrap().set_velocity(Vector3::new(0.0, speed, 0.0)).unwrap();
    (simulator, figure, [lift, ceiling])
}

#[test]
fn a_lift_below_a_ceiling_crushes_when_the_space_is_used_up_at_every_rate() {
    for rate in [30.0, 60.0, 120.0, 240.0] {
        let (mut simulator, figure, [lift, ceiling]) = lift_below_ceiling(rate, 40.0);
        simulator.set_crush_tolerance(figure, Some(4.0)).unwrap();
        let mut told = Vec::new();
        for step in 1..=(rate as usize) {
            simulator.update(1.0 / rate);
            told.extend(crushed(&simulator).into_iter().map(|(body, squeeze)| (step, body, squeeze)));
        }
        let &[(step, body, squeeze)] = &told[..] else { panic!("{rate}: {told:?}") };
        assert_eq!(body, figure);
        assert_eq!(
            (squeeze.axis, squeeze.between),
            (Vector3::y(), [ContactTarget::Platform(lift), ContactTarget::Platform(ceiling)])
        );
        // 20 px to the ceiling and 4 px into it, at 40 px/s.
        assert_near(step as f32 / rate, 24.0 / 40.0, 1.5 / rate);
        let at_the_end = simulator.crush_info(figure).unwrap();
        assert_near(at_the_end.depth, 20.0, 0.5);
    }
}

#[test]
fn crush_info_is_available_right_after_a_load() {
    // One that is slow is edited at the end of every update.
    for scale in [1.0, 0.5, 0.0] {
        let (mut simulator, figure, _) = lift_below_ceiling(60.0, 40.0);
        simulator.set_time_scale(figure, scale).unwrap();
        (0..60).for_each(|_| simulator.update(1.0 / 60.0));
        let mut loaded = TwoHalfPhysicsSimulator::new(1).unwrap();
        loaded.restore(&simulator.snapshot()).unwrap();
        assert_eq!(loaded.crush_info(figure), simulator.crush_info(figure), "{scale}");
        assert_eq!(loaded.crush_info(figure).is_some(), scale > 0.0, "{scale}");
    }
}

#[test]
fn a_crush_is_reported_again_after_a_release() {
    let (mut simulator, figure, [lift, _]) = lift_below_ceiling(60.0, 40.0);
    simulator.set_crush_tolerance(figure, Some(2.0)).unwrap();
    let mut count = 0;
    for half in 0..4 {
        let speed = if half % 2 == 0 { 40.0 } else { -40.0 };
        simulator.platform_mut(lift).unwrap().set_velocity(Vector3::new(0.0, speed, 0.0)).unwrap();
        for _ in 0..40 {
            simulator.update(1.0 / 60.0);
            count += crushed(&simulator).len();
        }
    }
    assert_eq!(count, 2);
}

#[test]
fn a_wall_that_approaches_along_each_axis_crushes_along_it() {
    precise(|| {
        for axis in [0, 2] {
            let mut simulator = simulator();
            let mut size = [60.0, 60.0, 60.0];
            size[axis] = 20.0;
            let offset = |by: f32| {
                let mut place = [0.0, 0.0, 100.0];
                place[axis] += by;
                place
            };
            let fixed = platform(&mut simulator, size, offset(30.0));
            let moving = platform(&mut simulator, size, offset(-60.0));
            let body = solid(&mut simulator, [40.0; 3], [0.0, 0.0, 100.0]);
            let mut velocity = Vector3::zeros();
            velocity[axis] = 50.0;
            simulator.platform_mut(moving).unwrap().set_velocity(velocity).unwrap();
            run(&mut simulator, 90);
            let squeeze = simulator.crush_info(body).unwrap();
            let mut direction = Vector3::zeros();
            direction[axis] = 1.0;
            assert_eq!(squeeze.axis, direction);
            assert_eq!(squeeze.between, [moving, fixed].map(ContactTarget::Platform));
            // 45 px of motion, of which 30 were free.
            assert_near(squeeze.depth, 15.0, 0.5);
        }
    });
}

#[test]
fn a_pushed_body_transmits_the_crush() {
    precise(|| {
        let mut simulator = simulator();
        let wall = solid(&mut simulator, [20.0, 60.0, 60.0], [70.0, 0.0, 100.0]);
        fix(&mut simulator, wall);
        let ram = platform(&mut simulator, [20.0, 60.0, 60.0], [-70.0, 0.0, 100.0]);
        let bodies = [-40.0, 0.0, 40.0].map(|x| solid(&mut simulator, [40.0; 3], [x, 0.0, 100.0]));
        simulator.platform_mut(ram).unwrap().set_velocity(Vector3::new(20.0, 0.0, 0.0)).unwrap();
        run(&mut simulator, 60);
        let all: Vec<CrushInfo> = bodies.iter().map(|&body| simulator.crush_info(body).unwrap()).collect();
        assert!(all.iter().all(|squeeze| squeeze.axis == Vector3::x() && squeeze.depth > 1.0), "{all:?}");
        assert_eq!(all[2].between[1], ContactTarget::Geom(geom_of(&simulator, wall)));
    });
}

#[test]
fn bodies_in_a_pile_are_not_crushed() {
    precise(|| {
        let mut simulator = simulator();
        let column: Vec<BodyId> =
            (0..10).map(|at| solid(&mut simulator, [20.0; 3], [0.0, 20.0 * at as f32, 50.0])).collect();
        column.iter().for_each(|&body| simulator.set_crush_tolerance(body, Some(0.5)).unwrap());
        for _ in 0..400 {
            run(&mut simulator, 1);
            assert_eq!(crushed(&simulator), []);
        }
        assert!(simulator.crush_info(column[0]).is_some_and(|squeeze| squeeze.axis == Vector3::y()));
        assert_eq!(simulator.crush_info(column[9]), None);
    });
}

#[test]
fn a_ball_that_hits_a_wall_is_not_crushed() {
    precise(|| {
        let mut simulator = simulator();
        platform(&mut simulator, [20.0, 60.0, 60.0], [100.0, 0.0, 100.0]);
        let body = ball(&mut simulator, 10.0, [0.0, 0.0, 100.0]);
        simulator.set_crush_tolerance(body, Some(0.0)).unwrap();
        simulator.body_mut(body).unwrap().set_velocity3d(Vector3::new(400.0, 0.0, 0.0));
        for _ in 0..100 {
            run(&mut simulator, 1);
            assert_eq!(crushed(&simulator), []);
        }
    });
}

#[test]
fn crush_tolerances_and_crushed_bodies_are_saved() {
    let (mut simulator, figure, _) = lift_below_ceiling(60.0, 40.0);
    simulator.set_crush_tolerance(figure, Some(4.0)).unwrap();
    (0..45).for_each(|_| simulator.update(1.0 / 60.0));
    let mut loaded = simulator.clone();
    loaded.restore(&simulator.snapshot()).unwrap();
    assert_eq!(loaded.crush_tolerance(figure), Some(4.0));
    for _ in 0..10 {
        loaded.update(1.0 / 60.0);
        assert_eq!(crushed(&loaded), []);
    }
    assert_goes_on_after_loading(&mut simulator, &[figure]);
}

#[test]
fn invalid_crush_tolerances_are_refused() {
    precise(|| {
        let mut simulator = simulator();
        let body = ball(&mut simulator, 8.0, [0.0; 3]);
        for tolerance in [-1.0, f32::NAN, f32::INFINITY] {
            assert!(simulator.set_crush_tolerance(body, Some(tolerance)).is_err());
        }
        simulator.set_crush_tolerance(body, Some(1.0)).unwrap();
        simulator.set_crush_tolerance(body, None).unwrap();
        assert_eq!(simulator.crush_tolerance(body), None);
        simulator.dispose(body).unwrap();
        run(&mut simulator, 1);
        assert!(simulator.set_crush_tolerance(body, Some(1.0)).is_err());
        assert_eq!(simulator.crush_info(body), None);
    });
    with_scheme(DepthScheme::Thesis, || {
        let mut simulator = simulator();
        let body = ball(&mut simulator, 8.0, [0.0; 3]);
        assert!(simulator.set_crush_tolerance(body, Some(1.0)).is_err());
        assert_eq!(simulator.crush_info(body), None);
    });
}
