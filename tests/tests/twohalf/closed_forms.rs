//! Bounces, throws, rolling and hits against closed forms.
//!
//! Tolerances have three sources. Symplectic Euler moves with the new velocity, so a path is ahead of the parabola by v dt / 2.
//! Contacts are found at the end of a step, up to v dt late. The correction of overlap undoes 0.8 of the excess over 0.05 px
//! per step. Impulses of one contact point are exact up to rounding.

use conformance::fixtures::depth::{
    DT, GRAVITY, SLOP, assert_near, assert_near3, ball, crate_box, fix, geom_of, momentum, place, platform,
    run, run_until_hit, set_platform_surface, set_surface, simulator, solid, throw, velocity, weightless,
};
use twohalf::{Axis, BodyId, TwoHalfContact, TwoHalfPhysicsSimulator, Vector3};

/// Velocities of a few hundred px/s after a few hundred operations of f32.
const ROUNDING: f32 = 1e-3;

/// Highest point that a body reaches between its first and its second landing at a height.
fn bounce_top(simulator: &mut TwoHalfPhysicsSimulator, body: BodyId, floor: f32) -> f32 {
    let mut steps = 0..10_000;
    while place(simulator, body).y > floor && steps.next().is_some() {
        simulator.update(DT);
    }
    let mut top = f32::MIN;
    for _ in steps {
        simulator.update(DT);
        top = top.max(place(simulator, body).y);
        if velocity(simulator, body).y <= 0.0 {
            return top;
        }
    }
    panic!("the body never turns");
}

/// Tolerance of the height of a bounce. The impact has the speed v and the overlap p <= v dt, and the speed after it is u = e
/// (v + g dt). The way down is v²/2g + v dt/2 = h + p, the way up u²/2g + u dt/2, and it begins where the correction has left
/// 0.2 p and the slop.
fn bounce_tolerance(height: f32, restitution: f32) -> f32 {
    let speed = (2.0 * GRAVITY * height).sqrt();
    let (squared, step) = (restitution * restitution, GRAVITY * DT * DT);
    (1.5 * squared + 0.5 * restitution + 0.2) * speed * DT + 2.0 * step + SLOP
}

#[test]
fn a_ball_bounces_to_the_square_of_the_restitution_times_the_height() {
    for restitution in [0.0, 0.5, 1.0] {
        let mut simulator = simulator();
        let body = ball(&mut simulator, 10.0, [0.0, 150.0, 30.0]);
        set_surface(&mut simulator, body, 0.0, restitution);
        let top = bounce_top(&mut simulator, body, 0.0);
        assert_near(top, restitution * restitution * 150.0, bounce_tolerance(150.0, restitution));
    }
}

#[test]
fn a_flat_box_bounces_to_the_square_of_the_restitution_times_the_height() {
    for restitution in [0.0, 0.5, 1.0] {
        let mut simulator = simulator();
        let body = crate_box(&mut simulator, [30.0, 20.0], [0.0, 150.0, 30.0]);
        set_surface(&mut simulator, body, 0.0, restitution);
        let top = bounce_top(&mut simulator, body, 0.0);
        assert_near(top, restitution * restitution * 150.0, bounce_tolerance(150.0, restitution));
        // Its two points share the impulse up to the error of five iterations.
        assert_near(simulator.body(body).unwrap().rotation().sin(), 0.0, 0.01);
    }
}

#[test]
fn a_platform_throws_back_to_the_square_of_the_restitution_times_the_height() {
    for restitution in [0.0, 0.5, 1.0] {
        for is_ball in [true, false] {
            let mut simulator = simulator();
            let floor = platform(&mut simulator, [200.0, 40.0, 100.0], [0.0, 20.0, 50.0]);
            set_platform_surface(&mut simulator, floor, 0.0, restitution);
            let body = match is_ball {
                true => ball(&mut simulator, 10.0, [0.0, 60.0 + 150.0, 50.0]),
                false => crate_box(&mut simulator, [30.0, 20.0], [0.0, 60.0 + 150.0, 50.0]),
            };
            set_surface(&mut simulator, body, 0.0, restitution);
            let top = bounce_top(&mut simulator, body, 60.0) - 60.0;
            assert_near(top, restitution * restitution * 150.0, bounce_tolerance(150.0, restitution));
        }
    }
}

