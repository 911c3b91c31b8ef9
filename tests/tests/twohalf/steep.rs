//! Upright bodies on slopes of 10 to 84 degrees: on slopes above the friction angle they slide with g (sin a - mu cos a).

use conformance::fixtures::depth::{
    assert_goes_on_after_loading, assert_near, place, set_platform_surface, simulator, velocity, with_scheme,
};
use twohalf::{
    BodyId, CharacterController, CharacterSettings, DepthScheme, Footprint, MoveInput, Platform, PlatformId,
    TwoHalfPhysicsSimulator, Vector2, Vector3,
};
use twohalf_factories::{Cylinder, Figure, Prism, Thing, spawn};

/// px/s².
const GRAVITY: f32 = 900.0;
/// Slopes in degrees from level. Around 60 the upward component of the normal is one half.
const STEEP: [f32; 7] = [59.0, 60.1, 65.0, 70.0, 75.0, 80.0, 84.0];
/// Steepest slope along Z in degrees; its pitch ends at 1.4 rad.
const STEEPEST_PITCH: f32 = 80.0;

/// A slope that begins 5,000 px up and falls along X or Z, to the side of the sign.
#[derive(Debug, Clone, Copy)]
struct Slope {
    degrees: f32,
    along_z: bool,
    sign: f32,
}

impl Slope {
    fn all(degrees: &[f32]) -> impl Iterator<Item = Slope> + '_ {
        degrees.iter().flat_map(|&degrees| {
            let ways = [(false, 1.0), (false, -1.0), (true, 1.0), (true, -1.0)];
            let slopes = ways.map(|(along_z, sign)| Slope { degrees, along_z, sign });
            slopes.into_iter().filter(|slope| !slope.along_z || slope.degrees <= STEEPEST_PITCH)
        })
    }

    fn angle(self) -> f32 {
        self.degrees.to_radians()
    }

    fn build(self, simulator: &mut TwoHalfPhysicsSimulator, friction: f32) -> PlatformId {
        let (angle, at) = (self.sign * self.angle(), Vector3::new(0.0, 5000.0, 0.0));
        let slope = if self.along_z {
            let depth = 3000.0 * angle.cos();
            let made = Platform::new(simulator, 3000.0, 40.0, depth, at, None).unwrap();
            simulator.platform_mut(made).unwrap().set_pitch(-angle).unwrap();
            made
        } else {
            Platform::with_rotation(simulator, 3000.0, 40.0, 3000.0, at, angle, None).unwrap()
        };
        set_platform_surface(simulator, slope, friction, 0.0);
        slope
    }

    /// Unit vector down the slope, Y up.
    fn down(self) -> Vector3 {
        let (sine, cosine) = self.angle().sin_cos();
        let along = self.sign * cosine;
        if self.along_z { Vector3::new(0.0, -sine, along) } else { Vector3::new(along, -sine, 0.0) }
    }

    /// Puts a body without drag on it whose footprint extends by `reach` towards the rise.
    fn put(self, simulator: &mut TwoHalfPhysicsSimulator, thing: Thing, reach: f32) -> BodyId {
        let rise = -self.sign * (reach - 0.01);
        let [x, z] = if self.along_z { [0.0, rise] } else { [rise, 0.0] };
        let top = simulator.surface_beneath(Vector3::new(x, 20_000.0, z)).unwrap().height;
        let body = spawn(simulator, thing.at([0.0, top + 0.02, 0.0])).unwrap().body;
        simulator.body_mut(body).unwrap().core_mut().set_linear_drag_coefficient(0.0);
        body
    }
}

fn scene(slope: Slope, thing: Thing, reach: f32, friction: f32) -> (TwoHalfPhysicsSimulator, BodyId) {
    let mut simulator = TwoHalfPhysicsSimulator::with_gravity(600, Vector2::new(0.0, GRAVITY)).unwrap();
    slope.build(&mut simulator, friction);
    let body = slope.put(&mut simulator, thing.friction(friction), reach);
    (simulator, body)
}

fn square(half: f32) -> Footprint {
    let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
    Footprint::new(&corners.map(Vector2::from)).unwrap()
}

/// With how far they reach along X and Z.
fn things() -> [(Thing, f32); 5] {
    [
        (Cylinder::new(4.0, 10.0), 4.0),
        (Cylinder::new(40.0, 120.0), 40.0),
        (Cylinder::new(40.0, 10.0), 40.0),
        (Prism::footprint(square(10.0), 40.0), 10.0),
        (Prism::new([20.0, 40.0, 20.0]).upright(), 10.0),
    ]
}

fn run(simulator: &mut TwoHalfPhysicsSimulator, rate: f32, seconds: f32) {
    (0..(rate * seconds).round() as usize).for_each(|_| simulator.update(1.0 / rate));
}

