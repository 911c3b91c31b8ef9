//! Tests that the errors of the faithful set in the scenes of the chart do not change, at its default setting: steps of 1/60 s
//! and 5 iterations. The faithful set has the bits of Farseer: a run that fails here fails in Farseer, too.

use self::Pin::{Errs, Fails};
use measure::charts::{ChartScene, chart_scenes};
use measure::method::{Method, Setting, methods};

/// Outcome of a run: its error in the scene's unit, or its failure.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Pin {
    Errs(f64),
    Fails(&'static str),
}

/// Known outcomes: name of the scene, its size (number of bodies), outcome with the distance grid, outcome with separating
/// axes. The values were measured with this engine. Runs are the same to the bit on every platform; [`Pin::is_like`] only
/// allows for the few digits that are written here.
const PINS: &[(&str, usize, Pin, Pin)] = &[
    ("throw_discrete_law", 0, Errs(3.638e-4), Errs(3.638e-4)),
    ("throw_continuous_law", 0, Errs(7.193), Errs(7.193)),
    ("bounce_restitution_0", 0, Errs(0.05007), Errs(0.3901)),
    ("bounce_restitution_half", 0, Errs(2.623), Errs(4.308)),
    ("bounce_restitution_1", 0, Errs(38.1), Errs(94.95)),
    ("bounce_10000_steps", 0, Fails("gained energy"), Fails("gained energy")),
    ("slide", 0, Errs(1.327), Errs(1.322)),
    ("stick", 0, Errs(0.0), Errs(0.0)),
    ("roll_circle", 0, Errs(10.22), Errs(9.398)),
    ("roll_polygon", 0, Errs(2.07), Errs(0.682)),
    ("pendulum_narrow", 0, Errs(0.002154), Errs(0.002154)),
    ("pendulum_wide", 0, Errs(0.007272), Errs(0.007272)),
    ("double_pendulum", 0, Errs(1.677), Errs(1.677)),
    ("chain", 5, Errs(0.5358), Errs(0.5358)),
    ("chain", 20, Errs(2.596), Errs(2.596)),
    ("chain", 200, Errs(143.8), Errs(143.8)),
    ("spring_frequency", 0, Errs(0.04573), Errs(0.04573)),
    ("spring_amplitude", 0, Errs(0.1376), Errs(0.1376)),
    ("stiff_spring_frequency", 0, Errs(3.086), Errs(3.086)),
    ("stiff_spring_amplitude", 0, Errs(10.13), Errs(10.13)),
    ("newtons_cradle", 5, Errs(7.832), Errs(4.751)),
    ("newtons_cradle_momentum", 5, Errs(6.714e-6), Errs(2.193e-5)),
    ("newtons_cradle_energy", 5, Errs(16.19), Errs(13.02)),
    ("newtons_cradle_touching_momentum", 5, Errs(1.911e-5), Errs(7.663e-6)),
    ("newtons_cradle_touching_energy", 5, Errs(13.9), Errs(106.1)),
    ("oblique_hit", 0, Errs(6.659), Errs(4.736)),
    ("oblique_hit_momentum", 0, Errs(9.537e-7), Errs(1.097e-5)),
    ("oblique_hit_energy", 0, Errs(1.767), Errs(3.892)),
    ("box_stack_penetration", 5, Errs(0.05942), Fails("toppled")),
    ("box_stack_penetration", 20, Fails("toppled"), Fails("toppled")),
    ("box_stack_penetration", 200, Fails("toppled"), Fails("toppled")),
    ("box_stack_height", 5, Errs(0.1387), Fails("toppled")),
    ("box_stack_height", 20, Fails("toppled"), Fails("toppled")),
    ("box_stack_height", 200, Fails("toppled"), Fails("toppled")),
    ("box_stack_speed", 5, Errs(0.06549), Fails("toppled")),
    ("box_stack_speed", 20, Fails("toppled"), Fails("toppled")),
    ("box_stack_speed", 200, Fails("toppled"), Fails("toppled")),
    ("pyramid_penetration", 5, Errs(0.05262), Errs(0.05216)),
    ("pyramid_penetration", 20, Errs(0.08502), Errs(0.09855)),
    ("pyramid_penetration", 200, Errs(1.19), Fails("toppled")),
    ("pyramid_height", 5, Errs(0.06849), Errs(0.1088)),
    ("pyramid_height", 20, Errs(0.1489), Errs(0.1275)),
    ("pyramid_height", 200, Errs(0.9726), Fails("toppled")),
    ("pyramid_speed", 5, Errs(2.688), Errs(2.648)),
    ("pyramid_speed", 20, Errs(3.045), Errs(2.883)),
    ("pyramid_speed", 200, Errs(10.29), Fails("toppled")),
    ("circle_stack_penetration", 5, Errs(0.2322), Errs(0.02734)),
    ("circle_stack_penetration", 20, Errs(0.2324), Errs(0.05608)),
    ("circle_stack_penetration", 200, Errs(0.6143), Fails("toppled")),
    ("circle_stack_height", 5, Errs(0.7652), Errs(0.08295)),
    ("circle_stack_height", 20, Errs(0.8881), Errs(0.1702)),
    ("circle_stack_height", 200, Errs(1.958), Fails("toppled")),
    ("circle_stack_speed", 5, Errs(1.391e-7), Errs(1.512e-7)),
    ("circle_stack_speed", 20, Errs(6.953e-7), Errs(8.944e-7)),
    ("circle_stack_speed", 200, Errs(14.64), Fails("toppled")),
    ("heavy_on_light_10", 0, Errs(0.05245), Fails("toppled")),
    ("heavy_on_light_100", 0, Fails("toppled"), Fails("toppled")),
    ("heavy_on_light_1000", 0, Fails("sank"), Fails("toppled")),
    ("heavy_on_light_10000", 0, Fails("toppled"), Fails("toppled")),
    ("card_house_penetration", 5, Errs(0.8396), Errs(0.04613)),
    ("card_house_penetration", 20, Fails("toppled"), Fails("toppled")),
    ("card_house_penetration", 200, Fails("toppled"), Fails("toppled")),
    ("card_house_height", 5, Errs(0.3179), Errs(0.1259)),
    ("card_house_height", 20, Fails("toppled"), Fails("toppled")),
    ("card_house_height", 200, Fails("toppled"), Fails("toppled")),
    ("card_house_speed", 5, Errs(3.234e-6), Errs(1.430e-6)),
    ("card_house_speed", 20, Fails("toppled"), Fails("toppled")),
    ("card_house_speed", 200, Fails("toppled"), Fails("toppled")),
    ("arch_penetration", 5, Errs(0.08331), Errs(0.03688)),
    ("arch_penetration", 20, Fails("toppled"), Fails("toppled")),
    ("arch_height", 5, Errs(0.1529), Errs(0.04413)),
    ("arch_height", 20, Fails("toppled"), Fails("toppled")),
    ("arch_speed", 5, Errs(0.01187), Errs(7.071e-5)),
    ("arch_speed", 20, Fails("toppled"), Fails("toppled")),
    ("ball_pit_penetration", 5, Errs(0.7926), Errs(0.5835)),
    ("ball_pit_penetration", 20, Errs(0.8564), Errs(0.7522)),
    ("ball_pit_penetration", 200, Errs(3.398), Errs(3.838)),
    ("ball_pit_speed", 5, Errs(1.957), Errs(2.571)),
    ("ball_pit_speed", 20, Errs(1.744), Errs(2.391)),
    ("ball_pit_speed", 200, Errs(11.15), Errs(11.23)),
    ("box_pile_penetration", 5, Errs(0.08566), Errs(0.07624)),
    ("box_pile_penetration", 20, Errs(0.6024), Errs(0.1814)),
    ("box_pile_penetration", 200, Errs(2.94), Errs(4.251)),
    ("box_pile_speed", 5, Errs(1.653), Errs(2.949)),
    ("box_pile_speed", 20, Errs(5.281), Errs(6.193)),
    ("box_pile_speed", 200, Errs(7.318), Errs(13.01)),
];