#[test]
pub(crate) fn a_fall_onto_a_platform_takes_the_square_root_of_2h_over_g() {
    for height in [20.0, 50.0, 300.0_f32] {
        for is_ball in [true, false] {
            let mut simulator = simulator();
            platform(&mut simulator, [200.0, 40.0, 100.0], [0.0, 20.0, 50.0]);
            let body = match is_ball {
                true => ball(&mut simulator, 10.0, [0.0, 60.0 + height, 50.0]),
                false => crate_box(&mut simulator, [30.0, 20.0], [0.0, 60.0 + height, 50.0]),
            };
            let mut steps = 0;
            while place(&simulator, body).y > 60.0 && steps < 1000 {
                simulator.update(DT);
                steps += 1;
            }
            // After n steps it has fallen g dt² n (n + 1) / 2; that is noticed at the end of a step.
            assert_near(steps as f32 * DT, (2.0 * height / GRAVITY).sqrt(), DT);
        }
    }
}

#[test]
pub(crate) fn a_throw_goes_2_vx_vy_over_g_far_in_every_direction() {
    for direction in [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [0.6, 0.8]] {
        for [across, up] in [[100.0, 100.0], [60.0, 150.0], [150.0, 60.0]] {
            for is_ball in [true, false] {
                let mut simulator = simulator();
                let body = match is_ball {
                    true => ball(&mut simulator, 10.0, [5.0, 0.0, 7.0]),
                    false => crate_box(&mut simulator, [20.0, 20.0], [5.0, 0.0, 7.0]),
                };
                throw(&mut simulator, body, [across * direction[0], up, across * direction[1]]);
                for _ in 0..1000 {
                    simulator.update(DT);
                    if place(&simulator, body).y <= 0.0 {
                        break;
                    }
                }
                let landed = place(&simulator, body) - Vector3::new(5.0, 0.0, 7.0);
                // It is back on the ground after 2 v / g - dt, which is noticed up to a step later.
                let range = landed.x * direction[0] + landed.z * direction[1];
                assert_near(range, 2.0 * across * up / GRAVITY, 1.01 * across * DT);
                assert_near(landed.x * direction[1] - landed.z * direction[0], 0.0, ROUNDING);
            }
        }
    }
}

/// Directions over the ground in X and Z, a ratio.
const DIRECTIONS: [[f32; 2]; 5] = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [0.6, -0.8]];

/// Throws a ball of radius 20 flat over the ground, or a platform, and returns the velocity at which it ends up rolling, along
/// the direction and aside. `inertia` is in units of m r², `backspin` the speed of its rim against rolling.
fn rolling_end(direction: [f32; 2], inertia: f32, backspin: f32, on_platform: bool) -> [f32; 2] {
    let mut simulator = simulator();
    let height = if on_platform { 30.0 } else { 0.0 };
    if on_platform {
        let floor = platform(&mut simulator, [2000.0, 30.0, 2000.0], [0.0, 0.0, 0.0]);
        set_platform_surface(&mut simulator, floor, 0.3, 0.0);
    }
    let body = ball(&mut simulator, 20.0, [0.0, height, 0.0]);
    set_surface(&mut simulator, body, 0.3, 0.0);
    throw(&mut simulator, body, [90.0 * direction[0], 0.0, 90.0 * direction[1]]);
    let mut view = simulator.body_mut(body).unwrap();
    view.core_mut().set_moment_of_inertia(inertia * 20.0 * 20.0).unwrap();
    let spin = backspin / 20.0;
    view.set_angular_velocity3d(Vector3::new(spin * direction[1], 0.0, -spin * direction[0]));
    run(&mut simulator, 700);
    let end = velocity(&simulator, body);
    [end.x * direction[0] + end.z * direction[1], end.x * direction[1] - end.z * direction[0]]
}

/// Tolerance of the final speed of rolling in px/s. Every impulse conserves m v r + I w about the point of contact. So it is
/// the rounding of 700 steps with numbers of about 100, half an ulp (4e-6) each.
const ROLLING: f32 = 700.0 * 4e-6;

#[test]
pub(crate) fn a_sphere_thrown_flat_ends_up_rolling_at_five_sevenths_of_its_speed() {
    for direction in DIRECTIONS {
        let [along, aside] = rolling_end(direction, 2.0 / 5.0, 0.0, false);
        assert_near(along, 90.0 * 5.0 / 7.0, ROLLING);
        assert_near(aside, 0.0, ROLLING);
    }
}

