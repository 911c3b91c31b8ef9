//! Water, wind and wells push along all three axes.

use conformance::fixtures::depth::{
    DT, GRAVITY, assert_near, assert_near3, ball, place, run, simulator, solid, throw, velocity, weightless,
    with_scheme,
};
use twohalf::{
    BodyId, Collision, Context, DepthScheme, Error, Event, EventHandler, FieldId, Fluid, Region,
    TwoHalfPhysicsSimulator, Vector3, Well,
};

fn precise(test: impl FnOnce()) {
    with_scheme(DepthScheme::Precise, test);
}

/// Pool of 200 px by 100 px and 80 px deep into the screen, up to Y = 100.
fn pool() -> Region {
    Region::new([-100.0, 0.0, 0.0], [100.0, 100.0, 80.0]).unwrap()
}

/// Volume of a ball of 10 px.
const BALL: f32 = 4.0 / 3.0 * std::f32::consts::PI * 1000.0;

#[test]
fn a_body_of_half_the_density_of_water_floats_half_immersed_and_sleeps() {
    precise(|| {
        let mut simulator = simulator();
        // Until it has come to rest to the last bit.
        simulator.set_sleep_enabled(false);
        let raft = solid(&mut simulator, [60.0, 20.0, 40.0], [0.0, 120.0, 40.0]);
        let density = 2.0 / (60.0 * 20.0 * 40.0);
        let water = simulator.add_field(Fluid::water(pool(), density)).unwrap();
        run(&mut simulator, 1500);
        assert_near3(place(&simulator, raft), [0.0, 90.0, 40.0], 0.1);
        assert_near(simulator.immersion(water, raft).unwrap(), 0.5, 0.005);
        simulator.set_sleep_enabled(true);
        run(&mut simulator, 100);
        assert!(simulator.is_asleep(raft));
        run(&mut simulator, 1000);
        assert_near3(place(&simulator, raft), [0.0, 90.0, 40.0], 0.1);
    });
}

#[test]
fn a_ball_floats_so_deep_that_it_displaces_its_weight() {
    precise(|| {
        // A cap of 5 of 20 px has pi h² (3 r - h) / 3 = 0.15625 of the ball's volume.
        let mut simulator = simulator();
        simulator.set_sleep_enabled(false);
        let body = ball(&mut simulator, 10.0, [0.0, 90.0, 40.0]);
        let water = simulator.add_field(Fluid::water(pool(), 1.0 / (0.15625 * BALL))).unwrap();
        run(&mut simulator, 1500);
        assert_near(place(&simulator, body).y, 95.0, 0.05);
        assert_near(simulator.immersion(water, body).unwrap(), 0.15625, 2e-3);
    });
}

#[test]
fn a_sinking_body_reaches_its_terminal_velocity() {
    for scheme in [DepthScheme::Precise, DepthScheme::Faithful] {
        with_scheme(scheme, || {
            let mut simulator = simulator();
            let deep = Region::new([-100.0, 0.0, 0.0], [100.0, 3000.0, 80.0]).unwrap();
            let body = ball(&mut simulator, 10.0, [0.0, 2900.0, 40.0]);
            // Half as dense as the ball, and a rate of 4 / s by the ball's volume and mass of 1.
            simulator.add_field(Fluid { drag: 4.0 / BALL, ..Fluid::water(deep, 0.5 / BALL) }).unwrap();
            run(&mut simulator, 500);
            let before = place(&simulator, body).y;
            run(&mut simulator, 100);
            let fallen = before - place(&simulator, body).y;
            assert_near(fallen, 0.5 * GRAVITY / 4.0 * 100.0 * DT, 1e-2);
        });
    }
}

#[test]
fn a_very_viscous_fluid_slows_without_reversing_any_motion() {
    precise(|| {
        let mut simulator = weightless();
        let body = ball(&mut simulator, 10.0, [0.0, 40.0, 40.0]);
        simulator.add_field(Fluid { drag: 1e6 / BALL, ..Fluid::water(pool(), 0.0) }).unwrap();
        throw(&mut simulator, body, [50.0, 20.0, 30.0]);
        for _ in 0..10 {
            run(&mut simulator, 1);
            let now = velocity(&simulator, body);
            assert!((-1e-3..1.0).contains(&now.x) && (-1e-3..1.0).contains(&now.z), "{now:?}");
        }
    });
}

#[test]
fn a_current_takes_along_exponentially_along_all_axes() {
    precise(|| {
        let mut simulator = weightless();
        let body = ball(&mut simulator, 10.0, [-60.0, 30.0, 20.0]);
        let flow = Vector3::new(20.0, 8.0, 12.0);
        simulator.add_field(Fluid { flow, drag: 1.5 / BALL, ..Fluid::water(pool(), 1.0 / BALL) }).unwrap();
        for step in 1..=200 {
            run(&mut simulator, 1);
            let part = 1.0 - (-1.5 * DT * step as f32).exp();
            assert_near3(velocity(&simulator, body), (flow * part).into(), 1e-3);
        }
    });
}