/// Number of bodies of the largest scene that is run. Larger scenes take too long for a test.
const LARGEST: usize = 200;

impl Pin {
    fn is_like(self, measured: Pin) -> bool {
        match (self, measured) {
            // Differences below 1e-6 of the unit are rounding errors, also those of the sines and cosines in the measure.
            (Errs(pinned), Errs(measured)) => (pinned - measured).abs() <= 1e-2 * pinned + 1e-6,
            _ => self == measured,
        }
    }
}

fn method(name: &str) -> Method {
    let setting = Setting::fixed(1.0 / 60.0, 5);
    let method = methods().into_iter().find(|method| method.name == name);
    let method = method.unwrap_or_else(|| panic!("there is no method {name}"));
    assert_eq!(method.recommended, setting, "the default setting of {name}");
    method
}

/// Runs a scene of a `size` once with a method, and returns one outcome for each of `charts`, which are measures of that scene.
fn outcomes(charts: &[ChartScene], size: usize, method: &Method) -> Vec<Pin> {
    let scene = (charts[0].build)(size);
    let mut watches: Vec<_> = charts.iter().map(|chart| (chart.watch)(&scene)).collect();
    let mut world = (method.build)(&scene, method.recommended).unwrap_or_else(|error| panic!("{error}"));
    let mut time = 0.0;
    watches.iter_mut().for_each(|watch| watch.observe(time, &*world));
    for dt in method.recommended.dt.steps() {
        if time + f64::from(dt) / 2.0 >= charts[0].seconds {
            break;
        }
        world.step(dt);
        time += f64::from(dt);
        watches.iter_mut().for_each(|watch| watch.observe(time, &*world));
    }
    watches.iter().map(|watch| watch.failed().map_or(Errs(watch.error()), Fails)).collect()
}

