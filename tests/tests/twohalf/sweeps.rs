//! Boxes that are swept through the world until they hit an object. Tolerances: rounding of coordinates up to 500, unless said.

use conformance::fixtures::depth::{
    assert_near, assert_near3, ball, geom_of, platform, run, solid, throw, weightless, with_scheme,
};
use conformance::fixtures::plane::Random;
use twohalf::farseer_core::{GeomPlacement, Vertices};
use twohalf::{
    BodyId, ContactTarget, DepthProfile, DepthScheme, Footprint, GeomId, Platform, SweepHit3D,
    TwoHalfPhysicsSimulator, Vector2, Vector3,
};
use twohalf_factories::{Capsule, Cylinder, Prism, spawn};

const ROUNDING: f32 = 1e-3;

fn precise(test: impl FnOnce()) {
    with_scheme(DepthScheme::Precise, test);
}

/// A box about a position, swept along a displacement.
fn sweep(
    simulator: &TwoHalfPhysicsSimulator,
    middle: Vector3,
    half: [f32; 3],
    way: Vector3,
) -> Option<SweepHit3D> {
    let half = Vector3::from(half);
    simulator.sweep_box(middle - half, middle + half, way, |_| true)
}

#[test]
fn a_box_meets_a_box_and_a_platform_where_their_faces_touch() {
    let mut simulator = weightless();
    let body = solid(&mut simulator, [40.0, 20.0, 30.0], [0.0, 90.0, 0.0]);
    simulator.update(0.0);
    let block = platform(&mut simulator, [40.0, 20.0, 30.0], [300.0, 90.0, 0.0]);
    let both =
        [(ContactTarget::Geom(geom_of(&simulator, body)), 0.0), (ContactTarget::Platform(block), 300.0)];
    for (partner, x) in both {
        for (axis, reach) in [26.0, 14.0, 17.0].into_iter().enumerate() {
            for side in [-1.0, 1.0] {
                let normal = Vector3::ith(axis, side);
                let start = Vector3::new(x, 100.0, 0.0) + normal * 80.0 + Vector3::new(3.0, 2.0, 1.0);
                let hit = sweep(&simulator, start, [6.0, 4.0, 2.0], normal * -160.0).unwrap();
                assert_eq!((hit.partner, hit.normal), (partner, normal));
                let way = 80.0 + side * [3.0, 2.0, 1.0][axis] - reach;
                assert_near(hit.fraction, way / 160.0, 1e-5);
            }
        }
    }
}

#[test]
fn a_box_that_just_misses_an_obstacle_has_no_hit_and_one_slightly_closer_has() {
    let mut simulator = weightless();
    let body = solid(&mut simulator, [40.0, 20.0, 30.0], [0.0, 90.0, 0.0]);
    simulator.update(0.0);
    let geom = ContactTarget::Geom(geom_of(&simulator, body));
    for (aside, axis) in [(14.0, 1), (17.0, 2)] {
        for (by, met) in [(-0.01, Some(geom)), (0.0, None), (0.01, None)] {
            let mut start = Vector3::new(-100.0, 100.0, 0.0);
            start[axis] += aside + by;
            let hit = sweep(&simulator, start, [6.0, 4.0, 2.0], Vector3::new(200.0, 0.0, 0.0));
            assert_eq!(hit.map(|hit| hit.partner), met, "{axis}, {by}");
        }
    }
}

#[test]
fn a_box_meets_a_ball_with_its_face_its_edge_or_its_corner() {
    let mut simulator = weightless();
    let body = ball(&mut simulator, 15.0, [0.0, 85.0, 0.0]);
    simulator.update(0.0);
    let geom = ContactTarget::Geom(geom_of(&simulator, body));
    // Offsets at which the corner of the box is 5, 9 or 0 px from the ball's middle along Y and Z.
    for (aside, from) in [([0.0, 0.0], [0.0, 0.0]), ([9.0, 0.0], [5.0, 0.0]), ([9.0, 11.0], [5.0, 9.0])] {
        let start = Vector3::new(-100.0, 100.0 + aside[0], aside[1]);
        let hit = sweep(&simulator, start, [6.0, 4.0, 2.0], Vector3::new(200.0, 0.0, 0.0)).unwrap();
        let along = (225.0f32 - from[0] * from[0] - from[1] * from[1]).sqrt();
        assert_eq!(hit.partner, geom);
        assert_near(hit.fraction, (100.0 - 6.0 - along) / 200.0, 1e-5);
        assert_near3(hit.normal, [-along / 15.0, from[0] / 15.0, from[1] / 15.0], ROUNDING);
    }
    // A cube around the ball would be met.
    let corner = Vector3::new(-100.0, 100.0 + 4.0 + 11.0, 2.0 + 11.0);
    assert_eq!(sweep(&simulator, corner, [6.0, 4.0, 2.0], Vector3::new(200.0, 0.0, 0.0)), None);
}