#[test]
fn only_the_immersed_part_is_carried_by_the_current() {
    precise(|| {
        // The back half of it is in the pool, a quarter of its width, and the lower three quarters of its height.
        let mut simulator = weightless();
        let body = solid(&mut simulator, [40.0, 40.0, 40.0], [-110.0, 70.0, 0.0]);
        simulator.body_mut(body).unwrap().core_mut().set_moment_of_inertia(1e20).unwrap();
        let flow = Vector3::new(0.0, 0.0, 40.0);
        let water = Fluid { flow, drag: 1.0 / (40.0 * 40.0 * 40.0), ..Fluid::water(pool(), 0.0) };
        let water = simulator.add_field(water).unwrap();
        assert_near(simulator.immersion(water, body).unwrap(), 0.5 * 0.25 * 0.75, 1e-5);
        run(&mut simulator, 1);
        assert_near(velocity(&simulator, body).z, 40.0 * 0.5 * 0.25 * 0.75 * DT, 1e-4);
    });
}

#[test]
fn a_body_behind_the_pool_is_dry() {
    precise(|| {
        let mut simulator = weightless();
        let body = ball(&mut simulator, 10.0, [0.0, 40.0, 91.0]);
        let flow = Vector3::new(0.0, 0.0, 40.0);
        let water = simulator.add_field(Fluid { flow, ..Fluid::water(pool(), 1.0) }).unwrap();
        run(&mut simulator, 10);
        assert_eq!((velocity(&simulator, body).z, simulator.immersion(water, body).unwrap()), (0.0, 0.0));
    });
}

#[test]
fn a_plank_that_is_thrown_in_on_edge_comes_to_lie_flat() {
    precise(|| {
        let mut simulator = simulator();
        let plank = solid(&mut simulator, [80.0, 10.0, 40.0], [0.0, 110.0, 40.0]);
        simulator.body_mut(plank).unwrap().core_mut().set_rotation(1.2);
        simulator.add_field(Fluid::water(pool(), 2.0 / (80.0 * 10.0 * 40.0))).unwrap();
        run(&mut simulator, 3000);
        let turned = simulator.core().body(plank).unwrap().rotation();
        assert_near((2.0 * turned).sin(), 0.0, 0.02);
        assert!(turned.cos().abs() > 0.99);
    });
}

#[test]
fn wind_blows_light_bodies_away_faster() {
    precise(|| {
        let mut simulator = weightless();
        let bodies = [0.0, 60.0].map(|z| ball(&mut simulator, 10.0, [0.0, 40.0, z]));
        simulator.body_mut(bodies[1]).unwrap().set_mass(4.0).unwrap();
        let flow = Vector3::new(10.0, 0.0, -30.0);
        simulator.add_field(Fluid::wind(Region::EVERYWHERE, flow, 1.0 / BALL)).unwrap();
        run(&mut simulator, 100);
        for (body, rate) in bodies.into_iter().zip([1.0f32, 0.25]) {
            assert_near3(velocity(&simulator, body), (flow * (1.0 - (-rate).exp())).into(), 2e-3);
        }
    });
}

/// Makes the first body static when it touches another one, and dynamic when the second one does.
struct Holds([BodyId; 2]);

impl EventHandler for Holds {
    fn on_collision(&mut self, context: &mut Context<'_>, collision: &Collision) -> bool {
        let is_second = context.geom(collision.this).is_some_and(|geom| geom.body() == self.0[1]);
        if let Some(mut body) = context.body_mut(self.0[0]) {
            body.set_is_static(!is_second);
        }
        true
    }
}

#[test]
fn wind_on_a_body_stopped_in_that_update_has_no_effect_when_it_is_free_again() {
    precise(|| {
        let mut simulator = simulator();
        let bodies = [12.0, 60.0].map(|y| ball(&mut simulator, 10.0, [0.0, y, y]));
        let wind = Fluid::wind(Region::EVERYWHERE, Vector3::new(0.0, 0.0, 500.0), 1.0 / BALL);
        let wind = simulator.add_field(wind).unwrap();
        let is_held = |simulator: &TwoHalfPhysicsSimulator| simulator.body(bodies[0]).unwrap().is_static();
        let until = |simulator: &mut TwoHalfPhysicsSimulator, wanted: bool| {
            (0..200).any(|_| {
                simulator.update_with(DT, &mut Holds(bodies));
                is_held(simulator) == wanted
            })
        };
        assert!(until(&mut simulator, true));
        simulator.remove_field(wind).unwrap();
        let before = velocity(&simulator, bodies[0]).z;
        assert!(until(&mut simulator, false));
        assert!(velocity(&simulator, bodies[0]).z <= before);
    });
}