/// Asserts that the chart scenes whose names begin with `prefix` have their outcomes of [`PINS`].
fn assert_pinned(prefix: &str) {
    let charts: Vec<_> = chart_scenes().into_iter().filter(|chart| chart.name.starts_with(prefix)).collect();
    assert!(!charts.is_empty(), "there is no scene {prefix}");
    let share_runs = |a: &ChartScene, b: &ChartScene| {
        a.sizes == b.sizes && a.seconds == b.seconds && (a.build)(a.sizes[0]) == (b.build)(b.sizes[0])
    };
    let methods = [method("Farseer, distance grid"), method("Farseer, SAT")];
    let mut wrong = Vec::new();
    for charts in charts.chunk_by(share_runs) {
        for &size in charts[0].sizes.iter().filter(|&&size| size <= LARGEST) {
            let [grid, sat] = methods.each_ref().map(|method| outcomes(charts, size, method));
            for ((chart, grid), sat) in charts.iter().zip(grid).zip(sat) {
                let pin = PINS.iter().find(|pin| (pin.0, pin.1) == (chart.name, size));
                if !pin.is_some_and(|pin| pin.2.is_like(grid) && pin.3.is_like(sat)) {
                    wrong.push(format!("{:?}, pinned {pin:?}", (chart.name, size, grid, sat)));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "not as pinned:\n{}", wrong.join("\n"));
}

/// Makes a test for each kind of scenes. Arguments: the name of the test and the beginning of the scenes' names.
macro_rules! pinned {
    ($($test:ident: $kind:literal,)*) => {
        const KINDS: &[&str] = &[$($kind),*];
        $(
            #[test]
            fn $test() {
                assert_pinned($kind);
            }
        )*
    };
}

pinned! {
    throws_have_their_pinned_errors: "throw_",
    bounces_have_their_pinned_errors: "bounce_",
    slides_have_their_pinned_errors: "slide",
    sticking_crates_have_their_pinned_errors: "stick",
    rolling_has_its_pinned_errors: "roll_",
    pendulums_have_their_pinned_errors: "pendulum_",
    the_energy_of_a_double_pendulum_has_its_pinned_errors: "double_pendulum",
    chains_have_their_pinned_errors: "chain",
    springs_have_their_pinned_errors: "spring_",
    stiff_springs_have_their_pinned_errors: "stiff_spring_",
    a_cradle_has_its_pinned_errors: "newtons_cradle",
    oblique_hits_have_their_pinned_errors: "oblique_hit",
    box_stacks_have_their_pinned_errors: "box_stack_",
    pyramids_have_their_pinned_errors: "pyramid_",
    circle_stacks_have_their_pinned_errors: "circle_stack_",
    heavy_boxes_have_their_pinned_errors: "heavy_on_light_",
    card_houses_have_their_pinned_errors: "card_house_",
    arches_have_their_pinned_errors: "arch_",
    ball_pits_have_their_pinned_errors: "ball_pit_",
    box_piles_have_their_pinned_errors: "box_pile_",
}

#[test]
fn every_pin_is_of_a_scene() {
    for (name, size, ..) in PINS {
        let found = chart_scenes().iter().any(|chart| chart.name == *name && chart.sizes.contains(size));
        assert!(found, "{name} of {size}");
    }
}

#[test]
fn every_scene_is_pinned() {
    for chart in chart_scenes() {
        assert!(KINDS.iter().any(|kind| chart.name.starts_with(kind)), "no test runs {}", chart.name);
        for &size in chart.sizes.iter().filter(|&&size| size <= LARGEST) {
            let pinned = PINS.iter().any(|pin| (pin.0, pin.1) == (chart.name, size));
            assert!(pinned, "{} of {size}", chart.name);
        }
    }
}