#[test]
fn a_box_that_falls_on_a_slope_meets_it_with_its_lower_corner() {
    let mut simulator = weightless();
    let slope = Vector3::new(0.0, 100.0, 0.0);
    Platform::with_rotation(&mut simulator, 300.0, 20.0, 60.0, slope, 0.4, None).unwrap();
    let (middle, half) = (Vector3::new(20.0, 300.0, 10.0), [10.0, 15.0, 8.0]);
    let hit = sweep(&simulator, middle, half, Vector3::new(0.0, -300.0, 0.0)).unwrap();
    // The slope falls to the right: its left corner is the first.
    let beneath = simulator.surface_beneath(Vector3::new(10.0, 300.0, 10.0)).unwrap();
    assert_near(300.0 - 15.0 - 300.0 * hit.fraction, beneath.height, ROUNDING);
    assert_near3(hit.normal, beneath.normal.into(), ROUNDING);
}

/// Geoms of every shape, about X 0, Y 100 and Z 0.
fn shapes() -> Vec<(TwoHalfPhysicsSimulator, GeomId)> {
    let middle = |height: f32| [0.0, 100.0 - 0.5 * height, 0.0];
    let wedge = Footprint::new(&[[-20.0, -10.0], [20.0, -10.0], [0.0, 20.0]].map(Vector2::from)).unwrap();
    let things = [
        Prism::new([40.0, 30.0, 20.0]),
        twohalf_factories::Ball::new(18.0),
        Cylinder::new(14.0, 40.0),
        Capsule::new(14.0, 50.0),
        Prism::footprint(wedge, 40.0),
    ];
    let heights = [30.0, 36.0, 40.0, 50.0, 40.0];
    let made = things.into_iter().zip(heights).map(|(thing, height)| {
        let mut simulator = weightless();
        let made = spawn(&mut simulator, thing.at(middle(height))).unwrap();
        if height == 30.0 {
            simulator.body_mut(made.body).unwrap().set_rotation(0.6);
        }
        (simulator, made.geom)
    });
    let mut all: Vec<_> = made.collect();
    let mut simulator = weightless();
    let body = solid(&mut simulator, [4.0; 3], middle(4.0));
    all.push((simulator.clone(), angle(&mut simulator, body)));
    all.last_mut().unwrap().0 = simulator;
    all.iter_mut().for_each(|(simulator, _)| simulator.update(0.0));
    all
}

/// An outline that is not convex: two bars of 12 px.
fn angle(simulator: &mut TwoHalfPhysicsSimulator, body: BodyId) -> GeomId {
    let corners = [[-25.0, -25.0], [-25.0, 25.0], [25.0, 25.0], [25.0, 13.0], [-13.0, 13.0], [-13.0, -25.0]];
    let outline = Vertices::from(corners.map(Vector2::from).to_vec());
    let geom = simulator.create_geom(body, outline, GeomPlacement::default()).unwrap();
    simulator.set_depth_profile(geom, DepthProfile::Prism { depth: 24.0 }).unwrap();
    simulator.add(geom).unwrap();
    geom
}

/// A random sweep from afar to a point near the shapes, and slightly farther.
fn random_course(random: &mut Random) -> (Vector3, [f32; 3], Vector3) {
    let mut vector = |range: f32| Vector3::from([0; 3].map(|_| random.between(-range, range)));
    let (direction, aim, half) = (vector(1.0), vector(30.0), vector(12.0).abs());
    let start = Vector3::new(0.0, 100.0, 0.0) + aim + direction.normalize() * 120.0;
    (start, (half + Vector3::repeat(0.5)).into(), direction.normalize() * -240.0)
}