#[test]
fn upright_bodies_slide_down_steep_slopes_with_g_times_sine_less_friction_times_cosine() {
    for (slope, (thing, reach)) in Slope::all(&STEEP).flat_map(|slope| things().map(|thing| (slope, thing))) {
        for (friction, rate) in [(0.0, 30.0), (0.3, 60.0), (1.0, 120.0)] {
            let (mut simulator, body) = scene(slope, thing, reach, friction);
            run(&mut simulator, rate, 0.3);
            let (before, start) = (velocity(&simulator, body), place(&simulator, body));
            run(&mut simulator, rate, 0.5);
            let (gained, way) = (velocity(&simulator, body) - before, place(&simulator, body) - start);
            let acceleration = GRAVITY * (slope.angle().sin() - friction * slope.angle().cos());
            let found = gained.dot(&slope.down()) / 0.5;
            assert!(
                (found - acceleration).abs() < 0.01 * GRAVITY,
                "{slope:?} {thing:?} {friction} {rate}: {found}, not {acceleration}"
            );
            // Along the slope, and neither off it nor into it.
            let off = (way - slope.down() * way.dot(&slope.down())).norm();
            assert!(off < 0.3, "{slope:?} {thing:?} {friction} {rate}: {off} px off");
        }
    }
}

#[test]
fn upright_bodies_stand_on_all_kinds_of_slopes_below_the_friction_angle() {
    for (slope, (thing, reach)) in
        Slope::all(&[10.0, 40.0, 60.1, 75.0]).flat_map(|slope| things().map(|thing| (slope, thing)))
    {
        let (mut simulator, body) = scene(slope, thing, reach, 1.2 * slope.angle().tan());
        run(&mut simulator, 60.0, 0.5);
        let settled = place(&simulator, body);
        run(&mut simulator, 60.0, 2.0);
        assert!((place(&simulator, body) - settled).norm() < 0.1, "{slope:?} {thing:?}");
    }
}

#[test]
fn bodies_that_slide_down_a_steep_slope_go_on_after_loading() {
    with_scheme(DepthScheme::Precise, || {
        for slope in Slope::all(&[65.0, 80.0]) {
            let mut simulator = simulator();
            slope.build(&mut simulator, 0.2);
            let body = slope.put(&mut simulator, Cylinder::new(10.0, 40.0), 10.0);
            assert_goes_on_after_loading(&mut simulator, &[body]);
            assert!(velocity(&simulator, body).norm() > 30.0);
        }
    });
}

/// A figure on a slope that it may stand on, or may not.
fn figure_on(slope: Slope, max_slope: f32) -> (TwoHalfPhysicsSimulator, BodyId, CharacterController) {
    let (simulator, body) = scene(slope, Figure::new([20.0, 60.0, 20.0]), 10.0, 0.0);
    (
        simulator,
        body,
        CharacterController::new(CharacterSettings {
            max_slope: max_slope.to_radians(),
            ..CharacterSettings::default()
        }),
    )
}

#[test]
fn a_figure_stands_on_and_jumps_from_a_steep_slope_that_is_a_floor_to_it() {
    for (slope, rate) in Slope::all(&STEEP).flat_map(|slope| [30.0, 60.0, 120.0].map(|rate| (slope, rate))) {
        let (mut simulator, body, mut walker) = figure_on(slope, 86.0);
        let mut step = |simulator: &mut TwoHalfPhysicsSimulator, wish: MoveInput| {
            simulator.walk(body, &mut walker, wish, 1.0 / rate).unwrap();
            simulator.update(1.0 / rate);
            place(simulator, body)
        };
        (0..(0.3 * rate) as usize).for_each(|_| _ = step(&mut simulator, MoveInput::default()));
        let start = place(&simulator, body);
        (0..(0.3 * rate) as usize).for_each(|_| _ = step(&mut simulator, MoveInput::default()));
        assert!((place(&simulator, body) - start).norm() < 0.1, "{slope:?} {rate}");
        step(&mut simulator, MoveInput { jump: true, ..MoveInput::default() });
        let heights =
            (0..(0.5 * rate) as usize).map(|_| step(&mut simulator, MoveInput::default()).y - start.y);
        // Half a step from the top, at most, is its highest step: g dt^2 / 8.
        let missed = GRAVITY / (8.0 * rate * rate);
        assert_near(heights.fold(0.0, f32::max), 60.0 - 0.5 * missed, 1.0 + 0.5 * missed);
    }
}

#[test]
fn a_figure_slides_down_a_steep_slope_that_is_a_wall_to_it() {
    for slope in Slope::all(&STEEP) {
        let (mut simulator, body, mut walker) = figure_on(slope, 50.0);
        for _ in 0..30 {
            simulator.walk(body, &mut walker, MoveInput::default(), 1.0 / 60.0).unwrap();
            simulator.update(1.0 / 60.0);
        }
        // In the air its input of no motion brakes it by 600 px/s² along X and Z, which takes less than half.
        let speed = velocity(&simulator, body).dot(&slope.down());
        assert!(speed > 0.25 * GRAVITY * slope.angle().sin(), "{slope:?}: {speed}");
        assert!(!walker.is_grounded());
    }
}