#[test]
pub(crate) fn on_a_platform_discs_and_spheres_end_up_rolling_as_on_the_ground() {
    for direction in DIRECTIONS {
        for (inertia, expected) in [(0.5, 60.0), (0.4, 90.0 * 5.0 / 7.0)] {
            let [along, aside] = rolling_end(direction, inertia, 0.0, true);
            assert_near(along, expected, ROLLING);
            assert_near(aside, 0.0, ROLLING);
        }
    }
}

#[test]
pub(crate) fn a_hoop_ends_up_rolling_at_half_of_its_speed() {
    for direction in DIRECTIONS {
        let [along, _] = rolling_end(direction, 1.0, 0.0, false);
        assert_near(along, 45.0, ROLLING);
    }
}

#[test]
fn a_sphere_with_enough_backspin_comes_back() {
    for direction in DIRECTIONS {
        // m v r + I w is conserved: (v - 0.4 u) / 1.4 for a rim that runs backwards at u.
        let [along, aside] = rolling_end(direction, 2.0 / 5.0, 400.0, false);
        assert_near(along, (90.0 - 0.4 * 400.0) / 1.4, ROLLING);
        assert_near(aside, 0.0, ROLLING);
    }
}

/// Two balls of radii 15 and 10 that meet obliquely in all three axes without gravity, run until they have met and separated:
/// their velocities before and after, and the contact of the second one.
fn oblique_hit(
    masses: [f32; 2],
    friction: f32,
    restitution: f32,
) -> ([Vector3; 2], [Vector3; 2], TwoHalfContact) {
    let mut simulator = weightless();
    let bodies =
        [ball(&mut simulator, 15.0, [0.0, 500.0, 0.0]), ball(&mut simulator, 10.0, [60.0, 514.0, 35.0])];
    for (body, mass) in bodies.into_iter().zip(masses) {
        set_surface(&mut simulator, body, friction, restitution);
        simulator.body_mut(body).unwrap().set_mass(mass).unwrap();
    }
    throw(&mut simulator, bodies[0], [90.0, 10.0, 40.0]);
    throw(&mut simulator, bodies[1], [-30.0, -5.0, -20.0]);
    let before = bodies.map(|body| velocity(&simulator, body));
    let geom = geom_of(&simulator, bodies[1]);
    run_until_hit(&mut simulator, geom);
    let hit = simulator.contacts().next().unwrap();
    run(&mut simulator, 50);
    (before, bodies.map(|body| velocity(&simulator, body)), hit)
}

#[test]
pub(crate) fn equal_balls_with_full_restitution_exchange_their_velocities_along_the_line_of_centres_and_keep_the_rest()
 {
    let (before, after, hit) = oblique_hit([1.0, 1.0], 0.0, 1.0);
    let normal = hit.normal;
    assert_eq!(hit.axis, Axis::Oblique);
    assert!(normal.iter().all(|part| part.abs() > 0.1), "{normal:?}");
    let closing = (before[1] - before[0]).dot(&normal);
    assert!(closing < -50.0);
    assert_near3(after[0], (before[0] + normal * closing).into(), ROUNDING);
    assert_near3(after[1], (before[1] - normal * closing).into(), ROUNDING);
}

#[test]
pub(crate) fn the_normal_of_two_balls_is_the_line_of_their_centres_at_the_hit() {
    let (before, _, hit) = oblique_hit([1.0, 1.0], 0.0, 1.0);
    // The distance until the centres are 25 px apart; origins are the radii above the lowest points.
    let start = Vector3::new(60.0, 14.0 + 10.0 - 15.0, 35.0);
    let relative = before[1] - before[0];
    let (half_b, c) = (start.dot(&relative), start.norm_squared() - 25.0 * 25.0);
    let time = (-half_b - (half_b * half_b - relative.norm_squared() * c).sqrt()) / relative.norm_squared();
    let at_hit = (start + relative * time) / 25.0;
    // The centres go on for up to a step, at right angles to the line by at most all of that motion.
    let late = (at_hit.cross(&relative).norm() * DT) / (25.0 - relative.norm() * DT);
    assert!((hit.normal - at_hit).norm() <= late, "{:?} {at_hit:?} {late}", hit.normal);
}