#[test]
fn a_swept_box_overlaps_its_hit_after_the_time_of_impact_and_not_before() {
    precise(|| {
        let mut random = Random::new(7);
        for (mut simulator, geom) in shapes() {
            let probe = solid(&mut simulator, [20.0; 3], [0.0, 400.0, 0.0]);
            simulator.update(0.0);
            let probe_geom = geom_of(&simulator, probe);
            let (mut met, mut missed) = (0, 0);
            for _ in 0..200 {
                let (start, half, way) = random_course(&mut random);
                let hit = simulator.sweep_box(
                    start - Vector3::from(half),
                    start + Vector3::from(half),
                    way,
                    |partner| partner == ContactTarget::Geom(geom),
                );
                let outline = Vertices::create_rectangle(2.0 * half[0], 2.0 * half[1]).unwrap();
                simulator.dispose(probe_geom).ok();
                let box_geom = simulator.create_geom(probe, outline, GeomPlacement::default()).unwrap();
                let profile = DepthProfile::Prism { depth: 2.0 * half[2] };
                simulator.set_depth_profile(box_geom, profile).unwrap();
                let mut overlaps = |part: f32| {
                    let at = start + way * part;
                    let mut view = simulator.body_mut(probe).unwrap();
                    let aside = view.origin3d() - view.position3d();
                    view.set_position3d(at - aside);
                    simulator.geom(box_geom).unwrap().collides_with_geom(geom)
                };
                // 240 px: a tenth of one to either side.
                let hair = 0.1 / 240.0;
                match hit {
                    Some(hit) => {
                        met += 1;
                        let before = (0..40).all(|at| !overlaps((hit.fraction - hair) * at as f32 / 39.0));
                        assert!(before, "{start:?} {half:?} {way:?}: {hit:?}");
                        assert_near(hit.normal.norm(), 1.0, ROUNDING);
                        assert!(hit.normal.dot(&way) < 0.0);
                        // A grazing box is soon out again.
                        let within = (1..=8).any(|at| overlaps(hit.fraction + hair * at as f32 * 0.25));
                        let grazes = hit.normal.dot(&way) > -0.1 * way.norm();
                        assert!(within || grazes, "{start:?} {half:?} {way:?}: {hit:?}");
                    }
                    None => {
                        missed += 1;
                        assert!(
                            (0..=240).all(|at| !overlaps(at as f32 / 240.0)),
                            "{start:?} {half:?} {way:?}"
                        );
                    }
                }
                simulator.dispose(box_geom).unwrap();
                simulator.update(0.0);
            }
            assert!(met > 60 && missed > 20, "{met} {missed}");
        }
    });
}

/// Fraction of a displacement at which a point enters a box about a position.
fn entry_of_point(from: Vector3, way: Vector3, middle: Vector3, half: [f32; 3]) -> Option<f32> {
    let (mut entered, mut left) = (f32::NEG_INFINITY, f32::INFINITY);
    for axis in 0..3 {
        let ends = [-half[axis], half[axis]].map(|end| (middle[axis] + end - from[axis]) / way[axis]);
        entered = entered.max(ends[0].min(ends[1]));
        left = left.min(ends[0].max(ends[1]));
    }
    (entered <= left && (0.0..=1.0).contains(&entered)).then_some(entered)
}

/// The first fraction of the displacement at which a point of the edges of a box enters a platform, or a corner of the platform
/// the box. The points are a dense sample, so that it is slightly late where two edges meet.
fn first_point(
    simulator: &TwoHalfPhysicsSimulator,
    id: twohalf::PlatformId,
    (start, half, way): (Vector3, [f32; 3], Vector3),
) -> Option<f32> {
    const POINTS: i32 = 200;
    let sides = |axis: usize| [-half[axis], half[axis]];
    let edges = (0..3).flat_map(|along| {
        let (one, other) = ((along + 1) % 3, (along + 2) % 3);
        let ends = sides(one).into_iter().flat_map(move |a| sides(other).map(|b| (a, b)));
        ends.flat_map(move |(a, b)| {
            (0..=POINTS).map(move |at| {
                let mut point = Vector3::zeros();
                (point[one], point[other]) = (a, b);
                point[along] = half[along] * (2.0 * at as f32 / POINTS as f32 - 1.0);
                point
            })
        })
    });
    let of_box = edges.filter_map(|point| {
        let hit = simulator
            .ray_cast3d(start + point, start + point + way, |partner| partner == ContactTarget::Platform(id));
        hit.map(|hit| hit.fraction)
    });
    let corners = simulator.platform(id).unwrap().corners();
    let of_platform = corners.into_iter().filter_map(|corner| entry_of_point(corner, -way, start, half));
    of_box.chain(of_platform).reduce(f32::min)
}