#[test]
fn an_orbit_around_a_well_in_an_oblique_plane_closes_after_its_period() {
    precise(|| {
        let mut simulator = weightless();
        let body = ball(&mut simulator, 4.0, [60.0, 196.0, 80.0]);
        let well = Well { strength: 1e6, softness: 10.0, ..Well::new([0.0, 200.0, 0.0]) };
        simulator.add_field(well).unwrap();
        // 100 px away: v² = r a.
        let acceleration = 1e6 * 100.0 / (100.0f32 * 100.0 + 100.0).powf(1.5);
        let speed = (100.0 * acceleration).sqrt();
        let steps = (2.0 * std::f32::consts::PI * 100.0 / speed / DT).round() as usize;
        throw(&mut simulator, body, [0.8 * 0.6 * speed, 0.8 * speed, -0.6 * 0.6 * speed]);
        let start = place(&simulator, body);
        for _ in 0..steps {
            run(&mut simulator, 1);
            assert_near((place(&simulator, body) - Vector3::new(0.0, 196.0, 0.0)).norm(), 100.0, 0.5);
        }
        // A step more or less.
        assert_near3(place(&simulator, body), start.into(), speed * DT);
    });
}

#[test]
fn a_well_ends_at_its_radius_and_does_not_act_on_bodies_that_ignore_gravity() {
    precise(|| {
        let mut simulator = weightless();
        let bodies = [40.0, 51.0, -40.0].map(|z| ball(&mut simulator, 4.0, [0.0, 196.0, z]));
        simulator.body_mut(bodies[2]).unwrap().core_mut().set_ignore_gravity(true);
        simulator.add_field(Well { strength: 1e5, radius: 50.0, ..Well::new([0.0, 200.0, 0.0]) }).unwrap();
        run(&mut simulator, 1);
        let speeds = bodies.map(|body| velocity(&simulator, body).z);
        assert!(speeds[0] < -0.1 && speeds[1..] == [0.0, 0.0], "{speeds:?}");
    });
}

/// Distance in px from its final position at which a slowly bobbing body falls asleep.
const BOBBING: f32 = 0.5;

/// A raft that floats asleep.
fn sleeping() -> (TwoHalfPhysicsSimulator, BodyId, FieldId, Fluid) {
    let mut simulator = simulator();
    let raft = solid(&mut simulator, [60.0, 20.0, 40.0], [0.0, 90.0, 40.0]);
    let fluid = Fluid::water(pool(), 2.0 / (60.0 * 20.0 * 40.0));
    let water = simulator.add_field(fluid).unwrap();
    run(&mut simulator, 1000);
    assert!(simulator.is_asleep(raft));
    (simulator, raft, water, fluid)
}

#[test]
fn a_body_asleep_in_water_wakes_when_the_water_falls_flows_or_is_removed() {
    precise(|| {
        let (mut simulator, raft, water, fluid) = sleeping();
        let lower = Region::new([-100.0, 0.0, 0.0], [100.0, 60.0, 80.0]).unwrap();
        simulator.set_field(water, Fluid { region: lower, ..fluid }).unwrap();
        run(&mut simulator, 1500);
        assert_near(place(&simulator, raft).y, 50.0, BOBBING);

        let (mut simulator, raft, water, fluid) = sleeping();
        simulator.set_field(water, Fluid { flow: Vector3::new(0.0, 0.0, 20.0), ..fluid }).unwrap();
        run(&mut simulator, 100);
        assert!(place(&simulator, raft).z > 45.0);

        let (mut simulator, raft, water, _) = sleeping();
        simulator.remove_field(water).unwrap();
        run(&mut simulator, 300);
        assert_near(place(&simulator, raft).y, 0.0, 0.1);
    });
}

#[test]
fn a_body_asleep_on_the_ground_wakes_when_the_flood_comes() {
    precise(|| {
        let mut simulator = simulator();
        let raft = solid(&mut simulator, [60.0, 20.0, 40.0], [0.0, 0.0, 40.0]);
        run(&mut simulator, 300);
        assert!(simulator.is_asleep(raft));
        simulator.add_field(Fluid::water(pool(), 2.0 / (60.0 * 20.0 * 40.0))).unwrap();
        run(&mut simulator, 1500);
        assert_near(place(&simulator, raft).y, 90.0, BOBBING);
    });
}