#[test]
pub(crate) fn an_oblique_hit_of_unequal_balls_has_the_impulse_of_the_closed_form() {
    for restitution in [0.0, 0.5, 1.0] {
        let masses = [2.0, 0.5];
        let (before, after, hit) = oblique_hit(masses, 0.0, restitution);
        let closing = -(before[1] - before[0]).dot(&hit.normal);
        let impulse = (1.0 + restitution) * closing / (1.0 / masses[0] + 1.0 / masses[1]);
        assert_near3(after[0], (before[0] - hit.normal * (impulse / masses[0])).into(), ROUNDING);
        assert_near3(after[1], (before[1] + hit.normal * (impulse / masses[1])).into(), ROUNDING);
    }
}

#[test]
pub(crate) fn an_oblique_hit_keeps_the_momentum_in_all_three_axes_with_friction_too() {
    for friction in [0.0, 0.5] {
        let masses = [2.0, 0.5];
        let (before, after, _) = oblique_hit(masses, friction, 0.5);
        let of = |velocities: [Vector3; 2]| velocities[0] * masses[0] + velocities[1] * masses[1];
        assert_near3(of(after), of(before).into(), ROUNDING);
    }
}

/// Velocities across and along the normal after an oblique hit of two balls of mass 1, the impulse across it that would stop
/// their sliding, and the contact.
fn rubbing_hit(friction: f32) -> ([f32; 3], TwoHalfContact) {
    let (before, after, hit) = oblique_hit([1.0, 1.0], friction, 0.0);
    let change = after[1] - before[1];
    let along = change.dot(&hit.normal);
    let sliding = before[1] - before[0];
    let sliding = (sliding - hit.normal * sliding.dot(&hit.normal)).norm();
    // The inverse effective mass of a disc is 1/m + a² / (m r² / 2) at a distance a from its centre. The point is on the second
    // ball, and as deep in the first as they overlap.
    let arm = 1.0 + hit.separation / 15.0;
    ([(change - hit.normal * along).norm(), along, sliding / (1.0 + 2.0 * arm * arm + 3.0)], hit)
}

#[test]
pub(crate) fn friction_of_an_oblique_hit_is_its_coefficient_times_the_normal_impulse_while_the_balls_slide() {
    let ([across, along, stopping], hit) = rubbing_hit(0.05);
    assert!(stopping > 0.05 * along);
    assert_near(across, 0.05 * along, ROUNDING);
    assert_near(hit.friction_impulse, across, ROUNDING);
    assert_near(hit.normal_impulse, along, ROUNDING);
}

#[test]
fn friction_of_an_oblique_hit_stops_the_sliding_where_it_can() {
    let ([across, along, stopping], _) = rubbing_hit(0.5);
    assert!(stopping < 0.5 * along);
    assert_near(across, stopping, ROUNDING);
}