#[test]
fn a_swept_box_meets_rotated_and_sheared_platforms_at_their_first_corner_or_edge() {
    precise(|| {
        let mut random = Random::new(11);
        let mut met = 0;
        for number in 0..160 {
            let mut simulator = weightless();
            let place = Vector3::new(0.0, 85.0, 0.0);
            let turns = number % 4 == 3;
            let tilt = if turns || number % 3 == 0 { 0.0 } else { random.between(-0.7, 0.7) };
            let leans = number % 4 == 1;
            let angle = if leans { 40 + random.below(100) as i32 } else { 60 };
            let id =
                Platform::with_rotation_and_angle(&mut simulator, 60.0, 30.0, 40.0, place, tilt, None, angle)
                    .unwrap();
            let mut view = simulator.platform_mut(id).unwrap();
            match number % 4 {
                2 => view.set_pitch(random.between(-0.9, 0.9)).unwrap(),
                3 => view.set_yaw(random.between(-3.0, 3.0)).unwrap(),
                _ => {}
            }
            let course @ (start, half, way) = random_course(&mut random);
            let hit =
                sweep(&simulator, start, half, way).filter(|hit| hit.partner == ContactTarget::Platform(id));
            let expected = first_point(&simulator, id, course);
            match (hit, expected) {
                (Some(hit), Some(expected)) => {
                    met += 1;
                    // Edges up to 25 px long: points are 0.125 apart, and one is half of that from where edges meet, or a few
                    // times that late where these are nearly along the displacement.
                    let late = (expected - hit.fraction) * 240.0;
                    assert!((-0.01..0.3).contains(&late), "{number}: {late} {hit:?}");
                }
                // It only grazes.
                (Some(hit), None) => assert!(hit.normal.dot(&way) > -0.1 * way.norm(), "{number}: {hit:?}"),
                (None, found) => assert_eq!(found, None, "{number}"),
            }
        }
        assert!(met > 80, "{met}");
    });
}

#[test]
fn the_first_of_several_is_hit_and_the_filter_skips_shapes() {
    let mut simulator = weightless();
    let near = solid(&mut simulator, [20.0, 20.0, 20.0], [0.0, 200.0, 0.0]);
    simulator.update(0.0);
    let far = platform(&mut simulator, [20.0, 20.0, 20.0], [0.0, 100.0, 0.0]);
    let mut order = Vec::new();
    let [low, high] = [-5.0, 5.0].map(|side| Vector3::new(side, 300.0 + side, side));
    while let Some(hit) =
        simulator.sweep_box(low, high, Vector3::new(0.0, -400.0, 0.0), |partner| !order.contains(&partner))
    {
        assert_near3(hit.normal, [0.0, 1.0, 0.0], ROUNDING);
        order.push(hit.partner);
    }
    assert_eq!(
        order,
        [ContactTarget::Geom(geom_of(&simulator, near)), ContactTarget::Platform(far), ContactTarget::Ground]
    );
}

#[test]
fn initial_overlaps_and_surfaces_slid_along_do_not_stop_a_swept_box() {
    let mut simulator = weightless();
    platform(&mut simulator, [400.0, 20.0, 100.0], [0.0, 0.0, 0.0]);
    let wall = platform(&mut simulator, [20.0, 60.0, 100.0], [190.0, 20.0, 0.0]);
    // Just on the floor, and as deep as a resting body.
    for bottom in [20.0, 19.95] {
        let (low, high) = (Vector3::new(-10.0, bottom, -10.0), Vector3::new(10.0, bottom + 40.0, 10.0));
        let hit = simulator.sweep_box(low, high, Vector3::new(300.0, 0.0, 0.0), |_| true).unwrap();
        assert_eq!((hit.partner, hit.normal), (ContactTarget::Platform(wall), Vector3::new(-1.0, 0.0, 0.0)));
        assert_near(hit.fraction, 170.0 / 300.0, 1e-5);
        assert_eq!(simulator.sweep_box(low, high, Vector3::new(0.0, 50.0, 0.0), |_| true), None);
    }
    // Beside each other, floors are one.
    platform(&mut simulator, [400.0, 20.0, 100.0], [0.0, 0.0, 100.0]);
    let (low, high) = (Vector3::new(-10.0, 20.0, -10.0), Vector3::new(10.0, 60.0, 10.0));
    assert_eq!(simulator.sweep_box(low, high, Vector3::new(0.0, 0.0, 90.0), |_| true), None);
}