#[test]
fn saved_and_loaded_in_rough_water_bodies_go_on_with_the_same_bits() {
    precise(|| {
        let mut simulator = simulator();
        let bodies: Vec<BodyId> = (0..6u8)
            .map(|at| {
                solid(&mut simulator, [20.0; 3], [f32::from(at) * 24.0 - 60.0, 110.0, 10.0 * f32::from(at)])
            })
            .collect();
        let flow = Vector3::new(5.0, 0.0, 20.0);
        simulator.add_field(Fluid { flow, ..Fluid::water(pool(), 2.0 / 8000.0) }).unwrap();
        simulator.add_field(Well { strength: 1e5, ..Well::new([0.0, 50.0, 40.0]) }).unwrap();
        for _ in 0..20 {
            run(&mut simulator, 10);
            let mut loaded = self::simulator();
            loaded.restore(&simulator.snapshot()).unwrap();
            let mut kept = simulator.clone();
            run(&mut loaded, 50);
            run(&mut kept, 50);
            let places =
                |of: &TwoHalfPhysicsSimulator| bodies.iter().map(|&body| place(of, body)).collect::<Vec<_>>();
            assert_eq!(places(&loaded), places(&kept));
        }
    });
}

#[test]
fn fields_that_cannot_be_are_refused() {
    let mut simulator = simulator();
    let fluid = Fluid::water(pool(), 1.0);
    let water = simulator.add_field(fluid).unwrap();
    let refused = |result: Result<FieldId, Error>| assert!(result.is_err());
    for bad in [f32::NAN, f32::INFINITY, -1.0] {
        refused(simulator.add_field(Fluid { density: bad, ..fluid }));
        refused(simulator.add_field(Fluid { drag: bad, ..fluid }));
        refused(simulator.add_field(Well { radius: bad, ..Well::new([0.0; 3]) }));
        refused(simulator.add_field(Well { softness: bad, ..Well::new([0.0; 3]) }));
    }
    refused(simulator.add_field(Well { softness: 0.0, ..Well::new([0.0; 3]) }));
    refused(simulator.add_field(Well { strength: f32::NAN, ..Well::new([0.0; 3]) }));
    refused(simulator.add_field(Well::new([f32::NAN, 0.0, 0.0])));
    refused(simulator.add_field(Fluid { flow: Vector3::new(0.0, f32::NAN, 0.0), ..fluid }));
    assert!(Region::new([0.0; 3], [1.0, 0.0, 1.0]).is_err());
    assert!(Region::new([f32::NAN; 3], [1.0; 3]).is_err());
    assert!(simulator.set_field(water, Fluid { density: -1.0, ..fluid }).is_err());
    assert_eq!(simulator.fields().count(), 1);
    simulator.remove_field(water).unwrap();
    assert!(simulator.field(water).is_none());
    assert!(simulator.remove_field(water).is_err() && simulator.set_field(water, fluid).is_err());
}

#[test]
fn non_finite_forces_are_reported_and_have_no_effect() {
    precise(|| {
        let mut simulator = weightless();
        let body = ball(&mut simulator, 10.0, [0.0, 40.0, 40.0]);
        simulator
            .add_field(Well { strength: f32::MAX, softness: 1e-20, ..Well::new([0.0, 60.0, 40.0]) })
            .unwrap();
        simulator.body_mut(body).unwrap().set_mass(1e30).unwrap();
        run(&mut simulator, 1);
        assert!(!simulator.events().is_empty());
        assert!(velocity(&simulator, body).iter().all(|speed| *speed == 0.0));
    });
}

#[test]
fn a_field_that_overflows_the_total_force_along_z_is_reported_and_left_out() {
    for scheme in [DepthScheme::Faithful, DepthScheme::Precise] {
        with_scheme(scheme, || {
            let mut simulator = weightless();
            let body = ball(&mut simulator, 10.0, [0.0, 40.0, 40.0]);
            // Each alone is a number, and their sum is none.
            simulator
                .add_field(Well { strength: 2e38, softness: 1e-3, ..Well::new([0.0, 50.0, 41.0]) })
                .unwrap();
            let mut view = simulator.body_mut(body).unwrap();
            view.set_mass(1.0).unwrap();
            view.apply_force_z(3e38);
            // So short that squares of velocities from the force are finite, too.
            let dt = 1e-20;
            simulator.update(dt);
            let told = Event::NotFinite { body, disabled: false };
            assert!(simulator.events().contains(&told), "{scheme:?}: {:?}", simulator.events());
            assert!(simulator.body(body).unwrap().enabled(), "{scheme:?}");
            let speed = velocity(&simulator, body).z;
            assert!((speed / (3e38 * dt) - 1.0).abs() < 1e-3, "{scheme:?}: {speed}");
        });
    }
}