#[test]
pub(crate) fn a_ball_flies_back_from_the_front_the_back_and_the_sides_of_a_box_at_the_same_speed() {
    let faces = [
        [0.0, 0.0, -1.0],
        [0.0, 0.0, 1.0],
        [-1.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
    ];
    for face in faces.map(Vector3::from) {
        let mut simulator = weightless();
        let post = solid(&mut simulator, [60.0, 50.0, 40.0], [0.0, 500.0, 0.0]);
        fix(&mut simulator, post);
        // Its middle is that of the box, moved a little along the face.
        let aside = Vector3::new(3.0, 4.0, 2.0).component_mul(&(Vector3::repeat(1.0) - face.abs()));
        let start = face * 80.0 + aside + Vector3::new(0.0, 525.0 - 10.0, 0.0);
        let body = ball(&mut simulator, 10.0, start.into());
        for body in [post, body] {
            set_surface(&mut simulator, body, 0.0, 1.0);
        }
        throw(&mut simulator, body, (face * -70.0).into());
        let geom = geom_of(&simulator, body);
        let hit = run_until_hit(&mut simulator, geom);
        assert_eq!(hit.normal, face);
        run(&mut simulator, 20);
        assert_near3(velocity(&simulator, body), (face * 70.0).into(), ROUNDING);
    }
}

/// Throws a ball of radius 15 along Z at a static box of 40 x 40 x 40. The ball's centre is beyond the box's upper right corner
/// by `beyond`. Returns the normal of the hit and the velocity after it. Steps are a tenth as long.
fn hit_the_edge(beyond: [f32; 2]) -> (Vector3, Vector3) {
    let mut simulator = weightless();
    let post = solid(&mut simulator, [40.0, 40.0, 40.0], [0.0, 500.0, 20.0]);
    fix(&mut simulator, post);
    let body = ball(&mut simulator, 15.0, [20.0 + beyond[0], 540.0 + beyond[1] - 15.0, -40.0]);
    for body in [post, body] {
        set_surface(&mut simulator, body, 0.0, 1.0);
    }
    throw(&mut simulator, body, [0.0, 0.0, 80.0]);
    let mut normal = None;
    for _ in 0..600 {
        simulator.update(DT * 0.1);
        let contact = simulator.contacts().next().map(|contact| contact.normal);
        normal = normal.or(contact);
    }
    (normal.unwrap(), velocity(&simulator, body))
}

/// A step of 0.001 s at 80 px/s moves the centre by 0.08 px of 15 after the touch, the direction by less than that
/// over the radius.
const LATE: f32 = 0.08 / 15.0;

#[test]
pub(crate) fn a_ball_that_hits_an_upright_edge_glances_off_by_the_normal_of_the_closed_form() {
    // 9 of 15 beyond the edge: the normal is (3, -4) / 5 in X and Z.
    let (normal, after) = hit_the_edge([9.0, -20.0]);
    assert_near3(normal, [0.6, 0.0, -0.8], LATE);
    // v - 2 (v n) n, and twice as far off as the normal.
    assert_near3(after, [2.0 * 0.8 * 0.6 * 80.0, 0.0, (1.0 - 2.0 * 0.64) * 80.0], 4.0 * 80.0 * LATE);
    assert_near(after.norm(), 80.0, ROUNDING);
}

#[test]
pub(crate) fn a_ball_that_hits_a_level_edge_glances_off_upward() {
    let (normal, after) = hit_the_edge([-20.0, 9.0]);
    assert_near3(normal, [0.0, 0.6, -0.8], LATE);
    assert_near3(after, [0.0, 2.0 * 0.8 * 0.6 * 80.0, (1.0 - 2.0 * 0.64) * 80.0], 4.0 * 80.0 * LATE);
}

#[test]
fn a_ball_that_hits_a_corner_glances_off_in_all_three_axes() {
    // (10, 10, 5) from the corner: the normal is (2, 2, -1) / 3.
    let (normal, after) = hit_the_edge([10.0, 10.0]);
    assert_near3(normal, [2.0 / 3.0, 2.0 / 3.0, -1.0 / 3.0], 2.0 * LATE * 3.0);
    let reflected = Vector3::new(0.0, 0.0, 80.0) - normal * (2.0 * 80.0 * normal.z);
    assert_near3(after, reflected.into(), ROUNDING);
}

#[test]
pub(crate) fn a_box_pushed_along_z_into_another_shares_its_momentum_by_the_restitution() {
    for restitution in [0.0, 0.4, 1.0] {
        let mut simulator = weightless();
        let pusher = solid(&mut simulator, [40.0, 30.0, 30.0], [0.0, 500.0, 0.0]);
        let pushed = solid(&mut simulator, [40.0, 40.0, 40.0], [12.0, 491.0, 80.0]);
        simulator.body_mut(pusher).unwrap().set_mass(2.0).unwrap();
        for body in [pusher, pushed] {
            set_surface(&mut simulator, body, 0.3, restitution);
        }
        throw(&mut simulator, pusher, [0.0, 0.0, 90.0]);
        run(&mut simulator, 200);
        // (m1 v - e m2 v) / (m1 + m2) and (1 + e) m1 v / (m1 + m2).
        assert_near3(velocity(&simulator, pusher), [0.0, 0.0, 90.0 * (2.0 - restitution) / 3.0], ROUNDING);
        assert_near3(
            velocity(&simulator, pushed),
            [0.0, 0.0, 90.0 * 2.0 * (1.0 + restitution) / 3.0],
            ROUNDING,
        );
        assert_near3(momentum(&simulator, &[pusher, pushed]), [0.0, 0.0, 180.0], ROUNDING);
        for body in [pusher, pushed] {
            assert_eq!(simulator.body(body).unwrap().rotation(), 0.0);
        }
    }
}