#[test]
fn inside_the_concavity_of_an_outline_a_box_hits_its_other_side() {
    let mut simulator = weightless();
    let body = solid(&mut simulator, [4.0; 3], [0.0, 98.0, 0.0]);
    let geom = angle(&mut simulator, body);
    simulator.update(0.0);
    let only = |partner| partner == ContactTarget::Geom(geom);
    let origin = simulator.body(body).unwrap().origin3d();
    // In its upright bar, which ends at -13, and from there to the right along the level one: that joins it.
    let at = |x: f32, y: f32| {
        (origin + Vector3::new(x - 2.0, y - 2.0, -2.0), origin + Vector3::new(x + 2.0, y + 2.0, 2.0))
    };
    let (low, high) = at(-20.0, -18.0);
    assert_eq!(simulator.sweep_box(low, high, Vector3::new(30.0, 0.0, 0.0), only), None);
    // Down into the hollow: onto the level bar, 13 px below the middle.
    let (low, high) = at(5.0, 20.0);
    let hit = simulator.sweep_box(low, high, Vector3::new(0.0, -50.0, 0.0), only).unwrap();
    assert_near(hit.fraction, (20.0 - 2.0 + 13.0) / 50.0, 1e-4);
    assert_near3(hit.normal, [0.0, 1.0, 0.0], ROUNDING);
}

#[test]
fn a_box_flies_as_far_as_it_was_swept_before() {
    precise(|| {
        let mut simulator = weightless();
        let slope = Vector3::new(100.0, 40.0, 0.0);
        Platform::with_rotation(&mut simulator, 200.0, 20.0, 80.0, slope, -0.5, None).unwrap();
        let body = solid(&mut simulator, [20.0, 30.0, 10.0], [-100.0, 60.0, -10.0]);
        simulator.body_mut(body).unwrap().core_mut().set_moment_of_inertia(1e20).unwrap();
        simulator.update(0.0);
        let geom = geom_of(&simulator, body);
        let shape = simulator.geom(geom).unwrap().virtual_geom();
        let low = Vector3::new(shape.left, shape.bottom, shape.front);
        let high = Vector3::new(shape.right, shape.top, shape.back);
        let way = Vector3::new(300.0, 0.0, 30.0);
        let hit =
            simulator.sweep_box(low, high, way, |partner| partner != ContactTarget::Geom(geom)).unwrap();
        throw(&mut simulator, body, way.into());
        let from = simulator.body(body).unwrap().position3d();
        let mut steps = 0;
        while simulator.contacts().next().is_none() && steps < 200 {
            run(&mut simulator, 1);
            steps += 1;
        }
        // The time of the touch is known up to a step.
        let gone = (simulator.body(body).unwrap().position3d() - from).norm();
        assert_near(gone, hit.fraction * way.norm(), 2.0 * way.norm() * 0.01);
    });
}

#[test]
fn an_empty_motionless_or_non_finite_swept_box_has_no_hit() {
    let mut simulator = weightless();
    platform(&mut simulator, [40.0, 20.0, 30.0], [0.0, 0.0, 0.0]);
    let (low, high) = (Vector3::new(-5.0, 95.0, -5.0), Vector3::new(5.0, 105.0, 5.0));
    let down = Vector3::new(0.0, -90.0, 0.0);
    assert!(simulator.sweep_box(low, high, down, |_| true).is_some());
    assert_eq!(simulator.sweep_box(low, high, Vector3::zeros(), |_| true), None);
    assert_eq!(simulator.sweep_box(high, low, down, |_| true), None);
    for axis in 0..3 {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX] {
            let with_bad = |mut vector: Vector3| {
                vector[axis] = bad;
                vector
            };
            let found = [
                simulator.sweep_box(with_bad(low), high, down, |_| true),
                simulator.sweep_box(low, high, with_bad(down), |_| true),
                simulator.sweep_box(with_bad(low), with_bad(high), down, |_| true),
            ];
            assert_eq!(found, [None; 3], "{axis} {bad}");
        }
    }
}
